/* State => one row of signals.def, one shape; and the times at which they are offered to the records. */
#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "def/check.h"
#include "ribbon/rod_plastic.h"
#include "run/margins.h"
#include "run/run.h"
#include "term/curvature.h"

#define ZP_ROW(name) extern const ZpRow zp_row_##name;
#include "term/terms.def"
#undef ZP_ROW

/* Places of the signals in a row. */
#define ZP_SIGNAL(name, unit, suffix, help) SIGNAL_##name,
#define ZP_ROW(name)                        SIGNAL_##name,
enum {
#include "run/columns.def"
  SIGNAL_COUNT
};
#undef ZP_SIGNAL
#undef ZP_ROW

/* The row of the ledger that is a signal; NULL: it is none. */
#define ZP_SIGNAL(name, unit, suffix, help) NULL,
#define ZP_ROW(name)                        &zp_row_##name,
static const ZpRow *const row_of[] = {
#include "run/columns.def"
};
#undef ZP_SIGNAL
#undef ZP_ROW

/* The first row of a law that signals.def does not list. */
#define ZP_SIGNAL(name, unit, suffix, help) +1
#define ZP_ROW(name)                        +1
enum {
  SIGNAL_OF_LAWS = 0
#include "base/signals.def"
};
#undef ZP_SIGNAL
#undef ZP_ROW

#define ZP_SIGNAL(name, unit, suffix, help) {#name suffix, unit, help},
#define ZP_ROW(name)                        {zp_row_##name.column, zp_row_##name.unit, zp_row_##name.help},
static const ZpColumn columns[] = {
#include "run/columns.def"
};

/* Signals of a controller of a length, of one of a capacitance, and of one of an angle. */
#define ZP_CONTROLLED(name, help) ZP_SIGNAL(name, "m", "_m", help)
static const ZpColumn columns_of_length[] = {
#include "run/columns.def"
};
#define ZP_CONTROLLED(name, help) ZP_SIGNAL(name, "F", "_F", help)
static const ZpColumn columns_of_capacitance[] = {
#include "run/columns.def"
};
#define ZP_CONTROLLED(name, help) ZP_SIGNAL(name, "rad", "_rad", help)
static const ZpColumn columns_of_angle[] = {
#include "run/columns.def"
};
#undef ZP_SIGNAL
#undef ZP_ROW

/* Behind the signals of several members: of each its opening, or, side by side, where they have one, its force. */
static const ZpColumn of_series[] = {
    {"member_#_opening_m", "m", "distance between the platforms' faces of member # of a series"}};
static const ZpColumn of_parallel[] = {
    {"member_#_force_N", "N", "force with which member # of those side by side pulls the load up"},
    {"member_#_zipped_length_m", "m", "closed length of one half of member #"}};
enum { NUMBERS_PARALLEL = sizeof of_parallel / sizeof of_parallel[0] };

/* Of each member and each body of a network. */
static const ZpColumn of_member[] = {{"#.opening_m", "m", "distance between the platforms' faces of #"},
                                     {"#.zipped_length_m", "m", "closed length of one half of #"},
                                     {"#.voltage_V", "V", "voltage between the electrodes of #"}};
enum { NUMBERS_MEMBER = sizeof of_member / sizeof of_member[0] };

/* Of each port that has a meter, where members have ports or bodies: study actuate fills them after the run. */
static const ZpColumn of_meter[] = {
    {"#.sensed_capacitance_F", "F",
     "last reading of the capacitance meter on the port of #; empty before the first one"},
    {"#.sensed_stroke_m", "m", "stroke of # at rest that has this capacitance; empty where others are on its port"}};
static const ZpColumn of_meter_of_stack[] = {
    {"member_#_sensed_capacitance_F", "F",
     "last reading of the capacitance meter on the port of member #; empty before the first one"},
    {"member_#_sensed_stroke_m", "m",
     "stroke of member # at rest that has this capacitance; empty where others are on its port"}};
enum { NUMBERS_METER = sizeof of_meter / sizeof of_meter[0] };
enum { PARTS = 4 }; /* of the columns of a row */

static const char *metered_called(const void *def, size_t number, char text[ZP_NAME_SIZE]) {
  return zp_member_called(def, (size_t)zp_def_metered(def, (int)number), text);
}

static size_t meters_of(const ZpActuatorDef *def) {
  size_t count = 0;
  while (zp_def_metered(def, (int)count + 1) > 0)
    count++;
  return count;
}

#define ZP_SIGNAL(name, unit, suffix, help) #name,
#define ZP_ROW(name)                        #name,
static const char *const names[] = {
#include "run/columns.def"
};
#undef ZP_SIGNAL
#undef ZP_ROW

const char *zp_signal_name(size_t index) {
  return names[index];
}

const ZpColumn *zp_signal_columns(size_t *count) {
  *count = SIGNAL_COUNT;
  return columns;
}

