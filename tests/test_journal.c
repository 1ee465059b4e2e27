/* The journal of a campaign: a result comes back from its bytes as it was, rows are found by their numbers, hashes of
 * cases say what a row belongs to; what a campaign counts, and where a case begins. */
#include "data_util.h"

#include <pthread.h>
#include <semaphore.h>
#include <sys/stat.h>

#include <zipact/batch.h>
#include <zipact/campaign.h>
#include <zipact/version.h>

#include "base/pack.h"
#include "campaign/case_hash.h"
#include "campaign/journal.h"
#include "fit/case.h"
#include "io/packed.h"

#define SCENARIO(...) scenario_with((const char *const[]){__VA_ARGS__, NULL})

/* So that rows have names of their own. */
static const char *other_name(double value) {
  return value < 4 ? "real_time_factor" : "steps_per_second";
}

/* A result with all that a row keeps; the number's name is that of the column, which has a help. */
static ZpResult *result_of(double value) {
  static const ZpColumn columns[] = {{"stroke_m", "m", "of the first"}, {"stroke_m", "m", "of the second"}};
  ZpResult *result = new_result(ZP_STUDY_STATIONARY);
  result->outcome = ZP_ZIPPED;
  snprintf(result->message, sizeof result->message, "made by hand");
  zp_result_add(result, "stroke_m", "m", value);
  zp_result_add(result, other_name(value), "1", 7);
  result->scalar[1].timing = true;
  zp_result_add_sensitivity(result, "stroke_m", zp_key_find("load.mass"), 3);
  zp_result_note(result, "a note");
  result->series = zp_table_create(columns, 2, 2);
  zp_table_offer(result->series, (double[]){value + 1, value + 2});
  ck_assert_uint_eq(result->series->rows, 1);
  return result;
}

static void assert_is(const ZpResult *row, double value) {
  ck_assert(row->scalars == 2 && row->sensitivities == 1 && row->notes == 1);
  ck_assert(strcmp(row->scalar[0].name, "stroke_m") == 0 && strcmp(row->scalar[0].unit, "m") == 0);
  ck_assert(row->scalar[0].value == value && !row->scalar[0].timing);
  ck_assert(row->scalar[1].value == 7 && row->scalar[1].timing);
  ck_assert_str_eq(row->scalar[1].name, other_name(value));
  ck_assert_str_eq(row->note[0], "a note");
  ck_assert_str_eq(row->sensitivity[0].output, "stroke_m");
  ck_assert(row->sensitivity[0].key == zp_key_find("load.mass") && row->sensitivity[0].value == 3);
  ck_assert(row->series->rows == 1 && row->series->columns == 2);
  ck_assert_str_eq(row->series->column[0].help, "of the first");
  ck_assert_str_eq(row->series->column[1].help, "of the second");
  ck_assert(row->series->value[0] == value + 1 && row->series->value[1] == value + 2);
}

TEST(result_comes_back_from_its_bytes) {
  ZpResult *result = result_of(0.25), *back;
  const size_t size = zp_result_save(result, NULL);
  unsigned char *byte = memory_of(size);
  ck_assert_uint_eq(zp_result_save(result, byte), size);
  ck_assert_int_eq(zp_result_load(byte, size, &back, NULL), ZP_OK);
  assert_is(back, 0.25);
  ck_assert(back->study == ZP_STUDY_STATIONARY && back->outcome == ZP_ZIPPED);
  ck_assert_ptr_null(back->shapes);
  zp_result_destroy(back);
  for (size_t i = 0; i < size; i++) {
    ZpError err;
    unsigned char *cut = memory_of(i + 1); /* of its own size, so that reading beyond it is found */
    memcpy(cut, byte, i);
    const bool whole = zp_result_load(cut, i, &back, &err) == ZP_OK; /* without shapes, as in the journal */
    ck_assert_msg(!whole || i == zp_pack_first(byte, size) + zp_pack_first(byte + zp_pack_first(byte, size), size),
                  "%zu of %zu bytes", i, size);
    if (whole) zp_result_destroy(back);
    byte[i] ^= (unsigned char)(1 << i % 8);
    ck_assert_int_eq(zp_result_load(byte, size, &back, &err), ZP_BAD_INPUT);
    ck_assert_msg(strncmp(err.message, "result: ", 8) == 0, "%s", err.message);
    byte[i] ^= (unsigned char)(1 << i % 8);
  }
}

