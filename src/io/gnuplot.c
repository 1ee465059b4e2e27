/* Running gnuplot as child processes.
 *
 * Arguments are passed as a vector, so no shell interprets file names. The child has its own process group: Ctrl-C at
 * the terminal reaches only this program, which decides whether to continue, and processes that the child has started
 * end with it. It writes to a temporary file only, so it may be killed at any time, by the signal that no program can
 * ignore. Its stderr is read through a pipe; its stdout is discarded, because our stdout may carry JSON. */
#include "io/gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* Longest wait, ms; needed if a child has closed its stderr, so that its end does not wake us. */
enum { PULSE = 20, SHORT_PULSE = 1 };

/* => 0 or an errno. stderr of the child goes to `error_pipe`. */
static int set_files(posix_spawn_file_actions_t *actions, const char *folder, int error_pipe) {
  int error = posix_spawn_file_actions_addopen(actions, 0, "/dev/null", O_RDONLY, 0);
  if (!error) error = posix_spawn_file_actions_addopen(actions, 1, "/dev/null", O_WRONLY, 0);
  if (!error) error = posix_spawn_file_actions_adddup2(actions, error_pipe, 2);
  return error ? error : posix_spawn_file_actions_addchdir_np(actions, folder);
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

/* => 0 and the id of the child, or an errno. "-d" ignores the gnuplot settings of the user. */
static int spawn(pid_t *child, const char *folder, const char *script, char *set_out, int error_pipe) {
  char *const argument[] = {(char[]){"gnuplot"}, (char[]){"-d"}, (char[]){"-e"}, set_out, (char *)script, NULL};
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  int error = posix_spawn_file_actions_init(&actions);
  if (error) return error;
  error = posix_spawnattr_init(&attributes);
  if (!error) {
    error = set_files(&actions, folder, error_pipe);
    if (!error) error = set_attributes(&attributes);
    if (!error) error = posix_spawnp(child, "gnuplot", &actions, &attributes, argument, environ);
    posix_spawnattr_destroy(&attributes);
  }
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

/* Read the available output; keep the first ZP_GNUPLOT_KEPT bytes. */
static void read_errors(ZpGnuplotChild *child) {
  char part[1024];
  for (;;) {
    ssize_t got = read(child->errors, part, sizeof part);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && errno == EAGAIN) return;
    if (got <= 0) break;
    size_t room = ZP_GNUPLOT_KEPT - 1 - child->used, take = (size_t)got < room ? (size_t)got : room;
    memcpy(child->kept + child->used, part, take);
    child->used += take;
    child->kept[child->used] = 0;
  }
  close(child->errors);
  child->errors = -1;
}

void zp_gnuplot_wait(ZpGnuplotChild *const *child, size_t count) {
  struct pollfd stream[ZP_GNUPLOT_MOST];
  int pulse = PULSE;
  for (size_t i = 0; i < count; i++) {
    stream[i] = (struct pollfd){.fd = child[i]->errors, .events = POLLIN}; /* poll ignores values below 0 */
    if (child[i]->errors < 0) pulse = SHORT_PULSE;
  }
  poll(stream, count, pulse);
}

static double wall_clock(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void kill_group(const ZpGnuplotChild *child) {
  kill(-child->id, SIGKILL);
  while (waitpid(child->id, NULL, 0) < 0 && errno == EINTR)
    continue;
}

/* The state of a child: running, ended, or to be ended now. */
static ZpGnuplot state_of(const ZpGnuplotChild *child, bool stop) {
  int status = 0;
  pid_t ended = waitpid(child->id, &status, WNOHANG);
  if (ended < 0 && errno != EINTR)
    return ZP_GNUPLOT_DONE; /* other code has waited for the child; the picture shows the result */
  if (ended > 0) return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? ZP_GNUPLOT_DONE : ZP_GNUPLOT_FAILED;
  if (!stop && wall_clock() < child->end) return ZP_GNUPLOT_RUNS;
  kill_group(child);
  return stop ? ZP_GNUPLOT_INTERRUPTED : ZP_GNUPLOT_HANGS;
}

/* The first line with a message: not empty, not the mark under a quoted command, not only a warning. */
static void first_complaint(char *text, char *reason, size_t size) {
  char *rest = NULL;
  for (char *line = strtok_r(text, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest)) {
    size_t blank = strspn(line, " \t^");
    if (!line[blank] || strstr(line, "arning:")) continue;
    snprintf(reason, size, "%s", line + blank);
    if (strstr(line, "line ")) return;
  }
}

/* => 0 and the child, or an errno. */
static int start(const ZpGnuplotJob *job, ZpGnuplotChild *child) {
  char *set_out = NULL;
  int ends[2];
  *child = (ZpGnuplotChild){.errors = -1, .patience = job->patience, .end = wall_clock() + job->patience};
  if (pipe2(ends, O_CLOEXEC) != 0) return errno;
  int error = asprintf(&set_out, "out = '%s'", job->output) < 0 ? ENOMEM : 0;
  if (!error) {
    error = spawn(&child->id, job->folder, job->script, set_out, ends[1]);
    free(set_out);
  }
  close(ends[1]);
  if (!error && fcntl(ends[0], F_SETFL, O_NONBLOCK) == 0) child->errors = ends[0];
  if (child->errors < 0) close(ends[0]);
  return error;
}

ZpGnuplot zp_gnuplot_start(const ZpGnuplotJob *job, ZpGnuplotChild *child, char *reason, size_t size) {
  int error = start(job, child);
  if (!error) return ZP_GNUPLOT_RUNS;
  snprintf(reason, size, "%s", strerror(error));
  return error == ENOENT ? ZP_GNUPLOT_MISSING : ZP_GNUPLOT_FAILED;
}

ZpGnuplot zp_gnuplot_look(ZpGnuplotChild *child, bool stop, char *reason, size_t size) {
  if (child->errors >= 0) read_errors(child);
  ZpGnuplot end = state_of(child, stop);
  if (end == ZP_GNUPLOT_RUNS) return end;
  if (child->errors >= 0) read_errors(child);
  if (child->errors >= 0) close(child->errors);
  snprintf(reason, size, "gnuplot gave no reason");
  first_complaint(child->kept, reason, size);
  if (end == ZP_GNUPLOT_HANGS) snprintf(reason, size, "gnuplot took longer than %g s", child->patience);
  if (end == ZP_GNUPLOT_INTERRUPTED) snprintf(reason, size, "interrupted");
  return end;
}
