/* The FMUs that `zipact fmu` writes, in an importer: what they say, what they compute, and what they refuse. Every test
 * is run for FMI 2 and for FMI 3. */
#include "data_util.h"

#include <malloc.h>
#include <pthread.h>
#include <stdarg.h>
#include <unistd.h>

#include "fmu_importer.h"

enum { OK = 0, SIGNALS = 64 };

/* -- FMUs of the tests ----------------------------------------------------------------------------- */

#define SMALL  " --set mesh.nodes=9 --set liquid.model=none --set solver.end_time=20ms"
#define LIQUID " --set mesh.nodes=21 --set solver.end_time=20ms --set liquid.model=bead"

static void run_command(const char *format, ...) {
  char command[2048];
  va_list values;
  va_start(values, format);
  vsnprintf(command, sizeof command, format, values);
  va_end(values);
  ck_assert_msg(system(command) == 0, "%s", command); // NOLINT: the command is the test's own
}

/* A test of both versions of FMI; _i is the version. */
#define VERSION_TESTS(name) TESTS(name, 2, 4)

static char scratch[32]; /* folder of this program's files: others run beside it */

static void name_scratch(void) {
  snprintf(scratch, sizeof scratch, "fmu-%d", (int)getpid());
}

/* No test runs any more: a failed assertion would end the program. */
static void remove_scratch(void) {
  char command[64];
  snprintf(command, sizeof command, "rm -rf %s", scratch);
  if (system(command) != 0) perror(command); // NOLINT: the command is the test's own
}

AROUND_ALL(name_scratch, remove_scratch)

/* The FMU of these settings as FOLDER/arm.fmu. */
static void write_fmu(const char *folder, int version, const char *settings) {
  run_command("mkdir -p %s && " ZP_COMMAND " fmu --fmi %d --quiet -o %s/arm.fmu %s", folder, version, folder, settings);
}

/* The FMU of these settings: written by the first test that asks for it, since packing takes long. Tests are processes
 * of their own, so what there is stands in the folder's name. */
static Fmu made(int version, const char *settings) {
  char folder[64], path[80];
  uint64_t sum = UINT64_C(0xcbf29ce484222325); /* FNV-1a */
  for (const char *c = settings; *c; c++)
    sum = (sum ^ (unsigned char)*c) * UINT64_C(0x100000001b3);
  snprintf(folder, sizeof folder, "%s/%d-%016llx", scratch, version, (unsigned long long)sum);
  snprintf(path, sizeof path, "%s/arm.fmu", folder);
  if (access(path, F_OK) != 0) {
    write_fmu(folder, version, settings);
    fmu_unpack(path, folder);
  }
  return fmu_open(folder);
}

static Instance new_instance(const Fmu *fmu) {
  Instance instance = fmu_instantiate(fmu, fmu->token, WHOLE_STEPS);
  ck_assert_msg(instance.handle != NULL, "%s", last_message);
  return instance;
}

static Instance started(const Fmu *fmu) {
  Instance instance = new_instance(fmu);
  fmu_start(&instance);
  return instance;
}

static void must_step(Instance *instance, double now, double size) {
  ck_assert_msg(fmu_step(instance, now, size) == OK, "%s", last_message);
}

/* All outputs => value; their number. */
static size_t read_outputs(Instance *instance, double value[SIGNALS]) {
  size_t count = 0;
  memset(value, 0, SIGNALS * sizeof *value);
  for (size_t k = 0; k < instance->fmu->variables; k++) {
    const Variable *v = &instance->fmu->variable[k];
    if (strcmp(v->causality, "output") == 0) ck_assert_int_eq(fmu_try_get(instance, v, &value[count++]), OK);
  }
  return count;
}

static void expect_same(const double a[SIGNALS], const double b[SIGNALS]) {
  for (size_t k = 0; k < SIGNALS; k++)
    ck_assert_msg(memcmp(&a[k], &b[k], sizeof *a) == 0, "output %zu: %.17g and %.17g", k, a[k], b[k]);
}

/* -- what it says ---------------------------------------------------------------------------------- */

/* Parameters are the keys, with their units, ranges and values; a key that is auto or none is not among them. */
static void expect_parameter(const Fmu *fmu, const char *name, double start) {
  const Variable *v = fmu_find(fmu, name);
  const ZpKey *key = zp_key(zp_key_find(name));
  ck_assert_str_eq(v->causality, "parameter");
  ck_assert(v->has_start && v->description == strlen(key->help));
  ck_assert_double_eq(v->start, start);
  if (v->kind == KIND_REAL) ck_assert_str_eq(v->unit, strcmp(key->unit, "1") == 0 ? "" : key->unit);
  if (v->kind == KIND_REAL) ck_assert(v->has_range && v->min == key->min && v->max == key->max);
  if (v->kind == KIND_ENUMERATION) ck_assert_int_ne(v->declared[0], 0);
}

/* Each unit of a signal or a parameter, as powers of kg, m, s and A, and the units in which an importer may show its
 * values, with their numbers for 1. */
static const Unit units[] = {{"V", true, {1, 2, -3, -1}, 1, {{"kV", 1e-3}}},
                             {"N", true, {1, 1, -2, 0}, 1, {{"mN", 1e3}}},
                             {"m", true, {0, 1, 0, 0}, 3, {{"mm", 1e3}, {"um", 1e6}, {"nm", 1e9}}},
                             {"m/s", true, {0, 1, -1, 0}, 0, {{"", 0}}},
                             {"C", true, {0, 0, 1, 1}, 0, {{"", 0}}},
                             {"F", true, {-1, -2, 4, 2}, 1, {{"pF", 1e12}}},
                             {"A", true, {0, 0, 0, 1}, 0, {{"", 0}}},
                             {"J", true, {1, 2, -2, 0}, 0, {{"", 0}}},
                             {"V/m", true, {1, 1, -3, -1}, 1, {{"MV/m", 1e-6}}},
                             {"Pa", true, {1, -1, -2, 0}, 2, {{"GPa", 1e-9}, {"MPa", 1e-6}}},
                             {"1/m", true, {0, -1, 0, 0}, 0, {{"", 0}}},
                             {"m3", true, {0, 3, 0, 0}, 1, {{"uL", 1e9}}},
                             {"W", true, {1, 2, -3, 0}, 0, {{"", 0}}},
                             {"rad", true, {0, 0, 0, 0}, 1, {{"degree", 57.295779513082321}}},
                             {"kg/m3", true, {1, -3, 0, 0}, 0, {{"", 0}}},
                             {"m2/s", true, {0, 2, -1, 0}, 1, {{"mm2/s", 1e6}}},
                             {"N/m", true, {1, 0, -2, 0}, 1, {{"mN/m", 1e3}}},
                             {"kg", true, {1, 0, 0, 0}, 1, {{"g", 1e3}}},
                             {"m/s2", true, {0, 1, -2, 0}, 0, {{"", 0}}},
                             {"N m/rad", true, {1, 2, -2, 0}, 1, {{"mN m/rad", 1e3}}},
                             {"s", true, {0, 0, 1, 0}, 1, {{"ms", 1e3}}},
                             {"ohm", true, {1, 2, -3, -2}, 1, {{"Mohm", 1e-6}}},
                             {"ohm m", true, {1, 3, -3, -2}, 1, {{"Gohm m", 1e-9}}},
                             {"V/s", true, {1, 2, -4, -1}, 1, {{"V/us", 1e-6}}},
                             {"Hz", true, {0, 0, -1, 0}, 0, {{"", 0}}},
                             {"N s2/m2", true, {1, -1, 0, 0}, 0, {{"", 0}}}};
/* Parameters that have a number only where one is given; the FMU of these has all units. */
#define GIVEN                                                                                                          \
  " --set source.model=amplifier --set 'source.slew_rate=1 V/us' --set 'source.bandwidth=1 kHz'"                       \
  " --set insulator.resistivity=1e12 --set medium.resistivity=1e11"

static void expect_unit(const Unit *found, const Unit *unit) {
  ck_assert_msg(found->has_base && memcmp(found->power, unit->power, sizeof unit->power) == 0, "%s", unit->name);
  ck_assert_msg(found->shown == unit->shown, "%s: %zu units to show it in", unit->name, found->shown);
  for (size_t k = 0; k < unit->shown; k++) {
    ck_assert_str_eq(found->display[k].name, unit->display[k].name);
    ck_near(found->display[k].factor, unit->display[k].factor, 1e-15);
  }
}

/* The unit of that name in the table, which the file has once. */
static const Unit *unit_called(const Fmu *fmu, const char *name) {
  size_t count = 0;
  for (size_t k = 0; k < fmu->units; k++)
    count += strcmp(fmu->unit[k].name, name) == 0;
  ck_assert_msg(count == 1, "%s is defined %zu times", name, count);
  for (size_t k = 0; k < LENGTH_OF(units); k++)
    if (strcmp(units[k].name, name) == 0) return &units[k];
  ck_abort_msg("no unit %s", name);
}

static void expect_units(const Fmu *fmu) {
  for (size_t k = 0; k < fmu->units; k++)
    expect_unit(&fmu->unit[k], unit_called(fmu, fmu->unit[k].name));
  ck_assert_uint_eq(fmu->units, LENGTH_OF(units));
  for (size_t k = 0; k < fmu->variables; k++) {
    const Variable *v = &fmu->variable[k];
    bool known = !*v->display;
    if (!*v->unit) continue;
    const Unit *unit = unit_called(fmu, v->unit);
    for (size_t d = 0; d < unit->shown; d++)
      known = known || strcmp(unit->display[d].name, v->display) == 0;
    ck_assert_msg(known, "%s: no unit %s", v->name, v->display);
  }
  ck_assert_str_eq(fmu_find(fmu, "voltage")->display, "kV");
  ck_assert_str_eq(fmu_find(fmu, "load.mass")->display, "g");
}

