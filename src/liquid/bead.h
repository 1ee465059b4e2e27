/* A bead of liquid between the faces at each zip front, and air beyond: how far it reaches. docs/theory.md, section 22.
 *
 * Lengths are measured along a half from its clip to its platform and on along half of that. Half 0 begins at the first
 * station, half 1, where there is one, at the last. */
#ifndef ZP_LIQUID_BEAD_H
#define ZP_LIQUID_BEAD_H

#include "liquid/film.h"

enum { ZP_BEADS = 2 };

typedef struct ZpBeadParams {
  double volume;   /* of each, m^3 */
  double suction;  /* share of the meniscus pressure that acts, 0 .. 1 */
  double returned; /* share of what is pressed out at the long edges that may come back, 0 .. 1 */
  double tension;  /* surface tension, N/m */
} ZpBeadParams;

/* All of a bead that evolves. */
typedef struct ZpBead {
  double reach;   /* wet length, m */
  double rate;    /* mean rate of that over the last step, m/s */
  double outside; /* at the long edges, from where it may come back, m^3 */
  double lost;    /* m^3 */
  double supply;  /* share of the long edges, where the film sucks, that has liquid at hand, 0 .. 1 */
} ZpBead;

/* How many there are. */
int zp_beads(const ZpFilmParams *film);

/* The length of a half that can be wet, m. */
double zp_bead_longest(const ZpFilmParams *film);

/* (gaps [N], m; volume, m^3) => wet length, m, at most the longest. Thickness is linear between stations. */
double zp_bead_reach(const ZpFilmParams *film, const double *gap, int half, double volume);

/* How far from its near end an element of length l is wet that holds `area`, m^2, with the thicknesses n near and f
 * far, m: n d + (f - n) d^2 / (2 l) = area => d, m. */
double zp_bead_within(double near, double far, double l, double area);

/* Volume between the faces as far as `reach`, m^3. */
double zp_bead_volume(const ZpFilmParams *film, const double *gap, int half, double reach);

/* (wet length of each half) => cover. */
void zp_bead_cover(const ZpFilmParams *film, const double reach[ZP_BEADS], ZpCover *cover);

/* Elements of a half, and its station k from the clip. */
size_t zp_bead_elements(const ZpFilmParams *film);
size_t zp_bead_station(const ZpFilmParams *film, int half, size_t k);

/* Where a bead of a wet length ends. */
typedef struct ZpBeadPlace {
  size_t k;         /* of the half: behind its station k, */
  size_t near, far; /* the stations on both sides: the same one below the platform, */
  double part;      /* by this part of the element there, or of the flat faces, 0 .. 1 */
} ZpBeadPlace;
ZpBeadPlace zp_bead_place(const ZpFilmParams *film, int half, double reach);

/* There: something that is known at stations [N], and the thickness of the film, m; both are linear between stations.
 */
double zp_bead_at(const ZpBeadPlace *place, const double *value);
double zp_bead_thickness(const ZpFilmParams *film, const ZpBeadPlace *place, const double *gap);

/* Volumes that pass the long edges in a step, m^3. */
typedef struct ZpBeadEdges {
  double pressed_out, drawn_in;
  double wanted; /* the film would draw in so much if liquid were all along the edges */
} ZpBeadEdges;

/* A bead over a step of h, s: (gaps at its end [N], volumes at the edges) => it there. Nothing is drawn in that is not
 * there. What has no room stays at the edges, too, without being counted as `outside`. */
ZpBead zp_bead_after(const ZpBeadParams *params, const ZpFilmParams *film, const double *gap, int half, ZpBead before,
                     ZpBeadEdges edges, double h);

#endif
