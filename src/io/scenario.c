/* Scenarios: values for keys, some of them lists, from a file and from --set.
 *
 * Two layers of slots, one slot per key, hold the values of the file and those of --set; the second layer wins,
 * whatever the order of calls. A third layer, below both, has the distributions of materials for sampling.tolerances.
 * Nothing is resolved before a Def is requested, so the position of `preset` in the file does not matter. A text is
 * first read into its own layer and then exchanged slot by slot with the layer that it changes; a second exchange
 * undoes it, so a failure leaves the scenario unchanged. io/plan.h lists the Defs of a scenario. Their common values
 * are resolved once, when keys are given; a case only sets the varied keys. */
#include <zipact/io.h>

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/fail.h"
#include "def/def.h"
#include "io/file.h"
#include "io/plan.h"
#include "io/range.h"
#include "io/source.h"
#include "io/value.h"
#include "io/yaml.h"

struct ZpScenario {
  ZpSlot file[ZP_KEYS];        /* from files */
  ZpSlot set[ZP_KEYS];         /* from --set; they override those from files */
  ZpSlot drawn[ZP_KEYS];       /* of materials; both others override them. A value is its own distribution */
  const ZpSlot *held[ZP_KEYS]; /* the slot of the layer that applies */
  ZpPlan plan;
  ZpActuatorDef common; /* the first case; the others set their varied keys in it, unless these affect further keys */
  bool has_common;
  char *name; /* name of the last file, NULL if none */
};

enum { DEPTHS = 2 }; /* groups and nested groups, such as lower and lower.ribbon */

/* A text being read into slots. */
typedef struct Reader {
  const ZpSource *source;
  int key; /* key of --set; -1 if the text contains the keys */
  ZpSlot slot[ZP_KEYS];
  int line[ZP_KEYS];               /* line in which the key was given; 0: not yet */
  int group_line[ZP_KEYS][DEPTHS]; /* line in which the group, and the nested one, was opened whose first key this is;
                                    * 0: not yet */
  int part_key;                    /* key whose range is being read, if there is a part */
  ZpParts parts; /* of the range or distribution that is being read, {from: ..., to: ...}; NULL: not given */
} Reader;

static void free_slots(ZpSlot slot[ZP_KEYS]) {
  for (size_t i = 0; i < ZP_KEYS; i++) {
    free(slot[i].value);
    free(slot[i].text);
  }
}

/* A definition with the given materials and sampling.tolerances, otherwise with defaults. */
static ZpActuatorDef materials_of(const ZpScenario *s) {
  ZpActuatorDef def = zp_actuator_def_default();
  for (size_t i = 0; i < ZP_KEYS; i++) {
    const bool asked = zp_key_is_material((int)i) || strcmp(zp_key((int)i)->name, "sampling.tolerances") == 0;
    if (asked && s->held[i]->count) zp_def_set(&def, (int)i, s->held[i]->value[0], NULL);
  }
  return def;
}

/* Give the distribution of a material to keys that it fills and that are not given. */
static void draw_materials(ZpScenario *s) {
  const ZpActuatorDef def = materials_of(s);
  for (size_t i = 0; i < ZP_KEYS; i++) {
    const ZpMaterialValue *filled = zp_material_value(&def, (int)i);
    if (!filled || s->held[i]->count || def.sampling.tolerances != ZP_TOLERANCES_MATERIALS) continue;
    ZpSlot *slot = &s->drawn[i];
    *slot = (ZpSlot){.count = 1, .spread = {ZP_DISTRIBUTION_LOGNORMAL, filled->value, filled->spread}};
    slot->value = &slot->spread.a;
    s->held[i] = slot;
  }
}

/* --set wins over the file. */
static void hold(ZpScenario *s) {
  for (size_t i = 0; i < ZP_KEYS; i++)
    s->held[i] = s->set[i].count ? &s->set[i] : &s->file[i];
  draw_materials(s);
}

/* Set the texts; nothing else depends on them. */
static ZpStatus set_texts(const ZpScenario *s, ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = ZP_OK;
  for (size_t i = 0; i < ZP_KEYS && status == ZP_OK; i++) {
    const char *text = s->held[i]->text;
    if (text) status = zp_def_set_text(def, (int)i, text, err);
  }
  return status;
}

