/* Instead of src/io/lock.c: a file that is open for writing and shared for reading only. Windows removes it when it is
 * closed, also if its process is killed. */
#include "io/lock.h"

#include <stdio.h>
#include <stdlib.h>
#include <windows.h>

#include "base/fail.h"
#include "io/source.h"

struct ZpFolder {
  HANDLE file;
};

static const DWORD readers = FILE_SHARE_READ | FILE_SHARE_DELETE;

/* The holder: "process 4711". */
static ZpStatus fail_held(const char *path, const char *directory, ZpError *err) {
  char who[128] = "another process";
  DWORD length = 0;
  HANDLE file = CreateFileA(path, GENERIC_READ, readers | FILE_SHARE_WRITE, NULL, OPEN_EXISTING, 0, NULL);
  if (file != INVALID_HANDLE_VALUE) {
    if (ReadFile(file, who, sizeof who - 1, &length, NULL) && length > 0) who[length] = 0;
    CloseHandle(file);
  }
  zp_text_clean(who);
  return zp_fail(err, ZP_MACHINE, "cannot write results to %.300s: %s is writing there", directory, who);
}

static bool sign(HANDLE file) {
  char self[64];
  DWORD written = 0;
  const int length = snprintf(self, sizeof self, "process %lu", GetCurrentProcessId());
  return WriteFile(file, self, (DWORD)length, &written, NULL) && written == (DWORD)length;
}

ZpStatus zp_lock_take(const char *path, const char *directory, ZpFolder **out, ZpError *err) {
  HANDLE file =
      CreateFileA(path, GENERIC_WRITE | DELETE, readers, NULL, CREATE_ALWAYS, FILE_FLAG_DELETE_ON_CLOSE, NULL);
  *out = NULL;
  if (file == INVALID_HANDLE_VALUE && GetLastError() == ERROR_SHARING_VIOLATION) return fail_held(path, directory, err);
  if (file == INVALID_HANDLE_VALUE || !sign(file)) {
    const unsigned long error = GetLastError();
    if (file != INVALID_HANDLE_VALUE) CloseHandle(file);
    return zp_fail(err, ZP_MACHINE, "cannot write %s: error %lu of Windows", path, error);
  }
  *out = calloc(1, sizeof **out);
  if (*out) {
    (*out)->file = file;
    return ZP_OK;
  }
  CloseHandle(file);
  return zp_fail_memory(err);
}

bool zp_lock_held(const ZpFolder *folder) {
  return folder != NULL;
}

void zp_folder_close(ZpFolder *folder) {
  if (folder) CloseHandle(folder->file);
  free(folder);
}
