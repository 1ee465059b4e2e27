/* A source of one's own: a high-voltage supply V behind a resistance R, with a cable of capacitance K.
 *
 * The drive of a scenario is ideal: its voltage is that of the electrodes, whatever current flows. A real supply
 * charges the actuator through R, and the actuator's capacitance grows while it zips. As a source of the system its
 * voltage is an unknown of each time step, together with all positions: what flows in a step of h is what the
 * electrodes take,
 *
 *     h (V - (U0 + U1) / 2) / R - K (U1 - U0) = Q(q1, U1) - Q(q0, U0)
 *
 * (Without the cable the voltage would jump where the breakdown of the liquid holds the charge of closed faces.)
 *
 * Built against the rooms of src/, not against an installed zipact. Checked: before anything moves,
 * U = V (1 - exp(-t / (R (C + K)))); and the energy of the supply is that which the electrodes and the cable take and
 * the heat in R. */
#include <math.h>
#include <stdio.h>

#include "run/run.h"

typedef struct Supply {
  double V, R, K; /* V, ohm, F */
} Supply;

/* What flows in less what is taken, and its derivatives by U1 and by the charge that is taken. */
static ZpSourceLaw law(void *self, const ZpSourceStep *s) {
  const Supply *supply = self;
  double flows = s->h * (supply->V - 0.5 * (s->U0 + s->U1)) / supply->R - supply->K * (s->U1 - s->U0);
  return (ZpSourceLaw){.lacks = flows - s->taken,
                       .by_voltage = -0.5 * s->h / supply->R - supply->K,
                       .by_taken = -1,
                       .bound = NAN,
                       .resolved = 1};
}

/* What the supply has given, and the heat in R. */
typedef struct Book {
  double given, heat; /* J */
} Book;

/* Steps of dt up to `end`; every 20 ms a line. False if the numerics fail. */
static bool run(ZpSim *sim, const Supply *supply, double end, double dt, Book *book) {
  double before = zp_sim_get(sim, "charge") + supply->K * zp_sim_get(sim, "voltage");
  for (long i = lround(zp_sim_get(sim, "time") / dt); i < lround(end / dt); i++) {
    if (!zp_outcome_good(zp_sim_step(sim, dt, NULL, NULL))) return false;
    double charge = zp_sim_get(sim, "charge") + supply->K * zp_sim_get(sim, "voltage"),
           current = (charge - before) / dt;
    before = charge;
    book->given += supply->V * current * dt;
    book->heat += supply->R * current * current * dt;
    if ((i + 1) % lround(0.02 / dt) == 0)
      printf("%4.0f ms  %5.2f kV  %5.1f pF  opening %6.3f mm\n", 1e3 * (double)(i + 1) * dt,
             1e-3 * zp_sim_get(sim, "voltage"), 1e12 * zp_sim_get(sim, "capacitance"),
             1e3 * zp_sim_get(sim, "opening"));
  }
  return true;
}

/* The actuator behind the supply, from hanging: after 1 ms as the closed form says, and closed by 200 ms? */
static bool check(ZpSim *sim, const Supply *supply) {
  Book book = {0, 0};
  double C = zp_sim_get(sim, "capacitance") + supply->K, soon = 1e-3;
  double expected = supply->V * (1 - exp(-soon / (supply->R * C)));
  if (!run(sim, supply, soon, 2e-5, &book)) return false;
  double U = zp_sim_get(sim, "voltage");
  if (!run(sim, supply, 0.2, 2e-5, &book)) return false;
  double end = zp_sim_get(sim, "voltage"), taken = zp_sim_get(sim, "electric_work") + 0.5 * supply->K * end * end;
  double off = (book.given - book.heat - taken) / book.given;
  printf("after 1 ms %.2f V, expected %.2f V; zipped after %.1f ms; energy of the supply off by %.1e\n", U, expected,
         1e3 * zp_sim_zip_time(sim), off);
  return fabs(U - expected) < 1e-3 * expected && zp_sim_zip_time(sim) > 0 && fabs(off) < 2e-3;
}

int main(void) {
  ZpActuatorDef def = zp_actuator_def_default();
  def.mesh.nodes = 21;
  def.liquid.model = ZP_LIQUID_NONE;
  def.drive.voltage = 0; /* ours takes over */
  Supply supply = {10e3, 1e9, 10e-12};
  ZpSource source = {.self = &supply, .law = law, .scale = supply.V};
  ZpModel *model = NULL;
  ZpSim *sim = NULL;
  ZpError err = {0};
  bool good = zp_model_create(&def, &model, &err) == ZP_OK && zp_sim_create(model, NULL, &sim, &err) == ZP_OK &&
              zp_sim_connect(sim, &source) && check(sim, &supply);
  if (!good) fprintf(stderr, "failed %s\n", err.message);
  zp_sim_destroy(sim);
  zp_model_destroy(model);
  return good ? 0 : 1;
}
