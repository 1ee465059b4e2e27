/* The whole actuator, from clip to clip, against its half; what holds and joins its nodes; and ribbons that are not
 * alike, which run through the same code: against closed forms, by energy and by momentum. */
#include "state_util.h"

#include "def/check.h"
#include "rest/rest.h"

static const int meshes[] = {21, 61};

static ZpActuatorDef def_of(int symmetry, int nodes) {
  return DEF({"actuator.symmetry", symmetry}, {"mesh.nodes", nodes});
}

/* -- against the half ------------------------------------------------------------------------------- */

typedef struct Both {
  ZpResult *half, *whole;
} Both;

static Both run_both(ZpStudy study, ZpActuatorDef def) {
  Both both;
  def.actuator.symmetry = ZP_SYMMETRY_HALF;
  both.half = answer_of(study, &def);
  def.actuator.symmetry = ZP_SYMMETRY_NONE;
  both.whole = answer_of(study, &def);
  ck_assert_int_eq(both.half->outcome, both.whole->outcome);
  ck_assert_str_eq(both.half->message, both.whole->message);
  return both;
}

/* Half and whole give the same number, or both none. */
static void check_scalar(Both both, const char *name, double scale) {
  double half = zp_result_get(both.half, name), whole = zp_result_get(both.whole, name);
  if (isnan(half) && isnan(whole)) return;
  note_check(__func__, name, "half", fabs(whole - half) / scale, 5e-11); /* 5.9e-12 measured */
  ck_assert_msg(fabs(whole - half) <= 5e-11 * scale, "%s: half %.15g, whole %.15g", name, half, whole);
}

static void check_scalars(Both both, const char *const *name, size_t count) {
  for (size_t k = 0; k < count; k++) {
    ck_assert_msg(isfinite(zp_result_get(both.half, name[k])), "%s", name[k]);
    check_scalar(both, name[k], fabs(zp_result_get(both.half, name[k])));
  }
}
#define CHECK_SCALARS(both, ...)                                                                                       \
  check_scalars(both, (const char *const[]){__VA_ARGS__}, LENGTH_OF(((const char *const[]){__VA_ARGS__})))

TESTS(limits_are_those_of_the_half, 0, FULL_OR(LENGTH_OF(meshes), 1)) {
  Both both = run_both(ZP_STUDY_LIMITS, def_of(ZP_SYMMETRY_HALF, meshes[_i]));
  CHECK_SCALARS(both, "pull_in_voltage_V", "closing_voltage_V", "release_voltage_V", "max_load_kg");
}

TESTS(branches_are_those_of_the_half, 0, FULL_OR(LENGTH_OF(meshes), 1)) {
  Both both = run_both(ZP_STUDY_EQUILIBRIUM, def_of(ZP_SYMMETRY_HALF, meshes[_i]));
  CHECK_SCALARS(both, "pull_in_voltage_V", "closing_voltage_V", "release_voltage_V", "points", "max_stress_Pa",
                "insulator_field_V_per_m");
}

/* On the coarse mesh it jumps on its way, where both halves lose their stability at once. */
TESTS(held_forces_are_those_of_the_half, 0, FULL_OR(LENGTH_OF(meshes), 1)) {
  Both both = run_both(ZP_STUDY_ISOMETRIC, def_of(ZP_SYMMETRY_HALF, meshes[_i]));
  CHECK_SCALARS(both, "force_N", "force_unpowered_N", "charge_C", "capacitance_F", "opening_m");
  check_scalar(both, "jumps", 1);
}

/* Both halves of a ribbon have the tension of the half, in mirrored order. The rigid platform between them is no
 * ribbon. */
static void check_tensions(Both both) {
  const ZpTable *half = both.half->series, *whole = both.whole->series;
  const size_t edges = half->rows - 1, last = whole->rows - 1;
  double most = 0, off = 0;
  ck_assert_uint_eq(last, 2 * edges + 1);
  for (size_t i = 0; i < edges; i++) {
    double tension = zp_table_get(half, i, "tension_N");
    most = fmax(most, fabs(tension));
    off = fmax(off, fabs(zp_table_get(whole, i, "tension_N") - tension));
    off = fmax(off, fabs(zp_table_get(whole, last - 1 - i, "tension_N") - tension));
  }
  ck_below(off / most, 1e-6); /* 3.4e-7 measured */
  ck_assert(isnan(zp_table_get(whole, edges, "tension_N")) && isnan(zp_table_get(whole, last, "tension_N")));
}

