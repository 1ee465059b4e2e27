#include "ribbon/rod_maxwell.h"

#include <math.h>

#include "ribbon/rod_point.h"

size_t zp_rod_maxwell_count(const ZpRodParams *p) {
  return p->branch ? sizeof(ZpBent) / sizeof(double) * ZP_BRANCHES * zp_rod_point_count(p) : 0;
}

/* A branch at a point. */
typedef struct At {
  const ZpMaxwell *branch;
  ZpRodPoint point;
  size_t number; /* of the branch in its ribbon */
  size_t place;  /* of its spring, in numbers */
} At;

/* The branches of all points in turn, from `at` on, beginning with {0}. */
typedef struct Walk {
  size_t next;
} Walk;

static bool walk(const ZpRodParams *p, Walk *from, At *at) {
  for (size_t k = from->next; p->branch && k < ZP_BRANCHES * zp_rod_point_count(p); k++) {
    const size_t i = k / ZP_BRANCHES;
    *at = (At){.point = zp_rod_point(p, i), .place = 2 * k, .number = k % ZP_BRANCHES};
    at->branch = &p->branch[zp_rod_point_ribbon(p, &at->point) * ZP_BRANCHES + at->number];
    if (!(at->point.length > 0) || !(at->branch->time > 0)) continue;
    from->next = k + 1;
    return true;
  }
  return false;
}

static ZpBent spring_at(const double *spring, const At *at) {
  return spring ? (ZpBent){spring[at->place], spring[at->place + 1]} : (ZpBent){0, 0};
}

double zp_rod_maxwell_energy(const ZpRodParams *p, const double *spring) {
  double sum = 0;
  At at;
  for (Walk to = {0}; spring && walk(p, &to, &at);)
    sum += at.point.length * zp_maxwell_energy(at.branch, spring_at(spring, &at));
  return sum;
}

/* The change of the shape at a point. */
static ZpBent change_at(const ZpRodParams *p, const ZpRodPoint *point, const ZpRodEval *e0, const ZpRodEval *e1) {
  return (ZpBent){zp_rod_point_curvature(p, point, e1) - zp_rod_point_curvature(p, point, e0),
                  zp_rod_point_strain(p, point, e1) - zp_rod_point_strain(p, point, e0)};
}

/* The weights of a branch, which those of a ribbon share. */
static ZpMaxwellStep weights_of(const At *at, const ZpRodStep *s) {
  return zp_maxwell_step(s->h / at->branch->time);
}

static ZpBent put_end(const At *at, const ZpMaxwellStep *weights, ZpBent change, const ZpRodStep *s) {
  ZpBent end = zp_maxwell_end(weights, spring_at(s->spring_start, at), change);
  s->spring_end[at->place] = end.curvature;
  s->spring_end[at->place + 1] = end.strain;
  return end;
}

static ZpSectionForce taken(const ZpSectionForce *adds) {
  return (ZpSectionForce){-adds->M, -adds->N, -adds->K, -adds->both, -adds->axial};
}

void zp_rod_maxwell_step(const ZpRodParams *p, const ZpRodEval *e0, const ZpRodEval *e1, bool still, ZpRodStep *s) {
  At at;
  for (Walk to = {0}; !still && walk(p, &to, &at);) {
    const ZpMaxwellStep weights = weights_of(&at, s);
    const ZpBent change = change_at(p, &at.point, e0, e1);
    ZpSectionForce mean =
        zp_maxwell_force(at.branch, zp_maxwell_mean(&weights, spring_at(s->spring_start, &at), change), weights.half);
    put_end(&at, &weights, change, s);
    mean = taken(&mean);
    zp_rod_point_take(p, &at.point, &mean, e1, s);
  }
}

void zp_rod_maxwell_stiffness(const ZpRodParams *p, const ZpRodStep *s, double (*D)[4]) {
  At at;
  for (Walk to = {0}; s->h > 0 && walk(p, &to, &at);) {
    const ZpMaxwellStep weights = weights_of(&at, s);
    ZpSectionForce adds = zp_maxwell_force(at.branch, (ZpBent){0, 0}, weights.half);
    adds = taken(&adds);
    zp_rod_point_soften(p, &at.point, &adds, s, D);
  }
}

double zp_rod_maxwell_along(const ZpRodParams *p, const ZpRodStep *s, size_t number, const double *x, const double *y) {
  double sum = 0;
  At at;
  for (Walk to = {0}; walk(p, &to, &at);)
    if (at.number == number)
      sum += 2 * at.point.length * zp_maxwell_energy(at.branch, zp_rod_point_change(p, &at.point, s, x, y));
  return sum;
}

double zp_rod_maxwell_error(const ZpRodParams *p, const ZpRodStep *s, double length) {
  double most = 0;
  At at;
  for (Walk to = {0}; walk(p, &to, &at);) {
    const size_t j = at.point.joint[0], edge = at.point.edge[0];
    const ZpBent error = zp_maxwell_error(at.branch, p->B[j] * p->cell, p->S[edge] * p->cell, s->h,
                                          spring_at(s->spring_start, &at), spring_at(s->spring_end, &at));
    most = fmax(most, 0.25 * length * length * error.curvature + length * error.strain);
  }
  return most;
}

double zp_rod_maxwell_heat(const ZpRodParams *p, const ZpRodEval *e0, const ZpRodEval *e1, ZpRodStep *s) {
  double sum = 0;
  At at;
  for (Walk to = {0}; walk(p, &to, &at);) {
    const ZpMaxwellStep weights = weights_of(&at, s);
    const ZpBent start = spring_at(s->spring_start, &at), change = change_at(p, &at.point, e0, e1);
    const ZpSectionForce mean = zp_maxwell_force(at.branch, zp_maxwell_mean(&weights, start, change), 0);
    const double work = mean.M * change.curvature + mean.N * change.strain;
    const ZpBent end = put_end(&at, &weights, change, s);
    sum += at.point.length * (work - zp_maxwell_energy(at.branch, end) + zp_maxwell_energy(at.branch, start));
  }
  return sum;
}
