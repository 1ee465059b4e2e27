/* Letters: q unknowns, w their mean rates over a step, a mean acceleration 2 (w - v0) / h; h its length. */
#include "solve/implicit.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "math/elementary.h"

static const double first_step = 1e-6;     /* s, unless the owner knows better */
static const double shortest_step = 1e-13; /* s */
static const double newton_share = 1e-4;   /* of the accuracy: the largest error that the iteration may leave */
static const double rounding_share = 1e-2; /* the largest if rounding stops it */
static const double hasty_share = 1e-2;    /* the largest in a hasty run */
static const double hasty_balance = 1e3;   /* times the imbalance that another run may leave */
static const double fast_share = 0.1; /* of the work that a linear rate foresees: convergence is mostly quadratic, but
                                       * not of a film, whose tangent leaves out convection */
static const double fastest_growth = 1.6, sharpest_cut = 0.3, safety = 0.85;
static const double start_growth = 4, far_below = 1e-3; /* where the error is far below the limit, as at first */
enum { MOST_ITERATIONS = 16, MOST_CHOICES = 60, PATIENCE = 8, EASY = 5, HARD = 8 };

void zp_implicit_reserve(ZpImplicit *s, const ZpImplicitSystem *system, ZpArena *arena) {
  s->system = system;
  s->share = newton_share;
  s->first = first_step;
  s->q = zp_arena_take(arena, system->n);
  s->r = zp_arena_take(arena, system->n);
  s->x = zp_arena_take(arena, system->n);
  zp_arrow_reserve(&s->A, system->form, arena);
}

static ZpUnknown kind_of(const ZpImplicitSystem *system, size_t i) {
  return system->kind ? system->kind[i] : ZP_SECOND_ORDER;
}

static double scale_of(const ZpImplicitSystem *system, size_t i) {
  return system->scale ? system->scale[i] : 1;
}

/* How often more than once for each part an unknown counts. */
static double more_of(const ZpImplicitSystem *system, size_t i) {
  return system->sharers ? fmax(system->sharers[i] - 1, 0) * (double)(1 + system->parts.more) : 0;
}

/* Root mean square of `counted` unknowns of all parts in their scales; the others are 0. */
static double rms(const ZpImplicitSystem *system, const double *x, size_t counted) {
  const ZpParts *parts = &system->parts;
  double sum = 0;
  for (size_t i = 0; i < system->n; i++) {
    double size = x[i] / scale_of(system, i);
    sum += size * size;
  }
  for (size_t k = 0; k < parts->count; k++) {
    double size = x[parts->common[k]] / scale_of(system, parts->common[k]);
    sum += (double)parts->more * size * size;
  }
  for (size_t i = 0; system->sharers && i < system->n; i++) {
    double size = x[i] / scale_of(system, i), more = more_of(system, i);
    sum += more * size * size;
    counted += (size_t)more;
  }
  return counted > 0 ? sqrt(sum / zp_parts_unknowns(parts, counted)) : 0;
}

static double largest_from(const ZpImplicitSystem *system, const double *x, size_t from, size_t end, double most) {
  for (size_t i = from; i < end; i++)
    most = fmax(most, fabs(x[i] / scale_of(system, i)));
  return most;
}

/* Largest unknown of the first part, in its scale: later parts are of equal size, but may count from another origin. */
static double largest(const ZpImplicitSystem *system, const double *x) {
  const ZpParts *parts = &system->parts;
  const ZpArrowForm *form = system->form;
  double most = 0;
  size_t first = 0, common = 0;
  for (size_t k = 0; k < form->blocks; k++) {
    const size_t own = form->block[k].n, before = common;
    while (common < parts->count && parts->common[common] < first + own)
      common++;
    most = largest_from(system, x, first, first + (own + parts->more * (common - before)) / (1 + parts->more), most);
    first += own;
  }
  return largest_from(system, x, form->inner, form->n, most);
}

