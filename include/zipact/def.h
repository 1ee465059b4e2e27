/* The definition of an actuator, "Def": plain data, one field per key of keys.def.
 *
 * Make a Def by zp_actuator_def_default or zp_def_resolve, which store the layout of the headers in it. Every function
 * that takes a Def refuses one that was made in another way, or with headers whose keys differ from those of the
 * library (ZP_BAD_INPUT; NAN or NULL if it returns no status). So a program never reads the wrong key.
 *
 * There are three ways to fill a Def, with the same result: assign its fields (def.load.mass = 0.008), set it by key
 * (zp_def_set), or give a list of assignments (zp_def_resolve), which also applies presets. zp_def_check checks the
 * values; all functions that use a Def call it. All numbers are SI. A key that is `auto` or `none` is NAN.
 */
#ifndef ZIPACT_DEF_H
#define ZIPACT_DEF_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <zipact/api.h>
#include <zipact/error.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The enumerations: one type per list of choices.def, values from 0 in the order written there. */
#define ZP_CHOICES(type)                  typedef enum type {
#define ZP_CHOICE(enumerator, word, help) enumerator,
#define ZP_CHOICES_END(type)                                                                                           \
  type##_COUNT                                                                                                         \
  }                                                                                                                    \
  type;
#include <zipact/choices.def>
#undef ZP_CHOICES
#undef ZP_CHOICE
#undef ZP_CHOICES_END

/* Bytes of a text key with the final 0. */
#define ZP_TEXT_SIZE 256

/* The definition of an actuator and of what is done with it. Field x.y is key "x.y"; keys.def (or `zipact keys`) has
 * meaning, unit, default and range of each. The study is not part of it: a scenario is a Def and a study (study.h). */
#define ZP_GROUP(group) struct {
#define ZP_GROUP_END(group)                                                                                            \
  }                                                                                                                    \
  group;
#define ZP_REAL(path, name, unit, shown, def, min, max, help)           double name;
#define ZP_REAL_AS(path, field, name, unit, shown, def, min, max, help) double field;
#define ZP_REAL_AUTO(path, name, unit, shown, min, max, help)           double name;
#define ZP_REAL_NONE(path, name, unit, shown, min, max, help)           double name;
#define ZP_INT(path, name, def, min, max, help)                         int name;
#define ZP_BOOL(path, name, def, help)                                  bool name;
#define ZP_ENUM(path, name, type, def, help)                            type name;
#define ZP_TEXT(path, name, def, help)                                  char name[ZP_TEXT_SIZE];
#define ZP_OF_SCENARIO(name, type, def, help)
typedef struct ZpActuatorDef {
  uint64_t layout; /* zp_def_layout of the headers that the program was compiled with; do not change it */
#include <zipact/keys.def>
} ZpActuatorDef;

/* Kind of value that a key takes. */
typedef enum ZpKeyType {
  ZP_KEY_REAL,      /* a number with a unit */
  ZP_KEY_REAL_AUTO, /* a number with a unit, or a word (auto or none; NAN), which is its default */
  ZP_KEY_INT,       /* a whole number */
  ZP_KEY_BOOL,      /* 0 or 1; written true, false */
  ZP_KEY_ENUM,      /* one of `choices`, by its place in the list */
  ZP_KEY_TEXT       /* a text; has no number (NAN) */
} ZpKeyType;

/* Offset of a key that belongs to the scenario and has no field in a Def: study. */
#define ZP_NO_FIELD ((size_t)-1)

/* A word of a choice key. */
typedef struct ZpChoice {
  const char *word; /* as written in a scenario */
  const char *help; /* one line */
} ZpChoice;

