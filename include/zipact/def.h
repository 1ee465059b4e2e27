/* The definition of an actuator, "Def": a value for each key, behind a handle.
 *
 * Keys have names ("load.mass"; `zipact keys` lists them with meaning, unit, default and range) and indices, which a
 * program finds by name while it runs. There are three ways to fill a Def, with the same result: set one key after
 * another by its name or its index, or give a list of assignments (zp_def_resolve), which also applies presets.
 * zp_def_check checks the values; all functions that use a Def call it. All numbers are SI; io.h has a function that
 * reads "8 g", and scenarios, in which a key may have a list of values. A key that is `auto` or `none` is NAN.
 *
 * A Def is created by zp_def_create or zp_def_copy, which return NULL if there is no memory. Every function that takes
 * a Def refuses NULL (ZP_MACHINE, "no memory"; NAN, NULL, 0 or false if it returns no status), so that a program need
 * not ask twice. The functions of this header refuse an index without a key, such as the -1 of zp_key_find, in the
 * same way, with ZP_BAD_INPUT.
 */
#ifndef ZIPACT_DEF_H
#define ZIPACT_DEF_H

#include <stdbool.h>
#include <stddef.h>

#include <zipact/api.h>
#include <zipact/error.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The enumerations: one type per list of choices.def, values from 0 in the order written there. A later library may add
 * words at the end of a list. */
#define ZP_CHOICES(type)                  typedef enum type {
#define ZP_CHOICE(enumerator, word, help) enumerator,
#define ZP_CHOICES_END(type)                                                                                           \
  }                                                                                                                    \
  type;
#include <zipact/choices.def>
#undef ZP_CHOICES
#undef ZP_CHOICE
#undef ZP_CHOICES_END

/* Bytes of a text key with the final 0. */
#define ZP_TEXT_SIZE 256

/* The definition of an actuator and of what is done with it. The study is not part of it: a scenario is a Def and a
 * study (study.h). */
typedef struct ZpActuatorDef ZpActuatorDef;

/* Kind of value that a key takes. */
typedef enum ZpKeyType {
  ZP_KEY_REAL,      /* a number with a unit */
  ZP_KEY_REAL_AUTO, /* a number with a unit, or a word (auto or none; NAN), which is its default */
  ZP_KEY_INT,       /* a whole number */
  ZP_KEY_BOOL,      /* 0 or 1; written true, false */
  ZP_KEY_ENUM,      /* one of `choices`, by its place in the list */
  ZP_KEY_TEXT       /* a text; has no number (NAN) */
} ZpKeyType;

/* A word of a choice key. */
typedef struct ZpChoice {
  const char *word; /* as written in a scenario */
  const char *help; /* one line */
} ZpChoice;

/* A key. */
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
  const char *text;        /* ZP_KEY_TEXT: default; ZP_KEY_REAL_AUTO: the word for NAN, auto or none; else NULL */
} ZpKey;

/* A value for a key. */
typedef struct ZpAssignment {
  int key;      /* index of the key, see zp_key_find */
  double value; /* SI; NAN for auto and none; the place of a word in its list; 0 or 1 */
} ZpAssignment;

/* The value that a material has for one key of its group. */
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

/* Number of keys. Those of all members, bodies and springs count once: member_K.ribbon.thickness and so on, which
 * cannot be set. */
ZP_API int zp_key_count(void);

/* Key `index`, 0 <= index < zp_key_count(), in the order of `zipact keys`. Larger indices are keys of single members
 * (zp_key_find): for these it is the key that stands for those of all members. NULL for any other. */
ZP_API const ZpKey *zp_key(int index);

/* Index of the key called `name`, or -1. That of member_1.ribbon.thickness and so on is zp_key_count() or more. */
ZP_API int zp_key_find(const char *name);

/* Bytes of the name of a key with the final 0, at most. */
#define ZP_KEY_NAME_SIZE 64

/* The name of key `index`: of a member's "member_3.ribbon.thickness", which is written into `text`, else
 * zp_key(index)->name. NULL if there is no such key. */
