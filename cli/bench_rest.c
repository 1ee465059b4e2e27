/* Cost of an equilibrium, and of the field around it. */
#include <math.h>

#include "bench.h"
#include "motion.h"
#include "reproduce/reproduce.h"

void bench_set(ZpAssignment *list, size_t *count, const char *key, double value) {
  list[(*count)++] = (ZpAssignment){zp_key_find(key), value};
}

static Row row_of(const char *name, int nodes, double cpu, double error) {
  return (Row){name, nodes, NAN, NAN, NAN, cpu, NAN, error};
}

/* CPU time of one study of an equilibrium, the best of many, and its stroke. */
static ZpStatus time_rest(const ZpAssignment *list, size_t count, double *best, double *stroke, ZpError *err) {
  enum { TRIES = 50 };
  ZpActuatorDef def;
  ZpStatus status = zp_def_resolve(&def, list, count, err);
  *best = INFINITY;
  for (int k = 0; k < TRIES && status == ZP_OK; k++) {
    ZpResult *result;
    double start = motion_clock();
    status = zp_study_run(ZP_STUDY_STATIONARY, &def, NULL, NULL, &result, err);
    if (status != ZP_OK) break;
    *best = fmin(*best, motion_clock() - start);
    *stroke = zp_result_get(result, "stroke_m");
    zp_result_destroy(result);
  }
  return status;
}

/* A steel strip of 45 x 12.7 mm x 100 um, guided, with 61 g at its end, from straight: 17.942 mm. */
ZpStatus bench_strip(int nodes, Row *row, ZpError *err) {
  static const double converged = 17.942e-3; /* m, exact elastica */
  ZpAssignment list[12];
  size_t count = 0;
  bench_set(list, &count, "actuator.kind", ZP_KIND_RIBBON);
  bench_set(list, &count, "ribbon.length", 45e-3);
  bench_set(list, &count, "ribbon.thickness", 100e-6);
  bench_set(list, &count, "ribbon.plane", ZP_PLANE_STRESS);
  bench_set(list, &count, "load.mass", 61e-3);
  bench_set(list, &count, "mesh.nodes", nodes);
  bench_set(list, &count, "output.errors", 0);
  double best = NAN, stroke = NAN;
  ZpStatus status = time_rest(list, count, &best, &stroke, err);
  *row = row_of("rest of a guided strip", nodes, best, fabs(stroke / converged - 1));
  return status;
}

/* All 18 rows of Table II, preset paper-code with the K_S of its authors; the error is the difference from their
 * strokes. */
ZpStatus bench_table2(int nodes, Row *row, ZpError *err) {
  static const int sizes[3] = {21, 61, 130};
  static const double load[] = {40, 60, 80, 100, 150, 200}; /* g */
  double sum = 0, worst = 0;
  ZpStatus status = ZP_OK;
  for (int n = 0; n < 3 && status == ZP_OK; n++)
    for (int m = 0; m < 6 && status == ZP_OK; m++) {
      ZpAssignment list[5];
      size_t count = 0;
      bench_set(list, &count, "preset", ZP_PRESET_PAPER_CODE);
      bench_set(list, &count, "mesh.nodes", sizes[n]);
      bench_set(list, &count, "mass_spring.shear_coefficient", zp_published(ZP_SAVED_SHEAR, sizes[n], 61));
      bench_set(list, &count, "load.mass", 1e-3 * load[m]);
      double best = NAN, stroke = NAN;
      status = time_rest(list, count, &best, &stroke, err);
      sum += best;
      bool misprint = n == 0 && (m == 1 || m == 2); /* N = 21 at 60 and 80 g: differs from their program */
      if (!misprint) worst = fmax(worst, fabs(stroke * 1e3 / zp_published(ZP_TABLE_2_STROKE, sizes[n], load[m]) - 1));
    }
  *row = row_of("rest, Table II, 18 rows", nodes, sum, worst);
  return status;
}

/* Study profile on the wedge with an opening of 2 mm: one solution of the field with all its results; the error is the
 * difference between traction and virtual work. */
ZpStatus bench_field(int nodes, Row *row, ZpError *err) {
  enum { TRIES = 10 };
  ZpActuatorDef def = zp_actuator_def_default();
  def.liquid.model = ZP_LIQUID_NONE;
  def.profile.shape = ZP_PROFILE_CUBIC;
  def.mesh.nodes = nodes;
  double best = INFINITY, off = NAN, equations = NAN;
  ZpStatus status = ZP_OK;
  for (int k = 0; k < TRIES && status == ZP_OK; k++) {
    ZpResult *result;
    double start = motion_clock();
    status = zp_study_run(ZP_STUDY_PROFILE, &def, NULL, NULL, &result, err);
    if (status != ZP_OK) break;
    best = fmin(best, motion_clock() - start);
    off = fabs(zp_result_get(result, "virtual_work_difference"));
    equations = zp_result_get(result, "equations");
    zp_result_destroy(result);
  }
  *row = row_of("field, unknowns as nodes", (int)equations, best, off);
  return status;
}
