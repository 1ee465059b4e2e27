#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "def/check.h"
#include "drive/control_loop.h"
#include "rest/plant.h"
#include "study/studies.h"

enum { TOLD = 4 };

static const char *const growth_name[TOLD] = {"loop_growth_1_per_s", "loop_growth_2_per_s", "loop_growth_3_per_s",
                                              "loop_growth_4_per_s"},
                         *const frequency_name[TOLD] = {"loop_frequency_1_Hz", "loop_frequency_2_Hz",
                                                        "loop_frequency_3_Hz", "loop_frequency_4_Hz"},
                         *const factor_name[TOLD] = {"loop_factor_1", "loop_factor_2", "loop_factor_3",
                                                     "loop_factor_4"};

/* Held: 0, or NAN where that is not known. */
static void add_none(ZpResult *result, double held) {
  zp_result_add(result, "held", "count", held);
  zp_result_add(result, "held_voltage_V", "V", NAN);
}

/* The eigenvalue of a loop that decays least, in words. */
static const char *in_words(const ZpGrowth *worst, char *text, size_t size) {
  const char *does = worst->rate > 0 ? "grow" : "decay";
  if (worst->frequency > 0)
    snprintf(text, size, "swing at %.3g Hz and %s at %.3g 1/s", worst->frequency, does, fabs(worst->rate));
  else
    snprintf(text, size, "%s at %.3g 1/s", does, fabs(worst->rate));
  return text;
}

static void report(const ZpRest *rest, const ZpGrowth *open, const ZpGrowth *closed, size_t count, ZpResult *result) {
  const double U = rest->statics.U, highest = rest->statics.member->model->control.highest;
  bool held = closed->rate < 0 && U <= highest;
  char alone[96], looped[96];
  zp_result_add(result, "held", "count", held);
  zp_result_add(result, "held_voltage_V", "V", U);
  zp_result_add(result, "open_loop_growth_per_s", "1/s", open->rate);
  zp_result_add(result, "open_loop_frequency_Hz", "Hz", open->frequency);
  for (size_t k = 0; k < TOLD && k < count; k++) {
    zp_result_add(result, growth_name[k], "1/s", closed[k].rate);
    zp_result_add(result, frequency_name[k], "Hz", closed[k].frequency);
    zp_result_add(result, factor_name[k], "1", closed[k].factor);
  }
  zp_result_note(result,
                 "control: the setpoint is an equilibrium at %.5g V%s; small motions about it %s without the "
                 "controller, %s with it: %s",
                 U, U > highest ? ", above drive.voltage" : "", in_words(open, alone, sizeof alone),
                 in_words(closed, looped, sizeof looped), held ? "held" : "not held");
}

/* If the actuator should close further, the boost acts as proportional gain. */
static double gain(const ZpControl *c, double setpoint, bool closing) {
  return c->proportional + (closing && c->boost > 0 ? c->boost / (c->band * fabs(setpoint)) : 0);
}

static void note_unknown(const ZpControl *c, ZpResult *result) {
  add_none(result, NAN);
  zp_result_note(
      result,
      "control: the eigenvalues of the loop were not found, so it is not known whether the setpoint is held; "
      "small motions may overflow within control.period = %g s: try a shorter period",
      c->period);
}

/* For a loop with a boost, the eigenvalue of the side that decays less. */
static bool look(ZpRest *rest, const ZpSetpointSignal *signal, double setpoint, ZpResult *result) {
  const ZpControl *c = &rest->statics.member->model->control;
  ZpPlant plant;
  bool done = zp_plant_create(rest, signal, &plant);
  const ZpLinear system = {plant.n, plant.A, plant.b, plant.c};
  const size_t most = plant.n + ZP_LOOP_OWN;
  ZpGrowth *open = done ? zp_calloc(3 * most, sizeof *open) : NULL;
  double *work = open ? zp_calloc(zp_loop_work(plant.n), sizeof *work) : NULL;
  if (work) {
    ZpGrowth *closed = open + most, *boosted = closed + most;
    size_t alone = zp_open_loop(c, &system, plant.neutral, open, work);
    size_t count = zp_closed_loop(c, &system, gain(c, setpoint, false), plant.neutral, closed, work);
    size_t others = zp_closed_loop(c, &system, gain(c, setpoint, true), plant.neutral, boosted, work);
    if (alone > 0 && count > 0 && others > 0) {
      bool worse = boosted->rate > closed->rate;
      report(rest, open, worse ? boosted : closed, worse ? others : count, result);
    } else {
      note_unknown(c, result);
    }
  }
  done = work != NULL;
  zp_free(work);
  zp_free(open);
  zp_plant_destroy(&plant);
  return done;
}

ZpStatus zp_add_hold(const ZpActuatorDef *def, ZpResult *result, ZpError *err) {
  ZpModel *model;
  if (def->control.kind == ZP_CONTROL_NONE) return ZP_OK;
  ZpStatus status = zp_model_create(def, &model, err);
  if (status != ZP_OK) return status;
  ZpRest *rest = zp_calloc(1, sizeof *rest);
  bool done = rest && zp_rest_open(rest, model, NULL, NULL);
  ZpSetpointSignal signal = {.kind = def->control.signal};
  if (done && zp_setpoint_find(rest, &signal, def->setpoint.value)) {
    done = look(rest, &signal, def->setpoint.value, result);
  } else if (done) {
    add_none(result, 0);
    zp_result_note(
        result, "control: no equilibrium on the branch from the hanging state has the setpoint, so it cannot be held");
  }
  if (rest) zp_rest_close(rest);
  zp_free(rest);
  zp_model_destroy(model);
  return done ? ZP_OK : zp_fail_memory(err);
}
