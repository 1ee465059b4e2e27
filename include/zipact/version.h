/* Version of the library, also of the command and of the files that they write. */
#ifndef ZIPACT_VERSION_H
#define ZIPACT_VERSION_H

#include <zipact/api.h>

#ifdef __cplusplus
extern "C" {
#endif

#define ZP_VERSION "0.1.0"

/* Number of the binary interface: the SOVERSION of the shared libraries. A program that was compiled with these headers
 * runs with every later library of the same number, which may have more functions, keys, words at the end of a list,
 * signals, columns, outcomes and inputs. A release raises it if a function was removed or takes other arguments, if a
 * struct of the headers changed, or if an enumerator has another value. See docs/design.md. */
#define ZP_ABI 2

/* Version of the running library, which may differ from ZP_VERSION of the headers. */
ZP_API const char *zp_version(void);

#ifdef __cplusplus
}
#endif

#endif
