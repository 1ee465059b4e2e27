/* Networks: bodies, and members and springs between them. At rest against stacks, beams and balances of forces; in
 * motion against stacks, frequencies of a chain, and energy; the language of scenarios. docs/theory.md, section 32. */
#include "network_util.h"

static const double pi = 3.14159265358979323846;

/* -- stacks are shorthands ------------------------------------------------------------------------- */

#define OF_ALL "study: stationary\nmesh.nodes: 21\nliquid.model: none\n"
static const struct {
  const char *name, *stack, *network;
  double rest, run; /* how near they are */
} shorthand[] = {
    {"one", OF_ALL "load.mass: 8 g\n",
     OF_ALL "bodies: {hand: {mass: 8 g}}\nmembers: {only: {upper: frame, lower: hand}}\n", 1e-14, 1e-14},
    {"series", OF_ALL "load.mass: 8 g\nstack: {series: 2, link_mass: 2 g}\n",
     OF_ALL "bodies:\n  link: {mass: 2 g}\n  hand: {mass: 8 g}\n"
            "members:\n  top: {upper: frame, lower: link}\n  bottom: {upper: link, lower: hand}\n",
     1e-14, 1e-14},
    {"side by side", OF_ALL "load.mass: 16 g\nstack.parallel: 2\nmember_2.ribbon.thickness: 60 um\n",
     OF_ALL "bodies: {hand: {mass: 16 g}}\nmembers:\n  left: {upper: frame, lower: hand}\n"
            "  right: {upper: frame, lower: hand, ribbon.thickness: 60 um}\n",
     1e-14, 1e-14},
    {"antagonists", OF_ALL "load.mass: 8 g\nstack: {series: 2, distance: 50 mm, voltage_ratio: 0.5}\n",
     OF_ALL "bodies:\n  hand: {mass: 8 g}\n  floor: {moves: none, at: [0, -50 mm]}\nmembers:\n"
            "  up: {upper: frame, lower: hand}\n"
            "  down: {upper: floor, lower: hand, angle: 180 degree, drive.voltage: 5 kV}\n",
     3e-9, 7e-13}, /* 7.8e-10 of the frequency, 2.2e-13 measured */
};

static void compare(const ZpResult *stack, const ZpResult *network, const char *name, double within) {
  const double a = number(stack, name), b = number(network, name);
  if (isnan(a) && isnan(b)) return;
  printf("%s: off by %.2g\n", name, fabs(b / a - 1));
  ck_near(b, a, within);
}

TESTS(stacks_are_shorthands, 0, LENGTH_OF(shorthand)) {
  static const char *const at_rest[] = {"pull_in_voltage_V", "release_voltage_V", "closing_voltage_V"};
  ZpActuatorDef stack = def_of(shorthand[_i].stack), network = def_of(shorthand[_i].network);
  const ZpResult *a = answer_of(ZP_STUDY_EQUILIBRIUM, &stack), *b = answer_of(ZP_STUDY_EQUILIBRIUM, &network);
  for (size_t k = 0; k < LENGTH_OF(at_rest); k++)
    compare(a, b, at_rest[k], shorthand[_i].rest);
  compare(answer_of(ZP_STUDY_MODES, &stack), answer_of(ZP_STUDY_MODES, &network), "frequency_1_Hz", shorthand[_i].rest);
  stack.solver.end_time = network.solver.end_time = 0.05;
  stack.solver.stop_when_zipped = network.solver.stop_when_zipped = ZP_WHEN_FALSE;
  a = answer_of(ZP_STUDY_ACTUATE, &stack), b = answer_of(ZP_STUDY_ACTUATE, &network);
  ck_near(zp_table_get(b->series, b->series->rows - 1, "charge_C"),
          zp_table_get(a->series, a->series->rows - 1, "charge_C"), shorthand[_i].run);
  ck_assert_double_eq(number(a, "steps"), number(b, "steps"));
  if (stack.stack.link_mass > 0) return;     /* a link is a body, too, but no load */
  compare(a, b, "mechanical_work_J", 2e-11); /* 5.4e-12 measured, of antagonists */
  compare(a, b, "efficiency", 1e-14);
}

/* -- at rest --------------------------------------------------------------------------------------- */

/* A chain of many weightless members has the pull-in of one, and as many times its opening. */
TEST(weightless_ones_in_series_are_as_one) {
  enum { MANY = 100 };
  char *text = NULL, *members = NULL;
  size_t size, length;
  FILE *bodies = open_memstream(&text, &size), *chain = open_memstream(&members, &length);
  fprintf(bodies, OF_ALL "ribbon.density: 0\ninsulator.density: 0\nbodies:\n");
  for (int k = 1; k <= MANY; k++) {
    fprintf(bodies, "  b%d: {mass: %s}\n", k, k == MANY ? "8 g" : "0 g");
    if (k == 1)
      fprintf(chain, "members:\n  m1: {upper: frame, lower: b1}\n");
    else
      fprintf(chain, "  m%d: {upper: b%d, lower: b%d}\n", k, k - 1, k);
  }
  fclose(chain);
  fprintf(bodies, "%s", members);
  fclose(bodies);
  ZpActuatorDef many = def_of(text), one = DEF({"mesh.nodes", 21}, {"ribbon.density", 0}, {"insulator.density", 0});
  ZpResult *all = answer_of(ZP_STUDY_STATIONARY, &many), *single = answer_of(ZP_STUDY_STATIONARY, &one);
  ck_near(number(all, "bodies.b100.y_m"), -MANY * number(single, "opening_m"), 1e-12); /* 1e-14 measured */
  ck_near(answered_value(ZP_STUDY_LIMITS, &many, "pull_in_voltage_V"),
          answered_value(ZP_STUDY_LIMITS, &one, "pull_in_voltage_V"), 8e-13); /* 2.8e-13 measured */
  free(text);
  free(members);
}

/* Of many members beside each other, each with a load of its own, some take more iterations than most do: they go on
 * alone. */
