/* Contact, at rest and in motion: insulator faces that overlap push each other apart as elastic layers do, eq. (9.1),
 * and nothing holds them together. In motion what moves faces that are pressed towards or away from each other is lost
 * at once, since between them is liquid (docs/theory.md, section 18). Stations are pairs of facing nodes, or nodes
 * below a flat face. */
#ifndef ZP_CONTACT_FACES_H
#define ZP_CONTACT_FACES_H

#include <stddef.h>

typedef struct ZpFacesParams {
  size_t nodes;       /* N stations; the first is the clip, which is closed by itself */
  double l;           /* element length, m */
  double stiffness;   /* of both layers pressed together, per length of ribbon, N/m^2 */
  double flat_length; /* of the platform's faces, at the gap of the last station, m */
} ZpFacesParams;

/* Faces closer than that count as closed, m: far below a micrometre, far above rounding. */
#define ZP_CLOSED_GAP 5e-7

/* (gaps [N]) => push on each station [N], N, positive opens; its derivative by the gap, sign turned, [N], N/m. */
void zp_faces_push(const ZpFacesParams *params, const double *gap, double *push, double *stiffness);

/* How many stations from the clip on are closed, the clip not counted. */
size_t zp_faces_front(const ZpFacesParams *params, const double *gap);

#endif
