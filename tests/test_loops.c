/* Eigenvalues of the loops of several controllers: of a network of one and of two that do not touch against single
 * actuators, whose small motions have other coordinates, and of a joint against its motion in time. docs/theory.md,
 * section 28. */
#include "network_util.h"

#define OF_ALL "study: modes\nmesh.nodes: 13\nliquid.model: none\ndrive.voltage: 9 kV\n"
#define PI     "proportional: 50 V/mm, integral: 200 V/mm/s, delay: 0.3 ms"
#define SUPPLY "source: {model: amplifier, resistance: 100 Mohm, capacitance: 20 pF, bandwidth: 500 Hz}"

static const ZpResult *modes_of(const char *text) {
  const ZpActuatorDef def = def_of(text);
  return answer_of(ZP_STUDY_MODES, &def);
}

static void agree(const char *name, double value, double as, double within) {
  printf("%s: %.9g, off by %.2g\n", name, value, fabs(value / as - 1));
  ck_near(value, as, within);
}

/* What an actuator has alone. */
static const struct {
  const char *single, *member;
} alone[] = {
    {"control: {kind: pi, " PI "}\nsetpoint.value: 38 mm\n", "control: {kind: pi, " PI "}, setpoint.value: 38 mm"},
    {"control: {kind: pi, signal: stroke, " PI "}\nsetpoint.value: 19 mm\n" SUPPLY "\n",
     "control: {kind: pi, signal: stroke, " PI "}, setpoint.value: 19 mm, " SUPPLY},
    {"control: {kind: boost_pi, signal: contraction, proportional: 1 kV, integral: 3 kV/s, delay: 1 ms,\n"
     "  boost_voltage: 100 V, boost_band: 0.2}\nsetpoint.value: 20 %\nsource: {model: amplifier, resistance: 50 "
     "Mohm}\n",
     "control: {kind: boost_pi, signal: contraction, proportional: 1 kV, integral: 3 kV/s, delay: 1 ms, "
     "boost_voltage: 100 V, boost_band: 0.2}, setpoint.value: 20 %, source: {model: amplifier, resistance: 50 Mohm}"},
    {"control: {kind: pi, signal: capacitance, proportional: 100 V/pF, integral: 300 V/pF/s}\nsetpoint.value: 12 pF\n",
     "control: {kind: pi, signal: capacitance, proportional: 100 V/pF, integral: 300 V/pF/s}, setpoint.value: 12 pF"},
};

static const ZpResult *single(size_t k) {
  char text[1024];
  snprintf(text, sizeof text, OF_ALL "load.mass: 20 g\n%s", alone[k].single);
  return modes_of(text);
}

static const char *const told[] = {"open_loop_growth_per_s", "open_loop_frequency_Hz", "loop_growth_1_per_s",
                                   "loop_frequency_1_Hz",    "loop_growth_2_per_s",    "loop_frequency_2_Hz"};

/* Alone the equilibrium is known to 1e-5 of the way. */
TESTS(network_of_one_has_one_loop, 0, LENGTH_OF(alone)) {
  char text[1024];
  snprintf(text, sizeof text, OF_ALL "bodies: {hand: {mass: 20 g}}\nmembers: {a: {upper: frame, lower: hand, %s}}\n",
           alone[_i].member);
  const ZpResult *one = single((size_t)_i), *network = modes_of(text);
  for (size_t k = 0; k < LENGTH_OF(told); k++)
    if (number(one, told[k]) != 0) agree(told[k], number(network, told[k]), number(one, told[k]), 1e-4);
  agree("voltage", number(network, "members.a.held_voltage_V"), number(one, "held_voltage_V"), 3e-5);
  ck_assert_double_eq(number(network, "held"), number(one, "held"));
}

