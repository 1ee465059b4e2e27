/* Study `calibrate`: keys fitted to measurements. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "def/check.h"
#include "fit/fit.h"
#include "io/report.h"
#include "study/result.h"

static const ZpColumn time_column = {"time_s", "s", "time since the voltage was switched on"};

/* Columns of a kind: without and with standard deviations. */
enum { COLUMNS_PLAIN = 3, COLUMNS_WEIGHTED = 4 };

/* For each kind: the names of its residuals in summary.json and in the message, and the columns of its table, for one
 * kind and for several. */
typedef struct OfKind {
  const char *residual, *shown;
  double factor;
  const char *residual_of, *weighted; /* with several kinds */
  ZpColumn alone[COLUMNS_WEIGHTED], several[COLUMNS_WEIGHTED];
} OfKind;

#define COMPUTED(number, none) number ", computed with the fitted values; nan: " none
#define SIGMA                  "standard deviation of the measured value"
#define OF_KIND(kind, of, unit, shown, factor, what, number, none)                                                     \
  [kind] = {"residual_rms_" unit,                                                                                      \
            shown,                                                                                                     \
            factor,                                                                                                    \
            of "_residual_rms_" unit,                                                                                  \
            of "_weighted_rms",                                                                                        \
            {{"measured_" unit, unit, what " in data.file"},                                                           \
             {"fitted_" unit, unit, COMPUTED(number, none)},                                                           \
             {"residual_" unit, unit, "fitted minus measured"},                                                        \
             {"sigma_" unit, unit, SIGMA}},                                                                            \
            {{"measured_" of "_" unit, unit, what " in data.file"},                                                    \
             {"fitted_" of "_" unit, unit, COMPUTED(number, none)},                                                    \
             {"residual_" of "_" unit, unit, "fitted minus measured"},                                                 \
             {"sigma_" of "_" unit, unit, SIGMA}}}
static const OfKind of_kind[ZP_FIT_KINDS] = {
    OF_KIND(ZP_FIT_STROKE, "stroke", "m", "mm", 1e3, "stroke", "the same", "no equilibrium"),
    OF_KIND(ZP_FIT_DISPLACEMENT, "displacement", "m", "mm", 1e3, "displacement", "the same", "no equilibrium"),
    OF_KIND(ZP_FIT_CURRENT, "current", "A", "uA", 1e6, "current", "the same", "no motion"),
    OF_KIND(ZP_FIT_OPENING, "opening", "m", "mm", 1e3, "opening", "the same", "no equilibrium"),
    OF_KIND(ZP_FIT_CAPACITANCE, "capacitance", "F", "pF", 1e12, "capacitance", "the same", "no equilibrium"),
    OF_KIND(ZP_FIT_FORCE, "force", "N", "mN", 1e3, "force", "force_N of study isometric", "no equilibrium"),
    OF_KIND(ZP_FIT_TIME, "zip_time", "s", "ms", 1e3, "zip time", "zip_time_s of study actuate", "not closed"),
    OF_KIND(ZP_FIT_PULL_IN, "pull_in_voltage", "V", "V", 1, "pull-in voltage", "pull_in_voltage_V of study limits",
            "no pull-in"),
    OF_KIND(ZP_FIT_RELEASE, "release_voltage", "V", "V", 1, "release voltage", "release_voltage_V of study limits",
            "no release"),
    OF_KIND(ZP_FIT_FREQUENCY, "frequency", "Hz", "Hz", 1, "frequency", "frequency_1_Hz of study modes",
            "no stable equilibrium"),
};

/* With the first, second, ... key of calibrate.fit. */
static const char *const correlation[ZP_FIT_MOST - 1] = {"#_correlation_1",  "#_correlation_2",  "#_correlation_3",
                                                         "#_correlation_4",  "#_correlation_5",  "#_correlation_6",
                                                         "#_correlation_7",  "#_correlation_8",  "#_correlation_9",
                                                         "#_correlation_10", "#_correlation_11", "#_correlation_12"};

bool zp_fit_at_bound(const ZpFit *fit, const double *z, int k) {
  static const double near = 1e-6;
  double low = fit->lower[k], high = fit->upper[k];
  return z[k] <= low + near * fabs(low) || z[k] >= high - near * fabs(high);
}

