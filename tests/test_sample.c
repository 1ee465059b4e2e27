/* Points, distributions and statistics of sampled campaigns: nets as Sobol's theory says, quantiles against erfc,
 * moments and indices in closed form. */
#include "check_util.h"

#include "sample/design.h"
#include "sample/distribution.h"
#include "sample/sobol.h"
#include "sample/statistics.h"
#include "sample/together.h"

static const double pi = 3.14159265358979323846;

static ZpDesign design_of(ZpSampling method, size_t count, int dimensions, bool indices) {
  return (ZpDesign){.method = method, .count = count, .seed = 7, .dimensions = dimensions, .indices = indices};
}

/* The first 8 points in the first two dimensions, in eighths: van der Corput's, and the one of polynomial x + 1. */
TEST(sobol_begins_as_published) {
  static const uint32_t first[] = {0, 4, 2, 6, 1, 5, 3, 7}, second[] = {0, 4, 6, 2, 5, 1, 3, 7};
  for (uint32_t i = 0; i < 8; i++) {
    ck_assert_uint_eq(zp_sobol(i, 0), first[i] << 29);
    ck_assert_uint_eq(zp_sobol(i, 1), second[i] << 29);
  }
}

/* Keys of a Latin square go up and down independently of each other: ranks of two keys are not related. With 64 points
 * a correlation of independent ones has a standard deviation of 1/8. */
TEST(latin_columns_are_independent) {
  enum { POINTS = 64, KEYS = 4 };
  const ZpDesign design = design_of(ZP_SAMPLING_LATIN_HYPERCUBE, POINTS, KEYS, false);
  for (int a = 0; a < KEYS; a++)
    for (int b = 0; b < a; b++) {
      double sum = 0;
      for (size_t i = 0; i < POINTS; i++)
        sum += (zp_design_share(&design, i, a) - 0.5) * (zp_design_share(&design, i, b) - 0.5);
      ck_below(fabs(12 * sum / POINTS), 0.5);
    }
}

/* With indices a key takes two dimensions of Sobol's points. */
TEST(indices_take_two_dimensions_of_a_key) {
  const ZpDesign plain = design_of(ZP_SAMPLING_SOBOL, 8, 1, false), indices = design_of(ZP_SAMPLING_SOBOL, 8, 1, true);
  ck_assert_int_eq(zp_design_most(&plain), ZP_SOBOL_DIMENSIONS);
  ck_assert_int_eq(2 * zp_design_most(&indices), ZP_SOBOL_DIMENSIONS);
}

/* How many of the design's first 2^bits points lie in each of 2^bits intervals of a dimension: is it 1? */
static bool is_stratified(const ZpDesign *design, int bits, int dimension) {
  bool seen[1 << 10] = {false};
  for (size_t i = 0; i < (size_t)1 << bits; i++) {
    const size_t place = (size_t)(zp_design_share(design, i, dimension) * (double)(1 << bits));
    if (seen[place]) return false;
    seen[place] = true;
  }
  return true;
}

/* Every direction matrix is regular, and scrambling keeps that: any power of two. A wrong direction number breaks it.
 */
TEST(sobol_has_a_point_in_each_interval) {
  const ZpDesign design = design_of(ZP_SAMPLING_SOBOL, 1 << 10, ZP_SOBOL_DIMENSIONS, false);
  for (int j = 0; j < ZP_SOBOL_DIMENSIONS; j++)
    for (int bits = 1; bits <= 10; bits++)
      ck_assert_msg(is_stratified(&design, bits, j), "dimension %d, %d bits", j, bits);
}

/* The first two dimensions are a (0, 10, 2)-net: each box of 2^-a by 2^-(10 - a) has one of 1024 points. Scrambling
 * that is not nested would lose that. */
TEST(scrambled_points_are_a_net) {
  const ZpDesign design = design_of(ZP_SAMPLING_SOBOL, 1024, 2, false);
  for (int a = 0; a <= 10; a++) {
    bool seen[1024] = {false};
    for (size_t i = 0; i < 1024; i++) {
      const size_t x = (size_t)(zp_design_share(&design, i, 0) * (1 << a));
      const size_t y = (size_t)(zp_design_share(&design, i, 1) * (1 << (10 - a)));
      ck_assert_msg(!seen[(x << (10 - a)) + y], "two points in a box of 2^-%d by 2^-%d", a, 10 - a);
      seen[(x << (10 - a)) + y] = true;
    }
  }
}

