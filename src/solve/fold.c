/* Letters: q coordinates, m parameter, K = -dr/dq; n null vector, c the last guess of it, |c| = 1.
 *   [K c; c' 0] [n; g] = [0; 1],   so  n = x / (c' x),  g = -1 / (c' x)  with  K x = c,  and  g = 0  at a limit point
 *   dq = a + b dm + n xi,   K a = r - left c,  K b = dr/dm - by_m c,  c' a = c' b = 0
 *   left + by_m dm + g xi = 0,   g + dg/da + (dg/db) dm + (dg/dn) xi = 0
 * A derivative of g along d is  -c' K^-1 (dK/dd n) / (c' x),  and dK/dd n a difference. Theory, eqs. (10.3) to (10.5).
 */
#include "solve/fold.h"

#include <math.h>
#include <string.h>

#include "math/vector.h"

void zp_fold_reserve(ZpFold *f, const ZpBranchSystem *system, const ZpArrowForm *form, ZpNewtonWork *newton,
                     ZpArena *arena) {
  size_t n = system->at_rest.n, saved = (system->save_size + sizeof(double) - 1) / sizeof(double);
  f->system = system;
  f->newton = newton;
  zp_arrow_reserve(&f->beside, form, arena);
  double **vectors[] = {&f->null, &f->along, &f->a, &f->b, &f->x, &f->at, &f->by_a, &f->by_n, &f->excess};
  for (size_t k = 0; k < sizeof vectors / sizeof vectors[0]; k++)
    *vectors[k] = zp_arena_take(arena, n);
  f->saved = zp_arena_take(arena, saved);
  f->start = zp_arena_take(arena, saved);
  f->null_at_start = zp_arena_take(arena, n);
}

bool zp_fold_tangent(ZpFold *f) {
  const ZpStaticSystem *rest = &f->system->at_rest;
  ZpArrow *K = &f->newton->K;
  if (rest->residual(rest->self, f->newton->r, &f->left) != ZP_END_FOUND) return false;
  for (size_t i = 0; f->share > 0 && i < rest->n; i++)
    f->newton->r[i] -= f->share * f->excess[i];
  rest->stiffness(rest->self, K, NULL);
  f->system->sensitivity(rest->self, f->along);
  if (!zp_arrow_factor(K)) return false;
  f->negative = zp_arrow_negative(K);
  zp_arrow_solve(K, f->along);
  return true;
}

void zp_fold_guess(ZpFold *f) {
  size_t n = f->system->at_rest.n;
  double length = sqrt(zp_dot(n, f->along, f->along));
  for (size_t i = 0; i < n; i++)
    f->null[i] = f->along[i] / length;
}

/* -- the test function ----------------------------------------------------------------------------- */

/* => g, x; the negative eigenvalues in the space orthogonal to c. */
static void test(ZpFold *f) {
  size_t n = f->system->at_rest.n;
  memcpy(f->x, f->null, n * sizeof *f->x);
  zp_arrow_solve(&f->newton->K, f->x);
  double cx = zp_dot(n, f->null, f->x);
  f->test = -1 / cx;
  f->negative += cx > 0; /* of the bordered matrix, one of which is the border's */
  f->negative--;
}

/* At h x from the present point => the stiffness times the steps (a, dm_a) and (along, dm_n), with the effect of dm on
 * it: K_m x = -d(dr/dm)/dx. The present point does not change, but its forces must be computed again. */
static void beside(ZpFold *f, double h, double dm_a, double dm_n, double *by_a, double *by_n) {
  const ZpBranchSystem *sys = f->system;
  const ZpStaticSystem *rest = &sys->at_rest;
  sys->save(rest->self, f->saved);
  rest->move(rest->self, f->x, h);
  rest->residual(rest->self, f->at, NULL);
  rest->stiffness(rest->self, &f->beside, NULL);
  sys->sensitivity(rest->self, f->at);
  zp_arrow_multiply(&f->beside, f->a, by_a);
  zp_arrow_multiply(&f->beside, f->along, by_n);
  for (size_t i = 0; i < rest->n; i++) {
    by_a[i] -= dm_a * f->at[i];
    by_n[i] -= dm_n * f->at[i];
  }
  sys->restore(rest->self, f->saved);
  rest->residual(rest->self, f->at, NULL); /* a move turns the edges of the last residual */
}

/* Derivative of g from the change y of the stiffness times a step. */
static double change_of_test(ZpFold *f, double *y) {
  bool symmetric = zp_arrow_is_symmetric(&f->beside);
  if (!symmetric) zp_arrow_solve(&f->newton->K, y);
  double through = zp_dot(f->system->at_rest.n, symmetric ? f->x : f->null, y);
  return -through * f->test * f->test;
}

