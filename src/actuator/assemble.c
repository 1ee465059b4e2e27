/* Where all coordinates near a station are free, their places are consecutive and entries have fixed places: rows are
 * written directly there. Near held and joined nodes each entry looks up its places. */
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

/* Which swing a coordinate has, of a member on bodies in the plane; below 0: none. */
static int swing_at(const ZpModel *model, size_t k) {
  const ZpTopology *t = &model->topology;
  const size_t node = k / 2;
  if (!model->network->plane || k >= 2 * model->count) return -1;
  if (node == zp_lower(t, t->platform.first)) return (int)(k % 2);
  return node == zp_lower(t, t->platform.last) ? 2 + (int)(k % 2) : -1;
}

/* Coordinates of a station: x and y of its nodes; in space then z and angle of each. */
static size_t of_station(const ZpAssembly *a) {
  return a->axes * a->s;
}

/* The c-th of them. */
static size_t coordinate_of(const ZpAssembly *a, size_t station, size_t c) {
  const size_t behind = c < 2 * a->s ? 0 : 2;
  return behind * a->count + 2 * a->s * station + c - behind * a->s;
}

/* The station of a coordinate. */
static size_t station_of(const ZpAssembly *a, size_t k) {
  return k % (2 * a->count) / (2 * a->s);
}

static size_t coordinates(const ZpAssembly *a) {
  return a->axes * a->count;
}

/* One coordinate gets the next number, that of another one, or none => the next number. */
static int number_one(const ZpTies *ties, size_t k, int next, ZpAssembly *a) {
  const ZpTie *tie = zp_tie_of(ties, k);
  const int swing = swing_at(ties->first + ties->member, k);
  const size_t leader = tie ? leader_of(ties, tie) : k;
  if (swing >= 0) {
    a->equation[k] = -2 - swing;
    return next;
  }
  a->factor[k] = tie ? tie->factor : 1;
  a->offset[k] = tie ? tie->offset : 0;
  a->equation[k] = a->factor[k] == 0 ? -1 : leader < k ? a->equation[leader] : next++;
  return next;
}

/* Station by station: coordinates of its nodes, then unknowns of the laws. */
static size_t number(const ZpTies *ties, ZpAssembly *a) {
  int next = 0;
  for (size_t i = 0; i < a->nodes; i++) {
    for (size_t c = 0; c < of_station(a); c++)
      next = number_one(ties, coordinate_of(a, i, c), next, a);
    for (size_t c = 0; c < a->own; c++)
      a->extra_equation[a->own * i + c] = next++;
  }
  return (size_t)next;
}

/* Two halves that mirror each other have in common what a row ties across their platform, eq. (19.1). No row does so
 * where the platform turns: the whole is then one part. A plate has no halves beside its platform. */
static void find_parts(const ZpTies *ties, ZpAssembly *a) {
  ZpParts *parts = &a->parts;
  if (zp_half_elements(&ties->first[ties->member].topology) == 0) return;
  for (const ZpTie *tie = ties->tie; tie < ties->tie + ties->count; tie++) {
    if (tie->factor == 0) continue;
    if (station_of(a, leader_of(ties, tie)) != station_of(a, tie->coordinate))
      parts->common[parts->count++] = (size_t)a->equation[tie->coordinate];
  }
  parts->more = parts->count > 0;
}

/* Number of equations of a station whose coordinates are free. */
static size_t per_station(const ZpAssembly *a) {
  return of_station(a) + a->own;
}

/* Is it in the band of the block? */
static bool is_inner(const ZpAssembly *a, int place) {
  return place >= 0 && (size_t)place < a->block.n;
}

/* The place of the first coordinate of station i, if those of stations i .. i + 2 all follow it; else -1. */
static int first_of(const ZpAssembly *a, size_t i) {
  if (i + 2 >= a->nodes || a->axes > ZP_PLANE_AXES) return -1;
  int first = a->place[2 * a->s * i];
  for (size_t m = 0; m < 3; m++)
    for (size_t c = 0; c < 2 * a->s; c++) {
      int place = a->place[2 * a->s * (i + m) + c];
      if (!is_inner(a, place) || place != first + (int)(m * per_station(a) + c)) return -1;
    }
  return first;
}

