/* The cross-section of a ribbon: metal strip and insulating tape on one face => EA, EI, mass per length. */
#ifndef ZP_RIBBON_SECTION_H
#define ZP_RIBBON_SECTION_H

/* One layer; layers lie on each other in the order of the list. */
typedef struct ZpLayer {
  double thickness;     /* m */
  double young_modulus; /* Pa */
  double poisson_ratio; /* counts in plane strain */
  double density;       /* kg/m3 */
} ZpLayer;

typedef struct ZpSection {
  double EA; /* axial stiffness, N */
  double EI; /* bending stiffness about the neutral axis, N m^2 */
  double mu; /* mass per length, kg/m */

  double axis;     /* height of the neutral axis over the first layer's lower face, m */
  double strained; /* what resists a strain of the neutral axis as the layers resist bending, N */

  double per_moment; /* stress of the first layer's outer fibre by a moment about the neutral axis, Pa/(N m) */
  double per_force;  /* and by a force along the ribbon, Pa/N */
} ZpSection;

/* Moment and tension that a law adds to those of a section, or takes from them, and their derivatives. */
typedef struct ZpSectionForce {
  double M, N;           /* N m, N */
  double K, both, axial; /* of M by the curvature, N m^2; of both by the other, N m; of N by the strain, N */
} ZpSectionForce;

/* Modulus of a layer in bending, Pa. */
double zp_bending_modulus(const ZpLayer *layer, int plane_strain);

/* (layers, width m, plane strain?) => section; theory eqs. (2.1)-(2.4). EA takes Young's modulus as it
 * is, as eq. (2) of the paper does; plane strain stiffens bending only. */
ZpSection zp_section(const ZpLayer *layer, int count, double width, int plane_strain);

/* Property of a layer that changes. */
typedef enum ZpLayerNumber { ZP_LAYER_THICKNESS, ZP_LAYER_MODULUS, ZP_LAYER_DENSITY } ZpLayerNumber;

/* Derivatives of EA, EI and mu by a number of layer `which`; the others are 0. */
ZpSection zp_section_by(const ZpLayer *layer, int count, double width, int plane_strain, int which, ZpLayerNumber by);

#endif
