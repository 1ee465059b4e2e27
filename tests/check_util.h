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
#include "def/def.h"
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

/* A key and its value, SI; NAN for auto. */
typedef struct Setting {
  const char *key;
  double value;
} Setting;

/* Defaults, kind, preset and settings, as a scenario would be resolved. */
static inline ZpStatus resolve(ZpActuatorDef *def, const Setting *list, size_t count, ZpError *err) {
  ZpAssignment assignment[64];
  ck_assert_uint_le(count, LENGTH_OF(assignment));
  for (size_t i = 0; i < count; i++) {
    int key = zp_key_find(list[i].key);
    ck_assert_msg(key >= 0, "no key %s", list[i].key);
    assignment[i] = (ZpAssignment){key, list[i].value};
  }
  return zp_def_resolve(def, assignment, count, err);
}

/* The same of what is in order: without liquid and without estimates of errors, unless the settings say otherwise. */
static inline ZpActuatorDef def_with(const Setting *list, size_t count) {
  ZpActuatorDef def;
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

/* What a study of a Def that is in order finds. */
static inline ZpResult *study_of(ZpStudy study, const ZpActuatorDef *def) {
  ZpResult *result = NULL;
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_study_run(study, def, NULL, NULL, &result, &err) == ZP_OK, "%s", err.message);
  return result;
}

/* The same of a study that must answer. */
static inline ZpResult *answer_of(ZpStudy study, const ZpActuatorDef *def) {
  ZpResult *result = study_of(study, def);
  ck_assert_msg(zp_outcome_good(result->outcome), "%s", result->message);
  return result;
}

static inline double answered_value(ZpStudy study, const ZpActuatorDef *def, const char *name) {
  ZpResult *result = answer_of(study, def);
  double value = zp_result_get(result, name);
  zp_result_destroy(result);
  return value;
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
  ck_assert_int_eq(zp_study_check(study, def, &err), ZP_BAD_INPUT);
  ck_assert_msg(strstr(err.message, words) != NULL, "no '%s' in: %s", words, err.message);
}

static inline ZpModel *model_of(const ZpActuatorDef *def) {
  ZpModel *model = NULL;
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_model_create(def, &model, &err) == ZP_OK, "%s", err.message);
  return model;
}

static inline ZpSim *sim_of(const ZpModel *model) {
  ZpSim *sim = NULL;
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_sim_create(model, NULL, &sim, &err) == ZP_OK, "%s", err.message);
  return sim;
}

/* Value of a signal after running to `end_time` from the start. */
static inline double settled_value(const ZpActuatorDef *def, const char *signal) {
  ZpModel *model = model_of(def);
  ZpSim *sim = sim_of(model);
  ZpRunInfo info;
  /* a run of no time: tells whether the equilibrium was found */
  ck_assert_msg(zp_sim_run(sim, 0, false, NULL, &info) == ZP_REACHED_END, "%s", info.message);
  double value = zp_sim_get(sim, signal);
  zp_sim_destroy(sim);
  zp_model_destroy(model);
  return value;
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

/* Uniform in (-1, 1), from a seed, the same everywhere. */
static inline double noise(uint64_t *seed) {
  *seed = *seed * 6364136223846793005u + 1442695040888963407u;
  return (double)(int64_t)*seed * 0x1p-63;
}

/* The derivative of `output` by `key` in a result; a failure if there is none. */
static inline double slope_in(const ZpResult *result, const char *output, const char *key) {
  for (size_t i = 0; i < result->sensitivities; i++)
    if (strcmp(result->sensitivity[i].output, output) == 0 &&
        strcmp(zp_key(result->sensitivity[i].key)->name, key) == 0)
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

#endif
