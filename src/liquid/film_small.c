#include "liquid/film_small.h"

#include <math.h>
#include <string.h>

void zp_film_ways_reserve(const ZpFilmParams *p, ZpFilmWays *ways, ZpArena *arena) {
  double **modes[] = {&ways->along_inertia, &ways->along_resistance, &ways->across_inertia, &ways->across_resistance};
  for (size_t k = 0; k < sizeof modes / sizeof modes[0]; k++)
    *modes[k] = zp_arena_take(arena, ZP_FILM_MODES * p->nodes);
  ways->diagonal = zp_arena_take(arena, p->nodes);
  ways->head = zp_arena_take(arena, p->nodes);
}

static size_t along(size_t i, int k) {
  return ZP_FILM_FLOWS * i + (size_t)k;
}

static size_t across(size_t i, int k) {
  return ZP_FILM_FLOWS * i + ZP_FILM_MODES + (size_t)k;
}

/* A step so short that only inertia resists, and one so long that only viscosity does: so the program has these
 * formulas only once, in the step. In a bath the mean flow of the short one is half of that at its end; under a cover a
 * flow that begins does so at once (film.c). */
void zp_film_ways(const ZpFilmParams *p, const ZpCover *cover, const double *gap, const double *zeros,
                  const ZpFilmEval *e, ZpFilmWays *ways) {
  static const double instant = 1e-18, ever = 1e12; /* s */
  const ZpFilmEnds ends = {.cover = cover};
  const double mean = cover ? 1 : 0.5;
  ways->params = p;
  ways->eval = e;
  for (size_t i = 0; i < p->nodes; i++)
    e->rate[i] = 0;
  zp_film_step(p, &ends, gap, gap, instant, zeros, zeros, e);
  for (size_t at = 0; at < ZP_FILM_MODES * p->nodes; at++) {
    ways->along_inertia[at] = mean * instant / e->conductance[at];
    ways->across_inertia[at] = mean * instant / e->leak_conductance[at];
  }
  zp_film_step(p, &ends, gap, gap, ever, zeros, zeros, e);
  for (size_t at = 0; at < ZP_FILM_MODES * p->nodes; at++) {
    ways->along_resistance[at] = 1 / e->conductance[at];
    ways->across_resistance[at] = 1 / e->leak_conductance[at];
  }
}

static bool is_free(const ZpFilmWays *ways, size_t i, int k) {
  return zp_film_is_free(ways->params, ways->eval, i, k);
}

/* The volume that must leave the cell of station i, per width, m^2/s. */
static double pressed_out(const ZpFilmWays *ways, const double *rate, size_t i, int k) {
  const ZpFilmParams *p = ways->params;
  double sum = 0;
  for (size_t j = i > 0 ? i - 1 : 0; j <= i + 1 && j < p->nodes; j++)
    sum -= zp_film_by_gap(p, ways->eval, i, j, k) * rate[j];
  return sum / (p->share[k] * p->w);
}

/* (volumes that must leave the cells, in `head`) => heads at which they flow away, 0 where one is given: elimination
 * from the left. */
static void find_heads(const ZpFilmWays *ways, int k, const double *along_by, const double *across_by) {
  const size_t N = ways->params->nodes;
  double *head = ways->head, *diagonal = ways->diagonal;
  for (size_t i = 0; i < N; i++) {
    diagonal[i] = 1;
    if (!is_free(ways, i, k)) {
      head[i] = 0;
      continue;
    }
    double left = i > 0 ? 1 / along_by[zp_film_mode_at(i - 1, k)] : 0, right = 1 / along_by[zp_film_mode_at(i, k)];
    diagonal[i] = left + right + zp_film_wet(ways->eval, i) / across_by[zp_film_mode_at(i, k)];
    if (i == 0 || !is_free(ways, i - 1, k)) continue;
    diagonal[i] -= left * left / diagonal[i - 1];
    head[i] += left / diagonal[i - 1] * head[i - 1];
  }
  for (size_t i = N; i-- > 0;) {
    bool follows = i + 1 < N && is_free(ways, i, k) && is_free(ways, i + 1, k);
    head[i] = (head[i] + (follows ? head[i + 1] / along_by[zp_film_mode_at(i, k)] : 0)) / diagonal[i];
  }
}

