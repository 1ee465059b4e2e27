/* Several actuators as one system: what each member of a series is, and what a stack asks of other keys. */
#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "def/device.h"
#include "def/instances.h"

/* The key of one actuator that a member's key overrides; -1: it says where the member is, or what is on its port. */
static int key_of_one(int key) {
  return zp_key_find(zp_key_of_one(zp_key(key)->name));
}

/* Does a member's key say what is on its port? */
static bool is_of_port(int key) {
  static const int first = ZP_KEY(member_K.drive.voltage), last = ZP_KEY(member_K.setpoint.duty);
  const int row = zp_key_instance(key).row;
  return row >= first && row <= last;
}

/* Does it say where the member is, in a network? */
static bool is_of_place(int key) {
  const int row = zp_key_instance(key).row;
  return row >= ZP_KEY(member_K.upper) && row < ZP_KEY(member_K.port);
}

bool zp_key_is_of_network(int index) {
  const ZpInstance at = zp_key_instance(index);
  return at.number > 0 && !zp_key_is_of_segment(index) && (at.kind != ZP_OF_MEMBER || is_of_place(index));
}

/* Is a member unlike what the other keys say? One that has a port of its own has a source of its own, too, unless both
 * are ideal and have the same voltage. */
static bool has_unlike_member(const ZpActuatorDef *def) {
  const bool ideal = def->source.model == ZP_SOURCE_IDEAL && def->control.kind == ZP_CONTROL_NONE;
  bool unlike = false;
  for (size_t k = 0; def->given && k < def->given->count; k++) {
    const ZpAssignment *given = &def->given->value[k];
    const ZpInstance at = zp_key_instance(given->key);
    if (at.kind != ZP_OF_MEMBER) continue;
    const int key = key_of_one(given->key);
    const bool apart = at.row == ZP_KEY(member_K.port) || is_of_port(given->key);
    const bool same_voltage = ideal && at.row == ZP_KEY(member_K.drive.voltage);
    unlike |= (apart && !same_voltage) || (key >= 0 && given->value != zp_def_get(def, key));
  }
  return unlike;
}

bool zp_def_parallel(const ZpActuatorDef *def) {
  return !zp_def_network(def) && def->stack.series == 1 && def->stack.parallel > 1 && has_unlike_member(def);
}

int zp_def_members(const ZpActuatorDef *def) {
  if (!def) return 0;
  if (zp_def_network(def)) return zp_instance_count(def, ZP_OF_MEMBER);
  return zp_def_parallel(def) ? def->stack.parallel : def->stack.series;
}

bool zp_def_antagonist(const ZpActuatorDef *def) {
  return !isnan(def->stack.distance);
}

double zp_def_lower_voltage(const ZpActuatorDef *def, double voltage) {
  return isnan(def->stack.lower_voltage) ? def->stack.voltage_ratio * voltage : def->stack.lower_voltage;
}

/* The first member that gives this port; 0: none does. */
static int first_on_port(const ZpActuatorDef *def, double port) {
  for (size_t k = 0; def->given && k < def->given->count; k++) {
    const ZpAssignment *given = &def->given->value[k];
    const ZpInstance at = zp_key_instance(given->key);
    if (at.row == ZP_KEY(member_K.port) && given->value == port) return at.number;
  }
  return 0;
}

int zp_def_port(const ZpActuatorDef *def, int member) {
  const ZpAssignment *given;
  const size_t count = zp_instances_of(def, ZP_OF_MEMBER, member, &given);
  bool own = false;
  for (size_t k = 0; k < count; k++) {
    if (zp_key_instance(given[k].key).row == ZP_KEY(member_K.port)) return first_on_port(def, given[k].value);
    own |= is_of_port(given[k].key);
  }
  return own ? member : 0;
}

