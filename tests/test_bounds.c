/* Every key at its bounds, just beyond them, and at what is no number; and combinations of extremes.
 *
 * Beyond: ZP_BAD_INPUT with the key's name in the message, and nothing changed. At the bounds: the study ends
 * with an outcome, soon, and no number in the result is infinite, or NAN where signals.def and study.h do
 * not say that it may not exist. That the numbers are also right is for other tests. */
#include <float.h>
#include <limits.h>
#include <time.h>

#include "data_util.h"

static const double most_seconds = FULL_OR(5.0, 100.0); /* a run of these few steps is a hang beyond */

/* Small and short, so that each run takes milliseconds: five nodes settle in 142400 steps by default (measured;
 * 0.01 s), all extremes but one in 600000, and then move for 0.1 ms, 80 steps. Large meshes end at max_steps: not
 * settled is an outcome, too. */
static ZpActuatorDef small_def(void) {
  ZpActuatorDef def = zp_actuator_def_default();
  def.mesh.nodes = 5;
  def.solver.max_steps = FULL_OR(600000, 20000);
  def.solver.end_time = 1e-4;
  def.output.samples = 20;
  def.output.shapes = 4;
  return def;
}

static double cpu_seconds(void) {
  return (double)clock() / CLOCKS_PER_SEC;
}

/* -- what a result may hold --------------------------------------------------------------------------- */

static bool has_insulators(const ZpActuatorDef *def) {
  bool bare = false; /* a member of a series */
  for (int key = zp_def_next_key(def, -1); key >= 0; key = zp_def_next_key(def, key))
    if (strcmp(zp_key(key)->name, "member_K.insulator.thickness") == 0) bare |= zp_def_get(def, key) == 0;
  return def->actuator.kind != ZP_KIND_RIBBON && def->insulator.thickness > 0 && !bare;
}

/* Numbers of one opening: each member of a network has its own. */
static bool of_one_opening(const char *name) {
  static const char *const parts[] = {"opening_m", "stroke_m", "zipped_length_m", "contraction", "end_velocity"};
  bool found = false;
  for (size_t k = 0; k < LENGTH_OF(parts) && !strchr(name, '.'); k++)
    found |= strstr(name, parts[k]) != NULL;
  return found;
}

/* Numbers that may not exist: no pull-in, never zipped, no opening to contract from, no work, no clock, no drag, at
 * rest, no step taken, a voltage that jumps; no voltage or stress that a margin could be of, no insulators; an
 * estimated error where a coarser mesh has no such number, or where there is none. */
static bool scalar_may_be_missing(const char *name, const ZpActuatorDef *def) {
  if (strstr(name, "_error_") || strncmp(name, "sense_", 6) == 0 || strstr(name, "_sense_"))
    return true; /* of windows that a run has none of */
  if (strncmp(name, "member_", 7) == 0 && strstr(name, "_zip_time_s")) return true;
  if (zp_def_network(def) && (of_one_opening(name) || strstr(name, ".zip_time_s") || strstr(name, ".closed_from_s")))
    return true;
  static const char *const of_insulators[] = {"insulator_field_V_per_m", "insulator_field_place_m",
                                              "allowed_voltage_V"};
  static const char *const names[] = {"pull_in_voltage_V",
                                      "release_voltage_V",
                                      "zip_time_s",
                                      "closed_from_s",
                                      "contraction",
                                      "energy_error",
                                      "real_time_factor",
                                      "mean_time_step_s",
                                      "smallest_drag_bound_s",
                                      "smallest_axial_bound_s",
                                      "smallest_shear_bound_s",
                                      "breakdown_margin",
                                      "yield_margin",
                                      "peak_current_A",
                                      "rms_current_A",
                                      "efficiency",
                                      "starved_time_s",
                                      "rise_time_s",
                                      "overshoot",
                                      "steady_state_error",
                                      "steady_state_ripple",
                                      "settling_time_s"};
  for (size_t i = 0; i < sizeof of_insulators / sizeof of_insulators[0]; i++)
    if (strcmp(name, of_insulators[i]) == 0) return !has_insulators(def);
  for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
    if (strcmp(name, names[i]) == 0) return true;
  return false;
}

static bool cell_may_be_missing(const char *name, const ZpActuatorDef *def) {
  if (zp_def_network(def) && of_one_opening(name)) return true;
  static const char *const of_two[] = {"opening_m", "upper_x_m", "upper_y_m", "upper_stress_Pa"};
  if (strcmp(name, "insulator_field_V_per_m") == 0) return !has_insulators(def);
  for (size_t i = 0; i < sizeof of_two / sizeof of_two[0]; i++)
    if (def->actuator.kind != ZP_KIND_ELECTRO_RIBBON && strcmp(name, of_two[i]) == 0) return true;
  if (strcmp(name, "angle_rad") == 0) return def->actuator.kind != ZP_KIND_HINGE;
  if (strncmp(name, "measured", 8) == 0) return true;                        /* before the first sample */
  if (strncmp(name, "sensed_", 7) == 0) return !isnan(def->sense.frequency); /* before its first reading */
  if (strstr(name, "_sensed_")) return true;
  return strcmp(name, "contraction") == 0;
}

/* A run that diverged, or a study that found no state, may lack these numbers: places, volumes, work and stress. */
static bool is_of_the_end(const char *name) {
  size_t length = strlen(name);
  static const char *const names[] = {"permanent_strain", "strain", "settle_residual"};
  for (size_t i = 0; i < LENGTH_OF(names); i++)
    if (strcmp(name, names[i]) == 0) return true;
  if (length > 3 && (strcmp(name + length - 3, "_m3") == 0 || strcmp(name + length - 3, "_Pa") == 0)) return true;
  if (length > 4 && strcmp(name + length - 4, "_rad") == 0) return true;
  return length > 2 && (strcmp(name + length - 2, "_m") == 0 || strcmp(name + length - 2, "_J") == 0);
}

static void check_scalars(const ZpResult *result, const ZpActuatorDef *def, const char *what) {
  bool lost = result->outcome == ZP_NOT_SETTLED || result->outcome == ZP_DIVERGED || result->outcome == ZP_BEYOND_MODEL;
  for (size_t i = 0; i < result->scalars; i++) {
    const ZpScalar *s = &result->scalar[i];
    bool may = scalar_may_be_missing(s->name, def) || (lost && is_of_the_end(s->name));
    ck_assert_msg(!isinf(s->value), "%s (%s): %s is infinite", what, zp_outcome_name(result->outcome), s->name);
    ck_assert_msg(may || !isnan(s->value), "%s (%s): %s is NAN", what, zp_outcome_name(result->outcome), s->name);
  }
}

