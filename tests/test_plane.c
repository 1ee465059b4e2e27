/* Networks whose bodies move in the plane: derivatives of their forces, statics of levers and linkages, balance of
 * forces and torques, motion. docs/theory.md, section 34. */
#include "network_util.h"

#include "actuator/model.h"
#include "actuator/plane.h"
#include "rest/statics.h"

static const char all_kinds[] =
    "study: stationary\nmesh.nodes: 13\n"
    "bodies:\n"
    "  base: {mass: 5 g, at: [0, -5 mm]}\n"
    "  arm: {moves: plane, mass: 9 g, inertia: 1e-6 kg m2, at: [10 mm, -30 mm], angle: 20 degree, force: [20 mN, 3 "
    "mN], "
    "torque: 0.3 mN m}\n"
    "  hand: {moves: plane, mass: 3 g, inertia: 1e-6 kg m2, at: [20 mm, -60 mm]}\n"
    "  crank: {moves: plane, mass: 1 g, inertia: 1e-6 kg m2, at: [90 mm, -20 mm]}\n"
    "  bob: {moves: plane, mass: 1 g, inertia: 1e-7 kg m2, at: [100 mm, -60 mm]}\n"
    "joints:\n"
    "  elbow: {type: pin, between: [base, arm], at: [60 mm, -30 mm]}\n"
    "  rail: {type: slide, between: [arm, crank], at: [80 mm, -15 mm]}\n"
    "  bond: {type: weld, between: [hand, bob], at: [60 mm, -60 mm]}\n"
    "springs:\n"
    "  soft: {between: [arm, crank], from_at: [1 mm, 2 mm], to_at: [-3 mm, 4 mm], stiffness: 5 N/m, rest: 60 mm}\n"
    "  rope: {between: [frame, bob], from_at: [100 mm, 0], to_at: [0 mm, 1 mm], stiffness: 5 N/m, rest: 40 mm, kind: "
    "pull}\n"
    "members:\n"
    "  lifts: {upper: frame, lower: base}\n"
    "  leans: {upper: base, lower: arm, upper_at: [5 mm, -2 mm], lower_at: [3 mm, 1 mm], angle: 10 degree}\n"
    "  hangs: {upper: arm, lower: hand, upper_at: [1 mm, -3 mm], lower_at: [2 mm, 2 mm], angle: 5 degree}\n";

/* Eq. (34.4): the way of a point of a body that turns by any angle. */
TEST(points_sweep_their_way) {
  static const ZpVector arm = {0.7, -0.4};
  for (int k = 0; k < 4; k++) {
    const double turns[] = {0, 1e-9, 0.5, 3};
    const ZpPose from = {0.1, 0.2, 0.3}, to = {0.1, 0.2, 0.3 + turns[k]};
    const ZpVector way = zp_difference(zp_pose_point(&to, arm), zp_pose_point(&from, arm)),
                   sweep = zp_times(to.turn - from.turn, zp_pose_sweep(&from, &to, arm));
    ck_assert_double_lt(hypot(way.x - sweep.x, way.y - sweep.y), 1e-15);
  }
}

/* Forces on bodies of about their weight, N. */
static double some(size_t i) {
  return 0.05 * sin(1.0 + 1.7 * (double)i);
}

/* Without joints, and with light bodies, whose platforms have their centres of mass far from their places. */
static const char soft_kinds[] =
    "study: stationary\nmesh.nodes: 13\nplatform.length: 20 mm\nribbon.density: 30000\n"
    "bodies:\n"
    "  arm: {moves: plane, mass: 0.1 g, at: [40 mm, -10 mm], angle: -15 degree, force: [-20 mN, -20 mN], torque: -0.8 "
    "mN m}\n"
    "  hand: {moves: plane, mass: 2 g, at: [0, -25 mm]}\n"
    "springs:\n"
    "  one: {between: [frame, arm], from_at: [90 mm, 10 mm], to_at: [5 mm, 2 mm], stiffness: 20 N/m, rest: 30 mm}\n"
    "  two: {between: [arm, hand], to_at: [10 mm, 1 mm], stiffness: 5 N/m, rest: 20 mm}\n"
    "members:\n"
    "  lifts: {upper: frame, lower: arm, lower_at: [-40 mm, -6 mm]}\n"
    "  hangs: {upper: arm, lower: hand, upper_at: [-35 mm, -3 mm], lower_at: [2 mm, 2 mm], angle: 5 degree}\n";

/* A block that sticks between a floor and a wall on a body that turns, and a spring with a direction. */
static const char touching[] =
    "study: stationary\nmesh.nodes: 13\n"
    "bodies:\n  arm: {moves: plane, mass: 9 g, inertia: 1e-6 kg m2, at: [10 mm, -30 mm], angle: 20 degree}\n"
    "  block: {moves: plane, mass: 5 g, inertia: 1e-6 kg m2, at: [15 mm, -10 mm], angle: -10 degree, force: [3 mN, "
    "0]}\n"
    "springs:\n"
    "  foot: {between: [arm, block], from_at: [1 mm, 2 mm], to_at: [-6 mm, -4 mm], direction: 80 degree, rest: 16 mm, "
    "stiffness: 50 N/m, kind: push, friction: 0.5}\n"
    "  toe: {between: [arm, block], from_at: [2 mm, 1 mm], to_at: [8 mm, -2 mm], direction: 125 degree, rest: 7 mm, "
    "stiffness: 40 N/m, kind: push, friction: 0.3}\n"
    "  guide: {between: [frame, arm], from_at: [60 mm, 10 mm], direction: -170 degree, rest: 40 mm, stiffness: 20 "
    "N/m}\n"
    "members: {lifts: {upper: frame, lower: arm}}\n";

static const char *const derivatives[] = {all_kinds, soft_kinds, touching};

/* The residual at a fraction of a step from a point that is kept. */
static void residual_at(ZpStatics *s, const void *kept, const double *step, double fraction, double *r) {
  ZpStaticSystem system = zp_statics_system(s);
  zp_statics_branch(s, ZP_ALONG_LOAD).restore(s, kept);
  system.residual(s, r, NULL);
  system.move(s, step, fraction);
  system.residual(s, r, NULL);
}

/* Forces on bodies move all by K^-1 times them; residuals change by as much. So also what is soft counts: along a
 * direction of one's own choice the stiffness of edges and joints would hide it. */
TESTS(stiffness_is_the_derivative_of_forces, 0, LENGTH_OF(derivatives)) {
  static const double fraction = 1e-4;
  ZpActuatorDef def = def_of(derivatives[_i]);
  ZpModel *model;
  ZpStatics s;
  ck_ok(zp_model_create(&def, &model, &err));
  ck_assert(zp_statics_create(model, false, &s));
  ck_assert(zp_newton_good(zp_statics_find_rest(&s).end));
  const size_t n = s.n, size = s.n * sizeof(double);
  double *u = calloc(n, sizeof *u), *one = malloc(size), *other = malloc(size);
  char *kept = malloc(zp_statics_branch(&s, ZP_ALONG_LOAD).save_size);
  ck_assert(zp_statics_stable(&s));
  for (size_t i = s.form.inner; i < n; i++)
    u[i] = some(i - s.form.inner);
  zp_arrow_solve(&s.newton.K, u);
  zp_statics_branch(&s, ZP_ALONG_LOAD).save(&s, kept);
  residual_at(&s, kept, u, -fraction, one);
  residual_at(&s, kept, u, fraction, other);
  double off = 0;
  for (size_t i = 0; i < n; i++) {
    const double by = (one[i] - other[i]) / (2 * fraction), is = i < s.form.inner ? 0 : some(i - s.form.inner);
    off = fmax(off, fabs(by - is));
  }
  printf("off by %.2g of %.2g N\n", off, some(0));
  ck_assert_double_lt(off, 1e-4); /* 4.8e-5 and 1.8e-5 measured, of joints of 1e8 N/m and of edges; second order of
                                      the step */
  free(u), free(one), free(other), free(kept);
  zp_statics_destroy(&s);
  zp_model_destroy(model);
}

