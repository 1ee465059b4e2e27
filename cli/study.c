/* zipact STUDY and zipact run: scenario => runs => report. */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <zipact/batch.h>
#include <zipact/calibrate.h>

#include "cli.h"

/* Report numbers without a unit, which may be meant in another unit than SI. */
static void note_bare_numbers(const ZpScenario *scenario) {
  double value;
  for (int i = 0; zp_key(i); i++) {
    char name[ZP_SCENARIO_KEY_SIZE];
    if (!zp_scenario_bare_number(scenario, i, &value)) continue;
    fprintf(stderr, "zipact: %s: %.6g taken as %.6g %s\n", zp_scenario_key(scenario, i, name), value, value,
            zp_key(i)->unit);
  }
}

/* The folder must exist: otherwise its templates would be ignored without notice. */
static ZpStatus check_templates(const char *folder, ZpError *err) {
  struct stat there;
  if (stat(folder, &there) == 0 && S_ISDIR(there.st_mode)) return ZP_OK;
  *err = (ZpError){ZP_BAD_INPUT, ""};
  snprintf(err->message, sizeof err->message, "--templates: there is no folder %s", folder);
  return ZP_BAD_INPUT;
}

static ZpStatus set_budget(ZpScenario *scenario, const char *number, ZpError *err) {
  char assignment[64];
  snprintf(assignment, sizeof assignment, "plan.budget=%s", number);
  return zp_scenario_set(scenario, assignment, err);
}

ZpStatus cli_read_scenario(const char *study, const Options *o, ZpScenario **made, ZpError *err) {
  ZpScenario *scenario = *made = zp_scenario_create();
  *err = (ZpError){ZP_MACHINE, "no memory"};
  if (!scenario) return ZP_MACHINE;
  ZpStatus status = o->scenario ? zp_scenario_read(scenario, o->scenario, err) : ZP_OK;
  for (int i = 0; i < o->sets && status == ZP_OK; i++)
    status = zp_scenario_set(scenario, o->set[i], err);
  if (status == ZP_OK && (o->given & OPTION_NO_PLOTS)) status = zp_scenario_set(scenario, "output.plots=false", err);
  if (status == ZP_OK && o->budget) status = set_budget(scenario, o->budget, err);
  if (status == ZP_OK && o->templates) status = check_templates(o->templates, err);
  if (status == ZP_OK && !(o->given & OPTION_QUIET)) note_bare_numbers(scenario);
  if (!study || status != ZP_OK) return status;
  char assignment[64];
  snprintf(assignment, sizeof assignment, "study=%s", study);
  return zp_scenario_set(scenario, assignment, err);
}

/* Write and print a report => EXIT_DONE or why not. */
static int write_report(const ZpReport *what, const Options *o) {
  ZpError err;
  Progress silent = {0};
  const ZpHooks hooks = cli_hooks(&silent);
  ZpReport report = *what;
  report.hooks = &hooks;
  report.jobs = o->jobs;
  report.templates = o->templates;
  if (cli_interrupted()) cli_watch_interrupts(); /* finished results are still drawn, unless Ctrl-C comes again */
  if (zp_report_write(&report, (o->given & OPTION_QUIET) ? NULL : cli_notice, &err) != ZP_OK) return cli_fail(&err);
  if (o->given & OPTION_JSON) {
    if (zp_summary_write(&report, stdout, &err) != ZP_OK) return ferror(stdout) ? EXIT_MACHINE : cli_fail(&err);
  } else if (!(o->given & OPTION_QUIET)) {
    summary_print(&report, !(o->given & OPTION_NO_PLOTS));
  }
  return EXIT_DONE;
}

/* The exit status of a report with `status`; an interrupt while pictures were drawn counts, too. */
static int exit_status(int status, bool interrupted, bool good) {
  if (status != EXIT_DONE) return status;
  if (interrupted || cli_interrupted()) return EXIT_INTERRUPTED;
  return good ? EXIT_DONE : EXIT_NUMERICS;
}

static Progress begin_progress(const Options *o) {
  cli_watch_interrupts();
  return (Progress){.shown = !(o->given & OPTION_QUIET) && isatty(STDERR_FILENO), .start = cli_wall_clock(NULL)};
}

/* -- one case --------------------------------------------------------------------------------------- */

static int run_one(const ZpScenario *scenario, const Options *o, const char *directory, const ZpFolder *folder) {
  ZpError err;
  ZpActuatorDef *def = zp_def_create();
  ZpResult *result = NULL;
  Progress progress = begin_progress(o);
  const ZpHooks hooks = cli_hooks(&progress);
  ZpStatus status = zp_scenario_def(scenario, 0, def, &err);
  if (status == ZP_OK) status = zp_data_study_run(zp_scenario_study(scenario), def, &hooks, &result, &err);
  zp_def_destroy(def);
  cli_progress_end(&progress);
  if (status != ZP_OK) return cli_fail(&err);
  const ZpReport report = {.directory = directory,
                           .scenario = scenario,
                           .result = &result,
                           .count = 1,
                           .wall_time = cli_wall_clock(NULL) - progress.start,
                           .folder = folder};
  const bool interrupted = zp_result_outcome(result) == ZP_INTERRUPTED;
  int code = exit_status(write_report(&report, o), interrupted, zp_outcome_good(zp_result_outcome(result)));
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
                             .resume = o->given & OPTION_RESUME,
                             .user = progress,
                             .progress = on_campaign,
                             .clock = cli_wall_clock,
                             .remote = o->crew ? o->crew->compute : NULL,
                             .remote_user = o->crew ? o->crew->user : NULL};
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
  if (state.resumed > 0 && !(o->given & OPTION_QUIET))
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
  options.remote = NULL; /* each case depends on earlier ones */
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
  ZpScenario *scenario;
  const char *directory = o->directory ? o->directory : "out/optimize";
  ZpStatus status = cli_read_scenario(NULL, o, &scenario, &err);
  if (status == ZP_OK) status = zp_folder_open(directory, &folder, &err);
  int code = status == ZP_OK ? optimize_in_folder(scenario, o, directory, folder) : cli_fail(&err);
  if (status == ZP_OK) zp_folder_close(folder);
  zp_scenario_destroy(scenario);
  return code;
}

/* -- a scenario ------------------------------------------------------------------------------------- */

/* Hold the folder for the duration of the runs and their report. */
static int run_in_folder(const ZpScenario *scenario, const Options *o) {
  ZpError err;
  ZpFolder *folder;
  size_t lists;
  char own[64];
  snprintf(own, sizeof own, "out/%s", zp_study_name(zp_scenario_study(scenario)));
  const char *directory = o->directory ? o->directory : own;
  zp_scenario_lists(scenario, &lists);
  if ((o->given & OPTION_RESUME) && lists == 0)
    return cli_fail(&(ZpError){ZP_BAD_INPUT, "--resume continues a sweep; the scenario has no list of values"});
  if (zp_folder_open(directory, &folder, &err) != ZP_OK) return cli_fail(&err);
  int code = lists > 0 ? run_many(scenario, o, directory, folder) : run_one(scenario, o, directory, folder);
  zp_folder_close(folder);
  return code;
}

int cli_study(const char *study, const Options *o) {
  ZpError err;
  ZpScenario *scenario;
  ZpStatus status = cli_read_scenario(study, o, &scenario, &err);
  if (status == ZP_OK) status = zp_batch_check_jobs(scenario, o->jobs, &err);
  int exit_code = status == ZP_OK ? run_in_folder(scenario, o) : cli_fail(&err);
  zp_scenario_destroy(scenario);
  return exit_code;
}
