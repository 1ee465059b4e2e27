/* Studies and their files: reads the files that each study of studies.def requires, for all studies. */
#include <zipact/calibrate.h>
#include <zipact/io.h>

#include "base/fail.h"
#include "def/def.h"
#include "fit/data.h"
#include "fit/fit.h"
#include "fit/plan.h"
#include "fit/reference.h"
#include "fit/time_limit.h"
#include "io/drive_table.h"
#include "io/fitted.h"

/* Each function reads the files of a definition and, unless `result` is NULL, runs the study with them. */

/* -- none ------------------------------------------------------------------------------------------- */

static ZpStatus with_none(ZpStudy study, const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult **result,
                          ZpError *err) {
  return result ? zp_study_run(study, def, NULL, hooks, result, err) : ZP_OK;
}

/* -- course: a table of voltages or setpoints, a checkpoint ------------------------------------------------------- */

typedef struct Files {
  ZpDriveRows rows;
  ZpDriveTable table;
  ZpCheckpoint *start;
  ZpStudyInput input; /* the same in the form that the study takes */
} Files;

static void close_files(Files *files) {
  zp_drive_rows_free(&files->rows);
  zp_checkpoint_destroy(files->start);
}

static ZpStatus read_checkpoint(const ZpActuatorDef *def, ZpCheckpoint **start, ZpError *err) {
  ZpError reason;
  if (!*def->initial.file) return zp_fail(err, ZP_BAD_INPUT, "initial.state = checkpoint: requires initial.file");
  ZpStatus status = zp_checkpoint_read(def->initial.file, start, &reason);
  if (status != ZP_OK) return zp_fail(err, status, "initial.file: %.450s", reason.message);
  status = zp_checkpoint_check(*start, def, &reason);
  return status == ZP_OK ? ZP_OK
                         : zp_fail(err, status, "initial.file: %.300s: %.180s", def->initial.file, reason.message);
}

/* To be closed whatever the status is. */
static ZpStatus open_files(const ZpActuatorDef *def, Files *files, ZpError *err) {
  ZpStatus status = ZP_OK;
  *files = (Files){0};
  if (zp_def_takes_table(def)) {
    status = zp_drive_rows_read(def, &files->rows, err);
    files->table = zp_drive_rows_table(&files->rows);
    files->input.table = &files->table;
  }
  if (status == ZP_OK && def->initial.state == ZP_INITIAL_CHECKPOINT) {
    status = read_checkpoint(def, &files->start, err);
    files->input.start = files->start;
  }
  return status;
}

static ZpStatus with_course(ZpStudy study, const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult **result,
                            ZpError *err) {
  Files files;
  ZpStatus status = open_files(def, &files, err);
  if (status == ZP_OK && result) status = zp_study_run(study, def, &files.input, hooks, result, err);
  close_files(&files);
  return status;
}

static ZpStatus create_from_files(const ZpActuatorDef *def, const ZpHooks *hooks, ZpModel **model, ZpSim **sim,
                                  ZpError *err) {
  Files files;
  ZpStatus status = open_files(def, &files, err);
  if (status == ZP_OK) status = zp_model_create_driven(def, files.input.table, model, err);
  if (status == ZP_OK) status = zp_sim_create(*model, hooks, sim, err);
  if (status == ZP_OK && files.start) status = zp_sim_continue(*sim, files.start, err);
  close_files(&files);
  return status;
}

ZpStatus zp_data_sim_create(const ZpActuatorDef *def, const ZpHooks *hooks, ZpModel **model, ZpSim **sim,
                            ZpError *err) {
  *model = NULL;
  *sim = NULL;
  ZpStatus status = create_from_files(def, hooks, model, sim, err);
  if (status == ZP_OK) return ZP_OK;
  zp_sim_destroy(*sim);
  zp_model_destroy(*model);
  *model = NULL;
  *sim = NULL;
  return status;
}

/* -- reference: a curve to compare with -------------------------------------------------------------- */

static ZpStatus with_reference(ZpStudy study, const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult **result,
                               ZpError *err) {
  ZpReference reference;
  if (*def->data.file == 0) return with_none(study, def, hooks, result, err);
  ZpStatus status = zp_reference_read(def->data.file, &reference, err);
  if (status == ZP_OK && result) {
    status = zp_study_run(study, def, NULL, hooks, result, err);
    if (status == ZP_OK)
      zp_result_add(*result, "area_error_m2", "m2", zp_reference_area(&reference, (*result)->series));
  }
  zp_reference_free(&reference);
  return status;
}

/* -- measurements: what keys are fitted to ----------------------------------------------------------- */

static ZpStatus with_measurements(ZpStudy study, const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult **result,
                                  ZpError *err) {
  (void)study;
  return zp_fit_run(def, hooks, result, err);
}

/* -- candidates: measurements that could be made ------------------------------------------------------ */

static ZpStatus with_candidates(ZpStudy study, const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult **result,
                                ZpError *err) {
  (void)study;
  return zp_plan_run(def, hooks, result, err);
}

/* -- which study takes which ------------------------------------------------------------------------- */

typedef ZpStatus (*WithFiles)(ZpStudy study, const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult **result,
                              ZpError *err);

static const WithFiles with_files[ZpStudy_COUNT] = {
#define ZP_STUDY(enumerator, word, shows, files, help) [enumerator] = with_##files,
#include <zipact/studies.def>
};

ZpStatus zp_data_check_files(ZpStudy study, const ZpActuatorDef *def, ZpError *err) {
  return with_files[study](study, def, NULL, NULL, err);
}

ZpStatus zp_data_check(ZpStudy study, const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = zp_study_check(study, def, err);
  return status == ZP_OK ? zp_data_check_files(study, def, err) : status;
}

/* Can a study with a valid Def run without files? */
static bool needs_no_file(ZpStudy study, const ZpActuatorDef *def) {
  const bool known = (int)study >= 0 && (int)study < ZpStudy_COUNT && def;
  return known && with_files[study] != with_measurements && with_files[study] != with_candidates &&
         *def->data.file == 0 && !zp_def_takes_table(def) && def->initial.state != ZP_INITIAL_CHECKPOINT;
}

ZpStatus zp_base_note(ZpStatus status, const ZpActuatorDef *def, ZpResult **result, ZpError *err) {
  ZpFitted fitted;
  if (status != ZP_OK || *def->base.file == 0) return status;
  status = zp_fitted_read(def->base.file, &fitted, err);
  if (status == ZP_OK) {
    zp_fitted_note(&fitted, def->base.file, def->sampling.tolerances == ZP_TOLERANCES_BASE, *result);
    return ZP_OK;
  }
  zp_result_destroy(*result);
  *result = NULL;
  return status;
}

/* Wrong keys are reported before their files are read; a missing file is reported by the study. */
ZpStatus zp_data_study_run(ZpStudy study, const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult **result,
                           ZpError *err) {
  *result = NULL;
  ZpStatus status = needs_no_file(study, def) ? ZP_OK : zp_study_check(study, def, err);
  if (status != ZP_OK) return status;
  ZpTimeLimit limit;
  status = with_files[study](study, def, zp_time_limit_begin(&limit, def, hooks), result, err);
  if (status == ZP_OK) zp_time_limit_end(&limit, *result);
  return zp_base_note(status, def, result, err);
}