/* Eq. (34.6): what forces of a member do along the way of nodes and bodies in the drawing is what they do along the way
 * that the member sees, for any turn of its bodies over the span. */
TEST(forces_on_bodies_work_as_on_nodes) {
  ZpActuatorDef def = def_of(soft_kinds);
  ZpModel *model;
  ZpStatics s;
  ck_ok(zp_model_create(&def, &model, &err));
  ck_assert(zp_statics_create(model, false, &s));
  const ZpPlanar *plane = &s.plane;
  const ZpAssembly *a = &s.member[1].assembly;
  const ZpTopology *t = &model[1].topology;
  const size_t size = zp_coordinates(&model[1]), inner = s.form.inner;
  double *nodes[2], *seen[2], *q[2], *force = calloc(size, sizeof *force), *f = calloc(s.n, sizeof *f);
  ZpPose pose[2][3];
  double inside = 0, outside = 0;
  for (size_t end = 0; end < 2; end++) {
    seen[end] = calloc(size, sizeof(double)), nodes[end] = calloc(size, sizeof(double));
    q[end] = calloc(s.n, sizeof(double));
    zp_plane_drawn(plane, pose[end]);
    for (size_t b = 1; b < 3; b++) {
      pose[end][b].x += 0.01 * some(5 + b + 10 * end);
      pose[end][b].turn += 20 * some(b + 10 * end);
    }
    const ZpForces at = zp_forces(&model[1], seen[end]);
    for (size_t j = 0; j < model[1].count; j++) {
      const size_t clip = j / t->ribbons == 0 || j / t->ribbons == t->stations - 1 ? j - j % t->ribbons : j;
      const bool held = j == zp_upper(t, t->platform.first) || j == zp_upper(t, t->platform.last);
      at.x[j] = 0.1 * some(held ? j : clip + 7 + 100 * end);
      at.y[j] = 0.1 * some(held ? j : clip + 8 + 200 * end);
      zp_forces(&model[1], force).x[j] = some(j + 900);
      zp_forces(&model[1], force).y[j] = some(j + 1100);
    }
    zp_plane_put_platform(plane, 1, pose[end], 1, seen[end]);
    memcpy(nodes[end], seen[end], size * sizeof(double));
    zp_plane_to_drawing(plane, 1, pose[end], nodes[end]);
    zp_assembly_gather(a, nodes[end], q[end]);
    zp_plane_gather(plane, inner, pose[end], q[end]);
  }
  for (size_t k = 0; k < size; k++)
    inside += force[k] * (seen[1][k] - seen[0][k]);
  zp_plane_add_force(plane, 1, pose[0], pose[1], inner, seen[0], seen[1], a, force, f);
  for (size_t i = 0; i < s.n; i++)
    outside += f[i] * (q[1][i] - q[0][i]);
  printf("turned by %.3g, %.6g J, off by %.2g\n", pose[1][1].turn - pose[0][1].turn, inside, outside / inside - 1);
  ck_near(outside, inside, 1e-12);
  for (int end = 0; end < 2; end++)
    free(seen[end]), free(nodes[end]), free(q[end]);
  free(force), free(f);
  zp_statics_destroy(&s);
  zp_model_destroy(model);
}

/* -- at rest --------------------------------------------------------------------------------------- */

/* A body that hangs freely on one actuator, against the actuator alone, whose platform turns, too, and stretches. */
TEST(one_body_is_the_load_of_an_actuator) {
  static const char *const names[] = {"pull_in_voltage_V"};
  ZpActuatorDef one = def_of("study: limits\nload.mass: 2 g\nactuator.symmetry: none\nliquid.model: none\n"
                             "platform: {rotates: true, electrode: false}\nmesh.nodes: 41\n"),
                network = def_of("study: limits\nmesh.nodes: 41\n"
                                 "bodies: {hand: {moves: plane, mass: 2 g, inertia: 1e-5 kg m2}}\n"
                                 "members: {only: {upper: frame, lower: hand}}\n");
  const ZpResult *a = answer_of(ZP_STUDY_LIMITS, &one), *b = answer_of(ZP_STUDY_LIMITS, &network);
  for (size_t k = 0; k < LENGTH_OF(names); k++) {
    printf("%s: off by %.2g\n", names[k], number(b, names[k]) / number(a, names[k]) - 1);
    ck_near(number(b, names[k]), number(a, names[k]), 4e-7); /* 1.6e-7 measured */
  }
  const double sways = number(answer_of(ZP_STUDY_MODES, &one), "frequency_1_Hz"),
               sways_too = number(answer_of(ZP_STUDY_MODES, &network), "frequency_2_Hz"); /* the first one turns it */
  printf("sways: off by %.2g\n", sways_too / sways - 1);
  ck_near(sways_too, sways, 1.5e-7);
}

/* A pendulum beside an actuator: its angle under a force to the right and a torque, and the frequency about it. */
TEST(pendulum_swings) {
  ZpActuatorDef def = def_of(
      "study: stationary\nmesh.nodes: 11\n"
      "bodies:\n  bob: {moves: plane, mass: 7 g, inertia: 3e-6 kg m2, at: [300 mm, -80 mm], force: [30 mN, 5 mN]}\n"
      "  hand: {mass: 2 g}\n"
      "joints: {pin: {type: pin, between: [frame, bob], at: [300 mm, 0]}}\n"
      "members: {other: {upper: frame, lower: hand}}\n");
  const double m = 7e-3, I = 3e-6, l = 0.08, Fx = 30e-3, down = m * 9.81 - 5e-3;
  const ZpResult *rest = answer_of(ZP_STUDY_STATIONARY, &def);
  const double angle = atan2(Fx, down), pull = hypot(Fx, down), pi = 3.14159265358979323846;
  printf("angle off by %.2g, x by %.2g\n", number(rest, "bodies.bob.angle_rad") / angle - 1,
         (number(rest, "bodies.bob.x_m") - 0.3) / (l * sin(angle)) - 1);
  ck_near(number(rest, "bodies.bob.angle_rad"), angle, 1e-12);
  ck_near(number(rest, "bodies.bob.x_m") - 0.3, l * sin(angle), 1e-7); /* the pin gives by 1e-9 m */
  const ZpResult *modes = answer_of(ZP_STUDY_MODES, &def);
  const double frequency = sqrt(pull * l / (I + m * l * l)) / (2 * pi);
  double off = 1;
  for (int k = 1; k <= 8; k++) {
    char name[32];
    snprintf(name, sizeof name, "frequency_%d_Hz", k);
    off = fmin(off, fabs(number(modes, name) / frequency - 1));
  }
  printf("frequency off by %.2g\n", off);
  ck_assert_double_lt(off, 1e-6);
}

/* Two bodies that are welded and the member between them, as one rigid body: slow modes on a rail and about a pin,
 * where a soft spring of its rest length holds them, against the mass of all, and against its moment of inertia about
 * the pin. */
static const char one_rigid[] =
    "study: stationary\nmesh.nodes: 21\ngravity: 0\n"
    "bodies:\n  arm: {moves: plane, mass: 2 g, inertia: 1e-6 kg m2, at: [20 mm, -10 mm]}\n"
    "  hand: {moves: plane, mass: 1 g, inertia: 1e-6 kg m2, at: [20 mm, -25 mm]}\n"
    "joints:\n  bond: {type: weld, between: [arm, hand], at: [20 mm, -20 mm]}\n"
    "  leads: {type: %s, between: [frame, arm], at: [-30 mm, -10 mm]}\n"
    "springs: {soft: {between: [frame, arm], from_at: [%s], stiffness: 0.5 N/m, rest: 100 mm}}\n"
    "members: {m: {upper: arm, lower: hand}}\n";

