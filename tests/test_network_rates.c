/* Derivatives of runs of stacks and networks by keys of members, bodies, joints and springs: against differences of
 * whole runs with the same steps, single actuators and symmetry. docs/theory.md, section 20. */
#include "network_util.h"

#define ALL "study: actuate\nmesh.nodes: 11\nliquid.model: none\n"
#define RUNS(steps, end)                                                                                               \
  ALL "solver: {tolerance: 1e-7, time_step: " steps ", end_time: " end ", stop_when_zipped: false}\n"

#define ANGLE                                                                                                          \
  "control: {kind: pi, signal: angle, proportional: 80 kV/rad, integral: 500 kV/rad/s, period: 1 ms}, "                \
  "setpoint.value: -0.5 degree"

static ZpResult *run_by(const ZpActuatorDef *given, const char *by) {
  ZpActuatorDef def = *given;
  ck_assert_int_eq(zp_def_set_text(&def, zp_key_find("sensitivity.by"), by, NULL), ZP_OK);
  return answer_of(ZP_STUDY_ACTUATE, &def);
}

/* -- against differences of whole runs ------------------------------------------------------------- */

/* Steps are so short that the drive limits none. */
typedef struct Run {
  const char *name, *text;
} Run;

static const Run
    tree = {"tree", RUNS("1e-4", "15 ms") "drive.voltage: 4 kV\n"
                                          "bodies:\n  bar: {mass: 2 g}\n  hand: {mass: 12 g, force: [0, -10 mN]}\n"
                                          "  foot: {mass: 6 g}\n  floor: {moves: none, at: [0, -90 mm]}\n"
                                          "members:\n  a: {upper: frame, lower: bar}\n"
                                          "  b: {upper: bar, lower: hand, ribbon: {thickness: 60 um, length: 101 mm}}\n"
                                          "  c: {upper: bar, lower: hand}\n"
                                          "  d: {upper: floor, lower: foot, angle: 180 degree, drive.voltage: 1 kV}\n"
                                          "  e: {upper: bar, lower: foot}\n"
                                          "springs: {s: {between: [frame, foot], stiffness: 3 N/m, rest: 10 mm}}\n"},
    joint = {"joint",
             RUNS("2e-4", "30 ms") "drive.voltage: 5 kV\n"
                                   "bodies:\n  arm: {moves: plane, mass: 12 g, inertia: 2000 g mm2, at: [0, -8 mm]}\n"
                                   "joints:\n  pivot: {type: pin, between: [frame, arm], at: [0, 6 mm]}\n"
                                   "members:\n  left: {upper: frame, lower: arm, upper_at: [-60 mm, 0],\n"
                                   "    lower_at: [-60 mm, 0], ribbon: {thickness: 100 um, length: 100 mm}}\n"
                                   "  right: {upper: frame, lower: arm, upper_at: [60 mm, 0],\n"
                                   "    lower_at: [60 mm, 0], drive.voltage: 2 kV}\n"
                                   "springs: {s: {between: [frame, arm], from_at: [20 mm, 30 mm], to_at: [30 mm, 0],\n"
                                   "  stiffness: 4 N/m, rest: 20 mm}}\n"},
    ports = {"ports",
             RUNS("1e-4", "20 ms") "drive.voltage: 3 kV\nbodies: {hand: {mass: 8 g}, foot: {mass: 6 g}}\n"
                                   "members:\n  a: {upper: frame, lower: hand, port: own,\n"
                                   "    drive: {voltage: 4 kV, waveform: ramp, rise_time: 8 ms},\n"
                                   "    source: {model: amplifier, resistance: 50 Mohm, capacitance: 40 pF}}\n"
                                   "  b: {upper: hand, lower: foot, source: {model: amplifier, resistance: 10 Mohm,\n"
                                   "    slew_rate: 0.97 V/us, bandwidth: 100 Hz}}\n"},
    column = {"column", RUNS("5e-5", "250 ms") "drive.voltage: 9 kV\n"
                                               "bodies: {link: {mass: 2 g}, hand: {mass: 8 g}}\n"
                                               "members:\n  top: {upper: frame, lower: link, drive.voltage: 10 kV}\n"
                                               "  low: {upper: link, lower: hand, ribbon.thickness: 90 um}\n"},
    until = {"until zipped",
             ALL "solver: {tolerance: 1e-7, time_step: 5e-5, end_time: 250 ms, stop_when_zipped: true}\n"
                 "drive.voltage: 9 kV\nbodies: {link: {mass: 2 g}, hand: {mass: 8 g}}\n"
                 "members:\n  low: {upper: link, lower: hand, ribbon.thickness: 120 um}\n"
                 "  top: {upper: frame, lower: link, drive.voltage: 12 kV}\n"},
    bath = {"bath", "study: actuate\nmesh.nodes: 11\nliquid.model: submerged\n"
                    "solver: {tolerance: 1e-7, time_step: 5e-4, end_time: 60 ms, stop_when_zipped: false}\n"
                    "drive.voltage: 6 kV\nbodies: {hand: {mass: 20 g}}\n"
                    "members:\n  a: {upper: frame, lower: hand}\n"
                    "  b: {upper: frame, lower: hand, ribbon.thickness: 90 um}\n"},
    opposed = {"antagonists", RUNS("1e-4", "20 ms") "load.mass: 8 g\ndrive.voltage: 6 kV\n"
                                                    "stack: {series: 2, distance: 50 mm, voltage_ratio: 0.5}\n"},
    held = {"held joint",
            RUNS("2e-4", "30 ms") "bodies:\n  arm: {moves: plane, mass: 12 g, inertia: 2000 g mm2, at: [0, -8 mm]}\n"
                                  "joints:\n  pivot: {type: pin, between: [frame, arm], at: [0, 6 mm]}\n"
                                  "members:\n"
                                  "  left: {upper: frame, lower: arm, upper_at: [-60 mm, 0], lower_at: [-60 mm, 0],\n"
                                  "    drive.voltage: 8 kV, " ANGLE "}\n"
                                  "  right: {upper: frame, lower: arm, upper_at: [60 mm, 0], lower_at: [60 mm, 0],\n"
                                  "    drive.voltage: 8 kV, " ANGLE "}\n"},
    loop = {"loop", RUNS("1e-4", "30 ms") "load.mass: 8 g\ndrive.voltage: 8 kV\nsetpoint.value: 15 mm\n"
                                          "control: {kind: pi, signal: opening, proportional: 100 kV/m,\n"
                                          "  integral: 20 MV/m/s, period: 1 ms, delay: 1.5 ms}\n"
                                          "source: {model: amplifier, resistance: 10 Mohm, capacitance: 20 pF}\n"},
    series = {"series", RUNS("1e-4", "20 ms") "load.mass: 8 g\ndrive.voltage: 6 kV\n"
                                              "stack: {series: 3, link_mass: 2 g}\nmember_2.ribbon.thickness: 90 um\n"};

