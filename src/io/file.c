#include "io/file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdio_ext.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/fail.h"

static ZpStatus read_all(FILE *file, const char *path, size_t most, char **text, size_t *size, ZpError *err) {
  for (size_t room = 1 << 14, got = 1; got > 0 && *size < most; room *= 2) {
    char *more = realloc(*text, room + 1);
    if (!more) return zp_fail_memory(err);
    *text = more;
    got = fread(more + *size, 1, (room < most ? room : most) - *size, file);
    *size += got;
    more[*size] = 0;
  }
  return ferror(file) ? zp_fail(err, ZP_MACHINE, "%.300s: cannot be read: %s", path, strerror(errno)) : ZP_OK;
}

ZpStatus zp_file_read(const char *path, size_t most, char **text, size_t *size, ZpError *err) {
  FILE *file = fopen(path, "rbe");
  *text = NULL;
  *size = 0;
  if (!file) /* a missing file is wrong input; a file that must not be read is a failure of the machine */
    return zp_fail(err, errno == ENOENT || errno == ENOTDIR ? ZP_BAD_INPUT : ZP_MACHINE, "%.300s: cannot be opened: %s",
                   path, strerror(errno));
  ZpStatus status = read_all(file, path, most, text, size, err);
  fclose(file); /* nothing was written */
  if (status == ZP_OK) return ZP_OK;
  free(*text);
  *text = NULL;
  return status;
}

ZpStatus zp_text_put(ZpPut put, const void *user, char **text, size_t *size, ZpError *err) {
  *text = NULL;
  FILE *file = open_memstream(text, size);
  if (!file) return zp_fail_memory(err);
  ZpStatus status = put(user, file, err);
  if (fclose(file) != 0 && status == ZP_OK) status = zp_fail_memory(err);
  if (status == ZP_OK) return ZP_OK;
  free(*text);
  *text = NULL;
  return status;
}

void zp_html_text(FILE *file, const char *text) {
  for (; *text; text++) {
    if (*text == '&')
      fputs("&amp;", file);
    else if (*text == '<')
      fputs("&lt;", file);
    else if (*text == '>')
      fputs("&gt;", file);
    else if (*text == '"')
      fputs("&quot;", file);
    else
      fputc(*text, file);
  }
}

/* -- files that appear when they are complete -------------------------------------------------------
 *
 * A file is written under a temporary name in its own folder. So a reader never sees half of it, and after a failure
 * the old file is still there. rename() replaces the file in one step, but only within one file system: hence the same
 * folder. The data are brought to the disk before the rename, because some file systems report a full disk only
 * then. */

char *zp_path_join(const char *directory, const char *name) {
  char *path = NULL;
  return asprintf(&path, "%s/%s", directory, name) < 0 ? NULL : path;
}

ZpStatus zp_make_folder(const char *path, ZpError *err) {
  struct stat info;
  if (mkdir(path, 0777) == 0) return ZP_OK;
  int error = errno;
  if (stat(path, &info) != 0) return zp_fail(err, ZP_MACHINE, "cannot create the folder %s: %s", path, strerror(error));
  if (S_ISDIR(info.st_mode)) return ZP_OK;
  return zp_fail(err, ZP_MACHINE, "cannot write results to %s: it is a file, not a folder", path);
}

static ZpStatus cannot_write(const char *path, int error, ZpError *err) {
  return zp_fail(err, ZP_MACHINE, "cannot write %s: %s", path, strerror(error));
}

static void forget(ZpAtomic *atomic) {
  free(atomic->path);
  free(atomic->temporary);
  *atomic = (ZpAtomic){0};
}

/* Between the name of a file and the process id in its temporary name: no one else names files so. */
#define MARK ".zipact-"

/* The process id separates two programs that write to one folder. The name begins with a point so that patterns such as
 * *.csv do not match it. */
static bool make_names(ZpAtomic *atomic, const char *directory, const char *name) {
  *atomic = (ZpAtomic){.path = zp_path_join(directory, name)};
  if (asprintf(&atomic->temporary, "%s/.%s" MARK "%ld.tmp", directory, name, (long)getpid()) < 0)
    atomic->temporary = NULL;
  return atomic->path && atomic->temporary;
}

/* Whether make_names, in some process, has made this name. */
static bool is_temporary(const char *name) {
  const char *mark = name[0] == '.' ? strstr(name + 1, MARK) : NULL;
  if (!mark || mark == name + 1) return false;
  const char *id = mark + strlen(MARK);
  size_t digits = strspn(id, "0123456789");
  return digits > 0 && strcmp(id + digits, ".tmp") == 0;
}

ZpStatus zp_atomic_clean(const char *directory, ZpError *err) {
  DIR *list = opendir(directory);
  if (!list && (errno == ENOENT || errno == ENOTDIR)) return ZP_OK;
  if (!list) return zp_fail(err, ZP_MACHINE, "cannot read the folder %s: %s", directory, strerror(errno));
  ZpStatus status = ZP_OK;
  for (struct dirent *entry = readdir(list); entry && status == ZP_OK; entry = readdir(list))
    if (is_temporary(entry->d_name)) status = zp_remove_file(directory, entry->d_name, err);
  closedir(list);
  return status;
}

ZpStatus zp_remove_file(const char *directory, const char *name, ZpError *err) {
  char *path = zp_path_join(directory, name);
  if (!path) return zp_fail_memory(err);
  ZpStatus status = ZP_OK;
  if (unlink(path) != 0 && errno != ENOENT && errno != ENOTDIR)
    status = zp_fail(err, ZP_MACHINE, "cannot replace %s: %s", path, strerror(errno));
  free(path);
  return status;
}

