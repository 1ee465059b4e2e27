/* Searches by NLopt: each from its own start, in its own thread, so that the order of its cases is independent of the
 * others. Each search has its share of the cases; a repeated point costs none. SLSQP takes derivatives from the study
 * if it has them, otherwise from finite differences, one case per variable. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <nlopt.h>

#include "base/fail.h"
#include "optimize/search.h"

enum { STARTS = 4 };

/* In units of the range of a variable: the step of a finite difference, far above the tolerance of an equilibrium; the
 * smallest distance between two starts; and the tolerance at which a search ends. */
static const double difference = 1e-3, apart = 0.15, narrow = 1e-4;

/* Value that stands for a missing output: a large violation. */
static const double not_there = 1;

typedef struct Local {
  ZpSearch *search;
  size_t first, count, used; /* number of its cases */
  double z[ZP_VARIABLES_MOST];
  double scale; /* of the objective */
  nlopt_opt opt;
} Local;

/* The case at z: an earlier one, otherwise a new one; NULL if no cases are left. */
static const ZpPoint *find(Local *local, const double *z) {
  ZpSearch *s = local->search;
  const size_t size = s->problem.variables * sizeof *z;
  for (size_t i = 0; i < local->used; i++)
    if (memcmp(s->point[local->first + i].z, z, size) == 0) return &s->point[local->first + i];
  if (local->used == local->count) return NULL;
  const size_t number = local->first + local->used;
  if (!zp_search_evaluate(s, number, z)) return NULL;
  local->used++;
  return &s->point[number];
}

/* Scaled for NLopt, and with a number for a missing output. */
static double shown(const Local *local, size_t goal, double value) {
  const bool is_objective = goal < local->search->problem.objectives;
  if (isnan(value)) return is_objective ? 1e3 : not_there;
  return is_objective ? value / local->scale : value;
}

/* Derivatives of a goal at a point. False if no cases are left for finite differences. */
static bool differentiate(Local *local, const ZpPoint *at, size_t goal, double *gradient) {
  const ZpProblem *p = &local->search->problem;
  const double unit = goal < p->objectives ? local->scale : 1;
  for (size_t i = 0; i < p->variables; i++) {
    double z[ZP_VARIABLES_MOST];
    gradient[i] = at->slope[goal][i] / unit;
    if (isfinite(gradient[i])) continue;
    memcpy(z, at->z, sizeof z);
    z[i] += z[i] + difference <= 1 ? difference : -difference;
    const double step = z[i] - at->z[i], value = at->value[goal];
    const ZpPoint *near = find(local, z);
    if (!near) return false;
    gradient[i] = (near->value[goal] - value) / step / unit;
    if (!isfinite(gradient[i])) gradient[i] = 0;
  }
  return true;
}

static double goal_at(Local *local, size_t goal, const double *z, double *gradient) {
  const ZpPoint *point = find(local, z);
  if (point && (!gradient || differentiate(local, point, goal, gradient)))
    return shown(local, goal, point->value[goal]);
  nlopt_force_stop(local->opt);
  return HUGE_VAL;
}

/* An nlopt_func. */
static double objective(unsigned n, const double *z, double *gradient, void *user) {
  (void)n;
  return goal_at(user, 0, z, gradient);
}

typedef struct Bound {
  Local *local;
  size_t goal;
} Bound;

/* An nlopt_func: at most 0 if the constraint is satisfied. */
static double constraint(unsigned n, const double *z, double *gradient, void *user) {
  const Bound *bound = user;
  (void)n;
  return goal_at(bound->local, bound->goal, z, gradient);
}

static void search_from(void *user, size_t index) {
  Local *local = (Local *)user + index;
  const ZpProblem *p = &local->search->problem;
  const bool slopes = p->method == ZP_OPTIMIZER_SLSQP;
  Bound bound[ZP_BOUNDS_MOST];
  double best;
  local->opt = nlopt_create(slopes ? NLOPT_LD_SLSQP : NLOPT_LN_COBYLA, (unsigned)p->variables);
  if (!local->opt) return; /* the other searches may have cases left */
  nlopt_set_lower_bounds1(local->opt, 0);
  nlopt_set_upper_bounds1(local->opt, 1);
  nlopt_set_min_objective(local->opt, objective, local);
  for (size_t g = p->objectives; g < p->goals; g++) {
    bound[g - p->objectives] = (Bound){local, g};
    nlopt_add_inequality_constraint(local->opt, constraint, &bound[g - p->objectives], 1e-8);
  }
  nlopt_set_xtol_abs1(local->opt, narrow);
  if (!slopes) nlopt_set_initial_step1(local->opt, 0.1);
  nlopt_optimize(local->opt, local->z, &best); /* its points are kept, whatever its result is */
  nlopt_destroy(local->opt);
}

/* -- starts ----------------------------------------------------------------------------------------- */

static double distance(const ZpProblem *p, const double *a, const double *b) {
  double most = 0;
  for (size_t i = 0; i < p->variables; i++)
    most = fmax(most, fabs(a[i] - b[i]));
  return most;
}

static bool is_apart(const ZpSearch *s, const size_t *chosen, size_t count, size_t candidate) {
  for (size_t k = 0; k < count; k++)
    if (distance(&s->problem, s->point[chosen[k]].z, s->point[candidate].z) < apart) return false;
  return true;
}

/* The best of the first `sampled` points that keep their distance from each other => their number. */
static size_t choose_starts(const ZpSearch *s, size_t sampled, size_t chosen[STARTS]) {
  size_t count = 0;
  for (; count < STARTS; count++) {
    size_t best = sampled;
    for (size_t i = 0; i < sampled; i++)
      if (s->point[i].done && is_apart(s, chosen, count, i) &&
          (best == sampled || zp_is_better(&s->problem, s->point[i].value, s->point[best].value)))
        best = i;
    if (best == sampled) break;
    chosen[count] = best;
  }
  return count;
}

/* A search with `count` cases from `first` on, which begins at case `start`. */
static Local from_case(ZpSearch *s, size_t start, size_t first, size_t count) {
  const ZpPoint *point = &s->point[start];
  const double size = fabs(point->value[0]);
  Local local = {.search = s, .first = first, .count = count, .scale = size > 0 ? size : 1};
  memcpy(local.z, point->z, sizeof point->z);
  return local;
}

static ZpStatus run_all(ZpSearch *s, Local *local, size_t starts, ZpError *err) {
  s->derivatives = s->problem.method == ZP_OPTIMIZER_SLSQP;
  return zp_search_parallel(s, starts, search_from, local, err);
}

ZpStatus zp_search_local(ZpSearch *s, size_t sampled, ZpError *err) {
  size_t chosen[STARTS];
  const size_t starts = choose_starts(s, sampled, chosen);
  const size_t share = starts > 0 ? (s->problem.evaluations - sampled) / starts : 0;
  Local local[STARTS];
  for (size_t k = 0; k < starts; k++)
    local[k] = from_case(s, chosen[k], sampled + k * share, share);
  return run_all(s, local, starts, err);
}

ZpStatus zp_search_local_from(ZpSearch *s, size_t start, size_t first, ZpError *err) {
  Local local = from_case(s, start, first, s->room - first);
  return run_all(s, &local, 1, err);
}
