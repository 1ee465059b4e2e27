/* Checkpoints: a run that was cut and resumes from its file ends in the same bits as one that was not; what must
 * not resume is refused with the reason. */
#include "data_util.h"
#include "state_util.h"

#include "base/pack.h"
#include "run/snapshot.h"

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
  ZpResult *result = data_study_of(study, def);
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
  case 6:
    return DEF(IMPLICIT, {"mesh.nodes", 21}, {"ribbon.plasticity", true}, {"ribbon.yield_stress", 60e6}, SQUARE);
  case 7:
    return DEF(IMPLICIT, {"mesh.nodes", 21}, {"load.change_time", 20e-3}, {"load.change_mass", 4e-3},
               {"load.drop_height", 5e-3});
  case 8:
    return DEF(IMPLICIT, {"mesh.nodes", 21}, {"load.change_time", 40e-3}, {"load.change_mass", -4e-3});
  default:
    return DEF(IMPLICIT, {"actuator.kind", ZP_KIND_RIBBON}, {"mesh.nodes", 21}, {"initial.state", ZP_INITIAL_STRAIGHT});
  }
}

TESTS(test_goes_on_to_the_same_bits, 0, 10) {
  double cut, end;
  ZpActuatorDef def = def_of(_i, &cut, &end);
  def.solver.end_time = end;
  ZpResult *whole = result_of(ZP_STUDY_ACTUATE, &def);
  def.solver.end_time = cut;
  ZpResult *part = result_of(ZP_STUDY_ACTUATE, &def);
  write_to(path, part->checkpoint);
  double t = zp_checkpoint_time(part->checkpoint);
  ck_assert(t < cut && t > 0.9 * cut);
  start_from(&def, path);
  def.solver.end_time = end;
  ZpResult *rest = result_of(ZP_STUDY_ACTUATE, &def);
  const ZpCheckpoint *a = whole->checkpoint, *b = rest->checkpoint;
  ck_assert_uint_eq(a->size, b->size);
  ck_assert_mem_eq(a->byte, b->byte, a->size);
  ck_assert(zp_checkpoint_time(a) > t);
  const char *columns[] = {"time_s", "stroke_m", "charge_C", "energy_imbalance_J", "electric_work_J"};
  for (size_t k = 0; k < LENGTH_OF(columns); k++)
    ck_assert_double_eq(value_at_end(whole, columns[k]), value_at_end(rest, columns[k]));
  ck_assert_double_eq(zp_table_get(rest->series, 0, "time_s"), t);
  ck_assert_double_eq(zp_result_get(rest, "simulated_time_s"), end - t);
}

/* Closed, then released: the voltage falls at the checkpoint's time and the run does not end by closing once more. */
TEST(test_another_voltage) {
  ZpActuatorDef def = DEF(IMPLICIT, {"mesh.nodes", 21});
  ZpResult *zip = result_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_int_eq(zip->outcome, ZP_ZIPPED);
  double t = zp_checkpoint_time(zip->checkpoint);
  ck_assert_double_eq(t, value_at_end(zip, "time_s")); /* closing cuts no step */
  write_to(path, zip->checkpoint);
  start_from(&def, path);
  def.solver.end_time = t + 30e-3;
  ZpResult *held = result_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_int_eq(held->outcome, ZP_ZIPPED);
  ck_near(zp_result_get(held, "simulated_time_s"), 30e-3, 1e-12);
  ck_assert_double_gt(value_at_end(held, "contraction"), 0.99);
  ck_assert_double_eq(zp_result_get(held, "zip_time_s"), zp_result_get(zip, "zip_time_s"));
  def.drive.voltage = 0;
  ZpResult *free_fall = result_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_double_eq(zp_table_get(free_fall->series, 0, "voltage_V"), 0);
  ck_assert_int_eq(free_fall->outcome, ZP_REOPENED);
  ck_assert_double_lt(value_at_end(free_fall, "contraction"), 0.9);
  /* 6.8e-10 measured */
  ck_below(fabs(value_at_end(free_fall, "energy_imbalance_J")), 5e-9 * value_at_end(zip, "electric_work_J"));
}

