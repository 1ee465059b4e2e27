/* A fit of keys to measurements: its keys, its data, its functions. */
#ifndef ZP_FIT_FIT_H
#define ZP_FIT_FIT_H

#include <zipact/calibrate.h>

enum {
  ZP_FIT_MOST = 5,  /* keys fitted at once */
  ZP_FIT_OTHERS = 8 /* further columns that set keys */
};

/* The kinds of measurement: a stroke, opening or capacitance, at rest or over time; or a number that a study computes.
 */
typedef enum ZpFitKind {
  ZP_FIT_STROKE,
  ZP_FIT_OPENING,
  ZP_FIT_CAPACITANCE,
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

/* One measured column of one file: rows of one kind, against one quantity that was set. */
typedef struct ZpFitSet {
  ZpFitKind kind;
  int x_key;  /* the key that was set; -1: x is time, s */
  int others; /* further columns whose header is a key, which set this key for their row */
  int other_key[ZP_FIT_OTHERS];
  double *other[ZP_FIT_OTHERS]; /* [rows] SI */
  size_t first, rows;           /* first row of the set among all rows, and their number */
} ZpFitSet;

typedef struct ZpFit {
  const ZpActuatorDef *def;
  const ZpHooks *hooks;
  int n; /* number of fitted keys; their values are z times the start values */
  int key[ZP_FIT_MOST];
  double start[ZP_FIT_MOST];
  double lower[ZP_FIT_MOST], upper[ZP_FIT_MOST]; /* of z */
  ZpFitSet *set;                                 /* [sets] */
  size_t sets, rows;
  double *x, *y;  /* [rows] SI, one set after the other */
  char bare[160]; /* columns without a unit in their name: "load in kg, stroke in m" */
  char idle[200]; /* columns that are not used: "monday.csv: Date, Remark; tuesday.csv: Date" */
  double *sigma;  /* [rows] standard deviations of y; NULL: not given, all rows have the same weight */
  int evaluations;
  bool searches;   /* values need no derivatives yet */
  bool stopped;    /* the progress hook asked to stop */
  ZpStatus status; /* of the machine */
  ZpError *err;
} ZpFit;

/* Read and check the keys and data of a fit. To be closed whatever the status is. */
ZpStatus zp_fit_open(const ZpActuatorDef *def, ZpFit *fit, ZpError *err);
void zp_fit_close(ZpFit *fit);

/* Read the files of measurements into the sets and rows of `fit`, whose keys are known. */
ZpStatus zp_fit_read_sets(ZpFit *fit, ZpError *err);

/* Is this key a real number, which can be fitted and set by a column? */
bool zp_fit_takes(int key);

/* The set of a row; the number of different kinds. */
const ZpFitSet *zp_fit_set_of(const ZpFit *fit, size_t row);
size_t zp_fit_kinds(const ZpFit *fit);

/* The definition of row `row` with the fitted keys at z, and the voltage that the row sets, 0 if none. False if a value
 * is out of the range of its key. */
bool zp_fit_row(const ZpFit *fit, const double *z, size_t row, ZpActuatorDef *def, double *voltage);

/* The value that the model computes for row `row`, SI, unless the row belongs to a run in time; NAN if there is no such
 * value. */
double zp_fit_predict(ZpFit *fit, const double *z, size_t row);

/* Find the z [n] with the best fit, and the fitted values [rows]. False if there is no memory or no fit. */
bool zp_fit_solve(ZpFit *fit, double *z, double *fitted);

/* Read and check the input of study calibrate and, unless `out` is NULL, run it. */
ZpStatus zp_fit_run(const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult **out, ZpError *err);

/* Fitted minus measured value, divided by the standard deviation if there is one. */
double zp_fit_residual(const ZpFit *fit, const double *fitted, size_t row);

/* Derivative of the fitted values with respect to z, weighted as the residuals => J [rows][n]. False if there is none.
 */
bool zp_fit_jacobian(ZpFit *fit, const double *z, double *J);

/* Inverse of J^T J, whose diagonal is first multiplied by 1 + ridge, in units of z => C, by Cholesky. A key that
 * `stays` (NULL: none) has no covariance with another. False if a pivot is at most `least` times its diagonal: the data
 * cannot distinguish the keys. */
bool zp_fit_covariance(const ZpFit *fit, const double *J, const bool *stays, double ridge, double least,
                       double C[ZP_FIT_MOST][ZP_FIT_MOST]);

#endif
