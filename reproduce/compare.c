/* Published numbers beside ours: how each quantity is computed, and when two numbers agree.
 *
 * Letters: K_S shear coefficient (N/m), EI bending stiffness (N m2), l element length (m), L flexible length (m), q
 * weight per length (N/m), M mass of the load (kg), g gravity (m/s2): theory, section 3.3. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "actuator/model.h"
#include "base/fail.h"
#include "def/def.h"
#include "reproduce/parts.h"

#define ZP_VERDICT(id, word, judged, title) {word, judged, title},
const ZpVerdictInfo zp_verdicts[ZP_VERDICT_COUNT] = {
#include "reproduce/verdicts.def"
};

#define ZP_REASON(id, verdict, title, section, sentence) {verdict, title, section, sentence},
const ZpReason zp_reasons[ZP_REASON_COUNT] = {
#include "reproduce/reasons.def"
};

#define ZP_SUBJECT(id, quantity, place, title, unit, source, reason, once)                                             \
  {quantity, place, title, unit, source, reason, once},
const ZpSubject zp_subjects[ZP_SUBJECT_COUNT] = {
#include "reproduce/subjects.def"
};

/* One unit of the last digit printed: 0.01 of "12.20", 1e3 of "2.4e4". */
static double last_digit(const char *text) {
  const char *point = strchr(text, '.'), *exponent = strchr(text, 'e');
  size_t decimals = point ? strspn(point + 1, "0123456789") : 0;
  return pow(10, (exponent ? atof(exponent + 1) : 0) - (double)decimals);
}

/* -- ours ------------------------------------------------------------------------------------------ */

/* The run of Table I with its load, and that of Table II with its N. */
static ZpRunId table_1(const ZpPublished *p) {
  return p->load == 0 ? ZP_RUN_TABLE_1_0_G : p->load == 8 ? ZP_RUN_TABLE_1_8_G : ZP_RUN_TABLE_1_61_G;
}

static ZpRunId table_2(const ZpPublished *p) {
  return p->nodes == 21 ? ZP_RUN_TABLE_2_21 : p->nodes == 61 ? ZP_RUN_TABLE_2_61 : ZP_RUN_TABLE_2_130;
}

/* A scalar of the case with this N, or with this N and load. */
static double of_nodes(const ZpRuns *runs, ZpRunId id, const ZpPublished *p, const char *scalar) {
  return zp_runs_get(runs, id, (ZpWhich){.nodes = p->nodes, .load = NAN}, scalar);
}

static ZpWhich row_of(const ZpPublished *p) {
  return (ZpWhich){.nodes = p->nodes, .load = p->load};
}

/* A constant of a run's model with this N; NAN if it was not run. */
static double constant_of(const ZpRuns *runs, ZpRunId id, int nodes, const char *name) {
  ZpModel *model;
  if (runs->run[id].batch.done == 0) return NAN;
  ZpActuatorDef def = zp_runs_def(runs, id, 0);
  def.mesh.nodes = nodes;
  if (zp_model_create(&def, &model, NULL) != ZP_OK) return NAN;
  double value = zp_model_get(model, name);
  zp_model_destroy(model);
  return value;
}

/* (3.6) with the loads of the two models: a quarter on the chain, all of it on the finite elements. */
static double shear_from_theory(const ZpRuns *runs, const ZpPublished *p) {
  const ZpRunId id = ZP_RUN_FINITE_ELEMENTS;
  const double EI = constant_of(runs, id, p->nodes, "bending_stiffness"),
               l = constant_of(runs, id, p->nodes, "element_length"),
               L = constant_of(runs, id, p->nodes, "flexible_length"),
               mu = constant_of(runs, id, p->nodes, "line_mass");
  if (isnan(l)) return NAN;
  const double g = zp_runs_def(runs, id, 0).gravity;
  const double N = p->nodes, Mg = 1e-3 * p->load * g;
  const double half_weight = mu * g * L / 2;
  return EI / (l * l * l) * N * (N + 1) / ((N - 1) * (N - 1)) * (Mg / 4 + half_weight) / (Mg + half_weight);
}

