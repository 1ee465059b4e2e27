/* Designs whose equilibria were lost. Each is named after what lost them. */
#include "check_util.h"

#define UM(x) ((x)*1e-6)
#define MM(x) ((x)*1e-3)

/* The branch of study equilibrium is followed to its end, and voltages are found. */
static void is_followed(const ZpActuatorDef *def) {
  ZpResult *result = study_of(ZP_STUDY_EQUILIBRIUM, def);
  printf("%s\n", result->message);
  ck_assert_msg(result->outcome == ZP_FOLLOWED, "%s: %s", zp_outcome_name(result->outcome), result->message);
}

/* 100 g, which the breakdown cap can just hold: the gap of the platform comes to the cap's corner at 3596 V, all of its
 * attraction stops to change there, and the branch turns by more than a right angle. No step had a solution. */
TEST(a_corner_may_turn_the_branch_by_more_than_a_right_angle) {
  ZpActuatorDef def = DEF({"load.mass", 0.1}, {"drive.voltage", 12e3});
  is_followed(&def);
}

/* At such a corner corrections went to and fro between its two sides, by less than what counts as rounding: points
 * were taken for equilibria that were none, and steps became shorter and shorter. */
TEST(corrections_to_and_fro_over_a_corner_are_no_rounding) {
  ZpActuatorDef def =
      DEF({"ribbon.length", MM(186.38365821770858)}, {"ribbon.width", MM(10.992248333981115)},
          {"ribbon.thickness", UM(11.766399912342666)}, {"ribbon.young_modulus", 70e9}, {"ribbon.poisson_ratio", 0.33},
          {"ribbon.density", 2700}, {"platform.length", MM(18.638365821770857)},
          {"insulator.thickness", UM(73.387398172223864)}, {"medium.permittivity", 1}, {"medium.breakdown_field", 3e6},
          {"load.mass", 0.0004741342016834085}, {"mesh.nodes", 205}, {"drive.voltage", 11326.67435840982});
  is_followed(&def);
}

/* A hairpin: beyond the corner the branch comes back almost as it went there. The sign of the determinant told, but a
 * short step was trusted more, and went back to where it had come from. */
TEST(a_hairpin_is_not_taken_for_a_bifurcation) {
  ZpActuatorDef def =
      DEF({"ribbon.length", MM(174.72913995695433)}, {"ribbon.width", MM(33.682609709584352)},
          {"ribbon.thickness", UM(75.503814370061199)}, {"ribbon.young_modulus", 120e9}, {"ribbon.poisson_ratio", 0.34},
          {"ribbon.density", 8960}, {"platform.length", MM(17.472913995695432)},
          {"insulator.thickness", UM(22.430032707825028)}, {"load.mass", 0.44002261296345696}, {"mesh.nodes", 234},
          {"drive.voltage", 1743.6511026688893});
  is_followed(&def);
}

/* Where faces only just touch, their push (9.1) has a root of third order, to which Newton's method comes by two thirds
 * a correction: 12 corrections were too few. */
TEST(faces_that_just_touch_take_more_corrections) {
  ZpActuatorDef def = DEF({"ribbon.length", MM(259.22869288758216)}, {"ribbon.width", MM(11.065664665773254)},
                          {"ribbon.thickness", UM(38.394741996017321)}, {"ribbon.young_modulus", 70e9},
                          {"ribbon.poisson_ratio", 0.33}, {"ribbon.density", 2700},
                          {"platform.length", MM(25.922869288758216)}, {"insulator.thickness", UM(470.88608247147415)},
                          {"medium.permittivity", 1}, {"medium.breakdown_field", 3e6}, {"load.mass", 0},
                          {"mesh.nodes", 115}, {"electro.breakdown_cap", false}, {"drive.voltage", 2608.3890756527699});
  is_followed(&def);
}

/* About a state with closed faces frequencies were computed without their push, so that what the field pulls together
 * looked unstable: 21 of 300 random designs had none. */