TEST(ribbons_move_with_their_bodies) {
  static const double k = 0.5, lever = 50e-3, pin[] = {-30e-3, -10e-3};
  const double pi = 3.14159265358979323846;
  for (int pinned = 0; pinned < 2; pinned++) {
    char text[1024];
    snprintf(text, sizeof text, one_rigid, pinned ? "pin" : "slide", pinned ? "20 mm, -110 mm" : "120 mm, -10 mm");
    ZpActuatorDef def = def_of(text);
    ZpModel *model;
    ZpStatics s;
    ck_ok(zp_model_create(&def, &model, &err));
    ck_assert(zp_statics_create(model, false, &s));
    ck_assert(zp_newton_good(zp_statics_find_rest(&s).end));
    double mass = 3e-3, inertia = 2e-6;
    inertia += 2e-3 * 50e-3 * 50e-3 + 1e-3 * (50e-3 * 50e-3 + 15e-3 * 15e-3);
    const ZpNodes at = zp_nodes(model, s.member[0].q);
    for (size_t j = 0; j < model->count; j++) {
      const ZpVector node = zp_stand_outside(&s.plane.stand[0], s.pose, (ZpVector){at.x[j], at.y[j]});
      mass += model->mass[j];
      inertia += model->mass[j] * ((node.x - pin[0]) * (node.x - pin[0]) + (node.y - pin[1]) * (node.y - pin[1]));
    }
    zp_statics_destroy(&s);
    zp_model_destroy(model);
    const double is = sqrt(pinned ? k * lever * lever / inertia : k / mass) / (2 * pi),
                 found = number(answer_of(ZP_STUDY_MODES, &def), "frequency_1_Hz");
    printf("%s: %.6g Hz, off by %.2g\n", pinned ? "about a pin" : "on a rail", found, found / is - 1);
    ck_near(found, is, 4e-5); /* 1.3e-5 measured: ribbons bend */
  }
}

/* A crank, a coupler and a rocker that an actuator moves, against the closed kinematics of the four-bar linkage. */
TEST(four_bars_close) {
  ZpActuatorDef def = def_of(
      "study: stationary\nmesh.nodes: 21\n"
      "bodies:\n  crank: {moves: plane, mass: 4 g, inertia: 1e-6 kg m2, at: [0, -20 mm]}\n"
      "  coupler: {moves: plane, mass: 2 g, inertia: 1e-6 kg m2, at: [60 mm, -10 mm]}\n"
      "  rocker: {moves: plane, mass: 2 g, inertia: 1e-6 kg m2, at: [120 mm, -30 mm]}\n"
      "joints:\n  a: {between: [frame, crank], at: [-60 mm, -20 mm]}\n  b: {between: [crank, coupler], at: [10 mm, -15 "
      "mm]}\n"
      "  c: {between: [coupler, rocker], at: [110 mm, -5 mm]}\n  d: {between: [rocker, frame], at: [125 mm, -60 mm]}\n"
      "members: {lifts: {upper: frame, lower: crank}}\n");
  const double A[] = {-0.06, -0.02}, B[] = {0.01, -0.015}, C[] = {0.11, -0.005}, D[] = {0.125, -0.06};
  const ZpResult *rest = answer_of(ZP_STUDY_STATIONARY, &def);
  const double turns = number(rest, "bodies.crank.angle_rad"), c = cos(turns), s = sin(turns);
  const double b[] = {A[0] + c * (B[0] - A[0]) - s * (B[1] - A[1]), A[1] + s * (B[0] - A[0]) + c * (B[1] - A[1])};
  const double bc = hypot(C[0] - B[0], C[1] - B[1]), cd = hypot(D[0] - C[0], D[1] - C[1]),
               bd = hypot(D[0] - b[0], D[1] - b[1]), a = (bc * bc - cd * cd + bd * bd) / (2 * bd),
               h = sqrt(bc * bc - a * a);
  const double to_c[] = {b[0] + (a * (D[0] - b[0]) - h * (D[1] - b[1])) / bd,
                         b[1] + (a * (D[1] - b[1]) + h * (D[0] - b[0])) / bd};
  const double coupler = atan2(to_c[1] - b[1], to_c[0] - b[0]) - atan2(C[1] - B[1], C[0] - B[0]),
               rocker = atan2(to_c[1] - D[1], to_c[0] - D[0]) - atan2(C[1] - D[1], C[0] - D[0]);
  printf("crank %.6g, coupler %.9g off by %.2g, rocker %.9g off by %.2g\n", turns, coupler,
         number(rest, "bodies.coupler.angle_rad") - coupler, rocker, number(rest, "bodies.rocker.angle_rad") - rocker);
  ck_assert_double_gt(fabs(turns), 0.05);
  ck_assert_double_lt(fabs(number(rest, "bodies.coupler.angle_rad") - coupler), 1.5e-8); /* pins give by 1e-9 m */
  ck_assert_double_lt(fabs(number(rest, "bodies.rocker.angle_rad") - rocker), 1.5e-8);
}

/* Stiffness of a weightless actuator where it is nearly closed: of its opening, N/m, and of its platform's turn, N m.
 */
typedef struct Stiffness {
  double opens, turns;
} Stiffness;

static Stiffness stiffness_of(double width) {
  static const double force = 1e-6, offset = 4e-3;
  char text[512];
  snprintf(text, sizeof text,
           "study: stationary\nmesh.nodes: 31\nribbon: {density: 0, width: %g}\ngravity: 0\nactuator.symmetry: none\n"
           "platform: {rotates: true, electrode: false}\nliquid.model: none\nload: {mass: 0, force: %g, offset: %g}\n",
           width, force, offset);
  ZpActuatorDef def = def_of(text);
  const ZpResult *rest = answer_of(ZP_STUDY_STATIONARY, &def);
  return (Stiffness){force / number(rest, "opening_m"), -force * offset / number(rest, "angle_rad")};
}

/* A beam on a pin that a force turns against two actuators, one twice as far from the pin. */
TEST(lever_balances) {
  ZpActuatorDef def =
      def_of("study: stationary\nmesh.nodes: 31\nribbon.density: 0\ngravity: 0\n"
             "bodies: {beam: {moves: plane, at: [50 mm, 0], force: [0, -4 uN]}}\n"
             "joints: {pivot: {between: [frame, beam], at: [0, 0]}}\n"
             "members:\n  near: {upper: frame, lower: beam, upper_at: [100 mm, 0], lower_at: [50 mm, 0], ribbon.width: "
             "20 mm}\n"
             "  far: {upper: frame, lower: beam, upper_at: [200 mm, 0], lower_at: [150 mm, 0], ribbon.width: 10 mm}\n");
  const Stiffness near = stiffness_of(20e-3), far = stiffness_of(10e-3);
  const double against = near.opens * 0.1 * 0.1 + near.turns + far.opens * 0.2 * 0.2 + far.turns;
  const double turns = number(answer_of(ZP_STUDY_STATIONARY, &def), "bodies.beam.angle_rad");
  printf("turned by %.6g, off by %.2g; turns of platforms make %.2g of it\n", turns, turns * against / -2e-7 - 1,
         (near.turns + far.turns) / against);
  ck_near(turns, -4e-6 * 0.05 / against, 7e-7);
}

/* A beam that is welded to the frame: how far a force and a torque bend the joint, which is as stiff as the stiffest
 * edge, and as that times the square of the flexible length in torsion. */
