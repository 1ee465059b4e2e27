/* Every key of keys.def acts: in a scene where it is in use another value changes the output that it should, by what
 * a closed form or a law of scaling says, else by far more than rounding; and leaves alone what it should. A new key
 * without a row here fails. */
#include "data_util.h"

#include <sys/stat.h>
#include <unistd.h>

#include <zipact/campaign.h>

#include "campaign/case_hash.h"

/* -- scenes ---------------------------------------------------------------------------------------- */

/* A weightless strip 0.1 m long, clamped at the left, under 10 mg at its guided end: it bends by 0.3 mm, linearly. */
#define STRIP                                                                                                          \
  "study=stationary actuator.kind=ribbon actuator.right_end=guided ribbon.density=0 load.mass=10mg mesh.nodes=21"
#define SAGS                                                                                                           \
  "study=stationary actuator.kind=ribbon actuator.right_end=free load.mass=0 gravity=0.001 ribbon.length=50mm "        \
  "mesh.nodes=21"
#define YIELDS "study=stationary actuator.kind=ribbon actuator.right_end=free ribbon.density=0 mesh.nodes=81"
/* a light strip, mostly of tape, whose swings a damper ends */
#define CREEPS                                                                                                         \
  "study=actuate actuator.kind=ribbon actuator.right_end=free ribbon.length=30mm ribbon.density=10 "                   \
  "ribbon.young_modulus=1MPa ribbon.thickness=1um "                                                                    \
  "insulator.young_modulus=1GPa load.mass=20mg mesh.nodes=11 initial.state=straight damping.internal=5ms "             \
  "solver.end_time=1s"
#define CANTILEVER                                                                                                     \
  "study=stationary actuator.kind=ribbon actuator.right_end=free ribbon.density=0 load.mass=2mg mesh.nodes=21"

/* A strip of 50 mm that voltage curls, and a pair of them that voltage parts; a second after the voltage is on. */
#define CURLS                                                                                                          \
  "study=actuate actuator.kind=ribbon actuator.right_end=free gravity=0 load.mass=0 ribbon.length=50mm mesh.nodes=21 " \
  "damping.internal=20ms solver.end_time=1s segment_1.length=50mm"
#define CURLS_A_PAIR                                                                                                   \
  "study=actuate gravity=0 load.mass=0 liquid.model=none mesh.nodes=11 electro.force_scale=0 drive.voltage=1V "        \
  "damping.internal=2ms solver.end_time=0.5s segment_1.length=9mm segment_1.curvature_per_volt=0.3"

/* Two weightless strips, 45 mm flexible, that part by 0.2 mm. */
#define PAIR "study=stationary ribbon.density=0 load.mass=0.1g mesh.nodes=21 drive.voltage=1V"

/* Two weightless strips, 45 mm flexible, that hardly part: by a load, by nothing, by their own weight. */
#define SLIGHT "study=stationary ribbon.density=0 load.mass=0.1mg mesh.nodes=21 drive.voltage=0"
#define FLAT   "study=stationary gravity=0 load.mass=0 mesh.nodes=21 drive.voltage=0"
#define SAGGED "study=stationary ribbon.density=0 gravity=0.001 load.mass=0 mesh.nodes=21 drive.voltage=0"

/* A platform that may turn. */
#define TURNING " actuator.symmetry=none platform.electrode=false liquid.model=none"

/* Eight actuators in series. */
#define EIGHT        SLIGHT " stack.series=8"
#define EIGHT_CLOSED UNCAPPED " stack.series=8"

/* Two slight bodies, one below the other; one that two members hold; one on a spring that is far stiffer than its
 * member. */
#define BODIES                                                                                                         \
  "study=stationary ribbon.density=0 mesh.nodes=21 drive.voltage=0 body_1.mass=0.1mg body_2.mass=0.1mg "               \
  "member_1.upper=frame member_1.lower=1"
#define BELOW  BODIES " member_2.upper=1 member_2.lower=2"
#define BESIDE BODIES " member_2.upper=0 member_2.lower=2 member_3.upper=0"
#define SPRUNG BESIDE " member_3.lower=2 spring_1.first=0 spring_1.second=1 spring_1.stiffness=1e6N/m"

