/* What follows from a state and is thrown away: forces by source, accelerations, energies, step bounds. */
#ifndef ZP_ACTUATOR_EVAL_H
#define ZP_ACTUATOR_EVAL_H

#include "actuator/model.h"

typedef struct ZpEval {
  ZpMassSpringEval spring;
  ZpPlatesEval plates;
  double *drag_x, *drag_y; /* [count] N */
  double *force;           /* [2 count] sum of all, x then y, N */
  double drag_power;       /* W */
  double drag_rate;        /* largest |v| / m, from which the drag bound follows */
  ZpBezierBasis basis;     /* for the free stations of basis.count; rebuilt when the front moves */
  void *memory;
} ZpEval;

/* Allocate the arrays of `eval`; false if there is no memory. */
bool zp_eval_create(const ZpModel *model, ZpEval *eval);
void zp_eval_destroy(ZpEval *eval);

/* What acts on the actuator besides its own elasticity. */
typedef enum ZpActing { ZP_ELASTIC_AND_WEIGHT, ZP_ALL_FORCES } ZpActing;

/* (state) => eval->force and what it is made of. Pure: nothing in the state changes. */
void zp_eval_forces(const ZpModel *model, const ZpState *state, const double *q, const double *v, ZpActing acting,
                    ZpEval *eval);

/* (eval->force) => accelerations [2 count], shared where pairs are joined. */
void zp_eval_accelerations(const ZpModel *model, const ZpMasses *masses, const ZpZipState *zip, const ZpEval *eval,
                           double *a);

/* Should a held electric force be found anew at this state? And do so, into the state. */
bool zp_eval_refresh_due(const ZpModel *model, const ZpState *state);
void zp_eval_refresh(const ZpModel *model, ZpState *state, ZpEval *eval);

/* The three bounds of eq. (9) of the paper at the last forces, s; INFINITY where nothing moves. */
typedef struct ZpStepBounds {
  double drag, axial, shear;
} ZpStepBounds;
ZpStepBounds zp_eval_step_bounds(const ZpModel *model, const double *v, const ZpEval *eval);

/* (accelerations under model->pseudo) => largest force left over the weight of what moves (over 1 mN if
 * that is more); NAN if any is. */
double zp_eval_imbalance(const ZpModel *model, const double *a);

/* Energies and electric totals of one modelled part. */
typedef struct ZpEnergies {
  double kinetic, axial, bending, gravity; /* J */
  double field;                            /* J, with what the breakdown cap takes */
  double force, charge, capacitance;       /* N, C, F */
} ZpEnergies;
ZpEnergies zp_eval_energies(const ZpModel *model, const ZpState *state, ZpEval *eval);

#endif
