/* The interface of FMI 2.0 for co-simulation that a slave provides: types and functions of the standard, under its
 * names. */
#ifndef ZP_FMU_EXPORT_FMI2_H
#define ZP_FMU_EXPORT_FMI2_H

#include <stddef.h>

#include "fmu/export/visible.h"

typedef void *fmi2Component;
typedef void *fmi2ComponentEnvironment;
typedef void *fmi2FMUstate;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer;
typedef int fmi2Boolean;
typedef char fmi2Char;
typedef const fmi2Char *fmi2String;
typedef char fmi2Byte;

enum { fmi2False = 0, fmi2True = 1 };

typedef enum fmi2Status { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum fmi2Type { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum fmi2StatusKind {
  fmi2DoStepStatus,
  fmi2PendingStatus,
  fmi2LastSuccessfulTime,
  fmi2Terminated
} fmi2StatusKind;

typedef struct fmi2EventInfo {
  fmi2Boolean newDiscreteStatesNeeded;
  fmi2Boolean terminateSimulation;
  fmi2Boolean nominalsOfContinuousStatesChanged;
  fmi2Boolean valuesOfContinuousStatesChanged;
  fmi2Boolean nextEventTimeDefined;
  fmi2Real nextEventTime;
} fmi2EventInfo;

typedef struct fmi2CallbackFunctions {
  void (*logger)(fmi2ComponentEnvironment, fmi2String instance, fmi2Status, fmi2String category, fmi2String message,
                 ...);
  void *(*allocateMemory)(size_t count, size_t size);
  void (*freeMemory)(void *);
  void (*stepFinished)(fmi2ComponentEnvironment, fmi2Status);
  fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

ZP_FMI const char *fmi2GetTypesPlatform(void);
ZP_FMI const char *fmi2GetVersion(void);
ZP_FMI fmi2Component fmi2Instantiate(fmi2String instance, fmi2Type, fmi2String guid, fmi2String resources,
                                     const fmi2CallbackFunctions *, fmi2Boolean visible, fmi2Boolean logging);
ZP_FMI void fmi2FreeInstance(fmi2Component);

#define ZP_FMI_VERSION    2
#define ZP_FMI_NAME(name) fmi2##name
#include "fmu/export/functions.def"
#undef ZP_FMI_NAME
#undef ZP_FMI_VERSION

#endif
