/* Arrays over the nodes of two ribbons, one axis: where the upper and the lower node of station i stand. */
#ifndef ZP_BASE_PAIR_H
#define ZP_BASE_PAIR_H

#include <stddef.h>

#include "base/kernel.h"

ZP_INLINE size_t zp_up(size_t i) {
  return 2 * i;
}

ZP_INLINE size_t zp_down(size_t i) {
  return 2 * i + 1;
}

/* By how much the upper node is beyond the lower one. */
ZP_INLINE double zp_apart(const double *of, size_t i) {
  return of[zp_up(i)] - of[zp_down(i)];
}

ZP_INLINE void zp_set_pair(double *of, size_t i, double up, double down) {
  of[zp_up(i)] = up;
  of[zp_down(i)] = down;
}

/* Move both nodes apart, or pull them, by as much each. */
ZP_INLINE void zp_part_pair(double *of, size_t i, double by) {
  of[zp_up(i)] += by;
  of[zp_down(i)] -= by;
}

#endif
