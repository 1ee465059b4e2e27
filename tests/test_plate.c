/* A rigid plate on a spring: textbook limits, small oscillation, films of finite plates, and its books. Theory, section
 * 37. Measured values stand beside the bounds. */
#include "network_util.h"

#include "math/elementary.h"
#include "run/run.h"

static const double eps0 = ZP_EPS0;

#define PLATE                                                                                                          \
  {"actuator.kind", ZP_KIND_PLATE}, {                                                                                  \
    "medium.permittivity", 1                                                                                           \
  }
#define GIVEN                                                                                                          \
  PLATE, {"ribbon.length", 300e-6}, {"ribbon.width", 40e-6}, {"plate.gap", 5e-6}, {"plate.stop_gap", 1e-6}, {          \
    "plate.stiffness", 8                                                                                               \
  }

/* -- at rest --------------------------------------------------------------------------------------- */

/* Area of all electrodes, m^2, and the thickness that stands for both insulators, m. */
static double area_of(const ZpActuatorDef *def) {
  return def->ribbon.length * def->ribbon.width * def->plate.count;
}

static double offset_of(const ZpActuatorDef *def) {
  return 2 * def->insulator.thickness * def->medium.permittivity / def->insulator.permittivity;
}

/* Eqs. (37.2), (37.4): bare, insulated, of several fingers in water. */
TESTS(pull_in_and_release_of_the_textbook, 0, 3) {
  ZpActuatorDef def = DEF(GIVEN, {"drive.voltage", 80});
  if (_i == 1) def.insulator.thickness = 0.5e-6;
  if (_i == 2) def.plate.count = 7, def.medium.permittivity = 80, def.drive.voltage = 10;
  const double d = offset_of(&def), A = area_of(&def) * eps0 * def.medium.permittivity, k = def.plate.stiffness,
               g0 = def.plate.gap, gs = def.plate.stop_gap;
  ZpResult *result = study_of(ZP_STUDY_LIMITS, &def);
  const double pull_in = sqrt(8 * k * (g0 + d) * (g0 + d) * (g0 + d) / (27 * A));
  ck_near(zp_result_get(result, "pull_in_voltage_V"), pull_in, 1e-10); /* 3.8e-11 measured */
  ck_near(zp_result_get(result, "release_voltage_V"), sqrt(2 * k * (g0 - gs) / A) * (gs + d),
          4e-5); /* 1.6e-5 measured */
  result = study_of(ZP_STUDY_EQUILIBRIUM, &def);
  ck_near(zp_result_get(result, "pull_in_voltage_V"), pull_in, 1e-14); /* 2e-16 measured */
}

/* Eq. (37.3): the balance of the spring with both electrodes, as a voltage squared. */
static double square_at(const ZpActuatorDef *def, double g) {
  const double d = offset_of(def), front = g + d, back = def->plate.gap + def->plate.back_gap - g + d;
  return 2 * def->plate.stiffness * (def->plate.gap - g) /
         (eps0 * def->medium.permittivity * area_of(def) * (1 / (front * front) - 1 / (back * back)));
}

/* Its largest value from the gap at rest down. */
static double largest_square(const ZpActuatorDef *def) {
  static const double golden = 0.6180339887498949;
  double low = def->plate.stop_gap, high = def->plate.gap * (1 - 1e-9);
  for (int k = 0; k < 100; k++) {
    double one = high - golden * (high - low), other = low + golden * (high - low);
    if (square_at(def, one) > square_at(def, other))
      high = other;
    else
      low = one;
  }
  return square_at(def, low);
}

TESTS(pull_in_before_a_back_electrode, 0, 2) {
  ZpActuatorDef def =
      DEF(GIVEN, {"drive.voltage", 80}, {"plate.back_gap", 7.75e-6}, {"plate.back_stop_gap", 1e-6}, {"plate.count", 3});
  if (_i == 1) def.insulator.thickness = 0.5e-6;
  ZpResult *result = study_of(ZP_STUDY_LIMITS, &def);
  ck_near(zp_result_get(result, "pull_in_voltage_V"), sqrt(largest_square(&def)), 1e-14); /* 2e-16 measured */
  ck_near(zp_result_get(result, "release_voltage_V"), sqrt(square_at(&def, def.plate.stop_gap)),
          4e-5); /* 1.6e-5 measured */
}