/* Of fourth order. */
static double difference(const ZpActuatorDef *def, const char *output, const char *key, double part) {
  static const double weight[] = {1, -8, 0, 8, -1};
  const double value = zp_def_get(def, zp_key_find(key)), step = part * fabs(value);
  double sum = 0;
  for (int k = -2; k <= 2; k++) {
    ZpActuatorDef near = *def;
    if (k == 0) continue;
    set_member(&near, key, value + k * step);
    sum += weight[k + 2] / (12 * step) * number(answer_of(ZP_STUDY_ACTUATE, &near), output);
  }
  return sum;
}

static const struct {
  const Run *run;
  const char *output, *key;
  double part, within;
} row[] = {
    {&tree, "bodies.hand.y_m", "member_2.ribbon.thickness", 1e-5, 5e-8},    /* 1.8e-8 measured */
    {&tree, "bodies.hand.y_m", "member_2.ribbon.length", 1e-5, 7e-8},       /* 2.5e-8 */
    {&tree, "bodies.foot.y_m", "spring_1.stiffness", 1e-5, 2.5e-8},         /* 8.5e-9 */
    {&tree, "bodies.foot.y_m", "spring_1.rest", 1e-5, 1.8e-7},              /* 6.2e-8 */
    {&tree, "bodies.foot.y_m", "body_1.mass", 1e-4, 7e-8},                  /* 2.3e-8 */
    {&tree, "bodies.bar.y_m", "body_4.at.y", 1e-5, 1.1e-7},                 /* 3.8e-8 */
    {&tree, "bodies.bar.y_m", "body_2.force.y", 1e-4, 1e-6},                /* 3.4e-7 */
    {&tree, "members.d.opening_m", "member_4.drive.voltage", 1e-4, 2.1e-5}, /* 7.2e-6: it hardly moves */
    {&tree, "source_energy_J", "gravity", 1e-5, 1e-6},                      /* 3.3e-7 */
    {&tree, "source_energy_J", "drive.voltage", 1e-5, 1.5e-7},              /* 5.3e-8 */
    /* rounding of positions stretches ribbons, which pushes the arm */
    {&joint, "bodies.arm.angle_rad", "spring_1.stiffness", 1e-4, 1e-5},        /* 3.4e-6 */
    {&joint, "bodies.arm.angle_rad", "body_1.inertia", 1e-4, 5e-5},            /* 1.6e-5 */
    {&joint, "bodies.arm.angle_rad", "member_1.ribbon.thickness", 1e-5, 7e-6}, /* 2.5e-6 */
    {&joint, "bodies.arm.x_m", "member_1.ribbon.length", 1e-5, 7e-6},          /* 2.5e-6 */
    {&joint, "bodies.arm.angle_rad", "joint_1.at.y", 1e-5, 4e-7},              /* 1.4e-7 */
    {&joint, "members.left.opening_m", "member_1.upper_at.x", 1e-6, 1e-8},     /* 4.3e-12 */
    {&joint, "source_energy_J", "ribbon.length", 1e-5, 2.2e-5},                /* 7.7e-6 */
    {&ports, "bodies.foot.y_m", "member_2.source.slew_rate", 1e-3, 2.1e-3},    /* 7.3e-4: it hardly moves */
    {&ports, "source_energy_J", "member_1.source.resistance", 1e-4, 8e-7},     /* 2.6e-7 */
    {&ports, "source_energy_J", "member_1.drive.rise_time", 1e-4, 9e-4},   /* 3.1e-4, of other steps between corners */
    {&ports, "source_energy_J", "member_2.source.resistance", 1e-4, 9e-6}, /* 3.0e-6 */
    {&ports, "bodies.hand.y_m", "body_2.mass", 1e-4, 6e-8},                /* 2.3e-8 */
    {&column, "zip_time_s", "member_2.ribbon.thickness", 3e-7, 4e-5},      /* 1.3e-5, of landings that differ */
    {&column, "members.top.zip_time_s", "member_2.ribbon.thickness", 3e-7, 4e-5},
    {&column, "members.low.zip_time_s", "member_1.drive.voltage", 1e-4, 2.3e-6}, /* 7.8e-7 */
    {&until, "zip_time_s", "body_1.mass", 1e-5, 1.2e-4},                         /* 3.9e-5, of landings that differ */
    {&until, "source_energy_J", "body_1.mass", 1e-5, 9e-5},                      /* 3.0e-5 */
    {&until, "members.top.opening_m", "body_1.mass", 1e-5, 6e-6},                /* 2.1e-6 */
    {&bath, "bodies.hand.y_m", "member_2.ribbon.thickness", 1e-5, 1.8e-8},       /* 6.3e-9 */
    {&bath, "viscous_loss_J", "medium.kinematic_viscosity", 1e-5, 2e-7},         /* 6.9e-8 */
    {&opposed, "opening_m", "stack.distance", 1e-5, 3e-8},                       /* 1.1e-8 */
    {&opposed, "opening_m", "stack.voltage_ratio", 1e-4, 5e-7},                  /* 1.8e-7 */
    {&held, "bodies.arm.angle_rad", "body_1.inertia", 1e-4, 4.2e-4},             /* 1.4e-4: it hardly moves */
    {&held, "bodies.arm.angle_rad", "member_1.setpoint.value", 1e-4, 2.3e-5},    /* 7.8e-6 */
    {&held, "source_energy_J", "member_1.control.proportional", 1e-4, 4e-6},     /* 1.4e-6 */
    {&held, "source_energy_J", "member_1.control.integral", 1e-4, 6.5e-5},       /* 2.2e-5 */
    {&loop, "opening_m", "control.integral", 1e-4, 2e-5},                        /* 7.1e-6 */
    {&loop, "opening_m", "control.proportional", 1e-4, 1.8e-5},                  /* 6.0e-6 */
    {&loop, "opening_m", "ribbon.thickness", 1e-5, 3e-7},                        /* 1.1e-7 */
    {&loop, "source_energy_J", "source.resistance", 1e-4, 1.2e-5},               /* 4.3e-6 */
    {&series, "opening_m", "member_2.ribbon.thickness", 1e-6, 2.5e-6},           /* 9.8e-7 */
    {&series, "contraction", "stack.link_mass", 1e-5, 2.4e-5},                   /* 8.1e-6 */
};

