/* The inside of a simulation, shared by the files of run/. */
#ifndef ZP_RUN_RUN_H
#define ZP_RUN_RUN_H

#include "run/info.h"

#include "actuator/shape.h"
#include "rest/statics.h"
#include "run/dynamics.h"
#include "run/paper_motion.h"
#include "run/still.h"
#include "run/supply_coupling.h"
#include "system/cached_field.h"

/* A controller of the program's own, and its samples: sample k is due at since + k period (control.c). */
typedef struct ZpOwnControl {
  ZpController controller; /* without a function: there is none */
  double since;            /* time of the first sample, s */
  double taken;            /* number of samples so far, a whole number */
  ZpError fault;           /* the reason why its voltage was refused */
} ZpOwnControl;

/* Of one member: time of the next sample or output of its controller, s; INFINITY without a controller. */
double zp_sim_control_due(const ZpSim *m);

/* Take the samples and give the outputs that are due, if any. False if a voltage is refused. */
bool zp_sim_control(ZpSim *sim);

/* After another state was set: the next sample of a controller of the program's own is the first at or after the
 * present time. */
void zp_sim_resume_control(ZpSim *sim);

/* Has any port one of the model's controllers? */
bool zp_sim_any_controlled(const ZpSim *sim);

/* Start the controllers of all ports: the voltage is 0 until the first output. */
void zp_sim_start_control(ZpSim *sim);

/* Of the first member on a port: the present setpoint, in the unit of control.signal; 0 without a controller. */
double zp_sim_setpoint(const ZpSim *lead);

/* The signal that its controller measures, without noise: of the whole actuator, or, in a network and on a port apart,
 * of this member; the capacitance is that of all on the port. */
double zp_sim_controlled(ZpSim *lead);

/* A signal of one member alone. */
double zp_sim_own_signal(ZpSim *sim, int signal);

/* The next signal after this one, at first 0, that is a row which signals.def does not list of a law of the model =>
 * false if there is none. */
bool zp_sim_next_row(const ZpSim *sim, size_t *signal);

/* Samples of a controller, as columns of a table. */
enum { ZP_SAMPLE_TIME, ZP_SAMPLE_SETPOINT, ZP_SAMPLE_SIGNAL, ZP_SAMPLE_COLUMNS };
const ZpColumn *zp_sample_columns(size_t *count);

/* From now on add a row to this table for each sample, with the signal without noise; NULL: no table. */
void zp_sim_keep_samples(ZpSim *sim, ZpTable *samples);

/* A method of time stepping (step.c). */
typedef struct ZpStepping {
  /* Allocate what it needs. False if there is no memory. */
  bool (*create)(ZpSim *sim);
  /* Take one step that ends at `latest`, s, or earlier => the limit that set its size; false if no step succeeded. */
  bool (*step)(ZpSim *sim, double latest, ZpStepLimit *limit);
  /* Upper bound of the next step, s. */
  double (*longest)(const ZpSim *sim);
  int64_t between_questions; /* steps between calls of the progress hook, about a millisecond */
  bool fine;                 /* steps are so short that events inside a step count at its end */
} ZpStepping;

/* The method of solver.integrator. */
const ZpStepping *zp_stepping_of(const ZpModel *model);

/* Connect a source, which must outlive the simulation, between the drive and the electrodes on the first port of a
 * simulation with implicit steps; from now on it determines the voltage. False if there is no memory. */
bool zp_sim_connect(ZpSim *sim, const ZpSource *source);

/* Arrays for the liquid of all members, in the uppermost simulation. */
typedef struct ZpLiquidRoom {
  double *thickness, *pressure; /* [members nodes] */
  double *wet_length;           /* [members ZP_BEADS] */
  void *memory;                 /* memory of the arrays */
} ZpLiquidRoom;

/* The platform at the start of a step. */
typedef struct ZpStepStart {
  double t, opening, rate; /* s, m, m/s */
} ZpStepStart;

/* Where a run ends before its end time. */
typedef enum ZpStop {
  ZP_STOP_AT_END, /* nowhere */
  ZP_STOP_CLOSED, /* where the actuator has closed for the first time */
  ZP_STOP_HELD    /* where it has stayed closed and hardly moved for a while */
} ZpStop;

