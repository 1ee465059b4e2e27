/* Small motions of an actuator about a state of rest, stable or not, as a linear system x' = A x + b u with the signal
 * y = c x: u is what the voltage that the supply is told, or that of the electrodes, is beyond that of rest. Ribbons,
 * their internal damping, the film of liquid with its inertia, the bead's end, and the supply. docs/theory.md,
 * section 28. */
#ifndef ZP_REST_PLANT_H
#define ZP_REST_PLANT_H

#include "rest/setpoint.h"

typedef struct ZpPlant {
  size_t n;       /* states */
  size_t neutral; /* of its eigenvalues, and of those of any loop, that are 0: liquid that lies at the edges may stay */
  double *A;      /* [n * n], row by row */
  double *b, *c;  /* [n] */
  void *memory;
} ZpPlant;

/* The present point of `rest`, an equilibrium of rods; false if there is no memory. To be destroyed, also if this
 * fails. */
bool zp_plant_create(const ZpRest *rest, const ZpSetpointSignal *signal, ZpPlant *plant);
void zp_plant_destroy(ZpPlant *plant);

#endif
