/* Published numbers beside ours: how each quantity is computed, and when two numbers agree.
 *
 * Letters: K_S shear coefficient (N/m), EI bending stiffness (N m2), l element length (m), L flexible length (m), q
 * weight per length (N/m), M mass of the load (kg), g gravity (m/s2): theory, section 3.3. */
#include "reproduce/compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "reproduce/area.h"

#define ZP_VERDICT(id, word, judged, title) {word, judged, title},
static const ZpVerdictInfo verdict_info[ZP_VERDICT_COUNT] = {
#include "reproduce/verdicts.def"
};
#undef ZP_VERDICT

const ZpVerdictInfo *zp_verdict_info(ZpVerdict verdict) {
  return &verdict_info[verdict];
}

#define ZP_REASON(id, verdict, title, section, sentence) {verdict, title, section, sentence},
static const ZpReason reason[ZP_REASON_COUNT] = {
#include "reproduce/reasons.def"
};
#undef ZP_REASON

const ZpReason *zp_reason(ZpReasonId id) {
  return &reason[id];
}

/* One unit of the last digit printed: 0.01 of "12.20", 1e3 of "2.4e4". */
static double last_digit(const char *text) {
  const char *point = strchr(text, '.'), *exponent = strchr(text, 'e');
  size_t decimals = point ? strspn(point + 1, "0123456789") : 0;
  return pow(10, (exponent ? atof(exponent + 1) : 0) - (double)decimals);
}

/* -- ours ------------------------------------------------------------------------------------------ */

static ZpWhich row_of(const ZpPublished *p) {
  return (ZpWhich){.nodes = p->nodes, .load = p->load};
}

static double finite_elements(const ZpRuns *runs, const ZpPublished *p) {
  return 1e3 * zp_runs_get(runs, ZP_RUN_FINITE_ELEMENTS, (ZpWhich){.load = p->load}, "stroke_m");
}

/* -- Table I */

static ZpRunId table_1(const ZpPublished *p) {
  return p->load == 0 ? ZP_RUN_TABLE_1_0_G : p->load == 8 ? ZP_RUN_TABLE_1_8_G : ZP_RUN_TABLE_1_61_G;
}

static double fitted(const ZpRuns *runs, const ZpPublished *p, const char *scalar) {
  return zp_runs_get(runs, table_1(p), (ZpWhich){.nodes = p->nodes, .load = NAN}, scalar);
}

static double fitted_shear(const ZpRuns *runs, const ZpPublished *p) {
  return fitted(runs, p, "mass_spring.shear_coefficient");
}

/* K_S is printed without rounding its last digit, and is inversely proportional to the stroke to which it is fitted,
 * which is rounded to 0.01 mm. */
static double fitted_shear_slack(const ZpPublished *p) {
  double rounded = 0.005 / zp_published(ZP_TABLE_1_STROKE, p->nodes, p->load);
  return fmax(last_digit(p->text), rounded * p->value);
}

/* (3.6) with the loads of the two models: a quarter on the chain, all of it on the finite elements. */
static double shear_from_theory(const ZpRuns *runs, const ZpPublished *p) {
  if (runs->run[ZP_RUN_FINITE_ELEMENTS].batch.done == 0) return NAN;
  ZpActuatorDef def = zp_runs_def(runs, ZP_RUN_FINITE_ELEMENTS, 0);
  def.mesh.nodes = p->nodes;
  ZpModel *model;
  if (zp_model_create(&def, &model, NULL) != ZP_OK) return NAN;
  ZpModelInfo info = zp_model_info(model);
  zp_model_destroy(model);
  const double N = p->nodes, l = info.element_length, Mg = 1e-3 * p->load * def.gravity;
  const double half_weight = info.line_mass * def.gravity * info.flexible_length / 2;
  return info.bending_stiffness / (l * l * l) * N * (N + 1) / ((N - 1) * (N - 1)) * (Mg / 4 + half_weight) /
         (Mg + half_weight);
}