/* The name of the first parameter that lies at its bound, or NULL. */
static const char *name_at_bound(const ZpFit *fit, const double *z) {
  for (int k = 0; k < fit->n; k++)
    if (zp_fit_at_bound(fit, z, k)) return fit->name[k];
  return NULL;
}

static void note_unbounded(const ZpFit *fit, int k, const ZpFitInterval *interval, ZpResult *result) {
  if (!isnan(interval->low) && !isnan(interval->high)) return;
  if (interval->lost)
    zp_result_note(result, "%s has no interval: the search did not find its ends", fit->name[k]);
  else if (interval->trades >= 0)
    zp_result_note(result,
                   "%s has no interval: within the bounds the data do not limit it, because a change of it is made up "
                   "for by %s",
                   fit->name[k], fit->name[interval->trades]);
  else
    zp_result_note(result, "%s has no interval: within the bounds the data do not limit it", fit->name[k]);
}

/* The numbers of the summary about the parameters. C: their covariance in units of z; NULL: the data cannot distinguish
 * them. */
static void report_keys(const ZpFit *fit, const double *z, double C[ZP_FIT_MOST][ZP_FIT_MOST],
                        const ZpFitJudgement *judgement, const ZpFitMissing *missing, const ZpFitInterval *interval,
                        ZpResult *result) {
  size_t n = (size_t)fit->n;
  const double variance = judgement->variance;
  for (int k = 0; k < fit->n; k++) {
    const char *name = fit->name[k], *unit = fit->unit[k];
    bool known = C && !zp_fit_at_bound(fit, z, k);
    zp_result_add_of(result, "#", name, unit, z[k] * fit->start[k]);
    zp_result_add_of(result, "#_standard_error", name, unit,
                     known ? fabs(fit->start[k]) * sqrt(variance * C[k][k]) : NAN);
    const bool turned = fit->start[k] < 0;
    const double low = turned ? interval[k].high : interval[k].low, high = turned ? interval[k].low : interval[k].high;
    zp_result_add_of(result, "#_interval_95_low", name, unit, known ? low * fit->start[k] : NAN);
    zp_result_add_of(result, "#_interval_95_high", name, unit, known ? high * fit->start[k] : NAN);
    if (known) note_unbounded(fit, k, &interval[k], result);
    for (int j = 0; j < k; j++)
      zp_result_add_of(result, correlation[j], name, "1", C ? zp_fit_correlation(fit, C, k, j) : NAN);
    if (zp_fit_at_bound(fit, z, k))
      zp_result_note(result, "%s is at a bound of its range, so it has no standard error", name);
  }
  if (C && n > 0) zp_result_add(result, "rise_95", "1", zp_fit_level(fit));
  if (fit->sigma) zp_result_add(result, "reduced_chi_square", "1", judgement->reduced);
  zp_result_add(result, "runs_test", "1", judgement->runs);
  zp_result_add(result, "law_test", "1", missing->chance);
  if (*fit->bare) zp_result_note(result, "columns without a unit in their name are read in SI: %s", fit->bare);
  if (*fit->layout) zp_result_note(result, "%s", fit->layout);
  if (*fit->idle) zp_result_note(result, "columns that are not used: %s", fit->idle);
  if (!C && n > 0)
    zp_result_note(
        result,
        "the data cannot distinguish the fitted keys, so these have no standard errors; fit fewer keys or add data");
}

/* -- the table: what was set, then what was measured and computed, kind by kind ------------------------------------ */

/* Columns of all kinds. */
enum { WEIGHTED_RESIDUAL, OUTLIER, COMMON_COLUMNS };

static const ZpColumn common_column[COMMON_COLUMNS] = {
    [WEIGHTED_RESIDUAL] = {"weighted_residual", "1",
                           "residual over its standard deviation, or over that of all residuals"},
    [OUTLIER] = {"outlier", "1", "1: a note names this row as an outlier"}};

/* A fit as the table shows it. */
typedef struct Shown {
  const ZpFitPoint *best;
  const ZpFitJudgement *judgement;
  double (*C)[ZP_FIT_MOST]; /* as report_keys */
} Shown;

/* The columns of the table: one for each quantity that was set and those of each kind, NAN in rows of another one; then
 * those of all kinds, and one for each parameter. */