/* Of a smooth function, scrambled points integrate with an error of order count^-3/2, random ones with count^-1/2. */
static double rms_error(ZpSampling method, size_t count) {
  enum { SEEDS = 32 };
  double square = 0;
  for (uint32_t seed = 1; seed <= SEEDS; seed++) {
    const ZpDesign design = {method, count, seed, 2, false};
    double sum = 0;
    for (size_t i = 0; i < count; i++)
      sum += exp(zp_design_share(&design, i, 0)) * (1 + zp_design_share(&design, i, 1));
    const double error = sum / (double)count - 1.5 * (exp(1) - 1);
    square += error * error / SEEDS;
  }
  return sqrt(square);
}

TEST(errors_fall_as_theory_says) {
  const double sobol = log2(rms_error(ZP_SAMPLING_SOBOL, 64) / rms_error(ZP_SAMPLING_SOBOL, 4096)) / 6;
  const double random = log2(rms_error(ZP_SAMPLING_RANDOM, 64) / rms_error(ZP_SAMPLING_RANDOM, 4096)) / 6;
  ck_assert_msg(sobol > 1.3, "order %g of sobol", sobol);
  ck_assert_msg(random > 0.3 && random < 0.7, "order %g of random", random);
}

/* A point in each of as many strata, for any count; columns are permuted differently. */
TEST(latin_hypercube_has_a_point_in_each_stratum) {
  static const size_t counts[] = {1, 2, 3, 7, 100, 1000};
  for (size_t k = 0; k < LENGTH_OF(counts); k++) {
    const ZpDesign design = design_of(ZP_SAMPLING_LATIN_HYPERCUBE, counts[k], 3, false);
    size_t same = 0;
    for (int j = 0; j < 3; j++) {
      bool seen[1000] = {false};
      for (size_t i = 0; i < counts[k]; i++) {
        const size_t place = (size_t)(zp_design_share(&design, i, j) * (double)counts[k]);
        ck_assert_msg(place < counts[k] && !seen[place], "%zu points, dimension %d", counts[k], j);
        seen[place] = true;
        same += place == i;
      }
    }
    ck_assert_uint_le(same, 3 + counts[k] / 10 * 3);
  }
}

/* Pearson's chi-square of how many points lie in each of 8 by 8 parts: place y by place x, by their number for x < 0.
 */
static double pearson(const ZpDesign *design, int x, int y) {
  enum { PARTS = 8 };
  double count[PARTS][PARTS] = {{0}}, sum = 0;
  const double n = (double)design->count, expected = n / (PARTS * PARTS);
  for (size_t i = 0; i < design->count; i++) {
    const double across = x < 0 ? ((double)i + 0.5) / n : zp_design_share(design, i, x);
    count[(int)(PARTS * across)][(int)(PARTS * zp_design_share(design, i, y))]++;
  }
  for (int a = 0; a < PARTS; a++)
    for (int b = 0; b < PARTS; b++)
      sum += (count[a][b] - expected) * (count[a][b] - expected) / expected;
  return sum * (n - 1) / n; /* whose mean is the number of degrees of freedom, 7 x 7 */
}

/* The place of a point does not depend on its number, nor on its place in another column, nor does the point's position
 * inside its stratum depend on either: as chance has it, not more and not less. */
TEST(latin_hypercube_places_are_random) {
  enum { SEEDS = 40, POINTS = 256, TENTHS = 10 };
  double by_number = 0, by_column = 0, inside = 0, tenth[TENTHS] = {0};
  for (uint32_t seed = 1; seed <= SEEDS; seed++) {
    const ZpDesign design = {ZP_SAMPLING_LATIN_HYPERCUBE, POINTS, seed, 3, false};
    by_number += pearson(&design, -1, 1);
    by_column += pearson(&design, 0, 1) + pearson(&design, 1, 2);
    for (size_t i = 0; i < POINTS; i++)
      tenth[(int)(TENTHS * fmod(POINTS * zp_design_share(&design, i, 2), 1))]++;
  }
  for (int k = 0; k < TENTHS; k++)
    inside += pow(tenth[k] - POINTS * SEEDS / TENTHS, 2) / (POINTS * SEEDS / TENTHS);
  ck_chi_square("places by numbers", by_number, SEEDS * 49);
  ck_chi_square("places by places of another column", by_column, 2 * SEEDS * 49);
  ck_chi_square("positions inside a stratum", inside, TENTHS - 1);
}

