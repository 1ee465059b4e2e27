/* Letters as in film.h; 0 and 1 are the step's start and end, h its length. Kinetic energies are those of momenta,
 * rho H u^2 / 2 and rho E b^2 / (2 kappa^2), linear in H and E, so that their discrete gradients are
 *   flow  H_mean u,   force on H  -rho (u0^2 + u1^2) / 4,
 * exactly. In place of the mean of u0 and u1 stands u0 + theta (u1 - u0), theta from 1/2 without viscosity to 1 where
 * it rules: of second order, what is damped goes to 0 as 1 / (1 + 2 B + 2 B^2), and the energy that this takes is lost
 * to viscosity. */
#include "liquid/film.h"

#include <math.h>

#include "base/kernel.h"
#include "math/elementary.h"

static const double give = 1e-6;                    /* m/Pa: a cavity as thick as a millimetre takes 1 % more */
static const double shortest = 1e-3;                /* of an element: what flows past a meniscus is led so far */
static const double isolated = 2.35619449019234493; /* 3 pi / 4: r / (H / w) of strips far from each other */

void zp_film_modes(ZpFilmParams *p, bool lateral_flow) {
  static const double lowest = 0.81056946913870217, pi2 = 9.8696044010893586,
                      others = 157.141777614258; /* 8 / pi^2; a_1 / (1/12 - a_0 / pi^2) */
  double w2 = p->w * p->w;
  p->share[0] = lateral_flow ? lowest : 1;
  p->share[1] = 1 - p->share[0];
  p->kappa2[0] = lateral_flow ? pi2 / w2 : 0;
  p->kappa2[1] = lateral_flow ? others / w2 : 0;
  p->outlet = !lateral_flow;
  p->vent[0] = p->platform;
  p->vent[1] = p->platform_end;
  p->breadth = p->w;
}

/* tanh(x) / x. */
static double tanh_over(double x) {
  double back = 1 + zp_decay(2 * x);
  return (1 - back) / ((1 + back) * x);
}

void zp_film_plate_modes(ZpFilmParams *p, double length, bool lateral_flow) {
  enum { LAST = 99 }; /* of the series, whose terms fall as the fourth power */
  static const double pi4 = 97.409091034002437;
  const double b = lateral_flow ? fmin(p->w, length) : length, L = lateral_flow ? fmax(p->w, length) : INFINITY,
               per_mode = 0.5 * zp_pi * L / b;
  double all = 0;
  zp_film_modes(p, true);
  for (int n = 1; n <= LAST; n += 2)
    all += 8 / (pi4 * n * n * n * n) * (1 - tanh_over(n * per_mode));
  double lowest = p->share[0] / (zp_pi * zp_pi) * (1 - tanh_over(per_mode));
  p->kappa2[0] = p->share[0] / (lowest * b * b);
  p->kappa2[1] = p->share[1] / ((all - lowest) * b * b);
  p->breadth = lateral_flow ? p->w * length / (p->w + length) : length;
}

double zp_film_viscosity(const ZpFilmParams *p, double H) {
  const double mu = p->mu / (1 + 6 * p->free_path / H);
  if (!(p->floor.opening > 0)) return mu;
  const double gap = H * H * H * p->floor.width,
               below = 2 * p->floor.opening * p->floor.opening * p->floor.opening * p->w;
  return mu * (4 * gap + below) / (gap + below);
}

void zp_film_reserve(const ZpFilmParams *p, ZpFilmEval *e, ZpArena *arena) {
  double **stations[] = {&e->rate,     &e->middle, &e->H0,    &e->H1,   &e->secant, &e->depth0, &e->depth1, &e->jet,
                         &e->coupling, &e->head,   &e->grows, &e->held, &e->force,  &e->flat,   &e->given};
  double **modes[] = {&e->flow, &e->conductance, &e->leak, &e->leak_conductance, &e->r};
  for (size_t k = 0; k < sizeof stations / sizeof stations[0]; k++)
    *stations[k] = zp_arena_take(arena, p->nodes);
  for (size_t k = 0; k < sizeof modes / sizeof modes[0]; k++)
    *modes[k] = zp_arena_take(arena, ZP_FILM_MODES * p->nodes);
  e->end = zp_arena_take(arena, ZP_FILM_STATE * p->nodes);
  e->piece = zp_arena_take_of(arena, p->nodes, sizeof *e->piece);
  e->out = zp_arena_take(arena, 2);
}

/* -- geometry -------------------------------------------------------------------------------------- */

ZP_INLINE double root_of(double roughness, double gap) {
  return sqrt(gap * gap + 4 * roughness * roughness);
}

/* A smooth transition from g, far above the roughness, to nothing, far below 0. */
ZP_INLINE double thickness_of(double roughness, double gap) {
  double S = root_of(roughness, gap), below = 2 * roughness * roughness / (S - gap);
  return gap > 0 ? 0.5 * (gap + S) : S > gap ? below : 0;
}

static double root(const ZpFilmParams *p, double gap) {
  return root_of(p->roughness, gap);
}

double zp_film_thickness(const ZpFilmParams *p, double gap) {
  return thickness_of(p->roughness, gap);
}

