/* The lock is flock() on its file: the kernel releases it when its process ends, in any way, so a lock is
 * never stale; the next run removes the lock file of a killed run. NFS passes the lock on to its server. Only the
 * holder of the lock removes the file, and a process that gets the lock checks that the file still has its name. If a
 * file system has no locks, runs continue without one. */
#include "io/lock.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "base/fail.h"
#include "io/source.h"

struct ZpFolder {
  char *path; /* of its file */
  int fd;     /* its descriptor */
  bool held;  /* false: the file system has no locks */
};

static ZpStatus cannot_lock(const ZpFolder *lock, ZpError *err) {
  return zp_fail(err, ZP_MACHINE, "cannot write %s: %s", lock->path, strerror(errno));
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

/* Does the open file still have its name, and is it new? The file of a killed run is removed. */
static bool is_new(const ZpFolder *lock) {
  struct stat own, named;
  if (fstat(lock->fd, &own) != 0 || stat(lock->path, &named) != 0) return false;
  if (own.st_dev != named.st_dev || own.st_ino != named.st_ino) return false;
  if (own.st_size > 0) unlink(lock->path);
  return own.st_size == 0;
}

/* Only writing a file reveals missing permissions, read-only disks, quotas and full disks alike. */
static ZpStatus sign(const ZpFolder *lock, ZpError *err) {
  char host[65] = "", self[128];
  gethostname(host, sizeof host - 1);
  int length = snprintf(self, sizeof self, "process %ld on %s", (long)getpid(), host);
  errno = ENOSPC; /* if only a part was written */
  if (write(lock->fd, self, (size_t)length) == length) return ZP_OK;
  ZpStatus status = cannot_lock(lock, err);
  unlink(lock->path);
  return status;
}

/* One attempt; *again if the file was an old one, or was removed meanwhile. */
static ZpStatus try_lock(ZpFolder *lock, const char *directory, bool *again, ZpError *err) {
  lock->fd = open(lock->path, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (lock->fd < 0) return cannot_lock(lock, err);
  lock->held = flock(lock->fd, LOCK_EX | LOCK_NB) == 0;
  if (!lock->held && errno == EWOULDBLOCK) {
    char who[128];
    read_holder(lock->fd, who, sizeof who);
    return zp_fail(err, ZP_MACHINE, "cannot write results to %.300s: %s is writing there", directory, who);
  }
  *again = !is_new(lock);
  return *again ? ZP_OK : sign(lock, err);
}

static ZpStatus take_lock(ZpFolder *lock, const char *directory, ZpError *err) {
  bool again = true;
  ZpStatus status = ZP_OK;
  while (again && status == ZP_OK) {
    again = false;
    status = try_lock(lock, directory, &again, err);
    if ((again || status != ZP_OK) && lock->fd >= 0) close(lock->fd);
  }
  return status;
}

ZpStatus zp_lock_take(const char *path, const char *directory, ZpFolder **out, ZpError *err) {
  ZpFolder *lock = calloc(1, sizeof *lock);
  *out = NULL;
  if (lock) lock->path = strdup(path);
  ZpStatus status = lock && lock->path ? take_lock(lock, directory, err) : zp_fail_memory(err);
  if (status == ZP_OK) {
    *out = lock;
    return ZP_OK;
  }
  if (lock) free(lock->path);
  free(lock);
  return status;
}

bool zp_lock_held(const ZpFolder *lock) {
  return lock->held;
}

void zp_folder_close(ZpFolder *lock) {
  if (!lock) return;
  unlink(lock->path); /* before the lock is released: after that it may belong to another run */
  close(lock->fd);
  free(lock->path);
  free(lock);
}
