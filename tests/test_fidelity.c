/* Preset paper-code against what the authors' own code gives when it is run again from its saved states, and
 * the constants of the paper's text against its numbers. The expected values are theirs, not ours. */
#include "check_util.h"

#include "paper/massspring.h"
#include "ribbon/section.h"

/* -- settled strokes ------------------------------------------------------------------------------- */

/* With K_S of their 61 g calibration, as for Table II. Measured: within 0.001 mm. */
typedef struct Stroke {
  int nodes;
  double shear, grams, mm;
} Stroke;

static const Stroke strokes[] = {
    {21, 6031, 40, 12.198},   {21, 6031, 60, 16.833},    {21, 6031, 80, 20.584},    {21, 6031, 100, 23.580},
    {21, 6031, 150, 28.738},  {21, 6031, 200, 31.890},   {61, 146115, 40, 12.261},  {61, 146115, 60, 16.827},
    {61, 146115, 80, 20.466}, {61, 146115, 100, 23.338}, {61, 146115, 150, 28.224}, {61, 146115, 200, 31.189},
};

TESTS(test_settled_stroke, 0, LENGTH_OF(strokes)) {
  const Stroke *s = &strokes[_i];
  ZpActuatorDef def = DEF({"preset", ZP_PRESET_PAPER_CODE}, {"mesh.nodes", s->nodes},
                          {"mass_spring.shear_coefficient", s->shear}, {"load.mass", 1e-3 * s->grams});
  double mm = 1e3 * settled_value(&def, "stroke");
  printf("N = %d, %g g: stroke %.4f mm, theirs %.3f\n", s->nodes, s->grams, mm, s->mm);
  ck_assert_double_eq_tol(mm, s->mm, 3e-3); /* 7.6e-4 measured */
}

/* -- zipping --------------------------------------------------------------------------------------- */

typedef struct Zip {
  double start, widest, widest_at, end; /* openings, m, and a time, s */
  double time;                          /* to complete, s */
} Zip;

static Zip zip_8g(double voltage, double drag) {
  ZpActuatorDef def =
      DEF({"preset", ZP_PRESET_PAPER_CODE}, {"mesh.nodes", 21}, {"drive.voltage", voltage}, {"damping.drag", drag});
  ZpSim *sim = sim_of(model_of(&def));
  size_t columns;
  const ZpColumn *column = zp_signal_columns(&columns);
  ZpTable *series = zp_table_create(column, columns, 10000);
  zp_sim_record(sim, series, NULL);
  ck_assert_int_eq(zp_sim_run(sim, 1, true, NULL, NULL), ZP_ZIPPED);
  Zip zip = {
      .start = zp_table_get(series, 0, "opening_m"), .end = zp_sim_get(sim, "opening"), .time = zp_sim_zip_time(sim)};
  for (size_t r = 0; r < series->rows; r++)
    if (zp_table_get(series, r, "opening_m") > zip.widest) {
      zip.widest = zp_table_get(series, r, "opening_m");
      zip.widest_at = zp_table_get(series, r, "time_s");
    }
  zp_table_destroy(series);
  printf("N = 21, 8 g, %g kV, c = %g: %.2f ms; opening %.3f -> %.3f mm at %.1f ms -> %.3f mm\n", 1e-3 * voltage, drag,
         1e3 * zip.time, 1e3 * zip.start, 1e3 * zip.widest, 1e3 * zip.widest_at, 1e3 * zip.end);
  return zip;
}

/* Theirs: 51.0 ms at 10 kV and 60.3 ms at 6 kV, from an opening of 5.97 mm to 1.68 mm, after a sag to 6.21 mm
 * at 14 ms. Measured: 46.8 and 56.8 ms, from 5.724 mm to 1.83 and 1.58 mm, after a sag to 5.82 mm at 12.9 ms and
 * 5.98 mm at 13.9 ms. The start is 4.1 % narrower: ours is the equilibrium at rest, theirs a saved state. */
TEST(test_zipping_10_kV) {
  Zip zip = zip_8g(10e3, 10);
  ck_near(zip.time, 51.0e-3, 0.1);
  ck_near(zip.start, 5.97e-3, 0.05);
  ck_assert_double_gt(zip.widest, zip.start + 0.05e-3); /* expansion before contraction */
  ck_near(zip.widest, 6.21e-3, 0.08);
  ck_near(zip.widest_at, 14e-3, 0.15);
  ck_near(zip.end, 1.68e-3, 0.1);
}

TEST(test_zipping_6_kV) {
  Zip zip = zip_8g(6e3, 10);
  ck_near(zip.time, 60.3e-3, 0.1); /* 0.058 measured */
  ck_assert_double_gt(zip.widest, zip.start + 0.1e-3);
  ck_near(zip.widest, 6.21e-3, 0.05);  /* 0.036 measured */
  ck_near(zip.widest_at, 14e-3, 0.05); /* 7e-3 measured */
}

