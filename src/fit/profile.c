/* Intervals by the profile of the likelihood: one parameter is held, the others are fitted again, until the sum of
 * squares has grown by what belongs to 95 of 100. Near the minimum the fit is nearly linear, so the derivatives there
 * mostly serve all points of a profile. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fit/fit.h"

/* A fit at its best point. */
typedef struct Profile {
  ZpFit *fit;
  ZpFitPoint *best;
  double rise; /* of the sum of squares at the ends of intervals */
  double C[ZP_FIT_MOST][ZP_FIT_MOST];
  ZpFitPoint at; /* the point of the profile, with arrays of its own. Its derivatives are those of an earlier one, */
  double slopes_at[ZP_FIT_MOST]; /* as they are at these values, */
  bool renewed;                  /* and on this side of the profile they are not those of the best point any more; */
  bool fresh;                    /* they are its own */
  bool better;                   /* it fits better than the best point */
  bool gave_up;                  /* the last search for an end did not come to it */
  ZpFitProfiles *points;
} Profile;

/* Let the kept derivatives be those at the point, as far as the model is linear. */
static void carry_slopes(Profile *p) {
  zp_fit_carry_slopes(p->fit, p->slopes_at, p->at.z, p->at.J);
  memcpy(p->slopes_at, p->at.z, sizeof p->slopes_at);
}

static void start_side(Profile *p) {
  memcpy(p->at.J, p->best->J, p->fit->rows * (size_t)p->fit->n * sizeof *p->at.J);
  memcpy(p->slopes_at, p->best->z, sizeof p->slopes_at);
  p->renewed = false;
}

/* Fit the others again with kept derivatives => whether that sufficed. */
static bool correct(Profile *p, const bool *held) {
  enum { MOST = 3 };
  static const double little = 0.03; /* of the rise */
  for (int k = 0; k < MOST; k++) {
    double before[ZP_FIT_MOST], to[ZP_FIT_MOST], falls;
    const double square = p->at.square;
    carry_slopes(p);
    if (!zp_fit_step(p->fit, &p->at, held, to, &falls)) return false;
    if (falls < little * p->rise) return true;
    memcpy(before, p->at.z, sizeof before);
    memcpy(p->at.z, to, (size_t)p->fit->n * sizeof *to);
    zp_fit_find_values(p->fit, &p->at);
    if (p->at.square < square) continue;
    memcpy(p->at.z, before, sizeof before);
    return false;
  }
  return false;
}

/* Fit the others again with derivatives that were found on this side, or `fresh` ones. */
static void refit(Profile *p, int which, bool fresh) {
  enum { MOST = 12 };
  bool held[ZP_FIT_MOST] = {false};
  held[which] = true;
  if (fresh)
    zp_fit_go_to(p->fit, &p->at);
  else
    zp_fit_find_values(p->fit, &p->at);
  if (!fresh) carry_slopes(p);
  zp_fit_descend_kept(p->fit, held, MOST, !fresh, &p->at);
  memcpy(p->slopes_at, p->at.z, sizeof p->slopes_at);
  p->renewed = true;
  p->fresh = fresh;
}

static void record(Profile *p, int which, double rise) {
  ZpFitProfiles *to = p->points;
  if (!p->at.good || to->count == ZP_FIT_PROFILES) return;
  ZpFitProfilePoint *point = &to->point[to->count++];
  *point = (ZpFitProfilePoint){.held = which, .rise = rise};
  memcpy(point->z, p->at.z, sizeof point->z);
}

/* From some values of all parameters along the valley of one, to its value z. */
static void shift(Profile *p, const double *from, int which, double z) {
  const double way = zp_fit_way(p->fit, which, from[which], z);
  for (int k = 0; k < p->fit->n; k++)
    p->at.z[k] = zp_fit_end(p->fit, k, from[k], p->C[k][which] / p->C[which][which] * way);
  p->at.z[which] = z;
  zp_fit_find_values(p->fit, &p->at);
}

