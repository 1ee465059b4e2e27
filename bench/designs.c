/* Are equilibria lost, and is what is found possible? Random sensible designs, drawn from a seed.
 *
 *   designs STUDY|all [COUNT [SEED]]     each study: how many designs end with an answer that violates no bound; every
 *                                        other one as a command that can be pasted. Status 1 if there is one
 *   designs kept FILE                    those commands of a file, one a line
 *   designs agree [COUNT [SEED [PART]]]  do `limits`, which finds its limits as such, and `equilibrium`, which follows
 *                                        the curve, agree to PART (1e-3)?
 *   designs errors [COUNT [SEED [STUDY]]]   the estimated errors of limits, stationary, modes and isometric beside the
 *                                        true ones, which a mesh of 481 nodes shows, and one of
 *                                        361 how well
 *   designs times [COUNT [SEED]]         that of the zip time beside the one that 241 nodes and a tolerance of 1e-5
 *                                        show; designs of more than 61 nodes are left out
 *   designs tolerance [COUNT [SEED]]     how many zip times of at most 61 nodes have errors of at most 3 and 10
 *                                        tolerances
 *   designs liquid [COUNT [SEED [FIRST]]]   zips in a bath or with beads of oil, of 0.5 to 5000 mm2/s, at 2 to 15 kV:
 *                                        how many of the designs from FIRST (0) to COUNT - 1 end with an answer; as for
 *                                        the studies
 *   designs tilt [COUNT [SEED [NODES]]]  `stationary` and `limits` of whole actuators that lean by more than 90
 *                                        degrees, with at most NODES nodes (61): as for the studies
 *   designs supply [COUNT [SEED [FIRST]]]   motions of 21 nodes behind supplies: every preset, or random ones with a
 *                                        resistance from 0 to 1 Gohm, a capacitance from 0 to 1 nF, limits of the
 *                                        current from 1 uA to 1 kA; with and without cap, in every liquid, with
 *                                        tolerances of 1e-3 to 1e-6: as for liquid
 *   designs loads [COUNT [SEED [NODES]]]   the largest load at ten voltages (with 31 nodes): from scratch and from the
 *                                        voltage before to 1e-6, and against its definition, by which drive.voltage
 *                                        closes slightly less and none of some larger loads
 *   designs ramp [COUNT [SEED]]          do `limits` and a slow ramp of the voltage in time close and open the actuator
 *                                        at the same voltages to 1 %, with 61 nodes or more, or where the mesh is too
 *                                        coarse to 1 % beyond what half the elements' length changes? Status 1 if one
 *                                        does not
 */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "draw.h"

/* -- drawing ------------------------------------------------------------------------------------------ */

static double uniform(uint64_t *state, double from, double to) {
  return from + (to - from) * draw(state);
}

typedef struct Metal {
  double young_modulus, poisson_ratio, density;
} Metal;

/* Steel, copper, aluminium, PET; oil or air everywhere, without drag; the platform is a tenth of the length. */
static ZpActuatorDef design(uint64_t *state) {
  static const Metal metals[] = {{200e9, 0.285, 7850}, {120e9, 0.34, 8960}, {70e9, 0.33, 2700}, {4.5e9, 0.38, 1390}};
  ZpActuatorDef def = zp_actuator_def_default();
  def.liquid.model = ZP_LIQUID_NONE;
  def.ribbon.thickness = log_uniform(state, 10e-6, 500e-6);
  def.ribbon.length = log_uniform(state, 10e-3, 300e-3);
  def.ribbon.width = log_uniform(state, 3e-3, 40e-3);
  def.load.mass = log_uniform(state, 0.1e-3, 2);
  if (draw(state) < 0.1) def.load.mass = 0;
  def.mesh.nodes = (int)log_uniform(state, 21, 242);
  def.insulator.thickness = log_uniform(state, 10e-6, 500e-6);
  def.drive.voltage = uniform(state, 0.2e3, 15e3);
  const Metal *metal = &metals[(int)uniform(state, 0, 4)];
  def.ribbon.young_modulus = metal->young_modulus;
  def.ribbon.poisson_ratio = metal->poisson_ratio;
  def.ribbon.density = metal->density;
  bool air = draw(state) < 0.5;
  if (air) def.medium.permittivity = 1;
  if (air) def.medium.breakdown_field = 3e6;
  def.electro.breakdown_cap = draw(state) < 0.5;
  def.platform.length = 0.1 * def.ribbon.length;
  def.output.errors = false;
  return def;
}

/* What a study asks besides: the platform is held at up to 0.3 of the length (a part of its own stream, so that a
 * design does not depend on the study); frequencies are asked for at half the drive's voltage. */
static ZpActuatorDef design_for(ZpStudy study, uint64_t *state) {
  uint64_t own = *state ^ 0x5851f42d4c957f2du;
  ZpActuatorDef def = design(state);
  if (study == ZP_STUDY_ISOMETRIC || study == ZP_STUDY_PROFILE)
    def.isometric.separation = def.ribbon.length * log_uniform(&own, 3e-3, 0.3);
  if (study == ZP_STUDY_MODES) def.modes.voltage = 0.5 * def.drive.voltage;
  if (study == ZP_STUDY_CYCLE) {
    def.drive.waveform = ZP_WAVEFORM_SINE;
    def.drive.frequency = log_uniform(&own, 0.5, 50);
    def.liquid.model = draw(&own) < 0.5 ? ZP_LIQUID_SUBMERGED : ZP_LIQUID_NONE;
    def.mesh.nodes = (int)log_uniform(&own, 15, 42);
  }
  return def;
}

/* -- bounds ------------------------------------------------------------------------------------------- */

/* Liquid that stands for both insulators, m. */
static double insulators(const ZpActuatorDef *def) {
  return 2 * def->insulator.thickness * def->medium.permittivity / def->insulator.permittivity;
}

/* m, eq. (9.7) */
static double contact_range(const ZpActuatorDef *def) {
  return fmax(0.5e-6 * (2 * def->insulator.thickness / 260e-6), 1e-9);
}