double zp_film_rise(const ZpFilmParams *p, double gap) {
  double S = root(p, gap);
  return S > 0 ? 0.5 * (1 + gap / S) : 0.5;
}

double zp_film_bend(const ZpFilmParams *p, double gap) {
  double S = root(p, gap);
  return S > 0 ? 2 * p->roughness * p->roughness / (S * S * S) : 0;
}

ZP_INLINE double depth_of(double width, double H) {
  double q = H / width;
  return H / (isolated * q + 1 / (1 + 1.066 * q * sqrt(q)));
}

double zp_film_depth(const ZpFilmParams *p, double H) {
  return depth_of(p->breadth, H);
}

/* Length of the element from station i on, m: the platform's counts at its stations. */
static double element(const ZpFilmParams *p, size_t i) {
  return i + 1 == p->nodes || (i >= p->platform && i < p->platform_end) ? 0 : p->l;
}

static bool is_platform(const ZpFilmParams *p, size_t i) {
  return i >= p->platform && i <= p->platform_end;
}

double zp_film_length(const ZpFilmParams *p, size_t i) {
  double beside = (i > 0 ? element(p, i - 1) : 0) + element(p, i);
  return 0.5 * beside + (is_platform(p, i) ? p->flat_length : 0);
}

/* -- where liquid is ------------------------------------------------------------------------------- */

/* Is the element beyond the platform, and wet from its right end on? */
static bool from_right(const ZpFilmParams *p, size_t i) {
  return i >= p->platform_end;
}

/* Which half station i is of. */
static int half_of(const ZpFilmParams *p, size_t i) {
  return p->platform_end > p->platform && i >= p->platform_end;
}

static bool is_wet(const ZpFilmParams *p, const ZpCover *cover, size_t i) {
  if (half_of(p, i)) return i + 1 == p->nodes || zp_cover_part(cover, i) >= 1;
  return i == 0 || zp_cover_part(cover, i - 1) >= 1;
}

ZpFilmPiece zp_film_piece(double l, double part, bool right) {
  double far = part * l, a = part < 1 ? 0.5 * far : 0.5 * l, second = a * a / (2 * l);
  ZpFilmPiece piece = {.length = fmax(far, shortest * l), .mean = {1 - 0.5 * part, 0.5 * part}};
  piece.cell[0][0] = a - second;
  piece.cell[0][1] = second;
  if (part < 1) {
    piece.tip[0] = far - far * far / (2 * l) - piece.cell[0][0];
    piece.tip[1] = far * far / (2 * l) - piece.cell[0][1];
  } else {
    piece.cell[1][0] = second;
    piece.cell[1][1] = a - second;
  }
  if (!right) return piece;
  return (ZpFilmPiece){.length = piece.length,
                       .mean = {piece.mean[1], piece.mean[0]},
                       .cell = {{piece.cell[1][1], piece.cell[1][0]}, {piece.cell[0][1], piece.cell[0][0]}},
                       .tip = {piece.tip[1], piece.tip[0]}};
}

static ZpFilmPiece piece_of(const ZpFilmParams *p, const ZpCover *cover, size_t i) {
  double l = element(p, i), part = l > 0 ? zp_cover_part(cover, i) : 0;
  return part > 0 ? zp_film_piece(l, part, from_right(p, i)) : (ZpFilmPiece){0};
}

static double flat(const ZpFilmParams *p, const ZpCover *cover, size_t i) {
  return is_platform(p, i) ? p->flat_length * (cover ? cover->flat[half_of(p, i)] : 1) : 0;
}

/* Length of a station's cell in the two pieces beside it and in its flat faces, m. */
static double length_between(const ZpFilmPiece *left, const ZpFilmPiece *right, double flat_length) {
  return left->cell[1][0] + left->cell[1][1] + right->cell[0][0] + right->cell[0][1] + flat_length;
}

/* The head that is given at station i, Pa: where there is no liquid, beside a meniscus below the platform, at a
 * vent. */
static double given_head(const ZpFilmParams *p, const ZpFilmEnds *ends, size_t i) {
  int half = half_of(p, i);
  if (!is_wet(p, ends->cover, i)) return 0;
  if (is_platform(p, i) && ends->cover && ends->cover->flat[half] < 1) return ends->head[half];
  return p->outlet && i >= p->vent[0] && i <= p->vent[1] ? 0 : NAN;
}

static void lay_pieces(const ZpFilmParams *p, const ZpFilmEnds *ends, const ZpFilmEval *e) {
  for (size_t i = 0; i < p->nodes; i++) {
    e->piece[i] = piece_of(p, ends->cover, i);
    e->flat[i] = flat(p, ends->cover, i);
    e->given[i] = given_head(p, ends, i);
  }
}

static const ZpFilmPiece none = {0};

static const ZpFilmPiece *left_of(const ZpFilmEval *e, size_t i) {
  return i > 0 ? &e->piece[i - 1] : &none;
}

double zp_film_wet(const ZpFilmEval *e, size_t i) {
  return length_between(left_of(e, i), &e->piece[i], e->flat[i]);
}

