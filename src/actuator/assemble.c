/* Where all coordinates near a station are free, their equations are consecutive and entries have fixed places: rows
 * are written directly there. Near held and joined nodes each entry looks up its equations. */
#include "actuator/assemble.h"

#include <stdint.h>
#include <string.h>

#include "base/kernel.h"
#include "def/check.h"

static size_t least(size_t a, size_t b) {
  return a < b ? a : b;
}

/* The first coordinate of a member that always moves as this one: itself, or one that is tied to the same. */
static size_t leader_of(const ZpTies *ties, const ZpTie *tie) {
  const ZpTie *first = ties->tie;
  if (tie->to_member == ties->member) return tie->to;
  while (first->to_member != tie->to_member || first->to != tie->to)
    first++;
  return first->coordinate;
}

/* Station by station: coordinates of its nodes, then unknowns of the laws. */
static size_t number(const ZpTies *ties, ZpAssembly *a) {
  int next = 0;
  for (size_t i = 0; i < a->nodes; i++) {
    for (size_t k = 2 * a->s * i; k < 2 * a->s * (i + 1); k++) {
      const ZpTie *tie = zp_tie_of(ties, k);
      size_t leader = tie ? leader_of(ties, tie) : k;
      a->factor[k] = tie ? tie->factor : 1;
      a->offset[k] = tie ? tie->offset : 0;
      a->equation[k] = a->factor[k] == 0 ? -1 : leader < k ? a->equation[leader] : next++;
    }
    for (size_t c = 0; c < a->own; c++)
      a->extra_equation[a->own * i + c] = next++;
  }
  return (size_t)next;
}

/* Two halves that mirror each other have in common what a row ties across their platform, eq. (19.1). No row does so
 * where the platform turns: the whole is then one part. */
static void find_parts(const ZpTies *ties, ZpAssembly *a) {
  ZpParts *parts = &a->parts;
  for (const ZpTie *tie = ties->tie; tie < ties->tie + ties->count; tie++) {
    if (tie->factor == 0) continue;
    if (leader_of(ties, tie) / (2 * a->s) != tie->coordinate / (2 * a->s))
      parts->common[parts->count++] = (size_t)a->equation[tie->coordinate];
  }
  parts->more = parts->count > 0;
}

/* Number of equations of a station whose coordinates are free. */
static size_t per_station(const ZpAssembly *a) {
  return 2 * a->s + a->own;
}

/* The equation of the first coordinate of station i, if those of stations i .. i + 2 all follow it; else -1. */
static int first_of(const ZpAssembly *a, size_t i) {
  if (i + 2 >= a->nodes) return -1;
  int first = a->equation[2 * a->s * i];
  for (size_t m = 0; m < 3; m++)
    for (size_t c = 0; c < 2 * a->s; c++)
      if (first < 0 || a->equation[2 * a->s * (i + m) + c] != first + (int)(m * per_station(a) + c)) return -1;
  return first;
}

/* Smallest (sign -1) or largest equation of stations i .. end - 1; -1: they have none. */
static int outermost(const ZpAssembly *a, size_t i, size_t end, int sign) {
  int most = -1;
  for (size_t k = 2 * a->s * i; k < 2 * a->s * least(end, a->nodes); k++)
    if (a->equation[k] >= 0 && (most < 0 || sign * a->equation[k] > sign * most)) most = a->equation[k];
  return most;
}

static size_t wider(size_t width, int first, int last) {
  return last - first > (int)width ? (size_t)(last - first) : width;
}

/* Coordinates of a station couple to those of the next two, unknowns of the laws to all of the next station. */
static size_t bandwidth_of(const ZpAssembly *a) {
  size_t width = 2 * per_station(a) - 1;
  for (size_t i = 0; i < a->nodes; i++) {
    int first = outermost(a, i, i + 1, -1);
    if (first < 0) continue;
    width = wider(width, first, outermost(a, i, i + 3, 1));
    if (a->own > 0) width = wider(width, first, a->extra_equation[a->own * least(i + 2, a->nodes) - 1]);
  }
  return width;
}

/* Each station couples to the next two. With two ribbons it is a group of four equations, with one ribbon half a group,
 * unless held or joined nodes shift them. */
