/* Start values => Def. */
#include "fmu/start.h"

#include <math.h>

#include "base/fail.h"

bool zp_fmu_has_number(int index) {
  return zp_key(index)->type != ZP_KEY_TEXT && zp_key(index)->offset != ZP_NO_FIELD;
}

ZpStatus zp_fmu_start_def(const ZpFmuStart *start, ZpActuatorDef *def, ZpError *err) {
  ZpAssignment list[ZP_FMU_KEYS];
  size_t count = 0;
  if (!start->token[0]) return zp_fail(err, ZP_BAD_INPUT, "this binary has no start values; `zipact fmu` writes them");
  if (start->layout != zp_def_layout())
    return zp_fail(err, ZP_BAD_INPUT, "the start values were written by a version of zipact with other keys");
  for (int key = 0; key < ZP_FMU_KEYS; key++)
    if (zp_fmu_has_number(key)) list[count++] = (ZpAssignment){key, start->value[key]};
  return zp_def_resolve(def, list, count, err);
}

double zp_fmu_first_voltage(const ZpActuatorDef *def) {
  return def->drive.waveform == ZP_WAVEFORM_STEP ? def->drive.voltage : 0;
}

double zp_fmu_first_setpoint(const ZpActuatorDef *def) {
  return isnan(def->setpoint.value) ? 0 : def->setpoint.value;
}
