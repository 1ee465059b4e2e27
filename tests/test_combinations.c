/* Every kind, integrator, contact, mechanics, field and surface in every study and in a simulation, through the C API:
 * each combination runs or is refused by a sentence. Made to run under sanitizers: a Def that was fine for one study
 * led a simulation beyond its arrays, or to another law of contact without a word. */
#include "check_util.h"

#include <zipact/calibrate.h>

static const char *const loads = "combinations-loads.csv", *const times = "combinations-times.csv";

static void write_data(const char *name, const char *text) {
  FILE *file = fopen(name, "w");
  if (!file || fputs(text, file) < 0 || fclose(file) != 0) exit(1);
}

/* Stops a call when it is asked for the third time, under sanitizers for the first: what a solved field costs is not
 * the matter here. */
static bool stop_soon(void *user, const char *stage, double fraction) {
  (void)stage, (void)fraction;
  return ++*(int *)user >= FULL_OR(3, 1);
}

enum { KINDS = ZpActuatorKind_COUNT, STUDIES = ZpStudy_COUNT, OTHERS = 1 << 5, TIMES = STUDIES };

/* A coarse actuator of `kind`; the bits of `other` choose integrator, contact, mechanics, field and surface. One ribbon
 * has nodes enough that taking it for two goes beyond the padding of its arrays. */
static ZpActuatorDef combination(int kind, int other) {
  ZpActuatorDef def =
      DEF({"actuator.kind", kind}, {"mesh.nodes", kind ? 21 : 6}, {"ribbon.length", kind ? 45e-3 : 100e-3},
          {"load.mass", 2e-3}, {"damping.internal", NAN}, {"solver.end_time", 1e-3}, {"drive.voltage", 2e3},
          {"output.samples", 50}, {"output.shapes", 10}, {"cycle.most_cycles", 3});
  def.solver.integrator = other & 1 ? ZP_INTEGRATOR_EXPLICIT : ZP_INTEGRATOR_IMPLICIT;
  def.contact.model = other & 2 ? ZP_CONTACT_SEQUENTIAL : ZP_CONTACT_UNILATERAL;
  def.ribbon.model = other & 4 ? ZP_RIBBON_MASS_SPRING : ZP_RIBBON_ROD;
  def.electro.model = other & 8 ? ZP_ELECTRO_FIELD : ZP_ELECTRO_PLATES;
  def.electro.surface = other & 16 ? ZP_SURFACE_BEZIER : ZP_SURFACE_POLYLINE;
  def.electro.refresh_period = other & 16 ? 1e-4 : 0;
  if (kind == ZP_KIND_FLANGE) def.electro.gap_offset = 1e-3;
  return def;
}

static void name_of(const ZpActuatorDef *def, int study, char *text, size_t size) {
  static const char *const keys[] = {"actuator.kind", "solver.integrator", "contact.model",
                                     "ribbon.model",  "electro.model",     "electro.surface"};
  size_t at =
      (size_t)snprintf(text, size, "%s", study == TIMES ? "calibrate over time" : zp_study_name((ZpStudy)study));
  for (size_t k = 0; k < LENGTH_OF(keys); k++) {
    int key = zp_key_find(keys[k]);
    at += (size_t)snprintf(text + at, size - at, ", %s", zp_key(key)->choices[(int)zp_def_get(def, key)].word);
  }
}

static void check_refusal(ZpStatus status, const ZpError *err, const char *name) {
  ck_assert_msg(status == ZP_BAD_INPUT, "%s: status %d, %s", name, (int)status, err->message);
  ck_assert_msg(strchr(err->message, ' ') && strchr(err->message, '.'), "%s: no sentence: %s", name, err->message);
}

static void check_numbers(const double *value, size_t count, const char *name) {
  for (size_t i = 0; i < count; i++)
    ck_assert_msg(!isinf(value[i]), "%s: number %zu of %zu is infinite", name, i, count);
}

static void check_result(const ZpResult *result, const char *name) {
  ck_assert_msg(*result->message, "%s: no message", name);
  for (size_t i = 0; i < result->scalars; i++)
    ck_assert_msg(!isinf(result->scalar[i].value), "%s: %s is infinite", name, result->scalar[i].name);
  if (result->series) check_numbers(result->series->value, result->series->rows * result->series->columns, name);
  if (result->shapes) check_numbers(result->shapes->value, result->shapes->frames * result->shapes->frame_size, name);
}

