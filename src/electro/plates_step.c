/* Letters as in plates.c; 0 and 1 are the step's start and end. Over the step a piece of length dx has the force
 * (P1 - P0) / (g1 - g0) on its gap, times the mean dx, and the mean P on its length: together their work is P1 dx1 -
 * P0 dx0. */
#include "electro/plates_step.h"

#include <math.h>
#include <string.h>

#include "math/gauss.h"

void zp_plates_step_carve(const ZpPlatesParams *p, ZpPlatesStep *s, ZpCarver *carver) {
  s->Fx = zp_carve(carver, p->stride);
  s->Fy = zp_carve(carver, p->stride);
  double **arrays[] = {&s->own, &s->next, &s->along0, &s->along1};
  for (size_t k = 0; k < sizeof arrays / sizeof arrays[0]; k++)
    *arrays[k] = zp_carve(carver, p->nodes);
}

/* The law between two gaps. */
typedef struct Between {
  double W;     /* (P1 - P0) / (g1 - g0) */
  double slope; /* its derivative by g1 */
  double P;     /* (P0 + P1) / 2 */
  double W1;    /* dP/dg at g1 */
} Between;

/* P = -K (2 / h* - h / h*^2). Where both ends are on one side of the cap the quotient has no difference in it:
 * K / (h0 h1) above, K / h_c^2 below. */
static Between between(double K, double h_c, double h0, double h1) {
  double b0 = 1 / fmax(h0, h_c), b1 = 1 / fmax(h1, h_c), P0 = -K * b0 * (2 - h0 * b0), P1 = -K * b1 * (2 - h1 * b1);
  Between law = {.P = 0.5 * (P0 + P1), .W1 = K * b1 * b1};
  bool open0 = h0 > h_c, open1 = h1 > h_c;
  if (open0 == open1) {
    law.W = K * b0 * b1;
    law.slope = open1 ? -law.W * b1 : 0;
  } else {
    law.W = (P1 - P0) / (h1 - h0);
    law.slope = (law.W1 - law.W) / (h1 - h0);
  }
  return law;
}

/* Force on both nodes of station i. */
static void act(const ZpPlatesParams *p, ZpPlatesStep *s, size_t i, double along, double closing) {
  if (p->flat) {
    s->Fx[i] += 2 * along;
    s->Fy[i] += closing;
    return;
  }
  s->Fx[2 * i] += along;
  s->Fx[2 * i + 1] += along;
  s->Fy[2 * i] -= closing;
  s->Fy[2 * i + 1] += closing;
}

/* The same of the law with what the strips' lateral edges add, which has no such quotient in closed form. */
static Between between_with_edges(const ZpPlatesParams *p, double U, double g0, double g1) {
  static const double near =
      1e-8; /* m: closer, the difference of P is rounding, the mean force is exact to its square */
  ZpPlatesLaw law0 = zp_plates_law(p, U, g0), law1 = zp_plates_law(p, U, g1);
  Between law = {.P = 0.5 * (law0.P + law1.P), .W1 = law1.W, .W = 0.5 * (law0.W + law1.W)};
  if (fabs(g1 - g0) < near) return law;
  law.W = (law1.P - law0.P) / (g1 - g0);
  law.slope = (law1.W - law.W) / (g1 - g0);
  return law;
}

/* What of the law holds for all elements of a step. */
typedef struct Law {
  const ZpPlatesParams *p;
  double U, K, h_c;
} Law;

static Between law_between(const Law *law, double g0, double g1) {
  const ZpPlatesParams *p = law->p;
  return p->edges ? between_with_edges(p, law->U, g0, g1) : between(law->K, law->h_c, g0 + p->d, g1 + p->d);
}

static void add_element(const Law *of, const ZpPlatesEval *e0, const ZpPlatesEval *e1, size_t i, ZpPlatesStep *s) {
  double dx = 0.5 * (e0->dx[i] + e1->dx[i]), left = 0, right = 0, P = 0;
  s->next[i] = s->along0[i] = s->along1[i] = 0;
  for (int q = 0; q < GAUSS; q++) {
    double r = gauss_at[q], l = 1 - r, w = gauss_weight[q];
    Between law = law_between(of, l * e0->gap[i] + r * e0->gap[i + 1], l * e1->gap[i] + r * e1->gap[i + 1]);
    left += w * l * law.W;
    right += w * r * law.W;
    P += w * law.P;
    s->own[i] += w * dx * l * l * law.slope;
    s->next[i] += w * dx * l * r * law.slope;
    s->own[i + 1] += w * dx * r * r * law.slope;
    s->along0[i] += 0.5 * w * l * law.W1;
    s->along1[i] += 0.5 * w * r * law.W1;
  }
  act(of->p, s, i, 0.5 * P, left * dx);
  act(of->p, s, i + 1, -0.5 * P, right * dx);
}

void zp_plates_step(const ZpPlatesParams *p, const ZpPlatesEval *e0, const ZpPlatesEval *e1, double U,
                    ZpPlatesStep *s) {
  Law law = {p, U, p->k * U * U, zp_plates_least_h(p, U)};
  size_t last = p->nodes - 1;
  memset(s->Fx, 0, p->stride * sizeof *s->Fx);
  memset(s->Fy, 0, p->stride * sizeof *s->Fy);
  memset(s->own, 0, p->nodes * sizeof *s->own);
  for (size_t i = 0; i < last; i++)
    add_element(&law, e0, e1, i, s);
  if (!(p->flat_length > 0)) return;
  Between platform = law_between(&law, e0->gap[last], e1->gap[last]);
  act(p, s, last, 0, p->flat_length * platform.W);
  s->own[last] += p->flat_length * platform.slope;
}
