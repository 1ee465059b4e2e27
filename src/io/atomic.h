/* Files that appear under their name only when they are complete. */
#ifndef ZP_IO_ATOMIC_H
#define ZP_IO_ATOMIC_H

#include <stdio.h>

#include <zipact/error.h>

struct ZpSink;

/* A file that is being written under a temporary name. */
typedef struct ZpAtomic {
  FILE *file;          /* where to write; NULL when another program writes to `temporary` */
  struct ZpSink *sink; /* behind `file` */
  char *path;          /* the name it will have; NULL when nothing is open */
  char *temporary;     /* the name it has now, in the same folder */
} ZpAtomic;

/* (directory, name) => an empty file under a temporary name in `directory`. ZP_MACHINE says which name
 * could not be written and why. */
ZpStatus zp_atomic_open(ZpAtomic *atomic, const char *directory, const char *name, ZpError *err);

/* The same for a file that another program will write: it exists, is empty, and `file` is NULL. */
ZpStatus zp_atomic_reserve(ZpAtomic *atomic, const char *directory, const char *name, ZpError *err);

/* Bring the file to the disk and give it its name. Whatever happens, nothing stays open and no temporary
 * file is left. Errors of earlier writes to `file` are found here, too. */
ZpStatus zp_atomic_commit(ZpAtomic *atomic, ZpError *err);

/* Commit if `status`, of the writing to `file`, is ZP_OK, else abandon and return it. Where the writing
 * failed because the disk did, the message names the file and why. */
ZpStatus zp_atomic_finish(ZpAtomic *atomic, ZpStatus status, ZpError *err);

/* Remove the temporary file. Nothing happens if none is open. */
void zp_atomic_abandon(ZpAtomic *atomic);

/* Remove from `directory`, which need not exist, the temporary files that killed processes left there. Only for who has
 * the folder for himself: those of a process that still writes are removed, too. */
ZpStatus zp_atomic_clean(const char *directory, ZpError *err);

/* Remove the file `name` of an earlier report; it need not exist. */
ZpStatus zp_remove_file(const char *directory, const char *name, ZpError *err);

/* "directory/name", to be freed by the caller; NULL if there is no memory. */
char *zp_path_join(const char *directory, const char *name);

#endif
