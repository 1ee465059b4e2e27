/* A section that yields: fibre by fibre of its metal, stretched and bent, with linear kinematic hardening; other layers
 * stay elastic. docs/theory.md, eqs. (2.8) to (2.12), (39.5) and (39.6). */
#ifndef ZP_RIBBON_PLASTIC_H
#define ZP_RIBBON_PLASTIC_H

#include "ribbon/maxwell.h"
#include "ribbon/section.h"

enum { ZP_FIBRES = 32 }; /* through the thickness of the metal */

typedef struct ZpPlastic {
  double E;               /* modulus of the metal in bending, Pa */
  double yields;          /* its yield stress, Pa */
  double hardening;       /* its stress per plastic strain, Pa */
  double EI;              /* bending stiffness of the whole section, N m^2 */
  double EA;              /* what the whole section resists a strain of its axis with, as fibres do, N */
  double share;           /* of that its stiffness along, which is not in plane strain, 0 to 1; 0: nothing pulls */
  double surface[2];      /* heights of the metal's faces over the neutral axis, m */
  double z[ZP_FIBRES];    /* heights of the fibres, m */
  double part[ZP_FIBRES]; /* of EA, N */
} ZpPlastic;

/* (metal, which is the first layer; section that it is part of; width m; plane strain?; yield stress Pa; hardening
 * modulus Pa) => its fibres. */
ZpPlastic zp_plastic(const ZpLayer *metal, const ZpSection *section, double width, int plane_strain, double yields,
                     double hardening);

/* Below, `strain` is that of the axis, with which the section is stretched, beside the curvature, 1/m.
 *
 * (plastic strains p0 [ZP_FIBRES] before; NULL: none) => plastic strains p1 [ZP_FIBRES] there, and what they take from
 * the elastic moment, EI times the curvature, and tension. */
ZpSectionForce zp_plastic_bend(const ZpPlastic *plastic, const double *p0, double curvature, double strain, double *p1);

/* Moment and tension that plastic strains take, without derivatives. */
ZpSectionForce zp_plastic_force(const ZpPlastic *plastic, const double *p);

/* As zp_plastic_bend of plastic strains that are found: fibres yield where p1 is not p0. */
ZpSectionForce zp_plastic_again(const ZpPlastic *plastic, const double *p0, const double *p1);

/* Strain of the axis that is left where no force acts. */
double zp_plastic_elongation(const ZpPlastic *plastic, const double *p);

/* How much less than the elastic energy is stored, with what hardening stores, J/m. */
double zp_plastic_relief(const ZpPlastic *plastic, const double *p, double curvature, double strain);

/* Heat of the way from one shape and plastic strain to others, J/m, at least 0: work of mean moment and tension less
 * what is stored. */
double zp_plastic_heat(const ZpPlastic *plastic, const double *p0, ZpBent from, const double *p1, ZpBent to);

/* The largest stress of the metal, Pa, with the plastic strains p0 (NULL: none) before. */
double zp_plastic_stress(const ZpPlastic *plastic, const double *p0, double curvature, double strain);

#endif
