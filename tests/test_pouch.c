/* A pouch: the closed law of films that do not bend, what bending and the field in the wedge add, the volume, several
 * in series, motion, networks. Theory, section 40. Measured values stand beside the bounds. */
#include "network_util.h"

#include "liquid/pouch.h"
#include "math/elementary.h"
#include "rest/rest.h"
#include "run/run.h"
#include "study/cycle_linear.h"

static const double degree = 0.017453292519943295;
enum { MOST_NODES = 401 };

/* -- the closed law -------------------------------------------------------------------------------- */

/* Films of 20 mm, electrodes of 10 mm, 50 mm wide, 18 um of permittivity 3.3, 8 kV. */
typedef struct Law {
  double Lp, Le, w, t, eps, U;
} Law;
static const Law published = {20e-3, 10e-3, 50e-3, 18e-6, 3.3, 8e3};

static double area_of(const Law *law) {
  return (law->Lp - law->Le) * (law->Lp - law->Le) / zp_pi;
}

/* Length of an arc of half opening angle a, eq. (40.1). */
static double arc_of(const Law *law, double a) {
  return sqrt(2 * area_of(law) * a * a / (a - sin(a) * cos(a)));
}

/* Length of the pouch, eq. (40.2). */
static double length_at(const Law *law, double a) {
  double lp = arc_of(law, a);
  return law->Lp - lp + lp * sin(a) / a;
}

static double strain_at(const Law *law, double a) {
  double start = zp_pouch_angle(law->Lp, area_of(law));
  return (length_at(law, start) - length_at(law, a)) / law->Lp;
}

/* Adhesion of both films by the voltage, N: energy per zipped length. */
static double adhesion(const Law *law) {
  return ZP_EPS0 * law->eps * law->w * law->U * law->U / (4 * law->t);
}

/* Eq. (40.3). */
static double force_at(const Law *law, double a) {
  return adhesion(law) * cos(a) / (1 - cos(a));
}

static double capacitance_at(const Law *law, double a) {
  return ZP_EPS0 * law->eps * law->w * (law->Lp - arc_of(law, a)) / (2 * law->t);
}

/* All digits that were published. */
TEST(closed_law) {
  static const struct {
    double angle, force, strain, capacitance, zipped;
  } row[] = {{20, 20.23464, 0.72023, 132.1847, 3.2572},
             {30, 8.39437, 2.15853, 248.3360, 6.1194},
             {60, 1.29861, 8.25308, 378.9713, 9.3385}};
  const Law *law = &published;
  ck_assert_double_eq_tol(zp_pouch_angle(law->Lp, area_of(law)) / degree, 13.839, 5e-4);
  ck_assert_double_eq_tol(force_at(law, zp_pouch_angle(law->Lp, area_of(law))), 43.43793, 5e-6);
  for (size_t k = 0; k < LENGTH_OF(row); k++) {
    const double a = row[k].angle * degree;
    ck_assert_double_eq_tol(force_at(law, a), row[k].force, 5e-6);
    ck_assert_double_eq_tol(100 * strain_at(law, a), row[k].strain, 5e-6);
    ck_assert_double_eq_tol(1e12 * capacitance_at(law, a), row[k].capacitance, 5e-5);
    ck_assert_double_eq_tol(1e3 * (law->Lp - arc_of(law, a)), row[k].zipped, 5e-5);
    ck_near(zp_pouch_angle(arc_of(law, a), area_of(law)), a, 1e-12);
  }
  ck_assert_double_eq_tol(100 * strain_at(law, 90 * degree), 17.19952, 5e-6);
  ck_assert_double_eq_tol(1e12 * capacitance_at(law, 90 * degree), 405.8169, 5e-5);
}

/* Flat arcs, whose area is a series, on both sides of where it begins. */
TEST(angle_of_flat_arcs) {
  static const double angle[] = {0.02, 0.035, 0.049, 0.051, 0.07};
  for (size_t k = 0; k < LENGTH_OF(angle); k++) {
    const double a = angle[k], area = (a - sin(a) * cos(a)) / (2 * a * a);
    ck_near(zp_pouch_angle(1, area), a, 4.3e-11); /* 1.5e-11 measured */
  }
}

/* Force is minus half the square of the voltage times dC/dH. */
TEST(closed_law_is_virtual_work) {
  const Law *law = &published;
  const double a = 40 * degree, d = 1e-4;
  double rate =
      (capacitance_at(law, a + d) - capacitance_at(law, a - d)) / (length_at(law, a + d) - length_at(law, a - d));
  ck_near(-0.5 * law->U * law->U * rate, force_at(law, a), 4.5e-8);
}

/* -- what bending and the wedge add ---------------------------------------------------------------- */

/* Films that bend, and the liquid's field in the wedge where they part, to first order in both. */
typedef struct Film {
  Law law;
  double EI, eps_m;
} Film;

/* Where the film is at s of its arc, over the middle plane. */
static double height_at(const Law *law, double lp, double a, double s) {
  double R = lp / (2 * a);
  (void)law;
  return R * (cos(2 * a * s / lp - a) - cos(a));
}

/* Capacitance of what is not zipped, eq. (40.9): by Simpson's rule in the logarithm of the place. */
static double wedge(const Film *film, double lp, double a) {
  enum { PARTS = 4000 };
  const Law *law = &film->law;
  const double d = 2 * law->t * film->eps_m / law->eps, open = fmax(law->Le - (law->Lp - lp), 0), first = 1e-3 * d;
  if (open <= first) return 0;
  const double step = log(open / first) / PARTS;
  double sum = first / d;
  for (int k = 0; k <= PARTS; k++) {
    double s = first * exp(k * step), slope = cos(2 * a * s / lp - a),
           weight = k == 0 || k == PARTS ? 1
                    : k % 2              ? 4
                                         : 2;
    sum += weight * step / 3 * s * slope / (2 * height_at(law, lp, a, s) + d);
  }
  return ZP_EPS0 * film->eps_m * law->w * sum;
}