/* Both electrodes are in parallel. */
TEST(capacitance_between_electrodes) {
  ZpActuatorDef def =
      DEF(GIVEN, {"plate.back_gap", 7e-6}, {"insulator.thickness", 0.5e-6}, {"plate.count", 3}, {"drive.voltage", 0});
  const double d = offset_of(&def), A = eps0 * area_of(&def);
  ck_near(settled_value(&def, "capacitance"), A / (def.plate.gap + d) + A / (def.plate.back_gap + d), 1e-12);
}

/* The plate that a load draws away from the front rests on the stop behind it. */
TEST(back_stop_holds) {
  ZpActuatorDef def =
      DEF(GIVEN, {"drive.voltage", 0}, {"plate.back_gap", 7e-6}, {"plate.back_stop_gap", 2e-6}, {"load.force", 1e-3});
  const double k = def.plate.stiffness, s = def.plate.stop_stiffness, stop = 10e-6;
  ck_near(answered_value(ZP_STUDY_STATIONARY, &def, "opening_m"),
          (def.load.force + k * def.plate.gap + s * stop) / (k + s), 1e-14); /* 2e-16 measured */
}

/* There it moves by its keys as this says: one of two plates side by side, each with its own springs. */
TESTS(place_on_the_back_stop_by_keys, 0, 5) {
  static const char *const by[] = {"plate.gap", "plate.back_gap", "plate.back_stop_gap", "plate.stiffness",
                                   "plate.stop_stiffness"};
  static const double near[] = {5e-12, 5e-12, 5e-12, 2.2e-7, 2.2e-9}; /* a third of it measured */
  ZpActuatorDef def = DEF(GIVEN, {"drive.voltage", 0}, {"plate.back_gap", 7e-6}, {"plate.back_stop_gap", 2e-6},
                          {"load.force", 2e-3}, {"stack.parallel", 2});
  const double k = def.plate.stiffness, s = def.plate.stop_stiffness, g0 = def.plate.gap, stop = 10e-6,
               opening = (def.load.force / 2 + k * g0 + s * stop) / (k + s);
  const double slopes[] = {1, s / (k + s), -s / (k + s), (g0 - opening) / (k + s), (stop - opening) / (k + s)};
  strcpy(def.sensitivity.by, by[_i]);
  ck_near(slope_in(answer_of(ZP_STUDY_STATIONARY, &def), "opening_m", by[_i]), slopes[_i], near[_i]);
}

/* On the stop in front its layer bears what the field pulls beyond the spring: p_c s^3 along its length, s the depth
 * over that of the layer, p_c the spring's force at the electrode per length. */
TESTS(layer_of_the_stop_bears_the_rest, 0, 2) {
  ZpActuatorDef def = DEF(GIVEN, {"plate.stop_gap", 3e-6}, {"drive.voltage", 120}, {"plate.count", _i ? 3 : 1});
  const double k = def.plate.stiffness, g0 = def.plate.gap, depth = zp_contact_range(0);
  const ZpResult *result = answer_of(ZP_STUDY_EQUILIBRIUM, &def);
  const double g = zp_table_get(result->series, result->series->rows - 1, "opening_m"),
               pull = 0.5 * eps0 * area_of(&def) * def.drive.voltage * def.drive.voltage / (g * g),
               s = (def.plate.stop_gap - g) / depth;
  ck_near(s * s * s * k * g0, pull - k * (g0 - g), 3.8e-11); /* 1.3e-11 measured */
}

/* The contraction is 1 there. */
TEST(contraction_to_the_stop) {
  ZpActuatorDef def =
      DEF(GIVEN, {"plate.stop_gap", 3e-6}, {"drive.voltage", 60}, {"plate.mass", 3e-9}, {"solver.end_time", 5e-5});
  const ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def);
  const double g = zp_result_get(result, "opening_m"), g0 = def.plate.gap, gs = def.plate.stop_gap;
  ck_near(zp_result_get(result, "contraction"), 1 - (g - gs) / (g0 - gs), 1e-12);
}

