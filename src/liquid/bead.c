#include "liquid/bead.h"

#include <math.h>

int zp_beads(const ZpFilmParams *p) {
  return p->platform_end > p->platform ? 2 : 1;
}

size_t zp_bead_elements(const ZpFilmParams *p) {
  return p->platform;
}

static double flexible(const ZpFilmParams *p) {
  return (double)zp_bead_elements(p) * p->l;
}

double zp_bead_longest(const ZpFilmParams *p) {
  return flexible(p) + p->flat_length;
}

size_t zp_bead_station(const ZpFilmParams *p, int half, size_t k) {
  return half ? p->nodes - 1 - k : k;
}

/* The element behind station k of a half, by its left station. */
static size_t element(const ZpFilmParams *p, int half, size_t k) {
  return half ? p->nodes - 2 - k : k;
}

double zp_bead_within(double near, double far, double l, double area) {
  double slope = (far - near) / l;
  return 2 * area / (near + sqrt(fmax(near * near + 2 * slope * area, 0)));
}

static double thickness(const ZpFilmParams *p, const double *gap, int half, size_t k) {
  return zp_film_thickness(p, gap[zp_bead_station(p, half, k)]);
}

double zp_bead_reach(const ZpFilmParams *p, const double *gap, int half, double volume) {
  double area = fmax(volume, 0) / p->w, near = thickness(p, gap, half, 0);
  for (size_t k = 0; k < zp_bead_elements(p); k++) {
    double far = thickness(p, gap, half, k + 1), all = 0.5 * p->l * (near + far);
    if (area < all) return (double)k * p->l + fmin(zp_bead_within(near, far, p->l, area), p->l);
    area -= all;
    near = far;
  }
  double below = p->flat_length * near;
  return area < below ? flexible(p) + p->flat_length * (area / below) : zp_bead_longest(p);
}

double zp_bead_volume(const ZpFilmParams *p, const double *gap, int half, double reach) {
  double area = 0;
  for (size_t k = 0; k < zp_bead_elements(p); k++) {
    double near = thickness(p, gap, half, k), far = thickness(p, gap, half, k + 1);
    double d = fmin(fmax(reach - (double)k * p->l, 0), p->l);
    area += d * (near + 0.5 * (far - near) * (d / p->l));
  }
  double below = fmax(reach - flexible(p), 0);
  return p->w * (area + below * thickness(p, gap, half, zp_bead_elements(p)));
}

/* Share of the flat part that is wet as far as `beyond` its near end; it may have no length. */
static double flat_part(const ZpFilmParams *p, double beyond) {
  if (beyond >= p->flat_length) return 1;
  return beyond > 0 ? beyond / p->flat_length : 0;
}

void zp_bead_cover(const ZpFilmParams *p, const double reach[ZP_BEADS], ZpCover *cover) {
  for (int half = 0; half < zp_beads(p); half++) {
    for (size_t k = 0; k < zp_bead_elements(p); k++)
      cover->part[element(p, half, k)] = fmin(fmax(reach[half] / p->l - (double)k, 0), 1);
    cover->flat[half] = reach[half] >= zp_bead_longest(p) ? 1 : flat_part(p, reach[half] - flexible(p));
  }
}

ZpBeadPlace zp_bead_place(const ZpFilmParams *p, int half, double reach) {
  double along = fmax(reach, 0) / p->l;
  size_t k = zp_bead_elements(p), platform = zp_bead_station(p, half, k);
  if (!(along < (double)k)) return (ZpBeadPlace){k, platform, platform, flat_part(p, reach - flexible(p))};
  k = (size_t)along;
  return (ZpBeadPlace){k, zp_bead_station(p, half, k), zp_bead_station(p, half, k + 1), along - (double)k};
}

static double between(const ZpBeadPlace *place, double near, double far) {
  return near + (far - near) * place->part;
}

double zp_bead_at(const ZpBeadPlace *place, const double *value) {
  return between(place, value[place->near], value[place->far]);
}

double zp_bead_thickness(const ZpFilmParams *p, const ZpBeadPlace *place, const double *gap) {
  return between(place, zp_film_thickness(p, gap[place->near]), zp_film_thickness(p, gap[place->far]));
}

/* Liquid at hand in a step like the last one, over that which the film would take. */
static double supply_of(double outside, double comes, double wanted) {
  double at_hand = 0.5 * outside + comes;
  if (!(at_hand > 0)) return 0;
  return at_hand < wanted ? at_hand / wanted : 1;
}

ZpBead zp_bead_after(const ZpBeadParams *params, const ZpFilmParams *p, const double *gap, int half, ZpBead before,
                     ZpBeadEdges edges, double h) {
  double share = params->returned;
  ZpBead after = {.outside = fmax(before.outside + share * edges.pressed_out - edges.drawn_in, 0),
                  .lost = before.lost + (1 - share) * edges.pressed_out};
  after.reach = zp_bead_reach(p, gap, half, params->volume - after.outside - after.lost);
  after.rate = (after.reach - before.reach) / h;
  after.supply = supply_of(after.outside, share * edges.pressed_out, edges.wanted);
  return after;
}
