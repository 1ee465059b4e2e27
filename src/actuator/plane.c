#include "actuator/plane.h"

#include "base/fail.h"
#include "base/memory.h"
#include "def/check.h"
#include "math/elementary.h"

/* -- vectors --------------------------------------------------------------------------------------- */

ZpVector zp_direction(double angle) {
  double turns = angle / (2 * zp_pi);
  turns -= floor(turns);
  return (ZpVector){zp_cosine_of(turns), zp_sine_of(turns)};
}

/* -- creation -------------------------------------------------------------------------------------- */

static ZpVector vector(const double at[2]) {
  return (ZpVector){at[0], at[1]};
}

/* A point of a body in the drawing. */
static ZpVector point_of(const ZpBody *body, const double at[2]) {
  return zp_sum((ZpVector){body->x, body->y}, zp_turned(zp_direction(body->angle), vector(at)));
}

/* End `j` of a platform of a member, from its middle. */
static ZpVector end_of_platform(const ZpModel *model, ZpVector axis, int j) {
  return zp_times((j == 0 ? -0.5 : 0.5) * model->def.platform.length, axis);
}

static ZpStatus check_reach(const ZpModel *model, ZpError *err) {
  static const double near = 1e-9;
  const ZpNetwork *network = model->network;
  const ZpEnds *ends = &network->ends[model->number];
  const double most = zp_most_opening * 2 * model->L;
  const ZpVector apart = zp_difference(point_of(&network->body[ends->lower], ends->at[1]),
                                       point_of(&network->body[ends->upper], ends->at[0]));
  const double opens = -zp_along(apart, zp_across(zp_direction(ends->angle))), distance = sqrt(zp_along(apart, apart));
  char room[ZP_NAME_SIZE];
  const char *name = zp_def_name(model->whole, ZP_OF_MEMBER, (int)model->number + 1, room);
  if (opens < -near)
    return zp_fail(err, ZP_BAD_INPUT,
                   "members.%s: in the drawing its lower end is %g mm on the wrong side of its upper one; move a body "
                   "or a point, or give members.%s.angle the direction in which it opens",
                   name, -1e3 * opens, name);
  if (distance > most + near)
    return zp_fail(err, ZP_BAD_INPUT,
                   "members.%s: it opens by 0 to %g mm, but its ends are apart by %g mm too much in the drawing; move "
                   "a body or a point, or change a length",
                   name, 1e3 * most, 1e3 * (distance - most));
  return ZP_OK;
}

ZpStatus zp_plane_check(const ZpModel *first, ZpError *err) {
  ZpStatus status = ZP_OK;
  for (size_t k = 0; first->network->plane && k < first->members && status == ZP_OK; k++)
    status = check_reach(first + k, err);
  return status;
}

/* The four ends of the platforms of a member: on its upper and on its lower body, left and right => their masses. */
enum { ENDS = 4 };
typedef struct End {
  size_t body;
  ZpVector at; /* in the drawing, m */
  double mass; /* kg */
} End;

static void find_ends(const ZpModel *model, End end[ENDS]) {
  const ZpNetwork *network = model->network;
  const ZpEnds *ends = &network->ends[model->number];
  const ZpTopology *t = &model->topology;
  const ZpVector axis = zp_direction(ends->angle);
  for (int k = 0; k < ENDS; k++) {
    const bool lower = k >= 2;
    const size_t station = k % 2 == 0 ? t->platform.first : t->platform.last, body = lower ? ends->lower : ends->upper;
    const ZpVector middle = point_of(&network->body[body], ends->at[lower]);
    end[k] = (End){body, zp_sum(middle, end_of_platform(model, axis, k % 2)),
                   model->mass[lower ? zp_lower(t, station) : zp_upper(t, station)]};
  }
}

