/* zipact bench: CPU time of steps, motions, equilibria and cases of sweeps on this machine, on one thread. */
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/batch.h>

#include "cli.h"
#include "motion.h"
#include "plain_kernel.h"
#include "reproduce/reproduce.h"

typedef struct Row {
  const char *name;
  int nodes;
  double ns_per_node_step; /* time per node of both ribbons */
  double steps;            /* per simulated second */
  double seconds;          /* of one thread per simulated second */
  double cpu;              /* time spent on the row; for equilibria: on one study, s */
  double paper_ratio;      /* cost of the paper over this cost; NAN if the paper gives none */
  double error;            /* relative error; NAN without a reference */
} Row;

/* A measurement, repeated with several numbers of nodes. */
typedef struct Case Case;
struct Case {
  ZpStatus (*measure)(const Case *of, int nodes, Row *row, ZpError *err); /* => row, except its name */
  const char *name;
  int nodes[5];         /* the rest 0 */
  const char *scenario; /* without the nodes */
};

/* -- scenarios ------------------------------------------------------------------------------------- */

static ZpStatus read_scenario(const Case *of, int nodes, ZpScenario **scenario, ZpError *err) {
  char text[512];
  *scenario = zp_scenario_create();
  *err = (ZpError){ZP_MACHINE, "no memory"};
  if (!*scenario) return ZP_MACHINE;
  snprintf(text, sizeof text, "%smesh.nodes: %d\n", of->scenario, nodes);
  return zp_scenario_parse(*scenario, text, strlen(text), "bench", err);
}

static ZpStatus define_study(const Case *of, int nodes, ZpStudy *study, ZpActuatorDef *def, ZpError *err) {
  ZpScenario *scenario;
  ZpStatus status = read_scenario(of, nodes, &scenario, err);
  if (status == ZP_OK) status = zp_scenario_def(scenario, 0, def, err);
  if (status == ZP_OK) *study = zp_scenario_study(scenario);
  zp_scenario_destroy(scenario);
  return status;
}

static ZpStatus define(const Case *of, int nodes, ZpActuatorDef *def, ZpError *err) {
  ZpStudy study;
  return define_study(of, nodes, &study, def, err);
}

/* -- explicit steps -------------------------------------------------------------------------------- */

enum { REPEATS = 5 };

