/* Insulators and liquid that conduct, in series at each place (Maxwell and Wagner). Charge gathers on the faces between
 * them, slowly, and stays when the voltage goes. Per area over the capacitance of both insulators it is the interface
 * voltage Z: the liquid has the field, and attracts, as if the electrodes had U + Z. docs/theory.md, section 25.
 *
 * Faces may be of two kinds of patches, which lie beside each other at each place, at one gap, and conduct unequally:
 * eq. (25.10). Interface voltages are the state, [patches][ZP_PLATES_PLACES N] over the places of plates_step.h; what
 * they are where a step ends follows from gap and voltage there, patch by patch.
 */
#ifndef ZP_ELECTRO_LEAK_H
#define ZP_ELECTRO_LEAK_H

#include "electro/plates_step.h"

typedef struct ZpLeakPatch {
  double share;       /* of the faces, 0 .. 1 */
  double conductance; /* of both insulators per length of such faces, S/m */
  double discharge;   /* conductivity over permittivity of the liquid there, 1/s */
} ZpLeakPatch;

enum { ZP_LEAK_PATCHES = 2 };

typedef struct ZpLeakParams {
  double insulators; /* capacitance of both insulators per length, F/m */
  size_t patches;
  ZpLeakPatch patch[ZP_LEAK_PATCHES]; /* shares are 1 together */
} ZpLeakParams;

/* Charge that has passed through the insulators over a step, per length, and how it goes with gap and voltage at the
 * end. */
typedef struct ZpLeakPassed {
  double charge;     /* C/m */
  double by_gap;     /* C/m^2 */
  double by_voltage; /* F/m */
} ZpLeakPassed;

/* Liquid, or the air beyond a bead: the plates law there, the share of the place under it, and its discharge. */
typedef struct ZpLeakSide {
  const ZpPlatesParams *law;
  double share, discharge;
} ZpLeakSide;

/* Faces of a patch at a place over a step. Where a bead ends, both sides lie beside each other, at one gap and one
 * Z. */
typedef struct ZpLeakFace {
  size_t place;
  size_t at; /* of its Z */
  const ZpLeakPatch *patch;
  int sides;
  ZpLeakSide side[2];
  double wet;                /* share of the place that liquid covers */
  double part;               /* and that these faces are: of a patch, and of a pouch less where electrodes end */
  double g0, g1;             /* gaps at both ends, m */
  double length0, length1;   /* and lengths, m */
  double by_gap, by_voltage; /* how U + Z at the end goes with gap, V/m, and voltage there */
  ZpLeakPassed passed;
} ZpLeakFace;

typedef struct ZpLeakEval {
  double *Z;        /* interface voltages where the span ends, V */
  ZpLeakFace *face; /* [faces] of the last step, in the order of their patches and places */
  size_t faces;
  ZpPlatesMean *piece; /* work space */
  ZpPlatesStep work;
} ZpLeakEval;

/* How many interface voltages there are. */
size_t zp_leak_state(const ZpLeakParams *params, const ZpPlatesParams *plates);

/* Of these, those of a patch, [ZP_PLATES_PLACES N]. */
static inline const double *zp_leak_of_patch(const ZpPlatesParams *plates, const double *Z, size_t patch) {
  return Z + patch * ZP_PLATES_PLACES * plates->nodes;
}

/* Z is the caller's. */
void zp_leak_reserve(const ZpLeakParams *params, const ZpPlatesParams *plates, ZpLeakEval *eval, ZpArena *arena);

/* A step. At an instant both ends are one, and h is 0. */
typedef struct ZpLeakStep {
  const ZpPlatesEval *start, *end; /* gaps and dx */
  double U0, U1, h;                /* voltages, V, and length, s */
  const double *Z;                 /* interface voltages at its start, V */
} ZpLeakStep;

/* => all of eval, which the following functions ask at the last step. */
void zp_leak_step(const ZpLeakParams *params, const ZpPlatesParams *plates, const ZpLeakStep *step, ZpLeakEval *eval);

/* => mean forces and their derivatives by the end's gaps, with those of Z. */
void zp_leak_forces(const ZpLeakParams *params, const ZpPlatesParams *plates, const ZpLeakStep *step, ZpLeakEval *eval,
                    ZpPlatesStep *forces);

/* => how the step goes with the voltage at its end; the charge is that of the electrodes at the end and what has passed
 * through the insulators. */
void zp_leak_by_voltage(const ZpLeakParams *params, const ZpPlatesParams *plates, const ZpLeakStep *step,
                        ZpLeakEval *eval, ZpPlatesByVoltage *by);

/* Charge that has passed through the insulators, C. */
double zp_leak_passed(const ZpLeakEval *eval);

/* Where the work goes that neither field nor ribbons receive, eq. (25.8). */
typedef struct ZpLeakHeat {
  double conduction; /* heat of the conduction, J: between faces that overlap there is no liquid */
  double overlap;    /* energy of the field that faces which overlap exchange with the contact between them, J */
} ZpLeakHeat;

ZpLeakHeat zp_leak_heat(const ZpLeakParams *params, const ZpLeakStep *step, const ZpLeakEval *eval);

/* Totals at some gaps, a voltage and interface voltages Z. */
ZpPlatesTotals zp_leak_totals(const ZpLeakParams *params, const ZpPlatesParams *plates, const ZpPlatesEval *gaps,
                              double U, const double *Z);

/* Of the same. */
typedef struct ZpLeakNow {
  double mean;    /* of Z over the faces, V */
  double fastest; /* change of Z anywhere, V/s */
  double current; /* through the insulators, A */
  double liquid;  /* strongest field of the liquid, before any cap, V/m */
} ZpLeakNow;
ZpLeakNow zp_leak_now(const ZpLeakParams *params, const ZpPlatesParams *plates, const ZpPlatesEval *gaps, double U,
                      const double *Z);

#endif
