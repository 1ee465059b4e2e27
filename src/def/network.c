/* Bodies and members, as their keys say or as the shorthands of a stack do; what a network asks of other keys. */
#include "def/network.h"

#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "def/device.h"
#include "def/rule.h"

enum { FRAME };

/* -- keys ------------------------------------------------------------------------------------------ */

/* The value of a key of a member, a body or a spring. */
static double value_of(const ZpActuatorDef *def, int row, size_t number) {
  return zp_def_get(def, zp_key_of_instance(row, (int)number));
}

/* Does a member open upwards? */
static bool is_turned(const ZpActuatorDef *def, size_t number) {
  return fabs(value_of(def, ZP_KEY(member_K.angle), number)) > 1;
}

/* The members whose lower end is at a body. */
static size_t hung_by(const ZpActuatorDef *def, double body) {
  size_t count = 0;
  for (const ZpAssignment *given = def->given->value; given < def->given->value + def->given->count; given++)
    count += given->value == body && zp_key_instance(given->key).row == ZP_KEY(member_K.lower);
  return count;
}

void zp_network_member(const ZpActuatorDef *def, int member, ZpActuatorDef *one) {
  if (zp_def_plane(def)) { /* bodies have their masses themselves, and turn the platform */
    one->isometric.body = 0;
    one->load = zp_def_unloaded(def).load;
    one->load.mass = one->load.force = 0;
    one->actuator.symmetry = ZP_SYMMETRY_NONE;
    one->platform.rotates = true;
    one->platform.electrode = false;
    if (zp_def_liquid(def) == ZP_LIQUID_NONE) one->liquid.model = ZP_LIQUID_NONE;
    return;
  }
  const size_t number = (size_t)member;
  const double lower = value_of(def, ZP_KEY(member_K.lower), number);
  const double all = lower > 0 ? value_of(def, ZP_KEY(body_K.mass), (size_t)lower) : 0;
  const double up = lower > 0 ? value_of(def, ZP_KEY(body_K.force.y), (size_t)lower) : 0;
  const double each = fmax((double)hung_by(def, lower), 1);
  one->isometric.body = 0;
  one->load = zp_def_unloaded(def).load;
  one->load.mass = all / each;
  one->load.force = (is_turned(def, number) ? up : -up) / each;
  if (is_turned(def, number)) one->mount.tilt = zp_key(ZP_KEY(mount.tilt))->max;
}

/* -- checks ---------------------------------------------------------------------------------------- */

/* A body by the value of a key; -1: there is none. */
static int body_in(const ZpActuatorDef *def, int row, int number) {
  const double value = value_of(def, row, (size_t)number);
  return value >= 0 && value <= zp_instance_count(def, ZP_OF_BODY) && value == floor(value) ? (int)value : -1;
}

/* "members.left" */
#define SHOWN(def, kind, number) zp_def_name(def, kind, number, (char[ZP_NAME_SIZE]){0})

static ZpStatus check_end(const ZpActuatorDef *def, int row, int member, ZpError *err) {
  const char *end = row == ZP_KEY(member_K.upper) ? "upper" : "lower";
  if (body_in(def, row, member) >= 0) return ZP_OK;
  if (isnan(value_of(def, row, (size_t)member)))
    return zp_fail(err, ZP_BAD_INPUT, "members.%s.%s: missing; give the body at this end, frame or one of bodies",
                   SHOWN(def, ZP_OF_MEMBER, member), end);
  return zp_fail(err, ZP_BAD_INPUT, "members.%s.%s = %s: there is no such body", SHOWN(def, ZP_OF_MEMBER, member), end,
                 SHOWN(def, ZP_OF_BODY, (int)value_of(def, row, (size_t)member)));
}

