#include "base/fail.h"

#include <stdarg.h>
#include <stdio.h>

void zp_fail_fill(ZpError *err, ZpStatus status, const char *format, ...) {
  if (!err) return;
  err->status = status;
  va_list args;
  va_start(args, format);
  vsnprintf(err->message, sizeof err->message, format, args);
  va_end(args);
}
