/* plots/: each picture with the gnuplot script that drew it and its data, so that `gnuplot NAME.gp` there makes the
 * same picture again.
 *
 * The numbers matter more than a picture: they are on the disk before gnuplot runs. If gnuplot is missing, fails or
 * hangs, the scripts remain and a notice says so. Pictures of an earlier report are removed first, so none shows what
 * is not in the table. As many are drawn at once as there are processors. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <zipact/version.h>

#include "base/fail.h"
#include "io/atomic.h"
#include "io/gnuplot.h"
#include "io/plot.h"
#include "io/report.h"
#include "io/template.h"
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

/* gnuplot does not tell of a full disk, so look whether the file has its end: </svg> and blank lines, or ; of a GIF as
 * its last byte, since any other may be a ; too. */
static bool is_complete(const char *path, const char *extension) {
  const bool is_text = strcmp(extension, "svg") == 0;
  const char *end = is_text ? "</svg>" : ";";
  const long length = (long)strlen(end) + (is_text ? 3 : 0);
  char tail[32] = {0};
  FILE *file = fopen(path, "re");
  if (!file) return false;
  bool found = fseek(file, -length, SEEK_END) == 0;
  size_t got = found ? fread(tail, 1, sizeof tail - 1, file) : 0;
  fclose(file);
  return got > 0 && memmem(tail, got, end, strlen(end)) != NULL;
}

static ZpStatus open_file(const ZpDrawing *drawing, const ZpPicture *picture, const char *extension, ZpAtomic *out,
                          ZpError *err) {
  char name[NAME_SIZE];
  snprintf(name, sizeof name, "%s.%s", picture->name, extension);
  return zp_atomic_open(out, drawing->folder, name, err);
}

/* The text of a picture's template, to be freed. */
static ZpStatus read_template(const ZpDrawing *drawing, const ZpPicture *picture, char **text, ZpError *err) {
  size_t size = 0;
  *text = NULL;
  FILE *file = open_memstream(text, &size);
  if (!file) return zp_fail_memory(err);
  const ZpReport *report = drawing->plot->report;
  ZpStatus status =
      zp_template_write(report && report->templates ? report->templates : "", picture->template, file, err);
  return fclose(file) != 0 && status == ZP_OK ? zp_fail_memory(err) : status;
}

/* Definitions, then the template itself: the script needs no file but its data. */
static ZpStatus write_script(const ZpDrawing *drawing, const ZpPicture *picture, ZpError *err) {
  const ZpPlot *plot = drawing->plot;
  ZpAtomic out;
  char *text = NULL;
  ZpStatus status = picture->template ? read_template(drawing, picture, &text, err) : ZP_OK;
  if (status == ZP_OK) status = open_file(drawing, picture, "gp", &out, err);
  if (status == ZP_OK) {
    if (text) {
      fprintf(out.file,
              "# Made by zipact " ZP_VERSION "; draw again with: gnuplot %s.gp\n"
              "if (!exists('out')) out = '%s.%s'\n",
              picture->name, picture->name, picture->extension);
      zp_plot_define_common(plot, text, out.file);
    }
    if (picture->define) picture->define(plot, out.file);
    if (text) fputs(text, out.file);
    status = zp_atomic_commit(&out, err);
  }
  free(text);
  return status;
}

static ZpStatus write_data(const ZpDrawing *drawing, const ZpPicture *picture, ZpError *err) {
  ZpAtomic out;
  if (!picture->data) return ZP_OK;
  ZpStatus status = open_file(drawing, picture, "dat", &out, err);
  if (status != ZP_OK) return status;
  picture->data(drawing->plot, out.file);
  return zp_atomic_commit(&out, err);
}

/* A picture that is being drawn. */
typedef struct Work {
  const ZpPicture *picture;
  ZpAtomic out;
  ZpGnuplotChild child;
} Work;

static void name_of(const ZpPicture *picture, char *name) {
  snprintf(name, NAME_SIZE, "%s.%s", picture->name, picture->extension);
}

/* After this, no more are tried if gnuplot can draw none. */
static void give_up(ZpDrawing *drawing, Work *work, ZpGnuplot end, const char *reason) {
  char name[NAME_SIZE];
  const bool told = drawing->over && end == ZP_GNUPLOT_INTERRUPTED; /* of those that were drawn beside it */
  name_of(work->picture, name);
  drawing->over = drawing->over || (end != ZP_GNUPLOT_DONE && end != ZP_GNUPLOT_FAILED);
  zp_atomic_abandon(&work->out);
  if (end == ZP_GNUPLOT_MISSING)
    say_missing(drawing);
  else if (!told)
    say(drawing, name, reason);
}

/* Begin a picture; false if it could not be begun. */
static bool begin(ZpDrawing *drawing, const ZpPicture *picture, Work *work) {
  ZpError err;
  char name[NAME_SIZE], script[NAME_SIZE], reason[256];
  *work = (Work){.picture = picture};
  name_of(picture, name);
  snprintf(script, sizeof script, "%s.gp", picture->name);
  if (zp_atomic_reserve(&work->out, drawing->folder, name, &err) != ZP_OK) {
    say(drawing, name, err.message);
    return false;
  }
  const ZpGnuplotJob job = {drawing->folder, script, strrchr(work->out.temporary, '/') + 1, drawing->patience};
  ZpGnuplot state = zp_gnuplot_start(&job, &work->child, reason, sizeof reason);
  if (state != ZP_GNUPLOT_RUNS) give_up(drawing, work, state, reason);
  return state == ZP_GNUPLOT_RUNS;
}