/* Make a case from all given values. */
static ZpStatus resolve_whole(const ZpScenario *s, const double *value, ZpActuatorDef *def, ZpError *err) {
  ZpAssignment list[ZP_KEYS];
  ZpStatus status = zp_def_resolve(def, list, zp_plan_assign(&s->plan, s->held, value, list), err);
  return status == ZP_OK ? set_texts(s, def, err) : status;
}

/* Make a case from the common values. Keys are set in the order of zp_plan_assign, so the same key is refused first. */
static ZpStatus resolve_varied(const ZpScenario *s, const double *value, ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = ZP_OK;
  *def = s->common;
  for (size_t v = s->plan.variations; v-- > 0 && status == ZP_OK;)
    status = zp_def_set(def, s->plan.varied[v], value[v], err);
  return status;
}

static ZpStatus resolve(const ZpScenario *s, size_t index, ZpActuatorDef *def, ZpError *err) {
  double value[ZP_KEYS];
  zp_plan_values(&s->plan, s->held, index, value);
  return s->has_common ? resolve_varied(s, value, def, err) : resolve_whole(s, value, def, err);
}

/* Resolve the common values of the cases, unless a varied key determines values of keys that are not given: a preset
 * has values for certain mesh.nodes, and all other such keys are words. If the first case cannot be resolved, the
 * request for it reports the reason. */
static void find_common(ZpScenario *s) {
  bool moves = false;
  for (size_t v = 0; v < s->plan.variations; v++) {
    const ZpKey *key = zp_key(s->plan.varied[v]);
    moves |= key->type == ZP_KEY_ENUM || key->type == ZP_KEY_BOOL || strcmp(key->name, "mesh.nodes") == 0;
  }
  s->has_common = false;
  s->has_common = !moves && resolve(s, 0, &s->common, NULL) == ZP_OK;
}

ZpScenario *zp_scenario_create(void) {
  ZpScenario *s = calloc(1, sizeof *s);
  if (!s) return NULL;
  hold(s);
  zp_plan_make(&s->plan, s->held, NULL); /* which cannot fail: nothing is given */
  find_common(s);
  return s;
}

void zp_scenario_destroy(ZpScenario *s) {
  if (!s) return;
  free_slots(s->file);
  free_slots(s->set);
  free(s->name);
  free(s);
}

/* Exchange the slots that were read with those of a layer. */
static void exchange(Reader *reader, ZpSlot *layer) {
  for (size_t i = 0; i < ZP_KEYS; i++) {
    if (!reader->line[i]) continue;
    ZpSlot kept = layer[i];
    layer[i] = reader->slot[i];
    reader->slot[i] = kept;
  }
}

/* Replace the values of the same keys in `layer` by those that were read. */
static ZpStatus merge(ZpScenario *s, Reader *reader, ZpSlot *layer, ZpError *err) {
  ZpError reason;
  exchange(reader, layer);
  hold(s);
  if (zp_plan_make(&s->plan, s->held, &reason) == ZP_OK) {
    find_common(s);
    return ZP_OK;
  }
  exchange(reader, layer);
  hold(s);
  zp_plan_make(&s->plan, s->held, NULL); /* restored */
  return zp_source_fail(reader->source, 0, err, "%s", reason.message);
}

/* Forget the parts of a range. */
static void drop_parts(Reader *reader) {
  for (size_t i = 0; i < ZP_PARTS; i++) {
    free(reader->parts.text[i]);
    reader->parts.text[i] = NULL;
  }
}

static void close_reader(Reader *reader) {
  drop_parts(reader);
  free_slots(reader->slot);
}

#define GROUP_WITHOUT_VALUE "a group of keys cannot have a value; give one of its keys, such as %s"

/* First key of the group `path`, -1 if it is not a group. */
static int first_of_group(const char *path) {
  size_t length = strlen(path);
  for (int i = 0; i < zp_key_count(); i++)
    if (strncmp(zp_key(i)->name, path, length) == 0 && zp_key(i)->name[length] == '.') return i;
  return -1;
}

