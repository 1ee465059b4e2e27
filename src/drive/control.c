/* Letters of docs/theory.md, section 28:
 *   e  error      I  integral, V      u  output, V      T  period
 */
#include "drive/control.h"

#include <math.h>

#include "def/device.h"
#include "def/rule.h"
#include "drive/meter.h"
#include "drive/noise.h"
#include "drive/supply.h"
#include "drive/waveform.h"

enum { PENDING = ZP_CONTROL_DELAY + 1 };

static const double rounding = 1e-9; /* of a period: a time that is meant to be that of a sample */

ZpControl zp_control_of(const ZpActuatorDef *def) {
  const bool contracts = zp_def_has(def, ZP_DEVICE_POUCH); /* its stroke */
  bool falls = def->control.signal == ZP_CONTROL_OPENING || (def->control.signal == ZP_CONTROL_STROKE && !contracts);
  return (ZpControl){.kind = def->control.kind,
                     .sense = falls ? 1 : -1,
                     .proportional = def->control.proportional,
                     .integral = def->control.integral,
                     .period = def->control.period,
                     .delay = def->control.delay,
                     .boost = def->control.kind == ZP_CONTROL_BOOST_PI ? def->control.boost_voltage : 0,
                     .band = def->control.boost_band,
                     .highest = def->drive.voltage,
                     .noise = def->control.noise,
                     .seed = def->control.seed};
}

ZpControlState zp_control_start(void) {
  return (ZpControlState){.measured = NAN};
}

void zp_control_restart(const ZpControl *c, double t, ZpControlState *state) {
  if (c->kind == ZP_CONTROL_NONE)
    *state = zp_control_start();
  else
    state->taken = state->given = fmax(0, ceil(t / c->period - rounding));
}

bool zp_control_fits(const ZpControl *c, double t, const ZpControlState *state) {
  static const double near = 1e-6; /* of a period: times that were rounded */
  if (c->kind == ZP_CONTROL_NONE) return state->taken == 0 && state->given == 0;
  const double passed = t / c->period, pending = state->taken - state->given;
  bool whole = state->taken == floor(state->taken) && state->given == floor(state->given);
  return whole && state->given >= 0 && pending >= 0 && pending <= PENDING && state->taken >= passed - near &&
         state->taken <= passed + 1 + near;
}

double zp_control_sample_time(const ZpControl *c, const ZpControlState *state) {
  return state->taken * c->period;
}

/* A delay of whole periods ends exactly at a sample. */
double zp_control_output_time(const ZpControl *c, const ZpControlState *state) {
  double whole = floor(c->delay / c->period + rounding), rest = c->delay - whole * c->period;
  if (state->given >= state->taken) return INFINITY;
  return (state->given + whole) * c->period + (rest > rounding * c->period ? rest : 0);
}

/* Added to the output while the actuator should close further, eq. (28.3). */
static double boost(const ZpControl *c, double error, double setpoint) {
  if (c->boost == 0 || error <= 0) return 0;
  double band = c->band * fabs(setpoint);
  return c->boost * (error < band ? error / band : 1);
}

/* The integral after a sample, eq. (28.2): clamped so that it takes the output to a limit, but not beyond. */
static double integral_after(const ZpControl *c, double before, double error, double rest) {
  double after = before + c->integral * c->period * error;
  if (error > 0 && rest + after > c->highest) return fmax(before, c->highest - rest);
  if (error < 0 && rest + after < 0) return fmin(before, -rest);
  return after;
}

void zp_control_sample(const ZpControl *c, double setpoint, double signal, ZpControlState *state) {
  double noise = c->noise > 0 ? c->noise * zp_noise_at((uint64_t)c->seed, (uint64_t)state->taken) : 0;
  state->measured = signal + noise;
  double e = c->sense * (state->measured - setpoint), rest = c->proportional * e + boost(c, e, setpoint);
  state->integral = integral_after(c, state->integral, e, rest);
  state->pending[(size_t)fmod(state->taken, PENDING)] = fmin(fmax(rest + state->integral, 0), c->highest);
  state->taken++;
}

double zp_control_output(ZpControlState *state) {
  return state->pending[(size_t)fmod(state->given++, PENDING)];
}

/* -- rules ----------------------------------------------------------------------------------------- */

static const char no_control[] = "without a controller this key has no effect; use pi or boost_pi";
#define ZP_WITH ZP_NOT(control.kind, ZP_CONTROL_NONE)

static const ZpRule rule[] = {
    ZP_RULE(PHYSICS, ZP_SET_WITHIN(setpoint.value, setpoint.file), ZP_WITH, no_control),
    ZP_RULE(PHYSICS, ZP_SET_WITHIN(control.signal, control.boost_band), ZP_WITH, no_control),
    ZP_RULE(PHYSICS, ZP_WITH, ZP_USES_VOLTAGE, "a voltage does nothing to a single ribbon without them"),
    ZP_RULE(NOT_MODELLED, ZP_WITH, ZP_AT_LEAST(drive.voltage, 0),
            "a controller's voltage goes from 0 up to drive.voltage; give the curvature the other sign"),
    ZP_RULE_IF(PHYSICS, ZP_ONE_OF(control.signal, ZP_BIT(ZP_CONTROL_OPENING) | ZP_BIT(ZP_CONTROL_CONTRACTION)), ZP_WITH,
               ZP_HAS(PAIR), "one ribbon has no opening; use control.signal stroke"),
    ZP_RULE_IF(PHYSICS, ZP_IS(control.signal, ZP_CONTROL_ANGLE), ZP_WITH, ZP_IS(platform.rotates, true),
               "only a body that turns has an angle"),
    ZP_RULE(PHYSICS, ZP_WITH, ZP_IS(drive.waveform, ZP_WAVEFORM_STEP),
            "the controller sets the voltage, up to drive.voltage; setpoint.waveform is the setpoint over time"),
    ZP_RULE_IF(PHYSICS, ZP_WITH, ZP_NOT(setpoint.waveform, ZP_WAVEFORM_TABLE), ZP_SET(setpoint.value),
               "a controller has a setpoint"),
};
#undef ZP_WITH

static const ZpRules rules = ZP_RULES_OF(rule);
const ZpRules *const zp_rules_of_sources[] = {&rules, &zp_rules_waveform, &zp_rules_supply, &zp_rules_meter, NULL};
