/* Small motions of an actuator about an equilibrium, stable or not, as a linear system x' = A x + b u with the signal
 * y = c x. u is the change of the command to the supply, or of the voltage of the electrodes. The system includes the
 * ribbons, their internal damping, the film of liquid with its inertia, the meniscus of the bead, and the supply.
 * docs/theory.md, section 28. */
#ifndef ZP_REST_PLANT_H
#define ZP_REST_PLANT_H

#include "rest/setpoint.h"

typedef struct ZpPlant {
  size_t n;       /* states */
  size_t neutral; /* number of its eigenvalues, and of those of any loop, that are 0: liquid at the edges may stay there
                   */
  double *A;      /* [n * n], row by row */
  double *b, *c;  /* [n] */
  void *memory;
} ZpPlant;

/* The system about the present point of `rest`, an equilibrium of rods; false if there is no memory. Destroy it, also
 * if this fails. */
bool zp_plant_create(const ZpRest *rest, const ZpSetpointSignal *signal, ZpPlant *plant);
void zp_plant_destroy(ZpPlant *plant);

#endif
