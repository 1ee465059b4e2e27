#include "sample/together.h"

#include <stdlib.h>

#include "sample/sobol.h"

/* A score whose standard deviation, given the others, is smaller than this follows from them. */
static const double least_deviation = 1e-6;

bool zp_together_create(ZpTogether *joint, int dimensions) {
  *joint = (ZpTogether){.dimensions = dimensions};
  joint->each = calloc((size_t)dimensions + 1, sizeof *joint->each);
  return joint->each != NULL;
}

void zp_together_destroy(ZpTogether *joint) {
  if (joint->correlated) zp_skyline_destroy(&joint->root);
  free(joint->each);
  *joint = (ZpTogether){0};
}

static bool is_proper(const ZpSkyline *root) {
  for (size_t i = 0; i < root->n; i++)
    if (!(1 / *zp_skyline_at(root, i, i) >= least_deviation)) return false;
  return true;
}

bool zp_together_correlate(ZpTogether *joint, const double *R, bool *memory) {
  static const size_t first[ZP_SOBOL_DIMENSIONS] = {0};
  const size_t n = (size_t)joint->dimensions;
  *memory = joint->correlated = zp_skyline_create(&joint->root, n, first);
  for (size_t i = 0; *memory && i < n; i++)
    for (size_t k = 0; k <= i; k++)
      *zp_skyline_at(&joint->root, i, k) = R[i * n + k];
  return *memory && zp_skyline_factor(&joint->root) && is_proper(&joint->root);
}

void zp_together_draw(const ZpTogether *joint, const ZpDesign *design, size_t sample, double *value) {
  double score[ZP_SOBOL_DIMENSIONS] = {0};
  for (int i = 0; i < joint->dimensions; i++) {
    const ZpDistribution *d = &joint->each[i];
    const double share = zp_design_share(design, sample, i);
    const size_t row = (size_t)i;
    double mean = 0, deviation = 1;
    if (d->kind != ZP_DISTRIBUTION_NORMAL) {
      value[i] = zp_quantile(d, share);
      continue;
    }
    for (size_t k = 0; joint->correlated && k < row; k++)
      mean += *zp_skyline_at(&joint->root, row, k) * score[k];
    if (joint->correlated) deviation = 1 / *zp_skyline_at(&joint->root, row, row);
    score[i] = zp_conditional_score(d, mean, deviation, share);
    value[i] = zp_conditional_value(d, mean, deviation, score[i]);
  }
}
