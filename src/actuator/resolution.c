#include "actuator/resolution.h"

#include <math.h>

double zp_front_length(const ZpModel *model, double voltage) {
  const ZpActuatorDef *def = &model->def;
  if (zp_half_elements(&model->topology) == 0) return INFINITY; /* a plate does not bend */
  bool pair = zp_is_pair(&model->topology), zips = pair || (model->flat && model->plates.face[0] == 0);
  if (!zips || voltage == 0 || def->electro.surface != ZP_SURFACE_POLYLINE) return INFINITY;
  ZpPlatesLaw closed = zp_plates_law(&model->plates, voltage, 0);
  double upper = zp_ribbon_section(model, 0).EI, lower = zp_ribbon_section(model, 1).EI;
  double bend = pair ? 2 / (1 / upper + 1 / lower) : 2 * upper; /* twice that of what parts */
  return closed.W > 0 ? sqrt(sqrt(bend * -closed.P)) / sqrt(closed.W) : INFINITY;
}

/* Length over which a ribbon turns from a clamp into the direction in which it hangs, m, eq. (9.5). */
static double hanging_length(const ZpModel *model) {
  double hangs = 0;
  for (size_t j = 0; j < model->count; j++)
    hangs += model->weight[j];
  double EI = fmin(zp_ribbon_section(model, 0).EI, zp_ribbon_section(model, 1).EI);
  return hangs > 0 ? sqrt(EI * (double)zp_halves(&model->topology) / hangs) : INFINITY;
}

double zp_mesh_resolution(const ZpModel *model, double voltage) {
  if (zp_half_elements(&model->topology) == 0) return INFINITY;
  return fmin(zp_front_length(model, voltage), hanging_length(model)) / model->l;
}
