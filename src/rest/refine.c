/* Letters: u place along a half, in elements; t the same from the first station of an interpolation. */
#include "rest/refine.h"

#include <math.h>
#include <string.h>

/* -- places ---------------------------------------------------------------------------------------- */

/* Stations, or edges by their left stations, of a half: from the left end, or from the platform on. */
typedef struct Half {
  size_t first, elements;
} Half;

static Half half_of(const ZpTopology *t, size_t half) {
  if (half == 0) return (Half){0, t->platform.first};
  return (Half){t->platform.last, t->stations - 1 - t->platform.last};
}

/* Weights of values at successive stations, of which some are 0. */
enum { POINTS = 4 };
typedef struct Place {
  size_t first, count;
  double weight[POINTS];
} Place;

/* The station before u, from which on there are `span` elements. */
static size_t before(Half half, double u, size_t span) {
  const size_t i = (size_t)u;
  return i + span > half.elements ? half.elements - span : i;
}

static Place linear(Half half, double u) {
  if (half.elements == 0) return (Place){half.first, 1, {1}};
  const size_t i = before(half, u, 1);
  const double t = u - (double)i;
  return (Place){half.first + i, 2, {1 - t, t}};
}

/* Lagrange's polynomial through four stations. */
static Place cubic(Half half, double u) {
  if (half.elements < POINTS - 1) return linear(half, u);
  const size_t i = before(half, fmax(u - 1, 0), POINTS - 1);
  const double a = u - (double)i, b = a - 1, c = a - 2, d = a - 3;
  return (Place){half.first + i, POINTS, {-b * c * d / 6, a * c * d / 2, -a * b * d / 2, a * b * c / 6}};
}

/* Of `values` at all stations, or at the nodes of one of so many ribbons. */
static double value_at(Place place, const double *values, size_t ribbons) {
  double sum = 0;
  for (size_t k = 0; k < place.count; k++)
    sum += place.weight[k] * values[ribbons * (place.first + k)];
  return sum;
}

/* Beside closed faces a cubic would let them overlap. */
static Place place_of(const ZpRestMember *m, Half half, double u) {
  const Place curved = cubic(half, u), straight = linear(half, u);
  if (!m->model->field || half.elements == 0) return curved;
  const double *gap = m->eval.plates.gap;
  return value_at(curved, gap, 1) < fmin(gap[straight.first], gap[straight.first + 1]) ? straight : curved;
}

/* -- states ---------------------------------------------------------------------------------------- */

static void refine_nodes(const ZpRestMember *m, ZpRestMember *other, Half from, Half to) {
  const size_t s = m->model->s;
  for (size_t i = 0; i <= to.elements; i++) {
    const double u = to.elements > 0 ? (double)(i * from.elements) / (double)to.elements : 0;
    const Place place = place_of(m, from, u);
    for (size_t c = 0; c < 2; c++)
      for (size_t ribbon = 0; ribbon < s; ribbon++)
        zp_coordinate(other->model, other->q, c)[s * (to.first + i) + ribbon] =
            value_at(place, zp_coordinate(m->model, m->q, c) + ribbon, s);
    for (size_t ribbon = 0; zp_is_in_space(m->model) && ribbon < s; ribbon++)
      zp_axis(other->model, other->q, ZP_AXIS_Z)[s * (to.first + i) + ribbon] =
          value_at(place, zp_read_axis(m->model, m->q, ZP_AXIS_Z) + ribbon, s);
  }
}

/* From the middles of elements to others. */
static void refine_tensions(const ZpRestMember *m, ZpRestMember *other, Half from, Half to) {
  const size_t s = m->model->s;
  const Half edges = {from.first, from.elements - 1};
  for (size_t i = 0; i < to.elements; i++) {
    const double u = ((double)i + 0.5) * (double)from.elements / (double)to.elements - 0.5;
    const Place place = linear(edges, fmin(fmax(u, 0), (double)edges.elements));
    for (size_t ribbon = 0; ribbon < s; ribbon++)
      other->tension[s * (to.first + i) + ribbon] = value_at(place, m->tension + ribbon, s);
    for (size_t ribbon = 0; zp_is_in_space(m->model) && ribbon < s; ribbon++)
      zp_axis(other->model, other->q, ZP_AXIS_ROLL)[s * (to.first + i) + ribbon] =
          value_at(place, zp_read_axis(m->model, m->q, ZP_AXIS_ROLL) + ribbon, s);
  }
}