/* Bodies in the plane: a pendulum beside an actuator; a body on a stiff spring; one that hangs on an actuator; two. */
#define BESIDE_AN_ACTUATOR                                                                                             \
  "study=stationary mesh.nodes=5 drive.voltage=0 body_1.moves=plane body_1.mass=1g body_1.inertia=1e-9 "               \
  "body_1.at.x=300mm body_1.at.y=-100mm body_2.mass=1g member_1.upper=frame member_1.lower=2"
#define PENDULUM BESIDE_AN_ACTUATOR " joint_1.first=0 joint_1.second=1 joint_1.at.x=300mm"
#define TOUCHES                                                                                                        \
  "body_1.force.x=9.81mN spring_1.first=0 spring_1.second=1 spring_1.stiffness=1e6N/m spring_1.kind=push "             \
  "spring_1.from_at.x=300mm spring_1.from_at.y=-100mm"
#define BOUNCY                                                                                                         \
  BESIDE_AN_ACTUATOR " spring_1.first=0 spring_1.second=1 spring_1.stiffness=1e5N/m spring_1.rest=100mm "              \
                     "spring_1.from_at.x=300mm spring_1.to_at.y=10mm"
#define UNDER                                                                                                          \
  "study=stationary mesh.nodes=11 drive.voltage=0 body_1.moves=plane body_1.at.y=-1mm member_1.upper=frame "           \
  "member_1.lower=1"
#define UNDER_BOTH                                                                                                     \
  UNDER " body_1.mass=1g body_2.moves=plane body_2.mass=1g body_2.at.x=300mm body_2.at.y=-1mm member_2.upper=frame "   \
        "member_2.lower=2 member_2.upper_at.x=300mm joint_1.first=0 joint_1.at.x=150mm joint_1.at.y=-1mm"

/* Two at one load in the middle, looked at before anything moves. */
#define OPPOSED                                                                                                        \
  "study=actuate gravity=0 stack.series=2 stack.distance=10mm mesh.nodes=21 drive.voltage=2kV solver.end_time=1ns "    \
  "liquid.model=none"

/* Frequencies of a strip in no gravity. */
#define TUNED                                                                                                          \
  "study=modes actuator.kind=ribbon actuator.right_end=guided gravity=0 load.mass=0 ribbon.length=20mm mesh.nodes=21"

/* Closed all along, the platform too, looked at before anything moves: a plane capacitor of two insulators. */
#define CLOSED   "study=actuate initial.state=straight mesh.nodes=5 solver.end_time=1ns"
#define UNCAPPED CLOSED " drive.voltage=1kV electro.breakdown_cap=false"

/* One ribbon, 20 mm long, below a flat electrode. */
#define FLANGE "actuator.kind=flange actuator.right_end=guided load.mass=0 ribbon.length=20mm mesh.nodes=21"

/* A curved electrode above it, looked at before anything moves. */
#define CURVED                                                                                                         \
  "study=actuate actuator.kind=curved ribbon.length=20mm mesh.nodes=21 initial.state=straight solver.end_time=1ns "    \
  "drive.voltage=100V electro.insulator_offset=100um"
/* A pouch of the default size. */
#define POUCH "actuator.kind=pouch mesh.nodes=101"

/* A plate on a hinge. */
#define FOLD                                                                                                           \
  "study=stationary actuator.kind=hinge ribbon.length=20mm ribbon.thickness=5mm ribbon.young_modulus=1000GPa "         \
  "load.mass=0 mesh.nodes=11"

/* What the source does is looked at; nothing much moves. */
#define DRIVEN "study=actuate initial.state=straight mesh.nodes=5 drive.voltage=2kV"

/* A closed actuator without weight, a capacitor of 199.8 pF, behind an amplifier. */
#define FED                                                                                                            \
  "study=actuate initial.state=straight mesh.nodes=11 gravity=0 load.mass=0 electro.breakdown_cap=false "              \
  "drive.voltage=50V solver.tolerance=1e-6 source.model=amplifier solver.end_time=1ms"

/* The same at a constant voltage, for a time that is short for what leaks. */
#define LEAKING                                                                                                        \
  "study=actuate initial.state=straight mesh.nodes=11 gravity=0 load.mass=0 electro.breakdown_cap=false "              \
  "drive.voltage=50V solver.end_time=50ms"

/* The same with a meter of its capacitance. */
#define METERED LEAKING " solver.end_time=2s sense.frequency=1kHz sense.amplitude=50V sense.sampling_rate=16kHz"

