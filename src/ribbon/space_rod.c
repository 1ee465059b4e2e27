/* Letters of docs/theory.md, section 41. */
#include "ribbon/space_rod.h"

#include <string.h>

#include "ribbon/space_angle.h"

/* -- points ---------------------------------------------------------------------------------------- */

/* A joint at a held slope and the next one, over 1.5 elements: curvatures at both from their turns, eq. (8.9), and the
 * weights of (8.11), which are those of bending alone; twist counts over half an element and over a whole one. */
static size_t add_held(size_t held, size_t next, double l, ZpSpacePoint *point) {
  static const double of_held[] = {12.0 / 47 * 12, -12.0 / 47}, of_next[] = {-12.0 / 47, 12.0 / 47 * 4};
  static const struct {
    double weight, part; /* of the way from the held joint to the next */
    int twists;          /* number of the joint, from 1 */
  } of[] = {{0.5, 0, 1}, {-0.25, 0, 0}, {1.0 / 3, 0.5, 0}, {1, 1, 2}, {-1.0 / 12, 1, 0}};
  for (size_t k = 0; k < sizeof of / sizeof of[0]; k++) {
    const double part = of[k].part;
    point[k] = (ZpSpacePoint){.weight = of[k].weight * l, .joints = 2, .joint = {held, next}};
    for (size_t j = 0; j < 2; j++)
      point[k].bend[j] = ((1 - part) * of_held[j] + part * of_next[j]) / l;
    point[k].twist[0] = of[k].twists == 1 ? 2 / l : 0;
    point[k].twist[1] = of[k].twists == 2 ? 1 / l : 0;
  }
  return sizeof of / sizeof of[0];
}

void zp_space_points(ZpSpaceRodParams *p, const bool held[2], bool flat, ZpSpacePoint *point, ZpSpaceWarp *warp) {
  const size_t last = p->nodes - 1, first_free = held[0] ? 2 : 1, last_free = held[1] ? last - 2 : last - 1;
  const double l = p->l;
  size_t points = 0, warps = 0;
  if (held[0]) points += add_held(0, 1, l, point);
  for (size_t j = first_free; j <= last_free; j++)
    point[points++] = (ZpSpacePoint){.weight = l, .joints = 1, .joint = {j}, .bend = {1 / l}, .twist = {1 / l}};
  if (held[1]) points += add_held(last, last - 1, l, point + points);
  for (size_t j = 1; j < last - 1; j++)
    warp[warps++] = (ZpSpaceWarp){.length = l, .joints = 2, .joint = {j, j + 1}, .twist = {-1 / l, 1 / l}};
  for (int end = 0; end < 2 && flat; end++) {
    if (!held[end]) continue;
    const size_t at = end == 0 ? 0 : last, next = end == 0 ? 1 : last - 1;
    warp[warps++] = (ZpSpaceWarp){.length = 0.75 * l, .joints = 2, .joint = {at, next}, .twist = {-2 / l, 1 / l}};
    warp[warps++] = (ZpSpaceWarp){.length = 0.25 * l, .joints = 1, .joint = {at}, .twist = {2 / l}};
  }
  p->points = points;
  p->warps = warps;
  p->point = point;
  p->warp = warp;
}

const double zp_space_along_x[3] = {1, 0, 0};

/* -- places ---------------------------------------------------------------------------------------- */

void zp_space_place(const ZpSpaceRodParams *p, ZpSpaceRod *rod, const double *angle) {
  for (size_t i = 0; i + 1 < p->nodes; i++) {
    const double vector[3] = {rod->at[i + 1][0] - rod->at[i][0], rod->at[i + 1][1] - rod->at[i][1],
                              rod->at[i + 1][2] - rod->at[i][2]};
    rod->edge[i + 1] = zp_space_move(&rod->edge[i + 1], vector, angle ? angle[i] : 0);
  }
}

