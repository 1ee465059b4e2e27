#include "rest/assemble.h"

size_t zp_assemble_number(const ZpModel *model, int *equation) {
  int next = 0;
  for (size_t j = 0; j < model->count; j++) {
    bool joined = model->s == 2 && j == 1;
    bool free_x = model->masses.x.inverse[j] > 0, free_y = model->masses.y.inverse[j] > 0;
    equation[2 * j] = joined ? equation[0] : free_x ? next++ : -1;
    equation[2 * j + 1] = joined ? equation[1] : free_y ? next++ : -1;
  }
  return (size_t)next;
}

size_t zp_assemble_bandwidth(const ZpModel *model) {
  return 6 * model->s - 1;
}

/* Where to, for the functions below. Of a symmetric matrix only the upper triangle is kept. */
typedef struct Place {
  const int *equation;
  ZpBand *K;
} Place;

static void add(const Place *to, size_t row, size_t column, double value) {
  int i = to->equation[row], j = to->equation[column];
  if (i >= 0 && j >= 0 && (j >= i || to->K->lower > 0)) *zp_band_at(to->K, (size_t)i, (size_t)j) += value;
}

/* A 2 x 2 block d(force on a)/d(position of b), sign turned. */
static void add_block(const Place *to, size_t a, size_t b, const double D[4], double sign) {
  add(to, 2 * a, 2 * b, sign * D[0]);
  add(to, 2 * a, 2 * b + 1, sign * D[1]);
  add(to, 2 * a + 1, 2 * b, sign * D[2]);
  add(to, 2 * a + 1, 2 * b + 1, sign * D[3]);
}

/* Edge j (nodes j, j + s) feels edge k (nodes k, k + s): the force R_j acts on its right node, -R_j on its left. */
void zp_assemble_edges(const ZpModel *model, const int *equation, const double (*D)[4], ZpBand *K) {
  Place place = {equation, K};
  ptrdiff_t step = (ptrdiff_t)model->s, edges = (ptrdiff_t)(model->count - model->s);
  for (ptrdiff_t j = 0; j < edges; j++)
    for (ptrdiff_t m = 0; m < 3; m++) {
      ptrdiff_t k = j + (m - 1) * step;
      if (k < 0 || k >= edges) continue;
      size_t left = (size_t)j, right = (size_t)(j + step), from = (size_t)k, to = (size_t)(k + step);
      const double *block = D[3 * j + m];
      add_block(&place, right, to, block, 1);
      add_block(&place, right, from, block, -1);
      add_block(&place, left, to, block, -1);
      add_block(&place, left, from, block, 1);
    }
}

/* By the gaps of stations i and k: gap = y upper - y lower. */
static void add_gaps(const Place *to, size_t ribbons, size_t i, size_t k, double value) {
  for (size_t a = 0; a < ribbons; a++)
    for (size_t b = 0; b < ribbons; b++)
      add(to, 2 * (ribbons * i + a) + 1, 2 * (ribbons * k + b) + 1, a == b ? value : -value);
}

void zp_assemble_stations(const ZpModel *model, const int *equation, const double *own, const double *next, ZpBand *K) {
  Place place = {equation, K};
  for (size_t i = 0; i < model->nodes; i++) {
    add_gaps(&place, model->s, i, i, own[i]);
    if (i + 1 == model->nodes) break;
    add_gaps(&place, model->s, i, i + 1, next[i]);
    add_gaps(&place, model->s, i + 1, i, next[i]);
  }
}

/* By the mean x-length of element i and the gap of station k, both orders. */
static void add_along(const Place *to, size_t ribbons, size_t i, size_t k, double value) {
  for (size_t a = 0; a < 2 * ribbons; a++) /* nodes of station i, then of i + 1 */
    for (size_t b = 0; b < ribbons; b++) {
      size_t x = 2 * (ribbons * i + a), y = 2 * (ribbons * k + b) + 1;
      double rises = ribbons == 2 && b == 0 ? 1 : -1; /* how the gap goes with this y */
      double sign = (a < ribbons ? -1 : 1) * rises / (double)ribbons;
      add(to, x, y, sign * value);
      add(to, y, x, sign * value);
    }
}

void zp_assemble_along(const ZpModel *model, const int *equation, const double *along0, const double *along1,
                       ZpBand *K) {
  Place place = {equation, K};
  for (size_t i = 0; i + 1 < model->nodes; i++) {
    add_along(&place, model->s, i, i, along0[i]);
    add_along(&place, model->s, i, i + 1, along1[i]);
  }
}