const ZpColumn *zp_signal_columns_of(const ZpActuatorDef *def, size_t *count) {
  static const ZpColumn *const of[ZpControlSignal_COUNT] = {[ZP_CONTROL_OPENING] = columns_of_length,
                                                            [ZP_CONTROL_STROKE] = columns_of_length,
                                                            [ZP_CONTROL_CONTRACTION] = columns,
                                                            [ZP_CONTROL_CAPACITANCE] = columns_of_capacitance,
                                                            [ZP_CONTROL_ANGLE] = columns_of_angle};
  *count = 0;
  if (!def) return NULL;
  *count = SIGNAL_COUNT;
  return def->control.kind == ZP_CONTROL_NONE ? columns : of[def->control.signal];
}

/* Numbers of each of several members in a row. */
static size_t numbers_of_each(const ZpModel *first) {
  if (zp_is_network(first)) return NUMBERS_MEMBER;
  return first->members == 1 ? 0 : zp_abreast(first) > 1 ? NUMBERS_PARALLEL : 1;
}

/* The columns of a row: signals, then numbers of each member, of each body, of each meter => how many parts. */
static size_t parts_of(const ZpActuatorDef *def, ZpColumnPart part[PARTS]) {
  const size_t members = (size_t)zp_def_members(def), meters = meters_of(def);
  const bool network = zp_def_network(def), parallel = zp_def_parallel(def);
  size_t parts = 1, count;
  part[0] = (ZpColumnPart){.column = zp_signal_columns_of(def, &count)};
  part[0].count = count;
  if (network) {
    part[parts++] = (ZpColumnPart){of_member, NUMBERS_MEMBER, members, zp_member_called, def};
    const ZpColumn *of_body = zp_body_columns(zp_def_plane(def), &count);
    part[parts++] = (ZpColumnPart){of_body, count, (size_t)zp_instance_count(def, ZP_OF_BODY), zp_body_called, def};
  } else if (members > 1) {
    part[parts++] = (ZpColumnPart){
        .column = parallel ? of_parallel : of_series, .count = parallel ? NUMBERS_PARALLEL : 1, .members = members};
  }
  if (meters > 0)
    part[parts++] = (ZpColumnPart){network ? of_meter : of_meter_of_stack, NUMBERS_METER, meters, metered_called, def};
  return parts;
}

ZpTable *zp_signal_table(const ZpActuatorDef *def, size_t capacity) {
  ZpColumnPart part[PARTS];
  return def ? zp_table_of(part, parts_of(def, part), capacity) : NULL;
}

/* Is a column called `name`, without its unit? */
static bool is_called(const ZpColumn *column, const char *called, const char *name) {
  char text[ZP_KEY_NAME_SIZE + ZP_NAME_SIZE];
  const size_t length = strlen(name);
  zp_named(column->name, called, text);
  return strncmp(text, name, length) == 0 && text[length] == '_' && strcmp(text + length + 1, column->unit) == 0;
}

/* The column of a member or a body called "left.opening"; 0: there is none. */
static size_t column_beyond(const ZpActuatorDef *def, const char *name) {
  ZpColumnPart part[PARTS];
  const size_t parts = parts_of(def, part);
  size_t k = SIGNAL_COUNT;
  for (size_t p = 1; p < parts; p++)
    for (size_t of = 1; of <= part[p].members; of++) {
      char room[ZP_NAME_SIZE];
      const char *called = (part[p].name ? part[p].name : zp_member_called)(def, of, room);
      for (size_t c = 0; c < part[p].count; c++, k++)
        if (is_called(&part[p].column[c], called, name)) return k;
    }
  return 0;
}

/* Rows of the ledger that are no signals have their places behind all columns. */
static size_t columns_of(const ZpSim *sim) {
  const ZpModel *model = sim->model;
  const size_t bodies = zp_is_network(model) ? model->network->bodies - 1 : 0;
  size_t of_body;
  zp_body_columns(model->network->plane, &of_body);
  return SIGNAL_COUNT + sim->members * numbers_of_each(model) + of_body * bodies +
         NUMBERS_METER * meters_of(model->whole);
}

size_t zp_sim_row_size(const ZpSim *sim) {
  return columns_of(sim) + ZP_MOST_ROWS;
}

void zp_sim_place_rows(ZpSim *sim) {
  const ZpLedger *ledger = &sim->model->ledger;
  for (size_t k = 0; k < ledger->rows; k++) {
    size_t signal = 0;
    while (signal < SIGNAL_COUNT && row_of[signal] != ledger->row[k])
      signal++;
    sim->row_at[k] = signal < SIGNAL_COUNT ? signal : columns_of(sim) + k;
  }
  for (size_t k = NUMBERS_METER * meters_of(sim->model->whole); sim->row && k > 0; k--)
    sim->row[columns_of(sim) - k] = NAN;
}

