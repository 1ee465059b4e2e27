/* Folders and files of the kit. */
#include "fmupack/kit.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/fail.h"
#include "io/file.h"

static bool add(ZpKit *names, char *name) {
  char **item = name ? realloc(names->item, (names->count + 1) * sizeof *item) : NULL;
  if (!item) {
    free(name);
    return false;
  }
  names->item = item;
  names->item[names->count++] = name;
  return true;
}

static ZpStatus walk(const char *root, const char *below, ZpKit *names, ZpError *err);

/* The path of `name` in folder `below` of the root, which is "" for the root itself. */
static ZpStatus visit(const char *root, const char *below, const char *name, ZpKit *names, ZpError *err) {
  struct stat info;
  char *inner = *below ? zp_path_join(below, name) : strdup(name), *path = inner ? zp_path_join(root, inner) : NULL;
  ZpStatus status = ZP_OK;
  if (path && stat(path, &info) != 0)
    status = zp_fail(err, ZP_MACHINE, "%.300s: cannot be read: %s", path, strerror(errno));
  else if (path && S_ISDIR(info.st_mode))
    status = walk(root, inner, names, err);
  else if (!path || !add(names, strdup(inner)))
    status = zp_fail_memory(err);
  free(inner);
  free(path);
  return status;
}

static ZpStatus walk(const char *root, const char *below, ZpKit *names, ZpError *err) {
  struct dirent **entry;
  char *path = *below ? zp_path_join(root, below) : strdup(root);
  if (!path) return zp_fail_memory(err);
  int count = scandir(path, &entry, NULL, alphasort);
  ZpStatus status = count < 0 ? zp_fail(err, ZP_MACHINE, "%.300s: cannot be read: %s", path, strerror(errno)) : ZP_OK;
  free(path);
  for (int k = 0; k < count; k++) {
    if (status == ZP_OK && entry[k]->d_name[0] != '.') status = visit(root, below, entry[k]->d_name, names, err);
    free(entry[k]);
  }
  if (count >= 0) free(entry);
  return status;
}

ZpStatus zp_kit_list(const char *folder, ZpKit *names, ZpError *err) {
  *names = (ZpKit){NULL, 0};
  return walk(folder, "", names, err);
}

void zp_kit_free(ZpKit *names) {
  for (size_t k = 0; k < names->count; k++)
    free(names->item[k]);
  free(names->item);
  *names = (ZpKit){NULL, 0};
}
