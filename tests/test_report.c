/* Writing of results: what is in the files, that the same result gives the same bytes, and that a
 * failure leaves neither halves nor temporaries behind. The results are made up: two smooth ribbons of
 * 45 mm that zip from the clip in 75 ms. Those of the studies of rest are real: they take milliseconds. */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <jansson.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "data_util.h"
#include "io/drawing.h"
#include "io/file.h"

#define NODES    61
#define HALF     45e-3
#define OPENING  20e-3
#define ZIP_TIME 75e-3

static char base[1024]; /* folder of the test that runs */
static char notices[2048];

static void note(const char *message) {
  size_t used = strlen(notices);
  snprintf(notices + used, sizeof notices - used, "%s\n", message);
}

static int remove_entry(const char *path, const struct stat *info, int kind, struct FTW *place) {
  (void)info, (void)kind, (void)place;
  return remove(path);
}

static void set_up(void) {
  char here[900];
  ck_assert_ptr_nonnull(getcwd(here, sizeof here));
  snprintf(base, sizeof base, "%s/zipact-report-XXXXXX", here);
  ck_assert_ptr_nonnull(mkdtemp(base));
  notices[0] = 0;
}

static void tear_down(void) {
  nftw(base, remove_entry, 16, FTW_DEPTH | FTW_PHYS);
}

/* Without set_up() the folder of a test is the root of the machine. */
AROUND_EACH(set_up, tear_down)

/* "base/name"; a few of them live at a time. */
static char *in_base(const char *name) {
  static char path[4][1280];
  static int next;
  next = (next + 1) % 4;
  snprintf(path[next], sizeof path[next], "%s/%s", base, name);
  return path[next];
}

static bool exists(const char *name) {
  return access(in_base(name), F_OK) == 0;
}

static char *read_whole(const char *path, size_t *size) {
  FILE *file = fopen(path, "r");
  ck_assert_msg(file != NULL, "%s: %s", path, strerror(errno));
  fseek(file, 0, SEEK_END);
  *size = (size_t)ftell(file);
  rewind(file);
  char *text = calloc(*size + 1, 1);
  ck_assert_ptr_nonnull(text);
  ck_assert_uint_eq(fread(text, 1, *size, file), *size);
  fclose(file);
  return zp_test_owns(text, free);
}

static void put_file(const char *name, const char *text) {
  write_file(in_base(name), text);
}

/* Fill one frame of made up ribbons at `time`. */
static void offer_shape(ZpShapes *shapes, double time, double voltage) {
  double x[2 * NODES], y[2 * NODES], gap[NODES], force[NODES];
  double done = pow(time / ZIP_TIME, 2), opening = OPENING * (1 - done), front = done;
  size_t ribbons = shapes->ribbons;
  for (size_t i = 0; i < NODES; i++) {
    double s = (double)i / (NODES - 1), xi = s > front ? (s - front) / (1 - front + 1e-12) : 0;
    double bow = opening * (3 * xi * xi - 2 * xi * xi * xi);
    gap[i] = bow;
    force[i] = 1 / (1e-3 + bow);
    for (size_t r = 0; r < ribbons; r++) {
      x[i * ribbons + r] = HALF - (1 - s) * HALF * (1 - 0.3 * opening * opening / (HALF * HALF));
      y[i * ribbons + r] = -opening / 2 + (r == 0 ? bow / 2 : -bow / 2);
    }
  }
  zp_shapes_offer(shapes, &(ZpShape){.time = time,
                                     .voltage = voltage,
                                     .zipped = (size_t)(front * (NODES - 1)),
                                     .x = x,
                                     .y = y,
                                     .gap = ribbons > 1 ? gap : NULL,
                                     .line_force = ribbons > 1 ? force : NULL});
}

/* Value of a made up signal. What a kind ribbon does not have is NAN. */
static double signal_value(const char *name, double time, double voltage, bool ribbon) {
  double done = pow(time / ZIP_TIME, 2), opening = OPENING * (1 - done);
  if (strcmp(name, "time_s") == 0) return time;
  if (strcmp(name, "stroke_m") == 0) return opening / 2;
  if (strstr(name, "velocity")) return 2 * OPENING * time / (ZIP_TIME * ZIP_TIME);
  if (strcmp(name, "kinetic_energy_J") == 0) return 4e-4 * done;
  if (strcmp(name, "bending_energy_J") == 0) return 8e-4 * (1 - done);
  if (strcmp(name, "axial_energy_J") == 0) return 1e-5 * done;
  if (strcmp(name, "gravity_energy_J") == 0) return -8e-3 * 9.81 * opening;
  if (strcmp(name, "drag_loss_J") == 0) return 5e-4 * done * done;
  if (strcmp(name, "energy_imbalance_J") == 0) return 1e-6 * sin(200 * time);
  if (ribbon) return NAN;
  if (strcmp(name, "voltage_V") == 0) return voltage;
  if (strcmp(name, "opening_m") == 0) return opening;
  if (strcmp(name, "contraction") == 0) return done;
  if (strcmp(name, "zipped_length_m") == 0) return HALF * done;
  if (strcmp(name, "charge_C") == 0) return 3e-6 * (0.2 + done);
  if (strcmp(name, "capacitance_F") == 0) return 3e-10 * (0.2 + done);
  if (strcmp(name, "current_A") == 0) return time > 0 ? 6e-6 * time / (ZIP_TIME * ZIP_TIME) : NAN;
  if (strcmp(name, "force_N") == 0) return 0.1 + 3 * done * done;
  if (strcmp(name, "electric_work_J") == 0) return 3e-3 * done;
  return strcmp(name, "field_energy_J") == 0 ? 1.5e-3 * (0.2 + done) : 0;
}

static void offer_row(ZpTable *table, double time, double voltage, bool ribbon) {
  double row[64];
  for (size_t i = 0; i < table->columns; i++)
    row[i] = signal_value(table->column[i].name, time, voltage, ribbon);
  zp_table_offer(table, row);
}

static void add_scalar(ZpResult *result, const char *name, const char *unit, double value, bool timing) {
  if (timing)
    zp_result_add_timing(result, name, unit, value);
  else
    zp_result_add(result, name, unit, value);
}

/* A made up result. `slowness` stretches the time, as another voltage would. */
static ZpResult *made_up(size_t rows, size_t frames, bool ribbon, double voltage, double slowness) {
  size_t columns;
  const ZpColumn *column = zp_signal_columns(&columns);
  ZpResult *result = new_result(ZP_STUDY_ACTUATE);
  result->outcome = ZP_ZIPPED;
  strcpy(result->message, "zipped after 75 ms");
  zp_result_note(result, "the field in the insulator was above insulator.breakdown_field");
  add_scalar(result, "contraction", "1", 0.1 + 0.2, false);
  add_scalar(result, "zip_time_s", "s", ribbon ? (double)NAN : ZIP_TIME * slowness, false);
  add_scalar(result, "steps", "count", 123456789, false);
  add_scalar(result, "real_time_factor", "1", 0.01, true);
  result->series = zp_table_create(column, columns, rows + 2);
  for (size_t i = 0; i < rows; i++) {
    offer_row(result->series, ZIP_TIME * (double)i / (double)(rows > 1 ? rows - 1 : 1), voltage, ribbon);
    result->series->value[i * columns] *= slowness;
  }
  result->shapes = frames ? zp_shapes_create(ribbon ? 1 : 2, NODES, frames + 2) : NULL;
  for (size_t i = 0; i < frames; i++)
    offer_shape(result->shapes, ZIP_TIME * (double)i / (double)(frames > 1 ? frames - 1 : 1), voltage);
  return result;
}

/* For tests that look at numbers. */
#define NO_PICTURES "output.plots=false"

static ZpScenario *scenario_of(const char *assignment) {
  ZpScenario *scenario = new_scenario();
  ZpError err = {0};
  ck_assert_int_eq(zp_scenario_set(scenario, "output.animation=true", &err), ZP_OK);
  if (assignment) ck_ok(zp_scenario_set(scenario, assignment, &err));
  return scenario;
}

