/* The bytes of each result follow those of the one before (io/packed.h). */
#include "campaign/remote.h"

#include <stdlib.h>

#include <zipact/campaign.h>

#include "base/fail.h"
#include "base/pack.h"
#include "fit/case.h"
#include "io/packed.h"

/* Append a result. False if there is no memory. */
static bool put_result(FILE *out, const ZpResult *result) {
  ZpPacked *packed = zp_packed_of(result);
  const bool put = packed && fwrite(packed->byte, 1, packed->size, out) == packed->size;
  free(packed);
  return put;
}

/* Run the cases one after the other and append their results. */
static ZpStatus compute_all(const ZpScenario *scenario, size_t from, size_t to, const ZpHooks *hooks, FILE *out,
                            ZpError *err) {
  ZpResult *before = NULL;
  ZpStatus status = ZP_OK;
  const bool keeps_series = zp_scenario_keeps_series(scenario);
  for (size_t i = from; i < to && status == ZP_OK; i++) {
    ZpResult *result = NULL;
    status = zp_case_run_or_say(scenario, i, before, hooks, &result, err);
    zp_result_destroy(before);
    before = result;
    if (status != ZP_OK) break;
    if (!keeps_series) {
      zp_table_destroy(result->series);
      result->series = NULL;
    }
    if (!put_result(out, result)) status = zp_fail_memory(err);
  }
  zp_result_destroy(before);
  return status;
}

ZpStatus zp_campaign_compute(const ZpScenario *scenario, size_t from, size_t to, const ZpHooks *hooks,
                             unsigned char **byte, size_t *size, ZpError *err) {
  char *results = NULL;
  *byte = NULL;
  FILE *out = open_memstream(&results, size);
  if (!out) return zp_fail_memory(err);
  ZpStatus status = compute_all(scenario, from, to, hooks, out, err);
  if (fclose(out) != 0 && status == ZP_OK) status = zp_fail_memory(err);
  if (status == ZP_OK)
    *byte = (unsigned char *)results;
  else
    free(results);
  return status;
}

bool zp_remote_read(const unsigned char *byte, size_t size, ZpStudy study, size_t count, ZpResult **result) {
  size_t used = 0, read = 0;
  bool good = true;
  while (good && read < count) {
    const size_t names = zp_pack_first(byte + used, size - used),
                 both = names + zp_pack_first(byte + used + names, size - used - names);
    good = zp_result_load(byte + used, both, &result[read], NULL) == ZP_OK;
    read += good;
    used += both;
    good = good && result[read - 1]->study == study;
  }
  if (good && used == size) return true;
  while (read > 0)
    zp_result_destroy(result[--read]);
  return false;
}
