/* See posix.h. */
#include "posix.h"

#include <errno.h>
#include <pthread.h>
#include <windows.h>

#undef fclose
#undef fopen
#undef rename
#undef getcwd

int zp_windows_main(int count, char **word); /* main of the command */

/* Files hold what is written to them, without carriage returns; the console shows UTF-8; paths have slashes. */
int main(int count, char **word) {
  _fmode = _O_BINARY;
  for (int file = 0; file < 3; file++)
    _setmode(file, _O_BINARY);
  SetConsoleOutputCP(CP_UTF8);
  for (int i = 1; i < count; i++)
    for (char *c = word[i]; *c; c++)
      if (*c == '\\') *c = '/';
  return zp_windows_main(count, word);
}

/* -- texts ------------------------------------------------------------------------------------------ */

char *strndup(const char *text, size_t length) {
  const size_t size = strnlen(text, length);
  char *copy = malloc(size + 1);
  if (!copy) return NULL;
  memcpy(copy, text, size);
  copy[size] = 0;
  return copy;
}

char *strsep(char **text, const char *separators) {
  char *part = *text, *end = part ? part + strcspn(part, separators) : NULL;
  *text = end && *end ? end + 1 : NULL;
  if (*text) *end = 0;
  return part;
}

void *memmem(const void *hay, size_t size, const void *needle, size_t length) {
  for (const char *at = hay; length <= size; at++, size--)
    if (memcmp(at, needle, length) == 0) return (void *)at;
  return NULL;
}

ssize_t getline(char **line, size_t *room, FILE *file) {
  size_t used = 0;
  for (int c = fgetc(file); c != EOF; c = fgetc(file)) {
    if (used + 2 > *room || !*line) {
      char *more = realloc(*line, 2 * used + 120);
      if (!more) return -1;
      *line = more;
      *room = 2 * used + 120;
    }
    (*line)[used++] = (char)c;
    if (c == '\n') break;
  }
  if (used > 0) (*line)[used] = 0;
  return used > 0 ? (ssize_t)used : -1;
}

/* -- streams ---------------------------------------------------------------------------------------- */

/* What becomes of the text of a stream when it is closed: it goes to a function, or to memory. */
typedef struct Stream {
  FILE *file;
  void *cookie;
  ssize_t (*write)(void *cookie, const char *data, size_t size);
  char **text;
  size_t *size;
  struct Stream *next;
} Stream;

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static Stream *streams; /* guarded by `lock` */

/* It ends with its stream. */
static FILE *temporary_file(void) {
  char folder[MAX_PATH + 1], path[MAX_PATH + 1];
  if (!GetTempPathA(sizeof folder, folder) || !GetTempFileNameA(folder, "zip", 0, path)) return NULL;
  return fopen(path, "w+bTD");
}

static FILE *open_stream(Stream stream) {
  Stream *own = malloc(sizeof *own);
  stream.file = own ? temporary_file() : NULL;
  if (!stream.file) {
    free(own);
    return NULL;
  }
  *own = stream;
  pthread_mutex_lock(&lock);
  own->next = streams;
  streams = own;
  pthread_mutex_unlock(&lock);
  return own->file;
}

FILE *open_memstream(char **text, size_t *size) {
  *text = NULL;
  *size = 0;
  return open_stream((Stream){.text = text, .size = size});
}

FILE *fopencookie(void *cookie, const char *mode, cookie_io_functions_t functions) {
  (void)mode;
  return open_stream((Stream){.cookie = cookie, .write = functions.write});
}

FILE *fmemopen(void *text, size_t size, const char *mode) {
  (void)mode;
  FILE *file = temporary_file();
  if (!file) return NULL;
  if (fwrite(text, 1, size, file) == size && fflush(file) == 0) {
    rewind(file);
    return file;
  }
  fclose(file);
  return NULL;
}

static Stream *take_stream(const FILE *file) {
  pthread_mutex_lock(&lock);
  Stream **at = &streams, *found;
  while (*at && (*at)->file != file)
    at = &(*at)->next;
  found = *at;
  if (found) *at = found->next;
  pthread_mutex_unlock(&lock);
  return found;
}

