/* Points of a rod at which laws that are not linear in the curvature take it, eq. (8.11): kappa = k / l of a joint that
 * bends alone, over the length l; of two that bend together, eq. (8.9), three points, each a sum of both joints' k,
 * which leave what is quadratic in it exact. k counts from the joint's natural one. */
#ifndef ZP_RIBBON_ROD_POINT_H
#define ZP_RIBBON_ROD_POINT_H

#include "ribbon/rod_step.h"

enum { ZP_ROD_END_POINTS = 3 }; /* of two joints that bend together */

typedef struct ZpRodPoint {
  double length;   /* that it stands for, m; 0: nothing bends there */
  int joints;      /* that it depends on: 1 or 2 */
  size_t joint[2]; /* that at the held slope first */
  double share[2]; /* of their k in the curvature times l */
  size_t end;      /* which of the rod's ends, of two joints */
} ZpRodPoint;

/* First one for each joint, then those of each end. */
size_t zp_rod_point_count(const ZpRodParams *params);
ZpRodPoint zp_rod_point(const ZpRodParams *params, size_t i);

/* Of which ribbon it is. */
size_t zp_rod_point_ribbon(const ZpRodParams *params, const ZpRodPoint *point);

/* The point at joint j, where it depends on whatever joints. */
size_t zp_rod_point_at(const ZpRodParams *params, size_t j);

/* Its curvature beyond the natural one at the last eval, 1/m. */
double zp_rod_point_curvature(const ZpRodParams *params, const ZpRodPoint *point, const ZpRodEval *eval);

/* Take a moment M, N m, and its derivative K by the curvature at the end, N m^2, from the step's joints. */
void zp_rod_point_take(const ZpRodParams *params, const ZpRodPoint *point, double M, double K, const ZpRodEval *end,
                       ZpRodStep *step);

#endif