/* Instants within a step at which a run ends. */
typedef enum ZpLanding { ZP_LANDS_NOWHERE, ZP_LANDS_CLOSED, ZP_LANDS_RESTED, ZP_LANDS_SHORTED } ZpLanding;

/* A trace of a port over a run, as columns of a table. */
enum { ZP_TRACE_TIME, ZP_TRACE_VOLTAGE, ZP_TRACE_CHARGE, ZP_TRACE_CAPACITANCE, ZP_TRACE_STROKE, ZP_TRACE_COLUMNS };
const ZpColumn *zp_trace_columns(size_t *count);

/* From now on also offer rows to this trace, as often as to the records; NULL: no trace. The charge is what the source
 * has supplied to electrodes and insulators, C. The stroke is that of the only member on the port, or of the whole
 * stack; NAN: there is none. */
void zp_sim_trace(ZpSim *lead, ZpTable *trace);

struct ZpSim {
  const ZpModel *model;
  ZpState *state;
  ZpState *kept;                /* a copy of a valid state through which a longer run would also pass */
  ZpState *before;              /* a copy of the state at the start of the step */
  ZpSupplyCoupling feed;        /* the supply at the electrodes */
  ZpSupplyCoupling feed_before; /* the same at the start of the step */
  ZpOwnControl control;
  bool cut;   /* the end of the run has shortened a step since `kept` */
  int drive;  /* the key drive.voltage, which has the range of voltages that a program sets */
  int signal; /* the key control.signal */
  ZpEval eval;
  double *relax_work;               /* [12 stride] work space of settling */
  ZpPose *pose;                     /* of the first member: [bodies] work space */
  ZpTable *series;                  /* belongs to the caller; NULL: no record */
  ZpShapes *shapes;                 /* belongs to the caller; NULL: no record */
  ZpTable *trace;                   /* likewise, of its port, by its first member */
  double own_row[ZP_TRACE_COLUMNS]; /* of that trace: what this member has in the last row */
  ZpTable *samples;                 /* likewise, of a controller */
  double *row;                      /* one value per signal, then rows of the ledger that are no signals */
  size_t row_at[ZP_MOST_ROWS];      /* places of rows of the ledger in it */
  ZpShapeRoom shape_room;           /* of the shape that zp_sim_shape returns */
  void *shape_memory;               /* memory of shape_room */
  ZpShape shape;                    /* this member at the last row with margins */
  ZpMargins now;                    /* the smallest margins of the materials in the row */
  bool watched;                     /* whether margins are followed over time */
  ZpMargins seen;                   /* the smallest margins of this member so far */
  double row_time, row_charge;   /* of the last row before the present time, for the mean current: per part, the charge
                                    that sources have given to it; the first member has all of a supply */
  double row_energy;             /* of that row, for the mean power, of the whole actuator */
  double own_charge, own_energy; /* of the last row: that charge and source energy, without the members below */
  ZpOutcome settled;             /* ZP_REACHED_END once the hanging equilibrium is known */
  char falls[ZP_NO_REST_SIZE];   /* why it is not known, where a body falls; else empty */
  int64_t settle_steps;
  double settle_residual;
  const ZpStepping *stepping;     /* the method of time stepping */
  ZpDynamics dynamics;            /* of implicit steps */
  ZpPaperMotion paper;            /* of the paper's steps */
  ZpStepStart step_start;         /* of the last step */
  bool step_failed;               /* no step succeeded */
  bool negative;                  /* a row has had a negative capacitance */
  const char *fault;              /* why the model does not describe where the last run ended; NULL: it does */
  bool links_due;                 /* zp_sim_book_links has something to do */
  bool stops_at_events;           /* the run ends at the first event */
  bool at_event;                  /* the last step has ended at an event */
  ZpStop stop;                    /* where the run under way ends before its end time */
  ZpLanding landing;              /* the run has ended at this instant, exactly at the end of the last step, */
  double left_before;             /* and what was left until then at the start of that step: zp_sim_left */
  size_t fed;                     /* of the first one: ports with a supply that acts */
  size_t members;                 /* simulations of one member each that follow each other, from this first one on */
  ZpState **states;               /* [members] of the first one: the states of all */
  struct ZpRunSensitivity *rates; /* derivatives of the run; NULL: none */
  void (*stepped)(ZpSim *sim, void *user); /* called after each step, with its user; NULL: none */
  void *stepped_user;
  ZpLiquidRoom liquid; /* of the liquid that zp_sim_liquid returns */
  ZpManyShapes all;    /* of the uppermost member of a series: arrays for the shape of all members */
  void *all_memory;    /* memory of these arrays */
};