VERSION_TESTS(description_is_of_the_tables) {
  static const char *const given_keys[] = {"load.mass",         "mesh.nodes",
                                           "liquid.model",      "solver.tolerance",
                                           "source.model",      "source.slew_rate",
                                           "source.bandwidth",  "insulator.resistivity",
                                           "medium.resistivity"}; /* the tolerance: auto as a number */
  Fmu fmu = made(_i, SMALL GIVEN " --set 'load.mass=20 g'");
  const ZpActuatorDef def = zp_actuator_def_default();
  size_t parameters = 0;
  for (size_t k = 0; k < fmu.variables; k++)
    if (strcmp(fmu.variable[k].causality, "parameter") == 0) {
      const char *name = fmu.variable[k].name;
      bool given = false;
      for (size_t i = 0; i < LENGTH_OF(given_keys); i++)
        given = given || strcmp(name, given_keys[i]) == 0;
      expect_parameter(&fmu, name, given ? fmu.variable[k].start : zp_def_get(&def, zp_key_find(name)));
      ck_assert(strncmp(name, "drive.", 6) != 0 && strcmp(name, "damping.internal") != 0);
      parameters++;
    }
  expect_parameter(&fmu, "load.mass", 0.02);
  expect_parameter(&fmu, "mesh.nodes", 9);
  ck_assert_uint_gt(parameters, 60);
  expect_units(&fmu);
  ck_assert_str_eq(fmu_find(&fmu, "voltage")->causality, "input");
  ck_assert_double_eq(fmu_find(&fmu, "voltage")->start, 10e3);
  ck_assert_double_eq(fmu_find(&fmu, "load")->start, 0);
  ck_assert_str_eq(fmu_find(&fmu, "opening")->unit, "m");
  ck_assert_str_eq(fmu_find(&fmu, "electrode_voltage")->causality, "output");
  fmu_close(&fmu);
}

/* Every function of both standards, without fmi2 and fmi3. */
static const char *const of_two[] = {"GetTypesPlatform",
                                     "GetVersion",
                                     "SetDebugLogging",
                                     "Instantiate",
                                     "FreeInstance",
                                     "SetupExperiment",
                                     "EnterInitializationMode",
                                     "ExitInitializationMode",
                                     "Terminate",
                                     "Reset",
                                     "GetReal",
                                     "GetInteger",
                                     "GetBoolean",
                                     "GetString",
                                     "SetReal",
                                     "SetInteger",
                                     "SetBoolean",
                                     "SetString",
                                     "GetFMUstate",
                                     "SetFMUstate",
                                     "FreeFMUstate",
                                     "SerializedFMUstateSize",
                                     "SerializeFMUstate",
                                     "DeSerializeFMUstate",
                                     "GetDirectionalDerivative",
                                     "EnterEventMode",
                                     "NewDiscreteStates",
                                     "EnterContinuousTimeMode",
                                     "CompletedIntegratorStep",
                                     "SetTime",
                                     "SetContinuousStates",
                                     "GetDerivatives",
                                     "GetEventIndicators",
                                     "GetContinuousStates",
                                     "GetNominalsOfContinuousStates",
                                     "SetRealInputDerivatives",
                                     "GetRealOutputDerivatives",
                                     "DoStep",
                                     "CancelStep",
                                     "GetStatus",
                                     "GetRealStatus",
                                     "GetIntegerStatus",
                                     "GetBooleanStatus",
                                     "GetStringStatus"};
static const char *const of_three[] = {"GetVersion",
                                       "SetDebugLogging",
                                       "InstantiateModelExchange",
                                       "InstantiateCoSimulation",
                                       "InstantiateScheduledExecution",
                                       "FreeInstance",
                                       "EnterInitializationMode",
                                       "ExitInitializationMode",
                                       "EnterEventMode",
                                       "Terminate",
                                       "Reset",
                                       "GetFloat32",
                                       "GetFloat64",
                                       "GetInt8",
                                       "GetUInt8",
                                       "GetInt16",
                                       "GetUInt16",
                                       "GetInt32",
                                       "GetUInt32",
                                       "GetInt64",
                                       "GetUInt64",
                                       "GetBoolean",
                                       "GetString",
                                       "GetBinary",
                                       "GetClock",
                                       "SetFloat32",
                                       "SetFloat64",
                                       "SetInt8",
                                       "SetUInt8",
                                       "SetInt16",
                                       "SetUInt16",
                                       "SetInt32",
                                       "SetUInt32",
                                       "SetInt64",
                                       "SetUInt64",
                                       "SetBoolean",
                                       "SetString",
                                       "SetBinary",
                                       "SetClock",
                                       "GetNumberOfVariableDependencies",
                                       "GetVariableDependencies",
                                       "GetFMUState",
                                       "SetFMUState",
                                       "FreeFMUState",
                                       "SerializedFMUStateSize",
                                       "SerializeFMUState",
                                       "DeserializeFMUState",
                                       "GetDirectionalDerivative",
                                       "GetAdjointDerivative",
                                       "EnterConfigurationMode",
                                       "ExitConfigurationMode",
                                       "GetIntervalDecimal",
                                       "GetIntervalFraction",
                                       "GetShiftDecimal",
                                       "GetShiftFraction",
                                       "SetIntervalDecimal",
                                       "SetIntervalFraction",
                                       "SetShiftDecimal",
                                       "SetShiftFraction",
                                       "EvaluateDiscreteStates",
                                       "UpdateDiscreteStates",
                                       "EnterContinuousTimeMode",
                                       "CompletedIntegratorStep",
                                       "SetTime",
                                       "SetContinuousStates",
                                       "GetContinuousStateDerivatives",
                                       "GetEventIndicators",
                                       "GetContinuousStates",
                                       "GetNominalsOfContinuousStates",
                                       "GetNumberOfEventIndicators",
                                       "GetNumberOfContinuousStates",
                                       "EnterStepMode",
                                       "GetOutputDerivatives",
                                       "DoStep",
                                       "ActivateModelPartition"};

/* Importers load all functions of the standard, also those that an FMU for co-simulation refuses. */
VERSION_TESTS(exports_every_function) {
  Fmu fmu = made(_i, SMALL);
  ck_assert_uint_eq(LENGTH_OF(of_two), 44);
  ck_assert_uint_eq(LENGTH_OF(of_three), 75);
  for (size_t k = 0; _i == 2 && k < LENGTH_OF(of_two); k++)
    fmu_function(&fmu, of_two[k]); /* which fails the test if there is none */
  for (size_t k = 0; _i == 3 && k < LENGTH_OF(of_three); k++)
    fmu_function(&fmu, of_three[k]);
  Instance instance = started(&fmu);
  ck_assert_int_ne(fmu_set_time(&instance, 0), OK);
  ck_assert_ptr_nonnull(strstr(last_message, "SetTime is for model exchange"));
  fmu_free(&instance);
  fmu_close(&fmu);
}

/* The same scenario gives the same bytes. */
VERSION_TESTS(same_bytes) {
  char again[64];
  Fmu fmu = made(_i, SMALL);
  snprintf(again, sizeof again, "%s/again", scratch);
  write_fmu(again, _i, SMALL);
  run_command("cmp %s/arm.fmu %s/arm.fmu", fmu.folder, again);
  fmu_close(&fmu);
}

/* -- what it computes ------------------------------------------------------------------------------ */

/* A row of a CSV file => numbers; NAN of an empty cell. */
static size_t read_row(FILE *file, double value[SIGNALS]) {
  char line[4096];
  size_t count = 0;
  if (!fgets(line, sizeof line, file) || *line == '#') return 0;
  ck_assert_msg(strstr(line, "nan") == NULL, "a missing value is no empty cell: %s", line);
  for (char *cell = line; cell && count < SIGNALS; count++) {
    char *comma = strchr(cell, ',');
    value[count] = *cell == ',' || *cell == '\n' ? NAN : strtod(cell, NULL);
    cell = comma ? comma + 1 : NULL;
  }
  return count;
}

/* The file in the FMU has what the FMU computes, to the last bit. */
VERSION_TESTS(expected_results) {
  Fmu fmu = made(_i, SMALL);
  Instance instance = started(&fmu);
  char path[600];
  double row[SIGNALS], now[SIGNALS];
  size_t rows = 0;
  snprintf(path, sizeof path, "%s/documentation/expected.csv", fmu.folder);
  FILE *file = fopen(path, "r");
  ck_assert_ptr_nonnull(file);
  read_row(file, row);
  for (; read_row(file, row); rows++) {
    if (rows > 0)
      must_step(&instance, (double)(rows - 1) * fmu.step, (double)rows * fmu.step - (double)(rows - 1) * fmu.step);
    size_t outputs = read_outputs(&instance, now);
    for (size_t k = 0; k < outputs; k++)
      ck_assert(row[k + 1] == now[k] || (isnan(row[k + 1]) && isnan(now[k])));
  }
  ck_assert_uint_eq(rows, 21);
  fclose(file);
  fmu_free(&instance);
  fmu_close(&fmu);
}

