/* A small importer that builds for Linux and for Windows: runs a binary of an FMU by FMI 3 and prints its outputs in
 * hexadecimal, so that binaries can be compared to the last bit.
 *   fmu_host LIBRARY TOKEN STEPS SIZE REFERENCE... */
#include <stdio.h>
#include <stdlib.h>

#include "fmu/export/fmi3.h"

#ifdef _WIN32
#include <windows.h>

static void *find(const char *library, const char *name) {
  return (void *)(size_t)GetProcAddress(LoadLibraryA(library), name);
}
#else
#include <dlfcn.h>

static void *find(const char *library, const char *name) {
  return dlsym(dlopen(library, RTLD_NOW), name);
}
#endif

enum { MOST = 128 };

static void say(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message) {
  (void)environment, (void)status, (void)category;
  fprintf(stderr, "%s\n", message);
}

#define FUNCTION(name) ((__typeof__(&name))find(library, #name))

int main(int argc, char **argv) {
  if (argc < 6 || argc > 5 + MOST) return 2;
  const char *library = argv[1];
  fmi3ValueReference reference[MOST];
  fmi3Float64 value[MOST], size = atof(argv[4]), reached;
  fmi3Boolean event, terminate, early;
  const size_t count = (size_t)argc - 5;
  for (size_t k = 0; k < count; k++)
    reference[k] = (fmi3ValueReference)strtoul(argv[5 + k], NULL, 10);
  fmi3Instance instance = FUNCTION(fmi3InstantiateCoSimulation)("host", argv[2], NULL, false, false, false, false, NULL,
                                                                0, NULL, say, NULL);
  if (!instance || FUNCTION(fmi3EnterInitializationMode)(instance, false, 0, 0, false, 0) != fmi3OK ||
      FUNCTION(fmi3ExitInitializationMode)(instance) != fmi3OK)
    return 1;
  for (int k = 0; k < atoi(argv[3]); k++) {
    if (FUNCTION(fmi3DoStep)(instance, k * size, size, true, &event, &terminate, &early, &reached) != fmi3OK) return 1;
    if (FUNCTION(fmi3GetFloat64)(instance, reference, count, value, count) != fmi3OK) return 1;
    for (size_t j = 0; j < count; j++)
      printf("%a%c", value[j], j + 1 < count ? ' ' : '\n');
  }
  FUNCTION(fmi3FreeInstance)(instance);
  return 0;
}