/* Eq. (37.1): frequency without and with a voltage, which softens the spring, and of the mass of the layers. */
TESTS(frequency, 0, 3) {
  ZpActuatorDef def = DEF(GIVEN, {"plate.mass", 3e-9}, {"modes.voltage", 0});
  double mass = def.plate.mass, k = def.plate.stiffness, g = def.plate.gap;
  if (_i == 1) {
    g = 4.5e-6;
    def.modes.voltage = sqrt(2 * k * (def.plate.gap - g) / (eps0 * area_of(&def))) * g;
    k -= 2 * k * (def.plate.gap - g) / g;
  }
  if (_i == 2) def.plate.mass = NAN, mass = def.ribbon.density * def.ribbon.thickness * area_of(&def);
  ZpResult *result = study_of(ZP_STUDY_MODES, &def);
  ck_near(zp_table_get(result->series, 0, "frequency_Hz"), sqrt(k / mass) / (2 * zp_pi), 2e-10); /* 7.8e-11 measured */
}

/* -- films ----------------------------------------------------------------------------------------- */

/* Damping of a plate over that of a strip of its length, mu L b^3 / h^3: the double series, and its fit (37.5). */
static double of_strip(double length, double width) {
  const double b = fmin(length, width), L = fmax(length, width);
  double sum = 0;
  for (int n = 1; n < 2001; n += 2) {
    double x = 0.5 * zp_pi * n * L / b;
    sum += 96 / (zp_pi * zp_pi * zp_pi * zp_pi) / ((double)n * n * n * n) * (1 - tanh(x) / x);
  }
  return sum * L * b * b * b / (length * width * width * width);
}

static double fit(double length, double width) {
  const double b = fmin(length, width), L = fmax(length, width), q = b / L;
  return (1 - 0.63 * q * (1 - q * q * q * q / 12)) * L * b * b * b / (length * width * width * width);
}

/* A voltage that moves a plate by 1e-5 of its gap against a film without inertia => time constant of the creep, s. */
static double creep_time(ZpActuatorDef def) {
  static const double part = 1e-5;
  const double A = area_of(&def) * eps0 * def.medium.permittivity, g = def.plate.gap;
  def.drive.voltage = sqrt(2 * def.plate.stiffness * part / A) * g * sqrt(g);
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  const size_t rows = result->series->rows, first = rows / 20, last = rows / 5;
  const double end = zp_table_get(result->series, rows - 1, "opening_m");
  double t[2], x[2];
  for (int k = 0; k < 2; k++) {
    t[k] = zp_table_get(result->series, k ? last : first, "time_s");
    x[k] = zp_table_get(result->series, k ? last : first, "opening_m") - end;
  }
  return (t[1] - t[0]) / log(x[0] / x[1]);
}

/* Damping that this time constant means, N s/m. So small a mass counts by 1e-6, and does not make steps short. */
static double damping(const ZpActuatorDef *def, double expected) {
  ZpActuatorDef light = *def;
  light.plate.mass = 1e-6 * expected * expected / def->plate.stiffness;
  return creep_time(light) * def->plate.stiffness;
}

#define CREEPS                                                                                                         \
  PLATE, {"plate.gap", 5e-6}, {"plate.stop_gap", 1e-6}, {"plate.stiffness", 10}, {"medium.density", 1000},             \
      {"medium.kinematic_viscosity", 1e-5}, {"medium.mean_free_path", 0}, {"liquid.model", ZP_LIQUID_SUBMERGED},       \
      {"liquid.inertia", 0}, {"film.roughness", 1e-9}, {                                                               \
    "solver.tolerance", 1e-6                                                                                           \
  }

/* Eq. (37.5): strips, squares, and plates that are wider than long. */
TESTS(damping_of_a_film, 0, 6) {
  static const double length[] = {40e-3, 1e-3, 400e-6, 200e-6, 100e-6, 50e-6};
  ZpActuatorDef def = DEF(CREEPS, {"ribbon.width", 200e-6});
  const double w = def.ribbon.width, h = def.plate.gap, L = length[_i], mu = 1e-2,
               strip = mu * L * w * w * w / (h * h * h);
  def.ribbon.length = L;
  def.solver.end_time = 20 * strip * of_strip(L, w) / def.plate.stiffness;
  ck_near(damping(&def, strip * of_strip(L, w)), strip * of_strip(L, w), 5e-4); /* 2.4e-4 measured */
  ck_near(damping(&def, strip * of_strip(L, w)), strip * fit(L, w), 5e-3);      /* 1.8e-3 measured */
}