/* A first guess: all unknowns change as in the last step, whose mean velocity has none of the fast modes with which v
 * alternates. Algebraic unknowns have no rate: their guess is the last value. */
static void predict(ZpImplicit *s, double h, const double *q, const double *v, const ZpImplicitHistory *history) {
  const double *w = history->last > 0 ? history->w : v;
  for (size_t i = 0; i < s->system->n; i++)
    s->q[i] = q[i] + h * w[i];
  if (s->system->attempt) s->system->attempt(s->system->self, s->q);
}

/* The residual f - M a of (18.1) as work over the step, J: the error of the energy if a step ends here. */
typedef struct Imbalance {
  double work;
  double allowed; /* as a share of the energies there, and what the rounding of q makes */
} Imbalance;

/* The residual of an algebraic unknown's equation does work with the whole of the unknown, not with its change alone.
 */
static double algebraic_work(const ZpImplicit *s, const double *q) {
  double work = 0;
  for (size_t i = 0; s->system->kind && i < s->system->n; i++)
    if (s->system->kind[i] == ZP_ALGEBRAIC) work += s->r[i] * q[i];
  return work;
}

/* Work on an unknown that has `moved`, by the rounding of its position. */
static double rounded_work(const ZpImplicit *s, size_t i, double stiffness, double moved) {
  return stiffness * (s->reach * scale_of(s->system, i)) * moved;
}

/* Work on all unknowns by the rounding of their positions, from the sum of their squares. Equal parts are rounded
 * alike, so their works add up. */
static double rounding_of(ZpImplicit *s, const double *q, double squares) {
  const ZpParts *parts = &s->system->parts;
  double all = (double)(1 + parts->more);
  for (size_t k = 0; k < parts->count; k++) {
    size_t i = parts->common[k];
    double rounded = rounded_work(s, i, *s->A.diagonal[i], s->q[i] - q[i]);
    squares -= (double)parts->more / all * rounded * rounded; /* a part has its share of the stiffness only */
  }
  return DBL_EPSILON * sqrt(all * squares);
}

/* f - M a of (18.1) => r. */
static ZpEnd left_over(ZpImplicit *s, double h, const double *q, const double *v) {
  const ZpImplicitSystem *system = s->system;
  ZpEnd end = system->residual(system->self, s->q, h, s->r);
  for (size_t i = 0; i < system->n && end == ZP_END_FOUND; i++)
    s->r[i] -= 2 * system->mass[i] / (h * h) * (s->q[i] - q[i] - h * v[i]);
  return end;
}

/* Compute the imbalance and factor the Jacobian. */
static ZpEnd linearise(ZpImplicit *s, double h, const double *q, const double *v, Imbalance *imbalance) {
  const ZpImplicitSystem *system = s->system;
  double work = 0, turnover = 0, rounding = 0;
  ZpEnd end = left_over(s, h, q, v);
  if (end != ZP_END_FOUND) return end;
  system->tangent(system->self, &s->A);
  for (size_t i = 0; i < system->n; i++) {
    double inertia = 2 * system->mass[i] / (h * h), moved = s->q[i] - q[i];
    double stiffness = *s->A.diagonal[i] += inertia;
    double rounded = rounded_work(s, i, stiffness, moved);
    work += s->r[i] * moved;
    turnover += inertia * moved * moved;
    rounding += rounded * rounded;
  }
  work += algebraic_work(s, q);
  *imbalance = (Imbalance){fabs(work), s->balance * (s->energy + turnover) + rounding_of(s, q, rounding)};
  return zp_arrow_factor(&s->A) ? ZP_END_FOUND : ZP_END_SHORTER;
}

/* Residual => correction, by the factored Jacobian. */
static void solve(ZpImplicit *s, double *r) {
  const ZpImplicitSystem *system = s->system;
  if (system->turn) system->turn(system->self, r);
  zp_arrow_solve(&s->A, r);
  if (system->turn_back) system->turn_back(system->self, r);
}

