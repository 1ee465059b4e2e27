/* Householder reflections to Hessenberg form, then Francis's double shifts, as in EISPACK's hqr. */
#include "math/eigen_general.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* -- balance and Hessenberg form -------------------------------------------------------------------- */

/* Powers of 2 that make rows and columns alike in size. */
static void balance(size_t n, double *a) {
  bool changed = true;
  for (int sweep = 0; changed && sweep < 100; sweep++) {
    changed = false;
    for (size_t i = 0; i < n; i++) {
      double row = 0, column = 0, factor = 1;
      for (size_t j = 0; j < n; j++) {
        row += j == i ? 0 : fabs(a[i * n + j]);
        column += j == i ? 0 : fabs(a[j * n + i]);
      }
      if (row == 0 || column == 0) continue;
      double before = row + column;
      while (column < row / 2) {
        factor *= 2;
        column *= 4;
      }
      while (column >= row * 2) {
        factor /= 2;
        column /= 4;
      }
      if (!((column + row) / factor < 0.95 * before)) continue;
      changed = true;
      for (size_t j = 0; j < n; j++)
        a[i * n + j] /= factor;
      for (size_t j = 0; j < n; j++)
        a[j * n + i] *= factor;
    }
  }
}

/* Column k below its subdiagonal becomes 0: a => H a H with H = 1 - u u' / half. */
static void reflect(size_t n, double *a, size_t k, double *u) {
  double sum = 0;
  for (size_t i = k + 1; i < n; i++) {
    u[i] = a[i * n + k];
    sum += u[i] * u[i];
  }
  double length = copysign(sqrt(sum), u[k + 1]), half = sum + length * u[k + 1];
  if (sum == u[k + 1] * u[k + 1]) return;
  u[k + 1] += length;
  for (size_t j = k; j < n; j++) {
    double along = 0;
    for (size_t i = k + 1; i < n; i++)
      along += u[i] * a[i * n + j];
    for (size_t i = k + 1; i < n; i++)
      a[i * n + j] -= along / half * u[i];
  }
  for (size_t i = 0; i < n; i++) {
    double along = 0;
    for (size_t j = k + 1; j < n; j++)
      along += u[j] * a[i * n + j];
    for (size_t j = k + 1; j < n; j++)
      a[i * n + j] -= along / half * u[j];
  }
}

/* -- double shifts ---------------------------------------------------------------------------------- */

typedef struct Schur {
  size_t n;
  double *a;
} Schur;

static double *at(const Schur *s, size_t i, size_t j) {
  return &s->a[i * s->n + j];
}

/* The block that ends with row `last` begins here: above it a subdiagonal entry is nothing. */
static size_t start_of_block(const Schur *s, size_t last, double size) {
  size_t l = last;
  for (; l > 0; l--) {
    double beside = fabs(*at(s, l, l)) + fabs(*at(s, l - 1, l - 1));
    if (beside == 0) beside = size;
    if (fabs(*at(s, l, l - 1)) <= DBL_EPSILON * beside) break;
  }
  if (l > 0) *at(s, l, l - 1) = 0;
  return l;
}

/* Eigenvalues of the two rows that end with `last`. */
static void pair(const Schur *s, size_t last, ZpEigenvalue *value) {
  double a = *at(s, last - 1, last - 1), d = *at(s, last, last), bc = *at(s, last - 1, last) * *at(s, last, last - 1);
  double half = 0.5 * (a - d), inside = half * half + bc, root = sqrt(fabs(inside));
  if (inside < 0) {
    value[last - 1] = (ZpEigenvalue){d + half, root};
    value[last] = (ZpEigenvalue){d + half, -root};
    return;
  }
  double far = half + copysign(root, half);
  value[last - 1] = value[last] = (ZpEigenvalue){d + far, 0};
  if (far != 0) value[last].re = d - bc / far;
}

/* One reflection of a sweep, of rows and columns k to k + 2. */
static void chase(const Schur *s, size_t k, size_t first, size_t last, const double v[3]) {
  double x = v[0], y = v[1], z = v[2], length = copysign(sqrt(x * x + y * y + z * z), x);
  if (length == 0) return;
  double u[3] = {x + length, y, z}, half = length * (length + x);
  size_t rows = k + 2 <= last ? 3 : 2, from = k > first ? k - 1 : first, to = k + 3 < last ? k + 3 : last;
  for (size_t j = from; j <= last; j++) {
    double along = 0;
    for (size_t m = 0; m < rows; m++)
      along += u[m] * *at(s, k + m, j);
    for (size_t m = 0; m < rows; m++)
      *at(s, k + m, j) -= along / half * u[m];
  }
  for (size_t i = first; i <= to; i++) {
    double along = 0;
    for (size_t m = 0; m < rows; m++)
      along += u[m] * *at(s, i, k + m);
    for (size_t m = 0; m < rows; m++)
      *at(s, i, k + m) -= along / half * u[m];
  }
}

/* One sweep over the block first .. last with the shifts whose sum and product are given. */
static void sweep(const Schur *s, size_t first, size_t last, double sum, double product) {
  double h00 = *at(s, first, first), h10 = *at(s, first + 1, first), h11 = *at(s, first + 1, first + 1);
  double v[3] = {h00 * (h00 - sum) + product + *at(s, first, first + 1) * h10, h10 * (h00 + h11 - sum),
                 first + 2 <= last ? h10 * *at(s, first + 2, first + 1) : 0};
  for (size_t k = first; k < last; k++) {
    if (k > first) {
      v[0] = *at(s, k, k - 1), v[1] = *at(s, k + 1, k - 1);
      v[2] = k + 2 <= last ? *at(s, k + 2, k - 1) : 0;
    }
    chase(s, k, first, last, v);
    if (k > first) *at(s, k + 1, k - 1) = 0;
    if (k > first && k + 2 <= last) *at(s, k + 2, k - 1) = 0;
  }
}

/* Infinite entries would be balanced for ever. */
static bool all_finite(size_t count, const double *a) {
  for (size_t k = 0; k < count; k++)
    if (!isfinite(a[k])) return false;
  return true;
}

bool zp_eigenvalues(size_t n, double *a, double *work, ZpEigenvalue *value) {
  enum { MOST = 60, EXCEPTIONAL = 10 }; /* sweeps for an eigenvalue; after so many other shifts are tried */
  if (!all_finite(n * n, a)) return false;
  balance(n, a);
  for (size_t k = 0; k + 2 < n; k++) {
    reflect(n, a, k, work);
    for (size_t i = k + 2; i < n; i++)
      a[i * n + k] = 0;
  }
  double size = 0;
  for (size_t k = 0; k < n * n; k++)
    size += fabs(a[k]);
  Schur s = {n, a};
  int tries = 0;
  for (size_t left = n; left > 0;) {
    size_t last = left - 1, first = start_of_block(&s, last, size);
    if (last - first < 2) {
      if (first == last)
        value[last] = (ZpEigenvalue){*at(&s, last, last), 0};
      else
        pair(&s, last, value);
      left = first;
      tries = 0;
      continue;
    }
    if (++tries > MOST) return false;
    double a11 = *at(&s, last - 1, last - 1), a22 = *at(&s, last, last);
    double sum = a11 + a22, product = a11 * a22 - *at(&s, last - 1, last) * *at(&s, last, last - 1);
    if (tries % EXCEPTIONAL == 0) {
      double w = fabs(*at(&s, last, last - 1)) + fabs(*at(&s, last - 1, last - 2));
      sum = 1.5 * w, product = w * w;
    }
    sweep(&s, first, last, sum, product);
  }
  return true;
}
