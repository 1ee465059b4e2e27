#include "optimize/problem.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "def/check.h"
#include "io/range.h"
#include "io/units.h"
#include "io/value.h"
#include "study/result.h"

/* A constraint that is violated by such a small fraction is satisfied: a search ends on it, up to rounding. */
static const double slack = 1e-6;

/* Violation that stands for a missing output: larger than any other. */
static const double missing = 1e3;

/* -- reading ---------------------------------------------------------------------------------------- */

static ZpStatus check_variable(const ZpProblem *problem, const ZpInterval *v, ZpError *err) {
  const char *name = ZP_KEY_NAME(v->key);
  for (size_t i = 0; i < problem->variables; i++)
    if (problem->variable[i].key == v->key)
      return zp_fail(err, ZP_BAD_INPUT, "optimize.variables: %s is named twice", name);
  if (problem->variables == ZP_VARIABLES_MOST)
    return zp_fail(err, ZP_BAD_INPUT, "optimize.variables: more than %d keys", ZP_VARIABLES_MOST);
  return ZP_OK;
}

/* "ribbon.thickness = 20 um .. 200 um log" */
static ZpStatus read_variable(char *text, ZpProblem *problem, ZpError *err) {
  ZpInterval v;
  ZpStatus status = zp_interval_read("optimize.variables", text, &v, err);
  if (status == ZP_OK) status = check_variable(problem, &v, err);
  if (status == ZP_OK) problem->variable[problem->variables++] = v;
  return status;
}

/* "max_load_kg.quantile_05" => the output, and its statistic. Without one, an objective takes the mean, and a
 * constraint holds for 95 of 100 samples. */
static void take_statistic(ZpGoal *goal, bool is_bound) {
  char *point = strrchr(goal->output, '.');
  goal->statistic = !is_bound ? ZP_MEAN : goal->sign < 0 ? ZP_QUANTILE_05 : ZP_QUANTILE_95;
  for (int k = 0; k < ZP_STATISTICS && point && !goal->named; k++) {
    if (strcmp(point + 1, zp_statistic_name[k]) != 0) continue;
    goal->statistic = (ZpStatistic)k;
    goal->named = true;
  }
  if (point && goal->named) *point = 0;
}

/* `bound`: the text of a constraint's; NULL: the goal is an objective. */
static ZpStatus add_goal(ZpProblem *problem, const char *key, const char *output, const char *bound, double sign,
                         size_t most, ZpError *err) {
  ZpGoal *goal = &problem->goal[problem->goals];
  if (problem->goals == most) return zp_fail(err, ZP_BAD_INPUT, "%s: more than %zu", key, most);
  if (strlen(output) >= sizeof goal->output || (bound && strlen(bound) >= sizeof goal->bound_text))
    return zp_fail(err, ZP_BAD_INPUT, "%s: \"%.80s\" is too long", key, output);
  *goal = (ZpGoal){.sign = sign};
  snprintf(goal->output, sizeof goal->output, "%s", output);
  if (bound) snprintf(goal->bound_text, sizeof goal->bound_text, "%s", bound);
  take_statistic(goal, bound != NULL);
  problem->goals++;
  return ZP_OK;
}

/* "min mass_kg" */
static ZpStatus read_objective(char *text, ZpProblem *problem, ZpError *err) {
  char *word = zp_trim(text), *blank = strpbrk(word, " \t");
  const bool least = strncmp(word, "min ", 4) == 0;
  if (!blank || (!least && strncmp(word, "max ", 4) != 0) || strpbrk(zp_trim(blank), " \t"))
    return zp_fail(err, ZP_BAD_INPUT, "optimize.objective: \"%.80s\": write \"min mass_kg\" or \"max max_load_kg\"",
                   word);
  ZpStatus status = add_goal(problem, "optimize.objective", zp_trim(blank), NULL, least ? 1 : -1, ZP_GOALS_MOST, err);
  problem->objectives = problem->goals;
  return status;
}

/* "travel_m >= 15 mm" */
static ZpStatus read_constraint(char *text, ZpProblem *problem, ZpError *err) {
  char *sign = strpbrk(text, "<>");
  if (!sign || sign[1] != '=')
    return zp_fail(err, ZP_BAD_INPUT, "optimize.constraints: \"%.80s\": write \"travel_m >= 15 mm\"", zp_trim(text));
  const double direction = *sign == '<' ? 1 : -1;
  *sign = 0;
  return add_goal(problem, "optimize.constraints", zp_trim(text), zp_trim(sign + 2), direction,
                  problem->objectives + ZP_BOUNDS_MOST, err);
}

/* Read the parts of a text, separated by semicolons. */
static ZpStatus read_all(const char *text, ZpStatus (*read)(char *text, ZpProblem *problem, ZpError *err),
                         ZpProblem *problem, ZpError *err) {
  char copy[ZP_TEXT_SIZE], *rest = copy;
  ZpStatus status = ZP_OK;
  snprintf(copy, sizeof copy, "%s", text);
  for (char *part = strsep(&rest, ";"); part && status == ZP_OK; part = strsep(&rest, ";"))
    if (*zp_trim(part)) status = read(part, problem, err);
  return status;
}

