/* Small commands: zipact keys, schema, plots, fmu, reproduce. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <zipact/fmu.h>

#include "cli.h"
#include "reproduce/reproduce.h"

static int print_keys(ZpKeysFormat format) {
  ZpError err;
  return zp_keys_write(format, stdout, &err) == ZP_OK ? EXIT_DONE : cli_fail(&err);
}

int cli_keys(const Options *options) {
  const bool json = options->given & OPTION_JSON, yaml = options->given & OPTION_YAML;
  if (json && yaml) return cli_fail(&(ZpError){ZP_BAD_INPUT, "keys: give --json or --yaml, not both"});
  return print_keys(json ? ZP_KEYS_JSON : yaml ? ZP_KEYS_YAML : ZP_KEYS_TEXT);
}

int cli_schema(const Options *options) {
  (void)options;
  return print_keys(ZP_KEYS_SCHEMA);
}

/* The templates of all pictures as files. */
int cli_plots(const Options *options) {
  ZpError err;
  if (!options->directory) return cli_fail(&(ZpError){ZP_BAD_INPUT, "plots needs a folder to write to: -o FOLDER"});
  if (zp_templates_write(options->directory, &err) != ZP_OK) return cli_fail(&err);
  if (!(options->given & OPTION_QUIET))
    printf("zipact STUDY --templates %s draws with these templates\n", options->directory);
  return cli_flush(EXIT_DONE);
}

/* -- zipact fmu ------------------------------------------------------------------------------------- */

enum { PATH = 4096 };

/* The folder of the command with its final slash. False if it is unknown. */
static bool own_folder(char folder[PATH]) {
  ssize_t length = readlink("/proc/self/exe", folder, PATH - 1);
  if (length <= 0) return false;
  folder[length] = 0;
  char *slash = strrchr(folder, '/');
  if (!slash) return false;
  slash[1] = 0;
  return true;
}

/* The kit relative to the command: that of an installation, or of a build. */
static ZpStatus find_kit(char kit[2 * PATH], ZpError *err) {
  static const char *const places[] = {"fmu", ZP_FMU_KIT};
  char folder[PATH];
  for (size_t k = 0; own_folder(folder) && k < sizeof places / sizeof places[0]; k++) {
    snprintf(kit, 2 * (size_t)PATH, "%s%s", folder, places[k]);
    if (access(kit, R_OK) == 0) return ZP_OK;
  }
  *err =
      (ZpError){ZP_MACHINE, "the kit for FMUs, " ZP_FMU_KIT " relative to the folder of the command, is not installed"};
  return ZP_MACHINE;
}

int cli_fmu(const Options *options) {
  char kit[2 * PATH];
  ZpError err;
  const int version = options->fmi ? options->fmi : 3;
  if (!options->directory) return cli_fail(&(ZpError){ZP_BAD_INPUT, "fmu needs a file to write: -o FILE.fmu"});
  ZpScenario *scenario;
  ZpStatus status = cli_read_scenario("actuate", options, &scenario, &err);
  if (status == ZP_OK) status = find_kit(kit, &err);
  if (status == ZP_OK) status = zp_fmu_write(scenario, version, kit, options->directory, &err);
  zp_scenario_destroy(scenario);
  if (status != ZP_OK) return cli_fail(&err);
  if (!(options->given & OPTION_QUIET)) printf("%s: an FMU for co-simulation, FMI %d.0\n", options->directory, version);
  return EXIT_DONE;
}

/* -- the paper beside our results ------------------------------------------------------------------- */

int cli_reproduce(const Options *o) {
  const char *directory = o->directory ? o->directory : "out/reproduce";
  Progress progress = {.shown = !(o->given & OPTION_QUIET) && isatty(STDERR_FILENO)};
  ZpHooks hooks = cli_hooks(&progress);
  ZpOutcome outcome;
  ZpError err;
  cli_watch_interrupts();
  ZpStatus status = zp_reproduce(directory, &hooks, (o->given & OPTION_QUIET) ? NULL : cli_notice,
                                 (o->given & OPTION_JSON) ? stdout : NULL, &outcome, &err);
  cli_progress_end(&progress);
  if (status != ZP_OK) return cli_fail(&err);
  if (!(o->given & OPTION_JSON) && !(o->given & OPTION_QUIET))
    printf("report: %s/report.html (data beside it)\n", directory);
  if (outcome == ZP_INTERRUPTED) return EXIT_INTERRUPTED;
  return zp_outcome_good(outcome) ? EXIT_DONE : EXIT_NUMERICS;
}
