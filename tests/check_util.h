/* What the tests of the core share: building a model or a simulation from key-value pairs, relative
 * tolerances that print what was measured, and random numbers that are the same everywhere. */
#ifndef ZP_TESTS_CHECK_UTIL_H
#define ZP_TESTS_CHECK_UTIL_H

#include <check.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/zipact.h>

#include "actuator/model.h"
#include "def/check.h"
#include "run/info.h"
#include "sanitized.h"
#include "study/result.h"
#include "suite.h"

#define LENGTH_OF(array) (sizeof(array) / sizeof((array)[0]))

/* Where ZIPACT_CHECKS names a file, what a check compares, measures and allows is added there: docs/verification.md is
 * made from these lines, and scripts/wide-bounds.py finds bounds that are far from what is measured. */
static inline void note_check_at(const char *file, int line, const char *place, const char *what, const char *against,
                                 double measured, double allowed) {
  const char *name = getenv("ZIPACT_CHECKS"), *folder = strrchr(file, '/');
  FILE *record = name ? fopen(name, "a") : NULL;
  if (!record) return;
  fprintf(record, "%s:%d\t%s\t%s\t%s\t%.17g\t%.17g\n", folder ? folder + 1 : file, line, place, what, against, measured,
          allowed);
  fclose(record);
}
#define note_check(...) note_check_at(__FILE__, __LINE__, __VA_ARGS__)

