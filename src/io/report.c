/* A report: all files that a study leaves in its folder, written in an order that keeps a promise.
 *
 * summary.json goes first when old results are replaced and comes after all other numbers when new ones are written,
 * so where it stands the numbers are complete. Pictures come last: another program draws them. */
#include "io/report.h"

#include <locale.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "io/atomic.h"

bool zp_report_is_sweep(const ZpReport *report) {
  size_t lists = 0;
  zp_scenario_lists(report->scenario, &lists);
  return lists > 0 || report->count > 1;
}

const ZpResult *zp_report_single(const ZpReport *report) {
  return report->count > 0 && !zp_report_is_sweep(report) ? report->result[0] : NULL;
}

const char *zp_report_study(const ZpReport *report) {
  ZpActuatorDef def;
  int key = zp_key_find("study");
  if (report->count > 0) return zp_key_word(key, report->result[0]->study);
  return zp_scenario_def(report->scenario, 0, &def, NULL) == ZP_OK ? zp_key_word(key, def.study) : "none";
}

static bool is_listed(const ZpScalarNames *names, const char *name) {
  for (size_t i = 0; i < names->count; i++)
    if (strcmp(names->item[i].name, name) == 0) return true;
  return false;
}

static bool add_scalars(ZpScalarNames *names, const ZpResult *result, bool timing) {
  ZpScalar *item = realloc(names->item, (names->count + result->scalars + 1) * sizeof *item);
  if (!item) return false;
  names->item = item;
  for (size_t i = 0; i < result->scalars; i++) {
    const ZpScalar *scalar = &result->scalar[i];
    if ((timing || !scalar->timing) && !is_listed(names, scalar->name)) item[names->count++] = *scalar;
  }
  return true;
}

bool zp_report_scalars(const ZpReport *report, bool timing, ZpScalarNames *names) {
  *names = (ZpScalarNames){0};
  for (size_t i = 0; i < report->count; i++)
    if (!add_scalars(names, report->result[i], timing)) {
      free(names->item);
      *names = (ZpScalarNames){0};
      return false;
    }
  return true;
}

size_t zp_result_numbers(const ZpResult *result) {
  size_t numbers = 0;
  if (result->series) numbers += result->series->rows * result->series->columns;
  if (result->shapes) numbers += result->shapes->frames * result->shapes->frame_size;
  if (result->map) numbers += 5 * result->map->nx * result->map->ny;
  return numbers;
}

/* As measured of HDF5, which takes most: it keeps what it has freed up to 32 MB; of a run the places of its columns,
 * and all numbers, are in memory twice, as the file and as its copy. */
size_t zp_report_room(size_t runs, size_t numbers) {
  const size_t base = 1 << 23, kept = 1 << 25, kept_of_run = 340000, places_of_run = 60000;
  return base + (runs < kept / kept_of_run ? runs * kept_of_run : kept) + runs * places_of_run +
         3 * sizeof(double) * numbers;
}

void zp_key_column(int key, char *text, size_t size) {
  const ZpKey *k = zp_key(key);
  bool bare = strcmp(k->unit, "1") == 0;
  size_t used = (size_t)snprintf(text, size, "%s%s", k->name, bare ? "" : "_");
  for (const char *c = k->unit; !bare && *c && used + 6 < size; c++) {
    const char part[2] = {*c == ' ' ? '_' : *c, 0};
    used += (size_t)snprintf(text + used, size - used, "%s", *c == '/' ? "_per_" : part);
  }
}

const char *zp_key_word(int key, double value) {
  const ZpKey *k = zp_key(key);
  if (k->type == ZP_KEY_BOOL) return value != 0 ? "true" : "false";
  return k->type == ZP_KEY_ENUM ? k->choices[(int)value].word : NULL;
}

ZpStatus zp_scenario_text(const ZpReport *report, char **text, ZpError *err) {
  size_t size = 0;
  *text = NULL;
  FILE *file = open_memstream(text, &size);
  if (!file) return zp_fail_memory(err);
  ZpStatus status = zp_scenario_write(report->scenario, file, err);
  if (fclose(file) != 0 && status == ZP_OK) status = zp_fail_memory(err);
  if (status != ZP_OK) {
    free(*text);
    *text = NULL;
  }
  return status;
}

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
