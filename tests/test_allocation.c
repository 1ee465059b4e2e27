/* No memory: every allocation of zipact's own code is made to fail, one after the other, until none is left
 * to fail. Each time the call must say ZP_MACHINE (or do without and give what it gives with memory), leave
 * nothing allocated, leave no half-written file, and work when it is called again. And: a step allocates
 * nothing.
 *
 * The linker sends the allocating calls of the static libraries to the __wrap_ functions below; the
 * link options are listed in tests/CMakeLists.txt. jansson is told to use them, too. Allocations inside
 * other shared libraries (libfyaml, UDUNITS-2, HDF5) are theirs and do not fail here.
 * Check is a static library and allocates in its asserts, so there are none while the ledger watches.
 * What is allocated through the wrappers is kept in a list, so that a leak shows without a sanitizer. */
#include <dirent.h>
#include <locale.h>
#include <stdarg.h>
#include <sys/stat.h>
#include <unistd.h>

#include <jansson.h>

#include <zipact/calibrate.h>
#include <zipact/io.h>

#include "check_util.h"
#include "def/check.h"
#include "math/skyline.h"

/* -- the wrappers ---------------------------------------------------------------------------------- */

enum { MOST_BLOCKS = 65536 };

typedef struct Ledger {
  bool watching; /* count and keep the list */
  long calls;    /* allocations since watching began */
  long failing;  /* number of the one that fails, 0: none */
  long failed;   /* how many have failed */
  size_t blocks; /* alive, of those allocated while watching */
  void *alive[MOST_BLOCKS];
} Ledger;

static Ledger ledger;

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
char *__real_strdup(const char *text);
char *__real_strndup(const char *text, size_t size);
FILE *__real_open_memstream(char **text, size_t *size);
FILE *__real_fopencookie(void *cookie, const char *mode, cookie_io_functions_t functions);
locale_t __real_newlocale(int mask, const char *name, locale_t base);
void __real_free(void *memory);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
char *__wrap_strdup(const char *text);
char *__wrap_strndup(const char *text, size_t size);
int __wrap_asprintf(char **text, const char *format, ...);
FILE *__wrap_open_memstream(char **text, size_t *size);
FILE *__wrap_fopencookie(void *cookie, const char *mode, cookie_io_functions_t functions);
locale_t __wrap_newlocale(int mask, const char *name, locale_t base);
void __wrap_free(void *memory);
int __wrap_fsync(int fd);

static bool fails_now(void) {
  if (!ledger.watching || ++ledger.calls != ledger.failing) return false;
  ledger.failed++;
  return true;
}

static void *enter(void *memory) {
  if (ledger.watching && memory && ledger.blocks < MOST_BLOCKS) ledger.alive[ledger.blocks++] = memory;
  return memory;
}

static void leave(const void *memory) {
  for (size_t i = ledger.blocks; memory && i-- > 0;)
    if (ledger.alive[i] == memory) {
      ledger.alive[i] = ledger.alive[--ledger.blocks];
      return;
    }
}

void *__wrap_malloc(size_t size) {
  return fails_now() ? NULL : enter(__real_malloc(size));
}

void *__wrap_calloc(size_t count, size_t size) {
  return fails_now() ? NULL : enter(__real_calloc(count, size));
}

void *__wrap_realloc(void *old, size_t size) {
  if (fails_now()) return NULL;
  leave(old);
  return enter(__real_realloc(old, size));
}

void *__wrap_aligned_alloc(size_t alignment, size_t size) {
  return fails_now() ? NULL : enter(__real_aligned_alloc(alignment, size));
}

char *__wrap_strdup(const char *text) {
  return fails_now() ? NULL : enter(__real_strdup(text));
}

char *__wrap_strndup(const char *text, size_t size) {
  return fails_now() ? NULL : enter(__real_strndup(text, size));
}

/* A failing asprintf leaves its pointer undefined: here it is made to point to where no one may look. */
int __wrap_asprintf(char **text, const char *format, ...) {
  static char forbidden[1];
  if (fails_now()) {
    *text = forbidden;
    return -1;
  }
  va_list args;
  va_start(args, format);
  int length = vasprintf(text, format, args);
  va_end(args);
  if (length >= 0) enter(*text);
  return length;
}

