/* A bead at rest: all of its liquid lies between the faces, and how far it reaches follows from the gaps. The film term
 * has it in motion. What the reach does to the forces goes through two unknowns of each station, whose equations are
 * always fulfilled, so that the stiffness stays banded: the area A that lies between the clip and the station, and the
 * head p there, that of the meniscus as far as liquid reaches. Eqs. (22.19) to (22.21). */
#include <math.h>

#include "term/term.h"

enum { AREA, HEAD };

/* What counts as 1 m of a position: so little of it that arc lengths and corrections are those of positions. */
static const double area_scale = 1e3;  /* m^2 */
static const double head_scale = 1e12; /* Pa */

static bool acts(const ZpModel *model) {
  return model->has_bead;
}

/* Where a bead ends, and how its part of the element, or of the flat faces, goes with the area to the station before it
 * and the gaps of both stations. */
typedef struct End {
  bool ends; /* false: all is wet */
  int half;
  ZpBeadPlace at;
  double g, H;            /* at the meniscus, m */
  double level;           /* dx/ds there */
  double by_area;         /* of the part, 1/m^2, */
  double by_near, by_far; /* 1/m */
  double length;          /* of what the part is of, m */
  ZpRoom room;
} End;

static double rise(const ZpModel *model, const ZpEval *e, size_t i) {
  return zp_film_rise(&model->film, e->plates.gap[i]);
}

/* Below the platform? */
static bool is_below(const End *end) {
  return end->at.near == end->at.far;
}

static End end_of(const ZpModel *model, const double *x, const ZpEval *e, int half) {
  const ZpFilmParams *film = &model->film;
  End end = {.half = half, .at = zp_bead_place(film, half, e->reach[half])};
  double part = end.at.part, far = is_below(&end) ? 0 : 0.5 * part * part;
  end.ends = e->reach[half] < zp_bead_longest(film);
  end.length = is_below(&end) ? film->flat_length : film->l;
  end.g = zp_bead_at(&end.at, e->plates.gap);
  end.H = zp_bead_thickness(film, &end.at, e->plates.gap);
  end.level = zp_term_level(model, &end.at, x);
  if (!end.ends) return end;
  end.room = zp_term_meniscus_room(model, e->reach[half]);
  end.by_area = -1 / (end.H * end.length);
  end.by_near = -(part - far) / end.H * rise(model, e, end.at.near);
  end.by_far = -far / end.H * rise(model, e, end.at.far);
  return end;
}

/* -- the head at the meniscus ---------------------------------------------------------------------- */

/* With room for the meniscus. */
static double free_head(const ZpModel *model, double U, const End *end) {
  return zp_term_meniscus_head(model, U, end->g, end->H, end->level);
}

static double head_of(const ZpModel *model, double U, const End *end) {
  return end->ends ? end->room.share * free_head(model, U, end) : 0;
}

/* => the share of the head that follows what draws the liquid on: none of one that cavitates. */
static double share_that_follows(const ZpModel *model, double U, const End *end) {
  return end->ends && free_head(model, U, end) > -zp_film_tension ? end->room.share : 0;
}

/* => how it goes with the part, and with the gaps of both stations. */
typedef struct HeadSlope {
  double by_part, by_near, by_far;
} HeadSlope;

static HeadSlope head_slope(const ZpModel *model, const ZpEval *e, double U, const End *end) {
  double W = zp_plates_law(&model->air, U, end->g).W - zp_plates_law(&model->plates, U, end->g).W;
  double follows = share_that_follows(model, U, end), head = free_head(model, U, end);
  double by_g = -follows * model->bead.suction * W * end->level / (model->film.w * end->H);
  double by_H = -follows * head / end->H, by_part = head * end->room.by_reach * end->length;
  const double *gap = e->plates.gap;
  if (is_below(end)) return (HeadSlope){by_part, by_g + by_H * rise(model, e, end->at.near), 0};
  double dg = gap[end->at.far] - gap[end->at.near];
  double dH = zp_film_thickness(&model->film, gap[end->at.far]) - zp_film_thickness(&model->film, gap[end->at.near]);
  double l = 1 - end->at.part, r = end->at.part;
  return (HeadSlope){by_part + by_g * dg + by_H * dH, l * (by_g + by_H * rise(model, e, end->at.near)),
                     r * (by_g + by_H * rise(model, e, end->at.far))};
}

/* -- forces ---------------------------------------------------------------------------------------- */

/* What the thickness at station k of a half counts in the wet area, m. */
static double wet_share(const ZpModel *model, const End *end, size_t k) {
  double l = model->film.l, part = end->at.part, sum = 0;
  if (k > 0 && (k - 1 < end->at.k || !end->ends)) sum += 0.5 * l;
  if (k > 0 && k - 1 == end->at.k && end->ends && !is_below(end)) sum += 0.5 * part * part * l;
  if (k < zp_bead_elements(&model->film) && (k < end->at.k || !end->ends)) sum += 0.5 * l;
  if (k == end->at.k && end->ends && !is_below(end)) sum += (part - 0.5 * part * part) * l;
  if (k == zp_bead_elements(&model->film) && is_below(end)) sum += part * end->length;
  return sum;
}

