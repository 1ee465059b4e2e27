/* A Def as a handle: creation, copies, and its keys by name. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "def/check.h"

#include "base/fail.h"
#include "base/memory.h"

ZpActuatorDef *zp_def_create(void) {
  ZpActuatorDef *def = zp_calloc(1, sizeof *def);
  if (def) zp_def_resolve(def, NULL, 0, NULL);
  return def;
}

ZpActuatorDef *zp_def_copy(const ZpActuatorDef *def) {
  ZpActuatorDef *copy = def ? zp_calloc(1, sizeof *copy) : NULL;
  if (!copy || zp_def_assign(copy, def, NULL) == ZP_OK) return copy;
  zp_free(copy);
  return NULL;
}

void zp_def_destroy(ZpActuatorDef *def) {
  if (def) zp_def_clear(def);
  zp_free(def);
}

double zp_def_number(const ZpActuatorDef *def, const char *key) {
  int index = zp_key_find(key);
  return index < 0 ? (double)NAN : zp_def_get(def, index);
}

ZpStatus zp_def_set_number(ZpActuatorDef *def, const char *key, double value, ZpError *err) {
  int index = zp_key_named("", key, err);
  return index < 0 ? ZP_BAD_INPUT : zp_def_set(def, index, value, err);
}

const char *zp_def_word(const ZpActuatorDef *def, const char *key) {
  int index = zp_key_find(key);
  if (!def || index < 0) return NULL;
  double value = zp_def_get(def, index);
  switch (zp_key(index)->type) {
  case ZP_KEY_TEXT:
    return zp_def_text(def, index);
  case ZP_KEY_BOOL:
    return value != 0 ? "true" : "false";
  case ZP_KEY_ENUM:
    return zp_key_in_def(index) ? zp_key(index)->choices[(int)value].word : NULL;
  case ZP_KEY_REAL_AUTO:
    return isnan(value) ? zp_key(index)->text : NULL;
  default:
    return NULL;
  }
}

static ZpStatus refuse_word(int index, const char *word, ZpError *err) {
  const ZpKey *key = zp_key(index);
  char words[256];
  size_t used = (size_t)snprintf(words, sizeof words, "%s", key->type == ZP_KEY_BOOL ? "true, false" : "");
  if (key->type == ZP_KEY_REAL_AUTO) snprintf(words, sizeof words, "%s, or set a number", key->text);
  for (int k = 0; key->choices && k <= (int)key->max && used < sizeof words; k++)
    used += (size_t)snprintf(words + used, sizeof words - used, "%s%s", k ? ", " : "", key->choices[k].word);
  if (!*words) return zp_fail(err, ZP_BAD_INPUT, "%s: takes a number, not a word", key->name);
  return zp_fail(err, ZP_BAD_INPUT, "%s = %.40s: unknown word; give %s", ZP_KEY_NAME(index), word, words);
}

ZpStatus zp_def_set_word(ZpActuatorDef *def, const char *key, const char *word, ZpError *err) {
  int index = zp_key_named("", key, err);
  if (index < 0) return ZP_BAD_INPUT;
  const ZpKey *k = zp_key(index);
  if (k->type == ZP_KEY_TEXT) return zp_def_set_text(def, index, word, err);
  int choice = k->type == ZP_KEY_ENUM ? zp_key_choice(index, word) : -1;
  if (choice >= 0) return zp_def_set(def, index, choice, err);
  bool truth = k->type == ZP_KEY_BOOL && strcmp(word, "true") == 0;
  if (truth || (k->type == ZP_KEY_BOOL && strcmp(word, "false") == 0)) return zp_def_set(def, index, truth, err);
  if (k->type == ZP_KEY_REAL_AUTO && strcmp(word, k->text) == 0) return zp_def_set(def, index, NAN, err);
  return refuse_word(index, word, err);
}
