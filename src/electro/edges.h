/* Contribution to the plates law of the field beyond the lateral edges of two strips that face each other, or of one
 * over a wide plate. Per length
 * of the strips the capacitance depends on their gap alone where that changes slowly; the field of the cross-section
 * across the strips is solved at some gaps once, and a smooth law goes through them, docs/theory.md section 16. */
#ifndef ZP_ELECTRO_EDGES_H
#define ZP_ELECTRO_EDGES_H

#include "base/fail.h"
#include "electro/field.h"

/* Two parallel strips, an insulator on each of their facing sides, in liquid; or one of them over a plate that is much
 * wider, eq. (36.1). */
typedef struct ZpEdgeParams {
  double w;                  /* width, m */
  double b, t;               /* thickness of metal and of insulator, m; of two strips t > 0 */
  double eps_m, eps_i;       /* relative permittivity of liquid and insulator */
  bool plate;                /* a plate instead of the other strip, */
  double plate_t, plate_eps; /* thickness of its insulator, m, 0 without; relative permittivity */
  double least;              /* smallest gap of bare metals that counts, m; > 0 where there is no insulator */
} ZpEdgeParams;

/* The mesh on which the law is solved; about 1e-4 of the capacitance while strips are close, 6e-4 at a third of their
 * width. */
ZpFieldMesh zp_edges_mesh(const ZpEdgeParams *params);

/* Capacitance per length of the whole cross-section at gaps of 0 and more, F/m. False if there is no memory. NAN where
 * there is no solution. */
bool zp_edges_capacitance(const ZpEdgeParams *params, const ZpFieldMesh *mesh, size_t count, const double *gap,
                          double *capacitance);

enum { ZP_EDGE_TERMS = 18 };

/* e(g) / w with e = C' / (eps0 eps_m) - w / (g + d), a polynomial in z(g), eqs. (16.1), (16.2). Beyond its ends it
 * continues straight. */
typedef struct ZpEdgeLaw {
  double least, largest;   /* it holds for gaps least .. largest, m; least is 0 with an insulator */
  double d;                /* liquid thickness that stands for all insulators, m */
  double s0;               /* square root of the middle of g + d, m^0.5 */
  double stretch;          /* so that z is in [-1, 1] */
  double p[ZP_EDGE_TERMS]; /* coefficients of z^k, 1/m */
  double error;            /* estimate of what it misses between the solutions, as a share of C' */
} ZpEdgeLaw;

/* => law. Says why if it cannot be. */
ZpStatus zp_edges_make(const ZpEdgeParams *params, double largest, ZpEdgeLaw *law, ZpError *err);

/* e / w and its derivatives by the gap, at a gap within the ends of the law. */
typedef struct ZpEdgeValue {
  double e, slope, bend; /* 1/m, 1/m^2, 1/m^3 */
} ZpEdgeValue;
ZpEdgeValue zp_edges_value(const ZpEdgeLaw *law, double gap);

#endif