/* Values of all parameters at the known point whose parameter `which` is nearest to z; the best point is one. */
static const double *nearest(const Profile *p, int which, double z) {
  const double *found = p->best->z;
  for (size_t i = 0; i < p->points->count; i++) {
    const ZpFitProfilePoint *point = &p->points->point[i];
    if (point->rise < p->rise && fabs(point->z[which] - z) < fabs(found[which] - z)) found = point->z;
  }
  return found;
}

/* To where the others may be if `which` is at z: along the valley from the best point, or from one that is known and
 * nearer. */
static void begin_at(Profile *p, int which, double z) {
  const double *near = nearest(p, which, z);
  shift(p, p->best->z, which, z);
  if (near == p->best->z) return;
  const double square = p->at.square;
  shift(p, near, which, z);
  if (p->at.square > square) shift(p, p->best->z, which, z);
}

/* Is the rise so far from the parabola of a linear fit that the derivatives have to be found again? */
static bool is_bent(const Profile *p, int which) {
  static const double off = 0.3, little = 0.1;
  const double d = p->at.z[which] - p->best->z[which], expected = d * d / p->C[which][which];
  const double rise = p->at.square - p->best->square;
  return fabs(rise - expected) > off * expected + little * p->rise;
}

/* Note the point => the rise of the sum of squares there. */
static double look_at_point(Profile *p, int which) {
  const double rise = p->at.square - p->best->square;
  p->better |= p->at.good && rise < -fmax(0.05 * p->rise, 2 * p->fit->scatter);
  record(p, which, rise);
  return rise;
}

/* Rise of the sum of squares where parameter `which` is at z and the others fit best. */
static double rise_at(Profile *p, int which, double z) {
  bool held[ZP_FIT_MOST] = {false};
  held[which] = true;
  begin_at(p, which, z);
  p->fresh = false;
  if (p->fit->n > 1 && (!correct(p, held) || is_bent(p, which))) refit(p, which, !p->renewed || p->fit->runs == 0);
  return look_at_point(p, which);
}

/* The rise at the present point of the profile, with its own derivatives if it has those of another one. */
static double settled_rise(Profile *p, int which, double rise) {
  if (!p->renewed || p->fresh || p->better) return rise;
  refit(p, which, true);
  return look_at_point(p, which);
}

/* The farthest point on one side whose rise is below a share of that at the ends of the interval; NULL: none. */
static const ZpFitProfilePoint *farthest_within(const Profile *p, int which, double share, double side) {
  const ZpFitProfilePoint *farthest = NULL;
  double most = 0;
  for (size_t i = 0; i < p->points->count; i++) {
    const ZpFitProfilePoint *point = &p->points->point[i];
    const double s = side * (point->z[which] - p->best->z[which]);
    if (point->rise < share * p->rise && s > most) most = s, farthest = point;
  }
  return farthest;
}

/* The search for the end of an interval: the farthest distance from the best point that is known to lie within it, and
 * the nearest that does not, with the roots of the shares of the rise there, which grow nearly linearly. */
typedef struct Bracket {
  double low, high, root_low, root_high;
  int turned; /* points in a row that lie within it, or minus those that do not */
} Bracket;

static void take_share(Bracket *b, double s, double share) {
  const bool within = share < 1;
  const int side = within ? 1 : -1;
  b->turned = b->turned * side > 0 ? b->turned + side : side;
  if (within)
    b->low = s, b->root_low = sqrt(fmax(share, 0));
  else
    b->high = s, b->root_high = sqrt(share);
}

/* The next distance: by the roots, or halfway where these mislead, as on a bent valley. */
static double next_of(const Bracket *b) {
  static const double lost = 4; /* a root beyond which a fit of the others has failed rather than told a rise */
  if (!isfinite(b->high)) return b->low * fmin(fmax(1 / fmax(b->root_low, 0.1), 1.2), 3);
  const double part = (1 - b->root_low) / (b->root_high - b->root_low);
  const bool halves = b->root_high > lost || b->turned > 1 || b->turned < -1;
  return b->low + (b->high - b->low) * (halves ? 0.5 : fmin(fmax(part, 0.05), 0.95));
}

