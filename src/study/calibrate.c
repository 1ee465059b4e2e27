/* The part of study `calibrate` that needs no file: what it requires of a Def. The fit itself is
 * src/fit/calibrate.c. */
#include "base/fail.h"
#include "study/studies.h"

ZpStatus zp_check_calibrate(const ZpActuatorDef *def, ZpError *err) {
  if (def->drive.waveform != ZP_WAVEFORM_TABLE) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "drive.waveform = table: requires study actuate, not calibrate");
}

ZpStatus zp_study_calibrate(const ZpTask *task, ZpResult *result, ZpError *err) {
  (void)task, (void)result;
  return zp_fail(err, ZP_BAD_INPUT, "study = calibrate: run by zp_data_study_run of zipact/calibrate.h");
}
