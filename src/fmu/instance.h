/* One instance of the actuator as an FMU, for FMI 2 and FMI 3: parameters, inputs, the simulation, and its phase, which
 * determines the allowed calls. Instances share no mutable data. */
#ifndef ZP_FMU_INSTANCE_H
#define ZP_FMU_INSTANCE_H

#include "fmu/start.h"
#include "fmu/variables.h"

/* One bit each, so that a call can name all phases in which it is allowed. */
typedef enum ZpFmuPhase {
  ZP_FMU_INSTANTIATED = 1,
  ZP_FMU_INITIALIZING = 2,
  ZP_FMU_STEPPING = 4,
  ZP_FMU_AT_EVENT = 8, /* FMI 3: event mode */
  ZP_FMU_TERMINATED = 16,
  ZP_FMU_FAILED = 32,
  ZP_FMU_ANY = 63,
  ZP_FMU_RUNNING = ZP_FMU_STEPPING | ZP_FMU_AT_EVENT,
  ZP_FMU_SETTABLE = ZP_FMU_INSTANTIATED | ZP_FMU_INITIALIZING | ZP_FMU_RUNNING, /* some variables are */
  ZP_FMU_READABLE = ZP_FMU_INITIALIZING | ZP_FMU_RUNNING | ZP_FMU_TERMINATED
} ZpFmuPhase;

typedef struct ZpFmu {
  ZpFmuStart start;
  ZpFmuPhase phase;
  double start_time, time;                          /* s, as counted by the importer */
  double input[ZP_FMU_INPUTS], rate[ZP_FMU_INPUTS]; /* as last set */
  ZpActuatorDef def;                                /* parameters */
  ZpModel *model;                                   /* built from its Def; NULL: not yet */
  ZpSim *sim;
  unsigned char *origin;      /* the snapshot from which every run of this model starts */
  bool prepared;              /* the simulation has started with these parameters */
  bool stale;                 /* inputs have changed since `row` was read */
  double row[ZP_FMU_OUTPUTS]; /* outputs */
} ZpFmu;

/* How a step ended. */
typedef struct ZpFmuStep {
  bool event;     /* at an event, before its planned end */
  bool terminate; /* the actuator cannot continue: a short circuit */
} ZpFmuStep;

/* A new instance in phase instantiated => *out. ZP_BAD_INPUT as zp_fmu_start_def; ZP_MACHINE if there is no memory. */
ZpStatus zp_fmu_create(const ZpFmuStart *start, ZpFmu **out, ZpError *err);
void zp_fmu_destroy(ZpFmu *fmu);

/* Return to that phase and to the start values. */
ZpStatus zp_fmu_reset(ZpFmu *fmu, ZpError *err);

/* Build the model and its simulation from the parameters, unless it is done already. ZP_BAD_INPUT names parameters that
 * contradict each other, or reports that there is no hanging equilibrium. */
ZpStatus zp_fmu_need_model(ZpFmu *fmu, ZpError *err);

/* Build the model and start a run at the inputs, unless it is done already. ZP_BAD_INPUT also if an input is out of
 * range. */
ZpStatus zp_fmu_prepare(ZpFmu *fmu, ZpError *err);

/* Prepare the simulation where initialization ends. Inputs that were set before are no jumps of the run, so the first
 * mean current is that of the first step alone. Errors as zp_fmu_prepare. */
ZpStatus zp_fmu_begin(ZpFmu *fmu, ZpError *err);

/* The value of a variable, SI. ZP_BAD_INPUT if no variable of that type has that reference. Reading an output prepares
 * the simulation if necessary. */
ZpStatus zp_fmu_get(ZpFmu *fmu, uint32_t reference, ZpKeyType type, double *value, ZpError *err);

/* Set an input, whose rate becomes 0, or a parameter. ZP_BAD_INPUT, without any change, if it is neither, if a
 * parameter is set after initialization, or if the value is out of range. */
ZpStatus zp_fmu_set(ZpFmu *fmu, uint32_t reference, ZpKeyType type, double value, ZpError *err);

/* Set the rate of change of an input, per second. */
ZpStatus zp_fmu_set_rate(ZpFmu *fmu, uint32_t reference, double rate, ZpError *err);

/* Advance to the time `end`, s, or to an event before it. ZP_BAD_INPUT, without any change, if that is not after the
 * current time; ZP_MACHINE, and the phase becomes failed, if the solver fails. Does not allocate memory. */
ZpStatus zp_fmu_step(ZpFmu *fmu, double end, bool to_event, ZpFmuStep *step, ZpError *err);

/* The derivatives of outputs with respect to input `by` at this instant, in the order of a row. ZP_BAD_INPUT if `by` is
 * not an input. */
ZpStatus zp_fmu_slopes(ZpFmu *fmu, uint32_t by, double slope[ZP_FMU_OUTPUTS], ZpError *err);

/* The place of an output in a row. ZP_BAD_INPUT if it is not an output. */
ZpStatus zp_fmu_signal(const ZpFmu *fmu, uint32_t reference, int *signal, ZpError *err);

/* The complete state and all set values, as bytes that may be stored. zp_fmu_load: ZP_BAD_INPUT if they are damaged or
 * of another FMU; ZP_MACHINE if there is no memory for another model. */
size_t zp_fmu_state_size(const ZpFmu *fmu);
void zp_fmu_save(const ZpFmu *fmu, void *bytes);
ZpStatus zp_fmu_load(ZpFmu *fmu, const void *bytes, size_t size, ZpError *err);

#endif
