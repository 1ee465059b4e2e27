/* Error against CPU time: the same motion at many tolerances, implicit, and by explicit steps.
 *
 *   precision swing        a cantilever's swing, against the converged one of cli/swing.def => CSV
 *   precision zip          the default actuator's zip, against implicit steps at 1e-6       => CSV
 *   precision cost         rest, limits and zip with each mechanics: CPU time and error     => CSV
 *   precision tolerance    zip times of some actuators, by solver.tolerance                  => a table
 *   precision reference    the converged swing                                              => cli/swing.def
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "def/def.h"
#include "motion.h"
#include "study/result.h"

enum { MESHES = 7 };

/* A case: its definition, its meshes (0: no more), and what errors are relative to, m. */
typedef struct Case {
  ZpStatus (*def_of)(int nodes, bool implicit, ZpActuatorDef *def, ZpError *err);
  int nodes[MESHES];
  double scale;
} Case;

static int fail(const ZpError *err) {
  fprintf(stderr, "precision: %s\n", err->message);
  return EXIT_FAILURE;
}

static ZpStatus print_row(const ZpActuatorDef *def, const Trajectory *reference, double scale, ZpError *err) {
  Motion motion;
  bool implicit = def->solver.integrator == ZP_INTEGRATOR_IMPLICIT;
  ZpStatus status = motion_measure(def, NULL, reference, &motion, err);
  if (status != ZP_OK) return status;
  const bool equal = implicit && !isnan(def->solver.time_step);
  printf("%s,%d,", equal ? "equal" : implicit ? "implicit" : "explicit", def->mesh.nodes);
  if (implicit && !equal) printf("%g", zp_def_tolerance(def));
  printf(",%.0f,%.4g,%.4g\n", motion.steps, motion.seconds, motion.rms / scale);
  fflush(stdout);
  return ZP_OK;
}

/* A motion without internal damping and without liquid, of which explicit steps know nothing. */
static ZpStatus undamped(const Case *c, int nodes, bool implicit, ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = c->def_of(nodes, implicit, def, err);
  def->damping.internal = 0;
  def->liquid.model = ZP_LIQUID_NONE;
  return status;
}

/* All tolerances, then equal steps, then the explicit ones, with `nodes` nodes. */
static ZpStatus print_rows(const Case *c, int nodes, const Trajectory *reference, ZpError *err) {
  static const double tolerance[] = {1e-2, 3e-3, 1e-3, 7e-4, 5e-4, 3.5e-4, 3e-4, 2e-4, 1e-4, 1e-5};
  static const double time_step[] = {2e-3, 1e-3, 5e-4, 2e-4, 1e-4}; /* s */
  ZpActuatorDef def = {0};
  ZpStatus status = undamped(c, nodes, true, &def, err);
  for (size_t k = 0; k < sizeof tolerance / sizeof tolerance[0] && status == ZP_OK; k++) {
    def.solver.tolerance = tolerance[k];
    status = print_row(&def, reference, c->scale, err);
  }
  for (size_t k = 0; k < sizeof time_step / sizeof time_step[0] && status == ZP_OK; k++) {
    def.solver.time_step = time_step[k];
    status = print_row(&def, reference, c->scale, err);
  }
  if (status == ZP_OK) status = undamped(c, nodes, false, &def, err);
  return status == ZP_OK ? print_row(&def, reference, c->scale, err) : status;
}

/* The zip's own reference: the same nodes, so that only time is compared. */
static ZpStatus converge(const Case *c, int nodes, size_t rows, double interval, double (*row)[2], ZpError *err) {
  ZpActuatorDef def = {0};
  ZpStatus status = undamped(c, nodes, true, &def, err);
  def.solver.tolerance = 1e-6;
  return status == ZP_OK ? motion_record(&def, rows, interval, row, err) : status;
}