/* Weight of the thickness at station j, i - 1 .. i + 1, in the cell of station i, m: half of each element beside it. */
static double cell_share(const ZpFilmEval *e, size_t i, size_t j) {
  if (i != j) return j < i ? e->piece[j].cell[1][0] : e->piece[i].cell[0][1];
  return left_of(e, i)->cell[1][1] + e->piece[i].cell[0][0] + e->flat[i];
}

/* The integral of what is linear between stations over the cell of station i: half of each element beside it. */
static double over_cell(const ZpFilmParams *p, const ZpFilmEval *e, const double *x, size_t i) {
  double sum = cell_share(e, i, i) * x[i];
  if (i > 0) sum += cell_share(e, i, i - 1) * x[i - 1];
  if (i + 1 < p->nodes) sum += cell_share(e, i, i + 1) * x[i + 1];
  return sum;
}

/* Force of the heads of cells and menisci on the thickness at station i, over w, N/m. */
static double pressed(const ZpFilmParams *p, const ZpFilmEnds *ends, const ZpFilmEval *e, size_t i) {
  double sum = cell_share(e, i, i) * e->head[i];
  if (i > 0)
    sum += left_of(e, i)->cell[0][1] * e->head[i - 1] + left_of(e, i)->tip[1] * ends->head[from_right(p, i - 1)];
  if (i + 1 < p->nodes)
    sum += e->piece[i].cell[1][0] * e->head[i + 1] + e->piece[i].tip[0] * ends->head[from_right(p, i)];
  return sum;
}

/* Does mode k have an equation at station i? */
bool zp_film_is_free(const ZpFilmParams *p, const ZpFilmEval *e, size_t i, int k) {
  return p->share[k] > 0 && isnan(e->given[i]);
}

/* -- momentum -------------------------------------------------------------------------------------- */

/* One momentum over a step, in a film that is `thick` in its middle. */
typedef struct Momentum {
  double theta;
  double inertia; /* of the momentum's mean, and what resists to it, kg/m^3 */
} Momentum;

/* `depth` is H or E, the mean over the step. A flow that begins because a bead has just arrived does so at once: theta
 * is 1. With 1/2, a flow that the gap's motion prescribes would begin twice as large and reverse in every step. */
static Momentum momentum_of(const ZpFilmParams *p, double thick, double depth, double h, bool begins) {
  double B = 6 * zp_film_viscosity(p, thick) * h, inertia = p->rho * thick * thick,
         theta = begins ? 1 : 0.5 * (1 + B / (B + inertia));
  return (Momentum){theta, p->rho + 2 * theta * B * depth / (thick * thick * thick)};
}

static double mean(const double *x0, const double *x1, size_t i) {
  return 0.5 * (x0[i] + x1[i]);
}

/* For the wet part of the element from station i on: predicted thickness in the middle, and mean thickness. */
static double element_middle(const ZpFilmEval *e, size_t i) {
  return e->piece[i].mean[0] * e->middle[i] + e->piece[i].mean[1] * e->middle[i + 1];
}

static double element_mean(const ZpFilmEval *e, size_t i) {
  return e->piece[i].mean[0] * mean(e->H0, e->H1, i) + e->piece[i].mean[1] * mean(e->H0, e->H1, i + 1);
}

/* Where the state has u_k, and b_k, of station i, and the cavity. */
static size_t along_at(size_t i, int k) {
  return ZP_FILM_STATE * i + (size_t)k;
}

static size_t across_at(size_t i, int k) {
  return ZP_FILM_STATE * i + ZP_FILM_MODES + (size_t)k;
}

static size_t cavity_at(size_t i) {
  return ZP_FILM_STATE * i + ZP_FILM_CAVITY;
}

/* The film's end within an element: liquid that passes it carries its kinetic energy away, and liquid that is drawn
 * back brings none. */
typedef struct Tip {
  bool is_left, is_right; /* the station there has no liquid */
  double head, per_speed; /* Pa; what it takes beyond that per mean speed, Pa s/m */
} Tip;

static Tip tip_of(const ZpFilmParams *p, const ZpFilmEnds *ends, const ZpFilmEval *e, size_t i, double u) {
  bool right = from_right(p, i);
  if (!(e->piece[i].length < p->l)) return (Tip){0};
  return (Tip){right, !right, ends->head[right], 0.5 * p->rho * fmax(right ? -u : u, 0)};
}

static void flow_along(const ZpFilmParams *p, const ZpFilmEnds *ends, size_t i, int k, double h, const double *start,
                       const double *heads, const ZpFilmEval *e) {
  size_t at = zp_film_mode_at(i, k), u = along_at(i, k);
  double H = element_mean(e, i), length = e->piece[i].length;
  Momentum m = momentum_of(p, element_middle(e, i), H, h, ends->cover && start[u] == 0);
  Tip tip = tip_of(p, ends, e, i, start[u]);
  double left = tip.is_left ? tip.head : heads[at], right = tip.is_right ? tip.head : heads[at + ZP_FILM_MODES];
  double inertia = m.inertia + m.theta * h * tip.per_speed / length;
  double u_mean = (p->rho * start[u] + m.theta * h * (left - right) / length) / inertia;
  e->flow[at] = H * u_mean;
  e->conductance[at] = H * m.theta * h / (length * inertia);
  e->end[u] = start[u] + (u_mean - start[u]) / m.theta;
}

