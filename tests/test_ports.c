/* Ports: members with drives, sources and controllers of their own, against single actuators that have them, against
 * ports that share a source, and against tables. docs/theory.md, section 33. */
#include "network_util.h"

#include "def/rule.h"
#include "run/run.h"

#define OF_ALL   "study: actuate\nmesh.nodes: 21\nliquid.model: none\nsolver.stop_when_zipped: false\n"
#define UNTIL(t) OF_ALL "solver.end_time: " t "\n"
#define USUAL    UNTIL("60 ms")
#define TWO      "bodies: {hand: {mass: 20 g}, foot: {mass: 14 g}}\n"
#define EQUAL    "bodies: {hand: {mass: 20 g}, foot: {mass: 20 g}}\n"
#define BEHIND   "source: {model: amplifier, resistance: 100 Mohm, capacitance: 20 pF}"

static double at_end(const ZpResult *result, const char *column) {
  return zp_table_get(result->series, result->series->rows - 1, column);
}

static const ZpResult *run(const char *text) {
  const ZpActuatorDef def = def_of(text);
  return answer_of(ZP_STUDY_ACTUATE, &def);
}

static void agree(const char *name, double value, double as, double within) {
  printf("%s: %.12g, off by %.2g\n", name, value, fabs(value / as - 1));
  ck_near(value, as, within);
}

TEST(source_of_a_member_is_a_source) {
  const ZpResult *one = run(USUAL "load.mass: 20 g\ndrive.voltage: 9 kV\n" BEHIND "\n"),
                 *all = run(USUAL "drive.voltage: 9 kV\n" BEHIND "\nbodies: {hand: {mass: 20 g}}\n"
                                  "members: {a: {upper: frame, lower: hand}}\n"),
                 *own = run(USUAL "drive.voltage: 6 kV\nbodies: {hand: {mass: 20 g}}\n"
                                  "members: {a: {upper: frame, lower: hand, drive.voltage: 9 kV, " BEHIND "}}\n");
  static const char *const same[] = {"charge_C", "source_energy_J", "source_loss_J", "cable_energy_J"};
  for (size_t k = 0; k < LENGTH_OF(same); k++) {
    agree(same[k], at_end(all, same[k]), at_end(one, same[k]), 1e-14);
    agree(same[k], at_end(own, same[k]), at_end(one, same[k]), 1e-14);
  }
  ck_assert_double_eq(number(own, "steps"), number(one, "steps"));
  ck_near(number(own, "peak_current_A"), number(one, "peak_current_A"), 1e-14);
}

/* Equal members behind a source each are as one behind its own, and as both on one port with the half resistance and
 * twice the cable. */
TEST(ports_take_what_their_members_take) {
  static const char same[] = "source: {model: amplifier, resistance: 50 Mohm, capacitance: 40 pF}";
  char port[1024];
  snprintf(port, sizeof port,
           USUAL
           "drive.voltage: 9 kV\n" EQUAL
           "members:\n  a: {upper: frame, lower: hand, port: both, %s}\n  b: {upper: frame, lower: foot, port: both}\n",
           same);
  const ZpResult *one = run(USUAL "load.mass: 20 g\ndrive.voltage: 9 kV\n" BEHIND "\n"),
                 *apart = run(USUAL "drive.voltage: 9 kV\n" EQUAL "members:\n  a: {upper: frame, lower: hand, " BEHIND
                                    "}\n  b: {upper: frame, lower: foot, " BEHIND "}\n"),
                 *shared = run(port);
  agree("opening", at_end(apart, "a.opening_m"), at_end(one, "opening_m"), 6e-13);     /* 6.0e-14 measured */
  agree("opening", at_end(apart, "b.opening_m"), at_end(apart, "a.opening_m"), 1e-14); /* 0 measured */
  agree("energy", at_end(apart, "source_energy_J"), 2 * at_end(one, "source_energy_J"), 1e-12);
  agree("energy", at_end(shared, "source_energy_J"), at_end(apart, "source_energy_J"), 1e-12);
  agree("lost", at_end(shared, "source_loss_J"), at_end(apart, "source_loss_J"), 1e-12);
  agree("cable", at_end(shared, "cable_energy_J"), at_end(apart, "cable_energy_J"), 1e-12);
  agree("opening", at_end(shared, "b.opening_m"), at_end(apart, "b.opening_m"), 1e-12);
  ck_assert(isnan(number(apart, "peak_current_A")));
}

