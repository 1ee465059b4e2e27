/* Drawing pictures: a folder with a script NAME.gp for each, and gnuplot, which makes NAME.svg or NAME.gif of it. */
#ifndef ZP_IO_DRAWING_H
#define ZP_IO_DRAWING_H

#include <stdbool.h>
#include <stdio.h>

#include <zipact/io.h>

typedef struct ZpPicture {
  char name[48], extension[8]; /* "stroke", "svg" */
  const char *template;        /* "stroke.gp" */
} ZpPicture;

/* Wall time after which gnuplot counts as hanging, s. The animation takes 4 s on an idle machine. */
#define ZP_DRAWING_PATIENCE 60.0

typedef struct ZpDrawing {
  char *folder;                        /* where the pictures are */
  const char *templates;               /* folder of templates that replace those built in; NULL: none */
  void (*notice)(const char *message); /* NULL: silent */
  double patience;                     /* ZP_DRAWING_PATIENCE, s */
  const ZpHooks *hooks;                /* called while gnuplot runs: true ends it. May be NULL */
  int jobs;                            /* pictures drawn at once; 0: as many as there are processors */
  bool over;                           /* no more pictures: there is no gnuplot, it hangs, or a hook ended it */
} ZpDrawing;

/* Write the script of a picture: it loads the definitions in result.gp, then has the text of the template. */
ZpStatus zp_drawing_script(const ZpDrawing *drawing, const ZpPicture *picture, ZpError *err);

/* Write a file that scripts read, such as result.gp, by put(user, file). */
ZpStatus zp_drawing_file(const ZpDrawing *drawing, const char *name, void (*put)(const void *user, FILE *file),
                         const void *user, ZpError *err);

/* Remove the script of an earlier report, its picture and the pixels in it. */
ZpStatus zp_drawing_remove(const ZpDrawing *drawing, const ZpPicture *picture, ZpError *err);

/* Draw `count` pictures by their scripts. A picture that gnuplot cannot draw is no failure: its script stays, and the
 * notice gives the reason. */
void zp_drawing_draw(ZpDrawing *drawing, const ZpPicture *picture, size_t count);

/* -- templates --------------------------------------------------------------------------------------- */

/* One that is built in. */
typedef struct ZpTemplate {
  const char *name; /* "stroke.gp" */
  const char *text;
} ZpTemplate;

/* All of them, from plots/ when this was built; the last has no name. */
extern const ZpTemplate zp_templates[];

/* Rewrite a complaint of gnuplot about a script in `folder`, `"stroke.gp" line 80: ...`, so that it names the template
 * and its line: `template stroke.gp, line 12: ...`. A complaint about a line that no template has stays as it is. */
void zp_template_complaint(const char *folder, const char *script, char *reason, size_t size);

#endif
