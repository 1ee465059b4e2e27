/* The film of liquid on its own: plates that approach, a wedge that closes, what it dissipates; closed forms of
 * docs/theory.md, section 20. No actuator here. */
#include "check_util.h"

#include "liquid/film.h"
#include "math/band.h"

enum { MOST = 1001 };

typedef struct Film {
  ZpFilmParams params;
  ZpFilmEval eval;
  double g0[MOST], g1[MOST], p[ZP_FILM_MODES * MOST], h;
  void *memory;
} Film;

static Film *make_film(size_t nodes, double length, double w, bool lateral_flow) {
  Film *f = calloc(1, sizeof *f);
  f->params = (ZpFilmParams){.nodes = nodes, .l = length / (double)(nodes - 1), .w = w, .mu = 0.048};
  f->h = 1e-6;
  zp_film_modes(&f->params, lateral_flow);
  ZpCarver carver = {NULL, 0};
  zp_film_carve(&f->params, &f->eval, &carver);
  f->memory = zp_calloc(1, carver.used);
  carver = (ZpCarver){f->memory, 0};
  zp_film_carve(&f->params, &f->eval, &carver);
  return f;
}

static void free_film(Film *f) {
  zp_free(f->memory);
  free(f);
}

/* The pressures that the change of the gaps makes: of each mode a symmetric system, linear, so one step of Newton's
 * method from 0 is exact. */
static void solve(Film *f) {
  size_t n = f->params.nodes;
  memset(f->p, 0, sizeof f->p);
  zp_film_step(&f->params, f->g0, f->g1, f->h, f->p, &f->eval);
  for (int k = 0; k < ZP_FILM_MODES; k++) {
    if (f->params.share[k] == 0) continue;
    ZpBand A;
    ZpCarver carver = {NULL, 0};
    zp_band_carve(&A, n, 0, 1, &carver);
    void *memory = zp_calloc(1, carver.used);
    carver = (ZpCarver){memory, 0};
    zp_band_carve(&A, n, 0, 1, &carver);
    double *r = calloc(n, sizeof *r);
    for (size_t i = 0; i < n; i++) {
      *zp_band_at(&A, i, i) = zp_film_own(&f->params, f->h, &f->eval, i, k);
      if (i + 1 < n) *zp_band_at(&A, i, i + 1) = zp_film_next(&f->params, f->h, &f->eval, i, k);
      r[i] = f->eval.r[ZP_FILM_MODES * i + (size_t)k];
    }
    ck_assert(zp_band_factor(&A));
    zp_band_solve(&A, r);
    for (size_t i = 0; i < n; i++)
      f->p[ZP_FILM_MODES * i + (size_t)k] = r[i];
    free(r);
    zp_free(memory);
  }
  zp_film_step(&f->params, f->g0, f->g1, f->h, f->p, &f->eval);
}

static double force(const Film *f) {
  double sum = 0;
  for (size_t i = 0; i < f->params.nodes; i++)
    sum += f->eval.force[i];
  return sum;
}

static void plates(Film *f, double gap, double speed) {
  for (size_t i = 0; i < f->params.nodes; i++) {
    f->g0[i] = gap;
    f->g1[i] = gap - speed * f->h;
  }
}

/* Parallel plates of length l and width w that approach, with an outlet all around: over mu l w^3 speed / gap^3 the
 * exact answer (a series) is phi. The strip is half a plate, mirrored at its first station, with an outlet at its last.
 * The second mode stands for all others: within 3.1 % of a plate ten times as wide as long, 0.6 % from twice as wide
 * on. */
START_TEST(test_plates_of_all_shapes) {
  static const struct {
    double ratio, phi, error;
  } shape[] = {{0.1, 0.0094, 0.032}, {0.25, 0.05265, 0.021}, {0.5, 0.17151, 0.006},
               {1, 0.42173, 0.0014}, {2, 0.68605, 0.001},    {4, 0.84244, 0.001}};
  double w = 12.7e-3, gap = 1e-4, speed = 0.01, l = shape[_i].ratio * w;
  Film *f = make_film(801, l / 2, w, true);
  f->params.outlet = true;
  plates(f, gap, speed);
  solve(f);
  double scale = f->params.mu * l * w * w * w * speed / (gap * gap * gap), phi = 2 * force(f) / scale;
  printf("l/w = %g: phi = %.5f\n", shape[_i].ratio, phi);
  if (shape[_i].ratio > 0.1) ck_near(phi, shape[_i].phi, shape[_i].error);
  free_film(f);
}
END_TEST

