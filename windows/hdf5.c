/* Instead of src/io/hdf5.c: on Windows there is no results.h5. */
#include "io/file.h"
#include "io/report.h"

ZpStatus zp_hdf5_write(const ZpReport *report, ZpError *err) {
  return zp_remove_file(report->directory, "results.h5", err);
}

ZpStatus zp_hdf5_skip_exit(ZpError *err) {
  (void)err;
  return ZP_OK;
}
