/* Arithmetic of vectors. */
#ifndef ZP_MATH_VECTOR_H
#define ZP_MATH_VECTOR_H

#include <stddef.h>

/* => a . b, summed from the first member to the last. */
static inline double zp_dot(size_t n, const double *a, const double *b) {
  double sum = 0;
  for (size_t i = 0; i < n; i++)
    sum += a[i] * b[i];
  return sum;
}

/* In space: a . b; out += factor v; out += factor a x b; out = a x b; M += factor (a b' + b a') / 2. */
static inline double zp_space_dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void zp_space_add(double factor, const double v[3], double out[3]) {
  for (int i = 0; i < 3; i++)
    out[i] += factor * v[i];
}

static inline void zp_space_add_cross(double factor, const double a[3], const double b[3], double out[3]) {
  out[0] += factor * (a[1] * b[2] - a[2] * b[1]);
  out[1] += factor * (a[2] * b[0] - a[0] * b[2]);
  out[2] += factor * (a[0] * b[1] - a[1] * b[0]);
}

static inline void zp_space_cross(const double a[3], const double b[3], double out[3]) {
  out[0] = out[1] = out[2] = 0;
  zp_space_add_cross(1, a, b, out);
}

static inline void zp_space_add_symmetric(double factor, const double a[3], const double b[3], double M[3][3]) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      M[i][j] += 0.5 * factor * (a[i] * b[j] + b[i] * a[j]);
}

#endif
