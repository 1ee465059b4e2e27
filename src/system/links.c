#include "system/links.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "system/friction.h"

/* -- creation -------------------------------------------------------------------------------------- */

static const ZpNetwork *network_of(const ZpLinks *links) {
  return links->plane->first->network;
}

/* A point of a body, given along its own axes from its place. */
static ZpVector arm_of(const ZpPlanar *plane, size_t body, const double at[2]) {
  const ZpVector own = {at[0], at[1]};
  return zp_sum(plane->body[body].place, zp_turned(zp_direction(plane->first->network->body[body].angle), own));
}

/* A point of the drawing. */
static ZpVector arm_to(const ZpPlanar *plane, size_t body, const double at[2]) {
  const ZpPose *drawn = &plane->body[body].drawn;
  return (ZpVector){at[0] - drawn->x, at[1] - drawn->y};
}

bool zp_links_create(const ZpPlanar *plane, size_t inner, ZpLinks *links) {
  *links = (ZpLinks){.plane = plane, .inner = inner};
  if (plane->bodies == 0) return true;
  const ZpNetwork *network = network_of(links);
  links->spring = zp_calloc(network->springs + 1, sizeof *links->spring);
  links->joint = zp_calloc(network->joints + 1, sizeof *links->joint);
  links->pull = zp_calloc(network->joints + 1, sizeof *links->pull);
  links->found = zp_calloc(network->joints + 1, sizeof *links->found);
  links->push = zp_calloc(network->bodies, sizeof *links->push);
  links->strain = zp_calloc(network->springs + 1, sizeof *links->strain);
  for (size_t k = 0; k < network->members; k++)
    links->stiffness = fmax(links->stiffness, plane->first[k].axial_stiffness);
  if (!links->spring || !links->joint || !links->pull || !links->found || !links->push || !links->strain) return false;
  for (size_t k = 0; k < network->springs; k++)
    for (int e = 0; e < 2; e++)
      links->spring[k].arm[e] = arm_of(plane, network->spring[k].body[e], network->spring[k].at[e]);
  for (size_t k = 0; k < network->joints; k++)
    for (int e = 0; e < 2; e++)
      links->joint[k].arm[e] = arm_to(plane, network->joint[k].body[e], network->joint[k].at);
  return true;
}

void zp_links_destroy(ZpLinks *links) {
  zp_free(links->spring);
  zp_free(links->joint);
  zp_free(links->pull);
  zp_free(links->found);
  zp_free(links->push);
  zp_free(links->strain);
  *links = (ZpLinks){0};
}

/* -- forces ---------------------------------------------------------------------------------------- */

static void add_torque(const ZpLinks *links, size_t body, double torque, double *f) {
  zp_plane_push(links->plane, body, ZP_WAY_TURNS, torque, links->inner, f);
}

static void add_at(const ZpLinks *links, size_t body, ZpVector arm, ZpVector force, const ZpPose *from,
                   const ZpPose *to, double *f) {
  zp_plane_push_at(links->plane, body, arm, force, from, to, links->inner, f);
}

/* Both points of a link: their distance at the start and at the end of a span. */
typedef struct Apart {
  ZpVector before, after, mean;
} Apart;

static ZpVector apart_at(const size_t body[2], const ZpArms *arms, const ZpPose *pose) {
  return zp_difference(zp_pose_point(&pose[body[1]], arms->arm[1]), zp_pose_point(&pose[body[0]], arms->arm[0]));
}

static Apart apart(const size_t body[2], const ZpArms *arms, const ZpPose *from, const ZpPose *to) {
  const ZpVector before = apart_at(body, arms, from), after = apart_at(body, arms, to);
  return (Apart){before, after, zp_times(0.5, zp_sum(before, after))};
}

