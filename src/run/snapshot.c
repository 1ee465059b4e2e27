/* State <=> bytes: a record (base/pack.h) of its numbers, the keys that make the model (a choice as its word), its
 * arrays, each all x, then all y, and the rows of its ledger by their names. The array of the laws has heads of the
 * liquid, station by station, then the state of each law. Each of several actuators has a record of its own, from the
 * uppermost on.
 *
 * Another meaning of a number raises the version; a field that is added or removed need not. */
#include "run/snapshot.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <zipact/checkpoint.h>
#include <zipact/version.h>

#include "base/pack.h"
#include "def/check.h"
#include "run/supply_coupling.h"

static const ZpPackKind snapshot = {"snapshot", 'S', 10};

/* -- the numbers of a state ------------------------------------------------------------------------ */

typedef enum Kind {
  REAL,    /* finite */
  VOLTAGE, /* that electrodes can have */
  RATE,    /* of such a voltage */
  INPUT,   /* that a program may set, or its rate */
  READING, /* NAN: none yet */
  PAST,    /* an instant not after the present; NAN: not yet */
  UNTIL,   /* an instant; INFINITY: for ever */
  STEP,    /* of time, s; 0: none */
  FLAG,
  NODE,  /* a number of one, in a size_t */
  MODE,  /* a ZpSupplyMode, in a size_t */
  SAMPLE /* a whole number, in a double */
} Kind;

/* A number of the state, or an array of them. */
typedef struct Number {
  const char *name;
  Kind kind;
  size_t offset, count;
} Number;

/* X(kind, field of ZpState) for each; the time is the first. */
#define RAMP(X, input, kind) X(kind, input.value) X(INPUT, input.rate) X(REAL, input.since) X(UNTIL, input.until)
#define BEAD(X, bead)                                                                                                  \
  X(REAL, bead.reach) X(REAL, bead.rate) X(REAL, bead.outside) X(REAL, bead.lost) X(REAL, bead.supply)
#define STATE(X)                                                                                                       \
  X(REAL, t)                                                                                                           \
  X(VOLTAGE, U)                                                                                                        \
  X(FLAG, by_hand)                                                                                                     \
  X(NODE, zip.front)                                                                                                   \
  X(FLAG, zip.platform)                                                                                                \
  X(FLAG, was_open)                                                                                                    \
  X(FLAG, load_changed)                                                                                                \
  X(MODE, supply_mode)                                                                                                 \
  X(PAST, zip_time)                                                                                                    \
  X(PAST, closed_from)                                                                                                 \
  X(REAL, still.least)                                                                                                 \
  X(REAL, still.most)                                                                                                  \
  X(REAL, opening0)                                                                                                    \
  X(VOLTAGE, base_U)                                                                                                   \
  X(REAL, base_charge)                                                                                                 \
  X(REAL, work)                                                                                                        \
  X(REAL, changed_x)                                                                                                   \
  X(REAL, changed_y)                                                                                                   \
  X(REAL, leaked)                                                                                                      \
  BEAD(X, bead[0])                                                                                                     \
  BEAD(X, bead[1])                                                                                                     \
  X(REAL, link_force)                                                                                                  \
  X(PAST, starved_time)                                                                                                \
  X(STEP, last_step)                                                                                                   \
  X(STEP, next_step)                                                                                                   \
  X(PAST, refreshed)                                                                                                   \
  X(VOLTAGE, held_U)                                                                                                   \
  X(REAL, held_energy)                                                                                                 \
  X(REAL, held_charge)                                                                                                 \
  X(REAL, held_capacitance)                                                                                            \
  X(VOLTAGE, supply.lagged)                                                                                            \
  X(VOLTAGE, supply.voltage)                                                                                           \
  X(REAL, supply.ready)                                                                                                \
  X(REAL, source_charge)                                                                                               \
  X(REAL, source_energy)                                                                                               \
  X(RATE, U_rate)                                                                                                      \
  X(REAL, U_change)                                                                                                    \
  RAMP(X, voltage_input, VOLTAGE)                                                                                      \
  RAMP(X, load_input, INPUT)                                                                                           \
  X(REAL, load_work)                                                                                                   \
  X(SAMPLE, control.taken)                                                                                             \
  X(SAMPLE, control.given)                                                                                             \
  X(REAL, control.integral)                                                                                            \
  X(READING, control.measured)                                                                                         \
  X(REAL, control.pending)                                                                                             \
  X(FLAG, setpoint_by_hand)                                                                                            \
  RAMP(X, setpoint_input, INPUT)