TEST(each_of_many_hangs_as_if_alone) {
  enum { MANY = 120 };
  char *text = NULL, *members = NULL;
  size_t size, length;
  FILE *bodies = open_memstream(&text, &size), *hung = open_memstream(&members, &length);
  fprintf(bodies, OF_ALL "bodies:\n");
  fprintf(hung, "members:\n");
  for (int k = 0; k < MANY; k++) {
    fprintf(bodies, "  b%d: {mass: %g g}\n", k, 4 + 3.0 * k);
    fprintf(hung, "  m%d: {upper: frame, lower: b%d}\n", k, k);
  }
  fclose(hung);
  fprintf(bodies, "%s", members);
  fclose(bodies);
  ZpActuatorDef many = def_of(text);
  const ZpResult *all = answer_of(ZP_STUDY_STATIONARY, &many);
  double most = 0;
  for (int k = 0; k < MANY; k++) {
    ZpActuatorDef one = DEF({"mesh.nodes", 21}, {"load.mass", 1e-3 * (4 + 3.0 * k)});
    const double alone = answered_value(ZP_STUDY_STATIONARY, &one, "opening_m");
    char name[32];
    snprintf(name, sizeof name, "members.m%d.opening_m", k);
    most = fmax(most, fabs(number(all, name) / alone - 1));
  }
  printf("off by %.2g; %g iterations\n", most, number(all, "iterations"));
  ck_below(most, 1.3e-15); /* 4.4e-16 measured */
  free(text);
  free(members);
}

/* Members of several kinds, springs and a mount around two bodies, named in two orders. */
static const char both_orders[2][1024] = {
    OF_ALL
    "bodies:\n  hand: {mass: 16 g, force: [0, -20 mN]}\n  floor: {moves: none, at: [0, -70 mm]}\n  hook: {mass: 5 g}\n"
    "members:\n  left: {upper: frame, lower: hand}\n"
    "  right: {upper: frame, lower: hand, ribbon.thickness: 60 um, drive.voltage: 6 kV}\n"
    "  back: {upper: floor, lower: hand, angle: 180 degree, drive.voltage: 2 kV}\n"
    "  tail: {upper: hand, lower: hook}\n"
    "springs:\n  coil: {between: [frame, hand], stiffness: 5 N/m, rest: 10 mm}\n"
    "  rope: {between: [hand, hook], stiffness: 3 N/m, rest: 12 mm, kind: pull}\n",
    OF_ALL "springs:\n  rope: {between: [hand, hook], stiffness: 3 N/m, rest: 12 mm, kind: pull}\n"
           "  coil: {between: [frame, hand], stiffness: 5 N/m, rest: 10 mm}\n"
           "members:\n  tail: {upper: hand, lower: hook}\n"
           "  right: {upper: frame, lower: hand, ribbon.thickness: 60 um, drive.voltage: 6 kV}\n"
           "  back: {upper: floor, lower: hand, angle: 180 degree, drive.voltage: 2 kV}\n"
           "  left: {upper: frame, lower: hand}\n"
           "bodies:\n  hook: {mass: 5 g}\n  floor: {moves: none, at: [0, -70 mm]}\n  hand: {mass: 16 g, force: [0, -20 "
           "mN]}\n"};

static const char *const places[] = {"bodies.hand.y_m",       "bodies.hook.y_m",      "members.left.force_N",
                                     "members.right.force_N", "members.back.force_N", "members.tail.force_N"};

TEST(order_of_names_makes_no_difference) {
  ZpActuatorDef def[2] = {def_of(both_orders[0]), def_of(both_orders[1])};
  const ZpResult *a = answer_of(ZP_STUDY_STATIONARY, &def[0]), *b = answer_of(ZP_STUDY_STATIONARY, &def[1]);
  for (size_t k = 0; k < LENGTH_OF(places); k++)
    compare(a, b, places[k], 1e-14); /* 2.2e-16 measured */
  for (int k = 0; k < 2; k++)
    def[k].drive.voltage = 3e3;
  a = answer_of(ZP_STUDY_EQUILIBRIUM, &def[0]), b = answer_of(ZP_STUDY_EQUILIBRIUM, &def[1]);
  ck_near(zp_table_get(a->series, a->series->rows - 1, "hand.y_m"),
          zp_table_get(b->series, b->series->rows - 1, "hand.y_m"), 1e-10);
}

/* What pulls a body up is what pulls it down: members without weight, springs, its weight and the force on it. */
TEST(forces_on_each_body_balance) {
  ZpActuatorDef def = def_of(both_orders[0]);
  def.ribbon.density = 0;
  const ZpResult *r = answer_of(ZP_STUDY_STATIONARY, &def);
  const double hand = number(r, "bodies.hand.y_m"), hook = number(r, "bodies.hook.y_m");
  const double coil = 5 * (-hand - 10e-3), rope = 3 * fmax(hand - hook - 12e-3, 0);
  const double up = number(r, "members.left.force_N") + number(r, "members.right.force_N") + coil,
               tail = number(r, "members.tail.force_N") + rope,
               down = number(r, "members.back.force_N") + tail + 16e-3 * def.gravity + 20e-3;
  printf("hand: %.9g up, off by %.2g; hook: off by %.2g\n", up, down / up - 1, tail / (5e-3 * def.gravity) - 1);
  ck_assert_double_gt(rope, 1e-3);
  ck_near(tail, 5e-3 * def.gravity, 4e-10); /* 1.3e-10 measured */
  ck_near(up, down, 2e-10);                 /* 5.5e-11 measured */
}

/* The voltage at which the first insulator of any member breaks down; a member at half of it may have half the
 * insulator. */
TEST(thinnest_insulator_allows_least) {
  static const char both[] = OF_ALL "bodies: {hand: {mass: 8 g}}\nmembers:\n  left: {upper: frame, lower: hand}\n"
                                    "  right: {upper: frame, lower: hand, insulator.thickness: 65 um}\n";
  ZpActuatorDef one = DEF({"mesh.nodes", 21}), two = def_of(both);
  const double alone = answered_value(ZP_STUDY_LIMITS, &one, "allowed_voltage_V");
  ck_near(answered_value(ZP_STUDY_LIMITS, &two, "allowed_voltage_V"), alone / 2, 1e-14);
  set_member(&two, "member_2.drive.voltage", two.drive.voltage / 2);
  ck_near(answered_value(ZP_STUDY_LIMITS, &two, "allowed_voltage_V"), alone, 1e-14);
}