enum { INTERVALS = 100 };

/* What an FMU is told: a voltage, or of a plant under control what is to be held. */
typedef struct Input {
  const char *name, *column, *keys; /* of the input, of a CSV file of it, and the group of its waveform */
  double most;
} Input;
static const Input voltage = {"voltage", "voltage_V", "drive", 8000},
                   setpoint = {"setpoint", "setpoint", "setpoint", 0.3};

/* It rises, holds and falls, in pieces of 1 ms, as rows of a CSV file: level in each piece, or straight between (FMI 2
 * alone tells an input's slope). */
static double input_at(const Input *input, int k) {
  return input->most * (k < 20 ? 0.05 * k : k < 60 ? 1 : k < 80 ? 1 - 0.05 * (k - 60) : 0);
}

static void write_input(const char *path, const Input *input, bool straight) {
  FILE *file = fopen(path, "w");
  fprintf(file, "time_s,%s\n", input->column);
  for (int k = 0; k <= INTERVALS; k++) {
    if (!straight && k > 0) fprintf(file, "%.17g,%.17g\n", k * 1e-3, input_at(input, k - 1));
    fprintf(file, "%.17g,%.17g\n", k * 1e-3, input_at(input, k));
  }
  ck_assert_int_eq(fclose(file), 0);
}

/* The rows of table.csv at whole milliseconds. */
static size_t read_actuate(const char *path, double opening[INTERVALS + 1], double charge[INTERVALS + 1]) {
  double row[SIGNALS];
  size_t rows = 0;
  FILE *file = fopen(path, "r");
  ck_assert_ptr_nonnull(file);
  read_row(file, row);
  while (read_row(file, row)) {
    double place = row[0] * 1e3, whole = round(place);
    if (fabs(place - whole) > 1e-9 || !isnan(opening[(int)whole])) continue;
    opening[(int)whole] = row[3];
    charge[(int)whole] = row[8];
    rows++;
  }
  fclose(file);
  return rows;
}

static void expect_actuate(int version, const Input *input, bool straight, const char *settings) {
  Fmu fmu = made(version, settings);
  Instance instance = started(&fmu);
  double opening[INTERVALS + 1], charge[INTERVALS + 1], largest = 0;
  char path[600];
  for (int k = 0; k <= INTERVALS; k++)
    opening[k] = charge[k] = NAN;
  snprintf(path, sizeof path, "%s/input.csv", fmu.folder);
  write_input(path, input, straight);
  run_command(ZP_COMMAND
              " actuate %s --set solver.end_time=100ms --set output.samples=100000 --set output.errors=false "
              "--set %s.waveform=table --set %s.file=%s --no-plots --quiet -o %s/run",
              settings, input->keys, input->keys, path, fmu.folder);
  snprintf(path, sizeof path, "%s/run/table.csv", fmu.folder);
  ck_assert_uint_ge(read_actuate(path, opening, charge), INTERVALS / 2);
  for (int k = 0; k < INTERVALS; k++) {
    fmu_set(&instance, input->name, input_at(input, k));
    double slope = 1e3 * (input_at(input, k + 1) - input_at(input, k));
    if (straight) ck_assert_int_eq(fmu_set_slope(&instance, fmu_find(&fmu, input->name), slope), OK);
    must_step(&instance, k * 1e-3, (k + 1) * 1e-3 - k * 1e-3);
    if (!isnan(opening[k + 1])) largest = fmax(largest, fabs(fmu_get(&instance, "opening") - opening[k + 1]) / 0.02);
    if (!isnan(charge[k + 1]) && straight)
      largest = fmax(largest, fabs(fmu_get(&instance, "charge") - charge[k + 1]) / 1e-6);
  }
  ck_below(largest, 5e-10); /* 8.7e-11 measured */
  fmu_free(&instance);
  fmu_close(&fmu);
}

/* With equal tolerances: an FMU has a number in place of auto. */
#define STEPS " --set solver.tolerance=1e-4"

/* The same input from a CSV file gives what `zipact actuate` gives: dry, in a liquid, behind a supply. */
VERSION_TESTS(agrees_with_actuate) {
  expect_actuate(_i, &voltage, false, SMALL STEPS);
  expect_actuate(_i, &voltage, false, LIQUID STEPS);
  expect_actuate(_i, &voltage, false,
                 SMALL STEPS
                 " --set source.model=amplifier --set 'source.slew_rate=1 V/us' --set 'source.current_limit=0.1 mA'");
  expect_actuate(_i, &voltage, false,
                 SMALL STEPS " --set source.model=amplifier --set source.bandwidth=50 --set 'source.dead_time=3 ms'");
}

static bool file_says(const Fmu *fmu, const char *name, const char *words) {
  char path[600], text[4096] = "";
  snprintf(path, sizeof path, "%s/%s", fmu->folder, name);
  FILE *file = fopen(path, "r");
  ck_assert_msg(file != NULL, "no %s", path);
  size_t size = fread(text, 1, sizeof text - 1, file);
  ck_assert_uint_lt(size, sizeof text - 1);
  fclose(file);
  return strstr(text, words) != NULL;
}

/* The voltage is an input, or it is commanded by the controller, whose setpoint is one. */
static void expect_inputs(const Fmu *fmu, bool controlled) {
  size_t count = 0;
  for (size_t k = 0; k < fmu->variables; k++)
    count += strcmp(fmu->variable[k].causality, "input") == 0;
  ck_assert_uint_eq(count, 2);
  ck_assert_str_eq(fmu_find(fmu, controlled ? "setpoint" : "voltage")->causality, "input");
  ck_assert_str_eq(fmu_find(fmu, "load")->causality, "input");
  ck_assert(file_says(fmu, "documentation/index.html",
                      controlled ? "input <code>setpoint</code>" : "input <code>voltage</code>"));
  if (fmu->version == 3)
    ck_assert(file_says(fmu, "terminalsAndIcons/terminalsAndIcons.xml",
                        controlled ? "variableName=\"command\" memberName=\"v\""
                                   : "variableName=\"voltage\" memberName=\"v\""));
}

/* An FMU plays no waveform: its input begins with what the waveform is at t = 0, and stays there. */
VERSION_TESTS(begins_where_the_waveform_does) {
  static const struct {
    const char *settings, *input;
    double first;
  } of[] = {{" --set drive.waveform=square --set drive.frequency=5 --set drive.duty=0.3", "voltage", 10e3},
            {" --set drive.waveform=square --set drive.frequency=5 --set drive.rise_time=1ms --set drive.offset=1kV",
             "voltage", 1e3},
            {" --set drive.waveform=sine --set drive.frequency=5 --set drive.offset=2kV", "voltage", 2e3},
            {" --set drive.waveform=ramp --set drive.rise_time=5ms --set drive.offset=3kV", "voltage", 3e3},
            {" --set drive.waveform=table --set 'drive.table=0 ms = 4 kV, 1 ms = 0 kV'", "voltage", 4e3},
            {" --set control.kind=pi --set control.proportional=1e6 --set setpoint.waveform=table --set "
             "'setpoint.table=0 ms = 8 mm, 1 ms = 5 mm'",
             "setpoint", 8e-3}};
  char token[sizeof(((Fmu *)0)->token)] = "";
  for (size_t k = (size_t)_i % 2; k < LENGTH_OF(of); k += 2) {
    char settings[512];
    snprintf(settings, sizeof settings, SMALL "%s", of[k].settings);
    char folder[64], path[80];
    snprintf(folder, sizeof folder, "%s/waveform-%zu", scratch, k);
    snprintf(path, sizeof path, "%s/arm.fmu", folder);
    write_fmu(folder, _i, settings);
    fmu_unpack(path, folder);
    Fmu fmu = fmu_open(folder);
    ck_assert_double_eq(fmu_find(&fmu, of[k].input)->start, of[k].first);
    ck_assert_str_ne(fmu.token, token); /* which tells one set of start values from another */
    memcpy(token, fmu.token, sizeof token);
    expect_inputs(&fmu, strcmp(of[k].input, "setpoint") == 0);
    Instance instance = started(&fmu);
    must_step(&instance, 0, 2e-3);
    ck_assert_double_eq(fmu_get(&instance, of[k].input), of[k].first);
    if (strcmp(of[k].input, "voltage") == 0) ck_assert_double_eq(fmu_get(&instance, "electrode_voltage"), of[k].first);
    fmu_free(&instance);
    fmu_close(&fmu);
  }
}

/* Every example with a waveform exports; what is refused is a sweep or has several members. */
TEST(examples_export) {
  run_command("mkdir -p %1$s && cd %1$s && for one in $(grep -l 'waveform' " ZP_SOURCE_DIR
              "/examples/*.yaml); do " ZP_COMMAND
              " fmu $one --set output.errors=false --set solver.end_time=1ms --quiet -o example.fmu 2>said.txt || grep "
              "-qE 'an FMU "
              "contains a single actuator' said.txt || { cat said.txt >&2; exit 1; }; done",
              scratch);
}

/* So does one whose plant has a controller, told what is to be held: dry with its delay, in a liquid. */
VERSION_TESTS(agrees_with_actuate_under_control) {
#define CONTROL                                                                                                        \
  " --set control.kind=pi --set control.signal=contraction --set setpoint.value=0.3 --set 'control.proportional=8 kV'" \
  " --set 'control.integral=200 kV/s'"
  expect_actuate(_i, &setpoint, false, SMALL STEPS CONTROL " --set control.delay=2.4ms");
  expect_actuate(_i, &setpoint, false, LIQUID STEPS CONTROL);
}

