/* Controllers on several ports, around members that bodies join or that have ports: the equilibrium where each signal
 * has its setpoint, stable or not, and small motions about it, without liquid. docs/theory.md, section 28. */
#ifndef ZP_REST_LOOPS_H
#define ZP_REST_LOOPS_H

#include "rest/plant.h"

/* A controller of a port. */
typedef struct ZpLoop {
  size_t lead; /* the first member on it, whose signal is measured; a capacitance is that of all on the port */
  double setpoint;
  double hanging; /* opening of that member without voltage, m */
  bool acts;      /* else it stays at 0 V, as all voltage would lead it away from its setpoint, */
  bool misses;    /* and it is not there */
} ZpLoop;

/* From any point to the equilibrium at all setpoints, along those between the hanging state and them => hanging, acts,
 * misses, and the voltages of all ports, by their first members [members], V. Ports without a controller have the
 * voltage that belongs to drive.voltage of all. `voltage` must outlive the point. *found: is there one that this way
 * leads to? False if there is no memory. */
bool zp_loops_find(ZpRest *rest, ZpLoop *loop, size_t loops, double *voltage, bool *found);

/* As zp_plant_create, with an input and a signal of each loop that acts, in their order. */
bool zp_loops_plant(ZpRest *rest, const ZpLoop *loop, size_t loops, ZpPlant *plant);

/* The signal of a controller at the present point. */
double zp_loop_signal(ZpRest *rest, const ZpLoop *loop);

#endif
