/* zipact STUDY and zipact run: scenario => runs => report. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <zipact/calibrate.h>

#include "cli.h"

typedef struct Batch {
  ZpScenario *scenario;
  ZpResult **result; /* [count] */
  size_t count;      /* to run */
  size_t done;
  bool interrupted;
} Batch;

static ZpStatus read_scenario(const char *study, const Options *o, ZpScenario *scenario, ZpError *err) {
  ZpStatus status = o->scenario ? zp_scenario_read(scenario, o->scenario, err) : ZP_OK;
  for (int i = 0; i < o->sets && status == ZP_OK; i++)
    status = zp_scenario_set(scenario, o->set[i], err);
  if (!study || status != ZP_OK) return status;
  char assignment[64];
  snprintf(assignment, sizeof assignment, "study=%s", study);
  return zp_scenario_set(scenario, assignment, err);
}

/* Every Def must be right before the first is run: wrong input writes nothing. */
static ZpStatus check_all(const Batch *batch, ZpError *err) {
  ZpActuatorDef def;
  ZpStatus status = ZP_OK;
  for (size_t i = 0; i < batch->count && status == ZP_OK; i++) {
    status = zp_scenario_def(batch->scenario, i, &def, err);
    if (status == ZP_OK) status = zp_data_check(&def, err);
  }
  return status;
}

static ZpStatus run_one(Batch *batch, Progress *progress, ZpError *err) {
  ZpActuatorDef def;
  ZpStatus status = zp_scenario_def(batch->scenario, batch->done, &def, err);
  if (status != ZP_OK) return status;
  ZpHooks hooks = cli_hooks(progress);
  ZpResult *result;
  status = zp_data_study_run(&def, &hooks, &result, err);
  if (status != ZP_OK) return status;
  if (batch->count > 1) { /* a sweep reports no shapes: keep its memory to the series */
    zp_shapes_destroy(result->shapes);
    result->shapes = NULL;
    zp_field_map_destroy(result->map);
    result->map = NULL;
    zp_checkpoint_destroy(result->checkpoint);
    result->checkpoint = NULL;
  }
  batch->result[batch->done++] = result;
  batch->interrupted = result->outcome == ZP_INTERRUPTED;
  return ZP_OK;
}

static ZpStatus run_all(Batch *batch, const Options *o, ZpError *err) {
  Progress progress = {.shown = !o->quiet && isatty(STDERR_FILENO), .of = batch->count};
  ZpStatus status = ZP_OK;
  while (status == ZP_OK && batch->done < batch->count && !batch->interrupted) {
    progress.index = batch->done;
    status = run_one(batch, &progress, err);
  }
  cli_progress_end(&progress);
  return status;
}

static void notice(const char *message) {
  fprintf(stderr, "zipact: %s\n", message);
}

static void print_scalar(const ZpScalar *scalar) {
  bool bare = strcmp(scalar->unit, "1") == 0 || strcmp(scalar->unit, "count") == 0;
  if (isnan(scalar->value))
    printf("  %-28s %14s\n", scalar->name, "-");
  else
    printf("  %-28s %14.6g %s\n", scalar->name, scalar->value, bare ? "" : scalar->unit);
}

/* What a row of a sweep shows of its result. */
typedef struct Shown {
  ZpStudy study;
  const char *scalar, *label;
  double factor;
  const char *unit;
} Shown;

static void print_answers(const ZpResult *result) {
  static const Shown shown[] = {
      {ZP_STUDY_ACTUATE, "contraction", "contraction", 100, "%"},
      {ZP_STUDY_ACTUATE, "zip_time_s", "zip time", 1e3, "ms"},
      {ZP_STUDY_STATIONARY, "stroke_m", "stroke", 1e3, "mm"},
      {ZP_STUDY_EQUILIBRIUM, "pull_in_voltage_V", "pull-in", 1e-3, "kV"},
      {ZP_STUDY_EQUILIBRIUM, "release_voltage_V", "release", 1e-3, "kV"},
      {ZP_STUDY_ISOMETRIC, "force_N", "force", 1, "N"},
      {ZP_STUDY_PROFILE, "force_N", "force", 1, "N"},
      {ZP_STUDY_PROFILE, "scale_factor", "field over plates", 1, ""},
      {ZP_STUDY_PROFILE, "paper_factor", "by the paper's bookkeeping", 1, ""},
      {ZP_STUDY_ISOMETRIC, "zipped_length_m", "zipped", 1e3, "mm"},
      {ZP_STUDY_MODES, "frequency_1_Hz", "frequency", 1, "Hz"},
  };
  for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++) {
    double value = zp_result_get(result, shown[i].scalar);
    if (shown[i].study == result->study && !isnan(value))
      printf("  %s %8.3f %s", shown[i].label, value * shown[i].factor, shown[i].unit);
  }
}