/* A force that the program applies is lifted like a load; work and efficiency are those since the run resumed. */
TEST(test_work_since_then) {
  const double force = 0.02, mass = 10e-3;
  ZpActuatorDef def = DEF(IMPLICIT, {"mesh.nodes", 21}, {"load.mass", mass});
  ZpSim *sim = sim_of(model_of(&def));
  ZpCheckpoint *checkpoint;
  ck_assert_int_eq(zp_sim_set_input(sim, ZP_INPUT_LOAD, force, 0, NULL), ZP_OK);
  ck_assert_int_eq(zp_sim_run(sim, 60e-3, false, NULL, NULL), ZP_REACHED_END);
  ck_assert_int_eq(zp_sim_checkpoint(sim, &checkpoint, NULL), ZP_OK);
  ck_assert_int_eq(zp_sim_restore(sim, checkpoint->byte, checkpoint->size, NULL),
                   ZP_OK); /* before the step that was cut */
  double supplied = zp_sim_get(sim, "source_energy");
  write_to(path, checkpoint);
  start_from(&def, path);
  ZpResult *rest = result_of(ZP_STUDY_ACTUATE, &def);
  double risen = zp_result_get(rest, "start_opening_m") - zp_result_get(rest, "opening_m"),
         work = (mass * def.gravity + force) * risen;
  ck_assert(risen > 1e-3 && supplied > 0);
  ck_near(zp_result_get(rest, "mechanical_work_J"), work, 1e-12);
  ck_near(zp_result_get(rest, "efficiency"), work / (zp_result_get(rest, "source_energy_J") - supplied), 1e-12);
  zp_checkpoint_destroy(checkpoint);
}

static bool stop_at_once(void *user, const char *stage, double fraction) {
  (void)user, (void)fraction;
  return strcmp(stage, "simulating") == 0;
}

/* An interrupted run and one out of steps leave a state that is sound and can be resumed. */
TESTS(test_bad_ends, 0, 2) {
  ZpActuatorDef def = DEF(EXPLICIT, {"mesh.nodes", 21}, {"solver.end_time", 20e-3});
  ZpResult *whole = result_of(ZP_STUDY_ACTUATE, &def), *cut = NULL, *rest = NULL;
  ZpHooks hooks = {.progress = stop_at_once};
  if (_i == 0) {
    ck_assert_int_eq(zp_study_run(ZP_STUDY_ACTUATE, &def, NULL, &hooks, &cut, NULL), ZP_OK);
    zp_test_owns(cut, destroy_result);
    ck_assert_int_eq(cut->outcome, ZP_INTERRUPTED);
  } else if (_i == 1) {
    def.solver.max_steps = 12345;
    cut = result_of(ZP_STUDY_ACTUATE, &def);
    ck_assert_int_eq(cut->outcome, ZP_STEP_LIMIT);
  }
  def.solver.max_steps = 1000000000;
  ck_assert_double_eq(zp_checkpoint_time(cut->checkpoint), value_at_end(cut, "time_s"));
  write_to(path, cut->checkpoint);
  start_from(&def, path);
  rest = result_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_mem_eq(whole->checkpoint->byte, rest->checkpoint->byte, rest->checkpoint->size);
}

/* A speed beyond all bounds: what is kept is the last state before it. */
TEST(test_diverged) {
  ZpActuatorDef def = DEF(EXPLICIT, {"mesh.nodes", 21}, {"solver.end_time", 20e-3});
  ZpModel *model = model_of(&def);
  ZpSim *sim = sim_of(model);
  ZpCheckpoint *before = NULL, *after = NULL;
  ck_assert_int_eq(zp_sim_run(sim, 5e-3, false, NULL, NULL), ZP_REACHED_END);
  ck_assert_int_eq(zp_sim_checkpoint(sim, &before, NULL), ZP_OK);
  ZpState *state = memory_of(zp_state_size(model));
  copy_state(sim, state);
  zp_state_v(model, state)[10] = 1e5;
  put_state(sim, state);
  ck_assert_int_eq(zp_sim_run(sim, 20e-3, false, NULL, NULL), ZP_DIVERGED);
  ck_assert_int_eq(zp_sim_checkpoint(sim, &after, NULL), ZP_OK);
  ck_assert_mem_eq(before->byte, after->byte, before->size);
  zp_checkpoint_destroy(before);
  zp_checkpoint_destroy(after);
}