/* The text of a memory stream is freed by its user; libc allocates it behind our back. */
FILE *__wrap_open_memstream(char **text, size_t *size) {
  return fails_now() ? NULL : __real_open_memstream(text, size);
}

FILE *__wrap_fopencookie(void *cookie, const char *mode, cookie_io_functions_t functions) {
  return fails_now() ? NULL : __real_fopencookie(cookie, mode, functions);
}

locale_t __wrap_newlocale(int mask, const char *name, locale_t base) {
  return fails_now() ? (locale_t)0 : __real_newlocale(mask, name, base);
}

void __wrap_free(void *memory) {
  leave(memory);
  __real_free(memory);
}

/* Thousands of files are written here, none of which needs to reach the disk. */
int __wrap_fsync(int fd) {
  (void)fd;
  return 0;
}

static void watch(long failing) {
  ledger.watching = true;
  ledger.calls = ledger.failed = 0;
  ledger.failing = failing;
  ledger.blocks = 0;
}

static void look_away(void) {
  ledger.watching = false;
  ledger.failing = 0;
}

/* -- the loop ---------------------------------------------------------------------------------------- */

/* A call under test: does its work, frees what it got, and says how it went. *whole is false if it said
 * ZP_OK but gave less than it should. */
typedef ZpStatus (*Call)(ZpError *err, bool *whole);

/* Make the first, second, ... allocation fail until none is left; under sanitizers each seventh after the first dozen.
 * Returns how many there were, or there a few more. Calls that may do without what they did not get have
 * `may_do_without`. */
static long fail_each(const char *name, Call call, bool may_do_without) {
  enum { MANY = 100000 };
  long without = 0, n = 1;
  for (; n < MANY; n += n < 12 ? 1 : FULL_OR(1, 7)) {
    ZpError err = {ZP_OK, ""};
    bool whole = true;
    watch(n);
    ZpStatus status = call(&err, &whole);
    look_away();
    ck_assert_msg(ledger.blocks == 0, "%s, allocation %ld failing: %zu blocks are left", name, n, ledger.blocks);
    ck_assert_msg(whole, "%s, allocation %ld failing: said ZP_OK but gave less than it should", name, n);
    if (ledger.failed == 0) {
      ck_assert_msg(status == ZP_OK, "%s: with all memory: %s", name, err.message);
      break;
    }
    if (status == ZP_OK && may_do_without) {
      without++;
      continue;
    }
    ck_assert_msg(status == ZP_MACHINE, "%s, allocation %ld failing: status %d, \"%s\"", name, n, (int)status,
                  err.message);
    ck_assert_msg(err.status == ZP_MACHINE && *err.message, "%s, allocation %ld failing: no message", name, n);
  }
  ck_assert_int_lt(n, MANY);
  printf("%s: %ld allocations, each failed once; did without %ld\n", name, n - 1, without);
  return n - 1;
}

/* -- the core ---------------------------------------------------------------------------------------- */

/* A run of a few steps. */
static ZpActuatorDef short_def(void) {
  ZpActuatorDef def = zp_actuator_def_default();
  def.mesh.nodes = 5;
  def.drive.voltage = 100;
  def.solver.tolerance = 1e-1;
  def.solver.end_time = 1e-4;
  def.output.samples = 10;
  def.output.shapes = 3;
  return def;
}

static ZpStatus try_model(const ZpActuatorDef *def, const ZpDriveTable *table, ZpError *err, bool *whole) {
  ZpModel *model = NULL;
  ZpStatus status = table ? zp_model_create_driven(def, table, &model, err) : zp_model_create(def, &model, err);
  *whole = (model != NULL) == (status == ZP_OK);
  zp_model_destroy(model);
  return status;
}

static ZpStatus create_model(ZpError *err, bool *whole) {
  ZpActuatorDef def = short_def();
  return try_model(&def, NULL, err, whole);
}

static ZpStatus create_driven_model(ZpError *err, bool *whole) {
  ZpActuatorDef def = short_def();
  def.drive.waveform = ZP_WAVEFORM_TABLE;
  return try_model(&def, &(ZpDriveTable){2, (const double[]){0, 1}, (const double[]){100, 200}}, err, whole);
}

