/* Running gnuplot. */
#ifndef ZP_IO_GNUPLOT_H
#define ZP_IO_GNUPLOT_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

/* State of a gnuplot process. */
typedef enum ZpGnuplot {
  ZP_GNUPLOT_RUNS,
  ZP_GNUPLOT_DONE,       /* it ended with status 0; the caller checks the picture */
  ZP_GNUPLOT_MISSING,    /* gnuplot was not found */
  ZP_GNUPLOT_FAILED,     /* it could not be started, or it ended with an error */
  ZP_GNUPLOT_HANGS,      /* it took too long and was killed */
  ZP_GNUPLOT_INTERRUPTED /* the caller asked to stop, and it was killed */
} ZpGnuplot;

/* A job for gnuplot. */
typedef struct ZpGnuplotJob {
  const char *folder; /* folder in which it runs */
  const char *script; /* script in that folder */
  const char *output; /* file in that folder for the variable `out` of the script */
  double patience;    /* wall time after which it counts as hanging, s */
} ZpGnuplotJob;

/* Largest number of processes at once. */
enum { ZP_GNUPLOT_MOST = 16 };

/* Bytes of its stderr that are kept: enough for the first message. */
enum { ZP_GNUPLOT_KEPT = 4096 };

/* A running gnuplot. */
typedef struct ZpGnuplotChild {
  pid_t id;
  int errors;                 /* its stderr, read without waiting; -1 after it was closed */
  double patience, end;       /* time limit of the job, s; wall time of its end */
  char kept[ZP_GNUPLOT_KEPT]; /* its stderr, with a final 0 */
  size_t used;                /* length of `kept` */
} ZpGnuplotChild;

/* Start it => ZP_GNUPLOT_RUNS; or ZP_GNUPLOT_MISSING or ZP_GNUPLOT_FAILED with the cause in `reason`, and there is no
 * child. Prints nothing. */
ZpGnuplot zp_gnuplot_start(const ZpGnuplotJob *job, ZpGnuplotChild *child, char *reason, size_t size);

/* Wait until one of `count` children (ZP_GNUPLOT_MOST at most) prints something or ends, for 20 ms at most. */
void zp_gnuplot_wait(ZpGnuplotChild *const *child, size_t count);

/* The current state; with `stop` the process is killed. Unless it is running or done, `reason` gets the cause. When it
 * is no longer running, there is no child. */
ZpGnuplot zp_gnuplot_look(ZpGnuplotChild *child, bool stop, char *reason, size_t size);

#endif
