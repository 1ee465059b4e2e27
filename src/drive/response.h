/* How a signal has answered a step of its setpoint, on the samples of a run. docs/theory.md, section 28. */
#ifndef ZP_DRIVE_RESPONSE_H
#define ZP_DRIVE_RESPONSE_H

#include <stddef.h>

/* One sample. */
typedef struct ZpResponseSample {
  double time, setpoint, signal; /* s, and the unit of the signal */
} ZpResponseSample;

/* To the last step of the setpoint; NAN where there is none. */
typedef struct ZpResponse {
  double rise_time;     /* from 10 to 90 % of the way, s; NAN if it never gets there */
  double overshoot;     /* largest part of the way that it goes too far, 0 or more */
  double settling_time; /* from the step until it stays within 2 % of the way, s; NAN if it does not */
  double error;         /* setpoint less signal, mean of the last tenth of the time since the setpoint changed */
  double ripple;        /* standard deviation of that error there: what is held has little */
} ZpResponse;

/* `sample` [count], in the order of time. A setpoint that has changed gradually has no step, only an error. */
ZpResponse zp_response_of(const ZpResponseSample *sample, size_t count);

#endif
