/* Searches for designs, without the command: values and derivatives of goals, cells of a box that has no design, starts
 * of local searches, generations, what a second call takes from the first. The strip is weightless, clamped and guided,
 * and bends by P L^3 (1 - nu^2) / (E w b^3). */
#include "data_util.h"

#include <sys/stat.h>

#include <zipact/optimize.h>

#include "campaign/case_hash.h"
#include "optimize/search.h"

#define STRIP                                                                                                          \
  "study=stationary", "actuator.kind=ribbon", "actuator.right_end=guided", "ribbon.density=0", "load.mass=10 mg",      \
      "ribbon.width=20 mm", "mesh.nodes=9", "output.errors=false"
#define THICKNESS "optimize.variables=ribbon.thickness = 40 um .. 60 um log"
#define BOTH      "optimize.variables=ribbon.thickness = 40 um .. 60 um; ribbon.width = 5 mm .. 20 mm"

/* How the logarithm of the strip's stroke changes over the range of its thickness. */
static const double steepness = 3 * 0.40546510810816438; /* 3 log(60 / 40) */

/* P L^3 (1 - nu^2) / (E w b^3), m, with P = 10 mg g. */
static double stroke_of(double width, double thickness) {
  return 10e-6 * 9.81 * 1e-3 * (1 - 0.285 * 0.285) / (200e9 * width * thickness * thickness * thickness);
}

/* Of the strip of 60 um, m. */
static double least_stroke(void) {
  return stroke_of(20e-3, 60e-6);
}

typedef struct Bench {
  ZpScenario *scenario;
  ZpCampaignOptions options;
  ZpSearch search;
} Bench;

/* The goals have the units of a result in the middle of the box. */
static void resolve_goals(ZpSearch *s) {
  ZpResult *result = data_study_of(s->study, &s->def);
  ck_ok(zp_problem_resolve(&s->problem, result, &err));
}

/* Nothing is left in it from a test that was killed. */
static void make_empty(const char *folder) {
  char path[64];
  mkdir(folder, 0777);
  snprintf(path, sizeof path, "%s/journal.sqlite", folder);
  remove(path);
}

/* A search that has no case yet. */
static void open_bench(Bench *b, const char *folder, const char *const *sets) {
  ZpError err;
  *b = (Bench){.scenario = scenario_with(sets), .options = {.jobs = 2}};
  ZpSearch *s = &b->search;
  s->scenario = b->scenario;
  s->options = &b->options;
  ck_ok(zp_search_begin(s, &err));
  resolve_goals(s);
  s->room = 2 * s->problem.evaluations;
  s->excluded = NAN;
  s->old = calloc(s->room * zp_search_samples(s), sizeof *s->old);
  s->point = calloc(s->room, sizeof *s->point);
  ck_assert_int_eq(pthread_mutex_init(&s->lock, NULL), 0);
  make_empty(folder);
  ck_assert_int_eq(zp_campaign_hash(s->study, &s->def, &s->start, &err), ZP_OK);
  ck_ok(zp_journal_open(folder, s->study, false, s->room * zp_search_samples(s), &s->journal, &err));
}
#define OPEN(bench, folder, ...) open_bench(bench, folder, (const char *const[]){__VA_ARGS__, NULL})

static void close_bench(Bench *b) {
  zp_journal_close(b->search.journal);
  zp_search_end(&b->search);
  zp_scenario_destroy(b->scenario);
  free(b->search.old);
  free(b->search.point);
}

static const ZpPoint *evaluate(Bench *b, size_t number, double z0, double z1) {
  ck_assert(zp_search_evaluate(&b->search, number, (double[ZP_VARIABLES_MOST]){z0, z1}));
  return &b->search.point[number];
}

static size_t done_of(const ZpSearch *s) {
  size_t done = 0;
  for (size_t i = 0; i < s->room; i++)
    done += s->point[i].done;
  return done;
}

/* -- goals ------------------------------------------------------------------------------------------ */

