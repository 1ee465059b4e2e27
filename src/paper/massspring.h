/* The mechanics of the paper: particles, axial springs, and shear springs in two frames.
 *
 * All ribbons at once: node i of ribbon r is at [i * ribbons + r], and so is edge i, between nodes i and i+1. */
#ifndef ZP_PAPER_MASSSPRING_H
#define ZP_PAPER_MASSSPRING_H

#include <stdbool.h>
#include <stddef.h>

#include "base/memory.h"

typedef struct ZpMassSpringParams {
  size_t ribbons;   /* s */
  size_t nodes;     /* N, nodes per ribbon */
  size_t lanes;     /* length of node arrays, a multiple of ZP_LANES, at least ZP_LANES more than edges */
  double l;         /* rest length of an edge, m */
  double K_D;       /* axial spring, N/m, eq. (3.2) */
  double K_S;       /* shear spring, N/m, eq. (3.4) */
  bool left_slope;  /* the edge direction before the first node is held horizontal */
  bool right_slope; /* the edge direction after the last node is held horizontal */
} ZpMassSpringParams;

/* Written by zp_massspring_eval, read by the functions that sum forces and energies. */
typedef struct ZpMassSpringEval {
  double *dpx, *dpy; /* [edges] node i+1 - node i, m */
  double *ux, *uy;   /* [-s .. edges + s) unit directions of the edges; outside the edges: the held slope, or 0 */
  double *T;         /* [edges] tension, N */
  double *Rx, *Ry;   /* [-s .. lanes) force of edge on its right node, N; outside the edges: 0 */
} ZpMassSpringEval;

/* Take the arrays of `eval` from `arena`, whose block must be zeroed. */
void zp_massspring_reserve(const ZpMassSpringParams *params, ZpMassSpringEval *eval, ZpArena *arena);

/* (positions [lanes]) => edge directions, tensions and edge forces. The force on node j is R[j - s] - R[j]. */
void zp_massspring_eval(const ZpMassSpringParams *params, const double *x, const double *y, ZpMassSpringEval *eval);

/* Stiffness at the last eval: D[3 j + m] = -dR_j / d(edge j + (m - 1) s), m = 0, 1, 2, row by row. It is not symmetric,
 * because the shear law has no energy. `tension` as in zp_rod_stiffness. */
void zp_massspring_stiffness(const ZpMassSpringParams *params, const ZpMassSpringEval *eval, const double *tension,
                             double (*D)[4]);

/* Energies at the last eval, J. The shear law has no potential; its energy is that of the springs at their current
 * length, which is correct for small bending angles (theory, section 3.4). */
double zp_massspring_axial_energy(const ZpMassSpringParams *params, const ZpMassSpringEval *eval);
double zp_massspring_shear_energy(const ZpMassSpringParams *params, const ZpMassSpringEval *eval);

/* K_S that makes the chain as stiff as a beam with both ends horizontal, N/m, eq. (3.6). */
double zp_massspring_shear_coefficient(double EI, double l, int nodes);

/* Upper bound of the highest frequency for particles of `mass` kg, rad/s, eq. (6.2). */
double zp_massspring_frequency_bound(const ZpMassSpringParams *params, double mass);

#endif