/* Energy of the layers in which both films bend at the front and at the seam, eq. (40.10). */
static double layers(const Film *film, double force, double a) {
  return 16 * sqrt(film->EI * force / (2 * cos(a))) * (1 - cos(0.5 * a));
}

static double potential(const Film *film, double force, double lp) {
  const Law *law = &film->law;
  const double a = zp_pouch_angle(lp, area_of(law)), length = law->Lp - lp + lp * sin(a) / a;
  const double C = ZP_EPS0 * law->eps * law->w * (law->Lp - lp) / (2 * law->t) + wedge(film, lp, a);
  return -force * length - 0.5 * law->U * law->U * C + layers(film, force, a);
}

/* The arc at which the potential is least. */
static double arc_under(const Film *film, double force) {
  const double golden = 0.6180339887498949;
  double low = film->law.Lp - film->law.Le, high = film->law.Lp;
  for (int k = 0; k < 80; k++) {
    double one = high - golden * (high - low), other = low + golden * (high - low);
    if (potential(film, force, one) < potential(film, force, other))
      high = other;
    else
      low = one;
  }
  return 0.5 * (low + high);
}

/* By virtual work of the load. */
static double strain_under(const Film *film, double force) {
  const double lp = arc_under(film, force), d = 1e-4 * force;
  const double length = -(potential(film, force + d, lp) - potential(film, force - d, lp)) / (2 * d);
  return (length_at(&film->law, zp_pouch_angle(film->law.Lp, area_of(&film->law))) - length) / film->law.Lp;
}

/* A film without weight that hardly stretches, of this bending stiffness. */
static ZpActuatorDef pouch_of(const Film *film) {
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_POUCH}, {"ribbon.poisson_ratio", 0}, {"ribbon.young_modulus", 1e12},
                          {"ribbon.density", 0}, {"load.mass", 0}, {"mesh.nodes", 1601});
  const Law *law = &film->law;
  def.ribbon.thickness = zp_cube_root(12 * film->EI / (def.ribbon.young_modulus * law->w));
  def.insulator.thickness = law->t;
  def.insulator.permittivity = law->eps;
  def.medium.permittivity = film->eps_m;
  def.drive.voltage = law->U;
  return def;
}

/* Bending length over that of the film, under the tension of the closed law. */
static double stiffness_of(const Law *law, double part, double angle) {
  const double tension = 0.5 * force_at(law, angle) / cos(angle);
  return tension * (part * law->Lp) * (part * law->Lp);
}

static const double angles[] = {20, 30, 60};

typedef struct State {
  double strain, capacitance, pressure;
} State;

static State under_load(const Film *film, double force) {
  ZpActuatorDef def = pouch_of(film);
  def.load.force = force;
  ZpResult *result = study_of(ZP_STUDY_EQUILIBRIUM, &def);
  const size_t last = result->series->rows - 1;
  ck_assert_double_eq_tol(zp_table_get(result->series, last, "voltage_V"), film->law.U, 0);
  return (State){zp_table_get(result->series, last, "strain"), zp_table_get(result->series, last, "capacitance_F"),
                 zp_table_get(result->series, last, "pressure_Pa")};
}

/* Strain that both corrections take to first order, eq. (40.11), at the force of the closed law. */
static double first_order(const Film *film, double part, double a) {
  const Law *law = &film->law;
  const double d = 1e-4, C = wedge(film, arc_of(law, a + d), a + d) - wedge(film, arc_of(law, a - d), a - d);
  return law->U * law->U / (2 * law->Lp) * C / (force_at(law, a + d) - force_at(law, a - d)) +
         4 * part * (1 / cos(0.5 * a) - 1);
}

/* The closed law is their limit: a film a thousand times thinner at as much adhesion, which hardly bends. What they
 * take is then of first order, mostly by the liquid or, where the film bends over more, mostly by bending. */
TESTS(corrections_vanish, 0, 2) {
  for (size_t k = 0; k < LENGTH_OF(angles); k++) {
    const double a = angles[k] * degree, thinner = 1e-3, part = _i ? 1e-4 : 1e-6;
    Film film = {published, stiffness_of(&published, part, a), 1};
    film.law.t *= thinner;
    film.law.U *= sqrt(thinner);
    const double found = strain_under(&film, force_at(&published, a)), closed = strain_at(&published, a);
    if (_i == 0) ck_near(found, closed, 1.7e-4);
    ck_near(closed - found, first_order(&film, part, a), 0.02); /* 6.8e-3 measured */
  }
}

/* Films of 18 um that bend over 0.2 % and over 1 % of their length. They contract by less than the closed law has it,
 * by 2 to 12 %; the corrections of first order explain this but for a tenth. */
TESTS(bending_and_wedge, 0, 1) {
  static const struct { double angle, part, eps_m; } of[] = {{20, 2e-3, 2.75}, {30, 2e-3, 2.75}, {30, 1e-2, 1}};
  const double a = of[_i].angle * degree, F = force_at(&published, a), closed = strain_at(&published, a);
  const Film film = {published, stiffness_of(&published, of[_i].part, a), of[_i].eps_m};
  const ZpActuatorDef def = pouch_of(&film);
  const double stretch = F / (2 * def.ribbon.young_modulus * def.ribbon.thickness * def.ribbon.width);
  const State state = under_load(&film, F);
  const double misses = state.strain + stretch - closed, expected = strain_under(&film, F) - closed;
  printf("%g degree, bends over %g %%, liquid %g: strain %.3f %%, without stretch %.3f %%, closed law %.3f %%, "
         "explained %.0f %%\n",
         of[_i].angle, 100 * of[_i].part, of[_i].eps_m, 100 * state.strain, 100 * (state.strain + stretch),
         100 * closed, 100 * expected / misses);
  ck_near(misses, expected, 0.15);
  ck_near(state.strain, closed, 0.1);
}

