/* zipact as a library: the actuator lifts 8 g, coarsely, and says when it has closed. */
#include <stdio.h>

#include <zipact/zipact.h>

int main(void) {
  ZpActuatorDef def = zp_actuator_def_default();
  def.load.mass = 0.008;    /* kg */
  def.drive.voltage = 10e3; /* V */
  def.mesh.nodes = 15;

  ZpModel *model = NULL;
  ZpSim *sim = NULL;
  ZpError err = {0};
  ZpRunInfo info = {0};
  if (zp_model_create(&def, &model, &err) == ZP_OK && zp_sim_create(model, NULL, &sim, &err) == ZP_OK) {
    zp_sim_run(sim, 0.5, true, NULL, &info);
    printf("%s: %s; contraction %.4f\n", zp_outcome_name(info.outcome), info.message, zp_sim_get(sim, "contraction"));
  } else {
    fprintf(stderr, "%s\n", err.message);
  }
  zp_sim_destroy(sim);
  zp_model_destroy(model);
  return info.outcome == ZP_ZIPPED ? 0 : 1;
}