/* Does any law of these members have the row? */
static bool has_row(const ZpModel *first, const ZpRow *row) {
  for (const ZpModel *model = first; model < first + first->members; model++)
    for (size_t law = 0; law < model->laws; law++)
      for (size_t k = 0; k < model->law[law].rows; k++)
        if (model->ledger.row[model->law[law].row[k]] == row) return true;
  return false;
}

bool zp_sim_next_row(const ZpSim *sim, size_t *signal) {
  size_t k = *signal < SIGNAL_OF_LAWS ? SIGNAL_OF_LAWS : *signal + 1;
  while (k < SIGNAL_COUNT && !has_row(sim->model, row_of[k]))
    k++;
  *signal = k;
  return k < SIGNAL_COUNT;
}

const char *zp_control_unit(const ZpActuatorDef *def) {
  size_t count;
  return def ? zp_signal_columns_of(def, &count)[SIGNAL_setpoint].unit : NULL;
}

const ZpColumn *zp_trace_columns(size_t *count) {
  static const ZpColumn trace[ZP_TRACE_COLUMNS] = {{"time_s", "s", "time since the start"},
                                                   {"voltage_V", "V", "voltage between the electrodes"},
                                                   {"charge_C", "C", "charge given to electrodes and insulators"},
                                                   {"capacitance_F", "F", "capacitance of the electrodes"},
                                                   {"stroke_m", "m", "stroke"}};
  *count = ZP_TRACE_COLUMNS;
  return trace;
}

/* Number of closed stations from the clip on: their faces touch, or their film is thinner than the liquid equivalent to
 * the insulators. */
static size_t front(const ZpModel *model, const ZpState *state) {
  const double *y = zp_state_motion(model, state).y;
  size_t i = 0;
  if (!model->has_film) return state->zip.front;
  while (i < model->topology.platform.first && zp_plates_gap(&model->plates, y, i + 1) < zp_closed_film(model))
    i++;
  return i;
}

/* At a quarter of the flexible length of a half, m. */
static double film_thickness(const ZpModel *model, const ZpState *state) {
  const double *y = zp_state_motion(model, state).y;
  if (!model->has_film) return 0;
  size_t elements = zp_half_elements(&model->topology), i = elements / 4;
  double beyond = 0.25 * (double)(elements % 4);
  if (model->has_bead && state->bead[0].reach < 0.25 * model->L) return 0;
  double here = zp_film_thickness(&model->film, zp_plates_gap(&model->plates, y, i)),
         next = zp_film_thickness(&model->film, zp_plates_gap(&model->plates, y, i + 1));
  return here + beyond * (next - here);
}

/* Of one half, m. */
static double wet_length(const ZpModel *model, const ZpState *state) {
  if (model->has_bead) return state->bead[0].reach;
  return model->has_film ? zp_bead_longest(&model->film) : 0;
}

/* Lengths: of the lower ribbon and between the platforms, or of the one ribbon. */
static void fill_geometry(const ZpSim *sim, double *row) {
  const ZpModel *model = sim->model;
  const ZpState *state = sim->state;
  ZpMotion motion = zp_state_motion(model, state);
  const ZpTopology *t = &model->topology;
  row[SIGNAL_stroke] = zp_stroke(model, (ZpNodes){motion.x, motion.y});
  row[SIGNAL_end_velocity] =
      t->along ? zp_stroke_change(model, (ZpNodes){motion.vx, motion.vy}) : zp_platform_middle(t, motion.vy);
  row[SIGNAL_zipped_length] = (double)front(model, state) * model->l;
  row[SIGNAL_film_thickness] = film_thickness(model, state);
  row[SIGNAL_wet_length] = wet_length(model, state);
  row[SIGNAL_opening] = zp_opening(t, motion.y);
  row[SIGNAL_angle] = zp_topology_angle(t, motion.x, motion.y);
  row[SIGNAL_contraction] = model->pouch.w > 0 ? row[SIGNAL_zipped_length] / model->pouch.electrode
                            : state->opening0 > model->faces.stop
                                ? zp_contraction(model, zp_last_gap(model, motion.y), state->opening0)
                                : NAN;
}

/* Signals that follow from the state alone, of one member of a series alone as of all below. */
static void fill_state(const ZpSim *sim, double *row) {
  const ZpState *state = sim->state;
  double parts = sim->model->parts;
  fill_geometry(sim, row);
  row[SIGNAL_time] = state->t;
  row[SIGNAL_voltage] = state->U;
  row[SIGNAL_command] = zp_sim_is_fed(sim) ? zp_sim_command(sim) : state->U;
  row[SIGNAL_source_voltage] = zp_sim_is_fed(sim) ? state->supply.voltage : state->U;
  row[SIGNAL_cable_energy] = zp_sim_has_supply(sim) ? zp_supply_coupling_cable_energy(sim, state->U) : 0;
  row[SIGNAL_setpoint] = zp_sim_setpoint(sim);
  row[SIGNAL_measured] = sim->model->control.kind == ZP_CONTROL_NONE ? 0 : state->control.measured;
  row[SIGNAL_load_work] = parts * state->load_work;
}

