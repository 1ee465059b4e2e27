/* Checks that more than one study shares, and the words of messages. All name the key in ZP_BAD_INPUT. */
#ifndef ZP_DEF_CHECK_H
#define ZP_DEF_CHECK_H

#include <zipact/def.h>

/* A mount.tilt nearer than this to a right angle is one: what degrees written with five digits round to, rad. */
static const double zp_tilt_rounding = 1e-5;

/* Members of a series at most: so many groups member_K are in keys.def. */
enum { ZP_MOST_MEMBERS = 8 };

/* Where the fields of a group of keys lie in a Def. */
typedef struct ZpKeyGroup {
  const char *name;
  size_t first, size;
} ZpKeyGroup;
#define ZP_KEY_GROUP(group)                                                                                            \
  { #group, offsetof(ZpActuatorDef, group), sizeof(((ZpActuatorDef *)0)->group) }

/* Is this a key of the group? Asked of all keys for every case: no names are compared. */
static inline bool zp_key_is_in(int key, ZpKeyGroup group) {
  size_t offset = zp_key(key)->offset;
  return offset >= group.first && offset - group.first < group.size;
}

/* (name of a choice key, place in its list) => the word. */
const char *zp_word_of(const char *key, int choice);

/* What liquid.model bead asks of other keys, whatever liquid.model is: where it is refused, auto stands for none. */
ZpStatus zp_check_bead(const ZpActuatorDef *def, ZpError *err);

/* Does the actuator have two ribbons that face each other? */
bool zp_def_has_two(const ZpActuatorDef *def);

/* The keys of the lower ribbon: those of the upper one, but where lower.* says otherwise. */
ZpActuatorDef zp_def_lower(const ZpActuatorDef *def);

/* Member 1 .. stack.series of a series, alone: as the others, but where member_K.* says otherwise. The last one carries
 * load.mass and load.force, the others a link; of antagonists the first one carries them, and the last one is upside
 * down. */
ZpActuatorDef zp_def_member(const ZpActuatorDef *def, int member);

/* Are the two members of a series antagonists, between mounts at stack.distance? Voltage of the lower one where the
 * upper one has `voltage`, V. */
bool zp_def_opposed(const ZpActuatorDef *def);
double zp_def_lower_voltage(const ZpActuatorDef *def, double voltage);

/* What a stack asks of other keys; may all members of a series have this voltage, V? */
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
