/* Lateral edges and leakage with a bead: the liquid's law where it is wet, that of air beyond. Against: one law where
 * all is wet or all is dry, sums of both between faces that stay parallel, relaxation of both parts in closed form,
 * derivatives of a step, energy over a zip, one half against both. */
#include "check_util.h"

#include "electro/leak.h"
#include "system/system.h"

/* -- faces that stay ------------------------------------------------------------------------------- */

enum { NODES = 9, PLACES = ZP_PLATES_PLACES * NODES };

typedef struct Faces {
  ZpModel *model;
  ZpEval eval; /* its plates: at the end of a step */
  double Z[PLACES], Z1[PLACES];
} Faces;

#define BEAD                                                                                                           \
  { "liquid.model", ZP_LIQUID_BEAD }

static void make_faces(ZpActuatorDef def, Faces *f) {
  def.mesh.nodes = NODES;
  f->model = model_of(&def);
  ck_assert(zp_system_create(f->model, false, &f->eval));
}

static void free_faces(Faces *f) {
  zp_system_destroy(&f->eval);
}

/* Parallel faces at a gap; with a bead, liquid as far as `reach` elements from the clip. */
static void lay(Faces *f, double gap, double reach) {
  for (size_t i = 0; i < NODES; i++) {
    f->eval.plates.gap[i] = f->eval.plates_start.gap[i] = gap;
    f->eval.plates.dx[i] = f->eval.plates_start.dx[i] = i + 1 < NODES ? f->model->l : 0;
  }
  zp_eval_cover(f->model, (const double[ZP_BEADS]){reach * f->model->l}, &f->eval);
}

static ZpPlatesTotals totals_of(Faces *f, double U) {
  return zp_plates_totals(&f->model->plates, &f->eval.plates, U);
}

/* Eq. (16.6): parallel faces of which a part is wet have a mean of the attraction, the charge and the capacitance per
 * length in liquid and in air, edges included. Where all is wet, or all is dry, they are those of one medium. */
TEST(parallel_faces_are_two_strips) {
  static const double gap = 1e-3, U = 4e3, share[] = {0, 0.5 / 8, 0.45, 1};
  ZpActuatorDef in_liquid = DEF({"electro.edges", 1}, {"platform.electrode", 0}), in_air = in_liquid;
  in_air.medium.permittivity = 1;
  in_air.medium.breakdown_field = in_air.air.breakdown_field;
  Faces bead = {0}, liquid = {0}, air = {0};
  make_faces(DEF({"electro.edges", 1}, {"platform.electrode", 0}, BEAD), &bead);
  make_faces(in_liquid, &liquid);
  make_faces(in_air, &air);
  lay(&liquid, gap, 0);
  lay(&air, gap, 0);
  ZpPlatesTotals wet = totals_of(&liquid, U), dry = totals_of(&air, U);
  ck_assert_double_gt(fabs(wet.charge / dry.charge - 1), 0.5);
  for (size_t k = 0; k < LENGTH_OF(share); k++) {
    double part = share[k], less = 1 - part, to_liquid = 1 / in_liquid.medium.permittivity;
    lay(&bead, gap, part * (NODES - 1));
    ZpPlatesTotals both = totals_of(&bead, U);
    ck_near(both.force, part * wet.force + less * dry.force, 1e-12);             /* 0 measured */
    ck_near(both.charge, part * wet.charge + less * dry.charge, 1e-12);          /* 2.2e-16 measured */
    ck_near(both.potential, part * wet.potential + less * dry.potential, 1e-12); /* 3.3e-16 measured */
    ck_near(both.inverse_gap, part * wet.inverse_gap + less * to_liquid * dry.inverse_gap,
            1e-12); /* 8.9e-16 measured */
  }
  free_faces(&bead);
  free_faces(&liquid);
  free_faces(&air);
}

/* A bead that fills all of the gap: equilibria with lateral edges are those of liquid everywhere. */
TEST(full_bead_is_liquid_everywhere) {
  static const char *const of[] = {"pull_in_voltage_V", "release_voltage_V", "max_load_kg"};
  ZpActuatorDef in_liquid = DEF({"electro.edges", 1}, {"mesh.nodes", 15}), with_bead = in_liquid;
  with_bead.liquid.model = ZP_LIQUID_BEAD;
  with_bead.bead.volume = 1e-3;
  ZpResult *full = answer_of(ZP_STUDY_LIMITS, &with_bead), *bath = answer_of(ZP_STUDY_LIMITS, &in_liquid);
  for (size_t k = 0; k < LENGTH_OF(of); k++)
    ck_near(zp_result_get(full, of[k]), zp_result_get(bath, of[k]), 1e-12); /* 2.0e-14 measured */
}

/* -- charge between the layers --------------------------------------------------------------------- */

static const double EPS_M = 2.75, EPS_I = 4.62, T = 130e-6, W = 12.7e-3, RHO_I = 3e10, RHO_M = 1e10;
#define LEAKS                                                                                                          \
  {"insulator.resistivity", RHO_I}, {                                                                                  \
    "medium.resistivity", RHO_M                                                                                        \
  }

