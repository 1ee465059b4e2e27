#include "math/exponential.h"

#include <math.h>
#include <string.h>

static double norm(size_t n, const double *a) {
  double largest = 0;
  for (size_t i = 0; i < n; i++) {
    double sum = 0;
    for (size_t j = 0; j < n; j++)
      sum += fabs(a[i * n + j]);
    largest = fmax(largest, sum);
  }
  return largest;
}

/* c = a b. */
static void multiply(size_t n, const double *a, const double *b, double *c) {
  memset(c, 0, n * n * sizeof *c);
  for (size_t i = 0; i < n; i++)
    for (size_t k = 0; k < n; k++) {
      const double x = a[i * n + k], *row = b + k * n;
      double *to = c + i * n;
      for (size_t j = 0; x != 0 && j < n; j++)
        to[j] += x * row[j];
    }
}

/* exp(A) - 1 = E: of a small part the series, which keeps what is far below 1; then (1 + E)^2 - 1 = E (2 + E). */
void zp_exponential(size_t n, const double *A, double *E, double *work) {
  enum { TERMS = 14 }; /* of a norm of 1/4 the first left out is 1e-21 */
  double *small = work, *product = work + n * n;
  int exponent; /* the norm is below 2^exponent */
  frexp(norm(n, A), &exponent);
  const int halvings = exponent > -2 ? exponent + 2 : 0;
  for (size_t k = 0; k < n * n; k++)
    small[k] = ldexp(A[k], -halvings);
  memcpy(E, small, n * n * sizeof *E);
  for (int term = TERMS; term > 1; term--) { /* Horner: E = small (1 + E / term) */
    for (size_t k = 0; k < n * n; k++)
      E[k] /= term;
    multiply(n, small, E, product);
    for (size_t k = 0; k < n * n; k++)
      E[k] = small[k] + product[k];
  }
  for (int k = 0; k < halvings; k++) {
    multiply(n, E, E, product);
    for (size_t i = 0; i < n * n; i++)
      E[i] = 2 * E[i] + product[i];
  }
  for (size_t i = 0; i < n; i++)
    E[i * n + i] += 1;
}