/* The same under a controller of its capacitance, 199.8 pF, which stays: samples at 0, 1 ms ... 9 ms. */
#define STEERED                                                                                                        \
  "study=actuate liquid.model=none initial.state=straight mesh.nodes=11 gravity=0 load.mass=0 "                        \
  "electro.breakdown_cap=false drive.voltage=50V solver.end_time=9.9ms control.signal=capacitance "                    \
  "setpoint.value=300pF"
#define HELD_BY_PI STEERED " control.kind=pi"
#define WAVING                                                                                                         \
  "study=actuate liquid.model=none initial.state=straight mesh.nodes=11 gravity=0 load.mass=0 "                        \
  "electro.breakdown_cap=false drive.voltage=50V solver.end_time=9.9ms control.signal=capacitance control.kind=pi "    \
  "control.proportional=0.1V/pF"

/* The default actuator from hanging, on a coarse mesh. */
#define HANGING "study=actuate mesh.nodes=11"

/* A bare plate; one that creeps through a viscous film without mass. */
#define PLATE "actuator.kind=plate medium.permittivity=1"
#define PLATE_CREEPS                                                                                                   \
  PLATE " study=actuate liquid.model=submerged plate.mass=1e-9kg medium.density=1000 liquid.inertia=false "            \
        "solver.end_time=10s solver.stop_when_zipped=true"

/* Something falls on its platform, which hangs. */
#define FALLS HANGING " drive.voltage=0 liquid.model=none load.change_time=1us solver.end_time=2us"

/* The same in a bath, and in one so viscous that nothing else counts. */
#define BATH "study=actuate mesh.nodes=11 liquid.model=submerged solver.end_time=20s solver.stop_when_zipped=true"

/* The default actuator with a bead at its fronts; faces pressed flat on a drop of it, and parted by it. */
#define BEAD                                                                                                           \
  "study=actuate mesh.nodes=11 liquid.model=bead bead.volume=50uL solver.end_time=0.5s solver.stop_when_zipped=true"
#define DROP      "study=actuate mesh.nodes=11 liquid.model=bead bead.volume=1uL solver.end_time=1ns"
#define CAPILLARY DROP
#define VISCOUS   BATH " medium.kinematic_viscosity=1000mm2/s liquid.inertia=false medium.drag_coefficient=0"

/* The paper's particles, zipping one after the other. */
#define PARTICLES                                                                                                      \
  "study=actuate mesh.nodes=11 ribbon.model=mass_spring mass_spring.axial=code solver.integrator=explicit "            \
  "contact.model=sequential"
#define BEZIER PARTICLES " electro.surface=bezier"

/* A limp strand released from straight falls freely. */
#define STRAND                                                                                                         \
  "study=actuate actuator.kind=ribbon actuator.right_end=free initial.state=straight ribbon.length=45mm load.mass=0 "  \
  "mesh.nodes=21 ribbon.model=mass_spring mass_spring.shear_coefficient=0 mass_spring.axial=code "                     \
  "solver.integrator=explicit solver.end_time=5ms"

/* A strip released from straight swings in its first mode, mostly. */
#define SWING                                                                                                          \
  "study=actuate actuator.kind=ribbon actuator.right_end=guided initial.state=straight ribbon.length=45mm "            \
  "load.mass=0 mesh.nodes=11 solver.end_time=40ms"

#define HELD    "study=isometric isometric.separation=2mm load.mass=0 mesh.nodes=21 drive.voltage=1V"
#define PROFILE "study=profile profile.shape=cubic isometric.separation=1mm mesh.nodes=21 electro.breakdown_cap=false"

/* Strokes of the strip that hold for 100 GPa are fitted. */
#define FITTED                                                                                                         \
  "study=calibrate actuator.kind=ribbon actuator.right_end=guided ribbon.density=0 mesh.nodes=21 data.file=soft.csv "  \
  "calibrate.fit=ribbon.young_modulus"

/* Rows of a record are compared with a run. */
#define WATCHED                                                                                                        \
  "study=calibrate actuator.kind=ribbon actuator.right_end=guided mesh.nodes=11 data.file=watched.csv "                \
  "calibrate.fit=ribbon.young_modulus calibrate.starts=1"

/* Strokes of a strip that could be measured, to 1 um, of which one is chosen. */
#define PLANNED                                                                                                        \
  "study=plan actuator.kind=ribbon actuator.right_end=guided ribbon.density=0 mesh.nodes=21 plan.budget=1 "            \
  "calibrate.fit=ribbon.young_modulus calibrate.y=stroke_um calibrate.sigma=stroke=1um plan.candidates=light.csv"

