/* Templates: what a picture looks like, as text for gnuplot. Those of plots/ are built in; a file of the same name in a
 * folder of the user's takes the place of one. */
#ifndef ZP_IO_TEMPLATE_H
#define ZP_IO_TEMPLATE_H

#include <stdio.h>

#include <zipact/error.h>

/* One that is built in. */
typedef struct ZpTemplate {
  const char *name; /* "stroke.gp" */
  const char *text;
} ZpTemplate;

/* All of them, from plots/ when this was built; the last has no name. */
extern const ZpTemplate zp_templates[];

/* Write the template `name` to a script, with what it loads in place of the lines that load it: a script needs no other
 * template. `folder` is looked into first; NULL is none. ZP_MACHINE if a file there cannot be read. */
ZpStatus zp_template_write(const char *folder, const char *name, FILE *script, ZpError *err);

/* Rewrite a complaint of gnuplot about a script in `folder`, `"stroke.gp" line 80: ...`, so that it names the template
 * and its line: `template stroke.gp, line 12: ...`. A complaint about a line that no template has stays as it is. */
void zp_template_complaint(const char *folder, const char *script, char *reason, size_t size);

#endif
