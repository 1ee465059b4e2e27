/* A drive model of one's own on the public API: a high-voltage supply U0 behind a resistance R.
 *
 * The library's source is ideal: drive.voltage stands whatever current flows. A real one charges the actuator through
 * R, and the actuator's capacitance C grows while it zips. Per step dt, with the charge Q that has flowed so far,
 *
 *     R dQ/dt = U0 - Q / C    =>    Q <- (Q + dt U0 / R) / (1 + dt / (R C)),    U = Q / C
 *
 * (implicit, so that a short R C is no trouble). Checked: before anything moves, U = U0 (1 - exp(-t / (R C))).
 * Theory, section 17, has the ideal source. */
#include <math.h>
#include <stdio.h>

#include <zipact/zipact.h>

static const double U0 = 10e3; /* of the supply, V */
static const double R = 1e9;   /* between supply and actuator, ohm */
static const double dt = 5e-5; /* between two looks at the actuator, s */

typedef struct Supply {
  double Q; /* charge on the actuator, C */
} Supply;

/* The voltage on the actuator at the end of the next dt, V. */
static double supply_step(Supply *supply, double C) {
  supply->Q = (supply->Q + dt * U0 / R) / (1 + dt / (R * C));
  return supply->Q / C;
}

/* One run up to `end`: prints what happens every 20 ms; the voltage at the end, NAN if the library refused. */
static double run(ZpSim *sim, Supply *supply, double end, double *zip_time, ZpError *err) {
  double U = 0;
  long steps = lround(end / dt);
  for (long i = 0; i < steps; i++) {
    U = supply_step(supply, zp_sim_get(sim, "capacitance"));
    if (zp_sim_set_voltage(sim, U, err) != ZP_OK || !zp_outcome_good(zp_sim_step(sim, dt, NULL, NULL))) return NAN;
    if ((i + 1) % 400 == 0)
      printf("%4.0f ms  %5.2f kV  %5.1f pF  opening %6.3f mm\n", 1e3 * (double)(i + 1) * dt, 1e-3 * U,
             1e12 * zp_sim_get(sim, "capacitance"), 1e3 * zp_sim_get(sim, "opening"));
  }
  *zip_time = zp_sim_zip_time(sim);
  return U;
}

int main(void) {
  ZpActuatorDef def = zp_actuator_def_default();
  def.mesh.nodes = 21;
  def.drive.voltage = 0; /* ours takes over */
  ZpModel *model = NULL;
  ZpSim *sim = NULL;
  ZpError err = {0};
  Supply supply = {0};
  double begin = 1e-3, zip_time = NAN, U = NAN, expected = NAN;
  if (zp_model_create(&def, &model, &err) == ZP_OK && zp_sim_create(model, NULL, &sim, &err) == ZP_OK) {
    expected = U0 * (1 - exp(-begin / (R * zp_sim_get(sim, "capacitance"))));
    U = run(sim, &supply, begin, &zip_time, &err);
    if (!isnan(U)) run(sim, &supply, 0.2, &zip_time, &err);
  }
  printf("after 1 ms %.2f V, expected %.2f V; zipped after %.1f ms %s\n", U, expected, 1e3 * zip_time, err.message);
  zp_sim_destroy(sim);
  zp_model_destroy(model);
  return fabs(U - expected) < 0.01 * expected && zip_time > 0 ? 0 : 1;
}