/* -- what must not resume -------------------------------------------------------------------------- */

/* A run of 1 ms in a file, and its bytes. */
static unsigned char *short_run(size_t *size) {
  ZpActuatorDef def = DEF(EXPLICIT, {"mesh.nodes", 5}, {"solver.end_time", 1e-3});
  ZpResult *result = result_of(ZP_STUDY_ACTUATE, &def);
  write_to(path, result->checkpoint);
  FILE *file = fopen(path, "rb");
  unsigned char *byte = memory_of(1 << 16);
  *size = fread(byte, 1, 1 << 16, file);
  fclose(file);
  ck_assert_uint_lt(*size, 1 << 16);
  return byte;
}

static void refused_as_file(const unsigned char *byte, size_t size, const char *reason) {
  ZpError err = {ZP_OK, ""};
  ZpCheckpoint *checkpoint;
  FILE *file = fopen(path, "wb");
  ck_assert_uint_eq(fwrite(byte, 1, size, file), size);
  fclose(file);
  ck_assert_int_eq(zp_checkpoint_read(path, &checkpoint, &err), ZP_BAD_INPUT);
  ck_assert_ptr_null(checkpoint);
  ck_assert_msg(strstr(err.message, path) && strstr(err.message, reason), "no '%s' in: %s", reason, err.message);
}

/* As bytes, and at some places, which take longer, as a file. */
static void refused(const unsigned char *byte, size_t size, size_t place, const char *reason) {
  ZpError err = {ZP_OK, ""};
  ZpCheckpoint *checkpoint;
  ck_assert_int_eq(zp_checkpoint_from(byte, size, &checkpoint, &err), ZP_BAD_INPUT);
  ck_assert_ptr_null(checkpoint);
  ck_assert_msg(strstr(err.message, reason), "no '%s' in: %s", reason, err.message);
  if (place < 32 || place % 97 == 0) refused_as_file(byte, size, reason);
}

TEST(test_cut_short_at_every_byte) {
  size_t size;
  unsigned char *byte = short_run(&size);
  refused(byte, 0, 0, "not a snapshot");
  for (size_t cut = 1; cut < size; cut++)
    refused(byte, cut, cut, "cut short");
}

TEST(test_every_byte_damaged) {
  size_t size;
  unsigned char *byte = short_run(&size);
  for (size_t i = 0; i < size; i++) {
    byte[i] ^= (unsigned char)(1 << i % 8);
    refused(byte, size, i, i < 8 ? "not a snapshot" : i < 12 ? "version" : i >= 16 && i < 24 ? "" : "damaged");
    byte[i] ^= (unsigned char)(1 << i % 8);
  }
  byte[size] = 0;
  refused(byte, size + 1, 0, "damaged");
}

