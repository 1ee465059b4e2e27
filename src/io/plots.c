/* plots/: each picture with the gnuplot script that drew it and the data it was drawn from, so that
 * `gnuplot NAME.gp` there makes the same picture again.
 *
 * A picture is worth less than the numbers: these are on the disk before gnuplot runs. Without gnuplot, or where it
 * fails or hangs, the scripts stay and a notice says so. Pictures of an earlier report are removed first, so none
 * shows what is not in the table. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/fail.h"
#include "io/atomic.h"
#include "io/gnuplot.h"
#include "io/plot.h"
#include "io/report.h"
#include "io/writers.h"

/* Longest file name of a picture. */
#define NAME_SIZE 64

static void say(const ZpDrawing *drawing, const char *name, const char *reason) {
  char message[1024];
  const char *more = drawing->over ? "; the rest are not drawn either; their scripts are there" : "";
  snprintf(message, sizeof message, "%s/%s was not drawn: %s%s", drawing->folder, name, reason, more);
  if (drawing->notice) drawing->notice(message);
}

static void say_missing(const ZpDrawing *drawing) {
  char message[1024];
  snprintf(message, sizeof message, "gnuplot was not found: pictures are not drawn; their scripts are %s/*.gp",
           drawing->folder);
  if (drawing->notice) drawing->notice(message);
}

/* gnuplot does not tell of a full disk, so look whether the file has its end: </svg>, or ; of a GIF. */
static bool is_complete(const char *path, const char *extension) {
  const char *end = strcmp(extension, "svg") == 0 ? "</svg>" : ";";
  char tail[32] = {0};
  FILE *file = fopen(path, "re");
  if (!file) return false;
  bool found = fseek(file, -(long)strlen(end) - 3, SEEK_END) == 0;
  size_t got = found ? fread(tail, 1, sizeof tail - 1, file) : 0;
  fclose(file);
  return got > 0 && memmem(tail, got, end, strlen(end)) != NULL;
}

static ZpStatus write_text(const ZpDrawing *drawing, const ZpPicture *picture, const char *extension,
                           void (*write)(const ZpPlot *plot, FILE *file), ZpError *err) {
  ZpAtomic out;
  char name[NAME_SIZE];
  snprintf(name, sizeof name, "%s.%s", picture->name, extension);
  if (!write) return ZP_OK;
  ZpStatus status = zp_atomic_open(&out, drawing->folder, name, err);
  if (status != ZP_OK) return status;
  write(drawing->plot, out.file);
  return zp_atomic_commit(&out, err);
}

/* Run the script of a picture. From then on no more are tried where gnuplot can draw none. */
static ZpGnuplot run_script(ZpDrawing *drawing, const ZpPicture *picture, const char *output, char *reason,
                            size_t size) {
  char script[NAME_SIZE];
  snprintf(script, sizeof script, "%s.gp", picture->name);
  const ZpGnuplotJob job = {drawing->folder, script, output, drawing->patience, drawing->hooks};
  ZpGnuplot end = zp_gnuplot_run(&job, reason, size);
  drawing->over = end != ZP_GNUPLOT_DONE && end != ZP_GNUPLOT_FAILED;
  return end;
}

static void draw(ZpDrawing *drawing, const ZpPicture *picture) {
  ZpAtomic out;
  ZpError err;
  char name[NAME_SIZE], reason[256];
  snprintf(name, sizeof name, "%s.%s", picture->name, picture->extension);
  if (zp_atomic_reserve(&out, drawing->folder, name, &err) != ZP_OK) {
    say(drawing, name, err.message);
    return;
  }
  ZpGnuplot end = run_script(drawing, picture, strrchr(out.temporary, '/') + 1, reason, sizeof reason);
  if (end == ZP_GNUPLOT_DONE && is_complete(out.temporary, picture->extension)) {
    if (zp_atomic_commit(&out, &err) != ZP_OK) say(drawing, name, err.message);
    return;
  }
  zp_atomic_abandon(&out);
  if (end == ZP_GNUPLOT_MISSING)
    say_missing(drawing);
  else
    say(drawing, name, reason);
}

static ZpStatus remove_picture(const ZpDrawing *drawing, const ZpPicture *picture, ZpError *err) {
  const char *const extension[] = {"gp", "dat", picture->extension};
  ZpStatus status = ZP_OK;
  for (size_t i = 0; i < 3 && status == ZP_OK; i++) {
    char name[NAME_SIZE];
    snprintf(name, sizeof name, "%s.%s", picture->name, extension[i]);
    status = zp_remove_file(drawing->folder, name, err);
  }
  return status;
}

static ZpStatus prepare_picture(const ZpDrawing *drawing, const ZpPicture *picture, ZpError *err) {
  if (!picture->has(drawing->plot)) return ZP_OK;
  ZpStatus status = write_text(drawing, picture, "gp", picture->script, err);
  return status == ZP_OK ? write_text(drawing, picture, "dat", picture->data, err) : status;
}

/* Add "name value" to the subtitle unless the key is swept: then the legend tells. */
static void add_key(ZpPlot *plot, const char *name, const char *before) {
  size_t keys, used = strlen(plot->subtitle);
  const int key = zp_key_find(name), *list = zp_scenario_lists(plot->report->scenario, &keys);
  char value[64];
  for (size_t i = 0; i < keys; i++)
    if (list[i] == key) return;
  zp_value_print(key, zp_def_get(&plot->def, key), value, sizeof value);
  snprintf(plot->subtitle + used, sizeof plot->subtitle - used, "%s%s%s", used ? ", " : "", before, value);
}