/* Report which line of which template gnuplot refuses. */
static void explain(const ZpDrawing *drawing, const Work *work, char *reason, size_t size) {
  char name[NAME_SIZE];
  snprintf(name, sizeof name, "%s.gp", work->picture->name);
  char *script = zp_path_join(drawing->folder, name);
  if (script) zp_template_complaint(script, reason, size);
  free(script);
}

static void finish(ZpDrawing *drawing, Work *work, ZpGnuplot end, char *reason, size_t size) {
  ZpError err;
  char name[NAME_SIZE];
  name_of(work->picture, name);
  if (end == ZP_GNUPLOT_FAILED) explain(drawing, work, reason, size);
  if (end != ZP_GNUPLOT_DONE || !is_complete(work->out.temporary, work->picture->extension))
    give_up(drawing, work, end, reason);
  else if (zp_atomic_commit(&work->out, &err) != ZP_OK)
    say(drawing, name, err.message);
}

static bool asked_to_stop(const ZpHooks *hooks) {
  return hooks && hooks->progress && hooks->progress(hooks->user, "pictures", 1);
}

/* Wait a little for `busy` pictures and finish those that are done => how many are not. */
static size_t tend(ZpDrawing *drawing, Work *work, size_t busy) {
  ZpGnuplotChild *child[ZP_GNUPLOT_MOST] = {NULL};
  char reason[1024];
  for (size_t i = 0; i < busy; i++)
    child[i] = &work[i].child;
  zp_gnuplot_wait(child, busy);
  const bool stop = asked_to_stop(drawing->hooks);
  for (size_t i = busy; i-- > 0;) {
    ZpGnuplot state = zp_gnuplot_look(&work[i].child, stop, reason, sizeof reason);
    if (state == ZP_GNUPLOT_RUNS) continue;
    finish(drawing, &work[i], state, reason, sizeof reason);
    work[i] = work[--busy];
  }
  return busy;
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
  if (!zp_picture_is_drawn(picture, drawing->plot)) return ZP_OK;
  ZpStatus status = write_script(drawing, picture, err);
  return status == ZP_OK ? write_data(drawing, picture, err) : status;
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

/* Pictures of different studies may have the same name: all are removed before any is made. */
ZpStatus zp_drawing_prepare(const ZpDrawing *drawing, const ZpPicture *const *table, size_t tables, ZpError *err) {
  ZpStatus status = for_all(drawing, table, tables, remove_picture, err);
  if (status == ZP_OK && mkdir(drawing->folder, 0777) != 0 && errno != EEXIST)
    status = zp_fail(err, ZP_MACHINE, "cannot create the folder %s: %s", drawing->folder, strerror(errno));
  if (status == ZP_OK) status = for_all(drawing, table, tables, prepare_picture, err);
  return status;
}

static size_t at_once(const ZpDrawing *drawing) {
  const int jobs = drawing->jobs > 0 ? drawing->jobs : zp_processors();
  return jobs < ZP_GNUPLOT_MOST ? (size_t)jobs : ZP_GNUPLOT_MOST;
}

void zp_drawing_draw(ZpDrawing *drawing, const ZpPicture *const *table, size_t tables) {
  Work work[ZP_GNUPLOT_MOST];
  const size_t most = at_once(drawing);
  size_t busy = 0;
  for (size_t t = 0; t < tables; t++)
    for (const ZpPicture *picture = table[t]; picture->name; picture++) {
      while (busy == most)
        busy = tend(drawing, work, busy);
      if (!drawing->over && zp_picture_is_drawn(picture, drawing->plot)) busy += begin(drawing, picture, &work[busy]);
    }
  while (busy > 0)
    busy = tend(drawing, work, busy);
}

/* -- those of a report ----------------------------------------------------------------------------- */

static const ZpPicture *const all[] = {zp_run_pictures,         zp_shape_pictures,  zp_film_pictures, zp_sweep_pictures,
                                       zp_map_pictures,         zp_path_pictures,   zp_fit_pictures,  zp_field_pictures,
                                       zp_sensitivity_pictures, zp_sample_pictures, zp_many_pictures};

enum { TABLES = sizeof all / sizeof all[0] };

ZpStatus zp_plots_prepare(const ZpReport *report, ZpError *err) {
  ZpPlot plot;
  char *folder = zp_path_join(report->directory, "plots");
  if (!folder) return zp_fail_memory(err);
  const ZpDrawing drawing = {.plot = &plot, .folder = folder};
  ZpStatus status = zp_plot_open(report, &plot, err);
  if (status == ZP_OK && plot.drawn)
    status = zp_drawing_prepare(&drawing, all, TABLES, err);
  else if (status == ZP_OK)
    status = for_all(&drawing, all, TABLES, remove_picture, err);
  zp_plot_close(&plot);
  free(folder);
  return status;
}

void zp_plots_write(const ZpReport *report, void (*notice)(const char *message)) {
  ZpPlot plot;
  ZpError err;
  char *folder = zp_path_join(report->directory, "plots");
  ZpStatus status = folder ? zp_plot_open(report, &plot, &err) : zp_fail_memory(&err);
  if (status == ZP_OK && plot.drawn) {
    ZpDrawing drawing = {&plot, folder, notice, ZP_PLOT_PATIENCE, report->hooks, report->jobs, false};
    zp_drawing_draw(&drawing, all, TABLES);
  }
  if (status != ZP_OK && notice) notice(err.message);
  if (folder) zp_plot_close(&plot);
  free(folder);
}