/* Unknowns that the directions of a joint's derivatives are: positions of three nodes and angles of two edges. */
enum { OF_JOINT = 11 };

/* Derivatives by the vectors of the edges and by their angles => by the unknowns from 4 (j - 1) on. */
static void by_unknowns(const double by[ZP_SPACE_WAYS], double out[3 * ZP_SPACE_OF_NODE]) {
  for (int i = 0; i < 3; i++) {
    out[i] = -by[ZP_SPACE_BEFORE + i];
    out[ZP_SPACE_OF_NODE + i] = by[ZP_SPACE_BEFORE + i] - by[ZP_SPACE_AFTER + i];
    out[2 * ZP_SPACE_OF_NODE + i] = by[ZP_SPACE_AFTER + i];
  }
  out[3] = by[ZP_SPACE_ANGLE_BEFORE];
  out[ZP_SPACE_OF_NODE + 3] = by[ZP_SPACE_ANGLE_AFTER];
  out[2 * ZP_SPACE_OF_NODE + 3] = 0;
}

enum { WIDE = 3 * ZP_SPACE_OF_NODE };

/* Add a vector of a joint's unknowns; what is beyond the ends is held. */
static void scatter(const ZpSpaceRodParams *p, size_t joint, const double by[ZP_SPACE_WAYS], double *gradient) {
  double wide[WIDE];
  by_unknowns(by, wide);
  const long first = ZP_SPACE_OF_NODE * ((long)joint - 1), end = (long)(ZP_SPACE_OF_NODE * p->nodes);
  for (long i = 0; i < WIDE; i++)
    if (first + i >= 0 && first + i < end) gradient[first + i] += wide[i];
}

double zp_space_factor(const ZpSpacePoint *point, size_t j, int strain) {
  return strain == ZP_SPACE_TWIST ? point->twist[j] : point->bend[j];
}

void zp_space_curvatures(const ZpSpaceRodParams *p, const ZpSpaceRod *rod, const ZpSpacePoint *point,
                         double k[ZP_SPACE_STRAINS]) {
  const bool twists = point->twist[0] != 0 || point->twist[1] != 0;
  for (int s = 0; s < ZP_SPACE_STRAINS; s++) {
    k[s] = s == ZP_SPACE_TWIST && !twists ? 0 : -p->natural[s];
    for (size_t j = 0; j < point->joints; j++)
      k[s] += zp_space_factor(point, j, s) * rod->joint[point->joint[j]].strain[s];
  }
}

static ZpSpaceLaw law_at(const ZpSpaceRodParams *p, const ZpSpaceRod *rod, const ZpSpacePoint *point) {
  double k[ZP_SPACE_STRAINS];
  zp_space_curvatures(p, rod, point, k);
  return zp_space_law(&p->section, k[0], k[1], k[2]);
}

double zp_space_warped(const ZpSpaceRod *rod, const ZpSpaceWarp *warp) {
  double twist = 0;
  for (size_t j = 0; j < warp->joints; j++)
    twist += warp->twist[j] * rod->joint[warp->joint[j]].strain[ZP_SPACE_TWIST];
  return twist;
}

/* Directions of a joint's derivatives along which nothing moves: those of a held slope. */
static bool is_held_way(const ZpSpaceRodParams *p, size_t joint, int way) {
  const bool before = way < ZP_SPACE_AFTER || way == ZP_SPACE_ANGLE_BEFORE;
  return before ? joint == 0 : joint + 1 == p->nodes;
}

/* Derivatives of a joint, by angles that are counted as those of the rod are. */
static void count_joint(const ZpSpaceRodParams *p, const ZpSpaceRod *rod, size_t j, bool second) {
  if (!p->from) return;
  const ZpSpaceAngle before = zp_space_angle(p->from, &rod->edge[j]),
                     after = zp_space_angle(p->from, &rod->edge[j + 1]);
  if (second)
    zp_space_count_joint_second(&before, &after, &rod->joint[j]);
  else
    zp_space_count_joint(&before, &after, &rod->joint[j]);
}

