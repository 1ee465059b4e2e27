/* Contact in motion: insulator faces that meet stop each other. They press as elastic layers do, and what moved them
 * towards or away from each other is lost at once: between them is liquid. Nothing holds them together.
 * docs/theory.md, section 18. Stations are pairs of facing nodes, or nodes below a flat face. */
#ifndef ZP_CONTACT_STOP_H
#define ZP_CONTACT_STOP_H

#include <stddef.h>

typedef struct ZpStopParams {
  size_t nodes;       /* N stations; the first is the clip, which is closed by itself */
  double l;           /* element length, m */
  double stiffness;   /* of both layers pressed together, per length of ribbon, N/m^2 */
  double flat_length; /* of the platform's faces, at the gap of the last station, m */
} ZpStopParams;

/* (gaps [N]) => push on each station [N], N, positive opens; its derivative by the gap, sign turned, [N], N/m. */
void zp_stop_push(const ZpStopParams *params, const double *gap, double *push, double *stiffness);

#endif
