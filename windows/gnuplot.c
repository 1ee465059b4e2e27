/* Instead of src/io/gnuplot.c: on Windows the command draws no pictures. It leaves each with its .gp file, which a
 * gnuplot there draws. */
#include "io/gnuplot.h"

#include <stdio.h>

ZpGnuplot zp_gnuplot_start(const ZpGnuplotJob *job, ZpGnuplotChild *child, char *reason, size_t size) {
  (void)job, (void)child;
  snprintf(reason, size, "not on Windows");
  return ZP_GNUPLOT_MISSING;
}

void zp_gnuplot_wait(ZpGnuplotChild *const *child, size_t count) {
  (void)child, (void)count;
}

ZpGnuplot zp_gnuplot_look(ZpGnuplotChild *child, bool stop, char *reason, size_t size) {
  (void)child, (void)stop, (void)reason, (void)size;
  return ZP_GNUPLOT_MISSING;
}