/* Smallest (sign -1) or largest place in the band of stations i .. end - 1; -1: they have none. */
static int outermost(const ZpAssembly *a, size_t i, size_t end, int sign) {
  int most = -1;
  for (; i < least(end, a->nodes); i++)
    for (size_t c = 0; c < of_station(a); c++) {
      const int place = a->place[coordinate_of(a, i, c)];
      if (is_inner(a, place) && (most < 0 || sign * place > sign * most)) most = place;
    }
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
    if (a->own > 0) width = wider(width, first, a->extra_place[a->own * least(i + 2, a->nodes) - 1]);
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
  if (!a->block.band.symmetric || a->own > 0 || i == a->nodes) return (ZpBandGroups){0, 0};
  groups.lead = (ZP_BAND_BLOCK - (size_t)a->first[i] % ZP_BAND_BLOCK) % ZP_BAND_BLOCK;
  for (i = 0; i < a->nodes; i++) {
    int first = outermost(a, i, i + 1, -1), last = outermost(a, i, i + 3, 1);
    if (first < 0) continue;
    size_t begin = ((size_t)first + groups.lead) / ZP_BAND_BLOCK, end = ((size_t)last + groups.lead) / ZP_BAND_BLOCK;
    if (end - begin >= groups.reach) return (ZpBandGroups){0, 0};
  }
  return groups;
}

/* The form of the block, by its places. */
static void find_form(ZpAssembly *a) {
  for (size_t i = 0; i < a->nodes; i++)
    a->first[i] = first_of(a, i);
  a->block.band.bandwidth = bandwidth_of(a);
  a->block.band.groups = groups_of(a);
}

bool zp_assembly_create(const ZpTies *ties, size_t own, bool symmetric, ZpAssembly *a) {
  const ZpModel *model = ties->first + ties->member;
  *a = (ZpAssembly){.s = model->s,
                    .nodes = model->nodes,
                    .count = model->count,
                    .stride = model->stride,
                    .axes = model->axes,
                    .own = own,
                    .port = -1};
  a->parts.common = zp_calloc(ZP_MOST_TIES, sizeof *a->parts.common);
  int **integers[] = {&a->equation, &a->place, &a->extra_equation, &a->extra_place, &a->first};
  const size_t counts[] = {coordinates(a), coordinates(a), own * a->nodes + 1, own * a->nodes + 1, a->nodes};
  bool made = true;
  for (size_t k = 0; k < sizeof integers / sizeof integers[0]; k++)
    made &= (*integers[k] = zp_calloc(counts[k], sizeof **integers[k])) != NULL;
  a->factor = zp_calloc(coordinates(a), sizeof *a->factor);
  a->offset = zp_calloc(coordinates(a), sizeof *a->offset);
  if (!made || !a->factor || !a->offset || !a->parts.common) {
    zp_assembly_destroy(a);
    return false;
  }
  a->n = a->block.n = number(ties, a);
  memcpy(a->place, a->equation, coordinates(a) * sizeof *a->place);
  memcpy(a->extra_place, a->extra_equation, own * a->nodes * sizeof *a->extra_place);
  find_parts(ties, a);
  a->block.band.symmetric = symmetric;
  find_form(a);
  return true;
}

/* -- several members ------------------------------------------------------------------------------- */

/* Equations of the border, by the equations of each member alone: -1 of one that is not in it. */
typedef struct Shared {
  size_t members, count;
  int **of;        /* [members][n] */
  size_t *of_each; /* [members] how many each has */
} Shared;

static void close_shared(Shared *s) {
  for (size_t k = 0; s->of && k < s->members; k++)
    zp_free(s->of[k]);
  zp_free(s->of);
  zp_free(s->of_each);
}

static bool open_shared(ZpAssembly *const a[], size_t members, Shared *s) {
  *s = (Shared){.members = members};
  s->of = zp_calloc(members, sizeof *s->of);
  s->of_each = zp_calloc(members, sizeof *s->of_each);
  bool made = s->of && s->of_each;
  for (size_t k = 0; k < members && made; k++) {
    made = (s->of[k] = zp_calloc(a[k]->n + 1, sizeof **s->of)) != NULL;
    for (size_t i = 0; made && i < a[k]->n; i++)
      s->of[k][i] = -1;
  }
  return made;
}

