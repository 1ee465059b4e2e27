/* The kit for FMUs: a folder with `binaries/PLATFORM/zipact.so` or `.dll` and `sources/`. */
#ifndef ZP_FMUPACK_KIT_H
#define ZP_FMUPACK_KIT_H

#include <stdbool.h>
#include <stddef.h>

#include <zipact/error.h>

/* Names of the files in a kit, with their folders, sorted. */
typedef struct ZpKit {
  char **item;
  size_t count;
} ZpKit;

/* All files below `folder`. ZP_MACHINE if it cannot be read. To be freed by zp_kit_free, also on failure. */
ZpStatus zp_kit_list(const char *folder, ZpKit *names, ZpError *err);
void zp_kit_free(ZpKit *names);

#endif
