/* Checks that several studies share, and the wording of their messages. All of them fail with ZP_BAD_INPUT and name the
 * key. */
#ifndef ZP_DEF_CHECK_H
#define ZP_DEF_CHECK_H

#include "def/def.h"

/* A mount.tilt that differs from a right angle by less than this counts as one: degrees written with five digits are
 * rounded by this much, rad. */
static const double zp_tilt_rounding = 1e-5;

/* Largest number of members of a system. */
enum { ZP_MOST_MEMBERS = 1024 };

/* One byte per key, in the order of the table: the offset of a key or group in this struct is its number. */
#define ZP_GROUP(group) struct {
#define ZP_GROUP_END(group)                                                                                            \
  }                                                                                                                    \
  group;
#define ZP_EACH_KEY(path, field, text) char field;
typedef struct ZpKeyNumbers {
#include "def/keys.def"
} ZpKeyNumbers;

/* Number of keys, as a constant. */
enum { ZP_KEYS = sizeof(ZpKeyNumbers) };

/* Keys of one member. That of member m = 1 .. ZP_MOST_MEMBERS which row r of the group member_K stands for has the
 * index ZP_KEYS + (m - 1) ZP_MEMBER_KEYS + r. */
enum { ZP_MEMBER_KEYS = sizeof(((ZpKeyNumbers *)0)->member_K) };

/* The key of this name; -1: there is none, or it stands for those of all members, so that it has no value. */
int zp_key_with_value(const char *name);

/* The key of a member that row `row` of the group member_K stands for. */
int zp_key_of_member(int row, int member);

/* The member whose key this is; 0: it is none of a member. */
static inline int zp_key_member(int index) {
  return index < ZP_KEYS ? 0 : 1 + (index - ZP_KEYS) / ZP_MEMBER_KEYS;
}

/* "member_12.ribbon" => 12 and ".ribbon"; 0: the name does not begin with a member from 1 to ZP_MOST_MEMBERS. */
int zp_member_named(const char *name, const char **rest);

/* Keys in the order of the table, those of members where their rows stand: below 0 if the first one comes first. */
int zp_key_order(int one, int other);

/* The name of a key, for a message: it lasts as long as the block around it. */
#define ZP_KEY_NAME(index) zp_key_name(index, (char[ZP_KEY_NAME_SIZE]){0})

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

/* A Def is {0} at least before it is set by a call. It may be copied by =: the copy uses the values of members' keys of
 * the first one, which must outlive it, until one of them is set in the copy or it gets another Def's by zp_def_assign.
 * From then on it has to be cleared. */
ZpStatus zp_def_assign(ZpActuatorDef *def, const ZpActuatorDef *from, ZpError *err);
void zp_def_clear(ZpActuatorDef *def);

/* The key of this name; -1, with a message that begins with the key `setting` ("": none) whose text has the name. */
int zp_key_named(const char *setting, const char *name, ZpError *err);

/* "a, b" => key [most] and their number; 0 of a blank text. ZP_BAD_INPUT: a name is unknown or stands twice, or there
 * are more than `most`. */
ZpStatus zp_keys_named(const char *setting, const char *text, int most, int *key, int *count, ZpError *err);

/* Word distance of a name from a key, or from the last part of the key plus 1, whichever is less. */
int zp_key_distance(const char *name, const char *key);

/* Conditions of liquid.model bead on other keys, whatever liquid.model is. Where they fail, auto means none. */
ZpStatus zp_check_bead(const ZpActuatorDef *def, ZpError *err);

/* The Def of the lower ribbon: that of the upper one with the keys that lower.* gives. */
ZpActuatorDef zp_def_lower(const ZpActuatorDef *def);

/* The key of the Def of ribbon 0, the upper or only one, or 1, the lower one, that changes with `key` of `def`; -1:
 * none. */
int zp_def_key_of_ribbon(const ZpActuatorDef *def, int ribbon, int key);

/* The actuator without its load: neither mass, force, spring, stop nor impact. load.share and load.offset stay. */
ZpActuatorDef zp_def_unloaded(const ZpActuatorDef *def);

/* Is this a stack of unequal parallel members, because a key of member_K is given? */
bool zp_def_parallel(const ZpActuatorDef *def);

/* Member 1 .. zp_def_members as a single actuator: the common keys, overridden by those of member_K. In a series the
 * last member carries load.mass and load.force, each other member a link. Of two antagonists the first carries the
 * load, and the last is upside down. Parallel members share the load equally. */
ZpActuatorDef zp_def_member(const ZpActuatorDef *def, int member);

/* Are the two members of a series antagonists, between mounts at stack.distance? The voltage of the lower one if the
 * upper one has `voltage`, V. */
bool zp_def_antagonist(const ZpActuatorDef *def);
double zp_def_lower_voltage(const ZpActuatorDef *def, double voltage);

/* Conditions of a stack on other keys; may all members have this voltage, V? */
ZpStatus zp_check_stack(const ZpActuatorDef *def, ZpError *err);
ZpStatus zp_check_members_voltage(const ZpActuatorDef *def, double voltage, ZpError *err);

/* Thickness of both insulators together, m. */
double zp_insulation(const ZpActuatorDef *def);

/* Checks of segments, which must fit into their ribbon, and of lower.*, which requires two ribbons. */
ZpStatus zp_check_ribbons(const ZpActuatorDef *def, ZpError *err);

/* Motion requires a mass. */
ZpStatus zp_check_mass(const ZpActuatorDef *def, ZpError *err);

#endif