/* Note that an equation of a member alone is one of the border, the next one if none is known of it. => which one */
static int note(const ZpAssembly *a, size_t member, size_t coordinate, int shared, Shared *s) {
  int *of = &s->of[member][a->equation[coordinate]];
  if (*of >= 0) return *of;
  s->of_each[member]++;
  if (shared == (int)s->count) s->count++;
  return *of = shared;
}

static void find_shared(ZpAssembly *const a[], const ZpModel *first, Shared *s) {
  for (size_t member = 0; member < s->members; member++) {
    const ZpTies ties = zp_ties_of(first, s->members, member);
    for (const ZpTie *t = ties.tie; t < ties.tie + ties.count; t++) {
      if (t->to_member == member) continue;
      int shared = note(a[t->to_member], t->to_member, t->to, (int)s->count, s);
      note(a[member], member, t->coordinate, shared, s);
    }
  }
}

/* Bodies that springs join are in the border, too => the unknowns of each spring that meet there [2 springs]. */
static void find_springs(ZpAssembly *const a[], const ZpModel *first, Shared *s, ZpClique *spring, size_t *ends) {
  const ZpNetwork *network = first->network;
  for (size_t k = 0; k < network->springs; k++) {
    spring[k] = (ZpClique){0, ends + 2 * k};
    for (size_t e = 0; e < 2; e++) {
      const size_t body = network->spring[k].body[e];
      if (network->body[body].held) continue;
      const ZpSight at = zp_sight_of_body(first, body);
      ends[2 * k + spring[k].count++] = (size_t)note(a[at.member], at.member, at.coordinate, (int)s->count, s);
    }
  }
}

/* Equations of a member alone => places in the block, where they stand; those of the border => block.to. */
static void place(ZpAssembly *a, int *of, size_t *to) {
  int next = 0;
  size_t border = 0;
  for (size_t i = 0; i < a->n; i++) {
    if (of[i] >= 0) to[border++] = (size_t)of[i];
    of[i] = of[i] >= 0 ? -(int)border : next++; /* columns of the border below 0 */
  }
  a->block.n = (size_t)next;
  a->block.to = to;
  for (size_t i = 0; i < a->n; i++)
    if (of[i] < 0) of[i] = next - 1 - of[i];
}

/* The equation at a place, of a block that begins with equation `first`. */
static int equation_at(const ZpAssembly *a, int place, size_t first, size_t inner) {
  return is_inner(a, place) ? place + (int)first : (int)(inner + a->block.to[(size_t)place - a->block.n]);
}

/* Unknowns of the bodies of a member => its part of the border, and its swings. */
static size_t meet_bodies(ZpAssembly *a, const ZpModel *model, size_t *to) {
  const ZpEnds *ends = &model->network->ends[model->number];
  const size_t body[] = {ends->lower, ends->upper};
  size_t count = 0;
  for (int b = 0; b < 2; b++)
    for (int way = 0; way < ZP_WAYS; way++) {
      const long unknown = zp_network_unknown(model->network, body[b], (ZpWay)way);
      if (unknown < 0) continue;
      for (int k = 0; k < ZP_SWINGS; k++)
        a->swing[k].place[count] = (int)(a->block.n + count);
      to[count++] = (size_t)unknown;
    }
  for (int k = 0; k < ZP_SWINGS; k++)
    a->swing[k].count = count;
  return count;
}

/* Unknowns of the bodies that springs and joints join => [springs + joints] cliques. */
static void join_bodies(const ZpNetwork *network, ZpClique *clique, size_t *ends) {
  for (size_t k = 0; k < network->springs + network->joints; k++) {
    const size_t *body = k < network->springs ? network->spring[k].body : network->joint[k - network->springs].body;
    size_t *own = ends + ZP_SWING_WAYS * k, count = 0;
    for (int way = 0; way < ZP_SWING_WAYS; way++) {
      const long unknown = zp_network_unknown(network, body[way / ZP_WAYS], (ZpWay)(way % ZP_WAYS));
      if (unknown >= 0) own[count++] = (size_t)unknown;
    }
    clique[k] = (ZpClique){count, own};
  }
}

static void renumber(size_t count, const int *of, int *places) {
  for (size_t k = 0; k < count; k++)
    if (places[k] >= 0) places[k] = of[places[k]];
}