typedef struct Columns {
  size_t count, x_count, width; /* width: columns of one kind */
  bool alone;                   /* there is one kind */
  ZpColumn *column;
  int *x_key; /* [x_count] */
  char (*x_name)[ZP_KEY_COLUMN_SIZE], share_name[ZP_FIT_MOST][ZP_KEY_COLUMN_SIZE];
  size_t kind[ZP_FIT_KINDS]; /* first column of a kind; 0: none yet */
  size_t common, shares;     /* the first ones of these */
} Columns;

static size_t place_of_x(const Columns *columns, int key) {
  size_t place = 0;
  while (place < columns->x_count && columns->x_key[place] != key)
    place++;
  return place;
}

static void add_x(Columns *columns, int key) {
  if (place_of_x(columns, key) < columns->x_count) return;
  char *name = columns->x_name[columns->x_count];
  columns->x_key[columns->x_count++] = key;
  if (key >= 0) zp_key_column(NULL, key, name, sizeof columns->x_name[0]);
  columns->column[columns->count++] =
      key < 0 ? time_column : (ZpColumn){name, zp_key(key)->unit, "value set on the bench"};
}

static void add_kind(Columns *columns, ZpFitKind kind) {
  if (columns->kind[kind]) return;
  columns->kind[kind] = columns->count;
  for (size_t i = 0; i < columns->width; i++)
    columns->column[columns->count++] = columns->alone ? of_kind[kind].alone[i] : of_kind[kind].several[i];
}

static void add_shares(const ZpFit *fit, Columns *columns) {
  columns->shares = columns->count;
  for (int k = 0; k < fit->n; k++) {
    char *name = columns->share_name[k];
    snprintf(name, sizeof columns->share_name[k], "information_%s", fit->name[k]);
    columns->column[columns->count++] = (ZpColumn){name, "1", "share of what all rows tell about this parameter"};
  }
}

static bool open_columns(const ZpFit *fit, Columns *columns) {
  *columns = (Columns){.width = fit->sigma ? COLUMNS_WEIGHTED : COLUMNS_PLAIN, .alone = zp_fit_kinds(fit) == 1};
  columns->column = calloc(fit->sets + (size_t)ZP_FIT_KINDS * COLUMNS_WEIGHTED + COMMON_COLUMNS + ZP_FIT_MOST,
                           sizeof *columns->column);
  columns->x_key = calloc(fit->sets, sizeof *columns->x_key);
  columns->x_name = calloc(fit->sets, sizeof *columns->x_name);
  if (!columns->column || !columns->x_key || !columns->x_name) return false;
  for (size_t i = 0; i < fit->sets; i++)
    add_x(columns, fit->set[i].x_key);
  for (size_t i = 0; i < fit->sets; i++)
    add_kind(columns, fit->set[i].kind);
  columns->common = columns->count;
  for (int i = 0; i < COMMON_COLUMNS; i++)
    columns->column[columns->count++] = common_column[i];
  add_shares(fit, columns);
  return true;
}

static bool is_outlier(const ZpFitJudgement *judgement, size_t row) {
  for (size_t i = 0; i < judgement->outliers; i++)
    if (judgement->outlier[i] == row) return true;
  return false;
}

static void fill_row(const ZpFit *fit, const Columns *columns, size_t row, const Shown *shown, double *value) {
  const double *fitted = shown->best->fitted;
  const ZpFitSet *of = zp_fit_set_of(fit, row);
  double *own = value + columns->kind[of->kind], *common = value + columns->common;
  for (size_t c = 0; c < columns->count; c++)
    value[c] = NAN;
  value[place_of_x(columns, of->x_key)] = fit->x[row];
  own[0] = fit->y[row];
  own[1] = fitted[row];
  own[2] = fitted[row] - fit->y[row];
  if (fit->sigma) own[COLUMNS_PLAIN] = fit->sigma[row];
  const double deviation = sqrt(shown->judgement->variance);
  common[WEIGHTED_RESIDUAL] = deviation > 0 ? zp_fit_residual(fit, fitted, row) / deviation : NAN;
  common[OUTLIER] = is_outlier(shown->judgement, row);
  for (int k = 0; k < fit->n && shown->C; k++)
    value[columns->shares + (size_t)k] = zp_fit_share(fit, shown->best->J, shown->C, row, k);
}