TEST(joints_give) {
  ZpActuatorDef def = def_of(
      "study: stationary\nmesh.nodes: 21\ngravity: 0\n"
      "bodies:\n  beam: {moves: plane, at: [60 mm, -5 mm], force: [3 N, 5 N], torque: 1 N m}\n  hand: {mass: 2 g}\n"
      "joints: {bond: {type: weld, between: [frame, beam], at: [40 mm, -5 mm]}}\n"
      "members:\n  stiff: {upper: frame, lower: hand, upper_at: [300 mm, 0], lower_at: [300 mm, 0], ribbon.width: 20 "
      "mm}\n  other: {upper: frame, lower: hand, ribbon.width: 10 mm}\n");
  ZpModel *model;
  ck_ok(zp_model_create(&def, &model, &err));
  const double k = model->axial_stiffness, L = model->L;
  zp_model_destroy(model);
  const ZpResult *rest = answer_of(ZP_STUDY_STATIONARY, &def);
  const double turns = number(rest, "bodies.beam.angle_rad"), x = number(rest, "bodies.beam.x_m") - 0.06,
               y = number(rest, "bodies.beam.y_m") + 0.005, torque = 1 + 5 * 0.02;
  printf("turned by %.6g, off by %.2g; moved by %.6g and %.6g, off by %.2g and %.2g\n", turns,
         turns * k * L * L / torque - 1, x, y, x * k / 3 - 1, (y - 0.02 * turns) * k / 5 - 1);
  ck_near(turns, torque / (k * L * L), 1e-6);
  ck_near(x, 3 / k, 2e-5); /* second order of the turn */
  ck_near(y - 0.02 * turns, 5 / k, 3e-9);
}

/* A spring, against the constant force and torque that it has become: on a light body, whose platforms have its centre
 * of mass far from its place. */
static const char sprung[] =
    "study: stationary\nmesh.nodes: 13\n"
    "bodies: {arm: {moves: plane, mass: 0.1 g, at: [40 mm, -10 mm], angle: %s, torque: -1 mN m%s}}\n%s"
    "members: {lifts: {upper: frame, lower: arm, lower_at: [%s]}}\n";

TEST(spring_is_a_force_at_its_point) {
  static const double from[] = {90e-3, 10e-3}, to[] = {5e-3, 2e-3}, stiffness = 20, rest = 30e-3;
  char text[2][1024], push[256];
  snprintf(text[0], sizeof text[0], sprung, "30 degree", "",
           "springs: {s: {between: [frame, arm], from_at: [90 mm, 10 mm], to_at: [5 mm, 2 mm], stiffness: 20 N/m, "
           "rest: 30 mm}}\n",
           "-35 mm, 20 mm");
  ZpActuatorDef a = def_of(text[0]);
  const ZpResult *one = answer_of(ZP_STUDY_STATIONARY, &a);
  const double x = number(one, "bodies.arm.x_m"), y = number(one, "bodies.arm.y_m"),
               turn = number(one, "bodies.arm.angle_rad");
  const double arm[] = {cos(turn) * to[0] - sin(turn) * to[1], sin(turn) * to[0] + cos(turn) * to[1]};
  const double apart[] = {from[0] - x - arm[0], from[1] - y - arm[1]}, length = hypot(apart[0], apart[1]),
               pull = stiffness * (length - rest) / length, force[] = {pull * apart[0], pull * apart[1]};
  snprintf(push, sizeof push, "%.17g, force: [%.17g, %.17g]", -1e-3 + arm[0] * force[1] - arm[1] * force[0], force[0],
           force[1]);
  snprintf(text[1], sizeof text[1], sprung, "30 degree", "", "", "-35 mm, 20 mm");
  char *torque = strstr(text[1], "-1 mN m"), after[1024];
  snprintf(after, sizeof after, "%s", torque + strlen("-1 mN m"));
  snprintf(torque, sizeof text[1] - (size_t)(torque - text[1]), "%s%s", push, after);
  ZpActuatorDef b = def_of(text[1]);
  const ZpResult *other = answer_of(ZP_STUDY_STATIONARY, &b);
  printf("at %.6g, %.6g, turned to %.6g; off by %.2g, %.2g, %.2g\n", x, y, turn, number(other, "bodies.arm.x_m") - x,
         number(other, "bodies.arm.y_m") - y, number(other, "bodies.arm.angle_rad") - turn);
  ck_assert_double_lt(fabs(number(other, "bodies.arm.x_m") - x), 1e-10);
  ck_assert_double_lt(fabs(number(other, "bodies.arm.y_m") - y), 1e-10);
  ck_assert_double_lt(fabs(number(other, "bodies.arm.angle_rad") - turn), 1e-8);
}

/* -- two ways --------------------------------------------------------------------------------------- */

/* Without gravity the whole drawing may be turned: bodies then turn as much, and openings stay. */
static const char turnable[] =
    "mesh.nodes: 15\ngravity: 0\ndrive.voltage: 3 kV\nsolver: {end_time: 20 ms, stop_when_zipped: false}\n"
    "bodies:\n"
    "  arm: {moves: plane, mass: 4 g, inertia: 1e-6 kg m2, at: [%.17g, %.17g], angle: %.17g, force: [%.17g, %.17g]}\n"
    "  hand: {moves: plane, mass: 3 g, inertia: 2e-6 kg m2, at: [%.17g, %.17g], angle: %.17g, force: [%.17g, %.17g]}\n"
    "  crank: {moves: plane, mass: 1 g, inertia: 1e-6 kg m2, at: [%.17g, %.17g], angle: %.17g}\n"
    "joints:\n  rail: {type: slide, between: [arm, crank], at: [%.17g, %.17g]}\n"
    "  pin: {type: pin, between: [frame, arm], at: [%.17g, %.17g]}\n"
    "springs:\n  soft: {between: [frame, crank], from_at: [%.17g, %.17g], to_at: [1 mm, 2 mm], stiffness: 5 N/m, "
    "rest: 30 mm}\n"
    "members:\n  upper: {upper: frame, lower: arm, upper_at: [%.17g, %.17g], lower_at: [2 mm, 1 mm], angle: %.17g}\n"
    "  lower: {upper: arm, lower: hand, lower_at: [0, 1 mm], angle: %.17g}\n";

typedef struct Place {
  double x, y;
} Place;

static Place turned(double by, double x, double y) {
  return (Place){cos(by) * x - sin(by) * y, sin(by) * x + cos(by) * y};
}

static ZpActuatorDef turned_by(double by) {
  char text[4096];
  const Place arm = turned(by, 2e-3, -8e-3), hand = turned(by, 1e-3, -20e-3), crank = turned(by, 40e-3, -10e-3),
              pull = turned(by, 5e-3, -60e-3), push = turned(by, 2e-3, -20e-3), rail = turned(by, 30e-3, -9e-3),
              pin = turned(by, -50e-3, -9e-3), soft = turned(by, 70e-3, 3e-3), upper = turned(by, 4e-3, 0);
  snprintf(text, sizeof text, turnable, arm.x, arm.y, by, pull.x, pull.y, hand.x, hand.y, by, push.x, push.y, crank.x,
           crank.y, by, rail.x, rail.y, pin.x, pin.y, soft.x, soft.y, upper.x, upper.y, by, by);
  return def_of(text);
}

TEST(turned_drawing_has_turned_answers) {
  static const char *const bodies[] = {"arm", "hand", "crank"};
  static const double by = 0.7;
  ZpActuatorDef plain = turned_by(0), other = turned_by(by);
  for (int motion = 0; motion < 2; motion++) {
    const ZpStudy study = motion ? ZP_STUDY_ACTUATE : ZP_STUDY_STATIONARY;
    const ZpResult *a = answer_of(study, &plain), *b = answer_of(study, &other);
    double off = 0;
    for (size_t k = 0; k < LENGTH_OF(bodies); k++) {
      char x[64], y[64], angle[64];
      snprintf(x, sizeof x, "bodies.%s.x_m", bodies[k]);
      snprintf(y, sizeof y, "bodies.%s.y_m", bodies[k]);
      snprintf(angle, sizeof angle, "bodies.%s.angle_rad", bodies[k]);
      const Place at = turned(by, number(a, x), number(a, y));
      off = fmax(off, hypot(number(b, x) - at.x, number(b, y) - at.y));
      off = fmax(off, 0.01 * fabs(number(b, angle) - number(a, angle) - by));
    }
    off = fmax(off, fabs(number(b, "members.lower.opening_m") - number(a, "members.lower.opening_m")));
    printf("%s: off by %.2g m, arm turned by %.3g\n", motion ? "in motion" : "at rest", off,
           number(a, "bodies.arm.angle_rad"));
    ck_assert_double_lt(off, motion ? 1e-10 : 1e-12);
  }
}

