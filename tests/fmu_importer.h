/* An importer of FMUs for the tests: unpacks one, reads modelDescription.xml, loads the binary, and calls FMI 2 and FMI
 * 3 by the same functions. What it knows of an FMU it knows from that file. */
#ifndef ZP_TESTS_FMU_IMPORTER_H
#define ZP_TESTS_FMU_IMPORTER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "fmu/export/fmi2.h"
#include "fmu/export/fmi3.h"

typedef enum Kind { KIND_REAL, KIND_INTEGER, KIND_BOOLEAN, KIND_ENUMERATION } Kind;

/* A row of ModelVariables. */
typedef struct Variable {
  char name[64], unit[24], display[24], causality[16], variability[16], declared[64];
  Kind kind;
  uint32_t reference;
  bool has_start, has_range, follows[2]; /* the voltage or setpoint; the load */
  double start, min, max;
  size_t description; /* its length */
} Variable;

/* A unit, as powers of kg, m, s, A; the units in which its values are shown, each a factor times them. */
enum { BASES = 4, SHOWN_MOST = 4 };
typedef struct Unit {
  char name[24];
  bool has_base;
  double power[BASES];
  size_t shown;
  struct {
    char name[24];
    double factor;
  } display[SHOWN_MOST];
} Unit;

typedef struct Fmu {
  int version;
  char token[64], folder[512];
  double stop, step; /* of the default experiment */
  Variable *variable;
  size_t variables;
  Unit *unit;
  size_t units;
  void *library;
} Fmu;

void fmu_unpack(const char *path, const char *folder);

/* Of the FMU that was unpacked into `folder`; fails the test where anything is not as the standard has it. */
Fmu fmu_open(const char *folder);
void fmu_close(Fmu *fmu);

/* The variable called `name`; fails the test if there is none. */
const Variable *fmu_find(const Fmu *fmu, const char *name);

/* An instance of it, whose messages go to `last_message`. */
typedef struct Instance {
  const Fmu *fmu;
  void *handle;
} Instance;

enum { MESSAGE = 512 };
extern _Thread_local char last_message[MESSAGE];

/* How an FMI 3 instance is to end steps. */
typedef enum Steps { WHOLE_STEPS, STEPS_TO_EVENTS } Steps;

Instance fmu_instantiate(const Fmu *fmu, const char *token, Steps steps);

/* An instance of what this FMU is not. */
typedef enum Other { OTHER_EXCHANGE, OTHER_SCHEDULED, OTHER_INTERMEDIATE } Other;
void *fmu_instantiate_other(const Fmu *fmu, Other other);

void fmu_free(Instance *instance);

/* Each gives the status, which is numbered alike in both versions. */
int fmu_enter(Instance *instance, double start);
int fmu_enter_until(Instance *instance, double start, double stop);
int fmu_enter_with(Instance *instance, double start, double tolerance, double stop);
int fmu_set_time(Instance *instance, double time); /* of model exchange */
int fmu_exit(Instance *instance);
int fmu_terminate(Instance *instance);
int fmu_reset(Instance *instance);
int fmu_step(Instance *instance, double now, double size);
int fmu_try_get(Instance *instance, const Variable *variable, double *value);
int fmu_try_set(Instance *instance, const Variable *variable, double value);
int fmu_set_slope(Instance *instance, const Variable *variable, double slope);
int fmu_get_state(Instance *instance, void **state);
int fmu_set_state(Instance *instance, void *state);
int fmu_free_state(Instance *instance, void **state);
int fmu_state_size(Instance *instance, void *state, size_t *size);
int fmu_serialize(Instance *instance, void *state, void *bytes, size_t size);
int fmu_deserialize(Instance *instance, const void *bytes, size_t size, void **state);
int fmu_derivative(Instance *instance, const Variable *unknown, const Variable *known, double *value);

/* A function of the standard by the rest of its name: fmi2DoStep by "DoStep". */
void *fmu_function(const Fmu *fmu, const char *name);

/* The same where it must succeed. */
double fmu_get(Instance *instance, const char *name);
void fmu_set(Instance *instance, const char *name, double value);
void fmu_start(Instance *instance);

#endif