/* Eqs. (25.2) and (25.5): U + Z a time t after the voltage has been switched on, in liquid or in air. */
static double across(double gap, double U, double t, bool wet) {
  double eps = wet ? EPS_M : 1, s = wet ? 1 / RHO_M : 0, a = 2 * T;
  double tau = ZP_EPS0 * (EPS_I * gap + eps * a) / (gap / RHO_I + s * a);
  double first = U * EPS_I / (EPS_I * gap + eps * a), last = U / RHO_I / (gap / RHO_I + s * a);
  return (last + (first - last) * exp(-t / tau)) * (gap + a * eps / EPS_I);
}

/* Charge per length of the liquid's or the air's faces. */
static double per_length(double gap, double Y, bool wet) {
  double eps = wet ? EPS_M : 1;
  return ZP_EPS0 * eps * W * Y / (gap + 2 * T * eps / EPS_I);
}

/* Parallel faces, wet up to a place of the sampled points: each part relaxes by its own law, for any step. A place that
 * the bead's end divides has one interface voltage, and the mean of both charges. */
TEST(wet_and_dry_part_relax_by_their_own_laws) {
  static const double gap = 300e-6, U = 200, h = 0.4;
  Faces f = {0};
  make_faces(DEF(BEAD, LEAKS, {"electro.breakdown_cap", 0}, {"platform.electrode", 0}), &f);
  const ZpModel *m = f.model;
  lay(&f, gap, 3 + 5.0 / 18);
  ZpLeakStep step = {&f.eval.plates_start, &f.eval.plates, U, U, h, f.Z};
  f.eval.leak.Z = f.Z1;
  zp_leak_step(&m->leak, &m->plates, &step, &f.eval.leak);
  const double Y[] = {across(gap, U, h, false), across(gap, U, h, true)};
  for (size_t k = 0; k < PLACES - ZP_PLATES_PLACES; k++) {
    bool wet = k <= 3 * ZP_PLATES_PLACES;
    if (k % ZP_PLATES_PLACES != 3) ck_near(U + f.Z1[k], Y[wet], 1e-12); /* 1.6e-15 measured */
  }
  ZpPlatesTotals all = zp_leak_totals(&m->leak, &m->plates, &f.eval.plates, U, f.Z1);
  double C = ZP_EPS0 * EPS_I * W / (2 * T), sum = 0;
  for (int wet = 0; wet < 2; wet++)
    sum += (wet ? 3 + 5.0 / 18 : 5 - 5.0 / 18) * m->l * (per_length(gap, Y[wet], wet) - C * (Y[wet] - U));
  ck_near(all.charge, sum, 1e-12); /* 2.6e-15 measured */
  lay(&f, gap, 2.4);               /* before any charge collects, within a place */
  all = zp_leak_totals(&m->leak, &m->plates, &f.eval.plates, U, f.Z);
  ck_near(all.charge, totals_of(&f, U).charge, 1e-12);
  ck_near(all.inverse_gap, totals_of(&f, U).inverse_gap, 1e-12);
  free_faces(&f);
}

/* Charges of electrodes at the end of a step, and what has passed. */
static double given(Faces *f, ZpLeakStep *step) {
  const ZpModel *m = f->model;
  zp_leak_step(&m->leak, &m->plates, step, &f->eval.leak);
  zp_leak_forces(&m->leak, &m->plates, step, &f->eval.leak, &f->eval.attraction);
  return zp_leak_totals(&m->leak, &m->plates, step->end, step->U1, f->Z1).charge + zp_leak_passed(&f->eval.leak);
}

/* Derivatives of a step by the voltage and the gaps at its end, where a bead ends within a place, at voltages without a
 * cap, with a cap of the air, and with caps of both. */
TESTS(derivatives_of_a_divided_place, 0, 3) {
  static const double voltage[] = {500, 3e3, 9e3};
  Faces f = {0};
  make_faces(DEF(BEAD, LEAKS), &f);
  const ZpModel *m = f.model;
  uint64_t seed = 3;
  lay(&f, 100e-6, 2.4);
  for (size_t k = 0; k < PLACES; k++)
    f.Z[k] = 100 * noise(&seed);
  f.eval.leak.Z = f.Z1;
  double *gap = f.eval.plates.gap, U = voltage[_i], dU = 1e-4 * U;
  for (size_t i = 0; i < NODES; i++)
    gap[i] *= 1.1 + 0.1 * noise(&seed);
  ZpLeakStep step = {&f.eval.plates_start, &f.eval.plates, 0.9 * U, U, 0.1, f.Z};
  given(&f, &step);
  zp_leak_by_voltage(&m->leak, &m->plates, &step, &f.eval.leak, &f.eval.by_voltage);
  double C = f.eval.by_voltage.capacitance, own[NODES], by_gap[NODES];
  for (size_t i = 0; i < NODES; i++) {
    own[i] = f.eval.attraction.own[i];
    by_gap[i] = f.eval.by_voltage.Qy[2 * i];
  }
  step.U1 = U + dU;
  double more = given(&f, &step);
  step.U1 = U - dU;
  ck_below(fabs((more - given(&f, &step)) / (2 * dU) - C), 6e-12 * more / U); /* 1.8e-12 measured */
  step.U1 = U;
  for (size_t i = 1; i + 1 < NODES; i++) {
    double g = gap[i], d = 1e-4 * g;
    gap[i] = g + d;
    more = given(&f, &step);
    double pull = f.eval.attraction.Fy[2 * i + 1];
    gap[i] = g - d;
    double less = given(&f, &step);
    ck_near((pull - f.eval.attraction.Fy[2 * i + 1]) / (2 * d), own[i], 1e-8); /* 4.0e-9 measured */
    ck_below(fabs((more - less) / (2 * d) - by_gap[i]) * g, 1.5e-10 * more);   /* 4.7e-11 measured */
    gap[i] = g;
  }
  free_faces(&f);
}