TESTS(rest_is_that_of_the_half, 0, LENGTH_OF(meshes)) {
  Both both = run_both(ZP_STUDY_STATIONARY, def_of(ZP_SYMMETRY_HALF, meshes[_i]));
  CHECK_SCALARS(both, "stroke_m", "opening_m");
  check_tensions(both);
}

/* Symmetric modes of the whole are those of the half; the others leave the platform at rest. */
TESTS(modes_of_the_half_are_modes_of_the_whole, 0, FULL_OR(LENGTH_OF(meshes), 1)) {
  enum { SYMMETRIC = 4, MODES = 8 };
  static const double of_eigenvalues = 3e-8; /* to which study modes iterates: 3.1e-9 measured */
  Both both = run_both(ZP_STUDY_MODES, def_of(ZP_SYMMETRY_HALF, meshes[_i]));
  for (size_t k = 0; k < SYMMETRIC; k++) {
    double half = zp_table_get(both.half->series, k, "frequency_Hz"), nearest = INFINITY;
    for (size_t j = 0; j < MODES; j++)
      nearest = fmin(nearest, fabs(zp_table_get(both.whole->series, j, "frequency_Hz") / half - 1));
    ck_below(nearest, of_eigenvalues);
  }
}

/* The others are the modes of a half with a fixed platform, as under a very heavy load. */
TEST(modes_that_hold_the_platform) {
  enum { HELD = 3, MODES = 8 };
  ZpActuatorDef def = DEF({"mesh.nodes", 21}, {"gravity", 0}, {"load.mass", 1000});
  ZpResult *heavy = answer_of(ZP_STUDY_MODES, &def);
  def.load.mass = 8e-3;
  def.actuator.symmetry = ZP_SYMMETRY_NONE;
  ZpResult *whole = answer_of(ZP_STUDY_MODES, &def);
  for (size_t k = 1; k <= HELD; k++) { /* the first one moves the load */
    double held = zp_table_get(heavy->series, k, "frequency_Hz"), nearest = INFINITY;
    for (size_t j = 0; j < MODES; j++)
      nearest = fmin(nearest, fabs(zp_table_get(whole->series, j, "frequency_Hz") / held - 1));
    ck_below(nearest, 3e-7); /* 7.7e-8 measured */
  }
}

/* A signal until closing, or during the whole run, within a fraction of a scale. */
static void check_signal(Both both, const char *column, double scale, bool always, double allowed) {
  double closed = zp_result_get(both.half, "zip_time_s"), most = 0;
  for (size_t row = 0; row < both.half->series->rows; row++) {
    if (!always && zp_table_get(both.half->series, row, "time_s") >= closed) break;
    double apart = zp_table_get(both.half->series, row, column) - zp_table_get(both.whole->series, row, column);
    most = fmax(most, fabs(apart));
  }
  note_check(__func__, column, "half", most / scale, allowed);
  ck_assert_msg(most <= allowed * scale, "%s: off by %.2e of %g", column, most / scale, scale);
}

/* Rounding grows from bounce to bounce, and a velocity turns round in each, so after closing only positions are
 * compared, and not as closely. */