static ZpStatus check_member(const ZpActuatorDef *def, int member, ZpError *err) {
  static const double near = 1e-5;
  const double half_turn = zp_key(ZP_KEY(member_K.angle))->max;
  const char *name = SHOWN(def, ZP_OF_MEMBER, member);
  const double angle = fabs(value_of(def, ZP_KEY(member_K.angle), (size_t)member));
  const ZpAssignment *value;
  if (zp_instances_of(def, ZP_OF_MEMBER, member, &value) == 0 && def->profile.member == member)
    return zp_fail(err, ZP_BAD_INPUT, "profile.member = %s: there is no such member", name);
  ZpStatus status = check_end(def, ZP_KEY(member_K.upper), member, err);
  if (status == ZP_OK) status = check_end(def, ZP_KEY(member_K.lower), member, err);
  if (status != ZP_OK) return status;
  const int upper = body_in(def, ZP_KEY(member_K.upper), member), lower = body_in(def, ZP_KEY(member_K.lower), member);
  if (upper == lower)
    return zp_fail(err, ZP_BAD_INPUT, "members.%s: both of its ends are at %s; give two bodies", name,
                   SHOWN(def, ZP_OF_BODY, upper));
  if (!zp_def_plane(def) && angle > near && fabs(angle - half_turn) > near)
    return zp_fail(err, ZP_BAD_INPUT,
                   "members.%s.angle = %g degree: 0 (it opens downwards) or 180 (upwards), as bodies "
                   "move up and down",
                   name, angle * 180 / half_turn);
  if (upper > 0 && zp_def_has(def, ZP_DEVICE_COUNTER) &&
      value_of(def, ZP_KEY(body_K.moves), (size_t)upper) != ZP_MOVES_NONE)
    return zp_fail(err, ZP_BAD_INPUT,
                   "members.%s.upper = %s: the counter electrode stands still; give frame, or a "
                   "body with moves: none",
                   name, SHOWN(def, ZP_OF_BODY, upper));
  return ZP_OK;
}

static bool moves(const ZpActuatorDef *def, int body) {
  return body > 0 && value_of(def, ZP_KEY(body_K.moves), (size_t)body) != ZP_MOVES_NONE;
}

/* A member, a spring or a joint that names a body. */
static const char *who_names(const ZpActuatorDef *def, int body, char text[ZP_NAME_SIZE]) {
  for (int k = 1; k <= zp_instance_count(def, ZP_OF_MEMBER); k++)
    if (value_of(def, ZP_KEY(member_K.upper), (size_t)k) == body ||
        value_of(def, ZP_KEY(member_K.lower), (size_t)k) == body)
      return zp_def_name(def, ZP_OF_MEMBER, k, text);
  for (int k = 1; k <= zp_instance_count(def, ZP_OF_SPRING); k++)
    if (value_of(def, ZP_KEY(spring_K.first), (size_t)k) == body ||
        value_of(def, ZP_KEY(spring_K.second), (size_t)k) == body)
      return zp_def_name(def, ZP_OF_SPRING, k, text);
  for (int k = 1; k <= zp_instance_count(def, ZP_OF_JOINT); k++)
    if (value_of(def, ZP_KEY(joint_K.first), (size_t)k) == body ||
        value_of(def, ZP_KEY(joint_K.second), (size_t)k) == body)
      return zp_def_name(def, ZP_OF_JOINT, k, text);
  return "nothing";
}

static ZpStatus check_given(const ZpActuatorDef *def, int body, ZpError *err) {
  const ZpAssignment *value;
  if (zp_instances_of(def, ZP_OF_BODY, body, &value) > 0) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "bodies.%s: is not given, but %s names it; add it to bodies, or name another one",
                 SHOWN(def, ZP_OF_BODY, body), who_names(def, body, (char[ZP_NAME_SIZE]){0}));
}

static ZpStatus check_body(const ZpActuatorDef *def, int body, ZpError *err) {
  if (moves(def, body) && value_of(def, ZP_KEY(body_K.moves), (size_t)body) == ZP_MOVES_VERTICAL &&
      value_of(def, ZP_KEY(body_K.force.x), (size_t)body) != 0)
    return zp_fail(err, ZP_BAD_INPUT,
                   "bodies.%s.force: the first value, to the right, must be 0: the body moves up and down",
                   SHOWN(def, ZP_OF_BODY, body));
  if (!moves(def, body) || zp_def_plane(def) || hung_by(def, body) > 0) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT,
                 "bodies.%s: nothing holds it; give a member with lower: %s (one that opens upwards has "
                 "angle: 180 degree), or moves: none",
                 SHOWN(def, ZP_OF_BODY, body), SHOWN(def, ZP_OF_BODY, body));
}

/* The two bodies of a spring or a joint, by its keys. */
static ZpStatus check_pair(const ZpActuatorDef *def, const char *group, ZpInstanceKind kind, int number,
                           const int row[2], ZpError *err) {
  const char *name = SHOWN(def, kind, number);
  int body[2];
  for (int k = 0; k < 2; k++) {
    const double named = value_of(def, row[k], (size_t)number);
    body[k] = body_in(def, row[k], number);
    if (isnan(named)) return zp_fail(err, ZP_BAD_INPUT, "%s.%s.between: give two bodies: [frame, hand]", group, name);
    if (body[k] < 0)
      return zp_fail(err, ZP_BAD_INPUT, "%s.%s.between: %s is not given in bodies; add it there, or name another one",
                     group, name, SHOWN(def, ZP_OF_BODY, (int)named));
  }
  if (body[0] != body[1]) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "%s.%s.between: both ends are at %s; give two bodies", group, name,
                 SHOWN(def, ZP_OF_BODY, body[0]));
}