static int print_case(const Case *c, bool own_reference) {
  enum { ROWS = 701 };
  static double row[ROWS][2];
  ZpError err;
  ZpStatus status = ZP_OK;
  printf("steps,nodes,tolerance,steps_per_simulated_second,seconds_per_simulated_second,error\n");
  for (int n = 0; n < MESHES && c->nodes[n] > 0 && status == ZP_OK; n++) {
    Trajectory reference = motion_swing_reference();
    if (own_reference) {
      reference = (Trajectory){ROWS, 1e-4, (const double(*)[2])row};
      status = converge(c, c->nodes[n], ROWS, 1e-4, row, &err);
    }
    if (status == ZP_OK) status = print_rows(c, c->nodes[n], &reference, &err);
  }
  return status == ZP_OK ? EXIT_SUCCESS : fail(&err);
}

/* Twice the nodes, or a tenth of the tolerance, change it by less than 1e-6 of the swing, root mean square. */
static int print_reference(int nodes, double tolerance) {
  enum { ROWS = 101 };
  static double row[ROWS][2];
  ZpActuatorDef def = {0};
  ZpError err;
  ZpStatus status = motion_swing(nodes, true, &def, &err);
  def.solver.tolerance = tolerance;
  if (status == ZP_OK) status = motion_record(&def, ROWS, 1e-3, row, &err);
  if (status != ZP_OK) return fail(&err);
  printf("/* Height (m) and velocity (m/s) of the cantilever's tip (motion_swing) every ms, %d nodes, tolerance %g: "
         "made by\n"
         " * bench/run.sh reference. */\n",
         nodes, tolerance);
  for (size_t i = 0; i < ROWS; i++)
    printf("{%.9e, %.9e},\n", row[i][0], row[i][1]);
  return EXIT_SUCCESS;
}

/* -- does a tolerance keep its word? ---------------------------------------------------------------- */

typedef struct Actuator {
  const char *name;
  ZpLiquidModel liquid;
  double thickness, length, mass, voltage; /* m, m, kg, V; 0: the default */
} Actuator;

static ZpStatus zip_time(const Actuator *a, double tolerance, double *time, ZpError *err) {
  ZpActuatorDef def = zp_actuator_def_default();
  ZpResult *result = NULL;
  def.liquid.model = a->liquid;
  if (a->thickness > 0) def.ribbon.thickness = a->thickness;
  if (a->length > 0) def.ribbon.length = a->length;
  if (a->mass > 0) def.load.mass = a->mass;
  if (a->voltage > 0) def.drive.voltage = a->voltage;
  def.solver.tolerance = tolerance;
  def.solver.stop_when_zipped = ZP_WHEN_TRUE;
  def.output.errors = false;
  ZpStatus status = zp_study_run(ZP_STUDY_ACTUATE, &def, NULL, NULL, &result, err);
  if (status == ZP_OK) *time = zp_result_get(result, "zip_time_s");
  zp_result_destroy(result);
  return status;
}

/* Zip times at each tolerance; the last one is the finest that rounding allows. */
static const double tolerances[] = {1e-3, 3e-4, 1e-4, 1e-5, 1e-6, 1e-7};

enum { TOLERANCES = sizeof tolerances / sizeof tolerances[0] };

/* Where the zip times go to: errors are proportional to the tolerance. */
static double converged(const double *time) {
  double last = time[TOLERANCES - 1], before = time[TOLERANCES - 2];
  return last + (last - before) / 9;
}

