/* State <=> bytes that mean the same on every machine. All numbers are little-endian.
 *
 *   bytes 0 .. 7    89 5a 50 53 0d 0a 1a 0a: no text, and a transfer as text would spoil it
 *   8 .. 11         version of the format, 10
 *   12 .. 15        CRC-32 (as zlib's) of all that follows
 *   16 .. 23        length of the whole snapshot, bytes
 *
 * Then blocks: a name (16 bytes, filled up with 0), the width w of an item (8 bytes), their count n (8 bytes), and w n
 * bytes of items, texts (w = 1) or doubles (w = 8):
 *
 *   zipact          the version of the program that wrote it
 *   model.names     the keys that make the model, one a line, with the word of a choice: electro.model = plates
 *   model.values    their values, SI; auto is NAN
 *   state.names     the numbers of the state, then the rows of its ledger, one a line
 *   state.values    these numbers
 *   position ...    its arrays, each all x, then all y
 *   laws            what laws have beyond positions: heads of the liquid, station by station, then the state of each
 *                   law; empty without any
 *
 * Of several actuators there is one after the other for each, from the uppermost on.
 *
 * A number that is added, removed or redefined raises the version. */
#include "sim/snapshot.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <zipact/checkpoint.h>
#include <zipact/version.h>

#include "base/fail.h"
#include "def/check.h"
#include "sim/feed.h"

enum { MAGIC = 8, SUM = 12, SUMMED = 16, HEADER = 24, VERSION = 10, NAME = 16, BLOCK = NAME + 16, LINE = 128 };

static const unsigned char magic[MAGIC] = {0x89, 'Z', 'P', 'S', '\r', '\n', 0x1A, '\n'};

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
  MODE,  /* a ZpFeedMode, in a size_t */
  SAMPLE /* a whole number, in a double */
} Kind;

typedef struct Number {
  const char *name;
  Kind kind;
  size_t offset;
} Number;

