/* A fit of keys to measurements: its keys, its data, its functions. */
#ifndef ZP_FIT_FIT_H
#define ZP_FIT_FIT_H

#include <zipact/calibrate.h>

enum {
  ZP_FIT_KEYS = 5,                           /* keys fitted at once, */
  ZP_FIT_SHIFTS = 8,                         /* and shifts of times and measured columns, */
  ZP_FIT_MOST = ZP_FIT_KEYS + ZP_FIT_SHIFTS, /* and both */
  ZP_FIT_OTHERS = 8                          /* further columns that set keys */
};

/* The kinds of measurement: a stroke, its change since there was no voltage, an opening or a capacitance, at rest or
 * over time; a current over time; or a number that a study computes. */
typedef enum ZpFitKind {
  ZP_FIT_STROKE,
  ZP_FIT_DISPLACEMENT,
  ZP_FIT_OPENING,
  ZP_FIT_CAPACITANCE,
  ZP_FIT_CURRENT,
  ZP_FIT_FORCE,
  ZP_FIT_TIME,
  ZP_FIT_PULL_IN,
  ZP_FIT_RELEASE,
  ZP_FIT_FREQUENCY,
  ZP_FIT_KINDS
} ZpFitKind;

/* For each kind: the name of its column and its unit; if a study computes it, this study and its number. */
typedef struct ZpFitNumber {
  const char *column, *unit;
  ZpStudy study;
  const char *number; /* NULL: no study computes it */
  bool has_slopes;    /* derivatives with respect to keys are available at rest */
} ZpFitNumber;

extern const ZpFitNumber zp_fit_number[ZP_FIT_KINDS];

/* A record over time: one run, whose measured columns are sets. */
typedef struct ZpFitRun {
  int keys; /* columns with one value all the time, which set these keys */
  int key[ZP_FIT_OTHERS];
  double value[ZP_FIT_OTHERS];
  size_t rows;            /* of the voltage that drove it; 0: drive.* does */
  double *time, *voltage; /* [rows] s, V */
  double from;            /* what the times of the file have at the start of the run, s */
  int late;               /* the parameter that is the time of the record at the start of the run; -1: none */
  double last;            /* time of its last row, s */
  double closing;         /* when a measured column has first done half of what it does, s */
} ZpFitRun;

/* One measured column of one file: rows of one kind, against one quantity that was set. */
typedef struct ZpFitSet {
  ZpFitKind kind;
  int x_key;  /* the key that was set; -1: x is time, s */
  size_t run; /* over time: of which record */
  int zero;   /* the parameter that is its reading of 0; -1: none */
  int others; /* further columns whose header is a key, which set this key for their row */
  int other_key[ZP_FIT_OTHERS];
  double *other[ZP_FIT_OTHERS]; /* [rows] SI */
  size_t first, rows;           /* first row of the set among all rows, and their number */
  size_t file, before;          /* of which file, and how many rows of that come before its first */
} ZpFitSet;

/* Which names of calibrate.x and .y (bits), and which kinds of measurement (bits of ZpFitKind; of ZP_FIT_KINDS: times),
 * files have. */
typedef struct ZpFitNamed {
  unsigned x, y, kinds;
} ZpFitNamed;

/* Exact derivatives are those of one run with its time steps. Differences over what the data leave open average over
 * the small jumps that values have where faces touch and part, and cost less; one-sided ones serve a search. */
typedef enum ZpFitSlopes { ZP_FIT_EXACT, ZP_FIT_ONE_SIDED, ZP_FIT_CENTRAL } ZpFitSlopes;