/* The next member on the port of one, as a number after its own: 0: none. The first member of all; on a port. */
static inline size_t zp_sim_next(const ZpSim *m) {
  return zp_next_on_port(m->model);
}

static inline const ZpSim *zp_sim_first(const ZpSim *m) {
  return m - m->model->number;
}

static inline ZpSim *zp_sim_lead(ZpSim *m) {
  return m - m->model->number + m->model->network->ends[m->model->number].port;
}

/* Is it the first member on a port with a supply that acts? With a controller? */
static inline bool zp_sim_has_supply(const ZpSim *m) {
  return zp_sim_is_fed(m) && zp_leads_port(m->model);
}

static inline bool zp_sim_is_controlled(const ZpSim *m) {
  return m->model->control.kind != ZP_CONTROL_NONE;
}

/* A simulation of nearly the same actuators, with these models, that starts near `sim`, which has not moved: at
 * `offset` along the rates [members] of its states, without computing its hanging equilibrium. NULL: there is no
 * memory. */
ZpSim *zp_sim_create_near(const ZpSim *sim, const ZpModel *model, ZpState *const rate[], double offset);

/* Start at rest at coordinates q of all nodes, bent there from the natural shape for the first time; `pressure` of a
 * pouch, Pa. */
void zp_sim_start_at(ZpSim *sim, const double *q, double pressure);

/* Voltage of one member that no supply holds back, now, V. */
double zp_sim_voltage_now(const ZpSim *m);

/* Would a run end in the present state? */
bool zp_sim_stops(const ZpSim *sim, ZpStop stop);

/* Distance of the state from an instant of ending, m: positive before it, 0 at it. That of one member, and the member
 * whose distance is that of all. */
double zp_sim_left(const ZpSim *sim, ZpLanding landing);
double zp_sim_left_of(const ZpSim *m, ZpLanding landing);
size_t zp_sim_decides(const ZpSim *sim, ZpLanding landing);

/* As zp_sim_run, with this end. */
ZpOutcome zp_sim_run_until(ZpSim *sim, double end_time, ZpStop stop, const ZpHooks *hooks, ZpRunInfo *info);

/* The next corner of the inputs: its time, s, and how many of them have it, to rounding. */
typedef struct ZpCorner {
  double t;
  size_t inputs;
} ZpCorner;
ZpCorner zp_sim_next_corner(ZpSim *sim);

/* Copy the states of all members of a series, or of the only one, to `before`, and back. */
void zp_sim_keep_states(ZpSim *sim);
void zp_sim_take_states_back(ZpSim *sim);

/* Update the smallest margins of one member, if margins are followed (run/margins.h). */
void zp_sim_see_one(ZpSim *sim);

/* Take one step of a run, at most to `end_time`, and count it (step.c). */
void zp_sim_advance(ZpSim *sim, double end_time, ZpRunInfo *info);

/* Complete the states after a step, where they are looked at: note the forces of links between members side by side,
 * which take one more evaluation of all forces (step.c). */
void zp_sim_book_links(ZpSim *sim);

/* Note which events have happened in the last step of one member (closing.c). */
void zp_sim_note_end(ZpSim *sim, const ZpMovingMember *moved);

/* How a run ends in the present state; ZP_REACHED_END: it does not. The instant within the last step at which it ends.
 */
ZpOutcome zp_sim_end(const ZpSim *sim);
ZpLanding zp_sim_landing(const ZpSim *sim);

/* Prepare a step before anything moves; false if this fails. Complete a step at its end. */
bool zp_sim_prepare(ZpSim *sim);
void zp_sim_arrive(ZpSim *sim);

/* Time at which the path of the last step, of two ribbons, passes the opening that counts as closed, s; this may be
 * slightly before or after the step. */
double zp_sim_crossing(const ZpSim *sim);

