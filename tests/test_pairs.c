/* Every feature of features.def with every other, on a small actuator with a coarse mesh: a pair is refused by a
 * sentence that names both, and stands in tests/data/refused_pairs.tsv, or it balances. At rest the forces are minus
 * the gradient of the energy, and the stiffness is the derivative of the forces. In motion energy, charge and power
 * balance, a restored run continues to the same bits, and a whole or doubled actuator does as its parts do. Two routes
 * to a number at rest agree. */
#include "state_util.h"

#include <zipact/calibrate.h>
#include <zipact/io.h>

#include "actuator/model.h"
#include "rest/rest.h"

/* -- features and pairs ---------------------------------------------------------------------------- */

typedef struct Feature {
  const char *name, *settings;
} Feature;

static const Feature features[] = {
#define ZP_FEATURE(name, settings) {name, settings},
#include "features.def"
};
enum { FEATURES = LENGTH_OF(features), NONE = -1, MOST_SETTINGS = 24, MOST_WORDS = 128 };

/* A key with its value: a number, or a text. */
typedef struct Given {
  int key;
  double value;
  char text[MOST_WORDS];
} Given;

typedef struct Givens {
  Given given[MOST_SETTINGS];
  size_t count;
} Givens;

/* All pairs start from this. */
static const char base[] = "mesh.nodes=9; liquid.model=none; output.errors=false; solver.end_time=30 ms; "
                           "output.samples=200; output.shapes=2";

/* What a study needs in addition, unless a feature says otherwise. */
static const char *needs_of(ZpStudy study) {
  switch (study) {
  case ZP_STUDY_CYCLE:
    return "drive.waveform=sine; drive.frequency=100 Hz; cycle.most_cycles=3";
  case ZP_STUDY_ISOMETRIC:
    return "isometric.separation=8 mm; drive.voltage=6 kV";
  case ZP_STUDY_MODES:
    return "modes.voltage=2 kV";
  default:
    return "";
  }
}

static Given *find(Givens *all, int key) {
  for (size_t i = 0; i < all->count; i++)
    if (all->given[i].key == key) return &all->given[i];
  return NULL;
}

/* Add `key=value; key=value` to `all`, in place of earlier values. */
static void give(Givens *all, const char *settings) {
  char copy[512], *rest = copy, *one;
  ck_assert_uint_lt(strlen(settings), sizeof copy);
  strcpy(copy, settings);
  while ((one = strsep(&rest, ";"))) {
    one += strspn(one, " ");
    char *equals = strchr(one, '=');
    if (!equals) continue;
    *equals = 0;
    int key = zp_key_find(one);
    ck_assert_msg(key >= 0, "no key %s", one);
    Given *to = find(all, key);
    if (!to) to = &all->given[all->count++];
    ck_assert_uint_le(all->count, MOST_SETTINGS);
    to->key = key;
    ck_assert_uint_lt(strlen(equals + 1), sizeof to->text);
    strcpy(to->text, equals + 1);
    ZpError err = {ZP_OK, ""};
    if (zp_key(key)->type != ZP_KEY_TEXT)
      ck_assert_msg(zp_value_parse(key, to->text, &to->value, &err) == ZP_OK, "%s", err.message);
  }
}

/* Those of each feature, read once: main. */
static Givens parsed[FEATURES], of_all, of_study[ZpStudy_COUNT];

static void add(Givens *all, const Givens *more) {
  for (size_t i = 0; i < more->count; i++) {
    Given *to = find(all, more->given[i].key);
    if (!to) to = &all->given[all->count++];
    ck_assert_uint_le(all->count, MOST_SETTINGS);
    *to = more->given[i];
  }
}

/* Do they give a key different values? */
static bool are_alternatives(int a, int b) {
  for (size_t i = 0; i < parsed[b].count; i++) {
    const Given *same = find(&parsed[a], parsed[b].given[i].key);
    if (same && strcmp(same->text, parsed[b].given[i].text) != 0) return true;
  }
  return false;
}