static double fitted_error(const ZpRuns *runs, const ZpPublished *p) {
  return 1e3 * fitted(runs, p, "residual_rms_m");
}

static double fitted_relative(const ZpRuns *runs, const ZpPublished *p) {
  return 100 * fitted_error(runs, p) / zp_published(ZP_TABLE_1_STROKE, p->nodes, p->load);
}

/* mm2 between the chain and the finite elements hung at their stroke in the table. */
static double area_error(const ZpRuns *runs, const ZpPublished *p, const ZpResult *chain, ZpQuantity reference) {
  const ZpBatch *elements = &runs->run[ZP_RUN_FINITE_ELEMENTS].batch;
  if (!chain || elements->done == 0) return NAN;
  ZpActuatorDef def = zp_runs_def(runs, ZP_RUN_FINITE_ELEMENTS, 0);
  def.load.mass = 1e-3 * p->load;
  return 1e6 * zp_area_error(chain, def, 1e-3 * zp_published(reference, p->nodes, p->load));
}

/* The chain at rest with the fitted K_S. */
static double fitted_area(const ZpRuns *runs, const ZpPublished *p) {
  double K_S = fitted_shear(runs, p);
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

/* -- Table II */

static ZpRunId table_2(const ZpPublished *p) {
  return p->nodes == 21 ? ZP_RUN_TABLE_2_21 : p->nodes == 61 ? ZP_RUN_TABLE_2_61 : ZP_RUN_TABLE_2_130;
}

static double chain_stroke(const ZpRuns *runs, const ZpPublished *p) {
  return 1e3 * zp_runs_get(runs, table_2(p), row_of(p), "stroke_m");
}

static double published_reference(const ZpPublished *p) {
  return zp_published(ZP_TABLE_2_REFERENCE, p->nodes, p->load);
}

static double error_to_published(const ZpRuns *runs, const ZpPublished *p) {
  return fabs(chain_stroke(runs, p) - published_reference(p));
}

/* The errors of the paper are relative to the stroke of the chain, not to that of the reference. */
static double relative_to_published(const ZpRuns *runs, const ZpPublished *p) {
  return 100 * error_to_published(runs, p) / chain_stroke(runs, p);
}

static double chain_area(const ZpRuns *runs, const ZpPublished *p) {
  return area_error(runs, p, zp_runs_find(runs, table_2(p), row_of(p)), ZP_TABLE_2_REFERENCE);
}

/* An error is the difference of two strokes, each printed to 0.01 mm. */
static double error_slack(const ZpPublished *p) {
  (void)p;
  return 0.02;
}

static double relative_slack(const ZpPublished *p) {
  return 100 * error_slack(p) / zp_published(ZP_TABLE_2_STROKE, p->nodes, p->load);
}

/* -- section III */

static double axial_spring(const ZpRuns *runs, const ZpPublished *p) {
  if (runs->run[ZP_RUN_TABLE_2_TEXT].batch.done == 0) return NAN;
  ZpActuatorDef def = zp_runs_def(runs, ZP_RUN_TABLE_2_TEXT, 0);
  def.mesh.nodes = p->nodes;
  ZpModel *model;
  if (zp_model_create(&def, &model, NULL) != ZP_OK) return NAN;
  double K_D = zp_model_info(model).axial_spring;
  zp_model_destroy(model);
  return 1e-6 * K_D;
}

static double cost_scalar(const ZpRuns *runs, const ZpPublished *p, const char *scalar) {
  return zp_runs_get(runs, ZP_RUN_COST, (ZpWhich){.nodes = p->nodes, .load = NAN}, scalar);
}

static double mean_step(const ZpRuns *runs, const ZpPublished *p) {
  return 1e6 * cost_scalar(runs, p, "mean_time_step_s");
}

/* Minutes per simulated second with the number of steps of the paper. */
static double cost(const ZpRuns *runs, const ZpPublished *p) {
  double steps = mean_step(runs, p) / zp_published(ZP_MEAN_STEP, p->nodes, 0);
  return steps / cost_scalar(runs, p, "real_time_factor") / 60;
}

/* -- the factor */

/* Mean over the cases, and standard deviation; NAN if some were not run. */
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

static double factor_by_their_books(const ZpRuns *runs, const ZpPublished *p) {
  double deviation;
  (void)p;
  return mean_of_cases(runs, "paper_factor", &deviation);
}

static double deviation_by_their_books(const ZpRuns *runs, const ZpPublished *p) {
  double deviation;
  (void)p;
  mean_of_cases(runs, "paper_factor", &deviation);
  return deviation;
}

static double factor_by_field(const ZpRuns *runs, const ZpPublished *p) {
  double deviation;
  (void)p;
  return mean_of_cases(runs, "scale_factor", &deviation);
}

/* -- fig. 9 */

static double zip_time(const ZpRuns *runs, const ZpPublished *p) {
  double voltage = p->quantity == ZP_RERUN_ZIP_6_KV ? 6e3 : 10e3;
  return 1e3 * zp_runs_get(runs, ZP_RUN_FIG_9_CODE_21, (ZpWhich){.load = p->load, .voltage = voltage}, "zip_time_s");
}

/* -- comparing ------------------------------------------------------------------------------------- */

const ZpSubject zp_subjects[] = {
    {ZP_TABLE_1_SHEAR, "Table I", "shear coefficient fitted to the stroke", "N/m", "paper", fitted_shear,
     ZP_REASON_UNKNOWN, fitted_shear_slack, false},
    {ZP_TABLE_1_SHEAR, "Table I", "shear coefficient from theory", "N/m", "paper", shear_from_theory, ZP_REASON_UNKNOWN,
     NULL, false},
    {ZP_TABLE_1_STROKE, "Table I", "stroke of the finite elements", "mm", "paper", finite_elements,
     ZP_REASON_CONVERGENCE, NULL, true},
    {ZP_TABLE_1_STROKE_ERROR, "Table I", "stroke error", "mm", "paper", fitted_error, ZP_REASON_TUNING, NULL, false},
    {ZP_TABLE_1_RELATIVE, "Table I", "relative error", "%", "paper", fitted_relative, ZP_REASON_TUNING, NULL, false},
    {ZP_TABLE_1_AREA, "Table I", "area error", "mm²", "paper", fitted_area, ZP_REASON_CURVE, NULL, false},
    {ZP_TABLE_2_STROKE, "Table II", "stroke", "mm", "paper", chain_stroke, ZP_REASON_MISPRINT, NULL, false},
    {ZP_TABLE_2_REFERENCE, "Table II", "stroke of the finite elements", "mm", "paper", finite_elements,
     ZP_REASON_CONVERGENCE, NULL, true},
    {ZP_TABLE_2_STROKE_ERROR, "Table II", "stroke error", "mm", "paper", error_to_published, ZP_REASON_MISPRINT,
     error_slack, false},
    {ZP_TABLE_2_RELATIVE, "Table II", "relative error", "%", "paper", relative_to_published, ZP_REASON_MISPRINT,
     relative_slack, false},
    {ZP_TABLE_2_AREA, "Table II", "area error", "mm²", "paper", chain_area, ZP_REASON_CURVE, NULL, false},
    {ZP_FACTOR, "Factor", "factor by the paper's method", "", "paper", factor_by_their_books, ZP_REASON_UNKNOWN, NULL,
     false},
    {ZP_FACTOR_DEVIATION, "Factor", "its standard deviation", "", "paper", deviation_by_their_books, ZP_REASON_SCATTER,
     NULL, false},
    {ZP_FACTOR, "Factor", "factor by the field", "", "paper", factor_by_field, ZP_REASON_BOOKKEEPING, NULL, false},
    {ZP_AXIAL_SPRING, "Section III", "axial spring K_D", "N/µm", "paper", axial_spring, ZP_REASON_UNKNOWN, NULL, false},
    {ZP_COST, "Section III", "cost of a simulated second", "min", "paper", cost, ZP_REASON_MACHINE, NULL, false},
    {ZP_MEAN_STEP, "Section III", "mean time step", "µs", "paper", mean_step, ZP_REASON_STEPS, NULL, false},
    {ZP_RERUN_ZIP_6_KV, "Fig. 9", "zip time at 6 kV with N = 21", "ms", "program", zip_time, ZP_REASON_CONTACT, NULL,
     false},
    {ZP_RERUN_ZIP_10_KV, "Fig. 9", "zip time at 10 kV with N = 21", "ms", "program", zip_time, ZP_REASON_INFERRED, NULL,
     false},
    {.title = NULL},
};

/* No difference is within a tolerance of NAN: then, or if the difference is larger, the reason determines the verdict.
 */
static ZpVerdict verdict_on(const ZpSubject *subject, double ours, double published, double tolerance) {
  const ZpVerdict otherwise = reason[subject->reason].verdict;
  if (isnan(ours)) return ZP_VERDICT_NOT_RUN;
  return fabs(ours - published) <= tolerance ? ZP_VERDICT_AGREES : otherwise;
}

/* Largest |ours - published| that counts as agreement; NAN if the reason says that the numbers cannot be judged. */
static double tolerance_of(const ZpSubject *subject, const ZpPublished *published) {
  if (!verdict_info[reason[subject->reason].verdict].judged) return NAN;
  double slack = subject->slack ? subject->slack(published) : last_digit(published->text);
  return fmax(ZP_AGREEMENT * published->value, slack);
}

static ZpComparison compare(const ZpSubject *subject, const ZpPublished *published, const ZpRuns *runs) {
  const double ours = subject->ours(runs, published), tolerance = tolerance_of(subject, published);
  return (ZpComparison){.subject = subject,
                        .published = published,
                        .nodes = subject->any_nodes ? 0 : published->nodes,
                        .ours = ours,
                        .difference = ours / published->value - 1,
                        .tolerance = tolerance,
                        .verdict = verdict_on(subject, ours, published->value, tolerance)};
}

/* Is the same number, for the same load, already among these? */
static bool is_repeated(const ZpComparison *of_subject, const ZpComparison *end, const ZpPublished *published) {
  for (const ZpComparison *c = of_subject; c < end; c++)
    if (c->subject->any_nodes && c->published->load == published->load) return true;
  return false;
}

/* Add the published numbers of one subject. */
static void add(const ZpSubject *subject, const ZpRuns *runs, ZpComparisons *comparisons) {
  size_t count;
  const ZpPublished *published = zp_published_list(&count);
  const ZpComparison *first = comparisons->item + comparisons->count;
  for (size_t i = 0; i < count; i++)
    if (published[i].quantity == subject->quantity &&
        !is_repeated(first, comparisons->item + comparisons->count, &published[i]))
      comparisons->item[comparisons->count++] = compare(subject, &published[i], runs);
}

bool zp_comparison_has_reason(const ZpComparison *comparison) {
  return comparison->verdict != ZP_VERDICT_AGREES && comparison->verdict != ZP_VERDICT_NOT_RUN;
}

size_t zp_comparisons_count(const ZpComparisons *comparisons, ZpVerdict verdict) {
  size_t count = 0;
  for (size_t i = 0; i < comparisons->count; i++)
    count += comparisons->item[i].verdict == verdict;
  return count;
}

ZpStatus zp_compare(const ZpRuns *runs, ZpComparisons *comparisons, ZpError *err) {
  size_t subjects = 0, published;
  zp_published_list(&published);
  while (zp_subjects[subjects].title)
    subjects++;
  *comparisons = (ZpComparisons){.item = calloc(subjects * published + 1, sizeof(ZpComparison))};
  if (!comparisons->item) return zp_fail_memory(err);
  for (const ZpSubject *subject = zp_subjects; subject->title; subject++)
    add(subject, runs, comparisons);
  return ZP_OK;
}
