/* An instance <=> bytes: a record of what its importer has set and read; behind it, if the simulation is prepared, its
 * snapshot. */
#include <string.h>

#include <zipact/checkpoint.h>
#include <zipact/version.h>

#include "base/fail.h"
#include "base/pack.h"
#include "fmu/instance.h"
#include "run/snapshot.h"

static const ZpPackKind kind = {"state of an FMU", 'F', 10};

/* A copy of the instance, and what the record has in another form. */
typedef struct Kept {
  ZpFmu fmu;
  size_t phase;
  ZpRowStart row_start;
  double parameter[ZP_KEYS]; /* 0 of a key without a number */
  double given[ZP_FMU_GIVEN];
} Kept;

static void walk(ZpPack *p, Kept *kept) {
  zp_pack_field(p, "phase", ZP_SIZE, &kept->phase, 1);
  zp_pack_field(p, "prepared", ZP_FLAG, &kept->fmu.prepared, 1);
  zp_pack_field(p, "stale", ZP_FLAG, &kept->fmu.stale, 1);
  zp_pack_field(p, "row_start.time", ZP_REAL, &kept->row_start.time, 1);
  zp_pack_field(p, "row_start.charge", ZP_REAL, &kept->row_start.charge, 1);
  zp_pack_field(p, "row_start.energy", ZP_REAL, &kept->row_start.energy, 1);
  zp_pack_field(p, "start_time", ZP_REAL, &kept->fmu.start_time, 1);
  zp_pack_field(p, "time", ZP_REAL, &kept->fmu.time, 1);
  const size_t givens = (size_t)kept->fmu.start.givens, inputs = givens > 0 ? ZP_FMU_INPUTS : ZP_INPUT_COUNT,
               outputs = givens > 0 ? ZP_FMU_OUTPUTS : ZP_FMU_SIGNALS;
  zp_pack_field(p, "inputs", ZP_REAL, kept->fmu.input, inputs);
  zp_pack_field(p, "rates", ZP_REAL, kept->fmu.rate, inputs);
  zp_pack_field(p, "outputs", ZP_REAL, kept->fmu.row, outputs);
  zp_pack_field(p, "parameters", ZP_REAL, kept->parameter, ZP_KEYS);
  if (givens > 0) zp_pack_field(p, "network", ZP_REAL, kept->given, givens);
}

static Kept kept_of(const ZpFmu *fmu) {
  Kept kept = {.fmu = *fmu, .phase = fmu->phase};
  if (fmu->prepared) kept.row_start = zp_sim_row_start(fmu->sim);
  for (int key = 0; key < ZP_KEYS; key++)
    if (zp_fmu_has_number(key)) kept.parameter[key] = zp_def_get(&fmu->def, key);
  for (size_t k = 0; k < fmu->start.givens; k++)
    kept.given[k] = zp_def_get(&fmu->def, fmu->start.given[k].key);
  return kept;
}

size_t zp_fmu_state_size(const ZpFmu *fmu) {
  Kept kept = {.fmu = {.start = fmu->start}};
  ZpPack p = zp_pack_count();
  walk(&p, &kept);
  return p.used + (fmu->prepared ? zp_sim_state_size(fmu->sim) : 0);
}

void zp_fmu_save(const ZpFmu *fmu, void *bytes) {
  Kept kept = kept_of(fmu);
  ZpPack p = zp_pack_write(&kind, bytes);
  walk(&p, &kept);
  zp_pack_seal(&p);
  if (fmu->prepared) zp_sim_save(fmu->sim, (unsigned char *)bytes + p.used);
}

/* Read the record, and check what is behind it. */
static ZpStatus read_record(const unsigned char *byte, size_t own, size_t size, Kept *kept, ZpError *err) {
  static const char old[] = "pzfmu1"; /* where a state by zipact 0.1.0 begins */
  ZpPack p;
  if (own >= sizeof old && memcmp(byte, old, sizeof old) == 0)
    return zp_fail(err, ZP_BAD_INPUT, "a state by an FMU of zipact 0.1.0, which had another format; this FMU is of %s",
                   ZP_VERSION);
  ZpStatus status = zp_pack_read(&kind, byte, own, &p, err);
  if (status != ZP_OK) return status;
  walk(&p, kept);
  status = zp_pack_end(&p, err);
  if (status != ZP_OK || (!kept->fmu.prepared && own == size)) return status;
  ZpCheckpoint *snapshot = NULL;
  status = zp_checkpoint_from(byte + own, size - own, &snapshot, err);
  zp_checkpoint_destroy(snapshot);
  return status;
}

/* Build the model of the parameters, and its simulation in the state of the snapshot. */
static ZpStatus restore(ZpFmu *fmu, ZpRowStart row_start, const unsigned char *snapshot, size_t size, ZpError *err) {
  ZpStatus status = zp_fmu_need_model(fmu, err);
  if (status == ZP_OK) status = zp_sim_restore(fmu->sim, snapshot, size, err);
  fmu->prepared = status == ZP_OK;
  if (fmu->prepared) zp_sim_set_row_start(fmu->sim, row_start);
  return status;
}

ZpStatus zp_fmu_load(ZpFmu *fmu, const void *bytes, size_t size, ZpError *err) {
  const unsigned char *byte = bytes;
  const size_t own = zp_pack_first(byte, size);
  Kept kept = {.fmu = *fmu};
  ZpFmuStart start = fmu->start;
  ZpActuatorDef def = {0};
  ZpStatus status = read_record(byte, own, size, &kept, err);
  memcpy(start.value, kept.parameter, sizeof start.value);
  for (size_t k = 0; k < start.givens; k++)
    start.given[k].value = kept.given[k];
  if (status == ZP_OK) status = zp_fmu_start_def(&start, &def, err);
  if (status == ZP_OK) status = zp_def_assign(&fmu->def, &def, err);
  zp_def_clear(&def);
  if (status != ZP_OK) return status;
  kept.fmu.def = fmu->def;
  *fmu = kept.fmu;
  if (fmu->prepared) status = restore(fmu, kept.row_start, byte + own, size - own, err);
  fmu->phase = status == ZP_OK ? (ZpFmuPhase)kept.phase : ZP_FMU_FAILED;
  return status;
}
