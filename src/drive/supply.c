/* Letters of docs/theory.md, section 23:
 *   u  command, V      y  command behind the lag, V      V  inner voltage, V      S  slew rate, V/s
 */
#include "drive/supply.h"

#include "math/elementary.h"

const ZpRow zp_row_source_loss =
    ZP_LOST_BY_SOURCE(source_loss, "energy lost so far in the resistance of the source and at its current limits");
const ZpRow zp_row_bleeder_loss = ZP_LOST_BY_SOURCE(bleeder_loss, "energy lost so far in the bleeder");
const ZpRow *const zp_supply_rows[] = {&zp_row_source_loss, &zp_row_bleeder_loss, NULL};

static const double same = 1e-6;       /* V: y and V are one */
static const double all_of_it = 1e-12; /* of the dead time, which rounding may leave */

/* A supply as measured: steps to `level` (V). */
typedef struct ZpSupplyLevel {
  ZpSupplyName supply;
  double level, dead, rise; /* V, s, s from 10 to 90 % */
} ZpSupplyLevel;

#define ZP_SUPPLY_LEVEL(supply, level, dead, rise) {supply, level, dead, rise},
static const ZpSupplyLevel measured[] = {
#include "def/supply_levels.def"
};
#undef ZP_SUPPLY_LEVEL
enum { MEASURED = sizeof measured / sizeof measured[0] };

/* Infinite if the key is none. */
static double or_none(double value) {
  return isnan(value) ? INFINITY : value;
}

/* The list of a supply, whose rows are together. */
static void take_list(ZpSupply *supply, ZpSupplyName name) {
  for (size_t k = 0; k < MEASURED; k++)
    if (measured[k].supply == name && supply->levels++ == 0) supply->list = measured + k;
}

/* Its list at this level, V: linear in between, constant beyond. */
static ZpSupplyLevel listed(const ZpSupply *s, double level) {
  size_t k = 0;
  while (k + 1 < s->levels && s->list[k].level < level)
    k++;
  const ZpSupplyLevel *to = &s->list[k], *from = k > 0 ? to - 1 : to;
  if (from == to || to->level <= level) return *to;
  const double part = (level - from->level) / (to->level - from->level);
  return (ZpSupplyLevel){to->supply, level, from->dead + part * (to->dead - from->dead),
                         from->rise + part * (to->rise - from->rise)};
}

double zp_supply_lag_rate(const ZpSupply *s, double level) {
  static const double rises = 2.1972245773362196; /* ln 9: from 10 to 90 % in time constants */
  return isnan(s->rate) ? rises / listed(s, fabs(level)).rise : s->rate;
}

double zp_supply_dead_time(const ZpSupply *s, double level) {
  return isnan(s->dead) ? listed(s, fabs(level)).dead : s->dead;
}

ZpSupply zp_supply_of(const ZpActuatorDef *def) {
  double most = or_none(def->source.current_limit);
  ZpSupply supply = {.rate = 2 * zp_pi * or_none(def->source.bandwidth),
                     .slew = or_none(def->source.slew_rate),
                     .most = most,
                     .sinks = isnan(def->source.sink_limit) ? most : def->source.sink_limit,
                     .resistance = def->source.resistance,
                     .capacitance = def->source.capacitance,
                     .conductance = isnan(def->source.bleeder) ? 0 : 1 / def->source.bleeder,
                     .doubles = or_none(def->source.bleeder_voltage)};
  take_list(&supply, def->source.supply);
  if (supply.levels > 0 && isnan(def->source.bandwidth)) supply.rate = NAN;
  supply.dead = isnan(def->source.dead_time) && supply.levels == 0 ? 0 : def->source.dead_time;
  bool limited = !isinf(supply.rate) || supply.dead != 0 || isfinite(supply.slew) || isfinite(supply.most) ||
                 isfinite(supply.sinks);
  bool loaded = supply.resistance > 0 || supply.capacitance > 0 || supply.conductance > 0;
  supply.acts = def->source.model == ZP_SOURCE_AMPLIFIER && (limited || loaded);
  return supply;
}

double zp_supply_bled(const ZpSupply *s, double U) {
  return s->conductance * (1 + fabs(U) / s->doubles) * U;
}

double zp_supply_bled_slope(const ZpSupply *s, double U) {
  return s->conductance * (1 + 2 * fabs(U) / s->doubles);
}

/* -- the command ---------------------------------------------------------------------------------- */

double zp_command_voltage(const ZpCommand *c, double t) {
  return c->by_hand ? zp_ramp_value(c->by_hand, t) : zp_waveform_voltage(c->waveform, t);
}

static double command_rate(const ZpCommand *c, double t) {
  return c->by_hand ? zp_ramp_rate(c->by_hand, t) : zp_waveform_rate(c->waveform, t);
}

/* Voltage to which a straight line that is set by hand goes. */
static double end_of_ramp(const ZpRamp *ramp, double t) {
  return zp_ramp_value(ramp, isfinite(ramp->until) ? fmax(t, ramp->until) : t);
}

/* Voltage to which the command goes from time t to its next corner, V. */
static double level_of(const ZpCommand *c, double t) {
  if (c->by_hand) return end_of_ramp(c->by_hand, t);
  const double corner = zp_waveform_next_corner(c->waveform, t);
  return isfinite(corner) ? zp_waveform_voltage_before(c->waveform, corner) : zp_waveform_voltage(c->waveform, t);
}

/* Is the command 0 from t to its next corner? */
static bool is_off(const ZpCommand *c, double t) {
  return zp_command_voltage(c, t) == 0 && level_of(c, t) == 0;
}

