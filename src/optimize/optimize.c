/* An optimisation: a search, and its cases as a report, a scenario whose lists vary together. */
#include <zipact/optimize.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/calibrate.h>

#include "base/fail.h"
#include "campaign/case_hash.h"
#include "def/check.h"
#include "io/number.h"
#include "io/report.h"
#include "optimize/search.h"
#include "study/result.h"

struct ZpOptimization {
  ZpSearch search;
  ZpScenario *cases; /* all computed cases */
  size_t samples;    /* of a design, each a row */
  size_t *number;    /* [designs] of those that are done, in the order of the rows */
  size_t designs;
  size_t *best;  /* [optimum.count] places of them, then their first rows */
  double *value; /* [optimum.count][goals] */
  const char *goal[ZP_GOALS_MOST + ZP_BOUNDS_MOST], *statistic[ZP_GOALS_MOST + ZP_BOUNDS_MOST];
  int variable[ZP_VARIABLES_MOST];
  ZpOptimum optimum;
  ZpRows rows;
  ZpReport report;
};

/* -- the search ------------------------------------------------------------------------------------- */

/* Does this result have a derivative of any goal? */
static bool has_derivatives(const ZpProblem *problem, const ZpResult *result) {
  for (size_t g = 0; g < problem->goals; g++)
    for (size_t i = 0; i < result->sensitivities; i++)
      if (strcmp(result->sensitivity[i].output, problem->goal[g].output) == 0 && isfinite(result->sensitivity[i].value))
        return true;
  return false;
}

/* All runs of a search by derivatives have the tolerance of those with derivatives, such as `with`. */
static void share_tolerance(ZpSearch *s, const ZpActuatorDef *with, const ZpResult *result) {
  bool runs = isfinite(zp_result_get(result, "mean_time_step_s"));
  if (runs && s->problem.method == ZP_OPTIMIZER_SLSQP) s->def.solver.tolerance = zp_def_tolerance(with);
}

/* Run the centre of the box to find out which outputs exist, before anything is written. */
static ZpStatus look_ahead(ZpSearch *s, ZpError *err) {
  ZpProblem *p = &s->problem;
  ZpActuatorDef def = {0};
  ZpResult *result = NULL;
  ZpStatus status = zp_def_assign(&def, &s->def, err);
  if (status == ZP_OK) snprintf(def.sensitivity.by, sizeof def.sensitivity.by, "%s", ZP_KEY_NAME(p->variable[0].key));
  if (status == ZP_OK && zp_study_check(s->study, &def, NULL) != ZP_OK) *def.sensitivity.by = 0;
  if (status == ZP_OK) status = zp_data_study_run(s->study, &def, NULL, &result, err);
  if (status == ZP_OK) status = zp_problem_resolve(p, result, err);
  if (status == ZP_OK && p->method == ZP_OPTIMIZER_AUTO)
    p->method = p->objectives > 1            ? ZP_OPTIMIZER_NSGA2
                : has_derivatives(p, result) ? ZP_OPTIMIZER_SLSQP
                                             : ZP_OPTIMIZER_COBYLA;
  if (status == ZP_OK) share_tolerance(s, &def, result);
  zp_def_clear(&def);
  zp_result_destroy(result);
  return status;
}

static void take_old_row(void *user, size_t number, uint64_t hash, bool good) {
  ZpSearch *s = user;
  (void)good;
  if (number < s->room * zp_search_samples(s)) s->old[number] = hash;
}

/* With constraints twice as many cases, as far as the lists of a scenario can hold them. */
static size_t room_of(const ZpProblem *p) {
  const size_t twice = 2 * p->evaluations, most = ZP_LISTED_MOST / p->variables;
  if (p->goals == p->objectives) return p->evaluations;
  return twice < most ? twice : most;
}

/* A search that reads no number but the zip time needs no more of a motion than its first closing. */
static void stop_early(const ZpProblem *p, ZpActuatorDef *def) {
  for (size_t g = 0; g < p->goals; g++)
    if (strcmp(p->goal[g].output, "zip_time_s") != 0) return;
  if (def->solver.stop_when_zipped == ZP_WHEN_AUTO) def->solver.stop_when_zipped = ZP_WHEN_TRUE;
}