/* Values of all rows => their places. */
static void fill_books(const ZpSim *sim, double *now, double *row) {
  const ZpModel *model = sim->model;
  double viscous =
      *zp_ledger_at(model, now, &zp_row_film_along_loss) + *zp_ledger_at(model, now, &zp_row_film_across_loss);
  for (size_t k = 0; k < model->ledger.rows; k++) {
    ZpRowKind kind = model->ledger.row[k]->kind;
    row[sim->row_at[k]] = (kind == ZP_ROW_SOURCE || kind == ZP_ROW_SIGNAL ? 1 : model->parts) * now[k];
  }
  row[SIGNAL_viscous_loss] = model->parts * viscous;
  row[SIGNAL_energy_imbalance] = row[SIGNAL_electric_work] + row[SIGNAL_load_work] -
                                 model->parts * zp_system_taken(model, zp_state_ledger(model, sim->state), now);
}

/* Current through the insulators, and the charge on their faces. */
static void fill_leak(ZpSim *sim, double *row) {
  const ZpModel *model = sim->model;
  ZpLeakNow now = zp_sim_leak(sim);
  row[SIGNAL_leak_current] = model->parts * now.current;
  row[SIGNAL_interface_voltage] = now.mean;
}

/* Also the rows that the account of the source fills. */
static void fill_electric(ZpSim *sim, double *now, double *row) {
  const ZpState *state = sim->state;
  ZpElectric e = zp_system_electric_now(sim->model, state, state->U, &sim->eval);
  ZpBalance account = zp_sim_energy_balance(sim, e);
  bool fed = zp_sim_is_fed(sim);
  double parts = sim->model->parts, passed = state->t - sim->row_time;
  double taken = e.charge + state->leaked;
  double given = sim->own_charge =
      fed ? state->source_charge / parts + (1 - zp_part_of_port(sim->model)) * taken : taken;
  fill_leak(sim, row);
  row[SIGNAL_force] = parts * e.force;
  row[SIGNAL_charge] = parts * e.charge;
  row[SIGNAL_capacitance] = parts * e.capacitance;
  sim->negative |= e.capacitance < 0;
  row[SIGNAL_current] = passed > 0 ? parts * ((given - sim->row_charge) / passed) : 0;
  row[SIGNAL_electric_work] = parts * account.work;
  row[SIGNAL_source_energy] = sim->own_energy = fed ? state->source_energy : row[SIGNAL_electric_work];
  row[SIGNAL_power] = passed > 0 ? (row[SIGNAL_source_energy] - sim->row_energy) / passed : 0;
  *zp_ledger_at(sim->model, now, &zp_row_charging_loss) = account.charging_loss;
  *zp_ledger_at(sim->model, now, &zp_row_field_energy) = zp_field_energy(e, state->U);
}

/* Of one member. */
static ZpShape shape_of(ZpSim *sim) {
  const ZpModel *model = sim->model;
  const ZpState *state = sim->state;
  ZpMotion motion = zp_state_motion(model, state);
  ZpShape shape = {.time = state->t, .voltage = state->U, .zipped = state->zip.front, .x = motion.x, .y = motion.y};
  if (model->field) {
    zp_plates_gaps(&model->plates, shape.x, shape.y, &sim->eval.plates);
    shape.gap = sim->eval.plates.gap;
  }
  if (model->leaks) sim->shape_room.interface = zp_law_state(model, &zp_term_leak, sim->state);
  if (model->rod.plastic) sim->shape_room.strain = zp_law_state(model, &zp_term_rod, sim->state);
  const ZpSpan now = zp_span_of(model, state, motion.x, motion.vx);
  sim->shape_room.k0 = zp_term_natural_of_state(model, &now, &sim->eval);
  for (int half = 0; model->has_bead && half < ZP_BEADS; half++)
    sim->shape_room.reach[half] = state->bead[half].reach;
  zp_shape_fill(model, &sim->shape_room, &shape);
  return shape;
}

/* Margins of one member => its shape, too. */
static ZpMargins margins_of(ZpSim *sim) {
  sim->shape = shape_of(sim);
  ZpMargins margins = zp_margins_of(sim->model, &sim->shape);
  if (sim->model->leaks) margins.liquid = zp_sim_leak(sim).liquid;
  return margins;
}

static void fill_margins(ZpSim *sim, double *row) {
  sim->now = margins_of(sim);
  row[SIGNAL_insulator_field] = sim->now.insulator;
  row[SIGNAL_max_stress] = sim->now.stress;
}