/* Two outputs and two variables, one of them by factors: the derivatives of a case are those of its goals. */
TEST(slopes_are_those_of_goals) {
  Bench b;
  OPEN(&b, "slopes", "study=stationary", "mesh.nodes=9", "output.errors=false", "solver.tolerance=1e-8",
       "optimize.variables=ribbon.thickness = 40 um .. 60 um log; ribbon.width = 10 mm .. 20 mm",
       "optimize.objective=max stroke_m", "optimize.constraints=opening_m <= 7 mm", "optimize.evaluations=20");
  static const double step = 1e-3;
  b.search.derivatives = true;
  const ZpPoint *at = evaluate(&b, 0, 0.3, 0.6);
  for (size_t k = 0; k < 2; k++) {
    const ZpPoint *up = evaluate(&b, 1, 0.3 + (k == 0) * step, 0.6 + (k == 1) * step);
    const ZpPoint *down = evaluate(&b, 2, 0.3 - (k == 0) * step, 0.6 - (k == 1) * step);
    for (int g = 0; g < 2; g++)
      ck_near(at->slope[g][k], (up->value[g] - down->value[g]) / (2 * step),
              8e-7); /* 2.6e-7 measured, of second order */
  }
  close_bench(&b);
}

/* With keys that are drawn, of numbers of the distribution: the same samples stand for all designs. */
TEST(slopes_over_samples) {
  Bench b;
  OPEN(&b, "samples", "study=stationary", "mesh.nodes=9", "output.errors=false", "solver.tolerance=1e-8", BOTH,
       "ribbon.young_modulus=normal(200 GPa, 10 GPa)", "medium.permittivity=uniform(2.5, 3)", "sampling.count=20",
       "optimize.objective=max stroke_m; min stroke_m.standard_deviation; min opening_m.max",
       "optimize.constraints=opening_m <= 7 mm; stroke_m >= 1 mm", "optimize.evaluations=20");
  static const double step = 1e-4;
  ck_assert_uint_eq(zp_search_samples(&b.search), 20);
  b.search.derivatives = true;
  const ZpPoint *at = evaluate(&b, 0, 0.3, 0.6);
  for (size_t k = 0; k < 2; k++) {
    const ZpPoint *up = evaluate(&b, 1, 0.3 + (k == 0) * step, 0.6 + (k == 1) * step);
    const ZpPoint *down = evaluate(&b, 2, 0.3 - (k == 0) * step, 0.6 - (k == 1) * step);
    for (int g = 0; g < 5; g++)
      ck_near(at->slope[g][k], (up->value[g] - down->value[g]) / (2 * step), 2e-8); /* 6.6e-9 measured */
  }
  close_bench(&b);
}

TEST(goals_in_closed_form) {
  ZpProblem p = {.objectives = 2, .goals = 3};
  const double good[] = {1, 2, -0.5}, first[] = {0.5, 3, 0}, worse[] = {1, 2.5, 0}, misses[] = {0, 0, 0.5},
               touches[] = {1, 2, 0.9e-6}, just[] = {1, 2, 1.1e-6}, none[] = {1, 2, NAN};
  ck_assert_double_eq(zp_violation(&p, good), 0);
  ck_assert_double_eq(zp_violation(&p, touches), 0);
  ck_assert_double_eq(zp_violation(&p, just), 1.1e-6);
  ck_assert_double_eq(zp_violation(&p, misses), 0.5);
  ck_assert_double_gt(zp_violation(&p, none), 100);
  ck_assert(zp_dominates(&p, good, worse) && !zp_dominates(&p, worse, good) && !zp_dominates(&p, good, good));
  ck_assert(!zp_dominates(&p, first, good) && !zp_dominates(&p, good, first));
  ck_assert(zp_dominates(&p, good, misses) && !zp_dominates(&p, misses, good) && zp_dominates(&p, misses, none));
  ck_assert(zp_is_better(&p, first, good) && zp_is_better(&p, good, misses) && !zp_is_better(&p, misses, good));
}

/* -- local searches --------------------------------------------------------------------------------- */

/* The study has no derivatives of the stress, 3 P L / (w b^2), whose lever L falls by 0.6 of the squared slope of a
 * deflected strip. The greatest is that of the thinnest and narrowest strip; a search for it from the other corner
 * takes differences that stay in the box. */
