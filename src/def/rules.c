/* The checker of rules, and its messages. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "def/device.h"

enum { WORDS = 256, VALUE = 96 };

/* -- conditions ------------------------------------------------------------------------------------ */

/* A Def that rules ask, with what many of them ask of it, found when the first one does. */
typedef struct Subject {
  const ZpActuatorDef *def;
  bool knows_keys, knows_liquid;
  bool set[ZP_KEYS]; /* zp_def_find_set */
  ZpLiquidModel liquid;
} Subject;

static void begin(Subject *of, const ZpActuatorDef *def) {
  of->def = def;
  of->knows_keys = of->knows_liquid = false;
}

static bool is_set(Subject *of, int key) {
  if (!of->knows_keys) zp_def_find_set(of->def, of->set);
  of->knows_keys = true;
  return of->set[key];
}

static double value_of(Subject *of, int key) {
  if (key == ZP_KEY(insulator.thickness)) return zp_insulator_thickness(of->def);
  if (key != ZP_KEY(liquid.model)) return zp_def_get(of->def, key);
  if (!of->knows_liquid) of->liquid = zp_def_liquid(of->def);
  of->knows_liquid = true;
  return (double)of->liquid;
}

/* The key of a condition; of a range the first that is set, or -1. */
static int key_of(const ZpCondition *c, Subject *of) {
  if (c->test == ZP_TEST_SEVERAL && zp_def_parallel(of->def)) return ZP_KEY(stack.parallel);
  if (c->test != ZP_TEST_SET_WITHIN) return c->key;
  for (int key = c->key; key <= (int)c->value; key++)
    if (is_set(of, key)) return key;
  return -1;
}

static bool holds_for(const ZpCondition *c, double value) {
  switch (c->test) {
  case ZP_TEST_IS:
    return value == c->value;
  case ZP_TEST_IS_NOT:
    return value != c->value;
  case ZP_TEST_ONE_OF:
    return ((unsigned)c->value >> (unsigned)value & 1) != 0;
  case ZP_TEST_HAS:
  case ZP_TEST_LACKS:
    return ((zp_device_of((ZpActuatorKind)value)->has & (unsigned)c->value) != 0) == (c->test == ZP_TEST_HAS);
  case ZP_TEST_ABOVE:
    return value > c->value;
  case ZP_TEST_AT_LEAST:
    return value >= c->value;
  case ZP_TEST_AT_MOST:
    return !(value > c->value);
  default:
    return false;
  }
}

static bool holds(const ZpCondition *c, Subject *of) {
  const ZpActuatorDef *def = of->def;
  switch (c->test) {
  case ZP_TEST_ANY:
    return true;
  case ZP_TEST_NEVER:
    return false;
  case ZP_TEST_SET:
    return is_set(of, c->key);
  case ZP_TEST_UNSET:
    return !is_set(of, c->key);
  case ZP_TEST_SET_WITHIN:
    return key_of(c, of) >= 0;
  case ZP_TEST_SEVERAL:
    return zp_def_members(def) > 1 || zp_def_network(def);
  case ZP_TEST_NETWORK:
    return zp_def_network(def);
  case ZP_TEST_FOLLOWS:
    return zp_def_has(def, ZP_DEVICE_ELECTRODES) || zp_def_drives(def, false);
  case ZP_TEST_DRIVES:
    return zp_def_drives(def, false);
  case ZP_TEST_PLANE:
    return zp_def_plane(def);
  default:
    return holds_for(c, value_of(of, c->key));
  }
}

/* -- the checker ----------------------------------------------------------------------------------- */

static const ZpRule *find_among(const ZpRules *rules, bool in_motion, Subject *of) {
  for (size_t k = 0; k < rules->count; k++) {
    const ZpRule *rule = &rules->rule[k];
    if (rule->in_motion == in_motion && holds(&rule->when, of) && holds(&rule->also, of) && !holds(&rule->needs, of))
      return rule;
  }
  return NULL;
}

const ZpRule *zp_rules_find(const ZpRules *rules, bool in_motion, const ZpActuatorDef *def) {
  Subject of;
  begin(&of, def);
  return find_among(rules, in_motion, &of);
}