#define LENGTH(field)                                                                                                  \
  ((sizeof((ZpState *)0)->field + sizeof(double) - 1) / sizeof(double)) /* of a flag, which is shorter, too */
#define IN_TABLE(kind, field) {#field, kind, offsetof(ZpState, field), LENGTH(field)},
#define IN_SUM(kind, field)   +LENGTH(field)
static const Number number[] = {STATE(IN_TABLE)};
static const char *const array[] = {"position",      "velocity",    "held force", "held at",
                                    "mean velocity", "mean accel.", "laws"};
enum { NUMBERS = sizeof number / sizeof number[0], ARRAYS = sizeof array / sizeof array[0] };

_Static_assert(sizeof(void *) != 8 || sizeof(ZpState) == (STATE(IN_SUM)) * sizeof(double),
               "a snapshot holds all of a state");

static void *place_of(ZpState *state, const Number *n) {
  return (char *)state + n->offset;
}

static bool is_size(const Number *n) {
  return n->kind == NODE || n->kind == MODE;
}

/* Item j of a number. */
static double item_of(const ZpState *state, const Number *n, size_t j) {
  const void *place = (const char *)state + n->offset;
  if (n->kind == FLAG) return *(const bool *)place;
  return is_size(n) ? (double)*(const size_t *)place : ((const double *)place)[j];
}

/* -- states nearby --------------------------------------------------------------------------------- */

/* Does the number change in proportion where the state changes a little? */
static bool is_real(const Number *n) {
  return n->kind < FLAG;
}

/* Doubles behind the numbers. */
static size_t data_of(const ZpModel *model) {
  return (zp_state_size(model) - offsetof(ZpState, data)) / sizeof(double);
}

void zp_state_along(const ZpModel *model, const ZpState *at, const ZpState *rate, double offset, ZpState *near) {
  memcpy(near, at, zp_state_size(model));
  for (const Number *n = number; n < number + NUMBERS; n++)
    for (size_t j = 0; is_real(n) && j < n->count; j++)
      ((double *)place_of(near, n))[j] = item_of(at, n, j) + offset * item_of(rate, n, j);
  for (size_t i = 0, count = data_of(model); i < count; i++)
    near->data[i] = at->data[i] + offset * rate->data[i];
}

static double beyond(double near, double at) {
  return isfinite(near) && isfinite(at) ? near - at : 0;
}

void zp_state_add_rate(const ZpModel *model, const ZpState *at, const ZpState *near, double weight, ZpState *rate) {
  for (const Number *n = number; n < number + NUMBERS; n++)
    for (size_t j = 0; is_real(n) && j < n->count; j++)
      ((double *)place_of(rate, n))[j] += weight * beyond(item_of(near, n, j), item_of(at, n, j));
  for (size_t i = 0, count = data_of(model); i < count; i++)
    rate->data[i] += weight * beyond(near->data[i], at->data[i]);
}

/* -- the fields ------------------------------------------------------------------------------------ */

static void walk_numbers(ZpPack *p, ZpState *state) {
  for (const Number *n = number; n < number + NUMBERS; n++)
    zp_pack_field(p, n->name, n->kind == FLAG ? ZP_FLAG : is_size(n) ? ZP_SIZE : ZP_REAL, place_of(state, n), n->count);
}

/* All but the last are of nodes. `data` is that of a state; NULL counts. */
static void walk_arrays(ZpPack *p, const ZpModel *model, double *data) {
  for (size_t k = 0; k < ARRAYS; k++)
    zp_pack_field(p, array[k], ZP_REAL, data ? data + k * zp_coordinates(model) : NULL,
                  k + 1 < ARRAYS ? zp_coordinates(model) : zp_extra_unknowns(model) + model->kept);
}

