/* A simulation in time: a model and its present state. */
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
  ZP_REACHED_END,   /* "end_time": the end time was reached */
  ZP_ZIPPED,        /* "zipped": the actuator has closed */
  ZP_INTERRUPTED,   /* "interrupted": the progress hook asked to stop */
  ZP_NOT_SETTLED,   /* "not_settled": no equilibrium to start from was found */
  ZP_DIVERGED,      /* "diverged": numbers grew beyond all bounds */
  ZP_STEP_LIMIT,    /* "step_limit": solver.max_steps steps were not enough */
  ZP_CONVERGED,     /* "converged": an equilibrium was found */
  ZP_FOLLOWED,      /* "followed": a branch of equilibria was followed to its end */
  ZP_BRANCH_LOST,   /* "branch_lost": a branch could not be followed further */
  ZP_BAD_ARGUMENT,  /* "bad_argument": an argument of the call is wrong; nothing was done */
  ZP_SHORT_CIRCUIT, /* "short_circuit": electrodes without an insulator touched under a voltage */
  ZP_PULLED_IN,     /* "pulled_in": no hanging equilibrium at this voltage: the actuator pulls in below it */
  ZP_EVENT,         /* "event": zp_sim_step_to_event has ended at an event */
  ZP_AT_BOUND,      /* "at_bound": the best value of a fitted key lies at its bound, or beyond it */
  ZP_TIME_LIMIT,    /* "time_limit": solver.max_cpu_time was not enough */
  ZP_REOPENED,      /* "reopened": the actuator has closed, and is open again at the end */
  ZP_BEYOND_MODEL,  /* "beyond_model": ribbons lie as the laws do not describe: a steep one has slid through the other,
                       or one has folded back */
  ZP_DOUBTFUL       /* "doubtful": a fit was found, but its residuals are not noise, or another one is as good */
} ZpOutcome;

/* The word for an outcome, as in summary.json; "unknown" for any other number. */
ZP_API const char *zp_outcome_name(ZpOutcome outcome);

/* True if the outcome is an answer, false if the solver failed or was interrupted, or ribbons lie as the model does not
 * describe. */
ZP_API bool zp_outcome_good(ZpOutcome outcome);

/* Functions that are called during a long call. All may be NULL. */
typedef struct ZpHooks {
  void *user; /* argument of the functions below */
  /* Called some times a second of wall time with the stage and its progress, 0 .. 1. Return true to stop; the results
   * so far are kept. */
  bool (*progress)(void *user, const char *stage, double fraction);
  /* Wall clock in s; without it wall times are NAN. */
  double (*clock)(void *user);
} ZpHooks;

/* Limits of a time step, by which steps are counted. */
typedef enum ZpStepLimit {
  ZP_LIMIT_TIME_STEP, /* solver.time_step */
  ZP_LIMIT_STABILITY, /* the stiffest spring */
  ZP_LIMIT_DRAG,      /* first bound of eq. (9) of the paper */
  ZP_LIMIT_EVENT,     /* a pair meets inside the step, or a corner of the waveform ends it */
  ZP_LIMIT_ERROR,     /* implicit: the local error, or the convergence of Newton's method */
  ZP_LIMIT_END,       /* the end of the run */
  ZP_LIMIT_COUNT
} ZpStepLimit;

/* The word for a step limit, as in summary.json; "unknown" for any other number. */
ZP_API const char *zp_step_limit_name(ZpStepLimit limit);

/* How a run went, for a program that asks by the calls below. */
typedef struct ZpRunInfo ZpRunInfo;

/* A new empty one, which belongs to the caller; NULL if there is no memory. */
ZP_API ZpRunInfo *zp_run_info_create(void);

/* Free it; NULL is allowed. */
ZP_API void zp_run_info_destroy(ZpRunInfo *info);

/* How the last run ended that filled it, and one sentence for people on that. */
ZP_API ZpOutcome zp_run_info_outcome(const ZpRunInfo *info);
ZP_API const char *zp_run_info_message(const ZpRunInfo *info);

/* Number of steps that `limit` set; 0 for any other number. */
ZP_API int64_t zp_run_info_limited(const ZpRunInfo *info, ZpStepLimit limit);

