/* Letters: q coordinates, m parameter, K = -dr/dq; n null vector, c the last guess of it, |c| = 1.
 *   [K c; c' 0] [n; g] = [0; 1],   so  n = x / (c' x),  g = -1 / (c' x)  with  K x = c,  and  g = 0  at a limit point
 *   dq = a + b dm + n xi,   K a = r - left c,  K b = dr/dm - by_m c,  c' a = c' b = 0
 *   left + by_m dm + g xi = 0,   g + dg/da + (dg/db) dm + (dg/dn) xi = 0
 * A derivative of g along d is  -c' K^-1 (dK/dd n) / (c' x),  and dK/dd n a difference. Theory, eqs. (10.3) to (10.5).
 */
#include "solve/fold.h"

#include "math/vector.h"

#include <math.h>
#include <string.h>

void zp_fold_carve(ZpFold *f, const ZpBranchSystem *system, size_t bandwidth, bool symmetric, ZpNewtonWork *newton,
                   ZpCarver *carver) {
  size_t n = system->at_rest.n, saved = (system->save_size + sizeof(double) - 1) / sizeof(double);
  f->system = system;
  f->newton = newton;
  f->small = ZP_FOLD_EXACT;
  zp_band_carve(&f->beside, n, symmetric ? 0 : bandwidth, bandwidth, carver);
  double **vectors[] = {&f->null, &f->along, &f->a, &f->b, &f->x, &f->at};
  for (size_t k = 0; k < sizeof vectors / sizeof vectors[0]; k++)
    *vectors[k] = zp_carve(carver, n);
  f->saved = zp_carve(carver, saved);
}

bool zp_fold_tangent(ZpFold *f) {
  const ZpStaticSystem *rest = &f->system->at_rest;
  ZpBand *K = &f->newton->K;
  if (rest->residual(rest->self, f->newton->r, NULL) != ZP_END_FOUND) return false;
  rest->stiffness(rest->self, K, NULL);
  f->system->sensitivity(rest->self, f->along);
  if (!zp_band_factor(K)) return false;
  f->negative = zp_band_negative(K);
  zp_band_solve(K, f->along);
  return true;
}

void zp_fold_guess(ZpFold *f) {
  size_t n = f->system->at_rest.n;
  double length = sqrt(zp_dot(n, f->along, f->along));
  for (size_t i = 0; i < n; i++)
    f->null[i] = f->along[i] / length;
}

/* -- the test function ----------------------------------------------------------------------------- */

/* => g, x; the negative eigenvalues of what is across c. */
static void test(ZpFold *f) {
  size_t n = f->system->at_rest.n;
  memcpy(f->x, f->null, n * sizeof *f->x);
  zp_band_solve(&f->newton->K, f->x);
  double cx = zp_dot(n, f->null, f->x);
  f->test = -1 / cx;
  f->negative += cx > 0; /* of the bordered matrix, one of which is the border's */
  f->negative--;
}

/* The stiffness at `h` (d, dm) from the present point, times x => y. The present point stays. */
static void beside(ZpFold *f, const double *d, double dm, double h, double *y) {
  const ZpBranchSystem *sys = f->system;
  const ZpStaticSystem *rest = &sys->at_rest;
  sys->save(rest->self, f->saved);
  rest->move(rest->self, d, h);
  sys->set(rest->self, sys->get(rest->self) + h * dm);
  rest->residual(rest->self, y, NULL);
  rest->stiffness(rest->self, &f->beside, NULL);
  zp_band_multiply(&f->beside, f->x, y);
  sys->restore(rest->self, f->saved);
  rest->residual(rest->self, f->b, NULL); /* a move turns the edges of the last residual */
}

/* Derivative of g along (d, dm), by a central difference: its even part is that of edges which turn, a million times
 * stiffer than what bends. */
static double change_of_test(ZpFold *f, const double *d, double dm) {
  static const double small = 2e-6; /* of what linearisation stands: 1 urad, far below the contact depth */
  const ZpBranchSystem *sys = f->system;
  const ZpStaticSystem *rest = &sys->at_rest;
  size_t n = rest->n;
  double size = rest->length(rest->self, d) + fabs(dm) / sys->m_scale, h = small / size, *y = f->newton->r;
  if (!(size > 0)) return 0;
  beside(f, d, dm, h, y);
  beside(f, d, dm, -h, f->at);
  for (size_t i = 0; i < n; i++)
    y[i] = (y[i] - f->at[i]) / (2 * h);
  bool symmetric = f->beside.lower == 0;
  if (!symmetric) zp_band_solve(&f->newton->K, y);
  double through = zp_dot(n, symmetric ? f->x : f->null, y);
  return -through * f->test * f->test;
}

