/* Scripts of pictures, and the files that they read. */
#include "io/drawing.h"

#include <zipact/version.h>

#include "base/fail.h"
#include "io/atomic.h"
#include "io/template.h"

/* Longest file name. */
enum { NAME_SIZE = 64 };

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
  status = zp_template_write(drawing->templates, picture->template, out.file, err);
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
