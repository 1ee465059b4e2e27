/* A planar discrete elastic rod: edges that stretch, joints that bend. Its strains and energies at a point; its forces
 * are those of rod_step.h, over a time step or at rest.
 *
 * All ribbons at once: node i of ribbon r is at [i * ribbons + r], edge i (node i to i+1) and joint i (at
 * node i) likewise. Joints stand at every node; those of the first and last nodes, and at both ends
 * of rigid edges, tie the rod to a held slope, over half a cell, or are absent (B = 0) at a free end. */
#ifndef ZP_RIBBON_ROD_H
#define ZP_RIBBON_ROD_H

#include <stdbool.h>
#include <stddef.h>

#include "base/memory.h"
#include "ribbon/curl.h"
#include "ribbon/maxwell.h"
#include "ribbon/plastic.h"

/* Two joints that bend together, eq. (8.9): the one at a held slope, and the one beside it. */
typedef struct ZpRodEnd {
  size_t held, next; /* joints */
  size_t near, far;  /* the edges of `next`: towards the held slope, and away from it */
  double B;          /* stiffness between both, N m */
} ZpRodEnd;
enum { ZP_ROD_MOST_ENDS = 8 };

/* Branches of layers that creep: of the metal and of the tape. */
enum { ZP_BRANCHES = 2 };

typedef struct ZpRodParams {
  size_t ribbons;          /* s */
  size_t nodes;            /* N per ribbon */
  size_t lanes;            /* places of node arrays, a multiple of ZP_LANES, at least ZP_LANES more than edges */
  double cell;             /* length of rod that a joint between two edges stands for, m */
  const double *l;         /* [lanes] rest lengths of edges, m */
  const double *S;         /* [lanes] stretching stiffness EA / l of edges, N/m */
  const double *B;         /* [lanes] bending stiffness of joints, EI over their length of rod, N m */
  const double *k0;        /* [lanes] natural curvature k of joints */
  size_t rigid, rigid_end; /* stations between which edges are rigid and horizontal, as held slopes are; equal: none */
  bool lower_turns;        /* but that of the second ribbon: there it is an edge as others, which turns and stretches */
  size_t ends;
  ZpRodEnd end[ZP_ROD_MOST_ENDS];
  ZpCurl curl[2];           /* of each ribbon, which then is of one section and not bent by nature */
  const ZpMaxwell *branch;  /* [ribbons * ZP_BRANCHES], without those whose time is 0; NULL: no layer creeps */
  double side[2];           /* of each ribbon 1 or -1: a curvature of this sign stretches its last layer */
  const ZpPlastic *plastic; /* [ribbons], which then are of one section each; NULL: they stay elastic */
} ZpRodParams;

/* Written by zp_rod_eval. Arrays over edges and joints, with one edge more before the first and after the
 * last of each ribbon: the held slopes. */
typedef struct ZpRodEval {
  double *dpx, *dpy; /* edges, m; rigid: 1, 0 */
  double *ux, *uy;   /* their unit vectors; outside: horizontal */
  double *inverse;   /* 1 / length; outside: 0, a held slope does not turn */
  double *T;         /* [lanes] tension of edges, N */
  double *half;      /* [lanes] tan(phi / 2) of joints */
  double *k;         /* [lanes] their discrete curvature, eq. (8.2) */
} ZpRodEval;

void zp_rod_reserve(const ZpRodParams *params, ZpRodEval *eval, ZpArena *arena);

/* Is edge j, between the stations rigid and rigid_end, rigid and horizontal? */
static inline bool zp_rod_is_rigid(const ZpRodParams *p, size_t j) {
  return !(p->lower_turns && j % p->ribbons == 1);
}

/* tan(phi / 2) of a joint => its discrete curvature. */
static inline double zp_rod_curvature(double half) {
  return half * (4 + 2 / (1 + half * half)) * (1.0 / 3);
}

/* (positions [lanes]) => all of eval. */
void zp_rod_eval(const ZpRodParams *params, const double *x, const double *y, ZpRodEval *eval);

/* Energies at the last eval, J. */
double zp_rod_stretching_energy(const ZpRodParams *params, const ZpRodEval *eval);
double zp_rod_bending_energy(const ZpRodParams *params, const ZpRodEval *eval);

#endif