#define RUNS "mesh.nodes: 13\ndrive.voltage: 5 kV\nsolver: {end_time: 30 ms, stop_when_zipped: false}\n"
#define ON_RAIL                                                                                                        \
  RUNS                                                                                                                 \
      "bodies:\n  top: {%s at: [0, -6 mm]}\n  hand: {moves: plane, mass: 3 g, inertia: 1e-6 kg m2, at: [0, -12 mm]}\n" \
      "members:\n  one: {upper: frame, lower: top}\n  two: {upper: top, lower: hand}\n"

/* A body that moves up and down, against one that slides on a vertical rail: of the frame, turned by 90 degree. */
TEST(rail_leads_up_and_down) {
  char free[1024], led[1024];
  snprintf(free, sizeof free, ON_RAIL, "mass: 4 g,");
  snprintf(led, sizeof led, ON_RAIL "joints: {rail: {type: slide, between: [top, mast], at: [0, 0]}}\n",
           "moves: plane, mass: 4 g, inertia: 1e-5 kg m2, angle: 90 degree,");
  char *bodies = strstr(led, "bodies:\n") + 8, rest[1024];
  snprintf(rest, sizeof rest, "%s", bodies);
  snprintf(bodies, sizeof led - (size_t)(bodies - led), "  mast: {moves: none}\n%s", rest);
  ZpActuatorDef a = def_of(free), b = def_of(led);
  const ZpResult *one = answer_of(ZP_STUDY_STATIONARY, &a), *other = answer_of(ZP_STUDY_STATIONARY, &b);
  printf("at rest off by %.2g\n", number(other, "bodies.hand.y_m") / number(one, "bodies.hand.y_m") - 1);
  ck_near(number(other, "bodies.hand.y_m"), number(one, "bodies.hand.y_m"), 1e-12);
  a.solver.tolerance = b.solver.tolerance = 1e-6; /* their steps differ */
  one = answer_of(ZP_STUDY_ACTUATE, &a), other = answer_of(ZP_STUDY_ACTUATE, &b);
  printf("in motion off by %.2g\n", number(other, "bodies.hand.y_m") / number(one, "bodies.hand.y_m") - 1);
  ck_near(number(other, "bodies.hand.y_m"), number(one, "bodies.hand.y_m"), 3e-7);
}

/* The number `name` of two networks that should have the same, at rest or at the end of their motion. */
static void both_answers(bool motion, const ZpActuatorDef *one, const ZpActuatorDef *other, const char *name, double *a,
                         double *b) {
  const ZpStudy study = motion ? ZP_STUDY_ACTUATE : ZP_STUDY_STATIONARY;
  *a = number(answer_of(study, one), name);
  *b = number(answer_of(study, other), name);
  printf("%s: %.9g, off by %.2g\n", motion ? "in motion" : "at rest", *b, *a / *b - 1);
}

/* Two bodies that are welded, against one with the mass, the inertia and the centre of both. */
TEST(welded_bodies_are_one) {
  ZpActuatorDef two = def_of(RUNS "bodies:\n"
                                  "  base: {moves: plane, mass: 4 g, inertia: 1e-6 kg m2, at: [10 mm, -8 mm]}\n"
                                  "  tip: {moves: plane, mass: 2 g, inertia: 2e-6 kg m2, at: [40 mm, -23 mm]}\n"
                                  "joints: {bond: {type: weld, between: [base, tip], at: [20 mm, -20 mm]},\n"
                                  "  pin: {between: [frame, base], at: [-50 mm, -8 mm]}}\n"
                                  "members: {lifts: {upper: frame, lower: base, lower_at: [-10 mm, 0]}}\n"),
                one = def_of(RUNS
                             "bodies:\n  base: {moves: plane, mass: 6 g, inertia: 4.5e-6 kg m2, at: [20 mm, -13 mm]}\n"
                             "joints: {pin: {between: [frame, base], at: [-50 mm, -8 mm]}}\n"
                             "members: {lifts: {upper: frame, lower: base, lower_at: [-20 mm, 5 mm]}}\n");
  for (int motion = 0; motion < 2; motion++) {
    double a, b;
    both_answers(motion, &two, &one, "bodies.base.angle_rad", &a, &b);
    ck_near(a, b, motion ? 1.5e-6 : 1e-9);
  }
}

/* A member whose lower body is led by a rail, against one whose upper body it is, which stands on its head: its frame
 * and the ribbons move with the body. No body turns: clips are level in the frame of the upper one. The slope at lower
 * platforms has other errors of the mesh than that at upper ones. */
#define ON_HEAD                                                                                                        \
  "gravity: 0\nribbon.density: 30000\nmesh.nodes: 41\ndrive.voltage: 5 kV\n"                                           \
  "solver: {end_time: 30 ms, stop_when_zipped: false}\n"                                                               \
  "bodies: {arm: {moves: plane, mass: 1 g, inertia: 1e-6 kg m2, at: [1 mm, -12 mm], angle: 70 degree, force: [0, "     \
  "-30 mN]}}\n"                                                                                                        \
  "joints: {rail: {type: slide, between: [arm, frame], at: [0, 0]}}\nmembers: {m: {%s}}\n"

TEST(member_stands_on_either_body) {
  char text[2][1024];
  snprintf(text[0], sizeof text[0], ON_HEAD, "upper: frame, lower: arm");
  snprintf(text[1], sizeof text[1], ON_HEAD, "upper: arm, lower: frame, angle: 180 degree");
  ZpActuatorDef a = def_of(text[0]), b = def_of(text[1]);
  for (int motion = 0; motion < 2; motion++) {
    double one, other;
    both_answers(motion, &b, &a, "bodies.arm.y_m", &other, &one);
    ck_near(other, one, motion ? 2e-4 : 1e-8);
  }
  const ZpResult *one = answer_of(ZP_STUDY_MODES, &a), *other = answer_of(ZP_STUDY_MODES, &b);
  for (int k = 1; k <= 2; k++) {
    char name[32];
    snprintf(name, sizeof name, "frequency_%d_Hz", k);
    printf("%s: %.6g, off by %.2g\n", name, number(one, name), number(other, name) / number(one, name) - 1);
    ck_near(number(other, name), number(one, name), 4e-3); /* 5e-5 and 1.2e-3 measured */
  }
}

/* A member that hangs on two welded bodies, against one that hangs on one with the mass, the inertia and the centre of
 * both: its frame has another centre to turn about. */
#define HANGS "hand: {moves: plane, mass: 3 g, inertia: 1e-6 kg m2, at: [30 mm, -35 mm]}\n"

TEST(member_hangs_on_welded_bodies) {
  ZpActuatorDef two = def_of(RUNS "ribbon.density: 30000\nbodies:\n"
                                  "  base: {moves: plane, mass: 4 g, inertia: 1e-6 kg m2, at: [10 mm, -8 mm]}\n"
                                  "  tip: {moves: plane, mass: 2 g, inertia: 2e-6 kg m2, at: [40 mm, -23 mm]}\n  " HANGS
                                  "joints: {bond: {type: weld, between: [base, tip], at: [20 mm, -20 mm]},\n"
                                  "  pin: {between: [frame, base], at: [-50 mm, -8 mm]}}\n"
                                  "members: {lifts: {upper: frame, lower: base, lower_at: [-10 mm, 0]},\n"
                                  "  hangs: {upper: tip, lower: hand, upper_at: [-10 mm, 3 mm]}}\n"),
                one = def_of(RUNS
                             "ribbon.density: 30000\n"
                             "bodies:\n  base: {moves: plane, mass: 6 g, inertia: 4.5e-6 kg m2, at: [20 mm, -13 mm]}\n"
                             "  " HANGS "joints: {pin: {between: [frame, base], at: [-50 mm, -8 mm]}}\n"
                             "members: {lifts: {upper: frame, lower: base, lower_at: [-20 mm, 5 mm]},\n"
                             "  hangs: {upper: base, lower: hand, upper_at: [10 mm, -7 mm]}}\n");
  const ZpResult *a = answer_of(ZP_STUDY_MODES, &two), *b = answer_of(ZP_STUDY_MODES, &one);
  for (int k = 1; k <= 5; k++) {
    char name[32];
    snprintf(name, sizeof name, "frequency_%d_Hz", k);
    printf("%s: %.6g, off by %.2g\n", name, number(b, name), number(a, name) / number(b, name) - 1);
    ck_near(number(a, name), number(b, name), 7e-7);
  }
}

