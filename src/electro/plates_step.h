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

/* At rest: (x, y of interleaved upper and lower nodes, voltage) => gaps and all of `step`. */
void zp_plates_rest(const ZpPlatesParams *params, const double *x, const double *y, double voltage, ZpPlatesEval *eval,
                    ZpPlatesStep *step);

#endif