/* Every key that makes the actuator must be the same, every other may change; a saved state and a file alike. */
TEST(test_another_model) {
  ZpActuatorDef def = DEF(EXPLICIT, {"mesh.nodes", 5}, {"solver.end_time", 1e-3});
  ZpModel *model = model_of(&def), *changed = model_of(&def);
  ZpSim *sim = sim_of(model), *other = sim_of(changed);
  unsigned char *saved = memory_of(1 << 16), *before = memory_of(1 << 16), *after = memory_of(1 << 16);
  for (int i = 0; i < zp_key_count(); i++) {
    const ZpKey *key = zp_key(i);
    double value = zp_def_get(&def, i), its = value == key->max ? key->min : key->max;
    if (key->type == ZP_KEY_TEXT || !zp_key_in_def(i)) continue;
    changed->def = def;
    ck_assert_int_eq(zp_def_set(&changed->def, i, its, NULL), ZP_OK);
    size_t size = zp_sim_state_size(other);
    zp_sim_save(other, saved);
    zp_sim_save(sim, before);
    ZpError err = {ZP_OK, ""};
    bool holds = zp_checkpoint_holds(i);
    ck_assert_msg(zp_sim_restore(sim, saved, size, &err) == (holds ? ZP_BAD_INPUT : ZP_OK), "%s: %s", key->name,
                  err.message);
    ck_assert_msg(!holds || (strstr(err.message, "another model") && strstr(err.message, key->name)), "%s: %s",
                  key->name, err.message);
    zp_sim_save(sim, after);
    ck_assert_mem_eq(before, after, zp_sim_state_size(sim));
  }
}

/* A later segment alone is another; of both ribbons. */
TESTS(test_another_segment, 0, 2) {
  static const char *const name[] = {"segment_2.length", "lower.segment_2.length"};
  ZpActuatorDef def = DEF(EXPLICIT, {"mesh.nodes", 5}, {"solver.end_time", 1e-3});
  ZpModel *model = model_of(&def), *changed = model_of(&def);
  ZpSim *sim = sim_of(model), *other = sim_of(changed);
  unsigned char *saved = memory_of(1 << 16);
  ZpError err;
  for (int i = 0; i < 2; i++)
    ck_assert_int_eq(zp_def_set(i ? &changed->def : &model->def, zp_key_find("segment_1.length"), 5e-3, NULL), ZP_OK);
  ck_assert_int_eq(zp_def_set(&model->def, zp_key_find(name[_i]), 6e-3, NULL), ZP_OK);
  ck_assert_int_eq(zp_def_set(&changed->def, zp_key_find(name[_i]), 7e-3, NULL), ZP_OK);
  zp_sim_save(other, saved);
  ck_assert_int_eq(zp_sim_restore(sim, saved, zp_sim_state_size(other), &err), ZP_BAD_INPUT);
  ck_assert_ptr_nonnull(strstr(err.message, name[_i]));
}

/* CRC-32 as its definition says, bit by bit. */
static uint32_t crc_of(const unsigned char *byte, size_t size) {
  uint32_t sum = 0xFFFFFFFFu;
  for (size_t i = 0; i < size; i++) {
    sum ^= byte[i];
    for (int bit = 0; bit < 8; bit++)
      sum = sum >> 1 ^ (sum & 1 ? 0xEDB88320u : 0);
  }
  return ~sum;
}

/* Make the checksum right again, as one would who forges a file. */
static void forge(unsigned char *byte, size_t size) {
  uint32_t sum = crc_of(byte + 16, size - 16);
  for (int k = 0; k < 4; k++)
    byte[12 + k] = (unsigned char)(sum >> (8 * k));
}

/* The items of field number `k`, and its name; NULL if there are fewer. */
static unsigned char *nth_field(unsigned char *byte, size_t size, size_t k, char name[256]) {
  for (size_t i = 32; i < size; k--) {
    const size_t length = byte[i], width = strchr("NR", byte[i + 1 + length]) ? 8 : 1;
    unsigned char *item = byte + i + 10 + length;
    if (k == 0) snprintf(name, 256, "%.*s", (int)length, (const char *)byte + i + 1);
    if (k == 0) return item;
    i += 10 + length + width * (item[-8] + 256u * item[-7]);
  }
  return NULL;
}

static unsigned char *field_called(unsigned char *byte, size_t size, const char *wanted) {
  char name[256];
  unsigned char *item;
  for (size_t k = 0; (item = nth_field(byte, size, k, name)); k++)
    if (strcmp(name, wanted) == 0) return item;
  ck_abort_msg("no field %s", wanted);
  return NULL;
}

