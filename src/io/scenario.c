/* Scenarios: values for keys, some of them lists, from a file and from --set.
 *
 * Two layers of slots, one slot per given key, hold the values of the file and those of --set; the second layer wins,
 * whatever the order of calls. A third layer, below both, has the values of base.file and, for sampling.tolerances, the
 * distributions of materials.
 * Nothing is resolved before a Def is requested, so the position of `preset` in the file does not matter. A text is
 * first read into slots of its own. Then the layer that it changes is built again, with all that follows from the
 * layers. If nothing fails, they replace the present ones. io/plan.h lists the Defs of a scenario. Their common values
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
#include "def/rule.h"
#include "io/file.h"
#include "io/names.h"
#include "io/plan.h"
#include "io/range.h"
#include "io/source.h"
#include "io/value.h"
#include "io/yaml.h"

/* Slots in the order of keys. */
typedef struct Layer {
  ZpSlot *slot;
  size_t count, room;
} Layer;

/* The slots that apply, of all layers, and the cases. */
typedef struct Held {
  ZpSlot *below;    /* [ZP_KEYS] of base.file and materials; both layers override them. A value has no other place */
  ZpFitted *fitted; /* base.file; NULL: there is none, or it is wrong */
  ZpError base;     /* why it is wrong; otherwise all 0 */
  int line;         /* in which base.file was given */
  ZpGiven given;
  ZpPlan plan;
} Held;

struct ZpScenario {
  Layer file; /* from files */
  Layer set;  /* from --set; they override those from files */
  ZpGivenNames names;
  Held held;
  ZpActuatorDef common; /* the first case; the others set their varied keys in it, unless these affect further keys */
  bool has_common;
  char *name; /* name of the last file, NULL if none */
};

/* A group of keys, by its first key, that is open at a depth: 0 for lower, 1 for lower.ribbon. */
typedef struct OpenGroup {
  int first, depth;
  int line; /* in which it was opened */
} OpenGroup;

/* A text being read into slots. */
typedef struct Reader {
  const ZpSource *source;
  ZpGivenNames names; /* those of the scenario and new ones */
  int key;            /* key of --set; -1 if the text contains the keys */
  Layer slots;
  OpenGroup *group;
  size_t groups, group_room;
  int part_key;  /* key whose range is being read, if there is a part */
  ZpParts parts; /* of the range or distribution that is being read, {from: ..., to: ...}; NULL: not given */
} Reader;

static void free_slot(ZpSlot *slot) {
  free(slot->value);
  free(slot->text);
}

static void free_layer(Layer *layer) {
  for (size_t i = 0; i < layer->count; i++)
    free_slot(&layer->slot[i]);
  free(layer->slot);
}