ZpStatus zp_check_ports(const ZpActuatorDef *def, ZpError *err) {
  for (int member = 1; member <= zp_instance_count(def, ZP_OF_MEMBER); member++) {
    const int lead = zp_def_port(def, member);
    const ZpAssignment *given;
    const size_t count = zp_instances_of(def, ZP_OF_MEMBER, member, &given);
    for (size_t k = 0; k < count; k++) {
      const char *name = ZP_KEY_SHOWN(def, given[k].key);
      if (zp_key_instance(given[k].key).row == ZP_KEY(member_K.drive.voltage) && def->drive.voltage == 0)
        return zp_fail(err, ZP_BAD_INPUT, "drive.voltage = 0 V: must be above 0, because %s is a multiple of it", name);
      if (is_of_port(given[k].key) && lead != member)
        return zp_fail(err, ZP_BAD_INPUT, "%s: give this key at the first member with the same port, %s", name,
                       zp_member_called(def, (size_t)lead, (char[ZP_NAME_SIZE]){0}));
    }
  }
  return ZP_OK;
}

/* The value of a key of the port that a member leads, its default where it is not given. */
static double of_port(const ZpActuatorDef *def, int row, int lead) {
  return zp_def_get(def, zp_key_of_instance(row, lead));
}

double zp_def_member_voltage(const ZpActuatorDef *def, int member, double voltage) {
  if (zp_def_antagonist(def) && member == def->stack.series) return zp_def_lower_voltage(def, voltage);
  const int lead = zp_def_port(def, member);
  if (lead == 0) return voltage;
  const double given = of_port(def, ZP_KEY(member_K.drive.voltage), lead),
               own = isnan(given) ? def->drive.voltage : given;
  if (of_port(def, ZP_KEY(member_K.drive.scaled), lead) == 0) return own;
  return isnan(given) || def->drive.voltage == 0 ? voltage : voltage * own / def->drive.voltage;
}

/* The lower one of two antagonists as it is mirrored upside down: gravity points from its platform to its mount, and
 * the load is the other's. */
static void turn_over(const ZpActuatorDef *def, ZpActuatorDef *one) {
  const double upside_down = zp_key(zp_key_find("mount.tilt"))->max;
  one->mount.tilt = copysign(upside_down - fabs(def->mount.tilt), def->mount.tilt);
  one->load = zp_def_unloaded(def).load;
  if (!isnan(def->stack.lower_voltage)) one->drive = zp_actuator_def_default().drive; /* a step, which stays constant */
  one->drive.voltage = zp_def_lower_voltage(def, def->drive.voltage);
}

/* Members side by side share one load: each has its part of what is in kg, N or N per something. A stop that does not
 * exist keeps its default. */
static void share_load(const ZpActuatorDef *def, ZpActuatorDef *one) {
  static const ZpKeyGroup load = ZP_KEY_GROUP(load);
  for (int key = load.first; key < load.end; key++) {
    const char *unit = zp_key(key)->unit;
    if (strncmp(unit, "kg", 2) == 0 || unit[0] == 'N')
      zp_def_set(one, key, zp_def_get(def, key) / def->stack.parallel, NULL);
  }
  if (isnan(def->load.stop_opening)) one->load.stop_stiffness = def->load.stop_stiffness;
}

/* Keys that a member gives, of its port or all others. A supply sets what is not given behind it. */
static void take_given(const ZpActuatorDef *def, int member, bool of_its_port, ZpActuatorDef *one) {
  const ZpAssignment *given;
  const size_t count = zp_instances_of(def, ZP_OF_MEMBER, member, &given);
  for (size_t k = 0; k < count; k++) {
    const int key = key_of_one(given[k].key);
    if (key < 0 || is_of_port(given[k].key) != of_its_port) continue;
    zp_def_set(one, key, given[k].value, NULL);
    if (key == ZP_KEY(source.supply)) zp_def_take_supply(one);
  }
}

/* Does a member give a value of this key of one actuator? */
static bool gives(const ZpActuatorDef *def, int member, int key) {
  const ZpAssignment *given;
  const size_t count = zp_instances_of(def, ZP_OF_MEMBER, member, &given);
  bool found = false;
  for (size_t k = 0; k < count; k++)
    found |= key_of_one(given[k].key) == key;
  return found;
}