/* Numbers that no run leaves: by hand, the file is whole. */
TEST(test_no_state) {
  static const struct {
    const char *field;
    double value;
    bool refused;
  } wrong[] = {
      {"t", NAN, true},
      {"t", -1, true},
      {"t", 1e300, true},
      {"U", 1e300, true},
      {"U", NAN, true},
      {"U", -1, false},
      {"zip.front", 1e300, true},
      {"supply_mode", 0.5, true},
      {"zip_time", 0.5, true},
      {"zip_time", NAN, false},
      {"closed_from", -1, true},
      {"closed_from", 1e300, true},
      {"still.least", NAN, true},
      {"still.most", 0.5, false},
      {"work", INFINITY, true},
      {"work", -1, false},
      {"last_step", -1, true},
      {"last_step", 0.5, false},
      {"U_rate", 1e300, true},
      {"load_input.until", NAN, true},
      {"load_input.until", INFINITY, false},
      {"control.measured", NAN, false},
      {"control.taken", -1, true},
      {"held_U", 1e300, true},
  };
  ZpActuatorDef def = DEF(EXPLICIT, {"mesh.nodes", 5}, {"solver.end_time", 1e-3});
  size_t size;
  unsigned char *byte = short_run(&size);
  start_from(&def, path);
  def.solver.end_time = 2e-3;
  for (size_t k = 0; k < LENGTH_OF(wrong); k++) {
    ZpError err = {ZP_OK, ""};
    ZpCheckpoint *checkpoint;
    unsigned char kept[8], *number = field_called(byte, size, wrong[k].field);
    memcpy(kept, number, 8);
    memcpy(number, &wrong[k].value, 8); /* the tests' machines are little-endian */
    forge(byte, size);
    ck_assert_int_eq(zp_checkpoint_from(byte, size, &checkpoint, NULL), ZP_OK);
    memcpy(number, kept, 8);
    ZpStatus status = zp_checkpoint_check(checkpoint, &def, &err);
    ck_assert_msg(status == (wrong[k].refused ? ZP_BAD_INPUT : ZP_OK), "%s = %g: %s", wrong[k].field, wrong[k].value,
                  err.message);
    zp_checkpoint_destroy(checkpoint);
  }
}

/* Whatever byte is forged, with the right checksum: refused or taken, never a crash, and what is taken can run. */
TEST(test_forged_bytes) {
  ZpActuatorDef def = DEF(EXPLICIT, {"mesh.nodes", 5}, {"solver.end_time", 1e-3});
  ZpSim *sim = sim_of(model_of(&def));
  size_t size;
  unsigned char *byte = short_run(&size);
  for (size_t i = 16; i < size; i += 5) {
    unsigned char kept = byte[i];
    byte[i] = (unsigned char)(kept ^ (i % 3 == 0 ? 0xFF : 1 << i % 8));
    forge(byte, size);
    if (zp_sim_restore(sim, byte, size, NULL) == ZP_OK) zp_sim_step(sim, 1e-6, NULL, NULL);
    byte[i] = kept;
  }
}

/* Actuators that use the numbers of a state in different ways. */
static ZpActuatorDef user_of_numbers(int which) {
  switch (which) {
  case 0:
    return DEF({"mesh.nodes", 9}, {"liquid.model", ZP_LIQUID_NONE}, {"control.kind", ZP_CONTROL_PI},
               {"control.proportional", 1e6}, {"control.period", 1e-3}, {"control.delay", 3e-3},
               {"control.noise", 1e-6}, {"setpoint.value", 10e-3});
  case 1:
    return DEF({"mesh.nodes", 9}, {"source.model", ZP_SOURCE_AMPLIFIER}, {"source.slew_rate", 1e6},
               {"source.current_limit", 1e-3}, {"source.capacitance", 1e-10});
  case 2:
    return DEF({"mesh.nodes", 9}, {"liquid.model", ZP_LIQUID_NONE}, {"insulator.resistivity", 1e12},
               {"ribbon.plasticity", true}, {"load.change_time", 1e-4}, {"load.change_mass", 1e-3});
  case 3:
    return DEF({"mesh.nodes", 9}, {"liquid.model", ZP_LIQUID_NONE}, {"stack.series", 2});
  default:
    return DEF({"preset", ZP_PRESET_PAPER_TEXT}, {"mesh.nodes", 21});
  }
}