/* A force on the second point, and its opposite on the first one. */
static void add_both(const ZpLinks *links, const size_t body[2], const ZpArms *arms, ZpVector force, const ZpPose *from,
                     const ZpPose *to, double *f) {
  add_at(links, body[1], arms->arm[1], force, from, to, f);
  add_at(links, body[0], arms->arm[0], zp_times(-1, force), from, to, f);
}

static double size_of(ZpVector a) {
  return sqrt(zp_along(a, a));
}

static ZpVector turned_by(const ZpPose *pose, ZpVector drawn) {
  return zp_turned(zp_direction(pose->turn), drawn);
}

/* How far the second point is from the first one in a direction of the drawing that turns with the first body. */
static double measured(const size_t body[2], const ZpArms *arms, ZpVector drawn, const ZpPose *pose) {
  return zp_along(apart_at(body, arms, pose), turned_by(&pose[body[0]], drawn));
}

/* A force in that direction on the second point, and its opposite on the first body. */
static void add_in(const ZpLinks *links, const size_t body[2], const ZpArms *arms, ZpVector drawn, double push,
                   const ZpPose *from, const ZpPose *to, double *f) {
  const ZpPose *before = &from[body[0]], *after = &to[body[0]];
  const ZpVector mean = zp_times(0.5, zp_sum(turned_by(before, drawn), turned_by(after, drawn)));
  add_torque(links, body[0], push * zp_along(apart(body, arms, from, to).mean, zp_pose_sweep(before, after, drawn)), f);
  add_both(links, body, arms, zp_times(push, mean), from, to, f);
}

/* -- springs with a direction, and their friction --------------------------------------------------- */

static bool is_directed(const ZpLink *link) {
  return !isnan(link->direction);
}

/* The direction of a spring, in which it pushes the second body, and that of its friction. */
static ZpVector facing(const ZpLink *link) {
  return zp_direction(link->direction);
}

static ZpVector beside(const ZpLink *link) {
  return zp_across(facing(link));
}

/* How much longer a spring is than at rest, m. */
static double gap_of(const ZpLinks *links, size_t k, const ZpPose *pose) {
  const ZpLink *link = &network_of(links)->spring[k];
  return measured(link->body, &links->spring[k], facing(link), pose) - link->rest;
}

/* Where its second point is beside the direction, m, counted from where the drawing has it. */
static double shift(const ZpLinks *links, size_t k, const ZpPose *pose) {
  const ZpLink *link = &network_of(links)->spring[k];
  const ZpArms *arms = &links->spring[k];
  const ZpPose *one = &links->plane->body[link->body[0]].drawn, *other = &links->plane->body[link->body[1]].drawn;
  const ZpVector drawn =
      zp_sum((ZpVector){other->x - one->x, other->y - one->y}, zp_difference(arms->arm[1], arms->arm[0]));
  return measured(link->body, arms, beside(link), pose) - zp_along(drawn, beside(link));
}

/* At rest, where both ends of the span are the same, it sticks where it was drawn: eq. (34.10). */
static ZpFriction friction_of(const ZpLinks *links, size_t k, const ZpPose *from, const ZpPose *to) {
  const ZpLink *link = &network_of(links)->spring[k];
  const double gap = gap_of(links, k, to), now = shift(links, k, to);
  if (from == to) return gap < 0 ? (ZpFriction){.mean = now, .end = now, .by_moved = 1} : (ZpFriction){0};
  const ZpRub rub = {link->friction, links->strain[k], now - shift(links, k, from), {gap_of(links, k, from), gap}};
  return zp_friction(&rub);
}

static void add_directed(const ZpLinks *links, size_t k, double share, const ZpPose *from, const ZpPose *to,
                         double *f) {
  const ZpLink *link = &network_of(links)->spring[k];
  const ZpArms *arms = &links->spring[k];
  const double before = link->rest + gap_of(links, k, from), after = link->rest + gap_of(links, k, to);
  add_in(links, link->body, arms, facing(link), -share * zp_link_pull(link, before, after, true).mean, from, to, f);
  if (link->friction == 0) return;
  const double drag = share * link->stiffness * friction_of(links, k, from, to).mean;
  add_in(links, link->body, arms, beside(link), -drag, from, to, f);
}

