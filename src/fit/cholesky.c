#include "fit/cholesky.h"

#include <math.h>

bool zp_cholesky_factor(int n, double least, double A[ZP_FIT_MOST][ZP_FIT_MOST]) {
  for (int a = 0; a < n; a++)
    for (int b = 0; b <= a; b++) {
      double sum = A[a][b], whole = sum;
      for (int k = 0; k < b; k++)
        sum -= A[a][k] * A[b][k];
      if (a == b && !(sum > least * whole)) return false;
      A[a][b] = a == b ? sqrt(sum) : sum / A[b][b];
    }
  return true;
}

void zp_cholesky_solve(int n, double L[ZP_FIT_MOST][ZP_FIT_MOST], double *x) {
  for (int a = 0; a < n; a++) {
    for (int k = 0; k < a; k++)
      x[a] -= L[a][k] * x[k];
    x[a] /= L[a][a];
  }
  for (int a = n; a-- > 0;) {
    for (int k = a + 1; k < n; k++)
      x[a] -= L[k][a] * x[k];
    x[a] /= L[a][a];
  }
}

void zp_cholesky_invert(int n, double L[ZP_FIT_MOST][ZP_FIT_MOST], double C[ZP_FIT_MOST][ZP_FIT_MOST]) {
  double M[ZP_FIT_MOST][ZP_FIT_MOST] = {{0}}; /* L^-1 */
  for (int a = 0; a < n; a++)
    for (int b = 0; b <= a; b++) {
      double sum = a == b;
      for (int k = b; k < a; k++)
        sum -= L[a][k] * M[k][b];
      M[a][b] = sum / L[a][a];
    }
  for (int a = 0; a < n; a++)
    for (int b = 0; b < n; b++) {
      C[a][b] = 0;
      for (int k = a > b ? a : b; k < n; k++)
        C[a][b] += M[k][a] * M[k][b];
    }
}