/* Eq. (34.1): centre of mass and inertia of a body with the platforms on it. */
static void weigh_body(const ZpPlanar *plane, size_t which) {
  const ZpBody *body = &plane->first->network->body[which];
  const ZpVector place = {body->x, body->y};
  double mass = body->mass, inertia = body->inertia;
  ZpVector moment = {0, 0};
  for (int pass = 0; pass < 2; pass++) {
    for (size_t k = 0; k < plane->members; k++) {
      End end[ENDS];
      find_ends(plane->first + k, end);
      for (int e = 0; e < ENDS; e++) {
        const ZpVector from = zp_difference(end[e].at, place);
        if (end[e].body != which) continue;
        if (pass == 0) mass += end[e].mass;
        if (pass == 0) moment = zp_sum(moment, zp_times(end[e].mass, from));
        if (pass == 1) inertia += end[e].mass * zp_along(from, from);
      }
    }
  }
  const ZpVector centre = mass > 0 ? zp_times(1 / mass, moment) : moment;
  ZpPlaneBody *to = &plane->body[which];
  *to = (ZpPlaneBody){.drawn = {place.x + centre.x, place.y + centre.y, 0},
                      .place = zp_times(-1, centre),
                      .mass = mass,
                      .inertia = inertia - mass * zp_along(centre, centre)};
  for (int way = 0; way < ZP_WAYS; way++)
    to->unknown[way] = zp_network_unknown(plane->first->network, which, (ZpWay)way);
}

static ZpVector centre_of(const ZpPlanar *plane, size_t body) {
  return (ZpVector){plane->body[body].drawn.x, plane->body[body].drawn.y};
}

static ZpStand stand_of(const ZpPlanar *plane, size_t member) {
  const ZpModel *model = plane->first + member;
  const ZpNetwork *network = model->network;
  const ZpEnds *ends = &network->ends[member];
  const ZpJoint *platform = &model->topology.platform;
  End end[ENDS];
  find_ends(model, end);
  return (ZpStand){.upper = ends->upper,
                   .lower = ends->lower,
                   .axis = zp_direction(ends->angle),
                   .arm =
                       zp_difference(point_of(&network->body[ends->upper], ends->at[0]), centre_of(plane, ends->upper)),
                   .node = {zp_difference(end[2].at, centre_of(plane, ends->lower)),
                            zp_difference(end[3].at, centre_of(plane, ends->lower))},
                   .middle = 0.5 * (zp_straight_x(model, platform->first) + zp_straight_x(model, platform->last)),
                   .still = network->body[ends->upper].held};
}

bool zp_plane_create(const ZpModel *first, ZpPlanar *plane) {
  const ZpNetwork *network = first->network;
  *plane = (ZpPlanar){.first = first};
  if (!network->plane) return true;
  plane->bodies = network->bodies;
  plane->members = network->members;
  plane->length = first->L;
  plane->body = zp_calloc(plane->bodies, sizeof *plane->body);
  plane->stand = zp_calloc(plane->members, sizeof *plane->stand);
  if (!plane->body || !plane->stand) return false;
  for (size_t b = 0; b < plane->bodies; b++)
    weigh_body(plane, b);
  for (size_t k = 0; k < plane->members; k++)
    plane->stand[k] = stand_of(plane, k);
  return true;
}

void zp_plane_destroy(ZpPlanar *plane) {
  zp_free(plane->body);
  zp_free(plane->stand);
  *plane = (ZpPlanar){0};
}

/* -- where things are ------------------------------------------------------------------------------ */

ZpVector zp_pose_point(const ZpPose *pose, ZpVector arm) {
  return zp_sum((ZpVector){pose->x, pose->y}, zp_turned(zp_direction(pose->turn), arm));
}

/* R(b) - R(a) = 2 sin((b - a) / 2) J R((a + b) / 2). */
ZpVector zp_pose_sweep(const ZpPose *from, const ZpPose *to, ZpVector arm) {
  const double half = 0.5 * (to->turn - from->turn);
  const ZpVector across = zp_across(zp_turned(zp_direction(0.5 * (from->turn + to->turn)), arm));
  return half == 0 ? across : zp_times(zp_direction(half).y / half, across);
}

ZpPose zp_plane_place(const ZpPlanar *plane, size_t body, const ZpPose *pose) {
  const ZpVector at = zp_pose_point(&pose[body], plane->body[body].place);
  return (ZpPose){at.x, at.y, plane->first->network->body[body].angle + pose[body].turn};
}