/* Shapes, the map of a field and checkpoints, too: what comes back has the same bytes, of which none may be damaged. */
TESTS(everything_comes_back, 0, 4) {
  const struct {
    ZpStudy study;
    ZpActuatorDef def;
  } of[] = {
      {ZP_STUDY_PROFILE, DEF({"mesh.nodes", 5}, {"drive.voltage", 3e3})},
      {ZP_STUDY_STATIONARY, DEF({"mesh.nodes", 5}, {"actuator.kind", ZP_KIND_RIBBON})},
      {ZP_STUDY_STATIONARY, DEF({"mesh.nodes", 5}, {"stack.series", 2}, {"stack.distance", 20e-3})},
      {ZP_STUDY_ACTUATE, DEF({"mesh.nodes", 5}, {"liquid.model", ZP_LIQUID_NONE}, {"solver.end_time", 1e-4})},
  };
  ZpError err = {ZP_OK, ""};
  ZpResult *result, *back = NULL;
  result = study_of(of[_i].study, &of[_i].def);
  const size_t size = zp_result_save(result, NULL);
  unsigned char *byte = memory_of(size), *again = memory_of(size);
  zp_result_save(result, byte);
  ck_ok(zp_result_load(byte, size, &back, &err));
  ck_assert(back->shapes && (back->map != NULL) == (_i == 0) && (back->checkpoint != NULL) == (_i == 3));
  ck_assert(back->shapes->facing == (_i != 1) && back->shapes->members == (_i == 2 ? 2 : 1));
  ck_assert(back->shapes->stressed == result->shapes->stressed && back->shapes->stressed == (_i != 0));
  ck_assert(!back->map || memcmp(back->map->surface, result->map->surface, sizeof back->map->surface) == 0);
  ck_assert(!back->map || memcmp(back->map->y, result->map->y, 8 * back->map->nx * back->map->ny) == 0);
  ck_assert_uint_eq(zp_result_save(back, NULL), size);
  zp_result_save(back, again);
  ck_assert_mem_eq(byte, again, size);
  zp_result_destroy(back);
  for (size_t i = 0; i < size; i += 1 + size / 500) {
    byte[i] ^= (unsigned char)(1 << i % 8);
    ck_assert_int_eq(zp_result_load(byte, size, &back, &err), ZP_BAD_INPUT);
    byte[i] ^= (unsigned char)(1 << i % 8);
  }
}

/* Each record is whole, but the numbers are those of a result with other names. */
TEST(numbers_belong_to_their_names) {
  ZpResult *one = result_of(1), *other = result_of(1), *back = new_result(ZP_STUDY_LIMITS);
  other->scalar[0].name = "opening_m";
  ZpPacked *a = zp_packed_of(one), *b = zp_packed_of(other);
  ZpNames names;
  ck_assert_int_eq(zp_names_read(a->byte, a->names, &names, NULL), ZP_OK);
  ck_assert_int_eq(zp_numbers_read(&names, a->byte + a->names, a->size - a->names, back, NULL), ZP_OK);
  assert_is(back, 1);
  ck_assert_int_eq(back->study, ZP_STUDY_STATIONARY);
  ck_assert_int_eq(zp_numbers_read(&names, b->byte + b->names, b->size - b->names, back, NULL), ZP_BAD_INPUT);
  ck_assert(back->scalars == 0 && back->series == NULL);
  free(a);
  free(b);
}

static void put(ZpJournal *journal, size_t number, double value) {
  ZpResult *result = result_of(value);
  ZpPacked *packed = zp_packed_of(result);
  ck_assert_int_eq(zp_journal_put(journal, number, 1000 + number, packed, NULL), ZP_OK);
  free(packed);
}

static ZpJournal *journal_in(const char *folder, bool keep, size_t cases) {
  ZpJournal *journal;
  mkdir(folder, 0777);
  ck_ok(zp_journal_open(folder, ZP_STUDY_STATIONARY, keep, cases, &journal, &err));
  return journal;
}

static void count_row(void *user, size_t number, uint64_t hash, bool good) {
  ck_assert(good && hash == 1000 + number);
  *(size_t *)user += 1;
}

static size_t rows_in(ZpJournal *journal) {
  size_t rows = 0;
  ck_assert_int_eq(zp_journal_visit(journal, count_row, &rows, NULL), ZP_OK);
  return rows;
}