void zp_space_turn_joints(const ZpSpaceRodParams *p, ZpSpaceRod *rod) {
  for (size_t j = 0; j < p->nodes; j++) {
    ZpSpaceJoint *joint = &rod->joint[j];
    zp_space_joint(&rod->edge[j], &rod->edge[j + 1], joint);
    count_joint(p, rod, j, false);
    memset(joint->moment, 0, sizeof joint->moment);
    memset(joint->stiffness, 0, sizeof joint->stiffness);
    for (int way = 0; way < ZP_SPACE_WAYS; way++)
      for (int s = 0; s < ZP_SPACE_STRAINS && is_held_way(p, j, way); s++)
        joint->gradient[s][way] = 0;
  }
}

static void turn_joints_twice(const ZpSpaceRodParams *p, ZpSpaceRod *rod) {
  for (size_t j = 0; j < p->nodes; j++) {
    ZpSpaceJoint *joint = &rod->joint[j];
    zp_space_joint_second(&rod->edge[j], &rod->edge[j + 1], joint);
    count_joint(p, rod, j, true);
    for (int a = 0; a < ZP_SPACE_WAYS; a++)
      for (int b = 0; b < ZP_SPACE_WAYS && is_held_way(p, j, a); b++)
        for (int s = 0; s < ZP_SPACE_STRAINS; s++)
          joint->second[s][a][b] = joint->second[s][b][a] = 0;
  }
}

/* Energy of what a point or a warp stores; the moments and the stiffness of each joint by its own strains. */
static double add_points(const ZpSpaceRodParams *p, ZpSpaceRod *rod) {
  double sum = 0;
  for (const ZpSpacePoint *point = p->point; point < p->point + p->points; point++) {
    const ZpSpaceLaw law = law_at(p, rod, point);
    sum += point->weight * law.W;
    for (size_t j = 0; j < point->joints; j++) {
      ZpSpaceJoint *joint = &rod->joint[point->joint[j]];
      for (int s = 0; s < ZP_SPACE_STRAINS; s++) {
        const double by = point->weight * zp_space_factor(point, j, s);
        joint->moment[s] += by * law.moment[s];
        for (int r = 0; r < ZP_SPACE_STRAINS; r++)
          joint->stiffness[s][r] += by * zp_space_factor(point, j, r) * law.stiffness[s][r];
      }
    }
  }
  for (const ZpSpaceWarp *warp = p->warp; warp < p->warp + p->warps; warp++) {
    const double twist = zp_space_warped(rod, warp), D = p->section.D / warp->length;
    sum += 0.5 * D * twist * twist;
    for (size_t j = 0; j < warp->joints; j++) {
      ZpSpaceJoint *joint = &rod->joint[warp->joint[j]];
      joint->moment[ZP_SPACE_TWIST] += D * twist * warp->twist[j];
      joint->stiffness[ZP_SPACE_TWIST][ZP_SPACE_TWIST] += D * warp->twist[j] * warp->twist[j];
    }
  }
  return sum;
}

double zp_space_energy(const ZpSpaceRodParams *p, ZpSpaceRod *rod, double *gradient) {
  double sum = 0;
  if (gradient) memset(gradient, 0, ZP_SPACE_OF_NODE * p->nodes * sizeof *gradient);
  zp_space_turn_joints(p, rod);
  sum += add_points(p, rod);
  for (size_t i = 0; i + 1 < p->nodes; i++) {
    const ZpSpaceEdge *edge = &rod->edge[i + 1];
    const double longer = edge->length - p->l, T = p->S * longer;
    sum += 0.5 * T * longer;
    for (int c = 0; c < 3 && gradient; c++) {
      gradient[ZP_SPACE_OF_NODE * i + (size_t)c] -= T * edge->t[c];
      gradient[ZP_SPACE_OF_NODE * (i + 1) + (size_t)c] += T * edge->t[c];
    }
  }
  for (size_t j = 0; j < p->nodes && gradient; j++) {
    const ZpSpaceJoint *joint = &rod->joint[j];
    double by[ZP_SPACE_WAYS] = {0};
    for (int s = 0; s < ZP_SPACE_STRAINS; s++)
      for (int way = 0; way < ZP_SPACE_WAYS; way++)
        by[way] += joint->moment[s] * joint->gradient[s][way];
    scatter(p, j, by, gradient);
  }
  return sum;
}

