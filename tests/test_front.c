/* Fronts that run through a film between two ribbons, in time, against the travelling waves that they should become:
 * peeling by bending, and zipping; docs/theory.md, section 22. Ribbons are beams of small slope here, without mass, and
 * the liquid flows along them only: the film is the library's, the rest is written down below. */
#include "check_util.h"

#include "liquid/film.h"
#include "math/band.h"

enum { STATIONS = 2001, UNKNOWNS = 2, BAND = 5 };

/* Of the gap h of two equal ribbons: EI' / 2 h'''' = w p - F d / (h + d)^2, EI' / 2 being `stiffness`. */
typedef struct Front {
  ZpFilmParams film;
  ZpFilmEval eval;
  double stiffness; /* N m^2 */
  double F, d;      /* attraction of closed faces, N; thickness that stands for the insulators, m */
  double curvature; /* of the gap, at the end that is open */
  bool opens_left;  /* that end; the other one is closed by symmetry */
  double h;         /* step, s */
  double g0[STATIONS], g1[STATIONS], p[STATIONS], heads[2 * STATIONS], start[ZP_FILM_STATE * STATIONS];
  double force[STATIONS], r[UNKNOWNS * STATIONS];
  ZpBand J;
  void *memory;
} Front;

static size_t carve(Front *f, void *memory) {
  ZpCarver carver = {memory, 0};
  zp_film_carve(&f->film, &f->eval, &carver);
  zp_band_carve(&f->J, UNKNOWNS * f->film.nodes, 0, BAND, &carver);
  return carver.used;
}

static Front *make_front(double stiffness, double viscosity, double w, double l) {
  Front *f = calloc(1, sizeof *f);
  f->film = (ZpFilmParams){.nodes = STATIONS, .l = l, .w = w, .mu = viscosity, .roughness = 1e-9 * l};
  f->stiffness = stiffness;
  zp_film_modes(&f->film, false);
  f->memory = zp_calloc(1, carve(f, NULL));
  carve(f, f->memory);
  return f;
}

static void free_front(Front *f) {
  zp_free(f->memory);
  free(f);
}