/* In any order; also by a second process, and after the list of cases has become shorter and longer again. */
TEST(rows_are_found_by_their_numbers) {
  static const size_t order[] = {0, 1, 4, 6, 5, 0, 6};
  remove("journal/journal.sqlite");
  ZpJournal *journal = journal_in("journal", true, 8);
  for (size_t i = 0; i < 7; i++)
    if (i != 3) put(journal, i, (double)i);
  ck_assert_int_eq(zp_journal_commit(journal, NULL), ZP_OK);
  for (int second = 0; second < 2; second++) {
    const char *kept = zp_journal_get(journal, 0)->scalar[1].name;
    for (size_t k = 0; k < LENGTH_OF(order); k++) {
      const ZpResult *row = zp_journal_get(journal, order[k]);
      assert_is(row, (double)order[k]);
      ck_assert(row->outcome == ZP_ZIPPED && strcmp(row->message, "made by hand") == 0);
    }
    ck_assert_str_eq(kept, other_name(0)); /* names outlive their row */
    ck_assert_int_eq(zp_journal_status(journal, NULL), ZP_OK);
    zp_journal_close(journal);
    journal = journal_in("journal", true, 8);
  }
  ck_assert_uint_eq(zp_journal_get(journal, 3)->scalars, 0); /* which is not there */
  ck_assert_int_eq(zp_journal_status(journal, NULL), ZP_MACHINE);
  zp_journal_close(journal);
  journal = journal_in("journal", true, 4);
  ck_assert_uint_eq(rows_in(journal), 3);
  zp_journal_close(journal);
  journal = journal_in("journal", true, 8);
  ck_assert_uint_eq(rows_in(journal), 3);
  zp_journal_close(journal);
}

/* -- hashes ------------------------------------------------------------------------------------------ */

static uint64_t fnv(uint64_t hash, const char *text) {
  do
    hash = (hash ^ (unsigned char)*text) * 0x100000001b3;
  while (*text++);
  return hash;
}

static uint64_t campaign_hash(const ZpActuatorDef *def) {
  uint64_t hash;
  ck_assert_int_eq(zp_campaign_hash(ZP_STUDY_CALIBRATE, def, &hash, NULL), ZP_OK);
  return hash;
}

/* Version and study, by the definition of the hash; then the bytes of files, whatever their name is. */
TEST(campaigns_are_known_by_version_study_and_files) {
  ZpActuatorDef def = zp_actuator_def_default();
  const uint64_t bare = fnv(fnv(0xcbf29ce484222325, ZP_VERSION), "calibrate");
  ck_assert_uint_eq(campaign_hash(&def), bare);
  snprintf(def.data.file, sizeof def.data.file, "hashed.csv");
  write_file("hashed.csv", "load_g,stroke_mm\n8,10\n");
  const uint64_t first = campaign_hash(&def);
  write_file("hashed.csv", "load_g,stroke_mm\n8,11\n");
  ck_assert(first != bare && campaign_hash(&def) != first && campaign_hash(&def) != bare);
  write_file("hashed.csv", "load_g,stroke_mm\n8,10\n");
  ck_assert_uint_eq(campaign_hash(&def), first);
}

/* A case is known by all its keys but those without a result, and by the case before it. */
TEST(cases_are_known_by_their_keys_and_neighbour) {
  const ZpActuatorDef def = zp_actuator_def_default();
  const uint64_t hash = zp_case_hash(5, &def);
  for (int k = 0; k < 5; k++) {
    ZpActuatorDef other = def;
    if (k == 0) other.load.mass *= 2;
    if (k == 1) snprintf(other.calibrate.fit, sizeof other.calibrate.fit, "load.share");
    if (k == 2) snprintf(other.sensitivity.by, sizeof other.sensitivity.by, "load.share");
    if (k == 3) other.output.plots = !other.output.plots;
    if (k == 4) other.solver.max_cpu_time = 3;
    ck_assert_int_eq(zp_case_hash(5, &other) == hash, k > 2);
  }
  ck_assert(zp_case_hash(6, &def) != hash && zp_case_hash(5, &def) == hash);
}

/* -- campaigns --------------------------------------------------------------------------------------- */

static double one_second_each(void *user) {
  return *(double *)user += 1;
}

/* Runs of a campaign have a clock; its rows keep no series unless a key asks for them; those of the same cases are
 * counted when it is resumed, once they are known to belong to them. */