static int compare(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static double median(double *values) {
  qsort(values, REPEATS, sizeof *values, compare);
  return values[REPEATS / 2];
}

/* Runs of 4 ms from equilibrium => CPU seconds per step, and the mean step, s. */
static ZpStatus time_steps(const ZpActuatorDef *def, double *per_step, double *mean_step, ZpError *err) {
  static const double span = 4e-3;
  ZpModel *model;
  ZpSim *sim = NULL;
  double samples[REPEATS] = {0};
  ZpRunInfo *info = zp_run_info_create();
  ZpStatus status = zp_model_create(def, &model, err);
  if (status == ZP_OK) status = zp_sim_create(model, NULL, &sim, err);
  for (int k = 0; k < REPEATS && status == ZP_OK; k++) {
    double start = motion_clock();
    zp_sim_run(sim, span * (k + 1), false, NULL, info);
    samples[k] = (motion_clock() - start) / zp_run_info_get(info, "steps");
    *mean_step = zp_run_info_get(info, "simulated_time") / zp_run_info_get(info, "steps");
  }
  *per_step = median(samples);
  zp_run_info_destroy(info);
  zp_sim_destroy(sim);
  zp_model_destroy(model);
  return status;
}

/* (CPU seconds per step, simulated seconds per step, start of the measurement) */
static Row row_of_steps(int nodes, double per_step, double step, double start) {
  return (Row){.ns_per_node_step = 1e9 * per_step / (2 * nodes),
               .nodes = nodes,
               .steps = 1 / step,
               .seconds = per_step / step,
               .cpu = motion_clock() - start,
               .paper_ratio = NAN,
               .error = NAN};
}

/* A row of steps at the mean step of the paper, for comparison with its cost, which is that of MATLAB code on one
 * thread of an i7-8700. */
static Row row_beside_paper(int nodes, double per_step, double start) {
  Row row = row_of_steps(nodes, per_step, 1e-6 * zp_published(ZP_MEAN_STEP, nodes, 0), start);
  row.paper_ratio = 60 * zp_published(ZP_COST, nodes, 0) / row.seconds;
  return row;
}

static ZpStatus steps_of_paper(const Case *of, int nodes, Row *row, ZpError *err) {
  ZpActuatorDef *def = zp_def_create();
  double per_step = NAN, own_step, start = motion_clock();
  ZpStatus status = define(of, nodes, def, err);
  if (status == ZP_OK) status = time_steps(def, &per_step, &own_step, err);
  *row = row_beside_paper(nodes, per_step, start);
  zp_def_destroy(def);
  return status;
}

static ZpStatus steps(const Case *of, int nodes, Row *row, ZpError *err) {
  ZpActuatorDef *def = zp_def_create();
  double per_step = NAN, step = NAN, start = motion_clock();
  ZpStatus status = define(of, nodes, def, err);
  if (status == ZP_OK) status = time_steps(def, &per_step, &step, err);
  *row = row_of_steps(nodes, per_step, step, start);
  zp_def_destroy(def);
  return status;
}

static ZpStatus plain(const Case *of, int nodes, Row *row, ZpError *err) {
  static const long node_steps = 6000000; /* below 0.1 s */
  long count = node_steps / (2L * nodes);
  double l = 0.045 / (nodes - 1), samples[REPEATS], start = motion_clock();
  PlainKernel kernel = {l, 1e3, 10, 1e-5, 9.81, 0.1, 1e-6};
  (void)of;
  for (int k = 0; k < REPEATS; k++) {
    double begin = motion_clock();
    *err = (ZpError){ZP_MACHINE, "no memory"};
    if (isnan(plain_kernel_run(&kernel, nodes, count))) return ZP_MACHINE;
    samples[k] = (motion_clock() - begin) / (double)count;
  }
  *row = row_beside_paper(nodes, median(samples), start);
  return ZP_OK;
}

/* -- motions --------------------------------------------------------------------------------------- */

/* `scale`: the size to which errors refer; NAN: there is no reference. */
static ZpStatus motion(const ZpActuatorDef *def, const ZpDriveTable *table, double scale, Row *row, ZpError *err) {
  const int ribbons = zp_def_number(def, "actuator.kind") == ZP_KIND_ELECTRO_RIBBON ? 2 : 1;
  const int nodes = (int)zp_def_number(def, "mesh.nodes");
  const Trajectory reference = motion_swing_reference();
  Motion m;
  ZpStatus status = motion_measure(def, table, isnan(scale) ? NULL : &reference, &m, err);
  if (status != ZP_OK) return status;
  *row = (Row){.nodes = nodes,
               .ns_per_node_step = 1e9 * m.seconds / (m.steps * ribbons * nodes),
               .steps = m.steps,
               .seconds = m.seconds,
               .cpu = m.cpu,
               .paper_ratio = NAN,
               .error = m.rms / scale};
  return ZP_OK;
}

/* Error: rms of the distance of the tip from the converged swing, over the height of the swing. */
static ZpStatus swing(const Case *of, int nodes, Row *row, ZpError *err) {
  ZpActuatorDef *def = zp_def_create();
  ZpStatus status = motion_swing(nodes, strcmp(of->scenario, "implicit") == 0, def, err);
  if (status == ZP_OK) status = motion(def, NULL, motion_swing_height, row, err);
  zp_def_destroy(def);
  return status;
}

static ZpStatus zip(const Case *of, int nodes, Row *row, ZpError *err) {
  ZpActuatorDef *def = zp_def_create();
  ZpStatus status = define(of, nodes, def, err);
  if (status == ZP_OK) status = motion(def, NULL, NAN, row, err);
  zp_def_destroy(def);
  return status;
}

/* The actuator zips, is held, is released and swings, 1 s in total. */
static ZpStatus use(const Case *of, int nodes, Row *row, ZpError *err) {
  static const double time[] = {0, 0.48, 0.48}, voltage[] = {10e3, 10e3, 0};
  static const ZpDriveTable table = {3, time, voltage};
  ZpActuatorDef *def = zp_def_create();
  ZpStatus status = define(of, nodes, def, err);
  zp_def_set_number(def, "drive.waveform", ZP_WAVEFORM_TABLE, NULL);
  if (status == ZP_OK) status = motion(def, &table, NAN, row, err);
  zp_def_destroy(def);
  return status;
}

/* -- equilibria ------------------------------------------------------------------------------------ */

static Row row_of_study(int nodes, double cpu, double error) {
  return (Row){NULL, nodes, NAN, NAN, NAN, cpu, NAN, error};
}

/* CPU time of one study, the best of `tries`, and two numbers of its result. */
static ZpStatus time_study(ZpStudy study, const ZpActuatorDef *def, int tries, const char *const name[2], double *best,
                           double number[2], ZpError *err) {
  ZpStatus status = ZP_OK;
  *best = INFINITY;
  for (int k = 0; k < tries && status == ZP_OK; k++) {
    ZpResult *result;
    double start = motion_clock();
    status = zp_study_run(study, def, NULL, NULL, &result, err);
    if (status != ZP_OK) break;
    *best = fmin(*best, motion_clock() - start);
    for (int i = 0; i < 2; i++)
      number[i] = zp_result_get(result, name[i]);
    zp_result_destroy(result);
  }
  return status;
}

static ZpStatus time_rest(ZpStudy study, const ZpActuatorDef *def, double *best, double *stroke, ZpError *err) {
  static const char *const name[] = {"stroke_m", "stroke_m"};
  double number[2] = {NAN, NAN};
  ZpStatus status = time_study(study, def, 50, name, best, number, err);
  *stroke = number[0];
  return status;
}

/* A steel strip of 45 x 12.7 mm x 100 um, guided, with 61 g at its end, from straight: 17.942 mm. */
static ZpStatus strip(const Case *of, int nodes, Row *row, ZpError *err) {
  static const double converged = 17.942e-3; /* m, exact elastica */
  ZpActuatorDef *def = zp_def_create();
  ZpStudy study;
  double best = NAN, stroke = NAN;
  ZpStatus status = define_study(of, nodes, &study, def, err);
  if (status == ZP_OK) status = time_rest(study, def, &best, &stroke, err);
  *row = row_of_study(nodes, best, fabs(stroke / converged - 1));
  zp_def_destroy(def);
  return status;
}

/* All 18 rows of Table II, preset paper-code with the K_S of its authors; the error is the difference from their
 * strokes. */
static ZpStatus table_2(const Case *of, int nodes, Row *row, ZpError *err) {
  static const int sizes[3] = {21, 61, 130};
  static const double load[] = {40, 60, 80, 100, 150, 200}; /* g */
  double sum = 0, worst = 0;
  ZpStatus status = ZP_OK;
  for (int n = 0; n < 3 && status == ZP_OK; n++)
    for (int m = 0; m < 6 && status == ZP_OK; m++) {
      ZpActuatorDef *def = zp_def_create();
      ZpStudy study;
      double best = NAN, stroke = NAN;
      status = define_study(of, sizes[n], &study, def, err);
      zp_def_set_number(def, "mass_spring.shear_coefficient", zp_published(ZP_SAVED_SHEAR, sizes[n], 61), NULL);
      zp_def_set_number(def, "load.mass", 1e-3 * load[m], NULL);
      if (status == ZP_OK) status = time_rest(study, def, &best, &stroke, err);
      zp_def_destroy(def);
      sum += best;
      bool misprint = n == 0 && (m == 1 || m == 2); /* N = 21 at 60 and 80 g: differs from their program */
      if (!misprint) worst = fmax(worst, fabs(stroke * 1e3 / zp_published(ZP_TABLE_2_STROKE, sizes[n], load[m]) - 1));
    }
  *row = row_of_study(nodes, sum, worst);
  return status;
}

/* Study profile on the wedge with an opening of 2 mm: one solution of the field with all its results; the error is the
 * difference between traction and virtual work. */
static ZpStatus field(const Case *of, int nodes, Row *row, ZpError *err) {
  static const char *const name[] = {"virtual_work_difference", "equations"};
  ZpActuatorDef *def = zp_def_create();
  ZpStudy study;
  double best = NAN, number[2] = {NAN, 0};
  ZpStatus status = define_study(of, nodes, &study, def, err);
  if (status == ZP_OK) status = time_study(study, def, 10, name, &best, number, err);
  *row = row_of_study((int)number[1], best, fabs(number[0]));
  zp_def_destroy(def);
  return status;
}

/* -- cases of sweeps ------------------------------------------------------------------------------- */

/* CPU time per case, including everything except files and journal, the best of some repetitions. */
static ZpStatus cases(const Case *of, int nodes, Row *row, ZpError *err) {
  enum { TRIES = 3 };
  ZpScenario *scenario;
  double best = INFINITY;
  ZpStatus status = read_scenario(of, nodes, &scenario, err);
  for (int k = 0; k < TRIES && status == ZP_OK; k++) {
    ZpBatch batch;
    status = zp_batch_create(scenario, &batch, err);
    const double start = motion_clock();
    while (status == ZP_OK && zp_batch_open(&batch))
      status = zp_batch_next(&batch, NULL, err);
    if (status == ZP_OK) best = fmin(best, (motion_clock() - start) / (double)batch.count);
    zp_batch_free(&batch);
  }
  zp_scenario_destroy(scenario);
  *row = row_of_study(nodes, best, NAN);
  return status;
}

/* -- all of them ----------------------------------------------------------------------------------- */

/* Steps at the sizes of the paper. Zips from the hanging equilibrium: the first until it has closed; in the sweep
 * without liquid, zip times to 0.1 %. Of the cases of limits, one in 8 starts from scratch, the others from the case
 * before. */
static const Case list[] = {
    {plain, "plain mechanics kernel", {21, 61, 130}, NULL},
    {steps_of_paper, "explicit paper-code", {21, 61, 130}, "preset: paper-code\nelectro.refresh_period: 0\n"},
    {steps, "explicit default actuator", {21, 61, 130}, "solver: {integrator: explicit, end_time: 70 ms}\n"},
    {zip, "zip, default actuator", {21, 61, 130}, "solver: {integrator: implicit, end_time: 90 ms}\n"},
    {use, "zip, hold, release, swing", {21, 61, 130}, "solver: {integrator: implicit, end_time: 1 s}\n"},
    {swing, "swing of a cantilever", {21, 61, 131}, "implicit"},
    {swing, "explicit swing", {21, 61, 131}, "explicit"},
    {strip,
     "rest of a guided strip",
     {14, 21, 33, 45},
     "study: stationary\nactuator.kind: ribbon\nribbon: {length: 45 mm, thickness: 100 um, plane: stress}\n"
     "load.mass: 61 g\noutput.errors: false\n"},
    {table_2, "rest, Table II, 18 rows", {130}, "study: stationary\npreset: paper-code\n"},
    {field, "field, unknowns as nodes", {61}, "study: profile\nliquid.model: none\nprofile.shape: cubic\n"},
    {cases,
     "case of stationary",
     {21, 61},
     "study: stationary\nload.mass: {from: 2 g, to: 40 g, count: 40}\n"
     "ribbon.thickness: {from: 40 um, to: 100 um, count: 10}\noutput.errors: false\n"},
    {cases,
     "case of limits",
     {21, 61},
     "study: limits\nliquid.model: none\nload.mass: {from: 2 g, to: 12 g, count: 32}\n"
     "ribbon.thickness: [50 um, 60 um]\noutput.errors: false\n"},
    {cases,
     "case of actuate, dry",
     {21, 61},
     "study: actuate\nliquid.model: none\nsolver.tolerance: 1e-3\n"
     "drive.voltage: {from: 7 kV, to: 10 kV, count: 6}\noutput.errors: false\n"}};

enum { CASES = sizeof list / sizeof list[0], ROWS_MOST = 5 * CASES };

/* A number in a cell, "-" if there is none. */
static void print_cell(int width, int digits, double value) {
  if (isnan(value))
    printf(" %*s", width, "-");
  else
    printf(" %*.*f", width, digits, value);
}

static void print_table(const Row *row, int rows) {
  printf("%-26s %5s %11s %11s %12s %9s %12s\n", "", "nodes", "ns per node", "steps per", "CPU s per", "error",
         "times faster");
  printf("%-26s %5s %11s %11s %12s %9s %12s\n", "", "", "and step", "simulated s", "simulated s", "/ %", "than paper");
  for (int i = 0; i < rows; i++) {
    if (isnan(row[i].seconds)) continue;
    printf("%-26s %5d", row[i].name, row[i].nodes);
    print_cell(11, 2, row[i].ns_per_node_step);
    print_cell(11, 0, row[i].steps);
    print_cell(12, 4, row[i].seconds);
    print_cell(9, 3, 100 * row[i].error);
    print_cell(12, 0, row[i].paper_ratio);
    printf("\n");
  }
  printf("\n%-26s %5s %11s %11s %11s\n", "", "nodes", "CPU ms", "per CPU s", "error / %");
  for (int i = 0; i < rows; i++) {
    if (!isnan(row[i].seconds)) continue;
    printf("%-26s %5d %11.3f %11.0f", row[i].name, row[i].nodes, 1e3 * row[i].cpu, 1 / row[i].cpu);
    print_cell(11, 3, 100 * row[i].error);
    printf("\n");
  }
}

static json_t *real_or_null(double value) {
  return isfinite(value) ? json_real(value) : json_null();
}

static json_t *row_json(const Row *row) {
  return json_pack("{s:s, s:i, s:o, s:o, s:o, s:f, s:o, s:o}", "name", row->name, "nodes", row->nodes,
                   "ns_per_node_step", real_or_null(row->ns_per_node_step), "steps_per_simulated_second",
                   real_or_null(row->steps), "seconds_per_simulated_second", real_or_null(row->seconds), "cpu_s",
                   row->cpu, "error", real_or_null(row->error), "paper_cost_over_this", real_or_null(row->paper_ratio));
}

static int print_json(const Row *row, int rows) {
  json_t *array = json_array(), *all = json_pack("{s:s, s:o}", "version", ZP_VERSION, "rows", array);
  bool done = all != NULL;
  for (int i = 0; i < rows && done; i++)
    done = json_array_append_new(array, row_json(&row[i])) == 0;
  done = done && json_dumpf(all, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(6)) == 0;
  json_decref(all);
  putchar('\n');
  return done ? EXIT_DONE : cli_fail(&(ZpError){ZP_MACHINE, "cannot write to standard output"});
}

int cli_bench(const Options *options) {
  Row row[ROWS_MOST];
  int rows = 0;
  ZpError err;
  for (int i = 0; i < CASES; i++)
    for (const int *nodes = list[i].nodes; *nodes; nodes++) {
      if (list[i].measure(&list[i], *nodes, &row[rows], &err) != ZP_OK) return cli_fail(&err);
      row[rows++].name = list[i].name;
    }
  if (options->given & OPTION_JSON) return print_json(row, rows);
  print_table(row, rows);
  return EXIT_DONE;
}
