/* zipact for a web page: a scenario given as texts, a simulation, studies.
 *
 * The caller passes only numbers and one buffer of text. Names of keys, signals and columns go into that buffer;
 * messages come back in it. Every function that may fail returns a ZpStatus, with the message in the buffer, or a
 * ZpOutcome. Shapes and tables are read in place; pointers are valid until the next call. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <zipact/io.h>
#include <zipact/zipact.h>

#include "actuator/model.h"
#include "base/fail.h"
#include "base/memory.h"
#include "def/check.h"
#include "def/device.h"
#include "io/value.h"
#include "run/info.h"
#include "run/run.h"
#include "study/result.h"

#define EXPORT __attribute__((visibility("default"), used))

enum { TEXT_SIZE = 1024, MOST_ASSIGNMENTS = 512, MOST_NODES = 2001 };

/* How many numbers the page reads of each; frame.js names them. */
enum { MEMBER_NUMBERS = 16, BODY_NUMBERS = 5, SPRING_NUMBERS = 6, JOINT_NUMBERS = 4 };

/* Number of signals. */
#define ZP_SIGNAL(name, unit, suffix, help) +1
#define ZP_ROW(name)                        +1
enum {
  SIGNALS = 0
#include "run/columns.def"
};
#undef ZP_SIGNAL
#undef ZP_ROW

/* Keys that may be auto, and the constant of a model that says which value auto means. */
static const struct {
  const char *key, *constant;
} automatic[] = {{"damping.internal", "internal_damping"},
                 {"electro.insulator_offset", "insulator_offset"},
                 {"mass_spring.shear_coefficient", "shear_coefficient"}};
enum { AUTOMATIC = sizeof automatic / sizeof automatic[0] };

typedef struct ZpWeb {
  char text[TEXT_SIZE];
  ZpAssignment list[MOST_ASSIGNMENTS];
  size_t assigned;
  ZpStudy asked; /* with the assignments */
  ZpStudy study; /* of the scenario as resolved */
  ZpActuatorDef def;
  double automatic[AUTOMATIC]; /* values that auto means there */
  ZpModel *model;
  ZpSim *sim;
  double row[SIGNALS];
  double part[MEMBER_NUMBERS];    /* the longest of the above */
  double pair[2][2 * MOST_NODES]; /* x and y of what a ribbon faces, and of the ribbon, as of two ribbons */
  ZpResult *result;
} ZpWeb;

EXPORT ZpWeb *zp_web_create(void) {
  ZpWeb *web = zp_calloc(1, sizeof *web);
  if (web) web->def = zp_actuator_def_default();
  return web;
}

EXPORT char *zp_web_text(ZpWeb *web) {
  return web->text;
}

EXPORT int zp_web_text_size(void) {
  return TEXT_SIZE;
}

static int say(ZpWeb *web, ZpStatus status, const char *message) {
  snprintf(web->text, TEXT_SIZE, "%s", status == ZP_OK ? "" : message);
  return (int)status;
}

/* The clock of the page: not 0 if the time that the page allows for a call is over. */
__attribute__((import_module("zipact"), import_name("expired"))) int zp_web_expired(void);

static bool stop(void *user, const char *stage, double fraction) {
  (void)user, (void)stage, (void)fraction;
  return zp_web_expired() != 0;
}

static const ZpHooks hooks = {.progress = stop};

/* -- keys ----------------------------------------------------------------------------------------- */

EXPORT int zp_web_key_count(void) {
  return zp_key_count();
}

EXPORT const char *zp_web_key_name(int index) {
  return zp_key(index)->name;
}

/* The key of the resolved scenario that follows, after -1 the first, -1 after the last; and its name, in the text. */
EXPORT int zp_web_next_key(ZpWeb *web, int index) {
  const int next = zp_def_next_key(&web->def, index);
  char name[ZP_KEY_NAME_SIZE];
  if (next >= 0) snprintf(web->text, TEXT_SIZE, "%s", zp_key_name(next, name));
  return next;
}

EXPORT const char *zp_web_key_shown(int index) {
  return zp_key(index)->shown;
}

EXPORT const char *zp_web_key_help(int index) {
  return zp_key(index)->help;
}