TEST(campaign_counts_what_it_computes) {
  ZpScenario *scenario = SCENARIO("study=actuate", "drive.voltage=[0, 6 kV, 8 kV]", "mesh.nodes=5", "liquid.model=none",
                                  "solver.end_time=1 ms", "output.errors=false", "output.series=false");
  double seconds = 0;
  const ZpCampaignOptions options = {.jobs = 2, .resume = true, .clock = one_second_each, .user = &seconds};
  mkdir("counted", 0777);
  remove("counted/journal.sqlite");
  for (int again = 0; again < 2; again++) {
    ZpCampaign *c;
    ck_ok(zp_campaign_open(scenario, "counted", &options, &c, &err));
    ck_assert_uint_eq(zp_campaign_count(c), 0);
    ck_ok(zp_campaign_run(c, &err));
    const ZpCampaignState state = zp_campaign_state(c);
    ck_assert(state.done == 3 && state.failed == 0 && state.resumed == (again ? 3 : 0));
    ck_assert_uint_eq(zp_campaign_count(c), 3);
    for (size_t i = 0; i < 3; i++) {
      const ZpResult *row = zp_campaign_rows(c)->get(zp_campaign_rows(c)->user, i);
      ck_assert_double_gt(zp_result_get(row, "real_time_factor"), 0);
      ck_assert_ptr_null(row->series);
    }
    zp_campaign_close(c);
  }
}

/* A failed case that the journal has is a failed one. */
TEST(known_failures_are_failures) {
  ZpScenario *scenario = SCENARIO("study=actuate", "solver.max_steps=[3, 1000000]", "mesh.nodes=5", "liquid.model=none",
                                  "solver.end_time=1 ms", "output.errors=false");
  const ZpCampaignOptions options = {.jobs = 1, .resume = true};
  mkdir("failures", 0777);
  remove("failures/journal.sqlite");
  for (int again = 0; again < 2; again++) {
    ZpCampaign *c;
    ck_assert_int_eq(zp_campaign_open(scenario, "failures", &options, &c, NULL), ZP_OK);
    ck_assert_int_eq(zp_campaign_run(c, NULL), ZP_OK);
    ck_assert(zp_campaign_state(c).failed == 1 && zp_campaign_state(c).done == 2);
    zp_campaign_close(c);
  }
}

/* What another process sends: outcomes, and which numbers are times. */
TEST(results_of_another_process_are_whole) {
  ZpScenario *scenario = SCENARIO("study=actuate", "solver.max_steps=[3, 1000000]", "mesh.nodes=5", "liquid.model=none",
                                  "solver.end_time=1 ms", "output.errors=false");
  ZpResult *result[2];
  unsigned char *byte;
  size_t size;
  ck_assert_int_eq(zp_campaign_compute(scenario, 0, 2, NULL, &byte, &size, NULL), ZP_OK);
  ck_assert(zp_results_read(byte, size, ZP_STUDY_ACTUATE, 2, result));
  ck_assert(result[0]->outcome == ZP_STEP_LIMIT && result[1]->outcome == ZP_REACHED_END);
  for (int k = 0; k < 2; k++) {
    size_t times = 0;
    for (size_t i = 0; i < result[k]->scalars; i++) {
      const ZpScalar *s = &result[k]->scalar[i];
      const bool is_time = strcmp(s->name, "real_time_factor") == 0;
      ck_assert_msg(s->timing == is_time, "%s", s->name);
      times += is_time;
    }
    ck_assert_uint_eq(times, 1);
    zp_result_destroy(result[k]);
  }
  free(byte);
}

/* A batch follows its neighbours within a block only, as a campaign does: the first case of each block is that of a run
 * of its own, to the last bit. The first of another chunk starts from that of the chunk before. */
TEST(blocks_of_a_batch_begin_afresh) {
  ZpScenario *scenario = SCENARIO("study=limits", "liquid.model=none", "load.mass=2 g .. 20 g : 280", "mesh.nodes=31",
                                  "output.errors=false");
  ZpBatch batch;
  ZpError err;
  const size_t chunk = zp_case_chunk(scenario), block = chunk * ZP_BLOCK_CHUNKS;
  ck_assert_uint_eq(chunk, 17);
  ck_assert_int_eq(zp_batch_create(scenario, &batch, &err), ZP_OK);
  size_t followed = 0;
  while (zp_batch_open(&batch)) {
    const size_t i = batch.done;
    ZpResult *alone;
    ck_assert_int_eq(zp_batch_next(&batch, NULL, &err), ZP_OK);
    const double own = zp_result_get(batch.result[i], "warm_starts");
    if (i % block == 0) {
      ck_assert_int_eq(zp_case_run(scenario, i, NULL, NULL, &alone, &err), ZP_OK);
      ck_assert_double_eq(own, 0);
      ck_assert_double_eq(zp_result_get(alone, "max_load_kg"), zp_result_get(batch.result[i], "max_load_kg"));
      zp_result_destroy(alone);
    } else if (i % chunk == 0)
      followed += own > 0;
  }
  ck_assert_uint_gt(followed, 10);
  zp_batch_free(&batch);
}