TEST(closed_faces_push_in_a_vibration) {
  ZpActuatorDef def =
      DEF({"ribbon.length", MM(20.0174)}, {"ribbon.width", MM(17.7982)}, {"ribbon.thickness", UM(65.6714)},
          {"ribbon.young_modulus", 70e9}, {"ribbon.poisson_ratio", 0.33}, {"ribbon.density", 2700},
          {"platform.length", MM(2.00174)}, {"insulator.thickness", UM(340.911)}, {"medium.permittivity", 1},
          {"medium.breakdown_field", 3e6}, {"load.mass", 0.10785e-3}, {"mesh.nodes", 26},
          {"electro.breakdown_cap", false}, {"modes.voltage", 5421.46});
  ZpResult *result = study_of(ZP_STUDY_MODES, &def);
  printf("%s\n", result->message);
  ck_assert_msg(result->outcome == ZP_CONVERGED, "%s: %s", zp_outcome_name(result->outcome), result->message);
  ck_assert_double_gt(zp_result_get(result, "frequency_1_Hz"), 0);
}

/* Ribbons of 0.26 m, 24 um thick, whose faces open and close node by node on hundreds of unstable states: the branch
 * was followed through 40000 of them, and then the study failed, though it had found all voltages. */
TEST(voltages_do_not_depend_on_a_branch_that_is_left) {
  ZpActuatorDef def =
      DEF({"ribbon.length", MM(257.817)}, {"ribbon.width", MM(6.13439)}, {"ribbon.thickness", UM(24.333)},
          {"ribbon.young_modulus", 120e9}, {"ribbon.poisson_ratio", 0.34}, {"ribbon.density", 8960},
          {"platform.length", MM(25.7817)}, {"insulator.thickness", UM(13.9235)}, {"load.mass", 0.446932e-3},
          {"mesh.nodes", 34}, {"drive.voltage", 8299.97});
  is_followed(&def);
}

/* 18 um PET under 1e5 times the load that bends it by its length: before, the weight was applied in too large steps,
 * and no equilibrium was found. */
TEST(a_floppy_ribbon_hangs) {
  ZpActuatorDef def =
      DEF({"ribbon.length", 0.21625376098785298}, {"ribbon.width", 0.0031007512522075822},
          {"ribbon.thickness", 1.8154074755111463e-05}, {"ribbon.young_modulus", 4.5e9}, {"ribbon.poisson_ratio", 0.38},
          {"ribbon.density", 1390}, {"platform.length", 0.021625376098785301},
          {"insulator.thickness", 5.7790547849421387e-05}, {"load.mass", 0.13573764533378752}, {"mesh.nodes", 165});
  ZpResult *result = study_of(ZP_STUDY_STATIONARY, &def);
  ck_assert_int_eq(result->outcome, ZP_CONVERGED);
  /* nearly a plumb line, longer by what the load stretches it */
  double EA = def.ribbon.young_modulus / (1 - 0.38 * 0.38) * def.ribbon.width * def.ribbon.thickness;
  double length = def.ribbon.length - def.platform.length, pull = 0.5 * def.load.mass * def.gravity;
  ck_near(zp_result_get(result, "opening_m"), length * (1 + pull / EA), 1e-3); /* 1.7e-4 measured */
}

/* Ribbons that sag by more than the held opening cannot start from a straight shape. */
TEST(a_sagging_ribbon_is_held) {
  ZpActuatorDef def = DEF({"ribbon.length", MM(289.55)}, {"ribbon.width", MM(25.09)}, {"ribbon.thickness", UM(11.617)},
                          {"ribbon.young_modulus", 120e9}, {"ribbon.poisson_ratio", 0.34}, {"ribbon.density", 8960},
                          {"platform.length", MM(28.955)}, {"insulator.thickness", UM(10.256)}, {"mesh.nodes", 61},
                          {"drive.voltage", 0}, {"isometric.separation", MM(6.984)});
  ZpResult *result = study_of(ZP_STUDY_ISOMETRIC, &def);
  ck_assert_msg(result->outcome == ZP_CONVERGED, "%s", result->message);
  ck_near(zp_result_get(result, "opening_m"), MM(6.984), 1e-12); /* 6.6e-15 measured */
}

/* The first equilibrium that Newton's method found from straight ribbons was one of folded ribbons, and was told as
 * converged: an opening of 0.86 mm in place of 208 mm. */