static ZpStatus create_model_with_edges(ZpError *err, bool *whole) {
  ZpActuatorDef def = short_def();
  def.electro.edges = true;
  return try_model(&def, NULL, err, whole);
}

static ZpModel *shared_model; /* made while no one watches */

static ZpStatus create_sim(ZpError *err, bool *whole) {
  ZpSim *sim = NULL;
  ZpStatus status = zp_sim_create(shared_model, NULL, &sim, err);
  *whole = (sim != NULL) == (status == ZP_OK);
  zp_sim_destroy(sim);
  return status;
}

static ZpStatus try_study(ZpStudy study, const ZpActuatorDef *def, ZpError *err, bool *whole) {
  ZpResult *result = NULL;
  const bool by_table = def->drive.waveform == ZP_WAVEFORM_TABLE, goes_on = def->initial.state == ZP_INITIAL_CHECKPOINT;
  ZpStatus status = by_table || goes_on ? zp_data_study_run(study, def, NULL, &result, err)
                                        : zp_study_run(study, def, NULL, NULL, &result, err);
  *whole = (result != NULL) == (status == ZP_OK);
  if (result)
    *whole = result->outcome == (study == ZP_STUDY_ACTUATE ? ZP_REACHED_END : ZP_CONVERGED) && result->series &&
             result->shapes && (study != ZP_STUDY_PROFILE || result->map) &&
             (!by_table || zp_table_get(result->series, 1, "voltage_V") > 0) && (!goes_on || result->checkpoint);
  zp_result_destroy(result);
  return status;
}

static ZpStatus run_study(ZpError *err, bool *whole) {
  ZpActuatorDef def = short_def();
  return try_study(ZP_STUDY_ACTUATE, &def, err, whole);
}

static ZpStatus run_isometric(ZpError *err, bool *whole) {
  ZpActuatorDef def = short_def();
  return try_study(ZP_STUDY_ISOMETRIC, &def, err, whole);
}

static ZpStatus run_profile(ZpError *err, bool *whole) {
  ZpActuatorDef def = short_def();
  def.profile.paper_factor = true;
  return try_study(ZP_STUDY_PROFILE, &def, err, whole);
}

TEST(core_survives_every_failure) {
  ZpActuatorDef def = short_def();
  ck_assert_int_eq(zp_model_create(&def, &shared_model, NULL), ZP_OK);
  /* the counts: a model is a struct and a block, a simulation a struct and at least state and work space */
  ck_assert_int_ge(fail_each("zp_model_create", create_model, false), 2);
  ck_assert_int_ge(fail_each("zp_model_create_driven", create_driven_model, false), 2);
  ck_assert_int_ge(fail_each("zp_model_create with edges", create_model_with_edges, false), 6); /* a field more */
  ck_assert_int_ge(fail_each("zp_sim_create", create_sim, false), 3);
  ck_assert_int_ge(fail_each("zp_study_run", run_study, false), 8);
  ck_assert_int_ge(fail_each("zp_study_run of profile", run_profile, false), 20);
  ck_assert_int_ge(fail_each("study isometric", run_isometric, false), 8);
  zp_model_destroy(shared_model);
}

static ZpStatus create_table(ZpError *err, bool *whole) {
  static const ZpColumn column[] = {{"time_s", "s", ""}};
  ZpTable *table = zp_table_create(column, 1, 4);
  ZpShapes *shapes = zp_shapes_create(2, 4, 4);
  ZpStatus status = table && shapes ? ZP_OK : ZP_MACHINE; /* these two say it with NULL */
  if (status != ZP_OK) *err = (ZpError){ZP_MACHINE, "NULL"};
  *whole = true;
  zp_table_destroy(table);
  zp_shapes_destroy(shapes);
  return status;
}

TEST(tables_survive_every_failure) {
  ck_assert_int_eq(fail_each("zp_table_create, zp_shapes_create", create_table, false), 4);
}

static ZpStatus create_skyline(ZpError *err, bool *whole) {
  static const size_t first[] = {0, 0, 1, 0, 3, 2, 5, 5, 1, 9, 8};
  ZpSkyline s;
  ZpStatus status = zp_skyline_create(&s, sizeof first / sizeof first[0], first) ? ZP_OK : ZP_MACHINE;
  if (status != ZP_OK) *err = (ZpError){ZP_MACHINE, "false"};
  *whole = (s.a && s.block) == (status == ZP_OK);
  if (status == ZP_OK) zp_skyline_destroy(&s);
  return status;
}