static void check_motion(ZpActuatorDef def) {
  def.solver.stop_when_zipped = ZP_WHEN_TRUE;
  def.solver.tolerance = 1e-3; /* rounding grows with the number of steps */
  static const char *const by_largest[] = {"time_s",         "voltage_V",     "stroke_m",
                                           "opening_m",      "contraction",   "force_N",
                                           "charge_C",       "capacitance_F", "end_velocity_m_per_s",
                                           "zipped_length_m"};
  static const char *const energy[] = {
      "electric_work_J", "load_work_J", "kinetic_energy_J", "axial_energy_J", "bending_energy_J", "gravity_energy_J",
      "field_energy_J",  "drag_loss_J", "internal_loss_J",  "contact_loss_J", "charging_loss_J",  "energy_imbalance_J"};
  Both both = run_both(ZP_STUDY_ACTUATE, def);
  ck_assert_uint_eq(both.half->series->rows, both.whole->series->rows);
  CHECK_SCALARS(both, "zip_time_s", "steps", "newton_iterations", "max_stress_Pa");
  for (size_t k = 0; k < LENGTH_OF(by_largest); k++)
    check_signal(both, by_largest[k], largest_in(both.half->series, by_largest[k]), false, 3e-7); /* 3.4e-8 measured */
  for (size_t k = 0; k < LENGTH_OF(energy); k++)
    check_signal(both, energy[k], largest_in(both.half->series, "electric_work_J"), false, 3e-7); /* 3.4e-8 measured */
  check_signal(both, "opening_m", largest_in(both.half->series, "opening_m"), true, 2e-7);        /* 9e-9 measured */
  check_signal(both, "stroke_m", largest_in(both.half->series, "stroke_m"), true, 2e-7);          /* 9e-9 measured */
}

TEST(motion_is_that_of_the_half) {
  ZpActuatorDef def = def_of(ZP_SYMMETRY_HALF, 21);
  check_motion(def);
}

/* Segments and keys of the lower ribbon and its insulator, all of them different, are mirrored with the halves. */
#define UNLIKE_HALVES                                                                                                  \
  {"segment_1.length", 7e-3}, {"segment_1.curvature", 2}, {"segment_1.thickness", 70e-6}, {"segment_2.length", 9e-3},  \
      {"segment_2.curvature", -1}, {"lower.ribbon.thickness", 60e-6}, {"lower.ribbon.density", 7000},                  \
      {"lower.segment_1.length", 4e-3}, {"lower.segment_1.curvature", -3}, {"lower.segment_2.length", 6e-3},           \
      {"lower.segment_2.curvature", 4}, {"lower.segment_2.thickness", 80e-6}, {"lower.insulator.thickness", 100e-6}, { \
    "lower.insulator.permittivity", 3                                                                                  \
  }

TEST(unlike_segments_of_both_halves) {
  Both both = run_both(ZP_STUDY_STATIONARY, DEF(UNLIKE_HALVES, {"mesh.nodes", 11}));
  CHECK_SCALARS(both, "stroke_m", "opening_m", "max_stress_Pa", "yield_margin");
  both = run_both(ZP_STUDY_ISOMETRIC, DEF(UNLIKE_HALVES, {"mesh.nodes", 11}, {"drive.voltage", 6e3}));
  CHECK_SCALARS(both, "force_N", "force_unpowered_N", "charge_C", "capacitance_F", "zipped_length_m", "max_stress_Pa");
  both = run_both(ZP_STUDY_LIMITS, DEF(UNLIKE_HALVES, {"mesh.nodes", 11}));
  CHECK_SCALARS(both, "pull_in_voltage_V", "mass_kg", "insulator_field_V_per_m");
}

/* Segments are mirrored, too, a platform may be short or bare, and the load need not be shared evenly. */
TESTS(motion_of_others_is_that_of_the_half, 0, FULL_OR(4, 1)) {
  ZpActuatorDef def[] = {
      DEF({"mesh.nodes", 15}, {"platform.length", 0}, {"load.share", 0.3}),
      DEF({"mesh.nodes", 15}, {"platform.electrode", 0}, {"electro.edges", 1}, {"drive.voltage", 8e3}),
      DEF({"mesh.nodes", 15}, {"segment_1.length", 7e-3}, {"segment_1.curvature", 2}, {"segment_1.thickness", 100e-6},
          {"drive.waveform", ZP_WAVEFORM_SINE}, {"solver.end_time", 0.1}),
      DEF(UNLIKE_HALVES, {"mesh.nodes", 15}, {"solver.end_time", 0.1}),
  };
  check_motion(def[_i]);
}

/* -- in a stack -------------------------------------------------------------------------------------- */

static const Setting stack[][3] = {
    {{"stack.series", 2}, {"stack.link_mass", 1e-3}, {"member_2.ribbon.thickness", 60e-6}},
    {{"stack.parallel", 2}, {"member_1.insulator.thickness", 150e-6}, {"load.share", 0.3}},
    {{"stack.series", 2}, {"stack.distance", 30e-3}, {"stack.voltage_ratio", 0.5}},
    {{"stack.series", 2}, {"stack.distance", 30e-3}, {"stack.lower_voltage", 1e3}},
};

