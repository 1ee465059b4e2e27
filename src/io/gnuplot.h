/* Running gnuplot. */
#ifndef ZP_IO_GNUPLOT_H
#define ZP_IO_GNUPLOT_H

#include <stddef.h>

#include <zipact/study.h>

/* How it went. */
typedef enum ZpGnuplot {
  ZP_GNUPLOT_DONE,       /* it ended well; whether the picture is complete is the caller's to see */
  ZP_GNUPLOT_MISSING,    /* there is no gnuplot */
  ZP_GNUPLOT_FAILED,     /* it could not be run, or it complained and gave up */
  ZP_GNUPLOT_HANGS,      /* it took too long and was killed */
  ZP_GNUPLOT_INTERRUPTED /* a hook asked to stop, and it was killed */
} ZpGnuplot;

/* What gnuplot is to do. */
typedef struct ZpGnuplotJob {
  const char *folder;   /* where it runs */
  const char *script;   /* file name there */
  const char *output;   /* file name there, for the script's variable `out` */
  double patience;      /* wall time after which it counts as hanging, s */
  const ZpHooks *hooks; /* asked while it runs: true ends it. May be NULL */
} ZpGnuplotJob;

/* Run it and wait for its end. `reason` gets, unless done, a line that says why. Nothing is printed. */
ZpGnuplot zp_gnuplot_run(const ZpGnuplotJob *job, char *reason, size_t size);

#endif
