#include "ribbon/rod_curl.h"

#include <stdbool.h>

#include "ribbon/rod_point.h"

static bool curls(const ZpRodParams *p) {
  return p->curl[0].EI > 0 || p->curl[1].EI > 0;
}

static const ZpCurl *curl_of(const ZpRodParams *p, const ZpRodPoint *point) {
  return &p->curl[zp_rod_point_ribbon(p, point)];
}

double zp_rod_curl_energy(const ZpRodParams *p, const ZpRodEval *e) {
  double sum = 0;
  if (!curls(p)) return 0;
  for (size_t i = 0; i < zp_rod_point_count(p); i++) {
    ZpRodPoint point = zp_rod_point(p, i);
    if (point.length > 0) sum += point.length * zp_curl_law(curl_of(p, &point), zp_rod_point_curvature(p, &point, e)).W;
  }
  return sum;
}

void zp_rod_curl_step(const ZpRodParams *p, const ZpRodEval *e0, const ZpRodEval *e1, ZpRodStep *s) {
  if (!curls(p)) return;
  for (size_t i = 0; i < zp_rod_point_count(p); i++) {
    ZpRodPoint point = zp_rod_point(p, i);
    if (!(point.length > 0)) continue;
    ZpCurlMean mean =
        zp_curl_mean(curl_of(p, &point), zp_rod_point_curvature(p, &point, e0), zp_rod_point_curvature(p, &point, e1));
    zp_rod_point_take(p, &point, &(ZpSectionForce){.M = mean.M, .K = mean.K}, e1, s);
  }
}