/* (features a and b, or one twice: it alone, or NONE) => a Def for a study, not yet checked. */
static ZpStatus fill(ZpStudy study, int a, int b, ZpActuatorDef *def, ZpError *err) {
  Givens all = {.count = 0};
  add(&all, &of_all);
  add(&all, &of_study[study]);
  if (a != NONE) add(&all, &parsed[a]);
  if (b != NONE) add(&all, &parsed[b]);
  ZpAssignment list[MOST_SETTINGS];
  size_t count = 0;
  for (size_t i = 0; i < all.count; i++)
    if (zp_key(all.given[i].key)->type != ZP_KEY_TEXT)
      list[count++] = (ZpAssignment){all.given[i].key, all.given[i].value};
  def->layout = zp_actuator_def_default().layout;
  ZpStatus status = zp_def_fill(def, list, count, err);
  for (size_t i = 0; i < all.count && status == ZP_OK; i++)
    if (zp_key(all.given[i].key)->type == ZP_KEY_TEXT)
      status = zp_def_set_text(def, all.given[i].key, all.given[i].text, err);
  return status;
}

/* -- refused pairs --------------------------------------------------------------------------------- */

static const ZpStudy studies[] = {ZP_STUDY_ACTUATE, ZP_STUDY_STATIONARY, ZP_STUDY_EQUILIBRIUM, ZP_STUDY_LIMITS,
                                  ZP_STUDY_MODES,   ZP_STUDY_ISOMETRIC,  ZP_STUDY_CYCLE,       ZP_STUDY_PROFILE};
enum { STUDIES = LENGTH_OF(studies) };

/* Does this study take the pair? If so `def` is its Def. */
static bool takes(ZpStudy study, int a, int b, ZpActuatorDef *def, ZpError *err) {
  return fill(study, a, b, def, err) == ZP_OK && zp_study_check(study, def, err) == ZP_OK;
}

/* Does a message name a key that the feature changes, also by a preset or a supply? */
static bool is_named(const char *message, ZpStudy study, int feature) {
  ZpActuatorDef with, without;
  fill(study, feature, feature, &with, NULL);
  fill(study, NONE, NONE, &without, NULL);
  for (int key = 0; key < zp_key_count(); key++) {
    const ZpKey *k = zp_key(key);
    if (k->offset == ZP_NO_FIELD || !strstr(message, k->name)) continue;
    double value = zp_def_get(&with, key), plain = zp_def_get(&without, key);
    bool text = k->type == ZP_KEY_TEXT, changed = !text && value != plain && !(isnan(value) && isnan(plain));
    if (changed || find(&parsed[feature], key)) return true;
  }
  return false;
}

/* Tell the pair (or the feature alone) that some studies refuse, with the first reason. => number of studies */
static int list_refusal(FILE *file, int a, int b, bool alone[FEATURES][STUDIES]) {
  char words[128] = "", reason[sizeof((ZpError *)0)->message] = "";
  int refused = 0;
  for (size_t k = 0; k < STUDIES; k++) {
    ZpActuatorDef def;
    ZpError err = {ZP_OK, ""};
    if (a != b && !(alone[a][k] && alone[b][k])) continue;
    if (takes(studies[k], a, b, &def, &err)) continue;
    ck_assert_int_eq(err.status, ZP_BAD_INPUT);
    ck_assert_msg(is_named(err.message, studies[k], a) && is_named(err.message, studies[k], b),
                  "%s with %s is refused by %s without the name of both: %s", features[a].name, features[b].name,
                  zp_study_name(studies[k]), err.message);
    if (refused++ == 0) strcpy(reason, err.message);
    snprintf(words + strlen(words), sizeof words - strlen(words), "%s%s", refused > 1 ? " " : "",
             zp_study_name(studies[k]));
  }
  if (refused > 0) fprintf(file, "%s\t%s\t%s\t%s\n", features[a].name, a == b ? "" : features[b].name, words, reason);
  return refused;
}

START_TEST(refused_pairs_are_listed) {
  static bool alone[FEATURES][STUDIES];
  FILE *file = fopen("refused_pairs.tsv", "w");
  ck_assert_ptr_nonnull(file);
  int pairs = 0, refused = 0, cases = 0, refused_cases = 0;
  for (int a = 0; a < FEATURES; a++)
    for (size_t k = 0; k < STUDIES; k++) {
      ZpActuatorDef def;
      alone[a][k] = takes(studies[k], a, a, &def, NULL);
    }
  for (int a = 0; a < FEATURES; a++) {
    list_refusal(file, a, a, alone);
    for (int b = a + 1; b < FEATURES; b++) {
      if (are_alternatives(a, b)) continue;
      int by = list_refusal(file, a, b, alone);
      for (size_t k = 0; k < STUDIES; k++)
        cases += alone[a][k] && alone[b][k];
      pairs++, refused += by > 0, refused_cases += by;
    }
  }
  fprintf(file, "%d features, %d pairs: %d are refused by a study that takes both alone, in %d of %d cases\n", FEATURES,
          pairs, refused, refused_cases, cases);
  ck_assert_int_eq(fclose(file), 0);
}
END_TEST