static ZpBandGroups groups_of(const ZpAssembly *a) {
  ZpBandGroups groups = {0, a->s + 1};
  size_t i = 0;
  while (i < a->nodes && a->first[i] < 0)
    i++;
  if (!a->symmetric || a->own > 0 || i == a->nodes) return (ZpBandGroups){0, 0};
  groups.lead = (ZP_BAND_BLOCK - (size_t)a->first[i] % ZP_BAND_BLOCK) % ZP_BAND_BLOCK;
  for (i = 0; i < a->nodes; i++) {
    int first = outermost(a, i, i + 1, -1), last = outermost(a, i, i + 3, 1);
    if (first < 0) continue;
    size_t begin = ((size_t)first + groups.lead) / ZP_BAND_BLOCK, end = ((size_t)last + groups.lead) / ZP_BAND_BLOCK;
    if (end - begin >= groups.reach) return (ZpBandGroups){0, 0};
  }
  return groups;
}

bool zp_assembly_create(const ZpTies *ties, size_t own, bool symmetric, ZpAssembly *a) {
  const ZpModel *model = ties->first + ties->member;
  *a = (ZpAssembly){.s = model->s,
                    .nodes = model->nodes,
                    .count = model->count,
                    .stride = model->stride,
                    .own = own,
                    .symmetric = symmetric};
  a->equation = zp_calloc(2 * model->count, sizeof *a->equation);
  a->first = zp_calloc(model->nodes, sizeof *a->first);
  a->extra_equation = zp_calloc(model->nodes, (own + 1) * sizeof *a->extra_equation);
  a->factor = zp_calloc(2 * model->count, sizeof *a->factor);
  a->offset = zp_calloc(2 * model->count, sizeof *a->offset);
  a->parts.common = zp_calloc(ZP_MOST_TIES, sizeof *a->parts.common);
  if (!a->equation || !a->first || !a->extra_equation || !a->factor || !a->offset || !a->parts.common) {
    zp_assembly_destroy(a);
    return false;
  }
  a->n = number(ties, a);
  a->bandwidth = bandwidth_of(a);
  find_parts(ties, a);
  for (size_t i = 0; i < model->nodes; i++)
    a->first[i] = first_of(a, i);
  a->groups = groups_of(a);
  return true;
}

/* -- several members ------------------------------------------------------------------------------- */

/* Of each member alone: how many equations it has, how many that are not shared the members before it have, and which
 * of its equations are tied to which shared coordinates. */
typedef struct Joined {
  size_t members, count[ZP_MOST_MEMBERS], before[ZP_MOST_MEMBERS];
  size_t ties[ZP_MOST_MEMBERS], tied[ZP_MOST_MEMBERS][2], to[ZP_MOST_MEMBERS][2];
  size_t shared;
  bool border;
  size_t inner; /* equations that are not shared */
} Joined;

/* How many equations of all members, in the order of their numbers, come before this one. */
static size_t before(const Joined *of, size_t which, size_t own) {
  size_t sum = 0;
  for (size_t k = 0; k < of->members; k++)
    sum += least(own + (k < which), of->count[k] - of->ties[k]);
  return sum;
}

/* Of two halves, which end at the platform, the second one can follow from there back to its clip. */
static bool alternate(const Joined *of) {
  return of->members > 2 || of->tied[0][0] < of->count[0] - of->ties[0];
}

/* An equation of one member alone => of all. With a border, those of each member follow those of the one before, and
 * the shared ones follow all. Without one, those of the second of two halves follow from its platform back to its clip,
 * behind the shared one, so that the matrix stays a narrow band; else those of the same number are adjacent, with the
 * shared ones among those of the platform. */
static size_t place_of(const Joined *of, size_t which, size_t i) {
  const size_t first = of->tied[0][0];
  size_t own = i; /* its number among those that are not shared */
  for (size_t k = 0; k < of->ties[which]; k++) {
    if (of->tied[which][k] == i && of->border) return of->inner + of->to[which][k];
    if (of->tied[which][k] == i) return alternate(of) ? before(of, 0, first) + of->to[which][k] : first;
    own -= of->tied[which][k] < i;
  }
  if (of->border || !of->shared) return of->before[which] + own;
  if (alternate(of)) return before(of, which, own) + (own < first ? 0 : of->shared);
  return which == 1 ? of->inner - own : i;
}

/* The largest distance between the equations of two stations that couple. */
static size_t reach_of(const ZpAssembly *a) {
  size_t most = 0;
  for (size_t i = 0; i < a->nodes; i++) {
    int first = outermost(a, i, i + 3, -1);
    if (first >= 0) most = wider(most, first, outermost(a, i, i + 3, 1));
  }
  return most;
}