static void check_table(const ZpResult *result, const ZpActuatorDef *def, const char *what) {
  const ZpTable *table = result->series;
  for (size_t row = 0; row < table->rows; row++)
    for (size_t c = 0; c < table->columns; c++) {
      double value = table->value[row * table->columns + c];
      const char *name = table->column[c].name, *outcome = zp_outcome_name(result->outcome);
      bool may = cell_may_be_missing(name, def) || (row + 1 == table->rows && strcmp(name, "tension_N") == 0);
      bool rises = strcmp(name, "voltage_V") != 0; /* a branch turns round */
      ck_assert_msg(!isinf(value), "%s (%s): %s infinite in row %zu of %zu", what, outcome, name, row, table->rows);
      ck_assert_msg(may || !isnan(value), "%s (%s): %s NAN in row %zu of %zu", what, outcome, name, row, table->rows);
      ck_assert_msg(row == 0 || c > 0 || !rises || value > table->value[(row - 1) * table->columns],
                    "%s: time stands still", what);
    }
}

/* The field in insulators, where there are none, is the last of a frame. */
static void check_shapes(const ZpResult *result, const ZpActuatorDef *def, const char *what) {
  const ZpShapes *shapes = result->shapes;
  size_t numbers = shapes->frame_size - (has_insulators(def) ? 0 : shapes->nodes);
  for (size_t f = 0; f < shapes->frames; f++)
    for (size_t k = 0; k < numbers; k++)
      ck_assert_msg(isfinite(shapes->value[f * shapes->frame_size + k]),
                    "%s (%s): number %zu of frame %zu is not finite", what, zp_outcome_name(result->outcome), k, f);
}

/* What a run that resumes begins with: the hanging equilibrium; NULL of others. */
static ZpCheckpoint *start_of(const ZpActuatorDef *def) {
  if (def->initial.state != ZP_INITIAL_CHECKPOINT) return NULL;
  ZpActuatorDef hanging = *def;
  hanging.initial.state = ZP_INITIAL_EQUILIBRIUM;
  ZpCheckpoint *start = NULL;
  ZpSim *sim = sim_of(model_of(&hanging));
  ck_assert_int_eq(zp_sim_checkpoint(sim, &start, NULL), ZP_OK);
  return start;
}

/* Run it and look at all that comes out. Returns the outcome. */
static ZpOutcome run_and_check(ZpStudy study, const ZpActuatorDef *def, const char *what) {
  ZpResult *result = NULL;
  ZpError err = {ZP_OK, ""};
  double start = cpu_seconds();
  ZpActuatorDef bounded = *def;
  int most_steps = def->mesh.nodes > 200 ? 20000 : 100000; /* 0.3 s, 1.5 s */
  if (def->solver.max_steps > most_steps) bounded.solver.max_steps = most_steps;
  const ZpDriveTable table = {3, (const double[]){0, 5e-5, 5e-5}, (const double[]){-1e6, 1e6, 0}};
  bool by_table = def->drive.waveform == ZP_WAVEFORM_TABLE || def->setpoint.waveform == ZP_WAVEFORM_TABLE;
  ZpCheckpoint *from = start_of(&bounded);
  ZpStudyInput input = {.table = by_table ? &table : NULL, .start = from};
  ZpStatus status = zp_study_run(study, &bounded, &input, NULL, &result, &err);
  double seconds = cpu_seconds() - start;
  ck_assert_msg(status == ZP_OK, "%s: %s", what, err.message);
  ck_assert_msg(seconds < most_seconds, "%s: took %g s", what, seconds);
  ck_assert_msg(*result->message, "%s: no message", what);
  check_scalars(result, def, what);
  check_table(result, def, what);
  check_shapes(result, def, what);
  zp_checkpoint_destroy(from);
  ZpOutcome outcome = result->outcome;
  if (getenv("ZP_SHOW_OUTCOMES")) printf("%-60s %-12s %.3f s\n", what, zp_outcome_name(outcome), seconds);
  zp_result_destroy(result);
  return outcome;
}

/* -- one key at a time --------------------------------------------------------------------------------- */

/* A meter around one of its keys, of whole samples in whole periods. */
static void make_meter(ZpActuatorDef *def, const char *key, double value) {
  bool of_rate = strcmp(key, "sense.sampling_rate") == 0, of_bandwidth = strcmp(key, "sense.bandwidth") == 0;
  double f = strcmp(key, "sense.frequency") == 0 ? value : of_rate ? fmin(value / 8, 1e7) : of_bandwidth ? 4e6 : 1e5;
  def->sense.frequency = f;
  def->sense.sampling_rate = of_rate ? value : 8 * f;
  def->sense.bandwidth = of_bandwidth ? value : fmin(f / 4, 1e6);
  if (isnan(def->sense.amplitude)) def->sense.amplitude = 10;
}

/* A controller around one of its keys, or of its setpoint's. */
static void make_controller(ZpActuatorDef *def, const char *key, double value) {
  bool unset = strcmp(key, "control.kind") == 0 && value == ZP_CONTROL_NONE;
  if (unset) return;
  def->control.kind = strstr(key, "boost") ? ZP_CONTROL_BOOST_PI : ZP_CONTROL_PI;
  def->control.proportional = 1e6;
  def->control.integral = 1e6;
  def->control.period = strcmp(key, "control.delay") == 0 ? 1e-5 : 2e-5;
  def->setpoint.value = 1e-3;
  if (strcmp(key, "setpoint.rise_time") == 0 && value > 0) def->setpoint.waveform = ZP_WAVEFORM_RAMP;
  if (strcmp(key, "setpoint.waveform") == 0 && value == ZP_WAVEFORM_RAMP) def->setpoint.rise_time = 1e-4;
  if (strcmp(key, "setpoint.frequency") == 0) def->setpoint.waveform = ZP_WAVEFORM_SINE;
  if (strcmp(key, "setpoint.offset") == 0) {
    def->setpoint.waveform = ZP_WAVEFORM_SINE;
    def->control.signal = ZP_CONTROL_STROKE;
  }
  if (strcmp(key, "setpoint.value") == 0) def->control.signal = ZP_CONTROL_STROKE;
  if (strcmp(key, "setpoint.duty") == 0) def->setpoint.waveform = ZP_WAVEFORM_SQUARE;
}