/* The place of a key in a layer, or where it belongs. */
static size_t place_of(const Layer *layer, int key) {
  size_t low = 0, high = layer->count;
  while (low < high) {
    const size_t middle = (low + high) / 2;
    if (zp_key_order(layer->slot[middle].key, key) < 0)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

static ZpSlot *slot_of(const Layer *layer, int key) {
  const size_t at = place_of(layer, key);
  return at < layer->count && layer->slot[at].key == key ? &layer->slot[at] : NULL;
}

/* Make room for one more item of `size` bytes in an array. False if there is no memory. */
static bool grow(void **array, size_t count, size_t *room, size_t size) {
  if (count < *room) return true;
  void *more = realloc(*array, (2 * *room + 16) * size);
  if (!more) return false;
  *array = more;
  *room = 2 * *room + 16;
  return true;
}

/* Take a slot, whose value and text then belong to the layer; the last one of a key counts. */
static bool put_slot(Layer *layer, const ZpSlot *slot) {
  ZpSlot *known = slot_of(layer, slot->key);
  if (known) {
    free_slot(known);
    *known = *slot;
    return true;
  }
  void *array = layer->slot;
  const bool made = grow(&array, layer->count, &layer->room, sizeof *slot);
  layer->slot = array;
  if (!made) return false;
  ZpSlot *at = layer->slot + place_of(layer, slot->key);
  memmove(at + 1, at, (size_t)(layer->slot + layer->count - at) * sizeof *at);
  *at = *slot;
  layer->count++;
  return true;
}

/* A definition with the given materials, base.file and sampling.tolerances, otherwise with defaults. */
static ZpActuatorDef sources_of(const ZpGiven *given) {
  ZpActuatorDef def = zp_actuator_def_default();
  for (size_t i = 0; i < given->count; i++) {
    const ZpSlot *slot = given->slot[i];
    const bool asked = zp_key_is_material(slot->key) || slot->key == ZP_KEY(sampling.tolerances);
    if (asked) zp_def_set(&def, slot->key, slot->value[0], NULL);
    if (slot->key == ZP_KEY(base.file)) zp_def_set_text(&def, slot->key, slot->text, NULL);
  }
  return def;
}

/* Note the first mistake in base.file, for the message of a scenario. */
__attribute__((format(printf, 2, 3))) static void fail_base(Held *held, const char *format, ...) {
  va_list args;
  char reason[sizeof held->base.message];
  va_start(args, format);
  vsnprintf(reason, sizeof reason, format, args);
  va_end(args);
  if (held->base.status == ZP_OK) zp_fail(&held->base, ZP_BAD_INPUT, "%s", reason);
}

/* Read base.file. A mistake is reported when a Def is requested, since a later --set may mend it. */
static ZpStatus read_base(const ZpActuatorDef *def, Held *held, ZpError *err) {
  ZpError reason;
  const ZpSlot *slot = zp_given(&held->given, ZP_KEY(base.file));
  held->line = slot ? slot->line : 0;
  if (*def->base.file == 0) {
    if (def->sampling.tolerances == ZP_TOLERANCES_BASE)
      fail_base(held, "sampling.tolerances = base: base.file is not given; name the fitted.yaml of a calibrate");
    return ZP_OK;
  }
  held->fitted = calloc(1, sizeof *held->fitted);
  if (!held->fitted) return zp_fail_memory(err);
  ZpStatus status = zp_fitted_read(def->base.file, held->fitted, &reason);
  if (status == ZP_OK) return ZP_OK;
  free(held->fitted);
  held->fitted = NULL;
  if (status != ZP_BAD_INPUT) return zp_fail(err, status, "base.file: %s", reason.message);
  fail_base(held, "base.file: %s", reason.message);
  return ZP_OK;
}

/* The slot of a key that base.file sets. */
static ZpSlot slot_of_base(const ZpActuatorDef *def, const ZpFittedKey *fitted, Held *held) {
  const ZpKey *key = zp_key(fitted->key);
  ZpSlot slot = {.key = fitted->key, .count = 1, .is_fitted = true, .spread = {.a = fitted->value}};
  if (def->sampling.tolerances != ZP_TOLERANCES_BASE) return slot;
  if (isnan(fitted->error))
    fail_base(held,
              "sampling.tolerances = base: %s has no standard error in base.file; give it a value or a distribution",
              key->name);
  else
    slot.spread = (ZpDistribution){ZP_DISTRIBUTION_NORMAL, fitted->value, fitted->error, key->min, key->max};
  return slot;
}

/* The slot of a key that neither layer gives, from base.file or else from a material; false if it has none. */
static bool find_below(const ZpActuatorDef *def, int key, Held *held, ZpSlot *slot) {
  const size_t place = held->fitted ? zp_fitted_place(held->fitted, key) : 0;
  const bool draws = def->sampling.tolerances == ZP_TOLERANCES_MATERIALS;
  const ZpMaterialValue *filled = draws ? zp_material_value(def, key) : NULL;
  if (held->fitted && place < held->fitted->count)
    *slot = slot_of_base(def, &held->fitted->key[place], held);
  else if (filled)
    *slot = (ZpSlot){
        .key = key, .count = 1, .spread = {.kind = ZP_DISTRIBUTION_LOGNORMAL, .a = filled->value, .b = filled->spread}};
  else
    return false;
  return true;
}

/* Add what is below both layers to the given slots. */
static ZpStatus add_below(Held *held, ZpError *err) {
  const ZpActuatorDef def = sources_of(&held->given);
  ZpStatus status = read_base(&def, held, err);
  if (status != ZP_OK || (!held->fitted && def.sampling.tolerances != ZP_TOLERANCES_MATERIALS)) return status;
  const ZpGiven given = held->given;
  size_t at = 0;
  held->below = calloc(ZP_KEYS, sizeof *held->below);
  held->given = (ZpGiven){calloc(given.count + ZP_KEYS, sizeof(ZpSlot *)), 0, held->fitted};
  const bool memory = held->below && held->given.slot;
  for (int i = 0; memory && i < ZP_KEYS; i++) {
    for (; at < given.count && zp_key_order(given.slot[at]->key, i) < 0; at++)
      held->given.slot[held->given.count++] = given.slot[at];
    ZpSlot *slot = &held->below[i];
    if ((at < given.count && given.slot[at]->key == i) || !find_below(&def, i, held, slot)) continue;
    slot->value = &slot->spread.a;
    held->given.slot[held->given.count++] = slot;
  }
  for (; memory && at < given.count; at++)
    held->given.slot[held->given.count++] = given.slot[at];
  free(given.slot);
  return memory ? ZP_OK : zp_fail_memory(err);
}

/* --set wins over the file. */
static ZpStatus hold(const Layer *file, const Layer *set, Held *held, ZpError *err) {
  ZpGiven *given = &held->given;
  given->slot = calloc(file->count + set->count + 1, sizeof(ZpSlot *));
  if (!given->slot) return zp_fail_memory(err);
  for (size_t f = 0, s = 0; f < file->count || s < set->count;) {
    const int order = f == file->count ? 1 : s == set->count ? -1 : zp_key_order(file->slot[f].key, set->slot[s].key);
    given->slot[given->count++] = order < 0 ? &file->slot[f] : &set->slot[s];
    f += order <= 0;
    s += order >= 0;
  }
  return add_below(held, err);
}

static void free_held(Held *held) {
  zp_plan_free(&held->plan);
  free(held->given.slot);
  free(held->below);
  free(held->fitted);
}

static ZpStatus make_held(const Layer *file, const Layer *set, Held *held, ZpError *err) {
  *held = (Held){0};
  ZpStatus status = hold(file, set, held, err);
  return status == ZP_OK ? zp_plan_make(&held->plan, &held->given, err) : status;
}

/* Set the texts; nothing else depends on them. */
static ZpStatus set_texts(const ZpScenario *s, ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = ZP_OK;
  for (size_t i = 0; i < s->held.given.count && status == ZP_OK; i++) {
    const ZpSlot *slot = s->held.given.slot[i];
    if (slot->text) status = zp_def_set_text(def, slot->key, slot->text, err);
  }
  return status;
}

/* Make a case from all given values. */
static ZpStatus resolve_whole(const ZpScenario *s, const double *value, ZpActuatorDef *def, ZpError *err) {
  const ZpGiven *given = &s->held.given;
  ZpAssignment *list = calloc(given->count + 1, sizeof *list);
  if (!list) return zp_fail_memory(err);
  ZpStatus status = zp_def_resolve(def, list, zp_plan_assign(&s->held.plan, given, value, list), err);
  free(list);
  if (status == ZP_OK) status = zp_names_give(&s->names, def, err);
  return status == ZP_OK ? set_texts(s, def, err) : status;
}

/* Make a case from the common values. Keys are set in the order of zp_plan_assign, so the same key is refused first. */
static ZpStatus resolve_varied(const ZpScenario *s, const double *value, ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = zp_def_assign(def, &s->common, err);
  for (size_t v = s->held.plan.variations; v-- > 0 && status == ZP_OK;)
    status = zp_def_set(def, s->held.plan.varied[v], value[v], err);
  return status;
}

static ZpStatus resolve(const ZpScenario *s, size_t index, ZpActuatorDef *def, ZpError *err) {
  double *value = calloc(s->held.plan.variations + 1, sizeof *value);
  if (!value) return zp_fail_memory(err);
  zp_plan_values(&s->held.plan, &s->held.given, index, value);
  ZpStatus status = s->has_common ? resolve_varied(s, value, def, err) : resolve_whole(s, value, def, err);
  free(value);
  return status;
}

/* Resolve the common values of the cases, unless a varied key determines values of keys that are not given: a preset
 * has values for certain mesh.nodes, and all other such keys are words. If the first case cannot be resolved, the
 * request for it reports the reason. */
static void find_common(ZpScenario *s) {
  bool moves = false;
  for (size_t v = 0; v < s->held.plan.variations; v++) {
    const ZpKey *key = zp_key(s->held.plan.varied[v]);
    moves |= key->type == ZP_KEY_ENUM || key->type == ZP_KEY_BOOL || strcmp(key->name, "mesh.nodes") == 0;
  }
  s->has_common = false;
  s->has_common = !moves && resolve(s, 0, &s->common, NULL) == ZP_OK;
}

ZpScenario *zp_scenario_create(void) {
  ZpScenario *s = calloc(1, sizeof *s);
  if (s && make_held(&s->file, &s->set, &s->held, NULL) == ZP_OK) {
    find_common(s);
    return s;
  }
  zp_scenario_destroy(s);
  return NULL;
}

void zp_scenario_destroy(ZpScenario *s) {
  if (!s) return;
  free_held(&s->held);
  free_layer(&s->file);
  free_layer(&s->set);
  zp_def_clear(&s->common);
  zp_names_free(&s->names);
  free(s->name);
  free(s);
}

/* The slots of `under` and those of `over`, which win: their values still belong to these layers. */
static bool lay_over(const Layer *under, const Layer *over, Layer *both) {
  *both = (Layer){calloc(under->count + over->count + 1, sizeof(ZpSlot)), 0, under->count + over->count + 1};
  if (!both->slot) return false;
  for (size_t u = 0, o = 0; u < under->count || o < over->count;) {
    const int order = u == under->count  ? 1
                      : o == over->count ? -1
                                         : zp_key_order(under->slot[u].key, over->slot[o].key);
    both->slot[both->count++] = order < 0 ? under->slot[u] : over->slot[o];
    u += order <= 0;
    o += order >= 0;
  }
  return true;
}

/* Replace a layer by one that has the slots that were read over its own. */
static void replace(Reader *reader, Layer *layer, const Layer *both) {
  for (size_t k = 0; k < reader->slots.count; k++) {
    ZpSlot *old = slot_of(layer, reader->slots.slot[k].key);
    if (old) free_slot(old);
  }
  free(layer->slot);
  *layer = *both;
  reader->slots.count = 0; /* they belong to the layer */
}

/* Replace the values of the same keys in `layer` by those that were read. */
static ZpStatus merge(ZpScenario *s, Reader *reader, Layer *layer, ZpError *err) {
  ZpError reason;
  Layer both;
  Held held = {0};
  const bool is_file = layer == &s->file;
  ZpStatus status = lay_over(layer, &reader->slots, &both)
                        ? make_held(is_file ? &both : &s->file, is_file ? &s->set : &both, &held, &reason)
                        : zp_fail_memory(&reason);
  if (status != ZP_OK) {
    free_held(&held);
    free(both.slot);
    return status == ZP_MACHINE ? zp_fail(err, status, "%s", reason.message)
                                : zp_source_fail(reader->source, 0, err, "%s", reason.message);
  }
  replace(reader, layer, &both);
  zp_names_free(&s->names);
  s->names = reader->names;
  reader->names = (ZpGivenNames){0};
  free_held(&s->held);
  s->held = held;
  find_common(s);
  return ZP_OK;
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
  zp_names_free(&reader->names);
  free_layer(&reader->slots);
  free(reader->group);
}

/* Line in which a key was given; 0: not yet. */
static int line_of(const Reader *reader, int key) {
  const ZpSlot *slot = slot_of(&reader->slots, key);
  return slot ? slot->line : 0;
}

#define GROUP_WITHOUT_VALUE "a group of keys cannot have a value; give one of its keys, such as %s"

/* First key of the group `path`, -1 if it is not a group. */
static int first_of_group(const char *path) {
  const char *rest;
  ZpInstanceKind kind;
  const int number = zp_instance_named(path, &kind, &rest);
  char row[ZP_VALUE_SIZE];
  if (number > 0)
    snprintf(row, sizeof row, "%sK%.64s", zp_instance_begins(kind), rest);
  else
    snprintf(row, sizeof row, "%.64s", path);
  size_t length = strlen(row);
  for (int i = 0; i < zp_key_count(); i++)
    if (strncmp(zp_key(i)->name, row, length) == 0 && zp_key(i)->name[length] == '.')
      return zp_key_in_def(i) ? i : number > 0 ? zp_key_of_instance(i, number) : -1;
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
  return fail_at(reader, ZP_KEY_NAME(reader->part_key), line, err,
                 "write a range as {from: ..., to: ..., count: ...}, a distribution as {normal: ..., sigma: ...}");
}

static ZpStatus take_group(Reader *reader, const ZpYamlItem *item, ZpError *err) {
  if (*item->path == 0) return check_no_parts(reader, -1, item->line, err);
  int first = first_of_group(item->path);
  if (first < 0) return fail_unknown(reader, item, err);
  const int depth = strchr(item->path, '.') != NULL;
  for (size_t k = 0; k < reader->groups; k++)
    if (reader->group[k].first == first && reader->group[k].depth == depth)
      return check_first(reader, item, reader->group[k].line, err);
  void *array = reader->group;
  const bool made = grow(&array, reader->groups, &reader->group_room, sizeof *reader->group);
  reader->group = array;
  if (!made) return zp_fail_memory(err);
  reader->group[reader->groups++] = (OpenGroup){first, depth, item->line};
  return ZP_OK;
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

/* Does a text name keys? */
static bool names_keys(int key) {
  return key == ZP_KEY(sensitivity.by) || key == ZP_KEY(sampling.together) || key == ZP_KEY(optimize.variables);
}

static ZpStatus read_text(Reader *reader, int key, const char *word, ZpSlot *slot, ZpError *reason) {
  const ZpSource *source = reader->source;
  const ZpPaths paths = zp_key_paths(key);
  ZpActuatorDef scratch = zp_actuator_def_default();
  slot->text = paths == ZP_PATHS_SEVERAL ? absolute_paths(source, word)
               : paths == ZP_PATHS_ONE   ? absolute_path(source, word, (int)strlen(word))
               : names_keys(key)         ? zp_names_text(&reader->names, word)
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
static ZpStatus read_words(ZpGivenNames *names, bool known, int key, const ZpYamlItem *item, const char **word,
                           ZpSlot *slot, ZpError *reason) {
  ZpStatus status = make_room(slot, item->count) ? ZP_OK : zp_fail_memory(reason);
  slot->is_list = item->kind == ZP_YAML_LIST;
  for (size_t i = 0; i < item->count && status == ZP_OK; i++) {
    if (i > 0) *word += strlen(*word) + 1;
    slot->is_bare |= zp_value_is_bare(key, *word);
    status = zp_key_is_name(key) ? zp_names_value(names, known, key, *word, &slot->value[i], reason)
                                 : zp_value_read(key, *word, &slot->value[i], reason);
  }
  return status;
}

/* A list or one value: "50 um", "10 um .. 200 um : 20", "normal(50 um, 1 um)". */
static ZpStatus read_value(ZpGivenNames *names, bool known, int key, const ZpYamlItem *item, const char **word,
                           ZpSlot *slot, ZpError *reason) {
  const bool alone = item->kind == ZP_YAML_VALUE && zp_value_is_number(zp_key(key)) && !zp_key_is_name(key);
  const bool ranges = alone && zp_range_is(item->word),
             spreads = alone && zp_value_is_real(zp_key(key)) && zp_spread_is(item->word);
  char copy[ZP_VALUE_SIZE];
  ZpParts parts;
  if (!ranges && !spreads) return read_words(names, known, key, item, word, slot, reason);
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
    return zp_source_fail(reader->source, line, err, "%s = \"%.80s\": %s", ZP_KEY_NAME(key), word, reason->message);
  return zp_source_fail(reader->source, line, err, "\"%.80s\": %s", word, reason->message);
}

/* Take the slot of a key that was read with this status. */
static ZpStatus take_slot(Reader *reader, int key, int line, ZpSlot *slot, ZpStatus status, ZpError *err) {
  slot->key = key;
  slot->line = line;
  if (status == ZP_OK && put_slot(&reader->slots, slot)) return ZP_OK;
  free_slot(slot);
  return status == ZP_OK ? zp_fail_memory(err) : status;
}

static ZpStatus check_shape(const Reader *reader, int key, const ZpYamlItem *item, ZpError *err) {
  const ZpKeyType type = zp_key(key)->type;
  const char *wrong = type == ZP_KEY_TEXT                          ? "takes one text, not a list"
                      : type == ZP_KEY_BOOL || type == ZP_KEY_ENUM ? "takes one word, not a list"
                      : zp_key_is_name(key)                        ? "takes one name, not a list"
                      : item->count == 0                           ? "empty list; give at least one value"
                                                                   : NULL;
  return item->kind == ZP_YAML_LIST && wrong ? fail_at(reader, ZP_KEY_NAME(key), item->line, err, "%s", wrong) : ZP_OK;
}

static ZpStatus take_values(Reader *reader, int key, const ZpYamlItem *item, ZpError *err) {
  ZpSlot slot = {0};
  ZpError reason;
  const char *word = item->word;
  ZpStatus status = check_shape(reader, key, item, err);
  if (status != ZP_OK) return status;
  status = zp_key(key)->type == ZP_KEY_TEXT
               ? read_text(reader, key, word, &slot, &reason)
               : read_value(&reader->names, reader->source->argument, key, item, &word, &slot, &reason);
  if (status != ZP_OK) status = fail_value(reader, key, item->line, word, &reason, item->kind == ZP_YAML_VALUE, err);
  return take_slot(reader, key, item->line, &slot, status, err);
}

/* -- parts of a range or a distribution ------------------------------------------------------------ */

/* The key in the path of a part, "ribbon.length.from", and the part; -1 if it is not such a path. */
static int key_of_part(const char *path, size_t *part) {
  char name[ZP_VALUE_SIZE];
  const char *last = strrchr(path, '.');
  if (!last) return -1;
  snprintf(name, sizeof name, "%.*s", (int)(last - path), path);
  const int key = zp_key_with_value(name);
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
  if (spreads ? !zp_value_is_real(zp_key(key)) : !zp_value_is_number(zp_key(key)))
    return fail_at(reader, item->path, item->line, err, "takes one value, not a %s",
                   spreads ? "distribution" : "range");
  ZpStatus status = check_first(reader, item, line_of(reader, key), err);
  if (status != ZP_OK) return status;
  const size_t first = zp_part_first(kind), second = zp_part_second(kind);
  for (size_t i = 0; i < ZP_PARTS && spreads; i++)
    if (reader->parts.text[i] && i != first && i != second)
      return fail_at(reader, item->path, item->line, err, "unknown part \"%s\"; write {%s: ..., %s: ...}",
                     zp_part_name[i], zp_part_name[first], zp_part_name[second]);
  status = read_parts(key, &reader->parts, &slot, &reason);
  if (status != ZP_OK) status = fail_value(reader, key, item->line, "{...}", &reason, true, err);
  drop_parts(reader);
  return take_slot(reader, key, item->line, &slot, status, err);
}

/* -- a text ---------------------------------------------------------------------------------------- */

/* Both keys of a pair: of `between` the bodies, of others x and y => how many keys are found. */
static int keys_of_pair(const char *path, int key[2]) {
  char name[ZP_PATH_SIZE];
  const char *last = strrchr(path, '.');
  const bool between = last && strcmp(last, ".between") == 0;
  int found = 0;
  for (int k = 0; last && k < 2; k++) {
    snprintf(name, sizeof name, "%.*s.%s", (int)(between ? last - path : (long)strlen(path)), path,
             between ? (k == 0 ? "first" : "second") : (k == 0 ? "x" : "y"));
    key[k] = zp_key_find(name);
    found += key[k] >= 0 && zp_key_instance(key[k]).number > 0;
  }
  return found;
}

static ZpStatus take_pair(Reader *reader, const ZpYamlItem *item, const int key[2], ZpError *err) {
  const char *word = item->word;
  if (item->count != 2)
    return fail_at(reader, item->path, item->line, err, "takes two values, such as [%s]",
                   zp_key_is_name(key[0]) ? "frame, hand" : "0 mm, -50 mm");
  for (int k = 0; k < 2; k++, word += strlen(word) + 1) {
    const ZpYamlItem part = {ZP_YAML_VALUE, item->path, item->line, word, 1};
    ZpStatus status = check_first(reader, item, line_of(reader, key[k]), err);
    if (status == ZP_OK) status = take_values(reader, key[k], &part, err);
    if (status != ZP_OK) return status;
  }
  return ZP_OK;
}

/* "hand: {}": a body exists once it has a value, its mass. */
static ZpStatus declare_body(Reader *reader, const ZpYamlItem *item, ZpError *err) {
  const char *rest;
  ZpInstanceKind kind;
  const int number = zp_instance_named(item->path, &kind, &rest);
  if (number == 0 || kind != ZP_OF_BODY || *rest) return ZP_OK;
  const int key = zp_key_of_instance(ZP_KEY(body_K.mass), number);
  bool given = false;
  for (size_t k = 0; k < reader->slots.count; k++)
    given |= zp_key_instance(reader->slots.slot[k].key).number == number &&
             zp_key_instance(reader->slots.slot[k].key).kind == ZP_OF_BODY;
  if (given) return ZP_OK;
  ZpSlot slot = {0};
  ZpStatus status = make_room(&slot, 1) ? ZP_OK : zp_fail_memory(err);
  return take_slot(reader, key, item->line, &slot, status, err);
}

static ZpStatus take_named(Reader *reader, const ZpYamlItem *item, ZpError *err);

/* A ZpYamlVisit. "ribbon:" without a value is a group without keys; with a value it is a mistake. */
static ZpStatus take_item(void *user, const ZpYamlItem *item, ZpError *err) {
  Reader *reader = user;
  char path[ZP_PATH_SIZE];
  ZpError reason;
  if (reader->key >= 0) return take_values(reader, reader->key, item, err);
  if (zp_fitted_is_section(item)) return ZP_OK; /* it has no values */
  if (zp_names_group(item->path) < ZP_CALLED_KINDS)
    return item->kind == ZP_YAML_GROUP || *item->word == 0
               ? check_no_parts(reader, -1, item->line, err)
               : fail_at(reader, item->path, item->line, err,
                         "takes names with their keys, such as hand: {mass: 20 g}");
  if (zp_names_path(&reader->names, item->path, path, sizeof path, &reason) != ZP_OK)
    return reason.status == ZP_MACHINE ? zp_fail_memory(err)
                                       : fail_at(reader, item->path, item->line, err, "%s", reason.message);
  ZpYamlItem named = *item;
  named.path = path;
  ZpStatus status = take_named(reader, &named, err);
  const bool ends = item->kind == ZP_YAML_GROUP || (item->kind == ZP_YAML_VALUE && *item->word == 0);
  if (status == ZP_OK && ends) status = declare_body(reader, &named, err);
  if (status == ZP_BAD_INPUT) zp_names_tell(&reader->names, err);
  return status;
}

/* An item whose path has numbers in the place of names. */
static ZpStatus take_named(Reader *reader, const ZpYamlItem *item, ZpError *err) {
  int key = zp_key_with_value(item->path);
  if (item->kind == ZP_YAML_GROUP) return key >= 0 ? take_parts(reader, key, item, err) : take_group(reader, item, err);
  if (key >= 0) {
    ZpStatus status = check_first(reader, item, line_of(reader, key), err);
    return status == ZP_OK ? take_values(reader, key, item, err) : status;
  }
  int pair[2];
  if (item->kind == ZP_YAML_LIST && keys_of_pair(item->path, pair) == 2) return take_pair(reader, item, pair, err);
  size_t part;
  const int ranged = key_of_part(item->path, &part), first = first_of_group(item->path);
  if (ranged >= 0) return take_part(reader, item, ranged, part, err);
  if (first < 0) return fail_unknown(reader, item, err);
  if (item->kind == ZP_YAML_VALUE && *item->word == 0) return take_group(reader, item, err);
  return fail_at(reader, item->path, item->line, err, GROUP_WITHOUT_VALUE, ZP_KEY_NAME(first));
}

/* Read a text into a layer. */
static ZpStatus read_layer(ZpScenario *s, const char *text, size_t size, const char *name, Layer *layer, ZpError *err) {
  ZpSource source = {.name = name};
  Reader reader = {.source = &source, .key = -1};
  if (!zp_names_copy(&s->names, &reader.names)) return zp_fail_memory(err);
  ZpStatus status = zp_yaml_read(&source, text, size, false, take_item, &reader, err);
  if (status == ZP_OK) status = merge(s, &reader, layer, err);
  close_reader(&reader);
  return status;
}

ZpStatus zp_scenario_parse(ZpScenario *s, const char *text, size_t size, const char *name, ZpError *err) {
  char *kept_name = strdup(name);
  ZpStatus status = kept_name ? read_layer(s, text, size, name, &s->file, err) : zp_fail_memory(err);
  if (status != ZP_OK) {
    free(kept_name);
    return status;
  }
  free(s->name);
  s->name = kept_name;
  return ZP_OK;
}

ZpStatus zp_scenario_override(ZpScenario *s, const char *text, size_t size, const char *name, ZpError *err) {
  return read_layer(s, text, size, name, &s->set, err);
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
static int key_of_argument(const ZpSource *source, ZpGivenNames *names, size_t length, ZpError *err) {
  char given[ZP_VALUE_SIZE], name[ZP_VALUE_SIZE];
  ZpError wrong;
  while (length && source->name[length - 1] == ' ')
    length--;
  snprintf(given, sizeof given, "%.*s", length < sizeof given ? (int)length : (int)sizeof given - 1, source->name);
  if (zp_names_path(names, given, name, sizeof name, &wrong) != ZP_OK) {
    zp_source_fail(source, 0, err, "%s", wrong.message);
    return -1;
  }
  int key = zp_key_with_value(name);
  if (key >= 0) return key;
  int first = first_of_group(name);
  char reason[ZP_VALUE_SIZE];
  zp_key_unknown(name, reason, sizeof reason);
  if (first >= 0) snprintf(reason, sizeof reason, GROUP_WITHOUT_VALUE, ZP_KEY_NAME(first));
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
  Reader reader = {.source = &source};
  if (!zp_names_copy(&s->names, &reader.names)) return zp_fail_memory(err);
  reader.key = key_of_argument(&source, &reader.names, (size_t)(equals - assignment), err);
  if (reader.key < 0) {
    zp_names_tell(&reader.names, err);
    close_reader(&reader);
    return ZP_BAD_INPUT;
  }
  ZpStatus status = read_argument(&reader, equals + 1, err);
  if (status == ZP_OK && reader.slots.count == 0) status = zp_source_fail(&source, 0, err, "empty; give a value");
  if (status == ZP_OK) status = merge(s, &reader, &s->set, err);
  close_reader(&reader);
  return status;
}

const char *zp_scenario_key(const ZpScenario *s, int key, char text[ZP_SCENARIO_KEY_SIZE]) {
  return zp_names_key(&s->names, key, text);
}

size_t zp_scenario_count(const ZpScenario *s) {
  return s->held.plan.count;
}

const int *zp_scenario_lists(const ZpScenario *s, size_t *count) {
  *count = s->held.plan.variations;
  return s->held.plan.varied;
}

const int *zp_scenario_axes(const ZpScenario *s, size_t *count) {
  *count = s->held.plan.axes;
  return s->held.plan.axis;
}

const double *zp_scenario_axis(const ZpScenario *s, int key, size_t *count) {
  const ZpGiven *given = &s->held.given;
  size_t at = 0;
  while (given->slot[at]->key != key)
    at++;
  *count = s->held.plan.tied[at] ? s->held.plan.together : given->slot[at]->count;
  return given->slot[at]->value;
}

const ZpDesign *zp_scenario_design(const ZpScenario *s) {
  return s->held.plan.design.dimensions > 0 ? &s->held.plan.design : NULL;
}

const ZpDistribution *zp_scenario_spread(const ZpScenario *s, int key) {
  const ZpSlot *slot = zp_given(&s->held.given, key);
  return slot && slot->spread.kind != ZP_DISTRIBUTION_NONE ? &slot->spread : NULL;
}

bool zp_scenario_bare_number(const ZpScenario *s, int key, double *value) {
  const ZpSlot *slot = zp_given(&s->held.given, key);
  if (!slot || !slot->is_bare) return false;
  *value = slot->value[0];
  return true;
}

ZpStudy zp_scenario_study(const ZpScenario *s) {
  const ZpSlot *slot = zp_given(&s->held.given, ZP_KEY(study));
  return slot ? (ZpStudy)slot->value[0] : (ZpStudy)0;
}

/* Add the file and `row` to the message of a scenario or a Def that is wrong as a whole. */
static ZpStatus fail_whole(const ZpScenario *s, ZpStatus status, const char *row, const char *message, ZpError *err) {
  const ZpSource source = {.name = s->name};
  if (status != ZP_BAD_INPUT || !s->name) return zp_fail(err, status, "%s%s", row, message);
  return zp_source_fail(&source, 0, err, "%s%s", row, message);
}

/* The message of a scenario whose base.file is wrong, with the line that names it. */
static ZpStatus fail_base_of(const ZpScenario *s, const char *message, ZpError *err) {
  const ZpSource source = {.name = s->name};
  const bool of_file = s->name && slot_of(&s->file, ZP_KEY(base.file)) && !slot_of(&s->set, ZP_KEY(base.file));
  return of_file ? zp_source_fail(&source, s->held.line, err, "%s", message)
                 : zp_fail(err, ZP_BAD_INPUT, "%s", message);
}

/* Is the first case valid with the keys that the scenario gives itself, without base.file? */
static bool is_good_alone(const ZpScenario *s) {
  ZpActuatorDef def = {0};
  const ZpGiven *given = &s->held.given;
  ZpAssignment *list = calloc(given->count + 1, sizeof *list);
  size_t used = 0;
  for (size_t i = given->count; list && i-- > 0;)
    if (!given->slot[i]->is_fitted && !given->slot[i]->text && zp_key_in_def(given->slot[i]->key))
      list[used++] = (ZpAssignment){given->slot[i]->key, given->slot[i]->value[0]};
  bool good = list && zp_def_resolve(&def, list, used, NULL) == ZP_OK &&
              zp_names_give(&s->names, &def, NULL) == ZP_OK && set_texts(s, &def, NULL) == ZP_OK &&
              zp_study_check(zp_scenario_study(s), &def, NULL) == ZP_OK;
  zp_def_clear(&def);
  free(list);
  return good;
}

/* (status of a case) => the same status, with file and row in the message. */
static ZpStatus say_of(const ZpScenario *s, size_t index, ZpStatus status, const ZpError *reason, ZpError *err) {
  char row[64] = "", text[sizeof err->message];
  if (status == ZP_OK) return ZP_OK;
  if (s->held.plan.count > 1) snprintf(row, sizeof row, "row %zu of %zu: ", index + 1, s->held.plan.count);
  if (s->held.fitted && reason->status == ZP_BAD_INPUT && is_good_alone(s)) {
    snprintf(text, sizeof text, "%sbase.file: a value of it is refused: %.400s", row, reason->message);
    return fail_base_of(s, text, err);
  }
  return fail_whole(s, reason->status, row, reason->message, err);
}

static ZpStatus check_case(const ZpScenario *s, size_t index, ZpError *err) {
  if (index >= s->held.plan.count)
    return zp_fail(err, ZP_BAD_INPUT, "row %zu: the scenario has rows 1 to %zu", index + 1, s->held.plan.count);
  if (s->held.base.status) return fail_base_of(s, s->held.base.message, err);
  return s->held.plan.problem.status ? fail_whole(s, ZP_BAD_INPUT, "", s->held.plan.problem.message, err) : ZP_OK;
}

ZpStatus zp_scenario_given(const ZpScenario *s, size_t index, ZpActuatorDef *def, ZpError *err) {
  ZpError reason;
  ZpStatus status = check_case(s, index, err);
  return status == ZP_OK ? say_of(s, index, resolve(s, index, def, &reason), &reason, err) : status;
}

void zp_scenario_values(const ZpScenario *s, size_t index, double *value) {
  zp_plan_values(&s->held.plan, &s->held.given, index, value);
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
  ZpActuatorDef def = {0};
  const bool good = resolve(s, 0, &def, NULL) == ZP_OK;
  zp_def_clear(&def);
  if (!good || def.output.series == ZP_WHEN_AUTO) return s->held.plan.count <= CASES_WITH_SERIES;
  return def.output.series == ZP_WHEN_TRUE;
}

/* Set differs[key] for every key without a list whose value, or meaning of auto, differs between the cases. No value of
 * a key of a member, a body or a spring follows from another key. */
static ZpStatus compare_defs(const ZpScenario *s, const ZpActuatorDef *first, bool *differs, ZpError *err) {
  ZpActuatorDef def = {0};
  ZpStatus status = ZP_OK;
  for (size_t row = 1; row < s->held.plan.count && status == ZP_OK; row++) {
    ZpError reason;
    status = resolve(s, row, &def, &reason);
    if (status != ZP_OK) say_of(s, row, status, &reason, err);
    for (int i = 0; i < zp_key_count() && !s->has_common; i++) { /* otherwise only keys with lists may */
      const double a = zp_def_get(first, i), b = zp_def_get(&def, i);
      differs[i] |= a != b && !(isnan(a) && isnan(b));
    }
    differs[zp_key_find("liquid.model")] |= zp_def_liquid(first) != zp_def_liquid(&def);
  }
  zp_def_clear(&def);
  return status;
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

/* The values of the keys, as they are written. */
typedef struct Writer {
  const ZpScenario *scenario;
  const ZpActuatorDef *first; /* of the first case */
  const bool *differs;
  FILE *file;
  char before[ZP_PATH_SIZE]; /* the key written last; "": none */
} Writer;

static void write_value(const Writer *w, int key) {
  char text[ZP_VALUE_SIZE];
  const char *words = zp_def_text(w->first, key);
  if (words) {
    zp_yaml_write_text(w->file, words);
    return;
  }
  if (zp_key_is_name(key)) {
    fputs(zp_names_word(&w->scenario->names, key, zp_def_get(w->first, key), text), w->file);
    return;
  }
  double value = key == ZP_KEY(study) ? (double)zp_scenario_study(w->scenario) : zp_def_get(w->first, key);
  zp_value_print(key, value, text, sizeof text);
  fputs(text, w->file);
  if (key == ZP_KEY(liquid.model) && value == ZP_LIQUID_AUTO) /* which means this model */
    fprintf(w->file, " # %s", zp_key(key)->choices[zp_def_liquid(w->first)].word);
}

/* One line. A value that the preset sets differently in different rows is left to the preset, and a joint distribution
 * to base.file, where they are found again on reading. */
static void write_key(Writer *w, int key) {
  const ZpSlot *slot = zp_given(&w->scenario->held.given, key);
  char called[ZP_PATH_SIZE];
  const char *name = zp_names_key(&w->scenario->names, key, called);
  const bool spreads = slot && slot->spread.kind != ZP_DISTRIBUTION_NONE, is_list = slot && slot->is_list;
  char text[ZP_VALUE_SIZE];
  if (key < ZP_KEYS && w->differs[key] && !is_list && !spreads) {
    fprintf(w->file, "# %s: differs between rows; the preset sets it\n", name);
    return;
  }
  if (spreads && slot->is_fitted) {
    fprintf(w->file, "# %s: drawn; base.file has its distribution\n", name);
    return;
  }
  zp_yaml_write_key(w->file, name, *w->before ? w->before : NULL);
  snprintf(w->before, sizeof w->before, "%s", name);
  if (is_list) {
    write_slot(w->file, key, slot);
    return;
  }
  if (spreads) zp_spread_print(key, &slot->spread, text, sizeof text);
  if (spreads)
    fputs(text, w->file);
  else
    write_value(w, key);
  fputc('\n', w->file);
}

/* Whose rows begin at this key; ZP_INSTANCE_KINDS: it is no row, or not the first. */
static ZpInstanceKind begins_rows_of(int key) {
  if (!zp_key_is_row(key)) return ZP_INSTANCE_KINDS;
  const ZpInstanceKind kind = zp_key_instance(zp_key_of_instance(key, 1)).kind;
  const bool later = zp_key_is_row(key - 1) && zp_key_instance(zp_key_of_instance(key - 1, 1)).kind == kind;
  return later ? ZP_INSTANCE_KINDS : kind;
}

/* All keys, those of members and so on where they are given. */
static void write_keys(Writer *w) {
  const ZpGiven *given = &w->scenario->held.given;
  for (int i = 0; i < zp_key_count(); i++) {
    const ZpInstanceKind kind = begins_rows_of(i);
    for (size_t k = 0; kind < ZP_INSTANCE_KINDS && k < given->count; k++)
      if (given->slot[k]->key >= ZP_KEYS && zp_key_instance(given->slot[k]->key).kind == kind)
        write_key(w, given->slot[k]->key);
    if (!zp_key_is_row(i)) write_key(w, i);
  }
}

ZpStatus zp_scenario_write(const ZpScenario *s, FILE *file, ZpError *err) {
  ZpActuatorDef first = {0};
  ZpError reason;
  bool differs[ZP_KEYS] = {false};
  ZpStatus status = resolve(s, 0, &first, &reason);
  if (status != ZP_OK)
    say_of(s, 0, status, &reason, err);
  else
    status = compare_defs(s, &first, differs, err);
  Writer w = {.scenario = s, .first = &first, .differs = differs, .file = file};
  if (status == ZP_OK) write_keys(&w);
  zp_def_clear(&first);
  if (status == ZP_OK && (fflush(file) || ferror(file)))
    return zp_fail(err, ZP_MACHINE, "the scenario cannot be written: %s", strerror(errno));
  return status;
}
