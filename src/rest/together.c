#include "rest/together.h"

#include <math.h>
#include <string.h>

#include "def/check.h"
#include "rest/closing.h"
#include "solve/descend.h"

static ZpStatics *member(const ZpTogether *all, size_t which) {
  return (ZpStatics *)&all->of[which].statics;
}

/* -- equations -------------------------------------------------------------------------------------- */

/* Equations of one alone, and which of them is the height of the load. */
static size_t own_count(const ZpTogether *all, size_t which) {
  return member(all, which)->assembly.n;
}

static size_t own_load(const ZpTogether *all, size_t which) {
  return zp_statics_platform(member(all, which));
}

/* An equation of one => of all, where there are two. Those of the first one come first, those of the second one follow
 * from its platform back to its clip, so that the matrix stays a narrow band; the height of the load is one equation.
 */
static size_t place_of_two(const ZpTogether *all, size_t which, size_t i) {
  if (which == 0) return i;
  size_t count = own_count(all, 1), load = own_load(all, 1), back = own_count(all, 0) + count - 1 - i;
  if (i == load) return own_load(all, 0);
  return i < load ? back - 1 : back;
}

/* More than two members have the same equations; those of the same number are adjacent. */
static size_t place_of(const ZpTogether *all, size_t which, size_t i) {
  size_t load = own_load(all, which);
  if (all->count == 2) return place_of_two(all, which, i);
  if (i < load) return all->count * i + which;
  return i == load ? all->count * load : all->count * (i - 1) + 1 + which;
}

/* Upside down, the platform of the lower antagonist falls as the load rises. */
static double turn_of(const ZpTogether *all, size_t which) {
  return which > 0 && all->distance > 0 ? -1 : 1;
}

static double sign_of(const ZpTogether *all, size_t which, size_t i) {
  return i == own_load(all, which) ? turn_of(all, which) : 1;
}

static size_t bandwidth_of(const ZpTogether *all) {
  size_t own = member(all, 0)->assembly.bandwidth, beyond = 0;
  if (all->count > 2) return all->count * own + all->count - 1;
  for (size_t which = 0; which < all->count; which++)
    beyond += own_count(all, which) - 1 - own_load(all, which);
  return own + beyond;
}

/* Add forces on one to those on all. */
static void add(const ZpTogether *all, size_t which, const double *own, double *r) {
  for (size_t i = 0; i < own_count(all, which); i++)
    r[place_of(all, which, i)] += sign_of(all, which, i) * own[i];
}

void zp_together_part(const ZpTogether *all, const double *step) {
  for (size_t which = 0; which < all->count; which++)
    for (size_t i = 0; i < own_count(all, which); i++)
      all->step[which][i] = sign_of(all, which, i) * step[place_of(all, which, i)];
}

/* -- the system ------------------------------------------------------------------------------------- */

static double scale_of(const ZpTogether *all) {
  double scale = 0;
  for (size_t which = 0; which < all->count; which++)
    scale = fmax(scale, member(all, which)->scale);
  return scale;
}

static ZpEnd residual(void *self, double *r, double *size) {
  ZpTogether *all = self;
  size_t n = all->system.at_rest.n;
  double largest = 0;
  memset(r, 0, n * sizeof *r);
  for (size_t which = 0; which < all->count; which++) {
    double *own = all->of[which].branch.newton.r;
    ZpEnd end = all->alone[which].residual(member(all, which), own, NULL);
    if (end != ZP_END_FOUND) return end;
    add(all, which, own, r);
  }
  for (size_t i = 0; i < n && !isnan(largest); i++)
    if (!(fabs(r[i]) <= largest)) largest = fabs(r[i]);
  if (size) *size = largest / scale_of(all);
  return isfinite(largest) ? ZP_END_FOUND : ZP_END_SHORTER;
}

/* Add the stiffness of one to that of all. */
static void add_stiffness(const ZpTogether *all, size_t which, ZpBand *K) {
  const ZpBand *own = &all->of[which].branch.newton.K;
  for (size_t i = 0; i < own->n; i++)
    for (size_t j = i > own->lower ? i - own->lower : 0; j < zp_band_end(own, i); j++) {
      size_t row = place_of(all, which, i), column = place_of(all, which, j);
      double value = sign_of(all, which, i) * sign_of(all, which, j) * *zp_band_at(own, i, j);
      bool turned = own->lower == 0 && row > column; /* only the upper triangle is kept */
      *zp_band_at(K, turned ? column : row, turned ? row : column) += value;
    }
}