static bool fill_table(const ZpFit *fit, const Shown *shown, ZpResult *result) {
  Columns columns;
  double *value = open_columns(fit, &columns) ? calloc(columns.count, sizeof *value) : NULL;
  if (value) result->series = zp_table_create(columns.column, columns.count, fit->rows < 2 ? 2 : fit->rows);
  for (size_t row = 0; value && result->series && row < fit->rows; row++) {
    fill_row(fit, &columns, row, shown, value);
    zp_table_offer(result->series, value);
  }
  free(value);
  free(columns.column);
  free(columns.x_key);
  free(columns.x_name);
  return result->series != NULL;
}

/* -- what the summary says ------------------------------------------------------------------------- */

/* The definition of a row with the fitted keys at z, and its voltage; false if a value is out of range. */
static bool row_under_voltage(const ZpFit *fit, const double *z, size_t row, ZpActuatorDef *def, double *voltage) {
  const ZpFitSet *of = zp_fit_set_of(fit, row);
  if (of->x_key < 0) {
    const ZpFitRun *run = &fit->run[of->run];
    const bool set = zp_fit_run_def(fit, run, z, def);
    *voltage = run->rows > 0 ? 0 : fmax(def->drive.voltage, fabs(def->drive.offset));
    for (size_t i = 0; i < run->rows; i++)
      *voltage = fmax(*voltage, fabs(run->voltage[i]));
    return set;
  }
  if (!zp_fit_row(fit, z, row, def, voltage)) return false;
  if (zp_fit_number[of->kind].number) *voltage = of->kind == ZP_FIT_FREQUENCY ? def->modes.voltage : def->drive.voltage;
  return true;
}

/* The notes of the fitted model at the highest voltage of all rows. */
static ZpStatus note(const ZpFit *fit, const double *z, ZpResult *result, ZpError *err) {
  ZpActuatorDef def = *fit->def, row;
  double highest = -1, voltage;
  for (size_t i = 0; i < fit->rows; i++) {
    if (!row_under_voltage(fit, z, i, &row, &voltage) || voltage <= highest) continue;
    highest = voltage;
    def = row;
  }
  ZpModel *model;
  if (zp_model_create(&def, &model, err) == ZP_MACHINE) return ZP_MACHINE;
  if (model) zp_result_note_model(result, model, fmax(highest, 0));
  zp_model_destroy(model);
  return ZP_OK;
}

/* The static pull-in of the fitted model, for the last row of zip times: these depend most on it just above pull-in. */
static ZpStatus note_pull_in(const ZpFit *fit, const ZpFitSet *of, const double *z, ZpResult *result) {
  ZpActuatorDef def;
  ZpResult *limits = NULL;
  double voltage;
  zp_fit_row(fit, z, of->first + of->rows - 1, &def, &voltage);
  def.output.errors = false;
  ZpStatus status = zp_study_run(ZP_STUDY_LIMITS, &def, NULL, NULL, &limits, NULL);
  zp_result_add(result, "pull_in_voltage_V", "V", limits ? zp_result_get(limits, "pull_in_voltage_V") : NAN);
  zp_result_destroy(limits);
  return status == ZP_MACHINE ? status : ZP_OK;
}

/* The last set of a kind, or NULL. */
static const ZpFitSet *last_set(const ZpFit *fit, ZpFitKind kind) {
  const ZpFitSet *last = NULL;
  for (size_t i = 0; i < fit->sets; i++)
    if (fit->set[i].kind == kind) last = &fit->set[i];
  return last;
}

/* Root mean square of the residuals of a kind, in its unit and divided by the standard deviations. */
typedef struct Rms {
  double plain, weighted;
} Rms;

static Rms rms_of(const ZpFit *fit, const double *fitted, ZpFitKind kind) {
  Rms sum = {0, 0};
  size_t rows = 0;
  for (size_t i = 0; i < fit->rows; i++) {
    if (zp_fit_set_of(fit, i)->kind != kind) continue;
    sum.plain += (fitted[i] - fit->y[i]) * (fitted[i] - fit->y[i]);
    sum.weighted += zp_fit_residual(fit, fitted, i) * zp_fit_residual(fit, fitted, i);
    rows++;
  }
  const bool all = isfinite(sum.plain) && isfinite(sum.weighted);
  return all ? (Rms){sqrt(sum.plain / (double)rows), sqrt(sum.weighted / (double)rows)} : (Rms){NAN, NAN};
}