/* A platform that turns, long enough for the load to hang there. */
static void make_platform_turn(ZpActuatorDef *def, const char *key, double value) {
  bool offset = strcmp(key, "load.offset") == 0;
  bool turns = strcmp(key, "platform.rotates") == 0 || strcmp(key, "actuator.held_clip") == 0;
  if (value == 0 || !(offset || turns)) return;
  def->actuator.symmetry = ZP_SYMMETRY_NONE;
  def->liquid.model = ZP_LIQUID_NONE;
  def->platform.rotates = true;
  def->platform.electrode = false;
  if (offset) def->platform.length = 2 * fabs(value), def->ribbon.length = 10;
}

/* Eight bodies, one below the other, with a member between each and the one above it, and a spring from the frame
 * to each. */
static void make_network(ZpActuatorDef *def) {
  for (int k = 1; k <= 8; k++) {
    zp_def_set(def, zp_key_of_instance(ZP_KEY(body_K.mass), k), 1e-4, NULL);
    zp_def_set(def, zp_key_of_instance(ZP_KEY(member_K.upper), k), k - 1, NULL);
    zp_def_set(def, zp_key_of_instance(ZP_KEY(member_K.lower), k), k, NULL);
    zp_def_set(def, zp_key_of_instance(ZP_KEY(spring_K.first), k), 0, NULL);
    zp_def_set(def, zp_key_of_instance(ZP_KEY(spring_K.second), k), k, NULL);
  }
  lend_members(def);
  def->load.mass = zp_actuator_def_default().load.mass;
}

/* The same in the plane. */
static void make_plane(ZpActuatorDef *def) {
  make_network(def);
  def->liquid.model = ZP_LIQUID_NONE;
  def->solver.max_steps = 20000; /* 4 s */
  for (int k = 1; k <= 8; k++) {
    zp_def_set(def, zp_key_of_instance(ZP_KEY(body_K.moves), k), ZP_MOVES_PLANE, NULL);
    zp_def_set(def, zp_key_of_instance(ZP_KEY(body_K.inertia), k), 1e-6, NULL);
    zp_def_set(def, zp_key_of_instance(ZP_KEY(body_K.at.y), k), -1e-2 * k, NULL);
  }
  zp_def_set(def, zp_key_of_instance(ZP_KEY(spring_K.direction), 8), 0, NULL);
  zp_def_set(def, zp_key_of_instance(ZP_KEY(spring_K.kind), 8), ZP_SPRING_PUSH, NULL);
  lend_members(def);
}

/* Does a key count in the plane only? */
static bool is_of_plane(const char *key) {
  static const char *const keys[] = {"member_8.upper_at", "member_8.lower_at", "body_8.inertia", "body_8.moves",
                                     "body_8.angle",      "body_8.torque",     "body_8.force.x", "spring_8.direction",
                                     "spring_8.friction", "spring_8.from_at",  "spring_8.to_at"};
  for (size_t k = 0; k < LENGTH_OF(keys); k++)
    if (strncmp(key, keys[k], strlen(keys[k])) == 0) return true;
  return false;
}

/* Eight members, of which one has a key; the key that it has as a single actuator. */
static const char *make_members(ZpActuatorDef *def, const char *key) {
  static const char member[] = "member_8.";
  if (is_of_plane(key))
    make_plane(def);
  else if (strcmp(key, "member_8.upper") == 0 || strcmp(key, "member_8.lower") == 0 ||
           strcmp(key, "member_8.angle") == 0 || strncmp(key, "body_", 5) == 0 || strncmp(key, "spring_", 7) == 0)
    make_network(def);
  if (strncmp(key, member, sizeof member - 1) != 0) return key;
  def->stack.series = zp_def_network(def) ? 1 : 8;
  return key + sizeof member - 1;
}

/* A waveform that has the key. */
static void make_drive(ZpActuatorDef *def, const char *key, double value, bool of_member) {
  if (of_member && value > 0 && strcmp(key, "drive.rise_time") == 0) def->drive.rise_time = 5e-5;
  if (of_member && value > 0 && strcmp(key, "setpoint.rise_time") == 0) def->setpoint.rise_time = 5e-5;
  if (of_member && strcmp(key, "source.supply") == 0) def->drive.voltage = 1e3;
  if (!of_member && strcmp(key, "drive.waveform") == 0 && value == ZP_WAVEFORM_RAMP) def->drive.rise_time = 5e-5;
  if (strcmp(key, "drive.rise_time") == 0 && value > 0) def->drive.waveform = ZP_WAVEFORM_RAMP;
  if (strcmp(key, "drive.delay") == 0) def->drive.waveform = ZP_WAVEFORM_SINE;
  if (strcmp(key, "drive.offset") == 0 || strcmp(key, "drive.frequency") == 0) def->drive.waveform = ZP_WAVEFORM_SINE;
  if (strcmp(key, "drive.duty") == 0) def->drive.waveform = ZP_WAVEFORM_SQUARE;
}

/* The kind whose keys these are. */
static void make_kind(ZpActuatorDef *def, const char *key, double value) {
  if (strncmp(key, "plate.", 6) == 0) def->actuator.kind = ZP_KIND_PLATE;
  if (strcmp(key, "plate.stop_gap") == 0) def->plate.gap = fmin(fmax(2 * value, 1e-6), 0.1);
  if (strncmp(key, "pouch.", 6) == 0 || strcmp(key, "isometric.strain") == 0 ||
      (strcmp(key, "actuator.kind") == 0 && value == ZP_KIND_POUCH))
    def->actuator.kind = ZP_KIND_POUCH, def->liquid.lateral_flow = false;
  if (strcmp(key, "pouch.electrode_length") == 0) def->ribbon.length = fmin(2 * value, 10);
  if (strcmp(key, "ribbon.tension") == 0) def->actuator.kind = ZP_KIND_FLANGE, def->actuator.right_end = ZP_END_CLAMPED;
}