/* A controller has the voltage of its port, and measures the first member on it. */
TEST(controller_has_a_port) {
  static const char pi[] = "control: {kind: pi, proportional: 0.5 kV/mm, integral: 20 kV/mm/s}, setpoint.value: 38 mm";
  char text[1024];
  snprintf(text, sizeof text,
           USUAL "drive.voltage: 9 kV\nbodies: {hand: {mass: 20 g}, foot: {mass: 20 g}, rest: {mass: 14 g}}\n"
                 "members:\n  c: {upper: frame, lower: rest}\n  a: {upper: frame, lower: hand, port: p, %s}\n"
                 "  b: {upper: frame, lower: foot, port: p}\n",
           pi);
  const ZpResult *all = run(text);
  snprintf(text, sizeof text,
           USUAL "load.mass: 20 g\ndrive.voltage: 9 kV\n"
                 "control: {kind: pi, proportional: 0.5 kV/mm, integral: 20 kV/mm/s}\n"
                 "setpoint.value: 38 mm\n");
  const ZpResult *one = run(text);
  agree("voltage", at_end(all, "a.voltage_V"), at_end(one, "voltage_V"), 1e-4);
  ck_assert_double_eq(at_end(all, "b.voltage_V"), at_end(all, "a.voltage_V"));
  ck_assert_double_eq(at_end(all, "b.opening_m"), at_end(all, "a.opening_m"));
  ck_assert_double_eq(at_end(all, "c.voltage_V"), 9e3);
}

/* Members that share no body move as each alone would: one behind a supply that limits the current, one on a square
 * wave that begins later, one on a controller. Steps are those of all, so it is the error of the steps that differs. */
TEST(members_apart_move_as_each_alone) {
  static const char fine[] = USUAL "solver.tolerance: 1e-6\ndrive.voltage: 8 kV\n";
  static const char *const has[] = {
      "drive.voltage: 9 kV, source: {model: amplifier, current_limit: 30 uA, bandwidth: 500 Hz, bleeder: 1000 Mohm}",
      "drive: {waveform: square, frequency: 40 Hz, rise_time: 1 ms, delay: 7 ms, voltage: 7 kV}",
      "control: {kind: pi, proportional: 0.5 kV/mm, integral: 20 kV/mm/s, period: 1 ms}, setpoint.value: 38 mm"};
  char text[2048], alone[512];
  size_t used =
      (size_t)snprintf(text, sizeof text, "%sbodies: {b0: {mass: 14 g}, b1: {mass: 17 g}, b2: {mass: 20 g}}\n", fine);
  used += (size_t)snprintf(text + used, sizeof text - used, "members:\n");
  for (int k = 0; k < 3; k++)
    used += (size_t)snprintf(text + used, sizeof text - used, "  m%d: {upper: frame, lower: b%d, %s}\n", k, k, has[k]);
  const ZpResult *all = run(text);
  double energy = 0;
  for (int k = 0; k < 3; k++) {
    char name[32];
    snprintf(alone, sizeof alone, "%sbodies: {b: {mass: %d g}}\nmembers: {m: {upper: frame, lower: b, %s}}\n", fine,
             14 + 3 * k, has[k]);
    const ZpResult *one = run(alone);
    snprintf(name, sizeof name, "m%d.opening_m", k);
    agree(name, at_end(all, name), at_end(one, "m.opening_m"), 1e-5);
    snprintf(name, sizeof name, "m%d.voltage_V", k);
    agree(name, at_end(all, name), at_end(one, "m.voltage_V"), 1e-5);
    energy += at_end(one, "source_energy_J");
  }
  agree("energy", at_end(all, "source_energy_J"), energy, 1e-4);
  ck_assert_double_lt(number(all, "energy_error"), 1e-8);
}

/* -- meters ---------------------------------------------------------------------------------------- */

#define METER "frequency: 2 kHz, amplitude: 50 V, sampling_rate: 32 kHz, bits: 14"
#define SLOW  ", bandwidth: 200 Hz"
#define ONE   USUAL "drive.voltage: 8 kV\nload.mass: 20 g\n"

static const char *const read_by_meter[] = {"sensed_capacitance_F", "sensed_stroke_m"};

/* The columns of a meter in every row of two runs, of which the first one has a name before them. */
static void ck_reads_as(const ZpResult *result, const char *name, const ZpResult *as) {
  size_t count = 0;
  for (size_t k = 0; k < LENGTH_OF(read_by_meter); k++) {
    char column[64];
    snprintf(column, sizeof column, "%s%s", name, read_by_meter[k]);
    for (size_t row = 0; row < as->series->rows; row++) {
      const double a = zp_table_get(result->series, row, column), b = zp_table_get(as->series, row, read_by_meter[k]);
      ck_assert_int_eq(isnan(a), isnan(b));
      if (isnan(a)) continue;
      ck_assert_double_eq(a, b);
      count++;
    }
  }
  ck_assert_uint_gt(count, as->series->rows);
}

