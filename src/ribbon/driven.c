#include "ribbon/driven.h"

#include <math.h>
#include <string.h>

#include "math/elementary.h"

double zp_driven_share(const ZpDrivenPlace *p, double h) {
  if (p->lag == 0) return 1;
  const double x = h / p->lag;
  return h > 0 ? -zp_decay(x) * zp_decay_weight(x) : 0;
}

double zp_driven_after(const ZpDrivenPlace *p, double kappa, double g0, double g1, double h) {
  if (p->lag == 0) return g1;
  return kappa - zp_decay(h / p->lag) * (g0 - kappa) + zp_driven_share(p, h) * (g1 - g0);
}

double zp_driven_natural(double turn) {
  if (turn == 0) return turn; /* of most joints */
  return zp_rod_curvature(zp_tangent(0.5 * turn));
}

/* Natural turn of joint j. A voltage that a program sets may ask for more than a joint can turn. */
static double turn_of(const ZpDriven *d, const double *kappa, size_t j) {
  static const double most = 3; /* rad */
  double turn = d->turn[j];
  for (size_t p = 0; p < d->places; p++)
    turn += kappa[p] * d->place[p].turn[j];
  return fmin(fmax(turn, -most), most);
}

void zp_driven_bend(const ZpDriven *d, const double *kappa, double *k0) {
  for (const ZpDrivenPlace *p = d->place; p < d->place + d->places; p++)
    for (size_t j = p->first; j < p->end; j++)
      if (p->turn[j] != 0) k0[j] = zp_driven_natural(turn_of(d, kappa, j));
}

/* dk0/dturn: (2 q + 2 / q - 1) / 3 with q = 1 + tan(turn / 2)^2. */
void zp_driven_bend_rate(const ZpDriven *d, const double *kappa, const double *rate, double *by) {
  for (const ZpDrivenPlace *p = d->place; p < d->place + d->places; p++)
    for (size_t j = p->first; j < p->end; j++) {
      if (p->turn[j] == 0) continue;
      const double half = zp_tangent(0.5 * turn_of(d, kappa, j)), q = 1 + half * half;
      double turns = 0;
      for (size_t k = 0; k < d->places; k++)
        turns += rate[k] * d->place[k].turn[j];
      by[j] = turns * (2 * q + 2 / q - 1) * (1.0 / 3);
    }
}

/* Curvature of a joint beyond its natural one, as means of both. */
static double beyond(const ZpRodEval *e0, const ZpRodEval *e1, const double *n0, const double *n1, size_t j) {
  return 0.5 * (e0->k[j] + e1->k[j] - n0[j] - n1[j]);
}

double zp_driven_work(const ZpRodParams *p, const ZpRodEval *e0, const ZpRodEval *e1, const double *n0,
                      const double *n1) {
  double sum = 0;
  for (size_t j = 0; j < p->ribbons * p->nodes; j++)
    if (n0[j] != n1[j]) sum -= p->B[j] * beyond(e0, e1, n0, n1, j) * (n1[j] - n0[j]);
  for (const ZpRodEnd *end = p->end; end < p->end + p->ends; end++)
    sum -= end->B * (beyond(e0, e1, n0, n1, end->held) * (n1[end->next] - n0[end->next]) +
                     beyond(e0, e1, n0, n1, end->next) * (n1[end->held] - n0[end->held]));
  return sum;
}

/* A joint with moment m pulls on the edge behind it by -m g, and on the edge before it by m g. */
static void add_moment(const ZpRodParams *p, const ZpRodStep *s, size_t j, double m, double *Rx, double *Ry) {
  const size_t r = p->ribbons;
  if (j < r * (p->nodes - 1)) {
    Rx[j] -= m * s->gx[j];
    Ry[j] -= m * s->gy[j];
  }
  if (j < r) return;
  Rx[j - r] += m * s->gx[j - r];
  Ry[j - r] += m * s->gy[j - r];
}

void zp_driven_edges(const ZpRodParams *p, const ZpRodStep *s, const double *by, double share, double *Rx, double *Ry) {
  memset(Rx, 0, p->lanes * sizeof *Rx);
  memset(Ry, 0, p->lanes * sizeof *Ry);
  for (size_t j = 0; j < p->ribbons * p->nodes; j++)
    if (by[j] != 0) add_moment(p, s, j, -share * p->B[j] * by[j] * s->slope[j], Rx, Ry);
  for (const ZpRodEnd *end = p->end; end < p->end + p->ends; end++) {
    add_moment(p, s, end->held, -share * end->B * by[end->next] * s->slope[end->held], Rx, Ry);
    add_moment(p, s, end->next, -share * end->B * by[end->held] * s->slope[end->next], Rx, Ry);
  }
}
