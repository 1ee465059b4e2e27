/* Where a text came from, and messages that say so. */
#ifndef ZP_IO_SOURCE_H
#define ZP_IO_SOURCE_H

#include <stdbool.h>
#include <stddef.h>

#include <zipact/error.h>

/* A file, or an argument of --set. */
typedef struct ZpSource {
  const char *name; /* of the file; of an argument: the argument, "KEY=VALUE" */
  bool argument;
} ZpSource;

/* (source, line from 1, 0 if there is none) => err: "FILE:LINE: ..." or "--set KEY=VALUE: ...", without
 * bytes that a terminal would act on. Returns ZP_BAD_INPUT. */
__attribute__((format(printf, 4, 5))) ZpStatus zp_source_fail(const ZpSource *source, int line, ZpError *err,
                                                              const char *format, ...);

/* Bytes of the UTF-8 character at the start of text[0 .. size), 0 if it is none or a control character
 * other than tab, line feed and carriage return. */
size_t zp_text_character(const char *text, size_t size);

/* Replace what zp_text_character refuses, and line ends, by question marks. */
void zp_text_clean(char *text);

#endif
