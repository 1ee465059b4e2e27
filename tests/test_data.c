/* What enters from files and lists, read directly: numbers of tables as spreadsheets of any country have them,
 * waveforms and setpoints of files, lines of faults, samples and lists of a scenario. */
#include "files_util.h"

#include "io/data.h"
#include "io/drive_table.h"
#include "io/plan.h"
#include "io/units.h"

/* FOLDER/name with this text => its path, to be freed. */
static char *put_file(const char *name, const char *text) {
  char *path = path_of(name);
  write_file(path, text);
  return path;
}

/* -- tables ------------------------------------------------------------------------------------------ */

/* The number of a row in the column of that name, in SI. */
static double number_of(const ZpData *data, size_t row, const char *column, const char *stem, const char *unit) {
  const int place = zp_data_column(data, column);
  double value;
  ZpUnitScale scale;
  ck_assert_msg(place >= 0, "no %s", column);
  ck_assert(zp_data_unit(data->cell[place], stem, unit, &scale));
  ck_ok(zp_data_number(data, row, (size_t)place, &value, &err));
  return zp_unit_apply(&scale, value, 1);
}

/* A spreadsheet's file with a byte order mark, semicolons, decimal commas, remarks, names in other letters, and no end
 * of its last line; another one with points. A column is renamed in both. */
TEST(tables_as_spreadsheets_have_them) {
  char *one = put_file("one.csv", "\xEF\xBB\xBF"
                                  "Gewicht;Stroke (mm);note\n# of Monday\n\n1,5;2,25;\"a; b\"\r\n3;-4,5;c"),
       *two = put_file("two.csv", "stroke_m,Gewicht\n0.5,7\n"), paths[256];
  ZpDataFiles files;
  snprintf(paths, sizeof paths, "%s; %s", one, two);
  ck_ok(zp_data_read_all("data.file", paths, "Gewicht = Load_g", true, &files, &err));
  ck_assert_uint_eq(files.count, 2);
  const ZpData *first = &files.file[0], *second = &files.file[1];
  ck_assert(first->rows == 2 && first->columns == 3 && second->rows == 1);
  ck_assert_double_eq(number_of(first, 0, "load_g", "load", "kg"), 1.5e-3);
  ck_assert_double_eq(number_of(first, 1, "load_g", "load", "kg"), 3e-3);
  ck_assert_double_eq(number_of(first, 0, "stroke_mm", "stroke", "m"), 2.25e-3);
  ck_assert_double_eq(number_of(first, 1, "stroke_mm", "stroke", "m"), -4.5e-3);
  ck_assert_double_eq(number_of(second, 0, "LOAD_g", "load", "kg"), 7e-3);
  ck_assert_double_eq(number_of(second, 0, "stroke_m", "stroke", "m"), 0.5);
  ck_assert_int_lt(zp_data_column(first, "stroke_Mm"), 0); /* millions of metres */
  ck_assert_int_eq(zp_data_line(first, 0), 4);
  ck_assert_int_eq(zp_data_line(first, 1), 5);
  ck_assert_int_eq(zp_data_line(second, 0), 2);
  zp_data_files_destroy(&files);
}

/* -- waveforms --------------------------------------------------------------------------------------- */

static ZpStatus read_rows(const char *text, bool controlled, ZpDriveRows *rows, ZpError *err) {
  ZpActuatorDef def = zp_actuator_def_default();
  char *path = put_file("rows.csv", text);
  if (controlled) {
    def.control.kind = ZP_CONTROL_PI;
    snprintf(def.setpoint.file, sizeof def.setpoint.file, "%s", path);
  } else {
    snprintf(def.drive.file, sizeof def.drive.file, "%s", path);
  }
  return zp_drive_rows_read(&def, rows, err);
}

static void expect_rows(const char *text, bool controlled, double time, double value) {
  ZpDriveRows rows;
  ck_ok(read_rows(text, controlled, &rows, &err));
  ck_assert_uint_eq(rows.count, 2);
  ck_assert_double_eq(rows.time[1], time);
  ck_assert_double_eq(rows.voltage[1], value);
  zp_drive_rows_free(&rows);
}

/* Times and voltages in the units of their columns; setpoints in that of the signal, here an opening. A fault is told
 * with its line. */
TEST(waveforms_of_files) {
  ZpDriveRows rows;
  expect_rows("time_ms,voltage_kV\n0,0\n25,7.5\n", false, 25e-3, 7500);
  expect_rows("time_s;voltage_V\n0;0\n0,5;250,5\n", false, 0.5, 250.5);
  expect_rows("time_ms,setpoint_mm\n0,1\n2,12.5\n", true, 2e-3, 12.5e-3);
  ck_says(read_rows("time_ms,voltage_kV\n# rest\n0,0\n5,1\n4,2\n", false, &rows, &err), ZP_BAD_INPUT, "rows.csv:5:");
  zp_drive_rows_free(&rows);
}

/* -- values ------------------------------------------------------------------------------------------ */

static ZpStatus parse(const char *key, const char *text, double *value) {
  return zp_value_parse(zp_key_find(key), text, value, NULL);
}

static void expect_value(const char *key, const char *text, double expected) {
  double value = NAN;
  ck_assert_msg(parse(key, text, &value) == ZP_OK && value == expected, "%s = %s: %.17g, not %.17g", key, text, value,
                expected);
}

