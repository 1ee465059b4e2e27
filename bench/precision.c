/* Error against CPU time: the same motion at many tolerances, implicit, and by explicit steps.
 *
 *   precision swing        a cantilever's swing, against the converged one of cli/swing.def => CSV
 *   precision zip          the default actuator's zip, against implicit steps at 1e-6       => CSV
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

int main(int argc, char **argv) {
  static const Case swing = {motion_swing, {9, 11, 13, 15, 18, 21, 61}, 6.05e-3},
                    zip = {motion_zip, {21, 61, 130}, 20.7e-3};
  const char *word = argc == 2 ? argv[1] : "";
  if (strcmp(word, "swing") == 0) return print_case(&swing, false);
  if (strcmp(word, "zip") == 0) return print_case(&zip, true);
  if (strcmp(word, "tolerance") == 0) return print_tolerances();
  if (strcmp(word, "reference") == 0) return print_reference(801, 4e-6);
  fprintf(stderr, "precision: say swing, zip, tolerance or reference\n");
  return EXIT_FAILURE;
}
