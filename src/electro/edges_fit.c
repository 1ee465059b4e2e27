/* How the law of lateral edges is made: the field of the cross-section across the strips is solved at some gaps, and a
 * polynomial interpolates the results. Letters as in edges.c. */
#include "electro/edges.h"

#include <math.h>
#include <string.h>

#include "electro/plates.h"

/* A quarter of the cross-section, with a mirror in the middle of the strips; upper and lower half are both solved. */
enum { MIRRORED = 2, STATIONS = 3, TERMS = ZP_EDGE_TERMS };

/* Size of the field's corner at the strip's edge, m: that of its insulator; of a bare one its distance from the image
 * in the plate, or its thickness. */
static double corner_of(const ZpEdgeParams *p) {
  return p->t > 0 ? p->t : fmin(p->b, 2 * (p->plate_t + p->least));
}

ZpFieldMesh zp_edges_mesh(const ZpEdgeParams *p) {
  static const double tape = 130e-6, widest = 50e-3; /* m: of size 1 */
  ZpFieldMesh mesh = zp_field_mesh(fmax(p->t / tape, p->w / widest));
  mesh.gap = 6;
  mesh.insulator = 2;
  mesh.clip = 12;
  mesh.outside = 16;
  mesh.first = 0.08 * corner_of(p);
  if (p->plate) mesh.strip = 2;
  if (p->t == 0) mesh.gap *= 2; /* a bare corner is in it */
  if (p->plate_t > 0) mesh.gap *= 3;
  return mesh;
}

/* Capacitance per length at one gap: twice the energy at 1 V, of all that is mirrored. A plate is the middle plane of
 * two strips, eq. (36.1): half of the gap between their insulators has half of the voltage. */
static double solve_at(ZpField *f, const ZpEdgeParams *p, double g) {
  double to_edge = 0.5 * p->w - f->params.clip, half = p->plate ? g + p->plate_t : 0.5 * g;
  const double x[STATIONS] = {0, 0.5 * to_edge, to_edge}, upper[STATIONS] = {half, half, half},
               lower[STATIONS] = {-half, -half, -half};
  ZpContact faces = {x, upper, x, lower, 1};
  if (zp_field_solve(f, &faces) != ZP_FIELD_SOLVED) return NAN;
  return (p->plate ? 2 : 1) * 2 * MIRRORED * zp_grid_energy(&f->grid);
}

bool zp_edges_capacitance(const ZpEdgeParams *p, const ZpFieldMesh *mesh, size_t count, const double *gap, double *C) {
  static const double graded = 0.8; /* of the half width, from the edge on */
  ZpFieldParams params = {.stations = STATIONS,
                          .columns = 2,
                          .w = 1,
                          .b = p->b,
                          .t = p->t,
                          .eps_m = p->eps_m,
                          .eps_out = p->eps_m,
                          .eps_i = p->eps_i,
                          .slab = 2 * p->plate_t,
                          .eps_slab = p->plate_eps,
                          .clip = graded * 0.5 * p->w,
                          .electrode = true,
                          .mesh = *mesh};
  ZpField field;
  if (!zp_field_create(&params, &field)) return false;
  for (size_t i = 0; i < count; i++)
    C[i] = solve_at(&field, p, gap[i]);
  zp_field_destroy(&field);
  return true;
}

/* -- the law --------------------------------------------------------------------------------------- */

/* z = stretch (s - s0) / (s + s0): like a logarithm over the range, but it needs square roots only, which are the same
 * everywhere. */
static void choose_variable(ZpEdgeLaw *law) {
  double least = law->least + law->d, most = law->largest + law->d, middle = sqrt(least * most), s = sqrt(most);
  law->s0 = sqrt(middle);
  law->stretch = (s + law->s0) / (s - law->s0);
}

static double gap_at(const ZpEdgeLaw *law, double z) {
  double part = z / law->stretch, s = law->s0 * (1 + part) / (1 - part);
  return fmax(s * s - law->d, law->least);
}

/* Roots of Chebyshev's polynomial of degree TERMS, cos((2 k + 1) a), a = pi / (2 TERMS), by their recurrence: no
 * library's cosine. */
