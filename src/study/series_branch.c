/* Equilibria of actuators in series: all members at rest as the voltage rises slowly to drive.voltage and falls again.
 * Their limit voltages are those of each alone, eq. (29.1); the table shows all of them together. */
#include <math.h>
#include <stdio.h>

#include "base/fail.h"
#include "rest/chain.h"
#include "rest/closing.h"
#include "study/notes.h"
#include "study/series.h"

static const ZpColumn columns[] = {
    {"voltage_V", "V", "voltage between the electrodes"},
    {"stroke_m", "m", "sum of the members' strokes, signed"},
    {"opening_m", "m", "sum of the members' openings"},
    {"zipped_length_m", "m", "sum of the members' closed lengths, of one half"},
    {"charge_C", "C", "charge on all electrodes"},
    {"capacitance_F", "F", "capacitance of all electrodes"},
    {"stable", "1", "1: stable"},
    {"branch", "1", "0: as the voltage rises from 0, 1: as it falls from drive.voltage"},
    ZP_MARGIN_COLUMNS,
    {"closed_members", "1", "number of closed members"},
};
enum { COLUMNS = sizeof columns / sizeof columns[0], LEVELS = 100, MOST = LEVELS + 1 + 2 * ZP_MOST_MEMBERS };

typedef struct Walk {
  const ZpTask *task;
  ZpResult *result;
  ZpChain chain;
  ZpManyShapes shapes;
  double hanging[ZP_MOST_MEMBERS]; /* openings without voltage, m */
  double level[MOST];              /* voltages on the way, V, */
  size_t levels;                   /* rising */
  size_t rows;
  double lost; /* where a state was lost, V; NAN: nowhere */
  void *memory;
} Walk;

static bool allocate(Walk *w) {
  const ZpModel *first = w->chain.alone[0];
  ZpCarver carver = {NULL, 0};
  zp_many_carve(&w->shapes, w->chain.count, first->count, first->nodes, &carver);
  w->memory = zp_calloc(1, carver.used);
  carver = (ZpCarver){w->memory, 0};
  zp_many_carve(&w->shapes, w->chain.count, first->count, first->nodes, &carver);
  return w->memory != NULL;
}

/* -- voltages on the way ------------------------------------------------------------------------------ */

static void insert(Walk *w, double voltage) {
  size_t k = w->levels++;
  for (; k > 0 && w->level[k - 1] > voltage; k--)
    w->level[k] = w->level[k - 1];
  w->level[k] = voltage;
}

/* Even steps, and both sides of each voltage at which a member jumps. */
static void choose(Walk *w, const ZpMembers *members, const char *limit) {
  static const double near = 1e-4;
  double top = w->task->def->drive.voltage;
  w->levels = 0;
  for (int k = 0; k <= LEVELS; k++)
    insert(w, top * k / LEVELS);
  for (size_t k = 0; k < members->count; k++) {
    double voltage = zp_result_get(members->of[k], limit);
    if (isnan(voltage) || (1 + near) * voltage >= top) continue;
    insert(w, (1 - near) * voltage);
    insert(w, (1 + near) * voltage);
  }
}

/* -- the way ------------------------------------------------------------------------------------------ */

/* One row's sums and largest values so far, with those of a member. */
static void add_member(Walk *w, size_t k, double *row, ZpShape *shape) {
  ZpRest *rest = &w->chain.of[k];
  ZpStatics *s = &rest->statics;
  ZpMargins margins;
  ZpShape one = zp_rest_shape(rest, (double)w->rows, &margins);
  const double sums[] = {zp_statics_stroke(s), zp_statics_opening(s), (double)zp_statics_front(s) * s->member->model->l,
                         zp_statics_charge(s), zp_statics_capacitance(s)};
  for (size_t c = 0; c < sizeof sums / sizeof sums[0]; c++)
    row[1 + c] += sums[c];
  row[8] = fmax(row[8], margins.insulator);
  row[9] = fmax(row[9], margins.stress);
  row[10] += zp_closing_gap(s, NULL) <= zp_closed_opening(s->member->model, w->hanging[k]);
  zp_many_put(&w->shapes, k, &one);
  zp_many_hang(&w->shapes, k, s->member->model->s);
  if (k == 0) *shape = one;
}

static void record(Walk *w, double voltage, double branch) {
  double row[COLUMNS] = {voltage, 0, 0, 0, 0, 0, 1, branch, NAN, NAN, 0};
  ZpShape shape = {0};
  for (size_t k = 0; k < w->chain.count; k++)
    add_member(w, k, row, &shape);
  zp_many_give(&w->shapes, &shape);
  w->rows++;
  zp_table_offer(w->result->series, row);
  zp_shapes_offer(w->result->shapes, &shape);
}

static bool go_to(Walk *w, double voltage, double branch) {
  if (!zp_chain_change(&w->chain, voltage)) {
    w->lost = voltage;
    return false;
  }
  record(w, voltage, branch);
  return !zp_chain_stopped(&w->chain);
}

static void walk(Walk *w, const ZpMembers *members) {
  bool goes_on = zp_chain_hang(&w->chain);
  for (size_t k = 0; k < w->chain.count; k++)
    w->hanging[k] = zp_closing_gap(&w->chain.of[k].statics, NULL);
  choose(w, members, "closing_voltage_V");
  for (size_t k = 0; k < w->levels && goes_on; k++)
    goes_on = go_to(w, w->level[k], 0);
  choose(w, members, "release_voltage_V");
  for (size_t k = w->levels; k-- > 0 && goes_on;)
    goes_on = go_to(w, w->level[k], 1);
}

static bool asked_to_stop(void *task) {
  return zp_task_stops(task, "following", 0.5);
}

/* -- the study ---------------------------------------------------------------------------------------- */

static void describe(const Walk *w, const ZpMembers *members) {
  ZpResult *r = w->result;
  if (zp_chain_stopped(&w->chain)) r->outcome = ZP_INTERRUPTED;
  if (!zp_outcome_good(r->outcome)) return;
  *r->message = 0;
  zp_members_say(members, "pull in", "pull_in_voltage_V", r->message, sizeof r->message);
  zp_members_say(members, "close", "closing_voltage_V", r->message, sizeof r->message);
  zp_members_say(members, "release", "release_voltage_V", r->message, sizeof r->message);
  if (isnan(w->lost)) return;
  r->outcome = ZP_BRANCH_LOST;
  zp_result_note(r, "the solver lost the state at %.4g V: the table ends there", w->lost);
}

ZpStatus zp_members_follow(const ZpTask *task, const ZpMembers *members, ZpResult *result, ZpError *err) {
  ZpModel *model;
  ZpStatus status = zp_model_create(task->def, &model, err);
  if (status != ZP_OK) return status;
  Walk *w = zp_calloc(1, sizeof *w);
  status = w ? zp_chain_open(&w->chain, model, err) : zp_fail_memory(err);
  result->series = zp_table_create(columns, COLUMNS, (size_t)task->def->output.samples);
  result->shapes = zp_shapes_create(model->s, members->count * model->nodes, (size_t)task->def->output.shapes);
  if (status == ZP_OK && (!result->series || !result->shapes || !allocate(w))) status = zp_fail_memory(err);
  if (status == ZP_OK) {
    w->task = task;
    w->result = result;
    w->lost = NAN;
    result->shapes->members = members->count;
    zp_chain_watch(&w->chain, asked_to_stop, (void *)task);
    walk(w, members);
    describe(w, members);
  }
  if (w) zp_chain_close(&w->chain);
  if (w) zp_free(w->memory);
  zp_free(w);
  zp_model_destroy(model);
  return status;
}
