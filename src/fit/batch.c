/* The runs of a scenario, one after the other. */
#include <zipact/batch.h>

#include <stdlib.h>

#include <zipact/calibrate.h>

#include "base/fail.h"

ZpStatus zp_batch_create(const ZpScenario *scenario, ZpBatch *batch, ZpError *err) {
  ZpActuatorDef def;
  ZpStatus status = ZP_OK;
  *batch = (ZpBatch){.scenario = scenario, .count = zp_scenario_count(scenario)};
  for (size_t i = 0; i < batch->count && status == ZP_OK; i++) {
    status = zp_scenario_def(scenario, i, &def, err);
    if (status == ZP_OK) status = zp_data_check(&def, err);
  }
  if (status != ZP_OK) return status;
  batch->result = calloc(batch->count + 1, sizeof(ZpResult *));
  return batch->result ? ZP_OK : zp_fail_memory(err);
}

void zp_batch_free(ZpBatch *batch) {
  for (size_t i = 0; i < batch->done; i++)
    zp_result_destroy(batch->result[i]);
  free(batch->result);
  *batch = (ZpBatch){0};
}

bool zp_batch_open(const ZpBatch *batch) {
  return batch->done < batch->count && !batch->interrupted;
}

/* A sweep reports no shapes and no checkpoints: keep its memory to the series. */
static void keep_the_series(ZpResult *result) {
  zp_shapes_destroy(result->shapes);
  result->shapes = NULL;
  zp_field_map_destroy(result->map);
  result->map = NULL;
  zp_checkpoint_destroy(result->checkpoint);
  result->checkpoint = NULL;
}

ZpStatus zp_batch_next(ZpBatch *batch, const ZpHooks *hooks, ZpError *err) {
  ZpActuatorDef def;
  ZpResult *result;
  ZpStatus status = zp_scenario_def(batch->scenario, batch->done, &def, err);
  if (status == ZP_OK) status = zp_data_study_run(&def, hooks, &result, err);
  if (status != ZP_OK) return status;
  if (batch->count > 1) keep_the_series(result);
  batch->result[batch->done++] = result;
  batch->interrupted = result->outcome == ZP_INTERRUPTED;
  return ZP_OK;
}

bool zp_batch_good(const ZpBatch *batch) {
  for (size_t i = 0; i < batch->done; i++)
    if (!zp_outcome_good(batch->result[i]->outcome)) return false;
  return true;
}