void zp_plane_drawn(const ZpPlanar *plane, ZpPose *pose) {
  for (size_t b = 0; b < plane->bodies; b++)
    pose[b] = plane->body[b].drawn;
}

static double *coordinate(ZpPose *pose, int way) {
  return way == ZP_WAY_ALONG ? &pose->x : way == ZP_WAY_UP ? &pose->y : &pose->turn;
}

static double unit_of(const ZpPlanar *plane, int way) {
  return way == ZP_WAY_TURNS ? plane->length : 1;
}

void zp_plane_poses(const ZpPlanar *plane, size_t inner, const double *x, ZpPose *pose) {
  for (size_t b = 0; b < plane->bodies; b++)
    for (int way = 0; way < ZP_WAYS; way++) {
      const long unknown = plane->body[b].unknown[way];
      ZpPose drawn = plane->body[b].drawn;
      *coordinate(&pose[b], way) =
          unknown < 0 ? *coordinate(&drawn, way) : x[inner + (size_t)unknown] / unit_of(plane, way);
    }
}

void zp_plane_gather(const ZpPlanar *plane, size_t inner, const ZpPose *pose, double *x) {
  for (size_t b = 0; b < plane->bodies; b++)
    for (int way = 0; way < ZP_WAYS; way++) {
      const long unknown = plane->body[b].unknown[way];
      ZpPose at = pose[b];
      if (unknown >= 0) x[inner + (size_t)unknown] = unit_of(plane, way) * *coordinate(&at, way);
    }
}

ZpVector zp_stand_axis(const ZpStand *stand, const ZpPose *pose) {
  return zp_turned(zp_direction(pose[stand->upper].turn), stand->axis);
}

ZpVector zp_stand_origin(const ZpStand *stand, const ZpPose *pose) {
  return zp_pose_point(&pose[stand->upper], stand->arm);
}

ZpVector zp_stand_outside(const ZpStand *stand, const ZpPose *pose, ZpVector inside) {
  const ZpVector from = {inside.x - stand->middle, inside.y};
  return zp_sum(zp_stand_origin(stand, pose), zp_turned(zp_stand_axis(stand, pose), from));
}

ZpVector zp_stand_inside(const ZpStand *stand, const ZpPose *pose, ZpVector outside) {
  const ZpVector from = zp_difference(outside, zp_stand_origin(stand, pose));
  const ZpVector inside = zp_turned_back(zp_stand_axis(stand, pose), from);
  return (ZpVector){stand->middle + inside.x, inside.y};
}

void zp_plane_draw(const ZpPlanar *plane, size_t member, const ZpPose *pose, size_t count, double *x, double *y) {
  for (size_t j = 0; j < count; j++) {
    const ZpVector at = zp_stand_outside(&plane->stand[member], pose, (ZpVector){x[j], y[j]});
    x[j] = at.x;
    y[j] = at.y;
  }
}

void zp_plane_put_platform(const ZpPlanar *plane, size_t member, const ZpPose *pose, double nearer, double *nodes) {
  const ZpModel *model = plane->first + member;
  const ZpTopology *t = &model->topology;
  const ZpStand *stand = &plane->stand[member];
  const ZpForces to = zp_forces(model, nodes);
  for (int e = 0; e < 2; e++) {
    const size_t station = e == 0 ? t->platform.first : t->platform.last, j = zp_lower(t, station);
    const ZpVector at = zp_stand_inside(stand, pose, zp_pose_point(&pose[stand->lower], stand->node[e]));
    const double straight = zp_straight_x(model, station);
    to.x[j] = straight + nearer * (at.x - straight);
    to.y[j] = nearer * at.y;
  }
}

int zp_plane_border(const ZpPlanar *plane, size_t member, bool upper, ZpWay way, const ZpAssembly *a) {
  const ZpStand *stand = &plane->stand[member];
  const size_t body[] = {stand->lower, stand->upper};
  int at = (int)a->block.n;
  for (int b = 0; b < 2; b++)
    for (int w = 0; w < ZP_WAYS; w++) {
      const bool moves = plane->body[body[b]].unknown[w] >= 0;
      if (b == (int)upper && w == (int)way) return moves ? at : -1;
      at += moves;
    }
  return -1;
}