ALSO_NIGHTLY(bending_and_wedge, 1, 3)

/* Nothing is zipped without a voltage: both films are arcs under the tension F / (2 cos a), which is the pressure times
 * their radius L_p / (2 a) and the width. */
TEST(pressure_of_two_arcs) {
  const Law *law = &published;
  const double a = zp_pouch_angle(law->Lp, area_of(law)), F = 25;
  Film film = {published, 0, 1};
  film.law.U = 0;
  film.EI = F / (2 * cos(a)) * (1e-3 * law->Lp) * (1e-3 * law->Lp);
  ck_near(under_load(&film, F).pressure, F * a / (law->w * law->Lp * cos(a)),
          1.6e-2); /* 5.6e-3 measured: ends that bend */
}

/* -- books ----------------------------------------------------------------------------------------- */

#define POUCH                                                                                                          \
  {"actuator.kind", ZP_KIND_POUCH}, {                                                                                  \
    "liquid.model", ZP_LIQUID_SUBMERGED                                                                                \
  }

/* Volume of coordinates over that of the liquid, less 1. */
static double lost_volume(const ZpModel *model, const double *q) {
  double h[MOST_NODES];
  for (size_t i = 0; i < model->nodes; i++)
    h[i] = -zp_nodes(model, q).y[i];
  return zp_pouch_volume(&model->pouch, model->nodes, q, h) / model->pouch.volume - 1;
}

TEST(volume_is_kept) {
  ZpActuatorDef def = DEF(POUCH);
  ZpModel *model = model_of(&def);
  ZpRest rest;
  ck_assert(zp_rest_open(&rest, model, NULL, NULL));
  ck_assert(zp_newton_good(zp_statics_find_rest(&rest.statics).end));
  ck_assert(zp_statics_ramp_voltage(&rest.statics, 1e3));
  ck_assert_double_eq_tol(lost_volume(model, rest.statics.member->q), 0, 1e-14);
  zp_rest_close(&rest);
  ZpSim *sim = sim_of(model);
  run_to(sim, 3e-3);
  ck_assert_double_eq_tol(lost_volume(model, zp_state_q(model, sim->state)), 0, 7.2e-15); /* 2.4e-15 measured */
}

/* A motion of the first order changes the volume by a part of the second. */
TEST(linear_answer_keeps_the_volume) {
  ZpActuatorDef def = DEF(POUCH, {"drive.waveform", ZP_WAVEFORM_SINE}, {"drive.frequency", 10}, {"drive.voltage", 400});
  def.liquid.model = ZP_LIQUID_NONE;
  const ZpModel *model = model_of(&def);
  ZpSim *sim = sim_of(model);
  ZpLinearCycle linear;
  bool failed;
  ck_assert(zp_linear_cycle_open(model, NULL, &linear, &failed));
  for (int k = 0; k < 8; k++) {
    zp_linear_cycle_put(&linear, k / 8.0, sim);
    ck_assert_double_eq_tol(lost_volume(model, zp_state_q(model, sim->state)), 0, 3.4e-15); /* 1.1e-15 measured */
  }
  zp_linear_cycle_close(&linear);
}

/* The multiplier of a step is the pressure at rest as long as nothing moves. */
TEST(pressure_of_steps_is_that_at_rest) {
  ZpActuatorDef def = DEF(POUCH, {"drive.voltage", 0}, {"solver.end_time", 0.05});
  const ZpTable *table = study_of(ZP_STUDY_ACTUATE, &def)->series;
  const double at_rest = zp_table_get(table, 0, "pressure_Pa");
  ck_below(100, at_rest);
  for (size_t row = 1; row < table->rows; row++)
    ck_near(zp_table_get(table, row, "pressure_Pa"), at_rest, 1.2e-7); /* 4.1e-8 measured */
}

/* The largest imbalance of a run over the work. */
static double lost_energy(const ZpActuatorDef *def) {
  const ZpTable *table = study_of(ZP_STUDY_ACTUATE, def)->series;
  double worst = 0, work = 0;
  for (size_t k = 0; k < table->rows; k++) {
    worst = fmax(worst, fabs(zp_table_get(table, k, "energy_imbalance_J")));
    work = fmax(work, zp_table_get(table, k, "electric_work_J"));
  }
  printf("energy off by %.2g\n", worst / work);
  return worst / work;
}

/* In oil and without liquid, of one and of several in series, behind a supply. */
TESTS(energy_is_kept, 0, 4) {
  static const double allowed[] = {5.7e-11, 5e-7, 1.1e-10, 1.8e-11}; /* 1.9e-11, 1.7e-7, 3.6e-11, 6.1e-12 measured */
  ZpActuatorDef def = DEF(POUCH, {"solver.end_time", 5e-3});
  if (_i == 1) def.liquid.model = ZP_LIQUID_NONE, def.solver.end_time = 1e-3;
  if (_i == 2) def.pouch.count = 5;
  if (_i == 3) def.source.model = ZP_SOURCE_AMPLIFIER, def.source.current_limit = 1e-3;
  ck_below(lost_energy(&def), allowed[_i]);
}

/* The pressure leaps where films land, and a supply that yields lets them rebound in steps of nanoseconds. */
TEST(impact_behind_a_resistor) {
  ZpActuatorDef def = DEF(POUCH, {"ribbon.length", 45e-3}, {"pouch.electrode_length", 20e-3}, {"load.mass", 0.1},
                          {"mesh.nodes", 9}, {"source.resistance", 1e7}, {"source.capacitance", 100e-12},
                          {"solver.end_time", 30e-3}, {"solver.tolerance", 1e-4});
  def.liquid.model = ZP_LIQUID_NONE;
  def.source.model = ZP_SOURCE_AMPLIFIER;
  ck_below(lost_energy(&def), 3e-8); /* 1.1e-8 measured */
}

