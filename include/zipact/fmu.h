/* An actuator as an FMU: a file that Simulink, OpenModelica, FMPy and other tools simulate, by the Functional Mock-up
 * Interface. docs/fmu.md says how. */
#ifndef ZIPACT_FMU_H
#define ZIPACT_FMU_H

#include <zipact/api.h>
#include <zipact/io.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Write the single case of `scenario` as an FMU for co-simulation to `path`, by FMI `version`, 2 or 3. `kit` is the
 * folder of binaries and sources for FMUs: zipact/fmu in the folder of the libraries, or fmu in the build. The same
 * scenario and kit give the same bytes. ZP_BAD_INPUT if the scenario has lists, starts from a checkpoint, or cannot be
 * simulated; ZP_MACHINE if there is no kit or the file cannot be written. */
ZP_API ZpStatus zp_fmu_write(const ZpScenario *scenario, int version, const char *kit, const char *path, ZpError *err);

#ifdef __cplusplus
}
#endif

#endif