/* The computations that a signal needs; they cost far more than reading the state. */
enum { STATE = 0, MECHANICS = 1, ELECTRIC = 2, MARGINS = 4, ENERGY = MECHANICS | ELECTRIC, ALL = ENERGY | MARGINS };
static const unsigned char takes[SIGNAL_COUNT] = {
    [SIGNAL_force] = ELECTRIC,          [SIGNAL_charge] = ELECTRIC,         [SIGNAL_capacitance] = ELECTRIC,
    [SIGNAL_current] = ELECTRIC,        [SIGNAL_electric_work] = ELECTRIC,  [SIGNAL_source_energy] = ELECTRIC,
    [SIGNAL_power] = ELECTRIC,          [SIGNAL_leak_current] = ELECTRIC,   [SIGNAL_interface_voltage] = ELECTRIC,
    [SIGNAL_energy_imbalance] = ENERGY, [SIGNAL_insulator_field] = MARGINS, [SIGNAL_max_stress] = MARGINS};

/* The computations that a row of the ledger needs. */
static unsigned taken_by(const ZpRow *row) {
  if (row == &zp_row_field_energy || row == &zp_row_charging_loss) return ELECTRIC;
  return row->kind == ZP_ROW_STORED || row->kind == ZP_ROW_SIGNAL ? MECHANICS : STATE;
}

/* Signals that need no more than `what` => sim->row, of one member alone. */
static void fill_own_row(ZpSim *sim, unsigned what) {
  const ZpModel *model = sim->model;
  double *row = sim->row, now[ZP_MOST_ROWS];
  memcpy(now, zp_state_ledger(model, sim->state), model->ledger.rows * sizeof *now);
  fill_state(sim, row);
  row[SIGNAL_sensed_capacitance] = row[SIGNAL_sensed_stroke] = 0; /* a study adds them where there is a meter */
  if (what & MECHANICS) zp_system_now(model, sim->state, &sim->eval, now);
  if (what & MECHANICS) zp_sim_add_springs(sim, now);
  if (what & ELECTRIC) fill_electric(sim, now, row);
  if (what & MARGINS) fill_margins(sim, row);
  fill_books(sim, now, row);
}

/* How a signal of a series follows from those of its members, the uppermost first: most are sums. */
enum { SUM, FIRST, LAST, LARGEST, LEAST };
static const unsigned char of_all[SIGNAL_COUNT] = {[SIGNAL_time] = FIRST,
                                                   [SIGNAL_voltage] = FIRST,
                                                   [SIGNAL_command] = FIRST,
                                                   [SIGNAL_source_voltage] = FIRST,
                                                   [SIGNAL_setpoint] = FIRST,
                                                   [SIGNAL_measured] = FIRST,
                                                   [SIGNAL_interface_voltage] = FIRST,
                                                   [SIGNAL_end_velocity] = LAST,
                                                   [SIGNAL_film_thickness] = LEAST,
                                                   [SIGNAL_wet_length] = LEAST,
                                                   [SIGNAL_insulator_field] = LARGEST,
                                                   [SIGNAL_max_stress] = LARGEST};

/* Antagonists have one load: its position, and the shape, are those of the upper member. */
static bool is_of_upper(size_t signal) {
  return signal == SIGNAL_stroke || signal == SIGNAL_opening || signal == SIGNAL_end_velocity ||
         signal == SIGNAL_zipped_length;
}

/* The closed length of members side by side is that of the member that has closed least. */
static int rule_of(const ZpModel *model, size_t signal) {
  if (row_of[signal]) return row_of[signal]->kind == ZP_ROW_SIGNAL ? LARGEST : SUM;
  if (!zp_shares_load(model) || !is_of_upper(signal)) return of_all[signal];
  return zp_abreast(model) > 1 && signal == SIGNAL_zipped_length ? LEAST : FIRST;
}

/* Combine the row of a member with that of those above it. */
static void join_row(const ZpModel *model, double *row, const double *other) {
  for (size_t k = 0; k < SIGNAL_COUNT; k++) {
    double values[] = {[SUM] = row[k] + other[k],
                       [FIRST] = row[k],
                       [LAST] = other[k],
                       [LARGEST] = fmax(row[k], other[k]),
                       [LEAST] = fmin(row[k], other[k])};
    row[k] = values[rule_of(model, k)];
  }
}

/* Force with which one of the members side by side pulls the load up, eq. (29.5), N: the mean over the last step. */
static double force_of(const ZpSim *sim) {
  const ZpModel *model = sim->model;
  const ZpState *state = sim->state;
  const double *up = zp_nodes(model, zp_state_mean_a(model, sim->state)).y;
  double caught = (double)zp_halves(&model->topology) * zp_state_added(model, state);
  double inertia = (zp_load_share(model) * model->def.load.mass + caught) * zp_load_at(model, up);
  double hung = -model->fall[1] * zp_state_hung(model, state), input = zp_ramp_value(&state->load_input, state->t);
  return zp_load_pull(model) + input + model->parts * (hung + inertia - state->link_force);
}

