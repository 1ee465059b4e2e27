/* By how much the numbers of a result may be wrong for their mesh and their time steps. What a study of equilibria has
 * found is solved once more on another mesh, from there. Where that fails, and in motion, the whole study is solved on
 * two other meshes. docs/theory.md, section 21. */
#ifndef ZP_STUDY_ESTIMATE_H
#define ZP_STUDY_ESTIMATE_H

#include "study/equilibria.h"

/* The model at rest on another mesh. */
typedef struct ZpOtherMesh {
  ZpRest *rest;
  ZpResult *result;      /* to which the estimates belong */
  double share_of_error; /* by which an error of order two changes */
} ZpOtherMesh;

/* Adds estimates, by zp_add_estimate. */
typedef void ZpOnOtherMesh(void *user, const ZpOtherMesh *other);

/* Where estimates are wanted, call `solve_on` with another mesh, of what is in contact with a finer one. */
ZpStatus zp_estimate_from_there(ZpEquilibria *at, bool contact, ZpOnOtherMesh *solve_on, void *user, ZpError *err);

/* Add the estimated error of a number of the result that is another by `change` on the other mesh. Where this is NAN,
 * zp_estimate_errors tells the error, if it can. */
void zp_add_estimate(const ZpOtherMesh *other, const char *number, double change);

/* (a task, what has filled its result, whether that is a motion in time, the result) => an estimated error behind the
 * numbers of the result that studies.def names and that have none yet, NAN where another mesh has no such number.
 * ZP_MACHINE: no memory. */
ZpStatus zp_estimate_errors(const ZpTask *task, ZpStudyRun run, bool moves, ZpResult *result, ZpError *err);

#endif
