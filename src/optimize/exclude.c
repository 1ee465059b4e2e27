/* Is there a design in the box that satisfies all constraints? Called if a search has found none.
 *
 * The box is cut into cells, each with a case at its centre. A cell contains no such design if some constraint that is
 * violated at the centre is violated in the whole cell, assuming that it changes with each variable at most twice as
 * fast as between any two cases of the search. A cell that is not excluded is cut in three along a variable, so the
 * case at its centre stays, and the two new cases beside it give a slope along that variable alone (as in DIRECT:
 * Jones, Perttunen and Stuckman 1993). Slopes that are found later apply to all cells again. If all cells are excluded,
 * either the box contains no such design, or a constraint changes somewhere faster than the cases show. This is not a
 * strict proof, which a numerical study cannot give; the message states the assumption. */
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/fail.h"
#include "optimize/search.h"

/* Number of cells that are cut at once, independent of the number of threads. */
enum { WAVE = 16 };

static const double safety = 2;

/* Lower bound of slopes, so that pairs of cases can raise each of them. */
static const double flattest = 1e-9;

/* Error of an output, as a part of it: between cases that are very close the rest of a change counts. */
static const double accuracy = 1e-6;

/* Limits of the logarithm of a satisfied and of a violated constraint: far from the bound, the slope of an output says
 * nothing about where it reaches the bound. */
static const double kept_most = -1, missed_most = 3;

typedef struct Cell {
  size_t number; /* number of the case at its centre */
  double z[ZP_VARIABLES_MOST], half[ZP_VARIABLES_MOST];
} Cell;

typedef struct Exclusion {
  ZpSearch *search;
  size_t cells, most;
  size_t compared[ZP_BOUNDS_MOST];                 /* number of cases whose pairs are included in its slopes */
  Cell *cell;                                      /* [most] */
  double slope[ZP_BOUNDS_MOST][ZP_VARIABLES_MOST]; /* upper bound of its violation; INFINITY: not known */
} Exclusion;

static size_t bounds_of(const ZpProblem *p) {
  return p->goals - p->objectives;
}

/* Logarithm of the factor by which a constraint is violated at a case: outputs are roughly powers of the keys, so it
 * changes at a similar rate in the whole box. If there is no such factor, the difference over the bound. NAN if there
 * is no output, which says nothing about the neighbourhood. */
static double missed(const ZpSearch *s, size_t number, size_t bound) {
  const size_t g = s->problem.objectives + bound;
  const ZpGoal *goal = &s->problem.goal[g];
  const double value = s->point[number].value[g], share = goal->sign > 0 ? 1 + value : 1 - value;
  if (isnan(value)) return NAN;
  if (goal->bound <= 0) return fmin(fmax(value, kept_most), missed_most);
  const double factor = share > 0 ? goal->sign * log(share) : -goal->sign * INFINITY;
  return fmin(fmax(factor, kept_most), missed_most);
}

/* -- slopes ----------------------------------------------------------------------------------------- */

/* The difference between two cases that differ in one variable. */
static void learn(Exclusion *e, const Cell *from, const Cell *to, size_t variable) {
  const double way = fabs(to->z[variable] - from->z[variable]);
  for (size_t b = 0; b < bounds_of(&e->search->problem); b++) {
    const double found = fabs(missed(e->search, to->number, b) - missed(e->search, from->number, b)) / way;
    double *known = &e->slope[b][variable];
    if (!isnan(found)) *known = fmax(isinf(*known) ? flattest : *known, found);
  }
}

/* Ratio of the change of a constraint between two cases to that by the known slopes; NAN if it is not known. */
static double excess(const Exclusion *e, size_t bound, const ZpPoint *one, const ZpPoint *other) {
  const ZpSearch *s = e->search;
  double most = 0;
  for (size_t i = 0; i < s->problem.variables; i++)
    most += e->slope[bound][i] * fabs(one->z[i] - other->z[i]);
  const double change = missed(s, (size_t)(one - s->point), bound) - missed(s, (size_t)(other - s->point), bound);
  return one->done && other->done && most > 0 ? (fabs(change) - accuracy) / most : (double)NAN;
}

