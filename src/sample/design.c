#include "sample/design.h"

#include "base/mix.h"
#include "sample/sobol.h"

size_t zp_design_blocks(const ZpDesign *design) {
  return design->indices ? (size_t)design->dimensions + ZP_BLOCK_FIRST : 1;
}

size_t zp_design_samples(const ZpDesign *design) {
  return design->count * zp_design_blocks(design);
}

int zp_design_most(const ZpDesign *design) {
  return design->indices ? ZP_SOBOL_DIMENSIONS / 2 : ZP_SOBOL_DIMENSIONS;
}

/* A number for a column of the design, and for one of its points, that has nothing to do with any other. */
static uint64_t column_key(const ZpDesign *design, int column) {
  return zp_mix(zp_mix(design->seed) + (uint64_t)column);
}

static double share_of(uint32_t x) {
  return ((double)x + 0.5) / 4294967296.0;
}

/* Rounds that can be undone, over numbers of `bits` bits. */
static uint64_t shuffle_bits(uint64_t x, int bits, uint64_t key) {
  enum { ROUNDS = 4 };
  const uint64_t mask = ((uint64_t)1 << bits) - 1;
  for (int round = 0; round < ROUNDS; round++) {
    key = zp_mix(key);
    x = (x * (key | 1) + (key >> 32)) & mask;
    x ^= x >> (bits / 2 + 1);
  }
  return x;
}

/* Place of `index` in a permutation of 0 .. count - 1: numbers of a few bits, without those that are too large. */
static uint64_t permuted(uint64_t index, uint64_t count, uint64_t key) {
  int bits = 1;
  while (count > (uint64_t)1 << bits)
    bits++;
  do
    index = shuffle_bits(index, bits, key);
  while (index >= count);
  return index;
}

/* One point in each of `count` equal intervals of each column. */
static double latin_share(const ZpDesign *design, size_t point, int column) {
  const uint64_t key = column_key(design, column), place = permuted(point, design->count, key);
  return ((double)place + share_of((uint32_t)(zp_mix(key + 1 + point) >> 32))) / (double)design->count;
}

static double point_share(const ZpDesign *design, size_t point, int column) {
  const uint64_t key = column_key(design, column);
  if (design->method == ZP_SAMPLING_LATIN_HYPERCUBE) return latin_share(design, point, column);
  if (design->method == ZP_SAMPLING_RANDOM) return share_of((uint32_t)(zp_mix(key + point) >> 32));
  return share_of(zp_scramble(zp_sobol((uint32_t)point, column), (uint32_t)key));
}

double zp_design_share(const ZpDesign *design, size_t sample, int dimension) {
  const size_t blocks = zp_design_blocks(design), block = sample % blocks;
  const bool of_B = design->indices && (block == ZP_BLOCK_B || block == ZP_BLOCK_FIRST + (size_t)dimension);
  return point_share(design, sample / blocks, of_B ? design->dimensions + dimension : dimension);
}