TEST(follows_slopes_of_inputs) {
  expect_actuate(2, &voltage, true, SMALL STEPS);
}

/* Steps of any size: at the same time the actuator is at the same place, within the error of the solver steps. */
VERSION_TESTS(variable_steps) {
  Fmu fmu = made(_i, LIQUID " --set solver.tolerance=1.6e-5");
  Instance one = started(&fmu), other = started(&fmu);
  uint64_t seed = 7;
  double t = 0;
  must_step(&one, 0, 0.02);
  while (t < 0.02) {
    double size = fmin(1e-3 * (1.01 + noise(&seed)), 0.02 - t);
    must_step(&other, t, size);
    t += size;
  }
  ck_near(fmu_get(&other, "opening"), fmu_get(&one, "opening"), 2e-7); /* 3.5e-8 measured */
  fmu_free(&one);
  fmu_free(&other);
  fmu_close(&fmu);
}

/* Parameters set before initialization take effect; they stay until reset. The start time only shifts. */
VERSION_TESTS(parameters) {
  Fmu fmu = made(_i, SMALL);
  Instance instance = new_instance(&fmu);
  fmu_set(&instance, "load.mass", 0.02);
  fmu_set(&instance, "mesh.nodes", 13);
  fmu_set(&instance, "liquid.model", 2);
  fmu_set(&instance, "platform.electrode", 0);
  ck_assert_int_eq(fmu_enter(&instance, 5), OK);
  ck_assert_double_eq(fmu_get(&instance, "mesh.nodes"), 13);
  const double loaded = fmu_get(&instance, "opening");
  fmu_set(&instance, "load.mass", 0.01); /* also after outputs have been read */
  ck_assert_double_ne(fmu_get(&instance, "opening"), loaded);
  fmu_set(&instance, "load.mass", 0.02);
  ck_assert_double_eq(fmu_get(&instance, "opening"), loaded);
  ck_assert_int_eq(fmu_exit(&instance), OK);
  must_step(&instance, 5, 1e-3);
  double opening = fmu_get(&instance, "opening");
  ZpActuatorDef def = DEF({"load.mass", 0.02}, {"mesh.nodes", 13}, {"liquid.model", 2}, {"platform.electrode", 0},
                          {"solver.tolerance", fmu_find(&fmu, "solver.tolerance")->start});
  ZpSim *sim = sim_of(model_of(&def));
  zp_sim_run(sim, 1e-3, false, NULL, NULL);
  ck_near(opening, zp_sim_get(sim, "opening"), 1e-12);
  ck_assert_int_eq(fmu_reset(&instance), OK);
  fmu_start(&instance);
  ck_assert_double_eq(fmu_get(&instance, "load.mass"), 8e-3);
  fmu_free(&instance);
  fmu_close(&fmu);
}

/* Before the start every parameter and input may be set, in a run what is tunable and the inputs; outputs never. */
VERSION_TESTS(variability_is_what_may_be_set) {
  Fmu fmu = made(_i, SMALL);
  Instance instance = new_instance(&fmu);
  size_t tunable = 0;
  for (int runs = 0; runs < 2; runs++) {
    for (size_t k = 0; k < fmu.variables; k++) {
      const Variable *v = &fmu.variable[k];
      const bool input = strcmp(v->causality, "input") == 0, parameter = strcmp(v->causality, "parameter") == 0;
      const bool tunes = strcmp(v->variability, "tunable") == 0;
      ck_assert_str_eq(v->variability, !parameter ? "continuous" : tunes ? "tunable" : "fixed");
      int status = fmu_try_set(&instance, v, v->start);
      ck_assert_msg((status == OK) == (input || (parameter && (!runs || tunes))), "%s: %d", v->name, status);
      tunable += tunes;
    }
    if (runs == 0) fmu_start(&instance);
    must_step(&instance, runs * 1e-3, 1e-3);
  }
  ck_assert_uint_eq(tunable, 2 * 8);
  fmu_free(&instance);
  fmu_close(&fmu);
}

/* A gain without a controller is refused as a whole: the gain is as before, and so is the run. */
VERSION_TESTS(refused_tuning_changes_nothing) {
  Fmu fmu = made(_i, SMALL);
  Instance instance = started(&fmu), other = started(&fmu);
  double value[2][SIGNALS];
  must_step(&instance, 0, 1e-3);
  must_step(&other, 0, 1e-3);
  ck_assert_int_ne(fmu_try_set(&instance, fmu_find(&fmu, "control.proportional"), 5), OK);
  ck_assert_msg(strstr(last_message, "requires control.kind") != NULL, "%s", last_message);
  ck_assert_double_eq(fmu_get(&instance, "control.proportional"), 0);
  must_step(&instance, 1e-3, 1e-3);
  must_step(&other, 1e-3, 1e-3);
  read_outputs(&instance, value[0]);
  read_outputs(&other, value[1]);
  expect_same(value[0], value[1]);
  fmu_free(&instance);
  fmu_free(&other);
  fmu_close(&fmu);
}

/* The tolerance that an importer asks for is that of the solver, until a reset. */
VERSION_TESTS(tolerance_of_the_importer) {
  Fmu fmu = made(_i, SMALL);
  Instance instance = new_instance(&fmu);
  ck_assert_int_eq(fmu_enter_with(&instance, 0, 3e-3, INFINITY), OK);
  ck_assert_double_eq(fmu_get(&instance, "solver.tolerance"), 3e-3);
  ck_assert_int_eq(fmu_exit(&instance), OK);
  must_step(&instance, 0, 1e-3);
  ck_assert_int_eq(fmu_reset(&instance), OK);
  fmu_start(&instance);
  ck_assert_double_eq(fmu_get(&instance, "solver.tolerance"), fmu_find(&fmu, "solver.tolerance")->start);
  fmu_free(&instance);
  fmu_close(&fmu);
}

/* Gains and the tolerance may change during a run: from then on it equals a run that continues with the new values. */
VERSION_TESTS(tunable_parameters) {
  Fmu fmu = made(_i, SMALL " --set control.kind=pi --set setpoint.value=15mm --set control.proportional=100");
  Instance instance = started(&fmu);
  must_step(&instance, 0, 0.01);
  ck_assert_int_ne(fmu_try_set(&instance, fmu_find(&fmu, "load.mass"), 0.01), OK);
  ck_assert_int_ne(fmu_try_set(&instance, fmu_find(&fmu, "solver.tolerance"), -1), OK); /* and all is as before */
  fmu_set(&instance, "control.proportional", 4e5);
  fmu_set(&instance, "solver.tolerance", 1e-5);
  ck_assert_double_eq(fmu_get(&instance, "control.proportional"), 4e5);
  must_step(&instance, 0.01, 0.02);
  double opening = fmu_get(&instance, "opening"), voltage = fmu_get(&instance, "electrode_voltage");
  ZpActuatorDef def = DEF({"mesh.nodes", 9}, {"solver.end_time", 0.03}, {"control.kind", ZP_CONTROL_PI},
                          {"setpoint.value", 15e-3}, {"control.proportional", 100}),
                tuned = def;
  tuned.control.proportional = 4e5;
  tuned.solver.tolerance = 1e-5;
  ZpModel *model[] = {model_of(&def), model_of(&tuned)};
  ZpSim *sim[] = {sim_of(model[0]), sim_of(model[1])};
  ZpError err;
  ck_assert(zp_outcome_good(zp_sim_step(sim[0], 0.01, NULL, NULL)));
  char *bytes = memory_of(zp_sim_state_size(sim[0]));
  zp_sim_save(sim[0], bytes);
  ck_assert_int_eq(zp_sim_restore(sim[1], bytes, zp_sim_state_size(sim[0]), &err), ZP_OK);
  ck_assert(zp_outcome_good(zp_sim_step(sim[1], 0.02, NULL, NULL)));
  ck_near(opening, zp_sim_get(sim[1], "opening"), 1e-12);
  ck_near(voltage, zp_sim_get(sim[1], "voltage"), 1e-12);
  ck_assert(fabs(voltage) > 1e3);
  for (int k = 0; k < 2; k++) {
  }
  fmu_free(&instance);
  fmu_close(&fmu);
}

/* -- states ---------------------------------------------------------------------------------------- */

/* A copy of an instance's state in another one, by way of its bytes. */
static void copy_state(Instance *from, Instance *to) {
  void *state = NULL, *copy = NULL;
  size_t bytes;
  ck_assert_int_eq(fmu_get_state(from, &state), OK);
  ck_assert_int_eq(fmu_state_size(from, state, &bytes), OK);
  char *stored = memory_of(bytes);
  ck_assert_int_eq(fmu_serialize(from, state, stored, bytes), OK);
  ck_assert_int_eq(fmu_deserialize(to, stored, bytes, &copy), OK);
  ck_assert_int_eq(fmu_set_state(to, copy), OK);
  fmu_free_state(from, &state);
  fmu_free_state(to, &copy);
}

/* From a state, also as bytes and in another instance, everything is the same to the last bit. */
static void expect_round_trip(Instance *instance, Instance *other, double t, double size) {
  void *state = NULL;
  double before[SIGNALS], after[SIGNALS], again[SIGNALS];
  read_outputs(instance, before);
  ck_assert_int_eq(fmu_get_state(instance, &state), OK);
  must_step(instance, t, size);
  read_outputs(instance, after);
  ck_assert_int_eq(fmu_set_state(instance, state), OK);
  read_outputs(instance, again);
  expect_same(before, again);
  copy_state(instance, other);
  must_step(other, t, size);
  read_outputs(other, again);
  expect_same(after, again);
  must_step(instance, t, size);
  read_outputs(instance, again);
  expect_same(after, again);
  fmu_free_state(instance, &state);
}

