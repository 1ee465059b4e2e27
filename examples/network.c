/* A network by the library: two actuators turn a forearm on a pin. Each has a channel of its own, whose voltage the
 * program sets every millisecond, so that the angle of the forearm follows a target; then a hand pulls at the forearm.
 */
#include <math.h>
#include <stdio.h>

#include <zipact/zipact.h>

/* Member `k`, `side` m beside the pin, from the frame (body 0) to the forearm (body 1), with a channel of its own. */
static ZpStatus add_member(ZpActuatorDef *def, int k, double side, ZpError *err) {
  const struct {
    const char *key;
    double value;
  } keys[] = {{"upper", 0}, {"lower", 1}, {"upper_at.x", side}, {"lower_at.x", side}, {"drive.voltage", 8e3}};
  ZpStatus status = ZP_OK;
  for (size_t i = 0; i < sizeof keys / sizeof keys[0] && status == ZP_OK; i++) {
    char name[ZP_KEY_NAME_SIZE];
    snprintf(name, sizeof name, "member_%d.%s", k, keys[i].key);
    status = zp_def_set_number(def, name, keys[i].value, err);
  }
  return status;
}

static ZpStatus add_forearm(ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = zp_def_set_word(def, "body_1.moves", "plane", err);
  const struct {
    const char *key;
    double value;
  } keys[] = {{"body_1.mass", 12e-3}, {"body_1.inertia", 2e-6},   {"body_1.at.y", -8e-3}, /* kg, kg m2, m */
              {"joint_1.first", 0},   {"joint_1.second", 1},      {"joint_1.at.y", 6e-3}, /* a pin */
              {"damping.drag", 0.02}, {"damping.internal", 0.02}, {"mesh.nodes", 15}};
  for (size_t i = 0; i < sizeof keys / sizeof keys[0] && status == ZP_OK; i++)
    status = zp_def_set_number(def, keys[i].key, keys[i].value, err);
  return status;
}

/* Until `end` (s): more voltage to the left actuator turns the forearm clockwise. */
static ZpStatus follow(ZpSim *sim, double target, double end, ZpError *err) {
  const double period = 1e-3, integral = 1000e3; /* s, V/rad/s */
  static double voltage = 0;                     /* V: of the right one, below 0 of the left one */
  ZpStatus status = ZP_OK;
  while (status == ZP_OK && zp_sim_get(sim, "time") < end - period / 2) {
    voltage += integral * period * (target - zp_sim_get(sim, "body_1.angle"));
    status = zp_sim_set_input_named(sim, "member_1.voltage", fmin(fmax(-voltage, 0), 8e3), 0, err);
    if (status == ZP_OK) status = zp_sim_set_input_named(sim, "member_2.voltage", fmin(fmax(voltage, 0), 8e3), 0, err);
    if (status == ZP_OK && zp_sim_step(sim, period, NULL, NULL) != ZP_REACHED_END) return ZP_MACHINE;
  }
  printf("%.1f s: angle %.4f rad, openings %.3f and %.3f mm, %.0f and %.0f V\n", zp_sim_get(sim, "time"),
         zp_sim_get(sim, "body_1.angle"), 1e3 * zp_sim_get(sim, "member_1.opening"),
         1e3 * zp_sim_get(sim, "member_2.opening"), zp_sim_get(sim, "member_1.voltage"),
         zp_sim_get(sim, "member_2.voltage"));
  return status;
}

int main(void) {
  ZpError err = {0};
  ZpActuatorDef *def = zp_def_create();
  ZpModel *model = NULL;
  ZpSim *sim = NULL;
  const bool done = add_forearm(def, &err) == ZP_OK && add_member(def, 1, -60e-3, &err) == ZP_OK &&
                    add_member(def, 2, 60e-3, &err) == ZP_OK && zp_model_create(def, &model, &err) == ZP_OK &&
                    zp_sim_create(model, NULL, &sim, &err) == ZP_OK && follow(sim, 0.02, 1, &err) == ZP_OK &&
                    zp_sim_set_input_named(sim, "body_1.torque", 0.5e-3, 0, &err) == ZP_OK &&
                    follow(sim, 0.02, 2, &err) == ZP_OK;
  const bool held = done && fabs(zp_sim_get(sim, "body_1.angle") - 0.02) < 1e-3;
  if (!done) fprintf(stderr, "%s\n", err.message);
  zp_sim_destroy(sim);
  zp_model_destroy(model);
  zp_def_destroy(def);
  return held ? 0 : 1;
}
