/* The area error of the paper. */
#include <math.h>
#include <stdlib.h>

#include "def/def.h"
#include "fit/reference.h"
#include "reproduce/parts.h"
#include "study/result.h"

/* Hanging equilibrium of `elements` in gravity `g`, m/s2. => stroke, m, NAN if there is none; the caller frees *result.
 */
static double hang(ZpActuatorDef elements, double g, ZpResult **result) {
  elements.gravity = g;
  zp_result_destroy(*result);
  *result = NULL;
  if (zp_study_run(ZP_STUDY_STATIONARY, &elements, NULL, NULL, result, NULL) != ZP_OK) return NAN;
  return zp_result_get(*result, "stroke_m");
}

/* Find the gravity at which `elements` hang at `stroke`, by secants from their own gravity. => the result there, or
 * NULL. */
static ZpResult *hang_at(const ZpActuatorDef *elements, double stroke) {
  enum { MOST = 20 };
  static const double accuracy = 1e-8; /* relative */
  ZpResult *result = NULL;
  double g0 = 0, s0 = 0, g = elements->gravity;
  for (int i = 0; i < MOST && g > 0; i++) {
    double s = hang(*elements, g, &result);
    if (fabs(s / stroke - 1) < accuracy) return result;
    double next = g + (stroke - s) * (g - g0) / (s - s0);
    g0 = g;
    s0 = s;
    g = next;
  }
  zp_result_destroy(result);
  return NULL;
}

/* The shape `from`, moved to the start of `to`: the clip is free in one model and held in the other. */
static bool move_to_clip(const ZpTable *from, const ZpTable *to, ZpReference *curve) {
  *curve = (ZpReference){from->rows, calloc(from->rows, sizeof(double)), calloc(from->rows, sizeof(double))};
  if (!curve->x || !curve->y) return false;
  for (size_t i = 0; i < from->rows; i++) {
    curve->x[i] = zp_table_get(from, i, "x_m") - zp_table_get(from, 0, "x_m") + zp_table_get(to, 0, "x_m");
    curve->y[i] = zp_table_get(from, i, "y_m") - zp_table_get(from, 0, "y_m") + zp_table_get(to, 0, "y_m");
  }
  return true;
}

double zp_area_error(const ZpResult *chain, ZpActuatorDef elements, double stroke) {
  ZpResult *hung = hang_at(&elements, stroke);
  ZpReference reference = {0};
  double area = NAN;
  if (hung && hung->series && chain->series && move_to_clip(hung->series, chain->series, &reference))
    area = zp_reference_area(&reference, chain->series);
  zp_reference_free(&reference);
  zp_result_destroy(hung);
  return area;
}