/* |value - expected| <= tolerance |expected|, with a message that holds the numbers. */
#define ck_near(value, expected, tolerance)                                                                            \
  do {                                                                                                                 \
    double near_value = (value), near_expected = (expected), near_tolerance = (tolerance);                             \
    note_check(__func__, #value, #expected, fabs(near_value / near_expected - 1), near_tolerance);                     \
    ck_assert_msg(fabs(near_value - near_expected) <= near_tolerance * fabs(near_expected),                            \
                  "%s = %.10g, expected %.10g: off by %.2e, allowed %.2e", #value, near_value, near_expected,          \
                  fabs(near_value / near_expected - 1), near_tolerance);                                               \
  } while (0)

/* |value - expected| <= tolerance: Check's own assertion, noted. */
#undef ck_assert_double_eq_tol
#define ck_assert_double_eq_tol(value, expected, tolerance)                                                            \
  do {                                                                                                                 \
    double tol_value = (value), tol_expected = (expected), tol_tolerance = (tolerance);                                \
    note_check(__func__, #value " - " #expected, "", fabs(tol_value - tol_expected), tol_tolerance);                   \
    ck_assert_msg(fabs(tol_value - tol_expected) <= tol_tolerance,                                                     \
                  "%s = %.10g, expected %s = %.10g: off by %.2e, allowed %.2e", #value, tol_value, #expected,          \
                  tol_expected, fabs(tol_value - tol_expected), tol_tolerance);                                        \
  } while (0)

/* value < limit, with a message that holds the numbers. */
#define ck_below(value, limit)                                                                                         \
  do {                                                                                                                 \
    double below_value = (value), below_limit = (limit);                                                               \
    note_check(__func__, #value, "", below_value, below_limit);                                                        \
    ck_assert_msg(below_value < below_limit, "%s = %.4g, must be below %.4g", #value, below_value, below_limit);       \
  } while (0)

/* A call that must succeed, ck_ok(zp_def_check(&def, &err)), and one that must fail with a message that has these
 * words: both have an `err` of their own. */
#define ck_ok(call)                                                                                                    \
  do {                                                                                                                 \
    ZpError err = {ZP_OK, ""};                                                                                         \
    ck_assert_msg((call) == ZP_OK, "%s", err.message);                                                                 \
  } while (0)
#define ck_says(call, status, words)                                                                                   \
  do {                                                                                                                 \
    ZpError err = {ZP_OK, ""};                                                                                         \
    ck_assert_int_eq(call, status);                                                                                    \
    ck_assert_msg(strstr(err.message, words) != NULL, "no '%s' in: %s", words, err.message);                           \
  } while (0)

/* A key and its value, SI; NAN for auto. */
typedef struct Setting {
  const char *key;
  double value;
} Setting;

/* Copies of a Def that a test makes by = use its values of members' keys until the test ends. */
static inline void lend_members(ZpActuatorDef *def) {
  if (!def->given || def->given->of != def) return;
  def->given->of = NULL;
  if (def->given->name) zp_test_owns(def->given->name, zp_free);
  zp_test_owns(def->given, zp_free);
}

static inline void set_member(ZpActuatorDef *def, const char *key, double value) {
  ck_assert_int_eq(zp_def_set_number(def, key, value, NULL), ZP_OK);
  lend_members(def);
}

/* Defaults, kind, preset and settings, as a scenario would be resolved. */
static inline ZpStatus resolve(ZpActuatorDef *def, const Setting *list, size_t count, ZpError *err) {
  ZpAssignment assignment[64];
  ck_assert_uint_le(count, LENGTH_OF(assignment));
  for (size_t i = 0; i < count; i++) {
    int key = zp_key_find(list[i].key);
    ck_assert_msg(key >= 0, "no key %s", list[i].key);
    assignment[i] = (ZpAssignment){key, list[i].value};
  }
  ZpStatus status = zp_def_resolve(def, assignment, count, err);
  lend_members(def);
  return status;
}

/* The same of what is in order: without liquid and without estimates of errors, unless the settings say otherwise. */
static inline ZpActuatorDef def_with(const Setting *list, size_t count) {
  ZpActuatorDef def = {0};
  ZpError err = {ZP_OK, ""};
  Setting all[64] = {{"output.errors", 0}, {"liquid.model", ZP_LIQUID_NONE}};
  ck_assert_uint_lt(count + 1, LENGTH_OF(all));
  memcpy(all + 2, list, count * sizeof *list);
  ck_assert_msg(resolve(&def, all, count + 2, &err) == ZP_OK, "%s", err.message);
  return def;
}
#define DEF(...) def_with((const Setting[]){__VA_ARGS__}, sizeof((const Setting[]){__VA_ARGS__}) / sizeof(Setting))

/* A whole actuator whose platform turns. */
#define TURNS                                                                                                          \
  {"actuator.symmetry", ZP_SYMMETRY_NONE}, {"platform.rotates", 1}, {                                                  \
    "platform.electrode", 0                                                                                            \
  }

/* Objects that these helpers make are destroyed when the test ends. A test may do it earlier. */
#define zp_result_destroy(result) zp_result_destroy(zp_test_releases(result))
#define zp_model_destroy(model)   zp_model_destroy(zp_test_releases(model))
#define zp_sim_destroy(sim)       zp_sim_destroy(zp_test_releases(sim))

static inline void destroy_result(void *result) {
  (zp_result_destroy)(result);
}
static inline void destroy_model(void *model) {
  (zp_model_destroy)(model);
}
static inline void destroy_sim(void *sim) {
  (zp_sim_destroy)(sim);
}

/* Memory of this size, in bytes, full of zeros. */
static inline void *memory_of(size_t size) {
  void *memory = calloc(1, size);
  ck_assert_ptr_nonnull(memory);
  return zp_test_owns(memory, free);
}

/* A result of a study with nothing in it yet. */
static inline ZpResult *new_result(ZpStudy study) {
  ZpResult *result = zp_result_create(study);
  ck_assert_ptr_nonnull(result);
  return zp_test_owns(result, destroy_result);
}

/* What a study of a Def that is in order finds. */
static inline ZpResult *study_with(ZpStudy study, const ZpActuatorDef *def, const ZpStudyInput *input) {
  ZpResult *result = NULL;
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_study_run(study, def, input, NULL, &result, &err) == ZP_OK, "%s", err.message);
  return zp_test_owns(result, destroy_result);
}

static inline ZpResult *study_of(ZpStudy study, const ZpActuatorDef *def) {
  return study_with(study, def, NULL);
}

/* The same of a study that must answer. */
static inline ZpResult *answer_of(ZpStudy study, const ZpActuatorDef *def) {
  ZpResult *result = study_of(study, def);
  ck_assert_msg(zp_outcome_good(result->outcome), "%s", result->message);
  return result;
}

/* The result of a study that must converge. */
static inline ZpResult *converged_of(ZpStudy study, const ZpActuatorDef *def) {
  ZpResult *result = study_of(study, def);
  ck_assert_msg(result->outcome == ZP_CONVERGED, "%s", result->message);
  return result;
}

/* The derivative of an output by a key; NAN: it is not there. */
static inline double derivative_of(const ZpResult *result, const char *output, int key) {
  for (size_t k = 0; k < zp_result_sensitivities(result); k++) {
    const ZpSensitivity *of = zp_result_sensitivity(result, k);
    if (of->key == key && strcmp(of->output, output) == 0) return of->value;
  }
  return NAN;
}

static inline double answered_value(ZpStudy study, const ZpActuatorDef *def, const char *name) {
  return zp_result_get(answer_of(study, def), name);
}

/* The first note of a result that has these words; NULL if there is none. */
static inline const char *note_of(const ZpResult *result, const char *words) {
  for (size_t i = 0; i < result->notes; i++)
    if (strstr(result->note[i], words)) return result->note[i];
  return NULL;
}

/* How many have them. */
static inline size_t notes_with(const ZpResult *result, const char *words) {
  size_t count = 0;
  for (size_t i = 0; i < result->notes; i++)
    count += strstr(result->note[i], words) != NULL;
  return count;
}

/* A Def is refused, whatever the study, with a message that has these words. */
static inline void ck_refused(const ZpActuatorDef *def, const char *words) {
  ZpError err = {ZP_OK, ""};
  ck_assert_int_eq(zp_def_check(def, &err), ZP_BAD_INPUT);
  ck_assert_msg(strstr(err.message, words) != NULL, "no '%s' in: %s", words, err.message);
}

/* The same by one study. */
static inline void ck_refused_by(ZpStudy study, const ZpActuatorDef *def, const char *words) {
  ZpError err = {ZP_OK, ""};
  ZpResult *result = NULL;
  ck_assert_int_eq(zp_study_check(study, def, &err), ZP_BAD_INPUT);
  ck_assert_msg(strstr(err.message, words) != NULL, "no '%s' in: %s", words, err.message);
  ck_assert_int_eq(zp_study_run(study, def, NULL, NULL, &result, NULL), ZP_BAD_INPUT);
  ck_assert_ptr_null(result);
}

static inline ZpModel *model_of(const ZpActuatorDef *def) {
  ZpModel *model = NULL;
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_model_create(def, &model, &err) == ZP_OK, "%s", err.message);
  return zp_test_owns(model, destroy_model);
}

static inline ZpModel *driven_model_of(const ZpActuatorDef *def, size_t rows, const double *time,
                                       const double *voltage) {
  ZpModel *model = NULL;
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_model_create_driven(def, &(ZpDriveTable){rows, time, voltage}, &model, &err) == ZP_OK, "%s",
                err.message);
  return zp_test_owns(model, destroy_model);
}

static inline ZpSim *sim_of(const ZpModel *model) {
  ZpSim *sim = NULL;
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_sim_create(model, NULL, &sim, &err) == ZP_OK, "%s", err.message);
  return zp_test_owns(sim, destroy_sim);
}