/* A tree hangs as it does if its lowest members are named first; the force in a member is the weight of all below it.
 */
TEST(tree_hangs_in_any_order) {
  static const char down[] =
      OF_ALL "bodies: {a: {mass: 1 g}, b: {mass: 2 g}, c: {mass: 4 g}, d: {mass: 3 g}}\nmembers:\n"
             "  top: {upper: frame, lower: a, ribbon.thickness: 70 um}\n"
             "  left: {upper: a, lower: b}\n  low: {upper: b, lower: c}\n  right: {upper: a, lower: d}\n";
  static const char up[] =
      OF_ALL "members:\n  low: {upper: b, lower: c}\n  right: {upper: a, lower: d}\n"
             "  left: {upper: a, lower: b}\n  top: {upper: frame, lower: a, ribbon.thickness: 70 um}\n"
             "bodies: {d: {mass: 3 g}, c: {mass: 4 g}, b: {mass: 2 g}, a: {mass: 1 g}}\n";
  ZpActuatorDef a = def_of(down), b = def_of(up);
  compare(answer_of(ZP_STUDY_MODES, &a), answer_of(ZP_STUDY_MODES, &b), "frequency_1_Hz", 4e-11); /* 1.2e-11 measured */
  compare(answer_of(ZP_STUDY_MODES, &a), answer_of(ZP_STUDY_MODES, &b), "frequency_3_Hz",
          1.2e-11); /* 3.8e-12 measured */
  a.ribbon.density = b.ribbon.density = 0;
  const ZpResult *r = answer_of(ZP_STUDY_STATIONARY, &a), *s = answer_of(ZP_STUDY_STATIONARY, &b);
  compare(r, s, "bodies.c.y_m", 1e-12);                                /* 0 measured */
  ck_near(number(r, "members.top.force_N"), 10e-3 * a.gravity, 7e-11); /* 2.2e-11 measured */
  ck_near(number(r, "members.left.force_N"), 6e-3 * a.gravity, 3e-10); /* 9.0e-11 measured */
  const ZpShape shape = zp_shapes_get(s->shapes, 0);                   /* the first member of `up` hangs lowest */
  const size_t each = s->shapes->nodes * s->shapes->ribbons / 4;
  double lowest = 0, first = 0;
  for (size_t j = 0; j < 4 * each; j++)
    lowest = fmin(lowest, shape.y[j]);
  for (size_t j = 0; j < each; j++)
    first = fmin(first, shape.y[j]);
  ck_near(first, number(r, "bodies.c.y_m"), 1e-14); /* 0 measured */
  ck_assert_double_eq(first, lowest);
}

/* A body on a stiff spring: what its member does not carry stretches the spring. One that only pushes is slack. */
TEST(spring_takes_what_is_left) {
  ZpActuatorDef def = def_of(OF_ALL "ribbon.density: 0\nbodies: {hand: {mass: 8 g}}\n"
                                    "members: {only: {upper: frame, lower: hand}}\n"
                                    "springs: {coil: {between: [frame, hand], stiffness: 1 kN/m, rest: 4 mm}}\n");
  const ZpResult *r = answer_of(ZP_STUDY_STATIONARY, &def);
  const double left = 8e-3 * def.gravity - number(r, "members.only.force_N");
  ck_assert_double_gt(left, 0.04);
  ck_near(number(r, "bodies.hand.y_m"), -4e-3 - left / 1e3, 1.1e-12); /* 3.7e-13 measured */
  def = def_of(OF_ALL "ribbon.density: 0\nbodies: {hand: {mass: 8 g}}\nmembers: {only: {upper: frame, lower: hand}}\n"
                      "springs: {coil: {between: [frame, hand], stiffness: 1 MN/m, rest: 1 mm, kind: push}}\n");
  ZpActuatorDef free_one = DEF({"mesh.nodes", 21}, {"ribbon.density", 0});
  ck_near(answered_value(ZP_STUDY_STATIONARY, &def, "bodies.hand.y_m"),
          -answered_value(ZP_STUDY_STATIONARY, &free_one, "opening_m"), 1e-13); /* 2.2e-16 measured */
}

/* A body between two mounts that hold no more than it takes: a member between bodies that are both held stays. */
TEST(member_between_mounts_stays) {
  ZpActuatorDef def =
      def_of(OF_ALL "bodies:\n  floor: {moves: none, at.y: -20 mm}\n  hand: {mass: 8 g}\n"
                    "members:\n  fixed: {upper: frame, lower: floor}\n  free: {upper: floor, lower: hand}\n");
  ZpActuatorDef one = DEF({"mesh.nodes", 21});
  const ZpResult *r = answer_of(ZP_STUDY_STATIONARY, &def);
  ck_near(number(r, "members.fixed.opening_m"), 20e-3, 1e-12);
  ck_near(number(r, "bodies.hand.y_m"), -20e-3 - answered_value(ZP_STUDY_STATIONARY, &one, "opening_m"), 1e-13); /* 0 */
}

/* The force that holds a body of a network is that which holds the platform of the same stack. */
TEST(held_body_is_a_held_platform) {
  ZpActuatorDef stack = def_of(shorthand[1].stack), network = def_of(shorthand[1].network);
  stack.isometric.separation = network.isometric.separation = 10e-3;
  network.isometric.body = 2;
  stack.drive.voltage = network.drive.voltage = 6e3;
  compare(answer_of(ZP_STUDY_ISOMETRIC, &stack), answer_of(ZP_STUDY_ISOMETRIC, &network), "force_N", 1e-13);
}

/* -- members of any device ------------------------------------------------------------------------- */

static const struct {
  const char *kind, *keys;
  bool moves; /* may its upper end be on a body that moves? */
} device[] = {
    {"ribbon", "ribbon.length: 45 mm\n", true},
    {"flange", "ribbon.length: 45 mm\nelectro.gap_offset: 0.1 mm\n", false},
    {"mouth", "ribbon.length: 45 mm\n", true},
    {"hinge",
     "ribbon.length: 40 mm\nribbon.thickness: 1 mm\nlower.ribbon.thickness: 100 um\nhinge.stiffness: 0.4 mN m/rad\n"
     "hinge.rest_angle: 20 degree\n",
     true},
};