/* Number the equations of one member among those of all, `n`. */
static void join(ZpAssembly *a, const Joined *of, size_t which, size_t n) {
  a->joined = of->shared > 0;
  a->shared = of->border ? of->shared : 0;
  a->n = n;
  a->groups = (ZpBandGroups){0, 0};
  for (size_t k = 0; k < a->parts.count; k++)
    a->parts.common[k] = place_of(of, which, a->parts.common[k]);
  for (size_t k = 0; k < 2 * a->count; k++)
    if (a->equation[k] >= 0) a->equation[k] = (int)place_of(of, which, (size_t)a->equation[k]);
  for (size_t c = 0; c < a->own * a->nodes; c++)
    a->extra_equation[c] = (int)place_of(of, which, (size_t)a->extra_equation[c]);
  for (size_t i = 0; i < a->nodes; i++)
    a->first[i] = first_of(a, i);
}

/* Note that an equation of a member alone is a shared one, the next one if none is known of it. */
static size_t note(const ZpAssembly *a, size_t member, size_t coordinate, size_t shared, Joined *of) {
  size_t equation = (size_t)a->equation[coordinate], *ties = &of->ties[member];
  for (size_t k = 0; k < *ties; k++)
    if (of->tied[member][k] == equation) return of->to[member][k];
  of->tied[member][*ties] = equation;
  of->to[member][(*ties)++] = shared;
  if (shared == of->shared) of->shared++;
  return shared;
}

size_t zp_assembly_join(ZpAssembly *const a[], const ZpModel *first, size_t members, bool border) {
  Joined of = {.members = members, .border = border};
  for (size_t member = 0; first && member < members; member++) {
    const ZpTies ties = zp_ties_of(first, members, member);
    for (const ZpTie *t = ties.tie; t < ties.tie + ties.count; t++)
      if (t->to_member != member) {
        size_t shared = note(a[t->to_member], t->to_member, t->to, of.shared, &of);
        note(a[member], member, t->coordinate, shared, &of);
      }
  }
  size_t n = 0, bandwidth = a[0]->bandwidth;
  for (size_t which = 0; which < members; which++) {
    of.before[which] = n;
    of.count[which] = a[which]->n;
    n += a[which]->n - of.ties[which];
  }
  of.inner = n;
  for (size_t which = 0; which < members; which++) {
    join(a[which], &of, which, n + of.shared);
    if (of.shared && !border && reach_of(a[which]) > bandwidth) bandwidth = reach_of(a[which]);
  }
  return bandwidth;
}

void zp_assembly_destroy(ZpAssembly *a) {
  zp_free(a->equation);
  zp_free(a->first);
  zp_free(a->extra_equation);
  zp_free(a->factor);
  zp_free(a->offset);
  zp_free(a->parts.common);
  *a = (ZpAssembly){0};
}

/* -- values ----------------------------------------------------------------------------------------- */

void zp_assembly_gather(const ZpAssembly *a, const double *nodes, double *equations) {
  for (size_t j = 0; j < a->count; j++)
    for (size_t c = 0; c < 2; c++) {
      size_t k = 2 * j + c;
      if (a->equation[k] >= 0) equations[a->equation[k]] = a->factor[k] * nodes[j + c * a->stride];
    }
}

void zp_assembly_place(const ZpAssembly *a, const double *equations, double *nodes) {
  for (size_t j = 0; j < a->count; j++)
    for (size_t c = 0; c < 2; c++) {
      size_t k = 2 * j + c;
      if (a->equation[k] >= 0) nodes[j + c * a->stride] = zp_assembly_position(a, k, equations);
    }
}

void zp_assembly_changes(const ZpAssembly *a, const double *restrict step, double *restrict nodes) {
  const int *equation = a->equation;
  const double *factor = a->factor;
  double *x = nodes, *y = nodes + a->stride;
  for (size_t j = 0; j < a->count; j++) {
    int of_x = equation[2 * j], of_y = equation[2 * j + 1];
    x[j] = of_x >= 0 ? factor[2 * j] * step[of_x] : 0;
    y[j] = of_y >= 0 ? factor[2 * j + 1] * step[of_y] : 0;
  }
}

void zp_assembly_add_one(const ZpAssembly *a, size_t k, double force, double *equations) {
  if (a->equation[k] >= 0) equations[a->equation[k]] += a->factor[k] * force;
}