/* Its terms on top of the band, from term `first` on. */
static void add_top(const ZpTogether *all, size_t which, size_t first, ZpBand *K) {
  const ZpBand *own = &all->of[which].branch.newton.K;
  for (size_t k = 0; k < own->rank; k++)
    for (size_t i = 0; i < own->n; i++) {
      size_t from = k * own->n + i, to = (first + k) * K->n + place_of(all, which, i);
      K->u[to] += sign_of(all, which, i) * own->u[from];
      K->v[to] += sign_of(all, which, i) * own->v[from];
    }
}

static void stiffness(void *self, ZpBand *K, double *r) {
  ZpTogether *all = self;
  (void)r; /* nothing is moved as prescribed */
  size_t first = 0;
  zp_band_clear(K);
  for (size_t which = 0; which < all->count; which++) {
    all->alone[which].stiffness(member(all, which), &all->of[which].branch.newton.K, NULL);
    add_stiffness(all, which, K);
    add_top(all, which, first, K);
    first += member(all, which)->form.rank;
  }
}

/* The largest of a measure of a step, over all members. */
static double largest_of(ZpTogether *all, const double *step, double (*measure)(void *self, const double *step)) {
  double largest = 0;
  zp_together_part(all, step);
  for (size_t which = 0; which < all->count; which++)
    largest = fmax(largest, measure(member(all, which), all->step[which]));
  return largest;
}

static double length(void *self, const double *step) {
  ZpTogether *all = self;
  return largest_of(all, step, all->alone[0].length);
}

static double change(void *self, const double *step) {
  ZpTogether *all = self;
  return largest_of(all, step, all->alone[0].change);
}

/* Each member places the load slightly differently, by a term of second order; the load moves to the mean of these
 * places. */
static void move(void *self, const double *step, double fraction) {
  ZpTogether *all = self;
  double height[ZP_MOST_MEMBERS] = {0}, missed[ZP_MOST_MEMBERS] = {0}, mean = 0;
  zp_together_part(all, step);
  for (size_t which = 0; which < all->count; which++) {
    all->alone[which].move(member(all, which), all->step[which], fraction);
    height[which] = -zp_statics_opening(member(all, which));
    missed[which] = which == 0 ? 0 : height[0] - turn_of(all, which) * height[which] + all->distance;
    mean += missed[which] / (double)all->count;
  }
  for (size_t which = 0; which < all->count; which++)
    zp_statics_put_platform(member(all, which), height[which] + turn_of(all, which) * (missed[which] - mean));
}

/* -- along the voltage ------------------------------------------------------------------------------ */

static const ZpModel *first_model(const ZpTogether *all) {
  return member(all, 0)->model;
}

static double get(void *self) {
  return member(self, 0)->U;
}

static void set(void *self, double voltage) {
  ZpTogether *all = self;
  for (size_t which = 0; which < all->count; which++)
    member(all, which)->U = which == 0 ? voltage : zp_opposed_voltage(first_model(all), voltage);
}

static void by_voltage(void *self, double *r_m) {
  ZpTogether *all = self;
  memset(r_m, 0, all->system.at_rest.n * sizeof *r_m);
  for (size_t which = 0; which < all->count; which++) {
    double *own = all->of[which].branch.newton.r;
    all->of[which].system.sensitivity(member(all, which), own);
    for (size_t i = 0; i < own_count(all, which); i++)
      own[i] *= which == 0 ? 1 : first_model(all)->ratio;
    add(all, which, own, r_m);
  }
}

static void position(void *self, double *q) {
  ZpTogether *all = self;
  for (size_t which = all->count; which-- > 0;) { /* the height of the load is that of the first one */
    double *own = all->of[which].branch.newton.r;
    all->of[which].system.position(member(all, which), own);
    for (size_t i = 0; i < own_count(all, which); i++)
      q[place_of(all, which, i)] = own[i];
  }
}

static void save(void *self, void *to) {
  ZpTogether *all = self;
  double *place = to;
  for (size_t which = 0; which < all->count; which++) {
    all->of[which].system.save(member(all, which), place);
    place += zp_rest_save_size(&all->of[which]);
  }
}

static void restore(void *self, const void *from) {
  ZpTogether *all = self;
  const double *place = from;
  for (size_t which = 0; which < all->count; which++) {
    all->of[which].system.restore(member(all, which), place);
    place += zp_rest_save_size(&all->of[which]);
  }
}