/* The last reading. */
static void ck_ends_as(const ZpResult *result, const char *name, const ZpResult *as, double within) {
  for (size_t k = 0; k < LENGTH_OF(read_by_meter); k++) {
    char column[64];
    snprintf(column, sizeof column, "%s%s", name, read_by_meter[k]);
    agree(column, at_end(result, column), at_end(as, read_by_meter[k]), within);
  }
}

/* Given to all or to the member, to the last bit. */
TESTS(meter_of_a_network_of_one, 0, 2) {
  static const char *const of[] = {"sense: {" METER SLOW ", noise: 1 nA}\n", ""}, *const own[] = {
                                                                                      "", ", sense: {" METER SLOW
                                                                                          ", noise: 1 nA}"};
  static const char *const told[] = {"sense_window_s", "sense_capacitance_error_F", "sense_stroke_error_m",
                                     "sense_stroke_error"};
  char text[1024];
  snprintf(text, sizeof text,
           USUAL "drive.voltage: 8 kV\n%sbodies: {hand: {mass: 20 g}}\n"
                 "members: {only: {upper: frame, lower: hand%s}}\n",
           of[_i], own[_i]);
  const ZpResult *one = run(ONE "sense: {" METER SLOW ", noise: 1 nA}\n"), *all = run(text);
  ck_reads_as(all, "only.", one);
  for (size_t k = 0; k < LENGTH_OF(told); k++) {
    char name[64];
    snprintf(name, sizeof name, "members.only.%s", told[k]);
    ck_assert_double_eq(number(all, name), number(one, told[k]));
  }
}

/* Each tells the stroke of its member alone: between bodies, and side by side in a stack. */
TEST(meters_of_two) {
  const ZpResult *one = run(ONE "sense: {" METER SLOW "}\n"),
                 *other = run(USUAL "drive.voltage: 6 kV\nload.mass: 14 g\nsense: {" METER ", bandwidth: 400 Hz}\n"),
                 *both = run(USUAL "drive.voltage: 8 kV\n" TWO "members:\n"
                                   "  a: {upper: frame, lower: hand, sense: {" METER SLOW "}}\n"
                                   "  b: {upper: frame, lower: foot, drive.voltage: 6 kV,\n"
                                   "      sense: {" METER ", bandwidth: 400 Hz}}\n"),
                 *stack = run(USUAL "drive.voltage: 8 kV\nload.mass: 40 g\nstack.parallel: 2\n"
                                    "member_2.sense: {" METER SLOW "}\n");
  ck_ends_as(both, "a.", one, 3e-3);          /* 1.2e-3 measured: bits of a range by another largest capacitance */
  ck_ends_as(both, "b.", other, 1.7e-3);      /* 5.7e-4 measured */
  ck_ends_as(stack, "member_2_", one, 1e-12); /* 5.9e-14 measured */
  ck_assert_int_eq(zp_result_has(stack, "member_1_sense_stroke_error_m"), false);
}

/* It reads the capacitance of all on its port, whose strokes it does not tell. */
TEST(meter_of_a_port) {
  const ZpResult *one = run(ONE "sense: {" METER SLOW "}\n"),
                 *both = run(USUAL "drive.voltage: 8 kV\n" EQUAL "members:\n"
                                   "  a: {upper: frame, lower: hand, port: p, sense: {" METER SLOW "}}\n"
                                   "  b: {upper: frame, lower: foot, port: p}\n");
  const size_t last = both->series->rows - 1;
  agree("both", zp_table_get(both->series, last, "a.sensed_capacitance_F"),
        2 * zp_table_get(one->series, one->series->rows - 1, "sensed_capacitance_F"), 1e-12);
  ck_assert(isnan(zp_table_get(both->series, last, "a.sensed_stroke_m")));
  ck_assert(!zp_result_has(both, "members.a.sense_stroke_error_m"));
}

/* So does a controller: of two with twice the setpoint and half the gain as of one. */
TEST(controller_of_the_capacitance_of_a_port) {
  static const char pi[] = "control: {kind: pi, signal: capacitance, proportional: %s, integral: %s}";
  char text[1024], of[2][256];
  snprintf(of[0], sizeof of[0], pi, "40 V/pF", "4000 V/pF/s");
  snprintf(of[1], sizeof of[1], pi, "20 V/pF", "2000 V/pF/s");
  snprintf(text, sizeof text, ONE "%s\nsetpoint.value: 20 pF\n", of[0]);
  const ZpResult *one = run(text);
  snprintf(text, sizeof text,
           USUAL "drive.voltage: 8 kV\n" EQUAL "members:\n  a: {upper: frame, lower: hand, port: p, %s,\n"
                 "      setpoint.value: 40 pF}\n  b: {upper: frame, lower: foot, port: p}\n",
           of[1]);
  const ZpResult *both = run(text);
  agree("voltage", at_end(both, "b.voltage_V"), at_end(one, "voltage_V"), 1e-12);
  agree("capacitance", at_end(both, "capacitance_F"), 2 * at_end(one, "capacitance_F"), 1e-12);
}