static ZpStatus check_spring(const ZpActuatorDef *def, int spring, ZpError *err) {
  static const int row[] = {ZP_KEY(spring_K.first), ZP_KEY(spring_K.second)};
  const ZpStatus status = check_pair(def, "springs", ZP_OF_SPRING, spring, row, err);
  const double friction = value_of(def, ZP_KEY(spring_K.friction), (size_t)spring);
  if (status != ZP_OK || friction == 0) return status;
  if (isnan(value_of(def, ZP_KEY(spring_K.direction), (size_t)spring)))
    return zp_fail(err, ZP_BAD_INPUT,
                   "springs.%s.friction = %g: it acts across a direction; give springs.%s.direction, that from the "
                   "first body's face to the second body (90 degree: the first one is below), or leave it out",
                   SHOWN(def, ZP_OF_SPRING, spring), friction, SHOWN(def, ZP_OF_SPRING, spring));
  if (value_of(def, ZP_KEY(spring_K.kind), (size_t)spring) == ZP_SPRING_PUSH) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT,
                 "springs.%s.friction = %g: only faces that push each other rub; give springs.%s.kind: push, or leave "
                 "it out",
                 SHOWN(def, ZP_OF_SPRING, spring), friction, SHOWN(def, ZP_OF_SPRING, spring));
}

static bool turns(const ZpActuatorDef *def, int body) {
  return body > 0 && value_of(def, ZP_KEY(body_K.moves), (size_t)body) == ZP_MOVES_PLANE;
}

static ZpStatus check_joint(const ZpActuatorDef *def, int joint, ZpError *err) {
  static const int row[] = {ZP_KEY(joint_K.first), ZP_KEY(joint_K.second)};
  ZpStatus status = check_pair(def, "joints", ZP_OF_JOINT, joint, row, err);
  const int one = body_in(def, row[0], joint), other = body_in(def, row[1], joint);
  if (status != ZP_OK || turns(def, one) || turns(def, other)) return status;
  return zp_fail(err, ZP_BAD_INPUT, "joints.%s: neither %s nor %s moves in the plane; give one of them moves: plane",
                 SHOWN(def, ZP_OF_JOINT, joint), SHOWN(def, ZP_OF_BODY, one), SHOWN(def, ZP_OF_BODY, other));
}

/* Numbers that count for bodies in the plane only: a body that moves up and down has no use for them. */
static ZpStatus check_unused(const ZpActuatorDef *def, ZpError *err) {
  static const int row[] = {ZP_KEY(body_K.inertia), ZP_KEY(body_K.angle), ZP_KEY(body_K.torque)};
  static const int first[] = {ZP_KEY(member_K.upper_at.x), ZP_KEY(spring_K.direction)},
                   last[] = {ZP_KEY(member_K.lower_at.y), ZP_KEY(spring_K.to_at.y)};
  for (int b = 1; b <= zp_instance_count(def, ZP_OF_BODY); b++)
    for (size_t k = 0; k < sizeof row / sizeof row[0]; k++)
      if (!turns(def, b) && moves(def, b) && value_of(def, row[k], (size_t)b) != 0)
        return zp_fail(err, ZP_BAD_INPUT,
                       "bodies.%s.%s: the body moves up and down; give moves: plane, or leave it out",
                       SHOWN(def, ZP_OF_BODY, b), strrchr(zp_key(row[k])->name, '.') + 1);
  for (size_t k = 0; !zp_def_plane(def) && def->given && k < def->given->count; k++) {
    const ZpInstance at = zp_key_instance(def->given->value[k].key);
    for (int of = 0; of < 2; of++)
      if (at.row >= first[of] && at.row <= last[of])
        return zp_fail(err, ZP_BAD_INPUT, "%s: all bodies move up and down; give one moves: plane, or leave it out",
                       ZP_KEY_SHOWN(def, def->given->value[k].key));
  }
  if (zp_def_plane(def) || zp_instance_count(def, ZP_OF_JOINT) == 0) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "joints: no body moves in the plane; give one moves: plane");
}

/* A member between two bodies, and how far one may be below the other, m. */
typedef struct Between {
  int high, low;
  double least, most;
} Between;

