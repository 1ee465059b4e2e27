/* Letters of docs/theory.md, section 23:
 *   u  command, V      y  command behind the lag, V      V  inner voltage, V      S  slew rate, V/s
 */
#include "drive/supply.h"

#include "math/elementary.h"

const ZpRow zp_row_source_loss =
    ZP_LOST_BY_SOURCE(source_loss, "energy lost so far in the resistance of the source and at its current limits");
const ZpRow zp_row_bleeder_loss = ZP_LOST_BY_SOURCE(bleeder_loss, "energy lost so far in the bleeder");
const ZpRow *const zp_supply_rows[] = {&zp_row_source_loss, &zp_row_bleeder_loss, NULL};

static const double same = 1e-6; /* V: y and V are one */

/* Infinite if the key is none. */
static double or_none(double value) {
  return isnan(value) ? INFINITY : value;
}

ZpSupply zp_supply_of(const ZpActuatorDef *def) {
  double most = or_none(def->source.current_limit);
  ZpSupply supply = {.rate = 2 * zp_pi * or_none(def->source.bandwidth),
                     .slew = or_none(def->source.slew_rate),
                     .most = most,
                     .sinks = isnan(def->source.sink_limit) ? most : def->source.sink_limit,
                     .resistance = def->source.resistance,
                     .capacitance = def->source.capacitance,
                     .conductance = isnan(def->source.bleeder) ? 0 : 1 / def->source.bleeder};
  bool limited = isfinite(supply.rate) || isfinite(supply.slew) || isfinite(supply.most) || isfinite(supply.sinks);
  bool loaded = supply.resistance > 0 || supply.capacitance > 0 || supply.conductance > 0;
  supply.acts = def->source.model == ZP_SOURCE_AMPLIFIER && (limited || loaded);
  return supply;
}

/* -- the command ---------------------------------------------------------------------------------- */

double zp_command_voltage(const ZpCommand *c, double t) {
  return c->by_hand ? zp_ramp_value(c->by_hand, t) : zp_waveform_voltage(c->waveform, t);
}

static double command_rate(const ZpCommand *c, double t) {
  return c->by_hand ? zp_ramp_rate(c->by_hand, t) : zp_waveform_rate(c->waveform, t);
}

static double lag(const ZpCommand *c, double rate, double from, double to, double y) {
  if (!c->by_hand) return zp_waveform_lag(c->waveform, rate, from, to, y);
  if (isinf(rate)) return zp_ramp_value(c->by_hand, to);
  return zp_lag_line(rate, zp_ramp_value(c->by_hand, from), zp_ramp_rate(c->by_hand, from), to - from, y);
}

/* -- what the supply makes of it ------------------------------------------------------------------- */

ZpSupplyState zp_supply_jump(const ZpSupply *s, const ZpCommand *c, double t, ZpSupplyState at) {
  if (isinf(s->rate)) at.lagged = zp_command_voltage(c, t);
  if (isinf(s->slew)) at.voltage = at.lagged;
  return at;
}

/* Move V towards y as far as the slew rate allows within h. */
static double slewed(const ZpSupply *s, double y, double V, double h) {
  double reach = s->slew * h;
  return fmin(fmax(y, V - reach), V + reach);
}

ZpSupplyState zp_supply_follow(const ZpSupply *s, const ZpCommand *c, double from, double to, ZpSupplyState at) {
  double y = lag(c, s->rate, from, to, at.lagged);
  return (ZpSupplyState){y, isinf(s->slew) ? y : slewed(s, y, at.voltage, to - from)};
}

/* Rate of y just after t. */
static double lagged_rate(const ZpSupply *s, const ZpCommand *c, double t, double y) {
  return isinf(s->rate) ? command_rate(c, t) : s->rate * (zp_command_voltage(c, t) - y);
}

/* Where the slew rate limits just after t: +1 upwards, -1 downwards; 0 if it does not limit. */
static double slewing(const ZpSupply *s, const ZpCommand *c, double t, ZpSupplyState at) {
  double left = at.lagged - at.voltage, rate = lagged_rate(s, c, t, at.lagged);
  if (isinf(s->slew)) return 0;
  if (fabs(left) > same) return copysign(1, left);
  return fabs(rate) > s->slew ? copysign(1, rate) : 0;
}

double zp_supply_rate(const ZpSupply *s, const ZpCommand *c, double t, ZpSupplyState at) {
  double way = slewing(s, c, t, at);
  return way == 0 ? lagged_rate(s, c, t, at.lagged) : way * s->slew;
}

/* At time `to`: by how much V has passed y, V. If the slew rate does not limit (way == 0): by how much the rate of y
 * exceeds it, V/s. Both change their sign at the event. */
static double past_event(const ZpSupply *s, const ZpCommand *c, double from, double to, ZpSupplyState at, double way) {
  double y = lag(c, s->rate, from, to, at.lagged);
  if (way != 0) return s->slew * (to - from) - way * (y - at.voltage);
  return fabs(lagged_rate(s, c, to, y)) - s->slew;
}

double zp_supply_event(const ZpSupply *s, const ZpCommand *c, double t, double latest, ZpSupplyState at) {
  enum { HALVINGS = 60 };
  if (isinf(s->slew)) return INFINITY;
  double way = slewing(s, c, t, at);
  if (!(past_event(s, c, t, latest, at, way) > 0)) return INFINITY;
  double before = t, after = latest;
  for (int k = 0; k < HALVINGS; k++) {
    double middle = before + 0.5 * (after - before);
    if (past_event(s, c, t, middle, at, way) > 0)
      after = middle;
    else
      before = middle;
  }
  return after;
}

/* -- rules ----------------------------------------------------------------------------------------- */

static const ZpRule rule[] = {
    ZP_RULE(PHYSICS, ZP_SET_WITHIN(source.slew_rate, source.voltage_limit), ZP_IS(source.model, ZP_SOURCE_AMPLIFIER),
            "an ideal source has no limits"),
    ZP_RULE(PHYSICS, ZP_IS(source.model, ZP_SOURCE_AMPLIFIER), ZP_NOT(source.slew_rate, 0),
            "the source would never leave 0 V; give a rate above 0 or none"),
    ZP_RULE(PHYSICS, ZP_IS(source.model, ZP_SOURCE_AMPLIFIER), ZP_NOT(source.current_limit, 0),
            "the source could never charge the electrodes; give a current above 0 or none"),
    ZP_RULE(NOT_MODELLED, ZP_IS(source.model, ZP_SOURCE_AMPLIFIER), ZP_AT_MOST(source.bandwidth, 1e9),
            "time steps resolve no more; give none for an unlimited bandwidth"), /* a thousand of the shortest */
    ZP_RULE(PHYSICS, ZP_IS(source.model, ZP_SOURCE_AMPLIFIER), ZP_HAS(ELECTRODES), "a single ribbon has no electrodes"),
    ZP_MOTION_RULE(NOT_MODELLED, ZP_IS(source.model, ZP_SOURCE_AMPLIFIER),
                   ZP_IS(solver.integrator, ZP_INTEGRATOR_IMPLICIT),
                   "the voltage of the electrodes is an unknown of implicit steps"),
};

const ZpRules zp_rules_supply = ZP_RULES_OF(rule);