static inline void run_to(ZpSim *sim, double time) {
  ZpRunInfo info;
  ck_assert_msg(zp_sim_run(sim, time, false, NULL, &info) == ZP_REACHED_END, "%s", info.message);
}

/* A signal of two simulations is the same number, or of neither one. */
static inline void ck_same_signal(ZpSim *one, ZpSim *other, const char *name) {
  double a = zp_sim_get(one, name), b = zp_sim_get(other, name);
  ck_assert_msg(a == b || (isnan(a) && isnan(b)), "%s: %.17g and %.17g", name, a, b);
}

/* Runs to `end`; another simulation of the model continues from a snapshot of here, to the same bits. Its signals and
 * the rows of its ledger tell what a snapshot lacks. */
static inline void ck_continues(ZpSim *sim, const ZpModel *model, double end) {
  const size_t size = zp_sim_state_size(sim);
  void *here = memory_of(size), *once = memory_of(size), *again = memory_of(size);
  ZpSim *other = sim_of(model);
  size_t signals;
  zp_signal_columns(&signals);
  zp_sim_start_row(sim);
  zp_sim_save(sim, here);
  run_to(sim, end);
  zp_sim_save(sim, once);
  ck_assert_int_eq(zp_sim_restore(other, here, size, NULL), ZP_OK);
  run_to(other, end);
  zp_sim_save(other, again);
  ck_assert_mem_eq(once, again, size);
  ck_assert_int_ne(memcmp(here, once, size), 0);
  for (size_t k = 0; k < signals; k++)
    ck_same_signal(sim, other, zp_signal_name(k));
  for (size_t k = 0; k < model->ledger.rows; k++)
    ck_same_signal(sim, other, model->ledger.row[k]->name);
}