TEST(differences_stay_in_the_box) {
  Bench b;
  OPEN(&b, "corner", STRIP, BOTH, "optimize.objective=max max_stress_Pa", "optimize.method=slsqp",
       "optimize.evaluations=40");
  ZpSearch *s = &b.search;
  evaluate(&b, 0, 1, 1);
  ck_assert_int_eq(zp_search_local_from(s, 0, 1, NULL), ZP_OK);
  double most = 0;
  for (size_t i = 0; i < s->room; i++) {
    ck_assert(s->point[i].z[0] >= 0 && s->point[i].z[0] <= 1 && s->point[i].z[1] >= 0 && s->point[i].z[1] <= 1);
    if (s->point[i].done) most = fmax(most, -s->point[i].value[0]);
  }
  const double slope = 10e-6 * 9.81 * 1e-2 * (1 - 0.285 * 0.285) / (200e9 * 5e-3 * 40e-6 * 40e-6 * 40e-6);
  ck_near(most, 3 * 10e-6 * 9.81 * 0.1 / (5e-3 * 40e-6 * 40e-6) * (1 - 0.6 * slope * slope),
          1.5e-6); /* 5.2e-7 measured, of the mesh */
  close_bench(&b);
}

/* The widest strip has the least stress where its stroke is large enough: a constraint with derivatives and an
 * objective without. Values of very different size converge in some steps only if derivatives have their scale. */
TEST(derivatives_have_the_scale_of_values) {
  Bench b;
  char bound[80];
  const double stroke = 2 * least_stroke();
  snprintf(bound, sizeof bound, "optimize.constraints=stroke_m <= %.12g um", 1e6 * stroke);
  OPEN(&b, "scale", STRIP, "optimize.variables=ribbon.thickness = 40 um .. 60 um", "optimize.objective=max stroke_m",
       bound, "optimize.method=slsqp", "optimize.evaluations=10");
  ZpSearch *s = &b.search;
  b.search.derivatives = true;
  evaluate(&b, 0, 1, 0);
  ck_assert_int_eq(zp_search_local_from(s, 0, 1, NULL), ZP_OK);
  double best = 0;
  for (size_t i = 0; i < s->room; i++)
    if (s->point[i].done && zp_violation(&s->problem, s->point[i].value) == 0) best = fmax(best, -s->point[i].value[0]);
  printf("%zu cases, %.3g below the bound\n", done_of(s), 1 - best / stroke);
  ck_near(best, stroke, 2e-8); /* 6.4e-9 measured */
  close_bench(&b);
}

/* Four searches, each with its share of the cases, from sampled points that are far enough from each other. */
TEST(starts_are_apart) {
  enum { SAMPLED = 20, STARTS = 4, SHARE = (80 - SAMPLED) / STARTS };
  Bench b;
  OPEN(&b, "starts", STRIP, BOTH, "optimize.objective=max stroke_m", "optimize.method=cobyla",
       "optimize.evaluations=80");
  ZpSearch *s = &b.search;
  ck_assert_int_eq(zp_search_sample(s, SAMPLED, NULL), ZP_OK);
  ck_assert_int_eq(zp_search_local(s, SAMPLED, NULL), ZP_OK);
  for (size_t k = 0; k < STARTS; k++) {
    const ZpPoint *start = &s->point[SAMPLED + k * SHARE];
    size_t same = 0;
    ck_assert(start->done);
    for (size_t i = 0; i < SAMPLED; i++)
      same += memcmp(s->point[i].z, start->z, 2 * sizeof *start->z) == 0;
    ck_assert_uint_eq(same, 1);
    for (size_t j = 0; j < k; j++) {
      const double *other = s->point[SAMPLED + j * SHARE].z;
      ck_assert_double_ge(fmax(fabs(other[0] - start->z[0]), fabs(other[1] - start->z[1])), 0.15);
    }
  }
  close_bench(&b);
}

/* -- cells of a box without a design ----------------------------------------------------------------- */

/* A stroke that is `beyond` times the steepness below the least, or above the most, of the strips in the box, in
 * logarithms. By the law of the strip a cell with half size h, whose near end is 2 h away from its centre at most, is
 * excluded where its centre is further from the bound than twice its steepness allows: 5 cells for 0.1, 9 for 0.01. */