/* By the motion of the lower and of the upper body, along and up, and by their turns about their centres. */
void zp_plane_swing(const ZpPlanar *plane, size_t member, const ZpPose *pose, ZpAssembly *a) {
  const ZpStand *stand = &plane->stand[member];
  const ZpVector axis[] = {zp_stand_axis(stand, pose), zp_across(zp_stand_axis(stand, pose))};
  const size_t body[] = {stand->lower, stand->upper};
  for (int k = 0; k < ZP_SWINGS; k++) {
    const ZpVector at = zp_pose_point(&pose[stand->lower], stand->node[k / 2]), own = axis[k % 2];
    ZpSwing *swing = &a->swing[k];
    size_t count = 0;
    for (int b = 0; b < 2; b++) {
      const ZpVector from = {at.x - pose[body[b]].x, at.y - pose[body[b]].y};
      const double by[ZP_WAYS] = {own.x, own.y, zp_along(own, zp_across(from)) / plane->length};
      for (int way = 0; way < ZP_WAYS; way++)
        if (plane->body[body[b]].unknown[way] >= 0) swing->factor[count++] = b == 0 ? by[way] : -by[way];
    }
  }
}

/* K += value at two places of a block, of which either may be missing. */
static void put(int row, int column, double value, ZpBand *K) {
  if (row >= 0 && column >= 0) *zp_band_entry(K, (size_t)row, (size_t)column) += value;
}

void zp_plane_add_turns(const ZpPlanar *plane, size_t member, const ZpPose *pose, const ZpAssembly *a,
                        const ZpVector force[2], double share, ZpBand *K) {
  const ZpStand *stand = &plane->stand[member];
  const double unit = plane->length;
  int of[2][ZP_WAYS];
  for (int b = 0; b < 2; b++)
    for (int way = 0; way < ZP_WAYS; way++)
      of[b][way] = zp_plane_border(plane, member, b > 0, (ZpWay)way, a);
  const int lower = of[0][ZP_WAY_TURNS], upper = of[1][ZP_WAY_TURNS];
  for (int e = 0; e < 2; e++) {
    const ZpVector F = zp_times(share, zp_turned(zp_stand_axis(stand, pose), force[e])), across = zp_across(F);
    const ZpVector at = zp_pose_point(&pose[stand->lower], stand->node[e]);
    const ZpVector from_lower = {at.x - pose[stand->lower].x, at.y - pose[stand->lower].y},
                   from_upper = {at.x - pose[stand->upper].x, at.y - pose[stand->upper].y};
    put(lower, lower, zp_along(F, from_lower) / (unit * unit), K);
    put(upper, upper, zp_along(F, from_upper) / (unit * unit), K);
    put(lower, upper, -zp_along(F, from_lower) / (unit * unit), K);
    put(of[0][ZP_WAY_ALONG], upper, -across.x / unit, K);
    put(of[0][ZP_WAY_UP], upper, -across.y / unit, K);
    put(of[1][ZP_WAY_ALONG], upper, across.x / unit, K);
    put(of[1][ZP_WAY_UP], upper, across.y / unit, K);
  }
}

/* -- masses ---------------------------------------------------------------------------------------- */

double zp_plane_change(const ZpPlanar *plane, size_t body, int way, size_t inner, const double *u) {
  const long unknown = plane->body[body].unknown[way];
  return unknown < 0 ? 0 : u[inner + (size_t)unknown] / unit_of(plane, way);
}

void zp_plane_push(const ZpPlanar *plane, size_t body, int way, double force, size_t inner, double *f) {
  const long unknown = plane->body[body].unknown[way];
  if (unknown >= 0) f[inner + (size_t)unknown] += force / unit_of(plane, way);
}

void zp_plane_push_at(const ZpPlanar *plane, size_t body, ZpVector arm, ZpVector force, const ZpPose *from,
                      const ZpPose *to, size_t inner, double *f) {
  zp_plane_push(plane, body, ZP_WAY_ALONG, force.x, inner, f);
  zp_plane_push(plane, body, ZP_WAY_UP, force.y, inner, f);
  zp_plane_push(plane, body, ZP_WAY_TURNS, zp_along(force, zp_pose_sweep(&from[body], &to[body], arm)), inner, f);
}