/* "FILE:LINE: PATH: reason" */
__attribute__((format(printf, 5, 6))) static ZpStatus fail_at(const Reader *reader, const char *path, int line,
                                                              ZpError *err, const char *format, ...) {
  char reason[sizeof err->message];
  va_list args;
  va_start(args, format);
  vsnprintf(reason, sizeof reason, format, args);
  va_end(args);
  return zp_source_fail(reader->source, line, err, "%.80s: %s", path, reason);
}

static ZpStatus fail_unknown(const Reader *reader, const ZpYamlItem *item, ZpError *err) {
  char reason[ZP_VALUE_SIZE];
  zp_key_unknown(item->path, reason, sizeof reason);
  return fail_at(reader, item->path, item->line, err, "%s", reason);
}

/* `first`: line in which the item was given first, 0: not yet. */
static ZpStatus check_first(const Reader *reader, const ZpYamlItem *item, int first, ZpError *err) {
  return first ? fail_at(reader, item->path, item->line, err, "given twice, first in line %d", first) : ZP_OK;
}

/* The parts of a range or a distribution are in their own group: parts that remain at its end are a mistake. */
static ZpStatus check_no_parts(const Reader *reader, int key, int line, ZpError *err) {
  bool any = false;
  for (size_t i = 0; i < ZP_PARTS; i++)
    any |= reader->parts.text[i] != NULL;
  if (!any || reader->part_key == key) return ZP_OK;
  return fail_at(reader, zp_key(reader->part_key)->name, line, err,
                 "write a range as {from: ..., to: ..., count: ...}, a distribution as {normal: ..., sigma: ...}");
}

static ZpStatus take_group(Reader *reader, const ZpYamlItem *item, ZpError *err) {
  if (*item->path == 0) return check_no_parts(reader, -1, item->line, err);
  int first = first_of_group(item->path);
  if (first < 0) return fail_unknown(reader, item, err);
  int *line = &reader->group_line[first][strchr(item->path, '.') != NULL];
  ZpStatus status = check_first(reader, item, *line, err);
  *line = item->line;
  return status;
}

/* -- values ---------------------------------------------------------------------------------------- */

/* The numbers of a slot; false if there is no memory. */
static bool make_room(ZpSlot *slot, size_t count) {
  slot->value = calloc(count, sizeof *slot->value);
  slot->count = count;
  return slot->value != NULL;
}

static bool is_absolute(const char *path) {
#ifdef _WIN32
  if (isalpha((unsigned char)path[0]) && path[1] == ':') return true;
#endif
  return *path == '/';
}

/* The path of a file in a scenario is relative to the folder of that scenario, in --set to the current folder; it is
 * kept as an absolute path, so that the written scenario finds the file from any folder. => `length` bytes of `path` as
 * a path, to be freed. */
static char *absolute_path(const ZpSource *source, const char *path, int length) {
  const char *slash = source->argument ? NULL : strrchr(source->name, '/');
  int folder = slash ? (int)(slash - source->name) + 1 : 0;
  if (length == 0 || is_absolute(path)) return strndup(path, (size_t)length);
  char *here = slash == NULL || !is_absolute(source->name) ? getcwd(NULL, 0) : strdup("");
  char *whole = NULL;
  const char *between = here && *here && strcmp(here, "/") != 0 ? "/" : "";
  if (here && asprintf(&whole, "%s%s%.*s%.*s", here, between, folder, source->name, length, path) < 0) whole = NULL;
  free(here);
  return whole;
}

/* Absolute paths of several that are separated by semicolons. */
static char *absolute_paths(const ZpSource *source, const char *paths) {
  char *whole = strdup("");
  while (whole && *paths) {
    paths += strspn(paths, " ;");
    int length = (int)strcspn(paths, ";"), next = length;
    while (length > 0 && paths[length - 1] == ' ')
      length--;
    char *one = length > 0 ? absolute_path(source, paths, length) : strdup(""), *both = NULL;
    if (!one || asprintf(&both, "%s%s%s", whole, *whole && *one ? "; " : "", one) < 0) both = NULL;
    free(one);
    free(whole);
    whole = both;
    paths += next;
  }
  return whole;
}