/* -- what they lead to ----------------------------------------------------------------------------- */

typedef enum Change {
  TIMES,   /* the output is `expected` times that before, within `tolerance` */
  PLUS,    /* it is `expected` more, within `tolerance` of that */
  BECOMES, /* it is `expected` */
  MORE,    /* it is more than `expected` times that before */
  LESS,    /* less than `expected` times that before */
  SAME     /* but for rounding */
} Change;

typedef struct Effect {
  Change change;
  const char *output;
  double expected, tolerance;
} Effect;

enum { EFFECTS = 3 };

typedef struct Row {
  const char *key, *scene; /* the key, and what else is set */
  const char *from, *to;   /* its value before and after */
  Effect effect[EFFECTS];
} Row;

#define NU2             (0.285 * 0.285)            /* of the default steel */
#define PLATES          (2 * 130e-6 * 2.75 / 4.62) /* d: liquid that stands for both insulators, m */
#define CLOSED_AT_10_KV (10e3 / 20e6)              /* g + d at which breakdown sets in, m */
#define LINE_MASS       (7850 * 12.7e-3 * 50e-6)   /* kg/m */
#define CUBE(x)         ((x) * (x) * (x))
#define EI              (200e9 * 12.7e-3 * CUBE(50e-6) / 12 / (1 - NU2))
#define SQUARE(x)       ((x) * (x))

/* A guided strip of length 1 whose piece from a to b is eight times as stiff: how far it gives way over how far an even
 * one does, by c, cx and cxx, the moments of its compliance. */
#define STIFFER(a, b)                                                                                                  \
  (12 * ((1 - 0.875 * (CUBE(b) - CUBE(a))) / 3 -                                                                       \
         SQUARE((1 - 0.875 * (SQUARE(b) - SQUARE(a))) / 2) / (1 - 0.875 * ((b) - (a)))))

/* A guided strip of 45 mm bowed by 0.002 per metre from a to b rises by this. */
#define RISES(a, b) (0.001 * ((b) - (a)) * (45e-3 - (a) - (b)))

/* Of FLANGE, 1 mm and 100 um of insulators below the electrode, at 500 V: what omega^2 loses over 4 pi^2, and its
 * first two frequencies, Hz (roots 2.36502 and 5.49780 of a clamped, guided strip). */
#define SOFTENING   (8.8541878e-12 * 2.75 * 12.7e-3 * SQUARE(500) / CUBE(1.1e-3) / LINE_MASS / SQUARE(2 * 3.14159265))
#define FIRST_MODE  (169.15)
#define SECOND_MODE (914.10)

#define ACTS(key, scene, from, to, ...) {key, scene, from, to, {__VA_ARGS__}},
static const Row rows[] = {
#include "keys_act.def"
};

/* -- how they are run ------------------------------------------------------------------------------ */

/* "key=value key=value" into the scenario; what stands later wins. */
static void set_all(ZpScenario *scenario, const char *settings) {
  char copy[1024], *rest = NULL;
  ZpError err;
  ck_assert_uint_lt(strlen(settings), sizeof copy);
  memcpy(copy, settings, strlen(settings) + 1);
  for (char *word = strtok_r(copy, " ", &rest); word; word = strtok_r(NULL, " ", &rest))
    ck_assert_msg(zp_scenario_set(scenario, word, &err) == ZP_OK, "%s: %s", word, err.message);
}

/* A scene with key = value; without liquid unless the scene has one. */
static ZpScenario *scenario_of(const char *scene, const char *key, const char *value) {
  ZpScenario *scenario = new_scenario();
  char setting[256];
  snprintf(setting, sizeof setting, "%s=%s", key, value);
  set_all(scenario, "liquid.model=none");
  set_all(scenario, scene);
  set_all(scenario, setting);
  return scenario;
}

static ZpActuatorDef def_of(const ZpScenario *scenario) {
  ZpActuatorDef def = {0};
  ck_ok(zp_scenario_def(scenario, 0, &def, &err));
  lend_members(&def);
  return def;
}

/* The study of a scene. */
static ZpResult *run_scene(const char *scene, const char *key, const char *value) {
  ZpScenario *scenario = scenario_of(scene, key, value);
  ZpActuatorDef def = def_of(scenario);
  ZpResult *result;
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_data_study_run(zp_scenario_study(scenario), &def, NULL, &result, &err) == ZP_OK, "%s %s=%s: %s",
                scene, key, value, err.message);
  return zp_test_owns(result, destroy_result);
}

