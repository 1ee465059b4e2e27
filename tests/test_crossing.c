/* No study gives a state as an answer that cannot be: faces that pass through each other, a negative capacitance. */
#include "check_util.h"

#include "rest/crossing.h"
#include "rest/rest.h"
#include "run/run.h"

/* Two straight ribbons, the lower one turned by a small angle about a point 0.35 elements right of node 7: from node 8
 * on it lies above the upper one, and the first two nodes there tell the depth. Ribbons that only touch, or that lie
 * apart, do not cross. */
TEST(depth_is_that_of_two_lines) {
  enum { AT = 7 };
  static const double slope = 0.02;
  ZpActuatorDef def = DEF({"mesh.nodes", 21});
  ZpModel *model = model_of(&def);
  double *q = zp_calloc(2 * model->stride, sizeof *q), l = model->l, at = (AT + 0.35) * l;
  double x0 = zp_straight_x(model, 0);
  for (int sign = 1; sign >= -1; sign -= 2) {
    for (size_t j = 0; j < model->count; j++) {
      q[j] = zp_straight_x(model, j / 2);
      q[model->stride + j] = j % 2 ? sign * slope * (q[j] - x0 - at) : 0;
    }
    double beyond = sign > 0 ? 1.65 : 1.35;
    ck_near(zp_crossing_depth(model, q), slope * beyond * l, 1e-12); /* 8.9e-16 measured */
  }
  for (size_t j = 1; j < model->count; j += 2)
    q[model->stride + j] = -1e-6 * fabs(q[j] - x0 - at);
  ck_assert_double_eq(zp_crossing_depth(model, q), 0);
  zp_free(q);
}

/* Only one node overlaps, by 1 um, beside a neighbour far outside: the faces cross twice, and the depth is that of the
 * node, as at a zip front on a coarse mesh. */
TEST(depth_of_one_node_is_its_own) {
  enum { AT = 6 };
  ZpActuatorDef def = DEF({"mesh.nodes", 11});
  ZpModel *model = model_of(&def);
  double *q = zp_calloc(2 * model->stride, sizeof *q);
  for (size_t j = 0; j < model->count; j++) {
    q[j] = zp_straight_x(model, j / 2);
    q[model->stride + j] = j % 2 ? (j / 2 == AT ? 1e-6 : j / 2 < AT ? -2e-7 : -4e-4) : 0;
  }
  ck_near(zp_crossing_depth(model, q), 1e-6, 1e-12); /* 0 measured */
  zp_free(q);
}

/* Two nodes overlap, at two places: the depth is the larger one, wherever it lies. */
TEST(depth_is_the_largest_of_all_places) {
  static const size_t place[] = {3, 7};
  ZpActuatorDef def = DEF({"mesh.nodes", 11});
  ZpModel *model = model_of(&def);
  double *q = zp_calloc(2 * model->stride, sizeof *q);
  for (int deeper = 0; deeper < 2; deeper++) {
    for (size_t j = 0; j < model->count; j++) {
      q[j] = zp_straight_x(model, j / 2);
      q[model->stride + j] = j % 2 ? -4e-4 : 0;
    }
    for (int k = 0; k < 2; k++)
      q[model->stride + 2 * place[k] + 1] = k == deeper ? 3e-6 : 1e-6;
    ck_near(zp_crossing_depth(model, q), 3e-6, 1e-12); /* 0 measured */
  }
  zp_free(q);
}

/* Eq. (9.9): on faces of slope theta nodes that face each other have slid apart by s, at one height. Every gap is 0,
 * and the faces lie inside each other by s sin(theta). */