/* Signals of one member alone, in addition to those of all => the place behind them. */
static double *put_member(const ZpSim *sim, double *place) {
  if (zp_is_network(sim->model)) {
    const size_t of[NUMBERS_MEMBER] = {SIGNAL_opening, SIGNAL_zipped_length, SIGNAL_voltage};
    for (size_t k = 0; k < NUMBERS_MEMBER; k++)
      place[k] = sim->row[of[k]];
    return place + NUMBERS_MEMBER;
  }
  place[0] = zp_abreast(sim->model) > 1 ? force_of(sim) : sim->row[SIGNAL_opening];
  if (zp_abreast(sim->model) > 1) place[1] = sim->row[SIGNAL_zipped_length];
  return place + numbers_of_each(sim->model);
}

double zp_sim_hanging(const ZpSim *sim) {
  double sum = sim->state->opening0;
  for (const ZpSim *m = sim + 1; m < sim + sim->members && !zp_shares_load(sim->model); m++)
    sum += m->state->opening0;
  return sum;
}

/* Heights of the bodies of a network, which has no opening of its own. */
static void fill_bodies(const ZpSim *sim, double *row, double *place) {
  static const size_t none[] = {SIGNAL_stroke,        SIGNAL_opening,      SIGNAL_contraction,
                                SIGNAL_zipped_length, SIGNAL_end_velocity, SIGNAL_angle};
  for (size_t k = 0; k < sizeof none / sizeof none[0]; k++)
    row[none[k]] = NAN;
  const bool plane = sim->model->network->plane;
  for (size_t body = 1; body < sim->model->network->bodies; body++) {
    const ZpPose at = zp_sim_place(sim, body);
    if (plane) *place++ = at.x;
    *place++ = at.y;
    if (plane) *place++ = at.turn;
  }
}

/* Keep what the trace of its port is made of. */
static void keep_own(ZpSim *sim) {
  const double *row = sim->row;
  const double own[ZP_TRACE_COLUMNS] = {[ZP_TRACE_TIME] = row[SIGNAL_time],
                                        [ZP_TRACE_VOLTAGE] = row[SIGNAL_voltage],
                                        [ZP_TRACE_CHARGE] = row[SIGNAL_charge],
                                        [ZP_TRACE_CAPACITANCE] = row[SIGNAL_capacitance],
                                        [ZP_TRACE_STROKE] = row[SIGNAL_stroke]};
  memcpy(sim->own_row, own, sizeof own);
}

/* Signals of all members together, and numbers of each. */
static void fill_row(ZpSim *sim, unsigned what) {
  fill_own_row(sim, what);
  keep_own(sim);
  if (sim->members == 1 && !zp_is_network(sim->model)) return;
  double *row = sim->row, *place = row + SIGNAL_COUNT, whole = zp_sim_hanging(sim);
  place = put_member(sim, place);
  for (ZpSim *m = sim + 1; m < sim + sim->members; m++) {
    fill_own_row(m, what);
    keep_own(m);
    place = put_member(m, place);
    join_row(sim->model, row, m->row);
  }
  if (zp_is_network(sim->model)) {
    fill_bodies(sim, row, place);
    return;
  }
  row[SIGNAL_contraction] = whole > 0 ? 1 - row[SIGNAL_opening] / whole : NAN;
}

/* The mean current and power of the next row are means from the present row on. */
static void count_from_here(ZpSim *sim) {
  sim->row_time = sim->state->t;
  sim->row_charge = sim->own_charge;
  sim->row_energy = sim->own_energy;
}

/* A row that is kept: the mean current of the next row starts here. Of several rows at one time the charge of the first
 * counts, so that the current of a jump is part of the next row. */
static void make_row(ZpSim *sim) {
  const ZpState *state = sim->state;
  fill_row(sim, ALL);
  if (!(state->t > sim->row_time)) return;
  if (sim->fed == 0) zp_supply_coupling_note_current(sim, sim->row[SIGNAL_current], state->t - sim->row_time);
  for (ZpSim *m = sim; m < sim + sim->members; m++)
    count_from_here(m);
}

ZpRowStart zp_sim_row_start(const ZpSim *sim) {
  return (ZpRowStart){sim->row_time, sim->row_charge, sim->row_energy};
}

void zp_sim_set_row_start(ZpSim *sim, ZpRowStart start) {
  sim->row_time = start.time;
  sim->row_charge = start.charge;
  sim->row_energy = start.energy;
}

void zp_sim_start_row(ZpSim *sim) {
  fill_row(sim, ELECTRIC);
  for (ZpSim *m = sim; m < sim + sim->members; m++)
    count_from_here(m);
}

