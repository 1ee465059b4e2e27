/* Letters of docs/theory.md, sections 2 and 39:
 *   p   plastic strain of a fibre           e   strain of the neutral axis where nothing pulls
 *   s   strain of a fibre, z kappa + a      a   (1 - share) e + share times the strain of the section
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
                       .share = section->EA / section->strained,
                       .surface = {-section->axis, metal->thickness - section->axis}};
  lay_fibres(&plastic, metal->thickness, width);
  return plastic;
}

/* Eq. (2.9): the plastic strain of a fibre that is strained to s. */
static double yielded(const ZpPlastic *plastic, double p0, double s) {
  double over = 1 / (1 + plastic->hardening / plastic->E), room = plastic->yields / plastic->E;
  return fmin(fmax(p0, (s - room) * over), (s + room) * over);
}

/* Sums over fibres that yield, of how their plastic forces and moments go with a and the curvature. */
typedef struct Sums {
  double by_a, both, by_curvature;
} Sums;

static Sums sum_yielding(const ZpPlastic *plastic, const double *p0, const double *p1) {
  double over = 1 / (1 + plastic->hardening / plastic->E);
  Sums sum = {0, 0, 0};
  for (int i = 0; i < ZP_FIBRES; i++) {
    double z = plastic->z[i], a = plastic->part[i] * over;
    if (p1[i] == p0[i]) continue;
    sum.by_a += a;
    sum.both += a * z;
    sum.by_curvature += a * z * z;
  }
  return sum;
}

double zp_plastic_elongation(const ZpPlastic *plastic, const double *p) {
  double force = 0;
  for (int i = 0; i < ZP_FIBRES; i++)
    force += plastic->part[i] * p[i];
  return force / plastic->EA;
}

/* Eq. (39.5): what strains fibres beside their curvature. */
static double pulled(const ZpPlastic *plastic, double e, double strain) {
  return (1 - plastic->share) * e + plastic->share * strain;
}

static void strain_fibres(const ZpPlastic *plastic, const double *p0, double curvature, double a, double *p1) {
  for (int i = 0; i < ZP_FIBRES; i++)
    p1[i] = yielded(plastic, p0[i], plastic->z[i] * curvature + a);
}

/* Eq. (2.10), by Newton's method: the force along is a piecewise linear function of e, whose slope other layers and
 * what pulls keep above 0. */
static void balance(const ZpPlastic *plastic, const double *p0, double curvature, double strain, double *p1) {
  enum { MOST = 100 };
  double e = zp_plastic_elongation(plastic, p0), low = -INFINITY, high = INFINITY;
  strain_fibres(plastic, p0, curvature, pulled(plastic, e, strain), p1);
  for (int k = 0; k < MOST; k++) {
    double left = e - zp_plastic_elongation(plastic, p1);
    double slope = 1 - (1 - plastic->share) * sum_yielding(plastic, p0, p1).by_a / plastic->EA, next = e - left / slope;
    *(left > 0 ? &high : &low) = e;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (left == 0 || next == e || !isfinite(next)) break;
    e = next;
    strain_fibres(plastic, p0, curvature, pulled(plastic, e, strain), p1);
  }
}

ZpSectionForce zp_plastic_force(const ZpPlastic *plastic, const double *p) {
  ZpSectionForce force = {.N = plastic->share * plastic->EA * zp_plastic_elongation(plastic, p)};
  for (int i = 0; i < ZP_FIBRES; i++)
    force.M += plastic->part[i] * plastic->z[i] * p[i];
  return force;
}

ZpSectionForce zp_plastic_again(const ZpPlastic *plastic, const double *p0, const double *p1) {
  ZpSectionForce force = zp_plastic_force(plastic, p1);
  Sums sum = sum_yielding(plastic, p0 ? p0 : none, p1);
  double beside = 1 - plastic->share, over = 1 / (plastic->EA - beside * sum.by_a);
  if (sum.by_a == 0) return force;
  force.K = sum.by_curvature + (beside > 0 && sum.both != 0 ? beside * sum.both * sum.both * over : 0);
  force.both = plastic->share * plastic->EA * sum.both * over;
  force.axial = plastic->share * plastic->share * plastic->EA * sum.by_a * over;
  return force;
}

ZpSectionForce zp_plastic_bend(const ZpPlastic *plastic, const double *p0, double curvature, double strain,
                               double *p1) {
  balance(plastic, p0 ? p0 : none, curvature, strain, p1);
  return zp_plastic_again(plastic, p0, p1);
}

double zp_plastic_relief(const ZpPlastic *plastic, const double *p, double curvature, double strain) {
  double squares = 0, e = zp_plastic_elongation(plastic, p);
  const ZpSectionForce takes = zp_plastic_force(plastic, p);
  for (int i = 0; i < ZP_FIBRES; i++)
    squares += plastic->part[i] * p[i] * p[i];
  return curvature * takes.M + strain * takes.N + 0.5 * (1 - plastic->share) * plastic->EA * e * e -
         0.5 * (1 + plastic->hardening / plastic->E) * squares;
}

double zp_plastic_heat(const ZpPlastic *plastic, const double *p0, ZpBent from, const double *p1, ZpBent to) {
  double e = 0.5 * (zp_plastic_elongation(plastic, p0) + zp_plastic_elongation(plastic, p1));
  double curvature = 0.5 * (from.curvature + to.curvature), a = pulled(plastic, e, 0.5 * (from.strain + to.strain));
  double resists = 1 + plastic->hardening / plastic->E, sum = 0;
  for (int i = 0; i < ZP_FIBRES; i++) {
    double drives = plastic->z[i] * curvature + a - resists * 0.5 * (p0[i] + p1[i]);
    sum += plastic->part[i] * drives * (p1[i] - p0[i]);
  }
  return sum;
}

/* A face has yielded as the fibre beside it, and is strained a little more: from there it yields by itself. */
static double face_stress(const ZpPlastic *plastic, double p, double s) {
  return plastic->E * fabs(s - yielded(plastic, p, s));
}

double zp_plastic_stress(const ZpPlastic *plastic, const double *p0, double curvature, double strain) {
  double p[ZP_FIBRES], most = 0;
  zp_plastic_bend(plastic, p0, curvature, strain, p);
  double a = pulled(plastic, zp_plastic_elongation(plastic, p), strain);
  for (int side = 0; side < 2; side++)
    most = fmax(most, face_stress(plastic, p[side ? ZP_FIBRES - 1 : 0], plastic->surface[side] * curvature + a));
  return most;
}
