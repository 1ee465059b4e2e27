/* The part of study `plan` that needs no file: what it requires of a Def. The plan itself is
 * src/fit/plan.c. */
#include "base/fail.h"
#include "study/studies.h"

static const ZpRule rule[] = {ZP_RULE_NO_TABLE, ZP_RULE_ONE_MEMBER, ZP_RULE_STARTS, ZP_RULE_ELASTIC};
const ZpRules zp_rules_plan = ZP_RULES_OF(rule);

ZP_STUDY_OF_FILES(plan)