/* Where no liquid is nothing flows. */
static void no_flow_along(size_t i, int k, const ZpFilmEval *e) {
  e->flow[zp_film_mode_at(i, k)] = e->conductance[zp_film_mode_at(i, k)] = e->end[along_at(i, k)] = 0;
}

/* The share of the long edges there through which liquid can pass. */
static double open_share(const ZpFilmEnds *ends, const ZpFilmEval *e, size_t i) {
  if (!(zp_film_wet(e, i) > 0)) return 0;
  return ends->open ? ends->open[i] : 1;
}

/* Across open edges if inertia does not count, m/(s Pa). */
static double viscous_conductance(const ZpFilmParams *p, const ZpFilmEval *e, size_t i, int k) {
  double H = e->middle[i];
  return H * H * H / (12 * zp_film_viscosity(p, H)) * p->kappa2[k];
}

/* If only a part of the edges has liquid, it flows in so slowly that its inertia does not count. */
static void flow_in(const ZpFilmParams *p, size_t i, double share, const double *heads, const ZpFilmEval *e) {
  e->jet[i] = e->coupling[i] = 0;
  for (int k = 0; k < ZP_FILM_MODES; k++) {
    size_t at = zp_film_mode_at(i, k);
    e->leak_conductance[at] = share > 0 ? share * viscous_conductance(p, e, i, k) : 0;
    e->leak[at] = e->leak_conductance[at] * heads[at];
    e->end[across_at(i, k)] = 0;
  }
}

/* The flow out at the long edges is linear in the heads except for the jets, D = rho v^2 / 2 at speed v outwards:
 * together v + C rho v^2 / 2 = A. */
static void flow_across(const ZpFilmParams *p, const ZpFilmEnds *ends, size_t i, double h, const double *start,
                        const double *heads, const ZpFilmEval *e) {
  double E = mean(e->depth0, e->depth1, i), per_speed = 0.5 * p->breadth / mean(e->H0, e->H1, i), A = 0, C = 0;
  Momentum m = momentum_of(p, e->middle[i], E, h, ends->cover && start[across_at(i, 0)] == 0);
  for (int k = 0; k < ZP_FILM_MODES; k++) {
    size_t at = zp_film_mode_at(i, k);
    e->leak_conductance[at] = E * m.theta * h * p->kappa2[k] / m.inertia;
    e->leak[at] =
        p->kappa2[k] > 0 ? E * p->rho * start[across_at(i, k)] / m.inertia + e->leak_conductance[at] * heads[at] : 0;
    A += per_speed * p->share[k] * e->leak[at];
    C += per_speed * p->share[k] * e->leak_conductance[at];
  }
  double v = A > 0 ? 2 * A / (1 + sqrt(1 + 2 * p->rho * A * C)) : A, out = fmax(v, 0);
  e->jet[i] = v;
  e->coupling[i] = per_speed * p->rho * out / (1 + p->rho * C * out);
  for (int k = 0; k < ZP_FILM_MODES; k++) {
    size_t b = across_at(i, k);
    e->leak[zp_film_mode_at(i, k)] -= e->leak_conductance[zp_film_mode_at(i, k)] * 0.5 * p->rho * out * out;
    e->end[b] = start[b] + (e->leak[zp_film_mode_at(i, k)] / E - start[b]) / m.theta;
  }
}

/* -- a step ---------------------------------------------------------------------------------------- */

/* The thickness foreseen in the middle of the step changes as in the last one, but is at least half of that at the
 * start. */
ZP_KERNEL static void thicknesses(size_t nodes, double roughness, double width, const double *restrict g0,
                                  const double *restrict g1, const double *restrict rate, double h,
                                  const ZpFilmEval *e) {
  double *restrict middle = e->middle, *restrict H0 = e->H0, *restrict H1 = e->H1;
  double *restrict depth0 = e->depth0, *restrict depth1 = e->depth1, *restrict secant = e->secant;
  ZP_SIMD
  for (size_t i = 0; i < nodes; i++) {
    double start = thickness_of(roughness, g0[i]), end = thickness_of(roughness, g1[i]);
    double foreseen = thickness_of(roughness, g0[i] + 0.5 * h * rate[i]), half = 0.5 * start;
    double both = root_of(roughness, g0[i]) + root_of(roughness, g1[i]), mean = 0.5 * (1 + (g0[i] + g1[i]) / both);
    H0[i] = start;
    H1[i] = end;
    middle[i] = foreseen > half ? foreseen : half;
    depth0[i] = depth_of(width, start);
    depth1[i] = depth_of(width, end);
    secant[i] = both > 0 ? mean : 0.5;
  }
}

static void geometry(const ZpFilmParams *p, const ZpFilmEnds *ends, const double *g0, const double *g1, double h,
                     const ZpFilmEval *e) {
  lay_pieces(p, ends, e);
  thicknesses(p->nodes, p->roughness, p->breadth, g0, g1, e->rate, h, e);
}

