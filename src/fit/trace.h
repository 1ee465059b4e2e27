/* A run of a record: signals at each of its steps with their derivatives by the fitted keys, and their values at any
 * time by interpolation. So frames of a camera do not shorten the steps, and a shift of time changes them smoothly. */
#ifndef ZP_FIT_TRACE_H
#define ZP_FIT_TRACE_H

#include "fit/fit.h"

typedef struct ZpTrace {
  size_t signals, keys;
  double closing; /* sign of a change of the stroke as the actuator closes */
  const char *signal[ZP_FIT_KINDS]; /* [signals] names of signals */
  size_t rows, room, width;
  double *row; /* [rows][width] time, s; of each signal its value and its derivatives by the keys, over z */
} ZpTrace;

/* Values of a signal at a time: itself, its rate and its derivatives by the keys. NAN where the run has not come. */
typedef struct ZpTraceValue {
  double value, rate, by_key[ZP_FIT_KEYS];
} ZpTraceValue;

/* Run a record until `end`, s, with the fitted keys at z; with_rates: also derivatives, which are NAN where there are
 * none. A run that fails has the rows until then. False: no memory, with fit->status. To be closed in any case. */
bool zp_trace_open(ZpFit *fit, const ZpFitRun *run, const double *z, double end, bool with_rates, ZpTrace *trace);
void zp_trace_close(ZpTrace *trace);

/* The place of a signal among those of a trace that is to be opened: added if it has none yet. */
size_t zp_trace_signal(ZpTrace *trace, const char *name);

/* At a time of the run, s; before its start as there. */
ZpTraceValue zp_trace_at(const ZpTrace *trace, size_t signal, double time);

#endif
