/* Random designs of the programs here: numbers drawn from a seed, and a design as options of the command. */
#ifndef ZP_BENCH_DRAW_H
#define ZP_BENCH_DRAW_H

#include <zipact/zipact.h>

#include "def/def.h"
#include "study/result.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>

/* splitmix64: the same numbers on every machine. => uniform in [0, 1) */
static inline double draw(uint64_t *state) {
  uint64_t z = *state += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static inline double log_uniform(uint64_t *state, double from, double to) {
  return from * pow(to / from, draw(state));
}

/* Options of the command; keys that are as by default are left out. */
static inline void print_design(const ZpActuatorDef *def) {
  const ZpActuatorDef plain = zp_actuator_def_default();
  for (int k = zp_def_next_key(def, -1); k >= 0; k = zp_def_next_key(def, k)) {
    const ZpKey *key = zp_key(k);
    char name[ZP_KEY_NAME_SIZE];
    double value = zp_def_get(def, k);
    if (isnan(value) || value == zp_def_get(&plain, k)) continue;
    if (key->type == ZP_KEY_BOOL)
      printf(" --set %s=%s", zp_key_name(k, name), value == 0 ? "false" : "true");
    else if (key->type == ZP_KEY_ENUM)
      printf(" --set %s=%s", zp_key_name(k, name), key->choices[(int)value].word);
    else
      printf(" --set %s=%.17g", zp_key_name(k, name), value);
  }
  printf("\n");
}

#endif
