/* A folder for results, held by one run at a time. */
#include <stdlib.h>
#include <string.h>

#include <zipact/io.h>

#include "base/fail.h"
#include "io/file.h"
#include "io/lock.h"

#define LOCK_NAME ".zipact-lock"

/* Create every folder of the path, from the first on. */
static ZpStatus make_folders(const char *directory, ZpError *err) {
  if (!directory || !*directory) return zp_fail(err, ZP_MACHINE, "the name of the output folder is empty");
  char *path = strdup(directory);
  ZpStatus status = path ? ZP_OK : zp_fail_memory(err);
  for (char *slash = path ? strchr(path + 1, '/') : NULL; slash && status == ZP_OK; slash = strchr(slash + 1, '/')) {
    *slash = 0;
    status = zp_make_folder(path, err);
    *slash = '/';
  }
  if (status == ZP_OK) status = zp_make_folder(path, err);
  free(path);
  return status;
}

/* -- open and close -------------------------------------------------------------------------------- */

/* A file or folder that is written in place must not be a symbolic link, which could lead out of the folder. */
static ZpStatus check_places(const char *directory, ZpError *err) {
  static const char *const name[] = {
      "shapes", "plots", "runs", "journal.sqlite", "journal.sqlite-wal", "journal.sqlite-shm"};
  ZpStatus status = ZP_OK;
  for (size_t i = 0; i < sizeof name / sizeof name[0] && status == ZP_OK; i++)
    status = zp_check_place(directory, name[i], err);
  return status;
}

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

ZpStatus zp_folder_open(const char *directory, ZpFolder **out, ZpError *err) {
  *out = NULL;
  ZpStatus status = make_folders(directory, err);
  if (status == ZP_OK) status = check_places(directory, err);
  if (status != ZP_OK) return status;
  char *path = zp_path_join(directory, LOCK_NAME);
  status = path ? zp_lock_take(path, directory, out, err) : zp_fail_memory(err);
  free(path);
  if (status == ZP_OK && zp_lock_held(*out)) status = clean(directory, err);
  if (status == ZP_OK) return ZP_OK;
  zp_folder_close(*out);
  *out = NULL;
  return status;
}
