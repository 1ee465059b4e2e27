/* What the solved field has beyond the plates law: forces and energy at 1 V, on the nodes of two ribbons. The plates
 * law follows the ribbons at every step and has the breakdown cap; added to it, U^2 times this makes the
 * field's own force where no breakdown caps it, eq. (14.8). It is small and varies slowly, so it may be held. */
#ifndef ZP_ELECTRO_SURPLUS_H
#define ZP_ELECTRO_SURPLUS_H

#include "electro/field.h"
#include "electro/plates.h"

typedef struct ZpSurplus {
  ZpField field;
  ZpPlatesParams plates; /* without cap */
  ZpPlatesEval eval;
  double scale;    /* on the field's force and energy, as in the plates law */
  double *x, *y;   /* [stride] where it was solved; NAN: nowhere yet */
  double *Fx, *Fy; /* [stride] field less plates on upper [2 i] and lower node [2 i + 1], N/V^2 */
  double energy;   /* the same of the energies, J/V^2: F is its gradient */
  int solutions;   /* how often the field was solved */
  void *memory;
} ZpSurplus;

/* False if there is no memory. */
bool zp_surplus_create(const ZpFieldParams *field, const ZpPlatesParams *plates, double scale, ZpSurplus *surplus);
void zp_surplus_destroy(ZpSurplus *surplus);

/* (x, y of interleaved upper and lower nodes) => Fx, Fy, energy; all NAN if the field cannot be solved there.
 * Costs nothing where it was solved last. */
ZpFieldEnd zp_surplus_solve(ZpSurplus *surplus, const double *x, const double *y);

#endif
