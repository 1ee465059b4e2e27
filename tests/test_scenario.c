/* Scenarios, values and keys: what is read, what is refused and with which words, and that all that is
 * written reads back to the same bits. */
#include <glob.h>
#include <locale.h>
#include <pthread.h>

#include <jansson.h>

#include "data_util.h"
#include "io/plan.h"

static ZpStatus parse(ZpScenario *s, const char *text, ZpError *err) {
  return zp_scenario_parse(s, text, strlen(text), "test.yaml", err);
}

/* A scenario of a text that must be right. */
static ZpScenario *scenario_of(const char *text) {
  ZpScenario *s = new_scenario();
  ZpError err = {0};
  ck_assert_msg(parse(s, text, &err) == ZP_OK, "%s: %s", text, err.message);
  return s;
}

/* Value of `key` in the only Def of a text. */
static double value_in(const char *text, const char *key) {
  ZpScenario *s = scenario_of(text);
  ck_assert_uint_eq(zp_scenario_count(s), 1);
  ZpActuatorDef def = case_of(s, 0);
  return zp_def_get(&def, zp_key_find(key));
}

static bool same_bits(double a, double b) {
  return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

/* An assertion for each key would write to a file for each. */
static void assert_same_def(const ZpActuatorDef *a, const ZpActuatorDef *b) {
  for (int i = 0; zp_key(i); i++) {
    const double x = zp_def_get(a, i), y = zp_def_get(b, i);
    if (!same_bits(x, y)) ck_abort_msg("%s: %.17g became %.17g", ZP_KEY_NAME(i), x, y);
  }
}

/* What zp_scenario_write gives, to be freed. */
static char *written(const ZpScenario *s) {
  char *text = NULL;
  size_t size = 0;
  FILE *file = open_memstream(&text, &size);
  ck_assert_ptr_nonnull(file);
  ck_ok(zp_scenario_write(s, file, &err));
  ck_assert_int_eq(fclose(file), 0);
  return zp_test_owns(text, free);
}

static void assert_round_trip(const ZpScenario *s) {
  char *text = written(s);
  ZpScenario *back = scenario_of(text);
  ck_assert_uint_eq(zp_scenario_count(s), zp_scenario_count(back));
  ck_assert_int_eq(zp_scenario_study(s), zp_scenario_study(back));
  for (size_t i = 0; i < zp_scenario_count(s); i++) {
    ZpActuatorDef a = case_of(s, i), b = case_of(back, i);
    assert_same_def(&a, &b);
  }
  char *again = written(back);
  ck_assert_str_eq(text, again);
}

/* Values that are read, and what they are in SI: compared bit by bit. */
static const struct {
  const char *key, *text;
  double value;
} good_values[] = {
    {"ribbon.thickness", "50 um", 50e-6},
    {"ribbon.thickness", "50um", 50e-6},
    {"ribbon.thickness", "  50   um ", 50e-6},
    {"ribbon.thickness", "50 \xC2\xB5m", 50e-6},
    {"ribbon.thickness", "5e-5", 50e-6},
    {"ribbon.thickness", "0.05 mm", 50e-6},
    {"ribbon.thickness", "+.5e-1 mm", 50e-6},
    {"ribbon.thickness", "5000 um", 5e-3},
    {"ribbon.length", "1 in", 0.0254},
    {"ribbon.length", "1e-1 m", 0.1},
    {"ribbon.length", "5.", 5},
    {"drive.voltage", "10 kV", 10e3},
    {"drive.voltage", "0.01 MV", 10e3},
    {"drive.voltage", "-0 V", 0},
    {"load.mass", "8 g", 8e-3},
    {"load.mass", "1e-3", 1e-3},
    {"ribbon.young_modulus", "200 GPa", 200e9},
    {"ribbon.young_modulus", "200 kN/mm2", 200e9},
    {"ribbon.density", "7.85 g/cm3", 7850},
    {"ribbon.density", "7850 kg m-3", 7850},
    {"ribbon.density", "7850 kg/m^3", 7850},
    {"insulator.breakdown_field", "40 V/um", 40e6},
    {"damping.drag", "1 N s2/m2", 1},
    {"gravity", "9.81 m/s2", 9.81},
    {"solver.end_time", "2 min", 120},
    {"load.share", "25 %", 0.25},
    {"load.share", "25 percent", 0.25},
    {"load.share", "0.25", 0.25},
    {"mesh.nodes", "61", 61},
    {"mesh.nodes", "6.1e1", 61},
    {"solver.time_step", "auto", NAN},
    {"solver.time_step", "5 us", 5e-6},
    {"platform.electrode", "true", 1},
    {"platform.electrode", "No", 0},
    {"platform.electrode", "on", 1},
    {"platform.electrode", "off", 0},
    {"platform.electrode", "yes", 1},
    {"platform.electrode", "FALSE", 0},
    {"electro.surface", "bezier", ZP_SURFACE_BEZIER},
};

/* The first of all, so that the database was not read yet. */
TEST(test_no_database) {
  double value;
  ZpError err = {0};
  int key = zp_key_find("load.mass");
  setenv("UDUNITS2_XML_PATH", "/nowhere/units.xml", 1);
  ck_assert_int_eq(zp_value_parse(key, "1", &value, &err), ZP_OK);
  ck_says(zp_value_parse(key, "8 g", &value, &err), ZP_MACHINE, "/nowhere/units.xml");
  unsetenv("UDUNITS2_XML_PATH");
  ck_assert_int_eq(zp_value_parse(key, "8 g", &value, &err), ZP_OK);
}

TESTS(test_good_value, 0, LENGTH_OF(good_values)) {
  double value = -1;
  int key = zp_key_find(good_values[_i].key);
  ck_assert_int_ge(key, 0);
  ck_ok(zp_value_parse(key, good_values[_i].text, &value, &err));
  ck_assert_msg(same_bits(value, good_values[_i].value), "%s: %.17g", good_values[_i].text, value);
}

/* "130<no-break space>um", as pages and word processors write it, was an unknown unit. */
TEST(test_no_break_space) {
  static const char *const text[] = {"130\u00A0um",   "130\u202Fum", "130\u2009um",        "130\u2007um",
                                     "\u00A0130 um ", "130um\u00A0", "130 \u00A0 \u202Fum"};
  int key = zp_key_find("insulator.thickness");
  ZpError err = {0};
  double value;
  for (size_t i = 0; i < sizeof text / sizeof text[0]; i++) {
    value = -1;
    ck_ok(zp_value_parse(key, text[i], &value, &err));
    ck_assert(same_bits(value, 130e-6));
  }
  ck_assert(same_bits(value_in("insulator.thickness: 130\u00A0um\n", "insulator.thickness"), 130e-6));
  ck_assert(same_bits(value_in("damping.drag: 1 N\u00A0s2/m2\n", "damping.drag"), 1));
  ck_assert_int_eq(zp_value_parse(key, "\u00A0", &value, &err), ZP_BAD_INPUT);
  ck_assert_int_eq(zp_value_parse(key, "130\u00A0lightyears", &value, &err), ZP_BAD_INPUT);
}

/* Values that are refused, and a part of the reason. All messages must name key and value, too. */
static const struct {
  const char *key, *text, *reason;
} bad_values[] = {
    {"ribbon.thickness", "130 kV", "not a length; give a value in um from 1 um to 5000 um"},
    {"ribbon.thickness", "0", "out of range; 1 um to 5000 um"},
    {"ribbon.thickness", "6 mm", "out of range; 1 um to 5000 um"},
    {"ribbon.thickness", "-5 um", "out of range"},
    {"ribbon.thickness", "", "empty"},
    {"ribbon.thickness", " ", "empty"},
    {"ribbon.thickness", "um", "not a number"},
    {"ribbon.thickness", "auto", "cannot be auto"},
    {"ribbon.length", "5 m m", "not a length"},
    {"ribbon.length", "5 10 mm", "unknown unit"},
    {"ribbon.length", "5 mm @ 3", "unknown unit"},
    {"ribbon.length", "5 lg(re mm)", "not a length"},
    {"ribbon.length", "0x10", "not a decimal number"},
    {"ribbon.length", "1_000", "not a decimal number"},
    {"ribbon.length", "1,5 m", "not a decimal number"},
    {"ribbon.length", "1.2.3", "not a decimal number"},
    {"ribbon.length", "1e", "not a length"},
    {"ribbon.length", "--1", "not a number"},
    {"ribbon.length", ".", "not a number"},
    {"ribbon.length", "5 mm^999999", "unknown unit"},
    {"load.mass", "8,5 g", "not a decimal number; decimals have a point, not a comma; give a value in g"},
    {"load.mass", "8 g, 9 g", "not one value; a list needs brackets: [8 g, 9 g]; give a value in g"},
    {"load.mass", "8, 9 g", "not one value; a list needs brackets: [8, 9 g]"},
    {"ribbon.length", "5 ((((((((mm", "unknown unit"},
    {"ribbon.length", "5 \xFF", "unknown unit \"?\""},
    {"drive.voltage", "5 kV extra", "unknown unit \"kV extra\""},
    {"drive.voltage", "nan", "not a number"},
    {"drive.voltage", ".nan", "not a number"},
    {"drive.voltage", "inf", "not a number"},
    {"drive.voltage", "-inf", "not a number"},
    {"drive.voltage", "1e999", "too large"},
    {"drive.voltage", "1e99999999999999999999", "too large"},
    {"drive.voltage", "1e300 GV", "too large"},
    {"drive.voltage", "1e-999", "too small"},
    {"solver.end_time", "5 Hz", "not a time; give a value in s"},
    {"solver.end_time", "5 s since 1970", "unknown unit"},
    {"solver.time_step", "maybe", "or auto"},
    {"load.share", "0.5 m", "has no unit; give a number from 0 to 1"},
    {"load.share", "0.5 rad", "has no unit"},
    {"load.share", "150 %", "out of range; 0 to 1"},
    {"mesh.nodes", "61.5", "not a whole number; give a whole number from 4 to 2001"},
    {"mesh.nodes", "61 m", "has no unit"},
    {"mesh.nodes", "6100 %", "has no unit"},
    {"mesh.nodes", "3", "out of range; 4 to 2001"},
    {"platform.electrode", "1", "give true or false"},
    {"platform.electrode", "", "empty"},
    {"electro.surface", "bezir", "did you mean bezier?"},
    {"electro.surface", "", "polyline, bezier"},
    {"electro.surface", "auto", "not one of polyline, bezier"},
};

TESTS(test_bad_value, 0, LENGTH_OF(bad_values)) {
  double value = -1;
  ZpError err = {0};
  int key = zp_key_find(bad_values[_i].key);
  ck_assert_int_ge(key, 0);
  ck_assert_int_eq(zp_value_parse(key, bad_values[_i].text, &value, &err), ZP_BAD_INPUT);
  ck_assert_int_eq(err.status, ZP_BAD_INPUT);
  ck_assert_msg(strstr(err.message, bad_values[_i].reason) != NULL, "%s", err.message);
  ck_assert_msg(strstr(err.message, bad_values[_i].key) != NULL, "%s", err.message);
  ck_assert_double_eq(value, -1);
  ck_assert_int_eq(zp_value_parse(key, bad_values[_i].text, &value, NULL), ZP_BAD_INPUT);
}

TEST(test_long_value) {
  char text[5000];
  double value;
  memset(text, '1', sizeof text);
  text[sizeof text - 1] = 0;
  ck_says(zp_value_parse(zp_key_find("load.mass"), text, &value, &err), ZP_BAD_INPUT, "longer than");
}

/* Scenarios that are read: one key and its value. */
static const struct {
  const char *text, *key;
  double value;
} good_texts[] = {
    {"", "ribbon.length", 0.1},
    {"# nothing\n", "ribbon.length", 0.1},
    {"---\n", "ribbon.length", 0.1},
    {"{}", "ribbon.length", 0.1},
    {"ribbon:\n", "ribbon.length", 0.1},
    {"ribbon: {}\n", "ribbon.length", 0.1},
    {"\xEF\xBB\xBFload.mass: 5 g", "load.mass", 5e-3},
    {"ribbon:\n  length: 90 mm\n", "ribbon.length", 0.09},
    {"ribbon.length: 90 mm\n", "ribbon.length", 0.09},
    {"ribbon.length: 90 mm\nribbon:\n  width: 1 cm\n", "ribbon.width", 0.01},
    {"ribbon: {length: 90 mm, width: 1 cm}", "ribbon.width", 0.01},
    {"{\"ribbon\": {\"length\": 0.09}}", "ribbon.length", 0.09},
    {"ribbon.length: '90 mm' # comment", "ribbon.length", 0.09},
    {"ribbon.length: \"90 mm\"\r\nload.mass: 5 g\r\n", "load.mass", 5e-3},
    {"load.mass: |\n  5 g\n", "load.mass", 5e-3},
    {"load.mass: 5 g\n...\n", "load.mass", 5e-3},
    {"gravity: 0", "gravity", 0},
    {"platform.electrode: no", "platform.electrode", 0},
    {"preset: paper-code", "mesh.nodes", 61},
    {"ribbon.thickness: 70 um\npreset: paper-code\n", "ribbon.thickness", 70e-6},
    {"preset: paper-code", "ribbon.thickness", 100e-6},
    {"actuator.kind: ribbon", "load.share", 1},
    {"ribbon.material: steel_1.4310", "ribbon.young_modulus", 185e9},
    {"ribbon.material: none", "ribbon.young_modulus", 200e9},
    {"ribbon.density: 8000\nribbon.material: brass\n", "ribbon.density", 8000},
    {"ribbon.density: 8000\nribbon.material: brass\n", "ribbon.yield_stress", 430e6},
    {"ribbon.material: brass\npreset: paper-fe\n", "ribbon.young_modulus", 110e9},
    {"insulator.material: pvc_tape", "insulator.young_modulus", 30e6},
    {"insulator.material: kapton", "insulator.resistivity", NAN},
    {"medium.material: silicone_oil_350cst", "medium.kinematic_viscosity", 350e-6},
    {"lower.ribbon.material: copper", "lower.ribbon.density", 8940},
    {"lower.ribbon.material: copper", "ribbon.density", 7850},
    {"ribbon.material: copper", "lower.ribbon.density", NAN},
    {"lower.insulator: {material: pdms, density: 0}", "lower.insulator.density", 0},
    {"lower:\n  ribbon: {density: 1}\n  insulator:\n    thickness: 5 um\n", "lower.insulator.thickness", 5e-6},
    {"lower:\n  ribbon.density: 1\nribbon:\n  density: 2\n", "lower.ribbon.density", 1},
};

TESTS(test_good_text, 0, LENGTH_OF(good_texts)) {
  double value = value_in(good_texts[_i].text, good_texts[_i].key);
  ck_assert_msg(same_bits(value, good_texts[_i].value), "%s: %.17g", good_texts[_i].text, value);
}

/* Scenarios that are refused, and two parts of the message. */
static const struct {
  const char *text, *place, *reason;
} bad_texts[] = {
    {"ribbon:\n  thikness: 5 um", "test.yaml:2: ribbon.thikness: ", "unknown key; did you mean ribbon.thickness?"},
    {"ribbn:\n  thickness: 5 um", "test.yaml:2: ribbn.thickness", "did you mean ribbon.thickness?"},
    {"ribbn: {}", "test.yaml:1: ribbn", "unknown key"},
    {"\nribbon.thickness: 130 kV",
     "test.yaml:2: ribbon.thickness = \"130 kV\": ", "not a length; give a value in um from 1 um to 5000 um"},
    {"ribbon.thickness: 0", "test.yaml:1: ribbon.thickness = \"0\": ", "out of range; 1 um to 5000 um"},
    {"load.mass: 1 g .. 9 g : 3", "test.yaml:1: load.mass = \"1 g .. 9 g\": not a range",
     "write \"1 g .. 9 g : 20\" or \"1 g .. 9 g : 20 log\", with the number of values and the quotes"},
    {"load.mass: [1 g .. 9 g]", "test.yaml:1: load.mass", "1 g .. 9 g"},
    {"study: modes\n  load.mass: 8 g", "test.yaml:1: ", "multiline plain key; is the next line indented more"},
    {"load.share: 0.5\nload.mass:8 g", "test.yaml:2: ", "; is the blank after a colon missing, or the colon?"},
    {"load:\n  mass: 8 g\n share: 0.5", "test.yaml:3: ", "; is the line indented less than the one before it?"},
    {"data.file: \"a\nload.mass: 8 g", "test.yaml:1: ", "; is a quote not closed?"},
    {"data.file: 'a\nload.mass: 8 g", "test.yaml:1: ", "; is a quote not closed?"},
    {"load: {mass: 8 g\n", "test.yaml:2: ", "; is a brace not closed?"},
    {"ribbon: 5 mm", "test.yaml:1: ribbon", "a group of keys"},
    {"ribbon: [1]", "test.yaml:1: ribbon", "a group of keys"},
    {"ribbon.length: {a: 1}", "test.yaml:1: ribbon.length.a", "unknown key"},
    {"ribbon.length: {}", "test.yaml:1: ribbon.length", "a range has no \"from\""},
    {"ribbon.length:", "test.yaml:1: ribbon.length", "empty"},
    {"ribbon.length: ''", "test.yaml:1: ribbon.length", "empty"},
    {"ribbon.length: ~", "test.yaml:1: ribbon.length", "not a number"},
    {"ribbon.length: []", "test.yaml:1: ribbon.length", "empty list"},
    {"ribbon.length: [[1]]", "test.yaml:1: ribbon.length", "not lists"},
    {"ribbon.length:\n- 1\n- a: b", "test.yaml:3: ribbon.length", "not lists or groups"},
    {"ribbon.length: [1, '']", "ribbon.length", "empty"},
    {"ribbon.length: [1, 2 kV]", "ribbon.length = \"2 kV\"", "not a length"},
    {"platform.electrode: [true, false]", "platform.electrode", "not a list"},
    {"study: [actuate]", "study", "not a list"},
    {"preset: paper", "preset = \"paper\"", "did you mean paper-"},
    {"load.mass: 1\nload.mass: 2", "test.yaml:2: load.mass", "given twice, first in line 1"},
    {"load: {mass: 1}\nload.mass: 2", "test.yaml:2: load.mass", "given twice, first in line 1"},
    {"load.mass: 2\nload:\n  mass: 1", "test.yaml:3: load.mass", "given twice, first in line 1"},
    {"load: {mass: 1}\nload: {share: 1}", "test.yaml:2: load", "given twice, first in line 1"},
    {"lower: {ribbon: {density: 1}}\nlower: {insulator: {density: 1}}", "test.yaml:2: lower",
     "given twice, first in line 1"},
    {"lower:\n  ribbon: {density: 1}\n  ribbon: {thickness: 1um}", "test.yaml:3: lower.ribbon",
     "given twice, first in line 2"},
    {"a: &x 1", "test.yaml:1", "anchors"},
    {"load: &x {mass: 1}", "test.yaml:1", "anchors"},
    {"load.mass: *x", "test.yaml:1", "anchors"},
    {"<<: *x", "test.yaml:1", "anchors"},
    {"<<: {load.mass: 1}", "test.yaml:1", "unknown key"},
    {"load.mass: !!float 1", "test.yaml:1", "tags"},
    {"- a\n- b", "test.yaml:1", "key: value"},
    {"hello", "test.yaml:1", "key: value"},
    {"? [a, b]\n: c", "test.yaml:1", "a key must be a word"},
    {"? {a: b}\n: c", "test.yaml:1", "a key must be a word"},
    {": 1", "test.yaml:1", "empty key"},
    {"load.mass: 1\n---\nload.share: 1", "test.yaml", "more than one document"},
    {"load:\n\tmass: 1", "test.yaml:2: ", "tab"},
    {"load.mass: \"1", "test.yaml:1: column", "closing quote"},
    {"load.mass: [1, 2", "test.yaml:2: column", "closing bracket"},
    {"load:\n  mass: 1\n share: 1", "test.yaml:3: column", "indentation"},
    {"load.mass: \xFF", "test.yaml:1: ", "UTF-8"},
    {"\nload.mass: \xC3", "test.yaml:2: ", "UTF-8"},
    {"load.mass: \xED\xA0\x80", "test.yaml:1: ", "UTF-8"},
    {"load.mass: \x1B[31m", "test.yaml:1: ", "control character"},
    {"load.mass: \"1\\0 g\"", "test.yaml:1: load.mass", "zero byte"},
    {"load.mass: \"\\e[31m\"", "load.mass = \"?[31m\"", "not a number"},
    {"a:\n b:\n  c:\n   d:\n    e:\n     f:\n      g:\n       h:\n        i:\n         j: 1", "test.yaml:10",
     "nested deeper"},
    {"load.mass: .inf", "load.mass", "not a number"},
    {"load.mass: 1e999", "load.mass", "too large"},
    {"load.mass: {from: 1 g, to: 2 g}", "test.yaml:", "load.mass = \"{...}\": a range has no \"count\""},
    {"load.mass: {}", "test.yaml:", "a range has no \"from\""},
    {"load.mass: {from: [1 g], to: 2 g, count: 2}", "test.yaml:", "load.mass.from: takes one value"},
    {"load.mass: {from: 1 g, from: 2 g}", "test.yaml:", "load.mass.from"},
    {"load.mass: {from: 1 g, till: 2 g}", "test.yaml:", "load.mass.till: unknown key"},
    {"load.mass: 3 g\nload: {mass: {from: 1 g, to: 2 g, count: 2}}", "test.yaml:", "given twice"},
    {"load.mass.from: 1 g", "test.yaml:", "load.mass: write a range as {from"},
    {"load.mass.from: 1 g\nribbon.width: {to: 3 mm}", "test.yaml:", "load.mass: write a range as {from"},
    {"ribbon.model: {from: 1, to: 2, count: 2}", "test.yaml:", "takes one value, not a range"},
    {"data.file: {from: 1, to: 2, count: 2}", "test.yaml:", "takes one value, not a range"},
};

TESTS(test_bad_text, 0, LENGTH_OF(bad_texts)) {
  ZpScenario *s = scenario_of("load.mass: 7 g\nribbon.length: [90 mm, 95 mm]");
  ck_says(parse(s, bad_texts[_i].text, &err), ZP_BAD_INPUT, bad_texts[_i].place);
  ck_says(parse(s, bad_texts[_i].text, &err), ZP_BAD_INPUT, bad_texts[_i].reason);
  ck_assert_int_eq(parse(s, bad_texts[_i].text, NULL), ZP_BAD_INPUT);
  ck_assert_uint_eq(zp_scenario_count(s), 2); /* as before */
  ck_assert_double_eq(case_of(s, 1).load.mass, 7e-3);
  ck_assert_double_eq(case_of(s, 1).ribbon.length, 0.095);
}

/* Arguments of --set that are refused. */
static const struct {
  const char *text, *message;
} bad_arguments[] = {
    {"ribbon.thickness=0", "--set ribbon.thickness=0: out of range; 1 um to 5000 um"},
    {"ribbon.thickness=130 kV", "--set ribbon.thickness=130 kV: not a length; give a value in um from"},
    {"ribbon.thikness=1", "--set ribbon.thikness=1: unknown key; did you mean ribbon.thickness?"},
    {"ribbon=1", "--set ribbon=1: a group of keys"},
    {"drive.voltage", "give KEY=VALUE"},
    {"", "give KEY=VALUE"},
    {"=1", "unknown key"},
    {"drive.voltage=", "empty"},
    {"drive.voltage=# 5", "empty"},
    {"drive.voltage=[]", "empty list"},
    {"drive.voltage=[1, [2]]", "not lists"},
    {"drive.voltage=[1, 2 mm]", "\"2 mm\": not a voltage"},
    {"drive.voltage=[1", "column"},
    {"drive.voltage={a: 1}", "one value or a list"},
    {"drive.voltage=\xFF", "UTF-8"},
    {"drive.voltage\xFF=1", "unknown key"},
    {"study=[actuate]", "not a list"},
    {"load.mass=1 g .. 2 g", "write \"1 g .. 2 g : 20\""},
    {"load.mass=1 g .. 2 g : 1", "count = \"1\": give a whole number from 2 to 20000"},
    {"load.mass=1 g .. 2 g : many", "count = \"many\""},
    {"load.mass=1 g .. : 3", "to = \"\": empty"},
    {"load.mass=1 g .. 2 m : 3", "to = \"2 m\": not a mass"},
    {"load.mass=2 g .. 2 g : 3", "both ends of the range are equal"},
    {"load.mass=0 g .. 2 g : 3 log", "above 0"},
    {"load.mass=1 g .. 2 g : 3 cubic", "spacing = \"cubic\": give linear or log"},
    {"mesh.nodes=5 .. 10 : 3", "the range contains 7.5, which is not a whole number"},
    {"solver.time_step=auto .. 1 s : 3", "from = \"auto\": give a number"},
    {"ribbon.model=rod .. rod : 3", "give one value or a list"},
};

TESTS(test_bad_argument, 0, LENGTH_OF(bad_arguments)) {
  ZpScenario *s = scenario_of("drive.voltage: 3 kV");
  ck_says(zp_scenario_set(s, bad_arguments[_i].text, &err), ZP_BAD_INPUT, bad_arguments[_i].message);
  ck_assert_double_eq(case_of(s, 0).drive.voltage, 3e3);
}

TEST(test_layers) {
  ZpScenario *s = new_scenario();
  ZpError err = {0};
  ck_assert_int_eq(zp_scenario_set(s, "drive.voltage=5 kV", &err), ZP_OK);
  ck_assert_int_eq(zp_scenario_set(s, "drive.voltage = 6 kV", &err), ZP_OK);
  ck_assert_int_eq(parse(s, "drive.voltage: 7 kV\nload.mass: 1 g\ngravity: 1\nribbon.thickness: [1 mm, 2 mm]", &err),
                   ZP_OK);
  ck_assert_int_eq(parse(s, "load.mass: 2 g\nribbon.thickness: 40 um\n", &err), ZP_OK);
  ck_assert_uint_eq(zp_scenario_count(s), 1);
  ck_assert_int_eq(zp_scenario_set(s, "preset=paper-code", &err), ZP_OK);
  ZpActuatorDef def = case_of(s, 0);
  ck_assert_double_eq(def.drive.voltage, 6e3);
  ck_assert_double_eq(def.load.mass, 2e-3);
  ck_assert_double_eq(def.gravity, 1);
  ck_assert_double_eq(def.ribbon.thickness, 40e-6);
  ck_assert_double_eq(def.electro.force_scale, 6.6);
  assert_round_trip(s);
}

TEST(test_lists) {
  ZpScenario *s = scenario_of("mesh:\n  nodes: [21, 61, 130]\nload.mass:\n- 8 g\n- 0.012\nsolver.time_step: [auto]");
  size_t count = 0;
  ZpError err = {0};
  const int *list = zp_scenario_lists(s, &count);
  ck_assert_uint_eq(zp_scenario_count(s), 6);
  ck_assert_uint_eq(count, 3);
  ck_assert_int_eq(list[0], zp_key_find("load.mass"));
  ck_assert_int_eq(list[1], zp_key_find("mesh.nodes"));
  ck_assert_int_eq(list[2], zp_key_find("solver.time_step"));
  ck_assert_double_eq(case_of(s, 0).load.mass, 8e-3);
  ck_assert_int_eq(case_of(s, 2).mesh.nodes, 130);
  ck_assert_double_eq(case_of(s, 3).load.mass, 12e-3);
  ck_assert_int_eq(case_of(s, 4).mesh.nodes, 61);
  assert_round_trip(s);
  ZpActuatorDef def = {0};
  ck_assert_int_eq(zp_scenario_def(s, 6, &def, &err), ZP_BAD_INPUT);
  ck_assert_int_eq(zp_scenario_set(s, "mesh.nodes=[21,41]", &err), ZP_OK);
  ck_assert_uint_eq(zp_scenario_count(s), 4);
  ck_assert_int_eq(zp_scenario_set(s, "mesh.nodes=41", &err), ZP_OK);
  ck_assert_uint_eq(zp_scenario_count(s), 2);
  assert_round_trip(s);
}

/* Distributions, as a mapping, as a word, in --set: the same values, which survive writing. */
TEST(distributions_are_sampled) {
  ZpError err = {0};
  size_t count = 0;
  ZpScenario *s = scenario_of("load.mass: [8 g, 20 g]\nribbon.thickness: {normal: 50 um, sigma: 1 um}\n"
                              "ribbon.width: uniform(10 mm, 12 mm)\nsampling.count: 64");
  zp_scenario_lists(s, &count);
  ck_assert_uint_eq(count, 3);
  ck_assert_uint_eq(zp_scenario_count(s), 128);
  double sum = 0;
  for (size_t i = 0; i < 128; i++) {
    const ZpActuatorDef def = case_of(s, i);
    ck_assert_double_eq(def.load.mass, i < 64 ? 8e-3 : 20e-3);
    ck_assert(def.ribbon.width > 10e-3 && def.ribbon.width < 12e-3);
    ck_assert_double_eq(def.ribbon.width, case_of(s, i % 64).ribbon.width);
    sum += def.ribbon.thickness / 128;
  }
  ck_assert_double_eq_tol(sum, 50e-6, 2e-9); /* 2.7e-10 measured */
  assert_round_trip(s);
  ZpScenario *word = scenario_of("load.mass: [8 g, 20 g]\nribbon.width: uniform(10 mm, 12 mm)");
  ck_assert_int_eq(zp_scenario_set(word, "ribbon.thickness= normal( 50 um , 1 um )", &err), ZP_OK);
  ck_assert_int_eq(zp_scenario_set(word, "sampling.count=64", &err), ZP_OK);
  ck_assert_double_eq(case_of(word, 77).ribbon.thickness, case_of(s, 77).ribbon.thickness);
  ck_assert_int_eq(zp_scenario_set(word, "sampling.indices=true", &err), ZP_OK);
  ck_assert_uint_eq(zp_scenario_count(word), 2 * 64 * 4);
}

/* Lists that are walked through together make one axis, in the place of the last of them. */
/* Each material fills every key of its group but resistivity, with a value in its range. */
TESTS(materials_fill_their_group, 0, 5) {
  static const struct {
    const char *key;
    int fills;
  } of[] = {{"ribbon.material", 4},
            {"insulator.material", 4},
            {"medium.material", 5}, /* of a gas its mean free path, too; of a vacuum no viscosity */
            {"lower.ribbon.material", 4},
            {"lower.insulator.material", 4}};
  const int key = zp_key_find(of[_i].key);
  for (int word = 0; word <= (int)zp_key(key)->max; word++) {
    const ZpAssignment given = {key, word};
    ZpActuatorDef def = {0};
    ZpError err;
    int filled = 0;
    ck_assert_int_eq(zp_def_resolve(&def, &given, 1, &err), ZP_OK);
    ck_ok(zp_def_check(&def, &err));
    for (int i = 0; i < zp_key_count(); i++) {
      const ZpMaterialValue *value = zp_material_value(&def, i);
      if (!value) continue;
      filled++;
      ck_assert_double_eq(zp_def_get(&def, i), value->value);
      ck_assert(value->spread > 0 && strlen(value->source) > 0);
    }
    const bool gas = _i == 2 && word == ZP_MEDIUM_AIR, vacuum = _i == 2 && word == ZP_MEDIUM_VACUUM;
    ck_assert_int_eq(filled, word ? of[_i].fills + gas - vacuum : 0);
  }
}

static void assert_written(const ZpScenario *s, const char *part) {
  char *text = written(s);
  ck_assert_msg(strstr(text, part) != NULL, "no \"%s\" in %s", part, text);
}

static size_t count_varied(const ZpScenario *s) {
  size_t count;
  zp_scenario_lists(s, &count);
  return count;
}

/* Keys that a material fills vary as it says; a key that is given does not, or as it says itself. */
TEST(materials_have_tolerances) {
  ZpScenario *s = scenario_of("ribbon: {material: brass, density: 8000}\nlower.insulator.material: pdms\n"
                              "sampling: {tolerances: materials, count: 4}\n");
  ck_assert_uint_eq(count_varied(s), 3 + 4);
  ck_assert_uint_eq(zp_scenario_count(s), 4);
  ck_assert_double_eq(case_of(s, 3).ribbon.density, 8000);
  ck_assert(case_of(s, 0).ribbon.young_modulus != case_of(s, 1).ribbon.young_modulus);
  assert_written(s, "young_modulus: lognormal(110 GPa, 0.04)");
  assert_round_trip(s);
  ck_assert_int_eq(zp_scenario_set(s, "ribbon.young_modulus=normal(100 GPa, 1 GPa)", NULL), ZP_OK);
  ck_assert_uint_eq(count_varied(s), 3 + 4);
  assert_written(s, "young_modulus: normal(100 GPa, 1 GPa)");
  ck_assert_int_eq(zp_scenario_set(s, "sampling.tolerances=given", NULL), ZP_OK);
  ck_assert_uint_eq(count_varied(s), 1);
  ck_assert_double_eq(case_of(s, 0).ribbon.yield_stress, 430e6);
}

TEST(lists_together) {
  ZpError err = {0};
  ZpActuatorDef def = {0};
  ZpScenario *s = scenario_of("ribbon.thickness: [40 um, 50 um, 60 um]\nload.mass: [8 g, 20 g]\n"
                              "ribbon.length: [90 mm, 100 mm, 110 mm]\n"
                              "sampling.together: ribbon.thickness, ribbon.length");
  ck_assert_uint_eq(zp_scenario_count(s), 6);
  for (size_t i = 0; i < 6; i++) {
    def = case_of(s, i);
    ck_assert_double_eq_tol(def.ribbon.length, 90e-3 + 10e-3 * (double)(i / 2), 1e-15);
    ck_assert_double_eq_tol(def.ribbon.thickness, 40e-6 + 10e-6 * (double)(i / 2), 1e-18);
    ck_assert_double_eq(def.load.mass, i % 2 ? 20e-3 : 8e-3);
  }
  assert_round_trip(s);
  ck_assert_int_eq(zp_scenario_set(s, "ribbon.length=[90 mm, 100 mm]", &err), ZP_OK); /* another --set may mend it */
  ck_says(zp_scenario_def(s, 0, &def, &err), ZP_BAD_INPUT, "its list is not as long");
  ck_assert_int_eq(zp_scenario_set(s, "sampling.together=ribbon.width", &err), ZP_OK);
  ck_says(zp_scenario_def(s, 0, &def, &err), ZP_BAD_INPUT, "ribbon.width: has no list");
  ck_assert_int_eq(zp_scenario_set(s, "sampling.together=ribbon.length,", &err), ZP_OK);
  ck_says(zp_scenario_def(s, 0, &def, &err), ZP_BAD_INPUT, "sampling.together: a comma has no key");
  ck_assert_int_eq(zp_scenario_set(s, "sampling.together=\"\"", &err), ZP_OK);
  ck_assert_uint_eq(zp_scenario_count(s), 12);
}

/* What is no distribution, and why. */
static const struct {
  const char *text, *message;
} bad_spreads[] = {
    {"ribbon.thickness: {normal: 50 um}", "write {normal: ..., sigma: ...}"},
    {"ribbon.thickness: {normal: 50 um, to: 60 um}", "unknown part \"to\"; write {normal: ..., sigma: ...}"},
    {"ribbon.thickness: {sigma: 1 um}", "a range has no \"from\""},
    {"ribbon.thickness: {normal: 50 um, sigma: 0 um}", "sigma = \"0 um\": give a number above 0"},
    {"ribbon.thickness: {normal: 50 um, sigma: 1 g}", "sigma = \"1 g\": not a length"},
    {"ribbon.thickness: {normal: 50 m, sigma: 1 um}", "normal = \"50 m\": out of range"},
    {"ribbon.thickness: {lognormal: 50 um, sigma: 1 um}", "a number without a unit"},
    {"segment_1.curvature: {log_uniform: -1, to: 1}", "values above 0"},
    {"ribbon.thickness: uniform(60 um, 50 um)", "must be larger than the first"},
    {"ribbon.thickness: uniform(60 um)", "not a distribution"},
    {"mesh.nodes: {normal: 61, sigma: 2}", "takes one value, not a distribution"},
    {"sampling.count: [1, 2]", "sampling.count: takes one value, not a list"},
    {"ribbon.thickness: normal(50 um, 1 um)\nsampling.count: 1000000\nsampling.indices: true",
     "more than 1000000 cases"},
};

TESTS(bad_spread_says_why, 0, LENGTH_OF(bad_spreads)) {
  ZpScenario *s = new_scenario();
  ck_says(parse(s, bad_spreads[_i].text, &err), ZP_BAD_INPUT, bad_spreads[_i].message);
  ck_assert_uint_eq(zp_scenario_count(s), 1);
}

/* Ranges, in a file and in --set, and the list that says the same. */
static const struct {
  const char *file, *argument, *list;
} ranges[] = {
    {"load.mass: {from: 10 g, to: 30 g, count: 5}", "load.mass=10 g .. 30 g : 5",
     "load.mass: [10 g, 15 g, 20 g, 25 g, 30 g]"},
    {"load:\n  mass:\n    count: 3\n    to: 1 g\n    from: 100 g\n    spacing: log", "load.mass=100 g..1 g:3 log",
     "load.mass: [100 g, 10 g, 1 g]"},
    {"ribbon.thickness: {from: 20 um, to: 200 um, count: 10, spacing: linear}",
     "ribbon.thickness= 20 um .. 0.2 mm: 10 linear",
     "ribbon.thickness: [20 um, 40 um, 60 um, 80 um, 100 um, 120 um, 140 um, 160 um, 180 um, 200 um]"},
    {"mesh.nodes: {from: 21, to: 61, count: 3}", "mesh.nodes=21 .. 61 : 3", "mesh.nodes: [21, 41, 61]"},
    {"solver.time_step: {from: 1 us, to: 0.1 ms, count: 3, spacing: log}", "solver.time_step=1 us .. 0.1 ms : 3 log",
     "solver.time_step: [1 us, 10 us, 100 us]"},
};

TESTS(test_ranges, 0, LENGTH_OF(ranges)) {
  ZpScenario *file = scenario_of(ranges[_i].file), *argument = scenario_of(""), *list = scenario_of(ranges[_i].list);
  ck_ok(zp_scenario_set(argument, ranges[_i].argument, &err));
  char *wanted = written(list), *got = written(file), *also = written(argument);
  ck_assert_str_eq(got, wanted);
  ck_assert_str_eq(also, wanted);
  assert_round_trip(file);
}

/* The preset gives other values at each N: they cannot be written as one. */
TEST(test_preset_with_list) {
  ZpScenario *s = scenario_of("preset: paper-code\nmesh.nodes: [21, 61, 130]\nload.mass: [8 g, 10 g]");
  ck_assert_double_eq(case_of(s, 0).damping.drag, 10);
  ck_assert_double_eq(case_of(s, 1).damping.drag, 100);
  ck_assert_double_eq(case_of(s, 5).damping.drag, 0.1);
  char *text = written(s);
  ck_assert_ptr_nonnull(strstr(text, "# damping.drag: "));
  assert_round_trip(s);
}

/* Scenarios whose cases vary in ways that a Def common to all must not hide. */
static const char *const with_cases[] = {
    "load.mass: [2 g, 5 g, 9 g]\nribbon.thickness: [40 um, 61.3 um]\n",
    "preset: paper-code\nmesh.nodes: [21, 61, 130]\nload.mass: [2 g, 5 g]\n",
    "preset: paper-text\nload.mass: [2 g, 5 g]\nribbon.length: [90 mm, 110 mm]\n",
    "ribbon.material: steel_301\nribbon.density: [7000 kg/m3, 8000 kg/m3]\nload.mass: [2 g, 5 g]\n",
    "ribbon.material: steel_301\nmedium.material: silicone_oil_5cst\nsampling.tolerances: materials\n"
    "sampling.count: 8\n",
    "sampling.together: load.mass, ribbon.thickness\nload.mass: [2 g, 5 g]\nribbon.thickness: [40 um, 60 um]\n"
    "ribbon.width: [8 mm, 9 mm, 10 mm]\n",
    "source.supply: pocket_6kv\nload.mass: normal(8 g, 1 g)\nmesh.nodes: [21, 31]\nsampling.count: 4\n",
    "lower.ribbon.thickness: [auto, 60 um]\ninsulator.resistivity: [none, 1e13]\nliquid.model: auto\n",
    "stack.series: [1, 2]\nmember_1.ribbon.thickness: [auto, 40 um]\n",
};

/* Case `index` as a scenario of its own: the text, and its values in place of lists. */
static ZpActuatorDef def_by_values(const ZpScenario *s, size_t index, const char *text) {
  ZpError err;
  size_t keys;
  const int *key = zp_scenario_lists(s, &keys);
  double value[16];
  ZpScenario *alone = scenario_of(text);
  ck_assert_uint_le(keys, 16);
  zp_scenario_values(s, index, value);
  for (size_t i = 0; i < keys; i++) {
    char assignment[128], number[32];
    snprintf(number, sizeof number, "%.17g", value[i]);
    snprintf(assignment, sizeof assignment, "%s=%s", ZP_KEY_NAME(key[i]),
             isnan(value[i]) ? zp_key(key[i])->text : number);
    ck_ok(zp_scenario_set(alone, assignment, &err));
  }
  ck_assert_int_eq(zp_scenario_set(alone, "sampling.together=\"\"", &err), ZP_OK);
  ck_assert_uint_eq(zp_scenario_count(alone), 1);
  ZpActuatorDef def = {0};
  ck_assert_int_eq(zp_scenario_given(alone, 0, &def, NULL), ZP_OK);
  lend_members(&def);
  return def;
}

/* A case is what its values give without the others, whatever the cases have in common. */
TESTS(a_case_is_that_of_its_values, 0, LENGTH_OF(with_cases)) {
  const char *text = with_cases[_i];
  ZpScenario *s = scenario_of(text);
  ck_assert_uint_gt(zp_scenario_count(s), 3);
  for (size_t k = 0; k < zp_scenario_count(s); k++) {
    ZpActuatorDef def = {0}, alone = def_by_values(s, k, text);
    ck_assert_int_eq(zp_scenario_given(s, k, &def, NULL), ZP_OK);
    lend_members(&def);
    assert_same_def(&def, &alone);
  }
}

TEST(test_def_errors) {
  ZpScenario *s = scenario_of("preset: paper-text\nmesh.nodes: [61, 41]");
  ZpActuatorDef def = {0};
  ZpError err = {0};
  ck_assert_int_eq(zp_scenario_def(s, 0, &def, &err), ZP_OK);
  ck_says(zp_scenario_def(s, 1, &def, &err), ZP_BAD_INPUT, "test.yaml: row 2 of 2: damping.drag");
  FILE *file = tmpfile();
  ck_assert_int_eq(zp_scenario_write(s, file, &err), ZP_BAD_INPUT);
  fclose(file);
  s = scenario_of("platform.length: 1 m");
  ck_says(zp_scenario_def(s, 0, &def, &err), ZP_BAD_INPUT, "test.yaml: platform.length");
}

/* "KEY: [1, 1, ...]" with `count` values, to be freed. */
static char *list_text(const char *key, size_t count) {
  char *text = malloc(strlen(key) + 4 * count + 16);
  ck_assert_ptr_nonnull(text);
  char *end = text + sprintf(text, "%s: [1", key);
  for (size_t i = 1; i < count; i++)
    end += sprintf(end, ", 1");
  strcpy(end, "]\n");
  return zp_test_owns(text, free);
}

TEST(test_limits) {
  ZpScenario *s = new_scenario();
  ZpError err = {0};
  char *text = list_text("load.mass", 20001);
  ck_says(parse(s, text, &err), ZP_BAD_INPUT, "20000 values");
  static const char *const keys[] = {"load.mass", "ribbon.length", "gravity"};
  for (size_t i = 0; i < 3; i++) {
    text = list_text(keys[i], 101);
    ck_assert_int_eq(parse(s, text, &err), i < 2 ? ZP_OK : ZP_BAD_INPUT);
  }
  ck_assert_ptr_nonnull(strstr(err.message, "1000000 combinations"));
  ck_assert_uint_eq(zp_scenario_count(s), 101 * 101);
  size_t size = (1 << 20) + 1;
  text = malloc(size);
  memset(text, '\n', size);
  ck_says(zp_scenario_parse(s, text, size, "big.yaml", &err), ZP_BAD_INPUT, "1 MB");
  ck_assert_int_eq(zp_scenario_parse(s, text, size - 1, "big.yaml", &err), ZP_OK);
  memset(text, '[', size);
  ck_assert_int_eq(zp_scenario_parse(s, text, size - 1, "deep.yaml", &err), ZP_BAD_INPUT);
  free(text);
}

TEST(test_long_names) {
  ZpScenario *s = new_scenario();
  ZpError err = {0};
  char name[3000];
  memset(name, 'n', sizeof name);
  strcpy(name + sizeof name - 11, "/last.yaml");
  ck_says(zp_scenario_parse(s, "load.mass: 1 kV", 15, name, &err), ZP_BAD_INPUT,
          "/last.yaml:1: load.mass = \"1 kV\": not a mass; give a value in g");
  memset(name, 'n', sizeof name);
  name[sizeof name - 1] = 0;
  ck_assert_int_eq(zp_scenario_set(s, name, &err), ZP_BAD_INPUT);
  name[2000] = '=';
  ck_says(zp_scenario_set(s, name, &err), ZP_BAD_INPUT, "unknown key");
}

/* Every key at its default, its limits and at values that have no short decimal. */
static void assert_value_round_trip(int key, double value) {
  char text[256];
  double back = -1;
  zp_value_print(key, value, text, sizeof text);
  ck_ok(zp_value_parse(key, text, &back, &err));
  ck_assert_msg(same_bits(value, back), "%s: %s: %.17g became %.17g", zp_key(key)->name, text, value, back);
}

TESTS(test_value_round_trip, 0, zp_key_count()) {
  const ZpKey *key = zp_key(_i);
  if (key->type == ZP_KEY_TEXT) return;
  assert_value_round_trip(_i, key->def);
  assert_value_round_trip(_i, key->min);
  assert_value_round_trip(_i, key->max);
  unsigned long long random = 88172645463325252ull;
  for (int i = 0; i < 100 && key->type <= ZP_KEY_REAL_AUTO; i++) {
    random ^= random << 13, random ^= random >> 7, random ^= random << 17;
    double share = (double)(random >> 11) * 0x1p-53;
    assert_value_round_trip(_i, key->min + share * (key->max - key->min));
    assert_value_round_trip(_i, fmax(key->min, key->max * pow(10, -12 * share)));
  }
}

/* A scenario that sets one key: it need not pass the check of the whole Def to be written. */
TESTS(test_scenario_round_trip, 0, zp_key_count()) {
  const ZpKey *key = zp_key(_i);
  const int index = key_of_one(_i);
  const char *name = ZP_KEY_NAME(index);
  if (key->type == ZP_KEY_TEXT || zp_key_is_name(index)) return; /* test_texts; test_network */
  double values[] = {key->min, key->max, key->min + (key->max - key->min) / 3};
  for (size_t i = 0; i < LENGTH_OF(values); i++) {
    char value[256], line[512];
    zp_value_print(index, key->type > ZP_KEY_REAL_AUTO ? floor(values[i]) : values[i], value, sizeof value);
    snprintf(line, sizeof line, "%s: %s\n", name, value);
    ZpScenario *s = scenario_of(line);
    char *text = written(s);
    if (strcmp(value, "auto") == 0) line[strlen(line) - 1] = 0; /* what it stands for may follow */
    const char *point = strrchr(name, '.');                     /* lower.ribbon.width stands as width in its group */
    const char *leaf = point ? line + (point + 1 - name) : line;
    ck_assert_msg(strstr(text, leaf) != NULL, "%s", line);
    ZpScenario *back = scenario_of(text);
    char *again = written(back);
    ck_assert_str_eq(text, again);
  }
}

/* Texts come back as they were, whatever is in them; a file is kept as an absolute path. */
TEST(test_texts) {
  ZpScenario *s = scenario_of("calibrate:\n  fit: a \"b\" \\ c, [d] é\n  x: 'it''s # not a comment'\n  y: "
                              "\"0.5\"\ndata.file: /folder/a b.csv\n");
  char *text = written(s);
  ZpScenario *back = scenario_of(text);
  ZpActuatorDef def = case_of(back, 0), first = case_of(s, 0);
  ck_assert_str_eq(def.calibrate.fit, "a \"b\" \\ c, [d] é");
  ck_assert_str_eq(def.calibrate.x, "it's # not a comment");
  ck_assert_str_eq(def.calibrate.y, "0.5");
  ck_assert_str_eq(def.data.file, "/folder/a b.csv");
  ck_assert_mem_eq(&def, &first, sizeof def);
  ZpError err;
  ck_assert_int_eq(zp_scenario_set(s, "calibrate.fit=ribbon.width, ribbon.thickness", &err), ZP_OK);
  ck_assert_int_eq(zp_scenario_set(s, "data.file=b.csv", &err), ZP_OK);
  def = case_of(s, 0);
  ck_assert_str_eq(def.calibrate.fit, "ribbon.width, ribbon.thickness");
  ck_assert(*def.data.file == '/' && strstr(def.data.file, "/b.csv"));
  ck_says(zp_scenario_set(s, "calibrate.x=[a, b]", &err), ZP_BAD_INPUT, "takes one text");
  ck_says(zp_scenario_set(s, "calibrate.x=\"a\\tb\"", &err), ZP_BAD_INPUT, "control character");
  char longest[400] = "calibrate.x=";
  memset(longest + strlen(longest), 'x', ZP_TEXT_SIZE);
  ck_says(zp_scenario_set(s, longest, &err), ZP_BAD_INPUT, "longer than 255");
}

TEST(test_print) {
  char text[64];
  zp_value_print(zp_key_find("ribbon.length"), 0.1, text, sizeof text);
  ck_assert_str_eq(text, "100 mm");
  zp_value_print(zp_key_find("ribbon.thickness"), 50e-6, text, sizeof text);
  ck_assert_str_eq(text, "50 um");
  zp_value_print(zp_key_find("solver.time_step"), NAN, text, sizeof text);
  ck_assert_str_eq(text, "auto");
  zp_value_print(zp_key_find("platform.electrode"), 1, text, sizeof text);
  ck_assert_str_eq(text, "true");
  zp_value_print(zp_key_find("electro.model"), ZP_ELECTRO_PLATES, text, sizeof text);
  ck_assert_str_eq(text, "plates");
  zp_value_print(zp_key_find("mesh.nodes"), 61, text, sizeof text);
  ck_assert_str_eq(text, "61");
  zp_value_print(zp_key_find("mesh.nodes"), 61, text, 2);
  ck_assert_str_eq(text, "6");
}

/* What zp_keys_write gives, to be freed. */
static char *keys_text(ZpKeysFormat format) {
  char *text = NULL;
  size_t size = 0;
  FILE *file = open_memstream(&text, &size);
  ck_assert_ptr_nonnull(file);
  ck_ok(zp_keys_write(format, file, &err));
  ck_assert_int_eq(fclose(file), 0);
  return zp_test_owns(text, free);
}

TEST(test_keys_yaml) {
  char *text = keys_text(ZP_KEYS_YAML);
  ZpScenario *s = scenario_of(text);
  ZpActuatorDef def = case_of(s, 0), expected = zp_actuator_def_default();
  assert_same_def(&def, &expected);
}

TEST(test_keys_json) {
  char *text = keys_text(ZP_KEYS_JSON);
  json_t *list = json_loads(text, 0, NULL);
  ck_assert_int_eq((int)json_array_size(list), zp_key_count());
  for (int i = 0; i < zp_key_count(); i++) {
    const ZpKey *key = zp_key(i);
    json_t *row = json_array_get(list, (size_t)i);
    json_t *def = json_object_get(row, "default");
    ck_assert_str_eq(json_string_value(json_object_get(row, "key")), key->name);
    ck_assert_str_eq(json_string_value(json_object_get(row, "unit")), key->unit);
    ck_assert_str_eq(json_string_value(json_object_get(row, "help")), key->help);
    if (key->type == ZP_KEY_REAL_AUTO && isnan(key->def)) ck_assert_str_eq(json_string_value(def), key->text);
    if (key->type == ZP_KEY_REAL_AUTO && !isnan(key->def)) ck_assert(json_number_value(def) == key->def);
    if (key->type == ZP_KEY_REAL || key->type == ZP_KEY_INT) ck_assert(json_number_value(def) == key->def);
    if (key->type == ZP_KEY_BOOL) ck_assert_int_eq(json_is_true(def), key->def != 0);
    if (key->type == ZP_KEY_ENUM) {
      ck_assert_str_eq(json_string_value(def), key->choices[(int)key->def].word);
      ck_assert_int_eq((int)json_array_size(json_object_get(row, "choices")), (int)key->max + 1);
    } else if (key->type == ZP_KEY_TEXT) {
      ck_assert_str_eq(json_string_value(def), key->text);
    } else if (key->type != ZP_KEY_BOOL) {
      ck_assert(json_number_value(json_object_get(row, "min")) == key->min);
      ck_assert(json_number_value(json_object_get(row, "max")) == key->max);
    }
  }
  json_decref(list);
}

TEST(test_keys_text) {
  char *text = keys_text(ZP_KEYS_TEXT);
  for (int i = 0; i < zp_key_count(); i++) {
    ck_assert_ptr_nonnull(strstr(text, zp_key(i)->name));
    ck_assert_ptr_nonnull(strstr(text, zp_key(i)->help));
  }
  ck_assert_ptr_nonnull(strstr(text, "1 um to 5000 um"));
  ck_assert_ptr_nonnull(strstr(text, "bezier: "));
}

TEST(test_full_disk) {
  ZpScenario *s = new_scenario();
  ZpError err = {0};
  FILE *full = fopen("/dev/full", "w");
  ck_assert_ptr_nonnull(full);
  ck_assert_int_eq(zp_scenario_write(s, full, &err), ZP_MACHINE);
  fclose(full);
  for (ZpKeysFormat format = ZP_KEYS_TEXT; format <= ZP_KEYS_YAML; format++) {
    full = fopen("/dev/full", "w");
    ck_assert_int_eq(zp_keys_write(format, full, &err), ZP_MACHINE);
    fclose(full);
  }
}

TEST(test_files) {
  ZpScenario *s = new_scenario();
  ZpError err = {0};
  ck_says(zp_scenario_read(s, "/nowhere/x.yaml", &err), ZP_BAD_INPUT, "/nowhere/x.yaml");
  ck_assert_int_eq(zp_scenario_read(s, "/", &err), ZP_MACHINE);
  ck_assert_int_eq(zp_scenario_read(s, "/dev/null", &err), ZP_OK);
  ck_says(zp_scenario_read(s, "/dev/zero", &err), ZP_BAD_INPUT, "1 MB");
}

static void *parse_often(void *bad) {
  int key = zp_key_find("ribbon.thickness");
  for (int i = 0; i < 500; i++) {
    double value = 0;
    char text[64];
    snprintf(text, sizeof text, "%d um", i + 1);
    zp_value_parse(key, "5 kV", &value, NULL);
    if (zp_value_parse(key, text, &value, NULL) != ZP_OK || fabs(value - (i + 1) * 1e-6) > 1e-12) *(bool *)bad = true;
  }
  return NULL;
}

TEST(test_threads) {
  pthread_t thread[4];
  bool bad[4] = {false};
  for (int i = 0; i < 4; i++)
    ck_assert_int_eq(pthread_create(&thread[i], NULL, parse_often, &bad[i]), 0);
  for (int i = 0; i < 4; i++) {
    ck_assert_int_eq(pthread_join(thread[i], NULL), 0);
    ck_assert(!bad[i]);
  }
}

/* With a decimal comma, where the machine has such a locale. */
TEST(test_locale) {
  static const char *const names[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "fr_FR"};
  for (size_t i = 0; i < LENGTH_OF(names); i++)
    if (setlocale(LC_ALL, names[i])) break;
  char *text = keys_text(ZP_KEYS_YAML);
  ck_assert_ptr_nonnull(strstr(text, "12.7 mm"));
  ck_assert_double_eq(value_in("load.mass: 1.5 g", "load.mass"), 1.5e-3);
  ck_assert_double_eq(value_in("ribbon.length: 2.5 in", "ribbon.length"), 2.5 * 0.0254);
}

/* Names that are no keys of members, with what to give instead. */
TEST(members_that_are_none_are_refused) {
  static const char *const wrong[][2] = {
      {"member_0.ribbon.thickness=60 um", "have the numbers 1 to 1024"},
      {"member_1025.ribbon.thickness=60 um", "have the numbers 1 to 1024"},
      {"member_K.ribbon.thickness=60 um", "have the numbers 1 to 1024"},
      {"member_03.ribbon.thickness=60 um", "have the numbers 1 to 1024"},
      {"member_3.ribbon.thicknes=60 um", "mean member_3.ribbon.thickness?"},
      {"member_12.load.mass=60 g", "member_12 has upper, lower, angle, upper_at, lower_at, port, drive, source, sense, "
                                   "control, setpoint, ribbon, "},
      {"member_12=60 um", "such as member_12.upper"},
      {"member_12.ribbon.thickness=1 m", "out of range; 1 um to 5000 um or auto"},
      {"stack.series=2000", "out of range; 1 to 1024"}};
  for (size_t k = 0; k < LENGTH_OF(wrong); k++)
    ck_says(zp_scenario_set(new_scenario(), wrong[k][0], &err), ZP_BAD_INPUT, wrong[k][1]);
}

/* Members vary where the table has their keys: after those of the stack, in the order of their numbers, and before what
 * follows. */
/* Those with data files name them relative to the folder of the file. */
TEST(examples_are_written_as_they_are_read) {
  glob_t found;
  ck_assert_int_eq(glob(ZP_SOURCE_DIR "/examples/*.yaml", 0, NULL, &found), 0);
  for (size_t k = 0; k < found.gl_pathc; k++) {
    ZpScenario *s = new_scenario(), *back = new_scenario();
    ZpError err = {0};
    ck_assert_msg(zp_scenario_read(s, found.gl_pathv[k], &err) == ZP_OK, "%s", err.message);
    char *text = written(s);
    ck_assert_msg(zp_scenario_parse(back, text, strlen(text), ZP_SOURCE_DIR "/examples/again.yaml", &err) == ZP_OK,
                  "%s: %s", found.gl_pathv[k], err.message);
    ck_assert_str_eq(written(back), text);
  }
  globfree(&found);
}

TEST(members_vary_in_the_order_of_the_table) {
  ZpScenario *s =
      scenario_of("gravity: [1, 2]\nmember_12: {ribbon: {thickness: [50 um, 60 um]}}\nstack.series: [12, 13]\n"
                  "member_2.insulator.thickness: [auto, 100 um]\n");
  const char *const order[] = {"stack.series", "member_2.insulator.thickness", "member_12.ribbon.thickness", "gravity"};
  size_t keys;
  const int *key = zp_scenario_lists(s, &keys);
  ck_assert_uint_eq(keys, LENGTH_OF(order));
  for (size_t k = 0; k < keys; k++)
    ck_assert_str_eq(ZP_KEY_NAME(key[k]), order[k]);
  ck_assert_uint_eq(zp_scenario_count(s), 16);
  ZpActuatorDef def = case_of(s, 15);
  ck_assert_double_eq(zp_def_number(&def, "member_2.insulator.thickness"), 100e-6);
  ck_assert_double_eq(zp_def_number(&def, "member_12.ribbon.thickness"), 60e-6);
  char *text = written(s), *again = written(scenario_of(text));
  ck_assert_str_eq(text, again);
}