/* A number of the summary, how much of something there is, or what a column ends with. */
static double output_of(const ZpResult *result, const char *name) {
  if (strcmp(name, "rows") == 0) return (double)result->series->rows;
  if (strcmp(name, "frames") == 0) return (double)result->shapes->frames;
  if (strcmp(name, "derivatives") == 0) return (double)result->sensitivities;
  if (strcmp(name, "notes") == 0) return (double)result->notes;
  double value = zp_result_get(result, name);
  return isnan(value) ? zp_table_get(result->series, result->series->rows - 1, name) : value;
}

static bool has_effect(const Effect *effect, double from, double to) {
  double expected = effect->expected, off = effect->tolerance * fabs(expected);
  switch (effect->change) {
  case TIMES:
    return from != 0 && fabs(to / from - expected) <= off;
  case PLUS:
    return fabs(to - from - expected) <= off;
  case BECOMES:
    return !(from == to) && fabs(to - expected) <= off;
  case MORE:
    return to > expected * from;
  case LESS:
    return to < expected * from;
  case SAME:
    return fabs(to - from) <= effect->tolerance * fabs(from);
  }
  return false;
}

TESTS(key_acts, 0, LENGTH_OF(rows)) {
  if (SANITIZED && _i % 4) return; /* test_bounds runs with every key */
  const Row *row = &rows[_i];
  ZpResult *from = run_scene(row->scene, row->key, row->from), *to = run_scene(row->scene, row->key, row->to);
  for (int k = 0; k < EFFECTS && row->effect[k].output; k++) {
    const Effect *effect = &row->effect[k];
    double a = output_of(from, effect->output), b = output_of(to, effect->output);
    ck_assert_msg(has_effect(effect, a, b), "%s, %s => %s: %s %.10g => %.10g, ratio %.10g, expected %.10g within %g",
                  row->key, row->from, row->to, effect->output, a, b, b / a, effect->expected, effect->tolerance);
  }
}

/* -- a campaign computes a case again if a key of it has changed ----------------------------------- */

static uint64_t hash_of(const Row *row, const char *value) {
  ZpScenario *scenario = scenario_of(row->scene, row->key, value);
  ZpActuatorDef def = def_of(scenario);
  uint64_t start;
  ck_assert_int_eq(zp_campaign_hash(zp_scenario_study(scenario), &def, &start, NULL), ZP_OK);
  return zp_case_hash(start, &def);
}

/* What acts is part of a case: a row of the journal counts for the same value only. */
TESTS(key_is_part_of_a_case, 0, LENGTH_OF(rows)) {
  const Row *row = &rows[_i];
  ck_assert_msg(hash_of(row, row->from) == hash_of(row, row->from), "%s: two hashes of one case", row->key);
  ck_assert_msg(hash_of(row, row->from) != hash_of(row, row->to), "%s: one hash of two cases", row->key);
}

/* The only case of a campaign in the present folder, which may have a journal of another. */
static void compute(const Row *row, const char *value, const char *folder, double *outputs) {
  ZpScenario *scenario = scenario_of(row->scene, row->key, value);
  const ZpCampaignOptions options = {.jobs = 1, .resume = true};
  ZpCampaign *campaign;
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_campaign_open(scenario, folder, &options, &campaign, &err) == ZP_OK, "%s: %s", row->key,
                err.message);
  ck_assert_msg(zp_campaign_run(campaign, &err) == ZP_OK, "%s: %s", row->key, err.message);
  const ZpRows *all = zp_campaign_rows(campaign);
  ck_assert_uint_eq(zp_campaign_count(campaign), 1);
  const ZpResult *result = all->get(all->user, 0);
  for (int k = 0; k < EFFECTS; k++)
    outputs[k] = row->effect[k].output ? zp_result_get(result, row->effect[k].output) : 0;
  zp_campaign_close(campaign);
}

/* A campaign that is resumed after a key has changed has the results of a fresh one. */
NIGHTLY_TESTS(resumed_with_another_value_is_fresh, 0, LENGTH_OF(rows)) {
  static const char *const folders[] = {"resumed", "fresh"};
  double outputs[2][EFFECTS];
  for (int k = 0; k < 2; k++) {
    char journal[64];
    mkdir(folders[k], 0777);
    snprintf(journal, sizeof journal, "%s/journal.sqlite", folders[k]);
    unlink(journal);
  }
  compute(&rows[_i], rows[_i].from, folders[0], outputs[0]);
  for (int k = 0; k < 2; k++)
    compute(&rows[_i], rows[_i].to, folders[k], outputs[k]);
  ck_assert_mem_eq(outputs[0], outputs[1], sizeof outputs[0]);
}

