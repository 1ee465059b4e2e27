/* The optimisation problem: the texts of optimize.*, read. */
#ifndef ZP_OPTIMIZE_PROBLEM_H
#define ZP_OPTIMIZE_PROBLEM_H

#include <stdbool.h>
#include <stddef.h>

#include <zipact/io.h>

#include "io/range.h"
#include "sample/statistics.h"

/* The last one: number of values of all variables in all cases, which become lists of a scenario. */
enum { ZP_VARIABLES_MOST = 8, ZP_GOALS_MOST = 4, ZP_BOUNDS_MOST = 12, ZP_LISTED_MOST = 20000 };

/* An output that is optimised or constrained. Where keys have distributions, a number of its distribution over the
 * samples stands for it. */
typedef struct ZpGoal {
  char output[64];
  ZpStatistic statistic; /* of the samples */
  bool named;            /* the text names it: "max_load_kg.quantile_05" */
  double sign;           /* objective: 1 for min, -1 for max; constraint: 1 for <=, -1 for >= */
  double bound;          /* bound of a constraint, SI once the unit is known */
  char bound_text[64];   /* as written: "15 mm" */
} ZpGoal;

typedef struct ZpProblem {
  ZpInterval variable[ZP_VARIABLES_MOST];
  size_t variables;
  ZpGoal goal[ZP_GOALS_MOST + ZP_BOUNDS_MOST]; /* objectives, then constraints */
  size_t objectives, goals;
  ZpOptimizer method;
  size_t evaluations;
} ZpProblem;

/* Read the keys optimize.* of a definition. ZP_BAD_INPUT names the key and the mistake in its text. */
ZpStatus zp_problem_read(const ZpActuatorDef *def, ZpProblem *problem, ZpError *err);

/* Read the bounds of the constraints: `result` shows which outputs exist and their units. ZP_BAD_INPUT names an output
 * that the study does not have, or a wrong unit. */
ZpStatus zp_problem_resolve(ZpProblem *problem, const ZpResult *result, ZpError *err);

/* The value of a variable at position z, SI, and its derivative with respect to z. */
double zp_variable_value(const ZpInterval *variable, double z);
double zp_variable_slope(const ZpInterval *variable, double z);

/* The goals at a point, such that smaller is better: objectives, then constraints as the violation over the bound, at
 * most 0 if satisfied. NAN if the output does not exist. */
double zp_goal_value(const ZpProblem *problem, size_t goal, double output);

/* The output of a goal, from its zp_goal_value. */
double zp_goal_output(const ZpProblem *problem, size_t goal, double value);

/* The worst value, for a sample that has no output. */
double zp_goal_worst(const ZpGoal *goal);

/* The derivative of a goal with respect to its output. */
double zp_goal_slope(const ZpProblem *problem, size_t goal);

/* Total violation of the constraints; 0 if all are satisfied within a millionth of their bounds. */
double zp_violation(const ZpProblem *problem, const double *value);

/* Is a point [goals] better than another: by its violation, or if both are feasible by the first objective? */
bool zp_is_better(const ZpProblem *problem, const double *value, const double *than);

/* Does a point dominate another: if both are feasible, not worse in any objective and better in one; otherwise by the
 * violation? */
bool zp_dominates(const ZpProblem *problem, const double *value, const double *other);

#endif
