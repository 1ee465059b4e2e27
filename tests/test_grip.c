/* Contacts with friction between bodies in the plane: the law over a span, sticking and sliding blocks against closed
 * forms, energy, order, rest. docs/theory.md, eqs. (34.8) to (34.10). */
#include "network_util.h"

#include "actuator/model.h"
#include "rest/statics.h"
#include "run/run.h"
#include "system/friction.h"

static const double g = 9.81, coefficient = 0.5, stiffness = 5000;

/* -- the law --------------------------------------------------------------------------------------- */

/* Spans of all kinds: faces that stay together, meet and part, whose contact sticks and slides to either side. */
static double some(size_t i, double least, double most) {
  const double s = sin(1.0 + 12.9898 * (double)i) * 43758.5453;
  return least + (most - least) * (s - floor(s));
}

enum { SPANS = 4000 };

static ZpRub rub_of(size_t i) {
  ZpRub rub = {some(5 * i, 0.05, 2), 0, some(5 * i + 1, -2, 2), {some(5 * i + 2, -1, 0.7), some(5 * i + 3, -1, 0.7)}};
  rub.strain = some(5 * i + 4, -1, 1) * zp_friction_bound(rub.friction, rub.gap[0]);
  return rub;
}

/* Where the gap changes in proportion, each span is as both of its parts one after the other: so also is one in many.
 */
static ZpRub part_of(const ZpRub *rub, double from, double to, double strain) {
  const double opened = rub->gap[1] - rub->gap[0];
  return (ZpRub){
      rub->friction, strain, (to - from) * rub->moved, {rub->gap[0] + from * opened, rub->gap[0] + to * opened}};
}

TEST(span_is_as_its_parts) {
  double off = 0;
  for (size_t i = 0; i < SPANS; i++) {
    const ZpRub all = rub_of(i);
    const double cut = some(i + 7, 0.01, 0.99);
    const ZpFriction whole = zp_friction(&all);
    const ZpRub first = part_of(&all, 0, cut, all.strain);
    const ZpFriction one = zp_friction(&first);
    const ZpRub second = part_of(&all, cut, 1, one.end);
    const ZpFriction other = zp_friction(&second);
    off = fmax(off, fabs(whole.end - other.end));
    off = fmax(off, fabs(whole.mean - cut * one.mean - (1 - cut) * other.mean));
    off = fmax(off, fabs(whole.lost - one.lost - other.lost));
  }
  printf("off by %.2g\n", off);
  ck_assert_double_lt(off, 1e-14);
}

/* Eq. (34.9): work is what is stored and what is lost, which is never negative; the strain stays within its bound. */
TEST(work_is_stored_or_lost) {
  double off = 0, least = 0;
  size_t slides = 0;
  for (size_t i = 0; i < SPANS; i++) {
    const ZpRub rub = rub_of(i);
    const ZpFriction f = zp_friction(&rub);
    off = fmax(off, fabs(f.mean * rub.moved - 0.5 * (f.end * f.end - rub.strain * rub.strain) - f.lost));
    least = fmin(least, f.lost);
    slides += f.lost > 0;
    ck_assert_double_le(fabs(f.end), zp_friction_bound(rub.friction, rub.gap[1]) * (1 + 1e-12));
  }
  printf("off by %.2g, least loss %.2g, %zu of %d slide\n", off, least, slides, SPANS);
  ck_assert_double_lt(off, 1e-14);
  ck_assert_double_gt(least, -1e-15);
  ck_assert_uint_gt(slides, SPANS / 4);
}

/* Derivatives of the mean by the way and by the gap at the end. Few spans have a kink within the difference. */
TEST(tangent_is_the_derivative_of_the_mean) {
  static const double by = 1e-6;
  size_t kinks = 0;
  for (size_t i = 0; i < SPANS; i++) {
    const ZpRub rub = rub_of(i);
    const ZpFriction f = zp_friction(&rub);
    ZpRub more = rub, less = rub;
    more.moved += by, less.moved -= by;
    const double by_moved = (zp_friction(&more).mean - zp_friction(&less).mean) / (2 * by);
    more = less = rub;
    more.gap[1] += by, less.gap[1] -= by;
    const double by_gap = (zp_friction(&more).mean - zp_friction(&less).mean) / (2 * by);
    kinks += fabs(by_moved - f.by_moved) > 1e-8 || fabs(by_gap - f.by_gap) > 1e-8;
  }
  printf("%zu of %d have a kink\n", kinks, SPANS);
  ck_assert_uint_le(kinks, 3);
}

