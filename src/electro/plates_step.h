/* The attraction by the plates law over a time step: forces that do exactly the work by which its potential changes
 * from one end of the step to the other, in the mean of the voltages at both ends. docs/theory.md, eq. (18.3). At rest
 * both ends are one point (`start == end`): the forces are then minus the potential's gradient, eq. (4.7). */
#ifndef ZP_ELECTRO_PLATES_STEP_H
#define ZP_ELECTRO_PLATES_STEP_H

#include "electro/plates.h"

/* Written by zp_plates_step. */
typedef struct ZpPlatesStep {
  double *Fx, *Fy; /* [stride] force on upper [2 i] and lower node [2 i + 1] of station i (flat: on [i]), N; 0 beyond */
  double *own, *next;      /* [N], [N-1] derivative by the end's gaps, half of that by the point at rest: of a station's
                              force,      with the next, N/m */
  double *along0, *along1; /* [N-1] by an element's x-length and the gap of its left and right station, N/m */
  double *A, *B, *P; /* [N-1] parts of the force from the element right (A) and left (B) of a station, N; mean potential
                        per length, J/m */
  double *own_A, *own_B; /* [N-1] and of the derivative */
} ZpPlatesStep;

void zp_plates_step_carve(const ZpPlatesParams *params, ZpPlatesStep *step, ZpCarver *carver);

/* (gaps and dx at both ends of the step, voltages there) => all of `step`. */
void zp_plates_step(const ZpPlatesParams *params, const ZpPlatesEval *start, const ZpPlatesEval *end, double U0,
                    double U1, ZpPlatesStep *step);

/* How the step goes with the voltage at its end. */
typedef struct ZpPlatesByVoltage {
  double *Fx, *Fy;    /* [stride] derivative of the mean force by that voltage, N/V */
  double *Qx, *Qy;    /* [stride] of the charge at the end by its coordinates, C/m */
  double capacitance; /* of that charge by that voltage, F */
} ZpPlatesByVoltage;

void zp_plates_by_voltage_carve(const ZpPlatesParams *params, ZpPlatesByVoltage *by, ZpCarver *carver);

/* (gaps and dx at both ends, U1) => all of `by`. `step` lends its parts A, B, P; its forces and derivatives stay. */
void zp_plates_by_voltage(const ZpPlatesParams *params, const ZpPlatesEval *start, const ZpPlatesEval *end, double U1,
                          ZpPlatesStep *step, ZpPlatesByVoltage *by);

/* At rest => how the forces go with the voltage: Fx, Fy [stride], N/V. `step` lends its parts as above. */
void zp_plates_rest_by_voltage(const ZpPlatesParams *params, const ZpPlatesEval *eval, double U, ZpPlatesStep *step,
                               double *Fx, double *Fy);

/* At rest: how the parts of the force of element i go with the part of it that is covered by liquid. */
typedef struct ZpPlatesByCover {
  double A, B; /* closing force on its left and its right station, N */
  double P;    /* mean potential per length, J/m */
} ZpPlatesByCover;
ZpPlatesByCover zp_plates_by_cover(const ZpPlatesParams *params, const ZpPlatesEval *eval, double voltage, size_t i);

/* At rest: (x, y of interleaved upper and lower nodes, voltage) => gaps and all of `step`. */
void zp_plates_rest(const ZpPlatesParams *params, const double *x, const double *y, double voltage, ZpPlatesEval *eval,
                    ZpPlatesStep *step);

#endif