static size_t last_of(const ZpModel *model, const End *end) {
  size_t far = is_below(end) ? end->at.k : end->at.k + 1;
  return far < zp_bead_elements(&model->film) ? far : zp_bead_elements(&model->film);
}

/* F += head x how the wet area goes with each gap. */
static void add_head(const ZpModel *model, const ZpEval *e, const End *end, double head, double *F) {
  double *Fy = F + model->stride;
  for (size_t k = 0; k <= last_of(model, end); k++) {
    size_t i = zp_bead_station(&model->film, end->half, k);
    double push = model->film.w * head * wet_share(model, end, k) * rise(model, e, i);
    Fy[zp_upper(&model->topology, i)] += push;
    Fy[zp_lower(&model->topology, i)] -= push;
  }
}

static bool draws(const ZpModel *model, const ZpSpan *span) {
  return zp_span_is_still(span) && model->bead.suction > 0;
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  if (!draws(model, span)) return;
  for (int half = 0; half < zp_beads(&model->film); half++) {
    End end = end_of(model, span->end, e, half);
    add_head(model, e, &end, head_of(model, span->U1, &end), F);
  }
}

/* -- stiffness ------------------------------------------------------------------------------------- */

/* Entries of a station's gap: a row or a column of both its nodes' heights. */
static void at_gap(const ZpModel *model, const ZpAssembly *a, size_t own, size_t i, bool row, double value, ZpBand *K) {
  zp_assemble_cross(a, own, 2 * zp_upper(&model->topology, i) + 1, row, value, K);
  zp_assemble_cross(a, own, 2 * zp_lower(&model->topology, i) + 1, row, -value, K);
}

/* Entries of the x of the nodes between which the bead ends: a row of what goes with dx/ds there. */
static void by_level(const ZpModel *model, const ZpAssembly *a, const End *end, size_t own, double factor, ZpBand *K) {
  const ZpTopology *t = &model->topology;
  double value = 0.5 * factor / model->film.l * (end->at.near < end->at.far ? 1 : -1);
  for (int lower = 0; lower < 2 && !is_below(end); lower++) {
    zp_assemble_cross(a, own, 2 * (zp_upper(t, end->at.far) + (size_t)lower), false, value, K);
    zp_assemble_cross(a, own, 2 * (zp_upper(t, end->at.near) + (size_t)lower), false, -value, K);
  }
}

static size_t own_of(size_t i, int which) {
  return 2 * i + (size_t)which;
}

/* The area to each station is that to the one before it and what lies between both. */
static void areas(const ZpModel *model, const ZpAssembly *a, const ZpEval *e, int half, ZpBand *K) {
  double share = -0.5 * model->film.l / area_scale;
  for (size_t k = 0; k <= zp_bead_elements(&model->film); k++) {
    size_t i = zp_bead_station(&model->film, half, k), own = own_of(i, AREA);
    zp_assemble_own(a, own, own, 1, K);
    if (k == 0) continue;
    size_t before = zp_bead_station(&model->film, half, k - 1);
    zp_assemble_own(a, own, own_of(before, AREA), -1, K);
    at_gap(model, a, own, i, false, share * rise(model, e, i), K);
    at_gap(model, a, own, before, false, share * rise(model, e, before), K);
  }
}

/* Add to row `own`: -factor times the derivative of the part of the element that is wet at the meniscus. */
static void follow_part(const ZpModel *model, const ZpAssembly *a, const End *end, size_t own, double factor,
                        ZpBand *K) {
  zp_assemble_own(a, own, own_of(end->at.near, AREA), -factor * end->by_area * area_scale, K);
  at_gap(model, a, own, end->at.near, false, -factor * end->by_near, K);
  if (!is_below(end)) at_gap(model, a, own, end->at.far, false, -factor * end->by_far, K);
}

/* The head at each wet station is that at the next one, at the last that of the meniscus; elsewhere it is 0. */
static void heads(const ZpModel *model, const ZpAssembly *a, const ZpEval *e, double U, const End *end, ZpBand *K) {
  for (size_t k = 0; k <= zp_bead_elements(&model->film); k++) {
    size_t own = own_of(zp_bead_station(&model->film, end->half, k), HEAD);
    zp_assemble_own(a, own, own, 1, K);
    if (k < end->at.k) zp_assemble_own(a, own, own_of(zp_bead_station(&model->film, end->half, k + 1), HEAD), -1, K);
  }
  if (!end->ends) return;
  size_t own = own_of(end->at.near, HEAD);
  HeadSlope slope = head_slope(model, e, U, end);
  double follows = share_that_follows(model, U, end) / head_scale;
  follow_part(model, a, end, own, slope.by_part / head_scale, K);
  by_level(model, a, end, own, -follows * zp_term_electric_head(model, U, end->g, end->H), K);
  at_gap(model, a, own, end->at.near, false, -slope.by_near / head_scale, K);
  if (!is_below(end)) at_gap(model, a, own, end->at.far, false, -slope.by_far / head_scale, K);
}