/* mm2 between the chain and the finite elements hung at their stroke in the table. */
static double area_error(const ZpRuns *runs, const ZpPublished *p, const ZpResult *chain, ZpQuantity reference) {
  if (!chain || runs->run[ZP_RUN_FINITE_ELEMENTS].batch.done == 0) return NAN;
  ZpActuatorDef def = zp_runs_def(runs, ZP_RUN_FINITE_ELEMENTS, 0);
  def.load.mass = 1e-3 * p->load;
  return 1e6 * zp_area_error(chain, def, 1e-3 * zp_published(reference, p->nodes, p->load));
}

/* The chain at rest with the fitted K_S. */
static double fitted_area(const ZpRuns *runs, const ZpPublished *p, double K_S) {
  if (isnan(K_S)) return NAN;
  ZpActuatorDef def = zp_runs_def(runs, table_1(p), 0);
  def.mesh.nodes = p->nodes;
  def.load.mass = 1e-3 * p->load;
  def.mass_spring.shear_coefficient = K_S;
  ZpResult *result;
  if (zp_study_run(ZP_STUDY_STATIONARY, &def, NULL, NULL, &result, NULL) != ZP_OK) return NAN;
  double area = area_error(runs, p, result, ZP_TABLE_1_STROKE);
  zp_result_destroy(result);
  return area;
}

/* Mean over the cases of the factor, and standard deviation; NAN if some were not run. */
static double mean_of_cases(const ZpRuns *runs, const char *scalar, double *deviation) {
  const ZpBatch *batch = &runs->run[ZP_RUN_FACTOR].batch;
  double sum = 0, squares = 0, n = (double)batch->done;
  *deviation = NAN;
  if (batch->done == 0 || batch->done < batch->count) return NAN;
  for (size_t i = 0; i < batch->done; i++)
    sum += zp_result_get(batch->result[i], scalar);
  for (size_t i = 0; i < batch->done; i++)
    squares += pow(zp_result_get(batch->result[i], scalar) - sum / n, 2);
  *deviation = sqrt(squares / n);
  return sum / n;
}

/* Our number, in the unit of the published one; NAN: not run. Errors of the paper's Table II are relative to the stroke
 * of the chain, not to that of the reference. Its cost is that of as many steps as the paper's. */
static double ours(ZpSubjectId id, const ZpRuns *runs, const ZpPublished *p) {
  const double chain = 1e3 * zp_runs_get(runs, table_2(p), row_of(p), "stroke_m");
  const double chain_error = fabs(chain - zp_published(ZP_TABLE_2_REFERENCE, p->nodes, p->load));
  const double fitted_shear = of_nodes(runs, table_1(p), p, "mass_spring.shear_coefficient");
  const double fitted_error = 1e3 * of_nodes(runs, table_1(p), p, "residual_rms_m");
  const double mean_step = 1e6 * of_nodes(runs, ZP_RUN_COST, p, "mean_time_step_s");
  const ZpWhich zips = {.load = p->load, .voltage = id == ZP_ZIP_TIME_6_KV ? 6e3 : 10e3};
  double deviation;
  switch (id) {
  case ZP_FITTED_SHEAR:
    return fitted_shear;
  case ZP_THEORY_SHEAR:
    return shear_from_theory(runs, p);
  case ZP_ELEMENTS_1:
  case ZP_ELEMENTS_2:
    return 1e3 * zp_runs_get(runs, ZP_RUN_FINITE_ELEMENTS, (ZpWhich){.load = p->load}, "stroke_m");
  case ZP_FITTED_ERROR:
    return fitted_error;
  case ZP_FITTED_RELATIVE:
    return 100 * fitted_error / zp_published(ZP_TABLE_1_STROKE, p->nodes, p->load);
  case ZP_FITTED_AREA:
    return fitted_area(runs, p, fitted_shear);
  case ZP_CHAIN_STROKE:
    return chain;
  case ZP_CHAIN_ERROR:
    return chain_error;
  case ZP_CHAIN_RELATIVE:
    return 100 * chain_error / chain;
  case ZP_CHAIN_AREA:
    return area_error(runs, p, zp_runs_find(runs, table_2(p), row_of(p)), ZP_TABLE_2_REFERENCE);
  case ZP_FACTOR_BY_PAPER:
    return mean_of_cases(runs, "paper_factor", &deviation);
  case ZP_DEVIATION_BY_PAPER:
    mean_of_cases(runs, "paper_factor", &deviation);
    return deviation;
  case ZP_FACTOR_BY_FIELD:
    return mean_of_cases(runs, "scale_factor", &deviation);
  case ZP_OUR_AXIAL_SPRING:
    return 1e-6 * constant_of(runs, ZP_RUN_TABLE_2_TEXT, p->nodes, "axial_spring");
  case ZP_OUR_COST:
    return mean_step / zp_published(ZP_MEAN_STEP, p->nodes, 0) / of_nodes(runs, ZP_RUN_COST, p, "real_time_factor") /
           60;
  case ZP_OUR_MEAN_STEP:
    return mean_step;
  case ZP_ZIP_TIME_6_KV:
  case ZP_ZIP_TIME_10_KV:
    return 1e3 * zp_runs_get(runs, ZP_RUN_FIG_9_CODE_21, zips, "zip_time_s");
  case ZP_SUBJECT_COUNT:
    break;
  }
  return NAN;
}

