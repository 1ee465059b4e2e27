/* Letters of docs/theory.md, section 21: f a number of the summary; 0, 1, 2 the mesh that was asked for and two coarser
 * ones, each with half as many elements as the one before. */
#include "study/estimate.h"

#include <math.h>
#include <string.h>

#include "base/fail.h"

enum { MESHES = 3, FEWEST_NODES = 4 };

typedef struct Estimated {
  ZpStudy study;
  const char *value, *error, *unit;
  double safety;    /* F of eq. (21.1) */
  int order;        /* p */
  double monotonic; /* F of eq. (21.2); 0: it does not apply */
} Estimated;

static const Estimated estimated[] = {
#define ZP_ESTIMATE(enumerator, scalar, error, unit, safety, order, monotonic)                                         \
  {enumerator, scalar, error, unit, safety, order, monotonic},
#include <zipact/studies.def>
};
enum { COUNT = sizeof estimated / sizeof estimated[0] };

/* What the three meshes give for each row above; NAN where they give none. */
typedef struct Findings {
  double elements[MESHES], f[COUNT][MESHES];
} Findings;

static bool is_estimated(ZpStudy study) {
  for (int k = 0; k < COUNT; k++)
    if (estimated[k].study == study) return true;
  return false;
}

/* The paper's chain has coefficients for one mesh each, and a run that resumes has the mesh of its checkpoint. */
static bool has_coarser(const ZpActuatorDef *def, bool moves) {
  if (def->ribbon.model != ZP_RIBBON_ROD) return false;
  return !moves || (def->solver.integrator == ZP_INTEGRATOR_IMPLICIT && def->initial.state != ZP_INITIAL_CHECKPOINT);
}

/* Half as many elements; in motion, steps twice as long. Only numbers of the summary are asked for. */
static ZpActuatorDef coarser(ZpActuatorDef def, bool moves) {
  def.mesh.nodes = (def.mesh.nodes + 1) / 2;
  def.output.samples = 10;
  def.output.shapes = 2;
  def.sensitivity.by[0] = 0;
  if (moves) def.solver.tolerance *= 4; /* a tolerance goes with the square of the steps, eq. (18.12) */
  if (moves) def.solver.time_step *= 2; /* NAN, auto, stays */
  return def;
}

static void take(const ZpResult *result, ZpStudy study, int mesh, const ZpActuatorDef *def, Findings *findings) {
  findings->elements[mesh] = def->mesh.nodes - 1;
  for (int k = 0; k < COUNT; k++)
    findings->f[k][mesh] = estimated[k].study == study ? zp_result_get(result, estimated[k].value) : NAN;
}

/* Solve on a coarser mesh. One on which the study has no answer is no failure. */
static ZpStatus solve(const ZpTask *task, ZpStudyRun run, ZpStudy study, int mesh, const ZpActuatorDef *def,
                      Findings *findings, ZpError *err) {
  const ZpTask again = {def, {.table = task->input.table}, task->hooks};
  ZpError reason;
  ZpResult *result = zp_result_create(study);
  if (!result) return zp_fail_memory(err);
  ZpStatus status = run(&again, result, &reason);
  if (status == ZP_OK && zp_outcome_good(result->outcome)) take(result, study, mesh, def, findings);
  zp_result_destroy(result);
  return status == ZP_MACHINE ? zp_fail(err, status, "%s", reason.message) : ZP_OK;
}

/* The error of f_0 if errors go with the power -order of the number of elements; NAN where that mesh has none. */
static double richardson(const Findings *findings, int k, int mesh, int order) {
  const double *f = findings->f[k], *n = findings->elements;
  double growth = 1;
  for (int i = 0; i < order; i++)
    growth *= n[0] / n[mesh];
  return fabs(f[0] - f[mesh]) / (growth - 1);
}

/* Do the meshes approach from one side, with the first power of the elements' length or faster, and not with so high
 * an order that two of them must agree by chance? */
static bool is_monotonic(const Findings *findings, int k) {
  static const double fastest = 32; /* ratio of both differences: order five */
  const double *f = findings->f[k], *n = findings->elements;
  double fine = (f[1] - f[0]) / (1 / n[1] - 1 / n[0]), coarse = (f[2] - f[1]) / (1 / n[2] - 1 / n[1]);
  bool chance = fabs(f[2] - f[1]) > fastest * fabs(f[1] - f[0]);
  return fine * coarse > 0 && fabs(coarse) >= fabs(fine) && !chance;
}

/* Eqs. (21.1) and (21.2). A number that no coarser mesh has is NAN; either may be missing. */
static double error_of(const Findings *findings, int k) {
  const Estimated *e = &estimated[k];
  double first = richardson(findings, k, 1, 2), second = richardson(findings, k, 2, e->order);
  if (e->monotonic > 0 && is_monotonic(findings, k)) return e->monotonic * first;
  return e->safety * fmax(first, second);
}

static bool has(const ZpResult *result, const char *name) {
  for (size_t i = 0; i < result->scalars; i++)
    if (strcmp(result->scalar[i].name, name) == 0) return true;
  return false;
}

static void forget_all(Findings *findings) {
  for (int mesh = 0; mesh < MESHES; mesh++) {
    findings->elements[mesh] = NAN;
    for (int k = 0; k < COUNT; k++)
      findings->f[k][mesh] = NAN;
  }
}

/* Where elements are longer than what bends, no mesh of longer ones shows by how much this one is wrong. */
static bool is_resolved(const ZpActuatorDef *def, ZpResult *result) {
  if (result->resolution >= 1) return true;
  double enough = 1 + ceil((def->mesh.nodes - 1) / result->resolution);
  zp_result_note(
      result,
      "mesh.nodes = %d: errors are not estimated, because elements are longer than the length over which the "
      "ribbon bends; use mesh.nodes = %.0f",
      def->mesh.nodes, enough);
  return false;
}

/* Is there a number to estimate? What an actuator does not do, coarser ones need not show. */
static bool any_found(const Findings *findings) {
  for (int k = 0; k < COUNT; k++)
    if (!isnan(findings->f[k][0])) return true;
  return false;
}

ZpStatus zp_estimate_errors(const ZpTask *task, ZpStudyRun run, bool moves, ZpResult *result, ZpError *err) {
  ZpStudy study = result->study;
  if (!task->def->output.errors || !is_estimated(study) || !has_coarser(task->def, moves)) return ZP_OK;
  Findings findings;
  forget_all(&findings);
  take(result, study, 0, task->def, &findings);
  ZpActuatorDef def = *task->def;
  ZpStatus status = ZP_OK;
  bool wanted = zp_outcome_good(result->outcome) && any_found(&findings) && is_resolved(task->def, result);
  for (int mesh = 1; mesh < MESHES && status == ZP_OK && wanted; mesh++) {
    def = coarser(def, moves);
    if (def.mesh.nodes < FEWEST_NODES) break;
    status = solve(task, run, study, mesh, &def, &findings, err);
  }
  for (int k = 0; k < COUNT && status == ZP_OK; k++)
    if (estimated[k].study == study && has(result, estimated[k].value))
      zp_result_add(result, estimated[k].error, estimated[k].unit, error_of(&findings, k));
  return status;
}