typedef struct ZpFit {
  const ZpActuatorDef *def;
  bool planned;       /* its rows are possible measurements: they have no values, y is NAN */
  const char *source; /* the key that names its files */
  ZpFitNamed named;   /* by its files, and by those of the fit that was opened before */
  const ZpHooks *hooks;
  int n, keys; /* number of parameters: first keys, then shifts; their values are z times `start` */
  int key[ZP_FIT_KEYS];
  double start[ZP_FIT_MOST];
  double first[ZP_FIT_MOST];                     /* of z: 1 of keys, 0 of shifts */
  double lower[ZP_FIT_MOST], upper[ZP_FIT_MOST]; /* of z */
  char name[ZP_FIT_MOST][64];                    /* "ribbon.young_modulus", "time_offset" */
  const char *unit[ZP_FIT_MOST];
  ZpFitRun *run; /* [runs] */
  size_t runs;
  ZpFitSet *set; /* [sets] */
  size_t sets, rows;
  double *x, *y;    /* [rows] SI, one set after the other */
  char bare[160];   /* columns without a unit in their name: "load in kg, stroke in m" */
  char idle[200];   /* columns that are not used: "monday.csv: Date, Remark; tuesday.csv: Date" */
  char layout[300]; /* which lines of a file are its table, where that is not plain */
  double *sigma;    /* [rows] standard deviations of y; NULL: not given, all rows have the same weight */
  double tolerance; /* of the time steps of records, if solver.tolerance is auto; NAN: the usual one */
  double way[ZP_FIT_KEYS][ZP_FIT_KEYS]; /* steps of differences in columns: changes of z that are independent */
  double enough;      /* a descent ends where the squares would fall by less than this share of their mean, */
  double rough;       /* and where they would by less than this, but do not */
  ZpFitSlopes slopes; /* how the derivatives of records by keys are found */
  double scatter;     /* of the sum of squares from point to point, by the errors of the time steps */
  double horizon;     /* rows of records count up to the closing and this share of the time after it */
  int evaluations;
  bool stopped;    /* the progress hook asked to stop */
  ZpStatus status; /* of the machine */
  ZpError *err;
} ZpFit;

/* Neither stopped nor out of memory? */
bool zp_fit_goes_on(const ZpFit *fit);

/* Read and check the keys and data of a fit. To be closed whatever the status is. */
ZpStatus zp_fit_open(const ZpActuatorDef *def, ZpFit *fit, ZpError *err);

/* Likewise of a plan: first the data that there are, where some names may be those of candidates, then the candidates
 * of plan.candidates. `data` NULL: there are none. */
ZpStatus zp_fit_open_present(const ZpActuatorDef *def, ZpFit *fit, ZpError *err);
ZpStatus zp_fit_open_candidates(const ZpActuatorDef *def, const ZpFit *data, ZpFit *fit, ZpError *err);
void zp_fit_close(ZpFit *fit);

/* Read the files of measurements into the sets and rows of `fit`, whose keys are known. `all`: each name in the keys of
 * calibrate must be one that a file has. */
ZpStatus zp_fit_read_sets(ZpFit *fit, bool all, ZpError *err);

/* Is this key a real number, which can be fitted and set by a column? */
bool zp_fit_takes(int key);

/* Is a row of a record beyond the horizon? */
bool zp_fit_is_beyond(const ZpFit *fit, const ZpFitSet *of, size_t row);

/* The set of a row; the number of different kinds. */
const ZpFitSet *zp_fit_set_of(const ZpFit *fit, size_t row);
size_t zp_fit_kinds(const ZpFit *fit);

/* The definition of row `row` with the fitted keys at z, and the voltage that the row sets, 0 if none. False if a value
 * is out of the range of its key. */
bool zp_fit_row(const ZpFit *fit, const double *z, size_t row, ZpActuatorDef *def, double *voltage);

/* The definition of a record with the fitted keys at z. False if a value is out of the range of its key. */
bool zp_fit_run_def(const ZpFit *fit, const ZpFitRun *run, const double *z, ZpActuatorDef *def);

/* Size of a key with which its changes and errors are compared, in multiples of its start: it may be negative, or pass
 * 0. */
double zp_fit_size(double z);

/* Likewise of parameter k at z; a shift is compared with its unit at least. */
double zp_fit_size_of(const ZpFit *fit, int k, double z);

/* Sign of a change of the stroke as an actuator closes. */
double zp_fit_closing(const ZpModel *model);

/* The value that the model computes for row `row`, SI, unless the row belongs to a run in time; NAN if there is no such
 * value. */
double zp_fit_predict(ZpFit *fit, const double *z, size_t row);

/* Values of the model at z => fitted [rows], NAN where there is none; unless J is NULL, their derivatives with respect
 * to z, weighted as the residuals and 0 where there is none => J [rows][n]. False if one of the values does not exist,
 * no derivative is found, the progress hook asked to stop, or there is no memory. */
