/* Stress of the metal of a ribbon, from the positions of its nodes alone. Theory, eqs. (2.4) and (8.7). */
#ifndef ZP_RIBBON_STRESS_H
#define ZP_RIBBON_STRESS_H

#include <stdbool.h>

#include "ribbon/rod.h"

typedef struct ZpStressParams {
  ZpRodParams rod; /* stiffnesses and natural turns of edges and joints */
  bool springs;    /* joints of mass_spring: their moment is B 2 tan(phi / 2) (1 + tan(phi / 2)^2), none together */
  const double *per_moment; /* [nodes * ribbons] of the section that is stressed most within half an edge, Pa/(N m) */
  const double *per_force;  /* [nodes * ribbons] likewise, Pa/N */
} ZpStressParams;

/* (positions [lanes]; plastic strains as of rod_plastic.h, NULL: none) => stress [nodes * ribbons] at the nodes: the
 * largest over the section, Pa, at least 0. */
void zp_stress(const ZpStressParams *params, const double *x, const double *y, const double *strain, double *stress);

#endif