/* Errors of zip times in units of the tolerance. */
static int print_tolerances(void) {
  static const Actuator actuator[] = {{"default, bath", ZP_LIQUID_SUBMERGED, 0, 0, 0, 0},
                                      {"default, beads", ZP_LIQUID_BEAD, 0, 0, 0, 0},
                                      {"60 um, 4 g, 6 kV, bath", ZP_LIQUID_SUBMERGED, 60e-6, 0, 4e-3, 6e3},
                                      {"70 mm, 5 g, 9 kV, beads", ZP_LIQUID_BEAD, 0, 70e-3, 5e-3, 9e3},
                                      {"default, no liquid", ZP_LIQUID_NONE, 0, 0, 0, 0},
                                      {"60 um, 4 g, 6 kV, no liquid", ZP_LIQUID_NONE, 60e-6, 0, 4e-3, 6e3}};
  ZpError err;
  printf("actuator,zip_time_s,1e-3,3e-4,1e-4,1e-5,1e-6,1e-7\n");
  for (size_t k = 0; k < sizeof actuator / sizeof actuator[0]; k++) {
    double time[TOLERANCES];
    for (size_t i = 0; i < TOLERANCES; i++)
      if (zip_time(&actuator[k], tolerances[i], &time[i], &err) != ZP_OK) return fail(&err);
    double exact = converged(time);
    printf("\"%s\",%.9g", actuator[k].name, exact);
    for (size_t i = 0; i < TOLERANCES; i++)
      printf(",%.2f", (time[i] / exact - 1) / tolerances[i]);
    printf("\n");
    fflush(stdout);
  }
  return EXIT_SUCCESS;
}

/* -- cost against error, with each mechanics ---------------------------------------------------------- */

typedef struct Mechanics {
  const char *name;
  ZpRibbonModel model;
  ZpIntegrator integrator;
} Mechanics;

static const Mechanics mechanics[] = {{"rod", ZP_RIBBON_ROD, ZP_INTEGRATOR_IMPLICIT},
                                      {"mass-spring", ZP_RIBBON_MASS_SPRING, ZP_INTEGRATOR_IMPLICIT},
                                      {"rod explicit", ZP_RIBBON_ROD, ZP_INTEGRATOR_EXPLICIT},
                                      {"mass-spring explicit", ZP_RIBBON_MASS_SPRING, ZP_INTEGRATOR_EXPLICIT}};

enum { MECHANICS = sizeof mechanics / sizeof mechanics[0], AT_REST = 2 };

/* A study of which one number is compared with the converged one. */
typedef struct Problem {
  const char *name, *number;
  ZpStudy study;
  int nodes[8], repeats; /* of nodes: 0: no more; a cost is the least of so many runs */
  int reference;         /* nodes of the rod that stands for the converged one; 0: the value below */
  double converged;      /* SI */
} Problem;

static const Problem problems[] = {
    {"rest", "stroke_m", ZP_STUDY_STATIONARY, {7, 9, 11, 14, 21, 33, 61, 121}, 200, 0, 17.942e-3}, /* exact elastica */
    {"limits", "pull_in_voltage_V", ZP_STUDY_LIMITS, {11, 15, 21, 31, 41, 61, 81, 121}, 5, 481, 0},
    {"zip", "zip_time_s", ZP_STUDY_ACTUATE, {11, 15, 21, 31, 41, 61, 81}, 3, 241, 0}};

/* The guided strip with 61 g that hangs from straight; the default actuator without liquid and damping. */
static ZpStatus cost_def(const Problem *p, const Mechanics *m, int nodes, ZpActuatorDef *def, ZpError *err) {
  const bool strip = p->study == ZP_STUDY_STATIONARY;
  const struct {
    const char *key;
    double value;
  } setting[] = {{"ribbon.model", m->model},
                 {"solver.integrator", m->integrator},
                 {"mesh.nodes", nodes},
                 {"liquid.model", ZP_LIQUID_NONE},
                 {"damping.internal", 0},
                 {"output.errors", 0},
                 {"solver.stop_when_zipped", ZP_WHEN_TRUE},
                 {"actuator.kind", ZP_KIND_RIBBON}, /* of the strip, from here on */
                 {"ribbon.length", 45e-3},
                 {"ribbon.thickness", 100e-6},
                 {"ribbon.plane", ZP_PLANE_STRESS},
                 {"load.mass", 61e-3}};
  enum { ALL = sizeof setting / sizeof setting[0], OF_STRIP = 5 };
  ZpAssignment list[ALL];
  for (size_t k = 0; k < ALL; k++)
    list[k] = (ZpAssignment){zp_key_find(setting[k].key), setting[k].value};
  return zp_def_resolve(def, list, strip ? ALL : ALL - OF_STRIP, err);
}

