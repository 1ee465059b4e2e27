/* Layers that creep: a spring and a dashpot in series, a Maxwell branch, beside the stiffness of a layer, which is that
 * at rest: a standard linear solid. The state of a branch is the strain of its spring, in bending and along.
 * docs/theory.md, eqs. (39.8) to (39.10). */
#ifndef ZP_RIBBON_MAXWELL_H
#define ZP_RIBBON_MAXWELL_H

#include "ribbon/section.h"

/* Curvature, 1/m, and strain of a section. */
typedef struct ZpBent {
  double curvature, strain;
} ZpBent;

/* The branch of a layer: stiffnesses of its section about the neutral axis of the whole section. */
typedef struct ZpMaxwell {
  double EA, ES, EI; /* along, N; between both, N m; in bending, N m^2 */
  double time;       /* of relaxation at a constant shape, s */
} ZpMaxwell;

/* (layer, whose Young's modulus is that of the branch; height of its lower face over the neutral axis m; width m; plane
 * strain?; time) => its branch. */
ZpMaxwell zp_maxwell(const ZpLayer *layer, double below, double width, int plane_strain, double time);

/* Weights over a step in which the shape changes at a constant rate, eq. (39.9). */
typedef struct ZpMaxwellStep {
  double left;       /* of a strain of the spring, at the end */
  double mean, come; /* of it, on average, and of a change of the shape at the end */
  double half;       /* of a change of the shape, on average */
} ZpMaxwellStep;

/* (step over the time of relaxation, above 0) => the weights. */
ZpMaxwellStep zp_maxwell_step(double h);

/* Strains of the spring at the end, and on average, after a change of the shape. */
ZpBent zp_maxwell_end(const ZpMaxwellStep *step, ZpBent spring, ZpBent change);
ZpBent zp_maxwell_mean(const ZpMaxwellStep *step, ZpBent spring, ZpBent change);

/* Error of the shape at the end of a step, in which a section of the bending stiffness EI and the stiffness EA creeps
 * from a strain of its spring to another one, eq. (39.12): curvature, 1/m, and strain. */
ZpBent zp_maxwell_error(const ZpMaxwell *branch, double EI, double EA, double step, ZpBent from, ZpBent to);

/* Moment and tension of a spring. Its derivatives are the branch's stiffnesses times `share`. */
ZpSectionForce zp_maxwell_force(const ZpMaxwell *branch, ZpBent spring, double share);

/* Energy of a spring, J/m. */
double zp_maxwell_energy(const ZpMaxwell *branch, ZpBent spring);

#endif