void zp_plane_carry(const ZpPlanar *plane, size_t member, const ZpPose *pose, size_t inner, const double *nodes,
                    const double *u, double *moved) {
  const ZpModel *model = plane->first + member;
  const ZpStand *stand = &plane->stand[member];
  const ZpVector axis = zp_stand_axis(stand, pose), arm = zp_turned(zp_direction(pose[stand->upper].turn), stand->arm);
  const double turns = zp_plane_change(plane, stand->upper, ZP_WAY_TURNS, inner, u);
  const ZpVector shift =
      zp_turned_back(axis, zp_sum((ZpVector){zp_plane_change(plane, stand->upper, ZP_WAY_ALONG, inner, u),
                                             zp_plane_change(plane, stand->upper, ZP_WAY_UP, inner, u)},
                                  zp_times(turns, zp_across(arm))));
  const ZpNodes at = zp_nodes(model, nodes);
  const ZpForces to = zp_forces(model, moved);
  for (size_t j = 0; !stand->still && j < model->count; j++) {
    if (zp_is_of_platform(&model->topology, j)) continue;
    const ZpVector by = zp_sum(shift, zp_times(turns, zp_across((ZpVector){at.x[j] - stand->middle, at.y[j]})));
    to.x[j] += by.x;
    to.y[j] += by.y;
  }
}

void zp_plane_carry_back(const ZpPlanar *plane, size_t member, const ZpPose *pose, size_t inner, const double *nodes,
                         const double *force, double *u) {
  const ZpModel *model = plane->first + member;
  const ZpStand *stand = &plane->stand[member];
  const ZpVector axis = zp_stand_axis(stand, pose), arm = zp_turned(zp_direction(pose[stand->upper].turn), stand->arm);
  const ZpNodes at = zp_nodes(model, nodes), f = zp_nodes(model, force);
  ZpVector sum = {0, 0};
  double torque = 0;
  for (size_t j = 0; !stand->still && j < model->count; j++) {
    if (zp_is_of_platform(&model->topology, j)) continue;
    const ZpVector one = {f.x[j], f.y[j]};
    sum = zp_sum(sum, one);
    torque += zp_along(one, zp_across((ZpVector){at.x[j] - stand->middle, at.y[j]}));
  }
  sum = zp_turned(axis, sum);
  const double of[ZP_WAYS] = {sum.x, sum.y, torque + zp_along(sum, zp_across(arm))};
  for (int way = 0; way < ZP_WAYS; way++)
    zp_plane_push(plane, stand->upper, way, of[way], inner, u);
}

/* Of an unknown of a body, kg. */
static double mass_of(const ZpPlanar *plane, size_t body, int way) {
  const ZpPlaneBody *b = &plane->body[body];
  return way == ZP_WAY_TURNS ? b->inertia / (plane->length * plane->length) : b->mass;
}

void zp_plane_weigh(const ZpPlanar *plane, size_t inner, const double *u, double *mu) {
  for (size_t b = 0; b < plane->bodies; b++)
    for (int way = 0; way < ZP_WAYS; way++) {
      const long unknown = plane->body[b].unknown[way];
      if (unknown >= 0) mu[inner + (size_t)unknown] += mass_of(plane, b, way) * u[inner + (size_t)unknown];
    }
}

void zp_plane_add_masses(const ZpPlanar *plane, size_t inner, double *mass) {
  for (size_t b = 0; b < plane->bodies; b++)
    for (int way = 0; way < ZP_WAYS; way++) {
      const long unknown = plane->body[b].unknown[way];
      if (unknown >= 0) mass[inner + (size_t)unknown] += mass_of(plane, b, way);
    }
}

/* -- motion ---------------------------------------------------------------------------------------- */

/* How far the origin of a member's frame is from where it is in the drawing, as seen there. */
static ZpVector gone(const ZpPlanar *plane, const ZpStand *stand, const ZpPose *pose) {
  const ZpVector drawn = zp_sum(centre_of(plane, stand->upper), stand->arm);
  return zp_turned_back(stand->axis, zp_difference(zp_stand_origin(stand, pose), drawn));
}

