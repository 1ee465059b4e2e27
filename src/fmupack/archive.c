/* ZIP archives, by libzip. */
#include "fmupack/archive.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include <zip.h>

#include "base/fail.h"
#include "io/file.h"

struct ZpArchive {
  zip_t *zip;
  ZpAtomic file;
};

static ZpStatus reserve(const char *path, ZpAtomic *file, ZpError *err) {
  const char *slash = strrchr(path, '/');
  char *folder = slash ? strndup(path, slash == path ? 1 : (size_t)(slash - path)) : strdup(".");
  if (!folder) return zp_fail_memory(err);
  ZpStatus status = zp_atomic_reserve(file, folder, slash ? slash + 1 : path, err);
  free(folder);
  return status;
}

ZpStatus zp_archive_open(const char *path, ZpArchive **out, ZpError *err) {
  int reason = 0;
  *out = NULL;
  ZpArchive *archive = calloc(1, sizeof *archive);
  if (!archive) return zp_fail_memory(err);
  ZpStatus status = reserve(path, &archive->file, err);
  if (status != ZP_OK) {
    free(archive);
    return status;
  }
  archive->zip = zip_open(archive->file.temporary, ZIP_CREATE | ZIP_TRUNCATE, &reason);
  if (!archive->zip) {
    zp_atomic_abandon(&archive->file);
    free(archive);
    return zp_fail(err, ZP_MACHINE, "cannot write %.300s (libzip error %d)", path, reason);
  }
  *out = archive;
  return ZP_OK;
}

static ZpStatus fail_zip(ZpArchive *archive, const char *name, ZpError *err) {
  return zp_fail(err, ZP_MACHINE, "cannot write %.300s: %.150s", name, zip_strerror(archive->zip));
}

ZpStatus zp_archive_add(ZpArchive *archive, const char *name, void *bytes, size_t size, ZpError *err) {
  enum { JANUARY_1980 = 0x21, UNIX_FILE = 3 };
  static const zip_uint32_t executable = 0100755U << 16;
  if (!bytes) return zp_fail_memory(err);
  zip_source_t *source = zip_source_buffer(archive->zip, bytes, size, 1);
  if (!source) {
    free(bytes);
    return fail_zip(archive, name, err);
  }
  zip_int64_t index = zip_file_add(archive->zip, name, source, ZIP_FL_ENC_UTF_8);
  if (index < 0) {
    zip_source_free(source);
    return fail_zip(archive, name, err);
  }
  bool made = zip_file_set_dostime(archive->zip, (zip_uint64_t)index, 0, JANUARY_1980, 0) == 0 &&
              zip_file_set_external_attributes(archive->zip, (zip_uint64_t)index, 0, UNIX_FILE, executable) == 0;
  return made ? ZP_OK : fail_zip(archive, name, err);
}

ZpStatus zp_archive_close(ZpArchive *archive, ZpStatus status, ZpError *err) {
  if (status == ZP_OK && zip_close(archive->zip) != 0) status = fail_zip(archive, archive->file.path, err);
  if (status == ZP_OK)
    status = zp_atomic_commit(&archive->file, err);
  else {
    zip_discard(archive->zip);
    zp_atomic_abandon(&archive->file);
  }
  free(archive);
  return status;
}