/* -- cycles ---------------------------------------------------------------------------------------- */

#define CYCLES                                                                                                         \
  "study: cycle\nmesh.nodes: 13\nliquid.model: none\ndrive: {waveform: sine, frequency: 20 Hz, voltage: 6 kV}\n"       \
  "cycle: {method: motion, tolerance: 1e-5, most_cycles: 200}\ndamping.internal: 1 ms\n"

static const ZpResult *cycle_of(const char *text) {
  const ZpActuatorDef def = def_of(text);
  return answer_of(ZP_STUDY_CYCLE, &def);
}

/* Members that do not touch have the cycles of each alone: one behind a supply of its own, one on a square wave. */
TEST(cycles_of_members_apart) {
  static const char supply[] = "source: {model: amplifier, resistance: 100 Mohm, capacitance: 20 pF}",
                    *const square = "drive: {waveform: square, voltage: 5 kV, rise_time: 5 ms}";
  char text[1024];
  snprintf(text, sizeof text,
           CYCLES TWO "members:\n  a: {upper: frame, lower: hand, %s}\n"
                      "  b: {upper: frame, lower: foot, %s}\n",
           supply, square);
  const ZpResult *both = cycle_of(text);
  snprintf(text, sizeof text, CYCLES "load.mass: 20 g\n%s\n", supply);
  const ZpResult *a = cycle_of(text),
                 *b = cycle_of("study: cycle\nmesh.nodes: 13\nliquid.model: none\nload.mass: 14 g\n"
                               "drive: {waveform: square, frequency: 20 Hz, voltage: 5 kV, rise_time: 5 ms}\n"
                               "cycle: {method: motion, tolerance: 1e-5, most_cycles: 200}\ndamping.internal: 1 ms\n");
  ck_assert(number(both, "periodic") == 1);
  agree("range of a", number(both, "members.a.opening_max_m") - number(both, "members.a.opening_min_m"),
        number(a, "opening_max_m") - number(a, "opening_min_m"), 8e-6); /* 2.7e-6 measured */
  agree("range of b", number(both, "members.b.opening_max_m") - number(both, "members.b.opening_min_m"),
        number(b, "opening_max_m") - number(b, "opening_min_m"), 4e-6);
  agree("energy", number(both, "energy_per_cycle_J"), number(a, "energy_per_cycle_J") + number(b, "energy_per_cycle_J"),
        7e-7); /* 2.3e-7 measured */
}

/* The largest frequency at which a network closes is that of its slowest member. */
TEST(network_closes_as_often_as_its_slowest) {
  static const char fast[] = "study: cycle\nmesh.nodes: 9\nliquid.model: none\n"
                             "drive: {waveform: square, voltage: 10 kV, frequency: 2 Hz}\nsolver.tolerance: 1e-3\n"
                             "cycle: {method: motion, tolerance: 1e-2, most_cycles: 6, closing_frequency: true}\n"
                             "damping: {internal: 1 ms, drag: 0.5 N s2/m2}\n";
  char text[1024];
  snprintf(text, sizeof text, "%sload.mass: 4 g\n", fast);
  const ZpResult *one = cycle_of(text);
  snprintf(text, sizeof text,
           "%s"
           "bodies: {hand: {mass: 4 g}}\nmembers: {a: {upper: frame, lower: hand}}\n",
           fast);
  const ZpResult *network = cycle_of(text);
  ck_assert(number(network, "closes") == number(network, "members.a.closes"));
  agree("frequency", number(network, "closing_frequency_Hz"), number(one, "closing_frequency_Hz"), 1e-12);
}

/* -- waveforms ------------------------------------------------------------------------------------- */

/* A delay shifts a waveform: as a table with the same corners, of times in ms and voltages in kV. */
static const struct {
  const char *drive;
  size_t corners;
  double time[8], voltage[8], within;
} delayed[] = {{"delay: 5 ms", 3, {0, 5, 5}, {0, 0, 9}, 1e-14},
               {"waveform: ramp, rise_time: 10 ms, offset: 1 kV, delay: 5 ms",
                3,
                {0, 5, 15},
                {1, 1, 9},
                4e-9 /* 4.9e-10 measured, of steps behind a rounded corner */},
               {"waveform: square, frequency: 50 Hz, offset: 1 kV, rise_time: 2 ms, delay: 5 ms",
                8,
                {0, 5, 7, 15, 17, 25, 27, 30},
                {1, 1, 9, 9, 1, 1, 9, 9},
                4e-9}};

