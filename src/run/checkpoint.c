/* Snapshots as objects from which runs resume, and which runs may resume from them. */
#include <zipact/checkpoint.h>

#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "def/purpose.h"
#include "def/rule.h"
#include "run/run.h"
#include "run/snapshot.h"

static ZpCheckpoint *create(size_t size) {
  ZpCheckpoint *checkpoint = zp_calloc(1, sizeof *checkpoint);
  if (!checkpoint) return NULL;
  *checkpoint = (ZpCheckpoint){size, zp_calloc(1, size)};
  if (checkpoint->byte) return checkpoint;
  zp_free(checkpoint);
  return NULL;
}

ZpStatus zp_checkpoint_from(const void *bytes, size_t size, ZpCheckpoint **out, ZpError *err) {
  *out = NULL;
  ZpStatus status = zp_snapshot_check(NULL, bytes, size, err);
  if (status != ZP_OK) return status;
  *out = create(size);
  if (!*out) return zp_fail_memory(err);
  memcpy((*out)->byte, bytes, size);
  return ZP_OK;
}

void zp_checkpoint_destroy(ZpCheckpoint *checkpoint) {
  if (!checkpoint) return;
  zp_free(checkpoint->byte);
  zp_free(checkpoint);
}

double zp_checkpoint_time(const ZpCheckpoint *checkpoint) {
  return zp_snapshot_time(checkpoint->byte, checkpoint->size);
}

/* -- what it fits ---------------------------------------------------------------------------------- */

bool zp_checkpoint_holds(int index) {
  if (!zp_key_in_def(index) || zp_key_is_material(index)) return false;
  return !(zp_key_purposes(index) & ZP_MAY_CHANGE);
}

static ZpStatus check_time(const ZpCheckpoint *checkpoint, const ZpActuatorDef *def, ZpError *err) {
  double t = zp_checkpoint_time(checkpoint);
  if (def->solver.end_time > t) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "it ends at %.9g s, so solver.end_time must be larger than %.9g s", t,
                 def->solver.end_time);
}

ZpStatus zp_checkpoint_check(const ZpCheckpoint *checkpoint, const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = zp_snapshot_check(def, checkpoint->byte, checkpoint->size, err);
  return status == ZP_OK ? check_time(checkpoint, def, err) : status;
}

/* -- of a simulation ------------------------------------------------------------------------------- */

ZpStatus zp_sim_checkpoint(const ZpSim *sim, ZpCheckpoint **out, ZpError *err) {
  *out = NULL;
  if (sim->settled != ZP_REACHED_END) return ZP_OK;
  ZpState **passed = zp_calloc(sim->members, sizeof(ZpState *));
  if (passed) *out = create(zp_snapshot_size(sim->model));
  if (*out) zp_sim_passed(sim, passed);
  if (*out) zp_snapshot_write(sim->model, passed, (*out)->byte);
  zp_free(passed);
  return *out ? ZP_OK : zp_fail_memory(err);
}

ZpStatus zp_sim_continue(ZpSim *sim, const ZpCheckpoint *checkpoint, ZpError *err) {
  const ZpActuatorDef *def = &sim->model->def; /* of a series that of its uppermost member */
  ZpStatus status = sim->members > 1 ? check_time(checkpoint, def, err) : zp_checkpoint_check(checkpoint, def, err);
  return status == ZP_OK ? zp_sim_restore(sim, checkpoint->byte, checkpoint->size, err) : status;
}

/* -- rules ----------------------------------------------------------------------------------------- */

static const ZpRule rule[] = {ZP_RULE(PHYSICS, ZP_SET(initial.file), ZP_IS(initial.state, ZP_INITIAL_CHECKPOINT),
                                      "another initial state has no file")};
static const ZpRules rules = ZP_RULES_OF(rule);
const ZpRules *const zp_rules_of_checkpoint[] = {&rules, NULL};
