/* Derivatives of states of rest by a key, without differences of states: the forces of actuators whose key is a little
 * larger or smaller, at the same coordinates, and the exact stiffness. Theory, section 20.
 *
 * Of electro.model plates: of a solved field the stiffness is not known. */
#ifndef ZP_REST_SLOPE_H
#define ZP_REST_SLOPE_H

#include "rest/near.h"
#include "rest/statics.h"
#include "solve/fold.h"

/* What a definition says of a state besides the model: its voltage, its load, the opening at which the platform is
 * held. What it does not set is that of the state. */
typedef void (*ZpPose)(const ZpActuatorDef *def, ZpStatics *statics);

/* The load is load.mass. */
void zp_pose_load(const ZpActuatorDef *def, ZpStatics *statics);

/* A number that a state has, at its last residual. */
typedef double (*ZpOutput)(ZpStatics *statics, void *user);

typedef struct ZpSlope {
  ZpStatics *at;                  /* the state */
  ZpNewtonWork *work;             /* the caller's */
  int key;                        /* by which is differentiated */
  ZpNear by;                      /* actuators with that key a little larger or smaller, */
  ZpStatics near[ZP_NEAR_POINTS]; /* and states of them */
  double *motion;                 /* [2 stride] that beyond the stretching */
  double *rate;                   /* [2 stride] dq/dp of the last solution, m/SI */
  double *tension;                /* [stride] and of the tensions, N/SI */
  double reaction;                /* and of the force that holds the platform, one part, N/SI */
  double *by_key, *by_parameter;  /* [n] of forces at coordinates that are stretched only; then over the stiffness */
  double *row;                    /* [n] work space */
  void *memory;
} ZpSlope;

/* Are there derivatives by key `key` about `def`? ZP_BAD_INPUT says why not: it is no real number, a setting of the
 * solver, auto, or electro.model is field. */
ZpStatus zp_slope_check(const ZpActuatorDef *def, int key, ZpError *err);

/* Prepare derivatives by key `key` of states of `at`, whose model has a number there. ZP_BAD_INPUT names the key if no
 * actuators near can be built; ZP_MACHINE: no memory. To be closed in any case. */
ZpStatus zp_slope_open(ZpSlope *slope, ZpStatics *at, ZpNewtonWork *work, int key, ZpError *err);
void zp_slope_close(ZpSlope *slope);

/* At the present point, an equilibrium => rate, tension, reaction. False if the stiffness is singular. */
bool zp_slope_solve(ZpSlope *slope, ZpPose pose);

/* The derivative of an output along the last solution. */
double zp_slope_of(ZpSlope *slope, ZpPose pose, ZpOutput output, void *user);

/* Outputs, m; `user` is not looked at. */
double zp_output_stroke(ZpStatics *statics, void *user);
double zp_output_opening(ZpStatics *statics, void *user);
double zp_output_angle(ZpStatics *statics, void *user);

/* At the present point, a limit point of `branch`: the derivative of its parameter there. NAN if there is none: the
 * branch turns where a law has a corner. `null` [n] is the null vector. */
double zp_slope_of_fold(ZpSlope *slope, ZpPose pose, const ZpBranchSystem *branch, const double *null);

/* The same where `event` has a value that changes with the key at `rate`. */
double zp_slope_of_event(ZpSlope *slope, ZpPose pose, const ZpBranchSystem *branch, ZpEvent event, double rate);

#endif
