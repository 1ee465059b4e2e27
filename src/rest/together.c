#include "rest/antagonists.h"

#include <math.h>
#include <string.h>

#include "def/check.h"
#include "solve/descend.h"

enum { UPPER, LOWER };

static ZpStatics *member(const ZpAntagonists *both, int which) {
  return (ZpStatics *)&both->of[which].statics;
}

/* -- equations -------------------------------------------------------------------------------------- */

/* Equations of one alone, and which of them is the height of the load. */
static size_t own_count(const ZpAntagonists *both, int which) {
  return member(both, which)->assembly.n;
}

static size_t own_load(const ZpAntagonists *both, int which) {
  return zp_statics_platform(member(both, which));
}

/* An equation of one => of both. Those of the upper one come first, those of the lower one follow from its platform
 * back to its clip, so that the matrix stays a narrow band; the height of the load is one equation. */
static size_t place_of(const ZpAntagonists *both, int which, size_t i) {
  if (which == UPPER) return i;
  size_t count = own_count(both, LOWER), load = own_load(both, LOWER), back = own_count(both, UPPER) + count - 1 - i;
  if (i == load) return own_load(both, UPPER);
  return i < load ? back - 1 : back;
}

/* Upside down, the platform of the lower one falls as the load rises. */
static double sign_of(const ZpAntagonists *both, int which, size_t i) {
  return which == LOWER && i == own_load(both, LOWER) ? -1 : 1;
}

static size_t bandwidth_of(const ZpAntagonists *both) {
  size_t beyond = 0;
  for (int which = UPPER; which <= LOWER; which++)
    beyond += own_count(both, which) - 1 - own_load(both, which);
  return member(both, UPPER)->assembly.bandwidth + beyond;
}

/* Add forces on one to those on both. */
static void add(const ZpAntagonists *both, int which, const double *own, double *r) {
  for (size_t i = 0; i < own_count(both, which); i++)
    r[place_of(both, which, i)] += sign_of(both, which, i) * own[i];
}

/* A step of both as one of each. */
static void part(const ZpAntagonists *both, const double *step) {
  for (int which = UPPER; which <= LOWER; which++)
    for (size_t i = 0; i < own_count(both, which); i++)
      both->step[which][i] = sign_of(both, which, i) * step[place_of(both, which, i)];
}

/* -- the system ------------------------------------------------------------------------------------- */

static double scale_of(const ZpAntagonists *both) {
  return fmax(member(both, UPPER)->scale, member(both, LOWER)->scale);
}

static ZpEnd residual(void *self, double *r, double *size) {
  ZpAntagonists *both = self;
  size_t n = both->system.at_rest.n;
  double largest = 0;
  memset(r, 0, n * sizeof *r);
  for (int which = UPPER; which <= LOWER; which++) {
    double *own = both->of[which].branch.newton.r;
    ZpEnd end = both->alone[which].residual(member(both, which), own, NULL);
    if (end != ZP_END_FOUND) return end;
    add(both, which, own, r);
  }
  for (size_t i = 0; i < n && !isnan(largest); i++)
    if (!(fabs(r[i]) <= largest)) largest = fabs(r[i]);
  if (size) *size = largest / scale_of(both);
  return isfinite(largest) ? ZP_END_FOUND : ZP_END_SHORTER;
}

/* Add the stiffness of one to that of both. */
static void add_stiffness(const ZpAntagonists *both, int which, ZpBand *K) {
  const ZpBand *own = &both->of[which].branch.newton.K;
  for (size_t i = 0; i < own->n; i++)
    for (size_t j = i > own->lower ? i - own->lower : 0; j < own->n && j <= i + own->upper; j++) {
      size_t row = place_of(both, which, i), column = place_of(both, which, j);
      double value = sign_of(both, which, i) * sign_of(both, which, j) * *zp_band_at(own, i, j);
      bool turned = own->lower == 0 && row > column; /* only the upper triangle is kept */
      *zp_band_at(K, turned ? column : row, turned ? row : column) += value;
    }
}

/* Its terms on top of the band, from term `first` on. */
static void add_top(const ZpAntagonists *both, int which, size_t first, ZpBand *K) {
  const ZpBand *own = &both->of[which].branch.newton.K;
  for (size_t k = 0; k < own->rank; k++)
    for (size_t i = 0; i < own->n; i++) {
      size_t from = k * own->n + i, to = (first + k) * K->n + place_of(both, which, i);
      K->u[to] += sign_of(both, which, i) * own->u[from];
      K->v[to] += sign_of(both, which, i) * own->v[from];
    }
}

static void stiffness(void *self, ZpBand *K, double *r) {
  ZpAntagonists *both = self;
  (void)r; /* nothing is moved as prescribed */
  zp_band_clear(K);
  for (int which = UPPER; which <= LOWER; which++) {
    both->alone[which].stiffness(member(both, which), &both->of[which].branch.newton.K, NULL);
    add_stiffness(both, which, K);
    add_top(both, which, which == UPPER ? 0 : member(both, UPPER)->form.rank, K);
  }
}

