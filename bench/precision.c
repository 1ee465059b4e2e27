/* Error against CPU time: the same motion at many tolerances, implicit, and by explicit steps.
 *
 *   precision swing        a cantilever's swing, against the converged one of cli/swing.def => CSV
 *   precision zip          the default actuator's zip, against implicit steps at 1e-7       => CSV
 *   precision reference    the converged swing                                              => cli/swing.def
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "motion.h"

enum { MESHES = 5 };

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
  printf("%s,%d,", implicit ? "implicit" : "explicit", def->mesh.nodes);
  if (implicit) printf("%g", def->solver.tolerance);
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

/* All tolerances, then the explicit steps, with `nodes` nodes. */
static ZpStatus print_rows(const Case *c, int nodes, const Trajectory *reference, ZpError *err) {
  static const double tolerance[] = {1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 5e-5, 3e-5, 1e-5, 3e-6, 1e-6};
  ZpActuatorDef def;
  ZpStatus status = undamped(c, nodes, true, &def, err);
  for (size_t k = 0; k < sizeof tolerance / sizeof tolerance[0] && status == ZP_OK; k++) {
    def.solver.tolerance = tolerance[k];
    status = print_row(&def, reference, c->scale, err);
  }
  if (status == ZP_OK) status = undamped(c, nodes, false, &def, err);
  return status == ZP_OK ? print_row(&def, reference, c->scale, err) : status;
}

/* The zip's own reference: the same nodes, so that only time is compared. */
static ZpStatus converge(const Case *c, int nodes, size_t rows, double interval, double (*row)[2], ZpError *err) {
  ZpActuatorDef def;
  ZpStatus status = undamped(c, nodes, true, &def, err);
  def.solver.tolerance = 1e-7;
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
  ZpActuatorDef def;
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

int main(int argc, char **argv) {
  static const Case swing = {motion_swing, {9, 11, 15, 21, 61}, 6.05e-3}, zip = {motion_zip, {21, 61, 130}, 20.7e-3};
  const char *word = argc == 2 ? argv[1] : "";
  if (strcmp(word, "swing") == 0) return print_case(&swing, false);
  if (strcmp(word, "zip") == 0) return print_case(&zip, true);
  if (strcmp(word, "reference") == 0) return print_reference(801, 1e-8);
  fprintf(stderr, "precision: say swing, zip or reference\n");
  return EXIT_FAILURE;
}