static const ZpRules *const *const owners[] = {
#define ZP_OWNER(name) zp_rules_of_##name,
#include "def/rules.def"
#undef ZP_OWNER
};
enum { OWNERS = sizeof owners / sizeof owners[0] };

const ZpRule *zp_rule_refusing(bool in_motion, const ZpActuatorDef *def) {
  Subject of;
  const ZpRule *found = NULL;
  begin(&of, def);
  for (size_t k = 0; k < OWNERS; k++)
    for (const ZpRules *const *rules = owners[k]; *rules && !found; rules++)
      found = find_among(*rules, in_motion, &of);
  return found;
}

int zp_key_without_use(const ZpActuatorDef *def, int first, int last) {
  Subject subject;
  int least = last + 1;
  begin(&subject, def);
  for (size_t k = 0; k < OWNERS; k++)
    for (const ZpRules *const *of = owners[k]; *of; of++)
      for (size_t i = 0; i < (*of)->count; i++) {
        const ZpRule *rule = &(*of)->rule[i];
        const bool asks = rule->when.test == ZP_TEST_SET && rule->when.key >= first && rule->when.key < least;
        if (asks && holds(&rule->when, &subject) && holds(&rule->also, &subject) && !holds(&rule->needs, &subject))
          least = rule->when.key;
      }
  return least <= last ? least : -1;
}

const ZpRule *zp_rule_against(int key, int choice, const ZpActuatorDef *def) {
  Subject subject;
  begin(&subject, def);
  for (size_t k = 0; k < OWNERS; k++)
    for (const ZpRules *const *of = owners[k]; *of; of++)
      for (size_t i = 0; i < (*of)->count; i++) {
        const ZpRule *rule = &(*of)->rule[i];
        bool asks = rule->when.key == key && holds_for(&rule->when, choice);
        if (asks && holds(&rule->also, &subject) && !holds(&rule->needs, &subject)) return rule;
      }
  return NULL;
}

/* -- its words ------------------------------------------------------------------------------------- */

/* A value as it is written: "electro_ribbon", "true", "none", "5 N/m". */
static void show_value(int key, double value, char text[VALUE]) {
  const ZpKey *k = zp_key(key);
  bool pure = strcmp(k->unit, "1") == 0;
  if (k->type == ZP_KEY_ENUM)
    snprintf(text, VALUE, "%s", k->choices[(int)value].word);
  else if (k->type == ZP_KEY_BOOL)
    snprintf(text, VALUE, "%s", value != 0 ? "true" : "false");
  else if (k->type == ZP_KEY_TEXT)
    snprintf(text, VALUE, "empty");
  else if (isnan(value))
    snprintf(text, VALUE, "%s", k->text);
  else
    snprintf(text, VALUE, "%g%s%s", value, pure ? "" : " ", pure ? "" : k->unit);
}

/* The words of a choice key for which a condition holds: "ramp, sine or square". */
static void show_words(const ZpCondition *c, char text[VALUE]) {
  const ZpKey *key = zp_key(c->key);
  unsigned bits = 0;
  size_t used = 0;
  text[0] = 0;
  for (int word = 0; word <= (int)key->max; word++)
    if (holds_for(c, word)) bits |= 1U << (unsigned)word;
  for (int word = 0; bits >> word; word++) {
    if (!(bits >> word & 1)) continue;
    const char *between = used == 0 ? "" : bits >> word == 1 ? " or " : ", ";
    used += (size_t)snprintf(text + used, VALUE - used, "%s%s", between, key->choices[word].word);
  }
}