ZpStatus zp_problem_read(const ZpActuatorDef *def, ZpProblem *problem, ZpError *err) {
  *problem = (ZpProblem){.method = def->optimize.method, .evaluations = (size_t)def->optimize.evaluations};
  ZpStatus status = read_all(def->optimize.variables, read_variable, problem, err);
  if (status == ZP_OK) status = read_all(def->optimize.objective, read_objective, problem, err);
  if (status == ZP_OK) status = read_all(def->optimize.constraints, read_constraint, problem, err);
  if (status != ZP_OK) return status;
  if (problem->variables == 0)
    return zp_fail(err, ZP_BAD_INPUT, "optimize.variables: empty; write \"ribbon.thickness = 20 um .. 200 um\"");
  if (problem->objectives == 0) return zp_fail(err, ZP_BAD_INPUT, "optimize.objective: empty; write \"min mass_kg\"");
  if (problem->objectives > 1 && problem->method != ZP_OPTIMIZER_AUTO && problem->method != ZP_OPTIMIZER_NSGA2)
    return zp_fail(err, ZP_BAD_INPUT, "optimize.method: several objectives require nsga2 or auto");
  if (problem->evaluations * problem->variables > ZP_LISTED_MOST)
    return zp_fail(err, ZP_BAD_INPUT, "optimize.evaluations: with %zu variables at most %zu", problem->variables,
                   ZP_LISTED_MOST / problem->variables);
  return ZP_OK;
}

/* -- outputs ---------------------------------------------------------------------------------------- */

static ZpStatus read_bound(ZpGoal *goal, const ZpScalar *scalar, ZpError *err) {
  ZpError reason = {ZP_BAD_INPUT, "not a number"};
  ZpStatus status = zp_quantity_read(goal->bound_text, scalar->unit, &goal->bound, &reason);
  if (status == ZP_OK && isfinite(goal->bound)) return ZP_OK;
  return zp_fail(err, reason.status, "optimize.constraints: %s: \"%s\": %.200s", goal->output, goal->bound_text,
                 reason.message);
}

static const ZpScalar *find_output(const ZpResult *result, const char *name, size_t length) {
  for (size_t i = 0; i < result->scalars; i++)
    if (strncmp(result->scalar[i].name, name, length) == 0 && !result->scalar[i].name[length])
      return result->scalar[i].timing ? NULL : &result->scalar[i];
  return NULL;
}

/* A goal that is no output of the study; it may be one with a statistic that there is not. */
static ZpStatus refuse_output(const char *key, const char *name, const ZpResult *result, ZpError *err) {
  const char *point = strrchr(name, '.');
  if (!point || !find_output(result, name, (size_t)(point - name)))
    return zp_fail(err, ZP_BAD_INPUT, "%s: %s is not an output of study %s; summary.json lists its outputs", key, name,
                   zp_study_name(result->study));
  char known[160] = "";
  for (int k = 0; k < ZP_STATISTICS; k++) {
    const size_t used = strlen(known);
    snprintf(known + used, sizeof known - used, "%s%s", k ? ", " : "", zp_statistic_name[k]);
  }
  return zp_fail(err, ZP_BAD_INPUT, "%s: %s: there is no statistic %s; write one of %s", key, name, point + 1, known);
}

ZpStatus zp_problem_resolve(ZpProblem *problem, const ZpResult *result, ZpError *err) {
  for (size_t g = 0; g < problem->goals; g++) {
    const bool is_bound = g >= problem->objectives;
    const char *key = is_bound ? "optimize.constraints" : "optimize.objective";
    const char *name = problem->goal[g].output;
    const ZpScalar *output = find_output(result, name, strlen(name));
    if (!output) return refuse_output(key, name, result, err);
    ZpStatus status = is_bound ? read_bound(&problem->goal[g], output, err) : ZP_OK;
    if (status != ZP_OK) return status;
  }
  return ZP_OK;
}

/* -- points ----------------------------------------------------------------------------------------- */

double zp_variable_value(const ZpInterval *v, double z) {
  if (z <= 0) return v->from;
  if (z >= 1) return v->to;
  return zp_rounded(v->by_factors ? v->from * pow(v->to / v->from, z) : v->from + (v->to - v->from) * z);
}

double zp_variable_slope(const ZpInterval *v, double z) {
  return v->by_factors ? v->from * pow(v->to / v->from, z) * log(v->to / v->from) : v->to - v->from;
}

double zp_goal_slope(const ZpProblem *problem, size_t goal) {
  const ZpGoal *g = &problem->goal[goal];
  return goal < problem->objectives || g->bound == 0 ? g->sign : g->sign / fabs(g->bound);
}

double zp_goal_value(const ZpProblem *problem, size_t goal, double output) {
  return zp_goal_slope(problem, goal) * (output - problem->goal[goal].bound);
}

double zp_goal_output(const ZpProblem *problem, size_t goal, double value) {
  return value / zp_goal_slope(problem, goal) + problem->goal[goal].bound;
}

double zp_goal_worst(const ZpGoal *goal) {
  return goal->sign * INFINITY;
}

double zp_violation(const ZpProblem *problem, const double *value) {
  double sum = 0;
  for (size_t g = 0; g < problem->goals; g++) {
    if (isnan(value[g]))
      sum += missing;
    else if (g >= problem->objectives && value[g] > slack)
      sum += value[g];
  }
  return sum;
}

bool zp_is_better(const ZpProblem *problem, const double *value, const double *than) {
  const double missed = zp_violation(problem, value), missed_than = zp_violation(problem, than);
  return missed == 0 && missed_than == 0 ? value[0] < than[0] : missed < missed_than;
}

bool zp_dominates(const ZpProblem *problem, const double *value, const double *other) {
  const double missed = zp_violation(problem, value), missed_other = zp_violation(problem, other);
  bool better = false;
  if (missed > 0 || missed_other > 0) return missed < missed_other;
  for (size_t g = 0; g < problem->objectives; g++) {
    if (value[g] > other[g]) return false;
    better = better || value[g] < other[g];
  }
  return better;
}