/* The actuator has closed at `start`, in the last step or close to it: what is known of its rest begins there. */
void zp_sim_close(ZpSim *sim, ZpOpeningAt start);

/* Find the hanging equilibrium (settle.c): sets opening0 and, if the run starts there, the positions. False if
 * there is no memory. */
bool zp_sim_settle(ZpSim *sim, const ZpHooks *hooks);

/* Lower members in series until each hangs on the one above. */
void zp_sim_hang(ZpSim *sim);

/* Place the beads of the state by its gaps: at rest, with all liquid that is not outside or lost. */
void zp_sim_lay_beads(ZpSim *sim);

/* Opening where all hang, in series the sum over the members, m. */
double zp_sim_hanging(const ZpSim *sim);

/* The member that carries the load. */
ZpSim *zp_sim_loaded(ZpSim *sim);

/* Time at which load.change_mass will still be caught or dropped, s; INFINITY: never. Catch or drop it now
 * (load_change.c).
 */
double zp_sim_load_due(const ZpSim *sim);
void zp_sim_change_load(ZpSim *sim);

/* Resume from a state that was just set, with the voltage that the waveform has at its time. */
void zp_sim_resume(ZpSim *sim);

/* The last valid states through which a longer run would also pass => state [members]. */
void zp_sim_passed(const ZpSim *sim, ZpState *state[]);

/* Work of the source so far, and the part of it at jumps that the field did not store, of one part, J
 * (energy_balance.c). */
typedef struct ZpBalance {
  double work, charging_loss;
} ZpBalance;

/* The account of the present state, with its electric totals `now`; the state does not change. */
ZpBalance zp_sim_energy_balance(ZpSim *sim, ZpElectric now);

/* Count energies and losses from now on. */
void zp_sim_start_balance(ZpSim *sim);

/* Poses of bodies in the plane [bodies], by the first member; valid until the next call. */
const ZpPose *zp_sim_poses(const ZpSim *first);

/* The place of a body of the system, of which this is the first member, and its angle. */
ZpPose zp_sim_place(const ZpSim *first, size_t body);

/* Of a network: work against the weights of its bodies and the forces on them, from height 0 to the present ones, J. */
double zp_sim_lifted(const ZpSim *first);

/* Of the first member: the energy of springs and joints between bodies; of bodies in the plane also that of their
 * weights and of their motion, and of any member that of its ribbons' weight: added to rows of the ledger. */
void zp_sim_add_springs(const ZpSim *sim, double *ledger);

/* Close the account of the source at the present time, including a jump that is still open; a held field that is out of
 * date is recomputed first. */
void zp_sim_close_balance(ZpSim *sim);

/* Set this voltage of a port, by its first member, from now on, V, within its range: the command of a supply, or else a
 * jump. That of all ports by drive.voltage of all. */
void zp_sim_hold_port(ZpSim *lead, ZpRamp voltage);
void zp_sim_hold_voltage(ZpSim *sim, ZpRamp voltage);

/* That of the port of all members that have none of their own. */
void zp_sim_hold_common_port(ZpSim *sim, ZpRamp voltage);

/* The member whose port has the voltage that an input sets; NULL: it sets no voltage. */
ZpSim *zp_sim_port_of(ZpSim *sim, int input);

/* Let the voltage jump: an ideal source charges at once. */
void zp_sim_jump(ZpSim *sim, double voltage);

/* Change the voltage without loss while nothing moves. */
void zp_sim_glide(ZpSim *sim, double voltage);

/* The present leakage of one part; all 0 without leakage. */
ZpLeakNow zp_sim_leak(ZpSim *sim);

/* Time at which member 1, 2, ... of a series has closed, s; NAN: it has not. */
double zp_sim_member_zip_time(const ZpSim *sim, size_t member);

/* Number of values in the row of a member; that of the first of several includes the numbers of each. */
size_t zp_sim_row_size(const ZpSim *sim);

/* Find the places of the ledger's rows in a row. */
void zp_sim_place_rows(ZpSim *sim);

/* Offer the present row and shape to the records; at the end make them the last. */
void zp_sim_offer_record(ZpSim *sim);
void zp_sim_close_record(ZpSim *sim);

#endif