static bool knows_slopes(const Exclusion *e, size_t bound) {
  for (size_t i = 0; i < e->search->problem.variables; i++)
    if (isinf(e->slope[bound][i])) return false;
  return true;
}

/* Increase slopes where pairs of cases require it, one of which is new. */
static void learn_from_pairs(Exclusion *e, size_t bound) {
  const ZpSearch *s = e->search;
  const size_t end = s->problem.evaluations + e->cells;
  double most = 1;
  if (!knows_slopes(e, bound)) return;
  for (size_t one = e->compared[bound]; one < end; one++)
    for (size_t other = 0; other < one; other++)
      most = fmax(most, excess(e, bound, &s->point[one], &s->point[other]));
  for (size_t i = 0; i < s->problem.variables; i++)
    e->slope[bound][i] *= most;
  e->compared[bound] = end;
}

/* -- cells ------------------------------------------------------------------------------------------ */

static bool is_excluded(const Exclusion *e, const Cell *cell) {
  const ZpProblem *p = &e->search->problem;
  for (size_t b = 0; b < bounds_of(p); b++) {
    double least = missed(e->search, cell->number, b);
    for (size_t i = 0; i < p->variables; i++)
      least -= safety * e->slope[b][i] * cell->half[i];
    if (least > 0) return true;
  }
  return false;
}

static double volume(const Exclusion *e, const Cell *cell) {
  double product = 1;
  for (size_t i = 0; i < e->search->problem.variables; i++)
    product *= 2 * cell->half[i];
  return product;
}

/* The variable along which the constraints may change most within a cell. */
static size_t steepest(const Exclusion *e, const Cell *cell) {
  size_t best = 0;
  double most = -1;
  for (size_t i = 0; i < e->search->problem.variables; i++)
    for (size_t b = 0; b < bounds_of(&e->search->problem); b++)
      if (e->slope[b][i] * cell->half[i] > most) {
        most = e->slope[b][i] * cell->half[i];
        best = i;
      }
  return best;
}

/* The largest cells that are not excluded among those before `cells` => their number. */
static size_t choose(const Exclusion *e, size_t chosen[WAVE]) {
  size_t count = 0;
  for (size_t k = 0; k < e->cells; k++) {
    if (is_excluded(e, &e->cell[k])) continue;
    size_t place = count < WAVE ? count++ : WAVE;
    for (; place > 0 && volume(e, &e->cell[chosen[place - 1]]) < volume(e, &e->cell[k]); place--)
      if (place < WAVE) chosen[place] = chosen[place - 1];
    if (place < WAVE) chosen[place] = k;
  }
  return count;
}

/* Cut a cell in three: it keeps the central part, and the outer ones are added. */
static void cut(Exclusion *e, Cell *cell, size_t variable) {
  cell->half[variable] /= 3;
  for (int side = -1; side <= 1; side += 2) {
    Cell *outer = &e->cell[e->cells];
    *outer = *cell;
    outer->z[variable] += side * 2 * cell->half[variable];
    outer->number = e->search->problem.evaluations + e->cells++;
  }
}

/* Cells to evaluate, from the first one on. */
typedef struct Wave {
  Exclusion *exclusion;
  size_t first;
} Wave;

static void evaluate(void *user, size_t index) {
  const Wave *wave = user;
  const Cell *cell = &wave->exclusion->cell[wave->first + index];
  zp_search_evaluate(wave->exclusion->search, cell->number, cell->z);
}