ZP_API const char *zp_key_name(int index, char text[ZP_KEY_NAME_SIZE]);

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

/* Does a Def have key `index`? False for the key of the scenario, study, and for those that stand for all members. */
ZP_API bool zp_key_in_def(int index);

/* The key that follows `index` in the order of `zipact keys`, after -1 the first, -1 after the last: all keys that
 * zp_key_count counts but those that stand for all members, and in their place the members' keys that `def` has. */
ZP_API int zp_def_next_key(const ZpActuatorDef *def, int index);

/* Value of key `index` in `def`, as in ZpAssignment; NAN for a text key and for a key of the scenario. A key that
 * stands for those of all members, bodies or springs has its default. */
ZP_API double zp_def_get(const ZpActuatorDef *def, int index);

/* Set one key. ZP_BAD_INPUT, with key, value, unit and range, if the value is out of range or not a number, or if the
 * key belongs to the scenario; `def` is then unchanged. */
ZP_API ZpStatus zp_def_set(ZpActuatorDef *def, int index, double value, ZpError *err);

/* Text of the text key `index` in `def`; NULL if the key is of another type. */
ZP_API const char *zp_def_text(const ZpActuatorDef *def, int index);

/* Set a text key. ZP_BAD_INPUT if the text is longer than 255 bytes or has control characters, or the key is
 * of another type; `def` is then unchanged. */
ZP_API ZpStatus zp_def_set_text(ZpActuatorDef *def, int index, const char *text, ZpError *err);

/* zp_def_get and zp_def_set by the name of a key, which is found by comparison: programs that set a key thousands of
 * times look its index up once. An unknown name gives NAN, or ZP_BAD_INPUT with the nearest known key. */
ZP_API double zp_def_number(const ZpActuatorDef *def, const char *key);
ZP_API ZpStatus zp_def_set_number(ZpActuatorDef *def, const char *key, double value, ZpError *err);

/* The value of a key as a word: that of a choice, true or false, auto or none, or a text; NULL if its value is a
 * number, and if there is no such key. Valid until the key is set or the Def is destroyed. */
ZP_API const char *zp_def_word(const ZpActuatorDef *def, const char *key);

/* Set a key by a word as zp_def_word gives it, or a text key by a text. ZP_BAD_INPUT names the key and the words that
 * it takes; `def` is then unchanged. */
ZP_API ZpStatus zp_def_set_word(ZpActuatorDef *def, const char *key, const char *word, ZpError *err);

/* Number of members of the system: stack.series, or stack.parallel if a member has keys of its own. Equal actuators
 * side by side count as one. */
ZP_API int zp_def_members(const ZpActuatorDef *def);

/* Does this key name a material (ribbon.material and the like), which sets other keys? */
ZP_API bool zp_key_is_material(int index);

/* The value that key `index` gets from the material that `def` names for its group; NULL if it gets none. */
ZP_API const ZpMaterialValue *zp_material_value(const ZpActuatorDef *def, int index);

/* Fill `def` from the defaults, those of the kind, the preset, supply and materials, and `count` assignments, in this
 * order; the last assignment of a key counts. ZP_BAD_INPUT as zp_def_set, and if a preset has no value of a key that is
 * not given. */
ZP_API ZpStatus zp_def_resolve(ZpActuatorDef *def, const ZpAssignment *list, size_t count, ZpError *err);

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
 * ZP_LIQUID_NONE. ZP_LIQUID_NONE also without a Def. */
ZP_API ZpLiquidModel zp_def_liquid(const ZpActuatorDef *def);

/* film.roughness, or what auto means: 2 um, of a device with a gap at its clamp or all along at most 1 % of that; m. */
ZP_API double zp_def_roughness(const ZpActuatorDef *def);

/* solver.tolerance as a number: the relative error at which the time steps of a motion aim. */
ZP_API double zp_def_tolerance(const ZpActuatorDef *def);

#ifdef __cplusplus
}
#endif

#endif
