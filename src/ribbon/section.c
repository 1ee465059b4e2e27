/* Classical laminate of a wide strip. Letters of docs/theory.md, section 2:
 *   E' plane-strain modulus E / (1 - nu^2) of a layer    z_n height of the neutral axis, m
 */
#include "ribbon/section.h"

#include <math.h>

double zp_bending_modulus(const ZpLayer *layer, int plane_strain) {
  double nu = layer->poisson_ratio;
  return plane_strain ? layer->young_modulus / (1 - nu * nu) : layer->young_modulus;
}

ZpSection zp_section(const ZpLayer *layer, int count, double width, int plane_strain) {
  ZpSection section = {0};
  double stiffness = 0, moment = 0, z = 0; /* of E' over the height */
  for (int i = 0; i < count; i++) {
    double h = layer[i].thickness, E = zp_bending_modulus(&layer[i], plane_strain);
    section.EA += layer[i].young_modulus * h * width;
    section.mu += layer[i].density * h * width;
    stiffness += E * h;
    moment += E * h * (z + h / 2);
    z += h;
  }
  double z_n = stiffness > 0 ? moment / stiffness : 0;
  section.axis = z_n;
  section.strained = stiffness * width;
  z = 0;
  for (int i = 0; i < count; i++) {
    double h = layer[i].thickness, arm = z + h / 2 - z_n;
    section.EI += zp_bending_modulus(&layer[i], plane_strain) * width * (h * h * h / 12 + h * arm * arm);
    z += h;
  }
  double outermost = fmax(z_n, fabs(layer[0].thickness - z_n));
  if (section.EI > 0) section.per_moment = zp_bending_modulus(&layer[0], plane_strain) * outermost / section.EI;
  if (section.EA > 0) section.per_force = layer[0].young_modulus / section.EA;
  return section;
}

/* Second moment of a layer from z0 to z1 about the neutral axis, per modulus and width. */
static double moment_between(double z0, double z1) {
  return (z1 * z1 * z1 - z0 * z0 * z0) / 3;
}

/* EI is least about the neutral axis, so to first order it does not change as the axis moves. The layers above one that
 * grows rise with its upper face. */
ZpSection zp_section_by(const ZpLayer *layer, int count, double width, int plane_strain, int which, ZpLayerNumber by) {
  const ZpLayer *of = &layer[which], unit = {.young_modulus = 1, .poisson_ratio = of->poisson_ratio};
  double z = -zp_section(layer, count, width, plane_strain).axis;
  for (int i = 0; i < which; i++)
    z += layer[i].thickness;
  double top = z + of->thickness, modulus = zp_bending_modulus(&unit, plane_strain);
  if (by == ZP_LAYER_DENSITY) return (ZpSection){.mu = of->thickness * width};
  if (by == ZP_LAYER_MODULUS)
    return (ZpSection){.EA = of->thickness * width, .EI = modulus * width * moment_between(z, top)};
  ZpSection rate = {.EA = of->young_modulus * width, .mu = of->density * width};
  rate.EI = modulus * rate.EA * top * top;
  for (int i = which + 1; i < count; i++) {
    double above = top + layer[i].thickness;
    rate.EI += zp_bending_modulus(&layer[i], plane_strain) * width * (above * above - top * top);
    top = above;
  }
  return rate;
}