EXPORT double zp_web_key_min(int index) {
  return zp_key(index)->min;
}

EXPORT double zp_web_key_max(int index) {
  return zp_key(index)->max;
}

EXPORT double zp_web_key_default(int index) {
  return zp_key(index)->def;
}

/* Number of words of a choice key; 0: it is not a choice. */
EXPORT int zp_web_key_choices(int index) {
  return zp_key(index)->choices ? (int)zp_key(index)->max + 1 : 0;
}

EXPORT const char *zp_web_choice_word(int index, int choice) {
  return zp_key(index)->choices[choice].word;
}

EXPORT const char *zp_web_choice_help(int index, int choice) {
  return zp_key(index)->choices[choice].help;
}

/* Value of a key in the resolved scenario, SI. */
EXPORT double zp_web_key_value(const ZpWeb *web, int index) {
  return index == zp_key_find("study") ? (double)web->study : zp_def_get(&web->def, index);
}

/* (key, SI) => text "8 g". */
EXPORT void zp_web_print(ZpWeb *web, int index, double value) {
  zp_value_print(index, value, web->text, TEXT_SIZE);
}

/* -- scenario ------------------------------------------------------------------------------------- */

EXPORT void zp_web_clear(ZpWeb *web) {
  web->assigned = 0;
  web->asked = (ZpStudy)0;
}

/* What a key of a scenario with names of bodies and members is called here; NULL: it is none. */
static const char *numbered(const char *key) {
  static const char *const kind[][2] = {{"bodies.", "body_1.mass"},
                                        {"members.", "member_1.upper"},
                                        {"joints.", "joint_1.at.x"},
                                        {"springs.", "spring_1.rest"}};
  for (size_t k = 0; k < sizeof kind / sizeof kind[0]; k++)
    if (strncmp(key, kind[k][0], strlen(kind[k][0])) == 0) return kind[k][1];
  return NULL;
}

/* Text "ribbon.length=80 mm" => one more assignment. Messages are those of the command's --set. */
EXPORT int zp_web_assign(ZpWeb *web) {
  ZpError err;
  char *sign = strchr(web->text, '=');
  if (!sign || web->assigned == MOST_ASSIGNMENTS) return say(web, ZP_BAD_INPUT, sign ? "too many keys" : "no = in it");
  *sign = 0;
  int key = zp_key_with_value(web->text);
  double value;
  char message[sizeof err.message + TEXT_SIZE], reason[256];
  if (key < 0) {
    const char *like = numbered(web->text);
    zp_key_unknown(web->text, reason, sizeof reason);
    if (like) snprintf(reason, sizeof reason, "this page numbers bodies, members, joints and springs, as %s", like);
    snprintf(message, sizeof message, "%.80s=%.80s: %s", web->text, sign + 1, reason);
  } else if (sign[1] == 0)
    snprintf(message, sizeof message, "%s=: empty; give a value", web->text);
  else if (zp_value_read(key, sign + 1, &value, &err) != ZP_OK)
    snprintf(message, sizeof message, "%s=%.80s: %s", web->text, sign + 1, err.message);
  else {
    if (key != zp_key_find("study"))
      web->list[web->assigned++] = (ZpAssignment){key, value};
    else
      web->asked = (ZpStudy)value;
    return say(web, ZP_OK, "");
  }
  return say(web, ZP_BAD_INPUT, message);
}