/* The rows of the ledger, behind the arrays. */
static void walk_rows(ZpPack *p, const ZpModel *model, double *data) {
  double *row = data ? data + (ARRAYS - 1) * zp_coordinates(model) + zp_extra_unknowns(model) + model->kept : NULL;
  for (size_t k = 0; k < model->ledger.rows; k++)
    zp_pack_field(p, model->ledger.row[k]->name, ZP_REAL, row ? row + k : NULL, 1);
}

/* Bodies in the plane, and what a program does to the bodies of a network, behind those. */
static void walk_bodies(ZpPack *p, const ZpModel *model, double *data) {
  const size_t bodies = zp_state_bodies_size(model), pushes = zp_state_pushes_size(model), all = data_of(model);
  if (bodies > 0) zp_pack_field(p, "bodies", ZP_REAL, data ? data + all - pushes - bodies : NULL, bodies);
  if (pushes > 0) zp_pack_field(p, "pushes", ZP_REAL, data ? data + all - pushes : NULL, pushes);
}

static void print_value(const ZpKey *key, double value, char text[64]) {
  bool bare = strcmp(key->unit, "1") == 0;
  if (key->type == ZP_KEY_BOOL)
    snprintf(text, 64, "%s", value != 0 ? "true" : "false");
  else if (isnan(value))
    snprintf(text, 64, "%s", key->text);
  else
    snprintf(text, 64, "%.15g%s%s", value, bare ? "" : " ", bare ? "" : key->unit);
}

/* Write a key, or read it and refuse another value than that of `def`. */
static ZpStatus walk_value(ZpPack *p, const ZpActuatorDef *def, int index, ZpError *err) {
  const ZpKey *key = zp_key(index);
  const char *name = ZP_KEY_NAME(index);
  const double mine = zp_def_get(def, index);
  double value = mine;
  char there[64], here[64];
  zp_pack_field(p, name, ZP_REAL, &value, 1);
  if (value == mine || (isnan(value) && isnan(mine))) return ZP_OK;
  print_value(key, value, there);
  print_value(key, mine, here);
  return zp_fail(err, ZP_BAD_INPUT, "of another model: %s is %s there, %s here", name, there, here);
}

/* As walk_value, of a choice. */
static ZpStatus walk_choice(ZpPack *p, const ZpActuatorDef *def, int index, ZpError *err) {
  const ZpKey *key = zp_key(index);
  const char *word = key->choices[(int)zp_def_get(def, index)].word;
  size_t length = strlen(word), count;
  if (!p->in) {
    zp_pack_open(p, key->name, ZP_TEXT);
    zp_pack_add(p, word, length);
    zp_pack_close(p);
    return ZP_OK;
  }
  const unsigned char *there = zp_pack_find(p, key->name, ZP_TEXT, &count);
  if (!there || (count == length && memcmp(there, word, length) == 0)) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "of another model: %s is %.*s there, %s here", key->name,
                 count < 64 ? (int)count : 64, (const char *)there, word);
}

static ZpStatus walk_keys(ZpPack *p, const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = ZP_OK;
  for (int i = 0; i < zp_key_count() && status == ZP_OK; i++)
    if (zp_checkpoint_holds(i))
      status = zp_key(i)->type == ZP_KEY_ENUM ? walk_choice(p, def, i, err) : walk_value(p, def, i, err);
  return status;
}

/* Keys of segments that are not at their defaults. */
static ZpStatus walk_segments(ZpPack *p, const ZpActuatorDef *def, ZpError *err) {
  size_t mine = 0;
  ZpStatus status = ZP_OK;
  for (int i = zp_segment_key_next(def, -1); i >= 0; i = zp_segment_key_next(def, i))
    mine++;
  size_t count = mine;
  zp_pack_field(p, "segments", ZP_SIZE, &count, 1);
  if (count != mine) return zp_fail(err, ZP_BAD_INPUT, "of another model: it has other segments");
  for (int i = zp_segment_key_next(def, -1); i >= 0 && status == ZP_OK; i = zp_segment_key_next(def, i))
    status = walk_value(p, def, i, err);
  return status;
}

/* Keys of bodies and springs, and where members are between them, in the record of the first member of a network.
 * Others have NULL. */
