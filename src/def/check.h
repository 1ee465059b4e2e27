/* Checks that more than one study shares, and the words of messages. All name the key in ZP_BAD_INPUT. */
#ifndef ZP_DEF_CHECK_H
#define ZP_DEF_CHECK_H

#include <zipact/def.h>

/* A mount.tilt nearer than this to a right angle is one: what degrees written with five digits round to, rad. */
static const double zp_tilt_rounding = 1e-5;

/* Members of a series at most: so many groups member_K are in keys.def. */
enum { ZP_MOST_MEMBERS = 8 };

/* One byte per key, in the order of the table: where a key or a group stands in this struct is its number. */
#define ZP_GROUP(group) struct {
#define ZP_GROUP_END(group)                                                                                            \
  }                                                                                                                    \
  group;
#define ZP_REAL(path, name, unit, shown, def, min, max, help)           char name;
#define ZP_REAL_AS(path, field, name, unit, shown, def, min, max, help) char field;
#define ZP_REAL_AUTO(path, name, unit, shown, min, max, help)           char name;
#define ZP_REAL_NONE(path, name, unit, shown, min, max, help)           char name;
#define ZP_INT(path, name, def, min, max, help)                         char name;
#define ZP_BOOL(path, name, def, help)                                  char name;
#define ZP_ENUM(path, name, type, def, help)                            char name;
#define ZP_TEXT(path, name, def, help)                                  char name;
#define ZP_OF_SCENARIO(name, type, def, help)                           char name;
typedef struct ZpKeyNumbers {
#include <zipact/keys.def>
} ZpKeyNumbers;

/* The keys of a group: first .. end - 1. */
typedef struct ZpKeyGroup {
  const char *name;
  int first, end;
} ZpKeyGroup;
#define ZP_KEY_GROUP(group)                                                                                            \
  {                                                                                                                    \
#group, (int)offsetof(ZpKeyNumbers, group),                                                                        \
        (int)(offsetof(ZpKeyNumbers, group) + sizeof(((ZpKeyNumbers *)0)->group))                                      \
  }

/* (name of a choice key, place in its list) => the word. */
const char *zp_word_of(const char *key, int choice);

/* What liquid.model bead asks of other keys, whatever liquid.model is: where it is refused, auto stands for none. */
ZpStatus zp_check_bead(const ZpActuatorDef *def, ZpError *err);

/* Does the actuator have two ribbons that face each other? */
bool zp_def_has_two(const ZpActuatorDef *def);

/* The keys of the lower ribbon: those of the upper one, but where lower.* says otherwise. */
ZpActuatorDef zp_def_lower(const ZpActuatorDef *def);

/* Are the members of stack.parallel unlike, since one of them has keys of its own? */
bool zp_def_abreast(const ZpActuatorDef *def);

/* Member 1 .. zp_def_members, alone: as the others, but where member_K.* says otherwise. Of a series the last one
 * carries load.mass and load.force, the others a link; of antagonists the first one carries them, and the last one is
 * upside down; side by side each carries its share. */
ZpActuatorDef zp_def_member(const ZpActuatorDef *def, int member);

/* Are the two members of a series antagonists, between mounts at stack.distance? Voltage of the lower one where the
 * upper one has `voltage`, V. */
bool zp_def_opposed(const ZpActuatorDef *def);
double zp_def_lower_voltage(const ZpActuatorDef *def, double voltage);

/* What a stack asks of other keys; may all members have this voltage, V? */
ZpStatus zp_check_stack(const ZpActuatorDef *def, ZpError *err);
ZpStatus zp_check_members_voltage(const ZpActuatorDef *def, double voltage, ZpError *err);

/* Thickness of both insulators together, m. */
double zp_insulation(const ZpActuatorDef *def);

/* Segments fit their ribbon, and lower.* has one. */
ZpStatus zp_check_ribbons(const ZpActuatorDef *def, ZpError *err);

/* What `asks`, a key or a study, knows only ribbons whose insulators are alike; and strips of one thickness. */
ZpStatus zp_check_like_insulators(const ZpActuatorDef *def, const char *asks, ZpError *err);
ZpStatus zp_check_like_sections(const ZpActuatorDef *def, const char *asks, ZpError *err);

/* What moves needs a mass. */
ZpStatus zp_check_mass(const ZpActuatorDef *def, ZpError *err);

/* The grid of the field keeps closed faces a nanometre apart: the insulator must be far thicker. */
ZpStatus zp_check_insulator_of_field(const ZpActuatorDef *def, ZpError *err);

#endif
