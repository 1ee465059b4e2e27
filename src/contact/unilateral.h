/* Unilateral contact: insulator faces that come closer than a short range push each other apart, and nothing
 * holds them together. The law, eq. (9.1), is smooth, so that a branch of equilibria has no corner where contact
 * begins; its range is far below a micrometre. It is integrated inside each element at the same points as the
 * field, so the two balance point by point.
 *
 * Stations are pairs of facing nodes. */
#ifndef ZP_CONTACT_UNILATERAL_H
#define ZP_CONTACT_UNILATERAL_H

#include <stddef.h>

typedef struct ZpUnilateralParams {
  size_t nodes;       /* N stations */
  double l;           /* element length, m */
  double p0;          /* push per length at gap 0, N/m */
  double range;       /* gap below which faces push, m */
  double touch;       /* gap below which they count as closed, m; at least the range */
  double flat_length; /* of the platform's faces, at the gap of the last station, m */
} ZpUnilateralParams;

/* (gaps [N]) => push on each station [N], N, positive opens. */
void zp_unilateral_push(const ZpUnilateralParams *params, const double *gap, double *push);

/* (gaps [N]) => second derivatives of the energy by the gaps, added to own [N] and, with the next station, to next
 * [N-1], N/m. */
void zp_unilateral_stiffness(const ZpUnilateralParams *params, const double *gap, double *own, double *next);

/* How many stations from the clip on are closed, the clip not counted. */
size_t zp_unilateral_front(const ZpUnilateralParams *params, const double *gap);

#endif