TEST(designs_depend_on_the_seed_only) {
  for (int method = 0; method < ZpSampling_COUNT; method++) {
    ZpDesign design = design_of((ZpSampling)method, 64, 3, false), other = design;
    other.seed++;
    size_t same = 0;
    for (size_t i = 0; i < 64; i++) {
      const double share = zp_design_share(&design, i, 1);
      ck_assert(share > 0 && share < 1 && share == zp_design_share(&design, i, 1));
      same += share == zp_design_share(&other, i, 1);
    }
    ck_assert_uint_le(same, 1);
  }
}

TEST(normal_quantile_inverts_erfc) {
  static const double shares[] = {1e-12, 1e-6, 0.01, 0.3, 0.5, 0.7, 0.975, 0.999999};
  for (size_t i = 0; i < LENGTH_OF(shares); i++)
    ck_near(0.5 * erfc(-zp_normal_quantile(shares[i]) / sqrt(2)), shares[i], 1e-13);
  ck_near(zp_normal_quantile(0.975), 1.959963984540054, 1e-14);
  ck_assert_double_eq(zp_normal_quantile(0.5), 0);
}

TEST(quantiles_of_distributions) {
  const ZpDistribution normal = {.kind = ZP_DISTRIBUTION_NORMAL, .a = 50, .b = 2},
                       lognormal = {.kind = ZP_DISTRIBUTION_LOGNORMAL, .a = 50, .b = 0.1},
                       uniform = {.kind = ZP_DISTRIBUTION_UNIFORM, .a = 2, .b = 6},
                       by_factors = {.kind = ZP_DISTRIBUTION_LOG_UNIFORM, .a = 1, .b = 100};
  const double one = 0.5 * erfc(-1 / sqrt(2)); /* one standard deviation above the mean */
  ck_near(zp_quantile(&normal, one), 52, 1e-14);
  ck_near(zp_quantile(&lognormal, one), 50 * exp(0.1), 1e-14);
  ck_near(zp_quantile(&uniform, 0.25), 3, 1e-15);
  ck_near(zp_quantile(&by_factors, 0.5), 10, 1e-14);
}

/* -- distributions of several keys together ---------------------------------------------------------- */

enum { THREE = 3 };

static const double means[THREE] = {200, -5, 0.3}, deviations[THREE] = {4, 0.02, 1e-3};
static const double correlations[THREE * THREE] = {1, 0, 0, -0.9, 1, 0, 0.5, -0.7, 1}; /* the lower triangle */

/* Three normal distributions with these correlations, or none; cut 0: they are not cut. */
static ZpTogether joint_of(const double *R, double cut) {
  ZpTogether joint;
  bool memory;
  ck_assert(zp_together_create(&joint, THREE));
  for (int i = 0; i < THREE; i++)
    joint.each[i] = (ZpDistribution){ZP_DISTRIBUTION_NORMAL, means[i], deviations[i], means[i] - cut * deviations[i],
                                     means[i] + cut * deviations[i]};
  if (R) ck_assert(zp_together_correlate(&joint, R, &memory) && memory);
  return joint;
}

/* Mean and covariance of the standardised values of all samples; how many lie beyond a score of `cut`. */
typedef struct Moments {
  double mean[THREE], covariance[THREE][THREE];
  size_t beyond;
} Moments;

static Moments moments_of(const ZpTogether *joint, const ZpDesign *design, double cut) {
  Moments m = {0};
  const double share = 1.0 / (double)design->count;
  for (size_t s = 0; s < design->count; s++) {
    double value[THREE];
    zp_together_draw(joint, design, s, value);
    for (int i = 0; i < THREE; i++) {
      value[i] = (value[i] - means[i]) / deviations[i];
      m.mean[i] += share * value[i];
      m.beyond += fabs(value[i]) > cut;
      for (int k = 0; k <= i; k++)
        m.covariance[i][k] += share * value[i] * value[k];
    }
  }
  return m;
}

/* (12.13): means, standard deviations and correlations are those given, for each design. The errors of a mean of N
 * independent samples are N^-1/2, and those of a covariance (1 + r^2)^1/2 as large; the other designs are better. */