TEST(folded_ribbons_do_not_hang) {
  ZpActuatorDef def =
      DEF({"ribbon.length", 0.24860145390406665}, {"ribbon.width", MM(38.07427946651043)},
          {"ribbon.thickness", UM(18.099793612775266)}, {"ribbon.young_modulus", 4.5e9}, {"ribbon.poisson_ratio", 0.38},
          {"ribbon.density", 1390}, {"platform.length", MM(24.860145390406665)},
          {"insulator.thickness", UM(328.53484285284319)}, {"load.mass", 0.26674789460421629e-3}, {"mesh.nodes", 66});
  ZpResult *result = study_of(ZP_STUDY_STATIONARY, &def);
  ck_assert_int_eq(result->outcome, ZP_CONVERGED);
  /* so floppy that it hangs down by nearly its length */
  ck_assert_double_gt(zp_result_get(result, "opening_m"), 0.9 * (def.ribbon.length - def.platform.length));
}

/* The same where a platform is held: 45 N held it without a voltage. */
TESTS(folded_ribbons_are_not_held, 0, FULL_OR(1, 0)) {
  ZpActuatorDef def =
      DEF({"ribbon.length", 0.28922918210588483}, {"ribbon.width", MM(3.0716343541618693)},
          {"ribbon.thickness", UM(11.598368520728278)}, {"ribbon.young_modulus", 4.5e9}, {"ribbon.poisson_ratio", 0.38},
          {"ribbon.density", 1390}, {"platform.length", MM(28.922918210588483)},
          {"insulator.thickness", UM(243.86074075866854)}, {"medium.permittivity", 1}, {"medium.breakdown_field", 3e6},
          {"mesh.nodes", 104}, {"drive.voltage", 6556.4542054961239}, {"isometric.separation", MM(36.737034318392078)});
  ZpResult *result = study_of(ZP_STUDY_ISOMETRIC, &def);
  ck_assert_msg(result->outcome == ZP_CONVERGED, "%s", result->message);
  ck_below(fabs(zp_result_get(result, "force_unpowered_N")), 3e-4); /* 9e-5 measured */
}

/* 13 jumps on the way, the last of them just below the voltage that was asked for: no equilibrium on that branch was
 * there. */
NIGHTLY_TESTS(a_limit_point_may_be_just_below_the_voltage, 0, FULL_OR(1, 0)) {
  ZpActuatorDef def =
      DEF({"ribbon.length", 0.1200336615396364}, {"ribbon.width", MM(26.284869619987918)},
          {"ribbon.thickness", UM(18.357024024574153)}, {"ribbon.young_modulus", 4.5e9}, {"ribbon.poisson_ratio", 0.38},
          {"ribbon.density", 1390}, {"platform.length", MM(12.003366153963642)},
          {"insulator.thickness", UM(15.603396346234549)}, {"medium.permittivity", 1}, {"medium.breakdown_field", 3e6},
          {"mesh.nodes", 31}, {"electro.breakdown_cap", false}, {"drive.voltage", 11790.344315779474},
          {"isometric.separation", MM(13.994349384042608)});
  ZpResult *result = study_of(ZP_STUDY_ISOMETRIC, &def);
  ck_assert_msg(result->outcome == ZP_CONVERGED, "%s", result->message);
  ck_assert_double_gt(zp_result_get(result, "force_N"), 0);
}

/* A front that is far shorter than an element passes node by node as the load falls: the search ended after 40 of these
 * ripples, and told no largest load. */
TEST(a_front_may_pass_many_nodes) {
  ZpActuatorDef def =
      DEF({"ribbon.length", 0.2027688723017764}, {"ribbon.width", 0.003635957385695796},
          {"ribbon.thickness", 1.1008653342774954e-05}, {"ribbon.young_modulus", 120e9}, {"ribbon.poisson_ratio", 0.34},
          {"ribbon.density", 8960}, {"platform.length", 0.020276887230177641},
          {"insulator.thickness", 2.6362772824232017e-05}, {"load.mass", 0}, {"mesh.nodes", 136},
          {"drive.voltage", 13119.99847555616}, {"output.errors", 0});
  ZpResult *result = study_of(ZP_STUDY_LIMITS, &def);
  ck_assert_msg(result->outcome == ZP_CONVERGED, "%s", result->message);
  ck_assert_double_gt(zp_result_get(result, "max_load_kg"), 0);
}