/* Number the equations of a member among those of all. */
static void join(ZpAssembly *a, const int *of, size_t first, size_t inner, size_t n) {
  const size_t own = a->own * a->nodes;
  renumber(coordinates(a), of, a->place);
  renumber(own, of, a->extra_place);
  for (size_t k = 0; k < coordinates(a); k++)
    if (a->place[k] >= 0) a->equation[k] = equation_at(a, a->place[k], first, inner);
  for (size_t c = 0; c < own; c++)
    a->extra_equation[c] = equation_at(a, a->extra_place[c], first, inner);
  for (size_t k = 0; k < ZP_SWINGS; k++)
    for (size_t c = 0; c < a->swing[k].count; c++)
      a->swing[k].equation[c] = equation_at(a, a->swing[k].place[c], first, inner);
  for (size_t k = 0; k < a->parts.count; k++)
    a->parts.common[k] = (size_t)equation_at(a, of[a->parts.common[k]], first, inner);
  a->n = n;
  find_form(a);
}

bool zp_assembly_join(ZpAssembly *const a[], const ZpModel *first, size_t members, size_t common, ZpArrowForm *form) {
  Shared shared;
  size_t room = 0, used = 0, inner = 0, before = 0;
  const ZpNetwork *network = first ? first->network : NULL;
  const bool plane = network && network->plane;
  const size_t springs = network ? network->springs + network->joints : 0;
  ZpClique *spring = zp_calloc(springs + 1, sizeof *spring);
  size_t *ends = zp_calloc(ZP_SWING_WAYS * springs + 1, sizeof *ends);
  bool made = open_shared(a, members, &shared) && spring && ends;
  if (made && network && !plane) find_shared(a, first, &shared);
  if (made && network && !plane) find_springs(a, first, &shared, spring, ends);
  if (made && plane) join_bodies(network, spring, ends);
  if (plane) shared.count = network->unknowns;
  for (size_t k = 0; made && k < members; k++)
    room += shared.of_each[k] + 1 + (plane ? ZP_SWING_WAYS : 0);
  size_t *to = zp_calloc(room + 1, sizeof *to);
  ZpArrowBlock *block = zp_calloc(members, sizeof *block);
  made = made && to && block;
  for (size_t k = 0; k < members && made; k++) {
    place(a[k], shared.of[k], to + used);
    inner += a[k]->block.n;
    if (plane) shared.of_each[k] = meet_bodies(a[k], first + k, to + used);
    a[k]->block.band.border = shared.of_each[k] + (a[k]->port >= 0);
    if (a[k]->port >= 0) a[k]->block.to[shared.of_each[k]] = shared.count + (size_t)a[k]->port;
    used += a[k]->block.band.border;
  }
  for (size_t k = 0; k < members && made; k++) {
    join(a[k], shared.of[k], before, inner, inner + shared.count + common);
    before += a[k]->block.n;
    block[k] = a[k]->block;
  }
  made = made && zp_arrow_form_create(block, members, shared.count + common, spring, springs, form);
  for (size_t k = 0; k < members && made; k++)
    a[k]->block.to = form->block[k].to;
  close_shared(&shared);
  zp_free(spring);
  zp_free(ends);
  zp_free(to);
  zp_free(block);
  return made;
}

bool zp_assembly_parts(ZpAssembly *const a[], size_t members, size_t n, ZpParts *parts) {
  bool *known = zp_calloc(n, sizeof *known);
  *parts = (ZpParts){.more = a[0]->parts.more, .common = zp_calloc(n, sizeof *parts->common)};
  const bool made = known && parts->common;
  for (size_t k = 0; made && k < members; k++)
    for (size_t i = 0; i < a[k]->parts.count; i++) {
      const size_t common = a[k]->parts.common[i];
      if (!known[common]) parts->common[parts->count++] = common;
      known[common] = true;
    }
  zp_free(known);
  return made;
}

void zp_assembly_destroy(ZpAssembly *a) {
  zp_free(a->equation);
  zp_free(a->place);
  zp_free(a->first);
  zp_free(a->extra_equation);
  zp_free(a->extra_place);
  zp_free(a->factor);
  zp_free(a->offset);
  zp_free(a->parts.common);
  *a = (ZpAssembly){0};
}

/* -- values ----------------------------------------------------------------------------------------- */

void zp_assembly_gather(const ZpAssembly *a, const double *nodes, double *equations) {
  for (size_t k = 0; k < coordinates(a); k++)
    if (a->equation[k] >= 0) equations[a->equation[k]] = a->factor[k] * nodes[zp_place_of(k, a->count, a->stride)];
}