VERSION_TESTS(states) {
  Fmu fmu = made(_i, LIQUID);
  Instance instance = started(&fmu), other = new_instance(&fmu);
  uint64_t seed = 3;
  double t = 0;
  for (int k = 0; k < FULL_OR(100, 10); k++) {
    double size = 1e-3 * (1.01 + noise(&seed));
    fmu_set(&instance, "voltage", 5e3 * (1 + noise(&seed)));
    if (k % 3 == 0) fmu_set(&instance, "load", 0.1 * noise(&seed));
    expect_round_trip(&instance, &other, t, size);
    t += size;
  }
  fmu_free(&instance);
  fmu_free(&other);
  fmu_close(&fmu);
}

/* A state has its parameters: another instance takes them over. What is damaged is refused. */
VERSION_TESTS(states_have_parameters) {
  Fmu fmu = made(_i, SMALL);
  Instance instance = new_instance(&fmu), other = started(&fmu);
  void *state = NULL, *damaged = NULL;
  size_t bytes;
  fmu_set(&instance, "load.mass", 0.02);
  fmu_start(&instance);
  must_step(&instance, 0, 1e-3);
  ck_assert_int_eq(fmu_get_state(&instance, &state), OK);
  ck_assert_int_eq(fmu_set_state(&other, state), OK);
  ck_assert_double_eq(fmu_get(&other, "load.mass"), 0.02);
  ck_assert_double_eq(fmu_get(&other, "opening"), fmu_get(&instance, "opening"));
  ck_assert_int_eq(fmu_state_size(&instance, state, &bytes), OK);
  unsigned char *stored = memory_of(bytes);
  ck_assert_int_eq(fmu_serialize(&instance, state, stored, bytes), OK);
  ck_assert_int_ne(fmu_serialize(&instance, state, stored, bytes - 1), OK);
  for (size_t k = 0; k < bytes; k += 1 + bytes / 64) {
    stored[k] ^= 1;
    ck_assert_int_eq(fmu_deserialize(&other, stored, bytes, &damaged), OK);
    ck_assert_msg(fmu_set_state(&other, damaged) != OK, "byte %zu of %zu", k, bytes);
    ck_assert_double_eq(fmu_get(&other, "opening"), fmu_get(&instance, "opening"));
    stored[k] ^= 1;
  }
  fmu_free_state(&other, &damaged);
  ck_assert_int_eq(fmu_deserialize(&other, stored, 10, &damaged), OK);
  ck_assert_int_ne(fmu_set_state(&other, damaged), OK);
  ck_assert_int_ne(fmu_set_state(&other, NULL), OK);
  fmu_free_state(&other, &damaged);
  fmu_free_state(&instance, &state);
  fmu_free(&instance);
  fmu_free(&other);
  fmu_close(&fmu);
}

/* The mean current of a step is the charge that has flowed in it, with that of a jump of the voltage before it, over
 * its time. An input that is set does not change it, until the next step. So it is after a return to a state between
 * the jump and the step, whose outputs are those of the new voltage. */
VERSION_TESTS(currents_are_of_whole_steps) {
  Fmu fmu = made(_i, SMALL);
  Instance instance = started(&fmu), other = new_instance(&fmu);
  must_step(&instance, 0, 1e-3);
  const double current = fmu_get(&instance, "current"), before = fmu_get(&instance, "charge");
  fmu_set(&instance, "voltage", 12e3);
  copy_state(&instance, &other);
  ck_assert_double_eq(fmu_get(&other, "charge"), fmu_get(&instance, "charge"));
  ck_assert_double_gt(fmu_get(&other, "charge"), 1.05 * before);
  ck_assert_double_eq(fmu_get(&instance, "current"), current);
  ck_assert_double_eq(fmu_get(&other, "current"), current);
  must_step(&instance, 1e-3, 1e-3);
  must_step(&other, 1e-3, 1e-3);
  const double flowed = fmu_get(&instance, "charge") - before;
  ck_near(fmu_get(&instance, "current"), flowed / 1e-3, 1e-10);
  ck_near(fmu_get(&other, "current"), flowed / 1e-3, 1e-10);
  fmu_free(&instance);
  fmu_free(&other);
  fmu_close(&fmu);
}

static double voltage_after(Instance *instance, double now) {
  must_step(instance, now, 1e-3);
  return fmu_get(instance, "electrode_voltage");
}

/* The voltage rises by 3 kV in a step of 1 ms at the rate that its importer tells: from before the start, in a run, in
 * another instance, after a return; not after a reset. */
TEST(rates_of_inputs_are_part_of_the_state) {
  Fmu fmu = made(2, SMALL);
  const Variable *voltage = fmu_find(&fmu, "voltage");
  Instance instance = new_instance(&fmu), other = new_instance(&fmu);
  ck_assert_int_eq(fmu_enter(&instance, 0), OK);
  fmu_set(&instance, "voltage", 2e3);
  ck_assert_int_eq(fmu_set_slope(&instance, voltage, 3e6), OK);
  copy_state(&instance, &other);
  for (int k = 0; k < 2; k++) {
    Instance *one = k ? &other : &instance;
    ck_assert_int_eq(fmu_exit(one), OK);
    ck_near(voltage_after(one, 0), 5e3, 1e-12);
  }
  ck_assert_int_eq(fmu_set_slope(&other, voltage, 0), OK);
  copy_state(&instance, &other);
  ck_near(voltage_after(&other, 1e-3), 8e3, 1e-12);
  ck_assert_int_eq(fmu_reset(&instance), OK);
  fmu_start(&instance);
  ck_near(voltage_after(&instance, 0), voltage->start, 1e-12);
  fmu_free(&instance);
  fmu_free(&other);
  fmu_close(&fmu);
}

/* Steps resolve a rise of the input by the largest voltage of the scenario, whatever it begins with: a rise from 0 V to
 * 9 kV is the same where the scenario has a square wave up to 10 kV and where it has 10 kV from the beginning. */
TEST(steps_are_those_of_the_largest_voltage) {
  double value[2][SIGNALS];
  for (int k = 0; k < 2; k++) {
    Fmu fmu =
        made(2, k ? SMALL : SMALL " --set drive.waveform=square --set drive.frequency=5 --set drive.rise_time=1ms");
    Instance instance = new_instance(&fmu);
    ck_assert_int_eq(fmu_enter(&instance, 0), OK);
    if (k) ck_assert_double_gt(fmu_get(&instance, "charge"), 0);
    if (k) fmu_set(&instance, "voltage", 0);
    ck_assert_int_eq(fmu_exit(&instance), OK);
    ck_assert_double_eq(fmu_get(&instance, "electrode_voltage"), 0);
    ck_assert_int_eq(fmu_set_slope(&instance, fmu_find(&fmu, "voltage"), 3e6), OK);
    must_step(&instance, 0, 3e-3);
    read_outputs(&instance, value[k]);
    fmu_free(&instance);
    fmu_close(&fmu);
  }
  expect_same(value[0], value[1]);
}

/* -- derivatives ----------------------------------------------------------------------------------- */

/* Outputs by an input at one instant against differences of outputs, in two sizes, extrapolated. Those that change are
 * marked in `changed`; only those that are said to follow the input may. */
static void expect_derivatives(Instance *instance, const char *input, double value, double h, bool changed[SIGNALS]) {
  double value_of[4][SIGNALS];
  static const double at[4] = {-1, 1, -0.5, 0.5};
  const Variable *known = fmu_find(instance->fmu, input);
  size_t output = 0;
  for (size_t k = 0; k < 4; k++) {
    fmu_set(instance, input, value + at[k] * h);
    read_outputs(instance, value_of[k]);
  }
  fmu_set(instance, input, value);
  for (size_t k = 0; k < instance->fmu->variables; k++) {
    const Variable *unknown = &instance->fmu->variable[k];
    if (strcmp(unknown->causality, "output") != 0) continue;
    double slope, coarse = (value_of[1][output] - value_of[0][output]) / (2 * h);
    double fine = (value_of[3][output] - value_of[2][output]) / h, difference = (4 * fine - coarse) / 3;
    bool follows = unknown->follows[strcmp(input, "load") == 0];
    ck_assert_int_eq(fmu_derivative(instance, unknown, known, &slope), OK);
    bool balance = strcmp(unknown->name, "energy_imbalance") == 0; /* it has nothing but rounding */
    double scale = fabs(slope) + 1e-3 * fabs(value_of[1][output] / value);
    if (!balance && isfinite(value_of[1][output]))
      note_check(__func__, unknown->name, input, fabs(slope - difference) / scale, 1e-6);
    ck_assert_msg(fabs(slope - difference) <= 1e-6 * scale || balance || !isfinite(value_of[1][output]),
                  "%s by %s: %.12g, differences %.12g", unknown->name, input, slope, difference);
    changed[output] |= memcmp(&value_of[0][output], &value_of[1][output], sizeof slope) != 0;
    ck_assert_msg(follows || !changed[output], "%s follows %s", unknown->name, input);
    output++;
  }
}

