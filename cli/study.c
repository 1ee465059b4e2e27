/* zipact STUDY and zipact run: scenario => runs => report. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <zipact/batch.h>

#include "cli.h"

static ZpStatus read_scenario(const char *study, const Options *o, ZpScenario *scenario, ZpError *err) {
  ZpStatus status = o->scenario ? zp_scenario_read(scenario, o->scenario, err) : ZP_OK;
  for (int i = 0; i < o->sets && status == ZP_OK; i++)
    status = zp_scenario_set(scenario, o->set[i], err);
  if (status == ZP_OK && o->no_plots) status = zp_scenario_set(scenario, "output.plots=false", err);
  if (!study || status != ZP_OK) return status;
  char assignment[64];
  snprintf(assignment, sizeof assignment, "study=%s", study);
  return zp_scenario_set(scenario, assignment, err);
}

static ZpStatus run_all(ZpBatch *batch, const Options *o, ZpError *err) {
  Progress progress = {.shown = !o->quiet && isatty(STDERR_FILENO), .of = batch->count};
  ZpHooks hooks = cli_hooks(&progress);
  ZpStatus status = ZP_OK;
  while (status == ZP_OK && zp_batch_open(batch)) {
    progress.index = batch->done;
    status = zp_batch_next(batch, &hooks, err);
  }
  cli_progress_end(&progress);
  return status;
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
#define ZP_HEADLINE(enumerator, scalar, label, factor, unit) {enumerator, scalar, label, factor, unit},
#include <zipact/studies.def>
  };
  for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++) {
    double value = zp_result_get(result, shown[i].scalar);
    if (shown[i].study == result->study && !isnan(value))
      printf("  %s %8.3f %s", shown[i].label, value * shown[i].factor, shown[i].unit);
  }
}

/* The key values of row `index` that the lists of the scenario vary: "drive.voltage=5 kV". */
static void print_row(const ZpBatch *batch, size_t index) {
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

static void print_summary(const ZpBatch *batch, const char *directory, bool plots) {
  if (batch->count > 1) {
    for (size_t i = 0; i < batch->done; i++)
      print_row(batch, i);
  } else if (batch->done) {
    const ZpResult *result = batch->result[0];
    printf("%s: %s\n", zp_outcome_name(result->outcome), result->message);
    for (size_t i = 0; i < result->scalars; i++)
      print_scalar(&result->scalar[i]);
    for (size_t i = 0; i < result->notes; i++)
      printf("  note: %s\n", result->note[i]);
  }
  printf("results: %s/ (summary.json, table.csv, results.h5%s)\n", directory, plots ? ", plots/" : "");
}

static int exit_status(const ZpBatch *batch) {
  if (batch->interrupted || cli_interrupted()) return EXIT_INTERRUPTED;
  return zp_batch_good(batch) ? EXIT_DONE : EXIT_NUMERICS;
}

/* A folder that is open, and where it is. */
typedef struct Place {
  const char *directory;
  ZpFolder *folder;
} Place;

static int report(const ZpBatch *batch, const Options *o, const Place *place, double wall_time) {
  ZpError err;
  Progress silent = {0};
  const ZpHooks hooks = cli_hooks(&silent);
  const ZpReport report = {place->directory, batch->scenario, batch->result, batch->done,
                           wall_time,        place->folder,   &hooks,        o->jobs};
  if (batch->interrupted) cli_watch_interrupts(); /* what was done is still drawn, unless there is another Ctrl-C */
  if (zp_report_write(&report, o->quiet ? NULL : cli_notice, &err) != ZP_OK) return cli_fail(&err);
  if (o->json) {
    if (zp_summary_write(&report, stdout, &err) != ZP_OK) return cli_fail(&err);
  } else if (!o->quiet) {
    print_summary(batch, place->directory, !o->no_plots);
  }
  return exit_status(batch);
}

static int run_and_report(ZpBatch *batch, const Options *o, const Place *place) {
  ZpError err;
  double start = cli_wall_clock(NULL);
  cli_watch_interrupts();
  ZpStatus status = run_all(batch, o, &err);
  int exit_code = EXIT_DONE;
  if (status == ZP_OK || batch->done > 0) exit_code = report(batch, o, place, cli_wall_clock(NULL) - start);
  return status == ZP_OK ? exit_code : cli_fail(&err);
}

/* Have the folder for as long as the runs and their report take. */
static int run_in_folder(ZpBatch *batch, const Options *o) {
  ZpError err;
  char directory[64];
  snprintf(directory, sizeof directory, "out/%s", zp_study_name(zp_scenario_study(batch->scenario)));
  Place place = {o->directory ? o->directory : directory, NULL};
  if (zp_folder_open(place.directory, &place.folder, &err) != ZP_OK) return cli_fail(&err);
  int exit_code = run_and_report(batch, o, &place);
  zp_folder_close(place.folder);
  return exit_code;
}

int cli_study(const char *study, const Options *o) {
  ZpError err;
  ZpBatch batch = {0};
  ZpScenario *scenario = zp_scenario_create();
  if (!scenario) return cli_fail(&(ZpError){ZP_MACHINE, "no memory"});
  ZpStatus status = read_scenario(study, o, scenario, &err);
  if (status == ZP_OK) status = zp_batch_create(scenario, &batch, &err);
  int exit_code = status == ZP_OK ? run_in_folder(&batch, o) : cli_fail(&err);
  zp_batch_free(&batch);
  zp_scenario_destroy(scenario);
  return exit_code;
}
