/* Values of the interpreter => keys of a scenario. They are converted to texts, which the library reads and checks as
 * those of the command. */
#include "binding.h"

#include <stdio.h>
#include <string.h>

/* -- texts --------------------------------------------------------------------------------------------- */

char *text_of(const mxArray *value, const char *what) {
  size_t count = mxGetNumberOfElements(value);
  if (!mxIsChar(value) || mxGetNumberOfDimensions(value) != 2 || (count && mxGetM(value) != 1))
    fail_input("%.80s: takes a text", what);
  const mxChar *character = mxGetChars(value);
  for (size_t i = 0; i < count; i++)
    if (character[i] >= 0 && character[i] < ' ') fail_input("%.80s: a control character in a text", what);
  char *text = count ? mxArrayToString(value) : mxCalloc(1, 1);
  if (!text) fail_memory();
  return text;
}

/* A growing text, in the memory of the interpreter. */
typedef struct Text {
  char *start;
  size_t used, size;
} Text;

static void append(Text *text, const char *piece) {
  size_t length = strlen(piece);
  if (text->used + length + 1 > text->size) {
    text->size = 2 * text->size + length + 1;
    text->start = mxRealloc(text->start, text->size);
  }
  memcpy(text->start + text->used, piece, length + 1);
  text->used += length;
}

/* In single quotes every character of a text stands for itself. */
static void append_quoted(Text *text, const char *words) {
  append(text, "'");
  for (; *words; words++)
    append(text, *words == '\'' ? "''" : (char[]){*words, 0});
  append(text, "'");
}

static void append_number(Text *text, double value) {
  char digits[32];
  snprintf(digits, sizeof digits, "%.17g", value);
  append(text, digits);
}

/* -- values -------------------------------------------------------------------------------------------- */

static bool is_plain(const mxArray *value) {
  return !mxIsComplex(value) && !mxIsSparse(value) && mxGetNumberOfDimensions(value) == 2 &&
         mxGetNumberOfElements(value) > 0 && (mxGetM(value) == 1 || mxGetN(value) == 1);
}

static const double *doubles_of(const mxArray *value) {
  mxArray *given = (mxArray *)value, *converted;
  if (mxIsDouble(value)) return mxGetPr(value);
  if (mexCallMATLAB(1, &converted, 1, &given, "double")) fail_memory();
  return mxGetPr(converted);
}

static void append_one(Text *text, const char *what, const mxArray *value) {
  bool one = is_plain(value) && mxGetNumberOfElements(value) == 1;
  if (mxIsChar(value))
    append_quoted(text, text_of(value, what));
  else if (one && mxIsLogical(value))
    append(text, mxIsLogicalScalarTrue(value) ? "true" : "false");
  else if (one && mxIsNumeric(value))
    append_number(text, doubles_of(value)[0]);
  else
    fail_input("%.80s: takes a number, a text as '20 g', true or false, or a vector or cell of them", what);
}

static void append_numbers(Text *text, const mxArray *value) {
  const double *number = doubles_of(value);
  for (size_t i = 0; i < mxGetNumberOfElements(value); i++) {
    append(text, i ? ", " : "[");
    append_number(text, number[i]);
  }
  append(text, "]");
}

static void append_cell(Text *text, const char *what, const mxArray *cell) {
  for (size_t i = 0; i < mxGetNumberOfElements(cell); i++) {
    const mxArray *value = mxGetCell(cell, i);
    append(text, i ? ", " : "[");
    if (!value) fail_input("%.80s: an empty cell", what);
    append_one(text, what, value);
  }
  append(text, "]");
}

static void append_value(Text *text, const char *what, const mxArray *value) {
  if (mxIsCell(value) && is_plain(value))
    append_cell(text, what, value);
  else if (mxIsNumeric(value) && is_plain(value) && mxGetNumberOfElements(value) > 1)
    append_numbers(text, value);
  else
    append_one(text, what, value);
}

double quantity_of(const char *key, const char *name, const mxArray *value) {
  Text text = {0};
  ZpError err;
  double number;
  if (mxIsChar(value))
    append(&text, text_of(value, name));
  else if (mxIsNumeric(value) && is_plain(value) && mxGetNumberOfElements(value) == 1)
    append_number(&text, doubles_of(value)[0]);
  else
    fail_input("%s: takes a number or a text with a unit", name);
  if (zp_value_parse(zp_key_find(key), text.start, &number, &err) == ZP_OK) return number;
  fail_input("%s%s", name, err.message + strlen(key)); /* messages start with the name of the key */
}

