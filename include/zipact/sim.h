/* A simulation in time: a model, the state that it has reached, and how it got there. */
#ifndef ZIPACT_SIM_H
#define ZIPACT_SIM_H

#include <stdint.h>

#include <zipact/api.h>
#include <zipact/model.h>
#include <zipact/table.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ZpSim ZpSim;

/* How the solver ended. */
typedef enum ZpOutcome {
  ZP_REACHED_END,   /* "end_time": the time asked for was reached */
  ZP_ZIPPED,        /* "zipped": the actuator has closed */
  ZP_INTERRUPTED,   /* "interrupted": the progress hook asked to stop */
  ZP_NOT_SETTLED,   /* "not_settled": no equilibrium to start from was found */
  ZP_DIVERGED,      /* "diverged": numbers left all bounds */
  ZP_STEP_LIMIT,    /* "step_limit": solver.max_steps were not enough */
  ZP_CONVERGED,     /* "converged": an equilibrium was found */
  ZP_FOLLOWED,      /* "followed": a branch of equilibria was followed to its end */
  ZP_BRANCH_LOST,   /* "branch_lost": a branch could not be followed further */
  ZP_BAD_ARGUMENT,  /* "bad_argument": a call asked for what cannot be; nothing was done */
  ZP_SHORT_CIRCUIT, /* "short_circuit": electrodes without an insulator touched under a voltage */
  ZP_PULLED_IN,     /* "pulled_in": no hanging equilibrium at this voltage: the actuator pulls in below it */
  ZP_EVENT,         /* "event": zp_sim_step_to_event has ended at an event */
  ZP_AT_BOUND       /* "at_bound": what fits best lies at a bound of a fitted key, or beyond it */
} ZpOutcome;

/* The word for an outcome, as in summary.json; "unknown" of any other number. */
ZP_API const char *zp_outcome_name(ZpOutcome outcome);

/* True if the outcome is an answer, false if the solver failed (or was interrupted). */
ZP_API bool zp_outcome_good(ZpOutcome outcome);

/* What the caller may want to know and say while a long call works. All may be NULL. */
typedef struct ZpHooks {
  void *user; /* handed to the functions below */
  /* Called some times a second of wall time with the stage and its progress, 0 .. 1. Return true to
   * stop; what was reached is kept. */
  bool (*progress)(void *user, const char *stage, double fraction);
  /* Wall clock in s; without it wall times are NAN. */
  double (*clock)(void *user);
} ZpHooks;

/* What bounds a time step. Steps are counted by it. */
typedef enum ZpStepLimit {
  ZP_LIMIT_TIME_STEP, /* solver.time_step */
  ZP_LIMIT_STABILITY, /* the stiffest spring */
  ZP_LIMIT_DRAG,      /* first bound of eq. (9) of the paper */
  ZP_LIMIT_EVENT,     /* a pair meets inside the step, or a corner of the waveform ends it */
  ZP_LIMIT_ERROR,     /* implicit: the local error, or what converges */
  ZP_LIMIT_END,       /* the end of the run */
  ZP_LIMIT_COUNT
} ZpStepLimit;

/* The word for a step limit, as in summary.json; "unknown" of any other number. */
ZP_API const char *zp_step_limit_name(ZpStepLimit limit);

/* How a run went. */
typedef struct ZpRunInfo {
  ZpOutcome outcome;
  char message[256];               /* one sentence for people */
  int64_t steps;                   /* taken */
  int64_t limited[ZP_LIMIT_COUNT]; /* how many of them each bound set */
  int64_t rejected;                /* implicit: steps thrown away for their local error, */
  int64_t failures;                /* and because Newton's method found no end */
  int64_t iterations;              /* implicit: of Newton's method */
  double smallest_bound[3];        /* of eq. (9): drag, axial, shear; s; over the recorded rows */
  double simulated_time;           /* s */
  double wall_time;                /* of the stepping, s; NAN without a clock */
  int64_t settle_steps;            /* pseudo-time steps to the hanging equilibrium */
  double settle_residual;          /* largest force left there over all weight */
} ZpRunInfo;

/* A new simulation at its initial state, at t = 0, the voltage that of the
 * waveform there. `model` must outlive it. Finds the
 * hanging equilibrium first, as the start and as the reference of contraction; if it is not found, the
 * next zp_sim_run says so and does nothing else. `hooks` may be NULL. ZP_BAD_INPUT as zp_def_check_motion; as
 * zp_def_check_voltage at the highest voltage of the waveform; and if drive.waveform is
 * table and the model was made without one. With initial.state checkpoint it moves only after zp_sim_continue, or
 * another state has been given. */
ZP_API ZpStatus zp_sim_create(const ZpModel *model, const ZpHooks *hooks, ZpSim **sim, ZpError *err);
ZP_API void zp_sim_destroy(ZpSim *sim);

