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

double zp_rod_plastic_relief(const ZpRodParams *p, const ZpRodEval *e, const double *strain) {
  double sum = 0;
  if (!p->plastic || !strain) return 0;
  for (size_t i = 0; i < zp_rod_point_count(p); i++) {
    ZpRodPoint point = zp_rod_point(p, i);
    sum += point.length *
           zp_plastic_relief(plastic_of(p, &point), strain_at(strain, i), zp_rod_point_curvature(p, &point, e));
  }
  return sum;
}

/* At rest both ends of the span are the end; over a step the mean moment acts. */
void zp_rod_plastic_step(const ZpRodParams *p, const ZpRodEval *e1, bool still, ZpRodStep *s) {
  if (!p->plastic) return;
  for (size_t i = 0; i < zp_rod_point_count(p); i++) {
    ZpRodPoint point = zp_rod_point(p, i);
    if (!(point.length > 0)) continue;
    const ZpPlastic *plastic = plastic_of(p, &point);
    const double *before = strain_at(s->strain_start, i);
    ZpPlasticMoment end =
        zp_plastic_bend(plastic, before, zp_rod_point_curvature(p, &point, e1), s->strain_end + ZP_FIBRES * i);
    double start = still ? end.M : before ? zp_plastic_moment(plastic, before) : 0;
    zp_rod_point_take(p, &point, 0.5 * (start + end.M), 0.5 * end.K, e1, s);
  }
}

double zp_rod_plastic_heat(const ZpRodParams *p, const ZpRodEval *e0, const ZpRodEval *e1, ZpRodStep *s) {
  double sum = 0;
  for (size_t i = 0; p->plastic && i < zp_rod_point_count(p); i++) {
    ZpRodPoint point = zp_rod_point(p, i);
    if (!(point.length > 0)) continue;
    const ZpPlastic *plastic = plastic_of(p, &point);
    const double *before = s->strain_start + ZP_FIBRES * i;
    double *after = s->strain_end + ZP_FIBRES * i, from = zp_rod_point_curvature(p, &point, e0),
           to = zp_rod_point_curvature(p, &point, e1);
    zp_plastic_bend(plastic, before, to, after);
    sum += point.length * zp_plastic_heat(plastic, before, from, after, to);
  }
  return sum;
}

double zp_rod_plastic_set(const ZpRodParams *p, const double *strain) {
  double most = 0;
  for (size_t i = 0; p->plastic && i < zp_rod_point_count(p); i++) {
    ZpRodPoint point = zp_rod_point(p, i);
    const ZpPlastic *plastic = plastic_of(p, &point);
    most = fmax(most, fabs(zp_plastic_moment(plastic, strain_at(strain, i))) / plastic->EI);
  }
  return most;
}
