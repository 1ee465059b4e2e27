#include "rest/closing.h"

#include <math.h>
#include <string.h>

/* Stations whose mean gap tells whether the actuator is closed: both ends of a platform, or one station twice. */
typedef struct LastToClose {
  size_t station[2];
} LastToClose;

static LastToClose last_to_close(const ZpModel *model) {
  const ZpJoint *end = &model->topology.platform;
  if (end->kind == ZP_JOINT_CLAMP) return (LastToClose){{end->first / 2, end->first / 2}};
  return (LastToClose){{end->first, end->last}};
}

double zp_closing_gap(void *self, double *row) {
  const ZpStatics *s = self;
  const ZpModel *model = s->model;
  const ZpTopology *t = &model->topology;
  LastToClose last = last_to_close(model);
  if (row) memset(row, 0, s->assembly.n * sizeof *row);
  for (size_t k = 0; row && k < 2; k++) {
    int lower = s->assembly.equation[2 * zp_lower(t, last.station[k]) + 1],
        upper = s->assembly.equation[2 * zp_upper(t, last.station[k]) + 1];
    if (lower >= 0) row[lower] -= 0.5;
    if (zp_is_pair(t) && upper >= 0) row[upper] += 0.5;
  }
  return 0.5 * (s->eval.plates.gap[last.station[0]] + s->eval.plates.gap[last.station[1]]);
}

/* -- along the square of the voltage ---------------------------------------------------------------- */

static double get_square(void *self) {
  const ZpStatics *s = self;
  return s->U * s->U;
}

static void set_square(void *self, double square) {
  ((ZpStatics *)self)->U = square > 0 ? sqrt(square) : 0;
}

/* dr/dU over 2 U; at U = 0 its value at 1 V, where no cap acts. */
static void by_square(void *self, double *r_m) {
  ZpStatics *s = self;
  double U = fmax(fabs(s->U), 1);
  zp_statics_by_voltage(s, U, r_m);
  for (size_t i = 0; i < s->assembly.n; i++)
    r_m[i] /= 2 * U;
}

ZpBranchSystem zp_closing_by_square(ZpStatics *s) {
  ZpBranchSystem system = zp_statics_branch(s, ZP_ALONG_VOLTAGE);
  system.get = get_square;
  system.set = set_square;
  system.sensitivity = by_square;
  system.m_scale *= system.m_scale;
  return system;
}