static Between between(const ZpActuatorDef *def, int member) {
  const double own = value_of(def, ZP_KEY(member_K.ribbon.length), (size_t)member);
  const double length = isnan(own) ? def->ribbon.length : own;
  const int upper = body_in(def, ZP_KEY(member_K.upper), member), lower = body_in(def, ZP_KEY(member_K.lower), member);
  const bool turned = is_turned(def, (size_t)member), platform = zp_def_has(def, ZP_DEVICE_PLATFORM);
  const double most = zp_def_has(def, ZP_DEVICE_RIGID) ? INFINITY : zp_most_opening * (length - def->platform.length);
  return (Between){turned ? lower : upper, turned ? upper : lower, platform ? 0 : -length, platform ? most : length};
}

/* Joints and springs lead from one body to another. => do they lead to a new one? */
static bool reach(const ZpActuatorDef *def, ZpInstanceKind kind, int first, int second, bool *reached) {
  bool more = false;
  for (int k = 1; k <= zp_instance_count(def, kind); k++) {
    const int one = body_in(def, first, k), other = body_in(def, second, k);
    if (reached[one] == reached[other]) continue;
    reached[one] = reached[other] = more = true;
  }
  return more;
}

/* Is each body joined to what is held, by members and bodies between? */
static ZpStatus check_reached(const ZpActuatorDef *def, const Between *member, bool *reached, ZpError *err) {
  const int bodies = zp_instance_count(def, ZP_OF_BODY), members = zp_instance_count(def, ZP_OF_MEMBER);
  for (int b = 0; b <= bodies; b++)
    reached[b] = !moves(def, b);
  for (bool more = true; more;) {
    more = false;
    for (const Between *m = member; m < member + members; m++) {
      if (reached[m->high] == reached[m->low]) continue;
      reached[m->high] = reached[m->low] = more = true;
    }
    if (zp_def_plane(def)) more |= reach(def, ZP_OF_JOINT, ZP_KEY(joint_K.first), ZP_KEY(joint_K.second), reached);
    if (zp_def_plane(def)) more |= reach(def, ZP_OF_SPRING, ZP_KEY(spring_K.first), ZP_KEY(spring_K.second), reached);
  }
  for (int b = 1; b <= bodies; b++)
    if (!reached[b])
      return zp_fail(err, ZP_BAD_INPUT,
                     "bodies.%s: nothing holds it: no members%s lead from it to the frame or to a body that is held",
                     SHOWN(def, ZP_OF_BODY, b), zp_def_plane(def) ? ", joints or springs" : "");
  return ZP_OK;
}

/* Do heights exist that all members reach? Bounds are passed along the members until none moves: the largest and the
 * least height of each body. */
static ZpStatus check_lengths(const ZpActuatorDef *def, int held, const Between *member, double *most, double *least,
                              ZpError *err) {
  const int bodies = zp_instance_count(def, ZP_OF_BODY), members = zp_instance_count(def, ZP_OF_MEMBER);
  for (int b = 0; b <= bodies; b++) {
    const double at = b > 0 ? value_of(def, ZP_KEY(body_K.at.y), (size_t)b) : 0;
    const double y = b > 0 && b == held ? -def->isometric.separation : at;
    const bool free = moves(def, b) && b != held;
    most[b] = free ? (double)INFINITY : y;
    least[b] = free ? -(double)INFINITY : y;
  }
  bool more = true;
  for (int round = 0; round <= bodies && more; round++) {
    more = false;
    for (const Between *m = member; m < member + members; m++) {
      const int high = m->high, low = m->low;
      const double above[] = {fmin(most[high], most[low] + m->most), fmax(least[high], least[low] + m->least)};
      const double below[] = {fmin(most[low], most[high] - m->least), fmax(least[low], least[high] - m->most)};
      const double misses = fmax(above[1] - above[0], below[1] - below[0]);
      if (misses > 1e-9)
        return zp_fail(err, ZP_BAD_INPUT,
                       "members.%s: it opens by %g to %g mm, but %s and %s are apart by %g mm too %s; "
                       "move a body that is held, or change a length",
                       SHOWN(def, ZP_OF_MEMBER, (int)(m - member) + 1), 1e3 * m->least, 1e3 * m->most,
                       SHOWN(def, ZP_OF_BODY, high), SHOWN(def, ZP_OF_BODY, low), 1e3 * misses,
                       least[high] - most[low] > m->most ? "much" : "little");
      more |= above[0] < most[high] || above[1] > least[high] || below[0] < most[low] || below[1] > least[low];
      most[high] = above[0], least[high] = above[1];
      most[low] = below[0], least[low] = below[1];
    }
  }
  return ZP_OK;
}

