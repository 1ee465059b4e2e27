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