/* Has the end been found, if a correction of `size` (in units of the accuracy) followed one of `before`, 0 for the
 * first? Both give an estimate of the remaining distance and imbalance. Far below the accuracy, a distance that no
 * longer shrinks is rounding, but only if energy balances: while faces meet, it shrinks as slowly. */
static bool is_found(const ZpImplicit *s, double size, double before, Imbalance imbalance) {
  if (before == 0) return size == 0;
  double rate = size / before, left = rate < 0.5 ? 2 * rate : 1, foreseen = rate < 0.5 ? fast_share * left : 1;
  if (foreseen * imbalance.work > imbalance.allowed) return false;
  return left * size < s->share || (rate > 0.5 && size < rounding_share);
}

static bool is_foreseen(const ZpImplicit *s, Imbalance imbalance) {
  const ZpImplicitSystem *system = s->system;
  return !system->unforeseen || system->unforeseen(system->self, s->q) <= imbalance.allowed;
}

/* The motion that an algebraic unknown, such as a pressure, causes in a short step grows with the square of the step,
 * and its rounding with the inverse of the step: so little of its correction counts. */
static void forgive_momentary(ZpImplicit *s, double h) {
  double share = h / s->first;
  for (size_t i = 0; s->system->kind && share < 1 && i < s->system->n; i++)
    if (s->system->kind[i] == ZP_ALGEBRAIC) s->r[i] *= share * share;
}

/* => how it ended, and the iterations that it took. */
static ZpEnd converge(ZpImplicit *s, double h, const double *q, const double *v, int *iterations) {
  double least = INFINITY, before = 0;
  Imbalance imbalance;
  for (int k = 0, most = MOST_ITERATIONS; k < most; k++) {
    ZpEnd end = linearise(s, h, q, v, &imbalance);
    if (end != ZP_END_FOUND) return end;
    solve(s, s->r);
    for (size_t i = 0; i < s->system->n; i++)
      s->q[i] += s->r[i];
    if (s->system->corrected) s->system->corrected(s->system->self, s->r);
    s->counts.iterations++;
    *iterations = k + 1;
    bool chosen = !s->system->choose || s->system->choose(s->system->self, s->q);
    if (!chosen) most = k + MOST_ITERATIONS < MOST_CHOICES ? k + MOST_ITERATIONS : MOST_CHOICES;
    forgive_momentary(s, h);
    double size = rms(s->system, s->r, s->system->n) / s->accuracy;
    if (!isfinite(size) || (chosen && k >= PATIENCE && size > least)) return ZP_END_SHORTER;
    if (is_found(s, size, before, imbalance) && is_foreseen(s, imbalance)) return ZP_END_FOUND;
    least = fmin(least, size);
    before = size;
  }
  return ZP_END_SHORTER;
}

/* -- local error ----------------------------------------------------------------------------------- */

/* f += the inertia beyond `mass` times a x. */
static void add_inertia(ZpImplicit *s, double a, const double *x, double *f) {
  if (!s->system->inertia) return;
  for (size_t i = 0; i < s->system->n; i++)
    s->x[i] = a * x[i];
  s->system->inertia(s->system->self, s->x, f);
}

/* Local error from the change of acceleration since the last step => s->r. The iteration's matrix filters motion too
 * fast for the step. Inertia beyond the masses may be an upper bound, such as that of a thin film, whose errors should
 * count for more than their length. If it is far above that of the matrix, the filter amplifies, so its effect is
 * limited. */
