/* The paper's drag: each particle is slowed by the square of its speed, eq. (5) of the paper. */
#ifndef ZP_RIBBON_DRAG_H
#define ZP_RIBBON_DRAG_H

#include <stddef.h>

/* (c N s2/m2, velocities, 1/mass of each of `count` particles) => forces, N; `power` lost, W; returns the
 * largest |v| / m, from which the drag bound of eq. (9) follows as 2 / (c |v| / m). */
double zp_drag(double c, size_t count, const double *vx, const double *vy, const double *inverse_mass, double *fx,
               double *fy, double *power);

#endif