static ZpStatus refuse_left_out(ZpStudy study, const ZpActuatorDef *def, ZpError *err) {
  if (!zp_def_has(def, ZP_DEVICE_PAIR | ZP_DEVICE_COUNTER | ZP_DEVICE_POUCH))
    return zp_fail(err, ZP_BAD_INPUT, "this page draws two faces, and a ribbon alone has one; use the command for it");
  if (!zp_def_has(def, ZP_DEVICE_PAIR) && zp_def_network(def))
    return zp_fail(err, ZP_BAD_INPUT,
                   "this page draws networks of two ribbons; use the command for counter electrodes");
  if (study != ZP_STUDY_ACTUATE)
    return zp_fail(err, ZP_BAD_INPUT,
                   "this page runs the studies actuate and equilibrium only; use the command for the others");
  if (def->drive.waveform != ZP_WAVEFORM_STEP && !zp_def_network(def))
    return zp_fail(err, ZP_BAD_INPUT, "buttons set the voltage on this page; use the command for drive.waveform");
  for (int k = 1; k <= zp_def_members(def); k++) {
    const ZpActuatorDef one = zp_def_member(def, k);
    if (one.drive.waveform == ZP_WAVEFORM_TABLE || one.setpoint.waveform == ZP_WAVEFORM_TABLE)
      return zp_fail(err, ZP_BAD_INPUT, "this page reads no tables; use the command for waveform = table");
  }
  if (def->initial.state == ZP_INITIAL_CHECKPOINT)
    return zp_fail(err, ZP_BAD_INPUT, "this page reads no files; use the command for initial.state = checkpoint");
  if (def->solver.integrator != ZP_INTEGRATOR_IMPLICIT)
    return zp_fail(err, ZP_BAD_INPUT,
                   "this page supports solver.integrator implicit only; use the command for explicit");
  return ZP_OK;
}

static ZpStatus derive(const ZpActuatorDef *def, double value[AUTOMATIC], ZpError *err) {
  ZpModel *model;
  ZpStatus status = zp_model_create(def, &model, err);
  for (int k = 0; status == ZP_OK && k < AUTOMATIC; k++)
    value[k] = zp_model_get(model, automatic[k].constant);
  zp_model_destroy(model);
  return status;
}

/* All assignments => the scenario. If they are refused, the scenario is unchanged. */
EXPORT int zp_web_resolve(ZpWeb *web) {
  ZpError err;
  ZpActuatorDef def = {0};
  double value[AUTOMATIC];
  ZpStatus status = zp_def_resolve(&def, web->list, web->assigned, &err);
  if (status == ZP_OK) status = zp_study_check(web->asked, &def, &err);
  if (status == ZP_OK) status = refuse_left_out(web->asked, &def, &err);
  if (status == ZP_OK) status = derive(&def, value, &err);
  if (status == ZP_OK) status = zp_def_assign(&web->def, &def, &err);
  zp_def_clear(&def);
  if (status == ZP_OK) {
    web->study = web->asked;
    memcpy(web->automatic, value, sizeof value);
  }
  return say(web, status, err.message);
}

/* Value of a key, SI; if the key is auto, the value that auto means, NAN if it is not a single value. */
EXPORT double zp_web_key_effective(const ZpWeb *web, int index) {
  double value = zp_def_get(&web->def, index);
  if (strcmp(zp_key(index)->name, "liquid.model") == 0) return (double)zp_def_liquid(&web->def);
  for (int k = 0; isnan(value) && k < AUTOMATIC; k++)
    if (strcmp(zp_key(index)->name, automatic[k].key) == 0) return web->automatic[k];
  return value;
}

/* -- simulation ----------------------------------------------------------------------------------- */

/* A simulation of the scenario: from its hanging equilibrium, or from the state of the last simulation. */
EXPORT int zp_web_start(ZpWeb *web, int go_on) {
  ZpError err;
  ZpModel *model;
  ZpSim *sim = NULL;
  ZpStatus status = zp_model_create(&web->def, &model, &err);
  if (status == ZP_OK) status = zp_sim_create(model, &hooks, &sim, &err);
  if (status == ZP_OK && go_on) status = zp_sim_take_over(sim, web->sim, &err);
  if (status != ZP_OK) {
    zp_sim_destroy(sim);
    zp_model_destroy(model);
    return say(web, status, err.message);
  }
  zp_sim_destroy(web->sim);
  zp_model_destroy(web->model);
  web->model = model;
  web->sim = sim;
  return say(web, ZP_OK, "");
}

/* Has a network waveforms or controllers that play from the start on, until a voltage is set? */
EXPORT int zp_web_plays(const ZpWeb *web) {
  bool plays = false;
  for (int k = 1; zp_def_network(&web->def) && k <= zp_def_members(&web->def); k++) {
    const ZpActuatorDef one = zp_def_member(&web->def, k);
    plays |= one.drive.waveform != ZP_WAVEFORM_STEP || one.drive.delay > 0 || one.control.kind != ZP_CONTROL_NONE;
  }
  return plays;
}

