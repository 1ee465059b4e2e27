/* An actuator in motion as a system for solve/implicit.h: mean forces over a step, whose work is exactly the change of
 * the energies of ribbons and plates; unilateral contact; damping. docs/theory.md, section 18.
 *
 * Several actuators are one system: the equations of its members one after the other, then, in the border, the
 * coordinates that ties join. Sections 29 and 31. */
#ifndef ZP_RUN_DYNAMICS_H
#define ZP_RUN_DYNAMICS_H

#include "actuator/assemble.h"
#include "solve/implicit.h"
#include "system/links.h"
#include "system/springs.h"
#include "system/system.h"
#include "term/source.h"

struct ZpDynamics;

/* The electrodes of one port, with the source behind which their voltage is an unknown. */
typedef struct ZpMovingPort {
  const ZpSource *source;
  const struct ZpDynamics *of;
  size_t first;    /* of its members */
  size_t unknown;  /* their voltage, in all equations */
  ZpSourceLaw law; /* at the last residual, and the capacitance of all electrodes there, F */
  double chord;
} ZpMovingPort;

/* One of the actuators of the system. */
typedef struct ZpMovingMember {
  const ZpModel *model;
  ZpEval eval;
  ZpAssembly assembly;
  const ZpState *state;  /* at the start of the present step */
  ZpMovingPort *port;    /* NULL: its voltage is given */
  double U0, U1;         /* voltage at its start and its end, V */
  double charge0;        /* with a source: charge of one part there, C, */
  double charge1;        /* and at the end of the last step */
  double *start, *end;   /* [2 stride] coordinates of nodes */
  double *own;           /* [own N] the laws' own unknowns in the present step */
  double pressure;       /* of a pouch, at which the search of the present step stands, Pa */
  const double *mean_v;  /* [2 stride] mean velocity over the last step, m/s */
  double *force, *moved; /* [2 stride] N; work space */
  double *gap;           /* [N] gaps of the last force, m */
  double *foreseen;      /* [N] contact force that the last tangent predicts after a correction, N */
  double with[2];        /* mass that ties join to its upper platform and to its lower one, kg */
  ZpVector normal;       /* in the plane: the direction that it sees as up, where its nodes are unknowns */
  double added;          /* mass on each end that carries the load, in addition to that of the model, kg */
} ZpMovingMember;

typedef struct ZpDynamics {
  size_t members;
  ZpMovingMember *member; /* [members] */
  ZpArrowForm form;       /* of the matrix */
  ZpParts parts;          /* halves, and the equations that both have */
  ZpImplicitSystem system;
  ZpImplicit stepper;
  ZpImplicitHistory history;
  double *mass, *q, *v;          /* [n] by equations */
  double *joined;                /* [border] mass of all nodes that move with an unknown of the border, kg */
  double *lost;                  /* [members] velocity that its platform loses where several land side by side, m/s */
  ZpSprings springs;             /* between bodies, */
  ZpPlanar plane;                /* of bodies in the plane, */
  ZpLinks links;                 /* what joins them, */
  ZpPose *pose0, *pose1;         /* [bodies] and where they are at the step's start and at its end */
  double *push;                  /* [bodies] mean of the forces upwards that a program sets, N */
  double *from, *to;             /* [n] and the unknowns between which they act: at the step's start and at its end */
  ZpUnknown *kind;               /* [n] */
  double *scale, *sharers;       /* [n] */
  double t, h, latest;           /* of the present step: start, length, latest end, s */
  size_t fewest;                 /* cavities that contradict their heads, at least, in the iteration under way, */
  int trials;                    /* and the corrections left to make them fewer */
  size_t ports;                  /* those with a source; their voltages are the last unknowns */
  ZpMovingPort *port;            /* [ports] */
  ZpByVoltage by_voltage;        /* of one member, with a source; work space, as are */
  double *column, *row;          /* [places of a block] column and row of the voltage in it */
  double error;                  /* of a step, at most, as a share of the reference length, eq. (18.12) */
  bool settles;                  /* without a film, each step removes velocities that are too fast for it, not only
                                    after impacts: for a search of motion that has settled */
  bool filters;                  /* the last step has removed velocities that are too fast for it */
  const struct ZpDynamics *lead; /* a simulation with nearly the same key whose filtering these steps repeat; NULL:
                                    none */
  void *memory;
} ZpDynamics;

/* For all members, of which this is the first model. `source` [members]: that of the port of which a member is the
 * first, which must outlive it; NULL, there or instead of all: its voltage is given. False if there is no memory. */
bool zp_dynamics_create(const ZpModel *model, const ZpSource *const source[], ZpDynamics *dynamics);
void zp_dynamics_destroy(ZpDynamics *dynamics);

/* The mass load.change_mass arrives with the velocity of its fall, or leaves: change the velocities of the
 * states [members]. */
void zp_dynamics_change_load(ZpDynamics *dynamics, ZpState *const state[]);

/* Take one step that ends at `latest`, s, or earlier => the states [members] at its end, with time, losses, and the
 * work of the source if the voltage has changed. The account of the voltage must be closed (state->base_U == state->U).
 * Returns the length of the step; 0 if no step converged: the states are then unchanged. */
double zp_dynamics_step(ZpDynamics *dynamics, ZpState *const state[], double latest);

/* The two halves of a step, for a step that is computed in another way: before it, states => q, v, history; after it, q
 * and v => states, with the eval at the end of the step. */
void zp_dynamics_begin(ZpDynamics *dynamics, ZpState *const state[], double latest);
void zp_dynamics_end(ZpDynamics *dynamics, ZpState *const state[]);

/* Note in the state of a member, where the last step has ended, the force with which the load that members side by side
 * share pulls its platform up; `before` is its state at the start of the step. */
void zp_dynamics_book_link(ZpDynamics *dynamics, size_t which, ZpState *before, ZpState *state);

#endif