/* Liquid that cannot leave at the long edges leaves at the ends, as from a strip along the width. */
TEST(film_that_is_closed_at_its_long_edges) {
  ZpActuatorDef def = DEF(CREEPS, {"ribbon.width", 3e-3}, {"ribbon.length", 200e-6}, {"liquid.lateral_flow", 0});
  const double w = def.ribbon.width, L = def.ribbon.length, h = def.plate.gap, c = 1e-2 * w * L * L * L / (h * h * h);
  def.solver.end_time = 20 * c / def.plate.stiffness;
  ck_near(damping(&def, c), c, 3e-4); /* 1.2e-4 measured */
}

/* Eqs. (37.6) to (37.8): the film behind, slip, and a floor. */
TESTS(what_else_a_film_does, 0, 3) {
  ZpActuatorDef def = DEF(CREEPS, {"ribbon.width", 200e-6}, {"ribbon.length", 1e-3});
  const double w = def.ribbon.width, L = def.ribbon.length, h = def.plate.gap;
  double c = 1e-2 * L * w * w * w / (h * h * h) * of_strip(L, w);
  if (_i == 0) def.plate.back_gap = 7e-6, def.plate.back_stop_gap = 1e-6, c *= 1 + h * h * h / 343e-18;
  if (_i == 1) def.medium.mean_free_path = 1e-7, c /= 1 + 6e-7 / h;
  if (_i == 2) {
    def.plate.floor_gap = 2e-6, def.ribbon.thickness = 5e-6;
    const double gap = h * h * h * def.ribbon.thickness, below = 2 * 8e-18 * w;
    c *= (4 * gap + below) / (gap + below);
  }
  def.solver.end_time = 20 * c / def.plate.stiffness;
  ck_near(damping(&def, c), c, 7e-4); /* 3.5e-4 measured */
}

/* Jets and depth see twice the area over the length of the edges where the liquid leaves: the width of a strip, half of
 * that of a square, the length of a plate that is closed at its long edges. */
TEST(liquid_leaves_all_around) {
  ZpFilmParams square = {.w = 2e-4}, strip = square, shut = square, law = square;
  zp_film_modes(&law, true);
  zp_film_plate_modes(&square, 2e-4, true);
  zp_film_plate_modes(&strip, 2e4, true);
  zp_film_plate_modes(&shut, 3e-4, false);
  ck_near(square.breadth, 1e-4, 1e-12);
  ck_near(strip.breadth, law.breadth, 1e-8);
  ck_near(zp_film_depth(&strip, 5e-6), zp_film_depth(&law, 5e-6), 1.5e-9);
  ck_near(shut.breadth, 3e-4, 1e-12);
}

/* Period of a plate in a liquid that hardly flows off: the mass of the film, eq. (37.5), and that beside and behind the
 * plate, eqs. (22.3) and (22.12). */
TESTS(mass_of_a_film, 0, 2) {
  static const double length[] = {0.2, 10e-3};
  ZpActuatorDef def =
      DEF(PLATE, {"ribbon.width", 10e-3}, {"plate.gap", 4e-6}, {"plate.stop_gap", 1e-6}, {"plate.stiffness", 1e10},
          {"plate.mass", 1e-3}, {"medium.density", 1000}, {"medium.kinematic_viscosity", 1e-8},
          {"medium.mean_free_path", 0}, {"film.roughness", 1e-9}, {"medium.drag_coefficient", 0},
          {"liquid.model", ZP_LIQUID_SUBMERGED}, {"solver.tolerance", 1e-7}, {"output.samples", 2000});
  const double part = 1e-4, w = def.ribbon.width, L = length[_i], h = def.plate.gap, A = L * w * eps0;
  const double film = 1000 * L * w * w * w / (12 * h), mass = film * fit(L, w) + def.plate.mass;
  def.ribbon.length = L;
  def.plate.stiffness *= L / 10e-3; /* pressures stay far from cavities */
  def.drive.voltage = sqrt(2 * part * def.plate.stiffness / A) * h * sqrt(h);
  def.solver.end_time = 4.5 * 2 * zp_pi * sqrt(mass / def.plate.stiffness);
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  double first = NAN, last = NAN, rests = h * (1 - part);
  int count = 0;
  for (size_t row = 1; row < result->series->rows; row++) {
    double before = zp_table_get(result->series, row - 1, "opening_m") - rests,
           now = zp_table_get(result->series, row, "opening_m") - rests;
    if (before >= 0 || now < 0) continue;
    double t0 = zp_table_get(result->series, row - 1, "time_s"), t1 = zp_table_get(result->series, row, "time_s");
    last = t0 + (t1 - t0) * before / (before - now);
    if (count++ == 0) first = last;
  }
  ck_assert_int_ge(count, 3);
  const double period = (last - first) / (count - 1), soft = (1 - 2 * part) * def.plate.stiffness,
               moved = soft * period * period / (4 * zp_pi * zp_pi);
  ck_near(moved, mass, 1e-2);
}

