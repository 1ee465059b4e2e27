/* What is said of a key that does not exist. */
#ifndef ZP_IO_UNKNOWN_H
#define ZP_IO_UNKNOWN_H

#include <stddef.h>

/* Why `name` is no key: what it names is not modelled, and what to give in its place; else the nearest key. */
void zp_unknown_key(const char *name, char *text, size_t size);

#endif