static ZpStatus check_parts(const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = ZP_OK;
  for (int k = 1; k <= zp_instance_count(def, ZP_OF_MEMBER) && status == ZP_OK; k++)
    status = check_member(def, k, err);
  for (int b = 1; b <= zp_instance_count(def, ZP_OF_BODY) && status == ZP_OK; b++)
    status = check_given(def, b, err);
  for (int b = 1; b <= zp_instance_count(def, ZP_OF_BODY) && status == ZP_OK; b++)
    status = check_body(def, b, err);
  for (int k = 1; k <= zp_instance_count(def, ZP_OF_SPRING) && status == ZP_OK; k++)
    status = check_spring(def, k, err);
  for (int k = 1; k <= zp_instance_count(def, ZP_OF_JOINT) && status == ZP_OK; k++)
    status = check_joint(def, k, err);
  if (status == ZP_OK) status = check_unused(def, err);
  bool any = false;
  for (int b = 1; b <= zp_instance_count(def, ZP_OF_BODY); b++)
    any |= moves(def, b);
  if (status == ZP_OK && !any) return zp_fail(err, ZP_BAD_INPUT, "bodies: each one is held; let one move");
  return status;
}

/* With arrays for each body. `held`: a body that is held in addition, 0: none. */
static ZpStatus check_places(const ZpActuatorDef *def, int held, ZpError *err) {
  const size_t bodies = (size_t)zp_instance_count(def, ZP_OF_BODY) + 1;
  double *heights = zp_calloc(2 * bodies, sizeof *heights);
  bool *reached = zp_calloc(bodies, sizeof *reached);
  const int members = zp_instance_count(def, ZP_OF_MEMBER);
  Between *member = zp_calloc((size_t)members, sizeof *member);
  const bool made = heights && reached && member;
  for (int k = 0; k < members && made; k++)
    member[k] = between(def, k + 1);
  ZpStatus status = made ? check_reached(def, member, reached, err) : zp_fail_memory(err);
  if (status == ZP_OK && !zp_def_plane(def)) status = check_lengths(def, held, member, heights, heights + bodies, err);
  zp_free(member);
  zp_free(heights);
  zp_free(reached);
  return status;
}

ZpStatus zp_check_motion_of_bodies(const ZpActuatorDef *def, ZpError *err) {
  static const int row[] = {ZP_KEY(body_K.mass), ZP_KEY(body_K.inertia)};
  for (int b = 1; b <= zp_instance_count(def, ZP_OF_BODY); b++)
    for (size_t k = 0; k < sizeof row / sizeof row[0]; k++)
      if (turns(def, b) && value_of(def, row[k], (size_t)b) == 0)
        return zp_fail(err, ZP_BAD_INPUT, "bodies.%s.%s = 0: a body that moves in the plane needs it in motion",
                       SHOWN(def, ZP_OF_BODY, b), strrchr(zp_key(row[k])->name, '.') + 1);
  return ZP_OK;
}

ZpStatus zp_check_held_body(const ZpActuatorDef *def, ZpError *err) {
  const int body = def->isometric.body;
  if (zp_def_plane(def))
    return zp_fail(err, ZP_BAD_INPUT,
                   "isometric.body = %s: where bodies move in the plane none of them can be held for a force; give it "
                   "moves: none and read members.NAME.force_N of study equilibrium",
                   SHOWN(def, ZP_OF_BODY, body));
  if (!moves(def, body))
    return zp_fail(err, ZP_BAD_INPUT, "isometric.body = %s: it is held already; name a body that moves",
                   SHOWN(def, ZP_OF_BODY, body));
  ZpError reason;
  ZpStatus status = check_places(def, body, &reason);
  if (status == ZP_OK) return ZP_OK;
  return zp_fail(err, status, "isometric.separation = %g m: %.400s", def->isometric.separation, reason.message);
}

ZpStatus zp_check_network(const ZpActuatorDef *def, ZpError *err) {
  if (def->isometric.body > zp_instance_count(def, ZP_OF_BODY))
    return zp_fail(err, ZP_BAD_INPUT, "isometric.body = %s: there is no such body",
                   SHOWN(def, ZP_OF_BODY, def->isometric.body));
  if (!zp_def_network(def)) return ZP_OK;
  if (zp_instance_count(def, ZP_OF_MEMBER) == 0)
    return zp_fail(err, ZP_BAD_INPUT, "members: missing; bodies are joined by members, each with upper and lower");
  ZpStatus status = check_parts(def, err);
  return status == ZP_OK ? check_places(def, 0, err) : status;
}

/* -- the table ------------------------------------------------------------------------------------- */