/* "8 kV", "ramp to 8 kV"; of a table only that it is one. */
static void add_drive(ZpPlot *plot) {
  static const char *const before[ZpWaveformKind_COUNT] = {"", "ramp to ", "sine to ", "square wave to ", NULL};
  const char *words = before[plot->def.drive.waveform];
  size_t used = strlen(plot->subtitle);
  if (words)
    add_key(plot, "drive.voltage", words);
  else
    snprintf(plot->subtitle + used, sizeof plot->subtitle - used, "%stable of voltages", used ? ", " : "");
}

typedef struct Subtitle {
  ZpStudy study;
  const char *key, *alone, *swept;
} Subtitle;

static const Subtitle subtitles[] = {
#define ZP_SUBTITLE(enumerator, key, alone, swept) {enumerator, key, alone, swept},
#include <zipact/studies.def>
};

/* A single ribbon has no voltage. */
static void add_subtitle(ZpPlot *plot, const Subtitle *s) {
  if (plot->def.actuator.kind == ZP_KIND_RIBBON && strncmp(s->key, "drive.", 6) == 0) return;
  if (s->alone)
    add_key(plot, s->key, plot->single ? s->alone : s->swept);
  else
    add_drive(plot);
}

/* (report) => what there is to draw; of a report without runs, nothing. */
static ZpStatus look_at(const ZpReport *report, ZpPlot *plot, ZpError *err) {
  *plot = (ZpPlot){.report = report, .single = zp_report_single(report)};
  if (report->count == 0) return ZP_OK;
  ZpStatus status = zp_scenario_def(report->scenario, 0, &plot->def, err);
  if (status != ZP_OK) return status;
  plot->study = report->result[0]->study;
  plot->shows = zp_study_shows(plot->study);
  for (size_t k = 0; k < sizeof subtitles / sizeof subtitles[0]; k++)
    if (subtitles[k].study == plot->study) add_subtitle(plot, &subtitles[k]);
  if (plot->shows != ZP_SHOWS_field || plot->def.profile.shape == ZP_PROFILE_HELD) add_key(plot, "mesh.nodes", "N = ");
  add_key(plot, "preset", "preset ");
  return ZP_OK;
}

static ZpStatus for_all(const ZpDrawing *drawing, const ZpPicture *const *table, size_t tables,
                        ZpStatus (*act)(const ZpDrawing *drawing, const ZpPicture *picture, ZpError *err),
                        ZpError *err) {
  ZpStatus status = ZP_OK;
  for (size_t t = 0; t < tables; t++)
    for (const ZpPicture *picture = table[t]; picture->name && status == ZP_OK; picture++)
      status = act(drawing, picture, err);
  return status;
}

ZpStatus zp_drawing_prepare(const ZpDrawing *drawing, const ZpPicture *const *table, size_t tables, ZpError *err) {
  ZpStatus status = ZP_OK;
  if (mkdir(drawing->folder, 0777) != 0 && errno != EEXIST)
    status = zp_fail(err, ZP_MACHINE, "cannot create the folder %s: %s", drawing->folder, strerror(errno));
  /* pictures of different studies may have the same name: remove all before any is made */
  if (status == ZP_OK) status = for_all(drawing, table, tables, remove_picture, err);
  if (status == ZP_OK) status = for_all(drawing, table, tables, prepare_picture, err);
  return status;
}

void zp_drawing_draw(ZpDrawing *drawing, const ZpPicture *const *table, size_t tables) {
  for (size_t t = 0; t < tables; t++)
    for (const ZpPicture *picture = table[t]; picture->name && !drawing->over; picture++)
      if (picture->has(drawing->plot)) draw(drawing, picture);
}

/* -- those of a report ----------------------------------------------------------------------------- */

static const ZpPicture *const all[] = {zp_series_pictures, zp_shape_pictures, zp_sweep_pictures,
                                       zp_map_pictures,    zp_path_pictures,  zp_rest_pictures,
                                       zp_fit_pictures,    zp_field_pictures, zp_sensitivity_pictures};

enum { TABLES = sizeof all / sizeof all[0] };

ZpStatus zp_plots_prepare(const ZpReport *report, ZpError *err) {
  ZpPlot plot;
  char *folder = zp_path_join(report->directory, "plots");
  if (!folder) return zp_fail_memory(err);
  const ZpDrawing drawing = {.plot = &plot, .folder = folder};
  ZpStatus status = look_at(report, &plot, err);
  if (status == ZP_OK) status = zp_drawing_prepare(&drawing, all, TABLES, err);
  free(folder);
  return status;
}

void zp_plots_write(const ZpReport *report, void (*notice)(const char *message)) {
  ZpPlot plot;
  ZpError err = {ZP_MACHINE, "no memory"};
  char *folder = zp_path_join(report->directory, "plots");
  ZpDrawing drawing = {&plot, folder, notice, ZP_PLOT_PATIENCE, report->hooks, false};
  if (folder && look_at(report, &plot, &err) == ZP_OK)
    zp_drawing_draw(&drawing, all, TABLES);
  else if (notice)
    notice(err.message);
  free(folder);
}