static ZpStatus open_search(ZpSearch *s, const char *directory, ZpError *err) {
  ZpError reason;
  ZpStatus status = zp_search_begin(s, err);
  if (status == ZP_OK) stop_early(&s->problem, &s->def);
  if (status == ZP_OK) status = zp_data_check(s->study, &s->def, err);
  if (status == ZP_OK && (status = look_ahead(s, &reason)) != ZP_OK) zp_fail(err, status, "%s", reason.message);
  if (status != ZP_OK) return status;
  const size_t samples = zp_search_samples(s);
  s->room = room_of(&s->problem);
  s->state.cases = s->problem.evaluations * samples;
  s->excluded = NAN;
  s->old = calloc(s->room * samples, sizeof *s->old);
  s->point = calloc(s->room, sizeof *s->point);
  if (!s->old || !s->point) return zp_fail_memory(err);
  status = zp_campaign_hash(s->study, &s->def, &s->start, err);
  if (status == ZP_OK)
    status = zp_journal_open(directory, s->study, s->options->resume, s->room * samples, &s->journal, err);
  return status == ZP_OK ? zp_journal_visit(s->journal, take_old_row, s, err) : status;
}

/* An optimization that can be destroyed; NULL if there is no memory. */
static ZpOptimization *create(void) {
  ZpOptimization *o = calloc(1, sizeof *o);
  if (o && pthread_mutex_init(&o->search.lock, NULL) == 0) return o;
  free(o);
  return NULL;
}

/* A quarter of the cases explores the whole box, the others descend from the best of these. */
static ZpStatus run_search(ZpSearch *s, ZpError *err) {
  if (s->problem.method == ZP_OPTIMIZER_NSGA2) return zp_search_evolve(s, err);
  const size_t sampled = s->problem.evaluations / 4;
  ZpStatus status = zp_search_sample(s, sampled, err);
  return status == ZP_OK && !atomic_load(&s->stop) ? zp_search_local(s, sampled, err) : status;
}

static bool holds(const ZpSearch *s) {
  bool any = false;
  for (size_t i = 0; i < s->room; i++)
    any = any || (s->point[i].done && zp_violation(&s->problem, s->point[i].value) == 0);
  return any;
}

/* Search, and if no feasible case is found, ask whether the box contains one. */
static ZpStatus search_all(ZpSearch *s, ZpError *err) {
  ZpStatus status = run_search(s, err);
  const bool ends = s->room == s->problem.evaluations || atomic_load(&s->stop) || holds(s);
  if (status != ZP_OK || ends) return status;
  s->state.cases = s->state.done + (s->room - s->problem.evaluations) * zp_search_samples(s);
  return zp_search_exclude(s, err);
}

/* -- what was found --------------------------------------------------------------------------------- */

static const ZpPoint *point_of(const ZpOptimization *o, size_t place) {
  return &o->search.point[o->number[place]];
}

/* Does an earlier design of the front have the same objectives? Evolution may try a design twice. */
static bool is_on_front(const ZpOptimization *o, size_t place) {
  const ZpProblem *p = &o->search.problem;
  for (size_t k = 0; k < o->optimum.count; k++)
    if (memcmp(point_of(o, o->best[k])->value, point_of(o, place)->value, p->objectives * sizeof(double)) == 0)
      return true;
  return false;
}

/* Designs that no other one betters or dominates. */
static void find_best(ZpOptimization *o) {
  const ZpProblem *p = &o->search.problem;
  size_t best = 0;
  for (size_t i = 1; i < o->designs; i++)
    if (zp_is_better(p, point_of(o, i)->value, point_of(o, best)->value)) best = i;
  if (o->designs == 0) return;
  o->optimum.feasible = zp_violation(p, point_of(o, best)->value) == 0;
  o->best[o->optimum.count++] = best;
  if (p->objectives == 1 || !o->optimum.feasible) return;
  o->optimum.count = 0;
  for (size_t i = 0; i < o->designs; i++) {
    bool dominated = false;
    for (size_t other = 0; other < o->designs && !dominated; other++)
      dominated = zp_dominates(p, point_of(o, other)->value, point_of(o, i)->value);
    size_t place = o->optimum.count;
    if (dominated || is_on_front(o, i)) continue;
    for (; place > 0 && point_of(o, o->best[place - 1])->value[0] > point_of(o, i)->value[0]; place--)
      o->best[place] = o->best[place - 1];
    o->best[place] = i;
    o->optimum.count++;
  }
}

