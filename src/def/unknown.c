/* Messages about keys that do not exist. A key of something that is not modelled would get the suggestion of a key with
 * a similar name and another meaning, which misleads: a table says what to give instead. */
#include <stdio.h>
#include <string.h>

#include "def/def.h"

#include "def/check.h"

/* How a part of the name, between points and underscores, begins; what that is; what to give instead. */
typedef struct NotModelled {
  const char *begins, *what, *instead;
} NotModelled;

static const NotModelled not_modelled[] = {
    {"temperature", "temperature", "give the properties at that temperature, such as medium.kinematic_viscosity"},
    {"therm", "temperature", "give the properties at that temperature, such as medium.kinematic_viscosity"},
    {"heat", "heat", NULL},
    {"humid", "humidity", "give insulator.resistivity and air.breakdown_field at that humidity"},
    {"pressure", "pressure", "give air.breakdown_field at the pressure of the surroundings"},
    {"altitude", "altitude", "give air.breakdown_field at that altitude"},
    {"buoyan", "buoyancy of the load", "subtract it from load.mass"},
    {"friction", "friction between ribbons", "springs.NAME.friction is that of a body on a floor or a wall"},
    {"adhesive", "adhesive", "add its thickness to insulator.thickness"},
    {"glue", "glue", "add its thickness to insulator.thickness"},
    {"adhes", "adhesion", NULL},
    {"sticti", "stiction", NULL},
    {"twist", "twist", NULL},
    {"torsion", "torsion", NULL},
    {"fatigue", "fatigue", "yield_margin says how far stresses are from yield"},
    {"life", "lifetime", "breakdown_margin and yield_margin say how far fields and stresses are from their limits"},
    {"creep", "creep", NULL},
    {"viscoelastic", "viscoelasticity", "damping.internal is the damping of the ribbons"},
    {"ageing", "ageing", NULL},
    {"aging", "aging", NULL},
    {"wear", "wear", NULL},
    {"crack", "cracks", NULL},
    {"corro", "corrosion", NULL},
    {"electroly", "electrolysis", NULL},
    {"evaporat", "evaporation", NULL},
    {"corona", "corona", "notes report a field that exceeds the dielectric strength"},
    {"discharge", "discharge", "notes report a field that exceeds the dielectric strength"},
    {"spark", "spark", "notes report a field that exceeds the dielectric strength"},
    {"magnet", "magnetism", NULL},
    {"piezo", "piezoelectricity", NULL},
    {"induct", "inductance", NULL},
    {"acoustic", "sound", NULL},
    {"sound", "sound", NULL},
    {"radiat", "radiation", NULL},
};

/* Pictures are drawn by programs, and a scenario may come from a stranger. */
static const char templates[] = "output.templates";

/* A name that others use for a group or for the last word of a key, and its name here. */
typedef struct OtherName {
  const char *theirs, *ours;
} OtherName;

static const OtherName other_names[] = {
    {"tape", "insulator"},
    {"dielectric", "insulator"},
    {"oil", "medium"},
    {"fluid", "medium"},
    {"steel", "ribbon"},
    {"strip", "ribbon"},
    {"metal", "ribbon"},
    {"electrode", "ribbon"},
    {"e", "young_modulus"},
    {"modulus", "young_modulus"},
    {"viscosity", "kinematic_viscosity"},
    {"fringe", "edges"},
    {"fringing", "edges"},
    {"dt", "time_step"},
    {"timestep", "time_step"},
    {"duration", "end_time"},
    {"time", "end_time"},
};

enum { LONGEST = 128 };

/* Are the first `length` letters of `text` this word, whatever their case? */
static bool is_word(const char *text, size_t length, const char *word) {
  char copy[LONGEST];
  snprintf(copy, sizeof copy, "%.*s", (int)length, text);
  return strlen(word) == length && zp_word_distance(copy, word) == 0;
}

/* The row of not_modelled with which a part of the name begins, NULL if there is none. */
static const NotModelled *find_row(const char *name) {
  for (size_t length; *name; name += length + (name[length] != 0)) {
    length = strcspn(name, "._");
    for (size_t i = 0; i < sizeof not_modelled / sizeof not_modelled[0]; i++)
      if (is_word(name, strlen(not_modelled[i].begins), not_modelled[i].begins)) return &not_modelled[i];
  }
  return NULL;
}

/* The name with the names that groups and keys have here. */
static void rename_parts(const char *name, char *text, size_t size) {
  size_t used = 0;
  text[0] = 0;
  for (size_t length; *name && used + 1 < size; name += length + (name[length] != 0)) {
    length = strcspn(name, ".");
    const char *part = name;
    int shown = (int)length;
    for (size_t i = 0; i < sizeof other_names / sizeof other_names[0]; i++)
      if (is_word(name, length, other_names[i].theirs)) {
        part = other_names[i].ours;
        shown = (int)strlen(part);
      }
    snprintf(text + used, size - used, "%.*s%s", shown, part, name[length] ? "." : "");
    used += strlen(text + used);
  }
}