/* Write a report of one made up run to base/name. */
static void write_single(const char *name, const char *assignment, ZpResult *result, double wall_time) {
  ZpScenario *scenario = scenario_of(assignment);
  ZpError err = {0};
  const ZpReport report = {in_base(name), scenario, &result, 1, wall_time, NULL, NULL, NULL, 0, NULL, NULL};
  ZpStatus status = zp_report_write(&report, note, &err);
  ck_assert_msg(status == ZP_OK, "%s", err.message);
}

/* The same of a sweep of `count` runs over the lists that `assignment` gives. */
static void write_sweep(const char *name, const char *assignment, size_t count) {
  ZpScenario *scenario = scenario_of(assignment);
  ZpResult **result = memory_of((count + 1) * sizeof(ZpResult *));
  ck_assert_uint_eq(zp_scenario_count(scenario), count);
  for (size_t i = 0; i < count; i++)
    result[i] = made_up(60, 3, false, 8e3, 1 + 0.5 * (double)i);
  if (count > 1) result[1]->outcome = ZP_DIVERGED;
  if (count > 1) result[1]->scalar[1].value = NAN;
  ZpError err = {0};
  const ZpReport report = {in_base(name), scenario, result, count, 2.5, NULL, NULL, NULL, 0, NULL, NULL};
  ZpStatus status = zp_report_write(&report, note, &err);
  ck_assert_msg(status == ZP_OK, "%s", err.message);
}

/* Run a scenario and write the report. */
static void write_scenario(const char *name, ZpScenario *scenario) {
  const size_t count = zp_scenario_count(scenario);
  ZpResult **result = memory_of(count * sizeof(ZpResult *));
  for (size_t i = 0; i < count; i++) {
    ZpActuatorDef def = {0};
    ck_ok(zp_scenario_def(scenario, i, &def, &err));
    result[i] = data_study_of(zp_scenario_study(scenario), &def);
  }
  const ZpReport report = {in_base(name), scenario, result, count, 0.5, NULL, NULL, NULL, 0, NULL, NULL};
  ck_ok(zp_report_write(&report, note, &err));
}

/* Run `study` as `assignment` (may be NULL) says, a sweep where it gives a list, and write the report. */
static void write_study(const char *name, const char *study, const char *assignment) {
  ZpScenario *scenario = scenario_of(assignment);
  char choice[64];
  snprintf(choice, sizeof choice, "study=%s", study);
  ck_assert_int_eq(zp_scenario_set(scenario, choice, NULL), ZP_OK);
  write_scenario(name, scenario);
}

/* Walking a folder: what is met, and what is wrong with it. */
static size_t files_seen, temporaries_seen;

static int count_entry(const char *path, const struct stat *info, int kind, struct FTW *place) {
  (void)info;
  if (kind != FTW_F) return 0;
  files_seen++;
  if (path[place->base] == '.' || strstr(path + place->base, "tmp")) temporaries_seen++;
  return 0;
}

static size_t count_files(const char *name) {
  files_seen = temporaries_seen = 0;
  nftw(in_base(name), count_entry, 16, FTW_PHYS);
  ck_assert_uint_eq(temporaries_seen, 0);
  return files_seen;
}

/* How many entries base/name has. */
static int entries(const char *name) {
  int count = 0;
  DIR *list = opendir(in_base(name));
  ck_assert_ptr_nonnull(list);
  while (readdir(list))
    count++;
  closedir(list);
  return count - 2;
}

static const char *first_root, *second_root;

static int compare_entry(const char *path, const struct stat *info, int kind, struct FTW *place) {
  (void)info;
  char other[2048];
  size_t size, other_size;
  if (kind != FTW_F || strcmp(path + place->base, "summary.json") == 0) return 0;
  snprintf(other, sizeof other, "%s%s", second_root, path + strlen(first_root));
  char *mine = read_whole(path, &size), *theirs = read_whole(other, &other_size);
  ck_assert_msg(size == other_size && memcmp(mine, theirs, size) == 0, "%s and %s differ", path, other);
  return 0;
}

static void same_files(const char *a, const char *b) {
  first_root = in_base(a);
  second_root = in_base(b);
  ck_assert_uint_eq(count_files(a), count_files(b));
  ck_assert_int_eq(nftw(first_root, compare_entry, 16, FTW_PHYS), 0);
}

static json_t *load_json(const char *name) {
  json_error_t error;
  json_t *json = json_load_file(in_base(name), 0, &error);
  ck_assert_msg(json != NULL, "%s", error.text);
  return json;
}

static double json_number_of(const json_t *object, const char *name) {
  const json_t *value = json_object_get(object, name);
  ck_assert_msg(json_is_number(value), "%s is not a number", name);
  return json_number_value(value);
}

/* What gnuplot prints for an expression after the script NAME.gp in the folder base/plots: `what` is formatted by it as
 * text. Valid until the next call. */
static const char *asked(const char *folder, const char *name, const char *what) {
  static char text[256];
  char command[4096];
  snprintf(command, sizeof command,
           "cd '%s/plots' && gnuplot -e \"out='/dev/null'\" %s.gp -e 'print %s' 2>&1 | tail -1", in_base(folder), name,
           what);
  FILE *pipe = popen(command, "r");
  ck_assert_ptr_nonnull(pipe);
  text[0] = 0;
  if (fgets(text, sizeof text, pipe)) text[strcspn(text, "\n")] = 0;
  pclose(pipe);
  return text;
}

TEST(single_run_has_all_files) {
  static const char *const name[] = {"scenario.yaml",
                                     "summary.json",
                                     "table.csv",
                                     "results.h5",
                                     "shapes.pvd",
                                     "shapes/shape_0000.vtp",
                                     "shapes/shape_0009.vtp",
                                     "plots/stroke.svg",
                                     "plots/stroke.gp",
                                     "plots/energies.svg",
                                     "plots/electric.svg",
                                     "plots/zipped_length.svg",
                                     "plots/profiles.svg",
                                     "plots/shapes.dat",
                                     "plots/result.gp",
                                     "plots/animation.gif"};
  write_single("out/deep", NULL, made_up(50, 10, false, 8e3, 1), 1.25);
  for (size_t i = 0; i < sizeof name / sizeof name[0]; i++) {
    char path[128];
    snprintf(path, sizeof path, "out/deep/%s", name[i]);
    ck_assert_msg(exists(path), "no %s", name[i]);
  }
  ck_assert_str_eq(asked("out/deep", "profiles", "frames, frame_time[1] < frame_time[2]"), "10 1");
  ck_assert_str_eq(notices, "");
  count_files("out");
}

TEST(summary_of_a_run) {
  write_single("out", NO_PICTURES, made_up(50, 3, true, 8e3, 1), 1.25);
  json_t *json = load_json("out/summary.json");
  ck_assert_str_eq(json_string_value(json_object_get(json, "outcome")), "zipped");
  ck_assert_str_eq(json_string_value(json_object_get(json, "study")), "actuate");
  ck_assert(json_number_of(json, "wall_time_s") == 1.25);
  ck_assert(json_number_of(json, "contraction") == 0.1 + 0.2);
  ck_assert(json_number_of(json, "real_time_factor") == 0.01);
  ck_assert(json_is_integer(json_object_get(json, "steps")));
  ck_assert(json_is_null(json_object_get(json, "zip_time_s")));
  ck_assert_uint_eq(json_array_size(json_object_get(json, "notes")), 1);
  ck_assert_ptr_null(json_object_get(json, "rows"));
  json_decref(json);
}

TEST(table_of_a_run) {
  size_t size;
  write_single("out", NO_PICTURES, made_up(50, 0, false, 8e3, 1), 1);
  char *text = read_whole(in_base("out/table.csv"), &size), *rest = NULL;
  const char *head = strtok_r(text, "\n", &rest), *first = strtok_r(NULL, "\n", &rest);
  ck_assert_ptr_nonnull(strstr(head, "time_s,voltage_V,stroke_m,opening_m,contraction,"));
  ck_assert_msg(strncmp(first, "0,8000,0.01,0.02,0,", 19) == 0, "%s", first);
  ck_assert_msg(strstr(first, ",,") != NULL, "a NAN is no empty cell: %s", first);
  ck_assert_ptr_null(strcasestr(first, "nan"));
  size_t rows = 1;
  while (strtok_r(NULL, "\n", &rest))
    rows++;
  ck_assert_uint_eq(rows, 50);
}

