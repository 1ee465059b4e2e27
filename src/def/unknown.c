/* Messages about keys that do not exist. A key of something that is not modelled would get the suggestion of a key with
 * a similar name and another meaning, which misleads: a table says what to give instead. */
#include <stdio.h>
#include <string.h>

#include <zipact/def.h>

/* A part of the name, between points and underscores, and what to give instead. */
typedef struct NotModelled {
  const char *word, *instead;
} NotModelled;

static const NotModelled not_modelled[] = {
    {"temperature", "give the properties at that temperature, such as medium.kinematic_viscosity"},
    {"heat", NULL},
    {"heating", NULL},
    {"thermal", NULL},
    {"humidity", "give insulator.resistivity and air.breakdown_field at that humidity"},
    {"pressure", "give air.breakdown_field at the pressure of the surroundings"},
    {"altitude", "give air.breakdown_field at that altitude"},
    {"friction", NULL},
    {"adhesion", NULL},
    {"stiction", NULL},
    {"adhesive", "add its thickness to insulator.thickness"},
    {"glue", "add its thickness to insulator.thickness"},
    {"twist", NULL},
    {"torsion", NULL},
    {"fatigue", NULL},
    {"creep", NULL},
    {"ageing", NULL},
    {"aging", NULL},
    {"wear", NULL},
    {"crack", NULL},
    {"evaporation", NULL},
    {"corona", "notes report a field that exceeds the dielectric strength"},
    {"discharge", "notes report a field that exceeds the dielectric strength"},
    {"spark", "notes report a field that exceeds the dielectric strength"},
    {"magnetic", NULL},
};

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

/* The row of not_modelled with a word of the name, -1 if there is none. */
static int find_row(const char *name) {
  for (size_t length; *name; name += length + (name[length] != 0)) {
    length = strcspn(name, "._");
    for (size_t i = 0; i < sizeof not_modelled / sizeof not_modelled[0]; i++)
      if (is_word(name, length, not_modelled[i].word)) return (int)i;
  }
  return -1;
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

void zp_key_unknown(const char *name, char *text, size_t size) {
  const int row = find_row(name);
  if (row >= 0) {
    const char *instead = not_modelled[row].instead;
    snprintf(text, size, "%s is not modelled%s%s", not_modelled[row].word, instead ? "; " : "", instead ? instead : "");
    return;
  }
  char renamed[LONGEST];
  rename_parts(name, renamed, sizeof renamed);
  const bool fits = zp_key_find(renamed) >= 0 || !strchr(name, '.');
  snprintf(text, size, "unknown key; did you mean %s?", zp_key_nearest(fits ? renamed : name));
}