static double lag(const ZpCommand *c, double rate, double from, double to, double y) {
  if (!c->by_hand) return zp_waveform_lag(c->waveform, rate, from, to, y);
  if (isinf(rate)) return zp_ramp_value(c->by_hand, to);
  return zp_lag_line(rate, zp_ramp_value(c->by_hand, from), zp_ramp_rate(c->by_hand, from), to - from, y);
}

/* -- what the supply makes of it ------------------------------------------------------------------- */

/* Share of the dead time that has passed a time h after t, eq. (23.9). */
static double ready_after(const ZpSupply *s, const ZpCommand *c, double t, double h, double ready) {
  if (is_off(c, t)) return 0;
  const double left = (1 - ready) * zp_supply_dead_time(s, level_of(c, t));
  return left <= h ? 1 : ready + h / left * (1 - ready);
}

/* Until it runs, a supply makes of any command what it makes of 0 V. */
static bool runs(const ZpSupplyState *at) {
  return at->ready >= 1 - all_of_it;
}

ZpSupplyState zp_supply_jump(const ZpSupply *s, const ZpCommand *c, double t, ZpSupplyState at) {
  at.ready = ready_after(s, c, t, 0, at.ready);
  if (isinf(s->rate)) at.lagged = runs(&at) ? zp_command_voltage(c, t) : 0;
  if (isinf(s->slew)) at.voltage = at.lagged;
  return at;
}

/* Move V towards y as far as the slew rate allows within h. */
static double slewed(const ZpSupply *s, double y, double V, double h) {
  double reach = s->slew * h;
  return fmin(fmax(y, V - reach), V + reach);
}

/* y at `to`. */
static double lagged_at(const ZpSupply *s, const ZpCommand *c, double from, double to, ZpSupplyState at) {
  const double rate = zp_supply_lag_rate(s, level_of(c, from));
  if (runs(&at)) return lag(c, rate, from, to, at.lagged);
  return isinf(rate) ? 0 : zp_lag_line(rate, 0, 0, to - from, at.lagged);
}

ZpSupplyState zp_supply_follow(const ZpSupply *s, const ZpCommand *c, double from, double to, ZpSupplyState at) {
  const double y = lagged_at(s, c, from, to, at), h = to - from;
  return (ZpSupplyState){y, isinf(s->slew) ? y : slewed(s, y, at.voltage, h), ready_after(s, c, from, h, at.ready)};
}

/* Rate of y, which has this value, just after t on the piece of the command that begins at `from`. */
static double lagged_rate(const ZpSupply *s, const ZpCommand *c, double from, double t, ZpSupplyState at) {
  const double rate = zp_supply_lag_rate(s, level_of(c, from));
  if (isinf(rate)) return runs(&at) ? command_rate(c, t) : 0;
  return rate * ((runs(&at) ? zp_command_voltage(c, t) : 0) - at.lagged);
}

/* Where the slew rate limits just after t: +1 upwards, -1 downwards; 0 if it does not limit. */
static double slewing(const ZpSupply *s, const ZpCommand *c, double t, ZpSupplyState at) {
  double left = at.lagged - at.voltage, rate = lagged_rate(s, c, t, t, at);
  if (isinf(s->slew)) return 0;
  if (fabs(left) > same) return copysign(1, left);
  return fabs(rate) > s->slew ? copysign(1, rate) : 0;
}

double zp_supply_rate(const ZpSupply *s, const ZpCommand *c, double t, ZpSupplyState at) {
  double way = slewing(s, c, t, at);
  return way == 0 ? lagged_rate(s, c, t, t, at) : way * s->slew;
}

/* At time `to`: by how much V has passed y, V. If the slew rate does not limit (way == 0): by how much the rate of y
 * exceeds it, V/s. Both change their sign at the event. */
static double past_event(const ZpSupply *s, const ZpCommand *c, double from, double to, ZpSupplyState at, double way) {
  double V = at.voltage;
  at.lagged = lagged_at(s, c, from, to, at);
  if (way != 0) return s->slew * (to - from) - way * (at.lagged - V);
  return fabs(lagged_rate(s, c, from, to, at)) - s->slew;
}

/* When the slew rate begins or ceases to limit. */
static double slew_event(const ZpSupply *s, const ZpCommand *c, double t, double latest, ZpSupplyState at) {
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

/* When a supply that waits begins to run. */
static double start_event(const ZpSupply *s, const ZpCommand *c, double t, ZpSupplyState at) {
  if (runs(&at) || is_off(c, t)) return INFINITY;
  return t + (1 - at.ready) * zp_supply_dead_time(s, level_of(c, t));
}

double zp_supply_event(const ZpSupply *s, const ZpCommand *c, double t, double latest, ZpSupplyState at) {
  static const double far = 1; /* s */
  const double starts = start_event(s, c, t, at);
  const double slews = slew_event(s, c, t, fmin(fmin(latest, starts), t + far), at);
  return starts <= latest ? fmin(starts, slews) : slews;
}

/* -- rules ----------------------------------------------------------------------------------------- */

static const ZpRule rule[] = {
    ZP_RULE(PHYSICS, ZP_SET_WITHIN(source.slew_rate, source.voltage_limit), ZP_IS(source.model, ZP_SOURCE_AMPLIFIER),
            "an ideal source has no limits"),
    ZP_RULE(PHYSICS, ZP_SET(source.bleeder_voltage), ZP_SET(source.bleeder),
            "there is no bleeder; give source.bleeder"),
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