static ZpSim *run_drive(const char *drive, bool fed, const ZpDriveTable *table) {
  char text[1024];
  snprintf(text, sizeof text, USUAL "solver.tolerance: 1e-6\nload.mass: 20 g\ndrive: {voltage: 9 kV, %s}\n%s", drive,
           fed ? BEHIND : "");
  const ZpActuatorDef def = def_of(text);
  ZpSim *sim = sim_of(table ? driven_model_of(&def, table->rows, table->time, table->voltage) : model_of(&def));
  run_to(sim, 0.03);
  return sim;
}

TESTS(delay_is_a_shift, 0, LENGTH_OF(delayed)) {
  double time[8], voltage[8];
  for (size_t k = 0; k < delayed[_i].corners; k++)
    time[k] = 1e-3 * delayed[_i].time[k], voltage[k] = 1e3 * delayed[_i].voltage[k];
  for (int fed = 0; fed < 2; fed++) {
    ZpSim *shifted = run_drive(delayed[_i].drive, fed, NULL),
          *table = run_drive("waveform: table", fed, &(ZpDriveTable){delayed[_i].corners, time, voltage});
    agree("opening", zp_sim_get(shifted, "opening"), zp_sim_get(table, "opening"), delayed[_i].within);
    agree("energy", zp_sim_get(shifted, "source_energy"), zp_sim_get(table, "source_energy"), delayed[_i].within);
  }
}

TEST(delayed_sine_begins_at_its_offset) {
  const ZpActuatorDef def =
      DEF({"drive.waveform", ZP_WAVEFORM_SINE}, {"drive.offset", 1e3}, {"drive.delay", 0.013}, {"drive.frequency", 20});
  const ZpWaveform w = zp_waveform_of(&def, NULL);
  ck_assert_double_eq(zp_waveform_voltage(&w, 0.006), 1e3);
  ck_assert_double_eq(zp_waveform_rate(&w, 0.006), 0);
  ck_near(zp_waveform_voltage(&w, 0.013 + 0.025), 10e3, 1e-14);
  ck_near(zp_waveform_voltage(&w, 0.013 + 0.0125), 5.5e3, 1e-14);
  ck_near(zp_waveform_rate(&w, 0.013 + 0.0125), 3.14159265358979 * 20 * 9e3, 1e-13);
  ck_assert_double_eq(zp_waveform_next_corner(&w, 0), 0.013);
  ck_near(zp_waveform_next_corner(&w, 0.013), 0.013 + 0.025, 1e-15);
  ck_near(zp_waveform_lag(&w, 100, 0.003, 0.013, 3e3), 1e3 + 2e3 * exp(-1), 1e-14);
  ck_assert(!zp_waveform_is_constant(&w));
}

/* Of a waveform of all, a waveform of its own leaves what it does not use, and has the rest. */
TEST(own_waveform_has_what_it_uses) {
  static const char all[] =
      USUAL "load.mass: 20 g\nstack: {series: 2, link_mass: 2 g}\n"
            "drive: {voltage: 9 kV, waveform: square, frequency: 20 Hz, duty: 0.3, offset: 2 kV}\n";
  char text[1024];
  snprintf(text, sizeof text, "%smember_1.drive.waveform: sine\nmember_2.drive: {waveform: step, voltage: 3 kV}\n",
           all);
  const ZpActuatorDef def = def_of(text), sine = zp_def_member(&def, 1), step = zp_def_member(&def, 2);
  ck_assert_double_eq(sine.drive.frequency, 20);
  ck_assert_double_eq(sine.drive.offset, 2e3);
  ck_assert_double_eq(sine.drive.duty, 0.5);
  ck_assert_double_eq(step.drive.voltage, 3e3);
  ck_assert_double_eq(step.drive.offset, 0);
  ck_assert_double_eq(step.drive.frequency, 10);
  snprintf(text, sizeof text, "%smember_2: {control.kind: pi, setpoint.value: 30 mm}\n", all);
  const ZpActuatorDef other = def_of(text), controlled = zp_def_member(&other, 2);
  ck_assert_int_eq(controlled.drive.waveform, ZP_WAVEFORM_STEP);
  ck_assert_double_eq(controlled.drive.offset, 0);
}

