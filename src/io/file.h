/* Reading a file. */
#ifndef ZP_IO_FILE_H
#define ZP_IO_FILE_H

#include <stddef.h>

#include <zipact/error.h>

/* The bytes of a file, at most `most` of them, and a 0 => *text, to be freed; NULL on failure. ZP_BAD_INPUT: there is
 * no such file; ZP_MACHINE: it cannot be read. */
ZpStatus zp_file_read(const char *path, size_t most, char **text, size_t *size, ZpError *err);

#endif