/* Keys that come in pairs: of layers that creep, and of a bleeder. */
static void make_other(ZpActuatorDef *def, const char *key, double value) {
  if (strcmp(key, "source.bleeder_voltage") == 0) def->source.bleeder = 1e9;
  if (strcmp(key, "ribbon.relaxation_modulus") == 0 && value > 0) def->ribbon.relaxation_time = 1;
  if (strcmp(key, "ribbon.relaxation_time") == 0) def->ribbon.relaxation_modulus = 1e9;
  if (strcmp(key, "insulator.relaxation_modulus") == 0 && value > 0) def->insulator.relaxation_time = 1;
  if (strcmp(key, "insulator.relaxation_time") == 0) def->insulator.relaxation_modulus = 1e9;
  if (strstr(key, "hardening_modulus")) def->ribbon.plasticity = true;
}

/* Patches of the faces that leak are those of a liquid that conducts; each key requires the other. */
static bool make_patches(ZpActuatorDef *def, const char *key, double value) {
  if (strncmp(key, "electro.leak_", 13) != 0) return false;
  const bool share = strcmp(key, "electro.leak_share") == 0;
  def->medium.resistivity = 1e9;
  if (!share) def->electro.leak_share = 0.1;
  if (share && value > 0) def->electro.leak_ratio = 10;
  return true;
}

/* What keys ask of one another, so that one of them can stand at its bound. */
static void make_room(ZpActuatorDef *def, const char *key, double value) {
  const bool of_member = strncmp(key, "member_", 7) == 0;
  key = make_members(def, key);
  make_kind(def, key, value);
  make_other(def, key, value);
  if (strcmp(key, "platform.length") == 0 && value > 0) def->ribbon.length = 10;
  if (strcmp(key, "ribbon.length") == 0 && value < 0.01) def->platform.length = 0.5 * value;
  bool unilateral = strcmp(key, "contact.model") == 0 && value == ZP_CONTACT_UNILATERAL;
  bool implicit = strcmp(key, "solver.integrator") == 0 && value == ZP_INTEGRATOR_IMPLICIT;
  if (strncmp(key, "source.", 7) == 0) {
    implicit = true;
    def->source.model = ZP_SOURCE_AMPLIFIER;
  }
  if (strcmp(key, "source.voltage_limit") == 0) def->drive.voltage = fmin(value, def->drive.voltage);
  if (strncmp(key, "sense.", 6) == 0) make_meter(def, key, value);
  if (strncmp(key, "control.", 8) == 0 || strncmp(key, "setpoint.", 9) == 0) make_controller(def, key, value);
  bool changes = strncmp(key, "load.change_", 12) == 0 || strcmp(key, "load.drop_height") == 0;
  if (make_patches(def, key, value) || strstr(key, ".resistivity") || def->ribbon.plasticity || changes)
    implicit = true;
  if (unilateral || implicit || (strcmp(key, "damping.internal") == 0 && value > 0)) {
    def->contact.model = ZP_CONTACT_UNILATERAL;
    def->solver.integrator = ZP_INTEGRATOR_IMPLICIT;
  }
  if (strncmp(key, "segment_", 8) == 0 && strstr(key, ".length") && value > 0) {
    if (!of_member) def->actuator.kind = ZP_KIND_RIBBON;
    def->ribbon.length = value;
  }
  if (strncmp(key, "lower.segment_", 14) == 0 && strstr(key, ".length") && value > 0) {
    def->actuator.kind = ZP_KIND_HINGE; /* whose ribbons have their length from the one end to the other */
    def->ribbon.length = value;
  }
  bool opposed = strcmp(key, "stack.distance") == 0;
  if (strcmp(key, "stack.voltage_ratio") == 0 || strcmp(key, "stack.lower_voltage") == 0)
    opposed = true, def->stack.distance = 0.05;
  if (strcmp(key, "stack.link_mass") == 0 || opposed) def->stack.series = 2;
  if (strcmp(key, "stack.distance") == 0) def->ribbon.length = fmin(fmax(value + def->platform.length, 0.1), 10);
  if (strcmp(key, "lower.ribbon.density") == 0 && value == 0) def->lower.insulator.density = 1000;
  if (strcmp(key, "load.stiffness") == 0 && value > 0) def->load.rest_opening = 1e-3;
  if (strcmp(key, "load.rest_opening") == 0) def->load.stiffness = 1;
  if (strncmp(key, "counter.", 8) == 0)
    def->actuator.kind = ZP_KIND_CURVED, def->ribbon.length = 10, def->electro.gap_offset = 0.1;
  if (strncmp(key, "hinge.", 6) == 0) def->actuator.kind = ZP_KIND_HINGE;
  if (strcmp(key, "hinge.rest_angle") == 0) def->hinge.stiffness = 1;
  if (strcmp(key, "load.change_mass") == 0 && value != 0) def->load.change_time = 1e-5, def->load.mass = fabs(value);
  if (strcmp(key, "load.change_time") == 0 || (strcmp(key, "load.drop_height") == 0 && value > 0))
    def->load.change_mass = 1e-3;
  if (strcmp(key, "load.drop_height") == 0 && value > 0) def->load.change_time = 1e-5;
  make_platform_turn(def, key, value);
  if (strcmp(key, "load.stop_stiffness") == 0) def->load.stop_opening = 1e-3;
  if (strcmp(key, "insulator.thickness") == 0 && value == 0) def->drive.voltage = 0;
  if (strcmp(key, "contact.complete_margin") == 0 && value > 0) def->mesh.nodes = (int)value + 2;
  bool of_bezier = strcmp(key, "electro.switch_offset") == 0 || strcmp(key, "electro.refresh_period") == 0;
  if (of_bezier) def->electro.surface = ZP_SURFACE_BEZIER;
  if (of_bezier || (strcmp(key, "electro.surface") == 0 && value == ZP_SURFACE_BEZIER) ||
      (strcmp(key, "contact.model") == 0 && value == ZP_CONTACT_SEQUENTIAL)) {
    def->contact.model = ZP_CONTACT_SEQUENTIAL;
    def->solver.integrator = ZP_INTEGRATOR_EXPLICIT;
  }
  make_drive(def, key, value, of_member);
}

/* What cannot move is looked at at rest. */
static ZpStudy study_for(const char *key, double value) {
  bool rests = strcmp(key, "actuator.kind") == 0 && value == ZP_KIND_FLANGE;
  bool weightless = value == 0 && (strcmp(key, "ribbon.density") == 0 || strcmp(key, "plate.mass") == 0);
  return rests || weightless ? ZP_STUDY_STATIONARY : ZP_STUDY_ACTUATE;
}

