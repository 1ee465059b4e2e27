/* Checks that several studies share, and the wording of their messages. All of them fail with ZP_BAD_INPUT and name the
 * key. */
#ifndef ZP_DEF_CHECK_H
#define ZP_DEF_CHECK_H

#include "def/def.h"

/* A mount.tilt that differs from a right angle by less than this counts as one: degrees written with five digits are
 * rounded by this much, rad. */
static const double zp_tilt_rounding = 1e-5;

/* Part of the length of both halves at which a platform is held at most: beyond it, ribbons stretch more than
 * they bend. */
static const double zp_most_opening = 0.98;

/* Largest number of members of a system, of its bodies, of its springs and of its joints. */
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

/* Members, bodies, springs and joints have names, and a Def as many as are given; segments have numbers alone, and
 * fields in a Def. Their keys have numbers from ZP_KEYS on. A port has no keys: members name it. */
typedef enum ZpInstanceKind {
  ZP_OF_MEMBER,
  ZP_OF_BODY,
  ZP_OF_SPRING,
  ZP_OF_JOINT,
  ZP_CALLED_KINDS, /* those with names */
  ZP_OF_SEGMENT = ZP_CALLED_KINDS,
  ZP_OF_LOWER_SEGMENT,
  ZP_INSTANCE_KINDS,
  ZP_OF_PORT = ZP_INSTANCE_KINDS,
  ZP_NAMED_KINDS
} ZpInstanceKind;

/* Whose key it is. */
typedef struct ZpInstance {
  ZpInstanceKind kind;
  int number; /* from 1; 0: a key that is none of them */
  int row;    /* the key that stands for those of all; without a number the key itself, -1: there is none */
} ZpInstance;
ZpInstance zp_key_instance(int index);

/* The key that row `row` of a group such as member_K stands for, of member `number`. */
int zp_key_of_instance(int row, int number);

/* Does it stand for the keys of all members, bodies, springs or segments? */
bool zp_key_is_row(int index);

/* How many there can be of what this row stands for. */
int zp_instance_most(int row);

/* Is it a key of a segment? */
bool zp_key_is_of_segment(int index);

/* The next key whose value a Def holds in a field, a row or a segment's; -1: there is none. Start from -1. */
int zp_key_next_field(int index);

/* The first key of a segment after `index` whose value is not its default; -1: there is none. Start from -1. */
int zp_segment_key_next(const ZpActuatorDef *def, int index);

/* Which keys are set => set: of which `def` gives another value than the default of its device, or a text; of a row,
 * one of its keys is given. */
void zp_def_find_set(const ZpActuatorDef *def, bool set[ZP_KEYS]);

/* The first key of this row that has a value; -1: none. */
int zp_instance_given(const ZpActuatorDef *def, int row);

/* The key of this name; -1: there is none, or it stands for those of all, so that it has no value. */
int zp_key_with_value(const char *name);

/* "member_12.ribbon" => 12, the kind and ".ribbon"; 0: the name does not begin with a kind and a number from 1 to
 * the largest of this kind. */
int zp_instance_named(const char *name, ZpInstanceKind *kind, const char **rest);

/* The beginning of the names of a kind: "member_". */
const char *zp_instance_begins(ZpInstanceKind kind);

/* zp_key_find and zp_key_name for these keys; zp_def_next_key, the first one of a row or that behind such a key. */
int zp_instance_find(const char *name);
const char *zp_instance_key_name(int index, char text[ZP_KEY_NAME_SIZE]);
int zp_instance_next(const ZpActuatorDef *def, int index);

/* The name of a member, a body or a spring: as it is given, else "member_3". Give all names. */
const char *zp_def_name(const ZpActuatorDef *def, ZpInstanceKind kind, int number, char text[ZP_NAME_SIZE]);
ZpStatus zp_def_set_names(ZpActuatorDef *def, const ZpGivenName *name, size_t count, ZpError *err);

/* The kind that a key's value names: ZP_OF_MEMBER, ZP_OF_BODY, ZP_OF_PORT; ZP_NAMED_KINDS: none. Rows that stand for
 * those of all count. */
ZpInstanceKind zp_key_names(int key);
static inline bool zp_key_is_name(int key) {
  return zp_key_names(key) < ZP_NAMED_KINDS;
}

/* The name of a key for a message: of a part of a network "members.left.drive.voltage". */
const char *zp_def_key_shown(const ZpActuatorDef *def, int key, char text[ZP_KEY_NAME_SIZE + 2 * ZP_NAME_SIZE]);
#define ZP_KEY_SHOWN(def, key) zp_def_key_shown(def, key, (char[ZP_KEY_NAME_SIZE + 2 * ZP_NAME_SIZE]){0})

/* The name of a member or a body in results: in a stack by its number, "3", in a network by its name. They are
 * callbacks of tables; `def` is a ZpActuatorDef. */
const char *zp_member_called(const void *def, size_t member, char text[ZP_NAME_SIZE]);
const char *zp_body_called(const void *def, size_t body, char text[ZP_NAME_SIZE]);