/* The number, NAN where there is none, and the least CPU time of some runs, s. */
static ZpStatus measure(const Problem *p, const ZpActuatorDef *def, int repeats, double *number, double *least,
                        ZpError *err) {
  *least = INFINITY;
  for (int k = 0; k < repeats; k++) {
    ZpResult *result = NULL;
    const double start = motion_clock();
    ZpStatus status = zp_study_run(p->study, def, NULL, NULL, &result, err);
    *least = fmin(*least, motion_clock() - start);
    if (status == ZP_OK) *number = zp_result_get(result, p->number);
    zp_result_destroy(result);
    if (status != ZP_OK) return status;
  }
  return ZP_OK;
}

static ZpStatus converged_of(const Problem *p, double *number, ZpError *err) {
  ZpActuatorDef def = {0};
  double unused;
  *number = p->converged;
  if (p->reference == 0) return ZP_OK;
  ZpStatus status = cost_def(p, &mechanics[0], p->reference, &def, err);
  if (p->study == ZP_STUDY_ACTUATE) def.solver.tolerance = 1e-5;
  return status == ZP_OK ? measure(p, &def, 1, number, &unused, err) : status;
}

static ZpStatus print_costs_of(const Problem *p, ZpError *err) {
  double converged, number = NAN, seconds;
  ZpStatus status = converged_of(p, &converged, err);
  const size_t kinds = p->study == ZP_STUDY_ACTUATE ? MECHANICS : AT_REST;
  for (size_t m = 0; m < kinds; m++)
    for (size_t n = 0; n < sizeof p->nodes / sizeof p->nodes[0] && p->nodes[n] > 0 && status == ZP_OK; n++) {
      const bool implicit = mechanics[m].integrator == ZP_INTEGRATOR_IMPLICIT;
      ZpActuatorDef def = {0};
      status = cost_def(p, &mechanics[m], p->nodes[n], &def, err);
      if (status == ZP_OK) status = measure(p, &def, implicit ? p->repeats : 1, &number, &seconds, err);
      if (status != ZP_OK) break;
      printf("%s,%s,%d,%.4g,%.4g\n", p->name, mechanics[m].name, p->nodes[n], 1e3 * seconds,
             fabs(number / converged - 1));
      fflush(stdout);
    }
  return status;
}

static int print_costs(void) {
  ZpError err;
  ZpStatus status = ZP_OK;
  printf("problem,mechanics,nodes,cpu_ms,error\n");
  for (size_t k = 0; k < sizeof problems / sizeof problems[0] && status == ZP_OK; k++)
    status = print_costs_of(&problems[k], &err);
  return status == ZP_OK ? EXIT_SUCCESS : fail(&err);
}

int main(int argc, char **argv) {
  static const Case swing = {motion_swing, {9, 11, 13, 15, 18, 21, 61}, 6.05e-3},
                    zip = {motion_zip, {21, 61, 130}, 20.7e-3};
  const char *word = argc == 2 ? argv[1] : "";
  if (strcmp(word, "swing") == 0) return print_case(&swing, false);
  if (strcmp(word, "zip") == 0) return print_case(&zip, true);
  if (strcmp(word, "cost") == 0) return print_costs();
  if (strcmp(word, "tolerance") == 0) return print_tolerances();
  if (strcmp(word, "reference") == 0) return print_reference(801, 4e-6);
  fprintf(stderr, "precision: say swing, zip, cost, tolerance or reference\n");
  return EXIT_FAILURE;
}
