#include "actuator/ties.h"

#include "base/pair.h"

static void add(ZpTies *ties, ZpTie tie) {
  ties->tie[ties->count++] = tie;
}

/* A coordinate of the straight actuator, m. */
static double straight(const ZpModel *model, size_t k) {
  return k % 2 == 0 ? zp_straight_x(model, k / 2 / model->s) : 0;
}

/* A held coordinate stays where the straight actuator has it, except the one along which a body moves that the member
 * hangs on. The rest of a joint moves as its first station does. */
static void add_joint(ZpTies *ties, const ZpJoint *joint, bool hangs) {
  const size_t member = ties->member;
  const ZpModel *model = ties->first + member;
  const ZpJointWay *way = &zp_joint_way[joint->kind];
  const size_t s = model->s, first = 2 * s * joint->first, end = 2 * s * (joint->last + 1);
  for (size_t k = first; k < end; k++) {
    size_t ribbon = k / 2 % s, to = first + 2 * (way->unites ? 0 : ribbon) + k % 2;
    double x = straight(model, k);
    if (way->held[ribbon][k % 2] && !(hangs && k == zp_pulled(&model->topology, k / 2)))
      add(ties, (ZpTie){member, k, member, k, 0, x, 0});
    else if (to < k && !way->turns)
      add(ties, (ZpTie){member, k, member, to, 1, x - straight(model, to), 0});
  }
}

/* In space: clamps hold their stations in the plane of the ribbons; behind the last station there is no edge to turn.
 */
static void add_in_space(ZpTies *ties) {
  const size_t member = ties->member;
  const ZpModel *model = ties->first + member;
  const ZpTopology *t = &model->topology;
  for (const ZpJoint *joint = t->joint; joint < t->joint + t->joints; joint++) {
    const ZpJointWay *way = &zp_joint_way[joint->kind];
    for (size_t j = model->s * joint->first; j < model->s * (joint->last + 1); j++) {
      const size_t z = zp_coordinate_of(model->count, j, ZP_AXIS_Z);
      if (way->held[j % model->s][0] && way->held[j % model->s][1]) add(ties, (ZpTie){member, z, member, z, 0, 0, 0});
    }
  }
  for (size_t j = model->count - model->s; j < model->count; j++) {
    const size_t roll = zp_coordinate_of(model->count, j, ZP_AXIS_ROLL);
    add(ties, (ZpTie){member, roll, member, roll, 0, 0, 0});
  }
}

/* The coordinate of a member that is the height of the body at its upper or at its lower end. */
static size_t height_at(const ZpModel *model, bool upper) {
  const ZpTopology *t = &model->topology;
  return zp_pulled(t, upper ? zp_top_node(t) : zp_load_node(t));
}

ZpSight zp_sight_of_end(const ZpModel *first, size_t member, bool upper) {
  const ZpModel *model = first + member;
  return (ZpSight){member, height_at(model, upper), zp_network_origin(first->network, member),
                   zp_network_sign(first->network, member) * zp_rises(&model->topology)};
}

ZpSight zp_sight_of_body(const ZpModel *first, size_t body) {
  const ZpNetwork *network = first->network;
  const size_t leader = network->body[body].leader;
  return zp_sight_of_end(first, leader, network->ends[leader].lower != body);
}

/* The height of a body that moves is that of its leader; other members see it in their own frames, eqs. (29.2) and
 * (31.3). */
static void add_end(ZpTies *ties, bool upper) {
  const ZpNetwork *network = ties->first->network;
  const ZpEnds *ends = &network->ends[ties->member];
  const size_t body = upper ? ends->upper : ends->lower;
  const ZpSight own = zp_sight_of_end(ties->first, ties->member, upper);
  const size_t k = own.coordinate;
  if (network->body[body].held && !upper) /* a joint holds the upper platform */
    add(ties, (ZpTie){own.member, k, own.member, k, 0, zp_seen(&own, network->body[body].y), 0});
  if (network->body[body].held || network->body[body].leader == own.member) return;
  const ZpSight lead = zp_sight_of_body(ties->first, body);
  add(ties, (ZpTie){own.member, k, lead.member, lead.coordinate, own.sign * lead.sign, zp_seen(&own, lead.origin), 0});
}

