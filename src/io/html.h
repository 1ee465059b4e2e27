/* Text in HTML and XML. */
#ifndef ZP_IO_HTML_H
#define ZP_IO_HTML_H

#include <stdio.h>

/* Write text with the necessary escapes, in an element or in a quoted attribute. */
void zp_html_text(FILE *file, const char *text);

#endif