/* -- a block --------------------------------------------------------------------------------------- */

/* On two feet as high as its centre, beside an actuator; the floor slopes. */
static const char block[] =
    "study: actuate\nmesh.nodes: 9\ndrive.voltage: 0 V\nsolver: {end_time: %.17g, stop_when_zipped: "
    "false}\n"
    "bodies:\n  block: {moves: plane, mass: 10 g, inertia: 500 g mm2, at: [300 mm, 0], angle: %.17g, force: [%.17g, "
    "0]}\n"
    "  hand: {mass: 2 g, force: [0, -20 mN]}\n"
    "springs:\n"
    "  left: {between: [frame, block], from_at: [300 mm, 0], to_at: [-10 mm, 0], direction: %.17g, kind: push, "
    "stiffness: "
    "5000 N/m, friction: 0.5}\n"
    "  right: {between: [frame, block], from_at: [300 mm, 0], to_at: [10 mm, 0], direction: %.17g, kind: push, "
    "stiffness: 5000 N/m, friction: 0.5}\n"
    "members: {other: {upper: frame, lower: hand}}\n";

static const double mass = 10e-3, right_angle = 1.5707963267948966;

static ZpActuatorDef block_on(double slope, double force, double end) {
  char text[2048];
  const double up = right_angle - slope;
  snprintf(text, sizeof text, block, end, -slope, force, up, up);
  return def_of(text);
}

static void push(ZpSim *sim, const ZpActuatorDef *def, const char *input, double force) {
  ck_ok(zp_sim_set_input(sim, (ZpInput)zp_def_input_find(def, input), force, 0, &err));
}

/* Below friction the floor gives by F / 2 k, and no more for as long as one looks: it does not creep. */
TEST(block_sticks) {
  ZpActuatorDef def = block_on(0, 0.95 * coefficient * mass * g, 1);
  ZpSim *sim = data_sim_of(&def);
  const double gives = 0.95 * coefficient * mass * g / (2 * stiffness), sinks = mass * g / (2 * stiffness);
  const double start = column_of(sim, &def, "block.x_m") - 0.3;
  run_to(sim, 1);
  const double end = column_of(sim, &def, "block.x_m") - 0.3;
  printf("gives by %.9g m, off by %.2g, %.2g m later\n", start, start / gives - 1, end - start);
  ck_near(start, gives, 1.6e-11);                            /* 5.3e-12 measured */
  ck_near(column_of(sim, &def, "block.y_m"), -sinks, 4e-11); /* 1.4e-11 measured */
  ck_assert_double_lt(fabs(end - start), 1e-14);
  ck_assert_double_eq(zp_sim_get(sim, "contact_loss"), 0);
}

/* Beyond it: a = F / m - friction g, from the strain that friction bears; the loss is friction m g s. */
TEST(block_slides) {
  static const double end = 0.1;
  const double force = 1.2 * coefficient * mass * g, a = force / mass - coefficient * g;
  ZpActuatorDef def = block_on(0, force, end);
  ZpSim *sim = data_sim_of(&def);
  const double start = column_of(sim, &def, "block.x_m");
  run_to(sim, end);
  const double way = column_of(sim, &def, "block.x_m") - start, lost = zp_sim_get(sim, "contact_loss");
  printf("slides by %.9g m, off by %.2g; loss off by %.2g\n", way, way / (0.5 * a * end * end) - 1,
         lost / (coefficient * mass * g * way) - 1);
  ck_near(way, 0.5 * a * end * end, 4e-10); /* 1.4e-10 measured */
  ck_near(lost, coefficient * mass * g * way, 1e-12);
}

/* A block that a program pushes for 10 ms with three times the friction: first the floor gives, then it slides, ever
 * slower, and comes to rest, where it trembles on the floor between both bounds of the strain. Steps that double until
 * it stops must not miss that it does. */
static const struct {
  double tolerance, lost, beyond; /* measured: error of the loss, way from where it trembles, m */
} come_to_rest[] = {{1e-3, 1.6e-3, 2.6e-5}, {1e-6, 1.8e-5, 0}};