/* Equal members move alike: where another branch crosses, rounding would lead to it. */
static void make_alike(void *self, double *step) {
  const ZpTogether *all = self;
  for (size_t i = 0; i < own_count(all, 0); i++) {
    double mean = 0;
    for (size_t which = 0; which < all->count; which++)
      mean += step[place_of(all, which, i)] / (double)all->count;
    for (size_t which = 0; which < all->count; which++)
      step[place_of(all, which, i)] = mean;
  }
}

/* Then one alone, with its share of the load, has the stiffness against such motions. */
static size_t negative_alike(void *self) {
  ZpTogether *all = self;
  ZpBand *own = &all->of[0].branch.newton.K;
  return zp_band_factor(own) ? zp_band_negative(own) : 0;
}

/* Are all members the same actuator, side by side? */
static bool are_equal(const ZpTogether *all) {
  for (size_t which = 1; which < all->count; which++)
    for (int key = 0; key < zp_key_count(); key++) {
      double one = zp_def_get(&member(all, which)->model->def, key), first = zp_def_get(&first_model(all)->def, key);
      if (one != first && !(isnan(one) && isnan(first))) return false;
    }
  return !(all->distance > 0);
}

static ZpBranchSystem system_of(ZpTogether *all) {
  size_t n = 1, save_size = 0;
  bool alike = are_equal(all);
  for (size_t which = 0; which < all->count; which++) {
    n += own_count(all, which) - 1;
    save_size += all->of[which].system.save_size;
  }
  return (ZpBranchSystem){.at_rest = {.n = n,
                                      .self = all,
                                      .residual = residual,
                                      .stiffness = stiffness,
                                      .length = length,
                                      .change = change,
                                      .move = move},
                          .get = get,
                          .set = set,
                          .sensitivity = by_voltage,
                          .position = position,
                          .save = save,
                          .restore = restore,
                          .save_size = save_size,
                          .make_alike = alike ? make_alike : NULL,
                          .negative = alike ? negative_alike : NULL,
                          .q_scale = 0.01 * first_model(all)->L * sqrt((double)n),
                          .m_scale = fmax(first_model(all)->def.drive.voltage, 1)};
}

/* -- creation --------------------------------------------------------------------------------------- */

static void carve_all(ZpTogether *all, ZpCarver *carver) {
  ZpBandForm form = {.bandwidth = bandwidth_of(all), .symmetric = member(all, 0)->form.symmetric};
  for (size_t which = 0; which < all->count; which++) {
    all->step[which] = zp_carve(carver, own_count(all, which));
    form.rank += member(all, which)->form.rank;
  }
  zp_branch_carve(&all->branch, &all->system, form, carver);
  zp_fold_carve(&all->fold, &all->system, form, &all->branch.newton, carver);
}

bool zp_together_open(ZpTogether *all, const ZpModel *model, void (*carve)(void *user, ZpCarver *carver), void *user) {
  *all = (ZpTogether){.distance = model->distance};
  for (const ZpModel *m = model; m; m = m->below)
    if (!zp_rest_open(&all->of[all->count++], m, NULL, NULL)) return false;
  for (size_t which = 0; which < all->count; which++)
    all->alone[which] = zp_statics_system(member(all, which));
  all->system = system_of(all);
  ZpCarver carver = {NULL, 0};
  for (int pass = 0; pass < 2; pass++) {
    if (pass) {
      all->memory = zp_calloc(1, carver.used);
      carver = (ZpCarver){all->memory, 0};
      if (!all->memory) return false;
    }
    carve_all(all, &carver);
    if (carve) carve(user, &carver);
  }
  return true;
}

void zp_together_close(ZpTogether *all) {
  zp_free(all->memory);
  for (size_t which = 0; which < all->count; which++)
    zp_rest_close(&all->of[which]);
}

void zp_together_watch(ZpTogether *all, bool (*stop)(void *caller), void *caller) {
  for (size_t which = 0; which < all->count; which++) {
    member(all, which)->stop = stop;
    member(all, which)->caller = caller;
  }
}

bool zp_together_stopped(const ZpTogether *all) {
  bool stopped = false;
  for (size_t which = 0; which < all->count; which++)
    stopped |= member(all, which)->stopped;
  return stopped;
}

/* -- finding and following -------------------------------------------------------------------------- */

