/* Scripts of pictures, and gnuplot for several of them at once, as many as there are processors.
 *
 * If gnuplot is missing, fails or hangs, the scripts remain and a notice says so: `gnuplot NAME.gp` in the folder makes
 * the picture later. */
#include "io/drawing.h"

#include <stdlib.h>
#include <string.h>

#include <zipact/version.h>

#include "base/fail.h"
#include "io/atomic.h"
#include "io/gnuplot.h"
#include "io/template.h"

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

ZpStatus zp_drawing_script(const ZpDrawing *drawing, const ZpPicture *picture, ZpError *err) {
  ZpAtomic out;
  char name[NAME_SIZE];
  snprintf(name, sizeof name, "%s.gp", picture->name);
  ZpStatus status = zp_atomic_open(&out, drawing->folder, name, err);
  if (status != ZP_OK) return status;
  fprintf(out.file,
          "# Made by zipact " ZP_VERSION "; draw again with: gnuplot %s\n"
          "if (!exists('out')) out = '%s.%s'\nload 'result.gp'\n",
          name, picture->name, picture->extension);
  status = zp_template_write(drawing->templates ? drawing->templates : "", picture->template, out.file, err);
  return zp_atomic_finish(&out, status, err);
}

ZpStatus zp_drawing_file(const ZpDrawing *drawing, const char *name, void (*put)(const void *user, FILE *file),
                         const void *user, ZpError *err) {
  ZpAtomic out;
  ZpStatus status = zp_atomic_open(&out, drawing->folder, name, err);
  if (status != ZP_OK) return status;
  put(user, out.file);
  return zp_atomic_commit(&out, err);
}

ZpStatus zp_drawing_remove(const ZpDrawing *drawing, const ZpPicture *picture, ZpError *err) {
  const char *const extension[] = {"gp", "png", picture->extension};
  ZpStatus status = ZP_OK;
  for (size_t i = 0; i < 3 && status == ZP_OK; i++) {
    char name[NAME_SIZE];
    snprintf(name, sizeof name, "%s.%s", picture->name, extension[i]);
    status = zp_remove_file(drawing->folder, name, err);
  }
  return status;
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

static size_t at_once(const ZpDrawing *drawing) {
  const int jobs = drawing->jobs > 0 ? drawing->jobs : zp_processors();
  return jobs < ZP_GNUPLOT_MOST ? (size_t)jobs : ZP_GNUPLOT_MOST;
}

void zp_drawing_draw(ZpDrawing *drawing, const ZpPicture *picture, size_t count) {
  Work work[ZP_GNUPLOT_MOST];
  const size_t most = at_once(drawing);
  size_t busy = 0;
  for (size_t i = 0; i < count; i++) {
    while (busy == most)
      busy = tend(drawing, work, busy);
    if (!drawing->over) busy += begin(drawing, &picture[i], &work[busy]);
  }
  while (busy > 0)
    busy = tend(drawing, work, busy);
}