/* Every number of the state by values that no run leaves, with the right checksum: refused, or taken and then steps
 * advance. An index from it that is out of bounds stops the sanitizers. */
TESTS(test_forged_numbers, 0, 5) {
  static const double wrong[] = {-1, 0.5, 3, 1e18, 1e-300, 1e300, -1e300, INFINITY, NAN};
  ZpActuatorDef def = user_of_numbers(_i);
  ZpModel *model = model_of(&def);
  ZpSim *sim = sim_of(model);
  zp_sim_run(sim, 2.5e-3, false, NULL, NULL);
  model->def.solver.max_steps = 2000; /* of 20 us each time */
  size_t size = zp_sim_state_size(sim), own = size / model->members;
  unsigned char *byte = memory_of(size);
  zp_sim_save(sim, byte);
  unsigned char *item;
  char name[256];
  for (size_t k = 0; (item = nth_field(byte, own, k, name)) && zp_key_find(name) < 0; k++)
    for (size_t w = 0; w < LENGTH_OF(wrong); w++) {
      unsigned char kept[8];
      const size_t width = strchr("NR", item[-9]) ? 8 : 1;
      memcpy(kept, item, width);
      memcpy(item, &wrong[w], width); /* the tests' machines are little-endian */
      forge(byte, own);
      if (zp_sim_restore(sim, byte, size, NULL) == ZP_OK)
        for (int step = 0; step < 2; step++)
          ck_assert_msg(zp_sim_step(sim, 2e-5, NULL, NULL) != ZP_STEP_LIMIT, "%s = %g", name, wrong[w]);
      memcpy(item, kept, width);
    }
}

/* A controller's samples and outputs so far index the outputs that are pending: -1, and what does not fit the time. */
TEST(test_forged_samples) {
  static const double wrong[] = {-1, 0, 1.5, 2, 4, 1e9, INFINITY, NAN};
  static const char *const name[] = {"control.taken", "control.given"};
  ZpActuatorDef def = user_of_numbers(0);
  ZpSim *sim = sim_of(model_of(&def));
  zp_sim_run(sim, 2.5e-3, false, NULL, NULL); /* samples at 0, 1 and 2 ms; the first output is due at 3 ms */
  size_t size = zp_sim_state_size(sim);
  unsigned char *byte = memory_of(size);
  for (size_t k = 0; k < LENGTH_OF(name); k++)
    for (size_t w = 0; w < LENGTH_OF(wrong); w++) {
      ZpError err;
      zp_sim_save(sim, byte);
      memcpy(field_called(byte, size, name[k]), &wrong[w], 8);
      forge(byte, size);
      bool fits = k == 1 && wrong[w] >= 0 && wrong[w] <= 3 && wrong[w] == floor(wrong[w]);
      ck_assert_msg(zp_sim_restore(sim, byte, size, &err) == (fits ? ZP_OK : ZP_BAD_INPUT), "%s = %g", name[k],
                    wrong[w]);
      ck_assert(fits || strstr(err.message, "do not fit its time") ||
                strstr(err.message, "not a state of an actuator"));
      if (fits) zp_sim_run(sim, zp_sim_get(sim, "time") + 1e-6, false, NULL, NULL);
    }
}

/* A saved state that is cut short at any byte or damaged at any was taken if only its length was right. Now it is
 * refused and the simulation stays where it is. */
