/* gnuplot for several pictures at once.
 *
 * A gnuplot gets its arguments as a vector, so no shell interprets file names. It has its own process group: Ctrl-C at
 * the terminal reaches only this program, which decides whether to continue, and processes that it has started end with
 * it. It writes to a temporary file only, so it may be killed at any time. */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "io/drawing.h"
#include "io/file.h"

/* Longest file name and message; largest number of processes at once; pause between looks at them, ns. */
enum { NAME_SIZE = 64, TEXT_SIZE = 1024, JOBS_MOST = 16, PAUSE = 4000000 };

/* A picture that is being drawn. */
typedef struct Work {
  const ZpPicture *picture;
  ZpAtomic out;
  FILE *errors; /* what gnuplot prints on stderr */
  pid_t id;
  double end; /* wall time at which it counts as hanging, s */
} Work;

static double wall_clock(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Its own group, and default signal handling, whatever this process ignores or blocks. */
static int set_attributes(posix_spawnattr_t *attributes) {
  sigset_t all, none;
  sigfillset(&all);
  sigemptyset(&none);
  int error =
      posix_spawnattr_setflags(attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  if (!error) error = posix_spawnattr_setpgroup(attributes, 0);
  if (!error) error = posix_spawnattr_setsigdefault(attributes, &all);
  return error ? error : posix_spawnattr_setsigmask(attributes, &none);
}

/* => 0 or an errno. "-d" ignores the gnuplot settings of the user. */
static int spawn(const char *folder, Work *work) {
  char set_out[2 * NAME_SIZE], script[NAME_SIZE];
  char *const argument[] = {(char[]){"gnuplot"}, (char[]){"-d"}, (char[]){"-e"}, set_out, script, NULL};
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  snprintf(set_out, sizeof set_out, "out = '%s'", strrchr(work->out.temporary, '/') + 1);
  snprintf(script, sizeof script, "%s.gp", work->picture->name);
  int error = posix_spawn_file_actions_init(&actions);
  if (error) return error;
  error = posix_spawnattr_init(&attributes);
  if (!error) {
    /* stdout is discarded, because ours may carry JSON. */
    error = posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    if (!error) error = posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    if (!error) error = posix_spawn_file_actions_adddup2(&actions, fileno(work->errors), 2);
    if (!error) error = posix_spawn_file_actions_addchdir_np(&actions, folder);
    if (!error) error = set_attributes(&attributes);
    if (!error) error = posix_spawnp(&work->id, "gnuplot", &actions, &attributes, argument, environ);
    posix_spawnattr_destroy(&attributes);
  }
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

/* The first line with a message: not empty, not the mark under a quoted command, not only a warning. */
static void read_complaint(FILE *errors, char reason[TEXT_SIZE]) {
  char line[TEXT_SIZE];
  rewind(errors);
  snprintf(reason, TEXT_SIZE, "gnuplot gave no reason");
  while (fgets(line, sizeof line, errors)) {
    const size_t blank = strspn(line, " \t^\n");
    line[strcspn(line, "\n")] = 0;
    if (blank >= strlen(line) || strstr(line, "arning:")) continue;
    snprintf(reason, TEXT_SIZE, "%s", line + blank);
    if (strstr(line, "line ")) return;
  }
}

/* gnuplot does not tell of a full disk, so look whether the file has its end: </svg> and blank lines, or ; of a GIF as
 * its last byte, since any other may be a ; too. */
static bool is_complete(const Work *work) {
  const bool is_text = strcmp(work->picture->extension, "svg") == 0;
  const char *end = is_text ? "</svg>" : ";";
  char tail[32] = {0};
  FILE *file = fopen(work->out.temporary, "re");
  if (!file) return false;
  const bool found = fseek(file, -(long)strlen(end) - (is_text ? 3 : 0), SEEK_END) == 0;
  const size_t got = found ? fread(tail, 1, sizeof tail - 1, file) : 0;
  fclose(file);
  return memmem(tail, got, end, strlen(end)) != NULL;
}

/* -- all of them ----------------------------------------------------------------------------------- */

/* Close a picture that was not drawn, and report why, unless `reason` is NULL. */
static void give_up(const ZpDrawing *drawing, Work *work, const char *reason) {
  char message[2 * TEXT_SIZE];
  const char *more = drawing->over ? "; the rest are not drawn either; their scripts are there" : "";
  snprintf(message, sizeof message, "%s/%s.%s was not drawn: %s%s", drawing->folder, work->picture->name,
           work->picture->extension, reason ? reason : "", more);
  if (drawing->notice && reason) drawing->notice(message);
  zp_atomic_abandon(&work->out);
  if (work->errors) fclose(work->errors);
}

/* Begin a picture; false if it could not be begun. */
static bool begin(ZpDrawing *drawing, const ZpPicture *picture, Work *work) {
  ZpError err;
  char name[NAME_SIZE], message[TEXT_SIZE];
  *work = (Work){.picture = picture, .end = wall_clock() + drawing->patience};
  snprintf(name, sizeof name, "%s.%s", picture->name, picture->extension);
  const bool reserved = zp_atomic_reserve(&work->out, drawing->folder, name, &err) == ZP_OK;
  work->errors = tmpfile();
  const int error = !reserved ? 0 : work->errors ? spawn(drawing->folder, work) : errno;
  if (reserved && !error) return true;
  drawing->over = error == ENOENT;
  snprintf(message, sizeof message, "gnuplot was not found: pictures are not drawn; their scripts are %s/*.gp",
           drawing->folder);
  if (drawing->over && drawing->notice) drawing->notice(message);
  give_up(drawing, work, drawing->over ? NULL : reserved ? strerror(error) : err.message);
  return false;
}

/* Close a picture whose gnuplot has ended. */
static void finish(const ZpDrawing *drawing, Work *work, bool done) {
  ZpError err;
  char reason[TEXT_SIZE], script[NAME_SIZE];
  read_complaint(work->errors, reason);
  snprintf(script, sizeof script, "%s.gp", work->picture->name);
  if (!done) zp_template_complaint(drawing->folder, script, reason, sizeof reason);
  if (!done || !is_complete(work))
    give_up(drawing, work, reason);
  else if (zp_atomic_commit(&work->out, &err) != ZP_OK)
    give_up(drawing, work, err.message);
  else
    fclose(work->errors);
}

/* Look after a picture; false if it is no longer being drawn. If gnuplot hangs or is to stop, no more are begun. */
static bool look(ZpDrawing *drawing, Work *work, bool stop) {
  int status = 0;
  char reason[TEXT_SIZE];
  const pid_t ended = waitpid(work->id, &status, WNOHANG);
  const bool lost = ended < 0 && errno != EINTR; /* other code has waited for it; the picture shows the result */
  if (!lost && ended <= 0 && !stop && wall_clock() < work->end) return true;
  if (lost || ended > 0) {
    finish(drawing, work, lost || (WIFEXITED(status) && WEXITSTATUS(status) == 0));
    return false;
  }
  const bool told = drawing->over && stop; /* of those that were drawn beside it */
  kill(-work->id, SIGKILL);
  while (waitpid(work->id, NULL, 0) < 0 && errno == EINTR)
    continue;
  drawing->over = true;
  snprintf(reason, sizeof reason, "gnuplot took longer than %g s", drawing->patience);
  give_up(drawing, work, told ? NULL : stop ? "interrupted" : reason);
  return false;
}

/* Wait a little for `busy` pictures and finish those that are done => how many are not. */
static size_t tend(ZpDrawing *drawing, Work *work, size_t busy) {
  const ZpHooks *hooks = drawing->hooks;
  nanosleep(&(struct timespec){.tv_nsec = PAUSE}, NULL);
  const bool stop = hooks && hooks->progress && hooks->progress(hooks->user, "pictures", 1);
  for (size_t i = busy; i-- > 0;)
    if (!look(drawing, &work[i], stop)) work[i] = work[--busy];
  return busy;
}

void zp_drawing_draw(ZpDrawing *drawing, const ZpPicture *picture, size_t count) {
  Work work[JOBS_MOST];
  const int jobs = drawing->jobs > 0 ? drawing->jobs : zp_processors();
  size_t busy = 0;
  for (size_t i = 0; i < count; i++) {
    while (busy == JOBS_MOST || busy >= (size_t)jobs)
      busy = tend(drawing, work, busy);
    if (!drawing->over) busy += begin(drawing, &picture[i], &work[busy]);
  }
  while (busy > 0)
    busy = tend(drawing, work, busy);
}
