/* What changes of single tokens of the source showed to be unchecked: each test names what could be wrong without any
 * other noticing. */
#include "check_util.h"

#include "contact/contact.h"
#include "drive/waveform.h"
#include "electro/plates.h"

/* -- drive ----------------------------------------------------------------------------------------- */

static ZpActuatorDef square_wave(double duty, double rise_time) {
  ZpActuatorDef def = DEF({"drive.waveform", ZP_WAVEFORM_SQUARE}, {"drive.frequency", 20}, {"drive.voltage", 5e3},
                          {"drive.offset", 1e3}, {"drive.duty", duty});
  def.drive.rise_time = rise_time;
  return def;
}

/* Regression: a rise time of twice the allowed value was accepted unless duty was one half. What fits just so is a wave
 * without a jump that comes to both of its voltages; longer is refused whichever part, the high or the low one, is the
 * shorter. */
TESTS(square_wave_rises_within_its_shorter_part, 0, 3) {
  static const double duties[] = {0.2, 0.5, 0.8};
  double duty = duties[_i], shorter = fmin(duty, 1 - duty) / 20;
  ZpActuatorDef def = square_wave(duty, shorter);
  ZpError err = {ZP_OK, ""};
  ck_ok(zp_def_check(&def, &err));
  ZpWaveform wave = zp_waveform_of(&def, NULL);
  ck_near(zp_waveform_voltage(&wave, shorter), 5e3, 1e-12);     /* 0 measured */
  ck_near(zp_waveform_voltage(&wave, 0.05 - 1e-12), 1e3, 3e-9); /* 4e-10 measured */
  for (double t = 0; t < 0.2; t = zp_waveform_next_corner(&wave, t))
    ck_near(zp_waveform_voltage_before(&wave, t), zp_waveform_voltage(&wave, t), 1e-12); /* 0 measured */
  for (double factor = 1.001; factor < 5; factor *= 1.5) {
    def = square_wave(duty, factor * shorter);
    ck_assert_msg(zp_def_check(&def, &err) == ZP_BAD_INPUT, "%g times what fits was taken", factor);
    ck_assert_ptr_nonnull(strstr(err.message, "drive.rise_time"));
  }
}

/* -- contact --------------------------------------------------------------------------------------- */

static size_t front_of(const double *gap, size_t nodes) {
  ZpContactParams faces = {
      .nodes = nodes, .range = zp_contact_range(260e-6), .platform = nodes - 1, .platform_end = nodes - 1};
  return zp_contact_front(&faces, gap);
}

/* The front ends at the first station that is open, whatever touches behind it, and at the platform where none is. */
TEST(front_ends_at_the_first_open_station) {
  const double open = 1e-3, shut = 1e-7;
  ck_assert_uint_eq(front_of((double[]){0, open, shut, shut}, 4), 0);
  ck_assert_uint_eq(front_of((double[]){0, shut, open, shut}, 4), 1);
  ck_assert_uint_eq(front_of((double[]){0, shut, -shut, open}, 4), 2);
  ck_assert_uint_eq(front_of((double[]){0, shut, shut, shut, shut, shut}, 4), 3);
}

/* The closed state at drive.voltage: the point of a branch there with the largest capacitance. */
static size_t closed_row(const ZpTable *branch, double voltage) {
  size_t closed = 0;
  for (size_t i = 0; i < branch->rows; i++)
    if (zp_table_get(branch, i, "voltage_V") == voltage &&
        zp_table_get(branch, i, "capacitance_F") > zp_table_get(branch, closed, "capacitance_F"))
      closed = i;
  return closed;
}

/* Where attraction and push per length are equal: k U^2 / d^2 = p_c (-g / delta)^3 by (9.1) and (9.2), without cap. */
static double closed_gap(double U) {
  const double largest = 2 * 130e-6 * 40e6, delta = 5e-7;
  return -delta * cbrt(U / largest * U / largest);
}

/* Faces closed by drive.voltage lie where contact force and attraction are equal, also at the platform and the end, and
 * form a plate capacitor of two insulators thinner by the overlap. A flange has no platform that could push. */
static void check_closed(const ZpActuatorDef *def, const char *distance, double length) {
  const double d = 2 * 130e-6 * 2.75 / 4.62, U = def->drive.voltage,
               C = ZP_EPS0 * 2.75 * 12.7e-3 * length / (d + closed_gap(U));
  ZpResult *result = study_of(ZP_STUDY_EQUILIBRIUM, def);
  size_t row = closed_row(result->series, U);
  ck_assert_double_eq_tol(zp_table_get(result->series, row, distance), closed_gap(U), 1e-8); /* 3e-9 measured */
  ck_near(zp_table_get(result->series, row, "capacitance_F"), C, 1e-4);                      /* 8.2e-5 measured */
  ck_near(zp_table_get(result->series, row, "charge_C"), C * U, 1e-4);                       /* 8.2e-5 measured */
}

