#include "def/tolerance.h"

#include <math.h>

#include "def/device.h"

static const double usual = 1e-4;

/* Errors of derivatives are ten and more times those of the numbers, eq. (20.11). */
static const double of_derivatives = 2.5e-5;

/* Tolerance of the steps that the mesh is worth, eq. (18.13): dry zips are off by about 1.2 tolerances, those in a
 * liquid by 2.4. */
static double of_mesh(const ZpActuatorDef *def) {
  bool dry = zp_def_liquid(def) == ZP_LIQUID_NONE;
  double elements = def->mesh.nodes - 1, worth = (dry ? 5 : 1.5) / (elements * elements);
  return fmin(fmax(worth, usual), dry ? 1.5e-3 : 1e-3);
}

double zp_def_tolerance(const ZpActuatorDef *def) {
  if (!def) return NAN;
  if (!isnan(def->solver.tolerance)) return def->solver.tolerance;
  if (*def->sensitivity.by) return of_derivatives;
  return zp_def_has(def, ZP_DEVICE_ELECTRODES) && !zp_def_has(def, ZP_DEVICE_RIGID) ? of_mesh(def) : usual;
}

double zp_tolerance_at_rest(const ZpActuatorDef *def) {
  static const double part = 1e-3;
  return part * (isnan(def->solver.tolerance) ? usual : def->solver.tolerance);
}