static void chebyshev_roots(double z[TERMS]) {
  static const double cos_a = 0.9961946980917455323, cos_2a = 0.9848077530122080594;
  double before = cos_a; /* cos(-a) */
  z[0] = cos_a;
  for (size_t k = 1; k < TERMS; k++) {
    z[k] = 2 * cos_2a * z[k - 1] - before;
    before = z[k - 1];
  }
}

/* Values at the roots => coefficients of Chebyshev's polynomials. */
static void expand(const double z[TERMS], const double value[TERMS], double c[TERMS]) {
  memset(c, 0, TERMS * sizeof *c);
  for (size_t k = 0; k < TERMS; k++) {
    double T = 1, before = z[k]; /* T_0, T_-1 */
    for (size_t j = 0; j < TERMS; j++) {
      c[j] += (j ? 2.0 : 1.0) / TERMS * value[k] * T;
      double next = 2 * z[k] * T - before;
      before = T;
      T = next;
    }
  }
}

/* Coefficients of Chebyshev's polynomials => of powers. These stay as small as those, because they decrease faster than
 * 2^k grows. */
static void to_powers(const double c[TERMS], double p[TERMS]) {
  double T[TERMS] = {1}, before[TERMS] = {0, 1}; /* T_0 = 1, T_-1 = z */
  memset(p, 0, TERMS * sizeof *p);
  for (size_t j = 0; j < TERMS; j++)
    for (size_t k = TERMS; k-- > 0;) {
      p[k] += c[j] * T[k];
      double next = 2 * (k ? T[k - 1] : 0) - before[k];
      before[k] = T[k];
      T[k] = next;
    }
}

/* Contribution of the last terms, as a share of the least capacitance. */
static double error_of(const double c[TERMS], double least) {
  return (fabs(c[TERMS - 1]) + fabs(c[TERMS - 2])) / least;
}

static ZpStatus fit(const ZpEdgeParams *p, ZpEdgeLaw *law, ZpError *err) {
  double z[TERMS], gap[TERMS], value[TERMS], c[TERMS], least = INFINITY;
  ZpFieldMesh mesh = zp_edges_mesh(p);
  chebyshev_roots(z);
  for (size_t k = 0; k < TERMS; k++)
    gap[k] = gap_at(law, z[k]);
  if (!zp_edges_capacitance(p, &mesh, TERMS, gap, value)) return zp_fail_memory(err);
  for (size_t k = 0; k < TERMS; k++) {
    value[k] /= ZP_EPS0 * p->eps_m * p->w;
    if (!(value[k] > 0))
      return zp_fail(err, ZP_BAD_INPUT, "electro.edges: the field across the strips has no solution at a gap of %g m",
                     gap[k]);
    least = fmin(least, value[k]);
    value[k] -= 1 / (gap[k] + law->d);
  }
  expand(z, value, c);
  to_powers(c, law->p);
  law->error = error_of(c, least);
  return ZP_OK;
}

/* Liquid thickness that stands for the insulators of a strip and a plate, m. */
static double insulator_of(const ZpEdgeParams *p) {
  return p->t * p->eps_m / p->eps_i + (p->plate_t > 0 ? p->plate_t * p->eps_m / p->plate_eps : 0);
}

ZpStatus zp_edges_make(const ZpEdgeParams *p, double largest, ZpEdgeLaw *law, ZpError *err) {
  static const double worst = 1e-2;
  memset(law, 0, sizeof *law);
  law->largest = largest;
  law->d = p->plate ? insulator_of(p) : 2 * p->t * p->eps_m / p->eps_i;
  law->least = law->d > 0 ? 0 : p->least;
  choose_variable(law);
  ZpStatus status = fit(p, law, err);
  if (status != ZP_OK || law->error < worst) return status;
  return zp_fail(
      err, ZP_BAD_INPUT,
      "electro.edges: no smooth law of the gap fits the field across strips of width %g m with insulators of "
      "%g m; the relative error is %.2g",
      p->w, p->t, law->error);
}
