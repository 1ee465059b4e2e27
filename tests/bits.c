/* Prints numbers of the core as the bits that they are, for tests/bits.sh to compare between compilers and
 * optimisations: runs on both surfaces and of the one ribbon, single evaluations of the kernels on states
 * that no run would choose, a matrix factored. Small, because -O0 is slow. */
#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/zipact.h>

#include "math/elementary.h"
#include "math/skyline.h"
#include "study/result.h"
#include "system/system.h"

/* A NAN has many bit patterns, all of which mean the same. */
static void put(double value) {
  uint64_t bits;
  if (isnan(value)) value = NAN;
  memcpy(&bits, &value, sizeof bits);
  if (isnan(value))
    printf(" nan");
  else
    printf(" %016" PRIx64, bits);
}

static void put_array(const char *name, const double *value, size_t count) {
  printf("%s", name);
  for (size_t i = 0; i < count; i++)
    put(value[i]);
  printf("\n");
}

static void fail(const char *name, const ZpError *err) {
  printf("%s: %s\n", name, err->message);
  exit(1);
}

/* Table, last shape and summary of a study. */
static void print_study(const char *name, ZpStudy study, const ZpActuatorDef *def) {
  ZpResult *result;
  ZpError err;
  if (zp_study_run(study, def, NULL, NULL, &result, &err) != ZP_OK) fail(name, &err);
  printf("%s: %s, %s\n", name, zp_outcome_name(result->outcome), result->message);
  for (size_t i = 0; i < result->scalars; i++)
    put_array(result->scalar[i].name, &result->scalar[i].value, 1);
  for (size_t row = 0; row < result->series->rows; row++)
    put_array("row", result->series->value + row * result->series->columns, result->series->columns);
  const ZpShapes *shapes = result->shapes;
  for (size_t frame = 0; frame < shapes->frames; frame++)
    put_array("frame", shapes->value + frame * shapes->frame_size, shapes->frame_size);
  zp_result_destroy(result);
}

/* The default actuator, coarser, until some pairs have met. */
static ZpActuatorDef default_def(void) {
  ZpActuatorDef def = zp_actuator_def_default();
  def.mesh.nodes = 7;
  def.solver.tolerance = 1e-1;
  def.solver.end_time = 30e-3;
  def.output.samples = 20;
  def.output.shapes = 4;
  return def;
}

static ZpActuatorDef preset_def(ZpPreset preset) {
  ZpAssignment list[] = {{zp_key_find("preset"), preset},
                         {zp_key_find("mesh.nodes"), 21},
                         {zp_key_find("solver.tolerance"), 1e-1},
                         {zp_key_find("output.samples"), 20},
                         {zp_key_find("output.shapes"), 4}};
  ZpActuatorDef def = {0};
  ZpError err;
  if (zp_def_resolve(&def, list, sizeof list / sizeof list[0], &err) != ZP_OK) fail("preset", &err);
  def.solver.end_time = 4e-3;
  return def;
}

static void print_studies(void) {
  ZpActuatorDef def = default_def();
  print_study("default", ZP_STUDY_ACTUATE, &def);
  def.drive.waveform = ZP_WAVEFORM_SINE;
  def.drive.frequency = 77;
  print_study("sine", ZP_STUDY_ACTUATE, &def);
  def = default_def();
  def.liquid.model = ZP_LIQUID_SUBMERGED;
  print_study("bath", ZP_STUDY_ACTUATE, &def);
  def = default_def();
  def.initial.state = ZP_INITIAL_STRAIGHT;
  def.drive.voltage = 0;
  print_study("straight", ZP_STUDY_ACTUATE, &def);
  def = default_def();
  def.solver.integrator = ZP_INTEGRATOR_EXPLICIT;
  print_study("explicit", ZP_STUDY_ACTUATE, &def);
  def.contact.model = ZP_CONTACT_SEQUENTIAL;
  print_study("sequential", ZP_STUDY_ACTUATE, &def);
  def = default_def();
  def.actuator.kind = ZP_KIND_RIBBON;
  def.damping.drag = 0.5;
  print_study("ribbon", ZP_STUDY_ACTUATE, &def);
  def = preset_def(ZP_PRESET_PAPER_CODE);
  print_study("paper-code", ZP_STUDY_ACTUATE, &def);
  def.electro.refresh_period = 0;
  print_study("paper-code, field in every step", ZP_STUDY_ACTUATE, &def);
}

/* Without motion: naturally curved, the solved field, modes. */
static void print_rests(void) {
  static const ZpStudy study[] = {ZP_STUDY_STATIONARY, ZP_STUDY_EQUILIBRIUM, ZP_STUDY_ISOMETRIC, ZP_STUDY_MODES,
                                  ZP_STUDY_PROFILE};
  for (size_t k = 0; k < sizeof study / sizeof study[0]; k++) {
    ZpActuatorDef def = zp_actuator_def_default();
    def.mesh.nodes = 9;
    def.segment_K[2].curvature = 5;
    print_study("at rest", study[k], &def);
  }
}

/* Doubles between -1 and 1 from a linear congruential generator: the same everywhere. */
static double next_random(uint64_t *seed) {
  *seed = *seed * 6364136223846793005u + 1442695040888963407u;
  return (double)(int64_t)(*seed >> 11) / 4503599627370496.0 - 1;
}