TESTS(joint_has_its_moments, 0, 3) {
  enum { SAMPLES = 1 << 14 };
  static const double error[] = {[ZP_SAMPLING_SOBOL] = 8e-4,             /* 2.7e-4 measured */
                                 [ZP_SAMPLING_LATIN_HYPERCUBE] = 1.5e-2, /* 5.1e-3 */
                                 [ZP_SAMPLING_RANDOM] = 5e-2};           /* 2.0e-2 */
  const ZpDesign design = design_of((ZpSampling)_i, SAMPLES, THREE, false);
  ZpTogether joint = joint_of(correlations, 0);
  const Moments m = moments_of(&joint, &design, INFINITY);
  for (int i = 0; i < THREE; i++) {
    ck_below(fabs(m.mean[i]), error[_i]);
    for (int k = 0; k <= i; k++)
      ck_below(fabs(m.covariance[i][k] - correlations[THREE * i + k]), error[_i]);
  }
  zp_together_destroy(&joint);
}

/* Without correlations, and for the first key with them, a joint distribution is the plain one, bit for bit. */
TEST(joint_of_one_is_plain) {
  const ZpDesign design = design_of(ZP_SAMPLING_SOBOL, 64, THREE, false);
  ZpTogether apart = joint_of(NULL, 0), together = joint_of(correlations, 0);
  const double none[THREE * THREE] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  ZpTogether idle = joint_of(none, 0);
  for (size_t s = 0; s < 64; s++) {
    double value[THREE], first[THREE], same[THREE];
    zp_together_draw(&apart, &design, s, value);
    zp_together_draw(&together, &design, s, first);
    zp_together_draw(&idle, &design, s, same);
    ck_assert_double_eq(first[0], value[0]);
    ck_assert_double_ne(first[1], value[1]);
    for (int i = 0; i < THREE; i++) {
      ck_assert_double_eq(value[i], zp_quantile(&apart.each[i], zp_design_share(&design, s, i)));
      ck_assert_double_eq(same[i], value[i]);
    }
  }
  zp_together_destroy(&apart);
  zp_together_destroy(&together);
  zp_together_destroy(&idle);
}

/* Cut at c standard deviations, the variance is 1 - 2 c phi(c) / (2 Phi(c) - 1), and every share of it is a share of
 * what is left. A cut far away changes no bit. */
TEST(normal_distribution_is_cut) {
  enum { SAMPLES = 1 << 14 };
  const double c = 1.5, density = exp(-c * c / 2) / sqrt(2 * pi), left = erf(c / sqrt(2));
  const ZpDesign design = design_of(ZP_SAMPLING_SOBOL, SAMPLES, THREE, false);
  ZpTogether joint = joint_of(NULL, c), far = joint_of(NULL, 1000), whole = joint_of(NULL, 0);
  const Moments m = moments_of(&joint, &design, c);
  for (int i = 0; i < THREE; i++) {
    ck_below(fabs(m.mean[i]), 2e-6);                                 /* 6.5e-7 measured */
    ck_near(m.covariance[i][i], 1 - 2 * c * density / left, 1.2e-5); /* 3.8e-6 */
    ck_near(zp_quantile(&joint.each[i], 0.25), means[i] + deviations[i] * zp_normal_quantile(0.5 - left / 4), 1e-12);
    ck_assert_double_eq(zp_quantile(&far.each[i], 0.3), zp_quantile(&whole.each[i], 0.3));
  }
  zp_together_destroy(&joint);
  zp_together_destroy(&far);
  zp_together_destroy(&whole);
}

/* No value leaves its range where another one pushes it out, either. */
TEST(correlated_values_are_cut) {
  const ZpDesign design = design_of(ZP_SAMPLING_SOBOL, 4096, THREE, false);
  ZpTogether joint = joint_of(correlations, 1), whole = joint_of(correlations, 0);
  ck_assert_uint_eq(moments_of(&joint, &design, 1 - 1e-9).beyond, 0); /* not at its ends, either */
  ck_assert_uint_gt(moments_of(&whole, &design, 1).beyond, 1000);
  zp_together_destroy(&joint);
  zp_together_destroy(&whole);
}