/* -- stiffness ------------------------------------------------------------------------------------- */

static void add_entry(const ZpSpaceRodParams *p, long i, long j, double value, double *K) {
  const long end = (long)(ZP_SPACE_OF_NODE * p->nodes);
  if (i < 0 || j < 0 || i >= end || j >= end || i > j) return;
  K[i * (ZP_SPACE_BAND + 1) + j - i] += value;
}

/* K += factor (a b' + b a'), of the unknowns of two joints. */
static void add_product(const ZpSpaceRodParams *p, size_t ja, const double a[ZP_SPACE_WAYS], size_t jb,
                        const double b[ZP_SPACE_WAYS], double factor, double *K) {
  const long fa = ZP_SPACE_OF_NODE * ((long)ja - 1), fb = ZP_SPACE_OF_NODE * ((long)jb - 1);
  double left[WIDE], right[WIDE];
  by_unknowns(a, left);
  by_unknowns(b, right);
  for (long i = 0; i < WIDE; i++)
    for (long j = 0; left[i] != 0 && j < WIDE; j++) {
      const long one = fa + i, other = fb + j;
      const double both = factor * left[i] * right[j];
      add_entry(p, one < other ? one : other, one < other ? other : one, one == other ? 2 * both : both, K);
    }
}

/* Second derivatives of the energy by the directions of a joint, with this moment about the normal. */
static void second_of(const ZpSpaceJoint *joint, double sway, double H[ZP_SPACE_WAYS][ZP_SPACE_WAYS]) {
  for (int a = 0; a < ZP_SPACE_WAYS; a++)
    for (int b = 0; b < ZP_SPACE_WAYS; b++)
      H[a][b] = joint->moment[0] * joint->second[0][a][b] + sway * joint->second[1][a][b] +
                joint->moment[2] * joint->second[2][a][b];
  for (int s = 0; s < ZP_SPACE_STRAINS; s++) {
    double by[ZP_SPACE_WAYS];
    for (int b = 0; b < ZP_SPACE_WAYS; b++)
      by[b] = joint->stiffness[s][0] * joint->gradient[0][b] + joint->stiffness[s][1] * joint->gradient[1][b] +
              joint->stiffness[s][2] * joint->gradient[2][b];
    for (int a = 0; a < ZP_SPACE_WAYS; a++)
      for (int b = 0; b < ZP_SPACE_WAYS; b++)
        H[a][b] += joint->gradient[s][a] * by[b];
  }
}

static void add_joint(const ZpSpaceRodParams *p, const ZpSpaceRod *rod, size_t joint, double *K) {
  double H[ZP_SPACE_WAYS][ZP_SPACE_WAYS], rows[ZP_SPACE_WAYS][WIDE], column[ZP_SPACE_WAYS], whole[WIDE];
  second_of(&rod->joint[joint], rod->sway ? rod->sway[joint] : rod->joint[joint].moment[ZP_SPACE_SWAY], H);
  for (int w = 0; w < ZP_SPACE_WAYS; w++)
    by_unknowns(H[w], rows[w]);
  const long first = ZP_SPACE_OF_NODE * ((long)joint - 1);
  for (long j = 0; j < WIDE; j++) {
    for (int w = 0; w < ZP_SPACE_WAYS; w++)
      column[w] = rows[w][j];
    by_unknowns(column, whole);
    for (long i = 0; i <= j; i++)
      add_entry(p, first + i, first + j, whole[i], K);
  }
}

