/* Distributions of several keys together. */
#ifndef ZP_SAMPLE_TOGETHER_H
#define ZP_SAMPLE_TOGETHER_H

#include "math/skyline.h"
#include "sample/design.h"
#include "sample/distribution.h"

/* The distributions of all dimensions of a design. Those that are correlated are normal. */
typedef struct ZpTogether {
  int dimensions;
  ZpDistribution *each; /* [dimensions] */
  bool correlated;      /* any two of them */
  ZpSkyline root;       /* L of the correlations R = L L', with the reciprocals of its diagonal; only if correlated */
} ZpTogether;

/* Independent distributions, to be filled in by the caller. False if there is no memory. Destroy it in any case. */
bool zp_together_create(ZpTogether *joint, int dimensions);
void zp_together_destroy(ZpTogether *joint);

/* Correlate them by R [dimensions][dimensions], 1 on its diagonal, whose lower triangle is read. False if these are not
 * the correlations of any distribution, or of one in which some value follows from the others; `memory` says whether
 * there was enough. */
bool zp_together_correlate(ZpTogether *joint, const double *R, bool *memory);

/* The values of a sample of the design, theory (12.13) => value [dimensions]. */
void zp_together_draw(const ZpTogether *joint, const ZpDesign *design, size_t sample, double *value);

#endif
