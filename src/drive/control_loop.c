#include "drive/control_loop.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "math/elementary.h"
#include "math/exponential.h"

/* x(t) = P x(0) + g u after a time in which an input is held: exp of (A b; 0 0) t. work [4 (n + 1)^2]. */
static void hold(const ZpLinear *s, size_t input, double t, double *P, double *g, double *work) {
  const size_t n = s->n, all = n + 1;
  double *block = work, *exponential = work + all * all;
  memset(block, 0, all * all * sizeof *block);
  for (size_t i = 0; i < n; i++) {
    for (size_t j = 0; j < n; j++)
      block[i * all + j] = t * s->A[i * n + j];
    block[i * all + n] = t * s->b[input * n + i];
  }
  zp_exponential(all, block, exponential, exponential + all * all);
  for (size_t i = 0; i < n; i++) {
    memcpy(P + i * n, exponential + i * all, n * sizeof *P);
    g[i] = exponential[i * all + n];
  }
}

/* The part of a delay beyond whole periods, s; how many of these there are. */
static size_t whole_of(const ZpControl *c) {
  return (size_t)floor(c->delay / c->period + 1e-9);
}

static double rest_of(const ZpControl *c) {
  double rest = c->delay - floor(c->delay / c->period + 1e-9) * c->period;
  return rest > 1e-9 * c->period ? rest : 0;
}

/* Places of a controller in the state of the loops, which begins with x: the integral, then the outputs that are still
 * to come or act, the newest first. */
typedef struct Place {
  size_t integral, past, end;
} Place;

static Place place_of(const ZpControl *c, size_t integral) {
  Place at = {.integral = integral, .past = integral + (c->integral > 0)};
  at.end = at.past + whole_of(c) + (rest_of(c) > 0);
  return at;
}

/* Number of states of all loops. */
static size_t states_of(const ZpControl *c, const ZpLinear *s) {
  size_t count = s->n;
  for (size_t k = 0; k < s->inputs; k++)
    count = place_of(c + k, count).end;
  return count;
}

/* Row by row of M [count^2]. */
typedef struct Loops {
  size_t n, count;
  double *M;
} Loops;

/* M += x(end) by the output that is `age` samples old, 0: of this sample, times g [n]. */
static void act(const Loops *loops, Place at, size_t age, const double *g, const double *output) {
  for (size_t i = 0; i < loops->n; i++) {
    double *row = loops->M + i * loops->count;
    if (age > 0)
      row[at.past + age - 1] += g[i];
    else
      for (size_t j = 0; j < loops->count; j++)
        row[j] += g[i] * output[j];
  }
}

/* From a sample of a controller to the next; the first one also takes x there without any input. */
static void fill_one(const ZpControl *c, const ZpLinear *s, size_t input, double proportional, Place at,
                     const Loops *loops, double *work) {
  const size_t n = s->n, count = loops->count, whole = whole_of(c);
  const double rest = rest_of(c), *signal = s->c + input * n;
  double *P = work, *g = P + n * n, *late = g + n, *output = late + n, *more = output + count, *M = loops->M;
  memset(output, 0, count * sizeof *output);
  for (size_t j = 0; j < n; j++)
    output[j] = c->sense * (proportional + c->integral * c->period) * signal[j];
  if (c->integral > 0) {
    for (size_t j = 0; j < n; j++)
      M[at.integral * count + j] = c->sense * c->integral * c->period * signal[j];
    M[at.integral * count + at.integral] = output[at.integral] = 1;
  }
  if (rest > 0) {
    hold(s, input, rest, P, g, more);
    hold(s, input, c->period - rest, P, late, more);
    for (size_t i = 0; i < n; i++) { /* the effect of the earlier output continues without voltage */
      double after = 0;
      for (size_t j = 0; j < n; j++)
        after += P[i * n + j] * g[j];
      more[i] = after;
    }
    act(loops, at, whole + 1, more, output);
    act(loops, at, whole, late, output);
  }
  hold(s, input, c->period, P, g, more);
  for (size_t i = 0; i < n && input == 0; i++)
    for (size_t j = 0; j < n; j++)
      M[i * count + j] += P[i * n + j];
  if (rest == 0) act(loops, at, whole, g, output);
  for (size_t k = at.past; k < at.end; k++)
    for (size_t j = 0; j < count; j++)
      M[k * count + j] = k == at.past ? output[j] : j + 1 == k;
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

size_t zp_loop_work(size_t n, size_t inputs) {
  const size_t most = n + inputs * ZP_LOOP_OWN;
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

size_t zp_closed_loop(const ZpControl *c, const ZpLinear *s, const double *proportional, size_t neutral,
                      ZpGrowth *growth, double *work) {
  const Loops loops = {s->n, states_of(c, s), work};
  double *row = work + loops.count * loops.count;
  ZpEigenvalue *value = (ZpEigenvalue *)(void *)(row + loops.count);
  Place at = {.end = s->n};
  memset(loops.M, 0, loops.count * loops.count * sizeof *loops.M);
  for (size_t k = 0; k < s->inputs; k++) {
    at = place_of(c + k, at.end);
    fill_one(c + k, s, k, proportional[k], at, &loops, row + 3 * loops.count);
  }
  size_t count = zp_eigenvalues(loops.count, loops.M, row, value) ? without_neutral(value, loops.count, neutral, 1) : 0;
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