/* In series, one below the other; else all between the frame and the load. The lower of two antagonists hangs upside
 * down on a mount of its own. */
static void join_stack(const ZpActuatorDef *def, ZpNetwork *n) {
  enum { LOAD = 1, MOUNT };
  const bool opposed = zp_def_antagonist(def), series = !opposed && def->stack.series > 1;
  n->load = series ? n->members : LOAD;
  for (size_t k = 0; k < n->members; k++)
    n->ends[k] = series ? (ZpEnds){.upper = k, .lower = k + 1} : (ZpEnds){.upper = FRAME, .lower = LOAD};
  if (!opposed) return;
  n->body[MOUNT] = (ZpBody){.held = true, .y = -def->stack.distance};
  n->ends[n->members - 1] = (ZpEnds){.upper = MOUNT, .lower = LOAD, .turned = true};
}

/* Both keys of a point. */
#define POINT(key, number)                                                                                             \
  { value_of(def, ZP_KEY(key.x), number), value_of(def, ZP_KEY(key.y), number) }

static double angle_of(const ZpActuatorDef *def, size_t number) {
  const double angle = value_of(def, ZP_KEY(member_K.angle), number);
  return isnan(angle) ? 0 : angle;
}

/* As the keys say. No body has the load. */
static void join_bodies(const ZpActuatorDef *def, ZpNetwork *n) {
  n->load = n->bodies;
  n->watched = (size_t)def->isometric.body;
  for (size_t b = 1; b < n->bodies; b++) {
    const ZpMoves moves = (ZpMoves)value_of(def, ZP_KEY(body_K.moves), b);
    n->body[b] = (ZpBody){.held = moves == ZP_MOVES_NONE,
                          .moves = moves,
                          .x = value_of(def, ZP_KEY(body_K.at.x), b),
                          .y = value_of(def, ZP_KEY(body_K.at.y), b),
                          .angle = value_of(def, ZP_KEY(body_K.angle), b),
                          .mass = value_of(def, ZP_KEY(body_K.mass), b),
                          .inertia = value_of(def, ZP_KEY(body_K.inertia), b),
                          .force = {value_of(def, ZP_KEY(body_K.force.x), b), value_of(def, ZP_KEY(body_K.force.y), b)},
                          .torque = value_of(def, ZP_KEY(body_K.torque), b)};
    n->plane |= moves == ZP_MOVES_PLANE;
    n->pulled |= value_of(def, ZP_KEY(body_K.force.y), b) != 0;
  }
  for (size_t k = 0; k < n->members; k++)
    n->ends[k] = (ZpEnds){.upper = (size_t)value_of(def, ZP_KEY(member_K.upper), k + 1),
                          .lower = (size_t)value_of(def, ZP_KEY(member_K.lower), k + 1),
                          .turned = !n->plane && is_turned(def, k + 1),
                          .angle = angle_of(def, k + 1),
                          .at = {POINT(member_K.upper_at, k + 1), POINT(member_K.lower_at, k + 1)}};
  for (size_t k = 0; k < n->springs; k++)
    n->spring[k] = (ZpLink){.body = {(size_t)value_of(def, ZP_KEY(spring_K.first), k + 1),
                                     (size_t)value_of(def, ZP_KEY(spring_K.second), k + 1)},
                            .stiffness = value_of(def, ZP_KEY(spring_K.stiffness), k + 1),
                            .rest = value_of(def, ZP_KEY(spring_K.rest), k + 1),
                            .kind = (ZpSpringKind)value_of(def, ZP_KEY(spring_K.kind), k + 1),
                            .direction = value_of(def, ZP_KEY(spring_K.direction), k + 1),
                            .friction = value_of(def, ZP_KEY(spring_K.friction), k + 1),
                            .at = {POINT(spring_K.from_at, k + 1), POINT(spring_K.to_at, k + 1)}};
  for (size_t k = 0; k < n->joints; k++)
    n->joint[k] = (ZpBodyJoint){.type = (ZpJointType)value_of(def, ZP_KEY(joint_K.type), k + 1),
                                .body = {(size_t)value_of(def, ZP_KEY(joint_K.first), k + 1),
                                         (size_t)value_of(def, ZP_KEY(joint_K.second), k + 1)},
                                .at = POINT(joint_K.at, k + 1)};
}

static bool are_abreast(const ZpEnds *one, const ZpEnds *other) {
  for (int k = 0; k < 2; k++)
    if (one->at[k][0] != other->at[k][0] || one->at[k][1] != other->at[k][1]) return false;
  return one->angle == other->angle && one->upper == other->upper && one->lower == other->lower &&
         one->turned == other->turned;
}

