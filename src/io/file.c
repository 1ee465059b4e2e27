#include "io/file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