/* -- solutions ------------------------------------------------------------------------------------- */

enum { MOST_ITERATIONS = 9, MOST_REFRESHES = 20 };

/* Move by a + along xi and dm, or by a part of it. => is what the next step would change, as the last two foretell,
 * below what is asked for? */
static bool step(ZpFold *f, double xi, double dm) {
  static const double of_length = 1e-3; /* what a step of full length counts in m */
  const ZpBranchSystem *sys = f->system;
  const ZpStaticSystem *rest = &sys->at_rest;
  for (size_t i = 0; i < rest->n; i++)
    f->b[i] = f->a[i] + f->along[i] * xi;
  double length = rest->length(rest->self, f->b), part = length > 1 ? 1 / length : 1;
  rest->move(rest->self, f->b, part);
  sys->set(rest->self, sys->get(rest->self) + part * dm);
  double change = fabs(dm / sys->get(rest->self)) + of_length * length;
  double rate = isinf(f->change) ? 1 : fmin(change / f->change, 1);
  f->change = change;
  return change * rate < f->small;
}

static double *balance(ZpFold *f) {
  memcpy(f->a, f->newton->r, f->system->at_rest.n * sizeof *f->a);
  zp_band_solve(&f->newton->K, f->a);
  return f->a;
}

/* The step that keeps the equilibrium and the part along c => a, its dm; the one along the null vector => along, its
 * dm. Both are bounded where K is singular. */
static void split_step(ZpFold *f, double *dm_a, double *dm_n) {
  size_t n = f->system->at_rest.n;
  double cx = -1 / f->test, left = zp_dot(n, f->null, f->a) / cx, by_m = zp_dot(n, f->null, f->along) / cx;
  *dm_a = -left / by_m;
  *dm_n = -f->test / by_m;
  for (size_t i = 0; i < n; i++) {
    double b = f->along[i] - by_m * f->x[i];
    f->a[i] += b * *dm_a - left * f->x[i];
    f->along[i] = f->x[i] / cx + b * *dm_n;
  }
}

/* One Newton step to the limit point. The last one is where the test function falls to 0, not where the stiffness along
 * the null vector is least, close to 0. */
static bool step_to_fold(ZpFold *f, bool *small) {
  static const double falls = 0.3;
  size_t n = f->system->at_rest.n;
  if (!zp_fold_tangent(f)) return false;
  balance(f);
  double before = f->test, dm_a, dm_n;
  test(f);
  split_step(f, &dm_a, &dm_n);
  double by_a = change_of_test(f, f->a, dm_a), by_n = change_of_test(f, f->along, dm_n);
  double length = sqrt(zp_dot(n, f->x, f->x)), xi = -(f->test + by_a) / by_n;
  for (size_t i = 0; i < n; i++)
    f->null[i] = f->x[i] / length;
  if (!isfinite(xi)) return false;
  *small = step(f, xi, dm_a + xi * dm_n) && fabs(f->test) < falls * fabs(before);
  return true;
}

static bool step_to_event(ZpFold *f, ZpEvent event, double wanted, bool *small) {
  const ZpStaticSystem *rest = &f->system->at_rest;
  if (!zp_fold_tangent(f)) return false;
  balance(f);
  double off = event(rest->self, f->x) - wanted;
  double dm = -(off + zp_dot(rest->n, f->x, f->a)) / zp_dot(rest->n, f->x, f->along);
  if (!isfinite(dm)) return false;
  *small = step(f, dm, dm);
  return true;
}

static bool solve(ZpFold *f, ZpEvent event, double wanted) {
  const ZpStaticSystem *rest = &f->system->at_rest;
  static const double astray = 0.2; /* what a step after the first may change */
  int refreshes = 0;
  f->test = 0;
  f->change = INFINITY;
  for (int k = 0; k < MOST_ITERATIONS; k++) {
    bool small;
    if (k == 0 && rest->refresh && rest->refresh(rest->self) != ZP_END_FOUND) return false;
    if (!(event ? step_to_event(f, event, wanted, &small) : step_to_fold(f, &small))) return false;
    if (k > 0 && f->change > astray) return false;
    if (!small) continue;
    if (!rest->refresh || k == 0) return true;
    if (refreshes++ == MOST_REFRESHES) return false;
    k = -1;
  }
  return false;
}

bool zp_fold_solve(ZpFold *f) {
  return solve(f, NULL, 0);
}

bool zp_fold_event(ZpFold *f, ZpEvent event, double value) {
  return solve(f, event, value);
}