/* Is this among the first eigenvalues of all? */
static void ck_has(const ZpResult *all, double growth, double frequency) {
  double least = INFINITY;
  for (int k = 1; k <= 4; k++) {
    char name[2][32];
    snprintf(name[0], sizeof name[0], "loop_growth_%d_per_s", k);
    snprintf(name[1], sizeof name[1], "loop_frequency_%d_Hz", k);
    least =
        fmin(least, hypot(number(all, name[0]) / growth - 1, frequency > 0 ? number(all, name[1]) / frequency - 1 : 0));
  }
  printf("%g 1/s: off by %.2g\n", growth, least);
  ck_below(least, 1.2e-5); /* 4.0e-6 measured */
}

/* Two that do not touch: the slowest motion of each is one of both. In a stack, too, where one of them is held. */
TEST(members_apart_have_the_loops_of_each) {
  char text[2048];
  snprintf(text, sizeof text,
           OF_ALL "bodies: {hand: {mass: 20 g}, foot: {mass: 20 g}}\nmembers:\n"
                  "  a: {upper: frame, lower: hand, %s}\n  b: {upper: frame, lower: foot, %s}\n",
           alone[0].member, alone[1].member);
  const ZpResult *both = modes_of(text);
  for (size_t k = 0; k < 2; k++) {
    const ZpResult *one = single(k);
    ck_has(both, number(one, "loop_growth_1_per_s"), number(one, "loop_frequency_1_Hz"));
    agree("voltage", number(both, k ? "members.b.held_voltage_V" : "members.a.held_voltage_V"),
          number(one, "held_voltage_V"), 3e-5);
  }
}

/* Two equal members on one port: as one with half the gain for twice the capacitance. */
TEST(port_of_two_has_one_loop) {
  const ZpResult *one = single(3),
                 *both = modes_of(OF_ALL "bodies: {hand: {mass: 20 g}, foot: {mass: 20 g}}\nmembers:\n"
                                         "  a: {upper: frame, lower: hand, port: p, control: {kind: pi,\n"
                                         "      signal: capacitance, proportional: 50 V/pF, integral: 150 V/pF/s},\n"
                                         "      setpoint.value: 24 pF}\n"
                                         "  b: {upper: frame, lower: foot, port: p}\n");
  ck_has(both, number(one, "loop_growth_1_per_s"), number(one, "loop_frequency_1_Hz"));
}

#define JOINT                                                                                                          \
  "bodies:\n  forearm: {moves: plane, mass: 12 g, inertia: 2000 g mm2, at: [0, -8 mm]}\n"                              \
  "joints:\n  pivot: {type: pin, between: [frame, forearm], at: [0, 6 mm]}\n"                                          \
  "mesh.nodes: 31\ndamping.internal: 2 ms\nmembers:\n"                                                                 \
  "  left: {upper: frame, lower: forearm, upper_at: [-60 mm, 0], lower_at: [-60 mm, 0], %s}\n"                         \
  "  right: {upper: frame, lower: forearm, upper_at: [60 mm, 0], lower_at: [60 mm, 0], drive.voltage: 8 kV,\n"         \
  "    control: {kind: pi, signal: angle, period: 5 ms, proportional: 2 kV/rad, integral: 400 kV/rad/s},\n"            \
  "    setpoint.value: 0.7 degree}\n"

static ZpActuatorDef joint(const char *study, const char *left) {
  char text[2048];
  snprintf(text, sizeof text,
           JOINT "study: %s\nsolver: {end_time: 2.5 s, stop_when_zipped: false}\noutput.samples: 2000\n", left, study);
  return def_of(text);
}

/* How far the angle is from the setpoint of 0.7 degrees, rad. */
static double off(const ZpTable *series, size_t row) {
  return zp_table_get(series, row, "forearm.angle_rad") - 0.7 * 3.14159265358979323846 / 180;
}