static ZpStatus read_text(const ZpSource *source, int key, const char *word, ZpSlot *slot, ZpError *reason) {
  const ZpPaths paths = zp_key_paths(key);
  ZpActuatorDef scratch = zp_actuator_def_default();
  slot->text = paths == ZP_PATHS_SEVERAL ? absolute_paths(source, word)
               : paths == ZP_PATHS_ONE   ? absolute_path(source, word, (int)strlen(word))
                                         : strdup(word);
  if (!make_room(slot, 1) || !slot->text) return zp_fail_memory(reason);
  *slot->value = NAN;
  return zp_def_set_text(&scratch, key, slot->text, reason);
}

/* A range or a distribution. */
static ZpStatus read_parts(int key, const ZpParts *parts, ZpSlot *slot, ZpError *reason) {
  const char *from = parts->text[ZP_PART_FROM], *to = parts->text[ZP_PART_TO];
  slot->is_list = zp_parts_kind(parts) == ZP_DISTRIBUTION_NONE;
  if (slot->is_list) {
    slot->is_bare = (from && zp_value_is_bare(key, from)) || (to && zp_value_is_bare(key, to));
    return zp_range_read(key, parts, &slot->value, &slot->count, reason);
  }
  if (!make_room(slot, 1)) return zp_fail_memory(reason);
  ZpStatus status = zp_spread_read(key, parts, &slot->spread, reason);
  *slot->value = slot->spread.a;
  return status;
}

/* *word: the one that is wrong, if one is. */
static ZpStatus read_words(int key, const ZpYamlItem *item, const char **word, ZpSlot *slot, ZpError *reason) {
  ZpStatus status = make_room(slot, item->count) ? ZP_OK : zp_fail_memory(reason);
  slot->is_list = item->kind == ZP_YAML_LIST;
  for (size_t i = 0; i < item->count && status == ZP_OK; i++) {
    if (i > 0) *word += strlen(*word) + 1;
    slot->is_bare |= zp_value_is_bare(key, *word);
    status = zp_value_read(key, *word, &slot->value[i], reason);
  }
  return status;
}

static bool takes_spread(int key) {
  return zp_key(key)->type == ZP_KEY_REAL || zp_key(key)->type == ZP_KEY_REAL_AUTO;
}

/* A list or one value: "50 um", "10 um .. 200 um : 20", "normal(50 um, 1 um)". */
static ZpStatus read_value(int key, const ZpYamlItem *item, const char **word, ZpSlot *slot, ZpError *reason) {
  const bool alone = item->kind == ZP_YAML_VALUE && zp_value_is_number(zp_key(key));
  const bool ranges = alone && zp_range_is(item->word),
             spreads = alone && takes_spread(key) && zp_spread_is(item->word);
  char copy[ZP_VALUE_SIZE];
  ZpParts parts;
  if (!ranges && !spreads) return read_words(key, item, word, slot, reason);
  snprintf(copy, sizeof copy, "%s", item->word);
  ZpStatus status = ranges ? zp_range_split(copy, &parts, reason) : zp_spread_split(copy, &parts, reason);
  return status == ZP_OK ? read_parts(key, &parts, slot, reason) : status;
}

/* Report the wrong `word` of a value, which is all of it if `alone`, and its place. */
static ZpStatus fail_value(const Reader *reader, int key, int line, const char *word, const ZpError *reason, bool alone,
                           ZpError *err) {
  if (reason->status == ZP_MACHINE) return zp_fail(err, ZP_MACHINE, "%s", reason->message);
  if (zp_key(key)->type == ZP_KEY_TEXT || (reader->source->argument && alone))
    return zp_source_fail(reader->source, line, err, "%s", reason->message);
  if (!reader->source->argument)
    return zp_source_fail(reader->source, line, err, "%s = \"%.80s\": %s", zp_key(key)->name, word, reason->message);
  return zp_source_fail(reader->source, line, err, "\"%.80s\": %s", word, reason->message);
}

/* Take the slot of a key that was read with this status. */
static ZpStatus take_slot(Reader *reader, int key, int line, const ZpSlot *slot, ZpStatus status) {
  if (status == ZP_OK) {
    reader->slot[key] = *slot;
    reader->line[key] = line;
    return ZP_OK;
  }
  free(slot->value);
  free(slot->text);
  return status;
}

