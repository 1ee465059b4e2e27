#include "base/fail.h"

#include <stdarg.h>
#include <stdio.h>

ZpStatus zp_fail(ZpError *err, ZpStatus status, const char *format, ...) {
  if (!err) return status;
  err->status = status;
  va_list args;
  va_start(args, format);
  vsnprintf(err->message, sizeof err->message, format, args);
  va_end(args);
  return status;
}

ZpStatus zp_fail_memory(ZpError *err) {
  return zp_fail(err, ZP_MACHINE, "no memory");
}