TESTS(derivatives_are_differences, 0, LENGTH_OF(row)) {
  const ZpActuatorDef def = def_of(row[_i].run->text);
  const char *output = row[_i].output, *key = row[_i].key;
  const double rate = slope_in(run_by(&def, key), output, key), by_runs = difference(&def, output, key, row[_i].part);
  printf("%s, %s by %s: %.10g, off by %.2g\n", row[_i].run->name, output, key, rate, fabs(rate / by_runs - 1));
  ck_near(rate, by_runs, row[_i].within);
}

/* -- single actuators and symmetry ----------------------------------------------------------------- */

#define DRY   RUNS("1e-4", "20 ms") "drive.voltage: 8 kV\n"
#define ALONE DRY "load.mass: 8 g\n"

/* An actuator is the same as the only member of a network. */
TEST(network_of_one_has_those_of_its_member) {
  static const char *const same[][2] = {{"bodies.hand.y_m", "opening_m"},
                                        {"members.only.opening_m", "opening_m"},
                                        {"source_energy_J", "source_energy_J"},
                                        {"charge_C", "charge_C"}};
  const ZpActuatorDef one = def_of(ALONE),
                      network =
                          def_of(DRY "bodies: {hand: {mass: 8 g}}\nmembers: {only: {upper: frame, lower: hand}}\n");
  const ZpResult *a = run_by(&one, "ribbon.thickness"), *b = run_by(&network, "ribbon.thickness");
  for (size_t k = 0; k < LENGTH_OF(same); k++) {
    const double alone = slope_in(a, same[k][1], "ribbon.thickness"),
                 joined = slope_in(b, same[k][0], "ribbon.thickness");
    printf("%s: off by %.2g\n", same[k][0], fabs(fabs(joined / alone) - 1));
    ck_near(fabs(joined), fabs(alone), 1e-14); /* 0 measured */
  }
}

