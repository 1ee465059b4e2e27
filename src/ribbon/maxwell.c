/* Letters of docs/theory.md, section 39:
 *   q   strain of the spring       x   step over the time of relaxation
 */
#include "ribbon/maxwell.h"

#include <math.h>

#include "math/elementary.h"

ZpMaxwell zp_maxwell(const ZpLayer *layer, double below, double width, int plane_strain, double time) {
  double above = below + layer->thickness, E = layer->young_modulus * width;
  double bends = zp_bending_modulus(layer, plane_strain) * width;
  return (ZpMaxwell){.EA = E * layer->thickness,
                     .ES = E * (above * above - below * below) / 2,
                     .EI = bends * (above * above * above - below * below * below) / 3,
                     .time = time};
}

/* (x - 1 + exp(-x)) / x^2, by its series. */
static double half_of_small(double x) {
  double sum = 0, part = 0.5;
  for (int k = 3; k < 20; k++) {
    sum += part;
    part *= -x / k;
  }
  return sum;
}

ZpMaxwellStep zp_maxwell_step(double x) {
  static const double small = 0.5; /* below it the difference of the closed form loses digits */
  double half = x > small ? 0 : half_of_small(x), come = 1 - x * half;
  if (x > small) come = -zp_decay(x) / x, half = (1 - come) / x;
  return (ZpMaxwellStep){.left = 1 + zp_decay(x), .mean = come, .come = come, .half = half};
}

static ZpBent sum_of(double a, ZpBent spring, double b, ZpBent change) {
  return (ZpBent){a * spring.curvature + b * change.curvature, a * spring.strain + b * change.strain};
}

ZpBent zp_maxwell_end(const ZpMaxwellStep *step, ZpBent spring, ZpBent change) {
  return sum_of(step->left, spring, step->come, change);
}

ZpBent zp_maxwell_mean(const ZpMaxwellStep *step, ZpBent spring, ZpBent change) {
  return sum_of(step->mean, spring, step->half, change);
}

ZpBent zp_maxwell_error(const ZpMaxwell *branch, double EI, double EA, double step, ZpBent from, ZpBent to) {
  const double x = step / branch->time, share = x * fmin(x, 1) / 12;
  return (ZpBent){share * branch->EI / (EI + branch->EI) * fabs(to.curvature - from.curvature),
                  share * branch->EA / (EA + branch->EA) * fabs(to.strain - from.strain)};
}

ZpSectionForce zp_maxwell_force(const ZpMaxwell *branch, ZpBent spring, double share) {
  return (ZpSectionForce){.M = branch->EI * spring.curvature + branch->ES * spring.strain,
                          .N = branch->ES * spring.curvature + branch->EA * spring.strain,
                          .K = share * branch->EI,
                          .both = share * branch->ES,
                          .axial = share * branch->EA};
}

double zp_maxwell_energy(const ZpMaxwell *branch, ZpBent spring) {
  const ZpSectionForce force = zp_maxwell_force(branch, spring, 0);
  return 0.5 * (force.M * spring.curvature + force.N * spring.strain);
}