void zp_assembly_place(const ZpAssembly *a, const double *equations, double *nodes) {
  for (size_t k = 0; k < coordinates(a); k++)
    if (a->equation[k] >= 0) nodes[zp_place_of(k, a->count, a->stride)] = zp_assembly_position(a, k, equations);
}

double zp_assembly_swung(const ZpSwing *swing, const double *step) {
  double sum = 0;
  for (size_t k = 0; k < swing->count; k++)
    sum += swing->factor[k] * step[swing->equation[k]];
  return sum;
}

/* Coordinates behind x and y. */
static void changes_in_space(const ZpAssembly *a, const double *step, double *nodes) {
  for (size_t k = 2 * a->count; k < coordinates(a); k++)
    nodes[zp_place_of(k, a->count, a->stride)] = a->equation[k] >= 0 ? a->factor[k] * step[a->equation[k]] : 0;
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
  if (a->axes > ZP_PLANE_AXES) changes_in_space(a, step, nodes);
  if (a->swing->count == 0) return;
  for (size_t k = 0; k < 2 * a->count; k++)
    if (equation[k] < -1)
      nodes[zp_place_of(k, a->count, a->stride)] = zp_assembly_swung(&a->swing[-2 - equation[k]], step);
}

/* A force on a coordinate that has a swing, by the unknowns of its bodies. */
static void add_swing(const ZpAssembly *a, size_t k, bool by_place, double force, double *sums) {
  const ZpSwing *swing = &a->swing[-2 - a->equation[k]];
  const int *number = by_place ? swing->place : swing->equation;
  for (size_t c = 0; c < swing->count; c++)
    sums[number[c]] += swing->factor[c] * force;
}

static void add_swings(const ZpAssembly *a, bool by_place, const double *nodes, double *sums) {
  for (size_t k = 0; a->swing->count > 0 && k < 2 * a->count; k++)
    if (a->equation[k] < -1) add_swing(a, k, by_place, nodes[zp_place_of(k, a->count, a->stride)], sums);
}

void zp_assembly_add_one(const ZpAssembly *a, size_t k, double force, double *equations) {
  if (a->equation[k] >= 0) equations[a->equation[k]] += a->factor[k] * force;
  if (a->equation[k] < -1) add_swing(a, k, false, force, equations);
}

void zp_assembly_add_place(const ZpAssembly *a, size_t k, double force, double *places) {
  if (a->place[k] >= 0) places[a->place[k]] += a->factor[k] * force;
  if (a->place[k] < -1) add_swing(a, k, true, force, places);
}

/* Forces on nodes, summed over what has the same number. */
static void add_by(const ZpAssembly *a, const int *number, const double *restrict nodes, double *restrict sums) {
  const double *factor = a->factor, *x = nodes, *y = nodes + a->stride;
  for (size_t j = 0; j < a->count; j++) {
    int of_x = number[2 * j], of_y = number[2 * j + 1];
    if (of_x >= 0) sums[of_x] += factor[2 * j] * x[j];
    if (of_y >= 0) sums[of_y] += factor[2 * j + 1] * y[j];
  }
  for (size_t k = 2 * a->count; k < coordinates(a); k++)
    if (number[k] >= 0) sums[number[k]] += factor[k] * nodes[zp_place_of(k, a->count, a->stride)];
}

void zp_assembly_add_free(const ZpAssembly *a, const double *nodes, double *equations) {
  add_by(a, a->equation, nodes, equations);
}

void zp_assembly_add(const ZpAssembly *a, const double *nodes, double *equations) {
  add_by(a, a->equation, nodes, equations);
  add_swings(a, false, nodes, equations);
}

void zp_assembly_sum(const ZpAssembly *a, const double *nodes, double *equations) {
  memset(equations, 0, a->n * sizeof *equations);
  zp_assembly_add(a, nodes, equations);
}

void zp_assembly_sum_places(const ZpAssembly *a, const double *nodes, double *places) {
  memset(places, 0, (a->block.n + a->block.band.border) * sizeof *places);
  add_by(a, a->place, nodes, places);
  add_swings(a, true, nodes, places);
}

void zp_assembly_add_masses(const ZpAssembly *a, const double *mass, double *equations) {
  for (size_t k = 0; k < 2 * a->count; k++)
    if (a->equation[k] >= 0) equations[a->equation[k]] += mass[k / 2];
}

