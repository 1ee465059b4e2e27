/* Parts of a result are taken away. Both libraries have this file. */
#include "base/memory.h"
#include "study/result.h"

const char *const zp_further_name[ZP_FURTHER] = {
    [ZP_FURTHER_LIKELIHOOD] = "likelihood", [ZP_FURTHER_REGIONS] = "regions"};

void zp_result_forget_further(ZpResult *result) {
  for (int k = 0; k < ZP_FURTHER; k++) {
    zp_table_destroy(result->further[k]);
    result->further[k] = NULL;
  }
}

void zp_result_forget_notes(ZpResult *result) {
  while (result->notes > 0)
    zp_free(result->note[--result->notes]);
  result->incomplete = false;
}

void zp_result_clear(ZpResult *result) {
  zp_table_destroy(result->series);
  result->series = NULL;
  result->scalars = result->sensitivities = 0;
  for (ZpName *next; result->names; result->names = next) {
    next = result->names->next;
    zp_free(result->names);
  }
  zp_result_forget_notes(result);
}
