/* Checkpoints: a run that was cut and goes on from its file ends in the same bits as one that was not; what must not
 * go on is refused with the reason. */
#include "check_util.h"

#include <zipact/calibrate.h>
#include <zipact/io.h>

#include "actuator/model.h"

#define IMPLICIT                                                                                                       \
  {"solver.integrator", ZP_INTEGRATOR_IMPLICIT}, {                                                                     \
    "contact.model", ZP_CONTACT_UNILATERAL                                                                             \
  }
#define EXPLICIT                                                                                                       \
  {"solver.integrator", ZP_INTEGRATOR_EXPLICIT}, {                                                                     \
    "contact.model", ZP_CONTACT_SEQUENTIAL                                                                             \
  }
#define SQUARE                                                                                                         \
  {"drive.waveform", ZP_WAVEFORM_SQUARE}, {"drive.offset", 2e3}, {                                                     \
    "drive.rise_time", 5e-3                                                                                            \
  }

static const char path[] = "test_checkpoint.zps";

static void start_from(ZpActuatorDef *def, const char *file) {
  def->initial.state = ZP_INITIAL_CHECKPOINT;
  ck_assert_int_eq(zp_def_set_text(def, zp_key_find("initial.file"), file, NULL), ZP_OK);
}

static ZpResult *result_of(ZpStudy study, const ZpActuatorDef *def) {
  ZpResult *result = NULL;
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_data_study_run(study, def, NULL, &result, &err) == ZP_OK, "%s", err.message);
  ck_assert_ptr_nonnull(result->checkpoint);
  return result;
}

static void write_to(const char *name, const ZpCheckpoint *checkpoint) {
  FILE *file = fopen(name, "wb");
  ck_assert_ptr_nonnull(file);
  ck_assert_int_eq(zp_checkpoint_write(checkpoint, file, NULL), ZP_OK);
  ck_assert_int_eq(fclose(file), 0);
}

static double value_at_end(const ZpResult *result, const char *column) {
  return zp_table_get(result->series, result->series->rows - 1, column);
}

/* -- the same continuation ------------------------------------------------------------------------- */

/* Cut in free motion and inside a zip; a held force (Bezier, field), drag, corners of the voltage, one ribbon. */
static ZpActuatorDef def_of(int which, double *cut, double *end) {
  *cut = 33e-3;
  *end = 45e-3;
  switch (which) {
  case 0:
    return DEF(EXPLICIT, {"mesh.nodes", 21}, {"damping.drag", 0.1});
  case 1:
    return DEF(EXPLICIT, {"mesh.nodes", 21}, SQUARE);
  case 2:
    return DEF({"preset", ZP_PRESET_PAPER_CODE}, {"mesh.nodes", 21});
  case 3:
    return DEF(IMPLICIT, {"mesh.nodes", 21}, SQUARE, {"damping.internal", 1e-5});
  case 4:
    return DEF(IMPLICIT, {"mesh.nodes", 21}, {"solver.time_step", 0.7e-3});
  case 5:
    *cut = FULL_OR(30e-3, 8e-3);
    *end = FULL_OR(33e-3, 9e-3);
    return DEF(IMPLICIT, {"mesh.nodes", FULL_OR(21, 9)}, {"electro.model", ZP_ELECTRO_FIELD});
  default:
    return DEF(IMPLICIT, {"actuator.kind", ZP_KIND_RIBBON}, {"mesh.nodes", 21}, {"initial.state", ZP_INITIAL_STRAIGHT});
  }
}

START_TEST(test_goes_on_to_the_same_bits) {
  double cut, end;
  ZpActuatorDef def = def_of(_i, &cut, &end);
  def.solver.end_time = end;
  ZpResult *whole = result_of(ZP_STUDY_ACTUATE, &def);
  def.solver.end_time = cut;
  ZpResult *part = result_of(ZP_STUDY_ACTUATE, &def);
  write_to(path, part->checkpoint);
  double t = part->checkpoint->number[0];
  ck_assert(t < cut && t > 0.9 * cut);
  start_from(&def, path);
  def.solver.end_time = end;
  ZpResult *rest = result_of(ZP_STUDY_ACTUATE, &def);
  const ZpCheckpoint *a = whole->checkpoint, *b = rest->checkpoint;
  ck_assert_uint_eq(a->count, b->count);
  ck_assert_mem_eq(a->number, b->number, a->count * sizeof *a->number);
  ck_assert(a->number[0] > t);
  const char *columns[] = {"time_s", "stroke_m", "charge_C", "energy_imbalance_J", "electric_work_J"};
  for (size_t k = 0; k < LENGTH_OF(columns); k++)
    ck_assert_double_eq(value_at_end(whole, columns[k]), value_at_end(rest, columns[k]));
  ck_assert_double_eq(zp_table_get(rest->series, 0, "time_s"), t);
  ck_assert_double_eq(zp_result_get(rest, "simulated_time_s"), end - t);
  zp_result_destroy(whole);
  zp_result_destroy(part);
  zp_result_destroy(rest);
}
END_TEST