/* The zipped length is told as a share of that of the electrodes. */
TEST(contraction_is_zipped_length) {
  ZpActuatorDef def = DEF(POUCH, {"solver.end_time", 5e-3});
  const ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  ck_near(zp_result_get(result, "contraction"), zp_result_get(result, "zipped_length_m") / def.pouch.electrode_length,
          1e-14);
}

/* A run begins at rest. */
TEST(pressure_at_the_start) {
  ZpActuatorDef def = DEF(POUCH);
  ck_near(settled_value(&def, "pressure"), answered_value(ZP_STUDY_STATIONARY, &def, "pressure_Pa"),
          6.2e-8); /* 2e-8 measured */
}

/* The film up to the middle plane, at half of the gaps, flows half as much as the whole under the same heads. */
TEST(half_of_the_film_flows_half) {
  enum { N = ZP_FILM_MODES * MOST_NODES };
  ZpActuatorDef def = DEF(POUCH);
  const ZpFilmParams half = model_of(&def)->film;
  ZpFilmParams film[2] = {half, half};
  film[1].mu = def.medium.kinematic_viscosity * def.medium.density;
  film[1].roughness = zp_def_roughness(&def);
  double gap[2][MOST_NODES], head[N], *start = memory_of(ZP_FILM_STATE * half.nodes * sizeof *start), left[2][N];
  for (int k = 0; k < 2; k++) {
    uint64_t seed = 3;
    ZpFilmEval eval;
    ZpArena arena = {NULL, 0};
    zp_film_reserve(&film[k], &eval, &arena);
    arena = (ZpArena){memory_of(arena.used + ZP_ALIGNMENT), 0};
    zp_film_reserve(&film[k], &eval, &arena);
    for (size_t i = 0; i < half.nodes; i++)
      gap[k][i] = (k + 1) * 1e-6 * (double)i * (1 + 0.1 * noise(&seed));
    for (size_t i = 0; i < ZP_FILM_MODES * half.nodes; i++)
      head[i] = 1e3 * noise(&seed);
    zp_film_step(&film[k], &(ZpFilmEnds){0}, gap[k], gap[k], 1e-4, start, head, &eval);
    for (size_t i = 0; i < ZP_FILM_MODES * half.nodes; i++)
      left[k][i] = zp_film_is_free(&half, &eval, i / ZP_FILM_MODES, (int)(i % ZP_FILM_MODES)) ? eval.r[i] : 0;
  }
  for (size_t i = 0; i < ZP_FILM_MODES * half.nodes; i++)
    ck_assert_double_eq_tol(2 * left[0][i], left[1][i], 1e-15 * largest_of(left[1], ZP_FILM_MODES * half.nodes));
}

/* Several in series draw their load so many times as fast as one. */
TEST(load_moves_as_its_stroke) {
  ZpActuatorDef def = DEF(POUCH, {"pouch.count", 3}, {"load.mass", 2e-2});
  ZpSim *sim = sim_of(model_of(&def));
  double stroke[3], velocity[3];
  for (int k = 0; k < 3; k++) {
    run_to(sim, 1e-3 + k * 1e-6);
    stroke[k] = zp_sim_get(sim, "stroke"), velocity[k] = zp_sim_get(sim, "end_velocity");
  }
  ck_near((stroke[2] - stroke[0]) / 2e-6, velocity[1], 2.9e-6); /* 9.7e-7 measured */
}

/* Five have one strain, one force, and five times the stroke and the capacitance. */
TEST(several_are_as_one) {
  ZpActuatorDef one = DEF(POUCH, {"isometric.strain", 0.05}), five = one;
  five.pouch.count = 5;
  const ZpResult *single = study_of(ZP_STUDY_EQUILIBRIUM, &one), *series = study_of(ZP_STUDY_EQUILIBRIUM, &five);
  const size_t last = single->series->rows - 1;
  ck_near(zp_table_get(series->series, last, "strain"), zp_table_get(single->series, last, "strain"), 1e-14);
  ck_near(zp_table_get(series->series, last, "stroke_m"), 5 * zp_table_get(single->series, last, "stroke_m"), 1e-14);
  ck_near(zp_table_get(series->series, last, "capacitance_F"), 5 * zp_table_get(single->series, last, "capacitance_F"),
          1e-14);
  ck_near(answered_value(ZP_STUDY_ISOMETRIC, &five, "force_N"), answered_value(ZP_STUDY_ISOMETRIC, &one, "force_N"),
          1e-12);
}

/* In motion, too, without weight: five that draw a mass are one that draws five times that mass. */
TEST(several_move_as_one) {
  ZpActuatorDef one = DEF(POUCH, {"gravity", 0}, {"solver.end_time", 5e-3}), five = one;
  five.pouch.count = 5;
  one.load.mass = 5 * five.load.mass;
  ck_near(answered_value(ZP_STUDY_ACTUATE, &five, "stroke_m"), 5 * answered_value(ZP_STUDY_ACTUATE, &one, "stroke_m"),
          2.8e-14);
}

/* Charge is capacitance times voltage, also where electrodes end. As the force does no work but on the ends, dF/dU is
 * dQ/ds, s the way of the ends: of several in series each has the force, and all have the charge and the way. */
TEST(force_and_charge_are_reciprocal) {
  ZpActuatorDef def = DEF(POUCH, {"isometric.strain", 0.05}, {"pouch.count", 3});
  snprintf(def.sensitivity.by, sizeof def.sensitivity.by, "drive.voltage, isometric.strain");
  const ZpResult *result = answer_of(ZP_STUDY_ISOMETRIC, &def);
  ck_near(zp_result_get(result, "charge_C"), zp_result_get(result, "capacitance_F") * def.drive.voltage, 1e-12);
  ck_near(slope_in(result, "charge_C", "isometric.strain") / (def.pouch.count * def.ribbon.length),
          slope_in(result, "force_N", "drive.voltage"), 1e-10); /* 3.7e-11 measured */
  ck_near(zp_result_get(result, "contraction"), zp_result_get(result, "zipped_length_m") / def.pouch.electrode_length,
          1e-14);
}

