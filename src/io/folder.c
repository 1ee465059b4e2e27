/* A folder for results, held by one run at a time.
 *
 * The lock is flock() on a file in the folder: the kernel releases it when its process ends, in any way, so a lock is
 * never stale; the next run removes the lock file of a killed run. NFS passes the lock on to its server. The file names
 * the holder and is removed when the folder is closed: only the holder of the lock removes it, and a process that gets
 * the lock checks that the file still has its name. If a file system has no locks, runs continue without one. */
#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <zipact/io.h>

#include "base/fail.h"
#include "io/atomic.h"
#include "io/source.h"

#define LOCK_NAME ".zipact-lock"

struct ZpFolder {
  char *lock; /* path of the lock file */
  int fd;     /* its descriptor */
  bool held;  /* false: the file system has no locks */
};

static ZpStatus make_one(const char *path, ZpError *err) {
  struct stat info;
  if (mkdir(path, 0777) == 0) return ZP_OK;
  int error = errno;
  if (stat(path, &info) != 0) return zp_fail(err, ZP_MACHINE, "cannot create the folder %s: %s", path, strerror(error));
  if (S_ISDIR(info.st_mode)) return ZP_OK;
  return zp_fail(err, ZP_MACHINE, "cannot write results to %s: it is a file, not a folder", path);
}

/* Create every folder of the path, from the first on. `path` is modified and restored on the way. */
static ZpStatus make_all(char *path, ZpError *err) {
  ZpStatus status = ZP_OK;
  for (char *slash = strchr(path + 1, '/'); slash && status == ZP_OK; slash = strchr(slash + 1, '/')) {
    *slash = 0;
    status = make_one(path, err);
    *slash = '/';
  }
  return status == ZP_OK ? make_one(path, err) : status;
}

static ZpStatus make_folders(const char *directory, ZpError *err) {
  if (!directory || !*directory) return zp_fail(err, ZP_MACHINE, "the name of the output folder is empty");
  char *path = strdup(directory);
  if (!path) return zp_fail_memory(err);
  ZpStatus status = make_all(path, err);
  free(path);
  return status;
}

/* -- the lock -------------------------------------------------------------------------------------- */

static ZpStatus cannot_lock(const ZpFolder *folder, ZpError *err) {
  return zp_fail(err, ZP_MACHINE, "cannot write %s: %s", folder->lock, strerror(errno));
}

/* The holder of the lock: "process 4711 on HOST". The holder writes this right after it gets the lock, so wait for it
 * briefly. */
static void read_holder(int fd, char *who, size_t size) {
  ssize_t length = 0;
  for (int tries = 0; length <= 0 && tries < 100; tries++) {
    if (tries > 0) nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
    length = pread(fd, who, size - 1, 0);
  }
  who[length > 0 ? length : 0] = 0;
  if (!*who) snprintf(who, size, "another process");
  zp_text_clean(who);
}

static ZpStatus fail_held(const ZpFolder *folder, const char *directory, ZpError *err) {
  char who[128];
  read_holder(folder->fd, who, sizeof who);
  return zp_fail(err, ZP_MACHINE, "cannot write results to %.300s: %s is writing there", directory, who);
}

/* Does the open file still have its name, and is it new? The file of a killed run is removed. */
static bool is_new(const ZpFolder *folder) {
  struct stat own, named;
  if (fstat(folder->fd, &own) != 0 || stat(folder->lock, &named) != 0) return false;
  if (own.st_dev != named.st_dev || own.st_ino != named.st_ino) return false;
  if (own.st_size > 0) unlink(folder->lock);
  return own.st_size == 0;
}

/* Only writing a file reveals missing permissions, read-only disks, quotas and full disks alike. */
static ZpStatus sign(const ZpFolder *folder, ZpError *err) {
  char host[65] = "", self[128];
  gethostname(host, sizeof host - 1);
  int length = snprintf(self, sizeof self, "process %ld on %s", (long)getpid(), host);
  errno = ENOSPC; /* if only a part was written */
  if (write(folder->fd, self, (size_t)length) == length) return ZP_OK;
  ZpStatus status = cannot_lock(folder, err);
  unlink(folder->lock);
  return status;
}

/* One attempt; *again if the file was an old one, or was removed meanwhile. */
static ZpStatus try_lock(ZpFolder *folder, const char *directory, bool *again, ZpError *err) {
  folder->fd = open(folder->lock, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (folder->fd < 0) return cannot_lock(folder, err);
  folder->held = flock(folder->fd, LOCK_EX | LOCK_NB) == 0;
  if (!folder->held && errno == EWOULDBLOCK) return fail_held(folder, directory, err);
  *again = !is_new(folder);
  return *again ? ZP_OK : sign(folder, err);
}

static ZpStatus take_lock(ZpFolder *folder, const char *directory, ZpError *err) {
  bool again = true;
  ZpStatus status = ZP_OK;
  while (again && status == ZP_OK) {
    again = false;
    status = try_lock(folder, directory, &again, err);
    if ((again || status != ZP_OK) && folder->fd >= 0) close(folder->fd);
  }
  return status;
}

/* -- open and close -------------------------------------------------------------------------------- */

/* Remove the temporary files of killed runs, here and in the folders of frames and pictures. */
static ZpStatus clean(const char *directory, ZpError *err) {
  static const char *const below[] = {"shapes", "plots"};
  ZpStatus status = zp_atomic_clean(directory, err);
  for (size_t i = 0; i < sizeof below / sizeof below[0] && status == ZP_OK; i++) {
    char *path = zp_path_join(directory, below[i]);
    status = path ? zp_atomic_clean(path, err) : zp_fail_memory(err);
    free(path);
  }
  return status;
}

static ZpStatus open_folder(ZpFolder *folder, const char *directory, ZpError *err) {
  ZpStatus status = make_folders(directory, err);
  if (status != ZP_OK) return status;
  folder->lock = zp_path_join(directory, LOCK_NAME);
  return folder->lock ? take_lock(folder, directory, err) : zp_fail_memory(err);
}

ZpStatus zp_folder_open(const char *directory, ZpFolder **out, ZpError *err) {
  *out = calloc(1, sizeof **out);
  if (!*out) return zp_fail_memory(err);
  ZpStatus status = open_folder(*out, directory, err);
  if (status != ZP_OK) {
    free((*out)->lock);
    free(*out);
    *out = NULL;
    return status;
  }
  if ((*out)->held) status = clean(directory, err);
  if (status == ZP_OK) return ZP_OK;
  zp_folder_close(*out);
  *out = NULL;
  return status;
}

void zp_folder_close(ZpFolder *folder) {
  if (!folder) return;
  unlink(folder->lock); /* before the lock is released: after that it may belong to another run */
  close(folder->fd);
  free(folder->lock);
  free(folder);
}