TESTS(block_comes_to_rest, 0, LENGTH_OF(come_to_rest)) {
  static const double pushed = 10e-3;
  const double drag = coefficient * mass * g, force = 3 * drag, k = 2 * stiffness, omega = sqrt(k / mass);
  const double gives = acos(1 - drag / force) / omega, left = pushed - gives, a = (force - drag) / mass;
  const double v0 = force / (mass * omega) * sin(omega * gives), v1 = v0 + a * left,
               way = drag / k + v0 * left + 0.5 * a * left * left, all = way + 0.5 * v1 * v1 / (coefficient * g);
  ZpActuatorDef def = block_on(0, 0, 1);
  def.solver.tolerance = come_to_rest[_i].tolerance;
  ZpSim *sim = data_sim_of(&def);
  push(sim, &def, "block.force_x", force);
  run_to(sim, pushed);
  push(sim, &def, "block.force_x", 0);
  run_to(sim, 0.3);
  const double gone = column_of(sim, &def, "block.x_m") - 0.3, work = zp_sim_get(sim, "load_work"),
               lost = zp_sim_get(sim, "contact_loss") / (drag * (all - drag / k));
  printf("slides by %.9g of %.9g m; work off by %.2g, loss by %.2g, imbalance %.2g\n", gone, all,
         work / (force * way) - 1, lost - 1, zp_sim_get(sim, "energy_imbalance") / work);
  ck_assert_double_lt(fabs(gone - all + drag / k), drag / k + 3 * come_to_rest[_i].beyond);
  ck_assert_double_lt(fabs(lost - 1), 3 * come_to_rest[_i].lost);
  ck_assert_double_lt(fabs(zp_sim_get(sim, "energy_imbalance")), 1e-8 * work);
}

/* On a floor that slopes by less than atan(friction) it stays, at more it slides with g (sin - friction cos). The floor
 * slopes by its direction; or else it is level, and gravity is a force that slopes. */
TEST(block_slides_down_a_slope) {
  static const double end = 0.1;
  for (int steep = 0; steep < 2; steep++) {
    const double slope = atan(coefficient) + (steep ? 0.1 : -0.1);
    const double a = steep ? g * (sin(slope) - coefficient * cos(slope)) : 0;
    ZpActuatorDef def = block_on(slope, 0, end);
    ZpSim *sim = data_sim_of(&def);
    const double x = column_of(sim, &def, "block.x_m"), y = column_of(sim, &def, "block.y_m");
    run_to(sim, end);
    const double way = hypot(column_of(sim, &def, "block.x_m") - x, column_of(sim, &def, "block.y_m") - y);
    printf("slope of %.4g rad: %.9g m, off by %.2g m\n", slope, way, way - 0.5 * a * end * end);
    ck_assert_double_lt(fabs(way - 0.5 * a * end * end), steep ? 1e-10 : 1e-13);
  }
}

/* A drawing without gravity that is turned, the floor on a body that holds still by a weld: as the plain one. */
static ZpActuatorDef on_a_body(double by, double force) {
  char text[2048];
  const double c = cos(by), s = sin(by);
  snprintf(
      text, sizeof text,
      "study: actuate\nmesh.nodes: 9\ndrive.voltage: 0 V\ngravity: 0\nsolver: {end_time: 50 ms, stop_when_zipped: "
      "false, tolerance: 1e-6}\n"
      "bodies:\n  floor: {moves: plane, mass: 30 g, inertia: 4e-5 kg m2, at: [0.3, -0.05], angle: %.17g}\n"
      "  block: {moves: plane, mass: 10 g, inertia: 500 g mm2, at: [%.17g, %.17g], angle: %.17g, force: [%.17g, "
      "%.17g]}\n  hand: {mass: 2 g, force: [0, -20 mN]}\n"
      "joints: {p: {type: pin, between: [frame, floor], at: [0.3, -0.05]}}\n"
      "springs:\n  left: {between: [floor, block], to_at: [-10 mm, 0], direction: %.17g, kind: push, stiffness: 5000 "
      "N/m, rest: 50 mm, friction: 0.5}\n"
      "  right: {between: [floor, block], to_at: [10 mm, 0], direction: %.17g, kind: push, stiffness: 5000 N/m, "
      "rest: 50 mm, friction: 0.5}\n"
      "  one: {between: [frame, floor], from_at: [%.17g, %.17g], to_at: [100 mm, 0], stiffness: 100 N/m, rest: 100 "
      "mm}\n"
      "  two: {between: [frame, floor], from_at: [%.17g, %.17g], to_at: [-100 mm, 0], stiffness: 100 N/m, rest: 100 "
      "mm}\n"
      "members: {other: {upper: frame, lower: hand}}\n",
      by, 0.3 - 0.05 * s, -0.05 + 0.05 * c, by, c * force + s * 0.1, s * force - c * 0.1, right_angle + by,
      right_angle + by, 0.3 + 0.1 * c + 0.1 * s, -0.05 + 0.1 * s - 0.1 * c, 0.3 - 0.1 * c + 0.1 * s,
      -0.05 - 0.1 * s - 0.1 * c);
  return def_of(text);
}

