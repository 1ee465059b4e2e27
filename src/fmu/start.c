/* Start values => Def. */
#include "fmu/start.h"

#include <math.h>

#include "base/fail.h"
#include "base/memory.h"
#include "def/rule.h"
#include "drive/waveform.h"

/* FNV-1a of a text, with its final 0. */
static uint64_t mixed(uint64_t mark, const char *text) {
  do
    mark = (mark ^ (unsigned char)*text) * UINT64_C(0x100000001b3);
  while (*text++);
  return mark;
}

uint64_t zp_fmu_keys_mark(void) {
  uint64_t mark = UINT64_C(0xcbf29ce484222325);
  for (int index = 0; index < zp_key_count(); index++) {
    const ZpKey *key = zp_key(index);
    mark = mixed(mark, key->name) + (uint64_t)key->type;
    for (int k = 0; key->choices && k <= (int)key->max; k++)
      mark = mixed(mark, key->choices[k].word);
  }
  return mark;
}

bool zp_fmu_has_number(int index) {
  return zp_key(index)->type != ZP_KEY_TEXT && zp_key_in_def(index);
}

ZpStatus zp_fmu_start_def(const ZpFmuStart *start, ZpActuatorDef *def, ZpError *err) {
  const size_t most = ZP_KEYS + (size_t)start->givens;
  size_t count = 0;
  if (!start->token[0]) return zp_fail(err, ZP_BAD_INPUT, "this binary has no start values; `zipact fmu` writes them");
  if (start->layout != zp_fmu_keys_mark() || start->givens > ZP_FMU_GIVEN || start->names > ZP_FMU_NAMES)
    return zp_fail(err, ZP_BAD_INPUT, "the start values were written by a version of zipact with other keys");
  ZpAssignment *list = zp_calloc(most, sizeof *list);
  if (!list) return zp_fail_memory(err);
  for (int key = 0; key < ZP_KEYS; key++) /* rows of members and so on have no value themselves */
    if (zp_fmu_has_number(key)) list[count++] = (ZpAssignment){key, start->value[key]};
  for (size_t k = 0; k < start->givens; k++)
    list[count++] = start->given[k];
  ZpStatus status = zp_def_resolve(def, list, count, err);
  if (status == ZP_OK && start->names > 0) status = zp_def_set_names(def, start->name, (size_t)start->names, err);
  zp_free(list);
  return status;
}

/* A voltage that does not begin as a step does is stored as that of a ramp, whose offset is the first one and whose end
 * the largest, which is a scale of the solver. */
void zp_fmu_forget_waveforms(ZpActuatorDef *def, const ZpDriveTable *table) {
  static const double any_rise_time = 1; /* s */
  const ZpActuatorDef fresh = zp_actuator_def_default();
  const ZpWaveform voltage = zp_waveform_of(def, table), setpoint = zp_setpoint_of(def, table);
  def->drive = fresh.drive;
  def->setpoint = fresh.setpoint;
  def->drive.voltage = voltage.voltage;
  if (def->control.kind != ZP_CONTROL_NONE) def->setpoint.value = zp_waveform_voltage(&setpoint, 0);
  if (voltage.kind == ZP_WAVEFORM_STEP) return;
  def->drive.waveform = ZP_WAVEFORM_RAMP;
  def->drive.voltage = zp_waveform_largest(&voltage);
  def->drive.offset = zp_waveform_voltage(&voltage, 0);
  def->drive.rise_time = any_rise_time;
}

double zp_fmu_first(const ZpActuatorDef *def, int input) {
  int which;
  const int member = zp_def_input_member(def, input, &which);
  if (member < 0 || which == ZP_INPUT_LOAD) return 0;
  const bool voltage = which == ZP_INPUT_VOLTAGE;
  const int ramp = member > 0 ? zp_key_of_instance(ZP_KEY(member_K.drive.waveform), member) : ZP_KEY(drive.waveform);
  const bool step = zp_def_get(def, ramp) == ZP_WAVEFORM_STEP;
  const int row = member == 0
                      ? (voltage ? (step ? ZP_KEY(drive.voltage) : ZP_KEY(drive.offset)) : ZP_KEY(setpoint.value))
                  : voltage ? (step ? ZP_KEY(member_K.drive.voltage) : ZP_KEY(member_K.drive.offset))
                            : ZP_KEY(member_K.setpoint.value);
  const double value = zp_def_get(def, member > 0 ? zp_key_of_instance(row, member) : row);
  return isnan(value) ? 0 : value;
}
