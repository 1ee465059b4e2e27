#include "math/eigen.h"

#include <math.h>

/* Turn rows and columns p, q so that a[p][q] becomes 0. */
static void rotate(size_t n, double *a, double *v, size_t p, size_t q) {
  double apq = a[p * n + q];
  if (apq == 0) return;
  double theta = (a[q * n + q] - a[p * n + p]) / (2 * apq);
  double t = copysign(1, theta) / (fabs(theta) + sqrt(theta * theta + 1));
  double c = 1 / sqrt(t * t + 1), s = t * c;
  for (size_t k = 0; k < n; k++) {
    double kp = a[k * n + p], kq = a[k * n + q];
    a[k * n + p] = c * kp - s * kq;
    a[k * n + q] = s * kp + c * kq;
  }
  for (size_t k = 0; k < n; k++) {
    double pk = a[p * n + k], qk = a[q * n + k];
    a[p * n + k] = c * pk - s * qk;
    a[q * n + k] = s * pk + c * qk;
    double vp = v[k * n + p], vq = v[k * n + q];
    v[k * n + p] = c * vp - s * vq;
    v[k * n + q] = s * vp + c * vq;
  }
}

static void swap_columns(size_t n, double *a, double *v, size_t i, size_t j) {
  double kept = a[i * n + i];
  a[i * n + i] = a[j * n + j];
  a[j * n + j] = kept;
  for (size_t k = 0; k < n; k++) {
    kept = v[k * n + i];
    v[k * n + i] = v[k * n + j];
    v[k * n + j] = kept;
  }
}

void zp_eigen_symmetric(size_t n, double *a, double *v) {
  enum { SWEEPS = 30 }; /* ten are more than enough for matrices of a dozen rows */
  for (size_t i = 0; i < n * n; i++)
    v[i] = i % (n + 1) == 0;
  for (int sweep = 0; sweep < SWEEPS; sweep++)
    for (size_t p = 0; p < n; p++)
      for (size_t q = p + 1; q < n; q++)
        rotate(n, a, v, p, q);
  for (size_t i = 0; i < n; i++)
    for (size_t j = i + 1; j < n; j++)
      if (a[j * n + j] < a[i * n + i]) swap_columns(n, a, v, i, j);
}
