/* NSGA-II: K. Deb, A. Pratap, S. Agarwal, T. Meyarivan, "A fast and elitist multiobjective genetic algorithm", IEEE
 * Trans. Evol. Comput. 6 (2002) 182-197: ranks by domination, crowding distances, tournaments; simulated binary
 * crossover and polynomial mutation with the parameters of that paper. Random numbers are hashes of the seed, the case
 * and the purpose, so a resumed search, or one with other threads, has the same children. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/mix.h"
#include "optimize/search.h"

/* Distribution indices of crossover and mutation; probability that a coordinate is crossed. */
static const double crossing = 15, mutating = 20, crossed = 0.5;

enum { SMALLEST = 8, LARGEST = 200, GENERATIONS = 20 };

typedef struct Member {
  size_t number; /* number of its case */
  int rank;      /* 0: no member dominates it */
  double crowding;
} Member;

typedef struct Population {
  ZpSearch *search;
  size_t size;
  Member *member; /* [2 size] parents, then children */
  size_t first;   /* number of the case of the first child */
} Population;

/* A random number in (0, 1). */
static double chance(const ZpSearch *s, size_t number, uint64_t use) {
  const uint64_t x = zp_mix(zp_mix((uint64_t)s->def.sampling.seed + 1) + number * 1024 + use);
  return ((double)(x >> 11) + 0.5) / 9007199254740992.0;
}

static const double *value_of(const Population *p, size_t i) {
  return p->search->point[p->member[i].number].value;
}

/* -- selection -------------------------------------------------------------------------------------- */

/* Rank r: the members that are dominated only by members of lower rank. */
static void rank(Population *p, size_t count) {
  size_t ranked = 0;
  for (size_t i = 0; i < count; i++)
    p->member[i].rank = -1;
  for (int level = 0; ranked < count; level++) {
    for (size_t i = 0; i < count; i++) {
      bool dominated = p->member[i].rank >= 0 && p->member[i].rank < level;
      for (size_t j = 0; j < count && !dominated; j++)
        dominated = (p->member[j].rank < 0 || p->member[j].rank == level) &&
                    zp_dominates(&p->search->problem, value_of(p, j), value_of(p, i));
      if (!dominated) p->member[i].rank = level, ranked++;
    }
  }
}

/* Crowding distance in one objective: distance between the neighbours of the same rank, over the range of that rank. */
static double gap(const Population *p, size_t count, size_t i, size_t objective) {
  double below = -INFINITY, above = INFINITY, least = INFINITY, most = -INFINITY;
  const double own = value_of(p, i)[objective];
  for (size_t j = 0; j < count; j++) {
    const double value = value_of(p, j)[objective];
    if (p->member[j].rank != p->member[i].rank || isnan(value)) continue;
    least = fmin(least, value);
    most = fmax(most, value);
    if (j != i && value <= own) below = fmax(below, value);
    if (j != i && value >= own) above = fmin(above, value);
  }
  return most > least ? (above - below) / (most - least) : 0;
}

static void crowd(Population *p, size_t count) {
  for (size_t i = 0; i < count; i++) {
    p->member[i].crowding = 0;
    for (size_t k = 0; k < p->search->problem.objectives; k++)
      p->member[i].crowding += gap(p, count, i, k);
  }
}

/* Low ranks first, then large crowding distances, then the order of the cases: the order is unique. */
static int compare(const void *a, const void *b) {
  const Member *x = a, *y = b;
  if (x->rank != y->rank) return x->rank < y->rank ? -1 : 1;
  if (x->crowding != y->crowding) return x->crowding > y->crowding ? -1 : 1;
  return (x->number > y->number) - (x->number < y->number);
}

static void select_best(Population *p, size_t count) {
  rank(p, count);
  crowd(p, count);
  qsort(p->member, count, sizeof *p->member, compare);
}

/* -- children --------------------------------------------------------------------------------------- */

/* The better of two random members, which are sorted. */
static const double *parent(const Population *p, size_t number, uint64_t use) {
  const size_t a = (size_t)(chance(p->search, number, use) * (double)p->size);
  const size_t b = (size_t)(chance(p->search, number, use + 1) * (double)p->size);
  return p->search->point[p->member[a < b ? a : b].number].z;
}

/* Crossover: children between and around two values, most of them near one of these. */
static double cross(double a, double b, double u) {
  const double power = 1 / (crossing + 1), spread = u < 0.5 ? pow(2 * u, power) : pow(1 / (2 * (1 - u)), power);
  return 0.5 * ((1 + spread) * a + (1 - spread) * b);
}

static double mutate(double z, double u) {
  const double power = 1 / (mutating + 1);
  return z + (u < 0.5 ? pow(2 * u, power) - 1 : 1 - pow(2 * (1 - u), power));
}

static void make_child(const Population *p, size_t number, double *z) {
  enum { PARENTS, OTHER = 2, USES = 4 };
  const ZpSearch *s = p->search;
  const size_t n = s->problem.variables;
  const double *a = parent(p, number, PARENTS), *b = parent(p, number, OTHER);
  for (size_t i = 0; i < n; i++) {
    const uint64_t use = USES + 4 * i;
    z[i] = chance(s, number, use) < crossed ? cross(a[i], b[i], chance(s, number, use + 1)) : a[i];
    if (chance(s, number, use + 2) * (double)n < 1) z[i] = mutate(z[i], chance(s, number, use + 3));
    z[i] = fmin(fmax(z[i], 0), 1);
  }
}

static void breed(void *user, size_t index) {
  Population *p = user;
  double z[ZP_VARIABLES_MOST] = {0};
  make_child(p, p->first + index, z);
  zp_search_evaluate(p->search, p->first + index, z);
}

static ZpStatus evolve(Population *p, ZpError *err) {
  ZpSearch *s = p->search;
  ZpStatus status = zp_search_sample(s, p->size, err);
  for (size_t i = 0; i < p->size; i++)
    p->member[i].number = i;
  for (p->first = p->size; status == ZP_OK && !atomic_load(&s->stop) && p->first + p->size <= s->problem.evaluations;
       p->first += p->size) {
    select_best(p, p->first == p->size ? p->size : 2 * p->size);
    status = zp_search_parallel(s, p->size, breed, p, err);
    for (size_t i = 0; i < p->size; i++)
      p->member[p->size + i].number = p->first + i;
  }
  return status;
}

ZpStatus zp_search_evolve(ZpSearch *s, ZpError *err) {
  const size_t wanted = s->problem.evaluations / GENERATIONS;
  Population p = {.search = s, .size = wanted < SMALLEST ? SMALLEST : wanted > LARGEST ? LARGEST : wanted};
  p.member = calloc(2 * p.size, sizeof *p.member);
  if (!p.member) return zp_fail_memory(err);
  ZpStatus status = evolve(&p, err);
  free(p.member);
  return status;
}
