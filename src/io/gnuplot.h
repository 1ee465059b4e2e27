/* Running gnuplot. */
#ifndef ZP_IO_GNUPLOT_H
#define ZP_IO_GNUPLOT_H

#include <stddef.h>

/* How it went. */
typedef enum ZpGnuplot {
  ZP_GNUPLOT_DONE,    /* it ended well; whether the picture is complete is the caller's to see */
  ZP_GNUPLOT_MISSING, /* there is no gnuplot */
  ZP_GNUPLOT_FAILED   /* it could not be run, or it complained and gave up */
} ZpGnuplot;

/* Run `script` in `folder` with its variable `out` set to the file name `output`. `reason` gets, unless
 * done, a line that says why. Nothing is printed. */
ZpGnuplot zp_gnuplot_run(const char *folder, const char *script, const char *output, char *reason, size_t size);

#endif