static double tolerance_of(const ZpTogether *all) {
  double largest = 0;
  for (size_t which = 0; which < all->count; which++)
    largest = fmax(largest, zp_statics_tolerance(member(all, which)));
  return largest;
}

static ZpNewtonInfo newton(ZpTogether *all) {
  enum { MOST = 50 };
  return zp_newton(&all->system.at_rest, tolerance_of(all), MOST, &all->branch.newton);
}

/* By Newton's method; if that finds no stable equilibrium, by slow motion against a resistance. */
static ZpNewtonInfo find(ZpTogether *all) {
  enum { MOST = 20000 };
  static const double longest = 0.04; /* 20 mrad */
  ZpNewtonInfo info = newton(all);
  if (zp_newton_good(info.end) && zp_together_stable(all)) return info;
  return zp_descend_until(&all->system.at_rest, longest, tolerance_of(all), MOST, NULL, NULL, &all->branch.newton);
}

/* => the opening from which the search for the equilibrium starts, m: half of the distance of the mounts, or for
 * members side by side the mean of the openings that each has alone. */
static ZpNewtonInfo first_opening(ZpTogether *all, double *opening) {
  ZpNewtonInfo info = {.end = ZP_NEWTON_CONVERGED};
  *opening = 0.5 * all->distance;
  for (size_t which = 0; which < all->count && !(all->distance > 0); which++) {
    info = zp_statics_hang(member(all, which), &all->of[which].branch.newton);
    if (!zp_newton_good(info.end)) return info;
    *opening += zp_statics_opening(member(all, which)) / (double)all->count;
  }
  return info;
}

ZpNewtonInfo zp_together_hang(ZpTogether *all) {
  double opening;
  ZpNewtonInfo info = first_opening(all, &opening);
  if (!zp_newton_good(info.end)) return info;
  for (size_t which = 0; which < all->count; which++) {
    ZpStatics *s = member(all, which);
    info = zp_statics_hold(s, opening, &all->of[which].branch.newton);
    if (!zp_newton_good(info.end)) return info;
    s->opening = NAN;
    s->load = s->model->def.load.mass;
  }
  return find(all);
}

/* Has the load moved so far that this is another branch? */
static bool has_jumped(const ZpTogether *all, double opening) {
  static const double part = 0.02; /* of what the openings of antagonists sum up to, else of the length */
  double whole = all->distance > 0 ? all->distance : first_model(all)->L;
  return fabs(zp_statics_opening(member(all, 0)) - opening) > part * whole;
}

/* Follow the branch from a stable state while the voltage that `put` sets grows from 0 to `whole`. False if the branch
 * ends before. */
static bool grow(ZpTogether *all, void (*put)(void *all, double voltage), double whole) {
  static const double longest = 0.05, shortest = 1e-6; /* shares of the square of the voltage */
  double reached = 0, step = longest;
  void *good = all->branch.saved;
  save(all, good);
  while (whole > 0 && reached < 1 && step > shortest) {
    double share = fmin(reached + step, 1), opening = zp_statics_opening(member(all, 0));
    put(all, whole * sqrt(share));
    bool found = zp_newton_good(newton(all).end) && !has_jumped(all, opening);
    if (found && zp_together_stable(all)) {
      reached = share;
      step = fmin(2 * step, longest);
      save(all, good);
    } else {
      restore(all, good);
      step *= 0.5;
    }
  }
  return whole == 0 || reached == 1;
}

static void set_lower(void *self, double voltage) {
  member(self, 1)->U = voltage;
}

bool zp_together_bias(ZpTogether *all) {
  return grow(all, set_lower, zp_opposed_voltage(first_model(all), 0));
}

bool zp_together_raise(ZpTogether *all, double voltage) {
  return grow(all, set, voltage) && zp_together_stable(all);
}

ZpNewtonInfo zp_together_settle(ZpTogether *all, double voltage) {
  set(all, voltage);
  return newton(all);
}

bool zp_together_follow(ZpTogether *all) {
  static const double first = 0.01, longest = 0.1; /* as of one alone, rest/rest.c */
  return zp_branch_start(&all->branch, true, first, longest, 2 * tolerance_of(all));
}

/* -- limits of the branch ----------------------------------------------------------------------------- */

void zp_together_start(ZpTogether *all) {
  for (size_t which = 0; which < all->count; which++)
    all->closed[which] = zp_closed_opening(member(all, which)->model, zp_statics_opening(member(all, which)));
}

