/* Which study is run: the table of studies.def. This file is a layer above the studies; none of them includes it. */
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "def/check.h"
#include "def/device.h"
#include "run/hooks.h"
#include "study/estimate.h"
#include "study/rates.h"

/* Files that a study takes. */
enum { FILES_none, FILES_course, FILES_reference, FILES_measurements, FILES_candidates };

/* A study at work. */
typedef struct Row {
  const char *word, *shows;
  int files;
  const ZpRules *rules;
  ZpStatus (*check)(const ZpActuatorDef *def, ZpError *err);
  ZpStudyRun run;
} Row;

static const Row table[ZpStudy_COUNT] = {
#define ZP_STUDY(enumerator, word, shows, files, help)                                                                 \
  [enumerator] = {#word, #shows, FILES_##files, &zp_rules_##word, zp_check_##word, zp_study_##word},
#include <zipact/studies.def>
};

static bool is_study(ZpStudy study) {
  return (int)study >= 0 && (int)study < ZpStudy_COUNT;
}

const char *zp_study_name(ZpStudy study) {
  return is_study(study) ? table[study].word : "unknown";
}

bool zp_study_follows(ZpStudy study) {
  static const bool follows[ZpStudy_COUNT] = {
#define ZP_FOLLOWS(enumerator) [enumerator] = true,
#include <zipact/studies.def>
  };
  return is_study(study) && follows[study];
}

/* Does it run in time? */
static bool is_motion(ZpStudy study) {
  return strcmp(table[study].shows, "motion") == 0;
}

const ZpRule *zp_study_refusing(ZpStudy study, const ZpActuatorDef *def) {
  const ZpRule *rule = zp_rule_refusing(false, def);
  if (!rule) rule = zp_rules_find(table[study].rules, false, def);
  return rule || !is_motion(study) ? rule : zp_rule_refusing(true, def);
}

ZpStatus zp_study_check(ZpStudy study, const ZpActuatorDef *def, ZpError *err) {
  if (!is_study(study))
    return zp_fail(err, ZP_BAD_INPUT, "study = %d: out of range; 0 to %d", (int)study, ZpStudy_COUNT - 1);
  char asks[32];
  snprintf(asks, sizeof asks, "study %s ", table[study].word);
  ZpStatus status = zp_def_check(def, err);
  if (status == ZP_OK) status = zp_rule_fail(zp_rules_find(table[study].rules, false, def), asks, def, err);
  if (status == ZP_OK && is_motion(study)) status = zp_def_check_motion(def, err);
  return status == ZP_OK ? table[study].check(def, err) : status;
}

bool zp_task_stops(const ZpTask *task, const char *stage, double fraction) {
  return zp_hooks_stop(task->hooks, stage, fraction);
}

static ZpStatus solve(ZpStudyRun run, ZpStudy study, const ZpTask *task, ZpResult **result, ZpError *err) {
  *result = zp_result_create(study);
  if (!*result) return zp_fail_memory(err);
  ZpStatus status = run(task, *result, err);
  if (status == ZP_OK) return ZP_OK;
  zp_result_destroy(*result);
  *result = NULL;
  return status;
}

/* Solve on the requested mesh; if that has no answer, on one with half as long elements, and once more => the result,
 * and the mesh that it belongs to in `def`. */
static ZpStatus solve_resolved(ZpStudyRun run, ZpStudy study, const ZpTask *task, ZpActuatorDef *def, ZpResult **result,
                               ZpError *err) {
  enum { MOST = 2 };
  ZpStatus status = solve(run, study, task, result, err);
  for (int k = 0; k < MOST && status == ZP_OK; k++) {
    ZpOutcome outcome = (*result)->outcome;
    bool crosses = outcome == ZP_BEYOND_MODEL && !is_motion(study);
    if (outcome != ZP_BRANCH_LOST && !crosses) break;
    ZpActuatorDef finer = *def;
    finer.mesh.nodes = 2 * def->mesh.nodes - 1;
    if (zp_def_check(&finer, NULL) != ZP_OK) break;
    *def = finer;
    zp_result_destroy(*result);
    status = solve(run, study, &(ZpTask){def, task->input, task->hooks}, result, err);
    if (status == ZP_OK)
      zp_result_note(*result, "solved with %d nodes: with mesh.nodes = %d no equilibrium was found", def->mesh.nodes,
                     task->def->mesh.nodes);
  }
  return status;
}

/* One film of a pouch is modelled; the result has both. A single pouch is drawn lying, several hang. */
static void mirror(ZpResult *result) {
  ZpShapes *both = zp_shapes_mirrored(result->shapes, zp_shapes_members(result->shapes) == 1);
  if (!both) result->incomplete = true;
  if (!both) return;
  zp_shapes_destroy(result->shapes);
  result->shapes = both;
}

ZpStatus zp_study_run(ZpStudy study, const ZpActuatorDef *def, const ZpStudyInput *input, const ZpHooks *hooks,
                      ZpResult **out, ZpError *err) {
  *out = NULL;
  ZpStatus status = zp_study_check(study, def, err);
  if (status != ZP_OK) return status;
  ZpResult *result;
  ZpActuatorDef solved = *def;
  const ZpStudyInput files = input ? *input : (ZpStudyInput){0};
  const ZpTask asked = {def, files, hooks}, task = {&solved, files, hooks};
  ZpStudyRun run = table[study].run;
  status = solve_resolved(run, study, &asked, &solved, &result, err);
  if (status != ZP_OK) return status;
  bool moves = table[study].files == FILES_course;
  status = zp_estimate_errors(&task, run, moves, result, err);
  if (status == ZP_OK && moves) status = zp_rates_settle(&task, run, result, err);
  if (status == ZP_OK && result->shapes && zp_def_has(def, ZP_DEVICE_POUCH)) mirror(result);
  if (status == ZP_OK && result->incomplete) status = zp_fail_memory(err);
  if (status == ZP_OK)
    *out = result;
  else
    zp_result_destroy(result);
  return status;
}
