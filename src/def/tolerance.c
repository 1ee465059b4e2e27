#include "def/tolerance.h"

#include <math.h>

static const double usual = 1e-4;

double zp_tolerance_in_motion(const ZpActuatorDef *def) {
  static const double most = 1e-3;
  double elements = def->mesh.nodes - 1, of_mesh = 1.5 / (elements * elements);
  if (!isnan(def->solver.tolerance)) return def->solver.tolerance;
  return def->actuator.kind == ZP_KIND_RIBBON ? usual : fmin(fmax(of_mesh, usual), most);
}

double zp_tolerance_at_rest(const ZpActuatorDef *def) {
  static const double part = 1e-3;
  return part * (isnan(def->solver.tolerance) ? usual : def->solver.tolerance);
}