/* The given values of one => how many there are. The largest number of any that is given. */
size_t zp_instances_of(const ZpActuatorDef *def, ZpInstanceKind kind, int number, const ZpAssignment **value);
int zp_instance_count(const ZpActuatorDef *def, ZpInstanceKind kind);

/* Are bodies given, so that members are what their keys say? */
static inline bool zp_def_network(const ZpActuatorDef *def) {
  return zp_instance_count(def, ZP_OF_BODY) > 0;
}

/* Does one of them move in the plane? */
bool zp_def_plane(const ZpActuatorDef *def);

/* Keys in the order of the table, those of members and so on where their rows stand: below 0 if the first one comes
 * first. */
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

/* The Def of the lower ribbon: that of the upper one with the keys that lower.* gives, in `room`, or `def` itself if it
 * gives none. */
const ZpActuatorDef *zp_def_lower(const ZpActuatorDef *def, ZpActuatorDef *room);

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

/* Are two members the same actuator, but for their loads and the meter and the controller of the first one? */
bool zp_def_alike(const ZpActuatorDef *one, const ZpActuatorDef *other);

/* Are bodies given? Then members are what their keys say, and this sets the load of one: its part of the mass and of
 * the force of the body at its lower end. */
void zp_network_member(const ZpActuatorDef *def, int member, ZpActuatorDef *one);

/* Is each key of a port given at its first member, and has a voltage of its own one to be a multiple of? */
ZpStatus zp_check_ports(const ZpActuatorDef *def, ZpError *err);

/* Do bodies, members, springs and joints fit together? */
ZpStatus zp_check_network(const ZpActuatorDef *def, ZpError *err);

/* Are the two members of a series antagonists, between mounts at stack.distance? The voltage of the lower one if the
 * upper one has `voltage`, V. */
bool zp_def_antagonist(const ZpActuatorDef *def);
double zp_def_lower_voltage(const ZpActuatorDef *def, double voltage);

/* "member_K.ribbon.width" => "ribbon.width"; another name stays as it is. */
const char *zp_key_of_one(const char *name);

/* Does a key belong to a body or a spring, or say between which bodies a member is? */
bool zp_key_is_of_network(int index);

/* The first member of those on the port of a member; 0: the port of all that have no key of a port. */
int zp_def_port(const ZpActuatorDef *def, int member);

/* The first member on port 1, 2, ... that has a meter, where members have ports or bodies; 0: there is none. */
int zp_def_metered(const ZpActuatorDef *def, int number);

/* Set what source.supply sets. */
void zp_def_take_supply(ZpActuatorDef *def);

/* That of any member while drive.voltage is replaced by `voltage`, V. */
double zp_def_member_voltage(const ZpActuatorDef *def, int member, double voltage);

/* Has each body that moves in the plane a mass and an inertia? */
ZpStatus zp_check_motion_of_bodies(const ZpActuatorDef *def, ZpError *err);

/* May study isometric hold the body isometric.body at isometric.separation? */
ZpStatus zp_check_held_body(const ZpActuatorDef *def, ZpError *err);

/* Fail with the reason that one member gives, and its name. */
ZpStatus zp_fail_member(const ZpActuatorDef *def, int member, ZpStatus status, const ZpError *reason, ZpError *err);

/* Conditions of a stack on other keys; may all members have this voltage, V? */
ZpStatus zp_check_stack(const ZpActuatorDef *def, ZpError *err);
ZpStatus zp_check_members_voltage(const ZpActuatorDef *def, double voltage, ZpError *err);

/* Number of the last segment with a length, of the Def of a ribbon; 0: it has none. */
int zp_def_segments(const ZpActuatorDef *ribbon);

/* Does voltage drive the curvature of a segment, or, with `by_sign`, do so with another sign where it is negative? */
bool zp_def_drives(const ZpActuatorDef *def, bool by_sign);

/* Refuse a voltage below 0 V of this key where nothing depends on its sign. */
ZpStatus zp_check_sign(const ZpActuatorDef *def, const char *key, double voltage, ZpError *err);

/* Thickness of both insulators together, m. */
double zp_insulation(const ZpActuatorDef *def);

/* Thickness of the insulating layer on a ribbon, m; of a film that is the insulator itself (auto), that of the film. */
double zp_insulator_thickness(const ZpActuatorDef *def);

/* Do electrodes touch where it is closed, without an insulator or a stop between them? */
bool zp_def_shorts(const ZpActuatorDef *def);

/* Length of its platform, m: a plate is all platform. */
double zp_platform_length(const ZpActuatorDef *def);

/* Gap of a device whose faces are apart at its clamp or all along without voltage, m; 0 of others. */
double zp_def_gap(const ZpActuatorDef *def);

/* How many equal pairs of electrodes move as one: plate.count. */
int zp_def_count(const ZpActuatorDef *def);

/* Checks of segments, which must fit into their ribbon, and of lower.*, which requires two ribbons. */
ZpStatus zp_check_ribbons(const ZpActuatorDef *def, ZpError *err);

/* Does a layer of the ribbons creep? */
bool zp_def_creeps(const ZpActuatorDef *def);

/* Motion requires a mass. */
ZpStatus zp_check_mass(const ZpActuatorDef *def, ZpError *err);

#endif