TEST(skyline_survives_every_failure) {
  ck_assert_int_eq(fail_each("zp_skyline_create", create_skyline, false), 2);
}

/* -- stepping allocates nothing ---------------------------------------------------------------------- */

/* (def, simulated time, least number of steps that this must take) */
static void assert_no_allocation(const ZpActuatorDef *def, double time, int64_t least_steps) {
  size_t columns;
  const ZpColumn *column = zp_signal_columns(&columns);
  ZpModel *model = model_of(def);
  ZpSim *sim = sim_of(model);
  ZpTable *series = zp_table_create(column, columns, 16); /* full soon: thinning is part of it */
  ZpShapes *shapes = zp_shapes_create(model->s, model->nodes, 4);
  zp_sim_record(sim, series, shapes);
  ZpRunInfo info;
  watch(0);
  zp_sim_run(sim, time, true, NULL, &info);
  double stroke = zp_sim_get(sim, "stroke");
  look_away();
  ck_assert_msg(ledger.calls == 0, "%ld allocations in %lld steps", ledger.calls, (long long)info.steps);
  ck_assert_msg(info.steps >= least_steps, "only %lld steps: %s", (long long)info.steps, info.message);
  ck_assert(isfinite(stroke));
  ck_assert_uint_gt(series->stride, 1);
  zp_table_destroy(series);
  zp_shapes_destroy(shapes);
}

TEST(steps_allocate_nothing) {
  ZpActuatorDef def = short_def();
  def.drive.voltage = 10e3;
  def.solver.end_time = 4e-3;
  def.solver.integrator = ZP_INTEGRATOR_EXPLICIT;
  assert_no_allocation(&def, 4e-3, 1000); /* 2352 steps */
  def.actuator.kind = ZP_KIND_RIBBON;
  def.load.share = 1;
  assert_no_allocation(&def, 4e-3, 1000);
}

static ZpStatus run_explicit(ZpError *err, bool *whole) {
  ZpActuatorDef def = short_def();
  def.solver.integrator = ZP_INTEGRATOR_EXPLICIT;
  def.contact.model = ZP_CONTACT_SEQUENTIAL;
  return try_study(ZP_STUDY_ACTUATE, &def, err, whole);
}

TEST(explicit_survives_every_failure) {
  ck_assert_int_ge(fail_each("zp_study_run, actuate, explicit", run_explicit, false), 10);
}

TEST(implicit_steps_allocate_nothing) {
  ZpActuatorDef def = short_def();
  def.drive.voltage = 10e3;
  def.damping.internal = 1e-5;
  def.solver.tolerance = 1e-4;
  def.solver.end_time = 0.2;
  assert_no_allocation(&def, 0.2, 100); /* zips on the way */
}

/* A control loop steps again and again, in a liquid, with the model's controller. */
TEST(controlled_steps_allocate_nothing) {
  ZpActuatorDef def = short_def();
  def.drive.voltage = 8e3;
  def.liquid.model = ZP_LIQUID_BEAD;
  def.control.kind = ZP_CONTROL_BOOST_PI;
  def.control.proportional = def.control.boost_voltage = 1e3;
  def.solver.end_time = 0.2;
  def.control.delay = 2.5e-3;
  def.control.noise = 1e-5;
  def.setpoint.value = 1e-3;
  ZpSim *sim = sim_of(model_of(&def));
  ZpOutcome outcome = ZP_REACHED_END;
  watch(0);
  for (int k = 0; k < 100 && outcome == ZP_REACHED_END; k++)
    outcome = zp_sim_step(sim, 1e-3, NULL, NULL);
  look_away();
  ck_assert_int_eq(outcome, ZP_REACHED_END);
  ck_assert_msg(ledger.calls == 0, "%ld allocations", ledger.calls);
  ck_assert(zp_sim_get(sim, "voltage") > 0);
}

/* The whole life: sagging, zipping pair after pair, closed. */
TEST(zipping_allocates_nothing) {
  ZpActuatorDef def = short_def();
  def.drive.voltage = 10e3;
  def.solver.end_time = 0.2;
  def.solver.integrator = ZP_INTEGRATOR_EXPLICIT;
  assert_no_allocation(&def, 0.2, 10000);
  def.contact.model = ZP_CONTACT_SEQUENTIAL;
  assert_no_allocation(&def, 0.2, 10000);
}

