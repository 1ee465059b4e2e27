/* Which study is run: the table of studies.def. This file is a layer above the studies; none of them includes it. */
#include "base/fail.h"
#include "def/check.h"
#include "sim/hooks.h"
#include "study/estimate.h"
#include "study/rates.h"

/* What a study takes from files. */
enum { FILES_none, FILES_course, FILES_reference, FILES_measurements };

/* A study at work. */
typedef struct Row {
  const char *word;
  int files;
  ZpStatus (*check)(const ZpActuatorDef *def, ZpError *err);
  ZpStudyRun run;
} Row;

static const Row table[ZpStudy_COUNT] = {
#define ZP_STUDY(enumerator, word, shows, files, help)                                                                 \
  [enumerator] = {#word, FILES_##files, zp_check_##word, zp_study_##word},
#include <zipact/studies.def>
};

static bool is_study(ZpStudy study) {
  return (int)study >= 0 && study < ZpStudy_COUNT;
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

/* Does a study support the members of this definition? */
static bool supports(ZpStudy study, const ZpActuatorDef *def) {
  static const bool many[ZpStudy_COUNT] = {
#define ZP_MEMBERS(enumerator) [enumerator] = true,
#include <zipact/studies.def>
  };
  return zp_def_members(def) == 1 || many[study];
}

/* What a message advises in place of a study that supports a single actuator only. */
static const char *instead_of(ZpStudy study) {
  static const char *const instead[ZpStudy_COUNT] = {
#define ZP_ALONE(enumerator, words) [enumerator] = words,
#include <zipact/studies.def>
  };
  return instead[study] ? instead[study] : "use stack.series 1";
}

/* The same for members that share a load. */
static const char *instead_of_shared(ZpStudy study) {
  static const char *const instead[ZpStudy_COUNT] = {
#define ZP_ALONE_SHARED(enumerator, words) [enumerator] = words,
#include <zipact/studies.def>
  };
  return instead[study] ? instead[study] : "stationary, equilibrium, limits, modes and actuate do";
}

/* Does it unload ribbons through equilibria? */
static bool is_elastic(ZpStudy study) {
  static const bool elastic[ZpStudy_COUNT] = {
#define ZP_ELASTIC(enumerator) [enumerator] = true,
#include <zipact/studies.def>
  };
  return elastic[study];
}

ZpStatus zp_study_check(ZpStudy study, const ZpActuatorDef *def, ZpError *err) {
  if (!is_study(study))
    return zp_fail(err, ZP_BAD_INPUT, "study = %d: out of range; 0 to %d", (int)study, ZpStudy_COUNT - 1);
  ZpStatus status = zp_def_check(def, err);
  if (status != ZP_OK) return status;
  if (def->initial.state == ZP_INITIAL_CHECKPOINT && table[study].files != FILES_course)
    return zp_fail(err, ZP_BAD_INPUT, "initial.state = checkpoint: requires study actuate, not %s", table[study].word);
  if (!supports(study, def) && zp_def_opposed(def))
    return zp_fail(err, ZP_BAD_INPUT, "stack.distance = %g m: study %s does not support antagonists; %s",
                   def->stack.distance, table[study].word, instead_of_shared(study));
  if (!supports(study, def) && zp_def_abreast(def))
    return zp_fail(err, ZP_BAD_INPUT,
                   "stack.parallel = %d with unequal members: study %s does not support them; %s; without keys of "
                   "member_K the members are equal, which all studies support",
                   def->stack.parallel, table[study].word, instead_of_shared(study));
  if (!supports(study, def))
    return zp_fail(err, ZP_BAD_INPUT, "stack.series = %d: study %s does not support members in series; %s",
                   def->stack.series, table[study].word, instead_of(study));
  if (def->ribbon.plasticity && is_elastic(study))
    return zp_fail(err, ZP_BAD_INPUT,
                   "ribbon.plasticity = true: study %s unloads ribbons along equilibria, which assumes that they do "
                   "not yield; use study actuate, or ribbon.plasticity false",
                   table[study].word);
  return table[study].check(def, err);
}

bool zp_task_stops(const ZpTask *task, const char *stage, double fraction) {
  return zp_hooks_stop(task->hooks, stage, fraction);
}

static bool stops_hanging(void *task) {
  return zp_task_stops(task, "hanging", 0);
}

void zp_task_watches(const ZpTask *task, ZpStatics *statics) {
  statics->stop = stops_hanging;
  statics->caller = (void *)task;
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

/* Solve on the requested mesh; if the branch is lost, on one with half as long elements, and once more => the result,
 * and the mesh that it belongs to in `def`. */
static ZpStatus solve_resolved(ZpStudyRun run, ZpStudy study, const ZpTask *task, ZpActuatorDef *def, ZpResult **result,
                               ZpError *err) {
  enum { MOST = 2 };
  ZpStatus status = solve(run, study, task, result, err);
  for (int k = 0; k < MOST && status == ZP_OK && (*result)->outcome == ZP_BRANCH_LOST; k++) {
    ZpActuatorDef finer = *def;
    finer.mesh.nodes = 2 * def->mesh.nodes - 1;
    if (zp_def_check(&finer, NULL) != ZP_OK) break;
    *def = finer;
    zp_result_destroy(*result);
    status = solve(run, study, &(ZpTask){def, task->input, task->hooks}, result, err);
    if (status == ZP_OK)
      zp_result_note(*result, "solved with %d nodes: with mesh.nodes = %d the branch of equilibria was lost",
                     def->mesh.nodes, task->def->mesh.nodes);
  }
  return status;
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
  if (status == ZP_OK)
    *out = result;
  else
    zp_result_destroy(result);
  return status;
}
