/* Functions that C libraries round differently, from + - x / alone: the same bits everywhere. */
#ifndef ZP_MATH_ELEMENTARY_H
#define ZP_MATH_ELEMENTARY_H

/* Half a turn, rad. */
static const double zp_pi = 3.14159265358979323846;

double zp_cube_root(double x); /* x > 0; infinity of infinity */
double zp_tangent(double x);   /* |x| < pi / 2 */
double zp_decay(double x);     /* exp(-x) - 1, x >= 0 */

/* 1 / (1 - exp(-x)) - 1 / x, x >= 0, 1/2 at 0: weight of the end in a step of x time constants with which a decay is
 * exact. */
double zp_decay_weight(double x);

double zp_logarithm(double x);       /* natural, x > 0 */
double zp_power(double x, double p); /* x^p, 0 <= x <= 1, p >= 0; 1 for p = 0 */
double zp_angle(double y, double x); /* of the vector (x, y), -pi .. pi, rad; 0 of a vector without length */

double zp_sine_squared(double p); /* sin(pi p)^2, p >= 0 */
double zp_cosine_of(double p);    /* cos(2 pi p), p > -1 */
double zp_sine_of(double p);      /* sin(2 pi p), p > -3/4 */

#endif