TEST(closed_faces_lie_on_each_other) {
  ZpActuatorDef flange = DEF({"actuator.kind", ZP_KIND_FLANGE}, {"mesh.nodes", 21}, {"ribbon.length", 20e-3},
                             {"load.mass", 0.1e-3}, {"electro.breakdown_cap", 0}, {"drive.voltage", 2e3});
  ZpActuatorDef pair = DEF({"mesh.nodes", 21}, {"electro.breakdown_cap", 0});
  check_closed(&flange, "stroke_m", 20e-3);
  check_closed(&pair, "opening_m", 2 * (45e-3 + 5e-3));
}

/* Eq. (9.3): from the velocity of two nodes of mass m/2 on layers of stiffness k the damper removes the fraction eta
 * sqrt(k/m) per second; nothing if faces do not overlap. So it is with k by the Gauss points and by the station. */
TEST(damper_takes_what_the_loss_factor_says) {
  ZpContactParams faces = {.nodes = 3, .l = 1e-3, .depth = 1e-7, .push = 60};
  double push[3], own[3], next[3], stiffness[3], k = 3 * 60 * 1e-3 / 1e-7, m = 1e-5, dt = 1e-12;
  double none[3] = {0};
  ZpContactEval eval = {push, own, next, stiffness, none};
  const double closed[] = {-1e-7, -1e-7, -1e-7}, open[] = {0, 1e-9, 0};
  zp_contact_eval(&faces, &(ZpContactSpan){closed, closed, 0, 0}, &eval);
  ck_near((1 - zp_contact_kept(&eval, 1, m, dt)) / dt, 0.5 * sqrt(k / m), 1e-6);                /* 2.1e-7 measured */
  ck_near((1 - zp_contact_kept_at(&faces, closed[1], 1, m, dt)) / dt, 0.5 * sqrt(k / m), 1e-6); /* 2.1e-7 measured */
  zp_contact_eval(&faces, &(ZpContactSpan){open, open, 0, 0}, &eval);
  ck_assert_double_eq(zp_contact_kept(&eval, 1, m, 1), 1);
  ck_assert_double_eq(zp_contact_kept_at(&faces, open[1], 1, m, 1), 1);
}

/* Faces that overlap by the depth push with `push` per length, (9.1): each end of a platform with half an element and
 * its own half of the platform, between which there is no element. */
TEST(both_ends_of_a_platform_push) {
  enum { NODES = 6 };
  ZpContactParams faces = {
      .nodes = NODES, .l = 1e-3, .depth = 1e-7, .push = 60, .flat_length = 2e-3, .platform = 2, .platform_end = 3};
  double push[NODES], own[NODES], next[NODES], stiffness[NODES], none[NODES] = {0}, gap[NODES];
  ZpContactEval eval = {push, own, next, stiffness, none};
  for (size_t i = 0; i < NODES; i++)
    gap[i] = -faces.depth;
  zp_contact_eval(&faces, &(ZpContactSpan){gap, gap, 0, 0}, &eval);
  for (size_t i = 0; i < NODES; i++) {
    bool platform = i == 2 || i == 3, inner = i > 0 && i + 1 < NODES && !platform;
    ck_near(push[i], faces.push * ((inner ? 1 : 0.5) * faces.l + (platform ? faces.flat_length : 0)), 1e-12);
  }
}

/* Eq. (9.6): over a short span at nearly constant depth the contact force beyond that of the layers is eta sqrt(k m)
 * times the velocity, and from the first touch to a depth it is eta sqrt(k m) / 2 times the velocity in contact. */
TEST(damper_in_a_step_is_that_of_the_loss_factor) {
  const double l = 1e-3, depth = 1e-7, m = 1e-5, h = 1e-9, k = 3 * 60 * l / depth;
  ZpContactParams faces = {.nodes = 3, .l = l, .depth = depth, .push = 60, .platform = 3};
  double push[3], own[3], next[3], stiffness[3], damper[3];
  ZpContactEval eval = {push, own, next, stiffness, damper};
  const double start[] = {-1e-7 + 1e-11, 3e-7}, way[] = {2e-11, 4e-7}, touching[] = {2e-11, 1e-7}, depths[] = {1, 0.5};
  for (size_t j = 0; j < 2; j++) {
    double a = start[j], b = a - way[j];
    const double from[] = {a, a, a}, to[] = {b, b, b};
    memset(damper, 0, sizeof damper);
    zp_contact_eval(&faces, &(ZpContactSpan){from, to, 0, 1 / h}, &eval);
    double layers = push[1];
    zp_contact_damp(&faces, 1, m, &eval);
    zp_contact_eval(&faces, &(ZpContactSpan){from, to, 0, 1 / h}, &eval);
    ck_near(push[1] - layers, depths[j] * 0.5 * sqrt(k * m) * touching[j] / h, 3e-12); /* 3.9e-13 measured */
  }
}