void zp_plane_to_drawing(const ZpPlanar *plane, size_t member, const ZpPose *pose, double *nodes) {
  const ZpStand *stand = &plane->stand[member];
  const ZpForces at = zp_forces(plane->first + member, nodes);
  const ZpVector turn = zp_direction(pose[stand->upper].turn), way = gone(plane, stand, pose);
  for (size_t j = 0; !stand->still && j < plane->first[member].count; j++) {
    const ZpVector to = zp_sum(way, zp_turned(turn, (ZpVector){at.x[j] - stand->middle, at.y[j]}));
    at.x[j] = stand->middle + to.x;
    at.y[j] = to.y;
  }
}

void zp_plane_from_drawing(const ZpPlanar *plane, size_t member, const ZpPose *pose, double *nodes) {
  const ZpModel *model = plane->first + member;
  const ZpStand *stand = &plane->stand[member];
  const ZpForces at = zp_forces(model, nodes);
  const ZpVector turn = zp_direction(pose[stand->upper].turn), way = gone(plane, stand, pose);
  for (size_t j = 0; !stand->still && j < model->count; j++) {
    if (zp_is_of_platform(&model->topology, j)) continue;
    const ZpVector to = zp_turned_back(turn, zp_difference((ZpVector){at.x[j] - stand->middle, at.y[j]}, way));
    at.x[j] = stand->middle + to.x;
    at.y[j] = to.y;
  }
  zp_plane_put_platform(plane, member, pose, 1, nodes);
}

void zp_plane_turn(const ZpPlanar *plane, size_t member, const ZpPose *pose, bool to_drawing, double *vectors) {
  const ZpStand *stand = &plane->stand[member];
  const ZpForces at = zp_forces(plane->first + member, vectors);
  const ZpVector turn = zp_direction(pose[stand->upper].turn);
  for (size_t j = 0; !stand->still && j < plane->first[member].count; j++) {
    const ZpVector a = {at.x[j], at.y[j]}, b = to_drawing ? zp_turned(turn, a) : zp_turned_back(turn, a);
    at.x[j] = b.x;
    at.y[j] = b.y;
  }
}

ZpVector zp_plane_rate(const ZpPlanar *plane, size_t body, const ZpPose *pose, ZpVector arm, size_t inner,
                       const double *u) {
  const ZpVector centre = {zp_plane_change(plane, body, ZP_WAY_ALONG, inner, u),
                           zp_plane_change(plane, body, ZP_WAY_UP, inner, u)};
  const ZpVector across = zp_across(zp_turned(zp_direction(pose[body].turn), arm));
  return zp_sum(centre, zp_times(zp_plane_change(plane, body, ZP_WAY_TURNS, inner, u), across));
}

void zp_plane_put_rates(const ZpPlanar *plane, size_t member, const ZpPose *pose, size_t inner, const double *u,
                        double *rates) {
  const ZpModel *model = plane->first + member;
  const ZpTopology *t = &model->topology;
  const ZpStand *stand = &plane->stand[member];
  const ZpVector axis = zp_stand_axis(stand, pose);
  const ZpForces to = zp_forces(model, rates);
  for (int e = 0; e < 2; e++) {
    const size_t station = e == 0 ? t->platform.first : t->platform.last;
    const ZpVector arm = zp_sum(stand->arm, end_of_platform(model, stand->axis, e));
    const ZpVector lower = zp_turned_back(axis, zp_plane_rate(plane, stand->lower, pose, stand->node[e], inner, u)),
                   upper = zp_turned_back(axis, zp_plane_rate(plane, stand->upper, pose, arm, inner, u));
    to.x[zp_lower(t, station)] = lower.x;
    to.y[zp_lower(t, station)] = lower.y;
    to.x[zp_upper(t, station)] = upper.x;
    to.y[zp_upper(t, station)] = upper.y;
  }
}

/* With s a node from the origin, in the directions of the drawing: the member sees r = R(-turn) s, so that
 *   r1 - r0 = mean R(-turn) (s1 - s0) + (R(-turn1) - R(-turn0)) mean s. */
