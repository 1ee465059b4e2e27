/* See termios.h: nothing is ever there to read. */
#ifndef ZP_WINDOWS_SELECT_H
#define ZP_WINDOWS_SELECT_H

typedef int fd_set;
#define FD_ZERO(set)                                       (*(set) = 0)
#define FD_SET(file, set)                                  (*(set) = (file))
#define FD_ISSET(file, set)                                0
#define select(count, reading, writing, failing, patience) (-1)

#endif