/* Two elements; the edge of their free end presses as so much of their length. */
#define WITH_FREE_END(length)                                                                                          \
  { .nodes = 3, .l = 1e-3, .depth = 1e-7, .push = 60, .platform = 2, .platform_end = 2, .flat_length = (length) }

/* Energy of the layers of two elements and of a free end, p_c delta / 4 (-g / delta)^4 per length, J. */
static double layers_energy(const ZpContactParams *faces, const double *gap) {
  enum { CELLS = 4000 };
  double sum = 0;
  for (size_t i = 0; i + 1 < faces->nodes; i++)
    for (int c = 0; c < CELLS; c++) {
      double r = (c + 0.5) / CELLS, s = fmax(-((1 - r) * gap[i] + r * gap[i + 1]) / faces->depth, 0);
      sum += faces->l / CELLS * faces->push * faces->depth / 4 * s * s * s * s;
    }
  double s = fmax(-gap[faces->nodes - 1] / faces->depth, 0);
  return sum + faces->flat_length * faces->push * faces->depth / 4 * s * s * s * s;
}

static double work_of_push(const ZpContactParams *faces, const double *from, const double *to,
                           const ZpContactEval *eval) {
  double work = 0;
  zp_contact_eval(faces, &(ZpContactSpan){from, to, 0, 0}, eval);
  for (size_t i = 0; i < faces->nodes; i++)
    work += eval->push[i] * (to[i] - from[i]);
  return work;
}

/* Over a step faces push with the mean that does the work by which the energy of their layers changes: where they stay
 * closed, meet, part, or both within an element; with a free end that presses as a point or without. */
TESTS(push_over_a_step_does_the_work_of_the_layers, 0, 2) {
  static const double way[][2][3] = {{{-1e-7, -2e-7, -1e-7}, {-2e-7, -1e-7, -1e-7}},
                                     {{5e-8, 5e-8, 5e-8}, {-1e-7, -1e-7, -1e-7}},
                                     {{-1e-7, -1e-7, -1e-7}, {2e-7, 2e-7, 2e-7}},
                                     {{1e-7, 1e-7, 1e-7}, {2e-7, 2e-7, 2e-7}}};
  ZpContactParams faces = WITH_FREE_END(3e-4 * _i);
  double push[3], own[3], next[3], stiffness[3];
  double none[3] = {0};
  ZpContactEval eval = {push, own, next, stiffness, none};
  for (size_t k = 0; k < LENGTH_OF(way); k++) {
    double work = work_of_push(&faces, way[k][0], way[k][1], &eval);
    double lost = layers_energy(&faces, way[k][0]) - layers_energy(&faces, way[k][1]);
    printf("work %.6g J, energy %.6g J\n", work, lost);
    ck_below(fabs(work - lost), 1e-6 * 60 * 1e-7 * 1e-3);
  }
}

/* Its derivative with respect to the gaps at the end, by finite differences; at rest, where both ends move, it is half
 * of the stiffness. */
TESTS(push_over_a_step_has_this_derivative, 0, 2) {
  static const double from[][3] = {{-1e-7, -2e-7, -1e-7}, {5e-8, 5e-8, 5e-8}, {-3e-7, 1e-7, 2e-7}};
  const double to[] = {-1.5e-7, -1e-7, 0.3e-7}, d = 1e-12;
  ZpContactParams faces = WITH_FREE_END(3e-4 * _i);
  double push[3], own[3], next[3], stiffness[3], more[3], other[3][3];
  double damper[3] = {0};
  ZpContactEval eval = {push, own, next, stiffness, damper}, at_more = {more, other[0], other[1], other[2], damper};
  zp_contact_damp(&faces, 1, 1e-5, &eval);
  for (size_t k = 0; k < LENGTH_OF(from); k++)
    for (size_t i = 0; i < 3; i++) {
      double moved[3] = {to[0], to[1], to[2]};
      moved[i] += d;
      double late = k == 2 ? 0.3 : 0, rate = 1e5; /* of it layers and damper have derivatives alike */
      zp_contact_eval(&faces, &(ZpContactSpan){from[k], to, late, rate}, &eval);
      zp_contact_eval(&faces, &(ZpContactSpan){from[k], moved, late, rate}, &at_more);
      ck_near((push[i] - more[i]) / d, own[i], 1e-4);                         /* 1.4e-5 measured */
      if (i + 1 < 3) ck_near((push[i + 1] - more[i + 1]) / d, next[i], 1e-4); /* 1.4e-5 measured */
    }
  zp_contact_eval(&faces, &(ZpContactSpan){to, to, 0, 0}, &eval);
  double both[] = {to[0], to[1] + d, to[2]};
  zp_contact_eval(&faces, &(ZpContactSpan){both, both, 0, 0}, &at_more);
  ck_near((push[1] - more[1]) / d, 2 * own[1], 3e-5); /* 7.7e-6 measured */
}

