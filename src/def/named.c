/* Keys that a text names. */
#include <string.h>

#include "base/fail.h"
#include "def/check.h"

int zp_key_named(const char *setting, const char *name, ZpError *err) {
  int key = zp_key_with_value(name);
  char reason[256];
  if (key >= 0) return key;
  zp_key_unknown(name, reason, sizeof reason);
  zp_fail(err, ZP_BAD_INPUT, "%s%s%.80s: %s", setting, *setting ? ": " : "", name, reason);
  return -1;
}

ZpStatus zp_keys_named(const char *setting, const char *text, int most, int *key, int *count, ZpError *err) {
  *count = 0;
  for (bool more = text[strspn(text, " ")] != 0; more;) {
    char name[ZP_TEXT_SIZE];
    text += strspn(text, " ");
    const size_t part = strcspn(text, ",");
    size_t length = part;
    while (length > 0 && text[length - 1] == ' ')
      length--;
    if (length == 0) return zp_fail(err, ZP_BAD_INPUT, "%s: a comma has no key on one of its sides", setting);
    memcpy(name, text, length);
    name[length] = 0;
    const int named = zp_key_named(setting, name, err);
    if (named < 0) return ZP_BAD_INPUT;
    if (*count == most) return zp_fail(err, ZP_BAD_INPUT, "%s: more than %d keys", setting, most);
    for (int i = 0; i < *count; i++)
      if (key[i] == named) return zp_fail(err, ZP_BAD_INPUT, "%s: %s is named twice", setting, name);
    key[(*count)++] = named;
    more = text[part] == ',';
    text += part + more;
  }
  return ZP_OK;
}