static void filtered_error(ZpImplicit *s, double h, const double *q, const double *v,
                           const ZpImplicitHistory *history) {
  static const double most_added = 10; /* times what is not filtered */
  size_t n = s->system->n;
  double *jump = s->x, per = h / (3 * (h + history->last));
  for (size_t i = 0; i < n; i++) {
    jump[i] = per * (2 * (s->q[i] - q[i] - h * v[i]) / (h * h) - history->a[i]);
    s->r[i] = s->system->mass[i] * jump[i];
  }
  if (s->system->inertia) s->system->inertia(s->system->self, jump, s->r);
  zp_arrow_solve(&s->A, s->r);
  for (size_t i = 0; s->system->inertia && i < n; i++) {
    double most = most_added * 0.5 * h * h * fabs(jump[i]);
    s->r[i] = fmin(fmax(s->r[i], -most), most);
  }
}

/* Second derivative of an unknown of first order: the change of its mean rate since the last step, over the time
 * between their middles. */
static double rate_change(double h, double w, size_t i, const ZpImplicitHistory *history) {
  return history->last > 0 ? 2 * (w - history->w[i]) / (h + history->last) : 0;
}

/* An unknown of first order has the error (18.9), from three steps, of which the first two count as equal; in a first
 * step, that of a decay by its scale. It is not filtered: a decay faster than a step changes its sign in each step, and
 * is resolved until it is complete. */
static double first_order_error(const ZpImplicit *s, double h, double moved, size_t i,
                                const ZpImplicitHistory *history) {
  double scale = scale_of(s->system, i), share = moved / scale, change = rate_change(h, moved / h, i, history);
  if (!(history->last > 0)) return scale * share * share * share / 12;
  return h * h * h / 3 * (change - history->a[i]) / (h + 3 * history->last);
}

/* Algebraic unknowns follow from the others. */
static double share_resolved(const ZpImplicitSystem *system, size_t i) {
  if (system->kind[i] == ZP_ALGEBRAIC) return 0;
  return system->resolved ? system->resolved(system->self, i) : 1;
}

/* Local error relative to the required accuracy. */
static double local_error(ZpImplicit *s, double h, const double *q, const double *v, const ZpImplicitHistory *history) {
  const ZpImplicitSystem *system = s->system;
  size_t counted = system->n;
  if (history->last > 0)
    filtered_error(s, h, q, v, history);
  else
    memset(s->r, 0, system->n * sizeof *s->r);
  if (system->overlooks) system->overlooks(system->self, v, h, s->r);
  for (size_t i = 0; system->kind && i < system->n; i++) {
    if (system->kind[i] == ZP_SECOND_ORDER) continue;
    double share = share_resolved(system, i);
    s->r[i] = share > 0 ? share * first_order_error(s, h, s->q[i] - q[i], i, history) : 0;
    if (share == 0) counted -= 1 + (size_t)more_of(system, i);
  }
  return rms(system, s->r, counted) / s->accuracy;
}

/* -- a step ---------------------------------------------------------------------------------------- */

static void accept_other(double h, double w, ZpUnknown kind, size_t i, ZpImplicitHistory *history) {
  bool first_order = kind == ZP_FIRST_ORDER;
  history->a[i] = first_order ? rate_change(h, w, i, history) : 0;
  history->w[i] = first_order ? w : 0;
}

static void accept(ZpImplicit *s, double h, double *q, double *v, ZpImplicitHistory *history) {
  size_t n = s->system->n;
  for (size_t i = 0; i < n; i++) {
    double w = (s->q[i] - q[i]) / h;
    ZpUnknown kind = kind_of(s->system, i);
    if (kind != ZP_SECOND_ORDER) {
      accept_other(h, w, kind, i, history);
      continue;
    }
    history->w[i] = w;
    history->a[i] = 2 * (w - v[i]) / h;
    v[i] = 2 * w - v[i];
  }
  memcpy(q, s->q, n * sizeof *q);
  history->last = h;
  s->counts.steps++;
}

/* Take the fast share of velocities v out, (x / (1 + x))^power of each mode; `all`: x counts the inertia beyond `mass`,
 * too. */
