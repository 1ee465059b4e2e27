#include "front.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BAND = 2 * UNKNOWNS };
static const ZpFilmEnds everywhere = {0};

static size_t reserve(Front *f, void *memory) {
  ZpArena arena = {memory, 0};
  zp_film_reserve(&f->film, &f->eval, &arena);
  zp_band_reserve(&f->J, UNKNOWNS * f->film.nodes, 0, BAND, &arena);
  return arena.used;
}

Front *front_create(double stiffness, double viscosity, double w, double l, bool lateral_flow) {
  Front *f = calloc(1, sizeof *f);
  f->film = (ZpFilmParams){.nodes = STATIONS, .l = l, .w = w, .mu = viscosity, .roughness = 1e-9 * l};
  f->stiffness = stiffness;
  zp_film_modes(&f->film, lateral_flow);
  f->film.outlet = true;
  f->memory = zp_calloc(1, reserve(f, NULL));
  reserve(f, f->memory);
  return f;
}

void front_destroy(Front *f) {
  zp_free(f->memory);
  free(f);
}

void front_open(Front *f, bool left) {
  f->opens_left = left;
  f->film.platform = f->film.platform_end = f->film.vent[0] = f->film.vent[1] = left ? 0 : STATIONS - 1;
}

static double *entry(Front *f, size_t i, int a, size_t j, int b) {
  return zp_band_at(&f->J, UNKNOWNS * i + (size_t)a, UNKNOWNS * j + (size_t)b);
}

/* Bending of joint i by the gaps beside it, in the middle of the step. A closed end is mirrored; an open one is bent.
 */
static void bend(Front *f, size_t i) {
  double l = f->film.l, middle[3], weight[3] = {1, -2, 1}, share = 1;
  size_t first = i - 1;
  if (i == 0 || i + 1 == STATIONS) { /* both stations beyond and before it alike */
    bool left = i == 0;
    if (left == f->opens_left) return;
    first = left ? 0 : STATIONS - 3;
    weight[0] = left ? -2 : 0;
    weight[1] = 2;
    weight[2] = left ? 0 : -2;
    share = 0.5;
  }
  double curvature = 0, B = share * f->stiffness / (l * l * l);
  for (size_t k = 0; k < 3; k++) {
    middle[k] = 0.5 * (f->g0[first + k] + f->g1[first + k]);
    curvature += weight[k] * middle[k];
  }
  for (size_t k = 0; k < 3; k++) {
    f->force[first + k] -= B * weight[k] * curvature;
    for (size_t m = k; m < 3; m++)
      *entry(f, first + k, 0, first + m, 0) += 0.5 * B * weight[k] * weight[m];
  }
}

/* Over the mean gap, both voltages being one: the mean force of eq. (18.3). */
static void attract(Front *f, size_t i) {
  double length = zp_film_length(&f->film, i), h0 = f->g0[i] + f->d, h1 = f->g1[i] + f->d;
  if (f->F == 0) return;
  f->force[i] -= length * f->F * f->d / (h0 * h1);
  *entry(f, i, 0, i, 0) -= length * f->F * f->d / (h0 * h1 * h1);
}

/* Rows and columns of the heads at station i. */
static void film_at(Front *f, size_t i) {
  for (int k = 0; k < ZP_FILM_MODES; k++) {
    for (int m = k; m < ZP_FILM_MODES; m++)
      *entry(f, i, 1 + k, i, 1 + m) = zp_film_own(&f->film, f->h, &f->eval, i, k, m);
    for (int m = 0; m < ZP_FILM_MODES && i + 1 < STATIONS; m++)
      *entry(f, i, 1 + k, i + 1, 1 + m) = zp_film_next(&f->film, f->h, &f->eval, i, k, m);
    for (size_t j = i > 0 ? i - 1 : 0; j <= i + 1 && j < STATIONS; j++) {
      size_t row = UNKNOWNS * j, column = UNKNOWNS * i + 1 + (size_t)k;
      *zp_band_at(&f->J, row < column ? row : column, row < column ? column : row) -=
          zp_film_by_gap(&f->film, &f->eval, i, j, k);
    }
  }
}

static void evaluate(Front *f) {
  zp_band_clear(&f->J);
  zp_film_step(&f->film, &everywhere, f->g0, f->g1, f->h, f->start, f->heads, &f->eval);
  memcpy(f->force, f->eval.force, sizeof f->force);
  for (size_t i = 0; i < STATIONS; i++) {
    bend(f, i);
    attract(f, i);
    film_at(f, i);
  }
  double moment = f->stiffness * f->curvature / f->film.l;
  size_t end = f->opens_left ? 0 : STATIONS - 1, next = f->opens_left ? 1 : STATIONS - 2;
  f->force[end] += moment;
  f->force[next] -= moment;
}

/* Newton's correction => the largest change of a gap, of that gap; 1 where there is none. */
static double correct(Front *f) {
  double largest = 0;
  for (size_t i = 0; i < STATIONS; i++) {
    double *r = f->r + UNKNOWNS * i;
    r[0] = f->force[i];
    r[1] = f->eval.r[ZP_FILM_MODES * i];
    r[2] = zp_film_turned(&f->film, f->h, &f->eval, i, f->eval.r + ZP_FILM_MODES * i);
  }
  if (!zp_band_factor(&f->J)) return 1;
  zp_band_solve(&f->J, f->r);
  for (size_t i = 0; i < STATIONS; i++) {
    const double *r = f->r + UNKNOWNS * i;
    f->g1[i] += r[0];
    f->heads[ZP_FILM_MODES * i] += r[1] - zp_film_mix(&f->film, &f->eval, i) * r[2];
    f->heads[ZP_FILM_MODES * i + 1] += r[2];
    largest = fmax(largest, fabs(r[0]) / (f->g0[i] + f->film.l * 1e-6));
  }
  return largest;
}

bool front_step(Front *f) {
  enum { ROUNDS = 12 };
  static const double enough = 1e-6;
  double largest = 1;
  for (size_t i = 0; i < STATIONS; i++)
    f->g1[i] = f->g0[i] + f->h * f->eval.rate[i];
  for (int k = 0; k < ROUNDS && largest > 1e-3 * enough; k++) {
    evaluate(f);
    largest = correct(f);
  }
  for (size_t i = 0; i < STATIONS; i++)
    f->eval.rate[i] = (f->g1[i] - f->g0[i]) / f->h;
  memcpy(f->g0, f->g1, sizeof f->g0);
  return largest < enough;
}

double front_place(const Front *f, double at) {
  int by = f->opens_left ? -1 : 1;
  size_t i = f->opens_left ? STATIONS - 1 : 0;
  while (f->g0[(size_t)((int)i + by)] < at)
    i = (size_t)((int)i + by);
  double here = f->g0[i], next = f->g0[(size_t)((int)i + by)];
  return f->film.l * ((double)i + by * (at - here) / (next - here));
}

void front_lay(Front *f, double film, double x) {
  for (size_t i = 0; i < STATIONS; i++) {
    double s = (double)i * f->film.l - x;
    if (f->opens_left) s = -s;
    f->g0[i] = film + (s > 0 ? 0.5 * f->curvature * s * s : 0);
  }
}