bool zp_fit_evaluate(ZpFit *fit, const double *z, double *fitted, double *J);

/* Sum of squares of the weighted residuals, up to the horizon. A row without a value counts as twice the largest
 * measured value of its set. */
double zp_fit_square(const ZpFit *fit, const double *fitted);

/* A point of a fit. */
typedef struct ZpFitPoint {
  double z[ZP_FIT_MOST];
  double square;
  bool good;          /* all rows have a value */
  bool ended;         /* it is a minimum */
  double *fitted, *J; /* [rows], [rows][n] behind them, as zp_fit_evaluate */
} ZpFitPoint;

/* Its arrays; false if there is no memory. Free `fitted` afterwards. */
bool zp_fit_open_point(ZpFit *fit, ZpFitPoint *point);

/* Each has arrays of its own. */
void zp_fit_copy_point(const ZpFit *fit, const ZpFitPoint *from, ZpFitPoint *to);

/* Steps of differences as parts of the keys, where nothing is known about their errors. */
void zp_fit_reset_ways(ZpFit *fit);

/* Values, derivatives and the sum of squares at its z. */
void zp_fit_go_to(ZpFit *fit, ZpFitPoint *point);

/* Likewise without derivatives: its J stays. */
void zp_fit_find_values(ZpFit *fit, ZpFitPoint *point);

/* The way of parameter k to a value, and where a way ends, within the bounds. Positive keys trade against each other by
 * powers, so the model is nearly linear in their logarithms: their way is that of the logarithm times the key, so that
 * derivatives at the point are those by the key. */
double zp_fit_way(const ZpFit *fit, int k, double from, double to);
double zp_fit_end(const ZpFit *fit, int k, double from, double way);

/* The minimum of the linear model at a point, within the bounds => to [n], and by how much the squares fall until
 * there. `held` as below. False if it is not determined. */
bool zp_fit_step(const ZpFit *fit, const ZpFitPoint *at, const bool *held, double *to, double *falls);

/* Go from a point to the nearest minimum within the bounds, in at most so many iterations (Levenberg and Marquardt).
 * `held` [n]: parameters that stay; NULL: none. => whether the minimum was reached. */
bool zp_fit_descend(ZpFit *fit, const bool *held, int most, ZpFitPoint *point);

/* Likewise, of a record with derivatives that stay while they serve; `kept`: they are those of a point nearby. */
bool zp_fit_descend_kept(ZpFit *fit, const bool *held, int most, bool kept, ZpFitPoint *point);

/* Derivatives J by the parameters at one point, as they are at another if the model is linear in the ways between. */
void zp_fit_carry_slopes(const ZpFit *fit, const double *from, const double *to, double *J);

/* Minima to which several starts have led. */
typedef struct ZpFitStarts {
  int tried;                 /* how many starts were followed to the end */
  double best;               /* sum of squares at the best minimum, with the time steps of the search, */
  double next;               /* and sum of squares of the best other minimum; INFINITY: there is none */
  double other[ZP_FIT_MOST]; /* z there */
} ZpFitStarts;

/* The best minimum within the bounds from all starts. False if there is no memory, or no start has a value for all
 * rows. */
bool zp_fit_solve(ZpFit *fit, ZpFitPoint *best, ZpFitStarts *starts);

/* Read and check the input of study calibrate and, unless `out` is NULL, run it. */
ZpStatus zp_fit_run(const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult **out, ZpError *err);

/* Fitted minus measured value, divided by the standard deviation if there is one. */
double zp_fit_residual(const ZpFit *fit, const double *fitted, size_t row);

/* Tests of the residuals of a fit. */
typedef struct ZpFitJudgement {
  double reduced;    /* chi-square over the degrees of freedom; NAN: standard deviations are not known */
  double too_large;  /* probability of a larger chi-square if model and standard deviations are true; NAN likewise */
  double runs;       /* probability of as few runs of residuals of one sign; NAN: too few rows */
  double succession; /* and of as large a correlation from row to row */
  double variance;   /* of a weighted residual: 1 if standard deviations are known */
  size_t outliers;   /* rows whose residual is so large that not one in twenty such fits has it, */
  size_t outlier[8]; /* the largest ones first */
} ZpFitJudgement;

