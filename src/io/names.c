#include "io/names.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "def/rule.h"
#include "io/value.h"

static const char *const group[ZP_NAMED_KINDS] = {[ZP_OF_MEMBER] = "members",
                                                  [ZP_OF_BODY] = "bodies",
                                                  [ZP_OF_SPRING] = "springs",
                                                  [ZP_OF_JOINT] = "joints",
                                                  [ZP_OF_PORT] = "ports"};
static const char frame[] = "frame";

bool zp_names_copy(const ZpGivenNames *from, ZpGivenNames *names) {
  *names = (ZpGivenNames){calloc(from->count + 1, sizeof *names->name), from->count};
  if (names->name && from->count > 0) memcpy(names->name, from->name, from->count * sizeof *names->name);
  return names->name != NULL;
}

void zp_names_free(ZpGivenNames *names) {
  free(names->name);
  *names = (ZpGivenNames){0};
}

/* The kind whose group a path begins with => the rest behind it and its point. */
static ZpInstanceKind kind_of(const char *path, const char **rest) {
  for (int k = 0; k < ZP_CALLED_KINDS; k++) {
    const size_t length = strlen(group[k]);
    if (strncmp(path, group[k], length) != 0 || (path[length] != 0 && path[length] != '.')) continue;
    *rest = path + length + (path[length] == '.');
    return (ZpInstanceKind)k;
  }
  return ZP_CALLED_KINDS;
}

const char *zp_names_plural(ZpInstanceKind kind) {
  return group[kind];
}

ZpInstanceKind zp_names_group(const char *path) {
  const char *rest = "";
  const ZpInstanceKind kind = kind_of(path, &rest);
  return *rest ? ZP_CALLED_KINDS : kind;
}

static bool is_name(const char *word, size_t length) {
  bool good = length > 0 && length < ZP_NAME_SIZE && *word >= 'a' && *word <= 'z';
  for (size_t k = 0; good && k < length; k++)
    good = (word[k] >= 'a' && word[k] <= 'z') || (word[k] >= '0' && word[k] <= '9') || word[k] == '_';
  return good;
}

/* The number of a name => 0: it has none, with a message. */
static int number_of(ZpGivenNames *names, ZpInstanceKind kind, const char *word, size_t length, ZpError *err) {
  char text[ZP_NAME_SIZE];
  int last = 0;
  if (!is_name(word, length)) {
    zp_fail(err, ZP_BAD_INPUT, "\"%.*s\" is no name: a to z, digits and _, a letter first, at most %d of them",
            (int)(length < 64 ? length : 64), word, ZP_NAME_SIZE - 1);
    return 0;
  }
  snprintf(text, sizeof text, "%.*s", (int)length, word);
  if (strcmp(text, frame) == 0 && kind != ZP_OF_PORT) {
    zp_fail(err, ZP_BAD_INPUT, "frame is the body that always exists and is held; take another name");
    return 0;
  }
  for (size_t k = 0; k < names->count; k++) {
    const ZpGivenName *name = &names->name[k];
    if (name->kind == (int)kind && name->number > last) last = name->number;
    if (strcmp(name->text, text) != 0) continue;
    if (name->kind == (int)kind) return name->number;
    if (kind == ZP_OF_PORT || name->kind == ZP_OF_PORT) continue;
    zp_fail(err, ZP_BAD_INPUT, "%s is a name in %s already; names are different in all groups", text,
            group[name->kind]);
    return 0;
  }
  void *more = realloc(names->name, (names->count + 1) * sizeof *names->name);
  if (!more) {
    zp_fail_memory(err);
    return 0;
  }
  names->name = more;
  if (last == ZP_MOST_MEMBERS) {
    zp_fail(err, ZP_BAD_INPUT, "more than %d %s", ZP_MOST_MEMBERS, group[kind]);
    return 0;
  }
  ZpGivenName *own = &names->name[names->count++];
  *own = (ZpGivenName){(int)kind, last + 1, ""};
  memcpy(own->text, text, sizeof own->text);
  return last + 1;
}

ZpStatus zp_names_path(ZpGivenNames *names, const char *path, char *text, size_t size, ZpError *err) {
  const char *rest;
  const ZpInstanceKind kind = kind_of(path, &rest);
  if (kind == ZP_CALLED_KINDS || *rest == 0) {
    snprintf(text, size, "%s", path);
    return ZP_OK;
  }
  const size_t length = strcspn(rest, ".");
  const int number = number_of(names, kind, rest, length, err);
  if (number == 0) return err ? err->status : ZP_BAD_INPUT;
  snprintf(text, size, "%s%d%s", zp_instance_begins(kind), number, rest + length);
  return ZP_OK;
}

