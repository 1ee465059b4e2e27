/* The inside of a simulation, shared by the files of sim/. */
#ifndef ZP_SIM_SIM_INTERNAL_H
#define ZP_SIM_SIM_INTERNAL_H

#include <zipact/sim.h>

#include "actuator/shape.h"
#include "paper/motion/motion.h"
#include "rest/dynamics.h"
#include "sim/feed.h"
#include "system/held.h"

/* A controller of the program's own, and its samples: sample k is due at since + k period (control.c). */
typedef struct ZpOwnControl {
  ZpController controller; /* without a function: there is none */
  double since;            /* s */
  double taken;            /* samples so far, a whole number */
  ZpError fault;           /* why its voltage was refused */
} ZpOwnControl;

/* When a controller is due next, with a sample or an output, s; INFINITY without one. */
double zp_sim_control_due(const ZpSim *sim);

/* Take the sample and give the output that are due, if any. False if the voltage is refused. */
bool zp_sim_control(ZpSim *sim);

/* Where the state is another one: the next sample of a controller of the program's own is the first from the present
 * time on. */
void zp_sim_resume_control(ZpSim *sim);

/* The model's controller begins: no voltage until its first output. */
void zp_sim_start_control(ZpSim *sim);

/* What the setpoint is now, in the unit of control.signal; 0 without a controller. */
double zp_sim_setpoint(const ZpSim *sim);

/* The signal that the controller measures, without noise. */
double zp_sim_controlled(ZpSim *sim);

/* What a controller has seen, in columns of a table. */
enum { ZP_SAMPLE_TIME, ZP_SAMPLE_SETPOINT, ZP_SAMPLE_SIGNAL, ZP_SAMPLE_COLUMNS };
const ZpColumn *zp_sample_columns(size_t *count);

/* From now on each sample is a row of this table, the signal without noise; NULL: of none. */
void zp_sim_keep_samples(ZpSim *sim, ZpTable *samples);

/* How a run moves on (stepping.c). */
typedef struct ZpStepping {
  /* What it takes. False if there is no memory. */
  bool (*create)(ZpSim *sim);
  /* One step that ends at `latest`, s, or before => what set its size; false if none was found. */
  bool (*step)(ZpSim *sim, double latest, ZpStepLimit *limit);
  /* No step will be longer than that, s. */
  double (*longest)(const ZpSim *sim);
  int64_t between_questions; /* steps between questions to the caller, about a millisecond */
  bool fine;                 /* steps are so short that what happens inside one happens at its end */
} ZpStepping;

/* As solver.integrator says. */
const ZpStepping *zp_stepping_of(const ZpModel *model);

/* From now on a source, which must live as long, is between the drive and the electrodes of a simulation by implicit
 * steps; it says what the voltage is. False if there is no memory. */
bool zp_sim_connect(ZpSim *sim, const ZpSource *source);

/* An actuator is closed below this part of its hanging opening. */
#define ZP_CLOSED_PART 0.01

/* Room for the liquid of all members, of the uppermost simulation. */
typedef struct ZpLiquidRoom {
  double *thickness, *pressure; /* [members nodes] */
  double *wet_length;           /* [members ZP_BEADS] */
  void *memory;                 /* where they are */
} ZpLiquidRoom;

/* The platform where a step begins. */
typedef struct ZpStepStart {
  double t, opening, rate; /* s, m, m/s */
} ZpStepStart;

struct ZpSim {
  const ZpModel *model;
  ZpState *state;
  ZpState *kept;   /* a copy of a state of sound numbers that a longer run passes through, too, where */
  ZpState *before; /* behind a supply: a copy of where the step began */
  ZpFeed feed;     /* the supply at the electrodes */
  ZpOwnControl control;
  bool cut;   /* the end of the run has cut a step since */
  int drive;  /* the key drive.voltage: its range is that of voltages set by hand */
  int signal; /* the key control.signal */
  ZpEval eval;
  double *relax_work;            /* [12 stride] work space of settling */
  ZpTable *series;               /* the caller's; NULL: no record */
  ZpShapes *shapes;              /* the caller's; NULL: no record */
  ZpTable *trace;                /* likewise */
  ZpTable *samples;              /* likewise, of a controller */
  double *row;                   /* one value per signal */
  ZpShapeRoom shape_room;        /* of the shape handed out, */
  void *shape_memory;            /* and where it is */
  ZpShape shape;                 /* this member at the last row with margins */
  ZpMargins now;                 /* the worst that materials see in the row, */
  bool watched;                  /* and whether they are watched over time: */
  ZpMargins seen;                /* the worst that those of this member saw */
  double row_time, row_charge;   /* of the last row before the present time, for the mean current: per part, behind a
                                    supply what that has given; */
  double row_energy;             /* and for the mean power, of the whole actuator */
  double own_charge, own_energy; /* of the last row: charge per part and source energy, without the members below */
  ZpOutcome settled;             /* ZP_REACHED_END once the hanging equilibrium is known */
  int64_t settle_steps;
  double settle_residual;
  const ZpStepping *stepping; /* how it moves on: */
  ZpDynamics dynamics;        /* by implicit steps, */
  ZpPaperMotion paper;        /* or by the paper's */
  ZpStepStart step_start;     /* of the last step */
  bool stuck;                 /* no step was found */
  bool stops_at_events;       /* the run ends at the first one */
  bool at_event;              /* the last step has ended at one */
  struct ZpSim *below;        /* of a series: the member that hangs on this one's lower platform; NULL: none */
  ZpState **states;           /* of the uppermost: of it and of all below */
  struct ZpRunRates *rates;   /* what follows the derivatives of the run; NULL: nothing does */
  ZpLiquidRoom liquid;        /* of the liquid handed out */
  ZpManyShapes all;           /* of the uppermost of a series: room for the shape of all, */
  void *all_memory;           /* and where it is */
};