/* Each key of a port is that of one actuator, of this member only. */
TEST(keys_of_a_port_are_those_of_one) {
  const ZpActuatorDef plain = def_of(OF_ALL "stack.parallel: 2\n");
  const int first = ZP_KEY(member_K.drive.waveform), last = ZP_KEY(member_K.setpoint.duty);
  for (int row = first; row <= last; row++) {
    const int one = zp_key_find(zp_key_of_one(zp_key(row)->name));
    const bool is_word = zp_key(row)->type == ZP_KEY_ENUM;
    const double value = is_word ? zp_key(row)->max : fmin(zp_key(row)->max, fmax(1, 2 * zp_key(row)->min));
    ZpActuatorDef def = plain;
    ck_ok(zp_def_set(&def, zp_key_of_instance(row, 2), value, &err));
    const ZpActuatorDef other = zp_def_member(&def, 1), own = zp_def_member(&def, 2);
    const bool kept = zp_key_without_use(&own, one, one) < 0; /* the waveform uses it */
    ck_assert_msg(zp_def_get(&own, one) == value || !kept, "%s", zp_key(row)->name);
    ck_assert_msg(zp_def_get(&other, one) == zp_def_get(&plain, one) || isnan(zp_def_get(&plain, one)), "%s",
                  zp_key(row)->name);
    zp_def_clear(&def);
  }
}

/* A supply of its own sets the keys of source that the member does not give. */
TEST(own_supply_sets_its_keys) {
  const ZpActuatorDef def = def_of(
                          USUAL
                          "stack.parallel: 2\ndrive.voltage: 4 kV\nsource.model: amplifier\nsource.slew_rate: 1 V/us\n"
                          "member_2.source: {supply: open_5kv, current_limit: 3 mA}\n"),
                      first = zp_def_member(&def, 1), second = zp_def_member(&def, 2);
  ck_assert_double_eq(first.source.slew_rate, 1e6);
  ck_assert(isnan(first.source.current_limit));
  ck_assert_double_eq(second.source.slew_rate, 15e6);
  ck_assert_double_eq(second.source.current_limit, 3e-3);
}

/* Slow voltages of a member that is not scaled stay: as stack.lower_voltage says of an antagonist. */
TEST(voltage_that_is_not_scaled_stays) {
  const ZpActuatorDef stack =
                          def_of(OF_ALL "load.mass: 8 g\nstack: {series: 2, distance: 50 mm, lower_voltage: 2 kV}\n"),
                      network = def_of(OF_ALL "bodies: {hand: {mass: 8 g}, floor: {moves: none, at: [0, -50 mm]}}\n"
                                              "members:\n  up: {upper: frame, lower: hand}\n"
                                              "  down: {upper: floor, lower: hand, angle: 180 degree, "
                                              "drive: {voltage: 2 kV, scaled: false}}\n");
  const ZpResult *a = answer_of(ZP_STUDY_EQUILIBRIUM, &stack), *b = answer_of(ZP_STUDY_EQUILIBRIUM, &network);
  agree("stress", number(b, "max_stress_Pa"), number(a, "max_stress_Pa"), 1e-12);
  agree("opening", at_end(b, "up.opening_m"), at_end(a, "opening_m"), 1e-12);
}

/* The folds of two members side by side are a curve in the plane of their voltages: where it is met with one voltage
 * held, the ray from the origin meets it, too. */
TEST(fold_is_where_both_voltages_say) {
  char text[512];
  const char *all = OF_ALL "load.mass: 8 g\nstack.parallel: 2\n";
  snprintf(text, sizeof text, "%smember_2.drive: {voltage: 2.9 kV, scaled: false}\n", all);
  const ZpActuatorDef held = def_of(text);
  const double U = answered_value(ZP_STUDY_LIMITS, &held, "pull_in_voltage_V");
  snprintf(text, sizeof text, "%sdrive.voltage: %.17g V\nmember_2.drive.voltage: %.17g V\n", all, 4 * U, 4 * 2900.0);
  const ZpActuatorDef ray = def_of(text);
  agree("pull-in", answered_value(ZP_STUDY_LIMITS, &ray, "pull_in_voltage_V"), U, 1e-8);
}

/* Slow voltages are parts of drive.voltage of all, whichever member comes first. */
TEST(first_member_may_have_a_voltage_of_its_own) {
  static const char *const order[] = {
      "a: {upper: frame, lower: hand, drive.voltage: 2 kV}, b: {upper: frame, lower: hand}",
      "b: {upper: frame, lower: hand}, a: {upper: frame, lower: hand, drive.voltage: 2 kV}"};
  double U[2], stiff[2];
  for (int k = 0; k < 2; k++) {
    char text[512];
    snprintf(text, sizeof text,
             OF_ALL "bodies: {hand: {mass: 8 g}}\nmembers: {%s}\nisometric: {body: hand, separation: 5 mm}\n",
             order[k]);
    const ZpActuatorDef def = def_of(text);
    U[k] = answered_value(ZP_STUDY_EQUILIBRIUM, &def, "closing_voltage_V");
    stiff[k] = answered_value(ZP_STUDY_ISOMETRIC, &def, "force_N");
  }
  agree("closing", U[1], U[0], 1e-10);
  agree("force", stiff[1], stiff[0], 1e-10);
}

