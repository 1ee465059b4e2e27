#include "drive/response.h"

#include <math.h>
#include <stdbool.h>

/* The first sample with the last setpoint. */
static size_t last_change(const ZpResponseSample *s, size_t count) {
  size_t k = count - 1;
  while (k > 0 && s[k - 1].setpoint == s[count - 1].setpoint)
    k--;
  return k;
}

/* A setpoint that is constant before it changes has jumped. */
static bool is_step(const ZpResponseSample *s, size_t at) {
  return at < 2 || s[at - 1].setpoint == s[at - 2].setpoint;
}

/* The time at which the signal is at `level` between a sample and the next, on a straight line. */
static double crossing(const ZpResponseSample *s, double level) {
  double share = (level - s[0].signal) / (s[1].signal - s[0].signal);
  return s[0].time + share * (s[1].time - s[0].time);
}

/* The time at which it first has covered that part of the way from sample 0 to its setpoint; NAN: never. */
static double reached_at(const ZpResponseSample *s, size_t count, double part) {
  double from = s[0].signal, way = s[0].setpoint - from, level = from + part * way;
  for (size_t k = 0; k + 1 < count; k++)
    if ((s[k + 1].signal - level) * way >= 0) return crossing(s + k, level);
  return NAN;
}

static double overshoot(const ZpResponseSample *s, size_t count) {
  double way = s[0].setpoint - s[0].signal, most = 0;
  for (size_t k = 0; k < count; k++)
    most = fmax(most, (s[k].signal - s[k].setpoint) / way);
  return most;
}

/* From sample 0 on. */
static double settling_time(const ZpResponseSample *s, size_t count) {
  static const double band = 0.02;
  double most = band * fabs(s[0].setpoint - s[0].signal);
  size_t k = count;
  while (k > 0 && fabs(s[k - 1].signal - s[k - 1].setpoint) <= most)
    k--;
  if (k == count) return NAN;
  if (k == 0) return 0;
  double side = copysign(most, s[k - 1].signal - s[k - 1].setpoint);
  return crossing(s + k - 1, s[k].setpoint + side) - s[0].time;
}

/* Mean and standard deviation of the error in the last tenth. */
static void rate_end(const ZpResponseSample *s, size_t count, ZpResponse *response) {
  static const double part = 0.9;
  double from = s[0].time + part * (s[count - 1].time - s[0].time), sum = 0, squares = 0;
  size_t first = count;
  for (; first > 0 && s[first - 1].time >= from; first--)
    sum += s[first - 1].setpoint - s[first - 1].signal;
  double mean = sum / (double)(count - first);
  for (size_t k = first; k < count; k++)
    squares += (s[k].setpoint - s[k].signal - mean) * (s[k].setpoint - s[k].signal - mean);
  response->error = mean;
  response->ripple = sqrt(squares / (double)(count - first));
}

ZpResponse zp_response_of(const ZpResponseSample *sample, size_t count) {
  ZpResponse response = {NAN, NAN, NAN, NAN, NAN};
  if (count < 2) return response;
  size_t at = last_change(sample, count), left = count - at;
  const ZpResponseSample *s = sample + at;
  if (left < 2) return response;
  rate_end(s, left, &response);
  if (!is_step(sample, at) || s[0].setpoint == s[0].signal) return response;
  response.rise_time = reached_at(s, left, 0.9) - reached_at(s, left, 0.1);
  response.overshoot = overshoot(s, left);
  response.settling_time = settling_time(s, left);
  return response;
}
