/* Central differences with unit step, v' = ((2 - c) v + 2 a*) / (2 + c), q += v', where c = 2 omega damps
 * the slowest motion critically and a* = a + beta (a - a of the step before) damps the fastest, which
 * rounding would keep alive. With beta = 1/4 the fastest stable frequency is 1.6. omega^2 is the Rayleigh quotient - dq
 * . da / dq . dq of what moved over the last stretch of steps: fast motion averages out of it, so it finds the slowest
 * mode. Near rest rounding takes over and the quotient rises; c follows it down at once but up only slowly. */
#include "solve/relax.h"

#include <math.h>
#include <string.h>

enum { STRETCH = 64 }; /* steps between looks at the residual and the damping */
static const double beta = 0.25;
static const double most_growth = 1 + 1.0 / 4096; /* of the damping, per stretch */

static double critical_damping(size_t n, const double *q, const double *a, const double *q_before,
                               const double *a_before) {
  double dq_da = 0, dq_dq = 0;
  for (size_t j = 0; j < n; j++) {
    double dq = q[j] - q_before[j];
    dq_da -= dq * (a[j] - a_before[j]);
    dq_dq += dq * dq;
  }
  double omega2 = dq_dq > 0 ? dq_da / dq_dq : 0;
  return omega2 > 0 ? 2 * sqrt(fmin(omega2, 1)) : 0;
}

static void damped_step(size_t n, double c, const double *restrict a, double *restrict a_last, double *restrict v,
                        double *restrict q) {
  double keep = (2 - c) / (2 + c), push = 2 / (2 + c);
  for (size_t j = 0; j < n; j++) {
    v[j] = keep * v[j] + push * (a[j] + beta * (a[j] - a_last[j]));
    q[j] += v[j];
    a_last[j] = a[j];
  }
}

static ZpRelaxEnd look(const ZpRelaxSystem *system, double tolerance, ZpRelaxInfo *info) {
  info->residual = system->residual(system->self);
  if (!isfinite(info->residual)) return ZP_RELAX_DIVERGED;
  if (info->residual < tolerance) return ZP_RELAX_AT_REST;
  if (system->stop && system->stop(system->self, info->steps, info->residual)) return ZP_RELAX_STOPPED;
  return ZP_RELAX_STEP_LIMIT;
}

ZpRelaxInfo zp_relax(const ZpRelaxSystem *system, double tolerance, int64_t most_steps, double *q, double *work) {
  size_t n = system->n;
  double *v = work, *a = work + n, *q_before = work + 2 * n, *a_before = work + 3 * n;
  double *a_last = work + 4 * n, c = 0;
  ZpRelaxInfo info = {ZP_RELAX_STEP_LIMIT, 0, INFINITY};
  memset(v, 0, n * sizeof *v);
  for (; info.steps < most_steps; info.steps++) {
    system->accelerate(system->self, q, a);
    if (info.steps % STRETCH == 0) {
      info.end = look(system, tolerance, &info);
      if (info.end != ZP_RELAX_STEP_LIMIT) break;
      double critical = info.steps > 0 ? critical_damping(n, q, a, q_before, a_before) : 0;
      if (critical > 0) c = c > 0 ? fmin(critical, c * most_growth) : critical;
      memcpy(q_before, q, n * sizeof *q);
      memcpy(a_before, a, n * sizeof *a);
    }
    if (info.steps == 0) memcpy(a_last, a, n * sizeof *a);
    damped_step(n, c, a, a_last, v, q);
  }
  return info;
}