/* Straight ribbons, parted and shaken: gaps of 0 to 2 mm, links that stretch and turn. */
static void shake(const ZpModel *model, ZpState *state, uint64_t *seed) {
  double *q = zp_state_q(model, state), *v = zp_state_v(model, state);
  memset(state->data, 0, 5 * model->stride * sizeof(double));
  for (size_t j = model->count; j < model->stride; j++)
    q[j] = (double)(j / model->s) * model->l; /* places beyond the ribbon lie on it prolonged: actuator/model.h */
  for (size_t j = 0; j < model->count; j++) {
    size_t i = j / model->s;
    double below = model->s == 2 && j % 2 ? 2e-3 * (double)i / (double)model->nodes : 0;
    q[j] = (double)i * model->l * (1 + 1e-4 * next_random(seed));
    q[model->stride + j] = -below + 1e-5 * next_random(seed);
    v[j] = next_random(seed);
    v[model->stride + j] = next_random(seed);
  }
}

static void print_accelerations(const char *name, const ZpActuatorDef *def, int states) {
  ZpModel *model;
  ZpError err;
  if (zp_model_create(def, &model, &err) != ZP_OK) fail(name, &err);
  ZpState *state = calloc(1, zp_state_size(model));
  double *a = calloc(2 * model->stride, sizeof *a);
  ZpEval eval;
  uint64_t seed = 1;
  if (!state || !a || !zp_system_create(model, true, &eval)) exit(1);
  for (int k = 0; k < states; k++) {
    shake(model, state, &seed);
    state->U = 1e3 * (k % 12);
    state->zip.front = (size_t)(k % 3);
    state->refreshed = NAN;
    ZpSpan now = zp_span_of(model, state, zp_state_q(model, state), zp_state_v(model, state));
    zp_system_accelerations(model, &now, &model->masses, &eval, a);
    put_array(name, a, model->count);
    put_array(name, a + model->stride, model->count);
    double ledger[ZP_MOST_ROWS] = {0};
    zp_system_now(model, state, &eval, ledger);
    put_array("energies", ledger, model->ledger.rows);
    ZpElectric electric = zp_system_electric_now(model, state, state->U, &eval);
    put_array("electric", (double[]){electric.force, electric.charge, electric.potential, electric.capacitance}, 4);
    ZpStepBounds bounds = zp_eval_step_bounds(model, state, &eval);
    put_array("bounds", (double[]){bounds.drag, bounds.axial, bounds.shear}, 3);
  }
  zp_system_destroy(&eval);
  free(a);
  free(state);
  zp_model_destroy(model);
}

static void print_kernels(void) {
  static const int sizes[] = {4, 5, 8, 9, 21, 61, 130};
  for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; k++) {
    ZpActuatorDef def = zp_actuator_def_default();
    def.mesh.nodes = sizes[k];
    def.damping.drag = 0.1;
    print_accelerations("polyline", &def, 12);
    def.electro.breakdown_cap = false;
    print_accelerations("polyline, no cap", &def, 12);
    def.electro.surface = ZP_SURFACE_BEZIER;
    def.contact.model = ZP_CONTACT_SEQUENTIAL;
    def.solver.integrator = ZP_INTEGRATOR_EXPLICIT;
    print_accelerations("bezier", &def, 12);
    def.actuator.kind = ZP_KIND_RIBBON;
    print_accelerations("ribbon", &def, 12);
  }
}

/* With the law of the lateral edges, which takes a field solved. */
static void print_edges(void) {
  ZpActuatorDef def = zp_actuator_def_default();
  def.mesh.nodes = 21;
  def.electro.edges = true;
  print_accelerations("edges", &def, 12);
}

static void print_elementary(void) {
  uint64_t seed = 1;
  for (int k = 0; k < 100; k++) {
    double x = next_random(&seed), scale = k % 2 ? 1e-6 : 1e6;
    put_array("cube root, tangent", (double[]){zp_cube_root(scale * fabs(x)), zp_tangent(1.5 * x)}, 2);
  }
}

/* A ragged skyline, its factor and solutions. */
static void print_skyline(void) {
  enum { N = 75 };
  size_t first[N];
  double b[N];
  uint64_t seed = 1;
  for (size_t i = 0; i < N; i++)
    first[i] = (size_t)((double)i * (0.5 + 0.5 * next_random(&seed)));
  ZpSkyline s;
  if (!zp_skyline_create(&s, N, first)) exit(1);
  for (size_t i = 0; i < N; i++) {
    for (size_t j = first[i]; j < i; j++)
      *zp_skyline_at(&s, i, j) = next_random(&seed);
    *zp_skyline_at(&s, i, i) = N;
    b[i] = next_random(&seed);
  }
  if (!zp_skyline_factor(&s)) exit(1);
  zp_skyline_solve(&s, b);
  put_array("skyline", s.a, s.tiles * ZP_LANES * ZP_LANES);
  put_array("skyline, solved", b, N);
  zp_skyline_destroy(&s);
}

int main(void) {
  print_kernels();
  print_edges();
  print_elementary();
  print_skyline();
  print_studies();
  print_rests();
  return 0;
}
