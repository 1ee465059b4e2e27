/* Are residuals noise? Tests of their size, their signs and their outliers. */
#include <math.h>
#include <string.h>

#include "fit/fit.h"
#include "sample/distribution.h"

/* Share of the normal distribution above x. */
static double above(double x) {
  return zp_normal_share(-x);
}

/* Of chi-square, by Wilson and Hilferty's cube root. */
static double chi_square_above(double value, double freedom) {
  const double part = 2 / (9 * freedom);
  return above((cbrt(value / freedom) - (1 - part)) / sqrt(part));
}

double zp_fit_student(double freedom) {
  static const double z = 1.959963984540054;
  const double z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z, v = freedom;
  if (v < 1.5) return 12.706;
  if (v < 2.5) return 4.303;
  if (v < 3.5) return 3.182;
  return z + (z3 + z) / (4 * v) + (5 * z5 + 16 * z3 + 3 * z) / (96 * v * v) +
         (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * v * v * v);
}

/* Signs of the residuals of a set, in the order of its rows. */
typedef struct Signs {
  double runs, mean, variance; /* how many runs there are, and how many those of noise would have */
} Signs;

static Signs signs_of(const ZpFit *fit, const ZpFitSet *of, const double *fitted) {
  double plus = 0, minus = 0, runs = 0, before = 0;
  for (size_t i = of->first; i < of->first + of->rows; i++) {
    const double sign = fitted[i] < fit->y[i] ? -1 : 1;
    if (sign > 0)
      plus++;
    else
      minus++;
    runs += sign != before;
    before = sign;
  }
  const double n = plus + minus, both = 2 * plus * minus;
  if (plus == 0 || minus == 0) return (Signs){runs, n / 2 + 1, n / 4};
  return (Signs){runs, both / n + 1, both * (both - n) / (n * n * (n - 1))};
}

/* Wald and Wolfowitz's test, of all sets together. Of few rows, which the fit bends to itself, it says nothing. */
static double runs_test(const ZpFit *fit, const double *fitted) {
  enum { FEWEST = 12 };
  Signs all = {0};
  for (size_t s = 0; s < fit->sets; s++) {
    if (fit->set[s].rows < FEWEST) continue;
    const Signs of = signs_of(fit, &fit->set[s], fitted);
    all.runs += of.runs, all.mean += of.mean, all.variance += of.variance;
  }
  if (!(all.variance > 0)) return NAN;
  return above((all.mean - 0.5 - all.runs) / sqrt(all.variance));
}

/* Probability of residuals that are as like their neighbours, by their correlation from row to row, whose variance is 1
 * over their number. A sign sees less than a size. */
static double succession_test(const ZpFit *fit, const double *fitted) {
  double products = 0, squares = 0, pairs = 0;
  for (size_t s = 0; s < fit->sets; s++) {
    const ZpFitSet *of = &fit->set[s];
    for (size_t i = of->first; i < of->first + of->rows; i++) {
      const double r = zp_fit_residual(fit, fitted, i);
      squares += r * r;
      if (i == of->first) continue;
      products += r * zp_fit_residual(fit, fitted, i - 1);
      pairs++;
    }
  }
  return squares > 0 ? above(products / squares * sqrt(pairs)) : (double)NAN;
}

/* Rows whose residual is too large for normal noise of so many rows, the largest first. */
static void find_outliers(const ZpFit *fit, const ZpFitPoint *best, ZpFitJudgement *of) {
  enum { MOST = sizeof of->outlier / sizeof of->outlier[0] };
  const double sigma = sqrt(of->variance);
  for (size_t i = 0; i < fit->rows && sigma > 0; i++) {
    const double size = fabs(zp_fit_residual(fit, best->fitted, i)) / sigma;
    if (2 * above(size) * (double)fit->rows > 0.05) continue;
    size_t place = of->outliers < MOST ? of->outliers : MOST;
    for (; place > 0; place--) {
      if (fabs(zp_fit_residual(fit, best->fitted, of->outlier[place - 1])) / sigma >= size) break;
      if (place < MOST) of->outlier[place] = of->outlier[place - 1];
    }
    if (place < MOST) of->outlier[place] = i;
    of->outliers += of->outliers < MOST;
  }
}

ZpFitJudgement zp_fit_judge(const ZpFit *fit, const ZpFitPoint *best) {
  const double freedom = (double)fit->rows - fit->n;
  ZpFitJudgement of = {NAN, NAN, runs_test(fit, best->fitted), succession_test(fit, best->fitted), 1, 0, {0}};
  if (!fit->sigma) of.variance = freedom > 0 ? best->square / freedom : (double)NAN;
  if (fit->sigma && freedom > 0) {
    of.reduced = best->square / freedom;
    of.too_large = chi_square_above(best->square, freedom);
  }
  find_outliers(fit, best, &of);
  return of;
}

bool zp_fit_is_missing(const ZpFitMissing *missing) {
  static const double unlikely = 5e-3;
  return missing->chance < unlikely;
}

bool zp_fit_is_noise(const ZpFitJudgement *of) {
  static const double unlikely = 1e-2;
  return !(of->runs < unlikely) && !(of->too_large < unlikely);
}