static ZpStatus check_shape(const Reader *reader, int key, const ZpYamlItem *item, ZpError *err) {
  const ZpKeyType type = zp_key(key)->type;
  const char *wrong = type == ZP_KEY_TEXT                          ? "takes one text, not a list"
                      : type == ZP_KEY_BOOL || type == ZP_KEY_ENUM ? "takes one word, not a list"
                      : item->count == 0                           ? "empty list; give at least one value"
                                                                   : NULL;
  return item->kind == ZP_YAML_LIST && wrong ? fail_at(reader, zp_key(key)->name, item->line, err, "%s", wrong) : ZP_OK;
}

static ZpStatus take_values(Reader *reader, int key, const ZpYamlItem *item, ZpError *err) {
  ZpSlot slot = {0};
  ZpError reason;
  const char *word = item->word;
  ZpStatus status = check_shape(reader, key, item, err);
  if (status != ZP_OK) return status;
  status = zp_key(key)->type == ZP_KEY_TEXT ? read_text(reader->source, key, word, &slot, &reason)
                                            : read_value(key, item, &word, &slot, &reason);
  if (status != ZP_OK) status = fail_value(reader, key, item->line, word, &reason, item->kind == ZP_YAML_VALUE, err);
  return take_slot(reader, key, item->line, &slot, status);
}

/* -- parts of a range or a distribution ------------------------------------------------------------ */

/* The key in the path of a part, "ribbon.length.from", and the part; -1 if it is not such a path. */
static int key_of_part(const char *path, size_t *part) {
  char name[ZP_VALUE_SIZE];
  const char *last = strrchr(path, '.');
  if (!last) return -1;
  snprintf(name, sizeof name, "%.*s", (int)(last - path), path);
  const int key = zp_key_find(name);
  for (*part = 0; key >= 0 && *part < ZP_PARTS; ++*part)
    if (strcmp(last + 1, zp_part_name[*part]) == 0) return key;
  return -1;
}

static ZpStatus take_part(Reader *reader, const ZpYamlItem *item, int key, size_t part, ZpError *err) {
  ZpStatus status = check_no_parts(reader, key, item->line, err);
  if (status != ZP_OK) return status;
  if (item->kind != ZP_YAML_VALUE) return fail_at(reader, item->path, item->line, err, "takes one value, not a list");
  if (reader->parts.text[part]) return fail_at(reader, item->path, item->line, err, "given twice");
  reader->part_key = key;
  reader->parts.text[part] = strdup(item->word);
  return reader->parts.text[part] ? ZP_OK : zp_fail_memory(err);
}

/* The end of {from: ..., to: ..., count: ...} or {normal: ..., sigma: ...}. */
static ZpStatus take_parts(Reader *reader, int key, const ZpYamlItem *item, ZpError *err) {
  ZpSlot slot = {0};
  ZpError reason;
  const ZpDistributionKind kind = zp_parts_kind(&reader->parts);
  const bool spreads = kind != ZP_DISTRIBUTION_NONE;
  if (spreads ? !takes_spread(key) : !zp_value_is_number(zp_key(key)))
    return fail_at(reader, item->path, item->line, err, "takes one value, not a %s",
                   spreads ? "distribution" : "range");
  ZpStatus status = check_first(reader, item, reader->line[key], err);
  if (status != ZP_OK) return status;
  const size_t first = zp_part_first(kind), second = zp_part_second(kind);
  for (size_t i = 0; i < ZP_PARTS && spreads; i++)
    if (reader->parts.text[i] && i != first && i != second)
      return fail_at(reader, item->path, item->line, err, "unknown part \"%s\"; write {%s: ..., %s: ...}",
                     zp_part_name[i], zp_part_name[first], zp_part_name[second]);
  status = read_parts(key, &reader->parts, &slot, &reason);
  if (status != ZP_OK) status = fail_value(reader, key, item->line, "{...}", &reason, true, err);
  drop_parts(reader);
  return take_slot(reader, key, item->line, &slot, status);
}

/* -- a text ---------------------------------------------------------------------------------------- */