/* Of key study every word but the last, calibrate, which needs data: test_calibrate. */
static void run_each_study(void) {
  ZpActuatorDef def = small_def();
  for (int study = 0; study < ZP_STUDY_CALIBRATE; study++)
    run_and_check((ZpStudy)study, &def, zp_study_name((ZpStudy)study));
}

/* Ends of ranges that get a sentence of their own: a controller that hardly samples, or far too late; a source that
 * never charges, or that is faster than any step; a meter without a whole period or with fewer samples. */
static bool has_its_own_words(const char *key, double value) {
  static const char *const ends[] = {"member_8.upper", "member_8.lower", "spring_8.first", "spring_8.second"};
  for (size_t k = 0; k < LENGTH_OF(ends); k++) /* no such body, or the body below hangs on nothing */
    if (strcmp(key, ends[k]) == 0) return value > 8 || strcmp(key, "member_8.lower") == 0 || k == 3;
  if (strncmp(key, "member_8.", 9) == 0 && strstr(key, "_at.")) return true; /* far from its other end */
  if (strcmp(key, "body_8.inertia") == 0 || strcmp(key, "body_8.moves") == 0) return value == 0;
  if (strcmp(key, "isometric.body") == 0) return value > 0;
  if (strncmp(key, "member_8.", 9) == 0) {
    key += 9; /* a table is that of all; a half of the longest ribbon is shorter than the longest segment */
    if (strstr(key, "waveform")) return value == ZP_WAVEFORM_TABLE || value == ZP_WAVEFORM_RAMP; /* without its time */
    if (strncmp(key, "segment_", 8) == 0 && strstr(key, ".length")) return value > 5;
  }
  if (strcmp(key, "drive.voltage") == 0 || strcmp(key, "modes.voltage") == 0) return value < 0; /* no sign counts */
  if (strcmp(key, "control.signal") == 0) return value == ZP_CONTROL_ANGLE;                     /* nothing turns */
  if (strcmp(key, "sense.sampling_rate") == 0) return value < 8;
  if (strcmp(key, "control.period") == 0) return value > 1;
  if (strcmp(key, "control.delay") == 0) return value > 8e-5;
  if (strcmp(key, "source.bandwidth") == 0) return value > 1e9;
  if (strcmp(key, "pouch.electrode_length") == 0) return value > 9.5; /* no room for the liquid */
  if (strcmp(key, "pouch.fill") == 0) return value > 1.3;             /* more than a round pouch holds */
  if (strcmp(key, "plate.stop_gap") == 0) return value >= 0.1;        /* not below the widest gap */
  return value == 0 && (strcmp(key, "source.slew_rate") == 0 || strcmp(key, "source.current_limit") == 0);
}

static void run_at(int index, double value) {
  const char *name = ZP_KEY_NAME(index);
  ZpActuatorDef def = small_def();
  ZpError err = {ZP_OK, ""};
  char what[128];
  snprintf(what, sizeof what, "%s = %g", name, value);
  make_room(&def, name, value);
  ck_assert_msg(zp_def_set(&def, index, value, &err) == ZP_OK, "%s: %s", what, err.message);
  ZpStudy study = study_for(name, value);
  if (has_its_own_words(name, value)) {
    ZpModel *model = NULL;
    ZpStatus status = zp_study_check(study, &def, &err);
    if (status == ZP_OK) status = zp_model_create(&def, &model, &err);
    zp_model_destroy(model);
    ck_assert_msg(status == ZP_BAD_INPUT, "%s is not refused", what);
    return;
  }
  ck_assert_msg(zp_study_check(study, &def, &err) == ZP_OK, "%s: %s", what, err.message);
  run_and_check(study, &def, what);
}

NIGHTLY_TESTS(study_ends_at_the_bounds, 0, zp_key_count()) {
  const ZpKey *key = zp_key(_i);
  const int index = key_of_one(_i);
  if (key->type == ZP_KEY_TEXT) return;
  if (!zp_key_in_def(index)) {
    run_each_study();
    return;
  }
  run_at(index, key->min);
  if (key->max > key->min) run_at(index, key->max);
  for (double word = 1; key->type == ZP_KEY_ENUM && word < key->max; word++) {
    bool preset = strcmp(key->name, "preset") == 0; /* applied by zp_def_resolve: see below */
    if (!preset) run_at(index, word);
  }
}

/* zp_def_set refuses `value`, names the key and changes nothing; so does zp_def_check if it is in the Def
 * all the same, as after an assignment in C. */
static void refuse(int index, double value) {
  ZpActuatorDef def = zp_actuator_def_default(), before = def;
  ZpError err = {ZP_OK, ""};
  const char *name = ZP_KEY_NAME(index);
  ck_assert_msg(zp_def_set(&def, index, value, &err) == ZP_BAD_INPUT, "%s = %.17g was taken", name, value);
  ck_assert_int_eq(err.status, ZP_BAD_INPUT);
  ck_assert_msg(strstr(err.message, name), "%s = %.17g: \"%s\"", name, value, err.message);
  ck_assert_mem_eq(&def, &before, sizeof def);
  ck_assert_int_eq(zp_def_set(&def, index, value, NULL), ZP_BAD_INPUT);
  ZpAssignment list = {index, value};
  ck_assert_int_eq(zp_def_resolve(&def, &list, 1, &err), ZP_BAD_INPUT);
}

/* Smallest value above, largest below that a key of this type can be given. */
static double next_to(const ZpKey *key, double value, double direction) {
  bool real = key->type == ZP_KEY_REAL || key->type == ZP_KEY_REAL_AUTO;
  return real ? nextafter(value, direction) : value + (direction > 0 ? 1 : -1);
}

TESTS(beyond_the_bounds_is_refused, 0, zp_key_count()) {
  const ZpKey *key = zp_key(_i);
  const int index = key_of_one(_i);
  bool real = key->type == ZP_KEY_REAL || key->type == ZP_KEY_REAL_AUTO;
  refuse(index, next_to(key, key->min, -INFINITY));
  refuse(index, next_to(key, key->max, INFINITY));
  refuse(index, INFINITY);
  refuse(index, -INFINITY);
  refuse(index, DBL_MAX);
  if (key->type != ZP_KEY_REAL_AUTO) refuse(index, NAN);
  if (!real) refuse(index, key->min + 0.5);
  if (!real) refuse(index, 1e300);
}