static void add_spring(const ZpLinks *links, size_t k, double share, const ZpPose *from, const ZpPose *to, double *f) {
  const ZpLink *link = &network_of(links)->spring[k];
  if (is_directed(link)) {
    add_directed(links, k, share, from, to, f);
    return;
  }
  const Apart d = apart(link->body, &links->spring[k], from, to);
  const double before = size_of(d.before), after = size_of(d.after);
  if (before + after == 0) return; /* without a length it has no direction */
  const double pull = share * zp_link_pull(link, before, after, true).mean;
  add_both(links, link->body, &links->spring[k], zp_times(-2 * pull / (before + after), d.mean), from, to, f);
}

/* Normal of the way along which a slide goes, which turns with its first body. */
static ZpVector normal_of(const ZpLinks *links, const ZpBodyJoint *joint) {
  return zp_across(zp_direction(network_of(links)->body[joint->body[0]].angle));
}

/* How far the second body has turned against the first one, rad. */
static double turned(const size_t body[2], const ZpPose *pose) {
  return pose[body[1]].turn - pose[body[0]].turn;
}

static double torsion(const ZpLinks *links) {
  return links->stiffness * links->plane->length * links->plane->length;
}

/* Numbers that a joint keeps at 0: distances, m, and an angle, rad. */
static void missed(const ZpLinks *links, size_t k, const ZpPose *pose, double by[ZP_PULLS]) {
  const ZpBodyJoint *joint = &network_of(links)->joint[k];
  const ZpArms *arms = &links->joint[k];
  const ZpVector d = apart_at(joint->body, arms, pose);
  const bool slides = joint->type == ZP_JOINS_SLIDE;
  by[0] = slides ? measured(joint->body, arms, normal_of(links, joint), pose) : d.x;
  by[1] = slides ? 0 : d.y;
  by[2] = joint->type == ZP_JOINS_PIN ? 0 : turned(joint->body, pose);
}

static void add_joint(ZpLinks *links, size_t k, const ZpPose *from, const ZpPose *to, double *f) {
  const ZpBodyJoint *joint = &network_of(links)->joint[k];
  const size_t one = joint->body[0], other = joint->body[1];
  double before[ZP_PULLS], after[ZP_PULLS], *pull = links->found[k];
  missed(links, k, from, before);
  missed(links, k, to, after);
  for (int c = 0; c < ZP_PULLS; c++)
    pull[c] = -0.5 * (c == 2 ? torsion(links) : links->stiffness) * (before[c] + after[c]);
  if (joint->type == ZP_JOINS_SLIDE)
    add_in(links, joint->body, &links->joint[k], normal_of(links, joint), pull[0], from, to, f);
  else
    add_both(links, joint->body, &links->joint[k], (ZpVector){pull[0], pull[1]}, from, to, f);
  add_torque(links, other, pull[2], f);
  add_torque(links, one, -pull[2], f);
}

/* Weight and constant force of a body, at its centre and at its place. */
static void add_constant(const ZpLinks *links, size_t b, double share, const ZpPose *from, const ZpPose *to,
                         double *f) {
  const ZpBody *body = &network_of(links)->body[b];
  const double *push = links->push[b];
  const ZpVector force = {share * body->force[0] + push[ZP_WAY_ALONG], share * body->force[1] + push[ZP_WAY_UP]};
  zp_plane_push(links->plane, b, ZP_WAY_UP, -share * links->plane->body[b].mass * links->plane->first->def.gravity,
                links->inner, f);
  add_at(links, b, links->plane->body[b].place, force, from, to, f);
  add_torque(links, b, share * body->torque + push[ZP_WAY_TURNS], f);
}

