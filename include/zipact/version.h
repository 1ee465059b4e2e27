/* Version of the library, also of the command and of the files that they write. */
#ifndef ZIPACT_VERSION_H
#define ZIPACT_VERSION_H

#include <zipact/api.h>

#ifdef __cplusplus
extern "C" {
#endif

#define ZP_VERSION "0.1.0"

/* Number of the binary interface: the SOVERSION of the shared libraries. A release raises it when a program that was
 * compiled against the one before could break: a function is gone or takes something else, a public struct or
 * enumeration is another, a key has come or gone. See docs/design.md. */
#define ZP_ABI 1

/* ZP_VERSION of the library that runs, which may be another than that of the headers. */
ZP_API const char *zp_version(void);

#ifdef __cplusplus
}
#endif

#endif
