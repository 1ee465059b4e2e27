#include "optimize/search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <zipact/calibrate.h>

#include "base/fail.h"
#include "campaign/case_hash.h"
#include "def/check.h"
#include "fit/case.h"
#include "io/number.h"
#include "io/plan.h"
#include "io/report.h"
#include "sample/design.h"
#include "study/result.h"

/* Interval of progress messages; longest time until rows are committed, ms. */
enum { PULSE = 100, COMMIT_AFTER = 500 };

static double now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return 1e3 * (double)time.tv_sec + 1e-6 * (double)time.tv_nsec;
}

static void fail(ZpSearch *s, const ZpError *err) {
  pthread_mutex_lock(&s->lock);
  if (s->err.status == ZP_OK) s->err = *err;
  pthread_mutex_unlock(&s->lock);
  atomic_store(&s->stop, true);
}

/* -- samples ---------------------------------------------------------------------------------------- */

/* The values of the variables are ignored; no other key has a list. */
static ZpStatus check_lists(const ZpSearch *s, ZpError *err) {
  size_t keys;
  const int *key = zp_scenario_lists(s->scenario, &keys);
  for (size_t k = 0; k < keys; k++) {
    bool is_variable = false;
    for (size_t i = 0; i < s->problem.variables; i++)
      is_variable = is_variable || s->problem.variable[i].key == key[k];
    if (!is_variable && !zp_scenario_spread(s->scenario, key[k]))
      return zp_fail(err, ZP_BAD_INPUT, "%s: optimize takes one value or a distribution, not a list",
                     ZP_KEY_NAME(key[k]));
  }
  return ZP_OK;
}

static ZpStatus set_centre(ZpScenario *scenario, const ZpInterval *variable, ZpError *err) {
  char value[ZP_NUMBER_SIZE], text[ZP_PATH_SIZE + ZP_NUMBER_SIZE];
  zp_number_print(zp_variable_value(variable, 0.5), value, sizeof value);
  snprintf(text, sizeof text, "%s=%s", ZP_KEY_NAME(variable->key), value);
  return zp_scenario_set(scenario, text, err);
}

static ZpStatus make_samples(ZpSearch *s, ZpError *err) {
  char *text;
  size_t size;
  s->samples = zp_scenario_create();
  if (!s->samples) return zp_fail_memory(err);
  ZpStatus status = zp_scenario_text(s->scenario, &text, &size, err);
  if (status == ZP_OK) status = zp_scenario_parse(s->samples, text, size, "scenario.yaml", err);
  free(text);
  for (size_t i = 0; i < s->problem.variables && status == ZP_OK; i++)
    status = set_centre(s->samples, &s->problem.variable[i], err);
  return status == ZP_OK ? zp_scenario_set(s->samples, "sampling.together=\"\"", err) : status;
}

size_t zp_search_samples(const ZpSearch *s) {
  return zp_scenario_count(s->samples);
}

static ZpStatus check_samples(const ZpSearch *s, ZpError *err) {
  const size_t samples = zp_search_samples(s), most = ZP_CASES_MOST / (2 * samples);
  for (size_t g = 0; g < s->problem.goals && !zp_scenario_design(s->samples); g++)
    if (s->problem.goal[g].named)
      return zp_fail(err, ZP_BAD_INPUT, "%s: %s.%s: no key has a distribution",
                     g < s->problem.objectives ? "optimize.objective" : "optimize.constraints",
                     s->problem.goal[g].output, zp_statistic_name[s->problem.goal[g].statistic]);
  if (s->problem.evaluations > most)
    return zp_fail(err, ZP_BAD_INPUT, "optimize.evaluations: with %zu samples of each design at most %zu", samples,
                   most);
  return ZP_OK;
}

ZpStatus zp_search_begin(ZpSearch *s, ZpError *err) {
  ZpStatus status = zp_scenario_def(s->scenario, 0, &s->def, err);
  s->study = zp_scenario_study(s->scenario);
  if (status == ZP_OK) status = zp_problem_read(&s->def, &s->problem, err);
  if (status == ZP_OK) status = check_lists(s, err);
  if (status == ZP_OK) status = make_samples(s, err);
  if (status == ZP_OK) status = check_samples(s, err);
  return status == ZP_OK ? zp_scenario_def(s->samples, 0, &s->def, err) : status;
}