/* A long strip, Stefan: mu w^3 speed / gap^3 per length. */
START_TEST(test_strip) {
  double w = 12.7e-3, gap = 5e-5, speed = 0.02, l = 1;
  Film *f = make_film(201, l, w, true);
  plates(f, gap, speed);
  solve(f);
  ck_near(force(f) / l, f->params.mu * w * w * w * speed / (gap * gap * gap), 1e-9);
  free_film(f);
}
END_TEST

/* A wedge gap = angle x that closes by turning, sealed at its tip, without lateral flow: force per width
 * 6 mu speed l / angle^3, moment 3/2 mu speed l^2 / angle^3. The tip itself, where the gap is 0, is taken as closed.
 * => moment over the closed form - 1 */
static double wedge(size_t nodes, double *force_error) {
  double w = 12.7e-3, l = 0.02, angle = 0.02, speed = 0.5;
  Film *f = make_film(nodes, l, w, false);
  for (size_t i = 0; i < nodes; i++) {
    double x = (double)i * f->params.l;
    f->g0[i] = angle * x;
    f->g1[i] = (angle - speed * f->h) * x;
  }
  solve(f);
  double moment = 0, cubed = angle * angle * angle;
  for (size_t i = 0; i < nodes; i++)
    moment += f->eval.force[i] * (double)i * f->params.l;
  *force_error = force(f) / (w * 6 * f->params.mu * speed * l / cubed) - 1;
  free_film(f);
  return moment / (w * 1.5 * 0.048 * speed * l * l / cubed) - 1;
}

START_TEST(test_wedge) {
  double coarse, fine, moment = wedge(61, &coarse);
  wedge(121, &fine);
  printf("wedge: moment off by %.1e, force by %.2e, %.2e\n", moment, coarse, fine);
  ck_below(fabs(moment), 1e-9);
  ck_below(fabs(fine), 0.02);
  ck_near(fine / coarse, 0.5, 0.15); /* the pressure has a logarithm at the tip */
}
END_TEST

/* What it dissipates is the work against it, for any shape and motion, with the floor of the roughness as well; it is
 * never less than 0. */
START_TEST(test_work_is_loss) {
  uint64_t seed = 3;
  Film *f = make_film(61, 0.045, 12.7e-3, true);
  f->params.roughness = 2e-6;
  f->params.end_length = 5e-3;
  for (int k = 0; k < 100; k++) {
    double work = 0, size = 0;
    for (size_t i = 0; i < f->params.nodes; i++) {
      f->g0[i] = 1e-5 + 1e-4 * (1 + noise(&seed));
      f->g1[i] = f->g0[i] + 1e-7 * noise(&seed);
      f->eval.rate[i] = 0.1 * noise(&seed);
    }
    solve(f);
    for (size_t i = 0; i < f->params.nodes; i++) {
      work -= f->eval.force[i] * (f->g1[i] - f->g0[i]);
      size += fabs(f->eval.force[i] * (f->g1[i] - f->g0[i]));
    }
    double loss = zp_film_loss(&f->params, f->h, f->p, &f->eval);
    ck_assert_double_gt(loss, 0);
    ck_below(fabs(work - loss) / size, 1e-11);
  }
  free_film(f);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("film");
  TCase *forms = tcase_create("closed forms");
  tcase_add_loop_test(forms, test_plates_of_all_shapes, 0, 6);
  tcase_add_test(forms, test_strip);
  tcase_add_test(forms, test_wedge);
  tcase_add_test(forms, test_work_is_loss);
  suite_add_tcase(suite, forms);
  return run_suite(suite);
}
