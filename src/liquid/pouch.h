/* A pouch: two films, sealed at both ends around a fixed volume of liquid, which mirror each other. One film is
 * described, above their middle plane. docs/theory.md, section 40.
 *
 * Letters: h height of the film over the middle plane, m; x along the pouch, m; w width, m; V volume between the film
 * and the middle plane, m^3; p pressure of the liquid, Pa. */
#ifndef ZP_LIQUID_POUCH_H
#define ZP_LIQUID_POUCH_H

#include <stddef.h>

typedef struct ZpPouchParams {
  double w;         /* m; 0: there is no pouch */
  double volume;    /* V that one film encloses, m^3 */
  double electrode; /* length of the electrodes from the left seam on, m */
  double length;    /* of a film, m */
  double mass;      /* of a film, kg */
} ZpPouchParams;

/* Moduli with which the volume is held while a pressure is sought, Pa, eq. (40.6): what is found does not depend on
 * them. At rest far above that of any liquid; for derivatives, whose rounding grows with it; over a step of the length
 * h, s, also above the inertia of the films. */
static const double zp_pouch_modulus = 1e11, zp_pouch_modulus_of_rates = 1e7;
double zp_pouch_modulus_of_step(const ZpPouchParams *pouch, double h);

/* Half opening angle of an arc of `length` which, with its mirror image, encloses `area`, eq. (40.1); area up to
 * length^2 / pi: a circle, pi/2. rad */
double zp_pouch_angle(double length, double area);

/* Chord of that arc, m. */
double zp_pouch_chord(double length, double angle);

/* Place of the point of the film `s` from the left seam, of a pouch whose films lie on each other up to `zipped` and
 * are an arc beyond, m. */
void zp_pouch_place(const ZpPouchParams *pouch, double zipped, double s, double *x, double *h);

/* V of n nodes on the arc of a pouch with nothing zipped, m^3: less than that of the arc by a part of the order 1 /
 * n^2. That of the nodes is kept, so that a pouch with nothing zipped has its length, eq. (40.2). */
double zp_pouch_volume_of_chords(const ZpPouchParams *pouch, size_t n);

/* (x, heights of n nodes) => V, eq. (40.4), m^3. */
double zp_pouch_volume(const ZpPouchParams *pouch, size_t n, const double *x, const double *h);

/* V by x and h of node i, m^2. */
double zp_pouch_by_x(const ZpPouchParams *pouch, size_t n, const double *h, size_t i);
double zp_pouch_by_h(const ZpPouchParams *pouch, size_t n, const double *x, size_t i);

#endif
