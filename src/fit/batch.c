/* The runs of a scenario, one after the other. */
#include <zipact/batch.h>

#include <stdlib.h>

#include <zipact/calibrate.h>

#include "base/fail.h"
#include "def/check.h"
#include "fit/case.h"
#include "fit/data.h"
#include "io/guard.h"
#include "io/plan.h"
#include "io/report.h"
#include "study/result.h"

/* Bytes that a run may need while it lasts. */
enum { MARGIN = 1 << 22 };

ZpStatus zp_batch_create(const ZpScenario *scenario, ZpBatch *batch, ZpError *err) {
  *batch = (ZpBatch){.scenario = scenario, .count = zp_scenario_count(scenario)};
  ZpStatus status = zp_batch_check(scenario, err);
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

/* A sweep reports neither shapes nor further tables nor checkpoints: keep only the series in memory. */
static void keep_the_series(ZpResult *result) {
  zp_result_forget_further(result);
  zp_shapes_destroy(result->shapes);
  result->shapes = NULL;
  zp_field_map_destroy(result->map);
  result->map = NULL;
  zp_checkpoint_destroy(result->checkpoint);
  result->checkpoint = NULL;
}

/* A sweep ends while its results can still be written: there must be memory for the report of two more runs like those
 * that are done, and as much again as they hold. */
static ZpStatus need_room(const ZpBatch *batch, ZpError *err) {
  if (batch->done == 0) return ZP_OK;
  size_t more = 2 * batch->numbers / batch->done;
  size_t room = zp_report_room(batch->done + 2, batch->numbers + more) + more * sizeof(double) + MARGIN;
  if (zp_has_room(room)) return ZP_OK;
  return zp_fail(err, ZP_MACHINE, "no memory for run %zu of %zu; earlier results are kept", batch->done + 1,
                 batch->count);
}

static size_t at_most(size_t length, size_t most) {
  return length < most ? length : most;
}

/* Cases that follow each other with only the fastest list varying. */
static size_t row_of(const ZpScenario *scenario) {
  size_t axes, row = 1;
  const int *axis = zp_scenario_axes(scenario, &axes);
  const ZpDesign *design = zp_scenario_design(scenario);
  if (design) return zp_design_samples(design);
  if (axes > 0) zp_scenario_axis(scenario, axis[axes - 1], &row);
  return row;
}

/* Chunks of about `cases` cases that consist of whole rows, or of equal parts of one. */
static size_t in_rows(const ZpScenario *scenario, size_t cases) {
  const size_t row = row_of(scenario), shortest = (row + ZP_CHUNK_MOST - 1) / ZP_CHUNK_MOST;
  const size_t parts = row / cases > shortest ? row / cases : shortest;
  if (parts > 1) return (row + parts - 1) / parts;
  return at_most((cases + row - 1) / row, ZP_CHUNK_MOST / row) * row;
}

/* A small sweep has about 8 chunks, so that as many processors have work; a large one has longer chunks, of about 32
 * cases or more, because the first case of a chunk starts from one farther away and takes as long as several others.
 */
size_t zp_case_chunk(const ZpScenario *scenario) {
  enum { CHUNKS_OF_FEW = 8, LONGEST_OF_FEW = 16, CHUNKS_OF_MANY = 32 };
  const size_t cases = zp_scenario_count(scenario);
  if (!zp_study_follows(zp_scenario_study(scenario)) || cases < CHUNKS_OF_FEW) return 1;
  const size_t of_few = at_most(cases / CHUNKS_OF_FEW, LONGEST_OF_FEW);
  const size_t of_many = at_most(cases / CHUNKS_OF_MANY, ZP_CHUNK_MOST);
  return in_rows(scenario, of_few > of_many ? of_few : of_many);
}

/* Cases from one to the next along list `axis`, the fastest of those in which case `index` is not the first, or 1 along
 * samples. 0: it is the first in all of them. */
static size_t apart_of(const ZpScenario *scenario, size_t index) {
  size_t axes, length;
  const int *axis = zp_scenario_axes(scenario, &axes);
  const ZpDesign *design = zp_scenario_design(scenario);
  size_t apart = design ? zp_design_samples(design) : 1;
  if (index % apart > 0) return 1;
  while (axes-- > 0) {
    zp_scenario_axis(scenario, axis[axes], &length);
    const size_t cases = apart * length; /* of the list once */
    if (index % cases >= apart) return apart;
    apart = cases;
  }
  return 0;
}

size_t zp_case_neighbour(const ZpScenario *scenario, size_t index) {
  if (!zp_study_follows(zp_scenario_study(scenario))) return index;
  const size_t apart = apart_of(scenario, index), chunk = zp_case_chunk(scenario), block = ZP_BLOCK_CHUNKS * chunk;
  const size_t before = index - apart, in_chunk = index % chunk;
  if (in_chunk > 0) return apart <= in_chunk ? before : index - in_chunk;
  return before / block == index / block ? before / chunk * chunk : index;
}

void zp_case_last(const ZpScenario *scenario, size_t from, size_t to, size_t *last) {
  for (size_t i = from; i < to; i++) {
    const size_t neighbour = zp_case_neighbour(scenario, i);
    last[i - from] = i;
    if (neighbour >= from) last[neighbour - from] = i;
  }
}

static ZpStatus run(const ZpScenario *scenario, const ZpActuatorDef *def, const ZpResult *neighbour,
                    const ZpHooks *hooks, ZpResult **result, ZpError *err) {
  ZpStudy study = zp_scenario_study(scenario);
  const ZpStudyInput input = {.neighbour = neighbour};
  if (neighbour && neighbour->limits)
    return zp_base_note(zp_study_run_limited(study, def, &input, hooks, result, err), def, result, err);
  return zp_data_study_run(study, def, hooks, result, err);
}

ZpStatus zp_case_run(const ZpScenario *scenario, size_t index, const ZpResult *neighbour, const ZpHooks *hooks,
                     ZpResult **result, ZpError *err) {
  ZpActuatorDef def = {0};
  ZpStatus status = zp_scenario_given(scenario, index, &def, err); /* the study checks it */
  if (status == ZP_OK) status = run(scenario, &def, neighbour, hooks, result, err);
  zp_def_clear(&def);
  if (status == ZP_OK && zp_scenario_count(scenario) > 1) keep_the_series(*result);
  return status;
}

ZpResult *zp_case_impossible(ZpStudy study, const ZpError *why) {
  ZpResult *result = zp_result_create(study);
  if (!result) return NULL;
  result->outcome = ZP_BAD_ARGUMENT;
  snprintf(result->message, sizeof result->message, "%.255s", why->message);
  return result;
}

ZpStatus zp_case_run_or_say(const ZpScenario *scenario, size_t index, const ZpResult *neighbour, const ZpHooks *hooks,
                            ZpResult **result, ZpError *err) {
  ZpError why;
  ZpStatus status = zp_case_run(scenario, index, neighbour, hooks, result, &why);
  if (status == ZP_OK) return ZP_OK;
  if (status != ZP_BAD_INPUT) return zp_fail(err, status, "%s", why.message);
  *result = zp_case_impossible(zp_scenario_study(scenario), &why);
  return *result ? ZP_OK : zp_fail_memory(err);
}

/* The states from which no case of this chunk starts after this one are freed; from the first case of a chunk those of
 * others start. */
static void forget_states(const ZpBatch *batch, size_t index) {
  const size_t chunk = zp_case_chunk(batch->scenario), from = index / chunk * chunk;
  size_t last[ZP_CHUNK_MOST] = {0};
  zp_case_last(batch->scenario, from, at_most(from + chunk, batch->count), last);
  for (size_t i = from + 1; i <= index; i++)
    if (last[i - from] <= index) zp_result_forget_states(batch->result[i]);
}

ZpStatus zp_batch_next(ZpBatch *batch, const ZpHooks *hooks, ZpError *err) {
  const size_t index = batch->done, from = zp_case_neighbour(batch->scenario, index);
  ZpResult *result;
  ZpStatus status = need_room(batch, err);
  if (status == ZP_OK)
    status = zp_case_run(batch->scenario, index, from < index ? batch->result[from] : NULL, hooks, &result, err);
  if (status != ZP_OK) return status;
  batch->result[batch->done++] = result;
  forget_states(batch, index);
  batch->numbers += zp_result_numbers(result);
  batch->interrupted = result->outcome == ZP_INTERRUPTED;
  return ZP_OK;
}

bool zp_batch_good(const ZpBatch *batch) {
  for (size_t i = 0; i < batch->done; i++)
    if (!zp_outcome_good(batch->result[i]->outcome)) return false;
  return true;
}