/* The key values of row `index` that the lists of the scenario vary: "drive.voltage=5 kV". */
static void print_row(const Batch *batch, size_t index) {
  size_t lists;
  const int *list = zp_scenario_lists(batch->scenario, &lists);
  ZpActuatorDef def;
  const ZpResult *result = batch->result[index];
  if (zp_scenario_def(batch->scenario, index, &def, NULL) != ZP_OK) return;
  for (size_t k = 0; k < lists; k++) {
    char text[64];
    zp_value_print(list[k], zp_def_get(&def, list[k]), text, sizeof text);
    printf("  %s = %-10s", zp_key(list[k])->name, text);
  }
  printf("  %-12s", zp_outcome_name(result->outcome));
  print_answers(result);
  printf("\n");
}

static void print_summary(const Batch *batch, const char *directory) {
  if (batch->count > 1) {
    for (size_t i = 0; i < batch->done; i++)
      print_row(batch, i);
  } else if (batch->done) {
    const ZpResult *result = batch->result[0];
    printf("%s: %s\n", zp_outcome_name(result->outcome), result->message);
    for (size_t i = 0; i < result->scalars; i++)
      print_scalar(&result->scalar[i]);
    for (size_t i = 0; i < result->warnings; i++)
      printf("  note: %s\n", result->warning[i]);
  }
  printf("results: %s/ (summary.json, table.csv, results.h5, plots/)\n", directory);
}

static int exit_status(const Batch *batch) {
  if (batch->interrupted) return EXIT_INTERRUPTED;
  for (size_t i = 0; i < batch->done; i++)
    if (!zp_outcome_good(batch->result[i]->outcome)) return EXIT_NUMERICS;
  return EXIT_DONE;
}

static int report(const Batch *batch, const Options *o, const char *directory, double wall_time) {
  ZpError err;
  ZpReport report = {directory, batch->scenario, batch->result, batch->done, wall_time};
  if (zp_report_write(&report, o->quiet ? NULL : notice, &err) != ZP_OK) return cli_fail(&err);
  if (o->json) {
    if (zp_summary_write(&report, stdout, &err) != ZP_OK) return cli_fail(&err);
  } else if (!o->quiet) {
    print_summary(batch, directory);
  }
  return exit_status(batch);
}

static int run_and_report(Batch *batch, const Options *o) {
  ZpError err;
  ZpActuatorDef def;
  batch->count = zp_scenario_count(batch->scenario);
  if (check_all(batch, &err) != ZP_OK) return cli_fail(&err);
  if (zp_scenario_def(batch->scenario, 0, &def, &err) != ZP_OK) return cli_fail(&err);
  char directory[64];
  snprintf(directory, sizeof directory, "out/%s", zp_key(zp_key_find("study"))->choices[def.study].word);
  const char *where = o->directory ? o->directory : directory;
  if (zp_report_prepare(where, &err) != ZP_OK) return cli_fail(&err);
  batch->result = calloc(batch->count, sizeof *batch->result);
  if (!batch->result) return cli_fail(&(ZpError){ZP_MACHINE, "no memory"});
  double start = cli_wall_clock(NULL);
  cli_watch_interrupts();
  ZpStatus status = run_all(batch, o, &err);
  int exit_code = EXIT_DONE;
  if (status == ZP_OK || batch->done > 0) exit_code = report(batch, o, where, cli_wall_clock(NULL) - start);
  return status == ZP_OK ? exit_code : cli_fail(&err);
}

int cli_study(const char *study, const Options *o) {
  ZpError err;
  Batch batch = {.scenario = zp_scenario_create()};
  if (!batch.scenario) return cli_fail(&(ZpError){ZP_MACHINE, "no memory"});
  int status = EXIT_INPUT;
  if (read_scenario(study, o, batch.scenario, &err) == ZP_OK)
    status = run_and_report(&batch, o);
  else
    status = cli_fail(&err);
  for (size_t i = 0; i < batch.done; i++)
    zp_result_destroy(batch.result[i]);
  free(batch.result);
  zp_scenario_destroy(batch.scenario);
  return status;
}