TEST(test_damaged_state_changes_nothing) {
  ZpActuatorDef def = DEF(EXPLICIT, {"mesh.nodes", 5});
  ZpSim *sim = sim_of(model_of(&def));
  size_t size = zp_sim_state_size(sim);
  unsigned char *saved = memory_of(size), *before = memory_of(size), *after = memory_of(size);
  zp_sim_save(sim, saved);
  zp_sim_run(sim, 1e-3, false, NULL, NULL);
  zp_sim_save(sim, before);
  ZpError err;
  for (size_t i = 0; i < size; i++) {
    unsigned char *cut = memory_of(i + 1); /* of its own size, so that reading beyond it is found */
    memcpy(cut, saved, i);
    ck_assert_int_eq(zp_sim_restore(sim, cut, i, &err), ZP_BAD_INPUT);
    saved[i] ^= (unsigned char)(1 << i % 8);
    ck_assert_int_eq(zp_sim_restore(sim, saved, size, &err), ZP_BAD_INPUT);
    ck_assert_msg(strncmp(err.message, "state: ", 7) == 0, "%s", err.message);
    saved[i] ^= (unsigned char)(1 << i % 8);
  }
  zp_sim_save(sim, after);
  ck_assert_mem_eq(before, after, size);
  ck_assert_int_eq(zp_sim_restore(sim, saved, size, NULL), ZP_OK);
}

/* Padding and numbers that are none (zip_time) have bits of their own in memory: a snapshot has not, and gives all
 * members and arrays back. */
TEST(test_equal_states_give_equal_bytes) {
  ZpActuatorDef def = DEF(EXPLICIT, {"mesh.nodes", 5});
  ZpModel *model = model_of(&def);
  ZpSim *sim = sim_of(model);
  zp_sim_run(sim, 1e-3, false, NULL, NULL);
  size_t size = zp_snapshot_size(model), bytes = zp_state_size(model);
  ZpState *there = memory_of(bytes), *back = memory_of(bytes);
  unsigned char *one = memory_of(size), *two = memory_of(size);
  memset(there, 0xA5, bytes);
  memset(back, 0x5A, bytes);
  zp_snapshot_write(model, sim->states, one);
  ck_assert_int_eq(zp_snapshot_read(model, one, size, &there, NULL), ZP_OK);
  there->zip_time = copysign(there->zip_time, -1);
  zp_snapshot_write(model, &there, two);
  ck_assert_mem_eq(one, two, size);
  ck_assert_int_eq(zp_snapshot_read(model, two, size, &back, NULL), ZP_OK);
  ck_assert_mem_eq(back->data, sim->state->data, bytes - sizeof *back);
  ck_assert(back->t == 1e-3 && isnan(back->zip_time) && back->was_open == sim->state->was_open);
  ck_assert(back->U == sim->state->U && back->work == sim->state->work && back->base_charge == sim->state->base_charge);
}

/* The in-memory form and the snapshot lead to the same bits: in a zip, with a held force, implicit and explicit. */
TESTS(test_copy_and_snapshot_are_the_same, 0, 5) {
  double cut, end;
  ZpActuatorDef def = def_of(_i, &cut, &end);
  ZpModel *model = model_of(&def);
  ZpSim *sim = sim_of(model), *copied = sim_of(model), *restored = sim_of(model);
  size_t size = zp_sim_state_size(sim);
  void *state = memory_of(zp_state_size(model));
  unsigned char *saved = memory_of(size), *one = memory_of(size), *two = memory_of(size);
  zp_sim_run(sim, cut, false, NULL, NULL);
  copy_state(sim, state);
  zp_sim_save(sim, saved);
  put_state(copied, state);
  ck_assert_int_eq(zp_sim_restore(restored, saved, size, NULL), ZP_OK);
  zp_sim_run(copied, end, false, NULL, NULL);
  zp_sim_run(restored, end, false, NULL, NULL);
  zp_sim_save(copied, one);
  zp_sim_save(restored, two);
  ck_assert_mem_eq(one, two, size);
  ck_assert_int_ne(memcmp(one, saved, size), 0);
}

