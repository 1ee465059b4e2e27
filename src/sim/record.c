/* State => one row of signals.def, one shape; and the rhythm in which they are offered to the records. */
#include <math.h>
#include <string.h>

#include "sim/sim_internal.h"

/* Places of the signals in a row. */
#define ZP_SIGNAL(name, unit, suffix, help) SIGNAL_##name,
enum {
#include <zipact/signals.def>
  SIGNAL_COUNT
};
#undef ZP_SIGNAL

#define ZP_SIGNAL(name, unit, suffix, help) {#name suffix, unit, help},
static const ZpColumn columns[] = {
#include <zipact/signals.def>
};
#undef ZP_SIGNAL

#define ZP_SIGNAL(name, unit, suffix, help) #name,
static const char *const names[] = {
#include <zipact/signals.def>
};
#undef ZP_SIGNAL

const ZpColumn *zp_signal_columns(size_t *count) {
  *count = SIGNAL_COUNT;
  return columns;
}

double zp_energy_without_field(const ZpEnergies *e) {
  return e->kinetic + e->axial + e->bending + e->gravity;
}

/* Lengths: of the lower ribbon and between the platforms, or of the one ribbon. */
static void fill_geometry(const ZpSim *sim, double *row) {
  const ZpModel *model = sim->model;
  const ZpState *state = sim->state;
  ZpMotion motion = zp_state_motion(model, state);
  const double *y = motion.y;
  size_t s = model->s, end = model->count - 1;
  row[SIGNAL_stroke] = y[s - 1] - y[end];
  row[SIGNAL_end_velocity] = motion.vy[end];
  row[SIGNAL_zipped_length] = (double)state->zip.front * model->l;
  row[SIGNAL_opening] = s == 2 ? y[end - 1] - y[end] : NAN;
  row[SIGNAL_contraction] = state->opening0 > 0 ? 1 - row[SIGNAL_opening] / state->opening0 : NAN;
}

void zp_sim_fill_row(ZpSim *sim) {
  const ZpModel *model = sim->model;
  const ZpState *state = sim->state;
  double *row = sim->row, parts = model->parts;
  ZpEnergies e = zp_eval_energies(model, state, &sim->eval);
  double work = state->work + state->U * (e.charge - state->base_charge);
  double stored = zp_energy_without_field(&e) - state->base_energy;
  double field = e.field - state->base_field;
  double current = (e.charge - sim->row_charge) / (state->t - sim->row_time);
  fill_geometry(sim, row);
  row[SIGNAL_time] = state->t;
  row[SIGNAL_voltage] = state->U;
  row[SIGNAL_force] = parts * e.force;
  row[SIGNAL_charge] = parts * e.charge;
  row[SIGNAL_capacitance] = parts * e.capacitance;
  row[SIGNAL_current] = state->t > sim->row_time ? parts * current : 0;
  row[SIGNAL_electric_work] = parts * work;
  row[SIGNAL_kinetic_energy] = parts * e.kinetic;
  row[SIGNAL_axial_energy] = parts * e.axial;
  row[SIGNAL_bending_energy] = parts * e.bending;
  row[SIGNAL_gravity_energy] = parts * e.gravity;
  row[SIGNAL_field_energy] = parts * e.field;
  row[SIGNAL_drag_loss] = parts * state->drag_loss;
  row[SIGNAL_internal_loss] = parts * state->internal_loss;
  row[SIGNAL_contact_loss] = parts * state->contact_loss;
  row[SIGNAL_energy_imbalance] =
      parts * (work - field - stored - state->drag_loss - state->internal_loss - state->contact_loss);
  sim->row_time = state->t;
  sim->row_charge = e.charge;
}

double zp_sim_get(const ZpSim *sim, const char *name) {
  for (size_t k = 0; k < SIGNAL_COUNT; k++)
    if (strcmp(names[k], name) == 0) {
      ZpSim copy = *sim; /* shares the work space of eval, not the row's memory of time and charge */
      zp_sim_fill_row(&copy);
      return sim->row[k];
    }
  return NAN;
}

void zp_sim_read(ZpSim *sim, double *row) {
  zp_sim_fill_row(sim);
  memcpy(row, sim->row, SIGNAL_COUNT * sizeof *row);
}

ZpShape zp_sim_shape(const ZpSim *sim) {
  const ZpModel *model = sim->model;
  const ZpState *state = sim->state;
  ZpMotion motion = zp_state_motion(model, state);
  ZpShape shape = {.time = state->t, .voltage = state->U, .zipped = state->zip.front, .x = motion.x, .y = motion.y};
  if (!model->field) return shape;
  ZpPlatesEval plates = sim->eval.plates;
  zp_plates_gaps(&model->plates, shape.x, shape.y, &plates);
  for (size_t i = 0; i < model->nodes; i++)
    sim->line_force[i] = zp_plates_law(&model->plates, state->U, plates.gap[i]).W;
  shape.gap = plates.gap;
  shape.line_force = sim->line_force;
  return shape;
}

void zp_sim_offer_record(ZpSim *sim) {
  if (sim->series || sim->shapes) zp_sim_fill_row(sim);
  if (sim->series) zp_table_offer(sim->series, sim->row);
  if (!sim->shapes) return;
  ZpShape shape = zp_sim_shape(sim);
  zp_shapes_offer(sim->shapes, &shape);
}

void zp_sim_close_record(ZpSim *sim) {
  if (sim->series || sim->shapes) zp_sim_fill_row(sim);
  if (sim->series) zp_table_keep_last(sim->series, sim->row);
  if (!sim->shapes) return;
  ZpShape shape = zp_sim_shape(sim);
  zp_shapes_keep_last(sim->shapes, &shape);
}