/* It has closed when 99 % of its electrodes are zipped. */
TEST(closes_when_zipped) {
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_POUCH}, {"liquid.model", ZP_LIQUID_NONE}, {"mesh.nodes", 101},
                          {"pouch.fill", 0.6}, {"load.mass", 20e-3}, {"drive.voltage", 8e3},
                          {"solver.end_time", 1.2e-3}, {"output.samples", 2000}, {"output.errors", 0});
  const ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  const double time = zp_result_get(result, "zip_time_s");
  size_t row = 1;
  while (row < result->series->rows && zp_table_get(result->series, row, "contraction") < 0.99)
    row++;
  ck_near(time, zp_table_get(result->series, row, "time_s"), 1.7e-4); /* 5.5e-5 measured */
  ck_assert(zp_result_get(result, "closed_from_s") >= time);
}

/* Without a load a soft film contracts until the electrodes are closed; where its ends are held it pulls with the
 * blocking force, less than the closed law has, for its arcs flatten where they bend. */
TEST(free_strain_and_blocking_force) {
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_POUCH}, {"load.mass", 0}, {"gravity", 0}, {"drive.voltage", 8e3},
                          {"ribbon.thickness", 4e-6}, {"insulator.thickness", 18e-6});
  ZpResult *result = study_of(ZP_STUDY_EQUILIBRIUM, &def);
  ck_near(zp_table_get(result->series, result->series->rows - 1, "strain"), strain_at(&published, 90 * degree), 0.09);
  const double blocked = force_at(&published, zp_pouch_angle(published.Lp, area_of(&published)));
  const double force = answered_value(ZP_STUDY_ISOMETRIC, &def, "force_N");
  ck_below(force, blocked);
  ck_below(0.3 * blocked, force);
}

/* Both films are drawn, as mirror images. */
TEST(shapes_have_both_films) {
  ZpActuatorDef def = DEF(POUCH);
  const ZpShapes *shapes = answer_of(ZP_STUDY_STATIONARY, &def)->shapes;
  ck_assert_uint_eq(zp_shapes_ribbons(shapes), 2);
  const ZpShape shape = zp_shapes_get(shapes, zp_shapes_frames(shapes) - 1);
  for (size_t i = 0; i < zp_shapes_nodes(shapes); i++) {
    ck_assert_double_eq(shape.x[2 * i], shape.x[2 * i + 1]);
    ck_assert_double_eq(shape.y[2 * i], -shape.y[2 * i + 1]);
  }
}

/* Insulators conduct as the field in them, and so as the charge: Q / (rho eps), before they have conducted much. */
TEST(leaks_as_its_charge) {
  ZpActuatorDef def = DEF(POUCH, {"insulator.resistivity", 1e12}, {"pouch.count", 2});
  ZpSim *sim = sim_of(model_of(&def));
  run_to(sim, 1e-4);
  ck_near(zp_sim_get(sim, "leak_current"),
          zp_sim_get(sim, "charge") / (def.insulator.resistivity * ZP_EPS0 * def.insulator.permittivity), 1e-12);
}

/* -- derivatives ----------------------------------------------------------------------------------- */

/* Of the volume by its coordinates. */
TEST(rates_of_the_volume) {
  enum { N = 7 };
  const ZpPouchParams pouch = {.w = 0.05, .volume = 1e-6, .electrode = 1e-3, .length = 6e-3};
  double x[N], h[N];
  for (size_t i = 0; i < N; i++) {
    x[i] = 1e-3 * (double)i + 1e-4 * sin(3.0 * (double)i);
    h[i] = 3e-5 + 2e-4 * (double)(i * (N - 1 - i)); /* not 0 at the ends, either */
  }
  for (size_t i = 0; i < N; i++)
    for (int c = 0; c < 2; c++) {
      double *q = c ? &h[i] : &x[i], by = 1e-7,
             rate = c ? zp_pouch_by_h(&pouch, N, x, i) : zp_pouch_by_x(&pouch, N, h, i);
      *q += by;
      double more = zp_pouch_volume(&pouch, N, x, h);
      *q -= 2 * by;
      double less = zp_pouch_volume(&pouch, N, x, h);
      *q += by;
      ck_assert_double_eq_tol(rate, (more - less) / (2 * by), 1e-12);
    }
}

/* Of the force by keys against differences of two studies. */
TESTS(force_by_keys, 0, 4) {
  static const char *const keys[] = {"drive.voltage", "isometric.strain", "pouch.fill", "ribbon.length"};
  static const double allowed[] = {4.9e-9, 4.4e-10, 1.4e-9, 6.8e-9}; /* 1.6e-9, 1.5e-10, 4.7e-10, 2.3e-9 measured */
  ZpActuatorDef def = DEF(POUCH, {"isometric.strain", 0.05});
  const int key = zp_key_find(keys[_i]);
  const double value = zp_def_get(&def, key), by = 1e-6 * value;
  snprintf(def.sensitivity.by, sizeof def.sensitivity.by, "%s", keys[_i]);
  const double rate = derivative_of(study_of(ZP_STUDY_ISOMETRIC, &def), "force_N", key);
  def.sensitivity.by[0] = 0;
  static const int at[] = {-2, -1, 1, 2};
  double force[4];
  for (int k = 0; k < 4; k++) {
    ck_assert_int_eq(zp_def_set(&def, key, value + at[k] * by, NULL), ZP_OK);
    force[k] = answered_value(ZP_STUDY_ISOMETRIC, &def, "force_N");
  }
  ck_near(rate, (force[0] - 8 * force[1] + 8 * force[2] - force[3]) / (12 * by), allowed[_i]);
}