/* The Bezier surface is fitted anew when the front moves and when the force is refreshed. */
TEST(bezier_steps_allocate_nothing) {
  ZpAssignment list[] = {{zp_key_find("preset"), ZP_PRESET_PAPER_CODE},
                         {zp_key_find("mesh.nodes"), 21},
                         {zp_key_find("solver.tolerance"), 1e-1}};
  ZpActuatorDef def = {0};
  ck_assert_int_eq(zp_def_resolve(&def, list, 3, NULL), ZP_OK);
  assert_no_allocation(&def, 25e-3, 5000);
  def.electro.refresh_period = 0;
  assert_no_allocation(&def, 25e-3, 5000);
}

/* -- scenarios --------------------------------------------------------------------------------------- */

static const char scenario_text[] = "preset: paper-code\n"
                                    "mesh: {nodes: 21}\n"
                                    "load:\n"
                                    "  mass: [8 g, 0.02, 30 g]\n"
                                    "drive.voltage: [6 kV, 10 kV]\n";

static ZpStatus create_scenario(ZpError *err, bool *whole) {
  ZpScenario *scenario = zp_scenario_create();
  *err = (ZpError){ZP_MACHINE, "NULL"};
  *whole = true;
  ZpStatus status = scenario ? ZP_OK : ZP_MACHINE;
  zp_scenario_destroy(scenario);
  return status;
}

/* What a call that failed must not change: the number of Defs, and a value of the last one. */
static bool is_untouched(const ZpScenario *scenario, size_t count, double mass) {
  ZpActuatorDef def = {0};
  bool watching = ledger.watching;
  ledger.watching = false;
  bool same = zp_scenario_count(scenario) == count && zp_scenario_def(scenario, count - 1, &def, NULL) == ZP_OK &&
              def.load.mass == mass;
  ledger.watching = watching;
  return same;
}

/* A scenario made in peace, for a call of which alone the memory fails. */
static ZpScenario *in_peace(const char *text) {
  bool watching = ledger.watching;
  ledger.watching = false;
  ZpScenario *scenario = zp_scenario_create();
  ck_assert_ptr_nonnull(scenario);
  ck_assert_int_eq(zp_scenario_parse(scenario, text, strlen(text), "test.yaml", NULL), ZP_OK);
  ledger.watching = watching;
  return scenario;
}

/* Was a scenario of one case, 5 g, changed to `count` cases, the last one of `mass`, or not at all? */
static ZpStatus changed(ZpScenario *scenario, ZpStatus status, size_t count, double mass, bool *whole) {
  *whole = status == ZP_OK ? is_untouched(scenario, count, mass) : is_untouched(scenario, 1, 5e-3);
  zp_scenario_destroy(scenario); /* the ledger must see what is freed */
  return status;
}

static ZpStatus parse_scenario(ZpError *err, bool *whole) {
  ZpScenario *scenario = in_peace("load: {mass: 5 g}\n");
  ZpStatus status = zp_scenario_parse(scenario, scenario_text, strlen(scenario_text), "memory.yaml", err);
  return changed(scenario, status, 6, 30e-3, whole);
}

static ZpStatus read_scenario(ZpError *err, bool *whole) {
  ZpScenario *scenario = in_peace("load: {mass: 5 g}\n");
  return changed(scenario, zp_scenario_read(scenario, "memory.yaml", err), 6, 30e-3, whole);
}

static ZpStatus set_scenario(ZpError *err, bool *whole) {
  ZpScenario *scenario = in_peace("load: {mass: 5 g}\n");
  return changed(scenario, zp_scenario_set(scenario, "load.mass=[1 g, 2 g, 7 g]", err), 3, 7e-3, whole);
}

static ZpStatus take_def(ZpError *err, bool *whole) {
  ZpScenario *scenario = in_peace(scenario_text);
  ZpActuatorDef def = {0};
  ZpStatus status = zp_scenario_def(scenario, 5, &def, err);
  *whole = status != ZP_OK || (def.load.mass == 30e-3 && def.drive.voltage == 10e3);
  zp_scenario_destroy(scenario);
  return status;
}

