/* The lock of a folder: a file in it that names its holder and is removed with the lock. */
#ifndef ZP_IO_LOCK_H
#define ZP_IO_LOCK_H

#include <stdbool.h>

#include <zipact/error.h>

typedef struct ZpLock ZpLock;

/* Take the lock file `path` of `directory`, whose name messages have. ZP_MACHINE if another process holds it, or if the
 * file cannot be written. */
ZpStatus zp_lock_take(const char *path, const char *directory, ZpLock **out, ZpError *err);

/* False if the file system has no locks; the caller then runs without one. */
bool zp_lock_held(const ZpLock *lock);

/* Removes the file and releases the lock; of NULL nothing. */
void zp_lock_release(ZpLock *lock);

#endif
