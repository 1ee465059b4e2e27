/* The members of an actuator behind a supply: how the voltage of its electrodes follows, and the books of what the
 * supply gives. */
#ifndef ZP_RUN_SUPPLY_COUPLING_H
#define ZP_RUN_SUPPLY_COUPLING_H

#include "run/info.h"

#include "term/source.h"

/* Which limit of the supply acts. */
typedef enum ZpSupplyMode {
  ZP_SUPPLY_FREE,
  ZP_SUPPLY_GIVES_MOST,
  ZP_SUPPLY_SINKS_MOST,
  ZP_SUPPLY_SPILLS /* capped faces have to give more charge than the limit takes: the breakdown takes the rest */
} ZpSupplyMode;

/* Currents of a step that may be the largest one. */
typedef enum ZpSupplyCurrent {
  ZP_CURRENT_MEAN,
  ZP_CURRENT_AT_START,
  ZP_CURRENT_AT_END,
  ZP_SUPPLY_CURRENTS
} ZpSupplyCurrent;

/* Shortest step, s. In a shorter one, before a corner, only time advances. */
#define ZP_SUPPLY_SHORTEST 1e-10

typedef struct ZpSupplyCoupling {
  ZpSource source;     /* what the dynamics ask */
  double scale;        /* V */
  ZpSupplyMode mode;   /* of the step at the last residual, */
  double bleeds;       /* and the weight of the voltage at its end in that at the bleeder */
  double square, peak; /* of the current in the run so far: integral of its square, A^2 s; its largest size, A */
  double current[ZP_SUPPLY_CURRENTS]; /* of the last step, A */
  int largest; /* which of them is larger than any in the steps before; ZP_SUPPLY_CURRENTS: none */
} ZpSupplyCoupling;

/* Is a member behind a supply that acts? Else zp_supply_coupling_create to zp_supply_coupling_cable_energy,
 * zp_sim_command excepted, are not to be called. */
bool zp_sim_is_fed(const ZpSim *sim);

void zp_supply_coupling_create(ZpSim *sim);

/* Command to the supply now, V. */
double zp_sim_command(const ZpSim *sim);

/* At the start a constant source of its own charges the electrodes of a member, those of the supply have no voltage. */
void zp_supply_coupling_start(ZpSim *sim);

/* Before a step, at all ports: jumps of the command arrive. */
void zp_supply_coupling_arrive(ZpSim *sim);

/* A field of a member that was computed again, or a surface, holds another charge at the same voltage than `before` (of
 * one part, C): the supply gives the difference. */
void zp_supply_coupling_renew(ZpSim *member, double before);

/* The next event of the supply before `latest`, s; INFINITY: there is none. */
double zp_supply_coupling_event(const ZpSim *sim, double latest);

/* The first one at any port: the member whose supply has it, and its time, s. */
typedef struct ZpSupplyEvent {
  size_t lead;
  double t;
} ZpSupplyEvent;
ZpSupplyEvent zp_supply_coupling_next(const ZpSim *sim, double latest);

/* Longest step, s, for a supply whose voltages matter from `least` (V) on. */
double zp_supply_coupling_resolution(const ZpSim *sim, double least);

/* One step of all members that ends at `latest` or before. False if none was found. Its start is in sim->before. */
bool zp_supply_coupling_step(ZpSim *sim, double latest);

/* After a step of the dynamics that is found otherwise, without a limit in it, at all ports. */
void zp_supply_coupling_end(ZpSim *sim);

/* A mean current has flowed for a time h behind an ideal source. */
void zp_supply_coupling_note_current(ZpSim *sim, double current, double h);

/* The current out of the source over a run so far, of that duration, A. NAN: the voltage of the electrodes has jumped,
 * which takes an infinite one. Of an ideal source they are those of the rows. */
typedef struct ZpCurrents {
  double peak, rms;
} ZpCurrents;
ZpCurrents zp_sim_currents(ZpSim *sim, double duration);

/* Energy of the cable's capacitance at voltage U, J. */
double zp_supply_coupling_cable_energy(const ZpSim *sim, double U);

#endif
