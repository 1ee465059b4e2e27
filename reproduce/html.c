/* Pieces of the page. */
#include "reproduce/html.h"

#include <stdlib.h>
#include <string.h>

#include "io/file.h"

void zp_html_number(FILE *file, const char *text) {
  const char *exponent = strchr(text, 'e');
  for (const char *c = text; *c && c != exponent; c++)
    fputs(*c == '-' ? "−" : (const char[2]){*c, 0}, file);
  if (exponent) {
    int power = atoi(exponent + 1);
    fprintf(file, "·10<sup>%s%d</sup>", power < 0 ? "−" : "", abs(power));
  }
}

/* Copy a line, and insert the prefix in each id and each reference to one. */
static void put_line(FILE *file, const char *line, const char *prefix) {
  static const char *const mark[] = {" id='", " id=\"", "href='#", "href=\"#", "url(#"};
  while (*line) {
    size_t length = 0;
    for (size_t i = 0; i < sizeof mark / sizeof mark[0] && length == 0; i++)
      if (strncmp(line, mark[i], strlen(mark[i])) == 0) length = strlen(mark[i]);
    if (length > 0)
      fprintf(file, "%.*s%s-", (int)length, line, prefix);
    else
      fputc(*line, file);
    line += length > 0 ? length : 1;
  }
}

bool zp_html_svg(FILE *file, const char *path, const char *prefix, const char *label) {
  char *line = NULL;
  size_t size = 0;
  bool inside = false;
  FILE *picture = fopen(path, "re");
  if (!picture) return false;
  while (getline(&line, &size, picture) >= 0) {
    if (!inside && strncmp(line, "<svg", 4) == 0) { /* the part before it belongs to a separate file only */
      inside = true;
      fputs("<svg role=\"img\" aria-label=\"", file);
      zp_html_text(file, label);
      fputs("\"", file);
      put_line(file, line + 4, prefix);
    } else if (inside && strncmp(line, "<title>", 7) != 0) { /* the title, "Gnuplot", would show as a tooltip */
      put_line(file, line, prefix);
    }
  }
  free(line);
  fclose(picture);
  return inside;
}
