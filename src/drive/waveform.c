/* Waveforms. Letters of docs/theory.md, section 17:
 *   U  voltage, V       U_0  drive.offset, V       f  frequency, Hz       T  rise_time, s       D  duty
 */
#include "drive/waveform.h"

#include <math.h>
#include <stdint.h>

#include "math/elementary.h"

typedef struct Knot {
  double t, U;
} Knot;

ZpWaveform zp_waveform_of(const ZpActuatorDef *def, const ZpDriveTable *table) {
  return (ZpWaveform){.kind = def->drive.waveform,
                      .offset = def->drive.offset,
                      .voltage = def->drive.voltage,
                      .rise_time = def->drive.rise_time,
                      .frequency = def->drive.frequency,
                      .duty = def->drive.duty,
                      .delay = def->drive.delay,
                      .table = table ? *table : (ZpDriveTable){0}};
}

ZpWaveform zp_setpoint_of(const ZpActuatorDef *def, const ZpDriveTable *table) {
  return (ZpWaveform){.kind = def->setpoint.waveform,
                      .offset = def->setpoint.offset,
                      .voltage = def->setpoint.value,
                      .rise_time = def->setpoint.rise_time,
                      .frequency = def->setpoint.frequency,
                      .duty = def->setpoint.duty,
                      .table = *table};
}

/* -- knots ---------------------------------------------------------------------------------------- */

enum { PER_CYCLE = 4 }; /* knots of a square wave */

static int64_t knots(const ZpWaveform *w) {
  switch (w->kind) {
  case ZP_WAVEFORM_RAMP:
    return 2;
  case ZP_WAVEFORM_SQUARE:
    return INT64_MAX;
  case ZP_WAVEFORM_TABLE:
    return (int64_t)w->table.rows;
  case ZP_WAVEFORM_STEP:
  case ZP_WAVEFORM_SINE:
    break;
  }
  return 0;
}

/* One cycle rises within the rise time, stays, falls within the rise time, stays. */
static Knot square_knot(const ZpWaveform *w, int64_t i) {
  int64_t place = i % PER_CYCLE;
  int64_t cycles = i / PER_CYCLE;
  double cycle = (double)cycles, start = place < 2 ? cycle : cycle + w->duty;
  bool after = place % 2 == 1, high = place == 1 || place == 2;
  return (Knot){start / w->frequency + (after ? w->rise_time : 0), high ? w->voltage : w->offset};
}

static Knot knot(const ZpWaveform *w, int64_t i) {
  if (w->kind == ZP_WAVEFORM_SQUARE) return square_knot(w, i);
  if (w->kind == ZP_WAVEFORM_TABLE) return (Knot){w->table.time[i], w->table.voltage[i]};
  return i == 0 ? (Knot){0, w->offset} : (Knot){w->rise_time, w->voltage};
}

static bool is_past(const ZpWaveform *w, int64_t i, double t, bool or_at) {
  double at = knot(w, i).t;
  return at < t || (or_at && at == t);
}

/* The last knot before t, `or_at` it; -1 if there is none. */
static int64_t last_knot(const ZpWaveform *w, double t, bool or_at) {
  if (w->kind == ZP_WAVEFORM_SQUARE) { /* what rounding may do to the cycle's number is looked at */
    int64_t i = PER_CYCLE * ((int64_t)(t * w->frequency) + 2) - 1;
    while (i >= 0 && !is_past(w, i, t, or_at))
      i--;
    return i;
  }
  int64_t below = -1, above = knots(w);
  while (above - below > 1) {
    int64_t middle = below + (above - below) / 2;
    if (is_past(w, middle, t, or_at))
      below = middle;
    else
      above = middle;
  }
  return below;
}

/* Voltage at t on the straight piece behind knot i. */
static double on_piece(const ZpWaveform *w, int64_t i, double t) {
  if (i < 0) return knot(w, 0).U;
  Knot from = knot(w, i);
  if (i + 1 == knots(w)) return from.U;
  Knot to = knot(w, i + 1);
  return t == to.t ? to.U : from.U + (to.U - from.U) * ((t - from.t) / (to.t - from.t));
}

/* -- sine ----------------------------------------------------------------------------------------- */

