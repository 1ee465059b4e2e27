/* Functions that C libraries round differently, from + - x / alone: the same bits everywhere. */
#ifndef ZP_MATH_ELEMENTARY_H
#define ZP_MATH_ELEMENTARY_H

double zp_cube_root(double x); /* x > 0; infinity of infinity */
double zp_tangent(double x);   /* |x| < pi / 2 */
double zp_decay(double x);     /* exp(-x) - 1, x >= 0 */

#endif