/* Where rows and shapes go during a run; each may be NULL. Columns are those of signals.def
 * (zp_signal_columns). The caller keeps them. */
ZP_API void zp_sim_record(ZpSim *sim, ZpTable *series, ZpShapes *shapes);

/* Run until `end_time` (s, from the time reached on; INFINITY: until another end), or until zipped where
 * `stop_when_zipped`. At the time reached already nothing moves. ZP_BAD_ARGUMENT, and nothing is done, if end_time is
 * before it or NAN. `hooks` and `info` may be NULL. */
ZP_API ZpOutcome zp_sim_run(ZpSim *sim, double end_time, bool stop_when_zipped, const ZpHooks *hooks, ZpRunInfo *info);

/* Run on by `dt` (s, finite and above 0; else ZP_BAD_ARGUMENT, and nothing is done), for callers that come again and
 * again, as control loops: explicit steps are then of equal length. zp_sim_run ends with a shorter one, which,
 * repeated, would shake what vibrates near the bound of stability until the numbers diverge. */
ZP_API ZpOutcome zp_sim_step(ZpSim *sim, double dt, const ZpHooks *hooks, ZpRunInfo *info);

/* The same, but the run ends with ZP_EVENT after the first step in which the actuator has closed, an input has reached
 * the end of its range, the voltage had a corner, or the supply has reached or left a limit. The steps are those of
 * zp_sim_step up to there. */
ZP_API ZpOutcome zp_sim_step_to_event(ZpSim *sim, double dt, const ZpHooks *hooks, ZpRunInfo *info);

/* Set the potential difference from now on, V; drive.waveform does not count any more. An ideal source charges the
 * electrodes at once: its work is U dQ, and what the field does not keep of that is the signal charging_loss. A voltage
 * that is replaced before the simulation continues counts for nothing (unless a field had to be solved for it); an
 * unchanged one costs nothing. The same as zp_sim_set_input with rate 0. ZP_BAD_INPUT if it is out of the range of
 * drive.voltage, and as zp_def_check_voltage. */
ZP_API ZpStatus zp_sim_set_voltage(ZpSim *sim, double voltage, ZpError *err);

/* What a program can change while a simulation runs. */
typedef enum ZpInput {
  ZP_INPUT_VOLTAGE,  /* "voltage": potential difference, V; range of drive.voltage */
  ZP_INPUT_LOAD,     /* "load": a force on the whole actuator, N, beside load.mass, without inertia; positive pulls the
                        lower platform down (one ribbon: the right end); -10 kN to 10 kN, 0 until set; the modelled part
                        carries load.share of it */
  ZP_INPUT_SETPOINT, /* "setpoint": what a controller of the model (control.kind) holds, in the unit of
                        control.signal; -1000 to 1000; setpoint.waveform does not count any more. The voltage cannot be
                        set then */
  ZP_INPUT_COUNT
} ZpInput;

/* The word for an input; "unknown" of any other number. */
ZP_API const char *zp_input_name(ZpInput input);

/* Set an input: from now on it has this value, SI, and changes with `rate` per second (at most 1e12 in size),
 * until it is set again or the end of its range is reached, where it stays. The voltage jumps to `value`, as with
 * zp_sim_set_voltage, and changes without loss from there; its work is the signal electric_work, that of the load
 * load_work. ZP_BAD_INPUT, and nothing is changed, if the value is out of range, if the rate is, or there is no such
 * input; of a voltage that is or becomes other than 0 also as zp_def_check_voltage. */
ZP_API ZpStatus zp_sim_set_input(ZpSim *sim, ZpInput input, double value, double rate, ZpError *err);

/* The derivatives of all signals by an input at this instant, while nothing moves, SI, in the order of
 * zp_signal_columns: what a small jump of the input changes at once (docs/theory.md, section 17). Changes nothing.
 * Signals follow the voltage as polynomials of second degree, so the central difference that is taken is their
 * derivative up to rounding; where the breakdown cap begins to act, up to 1e-6 of it. ZP_BAD_INPUT if there is no such
 * input. */
ZP_API ZpStatus zp_sim_input_slopes(ZpSim *sim, ZpInput input, double *slope, ZpError *err);

/* A controller of the program's own: at equal intervals it says what the voltage is to be. */
typedef struct ZpController {
  double period; /* s from one sample to the next; 1e-9 to 1e4 */
  void *user;    /* handed to the function below: what the controller keeps from sample to sample */
  /* (the simulation, to be read from only: zp_sim_get, zp_sim_read, zp_sim_shape; its time, s) => voltage from now on,
   * V, range of drive.voltage. Any other ends the run with ZP_BAD_ARGUMENT and a message. */
  double (*voltage)(void *user, ZpSim *sim, double time);
} ZpController;

