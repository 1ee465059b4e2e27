#include "math/complex_solve.h"

#include <math.h>

static ZpComplex over(ZpComplex a, ZpComplex b) {
  double size = b.re * b.re + b.im * b.im;
  return (ZpComplex){(a.re * b.re + a.im * b.im) / size, (a.im * b.re - a.re * b.im) / size};
}

/* x -= f y */
static void take(ZpComplex f, ZpComplex y, ZpComplex *x) {
  x->re -= f.re * y.re - f.im * y.im;
  x->im -= f.re * y.im + f.im * y.re;
}

static void swap(ZpComplex *a, ZpComplex *b) {
  ZpComplex kept = *a;
  *a = *b;
  *b = kept;
}

static double size_of(ZpComplex x) {
  return fabs(x.re) + fabs(x.im);
}

/* The row from k on with the largest entry in column k becomes row k. */
static bool pivot(size_t n, ZpComplex *a, ZpComplex *b, size_t k) {
  size_t best = k;
  for (size_t i = k + 1; i < n; i++)
    if (size_of(a[i * n + k]) > size_of(a[best * n + k])) best = i;
  if (!(size_of(a[best * n + k]) > 0)) return false;
  if (best == k) return true;
  for (size_t j = k; j < n; j++)
    swap(&a[k * n + j], &a[best * n + j]);
  swap(&b[k], &b[best]);
  return true;
}

bool zp_complex_solve(size_t n, ZpComplex *a, ZpComplex *b) {
  for (size_t k = 0; k < n; k++) {
    if (!pivot(n, a, b, k)) return false;
    for (size_t i = k + 1; i < n; i++) {
      ZpComplex *row = a + i * n;
      if (row[k].re == 0 && row[k].im == 0) continue;
      ZpComplex f = over(row[k], a[k * n + k]);
      for (size_t j = k + 1; j < n; j++)
        take(f, a[k * n + j], &row[j]);
      take(f, b[k], &b[i]);
    }
  }
  for (size_t k = n; k-- > 0;) {
    for (size_t j = k + 1; j < n; j++)
      take(a[k * n + j], b[j], &b[k]);
    b[k] = over(b[k], a[k * n + k]);
  }
  return true;
}