/* Correlations that no distribution has, or that tie a key to another one, are refused. */
TEST(impossible_correlations_are_refused) {
  static const double impossible[THREE * THREE] = {1, 0, 0, 0.9, 1, 0, 0.9, -0.9, 1},
                                         tied[THREE * THREE] = {1, 0, 0, 1 - 1e-13, 1, 0, 0, 0, 1};
  bool memory;
  ZpTogether joint = joint_of(NULL, 0);
  ck_assert(!zp_together_correlate(&joint, impossible, &memory) && memory);
  zp_together_destroy(&joint);
  joint = joint_of(NULL, 0);
  ck_assert(!zp_together_correlate(&joint, tied, &memory) && memory);
  zp_together_destroy(&joint);
}

/* 1 .. 101 in random order, and three missing values. */
TEST(statistics_in_closed_form) {
  const ZpDesign design = design_of(ZP_SAMPLING_RANDOM, 104, 1, false);
  double value[104];
  ZpSample work[104];
  for (size_t i = 0; i < 104; i++)
    value[i] = i < 101 ? 1e6 + 1 + (double)(i * 37 % 101) : (double)NAN;
  const ZpStatistics s = zp_statistics(&design, value, work);
  ck_assert_uint_eq(s.count, 101);
  ck_assert_uint_eq(s.missing, 3);
  ck_assert_double_eq(s.number[ZP_MEAN], 1e6 + 51);
  ck_near(s.number[ZP_STANDARD_DEVIATION], sqrt(101 * 102 / 12.0), 1e-15);
  ck_assert(s.number[ZP_LEAST] == 1e6 + 1 && s.number[ZP_MOST] == 1e6 + 101);
  ck_assert_double_eq(s.number[ZP_QUANTILE_05], 1e6 + 6);
  ck_assert_double_eq(s.number[ZP_MEDIAN], 1e6 + 51);
  for (size_t i = 0; i < 104; i++)
    value[i] = NAN;
  const ZpStatistics none = zp_statistics(&design, value, work);
  ck_assert(none.count == 0 && none.missing == 104 && isnan(none.number[ZP_MEAN]) &&
            isnan(none.number[ZP_QUANTILE_95]));
}

/* The numbers of samples x_i + a y_i follow a with their slopes y_i; what rests on a value that is infinite is not
 * finite, and a quantile below it is. */
TEST(slopes_of_statistics) {
  enum { COUNT = 23 };
  static const double step = 1e-4;
  for (int which = 0; which < ZP_STATISTICS; which++) {
    ZpSample at[3][COUNT], number[3];
    for (int k = 0; k < 3; k++) {
      for (int i = 0; i < COUNT; i++) {
        const double x = i * 37 % 101, y = sin(3.0 * i);
        at[k][i] = (ZpSample){x + (k - 1) * step * y, y};
      }
      number[k] = zp_statistic((ZpStatistic)which, at[k], COUNT);
    }
    ck_near(number[1].slope, (number[2].value - number[0].value) / (2 * step), 5e-9); /* 2.2e-9 measured, by rounding */
  }
  ZpSample missing[COUNT] = {{.value = INFINITY}};
  ck_assert_double_eq(zp_statistic(ZP_QUANTILE_95, missing, COUNT).value, 0);
  ck_assert(isinf(zp_statistic(ZP_MOST, missing, COUNT).value) &&
            !isfinite(zp_statistic(ZP_MEAN, missing, COUNT).value));
}

/* Ishigami and Homma's function, whose variance and indices are known. */
static double ishigami(const ZpDesign *design, size_t sample) {
  double x[3];
  for (int j = 0; j < 3; j++)
    x[j] = pi * (2 * zp_design_share(design, sample, j) - 1);
  return sin(x[0]) + 7 * sin(x[1]) * sin(x[1]) + 0.1 * x[2] * x[2] * x[2] * x[2] * sin(x[0]);
}