/* A number of it, SI; NAN if there is none of that name:
 *   steps            taken
 *   rejected         implicit: steps rejected for their local error
 *   failures         implicit: steps in which Newton's method did not converge
 *   iterations       implicit: iterations of Newton's method
 *   drag_bound, axial_bound, shear_bound
 *                    smallest bounds of eq. (9) of the paper, s, over the recorded rows
 *   simulated_time   s
 *   wall_time        of the stepping, s; NAN without a clock
 *   settle_steps     pseudo-time steps to the hanging equilibrium
 *   settle_residual  largest unbalanced force there, over all weight */
ZP_API double zp_run_info_get(const ZpRunInfo *info, const char *name);

/* A new simulation at t = 0, in its initial state and with the voltage of the waveform at this time. `model` must
 * outlive it. The function first finds the hanging equilibrium, which is the start and the reference of contraction; if
 * there is none, the next zp_sim_run returns ZP_NOT_SETTLED and does nothing else. With initial.state checkpoint the
 * simulation moves only after zp_sim_continue, or after another state has been given. `hooks` may be NULL.
 *
 * ZP_BAD_INPUT as zp_def_check_motion; as zp_def_check_voltage at the highest voltage of the waveform; if
 * drive.waveform is table and the model was made without a table; and if a controller measures the contraction of an
 * actuator that does not open. */
ZP_API ZpStatus zp_sim_create(const ZpModel *model, const ZpHooks *hooks, ZpSim **sim, ZpError *err);
ZP_API void zp_sim_destroy(ZpSim *sim);

/* Record rows in `series` and shapes in `shapes` during runs; each may be NULL. The columns are those of
 * zp_signal_columns or zp_signal_columns_of, or all of zp_signal_table. Both belong to the caller. */
ZP_API void zp_sim_record(ZpSim *sim, ZpTable *series, ZpShapes *shapes);

/* Run until `end_time` (s; INFINITY: until another end), or with `stop_when_zipped` until the actuator has closed. If
 * `end_time` is the present time, nothing moves. ZP_BAD_ARGUMENT, and nothing is done, if it is earlier or NAN. `hooks`
 * and `info` may be NULL. */
ZP_API ZpOutcome zp_sim_run(ZpSim *sim, double end_time, bool stop_when_zipped, const ZpHooks *hooks, ZpRunInfo *info);

/* Advance by `dt` (s, finite and above 0; else ZP_BAD_ARGUMENT, and nothing is done). For callers that do this again
 * and again, such as control loops: the explicit steps have equal length. zp_sim_run would end each time with a shorter
 * step, and such a sequence excites vibrations near the stability limit until the numbers diverge. */
ZP_API ZpOutcome zp_sim_step(ZpSim *sim, double dt, const ZpHooks *hooks, ZpRunInfo *info);

/* A zp_sim_step that ends with ZP_EVENT after the first step in which the actuator has closed, an input has reached the
 * end of its range, the voltage had a corner, or the supply has reached or left a limit. Until then the steps are those
 * of zp_sim_step. */
ZP_API ZpOutcome zp_sim_step_to_event(ZpSim *sim, double dt, const ZpHooks *hooks, ZpRunInfo *info);

/* Set the voltage from now on, V; drive.waveform has no effect any more. An ideal source charges the electrodes at
 * once: its work is U dQ, and the part of it that the field does not store is the signal charging_loss. A voltage that
 * is replaced before the simulation continues has no effect (unless a field had to be solved for it); an unchanged
 * voltage costs nothing. The same as zp_sim_set_input with rate 0; in a network it sets the voltages of all members in
 * proportion, as drive.voltage does, where zp_sim_set_input sets one channel. ZP_BAD_INPUT if the voltage is out of the
 * range of drive.voltage, and as zp_def_check_voltage. */
ZP_API ZpStatus zp_sim_set_voltage(ZpSim *sim, double voltage, ZpError *err);

/* Inputs that a program can change while a simulation runs. */
typedef enum ZpInput {
  ZP_INPUT_VOLTAGE,  /* "voltage": voltage between the electrodes, V; range of drive.voltage */
  ZP_INPUT_LOAD,     /* "load": a force on the whole actuator, N, in addition to the weight of load.mass, without
                        inertia; positive pulls the lower platform down (one ribbon: the right end); -10 kN to 10 kN, 0
                        until set; the modelled part carries load.share of it */
  ZP_INPUT_SETPOINT, /* "setpoint": setpoint of the model's controller (control.kind), in the unit of control.signal;
                        -1000 to 1000; setpoint.waveform has no effect any more. With a controller the voltage cannot be
                        set */
  ZP_INPUT_COUNT
} ZpInput;

