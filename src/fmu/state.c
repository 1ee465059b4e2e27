/* An instance <=> bytes. All numbers are those of the machine, since the binary is of one kind of machine:
 *
 *   mark, sum of all that follows, size, phase, whether a snapshot follows, whether outputs are out of date (8 bytes
 *   each)
 *   where the next row begins; start time, time, inputs, their rates, parameters, outputs (doubles)
 *   snapshot of the simulation, if it is prepared */
#include <string.h>

#include "base/fail.h"
#include "fmu/instance.h"

enum { BEFORE_PARAMETERS = 2 + 2 * ZP_INPUT_COUNT, DOUBLES = BEFORE_PARAMETERS + ZP_FMU_KEYS + ZP_FMU_SIGNALS };

static const uint64_t mark = UINT64_C(0x31756d667a70); /* "pzfmu1" */

typedef struct Head {
  uint64_t mark, sum, size, phase, prepared, stale;
  ZpRowStart row_start;
  double value[DOUBLES];
} Head;

/* FNV-1a. */
static uint64_t sum_of(const unsigned char *byte, size_t size) {
  uint64_t sum = UINT64_C(0xcbf29ce484222325);
  for (size_t k = 0; k < size; k++)
    sum = (sum ^ byte[k]) * UINT64_C(0x100000001b3);
  return sum;
}

static uint64_t sum_behind_sum(const unsigned char *byte, size_t size) {
  size_t begin = offsetof(Head, size);
  return sum_of(byte + begin, size - begin);
}

size_t zp_fmu_state_size(const ZpFmu *fmu) {
  return sizeof(Head) + (fmu->prepared ? zp_sim_state_size(fmu->sim) : 0);
}

/* (position to write) => next position */
static double *put(double *to, const double *from, size_t count) {
  memcpy(to, from, count * sizeof *to);
  return to + count;
}

static const double *take(const double *from, double *to, size_t count) {
  memcpy(to, from, count * sizeof *to);
  return from + count;
}

void zp_fmu_save(const ZpFmu *fmu, void *bytes) {
  unsigned char *byte = bytes;
  Head head = {.mark = mark,
               .size = zp_fmu_state_size(fmu),
               .phase = fmu->phase,
               .prepared = fmu->prepared,
               .stale = fmu->stale};
  double *to = put(head.value, &fmu->start_time, 1);
  to = put(to, &fmu->time, 1);
  to = put(to, fmu->input, ZP_INPUT_COUNT);
  to = put(to, fmu->rate, ZP_INPUT_COUNT);
  for (int key = 0; key < ZP_FMU_KEYS; key++)
    *to++ = zp_fmu_has_number(key) ? zp_def_get(&fmu->def, key) : 0;
  put(to, fmu->row, ZP_FMU_SIGNALS);
  if (fmu->prepared) head.row_start = zp_sim_row_start(fmu->sim);
  memcpy(byte, &head, sizeof head);
  if (fmu->prepared) zp_sim_save(fmu->sim, byte + sizeof head);
  head.sum = sum_behind_sum(byte, (size_t)head.size);
  memcpy(byte, &head, sizeof head);
}

static ZpStatus check(const Head *head, const void *bytes, size_t size, ZpError *err) {
  if (head->mark != mark) return zp_fail(err, ZP_BAD_INPUT, "not a state of this FMU");
  if (head->size != size || head->sum != sum_behind_sum(bytes, size))
    return zp_fail(err, ZP_BAD_INPUT, "the state is cut short or damaged");
  return ZP_OK;
}

/* Read the parameters => def. */
static ZpStatus take_def(const ZpFmu *fmu, const double *value, ZpActuatorDef *def, ZpError *err) {
  ZpFmuStart start = fmu->start;
  memcpy(start.value, value, sizeof start.value);
  return zp_fmu_start_def(&start, def, err);
}

/* Build the model of these parameters, and its simulation in the state of the snapshot. */
static ZpStatus restore(ZpFmu *fmu, ZpRowStart row_start, const unsigned char *snapshot, size_t size, ZpError *err) {
  ZpStatus status = zp_fmu_need_model(fmu, err);
  if (status == ZP_OK) status = zp_sim_restore(fmu->sim, snapshot, size, err);
  fmu->prepared = status == ZP_OK;
  if (fmu->prepared) zp_sim_set_row_start(fmu->sim, row_start);
  return status;
}

ZpStatus zp_fmu_load(ZpFmu *fmu, const void *bytes, size_t size, ZpError *err) {
  Head head;
  if (size < sizeof head) return zp_fail(err, ZP_BAD_INPUT, "the state is cut short: %zu bytes", size);
  memcpy(&head, bytes, sizeof head);
  const double *parameters = head.value + BEFORE_PARAMETERS, *from = head.value;
  ZpActuatorDef def;
  ZpStatus status = check(&head, bytes, size, err);
  if (status == ZP_OK) status = take_def(fmu, parameters, &def, err);
  if (status != ZP_OK) return status;
  fmu->def = def;
  from = take(from, &fmu->start_time, 1);
  from = take(from, &fmu->time, 1);
  from = take(from, fmu->input, ZP_INPUT_COUNT);
  take(from, fmu->rate, ZP_INPUT_COUNT);
  fmu->prepared = false;
  if (head.prepared)
    status = restore(fmu, head.row_start, (const unsigned char *)bytes + sizeof head, size - sizeof head, err);
  take(parameters + ZP_FMU_KEYS, fmu->row, ZP_FMU_SIGNALS);
  fmu->phase = status == ZP_OK ? (ZpFmuPhase)head.phase : ZP_FMU_FAILED;
  fmu->stale = head.stale != 0;
  return status;
}
