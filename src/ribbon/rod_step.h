/* The rod's forces over a time step: they do exactly the work by which its energy changes from one end of the step to
 * the other, whatever the step, with Kelvin-Voigt damping in the same form. At rest both ends are one point (`start ==
 * end`, damping 0): the forces are then minus the energy's gradient. docs/theory.md, sections 8 and 18. */
#ifndef ZP_RIBBON_ROD_STEP_H
#define ZP_RIBBON_ROD_STEP_H

#include <stdbool.h>

#include "ribbon/rod.h"

/* Written by zp_rod_step. */
typedef struct ZpRodStep {
  double *tx, *ty;                 /* edges: mean of both ends' edges over the mean of their lengths */
  double *gx, *gy;                 /* edges: what times the change of the edge is its rotation, 1/m */
  double *turn;                    /* edges: rotation from start to end, rad */
  double *T;                       /* edges: tension over the step, N */
  double *M;                       /* joints: moment over the step, N m */
  double *slope;                   /* joints: (k1 - k0) / (phi1 - phi0) */
  double *stiffness;               /* joints: dM/dphi, N m */
  double across[ZP_ROD_MOST_ENDS]; /* of joints that bend together: dM/dphi of the other one, N m */
  double *endx, *endy;             /* edges at the end, m */
  double *tension;            /* edges: tension that the last change of the end foresaw, N; the stiffness takes it */
  bool begun;                 /* an end was tried since zp_rod_step_begin */
  const double *strain_start; /* plastic strains at the start (rod_plastic.h); NULL: none */
  double *strain_end;         /* and at the end */
  double h;                   /* length of the step, s; 0: rest */
  const double *spring_start; /* strains of springs of layers that creep, at the start (rod_maxwell.h); NULL: none */
  double *spring_end;         /* and at the end */
  double *Rx, *Ry;            /* edges: force on the right node, N; the left one gets the opposite; outside: 0 */
} ZpRodStep;

void zp_rod_step_reserve(const ZpRodParams *params, ZpRodStep *step, ZpArena *arena);

/* A step is to be tried: its tension is first taken for that at its start. */
void zp_rod_step_begin(const ZpRodParams *params, const ZpRodEval *start, ZpRodStep *step);

/* (evals at both ends of the step, internal damping time over the step's length) => all of `step`. Force on node j:
 * R[j - s] - R[j]. */
void zp_rod_step(const ZpRodParams *params, const ZpRodEval *start, const ZpRodEval *end, double damping,
                 ZpRodStep *step);

/* Forces of the last zp_rod_step if the stretching and bending stiffness of each ribbon were multiplied by a factor =>
 * T, M, Rx, Ry. */
void zp_rod_step_scale(const ZpRodParams *params, const double axial[2], const double bending[2], ZpRodStep *step);

/* Loss by internal damping over the step, J. */
double zp_rod_step_loss(const ZpRodParams *params, const ZpRodEval *start, const ZpRodEval *end, double damping);

/* Derivative by the end's edges at the last zp_rod_step: D[3 j + m] = -dR_j / d(edge j + (m - 1) s), m = 0, 1, 2, row
 * by row. At rest it is half of the second derivatives of the energy. Symmetric: what makes the exact one unsymmetric,
 * a quarter of the step's rotation times the stretching stiffness, is left out. `tension` [edges] is that which a
 * solver foresees, N; step->T for that of the last zp_rod_step. */
void zp_rod_stiffness(const ZpRodParams *params, const ZpRodEval *start, const ZpRodEval *end, double damping,
                      const ZpRodStep *step, const double *tension, double (*D)[4]);

/* At one point, of which both evals are: what internal damping of 1 s adds to that derivative over a step of 1 s => D;
 * `spare` is as long as D. */
void zp_rod_damping(const ZpRodParams *params, const ZpRodEval *start, const ZpRodEval *end, ZpRodStep *step,
                    double (*spare)[4], double (*D)[4]);

#endif
