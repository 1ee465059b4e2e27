/* The lock of a folder: a file in it that names its holder and is removed with the lock, by zp_folder_close. */
#ifndef ZP_IO_LOCK_H
#define ZP_IO_LOCK_H

#include <zipact/io.h>

/* Take the lock file `path` of `directory`, whose name messages have. ZP_MACHINE, and NULL, if another process holds
 * it, or if the file cannot be written. */
ZpStatus zp_lock_take(const char *path, const char *directory, ZpFolder **out, ZpError *err);

/* False if the file system has no locks; the caller then runs without one. */
bool zp_lock_held(const ZpFolder *folder);

#endif