/* => a scenario of members of this device and what follows. */
static char *of_device(int which, const char *rest) {
  static char text[1024];
  snprintf(text, sizeof text, OF_ALL "actuator.kind: %s\n%sdrive.voltage: 3 kV\nsolver.end_time: 20 ms\n%s",
           device[which].kind, device[which].keys, rest);
  return text;
}

/* Members beside each other with a body below them are as one actuator with its part of the mass. */
TESTS(any_device_is_a_member, 0, LENGTH_OF(device)) {
  ZpActuatorDef alone = def_of(of_device(_i, "load.mass: 4 g\n"));
  ZpActuatorDef two = def_of(of_device(_i, "bodies: {bar: {mass: 8 g}}\nmembers: {a: {upper: frame, lower: bar}, b: "
                                           "{upper: frame, lower: bar}}\n"));
  const ZpResult *a = answer_of(ZP_STUDY_STATIONARY, &alone), *b = answer_of(ZP_STUDY_STATIONARY, &two);
  ck_near(number(b, "bodies.bar.y_m"), -number(a, "stroke_m"), 1e-13);
  compare(answer_of(ZP_STUDY_MODES, &alone), answer_of(ZP_STUDY_MODES, &two), "frequency_1_Hz", 1e-8);
  a = answer_of(ZP_STUDY_ACTUATE, &alone), b = answer_of(ZP_STUDY_ACTUATE, &two);
  printf("in motion: off by %.2g\n", fabs(-number(b, "bodies.bar.y_m") / number(a, "stroke_m") - 1));
  ck_near(number(b, "bodies.bar.y_m"), -number(a, "stroke_m"), 1e-11);
  ck_assert_double_eq(number(a, "steps"), number(b, "steps"));
  if (_i == 0) return; /* without electrodes */
  compare(answer_of(ZP_STUDY_LIMITS, &alone), answer_of(ZP_STUDY_LIMITS, &two), "release_voltage_V", 1e-8);
}

/* One that hangs on a body that moves is in the frame of this body; what a body of no mass carries hangs on it. */
TESTS(any_device_hangs_on_another, 0, LENGTH_OF(device)) {
  if (!device[_i].moves) return;
  ZpActuatorDef chain =
      def_of(of_device(_i, "ribbon.density: 0\ninsulator.density: 0\nbodies: {link: {mass: 1 g}, bar: "
                           "{mass: 3 g}}\nmembers: {a: {upper: frame, lower: link}, b: {upper: "
                           "link, lower: bar}}\n"));
  ZpActuatorDef upper = def_of(of_device(_i, "ribbon.density: 0\ninsulator.density: 0\nload.mass: 4 g\n")),
                lower = def_of(of_device(_i, "ribbon.density: 0\ninsulator.density: 0\nload.mass: 3 g\n"));
  const double fall = answered_value(ZP_STUDY_STATIONARY, &upper, "stroke_m"),
               further = answered_value(ZP_STUDY_STATIONARY, &lower, "stroke_m");
  const ZpResult *r = answer_of(ZP_STUDY_STATIONARY, &chain);
  ck_near(number(r, "bodies.link.y_m"), -fall, 1e-12);
  ck_near(number(r, "bodies.bar.y_m"), -fall - further, 1e-12);
  chain.ribbon.density = 7850; /* in motion it stays there */
  chain.drive.voltage = 1;
  chain.solver.end_time = 2e-3;
  const double rests = number(answer_of(ZP_STUDY_STATIONARY, &chain), "bodies.bar.y_m");
  ck_near(number(answer_of(ZP_STUDY_ACTUATE, &chain), "bodies.bar.y_m"), rests, 1e-6);
  chain.drive.voltage = 3e3; /* and its clamp goes with the body */
  const ZpResult *moved = answer_of(ZP_STUDY_ACTUATE, &chain);
  const ZpShape shape = zp_shapes_get(moved->shapes, moved->shapes->frames - 1);
  const size_t each = moved->shapes->nodes * moved->shapes->ribbons / 2;
  for (size_t r = 0; r < moved->shapes->ribbons; r++)
    ck_assert_double_lt(fabs(shape.y[each + r] - number(moved, "bodies.link.y_m")), 1e-12);
}

/* A ribbon without a platform may rise above its clamp, here to a mount: without weight it is the mirror image of one
 * that hangs as far below. */
TEST(ribbon_rises_to_a_mount) {
  static const char mounts[2][256] = {"gravity: 0\nbodies: {up: {moves: none, at.y: 5 mm}, hand: {mass: 1 g}}\n"
                                      "members: {a: {upper: frame, lower: up}, b: {upper: frame, lower: hand}}\n",
                                      "gravity: 0\nbodies: {down: {moves: none, at.y: -5 mm}, hand: {mass: 1 g}}\n"
                                      "members: {a: {upper: frame, lower: down}, b: {upper: frame, lower: hand}}\n"};
  double force[2];
  for (int k = 0; k < 2; k++) {
    const ZpActuatorDef def = def_of(of_device(0, mounts[k]));
    force[k] = number(answer_of(ZP_STUDY_STATIONARY, &def), "members.a.force_N");
  }
  printf("pull %.9g N, %.9g N\n", force[0], force[1]);
  ck_assert_double_gt(force[1], 1e-3);
  ck_near(force[0], -force[1], 1e-12);
}

/* Two straight guided ribbons in series without weight: springs of 12 EI / L^3 and their masses. */
TEST(guided_ribbons_in_series_vibrate_as_springs) {
  ZpActuatorDef def = def_of(of_device(0, "gravity: 0\nribbon.density: 1e-3 kg/m3\ninsulator.density: 0\n"
                                          "insulator.young_modulus: 0\nbodies: {link: {mass: 3 g}, bar: {mass: 3 g}}\n"
                                          "members: {a: {upper: frame, lower: link}, b: {upper: link, lower: bar}}\n"));
  def.mesh.nodes = 81;
  const double L = 45e-3, t = 50e-6, EI = 200e9 / (1 - 0.285 * 0.285) * 12.7e-3 * t * t * t / 12;
  const double omega2 = 12 * EI / (L * L * L) / 3e-3 * (3 - sqrt(5)) / 2;
  ck_near(answered_value(ZP_STUDY_MODES, &def, "frequency_1_Hz"), sqrt(omega2) / (2 * 3.14159265358979323846),
          8e-9); /* 2.5e-9 measured */
}