/* A waveform of its own leaves out keys of the waveform of all that it does not use; a controller of its own leaves out
 * the waveform. */
static void leave_unused(const ZpActuatorDef *def, int lead, ZpActuatorDef *one) {
  const bool controlled = one->control.kind != ZP_CONTROL_NONE;
  if (controlled && !gives(def, lead, ZP_KEY(drive.waveform))) one->drive.waveform = ZP_WAVEFORM_STEP;
  const int last = ZP_KEY(setpoint.file);
  for (int key = ZP_KEY(drive.voltage) - 1; (key = zp_key_without_use(one, key + 1, last)) >= 0;) {
    if (gives(def, lead, key)) continue;
    if (zp_key(key)->type == ZP_KEY_TEXT)
      zp_def_set_text(one, key, "", NULL);
    else
      zp_def_set(one, key, zp_key(key)->def, NULL);
  }
}

/* Is it the first member on its port? It has the meter and the controller. */
static bool leads(const ZpActuatorDef *def, int member) {
  const int lead = zp_def_port(def, member);
  bool first = lead == 0 || lead == member;
  for (int before = 1; before < member && first && lead == 0; before++)
    first = zp_def_port(def, before) != 0;
  return first;
}

/* Each port has a copy of drive, source, control and setpoint, with the values that its first member gives. */
static void take_port(const ZpActuatorDef *def, int member, ZpActuatorDef *one) {
  const ZpActuatorDef fresh = zp_actuator_def_default();
  const int lead = zp_def_port(def, member);
  if (lead == 0 || of_port(def, ZP_KEY(member_K.drive.scaled), lead) != 0)
    one->drive.offset = zp_def_member_voltage(def, member, def->drive.offset);
  if (lead > 0) take_given(def, lead, true, one);
  if (lead > 0) leave_unused(def, lead, one);
  if (leads(def, member)) return;
  one->sense = fresh.sense;
  one->control = fresh.control;
  one->setpoint = fresh.setpoint;
}

int zp_def_metered(const ZpActuatorDef *def, int number) {
  bool apart = zp_def_network(def);
  int found = 0, member = 0;
  for (int k = 1; k <= zp_def_members(def); k++)
    apart |= zp_def_port(def, k) > 0;
  while (apart && found < number && member++ < zp_def_members(def)) {
    const int lead = zp_def_port(def, member);
    const double own = lead > 0 ? of_port(def, ZP_KEY(member_K.sense.frequency), lead) : (double)NAN;
    found += leads(def, member) && !isnan(isnan(own) ? def->sense.frequency : own);
  }
  return found == number ? member : 0;
}

/* Members of a stack without a series are side by side, unequal. */
ZpActuatorDef zp_def_member(const ZpActuatorDef *def, int member) {
  ZpActuatorDef one = *def, fresh = zp_actuator_def_default();
  bool last = member == def->stack.series, unequal = def->stack.series == 1;
  one.given = NULL;
  take_given(def, member, false, &one);
  one.stack.series = 1;
  one.stack.link_mass = 0;
  one.stack.distance = one.stack.lower_voltage = NAN;
  one.stack.voltage_ratio = 1;
  take_port(def, member, &one);
  if (zp_def_network(def)) {
    zp_network_member(def, member, &one);
    return one;
  }
  if (unequal) {
    one.stack.parallel = 1;
    share_load(def, &one);
    return one;
  }
  if (zp_def_antagonist(def)) {
    if (last) turn_over(def, &one);
    return one;
  }
  if (!last) one.load = fresh.load;
  if (!last) one.load.mass = def->stack.link_mass;
  return one;
}

bool zp_def_alike(const ZpActuatorDef *one, const ZpActuatorDef *other) {
  ZpActuatorDef loaded = *one;
  loaded.load = other->load;
  loaded.sense = other->sense;
  loaded.control = other->control;
  loaded.setpoint = other->setpoint;
  for (int key = zp_key_next_field(-1); key >= 0; key = zp_key_next_field(key)) {
    const double a = zp_def_get(&loaded, key), b = zp_def_get(other, key);
    if (a != b && !(isnan(a) && isnan(b))) return false;
  }
  return true;
}