/* Where the field of the Def is written to directly, zp_def_check stands guard for all that use a Def. */
static void refuse_field(ZpActuatorDef *def, const char *name) {
  ZpError err = {ZP_OK, ""};
  ZpModel *model = (ZpModel *)def;
  ZpResult *result = (ZpResult *)def;
  ck_says(zp_def_check(def, &err), ZP_BAD_INPUT, name);
  ck_assert_int_eq(zp_model_create(def, &model, &err), ZP_BAD_INPUT);
  ck_assert_ptr_null(model);
  ck_assert_int_eq(zp_study_run(ZP_STUDY_ACTUATE, def, NULL, NULL, &result, &err), ZP_BAD_INPUT);
  ck_assert_ptr_null(result);
}

/* Where the field of each key is. */
#define ZP_EACH_KEY(path, field, text) offsetof(ZpActuatorDef, path field),
#define ZP_OF_SCENARIO(...)            0,
#define segment_K                      segment_K[0]
static const size_t field_of[] = {
#include "def/keys.def"
};
#undef segment_K

TESTS(bad_fields_are_refused, 0, zp_key_count()) {
  const ZpKey *key = zp_key(_i);
  ZpActuatorDef def = zp_actuator_def_default();
  if (!zp_key_in_def(_i)) return;
  void *field = (char *)&def + field_of[_i];
  if (key->type == ZP_KEY_TEXT) {
    memset(field, 'x', ZP_TEXT_SIZE);
    refuse_field(&def, key->name);
    return;
  }
  double real[] = {INFINITY, -INFINITY, nextafter(key->max, INFINITY), nextafter(key->min, -INFINITY)};
  double whole[] = {key->min - 1, key->max + 1}; /* what no int can hold cannot be given */
  bool is_real = key->type == ZP_KEY_REAL || key->type == ZP_KEY_REAL_AUTO;
  for (size_t k = 0; is_real && k < 4; k++) {
    memcpy(field, &real[k], sizeof real[k]);
    refuse_field(&def, key->name);
  }
  for (size_t k = 0; !is_real && key->type != ZP_KEY_BOOL && k < 2; k++) {
    if (whole[k] < INT_MIN || whole[k] > INT_MAX) continue;
    memcpy(field, &(int){(int)whole[k]}, sizeof(int));
    refuse_field(&def, key->name);
  }
}

/* -- words ----------------------------------------------------------------------------------------------- */

/* zp_value_parse and --set refuse `text` with a message that names the key and what would be allowed. */
static void refuse_text(int index, const char *text) {
  const ZpKey *key = zp_key(index);
  ZpError err = {ZP_OK, ""};
  double value = 42;
  char argument[256];
  ck_assert_msg(zp_value_parse(index, text, &value, &err) == ZP_BAD_INPUT, "%s = \"%s\" was taken", key->name, text);
  ck_assert_msg(strstr(err.message, key->name), "%s = \"%s\": \"%s\"", key->name, text, err.message);
  ck_assert_double_eq(value, 42);
  snprintf(argument, sizeof argument, "%s=%s", key->name, text);
  ZpScenario *scenario = new_scenario();
  ck_assert_msg(zp_scenario_set(scenario, argument, &err) == ZP_BAD_INPUT, "%s was taken", argument);
  ck_assert_msg(strstr(err.message, key->name), "%s: \"%s\"", argument, err.message);
}

TESTS(wrong_words_are_refused, 0, zp_key_count()) {
  static const char *const never[] = {"nonsense",
                                      "NaN",
                                      "nan",
                                      "inf",
                                      "-inf",
                                      "Infinity",
                                      "1e999",
                                      "-1e999",
                                      "0x10",
                                      "1 furlong fortnight",
                                      "1 kg m s A K mol cd",
                                      "--1",
                                      "1..2",
                                      "1e",
                                      "none of these"};
  const ZpKey *key = zp_key(_i);
  if (key->type == ZP_KEY_TEXT) return; /* any words are right */
  for (size_t k = 0; k < sizeof never / sizeof never[0]; k++)
    refuse_text(_i, never[k]);
  if (key->type == ZP_KEY_INT) refuse_text(_i, "5.5");
  if (key->type == ZP_KEY_INT || key->type == ZP_KEY_REAL) refuse_text(_i, "auto");
  if (key->type == ZP_KEY_ENUM) refuse_text(_i, "0");
}

/* Numbers beyond the bounds, written with 17 digits: the message has the range in the unit people use. */
TESTS(text_beyond_the_bounds_is_refused, 0, zp_key_count()) {
  const ZpKey *key = zp_key(_i);
  ZpError err;
  char text[64];
  double value;
  if (key->type == ZP_KEY_BOOL || key->type == ZP_KEY_ENUM || key->type == ZP_KEY_TEXT) return;
  snprintf(text, sizeof text, "%.17g", next_to(key, key->max, INFINITY));
  refuse_text(_i, text);
  ck_assert_int_eq(zp_value_parse(_i, text, &value, &err), ZP_BAD_INPUT);
  char most[64];
  zp_value_print(_i, key->max, most, sizeof most);
  ck_assert_msg(strstr(err.message, most), "%s: no \"%s\" in \"%s\"", key->name, most, err.message);
  if (key->min == 0) return; /* the number next to 0 is too small to be read */
  snprintf(text, sizeof text, "%.17g", next_to(key, key->min, -INFINITY));
  refuse_text(_i, text);
}

/* -- pairs of extremes ------------------------------------------------------------------------------------ */

/* A list of "key=value" separated by spaces; the Def is small_def with them. */
static ZpActuatorDef def_of_settings(const char *settings) {
  ZpActuatorDef def = small_def();
  char copy[512], *rest = NULL;
  snprintf(copy, sizeof copy, "%s", settings);
  for (char *word = strtok_r(copy, " ", &rest); word; word = strtok_r(NULL, " ", &rest)) {
    char *equals = strchr(word, '=');
    double value;
    ck_assert_ptr_nonnull(equals);
    *equals = 0;
    int key = zp_key_find(word);
    ck_assert_msg(key >= 0, "%s", word);
    ck_ok(zp_value_parse(key, equals + 1, &value, &err));
    ck_ok(zp_def_set(&def, key, value, &err));
  }
  lend_members(&def);
  return def;
}