/* Of several in series, whose load weighs on each, though to one of them it is heavier. */
TEST(stroke_by_gravity) {
  ZpActuatorDef def = DEF(POUCH, {"pouch.count", 3});
  snprintf(def.sensitivity.by, sizeof def.sensitivity.by, "gravity");
  const double slope = slope_in(answer_of(ZP_STUDY_STATIONARY, &def), "stroke_m", "gravity"), by = 1e-3;
  double stroke[2];
  def.sensitivity.by[0] = 0;
  for (int k = 0; k < 2; k++) {
    def.gravity += k ? -2 * by : by;
    stroke[k] = answered_value(ZP_STUDY_STATIONARY, &def, "stroke_m");
  }
  ck_near(slope, (stroke[0] - stroke[1]) / (2 * by), 2.7e-8); /* 8.9e-9 measured */
}

/* -- members of networks --------------------------------------------------------------------------- */

/* Pouches of light thick films, whose fronts are longer than elements, and what follows. */
static ZpActuatorDef pouches(const char *rest) {
  char text[1024];
  snprintf(text, sizeof text,
           "study: stationary\nactuator.kind: pouch\nmesh.nodes: 101\nribbon: {density: 1 kg/m3, thickness: 60 um}\n"
           "drive: {voltage: 6 kV, waveform: ramp, rise_time: 8 ms}\nsolver: {end_time: 10 ms, time_step: 50 us}\n%s",
           rest);
  return def_of(text);
}

static const char in_a_row[] = "pouch.count: 2\nload.mass: 200 g\n", alone[] = "load.mass: 200 g\n",
                  below[] = "bodies: {link: {mass: 0 g}, hand: {mass: 200 g}}\n"
                            "members: {a: {upper: frame, lower: link}, b: {upper: link, lower: hand}}\n",
                  beside[] = "bodies: {hand: {mass: 400 g}}\n"
                             "members: {a: {upper: frame, lower: hand}, b: {upper: frame, lower: hand}}\n",
                  on_a_spring[] =
                      "bodies: {floor: {moves: none, at: [0, -31 mm]}, hand: {mass: 100 g}}\n"
                      "members: {a: {upper: frame, lower: hand}}\n"
                      "springs: {coil: {between: [hand, floor], stiffness: 2 N/mm, rest: 10 mm, kind: pull}}\n",
                  opposed[] = "bodies: {floor: {moves: none, at: [0, -39.63 mm]}, hand: {mass: 100 g}}\n"
                              "members: {a: {upper: frame, lower: hand}, b: {upper: floor, lower: hand, angle: 180 "
                              "degree, drive.voltage: 0 V}}\n";

static double last(const ZpResult *result, const char *column) {
  return zp_table_get(result->series, result->series->rows - 1, column);
}

/* At rest two below each other are pouch.count 2, and two beside each other with twice the load are as one. */
TESTS(members_rest_as_one, 0, 2) {
  ZpActuatorDef one = pouches(_i ? alone : in_a_row), two = pouches(_i ? beside : below);
  one.ribbon.density = two.ribbon.density = 0;
  const ZpResult *a = answer_of(ZP_STUDY_EQUILIBRIUM, &one), *b = answer_of(ZP_STUDY_EQUILIBRIUM, &two);
  const double start = answered_value(ZP_STUDY_STATIONARY, &two, "bodies.hand.y_m"),
               hangs = answered_value(ZP_STUDY_STATIONARY, &one, "stroke_m");
  const double rises = last(b, "hand.y_m") - start, stroke = last(a, "stroke_m") - hangs;
  printf("rise off by %.2g, charge by %.2g\n", rises / stroke - 1, last(b, "charge_C") / last(a, "charge_C") - 1);
  ck_near(rises, stroke, 1e-13);                                           /* 0 measured */
  ck_near(last(b, "charge_C"), (_i ? 2 : 1) * last(a, "charge_C"), 1e-13); /* 1.8e-15 measured */
}

/* And in motion, without weight, whose films pull at those above them. */
TESTS(members_move_as_one, 0, 2) {
  ZpActuatorDef one = pouches(_i ? alone : in_a_row), two = pouches(_i ? beside : below);
  one.gravity = two.gravity = 0;
  one.ribbon.density = two.ribbon.density = 0.1;
  const ZpResult *a = answer_of(ZP_STUDY_ACTUATE, &one), *b = answer_of(ZP_STUDY_ACTUATE, &two);
  const double rises = last(b, "hand.y_m") - zp_table_get(b->series, 0, "hand.y_m"),
               stroke = last(a, "stroke_m") - zp_table_get(a->series, 0, "stroke_m");
  printf("rise off by %.2g\n", rises / stroke - 1);
  ck_near(rises, stroke, _i ? 1e-13 : 5e-8); /* 0; 1.6e-8 measured, which goes with the mass of the films */
  ck_near(last(b, "strain"), last(a, "strain"), _i ? 1e-13 : 5e-8);
}

/* And in small motions. */
TESTS(members_vibrate_as_one, 0, 2) {
  ZpActuatorDef one = pouches(_i ? alone : in_a_row), two = pouches(_i ? beside : below);
  one.liquid.model = two.liquid.model = ZP_LIQUID_NONE;
  one.drive.voltage = two.drive.voltage = 0;
  const double a = answered_value(ZP_STUDY_MODES, &one, "frequency_1_Hz"),
               b = answered_value(ZP_STUDY_MODES, &two, "frequency_1_Hz");
  printf("frequency off by %.2g\n", b / a - 1);
  ck_near(b, a, _i ? 2.6e-11 : 6e-8); /* 8.7e-12; 2.1e-8 measured, which goes with the mass of the films */
}

