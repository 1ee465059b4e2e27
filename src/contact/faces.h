/* Contact, at rest and in motion: insulator faces that come closer than a short range push each other apart, eq. (9.1),
 * and nothing holds them together. The push begins smoothly, so that a branch of equilibria has no corner where contact
 * begins, and it is integrated inside each element at the same points as the field, so that the two balance point by
 * point. What moves faces that push each other is lost at once (docs/theory.md, section 18): between them is liquid.
 *
 * Stations are pairs of facing nodes, or nodes below a flat face. */
#ifndef ZP_CONTACT_FACES_H
#define ZP_CONTACT_FACES_H

#include <stdbool.h>
#include <stddef.h>

#include "base/memory.h"

typedef struct ZpFacesParams {
  size_t nodes;       /* N stations; the first is the clip, which is closed by itself */
  double l;           /* element length, m */
  double range;       /* delta: gap below which faces push, m */
  double push;        /* p_c: push per length at gap 0, N/m */
  double flat_length; /* of the platform's faces, at the gap of the last station, m */
} ZpFacesParams;

/* Faces closer than that count as closed, m: far below a micrometre, far above rounding; at least the range. */
#define ZP_CLOSED_GAP 5e-7

/* What faces do at some gaps. */
typedef struct ZpFacesEval {
  double *push;       /* [N] on each station, N, positive opens */
  double *own, *next; /* [N], [N-1] its derivatives, sign turned: by the station's gap, by the next one's, N/m */
} ZpFacesEval;

void zp_faces_carve(const ZpFacesParams *params, ZpFacesEval *eval, ZpCarver *carver);

/* (gaps [N]) => all of eval. */
void zp_faces_eval(const ZpFacesParams *params, const double *gap, const ZpFacesEval *eval);

/* Are faces at this gap pressed on each other: is the push no less than an eighth of that at gap 0? */
static inline bool zp_faces_pressed(const ZpFacesParams *params, double gap) {
  return gap < 0.5 * params->range;
}

/* How many stations from the clip on are closed, the clip not counted. */
size_t zp_faces_front(const ZpFacesParams *params, const double *gap);

#endif