/* The ends of each range are in it. */
TEST(ranges_have_their_ends) {
  double value;
  char text[128];
  for (int k = 0; k < zp_key_count(); k++) {
    const ZpKey *key = zp_key(k);
    if (key->type != ZP_KEY_REAL && key->type != ZP_KEY_REAL_AUTO && key->type != ZP_KEY_INT) continue;
    for (int end = 0; end < 2; end++) {
      snprintf(text, sizeof text, "%.17g", end ? key->max : key->min);
      expect_value(key->name, text, (end ? key->max : key->min) + 0.0);
    }
  }
  ck_assert_int_ne(parse("load.mass", "1e-400", &value), ZP_OK); /* no number, and not 0 */
  ck_assert_int_ne(parse("insulator.permittivity", "3 V/m", &value), ZP_OK);
  expect_value("control.proportional", "3 kV/m", 3000);
  expect_value("ribbon.poisson_ratio", "25 %", 0.25);
  expect_value("platform.rotates", "no", 0);
  expect_value("platform.rotates", "off", 0);
  expect_value("platform.rotates", "yes", 1);
  expect_value("mount.tilt", "90 degree", 1.5707963267948966);
  expect_value("mount.tilt", "12.3456789 degree", 12.3456789 * 3.1415926535897932 / 180);
}

/* Units differ from SI by a factor, not by an offset; a number is no unit, but 1/... is. */
TEST(units_are_factors) {
  ZpUnitScale scale;
  ck_assert_int_ne(zp_unit_scale("celsius", "K", &scale, NULL), ZP_OK);
  ck_assert_int_ne(zp_unit_scale("2 m", "m", &scale, NULL), ZP_OK);
  ck_assert_int_ne(zp_unit_scale("1000 m", "m", &scale, NULL), ZP_OK);
  ck_assert_int_eq(zp_unit_scale("1/mm", "1/m", &scale, NULL), ZP_OK);
  ck_assert(scale.decimal && scale.exponent == 3);
}

/* -- lists and samples --------------------------------------------------------------------------------- */

static void values_of_case(const ZpScenario *scenario, size_t index, double value[4]) {
  ck_assert_uint_lt(index, zp_scenario_count(scenario));
  zp_scenario_values(scenario, index, value);
}

/* A range has both ends and equal steps, or equal ratios; of lists that vary together the shortest counts, and they do
 * not multiply; samples vary fastest. */
TEST(cases_follow_their_lists) {
  double value[4], other[4];
  ZpScenario *scenario =
      SCENARIO("ribbon.length=100 mm .. 400 mm : 4", "ribbon.thickness=20 um .. 80 um : 3 log", "load.mass=[1 g, 2 g]",
               "drive.voltage=[1 kV, 2 kV]", "sampling.together=load.mass, drive.voltage");
  ck_assert_uint_eq(zp_scenario_count(scenario), 4 * 3 * 2);
  for (size_t i = 0; i < 4 * 3 * 2; i++) {
    values_of_case(scenario, i, value);
    ck_near(value[0], 0.1 * (double)(i / 6 + 1), 1e-12);
    ck_near(value[1], 20e-6 * pow(2, (double)(i / 2 % 3)), 1e-12);
    ck_near(value[2], 1e-3 * (double)(i % 2 + 1), 1e-12);
    ck_near(value[3], 1e3 * (double)(i % 2 + 1), 1e-12);
  }
  zp_scenario_destroy(scenario);
  scenario = SCENARIO("load.mass=[1 g, 2 g]", "drive.voltage=[1 kV, 2 kV, 3 kV]",
                      "sampling.together=load.mass, drive.voltage"); /* a later assignment may make them alike */
  ck_assert_uint_eq(zp_scenario_count(scenario), 2);
  scenario = SCENARIO("ribbon.thickness=uniform(40 um, 60 um)", "load.mass=[1 g, 2 g]", "sampling.count=8",
                      "sampling.method=random");
  ZpScenario *seeded = SCENARIO("ribbon.thickness=uniform(40 um, 60 um)", "load.mass=[1 g, 2 g]", "sampling.count=8",
                                "sampling.method=random", "sampling.seed=2");
  for (size_t i = 0; i < 16; i++) {
    char text[32];
    values_of_case(scenario, i, value);
    values_of_case(scenario, (i + 8) % 16, other);
    ck_near(value[1], i < 8 ? 1e-3 : 2e-3, 1e-12);
    ck_assert_double_eq(value[0], other[0]); /* each combination has all samples */
    snprintf(text, sizeof text, "%.12g", value[0]);
    ck_assert_double_eq(value[0], strtod(text, NULL)); /* twelve digits, as in files */
    snprintf(text, sizeof text, "%.7g", value[0]);
    ck_assert_double_ne(value[0], strtod(text, NULL));
    values_of_case(seeded, i, other);
    ck_assert_double_ne(value[0], other[0]);
  }
}

/* A distribution is written as it reads back: the width of a logarithm has no unit. Its ends are in order. */
TEST(distributions_are_written_as_they_read) {
  char *text = NULL;
  size_t size = 0;
  ZpError err;
  ZpScenario *scenario = SCENARIO("ribbon.thickness=lognormal(50 um, 0.1)", "load.mass=uniform(1 g, 2 g)"),
             *again = new_scenario();
  FILE *file = open_memstream(&text, &size);
  ck_assert_int_eq(zp_scenario_write(scenario, file, NULL), ZP_OK);
  fclose(file);
  ck_ok(zp_scenario_parse(again, text, size, "written", &err));
  const int thickness = zp_key_find("ribbon.thickness");
  const ZpDistribution *d = zp_scenario_spread(again, thickness);
  ck_assert(d && d->kind == ZP_DISTRIBUTION_LOGNORMAL && d->a == 50e-6 && d->b == 0.1);
  ck_assert_int_ne(zp_scenario_set(again, "load.mass=uniform(2 g, 1 g)", &err), ZP_OK);
  ck_assert_int_ne(zp_scenario_set(again, "load.mass=uniform(2 g, 2 g)", &err), ZP_OK);
  free(text);
}