static ZpActuatorDef stack_of(int k, int nodes) {
  return DEF({"mesh.nodes", nodes}, {"drive.voltage", 6e3}, stack[k][0], stack[k][1], stack[k][2]);
}

/* Whole actuators in series, side by side and as antagonists rest as their halves do. */
TESTS(whole_members_rest_as_halves, 0, LENGTH_OF(stack)) {
  ZpActuatorDef def = stack_of(_i, 15);
  Both both = run_both(ZP_STUDY_STATIONARY, def);
  CHECK_SCALARS(both, "stroke_m", "opening_m", "max_stress_Pa");
  both = run_both(ZP_STUDY_LIMITS, def);
  CHECK_SCALARS(both, "mass_kg");
  check_scalar(both, "pull_in_voltage_V", 1e3);
  check_scalar(both, "release_voltage_V", 1e3);
  check_scalar(both, "closing_voltage_V", 1e3);
  both = run_both(ZP_STUDY_EQUILIBRIUM, def);
  CHECK_SCALARS(both, "points");
  both = run_both(ZP_STUDY_ISOMETRIC, def);
  CHECK_SCALARS(both, "force_N", "charge_C", "capacitance_F");
}

/* They take the same steps until rounding has grown, from bounce to bounce. */
TESTS(whole_members_move_as_halves, 0, LENGTH_OF(stack)) {
  ZpActuatorDef def = stack_of(_i, 9);
  def.drive.voltage = 8e3;
  def.solver.end_time = 25e-3;
  def.solver.tolerance = 1e-3;
  Both both = run_both(ZP_STUDY_ACTUATE, def);
  CHECK_SCALARS(both, "steps");
  check_signal(both, "opening_m", largest_in(both.half->series, "opening_m"), true, 1.3e-7);
  check_signal(both, "charge_C", largest_in(both.half->series, "charge_C"), true, 1.3e-7); /* 4.3e-8 measured */
}

/* Halves that differ, in the weight of a tilted stack: energy balances while it moves. The order in which members side
 * by side are named, and the side to which the stack leans, make no difference to it. */
TESTS(tilted_members_move_together, 0, LENGTH_OF(stack)) {
  ZpResult *result[2];
  for (int k = 0; k < 2; k++) {
    ZpActuatorDef def = stack_of(_i, 9);
    def.actuator.symmetry = ZP_SYMMETRY_NONE;
    def.mount.tilt = k ? -0.3 : 0.3;
    def.solver.end_time = 30e-3;
    if (_i == 1 && k) {
      set_member(&def, "member_2.insulator.thickness", zp_def_number(&def, "member_1.insulator.thickness"));
      set_member(&def, "member_1.insulator.thickness", NAN);
    }
    result[k] = answer_of(ZP_STUDY_ACTUATE, &def);
    ck_below(zp_result_get(result[k], "energy_error"), 9.6e-9); /* 3.2e-9 measured */
  }
  ck_near(zp_result_get(result[0], "opening_m"), zp_result_get(result[1], "opening_m"), 7.1e-11); /* 2.4e-11 measured */
}

/* Antagonists are mirrored where gravity is: one at the tilt pi - a opens as the other one at a. */
TEST(tilted_antagonists_change_places) {
  double opening[2];
  for (int k = 0; k < 2; k++) {
    ZpActuatorDef def = DEF({"mesh.nodes", 15}, {"actuator.symmetry", ZP_SYMMETRY_NONE}, {"stack.series", 2},
                            {"stack.distance", 30e-3}, {"mount.tilt", k ? acos(-1) - 0.5 : 0.5});
    opening[k] = answered_value(ZP_STUDY_STATIONARY, &def, "opening_m");
  }
  ck_assert_double_gt(opening[0], opening[1] + 1e-3);
  ck_near(opening[0] + opening[1], 30e-3, 1e-12); /* 2.2e-16 measured */
}

/* -- the platform and the clips ---------------------------------------------------------------------- */

static double energy_of(ZpSim *sim) {
  return zp_sim_get(sim, "kinetic_energy") + zp_sim_get(sim, "bending_energy") + zp_sim_get(sim, "axial_energy") +
         zp_sim_get(sim, "gravity_energy");
}