TEST(turned_floor_has_turned_answers) {
  static const double by = 0.7, force = 0.06;
  ZpActuatorDef plain = on_a_body(0, force), turned = on_a_body(by, force);
  const ZpResult *a = answer_of(ZP_STUDY_ACTUATE, &plain), *b = answer_of(ZP_STUDY_ACTUATE, &turned);
  const double x = number(a, "bodies.block.x_m") - 0.3, y = number(a, "bodies.block.y_m") + 0.05;
  const double off = hypot(number(b, "bodies.block.x_m") - 0.3 - cos(by) * x + sin(by) * y,
                           number(b, "bodies.block.y_m") + 0.05 - sin(by) * x - cos(by) * y);
  printf("at %.6g, %.6g m, floor turned by %.3g; off by %.2g m\n", x, y, number(a, "bodies.floor.angle_rad"), off);
  ck_assert_double_gt(x, 1e-3);
  ck_assert_double_gt(fabs(number(a, "bodies.floor.angle_rad")), 1e-3);
  ck_assert_double_lt(off, 1e-9);
}

/* -- a block that jumps ---------------------------------------------------------------------------- */

/* It is lifted and pushed, flies, lands and slides, bounces, and comes to rest: energy balances all the way. */
static ZpSim *jump(ZpActuatorDef *def, double end) {
  ZpSim *sim = data_sim_of(def);
  push(sim, def, "block.force_x", 0.1);
  push(sim, def, "block.force_y", 0.15);
  run_to(sim, 15e-3);
  push(sim, def, "block.force_x", 0);
  push(sim, def, "block.force_y", 0);
  run_to(sim, end);
  return sim;
}

TEST(energy_of_a_jump_balances) {
  ZpActuatorDef def = block_on(0, 0, 0.1);
  def.solver.tolerance = 1e-6;
  ZpSim *sim = jump(&def, 0.1);
  const double work = zp_sim_get(sim, "load_work"), lost = zp_sim_get(sim, "contact_loss"),
               imbalance = zp_sim_get(sim, "energy_imbalance");
  printf("work %.6g, lost %.6g J, imbalance %.2g\n", work, lost, imbalance / work);
  ck_assert_double_gt(lost, 0.1 * work);
  ck_assert_double_lt(fabs(imbalance), 1e-8 * work);
}

/* Second order of fixed steps, with a push that vibrates while it slides. The push changes the bound of friction, so
 * that without this part of the tangent Newton's method would take longer. */
TEST(steps_are_of_second_order) {
  static const double end = 20e-3;
  double x[3];
  for (int k = 0; k < 3; k++) {
    ZpActuatorDef def = block_on(0, 0.08, end);
    def.solver.time_step = 1e-4 / (1 << k);
    ZpSim *sim = data_sim_of(&def);
    push(sim, &def, "block.force_y", 0.04);
    run_to(sim, end);
    x[k] = column_of(sim, &def, "block.x_m");
    const ZpImplicitCounts *counts = &sim->dynamics.stepper.counts;
    const double each = (double)counts->iterations / (double)counts->steps;
    printf("%.3f iterations for a step\n", each);
    ck_assert_double_lt(each,
                        2.01); /* 2 measured: all forces are linear in the unknowns, and the push is not known before */
  }
  const double order = log2((x[0] - x[1]) / (x[1] - x[2]));
  printf("differences %.3g, %.3g m: order %.3f\n", x[0] - x[1], x[1] - x[2], order);
  ck_assert_double_gt(order, 1.9);
  ck_assert_double_lt(order, 2.1);
}