/* The first member at a body whose lower end it is, or else whose upper one it is. */
static size_t leader_of(const ZpNetwork *n, size_t body) {
  size_t k = 0;
  while (k < n->members && n->ends[k].lower != body)
    k++;
  for (k = k < n->members ? k : 0; n->ends[k].lower != body && n->ends[k].upper != body;)
    k++;
  return k;
}

/* The first member that a body hangs on; `members`: none. */
static size_t above(const ZpNetwork *n, size_t body) {
  size_t k = 0;
  while (k < n->members && (n->ends[k].lower != body || n->ends[k].turned))
    k++;
  return k;
}

static void find_path(ZpNetwork *n) {
  for (size_t k = above(n, n->load); k < n->members; k = above(n, n->ends[k].upper))
    n->ends[k].on_path = true;
}

/* Members by the number of members between them and what is held. */
static void find_order(ZpNetwork *n) {
  for (size_t k = 0; k < n->members; k++)
    for (size_t body = n->ends[k].upper; !n->body[body].held; n->ends[k].depth++)
      body = n->ends[n->body[body].leader].upper;
  size_t placed = 0;
  for (size_t depth = 0; placed < n->members; depth++)
    for (size_t k = 0; k < n->members; k++)
      if (n->ends[k].depth == depth) n->order[placed++] = k;
}

/* Members on each port. `last`: of each member that is the first on its port, the last one so far. */
static void find_ports(const ZpActuatorDef *def, ZpNetwork *n, size_t *last) {
  size_t common = n->members; /* the first one on the port of all */
  for (size_t k = 0; k < n->members; k++) {
    const int lead = zp_def_port(def, (int)k + 1);
    if (lead == 0 && common == n->members) common = k;
    n->ends[k].port = lead == 0 ? common : (size_t)lead - 1;
    last[k] = k;
    if (n->ends[k].port == k) continue;
    n->ends[last[n->ends[k].port]].next = k;
    last[n->ends[k].port] = k;
  }
}

/* Unknowns of bodies in the plane. */
static void find_unknowns(ZpNetwork *n) {
  for (size_t body = 0; n->plane && body < n->bodies; body++) {
    n->body[body].unknown = n->unknowns;
    n->unknowns += n->body[body].held ? 0 : n->body[body].moves == ZP_MOVES_PLANE ? ZP_WAYS : 1;
  }
}

/* Leaders, members abreast, order: all that follows from the ends. */
static void look(ZpNetwork *n) {
  find_unknowns(n);
  n->hangs = n->springs == 0 && !n->pulled && !n->plane;
  for (size_t body = 0; body < n->bodies; body++)
    if (!n->body[body].held && !n->plane) n->body[body].leader = leader_of(n, body);
  for (size_t k = 0; k < n->members; k++) {
    ZpEnds *one = &n->ends[k];
    n->opposed |= one->turned;
    n->hangs &= !one->turned && !n->body[one->lower].held && n->body[one->lower].leader == k;
    for (size_t other = 0; other < n->members; other++)
      one->abreast += other == k || (!n->plane && are_abreast(one, &n->ends[other]));
  }
  find_path(n);
  for (size_t k = 0; k < n->members; k++)
    n->order[k] = k;
  if (n->hangs && n->load == n->bodies) find_order(n);
}

ZpNetwork *zp_network_create(const ZpActuatorDef *def) {
  const bool given = zp_def_network(def);
  const size_t members = (size_t)zp_def_members(def), springs = (size_t)zp_instance_count(def, ZP_OF_SPRING),
               joints = (size_t)zp_instance_count(def, ZP_OF_JOINT);
  const size_t bodies = given                    ? (size_t)zp_instance_count(def, ZP_OF_BODY) + 1
                        : zp_def_antagonist(def) ? 3
                        : zp_def_parallel(def)   ? 2
                                                 : members + 1;
  ZpNetwork *n = zp_calloc(1, sizeof *n + bodies * sizeof *n->body + members * sizeof *n->ends +
                                  springs * sizeof *n->spring + joints * sizeof *n->joint + members * sizeof *n->order);
  if (!n) return NULL;
  *n = (ZpNetwork){
      .bodies = bodies, .members = members, .springs = springs, .joints = joints, .body = (ZpBody *)(void *)(n + 1)};
  n->ends = (ZpEnds *)(void *)(n->body + bodies);
  n->spring = (ZpLink *)(void *)(n->ends + members);
  n->joint = (ZpBodyJoint *)(void *)(n->spring + springs);
  n->order = (size_t *)(void *)(n->joint + joints);
  n->body[FRAME].held = true;
  if (given)
    join_bodies(def, n);
  else
    join_stack(def, n);
  find_ports(def, n, n->order);
  look(n);
  return n;
}