/* From U_0 up to the voltage and back, first at U_0: eq. (17.1). */
static double sine(const ZpWaveform *w, double t) {
  return w->offset + (w->voltage - w->offset) * zp_sine_squared(w->frequency * t);
}

static double next_extreme(const ZpWaveform *w, double t) {
  double twice = 2 * w->frequency, half = floor(t * twice);
  while (half / twice <= t)
    half++;
  return half / twice;
}

/* -- all ------------------------------------------------------------------------------------------ */

/* Has the delayed waveform not begun at t, or up to t? */
static bool is_before(const ZpWaveform *w, double t, bool or_at) {
  return t < w->delay || (t == w->delay && w->delay > 0 && !or_at);
}

/* A step begins at 0 V, where it has to wait. */
static double at_begin(const ZpWaveform *w) {
  if (w->kind == ZP_WAVEFORM_STEP) return 0;
  return w->kind == ZP_WAVEFORM_SINE ? w->offset : knot(w, 0).U;
}

static double voltage(const ZpWaveform *w, double t, bool or_at) {
  if (is_before(w, t, or_at)) return at_begin(w);
  t -= w->delay;
  if (w->kind == ZP_WAVEFORM_SINE) return sine(w, t);
  return knots(w) == 0 ? w->voltage : on_piece(w, last_knot(w, t, or_at), t);
}

double zp_waveform_voltage(const ZpWaveform *w, double t) {
  return voltage(w, t, true);
}

double zp_waveform_voltage_before(const ZpWaveform *w, double t) {
  return voltage(w, t, false);
}

/* Of the waveform without its delay. */
static double corner_after(const ZpWaveform *w, double t) {
  if (w->kind == ZP_WAVEFORM_SINE) return next_extreme(w, t);
  int64_t next = knots(w) == 0 ? 0 : last_knot(w, t, true) + 1;
  return next < knots(w) ? knot(w, next).t : INFINITY;
}

/* After a delay a corner may be rounded to t itself. */
double zp_waveform_next_corner(const ZpWaveform *w, double t) {
  if (t < w->delay) return w->delay;
  double corner = corner_after(w, t - w->delay);
  while (corner + w->delay <= t)
    corner = corner_after(w, corner);
  return corner + w->delay;
}

/* Lowest and highest voltage. */
static void bounds(const ZpWaveform *w, double *low, double *high) {
  bool moves = w->kind != ZP_WAVEFORM_STEP && w->kind != ZP_WAVEFORM_TABLE;
  double first = moves ? w->offset : w->voltage;
  *low = fmin(first, w->voltage);
  *high = fmax(first, w->voltage);
  for (size_t i = 0; w->kind == ZP_WAVEFORM_TABLE && i < w->table.rows; i++) {
    *low = i == 0 ? w->table.voltage[0] : fmin(*low, w->table.voltage[i]);
    *high = i == 0 ? w->table.voltage[0] : fmax(*high, w->table.voltage[i]);
  }
}

bool zp_waveform_is_constant(const ZpWaveform *w) {
  double low, high;
  bounds(w, &low, &high);
  return low == high && (w->delay == 0 || at_begin(w) == low);
}

double zp_waveform_largest(const ZpWaveform *w) {
  double low, high;
  bounds(w, &low, &high);
  return fmax(fabs(low), fabs(high));
}

/* V/s just after t; of a sine the largest. */
static double slope(const ZpWaveform *w, double t) {
  if (is_before(w, t, true)) return 0;
  t -= w->delay;
  if (w->kind == ZP_WAVEFORM_SINE) return zp_pi * w->frequency * (w->voltage - w->offset);
  int64_t last = knots(w) == 0 ? -1 : last_knot(w, t, true);
  if (last < 0 || last + 1 >= knots(w)) return 0;
  Knot from = knot(w, last), to = knot(w, last + 1);
  return to.t > from.t ? (to.U - from.U) / (to.t - from.t) : 0;
}

double zp_ramp_resolution(double largest, double rate) {
  static const double fine = 1.0 / 40, coarse = 1.0 / 4, fast = 1e-3; /* s */
  double all = largest / fabs(rate);
  return rate != 0 ? fmin(coarse * all, fmax(fine * all, fast)) : INFINITY;
}

