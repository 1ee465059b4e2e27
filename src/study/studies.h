/* Rules and functions of each study, which its file defines: zp_rules_WORD are the combinations of keys that it
 * refuses, zp_check_WORD checks numbers of a Def that has passed these and zp_def_check, zp_study_WORD fills a result.
 */
#ifndef ZP_STUDY_STUDIES_H
#define ZP_STUDY_STUDIES_H

#include "study/result.h"

#include "def/rule.h"

/* Input of a study. */
typedef struct ZpTask {
  const ZpActuatorDef *def; /* checked */
  ZpStudyInput input;
  const ZpHooks *hooks; /* may be NULL */
} ZpTask;

/* Tell the caller how far the study is. => Is it to stop? */
bool zp_task_stops(const ZpTask *task, const char *stage, double fraction);

/* Does a result have a number of this name? It may be null. */
bool zp_result_has(const ZpResult *result, const char *name);

/* isometric.separation is within the reach of ribbons that are held there. */
ZpStatus zp_check_held(const ZpActuatorDef *def, ZpError *err);

/* Can a controller hold its setpoint? Small motions about the equilibrium that the setpoint determines, with the
 * controller and without it (docs/theory.md, section 28): add their numbers and what they say to a result; nothing
 * without a controller. */
ZpStatus zp_add_hold(const ZpActuatorDef *def, ZpResult *result, ZpError *err);

/* Function that fills a result: a zp_study_WORD. */
typedef ZpStatus (*ZpStudyRun)(const ZpTask *task, ZpResult *result, ZpError *err);

/* The zip time of study actuate and nothing else, in less time: no rows and no shapes, and energy does not balance. */
ZpStatus zp_study_zip_time(const ZpTask *task, ZpResult *result, ZpError *err);

/* Rules that several studies have: of what unloads ribbons through equilibria, of what computes derivatives, of what
 * does not resume a run. */
#define ZP_RULE_ELASTIC                                                                                                \
  {                                                                                                                    \
    ZP_RULE_EQUATION, false, ZP_ANY, ZP_ANY, ZP_IS(ribbon.plasticity, false),                                          \
        "it unloads ribbons along equilibria, which have no history; use study actuate"                                \
  }
#define ZP_RULE_DERIVATIVES                                                                                            \
  {                                                                                                                    \
    ZP_RULE_NOT_MODELLED, false, ZP_SET(sensitivity.by), ZP_ANY, ZP_IS(electro.model, ZP_ELECTRO_PLATES),              \
        "the derivatives of a computed field are not available"                                                        \
  }
#define ZP_RULE_STARTS                                                                                                 \
  {                                                                                                                    \
    ZP_RULE_PHYSICS, false, ZP_ANY, ZP_ANY, ZP_NOT(initial.state, ZP_INITIAL_CHECKPOINT),                              \
        "only study actuate resumes a run"                                                                             \
  }

/* The functions of a study that reads files, which only zp_data_study_run of zipact/calibrate.h runs: a Def that its
 * rules let pass is good, and without files there is no result. */
#define ZP_STUDY_OF_FILES(word)                                                                                        \
  ZpStatus zp_check_##word(const ZpActuatorDef *def, ZpError *err) {                                                   \
    (void)def, (void)err;                                                                                              \
    return ZP_OK;                                                                                                      \
  }                                                                                                                    \
  ZpStatus zp_study_##word(const ZpTask *task, ZpResult *result, ZpError *err) {                                       \
    (void)task, (void)result;                                                                                          \
    return zp_fail(err, ZP_BAD_INPUT, "study = " #word ": run by zp_data_study_run of zipact/calibrate.h");            \
  }

/* Rules of fits, which compute cases by several studies. */
#define ZP_RULE_NO_TABLE                                                                                               \
  {                                                                                                                    \
    ZP_RULE_PHYSICS, false, ZP_ANY, ZP_ANY, ZP_NOT(drive.waveform, ZP_WAVEFORM_TABLE),                                 \
        "only study actuate runs in time"                                                                              \
  }
#define ZP_RULE_ONE_MEMBER                                                                                             \
  { ZP_RULE_NOT_MODELLED, false, ZP_SEVERAL, ZP_ANY, ZP_NEVER, "fit the keys of one member, with stack.series 1" }

/* The rule by which a study refuses a Def, its own or one of all studies; NULL if another check does, or none. */
const ZpRule *zp_study_refusing(ZpStudy study, const ZpActuatorDef *def);

#define ZP_STUDY(enumerator, word, shows, files, help)                                                                 \
  extern const ZpRules zp_rules_##word;                                                                                \
  ZpStatus zp_check_##word(const ZpActuatorDef *def, ZpError *err);                                                    \
  ZpStatus zp_study_##word(const ZpTask *task, ZpResult *result, ZpError *err);
#include <zipact/studies.def>

#endif
