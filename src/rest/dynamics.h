/* An actuator in motion as a system for solve/implicit.h: mean forces over a step that do exactly the work by which the
 * energies of ribbons and plates change, unilateral contact, damping. docs/theory.md, section 18.
 *
 * A series of actuators is one system: the equations of its members one after the other, then, in the border, the force
 * of each link, which makes the platforms that it joins move as one. Section 29. */
#ifndef ZP_REST_DYNAMICS_H
#define ZP_REST_DYNAMICS_H

#include "actuator/assemble.h"
#include "solve/implicit.h"
#include "system/system.h"
#include "term/source.h"

typedef struct ZpDynamics {
  const ZpModel *model;
  ZpImplicitSystem system;
  ZpImplicit stepper;
  ZpEval eval;
  ZpImplicitHistory history;
  ZpAssembly assembly;
  double *moved;                    /* [2 stride] work space */
  double *own;                      /* [own N] the laws' own unknowns in the step under way */
  const double *mean_v;             /* [2 stride] mean velocity over the last step, m/s */
  const ZpSource *source;           /* NULL: the voltage is given */
  ZpUnknown *kind;                  /* [n] with a source: the last is the voltage */
  double *scale;                    /* [n] */
  ZpByVoltage by_voltage;           /* with a source */
  double charge0;                   /* of one part where the step begins, C, */
  double charge1;                   /* and where the last one ended */
  double *mass, *q, *v;             /* [n] by equations */
  double added;                     /* mass on each end that the load hangs on, beyond that of the model, kg */
  double *start, *end;              /* [2 stride] coordinates of nodes */
  double *force;                    /* [2 stride] N */
  double *gap;                      /* [N] gaps of the last force, m */
  double *foreseen;                 /* [N] what the last tangent makes of the push after a correction, N */
  const ZpState *state;             /* at the start of the step under way */
  double latest;                    /* when that step ends at the latest, s */
  double h, U0, U1;                 /* its length, s; voltage at its start and its end, V */
  struct ZpDynamics *above, *below; /* of a series: its neighbours; NULL: none */
  size_t at;                        /* where its equations begin among those of the series */
  size_t links;                     /* of the uppermost member: how many hold the members together */
  bool filters;                     /* the last step has taken out of velocities what it does not follow */
  const struct ZpDynamics *lead;    /* whose steps these follow, as near it: they filter where it does; NULL: none */
  void *memory;
} ZpDynamics;

/* Of the model and all members below it. `source` must live as long; NULL: the voltage is given, as it is of a series.
 * False if there is no memory. */
bool zp_dynamics_create(const ZpModel *model, const ZpSource *source, ZpDynamics *dynamics);
void zp_dynamics_destroy(ZpDynamics *dynamics);

/* The mass that load.change_mass says comes, as fast as it has fallen, or goes => the state's velocities. */
void zp_dynamics_change_load(ZpDynamics *dynamics, ZpState *state);

/* One step that ends at `latest`, s, or before => the state [members] at its end: its time, its losses, the source's
 * work where the voltage has changed. The account of the voltage must be closed (state->base_U == state->U). => the
 * step's length; 0 if none was found: the state is then as it was. */
double zp_dynamics_step(ZpDynamics *dynamics, ZpState *const state[], double latest);

/* Its two halves, for a step that is found otherwise: before it, the state => q, v, history; and after it, back, with
 * the eval at its end. */
void zp_dynamics_begin(ZpDynamics *dynamics, ZpState *const state[], double latest);
void zp_dynamics_end(ZpDynamics *dynamics, ZpState *const state[]);

#endif
