/* Keys that do not exist. Of what is not modelled the nearest key has a similar name and another meaning, so it would
 * mislead: a table says what to give in its place. */
#include "io/unknown.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include <zipact/def.h>

/* A word that is a part of the name, between points and underscores, and what stands for it. */
static const struct {
  const char *word, *instead;
} not_modelled[] = {
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
    {"corona", "notes say where a field exceeds the dielectric strength"},
    {"discharge", "notes say where a field exceeds the dielectric strength"},
    {"spark", "notes say where a field exceeds the dielectric strength"},
    {"magnetic", NULL},
};

/* The row of a word in the name, -1 if none. */
static int find_row(const char *name) {
  for (size_t length; *name; name += length + (name[length] != 0)) {
    length = strcspn(name, "._");
    for (size_t i = 0; i < sizeof not_modelled / sizeof not_modelled[0]; i++)
      if (strlen(not_modelled[i].word) == length && strncasecmp(not_modelled[i].word, name, length) == 0) return (int)i;
  }
  return -1;
}

void zp_unknown_key(const char *name, char *text, size_t size) {
  const int row = find_row(name);
  if (row < 0) {
    snprintf(text, size, "unknown key; did you mean %s?", zp_key_nearest(name));
    return;
  }
  const char *instead = not_modelled[row].instead;
  snprintf(text, size, "%s is not modelled%s%s", not_modelled[row].word, instead ? "; " : "", instead ? instead : "");
}