/* A table is that of all: each member has its ratio of it. */
TEST(table_keeps_the_ratio) {
  static const double time[] = {0, 0.01, 0.03}, whole[] = {0, 9e3, 9e3}, part[] = {0, 5.4e3, 5.4e3};
  const ZpActuatorDef
      two = def_of(USUAL
                   "solver.tolerance: 1e-6\n" TWO "drive: {voltage: 10 kV, waveform: table}\n"
                   "members: {a: {upper: frame, lower: hand}, b: {upper: frame, lower: foot, drive.voltage: 6 kV}}\n"),
      one = def_of(USUAL "solver.tolerance: 1e-6\nload.mass: 14 g\ndrive: {voltage: 10 kV, waveform: table}\n");
  ZpSim *both = sim_of(driven_model_of(&two, LENGTH_OF(time), time, whole)),
        *alone = sim_of(driven_model_of(&one, LENGTH_OF(time), time, part));
  run_to(both, 0.05);
  run_to(alone, 0.05);
  ZpSim *b = both + 1;
  agree("opening", zp_sim_own_signal(b, zp_signal_find("opening")), zp_sim_get(alone, "opening"), 1e-6);
  ck_near(zp_sim_own_signal(b, zp_signal_find("voltage")), 5.4e3, 1e-14);
}

/* A program's voltage is drive.voltage of all. */
TEST(voltage_of_a_program_is_that_of_all) {
  const ZpActuatorDef def =
      def_of(USUAL TWO "drive.voltage: 8 kV\nmembers:\n"
                       "  a: {upper: frame, lower: hand}\n"
                       "  b: {upper: frame, lower: foot, drive: {voltage: 6 kV, delay: 20 ms}}\n");
  ZpSim *sim = sim_of(model_of(&def));
  ck_ok(zp_sim_set_voltage(sim, 4e3, &err));
  run_to(sim, 0.01);
  ck_assert_double_eq(sim[0].state->U, 4e3);
  ck_near(sim[1].state->U, 3e3, 1e-15);
}

/* A run has a constant drive where each member has one, whichever comes first: else its outcome says nothing of
 * closing.
 */
TEST(drive_is_constant_if_all_are) {
  static const char *const members[] = {
      "a: {upper: frame, lower: hand}, b: {upper: frame, lower: foot, drive: {waveform: square, frequency: 5 Hz}}",
      "b: {upper: frame, lower: foot, drive: {waveform: square, frequency: 5 Hz}}, a: {upper: frame, lower: hand}",
      "a: {upper: frame, lower: hand}, b: {upper: frame, lower: foot}"};
  for (int k = 0; k < 3; k++) {
    char text[512];
    snprintf(text, sizeof text,
             OF_ALL "drive.voltage: 10 kV\nbodies: {hand: {mass: 4 g}, foot: {mass: 4 g}}\n"
                    "solver.end_time: 90 ms\nmembers: {%s}\n",
             members[k]);
    const ZpResult *result = run(text);
    ck_assert(number(result, "members.a.zip_time_s") > 0);
    ck_assert_int_eq(result->outcome, k < 2 ? ZP_REACHED_END : ZP_ZIPPED);
  }
}

/* Snapshots have the sources and controllers of all ports. */
TEST(run_on_several_ports_continues) {
  const ZpActuatorDef def =
      def_of(USUAL "load.mass: 20 g\nstack: {series: 3, link_mass: 2 g}\ndrive.voltage: 8 kV\n" BEHIND
                   "\nmember_2.source.current_limit: 40 uA\nmember_2.drive: {waveform: sine, frequency: 30 Hz}\n"
                   "member_3.control: {kind: pi, proportional: 0.5 kV/mm, integral: 20 kV/mm/s}\n"
                   "member_3.setpoint.value: 38 mm\n");
  const ZpModel *model = model_of(&def);
  ZpSim *sim = sim_of(model);
  run_to(sim, 0.0223);
  ck_continues(sim, model, 0.05);
}