static void expect_derivatives_of(int version, const char *settings, const char *input, double value,
                                  bool changed[SIGNALS]) {
  Fmu fmu = made(version, settings);
  Instance instance = started(&fmu);
  bool by_load[SIGNALS] = {false};
  double slope;
  for (int k = 0; k < 10; k++) {
    must_step(&instance, k * 2e-3, 2e-3);
    expect_derivatives(&instance, input, value, 1e-5 * value, changed);
    expect_derivatives(&instance, "load", 0.01, 1e-3, by_load);
  }
  ck_assert_int_ne(fmu_derivative(&instance, fmu_find(&fmu, "opening"), fmu_find(&fmu, "load.mass"), &slope), OK);
  ck_assert_int_ne(fmu_derivative(&instance, fmu_find(&fmu, "load.mass"), fmu_find(&fmu, input), &slope), OK);
  fmu_free(&instance);
  fmu_close(&fmu);
}

/* Each output that is said to follow the voltage does so in one of these FMUs. */
static void expect_followers(int version, const bool changed[SIGNALS]) {
  Fmu fmu = made(version, SMALL);
  size_t output = 0;
  for (size_t k = 0; k < fmu.variables; k++)
    if (strcmp(fmu.variable[k].causality, "output") == 0) {
      ck_assert_msg(fmu.variable[k].follows[0] == changed[output], "%s", fmu.variable[k].name);
      ck_assert(!fmu.variable[k].follows[1]);
      output++;
    }
  fmu_close(&fmu);
}

VERSION_TESTS(derivatives) {
  bool changed[SIGNALS] = {false};
  expect_derivatives_of(_i, LIQUID, "voltage", 10e3, changed);
  expect_derivatives_of(_i, SMALL " --set source.model=amplifier --set source.resistance=1Mohm", "voltage", 10e3,
                        changed);
  expect_derivatives_of(_i, SMALL " --set insulator.resistivity=1e12 --set medium.resistivity=1e11", "voltage", 10e3,
                        changed);
  expect_followers(_i, changed);
}

/* A controller looks at its setpoint when it samples: nothing follows the input at once. */
VERSION_TESTS(setpoint_acts_with_the_next_sample) {
  bool changed[SIGNALS] = {false};
  expect_derivatives_of(_i, SMALL CONTROL, "setpoint", 0.3, changed);
  for (size_t k = 0; k < SIGNALS; k++)
    ck_assert(!changed[k]);
}

/* Seeds times the matrix, and the other way round. */
TEST(adjoint_derivatives) {
  Fmu fmu = made(3, SMALL);
  Instance instance = started(&fmu);
  double charge, force, adjoint[2];
  const double seed[2] = {3, 2};
  const uint32_t unknown[2] = {fmu_find(&fmu, "charge")->reference, fmu_find(&fmu, "force")->reference};
  const uint32_t known[2] = {fmu_find(&fmu, "load")->reference, fmu_find(&fmu, "voltage")->reference};
  __typeof__(&fmi3GetAdjointDerivative) get =
      (__typeof__(&fmi3GetAdjointDerivative))fmu_function(&fmu, "GetAdjointDerivative");
  must_step(&instance, 0, 1e-3);
  fmu_derivative(&instance, fmu_find(&fmu, "charge"), fmu_find(&fmu, "voltage"), &charge);
  fmu_derivative(&instance, fmu_find(&fmu, "force"), fmu_find(&fmu, "voltage"), &force);
  ck_assert_int_eq(get(instance.handle, unknown, 2, known, 2, seed, 2, adjoint, 2), OK);
  ck_assert_double_eq(adjoint[0], 0);
  ck_assert_double_eq(adjoint[1], 3 * charge + 2 * force);
  ck_assert_int_ne(get(instance.handle, unknown, 2, known, 2, seed, 1, adjoint, 2), OK);
  __typeof__(&fmi3GetDirectionalDerivative) along =
      (__typeof__(&fmi3GetDirectionalDerivative))fmu_function(&fmu, "GetDirectionalDerivative");
  ck_assert_int_eq(along(instance.handle, unknown, 2, known, 2, seed, 2, adjoint, 2), OK);
  ck_assert_double_eq(adjoint[0], 2 * charge); /* by 3 of the load and 2 of the voltage */
  ck_assert_double_eq(adjoint[1], 2 * force);
  fmu_free(&instance);
  fmu_close(&fmu);
}

/* -- events ---------------------------------------------------------------------------------------- */

typedef struct Ended {
  bool event, terminate, early;
  double reached;
} Ended;

static Ended step_3(Instance *instance, double now, double size) {
  Ended end;
  __typeof__(&fmi3DoStep) step = (__typeof__(&fmi3DoStep))fmu_function(instance->fmu, "DoStep");
  ck_assert_int_eq(step(instance->handle, now, size, true, &end.event, &end.terminate, &end.early, &end.reached), OK);
  return end;
}

static void handle_event(Instance *instance) {
  bool again = true, terminate, nominals, states, defined;
  double next;
  const Fmu *fmu = instance->fmu;
  ck_assert_int_eq(((__typeof__(&fmi3EnterEventMode))fmu_function(fmu, "EnterEventMode"))(instance->handle), OK);
  ck_assert_int_eq(((__typeof__(&fmi3UpdateDiscreteStates))fmu_function(fmu, "UpdateDiscreteStates"))(
                       instance->handle, &again, &terminate, &nominals, &states, &defined, &next),
                   OK);
  ck_assert(!again && !terminate && !nominals && !states && !defined);
  ck_assert_int_eq(((__typeof__(&fmi3EnterStepMode))fmu_function(fmu, "EnterStepMode"))(instance->handle), OK);
}

/* A step over a whole zip returns early at the instant of closing; the next step completes it. The time of the
 * importer, which begins with 5 s, goes on. */
TEST(early_return_at_closing) {
  Fmu fmu = made(3, SMALL);
  Instance instance = fmu_instantiate(&fmu, fmu.token, STEPS_TO_EVENTS), whole = started(&fmu);
  ck_assert(fmu_enter(&instance, 5) == OK && fmu_exit(&instance) == OK);
  ck_assert_int_ne(fmu_step(&instance, 5, 1e-3), OK); /* it begins in event mode */
  ck_assert_int_eq(((__typeof__(&fmi3EnterStepMode))fmu_function(&fmu, "EnterStepMode"))(instance.handle), OK);
  Ended end = step_3(&instance, 5, 0.2);
  ck_assert(end.event && end.early && !end.terminate && end.reached > 5 && end.reached < 5.2);
  ck_assert_double_le(fmu_get(&instance, "contraction"), 1.01);
  ck_assert_double_ge(fmu_get(&instance, "contraction"), 0.99);
  handle_event(&instance);
  end = step_3(&instance, end.reached, 5.2 - end.reached);
  ck_assert(!end.event && !end.early && end.reached == 5.2);
  Ended other = step_3(&whole, 0, 0.2);
  ck_assert(!other.event && !other.early && other.reached == 0.2);
  ck_near(fmu_get(&instance, "charge"), fmu_get(&whole, "charge"), 1e-12); /* 0 measured */
  fmu_free(&instance);
  fmu_free(&whole);
  fmu_close(&fmu);
}

/* Reaching the current limit of a supply is an event as well. */
TEST(early_return_at_limits) {
  Fmu fmu = made(3, SMALL
                 " --set source.model=amplifier --set 'source.current_limit=0.1 mA' --set 'source.resistance=1 Mohm'");
  Instance instance = fmu_instantiate(&fmu, fmu.token, STEPS_TO_EVENTS);
  fmu_start(&instance);
  ck_assert_int_eq(((__typeof__(&fmi3EnterStepMode))fmu_function(&fmu, "EnterStepMode"))(instance.handle), OK);
  Ended end = step_3(&instance, 0, 0.2);
  ck_assert(end.event && end.early);
  ck_assert_double_lt(fmu_get(&instance, "contraction"), 0.9);
  ck_near(fmu_get(&instance, "charge"), 0.1e-3 * end.reached, 3e-12); /* 4.2e-13 measured */
  fmu_free(&instance);
  fmu_close(&fmu);
}

/* So is the end of its dead time. */
TEST(early_return_at_the_end_of_a_dead_time) {
  Fmu fmu = made(3, SMALL " --set source.model=amplifier --set 'source.dead_time=12.3 ms'");
  Instance instance = fmu_instantiate(&fmu, fmu.token, STEPS_TO_EVENTS);
  fmu_start(&instance);
  ck_assert_int_eq(((__typeof__(&fmi3EnterStepMode))fmu_function(&fmu, "EnterStepMode"))(instance.handle), OK);
  Ended end = step_3(&instance, 0, 0.2);
  ck_assert(end.event && end.early);
  ck_near(end.reached, 12.3e-3, 1e-12);
  ck_assert_double_eq(fmu_get(&instance, "charge"), 0);
  fmu_free(&instance);
  fmu_close(&fmu);
}

