/* Soft contact. Letters of docs/theory.md, section 9: g gap, m; with s = 1 - g / range, where it is positive,
 * the pressure per length is p0 s^3, its stiffness 3 p0 s^2 / range. */
#include "contact/unilateral.h"

#include <string.h>

#include "math/gauss.h"

/* How deep faces are in each other's range: 0 beyond it, 1 at gap 0, more where they overlap. */
static double depth(const ZpUnilateralParams *p, double gap) {
  double s = 1 - gap / p->range;
  return s > 0 ? s : 0;
}

void zp_unilateral_push(const ZpUnilateralParams *p, const double *gap, double *push) {
  memset(push, 0, p->nodes * sizeof *push);
  for (size_t i = 0; i + 1 < p->nodes; i++) {
    if (gap[i] >= p->range && gap[i + 1] >= p->range) continue;
    for (int q = 0; q < GAUSS; q++) {
      double s = depth(p, gap[i] + (gap[i + 1] - gap[i]) * gauss_at[q]);
      double f = p->p0 * s * s * s * gauss_weight[q] * p->l;
      push[i] += f * (1 - gauss_at[q]);
      push[i + 1] += f * gauss_at[q];
    }
  }
  double s = depth(p, gap[p->nodes - 1]);
  push[p->nodes - 1] += p->p0 * s * s * s * p->flat_length;
}

static double stiffness(const ZpUnilateralParams *p, double gap) {
  double s = depth(p, gap);
  return 3 * p->p0 * s * s / p->range;
}

void zp_unilateral_stiffness(const ZpUnilateralParams *p, const double *gap, double *own, double *next) {
  for (size_t i = 0; i + 1 < p->nodes; i++) {
    if (gap[i] >= p->range && gap[i + 1] >= p->range) continue;
    for (int q = 0; q < GAUSS; q++) {
      double c = stiffness(p, gap[i] + (gap[i + 1] - gap[i]) * gauss_at[q]) * gauss_weight[q] * p->l;
      own[i] += c * (1 - gauss_at[q]) * (1 - gauss_at[q]);
      own[i + 1] += c * gauss_at[q] * gauss_at[q];
      next[i] += c * gauss_at[q] * (1 - gauss_at[q]);
    }
  }
  own[p->nodes - 1] += stiffness(p, gap[p->nodes - 1]) * p->flat_length;
}

size_t zp_unilateral_front(const ZpUnilateralParams *p, const double *gap) {
  size_t front = 0;
  while (front + 1 < p->nodes && gap[front + 1] < p->touch)
    front++;
  return front;
}