/* Describe them: their goals and their first rows. */
static void tell_best(ZpOptimization *o) {
  const ZpProblem *p = &o->search.problem;
  for (size_t k = 0; k < o->optimum.count; k++) {
    for (size_t g = 0; g < p->goals; g++)
      o->value[k * p->goals + g] = zp_goal_output(p, g, point_of(o, o->best[k])->value[g]);
    o->best[k] *= o->samples;
  }
  for (size_t g = 0; g < p->goals; g++) {
    o->goal[g] = p->goal[g].output;
    o->statistic[g] = zp_statistic_name[p->goal[g].statistic];
  }
  for (size_t i = 0; i < p->variables; i++)
    o->variable[i] = p->variable[i].key;
  o->optimum.row = o->best;
  o->optimum.variable = o->variable;
  o->optimum.variables = p->variables;
  o->optimum.objective = o->goal;
  o->optimum.objectives = p->objectives;
  o->optimum.constraint = o->goal + p->objectives;
  o->optimum.constraints = p->goals - p->objectives;
  o->optimum.statistic = o->statistic;
  o->optimum.value = o->value;
  o->optimum.samples = o->samples;
}

/* The message if no case satisfies all constraints, with what is known about the designs between the cases. */
static void describe_none(ZpOptimization *o, const char *when) {
  char *text = o->optimum.message;
  const size_t size = sizeof o->optimum.message, cases = o->designs;
  const double excluded = o->optimum.excluded = o->search.excluded;
  if (isnan(excluded))
    snprintf(text, size,
             "%snone of %zu cases satisfies all constraints; the result is the case with the smallest violation", when,
             cases);
  else if (excluded == 1)
    snprintf(text, size,
             "no design in the box satisfies all constraints, unless a constraint changes somewhere more than twice as "
             "fast as between any two of the %zu cases; the result is the case with the smallest violation",
             cases);
  else
    snprintf(text, size,
             "none of %zu cases satisfies all constraints, and %.3g %% of the box is excluded; the result is the case "
             "with the "
             "smallest violation",
             cases, 100 * excluded);
}

static void describe(ZpOptimization *o) {
  const bool stopped = atomic_load(&o->search.stop);
  char *text = o->optimum.message;
  const size_t size = sizeof o->optimum.message, cases = o->designs;
  o->optimum.outcome = stopped ? ZP_INTERRUPTED : ZP_CONVERGED;
  o->optimum.excluded = NAN;
  const char *when = stopped ? "so far, " : "";
  if (!o->optimum.feasible)
    describe_none(o, when);
  else if (o->search.problem.objectives > 1)
    snprintf(text, size, "%s%zu of %zu cases are on the Pareto front", when, o->optimum.count, cases);
  else
    snprintf(text, size, "%sthe best of %zu cases", when, cases);
}

/* "KEY=[value, ...]" with the values of all designs, to be freed. */
static char *list_of(const ZpOptimization *o, size_t variable) {
  const ZpInterval *v = &o->search.problem.variable[variable];
  char *text = NULL, value[ZP_NUMBER_SIZE];
  size_t size;
  FILE *stream = open_memstream(&text, &size);
  if (!stream) return NULL;
  fprintf(stream, "%s=[", ZP_KEY_NAME(v->key));
  for (size_t i = 0; i < o->designs; i++) {
    zp_number_print(zp_variable_value(v, point_of(o, i)->z[variable]), value, sizeof value);
    fprintf(stream, "%s%s", i ? ", " : "", value);
  }
  fputc(']', stream);
  if (fclose(stream) == 0) return text;
  free(text);
  return NULL;
}