START_TEST(every_combination_runs_or_is_refused) {
  int kind = _i / OTHERS, other = _i % OTHERS, ran = 0;
  ZpActuatorDef def = combination(kind, other);
  for (int study = 0; study <= TIMES; study++) {
    int asked = 0;
    ZpHooks hooks = {.user = &asked, .progress = def.electro.model == ZP_ELECTRO_FIELD ? stop_soon : NULL};
    ZpStudy asked_for = study == TIMES ? ZP_STUDY_CALIBRATE : (ZpStudy)study;
    def.drive.waveform = asked_for == ZP_STUDY_CYCLE ? ZP_WAVEFORM_SQUARE : ZP_WAVEFORM_STEP;
    def.drive.frequency = asked_for == ZP_STUDY_CYCLE ? 1e3 : 10;
    if (asked_for == ZP_STUDY_CALIBRATE)
      ck_assert_int_eq(zp_def_set_text(&def, zp_key_find("data.file"), study == TIMES ? times : loads, NULL), ZP_OK);
    char name[256];
    name_of(&def, study, name, sizeof name);
    ZpResult *result = NULL;
    ZpError err = {ZP_OK, ""};
    ZpStatus status = zp_data_study_run(asked_for, &def, &hooks, &result, &err);
    if (status == ZP_OK)
      check_result(result, name);
    else
      check_refusal(status, &err, name);
    ran += status == ZP_OK;
    zp_result_destroy(result);
  }
  bool no_cross_section = def.electro.model == ZP_ELECTRO_FIELD &&
                          (kind != ZP_KIND_ELECTRO_RIBBON || def.electro.surface == ZP_SURFACE_BEZIER);
  /* a fold is of rods, with faces in contact and a field along polylines */
  bool no_fold =
      kind == ZP_KIND_HINGE && (def.contact.model == ZP_CONTACT_SEQUENTIAL ||
                                def.ribbon.model == ZP_RIBBON_MASS_SPRING || def.electro.surface == ZP_SURFACE_BEZIER);
  ck_assert_int_eq(ran > 0, !no_cross_section && !no_fold);
}
END_TEST

/* (a simulation that was made) => a row of its signals after some steps, and after some more at another voltage. */
static void run_some(const ZpModel *model, ZpSim *sim, double *row, size_t signals, const char *name) {
  ZpRunInfo info;
  const double voltages[] = {zp_model_def(model)->drive.voltage, 0};
  for (size_t k = 0; k < LENGTH_OF(voltages); k++) {
    ck_assert_int_eq(zp_sim_set_voltage(sim, voltages[k], NULL), ZP_OK);
    ZpOutcome outcome = zp_sim_step(sim, 2e-4, NULL, &info);
    ck_assert_msg(outcome == ZP_REACHED_END || !zp_outcome_good(outcome), "%s: %s", name, info.message);
    zp_sim_read(sim, row + k * signals);
  }
  check_numbers(row, 2 * signals, name);
}

/* Make a simulation of `def` and run it; => is motion refused, by a sentence? */
static bool is_refused(const ZpActuatorDef *def, const char *name) {
  size_t signals;
  zp_signal_columns(&signals);
  double *row = calloc(2 * signals, sizeof *row);
  ZpModel *model = NULL;
  ZpSim *sim = NULL;
  ZpError err = {ZP_OK, ""};
  ZpStatus status = zp_model_create(def, &model, &err);
  if (status == ZP_OK) status = zp_sim_create(model, NULL, &sim, &err);
  if (status == ZP_OK)
    run_some(model, sim, row, signals, name);
  else
    check_refusal(status, &err, name);
  zp_sim_destroy(sim);
  zp_model_destroy(model);
  free(row);
  return status != ZP_OK;
}

/* A flange with explicit steps wrote beyond its arrays, and sequential contact with implicit steps ran, with another
 * contact, where the Def named a study that asks less than motion does. */
START_TEST(a_simulation_refuses_what_study_actuate_refuses) {
  ZpActuatorDef def = combination(_i / OTHERS, _i % OTHERS);
  char name[256];
  name_of(&def, ZP_STUDY_ACTUATE, name, sizeof name);
  bool refused = zp_study_check(ZP_STUDY_ACTUATE, &def, NULL) != ZP_OK;
  ck_assert_msg(is_refused(&def, name) == refused, "%s: the study %s it", name, refused ? "refuses" : "takes");
}
END_TEST

int main(void) {
  write_data(loads, "load_g,stroke_mm\n1,1\n2,2\n");
  write_data(times, "time_ms,stroke_mm\n0.5,1\n1,2\n");
  Suite *suite = suite_create("combinations");
  TCase *all = tcase_create("all");
  tcase_add_loop_test(all, a_simulation_refuses_what_study_actuate_refuses, 0, KINDS * OTHERS);
  suite_add_tcase(suite, all);
  tcase_add_loop_test(nightly_case(suite), every_combination_runs_or_is_refused, 0, KINDS * OTHERS);
  return run_suite(suite);
}
