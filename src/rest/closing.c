#include "rest/closing.h"

#include <math.h>
#include <string.h>

#include "solve/descend.h"

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

/* -- falling ---------------------------------------------------------------------------------------- */

typedef struct Fall {
  ZpStatics *statics;
  double limit;
  bool was_closed, to_rest;
} Fall;

/* It has opened or closed once it is clear of the limit. */
static bool is_decided(void *user) {
  static const double clear = 10;
  const Fall *fall = user;
  if (fall->to_rest) return false;
  double gap = zp_closing_gap(fall->statics, NULL);
  return fall->was_closed ? gap > clear * fall->limit : gap < fall->limit / clear;
}

bool zp_closing_fall(ZpStatics *s, double limit, bool was_closed, bool to_rest, ZpNewtonWork *work) {
  static const double shortest = 1e-3,
                      longest = 0.1; /* 0.5 mrad, so as not to step over a state that is near; 50 mrad */
  enum { FIRST = 80, MOST = 5000 };
  ZpStaticSystem system = zp_statics_system(s);
  Fall fall = {s, limit, was_closed, to_rest};
  double tolerance = zp_statics_tolerance(s);
  ZpNewtonInfo info = zp_descend_until(&system, shortest, tolerance, FIRST, is_decided, &fall, work);
  if (info.end == ZP_NEWTON_SLOW) info = zp_descend_until(&system, longest, tolerance, MOST, is_decided, &fall, work);
  return zp_newton_good(info.end);
}
