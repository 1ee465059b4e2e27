/* Strips between plane stress and plane strain: the law against its closed form, its energy, its limits, and shapes at
 * rest against moments that are known; sections 2 and 8 of docs/theory.md. */
#include "check_util.h"

#include "ribbon/curl.h"
#include "ribbon/rod_curl.h"

static const ZpCurl strip = {2e-6, 4e-3};

/* Ashwell's function by the C library. */
static double share_of(double theta) {
  return 2 / theta * (cosh(theta) - cos(theta)) / (sinh(theta) + sin(theta));
}

TESTS(law_is_the_closed_form, 0, 11) {
  static const double theta[] = {1e-3, 0.1, 0.7, 2.4, 6, 17, 35, 35.99, 36.01, 60, 400};
  double t = theta[_i], curvature = t * t / sqrt(strip.squared), h = 1e-4 * curvature;
  ZpCurlLaw law = zp_curl_law(&strip, curvature), less = zp_curl_law(&strip, -curvature + h),
            more = zp_curl_law(&strip, curvature + h);
  ck_near(law.W, 0.5 * strip.EI * curvature * curvature * share_of(t), t < 0.01 ? 5e-10 : 1e-13);
  ck_near(law.M, (more.W - less.W) / (2 * h), 1e-8); /* 1.5e-9 measured */
  ck_near(law.K, (more.M + less.M) / (2 * h), 3e-8); /* 3.9e-9 measured */
}

/* Narrow strips: plane stress; wide strips: only an edge of constant width curls. */
TEST(limits_of_the_law) {
  double small = 1e-6, large = 1e12;
  ck_near(zp_curl_law(&strip, small).M, strip.EI * small, 1e-12);
  ck_near(zp_curl_law(&strip, small).K, strip.EI, 1e-12);
  ck_near(zp_curl_law(&strip, large).M, 1.5 * strip.EI * large / sqrt(sqrt(strip.squared) * large), 1e-12);
  ck_assert_double_eq(zp_curl_law(&strip, 0).W, 0);
  ck_assert_double_eq(zp_curl_law(&strip, -3).M, -zp_curl_law(&strip, 3).M);
}

/* The mean moment over a step does the work, over short and long steps, and its slope is its derivative. */
TESTS(mean_moment_does_the_work, 0, 9) {
  static const double way[][2] = {{3, 3.1}, {3, 9}, {-2, 40}, {0, 1}, {5, 5.000001},
                                  {60, 58}, {7, 7}, {2, 5.9}, {2, 6}};
  double from = way[_i][0], to = way[_i][1], h = 1e-5;
  ZpCurlMean mean = zp_curl_mean(&strip, from, to);
  double work = zp_curl_law(&strip, to).W - zp_curl_law(&strip, from).W;
  ck_below(fabs(mean.M * (to - from) - work), 1e-12 * zp_curl_law(&strip, 60).W);
  double slope = (zp_curl_mean(&strip, from, to + h).M - zp_curl_mean(&strip, from, to - h).M) / (2 * h);
  ck_near(mean.K, slope, 3e-9); /* 4.3e-10 measured */
}

static double sag_of(ZpActuatorDef def, ZpPlane plane) {
  def.ribbon.plane = plane;
  ZpResult *result = study_of(ZP_STUDY_STATIONARY, &def);
  ck_assert_msg(zp_outcome_good(result->outcome), "%s", result->message);
  return zp_table_get(result->series, result->series->rows - 1, "y_m");
}

/* A narrow strip is in plane stress, a wide strongly bent one in plane strain, for any support of its end. */
TESTS(narrow_and_wide_strips, 0, 3) {
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", _i}, {"ribbon.width", 1e-4},
                          {"load.mass", 2e-6}, {"ribbon.length", 0.05}, {"mesh.nodes", 31}, {"output.errors", false});
  double stress = sag_of(def, ZP_PLANE_STRESS), strain = sag_of(def, ZP_PLANE_STRAIN);
  if (_i != ZP_END_CLAMPED) ck_assert_double_gt(fabs(stress / strain), 1.001);
  ck_near(sag_of(def, ZP_PLANE_ANTICLASTIC), stress, 2e-8); /* 2.9e-9 measured */
  def.ribbon.width = 1, def.load.mass = 20e-3, def.ribbon.thickness = 20e-6;
  strain = sag_of(def, ZP_PLANE_STRAIN);
  ck_near(sag_of(def, ZP_PLANE_ANTICLASTIC), strain, 3e-4); /* 6.8e-5 measured */
}

/* The curvature at which the whole section bears a moment, by bisection. */
static double curvature_under(double M, double EI, const ZpCurl *curl) {
  double low = 0, high = 2 * M / (EI - curl->EI);
  for (int k = 0; k < 100; k++) {
    double middle = 0.5 * (low + high);
    *(EI * middle - zp_curl_law(curl, middle).M < M ? &low : &high) = middle;
  }
  return low;
}

