/* A fit of keys to measurements: what is fitted to what. */
#ifndef ZP_FIT_FIT_H
#define ZP_FIT_FIT_H

#include <zipact/calibrate.h>

enum {
  ZP_FIT_MOST = 5,  /* keys fitted at once */
  ZP_FIT_OTHERS = 8 /* further columns that set keys */
};

/* What is measured, at rest or over time: a stroke, an opening, a capacitance; or a number of a study. */
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

/* Of a kind: what its column is called, its unit; where it is a number of a study, that study and number. */
typedef struct ZpFitNumber {
  const char *column, *unit;
  ZpStudy study;
  const char *number; /* NULL: the kind is no number of a study */
  bool has_slopes;    /* derivatives by keys are known at rest */
} ZpFitNumber;

extern const ZpFitNumber zp_fit_number[ZP_FIT_KINDS];

/* One measured column of one file: rows of one kind, against one thing that was set. */
typedef struct ZpFitSet {
  ZpFitKind kind;
  int x_key;  /* what is set; -1: x is time, s */
  int others; /* further columns whose header is a key: set for their row, too */
  int other_key[ZP_FIT_OTHERS];
  double *other[ZP_FIT_OTHERS]; /* [rows] SI */
  size_t first, rows;           /* of the rows of the fit */
} ZpFitSet;

typedef struct ZpFit {
  const ZpActuatorDef *def;
  const ZpHooks *hooks;
  int n; /* keys fitted; their values are z times the start */
  int key[ZP_FIT_MOST];
  double start[ZP_FIT_MOST];
  double lower[ZP_FIT_MOST], upper[ZP_FIT_MOST]; /* of z */
  ZpFitSet *set;                                 /* [sets] */
  size_t sets, rows;
  double *x, *y; /* [rows] SI, set after set */
  double *sigma; /* [rows] standard deviations of y; NULL: not given, all alike */
  int evaluations;
  bool stopped;    /* the progress hook asked for it */
  ZpStatus status; /* of the machine */
  ZpError *err;
} ZpFit;

/* Read and check all that `def` says of the fit. To be closed whatever the status. */
ZpStatus zp_fit_open(const ZpActuatorDef *def, ZpFit *fit, ZpError *err);
void zp_fit_close(ZpFit *fit);

/* Read the files of measurements into the sets and rows of `fit`, whose keys are known. */
ZpStatus zp_fit_read_sets(ZpFit *fit, ZpError *err);

/* Whether a key is a real number, which may be fitted and set by a column. */
bool zp_fit_takes(int key);

/* The set to which a row belongs; how many kinds there are. */
const ZpFitSet *zp_fit_set_of(const ZpFit *fit, size_t row);
size_t zp_fit_kinds(const ZpFit *fit);

/* The definition of row `row` with the fitted keys at z, and the voltage that the row sets, 0 if none. False if a
 * value is out of its key's range. */
bool zp_fit_row(const ZpFit *fit, const double *z, size_t row, ZpActuatorDef *def, double *voltage);

/* What the model gives for row `row`, SI, which is not one of a run; NAN where it finds none. */
double zp_fit_predict(ZpFit *fit, const double *z, size_t row);

/* Find the z [n] that fit best and the fitted values [rows] there. False if there is no memory or no fit. */
bool zp_fit_solve(ZpFit *fit, double *z, double *fitted);

/* Read and check what study calibrate is given; run it. */
ZpStatus zp_fit_check(const ZpActuatorDef *def, ZpError *err);
ZpStatus zp_fit_run(const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult **out, ZpError *err);

/* Fitted minus measured over its standard deviation, or as it is where none are given. */
double zp_fit_residual(const ZpFit *fit, const double *fitted, size_t row);

/* Derivative of the fitted values by z, as residuals are weighted => J [rows][n]. False where there is none. */
bool zp_fit_jacobian(ZpFit *fit, const double *z, double *J);

#endif
