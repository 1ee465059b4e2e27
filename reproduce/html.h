/* Pieces of the page: typeset numbers, embedded pictures. */
#ifndef ZP_REPRODUCE_HTML_H
#define ZP_REPRODUCE_HTML_H

#include <stdbool.h>
#include <stdio.h>

/* Write the decimal number `text` with a minus sign and powers of ten: "-2.4e4" as −2.4·10⁴. */
void zp_html_number(FILE *file, const char *text);

/* Copy the SVG picture `path` into the page, with the description `label`. Its ids and their references get `prefix`,
 * so that several pictures do not conflict. False if the picture does not exist. */
bool zp_html_svg(FILE *file, const char *path, const char *prefix, const char *label);

#endif