TEST(same_result_same_bytes) {
  write_single("a", NULL, made_up(50, 5, false, 8e3, 1), 1);
  write_single("b", NULL, made_up(50, 5, false, 8e3, 1), 2);
  same_files("a", "b");
  write_sweep("c", "drive.voltage=[6 kV, 8 kV, 10 kV]", 3);
  write_sweep("d", "drive.voltage=[6 kV, 8 kV, 10 kV]", 3);
  same_files("c", "d");
  write_single("c", NULL, made_up(50, 5, false, 8e3, 1), 3);
  write_sweep("a", "drive.voltage=[6 kV, 8 kV, 10 kV]", 3);
  same_files("b", "c");
  same_files("a", "d");
}

TEST(table_of_a_sweep) {
  size_t size;
  write_sweep("out", "drive.voltage=[6 kV, 8 kV, 10 kV]", 3);
  char *text = read_whole(in_base("out/table.csv"), &size);
  ck_assert_str_eq(text, "drive.voltage_V,outcome,contraction,zip_time_s,steps\n"
                         "6000,zipped,0.30000000000000004,0.075,123456789\n"
                         "8000,diverged,0.30000000000000004,,123456789\n"
                         "10000,zipped,0.30000000000000004,0.15,123456789\n");
  ck_assert(exists("out/plots/contraction.svg") && exists("out/plots/zip_time.svg"));
  ck_assert(!exists("out/shapes.pvd") && !exists("out/plots/stroke.svg"));
  ck_assert_str_eq(notices, "");
}

TEST(summary_of_a_sweep) {
  write_sweep("out", "mesh.nodes=[21, 61]", 2);
  json_t *json = load_json("out/summary.json");
  const json_t *rows = json_object_get(json, "rows"), *row = json_array_get(rows, 1);
  ck_assert_uint_eq(json_array_size(rows), 2);
  ck_assert_str_eq(json_string_value(json_object_get(json, "outcome")), "diverged");
  ck_assert_int_eq(json_integer_value(json_object_get(row, "mesh.nodes")), 61);
  ck_assert(json_number_of(row, "contraction") == 0.1 + 0.2);
  ck_assert_uint_eq(json_array_size(json_object_get(json, "notes")), 1);
  json_decref(json);
}

TEST(old_results_go_and_others_stay) {
  write_single("out", NULL, made_up(50, 12, false, 8e3, 1), 1);
  put_file("out/notes.txt", "mine");
  put_file("out/shapes/shape_best.vtp", "mine");
  put_file("out/shapes/shape_00011.vtp", "mine");
  put_file("out/plots/mine.gp", "mine");
  write_single("out", NULL, made_up(50, 4, false, 8e3, 1), 1);
  ck_assert(exists("out/shapes/shape_0003.vtp") && !exists("out/shapes/shape_0004.vtp"));
  ck_assert(!exists("out/shapes/shape_0011.vtp"));
  write_sweep("out", "drive.voltage=[6 kV, 8 kV]", 2);
  ck_assert(!exists("out/shapes.pvd") && !exists("out/shapes/shape_0000.vtp"));
  ck_assert(!exists("out/plots/animation.gif") && !exists("out/plots/shapes.dat"));
  ck_assert(exists("out/notes.txt") && exists("out/plots/mine.gp"));
  ck_assert(exists("out/shapes/shape_best.vtp") && exists("out/shapes/shape_00011.vtp"));
}

TEST(little_to_write) {
  write_single("one", NULL, made_up(1, 1, false, 8e3, 1), 1);
  write_single("none", NULL, made_up(0, 0, false, 8e3, 1), 1);
  ck_assert(exists("one/shapes.pvd") && !exists("none/shapes.pvd"));
  ZpResult *bare = made_up(0, 0, false, 8e3, 1);
  zp_table_destroy(bare->series);
  bare->series = NULL;
  write_single("bare", NULL, bare, 1);
  ck_assert(exists("bare/summary.json") && !exists("bare/table.csv"));
  ck_assert_str_eq(notices, "");
}

TEST(interrupted_before_the_first_run) {
  ZpScenario *scenario = scenario_of("drive.voltage=[6 kV, 8 kV]");
  const ZpReport report = {in_base("out"), scenario, NULL, 0, 0.5, NULL, NULL, NULL, 0, NULL, NULL};
  ck_ok(zp_report_write(&report, note, &err));
  json_t *json = load_json("out/summary.json");
  ck_assert_str_eq(json_string_value(json_object_get(json, "outcome")), "interrupted");
  ck_assert_uint_eq(json_array_size(json_object_get(json, "rows")), 0);
  json_decref(json);
}

TEST(kind_ribbon) {
  write_single("out", "actuator.kind=ribbon", made_up(50, 10, true, 0, 1), 1);
  ck_assert(exists("out/plots/stroke.svg") && exists("out/plots/animation.gif"));
  ck_assert(!exists("out/plots/electric.svg"));
  ck_assert_str_eq(notices, "");
}

/* Numbers without bounds must not stop the report: what can be drawn is drawn. */
TEST(diverged) {
  ZpResult *result = made_up(50, 10, false, 8e3, 1);
  const size_t columns = result->series->columns;
  for (size_t i = 1; i < columns; i++)
    result->series->value[49 * columns + i] = i % 2 ? INFINITY : 1e300;
  for (size_t i = 3; i < result->shapes->frame_size; i++) /* after time, voltage, zipped */
    result->shapes->value[9 * result->shapes->frame_size + i] = i % 2 ? INFINITY : -1e300;
  result->scalar[0].value = -INFINITY;
  result->outcome = ZP_DIVERGED;
  write_single("out", NULL, result, 1);
  json_t *json = load_json("out/summary.json");
  ck_assert(json_is_null(json_object_get(json, "contraction")));
  json_decref(json);
  ck_assert(exists("out/plots/stroke.gp"));
  count_files("out");
}

/* That base/name has all of the files, ended by NULL, and that no notice was given. */
static void check_files(const char *name, const char *const *file) {
  for (; *file; file++) {
    char path[128];
    snprintf(path, sizeof path, "%s/%s", name, *file);
    ck_assert_msg(exists(path), "no %s", path);
  }
  ck_assert_str_eq(notices, "");
  count_files(name);
}

NIGHTLY_TEST(files_of_rest) {
  write_study("e", "equilibrium", NULL);
  check_files("e",
              (const char *const[]){"table.csv", "results.h5", "shapes.pvd", "plots/stroke.svg", "plots/charge.svg",
                                    "plots/zipped_length.svg", "plots/shapes.svg", "plots/animation.gif", NULL});
  write_study("f", "equilibrium", "load.mass=61 g");
  check_files("f", (const char *const[]){"plots/stroke.svg", "plots/charge.svg", "plots/shapes.svg", NULL});
  write_study("s", "stationary", NULL);
  check_files("s", (const char *const[]){"table.csv", "shapes.pvd", "plots/shape.svg", NULL});
  write_study("r", "stationary", "actuator.kind=ribbon");
  check_files("r", (const char *const[]){"plots/shape.svg", NULL});
  write_study("i", "isometric", NULL);
  check_files("i", (const char *const[]){"table.csv", "plots/force.svg", "plots/charge.svg", "plots/zipped_length.svg",
                                         "plots/shapes.svg", "plots/animation.gif", NULL});
  ck_assert(!exists("i/plots/stroke.svg") && !exists("e/plots/force.svg"));
  write_study("p", "profile", NULL);
  check_files("p", (const char *const[]){"table.csv", "shapes.pvd", "field.vts", "plots/profile.svg", "plots/field.svg",
                                         "plots/field_tip.svg", NULL});
  write_study("m", "modes", NULL);
  check_files("m", (const char *const[]){"table.csv", "shapes.pvd", "plots/modes.svg", NULL});
  ck_assert(!exists("m/plots/stroke.svg") && !exists("s/plots/stroke.svg") && !exists("s/plots/modes.svg"));
}