/* A simulation that starts at coordinates q [2 stride], NULL: straight, without looking for its hanging equilibrium,
 * whose opening is given. NULL: there is no memory. */
ZpSim *zp_sim_create_at(const ZpModel *model, const double *q, double opening0);

/* The next corner of what is told from outside, s. */
double zp_sim_next_corner(ZpSim *sim);

/* Copy the states of all members of a series, or of the only one, to `before`, and back. */
void zp_sim_keep_states(ZpSim *sim);
void zp_sim_take_states_back(ZpSim *sim);

/* What the materials of one member see counts, if they are watched (sim/margins.h). */
void zp_sim_see_one(ZpSim *sim);

/* Before a step moves anything; false: it cannot. And where it has ended. */
bool zp_sim_prepare(ZpSim *sim);
void zp_sim_arrive(ZpSim *sim);

/* When the path of the last step, of two ribbons, passes the opening that counts as closed, s; that may be a little
 * before it or after it. */
double zp_sim_crossing(const ZpSim *sim);

/* Find the hanging equilibrium (settle.c): sets opening0 and, if the run starts there, the positions. False if
 * there is no memory. */
bool zp_sim_settle(ZpSim *sim, const ZpHooks *hooks);

/* The same of antagonists, which are at rest against each other. */
bool zp_sim_settle_together(ZpSim *sim, const ZpHooks *hooks);

/* Lay the beads of the state where its gaps let them be: at rest, of all liquid that is not outside or lost. */
void zp_sim_lay_beads(ZpSim *sim);

/* The member that the load hangs on. */
ZpSim *zp_sim_loaded(ZpSim *sim);

/* When load.change_mass is still to come or to go, s; INFINITY: never. And it comes or goes now (catch.c). */
double zp_sim_load_due(const ZpSim *sim);
void zp_sim_change_load(ZpSim *sim);

/* Resume from the state as it has just been given: at the waveform's voltage of its time. */
void zp_sim_resume(ZpSim *sim);

/* The last states so far that a longer run passes through, too; of sound numbers => state [members]. */
void zp_sim_passed(const ZpSim *sim, ZpState *state[]);

/* Sum of kinetic and stored energy without the field, of one part, J. */
double zp_energy_without_field(const ZpEnergies *energies);

/* What the source has given and the field has not kept of jumps so far, of one part, J (account.c). */
typedef struct ZpAccount {
  double work, charging_loss;
} ZpAccount;

/* (electric totals where the state is) => the account there; the state stays as it is. */
ZpAccount zp_sim_account(ZpSim *sim, ZpElectric now);

/* Energies and losses count from here on. */
void zp_sim_start_account(ZpSim *sim);

/* Book what the source has given until now, with a jump that is still open; a held field that is out of date is found
 * again on the way. */
void zp_sim_close_account(ZpSim *sim);

/* From now on this voltage by hand, V, within its range: behind a supply its command, else a jump. */
void zp_sim_hold_voltage(ZpSim *sim, ZpRamp voltage);

/* The voltage jumps: an ideal source charges at once. */
void zp_sim_jump(ZpSim *sim, double voltage);

/* The voltage goes to another one while nothing moves, without loss. */
void zp_sim_glide(ZpSim *sim, double voltage);

/* The mean current and power of the next row count from here. */
void zp_sim_start_row(ZpSim *sim);

/* What a trace of a run has, in columns of a table. */
enum { ZP_TRACE_TIME, ZP_TRACE_VOLTAGE, ZP_TRACE_CHARGE, ZP_TRACE_CAPACITANCE, ZP_TRACE_STROKE, ZP_TRACE_COLUMNS };
const ZpColumn *zp_trace_columns(size_t *count);

/* From now on rows are offered to this trace, too, as often as to the records; NULL: to none. The charge is that which
 * the source has given to electrodes and insulators, C. */
void zp_sim_trace(ZpSim *sim, ZpTable *trace);

/* What leaks now, of one part; all 0 where nothing does. */
ZpLeakNow zp_sim_leak(ZpSim *sim);

/* When member 1 .. of a series has closed, s; NAN: it has not. */
double zp_sim_member_zip_time(const ZpSim *sim, size_t member);

/* Numbers of a row, openings of the members of a series included. */
size_t zp_sim_row_size(void);

/* Offer the present row and shape to the records; at the end make them the last. */
void zp_sim_offer_record(ZpSim *sim);
void zp_sim_close_record(ZpSim *sim);

#endif