static void smooth(ZpImplicit *s, double h, bool all, int power, double *v) {
  size_t n = s->system->n;
  double *fast = s->r, *slow = s->q;
  memcpy(fast, v, n * sizeof *v);
  for (int k = 0; k < power; k++) {
    for (size_t i = 0; i < n; i++)
      slow[i] = 2 * s->system->mass[i] / (h * h) * fast[i];
    if (all) add_inertia(s, 2 / (h * h), fast, slow);
    solve(s, slow);
    for (size_t i = 0; i < n; i++)
      fast[i] = kind_of(s->system, i) == ZP_SECOND_ORDER ? fast[i] - slow[i] : 0;
  }
  for (size_t i = 0; i < n; i++)
    v[i] -= fast[i];
}

void zp_implicit_smooth(ZpImplicit *s, double h, double *v) {
  smooth(s, h, true, 5, v);
}

void zp_implicit_filter(ZpImplicit *s, double h, const double *w, double *v) {
  for (size_t i = 0; i < s->system->n; i++)
    v[i] -= w[i];
  smooth(s, h, false, 3, v);
  for (size_t i = 0; i < s->system->n; i++)
    v[i] += w[i];
}

void zp_implicit_hasten(ZpImplicit *s) {
  s->share = hasty_share;
  s->balance *= hasty_balance;
}

static void begin(ZpImplicit *s, const double *q, const double *v) {
  s->energy = s->system->begin(s->system->self, q, v);
  s->reach = largest(s->system, q);
}

double zp_implicit_step(ZpImplicit *s, double longest, double *q, double *v, ZpImplicitHistory *history) {
  double try = s->fixed > 0 ? s->fixed : history->next > 0 ? history->next : s->first;
  bool cut = longest < try * (1 + 1e-6); /* a remainder that is only rounding would be too short a step */
  begin(s, q, v);
  s->end = ZP_END_SHORTER;
  for (double h = cut ? longest : try; h >= shortest_step;) {
    int iterations;
    predict(s, h, q, v, history);
    s->end = converge(s, h, q, v, &iterations);
    if (s->end == ZP_END_STOP) return 0;
    if (s->end != ZP_END_FOUND) {
      s->counts.failures++;
      h *= 0.5;
      cut = false;
      continue;
    }
    double error = local_error(s, h, q, v, history), growth = safety / zp_cube_root(fmax(error, 1e-6));
    if (error > 1.5 && !(s->fixed > 0)) {
      s->counts.rejected++;
      s->end = ZP_END_SHORTER;
      h *= fmax(growth, sharpest_cut);
      cut = false;
      continue;
    }
    accept(s, h, q, v, history);
    const bool starts = error < far_below;
    double ease = iterations <= EASY ? (starts ? start_growth : fastest_growth) : iterations <= HARD ? 1 : 0.8;
    if (growth > 1 && !starts) growth = sqrt(growth); /* with the full factor lengths would oscillate */
    if (!cut || growth < 1) history->next = h * fmin(growth, ease);
    return h;
  }
  return 0;
}

/* -- steps of neighbouring systems ----------------------------------------------------------------- */

/* A pass leaves the part that the factored matrix lacks of the exact tangent, mostly a hundredth. Rounding of positions
 * ends the passes. */
static const double passed = 1e-11, most_left = 1e-6;

/* Quantities that follow from positions and rates are differentiated by their formulas, eqs. (20.8) and (20.9): as a
 * difference they would have the rounding of positions over the step. Letters: d is the derivative by the number. */
typedef struct Rates {
  size_t n;
  double h, dh;            /* s */
  double *dq, *dv, *dmass; /* [n] at the start of the step, and of the masses */
  double *dq1;             /* [n] and where it ends */
} Rates;

/* Difference quotient over the neighbouring steps; for equal numbers it is exactly 0. */
static double quotient(const ZpDifferenceSteps *steps, const double *(*of)(const ZpDifferenceStep *near), size_t i) {
  double sum = 0, first = of(&steps->near[0])[i];
  for (int k = 1; k < steps->count; k++)
    sum += steps->near[k].weight * (of(&steps->near[k])[i] - first);
  return sum;
}

