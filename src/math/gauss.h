/* Gauss's three points on [0, 1]: exact for polynomials of degree 5. One table for all that is integrated inside
 * elements, so that what must balance there, attraction and contact, does so point by point. */
#ifndef ZP_MATH_GAUSS_H
#define ZP_MATH_GAUSS_H

enum { GAUSS = 3 };
static const double gauss_at[GAUSS] = {0.11270166537925831, 0.5, 0.88729833462074169};
static const double gauss_weight[GAUSS] = {5.0 / 18, 8.0 / 18, 5.0 / 18};

#endif
