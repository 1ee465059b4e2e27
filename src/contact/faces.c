/* Letters of docs/theory.md, section 9: g gap, m; s = -g / delta where that is positive. The push per length is
 * p_c s^3, its stiffness 3 p_c s^2 / delta. */
#include "contact/faces.h"

#include <math.h>
#include <string.h>

#include "math/gauss.h"

void zp_faces_carve(const ZpFacesParams *p, ZpFacesEval *e, ZpCarver *carver) {
  e->push = zp_carve(carver, p->nodes);
  e->own = zp_carve(carver, p->nodes);
  e->next = zp_carve(carver, p->nodes);
  e->stiffness = zp_carve(carver, p->nodes);
}

/* How deep faces are in each other, in units of delta. */
static inline double depth(const ZpFacesParams *p, double gap) {
  return gap < 0 ? -gap / p->depth : 0;
}

static void add_element(const ZpFacesParams *p, const double *gap, size_t i, const ZpFacesEval *e) {
  const double *share = zp_gauss_shares(&p->level, i);
  for (int q = 0; q < GAUSS; q++) {
    double r = share[q], l = 1 - r, s = depth(p, l * gap[i] + r * gap[i + 1]);
    double f = gauss_weight[q] * p->l * p->push * s * s, c = 3 * f / p->depth;
    e->push[i] += l * f * s;
    e->push[i + 1] += r * f * s;
    e->stiffness[i] += l * c;
    e->stiffness[i + 1] += r * c;
    e->own[i] += l * l * c;
    e->own[i + 1] += r * r * c;
    e->next[i] += l * r * c;
  }
}

/* Is element i the platform? */
static bool is_rigid(const ZpFacesParams *p, size_t i) {
  return i >= p->platform && i < p->platform_end;
}

static void add_platform(const ZpFacesParams *p, const double *gap, size_t i, const ZpFacesEval *e) {
  double s = depth(p, gap[i]), f = p->flat_length * p->push * s * s;
  e->push[i] += f * s;
  e->own[i] += 3 * f / p->depth;
  e->stiffness[i] += 3 * f / p->depth;
}

void zp_faces_eval(const ZpFacesParams *p, const double *gap, const ZpFacesEval *e) {
  memset(e->push, 0, p->nodes * sizeof *e->push);
  memset(e->own, 0, p->nodes * sizeof *e->own);
  memset(e->next, 0, p->nodes * sizeof *e->next);
  memset(e->stiffness, 0, p->nodes * sizeof *e->stiffness);
  for (size_t i = 0; i + 1 < p->nodes; i++)
    if ((gap[i] < 0 || gap[i + 1] < 0) && !is_rigid(p, i)) add_element(p, gap, i, e);
  for (size_t i = p->platform; i <= p->platform_end; i++)
    add_platform(p, gap, i, e);
}

double zp_faces_kept(const ZpFacesEval *e, size_t i, double reduced_mass, double dt) {
  return 1 / (1 + ZP_FACES_LOSS_FACTOR * dt * sqrt(e->stiffness[i] / reduced_mass));
}

size_t zp_faces_front(const ZpFacesParams *p, const double *gap) {
  size_t front = 0;
  while (front < p->platform && gap[front + 1] < ZP_CLOSED_GAP)
    front++;
  return front;
}
