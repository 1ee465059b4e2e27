/* Contact: insulator faces that overlap press on each other as elastic layers do, and nothing holds them together. The
 * law, eq. (9.1), begins smoothly, so that a branch of equilibria has no corner where faces meet. It is integrated inside
 * each element at the same points as the field, so that push and attraction balance point by point. In motion what moves
 * faces that are pressed is lost at once: between them is liquid (section 18).
 *
 * Stations are pairs of facing nodes, or nodes below a flat face. */
#ifndef ZP_CONTACT_FACES_H
#define ZP_CONTACT_FACES_H

#include <stddef.h>

typedef struct ZpFacesParams {
  size_t nodes;       /* N stations */
  double l;           /* element length, m */
  double stiffness;   /* of both layers pressed together, per length of ribbon, N/m^2 */
  double flat_length; /* of the platform's faces, at the gap of the last station, m */
} ZpFacesParams;

/* Faces as far apart begin to push, m: far below what the field or a user sees. */
#define ZP_CONTACT_RANGE 1e-9

/* Faces closer than that count as closed, m: far below a micrometre, far above rounding. */
#define ZP_CONTACT_TOUCH 5e-7

/* (gaps [N]) => push on each station [N], N, positive opens. */
void zp_faces_push(const ZpFacesParams *params, const double *gap, double *push);

/* (gaps [N]) => add to `own` [N] and `next` [N-1] the derivatives of the push, sign turned: by the station's gap and by
 * the next one's, N/m. */
void zp_faces_stiffness(const ZpFacesParams *params, const double *gap, double *own, double *next);

/* How many stations from the clip on are closed, the clip not counted. */
size_t zp_faces_front(const ZpFacesParams *params, const double *gap);

#endif