/* A ZpYamlVisit. "ribbon:" without a value is a group without keys; with a value it is a mistake. */
static ZpStatus take_item(void *user, const ZpYamlItem *item, ZpError *err) {
  Reader *reader = user;
  if (reader->key >= 0) return take_values(reader, reader->key, item, err);
  int key = zp_key_find(item->path);
  if (item->kind == ZP_YAML_GROUP) return key >= 0 ? take_parts(reader, key, item, err) : take_group(reader, item, err);
  if (key >= 0) {
    ZpStatus status = check_first(reader, item, reader->line[key], err);
    return status == ZP_OK ? take_values(reader, key, item, err) : status;
  }
  size_t part;
  const int ranged = key_of_part(item->path, &part), first = first_of_group(item->path);
  if (ranged >= 0) return take_part(reader, item, ranged, part, err);
  if (first < 0) return fail_unknown(reader, item, err);
  if (item->kind == ZP_YAML_VALUE && *item->word == 0) return take_group(reader, item, err);
  return fail_at(reader, item->path, item->line, err, GROUP_WITHOUT_VALUE, zp_key(first)->name);
}

/* Read a text into a layer. */
static ZpStatus read_layer(ZpScenario *s, const char *text, size_t size, const char *name, ZpSlot *layer,
                           ZpError *err) {
  ZpSource source = {.name = name};
  Reader reader = {.source = &source, .key = -1};
  ZpStatus status = zp_yaml_read(&source, text, size, false, take_item, &reader, err);
  if (status == ZP_OK) status = merge(s, &reader, layer, err);
  close_reader(&reader);
  return status;
}

ZpStatus zp_scenario_parse(ZpScenario *s, const char *text, size_t size, const char *name, ZpError *err) {
  char *kept_name = strdup(name);
  ZpStatus status = kept_name ? read_layer(s, text, size, name, s->file, err) : zp_fail_memory(err);
  if (status != ZP_OK) {
    free(kept_name);
    return status;
  }
  free(s->name);
  s->name = kept_name;
  return ZP_OK;
}

ZpStatus zp_scenario_override(ZpScenario *s, const char *text, size_t size, const char *name, ZpError *err) {
  return read_layer(s, text, size, name, s->set, err);
}

ZpStatus zp_scenario_read(ZpScenario *s, const char *path, ZpError *err) {
  char *text;
  size_t size;
  ZpStatus status = zp_file_read(path, ZP_YAML_LARGEST + 1, &text, &size, err);
  if (status == ZP_OK) status = zp_scenario_parse(s, text, size, path, err);
  free(text);
  return status;
}

/* (argument, its `length` bytes before "=") => key, or -1 with an error. */
static int key_of_argument(const ZpSource *source, size_t length, ZpError *err) {
  char name[ZP_VALUE_SIZE];
  while (length && source->name[length - 1] == ' ')
    length--;
  snprintf(name, sizeof name, "%.*s", length < sizeof name ? (int)length : (int)sizeof name - 1, source->name);
  int key = zp_key_find(name);
  if (key >= 0) return key;
  int first = first_of_group(name);
  char reason[ZP_VALUE_SIZE];
  zp_key_unknown(name, reason, sizeof reason);
  if (first >= 0) snprintf(reason, sizeof reason, GROUP_WITHOUT_VALUE, zp_key(first)->name);
  zp_source_fail(source, 0, err, "%s", reason);
  return -1;
}

/* A range is not YAML, in which its colon would start a mapping. */
static ZpStatus read_argument(Reader *reader, const char *text, ZpError *err) {
  const ZpYamlItem item = {ZP_YAML_VALUE, "", 1, text, 1};
  const bool is_range =
      zp_value_is_number(zp_key(reader->key)) && zp_range_is(text) && *(text + strspn(text, " ")) != '[';
  if (!is_range) return zp_yaml_read(reader->source, text, strlen(text), true, take_item, reader, err);
  if (strlen(text) < ZP_VALUE_SIZE) return take_values(reader, reader->key, &item, err);
  return zp_source_fail(reader->source, 0, err, "value longer than %d bytes", ZP_VALUE_SIZE - 1);
}

