/* Are limits found, and are they those of the curve? Random sensible designs, each by study limits, which finds its
 * limits as such, and by study equilibrium, which follows the curve. `designs [COUNT [SEED [PART]]]`: a summary, and
 * every design on which the two do not agree to PART (1e-3) as options of the command. */
#include <zipact/zipact.h>

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* -- drawing ------------------------------------------------------------------------------------------ */

/* splitmix64: the same designs on every machine. => uniform in [0, 1) */
static double draw(uint64_t *state) {
  uint64_t z = *state += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static double uniform(uint64_t *state, double from, double to) {
  return from + (to - from) * draw(state);
}

static double log_uniform(uint64_t *state, double from, double to) {
  return from * pow(to / from, draw(state));
}

typedef struct Metal {
  double young_modulus, poisson_ratio, density;
} Metal;

/* Steel, copper, aluminium, PET; oil or air; the platform is a tenth of the length. */
static ZpActuatorDef design(uint64_t *state) {
  static const Metal metals[] = {{200e9, 0.285, 7850}, {120e9, 0.34, 8960}, {70e9, 0.33, 2700}, {4.5e9, 0.38, 1390}};
  ZpActuatorDef def = zp_actuator_def_default();
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
  return def;
}

/* As options of the command; keys that are as by default are left out. */
static void print_design(const ZpActuatorDef *def) {
  const ZpActuatorDef plain = zp_actuator_def_default();
  for (int k = 0; k < zp_key_count(); k++) {
    const ZpKey *key = zp_key(k);
    double value = zp_def_get(def, k);
    if (isnan(value) || value == zp_def_get(&plain, k)) continue;
    if (key->type == ZP_KEY_BOOL)
      printf(" --set %s=%s", key->name, value == 0 ? "false" : "true");
    else
      printf(" --set %s=%.17g", key->name, value);
  }
  printf("\n");
}

/* -- both studies ------------------------------------------------------------------------------------- */

enum { LIMITS, EQUILIBRIUM, STUDIES, VOLTAGES = 3 };

static const ZpStudy study[STUDIES] = {ZP_STUDY_LIMITS, ZP_STUDY_EQUILIBRIUM};
static const char *const study_name[STUDIES] = {"limits", "equilibrium"};
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
    snprintf(answer.message, sizeof answer.message, "refused: %s", err.message);
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

int main(int argc, char **argv) {
  int designs = argc > 1 ? atoi(argv[1]) : 100;
  uint64_t state = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
  double part = argc > 3 ? atof(argv[3]) : 1e-3;
  Count count = {.both = 0};
  for (int i = 0; i < designs; i++) {
    ZpActuatorDef def = design(&state);
    Answer answer[STUDIES] = {answer_of(study[LIMITS], &def), answer_of(study[EQUILIBRIUM], &def)};
    if (compare(answer, part, &count)) continue;
    printf("design %d:", i);
    print_design(&def);
    for (int s = 0; s < STUDIES; s++)
      printf("  %-11s %.9g %.9g %.9g V; %s\n", study_name[s], answer[s].voltage[0], answer[s].voltage[1],
             answer[s].voltage[2], answer[s].message);
  }
  for (int s = 0; s < STUDIES; s++)
    printf("%s: a good end in %d of %d\n", study_name[s], count.good[s], designs);
  for (int k = 0; k < VOLTAGES; k++)
    printf("%s: the same to 1e-6 in %d, to %g in %d of %d with two good ends\n", name[k], count.polished[k], part,
           count.same[k], count.both);
  printf("all the same: %d of %d\n", count.all_same, designs);
  return 0;
}