/* -- comparing ------------------------------------------------------------------------------------- */

/* Uncertainty by the printed digits. K_S is printed without rounding its last digit, and is inversely proportional to
 * the stroke to which it is fitted, which is rounded to 0.01 mm. An error is the difference of two strokes, each
 * printed to 0.01 mm. */
static double slack_of(ZpSubjectId id, const ZpPublished *p) {
  if (id == ZP_FITTED_SHEAR)
    return fmax(last_digit(p->text), 0.005 / zp_published(ZP_TABLE_1_STROKE, p->nodes, p->load) * p->value);
  if (id == ZP_CHAIN_ERROR) return 0.02;
  if (id == ZP_CHAIN_RELATIVE) return 100 * 0.02 / zp_published(ZP_TABLE_2_STROKE, p->nodes, p->load);
  return last_digit(p->text);
}

/* No difference is within a tolerance of NAN: then, or if the difference is larger, the reason determines the verdict.
 */
static ZpComparison compare(ZpSubjectId id, const ZpPublished *published, const ZpRuns *runs) {
  const ZpSubject *subject = &zp_subjects[id];
  const ZpReason *reason = &zp_reasons[subject->reason];
  ZpComparison c = {.subject = subject,
                    .published = published,
                    .nodes = subject->once ? 0 : published->nodes,
                    .ours = ours(id, runs, published),
                    .tolerance = NAN};
  c.difference = c.ours / published->value - 1;
  if (zp_verdicts[reason->verdict].judged) c.tolerance = fmax(ZP_AGREEMENT * published->value, slack_of(id, published));
  const bool agrees = fabs(c.ours - published->value) <= c.tolerance;
  c.verdict = isnan(c.ours) ? ZP_VERDICT_NOT_RUN : agrees ? ZP_VERDICT_AGREES : reason->verdict;
  c.reason = isnan(c.ours) || agrees ? NULL : reason;
  return c;
}

ZpStatus zp_compare(const ZpRuns *runs, ZpComparisons *comparisons, ZpError *err) {
  size_t count;
  const ZpPublished *published = zp_published_list(&count);
  *comparisons = (ZpComparisons){.item = calloc(ZP_SUBJECT_COUNT * count, sizeof(ZpComparison))};
  if (!comparisons->item) return zp_fail_memory(err);
  for (int id = 0; id < ZP_SUBJECT_COUNT; id++)
    for (size_t i = 0; i < count; i++) {
      const ZpSubject *subject = &zp_subjects[id];
      if (published[i].quantity != subject->quantity || (subject->once && published[i].nodes != 21)) continue;
      const ZpComparison c = compare((ZpSubjectId)id, &published[i], runs);
      comparisons->item[comparisons->count++] = c;
      comparisons->of[c.verdict]++;
    }
  return ZP_OK;
}
