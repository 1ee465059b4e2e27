/* Letters of docs/theory.md, section 21: f a number of the summary, n the number of elements; 0 the requested mesh; 1,
 * 2, 3, 4 coarser ones, or 1 and 2 finer ones if elements of the requested one are longer than the bend. */
#include "study/estimate.h"

#include <math.h>
#include <string.h>

#include "actuator/topology.h"
#include "base/fail.h"

enum { MESHES = 5, FEWEST_ELEMENTS = 3 };

/* How errors fall with more elements: as two powers, eq. (21.2); as a ripple, eq. (21.3); as either, eq. (21.4). */
typedef enum Law { POWERS, RIPPLE, EITHER } Law;

typedef struct Estimated {
  ZpStudy study;
  const char *value, *error, *unit;
  double safety; /* F */
  Law law;
  double order; /* p of eq. (21.3) */
  int meshes;   /* coarser ones */
} Estimated;

static const Estimated estimated[] = {
#define ZP_ESTIMATE(enumerator, scalar, error, unit, safety, law, order, meshes)                                       \
  {enumerator, scalar, error, unit, safety, law, order, meshes},
#include <zipact/studies.def>
};
enum { COUNT = sizeof estimated / sizeof estimated[0] };

/* Results of the meshes for each row above; NAN where they give none. */
typedef struct Findings {
  double elements[MESHES], f[COUNT][MESHES];
  bool free_end; /* a ribbon has one: where it leaves as a point, errors are of order two */
} Findings;

static bool is_estimated(ZpStudy study) {
  for (int k = 0; k < COUNT; k++)
    if (estimated[k].study == study) return true;
  return false;
}

/* The paper's chain has coefficients for single meshes, and a resumed run has the mesh of its checkpoint. */
static bool has_others(const ZpActuatorDef *def, bool moves) {
  if (def->ribbon.model != ZP_RIBBON_ROD) return false;
  return !moves || (def->solver.integrator == ZP_INTEGRATOR_IMPLICIT && def->initial.state != ZP_INITIAL_CHECKPOINT);
}

/* The meshes of an estimate. `finer`: elements of the requested mesh are longer than the bend, so that no mesh with
 * longer ones shows the error. */
typedef struct Meshes {
  bool finer;
  int others; /* how many of them are solved beside the requested one */
  int elements[MESHES];
} Meshes;

/* Three fifths and two fifths of the elements. Together they cost as much as the study itself. They are so near to it
 * that the order matters little, and so far from each other that the front is elsewhere between their nodes. Ripples
 * that four meshes must show also need four fifths and seven tenths. In motion half of the elements, which also take
 * half of the steps, cost less than three fifths. */
