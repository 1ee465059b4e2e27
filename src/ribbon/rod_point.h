/* Points of a rod at which laws that are not linear, or remember, take its curvature and its strain. By eq. (8.11)
 * kappa = k / l of a joint that bends alone, over the length l; of two that bend together, eq. (8.9), three points,
 * each a sum of both joints' k, which leave what is quadratic in it exact. k counts from the joint's natural one. The
 * strain is a mean of those of the edges beside the joint, eq. (39.7), so that each edge counts with its whole length.
 */
#ifndef ZP_RIBBON_ROD_POINT_H
#define ZP_RIBBON_ROD_POINT_H

#include "ribbon/rod_step.h"

enum { ZP_ROD_END_POINTS = 3 }; /* of two joints that bend together */

typedef struct ZpRodPoint {
  double length;   /* that it stands for, m; 0: nothing bends or stretches there */
  int joints;      /* that it depends on: 1 or 2 */
  size_t joint[2]; /* that at the held slope first */
  double share[2]; /* of their k in the curvature times l */
  size_t end;      /* which of the rod's ends, of two joints */
  int edges;       /* beside it: 1 or 2 */
  size_t edge[2];  /* from left to right */
  double part[2];  /* of their strains in its strain; 0 of edges that are not of the ribbon alone */
} ZpRodPoint;

/* First one for each joint, then those of each end. */
size_t zp_rod_point_count(const ZpRodParams *params);
ZpRodPoint zp_rod_point(const ZpRodParams *params, size_t i);

/* Of which ribbon it is. */
size_t zp_rod_point_ribbon(const ZpRodParams *params, const ZpRodPoint *point);

/* The point at joint j, where it depends on whatever joints. */
size_t zp_rod_point_at(const ZpRodParams *params, size_t j);

/* Its curvature beyond the natural one at the last eval, 1/m; positive where it stretches the last layer of the ribbon.
 */
double zp_rod_point_curvature(const ZpRodParams *params, const ZpRodPoint *point, const ZpRodEval *eval);

/* Its strain there. */
double zp_rod_point_strain(const ZpRodParams *params, const ZpRodPoint *point, const ZpRodEval *eval);

/* Take moment and tension, whose derivatives are those by curvature and strain at the end, from the step's joints and
 * edges. */
void zp_rod_point_take(const ZpRodParams *params, const ZpRodPoint *point, const ZpSectionForce *force,
                       const ZpRodEval *end, ZpRodStep *step);

/* How its curvature and its strain go with displacements of nodes [lanes], at the last step. */
ZpBent zp_rod_point_change(const ZpRodParams *params, const ZpRodPoint *point, const ZpRodStep *step, const double *x,
                           const double *y);

/* After zp_rod_stiffness without it: what the derivatives take from D beside those of joints, which the step has. */
void zp_rod_point_soften(const ZpRodParams *params, const ZpRodPoint *point, const ZpSectionForce *force,
                         const ZpRodStep *step, double (*D)[4]);

#endif