TEST(gaps_do_not_show_what_has_slid) {
  enum { AT = 7 };
  static const double theta = 0.4, by_node = 2e-5; /* rad; m */
  ZpActuatorDef def = DEF({"mesh.nodes", 21});
  ZpModel *model = model_of(&def);
  double *q = zp_calloc(2 * model->stride, sizeof *q);
  for (size_t j = 0; j < model->count; j++) {
    double along = (double)(j / 2) * model->l;
    q[j] = along * cos(theta) - (j % 2 ? by_node * ((double)(j / 2) - AT - 0.35) : 0);
    q[model->stride + j] = along * sin(theta);
  }
  double depth = 1.65 * by_node * sin(theta);
  ck_near(zp_crossing_depth(model, q), depth, 1.2e-12); /* 3.8e-13 measured */
  ck_assert(zp_crosses(model, q, 0.999 * depth));
  ck_assert(!zp_crosses(model, q, 1.001 * depth));
  zp_free(q);
}

/* The short way and the long one, for random ribbons that run to the right, most of them steep, between a clip and
 * a platform. */
TEST(short_way_overlooks_no_crossing) {
  enum { SHAPES = 300000 };
  ZpActuatorDef def = DEF({"mesh.nodes", 9});
  ZpModel *model = model_of(&def);
  double *q = zp_calloc(2 * model->stride, sizeof *q), deeper = 0.1 * model->l;
  uint64_t seed = 1;
  int crosses = 0;
  for (int k = 0; k < SHAPES; k++) {
    double slid = (1 + noise(&seed)) * 0.15 * model->l, apart = (1 + noise(&seed)) * 0.1 * model->l;
    for (size_t i = 0; i < model->nodes; i++)
      for (size_t ribbon = 0; ribbon < 2; ribbon++) {
        size_t j = 2 * i + ribbon, before = i > 0 ? j - 2 : j;
        double y = q[model->stride + before] + (i > 0 ? 3 * noise(&seed) * model->l : 0);
        q[j] = (double)i * model->l + noise(&seed) * slid;
        q[model->stride + j] = ribbon ? q[model->stride + j - 1] + (noise(&seed) - 0.3) * apart : y;
      }
    size_t last = model->count - 2;
    q[1] = q[0], q[model->stride + 1] = q[model->stride];
    q[last + 1] = q[last], q[model->stride + last + 1] = fmin(q[model->stride + last + 1], q[model->stride + last]);
    ck_assert(zp_crosses(model, q, deeper) == (zp_crossing_depth(model, q) > deeper));
    crosses += zp_crosses(model, q, deeper);
  }
  printf("%d of %d shapes cross\n", crosses, SHAPES);
  ck_assert(crosses > SHAPES / 10 && crosses < SHAPES * 9 / 10);
  zp_free(q);
}

/* A sheet of 12 um that hangs nearly upright: its zip makes steep faces slide. The run ends in the first step in which
 * they lie deeper inside each other than insulators and sheet are thick. */
TEST(run_ends_where_steep_faces_have_slid) {
  ZpActuatorDef def = DEF({"liquid.model", ZP_LIQUID_NONE}, {"ribbon.length", 0.24}, {"platform.length", 0.024},
                          {"ribbon.width", 0.03}, {"ribbon.thickness", 12e-6}, {"ribbon.young_modulus", 4.5e9},
                          {"ribbon.density", 1390}, {"insulator.thickness", 27e-6}, {"electro.breakdown_cap", false},
                          {"load.mass", 1e-4}, {"mesh.nodes", 15}, {"drive.voltage", 14e3});
  const double most = 2 * def.insulator.thickness + def.ribbon.thickness;
  ZpModel *model = model_of(&def);
  ZpRunInfo info;
  ZpSim *sim = sim_of(model);
  ck_assert_int_eq(zp_sim_run(sim, 0.2, false, NULL, &info), ZP_BEYOND_MODEL);
  double depth = zp_crossing_depth(model, zp_state_q(model, sim->state));
  printf("%s\ndeep by %.3g m of %.3g m\n", info.message, depth, most);
  ck_assert(depth > most && depth < 1.5 * most); /* 1.02 measured */
  ck_assert_ptr_nonnull(strstr(info.message, ZP_FACES_CROSS "; " ZP_LESS_STEEP "; the results so far are kept"));
  ck_assert_str_eq(zp_outcome_name(info.outcome), "beyond_model");
  ck_assert(!zp_outcome_good(info.outcome));
  ZpResult *result = study_of(ZP_STUDY_ACTUATE, &def);
  ck_assert_int_eq(result->outcome, ZP_BEYOND_MODEL);
  ck_assert_double_nan(zp_result_get(result, "contraction"));
}

