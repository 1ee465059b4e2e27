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

/* Gap of a member that closes last in it, m. */
static double gap_of(const ZpRestMember *m) {
  if (!m->model->field) return 0;
  LastToClose last = last_to_close(m->model);
  const double *gap = m->eval.plates.gap;
  return 0.5 * (gap[last.station[0]] + gap[last.station[1]]);
}

/* The member that decides whether the system counts as closed: the last one to close of those side by side, the first
 * one of antagonists. */
static const ZpRestMember *deciding(const ZpStatics *s) {
  const ZpRestMember *found = s->member;
  for (size_t k = 1; k < s->members; k++) {
    const ZpRestMember *m = &s->member[k];
    bool nearer = gap_of(m) - m->closed < gap_of(found) - found->closed;
    if (nearer == (s->distance > 0)) found = m;
  }
  return found;
}

static void add_gap_row(const ZpRestMember *m, double *row) {
  const ZpTopology *t = &m->model->topology;
  LastToClose last = last_to_close(m->model);
  for (size_t k = 0; k < 2; k++) {
    zp_assembly_add_one(&m->assembly, 2 * zp_lower(t, last.station[k]) + 1, -0.5, row);
    if (zp_is_pair(t)) zp_assembly_add_one(&m->assembly, 2 * zp_upper(t, last.station[k]) + 1, 0.5, row);
  }
}

double zp_closing_gap(void *self, double *row) {
  const ZpStatics *s = self;
  const ZpRestMember *m = deciding(s);
  if (row) memset(row, 0, s->n * sizeof *row);
  if (row) add_gap_row(m, row);
  return m == s->member ? gap_of(m) : gap_of(m) - m->closed + s->member->closed;
}

double zp_mark_closed(ZpStatics *s) {
  for (size_t k = 0; k < s->members; k++)
    s->member[k].closed = zp_closed_opening(s->member[k].model, gap_of(&s->member[k]));
  return s->member->closed;
}

double zp_open_gap(const ZpStatics *s) {
  double sum = gap_of(s->member);
  for (size_t k = 1; k < s->members && !s->shared; k++)
    sum += gap_of(&s->member[k]);
  return sum;
}

size_t zp_closed_members(const ZpStatics *s) {
  size_t closed = 0;
  for (size_t k = 0; k < s->members; k++)
    closed += gap_of(&s->member[k]) <= s->member[k].closed;
  return closed;
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
  for (size_t i = 0; i < s->n; i++)
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
