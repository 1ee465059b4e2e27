#include "solve/explicit.h"

#include "base/kernel.h"

ZP_KERNEL static void advance(size_t n, double dt, const double *restrict a, double *restrict v, double *restrict q) {
  ZP_SIMD
  for (size_t j = 0; j < n; j++) {
    v[j] += a[j] * dt;
    q[j] += v[j] * dt;
  }
}

ZpExplicitStep zp_explicit_step(const ZpExplicitSystem *system, double longest, double *q, double *v, double *a) {
  ZpExplicitStep step = {system->accelerate(system->self, q, v, a), ZP_EXPLICIT_BOUND};
  if (step.dt >= longest) step = (ZpExplicitStep){longest, ZP_EXPLICIT_END};
  if (system->next_event) {
    double event = system->next_event(system->self, q, v, a, step.dt);
    if (event < step.dt) step = (ZpExplicitStep){event, ZP_EXPLICIT_EVENT};
  }
  advance(system->n, step.dt, a, v, q);
  return step;
}
