/* Letters of docs/theory.md, section 21: f a number of the summary, n the number of elements; 0 the requested mesh; 1
 * and 2 coarser ones, or finer ones if elements of the requested one are longer than the bend. */
#include "study/estimate.h"

#include <math.h>
#include <string.h>

#include "base/fail.h"

enum { MESHES = 3, FEWEST_ELEMENTS = 3 };

/* How errors fall with more elements: as two powers, eq. (21.2), or also as a ripple, eq. (21.3). */
typedef enum Law { POWERS, RIPPLE } Law;

typedef struct Estimated {
  ZpStudy study;
  const char *value, *error, *unit;
  double safety; /* F */
  Law law;
} Estimated;

static const Estimated estimated[] = {
#define ZP_ESTIMATE(enumerator, scalar, error, unit, safety, law) {enumerator, scalar, error, unit, safety, law},
#include <zipact/studies.def>
};
enum { COUNT = sizeof estimated / sizeof estimated[0] };

/* Results of the meshes for each row above; NAN where they give none. */
typedef struct Findings {
  double elements[MESHES], f[COUNT][MESHES];
} Findings;

static bool is_estimated(ZpStudy study) {
  for (int k = 0; k < COUNT; k++)
    if (estimated[k].study == study) return true;
  return false;
}

/* The paper's chain has coefficients for single meshes, and a resumed run has the mesh of its checkpoint. */
static bool has_others(const ZpActuatorDef *def, bool moves) {
  if (def->ribbon.model == ZP_RIBBON_MASS_SPRING) return false;
  return !moves || (def->solver.integrator == ZP_INTEGRATOR_IMPLICIT && def->initial.state != ZP_INITIAL_CHECKPOINT);
}

/* The meshes of an estimate. `finer`: elements of the requested mesh are longer than the bend, so that no mesh with
 * longer ones shows the error. */
typedef struct Meshes {
  bool finer;
  int others; /* how many of them are solved beside the requested one */
  int elements[MESHES];
} Meshes;

/* Three fifths and two fifths of the elements, so near to the requested mesh that the order matters little, and so far
 * from each other that the front is elsewhere between their nodes. In motion half of the elements, which also take half
 * of the steps, cost less than three fifths. */
static Meshes coarser_meshes(int elements, bool moves) {
  static const int at_rest[MESHES] = {10, 6, 4}, in_motion[MESHES] = {10, 5, 4};
  Meshes meshes = {.others = MESHES - 1};
  for (int mesh = 0; mesh < MESHES; mesh++)
    meshes.elements[mesh] = ((moves ? in_motion : at_rest)[mesh] * elements + 5) / 10;
  if (meshes.elements[MESHES - 1] < FEWEST_ELEMENTS) meshes.others = 0;
  return meshes;
}

/* Two elements in the length of the bend, and three fifths of that. */
static Meshes finer_meshes(int elements, double resolution) {
  int resolved = (int)ceil(2 * elements / resolution);
  return (Meshes){true, 2, {elements, resolved, (6 * resolved + 5) / 10}};
}

/* In motion, steps change by the same factor as elements, so that a mesh shows the error of both; but those of a finer
 * mesh need not be shorter than with a tolerance of `finest`. Only numbers of the summary are requested. */
static ZpActuatorDef on_mesh(ZpActuatorDef def, int elements, bool moves) {
  static const double finest = 1e-4;
  const double longer = (def.mesh.nodes - 1) / (double)elements, tolerance = zp_def_tolerance(&def);
  def.mesh.nodes = elements + 1;
  def.output.samples = 10;
  def.output.shapes = 2;
  def.output.errors = false;
  def.sensitivity.by[0] = 0;
  if (!moves) return def;
  /* The tolerance is proportional to the square of the lengths of steps, eq. (18.12). */
  def.solver.tolerance = fmax(tolerance * longer * longer, fmin(tolerance, finest));
  def.solver.time_step *= longer; /* NAN, auto, stays */
  return def;
}