/* "mass" of load.mass. */
static const char *last_part(const char *name) {
  const char *dot = strrchr(name, '.');
  return dot ? dot + 1 : name;
}

/* Length of the group of a name, which is the whole name if it has no point. */
static size_t group_length(const char *name) {
  return strcspn(name, ".");
}

static bool same_group(const char *name, const char *key) {
  char group[LONGEST];
  snprintf(group, sizeof group, "%.*s", (int)group_length(key), key);
  return is_word(name, group_length(name), group);
}

/* Is the name a misspelling of the key, or a part of it in the same group, as medium.viscosity? */
static bool resembles(const char *name, const char *key) {
  const bool is_part = strchr(name, '.') && *last_part(name) && strstr(last_part(key), last_part(name));
  return (is_part && same_group(name, key)) || 3 * zp_key_distance(name, key) <= (int)strlen(name);
}

/* The key of any group whose last part contains the name and is shortest, as ribbon.young_modulus for young; NULL if
 * there is none. */
static const char *find_part(const char *name) {
  const char *found = NULL;
  for (int i = 0; strlen(name) >= 5 && i < zp_key_count(); i++) {
    const char *key = zp_key(i)->name;
    const bool has = strstr(last_part(key), name) != NULL;
    if (has && (!found || strlen(last_part(key)) < strlen(last_part(found)))) found = key;
  }
  return found;
}

/* "unknown key; load has mass, share, ..."; of a group within the group its name. False if there is no such group. */
static bool list_group(const char *name, char *text, size_t size) {
  const char *before = "";
  size_t used = 0;
  for (int i = 0; i < zp_key_count(); i++) {
    const char *key = zp_key(i)->name, *rest = key + group_length(key);
    if (!*rest || !same_group(name, key)) continue;
    const size_t length = strcspn(rest + 1, ".");
    if (strncmp(before, rest + 1, length) == 0 && (before[length] == 0 || before[length] == '.')) continue;
    if (used > 0 && used + length + sizeof ", ..." >= size) {
      snprintf(text + used, size - used, ", ...");
      return true;
    }
    if (used > 0)
      snprintf(text + used, size - used, ", %.*s", (int)length, rest + 1);
    else
      snprintf(text, size, "unknown key; %.*s has %.*s", (int)group_length(key), key, (int)length, rest + 1);
    before = rest + 1;
    used = strlen(text);
  }
  return used > 0;
}

static void say_unknown(const char *name, char *text, size_t size) {
  if (strcmp(name, templates) == 0) {
    snprintf(text, size,
             "templates of pictures run as programs, so no scenario can name them; use --templates FOLDER on the "
             "command line");
    return;
  }
  const NotModelled *row = find_row(name);
  if (row) {
    snprintf(text, size, "%s is not modelled%s%s", row->what, row->instead ? "; " : "",
             row->instead ? row->instead : "");
    return;
  }
  char renamed[LONGEST];
  rename_parts(name, renamed, sizeof renamed);
  const bool fits = zp_key_find(renamed) >= 0 || !strchr(name, '.');
  const char *meant = fits ? renamed : name, *nearest = zp_key_nearest(meant);
  const char *key = resembles(meant, nearest) ? nearest : find_part(meant);
  if (key)
    snprintf(text, size, "unknown key; did you mean %s?", key);
  else if (!list_group(renamed, text, size))
    snprintf(text, size, "unknown key, and none has a similar name; zipact keys lists all");
}

/* Of a name that begins with a member and the like, K stands for its number until the reason is found. */
static void say_of_instance(const char *begins, int number, const char *rest, char *text, size_t size) {
  char row[LONGEST], reason[2 * LONGEST];
  snprintf(row, sizeof row, "%sK%.100s", begins, rest);
  say_unknown(row, reason, sizeof reason);
  const char *letter = strstr(reason, "_K");
  if (letter)
    snprintf(text, size, "%.*s_%d%s", (int)(letter - reason), reason, number, letter + 2);
  else
    snprintf(text, size, "%s", reason);
}

void zp_key_unknown(const char *name, char *text, size_t size) {
  const char *rest;
  ZpInstanceKind kind;
  const int number = zp_instance_named(name, &kind, &rest);
  int most = 0; /* of a kind whose name it has with K, or with a number beyond this last one; 0: of none */
  for (int k = 0; number == 0 && most == 0 && k < ZP_INSTANCE_KINDS; k++) {
    const size_t length = strlen(zp_instance_begins((ZpInstanceKind)k));
    const bool numbered = strncmp(name, zp_instance_begins((ZpInstanceKind)k), length) == 0 && name[length] &&
                          strchr("K0123456789", name[length]);
    if (numbered) most = k < ZP_CALLED_KINDS ? ZP_MOST_MEMBERS : ZP_MOST_SEGMENTS;
  }
  if (number > 0)
    say_of_instance(zp_instance_begins(kind), number, rest, text, size);
  else if (most > 0)
    snprintf(text, size, "unknown key; %s have the numbers 1 to %d",
             most == ZP_MOST_SEGMENTS ? "segments" : "members, bodies, springs and joints", most);
  else
    say_unknown(name, text, size);
}