/* The end that is open has an outlet. */
static void open_at(Front *f, bool left) {
  f->opens_left = left;
  f->film.platform = f->film.platform_end = left ? 0 : STATIONS - 1;
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

static void evaluate(Front *f) {
  zp_band_clear(&f->J);
  for (size_t i = 0; i < STATIONS; i++)
    f->heads[2 * i] = f->p[i];
  zp_film_step(&f->film, f->g0, f->g1, f->h, f->start, f->heads, &f->eval);
  memcpy(f->force, f->eval.force, sizeof f->force);
  for (size_t i = 0; i < STATIONS; i++) {
    bend(f, i);
    attract(f, i);
    *entry(f, i, 1, i, 1) = zp_film_own(&f->film, f->h, &f->eval, i, 0, 0);
    if (i + 1 < STATIONS) *entry(f, i, 1, i + 1, 1) = zp_film_next(&f->film, f->h, &f->eval, i, 0);
    for (size_t j = i > 0 ? i - 1 : 0; j <= i + 1 && j < STATIONS; j++) {
      size_t row = UNKNOWNS * j, column = UNKNOWNS * i + 1;
      *zp_band_at(&f->J, row < column ? row : column, row < column ? column : row) -=
          zp_film_by_gap(&f->film, &f->eval, i, j, 0);
    }
  }
  double moment = f->stiffness * f->curvature / f->film.l;
  size_t end = f->opens_left ? 0 : STATIONS - 1, next = f->opens_left ? 1 : STATIONS - 2;
  f->force[end] += moment;
  f->force[next] -= moment;
}

static void step(Front *f) {
  enum { ROUNDS = 12 };
  double largest = 1, before[STATIONS];
  memcpy(before, f->g0, sizeof before);
  for (size_t i = 0; i < STATIONS; i++)
    f->g1[i] = f->g0[i] + f->h * f->eval.rate[i];
  for (int k = 0; k < ROUNDS && largest > 1e-9; k++) {
    evaluate(f);
    for (size_t i = 0; i < STATIONS; i++) {
      f->r[UNKNOWNS * i] = f->force[i];
      f->r[UNKNOWNS * i + 1] = f->eval.r[2 * i];
    }
    ck_assert(zp_band_factor(&f->J));
    zp_band_solve(&f->J, f->r);
    largest = 0;
    for (size_t i = 0; i < STATIONS; i++) {
      f->g1[i] += f->r[UNKNOWNS * i];
      f->p[i] += f->r[UNKNOWNS * i + 1];
      largest = fmax(largest, fabs(f->r[UNKNOWNS * i]) / (f->g0[i] + f->film.l * 1e-6));
    }
  }
  ck_below(largest, 1e-6);
  for (size_t i = 0; i < STATIONS; i++)
    f->eval.rate[i] = (f->g1[i] - before[i]) / f->h;
  memcpy(f->g0, f->g1, sizeof f->g0);
}

/* Where the gap is `at`, coming from the closed end. */
static double front(const Front *f, double at) {
  int by = f->opens_left ? -1 : 1;
  size_t i = f->opens_left ? STATIONS - 1 : 0;
  while (f->g0[(size_t)((int)i + by)] < at)
    i = (size_t)((int)i + by);
  double here = f->g0[i], next = f->g0[(size_t)((int)i + by)];
  return f->film.l * ((double)i + by * (at - here) / (next - here));
}

/* Closed by a film of `film` up to x, open beyond with that curvature. */
static void lay(Front *f, double film, double x) {
  for (size_t i = 0; i < STATIONS; i++) {
    double s = (double)i * f->film.l - x;
    if (f->opens_left) s = -s;
    f->g0[i] = film + (s > 0 ? 0.5 * f->curvature * s * s : 0);
  }
}

/* -- peeling --------------------------------------------------------------------------------------- */

/* A ribbon that is lifted off a film of depth h0 by bending with curvature kappa: speed B h0^(1/2) (kappa
 * / 1.350)^(5/2) / (12 mu), B the stiffness over the width; the film is thinnest ahead of the front, 0.785 h0. Any h0.
 */
START_TEST(test_peeling) {
  static const double h0[] = {1e-7, 1e-6, 1e-5, 1e-4};
  double depth = h0[_i], w = 12.7e-3, mu = 0.048e-6, stiffness = 1.44e-11, kappa = 60; /* no cavities */
  double length = sqrt(1.350 * depth / kappa), base = kappa / 1.350;
  double speed = stiffness / w * sqrt(depth) * base * base * sqrt(base) / (12 * mu);
  Front *f = make_front(stiffness, mu, w, 0.12 * length);
  f->curvature = kappa;
  f->h = 0.1 * length / speed;
  open_at(f, true);
  lay(f, depth, 160 * length);
  double from = 0, thinnest = depth;
  for (int k = 0; k < 400; k++) {
    if (k == 200) from = front(f, 2 * depth);
    step(f);
  }
  for (size_t i = 0; i < STATIONS; i++)
    thinnest = fmin(thinnest, f->g0[i]);
  double found = (front(f, 2 * depth) - from) / (200 * f->h);
  printf("film of %g um: speed %.4f of the law, thinnest %.4f of the film\n", 1e6 * depth, found / speed,
         thinnest / depth);
  ck_near(found, speed, 0.01);
  ck_near(thinnest, 0.785 * depth, 0.01);
  free_front(f);
}
END_TEST

/* -- zipping --------------------------------------------------------------------------------------- */

/* Units: l = (EI' d^2 / (2 F))^(1/4), speed F d / (12 mu w l), d; K is the curvature far ahead over that of balance, 2
 * sqrt(F / EI'). Travelling waves of the same equations, solved as boundary-value problems, have these speeds and leave
 * these films. (Far behind, attraction makes a film uneven in the end, which a longer run would show.) */
START_TEST(test_zipping) {
  static const double K[] = {0.3, 0.5, 0.7}, speed[] = {0.3030, 0.2476, 0.1411}, film[] = {0.505, 0.3191, 0.1559};
  Front *f = make_front(1, 1.0 / 12, 1, 0.19);
  f->F = f->d = 1;
  f->curvature = sqrt(2) * K[_i];
  f->h = 0.1 / speed[_i];
  open_at(f, false);
  lay(f, film[_i], 25);
  double from = 0;
  for (int k = 0; k < 500; k++) {
    if (k == 200) from = front(f, 1);
    step(f);
  }
  double at = front(f, 1), found = (at - from) / (300 * f->h), left = f->g0[(size_t)((at - 10) / f->film.l)];
  printf("K = %g: speed %.4f, film %.4f of the travelling wave's\n", K[_i], found / speed[_i], left / film[_i]);
  ck_near(found, speed[_i], 0.02);
  ck_near(left, film[_i], 0.02);
  free_front(f);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("front");
  TCase *fronts = tcase_create("fronts");

  tcase_add_loop_test(fronts, test_peeling, 0, 4);
  tcase_add_loop_test(fronts, test_zipping, 0, 3);
  suite_add_tcase(suite, fronts);
  return run_suite(suite);
}