/* The word for an input; "unknown" for any other number. */
ZP_API const char *zp_input_name(ZpInput input);

/* Inputs of an actuator or a network, which are numbers of a ZpInput or, in a network, above them:
 *   NAME.voltage, NAME.setpoint          of a member that has a port of its own, or its first one; V, in the unit of
 *                                        control.signal
 *   NAME.force_x, NAME.force_y, NAME.torque   on a body that moves, beside its force and torque, at its place; N, N m;
 *                                        -10 kN to 10 kN and kN m; to the right and torques in the plane only
 * A network has no "load". Each number after `input`, from -1 on; -1: there is none. Its name and unit; NULL: there is
 * no such input. The number of a name; -1: there is none. */
enum { ZP_INPUT_NAME_SIZE = 48 };
ZP_API int zp_def_input_next(const ZpActuatorDef *def, int input);
ZP_API const char *zp_def_input_name(const ZpActuatorDef *def, int input, char text[ZP_INPUT_NAME_SIZE]);
ZP_API const char *zp_def_input_unit(const ZpActuatorDef *def, int input);
ZP_API int zp_def_input_find(const ZpActuatorDef *def, const char *name);

/* The member whose port an input belongs to, from 1; 0: that of all members without one of their own; below 0: it is
 * none of a port. *which: ZP_INPUT_VOLTAGE or ZP_INPUT_SETPOINT, of another input its number. */
ZP_API int zp_def_input_member(const ZpActuatorDef *def, int input, int *which);

/* Replace the waveforms of members that have ports of their own by ramps that begin with the values at t = 0, and their
 * setpoints by these values, as for a program that sets them by inputs. ZP_MACHINE: no memory. */
ZP_API ZpStatus zp_def_forget_ports(ZpActuatorDef *def, ZpError *err);

/* Set an input: from now on it has this value, SI, and changes by `rate` per second (at most 1e12 in size), until it is
 * set again or reaches the end of its range, where it stays. The voltage jumps to `value`, as with zp_sim_set_voltage,
 * and then changes without loss. The work of the voltage is the signal electric_work, that of the load the signal
 * load_work. ZP_BAD_INPUT, and nothing is changed, if value or rate is out of range or there is no such input; for a
 * voltage that is or becomes other than 0 also as zp_def_check_voltage. */
ZP_API ZpStatus zp_sim_set_input(ZpSim *sim, ZpInput input, double value, double rate, ZpError *err);

/* zp_sim_set_input for the input called `name` ("voltage", "left.voltage", "hand.force_y"). ZP_BAD_INPUT also names the
 * nearest input if there is none of that name. */
ZP_API ZpStatus zp_sim_set_input_named(ZpSim *sim, const char *name, double value, double rate, ZpError *err);

/* The derivatives of all signals by an input at this instant, at fixed positions, SI, in the order of
 * zp_signal_columns: what a small jump of the input changes at once (docs/theory.md, section 17). The simulation does
 * not change. Signals are polynomials of second degree in the voltage, so the central difference that is used is exact
 * up to rounding, and up to 1e-6 where the breakdown cap begins to act. ZP_BAD_INPUT if there is no such input. */
ZP_API ZpStatus zp_sim_input_slopes(ZpSim *sim, ZpInput input, double *slope, ZpError *err);

/* How many numbers the table of this simulation's runs has in a row: the signals, of several members then numbers of
 * each member and body. The first `columns` of them now, SI; their derivatives, as zp_sim_input_slopes. */
ZP_API size_t zp_sim_columns(const ZpSim *sim);
ZP_API void zp_sim_read_columns(ZpSim *sim, size_t columns, double *row);
ZP_API ZpStatus zp_sim_column_slopes(ZpSim *sim, ZpInput input, size_t columns, double *slope, ZpError *err);

/* A controller of the program's own, which sets the voltage at equal intervals. */
typedef struct ZpController {
  double period; /* time between samples, s; 1e-9 to 1e4 */
  void *user;    /* argument of the function below: the memory of the controller */
  /* Returns the voltage from now on, V, in the range of drive.voltage; any other ends the run with ZP_BAD_ARGUMENT and
   * a message. `sim` may only be read (zp_sim_get, zp_sim_read, zp_sim_shape); `time` is its time, s. */
  double (*voltage)(void *user, ZpSim *sim, double time);
} ZpController;