/* m, theory section 9 */
static double contact_depth(const ZpActuatorDef *def) {
  return fmin(contact_range(def), fmax(insulators(def) / 150, 1e-9));
}

/* How far faces may overlap, m: two ranges of contact, 2 % of the insulators, or three times what the attraction of
 * closed faces makes of the depth of contact where it exceeds the one at the insulators' breakdown. (Behind a front the
 * bent ribbons press on closed faces like a lever: 8 times the attraction, measured.) Theory, eqs. (9.1) and (9.2). */
static double deepest(const ZpActuatorDef *def) {
  static const double ranges = 2, of_insulators = 0.02, lever = 3;
  double depth = contact_depth(def);
  double at_breakdown = 2 * def->insulator.thickness * def->insulator.breakdown_field;
  double over = def->electro.breakdown_cap ? 1 : pow(def->drive.voltage / at_breakdown, 2);
  double pressed = lever * depth * cbrt(fmax(over, 1));
  return fmax(fmax(ranges * contact_range(def), of_insulators * 2 * def->insulator.thickness), pressed);
}

/* Of faces that overlap as far as they may, F. */
static double closed_capacitance(const ZpActuatorDef *def) {
  static const double eps0 = 8.8541878128e-12, stretched = 1.01; /* ribbons under load are longer */
  double apart = insulators(def) - deepest(def);
  return stretched * eps0 * def->medium.permittivity * def->ribbon.width * def->ribbon.length / apart;
}

static double least_gap(const ZpShape *shape, size_t nodes) {
  double least = INFINITY;
  for (size_t i = 0; shape->gap && i < nodes; i++)
    least = fmin(least, shape->gap[i]);
  return least;
}

static bool has_column(const ZpTable *table, const char *name) {
  for (size_t k = 0; k < table->columns; k++)
    if (strcmp(table->column[k].name, name) == 0) return true;
  return false;
}

/* Does any row have a value of the column outside [least, most]? */
static bool leaves(const ZpTable *table, const char *name, double least, double most) {
  if (!table || !has_column(table, name)) return false;
  for (size_t k = 0; k < table->rows; k++) {
    double value = zp_table_get(table, k, name);
    if (value < least || value > most) return true;
  }
  return false;
}

static bool says_negative_voltage(const char *text) {
  for (const char *at = strstr(text, " -"); at; at = strstr(at + 1, " -")) {
    char *end;
    if (strtod(at, &end) < 0 && strncmp(end, " V", 2) == 0) return true;
  }
  return false;
}

/* => what is impossible about an answer; NULL if nothing is. In motion faces may bounce deeper. */
static const char *violated(const ZpActuatorDef *def, const ZpResult *r) {
  double release = zp_result_get(r, "release_voltage_V"), closing = zp_result_get(r, "closing_voltage_V");
  if (release > closing) return "release above closing";
  if (says_negative_voltage(r->message)) return "a negative voltage in the message";
  bool ideal = def->source.model == ZP_SOURCE_IDEAL; /* behind others a charge that is kept has any voltage */
  if (ideal && leaves(r->series, "voltage_V", 0, 1.001 * def->drive.voltage))
    return "a voltage outside 0 ... drive.voltage";
  bool at_rest = r->study == ZP_STUDY_EQUILIBRIUM || r->study == ZP_STUDY_LIMITS || r->study == ZP_STUDY_ISOMETRIC;
  if (at_rest && leaves(r->series, "capacitance_F", 0, closed_capacitance(def)))
    return "capacitance above that of closed plates";
  for (size_t k = 0; at_rest && r->shapes && k < r->shapes->frames; k++) {
    ZpShape shape = zp_shapes_get(r->shapes, k);
    if (least_gap(&shape, r->shapes->nodes) < -deepest(def)) return "faces overlap";
  }
  return NULL;
}

/* -- every study -------------------------------------------------------------------------------------- */