/* Two equal members side by side with the double load are as one; a key of both moves them as it moves one. */
TEST(equal_members_have_those_of_one) {
  const ZpActuatorDef one = def_of(ALONE),
                      two = def_of(DRY "bodies: {hand: {mass: 16 g}}\nmembers:\n  a: {upper: frame, lower: hand}\n"
                                       "  b: {upper: frame, lower: hand}\n");
  static const char *const by[] = {"ribbon.thickness", "drive.voltage", "insulator.thickness"};
  for (size_t k = 0; k < LENGTH_OF(by); k++) {
    const ZpResult *a = run_by(&one, by[k]), *b = run_by(&two, by[k]);
    const double alone = slope_in(a, "opening_m", by[k]), joined = slope_in(b, "members.b.opening_m", by[k]);
    printf("by %s: off by %.2g, energy %.2g\n", by[k], fabs(joined / alone - 1),
           fabs(slope_in(b, "source_energy_J", by[k]) / slope_in(a, "source_energy_J", by[k]) / 2 - 1));
    ck_near(joined, alone, 2.6e-7); /* 8.8e-8 measured */
    ck_near(slope_in(b, "source_energy_J", by[k]), 2 * slope_in(a, "source_energy_J", by[k]), 2.7e-6); /* 9.1e-7 */
  }
}

