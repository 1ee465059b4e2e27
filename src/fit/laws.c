/* Which law that the model lacks would explain what the residuals still show? By the direction in which a little of it
 * moves the values, beside what the fitted parameters can do. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "def/def.h"
#include "fit/fit.h"
#include "sample/distribution.h"

typedef struct Law {
  const char *what, *key;
  double value;
  const char *second; /* NULL: one key switches it on */
  double second_value;
} Law;

static const Law laws[] = {
#define ZP_LAW(what, key, value)                           {what, key, value, NULL, 0},
#define ZP_LAW_AND(what, key, value, second, second_value) {what, key, value, second, second_value},
#include "fit/laws.def"
};

enum { LAWS = sizeof laws / sizeof laws[0] };

/* The longest record, s; 1 without one. */
static double duration_of(const ZpFit *fit) {
  double longest = 0;
  for (size_t i = 0; i < fit->runs; i++)
    longest = fmax(longest, fit->run[i].last - fit->run[i].from);
  return longest > 0 ? longest : 1;
}

static bool set(ZpActuatorDef *def, const char *key, double value, double duration) {
  const int index = zp_key_find(key);
  const char *unit = zp_key(index)->unit;
  const bool lasts = strcmp(unit, "s") == 0 || strcmp(unit, "ohm m") == 0;
  return zp_def_set(def, index, lasts ? value * duration : value, NULL) == ZP_OK;
}

/* The definition with a little of a law; false if it has the law, or the law's key is fitted. */
static bool add_law(const ZpFit *fit, const Law *law, ZpActuatorDef *def) {
  const double duration = duration_of(fit), has = zp_def_number(fit->def, law->key);
  for (int k = 0; k < fit->keys; k++)
    if (fit->key[k] == zp_key_find(law->key)) return false;
  *def = *fit->def;
  return !(fabs(has) > 0) && set(def, law->key, law->value, duration) &&
         (!law->second || set(def, law->second, law->second_value, duration));
}

/* Part of v that no parameter can make up for => v, by the normal equations at the fit, whose inverse is C. */
static void take_out_parameters(const ZpFit *fit, const ZpFitPoint *best, double C[ZP_FIT_MOST][ZP_FIT_MOST],
                                double *v) {
  double sum[ZP_FIT_MOST] = {0};
  const size_t n = (size_t)fit->n;
  for (size_t i = 0; i < fit->rows; i++)
    for (size_t k = 0; k < n; k++)
      sum[k] += best->J[i * n + k] * v[i];
  for (size_t i = 0; i < fit->rows; i++)
    for (size_t k = 0; k < n; k++)
      for (size_t j = 0; j < n; j++)
        v[i] -= best->J[i * n + k] * C[k][j] * sum[j];
}

/* By how much the squares fall with a law, of which there can only be more than nothing. `way`: weighted change of the
 * values by the law; `r`: weighted residuals; neither has a part that parameters can make up for. */
static double fall_of(const ZpFit *fit, const double *way, const double *r) {
  double both = 0, square = 0;
  for (size_t i = 0; i < fit->rows; i++)
    both -= way[i] * r[i], square += way[i] * way[i];
  return both > 0 && square > 0 ? both * both / square : 0;
}

/* Values with a little of a law, less those without, weighted => way. */
static bool move_by(ZpFit *fit, const Law *law, const ZpFitPoint *best, double *way) {
  const ZpActuatorDef *plain = fit->def;
  ZpActuatorDef def;
  if (!add_law(fit, law, &def)) return false;
  fit->def = &def;
  const bool good = zp_fit_evaluate(fit, best->z, way, NULL);
  for (size_t i = 0; i < fit->rows && good; i++)
    way[i] = zp_fit_residual(fit, way, i) - zp_fit_residual(fit, best->fitted, i);
  fit->def = plain;
  return good;
}

/* Probability that noise alone lets the squares fall so far by the best of several laws, from Student's distribution by
 * Wallace's approximation. */
static double chance_of(const ZpFit *fit, double fall, double square, int tried) {
  const double freedom = (double)fit->rows - fit->n - 1, left = (square - fall) / freedom;
  if (!(freedom > 0) || !(left > 0)) return 1;
  const double t2 = fall / (fit->sigma ? fmax(1, left) : left);
  const double normal = (8 * freedom + 1) / (8 * freedom + 3) * sqrt(freedom * log1p(t2 / freedom));
  return fmin(1, tried * zp_normal_share(-normal));
}

ZpFitMissing zp_fit_find_missing(ZpFit *fit, const ZpFitPoint *best) {
  enum { FEWEST = 12 }; /* rows beside the parameters, below which a fit bends to noise */
  ZpFitMissing missing = {NULL, NULL, 0, NAN};
  double *r = calloc(2 * fit->rows, sizeof *r), *way = r ? r + fit->rows : NULL, most = 0;
  double C[ZP_FIT_MOST][ZP_FIT_MOST];
  int tried = 0;
  const bool asks = r && fit->runs > 0 && fit->n > 0 && fit->rows >= (size_t)fit->n + FEWEST;
  if (!r) fit->status = zp_fail_memory(fit->err);
  for (size_t i = 0; i < fit->rows && asks; i++)
    r[i] = zp_fit_residual(fit, best->fitted, i);
  const bool apart = asks && zp_fit_covariance(fit, best->J, NULL, 1e-12, 1e-14, C);
  if (apart) take_out_parameters(fit, best, C, r);
  for (size_t k = 0; k < LAWS && apart && zp_fit_goes_on(fit); k++) {
    if (!move_by(fit, &laws[k], best, way)) continue;
    take_out_parameters(fit, best, C, way);
    const double fall = fall_of(fit, way, r);
    tried++;
    if (fall <= most) continue;
    most = fall;
    missing = (ZpFitMissing){laws[k].what, laws[k].key, fall / best->square, 1};
  }
  free(r);
  if (tried > 0) missing.chance = chance_of(fit, most, best->square, tried);
  return missing;
}
