/* Designs of experiments: which points of the unit cube the samples of a campaign are. */
#ifndef ZP_SAMPLE_DESIGN_H
#define ZP_SAMPLE_DESIGN_H

#include <stddef.h>
#include <stdint.h>

#include <zipact/def.h>

typedef struct ZpDesign {
  ZpSampling method;
  size_t count;   /* points */
  uint32_t seed;  /* another seed, other points */
  int dimensions; /* of the cube */
  bool indices;   /* each point comes with those that Sobol indices take: see zp_design_blocks */
} ZpDesign;

/* With indices, a point of the design is dimensions + 2 samples (Saltelli 2010): A, B, which are independent, and for
 * each dimension i, A with coordinate i of B. */
enum { ZP_BLOCK_A, ZP_BLOCK_B, ZP_BLOCK_FIRST };

/* Samples of a point: 1, or dimensions + 2. */
size_t zp_design_blocks(const ZpDesign *design);

/* All samples: sample `i` is of point i / zp_design_blocks, block i % zp_design_blocks. So a longer design of a method
 * but latin_hypercube begins with the same samples. */
size_t zp_design_samples(const ZpDesign *design);

/* Most dimensions that a design may have. */
int zp_design_most(const ZpDesign *design);

/* Coordinate `dimension` of a sample, in (0, 1). */
double zp_design_share(const ZpDesign *design, size_t sample, int dimension);

#endif
