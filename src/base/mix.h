/* Numbers that look random, the same on every machine. */
#ifndef ZP_BASE_MIX_H
#define ZP_BASE_MIX_H

#include <stdint.h>

/* A number that looks random, of 64 bits: the mixer of Steele, Lea and Flood (2014), "splitmix64". */
static inline uint64_t zp_mix(uint64_t x) {
  x += UINT64_C(0x9e3779b97f4a7c15);
  x = (x ^ x >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
  x = (x ^ x >> 27) * UINT64_C(0x94d049bb133111eb);
  return x ^ x >> 31;
}

#endif