/* The contact law does not depend on future voltages: a pull-in is the same however far the curve goes. */
TEST(pull_in_does_not_depend_on_the_largest_voltage) {
  double pull_in[3];
  static const double largest[] = {5.2e3, 10e3, 50e3};
  for (int k = 0; k < 3; k++) {
    ZpActuatorDef def = DEF({"mesh.nodes", 61}, {"electro.breakdown_cap", 0}, {"drive.voltage", largest[k]});
    pull_in[k] = zp_result_get(study_of(ZP_STUDY_EQUILIBRIUM, &def), "pull_in_voltage_V");
  }
  printf("pull-in without cap: %.9g, %.9g, %.9g V up to 5.2, 10, 50 kV\n", pull_in[0], pull_in[1], pull_in[2]);
  ck_near(pull_in[1], pull_in[0], 1e-12); /* 0 measured */
  ck_near(pull_in[2], pull_in[0], 1e-12); /* 0 measured */
}

/* -- heavy loads ----------------------------------------------------------------------------------- */

/* A floppy ribbon under a load that is applied in steps: it hangs straight down and stretches by its load and half its
 * own weight. What bends at the clamp is sqrt(EI / P) = 5 um of it. */
TEST(floppy_ribbon_hangs_straight_down) {
  const double L = 10, EA = 200e9 * 12.7e-3 * 1e-6, weight = 7850 * 12.7e-3 * 1e-6 * L * 9.81;
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", ZP_END_FREE}, {"ribbon.length", L},
                          {"ribbon.thickness", 1e-6}, {"load.mass", 1});
  ZpResult *result = study_of(ZP_STUDY_STATIONARY, &def);
  ck_assert_msg(result->outcome == ZP_CONVERGED, "%s", result->message);
  ck_near(zp_result_get(result, "stroke_m"), L * (1 + (9.81 + weight / 2) / EA), 1e-12); /* 5.1e-15 measured */
}

/* -- a held platform ------------------------------------------------------------------------------- */

static ZpResult *hold(double voltage) {
  ZpActuatorDef def =
      DEF({"mesh.nodes", 21}, {"isometric.separation", 17e-3}, {"drive.voltage", voltage}, {"output.samples", 20000});
  ZpResult *result = study_of(ZP_STUDY_ISOMETRIC, &def);
  ck_assert_msg(result->outcome == ZP_CONVERGED, "%s", result->message);
  return result;
}

/* How often a branch of states comes up through `voltage` while they are stable. */
static int times_passed(const ZpTable *branch, double voltage) {
  int times = 0;
  for (size_t i = 1; i < branch->rows; i++)
    times += zp_table_get(branch, i - 1, "voltage_V") < voltage && zp_table_get(branch, i, "voltage_V") >= voltage &&
             zp_table_get(branch, i - 1, "stable") == 1 && zp_table_get(branch, i, "stable") == 1;
  return times;
}

/* On this mesh the branch turns at 6.15 kV, back at 6.03 kV: at 6.1 kV there is a second state, which was not counted
 * if the search ended early. The branch itself, followed further, says how many there are. */
TEST(other_states_are_counted) {
  ZpResult *here = hold(6.1e3), *further = hold(7e3);
  int states = times_passed(further->series, 6.1e3);
  ck_assert_int_eq(states, 2);
  ck_assert_double_eq(zp_result_get(here, "other_states"), states - 1);
}

/* -- implicit steps -------------------------------------------------------------------------------- */

/* A wrong matrix of the iteration gives the right motion, at the cost of more iterations: they are two or three a step
 * in free motion, damped or not (measured: 2.9, 2.8). */
TESTS(steps_converge_in_three_iterations, 0, 2) {
  static const double damping[] = {0, 10e-3};
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", ZP_END_FREE}, {"load.mass", 0},
                          {"initial.state", ZP_INITIAL_STRAIGHT}, {"mesh.nodes", 21}, {"solver.end_time", 0.5},
                          {"damping.internal", damping[_i]});
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  double tried = zp_result_get(result, "steps") + zp_result_get(result, "steps_rejected");
  double iterations = zp_result_get(result, "newton_iterations") / tried;
  printf("damping %g s: %.2f iterations a step\n", damping[_i], iterations);
  ck_below(iterations, 3.2);
  ck_assert_double_eq(zp_result_get(result, "newton_failures"), 0);
}