/* Electrodes without an insulator that touch end the simulation: the FMU asks for that. */
VERSION_TESTS(short_circuit_terminates) {
  Fmu fmu = made(_i, " --set actuator.kind=flange --set ribbon.length=45mm --set electro.gap_offset=0.2mm "
                     "--set insulator.thickness=0 --set gravity=0 --set load.mass=0 --set drive.voltage=60 "
                     "--set mesh.nodes=31 --set solver.end_time=1ms");
  Instance instance = started(&fmu);
  int status = OK, terminated = 0;
  for (int k = 0; k < 1000 && status == OK && !terminated; k++) {
    if (_i == 2) {
      status = fmu_step(&instance, k * 1e-3, 1e-3);
      ((__typeof__(&fmi2GetBooleanStatus))fmu_function(&fmu, "GetBooleanStatus"))(instance.handle, fmi2Terminated,
                                                                                  &terminated);
    } else {
      terminated = step_3(&instance, k * 1e-3, 1e-3).terminate;
    }
  }
  ck_assert_int_eq(status, _i == 2 ? (int)fmi2Discard : OK);
  ck_assert_int_eq(terminated, 1);
  ck_assert_int_eq(fmu_reset(&instance), OK);
  if (_i == 2) {
    ((__typeof__(&fmi2GetBooleanStatus))fmu_function(&fmu, "GetBooleanStatus"))(instance.handle, fmi2Terminated,
                                                                                &terminated);
    ck_assert_int_eq(terminated, 0);
  }
  fmu_free(&instance);
  fmu_close(&fmu);
}

/* -- many ------------------------------------------------------------------------------------------ */

/* Free blocks that malloc keeps for the thread, a few of each size, count as given: equal states differ by up to this
 * number of bytes. */
static const size_t kept_for_thread = 16384;

/* What malloc has given and not got back, bytes: finer than the memory of the process, which hides a block lost in
 * each of 5000 rounds. 0 where the C library does not tell: before glibc 2.33, and in others. */
static size_t allocated(void) {
#if defined __GLIBC__ && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
  struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
#else
  return 0;
#endif
}

/* Reset, start, one step, again and again: the same numbers, and no more memory: the least block
 * that malloc gives, of 32 bytes, lost in each round would be 29 kB. */
VERSION_TESTS(resets) {
  enum { USUAL = 100 };
  Fmu fmu = made(_i, SMALL);
  Instance instance = new_instance(&fmu);
  double first[SIGNALS], now[SIGNALS];
  size_t before = 0;
  for (int k = 0; k < FULL_OR(1000, 300); k++) {
    fmu_start(&instance);
    must_step(&instance, 0, 1e-4);
    read_outputs(&instance, k == 0 ? first : now);
    if (k > 0) expect_same(first, now);
    if (k == USUAL) before = allocated();
    ck_assert_int_eq(fmu_reset(&instance), OK);
  }
  if (!SANITIZED) ck_assert_uint_le(allocated(), before + kept_for_thread);
  fmu_free(&instance);
  fmu_close(&fmu);
}

/* After a reset the time begins with 0 s again; FMI 2 may leave the start time out. */
TEST(reset_forgets_the_start_time) {
  Fmu fmu = made(2, SMALL);
  Instance instance = new_instance(&fmu);
  ck_assert(fmu_enter(&instance, 5) == OK && fmu_exit(&instance) == OK);
  must_step(&instance, 5, 1e-3);
  const double opening = fmu_get(&instance, "opening");
  ck_assert_int_eq(fmu_reset(&instance), OK);
  ck_assert_int_eq(
      ((__typeof__(&fmi2EnterInitializationMode))fmu_function(&fmu, "EnterInitializationMode"))(instance.handle), OK);
  ck_assert_int_eq(fmu_exit(&instance), OK);
  must_step(&instance, 0, 1e-3);
  ck_near(fmu_get(&instance, "opening"), opening, 1e-12);
  fmu_free(&instance);
  fmu_close(&fmu);
}

/* A thousand instances at once, twice: each computes the same, and what they took is given back: the least block lost
 * in each would be 32 kB. */
NIGHTLY_TESTS(instances, 2, 4) {
  enum { MOST = 1000 };
  const int count = FULL_OR(MOST, 100);
  static Instance instance[MOST];
  Fmu fmu = made(_i, SMALL);
  double first[SIGNALS], now[SIGNALS];
  size_t before = 0;
  for (int round = 0; round < 3; round++) {
    for (int k = 0; k < count; k++)
      instance[k] = started(&fmu);
    for (int k = 0; k < count; k++) {
      must_step(&instance[k], 0, 1e-3);
      read_outputs(&instance[k], k == 0 ? first : now);
      if (k > 0) expect_same(first, now);
    }
    for (int k = 0; k < count; k++)
      fmu_free(&instance[k]);
    if (round == 0) before = allocated();
  }
  if (!SANITIZED) ck_assert_uint_le(allocated(), before + kept_for_thread);
  fmu_close(&fmu);
}

static void *run_in_thread(void *user) {
  Instance *instance = user;
  double t = 0;
  for (int k = 0; k < FULL_OR(40, 10); k++) {
    if (fmu_step(instance, t, 1e-3) != OK) return user;
    t += 1e-3;
  }
  return NULL;
}

VERSION_TESTS(threads) {
  enum { THREADS = 8 };
  Fmu fmu = made(_i, SMALL);
  Instance instance[THREADS];
  pthread_t thread[THREADS];
  double first[SIGNALS], now[SIGNALS];
  for (int k = 0; k < THREADS; k++) {
    instance[k] = started(&fmu);
    ck_assert_int_eq(pthread_create(&thread[k], NULL, run_in_thread, &instance[k]), 0);
  }
  for (int k = 0; k < THREADS; k++) {
    void *failed = NULL;
    pthread_join(thread[k], &failed);
    ck_assert_ptr_null(failed);
    read_outputs(&instance[k], k == 0 ? first : now);
    if (k > 0) expect_same(first, now);
    fmu_free(&instance[k]);
  }
  fmu_close(&fmu);
}

/* -- what it refuses ------------------------------------------------------------------------------- */

VERSION_TESTS(wrong_calls) {
  Fmu fmu = made(_i, SMALL);
  ck_assert_ptr_null(fmu_instantiate(&fmu, "another token", WHOLE_STEPS).handle);
  Instance instance = new_instance(&fmu);
  const Variable *opening = fmu_find(&fmu, "opening"), *mass = fmu_find(&fmu, "load.mass"),
                 *voltage = fmu_find(&fmu, "voltage"), *nodes = fmu_find(&fmu, "mesh.nodes");
  Variable other = *opening;
  double value;
  ck_assert_int_ne(fmu_step(&instance, 0, 1e-3), OK); /* before it is initialized */
  ck_assert_int_ne(fmu_try_get(&instance, opening, &value), OK);
  ck_assert_int_ne(fmu_exit(&instance), OK);
  ck_assert_int_ne(fmu_terminate(&instance), OK);
  ck_assert_int_ne(fmu_try_set(&instance, mass, -1), OK); /* out of range */
  ck_assert_msg(strstr(last_message, "load.mass") != NULL, "%s", last_message);
  ck_assert_int_ne(fmu_try_set(&instance, mass, NAN), OK);
  ck_assert_int_ne(fmu_try_set(&instance, opening, 0), OK);
  ck_assert_int_ne(fmu_enter(&instance, NAN), OK);
  fmu_start(&instance);
  ck_assert_int_ne(fmu_enter(&instance, 0), OK);
  ck_assert_int_ne(fmu_try_set(&instance, mass, 0.01), OK); /* fixed from now on */
  ck_assert_int_ne(fmu_try_set(&instance, voltage, -1), OK);
  ck_assert_int_ne(fmu_try_set(&instance, voltage, NAN), OK);
  ck_assert_int_ne(fmu_step(&instance, 0, 0), OK);
  ck_assert_int_ne(fmu_step(&instance, 0, -1e-3), OK);
  ck_assert_int_ne(fmu_step(&instance, 0, NAN), OK);
  ck_assert_int_ne(fmu_step(&instance, 0.5, 1e-3), OK); /* not where it is */
  other.reference = 99999;
  ck_assert_int_ne(fmu_try_get(&instance, &other, &value), OK);
  other.reference = nodes->reference; /* not a real number */
  ck_assert_int_ne(fmu_try_get(&instance, &other, &value), OK);
  other.reference = (uint32_t)zp_key_find("damping.internal") + 1000; /* auto: not a parameter */
  ck_assert_int_ne(fmu_try_get(&instance, &other, &value), OK);
  must_step(&instance, 0, 1e-3); /* none of that has done any harm */
  ck_assert_double_eq(fmu_get(&instance, "voltage"), 10e3);
  ck_assert_int_eq(fmu_terminate(&instance), OK);
  ck_assert_int_eq(fmu_try_get(&instance, opening, &value), OK);
  ck_assert_int_ne(fmu_step(&instance, 1e-3, 1e-3), OK);
  ck_assert_int_ne(fmu_try_set(&instance, voltage, 0), OK);
  fmu_free(&instance);
  fmu_close(&fmu);
}

/* An importer that gets no instance is told why. */
VERSION_TESTS(refused_instances_say_why) {
  static const char *const says[] = {"not for model exchange", "not for scheduled execution", "intermediate"};
  Fmu fmu = made(_i, SMALL);
  for (Other other = OTHER_EXCHANGE; other <= (_i == 2 ? OTHER_EXCHANGE : OTHER_INTERMEDIATE); other++) {
    ck_assert_ptr_null(fmu_instantiate_other(&fmu, other));
    ck_assert_msg(strstr(last_message, says[other]) != NULL, "%s", last_message);
  }
  ck_assert_ptr_null(fmu_instantiate(&fmu, "another token", WHOLE_STEPS).handle);
  ck_assert_msg(strstr(last_message, "the token differs") != NULL, "%s", last_message);
  fmu_close(&fmu);
}