/* A key of all members is that of each of them together, eq. (20.6) being linear. */
TEST(key_of_all_is_the_sum_over_members) {
  const ZpActuatorDef def = def_of(DRY
                                   "bodies: {link: {mass: 3 g}, hand: {mass: 8 g}}\nmembers:\n"
                                   "  a: {upper: frame, lower: link, ribbon.thickness: 130 um, drive.voltage: 8 kV}\n"
                                   "  b: {upper: link, lower: hand, ribbon.thickness: 130 um, drive.voltage: 8 kV}\n"),
                      all = def_of(DRY "ribbon.thickness: 130 um\nbodies: {link: {mass: 3 g}, hand: {mass: 8 g}}\n"
                                       "members:\n  a: {upper: frame, lower: link}\n  b: {upper: link, lower: hand}\n");
  static const char *const key[] = {"ribbon.thickness", "drive.voltage"};
  for (size_t k = 0; k < LENGTH_OF(key); k++) {
    char of[2][64], both[256];
    snprintf(of[0], sizeof *of, "member_1.%s", key[k]);
    snprintf(of[1], sizeof *of, "member_2.%s", key[k]);
    snprintf(both, sizeof both, "%s, %s", of[0], of[1]);
    const ZpResult *a = run_by(&def, both), *b = run_by(&all, key[k]);
    const double sum = slope_in(a, "bodies.hand.y_m", of[0]) + slope_in(a, "bodies.hand.y_m", of[1]),
                 whole = slope_in(b, "bodies.hand.y_m", key[k]);
    printf("by %s: %.9g, off by %.2g\n", key[k], whole, fabs(sum / whole - 1));
    ck_near(sum, whole, 7e-6); /* 2.4e-6 measured: first touches between the points of a difference */
  }
}

/* -- where there are none -------------------------------------------------------------------------- */

#define RAMPS                                                                                                          \
  DRY "bodies: {hand: {mass: 8 g}, foot: {mass: 6 g}}\nmembers:\n"                                                     \
      "  a: {upper: frame, lower: hand, drive: {voltage: 4 kV, waveform: ramp, rise_time: 8 ms}}\n"

/* Of two ramps that end together one ends before or after the other where its own key moves it. */
TEST(corners_that_part_end_them) {
  const ZpActuatorDef together = def_of(RAMPS "  b: {upper: frame, lower: foot, drive: {voltage: 4 kV, waveform: ramp, "
                                              "rise_time: 8 ms}}\n"),
                      apart = def_of(RAMPS "  b: {upper: frame, lower: foot, drive: {voltage: 4 kV, waveform: ramp, "
                                           "rise_time: 9 ms}}\n");
  const ZpResult *result = run_by(&together, "member_1.drive.rise_time");
  ck_assert(isnan(slope_in(result, "bodies.hand.y_m", "member_1.drive.rise_time")));
  ck_assert_ptr_nonnull(note_of(result, "the key moves one of several corners of inputs that coincide"));
  ck_assert(
      isfinite(slope_in(run_by(&apart, "member_1.drive.rise_time"), "bodies.hand.y_m", "member_1.drive.rise_time")));
  ck_assert(isfinite(slope_in(run_by(&together, "body_1.mass"), "bodies.hand.y_m", "body_1.mass")));
}