/* The member whose closing counts => how far it is from closed. */
static size_t closing_one(const ZpTogether *all, double *left) {
  size_t found = 0;
  for (size_t which = 0; which < all->count; which++) {
    double own = zp_statics_opening(member(all, which)) - all->closed[which];
    bool counts = which == 0 || (own < *left) == (all->distance > 0);
    if (counts) found = which;
    if (counts) *left = own;
  }
  return found;
}

double zp_together_left(const ZpTogether *all) {
  double left = 0;
  closing_one(all, &left);
  return left;
}

/* An opening is the load's height below the platform, or above that of an antagonist. */
static double left_by_load(void *self, double *row) {
  ZpTogether *all = self;
  double left = 0;
  size_t which = closing_one(all, &left);
  memset(row, 0, all->system.at_rest.n * sizeof *row);
  row[place_of(all, 0, own_load(all, 0))] = -turn_of(all, which);
  return left;
}

static bool solve_limit(ZpFold *fold) {
  if (!zp_fold_tangent(fold)) return false;
  zp_fold_guess(fold);
  return zp_fold_solve(fold);
}

/* Is this the limit that was near, or another one? */
static bool keep_near(ZpTogether *all, bool found, double least, double most) {
  if (found && get(all) >= least && get(all) <= most) return true;
  restore(all, all->branch.saved_before);
  return false;
}

bool zp_together_limit(ZpTogether *all) {
  static const double near = 1e-3; /* of the voltage */
  double voltage = get(all);
  all->fold.tolerance = tolerance_of(all);
  save(all, all->branch.saved_before);
  return keep_near(all, solve_limit(&all->fold), (1 - near) * voltage, (1 + near) * voltage);
}

bool zp_together_closing(ZpTogether *all, double least, double most) {
  enum { MOST = 4 }; /* tries: where faces meet, Newton's method may need more steps than one try has */
  bool found = false;
  all->fold.tolerance = tolerance_of(all);
  save(all, all->branch.saved_before);
  for (int k = 0; k < MOST && !found; k++)
    found = zp_fold_event(&all->fold, left_by_load, 0, ZP_FOLD_EXACT);
  return keep_near(all, found, least, most);
}

/* -- at a point --------------------------------------------------------------------------------------- */

size_t zp_together_save_size(const ZpTogether *all) {
  return all->system.save_size / sizeof(double);
}

void zp_together_save(ZpTogether *all, double *state) {
  save(all, state);
}

void zp_together_go_to(ZpTogether *all, const double *state) {
  restore(all, state);
  zp_together_stable(all);
}

/* Factor the stiffness at the present point. */
static bool factor(ZpTogether *all) {
  ZpNewtonWork *work = &all->branch.newton;
  if (residual(all, work->r, NULL) != ZP_END_FOUND) return false;
  for (size_t which = 0; which < all->count; which++) {
    ZpStatics *s = member(all, which);
    memcpy(s->tension, s->eval.edges.T, (s->model->count - s->model->s) * sizeof *s->tension);
  }
  stiffness(all, &work->K, NULL);
  return zp_band_factor(&work->K);
}

bool zp_together_stable(ZpTogether *all) {
  return factor(all) && zp_band_negative(&all->branch.newton.K) == 0;
}

double zp_together_stiffness(ZpTogether *all) {
  ZpNewtonWork *work = &all->branch.newton;
  size_t load = place_of(all, 0, own_load(all, 0));
  if (!factor(all)) return NAN;
  memset(work->r, 0, all->system.at_rest.n * sizeof *work->r);
  work->r[load] = 1;
  zp_band_solve(&work->K, work->r);
  return member(all, 0)->model->parts / work->r[load];
}

void zp_together_masses(const ZpTogether *all, double *mass) {
  memset(mass, 0, all->system.at_rest.n * sizeof *mass);
  for (size_t which = 0; which < all->count; which++) {
    const ZpStatics *s = member(all, which);
    double *own = all->step[which];
    zp_assembly_masses(&s->assembly, s->model->mass, own);
    for (size_t i = 0; i < own_count(all, which); i++)
      mass[place_of(all, which, i)] += own[i];
  }
}

double zp_together_force(ZpTogether *all, size_t which) {
  const ZpModel *model = member(all, which)->model;
  double *own = all->of[which].branch.newton.r;
  ZpEnd end = all->alone[which].residual(member(all, which), own, NULL);
  return end == ZP_END_FOUND ? model->parts * own[own_load(all, which)] + zp_load_pull(model) : NAN;
}
