#include "base/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

void *zp_calloc(size_t count, size_t size) {
  if (size && count > (SIZE_MAX - ZP_ALIGNMENT) / size) return NULL;
  size_t bytes = (count * size + ZP_ALIGNMENT - 1) / ZP_ALIGNMENT * ZP_ALIGNMENT;
  if (bytes == 0) bytes = ZP_ALIGNMENT;
  void *memory = aligned_alloc(ZP_ALIGNMENT, bytes);
  if (memory) memset(memory, 0, bytes);
  return memory;
}

void zp_free(void *memory) {
  free(memory);
}

double *zp_carve(ZpCarver *carver, size_t count) {
  size_t per_line = ZP_ALIGNMENT / sizeof(double);
  size_t bytes = (count + per_line - 1) / per_line * ZP_ALIGNMENT;
  double *array = carver->base ? (double *)(void *)(carver->base + carver->used) : NULL;
  carver->used += bytes + ZP_ALIGNMENT;
  return array;
}
