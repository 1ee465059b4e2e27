/* What follows from a state and is thrown away: forces by source, accelerations, energies, step bounds. */
#ifndef ZP_ACTUATOR_EVAL_H
#define ZP_ACTUATOR_EVAL_H

#include "actuator/model.h"
#include "base/end.h"
#include "electro/surplus.h"

/* What both mechanics say of their edges; [-s .. edges + s) where the mechanics has it so. */
typedef struct ZpEdges {
  const double *dpx, *dpy, *ux, *uy, *T, *Rx, *Ry;
} ZpEdges;

typedef struct ZpEval {
  ZpMassSpringEval spring; /* one of the two is in use */
  ZpRodEval rod;
  ZpRodStep rod_forces; /* at rest in rod */
  ZpEdges edges;        /* of the one in use */
  ZpPlatesEval plates;
  ZpPlatesStep attraction; /* at rest there */
  ZpFacesEval faces;       /* of unilateral contact */
  ZpSurplus surplus;       /* where the field is solved */
  double drag_power;       /* lost now, W */
  double drag_rate;        /* largest |v| / m, 1 / (kg s/m), from which the drag bound follows */
  ZpBezierSurface surface; /* for the free stations; remade when the front moves */
  const double *none;      /* [stride] zeros: the attraction that there is without voltage */
  void *memory;
} ZpEval;

/* Allocate the arrays of `eval`; false if there is no memory. */
bool zp_eval_create(const ZpModel *model, ZpEval *eval);
void zp_eval_destroy(ZpEval *eval);

/* (q, v, and the voltage, held forces and front of the state) => free accelerations a [2 stride]: those of
 * nodes that no other is joined to. Nothing in the state changes. */
void zp_eval_accelerations(const ZpModel *model, const ZpState *state, const double *q, const double *v, ZpEval *eval,
                           double *a);

/* The same of ribbons and load alone, no voltage, no drag, with pseudo-masses: for settling. */
void zp_eval_unpowered(const ZpModel *model, const double *q, ZpEval *eval, double *a);

/* Joined pairs move as one. */
void zp_eval_share(const ZpModel *model, const ZpMasses *masses, const ZpZipState *zip, double *a);

/* (positions, voltage) => forces at rest [2 stride], N: mechanics, weight, attraction on the polyline, and what
 * the solved field has beyond it where it was solved last. */
void zp_eval_static_forces(const ZpModel *model, const double *q, double voltage, ZpEval *eval, double *force);

/* Solve the field at these positions and voltage, where the model does; false if it cannot be. */
bool zp_eval_solve_field(const ZpModel *model, const double *q, double voltage, ZpEval *eval);

/* Stiffness of the mechanics at the last positions: minus the derivative of the forces of edges by edges, in the form
 * of zp_rod_stiffness. */
void zp_eval_stiffness(const ZpModel *model, const ZpEval *eval, const double *tension, double (*D)[4]);

/* Should a held electric force be recomputed at this state? What a solved field has beyond plates is due when a gap
 * with its insulators, or the one where breakdown sets in, has changed by more than electro.refresh_change. */
bool zp_eval_refresh_due(const ZpModel *model, const ZpState *state);

/* Is it due for the sake of a voltage that has just become another? */
bool zp_eval_voltage_outdates(const ZpModel *model, const ZpState *state);

/* Recompute it, into the state. ZP_END_STOP where the field cannot be solved: the state is then as it was, the refresh
 * still due. */
ZpEnd zp_eval_refresh(const ZpModel *model, ZpState *state, ZpEval *eval);

/* The three bounds of eq. (9) of the paper at the last accelerations, s; INFINITY where nothing moves. */
typedef struct ZpStepBounds {
  double drag, axial, shear;
} ZpStepBounds;
ZpStepBounds zp_eval_step_bounds(const ZpModel *model, const ZpState *state, const ZpEval *eval);

/* What an imbalance is measured by: the weight of what moves, at least 1 mN, for what weighs nothing has a scale, too;
 * N. */
double zp_eval_weight_scale(const ZpModel *model);

/* (accelerations under model->pseudo) => largest force left over zp_eval_weight_scale; NAN if any is. */
double zp_eval_imbalance(const ZpModel *model, const double *a);

/* Energies of one modelled part without the field. */
typedef struct ZpEnergies {
  double kinetic, axial, bending, gravity; /* J */
} ZpEnergies;
ZpEnergies zp_eval_energies(const ZpModel *model, const ZpState *state, ZpEval *eval);

/* Electric totals of one modelled part at some voltage U; all 0 without electrodes. */
typedef struct ZpElectric {
  double force;       /* N */
  double charge;      /* C */
  double potential;   /* at constant voltage, J: its gradient is the force; charge = -d/dU */
  double capacitance; /* F */
} ZpElectric;

/* Energy of the field, with what the breakdown cap takes, J. */
static inline double zp_field_energy(ZpElectric electric, double U) {
  return electric.charge * U + electric.potential;
}

/* (held field of the state, coordinates, their gaps, U) => totals. */
ZpElectric zp_eval_electric(const ZpModel *model, const ZpState *state, const double *q, const ZpPlatesEval *gaps,
                            double U);

/* The same where the state is. */
ZpElectric zp_eval_electric_now(const ZpModel *model, const ZpState *state, double U, ZpEval *eval);

#endif
