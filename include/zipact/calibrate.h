/* Studies with data: calibrate fits keys to measurements, stationary compares with a reference curve, actuate follows a
 * table of voltages. Part of the io library; needs NLopt. */
#ifndef ZIPACT_CALIBRATE_H
#define ZIPACT_CALIBRATE_H

#include <zipact/api.h>
#include <zipact/study.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Read and check the data of data.file, drive.table, drive.file and the keys of group calibrate, if `study` uses them.
 * ZP_BAD_INPUT names file, line, column and text, or the key. */
ZP_API ZpStatus zp_data_check(ZpStudy study, const ZpActuatorDef *def, ZpError *err);

/* A model and a simulation of it, both to be freed by the caller, for every Def, also with drive.waveform table and
 * initial.state checkpoint. NULL on failure. */
ZP_API ZpStatus zp_data_sim_create(const ZpActuatorDef *def, const ZpHooks *hooks, ZpModel **model, ZpSim **sim,
                                   ZpError *err);

/* As zp_study_run, for every study: also calibrate, stationary with area_error_m2 if there is a data.file, and actuate
 * with drive.waveform table. */
ZP_API ZpStatus zp_data_study_run(ZpStudy study, const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult **result,
                                  ZpError *err);

/* As zp_study_run, within solver.max_cpu_time, which zp_data_study_run respects, too: the core itself has no clock. The
 * limit acts where `hooks` are asked, so a run may take somewhat longer. */
ZP_API ZpStatus zp_study_run_limited(ZpStudy study, const ZpActuatorDef *def, const ZpStudyInput *input,
                                     const ZpHooks *hooks, ZpResult **result, ZpError *err);

#ifdef __cplusplus
}
#endif

#endif