static ZpStatus parse_value(ZpError *err, bool *whole) {
  double value = 0;
  ZpStatus status = zp_value_parse(zp_key_find("ribbon.thickness"), "50 um", &value, err);
  *whole = status != ZP_OK || value == 50e-6;
  return status;
}

static bool from_file;

/* Study actuate driven by a table from the scenario or from a file. */
static ZpStatus run_by_table(ZpError *err, bool *whole) {
  ZpActuatorDef def = short_def();
  def.drive.waveform = ZP_WAVEFORM_TABLE;
  strcpy(from_file ? def.drive.file : def.drive.table, from_file ? "memory.csv" : "0 = 0, 10 us = 100 V");
  return try_study(ZP_STUDY_ACTUATE, &def, err, whole);
}

TEST(table_survives_every_failure) {
  FILE *file = fopen("memory.csv", "w");
  ck_assert(file && fputs("time_us,voltage_V\n0,0\n10,100\n", file) >= 0 && fclose(file) == 0);
  from_file = false;
  ck_assert_int_ge(fail_each("drive.table", run_by_table, false), 10);
  from_file = true;
  ck_assert_int_ge(fail_each("drive.file", run_by_table, false), 13);
}

static ZpStatus write_checkpoint(FILE *file, ZpError *err) {
  ZpActuatorDef def = short_def();
  ZpModel *model = NULL;
  ZpSim *sim = NULL;
  ZpCheckpoint *checkpoint = NULL;
  ZpStatus status = zp_model_create(&def, &model, err);
  if (status == ZP_OK) status = zp_sim_create(model, NULL, &sim, err);
  if (status == ZP_OK) status = zp_sim_checkpoint(sim, &checkpoint, err);
  if (status == ZP_OK) status = zp_checkpoint_write(checkpoint, file, err);
  zp_checkpoint_destroy(checkpoint);
  zp_sim_destroy(sim);
  zp_model_destroy(model);
  return status;
}

/* Study actuate from the checkpoint of its own start. */
static ZpStatus run_from_checkpoint(ZpError *err, bool *whole) {
  ZpActuatorDef def = short_def();
  def.initial.state = ZP_INITIAL_CHECKPOINT;
  strcpy(def.initial.file, "memory.zps");
  FILE *file = fopen(def.initial.file, "wb");
  ZpStatus status = file ? write_checkpoint(file, err) : ZP_MACHINE;
  *whole = status != ZP_OK;
  return file && fclose(file) == 0 && status == ZP_OK ? try_study(ZP_STUDY_ACTUATE, &def, err, whole) : status;
}

TEST(checkpoint_survives_every_failure) {
  ck_assert_int_ge(fail_each("initial.file", run_from_checkpoint, true), 20);
}

/* -- texts: what is written under failures is what is written without ---------------------------------- */

typedef ZpStatus (*Writer)(FILE *file, ZpError *err);

static char *reference; /* of the writer under test */
static ZpStatus write_scenario(FILE *file, ZpError *err);
static ZpStatus write_keys_yaml(FILE *file, ZpError *err);

static size_t lines_of(const char *text) {
  size_t lines = 0;
  for (; (text = strchr(text, '\n')); text++)
    lines++;
  return lines;
}

static bool same_def(const ZpScenario *a, const ZpScenario *b, size_t index) {
  ZpActuatorDef x = {0}, y = {0};
  bool same = zp_scenario_def(a, index, &x, NULL) == ZP_OK && zp_scenario_def(b, index, &y, NULL) == ZP_OK;
  for (int i = 0; same && zp_key(i); i++) {
    double value = zp_def_get(&x, i), other = zp_def_get(&y, i);
    same = value == other || (isnan(value) && isnan(other));
  }
  zp_def_clear(&x);
  zp_def_clear(&y);
  return same;
}

/* Do two scenarios stand for the same Defs? */
static bool same_scenario(const char *text, const char *other) {
  ZpScenario *a = zp_scenario_create(), *b = zp_scenario_create();
  bool same = zp_scenario_parse(a, text, strlen(text), "a", NULL) == ZP_OK &&
              zp_scenario_parse(b, other, strlen(other), "b", NULL) == ZP_OK &&
              zp_scenario_count(a) == zp_scenario_count(b) && zp_scenario_study(a) == zp_scenario_study(b);
  for (size_t i = 0; same && i < zp_scenario_count(a); i++)
    same = same_def(a, b, i);
  zp_scenario_destroy(a);
  zp_scenario_destroy(b);
  return same;
}