bool zp_network_abreast(const ZpNetwork *n, size_t one, size_t other) {
  return are_abreast(&n->ends[one], &n->ends[other]);
}

const ZpColumn *zp_body_columns(bool plane, size_t *count) {
  static const ZpColumn vertical[] = {{"#.y_m", "m", "height of #: 0 where all members above it are closed"}};
  static const ZpColumn in_plane[ZP_WAYS] = {{"#.x_m", "m", "place of #, to the right"},
                                             {"#.y_m", "m", "height of #"},
                                             {"#.angle_rad", "rad", "angle of #, anticlockwise"}};
  *count = plane ? ZP_WAYS : 1;
  return plane ? in_plane : vertical;
}

long zp_network_unknown(const ZpNetwork *n, size_t body, ZpWay way) {
  const ZpBody *b = &n->body[body];
  if (b->held || (b->moves != ZP_MOVES_PLANE && way != ZP_WAY_UP)) return -1;
  return (long)(b->unknown + (b->moves == ZP_MOVES_PLANE ? way : 0));
}

bool zp_network_alike(const ZpNetwork *one, const ZpNetwork *other) {
  bool alike = one->bodies == other->bodies && one->members == other->members && one->load == other->load;
  for (size_t k = 0; alike && k < one->bodies; k++)
    alike = one->body[k].moves == other->body[k].moves && one->body[k].held == other->body[k].held;
  for (size_t k = 0; alike && k < one->members; k++)
    alike = are_abreast(&one->ends[k], &other->ends[k]);
  return alike;
}

double zp_network_depth(const ZpNetwork *n) {
  double depth = 0;
  for (const ZpBody *body = n->body; body < n->body + n->bodies; body++)
    if (body->held) depth = fmax(depth, -body->y);
  return depth;
}

/* -- rules ----------------------------------------------------------------------------------------- */

static const char own_load[] = "each body has a mass of its own: give bodies.NAME.mass, a force on it and springs",
                  own_ends[] = "each member has the bodies at its ends: give members.NAME.upper and lower",
                  field_meter[] = "the stroke that a meter of a member tells is that of the plates law; use plates";

static const ZpRule rule[] = {
    ZP_RULE_IF(PHYSICS, ZP_SET_WITHIN(load.mass, load.drop_height), ZP_NETWORK, ZP_NEVER, own_load),
    ZP_RULE_IF(PHYSICS, ZP_SET_WITHIN(stack.series, stack.lower_voltage), ZP_NETWORK, ZP_NEVER, own_ends),
    ZP_RULE(NOT_MODELLED, ZP_NETWORK, ZP_UNSET(mount.tilt), "gravity acts downwards on bodies"),
    ZP_RULE(NOT_MODELLED, ZP_PLANE, ZP_HAS(PLATFORM),
            "what turns the ends of members without platforms is not modelled"),
    ZP_RULE_IF(NOT_MODELLED, ZP_NOT(liquid.model, ZP_LIQUID_NONE), ZP_PLANE, ZP_NEVER,
               "the liquid between platforms is modelled for level ones only"),
    ZP_RULE(NOT_MODELLED, ZP_NETWORK, ZP_IS(actuator.held_clip, ZP_HELD_NONE), "bodies hold platforms, not clips"),
    ZP_RULE(PHYSICS, ZP_NETWORK, ZP_NOT(initial.state, ZP_INITIAL_STRAIGHT),
            "straight ribbons do not reach the bodies"),
    ZP_RULE(EQUATION, ZP_NETWORK, ZP_IS(ribbon.plasticity, false),
            "how the members had been bent before they were joined is not known"),
    ZP_RULE_IF(NOT_MODELLED, ZP_NETWORK, ZP_IS(electro.model, ZP_ELECTRO_FIELD), ZP_UNSET(sense.frequency),
               field_meter),
    ZP_RULE_IF(NOT_MODELLED, ZP_SET_WITHIN(member_K.port, member_K.setpoint.duty), ZP_SET(sense.frequency),
               ZP_NOT(electro.model, ZP_ELECTRO_FIELD), field_meter),
    ZP_RULE_IF(NOT_MODELLED, ZP_SET(member_K.sense.frequency), ZP_ANY, ZP_NOT(electro.model, ZP_ELECTRO_FIELD),
               field_meter),
};

static const ZpRules rules = ZP_RULES_OF(rule);
const ZpRules *const zp_rules_of_network[] = {&rules, NULL};
