/* Version of the library, also of the command and of the files that they write. */
#ifndef ZIPACT_VERSION_H
#define ZIPACT_VERSION_H

#define ZP_VERSION "0.1.0"

#endif
