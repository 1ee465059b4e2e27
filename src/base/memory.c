#include "base/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* A larger block is taken, whose address stands in front of the aligned place. C99 and Windows have no aligned_alloc,
 * and that of glibc takes five times as long as its malloc. */
static void *allocate(size_t bytes) {
  char *block = malloc(bytes + ZP_ALIGNMENT);
  if (!block) return NULL;
  char *memory = block + (ZP_ALIGNMENT - (uintptr_t)block % ZP_ALIGNMENT);
  memcpy(memory - sizeof block, &block, sizeof block);
  return memory;
}

static void *block_of(void *memory) {
  char *block = NULL;
  if (memory) memcpy(&block, (char *)memory - sizeof block, sizeof block);
  return block;
}

void *zp_calloc(size_t count, size_t size) {
  if (size && count > (SIZE_MAX - (size_t)2 * ZP_ALIGNMENT) / size) return NULL;
  size_t bytes = (count * size + ZP_ALIGNMENT - 1) / ZP_ALIGNMENT * ZP_ALIGNMENT;
  if (bytes == 0) bytes = ZP_ALIGNMENT;
  void *memory = allocate(bytes);
  if (memory) memset(memory, 0, bytes);
  return memory;
}

void zp_free(void *memory) {
  free(block_of(memory));
}

void *zp_arena_take_of(ZpArena *arena, size_t count, size_t size) {
  size_t bytes = (count * size + ZP_ALIGNMENT - 1) / ZP_ALIGNMENT * ZP_ALIGNMENT;
  void *array = arena->base ? arena->base + arena->used : NULL;
  arena->used += bytes + ZP_ALIGNMENT;
  return array;
}

double *zp_arena_take(ZpArena *arena, size_t count) {
  return zp_arena_take_of(arena, count, sizeof(double));
}
