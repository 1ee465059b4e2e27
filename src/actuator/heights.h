/* Heights of the bodies of a network at given reaches of its members (zp_reach): of a tree exactly; where several lead
 * to a body, those at which all reaches together change least, eq. (32.3). */
#ifndef ZP_ACTUATOR_HEIGHTS_H
#define ZP_ACTUATOR_HEIGHTS_H

#include "def/network.h"
#include "math/sparse.h"

typedef struct ZpHeights {
  const ZpNetwork *network;
  double *reach, *weight; /* [members] what is given, m; how much each counts */
  double *y;              /* [bodies] what is found, m */
  size_t *unknown;        /* [bodies] */
  ZpSparsity sparsity;
  ZpSparse matrix;
  double *right; /* [unknowns] */
  void *memory;
} ZpHeights;

/* All weights are 1. False if there is no memory. */
bool zp_heights_create(const ZpNetwork *network, ZpHeights *heights);
void zp_heights_destroy(ZpHeights *heights);

/* reach, weight => y. Bodies that are held are at `nearer` times their heights. */
void zp_heights_find(ZpHeights *heights, double nearer);

#endif