/* A checkpoint has the keys of bodies, of springs and of the places of members, too. */
TEST(network_continues) {
  static const char text[] = USUAL
      "drive.voltage: 7 kV\nbodies: {hand: {mass: 8 g}, floor: {moves: none, at: [0, -60 mm]}, hook: {mass: 3 g}}\n"
      "members:\n  up: {upper: frame, lower: hand}\n"
      "  down: {upper: floor, lower: hand, angle: 180 degree, drive: {waveform: square, voltage: 3 kV}}\n"
      "  tail: {upper: hand, lower: hook, source: {model: amplifier, resistance: 100 Mohm}}\n"
      "springs: {coil: {between: [frame, hook], stiffness: 2 N/m, rest: 10 mm}}\n";
  static const struct {
    const char *key;
    double value;
    const char *says;
  } other[] = {{"spring_1.stiffness", 3, "spring_1.stiffness is 2 N/m there, 3 N/m here"},
               {"body_2.at.y", -0.061, "body_2.at.y is -0.06 m there, -0.061 m here"},
               {"member_3.upper", 0, "member_3.upper is 1 there, 0 here"},
               {"spring_1.kind", ZP_SPRING_PULL, "other bodies and springs"}};
  const ZpActuatorDef def = def_of(text);
  const ZpModel *model = model_of(&def);
  ZpSim *sim = sim_of(model);
  ZpCheckpoint *checkpoint;
  run_to(sim, 0.0223);
  ck_ok(zp_sim_checkpoint(sim, &checkpoint, &err));
  ck_ok(zp_checkpoint_check(checkpoint, &def, &err));
  for (size_t k = 0; k < LENGTH_OF(other); k++) {
    ZpActuatorDef changed = def;
    set_member(&changed, other[k].key, other[k].value);
    ck_says(zp_checkpoint_check(checkpoint, &changed, &err), ZP_BAD_INPUT, other[k].says);
  }
  zp_checkpoint_destroy(checkpoint);
  ck_continues(sim, model, 0.04);
}

static const struct {
  ZpStudy study;
  const char *text, *says;
} wrong[] = {
    {ZP_STUDY_ACTUATE,
     EQUAL "members:\n  a: {upper: frame, lower: hand, port: p}\n  b: {upper: frame, lower: foot, port: p, "
           "drive.voltage: 3 kV}",
     "members.b.drive.voltage: give this key at the first member with the same port, a"},
    {ZP_STUDY_ACTUATE,
     EQUAL "members: {a: {upper: frame, lower: hand, drive.waveform: table}, b: {upper: frame, lower: foot}}",
     "a member has no table of its own"},
    {ZP_STUDY_ACTUATE, "stack.parallel: 2\nmember_2.drive.frequency: 20 Hz", "member 2 of the stack: drive.frequency"},
    {ZP_STUDY_ACTUATE, "stack.parallel: 2\nmember_2.source.resistance: 2 Mohm", "source.resistance"},
    {ZP_STUDY_ACTUATE, "stack.parallel: 2\nmember_2.control.kind: pi", "setpoint.value"},
    {ZP_STUDY_MODES, "stack.parallel: 2\nmember_2.control.kind: pi\nmember_2.setpoint.value: 30 mm",
     "without liquid only"},
    {ZP_STUDY_CYCLE, "stack.parallel: 2\nmember_2.drive.frequency: 5 Hz\ndrive: {waveform: sine, frequency: 10 Hz}",
     "one drive gives the period"},
    {ZP_STUDY_CYCLE,
     "stack.parallel: 2\nmember_2.drive: {waveform: ramp, rise_time: 1 ms}\ndrive: {waveform: sine, frequency: 10 Hz}",
     "member 2 of the stack: drive.waveform = ramp: the drive is periodic"},
    {ZP_STUDY_CYCLE,
     "stack.parallel: 2\nmember_2.drive.waveform: sine\ndrive: {waveform: sine, frequency: 10 Hz}\ncycle.method: "
     "linear",
     "the linear answer is that of one drive"},
    {ZP_STUDY_CYCLE,
     "stack.parallel: 2\nmember_2: {control.kind: pi, setpoint.value: 5 mm}\ndrive: {waveform: sine, frequency: 10 Hz}",
     "for a controller use study actuate"},
    {ZP_STUDY_ACTUATE,
     EQUAL "members: {a: {upper: frame, lower: hand, port: p}, b: {upper: frame, lower: foot, port: p, "
           "sense.frequency: 1 kHz}}",
     "members.b.sense.frequency: give this key at the first member with the same port, a"},
    {ZP_STUDY_ACTUATE,
     EQUAL "members: {a: {upper: frame, lower: hand, sense.frequency: 1 kHz}, b: {upper: frame, "
           "lower: foot}}",
     "members.a: sense.frequency = 1000 Hz: requires sense.amplitude"},
    {ZP_STUDY_ACTUATE,
     EQUAL "members: {a: {upper: frame, lower: hand, sense.bits: 12}, b: {upper: frame, lower: foot}}",
     "members.a: sense.bits = 12: requires sense.frequency"},
    {ZP_STUDY_ACTUATE,
     EQUAL "electro.model: field\nmembers: {a: {upper: frame, lower: hand, sense: {" METER
           "}}, b: {upper: frame, lower: foot}}",
     "requires electro.model plates, but it is field"},
    {ZP_STUDY_CYCLE, "drive: {waveform: sine, frequency: 10 Hz, delay: 1 ms}", "what is periodic has no begin"},
};

TESTS(wrong_ports_are_refused, 0, LENGTH_OF(wrong)) {
  ck_scenario_refused(wrong[_i].study, wrong[_i].text, wrong[_i].says);
}
