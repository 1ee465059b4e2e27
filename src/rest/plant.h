/* Small motions of an actuator, or of several as one system, about an equilibrium, stable or not, as a linear system
 * x' = A x + b u with the signal y = c x. u is the change of the command to the supply, or of the voltage of the
 * source. The system includes the ribbons, their internal damping, the film of liquid with its inertia, the meniscus of
 * the bead, and the supply. docs/theory.md, section 28. */
#ifndef ZP_REST_PLANT_H
#define ZP_REST_PLANT_H

#include "rest/setpoint.h"

typedef struct ZpPlant {
  size_t n;       /* states */
  size_t neutral; /* number of its eigenvalues, and of those of any loop, that are 0: liquid at the edges may stay there
                   */
  size_t inputs;  /* as many as signals: 1, or one of each controller */
  double *A;      /* [n * n], row by row */
  double *b, *c;  /* [inputs][n] */
  void *memory;
} ZpPlant;

/* The system about the present point of `rest`, an equilibrium of rods, which stays; false if there is no memory.
 * Destroy it, also if this fails. */
bool zp_plant_create(ZpRest *rest, const ZpSetpointSignal *signal, ZpPlant *plant);
void zp_plant_destroy(ZpPlant *plant);

/* These motions as equations of second order. The rates w, those of the shapes first, obey M w' + D w + K x = f, where
 * x is the integral of w and f [shapes] the forces on the shapes. */
typedef struct ZpSmallMotion {
  size_t shapes, rates;
  double *mass, *damping, *stiffness; /* [rates * rates], row by row */
  double *by_voltage;                 /* [shapes] forces by the voltage of the source, N/V */
  double *by_spread;                  /* [shapes] opening of the whole, or another spread (zp_spread), by x */
  double *charge; /* [rates] charge that the source gives to one part of each member by x, also through where beads end,
                     C/m */
  void *memory;
} ZpSmallMotion;

/* About the present point of `rest`, as above. */
bool zp_small_motion_create(ZpRest *rest, ZpSmallMotion *small);
void zp_small_motion_destroy(ZpSmallMotion *small);

/* `share` times x [rates] => how all nodes of a member move, in series also with the platforms above it. */
void zp_small_motion_nodes(const ZpSmallMotion *small, size_t which, const double *x, double share, double *nodes);

/* `weight` times forces on the nodes of a member => += on the shapes. */
void zp_small_motion_add(const ZpSmallMotion *small, size_t which, const double *nodes, double weight,
                         double *by_shape);

/* x or w [rates] => what flows past the edges of a bead of a member that ends, m^3 or m^3/s; 0 of any other. */
double zp_small_motion_out(const ZpSmallMotion *small, size_t which, int half, const double *x);

#endif