/* Volumes that must leave the cells => head. */
static void press(const ZpFilmWays *ways, const double *rate, int k) {
  for (size_t i = 0; i < ways->params->nodes; i++)
    ways->head[i] = pressed_out(ways, rate, i, k);
}

/* Add the flows by which these volumes leave. */
static void add_flow(const ZpFilmWays *ways, int k, bool viscous, double *flow) {
  const size_t N = ways->params->nodes;
  const double *along_by = viscous ? ways->along_resistance : ways->along_inertia,
               *across_by = viscous ? ways->across_resistance : ways->across_inertia;
  find_heads(ways, k, along_by, across_by);
  for (size_t i = 0; i < N; i++) {
    double next = i + 1 < N ? ways->head[i + 1] : 0;
    flow[along(i, k)] += (ways->head[i] - next) / along_by[zp_film_mode_at(i, k)];
    flow[across(i, k)] += ways->head[i] / across_by[zp_film_mode_at(i, k)];
  }
}

void zp_film_ways_flow(const ZpFilmWays *ways, const double *rate, int k, bool viscous, double *flow) {
  for (size_t i = 0; i < ways->params->nodes; i++)
    flow[along(i, k)] = flow[across(i, k)] = 0;
  press(ways, rate, k);
  add_flow(ways, k, viscous, flow);
}

void zp_film_ways_close(const ZpFilmWays *ways, int k, double *flow) {
  for (size_t i = 0; i < ways->params->nodes; i++) {
    double enters = i > 0 ? flow[along(i - 1, k)] : 0;
    ways->head[i] = enters - flow[along(i, k)] - zp_film_wet(ways->eval, i) * flow[across(i, k)];
  }
  add_flow(ways, k, true, flow);
}

void zp_film_ways_drag(const ZpFilmWays *ways, const double *rate, double *drag) {
  const ZpFilmParams *p = ways->params;
  memset(drag, 0, p->nodes * sizeof *drag);
  for (int k = 0; k < ZP_FILM_MODES; k++) {
    if (!(p->share[k] > 0)) continue;
    press(ways, rate, k);
    find_heads(ways, k, ways->along_resistance, ways->across_resistance);
    for (size_t i = 0; i < p->nodes; i++)
      for (size_t j = i > 0 ? i - 1 : 0; j <= i + 1 && j < p->nodes; j++)
        drag[j] += zp_film_by_gap(p, ways->eval, i, j, k) * ways->head[i];
  }
}

/* Of ways that are open. */
static double product(const ZpFilmWays *ways, const double *f, const double *g, const double *by_along,
                      const double *by_across) {
  const ZpFilmParams *p = ways->params;
  double sum = 0;
  for (size_t i = 0; i < p->nodes; i++)
    for (int k = 0; k < ZP_FILM_MODES; k++) {
      size_t a = along(i, k), c = across(i, k);
      double of_mode = 0;
      if (f[a] != 0) of_mode += by_along[zp_film_mode_at(i, k)] * f[a] * g[a];
      if (f[c] != 0) of_mode += by_across[zp_film_mode_at(i, k)] * zp_film_wet(ways->eval, i) * f[c] * g[c];
      sum += p->w * p->share[k] * of_mode;
    }
  return sum;
}

double zp_film_ways_inertia(const ZpFilmWays *ways, const double *f, const double *g) {
  return product(ways, f, g, ways->along_inertia, ways->across_inertia);
}

double zp_film_ways_resistance(const ZpFilmWays *ways, const double *f, const double *g) {
  return product(ways, f, g, ways->along_resistance, ways->across_resistance);
}

double zp_film_ways_out(const ZpFilmWays *ways, const double *flow, size_t first, size_t last) {
  const ZpFilmParams *p = ways->params;
  double sum = 0;
  for (size_t i = first; i <= last; i++)
    for (int k = 0; k < ZP_FILM_MODES; k++)
      sum += p->w * zp_film_wet(ways->eval, i) * p->share[k] * flow[across(i, k)];
  return sum;
}