/* Derivatives of g along the steps (a, dm_a) and (along, dm_n). Since (dK/dd) x = (dK/dx) d, one central difference
 * along x serves both. It removes the even part, which comes from the rotation of edges and is a million times stiffer
 * than bending. */
static void changes_of_test(ZpFold *f, double dm_a, double dm_n, double *g_a, double *g_n) {
  static const double small = 2e-6; /* of the range of linearisation: 1 urad, far below the contact depth */
  const ZpStaticSystem *rest = &f->system->at_rest;
  double h = small / rest->length(rest->self, f->x), over = 1 / (2 * h);
  beside(f, h, dm_a, dm_n, f->by_a, f->by_n);
  beside(f, -h, dm_a, dm_n, f->b, f->newton->r);
  for (size_t i = 0; i < rest->n; i++) {
    f->by_a[i] = (f->by_a[i] - f->b[i]) * over;
    f->by_n[i] = (f->by_n[i] - f->newton->r[i]) * over;
  }
  *g_a = change_of_test(f, f->by_a);
  *g_n = change_of_test(f, f->by_n);
}

/* -- solutions ------------------------------------------------------------------------------------- */

enum { MOST_ITERATIONS = 9, MOST_REFRESHES = 20 };

/* Move by a + along xi and dm, or by a part of it => change. */
static void step(ZpFold *f, double xi, double dm) {
  static const double of_length = 1e-3; /* what a step of full length counts in m */
  const ZpBranchSystem *sys = f->system;
  const ZpStaticSystem *rest = &sys->at_rest;
  for (size_t i = 0; i < rest->n; i++)
    f->b[i] = f->a[i] + f->along[i] * xi;
  double length = rest->length(rest->self, f->b), part = length > 1 ? 1 / length : 1;
  f->moved = rest->change(rest->self, f->b);
  rest->move(rest->self, f->b, part);
  zp_branch_set(sys, zp_branch_parameter(sys) + part * dm);
  f->change = fabs(dm / zp_branch_parameter(sys)) + of_length * length;
}

static void balance(ZpFold *f) {
  memcpy(f->a, f->newton->r, f->system->at_rest.n * sizeof *f->a);
  zp_arrow_solve(&f->newton->K, f->a);
}

/* The step that keeps the equilibrium and the component along c => a, its dm; the one along the null vector => along,
 * its dm. Both are bounded where K is singular. */
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

/* One Newton step to the limit point. False if there is none. */
static bool step_to_fold(ZpFold *f) {
  size_t n = f->system->at_rest.n;
  double dm_a, dm_n, g_a, g_n;
  balance(f);
  test(f);
  split_step(f, &dm_a, &dm_n);
  changes_of_test(f, dm_a, dm_n, &g_a, &g_n);
  double length = sqrt(zp_dot(n, f->x, f->x)), xi = -(f->test + g_a) / g_n;
  for (size_t i = 0; i < n; i++)
    f->null[i] = f->x[i] / length;
  if (!isfinite(xi)) return false;
  step(f, xi, dm_a + xi * dm_n);
  return true;
}

static bool step_to_event(ZpFold *f, ZpEvent event, double wanted) {
  const ZpStaticSystem *rest = &f->system->at_rest;
  balance(f);
  double off = event(rest->self, f->x) - wanted;
  double dm = -(off + zp_dot(rest->n, f->x, f->a)) / zp_dot(rest->n, f->x, f->along);
  if (!isfinite(dm)) return false;
  step(f, dm, dm);
  return true;
}

/* Target of a search for a fold. */
typedef struct Goal {
  enum { TO_FOLD, TO_EVENT, TO_REST } kind;
  ZpEvent event;
  double wanted;
  ZpFoldTo to;
} Goal;

static bool step_to(ZpFold *f, const Goal *goal) {
  if (!zp_fold_tangent(f)) return false;
  if (goal->kind == TO_FOLD) return step_to_fold(f);
  if (goal->kind == TO_EVENT) return step_to_event(f, goal->event, goal->wanted);
  balance(f);
  step(f, 0, 0);
  return true;
}

/* Was the last step so small that the point is accurate enough? The change by the next step, extrapolated from the last
 * two, is below the accuracy; the slower fall counts, of the change or of the test function. For a limit point the last
 * step is the one to where the test function is 0, not to where the stiffness along the null vector, close to 0, is
 * least. For an equilibrium under a given parameter m says nothing: the step itself is small, and its start was in
 * balance. */