static void refine_member(const ZpRestMember *m, ZpRestMember *other) {
  const ZpTopology *t = &m->model->topology, *to = &other->model->topology;
  for (size_t half = 0; half < zp_halves(t); half++) {
    refine_nodes(m, other, half_of(t, half), half_of(to, half));
    if (zp_half_elements(t) > 0) refine_tensions(m, other, half_of(t, half), half_of(to, half));
  }
  if (zp_platform_turns(t)) /* between its ends */
    other->tension[zp_lower(to, to->platform.first)] = m->tension[zp_lower(t, t->platform.first)];
  other->tension[zp_pressure_place(other->model)] = m->tension[zp_pressure_place(m->model)];
  other->closed = m->closed;
}

/* With its voltage, load and opening. */
static void refine(const ZpStatics *at, ZpStatics *other) {
  for (size_t k = 0; k < at->members; k++)
    refine_member(&at->member[k], &other->member[k]);
  other->U = at->U;
  other->load = at->load;
  other->bias = at->bias;
  other->opening = at->opening;
  other->contact_acts = at->contact_acts;
  if (at->plane.bodies > 0) {
    memcpy(other->pose, at->pose, at->plane.bodies * sizeof *at->pose);
    memcpy(other->links.pull, at->links.pull, at->model->network->joints * sizeof *at->links.pull);
  }
  zp_statics_rejoin(other);
}

bool zp_refine_rest(const ZpStatics *at, ZpRest *other) {
  enum { MOST = 8 };
  refine(at, &other->statics);
  if (!zp_newton_good(zp_statics_solve(&other->statics, MOST).end)) return false;
  zp_quasistatic_start(other);
  return true;
}

/* -- limits ---------------------------------------------------------------------------------------- */

/* The gap that closes last, of a limit point that of the first mesh, else as the system hangs. NAN: it does not. */
static double refine_gap(ZpRest *at, const ZpLimit *limit, const double *hangs, ZpRest *other) {
  if (limit->end == ZP_TRACK_FOLD) zp_rest_go_to(at, limit->state);
  if (limit->end == ZP_TRACK_FOLD) return zp_closing_gap(&at->statics, NULL);
  zp_rest_go_to(at, hangs);
  return zp_refine_rest(&at->statics, other) ? other->track.limit : (double)NAN;
}

/* Faces that the first steps press into each other leave each other by a third of their overlap a step. */
static bool go_to_gap(ZpFold *fold, double gap) {
  enum { MOST = 4 };
  bool found = false;
  for (int k = 0; k < MOST && !found; k++)
    found = zp_fold_event(fold, zp_closing_gap, gap, ZP_FOLD_ROUGH);
  return found;
}

static double larger(double a, double b) {
  return fabs(b) > fabs(a) ? b : a;
}

double zp_refine_limit(ZpRest *at, const ZpLimits *limits, ZpLimitKind kind, ZpRest *other) {
  const ZpLimit *limit = &limits->limit[kind];
  const bool load = kind == ZP_LIMIT_LOAD;
  const double *value = load ? &other->statics.load : &other->statics.U;
  ZpFold *fold = &other->track.fold;
  if (limit->end != ZP_TRACK_FOLD && limit->end != ZP_TRACK_EVENT) return NAN;
  const double gap = refine_gap(at, limit, load ? limits->hung : limits->start, other);
  if (isnan(gap)) return NAN;
  zp_rest_go_to(at, limit->state);
  refine(&at->statics, &other->statics);
  fold->system = load ? &other->load : &other->square;
  const double before = *value;
  if (!go_to_gap(fold, gap)) return NAN;
  const double change = *value - before;
  if (limit->end == ZP_TRACK_EVENT) return change;
  zp_fold_guess(fold);
  return zp_fold_solve(fold) ? larger(change, *value - before) : change;
}
