/* A strip in space at rest, as a definition describes it: the plane, a load beside the middle, a strip on edge; section
 * 41 of docs/theory.md. */
#include "state_util.h"

static ZpActuatorDef strip(ZpRightEnd right) {
  ZpActuatorDef def = zp_actuator_def_default();
  def.actuator.kind = ZP_KIND_RIBBON;
  def.actuator.right_end = right;
  def.ribbon.length = 60e-3;
  def.ribbon.model = ZP_RIBBON_SPATIAL;
  def.load.mass = 0.5e-3;
  def.load.share = 1;
  def.output.errors = false;
  return def;
}

static double value_of(const ZpActuatorDef *def, const char *name) {
  return answered_value(ZP_STUDY_STATIONARY, def, name);
}

/* All nodes: the end of a clamped strip stays where it is. */
TEST(in_the_plane_it_is_the_rod) {
  for (int right = ZP_END_GUIDED; right <= ZP_END_CLAMPED; right++)
    for (int plane = ZP_PLANE_STRAIN; plane <= ZP_PLANE_ANTICLASTIC; plane++) {
      ZpActuatorDef def = strip((ZpRightEnd)right);
      def.ribbon.plane = (ZpPlane)plane;
      def.load.mass = right == ZP_END_CLAMPED ? 0 : 2e-3;
      def.mount.tilt = 0.3;
      const ZpTable *spatial = converged_of(ZP_STUDY_STATIONARY, &def)->series;
      def.ribbon.model = ZP_RIBBON_ROD;
      const ZpTable *rod = converged_of(ZP_STUDY_STATIONARY, &def)->series;
      double lowest = 0;
      for (size_t row = 0; row < rod->rows; row++) {
        const double y = zp_table_get(rod, row, "y_m");
        lowest = fmin(lowest, y);
        ck_assert_double_eq_tol(zp_table_get(spatial, row, "y_m"), y, 7e-14 * def.ribbon.length);
      }
      ck_assert_double_lt(lowest, -1e-6);
    }
}

/* So small a load that the strip stays straight: linear twist, whose length warping at the clamp shortens. */
TEST(small_load_beside_the_middle) {
  ZpActuatorDef def = strip(ZP_END_FREE);
  def.ribbon.density = def.insulator.density = 0;
  def.load.mass = 1e-6;
  def.load.across = 4e-3;
  const double t = def.ribbon.thickness, w = def.ribbon.width, E = def.ribbon.young_modulus,
               C = E / (2 * (1 + def.ribbon.poisson_ratio)) * w * t * t * t / 3 * (1 - 0.63 * t / w),
               d = sqrt(E * t * t * t * w * w * w / 144 / C), L = def.ribbon.length,
               twist = def.load.mass * def.gravity * def.load.across / C * (L - d * tanh(L / d));
  double off[2];
  for (int k = 0; k < 2; k++) {
    def.mesh.nodes = k == 0 ? 61 : 121;
    off[k] = value_of(&def, "skew_rad") / twist - 1;
  }
  ck_below(fabs(off[1]), 2e-4);
  ck_near(log2(off[0] / off[1]), 2, 0.1);
}

/* Newton's method needs as few iterations as in the plane: its stiffness is the derivative of the forces, with moments
 * about the stiff axis that the step foresees. */
TEST(load_beside_the_middle_takes_few_iterations) {
  ZpActuatorDef def = strip(ZP_END_FREE);
  for (int k = 0; k < 3; k++) {
    def.load.across = (k - 1) * 5e-3;
    ck_assert_double_le(value_of(&def, "iterations"), 4);
  }
}

TEST(other_side_is_the_mirror_image) {
  ZpActuatorDef def = strip(ZP_END_FREE);
  double skew[2], lateral[2], stroke[2];
  def.load.mass = 5e-3;
  for (int side = 0; side < 2; side++) {
    def.load.across = side ? 3e-3 : -3e-3;
    skew[side] = value_of(&def, "skew_rad");
    lateral[side] = value_of(&def, "lateral_m");
    stroke[side] = value_of(&def, "stroke_m");
  }
  ck_assert_double_gt(skew[1], 0.03);
  ck_near(skew[1], -skew[0], 1e-15);
  ck_near(lateral[1], -lateral[0], 1e-15);
  ck_near(stroke[1], stroke[0], 1e-15);
}

TEST(upside_down_it_rises) {
  ZpActuatorDef def = strip(ZP_END_FREE);
  const double down = value_of(&def, "stroke_m");
  def.mount.roll = zp_key(zp_key_find("mount.roll"))->max;
  ck_near(value_of(&def, "stroke_m"), -down, 3e-14);
}

/* On edge, with the warping of 45 mm (d / L = 0.0654): it stays in its plane below the first buckling load, and leaves
 * it above. */
TEST(strip_on_edge_buckles) {
  ZpActuatorDef def = strip(ZP_END_FREE);
  def.ribbon.density = def.insulator.density = 0;
  def.ribbon.length = 45e-3;
  def.mount.roll = 0.5 * zp_key(zp_key_find("mount.roll"))->max - 1e-4;
  const double t = def.ribbon.thickness, w = def.ribbon.width, E = def.ribbon.young_modulus,
               nu = def.ribbon.poisson_ratio, B = E * w * t * t * t / 12 / (1 - nu * nu),
               C = E / (2 * (1 + nu)) * w * t * t * t / 3 * (1 - 0.63 * t / w),
               critical = 4.6260 * sqrt(B * C) / (def.ribbon.length * def.ribbon.length);
  double aside[2];
  for (int k = 0; k < 2; k++) {
    def.load.mass = (k == 0 ? 0.95 : 1.05) * critical / def.gravity;
    aside[k] = value_of(&def, "stroke_m") / def.ribbon.length;
  }
  ck_below(aside[0], 2e-3);
  ck_assert_double_gt(aside[1], 5 * aside[0]);
}