static void report_residuals(const ZpFit *fit, const double *fitted, ZpResult *result) {
  const bool alone = zp_fit_kinds(fit) == 1;
  for (int k = 0; k < ZP_FIT_KINDS; k++) {
    const ZpFitKind kind = (ZpFitKind)k;
    if (!last_set(fit, kind)) continue;
    const Rms rms = rms_of(fit, fitted, kind);
    const char *name = alone ? of_kind[kind].residual : of_kind[kind].residual_of;
    zp_result_add(result, name, zp_fit_number[kind].unit, rms.plain);
    if (!alone) zp_result_add(result, of_kind[kind].weighted, "1", rms.weighted);
  }
}

/* "9 rows fitted, residual 0.00221 mm rms"; with several kinds, residuals divided by the standard deviations. */
static void say(const ZpFit *fit, const double *fitted, const char *bound, double square, ZpResult *result) {
  const char *done = fit->n > 0 ? "fitted" : "compared", *at = bound ? "; at its bound: " : "";
  const ZpFitKind kind = fit->set[0].kind;
  if (zp_fit_kinds(fit) == 1)
    snprintf(result->message, sizeof result->message, "%zu row%s %s, residual %.3g %s rms%s%s", fit->rows,
             fit->rows == 1 ? "" : "s", done, of_kind[kind].factor * rms_of(fit, fitted, kind).plain,
             of_kind[kind].shown, at, bound ? bound : "");
  else
    snprintf(result->message, sizeof result->message,
             "%zu rows of %zu kinds %s, residual %.3g standard deviations rms%s%s", fit->rows, zp_fit_kinds(fit), done,
             sqrt(square / (double)fit->rows), at, bound ? bound : "");
}

/* Does a point lie beyond the interval of a key? */
static bool is_beyond(const ZpFit *fit, const double *z, const ZpFitInterval *interval) {
  for (int k = 0; k < fit->keys; k++)
    if (z[k] < interval[k].low || z[k] > interval[k].high) return true;
  return false;
}

/* Is another minimum, beyond the intervals of the best one, as good as that, as far as the data say? */
static bool is_ambiguous(const ZpFit *fit, const ZpFitStarts *starts, const ZpFitInterval *interval) {
  const double freedom = (double)fit->rows - fit->n, t = zp_fit_student(freedom);
  const double variance = fit->sigma ? 1 : starts->best / freedom;
  return fit->n > 0 && starts->next - starts->best < t * t * variance && is_beyond(fit, starts->other, interval);
}

/* Why a fit is doubtful. */
static void report_doubts(const ZpFit *fit, const ZpFitPoint *best, const ZpFitJudgement *judgement,
                          const ZpFitStarts *starts, const ZpFitInterval *interval, const ZpFitMissing *missing,
                          ZpResult *result) {
  if (judgement->runs < 0.01)
    zp_result_note(result,
                   "residuals are not noise: so few runs of one sign have a probability of %.1g; the model lacks "
                   "something, or the measurement has a drift",
                   judgement->runs);
  if (zp_fit_is_missing(missing))
    zp_result_note(
        result,
        "the model lacks something like %s (%s), which would remove %.2g %% of the squares of the residuals; "
        "noise alone shows as much with a probability of %.1g",
        missing->what, missing->key, 100 * missing->share, missing->chance);
  if (judgement->too_large < 0.01)
    zp_result_note(result, "residuals are larger than the standard deviations given: reduced chi-square %.3g",
                   judgement->reduced);
  if (!best->ended) zp_result_note(result, "the search ended before the minimum");
  if (is_ambiguous(fit, starts, interval)) {
    char text[256] = "";
    for (int k = 0; k < fit->keys; k++) {
      const size_t used = strlen(text);
      snprintf(text + used, sizeof text - used, "%s%s %.5g %s", k ? ", " : "", fit->name[k],
               starts->other[k] * fit->start[k], fit->unit[k]);
    }
    zp_result_note(result, "other values fit as well: %s", text);
  }
  for (size_t i = 0; i < judgement->outliers; i++)
    zp_result_note(result, "outlier: row %zu, %.4g standard deviations from the fit", judgement->outlier[i] + 1,
                   fabs(zp_fit_residual(fit, best->fitted, judgement->outlier[i])) / sqrt(judgement->variance));
}