static bool is_there(const ZpFold *f, const Goal *goal, double change_before, double test_before) {
  static const double exact = 1e-9, falls = 0.3, moved = 100, left = 1e-3;
  if (goal->kind == TO_REST) return f->moved < moved && f->left < left && !isinf(change_before);
  if (goal->to == ZP_FOLD_ROUGH) return f->moved < moved && !isinf(change_before);
  double rate = isinf(change_before) ? 1 : fmin(f->change / change_before, 1);
  bool still = f->change < exact && change_before < exact; /* it began there: the rest is rounding */
  double test_rate = goal->kind != TO_FOLD || still ? 0 : fabs(f->test / test_before);
  return f->change * fmax(rate, test_rate) < exact && test_rate < falls;
}

static bool solve(ZpFold *f, Goal goal) {
  const ZpStaticSystem *rest = &f->system->at_rest;
  static const double astray = 0.2, first = 1; /* what a step may change, and the first one to a limit point */
  const double most = goal.kind == TO_FOLD ? first : INFINITY;
  int refreshes = 0;
  f->test = 0;
  f->change = INFINITY;
  for (int k = 0; k < MOST_ITERATIONS; k++) {
    double change = f->change, test = f->test;
    if (k == 0 && rest->refresh && rest->refresh(rest->self) != ZP_END_FOUND) return false;
    if (!step_to(f, &goal) || f->change > (k > 0 ? astray : most)) return false;
    if (!is_there(f, &goal, change, test)) continue;
    bool fresh = !rest->refresh || k == 0;
    if (fresh) return rest->residual(rest->self, f->newton->r, NULL) == ZP_END_FOUND;
    if (refreshes++ == MOST_REFRESHES) return false;
    k = -1;
  }
  return false;
}

bool zp_fold_solve(ZpFold *f) {
  return solve(f, (Goal){.kind = TO_FOLD, .to = ZP_FOLD_EXACT});
}

bool zp_fold_approach(ZpFold *f) {
  static const double shortest = 1.0 / 16;
  const ZpBranchSystem *sys = f->system;
  void *self = sys->at_rest.self;
  const size_t bytes = sys->at_rest.n * sizeof *f->null;
  bool found = sys->at_rest.residual(self, f->excess, NULL) == ZP_END_FOUND;
  double before = 1, step = 1;
  while (found && before > 0 && step >= shortest) {
    sys->save(self, f->start);
    memcpy(f->null_at_start, f->null, bytes);
    f->share = before - step;
    if (solve(f, (Goal){.kind = TO_FOLD, .to = f->share > 0 ? ZP_FOLD_ROUGH : ZP_FOLD_EXACT}) && f->negative == 0) {
      before = f->share;
      step = fmin(2 * step, before);
      continue;
    }
    sys->restore(self, f->start);
    memcpy(f->null, f->null_at_start, bytes);
    step *= 0.5;
  }
  f->share = 0;
  return found && before == 0;
}

bool zp_fold_event(ZpFold *f, ZpEvent event, double value, ZpFoldTo to) {
  return solve(f, (Goal){TO_EVENT, event, value, to});
}

void zp_fold_leave(ZpFold *f, const double *null, ZpEvent event, double change) {
  const ZpStaticSystem *rest = &f->system->at_rest;
  rest->residual(rest->self, f->newton->r, NULL); /* a move turns the edges of the last residual */
  event(rest->self, f->x);
  double way = change / zp_dot(rest->n, f->x, null);
  for (size_t i = 0; i < rest->n; i++)
    f->b[i] = way * null[i];
  double length = rest->length(rest->self, f->b);
  rest->move(rest->self, f->b, length > 1 ? 1 / length : 1);
}

ZpPass zp_fold_pass(ZpFold *f, ZpEvent event, double here, double next, double *m, double *slope) {
  static const double near = 1e3; /* times the required accuracy: the remaining error is squared */
  const ZpBranchSystem *sys = f->system;
  const ZpStaticSystem *rest = &sys->at_rest;
  if (!zp_fold_tangent(f)) return ZP_PASS_LOST;
  balance(f);
  double value = event(rest->self, f->x), along = zp_dot(rest->n, f->x, f->along);
  double dm = (here - value - zp_dot(rest->n, f->x, f->a)) / along, on = (next - here) / along;
  if (!isfinite(dm) || !isfinite(on)) return ZP_PASS_LOST;
  for (size_t i = 0; i < rest->n; i++)
    f->a[i] += dm * f->along[i];
  bool passes = rest->change(rest->self, f->a) < near;
  *m = zp_branch_parameter(sys) + dm;
  *slope = 1 / along;
  step(f, passes ? on : 0, passes ? dm + on : dm);
  return passes ? ZP_PASS_ON : ZP_PASS_AGAIN;
}

bool zp_fold_rest(ZpFold *f) {
  return solve(f, (Goal){.kind = TO_REST, .to = ZP_FOLD_ROUGH});
}
