#include "fit/selection.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fit/cholesky.h"

void zp_information_add(int n, const double *row, double times, ZpInformation *information) {
  for (int a = 0; a < n; a++)
    for (int b = 0; b < n; b++)
      information->of[a][b] += times * row[a] * row[b];
}

void zp_selection_add(const ZpSelection *selection, size_t which, double times, ZpInformation *information) {
  const ZpMeasurement *of = &selection->among[which];
  for (int k = 0; k < of->count; k++)
    zp_information_add(selection->n, selection->J + (of->first + (size_t)k * of->step) * (size_t)selection->n, times,
                       information);
}

void zp_information_eliminate(int keys, int n, ZpInformation *information) {
  double(*M)[ZP_FIT_MOST] = information->of;
  for (int s = n - 1; s >= keys; s--)
    for (int a = 0; a < s && M[s][s] > 0; a++) /* 0: nothing depends on it */
      for (int b = 0; b < s; b++)
        M[a][b] -= M[a][s] * M[s][b] / M[s][s];
}

/* The information about the keys => its factor L. False if they are not determined. */
static bool factor(const ZpSelection *selection, const ZpInformation *information, ZpInformation *L) {
  *L = *information;
  zp_information_eliminate(selection->keys, selection->n, L);
  return zp_cholesky_factor(selection->keys, 0, L->of);
}

bool zp_selection_covariance(const ZpSelection *selection, const ZpInformation *information,
                             ZpInformation *covariance) {
  ZpInformation L;
  if (!factor(selection, information, &L)) return false;
  zp_cholesky_invert(selection->keys, L.of, covariance->of);
  return true;
}

double zp_selection_value(const ZpSelection *selection, const ZpInformation *information) {
  ZpInformation L, C = {{{0}}};
  double value = 0;
  if (!factor(selection, information, &L)) return -INFINITY;
  if (selection->criterion == ZP_PLAN_A) zp_cholesky_invert(selection->keys, L.of, C.of);
  for (int k = 0; k < selection->keys; k++) {
    const double size = selection->size[k];
    value += selection->criterion == ZP_PLAN_A ? -C.of[k][k] / (size * size) : 2 * log(L.of[k][k] * size);
  }
  return value;
}

double zp_selection_error(const ZpSelection *selection, double value) {
  return selection->criterion == ZP_PLAN_D ? exp(-0.5 * value / selection->keys) : sqrt(-value / selection->keys);
}

/* -- the choice ------------------------------------------------------------------------------------ */

/* One after the other, the measurement of a pool that adds most => chosen [number]; `taken` [pool] is room. */
static void choose_greedily(const ZpSelection *selection, const size_t *pool, size_t size, size_t number, bool *taken,
                            size_t *chosen) {
  ZpInformation sum = selection->start;
  memset(taken, 0, size * sizeof *taken);
  for (size_t k = 0; k < number; k++) {
    double most = -INFINITY;
    size_t best = size;
    for (size_t i = 0; i < size; i++) {
      ZpInformation trial = sum;
      if (taken[i]) continue;
      zp_selection_add(selection, pool[i], 1, &trial);
      const double value = zp_selection_value(selection, &trial);
      if (best < size && !(value > most)) continue;
      most = value;
      best = i;
    }
    taken[best] = true;
    chosen[k] = pool[best];
    zp_selection_add(selection, chosen[k], 1, &sum);
  }
}

static ZpInformation information_of(const ZpSelection *selection, const size_t *chosen, size_t number) {
  ZpInformation sum = selection->start;
  for (size_t k = 0; k < number; k++)
    zp_selection_add(selection, chosen[k], 1, &sum);
  return sum;
}

double zp_selection_value_of(const ZpSelection *selection, const size_t *chosen, size_t number) {
  const ZpInformation sum = information_of(selection, chosen, number);
  return zp_selection_value(selection, &sum);
}

/* Exchange one chosen measurement for the best of the others (Fedorov) => whether one is better. */
static bool exchange(const ZpSelection *selection, size_t *chosen, size_t number, size_t which, bool *taken) {
  static const double least = 1e-10; /* above rounding */
  ZpInformation without = information_of(selection, chosen, number);
  double most = zp_selection_value(selection, &without);
  size_t best = chosen[which];
  most += least * fmax(1, fabs(most));
  zp_selection_add(selection, chosen[which], -1, &without);
  for (size_t i = 0; i < selection->count; i++) {
    ZpInformation trial = without;
    if (taken[i]) continue;
    zp_selection_add(selection, i, 1, &trial);
    const double value = zp_selection_value(selection, &trial);
    if (!(value > most)) continue;
    most = value;
    best = i;
  }
  if (best == chosen[which]) return false;
  taken[chosen[which]] = false;
  taken[best] = true;
  chosen[which] = best;
  return true;
}

/* Exchange until no single exchange helps => value of the criterion. */
static double improve(const ZpSelection *selection, size_t *chosen, size_t number, bool *taken) {
  memset(taken, 0, selection->count * sizeof *taken);
  for (size_t k = 0; k < number; k++)
    taken[chosen[k]] = true;
  for (bool better = true; better;) {
    better = false;
    for (size_t k = 0; k < number; k++)
      better |= exchange(selection, chosen, number, k, taken);
  }
  return zp_selection_value_of(selection, chosen, number);
}

/* From the greedy choice and from the even one, the better of both; then in the order of their gain. `pool`, `taken`
 * [count]: room. */
static void choose(const ZpSelection *selection, size_t number, size_t *pool, bool *taken, size_t *chosen) {
  for (size_t i = 0; i < selection->count; i++)
    pool[i] = i;
  choose_greedily(selection, pool, selection->count, number, taken, chosen);
  const double value = improve(selection, chosen, number, taken);
  zp_selection_even(selection, number, pool);
  if (value >= improve(selection, pool, number, taken)) memcpy(pool, chosen, number * sizeof *pool);
  choose_greedily(selection, pool, number, number, taken, chosen);
}

bool zp_selection_best(const ZpSelection *selection, size_t number, size_t *chosen) {
  size_t *pool = calloc(selection->count + 1, sizeof *pool);
  bool *taken = calloc(selection->count + 1, sizeof *taken);
  const bool room = pool && taken;
  if (room) choose(selection, number, pool, taken, chosen);
  free(pool);
  free(taken);
  return room;
}

void zp_selection_even(const ZpSelection *selection, size_t number, size_t *chosen) {
  const double last = (double)selection->count - 1;
  for (size_t k = 0; k < number; k++) {
    const double part = number > 1 ? (double)k / ((double)number - 1) : 0.5;
    chosen[k] = (size_t)(part * last + 0.5);
  }
}
