#include "drive/control_loop.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "math/elementary.h"
#include "math/exponential.h"

/* x(t) = P x(0) + g u after a time in which u is held: exp of (A b; 0 0) t. work [4 (n + 1)^2]. */
static void hold(const ZpLinear *s, double t, double *P, double *g, double *work) {
  const size_t n = s->n, all = n + 1;
  double *block = work, *exponential = work + all * all;
  memset(block, 0, all * all * sizeof *block);
  for (size_t i = 0; i < n; i++) {
    for (size_t j = 0; j < n; j++)
      block[i * all + j] = t * s->A[i * n + j];
    block[i * all + n] = t * s->b[i];
  }
  zp_exponential(all, block, exponential, exponential + all * all);
  for (size_t i = 0; i < n; i++) {
    memcpy(P + i * n, exponential + i * all, n * sizeof *P);
    g[i] = exponential[i * all + n];
  }
}

/* The state of the loop: x, the integral, and the outputs that are still to come or act, the newest first. */
typedef struct Loop {
  size_t n, integral, past, count;
} Loop;

static Loop loop_of(const ZpControl *c, size_t n, double rest) {
  Loop loop = {.n = n, .integral = n};
  loop.past = n + (c->integral > 0);
  loop.count = loop.past + (size_t)floor(c->delay / c->period + 1e-9) + (rest > 0);
  return loop;
}

/* The part of the delay beyond whole periods, s. */
static double rest_of(const ZpControl *c) {
  double rest = c->delay - floor(c->delay / c->period + 1e-9) * c->period;
  return rest > 1e-9 * c->period ? rest : 0;
}

/* Row by row: M [count^2] += x(end) by the output that is `age` samples old, 0: of this sample, times g [n]. */
static void act(const Loop *loop, size_t age, const double *g, const double *output, double *M) {
  for (size_t i = 0; i < loop->n; i++) {
    double *row = M + i * loop->count;
    if (age > 0)
      row[loop->past + age - 1] += g[i];
    else
      for (size_t j = 0; j < loop->count; j++)
        row[j] += g[i] * output[j];
  }
}

/* From a sample to the next. */
static void fill(const ZpControl *c, const ZpLinear *s, double proportional, const Loop *loop, double *M,
                 double *work) {
  const size_t n = s->n, count = loop->count, whole = (size_t)floor(c->delay / c->period + 1e-9);
  const double rest = rest_of(c);
  double *P = work, *g = P + n * n, *late = g + n, *output = late + n, *more = output + count;
  memset(M, 0, count * count * sizeof *M);
  memset(output, 0, count * sizeof *output);
  for (size_t j = 0; j < n; j++)
    output[j] = c->sense * (proportional + c->integral * c->period) * s->c[j];
  if (c->integral > 0) {
    for (size_t j = 0; j < n; j++)
      M[loop->integral * count + j] = c->sense * c->integral * c->period * s->c[j];
    M[loop->integral * count + loop->integral] = output[loop->integral] = 1;
  }
  if (rest > 0) {
    hold(s, rest, P, g, more);
    hold(s, c->period - rest, P, late, more);
    for (size_t i = 0; i < n; i++) { /* the effect of the earlier output continues without voltage */
      double after = 0;
      for (size_t j = 0; j < n; j++)
        after += P[i * n + j] * g[j];
      more[i] = after;
    }
    act(loop, whole + 1, more, output, M);
    act(loop, whole, late, output, M);
  }
  hold(s, c->period, P, g, more);
  for (size_t i = 0; i < n; i++)
    for (size_t j = 0; j < n; j++)
      M[i * count + j] += P[i * n + j];
  if (rest == 0) act(loop, whole, g, output, M);
  for (size_t k = loop->past; k < count; k++)
    for (size_t j = 0; j < count; j++)
      M[k * count + j] = k == loop->past ? output[j] : j + 1 == k;
}

static int faster_first(const void *a, const void *b) {
  double x = ((const ZpGrowth *)a)->rate, y = ((const ZpGrowth *)b)->rate;
  return (x < y) - (x > y);
}

/* Omit the `neutral` eigenvalues that are nearest to `at` on the real axis. */
static size_t without_neutral(ZpEigenvalue *value, size_t count, size_t neutral, double at) {
  for (; neutral > 0 && count > 0; neutral--) {
    size_t nearest = 0;
    double least = INFINITY;
    for (size_t k = 0; k < count; k++) {
      double re = value[k].re - at, distance = re * re + value[k].im * value[k].im;
      if (distance < least) least = distance, nearest = k;
    }
    value[nearest] = value[--count];
  }
  return count;
}

static double logarithm(double x) {
  return x > 0 ? zp_logarithm(x) : -INFINITY;
}

size_t zp_loop_work(size_t n) {
  const size_t most = n + ZP_LOOP_OWN;
  return most * most + 4 * most + n * n + 2 * n + 4 * (n + 1) * (n + 1);
}

size_t zp_open_loop(const ZpControl *c, const ZpLinear *s, size_t neutral, ZpGrowth *growth, double *work) {
  double *block = work, *row = work + s->n * s->n;
  ZpEigenvalue *value = (ZpEigenvalue *)(void *)(row + s->n);
  memcpy(block, s->A, s->n * s->n * sizeof *block);
  size_t count = zp_eigenvalues(s->n, block, row, value) ? without_neutral(value, s->n, neutral, 0) : 0, found = 0;
  for (size_t k = 0; k < count; k++) {
    double change = value[k].re * c->period, factor = 1 + zp_decay(fabs(change));
    if (value[k].im < 0) continue; /* its conjugate stands for both */
    growth[found++] = (ZpGrowth){value[k].re, value[k].im / (2 * zp_pi), change > 0 ? 1 / factor : factor};
  }
  qsort(growth, found, sizeof *growth, faster_first);
  return found;
}

size_t zp_closed_loop(const ZpControl *c, const ZpLinear *s, double proportional, size_t neutral, ZpGrowth *growth,
                      double *work) {
  const Loop loop = loop_of(c, s->n, rest_of(c));
  double *M = work, *row = M + loop.count * loop.count;
  ZpEigenvalue *value = (ZpEigenvalue *)(void *)(row + loop.count);
  fill(c, s, proportional, &loop, M, row + 3 * loop.count);
  size_t count = zp_eigenvalues(loop.count, M, row, value) ? without_neutral(value, loop.count, neutral, 1) : 0;
  size_t found = 0;
  for (size_t k = 0; k < count; k++) {
    double factor = sqrt(value[k].re * value[k].re + value[k].im * value[k].im);
    if (value[k].im < 0) continue;
    growth[found++] =
        (ZpGrowth){logarithm(factor) / c->period, zp_angle(value[k].im, value[k].re) / (2 * zp_pi * c->period), factor};
  }
  qsort(growth, found, sizeof *growth, faster_first);
  return found;
}
