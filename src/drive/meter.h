/* A capacitance meter: a small sine on the voltage, whose current is sampled with noise and finite resolution; the part
 * of it that leads by a quarter of a period is the capacitance. Knows nothing of what it measures. docs/theory.md,
 * section 26. */
#ifndef ZP_DRIVE_METER_H
#define ZP_DRIVE_METER_H

#include <stddef.h>

#include "def/def.h"

#include "def/rule.h"

typedef struct ZpMeter {
  double frequency, amplitude; /* of the sine, Hz, V */
  size_t per_period;           /* samples in a period */
  size_t periods;              /* whole ones in the window of a reading */
  double step;                 /* between two readable currents, A; 0: any is readable */
  double range;                /* largest readable current, A; INFINITY: any is */
  double noise;                /* root mean square of a sample's noise, A */
  int seed;
} ZpMeter;

/* `capacitance`: the largest that is expected, F, of which the automatic range follows. */
ZpMeter zp_meter_of(const ZpActuatorDef *def, double capacitance);

/* Length of a window, s. */
double zp_meter_window(const ZpMeter *meter);

/* Charge without the sine, and capacitance, at `count` instants; both are straight lines between them. */
typedef struct ZpMeterTrace {
  size_t count;
  const double *time, *charge, *capacitance; /* s, C, F */
} ZpMeterTrace;

/* Windows follow each other from time 0 on: readings of `windows` of them from number `first` on => capacitance
 * [windows], F. The trace must contain them. A window has the same noise whatever the first one is. */
void zp_meter_read(const ZpMeter *meter, const ZpMeterTrace *trace, size_t first, size_t windows, double *capacitance);

/* Combinations of its keys that are refused. */
extern const ZpRules zp_rules_meter;

#endif