/* Closed, then let go: the voltage falls at the checkpoint's time and the run does not end as zipped once more. */
START_TEST(test_another_voltage) {
  ZpActuatorDef def = DEF(IMPLICIT, {"mesh.nodes", 21});
  ZpResult *zip = result_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_int_eq(zip->outcome, ZP_ZIPPED);
  double t = zip->checkpoint->number[0];
  ck_assert_double_eq(t, value_at_end(zip, "time_s")); /* closing cuts no step */
  write_to(path, zip->checkpoint);
  start_from(&def, path);
  def.solver.end_time = t + 30e-3;
  ZpResult *held = result_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_int_eq(held->outcome, ZP_REACHED_END);
  ck_assert_double_gt(value_at_end(held, "contraction"), 0.99);
  ck_assert_double_eq(zp_result_get(held, "zip_time_s"), zp_result_get(zip, "zip_time_s"));
  def.drive.voltage = 0;
  ZpResult *free_fall = result_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_double_eq(zp_table_get(free_fall->series, 0, "voltage_V"), 0);
  ck_assert_double_lt(value_at_end(free_fall, "contraction"), 0.9);
  ck_assert_double_lt(fabs(value_at_end(free_fall, "energy_imbalance_J")), 1e-3 * value_at_end(zip, "electric_work_J"));
  zp_result_destroy(zip);
  zp_result_destroy(held);
  zp_result_destroy(free_fall);
}
END_TEST

static bool stop_at_once(void *user, const char *stage, double fraction) {
  (void)user, (void)fraction;
  return strcmp(stage, "simulating") == 0;
}

/* An interrupted run and one out of steps leave a state that is sound and goes on. */
START_TEST(test_bad_ends) {
  ZpActuatorDef def = DEF(EXPLICIT, {"mesh.nodes", 21}, {"solver.end_time", 20e-3});
  ZpResult *whole = result_of(ZP_STUDY_ACTUATE, &def), *cut = NULL, *rest = NULL;
  ZpHooks hooks = {.progress = stop_at_once};
  if (_i == 0) {
    ck_assert_int_eq(zp_study_run(ZP_STUDY_ACTUATE, &def, NULL, &hooks, &cut, NULL), ZP_OK);
    ck_assert_int_eq(cut->outcome, ZP_INTERRUPTED);
  } else if (_i == 1) {
    def.solver.max_steps = 12345;
    cut = result_of(ZP_STUDY_ACTUATE, &def);
    ck_assert_int_eq(cut->outcome, ZP_STEP_LIMIT);
  }
  def.solver.max_steps = 1000000000;
  ck_assert_double_eq(cut->checkpoint->number[0], value_at_end(cut, "time_s"));
  write_to(path, cut->checkpoint);
  start_from(&def, path);
  rest = result_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_mem_eq(whole->checkpoint->number, rest->checkpoint->number, rest->checkpoint->count * sizeof(double));
  zp_result_destroy(whole);
  zp_result_destroy(cut);
  zp_result_destroy(rest);
}
END_TEST