void zp_search_end(ZpSearch *s) {
  zp_def_clear(&s->def);
  zp_scenario_destroy(s->samples);
}

/* -- one case --------------------------------------------------------------------------------------- */

/* Outputs of the samples of a design, and the values of its drawn keys. */
typedef struct Sheet {
  ZpSample *sample; /* [goals][variables][samples] of the outputs, with derivatives by the keys */
  double *drawn;    /* values of the drawn keys of a sample */
} Sheet;

static bool open_sheet(const ZpSearch *s, Sheet *sheet) {
  size_t keys;
  zp_scenario_lists(s->samples, &keys);
  const size_t count = s->problem.goals * s->problem.variables * zp_search_samples(s);
  *sheet = (Sheet){calloc(count + 1, sizeof *sheet->sample), calloc(keys + 1, sizeof *sheet->drawn)};
  return sheet->sample && sheet->drawn;
}

static void close_sheet(Sheet *sheet) {
  free(sheet->sample);
  free(sheet->drawn);
}

static ZpSample *samples_of(const ZpSearch *s, const Sheet *sheet, size_t goal, size_t variable) {
  return sheet->sample + (goal * s->problem.variables + variable) * zp_search_samples(s);
}

/* False if the values contradict each other; then the run reports the reason. */
static ZpStatus define(const ZpSearch *s, const double *z, size_t sample, const Sheet *sheet, ZpActuatorDef *def,
                       ZpError *err) {
  ZpStatus status = zp_def_assign(def, &s->def, err);
  size_t used = 0, keys;
  const int *key = zp_scenario_lists(s->samples, &keys);
  zp_scenario_values(s->samples, sample, sheet->drawn);
  for (size_t k = 0; k < keys && status == ZP_OK; k++)
    status = zp_def_set(def, key[k], sheet->drawn[k], err);
  for (size_t i = 0; i < s->problem.variables && status == ZP_OK; i++) {
    const ZpInterval *v = &s->problem.variable[i];
    status = zp_def_set(def, v->key, zp_variable_value(v, z[i]), err);
    if (s->derivatives && used < sizeof def->sensitivity.by)
      used += (size_t)snprintf(def->sensitivity.by + used, sizeof def->sensitivity.by - used, "%s%s", i ? "," : "",
                               ZP_KEY_NAME(v->key));
  }
  return status;
}

static double slope_of(const ZpResult *result, const char *output, int key) {
  for (size_t i = 0; i < result->sensitivities; i++)
    if (result->sensitivity[i].key == key && strcmp(result->sensitivity[i].output, output) == 0)
      return result->sensitivity[i].value;
  return NAN;
}

/* The outputs of a result. A case without results has none. */
static void look(const ZpSearch *s, const ZpResult *result, size_t sample, const Sheet *sheet) {
  const ZpProblem *p = &s->problem;
  const bool good = zp_outcome_good(result->outcome);
  for (size_t g = 0; g < p->goals; g++) {
    const double value = good ? zp_result_get(result, p->goal[g].output) : (double)NAN;
    for (size_t i = 0; i < p->variables; i++)
      samples_of(s, sheet, g, i)[sample] = (ZpSample){isnan(value) ? zp_goal_worst(&p->goal[g]) : value,
                                                      slope_of(result, p->goal[g].output, p->variable[i].key)};
  }
}

/* The statistic of a goal and its derivative by a key. */
static ZpSample judge(const ZpSearch *s, const Sheet *sheet, size_t goal, size_t variable) {
  const ZpDesign *design = zp_scenario_design(s->samples);
  ZpSample *sample = samples_of(s, sheet, goal, variable);
  size_t count = 0;
  for (size_t i = 0; i < zp_search_samples(s); i++)
    if (!design || zp_design_is_drawn(design, i)) sample[count++] = sample[i];
  return zp_statistic(s->problem.goal[goal].statistic, sample, count);
}

