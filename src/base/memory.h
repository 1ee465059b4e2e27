/* Memory of the core: every allocation of it goes through here, so that tests can make any one fail. */
#ifndef ZP_BASE_MEMORY_H
#define ZP_BASE_MEMORY_H

#include <stddef.h>

enum { ZP_ALIGNMENT = 64 }; /* bytes: a cache line, and the widest vector */

/* Zeroed memory aligned to ZP_ALIGNMENT, or NULL. count * size must not overflow: then NULL, too. */
void *zp_calloc(size_t count, size_t size);
void zp_free(void *memory);

/* One block from which arrays are cut, so that a struct of arrays costs one allocation. Use twice: first
 * with base NULL to add up the size, then with the block to hand out the pointers. */
typedef struct ZpArena {
  char *base;
  size_t used;
} ZpArena;

/* Next array of `count` doubles, aligned; NULL while adding up. The same of items of `size` bytes, whatever a pointer
 * takes. */
double *zp_arena_take(ZpArena *arena, size_t count);
void *zp_arena_take_of(ZpArena *arena, size_t count, size_t size);

#endif
