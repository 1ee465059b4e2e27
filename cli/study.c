/* zipact STUDY and zipact run: scenario => runs => report. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <zipact/batch.h>
#include <zipact/calibrate.h>

#include "cli.h"

ZpStatus cli_read_scenario(const char *study, const Options *o, ZpScenario *scenario, ZpError *err) {
  ZpStatus status = o->scenario ? zp_scenario_read(scenario, o->scenario, err) : ZP_OK;
  for (int i = 0; i < o->sets && status == ZP_OK; i++)
    status = zp_scenario_set(scenario, o->set[i], err);
  if (status == ZP_OK && o->no_plots) status = zp_scenario_set(scenario, "output.plots=false", err);
  if (!study || status != ZP_OK) return status;
  char assignment[64];
  snprintf(assignment, sizeof assignment, "study=%s", study);
  return zp_scenario_set(scenario, assignment, err);
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
static void print_row(const ZpReport *report, size_t index) {
  size_t lists;
  const int *list = zp_scenario_lists(report->scenario, &lists);
  const ZpResult *result = report->rows->get(report->rows->user, index);
  ZpActuatorDef def;
  if (zp_scenario_def(report->scenario, index, &def, NULL) != ZP_OK) return;
  for (size_t k = 0; k < lists; k++) {
    char text[64];
    zp_value_print(list[k], zp_def_get(&def, list[k]), text, sizeof text);
    printf("  %s = %-10s", zp_key(list[k])->name, text);
  }
  printf("  %-12s", zp_outcome_name(result->outcome));
  print_answers(result);
  printf("\n");
}

/* The best cases of an optimisation. */
static void print_optimum(const ZpReport *report) {
  printf("%s\n", report->optimum->message);
  for (size_t i = 0; i < report->optimum->count; i++) {
    print_row(report, report->optimum->row[i]);
    for (size_t k = 0; k < report->optimum->objectives; k++)
      printf(
          "    %s = %.6g\n", report->optimum->objective[k],
          zp_result_get(report->rows->get(report->rows->user, report->optimum->row[i]), report->optimum->objective[k]));
  }
}

static void print_rows(const ZpReport *report) {
  enum { PRINTED = 100 };
  for (size_t i = 0; i < report->count && i < PRINTED; i++)
    print_row(report, i);
  if (report->count > PRINTED) printf("  ... and %zu more rows in table.csv\n", report->count - PRINTED);
}

static void print_result(const ZpResult *result) {
  printf("%s: %s\n", zp_outcome_name(result->outcome), result->message);
  for (size_t i = 0; i < result->scalars; i++)
    print_scalar(&result->scalar[i]);
  for (size_t i = 0; i < result->notes; i++)
    printf("  note: %s\n", result->note[i]);
}

static void print_summary(const ZpReport *report, bool plots) {
  if (report->optimum)
    print_optimum(report);
  else if (report->rows)
    print_rows(report);
  else if (report->count > 0)
    print_result(report->result[0]);
  printf("results: %s/ (summary.json, table.csv, results.h5%s)\n", report->directory, plots ? ", plots/" : "");
}

/* Write and print a report => EXIT_DONE or why not. */
static int write_report(const ZpReport *what, const Options *o) {
  ZpError err;
  Progress silent = {0};
  const ZpHooks hooks = cli_hooks(&silent);
  ZpReport report = *what;
  report.hooks = &hooks;
  report.jobs = o->jobs;
  if (cli_interrupted()) cli_watch_interrupts(); /* what was done is still drawn, unless there is another Ctrl-C */
  if (zp_report_write(&report, o->quiet ? NULL : cli_notice, &err) != ZP_OK) return cli_fail(&err);
  if (o->json) {
    if (zp_summary_write(&report, stdout, &err) != ZP_OK) return cli_fail(&err);
  } else if (!o->quiet) {
    print_summary(&report, !o->no_plots);
  }
  return EXIT_DONE;
}

/* The exit status of what was reported with `status`; an interrupt while pictures were drawn counts, too. */
static int exit_status(int status, bool interrupted, bool good) {
  if (status != EXIT_DONE) return status;
  if (interrupted || cli_interrupted()) return EXIT_INTERRUPTED;
  return good ? EXIT_DONE : EXIT_NUMERICS;
}

static Progress begin_progress(const Options *o) {
  cli_watch_interrupts();
  return (Progress){.shown = !o->quiet && isatty(STDERR_FILENO), .start = cli_wall_clock(NULL)};
}

/* -- one case --------------------------------------------------------------------------------------- */

static int run_one(const ZpScenario *scenario, const Options *o, const char *directory, const ZpFolder *folder) {
  ZpError err;
  ZpActuatorDef def;
  ZpResult *result = NULL;
  Progress progress = begin_progress(o);
  const ZpHooks hooks = cli_hooks(&progress);
  ZpStatus status = zp_scenario_def(scenario, 0, &def, &err);
  if (status == ZP_OK) status = zp_data_study_run(zp_scenario_study(scenario), &def, &hooks, &result, &err);
  cli_progress_end(&progress);
  if (status != ZP_OK) return cli_fail(&err);
  const ZpReport report = {.directory = directory,
                           .scenario = scenario,
                           .result = &result,
                           .count = 1,
                           .wall_time = cli_wall_clock(NULL) - progress.start,
                           .folder = folder};
  const bool interrupted = result->outcome == ZP_INTERRUPTED;
  int code = exit_status(write_report(&report, o), interrupted, zp_outcome_good(result->outcome));
  zp_result_destroy(result);
  return code;
}