static ZpStatus solve_and_report(ZpFit *fit, ZpFitPoint *best, ZpResult *result, ZpError *err) {
  ZpFitStarts starts;
  bool good = zp_fit_solve(fit, best, &starts);
  if (fit->status != ZP_OK) return fit->status;
  ZpFitJudgement judgement = zp_fit_judge(fit, best);
  ZpFitMissing missing = {NULL, NULL, 0, NAN};
  ZpFitInterval interval[ZP_FIT_MOST];
  ZpFitProfiles profiles = {0};
  for (int k = 0; k < ZP_FIT_MOST; k++)
    interval[k] = (ZpFitInterval){NAN, NAN, -1, false};
  if (good) zp_fit_intervals(fit, judgement.variance, best, interval, &profiles);
  if (good) judgement = zp_fit_judge(fit, best);
  if (good) missing = zp_fit_find_missing(fit, best);
  if (fit->status != ZP_OK) return fit->status;
  double covariance[ZP_FIT_MOST][ZP_FIT_MOST], (*C)[ZP_FIT_MOST] = NULL;
  if (good && zp_fit_covariance(fit, best->J, NULL, 0, 1e-10, covariance)) C = covariance;
  const double *z = best->z, *fitted = best->fitted, square = best->square;
  const bool doubtful = !zp_fit_is_noise(&judgement) || zp_fit_is_missing(&missing) ||
                        is_ambiguous(fit, &starts, interval) || !best->ended;
  const char *bound = name_at_bound(fit, z);
  result->outcome = fit->stopped ? ZP_INTERRUPTED
                    : !good      ? ZP_NOT_SETTLED
                    : doubtful   ? ZP_DOUBTFUL
                    : bound      ? ZP_AT_BOUND
                                 : ZP_CONVERGED;
  if (good)
    say(fit, fitted, bound, square, result);
  else
    snprintf(result->message, sizeof result->message,
             fit->stopped ? "interrupted" : "the model gives no value for some rows within the bounds");
  report_keys(fit, z, C, &judgement, &missing, interval, result);
  report_doubts(fit, best, &judgement, &starts, interval, &missing, result);
  if (note(fit, z, result, err) != ZP_OK) return ZP_MACHINE;
  const ZpFitSet *times = last_set(fit, ZP_FIT_TIME);
  if (good && times && note_pull_in(fit, times, z, result) != ZP_OK) return zp_fail_memory(err);
  report_residuals(fit, fitted, result);
  zp_result_add(result, "data_rows", "count", (double)fit->rows);
  zp_result_add(result, "evaluations", "count", fit->evaluations);
  result->further[ZP_FURTHER_LIKELIHOOD] = zp_fit_likelihood(fit, best, judgement.variance, C, &profiles);
  result->further[ZP_FURTHER_REGIONS] = zp_fit_regions(fit, best, judgement.variance, C);
  if (fit->status != ZP_OK) return fit->status;
  const Shown shown = {best, &judgement, C};
  return fill_table(fit, &shown, result) && !result->incomplete ? ZP_OK : zp_fail_memory(err);
}

ZpStatus zp_fit_run(const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult **out, ZpError *err) {
  ZpFit fit;
  ZpStatus status = zp_fit_open(def, &fit, err);
  const bool runs = status == ZP_OK && out;
  fit.hooks = hooks;
  ZpResult *result = runs ? zp_result_create(ZP_STUDY_CALIBRATE) : NULL;
  ZpFitPoint best = {0};
  if (runs && (!result || !zp_fit_open_point(&fit, &best))) status = zp_fail_memory(err);
  if (runs && status == ZP_OK) status = solve_and_report(&fit, &best, result, err);
  free(best.fitted);
  zp_fit_close(&fit);
  if (runs && status == ZP_OK)
    *out = result;
  else
    zp_result_destroy(result);
  return status;
}
