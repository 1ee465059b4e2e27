/* Elastic-plastic bending of a section: the metal yields fibre by fibre, with linear kinematic hardening; other layers
 * stay elastic. docs/theory.md, eqs. (2.8) to (2.12). */
#ifndef ZP_RIBBON_PLASTIC_H
#define ZP_RIBBON_PLASTIC_H

#include <stdbool.h>

#include "ribbon/section.h"

enum { ZP_FIBRES = 32 }; /* through the thickness of the metal */

typedef struct ZpPlastic {
  double E;               /* modulus of the metal in bending, Pa */
  double yields;          /* its yield stress, Pa */
  double hardening;       /* its stress per plastic strain, Pa */
  double EI;              /* bending stiffness of the whole section, N m^2 */
  double EA;              /* what the whole section resists a strain of its axis with, N */
  bool alone;             /* the metal alone is stiff: its axis stays in its middle */
  double surface[2];      /* heights of the metal's faces over the neutral axis, m */
  double z[ZP_FIBRES];    /* heights of the fibres, m */
  double part[ZP_FIBRES]; /* of EA, N */
} ZpPlastic;

/* (metal, which is the first layer; section that it is part of; width m; plane strain?; yield stress Pa; hardening
 * modulus Pa) => its fibres. */
ZpPlastic zp_plastic(const ZpLayer *metal, const ZpSection *section, double width, int plane_strain, double yields,
                     double hardening);

/* Moment that plasticity takes from the elastic one, EI times the curvature, N m, and its derivative by the curvature,
 * N m^2. */
typedef struct ZpPlasticMoment {
  double M, K;
} ZpPlasticMoment;

/* (plastic strains p0 [ZP_FIBRES] before; NULL: none; curvature 1/m) => plastic strains p1 [ZP_FIBRES] at that
 * curvature, and the moment that they take. */
ZpPlasticMoment zp_plastic_bend(const ZpPlastic *plastic, const double *p0, double curvature, double *p1);

/* The moment that plastic strains take, N m. */
double zp_plastic_moment(const ZpPlastic *plastic, const double *p);

/* How much less than 1/2 EI curvature^2 is stored, with what hardening stores, J/m. */
double zp_plastic_relief(const ZpPlastic *plastic, const double *p, double curvature);

/* Heat of the way from one curvature and plastic strain to others, J/m, at least 0: work of the mean moment less what
 * is stored. */
double zp_plastic_heat(const ZpPlastic *plastic, const double *p0, double curvature0, const double *p1,
                       double curvature1);

/* The largest stress of the metal, Pa, at a curvature, with the plastic strains p0 (NULL: none) before. */
double zp_plastic_stress(const ZpPlastic *plastic, const double *p0, double curvature);

#endif