static double length(void *self, const double *step) {
  ZpAntagonists *both = self;
  part(both, step);
  double upper = both->alone[UPPER].length(member(both, UPPER), both->step[UPPER]);
  return fmax(upper, both->alone[LOWER].length(member(both, LOWER), both->step[LOWER]));
}

static double change(void *self, const double *step) {
  ZpAntagonists *both = self;
  part(both, step);
  double upper = both->alone[UPPER].change(member(both, UPPER), both->step[UPPER]);
  return fmax(upper, both->alone[LOWER].change(member(both, LOWER), both->step[LOWER]));
}

/* Both put the load somewhere else by what is of second order: it comes to be half way between. */
static void move(void *self, const double *step, double fraction) {
  ZpAntagonists *both = self;
  double height[2];
  part(both, step);
  for (int which = UPPER; which <= LOWER; which++) {
    both->alone[which].move(member(both, which), both->step[which], fraction);
    height[which] = -zp_statics_opening(member(both, which));
  }
  double missed = height[UPPER] + height[LOWER] + both->distance;
  for (int which = UPPER; which <= LOWER; which++)
    zp_statics_put_platform(member(both, which), height[which] - 0.5 * missed);
}

/* -- along the voltage ------------------------------------------------------------------------------ */

/* The keys of both. */
static const ZpActuatorDef *def_of(const ZpAntagonists *both) {
  return &member(both, UPPER)->model->def;
}

static double get(void *self) {
  return member(self, UPPER)->U;
}

static void set(void *self, double voltage) {
  member(self, UPPER)->U = voltage;
  member(self, LOWER)->U = zp_opposed_voltage(member(self, UPPER)->model, voltage);
}

static void by_voltage(void *self, double *r_m) {
  ZpAntagonists *both = self;
  memset(r_m, 0, both->system.at_rest.n * sizeof *r_m);
  for (int which = UPPER; which <= LOWER; which++) {
    double *own = both->of[which].branch.newton.r;
    both->of[which].system.sensitivity(member(both, which), own);
    for (size_t i = 0; i < own_count(both, which); i++)
      own[i] *= which == UPPER ? 1 : member(both, UPPER)->model->ratio;
    add(both, which, own, r_m);
  }
}

static void position(void *self, double *q) {
  ZpAntagonists *both = self;
  for (int which = LOWER; which >= UPPER; which--) { /* the height of the load is that of the upper one */
    double *own = both->of[which].branch.newton.r;
    both->of[which].system.position(member(both, which), own);
    for (size_t i = 0; i < own_count(both, which); i++)
      q[place_of(both, which, i)] = own[i];
  }
}

static void save(void *self, void *to) {
  ZpAntagonists *both = self;
  both->of[UPPER].system.save(member(both, UPPER), to);
  both->of[LOWER].system.save(member(both, LOWER), (double *)to + zp_rest_save_size(&both->of[UPPER]));
}

static void restore(void *self, const void *from) {
  ZpAntagonists *both = self;
  both->of[UPPER].system.restore(member(both, UPPER), from);
  both->of[LOWER].system.restore(member(both, LOWER), (const double *)from + zp_rest_save_size(&both->of[UPPER]));
}

