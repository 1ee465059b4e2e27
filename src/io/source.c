/* The origin of a text, and messages that name it. Messages quote the text of the user, which may contain anything: it
 * is cleaned and shortened here. */
#include "io/source.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"

enum { LONGEST_NAME = 200 }; /* bytes of a name that a message keeps: more than half of it is for the reason */

/* Length of a character by its first byte, and the smallest code point of that length. */
static size_t length_of_first(unsigned char first, uint32_t *least) {
  if (first >= 0xC2 && first <= 0xDF) return *least = 0x80, 2;
  if (first >= 0xE0 && first <= 0xEF) return *least = 0x800, 3;
  if (first >= 0xF0 && first <= 0xF4) return *least = 0x10000, 4;
  return 0;
}

size_t zp_text_character(const char *text, size_t size) {
  const unsigned char *byte = (const unsigned char *)text;
  if (size == 0) return 0;
  if (byte[0] < 0x80) return (byte[0] >= 0x20 && byte[0] != 0x7F) || (byte[0] && strchr("\t\n\r", byte[0]));
  uint32_t least = 0;
  size_t length = length_of_first(byte[0], &least);
  if (length == 0 || length > size) return 0;
  uint32_t code = byte[0] & (0x7Fu >> length);
  for (size_t i = 1; i < length; i++) {
    if ((byte[i] & 0xC0) != 0x80) return 0;
    code = code << 6 | (byte[i] & 0x3F);
  }
  bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  bool control = code < 0xA0;
  return code < least || code > 0x10FFFF || surrogate || control ? 0 : length;
}

void zp_text_clean(char *text) {
  size_t left = strlen(text);
  while (left) {
    size_t length = zp_text_character(text, left);
    if (length == 0 || (length == 1 && strchr("\t\n\r", *text))) *text = '?';
    if (length == 0) length = 1;
    text += length;
    left -= length;
  }
}

/* A long path keeps its end, a long argument its start, which identify them. */
static void print_place(const ZpSource *source, int line, char *text, size_t size) {
  size_t length = strlen(source->name);
  bool cut = length > LONGEST_NAME;
  if (source->argument)
    snprintf(text, size, "--set %.*s%s", LONGEST_NAME, source->name, cut ? "..." : "");
  else
    snprintf(text, size, "%s%s", cut ? "..." : "", cut ? source->name + length - LONGEST_NAME : source->name);
  if (line > 0 && !source->argument) {
    size_t used = strlen(text);
    snprintf(text + used, size - used, ":%d", line);
  }
}

ZpStatus zp_source_fail(const ZpSource *source, int line, ZpError *err, const char *format, ...) {
  char place[LONGEST_NAME + 40];
  char reason[sizeof err->message];
  print_place(source, line, place, sizeof place);
  va_list args;
  va_start(args, format);
  vsnprintf(reason, sizeof reason, format, args);
  va_end(args);
  zp_fail(err, ZP_BAD_INPUT, "%s: %s", place, reason);
  if (err) zp_text_clean(err->message);
  return ZP_BAD_INPUT;
}