/* One half is pushed, the other is not: the platform stays horizontal and in its guide, each clip moves as one body,
 * and the energy is constant. */
TEST(platform_stays_horizontal) {
  ZpActuatorDef def =
      DEF({"actuator.symmetry", ZP_SYMMETRY_NONE}, {"mesh.nodes", 21}, {"damping.internal", 0}, {"drive.voltage", 0});
  ZpModel *model = model_of(&def);
  ZpSim *sim = sim_of(model);
  const ZpTopology *t = &model->topology;
  double *v = zp_state_v(model, sim->state), *x = zp_state_q(model, sim->state), *y = x + model->stride;
  for (size_t j = 0; j < zp_upper(t, t->platform.first); j++)
    v[model->stride + j] = 0.05 * cos(0.3 * (double)(j / 2));
  double before = energy_of(sim), bending = zp_sim_get(sim, "bending_energy");
  ZpRunInfo info;
  ck_assert_int_eq(zp_sim_run(sim, 0.02, false, NULL, &info), ZP_REACHED_END);
  size_t left = t->platform.first, right = t->platform.last, clip = t->stations - 1;
  ck_assert(y[zp_lower(t, left)] == y[zp_lower(t, right)]);
  ck_assert(y[zp_upper(t, left)] == 0 && y[zp_upper(t, right)] == 0);
  ck_near(x[zp_lower(t, right)] - x[zp_lower(t, left)], def.platform.length, 1e-12);
  ck_assert(x[zp_upper(t, clip)] == x[zp_lower(t, clip)] && y[zp_upper(t, clip)] == y[zp_lower(t, clip)]);
  ck_assert_double_gt(fabs(y[zp_upper(t, clip)] - y[zp_upper(t, 0)]), 1e-8); /* the halves do not move alike */
  ck_below(fabs(energy_of(sim) - before) / bending, 2e-8);                   /* 2.2e-9 measured */
}

/* What a joint holds has no equation, and what it makes one has one. */
TEST(equations_are_those_of_the_topology) {
  ZpActuatorDef def = def_of(ZP_SYMMETRY_NONE, 4);
  ZpModel *model = model_of(&def);
  ZpAssembly a;
  const ZpTies ties = zp_ties_of(model, 1, 0);
  ck_assert(zp_assembly_create(&ties, 0, true, &a));
  const ZpTopology *t = &model->topology;
  ck_assert_uint_eq(t->stations, 8);
  ck_assert_uint_eq(a.n, 8 * 4 - 2 * 2 - 2 * 2 - 2 - 1); /* clips, x of platforms, y of the upper, and of the lower */
  for (size_t i = t->platform.first; i <= t->platform.last; i++)
    ck_assert(a.equation[2 * zp_upper(t, i)] < 0 && a.equation[2 * zp_lower(t, i)] < 0 &&
              a.equation[2 * zp_upper(t, i) + 1] < 0);
  int common = a.equation[2 * zp_lower(t, t->platform.first) + 1];
  ck_assert_int_eq(a.equation[2 * zp_lower(t, t->platform.last) + 1], common);
  ck_assert(a.parts.more == 1 && a.parts.count == 1 && a.parts.common[0] == (size_t)common);
  ck_assert_int_eq(a.equation[2 * zp_upper(t, 7)], a.equation[2 * zp_lower(t, 7)]);
  ck_assert_int_eq(a.equation[2 * zp_lower(t, 7) + 1], (int)a.n - 1);
  zp_assembly_destroy(&a);
}