/* Of one list key there is a picture; its runs have none. */
TEST(sweeps_of_rest) {
  write_study("s", "stationary", "load.mass=[8 g, 61 g]");
  check_files("s", (const char *const[]){"table.csv", "plots/strokes.svg", NULL});
  write_study("e", "equilibrium", "load.mass=[8 g, 61 g]");
  check_files("e", (const char *const[]){"table.csv", "plots/voltages.svg", NULL});
  write_study("m", "modes", "load.mass=[8 g, 61 g]");
  check_files("m", (const char *const[]){"table.csv", "plots/frequencies.svg", NULL});
  write_study("i", "isometric", "isometric.separation=[1 mm, 2 mm]");
  check_files("i", (const char *const[]){"table.csv", "plots/forces.svg", NULL});
  ck_assert(!exists("i/plots/force.svg"));
  write_study("p", "profile", "isometric.separation=[1 mm, 2 mm]");
  check_files("p", (const char *const[]){"table.csv", "plots/factors.svg", "plots/forces.svg", NULL});
  ck_assert(!exists("p/plots/profile.svg") && !exists("p/field.vts"));
  ck_assert(!exists("s/plots/shape.svg") && !exists("e/plots/stroke.svg") && !exists("m/plots/modes.svg"));
}

static void write_chart(const char *voltages) {
  ZpScenario *scenario = scenario_of(voltages);
  const char *const more[] = {"study=limits", "mesh.nodes=15", "medium.breakdown_field=[20 MV/m, 30 MV/m, 60 MV/m]"};
  for (size_t i = 0; i < sizeof more / sizeof more[0]; i++)
    ck_assert_int_eq(zp_scenario_set(scenario, more[i], NULL), ZP_OK);
  write_scenario("l", scenario);
}

/* The chart of largest loads said "mkg", drew curves of a second key all alike and named none; over two keys there was
 * no map. */
TEST(design_chart) {
  size_t size;
  write_chart("drive.voltage=[4 kV, 6 kV, 8 kV]");
  check_files("l", (const char *const[]){"table.csv", "plots/loads.svg", "plots/map.svg", NULL});
  char *chart = read_whole(in_base("l/plots/loads.svg"), &size), *map = read_whole(in_base("l/plots/map.svg"), &size);
  ck_assert(strstr(chart, ">load / g<") && strstr(chart, ">medium.breakdown_field<"));
  ck_assert(strstr(chart, ">20 MV/m<") && strstr(chart, ">30 MV/m<") && strstr(chart, ">60 MV/m<"));
  ck_assert(strstr(map, ">load / g<") && strstr(map, "rgb(255, 255, 255)"));
  ck_assert(strstr(map, ">drive.voltage / kV<") && strstr(map, ">medium.breakdown_field / (MV/m)<"));
  double voltage, field, load;
  ck_assert_int_eq(sscanf(asked("l", "map", "$map[1]"), "%lf %lf %lf", &voltage, &field, &load), 3);
  ck_assert(voltage == 4e3 && field == 20e6 && load > 5e-3 && load < 8e-3);
  write_chart("drive.voltage=[4 kV, 8 kV, 6 kV]"); /* values to and fro make no surface */
  ck_assert(exists("l/plots/loads.svg") && !exists("l/plots/map.svg"));
}

/* Has the file base/name this text? */
static bool file_says(const char *name, const char *text) {
  size_t size;
  char *whole = read_whole(in_base(name), &size);
  return strstr(whole, text) != NULL;
}

static void write_rest(const char *name, const char *study, const char *const *more) {
  ZpScenario *scenario = scenario_of("mesh.nodes=15");
  char choice[64];
  snprintf(choice, sizeof choice, "study=%s", study);
  ck_assert_int_eq(zp_scenario_set(scenario, choice, NULL), ZP_OK);
  for (; *more; more++)
    ck_ok(zp_scenario_set(scenario, *more, &err));
  write_scenario(name, scenario);
}

/* The labels of contours of a map lie inside its axes => how many there are. */
static int check_labels(const char *name, double left, double right, double top, double bottom) {
  size_t size;
  char *whole = read_whole(in_base(name), &size), number[32];
  int labels = 0;
  for (const char *at = whole; (at = strstr(at, "<g transform=\"translate(")) != NULL; at++) {
    double x, y, letter;
    if (sscanf(at,
               "<g transform=\"translate(%lf,%lf)\" stroke=\"none\" fill=\"black\" font-family=\"Helvetica\" "
               "font-size=\"11.00\"  text-anchor=\"middle\"> <text><tspan font-family=\"Helvetica\" >%31[^<]",
               &x, &y, number) != 3)
      continue;
    letter = 3.5 * (double)strlen(number);
    ck_assert_msg(x - letter > left && x + letter < right && y - 10 > top && y + 1 < bottom, "%s at %g, %g", number, x,
                  y);
    labels++;
  }
  return labels;
}

/* The label 30 of docs/images/design-chart.svg was on the right edge. A contour that cuts off a small corner has none.
 */
TEST(contour_label_on_the_edge_of_a_map_is_cut) {
  write_chart("drive.voltage=[4 kV, 6 kV, 8 kV]");
  ck_assert_int_ge(check_labels("l/plots/map.svg", 84, 462, 58.8, 336), 3);
}

/* The chart of largest loads said "load 8 g", on which these do not depend. */
TEST(largest_loads_are_those_of_no_load) {
  write_chart("drive.voltage=[4 kV, 6 kV, 8 kV]");
  ck_assert_str_eq(asked("l", "loads", "subtitle"), "N = 15");
  ck_assert_str_eq(asked("l", "map", "subtitle"), "N = 15");
}

/* "straight between them" did not say what lies between what, and a hole of a map was not explained. */
TEST(small_print_of_a_map) {
  write_chart("drive.voltage=[4 kV, 6 kV, 8 kV]");
  ck_assert(file_says("l/plots/map.svg", ">9 of 9 runs lift a load; linear between the runs<"));
  write_rest("e", "equilibrium",
             (const char *const[]){"load.mass=[5 g, 10 g, 20 g, 100 g]",
                                   "ribbon.thickness=[80 um, 90 um, 100 um, 110 um]", NULL});
  ck_assert(file_says("e/plots/map.svg", " of 16 runs pull in; white: no value; linear between the runs<"));
}

/* "factor" and "mesh.nodes" had no unit and did not say so; a unit with a slash was "field strength / MV/m". */
NIGHTLY_TEST(axes_without_a_unit_say_so) {
  write_rest("p", "profile", (const char *const[]){"isometric.separation=[1 mm, 2 mm]", NULL});
  ck_assert(file_says("p/plots/factors.svg", ">factor (dimensionless)<"));
  write_rest("p", "profile", (const char *const[]){NULL});
  ck_assert(file_says("p/plots/profile.svg", ">difference / %<"));
  ck_assert(file_says("p/plots/field.svg", ">field strength / (MV/m)<"));
}

/* Of three keys the first has a style of line and the second a shade. Where there are too many curves, each value that
 * is drawn of one key is drawn with all that are drawn of the other, and the picture says how many are left out. Names
 * have at most four digits. */
