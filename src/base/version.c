#include <zipact/version.h>

const char *zp_version(void) {
  return ZP_VERSION;
}