/* The angle comes to its setpoint against an antagonist at 1 kV as the slowest motion of the loop decays. */
TEST(joint_decays_as_its_loop_says) {
  const ZpActuatorDef rest = joint("modes", "drive.voltage: 1 kV"), motion = joint("actuate", "drive.voltage: 1 kV");
  const ZpResult *loop = answer_of(ZP_STUDY_MODES, &rest), *run = answer_of(ZP_STUDY_ACTUATE, &motion);
  size_t to = run->series->rows - 1, from;
  while (fabs(off(run->series, to)) < 1e-8)
    to--;
  for (from = to; fabs(off(run->series, from)) < 1e-6; from--)
    ;
  const double span = zp_table_get(run->series, to, "time_s") - zp_table_get(run->series, from, "time_s");
  ck_assert_double_eq(number(loop, "loop_frequency_1_Hz"), 0);
  ck_assert(number(loop, "held") == 1);
  agree("decay", log(off(run->series, to) / off(run->series, from)) / span, number(loop, "loop_growth_1_per_s"), 1e-2);
  agree("voltage", zp_table_get(run->series, run->series->rows - 1, "right.voltage_V"),
        number(loop, "members.right.held_voltage_V"), 1e-4);
}

/* A controller that would have to push stays at 0 V: a joint with two is at rest as with one. */
TEST(controllers_do_not_push) {
  const ZpActuatorDef two =
                          joint("modes", "drive.voltage: 8 kV, control: {kind: pi, signal: angle, period: 5 ms, "
                                         "proportional: 2 kV/rad, integral: 400 kV/rad/s}, setpoint.value: 0.7 degree"),
                      one = joint("modes", "drive.voltage: 0");
  const ZpResult *both = answer_of(ZP_STUDY_MODES, &two), *right = answer_of(ZP_STUDY_MODES, &one);
  ck_assert_double_eq(number(both, "members.left.held_voltage_V"), 0);
  agree("voltage", number(both, "members.right.held_voltage_V"), number(right, "members.right.held_voltage_V"), 1e-12);
  agree("loop", number(both, "loop_growth_1_per_s"), number(right, "loop_growth_1_per_s"), 1e-9);
}

/* A setpoint that is more open than all hangs cannot be held. */
TEST(setpoint_beyond_hanging_is_not_held) {
  const ZpResult *result = modes_of(OF_ALL "bodies: {hand: {mass: 20 g}}\nmembers: {a: {upper: frame, lower: hand, "
                                           "control: {kind: pi, " PI "}, setpoint.value: 70 mm}}\n");
  ck_assert(number(result, "held") == 0);
}

static const struct {
  const char *text, *says;
} wrong[] = {
    {"stack.parallel: 2\nmember_1: {control.kind: pi, setpoint.value: 5 mm}\n"
     "member_2: {control: {kind: pi, period: 2 ms}, setpoint.value: 5 mm}",
     "control.period = 0.002 s: the eigenvalues of several loops"},
    {"stack.parallel: 2\nmember_1: {control.kind: pi, setpoint.value: 5 mm}\nliquid.model: bead",
     "without liquid only"},
    {"bodies: {hand: {}}\nmembers: {a: {upper: frame, lower: hand}}\ncontrol.kind: pi\nsetpoint.value: 5 mm\n"
     "liquid.model: bead",
     "without liquid only"},
    {"stack.parallel: 2\nmember_1: {control: {kind: boost_pi, boost_voltage: 1 kV, signal: stroke}, setpoint.value: 0}",
     "there the boost acts in full"},
    {"actuator.symmetry: none\nplatform: {rotates: true, electrode: false}\n"
     "control: {kind: pi, signal: angle}\nsetpoint.value: 1 degree",
     "angle of a body only"},
};

TESTS(wrong_loops_are_refused, 0, LENGTH_OF(wrong)) {
  char text[1024];
  snprintf(text, sizeof text, "%s%s\n", strstr(wrong[_i].text, "liquid") ? "" : "liquid.model: none\n", wrong[_i].text);
  ck_scenario_refused(ZP_STUDY_MODES, text, wrong[_i].says);
}