/* All numbers if the voltage of an input had another value => slope [columns] += weight times them; the state does not
 * change. */
static void add_at(ZpSim *sim, ZpInput input, double voltage, double weight, size_t columns, double *slope) {
  const ZpRamp ramp = {voltage, 0, sim->state->t, INFINITY};
  zp_sim_keep_states(sim);
  if (input != ZP_INPUT_VOLTAGE)
    zp_sim_hold_port(zp_sim_port_of(sim, (int)input), ramp);
  else if (zp_is_network(sim->model))
    zp_sim_hold_common_port(sim, ramp);
  else
    zp_sim_hold_voltage(sim, ramp);
  fill_row(sim, ALL);
  zp_sim_take_states_back(sim);
  for (size_t k = 0; k < columns; k++)
    slope[k] += weight * sim->row[k];
}

size_t zp_sim_columns(const ZpSim *sim) {
  return columns_of(sim);
}

ZpStatus zp_sim_column_slopes(ZpSim *sim, ZpInput input, size_t columns, double *slope, ZpError *err) {
  static const double part = 1e-5, least = 1e-2; /* of the voltage, and V: far from the rounding of differences */
  if (!zp_def_input_unit(sim->model->whole, (int)input) && (size_t)input >= ZP_INPUT_COUNT)
    return zp_fail(err, ZP_BAD_INPUT, "input %d: there is no such input", (int)input);
  memset(slope, 0, columns * sizeof *slope);
  if (input == ZP_INPUT_SETPOINT) slope[SIGNAL_setpoint] = 1; /* the controller measures at its next sample */
  ZpSim *lead = zp_sim_port_of(sim, (int)input);
  if (!lead) return ZP_OK; /* a load acts on what moves only */
  double voltage = zp_sim_is_fed(lead) ? zp_sim_command(lead) : lead->state->U;
  double half = fmax(least, part * fabs(voltage)), up = voltage + half, down = voltage - half;
  add_at(sim, input, up, 1 / (up - down), columns, slope);
  add_at(sim, input, down, -1 / (up - down), columns, slope);
  return ZP_OK;
}

ZpStatus zp_sim_input_slopes(ZpSim *sim, ZpInput input, double *slope, ZpError *err) {
  return zp_sim_column_slopes(sim, input, SIGNAL_COUNT, slope, err);
}

/* A row of the ledger that is no signal: of several members the sum, or the largest; NAN: none has it. */
static double unlisted(ZpSim *sim, const char *name) {
  double found = NAN;
  for (ZpSim *m = sim; m < sim + sim->members; m++)
    for (size_t k = 0; k < m->model->ledger.rows; k++) {
      const ZpRow *row = m->model->ledger.row[k];
      if (strcmp(row->name, name) != 0) continue;
      fill_own_row(m, taken_by(row));
      double value = m->row[m->row_at[k]];
      found = isnan(found) ? value : row->kind == ZP_ROW_SIGNAL ? fmax(found, value) : found + value;
    }
  return found;
}

int zp_signal_find(const char *name) {
  for (int k = 0; k < SIGNAL_COUNT; k++)
    if (strcmp(names[k], name) == 0) return k;
  return -1;
}

double zp_sim_own_signal(ZpSim *sim, int signal) {
  fill_own_row(sim, takes[signal]);
  return sim->row[signal];
}

double zp_sim_get(ZpSim *sim, const char *name) {
  const int k = zp_signal_find(name);
  const size_t beyond = k < 0 ? column_beyond(sim->model->whole, name) : 0;
  if (k < 0 && beyond == 0) return unlisted(sim, name);
  fill_row(sim, beyond > 0 ? STATE : row_of[k] ? taken_by(row_of[k]) : takes[k]);
  return sim->row[beyond > 0 ? beyond : (size_t)k];
}

void zp_sim_read_columns(ZpSim *sim, size_t columns, double *row) {
  make_row(sim);
  memcpy(row, sim->row, columns * sizeof *row);
}

void zp_sim_read(ZpSim *sim, double *row) {
  zp_sim_read_columns(sim, SIGNAL_COUNT, row);
}

/* The shapes of all, member after member. */
static ZpShape join_shapes(ZpSim *sim) {
  ZpShape shape = sim->shape;
  const bool plane = sim->model->network->plane;
  if (sim->members == 1 && !plane) return shape;
  const ZpPose *pose = plane ? zp_sim_poses(sim) : NULL;
  size_t member = 0;
  for (ZpSim *m = sim; m < sim + sim->members; m++, member++) {
    zp_many_put(&sim->all, sim->model, member, &m->shape);
    if (plane) zp_many_stand(&sim->all, &sim->dynamics.plane, pose, member);
  }
  zp_many_give(&sim->all, &shape);
  return shape;
}