/* The end of an interval on one side; NAN: the bounds come first. */
static double end_at(Profile *p, int which, double side) {
  enum { MOST = 10 };
  static const double bent = 0.06, straight = 0.25; /* how near to the end a point tells it, by the root of its rise */
  const double rough = fmin(p->fit->scatter / p->rise, 0.3);
  const double from = p->best->z[which], bound = side > 0 ? p->fit->upper[which] : p->fit->lower[which];
  const double most = fabs(bound - from);
  const ZpFitProfilePoint *known = farthest_within(p, which, 1, side);
  const double within = known ? fabs(known->z[which] - from) : 0;
  Bracket b = {.low = within, .high = INFINITY, .root_low = known ? sqrt(fmax(known->rise, 0) / p->rise) : 0};
  double s = fmax(sqrt(p->rise * p->C[which][which]), 1.1 * within);
  start_side(p);
  for (int k = 0; k < MOST && !p->better && !p->fit->stopped && p->fit->status == ZP_OK; k++) {
    s = fmin(s, most);
    double share = rise_at(p, which, from + side * s) / p->rise;
    const double near = fmax(rough, is_bent(p, which) ? bent : straight);
    if (fabs(share - 1) < near) share = settled_rise(p, which, share * p->rise) / p->rise;
    if (fabs(share - 1) < near) return from + side * fmax(fmin(s / sqrt(share), most), within);
    if (share < 1 && s >= most) return NAN;
    take_share(&b, s, share);
    if (b.high - b.low < 0.01 * s) return from + side * s;
    s = next_of(&b);
  }
  p->gave_up = true;
  return NAN;
}

/* The parameter whose estimate is most correlated with this one. */
static int partner_of(const Profile *p, int which) {
  int partner = -1;
  double most = 0.5;
  for (int k = 0; k < p->fit->n; k++) {
    const double size = fabs(p->C[k][which]) / sqrt(p->C[k][k] * p->C[which][which]);
    if (k != which && size > most) most = size, partner = k;
  }
  return partner;
}

static void find_one(Profile *p, int which, ZpFitInterval *interval) {
  p->gave_up = false;
  interval->low = end_at(p, which, -1);
  if (!p->better) interval->high = end_at(p, which, 1);
  interval->lost = p->gave_up;
  interval->trades = isnan(interval->low) || isnan(interval->high) ? partner_of(p, which) : -1;
}

/* Once more, if a point of another profile lies within this interval by its sum of squares, but not by its value. */
static void widen(Profile *p, int which, ZpFitInterval *interval) {
  static const double clearly = 0.9; /* ends are no more accurate */
  const ZpFitProfilePoint *low = farthest_within(p, which, clearly, -1);
  const ZpFitProfilePoint *high = farthest_within(p, which, clearly, 1);
  if ((low && interval->low > low->z[which]) || (high && interval->high < high->z[which])) find_one(p, which, interval);
}

/* The first n parameters, those that the data know least first, by their standard errors over their sizes. */
static void sort_by_looseness(const Profile *p, int n, int *order) {
  double error[ZP_FIT_MOST];
  for (int k = 0; k < n; k++) {
    int place = k;
    error[k] = sqrt(p->C[k][k]) / zp_fit_size_of(p->fit, k, p->best->z[k]);
    for (; place > 0 && error[order[place - 1]] < error[k]; place--)
      order[place] = order[place - 1];
    order[place] = k;
  }
}

/* False: a better point was found. The loosest goes first: its valley leads farthest, and shows a better point soonest.
 */
static bool find_all(Profile *p, ZpFitInterval *interval) {
  for (int k = 0; k < p->fit->n; k++)
    interval[k] = (ZpFitInterval){NAN, NAN, -1, false};
  if (!zp_fit_covariance(p->fit, p->best->J, NULL, 1e-10, 1e-12, p->C)) return true;
  int order[ZP_FIT_MOST] = {0};
  sort_by_looseness(p, p->fit->n, order);
  for (int k = 0; k < p->fit->n && !p->better; k++)
    find_one(p, order[k], &interval[order[k]]);
  for (int k = 0; k < p->fit->n && !p->better; k++)
    widen(p, k, &interval[k]);
  return !p->better;
}