void zp_assembly_add(const ZpAssembly *a, const double *restrict nodes, double *restrict equations) {
  const int *equation = a->equation;
  const double *factor = a->factor, *x = nodes, *y = nodes + a->stride;
  for (size_t j = 0; j < a->count; j++) {
    int of_x = equation[2 * j], of_y = equation[2 * j + 1];
    if (of_x >= 0) equations[of_x] += factor[2 * j] * x[j];
    if (of_y >= 0) equations[of_y] += factor[2 * j + 1] * y[j];
  }
}

void zp_assembly_sum(const ZpAssembly *a, const double *nodes, double *equations) {
  memset(equations, 0, a->n * sizeof *equations);
  zp_assembly_add(a, nodes, equations);
}

void zp_assembly_add_masses(const ZpAssembly *a, const double *mass, double *equations) {
  for (size_t k = 0; k < 2 * a->count; k++)
    if (a->equation[k] >= 0) equations[a->equation[k]] += mass[k / 2];
}

/* -- one entry, anywhere ---------------------------------------------------------------------------- */

/* Of members of a system: in the border, or by a coordinate that another one ties. */
static __attribute__((noinline)) void add_joined(const ZpAssembly *a, size_t row, size_t column, double value,
                                                 ZpBand *K) {
  size_t i = (size_t)a->equation[row], j = (size_t)a->equation[column];
  *zp_band_entry(K, i, j) += a->factor[row] * a->factor[column] * value;
}

ZP_INLINE void add(const ZpAssembly *a, size_t row, size_t column, double value, ZpBand *K) {
  int i = a->equation[row], j = a->equation[column];
  if (i < 0 || j < 0 || (a->symmetric && i > j)) return;
  if (a->joined)
    add_joined(a, row, column, value, K);
  else
    *zp_band_at(K, (size_t)i, (size_t)j) += value;
}

/* A derivative by two different coordinates is in two places of the matrix. */
ZP_INLINE void add_both(const ZpAssembly *a, size_t one, size_t other, double value, ZpBand *K) {
  add(a, one, other, value, K);
  add(a, other, one, value, K);
}

/* The 2 x 2 block of the force on node `row` by the position of node `column`. */
ZP_INLINE void add_block(const ZpAssembly *a, size_t row, size_t column, const double block[4], ZpBand *K) {
  for (size_t k = 0; k < 4; k++)
    add(a, 2 * row + k / 2, 2 * column + k % 2, block[k], K);
}

/* -- edges ------------------------------------------------------------------------------------------ */

/* Edge l is left of node j, edge j right of it, edge r right of that. The force R of an edge acts on its right node, -R
 * on its left, so node j with itself, the next node of its ribbon and the one after have the blocks
 *   D_ll - D_lj - D_jl + D_jj,   D_lj - D_jj + D_jr,   -D_jr */
ZP_INLINE void edges_of_free_node(const ZpAssembly *a, size_t s, size_t per, size_t i, size_t j, const double (*D)[4],
                                  ZpBand *K) {
  const double *ll = D[3 * (j - s) + 1], *lj = D[3 * (j - s) + 2], *jl = D[3 * j], *jj = D[3 * j + 1],
               *jr = D[3 * j + 2];
  size_t equation = (size_t)a->first[i] + 2 * (j - s * i);
  double *x = zp_band_row(K, equation), *y = zp_band_row(K, equation + 1);
  double own[4], next[4];
  for (size_t k = 0; k < 4; k++) {
    own[k] = (ll[k] - lj[k]) + (jj[k] - jl[k]);
    next[k] = (lj[k] - jj[k]) + jr[k];
  }
  x[0] += own[0];
  x[1] += own[1];
  y[0] += own[3];
  x[per] += next[0];
  x[per + 1] += next[1];
  y[per - 1] += next[2];
  y[per] += next[3];
  x[2 * per] -= jr[0];
  x[2 * per + 1] -= jr[1];
  y[2 * per - 1] -= jr[2];
  y[2 * per] -= jr[3];
}