EXPORT int zp_web_set_voltage(ZpWeb *web, double voltage) {
  ZpError err;
  return say(web, zp_sim_set_voltage(web->sim, voltage, &err), err.message);
}

/* Run until `end_time`, s, or until the time of the page is over. => 0, or 1 if the solver failed, with the reason in
 * the text. */
EXPORT int zp_web_run(ZpWeb *web, double end_time) {
  ZpRunInfo info;
  ZpOutcome outcome = zp_sim_run(web->sim, end_time, false, &hooks, &info);
  snprintf(web->text, TEXT_SIZE, "%s", info.message);
  return !zp_outcome_good(outcome) && outcome != ZP_INTERRUPTED;
}

EXPORT int zp_web_good(int outcome) {
  return zp_outcome_good((ZpOutcome)outcome);
}

/* Current value of the signal named in the text. */
EXPORT double zp_web_signal(ZpWeb *web) {
  return zp_sim_get(web->sim, web->text);
}

EXPORT int zp_web_signals(void) {
  return SIGNALS;
}

/* The column of a table that has the signal. */
EXPORT const char *zp_web_signal_column(int index) {
  size_t count;
  return zp_signal_columns(&count)[index].name;
}

/* A row: current values of all signals; mean current and power count from the last row. */
EXPORT const double *zp_web_read(ZpWeb *web) {
  zp_sim_read(web->sim, web->row);
  return web->row;
}

EXPORT double zp_web_zip_time(ZpWeb *web) {
  return zp_sim_zip_time(web->sim);
}

/* Members of a stack that have shapes of their own: those of a series, and unequal parallel ones. */
EXPORT int zp_web_members(ZpWeb *web) {
  return (int)web->model->members;
}

/* Modelled halves of each: 1, which has a mirror image, or 2; 0 without a platform, which has neither. */
EXPORT int zp_web_halves(ZpWeb *web) {
  const ZpTopology *topology = &web->model->topology;
  return zp_has_platform(topology) ? (int)zp_halves(topology) : 0;
}

/* Stations of each ribbon. */
EXPORT int zp_web_nodes(ZpWeb *web) {
  return (int)web->model->topology.stations;
}

/* What the page draws of each member, body, spring and joint, beside the shapes: `values`, valid until the next call.
 */
static const double *give(ZpWeb *web, const double *values, size_t count) {
  memcpy(web->part, values, count * sizeof *values);
  return web->part;
}

static double own_signal(ZpWeb *web, int member, const char *name) {
  return zp_sim_own_signal(web->sim + member, zp_signal_find(name));
}

/* Middle of a member in the drawing, m: where bodies move up and down, its lower body's; else 0, or NAN: its shape is
 * in the drawing as it is. */
static double middle_of(const ZpWeb *web, int member) {
  const ZpNetwork *network = web->model->network;
  if (!zp_is_network(web->model)) return 0;
  return network->plane ? NAN : network->body[network->ends[member].lower].x;
}

/* Voltage of its electrodes, V; opening, m; liquid equivalent to both insulators; thicknesses of the upper and the
 * lower insulator and metal; lengths of its ribbons and of its platform; does the platform attract; its middle, m; is
 * it upside down; numbers of the bodies at its upper and its lower end; does its load pull along its ribbons; length of
 * the electrodes over that of the ribbons. */
EXPORT const double *zp_web_member(ZpWeb *web, int member) {
  const ZpModel *model = web->model + member;
  ZpActuatorDef room;
  const ZpActuatorDef *def = &model->def, *lower = zp_def_lower(def, &room);
  const ZpEnds *ends = &web->model->network->ends[member];
  const bool film = isnan(def->insulator.thickness); /* which is its own insulator */
  const double values[MEMBER_NUMBERS] = {own_signal(web, member, "voltage"),
                                         own_signal(web, member, "opening"),
                                         zp_model_get(model, "insulator_offset"),
                                         zp_insulator_thickness(def),
                                         zp_insulator_thickness(lower),
                                         film ? 0 : def->ribbon.thickness,
                                         film ? 0 : lower->ribbon.thickness,
                                         def->ribbon.length,
                                         def->platform.length,
                                         def->platform.electrode,
                                         middle_of(web, member),
                                         ends->turned,
                                         (double)ends->upper,
                                         (double)ends->lower,
                                         model->topology.along,
                                         model->pouch.w > 0 ? model->pouch.electrode / model->pouch.length : 1};
  return give(web, values, MEMBER_NUMBERS);
}