/* -- energy ---------------------------------------------------------------------------------------- */

static const struct {
  const char *name, *text;
  double most; /* measured */
} conserves[] = {
    {"all kinds", all_kinds, 3.1e-7},
    {"pin",
     RUNS "bodies: {arm: {moves: plane, mass: 9 g, inertia: 1e-5 kg m2, at: [0, -5 mm]}}\n"
          "joints: {p: {between: [frame, arm], at: [60 mm, -5 mm]}}\nmembers: {m: {upper: frame, lower: arm}}\n",
     6.6e-10},
    {"on a body that turns",
     RUNS "bodies:\n  arm: {moves: plane, mass: 3 g, inertia: 1e-6 kg m2, at: [0, -5 mm], torque: 0.2 mN m}\n"
          "  hand: {moves: plane, mass: 4 g, inertia: 1e-6 kg m2, at: [0, -10 mm], force: [10 mN, 2 mN]}\n"
          "members:\n  m: {upper: frame, lower: arm}\n  n: {upper: arm, lower: hand, upper_at: [0, -1 mm]}\n",
     9e-9},
    {"slide",
     RUNS "bodies:\n  arm: {moves: plane, mass: 9 g, inertia: 1e-5 kg m2, at: [0, -5 mm], angle: 20 degree}\n"
          "  bob: {moves: plane, mass: 2 g, inertia: 1e-6 kg m2, at: [10 mm, -20 mm]}\n"
          "joints: {p: {type: slide, between: [arm, bob], at: [10 mm, -15 mm]}}\n"
          "springs: {s: {between: [arm, bob], to_at: [-3 mm, 1 mm], stiffness: 20 N/m, rest: 10 mm}}\n"
          "members: {m: {upper: frame, lower: arm}}\n",
     1.1e-8},
    {"rope that gets taut",
     RUNS
     "bodies: {arm: {moves: plane, mass: 9 g, inertia: 1e-5 kg m2, at: [0, -5 mm]}}\n"
     "joints: {p: {between: [frame, arm], at: [60 mm, -5 mm]}}\n"
     "springs: {rope: {between: [frame, arm], from_at: [0, -60 mm], stiffness: 20 N/m, rest: 41.75 mm, kind: pull}}\n"
     "members: {m: {upper: frame, lower: arm}}\n",
     8.4e-10},
    {"far from its centre",
     RUNS "platform.length: 20 mm\nsolver.tolerance: 1e-2\n"
          "bodies:\n  arm: {moves: plane, mass: 0.1 g, inertia: 1e-8 kg m2, at: [30 mm, -8 mm], force: [10 mN, 5 mN], "
          "torque: -0.3 mN m}\n  hand: {moves: plane, mass: 3 g, inertia: 1e-6 kg m2, at: [0, -14 mm]}\n"
          "springs:\n  s: {between: [frame, arm], from_at: [60 mm, 0], stiffness: 5 N/m, rest: 20 mm}\n"
          "  rope: {between: [frame, hand], from_at: [0, -60 mm], stiffness: 5 N/m, rest: 48 mm, kind: pull}\n"
          "members:\n  m: {upper: frame, lower: arm, lower_at: [-30 mm, 1 mm]}\n"
          "  n: {upper: arm, lower: hand, upper_at: [-30 mm, -1 mm]}\n",
     2.6e-6},
};

TESTS(energy_is_conserved, 0, LENGTH_OF(conserves)) {
  ZpActuatorDef def = def_of(conserves[_i].text);
  def.drive.voltage = 5e3;
  def.solver.end_time = 0.03;
  def.solver.stop_when_zipped = ZP_WHEN_FALSE;
  const double error = number(answer_of(ZP_STUDY_ACTUATE, &def), "energy_error");
  printf("%s: %.3g\n", conserves[_i].name, error);
  ck_assert_double_lt(fabs(error), 3 * conserves[_i].most);
}

/* -- inputs ---------------------------------------------------------------------------------------- */

/* The work of forces that a program sets on a body is booked, beside that of its own force and torque. */
static const struct {
  const char *body, *inputs[4];
} set_by_hand[] = {
    {"solver.tolerance: 1e-6\nbodies: {arm: {moves: plane, mass: 9 g, inertia: 1e-5 kg m2, at: [0, -5 mm], force: [5 "
     "mN, "
     "-3 mN], torque: 0.2 mN m}}\n"
     "joints: {p: {between: [frame, arm], at: [60 mm, -5 mm]}}\nmembers: {m: {upper: frame, lower: arm}}\n",
     {"voltage", "arm.force_x", "arm.force_y", "arm.torque"}},
    {"solver.tolerance: 1e-6\nbodies: {arm: {mass: 9 g, force: [0, -3 mN]}}\nmembers: {m: {upper: frame, lower: "
     "arm}}\n",
     {"voltage", "arm.force_y"}},
};

TESTS(forces_by_hand_are_booked, 0, LENGTH_OF(set_by_hand)) {
  static const double value[] = {0, 20e-3, 30e-3, 1e-3};
  const char *const *inputs = set_by_hand[_i].inputs;
  char name[ZP_INPUT_NAME_SIZE], text[512];
  snprintf(text, sizeof text, "mesh.nodes: 13\ndrive.voltage: 0 V\n%s", set_by_hand[_i].body);
  ZpActuatorDef a = def_of(text);
  int count = 0;
  for (int input = zp_def_input_next(&a, -1); input >= 0; input = zp_def_input_next(&a, input), count++) {
    ck_assert_int_lt(count, 4);
    ck_assert_str_eq(zp_def_input_name(&a, input, name), inputs[count]);
    ck_assert_int_eq(zp_def_input_find(&a, name), input);
  }
  ck_assert(count == 4 || !inputs[count]);
  ZpSim *sim = data_sim_of(&a);
  for (int k = 1; k < count; k++)
    ck_ok(zp_sim_set_input(sim, (ZpInput)zp_def_input_find(&a, inputs[k]), value[k], 0, &err));
  ck_says(zp_sim_set_input(sim, (ZpInput)zp_def_input_find(&a, inputs[count - 1]), 2e4, 0, &err), ZP_BAD_INPUT,
          inputs[count - 1]);
  ck_says(zp_sim_set_input(sim, (ZpInput)1000, 0, 0, &err), ZP_BAD_INPUT, "there is no such input");
  ZpRunInfo *info = zp_run_info_create();
  zp_sim_run(sim, 0.02, false, NULL, info);
  /* at rest at the start: the energy of motion, bending and weight is their work */
  const double work = zp_sim_get(sim, "load_work"), imbalance = zp_sim_get(sim, "energy_imbalance");
  printf("work %.6g J, imbalance %.2g J\n", work, imbalance);
  ck_assert_double_gt(work, 5e-7);
  ck_assert_double_lt(fabs(imbalance), 1e-8 * work);
  zp_run_info_destroy(info);
}

/* Heavy bodies, which actuators do not hold: forces and a torque that rise until they end at the bound of their range,
 * against the way that they give. */
