/* What the command and libfyaml use of POSIX and glibc and the C library of Windows lacks. Included before every file
 * of theirs (-include); the headers of windows/include/ lead here. */
#ifndef ZP_WINDOWS_POSIX_H
#define ZP_WINDOWS_POSIX_H

#include <dirent.h>
#include <fcntl.h>
#include <io.h>
#include <malloc.h>
#include <pthread.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

/* -- texts ------------------------------------------------------------------------------------------ */
char *strndup(const char *text, size_t length);
char *strsep(char **text, const char *separators);
void *memmem(const void *hay, size_t size, const void *needle, size_t length);
ssize_t getline(char **line, size_t *room, FILE *file);

/* -- streams: those whose text goes elsewhere are temporary files until they are closed -------------- */
typedef struct cookie_io_functions_t {
  ssize_t (*write)(void *cookie, const char *data, size_t size);
} cookie_io_functions_t;
FILE *open_memstream(char **text, size_t *size);
FILE *fmemopen(void *text, size_t size, const char *mode);
FILE *fopencookie(void *cookie, const char *mode, cookie_io_functions_t functions);
int zp_windows_fclose(FILE *file);
FILE *zp_windows_fopen(const char *path, const char *mode);
#define fclose                   zp_windows_fclose
#define fopen                    zp_windows_fopen
#define FSETLOCKING_BYCALLER     0
#define __fsetlocking(file, how) ((void)(file))

/* -- files ------------------------------------------------------------------------------------------ */
#define O_CLOEXEC          O_NOINHERIT
#define O_NOFOLLOW         0
#define lstat              stat
#define S_ISLNK(mode)      0
#define realpath(path, to) _fullpath(to, path, 0)
#define mkdir(path, mode)  mkdir(path)
#define rename             zp_windows_rename
#define getcwd             zp_windows_getcwd
int zp_windows_rename(const char *from, const char *to);
char *zp_windows_getcwd(char *buffer, int size);
#define _SC_PAGESIZE  0
#define sysconf(name) 4096
int fsync(int file);
ssize_t readlink(const char *path, char *target, size_t size); /* of /proc/self/exe only */
int scandir(const char *folder, struct dirent ***entry, int (*chosen)(const struct dirent *),
            int (*order)(const struct dirent **, const struct dirent **));
int alphasort(const struct dirent **a, const struct dirent **b);

/* -- memory ----------------------------------------------------------------------------------------- */
#define PROT_READ     1
#define PROT_WRITE    2
#define MAP_PRIVATE   2
#define MAP_ANONYMOUS 0x20
#define MAP_FAILED    ((void *)-1)
void *mmap(void *at, size_t size, int protection, int flags, int file, long long offset); /* anonymous only */
int munmap(void *memory, size_t size);

/* -- threads: they can wait until a time of this clock only -------------------------------------------- */
#undef CLOCK_MONOTONIC
#define CLOCK_MONOTONIC                              CLOCK_REALTIME
#define pthread_condattr_setclock(attributes, clock) ((void)(attributes), 0)

/* -- signals: Ctrl-C ---------------------------------------------------------------------------------- */
#define SA_RESTART 0
struct sigaction {
  void (*sa_handler)(int signal_number);
  int sa_flags;
};
#define sigaction(number, action, before) signal(number, (action)->sa_handler)

/* -- locales: the command never leaves the one of C ----------------------------------------------------- */
typedef int locale_t;
#define LC_ALL_MASK                 0
#define LC_NUMERIC_MASK             0
#define newlocale(mask, name, base) 1
#define freelocale(locale)          ((void)(locale))
#define strtod_l(text, end, locale) ((void)(locale), strtod(text, end))
static inline locale_t uselocale(locale_t locale) {
  return locale;
}

#endif
