/* Letters: q position, w mean velocity of a step, a its mean acceleration 2 (w - v0) / h; h its length. */
#include "solve/implicit.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "math/elementary.h"

static const double first_step = 1e-6;     /* s */
static const double shortest_step = 1e-13; /* s */
static const double newton_share = 1e-4;   /* of the accuracy: what the iteration may leave */
static const double rounding_share = 1e-2; /* what it leaves at most where rounding stops it */
static const double fast_share = 2.5e-3; /* of the work that a linear rate foresees: convergence is mostly quadratic */
static const double fastest_growth = 1.6, sharpest_cut = 0.3, safety = 0.85;
enum { MOST_ITERATIONS = 16, PATIENCE = 8, EASY = 5, HARD = 8 };

void zp_implicit_carve(ZpImplicit *s, const ZpImplicitSystem *system, ZpCarver *carver) {
  s->system = system;
  s->q = zp_carve(carver, system->n);
  s->r = zp_carve(carver, system->n);
  zp_band_carve(&s->A, system->n, 0, system->bandwidth, carver);
}

static double rms(const double *x, size_t n) {
  double sum = 0;
  for (size_t i = 0; i < n; i++)
    sum += x[i] * x[i];
  return sqrt(sum / (double)n);
}

static double largest(const double *x, size_t n) {
  double most = 0;
  for (size_t i = 0; i < n; i++)
    most = fmax(most, fabs(x[i]));
  return most;
}

/* As if the ribbon moved on as in the last step: its mean velocity has none of the fast modes that v alternates with.
 */
static void predict(ZpImplicit *s, double h, const double *q, const double *v, const ZpImplicitHistory *history) {
  const double *w = history->last > 0 ? history->w : v;
  for (size_t i = 0; i < s->system->n; i++)
    s->q[i] = q[i] + h * w[i];
  if (s->system->attempt) s->system->attempt(s->system->self, s->q);
}

/* The residual f - M a of (18.1) as work over the step, J: by so much the energy of a step that ends here is off. */
typedef struct Imbalance {
  double work;
  double allowed; /* as a share of the energies there, and what the rounding of q makes */
} Imbalance;

/* f - M a of (18.1) => r, and the Jacobian factored. */
static bool linearise(ZpImplicit *s, double h, const double *q, const double *v, Imbalance *imbalance) {
  const ZpImplicitSystem *system = s->system;
  double work = 0, turnover = 0, rounding = 0;
  system->force(system->self, s->q, h, s->r);
  system->tangent(system->self, &s->A);
  for (size_t i = 0; i < system->n; i++) {
    double inertia = 2 * system->mass[i] / (h * h), moved = s->q[i] - q[i];
    s->r[i] -= inertia * (moved - h * v[i]);
    double stiffness = *zp_band_at(&s->A, i, i) += inertia, rounded = stiffness * s->reach * moved;
    work += s->r[i] * moved;
    turnover += inertia * moved * moved;
    rounding += rounded * rounded;
  }
  *imbalance = (Imbalance){fabs(work), s->balance * (s->energy + turnover) + DBL_EPSILON * sqrt(rounding)};
  return zp_band_factor(&s->A);
}

/* Is the end found, a correction of `size` (in units of the accuracy) having followed one of `before`, 0 of the first?
 * What is left, of the distance and of the imbalance, is foreseen from both. Far below the accuracy a distance that
 * does not shrink any more is rounding, but only where energy balances: while faces meet it shrinks as slowly. */
static bool is_found(double size, double before, Imbalance imbalance) {
  if (before == 0) return size == 0;
  double rate = size / before, left = rate < 0.5 ? 2 * rate : 1, foreseen = rate < 0.5 ? fast_share * left : 1;
  if (foreseen * imbalance.work > imbalance.allowed) return false;
  return left * size < newton_share || (rate > 0.5 && size < rounding_share);
}

static bool is_foreseen(const ZpImplicit *s, Imbalance imbalance) {
  const ZpImplicitSystem *system = s->system;
  return !system->unforeseen || system->unforeseen(system->self, s->q) <= imbalance.allowed;
}