ZpStatus zp_names_value(ZpGivenNames *names, bool known, int key, const char *word, double *number, ZpError *err) {
  const ZpInstanceKind kind = zp_key_names(key);
  const char *none = zp_key(key)->text;
  while (*word == ' ')
    word++;
  size_t length = strlen(word);
  while (length > 0 && word[length - 1] == ' ')
    length--;
  const bool numeric = *word && strchr("+-.0123456789", *word);
  if (numeric || (none && strcmp(word, none) == 0)) return zp_value_read(key, word, number, err);
  *number = 0;
  if (kind == ZP_OF_BODY && length == strlen(frame) && strncmp(word, frame, length) == 0) return ZP_OK;
  const size_t before = names->count;
  ZpInstanceKind numbered;
  const char *rest;
  *number = zp_instance_named(word, &numbered, &rest); /* member_2 of a stack */
  if (*number > 0 && numbered == kind && (size_t)(rest - word) == length) return ZP_OK;
  *number = number_of(names, kind, word, length, err);
  if (known && kind != ZP_OF_PORT && names->count > before)
    return zp_fail(err, ZP_BAD_INPUT, "there is no such %s", kind == ZP_OF_BODY ? "body" : "member");
  return *number > 0 ? ZP_OK : err ? err->status : ZP_BAD_INPUT;
}

char *zp_names_text(ZpGivenNames *names, const char *text) {
  static const char separators[] = " ,;<>=";
  char *whole = strdup("");
  while (whole && *text) {
    const size_t between = strspn(text, separators), length = strcspn(text + between, separators);
    char word[ZP_PATH_SIZE], path[2 * ZP_PATH_SIZE], *both = NULL;
    snprintf(word, sizeof word, "%.*s", (int)length, text + between);
    const bool named = length < sizeof word && zp_names_path(names, word, path, sizeof path, NULL) == ZP_OK;
    const int shown = named ? (int)strlen(path) : (int)length;
    if (asprintf(&both, "%s%.*s%.*s", whole, (int)between, text, shown, named ? path : text + between) < 0) both = NULL;
    free(whole);
    whole = both;
    text += between + length;
  }
  return whole;
}

/* The name of one; NULL: it has none. */
static const char *name_of(const ZpGivenNames *names, ZpInstanceKind kind, int number) {
  for (size_t k = 0; k < names->count; k++)
    if (names->name[k].kind == (int)kind && names->name[k].number == number) return names->name[k].text;
  return NULL;
}

const char *zp_names_key(const ZpGivenNames *names, int key, char text[ZP_PATH_SIZE]) {
  const ZpInstance at = zp_key_instance(key);
  const char *name = at.number > 0 ? name_of(names, at.kind, at.number) : NULL;
  const char *row = zp_key_name(key, text);
  if (!name) return row;
  char rest[ZP_KEY_NAME_SIZE];
  snprintf(rest, sizeof rest, "%s", strchr(row, '.'));
  snprintf(text, ZP_PATH_SIZE, "%s.%s%s", group[at.kind], name, rest);
  return text;
}

/* The first place, from `text` on, where a message says `number` as the beginning of a key; NULL: nowhere. What follows
   a point is a name already. */
static char *key_in(char *text, const char *number) {
  const size_t length = strlen(number);
  for (char *at = strstr(text, number); at; at = strstr(at + length, number)) {
    const bool longer = at[length] >= '0' && at[length] <= '9';
    if (!longer && (at == text || at[-1] != '.')) return at;
  }
  return NULL;
}

void zp_names_tell(const ZpGivenNames *names, ZpError *err) {
  for (size_t k = 0; err && k < names->count; k++) {
    const ZpGivenName *name = &names->name[k];
    char number[2 * ZP_NAME_SIZE], whole[sizeof err->message];
    if (name->kind == ZP_OF_PORT) continue; /* which begins no key */
    snprintf(number, sizeof number, "%s%d", zp_instance_begins((ZpInstanceKind)name->kind), name->number);
    for (char *at; (at = key_in(err->message, number));) {
      snprintf(whole, sizeof whole, "%.*s%s.%s%s", (int)(at - err->message), err->message, group[name->kind],
               name->text, at + strlen(number));
      memcpy(err->message, whole, sizeof whole);
    }
  }
}

const char *zp_names_word(const ZpGivenNames *names, int key, double number, char text[ZP_NAME_SIZE]) {
  const ZpInstanceKind kind = zp_key_names(key);
  const char *name = name_of(names, kind, (int)number);
  if (kind == ZP_OF_BODY && number == 0) return frame;
  if (name) return name;
  snprintf(text, ZP_NAME_SIZE, "%g", number);
  return text;
}

ZpStatus zp_names_give(const ZpGivenNames *names, ZpActuatorDef *def, ZpError *err) {
  return names->count > 0 ? zp_def_set_names(def, names->name, names->count, err) : ZP_OK;
}