/* The goals of a design, all of whose samples have been looked at. */
static void conclude(const ZpSearch *s, const Sheet *sheet, ZpPoint *point) {
  const ZpProblem *p = &s->problem;
  for (size_t g = 0; g < p->goals; g++)
    for (size_t i = 0; i < p->variables; i++) {
      const ZpSample number = judge(s, sheet, g, i);
      point->value[g] = isfinite(number.value) ? zp_goal_value(p, g, number.value) : (double)NAN;
      point->slope[g][i] = zp_goal_slope(p, g) * number.slope * zp_variable_slope(&p->variable[i], point->z[i]);
    }
  point->done = true;
}

static bool on_progress(void *user, const char *stage, double fraction) {
  (void)stage, (void)fraction;
  return atomic_load(&((ZpSearch *)user)->stop);
}

static double read_clock(void *user) {
  const ZpCampaignOptions *options = ((ZpSearch *)user)->options;
  return options->clock(options->user);
}

/* Run a case => its result, without a series. */
static ZpStatus run(ZpSearch *s, const ZpActuatorDef *def, ZpResult **result, ZpError *err) {
  const ZpHooks hooks = {s, on_progress, s->options->clock ? read_clock : NULL};
  ZpError why;
  ZpStatus status = zp_data_study_run(s->study, def, &hooks, result, &why);
  if (status == ZP_BAD_INPUT) { /* values that contradict each other */
    *result = zp_case_impossible(s->study, &why);
    return *result ? ZP_OK : zp_fail_memory(err);
  }
  if (status != ZP_OK) return zp_fail(err, status, "%s", why.message);
  zp_table_destroy((*result)->series);
  (*result)->series = NULL;
  return ZP_OK;
}

static ZpStatus commit_if_due(ZpSearch *s, ZpError *err) {
  if (now() - s->committed < COMMIT_AFTER) return ZP_OK;
  s->committed = now();
  return zp_journal_commit(s->journal, err);
}

/* Count a finished case; requires the lock. */
static void count(ZpSearch *s, const ZpResult *result, bool resumed) {
  s->state.done++;
  s->state.resumed += resumed;
  s->state.failed += !zp_outcome_good(result->outcome);
}

/* The row of an earlier process, if it belongs to this case. */
static bool take_row(ZpSearch *s, size_t row, uint64_t hash, size_t sample, const Sheet *sheet) {
  if (s->old[row] != hash) return false;
  pthread_mutex_lock(&s->lock);
  const ZpResult *result = zp_journal_get(s->journal, row);
  const bool found = zp_journal_status(s->journal, NULL) == ZP_OK;
  if (found) look(s, result, sample, sheet);
  if (found) count(s, result, true);
  pthread_mutex_unlock(&s->lock);
  return found;
}

static ZpStatus put_row(ZpSearch *s, size_t row, uint64_t hash, const ZpResult *result, ZpError *err) {
  ZpPacked *packed = zp_packed_of(result);
  pthread_mutex_lock(&s->lock);
  ZpStatus status = packed ? zp_journal_put(s->journal, row, hash, packed, err) : zp_fail_memory(err);
  if (status == ZP_OK) status = commit_if_due(s, err);
  if (status == ZP_OK) count(s, result, false);
  pthread_mutex_unlock(&s->lock);
  free(packed);
  return status;
}

/* Compute a sample of a design, or take its row from the journal. False if the search must stop. */
static bool compute(ZpSearch *s, size_t number, const double *z, size_t sample, const Sheet *sheet) {
  const size_t row = number * zp_search_samples(s) + sample;
  ZpActuatorDef def = {0};
  ZpResult *result = NULL;
  ZpError err;
  if (atomic_load(&s->stop)) return false;
  ZpStatus status = define(s, z, sample, sheet, &def, &err);
  const uint64_t hash = status == ZP_OK ? zp_case_hash(s->start, &def) : 0;
  const bool known = status == ZP_OK && take_row(s, row, hash, sample, sheet);
  if (status == ZP_OK && !known) status = run(s, &def, &result, &err);
  zp_def_clear(&def);
  if (known) return true;
  const bool interrupted = status == ZP_OK && (result->outcome == ZP_INTERRUPTED || atomic_load(&s->stop));
  if (status == ZP_OK && !interrupted) status = put_row(s, row, hash, result, &err);
  if (status == ZP_OK && !interrupted) look(s, result, sample, sheet);
  zp_result_destroy(result);
  if (status != ZP_OK) fail(s, &err);
  return status == ZP_OK && !interrupted;
}