/* => iterations that it took; 0: it found no end. */
static int converge(ZpImplicit *s, double h, const double *q, const double *v) {
  double least = INFINITY, before = 0;
  Imbalance imbalance;
  for (int k = 0; k < MOST_ITERATIONS; k++) {
    if (!linearise(s, h, q, v, &imbalance)) return 0;
    zp_band_solve(&s->A, s->r);
    for (size_t i = 0; i < s->system->n; i++)
      s->q[i] += s->r[i];
    s->counts.iterations++;
    double size = rms(s->r, s->system->n) / s->accuracy;
    if (!isfinite(size) || (k >= PATIENCE && size > least)) return 0;
    if (is_found(size, before, imbalance) && is_foreseen(s, imbalance)) return k + 1;
    least = fmin(least, size);
    before = size;
  }
  return 0;
}

/* Local error over the accuracy asked for, from the change of acceleration since the last step; what is too fast for
 * the step is filtered out of it by the iteration's matrix. */
static double local_error(ZpImplicit *s, double h, const double *q, const double *v, const ZpImplicitHistory *history) {
  size_t n = s->system->n;
  if (!(history->last > 0)) return 0;
  for (size_t i = 0; i < n; i++) {
    double a = 2 * (s->q[i] - q[i] - h * v[i]) / (h * h);
    s->r[i] = s->system->mass[i] * (a - history->a[i]) * h / (3 * (h + history->last));
  }
  zp_band_solve(&s->A, s->r);
  return rms(s->r, n) / s->accuracy;
}

static void accept(ZpImplicit *s, double h, double *q, double *v, ZpImplicitHistory *history) {
  size_t n = s->system->n;
  for (size_t i = 0; i < n; i++) {
    double w = (s->q[i] - q[i]) / h;
    history->w[i] = w;
    history->a[i] = 2 * (w - v[i]) / h;
    v[i] = 2 * w - v[i];
  }
  memcpy(q, s->q, n * sizeof *q);
  history->last = h;
  s->counts.steps++;
}

void zp_implicit_smooth(ZpImplicit *s, double h, double *v) {
  enum { POWER = 3 };
  size_t n = s->system->n;
  double *fast = s->r, *slow = s->q;
  memcpy(fast, v, n * sizeof *v);
  for (int k = 0; k < POWER; k++) {
    for (size_t i = 0; i < n; i++)
      slow[i] = 2 * s->system->mass[i] / (h * h) * fast[i];
    zp_band_solve(&s->A, slow);
    for (size_t i = 0; i < n; i++)
      fast[i] -= slow[i];
  }
  for (size_t i = 0; i < n; i++)
    v[i] -= fast[i];
}

double zp_implicit_step(ZpImplicit *s, double longest, double *q, double *v, ZpImplicitHistory *history) {
  double try = s->fixed > 0 ? s->fixed : history->next > 0 ? history->next : first_step;
  bool cut = longest < try * (1 + 1e-6); /* a rest that is rounding only would be too short to be taken */
  s->energy = s->system->begin(s->system->self, q);
  s->reach = largest(q, s->system->n);
  for (double h = cut ? longest : try; h >= shortest_step;) {
    predict(s, h, q, v, history);
    int iterations = converge(s, h, q, v);
    if (iterations == 0) {
      s->counts.failures++;
      h *= 0.5;
      cut = false;
      continue;
    }
    double error = local_error(s, h, q, v, history), growth = safety / zp_cube_root(fmax(error, 1e-6));
    if (error > 1.5 && !(s->fixed > 0)) {
      s->counts.rejected++;
      h *= fmax(growth, sharpest_cut);
      cut = false;
      continue;
    }
    accept(s, h, q, v, history);
    double ease = iterations <= EASY ? fastest_growth : iterations <= HARD ? 1 : 0.8;
    if (!cut || growth < 1) history->next = h * fmin(growth, ease);
    return h;
  }
  return 0;
}
