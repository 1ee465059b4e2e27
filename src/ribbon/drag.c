/* Drag. Letters of docs/theory.md, eq. (3.7): c drag coefficient, N s2/m2;  v speed, m/s. */
#include "ribbon/drag.h"

#include <math.h>

#include "base/kernel.h"

/* Forces -c |v| v, and each particle's |v| / m; `speed` gets |v|. */
ZP_KERNEL static double drag_forces(double c, size_t count, const double *restrict vx, const double *restrict vy,
                                    const double *restrict inverse_mass, double *restrict fx, double *restrict fy) {
  double largest = 0;
  ZP_SIMD_MAX(largest)
  for (size_t j = 0; j < count; j++) {
    double v = sqrt(vx[j] * vx[j] + vy[j] * vy[j]);
    double rate = v * inverse_mass[j];
    fx[j] = -c * v * vx[j];
    fy[j] = -c * v * vy[j];
    largest = rate > largest ? rate : largest;
  }
  return largest;
}

ZP_KERNEL static double lost_power(size_t count, const double *restrict vx, const double *restrict vy,
                                   const double *restrict fx, const double *restrict fy) {
  double lane[ZP_LANES] = {0};
  size_t whole = count / ZP_LANES * ZP_LANES;
  for (size_t j = 0; j < whole; j += ZP_LANES) {
    ZP_SIMD
    for (size_t k = 0; k < ZP_LANES; k++)
      lane[k] -= fx[j + k] * vx[j + k] + fy[j + k] * vy[j + k];
  }
  for (size_t j = whole; j < count; j++)
    lane[j - whole] -= fx[j] * vx[j] + fy[j] * vy[j];
  return zp_sum_lanes(lane);
}

double zp_drag(double c, size_t count, const double *vx, const double *vy, const double *inverse_mass, double *fx,
               double *fy, double *power) {
  double largest = drag_forces(c, count, vx, vy, inverse_mass, fx, fy);
  *power = lost_power(count, vx, vy, fx, fy);
  return largest;
}
