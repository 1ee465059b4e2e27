/* The elastic energy of a strip that bends about its width and its normal and twists, per length. A twisted and bent
 * strip also curls across its width, which lowers its energy; docs/theory.md, section 41. */
#ifndef ZP_RIBBON_SPACE_SECTION_H
#define ZP_RIBBON_SPACE_SECTION_H

#include <stdbool.h>

typedef struct ZpSpaceSection {
  double B;       /* bending stiffness about the width in plane strain, N m^2 */
  double B2;      /* about the normal, N m^2 */
  double C;       /* torsional stiffness of a straight strip, N m^2 */
  double D;       /* warping stiffness: energy D tau'^2 / 2, N m^4 */
  double poisson; /* Poisson's ratio */
  double squared; /* theta^4 over the square of the curvature, m^2 (ribbon/curl.h); 0: nothing curls */
  bool softens;   /* bending alone curls the strip, too (`ribbon.plane: anticlastic`) */
} ZpSpaceSection;

/* A strip of one layer: (Young's modulus Pa, Poisson's ratio, thickness m, width m). */
ZpSpaceSection zp_space_section(double E, double poisson, double t, double w, bool softens);

/* At curvatures about the width and the normal and a twist, all 1/m: energy per length W, J/m; moments, N m, and their
 * derivatives, N m^2, in that order. */
typedef struct ZpSpaceLaw {
  double W, moment[3], stiffness[3][3];
} ZpSpaceLaw;

ZpSpaceLaw zp_space_law(const ZpSpaceSection *section, double bend, double sway, double twist);

#endif