/* Change of a joint's strain of sway. */
static double swayed(const ZpSpaceRodParams *p, const ZpSpaceRod *rod, size_t joint, const double *step) {
  double wide[WIDE], sum = 0;
  by_unknowns(rod->joint[joint].gradient[ZP_SPACE_SWAY], wide);
  const long first = ZP_SPACE_OF_NODE * ((long)joint - 1), end = (long)(ZP_SPACE_OF_NODE * p->nodes);
  for (long i = 0; i < WIDE; i++)
    if (first + i >= 0 && first + i < end) sum += wide[i] * step[first + i];
  return sum;
}

void zp_space_sway_changes(const ZpSpaceRodParams *p, const ZpSpaceRod *rod, const double *step, double *change) {
  memset(change, 0, p->nodes * sizeof *change);
  for (const ZpSpacePoint *point = p->point; point < p->point + p->points; point++) {
    double curvature = 0;
    for (size_t j = 0; j < point->joints; j++)
      curvature += point->bend[j] * swayed(p, rod, point->joint[j], step);
    for (size_t j = 0; j < point->joints; j++)
      change[point->joint[j]] += point->weight * point->bend[j] * p->section.B2 * curvature;
  }
}

static void stretching(const ZpSpaceRodParams *p, const ZpSpaceRod *rod, double *K) {
  for (size_t i = 0; i + 1 < p->nodes; i++) {
    const ZpSpaceEdge *edge = &rod->edge[i + 1];
    const double T = (rod->tension ? rod->tension[i] : p->S * (edge->length - p->l)) / edge->length;
    const long at = (long)(ZP_SPACE_OF_NODE * i);
    for (long a = 0; a < 3; a++)
      for (long b = 0; b < 3; b++) {
        const double k = (p->S - T) * edge->t[a] * edge->t[b] + (a == b ? T : 0);
        add_entry(p, at + a, at + b, k, K);
        add_entry(p, at + ZP_SPACE_OF_NODE + a, at + ZP_SPACE_OF_NODE + b, k, K);
        add_entry(p, at + a, at + ZP_SPACE_OF_NODE + b, -k, K);
      }
  }
}

/* Between two joints: of points that both bend, and of warping. */
static void add_between(const ZpSpaceRodParams *p, const ZpSpaceRod *rod, double *K) {
  for (const ZpSpacePoint *point = p->point; point < p->point + p->points; point++) {
    if (point->joints < 2) continue;
    const ZpSpaceLaw law = law_at(p, rod, point);
    const size_t a = point->joint[0], b = point->joint[1];
    for (int s = 0; s < ZP_SPACE_STRAINS; s++)
      for (int r = 0; r < ZP_SPACE_STRAINS; r++) {
        const double factor =
            point->weight * zp_space_factor(point, 0, s) * zp_space_factor(point, 1, r) * law.stiffness[s][r];
        if (factor != 0) add_product(p, a, rod->joint[a].gradient[s], b, rod->joint[b].gradient[r], factor, K);
      }
  }
  for (const ZpSpaceWarp *warp = p->warp; warp < p->warp + p->warps; warp++) {
    if (warp->joints < 2 || p->section.D == 0) continue;
    const size_t a = warp->joint[0], b = warp->joint[1];
    add_product(p, a, rod->joint[a].gradient[ZP_SPACE_TWIST], b, rod->joint[b].gradient[ZP_SPACE_TWIST],
                p->section.D / warp->length * warp->twist[0] * warp->twist[1], K);
  }
}

void zp_space_stiffness(const ZpSpaceRodParams *p, ZpSpaceRod *rod, double *K) {
  turn_joints_twice(p, rod);
  stretching(p, rod, K);
  for (size_t j = 0; j < p->nodes; j++)
    add_joint(p, rod, j, K);
  add_between(p, rod, K);
}
