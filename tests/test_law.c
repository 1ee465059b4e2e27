/* A law of a program's own, in one file: the damper of law/damper.c, of which nothing in src/ knows. With
 * DAMPER_OF_LIBRARY the library has it, and its key sets its coefficient (law_is_one_file.py).
 *
 * Against: the integral of c v^2 over samples of a run; the balance of energy; runs without it. */
#include "state_util.h"

#include "run/sensitivity.h"

static const double cold = 0.3; /* N s/m, on the load of the whole actuator */
#ifndef DAMPER_OF_LIBRARY
#define DAMPER_OF_PROGRAM cold
#include "law/damper.c"
#endif

/* -- runs ------------------------------------------------------------------------------------------ */

static const double end_time = 0.1, pause = 20e-6; /* s; between samples */

static ZpActuatorDef def_of(bool is_explicit, ZpSymmetry symmetry) {
  ZpActuatorDef def = DEF({"mesh.nodes", 11}, {"drive.voltage", 0}, {"solver.time_step", 10e-6},
                          {"liquid.model", ZP_LIQUID_NONE}, {"actuator.symmetry", symmetry});
  if (!is_explicit) return def;
  def.solver.integrator = ZP_INTEGRATOR_EXPLICIT;
  def.solver.time_step = 0.3e-6;
  return def;
}

typedef struct Run {
  ZpModel *model;
  ZpSim *sim;
  double integral, row, imbalance; /* of c v^2; the damper's loss; the largest imbalance over the load's work */
} Run;

/* A force pulls the load down from rest, so that it swings. */
static Run begin(const ZpActuatorDef *def, bool damped) {
  ZpActuatorDef with = *def;
#ifdef DAMPER_OF_LIBRARY
  with.load.damping = damped ? cold : 0;
#endif
  Run run = {.model = model_of(&with)};
#ifndef DAMPER_OF_LIBRARY
  if (damped) ck_assert(zp_model_add_term(run.model + run.model->members - 1, &zp_term_damper));
#endif
  run.sim = sim_of(run.model);
  ck_assert_int_eq(zp_sim_set_input(run.sim, ZP_INPUT_LOAD, 0.05, 0, NULL), ZP_OK);
  return run;
}

static double power(Run *run) {
  double v = zp_sim_get(run->sim, "end_velocity");
  return zp_sim_get(run->sim, "damper_coefficient") * v * v;
}

static void go_to(Run *run, double time) {
  ZpRunInfo info;
  ck_assert_msg(zp_outcome_good(zp_sim_run(run->sim, time, false, NULL, &info)), "%s", info.message);
}

/* The integral by Simpson's rule, two samples at a time. */
static void sample(Run *run) {
  double before = power(run), scale = 0;
  for (int k = 2; k <= (int)round(end_time / pause); k += 2) {
    go_to(run, (k - 1) * pause);
    double middle = power(run);
    go_to(run, k * pause);
    double now = power(run);
    run->integral += pause / 3 * (before + 4 * middle + now);
    before = now;
    scale = fmax(scale, fabs(zp_sim_get(run->sim, "load_work")));
    run->imbalance = fmax(run->imbalance, fabs(zp_sim_get(run->sim, "energy_imbalance")));
  }
  run->imbalance /= scale;
  run->row = zp_sim_get(run->sim, "damper_loss");
}

static const struct {
  const char *name;
  bool is_explicit;
  ZpSymmetry symmetry;
  Setting stack[2]; /* keys of it, and their values */
} cases[] = {{"half", false, ZP_SYMMETRY_HALF, {{0}}},
             {"whole", false, ZP_SYMMETRY_NONE, {{0}}},
             {"explicit steps", true, ZP_SYMMETRY_HALF, {{0}}},
             {"series", false, ZP_SYMMETRY_HALF, {{"stack.series", 2}}},
             {"parallel", false, ZP_SYMMETRY_HALF, {{"stack.parallel", 2}}},
             {"side by side", false, ZP_SYMMETRY_HALF, {{"stack.parallel", 2}, {"member_2.ribbon.thickness", 45e-6}}},
             {"antagonists", false, ZP_SYMMETRY_HALF, {{"stack.series", 2}, {"stack.distance", 60e-3}}}};

/* The row of the damper is the integral of c v^2, and the coefficient has grown. In implicit steps the energy balances
 * with it. */
