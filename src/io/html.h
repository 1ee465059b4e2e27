/* Pieces of HTML: text with what it must escape, numbers as people write them, pictures inside the page. */
#ifndef ZP_IO_HTML_H
#define ZP_IO_HTML_H

#include <stdbool.h>
#include <stdio.h>

/* Write text so that it shows as it is, in an element or in a quoted attribute. */
void zp_html_text(FILE *file, const char *text);

/* Write the decimal number `text` with a real minus and powers of ten: "-2.4e4" as −2.4·10⁴. */
void zp_html_number(FILE *file, const char *text);

/* Copy the SVG picture `path` into the page, described by `label`. Its ids, and what refers to them, get `prefix`, so
 * that several pictures do not disturb each other. False if there is none. */
bool zp_html_svg(FILE *file, const char *path, const char *prefix, const char *label);

#endif