/* A key of a member that the stack does not have. */
static ZpStatus check_members(const ZpActuatorDef *def, ZpError *err) {
  if (zp_def_network(def)) return ZP_OK;
  bool series = def->stack.series > 1, parallel = !series && def->stack.parallel > 1;
  int members = series ? def->stack.series : parallel ? def->stack.parallel : 0;
  const int member = zp_instance_count(def, ZP_OF_MEMBER);
  const ZpAssignment *last;
  for (size_t k = 0; def->given && k < def->given->count; k++)
    if (is_of_place(def->given->value[k].key))
      return zp_fail(
          err, ZP_BAD_INPUT, "bodies: missing; members.%s is between bodies, the frame and at least one that moves",
          zp_def_name(def, ZP_OF_MEMBER, zp_key_instance(def->given->value[k].key).number, (char[ZP_NAME_SIZE]){0}));
  if (member <= members) return ZP_OK;
  zp_instances_of(def, ZP_OF_MEMBER, member, &last);
  return zp_fail(err, ZP_BAD_INPUT, "%s: requires stack.%s of at least %d, but it is %d", ZP_KEY_NAME(last->key),
                 parallel ? "parallel" : "series", member > 1 ? member : 2,
                 parallel ? def->stack.parallel : def->stack.series);
}

/* Each of two antagonists opens at most to its length. */
static ZpStatus check_distance(const ZpActuatorDef *def, ZpError *err) {
  double most = 2 * zp_most_opening * (def->ribbon.length - def->platform.length);
  if (def->stack.distance <= most || zp_def_has(def, ZP_DEVICE_RIGID)) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "stack.distance = %g m: two actuators of ribbon.length = %g m span at most %g m",
                 def->stack.distance, def->ribbon.length, most);
}

ZpStatus zp_fail_member(const ZpActuatorDef *def, int member, ZpStatus status, const ZpError *reason, ZpError *err) {
  char name[ZP_NAME_SIZE];
  if (zp_def_network(def))
    return zp_fail(err, status, "members.%s: %.400s", zp_def_name(def, ZP_OF_MEMBER, member, name), reason->message);
  return zp_fail(err, status, "member %d of the stack: %.400s", member, reason->message);
}

/* There is one table, of the drive or of the setpoint of all. */
static ZpStatus check_table(const ZpActuatorDef *def, const ZpActuatorDef *one, ZpError *err) {
  const bool drives = one->control.kind == ZP_CONTROL_NONE, all_drive = def->control.kind == ZP_CONTROL_NONE;
  if (!zp_def_takes_table(one) || (zp_def_takes_table(def) && drives == all_drive)) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT,
                 "%s.waveform = table: a member has no table of its own; give all of them the table, and other "
                 "members another waveform",
                 drives ? "drive" : "setpoint");
}

static ZpStatus check_each(const ZpActuatorDef *def, ZpError *err) {
  for (int member = 1, last = zp_def_members(def); member <= last; member++) {
    ZpActuatorDef one = zp_def_member(def, member);
    ZpError reason;
    if (zp_def_network(def)) one.load.force = one.mount.tilt = 0; /* others may bear what pushes on it */
    ZpStatus status = zp_def_check(&one, &reason);
    if (status == ZP_OK && leads(def, member)) status = check_table(def, &one, &reason);
    if (status != ZP_OK) return zp_fail_member(def, member, status, &reason, err);
  }
  return ZP_OK;
}

ZpStatus zp_check_stack(const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = check_members(def, err);
  if (status == ZP_OK && zp_def_antagonist(def)) status = check_distance(def, err);
  if (status == ZP_OK) status = zp_check_network(def, err);
  if (status == ZP_OK) status = zp_check_ports(def, err);
  return status == ZP_OK && (zp_def_network(def) || zp_def_members(def) > 1) ? check_each(def, err) : status;
}