/* Two members close at once. By a key of one the instant at which all have closed turns from the one to the other. */
TEST(instant_of_several_has_none) {
  const ZpActuatorDef def =
      def_of(RUNS("5e-5", "250 ms") "drive.voltage: 10 kV\nbodies: {hand: {mass: 8 g}, foot: {mass: 8 g}}\n"
                                    "members:\n  a: {upper: frame, lower: hand, ribbon.thickness: 130 um}\n"
                                    "  b: {upper: frame, lower: foot, ribbon.thickness: 130 um}\n");
  const ZpResult *result = run_by(&def, "member_1.ribbon.thickness, drive.voltage");
  ck_assert(isnan(slope_in(result, "zip_time_s", "member_1.ribbon.thickness")));
  ck_assert(isfinite(slope_in(result, "members.a.zip_time_s", "member_1.ribbon.thickness")));
  ck_below(fabs(slope_in(result, "members.b.zip_time_s", "member_1.ribbon.thickness")),
           1e-9 * fabs(slope_in(result, "members.a.zip_time_s", "member_1.ribbon.thickness")));
  ck_near(slope_in(result, "zip_time_s", "drive.voltage"), slope_in(result, "members.b.zip_time_s", "drive.voltage"),
          1e-6);
}

/* Two members close in the last step, the one a little before the other: each at its own instant. */
TEST(last_step_has_several_closings) {
  const ZpActuatorDef def =
      def_of(ALL "solver: {tolerance: 1e-7, time_step: 5e-5, end_time: 250 ms, stop_when_zipped: true}\n"
                 "drive.voltage: 10 kV\nbodies: {hand: {mass: 8 g}, foot: {mass: 8.0001 g}}\n"
                 "members:\n  a: {upper: frame, lower: hand}\n  b: {upper: frame, lower: foot}\n");
  const ZpResult *result = run_by(&def, "body_1.mass, body_2.mass");
  const double apart = number(result, "members.b.zip_time_s") - number(result, "members.a.zip_time_s");
  const double own = slope_in(result, "members.a.zip_time_s", "body_1.mass"),
               of_last = slope_in(result, "zip_time_s", "body_2.mass");
  printf("%.3g s apart, %.9g and %.9g s/kg\n", apart, own, of_last);
  ck_assert(apart > 0 && apart < 5e-6);
  ck_below(fabs(slope_in(result, "members.a.zip_time_s", "body_2.mass")),
           2.4e-4 * own); /* 8.0e-5 measured: its step ends with that of the other */
  ck_below(fabs(slope_in(result, "zip_time_s", "body_1.mass")), 3.8e-9 * own); /* 1.3e-9 */
}

#define SQUARES                                                                                                        \
  "drive.voltage: 8 kV, control: {kind: pi, signal: angle, proportional: 80 kV/rad, integral: 2000 kV/rad/s}, "        \
  "setpoint: {waveform: square, value: 2 degree, offset: -2 degree, frequency: 1 Hz, rise_time: 100 ms}"

/* Regression: with steps of the key as small as elsewhere, rounding that stretches ribbons turned an arm by so much
 * that a step had no derivative. */
TEST(noise_ends_no_derivatives) {
  const ZpActuatorDef def =
      def_of(RUNS("2e-4", "60 ms") "damping.drag: 0.02 N s2/m2\n"
                                   "bodies:\n  arm: {moves: plane, mass: 12 g, inertia: 2000 g mm2, at: [0, -8 mm]}\n"
                                   "joints:\n  pivot: {type: pin, between: [frame, arm], at: [0, 6 mm]}\nmembers:\n"
                                   "  left: {upper: frame, lower: arm, upper_at: [-60 mm, 0], lower_at: [-60 mm, 0],\n"
                                   "    " SQUARES "}\n"
                                   "  right: {upper: frame, lower: arm, upper_at: [60 mm, 0], lower_at: [60 mm, 0],\n"
                                   "    " SQUARES "}\n");
  ck_assert_uint_eq(notes_with(run_by(&def, "gravity"), "there are no derivatives"), 0);
}

/* What is said of a key has the name that its scenario gives it. */
TEST(keys_have_their_names) {
  ZpError err = {ZP_OK, ""};
  ZpActuatorDef def = def_of(joint.text);
  snprintf(def.sensitivity.by, sizeof def.sensitivity.by, "member_2.ribbon.thickness");
  ck_assert_int_eq(zp_study_check(ZP_STUDY_ACTUATE, &def, &err), ZP_BAD_INPUT);
  ck_assert_ptr_nonnull(strstr(err.message, "members.right.ribbon.thickness is auto: give it a number"));
}
