/* Instead of src/io/processors.c. */
#include <windows.h>

#include <zipact/io.h>

int zp_processors(void) {
  SYSTEM_INFO info;
  GetSystemInfo(&info);
  return (int)info.dwNumberOfProcessors;
}