/* -- motion ---------------------------------------------------------------------------------------- */

/* Closing, holding and opening. With lateral edges; with charge between the layers, with and without suction. */
static const Setting with[][4] = {
    {{"electro.edges", 1}, {"bead.suction", 1}},
    {LEAKS, {"bead.suction", 0}},
    {{"medium.resistivity", 1e10}, {"bead.suction", 1}, {"bead.volume", 50e-9}},
    {{"medium.resistivity", 1e11}, {"bead.suction", 1}, {"electro.leak_share", 0.4}, {"electro.leak_ratio", 10}}};
enum { MOST = 10 };

static ZpActuatorDef moving(int k, int symmetry, double step) {
  Setting all[MOST] = {BEAD,
                       {"mesh.nodes", 11},
                       {"drive.waveform", ZP_WAVEFORM_SQUARE},
                       {"drive.frequency", 5},
                       {"actuator.symmetry", symmetry},
                       {"solver.time_step", step}};
  size_t count = 6;
  ZpActuatorDef def = {0};
  for (size_t i = 0; i < 4 && with[k][i].key && count < MOST; i++)
    all[count++] = with[k][i];
  ck_ok(resolve(&def, all, count, &err));
  return def;
}

/* A signal after a time. */
static double signal_after(const ZpActuatorDef *def, double time, const char *signal) {
  ZpSim *sim = sim_of(model_of(def));
  ck_assert_int_eq(zp_sim_run(sim, time, false, NULL, NULL), ZP_REACHED_END);
  return zp_sim_get(sim, signal);
}

TESTS(energy_balances, 0, 4) {
  ZpActuatorDef def = moving(_i, ZP_SYMMETRY_HALF, NAN);
  ZpSim *sim = sim_of(model_of(&def));
  double worst = 0, closest = 0;
  for (int k = 1; k <= 20; k++) {
    ck_assert_int_eq(zp_sim_run(sim, 0.01 * k, false, NULL, NULL), ZP_REACHED_END);
    worst = fmax(worst, fabs(zp_sim_get(sim, "energy_imbalance")));
    closest = fmax(closest, zp_sim_get(sim, "contraction"));
  }
  worst /= zp_sim_get(sim, "electric_work");
  printf("%d: closest %.3f, energy off by %.1e of the work\n", _i, closest, worst);
  ck_assert_double_gt(closest, 0.8);
  ck_below(worst, 6e-8); /* 2.2e-8 measured */
}

/* Full suction takes what moving menisci release, and it pulls with the charge between the layers, too, of faces that
 * are alike and of patches: what is left is the error of the steps. */
TESTS(menisci_are_drawn_by_the_charge, 0, 2) {
  double lost[2];
  for (int suction = 0; suction < 2; suction++) {
    ZpActuatorDef def =
        DEF(BEAD, {"mesh.nodes", 11}, {"bead.volume", 50e-9}, {"medium.resistivity", 1e9}, {"bead.suction", suction},
            {"drive.voltage", 10e3}, {"solver.tolerance", 7e-5}, {"liquid.inertia", 0},
            {"electro.leak_share", _i ? 0.4 : 0}, {"electro.leak_ratio", _i ? 5 : NAN});
    lost[suction] = signal_after(&def, 0.1, "meniscus_loss");
  }
  printf("lost by menisci: %.4f mJ, with suction %.5f mJ\n", 1e3 * lost[0], 1e3 * lost[1]);
  ck_below(fabs(lost[1]), 0.05 * lost[0]); /* 0.022 measured */
}

TESTS(whole_is_two_halves, 0, 3) {
  static const char *const signals[] = {"opening", "charge", "meniscus_loss", "wet_length"};
  ZpModel *models[2];
  ZpSim *sims[2];
  for (int k = 0; k < 2; k++) {
    ZpActuatorDef def = moving(_i, k ? ZP_SYMMETRY_NONE : ZP_SYMMETRY_HALF, 2.5e-4);
    models[k] = model_of(&def);
    sims[k] = sim_of(models[k]);
    ck_assert_int_eq(zp_sim_run(sims[k], 0.12, false, NULL, NULL), ZP_REACHED_END);
  }
  ck_same_signals(sims, models, signals, LENGTH_OF(signals), 1.2e-10); /* 4.1e-11 measured */
}