void zp_links_add_force(ZpLinks *links, double share, const ZpPose *from, const ZpPose *to, double *f) {
  const ZpNetwork *network = network_of(links);
  for (size_t b = 0; b < network->bodies; b++)
    add_constant(links, b, share, from, to, f);
  for (size_t k = 0; k < network->springs; k++)
    add_spring(links, k, share, from, to, f);
  for (size_t k = 0; k < network->joints; k++)
    add_joint(links, k, from, to, f);
}

/* -- stiffness ------------------------------------------------------------------------------------- */

enum { BOTH = 2 * ZP_WAYS };

/* Entries of a link of two bodies, by their motion along, up and by an angle. */
typedef struct Entries {
  double of[BOTH][BOTH];
} Entries;

static void add_products(double factor, const double by[BOTH], const double other[BOTH], Entries *e) {
  for (int i = 0; i < BOTH; i++)
    for (int j = 0; j < BOTH; j++)
      e->of[i][j] += factor * by[i] * other[j];
}

static void add_product(double factor, const double by[BOTH], Entries *e) {
  add_products(factor, by, by, e);
}

static void put(const ZpLinks *links, const size_t body[2], const Entries *e, ZpSparse *D) {
  for (int i = 0; i < BOTH; i++)
    for (int j = 0; j < BOTH; j++) {
      const long row = links->plane->body[body[i / ZP_WAYS]].unknown[i % ZP_WAYS],
                 column = links->plane->body[body[j / ZP_WAYS]].unknown[j % ZP_WAYS];
      const double unit = (i % ZP_WAYS == ZP_WAY_TURNS ? links->plane->length : 1) *
                          (j % ZP_WAYS == ZP_WAY_TURNS ? links->plane->length : 1);
      if (row >= 0 && column >= 0) *zp_sparse_at(D, (size_t)row, (size_t)column) += e->of[i][j] / unit;
    }
}

/* Both points of a link from the centres of their bodies, as they have turned. */
typedef struct Reach {
  ZpVector of[2];
} Reach;

static Reach reach(const size_t body[2], const ZpArms *arms, const ZpPose *pose) {
  return (Reach){{turned_by(&pose[body[0]], arms->arm[0]), turned_by(&pose[body[1]], arms->arm[1])}};
}

/* Derivative of the distance of both points along a direction. */
static void along(ZpVector direction, const Reach *r, double by[BOTH]) {
  for (int b = 0; b < 2; b++) {
    const double sign = b == 0 ? -1 : 1;
    by[ZP_WAYS * b + ZP_WAY_ALONG] = sign * direction.x;
    by[ZP_WAYS * b + ZP_WAY_UP] = sign * direction.y;
    by[ZP_WAYS * b + ZP_WAY_TURNS] = sign * zp_along(direction, zp_across(r->of[b]));
  }
}

/* Derivative of how far the second point is in a direction that turns with the first body => that direction. */
static ZpVector measured_by(const size_t body[2], const ZpArms *arms, ZpVector drawn, const ZpPose *pose,
                            const Reach *r, double by[BOTH]) {
  const ZpVector direction = turned_by(&pose[body[0]], drawn);
  along(direction, r, by);
  by[ZP_WAY_TURNS] += zp_along(apart_at(body, arms, pose), zp_across(direction));
  return direction;
}

/* How many distances a joint keeps at 0: along both axes, of a slide across its way. */
static int distances(const ZpBodyJoint *joint) {
  return joint->type == ZP_JOINS_SLIDE ? 1 : 2;
}

/* Derivative of distance `c`, whose direction turns with the first body of a slide => that direction. */
static ZpVector missed_by(const ZpLinks *links, size_t k, int c, const ZpPose *pose, const Reach *r, double by[BOTH]) {
  const ZpBodyJoint *joint = &network_of(links)->joint[k];
  if (joint->type != ZP_JOINS_SLIDE) {
    const ZpVector axis = c == 0 ? (ZpVector){1, 0} : (ZpVector){0, 1};
    along(axis, r, by);
    return axis;
  }
  return measured_by(joint->body, &links->joint[k], normal_of(links, joint), pose, r, by);
}