bool zp_search_evaluate(ZpSearch *s, size_t number, const double *z) {
  Sheet sheet;
  ZpError err;
  const size_t samples = zp_search_samples(s);
  const bool memory = open_sheet(s, &sheet);
  size_t sample = 0;
  memcpy(s->point[number].z, z, s->problem.variables * sizeof *z);
  while (memory && sample < samples && compute(s, number, z, sample, &sheet))
    sample++;
  if (sample == samples) conclude(s, &sheet, &s->point[number]);
  if (!memory) {
    zp_fail_memory(&err);
    fail(s, &err);
  }
  close_sheet(&sheet);
  return sample == samples;
}

/* -- several threads -------------------------------------------------------------------------------- */

typedef struct Crew {
  ZpSearch *search;
  void (*work)(void *user, size_t index);
  void *user;
  size_t count;
  atomic_size_t next, busy;
} Crew;

static void *labour(void *user) {
  Crew *crew = user;
  for (size_t i; !atomic_load(&crew->search->stop) && (i = atomic_fetch_add(&crew->next, 1)) < crew->count;)
    crew->work(crew->user, i);
  atomic_fetch_sub(&crew->busy, 1);
  return NULL;
}

/* Report progress until all searches have ended. */
static void look_around(ZpSearch *s, Crew *crew) {
  const ZpCampaignOptions *o = s->options;
  const struct timespec pause = {.tv_nsec = 2000000};
  for (double told = 0; atomic_load(&crew->busy) > 0; nanosleep(&pause, NULL)) {
    if (now() - told < PULSE) continue;
    told = now();
    pthread_mutex_lock(&s->lock);
    ZpCampaignState state = s->state;
    pthread_mutex_unlock(&s->lock);
    state.fraction = (double)state.done / (double)state.cases;
    if (o->progress && o->progress(o->user, &state)) atomic_store(&s->stop, true);
  }
}

ZpStatus zp_search_parallel(ZpSearch *s, size_t count, void (*work)(void *user, size_t index), void *user,
                            ZpError *err) {
  const size_t jobs = (size_t)(s->options->jobs > 0 ? s->options->jobs : zp_processors());
  const size_t most = jobs < count ? jobs : count;
  Crew crew = {.search = s, .work = work, .user = user, .count = count};
  pthread_t *thread = calloc(most + 1, sizeof *thread);
  size_t started = 0;
  atomic_store(&crew.busy, most);
  while (thread && started < most && pthread_create(&thread[started], NULL, labour, &crew) == 0)
    started++;
  atomic_fetch_sub(&crew.busy, most - started);
  look_around(s, &crew);
  for (size_t i = 0; i < started; i++)
    pthread_join(thread[i], NULL);
  free(thread);
  if (started == 0 && most > 0) return zp_fail(err, ZP_MACHINE, "no thread could be started");
  return s->err.status == ZP_OK ? ZP_OK : zp_fail(err, s->err.status, "%s", s->err.message);
}

/* -- points that fill the box ----------------------------------------------------------------------- */

static void sample(void *user, size_t index) {
  ZpSearch *s = user;
  double z[ZP_VARIABLES_MOST] = {0};
  const ZpDesign design = {.method = ZP_SAMPLING_SOBOL,
                           .count = s->problem.evaluations,
                           .seed = (uint32_t)s->def.sampling.seed,
                           .dimensions = (int)s->problem.variables};
  for (size_t i = 0; i < s->problem.variables; i++)
    z[i] = zp_design_share(&design, index, (int)i);
  zp_search_evaluate(s, index, z);
}

ZpStatus zp_search_sample(ZpSearch *s, size_t count, ZpError *err) {
  return zp_search_parallel(s, count, sample, s, err);
}
