/* Noise that is the same everywhere: no library's random numbers, no function that libraries round differently. */
#ifndef ZP_DRIVE_NOISE_H
#define ZP_DRIVE_NOISE_H

#include <stdint.h>

#include "base/mix.h"

/* The next of a sequence of nearly normal numbers of mean 0 and variance 1: sums of 12 even ones. *seed goes on. */
static inline double zp_unit_noise(uint64_t *seed) {
  enum { TERMS = 12 };
  double sum = 0;
  for (int k = 0; k < TERMS; k++) {
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    sum += (double)(*seed >> 11) * 0x1p-53;
  }
  return sum - 0.5 * TERMS;
}

/* Number `index` of the sequence that belongs to a seed, without those before it. */
static inline double zp_noise_at(uint64_t seed, uint64_t index) {
  uint64_t start = zp_mix(seed * UINT64_C(0x9e3779b97f4a7c15) + index);
  return zp_unit_noise(&start);
}

#endif