static void take(const ZpResult *result, ZpStudy study, int mesh, const ZpActuatorDef *def, Findings *findings) {
  findings->elements[mesh] = def->mesh.nodes - 1;
  for (int k = 0; k < COUNT; k++)
    findings->f[k][mesh] = estimated[k].study == study ? zp_result_get(result, estimated[k].value) : NAN;
}

/* Solve on another mesh. One on which the study has no answer is no failure. */
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

static double square(double x) {
  return x * x;
}

/* Eq. (21.1): f_0 less the converged number, if errors are proportional to n^-2. NAN if the mesh has no such number. */
static double richardson(const Findings *findings, int k, int mesh) {
  const double *f = findings->f[k], *n = findings->elements;
  return (f[mesh] - f[0]) / (square(n[0] / n[mesh]) - 1);
}

/* Eq. (21.3); either of the coarser meshes may have no such number. */
static double of_ripple(const Findings *findings, int k) {
  return fmax(fabs(richardson(findings, k, 1)), fabs(richardson(findings, k, 2)));
}

/* Eq. (21.2): the errors of both orders, two and four, or of the lower one alone. */
static double of_powers(const Findings *findings, int k) {
  double near = richardson(findings, k, 1), far = richardson(findings, k, 2);
  double to_near = square(findings->elements[0] / findings->elements[1]);
  double to_far = square(findings->elements[0] / findings->elements[2]);
  double both = (near * to_far - far * to_near) / (to_far - to_near);
  return fmax(of_ripple(findings, k), fabs(both));
}

/* Eq. (21.5): the difference from the finer mesh, and the error of that. */
static double of_finer(const Findings *findings, int k) {
  const double *f = findings->f[k], *n = findings->elements;
  return fabs(f[0] - f[1]) + estimated[k].safety * fabs(f[2] - f[1]) / (square(n[1] / n[2]) - 1);
}

static double error_of(const Findings *findings, const Meshes *meshes, int k) {
  const Estimated *e = &estimated[k];
  if (meshes->finer) return of_finer(findings, k);
  return e->safety * (e->law == POWERS ? of_powers(findings, k) : of_ripple(findings, k));
}

static void forget_all(Findings *findings) {
  for (int mesh = 0; mesh < MESHES; mesh++) {
    findings->elements[mesh] = NAN;
    for (int k = 0; k < COUNT; k++)
      findings->f[k][mesh] = NAN;
  }
}

enum { MOST_ELEMENTS = 2000 };

/* May the meshes that resolve the bend be solved? */
static bool is_affordable(Meshes meshes) {
  static const int times = 32;
  return meshes.elements[1] <= MOST_ELEMENTS && meshes.elements[1] <= times * meshes.elements[0];
}

/* How errors are estimated. */
static void note_finer(const ZpActuatorDef *def, Meshes meshes, ZpResult *result) {
  if (is_affordable(meshes))
    zp_result_note(
        result,
        "mesh.nodes = %d: the estimated errors are the differences from a mesh that resolves the bend of the "
        "ribbon, mesh.nodes = %d",
        def->mesh.nodes, meshes.elements[1] + 1);
  else
    zp_result_note(
        result,
        "mesh.nodes = %d: errors are not estimated and may exceed the numbers, because elements are much longer "
        "than the length over which the ribbon bends; use mesh.nodes = %d",
        def->mesh.nodes, meshes.elements[1] + 1);
}

/* The meshes on which the study is solved again. */
static Meshes choose_meshes(const ZpActuatorDef *def, bool moves, ZpResult *result) {
  int elements = def->mesh.nodes - 1;
  if (result->resolution >= 1) return coarser_meshes(elements, moves);
  Meshes meshes = finer_meshes(elements, result->resolution);
  note_finer(def, meshes, result);
  if (!is_affordable(meshes)) meshes.others = 0;
  return meshes;
}

/* Is a number of the study without an estimate? One that the study did not find needs none. */
static bool lacks_estimate(const ZpResult *result, const Findings *findings) {
  for (int k = 0; k < COUNT; k++)
    if (!isnan(findings->f[k][0]) && !zp_result_has(result, estimated[k].error)) return true;
  return false;
}

