/* Correction of the plates law by the solved field, on the nodes of two ribbons. The plates law follows the ribbons at
 * every step; this is small and varies slowly, so it may be held for a while. Where the breakdown cap holds the force,
 * nothing is added: both are taken with no gap below that at which it sets in, eq. (14.7). Per U^2: without cap it does
 * not depend on U. With a bead, liquid fills the gap by whole elements in both laws, and air lies around; where air
 * breaks down beyond it, nothing is added either, eq. (14.8). */
#ifndef ZP_ELECTRO_FIELD_CORRECTION_H
#define ZP_ELECTRO_FIELD_CORRECTION_H

#include "electro/field.h"
#include "electro/plates_step.h"

typedef struct ZpFieldCorrection {
  ZpField field;
  ZpPlatesParams plates; /* without cap, */
  ZpPlatesParams air;    /* and its law beyond a bead */
  ZpCover cover;         /* of a bead at the last solution, by whole elements */
  ZpPlatesEval eval;
  ZpPlatesStep attraction;
  double scale;          /* on the field's force and energy, as in the plates law */
  double h_per_volt;     /* of the cap, as in ZpPlatesParams, */
  double air_h_per_volt; /* and beyond a bead */
  double U;              /* V, and */
  double *q;          /* [2 lanes] where it was solved: x, then y, of interleaved upper and lower nodes; NAN: nowhere */
  double *floored;    /* [2 lanes] that with no gap below where the cap sets in */
  double *F;          /* [2 lanes] field less plates, force on each node in that order, N/V^2; 0 at first */
  double energy;      /* the same of the co-energies, J/V^2: F is its gradient */
  double charge;      /* the same of the charges, C/V */
  double capacitance; /* of the field less that of plates, without any scale, F */
  ZpFieldEnd end;     /* how the last solution ended */
  int solutions;      /* how often the field was solved */
  void *memory;
} ZpFieldCorrection;

/* False if there is no memory. */
bool zp_field_correction_create(const ZpFieldParams *field, const ZpPlatesParams *plates, double scale,
                                ZpFieldCorrection *correction);
void zp_field_correction_destroy(ZpFieldCorrection *correction);

/* (coordinates as q, voltage, where liquid is; NULL: everywhere) => F, energy, charge. Where the field cannot be solved
 * they stay. Costs nothing where it was solved last. Without voltage: as at 1 V, where nothing is capped. */
ZpFieldEnd zp_field_correction_solve(ZpFieldCorrection *correction, const double *q, double voltage,
                                     const ZpCover *cover);

#endif