/* -- in motion ------------------------------------------------------------------------------------- */

/* n equal springs and masses in a row: omega_j = 2 omega sin((2 j - 1) pi / (4 n + 2)). */
TEST(chain_vibrates_as_a_chain) {
  enum { N = 5 };
  static const char one[] = OF_ALL "gravity: 0\nribbon.density: 1 kg/m3\nbodies: {b1: {mass: 8 g}}\n"
                                   "members: {m1: {upper: frame, lower: b1}}\n";
  static const char five[] =
      OF_ALL "gravity: 0\nribbon.density: 1 kg/m3\nbodies: {b1: {mass: 8 g}, b2: {mass: 8 g}, b3: {mass: 8 g}, b4: "
             "{mass: 8 g}, "
             "b5: {mass: 8 g}}\n"
             "members:\n  m1: {upper: frame, lower: b1}\n  m2: {upper: b1, lower: b2}\n  m3: {upper: b2, lower: b3}\n"
             "  m4: {upper: b3, lower: b4}\n  m5: {upper: b4, lower: b5}\n";
  ZpActuatorDef single = def_of(one), all = def_of(five);
  const double alone = answered_value(ZP_STUDY_MODES, &single, "frequency_1_Hz");
  const ZpResult *r = answer_of(ZP_STUDY_MODES, &all);
  for (int j = 1; j <= N; j++) {
    char name[32];
    snprintf(name, sizeof name, "frequency_%d_Hz", j);
    const double expected = 2 * alone * sin((2 * j - 1) * pi / (4 * N + 2));
    printf("%s: off by %.2g\n", name, number(r, name) / expected - 1);
    ck_near(number(r, name), expected, 1e-5); /* 3.3e-6 measured */
  }
}

/* Two side by side between bodies that both move are as one that is twice as wide, also where their platforms land:
 * dry, with a film. */
TESTS(two_abreast_are_one_twice_as_wide, 0, 2) {
  static const char two[] = OF_ALL "bodies: {bar: {mass: 4 g}, hand: {mass: 8 g}}\nmembers:\n"
                                   "  top: {upper: frame, lower: bar, ribbon.width: 25.4 mm, drive.voltage: 4 kV}\n"
                                   "  left: {upper: bar, lower: hand}\n  right: {upper: bar, lower: hand}\n";
  static const char wide[] = OF_ALL "bodies: {bar: {mass: 4 g}, hand: {mass: 8 g}}\nmembers:\n"
                                    "  top: {upper: frame, lower: bar, ribbon.width: 25.4 mm, drive.voltage: 4 kV}\n"
                                    "  left: {upper: bar, lower: hand, ribbon.width: 25.4 mm}\n";
  ZpActuatorDef a = def_of(two), b = def_of(wide);
  a.solver.end_time = b.solver.end_time = 0.03;
  a.solver.tolerance = b.solver.tolerance = 1e-6;
  a.solver.stop_when_zipped = b.solver.stop_when_zipped = ZP_WHEN_FALSE;
  if (_i == 1) {
    a.liquid.model = b.liquid.model = ZP_LIQUID_SUBMERGED;
    a.liquid.lateral_flow = b.liquid.lateral_flow = false;
    a.liquid.inertia = b.liquid.inertia = false; /* the mass of liquid outside goes with the square of the width */
    a.medium.kinematic_viscosity = b.medium.kinematic_viscosity = 1e-6;
  }
  const ZpResult *r = answer_of(ZP_STUDY_ACTUATE, &a), *s = answer_of(ZP_STUDY_ACTUATE, &b);
  printf("zip after %.4g ms\n", 1e3 * number(r, "members.left.zip_time_s"));
  compare(r, s, "members.left.zip_time_s", 1e-7); /* 3.6e-8 measured */
  compare(r, s, "bodies.hand.y_m", 3e-7);         /* 9.6e-8 */
  compare(r, s, "bodies.bar.y_m", 7e-6);          /* 2.3e-6 */
}

/* Zip, hold and release of two bodies on four members and two springs. */
TESTS(energy_balances, 0, 3) {
  static const ZpLiquidModel liquid[] = {ZP_LIQUID_NONE, ZP_LIQUID_SUBMERGED, ZP_LIQUID_BEAD};
  static const double within[] = {2e-8, 1.1e-8, 2.5e-8}; /* 7.2e-9, 3.9e-9, 8.5e-9 measured */
  ZpActuatorDef def = def_of(both_orders[0]);
  def.liquid.model = liquid[_i];
  if (_i > 0) def.solver.tolerance = 1e-5;
  def.drive.waveform = ZP_WAVEFORM_SQUARE;
  def.drive.frequency = 1 / 0.12;
  def.drive.rise_time = 5e-3;
  def.solver.end_time = 0.12;
  const ZpResult *r = answer_of(ZP_STUDY_ACTUATE, &def);
  printf("energy error %.2g\n", number(r, "energy_error"));
  ck_assert_double_gt(zp_table_get(r->series, r->series->rows / 2, "electric_work_J"), 1e-5);
  const double hand = number(r, "bodies.hand.y_m");
  ck_near(number(r, "members.left.opening_m"), -hand, 1e-14);
  ck_near(number(r, "members.tail.opening_m"), hand - number(r, "bodies.hook.y_m"), 1e-12);
  ck_near(number(r, "members.back.opening_m"), hand + 70e-3, 1e-12);
  ck_below(number(r, "energy_error"), within[_i]);
}

/* -- the language ---------------------------------------------------------------------------------- */