/* -- many cases ------------------------------------------------------------------------------------- */

static bool on_campaign(void *user, const ZpCampaignState *state) {
  cli_draw_campaign(user, state);
  return cli_interrupted();
}

static ZpCampaignOptions campaign_options(const Options *o, Progress *progress) {
  return (ZpCampaignOptions){.jobs = o->crew ? o->crew->size : o->jobs,
                             .resume = o->resume,
                             .user = progress,
                             .progress = on_campaign,
                             .clock = cli_wall_clock,
                             .remote = o->crew ? o->crew->compute : NULL};
}

static int report_campaign(ZpCampaign *campaign, const ZpScenario *scenario, const Options *o, const char *directory,
                           const ZpFolder *folder, double wall_time) {
  const ZpCampaignState state = zp_campaign_state(campaign);
  const ZpReport report = {.directory = directory,
                           .scenario = scenario,
                           .count = zp_campaign_count(campaign),
                           .wall_time = wall_time,
                           .folder = folder,
                           .rows = zp_campaign_rows(campaign)};
  const bool interrupted = cli_interrupted();
  if (state.resumed > 0 && !o->quiet)
    fprintf(stderr, "zipact: %zu of %zu cases were done before\n", state.resumed, state.cases);
  return exit_status(write_report(&report, o), interrupted, state.failed == 0);
}

static int run_many(const ZpScenario *scenario, const Options *o, const char *directory, const ZpFolder *folder) {
  ZpError err;
  ZpCampaign *campaign;
  Progress progress = begin_progress(o);
  const ZpCampaignOptions options = campaign_options(o, &progress);
  if (o->crew && o->crew->begin(scenario, &err) != ZP_OK) return cli_fail(&err);
  if (zp_campaign_open(scenario, directory, &options, &campaign, &err) != ZP_OK) return cli_fail(&err);
  ZpStatus status = zp_campaign_run(campaign, &err);
  cli_progress_end(&progress);
  int code = EXIT_DONE;
  if (status == ZP_OK || zp_campaign_count(campaign) > 0)
    code = report_campaign(campaign, scenario, o, directory, folder, cli_wall_clock(NULL) - progress.start);
  zp_campaign_close(campaign);
  return status == ZP_OK ? code : cli_fail(&err);
}

/* -- the best case ---------------------------------------------------------------------------------- */

static int optimize_in_folder(const ZpScenario *scenario, const Options *o, const char *directory,
                              const ZpFolder *folder) {
  ZpError err;
  ZpOptimization *optimization;
  Progress progress = begin_progress(o);
  ZpCampaignOptions options = campaign_options(o, &progress);
  options.remote = NULL; /* its cases follow from each other */
  options.jobs = o->jobs;
  ZpStatus status = zp_optimize(scenario, directory, &options, &optimization, &err);
  cli_progress_end(&progress);
  if (status != ZP_OK) return cli_fail(&err);
  ZpReport report = *zp_optimization_report(optimization);
  report.directory = directory;
  report.folder = folder;
  report.wall_time = cli_wall_clock(NULL) - progress.start;
  const bool interrupted = cli_interrupted();
  int code = exit_status(write_report(&report, o), interrupted, true);
  zp_optimization_destroy(optimization);
  return code;
}

int cli_optimize(const Options *o) {
  ZpError err;
  ZpFolder *folder;
  ZpScenario *scenario = zp_scenario_create();
  if (!scenario) return cli_fail(&(ZpError){ZP_MACHINE, "no memory"});
  const char *directory = o->directory ? o->directory : "out/optimize";
  ZpStatus status = cli_read_scenario(NULL, o, scenario, &err);
  if (status == ZP_OK) status = zp_folder_open(directory, &folder, &err);
  int code = status == ZP_OK ? optimize_in_folder(scenario, o, directory, folder) : cli_fail(&err);
  if (status == ZP_OK) zp_folder_close(folder);
  zp_scenario_destroy(scenario);
  return code;
}

/* -- a scenario ------------------------------------------------------------------------------------- */

/* Have the folder for as long as the runs and their report take. */
static int run_in_folder(const ZpScenario *scenario, const Options *o) {
  ZpError err;
  ZpFolder *folder;
  size_t lists;
  char own[64];
  snprintf(own, sizeof own, "out/%s", zp_study_name(zp_scenario_study(scenario)));
  const char *directory = o->directory ? o->directory : own;
  zp_scenario_lists(scenario, &lists);
  if (o->resume && lists == 0)
    return cli_fail(&(ZpError){ZP_BAD_INPUT, "--resume continues a sweep; the scenario has no list of values"});
  if (zp_folder_open(directory, &folder, &err) != ZP_OK) return cli_fail(&err);
  int code = lists > 0 ? run_many(scenario, o, directory, folder) : run_one(scenario, o, directory, folder);
  zp_folder_close(folder);
  return code;
}

int cli_study(const char *study, const Options *o) {
  ZpError err;
  ZpScenario *scenario = zp_scenario_create();
  if (!scenario) return cli_fail(&(ZpError){ZP_MACHINE, "no memory"});
  ZpStatus status = cli_read_scenario(study, o, scenario, &err);
  if (status == ZP_OK) status = zp_batch_check(scenario, &err);
  int exit_code = status == ZP_OK ? run_in_folder(scenario, o) : cli_fail(&err);
  zp_scenario_destroy(scenario);
  return exit_code;
}