static Meshes coarser_meshes(int elements, int others, bool moves) {
  static const int at_rest[MESHES] = {10, 6, 4, 8, 7}, in_motion[MESHES] = {10, 5, 4, 8, 7};
  Meshes meshes = {.others = others};
  for (int mesh = 0; mesh < MESHES; mesh++)
    meshes.elements[mesh] = ((moves ? in_motion : at_rest)[mesh] * elements + 5) / 10;
  if (meshes.elements[2] < FEWEST_ELEMENTS) meshes.others = 0;
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

/* Eq. (21.1): f_0 less the converged number, if errors are proportional to the power -order, a multiple of a half, of
 * the number of elements. NAN if the mesh has no such number. */
static double richardson(const Findings *findings, int k, int mesh, double order) {
  const double *f = findings->f[k], *n = findings->elements;
  double ratio = n[0] / n[mesh], growth = 1;
  int whole = (int)order;
  for (int i = 0; i < whole; i++)
    growth *= ratio;
  if (order > whole) growth *= sqrt(ratio);
  return (f[mesh] - f[0]) / (growth - 1);
}

/* The largest value from the coarser meshes 1 to `meshes`; any of them may have none. */
static double largest(const Findings *findings, int k, int meshes, double order) {
  double most = NAN;
  for (int mesh = 1; mesh <= meshes; mesh++)
    most = fmax(most, fabs(richardson(findings, k, mesh, order)));
  return most;
}

static double larger(const Findings *findings, int k, double order) {
  return largest(findings, k, 2, order);
}

/* Eq. (21.2): the errors of both orders, two and four, or of the lower one alone. */
static double of_powers(const Findings *findings, int k) {
  double near = richardson(findings, k, 1, 2), far = richardson(findings, k, 2, 2);
  double to_near = square(findings->elements[0] / findings->elements[1]);
  double to_far = square(findings->elements[0] / findings->elements[2]);
  double both = (near * to_far - far * to_near) / (to_far - to_near);
  return fmax(larger(findings, k, 2), fabs(both));
}

static bool on_one_side(const Findings *findings, int k, int meshes) {
  for (int mesh = 2; mesh <= meshes; mesh++)
    if (!(richardson(findings, k, 1, 2) * richardson(findings, k, mesh, 2) > 0)) return false;
  return true;
}

/* Is the order that the meshes `near` and 2, the coarsest, show this one or a higher one? */
static bool shows_order(const Findings *findings, int k, int near, double order) {
  return fabs(richardson(findings, k, 2, order)) >= fabs(richardson(findings, k, near, order));
}

/* Eq. (21.3). If meshes on one side show a lower order than the ripple's, the ripple is small compared with the error
 * of order two. */
static double of_ripple(const Findings *findings, int k) {
  const Estimated *e = &estimated[k];
  int nearest = e->meshes > 2 ? 3 : 1;
  bool small =
      findings->free_end || (on_one_side(findings, k, e->meshes) && !shows_order(findings, k, nearest, e->order));
  return largest(findings, k, e->meshes, small ? 2 : e->order);
}

/* Eq. (21.4). Meshes that follow an order give it. The estimate uses the nearer mesh with a lower order, the one that
 * remains on finer meshes. An order above five is a coincidence: two meshes happen to agree. */
static double of_either(const Findings *findings, int k, double order) {
  static const double unordered = 1.25;
  bool follow = on_one_side(findings, k, 2) && shows_order(findings, k, 1, 2) && !shows_order(findings, k, 1, 5);
  if (!follow) return unordered * larger(findings, k, order);
  return fabs(richardson(findings, k, 1, shows_order(findings, k, 1, 4) ? 3 : 2));
}

/* Eq. (21.5): the difference from the finer mesh, and the error of that. */
static double of_finer(const Findings *findings, int k) {
  const double *f = findings->f[k], *n = findings->elements;
  return fabs(f[0] - f[1]) + estimated[k].safety * fabs(f[2] - f[1]) / (square(n[1] / n[2]) - 1);
}

static double error_of(const Findings *findings, const Meshes *meshes, int k) {
  const Estimated *e = &estimated[k];
  if (meshes->finer) return of_finer(findings, k);
  if (e->law == POWERS) return e->safety * of_powers(findings, k);
  if (e->law == RIPPLE) return e->safety * of_ripple(findings, k);
  return e->safety * of_either(findings, k, e->order);
}

static void forget_all(Findings *findings) {
  for (int mesh = 0; mesh < MESHES; mesh++) {
    findings->elements[mesh] = NAN;
    for (int k = 0; k < COUNT; k++)
      findings->f[k][mesh] = NAN;
  }
}

/* Are the meshes that resolve the bend affordable? A note says how errors are estimated. */
static bool is_affordable(const ZpActuatorDef *def, Meshes meshes, ZpResult *result) {
  static const int times = 32, most = 2000; /* elements */
  if (meshes.elements[1] <= most && meshes.elements[1] <= times * meshes.elements[0]) {
    zp_result_note(
        result,
        "mesh.nodes = %d: the estimated errors are the differences from a mesh that resolves the bend of the "
        "ribbon, mesh.nodes = %d",
        def->mesh.nodes, meshes.elements[1] + 1);
    return true;
  }
  zp_result_note(
      result,
      "mesh.nodes = %d: errors are not estimated and may exceed the numbers, because elements are much longer "
      "than the length over which the ribbon bends; use mesh.nodes = %d",
      def->mesh.nodes, meshes.elements[1] + 1);
  return false;
}

/* The number of other meshes that the numbers found need. A number that the study does not find needs none. */
static int meshes_of(const Findings *findings) {
  int most = 0;
  for (int k = 0; k < COUNT; k++)
    if (!isnan(findings->f[k][0]) && estimated[k].meshes > most) most = estimated[k].meshes;
  return most;
}

/* The meshes on which the study is solved again. */
static Meshes choose_meshes(const ZpActuatorDef *def, const Findings *findings, bool moves, ZpResult *result) {
  int others = zp_outcome_good(result->outcome) ? meshes_of(findings) : 0, elements = def->mesh.nodes - 1;
  if (others == 0 || result->resolution >= 1) return coarser_meshes(elements, others, moves);
  Meshes meshes = finer_meshes(elements, result->resolution);
  if (!is_affordable(def, meshes, result)) meshes.others = 0;
  return meshes;
}

ZpStatus zp_estimate_errors(const ZpTask *task, ZpStudyRun run, bool moves, ZpResult *result, ZpError *err) {
  ZpStudy study = result->study;
  if (!task->def->output.errors || !is_estimated(study) || !has_others(task->def, moves)) return ZP_OK;
  const ZpTopology topology = zp_topology_of(task->def);
  Findings findings = {.free_end = zp_ends_free(&topology)};
  forget_all(&findings);
  take(result, study, 0, task->def, &findings);
  ZpStatus status = ZP_OK;
  const Meshes meshes = choose_meshes(task->def, &findings, moves, result);
  for (int mesh = 1; mesh <= meshes.others && status == ZP_OK; mesh++) {
    const ZpActuatorDef def = on_mesh(*task->def, meshes.elements[mesh], moves);
    status = solve(task, moves ? zp_study_zip_time : run, study, mesh, &def, &findings, err);
  }
  for (int k = 0; k < COUNT && status == ZP_OK; k++)
    if (estimated[k].study == study && zp_result_has(result, estimated[k].value))
      zp_result_add(result, estimated[k].error, estimated[k].unit, error_of(&findings, &meshes, k));
  return status;
}