/* Minus the second derivative of that distance, times a force. */
static void bend(double force, ZpVector direction, const Reach *r, Entries *e) {
  e->of[ZP_WAY_TURNS][ZP_WAY_TURNS] -= force * zp_along(direction, r->of[0]);
  e->of[ZP_WAYS + ZP_WAY_TURNS][ZP_WAYS + ZP_WAY_TURNS] += force * zp_along(direction, r->of[1]);
}

/* Minus the second derivative beside that, times the force, where the direction turns with the first body. */
static void turn_direction(double force, ZpVector normal, ZpVector d, const Reach *r, Entries *e) {
  double rate[BOTH];
  along(zp_across(normal), r, rate);
  for (int i = 0; i < BOTH; i++) {
    e->of[ZP_WAY_TURNS][i] -= force * rate[i];
    e->of[i][ZP_WAY_TURNS] -= force * rate[i];
  }
  e->of[ZP_WAY_TURNS][ZP_WAY_TURNS] += force * zp_along(d, normal);
}

static void add_curved(double force, ZpVector direction, ZpVector d, const Reach *r, Entries *e) {
  turn_direction(force, direction, d, r, e);
  bend(force, direction, r, e);
}

static void add_directed_stiffness(const ZpLinks *links, size_t k, double share, const ZpPose *from, const ZpPose *to,
                                   bool still, ZpSparse *D) {
  const ZpLink *link = &network_of(links)->spring[k];
  const ZpArms *arms = &links->spring[k];
  const ZpVector d = apart_at(link->body, arms, to);
  const double before = link->rest + gap_of(links, k, from), after = link->rest + gap_of(links, k, to);
  const double part = still ? 1 : 0.5, factor = share * link->stiffness;
  const ZpPull pull = zp_link_pull(link, before, after, still);
  const Reach r = reach(link->body, arms, to);
  Entries e = {{{0}}};
  double facing_by[BOTH], beside_by[BOTH];
  const ZpVector normal = measured_by(link->body, arms, facing(link), to, &r, facing_by),
                 across = measured_by(link->body, arms, beside(link), to, &r, beside_by);
  add_product(share * pull.slope, facing_by, &e);
  add_curved(-part * share * pull.mean, normal, d, &r, &e);
  if (link->friction > 0) {
    const ZpFriction drag = friction_of(links, k, from, to);
    add_product(factor * drag.by_moved, beside_by, &e);
    add_products(factor * drag.by_gap, beside_by, facing_by, &e);
    add_curved(-part * factor * drag.mean, across, d, &r, &e);
  }
  put(links, link->body, &e, D);
}

static void add_spring_stiffness(const ZpLinks *links, size_t k, double share, const ZpPose *from, const ZpPose *to,
                                 bool still, ZpSparse *D) {
  const ZpLink *link = &network_of(links)->spring[k];
  if (is_directed(link)) {
    add_directed_stiffness(links, k, share, from, to, still, D);
    return;
  }
  const ZpVector d = apart_at(link->body, &links->spring[k], to);
  const double length = size_of(d), part = still ? 1 : 0.5;
  const ZpPull pull = zp_link_pull(link, size_of(apart_at(link->body, &links->spring[k], from)), length, still);
  if (length == 0) return;
  const ZpVector direction = zp_times(1 / length, d);
  const Reach r = reach(link->body, &links->spring[k], to);
  Entries e = {{{0}}};
  double by[BOTH];
  along(direction, &r, by);
  add_product(share * pull.slope, by, &e);
  bend(-part * share * pull.mean, direction, &r, &e);
  along(zp_across(direction), &r, by);
  add_product(part * share * pull.mean / length, by, &e);
  put(links, link->body, &e, D);
}

