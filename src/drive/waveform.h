/* Voltage over time. Knows nothing of what it drives.
 *
 * All waveforms but sine are straight between knots, of which two at one time are a jump. A waveform is const and
 * has no memory: at any time its voltage follows from the time alone.
 */
#ifndef ZP_DRIVE_WAVEFORM_H
#define ZP_DRIVE_WAVEFORM_H

#include <math.h>
#include <stdbool.h>

#include "def/def.h"
#include <zipact/drive.h>

#include "def/rule.h"

typedef struct ZpWaveform {
  ZpWaveformKind kind;
  double offset, voltage;            /* V */
  double rise_time, frequency, duty; /* s, Hz, 1 */
  double delay;                      /* the waveform begins then, s; until then the voltage is that of its begin */
  ZpDriveTable table;                /* of kind table; without rows: drive.voltage */
} ZpWaveform;

/* The waveform of the keys; the rows stay the caller's. */
ZpWaveform zp_waveform_of(const ZpActuatorDef *def, const ZpDriveTable *table);

/* The waveform of the setpoint's keys, in the unit of control.signal. */
ZpWaveform zp_setpoint_of(const ZpActuatorDef *def, const ZpDriveTable *table);

/* Voltage from time t >= 0 on; at a jump that behind it. */
double zp_waveform_voltage(const ZpWaveform *w, double t);

/* Voltage up to time t > 0; at a jump that before it. */
double zp_waveform_voltage_before(const ZpWaveform *w, double t);

/* The next time > t at which the voltage jumps or turns, s; of a sine, that of its next extreme, so that no step
 * leaves out a wave. INFINITY if there is none. */
double zp_waveform_next_corner(const ZpWaveform *w, double t);

/* Its rate just after t, V/s. */
double zp_waveform_rate(const ZpWaveform *w, double t);

/* Voltage at `to` behind a lag of first order with `rate` (1/s), from `lagged` (V) at `from`; there is no corner
 * between. Eq. (23.1). */
double zp_waveform_lag(const ZpWaveform *w, double rate, double from, double to, double lagged);

/* Voltage behind that lag of a straight line that begins at `voltage` and changes by `slope` (V/s) for a time h. */
double zp_lag_line(double rate, double voltage, double slope, double h, double lagged);

/* Does the voltage stay as it is at t = 0? */
bool zp_waveform_is_constant(const ZpWaveform *w);

/* Largest absolute voltage, V. */
double zp_waveform_largest(const ZpWaveform *w);

/* Longest step for a voltage that changes, s: that of a fortieth of its largest, so that slow changes do not carry an
 * actuator over an instability unseen; where that is below a millisecond the local error sees what happens, and a
 * quarter will do, so that no wave is left out. INFINITY where it stays. */
double zp_waveform_resolution(const ZpWaveform *w, double t);

/* Longest step for a quantity with this largest value and this rate, per second, s. */
double zp_ramp_resolution(double largest, double rate);

/* INFINITY if it does not repeat itself, s. */
double zp_waveform_period(const ZpWaveform *w);

/* An input by hand: from time `since` on a value that changes with `rate` per second, until time `until` at the latest.
 */
typedef struct ZpRamp {
  double value, rate, since, until;
} ZpRamp;

static inline double zp_ramp_value(const ZpRamp *ramp, double t) {
  return ramp->value + ramp->rate * (fmin(t, ramp->until) - ramp->since);
}

/* The rate at a time, and the next time > t at which it changes; INFINITY if there is none. */
static inline double zp_ramp_rate(const ZpRamp *ramp, double t) {
  return t < ramp->until ? ramp->rate : 0;
}

static inline double zp_ramp_corner(const ZpRamp *ramp, double t) {
  return ramp->rate != 0 && ramp->until > t ? ramp->until : INFINITY;
}

/* Combinations of its keys that are refused. */
extern const ZpRules zp_rules_waveform;

#endif
