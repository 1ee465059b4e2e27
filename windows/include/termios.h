/* A terminal that cannot be asked: libfyaml looks at it only when it prints, which the command does not let it. */
#ifndef ZP_WINDOWS_TERMIOS_H
#define ZP_WINDOWS_TERMIOS_H

struct termios {
  int c_iflag, c_oflag, c_cflag, c_lflag;
  unsigned char c_cc[2];
};
enum { TCSANOW, VMIN = 0, VTIME = 1 };
#define tcgetattr(file, state)       (-1)
#define tcsetattr(file, when, state) (-1)
#define cfmakeraw(state)             ((void)(state))

#endif