/* -- forces at rest -------------------------------------------------------------------------------- */

/* Laws of the field, whose forces have a common energy; the others have one each. */
static bool is_electric(const ZpTerm *term) {
  static const char *const names[] = {"plates", "leak", "bezier", "field", "bead"};
  for (size_t k = 0; k < LENGTH_OF(names); k++)
    if (strcmp(term->name, names[k]) == 0) return true;
  return false;
}

/* Laws that have an energy in motion only. */
static bool moves(const ZpTerm *term) {
  return strcmp(term->name, "film") == 0 || strcmp(term->name, "outer") == 0;
}

/* The law `which`, or all electric ones if it is the number of terms: energy and forces at the present point. */
static double energy_and_forces(ZpStatics *s, size_t which, double *F) {
  const ZpModel *model = s->model;
  ZpEval *e = &s->eval;
  ZpSpan now = zp_span_at(s->q);
  now.U0 = now.U1 = s->U;
  now.faces_pass = true;
  now.beyond = zp_eval_beyond(e);
  zp_system_force(model, &now, e, F); /* finds edges and gaps for the terms */
  memset(F, 0, 2 * model->stride * sizeof *F);
  ZpEnergies sum = {0};
  ZpElectric field = {0};
  for (size_t k = 0; k < e->terms; k++) {
    bool electric = is_electric(e->term[k]);
    if (which == e->terms ? !electric : k != which) continue;
    e->term[k]->force(model, &now, e, F);
    if (e->term[k]->energy && !moves(e->term[k])) e->term[k]->energy(model, &now, e, &sum);
    if (e->term[k]->electric) e->term[k]->electric(model, &now, e, ZP_SPAN_END, s->U, &field);
  }
  double surfaces = 0;
  for (int half = 0; which == e->terms && half < zp_beads(&model->film); half++)
    surfaces -= 2 * model->bead.suction * model->bead.tension * model->film.w * e->reach[half];
  return sum.axial + sum.bending + sum.gravity + sum.spring + field.potential + surfaces;
}

enum { ROOM = 512 };

/* From q0 [2 stride] by a part of a step of the equations. */
static void move_from(ZpStatics *s, const double *q0, const double *step, double part) {
  size_t stride = s->model->stride;
  memcpy(s->q, q0, 2 * stride * sizeof *q0);
  for (size_t k = 0; k < 2 * s->model->count; k++) {
    int row = s->assembly.equation[k];
    if (row >= 0) s->q[k / 2 + (k % 2) * stride] += part * step[row];
  }
}

/* A wedge that opens from its clips, noisily. */
static void open_wedge(ZpStatics *s, double *step) {
  uint64_t seed = 7;
  const ZpModel *model = s->model;
  size_t last = model->topology.stations - 1;
  memset(step, 0, s->assembly.n * sizeof *step);
  for (size_t i = 0; i <= last; i++) {
    double part = (double)i / (double)last;
    if (model->topology.halves == 2) part = 1 - fabs(2 * part - 1);
    int row = s->assembly.equation[2 * zp_lower(&model->topology, i) + 1];
    if (row >= 0) step[row] = -(50e-6 + 500e-6 * part * part) * (1 + 0.1 * noise(&seed));
  }
}

/* A direction in which all nodes move up and down, and a little to the sides. */
static void draw_direction(ZpStatics *s, double *step) {
  uint64_t seed = 11;
  for (size_t k = 0; k < 2 * s->model->count; k++) {
    int row = s->assembly.equation[k];
    if (row >= 0) step[row] = (k % 2 == 0 ? 1e-3 : 1) * noise(&seed);
  }
}

typedef struct AtRest {
  double gradient, stiffness; /* largest relative differences */
} AtRest;

/* Force along the step against the difference of the energy, over the sum of the forces' sizes along it. */
static double gradient_error(ZpStatics *s, size_t which, const double *q0, const double *step, double h) {
  double F[ROOM], r[ROOM], other[ROOM], energy[2];
  ZpStaticSystem system = zp_statics_system(s);
  for (int k = 0; k < 2; k++) {
    move_from(s, q0, step, k ? h : -h);
    if (system.refresh) system.refresh(s);
    energy[k] = energy_and_forces(s, which, other);
  }
  move_from(s, q0, step, 0);
  if (system.refresh) system.refresh(s);
  energy_and_forces(s, which, F);
  zp_assembly_sum(&s->assembly, F, r);
  double along = 0, size = 0;
  for (size_t i = 0; i < s->assembly.n; i++)
    along += r[i] * step[i], size += fabs(r[i] * step[i]);
  return size != 0 ? fabs(along + (energy[1] - energy[0]) / (2 * h)) / size : 0;
}

