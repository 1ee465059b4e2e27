/* The part of study `calibrate` that needs no file: what it requires of a Def. The fit itself is
 * src/fit/calibrate.c. */
#include "base/fail.h"
#include "study/studies.h"

static const ZpRule rule[] = {ZP_RULE_NO_TABLE, ZP_RULE_ONE_MEMBER, ZP_RULE_STARTS, ZP_RULE_ELASTIC};
const ZpRules zp_rules_calibrate = ZP_RULES_OF(rule);

ZpStatus zp_check_calibrate(const ZpActuatorDef *def, ZpError *err) {
  (void)def, (void)err;
  return ZP_OK;
}

ZpStatus zp_study_calibrate(const ZpTask *task, ZpResult *result, ZpError *err) {
  (void)task, (void)result;
  return zp_fail(err, ZP_BAD_INPUT, "study = calibrate: run by zp_data_study_run of zipact/calibrate.h");
}