/* Where a spring stretches, a pouch pulls with its force and the weight, and held alone at that strain as much. */
TEST(spring_is_what_a_held_pouch_pulls) {
  ZpActuatorDef on = pouches(on_a_spring), held = pouches("");
  on.ribbon.density = held.ribbon.density = 0;
  const ZpResult *r = answer_of(ZP_STUDY_EQUILIBRIUM, &on);
  const double spring = 2e3 * (last(r, "hand.y_m") + 31e-3 - 10e-3), pull = spring + 0.1 * on.gravity;
  held.isometric.strain = last(r, "a.stroke_m") / held.ribbon.length;
  const double force = answered_value(ZP_STUDY_ISOMETRIC, &held, "force_N");
  printf("pull off by %.2g, held by %.2g\n", last(r, "a.force_N") / pull - 1, force / pull - 1);
  ck_near(last(r, "a.force_N"), pull, 5e-11); /* 1.7e-11 measured */
  ck_near(force, pull, 1e-13);                /* 2.2e-16 measured */
}

/* One that opens upwards takes what the upper one does not carry. */
TEST(opposed_ones_hold_the_weight_between_them) {
  ZpActuatorDef def = pouches(opposed);
  def.ribbon.density = 0;
  const ZpResult *r = answer_of(ZP_STUDY_EQUILIBRIUM, &def);
  const double weight = 0.1 * def.gravity;
  printf("off by %.2g\n", (last(r, "a.force_N") - last(r, "b.force_N")) / weight - 1);
  ck_near(last(r, "a.force_N") - last(r, "b.force_N"), weight, 8e-10); /* 2.5e-10 measured */
  ck_below(1, last(r, "b.force_N"));
}

/* A body that moves up lets its pouch slack. */
TEST(slack_pouch_has_no_rest) {
  ZpActuatorDef def = pouches("bodies: {hand: {mass: 100 g, force: [0, 2 N]}}\n"
                              "members: {a: {upper: frame, lower: hand}}\n");
  def.ribbon.thickness = 18e-6;
  ck_assert_int_ne(study_of(ZP_STUDY_STATIONARY, &def)->outcome, ZP_CONVERGED);
}

/* The force that holds a body is that which holds the end of the pouch, in a row, too. */
TESTS(held_body_is_a_held_end, 0, 2) {
  ZpActuatorDef end = pouches(""), body = pouches(_i ? below : on_a_spring);
  end.ribbon.density = body.ribbon.density = 0;
  end.isometric.strain = 0.005;
  body.isometric.body = 2;
  const ZpModel *model = model_of(&end);
  const double length = model->stroke_at - 0.005 * end.ribbon.length;
  body.isometric.separation = (_i ? 2 : 1) * length;
  const double spring = _i ? 0 : 2e3 * (31e-3 - 10e-3 - length);
  const double force = answered_value(ZP_STUDY_ISOMETRIC, &body, "force_N"),
               alone_force = answered_value(ZP_STUDY_ISOMETRIC, &end, "force_N");
  printf("force off by %.2g\n", (force + spring) / alone_force - 1);
  ck_near(force + spring, alone_force, 1e-13); /* 1.8e-15 measured */
}

/* A chain with a spring, and one against another, behind films that have weight. */
TESTS(energy_of_members_is_kept, 0, 3) {
  static const char *const of[] = {below, on_a_spring, opposed};
  static const double allowed[] = {8.7e-10, 2.5e-9, 2e-9}; /* 2.9e-10, 8.4e-10, 6.8e-10 measured */
  ZpActuatorDef def = pouches(of[_i]);
  def.ribbon.density = 1390;
  def.drive.waveform = ZP_WAVEFORM_STEP;
  def.drive.rise_time = zp_actuator_def_default().drive.rise_time;
  def.solver.time_step = NAN;
  def.solver.end_time = 2e-3;
  ck_below(lost_energy(&def), allowed[_i]);
}

/* Derivatives at rest by keys of a body and a spring are those of differences. */
TESTS(places_by_keys, 0, 2) {
  ZpActuatorDef def = pouches(on_a_spring);
  const int key[] = {zp_key_of_instance(zp_key_find("body_K.mass"), 2),
                     zp_key_of_instance(zp_key_find("spring_K.stiffness"), 1)};
  const double value = zp_def_get(&def, key[_i]), by = 1e-4 * value;
  snprintf(def.sensitivity.by, sizeof def.sensitivity.by, "%s", ZP_KEY_NAME(key[_i]));
  const double rate = derivative_of(answer_of(ZP_STUDY_STATIONARY, &def), "bodies.hand.y_m", key[_i]);
  def.sensitivity.by[0] = 0;
  double y[2];
  for (int k = 0; k < 2; k++) {
    ck_assert_int_eq(zp_def_set(&def, key[_i], value + (k ? by : -by), NULL), ZP_OK);
    y[k] = answered_value(ZP_STUDY_STATIONARY, &def, "bodies.hand.y_m");
  }
  printf("off by %.2g\n", rate / ((y[1] - y[0]) / (2 * by)) - 1);
  ck_near(rate, (y[1] - y[0]) / (2 * by), 1.3e-8); /* 4.2e-9 measured */
}

/* Films are drawn below their bodies, one on each side. */
TEST(members_are_drawn_hanging) {
  ZpActuatorDef def = pouches(below);
  def.output.shapes = 4;
  const ZpResult *r = answer_of(ZP_STUDY_EQUILIBRIUM, &def);
  const ZpShapes *shapes = r->shapes;
  const ZpShape shape = zp_shapes_get(shapes, zp_shapes_frames(shapes) - 1);
  const size_t each = zp_shapes_nodes(shapes), half = each / 2;
  ck_assert_uint_eq(zp_shapes_ribbons(shapes), 2);
  for (size_t j = 0; j < each; j++) {
    ck_assert_double_eq(shape.x[2 * j], -shape.x[2 * j + 1]);
    ck_assert_double_eq(shape.y[2 * j], shape.y[2 * j + 1]);
  }
  ck_near(shape.y[2 * half], last(r, "link.y_m"), 1e-14); /* 0 measured */
  ck_near(shape.y[2 * each - 2], last(r, "hand.y_m"), 1e-14);
  ck_below(1e-3, fabs(shape.x[half]));
}