/* A state that is saved while it slides goes on as if it had not been. */
TEST(strain_is_part_of_the_state) {
  ZpActuatorDef def = block_on(0, 0, 1);
  ZpSim *sim = jump(&def, 17e-3), *other = data_sim_of(&def);
  const size_t size = zp_sim_state_size(sim);
  void *bytes = malloc(size);
  zp_sim_save(sim, bytes);
  ck_ok(zp_sim_restore(other, bytes, size, &err));
  run_to(sim, 40e-3), run_to(other, 40e-3);
  ck_assert_double_eq(column_of(sim, &def, "block.x_m"), column_of(other, &def, "block.x_m"));
  ck_assert_double_eq(zp_sim_get(sim, "contact_loss"), zp_sim_get(other, "contact_loss"));
  free(bytes);
}

/* -- rest ------------------------------------------------------------------------------------------ */

/* A floor on a body that turns, and a wall: eq. (34.10). */
static const char touching[] =
    "study: stationary\nmesh.nodes: 13\n"
    "bodies:\n  arm: {moves: plane, mass: 9 g, inertia: 1e-6 kg m2, at: [10 mm, -30 mm], angle: 20 degree}\n"
    "  block: {moves: plane, mass: 5 g, inertia: 1e-6 kg m2, at: [15 mm, -10 mm], angle: -10 degree, force: [3 mN, "
    "0]}\n"
    "springs:\n"
    "  foot: {between: [arm, block], from_at: [1 mm, 2 mm], to_at: [-6 mm, -4 mm], direction: 80 degree, rest: 16 mm, "
    "stiffness: 50 N/m, kind: push, friction: 5}\n"
    "  toe: {between: [arm, block], from_at: [2 mm, 1 mm], to_at: [8 mm, -2 mm], direction: 95 degree, rest: 19 mm, "
    "stiffness: 40 N/m, kind: push, friction: 4}\n"
    "  guide: {between: [frame, arm], from_at: [60 mm, 10 mm], direction: -170 degree, rest: 8 mm, stiffness: 20 N/m}\n"
    "members: {lifts: {upper: frame, lower: arm}}\n";

/* Forces on bodies are minus the derivative of the energy, in any pose in which the faces push each other. */
TEST(forces_are_of_an_energy) {
  static const double by = 1e-6;
  ZpActuatorDef def = def_of(touching);
  ZpModel *model;
  ZpStatics s;
  ck_ok(zp_model_create(&def, &model, &err));
  ck_assert(zp_statics_create(model, false, &s));
  ZpPose pose[3];
  double *f = calloc(s.n, sizeof *f), strain[3] = {0}, off = 0, most = 0;
  zp_plane_drawn(&s.plane, pose);
  pose[1].turn += 0.1, pose[2].turn -= 0.05, pose[2].y -= 0.5e-3, pose[2].x += 1e-3;
  zp_links_add_force(&s.links, 1, pose, pose, f);
  for (size_t b = 1; b < 3; b++)
    for (int way = 0; way < ZP_WAYS; way++) {
      const double unit = way == ZP_WAY_TURNS ? s.plane.length : 1, *found = &f[s.form.inner];
      double energy[2], *at = way == ZP_WAY_ALONG ? &pose[b].x : way == ZP_WAY_UP ? &pose[b].y : &pose[b].turn;
      for (int k = 0; k < 2; k++) {
        *at += (k == 0 ? -by : 2 * by) / unit;
        zp_links_hold(&s.links, pose, strain);
        energy[k] = zp_links_energy(&s.links, pose, strain) + zp_links_weight_energy(&s.links, pose);
      }
      *at -= by / unit;
      const double is = found[s.plane.body[b].unknown[way]];
      off = fmax(off, fabs(is + (energy[1] - energy[0]) / (2 * by)));
      most = fmax(most, fabs(is));
    }
  printf("off by %.2g of %.2g N\n", off, most);
  ck_assert_double_lt(off, 1e-8);
  ck_assert_double_gt(fabs(strain[0]), 1e-5);
  free(f);
  zp_statics_destroy(&s);
  zp_model_destroy(model);
}

