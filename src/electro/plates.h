/* The parallel-plates law: attraction of two insulated electrodes per length, as if each piece were a
 * plane capacitor of liquid and two insulators in series, with or without what its lateral edges add; and its totals
 * over a polyline of nodes. Forces on the nodes are those of plates_step.h, over a time step or at rest.
 *
 * Stations are pairs of nodes that face each other. All forces are of one modelled half.
 */
#ifndef ZP_ELECTRO_PLATES_H
#define ZP_ELECTRO_PLATES_H

#include <stdbool.h>
#include <stddef.h>

#include "base/memory.h"
#include "base/pair.h"
#include "math/cover.h"
#include "math/level.h"

#define ZP_EPS0 8.8541878128e-12 /* electric constant, F/m, CODATA 2018 */

typedef struct ZpPlatesParams {
  size_t nodes;                  /* N stations */
  size_t lanes;                  /* places of arrays over the nodes of both ribbons, at least 2 N */
  double k;                      /* scale * eps0 eps_m w share^2 / 2: W = k U^2 / (g + d)^2, N m^2/(V^2 m) */
  double relative;               /* permittivity over that of the liquid: 1, of air below it */
  double d;                      /* liquid thickness that stands for both insulators, m */
  double h_per_volt;             /* g + d at which breakdown sets in, per volt: share / E_bd; 0 without cap */
  double h_least;                /* g + d below which the law is not followed further, m */
  double h_switch_per_volt;      /* the authors' breakdown switch, surface.h: share / E_bd; 0 without */
  double switch_offset;          /* what it takes for g + d - g, m */
  bool flat;                     /* one ribbon below a rigid electrode instead of two that face each other */
  const double *face;            /* [N] y of that electrode's face at each station, m, eq. (35.1) */
  size_t platform, platform_end; /* first and last station of the platform: elements between them attract nothing */
  ZpLevelEnds level;             /* elements with a level end */
  double flat_length;            /* of its electrode, at the gap of each of these, m; 0 without */

  const struct ZpEdgeLaw *edges;    /* what lateral edges add, edges.h; NULL without */
  const struct ZpPlatesParams *air; /* the law where there is no liquid; k, relative, d, h_per_volt, h_least and edges
                                       of it count. NULL: liquid is everywhere */
} ZpPlatesParams;

/* Written by zp_plates_gaps. */
typedef struct ZpPlatesEval {
  double *gap;          /* [N] face distance, m */
  double *dx;           /* [N-1] mean of both ribbons' x-lengths of an element, m */
  const ZpCover *cover; /* the caller's, with a law of air: where liquid is; NULL: everywhere */
} ZpPlatesEval;

/* A part of an element in which one law holds. */
typedef struct ZpPlatesPiece {
  const ZpPlatesParams *law;
  double from, to; /* 0 .. 1 */
} ZpPlatesPiece;

/* The pieces of element i, a part of which liquid covers => how many. */
int zp_plates_pieces(const ZpPlatesParams *params, double covered, size_t i, ZpPlatesPiece piece[2]);

/* The share of the right station in what is sampled at Gauss point q of a piece of element i. */
double zp_plates_share(const ZpPlatesParams *params, const ZpPlatesPiece *piece, size_t i, int q);

/* How much of the platform's faces at station i liquid wets. */
double zp_plates_flat(const ZpPlatesParams *params, const ZpCover *cover, size_t i);

/* The law at one gap. */
typedef struct ZpPlatesLaw {
  double W; /* attraction per length, N/m; at most the cap, eq. (4.3) */
  double P; /* potential per length at constant voltage, J/m: W = dP/dg, eq. (4.4) */
  double q; /* charge per length = -dP/dU, C/m, eq. (4.5) */
} ZpPlatesLaw;
ZpPlatesLaw zp_plates_law(const ZpPlatesParams *params, double voltage, double gap);

/* dW/dg there, N/m^2; 0 where the law is capped. */
double zp_plates_slope(const ZpPlatesParams *params, double voltage, double gap);

/* The g + d below which the force does not rise any more at this voltage, m. */
double zp_plates_least_h(const ZpPlatesParams *params, double voltage);

/* Capacitance per length over eps0 eps_m w at this gap, 1/m: 1 / (g + d), with edges more. */
double zp_plates_inverse_gap(const ZpPlatesParams *params, double gap);

void zp_plates_reserve(const ZpPlatesParams *params, ZpPlatesEval *eval, ZpArena *arena);

/* (x, y of interleaved upper and lower nodes) => eval->gap and eval->dx. */
void zp_plates_gaps(const ZpPlatesParams *params, const double *x, const double *y, ZpPlatesEval *eval);

/* (y of interleaved upper and lower nodes; flat: of one ribbon's) => the gap of station i, m. */
static inline double zp_plates_gap(const ZpPlatesParams *params, const double *y, size_t i) {
  return params->flat ? params->face[i] - y[i] : zp_apart(y, i);
}

/* (y as for zp_plates_gap) => the smallest gap of facing nodes, m. */
double zp_plates_least_gap(const ZpPlatesParams *params, const double *y);

/* Integrals over the polyline at the gaps of the last eval. */
typedef struct ZpPlatesTotals {
  double force;       /* sum of W, N */
  double potential;   /* sum of P, J */
  double charge;      /* sum of q, C */
  double inverse_gap; /* sum of length / (g + d), with edges: capacitance over eps0 eps_m w */
} ZpPlatesTotals;
ZpPlatesTotals zp_plates_totals(const ZpPlatesParams *params, const ZpPlatesEval *eval, double voltage);

/* With a cover: over the elements from `first` on before `end`, and the platform. */
ZpPlatesTotals zp_plates_totals_among(const ZpPlatesParams *params, const ZpPlatesEval *eval, double voltage,
                                      size_t first, size_t end);

#endif