/* A step beyond the stop time is an error and does nothing; times that were summed up may pass it by their rounding. */
VERSION_TESTS(ends_at_the_stop_time) {
  Fmu fmu = made(_i, SMALL);
  Instance instance = new_instance(&fmu);
  ck_assert_int_eq(fmu_enter_until(&instance, 0, 3e-3), OK);
  ck_assert_int_eq(fmu_exit(&instance), OK);
  must_step(&instance, 0, 2e-3);
  ck_assert_int_ne(fmu_step(&instance, 2e-3, 1.1e-3), OK);
  ck_assert_msg(strstr(last_message, "after the stop time") != NULL, "%s", last_message);
  must_step(&instance, 2e-3, 1e-3 * (1 + 1e-12));
  ck_assert_int_ne(fmu_step(&instance, 3e-3, 1e-3), OK);
  ck_assert_int_eq(fmu_reset(&instance), OK);
  fmu_start(&instance); /* without a stop time */
  must_step(&instance, 0, 5e-3);
  fmu_free(&instance);
  fmu_close(&fmu);
}

/* Parameters that do not fit one another are found where initialization ends; a reset helps. */
VERSION_TESTS(parameters_that_do_not_fit) {
  Fmu fmu = made(_i, SMALL);
  Instance instance = new_instance(&fmu);
  fmu_set(&instance, "platform.length", 0.5); /* longer than the ribbon */
  ck_assert_int_eq(fmu_enter(&instance, 0), OK);
  ck_assert_int_ne(fmu_exit(&instance), OK);
  ck_assert_msg(strstr(last_message, "platform.length") != NULL, "%s", last_message);
  ck_assert_int_ne(fmu_step(&instance, 0, 1e-3), OK);
  ck_assert_int_eq(fmu_reset(&instance), OK);
  fmu_start(&instance);
  must_step(&instance, 0, 1e-3);
  fmu_free(&instance);
  fmu_close(&fmu);
}

/* An FMU has a single actuator, or equal ones side by side, and says so both where it is written and where a parameter
 * makes a stack of it. */
VERSION_TESTS(stacks) {
  static const char *const members[] = {"stack.series=3", "stack.series=2 --set 'stack.distance=20 mm'",
                                        "stack.parallel=2 --set 'member_2.ribbon.thickness=60 um'"};
  for (size_t k = 0; k < LENGTH_OF(members); k++)
    run_command(ZP_COMMAND " fmu --set %s -o no.fmu 2>said.txt; test $? = 2 && test ! -e no.fmu && grep -q "
                           "'an FMU contains a single actuator' said.txt",
                members[k]);
  Fmu fmu = made(_i, SMALL);
  Instance instance = new_instance(&fmu);
  fmu_set(&instance, "stack.series", 2);
  ck_assert_int_eq(fmu_enter(&instance, 0), OK);
  ck_assert_int_ne(fmu_exit(&instance), OK);
  ck_assert_msg(strstr(last_message, "an FMU contains a single actuator") != NULL, "%s", last_message);
  fmu_free(&instance);
  fmu_close(&fmu);
}

/* A network: two actuators on bodies that turn, one on a channel of its own; forces on bodies. */
static const char network[] =
    "mesh.nodes: 9\nsolver: {end_time: 20 ms, tolerance: 1e-4}\n"
    "bodies:\n  arm: {moves: plane, mass: 6 g, inertia: 2000 g mm2, at: [0, -6 mm]}\n  hand: {mass: 3 g, at: [0, -12 "
    "mm]}\n"
    "joints: {pivot: {between: [frame, arm], at: [-60 mm, -6 mm]}}\n"
    "members:\n  lifts: {upper: frame, lower: arm}\n"
    "  grips: {upper: arm, lower: hand, upper_at: [0, -1 mm], drive: {waveform: sine, voltage: 3 kV, offset: 1 kV, "
    "frequency: 50 Hz}}\ndrive.voltage: 4 kV\n";

static const struct {
  const char *input;
  double value;
} set_in_network[] = {
    {"voltage", 3e3}, {"grips.voltage", 1.5e3}, {"arm.torque", 1e-3}, {"arm.force_x", 5e-3}, {"hand.force_y", -4e-3}};

/* Outputs of the FMU, and columns of the table of a run. */
static const char *const seen_in_network[][2] = {{"lifts.opening", "lifts.opening_m"},
                                                 {"grips.electrode_voltage", "grips.voltage_V"},
                                                 {"arm.x", "arm.x_m"},
                                                 {"arm.angle", "arm.angle_rad"},
                                                 {"hand.y", "hand.y_m"},
                                                 {"charge", "charge_C"}};

/* The simulation of it by inputs of the same names, 10 ms long => numbers of the table. */
static void simulate_network(const char *text, double *number) {
  ZpScenario *scenario = new_scenario();
  ZpActuatorDef def = {0};
  ZpError err;
  ck_assert_int_eq(zp_scenario_parse(scenario, text, strlen(text), "network.yaml", &err), ZP_OK);
  ck_assert_int_eq(zp_scenario_def(scenario, 0, &def, &err), ZP_OK);
  ck_assert_int_eq(zp_def_forget_ports(&def, &err), ZP_OK);
  ZpSim *sim = data_sim_of(&def);
  for (size_t k = 0; k < LENGTH_OF(set_in_network); k++)
    ck_assert_msg(zp_sim_set_input(sim, (ZpInput)zp_def_input_find(&def, set_in_network[k].input),
                                   set_in_network[k].value, 0, &err) == ZP_OK,
                  "%s", err.message);
  ZpRunInfo *info = zp_run_info_create();
  for (int k = 0; k < 10; k++)
    zp_sim_step(sim, (k + 1) * 1e-3 - k * 1e-3, NULL, info);
  zp_run_info_destroy(info);
  ZpTable *columns = zp_signal_table(&def, 1);
  double *row = calloc(zp_sim_columns(sim), sizeof *row);
  zp_sim_read_columns(sim, zp_sim_columns(sim), row);
  for (size_t k = 0; k < LENGTH_OF(seen_in_network); k++)
    for (size_t c = 0; c < zp_table_columns(columns); c++)
      if (strcmp(zp_table_column(columns, c)->name, seen_in_network[k][1]) == 0) number[k] = row[c];
  free(row);
  zp_table_destroy(columns);
  zp_def_clear(&def);
}

VERSION_TESTS(network_is_that_of_a_program) {
  double number[LENGTH_OF(seen_in_network)];
  char path[128];
  snprintf(path, sizeof path, "%s-network-%d.yaml", scratch, _i);
  write_file(path, network);
  simulate_network(network, number);
  Fmu fmu = made(_i, path);
  Instance instance = new_instance(&fmu);
  fmu_start(&instance);
  for (size_t k = 0; k < LENGTH_OF(set_in_network); k++)
    fmu_set(&instance, set_in_network[k].input, set_in_network[k].value);
  void *state = NULL;
  for (int k = 0; k < 5; k++)
    must_step(&instance, k * 1e-3, (k + 1) * 1e-3 - k * 1e-3);
  ck_assert_int_eq(fmu_get_state(&instance, &state), OK);
  for (int again = 0; again < 2; again++) {
    for (int k = 5; k < 10; k++)
      must_step(&instance, k * 1e-3, (k + 1) * 1e-3 - k * 1e-3);
    for (size_t k = 0; k < LENGTH_OF(number); k++)
      ck_assert_msg(fmu_get(&instance, seen_in_network[k][0]) == number[k], "%s = %.17g, expected %.17g",
                    seen_in_network[k][0], fmu_get(&instance, seen_in_network[k][0]), number[k]);
    ck_assert_int_eq(fmu_set_state(&instance, state), OK);
  }
  ck_assert_int_eq(fmu_free_state(&instance, &state), OK);
  ck_assert_int_eq(fmu_reset(&instance), OK);
  fmu_set(&instance, "bodies.hand.mass", 4e-3);
  fmu_start(&instance);
  must_step(&instance, 0, 1e-3);
  ck_assert_double_lt(fmu_get(&instance, "hand.y"), number[4] - 1e-4); /* it hangs lower */
  fmu_free(&instance);
  fmu_close(&fmu);
}

/* What the command refuses, and that nothing is written then. */
TEST(wrong_commands) {
  static const struct {
    const char *arguments;
    int status;
  } wrong[] = {{"fmu", 2},
               {"fmu --fmi 1 -o no.fmu", 2},
               {"fmu --jobs 2 -o no.fmu", 2},
               {"fmu --json -o no.fmu", 2},
               {"stationary --fmi 2", 2},
               {"fmu --set 'load.mass=[1 g, 2 g]' -o no.fmu", 2},
               {"fmu --set load.mass=1m -o no.fmu", 2},
               {"fmu --set drive.waveform=sine --set drive.offset=-2kV --set drive.frequency=5 -o no.fmu", 2},
               {"fmu --set initial.state=checkpoint --set initial.file=none.zps -o no.fmu", 2},
               {"fmu -o /nowhere/at/all/no.fmu", 3}};
  for (size_t k = 0; k < LENGTH_OF(wrong); k++)
    run_command(ZP_COMMAND " %s >/dev/null 2>&1; test $? = %d && test ! -e no.fmu", wrong[k].arguments,
                wrong[k].status);
  run_command(ZP_COMMAND " fmu --set drive.waveform=sine --set drive.offset=-2kV -o no.fmu 2>&1 | grep -q "
                         "'drive.offset: the voltage is -2000 V at t = 0'");
}