/* -- keys ---------------------------------------------------------------------------------------------- */

/* Does it name bodies, joints, members or springs, one of them, or one of its keys? */
static bool is_named(const char *name) {
  static const char *const group[] = {"bodies", "joints", "members", "springs"};
  const size_t length = strcspn(name, ".");
  bool found = false;
  for (size_t i = 0; i < sizeof group / sizeof *group; i++)
    found |= strlen(group[i]) == length && strncmp(name, group[i], length) == 0;
  return found;
}

/* A value, or a struct of values as {'mass': 0.02, 'drive': {...}}. */
static void append_fields(Text *text, const char *what, const mxArray *value) {
  if (!mxIsStruct(value)) {
    append_value(text, what, value);
    return;
  }
  if (mxGetNumberOfElements(value) != 1) fail_input("%.80s: takes one struct, not an array", what);
  append(text, "{");
  for (int i = 0; i < mxGetNumberOfFields(value); i++) {
    const char *name = mxGetFieldNameByNumber(value, i);
    const mxArray *inner = mxGetFieldByNumber(value, 0, i);
    Text path = {0};
    append(&path, what), append(&path, "."), append(&path, name);
    if (!inner) fail_input("%.80s: no value", path.start);
    append(text, i ? ", " : "");
    append_quoted(text, name);
    append(text, ": ");
    append_fields(text, path.start, inner);
  }
  append(text, "}");
}

/* The names of a network are read as those of a file. */
static void set_named(const char *name, const mxArray *value) {
  Text text = {0};
  ZpError err;
  append_quoted(&text, name);
  append(&text, ": ");
  append_fields(&text, name, value);
  const ZpStatus status = zp_scenario_override(call.scenario, text.start, strlen(text.start), "struct", &err);
  const char *reason = status == ZP_BAD_INPUT ? strstr(err.message, ": ") : NULL; /* without a line */
  if (reason) fail_input("%s", reason + 2);
  if (status != ZP_OK) fail(&err);
}

static void set_key(const char *name, const mxArray *value) {
  Text text = {0};
  ZpError err;
  int key = zp_key_find(name);
  if (is_named(name)) {
    set_named(name, value);
    return;
  }
  if (key < 0) {
    char reason[256];
    zp_key_unknown(name, reason, sizeof reason);
    fail_input("%.80s: %s", name, reason);
  }
  if (zp_key(key)->type == ZP_KEY_TEXT && !mxIsChar(value)) fail_input("%s: takes a text", name);
  append(&text, name);
  append(&text, "=");
  append_value(&text, name, value);
  if (zp_scenario_set(call.scenario, text.start, &err) != ZP_OK) fail(&err);
}

/* The fields of a struct: keys, or groups of keys, which are structs; NULL is the group of all. */
static void set_fields(const mxArray *fields, const char *group) {
  if (mxGetNumberOfElements(fields) != 1) fail_input("%.80s: takes one struct, not an array", group ? group : "keys");
  for (int i = 0; i < mxGetNumberOfFields(fields); i++) {
    const mxArray *value = mxGetFieldByNumber(fields, 0, i);
    const char *name = mxGetFieldNameByNumber(fields, i);
    Text key = {0};
    if (group) append(&key, group), append(&key, ".");
    append(&key, name);
    if (!value) fail_input("%.80s: no value", key.start);
    if (mxIsStruct(value) && zp_key_find(key.start) < 0 && !is_named(key.start))
      set_fields(value, key.start);
    else
      set_key(key.start, value);
  }
}

static void read_file(const char *path) {
  ZpError err;
  if (zp_key_find(path) >= 0) fail_input("%s: no value; keys and values come in pairs", path);
  if (zp_scenario_read(call.scenario, path, &err) != ZP_OK) fail(&err);
}

void read_scenario(int count, const mxArray *const *value) {
  int first = count % 2;
  call.scenario = zp_scenario_create();
  if (!call.scenario) fail_memory();
  if (first && mxIsStruct(value[0]))
    set_fields(value[0], NULL);
  else if (first)
    read_file(text_of(value[0], "scenario file or struct of keys"));
  for (int i = first; i < count; i += 2)
    set_key(text_of(value[i], "key"), value[i + 1]);
}

const ZpActuatorDef *read_def(size_t row) {
  ZpError err;
  if (!call.def) call.def = zp_def_create();
  if (zp_scenario_def(call.scenario, row, call.def, &err) != ZP_OK) fail(&err);
  return call.def;
}
