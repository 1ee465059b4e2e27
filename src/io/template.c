/* Templates of pictures as parts of scripts. A comment "#line 12 stroke.gp" in a script names the template of the lines
 * after it. */
#include "io/template.h"

#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <zipact/io.h>

#include "base/fail.h"
#include "io/atomic.h"

/* Largest depth of templates that load each other: more are a circle, and gnuplot reports it. Longest name of a
 * template, and longest line of a script that may be a mark. */
enum { NESTED_MOST = 8, NAME_SIZE = 64, LINE_SIZE = 4096 };

/* A stream of the user's own template, with its path, or of the one that is built in; NULL with errno and the path if
 * there is none. The path is to be freed. */
static FILE *open_template(const char *folder, const char *name, char **path) {
  *path = folder ? zp_path_join(folder, name) : NULL;
  FILE *file = *path ? fopen(*path, "re") : NULL;
  if (file || (*path && errno != ENOENT)) return file;
  const ZpTemplate *one = zp_templates;
  while (one->name && strcmp(one->name, name) != 0)
    one++;
  free(*path);
  *path = strdup(name);
  errno = ENOENT;
  return one->name ? fmemopen((void *)one->text, strlen(one->text), "r") : NULL;
}

/* Does the line load another file: is it "load 'NAME'"? => its name. */
static bool is_load(const char *line, char name[NAME_SIZE]) {
  int end = 0;
  return sscanf(line, " load '%63[^'/]'%n", name, &end) == 1 && end > 0 &&
         line[end + (int)strspn(line + end, " \t\r\n")] == 0;
}

/* A line that loads what is no template stays. */
static ZpStatus write_nested(const char *folder, const char *name, int depth, FILE *script, ZpError *err) {
  char *path, *line = NULL, loaded[NAME_SIZE];
  size_t room = 0;
  FILE *file = open_template(folder, name, &path);
  ZpStatus status = file ? ZP_OK : zp_fail(err, ZP_MACHINE, "cannot read the template %s: %s", path, strerror(errno));
  if (!file && errno == ENOENT && depth > 1) {
    status = ZP_OK;
    fprintf(script, "load '%s'\n", name);
  }
  if (file) fprintf(script, "#line 1 %s\n", path);
  for (int number = 1; file && status == ZP_OK && getline(&line, &room, file) > 0; number++) {
    if (depth < NESTED_MOST && is_load(line, loaded)) {
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

/* The template and the line in it of line `wanted` of a script; false if it is of none. */
static bool find_line(FILE *script, long wanted, char path[LINE_SIZE], long *line) {
  char text[LINE_SIZE];
  bool found = false, whole = true;
  for (long at = 0; at < wanted && fgets(text, sizeof text, script);) {
    at += whole;
    *line += whole;
    if (whole && sscanf(text, "#line %ld %4095[^\n]", line, path) == 2) {
      found = true;
      --*line; /* it is of the line after the mark */
    }
    whole = strchr(text, '\n') != NULL;
  }
  return found;
}

void zp_template_complaint(const char *folder, const char *script, char *reason, size_t size) {
  char *copy = strdup(reason), *path = zp_path_join(folder, script), template[LINE_SIZE];
  FILE *file = path ? fopen(path, "re") : NULL;
  long wanted = 0, line = 0;
  int end = 0;
  if (copy && file && sscanf(copy, "\"%*[^\"]\" line %ld:%n", &wanted, &end) == 1 && end > 0 &&
      find_line(file, wanted, template, &line))
    snprintf(reason, size, "template %s, line %ld:%s", template, line, copy + end);
  if (file) fclose(file);
  free(path);
  free(copy);
}

/* -- for users ------------------------------------------------------------------------------------- */

static ZpStatus write_one(const char *folder, const ZpTemplate *one, ZpError *err) {
  char *path = zp_path_join(folder, one->name);
  if (!path) return zp_fail_memory(err);
  ZpStatus status = ZP_OK;
  FILE *file = fopen(path, "wxe");
  const bool exists = !file && errno == EEXIST;
  bool written = file && fputs(one->text, file) >= 0;
  if (file) written &= fclose(file) == 0;
  if (exists)
    status = zp_fail(err, ZP_BAD_INPUT, "%s: exists already and may have been edited; give another folder", path);
  else if (!written)
    status = zp_fail(err, ZP_MACHINE, "%s: cannot be written: %s", path, strerror(errno));
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