/* Ribbons that sag steeply beside each other: the only state at drive.voltage has faces inside each other, with any
 * mesh. */
TEST(held_ribbons_that_sag_have_no_force) {
  ZpActuatorDef def = DEF({"liquid.model", ZP_LIQUID_NONE}, {"ribbon.length", 0.2155}, {"platform.length", 0.02155},
                          {"ribbon.width", 26.34e-3}, {"ribbon.thickness", 23.76e-6}, {"ribbon.young_modulus", 120e9},
                          {"ribbon.poisson_ratio", 0.34}, {"ribbon.density", 8960}, {"insulator.thickness", 15.38e-6},
                          {"medium.permittivity", 1}, {"medium.breakdown_field", 3e6}, {"mesh.nodes", 29},
                          {"drive.voltage", 3537}, {"isometric.separation", 0.665e-3});
  ZpResult *result = study_of(ZP_STUDY_ISOMETRIC, &def);
  printf("%s\n", result->message);
  ck_assert_int_eq(result->outcome, ZP_BEYOND_MODEL);
  ck_assert_double_nan(zp_result_get(result, "force_N"));
  ck_assert_ptr_nonnull(strstr(result->message, "no force at drive.voltage = 3537 V: " ZP_FACES_CROSS));
}

/* The reason why a state is refused. */
TEST(impossible_states_are_named) {
  ZpActuatorDef def = DEF({"mesh.nodes", 21});
  ZpModel *model = model_of(&def);
  ZpRest *rest;
  ck_assert_int_eq(zp_rest_create(model, &rest, NULL), ZP_OK);
  ck_assert(zp_rest_hang(rest, 0));
  ZpStatics *s = &rest->statics;
  ZpStaticSystem system = zp_statics_system(s);
  ck_assert_ptr_null(zp_statics_fault(s));
  double *x = s->member->q, *y = x + model->stride, *r = rest->statics.newton.r;
  for (size_t j = 0; j < model->count; j++) /* both run back to the left */
    x[j] = -x[j];
  ck_assert_int_eq(system.residual(s, r, NULL), ZP_END_FOUND);
  ck_assert_str_eq(zp_statics_fault(s), "the capacitance is negative");
  for (size_t j = 0; j < model->count; j++) { /* steep, the lower one beside the upper one */
    x[j] = (j % 2 ? 2e-3 : 0) + 0.1 * (-x[j]);
    y[j] = -0.7e-3 * (double)(j / 2) + (j % 2 && j > 2 ? -1e-4 : 0);
  }
  x[1] = x[0], y[1] = y[0];
  x[3] = x[2] - 2e-4, x[5] = x[4] - 1e-3;
  ck_assert_int_eq(system.residual(s, r, NULL), ZP_END_FOUND);
  ck_assert_str_eq(zp_statics_fault(s), ZP_FACES_CROSS);
  zp_rest_destroy(rest);
}

/* A closed fold that hangs steeply opens from its hinge on, and its faces slide along each other by more and more: gaps
 * of facing stations do not tell where they are. That the search ends there is no release. */
TEST(fold_that_slides_has_no_release) {
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_HINGE}, {"ribbon.length", 0.25}, {"ribbon.thickness", 70e-6},
                          {"ribbon.width", 23e-3}, {"insulator.thickness", 12e-6}, {"load.mass", 0.55e-3},
                          {"drive.voltage", 14e3}, {"mesh.nodes", 61});
  ZpResult *result = study_of(ZP_STUDY_LIMITS, &def);
  ck_assert(zp_outcome_good(result->outcome));
  ck_assert_double_nan(zp_result_get(result, "release_voltage_V"));
  ck_assert_ptr_nonnull(strstr(result->message, "faces of the closed state came to lie inside each other"));
}
