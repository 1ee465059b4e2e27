/* Reading a file, and writing a text into memory. */
#ifndef ZP_IO_FILE_H
#define ZP_IO_FILE_H

#include <stddef.h>
#include <stdio.h>

#include <zipact/error.h>

/* The bytes of a file, at most `most` of them, and a 0 => *text, to be freed; NULL on failure. ZP_BAD_INPUT: there is
 * no such file; ZP_MACHINE: it cannot be read. */
ZpStatus zp_file_read(const char *path, size_t most, char **text, size_t *size, ZpError *err);

/* Writes `user` to a file. */
typedef ZpStatus (*ZpPut)(const void *user, FILE *file, ZpError *err);

/* The text that put(user, file) writes => *text, to be freed; NULL on failure. */
ZpStatus zp_text_put(ZpPut put, const void *user, char **text, size_t *size, ZpError *err);

#endif