/* The work on bodies, each against its weight and the force on it, and on a spring. */
TEST(work_on_bodies_adds_up) {
  const ZpActuatorDef def = def_of(OF_ALL "solver: {end_time: 60 ms, stop_when_zipped: false}\n"
                                          "bodies: {hand: {mass: 8 g, force: [0, -30 mN]}, foot: {mass: 5 g}}\n"
                                          "members: {a: {upper: frame, lower: hand}, b: {upper: hand, lower: foot}}\n"
                                          "springs: {s: {between: [frame, foot], stiffness: 3 N/m, rest: 10 mm}}\n");
  const ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def);
  const ZpTable *t = result->series;
  static const char *const of[] = {"hand.y_m", "foot.y_m", "spring_energy_J"};
  const double by[] = {8e-3 * def.gravity + 30e-3, 5e-3 * def.gravity, 1};
  double work = 0;
  for (size_t k = 0; k < LENGTH_OF(of); k++)
    work += by[k] * (zp_table_get(t, t->rows - 1, of[k]) - zp_table_get(t, 0, of[k]));
  ck_near(number(result, "mechanical_work_J"), work, 1e-12);
}

/* -- derivatives ------------------------------------------------------------------------------------ */

/* Derivatives by keys of members, bodies and springs are those of differences of fourth order. */
static const struct {
  ZpStudy study;
  const char *output;
  double within;
} derived[] = {{ZP_STUDY_STATIONARY, "bodies.hand.y_m", 2e-8},
               {ZP_STUDY_ISOMETRIC, "force_N", 4e-6},
               {ZP_STUDY_MODES, "frequency_2_Hz", 2e-6}};

static const char *const by_keys[] = {"spring_1.stiffness",
                                      "spring_1.rest",
                                      "body_3.at.y",
                                      "body_1.mass",
                                      "body_2.force.y",
                                      "ribbon.length",
                                      "member_2.ribbon.thickness",
                                      "member_2.ribbon.length",
                                      "gravity"};

TESTS(derivatives_are_differences, 0, LENGTH_OF(derived) * LENGTH_OF(by_keys)) {
  const size_t which = (size_t)_i / LENGTH_OF(by_keys);
  const char *key = by_keys[(size_t)_i % LENGTH_OF(by_keys)];
  char text[2048];
  snprintf(text, sizeof text,
           OF_ALL "solver.tolerance: 1e-8\nisometric: {body: hand, separation: 20 mm}\nsensitivity.by: %s\n"
                  "bodies:\n  hand: {mass: 12 g}\n  foot: {mass: 5 g, force: [0, -10 mN]}\n"
                  "  floor: {moves: none, at: [0, -90 mm]}\n"
                  "members:\n  a: {upper: frame, lower: hand, drive.voltage: 6 kV}\n"
                  "  b: {upper: frame, lower: hand, ribbon: {thickness: 60 um, length: 101 mm}}\n"
                  "  c: {upper: hand, lower: foot}\n"
                  "  d: {upper: floor, lower: foot, angle: 180 degree, drive.voltage: 1 kV}\n"
                  "springs: {s: {between: [frame, foot], stiffness: 3 N/m, rest: 10 mm}}\n",
           key);
  const ZpActuatorDef def = def_of(text);
  const ZpResult *result = answer_of(derived[which].study, &def);
  const double value = zp_def_get(&def, zp_key_find(key)), step = 1e-3 * fabs(value);
  double sum = 0, found = NAN;
  for (size_t k = 0; k < result->sensitivities; k++)
    if (strcmp(result->sensitivity[k].output, derived[which].output) == 0) found = result->sensitivity[k].value;
  for (int k = -2; k <= 2; k++) {
    static const double weight[] = {1, -8, 0, 8, -1};
    ZpActuatorDef near = def;
    if (k == 0) continue;
    *near.sensitivity.by = 0;
    set_member(&near, key, value + k * step);
    sum += weight[k + 2] / (12 * step) * answered_value(derived[which].study, &near, derived[which].output);
  }
  const double size = number(result, derived[which].output) / fabs(value);
  printf("%s by %s: %.10g, off by %.2g of the size\n", derived[which].output, key, found, fabs((found - sum) / size));
  ck_below(fabs((found - sum) / size), derived[which].within);
}

/* -- periodic --------------------------------------------------------------------------------------- */

#define PERIODIC "cycle: {method: motion, tolerance: 1e-6}\ndrive: {waveform: sine, frequency: 8 Hz, offset: 1 kV}\n"

/* A stack and its network have one periodic motion. */
TESTS(cycles_are_those_of_stacks, 0, LENGTH_OF(shorthand)) {
  char text[2][1024];
  snprintf(text[0], sizeof *text, "%s" PERIODIC, shorthand[_i].stack);
  snprintf(text[1], sizeof *text, "%s" PERIODIC, shorthand[_i].network);
  ZpActuatorDef stack = def_of(text[0]), network = def_of(text[1]);
  stack.drive.voltage = network.drive.voltage = 4e3;
  if (zp_def_antagonist(&stack)) set_member(&network, "member_2.drive.voltage", 2e3);
  const ZpResult *a = answer_of(ZP_STUDY_CYCLE, &stack), *b = answer_of(ZP_STUDY_CYCLE, &network);
  ck_assert(number(a, "periodic") == 1 && number(b, "periodic") == 1);
  compare(a, b, "energy_per_cycle_J", 2e-8);                                /* 2.2e-9 measured, of a series */
  compare(a, b, "energy_drawn_per_cycle_J", 4e-10);                         /* 5.1e-11 measured */
  if (stack.stack.link_mass == 0) compare(a, b, "work_per_cycle_J", 4e-10); /* 5.4e-11 measured */
  if (stack.stack.link_mass > 0)
    ck_near(number(b, "bodies.hand.y_min_m"), -number(a, "opening_max_m"), 1.4e-10); /* 4.6e-11 measured */
}

