/* Unilateral contact: insulator faces press on each other where they would overlap, and nothing holds them
 * together. The pressure grows with the overlap, eq. (9.1); integrated inside each element at the same
 * points as the field, so the two balance point by point.
 *
 * Stations are pairs of facing nodes; upper and lower node of station i at [2 i] and [2 i + 1]. */
#ifndef ZP_CONTACT_UNILATERAL_H
#define ZP_CONTACT_UNILATERAL_H

#include <stddef.h>

typedef struct ZpUnilateralParams {
  size_t nodes;       /* N stations */
  double l;           /* element length, m */
  double k;           /* pressure per length over overlap, N/m^2 */
  double flat_length; /* of the platform's faces, at the gap of the last station, m */
} ZpUnilateralParams;

/* (gaps [N]) => push on each station [N], N, positive opens; returns the energy, J. */
double zp_unilateral_push(const ZpUnilateralParams *params, const double *gap, double *push);

/* (gaps [N]) => second derivatives of the energy by the gaps: own [N] and with the next station [N-1], N/m. */
void zp_unilateral_stiffness(const ZpUnilateralParams *params, const double *gap, double *own, double *next);

/* How many stations from the clip on are closed: gap below `closed`, m. */
size_t zp_unilateral_front(const ZpUnilateralParams *params, const double *gap, double closed);

#endif