/* Without the memory for a locale a value is written in SI, "0.1" for "100 mm": the same value, so the text
 * is as good. Anything else must be to the letter. */
static bool as_good(const char *text, bool is_scenario) {
  if (strcmp(text, reference) == 0) return true;
  bool watching = ledger.watching;
  ledger.watching = false;
  bool good = lines_of(text) == lines_of(reference) && (!is_scenario || same_scenario(text, reference));
  ledger.watching = watching;
  return good;
}

/* (writer) => its status; *whole false if it says ZP_OK for a text that is worse than `reference`. */
static ZpStatus write_text(Writer tested, ZpError *err, bool *whole) {
  char *text = NULL;
  size_t size = 0;
  FILE *file = __real_open_memstream(&text, &size);
  ZpStatus status = file ? tested(file, err) : ZP_MACHINE;
  *whole = false;
  if (!file || fclose(file) != 0) return status;
  *whole = status != ZP_OK || !reference || as_good(text, tested == write_scenario || tested == write_keys_yaml);
  if (!reference)
    reference = text;
  else
    __real_free(text);
  return status;
}

static ZpStatus write_scenario(FILE *file, ZpError *err) {
  ZpScenario *scenario = in_peace(scenario_text);
  ZpStatus status = zp_scenario_write(scenario, file, err);
  zp_scenario_destroy(scenario);
  return status;
}

static ZpStatus write_keys_text(FILE *file, ZpError *err) {
  return zp_keys_write(ZP_KEYS_TEXT, file, err);
}

static ZpStatus write_keys_json(FILE *file, ZpError *err) {
  return zp_keys_write(ZP_KEYS_JSON, file, err);
}

static ZpStatus write_keys_yaml(FILE *file, ZpError *err) {
  return zp_keys_write(ZP_KEYS_YAML, file, err);
}

static ZpReport shared_report; /* of one run or of a sweep */

static ZpStatus write_summary(FILE *file, ZpError *err) {
  return zp_summary_write(&shared_report, file, err);
}

static Writer writer;

static ZpStatus call_writer(ZpError *err, bool *whole) {
  return write_text(writer, err, whole);
}

static void fail_each_writer(const char *name, Writer tested, bool may_do_without) {
  ZpError err;
  bool whole;
  writer = tested;
  reference = NULL;
  ck_assert_int_eq(write_text(tested, &err, &whole), ZP_OK);
  ck_assert_uint_gt(strlen(reference), 0);
  fail_each(name, call_writer, may_do_without);
  __real_free(reference);
  reference = NULL;
}

TEST(scenarios_survive_every_failure) {
  FILE *file = fopen("memory.yaml", "w");
  ck_assert_ptr_nonnull(file);
  fputs(scenario_text, file);
  ck_assert_int_eq(fclose(file), 0);
  fail_each("zp_scenario_create", create_scenario,
            true); /* of what cases have in common: then each is resolved in full */
  fail_each("zp_scenario_parse", parse_scenario, true);
  fail_each("zp_scenario_read", read_scenario, true);
  fail_each("zp_scenario_set", set_scenario, true);
  fail_each("zp_scenario_def", take_def, false);
  fail_each("zp_value_parse", parse_value, false);
  ck_assert_int_eq(unlink("memory.yaml"), 0);
}

NIGHTLY_TEST(writers_survive_every_failure) {
  fail_each_writer("zp_scenario_write", write_scenario, true);
  fail_each_writer("zp_keys_write text", write_keys_text, true);
  fail_each_writer("zp_keys_write json", write_keys_json, false);
  fail_each_writer("zp_keys_write yaml", write_keys_yaml, true);
}

/* -- reports ----------------------------------------------------------------------------------------- */

static const char report_folder[] = "allocation-report";

