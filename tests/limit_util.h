/* The first limit point of a branch, from points along it: independent of how limits are found. */
#ifndef ZP_TESTS_LIMIT_UTIL_H
#define ZP_TESTS_LIMIT_UTIL_H

#include "check_util.h"

#include "rest/rest.h"

/* A point of the branch. */
typedef struct Point {
  double stroke, voltage;
} Point;

/* The top of the parabola through three points of voltage over stroke. */
static inline Point top_of(const Point *p) {
  double d01 = (p[1].voltage - p[0].voltage) / (p[1].stroke - p[0].stroke);
  double d12 = (p[2].voltage - p[1].voltage) / (p[2].stroke - p[1].stroke);
  double half = (d12 - d01) / (p[2].stroke - p[0].stroke); /* of the second derivative */
  double stroke = 0.5 * (p[0].stroke + p[1].stroke) - 0.5 * d01 / half;
  double from = stroke - p[0].stroke;
  return (Point){stroke, p[0].voltage + from * (d01 + half * (stroke - p[1].stroke))};
}

/* At rest without voltage, ready to be followed towards a higher one. */
static inline void start_at_rest(ZpRest *rest, const ZpActuatorDef *def, double longest) {
  ck_assert(zp_rest_open(rest, model_of(def), NULL, NULL));
  ck_assert(zp_newton_good(zp_statics_find_rest(&rest->statics).end));
  ck_assert(zp_rest_follow_by(rest, true, longest, longest));
}

/* The first limit point, in steps short enough for a parabola. */
static inline Point limit_of(const ZpActuatorDef *def) {
  ZpRest rest;
  start_at_rest(&rest, def, 0.01);
  Point point[3] = {{0, 0}, {0, 0}, {0, 0}};
  while (point[2].voltage >= point[1].voltage) {
    ck_assert(zp_branch_advance(&rest.branch));
    memmove(point, point + 1, 2 * sizeof *point);
    point[2] = (Point){zp_statics_stroke(&rest.statics), rest.statics.U};
  }
  zp_rest_close(&rest);
  return top_of(point);
}

#endif
