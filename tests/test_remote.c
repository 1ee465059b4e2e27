/* Campaigns whose cases are computed elsewhere: here by the same process, through the bytes that travel. */
#include "data_util.h"

#include <sys/stat.h>
#include <unistd.h>

#include <zipact/campaign.h>

enum { JOBS = 3 };

/* What stands for other processes. */
typedef struct Elsewhere {
  const ZpScenario *scenario;
  bool lost[JOBS]; /* process k answers no more */
  bool garbled;    /* what comes back is cut short */
} Elsewhere;

static ZpStatus remote(void *user, size_t worker, size_t from, size_t to, unsigned char **byte, size_t *size,
                       ZpError *err) {
  const Elsewhere *elsewhere = user;
  *byte = NULL;
  if (elsewhere->lost[worker]) return ZP_OK;
  ZpStatus status = zp_campaign_compute(elsewhere->scenario, from, to, NULL, byte, size, err);
  if (elsewhere->garbled) *size /= 2;
  return status;
}

static ZpScenario *sweep(void) {
  return scenario_with((const char *const[]){"study=limits", "load.mass=2 g .. 20 g : 10",
                                             "ribbon.thickness=[50 um, 60 um]", "mesh.nodes=21", "output.errors=false",
                                             NULL});
}

/* Run it => status; *sum: of all pull-in voltages and largest loads, exact, and the rows that there are. */
static ZpStatus run(const ZpScenario *scenario, Elsewhere *elsewhere, double *sum, size_t *rows, ZpError *err) {
  ZpCampaign *campaign;
  const char *folder = elsewhere ? "remote" : "local";
  const ZpCampaignOptions options = {
      .jobs = JOBS, .remote = elsewhere ? remote : NULL, .remote_user = elsewhere, .resume = true};
  mkdir(folder, 0777);
  char path[64];
  snprintf(path, sizeof path, "%s/journal.sqlite", folder);
  unlink(path);
  ck_assert_int_eq(zp_campaign_open(scenario, folder, &options, &campaign, err), ZP_OK);
  ZpStatus status = zp_campaign_run(campaign, err);
  const ZpRows *all = zp_campaign_rows(campaign);
  *rows = zp_campaign_count(campaign);
  *sum = 0;
  for (size_t i = 0; i < *rows; i++) {
    const ZpResult *result = all->get(all->user, i);
    const double voltage = zp_result_get(result, "pull_in_voltage_V");
    *sum += (isnan(voltage) ? 0 : voltage) + (double)(i + 1) * zp_result_get(result, "max_load_kg");
  }
  zp_campaign_close(campaign);
  return status;
}

static void same_as_here(Elsewhere *elsewhere) {
  ZpScenario *scenario = sweep();
  ZpError err;
  double here, there;
  size_t rows, all = zp_scenario_count(scenario);
  elsewhere->scenario = scenario;
  ck_assert_int_eq(run(scenario, NULL, &here, &rows, &err), ZP_OK);
  ck_assert_uint_eq(rows, all);
  ck_ok(run(scenario, elsewhere, &there, &rows, &err));
  ck_assert_uint_eq(rows, all);
  ck_assert_double_eq(here, there);
}

TEST(cases_computed_elsewhere_are_the_same) {
  same_as_here(&(Elsewhere){0});
}

/* Others take the cases of a process that is lost. */
TEST(a_lost_process_costs_no_case) {
  same_as_here(&(Elsewhere){.lost = {[1] = true}});
}

TEST(all_processes_lost_is_an_error) {
  ZpScenario *scenario = sweep();
  double sum;
  size_t rows;
  Elsewhere elsewhere = {.scenario = scenario, .lost = {true, true, true}};
  ck_says(run(scenario, &elsewhere, &sum, &rows, &err), ZP_MACHINE, "--resume");
  ck_assert_uint_eq(rows, 0);
}

TEST(garbled_results_are_an_error) {
  ZpScenario *scenario = sweep();
  double sum;
  size_t rows;
  Elsewhere elsewhere = {.scenario = scenario, .garbled = true};
  ck_says(run(scenario, &elsewhere, &sum, &rows, &err), ZP_MACHINE, "cannot be read");
}

/* Whole results, but of another study. */
TEST(results_of_another_study_are_an_error) {
  ZpScenario *scenario = sweep(), *other = sweep();
  ZpError err;
  double sum;
  size_t rows;
  Elsewhere elsewhere = {.scenario = other};
  ck_assert_int_eq(zp_scenario_set(other, "study=stationary", &err), ZP_OK);
  ck_says(run(scenario, &elsewhere, &sum, &rows, &err), ZP_MACHINE, "cannot be read");
}