TEST(shades_of_three_keys) {
  write_rest("s", "stationary",
             (const char *const[]){"ribbon.width=[10 mm, 12 mm, 14 mm]", "ribbon.thickness=20 um .. 200 um : 3 log",
                                   "load.mass=[8 g, 20 g]", NULL});
  ck_assert_str_eq(asked("s", "strokes", "alike, |curve|"), "3 9");
  ck_assert(file_says("s/plots/strokes.svg", ">12 mm, 63.25 µm<"));
  ck_assert(file_says("s/table.csv", "6.32455532034e-05"));
  write_rest("t", "stationary",
             (const char *const[]){"ribbon.width=[10 mm, 11 mm, 12 mm, 14 mm]",
                                   "ribbon.thickness=20 um .. 200 um : 3 log", "load.mass=[8 g, 20 g]", NULL});
  ck_assert_str_eq(asked("t", "strokes", "alike, |curve|"), "3 9");
  ck_assert(file_says("t/plots/strokes.svg", "; 9 of 12 curves are drawn<") ||
            file_says("t/plots/strokes.svg", ">9 of 12 curves are drawn<"));
  ck_assert(file_says("t/plots/strokes.svg", ">10 mm, 20 µm<") && file_says("t/plots/strokes.svg", ">14 mm, 200 µm<"));
  ck_assert(!file_says("s/plots/strokes.svg", "curves are drawn"));
}

/* Twelve of the 20 panels of a map, evenly from the first to the last: each has the rows of table.csv in which the
 * third key has its value, in their order. */
static void check_panels(void) {
  enum { PANELS = 20, DRAWN = 12, ROWS = 9, COLUMNS = 4 };
  size_t size;
  double row[PANELS * ROWS][COLUMNS], at[3];
  char *table = read_whole(in_base("n/table.csv"), &size), *line = strchr(table, '\n') + 1;
  ck_assert_int_eq(strncmp(table, "ribbon.length_m,ribbon.thickness_m,load.mass_kg,outcome,stroke_m", 64), 0);
  for (int i = 0; i < PANELS * ROWS; i++, line = strchr(line, '\n') + 1)
    ck_assert_int_eq(sscanf(line, "%lf,%lf,%lf,%*[^,],%lf", &row[i][0], &row[i][1], &row[i][2], &row[i][3]), COLUMNS);
  for (int k = 0; k < DRAWN; k++) {
    char what[64];
    const int panel = k * (PANELS - 1) / (DRAWN - 1);
    snprintf(what, sizeof what, "panel_at[%d]", k + 1);
    ck_assert_double_eq_tol(strtod(asked("n", "maps", what), NULL), row[panel * ROWS][0], 1e-12);
    for (int i = 0; i < ROWS; i += 4) { /* a blank line after each row of a panel, another one after the panel */
      const double *of = row[panel * ROWS + i];
      snprintf(what, sizeof what, "$map[%d]", k * (ROWS + ROWS / 3 + 1) + i + i / 3 + 1);
      ck_assert_int_eq(sscanf(asked("n", "maps", what), "%lf %lf %lf", &at[0], &at[1], &at[2]), 3);
      ck_assert(fabs(at[0] - of[2]) < 1e-9 * of[2] && fabs(at[1] - of[1]) < 1e-9 * of[1]);
      ck_assert_double_eq_tol(at[2], of[3], 1e-12 * of[3]); /* 4e-17 measured */
    }
  }
}

/* Ten maps in one picture: none is left out, and all have contours of the same levels. */
TEST(maps_have_one_scale) {
  write_rest("m", "stationary",
             (const char *const[]){"ribbon.length=80 mm .. 130 mm : 10", "ribbon.thickness=40 um .. 100 um : 3",
                                   "load.mass=2 g .. 20 g : 3", "mesh.nodes=9", NULL});
  ck_assert_str_eq(asked("m", "maps", "|panel_at|"), "10");
  ck_assert(file_says("m/plots/maps.svg", ">130 mm<"));
  ck_assert(file_says("m/plots/maps.gp", "set cntrparam levels incremental"));
  ck_assert(!file_says("m/plots/maps.svg", "panels<"));
  write_rest("n", "stationary",
             (const char *const[]){"ribbon.length=80 mm .. 130 mm : 20", "ribbon.thickness=40 um .. 100 um : 3",
                                   "load.mass=2 g .. 20 g : 3", "mesh.nodes=9", NULL});
  ck_assert(file_says("n/plots/maps.svg", "; 12 of 20 panels<"));
  check_panels();
}

/* An axis for each key and each objective, coloured by the first objective; the front by the rows of its cases. */
TEST(lines_of_cases_and_of_the_front) {
  static const size_t best[] = {5, 2};
  static const char *const objective[] = {"stroke_m", "other_m"};
  const ZpOptimum optimum = {.row = best,
                             .count = 2,
                             .feasible = true,
                             .excluded = NAN,
                             .objective = objective,
                             .objectives = 2,
                             .samples = 1};
  ZpScenario *scenario = scenario_of("ribbon.thickness=[40 um, 60 um, 80 um]");
  ZpResult *result[6];
  ck_assert_int_eq(zp_scenario_set(scenario, "study=stationary", NULL), ZP_OK);
  ck_assert_int_eq(zp_scenario_set(scenario, "load.mass=[2 g, 4 g]", NULL), ZP_OK);
  for (size_t i = 0; i < 6; i++) {
    result[i] = new_result(ZP_STUDY_STATIONARY);
    zp_result_add(result[i], "stroke_m", "m", (double)i + 1);
    zp_result_add(result[i], "other_m", "m", 99 - (double)i);
  }
  const ZpReport report = {
      .directory = in_base("o"), .scenario = scenario, .result = result, .count = 6, .optimum = &optimum};
  ck_ok(zp_report_write(&report, note, &err));
  ck_assert_str_eq(notices, "");
  ck_assert_str_eq(asked("o", "parallel", "shown"), "ribbon.thickness_m load.mass_kg stroke_m other_m ");
  ck_assert_str_eq(asked("o", "parallel", "colour_axis, axis_low[3], axis_high[3]"), "3 1.0 6.0");
  ck_assert(file_says("o/plots/parallel.svg", ">front<"));
  ck_assert_str_eq(asked("o", "pareto", "front[1], front[2]"), "5 2");
}

/* Under 500 g there is neither pull-in nor release: the legend named a curve that has no point. */
TEST(legend_names_what_is_drawn) {
  write_rest("e", "equilibrium",
             (const char *const[]){"load.mass=[8 g, 500 g]", "drive.voltage=[6.5 kV, 7 kV]", "liquid.model=none",
                                   "output.errors=false", NULL});
  ck_assert_str_eq(asked("e", "voltages", "|curve|"), "1");
  ck_assert(file_says("e/plots/voltages.svg", ">8 g<") && !file_says("e/plots/voltages.svg", ">500 g<"));
}

/* How often a letter stands in the first curve of a picture: M begins a piece, L goes on. */
static size_t letters_of_curve(const char *name, char letter) {
  size_t size, count = 0;
  char *whole = read_whole(in_base(name), &size), *at = strstr(whole, "id=\"gnuplot_plot_1\"");
  ck_assert_ptr_nonnull(at);
  at = strstr(at, " d='");
  ck_assert_ptr_nonnull(at);
  for (at += 4; *at && *at != '\''; at++)
    count += *at == letter;
  return count;
}

/* With indices only some of the rows are independent samples. Their line fell to pieces at the others. */
TEST(distribution_with_indices) {
  write_rest("d", "stationary",
             (const char *const[]){"load.mass=normal(8 g, 0.2 g)", "ribbon.thickness=normal(50 um, 1 um)",
                                   "sampling.count=8", "sampling.indices=true", NULL});
  ck_assert(file_says("d/plots/distribution.svg", ">16 samples per curve"));
  ck_assert_uint_eq(letters_of_curve("d/plots/distribution.svg", 'M'), 1);
  ck_assert_uint_eq(letters_of_curve("d/plots/distribution.svg", 'L'), 15);
  ck_assert(file_says("d/plots/indices.svg", ">load.mass<") && file_says("d/plots/indices.svg", ">ribbon.thickness<"));
}