/* (19.7): where mirror rows place the whole by any unknowns of a half, the table of the whole holds. */
TEST(half_is_the_whole_with_mirror_rows) {
  enum { N = 4 };
  ZpActuatorDef defs[2] = {def_of(ZP_SYMMETRY_HALF, N), def_of(ZP_SYMMETRY_NONE, N)};
  ZpModel *half = model_of(&defs[0]), *whole = model_of(&defs[1]);
  const ZpTies ties = zp_ties_of(half, 1, 0), of_whole = zp_ties_of(whole, 1, 0);
  ZpAssembly a, b;
  ck_assert(zp_assembly_create(&ties, 0, true, &a) && zp_assembly_create(&of_whole, 0, true, &b));
  double unknowns[4 * N], q[4 * 4 * N + 64] = {0}, mirrored[2 * 4 * 4 * N + 64] = {0},
                                        X = zp_straight_x(whole, 2 * N - 1);
  for (size_t i = 0; i < a.n; i++)
    unknowns[i] = 1e-3 * sin((double)i);
  for (const ZpTie *tie = ties.tie; tie < ties.tie + ties.count; tie++)
    *zp_coordinate(half, q, tie->coordinate) = tie->offset; /* what is held */
  zp_assembly_place(&a, unknowns, q);
  for (size_t j = 0; j < 2 * N; j++)
    for (size_t c = 0; c < 2; c++) {
      const size_t other = 4 * N - 2 + j % 2 - (j - j % 2); /* of the same ribbon */
      double here = *zp_coordinate(half, q, 2 * j + c);
      *zp_coordinate(whole, mirrored, 2 * j + c) = here;
      *zp_coordinate(whole, mirrored, 2 * other + c) = c == 0 ? X - here : here;
    }
  for (const ZpTie *tie = of_whole.tie; tie < of_whole.tie + of_whole.count; tie++)
    ck_assert_double_eq_tol(*zp_coordinate(whole, mirrored, tie->coordinate),
                            tie->factor * *zp_coordinate(whole, mirrored, tie->to) + tie->offset, 1e-16);
  ck_assert_uint_eq(b.n, 2 * a.n - 1); /* both halves have the height of the platform in common */
  ck_assert_uint_eq(a.parts.more, 0);
  zp_assembly_destroy(&a);
  zp_assembly_destroy(&b);
}

/* What only the half has is refused by name. */
TEST(what_knows_the_half_only_is_refused) {
  static const struct {
    Setting setting;
    const char *key;
  } refused[] = {{{"actuator.kind", ZP_KIND_RIBBON}, "actuator.kind"},
                 {{"actuator.kind", ZP_KIND_FLANGE}, "actuator.kind"},
                 {{"ribbon.model", ZP_RIBBON_MASS_SPRING}, "ribbon.model"},
                 {{"electro.model", ZP_ELECTRO_FIELD}, "electro.model"},
                 {{"electro.surface", ZP_SURFACE_BEZIER}, "electro.surface"},
                 {{"contact.model", ZP_CONTACT_SEQUENTIAL}, "contact.model"},
                 {{"preset", ZP_PRESET_PAPER_TEXT}, "ribbon.model"},
                 {{"preset", ZP_PRESET_PAPER_CODE}, "ribbon.model"},
                 {{"preset", ZP_PRESET_PAPER_FE}, "actuator.kind"}};
  for (size_t k = 0; k < LENGTH_OF(refused); k++) {
    ZpActuatorDef def = DEF({"actuator.symmetry", ZP_SYMMETRY_NONE}, {"mesh.nodes", 21}, refused[k].setting);
    ZpError err = {ZP_OK, ""};
    ck_assert_int_eq(zp_def_check(&def, &err), ZP_BAD_INPUT);
    ck_assert_msg(strstr(err.message, "actuator.symmetry = none: requires") && strstr(err.message, refused[k].key) &&
                      strstr(err.message, "use actuator.symmetry half"),
                  "%s", err.message);
  }
  ZpActuatorDef def = def_of(ZP_SYMMETRY_NONE, 21);
  ck_refused_by(ZP_STUDY_PROFILE, &def, "actuator.symmetry = none");
  def.solver.integrator = ZP_INTEGRATOR_EXPLICIT; /* which only motion has */
  ck_assert_int_eq(zp_def_check(&def, NULL), ZP_OK);
  ck_refused_by(ZP_STUDY_ACTUATE, &def, "actuator.symmetry = none");
}

/* -- ribbons that are not alike ----------------------------------------------------------------------- */

/* The lower ribbon is thicker, softer and heavier. */
static ZpModel *unlike(ZpActuatorDef *def) {
  def->lower.ribbon.thickness = 1.4 * def->ribbon.thickness;
  def->lower.ribbon.young_modulus = 150e9;
  def->lower.ribbon.density = 9000;
  return model_of(def);
}