ZpStatus zp_scenario_set(ZpScenario *s, const char *assignment, ZpError *err) {
  ZpSource source = {.name = assignment, .argument = true};
  const char *equals = strchr(assignment, '=');
  if (!equals) return zp_source_fail(&source, 0, err, "give KEY=VALUE");
  int key = key_of_argument(&source, (size_t)(equals - assignment), err);
  if (key < 0) return ZP_BAD_INPUT;
  Reader reader = {.source = &source, .key = key};
  ZpStatus status = read_argument(&reader, equals + 1, err);
  if (status == ZP_OK && !reader.line[key]) status = zp_source_fail(&source, 0, err, "empty; give a value");
  if (status == ZP_OK) status = merge(s, &reader, s->set, err);
  close_reader(&reader);
  return status;
}

size_t zp_scenario_count(const ZpScenario *s) {
  return s->plan.count;
}

const int *zp_scenario_lists(const ZpScenario *s, size_t *count) {
  *count = s->plan.variations;
  return s->plan.varied;
}

const int *zp_scenario_axes(const ZpScenario *s, size_t *count) {
  *count = s->plan.axes;
  return s->plan.axis;
}

const double *zp_scenario_axis(const ZpScenario *s, int key, size_t *count) {
  *count = s->plan.tied[key] ? s->plan.together : s->held[key]->count;
  return s->held[key]->value;
}

const ZpDesign *zp_scenario_design(const ZpScenario *s) {
  return s->plan.design.dimensions > 0 ? &s->plan.design : NULL;
}

const ZpDistribution *zp_scenario_spread(const ZpScenario *s, int key) {
  const ZpDistribution *spread = &s->held[key]->spread;
  return spread->kind != ZP_DISTRIBUTION_NONE ? spread : NULL;
}

bool zp_scenario_bare_number(const ZpScenario *s, int key, double *value) {
  if (!s->held[key]->is_bare) return false;
  *value = s->held[key]->value[0];
  return true;
}

/* An error of the scenario, not of a single Def. */
static bool is_study(size_t key) {
  return !zp_key_in_def((int)key);
}

ZpStudy zp_scenario_study(const ZpScenario *s) {
  for (size_t i = 0; i < ZP_KEYS; i++)
    if (is_study(i) && s->held[i]->count) return (ZpStudy)s->held[i]->value[0];
  return (ZpStudy)0;
}

/* Add the file and `row` to the message of a scenario or a Def that is wrong as a whole. */
static ZpStatus fail_whole(const ZpScenario *s, ZpStatus status, const char *row, const char *message, ZpError *err) {
  const ZpSource source = {.name = s->name};
  if (status != ZP_BAD_INPUT || !s->name) return zp_fail(err, status, "%s%s", row, message);
  return zp_source_fail(&source, 0, err, "%s%s", row, message);
}

/* (status of a case) => the same status, with file and row in the message. */
static ZpStatus say_of(const ZpScenario *s, size_t index, ZpStatus status, const ZpError *reason, ZpError *err) {
  char row[64] = "";
  if (status == ZP_OK) return ZP_OK;
  if (s->plan.count > 1) snprintf(row, sizeof row, "row %zu of %zu: ", index + 1, s->plan.count);
  return fail_whole(s, reason->status, row, reason->message, err);
}

static ZpStatus check_case(const ZpScenario *s, size_t index, ZpError *err) {
  if (index >= s->plan.count)
    return zp_fail(err, ZP_BAD_INPUT, "row %zu: the scenario has rows 1 to %zu", index + 1, s->plan.count);
  return s->plan.problem.status ? fail_whole(s, ZP_BAD_INPUT, "", s->plan.problem.message, err) : ZP_OK;
}

ZpStatus zp_scenario_given(const ZpScenario *s, size_t index, ZpActuatorDef *def, ZpError *err) {
  ZpError reason;
  ZpStatus status = check_case(s, index, err);
  return status == ZP_OK ? say_of(s, index, resolve(s, index, def, &reason), &reason, err) : status;
}

void zp_scenario_values(const ZpScenario *s, size_t index, double *value) {
  zp_plan_values(&s->plan, s->held, index, value);
}

ZpStatus zp_scenario_def(const ZpScenario *s, size_t index, ZpActuatorDef *def, ZpError *err) {
  ZpError reason;
  ZpStatus status = def ? check_case(s, index, err) : zp_fail_memory(err);
  if (status != ZP_OK) return status;
  status = resolve(s, index, def, &reason);
  if (status == ZP_OK) status = zp_study_check(zp_scenario_study(s), def, &reason);
  return say_of(s, index, status, &reason, err);
}