/* The drag sets the time: 8.3, 17.7, 51, 160 ms. Measured 7.80, 16.03, 46.8, 145.6: 6 to 9.4 % less. */
TESTS(test_drag_sets_the_time, 0, 4) {
  static const double drag[] = {0.1, 1, 10, 100}, ms[] = {8.3, 17.7, 51, 160};
  ck_near(zip_8g(10e3, drag[_i]).time, 1e-3 * ms[_i], 0.1);
}

/* -- constants ------------------------------------------------------------------------------------- */

/* K_S that their calibration must find: the chain's exact linear factor, and the load that their half beam
 * lacked (M/4 where the finite elements had M):
 * K_S = E I / l^3 N (N+1) / (N-1)^2 (M g / 4 + q L / 2) / (M g + q L / 2), 100 um, 205 GPa, nu 0.28. */
static double calibrated(int nodes, double grams) {
  const ZpLayer steel = {100e-6, 205e9, 0.28, 7850};
  const double width = 12.7e-3, L = 45e-3, g = 9.81;
  ZpSection section = zp_section(&steel, 1, width, 1);
  double Mg = 1e-3 * grams * g, half_weight = section.mu * g * L / 2;
  return zp_massspring_shear_coefficient(section.EI, L / (nodes - 1), nodes) * (Mg / 4 + half_weight) /
         (Mg + half_weight);
}

/* Against the saved states (four digits) and, for 0 g, the value that theory and Table I (cut: 5.8e5) share.
 * Measured: within 0.35 % at 0 and 8 g, within 1.9 % at 61 g, which is no small deflection. */
typedef struct Calibrated {
  int nodes;
  double grams, shear, tolerance;
} Calibrated;

static const Calibrated calibrations[] = {
    {61, 0, 5.86e5, 2e-3}, {61, 8, 1.586e5, 2e-3},   {61, 61, 1.482e5, 2e-3}, {61, 61, 1.461e5, 0.02},
    {21, 8, 6434, 0.005},  {130, 8, 1.537e6, 0.003}, {21, 61, 6031, 0.005},   {130, 61, 1.408e6, 0.022},
};

TESTS(test_shear_coefficient_needs_no_tuning, 0, LENGTH_OF(calibrations)) {
  const Calibrated *c = &calibrations[_i];
  double theory = calibrated(c->nodes, c->grams);
  printf("K_S, N = %d, %g g: theory %.4g, calibrated %.4g, %+.2f %%\n", c->nodes, c->grams, theory, c->shear,
         100 * (theory / c->shear - 1));
  ck_near(theory, c->shear, c->tolerance); /* 0.019 measured where 0.022 is allowed */
}

/* Table I prints two digits, cut off. */
TEST(test_table_1) {
  static const double table[][3] = {{21, 0, 2.4e4},  {61, 0, 5.8e5},  {130, 0, 5.6e6}, {21, 8, 6.4e3},  {61, 8, 1.5e5},
                                    {130, 8, 1.5e6}, {21, 61, 6.0e3}, {61, 61, 1.4e5}, {130, 61, 1.4e6}};
  for (size_t i = 0; i < LENGTH_OF(table); i++) {
    double theory = calibrated((int)table[i][0], table[i][1]), digit = pow(10, floor(log10(table[i][2])) - 1);
    ck_assert_msg(theory > 0.99 * table[i][2] && theory < 1.01 * (table[i][2] + digit), "N = %g, %g g: %g", table[i][0],
                  table[i][1], theory);
  }
}

static double constant_of(ZpPreset preset, int nodes, const char *name) {
  ZpActuatorDef def = DEF({"preset", preset}, {"mesh.nodes", nodes});
  return zp_model_get(model_of(&def), name);
}

/* K_D of eq. (2), 50 um, and as the code ran it, 100 um: their printed digits. */
TEST(test_axial_spring) {
  static const int nodes[] = {21, 61, 130};
  static const double text[] = {56.44e6, 169.33e6, 364.07e6}, code[] = {282e3, 94e3, 44e3};
  for (int i = 0; i < 3; i++) {
    ck_assert_double_eq_tol(constant_of(ZP_PRESET_PAPER_TEXT, nodes[i], "axial_spring"), text[i],
                            0.0051e6); /* 4.4e3 measured */
    ck_assert_double_eq_tol(constant_of(ZP_PRESET_PAPER_CODE, nodes[i], "axial_spring"), code[i],
                            0.51e3); /* 2.4e2 measured */
  }
}

/* Eq. (2) requires a step below 0.44 us at N = 21; the quoted 5 us were possible only with the springs of the code. */
TEST(test_quoted_steps) {
  ck_below(constant_of(ZP_PRESET_PAPER_TEXT, 21, "stable_time_step"), 0.44e-6);
  static const int nodes[] = {21, 61, 130};
  static const double quoted[] = {5e-6, 1e-6, 0.5e-6};
  for (int i = 0; i < 3; i++)
    ck_assert_double_gt(constant_of(ZP_PRESET_PAPER_CODE, nodes[i], "stable_time_step"), quoted[i]);
}
