#include "def/tolerance.h"

#include <math.h>

static const double usual = 1e-4;

/* Tolerance of the steps that the mesh is worth, eq. (18.13): dry zips are off by about 1.2 tolerances, those in a
 * liquid by 2.4. */
static double of_mesh(const ZpActuatorDef *def) {
  bool dry = zp_def_liquid(def) == ZP_LIQUID_NONE;
  double elements = def->mesh.nodes - 1, worth = (dry ? 5 : 1.5) / (elements * elements);
  return fmin(fmax(worth, usual), dry ? 1.5e-3 : 1e-3);
}

double zp_def_tolerance(const ZpActuatorDef *def) {
  if (!isnan(def->solver.tolerance)) return def->solver.tolerance;
  bool fine = def->actuator.kind == ZP_KIND_RIBBON || *def->sensitivity.by; /* derivatives need finer steps */
  return fine ? usual : of_mesh(def);
}

double zp_tolerance_at_rest(const ZpActuatorDef *def) {
  static const double part = 1e-3;
  return part * (isnan(def->solver.tolerance) ? usual : def->solver.tolerance);
}