/* -- in motion ------------------------------------------------------------------------------------- */

/* Closing, resting on the stop and swinging back, between two electrodes, dry and in air: the energy balances. */
TESTS(energy, 0, 4) {
  ZpActuatorDef def = DEF(GIVEN, {"drive.voltage", 60}, {"drive.waveform", ZP_WAVEFORM_SQUARE},
                          {"drive.frequency", 2e3}, {"solver.end_time", 2e-3}, {"plate.mass", 3e-9});
  if (_i & 1) def.plate.back_gap = 6e-6, def.plate.back_stop_gap = 1e-6;
  if (_i & 2) def.liquid.model = ZP_LIQUID_SUBMERGED, def.insulator.thickness = 1e-7, def.plate.floor_gap = 2e-6;
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_msg(zp_outcome_good(result->outcome), "%s", result->message);
  ck_assert_double_gt(zp_result_get(result, "zip_time_s"), 0);
  ck_below(zp_result_get(result, "energy_error"), 2e-10); /* 9.5e-11 measured */
}

/* So many fingers on one spring are one finger on their part of it. */
TEST(fingers_share_spring_and_mass) {
  ZpActuatorDef def = DEF(GIVEN, {"drive.voltage", 60}, {"solver.end_time", 1e-3}, {"plate.mass", 3e-9},
                          {"plate.back_gap", 6e-6}, {"plate.back_stop_gap", 1e-6},
                          {"solver.stop_when_zipped", ZP_WHEN_TRUE}),
                one = def;
  def.plate.count = 7, def.plate.stiffness *= 7, def.plate.mass *= 7, def.plate.stop_stiffness *= 7;
  ZpResult *all = study_of(ZP_STUDY_ACTUATE, &def), *single = study_of(ZP_STUDY_ACTUATE, &one);
  ck_near(zp_result_get(all, "zip_time_s"), zp_result_get(single, "zip_time_s"), 1e-12);
  ck_near(zp_result_get(all, "source_energy_J"), 7 * zp_result_get(single, "source_energy_J"), 1e-12);
}

/* Forces and charge by the voltage, and charge by the place, over a step between two electrodes, against differences.
 */
