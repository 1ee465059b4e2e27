#include <zipact/trace.h>

#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "run/sensitivity.h"

struct ZpTrace {
  size_t signals, keys;
  const char *signal[ZP_TRACE_SIGNALS];
  size_t rows, room, width;
  double *row; /* [rows][width] time, s; of each signal its value and its derivatives by the keys */
};

/* -- recording ------------------------------------------------------------------------------------- */

/* A trace under way; `failed`: no memory. */
typedef struct Recording {
  ZpTrace *trace;
  const ZpRunSensitivity *rates; /* NULL: none */
  bool failed;
} Recording;

static double signal_of(ZpSim *sim, const void *name) {
  return zp_sim_get(sim, name);
}

static bool make_room(ZpTrace *trace) {
  const size_t room = trace->room > 0 ? 2 * trace->room : 1024;
  double *row = trace->rows < trace->room ? trace->row : zp_calloc(room * trace->width, sizeof *row);
  if (!row || row == trace->row) return row;
  if (trace->rows > 0) memcpy(row, trace->row, trace->rows * trace->width * sizeof *row);
  zp_free(trace->row);
  trace->row = row;
  trace->room = room;
  return true;
}

static void take_row(ZpSim *sim, void *user) {
  Recording *r = user;
  ZpTrace *trace = r->trace;
  r->failed = r->failed || !make_room(trace);
  if (r->failed) return;
  double *row = trace->row + trace->rows++ * trace->width;
  *row++ = sim->state->t;
  for (size_t s = 0; s < trace->signals; s++) {
    *row++ = zp_sim_get(sim, trace->signal[s]);
    for (size_t k = 0; k < trace->keys; k++)
      *row++ =
          r->rates && isinf(r->rates->key[k].lost) ? zp_run_rate_of(r->rates, k, signal_of, trace->signal[s]) : NAN;
  }
}

static ZpStatus record(ZpSim *sim, const int *key, double end, const ZpHooks *hooks, ZpTrace *trace, ZpError *err) {
  ZpRunSensitivity rates = {.sim = sim};
  ZpStatus status = ZP_OK;
  if (trace->keys > 0) status = zp_run_sensitivity_open(&rates, sim, key, trace->keys, NULL);
  Recording recording = {.trace = trace, .rates = trace->keys > 0 && status == ZP_OK ? &rates : NULL};
  sim->stepped = take_row;
  sim->stepped_user = &recording;
  if (status != ZP_MACHINE) {
    take_row(sim, &recording);
    zp_sim_run(sim, end, false, hooks, NULL);
  }
  sim->stepped = NULL;
  sim->stepped_user = NULL;
  if (trace->keys > 0) zp_run_sensitivity_close(&rates);
  return recording.failed || status == ZP_MACHINE ? zp_fail_memory(err) : ZP_OK;
}

static ZpStatus check(const char *const *signal, size_t signals, size_t keys, double end, ZpError *err) {
  if (signals == 0 || signals > ZP_TRACE_SIGNALS || keys > ZP_TRACE_KEYS || !(end > 0))
    return zp_fail(err, ZP_BAD_INPUT, "a trace has 1 to %d signals, at most %d keys, and ends after 0 s",
                   ZP_TRACE_SIGNALS, ZP_TRACE_KEYS);
  for (size_t s = 0; s < signals; s++)
    if (zp_signal_find(signal[s]) < 0) return zp_fail(err, ZP_BAD_INPUT, "%.60s: no such signal", signal[s]);
  return ZP_OK;
}

ZpStatus zp_trace_create(const ZpModel *model, const char *const *signal, size_t signals, const int *key, size_t keys,
                         double end, const ZpHooks *hooks, ZpTrace **out, ZpError *err) {
  ZpSim *sim = NULL;
  *out = NULL;
  ZpStatus status = check(signal, signals, keys, end, err);
  ZpTrace *trace = status == ZP_OK ? zp_calloc(1, sizeof *trace) : NULL;
  if (status == ZP_OK && !trace) status = zp_fail_memory(err);
  if (status == ZP_OK) {
    *trace = (ZpTrace){.signals = signals, .keys = keys, .width = 1 + signals * (1 + keys)};
    for (size_t s = 0; s < signals; s++)
      trace->signal[s] = zp_signal_name((size_t)zp_signal_find(signal[s]));
    status = zp_sim_create(model, NULL, &sim, err);
  }
  if (status == ZP_OK) status = record(sim, key, end, hooks, trace, err);
  zp_sim_destroy(sim);
  if (status == ZP_OK)
    *out = trace;
  else
    zp_trace_destroy(trace);
  return status;
}