/* A speed beyond all bounds: what is kept is the last state before it. */
START_TEST(test_diverged) {
  ZpActuatorDef def = DEF(EXPLICIT, {"mesh.nodes", 21}, {"solver.end_time", 20e-3});
  ZpModel *model = model_of(&def);
  ZpSim *sim = sim_of(model);
  ZpCheckpoint *before = NULL, *after = NULL;
  ck_assert_int_eq(zp_sim_run(sim, 5e-3, false, NULL, NULL), ZP_REACHED_END);
  ck_assert_int_eq(zp_sim_checkpoint(sim, &before, NULL), ZP_OK);
  size_t size = zp_sim_state_size(sim);
  ZpState *state = malloc(size);
  zp_sim_save(sim, state);
  zp_state_v(model, state)[10] = 1e5;
  ck_assert_int_eq(zp_sim_restore(sim, state, size, NULL), ZP_OK);
  ck_assert_int_eq(zp_sim_run(sim, 20e-3, false, NULL, NULL), ZP_DIVERGED);
  ck_assert_int_eq(zp_sim_checkpoint(sim, &after, NULL), ZP_OK);
  ck_assert_mem_eq(before->number, after->number, before->count * sizeof(double));
  free(state);
  zp_checkpoint_destroy(before);
  zp_checkpoint_destroy(after);
  zp_sim_destroy(sim);
  zp_model_destroy(model);
}
END_TEST

/* -- what must not go on --------------------------------------------------------------------------- */

/* A run of 1 ms in a file, and its bytes. */
static unsigned char *short_run(size_t *size) {
  ZpActuatorDef def = DEF(EXPLICIT, {"mesh.nodes", 5}, {"solver.end_time", 1e-3});
  ZpResult *result = result_of(ZP_STUDY_ACTUATE, &def);
  write_to(path, result->checkpoint);
  zp_result_destroy(result);
  FILE *file = fopen(path, "rb");
  unsigned char *byte = malloc(1 << 16);
  *size = fread(byte, 1, 1 << 16, file);
  fclose(file);
  ck_assert_uint_lt(*size, 1 << 16);
  return byte;
}

static void refused(const unsigned char *byte, size_t size, const char *reason) {
  ZpError err = {ZP_OK, ""};
  ZpCheckpoint *checkpoint;
  FILE *file = fopen(path, "wb");
  ck_assert_uint_eq(fwrite(byte, 1, size, file), size);
  fclose(file);
  ck_assert_int_eq(zp_checkpoint_read(path, &checkpoint, &err), ZP_BAD_INPUT);
  ck_assert_ptr_null(checkpoint);
  ck_assert_msg(strstr(err.message, path) && strstr(err.message, reason), "no '%s' in: %s", reason, err.message);
}

START_TEST(test_cut_short_at_every_byte) {
  size_t size;
  unsigned char *byte = short_run(&size);
  refused(byte, 0, "not a checkpoint");
  for (size_t cut = 1; cut < size; cut += FULL_OR(1, 13))
    refused(byte, cut, "cut short");
  free(byte);
}
END_TEST

START_TEST(test_every_byte_damaged) {
  size_t size;
  unsigned char *byte = short_run(&size);
  for (size_t i = 0; i < size; i += FULL_OR(1, 13)) {
    byte[i] ^= (unsigned char)(1 << i % 8);
    refused(byte, size, i < 8 ? "not a checkpoint" : i < 12 ? "version" : i >= 16 && i < 32 ? "" : "damaged");
    byte[i] ^= (unsigned char)(1 << i % 8);
  }
  byte[size] = 0;
  refused(byte, size + 1, "damaged");
  free(byte);
}
END_TEST

static void write_key(const char *key, double value, const ZpCheckpoint *like) {
  ZpCheckpoint *checkpoint = zp_checkpoint_create(like->count);
  checkpoint->def = like->def;
  memcpy(checkpoint->number, like->number, like->count * sizeof(double));
  ck_assert_int_eq(zp_def_set(&checkpoint->def, zp_key_find(key), value, NULL), ZP_OK);
  write_to(path, checkpoint);
  zp_checkpoint_destroy(checkpoint);
}

/* Every key that makes the actuator must be the same, every other may change. */
START_TEST(test_another_model) {
  ZpActuatorDef def = DEF(EXPLICIT, {"mesh.nodes", 5}, {"solver.end_time", 1e-3});
  ZpResult *result = result_of(ZP_STUDY_ACTUATE, &def);
  start_from(&def, path);
  def.solver.end_time = 2e-3;
  for (int i = 0; i < zp_key_count(); i++) {
    const ZpKey *key = zp_key(i);
    double value = zp_def_get(&def, i), other = value == key->max ? key->min : key->max;
    if (key->type == ZP_KEY_TEXT || key->offset == ZP_NO_FIELD) continue;
    write_key(key->name, other, result->checkpoint);
    ZpError err = {ZP_OK, ""};
    bool holds = zp_checkpoint_holds(i);
    ck_assert_msg(zp_data_check(ZP_STUDY_ACTUATE, &def, &err) == (holds ? ZP_BAD_INPUT : ZP_OK), "%s: %s", key->name,
                  err.message);
    ck_assert_msg(!holds || (strstr(err.message, "another model") && strstr(err.message, key->name)), "%s: %s",
                  key->name, err.message);
  }
  zp_result_destroy(result);
}
END_TEST