/* Is the target of the link `path` below `directory`? */
static bool stays_inside(const char *directory, const char *path) {
  char *folder = realpath(directory, NULL), *target = realpath(path, NULL);
  const size_t length = folder ? strlen(folder) : 0;
  bool inside = folder && target && strncmp(target, folder, length) == 0 && (target[length] == '/' || length == 1);
  free(folder);
  free(target);
  return inside;
}

ZpStatus zp_check_place(const char *directory, const char *name, ZpError *err) {
  struct stat there;
  ZpStatus status = ZP_OK;
  char *path = zp_path_join(directory, name);
  if (!path) return zp_fail_memory(err);
  if (lstat(path, &there) == 0) {
    if (S_ISLNK(there.st_mode) && !stays_inside(directory, path))
      status = zp_fail(err, ZP_MACHINE, "cannot write %s: it is a link that leads out of its folder", path);
    else if (!S_ISLNK(there.st_mode) && !S_ISREG(there.st_mode) && !S_ISDIR(there.st_mode))
      status = zp_fail(err, ZP_MACHINE, "cannot write %s: it is a special file", path);
  }
  free(path);
  return status;
}

/* An empty file under the temporary name, open as atomic->fd. An existing one of that name can only be from a killed
 * process with our process id. */
static ZpStatus begin(ZpAtomic *atomic, const char *directory, const char *name, ZpError *err) {
  const int flags = O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC | O_NOFOLLOW;
  *atomic = (ZpAtomic){0};
  ZpStatus status = zp_check_place(directory, name, err);
  if (status != ZP_OK) return status;
  if (!make_names(atomic, directory, name)) {
    forget(atomic);
    return zp_fail_memory(err);
  }
  atomic->fd = open(atomic->temporary, flags, 0666);
  if (atomic->fd < 0 && errno == EEXIST && unlink(atomic->temporary) == 0)
    atomic->fd = open(atomic->temporary, flags, 0666);
  if (atomic->fd >= 0) return ZP_OK;
  status = cannot_write(atomic->path, errno, err);
  forget(atomic);
  return status;
}

ZpStatus zp_atomic_reserve(ZpAtomic *atomic, const char *directory, const char *name, ZpError *err) {
  ZpStatus status = begin(atomic, directory, name, err);
  if (status == ZP_OK) close(atomic->fd); /* nothing was written, so nothing can be lost */
  return status;
}

/* Takes the bytes of the stream. A FILE forgets the errno of a write that failed some time before it is closed; this
 * does not. */
static ssize_t write_bytes(void *cookie, const char *data, size_t size) {
  ZpAtomic *atomic = cookie;
  size_t done = 0;
  while (done < size && !atomic->error) {
    ssize_t written = write(atomic->fd, data + done, size - done);
    if (written >= 0)
      done += (size_t)written;
    else if (errno != EINTR)
      atomic->error = errno;
  }
  return (ssize_t)done;
}

ZpStatus zp_atomic_open(ZpAtomic *atomic, const char *directory, const char *name, ZpError *err) {
  ZpStatus status = begin(atomic, directory, name, err);
  if (status != ZP_OK) return status;
  atomic->file = fopencookie(atomic, "w", (cookie_io_functions_t){.write = write_bytes});
  if (atomic->file) {
    __fsetlocking(atomic->file, FSETLOCKING_BYCALLER); /* one thread has it: locks would cost more than most writing */
    return ZP_OK;
  }
  status = cannot_write(atomic->path, errno, err);
  close(atomic->fd);
  zp_atomic_abandon(atomic);
  return status;
}

/* Close stream and file => 0, or the errno of the first failure: an early write, the last one, the disk or the
 * close. */
static int finish_stream(ZpAtomic *atomic) {
  bool bad = ferror(atomic->file) != 0;
  bad = fclose(atomic->file) != 0 || bad;
  int error = atomic->error ? atomic->error : bad ? EIO : 0;
  if (!error && fsync(atomic->fd) != 0) error = errno;
  if (close(atomic->fd) != 0 && !error) error = errno;
  atomic->file = NULL;
  return error;
}

/* Bring a file that another program wrote to the disk => 0, or the errno of the failure. */
static int sync_path(const char *path) {
  int fd = open(path, O_RDONLY | O_CLOEXEC);
  if (fd < 0) return errno;
  int error = fsync(fd) == 0 ? 0 : errno;
  close(fd);
  return error;
}

ZpStatus zp_atomic_commit(ZpAtomic *atomic, ZpError *err) {
  int error = atomic->file ? finish_stream(atomic) : sync_path(atomic->temporary);
  if (!error && rename(atomic->temporary, atomic->path) != 0) error = errno;
  ZpStatus status = error ? cannot_write(atomic->path, error, err) : ZP_OK;
  if (error) unlink(atomic->temporary);
  forget(atomic);
  return status;
}

ZpStatus zp_atomic_finish(ZpAtomic *atomic, ZpStatus status, ZpError *err) {
  if (status == ZP_OK || ferror(atomic->file)) return zp_atomic_commit(atomic, err);
  zp_atomic_abandon(atomic);
  return status;
}

void zp_atomic_abandon(ZpAtomic *atomic) {
  if (!atomic->path) return;
  if (atomic->file) finish_stream(atomic);
  unlink(atomic->temporary);
  forget(atomic);
}
