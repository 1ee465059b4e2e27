/* The liquid outside the gap of two submerged ribbons: what they move of it, and its form drag. docs/theory.md, section
 * 22. Per length of the pair; y is a ribbon's height, Y the mean of both, g their gap, m. */
#ifndef ZP_LIQUID_OUTER_H
#define ZP_LIQUID_OUTER_H

typedef struct ZpOuterParams {
  double w;    /* width, m */
  double rho;  /* density of the liquid that is moved, kg/m^3; 0: without inertia */
  double drag; /* half of drag coefficient and density, kg/m^3 */
} ZpOuterParams;

/* Moved by the outer face of one ribbon, kg/m. */
double zp_outer_side(const ZpOuterParams *params);

/* Liquid that a pair moves beyond that with its mean velocity, since some goes through the gap, kg/m; and the secant of
 * it between two gaps, kg/m^2. */
double zp_outer_pair(const ZpOuterParams *params, double gap);
double zp_outer_pair_slope(const ZpOuterParams *params, double g0, double g1);

#endif