/* The rows of one member, as its joints and the bodies at its ends say. */
static ZpTies list(const ZpModel *first, size_t members, size_t member) {
  ZpTies ties = {.first = first, .members = members, .member = member};
  const ZpTopology *t = &first[member].topology;
  const ZpNetwork *network = first->network;
  const bool joined = members > 1 && !network->plane,
             hangs = joined && !network->body[network->ends[member].upper].held;
  if (joined) add_end(&ties, true);
  if (joined) add_end(&ties, false);
  for (const ZpJoint *joint = t->joint; joint < t->joint + t->joints; joint++)
    add_joint(&ties, joint, hangs);
  if (zp_is_in_space(first + member)) add_in_space(&ties);
  return ties;
}

/* Let a row that refers to a tied coordinate refer to a free one. */
static void resolve(const ZpModel *first, size_t members, ZpTie *tie) {
  while (tie->factor != 0) {
    const ZpTies ties = list(first, members, tie->to_member);
    const ZpTie *next = zp_tie_of(&ties, tie->to);
    if (!next) return;
    tie->offset += tie->factor * next->offset;
    tie->factor *= next->factor;
    tie->to_member = next->to_member;
    tie->to = next->to;
  }
}

ZpTies zp_ties_of(const ZpModel *first, size_t members, size_t member) {
  ZpTies ties = list(first, members, member);
  for (ZpTie *tie = ties.tie; tie < ties.tie + ties.count; tie++)
    resolve(first, members, tie);
  return ties;
}

/* A body of a network, so far below the frame: in the frame of its leader. */
static ZpTie tie_of_body(const ZpModel *first, size_t body) {
  const ZpSight lead = zp_sight_of_body(first, body);
  return (ZpTie){lead.member, lead.coordinate, lead.member, lead.coordinate, 0, zp_seen(&lead, 0), -lead.sign};
}

ZpTie zp_tie_of_held(const ZpModel *first, size_t members) {
  if (first->network->plane) return (ZpTie){0};
  if (zp_is_network(first)) return tie_of_body(first, first->network->watched);
  const size_t member = zp_shares_load(first) ? 0 : members - 1;
  const double down = -zp_rises(&first->topology);
  ZpTie tie = {member, height_at(first + member, false), 0, height_at(first, true), 1, 0, down};
  resolve(first, members, &tie);
  return tie;
}

const ZpTie *zp_tie_of(const ZpTies *ties, size_t k) {
  for (const ZpTie *tie = ties->tie; tie < ties->tie + ties->count; tie++)
    if (tie->coordinate == k) return tie;
  return NULL;
}

static void share(size_t first, size_t end, const ZpAxisMasses *masses, double *a) {
  for (size_t i = first; i < end; i++) {
    size_t up = zp_up(i), down = zp_down(i);
    double force = a[up] * masses->mass[up] + a[down] * masses->mass[down];
    a[up] = a[down] = force * masses->pair[i];
  }
}

void zp_ties_share(const ZpModel *model, const ZpMasses *masses, const ZpZipState *act, double *a) {
  const ZpForces along = zp_forces(model, a);
  const size_t end = model->nodes, joined = act->front + 1, beyond = act->platform && joined < end ? end - 1 : end;
  if (!zp_is_pair(&model->topology)) return;
  share(0, joined, &masses->x, along.x);
  share(0, joined, &masses->y, along.y);
  share(beyond, end, &masses->x, along.x);
  share(beyond, end, &masses->y, along.y);
}

double zp_tie_join(const ZpTie *tie, const ZpAxisMasses *masses, double *velocity) {
  size_t up = tie->coordinate / 2, down = tie->to / 2;
  double upper = masses->inverse[up], lower = masses->inverse[down], sum = upper + lower;
  if (sum == 0) return 0;
  double difference = velocity[up] - velocity[down];
  velocity[up] = velocity[down] = (lower * velocity[up] + upper * velocity[down]) / sum;
  return 0.5 * difference * difference / sum;
}