static ZpStatus walk_network(ZpPack *p, const ZpActuatorDef *network, ZpError *err) {
  size_t mine = 0;
  ZpStatus status = ZP_OK;
  for (size_t k = 0; network && k < network->given->count; k++)
    mine += zp_key_is_of_network(network->given->value[k].key);
  size_t count = mine;
  if (network) zp_pack_field(p, "network", ZP_SIZE, &count, 1);
  if (count != mine) return zp_fail(err, ZP_BAD_INPUT, "of another model: it has other bodies and springs");
  for (size_t k = 0; network && k < network->given->count && status == ZP_OK; k++)
    if (zp_key_is_of_network(network->given->value[k].key))
      status = walk_value(p, network, network->given->value[k].key, err);
  return status;
}

/* -- what a state can be --------------------------------------------------------------------------- */

/* Can it be a voltage, or a rate of `per_time` such voltages per second? A charge that is kept while its faces part
 * raises the voltage of a drive by the ratio of the capacitances. */
static bool is_voltage(double value, double per_time) {
  static const double raised = 1e3;
  return fabs(value) <= raised * zp_key(zp_key_find("drive.voltage"))->max * per_time;
}

/* Can it be a number of this kind, in a state of time t? Other numbers would index beyond arrays or stop the clock, or
 * no run has them. */
static bool is_possible(Kind kind, double value, double t, const ZpActuatorDef *def) {
  static const double most_input = 1e15; /* SI: larger than every range of an input and its rate */
  static const double rounding = 1e-9;   /* of the time */
  switch (kind) {
  case NODE:
    return value < def->mesh.nodes;
  case MODE:
    return value == ZP_SUPPLY_FREE || value == ZP_SUPPLY_GIVES_MOST || value == ZP_SUPPLY_SINKS_MOST ||
           value == ZP_SUPPLY_SPILLS;
  case VOLTAGE:
    return is_voltage(value, 1);
  case RATE:
    return is_voltage(value, 1 / ZP_SUPPLY_SHORTEST);
  case INPUT:
    return fabs(value) <= most_input;
  case READING:
    return !isinf(value);
  case PAST:
    return isnan(value) || (value >= 0 && value <= t * (1 + rounding));
  case UNTIL:
    return !isnan(value);
  case STEP:
    return value >= 0 && isfinite(value);
  default:
    return isfinite(value);
  }
}

static ZpStatus check_numbers(const ZpState *state, const ZpActuatorDef *def, ZpError *err) {
  const ZpControl control = zp_control_of(def);
  for (const Number *n = number; n < number + NUMBERS; n++)
    for (size_t j = 0; j < n->count; j++) {
      const double value = item_of(state, n, j);
      if (!is_possible(n->kind, value, state->t, def) || (n == number && value < 0))
        return zp_fail(err, ZP_BAD_INPUT, "its numbers are not a state of an actuator: %s = %g", n->name, value);
    }
  bool fits = zp_control_fits(&control, state->t, &state->control);
  return fits ? ZP_OK : zp_fail(err, ZP_BAD_INPUT, "samples of its controller do not fit its time");
}

/* (bytes of one record) => p, behind the keys, and the numbers of `state`, of a model with the keys of `def` */
static ZpStatus read_numbers(const ZpActuatorDef *def, const ZpActuatorDef *network, const void *bytes, size_t size,
                             ZpPack *p, ZpState *state, ZpError *err) {
  ZpStatus status = zp_pack_read(&snapshot, bytes, size, p, err);
  if (status != ZP_OK) return status;
  *state = (ZpState){.t = 0};
  walk_numbers(p, state);
  status = walk_keys(p, def, err);
  if (status == ZP_OK) status = walk_segments(p, def, err);
  if (status == ZP_OK) status = walk_network(p, network, err);
  if (status == ZP_OK && p->lacks) status = zp_pack_end(p, err);
  return status == ZP_OK ? check_numbers(state, def, err) : status;
}

/* -- several --------------------------------------------------------------------------------------- */

static ZpStatus check_count(const void *bytes, size_t size, size_t members, ZpError *err) {
  const unsigned char *byte = bytes;
  size_t there = 0;
  for (size_t used = 0; used < size || there == 0; there++)
    used += zp_pack_first(byte + used, size - used);
  if (there == members) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "of another model: it has %zu members, %zu here", there, members);
}

