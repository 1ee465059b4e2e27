/* Templates of pictures as parts of scripts. A comment "#line 12 stroke.gp" in a script names the template of the lines
 * after it. */
#include "io/drawing.h"

#include <errno.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <zipact/io.h>
#include <zipact/version.h>

#include "base/fail.h"
#include "io/file.h"

/* Largest depth of templates that load each other: more are a circle, and gnuplot reports it. Longest name of a
 * template, and longest line of a script that may be a mark. */
enum { NESTED_MOST = 8, NAME_SIZE = 64, LINE_SIZE = 4096 };

/* The text of a template: the user's own one, with its path, or the one that is built in. NULL in *text: there is none
 * of that name. *own and *path are to be freed. ZP_MACHINE if the user's own one cannot be read. */
static ZpStatus find_text(const char *folder, const char *name, char **own, const char **text, char **path,
                          ZpError *err) {
  size_t size;
  ZpError reason;
  *own = NULL;
  *path = folder ? zp_path_join(folder, name) : NULL;
  if (*path && (access(*path, F_OK) == 0 || errno != ENOENT)) {
    if (zp_file_read(*path, SIZE_MAX / 2, own, &size, &reason) != ZP_OK)
      return zp_fail(err, ZP_MACHINE, "cannot read the template %s", reason.message);
    *text = *own;
    return ZP_OK;
  }
  const ZpTemplate *one = zp_templates;
  while (one->name && strcmp(one->name, name) != 0)
    one++;
  free(*path);
  *path = strdup(name);
  *text = one->text;
  return *path ? ZP_OK : zp_fail_memory(err);
}

/* Does the line of `length` bytes load another file: is it "load 'NAME'"? => its name. */
static bool is_load(const char *line, size_t length, char name[NAME_SIZE]) {
  int end = 0;
  if (sscanf(line, " load '%63[^'/]'%n", name, &end) != 1 || end == 0) return false;
  return (size_t)end + strspn(line + end, " \t\r\n") >= length;
}

/* Write the template `name` to a script, with what it loads in place of the lines that load it: a script needs no other
 * template. A line that loads what is no template stays. `folder` is looked into first; NULL is none. The script's own
 * template has depth 1. ZP_MACHINE if a file of `folder` cannot be read. */
static ZpStatus write_template(const char *folder, const char *name, int depth, FILE *script, ZpError *err) {
  const char *text = NULL;
  char *path, *own, loaded[NAME_SIZE];
  ZpStatus status = find_text(folder, name, &own, &text, &path, err);
  if (status == ZP_OK && !text && depth == 1)
    status = zp_fail(err, ZP_MACHINE, "cannot read the template %s: %s", name, strerror(ENOENT));
  else if (status == ZP_OK)
    fprintf(script, text ? "#line 1 %s\n" : "load '%s'\n", path);
  size_t length;
  for (int number = 2; text && *text && status == ZP_OK; number++, text += length) {
    length = strcspn(text, "\n") + 1;
    if (depth < NESTED_MOST && is_load(text, length, loaded)) {
      status = write_template(folder, loaded, depth + 1, script, err);
      fprintf(script, "#line %d %s\n", number, path);
    } else {
      fprintf(script, "%.*s\n", (int)length - 1, text);
    }
    length -= text[length - 1] == 0;
  }
  free(path);
  free(own);
  return status;
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
  ZpStatus status = zp_make_folder(folder, err);
  for (const ZpTemplate *one = zp_templates; one->name && status == ZP_OK; one++)
    status = write_one(folder, one, err);
  return status;
}

/* -- scripts and the files that they read ------------------------------------------------------------ */

ZpStatus zp_drawing_script(const ZpDrawing *drawing, const ZpPicture *picture, ZpError *err) {
  ZpAtomic out;
  char name[NAME_SIZE];
  snprintf(name, sizeof name, "%s.gp", picture->name);
  ZpStatus status = zp_atomic_open(&out, drawing->folder, name, err);
  if (status != ZP_OK) return status;
  fprintf(out.file,
          "# Made by zipact " ZP_VERSION "; draw again with: gnuplot %s\n"
          "if (!exists('out')) out = '%s.%s'\nload 'result.gp'\n",
          name, picture->name, picture->extension);
  status = write_template(drawing->templates, picture->template, 1, out.file, err);
  return zp_atomic_finish(&out, status, err);
}

ZpStatus zp_drawing_file(const ZpDrawing *drawing, const char *name, void (*put)(const void *user, FILE *file),
                         const void *user, ZpError *err) {
  ZpAtomic out;
  ZpStatus status = zp_atomic_open(&out, drawing->folder, name, err);
  if (status != ZP_OK) return status;
  put(user, out.file);
  return zp_atomic_commit(&out, err);
}

ZpStatus zp_drawing_remove(const ZpDrawing *drawing, const ZpPicture *picture, ZpError *err) {
  const char *const extension[] = {"gp", "png", picture->extension};
  ZpStatus status = ZP_OK;
  for (size_t i = 0; i < 3 && status == ZP_OK; i++) {
    char name[NAME_SIZE];
    snprintf(name, sizeof name, "%s.%s", picture->name, extension[i]);
    status = zp_remove_file(drawing->folder, name, err);
  }
  return status;
}