/* -- one entry, anywhere ---------------------------------------------------------------------------- */

/* Of a block with a border: there, or by a coordinate that another member ties. */
static __attribute__((noinline)) void add_joined(const ZpAssembly *a, size_t row, size_t column, double value,
                                                 ZpBand *K) {
  size_t i = (size_t)a->place[row], j = (size_t)a->place[column];
  *zp_band_entry(K, i, j) += a->factor[row] * a->factor[column] * value;
}

/* The unknowns of a coordinate => how many; of one that has no swing itself. */
static size_t unknowns_of(const ZpAssembly *a, size_t k, const int **place, const double **factor) {
  const ZpSwing *swing = a->place[k] < -1 ? &a->swing[-2 - a->place[k]] : NULL;
  *place = swing ? swing->place : &a->place[k];
  *factor = swing ? swing->factor : &a->factor[k];
  return swing ? swing->count : a->place[k] >= 0;
}

static __attribute__((noinline)) void add_swung(const ZpAssembly *a, size_t row, size_t column, double value,
                                                ZpBand *K) {
  const int *i, *j;
  const double *by_row, *by_column;
  const size_t rows = unknowns_of(a, row, &i, &by_row), columns = unknowns_of(a, column, &j, &by_column);
  for (size_t r = 0; r < rows; r++)
    for (size_t c = 0; c < columns; c++)
      if (!a->block.band.symmetric || i[r] <= j[c])
        *zp_band_entry(K, (size_t)i[r], (size_t)j[c]) += by_row[r] * by_column[c] * value;
}

ZP_INLINE void add(const ZpAssembly *a, size_t row, size_t column, double value, ZpBand *K) {
  int i = a->place[row], j = a->place[column];
  if (i < -1 || j < -1) {
    add_swung(a, row, column, value, K);
    return;
  }
  if (i < 0 || j < 0 || (a->block.band.symmetric && i > j)) return;
  if (a->block.band.border > 0)
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
  size_t place = (size_t)a->first[i] + 2 * (j - s * i);
  double *x = zp_band_row(K, place), *y = zp_band_row(K, place + 1);
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
  return a->block.band.symmetric && i > 0 && a->first[i] >= 0;
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
  if (a->block.band.symmetric) edges_of_free(a, D, K);
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
    if (a->first[i] < 0 || !a->block.band.symmetric)
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
  *zp_band_at(K, (size_t)a->extra_place[c], (size_t)a->extra_place[d]) += value;
}

static inline void add_above(int i, int j, double value, ZpBand *K) {
  if (i >= 0 && j >= 0) *zp_band_entry(K, (size_t)(i < j ? i : j), (size_t)(i < j ? j : i)) += value;
}

void zp_assemble_own_by_gap(const ZpAssembly *a, size_t c, size_t station, double value, ZpBand *K) {
  const size_t upper = 2 * a->s * station + 1, lower = upper + 2 * (a->s - 1);
  if (a->s == 2) add_above(a->extra_place[c], a->place[upper], a->factor[upper] * value, K);
  add_above(a->extra_place[c], a->place[lower], a->factor[lower] * -value, K);
}

void zp_assemble_entry(const ZpAssembly *a, size_t row, size_t column, double value, ZpBand *K) {
  add(a, row, column, value, K);
}

void zp_assemble_chain(const ZpAssembly *a, size_t n, const size_t *coordinate, size_t wide, const double *value,
                       ZpBand *K) {
  for (size_t i = 0; i < n; i++) {
    if (a->place[coordinate[i]] == -1) continue;
    add(a, coordinate[i], coordinate[i], value[wide * i], K);
    for (size_t k = 1; k < wide && i + k < n; k++)
      if (value[wide * i + k] != 0) add_both(a, coordinate[i], coordinate[i + k], value[wide * i + k], K);
  }
}

void zp_assemble_heights(const ZpAssembly *a, size_t station, double upper, double lower, double both, ZpBand *K) {
  const size_t up = 2 * a->s * station + 1, low = up + 2 * (a->s - 1);
  const int row = a->place[up], column = a->place[low];
  add_above(row, row, upper, K);
  add_above(column, column, lower, K);
  add_above(row, column, a->factor[up] * a->factor[low] * (row == column ? 2 * both : both), K);
}