double zp_waveform_rate(const ZpWaveform *w, double t) {
  double largest_rate = slope(w, t);
  return w->kind == ZP_WAVEFORM_SINE ? largest_rate * zp_sine_of(w->frequency * (t - w->delay)) : largest_rate;
}

double zp_lag_line(double rate, double voltage, double slope, double h, double lagged) {
  return lagged + slope * h + (lagged - voltage + slope / rate) * zp_decay(rate * h);
}

/* Where a lag settles on a sine, less U_0. */
static double settled_sine(const ZpWaveform *w, double rate, double t) {
  double ratio = 2 * zp_pi * w->frequency / rate, p = w->frequency * (t - w->delay);
  return 0.5 * (w->voltage - w->offset) * (1 - (zp_cosine_of(p) + ratio * zp_sine_of(p)) / (1 + ratio * ratio));
}

double zp_waveform_lag(const ZpWaveform *w, double rate, double from, double to, double lagged) {
  if (isinf(rate)) return zp_waveform_voltage_before(w, to);
  if (w->kind != ZP_WAVEFORM_SINE || from < w->delay)
    return zp_lag_line(rate, zp_waveform_voltage(w, from), slope(w, from), to - from, lagged);
  double at = settled_sine(w, rate, from);
  return lagged + (settled_sine(w, rate, to) - at) + (lagged - w->offset - at) * zp_decay(rate * (to - from));
}

double zp_waveform_resolution(const ZpWaveform *w, double t) {
  return zp_ramp_resolution(zp_waveform_largest(w), slope(w, t));
}

double zp_waveform_period(const ZpWaveform *w) {
  bool repeats = w->kind == ZP_WAVEFORM_SINE || w->kind == ZP_WAVEFORM_SQUARE;
  return repeats ? 1 / w->frequency : INFINITY;
}

/* -- rules ----------------------------------------------------------------------------------------- */

/* A key that the waveform does not use must not be given: either the key or the waveform would be a mistake. */
static const char no_use[] = "the waveform does not use this key", alone[] = "give only one of them";
#define ZP_WAVEFORM(group)                                                                                             \
  ZP_RULE(PHYSICS, ZP_SET(group.offset),                                                                               \
          ZP_ONE_OF(group.waveform, ZP_BIT(ZP_WAVEFORM_RAMP) | ZP_BIT(ZP_WAVEFORM_SINE) | ZP_BIT(ZP_WAVEFORM_SQUARE)), \
          no_use),                                                                                                     \
      ZP_RULE(PHYSICS, ZP_SET(group.rise_time),                                                                        \
              ZP_ONE_OF(group.waveform, ZP_BIT(ZP_WAVEFORM_RAMP) | ZP_BIT(ZP_WAVEFORM_SQUARE)), no_use),               \
      ZP_RULE(PHYSICS, ZP_SET(group.frequency),                                                                        \
              ZP_ONE_OF(group.waveform, ZP_BIT(ZP_WAVEFORM_SINE) | ZP_BIT(ZP_WAVEFORM_SQUARE)), no_use),               \
      ZP_RULE(PHYSICS, ZP_SET(group.duty), ZP_IS(group.waveform, ZP_WAVEFORM_SQUARE), no_use),                         \
      ZP_RULE(PHYSICS, ZP_SET(group.table), ZP_IS(group.waveform, ZP_WAVEFORM_TABLE), no_use),                         \
      ZP_RULE(PHYSICS, ZP_SET(group.file), ZP_IS(group.waveform, ZP_WAVEFORM_TABLE), no_use),                          \
      ZP_RULE(PHYSICS, ZP_SET(group.file), ZP_UNSET(group.table), alone),                                              \
      ZP_RULE(PHYSICS, ZP_IS(group.waveform, ZP_WAVEFORM_RAMP), ZP_ABOVE(group.rise_time, 0),                          \
              "a ramp takes time; or use step")

static const ZpRule rule[] = {ZP_WAVEFORM(drive), ZP_WAVEFORM(setpoint)};
#undef ZP_WAVEFORM

const ZpRules zp_rules_waveform = ZP_RULES_OF(rule);