static double mean_head(const ZpFilmParams *p, const double *heads, size_t i) {
  return p->share[0] * heads[zp_film_mode_at(i, 0)] + p->share[1] * heads[zp_film_mode_at(i, 1)];
}

/* Below minus zp_film_tension a cavity grows, so that its head hardly falls further. */
static bool cavitates(double head) {
  return head < -zp_film_tension;
}

/* Is there a cavity after `before`, one or none? One so thin that it is below the rounding of the heads stays. */
static bool cavitates_on(const ZpFilmParams *p, const double *heads, size_t i, bool before) {
  static const double digits = 16 * 2.2e-16;
  double sizes = zp_film_tension + p->share[0] * fabs(heads[zp_film_mode_at(i, 0)]) +
                 p->share[1] * fabs(heads[zp_film_mode_at(i, 1)]);
  return cavitates(mean_head(p, heads, i) - (before ? digits * sizes : 0));
}

static double cavity_of(double head, bool grows) {
  return grows ? give * (-zp_film_tension - head) : 0;
}

/* Is there a cavity at the last residual? */
static bool grows(const ZpFilmEval *e, size_t i) {
  return e->grows[i] > 0;
}

static void cavities(const ZpFilmParams *p, const double *heads, const ZpFilmEval *e) {
  for (size_t i = 0; i < p->nodes; i++) {
    e->head[i] = mean_head(p, heads, i);
    e->grows[i] = e->held[i] == 0 ? cavitates_on(p, heads, i, grows(e, i)) : e->held[i] > 0;
    e->end[cavity_at(i)] = fmax(cavity_of(e->head[i], grows(e, i)), e->held[i] == 0 ? 0 : -INFINITY);
  }
}

void zp_film_begin(const ZpFilmParams *p, const double *start, const ZpFilmEval *e) {
  for (size_t i = 0; i < p->nodes; i++)
    e->grows[i] = start[cavity_at(i)] > 0;
}

void zp_film_release(const ZpFilmParams *p, const ZpFilmEval *e) {
  for (size_t i = 0; i < p->nodes; i++)
    e->held[i] = 0;
}

static bool contradicts(const ZpFilmParams *p, const double *heads, const ZpFilmEval *e, size_t i) {
  return zp_film_wet(e, i) > 0 && cavitates_on(p, heads, i, grows(e, i)) != grows(e, i);
}

size_t zp_film_contradictions(const ZpFilmParams *p, const double *heads, const ZpFilmEval *e) {
  size_t count = 0;
  for (size_t i = 0; i < p->nodes; i++)
    count += contradicts(p, heads, e, i);
  return count;
}

void zp_film_turn_one(const ZpFilmParams *p, const double *heads, const ZpFilmEval *e) {
  double *last = NULL;
  for (size_t i = 0; i < p->nodes; i++) {
    bool holds = contradicts(p, heads, e, i);
    e->held[i] = !holds ? 0 : grows(e, i) ? 1 : -1;
    if (holds) last = &e->held[i];
  }
  if (last) *last = 0;
}

double zp_film_unforeseen(const ZpFilmParams *p, const double *heads, const ZpFilmEval *e) {
  double work = 0;
  for (size_t i = 0; i < p->nodes; i++) {
    double head = mean_head(p, heads, i), missed = cavity_of(head, cavitates(head)) - cavity_of(head, grows(e, i));
    work += p->w * zp_film_wet(e, i) * fabs(missed * head);
  }
  return work;
}

/* (E1 - E0) / (H1 - H0). */
static double depth_slope(const ZpFilmParams *p, const ZpFilmEval *e, size_t i) {
  static const double near = 1e-5; /* closer, the difference is rounding, the slope in the middle exact to its square */
  double H = mean(e->H0, e->H1, i), change = e->H1[i] - e->H0[i];
  if (fabs(change) > near * H) return (e->depth1[i] - e->depth0[i]) / change;
  return (zp_film_depth(p, H * (1 + near)) - zp_film_depth(p, H * (1 - near))) / (2 * near * H);
}

static double squares(const double *start, const double *end, size_t i) {
  return start[i] * start[i] + end[i] * end[i];
}

/* Part of the force on the thickness at station i that comes from the kinetic energies, over w, N/m. */
static double suction(const ZpFilmParams *p, const double *start, const ZpFilmEval *e, size_t i) {
  double slope = p->rho > 0 ? depth_slope(p, e, i) : 0, sum = 0;
  for (int k = 0; k < ZP_FILM_MODES; k++) {
    double along = 0, across = p->kappa2[k] > 0 ? squares(start, e->end, across_at(i, k)) / p->kappa2[k] : 0;
    const ZpFilmPiece *left = left_of(e, i), *right = &e->piece[i];
    if (i > 0) along += left->length * left->mean[1] * squares(start, e->end, along_at(i - 1, k));
    if (i + 1 < p->nodes) along += right->length * right->mean[0] * squares(start, e->end, along_at(i, k));
    sum += p->share[k] * (along + zp_film_wet(e, i) * slope * across) / 4;
  }
  return p->rho * sum;
}