TEST(step_by_voltage) {
  ZpActuatorDef def = DEF(GIVEN, {"plate.back_gap", 7e-6}, {"plate.back_stop_gap", 1e-6});
  ZpSim *sim = sim_of(model_of(&def));
  const ZpModel *model = sim->model;
  const size_t n = zp_coordinates(model);
  double *start = memory_of(n * sizeof *start), *end = memory_of(n * sizeof *end), *F = memory_of(3 * n * sizeof *F),
         *charge = memory_of(n * sizeof *charge), Q[2];
  memcpy(start, zp_state_q(model, sim->state), n * sizeof *start);
  memcpy(end, start, n * sizeof *end);
  const size_t place[] = {model->stride + zp_lower(&model->topology, 0), model->stride + zp_lower(&model->topology, 1)};
  for (int k = 0; k < 2; k++)
    start[place[k]] = -4e-6, end[place[k]] = -3.9e-6;
  ZpSpan span = {.start = start, .end = end, .h = 1e-6, .U0 = 50, .U1 = 60, .share = 1};
  zp_system_begin(model, &span, &sim->eval);
  ZpByVoltage by = {.force = F, .charge = charge};
  zp_system_force(model, &span, &sim->eval, F + n);
  zp_system_by_voltage(model, &span, &sim->eval, &by);
  for (int k = 0; k < 2; k++) {
    ZpSpan there = span;
    there.U1 += k ? -1e-2 : 1e-2;
    zp_system_force(model, &there, &sim->eval, F + (size_t)(k + 1) * n);
    Q[k] = zp_system_electric(model, &there, &sim->eval, ZP_SPAN_END, there.U1).charge;
  }
  ck_near(by.capacitance, (Q[0] - Q[1]) / 2e-2, 2.5e-13); /* 8.4e-14 measured */
  for (int k = 0; k < 2; k++)
    ck_near(F[place[k]], (F[n + place[k]] - F[2 * n + place[k]]) / 2e-2, 8e-13); /* 2.8e-13 measured */
  for (int k = 0; k < 2; k++) {
    end[place[0]] = end[place[1]] = -3.9e-6 + (k ? -1e-10 : 1e-10);
    zp_system_force(model, &span, &sim->eval, F + n);
    Q[k] = zp_system_electric(model, &span, &sim->eval, ZP_SPAN_END, span.U1).charge;
  }
  ck_near(charge[place[0]] + charge[place[1]], (Q[0] - Q[1]) / 2e-10, 2.4e-9); /* 8.2e-10 measured */
}

/* Between two electrodes both films are inside: no liquid is outside that would drag. */
TESTS(liquid_outside_drags, 0, 2) {
  ZpActuatorDef def = DEF(GIVEN, {"drive.voltage", 60}, {"plate.mass", 3e-9}, {"solver.end_time", 1e-3},
                          {"liquid.model", ZP_LIQUID_SUBMERGED}, {"insulator.thickness", 1e-7});
  if (_i) def.plate.back_gap = 6e-6, def.plate.back_stop_gap = 1e-6;
  const double lost = zp_result_get(answer_of(ZP_STUDY_ACTUATE, &def), "outer_drag_loss_J");
  ck_assert_int_eq(lost > 0, _i == 0);
}

/* -- several --------------------------------------------------------------------------------------- */

/* Two plates on one body, of which one is half as wide, are one on both springs. */
TEST(plates_on_one_body) {
  ZpActuatorDef both = def_of("actuator.kind: plate\nmedium.permittivity: 1\nbodies: {b: {mass: 1 ug}}\n"
                              "members:\n  one: {upper: frame, lower: b}\n"
                              "  other: {upper: frame, lower: b, ribbon.width: 50 um}\n"),
                one = DEF(PLATE, {"ribbon.width", 150e-6}, {"plate.stiffness", 20}, {"plate.mass", 1e-9});
  const double pull_in = answered_value(ZP_STUDY_LIMITS, &one, "pull_in_voltage_V");
  ck_near(answered_value(ZP_STUDY_LIMITS, &both, "pull_in_voltage_V"), pull_in, 1e-14); /* 0 measured */
}

/* The lower one of two antagonists is an electrode behind the plate of the upper one. */
TEST(antagonists_are_plates_between_electrodes) {
  ZpActuatorDef two = DEF(PLATE, {"plate.gap", 6e-6}, {"stack.series", 2}, {"stack.distance", 12e-6},
                          {"stack.voltage_ratio", 0}, {"drive.voltage", 60}),
                one = DEF(PLATE, {"plate.gap", 6e-6}, {"plate.stiffness", 20}, {"drive.voltage", 60});
  ck_near(answered_value(ZP_STUDY_LIMITS, &two, "pull_in_voltage_V"),
          answered_value(ZP_STUDY_LIMITS, &one, "pull_in_voltage_V"), 1e-14); /* 0 measured */
}

/* -- derivatives ----------------------------------------------------------------------------------- */

static const char *const keys[] = {"plate.gap",     "plate.stiffness",    "plate.stop_gap",        "plate.back_gap",
                                   "plate.mass",    "plate.floor_gap",    "medium.mean_free_path", "ribbon.width",
                                   "ribbon.length", "insulator.thickness"};