static void add_joint_stiffness(const ZpLinks *links, size_t k, const ZpPose *to, bool still, ZpSparse *D) {
  const ZpBodyJoint *joint = &network_of(links)->joint[k];
  const Reach r = reach(joint->body, &links->joint[k], to);
  const double part = still ? 1 : 0.5, *pull = still ? links->pull[k] : links->found[k];
  Entries e = {{{0}}};
  for (int c = 0; c < distances(joint); c++) {
    double by[BOTH];
    const ZpVector direction = missed_by(links, k, c, to, &r, by);
    const double force = part * pull[c];
    add_product(part * links->stiffness, by, &e);
    if (joint->type == ZP_JOINS_SLIDE)
      add_curved(force, direction, apart_at(joint->body, &links->joint[k], to), &r, &e);
    else
      bend(force, direction, &r, &e);
  }
  const double turns[BOTH] = {[ZP_WAY_TURNS] = -1, [ZP_WAYS + ZP_WAY_TURNS] = 1};
  if (joint->type != ZP_JOINS_PIN) add_product(part * torsion(links), turns, &e);
  put(links, joint->body, &e, D);
}

/* A constant force whose point turns with its body. */
static void add_constant_stiffness(const ZpLinks *links, size_t b, double share, const ZpPose *to, bool still,
                                   ZpSparse *D) {
  const ZpBody *body = &network_of(links)->body[b];
  const long turns = links->plane->body[b].unknown[ZP_WAY_TURNS];
  const ZpVector force = {body->force[0], body->force[1]};
  const double unit = links->plane->length * links->plane->length;
  if (turns < 0) return;
  *zp_sparse_at(D, (size_t)turns, (size_t)turns) +=
      (still ? 1 : 0.5) * share * zp_along(force, turned_by(&to[b], links->plane->body[b].place)) / unit;
}

void zp_links_add_stiffness(const ZpLinks *links, double share, const ZpPose *from, const ZpPose *to, bool still,
                            ZpSparse *D) {
  const ZpNetwork *network = network_of(links);
  for (size_t b = 0; b < network->bodies; b++)
    add_constant_stiffness(links, b, share, to, still, D);
  for (size_t k = 0; k < network->springs; k++)
    add_spring_stiffness(links, k, share, from, to, still, D);
  for (size_t k = 0; k < network->joints; k++)
    add_joint_stiffness(links, k, to, still, D);
}

/* -- joints under a step ---------------------------------------------------------------------------- */

void zp_links_predict(ZpLinks *links, const ZpPose *pose, const double *step, double fraction) {
  for (size_t k = 0; k < network_of(links)->joints; k++) {
    const ZpBodyJoint *joint = &network_of(links)->joint[k];
    const Reach r = reach(joint->body, &links->joint[k], pose);
    double change[BOTH], moves[ZP_PULLS] = {0};
    for (int i = 0; i < BOTH; i++)
      change[i] = fraction * zp_plane_change(links->plane, joint->body[i / ZP_WAYS], i % ZP_WAYS, links->inner, step);
    for (int c = 0; c < distances(joint); c++) {
      double by[BOTH];
      missed_by(links, k, c, pose, &r, by);
      for (int i = 0; i < BOTH; i++)
        moves[c] += by[i] * change[i];
    }
    if (joint->type != ZP_JOINS_PIN) moves[2] = change[ZP_WAYS + ZP_WAY_TURNS] - change[ZP_WAY_TURNS];
    for (int c = 0; c < ZP_PULLS; c++)
      links->pull[k][c] = links->found[k][c] - (c == 2 ? torsion(links) : links->stiffness) * moves[c];
  }
}

void zp_links_take(ZpLinks *links) {
  if (links->plane) memcpy(links->pull, links->found, network_of(links)->joints * sizeof *links->pull);
}

/* -- friction over a step ---------------------------------------------------------------------------- */

static bool rubs(const ZpLinks *links, size_t k) {
  return network_of(links)->spring[k].friction > 0;
}

