/* Derivatives of a run in time by the keys of sensitivity.by. */
#ifndef ZP_STUDY_RATES_H
#define ZP_STUDY_RATES_H

#include <zipact/study.h>

#include "sim/run_rates.h"

/* Check sensitivity.by of a run: keys and models that have derivatives in time. ZP_BAD_INPUT names the key. */
ZpStatus zp_check_rates(const ZpActuatorDef *def, ZpError *err);

/* Follow the derivatives of a run, which has not begun, by the keys that its definition names; nothing where it names
 * none. In any case to be closed, before the run. */
ZpStatus zp_rates_open(ZpRunRates *rates, ZpSim *sim, ZpError *err);

/* Where the run has ended: add its derivatives, the numbers that they are of where the summary lacks them, and a note
 * on what has none. */
void zp_rates_add(const ZpRunRates *rates, ZpResult *result);

#endif