TESTS(row_is_the_integral, 0, LENGTH_OF(cases)) {
  ZpActuatorDef def = def_of(cases[_i].is_explicit, cases[_i].symmetry);
  for (int k = 0; k < 2 && cases[_i].stack[k].key; k++)
    zp_def_set(&def, zp_key_find(cases[_i].stack[k].key), cases[_i].stack[k].value, NULL);
  lend_members(&def);
  Run run = begin(&def, true);
  sample(&run);
  printf("%s: row %.9g, integral %.9g, imbalance %.1e, coefficient %.3f\n", cases[_i].name, run.row, run.integral,
         run.imbalance, zp_sim_get(run.sim, "damper_coefficient"));
  ck_assert_double_gt(run.row, 1e-5);
  ck_near(run.row, run.integral, 1.1e-7); /* 3.5e-8 measured */
  ck_assert_double_gt(zp_sim_get(run.sim, "damper_coefficient"), 1.1 * cold);
  if (!cases[_i].is_explicit) ck_below(run.imbalance, 3.6e-10); /* 1.2e-10 measured */
}

/* The largest imbalance of explicit steps of this length. */
static double imbalance_with(bool damped, double time_step) {
  ZpActuatorDef def = def_of(true, ZP_SYMMETRY_HALF);
  def.solver.time_step = time_step;
  Run run = begin(&def, damped);
  double scale = 0;
  for (int k = 1; k <= 200; k++) {
    go_to(&run, k * 1e-4);
    scale = fmax(scale, fabs(zp_sim_get(run.sim, "load_work")));
    run.imbalance = fmax(run.imbalance, fabs(zp_sim_get(run.sim, "energy_imbalance")));
  }
  return run.imbalance / scale;
}

/* Explicit steps of half the length have half the imbalance, and the damper adds nothing to it. */
TEST(imbalance_is_of_first_order) {
  double without = imbalance_with(false, 0.2e-6), with = imbalance_with(true, 0.2e-6),
         half = imbalance_with(true, 0.1e-6);
  printf("imbalance without %.2e, with %.2e, in half steps %.2e\n", without, with, half);
  ck_below(with, 1.01 * without);
  ck_near(with / half, 2, 1.8e-5); /* 6e-6 measured */
}

/* The state, the row and the signal are part of a snapshot, and go on from it to the same bits; one of a model without
 * the damper is refused. */
TESTS(continues_from_a_snapshot, 0, 2) {
  ZpActuatorDef def = def_of(_i, ZP_SYMMETRY_HALF);
  Run run = begin(&def, true), bare = begin(&def, false);
  go_to(&run, 10e-3);
  size_t size = zp_sim_state_size(run.sim);
  unsigned char *bytes = memory_of(size);
  zp_sim_save(run.sim, bytes);
  ck_assert_int_eq(zp_sim_restore(bare.sim, bytes, size, NULL), ZP_BAD_INPUT);
  ck_continues(run.sim, run.model, 20e-3);
  ck_assert(!(zp_sim_get(bare.sim, "damper_loss") > 0));
}

static double signal_of(ZpSim *sim, const void *name) {
  return zp_sim_get(sim, name);
}

/* A loss of the damper in a run of 20 ms, with another mass of the load. */
static double lost_with(double mass, const char *signal) {
  ZpActuatorDef def = def_of(false, ZP_SYMMETRY_HALF);
  def.load.mass = mass;
  Run run = begin(&def, true);
  go_to(&run, 20e-3);
  return zp_sim_get(run.sim, signal);
}

/* Derivatives of a run follow the row and the state of the damper, too. */
TEST(derivatives_know_the_row) {
  static char signals[][24] = {"damper_loss", "damper_coefficient"};
  const int key = zp_key_find("load.mass");
  const double part = 1e-3;
  ZpActuatorDef def = def_of(false, ZP_SYMMETRY_HALF);
  Run run = begin(&def, true);
  ZpRunSensitivity rates;
  ck_assert_int_eq(zp_run_sensitivity_open(&rates, run.sim, &key, 1, NULL), ZP_OK);
  go_to(&run, 20e-3);
  for (size_t k = 0; k < LENGTH_OF(signals); k++) {
    double more = lost_with((1 + part) * def.load.mass, signals[k]),
           less = lost_with((1 - part) * def.load.mass, signals[k]);
    double rate = zp_run_rate_of(&rates, 0, signal_of, signals[k]);
    ck_near(rate, (more - less) / (2 * part * def.load.mass), 2.7e-6); /* 9e-7 measured */
  }
  zp_run_sensitivity_close(&rates);
}