void zp_plane_add_force(const ZpPlanar *plane, size_t member, const ZpPose *from, const ZpPose *to, size_t inner,
                        const double *start, const double *end, const ZpAssembly *a, double *force, double *f) {
  const ZpModel *model = plane->first + member;
  const ZpTopology *t = &model->topology;
  const ZpStand *stand = &plane->stand[member];
  const double turn0 = from[stand->upper].turn, turn1 = to[stand->upper].turn, half = 0.5 * (turn1 - turn0);
  const ZpVector at0 = zp_direction(turn0), at1 = zp_direction(turn1), middle = zp_direction(0.5 * (turn0 + turn1)),
                 apart = zp_direction(half);
  const double sweep = half == 0 ? 1 : apart.y / half;
  const ZpNodes r0 = zp_nodes(model, start), r1 = zp_nodes(model, end);
  const ZpForces on = zp_forces(model, force);
  ZpVector sum = {0, 0};
  double torque = 0;
  for (size_t j = 0; !stand->still && j < model->count; j++) {
    if (j == zp_upper(t, t->platform.first) || j == zp_upper(t, t->platform.last)) continue;
    const ZpVector own = {on.x[j], on.y[j]};
    const ZpVector s0 = zp_turned(at0, (ZpVector){r0.x[j] - stand->middle, r0.y[j]}),
                   s1 = zp_turned(at1, (ZpVector){r1.x[j] - stand->middle, r1.y[j]});
    const ZpVector mean = zp_times(0.5, zp_sum(s0, s1)), outside = zp_times(apart.x, zp_turned(middle, own));
    torque -= sweep * zp_along(own, zp_across(zp_turned_back(middle, mean)));
    sum = zp_sum(sum, outside);
    on.x[j] = outside.x;
    on.y[j] = outside.y;
  }
  zp_assembly_add_free(a, force, f);
  for (int e = 0; e < 2; e++) {
    const size_t j = zp_lower(t, e == 0 ? t->platform.first : t->platform.last);
    zp_plane_push_at(plane, stand->lower, stand->node[e], zp_turned(stand->axis, (ZpVector){on.x[j], on.y[j]}), from,
                     to, inner, f);
  }
  if (stand->still) return;
  zp_plane_push_at(plane, stand->upper, stand->arm, zp_turned(stand->axis, zp_times(-1, sum)), from, to, inner, f);
  zp_plane_push(plane, stand->upper, ZP_WAY_TURNS, torque, inner, f);
}

void zp_plane_add_inertia(const ZpPlanar *plane, size_t member, const ZpPose *pose, const ZpAssembly *a, double of_mass,
                          const double *nodes, ZpBand *K) {
  const ZpModel *model = plane->first + member;
  const ZpStand *stand = &plane->stand[member];
  const ZpNodes at = zp_nodes(model, nodes);
  const ZpVector axis = zp_stand_axis(stand, pose), arm = zp_turned(zp_direction(pose[stand->upper].turn), stand->arm);
  int of[ZP_WAYS];
  for (int way = 0; way < ZP_WAYS; way++)
    of[way] = zp_plane_border(plane, member, true, (ZpWay)way, a);
  for (size_t j = 0; !stand->still && j < model->count; j++) {
    if (zp_is_of_platform(&model->topology, j)) continue;
    const double mass = of_mass * model->mass[j], unit = plane->length;
    const ZpVector from = zp_sum(arm, zp_turned(axis, (ZpVector){at.x[j] - stand->middle, at.y[j]}));
    const ZpVector along = zp_turned_back(axis, (ZpVector){1, 0}), up = zp_turned_back(axis, (ZpVector){0, 1}),
                   turn = zp_times(1 / unit, zp_turned_back(axis, zp_across(from)));
    const ZpVector by[ZP_WAYS] = {along, up, turn};
    for (int way = 0; way < ZP_WAYS; way++) {
      put(a->place[zp_x_of(j)], of[way], mass * by[way].x, K);
      put(a->place[zp_y_of(j)], of[way], mass * by[way].y, K);
      for (int other = way; other < ZP_WAYS; other++)
        put(of[way], of[other], mass * zp_along(by[way], by[other]), K);
    }
  }
}
