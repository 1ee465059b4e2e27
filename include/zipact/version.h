/* Version of the library, also of the command and of the files that they write. */
#ifndef ZIPACT_VERSION_H
#define ZIPACT_VERSION_H

#include <zipact/api.h>

#ifdef __cplusplus
extern "C" {
#endif

#define ZP_VERSION "0.1.0"

/* Number of the binary interface: the SOVERSION of the shared libraries. A release raises it if programs that were
 * compiled with the previous release could break: a function was removed or takes other arguments, a public struct or
 * enumeration changed, a key was added or removed. See docs/design.md. */
#define ZP_ABI 1

/* Version of the running library, which may differ from ZP_VERSION of the headers. */
ZP_API const char *zp_version(void);

#ifdef __cplusplus
}
#endif

#endif