/* The axes of a fit had no name; a unit such as m2/s had another spelling in its column than in that of a sweep. */
TEST(axes_of_a_fit) {
  char file[1100];
  put_file("bench.csv", "medium.kinematic_viscosity_mm2/s,load_g,stroke_mm\n50,8,10\n50,20,20\n");
  snprintf(file, sizeof file, "data.file=%s", in_base("bench.csv"));
  write_rest("f", "calibrate",
             (const char *const[]){file, "calibrate.fit=ribbon.young_modulus", "calibrate.x=load_g",
                                   "calibrate.y=stroke_mm", NULL});
  ck_assert(file_says("f/plots/fit.svg", ">load.mass / g<") && file_says("f/plots/fit.svg", ">stroke / mm<"));
  write_rest("g", "calibrate",
             (const char *const[]){file, "calibrate.fit=ribbon.young_modulus",
                                   "calibrate.x=medium.kinematic_viscosity_mm2/s", "calibrate.y=stroke_mm", NULL});
  ck_assert(file_says("g/table.csv", "medium.kinematic_viscosity_m2_per_s,measured_m,"));
  ck_assert(file_says("g/plots/fit.svg", ">medium.kinematic_viscosity / (mm²/s)<"));
}

/* Neither a NaN nor infinity may be spelled out where other programs read. */
static void check_numbers(const char *name) {
  char path[128];
  const char *const file[] = {"summary.json", "table.csv"};
  for (size_t i = 0; i < 2; i++) {
    size_t size;
    snprintf(path, sizeof path, "%s/%s", name, file[i]);
    char *text = read_whole(in_base(path), &size);
    for (const char *c = text; (c = strcasestr(c, "nan")) != NULL; c++)
      ck_assert_msg(c > text && (c[-1] >= 'a' && c[-1] <= 'z'), "%s: %.20s", path, c);
    ck_assert_ptr_null(strstr(text, "inf,"));
  }
}

/* Of one kind of measurement the standard deviations were neither in the picture nor in the table. */
TEST(error_bars_of_a_fit) {
  char file[1100];
  put_file("bench.csv", "load_g,stroke_mm,sigma_mm\n4,6,0.5\n8,10,0.5\n20,20,2\n");
  snprintf(file, sizeof file, "data.file=%s", in_base("bench.csv"));
  write_rest("f", "calibrate", (const char *const[]){file, "calibrate.fit=ribbon.young_modulus", NULL});
  ck_assert(file_says("f/table.csv", "load.mass_kg,measured_m,fitted_m,residual_m,sigma_m,weighted_residual,outlier,"
                                     "information_ribbon.young_modulus\n"));
  ck_assert(file_says("f/plots/fit.svg", ">measured ± σ<"));
  put_file("bench.csv", "load_g,stroke_mm\n4,6\n8,10\n20,20\n");
  write_rest("f", "calibrate", (const char *const[]){file, "calibrate.fit=ribbon.young_modulus", NULL});
  ck_assert(file_says("f/table.csv", "load.mass_kg,measured_m,fitted_m,residual_m,weighted_residual,outlier,"));
  ck_assert(file_says("f/plots/fit.svg", ">measured<") && file_says("f/plots/fit.svg", ">residual / σ<"));
}

/* A fit of two keys has pictures of its profiles, of its region and of what each row tells; a fit over it that has one
 * key has no region, and one that cannot be told has none of them. */
TEST(pictures_of_what_a_fit_knows) {
  char file[1100];
  put_file("bench.csv", "load_g,stroke_mm\n4,6.5\n8,10.6\n20,20.5\n40,30\n");
  snprintf(file, sizeof file, "data.file=%s", in_base("bench.csv"));
  write_rest("f", "calibrate",
             (const char *const[]){file, "calibrate.fit=ribbon.young_modulus, load.share", "calibrate.starts=1", NULL});
  check_files("f", (const char *const[]){"likelihood.csv", "regions.csv", "plots/fit.svg", "plots/likelihood.svg",
                                         "plots/regions.svg", "plots/information.svg", NULL});
  ck_assert(file_says("f/plots/regions.svg", ">ribbon.young_modulus / GPa<"));
  ck_assert(file_says("f/plots/information.svg", ">ribbon.young_modulus: 100 %<"));
  ck_assert(file_says("f/plots/likelihood.svg", ">rise of the squares / σ²<"));
  write_rest("f", "calibrate", (const char *const[]){file, "calibrate.fit=ribbon.young_modulus", NULL});
  check_files("f", (const char *const[]){"likelihood.csv", "plots/likelihood.svg", "plots/information.svg", NULL});
  ck_assert(!exists("f/regions.csv") && !exists("f/plots/regions.svg"));
  put_file("bench.csv", "load_g,stroke_mm\n4,6.5\n");
  write_rest("f", "calibrate", (const char *const[]){file, "calibrate.fit=ribbon.young_modulus", NULL});
  ck_assert(!exists("f/likelihood.csv") && !exists("f/plots/likelihood.svg") && !exists("f/plots/information.svg"));
}

/* The SVG holds the picture of the field itself; field.vts has the bytes that its head promises. */
TEST(field_of_a_profile) {
  static const char begin[] = "<AppendedData encoding=\"raw\">\n_", end[] = "\n  </AppendedData>\n</VTKFile>\n";
  size_t size;
  unsigned rows, columns;
  write_study("p", "profile", NULL);
  char *svg = read_whole(in_base("p/plots/field.svg"), &size);
  ck_assert_uint_lt(size, 1000000);
  ck_assert_ptr_nonnull(strstr(svg, "data:image/png;base64,"));
  char *vts = read_whole(in_base("p/field.vts"), &size);
  const char *extent = strstr(vts, "WholeExtent"), *bytes = strstr(vts, begin);
  ck_assert(extent && bytes);
  ck_assert_int_eq(sscanf(extent, "WholeExtent=\"0 %u 0 %u 0 0\"", &rows, &columns), 2);
  size_t nodes = (rows + 1) * (columns + 1), cells = rows * columns;
  size_t written = size - (size_t)(bytes - vts) - strlen(begin) - strlen(end);
  ck_assert_uint_eq(written, sizeof(double) * (4 + 4 * nodes + 2 * cells)); /* four arrays, each after its length */
  write_study("p", "stationary", NULL);                                     /* over it */
  ck_assert(!exists("p/field.vts") && !exists("p/plots/field.svg"));
}

NIGHTLY_TEST(rest_is_the_same_each_time) {
  const char *const study[] = {"equilibrium", "stationary", "modes", "isometric", "profile"};
  if (SANITIZED) setenv("PATH", "/nowhere", 1); /* the pictures are files_of_rest's */
  for (size_t i = 0; i < 5; i += FULL_OR(1, 2)) {
    write_study("a", study[i], NULL); /* over what the study before left there */
    write_study(study[i], study[i], NULL);
    same_files("a", study[i]);
    check_numbers("a");
    write_study("b", study[i], i < 3 ? "load.mass=[8 g, 61 g]" : "drive.voltage=[0, 2 kV]");
    check_numbers("b");
  }
  write_single("a", NULL, made_up(50, 10, false, 8e3, 1), 1);
  write_single("c", NULL, made_up(50, 10, false, 8e3, 1), 1);
  same_files("a", "c");
  write_study("a", "equilibrium", NULL);
  same_files("a", "equilibrium");
}

static void check_frequencies(const json_t *object) {
  const json_t *array = json_object_get(object, "frequencies_Hz");
  ck_assert_uint_ge(json_array_size(array), 3);
  for (size_t i = 1; i < json_array_size(array); i++)
    ck_assert(json_number_value(json_array_get(array, i - 1)) < json_number_value(json_array_get(array, i)));
  ck_assert_double_gt(json_number_value(json_array_get(array, 0)), 0);
  ck_assert_ptr_null(json_object_get(object, "frequency_1_Hz"));
}

TEST(frequencies_are_an_array) {
  size_t size;
  write_study("one", "modes", NULL);
  json_t *json = load_json("one/summary.json");
  check_frequencies(json);
  json_decref(json);
  write_study("two", "modes", "load.mass=[8 g, 61 g]");
  json = load_json("two/summary.json");
  const json_t *rows = json_object_get(json, "rows");
  ck_assert_uint_eq(json_array_size(rows), 2);
  check_frequencies(json_array_get(rows, 0));
  check_frequencies(json_array_get(rows, 1));
  json_decref(json);
  char *text = read_whole(in_base("two/table.csv"), &size);
  ck_assert_int_eq(strncmp(text, "load.mass_kg,outcome,frequency_1_Hz,frequency_2_Hz,", 51), 0);
}

