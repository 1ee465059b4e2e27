/* Distributions of several keys together. */
#ifndef ZP_SAMPLE_JOINT_H
#define ZP_SAMPLE_JOINT_H

#include "math/skyline.h"
#include "sample/design.h"
#include "sample/distribution.h"

/* The distributions of all dimensions of a design. Those that are correlated are normal. */
typedef struct ZpJoint {
  int dimensions;
  ZpDistribution *each; /* [dimensions] */
  bool correlated;      /* any two of them */
  ZpSkyline root;       /* L of the correlations R = L L', with the reciprocals of its diagonal; only if correlated */
} ZpJoint;

/* Independent distributions, to be filled in by the caller. False if there is no memory. Destroy it in any case. */
bool zp_joint_create(ZpJoint *joint, int dimensions);
void zp_joint_destroy(ZpJoint *joint);

/* Correlate them by R [dimensions][dimensions], 1 on its diagonal, whose lower triangle is read. False if these are not
 * the correlations of any distribution, or of one in which some value follows from the others; `memory` says whether
 * there was enough. */
bool zp_joint_correlate(ZpJoint *joint, const double *R, bool *memory);

/* The values of a sample of the design, theory (12.11) => value [dimensions]. */
void zp_joint_draw(const ZpJoint *joint, const ZpDesign *design, size_t sample, double *value);

#endif