/* What the source gives in a cycle of a tree with a spring is lost in it; bodies return. */
TEST(cycle_of_a_tree_loses_what_it_takes) {
  const ZpActuatorDef def =
      def_of(OF_ALL PERIODIC "drive.voltage: 4 kV\nbodies: {bar: {mass: 2 g}, hand: {mass: 8 g}, foot: {mass: 6 g}}\n"
                             "members:\n  a: {upper: frame, lower: bar}\n  b: {upper: bar, lower: hand}\n"
                             "  c: {upper: bar, lower: foot, drive.voltage: 3 kV}\n"
                             "springs: {coil: {between: [frame, bar], stiffness: 5 N/m, rest: 10 mm}}\n");
  const ZpResult *result = answer_of(ZP_STUDY_CYCLE, &def);
  const ZpTable *t = result->series;
  double lost = 0, range = number(result, "bodies.hand.y_max_m") - number(result, "bodies.hand.y_min_m");
  ck_assert(number(result, "periodic") == 1);
  for (size_t c = 0; c < t->columns; c++)
    if (strstr(t->column[c].name, "_loss_J") && strcmp(t->column[c].name, "viscous_loss_J") != 0)
      lost += zp_table_get(t, t->rows - 1, t->column[c].name) - zp_table_get(t, 0, t->column[c].name);
  printf("energy off by %.2g\n", fabs(number(result, "energy_per_cycle_J") / lost - 1));
  ck_near(number(result, "energy_per_cycle_J"), lost, 2e-10); /* 2.1e-11 measured */
  ck_below(fabs(zp_table_get(t, t->rows - 1, "hand.y_m") - zp_table_get(t, 0, "hand.y_m")),
           5e-6 * range); /* 7e-7 measured */
}

/* -- one member ------------------------------------------------------------------------------------ */

#define PROFILE "study: profile\nprofile.shape: %s\nisometric.separation: 2 mm\nmesh.nodes: 21\n"
#define OTHER   "ribbon.thickness: 60 um, insulator.thickness: 100 um, drive.voltage: 6 kV"
static const char *const of_several[] = {
    PROFILE "profile.member: other\nbodies: {hand: {mass: 8 g}}\nmembers: {one: {upper: frame, lower: hand},\n"
            "  other: {upper: frame, lower: hand, " OTHER "}}\n",
    PROFILE "profile.member: other\nliquid.model: none\nbodies: {hand: {moves: plane, mass: 8 g, at: [0, -10 mm]}}\n"
            "members: {one: {upper: frame, lower: hand},\n"
            "  other: {upper: frame, lower: hand, angle: 1, " OTHER "}}\n",
    PROFILE "profile.member: member_2\nstack.series: 2\nmember_2: {" OTHER "}\n",
    PROFILE "profile.member: 2\nstack.parallel: 2\nmember_2: {" OTHER "}\n",
    PROFILE "bodies: {hand: {}, foot: {mass: 1 g}}\nmembers: {a: {upper: frame, lower: hand},\n"
            "  b: {upper: hand, lower: foot}}\nribbon.thickness: 60 um\ninsulator.thickness: 100 um\n"
            "drive.voltage: 6 kV\n",
};

/* Its profile is that of a single actuator with its keys, to the last bit; of bodies in the plane without platforms'
 * electrodes and liquid, as these have none. */
TESTS(profile_of_a_member, 0, 2 * LENGTH_OF(of_several)) {
  const char *pattern = of_several[_i / 2];
  char text[1024], single[1024];
  const bool plane = strstr(pattern, "plane");
  snprintf(text, sizeof text, pattern, _i % 2 ? "cubic" : "held");
  snprintf(single, sizeof single,
           PROFILE "ribbon.thickness: 60 um\ninsulator.thickness: 100 um\ndrive.voltage: 6 kV\n%s",
           _i % 2 ? "cubic" : "held", plane ? "platform.electrode: false\nliquid.model: none\n" : "");
  const ZpActuatorDef def = def_of(text), alone = def_of(single);
  const ZpResult *a = answer_of(ZP_STUDY_PROFILE, &def), *b = answer_of(ZP_STUDY_PROFILE, &alone);
  for (size_t k = 0; k < a->scalars; k++)
    if (!isnan(b->scalar[k].value)) ck_assert_double_eq(number(a, b->scalar[k].name), b->scalar[k].value);
  ck_assert_uint_eq(a->series->rows, b->series->rows);
  for (size_t k = 0; k < a->series->rows; k++)
    ck_assert_double_eq(zp_table_get(a->series, k, "field_N_per_m"), zp_table_get(b->series, k, "field_N_per_m"));
}

static const struct {
  const char *text, *says;
} wrong_profiles[] = {
    {"profile.member: x\nbodies: {hand: {}}\nmembers: {a: {upper: frame, lower: hand}}",
     "profile.member = x: there is no such member"},
    {"bodies: {hand: {}}\nmembers: {a: {upper: frame, lower: hand}, b: {upper: frame, lower: hand, ribbon.width: 9 "
     "mm}}",
     "profile.member: missing; members differ, so name the one whose force is computed, such as a"},
    {"profile.member: 3\nstack.series: 2", "profile.member = member_3: there is no such member"},
    {"profile.member: b\nisometric.separation: 50 mm\nbodies: {hand: {}}\nmembers: {a: {upper: frame, lower: hand},"
     " b: {upper: frame, lower: hand, ribbon.length: 40 mm}}",
     "members.b: isometric.separation = 0.05 m: out of reach"},
    {"profile.member: b\nbodies: {hand: {}}\nmembers: {a: {upper: frame, lower: hand},"
     " b: {upper: frame, lower: hand, insulator.thickness: 0}}",
     "members.b: insulator.thickness = 0 m"},
};

TESTS(wrong_profiles_are_refused, 0, LENGTH_OF(wrong_profiles)) {
  ck_scenario_refused(ZP_STUDY_PROFILE, wrong_profiles[_i].text, wrong_profiles[_i].says);
}

/* -- the language ---------------------------------------------------------------------------------- */

/* What a scenario of this text writes. */
static char *written(const char *from) {
  char *text = NULL;
  size_t size = 0;
  ZpScenario *s = new_scenario();
  FILE *file = open_memstream(&text, &size);
  ck_ok(zp_scenario_parse(s, from, strlen(from), "network.yaml", &err));
  ck_ok(zp_scenario_write(s, file, &err));
  ck_assert_int_eq(fclose(file), 0);
  return zp_test_owns(text, free);
}

/* It is read as the same: names, bodies and pairs. */
TEST(networks_are_written_and_read) {
  char *text = written(both_orders[0]);
  ck_assert_ptr_nonnull(strstr(text, "upper: frame"));
  ck_assert_ptr_nonnull(strstr(text, "lower: hook"));
  ck_assert_str_eq(text, written(text));
}