/* Sweeps with more cases keep no series by default. */
enum { CASES_WITH_SERIES = 20 };

bool zp_scenario_keeps_series(const ZpScenario *s) {
  ZpActuatorDef def;
  if (resolve(s, 0, &def, NULL) != ZP_OK || def.output.series == ZP_WHEN_AUTO)
    return s->plan.count <= CASES_WITH_SERIES;
  return def.output.series == ZP_WHEN_TRUE;
}

/* Set differs[key] for every key without a list whose value, or meaning of auto, differs between the cases. */
static ZpStatus compare_defs(const ZpScenario *s, const ZpActuatorDef *first, bool *differs, ZpError *err) {
  ZpActuatorDef def = {0};
  for (size_t row = 1; row < s->plan.count; row++) {
    ZpError reason;
    ZpStatus status = resolve(s, row, &def, &reason);
    if (status != ZP_OK) return say_of(s, row, status, &reason, err);
    for (int i = 0; i < zp_key_count() && !s->has_common; i++) { /* otherwise only keys with lists may */
      const double a = zp_def_get(first, i), b = zp_def_get(&def, i);
      differs[i] |= a != b && !(isnan(a) && isnan(b));
    }
    differs[zp_key_find("liquid.model")] |= zp_def_liquid(first) != zp_def_liquid(&def);
  }
  return ZP_OK;
}

static void write_slot(FILE *file, int key, const ZpSlot *slot) {
  const ZpShownUnit shown = zp_value_unit(key);
  char text[ZP_VALUE_SIZE];
  for (size_t i = 0; i < slot->count; i++) {
    zp_value_print_in(key, &shown, slot->value[i], text, sizeof text);
    fprintf(file, "%s%s", i ? ", " : "[", text);
  }
  fprintf(file, "]\n");
}

/* One line per key. A value that the preset sets differently in different rows is left to the preset, where it is found
 * again on reading. */
static void write_keys(const ZpScenario *s, const ZpActuatorDef *first, const bool *differs, FILE *file) {
  const char *before = NULL;
  const int liquid = zp_key_find("liquid.model");
  char text[ZP_VALUE_SIZE];
  for (int i = 0; i < zp_key_count(); i++) {
    const ZpSlot *slot = s->held[i];
    const char *name = zp_key(i)->name;
    const bool spreads = slot->spread.kind != ZP_DISTRIBUTION_NONE;
    if (differs[i] && !slot->is_list && !spreads) {
      fprintf(file, "# %s: differs between rows; the preset sets it\n", name);
      continue;
    }
    zp_yaml_write_key(file, name, before);
    before = name;
    if (slot->is_list) {
      write_slot(file, i, slot);
      continue;
    }
    const char *words = zp_def_text(first, i);
    if (spreads) {
      zp_spread_print(i, &slot->spread, text, sizeof text);
      fputs(text, file);
    } else if (words) {
      zp_yaml_write_text(file, words);
    } else {
      double value = is_study((size_t)i) ? (double)zp_scenario_study(s) : zp_def_get(first, i);
      zp_value_print(i, value, text, sizeof text);
      fputs(text, file);
      if (i == liquid && value == ZP_LIQUID_AUTO) /* which means this model */
        fprintf(file, " # %s", zp_key(i)->choices[zp_def_liquid(first)].word);
    }
    fputc('\n', file);
  }
}

ZpStatus zp_scenario_write(const ZpScenario *s, FILE *file, ZpError *err) {
  ZpActuatorDef first = {0};
  ZpError reason;
  ZpStatus status = resolve(s, 0, &first, &reason);
  if (status != ZP_OK) return say_of(s, 0, status, &reason, err);
  bool differs[ZP_KEYS] = {false};
  status = compare_defs(s, &first, differs, err);
  if (status != ZP_OK) return status;
  write_keys(s, &first, differs, file);
  if (fflush(file) || ferror(file))
    return zp_fail(err, ZP_MACHINE, "the scenario cannot be written: %s", strerror(errno));
  return ZP_OK;
}
