/* Running gnuplot as a child process.
 *
 * Arguments go as a vector, so no shell reads file names. The child has a process group of its own: a
 * Ctrl-C at the terminal is for the simulation, and what was done is still drawn. What it prints on
 * stderr is read through a pipe; what it prints on stdout is dropped, since stdout may carry JSON. */
#include "io/gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* What is kept of stderr: more than enough for the first complaint. */
#define KEPT 4096

/* => 0 or an errno. stderr of the child goes to `error_pipe`. */
static int set_files(posix_spawn_file_actions_t *actions, const char *folder, int error_pipe) {
  int error = posix_spawn_file_actions_addopen(actions, 0, "/dev/null", O_RDONLY, 0);
  if (!error) error = posix_spawn_file_actions_addopen(actions, 1, "/dev/null", O_WRONLY, 0);
  if (!error) error = posix_spawn_file_actions_adddup2(actions, error_pipe, 2);
  return error ? error : posix_spawn_file_actions_addchdir_np(actions, folder);
}

/* A group of its own, and signals as they are by default, whatever we ignore or block. */
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

/* => 0 and the child's id, or an errno. "-d" keeps the user's own gnuplot settings out of the picture. */
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

/* Read until the child closes its end; keep the first KEPT bytes. */
static void read_all(int fd, char *kept) {
  char part[1024];
  size_t used = 0;
  for (;;) {
    ssize_t got = read(fd, part, sizeof part);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    size_t take = (size_t)got < KEPT - 1 - used ? (size_t)got : KEPT - 1 - used;
    memcpy(kept + used, part, take);
    used += take;
  }
  kept[used] = 0;
}

static bool ended_well(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return true; /* someone else waits for children; the picture will tell */
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/* The first line that says something: not empty, not the mark under a quoted command, no mere warning. */
static void first_complaint(char *text, char *reason, size_t size) {
  char *rest = NULL;
  for (char *line = strtok_r(text, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest)) {
    size_t blank = strspn(line, " \t^");
    if (!line[blank] || strstr(line, "arning:")) continue;
    snprintf(reason, size, "%s", line + blank);
    if (strstr(line, "line ")) return;
  }
}

ZpGnuplot zp_gnuplot_run(const char *folder, const char *script, const char *output, char *reason, size_t size) {
  char kept[KEPT], *set_out = NULL;
  int ends[2];
  pid_t child = 0;
  snprintf(reason, size, "gnuplot gave no reason");
  if (pipe2(ends, O_CLOEXEC) != 0) {
    snprintf(reason, size, "%s", strerror(errno));
    return ZP_GNUPLOT_FAILED;
  }
  int error = asprintf(&set_out, "out = '%s'", output) < 0 ? ENOMEM : 0;
  if (!error) {
    error = spawn(&child, folder, script, set_out, ends[1]);
    free(set_out);
  }
  close(ends[1]);
  if (!error) read_all(ends[0], kept);
  close(ends[0]);
  if (error) {
    snprintf(reason, size, "%s", strerror(error));
    return error == ENOENT ? ZP_GNUPLOT_MISSING : ZP_GNUPLOT_FAILED;
  }
  bool well = ended_well(child);
  first_complaint(kept, reason, size);
  return well ? ZP_GNUPLOT_DONE : ZP_GNUPLOT_FAILED;
}
