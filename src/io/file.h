/* Files: reading one, writing one that appears under its name only when it is complete, folders, texts in memory. */
#ifndef ZP_IO_FILE_H
#define ZP_IO_FILE_H

#include <stddef.h>
#include <stdio.h>

#include <zipact/error.h>

/* The bytes of a file, at most `most` of them, and a 0 => *text, to be freed; NULL on failure. ZP_BAD_INPUT: there is
 * no such file; ZP_MACHINE: it cannot be read. */
ZpStatus zp_file_read(const char *path, size_t most, char **text, size_t *size, ZpError *err);

/* Writes `user` to a file. */
typedef ZpStatus (*ZpPut)(const void *user, FILE *file, ZpError *err);

/* The text that put(user, file) writes => *text, to be freed; NULL on failure. */
ZpStatus zp_text_put(ZpPut put, const void *user, char **text, size_t *size, ZpError *err);

/* Write text with the necessary escapes of HTML and XML, in an element or in a quoted attribute. */
void zp_html_text(FILE *file, const char *text);

/* -- files that appear when they are complete ------------------------------------------------------- */

/* A file that is being written, under a temporary name. It stays where it is while `file` is open. */
typedef struct ZpAtomic {
  FILE *file;      /* the stream to write to; NULL if another program writes to `temporary` */
  int fd, error;   /* behind `file`, and the errno of its first failure, or 0 */
  char *path;      /* its final name; NULL if nothing is open */
  char *temporary; /* its temporary name, in the same folder */
} ZpAtomic;

/* ZP_MACHINE if `name` is, in `directory`, a special file such as a device, or a link that leads out of the folder. */
ZpStatus zp_check_place(const char *directory, const char *name, ZpError *err);

/* (directory, name) => an empty file under a temporary name in `directory`. ZP_MACHINE gives the name of the file and
 * the reason. */
ZpStatus zp_atomic_open(ZpAtomic *atomic, const char *directory, const char *name, ZpError *err);

/* Reserve a place for a file that another program will write: the file exists and is empty, and `file` is NULL. */
ZpStatus zp_atomic_reserve(ZpAtomic *atomic, const char *directory, const char *name, ZpError *err);

/* Bring the file to the disk and give it its name. In every case the file is closed and no temporary file remains.
 * Earlier write errors of `file` are reported here, too. */
ZpStatus zp_atomic_commit(ZpAtomic *atomic, ZpError *err);

/* Commit if `status`, of writing to `file`, is ZP_OK; otherwise abandon and return it. If the disk caused the failure,
 * the message names the file and the reason. */
ZpStatus zp_atomic_finish(ZpAtomic *atomic, ZpStatus status, ZpError *err);

/* Remove the temporary file, if one is open. */
void zp_atomic_abandon(ZpAtomic *atomic);

/* Remove from `directory`, if it exists, the temporary files of killed processes. Requires the lock of the folder,
 * because files of running processes are removed, too. */
ZpStatus zp_atomic_clean(const char *directory, ZpError *err);

/* Remove the file `name` of an earlier report, if it exists. */
ZpStatus zp_remove_file(const char *directory, const char *name, ZpError *err);

/* Create a folder, unless it exists. */
ZpStatus zp_make_folder(const char *path, ZpError *err);

/* "directory/name", to be freed by the caller; NULL if there is no memory. */
char *zp_path_join(const char *directory, const char *name);

#endif