static double difference(ZpStudy study, const ZpActuatorDef *def, const char *name, const char *key) {
  static const double part = 1e-3;
  const int number = zp_key_find(key);
  const double value = zp_def_get(def, number);
  ZpActuatorDef more = *def, less = *def;
  more.sensitivity.by[0] = less.sensitivity.by[0] = 0;
  ck_assert_int_eq(zp_def_set(&more, number, value * (1 + part), NULL), ZP_OK);
  ck_assert_int_eq(zp_def_set(&less, number, value * (1 - part), NULL), ZP_OK);
  return (answered_value(study, &more, name) - answered_value(study, &less, name)) / (2 * part * value);
}

static double slope_by(const ZpResult *result, const char *output) {
  for (size_t i = 0; i < result->sensitivities; i++)
    if (strcmp(result->sensitivity[i].output, output) == 0) return result->sensitivity[i].value;
  return NAN;
}

TESTS(derivatives, 0, (int)LENGTH_OF(keys)) {
  static const struct {
    ZpStudy study;
    const char *output;
    double near;
  } of[] = {{ZP_STUDY_LIMITS, "pull_in_voltage_V", 1e-5},
            {ZP_STUDY_LIMITS, "release_voltage_V", 1e-5},
            {ZP_STUDY_ACTUATE, "zip_time_s", 1e-3}};
  ZpActuatorDef def =
      DEF(GIVEN, {"drive.voltage", 90}, {"plate.back_gap", 6e-6}, {"plate.back_stop_gap", 1e-6},
          {"insulator.thickness", 1e-7}, {"plate.mass", 3e-9}, {"plate.floor_gap", 2e-6},
          {"liquid.model", ZP_LIQUID_SUBMERGED}, {"solver.stop_when_zipped", ZP_WHEN_TRUE}, {"solver.tolerance", 1e-5});
  strcpy(def.sensitivity.by, keys[_i]);
  for (size_t k = 0; k < LENGTH_OF(of); k++) {
    ZpResult *result = study_of(of[k].study, &def);
    const double slope = slope_by(result, of[k].output),
                 expected = difference(of[k].study, &def, of[k].output, keys[_i]);
    ck_assert_double_eq_tol(slope, expected,
                            of[k].near * fabs(expected) +
                                1e-12 * zp_result_get(result, of[k].output) / zp_def_get(&def, zp_key_find(keys[_i])));
  }
}

/* -- defaults -------------------------------------------------------------------------------------- */

TEST(small_gaps_have_no_cap) {
  const ZpActuatorDef small = DEF({"actuator.kind", ZP_KIND_FLANGE}, {"electro.gap_offset", 10e-6}),
                      wide = DEF({"actuator.kind", ZP_KIND_FLANGE}, {"electro.gap_offset", 30e-6}),
                      given = DEF({"actuator.kind", ZP_KIND_FLANGE}, {"electro.gap_offset", 10e-6},
                                  {"electro.breakdown_cap", true});
  ck_assert(!small.electro.breakdown_cap && wide.electro.breakdown_cap && given.electro.breakdown_cap);
  ck_near(zp_def_roughness(&small), 1e-7, 1e-15); /* 1e-16 measured */
}

/* -- what is refused ------------------------------------------------------------------------------- */

TEST(stops_beyond_electrodes_are_refused) {
  ZpActuatorDef def = DEF(GIVEN);
  def.plate.stop_gap = 6e-6;
  ck_refused(&def, "plate.stop_gap = 6e-06 m: must be below plate.gap = 5e-06 m");
  def = DEF(GIVEN, {"plate.back_gap", 3e-6}, {"plate.back_stop_gap", 4e-6});
  ck_refused(&def, "plate.back_stop_gap = 4e-06 m: must be below plate.back_gap = 3e-06 m");
  def = DEF(GIVEN, {"plate.back_gap", 3e-6});
  ck_refused(&def, "without an insulator the plate would touch the electrode behind it");
  def = DEF(GIVEN, {"plate.stop_gap", 0});
  ck_refused(&def, "insulator.thickness = 0 m");
  def = DEF(GIVEN, {"medium.density", 0}, {"liquid.model", ZP_LIQUID_SUBMERGED});
  ck_refused(&def, "nothing flows in a vacuum");
}