static ZpBranchSystem system_of(ZpAntagonists *both) {
  size_t n = own_count(both, UPPER) + own_count(both, LOWER) - 1;
  return (ZpBranchSystem){.at_rest = {.n = n,
                                      .self = both,
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
                          .save_size = both->of[UPPER].system.save_size + both->of[LOWER].system.save_size,
                          .q_scale = 0.01 * member(both, UPPER)->model->L * sqrt((double)n),
                          .m_scale = fmax(def_of(both)->drive.voltage, 1)};
}

/* -- creation --------------------------------------------------------------------------------------- */

static void carve_all(ZpAntagonists *both, ZpCarver *carver) {
  for (int which = UPPER; which <= LOWER; which++)
    both->step[which] = zp_carve(carver, own_count(both, which));
  const ZpBandForm *upper = &member(both, UPPER)->form, *lower = &member(both, LOWER)->form;
  ZpBandForm form = {bandwidth_of(both), upper->symmetric, upper->rank + lower->rank};
  zp_branch_carve(&both->branch, &both->system, form, carver);
}

bool zp_antagonists_open(ZpAntagonists *both, const ZpModel *model, void (*carve)(void *user, ZpCarver *carver),
                         void *user) {
  *both = (ZpAntagonists){.distance = model->distance};
  if (!zp_rest_open(&both->of[UPPER], model, NULL, NULL)) return false;
  if (!zp_rest_open(&both->of[LOWER], model->below, NULL, NULL)) return false;
  for (int which = UPPER; which <= LOWER; which++)
    both->alone[which] = zp_statics_system(member(both, which));
  both->system = system_of(both);
  ZpCarver carver = {NULL, 0};
  for (int pass = 0; pass < 2; pass++) {
    if (pass) {
      both->memory = zp_calloc(1, carver.used);
      carver = (ZpCarver){both->memory, 0};
      if (!both->memory) return false;
    }
    carve_all(both, &carver);
    if (carve) carve(user, &carver);
  }
  return true;
}

void zp_antagonists_close(ZpAntagonists *both) {
  zp_free(both->memory);
  zp_rest_close(&both->of[UPPER]);
  zp_rest_close(&both->of[LOWER]);
}

void zp_antagonists_watch(ZpAntagonists *both, bool (*stop)(void *caller), void *caller) {
  for (int which = UPPER; which <= LOWER; which++) {
    member(both, which)->stop = stop;
    member(both, which)->caller = caller;
  }
}

bool zp_antagonists_stopped(const ZpAntagonists *both) {
  return member(both, UPPER)->stopped || member(both, LOWER)->stopped;
}

/* -- finding and following -------------------------------------------------------------------------- */

static double tolerance_of(const ZpAntagonists *both) {
  return fmax(zp_statics_tolerance(member(both, UPPER)), zp_statics_tolerance(member(both, LOWER)));
}

static ZpNewtonInfo newton(ZpAntagonists *both) {
  enum { MOST = 50 };
  return zp_newton(&both->system.at_rest, tolerance_of(both), MOST, &both->branch.newton);
}

/* By Newton's method, and if that finds none that is stable, as slow motion against a resistance goes. */
static ZpNewtonInfo find(ZpAntagonists *both) {
  enum { MOST = 20000 };
  static const double longest = 0.04; /* 20 mrad */
  ZpNewtonInfo info = newton(both);
  if (zp_newton_good(info.end) && zp_antagonists_stable(both)) return info;
  return zp_descend_until(&both->system.at_rest, longest, tolerance_of(both), MOST, NULL, NULL, &both->branch.newton);
}

ZpNewtonInfo zp_antagonists_hang(ZpAntagonists *both) {
  for (int which = UPPER; which <= LOWER; which++) {
    ZpStatics *s = member(both, which);
    ZpNewtonInfo info = zp_statics_hold(s, 0.5 * both->distance, &both->of[which].branch.newton);
    if (!zp_newton_good(info.end)) return info;
    s->opening = NAN;
    s->load = s->model->def.load.mass;
  }
  return find(both);
}

/* Has the load gone so far that this is another branch? */
static bool has_jumped(const ZpAntagonists *both, double opening) {
  static const double part = 0.02; /* of what both openings sum up to */
  return fabs(zp_statics_opening(member(both, UPPER)) - opening) > part * both->distance;
}

bool zp_antagonists_bias(ZpAntagonists *both) {
  static const double longest = 0.05, shortest = 1e-6; /* shares of the square of the voltage */
  double whole = zp_opposed_voltage(member(both, UPPER)->model, 0), reached = 0, step = longest;
  void *good = both->branch.saved;
  save(both, good);
  while (whole > 0 && reached < 1 && step > shortest) {
    double share = fmin(reached + step, 1), opening = zp_statics_opening(member(both, UPPER));
    member(both, LOWER)->U = whole * sqrt(share);
    bool found = zp_newton_good(newton(both).end) && !has_jumped(both, opening);
    if (found && zp_antagonists_stable(both)) {
      reached = share;
      step = fmin(2 * step, longest);
      save(both, good);
    } else {
      restore(both, good);
      step *= 0.5;
    }
  }
  return whole == 0 || reached == 1;
}

ZpNewtonInfo zp_antagonists_settle(ZpAntagonists *both, double voltage) {
  set(both, voltage);
  return newton(both);
}

bool zp_antagonists_follow(ZpAntagonists *both) {
  static const double first = 0.01, longest = 0.1; /* as of one alone, rest/rest.c */
  return zp_branch_start(&both->branch, true, first, longest, 2 * tolerance_of(both));
}

/* Factor the stiffness at the present point. */
static bool factor(ZpAntagonists *both) {
  ZpNewtonWork *work = &both->branch.newton;
  if (residual(both, work->r, NULL) != ZP_END_FOUND) return false;
  for (int which = UPPER; which <= LOWER; which++) {
    ZpStatics *s = member(both, which);
    memcpy(s->tension, s->eval.edges.T, (s->model->count - s->model->s) * sizeof *s->tension);
  }
  stiffness(both, &work->K, NULL);
  return zp_band_factor(&work->K);
}

bool zp_antagonists_stable(ZpAntagonists *both) {
  return factor(both) && zp_band_negative(&both->branch.newton.K) == 0;
}

double zp_antagonists_stiffness(ZpAntagonists *both) {
  ZpNewtonWork *work = &both->branch.newton;
  size_t load = own_load(both, UPPER);
  if (!factor(both)) return NAN;
  memset(work->r, 0, both->system.at_rest.n * sizeof *work->r);
  work->r[load] = 1;
  zp_band_solve(&work->K, work->r);
  return member(both, UPPER)->model->parts / work->r[load];
}