/* Edges of nodes near held and joined ones, and both triangles where the matrix has two. */
static void edges_of_node(const ZpAssembly *a, size_t i, size_t j, const double (*D)[4], ZpBand *K) {
  static const double none[4] = {0};
  size_t s = a->s, N = a->nodes;
  bool left = i > 0, right = i + 1 < N, beyond = i + 2 < N;
  const double *ll = left ? D[3 * (j - s) + 1] : none, *lj = left && right ? D[3 * (j - s) + 2] : none,
               *jl = left && right ? D[3 * j] : none, *jj = right ? D[3 * j + 1] : none,
               *jr = beyond ? D[3 * j + 2] : none, *rj = beyond ? D[3 * (j + s)] : none;
  double own[4], next[4], back[4], after[4], before[4];
  for (size_t k = 0; k < 4; k++) {
    own[k] = (ll[k] - lj[k]) + (jj[k] - jl[k]);
    next[k] = (lj[k] - jj[k]) + jr[k];
    back[k] = (jl[k] - jj[k]) + rj[k];
    after[k] = -jr[k];
    before[k] = -rj[k];
  }
  add_block(a, j, j, own, K);
  if (right) add_block(a, j, j + s, next, K);
  if (right) add_block(a, j + s, j, back, K);
  if (beyond) add_block(a, j, j + 2 * s, after, K);
  if (beyond) add_block(a, j + 2 * s, j, before, K);
}

static bool is_free(const ZpAssembly *a, size_t i) {
  return a->symmetric && i > 0 && a->first[i] >= 0;
}

ZP_INLINE void edges_of_free_stations(const ZpAssembly *a, size_t s, size_t per, const double (*D)[4], ZpBand *K) {
  for (size_t i = 1; i < a->nodes; i++)
    for (size_t j = s * i; a->first[i] >= 0 && j < s * (i + 1); j++)
      edges_of_free_node(a, s, per, i, j, D, K);
}

ZP_KERNEL static void edges_of_free(const ZpAssembly *a, const double (*D)[4], ZpBand *K) {
  if (a->own > 0)
    edges_of_free_stations(a, a->s, per_station(a), D, K);
  else if (a->s == 2)
    edges_of_free_stations(a, 2, 4, D, K);
  else
    edges_of_free_stations(a, 1, 2, D, K);
}

void zp_assemble_edges(const ZpAssembly *a, const double (*D)[4], ZpBand *K) {
  for (size_t i = 0; i < a->nodes; i++)
    for (size_t j = a->s * i; !is_free(a, i) && j < a->s * (i + 1); j++)
      edges_of_node(a, i, j, D, K);
  if (a->symmetric) edges_of_free(a, D, K);
}

/* How edge j goes with u. */
static void edge_of(const ZpAssembly *a, const double *u, size_t j, double e[2]) {
  for (size_t c = 0; c < 2; c++) {
    e[c] = zp_assembly_change(a, u, 2 * (j + a->s) + c) - zp_assembly_change(a, u, 2 * j + c);
  }
}

double zp_edges_along(const ZpAssembly *a, const double (*D)[4], const double *u) {
  double sum = 0;
  size_t edges = a->s * (a->nodes - 1);
  for (size_t j = 0; j < edges; j++) {
    double e[2], other[2];
    edge_of(a, u, j, e);
    for (size_t m = 0; m < 3; m++) {
      if ((m == 0 && j < a->s) || (m == 2 && j + a->s >= edges)) continue;
      const double *block = D[3 * j + m];
      edge_of(a, u, j + m * a->s - a->s, other);
      sum += e[0] * (block[0] * other[0] + block[1] * other[1]) + e[1] * (block[2] * other[0] + block[3] * other[1]);
    }
  }
  return sum;
}

/* -- gaps ------------------------------------------------------------------------------------------- */

/* Derivative of the gap of a station by the y of its node r: up on the upper ribbon, down on the lower or only one. */
ZP_INLINE double rise(size_t s, size_t r) {
  return s == 2 && r == 0 ? 1 : -1;
}

/* Derivative of the x-length of an element by the x of a node: of its left station, or of its right one. */
ZP_INLINE double stretch(size_t s, bool right) {
  return (right ? 1.0 : -1.0) / (double)s;
}

/* In a symmetric matrix, the rows of x and of y of `s` nodes from `first` on: entry (first + i, first + j) is at
 * rows[i][j]. */
ZP_INLINE void rows_from(const ZpBand *K, size_t first, size_t s, double **rows) {
  for (size_t p = 0; p < s; p++) {
    rows[2 * p] = zp_band_row(K, first + 2 * p) - 2 * p;
    rows[2 * p + 1] = zp_band_row(K, first + 2 * p + 1) - (2 * p + 1);
  }
}