/* Numbers that no run leaves: by hand, the file is whole. */
START_TEST(test_no_state) {
  ZpActuatorDef def = DEF(EXPLICIT, {"mesh.nodes", 5}, {"solver.end_time", 1e-3});
  ZpResult *result = result_of(ZP_STUDY_ACTUATE, &def);
  ZpCheckpoint *checkpoint = result->checkpoint;
  start_from(&def, path);
  def.solver.end_time = 2e-3;
  for (size_t k = 0; k < checkpoint->count; k++) {
    ZpError err = {ZP_OK, ""};
    double kept = checkpoint->number[k];
    checkpoint->number[k] = 1e300;
    write_to(path, checkpoint);
    checkpoint->number[k] = kept;
    ZpResult *again = NULL;
    ZpStatus status = zp_data_study_run(ZP_STUDY_ACTUATE, &def, NULL, &again, &err);
    bool refuses = k == 0 || (k >= 20 && k < 24); /* a time beyond the end, words */
    ck_assert_msg(status == (refuses ? ZP_BAD_INPUT : ZP_OK), "%zu: %s", k, err.message);
    zp_result_destroy(again);
  }
  checkpoint->count--;
  write_to(path, checkpoint);
  ZpResult *again = NULL;
  ck_assert_int_eq(zp_data_study_run(ZP_STUDY_ACTUATE, &def, NULL, &again, NULL), ZP_BAD_INPUT);
  zp_result_destroy(result);
}
END_TEST

START_TEST(test_keys) {
  static const struct {
    const char *file;
    ZpInitialState state;
    ZpStudy study;
    double end;
    const char *named;
  } wrong[] = {
      {"", ZP_INITIAL_CHECKPOINT, ZP_STUDY_ACTUATE, 2e-3, "give initial.file"},
      {path, ZP_INITIAL_STRAIGHT, ZP_STUDY_ACTUATE, 2e-3, "initial.file: requires initial.state checkpoint"},
      {path, ZP_INITIAL_CHECKPOINT, ZP_STUDY_STATIONARY, 2e-3, "requires study actuate"},
      {"nowhere.zps", ZP_INITIAL_CHECKPOINT, ZP_STUDY_ACTUATE, 2e-3, "nowhere.zps: cannot be opened"},
      {path, ZP_INITIAL_CHECKPOINT, ZP_STUDY_ACTUATE, 0.5e-3, "solver.end_time is 0.0005 s"},
  };
  size_t size;
  free(short_run(&size));
  ZpActuatorDef def = DEF(EXPLICIT, {"mesh.nodes", 5});
  start_from(&def, wrong[_i].file);
  def.initial.state = wrong[_i].state;
  def.solver.end_time = wrong[_i].end;
  ZpError err = {ZP_OK, ""};
  ZpResult *result = NULL;
  ck_assert_int_eq(zp_data_study_run(wrong[_i].study, &def, NULL, &result, &err), ZP_BAD_INPUT);
  ck_assert_msg(strstr(err.message, wrong[_i].named) != NULL, "no '%s' in: %s", wrong[_i].named, err.message);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("checkpoint");
  TCase *same = tcase_create("continuation");
  tcase_add_loop_test(same, test_goes_on_to_the_same_bits, 0, 7);
  tcase_add_test(same, test_another_voltage);
  tcase_add_loop_test(same, test_bad_ends, 0, 2);
  tcase_add_test(same, test_diverged);
  suite_add_tcase(suite, same);
  TCase *refusals = tcase_create("refusals");
  tcase_add_test(refusals, test_cut_short_at_every_byte);
  tcase_add_test(refusals, test_every_byte_damaged);
  tcase_add_test(refusals, test_another_model);
  tcase_add_test(refusals, test_no_state);
  tcase_add_loop_test(refusals, test_keys, 0, 5);
  suite_add_tcase(suite, refusals);
  return run_suite(suite);
}
