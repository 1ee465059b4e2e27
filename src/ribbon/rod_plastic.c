#include "ribbon/rod_plastic.h"

#include <math.h>

#include "ribbon/plastic.h"
#include "ribbon/rod_point.h"

size_t zp_rod_plastic_count(const ZpRodParams *p) {
  return p->plastic ? ZP_FIBRES * zp_rod_point_count(p) : 0;
}

static const ZpPlastic *plastic_of(const ZpRodParams *p, const ZpRodPoint *point) {
  return &p->plastic[zp_rod_point_ribbon(p, point)];
}

/* Strains at point i; NULL: none. */
static const double *strain_at(const double *strain, size_t i) {
  return strain ? strain + ZP_FIBRES * i : NULL;
}

static ZpBent bent_at(const ZpRodParams *p, const ZpRodPoint *point, const ZpRodEval *e) {
  return (ZpBent){zp_rod_point_curvature(p, point, e), zp_rod_point_strain(p, point, e)};
}

double zp_rod_plastic_relief(const ZpRodParams *p, const ZpRodEval *e, const double *strain) {
  double sum = 0;
  if (!p->plastic || !strain) return 0;
  for (size_t i = 0; i < zp_rod_point_count(p); i++) {
    ZpRodPoint point = zp_rod_point(p, i);
    if (!(point.length > 0)) continue;
    ZpBent bent = bent_at(p, &point, e);
    sum += point.length * zp_plastic_relief(plastic_of(p, &point), strain_at(strain, i), bent.curvature, bent.strain);
  }
  return sum;
}

/* The mean of what acts at both ends, of which the start does not depend on the end. */
static ZpSectionForce mean_of(ZpSectionForce start, ZpSectionForce end) {
  return (ZpSectionForce){0.5 * (start.M + end.M), 0.5 * (start.N + end.N), 0.5 * end.K, 0.5 * end.both,
                          0.5 * end.axial};
}

/* At rest both ends of the span are the end; over a step the mean acts. */
void zp_rod_plastic_step(const ZpRodParams *p, const ZpRodEval *e1, bool still, ZpRodStep *s) {
  if (!p->plastic) return;
  for (size_t i = 0; i < zp_rod_point_count(p); i++) {
    ZpRodPoint point = zp_rod_point(p, i);
    if (!(point.length > 0)) continue;
    const ZpPlastic *plastic = plastic_of(p, &point);
    const double *before = strain_at(s->strain_start, i);
    ZpBent bent = bent_at(p, &point, e1);
    ZpSectionForce none = {0},
                   end = zp_plastic_bend(plastic, before, bent.curvature, bent.strain, s->strain_end + ZP_FIBRES * i);
    ZpSectionForce mean = mean_of(still ? end : before ? zp_plastic_force(plastic, before) : none, end);
    zp_rod_point_take(p, &point, &mean, e1, s);
  }
}

void zp_rod_plastic_stiffness(const ZpRodParams *p, const ZpRodStep *s, double (*D)[4]) {
  for (size_t i = 0; p->plastic && i < zp_rod_point_count(p); i++) {
    ZpRodPoint point = zp_rod_point(p, i);
    if (!(point.length > 0)) continue;
    ZpSectionForce end =
        zp_plastic_again(plastic_of(p, &point), strain_at(s->strain_start, i), s->strain_end + ZP_FIBRES * i);
    ZpSectionForce mean = mean_of(end, end);
    if (end.axial != 0) zp_rod_point_soften(p, &point, &mean, s, D);
  }
}

double zp_rod_plastic_heat(const ZpRodParams *p, const ZpRodEval *e0, const ZpRodEval *e1, ZpRodStep *s) {
  double sum = 0;
  for (size_t i = 0; p->plastic && i < zp_rod_point_count(p); i++) {
    ZpRodPoint point = zp_rod_point(p, i);
    if (!(point.length > 0)) continue;
    const ZpPlastic *plastic = plastic_of(p, &point);
    const double *before = s->strain_start + ZP_FIBRES * i;
    double *after = s->strain_end + ZP_FIBRES * i;
    ZpBent from = bent_at(p, &point, e0), to = bent_at(p, &point, e1);
    zp_plastic_bend(plastic, before, to.curvature, to.strain, after);
    sum += point.length * zp_plastic_heat(plastic, before, from, after, to);
  }
  return sum;
}

double zp_rod_plastic_set(const ZpRodParams *p, const double *strain) {
  double most = 0;
  for (size_t i = 0; p->plastic && i < zp_rod_point_count(p); i++) {
    ZpRodPoint point = zp_rod_point(p, i);
    const ZpPlastic *plastic = plastic_of(p, &point);
    most = fmax(most, fabs(zp_plastic_force(plastic, strain_at(strain, i)).M) / plastic->EI);
  }
  return most;
}

double zp_rod_plastic_elongation(const ZpRodParams *p, const double *strain) {
  double most = 0;
  for (size_t i = 0; p->plastic && i < zp_rod_point_count(p); i++) {
    ZpRodPoint point = zp_rod_point(p, i);
    double left = zp_plastic_elongation(plastic_of(p, &point), strain_at(strain, i));
    if (fabs(left) > fabs(most)) most = left;
  }
  return most;
}