/* -- by another mesh, from what was found ----------------------------------------------------------- */

/* Coarser meshes say nothing about one that does not resolve the bend. */
void zp_add_estimate(const ZpOtherMesh *other, const char *number, double change) {
  ZpResult *result = other->result;
  if (isnan(change) && result->resolution >= 1) return;
  for (int k = 0; k < COUNT; k++)
    if (estimated[k].study == result->study && strcmp(estimated[k].value, number) == 0)
      zp_result_add(result, estimated[k].error, estimated[k].unit,
                    estimated[k].safety * fabs(change) / other->share_of_error);
}

/* Twice the elements, and at least four on the bend, or two on a bend that the mesh does not resolve; of what is not in
 * contact two thirds, if that leaves two. 0: too many. */
static int other_elements(const ZpActuatorDef *def, bool contact, ZpResult *result) {
  static const double enough = 3, several = 4; /* on the bend */
  const int elements = def->mesh.nodes - 1, fewer = (2 * elements + 1) / 3;
  if (!contact && result->resolution >= enough && fewer >= FEWEST_ELEMENTS) return fewer;
  const int more = (int)ceil(elements * fmax(2, several / result->resolution));
  if (result->resolution >= 1) return more <= MOST_ELEMENTS ? more : 0;
  const Meshes meshes = finer_meshes(elements, result->resolution);
  if (is_affordable(meshes)) note_finer(def, meshes, result);
  return is_affordable(meshes) ? meshes.elements[1] : 0;
}

ZpStatus zp_estimate_from_there(ZpEquilibria *at, bool contact, ZpOnOtherMesh *solve_on, void *user, ZpError *err) {
  const ZpActuatorDef *def = at->model->whole;
  const bool wanted = def->output.errors && has_others(def, false) && zp_outcome_good(at->result->outcome);
  const int elements = wanted ? other_elements(def, contact, at->result) : 0;
  ZpModel *model;
  ZpRest rest;
  if (elements == 0) return ZP_OK;
  ZpStatus status = zp_model_create_on_mesh(at->model, elements + 1, &model, err);
  if (status != ZP_OK) return status;
  const ZpOtherMesh other = {&rest, at->result, fabs(1 - square((def->mesh.nodes - 1) / (double)elements))};
  const bool opened = zp_rest_open(&rest, model, NULL, NULL);
  rest.statics.stop = at->rest.statics.stop;
  rest.statics.caller = at;
  if (opened) solve_on(user, &other);
  zp_rest_close(&rest);
  zp_model_destroy(model);
  return opened ? ZP_OK : zp_fail_memory(err);
}

/* -- by solving again ------------------------------------------------------------------------------ */

ZpStatus zp_estimate_errors(const ZpTask *task, ZpStudyRun run, bool moves, ZpResult *result, ZpError *err) {
  ZpStudy study = result->study;
  if (!task->def->output.errors || !is_estimated(study) || !has_others(task->def, moves)) return ZP_OK;
  Findings findings;
  forget_all(&findings);
  take(result, study, 0, task->def, &findings);
  ZpStatus status = ZP_OK;
  Meshes meshes = {.others = 0};
  if (zp_outcome_good(result->outcome) && lacks_estimate(result, &findings))
    meshes = choose_meshes(task->def, moves, result);
  for (int mesh = 1; mesh <= meshes.others && status == ZP_OK; mesh++) {
    const ZpActuatorDef def = on_mesh(*task->def, meshes.elements[mesh], moves);
    status = solve(task, moves ? zp_study_zip_time : run, study, mesh, &def, &findings, err);
  }
  for (int k = 0; k < COUNT && status == ZP_OK; k++)
    if (estimated[k].study == study && zp_result_has(result, estimated[k].value) &&
        !zp_result_has(result, estimated[k].error))
      zp_result_add(result, estimated[k].error, estimated[k].unit, error_of(&findings, &meshes, k));
  return status;
}