/* Numbers of bodies, springs and joints of a network: 0 of an actuator or a stack. */
EXPORT int zp_web_bodies(const ZpWeb *web) {
  return zp_is_network(web->model) ? (int)web->model->network->bodies : 0;
}

EXPORT int zp_web_springs(const ZpWeb *web) {
  return (int)web->model->network->springs;
}

EXPORT int zp_web_joints(const ZpWeb *web) {
  return (int)web->model->network->joints;
}

/* Place of a body, body 0 the frame: x, y, m, and angle, rad; its mass, kg; 1 if it is held. */
EXPORT const double *zp_web_body(ZpWeb *web, int body) {
  const ZpBody *one = &web->model->network->body[body];
  const ZpPose at = zp_sim_place(web->sim, (size_t)body);
  const double values[BODY_NUMBERS] = {at.x, at.y, at.turn, one->mass, one->held};
  return give(web, values, BODY_NUMBERS);
}

/* A point of a body that is given from its place along its own axes. */
static ZpVector point_of(const ZpWeb *web, size_t body, const double at[2]) {
  const ZpPose pose = zp_sim_place(web->sim, body);
  return zp_pose_point(&pose, (ZpVector){at[0], at[1]});
}

/* Where a spring begins that ends at `to`: with a direction the point of its first body in that direction. */
static ZpVector begin_of(const ZpWeb *web, const ZpLink *link, ZpVector to) {
  const ZpVector from = point_of(web, link->body[0], link->at[0]);
  if (isnan(link->direction)) return from;
  const double turns = zp_sim_place(web->sim, link->body[0]).turn - web->model->network->body[link->body[0]].angle;
  const ZpVector facing = zp_direction(link->direction + turns);
  return zp_difference(to, zp_times(zp_along(zp_difference(to, from), facing), facing));
}

/* Ends of a spring, x and y of each, m, and the bodies there. */
EXPORT const double *zp_web_spring(ZpWeb *web, int spring) {
  const ZpLink *link = &web->model->network->spring[spring];
  const ZpVector to = point_of(web, link->body[1], link->at[1]), from = begin_of(web, link, to);
  const double values[SPRING_NUMBERS] = {from.x, from.y, to.x, to.y, (double)link->body[0], (double)link->body[1]};
  return give(web, values, SPRING_NUMBERS);
}

/* Place of a joint on its first body, m, and its bodies. */
EXPORT const double *zp_web_joint(ZpWeb *web, int joint) {
  const ZpBodyJoint *one = &web->model->network->joint[joint];
  const ZpBody *body = &web->model->network->body[one->body[0]];
  const ZpVector out = {one->at[0] - body->x, one->at[1] - body->y};
  const ZpVector arm = zp_turned_back(zp_direction(body->angle), out);
  const ZpVector at = point_of(web, one->body[0], (const double[2]){arm.x, arm.y});
  const double values[JOINT_NUMBERS] = {at.x, at.y, (double)one->body[0], (double)one->body[1]};
  return give(web, values, JOINT_NUMBERS);
}

/* Pull at the load of an actuator or at a body of a network that moves with a force to the right and up, N, until the
 * next pull. What moves up and down takes the force up alone. */
EXPORT int zp_web_pull(ZpWeb *web, int body, double right, double up) {
  ZpError err;
  char called[ZP_NAME_SIZE], name[ZP_INPUT_NAME_SIZE];
  if (!zp_is_network(web->model)) return say(web, zp_sim_set_input(web->sim, ZP_INPUT_LOAD, -up, 0, &err), err.message);
  static const char *const way[] = {"force_x", "force_y"};
  ZpStatus status = ZP_OK;
  for (int k = 0; status == ZP_OK && k < 2; k++) {
    snprintf(name, sizeof name, "%s.%s", zp_body_called(&web->def, (size_t)body, called), way[k]);
    const int input = zp_def_input_find(&web->def, name);
    if (input >= 0 || k == 1) status = zp_sim_set_input(web->sim, (ZpInput)input, k ? up : right, 0, &err);
  }
  return say(web, status, err.message);
}