ZpStatus zp_check_members_voltage(const ZpActuatorDef *def, double voltage, ZpError *err) {
  ZpStatus status = ZP_OK;
  for (int member = 1, last = zp_def_members(def); member <= last && status == ZP_OK; member++) {
    ZpActuatorDef one = zp_def_member(def, member);
    ZpError reason;
    status = zp_def_check_voltage(&one, zp_def_member_voltage(def, member, voltage), &reason);
    if (status != ZP_OK) zp_fail_member(def, member, status, &reason, err);
  }
  return status;
}

/* -- rules ----------------------------------------------------------------------------------------- */

static const char joins[] = "a stack joins its platforms", opposes[] = "which makes two members antagonists";

static const ZpRule rule[] = {
    ZP_RULE(PHYSICS, ZP_ABOVE(stack.series, 1), ZP_HAS(PLATFORM), joins),
    ZP_RULE(PHYSICS, ZP_ABOVE(stack.parallel, 1), ZP_HAS(PLATFORM), joins),
    ZP_RULE(PHYSICS, ZP_ABOVE(stack.link_mass, 0), ZP_AT_LEAST(stack.series, 2), "a link joins two members"),
    /* antagonists */
    ZP_RULE(PHYSICS, ZP_SET(stack.lower_voltage), ZP_SET(stack.distance), opposes),
    ZP_RULE(PHYSICS, ZP_SET(stack.voltage_ratio), ZP_SET(stack.distance), opposes),
    ZP_RULE(PHYSICS, ZP_SET(stack.distance), ZP_IS(stack.series, 2), "there are two antagonists"),
    ZP_RULE(PHYSICS, ZP_SET(stack.lower_voltage), ZP_UNSET(stack.voltage_ratio), "give one of them, not both"),
    ZP_RULE(PHYSICS, ZP_SET(stack.distance), ZP_IS(stack.link_mass, 0),
            "for antagonists load.mass is the whole moving mass"),
    ZP_RULE(PHYSICS, ZP_SET(stack.distance), ZP_NOT(initial.state, ZP_INITIAL_STRAIGHT),
            "straight ribbons do not reach the load"),
    /* several members */
    ZP_RULE_IF(EQUATION, ZP_ABOVE(stack.series, 1), ZP_UNSET(stack.distance), ZP_IS(platform.rotates, false),
               "a platform that turns would turn the member that hangs on it"),
    ZP_RULE(NOT_MODELLED, ZP_SEVERAL, ZP_IS(platform.rotates, false),
            "one height joins the platforms of members, not an angle"),
    ZP_RULE(EQUATION, ZP_SEVERAL, ZP_IS(ribbon.model, ZP_RIBBON_ROD), "links are modelled between rods"),
    ZP_RULE(EQUATION, ZP_SEVERAL, ZP_IS(contact.model, ZP_CONTACT_UNILATERAL),
            "the paper's zipping has the order of a single actuator"),
    ZP_RULE_IF(EQUATION, ZP_SET(stack.distance), ZP_SEVERAL, ZP_IS(ribbon.plasticity, false),
               "how the members had been bent before they were joined is not known"),
    ZP_RULE_IF(NOT_MODELLED, ZP_ABOVE(stack.series, 1), ZP_UNSET(stack.distance), ZP_IS(load.stiffness, 0),
               "a spring acts between the platforms of a single actuator"),
    ZP_RULE_IF(NOT_MODELLED, ZP_ABOVE(stack.series, 1), ZP_UNSET(stack.distance), ZP_UNSET(load.stop_opening),
               "a stop acts between the platforms of a single actuator"),
    ZP_MOTION_RULE(NOT_MODELLED, ZP_SEVERAL, ZP_IS(solver.integrator, ZP_INTEGRATOR_IMPLICIT),
                   "heights that members share are unknowns of implicit steps"),
};

static const ZpRules rules = ZP_RULES_OF(rule);
const ZpRules *const zp_rules_of_stack[] = {&rules, NULL};