static const double *position(const ZpDifferenceStep *near) {
  return near->q;
}

static const double *velocity(const ZpDifferenceStep *near) {
  return near->v;
}

static const double *mass_of(const ZpDifferenceStep *near) {
  return near->stepper->system->mass;
}

static const double *mean_rate(const ZpDifferenceStep *near) {
  return near->history->last > 0 ? near->history->w : near->v;
}

static const double *length(const ZpDifferenceStep *near) {
  return &near->h;
}

/* The starts of the steps; ends are guessed as if all changed as in the last step. */
static Rates start(const ZpDifferenceSteps *steps, double *rate) {
  size_t n = steps->near[0].stepper->system->n;
  double *work = steps->work + n;
  Rates r = {.n = n,
             .h = steps->lead->last,
             .dh = quotient(steps, length, 0),
             .dq = work,
             .dv = work + n,
             .dmass = work + 2 * n,
             .dq1 = rate};
  for (size_t i = 0; i < n; i++) {
    r.dq[i] = quotient(steps, position, i);
    r.dv[i] = quotient(steps, velocity, i);
    r.dmass[i] = quotient(steps, mass_of, i);
    rate[i] = r.dq[i] + r.h * quotient(steps, mean_rate, i) + r.dh * steps->lead->w[i];
  }
  for (int k = 0; k < steps->count; k++) {
    const ZpDifferenceStep *near = &steps->near[k];
    ZpImplicit *s = near->stepper;
    begin(s, near->q, near->v);
    if (s->system->attempt) s->system->attempt(s->system->self, s->q);
  }
  return r;
}

/* Derivative of the inertia 2 m (w - v0) / h = m a over the step. */
static double rate_of_inertia(const ZpDifferenceSteps *steps, const Rates *r, size_t i) {
  const ZpImplicitHistory *lead = steps->lead;
  double m = mass_of(&steps->near[0])[i], a = lead->a[i], v = lead->w[i] - 0.5 * r->h * a;
  double late = r->dq1[i] - r->dq[i] - r->dh * v - r->h * r->dv[i];
  return (r->dmass[i] - 2 * m * r->dh / r->h) * a + 2 * m / (r->h * r->h) * late;
}

/* Move all ends along the rate, and differentiate the residual there => left. */
static bool look(const ZpDifferenceSteps *steps, const Rates *r, double *left) {
  memset(left, 0, r->n * sizeof *left);
  for (int k = 0; k < steps->count; k++) {
    const ZpDifferenceStep *near = &steps->near[k];
    ZpImplicit *s = near->stepper;
    for (size_t i = 0; i < r->n; i++)
      s->q[i] = steps->q1[i] + near->offset * r->dq1[i];
    if (s->system->residual(s->system->self, s->q, near->h, s->r) != ZP_END_FOUND) return false;
    for (size_t i = 0; i < r->n; i++)
      left[i] += near->weight * s->r[i];
  }
  for (size_t i = 0; i < r->n; i++)
    left[i] -= rate_of_inertia(steps, r, i);
  return true;
}

static bool factor(const ZpDifferenceStep *near) {
  Imbalance unused;
  return linearise(near->stepper, near->h, near->q, near->v, &unused) == ZP_END_FOUND;
}

/* Size of a rate, of the unknowns that the next step depends on: algebraic unknowns have no memory. */
static double size_of(const ZpImplicitSystem *system, const double *x) {
  double sum = 0;
  for (size_t i = 0; i < system->n; i++) {
    double size = kind_of(system, i) == ZP_ALGEBRAIC ? 0 : x[i] / scale_of(system, i);
    sum += size * size;
  }
  return sqrt(sum / (double)system->n);
}

/* Share of the last pass that a new pass takes back, such that the combined correction is least. With a Jacobian that
 * lacks much, as where faces land under tension, corrections shrink slowly or alternate. */