TEST(ramps_move_heavy_bodies) {
  static const double rate = 1e6, most = 1e4, end = 0.02;
  static const struct {
    const char *input, *column;
    double mass;
  } of[] = {{"block.force_x", "block.x_m", 1000},
            {"block.torque", "block.angle_rad", 1000},
            {"hand.force_y", "hand.y_m", -500}};
  ZpActuatorDef def = def_of(
      "mesh.nodes: 9\ndrive.voltage: 0 V\ngravity: 0\n"
      "bodies:\n  block: {moves: plane, mass: 1000 kg, inertia: 1000 kg m2, at: [0, -20 mm], force: [0, -20 mN]}\n"
      "  hand: {mass: 500 kg, at: [200 mm, -20 mm], force: [0, -20 mN]}\n"
      "members:\n  m: {upper: frame, lower: block}\n"
      "  n: {upper: frame, lower: hand, upper_at: [200 mm, 0]}\n");
  const double rises = most / rate, stays = end - rises;
  ZpSim *sim = data_sim_of(&def);
  double before[LENGTH_OF(of)], off = 0;
  for (size_t k = 0; k < LENGTH_OF(of); k++) {
    before[k] = column_of(sim, &def, of[k].column);
    ck_ok(zp_sim_set_input_named(sim, of[k].input, 0, of[k].mass > 0 ? rate : -rate, &err));
  }
  ZpRunInfo *info = zp_run_info_create();
  zp_sim_run(sim, end, false, NULL, info);
  for (size_t k = 0; k < LENGTH_OF(of); k++) {
    const double way = most / of[k].mass * (rises * rises / 6 + 0.5 * rises * stays + 0.5 * stays * stays),
                 gone = column_of(sim, &def, of[k].column) - before[k];
    printf("%s: %.6g, off by %.2g\n", of[k].column, gone, gone / way - 1);
    off = fmax(off, fabs(gone / way - 1));
  }
  ck_assert_double_lt(off, 6e-4); /* 2.3e-4 measured: steps, which momentum does not depend on */
  const double impulse = most * (0.5 * rises + stays),
               energy = 0.5 * impulse * impulse * (1.0 / 1000 + 1.0 / 1000 + 1.0 / 500);
  printf("kinetic energy off by %.2g\n", zp_sim_get(sim, "kinetic_energy") / energy - 1);
  ck_near(zp_sim_get(sim, "kinetic_energy"), energy, 6e-5); /* 1.8e-5 measured: ribbons */
  zp_run_info_destroy(info);
}

/* Numbers of members and bodies have their names without units. */
TEST(numbers_of_parts_have_names) {
  static const char *const of[] = {"bodies: {arm: {moves: plane, mass: 9 g, inertia: 1e-5 kg m2, at: [0, -5 "
                                   "mm]}}\nmembers: {a: {upper: frame, lower: "
                                   "arm}, b: {upper: frame, lower: arm}}\n",
                                   "bodies: {hand: {mass: 9 g}}\nmembers: {a: {upper: frame, lower: hand}}\n",
                                   "stack.series: 3\n", "stack.parallel: 2\nmember_2.ribbon.thickness: 60 um\n",
                                   "load.mass: 8 g\n"};
  static const size_t more[] = {2 * 3 + 3, 3 + 1, 3, 2 * 2, 0};
  for (size_t k = 0; k < LENGTH_OF(of); k++) {
    char text[512], name[64];
    snprintf(text, sizeof text, "mesh.nodes: 9\nliquid.model: none\n%s", of[k]);
    ZpActuatorDef def = def_of(text);
    ZpSim *sim = data_sim_of(&def);
    ZpRunInfo *info = zp_run_info_create();
    zp_sim_step(sim, 2e-3, NULL, info);
    ZpTable *table = zp_signal_table(&def, 1);
    size_t signals;
    zp_signal_columns(&signals);
    ck_assert(zp_table_columns(table) == signals + more[k]);
    for (size_t c = signals; c < zp_table_columns(table); c++) {
      const ZpColumn *column = zp_table_column(table, c);
      snprintf(name, sizeof name, "%.*s", (int)(strlen(column->name) - strlen(column->unit) - 1), column->name);
      printf("%s %.6g\n", name, zp_sim_get(sim, name));
      ck_assert_double_eq(zp_sim_get(sim, name), column_of(sim, &def, column->name));
    }
    ck_assert(isnan(zp_sim_get(sim, "nobody.opening")) && isnan(zp_sim_get(sim, "a.")) &&
              isnan(zp_sim_get(sim, "a.zipped")));
    zp_table_destroy(table);
    zp_run_info_destroy(info);
  }
}

/* Of two members on one port, a third one with a controller, a body that moves up and down, one in the plane. */
TEST(inputs_have_names_and_units) {
  static const struct {
    const char *name, *unit;
  } of[] = {{"voltage", "V"},     {"left.voltage", "V"}, {"follows.setpoint", "1"}, {"arm.force_x", "N"},
            {"arm.force_y", "N"}, {"arm.torque", "N m"}, {"hand.force_y", "N"}};
  ZpActuatorDef def = def_of(
      "mesh.nodes: 9\n"
      "bodies:\n  arm: {moves: plane, mass: 5 g, inertia: 1e-6 kg m2, at: [0, -20 mm]}\n  hand: {mass: 2 g}\n"
      "  wall: {moves: none}\n"
      "members:\n  all: {upper: frame, lower: arm}\n  left: {upper: frame, lower: hand, port: pair, drive.voltage: 2 "
      "kV}\n  right: {upper: frame, lower: hand, port: pair}\n"
      "  follows: {upper: frame, lower: hand, control: {kind: pi, signal: opening, proportional: 1 kV/mm}, "
      "setpoint.value: 40 mm}\n");
  char name[ZP_INPUT_NAME_SIZE];
  size_t count = 0;
  for (int input = zp_def_input_next(&def, -1); input >= 0; input = zp_def_input_next(&def, input), count++) {
    printf("%s\n", zp_def_input_name(&def, input, name));
    ck_assert(count < LENGTH_OF(of));
    ck_assert_str_eq(zp_def_input_name(&def, input, name), of[count].name);
    ck_assert_str_eq(zp_def_input_unit(&def, input), of[count].unit);
  }
  ck_assert(count == LENGTH_OF(of));
  ZpSim *sim = data_sim_of(&def);
  ck_says(zp_sim_set_input_named(sim, "left.volt", 0, 0, &err), ZP_BAD_INPUT, "did you mean left.voltage?");
  ck_says(zp_sim_set_input_named(sim, "load", 0, 0, &err), ZP_BAD_INPUT, "load: the network has no such input");
  ck_ok(zp_sim_set_input_named(sim, "follows.setpoint", 0, 0, &err));
  ZpRunInfo *info = zp_run_info_create();
  zp_sim_step(sim, 5e-3, NULL, info);
  ck_assert_double_gt(column_of(sim, &def, "follows.voltage_V"), 0); /* before it was to open */
  zp_run_info_destroy(info);
}

/* Work on bodies between two places, beside that on springs. */
TEST(mechanical_work_is_that_of_all_forces) {
  ZpActuatorDef def = def_of(
      RUNS "bodies: {arm: {moves: plane, mass: 4 g, inertia: 1e-6 kg m2, at: [10 mm, -8 mm], force: [30 mN, 5 mN], "
           "torque: 0.4 mN m}}\n"
           "joints: {p: {between: [frame, arm], at: [60 mm, -5 mm]}}\nmembers: {m: {upper: frame, lower: arm}}\n");
  static const char *const places[] = {"bodies.arm.x_m", "bodies.arm.y_m", "bodies.arm.angle_rad"};
  const double against[] = {-30e-3, 4e-3 * def.gravity - 5e-3, -0.4e-3};
  const ZpResult *end = answer_of(ZP_STUDY_ACTUATE, &def);
  def.drive.voltage = 0;
  const ZpResult *start = answer_of(ZP_STUDY_STATIONARY, &def);
  double work = 0;
  for (size_t k = 0; k < LENGTH_OF(places); k++) {
    const double one = against[k] * (number(end, places[k]) - number(start, places[k]));
    printf("%s: %.6g J\n", places[k], one);
    work += one;
  }
  printf("off by %.2g\n", number(end, "mechanical_work_J") / work - 1);
  ck_near(number(end, "mechanical_work_J"), work, 3e-5); /* of the joint */
}