void zp_trace_destroy(ZpTrace *trace) {
  if (!trace) return;
  zp_free(trace->row);
  zp_free(trace);
}

/* -- interpolation ---------------------------------------------------------------------------------- */

/* The last row at or before a time that is within the run. */
static size_t row_before(const ZpTrace *trace, double time) {
  size_t low = 0, high = trace->rows - 1;
  while (high - low > 1) {
    const size_t middle = (low + high) / 2;
    if (trace->row[middle * trace->width] <= time)
      low = middle;
    else
      high = middle;
  }
  return low;
}

/* Cubic between two rows, whose rates are those of parabolas through the neighbours: weights of up to four rows, from
 * `first` on, of a value and of its rate. */
typedef struct Weights {
  size_t first, count;
  double value[4], rate[4];
} Weights;

static double time_of(const ZpTrace *trace, size_t row) {
  return trace->row[row * trace->width];
}

/* Add `factor` times the rate at row i of a parabola through its neighbours, at an end of a line. */
static void add_rate(const ZpTrace *trace, size_t i, size_t first, double factor, double *weight) {
  const bool start = i == 0, end = i + 1 == trace->rows;
  const size_t left = start ? i : i - 1, right = end ? i : i + 1;
  const double t0 = time_of(trace, left), t1 = time_of(trace, i), t2 = time_of(trace, right);
  if (start || end || !(t1 > t0) || !(t2 > t1)) {
    const double span = t2 - t0;
    if (!(span > 0)) return;
    weight[left - first] -= factor / span;
    weight[right - first] += factor / span;
    return;
  }
  weight[left - first] -= factor * (t2 - t1) / ((t1 - t0) * (t2 - t0));
  weight[i - first] += factor * ((t2 - t1) / (t1 - t0) - (t1 - t0) / (t2 - t1)) / (t2 - t0);
  weight[right - first] += factor * (t1 - t0) / ((t2 - t1) * (t2 - t0));
}

static Weights weights_at(const ZpTrace *trace, double time) {
  Weights w = {0};
  const size_t i = row_before(trace, time);
  const double t0 = time_of(trace, i), h = time_of(trace, i + 1) - t0, s = h > 0 ? (time - t0) / h : 1;
  w.first = i > 0 ? i - 1 : 0;
  w.count = (i + 2 < trace->rows ? i + 3 : i + 2) - w.first;
  w.value[i - w.first] += (1 + 2 * s) * (1 - s) * (1 - s);
  w.value[i + 1 - w.first] += s * s * (3 - 2 * s);
  add_rate(trace, i, w.first, h * s * (1 - s) * (1 - s), w.value);
  add_rate(trace, i + 1, w.first, -h * s * s * (1 - s), w.value);
  if (!(h > 0)) return w;
  w.rate[i - w.first] -= 6 * s * (1 - s) / h;
  w.rate[i + 1 - w.first] += 6 * s * (1 - s) / h;
  add_rate(trace, i, w.first, (1 - s) * (1 - 3 * s), w.rate);
  add_rate(trace, i + 1, w.first, s * (3 * s - 2), w.rate);
  return w;
}

static const double *column_of(const ZpTrace *trace, size_t row, size_t signal) {
  return trace->row + row * trace->width + 1 + signal * (1 + trace->keys);
}

static void add(const ZpTrace *trace, size_t signal, size_t row, double value, double rate, ZpTraceValue *sum) {
  const double *from = column_of(trace, row, signal);
  sum->value += value * from[0];
  sum->rate += rate * from[0];
  for (size_t k = 0; k < trace->keys; k++)
    sum->by_key[k] += value * from[1 + k];
}

ZpTraceValue zp_trace_at(const ZpTrace *trace, size_t signal, double time) {
  ZpTraceValue at = {0};
  const double last = trace->rows > 0 ? time_of(trace, trace->rows - 1) : -1;
  if (trace->rows > 0 && time <= time_of(trace, 0)) {
    add(trace, signal, 0, 1, 0, &at);
    return at;
  }
  if (trace->rows < 2 || time > last * (1 + 1e-12)) return (ZpTraceValue){.value = NAN, .rate = NAN};
  const Weights w = weights_at(trace, fmin(time, last));
  for (size_t i = 0; i < w.count; i++)
    add(trace, signal, w.first + i, w.value[i], w.rate[i], &at);
  return at;
}