TEST(indices_of_ishigami) {
  enum { POINTS = 4096 };
  const double V1 = 0.5 * (1 + 0.1 * pow(pi, 4) / 5) * (1 + 0.1 * pow(pi, 4) / 5), V2 = 49 / 8.0,
               V13 = 0.01 * pow(pi, 8) * (1 / 18.0 - 1 / 50.0), V = V1 + V2 + V13;
  const double first[] = {V1 / V, V2 / V, 0}, total[] = {(V1 + V13) / V, V2 / V, V13 / V};
  const ZpDesign design = design_of(ZP_SAMPLING_SOBOL, POINTS, 3, true);
  static double value[5 * POINTS];
  static ZpSample work[5 * POINTS];
  ck_assert_uint_eq(zp_design_samples(&design), LENGTH_OF(value));
  for (size_t i = 0; i < LENGTH_OF(value); i++)
    value[i] = ishigami(&design, i);
  const ZpStatistics s = zp_statistics(&design, value, work);
  ck_assert_uint_eq(s.count, 2 * POINTS);
  ck_near(s.number[ZP_MEAN], 3.5, 1e-3);
  ck_near(s.number[ZP_STANDARD_DEVIATION], sqrt(V), 3e-4); /* 9.9e-5 measured */
  for (int j = 0; j < 3; j++) {
    const ZpIndices indices = zp_sobol_indices(&design, value, j);
    ck_below(fabs(indices.first.value - first[j]), 0.01); /* 3.8e-3 measured */
    ck_below(fabs(indices.total.value - total[j]), 0.01); /* 3.9e-3 measured */
  }
}

/* A design of few points: a dimension without influence has no share of the variance, one that alone has influence all
 * of it, whatever the points are. */
TEST(idle_dimensions_have_no_share) {
  const ZpDesign design = design_of(ZP_SAMPLING_SOBOL, 64, 3, true);
  double value[5 * 64];
  for (size_t i = 0; i < LENGTH_OF(value); i++)
    value[i] = exp(3 * zp_design_share(&design, i, 1));
  for (int j = 0; j < 3; j++) {
    const ZpIndices x = zp_sobol_indices(&design, value, j);
    const double share = j == 1;
    ck_assert(x.first.value == share && x.first.low == share && x.first.high == share);
    ck_assert(x.total.value == share && x.total.low == share && x.total.high == share);
  }
}

/* Of 400 designs of independent points, how many have intervals that hold the true indices of Ishigami's function. */
TEST(intervals_hold_the_true_indices) {
  enum { POINTS = 256, DESIGNS = 400 };
  const double V1 = 0.5 * (1 + 0.1 * pow(pi, 4) / 5) * (1 + 0.1 * pow(pi, 4) / 5), V2 = 49 / 8.0,
               V13 = 0.01 * pow(pi, 8) * (1 / 18.0 - 1 / 50.0), V = V1 + V2 + V13;
  const double first[] = {V1 / V, V2 / V, 0}, total[] = {(V1 + V13) / V, V2 / V, V13 / V};
  static double value[5 * POINTS];
  ZpDesign design = design_of(ZP_SAMPLING_RANDOM, POINTS, 3, true);
  int held = 0;
  for (design.seed = 1; design.seed <= DESIGNS; design.seed++) {
    for (size_t i = 0; i < LENGTH_OF(value); i++)
      value[i] = ishigami(&design, i);
    for (int j = 0; j < 3; j++) {
      const ZpIndices x = zp_sobol_indices(&design, value, j);
      held += x.first.low <= first[j] && first[j] <= x.first.high;
      held += x.total.low <= total[j] && total[j] <= x.total.high;
    }
  }
  const double share = held / (6.0 * DESIGNS);
  ck_assert_msg(share > 0.93 && share < 0.97, "%g of the intervals hold the index", share);
}

/* Points without a value are excluded from the indices of the dimensions that need them, not from others. */
TEST(indices_without_some_values) {
  const ZpDesign design = design_of(ZP_SAMPLING_SOBOL, 256, 2, true);
  static double value[4 * 256];
  for (size_t i = 0; i < LENGTH_OF(value); i++)
    value[i] = zp_design_share(&design, i, 0); /* which follows from dimension 0 alone */
  value[4 * 10 + ZP_BLOCK_FIRST] = NAN;
  value[4 * 20 + ZP_BLOCK_A] = NAN;
  const ZpIndices x = zp_sobol_indices(&design, value, 0), y = zp_sobol_indices(&design, value, 1);
  ck_assert(x.count == 254 && y.count == 255);
  ck_assert(x.first.value == 1 && x.total.value == 1);
  ck_assert(y.first.value == 0 && y.total.value == 0);
  for (size_t i = 0; i < LENGTH_OF(value); i++)
    value[i] = 3;
  ck_assert(isnan(zp_sobol_indices(&design, value, 0).first.value));
}