/* -- wrong networks -------------------------------------------------------------------------------- */

#define HELD_ARM "bodies: {arm: {moves: plane, mass: 1 g, inertia: 1 g mm2, at: [0, -5 mm]}}\n"
#define LIFTED   HELD_ARM "members: {m: {upper: frame, lower: arm}}\n"
static const struct {
  ZpStudy study;
  const char *text, *says;
} wrong[] = {
    {ZP_STUDY_STATIONARY,
     "bodies: {a: {}}\nmembers: {m: {upper: frame, lower: a}}\njoints: {p: {between: [frame, a]}}\n",
     "joints.p: neither frame nor a moves in the plane"},
    {ZP_STUDY_STATIONARY, LIFTED "joints: {p: {between: [frame, leg]}}\n",
     "joints.p.between: leg is not given in bodies"},
    {ZP_STUDY_STATIONARY, LIFTED "joints: {p: {between: [arm, arm]}}\n", "joints.p.between: both ends are at arm"},
    {ZP_STUDY_STATIONARY, LIFTED "joints: {p: {type: pin}}\n", "joints.p.between: give two bodies"},
    {ZP_STUDY_STATIONARY, LIFTED "joints: {p: {type: glue, between: [frame, arm]}}\n", "not one of pin, slide, weld"},
    {ZP_STUDY_STATIONARY,
     "bodies: {arm: {moves: plane}, leg: {moves: plane}}\nmembers: {m: {upper: frame, lower: arm}}\n",
     "bodies.leg: nothing holds it"},
    {ZP_STUDY_STATIONARY,
     "study: stationary\nbodies: {arm: {moves: plane, at: [0, -95 mm]}}\nmembers: {m: {upper: frame, lower: arm}}\n",
     "members.m: it opens by 0 to 88.2 mm, but its ends are apart by 6.8 mm too much in the drawing"},
    {ZP_STUDY_STATIONARY,
     "study: stationary\nbodies: {arm: {moves: plane, at: [0, 5 mm]}}\nmembers: {m: {upper: frame, lower: arm}}\n",
     "its lower end is 5 mm on the wrong side"},
    {ZP_STUDY_ACTUATE, "bodies: {arm: {moves: plane, mass: 1 g}}\nmembers: {m: {upper: frame, lower: arm}}\n",
     "bodies.arm.inertia = 0: a body that moves in the plane needs it in motion"},
    {ZP_STUDY_ACTUATE, "bodies: {arm: {moves: plane, inertia: 1 g mm2}}\nmembers: {m: {upper: frame, lower: arm}}\n",
     "bodies.arm.mass = 0"},
    {ZP_STUDY_STATIONARY, "bodies: {a: {force: [1 mN, 0]}}\nmembers: {m: {upper: frame, lower: a}}\n",
     "bodies.a.force: the first value, to the right, must be 0"},
    {ZP_STUDY_STATIONARY, "bodies: {a: {torque: 1 mN m}}\nmembers: {m: {upper: frame, lower: a}}\n",
     "bodies.a.torque: the body moves up and down"},
    {ZP_STUDY_STATIONARY, "bodies: {a: {}}\nmembers: {m: {upper: frame, lower: a, upper_at: [1 mm, 0]}}\n",
     "upper_at.x: all bodies move up and down"},
    {ZP_STUDY_STATIONARY, LIFTED "liquid.model: submerged\n",
     "the liquid between platforms is modelled for level ones only"},
    {ZP_STUDY_ISOMETRIC, LIFTED "isometric: {body: arm, separation: 5 mm}\n",
     "isometric.body = arm: where bodies move in"},
    {ZP_STUDY_ACTUATE, LIFTED "control: {kind: pi, signal: angle}\nsetpoint.value: 3 mm\nload.mass: 1 g\n",
     "each body has a mass of its own"},
    {ZP_STUDY_ACTUATE, "control: {kind: pi, signal: angle}\nsetpoint.value: 3 degree\n",
     "requires platform.rotates true; only a body that turns has an angle"},
    {ZP_STUDY_STATIONARY, HELD_ARM "members: {m: {upper: frame, lower: arm, angle: 200 degree}}\n", "180 degree"},
};

TESTS(wrong_networks_are_refused, 0, LENGTH_OF(wrong)) {
  ck_scenario_refused(wrong[_i].study, wrong[_i].text, wrong[_i].says);
}

/* -- what falls ------------------------------------------------------------------------------------ */

#define FALLING                                                                                                        \
  "mesh.nodes: 9\nliquid.model: none\noutput.errors: false\nmembers: {a: {upper: frame, lower: arm}}\nbodies:\n"       \
  "  arm: {moves: plane, mass: 8 g, inertia: 1000 g mm2, at: [0, -10 mm]}\n"                                           \
  "  wall: {moves: none, at: [80 mm, 0], angle: 90 degree}\n"                                                          \
  "  cart: {moves: plane, mass: 5 g, inertia: 1000 g mm2, at: [80 mm, -10 mm]}\n"
static const char *const falling[] = {
    FALLING "joints: {rail: {type: slide, between: [wall, cart], at: [80 mm, -10 mm]}}\n",
    FALLING "springs: {s: {between: [frame, cart], stiffness: 10 N/m, rest: 5 mm, kind: push, from_at: [80 mm, 0]}}\n",
};

/* A torque that its weight does not hold turns a body round and round. */
TEST(body_that_spins_has_a_name) {
  static const char free[] =
      "study: stationary\nmesh.nodes: 13\nliquid.model: none\n"
      "bodies: {arm: {moves: plane, mass: 5 g, inertia: 1 g cm2, torque: 1 mN m}, hand: {mass: 8 g, "
      "at: [0.2, -8 mm]}}\n"
      "joints: {pivot: {type: pin, between: [frame, arm], at: [0, 5 mm]}}\n"
      "members: {lifts: {upper: frame, lower: hand, upper_at: [0.2, 0]}}\n";
  const ZpActuatorDef def = def_of(free);
  const ZpResult *result = study_of(ZP_STUDY_STATIONARY, &def);
  printf("%s\n", result->message);
  ck_assert_int_eq(result->outcome, ZP_NOT_SETTLED);
  ck_assert_msg(strstr(result->message, "bodies.arm turns"), "%s", result->message);
}

/* Every study names the body that nothing holds; a stop below holds it. */
TESTS(body_that_falls_has_a_name, 0, LENGTH_OF(falling)) {
  static const ZpStudy study[] = {ZP_STUDY_STATIONARY, ZP_STUDY_EQUILIBRIUM, ZP_STUDY_LIMITS, ZP_STUDY_MODES,
                                  ZP_STUDY_ACTUATE};
  const ZpActuatorDef def = def_of(falling[_i]);
  for (size_t k = 0; k < LENGTH_OF(study); k++) {
    const ZpResult *result = study_of(study[k], &def);
    printf("%s\n", result->message);
    ck_assert_int_eq(result->outcome, ZP_NOT_SETTLED);
    ck_assert_msg(strstr(result->message, "bodies.cart moves away") && strstr(result->message, "mm down"), "%s",
                  result->message);
  }
}

TEST(stop_holds_what_falls) {
  char text[2048];
  snprintf(
      text, sizeof text, "%s%s", falling[0],
      "springs: {stop: {between: [frame, cart], stiffness: 10 N/m, rest: 20 mm, kind: pull, from_at: [80 mm, 0]}}\n");
  const ZpActuatorDef def = def_of(text);
  const ZpResult *result = answer_of(ZP_STUDY_STATIONARY, &def);
  ck_assert_int_eq(result->outcome, ZP_CONVERGED);
  ck_near(zp_result_get(result, "bodies.cart.y_m"), -(20e-3 + 5e-3 * 9.81 / 10), 1e-6);
}