static void exclude(Bench *b, const char *bound, double beyond) {
  char text[80];
  const bool upper = *bound == '<';
  const double stroke = least_stroke() * exp(upper ? -beyond * steepness : (1 + beyond) * steepness);
  snprintf(text, sizeof text, "optimize.constraints=stroke_m %s %.12g um", bound, 1e6 * stroke);
  OPEN(b, "cells", STRIP, THICKNESS, "optimize.objective=max stroke_m", text, "optimize.evaluations=10");
  ck_assert_int_eq(zp_search_exclude(&b->search, NULL), ZP_OK);
  const ZpPoint *cell = &b->search.point[b->search.problem.evaluations];
  const double sign = upper ? 1 : -1; /* the far end of the box is excluded first */
  ck_near(cell[0].z[0], 0.5, 1e-15);
  ck_near(cell[1].z[0], 1 / 6.0, 1e-14);
  ck_near(cell[2].z[0], 5 / 6.0, 1e-14);
  ck_near(cell[3].z[0] + cell[4].z[0], 1 + sign * 2 / 3.0, 1e-14);
  ck_near(fabs(cell[3].z[0] - cell[4].z[0]), 2 / 9.0, 1e-13);
}

TEST(cells_are_excluded_as_far_as_slopes_allow) {
  static const double beyond[] = {0.1, 0.01, 0.001};
  static const size_t cells[] = {5, 9, 9};
  for (int k = 0; k < 6; k++) {
    Bench b;
    exclude(&b, k < 3 ? "<=" : ">=", beyond[k % 3]);
    ck_assert_uint_eq(done_of(&b.search), cells[k % 3]);
    ck_near(b.search.excluded, k % 3 < 2 ? 1 : 80 / 81.0, 1e-14); /* ten cases are not enough for 0.001 */
    close_bench(&b);
  }
}

/* -- generations ------------------------------------------------------------------------------------- */

/* Which coordinates of the first children are copies of one of their parents. */
static void evolve(Bench *b, const char *seed, bool copied[8][2]) {
  OPEN(b, "seeds", STRIP, BOTH, "optimize.objective=max stroke_m; min max_stress_Pa", "optimize.evaluations=160", seed);
  ZpSearch *s = &b->search;
  ck_assert_int_eq(zp_search_evolve(s, NULL), ZP_OK);
  ck_assert_uint_eq(done_of(s), 160); /* all twenty generations of eight */
  for (size_t i = 0; i < 8; i++)
    for (int j = 0; j < 2; j++) {
      copied[i][j] = false;
      for (size_t k = 0; k < 8; k++)
        copied[i][j] |= s->point[8 + i].z[j] == s->point[k].z[j];
    }
}

TEST(generations_depend_on_the_seed) {
  Bench b[2];
  bool copied[2][8][2];
  evolve(&b[0], "sampling.seed=1", copied[0]);
  evolve(&b[1], "sampling.seed=2", copied[1]);
  ck_assert(b[0].search.point[0].z[0] != b[1].search.point[0].z[0]);
  ck_assert(memcmp(copied[0], copied[1], sizeof copied[0]) != 0);
  close_bench(&b[0]);
  close_bench(&b[1]);
}

/* Much stroke for little stress: the front goes from the widest and thickest strip to the thinnest and narrowest. The
 * place of the stress is always the clamp: as first objective it tells no members apart, the others keep them apart. */
TEST(fronts_reach_both_ends) {
  enum { MEMBERS = 40 };
  Bench b;
  OPEN(&b, "front", STRIP, BOTH, "optimize.objective=min max_stress_place_m; max stroke_m; min max_stress_Pa",
       "optimize.evaluations=800");
  ZpSearch *s = &b.search;
  ck_assert_int_eq(zp_search_evolve(s, NULL), ZP_OK);
  double thickest = 0, narrowest = 1;
  for (size_t i = 0; i < 800; i++) {
    bool dominated = false;
    for (size_t j = 0; j < 800 && !dominated; j++)
      dominated = zp_dominates(&s->problem, s->point[j].value, s->point[i].value);
    if (dominated) continue;
    if (i >= MEMBERS) thickest = fmax(thickest, s->point[i].z[0]); /* of a child */
    narrowest = fmin(narrowest, s->point[i].z[1]);
  }
  double drift = 0; /* of the first children from their parents, on average: crossing favours neither side */
  for (size_t i = 0; i < MEMBERS; i++)
    for (int j = 0; j < 2; j++)
      drift += (s->point[MEMBERS + i].z[j] - s->point[i].z[j]) / (2 * MEMBERS);
  printf("front: thickest %.3f, narrowest %.3f, drift %.3f\n", thickest, narrowest, drift);
  ck_assert_double_lt(fabs(drift), 0.1);
  ck_assert_double_gt(thickest, 0.95);
  ck_assert_double_lt(narrowest, 0.005);
  close_bench(&b);
}