/* The growth of what the cell of station i holds, m^2. */
static double grown(const ZpFilmParams *p, const double *rise, const double *start, const ZpFilmEval *e, size_t i) {
  return over_cell(p, e, rise, i) - zp_film_wet(e, i) * (e->end[cavity_at(i)] - start[cavity_at(i)]);
}

/* Outflow of a cell in mode k, m^2/s. */
static double outflow(const ZpFilmEval *e, size_t i, int k) {
  double sum = zp_film_wet(e, i) * e->leak[zp_film_mode_at(i, k)] + e->flow[zp_film_mode_at(i, k)];
  return i > 0 ? sum - e->flow[zp_film_mode_at(i - 1, k)] : sum;
}

static void flows(const ZpFilmParams *p, const ZpFilmEnds *ends, double h, const double *start, const double *heads,
                  const ZpFilmEval *e) {
  for (size_t i = 0; i < p->nodes; i++) {
    double share = open_share(ends, e, i);
    if (share >= 1)
      flow_across(p, ends, i, h, start, heads, e);
    else
      flow_in(p, i, share, heads, e);
    for (int k = 0; k < ZP_FILM_MODES; k++) {
      if (e->piece[i].length > 0)
        flow_along(p, ends, i, k, h, start, heads, e);
      else
        no_flow_along(i, k, e);
    }
  }
}

/* Volume that has left through the meniscus in the element from station i on, over w, m^2. */
static double past_tip(const ZpFilmParams *p, const double *rise, double h, const ZpFilmEval *e, size_t i) {
  const ZpFilmPiece *piece = &e->piece[i];
  double flow = p->share[0] * e->flow[zp_film_mode_at(i, 0)] + p->share[1] * e->flow[zp_film_mode_at(i, 1)];
  return h * (from_right(p, i) ? -flow : flow) - (piece->tip[0] * rise[i] + piece->tip[1] * rise[i + 1]);
}

/* Volume that has left the film at its ends: the volume missing in a cell whose head is given has passed its end. */
static void passed(const ZpFilmParams *p, const double *rise, double h, const double *start, const ZpFilmEval *e) {
  e->out[0] = e->out[1] = 0;
  for (size_t i = 0; i < p->nodes; i++) {
    double length = e->piece[i].length;
    if (length > 0 && length < p->l) e->out[from_right(p, i)] += p->w * past_tip(p, rise, h, e, i);
    if (isnan(e->given[i]) || !(zp_film_wet(e, i) > 0)) continue;
    for (int k = 0; k < ZP_FILM_MODES; k++)
      e->out[half_of(p, i)] -= p->w * p->share[k] * (grown(p, rise, start, e, i) + h * outflow(e, i, k));
  }
}

static void volumes(const ZpFilmParams *p, const double *rise, double h, const double *start, const double *heads,
                    const ZpFilmEval *e) {
  for (size_t i = 0; i < p->nodes; i++)
    for (int k = 0; k < ZP_FILM_MODES; k++) {
      size_t at = zp_film_mode_at(i, k);
      double given = isnan(e->given[i]) ? 0 : e->given[i];
      double volume = grown(p, rise, start, e, i) + h * outflow(e, i, k);
      e->r[at] = zp_film_is_free(p, e, i, k) ? p->share[k] * p->w * volume : given - heads[at];
    }
}

void zp_film_step(const ZpFilmParams *p, const ZpFilmEnds *ends, const double *g0, const double *g1, double h,
                  const double *start, const double *heads, const ZpFilmEval *e) {
  geometry(p, ends, g0, g1, h, e);
  cavities(p, heads, e);
  flows(p, ends, h, start, heads, e);
  double *rise = e->force; /* in its place until it is known */
  for (size_t i = 0; i < p->nodes; i++)
    rise[i] = e->secant[i] * (g1[i] - g0[i]);
  volumes(p, rise, h, start, heads, e);
  passed(p, rise, h, start, e);
  for (size_t i = 0; i < p->nodes; i++)
    e->force[i] = p->w * e->secant[i] * (pressed(p, ends, e, i) - suction(p, start, e, i));
}

/* -- energy ---------------------------------------------------------------------------------------- */

static double energy_of_cavity(double thickness) {
  return thickness * (zp_film_tension + 0.5 * thickness / give);
}

double zp_film_energy_among(const ZpFilmParams *p, const ZpCover *cover, const double *gap, const double *state,
                            size_t first, size_t end) {
  double sum = 0;
  ZpFilmPiece left = first > 0 ? piece_of(p, cover, first - 1) : none;
  for (size_t i = first; i < end; i++) {
    ZpFilmPiece piece = piece_of(p, cover, i);
    double H = zp_film_thickness(p, gap[i]), E = zp_film_depth(p, H), next = 0;
    double length = length_between(&left, &piece, flat(p, cover, i));
    if (i + 1 < p->nodes) next = piece.mean[0] * H + piece.mean[1] * zp_film_thickness(p, gap[i + 1]);
    for (int k = 0; k < ZP_FILM_MODES; k++) {
      double u = state[along_at(i, k)], b = state[across_at(i, k)], half = 0.5 * p->rho * p->share[k];
      sum += half * piece.length * next * u * u;
      if (p->kappa2[k] > 0) sum += half * length * E * b * b / p->kappa2[k];
    }
    sum += length * energy_of_cavity(state[cavity_at(i)]);
    left = piece;
  }
  return sum * p->w;
}