/* A report of the runs of a scenario, made in peace. */
static void make_report(const char *text) {
  static ZpResult *result[8];
  ZpScenario *scenario = in_peace(text);
  size_t count = zp_scenario_count(scenario);
  ck_assert_uint_le(count, 8);
  for (size_t i = 0; i < count; i++) {
    ZpActuatorDef def = {0};
    ck_ok(zp_scenario_def(scenario, i, &def, &err));
    ck_ok(zp_study_run(zp_scenario_study(scenario), &def, NULL, NULL, &result[i], &err));
  }
  shared_report = (ZpReport){report_folder, scenario, result, count, 0.25, NULL, NULL, NULL, 0, NULL, NULL};
}

static void free_report(void) {
  for (size_t i = 0; i < shared_report.count; i++)
    zp_result_destroy(shared_report.result[i]);
  zp_scenario_destroy((ZpScenario *)(uintptr_t)shared_report.scenario);
  shared_report = (ZpReport){0};
}

/* Go through a folder and all in it, counting files, those of temporary names among them; and remove it. */
typedef struct Census {
  int files, temporary;
  bool summary;
} Census;

static void take_census(const char *folder, Census *census) {
  DIR *list = opendir(folder);
  if (!list) return;
  for (struct dirent *entry = readdir(list); entry; entry = readdir(list)) {
    char path[512];
    struct stat info;
    if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
    snprintf(path, sizeof path, "%.200s/%.250s", folder, entry->d_name);
    ck_assert_int_eq(lstat(path, &info), 0);
    if (S_ISDIR(info.st_mode)) {
      take_census(path, census);
      continue;
    }
    census->files++;
    census->temporary += strstr(entry->d_name, ".tmp") != NULL;
    census->summary |= strcmp(entry->d_name, "summary.json") == 0;
    ck_assert_int_eq(unlink(path), 0);
  }
  closedir(list);
  ck_assert_int_eq(rmdir(folder), 0);
}

static Census whole_census; /* of a report without failures */

/* summary.json comes last: it is there if and only if the report is done, and no temporary file stays. */
static ZpStatus write_report(ZpError *err, bool *whole) {
  ZpStatus status = zp_report_write(&shared_report, NULL, err);
  bool watching = ledger.watching;
  ledger.watching = false;
  Census census = {0};
  take_census(report_folder, &census);
  ck_assert_msg(census.temporary == 0, "%d temporary files stay", census.temporary);
  ck_assert_msg(census.summary == (status == ZP_OK), "summary.json there: %d, status %d", census.summary, (int)status);
  ledger.watching = watching;
  *whole = status != ZP_OK || census.files == whole_census.files;
  return status;
}

static void fail_each_report(const char *name, const char *text) {
  ZpError err;
  make_report(text);
  whole_census = (Census){0};
  ck_assert_msg(zp_report_write(&shared_report, NULL, &err) == ZP_OK, "%s", err.message);
  take_census(report_folder, &whole_census);
  ck_assert_int_ge(whole_census.files, 4);
  fail_each_writer("zp_summary_write", write_summary, false);
  fail_each(name, write_report, true); /* a picture may be missing: without gnuplot all are */
  free_report();
}

/* gnuplot is not run here: there is none on an empty PATH. */
NIGHTLY_TEST(reports_survive_every_failure) {
  ck_assert_int_eq(setenv("PATH", "/nowhere", 1), 0);
  json_set_alloc_funcs(__wrap_malloc, __wrap_free);
  fail_each_report("zp_report_write", "mesh: {nodes: 5}\n"
                                      "solver: {tolerance: 1e-1, end_time: 100 us}\n"
                                      "output: {samples: 10, shapes: 3}\n");
  fail_each_report("zp_report_write of a profile",
                   "study: profile\n" /* without voltage: no pictures, which take long */
                   "drive: {voltage: 0 V}\n"
                   "profile: {shape: cubic}\n");
  fail_each_report("zp_report_write of a sweep", "mesh: {nodes: 5}\n"
                                                 "solver: {tolerance: 1e-1, end_time: 100 us}\n"
                                                 "drive: {voltage: [0 V, 1 kV]}\n"
                                                 "output: {samples: 10, shapes: 3}\n");
}

NIGHTLY_TEST(keys_survive_failures_of_jansson) {
  json_set_alloc_funcs(__wrap_malloc, __wrap_free);
  fail_each_writer("zp_keys_write json, jansson too", write_keys_json, false);
}
