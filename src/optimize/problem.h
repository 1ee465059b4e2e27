/* What is to be optimised: the texts of optimize.*, read. */
#ifndef ZP_OPTIMIZE_PROBLEM_H
#define ZP_OPTIMIZE_PROBLEM_H

#include <stdbool.h>
#include <stddef.h>

#include <zipact/io.h>

#include "io/range.h"

/* The last: values of variables in all cases, which become lists of a scenario. */
enum { ZP_VARIABLES_MOST = 8, ZP_GOALS_MOST = 4, ZP_BOUNDS_MOST = 12, ZP_LISTED_MOST = 20000 };

/* An output that counts. */
typedef struct ZpGoal {
  char output[64];
  double sign;         /* objective: 1 to be small, -1 to be large; bound: 1 for <=, -1 for >= */
  double bound;        /* of a constraint, SI once the unit is known */
  char bound_text[64]; /* as written: "15 mm" */
} ZpGoal;

typedef struct ZpProblem {
  ZpInterval variable[ZP_VARIABLES_MOST];
  size_t variables;
  ZpGoal goal[ZP_GOALS_MOST + ZP_BOUNDS_MOST]; /* objectives, then constraints */
  size_t objectives, goals;
  ZpOptimizer method;
  size_t evaluations;
} ZpProblem;

/* Read optimize.* of a definition. ZP_BAD_INPUT names the key and what is wrong with its text. */
ZpStatus zp_problem_read(const ZpActuatorDef *def, ZpProblem *problem, ZpError *err);

/* Read the bounds of the constraints, now that `result` tells which outputs there are and their units. ZP_BAD_INPUT
 * names an output that the study does not have, or a unit that does not fit. */
ZpStatus zp_problem_resolve(ZpProblem *problem, const ZpResult *result, ZpError *err);

/* The value of a variable at place z, SI, and how it changes there. */
double zp_variable_value(const ZpInterval *variable, double z);
double zp_variable_slope(const ZpInterval *variable, double z);

/* What counts at a point, made so that smaller is better: objectives; constraints as the part of their bound by which
 * they are missed, at most 0 where they hold. NAN where the output does not exist. */
double zp_goal_value(const ZpProblem *problem, size_t goal, double output);

/* Its derivative by the output. */
double zp_goal_slope(const ZpProblem *problem, size_t goal);

/* By how much the constraints are missed together; 0 where all hold, by a millionth of their bounds at most. */
double zp_violation(const ZpProblem *problem, const double *value);

/* Is a point [goals] better than another: by its violation, where both hold by the first objective? */
bool zp_is_better(const ZpProblem *problem, const double *value, const double *than);

/* Does a point dominate another: no worse in any objective and better in one, where both hold; else by violation? */
bool zp_dominates(const ZpProblem *problem, const double *value, const double *other);

#endif