/* Use this controller, which is copied, from now on. Its first sample is at the present time, when the next run starts,
 * and one follows every period; runs take their steps to these instants by themselves. The instants stay the same when
 * another state is restored; the program itself must restore the memory behind `user`. NULL removes the controller, and
 * the voltage stays. ZP_BAD_INPUT if the period is out of range or there is no function. */
ZP_API ZpStatus zp_sim_set_controller(ZpSim *sim, const ZpController *controller, ZpError *err);

/* Present value of the signal called `name` ("stroke"), SI, or of a number of a member or body, as zp_signal_table has
 * it, without its unit ("left.opening", "hand.y", "member_2_opening"); NAN if there is none. This does not affect the
 * simulation, but uses its work space: one thread at a time, as with all calls. */
ZP_API double zp_sim_get(ZpSim *sim, const char *name);

/* Present values of all signals, SI, in the order of zp_signal_columns: a row. The mean current is over the time since
 * the last row at an earlier time, so current times time adds up to the charge, jumps of the voltage included. */
ZP_API void zp_sim_read(ZpSim *sim, double *row);

/* The start of the interval over which the next row has its mean current and mean power. A snapshot does not contain
 * it: in a restored simulation the interval starts at the time of the snapshot, unless this is set again. */
typedef struct ZpRowStart {
  double time;   /* s */
  double charge; /* that the source had supplied, to one modelled part, C */
  double energy; /* that it had supplied, J */
} ZpRowStart;
ZP_API ZpRowStart zp_sim_row_start(const ZpSim *sim);
ZP_API void zp_sim_set_row_start(ZpSim *sim, ZpRowStart start);

/* Start this interval now. */
ZP_API void zp_sim_start_row(ZpSim *sim);

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

/* Time at which 99 % contraction was reached (or the pair of contact.complete_margin joined), s; NAN if not yet. */
ZP_API double zp_sim_zip_time(const ZpSim *sim);

/* Time from which the contraction has stayed at or above 99 % until now, s, at least zp_sim_zip_time; NAN if it is
 * lower now. A platform that arrives may bounce, and an actuator may open again. */
ZP_API double zp_sim_closed_from(const ZpSim *sim);

/* Time at which a zip front has outrun the liquid of its bead (liquid.model bead), s; NAN if not yet. */
ZP_API double zp_sim_starved_time(const ZpSim *sim);

/* The whole state as a snapshot: bytes that may be stored and moved to other machines; equal states have equal bytes on
 * every machine. They contain the version, the keys that define the model and a checksum; docs/formats.md has the
 * format. `bytes` must have room for zp_sim_state_size bytes, which is the same for all states of a model. */
ZP_API size_t zp_sim_state_size(const ZpSim *sim);
ZP_API void zp_sim_save(const ZpSim *sim, void *bytes);

/* Restore such a state, of this simulation or another one of the same model (zp_checkpoint_holds says which keys must
 * be the same). If the waveform differs, the voltage jumps to it. ZP_BAD_INPUT, and nothing is changed, if the bytes
 * are not a snapshot, cut short, damaged, of another version, or of another model; the message names the key that
 * differs.
 */
ZP_API ZpStatus zp_sim_restore(ZpSim *sim, const void *bytes, size_t size, ZpError *err);

/* The columns of a time series, one per signal, => their number. A later library may have more, and others at a place:
 * find a signal by its name, while the program runs. */
ZP_API const ZpColumn *zp_signal_columns(size_t *count);

/* The name of the signal in column `index` of these, without its unit ("stroke"). */
ZP_API const char *zp_signal_name(size_t index);

/* Those of zp_signal_columns with setpoint and measured in the unit of control.signal of `def`. */
ZP_API const ZpColumn *zp_signal_columns_of(const ZpActuatorDef *def, size_t *count);

/* A new table for the rows of a run of `def`, with these columns and behind them numbers of each member of a stack, of
 * at most `capacity` rows. NULL: there is no memory. */
ZP_API ZpTable *zp_signal_table(const ZpActuatorDef *def, size_t capacity);

/* The SI unit of control.signal: "m", "F" or "1". */
ZP_API const char *zp_control_unit(const ZpActuatorDef *def);

/* Place of the signal called `name` ("stroke") in a row, or -1. */
ZP_API int zp_signal_find(const char *name);

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