#define NUMBER(kind, name)                                                                                             \
  { #name, kind, offsetof(ZpState, name) }
#define BOUNDS(cell) NUMBER(REAL, still.least[cell]), NUMBER(REAL, still.most[cell])
static const Number number[] = {NUMBER(REAL, t),
                                NUMBER(VOLTAGE, U),
                                NUMBER(FLAG, by_hand),
                                NUMBER(NODE, zip.front),
                                NUMBER(FLAG, zip.platform),
                                NUMBER(FLAG, was_open),
                                NUMBER(FLAG, load_changed),
                                NUMBER(MODE, supply_mode),
                                NUMBER(PAST, zip_time),
                                NUMBER(PAST, closed_from),
                                BOUNDS(0),
                                BOUNDS(1),
                                BOUNDS(2),
                                BOUNDS(3),
                                BOUNDS(4),
                                BOUNDS(5),
                                BOUNDS(6),
                                BOUNDS(7),
                                BOUNDS(8),
                                BOUNDS(9),
                                BOUNDS(10),
                                BOUNDS(11),
                                BOUNDS(12),
                                BOUNDS(13),
                                BOUNDS(14),
                                BOUNDS(15),
                                BOUNDS(16),
                                NUMBER(REAL, opening0),
                                NUMBER(VOLTAGE, base_U),
                                NUMBER(REAL, base_charge),
                                NUMBER(REAL, work),
                                NUMBER(REAL, changed_x),
                                NUMBER(REAL, changed_y),
                                NUMBER(REAL, leaked),
                                NUMBER(REAL, bead[0].reach),
                                NUMBER(REAL, bead[0].rate),
                                NUMBER(REAL, bead[0].outside),
                                NUMBER(REAL, bead[0].lost),
                                NUMBER(REAL, bead[0].supply),
                                NUMBER(REAL, bead[1].reach),
                                NUMBER(REAL, bead[1].rate),
                                NUMBER(REAL, bead[1].outside),
                                NUMBER(REAL, bead[1].lost),
                                NUMBER(REAL, bead[1].supply),
                                NUMBER(REAL, link_force),
                                NUMBER(PAST, starved_time),
                                NUMBER(STEP, last_step),
                                NUMBER(STEP, next_step),
                                NUMBER(PAST, refreshed),
                                NUMBER(VOLTAGE, held_U),
                                NUMBER(REAL, held_energy),
                                NUMBER(REAL, held_charge),
                                NUMBER(REAL, held_capacitance),
                                NUMBER(VOLTAGE, supply.lagged),
                                NUMBER(VOLTAGE, supply.voltage),
                                NUMBER(REAL, source_charge),
                                NUMBER(REAL, source_energy),
                                NUMBER(RATE, U_rate),
                                NUMBER(REAL, U_change),
                                NUMBER(VOLTAGE, voltage_input.value),
                                NUMBER(INPUT, voltage_input.rate),
                                NUMBER(REAL, voltage_input.since),
                                NUMBER(UNTIL, voltage_input.until),
                                NUMBER(INPUT, load_input.value),
                                NUMBER(INPUT, load_input.rate),
                                NUMBER(REAL, load_input.since),
                                NUMBER(UNTIL, load_input.until),
                                NUMBER(REAL, load_work),
                                NUMBER(SAMPLE, control.taken),
                                NUMBER(SAMPLE, control.given),
                                NUMBER(REAL, control.integral),
                                NUMBER(READING, control.measured),
                                NUMBER(REAL, control.pending[0]),
                                NUMBER(REAL, control.pending[1]),
                                NUMBER(REAL, control.pending[2]),
                                NUMBER(REAL, control.pending[3]),
                                NUMBER(REAL, control.pending[4]),
                                NUMBER(REAL, control.pending[5]),
                                NUMBER(REAL, control.pending[6]),
                                NUMBER(REAL, control.pending[7]),
                                NUMBER(REAL, control.pending[8]),
                                NUMBER(FLAG, setpoint_by_hand),
                                NUMBER(INPUT, setpoint_input.value),
                                NUMBER(INPUT, setpoint_input.rate),
                                NUMBER(REAL, setpoint_input.since),
                                NUMBER(UNTIL, setpoint_input.until)};
#undef BOUNDS
#undef NUMBER

static const char *const array[] = {"position",      "velocity",    "held force", "held at",
                                    "mean velocity", "mean accel.", "laws"};

enum { NUMBERS = sizeof number / sizeof number[0], ARRAYS = sizeof array / sizeof array[0], TIME = 0 };

_Static_assert(sizeof(void *) != 8 || sizeof(ZpState) == NUMBERS * sizeof(double), "a snapshot holds all of a state");

/* Of array k, of nodes all but the last. */
static size_t length_of(const ZpModel *model, size_t k) {
  return k + 1 < ARRAYS ? 2 * model->stride : zp_own_unknowns(model) + model->kept;
}

static bool is_size(size_t k) {
  return number[k].kind == NODE || number[k].kind == MODE;
}

/* Does the number change in proportion where the state changes a little? */
static bool is_real(size_t k) {
  return number[k].kind < FLAG;
}

static double number_of(const ZpState *state, size_t k) {
  const char *place = (const char *)state + number[k].offset;
  if (number[k].kind == FLAG) return *(const bool *)place;
  if (is_size(k)) return (double)*(const size_t *)(const void *)place;
  return *(const double *)(const void *)place;
}

static void set_number(ZpState *state, size_t k, double value) {
  char *place = (char *)state + number[k].offset;
  if (number[k].kind == FLAG)
    *(bool *)place = value != 0;
  else if (is_size(k))
    *(size_t *)(void *)place = (size_t)value;
  else
    *(double *)(void *)place = value;
}

/* -- states nearby --------------------------------------------------------------------------------- */

/* Doubles behind the numbers. */
static size_t data_of(const ZpModel *model) {
  return (zp_state_size(model) - offsetof(ZpState, data)) / sizeof(double);
}

void zp_state_along(const ZpModel *model, const ZpState *at, const ZpState *rate, double offset, ZpState *near) {
  memcpy(near, at, zp_state_size(model));
  for (size_t k = 0; k < NUMBERS; k++)
    if (is_real(k)) set_number(near, k, number_of(at, k) + offset * number_of(rate, k));
  for (size_t i = 0; i < data_of(model); i++)
    near->data[i] = at->data[i] + offset * rate->data[i];
}

static double beyond(double near, double at) {
  return isfinite(near) && isfinite(at) ? near - at : 0;
}

void zp_state_add_rate(const ZpModel *model, const ZpState *at, const ZpState *near, double weight, ZpState *rate) {
  for (size_t k = 0; k < NUMBERS; k++)
    if (is_real(k)) set_number(rate, k, number_of(rate, k) + weight * beyond(number_of(near, k), number_of(at, k)));
  for (size_t i = 0; i < data_of(model); i++)
    rate->data[i] += weight * beyond(near->data[i], at->data[i]);
}

/* -- bytes ----------------------------------------------------------------------------------------- */

static void put(unsigned char *byte, int width, uint64_t value) {
  for (int k = 0; k < width; k++)
    byte[k] = (unsigned char)(value >> (8 * k));
}

static uint64_t get(const unsigned char *byte, int width) {
  uint64_t value = 0;
  for (int k = 0; k < width; k++)
    value |= (uint64_t)byte[k] << (8 * k);
  return value;
}

static double real_at(const unsigned char *byte, size_t k) {
  uint64_t bits = get(byte + 8 * k, 8);
  double value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

/* CRC-32, four bits at a time. */
static uint32_t checksum(const unsigned char *byte, size_t size) {
  static const uint32_t of_nibble[16] = {0x00000000, 0x1DB71064, 0x3B6E20C8, 0x26D930AC, 0x76DC4190, 0x6B6B51F4,
                                         0x4DB26158, 0x5005713C, 0xEDB88320, 0xF00F9344, 0xD6D6A3E8, 0xCB61B38C,
                                         0x9B64C2B0, 0x86D3D2D4, 0xA00AE278, 0xBDBDF21C};
  uint32_t sum = 0xFFFFFFFFu;
  for (size_t i = 0; i < size; i++) {
    sum = sum >> 4 ^ of_nibble[(sum ^ byte[i]) & 15];
    sum = sum >> 4 ^ of_nibble[(sum ^ (uint32_t)byte[i] >> 4) & 15];
  }
  return ~sum;
}

/* -- writing --------------------------------------------------------------------------------------- */

/* The target of bytes; without one they are only counted. */
typedef struct Writer {
  unsigned char *byte;
  size_t used;
} Writer;

static void write_bytes(Writer *writer, const void *data, size_t size) {
  if (writer->byte) memcpy(writer->byte + writer->used, data, size);
  writer->used += size;
}

static void write_integer(Writer *writer, uint64_t value) {
  unsigned char byte[8];
  put(byte, 8, value);
  write_bytes(writer, byte, sizeof byte);
}

/* Every NaN is written with the same bits. */
static void write_real(Writer *writer, double value) {
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  write_integer(writer, isnan(value) ? UINT64_C(0x7FF8000000000000) : bits);
}

static void write_line(Writer *writer, const char *text) {
  write_bytes(writer, text, strlen(text));
  write_bytes(writer, "\n", 1);
}

/* A name in its place of a block. */
static void fill_up(char filled[NAME], const char *name) {
  for (size_t k = 0; k < NAME; k++)
    filled[k] = *name ? *name++ : 0;
}

/* => where its items begin; close_block counts them. */
static size_t open_block(Writer *writer, const char *name, size_t width) {
  char filled[NAME];
  fill_up(filled, name);
  write_bytes(writer, filled, NAME);
  write_integer(writer, width);
  write_integer(writer, 0);
  return writer->used;
}

static void close_block(const Writer *writer, size_t begin, size_t width) {
  if (writer->byte) put(writer->byte + begin - 8, 8, (writer->used - begin) / width);
}

static void write_text(Writer *writer, const char *name, const char *text) {
  size_t begin = open_block(writer, name, 1);
  write_bytes(writer, text, strlen(text));
  close_block(writer, begin, 1);
}

static void write_array(Writer *writer, const char *name, const double *value, size_t count) {
  size_t begin = open_block(writer, name, 8);
  for (size_t k = 0; k < count; k++)
    write_real(writer, value[k]);
  close_block(writer, begin, 8);
}

/* "ribbon.length", "electro.model = plates" */
static void print_line(const ZpActuatorDef *def, int index, char line[LINE]) {
  const ZpKey *key = zp_key(index);
  if (key->type == ZP_KEY_ENUM)
    snprintf(line, LINE, "%s = %s", key->name, key->choices[(int)zp_def_get(def, index)].word);
  else
    snprintf(line, LINE, "%s", key->name);
}

static void write_model(Writer *writer, const ZpActuatorDef *def) {
  char line[LINE];
  size_t names = open_block(writer, "model.names", 1);
  for (int i = 0; i < zp_key_count(); i++) {
    if (!zp_checkpoint_holds(i)) continue;
    print_line(def, i, line);
    write_line(writer, line);
  }
  close_block(writer, names, 1);
  size_t values = open_block(writer, "model.values", 8);
  for (int i = 0; i < zp_key_count(); i++)
    if (zp_checkpoint_holds(i)) write_real(writer, zp_def_get(def, i));
  close_block(writer, values, 8);
}

static void write_state(Writer *writer, const ZpModel *model, const ZpState *state) {
  size_t names = open_block(writer, "state.names", 1);
  for (size_t k = 0; k < NUMBERS; k++)
    write_line(writer, number[k].name);
  for (size_t k = 0; k < model->ledger.rows; k++)
    write_line(writer, model->ledger.row[k]->name);
  close_block(writer, names, 1);
  const double *ledger = zp_state_memory(model, state) + model->kept;
  size_t values = open_block(writer, "state.values", 8);
  for (size_t k = 0; k < NUMBERS; k++)
    write_real(writer, number_of(state, k));
  for (size_t k = 0; k < model->ledger.rows; k++)
    write_real(writer, ledger[k]);
  close_block(writer, values, 8);
  for (size_t k = 0; k < ARRAYS; k++)
    write_array(writer, array[k], state->data + 2 * k * model->stride, length_of(model, k));
}

static size_t head_size(const ZpModel *model) {
  Writer counter = {NULL, HEADER};
  write_text(&counter, "zipact", ZP_VERSION);
  write_model(&counter, &model->def);
  return counter.used;
}

static size_t size_of(const ZpModel *model) {
  size_t size = head_size(model) + 2 * (size_t)BLOCK;
  for (size_t k = 0; k < model->ledger.rows; k++)
    size += strlen(model->ledger.row[k]->name) + 1 + sizeof(double);
  for (size_t k = 0; k < NUMBERS; k++)
    size += strlen(number[k].name) + 1 + sizeof(double);
  for (size_t k = 0; k < ARRAYS; k++)
    size += BLOCK + length_of(model, k) * sizeof(double);
  return size;
}

static void write_one(const ZpModel *model, const ZpState *state, void *bytes) {
  unsigned char *byte = bytes;
  Writer writer = {byte, HEADER};
  write_text(&writer, "zipact", ZP_VERSION);
  write_model(&writer, &model->def);
  write_state(&writer, model, state);
  memcpy(byte, magic, MAGIC);
  put(byte + MAGIC, 4, VERSION);
  put(byte + SUMMED, 8, writer.used);
  put(byte + SUM, 4, checksum(byte + SUMMED, writer.used - SUMMED));
}

/* -- reading --------------------------------------------------------------------------------------- */

typedef struct Block {
  const unsigned char *item;
  size_t count;
} Block;

/* A whole snapshot, taken apart. */
typedef struct Parts {
  Block program, key, value, name, number, array[ARRAYS];
} Parts;

static ZpStatus check_frame(const unsigned char *byte, size_t size, ZpError *err) {
  size_t known = size < MAGIC ? size : MAGIC;
  if (known == 0 || memcmp(byte, magic, known) != 0) return zp_fail(err, ZP_BAD_INPUT, "not a snapshot of zipact");
  if (size < HEADER) return zp_fail(err, ZP_BAD_INPUT, "cut short: %zu bytes, not even a header", size);
  uint64_t version = get(byte + MAGIC, 4), whole = get(byte + SUMMED, 8);
  if (version != VERSION)
    return zp_fail(err, ZP_BAD_INPUT, "of version %llu of the format; zipact %s reads version %d",
                   (unsigned long long)version, ZP_VERSION, VERSION);
  if (size < whole) return zp_fail(err, ZP_BAD_INPUT, "cut short: %zu of %llu bytes", size, (unsigned long long)whole);
  if (size > whole) return zp_fail(err, ZP_BAD_INPUT, "damaged: its length is not what its header says");
  if (get(byte + SUM, 4) != checksum(byte + SUMMED, size - SUMMED))
    return zp_fail(err, ZP_BAD_INPUT, "damaged: its checksum is wrong");
  return ZP_OK;
}

/* The block at *used, if it is the one of that name; *used moves behind it. */
static bool take_block(const unsigned char *byte, size_t size, size_t *used, const char *name, size_t width,
                       Block *block) {
  char filled[NAME];
  const unsigned char *head = byte + *used;
  fill_up(filled, name);
  if (size - *used < BLOCK || memcmp(head, filled, NAME) != 0 || get(head + NAME, 8) != width) return false;
  uint64_t count = get(head + NAME + 8, 8);
  *used += BLOCK;
  if (count > (size - *used) / width) return false;
  *block = (Block){byte + *used, (size_t)count};
  *used += width * (size_t)count;
  return true;
}

/* (bytes) => parts */
static ZpStatus take_apart(const void *bytes, size_t size, Parts *parts, ZpError *err) {
  const unsigned char *byte = bytes;
  ZpStatus status = check_frame(byte, size, err);
  if (status != ZP_OK) return status;
  size_t used = HEADER;
  bool whole = take_block(byte, size, &used, "zipact", 1, &parts->program) &&
               take_block(byte, size, &used, "model.names", 1, &parts->key) &&
               take_block(byte, size, &used, "model.values", 8, &parts->value) &&
               take_block(byte, size, &used, "state.names", 1, &parts->name) &&
               take_block(byte, size, &used, "state.values", 8, &parts->number);
  for (size_t k = 0; k < ARRAYS; k++)
    whole = whole && take_block(byte, size, &used, array[k], 8, &parts->array[k]);
  whole = whole && used == size && parts->number.count >= NUMBERS;
  return whole ? ZP_OK : zp_fail(err, ZP_BAD_INPUT, "damaged: its blocks are not those of a snapshot");
}

/* The next line of a text => line, a long one cut; false at its end. */
static bool take_line(Block *text, char line[LINE]) {
  size_t length = 0;
  while (length < text->count && text->item[length] != '\n')
    length++;
  if (length == text->count) return false;
  snprintf(line, LINE, "%.*s", (int)(length < LINE ? length : LINE - 1), (const char *)text->item);
  text->item += length + 1;
  text->count -= length + 1;
  return true;
}

static void print_value(int index, double value, char *text, size_t size) {
  const ZpKey *key = zp_key(index);
  bool bare = strcmp(key->unit, "1") == 0;
  if (key->type == ZP_KEY_BOOL)
    snprintf(text, size, "%s", value != 0 ? "true" : "false");
  else if (isnan(value))
    snprintf(text, size, "%s", key->text);
  else
    snprintf(text, size, "%.15g%s%s", value, bare ? "" : " ", bare ? "" : key->unit);
}

static ZpStatus fail_version(const Block *program, const char *what, ZpError *err) {
  int length = program->count < 20 ? (int)program->count : 20;
  return zp_fail(err, ZP_BAD_INPUT, "of a version of zipact with other %s: of %.*s; this is %s", what, length,
                 (const char *)program->item, ZP_VERSION);
}

static ZpStatus fail_model(const char *key, const char *there, const char *here, ZpError *err) {
  return zp_fail(err, ZP_BAD_INPUT, "of another model: %s is %s there, %s here", key, there, here);
}

/* Key `index`, with its line and value there, against that of `def`. */
static ZpStatus check_key(const Parts *parts, const ZpActuatorDef *def, int index, const char *line, double value,
                          ZpError *err) {
  const char *name = zp_key(index)->name;
  char here[LINE];
  print_line(def, index, here);
  size_t length = strlen(name);
  if (strcmp(line, here) != 0) {
    bool choice = strncmp(line, here, length + 3) == 0 && strchr(here, '=');
    return choice ? fail_model(name, line + length + 3, here + length + 3, err)
                  : fail_version(&parts->program, "keys", err);
  }
  double mine = zp_def_get(def, index);
  if (value == mine || (isnan(value) && isnan(mine))) return ZP_OK;
  char there[64], ours[64];
  print_value(index, value, there, sizeof there);
  print_value(index, mine, ours, sizeof ours);
  return fail_model(name, there, ours, err);
}

static ZpStatus check_keys(const Parts *parts, const ZpActuatorDef *def, ZpError *err) {
  Block text = parts->key;
  char line[LINE];
  size_t k = 0;
  for (int i = 0; i < zp_key_count(); i++) {
    if (!zp_checkpoint_holds(i)) continue;
    if (k == parts->value.count || !take_line(&text, line)) return fail_version(&parts->program, "keys", err);
    ZpStatus status = check_key(parts, def, i, line, real_at(parts->value.item, k++), err);
    if (status != ZP_OK) return status;
  }
  bool all = text.count == 0 && k == parts->value.count;
  return all ? ZP_OK : fail_version(&parts->program, "keys", err);
}

/* Can it be a voltage, or a rate of `per_time` such voltages per second? A charge that is kept while its faces part
 * raises the voltage of a drive by the ratio of the capacitances. */
static bool is_voltage(double value, double per_time) {
  static const double raised = 1e3;
  return fabs(value) <= raised * zp_key(zp_key_find("drive.voltage"))->max * per_time;
}

/* Can item k be this number, in a state of time t? Other numbers would index beyond arrays or stop the clock, or no run
 * has them. */
static bool is_possible(size_t k, double value, double t, const ZpActuatorDef *def) {
  static const double most_input = 1e15; /* SI: larger than every range of an input and its rate */
  static const double rounding = 1e-9;   /* of the time */
  switch (number[k].kind) {
  case FLAG:
    return value == 0 || value == 1;
  case NODE:
    return value >= 0 && value < def->mesh.nodes && value == floor(value);
  case MODE:
    return value == ZP_FEED_FREE || value == ZP_FEED_GIVES_MOST || value == ZP_FEED_SINKS_MOST ||
           value == ZP_FEED_SPILLS;
  case VOLTAGE:
    return is_voltage(value, 1);
  case RATE:
    return is_voltage(value, 1 / ZP_FEED_SHORTEST);
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
    return isfinite(value) && (k != TIME || value >= 0);
  }
}

static double value_of(const Parts *parts, const char *name) {
  size_t k = 0;
  while (strcmp(number[k].name, name) != 0)
    k++;
  return real_at(parts->number.item, k);
}

static ZpStatus check_control(const Parts *parts, const ZpActuatorDef *def, ZpError *err) {
  const ZpControl control = zp_control_of(def);
  const ZpControlState samples = {.taken = value_of(parts, "control.taken"), .given = value_of(parts, "control.given")};
  bool fits = zp_control_fits(&control, value_of(parts, "t"), &samples);
  return fits ? ZP_OK : zp_fail(err, ZP_BAD_INPUT, "samples of its controller do not fit its time");
}

static ZpStatus check_numbers(const Parts *parts, const ZpActuatorDef *def, ZpError *err) {
  Block text = parts->name;
  char line[LINE];
  for (size_t k = 0; k < NUMBERS; k++)
    if (!take_line(&text, line) || strcmp(line, number[k].name) != 0)
      return fail_version(&parts->program, "numbers", err);
  const double t = real_at(parts->number.item, TIME);
  for (size_t k = 0; k < NUMBERS; k++) {
    const double value = real_at(parts->number.item, k);
    if (!is_possible(k, value, t, def))
      return zp_fail(err, ZP_BAD_INPUT, "its numbers are not a state of an actuator: %s = %g", number[k].name, value);
  }
  return check_control(parts, def, err);
}

static ZpStatus take_fitting(const ZpActuatorDef *def, const void *bytes, size_t size, Parts *parts, ZpError *err) {
  ZpStatus status = take_apart(bytes, size, parts, err);
  if (status == ZP_OK) status = check_keys(parts, def, err);
  return status == ZP_OK ? check_numbers(parts, def, err) : status;
}

/* -- several ---------------------------------------------------------------------------------------- */

/* If another snapshot follows the first: the number of bytes of the first; else all. */
static size_t first_of(const unsigned char *byte, size_t size) {
  if (size < HEADER || memcmp(byte, magic, MAGIC) != 0) return size;
  uint64_t whole = get(byte + SUMMED, 8);
  bool more = whole >= HEADER && whole < size && size - whole >= MAGIC && memcmp(byte + whole, magic, MAGIC) == 0;
  return more ? (size_t)whole : size;
}

static size_t count(const unsigned char *byte, size_t size) {
  size_t sections = 0;
  for (size_t used = 0; used < size || sections == 0; sections++)
    used += first_of(byte + used, size - used);
  return sections;
}

static ZpStatus check_count(const void *bytes, size_t size, size_t members, ZpError *err) {
  size_t there = count(bytes, size);
  if (there == members) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "of another model: it has %zu members, %zu here", there, members);
}

size_t zp_snapshot_size(const ZpModel *model) {
  size_t size = 0;
  for (; model; model = model->below)
    size += size_of(model);
  return size;
}

void zp_snapshot_write(const ZpModel *model, ZpState *const state[], void *bytes) {
  unsigned char *byte = bytes;
  for (; model; byte += size_of(model), model = model->below)
    write_one(model, *state++, byte);
}

ZpStatus zp_snapshot_check(const void *bytes, size_t size, ZpError *err) {
  const unsigned char *byte = bytes;
  ZpStatus status = ZP_OK;
  for (bool first = true; status == ZP_OK && (size > 0 || first); first = false) {
    Parts parts;
    size_t own = first_of(byte, size);
    status = take_apart(byte, own, &parts, err);
    byte += own;
    size -= own;
  }
  return status;
}

ZpStatus zp_snapshot_fits(const ZpActuatorDef *def, const void *bytes, size_t size, ZpError *err) {
  const unsigned char *byte = bytes;
  bool many = zp_def_members(def) > 1;
  ZpStatus status = zp_snapshot_check(bytes, size, err);
  if (status == ZP_OK) status = check_count(bytes, size, (size_t)zp_def_members(def), err);
  for (int member = 1; member <= zp_def_members(def) && status == ZP_OK; member++) {
    Parts parts;
    size_t own = first_of(byte, size);
    ZpActuatorDef one = many ? zp_def_member(def, member) : *def;
    status = take_fitting(&one, byte, own, &parts, err);
    byte += own;
    size -= own;
  }
  return status;
}

double zp_snapshot_time(const void *bytes, size_t size) {
  Parts parts;
  return take_apart(bytes, first_of(bytes, size), &parts, NULL) == ZP_OK ? real_at(parts.number.item, TIME) : NAN;
}

/* Behind the numbers: are there the rows of the model's ledger? */
static ZpStatus check_rows(const Parts *parts, const ZpLedger *ledger, ZpError *err) {
  Block text = parts->name;
  char line[LINE];
  bool same = parts->number.count == NUMBERS + ledger->rows;
  for (size_t k = 0; same && k < parts->number.count; k++) {
    same = take_line(&text, line) && (k < NUMBERS || strcmp(line, ledger->row[k - NUMBERS]->name) == 0);
    if (same && !isfinite(real_at(parts->number.item, k)) && k >= NUMBERS)
      return zp_fail(err, ZP_BAD_INPUT, "its numbers are not a state of an actuator: %s is not finite", line);
  }
  return same ? ZP_OK : fail_version(&parts->program, "rows", err);
}

static ZpStatus read_one(const ZpModel *model, const void *bytes, size_t size, ZpState *state, ZpError *err) {
  Parts parts;
  ZpStatus status = take_fitting(&model->def, bytes, size, &parts, err);
  if (status != ZP_OK) return status;
  for (size_t k = 0; k < ARRAYS; k++)
    if (parts.array[k].count != length_of(model, k))
      return zp_fail(err, ZP_BAD_INPUT, "%zu numbers for %s: a state of this model has %zu", parts.array[k].count,
                     array[k], length_of(model, k));
  status = check_rows(&parts, &model->ledger, err);
  if (status != ZP_OK) return status;
  for (size_t k = 0; k < NUMBERS; k++)
    set_number(state, k, real_at(parts.number.item, k));
  for (size_t k = 0; k < ARRAYS; k++)
    for (size_t j = 0; j < length_of(model, k); j++)
      state->data[2 * k * model->stride + j] = real_at(parts.array[k].item, j);
  for (size_t k = 0; k < model->ledger.rows; k++)
    zp_state_ledger(model, state)[k] = real_at(parts.number.item, NUMBERS + k);
  return ZP_OK;
}

ZpStatus zp_snapshot_read(const ZpModel *model, const void *bytes, size_t size, ZpState *const state[], ZpError *err) {
  const unsigned char *byte = bytes;
  ZpStatus status = zp_snapshot_check(bytes, size, err);
  if (status == ZP_OK) status = check_count(bytes, size, zp_members(model), err);
  for (; model && status == ZP_OK; model = model->below) {
    size_t own = first_of(byte, size);
    status = read_one(model, byte, own, *state++, err);
    byte += own;
    size -= own;
  }
  return status;
}