static void check_at_rest(ZpStatics *s, AtRest *worst) {
  double q0[ROOM], step[ROOM];
  ck_assert_uint_le(2 * s->model->stride, ROOM);
  open_wedge(s, step);
  memcpy(q0, s->q, 2 * s->model->stride * sizeof *q0);
  move_from(s, q0, step, 1);
  memcpy(q0, s->q, 2 * s->model->stride * sizeof *q0);
  s->U = 2e3;
  draw_direction(s, step);
  for (size_t k = 0; k <= s->eval.terms; k++) {
    if (k < s->eval.terms && is_electric(s->eval.term[k])) continue;
    double error = gradient_error(s, k, q0, step, 1e-7);
    if (error > 1e-6) printf("   %s %.2e\n", k < s->eval.terms ? s->eval.term[k]->name : "field", error);
    ck_assert(isfinite(error));
    worst->gradient = fmax(worst->gradient, error);
  }
}

/* Over all members of the model. */
static AtRest at_rest(const ZpActuatorDef *def) {
  ZpModel *model = model_of(def);
  AtRest worst = {0, 0};
  for (const ZpModel *one = model; one; one = one->below) {
    ZpRest rest;
    ck_assert(zp_rest_open(&rest, one, NULL, NULL));
    check_at_rest(&rest.statics, &worst);
    zp_rest_close(&rest);
  }
  zp_model_destroy(model);
  return worst;
}

START_TEST(forces_have_an_energy) {
  int a = _i;
  for (int b = a; b < FEATURES; b++) {
    ZpActuatorDef def;
    if (are_alternatives(a, b) || !takes(ZP_STUDY_STATIONARY, a, b, &def, NULL)) continue;
    if (getenv("ALONE") && a != b) continue;
    if (def.drive.waveform == ZP_WAVEFORM_TABLE || def.setpoint.waveform == ZP_WAVEFORM_TABLE) continue;
    AtRest worst = at_rest(&def);
    printf("rest %s | %s: %.2e %.2e\n", features[a].name, features[b].name, worst.gradient, worst.stiffness);
  }
}
END_TEST

/* -- in motion ------------------------------------------------------------------------------------- */

/* What does not balance in a run, relative to what flows. */
typedef struct Books {
  double energy, source, power, charge, viscous;
} Books;

static double at(const ZpTable *series, size_t row, const char *column) {
  return zp_table_get(series, row, column);
}

/* Largest size of a column. */
static double largest(const ZpTable *series, const char *column) {
  double most = 0;
  for (size_t r = 0; r < series->rows; r++)
    most = fmax(most, fabs(at(series, r, column)));
  return most;
}

/* Sum of a rate over time. */
static double total(const ZpTable *series, const char *column) {
  double sum = 0;
  for (size_t r = 1; r < series->rows; r++)
    sum += at(series, r, column) * (at(series, r, "time_s") - at(series, r - 1, "time_s"));
  return sum;
}

static Books books_of(const ZpTable *series, const ZpActuatorDef *def) {
  static const double least = 1e-9; /* J */
  Books books = {0, 0, 0, 0, 0};
  double flow = fmax(largest(series, "electric_work_J"), largest(series, "kinetic_energy_J")),
         drawn = fmax(largest(series, "source_energy_J"), least);
  books.energy = largest(series, "energy_imbalance_J") / fmax(flow, least);
  for (size_t r = 0; r < series->rows; r++) {
    double supplied = at(series, r, "electric_work_J") + at(series, r, "cable_energy_J") +
                      at(series, r, "source_loss_J") + at(series, r, "bleeder_loss_J"),
           film = at(series, r, "film_along_loss_J") + at(series, r, "film_across_loss_J");
    books.source = fmax(books.source, fabs(supplied - at(series, r, "source_energy_J")) / drawn);
    books.viscous = fmax(books.viscous, fabs(film - at(series, r, "viscous_loss_J")) / drawn);
  }
  size_t last = series->rows - 1;
  books.power = fabs(total(series, "power_W") - at(series, last, "source_energy_J") + at(series, 0, "source_energy_J")) / drawn;
  bool passes = !isnan(def->source.bleeder) || !isnan(def->insulator.resistivity) || !isnan(def->medium.resistivity);
  double stored[2];
  for (int k = 0; k < 2; k++)
    stored[k] = at(series, k ? last : 0, "charge_C") + def->source.capacitance * at(series, k ? last : 0, "voltage_V");
  double charge = fmax(largest(series, "charge_C"), 1e-15);
  if (!passes) books.charge = fabs(total(series, "current_A") - stored[1] + stored[0]) / charge;
  return books;
}