/* -- whole optimisations ----------------------------------------------------------------------------- */

static ZpOptimization *optimize(const char *folder, bool resume, const char *const *sets) {
  ZpOptimization *o;
  ZpScenario *scenario = scenario_with(sets);
  const ZpCampaignOptions options = {.jobs = 2, .resume = resume};
  if (!resume) make_empty(folder);
  ck_ok(zp_optimize(scenario, folder, &options, &o, &err));
  return o;
}
#define OPTIMIZE(folder, resume, ...) optimize(folder, resume, (const char *const[]){__VA_ARGS__, NULL})

static double row_value(const ZpReport *report, size_t row, const char *name) {
  return zp_result_get(report->rows->get(report->rows->user, row), name);
}

/* Rows of the same cases are taken, those of another load are not. The best row is the one that is reported. */
TEST(resumed_rows_are_of_the_same_case) {
#define CASE(load)                                                                                                     \
  STRIP, BOTH, "optimize.objective=max stroke_m", "optimize.constraints=stroke_m <= 0.2 mm",                           \
      "optimize.evaluations=32", load
  ZpOptimization *first = OPTIMIZE("again", false, CASE("load.mass=10 mg")),
                 *same = OPTIMIZE("again", true, CASE("load.mass=10 mg"));
  const size_t rows = zp_optimization_report(first)->count;
  ck_assert_uint_eq(zp_optimization_state(first).resumed, 0);
  ck_assert_uint_eq(zp_optimization_state(first).done, rows);
  ck_assert_uint_eq(zp_optimization_state(same).resumed, rows);
  zp_optimization_destroy(same);
  zp_optimization_destroy(first);
  ZpOptimization *other = OPTIMIZE("again", true, CASE("load.mass=11 mg")),
                 *fresh = OPTIMIZE("fresh", false, CASE("load.mass=11 mg"));
  const ZpReport *a = zp_optimization_report(other), *b = zp_optimization_report(fresh);
  ck_assert_uint_eq(zp_optimization_state(other).resumed, 0);
  ck_assert(a->count == b->count && a->optimum->row[0] == b->optimum->row[0] && a->optimum->feasible);
  for (size_t i = 0; i < a->count; i++) {
    const double stroke = row_value(a, i, "stroke_m");
    ck_assert_double_eq(stroke, row_value(b, i, "stroke_m"));
    ck_assert(stroke > 0.2e-3 * (1 + 2e-6) || stroke <= row_value(a, a->optimum->row[0], "stroke_m"));
  }
  ck_near(row_value(a, a->optimum->row[0], "stroke_m"), 0.2e-3, 1.2e-6); /* 4.3e-7 measured; 1e-6 is no violation */
  zp_optimization_destroy(other);
  zp_optimization_destroy(fresh);
}

/* The scenario of the report has the thickness and the width of each of its rows. */
TEST(rows_have_their_variables) {
  ZpOptimization *o =
      OPTIMIZE("rows", false, STRIP, BOTH, "optimize.objective=min stroke_m", "optimize.evaluations=16");
  const ZpReport *report = zp_optimization_report(o);
  ck_assert_uint_gt(report->count, 8);
  for (size_t i = 0; i < report->count; i++) {
    ZpActuatorDef def = {0};
    ck_assert_int_eq(zp_scenario_def(report->scenario, i, &def, NULL), ZP_OK);
    ck_near(row_value(report, i, "stroke_m"), stroke_of(def.ribbon.width, def.ribbon.thickness),
            1e-4); /* 3.4e-5 measured: the arm becomes shorter */
  }
  zp_optimization_destroy(o);
}

/* A run that ends at a limit of steps has numbers, but no answer: no case satisfies anything. */
TEST(failed_cases_have_no_goals) {
  ZpOptimization *o =
      OPTIMIZE("failed", false, "study=actuate", "mesh.nodes=5", "liquid.model=none", "output.errors=false",
               "solver.max_steps=3", "optimize.variables=drive.voltage = 6 kV .. 10 kV",
               "optimize.objective=max contraction", "optimize.method=cobyla", "optimize.evaluations=10");
  const ZpReport *report = zp_optimization_report(o);
  ck_assert(isfinite(row_value(report, 0, "contraction")));
  ck_assert(!report->optimum->feasible);
  ck_assert_uint_eq(zp_optimization_state(o).failed, report->count);
  zp_optimization_destroy(o);
}
