/* Checkpoints as files: checkpoint.zps holds the bytes of a snapshot (run/snapshot.c). */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/fail.h"
#include "def/check.h"
#include "io/file.h"
#include "io/report.h"
#include "study/result.h"

/* -- out ------------------------------------------------------------------------------------------- */

ZpStatus zp_checkpoint_write(const ZpCheckpoint *checkpoint, FILE *file, ZpError *err) {
  bool written = fwrite(checkpoint->byte, 1, checkpoint->size, file) == checkpoint->size && fflush(file) == 0;
  return written ? ZP_OK : zp_fail(err, ZP_MACHINE, "the checkpoint cannot be written: %s", strerror(errno));
}

static const char name[] = "checkpoint.zps";

/* Did the runs of the report start from the checkpoint in the same folder? */
static bool began_there(const ZpReport *report) {
  ZpActuatorDef def = {0};
  struct stat there, start;
  char *path = zp_path_join(report->directory, name);
  bool same = path && zp_scenario_def(report->scenario, 0, &def, NULL) == ZP_OK &&
              stat(def.initial.file, &start) == 0 && stat(path, &there) == 0 && start.st_dev == there.st_dev &&
              start.st_ino == there.st_ino;
  zp_def_clear(&def);
  free(path);
  return same;
}

/* A report without a checkpoint removes that of an earlier report, unless its own runs started from it. */
ZpStatus zp_checkpoint_report(const ZpReport *report, ZpError *err) {
  const ZpResult *result = zp_report_single(report);
  if (!result || !result->checkpoint) return began_there(report) ? ZP_OK : zp_remove_file(report->directory, name, err);
  ZpAtomic out;
  ZpStatus status = zp_atomic_open(&out, report->directory, name, err);
  return status == ZP_OK ? zp_atomic_finish(&out, zp_checkpoint_write(result->checkpoint, out.file, err), err) : status;
}

/* -- in -------------------------------------------------------------------------------------------- */

static const size_t largest = (size_t)1 << 31; /* bytes: larger than any snapshot */

ZpStatus zp_checkpoint_read(const char *path, ZpCheckpoint **out, ZpError *err) {
  char *byte;
  size_t size;
  ZpError reason;
  *out = NULL;
  ZpStatus status = zp_file_read(path, largest, &byte, &size, err);
  if (status != ZP_OK) return status;
  status = zp_checkpoint_from(byte, size, out, &reason);
  free(byte);
  return status == ZP_OK ? ZP_OK : zp_fail(err, status, "%.300s: %.180s", path, reason.message);
}