static double cpu_s(void) {
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool is_late(void *until, const char *stage, double fraction) {
  (void)stage, (void)fraction;
  return cpu_s() > *(const double *)until;
}

/* => is there an answer within two minutes of CPU time, or a reason why there is none (ribbons may lie as the model
 * does not describe), and can it be? If not, `text` says why. */
static bool is_answered(ZpStudy study, const ZpActuatorDef *def, char text[512]) {
  ZpResult *result = NULL;
  ZpError err = {ZP_OK, ""};
  double until = cpu_s() + 120;
  const ZpHooks hooks = {.user = &until, .progress = is_late};
  if (zp_study_run(study, def, NULL, &hooks, &result, &err) != ZP_OK) {
    snprintf(text, 512, "refused: %.490s", err.message);
    return false;
  }
  const char *fault = violated(def, result);
  bool good = (zp_outcome_good(result->outcome) || result->outcome == ZP_BEYOND_MODEL) && !fault;
  snprintf(text, 512, "%s%s%s: %s", fault ? fault : "", fault ? "; " : "", zp_outcome_name(result->outcome),
           result->message);
  zp_result_destroy(result);
  return good;
}

/* The whole of a design, leaning by more than 90 degrees to either side, so that its ribbons lie on each other. */
static ZpActuatorDef design_that_leans(uint64_t *state, int most_nodes) {
  static const double pi = 3.14159265358979323846;
  ZpActuatorDef def = design(state);
  def.mount.tilt = uniform(state, 0.5 * pi, pi) * (draw(state) < 0.5 ? -1 : 1);
  def.actuator.symmetry = ZP_SYMMETRY_NONE;
  if (def.mesh.nodes > most_nodes) def.mesh.nodes = most_nodes;
  return def;
}

/* => how many of the designs have no answer */
static int check_tilt(ZpStudy study, int designs, uint64_t seed, int most_nodes) {
  int bad = 0;
  double start = cpu_s(), slowest = 0;
  for (int i = 0; i < designs; i++) {
    char text[512];
    ZpActuatorDef def = design_that_leans(&seed, most_nodes);
    double begun = cpu_s();
    bool answered = is_answered(study, &def, text);
    slowest = fmax(slowest, cpu_s() - begun);
    if (answered) continue;
    bad++;
    printf("design %d: zipact %s", i, zp_study_name(study));
    print_design(&def);
    printf("  %s\n", text);
    fflush(stdout);
  }
  printf("tilt, %s: %d of %d designs answered, %.2f s of CPU, the slowest %.2f s\n", zp_study_name(study),
         designs - bad, designs, cpu_s() - start, slowest);
  return bad;
}

/* (what is_answered has said) */
static bool is_beyond_model(const char *text) {
  const char *word = zp_outcome_name(ZP_BEYOND_MODEL);
  return strncmp(text, word, strlen(word)) == 0;
}

/* => how many of the designs have no answer */
static int check_study(ZpStudy study, int designs, uint64_t seed) {
  int bad = 0, beyond = 0;
  double start = cpu_s();
  for (int i = 0; i < designs; i++) {
    char text[512];
    ZpActuatorDef def = design_for(study, &seed);
    bool answered = is_answered(study, &def, text);
    beyond += answered && is_beyond_model(text);
    if (answered) continue;
    bad++;
    printf("design %d: zipact %s", i, zp_study_name(study));
    print_design(&def);
    printf("  %s\n", text);
    fflush(stdout);
  }
  printf("%s: %d of %d designs answered, %d of them beyond the model, %.2f s of CPU\n", zp_study_name(study),
         designs - bad, designs, beyond, cpu_s() - start);
  return bad;
}

/* Everything but calibrate, which asks for measurements. */
static const ZpStudy every[] = {ZP_STUDY_EQUILIBRIUM, ZP_STUDY_LIMITS,  ZP_STUDY_ISOMETRIC, ZP_STUDY_MODES,
                                ZP_STUDY_STATIONARY,  ZP_STUDY_PROFILE, ZP_STUDY_ACTUATE,   ZP_STUDY_CYCLE};

/* "--set KEY=VALUE", as print_design() writes it. */
static bool take_option(ZpActuatorDef *def, char *option, ZpError *err) {
  char *value = strchr(option, '=');
  if (!value) return false;
  *value++ = '\0';
  int key = zp_key_find(option);
  if (key < 0) return false;
  const ZpKey *about = zp_key(key);
  double number = strcmp(value, "true") == 0 ? 1 : strtod(value, NULL);
  for (int k = 0; about->type == ZP_KEY_ENUM && k <= (int)about->max; k++)
    if (strcmp(about->choices[k].word, value) == 0) number = k;
  return zp_def_set(def, key, number, err) == ZP_OK;
}

/* "zipact STUDY --set KEY=VALUE ..." */
static bool take_command(char *line, ZpStudy *study, ZpActuatorDef *def, ZpError *err) {
  char *rest, *word = strtok_r(line, " \n", &rest);
  if (!word || strcmp(word, "zipact") != 0 || !(word = strtok_r(NULL, " \n", &rest))) return false;
  size_t k = 0, studies = sizeof every / sizeof every[0];
  while (k < studies && strcmp(zp_study_name(every[k]), word) != 0)
    k++;
  if (k == studies) return false;
  *study = every[k];
  *def = zp_actuator_def_default();
  while ((word = strtok_r(NULL, " \n", &rest)) != NULL)
    if (strcmp(word, "--set") != 0 && !take_option(def, word, err)) return false;
  return true;
}

/* => how many of the commands of a file have no answer */
static int check_kept(const char *path) {
  char line[8192], copy[8192], text[512];
  int bad = 0, looked = 0;
  FILE *file = fopen(path, "r");
  if (!file) return perror(path), 1;
  while (fgets(line, sizeof line, file)) {
    ZpStudy study;
    ZpActuatorDef def = {0};
    ZpError err = {ZP_OK, "no command of a study"};
    if (line[0] == '#') continue;
    strcpy(copy, line);
    looked++;
    bool taken = take_command(copy, &study, &def, &err);
    if (taken && is_answered(study, &def, text)) continue;
    bad++;
    printf("%s  %s\n", line, taken ? text : err.message);
  }
  fclose(file);
  printf("%s: %d of %d designs answered\n", path, looked - bad, looked);
  return bad;
}

/* Do the designs from `first` on have an answer to study actuate? => how many have none */
static int check_motions(const char *what, ZpActuatorDef (*draws)(uint64_t *state), int designs, uint64_t seed,
                         int first) {
  int bad = 0;
  double start = cpu_s(), slowest = 0;
  for (int i = 0; i < designs; i++) {
    char text[512];
    ZpActuatorDef def = draws(&seed);
    if (i < first) continue;
    double begun = cpu_s();
    bool answered = is_answered(ZP_STUDY_ACTUATE, &def, text);
    slowest = fmax(slowest, cpu_s() - begun);
    if (answered) continue;
    bad++;
    printf("design %d: zipact actuate", i);
    print_design(&def);
    printf("  %s\n", text);
    fflush(stdout);
  }
  int looked = designs > first ? designs - first : 0;
  printf("%s: %d of %d designs answered, %.2f s of CPU, the slowest %.2f s\n", what, looked - bad, looked,
         cpu_s() - start, slowest);
  return bad;
}

/* -- in liquid ----------------------------------------------------------------------------------------- */

/* A design as above in oil: in a bath, or with beads of which half have suction. */
static ZpActuatorDef design_in_liquid(uint64_t *state) {
  ZpActuatorDef def = design(state);
  def.liquid.model = draw(state) < 0.3 ? ZP_LIQUID_SUBMERGED : ZP_LIQUID_BEAD;
  def.medium.permittivity = zp_actuator_def_default().medium.permittivity;
  def.medium.breakdown_field = zp_actuator_def_default().medium.breakdown_field;
  def.medium.kinematic_viscosity = log_uniform(state, 0.5e-6, 5e-3);
  def.drive.voltage = log_uniform(state, 2e3, 15e3);
  def.bead.volume = log_uniform(state, 5e-9, 500e-9);
  def.bead.suction = draw(state) < 0.5 ? 0 : draw(state);
  def.bead.returned = draw(state);
  return def;
}

/* -- behind a supply ----------------------------------------------------------------------------------- */

/* Nothing, or up to `most` times as much as `least`. */
static double none_or(uint64_t *state, double share_of_none, double none, double least, double most) {
  bool is_none = draw(state) < share_of_none;
  double value = log_uniform(state, least, most);
  return is_none ? none : value;
}

static void draw_supply(uint64_t *state, ZpActuatorDef *def) {
  def->source.resistance = none_or(state, 0.3, 0, 1e-3, 1e9);
  def->source.capacitance = none_or(state, 0.4, 0, 1e-14, 1e-9);
  def->source.current_limit = none_or(state, 0.3, NAN, 1e-6, 1e3);
  def->source.sink_limit = draw(state) < 0.2 ? 0 : none_or(state, 0.6, NAN, 1e-6, 1e3);
  def->source.slew_rate = none_or(state, 0.6, NAN, 1e4, 1e10);
  def->source.bandwidth = none_or(state, 0.6, NAN, 1, 1e5);
  def->source.bleeder = none_or(state, 0.7, NAN, 1e6, 1e12);
}

static void draw_waveform(uint64_t *state, ZpActuatorDef *def) {
  static const ZpWaveformKind kinds[] = {ZP_WAVEFORM_STEP, ZP_WAVEFORM_STEP, ZP_WAVEFORM_RAMP, ZP_WAVEFORM_SQUARE,
                                         ZP_WAVEFORM_SINE};
  double frequency = log_uniform(state, 10, 500), rise = draw(state);
  ZpWaveformKind kind = def->drive.waveform = kinds[(int)uniform(state, 0, 5)];
  if (kind == ZP_WAVEFORM_SQUARE || kind == ZP_WAVEFORM_SINE) def->drive.frequency = frequency;
  if (kind == ZP_WAVEFORM_RAMP) def->drive.rise_time = 0.03 * rise * rise * rise;
  if (kind == ZP_WAVEFORM_SQUARE && rise > 0.5) def->drive.rise_time = 0.2 * rise / frequency;
}

/* The keys of a preset, where there is one. */
static ZpActuatorDef supplied(const ZpActuatorDef *def, ZpSupplyName supply) {
  const ZpActuatorDef plain = zp_actuator_def_default();
  ZpAssignment list[64];
  size_t count = 0;
  for (int k = 0; k < zp_key_count(); k++) {
    double value = zp_def_get(def, k), usual = zp_def_get(&plain, k);
    if (!isnan(value) && value != usual) list[count++] = (ZpAssignment){k, value};
  }
  list[count++] = (ZpAssignment){zp_key_find("source.supply"), supply};
  ZpActuatorDef all = {0};
  return zp_def_resolve(&all, list, count, NULL) == ZP_OK ? all : *def;
}

static ZpActuatorDef design_behind_supply(uint64_t *state) {
  ZpActuatorDef def = draw(state) < 0.4 ? design(state) : design_in_liquid(state);
  ZpSupplyName supply = (ZpSupplyName)uniform(state, 0, 10);
  if (supply > ZP_SUPPLY_CONVERTER_10KV) supply = ZP_SUPPLY_NONE;
  def.mesh.nodes = 21;
  def.source.model = ZP_SOURCE_AMPLIFIER;
  draw_waveform(state, &def);
  def.solver.tolerance = log_uniform(state, 1e-6, 1e-3);
  def.solver.end_time = 0.03;
  def.output.samples = 100;
  if (supply == ZP_SUPPLY_NONE) draw_supply(state, &def);
  if (supply != ZP_SUPPLY_NONE) def = supplied(&def, supply);
  if (def.drive.voltage > def.source.voltage_limit) def.drive.voltage = def.source.voltage_limit;
  return def;
}

/* -- limits against equilibrium ----------------------------------------------------------------------- */

enum { LIMITS, EQUILIBRIUM, STUDIES, VOLTAGES = 3 };

static const ZpStudy study[STUDIES] = {ZP_STUDY_LIMITS, ZP_STUDY_EQUILIBRIUM};
static const char *const name[VOLTAGES] = {"pull_in_voltage_V", "closing_voltage_V", "release_voltage_V"};

typedef struct Answer {
  bool good;
  double voltage[VOLTAGES];
  char message[512];
} Answer;

static Answer answer_of(ZpStudy which, const ZpActuatorDef *def) {
  ZpResult *result = NULL;
  ZpError err = {ZP_OK, ""};
  Answer answer = {.good = false};
  if (zp_study_run(which, def, NULL, NULL, &result, &err) != ZP_OK) {
    snprintf(answer.message, sizeof answer.message, "refused: %.490s", err.message);
    return answer;
  }
  answer.good = zp_outcome_good(result->outcome);
  for (int k = 0; k < VOLTAGES; k++)
    answer.voltage[k] = zp_result_get(result, name[k]);
  snprintf(answer.message, sizeof answer.message, "%s: %s", zp_outcome_name(result->outcome), result->message);
  zp_result_destroy(result);
  return answer;
}

/* How far apart two voltages are, relative; INFINITY: one of them does not exist. */
static double apart(double a, double b) {
  if (isnan(a) && isnan(b)) return 0;
  return isnan(a) || isnan(b) ? (double)INFINITY : fabs(a / b - 1);
}

typedef struct Count {
  int good[STUDIES], both, polished[VOLTAGES], same[VOLTAGES], all_same;
} Count;

/* => do both studies give these answers? */
static bool compare(const Answer answer[STUDIES], double part, Count *count) {
  static const double polished = 1e-6;
  bool all = answer[LIMITS].good && answer[EQUILIBRIUM].good;
  for (int s = 0; s < STUDIES; s++)
    count->good[s] += answer[s].good;
  count->both += all;
  for (int k = 0; k < VOLTAGES && answer[LIMITS].good && answer[EQUILIBRIUM].good; k++) {
    double d = apart(answer[LIMITS].voltage[k], answer[EQUILIBRIUM].voltage[k]);
    count->polished[k] += d <= polished;
    count->same[k] += d <= part;
    all = all && d <= part;
  }
  count->all_same += all;
  return all;
}

/* => how many of the designs get different answers */
static int check_agreement(int designs, uint64_t state, double part) {
  Count count = {.both = 0};
  for (int i = 0; i < designs; i++) {
    ZpActuatorDef def = design(&state);
    Answer answer[STUDIES] = {answer_of(study[LIMITS], &def), answer_of(study[EQUILIBRIUM], &def)};
    if (compare(answer, part, &count)) continue;
    printf("design %d:", i);
    print_design(&def);
    for (int s = 0; s < STUDIES; s++)
      printf("  %-11s %.9g %.9g %.9g V; %s\n", zp_study_name(study[s]), answer[s].voltage[0], answer[s].voltage[1],
             answer[s].voltage[2], answer[s].message);
  }
  for (int s = 0; s < STUDIES; s++)
    printf("%s: a good end in %d of %d\n", zp_study_name(study[s]), count.good[s], designs);
  for (int k = 0; k < VOLTAGES; k++)
    printf("%s: the same to 1e-6 in %d, to %g in %d of %d with two good ends\n", name[k], count.polished[k], part,
           count.same[k], count.both);
  printf("all the same: %d of %d\n", count.all_same, designs);
  return designs - count.all_same;
}

/* -- the largest load against its definition ----------------------------------------------------------- */

/* Shares of the largest load, the first of which drive.voltage closes, and no other. */
static const double share[] = {0.999, 1.001, 1.01, 1.03, 1.1, 1.3};
enum { SHARES = sizeof share / sizeof share[0] };

typedef struct LoadCount {
  int voltages, none, apart, lost, wrong[SHARES], right;
  double cold_s, warm_s;
} LoadCount;

/* => study limits, from a neighbour if there is one; NULL if it fails */
static ZpResult *limits_from(const ZpActuatorDef *def, const ZpResult *near, double *seconds) {
  const ZpStudyInput input = {.neighbour = near};
  ZpResult *result = NULL;
  double start = cpu_s();
  if (zp_study_run(ZP_STUDY_LIMITS, def, &input, NULL, &result, NULL) != ZP_OK) return NULL;
  *seconds += cpu_s() - start;
  return result;
}

/* => does drive.voltage close it exactly up to this load? */
static bool is_largest(ZpActuatorDef def, double load, LoadCount *count) {
  bool all = true;
  for (int k = 0; k < SHARES; k++) {
    def.load.mass = share[k] * load;
    bool closes = !isnan(answer_of(ZP_STUDY_LIMITS, &def).voltage[1]), right = closes == (share[k] < 1);
    count->wrong[k] += !right;
    if (!right) printf("  %s at %g times the largest load\n", closes ? "closes" : "does not close", share[k]);
    all = all && right;
  }
  return all;
}

/* => the result from the neighbour, which replaces it */
static ZpResult *check_load(int design, const ZpActuatorDef *def, ZpResult *near, LoadCount *count) {
  static const double same = 1e-6;
  ZpResult *cold = limits_from(def, NULL, &count->cold_s), *warm = limits_from(def, near, &count->warm_s);
  zp_result_destroy(near);
  bool good = cold && warm && zp_outcome_good(cold->outcome) && zp_outcome_good(warm->outcome);
  double from_cold = cold ? zp_result_get(cold, "max_load_kg") : NAN,
         from_warm = warm ? zp_result_get(warm, "max_load_kg") : NAN, off = apart(from_cold, from_warm);
  count->voltages++;
  count->lost += !good;
  count->none += isnan(from_cold);
  count->apart += off > same;
  bool right = good && off <= same && (isnan(from_cold) || is_largest(*def, from_cold, count));
  count->right += right;
  if (!right)
    printf("design %d: %.10g kg from scratch, %.10g from a neighbour; %s\n  zipact limits", design, from_cold,
           from_warm, warm ? warm->message : "");
  if (!right) print_design(def);
  zp_result_destroy(cold);
  return warm;
}

/* => how many largest loads are not what they should be */
static int check_loads(int designs, uint64_t seed, int nodes) {
  enum { STEPS = 10 };
  static const double least = 0.55, step = 0.05; /* of the design's voltage */
  LoadCount count = {.voltages = 0};
  for (int i = 0; i < designs; i++) {
    ZpActuatorDef def = design(&seed);
    double top = def.drive.voltage;
    ZpResult *near = NULL;
    def.mesh.nodes = nodes;
    for (int k = 0; k < STEPS; k++) {
      def.drive.voltage = top * (least + k * step);
      near = check_load(i, &def, near, &count);
    }
    zp_result_destroy(near);
  }
  printf("loads: %d of %d right, %d without a largest load, %d lost; %d differ from a neighbour's; closing is wrong at",
         count.right, count.voltages, count.none, count.lost, count.apart);
  for (int k = 0; k < SHARES; k++)
    printf(" %g times: %d%s", share[k], count.wrong[k], k + 1 < SHARES ? "," : "");
  printf("; %.2f ms from scratch, %.2f ms from a neighbour\n", 1e3 * count.cold_s / count.voltages,
         1e3 * count.warm_s / count.voltages);
  return count.voltages - count.right;
}

/* -- estimated errors against true ones -------------------------------------------------------------- */

/* A number of a study, its estimated error, and over the designs: how often the estimate is above the true error, and
 * by what factor; how many are left out, since what should be converged is not. */
typedef struct Estimated {
  ZpStudy study;
  const char *scalar, *error;
  int designs, covered, unknown;
  double *factor;
} Estimated;

#define ZP_ESTIMATE(study, scalar, error, unit, safety, law) {study, scalar, error, 0, 0, 0, NULL},
static Estimated estimated[] = {
#include <zipact/studies.def>
};
#undef ZP_ESTIMATE

enum { NUMBERS = sizeof estimated / sizeof estimated[0] };

static ZpResult *result_of(ZpStudy which, const ZpActuatorDef *def) {
  ZpResult *result = NULL;
  if (zp_study_run(which, def, NULL, NULL, &result, NULL) == ZP_OK && zp_outcome_good(result->outcome)) return result;
  zp_result_destroy(result);
  return NULL;
}

/* How a design is solved all but exactly, and twice more to see how exactly: with one check, rounding errors agree by
 * chance too often. */
enum { CONVERGED, CHECK, SECOND_CHECK, REFERENCES };

static ZpActuatorDef refined(ZpStudy which, const ZpActuatorDef *def, int reference) {
  static const int at_rest[REFERENCES] = {481, 361, 421}, in_motion[REFERENCES] = {241, 181, 211};
  static const double tolerance[REFERENCES] = {1e-5, 2e-5, 1.4e-5};
  bool moves = which == ZP_STUDY_ACTUATE;
  ZpActuatorDef fine = *def;
  fine.output.errors = false;
  fine.mesh.nodes = (moves ? in_motion : at_rest)[reference];
  if (moves) fine.solver.tolerance = tolerance[reference];
  if (moves) fine.solver.stop_when_zipped = ZP_WHEN_TRUE;
  return fine;
}

/* Is an error a few times larger than the distance of each check from what should be converged? */
static bool is_known(const char *scalar, double off, ZpResult *fine[REFERENCES]) {
  static const double times = 4;
  double converged = zp_result_get(fine[CONVERGED], scalar);
  for (int k = CHECK; k < REFERENCES; k++)
    if (!(off >= times * fabs(zp_result_get(fine[k], scalar) - converged))) return false;
  return true;
}

/* Errors below what the solvers' tolerances leave say nothing about the mesh, and those below a few times the distance
 * of the references say nothing about the estimate. (A held force of 5 mN at 481 nodes has 1e-4 of rounding errors,
 * which grow with the cube of the nodes.) */
static void count_number(Estimated *e, const ZpActuatorDef *def, const ZpResult *coarse, ZpResult *fine[REFERENCES]) {
  static const double smallest = 1e-7;
  double value = zp_result_get(coarse, e->scalar), estimate = zp_result_get(coarse, e->error);
  double converged = zp_result_get(fine[CONVERGED], e->scalar), off = fabs(value - converged);
  if (isnan(estimate) || isnan(off) || off < smallest * fabs(value)) return;
  bool known = is_known(e->scalar, off, fine);
  e->unknown += !known;
  if (!known) return;
  e->factor[e->designs++] = estimate / off;
  e->covered += estimate >= off;
  if (estimate >= off) return;
  printf("%s %.6g, estimated error %.2g, converged %.6g: zipact %s", e->scalar, value, estimate, converged,
         zp_study_name(e->study));
  print_design(def);
}

static bool has_estimate(const ZpResult *result) {
  for (int k = 0; k < NUMBERS; k++)
    if (estimated[k].study == result->study && !isnan(zp_result_get(result, estimated[k].error))) return true;
  return false;
}

static void count_design(ZpStudy which, ZpActuatorDef def) {
  def.output.errors = true;
  ZpResult *coarse = result_of(which, &def), *fine[REFERENCES] = {NULL, NULL};
  bool all = coarse && has_estimate(coarse);
  for (int k = 0; k < REFERENCES && all; k++) {
    ZpActuatorDef reference = refined(which, &def, k);
    fine[k] = result_of(which, &reference);
    all = fine[k];
  }
  for (int k = 0; all && k < NUMBERS; k++)
    if (estimated[k].study == which) count_number(&estimated[k], &def, coarse, fine);
  zp_result_destroy(coarse);
  for (int k = 0; k < REFERENCES; k++)
    zp_result_destroy(fine[k]);
}

static int rising(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* => how many numbers are covered in less than 95 % of the designs */
static int print_errors(int designs) {
  int bad = 0;
  printf("%-12s %-22s %8s %8s %9s %24s   of %d designs\n", "study", "number", "designs", "left out", "covered",
         "median estimate / error", designs);
  for (int k = 0; k < NUMBERS; k++) {
    Estimated *e = &estimated[k];
    if (e->designs == 0) continue;
    qsort(e->factor, (size_t)e->designs, sizeof(double), rising);
    printf("%-12s %-22s %8d %8d %7.1f %% %24.2f\n", zp_study_name(e->study), e->scalar, e->designs, e->unknown,
           100.0 * e->covered / e->designs, e->factor[e->designs / 2]);
    bad += e->covered < 0.95 * e->designs;
  }
  fflush(stdout);
  return bad;
}

/* As above; long ones say what they have found every now and then. */
static int check_errors(const ZpStudy *studies, int count, int designs, uint64_t seed, int most_nodes) {
  enum { EVERY = 100 };
  for (int k = 0; k < NUMBERS; k++)
    estimated[k].factor = calloc((size_t)designs, sizeof(double));
  for (int i = 0; i < designs; i++) {
    uint64_t state = seed + (uint64_t)i;
    for (int s = 0; s < count; s++) {
      uint64_t same = state;
      ZpActuatorDef def = design_for(studies[s], &same);
      if (def.mesh.nodes <= most_nodes) count_design(studies[s], def);
    }
    if ((i + 1) % EVERY == 0 && i + 1 < designs) print_errors(i + 1);
  }
  int bad = print_errors(designs);
  for (int k = 0; k < NUMBERS; k++)
    free(estimated[k].factor);
  return bad;
}

enum { MOST_NODES = 242 };

/* Of one study alone. */
static int check_errors_of(const char *word, const ZpStudy *studies, int count, int designs, uint64_t seed) {
  for (int s = 0; s < count; s++)
    if (strcmp(word, zp_study_name(studies[s])) == 0) return check_errors(&studies[s], 1, designs, seed, MOST_NODES);
  fprintf(stderr, "%s: no study with estimated errors at rest\n", word);
  return 1;
}

/* -- zip times against their tolerance ----------------------------------------------------------------- */

/* NAN: there is none. */
static double zip_time(const ZpActuatorDef *def, double tolerance) {
  ZpActuatorDef at = *def;
  at.solver.tolerance = tolerance;
  at.solver.stop_when_zipped = ZP_WHEN_TRUE;
  ZpResult *result = result_of(ZP_STUDY_ACTUATE, &at);
  double time = result ? zp_result_get(result, "zip_time_s") : NAN;
  zp_result_destroy(result);
  return time;
}

/* Designs by the error of their zip time: at most so many tolerances, */
typedef struct Kept {
  int designs, within[2];
} Kept;

static const double tolerances_off[2] = {3, 10};

static void count_kept(double error, double tolerance, Kept *kept) {
  kept->designs++;
  for (int k = 0; k < 2; k++)
    kept->within[k] += error <= tolerances_off[k] * tolerance;
}

/* On the mesh of each design, against a tolerance of 1e-7. A zip time that moves by more than 1e-4 from 1e-6 to 1e-7
 * has no limit that could be seen: such actuators swing or bounce before they close. */
static void check_tolerances(int designs, uint64_t seed, int most_nodes) {
  enum { TOLERANCES = 3 };
  static const double tolerance[TOLERANCES] = {1e-3, 1e-4, 1e-5}, settled = 1e-4;
  Kept kept[TOLERANCES] = {{0}};
  int unsettled = 0;
  for (int i = 0; i < designs; i++) {
    uint64_t state = seed + (uint64_t)i;
    ZpActuatorDef def = design_for(ZP_STUDY_ACTUATE, &state);
    double coarse = def.mesh.nodes <= most_nodes ? zip_time(&def, 1e-3) : NAN;
    if (isnan(coarse)) continue;
    double exact = zip_time(&def, 1e-7), near = zip_time(&def, 1e-6);
    bool known = fabs(near / exact - 1) <= settled;
    unsettled += !known;
    for (int k = 0; k < TOLERANCES && known; k++)
      count_kept(fabs((k == 0 ? coarse : zip_time(&def, tolerance[k])) / exact - 1), tolerance[k], &kept[k]);
  }
  printf("%9s %8s %20s %20s   of %d designs; %d do not converge\n", "tolerance", "designs", "within 3 tolerances",
         "within 10", designs, unsettled);
  for (int k = 0; k < TOLERANCES; k++)
    printf("%9g %8d %18.1f %% %18.1f %%\n", tolerance[k], kept[k].designs, 100.0 * kept[k].within[0] / kept[k].designs,
           100.0 * kept[k].within[1] / kept[k].designs);
}

/* -- limits against a slow ramp ------------------------------------------------------------------------ */

/* A simulation whose voltage is a ramp; times in units of the first mode's period. */
typedef struct Ramp {
  ZpSim *sim;
  double period, volts, closed; /* s; V; opening at which it counts as closed, m */
  void *saved;
  size_t size;
} Ramp;

/* The period of the slowest motion of the actuator that hangs, s; NAN if there is none. */
static double period_of(const ZpActuatorDef *def) {
  ZpActuatorDef hanging = *def;
  ZpResult *modes = NULL;
  ZpError err;
  hanging.modes.voltage = 0;
  hanging.output.errors = false;
  if (zp_study_run(ZP_STUDY_MODES, &hanging, NULL, NULL, &modes, &err) != ZP_OK) return NAN;
  double frequency = zp_table_get(modes->series, 0, "frequency_Hz");
  zp_result_destroy(modes);
  return 1 / frequency;
}

static bool is_closed(const Ramp *r) {
  return zp_sim_get(r->sim, "opening") <= r->closed;
}

/* Go to this voltage in `periods`. => that at which the actuator first is open, or closed, where it stops; NAN if it is
 * not on the way */
static double go(Ramp *r, double to, double periods, bool closes) {
  enum { STEPS = 400 };
  ZpError err;
  double from = r->volts, found = NAN;
  zp_sim_set_input(r->sim, ZP_INPUT_VOLTAGE, from, (to - from) / (periods * r->period), &err);
  for (int k = 1; k <= STEPS && isnan(found); k++) {
    if (!zp_outcome_good(zp_sim_step(r->sim, periods * r->period / STEPS, NULL, NULL))) break;
    r->volts = from + (to - from) * k / STEPS;
    if (is_closed(r) == closes) found = r->volts;
  }
  zp_sim_set_input(r->sim, ZP_INPUT_VOLTAGE, r->volts, 0, &err);
  return found;
}

/* The same without a look, and wait there until what that excites has died away. */
static void go_and_wait(Ramp *r, double to) {
  static const double quick = 10; /* periods */
  ZpError err;
  zp_sim_set_input(r->sim, ZP_INPUT_VOLTAGE, r->volts, (to - r->volts) / (quick * r->period), &err);
  zp_sim_step(r->sim, quick * r->period, NULL, NULL);
  r->volts = to;
  zp_sim_set_input(r->sim, ZP_INPUT_VOLTAGE, to, 0, &err);
  zp_sim_step(r->sim, quick * r->period, NULL, NULL);
}

/* The voltage at which it closes, or opens, on a ramp past `near` from the present state, the rate halved until the
 * answer moves by less than 0.2 %. The simulation is where it was on the last ramp. */
static double by_ramp(Ramp *r, double near, bool closes) {
  enum { HALVINGS = 11 };
  static const double beyond = 0.2, enough = 2e-3;
  double from = r->volts, to = near * (closes ? 1 + beyond : 1 - beyond), periods = 20, before = NAN;
  ZpError err;
  zp_sim_save(r->sim, r->saved);
  for (int k = 0; k < HALVINGS; k++, periods *= 2) {
    if (zp_sim_restore(r->sim, r->saved, r->size, &err) != ZP_OK) return NAN;
    r->volts = from;
    double found = go(r, to, periods, closes);
    if (fabs(found / before - 1) < enough) return found;
    before = found;
  }
  return NAN;
}

/* Up past `closing` and down past `release` (NAN: there is none) => both by the ramp. */
static void ramp(Ramp *r, double top, double closing, double release, double found[2]) {
  static const double near = 0.1;
  go_and_wait(r, (1 - near) * closing);
  found[0] = by_ramp(r, closing, true);
  found[1] = NAN;
  if (isnan(found[0]) || isnan(release)) return;
  go_and_wait(r, top);
  go_and_wait(r, fmin((1 + near) * release, top));
  found[1] = by_ramp(r, release, false);
}

/* => is there a simulation, and did it run? Damped to a tenth of the critical: what a ramp excites dies away in some
 * periods, and at a limit point the motion hardly lags. */
static bool run_ramp(ZpActuatorDef def, double closing, double release, double found[2]) {
  ZpModel *model = NULL;
  ZpError err;
  Ramp r = {.period = period_of(&def)};
  def.damping.internal = 0.1 * r.period / 3.14159265358979;
  def.drive.waveform = ZP_WAVEFORM_RAMP; /* set by hand, from 0 */
  def.drive.rise_time = 1;
  bool good =
      r.period > 0 && zp_model_create(&def, &model, &err) == ZP_OK && zp_sim_create(model, NULL, &r.sim, &err) == ZP_OK;
  if (good) r.size = zp_sim_state_size(r.sim);
  if (good) r.saved = malloc(r.size);
  good = good && r.saved;
  if (good) r.closed = fmax(0.01 * zp_sim_get(r.sim, "opening"), contact_depth(&def));
  if (good) ramp(&r, def.drive.voltage, closing, release, found);
  free(r.saved);
  zp_sim_destroy(r.sim);
  zp_model_destroy(model);
  return good;
}

static bool is_off(double limit, double by_time, double beside) {
  static const double part = 0.01;
  return !isnan(limit) && !(fabs(by_time / limit - 1) <= part + beside);
}

/* By how much elements half as long change the closing voltage, relative: on a mesh that is too coarse a front may be
 * held between two nodes, where inertia carries it on or not. */
static double of_the_mesh(ZpActuatorDef def, double closing) {
  def.mesh.nodes = 2 * def.mesh.nodes - 1;
  double fine = answer_of(ZP_STUDY_LIMITS, &def).voltage[1];
  return isnan(fine) ? 0 : fabs(fine / closing - 1);
}

/* => how many designs close or open on a ramp elsewhere than `limits` says */
static int check_ramp(int designs, uint64_t state) {
  int off = 0, looked = 0, released = 0, coarse = 0;
  for (int i = 0; i < designs; i++) {
    ZpActuatorDef def = design(&state);
    if (def.mesh.nodes < 61) def.mesh.nodes = 61;
    def.output.errors = false;
    Answer answer = answer_of(ZP_STUDY_LIMITS, &def);
    double closing = answer.voltage[1], release = answer.voltage[2], found[2] = {NAN, NAN};
    if (!answer.good || isnan(closing)) continue;
    bool ran = run_ramp(def, closing, release, found);
    looked++;
    released += !isnan(release);
    bool opens = ran && !is_off(release, found[1], 0), closes = ran && !is_off(closing, found[0], 0);
    if (opens && closes) continue;
    if (opens && !is_off(closing, found[0], of_the_mesh(def, closing))) {
      coarse++;
      continue;
    }
    off++;
    printf("design %d:", i);
    print_design(&def);
    printf("  closing %.5g V, by a ramp %.5g V; release %.5g V, by a ramp %.5g V\n", closing, found[0], release,
           found[1]);
    fflush(stdout);
  }
  printf(
      "ramp: %d of %d designs that close agree, %d of them with a release; of %d the closing voltage differs by more "
      "than 1 %%, as it does from that of twice as many elements\n",
      looked - off, looked, released, coarse);
  return off;
}

/* -- the command -------------------------------------------------------------------------------------- */

int main(int argc, char **argv) {
  const char *word = argc > 1 ? argv[1] : "all";
  int designs = argc > 2 ? atoi(argv[2]) : 100, first = argc > 4 ? atoi(argv[4]) : 0, bad = 0, known = 0;
  uint64_t seed = argc > 3 ? strtoull(argv[3], NULL, 10) : 1;
  static const ZpStudy still[] = {ZP_STUDY_LIMITS, ZP_STUDY_STATIONARY, ZP_STUDY_MODES, ZP_STUDY_ISOMETRIC};
  static const ZpStudy moving[] = {ZP_STUDY_ACTUATE};
  if (strcmp(word, "kept") == 0 && argc > 2) return check_kept(argv[2]) > 0;
  if (strcmp(word, "errors") == 0 && argc > 4) return check_errors_of(argv[4], still, 4, designs, seed) > 0;
  if (strcmp(word, "errors") == 0) return check_errors(still, 4, designs, seed, MOST_NODES) > 0;
  if (strcmp(word, "times") == 0) return check_errors(moving, 1, designs, seed, 61) > 0;
  if (strcmp(word, "tolerance") == 0) return check_tolerances(designs, seed, 61), 0;
  if (strcmp(word, "agree") == 0) return check_agreement(designs, seed, argc > 4 ? atof(argv[4]) : 1e-3) > 0;
  if (strcmp(word, "liquid") == 0) return check_motions(word, design_in_liquid, designs, seed, first) > 0;
  if (strcmp(word, "supply") == 0) return check_motions(word, design_behind_supply, designs, seed, first) > 0;
  if (strcmp(word, "tilt") == 0) {
    int most = argc > 4 ? atoi(argv[4]) : 61;
    bad = check_tilt(ZP_STUDY_STATIONARY, designs, seed, most);
    return bad + check_tilt(ZP_STUDY_LIMITS, designs, seed, most) > 0;
  }
  if (strcmp(word, "loads") == 0) return check_loads(designs, seed, argc > 4 ? atoi(argv[4]) : 31) > 0;
  if (strcmp(word, "ramp") == 0) return check_ramp(designs, seed) > 0;
  for (size_t k = 0; k < sizeof every / sizeof every[0]; k++) {
    if (strcmp(word, "all") != 0 && strcmp(word, zp_study_name(every[k])) != 0) continue;
    bad += check_study(every[k], designs, seed);
    known++;
  }
  if (known == 0)
    fprintf(stderr,
            "%s: no study; also all, kept, agree, errors, times, tolerance, tilt, loads, ramp, liquid, supply\n", word);
  return known == 0 ? 2 : bad > 0;
}
