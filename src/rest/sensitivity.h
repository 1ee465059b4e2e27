/* Derivatives of equilibria by a key, without differences of equilibria: from that of the forces at the same
 * coordinates (system/by_key.h), and the exact stiffness. Theory, section 20.
 *
 * For electro.model plates only, because the stiffness of a computed field is not known. */
#ifndef ZP_REST_SENSITIVITY_H
#define ZP_REST_SENSITIVITY_H

#include "rest/statics.h"
#include "solve/fold.h"
#include "system/by_key.h"

/* Inputs of a state that its definition sets: load.mass, drive.voltage, modes.voltage, the opening
 * isometric.separation at which the platform is held. Others stay as they are. */
enum { ZP_SETS_LOAD = 1, ZP_SETS_VOLTAGE = 2, ZP_SETS_MODES_VOLTAGE = 4, ZP_SETS_OPENING = 8 };

/* A number of a state, at its last residual. */
typedef double (*ZpOutput)(ZpStatics *statics, void *user);

typedef struct ZpRestSensitivity {
  ZpStatics *at;                        /* the state */
  int key;                              /* key of the derivatives */
  int inputs;                           /* those that move with the key */
  bool exact;                           /* the forces of all solutions so far had derivatives in closed form */
  ZpFiniteDifference by;                /* actuators with a slightly larger or smaller key */
  ZpStatics near[ZP_DIFFERENCE_POINTS]; /* states of these */
  double *motion;                       /* [2 stride] the part of dq/dp beyond the stretching of all coordinates */
  double *rate;                         /* [2 stride] dq/dp of the last solution, m/SI */
  double *tension;                      /* [stride] derivative of the tensions, N/SI; behind them that of a pouch's
                                         * pressure, Pa/SI */
  double *squeezed;                     /* [members] that of the pressure at stretched coordinates, Pa/SI */
  double reaction;                      /* derivative of the force that holds the platform, one part, N/SI */
  double *by_key, *by_parameter; /* [n] derivatives of forces at stretched coordinates; then over the stiffness */
  double *row;                   /* [n] work space */
  void *memory;
} ZpRestSensitivity;

/* Are there derivatives by key `key` about `def`? ZP_BAD_INPUT gives the reason if not: it is not a real number, a
 * setting of the solver, auto, or electro.model is field. */
ZpStatus zp_rest_sensitivity_check(const ZpActuatorDef *def, int key, ZpError *err);

/* Prepare derivatives by key `key` of states of `at`, whose model has a number for it. ZP_BAD_INPUT names the key if no
 * neighbouring models can be built; ZP_MACHINE: no memory. Close it in any case. */
ZpStatus zp_rest_sensitivity_open(ZpRestSensitivity *slope, ZpStatics *at, int key, ZpError *err);
void zp_rest_sensitivity_close(ZpRestSensitivity *slope);

/* Compute rate, tension and reaction at the present point, an equilibrium. False if the stiffness is singular. */
bool zp_rest_sensitivity_solve(ZpRestSensitivity *slope, int inputs);

/* The rate of the coordinates of a member [2 stride] and, where bodies move in the plane, that of their unknowns. */
const double *zp_rest_sensitivity_member(const ZpRestSensitivity *slope, size_t which);
const double *zp_rest_sensitivity_bodies(const ZpRestSensitivity *slope);

/* The derivative of an output along the last solution. */
double zp_rest_sensitivity_of(ZpRestSensitivity *slope, ZpOutput output, void *user);

/* Outputs, m or rad; `user` is not used. */
double zp_output_stroke(ZpStatics *statics, void *user);
double zp_output_opening(ZpStatics *statics, void *user);
double zp_output_angle(ZpStatics *statics, void *user);

/* Derivative of the parameter of `branch` at the present point, a limit point. NAN if there is none, because the branch
 * turns where a law has a corner. `null` [n] is the null vector. */
double zp_rest_sensitivity_of_fold(ZpRestSensitivity *slope, int inputs, const ZpBranchSystem *branch,
                                   const double *null);

/* Derivative by the key of the parameter at which an event is; `rate` and `by_parameter` are the derivatives of its
 * value by the key and by the parameter. */
double zp_rest_sensitivity_of_event(ZpRestSensitivity *slope, int inputs, const ZpBranchSystem *branch, ZpEvent event,
                                    double rate, double by_parameter);

#endif
