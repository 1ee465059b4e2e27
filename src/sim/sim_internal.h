/* The inside of a simulation, shared by the files of sim/. */
#ifndef ZP_SIM_SIM_INTERNAL_H
#define ZP_SIM_SIM_INTERNAL_H

#include <zipact/sim.h>

#include "actuator/eval.h"
#include "rest/dynamics.h"
#include "solve/explicit.h"

struct ZpSim {
  const ZpModel *model;
  ZpState *state;
  ZpState *kept; /* a copy of the last state that a longer run passes through, too; of sound numbers */
  bool cut;      /* the end of the run has cut a step */
  ZpEval eval;
  double *a;                   /* [2 stride] accelerations, work space of a step */
  double *relax_work;          /* [12 stride] work space of settling */
  ZpTable *series;             /* the caller's; NULL: no record */
  ZpShapes *shapes;            /* the caller's; NULL: no record */
  double *row;                 /* one value per signal */
  double *line_force;          /* [nodes] of the shape handed out */
  double *push, *pressed;      /* [N] explicit unilateral contact: N, N/m */
  double row_time, row_charge; /* of the last row, for the mean current */
  ZpOutcome settled;           /* ZP_REACHED_END once the hanging equilibrium is known */
  int64_t settle_steps;
  double settle_residual;
  ZpDynamics dynamics; /* integrator implicit */
  bool stuck;          /* it found no step */
  double even;         /* explicit: longest step of zp_sim_step, s; else infinite */
  /* of the step under way */
  ZpStepLimit bound; /* what set the largest step allowed */
  size_t met;        /* pair that meets inside it */
  ZpZipState opened; /* what is joined after it if nothing meets */
};

/* Find the hanging equilibrium (settle.c): sets opening0 and, if the run starts there, the positions. False if
 * there is no memory. */
bool zp_sim_settle(ZpSim *sim, const ZpHooks *hooks);

/* Go on from the state as it has just been given: at the waveform's voltage of its time. */
void zp_sim_resume(ZpSim *sim);

/* Sum of kinetic and stored energy without the field, of one part, J. */
double zp_energy_without_field(const ZpEnergies *energies);

/* Energies count from here on. */
void zp_sim_start_account(ZpSim *sim);

/* Fill sim->row (record.c). */
void zp_sim_fill_row(ZpSim *sim);

/* Offer the present row and shape to the records; at the end make them the last. */
void zp_sim_offer_record(ZpSim *sim);
void zp_sim_close_record(ZpSim *sim);

#endif
