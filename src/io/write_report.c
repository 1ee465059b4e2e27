/* A report: all files that a study leaves in its folder, written in an order that keeps a promise.
 *
 * summary.json goes first when old results are replaced and comes after all other numbers when new ones are written,
 * so where it stands the numbers are complete. Pictures come last: another program draws them. */
#include <locale.h>
#include <stdlib.h>

#include "base/fail.h"
#include "io/atomic.h"
#include "io/report.h"
#include "io/writers.h"

static ZpStatus write_scenario(const ZpReport *report, ZpError *err) {
  ZpAtomic out;
  char *text;
  ZpStatus status = zp_scenario_text(report, &text, err);
  if (status == ZP_OK) status = zp_atomic_open(&out, report->directory, "scenario.yaml", err);
  if (status == ZP_OK) {
    fputs(text, out.file); /* the commit finds what goes wrong here */
    status = zp_atomic_commit(&out, err);
  }
  free(text);
  return status;
}

static ZpStatus write_summary(const ZpReport *report, ZpError *err) {
  ZpAtomic out;
  ZpStatus status = zp_atomic_open(&out, report->directory, "summary.json", err);
  return status == ZP_OK ? zp_atomic_finish(&out, zp_summary_write(report, out.file, err), err) : status;
}

static ZpStatus write_all(const ZpReport *report, void (*notice)(const char *message), ZpError *err) {
  ZpStatus status = zp_remove_file(report->directory, "summary.json", err);
  if (status == ZP_OK) status = write_scenario(report, err);
  if (status == ZP_OK) status = zp_csv_write(report, err);
  if (status == ZP_OK) status = zp_hdf5_write(report, err);
  if (status == ZP_OK) status = zp_vtk_write(report, err);
  if (status == ZP_OK) status = zp_checkpoint_report(report, err);
  if (status == ZP_OK) status = zp_plots_prepare(report, err);
  if (status == ZP_OK) status = write_summary(report, err);
  if (status == ZP_OK) zp_plots_write(report, notice);
  return status;
}

/* The caller's locale may write 0.5 as 0,5: files must not. */
static ZpStatus write_plainly(const ZpReport *report, void (*notice)(const char *message), ZpError *err) {
  locale_t plain = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
  if (!plain) return zp_fail_memory(err);
  locale_t before = uselocale(plain);
  ZpStatus status = write_all(report, notice, err);
  uselocale(before);
  freelocale(plain);
  return status;
}

ZpStatus zp_report_write(const ZpReport *report, void (*notice)(const char *message), ZpError *err) {
  ZpFolder *own = NULL;
  ZpStatus status = report->folder ? ZP_OK : zp_folder_open(report->directory, &own, err);
  if (status == ZP_OK) status = write_plainly(report, notice, err);
  zp_folder_close(own);
  return status;
}
