/* Tables of what a fit knows about its parameters: their profiles, and the joint regions of pairs of them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/table.h"
#include "fit/fit.h"
#include "io/report.h"
#include "study/result.h"

double zp_fit_joint_level(const ZpFit *fit) {
  static const double beyond = 0.05;
  const double freedom = (double)fit->rows - fit->n;
  return fit->sigma ? -2 * log(beyond) : freedom * expm1(-2 / freedom * log(beyond));
}

double zp_fit_correlation(const ZpFit *fit, double C[ZP_FIT_MOST][ZP_FIT_MOST], int a, int b) {
  return copysign(1, fit->start[a] * fit->start[b]) * C[a][b] / sqrt(C[a][a] * C[b][b]);
}

double zp_fit_share(const ZpFit *fit, const double *J, double C[ZP_FIT_MOST][ZP_FIT_MOST], size_t row, int k) {
  double own = 0; /* derivative by parameter k beside the others, times C[k][k] */
  for (int j = 0; j < fit->n; j++)
    own += J[row * (size_t)fit->n + (size_t)j] * C[j][k];
  return own * own / C[k][k];
}

/* -- tables with a column for each parameter ---------------------------------------------------------- */

enum { FIRST_COLUMNS = 3 };

/* The first columns, then those of the parameters, whose values are SI. NULL if there is no memory. */
static ZpTable *open_table(ZpFit *fit, const ZpColumn first[FIRST_COLUMNS], size_t rows) {
  char name[ZP_FIT_MOST][ZP_KEY_COLUMN_SIZE];
  ZpColumn column[FIRST_COLUMNS + ZP_FIT_MOST];
  memcpy(column, first, FIRST_COLUMNS * sizeof *column);
  for (int k = 0; k < fit->n; k++) {
    if (k < fit->keys)
      zp_key_column(NULL, fit->key[k], name[k], sizeof name[k]);
    else
      snprintf(name[k], sizeof name[k], "%s_%s", fit->name[k], fit->unit[k]);
    column[FIRST_COLUMNS + k] = (ZpColumn){name[k], fit->unit[k], "fitted parameter"};
  }
  ZpTable *table = zp_table_create(column, FIRST_COLUMNS + (size_t)fit->n, rows < 2 ? 2 : rows);
  if (!table) fit->status = zp_fail_memory(fit->err);
  return table;
}

/* -- profiles ------------------------------------------------------------------------------------------ */

enum { HELD, RISE, PARABOLA };

static const ZpColumn profile_column[FIRST_COLUMNS] = {
    [HELD] = {"held", "1", "number of the parameter that is held; the others are fitted again"},
    [RISE] = {"rise", "1", "rise of the sum of squares over the variance of a residual"},
    [PARABOLA] = {"parabola", "1",
                  "the same of a linear model with the standard error, which a parameter at a bound has not"}};

static void put_point(const ZpFit *fit, const ZpFitPoint *best, double variance, double C[ZP_FIT_MOST][ZP_FIT_MOST],
                      const ZpFitProfilePoint *point, ZpTable *table) {
  double row[FIRST_COLUMNS + ZP_FIT_MOST];
  const int held = point->held;
  const double off = point->z[held] - best->z[held];
  row[HELD] = held + 1;
  row[RISE] = point->rise / variance;
  row[PARABOLA] = zp_fit_at_bound(fit, best->z, held) ? NAN : off * off / (variance * C[held][held]);
  for (int k = 0; k < fit->n; k++)
    row[FIRST_COLUMNS + k] = point->z[k] * fit->start[k];
  zp_table_offer(table, row);
}

static int by_value(const void *one, const void *two) {
  const ZpFitProfilePoint *a = one, *b = two;
  const double x = a->z[a->held], y = b->z[b->held];
  return a->held != b->held ? (a->held > b->held) - (a->held < b->held) : (x > y) - (x < y);
}