double zp_film_energy(const ZpFilmParams *p, const ZpCover *cover, const double *gap, const double *state) {
  return zp_film_energy_among(p, cover, gap, state, 0, p->nodes);
}

/* Loss of one momentum over the step, per length and width, J/m^2: by drag, and by theta beyond the mean. */
static double lost(const ZpFilmParams *p, double thick, double depth, double flow, double change, double h,
                   bool begins) {
  Momentum m = momentum_of(p, thick, depth, h, begins);
  return 12 * zp_film_viscosity(p, thick) * h * flow * flow / (thick * thick * thick) +
         p->rho * depth * (m.theta - 0.5) * change * change;
}

static double change(const double *start, const ZpFilmEval *e, size_t i) {
  return e->end[i] - start[i];
}

static double lost_by_cavity(const double *start, const ZpFilmEval *e, size_t i) {
  double before = start[cavity_at(i)], after = e->end[cavity_at(i)];
  return energy_of_cavity(before) - energy_of_cavity(after) - e->head[i] * (after - before);
}

/* Loss across, of mode k at station i. If the long edges are open only in part, inertia does not count, and the kinetic
 * energy at the start is lost. */
static double lost_across(const ZpFilmParams *p, const ZpFilmEnds *ends, double h, const double *start,
                          const ZpFilmEval *e, size_t i, int k) {
  double E = mean(e->depth0, e->depth1, i), b = start[across_at(i, k)];
  if (!(p->kappa2[k] > 0)) return 0;
  double share = open_share(ends, e, i), H = e->middle[i], leak = e->leak[zp_film_mode_at(i, k)];
  double stops = 0.5 * p->rho * E * b * b / p->kappa2[k];
  if (share < 1)
    return stops +
           (share > 0 ? 12 * zp_film_viscosity(p, H) * h * leak * leak / (share * H * H * H * p->kappa2[k]) : 0);
  return lost(p, e->middle[i], E, e->leak[zp_film_mode_at(i, k)], change(start, e, across_at(i, k)), h,
              ends->cover && start[across_at(i, 0)] == 0) /
         p->kappa2[k];
}

static double lost_along(const ZpFilmParams *p, const ZpFilmEnds *ends, double h, const double *start,
                         const ZpFilmEval *e, size_t i, int k) {
  if (!(e->piece[i].length > 0)) return 0;
  return lost(p, element_middle(e, i), element_mean(e, i), e->flow[zp_film_mode_at(i, k)],
              change(start, e, along_at(i, k)), h, ends->cover && start[along_at(i, k)] == 0);
}

/* Loss by liquid that passes the film's end in element i, over w and the share of the mode, J/m. */
static double carried(const ZpFilmParams *p, const ZpFilmEnds *ends, double h, const double *start, const ZpFilmEval *e,
                      size_t i, int k) {
  if (!(e->piece[i].length > 0)) return 0;
  double flow = e->flow[zp_film_mode_at(i, k)];
  return h * flow * flow * tip_of(p, ends, e, i, start[along_at(i, k)]).per_speed / element_mean(e, i);
}

ZpFilmLoss zp_film_loss(const ZpFilmParams *p, const ZpFilmEnds *ends, double h, const double *start,
                        const ZpFilmEval *e) {
  ZpFilmLoss sum = {0};
  for (size_t i = 0; i < p->nodes; i++) {
    double length = p->w * zp_film_wet(e, i), H = mean(e->H0, e->H1, i), out = fmax(e->jet[i], 0);
    for (int k = 0; k < ZP_FILM_MODES; k++) {
      sum.across += length * p->share[k] * lost_across(p, ends, h, start, e, i, k);
      if (i + 1 == p->nodes) continue;
      sum.along += p->w * e->piece[i].length * p->share[k] * lost_along(p, ends, h, start, e, i, k);
      sum.carried += p->w * p->share[k] * carried(p, ends, h, start, e, i, k);
    }
    sum.jets += length * (h * p->rho * out * out * out * H / p->breadth + lost_by_cavity(start, e, i));
  }
  for (int half = 0; half < 2; half++)
    sum.given += ends->head[half] * e->out[half];
  return sum;
}

double zp_film_edge_flow(const ZpFilmParams *p, const ZpFilmEval *e, size_t i) {
  return p->w * zp_film_wet(e, i) *
         (p->share[0] * e->leak[zp_film_mode_at(i, 0)] + p->share[1] * e->leak[zp_film_mode_at(i, 1)]);
}

double zp_film_open_flow(const ZpFilmParams *p, const ZpFilmEval *e, const double *heads, size_t i) {
  double sum = 0;
  for (int k = 0; k < ZP_FILM_MODES; k++)
    sum += p->share[k] * viscous_conductance(p, e, i, k) * heads[zp_film_mode_at(i, k)];
  return p->w * zp_film_wet(e, i) * sum;
}