/* A key: one row of keys.def. */
typedef struct ZpKey {
  const char *name;        /* "ribbon.length" */
  ZpKeyType type;          /* kind of value */
  const char *unit;        /* SI unit that UDUNITS reads; "1" for a pure number or a word */
  const char *shown;       /* unit in which people write it, e.g. "mm"; "" for a pure number */
  double def;              /* default, SI; NAN for auto and none */
  double min;              /* smallest value allowed */
  double max;              /* largest value allowed */
  const char *help;        /* one line */
  const ZpChoice *choices; /* ZP_KEY_ENUM: the words, `max` + 1 of them; else NULL */
  size_t offset;           /* of its field in ZpActuatorDef, bytes; ZP_NO_FIELD: a key of the scenario */
  const char *text;        /* ZP_KEY_TEXT: default; ZP_KEY_REAL_AUTO: the word for NAN, auto or none; else NULL */
} ZpKey;

/* A value for a key. */
typedef struct ZpAssignment {
  int key;      /* index of the key, see zp_key_find */
  double value; /* SI; NAN for auto and none; the place of a word in its list; 0 or 1 */
} ZpAssignment;

/* The value that a material has for one key of its group: one row of materials.def. */
typedef struct ZpMaterialValue {
  int material;       /* place of its word in the list of key `material` of the group */
  const char *name;   /* name of the key without its group: "young_modulus" */
  double value;       /* SI */
  double spread;      /* standard deviation of the natural logarithm between deliveries; above 0 */
  const char *source; /* where the value comes from, one line */
} ZpMaterialValue;

/* A new Def in which every key has its default: the paper's actuator, with correct physics. NULL if there is no memory.
 */
ZP_API ZpActuatorDef *zp_def_create(void);

/* A copy, which belongs to the caller; NULL if there is no memory. */
ZP_API ZpActuatorDef *zp_def_copy(const ZpActuatorDef *def);

/* Free it; NULL is allowed. */
ZP_API void zp_def_destroy(ZpActuatorDef *def);

/* Number of keys. */
ZP_API int zp_key_count(void);

/* Key `index`, 0 <= index < zp_key_count(), in the order of keys.def. */
ZP_API const ZpKey *zp_key(int index);

/* Index of the key called `name`, or -1. */
ZP_API int zp_key_find(const char *name);

/* Number of letters that must be inserted, deleted, replaced or swapped with the next to turn one word into the other,
 * ignoring case. Letters after the 63rd are ignored. */
ZP_API int zp_word_distance(const char *a, const char *b);

/* The key name that differs least from `name`, for "did you mean". Never NULL. */
ZP_API const char *zp_key_nearest(const char *name);

/* The reason why `name`, which zp_key_find does not find, is not a key: "unknown key; did you mean load.mass?", the
 * keys of its group, or "temperature is not modelled" with what to give instead. `text` gets at most `size` bytes with
 * the final 0. */
ZP_API void zp_key_unknown(const char *name, char *text, size_t size);

/* Place of `word` in the list of the choice key `index`, or -1. */
ZP_API int zp_key_choice(int index, const char *word);

/* Does a Def have key `index`? False for the key of the scenario: study. */
ZP_API bool zp_key_in_def(int index);

/* Value of key `index` in `def`, as in ZpAssignment; NAN for a text key and for a key of the scenario. */
ZP_API double zp_def_get(const ZpActuatorDef *def, int index);

/* Set one key. ZP_BAD_INPUT, with key, value, unit and range, if the value is out of range or not a number, or if the
 * key belongs to the scenario; `def` is then unchanged. */
ZP_API ZpStatus zp_def_set(ZpActuatorDef *def, int index, double value, ZpError *err);

/* Text of the text key `index` in `def`; NULL if the key is of another type. */
ZP_API const char *zp_def_text(const ZpActuatorDef *def, int index);

/* Set a text key. ZP_BAD_INPUT if the text is longer than 255 bytes or has control characters, or the key is
 * of another type; `def` is then unchanged. */
ZP_API ZpStatus zp_def_set_text(ZpActuatorDef *def, int index, const char *text, ZpError *err);

/* The same by the name of a key, which is found by comparison: programs that set a key thousands of times look it up
 * once. An unknown name gives NAN, or ZP_BAD_INPUT with the nearest known key. */
ZP_API double zp_def_number(const ZpActuatorDef *def, const char *key);
ZP_API ZpStatus zp_def_set_number(ZpActuatorDef *def, const char *key, double value, ZpError *err);

