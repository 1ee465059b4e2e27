/* Letters of docs/theory.md, section 2: with t = theta^4
 *   a, b  t^k / (4 k + 1)! and t^k / (4 k + 2)!, whose sums are (sinh + sin) / (2 theta) and (cosh - cos) / (2 theta^2)
 *   f     twice the latter sum over the former: share of nu^2 by which a strip is softer than in plane strain
 */
#include "ribbon/curl.h"

#include <math.h>

#include "math/gauss.h"

/* A function of t: itself, t times its first and t^2 times its second derivative. */
typedef struct Jet {
  double value, first, second;
} Jet;

static void add_term(double term, int k, Jet *sum) {
  sum->value += term;
  sum->first += k * term;
  sum->second += k * (k - 1) * term;
}

/* => of `above` over `below`. */
static Jet quotient(Jet above, Jet below) {
  const double ratio = above.value / below.value, first = (above.first - ratio * below.first) / below.value;
  return (Jet){ratio, first, (above.second - 2 * first * below.first - ratio * below.second) / below.value};
}

/* Terms of one sign: none cancels another. */
static Jet share_by_series(double t) {
  static const double least = 1e-18; /* of the sum */
  Jet below = {0, 0, 0}, above = {0, 0, 0};
  double a = 1;
  for (int k = 0; k * k * a > least * below.second || a > least * below.value; k++) {
    add_term(a, k, &below);
    add_term(a / (4 * k + 2), k, &above);
    a *= t / ((4.0 * k + 2) * (4 * k + 3) * (4 * k + 4) * (4 * k + 5));
  }
  const Jet share = quotient(above, below);
  return (Jet){2 * share.value, 2 * share.first, 2 * share.second};
}

/* f = 2 / theta, from where exp(-theta) is below rounding. */
static Jet share_of(double t) {
  static const double far = 36;
  if (t < far * far * far * far) return share_by_series(t);
  double f = 2 / sqrt(sqrt(t));
  return (Jet){f, -f / 4, f * 5 / 16};
}

/* Terms of one sign: b of the letters above, subtracted from half of a, term by term. */
static Jet held_by_series(double t) {
  static const double least = 1e-18; /* of the sum */
  Jet below = {0, 0, 0}, above = {0, 0, 0};
  double a = 1, next = 1.0 / 120; /* the term after a, over t */
  for (int k = 0; k * k * a > least * below.second || a > least * below.value; k++) {
    add_term(a, k, &below);
    add_term(next * (4 * k + 4) / (4 * k + 6), k, &above);
    a = next * t;
    next *= t / ((4.0 * k + 6) * (4 * k + 7) * (4 * k + 8) * (4 * k + 9));
  }
  return quotient(above, below);
}

ZpCurlHeld zp_curl_held(double t) {
  static const double far = 36;
  if (t < far * far * far * far) {
    const Jet held = held_by_series(t);
    return (ZpCurlHeld){held.value, held.first, held.second};
  }
  const double f = 2 / sqrt(sqrt(t));
  return (ZpCurlHeld){(1 - f) / t, (1.25 * f - 1) / t, (2 - 2.8125 * f) / t};
}

ZpCurlLaw zp_curl_law(const ZpCurl *curl, double curvature) {
  double t = curl->squared * curvature * curvature;
  Jet f = share_of(t);
  return (ZpCurlLaw){0.5 * curl->EI * curvature * curvature * f.value, curl->EI * curvature * (f.value + f.first),
                     curl->EI * (f.value + 5 * f.first + 2 * f.second)};
}

/* Over a short way the quotient would lose digits; three Gauss points leave none of it. */
static ZpCurlMean mean_over_short(const ZpCurl *curl, double from, double change) {
  ZpCurlMean mean = {0, 0};
  for (int i = 0; i < GAUSS; i++) {
    ZpCurlLaw law = zp_curl_law(curl, from + gauss_at[i] * change);
    mean.M += gauss_weight[i] * law.M;
    mean.K += gauss_weight[i] * law.K * gauss_at[i];
  }
  return mean;
}

ZpCurlMean zp_curl_mean(const ZpCurl *curl, double from, double to) {
  static const double short_way = 0.25; /* in curvatures at which theta is 1 */
  double change = to - from;
  if (change == 0) {
    ZpCurlLaw law = zp_curl_law(curl, to);
    return (ZpCurlMean){law.M, 0.5 * law.K};
  }
  if (change * change * curl->squared < short_way * short_way) return mean_over_short(curl, from, change);
  ZpCurlLaw start = zp_curl_law(curl, from), end = zp_curl_law(curl, to);
  double mean = (end.W - start.W) / change;
  return (ZpCurlMean){mean, (end.M - mean) / change};
}