/* The network of which this is the first member; NULL: it is none. */
static const ZpActuatorDef *network_of(const ZpModel *model) {
  return model->number == 0 && zp_is_network(model) ? model->whole : NULL;
}

static void walk(ZpPack *p, const ZpModel *model, ZpState *numbers, double *data) {
  walk_numbers(p, numbers);
  walk_keys(p, &model->def, NULL);
  walk_segments(p, &model->def, NULL);
  walk_network(p, network_of(model), NULL);
  walk_arrays(p, model, data);
  walk_rows(p, model, data);
  walk_bodies(p, model, data);
}

size_t zp_snapshot_size(const ZpModel *model) {
  ZpState none = {.t = 0};
  size_t size = 0;
  for (size_t k = 0; k < model->members; k++) {
    ZpPack p = zp_pack_count();
    walk(&p, model + k, &none, NULL);
    size += p.used;
  }
  return size;
}

void zp_snapshot_write(const ZpModel *model, ZpState *const state[], void *bytes) {
  unsigned char *byte = bytes;
  for (size_t k = 0; k < model->members; k++) {
    ZpPack p = zp_pack_write(&snapshot, byte);
    walk(&p, model + k, state[k], state[k]->data);
    zp_pack_seal(&p);
    byte += p.used;
  }
}

/* One record, that of member `member` of `def`. */
static ZpStatus check_one(const ZpActuatorDef *def, int member, const void *bytes, size_t size, ZpError *err) {
  ZpPack p;
  ZpState numbers;
  if (!def) return zp_pack_read(&snapshot, bytes, size, &p, err);
  const bool network = zp_def_network(def);
  const ZpActuatorDef one = network || zp_def_members(def) > 1 ? zp_def_member(def, member) : *def;
  return read_numbers(&one, network && member == 1 ? def : NULL, bytes, size, &p, &numbers, err);
}

ZpStatus zp_snapshot_check(const ZpActuatorDef *def, const void *bytes, size_t size, ZpError *err) {
  const unsigned char *byte = bytes;
  ZpStatus status = def ? check_count(bytes, size, (size_t)zp_def_members(def), err) : ZP_OK;
  int member = 1;
  for (size_t used = 0, own; status == ZP_OK && (used < size || used == 0); used += own) {
    own = zp_pack_first(byte + used, size - used);
    status = check_one(def, member++, byte + used, own, err);
  }
  return status;
}

double zp_snapshot_time(const void *bytes, size_t size) {
  ZpPack p;
  double t = NAN;
  if (zp_pack_read(&snapshot, bytes, zp_pack_first(bytes, size), &p, NULL) == ZP_OK)
    zp_pack_field(&p, number->name, ZP_REAL, &t, 1);
  return t;
}

static ZpStatus read_one(const ZpModel *model, const void *bytes, size_t size, ZpState *state, ZpError *err) {
  ZpPack p;
  ZpState numbers;
  ZpStatus status = read_numbers(&model->def, network_of(model), bytes, size, &p, &numbers, err);
  if (status != ZP_OK) return status;
  memcpy(state, &numbers, offsetof(ZpState, data));
  walk_arrays(&p, model, state->data);
  walk_rows(&p, model, state->data);
  walk_bodies(&p, model, state->data);
  status = zp_pack_end(&p, err);
  for (size_t k = 0; k < model->ledger.rows && status == ZP_OK; k++)
    if (!isfinite(zp_state_ledger(model, state)[k]))
      status = zp_fail(err, ZP_BAD_INPUT, "its numbers are not a state of an actuator: %s is not finite",
                       model->ledger.row[k]->name);
  return status;
}

ZpStatus zp_snapshot_read(const ZpModel *model, const void *bytes, size_t size, ZpState *const state[], ZpError *err) {
  const unsigned char *byte = bytes;
  ZpStatus status = check_count(bytes, size, model->members, err);
  for (size_t k = 0; k < model->members && status == ZP_OK; k++) {
    const size_t own = zp_pack_first(byte, size);
    status = read_one(model + k, byte, own, state[k], err);
    byte += own;
    size -= own;
  }
  return status;
}