/* -- wrong input ----------------------------------------------------------------------------------- */

TEST(refuses_what_no_pouch_is) {
  static const struct {
    const char *key, *says;
    double value;
  } of[] = {{"pouch.fill", "cannot hold", 5},
            {"pouch.electrode_length", "no room", 19.9e-3},
            {"liquid.lateral_flow", "sealed at its sides", 1},
            {"electro.edges", "not known", 1}};
  for (size_t k = 0; k < LENGTH_OF(of); k++) {
    ZpActuatorDef def = DEF(POUCH);
    ZpError err;
    ck_assert_int_eq(zp_def_set(&def, zp_key_find(of[k].key), of[k].value, NULL), ZP_OK);
    ck_assert_int_eq(zp_def_check(&def, &err), ZP_BAD_INPUT);
    ck_assert_msg(strstr(err.message, of[k].says) != NULL, "%s", err.message);
  }
}

TEST(networks_ask_for_one_pouch_a_member) {
  static const char network[] = "actuator.kind: pouch\nbodies: {hand: {mass: 1 g}}\n"
                                "members: {a: {upper: frame, lower: hand}}\n%s";
  static const struct {
    const char *keys, *says;
  } of[] = {{"pouch.count: 2\n", "each pouch of a network is a member"},
            {"isometric.strain: 0.01\n", "a body is held at isometric.separation"}};
  for (size_t k = 0; k < LENGTH_OF(of); k++) {
    char text[256];
    snprintf(text, sizeof text, network, of[k].keys);
    ck_scenario_refused(ZP_STUDY_ISOMETRIC, text, of[k].says);
  }
}

/* -- stiffness ------------------------------------------------------------------------------------- */

/* The stiffness with its term of rank one, column by column, against differences of forces. */
TEST(stiffness_is_the_derivative_of_forces) {
  enum { MOST = 2 * MOST_NODES };
  ZpActuatorDef def = DEF(POUCH, {"mesh.nodes", 21}, {"drive.voltage", 4e3});
  ZpModel *model = model_of(&def);
  ZpRest rest;
  double up[MOST], down[MOST], u[MOST], column[MOST], worst = 0, largest = 0;
  ck_assert(zp_rest_open(&rest, model, NULL, NULL));
  ZpStatics *s = &rest.statics;
  ZpStaticSystem system = zp_statics_system(s);
  ck_assert(zp_newton_good(zp_statics_find_rest(s).end));
  s->U = def.drive.voltage;
  system.residual(s, up, NULL);
  zp_statics_take_tensions(s);
  zp_statics_exact_stiffness(s);
  for (size_t j = 0; j < system.n; j++) {
    memset(u, 0, sizeof u);
    u[j] = 1;
    zp_arrow_multiply(&s->newton.K, u, column);
    for (int k = 0; k < 2; k++) {
      const double by = k ? -2e-9 : 1e-9;
      for (size_t c = 0; c < 2 * model->count; c++)
        if (s->member->assembly.equation[c] == (int)j) s->member->q[c / 2 + (c % 2) * model->stride] += by;
      system.residual(s, k ? down : up, NULL);
    }
    for (size_t c = 0; c < 2 * model->count; c++)
      if (s->member->assembly.equation[c] == (int)j) s->member->q[c / 2 + (c % 2) * model->stride] += 1e-9;
    for (size_t i = 0; i < system.n; i++) {
      const double difference = (down[i] - up[i]) / 2e-9;
      worst = fmax(worst, fabs(column[i] - difference));
      largest = fmax(largest, fabs(difference));
    }
  }
  ck_below(worst / largest, 6e-9);
  zp_rest_close(&rest);
}

/* That of a step, in directions that keep the volume to first order: of two random ones, so much of both that the term
 * of rank one, a hundred thousand times as large as all else, is not in them. */
TEST(tangent_of_a_step) {
  static const double h = 1e-6, by = 1e-8;
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_POUCH}, {"mesh.nodes", 16}, {"load.mass", 50});
  ZpSim *sim = sim_of(model_of(&def));
  run_to(sim, 1e-4);
  ZpDynamics *d = &sim->dynamics;
  const ZpImplicitSystem *system = &d->system;
  const size_t n = system->n, size = n * sizeof(double);
  double *y = memory_of(size), *at = memory_of(size), *u[2], *column[2], *r[2], worst = 0, largest = 0;
  uint64_t seed = 11;
  for (int k = 0; k < 2; k++)
    u[k] = memory_of(size), column[k] = memory_of(size), r[k] = memory_of(size);
  zp_dynamics_begin(d, sim->states, 1e-4 + h);
  system->begin(d, d->q, d->v);
  for (size_t i = 0; i < n; i++)
    at[i] = d->q[i];
  for (int twice = 0; twice < 2; twice++)
    system->residual(d, at, h, r[0]);
  system->tangent(d, &d->stepper.A);
  for (int round = 0; round < 10; round++) {
    size_t most = 0;
    for (int k = 0; k < 2; k++) {
      for (size_t i = 0; i < n; i++)
        u[k][i] = noise(&seed);
      zp_arrow_multiply(&d->stepper.A, u[k], column[k]);
    }
    for (size_t i = 0; i < n; i++)
      if (fabs(column[1][i]) > fabs(column[1][most])) most = i;
    const double part = column[0][most] / column[1][most];
    for (int k = 0; k < 2; k++) {
      for (size_t i = 0; i < n; i++)
        y[i] = at[i] + (k ? -by : by) * (u[0][i] - part * u[1][i]);
      system->residual(d, y, h, r[k]);
    }
    for (size_t i = 0; i < n; i++) {
      const double expected = (r[1][i] - r[0][i]) / (2 * by);
      worst = fmax(worst, fabs(column[0][i] - part * column[1][i] - expected));
      largest = fmax(largest, fabs(expected));
    }
  }
  ck_below(worst / largest, 6.3e-8); /* 2.1e-8 measured */
}