/* A run that ends where the checkpoint is would be none. */
TEST(test_no_time_left) {
  ZpActuatorDef def = DEF(EXPLICIT, {"mesh.nodes", 5});
  size_t size;
  ZpCheckpoint *checkpoint;
  unsigned char *byte = short_run(&size);
  ck_assert_int_eq(zp_checkpoint_from(byte, size, &checkpoint, NULL), ZP_OK);
  def.solver.end_time = zp_checkpoint_time(checkpoint);
  ck_says(zp_checkpoint_check(checkpoint, &def, &err), ZP_BAD_INPUT, "must be larger than");
  def.solver.end_time = nextafter(def.solver.end_time, 1);
  ck_assert_int_eq(zp_checkpoint_check(checkpoint, &def, NULL), ZP_OK);
  zp_checkpoint_destroy(checkpoint);
}

/* What an earlier program wrote says so. */
TEST(test_earlier_file) {
  unsigned char old[64] = {0x89, 'Z', 'P', 'S', '\r', '\n', 0x1A, '\n', 2};
  refused(old, sizeof old, 0, "of version 2 of the format, by zipact 0.1.0; zipact " ZP_VERSION " reads version 10");
}

/* A record with other fields than those that are read: what differs is named, and numbers stay as they were. */
TESTS(test_other_fields, 0, 6) {
  static const ZpPackKind kind = {"record", 'X', 10};
  static const struct {
    const char *name;
    ZpFieldType type;
    size_t count;
    const char *says;
  } read[] = {{"a", ZP_REAL, 2, NULL},         {"a", ZP_REAL, 3, "without a;"},   {"a", ZP_REAL, 1, "without a;"},
              {"a", ZP_SIZE, 2, "without a;"}, {"ab", ZP_REAL, 2, "without ab;"}, {NULL, ZP_REAL, 0, "with more;"}};
  double written[2] = {1, NAN}, value[3] = {7, 7, 7};
  unsigned char byte[64];
  ZpError err;
  ZpPack p = zp_pack_write(&kind, byte);
  zp_pack_field(&p, "a", ZP_REAL, written, 2);
  zp_pack_seal(&p);
  ck_assert_int_eq(zp_pack_read(&kind, byte, p.used, &p, NULL), ZP_OK);
  if (read[_i].name) zp_pack_field(&p, read[_i].name, read[_i].type, value, read[_i].count);
  ck_assert_int_eq(zp_pack_end(&p, &err), read[_i].says ? ZP_BAD_INPUT : ZP_OK);
  ck_assert_msg(!read[_i].says || strstr(err.message, read[_i].says), "%s", err.message);
  ck_assert(read[_i].says ? value[0] == 7 && value[1] == 7 : value[0] == 1 && isnan(value[1]));
}

TESTS(test_keys, 0, 5) {
  static const struct {
    const char *file;
    ZpInitialState state;
    ZpStudy study;
    double end;
    const char *named;
  } wrong[] = {
      {"", ZP_INITIAL_CHECKPOINT, ZP_STUDY_ACTUATE, 2e-3, "requires initial.file"},
      {path, ZP_INITIAL_STRAIGHT, ZP_STUDY_ACTUATE, 2e-3, "initial.file: requires initial.state checkpoint"},
      {path, ZP_INITIAL_CHECKPOINT, ZP_STUDY_STATIONARY, 2e-3, "only study actuate resumes a run"},
      {"nowhere.zps", ZP_INITIAL_CHECKPOINT, ZP_STUDY_ACTUATE, 2e-3, "nowhere.zps: cannot be opened"},
      {path, ZP_INITIAL_CHECKPOINT, ZP_STUDY_ACTUATE, 0.5e-3, "solver.end_time must be larger than 0.0005 s"},
  };
  size_t size;
  short_run(&size);
  ZpActuatorDef def = DEF(EXPLICIT, {"mesh.nodes", 5});
  start_from(&def, wrong[_i].file);
  def.initial.state = wrong[_i].state;
  def.solver.end_time = wrong[_i].end;
  ZpResult *result = NULL;
  ck_says(zp_data_study_run(wrong[_i].study, &def, NULL, &result, &err), ZP_BAD_INPUT, wrong[_i].named);
}