typedef struct Strip {
  double EI, q; /* N m^2; weight per length, N/m */
} Strip;

static Strip strip_of(const ZpActuatorDef *def) {
  double b = def->ribbon.thickness, nu = def->ribbon.poisson_ratio;
  return (Strip){def->ribbon.young_modulus * def->ribbon.width * b * b * b / 12 / (1 - nu * nu),
                 def->ribbon.density * b * def->ribbon.width * def->gravity};
}

/* Ribbons that sink by different amounts would be shortened by different amounts, if they were not joined: each pulls
 * the other. That counts for nothing where they sink by far less than they are thick, as thick ones do. */
#define THICK                                                                                                          \
  {"ribbon.thickness", 500e-6}, {"mesh.nodes", 161}, {"load.share", 0.5}, {                                            \
    "drive.voltage", 0                                                                                                 \
  }

/* Small deflections of two guided beams in series: each sinks by F L^3 / (12 EI) under its load and by q L^4 / (24 EI)
 * under its own weight; the upper one also carries the lower one. */
TESTS(unlike_ribbons_bend_in_series, 0, 2) {
  ZpActuatorDef def = DEF(THICK, {"load.mass", 10e-3}, {"gravity", 1});
  def.actuator.symmetry = _i ? ZP_SYMMETRY_NONE : ZP_SYMMETRY_HALF;
  ZpModel *model = unlike(&def);
  ZpRest *rest;
  ZpError err;
  ck_assert_int_eq(zp_rest_create(model, &rest, &err), ZP_OK);
  ck_assert(zp_rest_hang(rest, 0));
  ZpActuatorDef room, lower = *zp_def_lower(&def, &room);
  Strip top = strip_of(&def), bottom = strip_of(&lower);
  double L = model->L, F = 0.5 * def.load.mass * def.gravity, on_top = F + bottom.q * L;
  double sinks = F * L * L * L / 12 / bottom.EI + bottom.q * L * L * L * L / 24 / bottom.EI;
  double clip = on_top * L * L * L / 12 / top.EI + top.q * L * L * L * L / 24 / top.EI;
  ck_near(zp_rest_stroke(rest), sinks, 2e-5);         /* 3.8e-6 measured */
  ck_near(zp_rest_opening(rest), sinks + clip, 2e-5); /* 4.9e-6 measured */
  zp_rest_destroy(rest);
}

/* Under a heavy load it swings as a mass on two springs in series, 12 EI / L^3 each: after a quarter of a period it has
 * stopped, as far from rest as its energy reaches. */
TEST(unlike_ribbons_swing_in_series) {
  ZpActuatorDef def = DEF(THICK, {"load.mass", 10}, {"gravity", 0}, {"solver.tolerance", 3.5e-6});
  ZpModel *model = unlike(&def);
  ZpSim *sim = sim_of(model);
  ZpActuatorDef room, lower = *zp_def_lower(&def, &room);
  Strip top = strip_of(&def), bottom = strip_of(&lower);
  double L = model->L, M = 0.5 * def.load.mass, k = 12 / (L * L * L * (1 / top.EI + 1 / bottom.EI)), speed = 1e-4;
  double *v = zp_state_v(model, sim->state), quarter = 0.5 * 3.14159265358979323846 / sqrt(k / M);
  /* the shape in which it sinks: each beam turns by 3 s^2 - 2 s^3 */
  double part = bottom.EI / (top.EI + bottom.EI); /* of the opening, at the clip */
  for (size_t i = 0; i < model->nodes; i++) {
    double s = (double)i / (double)(model->nodes - 1), turn = s * s * (3 - 2 * s);
    v[model->stride + 2 * i] = -speed * part * (1 - turn);
    v[model->stride + 2 * i + 1] = -speed * (part + (1 - part) * turn);
  }
  ZpRunInfo info;
  ck_assert_int_eq(zp_sim_run(sim, quarter, false, NULL, &info), ZP_REACHED_END);
  ck_near(zp_sim_get(sim, "opening"), speed * sqrt(M / k), 5e-4); /* 1.2e-4 measured */
  ck_below(fabs(zp_sim_get(sim, "end_velocity")) / speed, 2e-3);  /* 3.5e-4 measured */
}