/* A case starts from the one before it along the fastest list in which it is not the first. The first of a chunk starts
 * from that of the chunk in which this one is, if both are in one block. */
TEST(cases_start_along_every_list) {
  ZpScenario *grid = SCENARIO("study=limits", "ribbon.thickness=80 um .. 120 um : 10", "load.mass=2 g .. 20 g : 10"),
             *long_rows =
                 SCENARIO("study=limits", "ribbon.thickness=80 um .. 120 um : 100", "load.mass=2 g .. 20 g : 100"),
             *odd_rows = SCENARIO("study=limits", "ribbon.thickness=80 um .. 120 um : 3", "load.mass=2 g .. 20 g : 70"),
             *rest = SCENARIO("study=stationary", "load.mass=2 g .. 20 g : 100");
  static const size_t from[][2] = {{0, 0}, {5, 4}, {10, 0}, {19, 18}, {20, 0}, {21, 20}, {30, 20}, {40, 20}};
  size_t last[20];
  ck_assert_uint_eq(zp_case_chunk(grid), 20);
  for (size_t i = 0; i < sizeof from / sizeof from[0]; i++)
    ck_assert_uint_eq(zp_case_neighbour(grid, from[i][0]), from[i][1]);
  zp_case_last(grid, 20, 40, last);
  ck_assert_uint_eq(last[0], 30);
  ck_assert_uint_eq(last[3], 24);
  ck_assert_uint_eq(last[19], 39);
  ck_assert_uint_eq(zp_case_chunk(long_rows), 50);
  ck_assert_uint_eq(zp_case_neighbour(long_rows, 100), 0);
  ck_assert_uint_eq(zp_case_neighbour(long_rows, 150), 100);
  ck_assert_uint_eq(zp_case_neighbour(long_rows, 750), 700);
  ck_assert_uint_eq(zp_case_neighbour(long_rows, 800), 800);
  ck_assert_uint_eq(zp_case_chunk(odd_rows), 18);
  ck_assert_uint_eq(zp_case_neighbour(odd_rows, 70), 54);
  ck_assert_uint_eq(zp_case_neighbour(rest, 1), 1);
}

/* The linker sends these calls of the library here. With several threads the check of the first wrong case waits until
 * the second one has been noted, which ends with a lock that is released. */
enum { FIRST_WRONG = 300, SECOND_WRONG = 650 };
static bool in_turn;
static sem_t noted;
static _Thread_local bool notes;

ZpStatus __real_zp_scenario_def(const ZpScenario *scenario, size_t index, ZpActuatorDef *def, ZpError *err);
ZpStatus __wrap_zp_scenario_def(const ZpScenario *scenario, size_t index, ZpActuatorDef *def, ZpError *err);
int __real_pthread_mutex_unlock(pthread_mutex_t *lock);
int __wrap_pthread_mutex_unlock(pthread_mutex_t *lock);

ZpStatus __wrap_zp_scenario_def(const ZpScenario *scenario, size_t index, ZpActuatorDef *def, ZpError *err) {
  if (in_turn && index == FIRST_WRONG) sem_wait(&noted);
  ZpStatus status = __real_zp_scenario_def(scenario, index, def, err);
  notes = in_turn && index == SECOND_WRONG;
  return status;
}

int __wrap_pthread_mutex_unlock(pthread_mutex_t *lock) {
  int status = __real_pthread_mutex_unlock(lock);
  if (notes) sem_post(&noted);
  notes = false;
  return status;
}

/* Of 700 cases two are wrong: the first is named, for any number of threads. */
TEST(first_wrong_case_is_named) {
  char list[16000] = "platform.length=[";
  for (int i = 0; i < 700; i++)
    snprintf(list + strlen(list), sizeof list - strlen(list), "%s%g mm", i ? ", " : "",
             i == FIRST_WRONG    ? 95.5
             : i == SECOND_WRONG ? 96.5
                                 : 1 + 1e-3 * i);
  strcat(list, "]");
  ZpScenario *scenario = SCENARIO("study=stationary", "mesh.nodes=5", "output.errors=false", list);
  ck_assert_int_eq(sem_init(&noted, 0, 0), 0);
  for (int jobs = 1; jobs <= 3; jobs++) {
    ZpError err;
    in_turn = jobs > 1;
    ck_assert_int_eq(zp_batch_check_jobs(scenario, jobs, &err), ZP_BAD_INPUT);
    ck_assert_msg(strstr(err.message, "95.5") || strstr(err.message, "0.0955"), "%s", err.message);
  }
  in_turn = false;
  sem_destroy(&noted);
}