static double taken_back(const ZpImplicitSystem *system, const double *left, const double *before) {
  double along = 0, square = 0;
  for (size_t i = 0; i < system->n; i++) {
    double scale = kind_of(system, i) == ZP_ALGEBRAIC ? INFINITY : scale_of(system, i);
    double change = (left[i] - before[i]) / scale;
    along += change * left[i] / scale;
    square += change * change;
  }
  return square > 0 ? along / square : 0;
}

/* One pass that leaves a correction: the rate changes by it and by what the previous pass has shown of it. */
static void correct(const ZpDifferenceSteps *steps, const Rates *r, bool first) {
  double *left = steps->work, *before = left + 4 * r->n, *moved = left + 5 * r->n;
  double share = first ? 0 : taken_back(steps->near[0].stepper->system, left, before);
  for (size_t i = 0; i < r->n; i++) {
    double back = first ? 0 : share * (moved[i] + left[i] - before[i]);
    moved[i] = left[i] - back;
    before[i] = left[i];
    r->dq1[i] += moved[i];
  }
}

/* Rounding of a derivative of numbers of size 1: a third of the sum of the weights' sizes, as errors mostly cancel. */
static double rate_rounding(const ZpDifferenceSteps *steps) {
  double sum = 0;
  for (int k = 0; k < steps->count; k++)
    sum += fabs(steps->near[k].weight);
  return DBL_EPSILON * sum / 3;
}

/* Passes with the factored Jacobian of one of the steps: the next pass corrects what it lacks of the exact tangent.
 * Where rounding in stiff edges pushes soft bodies, passes end above the rounding of positions. */
static bool find_rate(const ZpDifferenceSteps *steps, const Rates *r) {
  enum { PATIENCE = 10, MOST_PASSES = 40 };
  static const double pushed = 20; /* times that rounding */
  ZpImplicit *s = steps->near[0].stepper;
  double *left = steps->work, before = INFINITY, rounding = rate_rounding(steps) * s->reach;
  for (int pass = 0; pass < MOST_PASSES; pass++) {
    if (!look(steps, r, left) || (pass == 0 && !factor(&steps->near[0]))) return false;
    solve(s, left);
    correct(steps, r, pass == 0);
    double size = size_of(s->system, left), all = size_of(s->system, r->dq1);
    if (!isfinite(size)) return false;
    if (pass == PATIENCE) rounding *= pushed;
    if (size <= fmax(passed * all, rounding) || (size > 0.5 * before && size < most_left * all)) return true;
    before = size;
  }
  return false;
}

/* The end of the neighbouring step whose residual was found last. */
static void accept_near(const ZpDifferenceSteps *steps, const Rates *r, const ZpDifferenceStep *near) {
  const ZpImplicitHistory *lead = steps->lead;
  accept(near->stepper, near->h, near->q, near->v, near->history);
  for (size_t i = 0; i < r->n; i++) {
    if (kind_of(near->stepper->system, i) != ZP_SECOND_ORDER) continue;
    double w = lead->w[i], a = lead->a[i], dw = (r->dq1[i] - r->dq[i] - w * r->dh) / r->h;
    near->history->w[i] = w + near->offset * dw;
    near->history->a[i] = a + near->offset * (2 * (dw - r->dv[i]) - a * r->dh) / r->h;
    near->v[i] = w + 0.5 * r->h * a + near->offset * (2 * dw - r->dv[i]);
  }
}

bool zp_implicit_follow(const ZpDifferenceSteps *steps, bool with_matrix, double *rate) {
  Rates r = start(steps, rate);
  if (!find_rate(steps, &r) || !look(steps, &r, steps->work)) return false;
  for (int k = 0; k < steps->count; k++) {
    if (with_matrix && !factor(&steps->near[k])) return false;
    accept_near(steps, &r, &steps->near[k]);
  }
  return true;
}