ZP_INLINE void gaps_of_free_station(const ZpAssembly *a, size_t s, size_t per, size_t i, const ZpGapDerivatives *of,
                                    ZpBand *K) {
  double own = of->own[i], next = of->next[i], along[2] = {of->along0[i], of->along1[i]};
  double *here[4], *after[4]; /* rows of station i, of station i + 1 */
  rows_from(K, (size_t)a->first[i], s, here);
  rows_from(K, (size_t)a->first[i] + per, s, after);
  for (size_t p = 0; p < s; p++)
    for (size_t q = 0; q < s; q++) {
      double both = rise(s, p) * rise(s, q);
      if (q >= p) here[2 * p + 1][2 * q + 1] += both * own;
      here[2 * p + 1][per + 2 * q + 1] += both * next;
    }
  for (size_t p = 0; p < s; p++)
    for (size_t q = 0; q < s; q++) {
      size_t x = 2 * p, y = 2 * q + 1;
      double by_left = rise(s, q) * along[0], by_right = rise(s, q) * along[1];
      here[x < y ? x : y][x < y ? y : x] += stretch(s, false) * by_left;
      here[x][per + y] += stretch(s, false) * by_right;
      here[y][per + x] += stretch(s, true) * by_left;
      after[x < y ? x : y][x < y ? y : x] += stretch(s, true) * by_right;
    }
}

static void gaps_of_station(const ZpAssembly *a, size_t i, const ZpGapDerivatives *of, ZpBand *K) {
  size_t s = a->s, first = s * i;
  for (size_t p = 0; p < s; p++)
    for (size_t q = 0; q < s; q++)
      add(a, 2 * (first + p) + 1, 2 * (first + q) + 1, rise(s, p) * rise(s, q) * of->own[i], K);
  if (i + 1 == a->nodes) return;
  for (size_t p = 0; p < s; p++)
    for (size_t q = 0; q < s; q++)
      add_both(a, 2 * (first + p) + 1, 2 * (first + s + q) + 1, rise(s, p) * rise(s, q) * of->next[i], K);
  for (size_t p = 0; p < 2 * s; p++)
    for (size_t q = 0; q < 2 * s; q++) {
      double along = q < s ? of->along0[i] : of->along1[i];
      add_both(a, 2 * (first + p), 2 * (first + q) + 1, stretch(s, p >= s) * rise(s, q % s) * along, K);
    }
}

void zp_assemble_gaps(const ZpAssembly *a, const ZpGapDerivatives *of, ZpBand *K) {
  for (size_t i = 0; i < a->nodes; i++) {
    if (a->first[i] < 0 || !a->symmetric)
      gaps_of_station(a, i, of, K);
    else if (a->own > 0)
      gaps_of_free_station(a, a->s, per_station(a), i, of, K);
    else if (a->s == 2)
      gaps_of_free_station(a, 2, 4, i, of, K);
    else
      gaps_of_free_station(a, 1, 2, i, of, K);
  }
}

/* -- the laws' own unknowns ------------------------------------------------------------------------- */

void zp_assemble_own(const ZpAssembly *a, size_t c, size_t d, double value, ZpBand *K) {
  *zp_band_at(K, (size_t)a->extra_equation[c], (size_t)a->extra_equation[d]) += value;
}

static inline void add_above(int i, int j, double value, ZpBand *K) {
  if (i >= 0 && j >= 0) *zp_band_entry(K, (size_t)(i < j ? i : j), (size_t)(i < j ? j : i)) += value;
}

void zp_assemble_own_by_gap(const ZpAssembly *a, size_t c, size_t station, double value, ZpBand *K) {
  const size_t upper = 2 * a->s * station + 1, lower = upper + 2 * (a->s - 1);
  add_above(a->extra_equation[c], a->equation[upper], a->factor[upper] * value, K);
  add_above(a->extra_equation[c], a->equation[lower], a->factor[lower] * -value, K);
}

void zp_assemble_entry(const ZpAssembly *a, size_t row, size_t column, double value, ZpBand *K) {
  add(a, row, column, value, K);
}

void zp_assemble_heights(const ZpAssembly *a, size_t station, double upper, double lower, double both, ZpBand *K) {
  const size_t up = 2 * a->s * station + 1, low = up + 2 * (a->s - 1);
  const int row = a->equation[up], column = a->equation[low];
  add_above(row, row, upper, K);
  add_above(column, column, lower, K);
  add_above(row, column, a->factor[up] * a->factor[low] * (row == column ? 2 * both : both), K);
}