/* A force on coordinate c that goes with the part where the bead ends, N. */
static void part_acts(const ZpModel *model, const ZpAssembly *a, const End *end, size_t c, double by_part, ZpBand *K) {
  const ZpTopology *t = &model->topology;
  const size_t station[] = {end->at.near, end->at.far};
  const double by_gap[] = {end->by_near, end->by_far};
  zp_assemble_cross(a, own_of(end->at.near, AREA), c, true, -by_part * end->by_area * area_scale, K);
  for (int m = 0; m < (is_below(end) ? 1 : 2); m++) {
    zp_assemble_entry(a, c, 2 * zp_upper(t, station[m]) + 1, -by_part * by_gap[m], K);
    zp_assemble_entry(a, c, 2 * zp_lower(t, station[m]) + 1, by_part * by_gap[m], K);
  }
}

/* The attraction goes with the part, since one law follows the other there. */
static void attraction(const ZpModel *model, const ZpAssembly *a, const ZpEval *e, double U, const End *end,
                       ZpBand *K) {
  const ZpTopology *t = &model->topology;
  size_t left = end->at.near < end->at.far ? end->at.near : end->at.far,
         right = end->at.near < end->at.far ? end->at.far : end->at.near;
  if (left == right) {
    double W = zp_plates_law(&model->plates, U, end->g).W - zp_plates_law(&model->air, U, end->g).W;
    part_acts(model, a, end, 2 * zp_upper(t, left) + 1, -model->plates.flat_length * W, K);
    part_acts(model, a, end, 2 * zp_lower(t, left) + 1, model->plates.flat_length * W, K);
    return;
  }
  ZpPlatesByCover by = zp_plates_by_cover(&model->plates, &e->plates, U, left);
  const double closing[] = {by.A, by.B}, along[] = {0.5 * by.P, -0.5 * by.P};
  const size_t station[] = {left, right};
  for (int m = 0; m < 2; m++) {
    size_t upper = 2 * zp_upper(t, station[m]), lower = 2 * zp_lower(t, station[m]);
    part_acts(model, a, end, upper, along[m], K);
    part_acts(model, a, end, lower, along[m], K);
    part_acts(model, a, end, upper + 1, -closing[m], K);
    part_acts(model, a, end, lower + 1, closing[m], K);
  }
}

/* The suction on station k goes with the head, with its own gap, and where the bead ends with the part. */
static void suction_at(const ZpModel *model, const ZpAssembly *a, const ZpEval *e, const End *end, double head,
                       size_t k, ZpBand *K) {
  const ZpTopology *t = &model->topology;
  size_t i = zp_bead_station(&model->film, end->half, k), wet = k > end->at.k ? end->at.near : i;
  double w = model->film.w, share = wet_share(model, end, k), gap = e->plates.gap[i];
  double bend = -w * head * share * zp_film_bend(&model->film, gap), slope = rise(model, e, i);
  zp_assemble_heights(a, i, bend, bend, 0, K);
  zp_assemble_entry(a, 2 * zp_upper(t, i) + 1, 2 * zp_lower(t, i) + 1, -bend, K);
  zp_assemble_entry(a, 2 * zp_lower(t, i) + 1, 2 * zp_upper(t, i) + 1, -bend, K);
  at_gap(model, a, own_of(wet, HEAD), i, true, -w * share * slope * head_scale, K);
  if (i != end->at.near && i != end->at.far) return;
  double by_part = is_below(end)       ? end->length
                   : i == end->at.near ? end->length * (1 - end->at.part)
                                       : end->length * end->at.part;
  part_acts(model, a, end, 2 * zp_upper(t, i) + 1, w * head * slope * by_part, K);
  part_acts(model, a, end, 2 * zp_lower(t, i) + 1, -w * head * slope * by_part, K);
}

static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *a, ZpEval *e, ZpBand *K) {
  if (!zp_span_is_still(span) || a->own == 0) return;
  for (int half = 0; half < zp_beads(&model->film); half++) {
    End end = end_of(model, span->end, e, half);
    double head = head_of(model, span->U1, &end);
    areas(model, a, e, half, K);
    heads(model, a, e, span->U1, &end, K);
    if (!end.ends) continue;
    attraction(model, a, e, span->U1, &end, K);
    for (size_t k = 0; draws(model, span) && k <= last_of(model, &end); k++)
      suction_at(model, a, e, &end, head, k, K);
  }
}

/* Of the head's part. */
static void by_voltage(const ZpModel *model, const ZpSpan *span, ZpEval *e, ZpByVoltage *sum) {
  if (!draws(model, span)) return;
  for (int half = 0; half < zp_beads(&model->film); half++) {
    End end = end_of(model, span->end, e, half);
    double charge = zp_plates_law(&model->plates, span->U1, end.g).q - zp_plates_law(&model->air, span->U1, end.g).q;
    double follows = share_that_follows(model, span->U1, &end);
    add_head(model, e, &end, -follows * model->bead.suction * charge * end.level / (model->film.w * end.H), sum->force);
  }
}

const ZpTerm zp_term_bead = {
    .name = "bead", .acts = acts, .force = force, .stiffness = stiffness, .by_voltage = by_voltage};
