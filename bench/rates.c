/* Do derivatives of runs in time agree with differences of runs? Random runs, drawn from a seed.
 *
 *   rates [COUNT [SEED [TOLERANCE]]]   each number that actuate differentiates by one random key, at the default
 *                                      tolerance, beside differences of runs with TOLERANCE (1e-7) and keys 0.1 % and
 *                                      0.01 % to each side. They agree if they differ by at most 1 %, or by three times
 *                                      what the two differences differ. Every other derivative is printed, with a
 *                                      command that repeats it. Status 1 if there is one
 */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "draw.h"

static int one_of(uint64_t *state, int count) {
  return (int)(count * draw(state));
}

static ZpActuatorDef run_of(uint64_t *state) {
  static const ZpLiquidModel liquids[] = {ZP_LIQUID_NONE, ZP_LIQUID_SUBMERGED, ZP_LIQUID_SUBMERGED, ZP_LIQUID_BEAD};
  static const ZpWhen stops[] = {ZP_WHEN_TRUE, ZP_WHEN_AUTO, ZP_WHEN_FALSE};
  ZpActuatorDef def = zp_actuator_def_default();
  def.mesh.nodes = 21;
  def.output.errors = false;
  def.output.samples = 10;
  def.liquid.model = liquids[one_of(state, 4)];
  def.ribbon.thickness = log_uniform(state, 30e-6, 150e-6);
  def.ribbon.length = log_uniform(state, 60e-3, 150e-3);
  def.insulator.thickness = log_uniform(state, 50e-6, 200e-6);
  def.load.mass = log_uniform(state, 2e-3, 20e-3);
  def.drive.voltage = log_uniform(state, 3e3, 12e3);
  def.solver.stop_when_zipped = stops[one_of(state, 3)];
  def.solver.end_time = log_uniform(state, 0.02, 0.2);
  if (draw(state) < 0.3) {
    def.drive.waveform = draw(state) < 0.5 ? ZP_WAVEFORM_RAMP : ZP_WAVEFORM_SINE;
    if (def.drive.waveform == ZP_WAVEFORM_RAMP) def.drive.rise_time = log_uniform(state, 2e-3, 50e-3);
    if (def.drive.waveform == ZP_WAVEFORM_SINE) def.drive.frequency = log_uniform(state, 2, 20);
  }
  if (draw(state) < 0.4) {
    def.source.model = ZP_SOURCE_AMPLIFIER;
    def.source.resistance = log_uniform(state, 1e6, 1e8);
    def.source.capacitance = log_uniform(state, 10e-12, 1e-9);
  }
  return def;
}

static int key_of(const ZpActuatorDef *def, uint64_t *state) {
  static const char *const always[] = {"ribbon.thickness",       "ribbon.length", "ribbon.young_modulus",
                                       "insulator.thickness",    "drive.voltage", "load.mass",
                                       "insulator.permittivity", "gravity"};
  enum { ALWAYS = sizeof always / sizeof always[0] };
  int k = one_of(state, ALWAYS + 2);
  if (k < ALWAYS) return zp_key_find(always[k]);
  if (k == ALWAYS && def->source.model == ZP_SOURCE_AMPLIFIER) return zp_key_find("source.resistance");
  return zp_key_find(def->liquid.model == ZP_LIQUID_NONE ? "ribbon.density" : "medium.kinematic_viscosity");
}

static void print_run(const ZpActuatorDef *def) {
  printf("  zipact actuate --set sensitivity.by=%s", def->sensitivity.by);
  print_design(def);
}

static ZpResult *run(const ZpActuatorDef *def) {
  ZpError err;
  ZpResult *result;
  if (zp_study_run(ZP_STUDY_ACTUATE, def, NULL, NULL, &result, &err) == ZP_OK) return result;
  printf("  %s\n", err.message);
  return NULL;
}

enum { WIDTHS = 2, SIDES = 2 };

typedef struct Reference {
  ZpResult *at[WIDTHS][SIDES];
  double step[WIDTHS];
} Reference;

static void forget(Reference *r) {
  for (int w = 0; w < WIDTHS; w++)
    for (int side = 0; side < SIDES; side++)
      if (r->at[w][side]) zp_result_destroy(r->at[w][side]);
}

static bool refer(ZpActuatorDef def, int key, double tolerance, Reference *r) {
  static const double width[WIDTHS] = {1e-3, 1e-4};
  double value = zp_def_get(&def, key);
  bool done = true;
  *r = (Reference){.step = {0}};
  def.solver.tolerance = tolerance;
  for (int w = 0; w < WIDTHS; w++)
    for (int side = 0; side < SIDES; side++) {
      r->step[w] = width[w] * value;
      zp_def_set(&def, key, value + (side ? 1 : -1) * r->step[w], NULL);
      done &= (r->at[w][side] = run(&def)) != NULL;
    }
  return done;
}

static double quotient(const Reference *r, int w, const char *output) {
  return (zp_result_get(r->at[w][1], output) - zp_result_get(r->at[w][0], output)) / (2 * r->step[w]);
}

typedef struct Count {
  int agree, disagree, null;
} Count;

static bool compare(const ZpSensitivity *s, double number, const Reference *r, double key, Count *count) {
  double wide = quotient(r, 0, s->output), narrow = quotient(r, 1, s->output), scatter = 3 * fabs(wide - narrow);
  double rounding = 1e-7 * fabs(number / key), off = fmin(fabs(s->value - wide), fabs(s->value - narrow));
  if (isnan(s->value)) {
    count->null += isfinite(number);
    return true;
  }
  if (!isfinite(wide) || !isfinite(narrow) || off <= fmax(fmax(0.01 * fabs(narrow), scatter), rounding)) {
    count->agree++;
    return true;
  }
  count->disagree++;
  printf("  %s: %.6g, differences %.6g and %.6g, scale %.3g\n", s->output, s->value, wide, narrow, number / key);
  return false;
}

/* One run; false if a derivative disagrees. */
static bool check(uint64_t seed, double tolerance, Count *count) {
  uint64_t state = seed;
  ZpActuatorDef def = run_of(&state);
  int key = key_of(&def, &state);
  double value = zp_def_get(&def, key);
  Reference reference;
  ZpActuatorDef plain = def;
  plain.sensitivity.by[0] = 0;
  snprintf(def.sensitivity.by, sizeof def.sensitivity.by, "%s", zp_key(key)->name);
  ZpResult *result = run(&def);
  bool agree = true;
  if (result && refer(plain, key, tolerance, &reference)) {
    for (size_t i = 0; i < result->sensitivities; i++)
      agree &= compare(&result->sensitivity[i], zp_result_get(result, result->sensitivity[i].output), &reference, value,
                       count);
    forget(&reference);
  }
  if (!agree) print_run(&def);
  if (result) zp_result_destroy(result);
  return agree;
}

int main(int argc, char **argv) {
  setvbuf(stdout, NULL, _IOLBF, 0);
  int runs = argc > 1 ? atoi(argv[1]) : 200, failed = 0;
  uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
  double tolerance = argc > 3 ? strtod(argv[3], NULL) : 1e-7;
  Count count = {0, 0, 0};
  for (int k = 0; k < runs; k++)
    failed += !check(seed + (uint64_t)k, tolerance, &count);
  printf("%d derivatives agree, %d do not, in %d of %d runs; %d are null\n", count.agree, count.disagree, failed, runs,
         count.null);
  return failed > 0;
}