static const char *const combinations[] = {
    "load.mass=0 gravity=0",
    "load.mass=0 gravity=0 drive.voltage=0",
    "load.mass=0 gravity=0 initial.state=straight",
    "load.mass=0 gravity=0 drive.voltage=0 initial.state=straight",
    "gravity=0 drive.voltage=1MV",
    "gravity=1000m/s2 load.mass=1000kg",
    "gravity=1000m/s2 load.mass=1000kg drive.voltage=1MV",
    "load.share=0",
    "load.share=0 ribbon.density=1kg/m3",
    "load.mass=1000kg ribbon.density=1kg/m3",
    "insulator.thickness=0 drive.voltage=0",
    "insulator.thickness=0 drive.voltage=0 initial.state=straight",
    "insulator.thickness=0 drive.voltage=0 electro.surface=bezier contact.model=sequential solver.integrator=explicit",
    "actuator.kind=flange insulator.thickness=0 electro.gap_offset=1mm drive.voltage=1MV",
    "actuator.kind=flange insulator.thickness=0 electro.gap_offset=1um electro.breakdown_cap=false",
    "electro.insulator_offset=0 drive.voltage=1MV",
    "electro.insulator_offset=1cm electro.force_scale=1000 drive.voltage=1MV",
    "platform.length=0",
    "platform.length=0 mesh.nodes=4",
    "platform.length=0 platform.electrode=false drive.voltage=1MV",
    "platform.length=90mm",
    "mesh.nodes=4",
    "mesh.nodes=4 electro.surface=bezier contact.model=sequential solver.integrator=explicit",
    "mesh.nodes=4 initial.state=straight",
    "mesh.nodes=4 drive.voltage=1MV",
    "mesh.nodes=4 contact.complete_margin=2",
    "mesh.nodes=2001",
    "drive.voltage=1MV",
    "drive.voltage=1MV electro.breakdown_cap=false",
    "drive.voltage=1MV electro.surface=bezier contact.model=sequential solver.integrator=explicit "
    "electro.breakdown_cap=false",
    "drive.voltage=1MV electro.force_scale=1000 electro.breakdown_cap=false",
    "drive.voltage=1MV medium.breakdown_field=10000MV/m medium.permittivity=10000",
    "drive.voltage=1MV medium.breakdown_field=1000V/m",
    "drive.voltage=1MV initial.state=straight",
    "drive.voltage=0 initial.state=straight",
    "ribbon.density=1kg/m3",
    "ribbon.density=30000kg/m3 insulator.density=30000kg/m3 ribbon.thickness=5mm",
    "ribbon.density=1kg/m3 ribbon.thickness=1um ribbon.young_modulus=1000GPa",
    "ribbon.thickness=5mm ribbon.length=1mm platform.length=0",
    "ribbon.thickness=1um ribbon.length=10m ribbon.young_modulus=1MPa",
    "ribbon.length=10m ribbon.density=30000kg/m3",
    "insulator.young_modulus=1000GPa insulator.thickness=5mm",
    "mass_spring.shear_coefficient=0",
    "mass_spring.shear_coefficient=0 drive.voltage=1MV",
    "mass_spring.shear_coefficient=1e15",
    "mass_spring.axial=code mesh.nodes=4",
    "damping.drag=1000000 drive.voltage=1MV",
    "damping.drag=1000000 initial.state=straight",
    "initial.state=straight",
    "initial.state=straight electro.surface=bezier contact.model=sequential solver.integrator=explicit",
    "initial.state=straight load.mass=0",
    "initial.state=straight electro.surface=bezier contact.model=sequential solver.integrator=explicit "
    "drive.voltage=1MV electro.breakdown_cap=false",
    "electro.surface=bezier contact.model=sequential solver.integrator=explicit electro.refresh_period=1s "
    "electro.switch_offset=0.1m drive.voltage=1MV",
    "electro.voltage_share=0",
    "electro.force_scale=0",
    "solver.time_step=1s",
    "solver.time_step=1e-12s solver.end_time=1e-9s",
    "solver.time_step=1e-12s solver.end_time=1e4s",
    "solver.max_steps=1",
    "solver.end_time=1e-9s",
    "output.samples=10 output.shapes=2",
    "output.samples=1000000 output.shapes=2",
    "actuator.kind=ribbon actuator.right_end=guided",
    "actuator.kind=ribbon actuator.right_end=free",
    "actuator.kind=ribbon actuator.right_end=clamped",
    "actuator.kind=ribbon actuator.right_end=guided load.mass=0 gravity=0",
    "actuator.kind=ribbon actuator.right_end=free load.mass=0 gravity=0",
    "actuator.kind=ribbon actuator.right_end=clamped load.mass=0 gravity=0",
    "actuator.kind=ribbon actuator.right_end=free load.mass=1000kg",
    "actuator.kind=ribbon actuator.right_end=free initial.state=straight mesh.nodes=4",
    "actuator.kind=ribbon actuator.right_end=guided initial.state=straight damping.drag=1000000",
    "actuator.kind=ribbon actuator.right_end=clamped mesh.nodes=2001 initial.state=straight",
    "actuator.kind=ribbon platform.length=1m insulator.thickness=0 electro.breakdown_cap=false",
    "actuator.kind=ribbon contact.complete_margin=1000",
    "drive.voltage=1MV",
    "drive.voltage=1MV electro.breakdown_cap=false",
    "initial.state=straight",
    "mesh.nodes=4 damping.internal=1s",
    "load.mass=0 gravity=0 initial.state=straight drive.voltage=0",
    "damping.drag=1000000",
    "solver.tolerance=1e-9",
    "solver.end_time=1e-9s",
    "platform.length=0 platform.electrode=false",
    "gravity=1000m/s2 load.mass=1000kg",
    "actuator.kind=ribbon actuator.right_end=clamped initial.state=straight",
    "actuator.kind=flange drive.voltage=1MV",
    "actuator.kind=hinge drive.voltage=1MV",
    "actuator.kind=hinge hinge.stiffness=1e4 hinge.rest_angle=160degree drive.voltage=1MV",
    "actuator.kind=hinge hinge.stiffness=1e-9 hinge.rest_angle=-160degree",
    "actuator.kind=hinge load.mass=0 gravity=0 initial.state=straight drive.voltage=0",
    "solver.integrator=explicit drive.voltage=1MV",
    "solver.integrator=explicit drive.voltage=1MV contact.model=sequential electro.breakdown_cap=false",
    "solver.integrator=explicit initial.state=straight contact.model=sequential",
    "solver.integrator=explicit damping.drag=1000000",
    "solver.integrator=explicit gravity=1000m/s2 load.mass=1000kg",
};