/* A pendulum above a floor that it does not touch. */
TEST(lifted_contact_does_not_stick) {
  ZpActuatorDef def =
      def_of("study: stationary\nmesh.nodes: 9\n"
             "bodies:\n  bob: {moves: plane, mass: 7 g, inertia: 3e-6 kg m2, at: [300 mm, -80 mm], force: [3 mN, 0]}\n"
             "  hand: {mass: 2 g}\n"
             "joints: {pin: {type: pin, between: [frame, bob], at: [300 mm, 0]}}\n"
             "springs: {floor: {between: [frame, bob], from_at: [300 mm, -81 mm], direction: 90 degree, kind: push, "
             "stiffness: 5000 N/m, friction: 1}}\n"
             "members: {other: {upper: frame, lower: hand}}\n");
  const double angle = number(answer_of(ZP_STUDY_STATIONARY, &def), "bodies.bob.angle_rad");
  printf("turned by %.6g, off by %.2g\n", angle, angle / atan(3e-3 / (7e-3 * g)) - 1);
  ck_near(angle, atan(3e-3 / (7e-3 * g)), 1e-12);
}

/* The order in which springs and bodies are named. */
TEST(names_do_not_matter) {
  static const char *const order[] = {"one: %s, two: %s", "zwei: %s, eins: %s"};
  static const char foot[] =
      "{between: [frame, block], from_at: [300 mm, 0], to_at: [-10 mm, 0], direction: 90 degree, "
      "kind: push, stiffness: 5000 N/m, friction: 0.5}",
                    toe[] = "{between: [frame, block], from_at: [300 mm, 0], to_at: [12 mm, 1 mm], direction: 95 "
                            "degree, kind: push, stiffness: 4000 N/m, friction: 0.2}";
  double x[2], y[2];
  for (int k = 0; k < 2; k++) {
    char springs[1024], text[2048];
    snprintf(springs, sizeof springs, order[k], k ? toe : foot, k ? foot : toe);
    snprintf(
        text, sizeof text,
        "study: actuate\nmesh.nodes: 9\ndrive.voltage: 0 V\nsolver: {end_time: 50 ms, stop_when_zipped: false}\n"
        "bodies: {block: {moves: plane, mass: 10 g, inertia: 500 g mm2, at: [300 mm, 0], force: [70 mN, 0]}, hand: "
        "{mass: 2 g}}\nsprings: {%s}\nmembers: {other: {upper: frame, lower: hand}}\n",
        springs);
    ZpActuatorDef def = def_of(text);
    const ZpResult *end = answer_of(ZP_STUDY_ACTUATE, &def);
    x[k] = number(end, "bodies.block.x_m"), y[k] = number(end, "bodies.block.y_m");
  }
  printf("at %.9g, %.9g m, off by %.2g, %.2g m\n", x[0], y[0], x[1] - x[0], y[1] - y[0]);
  ck_assert_double_gt(x[0], 0.301);
  ck_assert_double_lt(hypot(x[1] - x[0], y[1] - y[0]), 1e-12);
}

/* -- wrong networks -------------------------------------------------------------------------------- */

#define ARM "bodies: {arm: {moves: plane, mass: 1 g, at: [0, -5 mm]}}\nmembers: {m: {upper: frame, lower: arm}}\n"
static const char *const wrong[][2] = {
    {ARM "springs: {s: {between: [frame, arm], kind: push, friction: 0.5}}\n",
     "springs.s.friction = 0.5: it acts across a direction; give springs.s.direction"},
    {ARM "springs: {s: {between: [frame, arm], direction: 90 degree, friction: 0.5}}\n",
     "springs.s.friction = 0.5: only faces that push each other rub; give springs.s.kind: push"},
    {ARM "springs: {s: {between: [frame, arm], kind: pull, direction: 90 degree, friction: 0.5}}\n",
     "give springs.s.kind: push"},
    {ARM "springs: {s: {between: [frame, arm], kind: push, direction: 90 degree, friction: -0.5}}\n", "0 to 100"},
    {ARM "springs: {s: {between: [frame, arm], kind: push, direction: 200 degree}}\n", "-180 degree to 180 degree"},
    {ARM "springs: {s: {between: [frame, arm], kind: push, direction: up}}\n", "springs.s.direction"},
    {"bodies: {arm: {}}\nmembers: {m: {upper: frame, lower: arm}}\n"
     "springs: {s: {between: [frame, arm], direction: 90 degree}}\n",
     "direction: all bodies move up and down"},
    {"bodies: {arm: {}}\nmembers: {m: {upper: frame, lower: arm}}\n"
     "springs: {s: {between: [frame, arm], kind: push, friction: 0.1}}\n",
     "springs.s.friction"},
};

TESTS(wrong_contacts_are_refused, 0, LENGTH_OF(wrong)) {
  ck_scenario_refused(ZP_STUDY_STATIONARY, wrong[_i][0], wrong[_i][1]);
}