/* The value of a key as a word: that of a choice, true or false, auto or none, or a text; NULL if its value is a
 * number, and if there is no such key. Valid until the key is set or the Def is destroyed. */
ZP_API const char *zp_def_word(const ZpActuatorDef *def, const char *key);

/* Set a key by such a word. ZP_BAD_INPUT names the key and the words that it takes; `def` is then unchanged. */
ZP_API ZpStatus zp_def_set_word(ZpActuatorDef *def, const char *key, const char *word, ZpError *err);

/* Number of members of the system: stack.series, or stack.parallel if a member has keys of its own. Equal actuators
 * side by side count as one. */
ZP_API int zp_def_members(const ZpActuatorDef *def);

/* Does this key name a material (ribbon.material and the like), which sets other keys? */
ZP_API bool zp_key_is_material(int index);

/* The value that key `index` gets from the material that `def` names for its group; NULL if it gets none. */
ZP_API const ZpMaterialValue *zp_material_value(const ZpActuatorDef *def, int index);

/* As zp_def_resolve, with def->layout already set: for that function and zp_actuator_def_default. ZP_BAD_INPUT if the
 * layout differs from that of the library; then nothing else is read. */
ZP_API ZpStatus zp_def_fill(ZpActuatorDef *def, const ZpAssignment *list, size_t count, ZpError *err);

/* Check the range of every key and the conditions between keys. ZP_BAD_INPUT names the key. zp_study_check also checks
 * the conditions of a study. */
ZP_API ZpStatus zp_def_check(const ZpActuatorDef *def, ZpError *err);

/* Check the conditions of motion on integrator, contact, mechanics and mass, as zp_sim_create does. ZP_BAD_INPUT names
 * the key. `def` must have passed zp_def_check. */
ZP_API ZpStatus zp_def_check_motion(const ZpActuatorDef *def, ZpError *err);

/* Does a model of this Def need a table (zp_model_create_driven), for the waveform of the setpoint if there is a
 * controller, or else of the drive? */
ZP_API bool zp_def_takes_table(const ZpActuatorDef *def);

/* Check that `voltage` (V, any sign) does not cause a short circuit. Without an insulator (insulator.thickness 0) only
 * 0 V is allowed if the electrodes touch at rest: at the clip of an electro_ribbon, or at the clamp of a flange without
 * a gap. A flange with a gap needs no insulator; a study then ends when it touches. ZP_BAD_INPUT if there is a short
 * circuit. */
ZP_API ZpStatus zp_def_check_voltage(const ZpActuatorDef *def, double voltage, ZpError *err);

/* liquid.model, or what auto means with the other keys of `def`: ZP_LIQUID_BEAD if a bead is modelled, else
 * ZP_LIQUID_NONE. ZP_LIQUID_NONE also for a Def of another library. */
ZP_API ZpLiquidModel zp_def_liquid(const ZpActuatorDef *def);

/* solver.tolerance as a number: the relative error at which the time steps of a motion aim. */
ZP_API double zp_def_tolerance(const ZpActuatorDef *def);

#ifdef __cplusplus
}
#endif

#include <zipact/layout.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The two functions that make a Def are compiled into the program, because only the program knows the size of its Def.
 * A library with other keys refuses their Defs with an error and writes nothing into them. */

/* The default of every key: the paper's actuator, with correct physics. */
static inline ZpActuatorDef zp_actuator_def_default(void) {
  ZpActuatorDef def;
  memset(&def, 0, sizeof def);
  def.layout = zp_def_layout();
  zp_def_fill(&def, NULL, 0, NULL);
  return def;
}

/* Fill `def` from the defaults, those of the kind, the preset, supply and materials, and `count` assignments, in this
 * order; the last assignment of a key counts. ZP_BAD_INPUT as zp_def_set, and if a preset has no value of a key that is
 * not given. */
static inline ZpStatus zp_def_resolve(ZpActuatorDef *def, const ZpAssignment *list, size_t count, ZpError *err) {
  def->layout = zp_def_layout();
  return zp_def_fill(def, list, count, err);
}

#ifdef __cplusplus
}
#endif

#endif
