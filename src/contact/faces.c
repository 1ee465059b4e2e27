/* Letters of docs/theory.md, section 9: g gap, m; a range of contact; c stiffness per length, N/m^2. The push per
 * length is p = c (a - g)^2 / (4 a) within a of g = 0, and -c g where faces overlap by more. */
#include "contact/faces.h"

#include <string.h>

#include "math/gauss.h"

static const double a = ZP_CONTACT_RANGE;

/* p / c and dp/dg / -c. */
static inline double depth(double g) {
  return g >= a ? 0 : g <= -a ? -g : (a - g) * (a - g) / (4 * a);
}

static inline double rise(double g) {
  return g >= a ? 0 : g <= -a ? 1 : (a - g) / (2 * a);
}

void zp_faces_push(const ZpFacesParams *p, const double *gap, double *push) {
  memset(push, 0, p->nodes * sizeof *push);
  for (size_t i = 0; i + 1 < p->nodes; i++) {
    if (gap[i] >= a && gap[i + 1] >= a) continue;
    for (int q = 0; q < GAUSS; q++) {
      double f = p->stiffness * p->l * gauss_weight[q] * depth(gap[i] + (gap[i + 1] - gap[i]) * gauss_at[q]);
      push[i] += f * (1 - gauss_at[q]);
      push[i + 1] += f * gauss_at[q];
    }
  }
  push[p->nodes - 1] += p->stiffness * p->flat_length * depth(gap[p->nodes - 1]);
}

void zp_faces_stiffness(const ZpFacesParams *p, const double *gap, double *own, double *next) {
  for (size_t i = 0; i + 1 < p->nodes; i++) {
    if (gap[i] >= a && gap[i + 1] >= a) continue;
    for (int q = 0; q < GAUSS; q++) {
      double c = p->stiffness * p->l * gauss_weight[q] * rise(gap[i] + (gap[i + 1] - gap[i]) * gauss_at[q]);
      own[i] += c * (1 - gauss_at[q]) * (1 - gauss_at[q]);
      own[i + 1] += c * gauss_at[q] * gauss_at[q];
      next[i] += c * gauss_at[q] * (1 - gauss_at[q]);
    }
  }
  own[p->nodes - 1] += p->stiffness * p->flat_length * rise(gap[p->nodes - 1]);
}

size_t zp_faces_front(const ZpFacesParams *p, const double *gap) {
  size_t front = 0;
  while (front + 1 < p->nodes && gap[front + 1] < ZP_CONTACT_TOUCH)
    front++;
  return front;
}