/* Bent at random about a shape with open faces, what is held left where it is. */
static void bend(const ZpModel *model, uint64_t *seed, double *q) {
  const ZpTies ties = zp_ties_of(model, 1, 0);
  for (size_t k = 0; k < 2 * model->count; k++) {
    const ZpTie *tie = zp_tie_of(&ties, k);
    size_t j = k / 2, i = j / model->s;
    double *value = &q[j + k % 2 * model->stride];
    double straight = k % 2 ? -1e-4 * (double)(j % 2) : zp_straight_x(model, i);
    *value = straight + 0.02 * model->l * noise(seed) * (k % 2 ? 0.1 : 1);
    if (tie) *value = tie->factor * q[tie->to / 2 + tie->to % 2 * model->stride] + tie->offset;
  }
}

/* Over any span the forces of rod, attraction and contact do the work of their energy changes, with a resultant of
 * zero. */
TESTS(unlike_ribbons_keep_energy_and_momentum, 0, 2) {
  ZpActuatorDef def = DEF({"actuator.symmetry", _i ? ZP_SYMMETRY_NONE : ZP_SYMMETRY_HALF}, {"mesh.nodes", 9},
                          {"gravity", 0}, {"load.mass", 0}, {"damping.internal", 0});
  ZpModel *model = unlike(&def);
  ZpEval e;
  ck_assert(zp_system_create(model, false, &e));
  size_t stride = model->stride, bytes = 2 * stride * sizeof(double);
  double *q0 = memory_of(bytes), *q1 = memory_of(bytes), *F = memory_of(bytes), work = 0, size = 0;
  uint64_t seed = 3;
  bend(model, &seed, q0);
  bend(model, &seed, q1);
  ZpSpan span = {.start = q0, .end = q1, .h = 1e-4, .U0 = 5e3, .U1 = 5e3, .share = 1};
  zp_system_begin(model, &span, &e);
  zp_system_force(model, &span, &e, F);
  double before = zp_rod_stretching_energy(&model->rod, &e.rod_start) +
                  zp_rod_bending_energy(&model->rod, &e.rod_start) +
                  zp_plates_totals(&model->plates, &e.plates_start, 5e3).potential;
  double after = zp_rod_stretching_energy(&model->rod, &e.rod) + zp_rod_bending_energy(&model->rod, &e.rod) +
                 zp_plates_totals(&model->plates, &e.plates, 5e3).potential;
  double sum[2] = {0, 0}, most = 0;
  for (size_t j = 0; j < model->count; j++)
    for (size_t c = 0; c < 2; c++) {
      size_t k = j + c * stride;
      work += F[k] * (q1[k] - q0[k]);
      size += fabs(F[k] * (q1[k] - q0[k]));
      sum[c] += F[k];
      most = fmax(most, fabs(F[k]));
    }
  ck_below(fabs(work + after - before) / size, 1e-12); /* 1.5e-14 measured */
  ck_below(fabs(sum[0]) / most, 1e-12);                /* 1.6e-16 measured */
  ck_below(fabs(sum[1]) / most, 1e-12);                /* 7.6e-19 measured */
  zp_eval_destroy(&e);
}

/* A zip of the whole actuator with unequal ribbons conserves energy, and the whole zips like its half. */
TEST(unlike_ribbons_zip) {
  double zip_time[2], opening[2];
  for (int whole = 0; whole < 2; whole++) {
    ZpActuatorDef def = def_of(whole ? ZP_SYMMETRY_NONE : ZP_SYMMETRY_HALF, 21);
    ZpModel *model = unlike(&def);
    ZpSim *sim = sim_of(model);
    ZpRunInfo info;
    opening[whole] = zp_sim_get(sim, "opening");
    ck_assert_msg(zp_sim_run(sim, 1, true, NULL, &info) == ZP_ZIPPED, "%s", info.message);
    zip_time[whole] = zp_sim_zip_time(sim);
    ck_below(fabs(zp_sim_get(sim, "energy_imbalance")) / zp_sim_get(sim, "electric_work"), 5e-8); /* 6e-9 measured */
  }
  ck_near(opening[1], opening[0], 1e-12);   /* 2.2e-16 measured */
  ck_near(zip_time[1], zip_time[0], 2e-12); /* 2.3e-13 measured */
}
