/* A pouch: the closed law of films that do not bend, what bending and the field in the wedge add, the volume, several
 * in series, motion. Theory, section 40. Measured values stand beside the bounds. */
#include "check_util.h"

#include "liquid/pouch.h"
#include "math/elementary.h"
#include "rest/rest.h"
#include "run/run.h"

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

/* The closed law is their limit: a film a thousand times thinner at as much adhesion, which hardly bends. */
TEST(corrections_vanish) {
  for (size_t k = 0; k < LENGTH_OF(angles); k++) {
    const double a = angles[k] * degree, thinner = 1e-3;
    Film film = {published, stiffness_of(&published, 1e-6, a), 1};
    film.law.t *= thinner;
    film.law.U *= sqrt(thinner);
    ck_near(strain_under(&film, force_at(&published, a)), strain_at(&published, a), 1.7e-4);
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
  ck_assert_double_eq_tol(lost_volume(model, zp_state_q(model, sim->state)), 0, 7e-15); /* 2.5e-15 measured */
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

/* In oil and without liquid, of one and of several in series, behind a supply. */
TESTS(energy_is_kept, 0, 4) {
  ZpActuatorDef def = DEF(POUCH, {"solver.end_time", 5e-3});
  if (_i == 1) def.liquid.model = ZP_LIQUID_NONE, def.solver.end_time = 1e-3;
  if (_i == 2) def.pouch.count = 5;
  if (_i == 3) def.source.model = ZP_SOURCE_AMPLIFIER, def.source.current_limit = 1e-3;
  const ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  double worst = 0, work = 0;
  for (size_t k = 0; k < result->series->rows; k++) {
    worst = fmax(worst, fabs(zp_table_get(result->series, k, "energy_imbalance_J")));
    work = fmax(work, zp_table_get(result->series, k, "electric_work_J"));
  }
  ck_below(worst / work, _i == 1 ? 4.8e-7 : 1.1e-10); /* 1.7e-7; 3.7e-11 measured */
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

/* It has closed when 99 % of its electrodes are zipped. */
TEST(closes_when_zipped) {
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_POUCH}, {"liquid.model", ZP_LIQUID_NONE}, {"mesh.nodes", 101},
                          {"pouch.fill", 0.6}, {"load.mass", 20e-3}, {"drive.voltage", 8e3},
                          {"solver.end_time", 1.2e-3}, {"output.samples", 2000}, {"output.errors", 0});
  const ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  const double time = zp_result_get(result, "zip_time_s");
  for (size_t row = 1; row < result->series->rows; row++) {
    if (zp_table_get(result->series, row, "contraction") < 0.99) continue;
    ck_assert(zp_table_get(result->series, row - 1, "time_s") <= time);
    ck_assert(time <= zp_table_get(result->series, row, "time_s"));
    break;
  }
  ck_near(time, 1.036e-3, 1e-3);
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

/* -- derivatives ----------------------------------------------------------------------------------- */

/* Of the volume by its coordinates. */
TEST(rates_of_the_volume) {
  enum { N = 7 };
  const ZpPouchParams pouch = {.w = 0.05, .volume = 1e-6, .electrode = 1e-3, .length = 6e-3};
  double x[N], h[N];
  for (size_t i = 0; i < N; i++) {
    x[i] = 1e-3 * (double)i + 1e-4 * sin(3.0 * (double)i);
    h[i] = 2e-4 * (double)(i * (N - 1 - i));
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
  ZpActuatorDef def = DEF(POUCH, {"isometric.strain", 0.05});
  const int key = zp_key_find(keys[_i]);
  const double value = zp_def_get(&def, key), by = 1e-6 * value;
  snprintf(def.sensitivity.by, sizeof def.sensitivity.by, "%s", keys[_i]);
  const double rate = derivative_of(study_of(ZP_STUDY_ISOMETRIC, &def), "force_N", key);
  def.sensitivity.by[0] = 0;
  double force[2];
  for (int k = 0; k < 2; k++) {
    ck_assert_int_eq(zp_def_set(&def, key, value + (k ? by : -by), NULL), ZP_OK);
    force[k] = answered_value(ZP_STUDY_ISOMETRIC, &def, "force_N");
  }
  ck_near(rate, (force[1] - force[0]) / (2 * by), 6e-6);
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