/* The whole text of the stream => its length, -1 if it cannot be had. */
static long long read_all(FILE *file, char **text) {
  const long long size = fflush(file) == 0 ? _ftelli64(file) : -1;
  *text = size >= 0 ? malloc((size_t)size + 1) : NULL;
  if (!*text) return -1;
  rewind(file);
  (*text)[size] = 0;
  return fread(*text, 1, (size_t)size, file) == (size_t)size ? size : -1;
}

int zp_windows_fclose(FILE *file) {
  Stream *stream = take_stream(file);
  if (!stream) return fclose(file);
  char *text;
  long long size = read_all(file, &text);
  int bad = size < 0 || ferror(file);
  if (!bad && stream->write) bad = stream->write(stream->cookie, text, (size_t)size) != size;
  if (!bad && stream->text) {
    *stream->text = text;
    *stream->size = (size_t)size;
  } else {
    free(text);
  }
  free(stream);
  return fclose(file) != 0 || bad ? EOF : 0;
}

/* Without the letter e (close in children), which it does not know. */
FILE *zp_windows_fopen(const char *path, const char *mode) {
  char known[8] = "";
  for (size_t used = 0; *mode && used + 1 < sizeof known; mode++)
    if (*mode != 'e') known[used++] = *mode;
  return fopen(path, known);
}

/* -- files ------------------------------------------------------------------------------------------ */

int zp_windows_rename(const char *from, const char *to) {
  if (MoveFileExA(from, to, MOVEFILE_REPLACE_EXISTING)) return 0;
  errno = GetLastError() == ERROR_FILE_NOT_FOUND ? ENOENT : EACCES;
  return -1;
}

char *zp_windows_getcwd(char *buffer, int size) {
  char *path = _getcwd(buffer, size);
  for (char *c = path; c && *c; c++)
    if (*c == '\\') *c = '/';
  return path;
}

/* A file that another program wrote is open for reading only, and cannot be flushed. */
int fsync(int file) {
  if (FlushFileBuffers((HANDLE)_get_osfhandle(file)) || GetLastError() == ERROR_ACCESS_DENIED) return 0;
  errno = EIO;
  return -1;
}

ssize_t readlink(const char *path, char *target, size_t size) {
  if (strcmp(path, "/proc/self/exe") != 0) {
    errno = EINVAL;
    return -1;
  }
  const DWORD length = GetModuleFileNameA(NULL, target, (DWORD)size);
  for (DWORD i = 0; i < length; i++)
    if (target[i] == '\\') target[i] = '/';
  return length > 0 && length < size ? (ssize_t)length : -1;
}

int alphasort(const struct dirent **a, const struct dirent **b) {
  return strcmp((*a)->d_name, (*b)->d_name);
}

static struct dirent *copy_entry(const struct dirent *entry) {
  struct dirent *copy = malloc(sizeof *copy);
  if (copy) *copy = *entry;
  return copy;
}

int scandir(const char *folder, struct dirent ***entry, int (*chosen)(const struct dirent *),
            int (*order)(const struct dirent **, const struct dirent **)) {
  int count = 0;
  DIR *list = opendir(folder);
  if (!list) return -1;
  *entry = NULL;
  for (struct dirent *next = readdir(list); next && count >= 0; next = readdir(list)) {
    if (chosen && !chosen(next)) continue;
    struct dirent **more = realloc(*entry, ((size_t)count + 1) * sizeof *more);
    if (more) *entry = more;
    if (more && (more[count] = copy_entry(next)) != NULL) {
      count++;
      continue;
    }
    while (count > 0)
      free((*entry)[--count]);
    free(*entry);
    *entry = NULL;
    count = -1;
    errno = ENOMEM;
  }
  closedir(list);
  if (count > 0) qsort(*entry, (size_t)count, sizeof **entry, (int (*)(const void *, const void *))order);
  return count;
}

/* -- memory ----------------------------------------------------------------------------------------- */

void *mmap(void *at, size_t size, int protection, int flags, int file, long long offset) {
  (void)at, (void)protection, (void)offset;
  void *memory = file < 0 && (flags & MAP_ANONYMOUS) ? VirtualAlloc(NULL, size, MEM_COMMIT, PAGE_READWRITE) : NULL;
  return memory ? memory : MAP_FAILED;
}

int munmap(void *memory, size_t size) {
  (void)size;
  return VirtualFree(memory, 0, MEM_RELEASE) ? 0 : -1;
}