/* Cut some cells, each along its variable, and run the new cases. */
static ZpStatus cut_cells(Exclusion *e, const size_t *chosen, const size_t *variable, size_t count, ZpError *err) {
  Wave wave = {e, e->cells};
  for (size_t k = 0; k < count; k++)
    cut(e, &e->cell[chosen[k]], variable[k]);
  ZpStatus status = zp_search_parallel(e->search, 2 * count, evaluate, &wave, err);
  if (status != ZP_OK || atomic_load(&e->search->stop)) return status;
  for (size_t k = 0; k < 2 * count; k++)
    learn(e, &e->cell[chosen[k / 2]], &e->cell[wave.first + k], variable[k / 2]);
  for (size_t b = 0; b < bounds_of(&e->search->problem); b++)
    learn_from_pairs(e, b);
  return ZP_OK;
}

/* Cut the whole box once along each variable. */
static ZpStatus cut_box(Exclusion *e, ZpError *err) {
  const size_t whole = 0;
  Wave wave = {e, 0};
  ZpStatus status = zp_search_parallel(e->search, 1, evaluate, &wave, err);
  for (size_t i = 0; i < e->search->problem.variables && status == ZP_OK && !atomic_load(&e->search->stop); i++)
    status = cut_cells(e, &whole, &i, e->cells + 2 <= e->most ? 1 : 0, err);
  return status;
}

/* The best case in the middle of a cell. */
static size_t best_of(const Exclusion *e) {
  const ZpSearch *s = e->search;
  size_t best = e->cell[0].number;
  for (size_t k = 1; k < e->cells; k++)
    if (zp_is_better(&s->problem, s->point[e->cell[k].number].value, s->point[best].value)) best = e->cell[k].number;
  return best;
}

static bool holds_one(const Exclusion *e) {
  return zp_violation(&e->search->problem, e->search->point[best_of(e)].value) == 0;
}

/* Repeat until all cells are excluded, a feasible design is found, or no cases are left. */
static ZpStatus exclude(Exclusion *e, ZpError *err) {
  ZpStatus status = cut_box(e, err);
  while (status == ZP_OK && !atomic_load(&e->search->stop) && !holds_one(e)) {
    size_t chosen[WAVE], variable[WAVE], room = (e->most - e->cells) / 2, count = choose(e, chosen);
    if (count > room) count = room;
    if (count == 0) break;
    for (size_t k = 0; k < count; k++)
      variable[k] = steepest(e, &e->cell[chosen[k]]);
    status = cut_cells(e, chosen, variable, count, err);
  }
  return status;
}

/* 1 only if no cell is left. */
static double excluded_share(const Exclusion *e) {
  size_t chosen[WAVE];
  double share = 0;
  if (choose(e, chosen) == 0) return 1;
  for (size_t k = 0; k < e->cells; k++)
    share += is_excluded(e, &e->cell[k]) ? volume(e, &e->cell[k]) : 0;
  return fmin(share, 1 - DBL_EPSILON);
}

ZpStatus zp_search_exclude(ZpSearch *s, ZpError *err) {
  Exclusion e = {.search = s, .cells = 1, .most = s->room - s->problem.evaluations};
  e.cell = calloc(e.most, sizeof *e.cell);
  if (!e.cell) return zp_fail_memory(err);
  e.cell[0].number = s->problem.evaluations;
  for (size_t i = 0; i < s->problem.variables; i++)
    e.cell[0].z[i] = e.cell[0].half[i] = 0.5;
  for (size_t b = 0; b < ZP_BOUNDS_MOST; b++)
    for (size_t i = 0; i < ZP_VARIABLES_MOST; i++)
      e.slope[b][i] = INFINITY;
  s->derivatives = false;
  ZpStatus status = exclude(&e, err);
  const bool ends = status != ZP_OK || atomic_load(&s->stop), found = !ends && holds_one(&e);
  if (!ends && !found) s->excluded = excluded_share(&e);
  if (found && s->problem.objectives == 1)
    status = zp_search_local_from(s, best_of(&e), s->problem.evaluations + e.cells, err);
  free(e.cell);
  return status;
}
