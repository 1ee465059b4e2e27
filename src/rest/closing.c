#include "rest/closing.h"

#include <math.h>
#include <string.h>

static size_t last_to_close(const ZpModel *model) {
  bool clamped = model->flat && model->def.actuator.right_end == ZP_END_CLAMPED;
  return clamped ? (model->nodes - 1) / 2 : model->nodes - 1;
}

double zp_closing_gap(void *self, double *row) {
  const ZpStatics *s = self;
  const ZpModel *model = s->model;
  size_t station = last_to_close(model), lower = model->s * station + model->s - 1;
  if (row) {
    const int *equation = s->assembly.equation;
    memset(row, 0, s->assembly.n * sizeof *row);
    if (equation[2 * lower + 1] >= 0) row[equation[2 * lower + 1]] -= 1;
    if (model->s == 2 && equation[2 * lower - 1] >= 0) row[equation[2 * lower - 1]] += 1;
  }
  return s->eval.plates.gap[station];
}

double zp_closing_limit(const ZpStatics *s, double hanging) {
  static const double closed_part = 0.01;
  return fmax(closed_part * hanging, s->model->faces.depth);
}

/* -- along the square of the voltage ---------------------------------------------------------------- */

static double get_square(void *self) {
  const ZpStatics *s = self;
  return s->U * s->U;
}

static void set_square(void *self, double square) {
  ((ZpStatics *)self)->U = square > 0 ? sqrt(square) : 0;
}

/* By a central difference; at 0, where there is nothing on the other side, by one to the right. */
static void by_square(void *self, double *r_m) {
  ZpStatics *s = self;
  ZpStaticSystem rest = zp_statics_system(s);
  double U = s->U, m = U * U, up = fmax(1e-4 * m, 1), down = fmin(up, m);
  set_square(s, m + up);
  rest.residual(s, s->r_up, NULL);
  set_square(s, m - down);
  rest.residual(s, s->r_down, NULL);
  s->U = U;
  rest.residual(s, r_m, NULL);
  for (size_t i = 0; i < rest.n; i++)
    r_m[i] = (s->r_up[i] - s->r_down[i]) / (up + down);
}

ZpBranchSystem zp_closing_by_square(ZpStatics *s) {
  ZpBranchSystem system = zp_statics_branch(s, ZP_ALONG_VOLTAGE);
  system.get = get_square;
  system.set = set_square;
  system.sensitivity = by_square;
  system.m_scale *= system.m_scale;
  return system;
}