/* From now on this controller, which is copied, is asked where a run begins that starts at the present time, and every
 * period from there: each run of the simulation takes its steps to these instants, which no caller needs to know. They
 * stay the same when another state is restored; what is behind `user` is the program's to restore. NULL: none any more,
 * and the voltage stays. ZP_BAD_INPUT if the period is out of range or there is no function. */
ZP_API ZpStatus zp_sim_set_controller(ZpSim *sim, const ZpController *controller, ZpError *err);

/* Present value of the signal called `name` in signals.def ("stroke"), SI; NAN if there is none. Changes nothing in
 * what follows, but uses the simulation's work space: one thread at a time, as with all calls. */
ZP_API double zp_sim_get(ZpSim *sim, const char *name);

/* Present values of all signals, SI, in the order of zp_signal_columns: a row. The mean current counts from the last
 * row at an earlier time, so that current times time adds up to the charge, jumps of the voltage included. */
ZP_API void zp_sim_read(ZpSim *sim, double *row);

/* Where the mean current and the mean power of the next row count from. A snapshot does not have it: a restored
 * simulation counts from the time of the snapshot on, unless this is set again. */
typedef struct ZpRowStart {
  double time;   /* s */
  double charge; /* that the source had given, of one modelled part, C */
  double energy; /* that it had given, J */
} ZpRowStart;
ZP_API ZpRowStart zp_sim_row_start(const ZpSim *sim);
ZP_API void zp_sim_set_row_start(ZpSim *sim, ZpRowStart start);

/* Present shape; its pointers are valid until the simulation continues. */
ZP_API ZpShape zp_sim_shape(ZpSim *sim);

/* The liquid between the faces. Stations are numbered as in the shape: member after member. */
typedef struct ZpLiquid {
  const double *thickness;  /* [members * nodes] thickness of the film, m; 0 where there is none */
  const double *pressure;   /* [members * nodes] pressure above the surroundings, Pa: mean across the width and over the
                               last step */
  const double *wet_length; /* [members * halves] length of each modelled half that is wet, from its clip, m; INFINITY
                               if no bead ends there */
} ZpLiquid;

/* The present liquid. The pointers are valid until the simulation continues; they are NULL without liquid.model. */
ZP_API ZpLiquid zp_sim_liquid(ZpSim *sim);

/* Time at which 99 % contraction was reached (or the pair of contact.complete_margin joined), s; NAN
 * if not yet. */
ZP_API double zp_sim_zip_time(const ZpSim *sim);

/* When a zip front had outrun the liquid of its bead (liquid.model bead), s; NAN if none has. */
ZP_API double zp_sim_starved_time(const ZpSim *sim);

/* All that evolves, as a snapshot: bytes that may be stored anywhere and given to anyone, the same for equal states on
 * every machine. They hold the version, the keys that make the model and a checksum; docs/formats.md has the format.
 * `bytes` takes zp_sim_state_size bytes, as many for each state of one model. */
ZP_API size_t zp_sim_state_size(const ZpSim *sim);
ZP_API void zp_sim_save(const ZpSim *sim, void *bytes);

/* Go back to such a state, of this simulation or another one of the same model (zp_checkpoint_holds says of each key
 * whether it must be the same). Where the waveform is another, the voltage jumps to it. ZP_BAD_INPUT, and nothing is
 * changed, if the bytes are no snapshot, cut short, damaged, of another version, or of another model; the message names
 * the key that differs. */
ZP_API ZpStatus zp_sim_restore(ZpSim *sim, const void *bytes, size_t size, ZpError *err);

/* The columns of a time series: one per line of signals.def. */
ZP_API const ZpColumn *zp_signal_columns(size_t *count);

/* The same with the units of this Def: setpoint and measured are in that of control.signal. */
ZP_API const ZpColumn *zp_signal_columns_of(const ZpActuatorDef *def, size_t *count);

/* The unit of what control.signal holds: "m", "F" or "1". */
ZP_API const char *zp_control_unit(const ZpActuatorDef *def);

/* Continue from the state of `from`, a simulation of another model with as many members, ribbons and nodes: its time,
 * voltage, contact, velocities and shape, stretched to this model's length. Energy and losses count from here on;
 * contraction refers to this model's own hanging equilibrium. drive.waveform has no effect any more. ZP_BAD_INPUT, and
 * nothing is changed, if the models differ in these numbers or in what holds their ends and platforms, or if members
 * that share a load differ in their lengths. */
ZP_API ZpStatus zp_sim_take_over(ZpSim *sim, const ZpSim *from, ZpError *err);

#ifdef __cplusplus
}
#endif

#endif