/* Is an element wet from end to end? A station's wet length does not tell, because it is a rounded sum. */
static bool is_full(const ZpFilmParams *p, const ZpFilmEval *e, size_t i) {
  return e->piece[i].length >= element(p, i);
}

bool zp_film_covers(const ZpFilmParams *p, const ZpFilmEval *e, size_t i) {
  double flat_length = is_platform(p, i) ? p->flat_length : 0;
  return (i == 0 || is_full(p, e, i - 1)) && is_full(p, e, i) && e->flat[i] >= flat_length;
}

bool zp_film_fills(const ZpFilmParams *p, const ZpFilmEval *e, size_t i) {
  return zp_film_covers(p, e, i) && !(e->end[cavity_at(i)] > 0);
}

/* -- derivatives ----------------------------------------------------------------------------------- */

/* Derivative of a cavity's volume per width by minus the mean head, m^2/Pa. */
static double given_way(const ZpFilmParams *p, const ZpFilmEval *e, size_t i) {
  return grows(e, i) && zp_film_is_free(p, e, i, 0) ? zp_film_wet(e, i) * give : 0;
}

double zp_film_mix(const ZpFilmParams *p, const ZpFilmEval *e, size_t i) {
  return given_way(p, e, i) > 0 ? p->share[1] / p->share[0] : 0;
}

double zp_film_turned(const ZpFilmParams *p, double h, const ZpFilmEval *e, size_t i, const double *r) {
  const double *own = &e->r[zp_film_mode_at(i, 0)];
  double mix = zp_film_mix(p, e, i), apart = p->share[1] * p->w * h * (outflow(e, i, 1) - outflow(e, i, 0));
  return mix > 0 ? apart + (r[1] - own[1]) - mix * (r[0] - own[0]) : r[1];
}

/* Derivative of -r of mode k by the head of mode m at the same station, without the cavity's. */
static double by_heads(const ZpFilmParams *p, double h, const ZpFilmEval *e, size_t i, int k, int m) {
  if (!zp_film_is_free(p, e, i, k) || !zp_film_is_free(p, e, i, m)) return k == m ? 1 : 0;
  double length = zp_film_wet(e, i), leak = p->share[k] * e->leak_conductance[zp_film_mode_at(i, k)], sum = 0;
  if (k == m) {
    sum = length * leak + p->share[k] * e->conductance[zp_film_mode_at(i, k)];
    if (i > 0) sum += p->share[k] * e->conductance[zp_film_mode_at(i - 1, k)];
  }
  sum -= length * e->coupling[i] * leak * p->share[m] * e->leak_conductance[zp_film_mode_at(i, m)];
  return -p->w * (h * sum);
}

double zp_film_own(const ZpFilmParams *p, double h, const ZpFilmEval *e, size_t i, int k, int m) {
  double mix = zp_film_mix(p, e, i), sum = by_heads(p, h, e, i, k, m);
  if (k == 0 && m == 0) return sum - p->w * p->share[0] * p->share[0] * given_way(p, e, i);
  if (mix == 0) return sum;
  if (k != m) return sum - mix * by_heads(p, h, e, i, 0, 0);
  return sum - 2 * mix * by_heads(p, h, e, i, 0, 1) + mix * mix * by_heads(p, h, e, i, 0, 0);
}

/* Derivative of -r of mode k by its head at the next station. */
static double by_next_head(const ZpFilmParams *p, double h, const ZpFilmEval *e, size_t i, int k) {
  if (!zp_film_is_free(p, e, i, k) || !zp_film_is_free(p, e, i + 1, k)) return 0;
  return p->share[k] * h * p->w * e->conductance[zp_film_mode_at(i, k)];
}

double zp_film_next(const ZpFilmParams *p, double h, const ZpFilmEval *e, size_t i, int k, int m) {
  double here = k == 1 ? -zp_film_mix(p, e, i) : 1, there = m == 1 ? -zp_film_mix(p, e, i + 1) : 1;
  double own = k == m && k == 1 ? by_next_head(p, h, e, i, 1) : 0;
  return own + here * there * by_next_head(p, h, e, i, 0);
}

double zp_film_by_gap(const ZpFilmParams *p, const ZpFilmEval *e, size_t i, size_t j, int k) {
  if (k == 1 && zp_film_mix(p, e, i) > 0) return 0;
  return zp_film_is_free(p, e, i, k) ? p->share[k] * p->w * cell_share(e, i, j) * e->secant[j] : 0;
}

double zp_film_inertia(const ZpFilmParams *p, double h, const ZpFilmEval *e, size_t i) {
  double E = mean(e->depth0, e->depth1, i), flow = 0;
  Momentum m = momentum_of(p, e->middle[i], E, h, false);
  for (int k = 0; k < ZP_FILM_MODES; k++)
    flow += p->kappa2[k] > 0 ? p->share[k] / p->kappa2[k] : 0;
  double head = flow * m.inertia / (2 * m.theta * E); /* by the acceleration of the gap, Pa s^2/m */
  double filled = e->end[cavity_at(i)] > 0 ? 1 / (1 + 2 * give * head / (h * h)) : 1;
  return p->w * zp_film_wet(e, i) * head * filled;
}
