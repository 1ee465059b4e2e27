/* A report: all files that a study writes to its folder, in an order that guarantees completeness.
 *
 * summary.json is removed first when old results are replaced, and written after all other numbers: if it exists, the
 * numbers are complete. Pictures are last, because another program draws them.
 *
 * Three files contain all rows of a campaign: separate threads write them, each with its own reader of the rows, so
 * that neither their bytes nor the memory depend on the number of threads. */
#include <locale.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "base/fail.h"
#include "io/file.h"
#include "io/report.h"

/* The files with all rows or values, the slowest first. */
enum { SUMMARY, RESULTS, TABLE, SCENARIO, FILES };

typedef struct Files {
  const ZpReport *report;
  locale_t plain;
  ZpAtomic summary;    /* under its temporary name */
  _Atomic size_t next; /* the first file without a writer */
  ZpStatus status[FILES];
  ZpError err[FILES];
} Files;

/* A thread that writes some of them. */
typedef struct Writer {
  Files *files;
  ZpRows own; /* its reader */
  pthread_t thread;
} Writer;

/* Write everything; the file gets its name last. */
static ZpStatus write_summary(const ZpReport *report, ZpAtomic *summary, ZpError *err) {
  ZpStatus status = zp_atomic_open(summary, report->directory, "summary.json", err);
  if (status != ZP_OK) return status;
  status = zp_summary_write(report, summary->file, err);
  return status == ZP_OK ? ZP_OK : zp_atomic_finish(summary, status, err);
}

static ZpStatus write_file(Files *files, size_t file, const ZpReport *report, ZpError *err) {
  ZpAtomic out;
  if (file == SUMMARY) return write_summary(report, &files->summary, err);
  if (file == TABLE) return zp_csv_write(report, err);
  if (file == RESULTS) return zp_hdf5_write(report, err);
  ZpStatus status = zp_atomic_open(&out, report->directory, "scenario.yaml", err);
  return status == ZP_OK ? zp_atomic_finish(&out, zp_scenario_write(report->scenario, out.file, err), err) : status;
}

/* Write files without a writer, until one fails. */
static void write_files(Files *files, const ZpReport *report) {
  ZpStatus status = ZP_OK;
  for (size_t file; status == ZP_OK && (file = atomic_fetch_add(&files->next, 1)) < FILES;) {
    ZpError *err = &files->err[file];
    status = write_file(files, file, report, err);
    if (status == ZP_OK && report->rows) status = report->rows->status(report->rows->user, err);
    files->status[file] = status;
  }
}

static void *write_beside(void *user) {
  Writer *writer = user;
  ZpReport report = *writer->files->report;
  const locale_t before = uselocale(writer->files->plain);
  report.rows = &writer->own;
  write_files(writer->files, &report);
  uselocale(before);
  return NULL;
}

/* Start writers in addition to the thread of the caller => their number. If readers or threads are not available, fewer
 * start. */
static size_t start_writers(Files *files, Writer writer[FILES]) {
  const ZpReport *report = files->report;
  const size_t jobs = (size_t)(report->jobs > 0 ? report->jobs : zp_processors()), most = jobs < FILES ? jobs : FILES;
  size_t started = 0;
  if (!report->rows || !report->rows->open) return 0;
  for (; started + 1 < most; started++) {
    Writer *next = &writer[started];
    next->files = files;
    if (!report->rows->open(report->rows->user, &next->own)) break;
    if (pthread_create(&next->thread, NULL, write_beside, next) == 0) continue;
    next->own.close(next->own.user);
    break;
  }
  return started;
}

/* Write the files with all rows or values; summary.json does not get its name yet. Reports the first failure in their
 * order. */
static ZpStatus write_tables(const ZpReport *report, Files *files, ZpError *err) {
  Writer writer[FILES];
  const size_t writers = start_writers(files, writer);
  write_files(files, report);
  for (size_t i = 0; i < writers; i++) {
    pthread_join(writer[i].thread, NULL);
    writer[i].own.close(writer[i].own.user);
  }
  for (size_t file = 0; file < FILES; file++)
    if (files->status[file] != ZP_OK) return zp_fail(err, files->status[file], "%s", files->err[file].message);
  return ZP_OK;
}

static ZpStatus write_all(const ZpReport *report, locale_t plain, void (*notice)(const char *message), ZpError *err) {
  Files files = {.report = report, .plain = plain};
  ZpStatus status = zp_remove_file(report->directory, "summary.json", err);
  if (status == ZP_OK) status = write_tables(report, &files, err);
  if (status == ZP_OK) status = zp_vtk_write(report, err);
  if (status == ZP_OK) status = zp_checkpoint_report(report, err);
  if (status == ZP_OK) status = zp_fitted_report(report, err);
  if (status == ZP_OK) status = zp_plots_prepare(report, err);
  if (status == ZP_OK && report->rows) status = report->rows->status(report->rows->user, err);
  if (status == ZP_OK)
    status = zp_atomic_commit(&files.summary, err);
  else
    zp_atomic_abandon(&files.summary);
  if (status == ZP_OK) zp_plots_write(report, notice);
  return status;
}

ZpStatus zp_report_write(const ZpReport *report, void (*notice)(const char *message), ZpError *err) {
  ZpFolder *own = NULL;
  ZpStatus status = report->folder ? ZP_OK : zp_folder_open(report->directory, &own, err);
  /* The locale of the caller may write 0.5 as 0,5: files must not. */
  locale_t plain = status == ZP_OK ? newlocale(LC_NUMERIC_MASK, "C", (locale_t)0) : (locale_t)0;
  if (plain) {
    locale_t before = uselocale(plain);
    status = write_all(report, plain, notice, err);
    uselocale(before);
    freelocale(plain);
  } else if (status == ZP_OK) {
    status = zp_fail_memory(err);
  }
  zp_folder_close(own);
  return status;
}
