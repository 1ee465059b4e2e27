/* zipact as a library: the actuator lifts 8 g, coarsely, and says when it has closed. */
#include <stdio.h>

#include <zipact/zipact.h>

int main(void) {
  ZpError err = {0};
  ZpActuatorDef *def = zp_def_create();
  ZpModel *model = NULL;
  ZpSim *sim = NULL;
  ZpOutcome outcome = ZP_NOT_SETTLED;
  if (zp_def_set_number(def, "load.mass", 0.008, &err) == ZP_OK &&    /* kg */
      zp_def_set_number(def, "drive.voltage", 10e3, &err) == ZP_OK && /* V */
      zp_def_set_number(def, "mesh.nodes", 15, &err) == ZP_OK && zp_model_create(def, &model, &err) == ZP_OK &&
      zp_sim_create(model, NULL, &sim, &err) == ZP_OK) {
    outcome = zp_sim_run(sim, 0.5, true, NULL, NULL);
    printf("%s at %.4f s; contraction %.4f\n", zp_outcome_name(outcome), zp_sim_get(sim, "time"),
           zp_sim_get(sim, "contraction"));
  } else {
    fprintf(stderr, "%s\n", err.message);
  }
  zp_sim_destroy(sim);
  zp_model_destroy(model);
  zp_def_destroy(def);
  return outcome == ZP_ZIPPED ? 0 : 1;
}
