/* The attraction by the plates law over a time step: forces that do exactly the work by which its potential changes
 * from one end of the step to the other, in the mean of the voltages at both ends. docs/theory.md, eq. (18.3). At rest
 * both ends are one point (`start == end`): the forces are then minus the potential's gradient, eq. (4.7). */
#ifndef ZP_ELECTRO_PLATES_STEP_H
#define ZP_ELECTRO_PLATES_STEP_H

#include "electro/plates.h"

/* Written by zp_plates_step. */
typedef struct ZpPlatesStep {
  double *Fx, *Fy; /* [lanes] force on upper [2 i] and lower node [2 i + 1] of station i (flat: on [i]), N; 0 beyond */
  double *own, *next;      /* [N], [N-1] derivative by the end's gaps, half of that by the point at rest: of a station's
                              force,      with the next, N/m */
  double *along0, *along1; /* [N-1] by an element's x-length and the gap of its left and right station, N/m */
  double *A, *B, *P; /* [N-1] parts of the force from the element right (A) and left (B) of a station, N; mean potential
                        per length, J/m */
  double *own_A, *own_B; /* [N-1] and of the derivative */
} ZpPlatesStep;

void zp_plates_step_reserve(const ZpPlatesParams *params, ZpPlatesStep *step, ZpArena *arena);

/* (gaps and dx at both ends of the step, voltages there) => all of `step`. */
void zp_plates_step(const ZpPlatesParams *params, const ZpPlatesEval *start, const ZpPlatesEval *end, double U0,
                    double U1, ZpPlatesStep *step);

/* How the step goes with the voltage at its end. */
typedef struct ZpPlatesByVoltage {
  double *Fx, *Fy;    /* [lanes] derivative of the mean force by that voltage, N/V */
  double *Qx, *Qy;    /* [lanes] of the charge at the end by its coordinates, C/m */
  double capacitance; /* of that charge by that voltage, F */
} ZpPlatesByVoltage;

void zp_plates_by_voltage_reserve(const ZpPlatesParams *params, ZpPlatesByVoltage *by, ZpArena *arena);

/* (gaps and dx at both ends, U1) => all of `by`. `step` lends its parts A, B, P; its forces and derivatives stay. */
void zp_plates_by_voltage(const ZpPlatesParams *params, const ZpPlatesEval *start, const ZpPlatesEval *end, double U1,
                          ZpPlatesStep *step, ZpPlatesByVoltage *by);

/* At rest => how the forces go with the voltage: Fx, Fy [lanes], N/V. `step` lends its parts as above. */
void zp_plates_rest_by_voltage(const ZpPlatesParams *params, const ZpPlatesEval *eval, double U, ZpPlatesStep *step,
                               double *Fx, double *Fy);

/* At rest, without air => how the forces go with d: Fx, Fy [lanes], N/m. `step` lends its parts as above. */
void zp_plates_rest_by_offset(const ZpPlatesParams *params, const ZpPlatesEval *eval, double U, ZpPlatesStep *step,
                              double *Fx, double *Fy);

/* The law between two gaps and two voltages at one place, where voltages differ from place to place. */
typedef struct ZpPlatesMean {
  double W;     /* mean force on the gap per length, N/m; of a charge: minus its derivative by the gap */
  double slope; /* derivative of W by the gap at the end, N/m^2 */
  double P;     /* mean potential per length, J/m; of a charge: minus the charge, C/m */
  double W1;    /* force at the gap of the end, N/m */
} ZpPlatesMean;

/* Places of a station: the sampled points of the element on its right, then the platform's electrode. */
enum { ZP_PLATES_PLACES = 4 };

/* (voltages and gaps at both ends) => the mean law of (18.3); and how it goes with the voltage U1 alone, without its
 * derivatives by the gap. */
ZpPlatesMean zp_plates_between(const ZpPlatesParams *params, double U0, double U1, double g0, double g1);
ZpPlatesMean zp_plates_between_by_voltage(const ZpPlatesParams *params, double U1, double g0, double g1);

/* dq/dU at a gap, F/m: 0 where the cap holds the charge. */
double zp_plates_capacitance(const ZpPlatesParams *params, double voltage, double gap);

/* A place: where on the faces it is, and how much of them it stands for. */
typedef struct ZpPlatesPlace {
  size_t left;   /* station, */
  double right;  /* and the share of the next one in what is sampled */
  double weight; /* of the element's x-length; 0: it has a length of its own, */
  double length; /* m */
  double wet;    /* share of the place that liquid covers, 0 .. 1 */
} ZpPlatesPlace;

/* Are there faces at place `at` of [ZP_PLATES_PLACES N]? */
static inline bool zp_plates_has_faces(const ZpPlatesParams *params, size_t at) {
  size_t station = at / ZP_PLATES_PLACES;
  if (at % ZP_PLATES_PLACES + 1 < ZP_PLATES_PLACES) return station + 1 < params->nodes;
  return params->flat_length > 0 && station >= params->platform && station <= params->platform_end;
}

/* The place there, with the liquid where `cover` has it; NULL: everywhere. */
ZpPlatesPlace zp_plates_place(const ZpPlatesParams *params, const ZpCover *cover, size_t at);

/* The place at this part of the element right of a station, 0 .. 1, and that of a platform's electrode at a station. */
size_t zp_plates_place_at(size_t left, double part);
size_t zp_plates_flat_place(size_t station);

/* There: the gap, m, and the length of faces, m. */
static inline double zp_plates_place_gap(const ZpPlatesPlace *place, const ZpPlatesEval *e) {
  if (place->weight == 0) return e->gap[place->left];
  return (1 - place->right) * e->gap[place->left] + place->right * e->gap[place->left + 1];
}

static inline double zp_plates_place_length(const ZpPlatesPlace *place, const ZpPlatesEval *e) {
  return place->weight == 0 ? place->length : place->weight * e->dx[place->left];
}

/* (pieces [ZP_PLATES_PLACES N], gaps and dx at both ends) => all of `step`. */
void zp_plates_step_of(const ZpPlatesParams *params, const ZpPlatesMean *piece, const ZpPlatesEval *start,
                       const ZpPlatesEval *end, ZpPlatesStep *step);
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