ZpShape zp_sim_shape(ZpSim *sim) {
  sim->shape = shape_of(sim);
  for (ZpSim *m = sim + 1; m < sim + sim->members; m++)
    m->shape = shape_of(m);
  return join_shapes(sim);
}

/* Film thickness, pressure and wet length of one member => the arrays of all, from its first station on. */
static void fill_liquid(ZpSim *sim, double *thickness, double *pressure, double *wet_length) {
  const ZpModel *model = sim->model;
  const double *head = zp_state_own(model, sim->state), *share = model->film.share;
  ZpShape shape = shape_of(sim);
  for (size_t i = 0; i < model->nodes; i++, head += model->own) {
    bool wet = zp_shape_is_wet(model, &sim->shape_room, i);
    thickness[i] = wet ? zp_film_thickness(&model->film, shape.gap[i]) : 0;
    pressure[i] = wet ? share[0] * head[0] + share[1] * head[1] : 0;
  }
  for (size_t half = 0; half < zp_halves(&model->topology); half++)
    wet_length[half] = sim->shape_room.reach[half];
}

ZpLiquid zp_sim_liquid(ZpSim *sim) {
  const ZpModel *model = sim->model;
  const ZpLiquidRoom *room = &sim->liquid;
  size_t member = 0;
  if (!model->has_film) return (ZpLiquid){NULL, NULL, NULL};
  for (ZpSim *m = sim; m < sim + sim->members; m++, member++)
    fill_liquid(m, room->thickness + member * model->nodes, room->pressure + member * model->nodes,
                room->wet_length + member * zp_halves(&model->topology));
  return (ZpLiquid){room->thickness, room->pressure, room->wet_length};
}

void zp_sim_watch(ZpSim *sim) {
  for (ZpSim *m = sim; m < sim + sim->members; m++) {
    m->watched = true;
    m->seen = zp_margins_none();
  }
}

void zp_sim_see_one(ZpSim *sim) {
  if (sim->watched) zp_margins_join(&sim->seen, margins_of(sim));
}

void zp_sim_see(ZpSim *sim) {
  for (ZpSim *m = sim; m < sim + sim->members; m++)
    zp_sim_see_one(m);
}

ZpMargins zp_sim_margins(const ZpSim *sim) {
  ZpMargins worst = zp_margins_none();
  for (const ZpSim *m = sim; m < sim + sim->members; m++)
    zp_margins_join(&worst, m->seen);
  return worst;
}

/* The present row. */
static void look(ZpSim *sim) {
  make_row(sim);
  for (ZpSim *m = sim; m < sim + sim->members; m++)
    if (m->watched) zp_margins_join(&m->seen, m->now);
}

void zp_sim_trace(ZpSim *lead, ZpTable *trace) {
  lead->trace = trace;
}

/* The row of a port, by its first member, where the whole system has this stroke. */
static void fill_trace(const ZpSim *lead, double stroke, double *values) {
  double leaked = 0;
  size_t count = 0;
  memcpy(values, lead->own_row, sizeof lead->own_row);
  for (const ZpSim *m = lead; m; m = zp_sim_next(m) > 0 ? m + zp_sim_next(m) : NULL) {
    leaked += m->model->parts * m->state->leaked;
    if (count++ == 0) continue;
    values[ZP_TRACE_CHARGE] += m->own_row[ZP_TRACE_CHARGE];
    values[ZP_TRACE_CAPACITANCE] += m->own_row[ZP_TRACE_CAPACITANCE];
  }
  values[ZP_TRACE_CHARGE] += leaked;
  if (count > 1) values[ZP_TRACE_STROKE] = count == lead->model->members ? stroke : (double)NAN;
}

static void offer_trace(const ZpSim *sim, bool last) {
  double values[ZP_TRACE_COLUMNS];
  for (const ZpSim *m = sim; m < sim + sim->members; m++) {
    if (!m->trace) continue;
    fill_trace(m, sim->row[SIGNAL_stroke], values);
    if (last)
      zp_table_keep_last(m->trace, values);
    else
      zp_table_offer(m->trace, values);
  }
}

void zp_sim_offer_record(ZpSim *sim) {
  if (sim->series || sim->shapes) look(sim);
  offer_trace(sim, false);
  if (sim->series) zp_table_offer(sim->series, sim->row);
  if (!sim->shapes) return;
  ZpShape shape = join_shapes(sim);
  zp_shapes_offer(sim->shapes, &shape);
}

void zp_sim_close_record(ZpSim *sim) {
  if (sim->series || sim->shapes) look(sim);
  offer_trace(sim, true);
  if (sim->series) zp_table_keep_last(sim->series, sim->row);
  if (!sim->shapes) return;
  ZpShape shape = join_shapes(sim);
  zp_shapes_keep_last(sim->shapes, &shape);
}
