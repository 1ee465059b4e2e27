/* Letters of docs/theory.md, section 2:
 *   p   plastic strain of a fibre           e   strain of the neutral axis
 *   s   total strain of a fibre, z kappa + e
 *   r   hardening modulus over E'           room   yield strain, yield stress over E'
 * so that the stress that makes a fibre yield is E' times s - (1 + r) p.
 */
#include "ribbon/plastic.h"

#include <math.h>

static const double none[ZP_FIBRES] = {0};

/* Two Gauss points in each of equal slices: all that is quadratic in the height is exact. */
static void lay_fibres(ZpPlastic *plastic, double thickness, double width) {
  static const double off = 0.28867513459481288; /* half of 1 / sqrt(3) */
  enum { SLICES = ZP_FIBRES / 2 };
  double slice = thickness / SLICES;
  for (int i = 0; i < ZP_FIBRES; i++) {
    int below = i / 2;
    double above = slice * (below + 0.5 + (i % 2 ? off : -off));
    plastic->z[i] = above + plastic->surface[0];
    plastic->part[i] = 0.5 * plastic->E * width * slice;
  }
}

ZpPlastic zp_plastic(const ZpLayer *metal, const ZpSection *section, double width, int plane_strain, double yields,
                     double hardening) {
  ZpPlastic plastic = {.E = zp_bending_modulus(metal, plane_strain),
                       .yields = yields,
                       .hardening = hardening,
                       .EI = section->EI,
                       .EA = section->strained,
                       .surface = {-section->axis, metal->thickness - section->axis}};
  plastic.alone = section->strained == plastic.E * metal->thickness * width;
  lay_fibres(&plastic, metal->thickness, width);
  return plastic;
}

/* Sums over fibres: plastic force and moment; and over those that yield, how these go with e and the curvature. */
typedef struct Sums {
  double force, moment, by_e, both, by_curvature;
} Sums;

/* Eq. (2.9): the plastic strain of a fibre that is strained to s. */
static double yielded(const ZpPlastic *plastic, double p0, double s) {
  double over = 1 / (1 + plastic->hardening / plastic->E), room = plastic->yields / plastic->E;
  return fmin(fmax(p0, (s - room) * over), (s + room) * over);
}

/* The plastic strains where the axis is strained by e. */
static Sums strain_fibres(const ZpPlastic *plastic, const double *p0, double curvature, double e, double *p1) {
  double over = 1 / (1 + plastic->hardening / plastic->E);
  Sums sum = {0, 0, 0, 0, 0};
  for (int i = 0; i < ZP_FIBRES; i++) {
    double z = plastic->z[i], a = plastic->part[i], s = z * curvature + e;
    p1[i] = yielded(plastic, p0[i], s);
    sum.force += a * p1[i];
    sum.moment += a * z * p1[i];
    if (p1[i] == p0[i]) continue;
    sum.by_e += a * over;
    sum.both += a * z * over;
    sum.by_curvature += a * z * z * over;
  }
  return sum;
}

/* The strain of the axis that plastic strains ask for: no force is left along the section. */
static double axis_strain(const ZpPlastic *plastic, const double *p) {
  double force = 0;
  if (plastic->alone) return 0;
  for (int i = 0; i < ZP_FIBRES; i++)
    force += plastic->part[i] * p[i];
  return force / plastic->EA;
}

/* Eq. (2.10), by Newton's method: the force along is a piecewise linear function of e, whose slope other layers keep
 * above 0. */
static Sums balance(const ZpPlastic *plastic, const double *p0, double curvature, double *p1) {
  enum { MOST = 100 };
  double e = axis_strain(plastic, p0), low = -INFINITY, high = INFINITY;
  Sums sum = strain_fibres(plastic, p0, curvature, e, p1);
  for (int k = 0; k < MOST && !plastic->alone; k++) {
    double left = plastic->EA * e - sum.force, next = e - left / (plastic->EA - sum.by_e);
    *(left > 0 ? &high : &low) = e;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (left == 0 || next == e || !isfinite(next)) break;
    e = next;
    sum = strain_fibres(plastic, p0, curvature, e, p1);
  }
  return sum;
}

ZpPlasticMoment zp_plastic_bend(const ZpPlastic *plastic, const double *p0, double curvature, double *p1) {
  Sums sum = balance(plastic, p0 ? p0 : none, curvature, p1);
  double along = plastic->alone ? 0 : sum.both * sum.both / (plastic->EA - sum.by_e);
  return (ZpPlasticMoment){sum.moment, sum.by_curvature + along};
}

double zp_plastic_moment(const ZpPlastic *plastic, const double *p) {
  double sum = 0;
  for (int i = 0; i < ZP_FIBRES; i++)
    sum += plastic->part[i] * plastic->z[i] * p[i];
  return sum;
}

double zp_plastic_relief(const ZpPlastic *plastic, const double *p, double curvature) {
  double squares = 0, e = axis_strain(plastic, p);
  for (int i = 0; i < ZP_FIBRES; i++)
    squares += plastic->part[i] * p[i] * p[i];
  return curvature * zp_plastic_moment(plastic, p) + 0.5 * plastic->EA * e * e -
         0.5 * (1 + plastic->hardening / plastic->E) * squares;
}

double zp_plastic_heat(const ZpPlastic *plastic, const double *p0, double curvature0, const double *p1,
                       double curvature1) {
  double e = 0.5 * (axis_strain(plastic, p0) + axis_strain(plastic, p1)), curvature = 0.5 * (curvature0 + curvature1);
  double resists = 1 + plastic->hardening / plastic->E, sum = 0;
  for (int i = 0; i < ZP_FIBRES; i++) {
    double drives = plastic->z[i] * curvature + e - resists * 0.5 * (p0[i] + p1[i]);
    sum += plastic->part[i] * drives * (p1[i] - p0[i]);
  }
  return sum;
}

/* A face has yielded as the fibre beside it, and is strained a little more: from there it yields by itself. */
static double face_stress(const ZpPlastic *plastic, double p, double s) {
  return plastic->E * fabs(s - yielded(plastic, p, s));
}

double zp_plastic_stress(const ZpPlastic *plastic, const double *p0, double curvature) {
  double p[ZP_FIBRES], most = 0;
  zp_plastic_bend(plastic, p0, curvature, p);
  double e = axis_strain(plastic, p);
  for (int side = 0; side < 2; side++)
    most = fmax(most, face_stress(plastic, p[side ? ZP_FIBRES - 1 : 0], plastic->surface[side] * curvature + e));
  return most;
}
