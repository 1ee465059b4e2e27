/* A ZIP archive that is being written. The same content gives the same bytes, at any time on any machine. */
#ifndef ZP_FMUPACK_ARCHIVE_H
#define ZP_FMUPACK_ARCHIVE_H

#include <stddef.h>

#include <zipact/error.h>

typedef struct ZpArchive ZpArchive;

/* An archive with the final name `path`. ZP_MACHINE gives the reason why it cannot be written. */
ZpStatus zp_archive_open(const char *path, ZpArchive **out, ZpError *err);

/* Add a file of `size` bytes, which the archive frees in every case. NULL: there is no memory. */
ZpStatus zp_archive_add(ZpArchive *archive, const char *name, void *bytes, size_t size, ZpError *err);

/* If `status` is ZP_OK, bring it to the disk under its name; otherwise leave nothing. Frees it. */
ZpStatus zp_archive_close(ZpArchive *archive, ZpStatus status, ZpError *err);

#endif