/* A wide, weakly bent cantilever has the curvature of its moment everywhere, between both limits. */
TEST(cantilever_between_both) {
  static const double w = 0.1, b = 50e-6, L = 0.02, nu = 0.4, E = 200e9, P = 0.002;
  enum { PARTS = 4000 };
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", ZP_END_FREE}, {"ribbon.width", w},
                          {"ribbon.thickness", b}, {"ribbon.length", L}, {"ribbon.poisson_ratio", nu},
                          {"ribbon.density", 0}, {"load.mass", P / 9.81}, {"mesh.nodes", 81}, {"output.errors", false});
  double narrow = E * w * b * b * b / 12, EI = narrow / (1 - nu * nu);
  const ZpCurl curl = {EI - narrow, 3 * (1 - nu * nu) * w * w * w * w / (b * b)};
  double sag = 0, l = L / PARTS;
  for (int k = 0; k < PARTS; k++) {
    double arm = (k + 0.5) * l;
    sag += curvature_under(P * arm, EI, &curl) * arm * l;
  }
  double found = -sag_of(def, ZP_PLANE_ANTICLASTIC);
  ck_near(found, sag, 5e-6); /* 1.3e-6 measured */
  ck_assert_double_gt(found, 1.03 * -sag_of(def, ZP_PLANE_STRAIN));
  ck_assert_double_lt(found, 0.97 * -sag_of(def, ZP_PLANE_STRESS));
}

/* The moments over a step do the work of the energy change, and at rest are its gradient, at the ends and between them.
 */
TESTS(energy_in_motion, 0, 5) {
  ZpActuatorDef def =
      DEF({"actuator.kind", _i < 3 ? ZP_KIND_RIBBON : ZP_KIND_ELECTRO_RIBBON}, {"actuator.right_end", _i % 3},
          {"ribbon.width", 0.05}, {"ribbon.poisson_ratio", 0.45}, {"ribbon.plane", ZP_PLANE_ANTICLASTIC},
          {"initial.state", _i < 3 ? ZP_INITIAL_STRAIGHT : ZP_INITIAL_EQUILIBRIUM}, {"mesh.nodes", 15},
          {"liquid.model", ZP_LIQUID_NONE}, {"solver.end_time", 0.05}, {"output.errors", false},
          {"solver.stop_when_zipped", ZP_WHEN_FALSE});
  if (_i == 4) def.actuator.symmetry = ZP_SYMMETRY_NONE;
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_msg(zp_outcome_good(result->outcome), "%s", result->message);
  double most = 0, worst = 0, start = NAN;
  for (size_t row = 0; row < result->series->rows; row++) {
    static const char *const kinds[] = {"kinetic_energy_J", "axial_energy_J", "bending_energy_J", "gravity_energy_J"};
    double sum = 0;
    for (size_t k = 0; k < LENGTH_OF(kinds); k++)
      sum += zp_table_get(result->series, row, kinds[k]);
    sum += zp_table_get(result->series, row, "internal_loss_J");
    if (row == 0) start = sum;
    most = fmax(most, fabs(zp_table_get(result->series, row, "gravity_energy_J")));
    worst = fmax(worst, fabs(sum - start));
  }
  if (_i < 3)
    ck_below(worst, 2e-8 * most); /* what iterations leave of it, in plane strain, too; 2.8e-9 measured */
  else
    ck_below(zp_result_get(result, "energy_error"), 2e-8); /* 2.2e-9 measured */
}

/* The frequencies of a flat strip are those of plane stress. */
TESTS(flat_strips_vibrate_in_plane_stress, 0, 3) {
  ZpActuatorDef def =
      DEF({"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", _i}, {"ribbon.width", 0.05}, {"load.mass", 0},
          {"gravity", 0}, {"ribbon.plane", ZP_PLANE_ANTICLASTIC}, {"mesh.nodes", 21}, {"output.errors", false});
  ZpResult *curls = study_of(ZP_STUDY_MODES, &def);
  def.ribbon.plane = ZP_PLANE_STRESS;
  ZpResult *flat = study_of(ZP_STUDY_MODES, &def);
  ck_near(zp_result_get(curls, "frequency_1_Hz"), zp_result_get(flat, "frequency_1_Hz"), 1e-11); /* 1.3e-12 measured */
  ck_near(zp_result_get(curls, "frequency_3_Hz"), zp_result_get(flat, "frequency_3_Hz"), 1e-12); /* 6e-15 measured */
}

TEST(what_it_lacks_is_said) {
  static const struct {
    Setting setting;
    const char *says;
  } refused[] = {{{"ribbon.model", ZP_RIBBON_MASS_SPRING}, "requires ribbon.model rod"},
                 {{"segment_1.length", 5e-3}, "is modelled without segments"},
                 {{"lower.segment_2.length", 5e-3}, "is modelled without segments"}};
  for (size_t k = 0; k < LENGTH_OF(refused); k++) {
    ZpActuatorDef def = DEF({"ribbon.plane", ZP_PLANE_ANTICLASTIC}, refused[k].setting);
    ck_refused(&def, refused[k].says);
  }
}
