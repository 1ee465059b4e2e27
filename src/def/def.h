/* The inside of a Def: one field per key of keys.def. Field x.y is key "x.y". */
#ifndef ZP_DEF_DEF_H
#define ZP_DEF_DEF_H

#include <string.h>

#include <zipact/def.h>

/* Number of words of each list of choices.def. */
#define ZP_CHOICES(type)                  enum { type##_COUNT = 0
#define ZP_CHOICE(enumerator, word, help) +1
#define ZP_CHOICES_END(type)                                                                                           \
  }                                                                                                                    \
  ;
#include <zipact/choices.def>
#undef ZP_CHOICES
#undef ZP_CHOICE
#undef ZP_CHOICES_END

/* Largest number of segments of a ribbon. */
enum { ZP_MOST_SEGMENTS = 64 };

#define ZP_MANY(group, ...)                                                                                            \
  struct {                                                                                                             \
    __VA_ARGS__                                                                                                        \
  } group[ZP_MOST_SEGMENTS];
#define ZP_GROUP(group) struct {
#define ZP_GROUP_END(group)                                                                                            \
  }                                                                                                                    \
  group;
#define ZP_REAL(path, name, unit, shown, def, min, max, help)           double name;
#define ZP_REAL_AS(path, field, name, unit, shown, def, min, max, help) double field;
#define ZP_REAL_AUTO(path, name, unit, shown, min, max, help)           double name;
#define ZP_REAL_OR_AUTO(path, name, unit, shown, def, min, max, help)   double name;
#define ZP_REAL_NONE(path, name, unit, shown, min, max, help)           double name;
#define ZP_INT(path, name, def, min, max, help)                         int name;
#define ZP_BOOL(path, name, def, help)                                  bool name;
#define ZP_ENUM(path, name, type, def, help)                            type name;
#define ZP_TEXT(path, name, def, help)                                  char name[ZP_TEXT_SIZE];
#define ZP_OF_SCENARIO(name, type, def, help)
struct ZpActuatorDef {
#include "def/keys.def"
  struct ZpInstances *given; /* of keys of members, bodies, springs and joints; NULL: none is */
};

/* The name of a member, a body or a spring. */
enum { ZP_NAME_SIZE = 32 };
typedef struct ZpGivenName {
  int kind, number;
  char text[ZP_NAME_SIZE];
} ZpGivenName;

/* The given values of keys of members, bodies, springs and joints, in the order of their indices, and their names. */
typedef struct ZpInstances {
  const ZpActuatorDef *of; /* it frees them; others only use them */
  size_t count, room;
  size_t names;
  ZpGivenName *name; /* [names] */
  ZpAssignment value[];
} ZpInstances;

/* The default of every key: the paper's actuator, with correct physics. */
static inline ZpActuatorDef zp_actuator_def_default(void) {
  ZpActuatorDef def;
  memset(&def, 0, sizeof def);
  zp_def_resolve(&def, NULL, 0, NULL);
  return def;
}

#endif
