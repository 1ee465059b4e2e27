/* zipact fmu. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <zipact/fmu.h>

#include "cli.h"

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
