#include "fit/trace.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "run/sensitivity.h"

/* -- recording ------------------------------------------------------------------------------------- */

/* A trace under way; `failed`: no memory. */
typedef struct Recording {
  ZpTrace *trace;
  const ZpFit *fit;
  const ZpRunSensitivity *rates; /* NULL: none */
  bool failed;
} Recording;

static double signal_of(ZpSim *sim, const void *name) {
  return zp_sim_get(sim, name);
}

static double *next_row(Recording *r) {
  ZpTrace *trace = r->trace;
  if (trace->rows == trace->room) {
    const size_t room = trace->room > 0 ? 2 * trace->room : 1024;
    double *row = realloc(trace->row, room * trace->width * sizeof *row);
    r->failed |= !row;
    if (!row) return NULL;
    trace->row = row;
    trace->room = room;
  }
  return trace->row + trace->rows++ * trace->width;
}

static void take_row(ZpSim *sim, void *user) {
  Recording *r = user;
  const ZpTrace *trace = r->trace;
  double *row = r->failed ? NULL : next_row(r);
  if (!row) return;
  *row++ = sim->state->t;
  for (size_t s = 0; s < trace->signals; s++) {
    *row++ = zp_sim_get(sim, trace->signal[s]);
    for (size_t k = 0; k < trace->keys; k++)
      *row++ = r->rates ? r->fit->start[k] * zp_run_rate_of(r->rates, k, signal_of, trace->signal[s]) : NAN;
  }
}

static void run(ZpFit *fit, ZpSim *sim, double end, bool with_rates, ZpTrace *trace) {
  ZpRunSensitivity rates;
  ZpStatus status = ZP_OK;
  if (with_rates) status = zp_run_sensitivity_open(&rates, sim, fit->key, (size_t)fit->keys, NULL);
  Recording recording = {.trace = trace, .fit = fit, .rates = with_rates && status == ZP_OK ? &rates : NULL};
  sim->stepped = take_row;
  sim->stepped_user = &recording;
  if (status != ZP_MACHINE) {
    take_row(sim, &recording);
    zp_sim_run(sim, end, false, fit->hooks, NULL);
  }
  sim->stepped = NULL;
  sim->stepped_user = NULL;
  if (with_rates) zp_run_sensitivity_close(&rates);
  if (recording.failed || status == ZP_MACHINE) fit->status = zp_fail_memory(fit->err);
}

bool zp_trace_open(ZpFit *fit, const ZpFitRun *record, const double *z, double end, bool with_rates, ZpTrace *trace) {
  ZpActuatorDef def;
  ZpModel *model = NULL;
  ZpSim *sim = NULL;
  const ZpDriveTable table = {record->rows, record->time, record->voltage};
  trace->keys = (size_t)fit->keys;
  trace->width = 1 + trace->signals * (1 + trace->keys);
  ZpStatus status = zp_fit_run_def(fit, record, z, &def) ? ZP_OK : ZP_BAD_INPUT;
  def.solver.end_time = fmax(end, 1e-9);
  if (status == ZP_OK) status = zp_model_create_driven(&def, record->rows > 0 ? &table : NULL, &model, NULL);
  if (status == ZP_OK) trace->closing = zp_fit_closing(model);
  if (status == ZP_OK) status = zp_sim_create(model, NULL, &sim, NULL);
  if (status == ZP_MACHINE) fit->status = zp_fail_memory(fit->err);
  if (status == ZP_OK) run(fit, sim, def.solver.end_time, with_rates && trace->keys > 0, trace);
  zp_sim_destroy(sim);
  zp_model_destroy(model);
  return fit->status == ZP_OK;
}

void zp_trace_close(ZpTrace *trace) {
  free(trace->row);
  *trace = (ZpTrace){0};
}

size_t zp_trace_signal(ZpTrace *trace, const char *name) {
  size_t place = 0;
  while (place < trace->signals && strcmp(trace->signal[place], name) != 0)
    place++;
  if (place == trace->signals) trace->signal[trace->signals++] = name;
  return place;
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