/* Run to `end` => its state there, which the caller frees. */
static void *run_to(ZpSim *sim, double end, const char *name) {
  ZpRunInfo info;
  ck_assert_msg(zp_sim_run(sim, end, false, NULL, &info) == ZP_REACHED_END, "%s: %s", name, info.message);
  void *bytes = calloc(1, zp_sim_state_size(sim));
  zp_sim_save(sim, bytes);
  return bytes;
}

static ZpSim *data_sim(const ZpActuatorDef *def, ZpModel **model, const char *name) {
  ZpSim *sim = NULL;
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_data_sim_create(def, NULL, model, &sim, &err) == ZP_OK, "%s: %s", name, err.message);
  return sim;
}

static const double middle = 8e-3, end = 14e-3; /* s */

/* Another run to the middle, and a third one that continues from there: both to the same bits. */
static void check_continued(const ZpActuatorDef *def, const void *halfway, const void *finally, const char *name) {
  ZpModel *model = NULL;
  ZpSim *sim = data_sim(def, &model, name), *other = NULL;
  size_t size = zp_sim_state_size(sim);
  void *again = run_to(sim, middle, name);
  ck_assert_msg(memcmp(again, halfway, size) == 0, "%s: a second run differs", name);
  ZpError err = {ZP_OK, ""};
  ck_assert_int_eq(zp_sim_create(model, NULL, &other, &err), ZP_OK);
  ck_assert_msg(zp_sim_restore(other, halfway, size, &err) == ZP_OK, "%s: %s", name, err.message);
  void *continued = run_to(other, end, name);
  ck_assert_msg(memcmp(continued, finally, size) == 0, "%s: the restored run differs", name);
  free(again), free(continued);
  zp_sim_destroy(sim);
  zp_sim_destroy(other);
  zp_model_destroy(model);
}

static Books in_motion(const ZpActuatorDef *def, const char *name) {
  ZpModel *model = NULL;
  ZpSim *sim = data_sim(def, &model, name);
  size_t columns;
  const ZpColumn *column = zp_signal_columns(&columns);
  ZpTable *series = zp_table_create(column, columns, 200);
  zp_sim_record(sim, series, NULL);
  void *halfway = run_to(sim, middle, name), *finally = run_to(sim, end, name);
  Books books = books_of(series, def);
  for (size_t i = 0; i < series->rows * series->columns; i++)
    ck_assert_msg(!isinf(series->value[i]), "%s: a signal is infinite", name);
  printf("motion %s: %.1e %.1e %.1e %.1e %.1e zipped %.1f contact %.1e rows %zu\n", name, books.energy, books.source, books.power, books.charge,
         books.viscous, 1e3 * zp_sim_get(sim, "zipped_length"), zp_sim_get(sim, "contact_loss"), series->rows);
  check_continued(def, halfway, finally, name);
  free(halfway), free(finally);
  zp_table_destroy(series);
  zp_sim_destroy(sim);
  zp_model_destroy(model);
  return books;
}

START_TEST(motion_balances) {
  int a = _i;
  for (int b = a; b < FEATURES; b++) {
    ZpActuatorDef def;
    if (are_alternatives(a, b) || !takes(ZP_STUDY_ACTUATE, a, b, &def, NULL)) continue;
    if (getenv("ALONE") && a != b) continue;
    char name[128];
    snprintf(name, sizeof name, "%s, %s", features[a].name, features[b].name);
    in_motion(&def, name);
  }
}
END_TEST

static void read_features(void) {
  give(&of_all, base);
  for (int k = 0; k < ZpStudy_COUNT; k++)
    give(&of_study[k], needs_of((ZpStudy)k));
  for (int k = 0; k < FEATURES; k++)
    give(&parsed[k], features[k].settings);
}

int main(void) {
  Suite *suite = suite_create("pairs");
  TCase *all = tcase_create("all");
  tcase_add_test(all, refused_pairs_are_listed);
  tcase_add_loop_test(all, forces_have_an_energy, 0, FEATURES);
  tcase_add_loop_test(all, motion_balances, 0, FEATURES);
  tcase_add_checked_fixture(all, read_features, NULL);
  suite_add_tcase(suite, all);
  return run_suite(suite);
}