NIGHTLY_TEST(no_pull_in_is_null) {
  write_study("out", "equilibrium", "load.mass=61 g");
  json_t *json = load_json("out/summary.json");
  ck_assert(json_is_null(json_object_get(json, "pull_in_voltage_V")));
  ck_assert_double_gt(json_number_of(json, "release_voltage_V"), 0);
  json_decref(json);
}

/* Where insulator and liquid are alike, the pictures of the field could not be drawn: "cb coord of 0". */
NIGHTLY_TEST(field_of_equal_permittivities) {
  write_study("equal", "profile", "insulator.permittivity=2.75");
  ck_assert_msg(*notices == 0, "%s", notices);
  ck_assert(exists("equal/plots/field.svg") && exists("equal/plots/field_tip.svg"));
}

TEST(folder_that_cannot_be) {
  ZpError err = {0};
  ZpFolder *folder;
  put_file("file", "mine");
  ck_says(zp_folder_open(in_base("file"), &folder, &err), ZP_MACHINE, "/file");
  ck_says(zp_folder_open(in_base("file/deep/er"), &folder, &err), ZP_MACHINE, "/file");
  ck_assert_int_eq(zp_folder_open("/proc/zipact", &folder, &err), ZP_MACHINE);
  ck_assert_int_eq(zp_folder_open("", &folder, &err), ZP_MACHINE);
  ck_ok(zp_folder_open(in_base("a/b/c/"), &folder, &err));
  zp_folder_close(folder);
  ck_assert_uint_eq(count_files("a"), 0);
}

TEST(name_taken_by_a_folder) {
  ZpScenario *scenario = scenario_of(NULL);
  ZpResult *result = made_up(5, 2, false, 8e3, 1);
  const ZpReport report = {in_base("out"), scenario, &result, 1, 1, NULL, NULL, NULL, 0, NULL, NULL};
  ck_assert_int_eq(mkdir(in_base("out"), 0777), 0);
  ck_assert_int_eq(mkdir(in_base("out/results.h5"), 0777), 0);
  ck_says(zp_report_write(&report, note, &err), ZP_MACHINE, "results.h5");
  ck_assert(!exists("out/summary.json"));
  count_files("out");
}

TEST(summary_to_a_full_device) {
  ZpScenario *scenario = scenario_of(NULL);
  ZpResult *result = made_up(5, 2, false, 8e3, 1);
  const ZpReport report = {"unused", scenario, &result, 1, 1, NULL, NULL, NULL, 0, NULL, NULL};
  FILE *full = fopen("/dev/full", "w");
  if (full) {
    ck_says(zp_summary_write(&report, full, &err), ZP_MACHINE, strerror(ENOSPC));
    fclose(full);
  }
}

/* What a reader of a complete file finds at its end. */
static void check_complete(const char *name, const char *end) {
  size_t size;
  if (!exists(name)) return;
  char *text = read_whole(in_base(name), &size);
  size_t length = strlen(end);
  ck_assert_msg(size >= length && memcmp(text + size - length, end, length) == 0, "%s is not complete", name);
}

/* Write to a disk of `kilobytes`; true if it was large enough. */
static bool write_on_small_disk(int kilobytes) {
  char option[32];
  ZpScenario *scenario = scenario_of(NULL);
  ZpResult *result = made_up(400, 20, false, 8e3, 1);
  ZpError err = {0};
  snprintf(option, sizeof option, "size=%dk", kilobytes);
  ck_assert_int_eq(mount("none", in_base("disk"), "tmpfs", 0, option), 0);
  const ZpReport report = {in_base("disk/out"), scenario, &result, 1, 1, NULL, NULL, NULL, 0, NULL, NULL};
  ZpStatus status = zp_report_write(&report, note, &err);
  ck_assert_msg(status == ZP_OK || strstr(err.message, strerror(ENOSPC)), "%s", err.message);
  ck_assert_msg(status == ZP_OK || strstr(err.message, "disk/out"), "no file name: %s", err.message);
  ck_assert((status == ZP_OK) == exists("disk/out/summary.json"));
  count_files("disk");
  check_complete("disk/out/table.csv", "\n");
  check_complete("disk/out/shapes.pvd", "</VTKFile>\n");
  check_complete("disk/out/shapes/shape_0000.vtp", "</VTKFile>\n");
  check_complete("disk/out/plots/stroke.svg", "</svg>\n\n");
  check_complete("disk/out/plots/animation.gif", ";");
  ck_assert_int_eq(umount(in_base("disk")), 0);
  return status == ZP_OK;
}

TEST(full_disk) {
  ck_assert_int_eq(mkdir(in_base("disk"), 0777), 0);
  if (mount("none", in_base("disk"), "tmpfs", 0, "size=64k") != 0) return; /* only root may try this */
  ck_assert_int_eq(umount(in_base("disk")), 0);
  bool enough = false;
  for (int kilobytes = 4; !enough; kilobytes += kilobytes / 3 + 4) {
    ck_assert_int_lt(kilobytes, 10000);
    enough = write_on_small_disk(kilobytes);
  }
}

TEST(no_gnuplot) {
  ck_assert_int_eq(setenv("PATH", in_base("nowhere"), 1), 0);
  write_single("out", NULL, made_up(50, 10, false, 8e3, 1), 1);
  ck_assert(exists("out/plots/stroke.gp") && exists("out/plots/shapes.dat") && exists("out/summary.json"));
  ck_assert(!exists("out/plots/stroke.svg"));
  ck_assert_ptr_nonnull(strstr(notices, "gnuplot was not found"));
  ck_assert_msg(strchr(notices, '\n')[1] == 0, "more than one notice: %s", notices);
  count_files("out");
}

TEST(broken_gnuplot) {
  ck_assert_int_eq(mkdir(in_base("bin"), 0777), 0);
  put_file("bin/gnuplot", "#!/bin/sh\necho junk\necho '\"stroke.gp\" line 3: it is broken' >&2\nexit 1\n");
  ck_assert_int_eq(chmod(in_base("bin/gnuplot"), 0755), 0);
  ck_assert_int_eq(setenv("PATH", in_base("bin"), 1), 0);
  write_single("out", NULL, made_up(50, 10, false, 8e3, 1), 1);
  ck_assert(exists("out/plots/stroke.gp") && !exists("out/plots/stroke.svg"));
  ck_assert_ptr_nonnull(strstr(notices, "stroke.svg was not drawn: \"stroke.gp\" line 3: it is broken"));
  count_files("out");
}

/* -- a gnuplot that hangs blocked for ever, swallowed the first Ctrl-C, and summary.json never came ---------------- */

/* Put a script in the place of gnuplot. */
static void put_gnuplot(const char *script) {
  ck_assert_int_eq(mkdir(in_base("bin"), 0777), 0);
  put_file("bin/gnuplot", script);
  ck_assert_int_eq(chmod(in_base("bin/gnuplot"), 0755), 0);
  char path[2600];
  snprintf(path, sizeof path, "%s:%s", in_base("bin"), getenv("PATH"));
  ck_assert_int_eq(setenv("PATH", path, 1), 0);
}

/* A gnuplot that says where it is, ignores what can be ignored, leaves the work to a child and never ends. */
static void put_hanging_gnuplot(void) {
  put_gnuplot(
      "#!/bin/sh\ntrap '' INT TERM HUP\necho $$ >starting.$$ && mv starting.$$ started\nsleep 1000\nsleep 1000\n");
}
static bool nothing_runs(const char *started) {
  size_t size;
  char *text = read_whole(in_base(started), &size);
  pid_t group = (pid_t)strtol(text, NULL, 10);
  ck_assert_int_gt(group, 1);
  for (int i = 0; i < 30000 && kill(-group, 0) == 0; i++) /* its child is someone else's to bury */
    usleep(10000);
  return kill(-group, 0) != 0 && errno == ESRCH;
}