/* -- every key has a row --------------------------------------------------------------------------- */

/* What is written or drawn, or which cases are run, which no study knows: test_report, test_scenario, test_network,
 * test_campaign.py and test_optimize.py. A member that is turned over needs another place, too: test_network. */
static bool is_of_files(const char *key) {
  static const char *const files[] = {"output.series",       "output.plots",   "output.animation",
                                      "solver.max_cpu_time", "member_K.angle", "body_K.at.x"};
  bool found = strncmp(key, "sampling.", 9) == 0 || strncmp(key, "optimize.", 9) == 0;
  for (size_t i = 0; i < LENGTH_OF(files); i++)
    found |= strcmp(files[i], key) == 0;
  return found;
}

/* Keys of a port of its own act as those of all, whose rows are here: test_ports. */
static bool is_of_port(const char *key) {
  static const char *const groups[] = {"drive.", "source.", "sense.", "control.", "setpoint."};
  const char *one = zp_key_of_one(key);
  bool found = false;
  for (size_t i = 0; i < LENGTH_OF(groups); i++)
    found |= strncmp(one, groups[i], strlen(groups[i])) == 0;
  return found && one != key && zp_key_find(one) >= 0;
}

TESTS(key_has_a_row, 0, zp_key_count()) {
  const char *key = zp_key(_i)->name;
  bool found = is_of_files(key) || is_of_port(key);
  for (size_t i = 0; i < LENGTH_OF(rows); i++)
    found |= zp_key(zp_key_find(rows[i].key)) == zp_key(_i) && rows[i].effect[0].output; /* of any member for all */
  ck_assert_msg(found, "%s has no row: which output does it change, by how much?", key);
}

/* -- files ----------------------------------------------------------------------------------------- */

/* Where a run stands that began to hang and was cut. */
static void write_checkpoint(const char *name, const char *end_time) {
  ZpResult *result = run_scene(HANGING, "solver.end_time", end_time);
  FILE *file = fopen(name, "wb");
  ck_assert(file && zp_checkpoint_write(result->checkpoint, file, NULL) == ZP_OK && fclose(file) == 0);
}

/* Strokes of STRIP at two loads, by P L^3 / (12 E I), and `above` them, in mm; half of them as another column. */
static void write_strokes(const char *name, double E, double above) {
  FILE *file = fopen(name, "w");
  ck_assert_ptr_nonnull(file);
  fprintf(file, "load_mg, stroke_mm, stroke_um, ribbon.width_mm\n");
  for (int mg = 5; mg <= 10; mg += 5) {
    double mm = 1e3 * mg * 1e-6 * 9.81 * CUBE(0.1) / (12 * EI * E / 200e9) + above;
    fprintf(file, "%d, %.12g, %.12g, 12.7\n", mg, mm, 500 * mm);
  }
  ck_assert_int_eq(fclose(file), 0);
}

static void write_files(void) {
  write_file("fast.csv", "time_ms,voltage_kV\n0,0\n2,2\n");
  write_file("slow.csv", "time_ms,voltage_kV\n0,0\n4,2\n");
  write_file("rises.csv", "time_ms,setpoint_pF\n0,300\n18,500\n");
  write_file("rises_slowly.csv", "time_ms,setpoint_pF\n0,300\n36,500\n");
  write_checkpoint("early.zps", "1ms");
  write_checkpoint("late.zps", "2ms");
  write_strokes("soft.csv", 100e9, 0);
  write_strokes("stiff.csv", 400e9, 0);
  write_file("soft.yaml", "ribbon.young_modulus: 100 GPa\nfitted: {outcome: converged}\n");
  write_file("stiff.yaml", "ribbon.young_modulus: 400 GPa\nfitted: {outcome: converged}\n");
  write_strokes("raised.csv", 100e9, 1);
  write_file("light.csv", "load_mg\n5\n5\n5\n5\n");
  write_file("heavy.csv", "load_mg\n10\n");
  write_file("watched.csv", "time_ms,stroke_mm\n0,1\n1,1\n2,1\n3,1\n");
}

AROUND_ALL(write_files, NULL)