/* "sampling.together=KEY,KEY" */
static void name_variables(const ZpProblem *p, char *text, size_t size) {
  size_t used = (size_t)snprintf(text, size, "sampling.together=\"");
  for (size_t i = 0; i < p->variables && used < size; i++)
    used += (size_t)snprintf(text + used, size - used, "%s%s", ZP_KEY_NAME(p->variable[i].key),
                             i + 1 < p->variables ? "," : "\"");
}

/* The scenario of all computed cases. */
static ZpStatus list_cases(ZpOptimization *o, ZpError *err) {
  const ZpProblem *p = &o->search.problem;
  char together[ZP_TEXT_SIZE + 32], *text;
  size_t size;
  name_variables(p, together, sizeof together);
  ZpStatus status = zp_scenario_text(o->search.scenario, &text, &size, err);
  if (status == ZP_OK) status = zp_scenario_parse(o->cases, text, size, "scenario.yaml", err);
  free(text);
  if (status == ZP_OK) status = zp_scenario_set(o->cases, together, err);
  for (size_t i = 0; i < p->variables && status == ZP_OK; i++) {
    char *list = list_of(o, i);
    status = list ? zp_scenario_set(o->cases, list, err) : zp_fail_memory(err);
    free(list);
  }
  return status;
}

static const ZpResult *get_row(void *user, size_t index) {
  ZpOptimization *o = user;
  return zp_journal_get(o->search.journal, o->number[index / o->samples] * o->samples + index % o->samples);
}

static ZpStatus get_status(void *user, ZpError *err) {
  return zp_journal_status(((ZpOptimization *)user)->search.journal, err);
}

static ZpStatus report(ZpOptimization *o, ZpError *err) {
  const ZpSearch *s = &o->search;
  o->number = calloc(s->room, sizeof *o->number);
  o->best = calloc(s->room, sizeof *o->best);
  o->value = calloc(s->room * s->problem.goals, sizeof *o->value);
  o->cases = zp_scenario_create();
  if (!o->number || !o->best || !o->value || !o->cases) return zp_fail_memory(err);
  o->samples = zp_search_samples(s);
  o->rows = (ZpRows){.get = get_row, .status = get_status, .user = o};
  o->report = (ZpReport){.scenario = o->cases, .rows = &o->rows, .optimum = &o->optimum};
  for (size_t i = 0; i < s->room; i++)
    if (s->point[i].done) o->number[o->designs++] = i;
  o->report.count = o->designs * o->samples;
  find_best(o);
  describe(o);
  tell_best(o);
  if (o->report.count == 0) return zp_fail(err, ZP_MACHINE, "interrupted before the first case");
  return list_cases(o, err);
}

static ZpStatus optimize(ZpOptimization *o, const char *directory, ZpError *err) {
  ZpSearch *s = &o->search;
  ZpStatus status = open_search(s, directory, err);
  if (status == ZP_OK) status = search_all(s, err);
  if (status == ZP_OK) status = zp_journal_commit(s->journal, err);
  if (status == ZP_OK && !atomic_load(&s->stop)) status = zp_journal_finish(s->journal, err);
  return status == ZP_OK ? report(o, err) : status;
}

ZpStatus zp_optimize(const ZpScenario *scenario, const char *directory, const ZpCampaignOptions *options,
                     ZpOptimization **out, ZpError *err) {
  ZpOptimization *o = *out = create();
  if (!o) return zp_fail_memory(err);
  o->search.scenario = scenario;
  o->search.options = options;
  ZpStatus status = optimize(o, directory, err);
  if (status == ZP_OK) return ZP_OK;
  zp_optimization_destroy(o);
  *out = NULL;
  return status;
}

const ZpReport *zp_optimization_report(const ZpOptimization *optimization) {
  return &optimization->report;
}

ZpCampaignState zp_optimization_state(const ZpOptimization *optimization) {
  return optimization->search.state;
}

void zp_optimization_destroy(ZpOptimization *o) {
  if (!o) return;
  zp_search_end(&o->search);
  zp_journal_close(o->search.journal);
  zp_scenario_destroy(o->cases);
  pthread_mutex_destroy(&o->search.lock);
  free(o->search.old);
  free(o->search.point);
  free(o->number);
  free(o->best);
  free(o->value);
  free(o);
}
