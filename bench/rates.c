/* Do derivatives of runs in time agree with differences of runs? Random runs, drawn from a seed.
 *
 *   rates [COUNT [SEED [TOLERANCE [SERIES]]]]
 *
 * Each number that actuate differentiates by one random key, at the default tolerance, beside differences of runs with
 * TOLERANCE (1e-7) and keys 0.1 % to each side, and 0.01 % if one of them does not agree to 1 %. They agree if they
 * differ by at most 1 %, or by three times what the two differences differ. Every other derivative is printed, with a
 * command that repeats it. Status 1 if there is one. Derivatives without a difference, whose number some run lacks,
 * count apart. SERIES (1): of so many members in series, the second one thinner or thicker; half of the keys are its
 * thickness.
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

/* => the key of the derivatives. */
static int join(int series, uint64_t *state, ZpActuatorDef *def, int key) {
  if (series == 1) return key;
  def->stack.series = series;
  const int thickness = zp_key_find("member_2.ribbon.thickness");
  zp_def_set(def, thickness, def->ribbon.thickness * log_uniform(state, 0.7, 1.4), NULL);
  return draw(state) < 0.5 ? thickness : key;
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

/* Runs with keys to both sides; those of a width after which none is needed are NULL. */
typedef struct Reference {
  ZpResult *at[WIDTHS][SIDES];
  double step[WIDTHS];
} Reference;

static void forget(Reference *r) {
  for (int w = 0; w < WIDTHS; w++)
    for (int side = 0; side < SIDES; side++)
      zp_result_destroy(r->at[w][side]);
}

static bool refer(ZpActuatorDef def, int key, double tolerance, int w, Reference *r) {
  static const double width[WIDTHS] = {1e-3, 1e-4};
  double value = zp_def_get(&def, key);
  bool done = true;
  def.sensitivity.by[0] = 0;
  def.solver.tolerance = tolerance;
  r->step[w] = width[w] * value;
  for (int side = 0; side < SIDES; side++) {
    zp_def_set(&def, key, value + (side ? 1 : -1) * r->step[w], NULL);
    done &= (r->at[w][side] = run(&def)) != NULL;
  }
  return done;
}

/* Some numbers are in the summary only beside their derivatives; the last row has them. */
static double number_of(const ZpResult *result, const char *name) {
  double number = result ? zp_result_get(result, name) : (double)NAN;
  bool listed = !result || isfinite(number);
  return listed ? number : zp_table_get(result->series, result->series->rows - 1, name);
}

/* NAN: the runs are not there, or lack the number. */
static double quotient(const Reference *r, int w, const char *output) {
  return (number_of(r->at[w][1], output) - number_of(r->at[w][0], output)) / (2 * r->step[w]);
}

typedef struct Count {
  int agree, disagree, null, alone;
} Count;

/* Rounding of the number over the key, and of positions, 1e-17 m, over the step of the key. */
static double rounding(const char *output, double number, double key) {
  size_t length = strlen(output);
  bool is_length = length > 2 && strcmp(output + length - 2, "_m") == 0;
  return fmax(1e-7 * fabs(number), is_length ? 1e-10 : 0) / fabs(key);
}

static double off(const ZpSensitivity *s, const Reference *r) {
  return fmin(fabs(s->value - quotient(r, 0, s->output)), fabs(s->value - quotient(r, 1, s->output)));
}

/* To 1 %, or to three times the scatter of both differences? True also where there is none. */
static bool agrees(const ZpSensitivity *s, double number, const Reference *r, double key) {
  double wide = quotient(r, 0, s->output), narrow = quotient(r, 1, s->output), scatter = 3 * fabs(wide - narrow);
  double allowed = fmax(0.01 * fabs(isnan(narrow) ? wide : narrow), rounding(s->output, number, key));
  return isnan(s->value) || !isfinite(wide) || off(s, r) <= fmax(allowed, scatter);
}

static bool all_agree(const ZpResult *result, const Reference *r, double key) {
  for (size_t i = 0; i < result->sensitivities; i++) {
    const ZpSensitivity *s = &result->sensitivity[i];
    if (!agrees(s, zp_result_get(result, s->output), r, key)) return false;
  }
  return true;
}

static bool count_one(const ZpSensitivity *s, double number, const Reference *r, double key, Count *count) {
  double wide = quotient(r, 0, s->output);
  bool agree = agrees(s, number, r, key);
  if (isnan(s->value))
    count->null += isfinite(number);
  else if (!isfinite(wide))
    count->alone++;
  else
    *(agree ? &count->agree : &count->disagree) += 1;
  if (!agree)
    printf("  %s: %.6g, differences %.6g and %.6g, scale %.3g\n", s->output, s->value, wide, quotient(r, 1, s->output),
           number / key);
  return agree;
}

static bool has_any(const ZpResult *result) {
  for (size_t i = 0; i < result->sensitivities; i++)
    if (!isnan(result->sensitivity[i].value)) return true;
  return false;
}

/* One run; false if a derivative disagrees. */
static bool check(uint64_t seed, double tolerance, int series, Count *count) {
  uint64_t state = seed;
  ZpActuatorDef def = run_of(&state);
  int key = join(series, &state, &def, key_of(&def, &state));
  double value = zp_def_get(&def, key);
  Reference reference = {.step = {1, 1}};
  snprintf(def.sensitivity.by, sizeof def.sensitivity.by, "%s", zp_key_name(key, (char[ZP_KEY_NAME_SIZE]){0}));
  ZpResult *result = run(&def);
  bool agree = true, compared = result && has_any(result);
  if (compared && refer(def, key, tolerance, 0, &reference) && !all_agree(result, &reference, value))
    refer(def, key, tolerance, 1, &reference);
  for (size_t i = 0; result && i < result->sensitivities; i++) {
    const ZpSensitivity *s = &result->sensitivity[i];
    agree &= count_one(s, zp_result_get(result, s->output), &reference, value, count);
  }
  forget(&reference);
  if (!agree) print_run(&def);
  zp_result_destroy(result);
  return agree;
}

int main(int argc, char **argv) {
  setvbuf(stdout, NULL, _IOLBF, 0);
  int runs = argc > 1 ? atoi(argv[1]) : 200, failed = 0;
  uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
  double tolerance = argc > 3 ? strtod(argv[3], NULL) : 1e-7;
  int series = argc > 4 ? atoi(argv[4]) : 1;
  Count count = {0};
  for (int k = 0; k < runs; k++)
    failed += !check(seed + (uint64_t)k, tolerance, series, &count);
  printf("%d derivatives agree, %d do not, in %d of %d runs; %d are null, %d without a difference\n", count.agree,
         count.disagree, failed, runs, count.null, count.alone);
  return failed > 0;
}