static const ZpPicture two[] = {{"a", "svg", "same_scale.gp"}, {"b", "svg", "same_scale.gp"}};

/* Let the gnuplot of the test draw two pictures, `jobs` at once. */
static void draw_two(int jobs, double patience) {
  ZpError err;
  ZpDrawing drawing = {.folder = in_base("plots"), .notice = note, .patience = patience, .jobs = jobs};
  ck_assert_int_eq(mkdir(drawing.folder, 0777), 0);
  for (size_t i = 0; i < 2; i++)
    ck_assert_int_eq(zp_drawing_script(&drawing, &two[i], &err), ZP_OK);
  zp_drawing_draw(&drawing, two, 2);
}

TEST(after_a_hanging_gnuplot_no_other_is_started) {
  put_hanging_gnuplot();
  draw_two(1, 8); /* it has started by then */
  ck_assert_ptr_nonnull(
      strstr(notices, "plots/a.svg was not drawn: gnuplot took longer than 8 s; the rest are not drawn either"));
  ck_assert_msg(strchr(notices, '\n')[1] == 0, "more than one notice: %s", notices);
  ck_assert(exists("plots/a.gp") && exists("plots/b.gp") && !exists("plots/a.svg"));
  ck_assert(nothing_runs("plots/started"));
  count_files("plots");
}

/* -- pictures that cannot be turned off cost more than the run, and most of that was an animation nobody asked for ----
 */

TEST(no_pictures_where_plots_are_off) {
  write_single("out", NULL, made_up(50, 10, false, 8e3, 1), 1);
  ck_assert(exists("out/plots/stroke.svg") && exists("out/plots/stroke.gp"));
  write_single("out", "output.plots=false", made_up(50, 10, false, 8e3, 1), 1);
  ck_assert(!exists("out/plots/stroke.svg") && !exists("out/plots/stroke.gp") && exists("out/summary.json"));
  write_single("new", "output.plots=false", made_up(50, 10, false, 8e3, 1), 1);
  ck_assert(!exists("new/plots") && exists("new/table.csv"));
  ck_assert_str_eq(notices, "");
}

TEST(no_animation_unless_asked) {
  write_single("out", "output.animation=false", made_up(50, 10, false, 8e3, 1), 1);
  ck_assert(exists("out/plots/stroke.svg") && !exists("out/plots/animation.gif") && !exists("out/plots/animation.gp"));
}

/* Each gnuplot waits until another one has started: drawn one after the other, they would hang. */
TEST(pictures_are_drawn_at_once) {
  put_gnuplot("#!/bin/sh\n>started.$$\nwhile [ \"$(ls started.* | wc -l)\" -lt 2 ]; do sleep 0.01; done\n"
              "out=${3#*\\'}\necho '<svg> </svg>' >\"${out%\\'}\"\n");
  draw_two(2, 60);
  ck_assert_str_eq(notices, "");
  ck_assert(exists("plots/a.svg") && exists("plots/b.svg"));
}

/* Asks to stop once summary.json is there: a report that draws before it writes numbers never ends. */
static bool stop_with_numbers(void *user, const char *stage, double fraction) {
  (void)user, (void)stage, (void)fraction;
  return exists("out/summary.json") && exists("out/table.csv") && exists("out/results.h5") &&
         exists("out/plots/started");
}

TEST(numbers_come_before_pictures) {
  put_hanging_gnuplot();
  ZpScenario *scenario = scenario_of(NULL);
  ZpResult *result = made_up(50, 10, false, 8e3, 1);
  const ZpHooks hooks = {.progress = stop_with_numbers};
  const ZpReport report = {in_base("out"), scenario, &result, 1, 1, NULL, &hooks, NULL, 0, NULL, NULL};
  ck_ok(zp_report_write(&report, note, &err));
  ck_assert_ptr_nonnull(strstr(notices, "was not drawn: interrupted; the rest are not drawn either"));
  ck_assert(nothing_runs("out/plots/started"));
  count_files("out");
}

/* -- two runs into one folder mixed their files without a word --------------------------------------------------- */

TEST(folder_of_another_run_is_refused) {
  ZpError err = {0};
  ZpFolder *folder, *other;
  char text[64];
  ck_ok(zp_folder_open(in_base("out"), &folder, &err));
  ck_assert_int_eq(zp_folder_open(in_base("out"), &other, &err), ZP_MACHINE);
  ck_assert_ptr_null(other);
  snprintf(text, sizeof text, "/out: process %ld on ", (long)getpid());
  ck_assert_msg(strstr(err.message, text) != NULL, "%s", err.message);
  ck_ok(zp_folder_open(in_base("another"), &other, &err));
  zp_folder_close(other);
  zp_folder_close(folder);
  ck_ok(zp_folder_open(in_base("out"), &folder, &err));
  zp_folder_close(folder);
  ck_assert_uint_eq(count_files("out"), 0);
}

/* Take the folder, begin a file, and die. */
static void die_while_writing(const char *directory) {
  ZpFolder *folder;
  ZpAtomic out;
  ZpError err;
  char plots[1400];
  snprintf(plots, sizeof plots, "%s/plots", directory);
  bool begun = zp_folder_open(directory, &folder, &err) == ZP_OK && mkdir(plots, 0777) == 0 &&
               zp_atomic_open(&out, directory, "table.csv", &err) == ZP_OK &&
               zp_atomic_reserve(&out, plots, "stroke.svg", &err) == ZP_OK;
  if (begun) raise(SIGKILL);
  _exit(1);
}

TEST(what_a_killed_run_left_is_cleaned_up) {
  const char *const mine[] = {"out/.notes.12.tmp", "out/.a.zipact-12.tmp.bak", "out/x.zipact-12.tmp", "out/12.tmp"};
  int status = 0;
  ZpFolder *folder;
  pid_t child = fork();
  if (child == 0) die_while_writing(in_base("out"));
  ck_assert_int_eq(waitpid(child, &status, 0), child);
  ck_assert(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  ck_assert_int_eq(entries("out"), 3);       /* lock, table.csv to be, plots */
  ck_assert_int_eq(entries("out/plots"), 1); /* stroke.svg to be */
  for (size_t i = 0; i < sizeof mine / sizeof mine[0]; i++)
    put_file(mine[i], "mine");
  ck_ok(zp_folder_open(in_base("out"), &folder, &err));
  zp_folder_close(folder);
  ck_assert_int_eq(entries("out"), 1 + (int)(sizeof mine / sizeof mine[0]));
  ck_assert_int_eq(entries("out/plots"), 0);
  for (size_t i = 0; i < sizeof mine / sizeof mine[0]; i++)
    ck_assert(exists(mine[i]));
}

/* Many processes take a folder in turn; each looks whether it is alone there. */
static int alone_each_time(const char *directory) {
  char path[1400];
  snprintf(path, sizeof path, "%s/alone", directory);
  for (int taken = 0; taken < 100;) {
    ZpFolder *folder;
    if (zp_folder_open(directory, &folder, NULL) != ZP_OK) {
      sched_yield();
      continue;
    }
    int fd = open(path, O_CREAT | O_EXCL | O_WRONLY, 0666);
    if (fd < 0) return 2;
    close(fd);
    sched_yield();
    if (unlink(path) != 0) return 3;
    zp_folder_close(folder);
    taken++;
  }
  return 0;
}

TEST(only_one_process_has_a_folder) {
  enum { PROCESSES = 6 };
  const char *directory = in_base("out");
  for (int i = 0; i < PROCESSES; i++)
    if (fork() == 0) _exit(alone_each_time(directory));
  for (int i = 0; i < PROCESSES; i++) {
    int status = -1;
    ck_assert_int_gt(wait(&status), 0);
    ck_assert_msg(status == 0, "a process ended with %d", WEXITSTATUS(status));
  }
  ck_assert_int_eq(entries("out"), 0);
}