/* Both films of a pouch, which hang: x of the ribbon is downwards, and its films are left and right of it. */
static const double *hung(ZpWeb *web, size_t axis, ZpShape shape) {
  for (size_t i = 0; i < web->model->topology.stations; i++) {
    web->pair[axis][2 * i] = axis == 0 ? -shape.y[i] : -shape.x[i];
    web->pair[axis][2 * i + 1] = axis == 0 ? shape.y[i] : -shape.x[i];
  }
  return web->pair[axis];
}

/* x and y [members * nodes * 2] of interleaved faces, gap and line force [members * nodes]. */
static const double *paired(ZpWeb *web, size_t axis, const double *face, const double *ribbon) {
  const ZpTopology *topology = &web->model->topology;
  if (zp_is_pair(topology)) return ribbon;
  for (size_t i = 0; i < topology->stations; i++) {
    web->pair[axis][2 * i] = face[i];
    web->pair[axis][2 * i + 1] = ribbon[i];
  }
  return web->pair[axis];
}

EXPORT const double *zp_web_x(ZpWeb *web) {
  if (web->model->topology.along) return hung(web, 0, zp_sim_shape(web->sim));
  return paired(web, 0, web->model->face_x, zp_sim_shape(web->sim).x);
}

EXPORT const double *zp_web_y(ZpWeb *web) {
  if (web->model->topology.along) return hung(web, 1, zp_sim_shape(web->sim));
  return paired(web, 1, web->model->plates.face, zp_sim_shape(web->sim).y);
}

EXPORT const double *zp_web_gap(ZpWeb *web) {
  return zp_sim_shape(web->sim).gap;
}

EXPORT const double *zp_web_line_force(ZpWeb *web) {
  return zp_sim_shape(web->sim).line_force;
}

/* Film and pressure of the liquid [members * nodes], and the wet length of each modelled half; NULL if there is none.
 */
EXPORT const double *zp_web_film(ZpWeb *web) {
  return zp_sim_liquid(web->sim).thickness;
}

EXPORT const double *zp_web_pressure(ZpWeb *web) {
  return zp_sim_liquid(web->sim).pressure;
}

EXPORT const double *zp_web_wet_length(ZpWeb *web) {
  return zp_sim_liquid(web->sim).wet_length;
}

/* -- study ---------------------------------------------------------------------------------------- */

/* Run the scenario in the study named in the text. The text gets its message, or the reason of a refusal. */
EXPORT int zp_web_study(ZpWeb *web) {
  ZpError err;
  int study = zp_key_choice(zp_key_find("study"), web->text);
  if (study < 0) return say(web, ZP_BAD_INPUT, "unknown study");
  zp_result_destroy(web->result);
  ZpStatus status = zp_study_run((ZpStudy)study, &web->def, NULL, &hooks, &web->result, &err);
  snprintf(web->text, TEXT_SIZE, "%s", status == ZP_OK ? web->result->message : err.message);
  return (int)status;
}

EXPORT int zp_web_outcome(const ZpWeb *web) {
  return (int)web->result->outcome;
}

/* The number of the summary named in the text. */
EXPORT double zp_web_scalar(ZpWeb *web) {
  return zp_result_get(web->result, web->text);
}

EXPORT int zp_web_notes(const ZpWeb *web) {
  return (int)web->result->notes;
}

EXPORT const char *zp_web_note(const ZpWeb *web, int index) {
  return web->result->note[index];
}

EXPORT int zp_web_rows(const ZpWeb *web) {
  return (int)web->result->series->rows;
}

EXPORT int zp_web_columns(const ZpWeb *web) {
  return (int)web->result->series->columns;
}

EXPORT const char *zp_web_column(const ZpWeb *web, int column) {
  return web->result->series->column[column].name;
}

/* [rows][columns] */
EXPORT const double *zp_web_table(const ZpWeb *web) {
  return web->result->series->value;
}
