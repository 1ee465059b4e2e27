/* Templates of pictures as parts of scripts. A comment "#line 12 stroke.gp" in a script names the template of the lines
 * after it. */
#include "io/template.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <zipact/io.h>

#include "base/fail.h"
#include "io/atomic.h"

/* Largest depth of templates that load each other: more are a circle, and gnuplot reports it. */
enum { NESTED_MOST = 8 };

/* Longest name of a template, and longest line of a script that may be a mark. */
enum { NAME_SIZE = 64, LINE_SIZE = 4096 };

static const ZpTemplate *find(const char *name) {
  const ZpTemplate *one = zp_templates;
  while (one->name && strcmp(one->name, name) != 0)
    one++;
  return one->name ? one : NULL;
}

/* The path of the user's own template, or the name of the one that is built in; to be freed. */
static char *where_is(const char *folder, const char *name) {
  char *path = *folder ? zp_path_join(folder, name) : strdup(name);
  if (!path || !*folder) return path;
  struct stat there;
  if (stat(path, &there) == 0 || errno != ENOENT) return path;
  free(path);
  return strdup(name);
}

/* A stream of the text at `path`, as where_is answers; NULL with errno if it cannot be read. */
static FILE *open_template(const char *path) {
  const ZpTemplate *built_in = find(path);
  return built_in ? fmemopen((void *)built_in->text, strlen(built_in->text), "r") : fopen(path, "re");
}

/* Does the line load a template: is it "load 'NAME'"? => its name. */
static bool is_load(const char *folder, const char *line, char name[NAME_SIZE]) {
  int end = 0;
  if (sscanf(line, " load '%63[^'/]'%n", name, &end) != 1 || end == 0) return false;
  if (line[end + (int)strspn(line + end, " \t\r\n")]) return false;
  if (find(name)) return true;
  char *path = where_is(folder, name);
  const bool own = path && strcmp(path, name) != 0;
  free(path);
  return own;
}

static ZpStatus write_nested(const char *folder, const char *name, int depth, FILE *script, ZpError *err) {
  char *path = where_is(folder, name), *line = NULL, loaded[NAME_SIZE];
  size_t room = 0;
  if (!path) return zp_fail_memory(err);
  FILE *file = open_template(path);
  ZpStatus status = file ? ZP_OK : zp_fail(err, ZP_MACHINE, "cannot read the template %s: %s", path, strerror(errno));
  if (file) fprintf(script, "#line 1 %s\n", path);
  for (int number = 1; status == ZP_OK && getline(&line, &room, file) > 0; number++) {
    if (depth < NESTED_MOST && is_load(folder, line, loaded)) {
      status = write_nested(folder, loaded, depth + 1, script, err);
      fprintf(script, "#line %d %s\n", number + 1, path);
    } else {
      fprintf(script, "%s%s", line, strchr(line, '\n') ? "" : "\n");
    }
  }
  free(line);
  free(path);
  if (file) fclose(file);
  return status;
}

ZpStatus zp_template_write(const char *folder, const char *name, FILE *script, ZpError *err) {
  return write_nested(folder, name, 1, script, err);
}

/* Which line of which template a line of a script is; false if it is of none. */
static bool find_line(const char *script, long wanted, char path[LINE_SIZE], long *line) {
  char text[LINE_SIZE];
  bool found = false, whole = true;
  FILE *file = fopen(script, "re");
  for (long at = 0; file && at < wanted && fgets(text, sizeof text, file);) {
    at += whole;
    *line += whole;
    if (whole && sscanf(text, "#line %ld %4095[^\n]", line, path) == 2) {
      found = true;
      --*line; /* it is of the line after the mark */
    }
    whole = strchr(text, '\n') != NULL;
  }
  if (file) fclose(file);
  return found;
}

void zp_template_complaint(const char *script, char *reason, size_t size) {
  char *copy = strdup(reason);
  long wanted = 0, line = 0;
  int end = 0;
  if (copy && sscanf(copy, "\"%*[^\"]\" line %ld:%n", &wanted, &end) == 1 && end > 0) {
    char path[LINE_SIZE];
    if (find_line(script, wanted, path, &line))
      snprintf(reason, size, "template %s, line %ld:%s", path, line, copy + end);
  }
  free(copy);
}

/* -- for users ------------------------------------------------------------------------------------- */

static ZpStatus write_text(const char *path, const char *text, ZpError *err) {
  FILE *file = fopen(path, "wxe");
  if (!file && errno == EEXIST)
    return zp_fail(err, ZP_BAD_INPUT, "%s: exists already and may have been edited; give another folder", path);
  if (!file) return zp_fail(err, ZP_MACHINE, "%s: cannot be written: %s", path, strerror(errno));
  const bool written = fputs(text, file) >= 0;
  if (fclose(file) == 0 && written) return ZP_OK;
  return zp_fail(err, ZP_MACHINE, "%s: cannot be written: %s", path, strerror(errno));
}

static ZpStatus write_one(const char *folder, const ZpTemplate *one, ZpError *err) {
  char *path = zp_path_join(folder, one->name);
  if (!path) return zp_fail_memory(err);
  ZpStatus status = write_text(path, one->text, err);
  free(path);
  return status;
}

ZpStatus zp_templates_write(const char *folder, ZpError *err) {
  ZpStatus status = ZP_OK;
  if (mkdir(folder, 0777) != 0 && errno != EEXIST)
    status = zp_fail(err, ZP_MACHINE, "%s: cannot be created: %s", folder, strerror(errno));
  for (const ZpTemplate *one = zp_templates; one->name && status == ZP_OK; one++)
    status = write_one(folder, one, err);
  return status;
}
