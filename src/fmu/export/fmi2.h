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
ZP_FMI fmi2Status fmi2SetDebugLogging(fmi2Component, fmi2Boolean on, size_t count, const fmi2String category[]);
ZP_FMI fmi2Component fmi2Instantiate(fmi2String instance, fmi2Type, fmi2String guid, fmi2String resources,
                                     const fmi2CallbackFunctions *, fmi2Boolean visible, fmi2Boolean logging);
ZP_FMI void fmi2FreeInstance(fmi2Component);
ZP_FMI fmi2Status fmi2SetupExperiment(fmi2Component, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start,
                                      fmi2Boolean has_stop, fmi2Real stop);
ZP_FMI fmi2Status fmi2EnterInitializationMode(fmi2Component);
ZP_FMI fmi2Status fmi2ExitInitializationMode(fmi2Component);
ZP_FMI fmi2Status fmi2Terminate(fmi2Component);
ZP_FMI fmi2Status fmi2Reset(fmi2Component);

ZP_FMI fmi2Status fmi2GetReal(fmi2Component, const fmi2ValueReference[], size_t count, fmi2Real[]);
ZP_FMI fmi2Status fmi2GetInteger(fmi2Component, const fmi2ValueReference[], size_t count, fmi2Integer[]);
ZP_FMI fmi2Status fmi2GetBoolean(fmi2Component, const fmi2ValueReference[], size_t count, fmi2Boolean[]);
ZP_FMI fmi2Status fmi2GetString(fmi2Component, const fmi2ValueReference[], size_t count, fmi2String[]);
ZP_FMI fmi2Status fmi2SetReal(fmi2Component, const fmi2ValueReference[], size_t count, const fmi2Real[]);
ZP_FMI fmi2Status fmi2SetInteger(fmi2Component, const fmi2ValueReference[], size_t count, const fmi2Integer[]);
ZP_FMI fmi2Status fmi2SetBoolean(fmi2Component, const fmi2ValueReference[], size_t count, const fmi2Boolean[]);
ZP_FMI fmi2Status fmi2SetString(fmi2Component, const fmi2ValueReference[], size_t count, const fmi2String[]);

ZP_FMI fmi2Status fmi2GetFMUstate(fmi2Component, fmi2FMUstate *);
ZP_FMI fmi2Status fmi2SetFMUstate(fmi2Component, fmi2FMUstate);
ZP_FMI fmi2Status fmi2FreeFMUstate(fmi2Component, fmi2FMUstate *);
ZP_FMI fmi2Status fmi2SerializedFMUstateSize(fmi2Component, fmi2FMUstate, size_t *size);
ZP_FMI fmi2Status fmi2SerializeFMUstate(fmi2Component, fmi2FMUstate, fmi2Byte[], size_t size);
ZP_FMI fmi2Status fmi2DeSerializeFMUstate(fmi2Component, const fmi2Byte[], size_t size, fmi2FMUstate *);
ZP_FMI fmi2Status fmi2GetDirectionalDerivative(fmi2Component, const fmi2ValueReference unknown[], size_t unknowns,
                                               const fmi2ValueReference known[], size_t knowns, const fmi2Real seed[],
                                               fmi2Real sensitivity[]);

ZP_FMI fmi2Status fmi2SetRealInputDerivatives(fmi2Component, const fmi2ValueReference[], size_t count,
                                              const fmi2Integer order[], const fmi2Real[]);
ZP_FMI fmi2Status fmi2GetRealOutputDerivatives(fmi2Component, const fmi2ValueReference[], size_t count,
                                               const fmi2Integer order[], fmi2Real[]);
ZP_FMI fmi2Status fmi2DoStep(fmi2Component, fmi2Real now, fmi2Real size, fmi2Boolean no_return_before);
ZP_FMI fmi2Status fmi2CancelStep(fmi2Component);
ZP_FMI fmi2Status fmi2GetRealStatus(fmi2Component, fmi2StatusKind, fmi2Real *);
ZP_FMI fmi2Status fmi2GetBooleanStatus(fmi2Component, fmi2StatusKind, fmi2Boolean *);

#define ZP_STATUS(name, parameters)   ZP_FMI fmi2Status fmi2##name parameters;
#define ZP_EXCHANGE(name, parameters) ZP_FMI fmi2Status fmi2##name parameters;
#include "fmu/export/fmi2_refused.def"

#endif
