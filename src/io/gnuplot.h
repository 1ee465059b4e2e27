/* Running gnuplot. */
#ifndef ZP_IO_GNUPLOT_H
#define ZP_IO_GNUPLOT_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

/* How it is. */
typedef enum ZpGnuplot {
  ZP_GNUPLOT_RUNS,
  ZP_GNUPLOT_DONE,       /* it ended well; whether the picture is complete is the caller's to see */
  ZP_GNUPLOT_MISSING,    /* there is no gnuplot */
  ZP_GNUPLOT_FAILED,     /* it could not be run, or it complained and gave up */
  ZP_GNUPLOT_HANGS,      /* it took too long and was killed */
  ZP_GNUPLOT_INTERRUPTED /* the caller asked to stop, and it was killed */
} ZpGnuplot;

/* What gnuplot is to do. */
typedef struct ZpGnuplotJob {
  const char *folder; /* where it runs */
  const char *script; /* file name there */
  const char *output; /* file name there, for the script's variable `out` */
  double patience;    /* wall time after which it counts as hanging, s */
} ZpGnuplotJob;

/* Most of them at once. */
enum { ZP_GNUPLOT_MOST = 16 };

/* What is kept of its stderr: more than enough for the first complaint. */
enum { ZP_GNUPLOT_KEPT = 4096 };

/* A gnuplot that runs. */
typedef struct ZpGnuplotChild {
  pid_t id;
  int errors;                 /* its stderr, read without waiting; -1 when it has closed it */
  double patience, end;       /* of the job, s; wall time at which it is over */
  char kept[ZP_GNUPLOT_KEPT]; /* what it printed on stderr, ends with a 0 */
  size_t used;                /* bytes of `kept` */
} ZpGnuplotChild;

/* Start it => ZP_GNUPLOT_RUNS, or ZP_GNUPLOT_MISSING or ZP_GNUPLOT_FAILED; then `reason` gets a line that says why and
 * there is no child. Nothing is printed. */
ZpGnuplot zp_gnuplot_start(const ZpGnuplotJob *job, ZpGnuplotChild *child, char *reason, size_t size);

/* Wait until one of `count` children (ZP_GNUPLOT_MOST at most) says something or ends, for 20 ms at most. */
void zp_gnuplot_wait(ZpGnuplotChild *const *child, size_t count);

/* How it is by now; with `stop`, it is killed. Unless it still runs or is done, `reason` gets a line that says why.
 * Once it does not run any more, there is no child. */
ZpGnuplot zp_gnuplot_look(ZpGnuplotChild *child, bool stop, char *reason, size_t size);

#endif
