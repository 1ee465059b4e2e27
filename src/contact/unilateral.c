/* Penalty contact. Letters of docs/theory.md, section 9: g gap, m (negative where faces overlap);
 * k stiffness, N/m^2; energy per length k g^2 / 2 where g < 0. */
#include "contact/unilateral.h"

#include <string.h>

enum { GAUSS = 3 };
static const double gauss_at[GAUSS] = {0.11270166537925831, 0.5, 0.88729833462074169};
static const double gauss_weight[GAUSS] = {5.0 / 18, 8.0 / 18, 5.0 / 18};

double zp_unilateral_push(const ZpUnilateralParams *p, const double *gap, double *push) {
  double energy = 0;
  memset(push, 0, p->nodes * sizeof *push);
  for (size_t i = 0; i + 1 < p->nodes; i++) {
    if (gap[i] >= 0 && gap[i + 1] >= 0) continue;
    for (int q = 0; q < GAUSS; q++) {
      double g = gap[i] + (gap[i + 1] - gap[i]) * gauss_at[q];
      if (g >= 0) continue;
      double f = -p->k * g * gauss_weight[q] * p->l;
      push[i] += f * (1 - gauss_at[q]);
      push[i + 1] += f * gauss_at[q];
      energy -= 0.5 * f * g;
    }
  }
  double last = gap[p->nodes - 1];
  if (last >= 0) return energy;
  push[p->nodes - 1] -= p->k * last * p->flat_length;
  return energy + 0.5 * p->k * last * last * p->flat_length;
}

void zp_unilateral_stiffness(const ZpUnilateralParams *p, const double *gap, double *own, double *next) {
  memset(own, 0, p->nodes * sizeof *own);
  memset(next, 0, p->nodes * sizeof *next);
  for (size_t i = 0; i + 1 < p->nodes; i++) {
    if (gap[i] >= 0 && gap[i + 1] >= 0) continue;
    for (int q = 0; q < GAUSS; q++) {
      if (gap[i] + (gap[i + 1] - gap[i]) * gauss_at[q] >= 0) continue;
      double c = p->k * gauss_weight[q] * p->l;
      own[i] += c * (1 - gauss_at[q]) * (1 - gauss_at[q]);
      own[i + 1] += c * gauss_at[q] * gauss_at[q];
      next[i] += c * gauss_at[q] * (1 - gauss_at[q]);
    }
  }
  if (gap[p->nodes - 1] < 0) own[p->nodes - 1] += p->k * p->flat_length;
}

size_t zp_unilateral_front(const ZpUnilateralParams *p, const double *gap, double closed) {
  size_t front = 0;
  while (front + 1 < p->nodes && gap[front + 1] < closed)
    front++;
  return front;
}