ZpFitJudgement zp_fit_judge(const ZpFit *fit, const ZpFitPoint *best);

/* Are these residuals noise? */
bool zp_fit_is_noise(const ZpFitJudgement *judgement);

/* The law that the model lacks and that would explain most of what the residuals still show. */
typedef struct ZpFitMissing {
  const char *what, *key; /* NULL: none explains anything */
  double share;           /* of the sum of squares that it would remove */
  double chance;          /* probability that noise alone lets the best law remove as much; NAN: not asked */
} ZpFitMissing;

/* Of a fit of records at its best point (docs/theory.md, (12.6)). */
ZpFitMissing zp_fit_find_missing(ZpFit *fit, const ZpFitPoint *best);

/* Does it explain more than noise would? */
bool zp_fit_is_missing(const ZpFitMissing *missing);

/* Student's distribution: the value that a share of 0.975 is below, for so many degrees of freedom. */
double zp_fit_student(double freedom);

/* Interval of a parameter that covers the true value in 95 of 100 fits, by the profile of the likelihood; NAN where an
 * end is unbounded, within the bounds of z. */
typedef struct ZpFitInterval {
  double low, high; /* z */
  int trades;       /* the parameter against which an unbounded one trades; -1: none */
  bool lost;        /* an end was not found, although there may be one */
} ZpFitInterval;

/* A point of a profile: parameter `held` is held there, the others fit best. */
typedef struct ZpFitProfilePoint {
  int held;
  double rise;           /* of the sum of squares, from its minimum */
  double z[ZP_FIT_MOST]; /* of all parameters */
} ZpFitProfilePoint;

enum { ZP_FIT_PROFILES = 64 * ZP_FIT_MOST };

/* Points of the profiles of all parameters, in the order in which they were found. */
typedef struct ZpFitProfiles {
  size_t count;
  ZpFitProfilePoint point[ZP_FIT_PROFILES];
} ZpFitProfiles;

/* Intervals of all parameters [n], and the points on the way to them. Where a point is found that fits better, `best`
 * goes there first. */
void zp_fit_intervals(ZpFit *fit, double variance, ZpFitPoint *best, ZpFitInterval *interval, ZpFitProfiles *points);

/* The rise of the sum of squares, in multiples of the variance of a residual, at the ends of intervals, and on the edge
 * of the joint region of two parameters, (12.4) and (12.11). */
double zp_fit_level(const ZpFit *fit);
double zp_fit_joint_level(const ZpFit *fit);

/* Correlation of the estimates of two parameters; C: the covariance in units of z. */
double zp_fit_correlation(const ZpFit *fit, double C[ZP_FIT_MOST][ZP_FIT_MOST], int a, int b);

/* Is parameter k at one of its bounds? */
bool zp_fit_at_bound(const ZpFit *fit, const double *z, int k);

/* The share of what all rows tell about parameter k that this row tells, (12.12). C as above. */
double zp_fit_share(const ZpFit *fit, const double *J, double C[ZP_FIT_MOST][ZP_FIT_MOST], size_t row, int k);

/* Tables of the profiles and of the joint regions at the best point; NULL if there is no memory, as `fit` then says, or
 * nothing to show. C as above, NULL: the data cannot distinguish the parameters. */
ZpTable *zp_fit_likelihood(ZpFit *fit, const ZpFitPoint *best, double variance, double C[ZP_FIT_MOST][ZP_FIT_MOST],
                           const ZpFitProfiles *points);
ZpTable *zp_fit_regions(ZpFit *fit, const ZpFitPoint *best, double variance, double C[ZP_FIT_MOST][ZP_FIT_MOST]);

/* Inverse of J^T J, whose diagonal is first multiplied by 1 + ridge, in units of z => C, by Cholesky. A key that
 * `stays` (NULL: none) has no covariance with another. False if a pivot is at most `least` times its diagonal: the data
 * cannot distinguish the keys. */
bool zp_fit_covariance(const ZpFit *fit, const double *J, const bool *stays, double ridge, double least,
                       double C[ZP_FIT_MOST][ZP_FIT_MOST]);

#endif