ZpTable *zp_fit_likelihood(ZpFit *fit, const ZpFitPoint *best, double variance, double C[ZP_FIT_MOST][ZP_FIT_MOST],
                           const ZpFitProfiles *points) {
  if (!C || points->count == 0) return NULL;
  const size_t count = points->count + (size_t)fit->n;
  ZpFitProfilePoint *all = calloc(count, sizeof *all);
  ZpTable *table = all ? open_table(fit, profile_column, count) : NULL;
  if (!all) fit->status = zp_fail_memory(fit->err);
  for (int k = 0; k < fit->n && table; k++) {
    all[k].held = k;
    memcpy(all[k].z, best->z, sizeof all[k].z);
  }
  if (table) memcpy(all + fit->n, points->point, points->count * sizeof *all);
  if (table) qsort(all, count, sizeof *all, by_value);
  for (size_t i = 0; i < count && table; i++)
    put_point(fit, best, variance, C, &all[i], table);
  free(all);
  return table;
}

/* -- joint regions -------------------------------------------------------------------------------------- */

enum { FIRST, SECOND, CORRELATION, EDGE = 72 }; /* EDGE: points of an ellipse, the first one twice */

static const ZpColumn region_column[FIRST_COLUMNS] = {
    [FIRST] = {"first", "1", "number of the first parameter of the pair"},
    [SECOND] = {"second", "1", "number of the second"},
    [CORRELATION] = {"correlation", "1", "of the two"}};

typedef struct Pair {
  int first, second;
  double correlation;
} Pair;

static int by_correlation(const void *one, const void *two) {
  const Pair *a = one, *b = two;
  const double x = fabs(a->correlation), y = fabs(b->correlation);
  if (x != y) return (x < y) - (x > y);
  return a->first != b->first ? (a->first > b->first) - (a->first < b->first)
                              : (a->second > b->second) - (a->second < b->second);
}

/* Pairs of parameters that are not at a bound, the most correlated first => their number. */
static size_t list_pairs(const ZpFit *fit, const double *z, double C[ZP_FIT_MOST][ZP_FIT_MOST], Pair *pair) {
  size_t pairs = 0;
  for (int a = 0; a < fit->n; a++)
    for (int b = a + 1; b < fit->n; b++)
      if (!zp_fit_at_bound(fit, z, a) && !zp_fit_at_bound(fit, z, b))
        pair[pairs++] = (Pair){a, b, zp_fit_correlation(fit, C, a, b)};
  if (pairs > 1) qsort(pair, pairs, sizeof *pair, by_correlation);
  return pairs;
}

/* The ellipse of a pair. */
static void put_edge(const ZpFit *fit, const ZpFitPoint *best, double size, double C[ZP_FIT_MOST][ZP_FIT_MOST],
                     const Pair *pair, ZpTable *table) {
  static const double turn = 6.283185307179586;
  const int a = pair->first, b = pair->second;
  const double across = sqrt(fmax(0, 1 - pair->correlation * pair->correlation));
  double row[FIRST_COLUMNS + ZP_FIT_MOST];
  for (int k = 0; k < fit->n; k++)
    row[FIRST_COLUMNS + k] = NAN;
  row[FIRST] = a + 1;
  row[SECOND] = b + 1;
  row[CORRELATION] = pair->correlation;
  for (int i = 0; i <= EDGE; i++) {
    const double along = cos(turn * i / EDGE), beside = sin(turn * i / EDGE);
    const double u = along, v = pair->correlation * along + across * beside;
    row[FIRST_COLUMNS + a] = best->z[a] * fit->start[a] + fabs(fit->start[a]) * sqrt(size * C[a][a]) * u;
    row[FIRST_COLUMNS + b] = best->z[b] * fit->start[b] + fabs(fit->start[b]) * sqrt(size * C[b][b]) * v;
    zp_table_offer(table, row);
  }
}

ZpTable *zp_fit_regions(ZpFit *fit, const ZpFitPoint *best, double variance, double C[ZP_FIT_MOST][ZP_FIT_MOST]) {
  Pair pair[ZP_FIT_MOST * ZP_FIT_MOST];
  const size_t pairs = C && variance > 0 ? list_pairs(fit, best->z, C, pair) : 0;
  if (pairs == 0) return NULL;
  ZpTable *table = open_table(fit, region_column, pairs * (EDGE + 1));
  for (size_t i = 0; i < pairs && table; i++)
    put_edge(fit, best, zp_fit_joint_level(fit) * variance, C, &pair[i], table);
  return table;
}
