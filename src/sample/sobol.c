#include "sample/sobol.h"

enum { BITS = 32, DEGREE_MOST = 8 };

typedef struct Dimension {
  uint32_t polynomial;
  uint32_t first[DEGREE_MOST];
} Dimension;

/* All but the first dimension, whose direction numbers are all 1. */
static const Dimension dimensions[ZP_SOBOL_DIMENSIONS - 1] = {
#define ZP_SOBOL(polynomial, ...) {polynomial, {__VA_ARGS__}},
#include "sample/sobol.def"
};

static int degree_of(uint32_t polynomial) {
  int degree = 0;
  while (polynomial >> (degree + 1))
    degree++;
  return degree;
}

/* The next direction number m_i, by the recurrence of the polynomial over the last `degree` of them. */
static uint32_t next_direction(uint32_t polynomial, int degree, const uint32_t *last) {
  uint32_t m = last[0];
  for (int k = 1; k <= degree; k++)
    if (polynomial >> (degree - k) & 1) m ^= last[degree - k] << k;
  return m;
}

static uint32_t reverse(uint32_t x) {
  uint32_t y = 0;
  for (int i = 0; i < BITS; i++)
    y |= (x >> i & 1) << (BITS - 1 - i);
  return y;
}

uint32_t zp_sobol(uint32_t index, int dimension) {
  if (dimension == 0) return reverse(index);
  const Dimension *d = &dimensions[dimension - 1];
  const int degree = degree_of(d->polynomial);
  uint32_t m[BITS] = {0}, x = 0;
  for (int i = 0; i < BITS && index >> i; i++) {
    m[i] = i < degree ? d->first[i] : next_direction(d->polynomial, degree, &m[i - degree]);
    if (index >> i & 1) x ^= m[i] << (BITS - 1 - i);
  }
  return x;
}

/* Every operation takes a bit of its result from the same and lower bits only, so that from high to low, as reversed
 * here, a bit depends on those before it. Form and constants: B. Burley, "Practical hash-based Owen scrambling", J.
 * Comput. Graph. Tech. 9 (2020), after S. Laine and T. Karras. */
uint32_t zp_scramble(uint32_t x, uint32_t seed) {
  x = reverse(x) + seed;
  x ^= x * 0x6c50b47cU;
  x ^= x * 0xb82f1e52U;
  x ^= x * 0xc7afe638U;
  x ^= x * 0x8d22f6e6U;
  return reverse(x);
}