NIGHTLY_TESTS(study_ends_in_combinations, 0, LENGTH_OF(combinations)) {
  ZpActuatorDef def = def_of_settings(combinations[_i]);
  run_and_check(ZP_STUDY_ACTUATE, &def, combinations[_i]);
}

/* Combinations that have no meaning are refused, with a key in the message. */
static const struct {
  const char *settings, *named;
} contradictions[] = {
    {"platform.length=91mm", "platform.length"},
    {"ribbon.length=1mm", "platform.length"},
    {"insulator.thickness=0 electro.breakdown_cap=false", "insulator.thickness"},
    {"insulator.thickness=0", "short circuit"},
    {"actuator.kind=flange insulator.thickness=0", "short circuit"},
    {"actuator.kind=flange contact.model=sequential", "contact.model"},
    {"actuator.kind=flange electro.surface=bezier", "electro.surface"},
    {"electro.insulator_offset=0 electro.breakdown_cap=false", "electro.breakdown_cap"},
    {"contact.complete_margin=4", "contact.complete_margin"},
    {"electro.switch_offset=1um", "electro.switch_offset"},
    {"electro.refresh_period=1ms", "electro.refresh_period"},
    {"contact.model=sequential", "contact.model"},
    {"ribbon.model=mass_spring damping.internal=1us", "damping.internal"},
    {"electro.surface=bezier", "electro.surface"},
    {"electro.surface=bezier solver.integrator=explicit", "electro.surface"},
    {"damping.internal=1us solver.integrator=explicit", "damping.internal"},
    {"damping.internal=1us actuator.kind=ribbon solver.integrator=explicit", "damping.internal"},
    {"actuator.kind=flange solver.integrator=explicit", "solver.integrator"},
    {"actuator.kind=hinge solver.integrator=explicit", "solver.integrator"},
    {"actuator.kind=hinge ribbon.model=mass_spring", "ribbon.model"},
    {"hinge.stiffness=1", "hinge.stiffness"},
    {"actuator.kind=hinge hinge.rest_angle=1", "hinge.rest_angle"},
};

TESTS(contradictions_are_refused, 0, LENGTH_OF(contradictions)) {
  ZpActuatorDef def = def_of_settings(contradictions[_i].settings);
  ZpResult *result;
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_study_check(ZP_STUDY_ACTUATE, &def, &err) == ZP_BAD_INPUT, "%s was taken",
                contradictions[_i].settings);
  ck_assert_msg(strstr(err.message, contradictions[_i].named), "%s: \"%s\"", contradictions[_i].settings, err.message);
  ck_assert_int_eq(zp_study_run(ZP_STUDY_ACTUATE, &def, NULL, NULL, &result, &err), ZP_BAD_INPUT);
}

/* A straight actuator without voltage opens under its load: lying closed at the start is not having zipped. At
 * first it falls: g t^2 / 2 = 1.104 mm in 15 ms (measured the same to 4 digits; the ribbons are soft when flat). */
TEST(straight_without_voltage_opens) {
  ZpActuatorDef def = def_of_settings("initial.state=straight drive.voltage=0 solver.end_time=15ms liquid.model=none");
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_msg(result->outcome == ZP_REACHED_END, "%s: %s", zp_outcome_name(result->outcome), result->message);
  ck_assert_double_eq_tol(zp_result_get(result, "opening_m"), 9.81 * 15e-3 * 15e-3 / 2, 2.9e-6); /* 9.8e-7 measured */
  ck_assert(isnan(zp_result_get(result, "zip_time_s")));
}

/* -- presets ------------------------------------------------------------------------------------------------ */

static void run_preset(ZpPreset preset, int nodes, double voltage) {
  ZpAssignment list[] = {{zp_key_find("preset"), preset},         {zp_key_find("mesh.nodes"), nodes},
                         {zp_key_find("drive.voltage"), voltage}, {zp_key_find("solver.end_time"), 1e-4},
                         {zp_key_find("solver.tolerance"), 1e-1}, {zp_key_find("solver.max_steps"), 2500000}};
  ZpActuatorDef def = {0};
  ZpError err;
  char what[64];
  snprintf(what, sizeof what, "%s, N = %d, %g V", zp_key(zp_key_find("preset"))->choices[preset].word, nodes, voltage);
  ck_assert_msg(zp_def_resolve(&def, list, sizeof list / sizeof list[0], &err) == ZP_OK, "%s: %s", what, err.message);
  run_and_check(ZP_STUDY_ACTUATE, &def, what);
}

TEST(presets_end_at_every_size) {
  static const int sizes[] = {21, 61, 130};
  for (int preset = 1; preset < ZpPreset_COUNT; preset++)
    for (size_t k = 0; k < 3; k++) {
      if (sizes[k] < 100) run_preset((ZpPreset)preset, sizes[k], 0);
      run_preset((ZpPreset)preset, sizes[k], 10e3);
      if (sizes[k] < 100) run_preset((ZpPreset)preset, sizes[k], 1e6);
    }
}

/* A preset that has a value only for some N says so for another, and which key is wanted. */
TEST(presets_ask_for_what_they_lack) {
  for (int preset = 1; preset < ZpPreset_COUNT; preset++) {
    if (preset == ZP_PRESET_PAPER_FE) continue; /* has what it needs at any N */
    ZpAssignment list[] = {{zp_key_find("preset"), preset}, {zp_key_find("mesh.nodes"), 33}};
    ZpActuatorDef def = {0};
    ZpError err;
    ck_assert_int_eq(zp_def_resolve(&def, list, 2, &err), ZP_BAD_INPUT);
    ck_assert_msg(strstr(err.message, "damping.drag") || strstr(err.message, "mass_spring.shear_coefficient"), "%s",
                  err.message);
    ck_assert_msg(strstr(err.message, "33"), "%s", err.message);
  }
}
