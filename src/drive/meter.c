#include "drive/meter.h"

#include <math.h>

#include "drive/noise.h"
#include "math/elementary.h"

ZpMeter zp_meter_of(const ZpActuatorDef *def, double capacitance) {
  static const double bandwidth = 0.443; /* of a mean over 1 s, Hz: there a sine is 1 / sqrt 2 as large */
  static const double room = 2;          /* in the automatic range, for what else flows */
  double f = def->sense.frequency, A = def->sense.amplitude, periods = round(bandwidth * f / def->sense.bandwidth);
  double range = isnan(def->sense.range) ? room * 2 * zp_pi * f * A * capacitance : def->sense.range;
  bool all = isnan(def->sense.bits);
  return (ZpMeter){.frequency = f,
                   .amplitude = A,
                   .per_period = (size_t)round(def->sense.sampling_rate / f),
                   .periods = (size_t)fmax(periods, 1),
                   .step = all ? 0 : ldexp(range, 1 - (int)def->sense.bits),
                   .range = all ? INFINITY : range,
                   .noise = isnan(def->sense.noise) ? 0 : def->sense.noise,
                   .seed = def->sense.seed};
}

double zp_meter_window(const ZpMeter *meter) {
  return (double)meter->periods / meter->frequency;
}

/* A current as it is read. */
static double readable(const ZpMeter *meter, double current) {
  double within = fmax(-meter->range, fmin(current, meter->range));
  return meter->step > 0 ? meter->step * round(within / meter->step) : within;
}

/* The current at time t, which is `turns` after a zero of the sine: eq. (26.1). *at is the interval of the trace. */
static double current_at(const ZpMeter *meter, const ZpMeterTrace *trace, double t, double turns, size_t *at) {
  while (*at + 2 < trace->count && trace->time[*at + 1] <= t)
    (*at)++;
  const double *time = trace->time + *at, *Q = trace->charge + *at, *C = trace->capacitance + *at;
  double h = time[1] - time[0], by = h > 0 ? 1 / h : 0, here = C[0] + (C[1] - C[0]) * (t - time[0]) * by;
  double sine = meter->amplitude * zp_sine_of(turns),
         rate = 2 * zp_pi * meter->frequency * meter->amplitude * zp_cosine_of(turns);
  return (Q[1] - Q[0]) * by + (C[1] - C[0]) * by * sine + here * rate;
}

void zp_meter_read(const ZpMeter *meter, const ZpMeterTrace *trace, size_t first, size_t windows, double *capacitance) {
  size_t per = meter->per_period, count = per * meter->periods, at = 0;
  double rate = meter->frequency * (double)per, gain = 2 * zp_pi * meter->frequency * meter->amplitude;
  uint64_t seed = (uint64_t)meter->seed;
  for (size_t k = 0; meter->noise > 0 && k < first * count; k++)
    zp_unit_noise(&seed);
  for (size_t w = 0; w < windows; w++) {
    double sum = 0;
    for (size_t k = 0; k < count; k++) {
      double turns = (double)(k % per) / (double)per, t = (double)((first + w) * count + k) / rate;
      double noise = meter->noise > 0 ? meter->noise * zp_unit_noise(&seed) : 0;
      sum += readable(meter, current_at(meter, trace, t, turns, &at) + noise) * zp_cosine_of(turns);
    }
    capacitance[w] = 2 * sum / ((double)count * gain);
  }
}

/* -- rules ----------------------------------------------------------------------------------------- */

static const char no_meter[] = "without it there is no meter";

static const ZpRule rule[] = {
    ZP_RULE(PHYSICS, ZP_SET(sense.amplitude), ZP_SET(sense.frequency), no_meter),
    ZP_RULE(PHYSICS, ZP_SET(sense.sampling_rate), ZP_SET(sense.frequency), no_meter),
    ZP_RULE(PHYSICS, ZP_SET(sense.bits), ZP_SET(sense.frequency), no_meter),
    ZP_RULE(PHYSICS, ZP_ABOVE(sense.noise, 0), ZP_SET(sense.frequency), no_meter),
    ZP_RULE(PHYSICS, ZP_SET(sense.frequency), ZP_SET(sense.amplitude), "a meter applies a sine"),
    ZP_RULE(PHYSICS, ZP_SET(sense.frequency), ZP_SET(sense.sampling_rate), "a meter takes samples"),
    ZP_RULE(PHYSICS, ZP_SET(sense.frequency), ZP_HAS(ELECTRODES), "a single ribbon has no electrodes"),
};

const ZpRules zp_rules_meter = ZP_RULES_OF(rule);