void zp_links_hold(const ZpLinks *links, const ZpPose *pose, double *strain) {
  for (size_t k = 0; k < network_of(links)->springs; k++) {
    if (!rubs(links, k)) continue;
    const double most = zp_friction_bound(network_of(links)->spring[k].friction, gap_of(links, k, pose));
    strain[k] = fmin(fmax(shift(links, k, pose), -most), most);
  }
}

double zp_links_slide(const ZpLinks *links, const ZpPose *from, const ZpPose *to, double *strain) {
  double lost = 0;
  for (size_t k = 0; k < network_of(links)->springs; k++) {
    if (!rubs(links, k)) continue;
    const ZpFriction over = friction_of(links, k, from, to);
    strain[k] = over.end;
    lost += network_of(links)->spring[k].stiffness * over.lost;
  }
  return lost;
}

/* The way back of a motion over a span at constant acceleration; 0: it does not turn around. */
static double way_back(double moved, double rate, double h) {
  const double end = 2 * moved / h - rate;
  return rate * end < 0 ? 0.5 * h * end * end / fabs(rate - end) : 0;
}

void zp_links_add_overshoot(const ZpLinks *links, const ZpPose *from, const ZpPose *to, const double *rate, double h,
                            double *e) {
  for (size_t k = 0; k < network_of(links)->springs; k++) {
    const ZpLink *link = &network_of(links)->spring[k];
    if (!rubs(links, k) || friction_of(links, k, from, to).lost == 0) continue;
    const Reach r = reach(link->body, &links->spring[k], from);
    double by[BOTH], start = 0;
    measured_by(link->body, &links->spring[k], beside(link), from, &r, by);
    for (int i = 0; i < BOTH; i++)
      start += by[i] * zp_plane_change(links->plane, link->body[i / ZP_WAYS], i % ZP_WAYS, links->inner, rate);
    const double back = way_back(shift(links, k, to) - shift(links, k, from), start, h);
    for (int i = 0; i < BOTH; i++)
      zp_plane_push(links->plane, link->body[i / ZP_WAYS], i % ZP_WAYS, by[i] * back, links->inner, e);
  }
}

/* -- energy ---------------------------------------------------------------------------------------- */

static double energy_of_body(const ZpLinks *links, size_t b, const ZpPose *pose) {
  const ZpBody *body = &network_of(links)->body[b];
  const ZpPlaneBody *own = &links->plane->body[b];
  const ZpVector now = zp_pose_point(&pose[b], own->place), drawn = zp_pose_point(&own->drawn, own->place);
  const ZpVector force = {body->force[0], body->force[1]};
  return own->mass * links->plane->first->def.gravity * (pose[b].y - own->drawn.y) -
         zp_along(force, zp_difference(now, drawn)) - body->torque * pose[b].turn;
}

double zp_links_weight_energy(const ZpLinks *links, const ZpPose *pose) {
  const ZpNetwork *network = network_of(links);
  double sum = 0;
  for (size_t b = 0; b < network->bodies; b++)
    if (!network->body[b].held) sum += energy_of_body(links, b, pose);
  return sum;
}

static double length_of(const ZpLinks *links, size_t k, const ZpPose *pose) {
  const ZpLink *link = &network_of(links)->spring[k];
  return is_directed(link) ? link->rest + gap_of(links, k, pose)
                           : size_of(apart_at(link->body, &links->spring[k], pose));
}

double zp_links_energy(const ZpLinks *links, const ZpPose *pose, const double *strain) {
  const ZpNetwork *network = network_of(links);
  double sum = 0;
  for (size_t k = 0; k < network->springs; k++)
    sum += zp_link_energy(&network->spring[k], length_of(links, k, pose)) +
           0.5 * network->spring[k].stiffness * strain[k] * strain[k];
  for (size_t k = 0; k < network->joints; k++) {
    double by[ZP_PULLS];
    missed(links, k, pose, by);
    sum += 0.5 * (links->stiffness * (by[0] * by[0] + by[1] * by[1]) + torsion(links) * by[2] * by[2]);
  }
  return sum;
}