/* Value of a signal after running to `end_time` from the start. */
static inline double settled_value(const ZpActuatorDef *def, const char *signal) {
  ZpSim *sim = sim_of(model_of(def));
  ZpRunInfo info;
  /* a run of no time: tells whether the equilibrium was found */
  ck_assert_msg(zp_sim_run(sim, 0, false, NULL, &info) == ZP_REACHED_END, "%s", info.message);
  return zp_sim_get(sim, signal);
}

/* Are signals of two simulations the same to this tolerance? Destroys both, and their models. */
static inline void ck_same_signals(ZpSim *const sims[2], ZpModel *const models[2], const char *const *signals,
                                   size_t count, double tolerance) {
  for (size_t k = 0; k < count; k++)
    ck_near(zp_sim_get(sims[1], signals[k]), zp_sim_get(sims[0], signals[k]), tolerance);
  for (int k = 0; k < 2; k++) {
    zp_sim_destroy(sims[k]);
    zp_model_destroy(models[k]);
  }
}

/* The largest magnitude of n numbers. */
static inline double largest_of(const double *x, size_t n) {
  double most = 0;
  for (size_t k = 0; k < n; k++)
    most = fmax(most, fabs(x[k]));
  return most;
}

/* Is a sum of squares of `freedom` normal numbers between what 1 and what 999 of 1000 are below, by Wilson and
 * Hilferty? */
static inline void ck_chi_square(const char *of, double sum, double freedom) {
  const double mean = 1 - 2 / (9 * freedom), spread = 3.29 * sqrt(2 / (9 * freedom));
  const double low = freedom * pow(mean - spread, 3), high = freedom * pow(mean + spread, 3);
  printf("%s: %.1f of %.0f, from %.1f to %.1f\n", of, sum, freedom, low, high);
  ck_assert_msg(sum > low && sum < high, "%s: %.1f, not from %.1f to %.1f", of, sum, low, high);
}

/* Uniform in (-1, 1), from a seed, the same everywhere. */
static inline double noise(uint64_t *seed) {
  *seed = *seed * 6364136223846793005u + 1442695040888963407u;
  return (double)(int64_t)*seed * 0x1p-63;
}

/* The derivative of `output` by `key` in a result; a failure if there is none. */
static inline double slope_in(const ZpResult *result, const char *output, const char *key) {
  for (size_t i = 0; i < result->sensitivities; i++)
    if (strcmp(result->sensitivity[i].output, output) == 0 && result->sensitivity[i].key == zp_key_find(key))
      return result->sensitivity[i].value;
  ck_abort_msg("no derivative of %s by %s", output, key);
  return NAN;
}
static inline void write_file(const char *path, const char *text) {
  FILE *file = fopen(path, "w");
  ck_assert_ptr_nonnull(file);
  fputs(text, file);
  ck_assert_int_eq(fclose(file), 0);
}

/* The largest magnitude in a column. */
static inline double largest_in(const ZpTable *table, const char *column) {
  double most = 0;
  for (size_t r = 0; r < table->rows; r++)
    most = fmax(most, fabs(zp_table_get(table, r, column)));
  return most;
}

/* The largest energy in motion: that of gravity and the electric work, by magnitude. */
static inline double largest_energy_in(const ZpTable *series) {
  double most = 0;
  for (size_t r = 0; r < series->rows; r++)
    most = fmax(most,
                fabs(zp_table_get(series, r, "gravity_energy_J")) + fabs(zp_table_get(series, r, "electric_work_J")));
  return most;
}

/* A column begins at zero or above and falls nowhere by more than `rounding`; its last value. */
static inline double never_falls(const ZpTable *table, const char *column, double rounding) {
  double before = 0;
  for (size_t r = 0; r < table->rows; r++) {
    double value = zp_table_get(table, r, column);
    ck_assert_double_ge(value, before - rounding);
    before = value;
  }
  return before;
}

/* Key `index`; of a key that stands for those of all members, that of member 8. */
static inline int key_of_one(int index) {
  return zp_key_is_row(index) ? zp_key_of_instance(index, 8) : index;
}

#endif