static const struct {
  const char *text, *says;
} wrong[] = {
    {"bodies: {hand: {mass: 8 g}}", "members: missing"},
    {"bodies: {hand: {mass: 8 g}}\nmembers: {m: {upper: frame}}", "members.m.lower: missing"},
    {"bodies: {hand: {mass: 8 g}}\nmembers: {m: {upper: frame, lower: hnad}}",
     "members.m.lower = hnad: there is no such body"},
    {"bodies: {hand: {mass: 8 g}, foot: {mass: 1 g}}\nmembers: {m: {upper: frame, lower: hand}}",
     "bodies.foot: nothing holds it"},
    {"bodies: {a: {}, b: {}}\nmembers: {m: {upper: a, lower: b}, n: {upper: b, lower: a}}", "no members lead from it"},
    {"bodies: {hand: {}}\nmembers: {m: {upper: hand, lower: hand}}", "both of its ends are at hand"},
    {"bodies: {body1: {}}\nmembers: {member1: {upper: body1, lower: body1}}",
     "yaml: members.member1: both of its ends are at body1"},
    {"bodies: {hand: {}}\nmembers: {m: {upper: frame, lower: hand, angle: 90 degree}}",
     "0 (it opens downwards) or 180"},
    {"bodies: {hand: {}, floor: {moves: none, at.y: -0.2}}\nmembers: {m: {upper: frame, lower: hand}, n: {upper: "
     "floor, lower: hand, "
     "angle: 180 degree}}",
     "apart by 23.6 mm too much"},
    {"bodies: {hand: {}, floor: {moves: none, at.y: 10 mm}}\nmembers: {m: {upper: frame, lower: floor}, n: {upper: "
     "frame, lower: hand}}",
     "apart by 10 mm too little"},
    {"bodies: {frame: {mass: 1 g}}", "frame is the body that always exists"},
    {"bodies: {Hand: {mass: 1 g}}", "is no name"},
    {"bodies: {hand: {}}\nmembers: {hand: {upper: frame, lower: hand}}", "hand is a name in bodies already"},
    {"bodies: {hand: {}}\nmembers: {m: {upper: frame, lower: hand}}\nload.mass: 20 g", "load.mass = 0.02 kg"},
    {"bodies: {hand: {}}\nmembers: {m: {upper: frame, lower: hand}}\nload.share: 0.3", "load.share = 0.3"},
    {"bodies: {hand: {}}\nmembers: {m: {upper: frame, lower: hand}}\nstack.series: 3", "stack.series = 3"},
    {"bodies: {hand: {moves: plane, inertia: 1 g cm2}}\nmembers: {m: {upper: frame, lower: hand}}\nactuator.kind: "
     "hinge",
     "actuator.kind electro_ribbon"},
    {"bodies: {a: {}, b: {}}\nmembers: {m: {upper: frame, lower: a}, n: {upper: a, lower: b}}\nactuator.kind: flange",
     "members.n.upper = a: the counter electrode stands still"},
    {"bodies: {hand: {}}\nmembers: {m: {upper: frame, lower: hand}}\nsprings: {s: {stiffness: 3 N/m}}",
     "springs.s.between: give two bodies"},
    {"bodies: {hand: {}}\nmembers: {m: {upper: frame, lower: hand}}\nsprings: {s: {between: [hand, hand]}}",
     "both ends are at hand"},
    {"bodies: {hand: {}}\nmembers: {m: {upper: frame, lower: hand}}\nsprings: {s: {between: [frame]}}",
     "takes two values, such as [frame, hand]"},
    {"bodies: {hand: {force: [1 N, 0]}}\nmembers: {m: {upper: frame, lower: hand}}", "to the right, must be 0"},
    {"bodies: {hand: {}}\nmembers: {m: {upper: [frame, hand], lower: hand}}", "takes one name, not a list"},
    {"bodies: {hand: {}}\nmembers: {m: {upper: frame, lower: hand, drive.voltage: 3 kV}}\ndrive.voltage: 0",
     "drive.voltage = 0 V"},
    {"bodies: {hand: {mas: 3 g}}\nmembers: {m: {upper: frame, lower: hand}}", "mass"},
    {"bodies: {hand: {moves: none}}\nmembers: {m: {upper: frame, lower: hand}}", "bodies: each one is held"},
    {"members: {m: {upper: frame, lower: hand}}", "bodies: missing; members.m is between bodies"},
    {"isometric.body: hand", "isometric.body = hand: there is no such body"},
    {"bodies: {hand: {}}\nmembers: {m: {upper: frame, lower: hand}}\nstudy: stationary\nsensitivity.by: "
     "members.m.upper",
     "members.m.upper says which bodies or ports are joined"},
};

TEST(arguments_are_refused_by_the_names_of_parts) {
  ZpScenario *s = new_scenario();
  ZpError err = {ZP_OK, ""};
  static const char text[] = "bodies: {hand: {}}\nmembers: {m: {upper: frame, lower: hand}}\n";
  ck_ok(zp_scenario_parse(s, text, strlen(text), "network.yaml", &err));
  ck_assert_int_eq(zp_scenario_set(s, "bodies.hand.mas=1 g", &err), ZP_BAD_INPUT);
  ck_assert_msg(strstr(err.message, "did you mean bodies.hand.mass?"), "%s", err.message);
}

TEST(messages_name_parts_as_the_scenario_does) {
  static const char *const key[][2] = {{"spring_1.stiffness", "springs.coil.stiffness"},
                                       {"body_2.mass", "bodies.foot.mass"},
                                       {"member_1.ribbon.width", "members.lifts.ribbon.width"},
                                       {"load.mass", "load.mass"}};
  const ZpActuatorDef def =
      def_of("bodies: {hand: {}, foot: {}}\nmembers: {lifts: {upper: frame, lower: hand}, low: {upper: hand, lower: "
             "foot}}\nsprings: {coil: {between: [frame, foot], stiffness: 2 N/m, rest: 10 mm}}\n");
  for (size_t k = 0; k < LENGTH_OF(key); k++)
    ck_assert_str_eq(ZP_KEY_SHOWN(&def, zp_key_find(key[k][0])), key[k][1]);
}

TESTS(wrong_networks_are_refused, 0, LENGTH_OF(wrong)) {
  ck_scenario_refused(ZP_STUDY_STATIONARY, wrong[_i].text, wrong[_i].says);
}
