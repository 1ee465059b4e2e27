/* The origin of a text, and messages that name it. */
#ifndef ZP_IO_SOURCE_H
#define ZP_IO_SOURCE_H

#include <stdbool.h>
#include <stddef.h>

#include <zipact/error.h>

/* A file, or an argument of --set. */
typedef struct ZpSource {
  const char *name; /* name of the file; for an argument the whole argument, "KEY=VALUE" */
  bool argument;
} ZpSource;

/* (source, line from 1, 0 if unknown) => err: "FILE:LINE: ..." or "--set KEY=VALUE: ...", without bytes that control a
 * terminal. Returns ZP_BAD_INPUT. */
__attribute__((format(printf, 4, 5))) ZpStatus zp_source_fail(const ZpSource *source, int line, ZpError *err,
                                                              const char *format, ...);

/* Number of bytes of the UTF-8 character at the start of text[0 .. size); 0 if it is invalid or a control character
 * other than tab, line feed and carriage return. */
size_t zp_text_character(const char *text, size_t size);

/* Replace invalid characters (zp_text_character) and line ends by question marks. */
void zp_text_clean(char *text);

#endif