void zp_condition_text(const ZpCondition *c, char *text, size_t size) {
  static const char *const before[] = {[ZP_TEST_IS_NOT] = " other than",
                                       [ZP_TEST_ABOVE] = " above",
                                       [ZP_TEST_AT_LEAST] = " at least",
                                       [ZP_TEST_AT_MOST] = " at most",
                                       [ZP_TEST_NEVER] = ""};
  const ZpKey *key = zp_key(c->key);
  const bool is_set_of_words = key->type == ZP_KEY_ENUM && c->test != ZP_TEST_UNSET;
  char value[VALUE];
  if (is_set_of_words)
    show_words(c, value);
  else
    show_value(c->key, c->test == ZP_TEST_UNSET ? key->def : c->value, value);
  switch (c->test) {
  case ZP_TEST_ANY:
  case ZP_TEST_NEVER:
    *text = 0;
    break;
  case ZP_TEST_SET:
    snprintf(text, size, "%s", key->name);
    break;
  case ZP_TEST_SET_WITHIN:
    snprintf(text, size, "%s to %s", key->name, zp_key((int)c->value)->name);
    break;
  case ZP_TEST_SEVERAL:
    snprintf(text, size, "stack with several members");
    break;
  case ZP_TEST_NETWORK:
    snprintf(text, size, "bodies");
    break;
  case ZP_TEST_FOLLOWS:
    snprintf(text, size, "actuator.kind with electrodes, or segment_K.curvature_per_volt");
    break;
  case ZP_TEST_DRIVES:
    snprintf(text, size, "curvature that voltage drives");
    break;
  case ZP_TEST_PLANE:
    snprintf(text, size, "bodies that move in the plane");
    break;
  default:
    snprintf(text, size, "%s%s %s", key->name, is_set_of_words || !before[c->test] ? "" : before[c->test], value);
  }
}

/* "load.stiffness = 5 N/m" */
static void show_key(const ZpCondition *c, const ZpActuatorDef *def, char text[WORDS]) {
  Subject subject;
  begin(&subject, def);
  int key = key_of(c, &subject);
  char value[VALUE];
  bool unequal = zp_def_parallel(def) && c->test == ZP_TEST_SEVERAL;
  if (zp_def_network(def) && (c->test == ZP_TEST_SEVERAL || c->test == ZP_TEST_NETWORK)) {
    snprintf(text, WORDS, "bodies");
    return;
  }
  if (c->test == ZP_TEST_PLANE || c->test == ZP_TEST_DRIVES) {
    snprintf(text, WORDS, "%s", c->test == ZP_TEST_PLANE ? "moves = plane" : "curvature that voltage drives");
    return;
  }
  const int given = zp_key_is_row(key) ? zp_instance_given(def, key) : -1;
  if (given >= 0 && !zp_key_is_of_segment(given)) {
    snprintf(text, WORDS, "%s", ZP_KEY_SHOWN(def, given));
    return;
  }
  if (given >= 0) key = given;
  show_value(key, value_of(&subject, key), value);
  if (zp_key(key)->type == ZP_KEY_TEXT)
    snprintf(text, WORDS, "%s", zp_key(key)->name);
  else
    snprintf(text, WORDS, "%s = %s%s", ZP_KEY_NAME(key), value, unequal ? " with unequal members" : "");
}

ZpStatus zp_rule_fail(const ZpRule *rule, const char *asks, const ZpActuatorDef *def, ZpError *err) {
  if (!rule) return ZP_OK;
  bool bare = rule->when.test == ZP_TEST_ANY;
  const ZpCondition *needs = &rule->needs;
  char head[WORDS], needed[WORDS], value[VALUE], given[VALUE + 16] = "";
  show_key(bare ? needs : &rule->when, def, head);
  if (needs->test == ZP_TEST_NEVER)
    return zp_fail(err, ZP_BAD_INPUT, "%s: %sdoes not support this; %s", head, asks, rule->why);
  zp_condition_text(needs, needed, sizeof needed);
  const char *space = strchr(needed, ' '), *words = bare && space ? space + 1 : needed; /* the head has the key */
  Subject subject;
  begin(&subject, def);
  show_value(needs->key, value_of(&subject, needs->key), value);
  if (needs->test == ZP_TEST_SET)
    snprintf(given, sizeof given, ", which is missing");
  else if (!bare && zp_key(needs->key)->type != ZP_KEY_TEXT && zp_key(needs->key)->type != ZP_KEY_BOOL)
    snprintf(given, sizeof given, ", but it is %s", value);
  return zp_fail(err, ZP_BAD_INPUT, "%s: %srequires %s%s; %s", head, asks, words, given, rule->why);
}