/* Along the valley of a parameter to its value z, from a point there that has derivatives, and down to its floor. */
static void walk(Profile *p, int which, double z) {
  enum { MOST = 5 };
  const ZpFitPoint from = p->at;
  bool held[ZP_FIT_MOST] = {false};
  held[which] = true;
  shift(p, from.z, which, z);
  zp_fit_carry_slopes(p->fit, from.z, p->at.z, p->at.J);
  zp_fit_descend_kept(p->fit, held, MOST, true, &p->at);
}

/* Faces touch and part so often that the floor of a valley may have several minima: is there a better one on one side,
 * as far as the floor does not rise beyond hope? */
static void look_beyond(Profile *p, int which, double variance, double side) {
  enum { MOST = 10 };
  static const double standard_errors = 4, hopeless = 100, part = 0.5;
  const double s = standard_errors * sqrt(variance * p->C[which][which]), better = 2 * p->fit->scatter + variance;
  const double most = variance * fmax(hopeless, part * (double)p->fit->rows);
  zp_fit_copy_point(p->fit, p->best, &p->at);
  for (int k = 0; k < MOST && !p->better && zp_fit_goes_on(p->fit); k++) {
    const double before = p->at.z[which];
    walk(p, which, fmin(fmax(before + side * s, p->fit->lower[which]), p->fit->upper[which]));
    const double rise = p->at.square - p->best->square;
    p->better = p->at.good && rise < -better;
    if (rise < p->rise) record(p, which, rise);
    if (rise > most || p->at.z[which] == before) return;
  }
}

/* Is there no better minimum along the valley? A search, for which derivatives may be rough. */
static bool is_lowest(Profile *p, double variance) {
  ZpFit *fit = p->fit;
  const double enough = fit->enough, rough = fit->rough;
  if (fit->runs == 0 || fit->keys == 0 || !zp_fit_covariance(fit, p->best->J, NULL, 1e-10, 1e-12, p->C)) return true;
  fit->slopes = ZP_FIT_ONE_SIDED, fit->enough = 0.3, fit->rough = 10;
  int order[ZP_FIT_MOST] = {0};
  sort_by_looseness(p, p->fit->keys, order);
  const int loosest = order[0];
  look_beyond(p, loosest, variance, -1);
  if (!p->better) look_beyond(p, loosest, variance, 1);
  fit->slopes = ZP_FIT_CENTRAL, fit->enough = enough, fit->rough = rough;
  return !p->better;
}

/* => by how much the squares fall. */
static double go_to_better(Profile *p) {
  enum { MOST = 60 };
  const double before = p->best->square;
  memcpy(p->best->z, p->at.z, sizeof p->best->z);
  zp_fit_go_to(p->fit, p->best);
  p->best->ended = zp_fit_descend(p->fit, NULL, MOST, p->best);
  p->better = false;
  return before - p->best->square;
}

double zp_fit_level(const ZpFit *fit) {
  static const double normal = 1.959963984540054;
  const double t = fit->sigma ? normal : zp_fit_student((double)fit->rows - fit->n);
  return t * t;
}

void zp_fit_intervals(ZpFit *fit, double variance, ZpFitPoint *best, ZpFitInterval *interval, ZpFitProfiles *points) {
  enum { MOST = 8 };
  Profile p = {.fit = fit, .best = best, .rise = zp_fit_level(fit) * variance, .points = points};
  points->count = 0;
  if (!(p.rise > 0) || !zp_fit_open_point(fit, &p.at)) return;
  static const double little = 0.03;
  const double enough = fit->enough;
  bool whole = false, is_new = true;
  for (int k = 0; k < MOST && !whole; k++) {
    points->count = 0;
    fit->enough = fmax(enough, little);
    whole = (!is_new || is_lowest(&p, variance)) && find_all(&p, interval);
    fit->enough = enough;
    if (!whole) is_new = go_to_better(&p) > variance;
  }
  best->ended &= whole;
  for (int k = 0; k < fit->n && !whole; k++)
    interval[k] = (ZpFitInterval){NAN, NAN, -1, true};
  free(p.at.fitted);
}