/* -- weight of ribbons ----------------------------------------------------------------------------- */

/* Gravity as a member sees it, m/s2, and how that changes as its frame turns. */
typedef struct Gravity {
  ZpVector down, turned; /* 1/rad of the latter */
} Gravity;

static Gravity gravity_in(const ZpLinks *links, size_t member, const ZpPose *pose) {
  const ZpVector axis = zp_stand_axis(&links->plane->stand[member], pose);
  const ZpVector down = zp_turned_back(axis, (ZpVector){0, -links->plane->first->def.gravity});
  return (Gravity){down, zp_times(-1, zp_across(down))};
}

void zp_links_add_weight(const ZpLinks *links, size_t member, double share, const ZpPose *pose, const ZpAssembly *a,
                         const double *nodes, double *r) {
  const ZpModel *model = links->plane->first + member;
  const ZpStand *stand = &links->plane->stand[member];
  const ZpNodes at = zp_nodes(model, nodes);
  const Gravity g = gravity_in(links, member, pose);
  const double gravity = model->def.gravity;
  for (size_t j = 0; j < model->count; j++) {
    const double mass = share * model->mass[j];
    if (zp_is_of_platform(&model->topology, j)) continue;
    zp_assembly_add_one(a, zp_x_of(j), mass * g.down.x, r);
    zp_assembly_add_one(a, zp_y_of(j), mass * g.down.y, r);
    if (stand->still) continue;
    const ZpVector point = zp_stand_outside(stand, pose, (ZpVector){at.x[j], at.y[j]});
    zp_plane_push(links->plane, stand->upper, ZP_WAY_UP, -mass * gravity, links->inner, r);
    add_torque(links, stand->upper, -mass * gravity * (point.x - pose[stand->upper].x), r);
  }
}

void zp_links_add_weight_stiffness(const ZpLinks *links, size_t member, double share, const ZpPose *pose,
                                   const ZpAssembly *a, const double *nodes, ZpBand *K) {
  const ZpModel *model = links->plane->first + member;
  const ZpStand *stand = &links->plane->stand[member];
  const ZpNodes at = zp_nodes(model, nodes);
  const Gravity g = gravity_in(links, member, pose);
  const int turns = zp_plane_border(links->plane, member, true, ZP_WAY_TURNS, a);
  const double unit = links->plane->length;
  if (turns < 0) return;
  for (size_t j = 0; j < model->count; j++) {
    const double mass = share * model->mass[j];
    if (zp_is_of_platform(&model->topology, j)) continue;
    const ZpVector point = zp_stand_outside(stand, pose, (ZpVector){at.x[j], at.y[j]});
    *zp_band_entry(K, (size_t)a->place[zp_x_of(j)], (size_t)turns) -= mass * g.turned.x / unit;
    *zp_band_entry(K, (size_t)a->place[zp_y_of(j)], (size_t)turns) -= mass * g.turned.y / unit;
    *zp_band_entry(K, (size_t)turns, (size_t)turns) -=
        mass * model->def.gravity * (point.y - pose[stand->upper].y) / (unit * unit);
  }
}

double zp_links_ribbons_energy(const ZpLinks *links, size_t member, const ZpPose *pose, const double *nodes) {
  const ZpModel *model = links->plane->first + member;
  const ZpTopology *t = &model->topology;
  const ZpStand *stand = &links->plane->stand[member];
  const ZpNodes at = zp_nodes(model, nodes);
  double sum = 0;
  for (size_t j = 0; j < model->count; j++) {
    const size_t station = j / t->ribbons;
    if (zp_is_of_platform(t, j)) continue;
    const double drawn = stand->axis.y * (zp_straight_x(model, station) - stand->middle);
    sum +=
        model->mass[j] * model->def.gravity * (zp_stand_outside(stand, pose, (ZpVector){at.x[j], at.y[j]}).y - drawn);
  }
  return sum;
}
