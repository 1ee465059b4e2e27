/* The terminal output of a run: its main numbers. summary.json has all numbers. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"

enum { MOST_NUMBERS = 10, MOST_ROWS = 100 };

/* A number of the summary in its printed form. */
typedef struct Shown {
  ZpStudy study;
  const char *scalar, *label;
  double factor; /* from SI to `unit` */
  const char *unit;
  bool headline; /* also in a row of a sweep; in a single run even if it does not exist */
} Shown;

static const Shown shown[] = {
#define ZP_HEADLINE(enumerator, scalar, label, factor, unit) {enumerator, scalar, label, factor, unit, true},
#define ZP_ANSWER(enumerator, scalar, label, factor, unit)   {enumerator, scalar, label, factor, unit, false},
#include <zipact/studies.def>
};
enum { SHOWN = sizeof shown / sizeof shown[0] };

static const ZpScalar *find_scalar(const ZpResult *result, const char *name) {
  for (size_t i = 0; i < zp_result_scalars(result); i++)
    if (strcmp(zp_result_scalar(result, i)->name, name) == 0) return zp_result_scalar(result, i);
  return NULL;
}

/* -- one run ---------------------------------------------------------------------------------------- */

/* The estimated error of a number, NAN if there is none. */
static double error_of(const ZpResult *result, const char *scalar) {
  static const struct {
    const char *scalar, *error;
  } estimated[] = {
#define ZP_ESTIMATE(enumerator, scalar, error, unit, safety, law) {scalar, error},
#include <zipact/studies.def>
  };
  for (size_t i = 0; i < sizeof estimated / sizeof estimated[0]; i++)
    if (strcmp(estimated[i].scalar, scalar) == 0) return zp_result_get(result, estimated[i].error);
  return NAN;
}

static void print_number(const ZpResult *result, const Shown *s, double value) {
  const double error = fabs(error_of(result, s->scalar));
  printf("  %-26s ", s->label);
  if (isnan(value))
    printf("%12s", "-");
  else
    printf("%12.6g%s%s", value * s->factor, *s->unit ? " " : "", s->unit);
  if (!isnan(value) && error > 0) printf("  +- %.2g", error * s->factor);
  printf("\n");
}

/* Print a value with so many digits, in the customary unit of the key, its number in `width` letters: "184.357 GPa". */
static void print_of_key(int key, double value, int digits, int width) {
  char rounded[32], text[64];
  snprintf(rounded, sizeof rounded, "%.*e", digits - 1, value);
  zp_value_print(key, strtod(rounded, NULL), text, sizeof text);
  const int number = (int)strcspn(text, " ");
  printf("%*.*s%s", width, number, text, text + number);
}

/* Print the interval of a fitted key: ", 95 %: 184.1 GPa .. 185.2 GPa"; "..." where it has no end. */
static void print_interval(const ZpResult *result, const char *key_name, int key) {
  char name[128];
  double end[2];
  for (int k = 0; k < 2; k++) {
    snprintf(name, sizeof name, "%s_interval_95_%s", key_name, k ? "high" : "low");
    end[k] = zp_result_get(result, name);
  }
  if (isnan(end[0]) && isnan(end[1])) return;
  printf(",  95 %%: ");
  for (int k = 0; k < 2; k++) {
    if (k) printf(" .. ");
    if (isnan(end[k]))
      printf("?");
    else
      print_of_key(key, end[k], 6, 0);
  }
}

/* Print a fitted shift, "time_offset" or "stroke_offset_2", with its standard error. => is `scalar` one? */
static bool print_shift(const ZpResult *result, const ZpScalar *scalar) {
  const char *end = strstr(scalar->name, "_offset");
  char name[128];
  if (!end || strspn(end + strlen("_offset"), "_0123456789") != strlen(end + strlen("_offset"))) return false;
  snprintf(name, sizeof name, "%s_standard_error", scalar->name);
  const double error = zp_result_get(result, name);
  printf("  %-26s %12.6g %s", scalar->name, scalar->value, scalar->unit);
  if (!isnan(error)) printf("  +- %.2g %s", error, scalar->unit);
  printf("\n");
  return true;
}

/* Print a fitted key with its standard error. => is `scalar` one? */
static bool print_fitted(const ZpResult *result, const ZpScalar *scalar) {
  const int key = zp_key_find(scalar->name);
  char name[128];
  if (key < 0) return print_shift(result, scalar);
  snprintf(name, sizeof name, "%s_standard_error", scalar->name);
  const double error = zp_result_get(result, name);
  printf("  %-26s ", scalar->name);
  print_of_key(key, scalar->value, 6, 12);
  if (!isnan(error)) {
    printf("  +- ");
    print_of_key(key, error, 2, 0);
  }
  print_interval(result, scalar->name, key);
  printf("\n");
  return true;
}

/* "bodies.hand.y_m" => "hand", for the numbers of a network that are told => its words; NULL: another number. */
static const char *part_of(const ZpScalar *scalar, char name[64]) {
  static const struct {
    const char *group, *number, *words;
  } told[] = {{"bodies", "y_m", "height"}, {"members", "zip_time_s", "zip time"}};
  for (size_t k = 0; k < sizeof told / sizeof told[0]; k++) {
    const size_t before = strlen(told[k].group) + 1, length = strlen(scalar->name), after = strlen(told[k].number) + 1;
    const bool grouped = strncmp(scalar->name, told[k].group, before - 1) == 0 && scalar->name[before - 1] == '.';
    if (!grouped || length < before + after || strcmp(scalar->name + length - after + 1, told[k].number) != 0) continue;
    snprintf(name, 64, "%.*s", (int)(length - before - after), scalar->name + before);
    return told[k].words;
  }
  return NULL;
}

/* Members and bodies of a network, some of many => how many there are. */
static size_t print_network(const ZpResult *result) {
  enum { MOST_PARTS = 16 };
  size_t count = 0;
  for (size_t i = 0; i < zp_result_scalars(result); i++) {
    const ZpScalar *scalar = zp_result_scalar(result, i);
    char name[64], label[96];
    const char *words = part_of(scalar, name);
    if (!words || count++ >= MOST_PARTS) continue;
    snprintf(label, sizeof label, "%s, %s", name, words);
    print_number(result,
                 &(Shown){.scalar = "", .label = label, .factor = 1e3, .unit = scalar->unit[0] == 's' ? "ms" : "mm"},
                 scalar->value);
  }
  if (count > MOST_PARTS) printf("  and %zu more in summary.json\n", count - MOST_PARTS);
  return count;
}

static void print_result(const ZpResult *result) {
  int printed = 0;
  printf("%s: %s\n", zp_outcome_name(zp_result_outcome(result)), zp_result_message(result));
  for (size_t i = 0; i < zp_result_scalars(result); i++)
    printed += print_fitted(result, zp_result_scalar(result, i));
  const bool tells_others = print_network(result) > 0 || find_scalar(result, "strain"); /* of a network, or a pouch */
  for (size_t i = 0; i < SHOWN && printed < MOST_NUMBERS; i++) {
    const ZpScalar *scalar = shown[i].study == zp_result_study(result) ? find_scalar(result, shown[i].scalar) : NULL;
    if (!scalar || (isnan(scalar->value) && (tells_others || !shown[i].headline))) continue;
    print_number(result, &shown[i], scalar->value);
    printed++;
  }
  for (size_t i = 0; i < zp_result_notes(result); i++)
    printf("  note: %s\n", zp_result_note_text(result, i));
}

/* -- many runs -------------------------------------------------------------------------------------- */

/* Three decimals, or as many digits of a small number; what is not 0 only by rounding is 0. */
static void print_short(const char *label, double value, const char *unit) {
  const double size = fabs(value);
  printf(size >= 1e-6 && size < 0.1 ? "  %s %8.3g %s" : "  %s %8.3f %s", label, size < 1e-6 ? 0 : value, unit);
}

static void print_headlines(const ZpResult *result) {
  for (size_t i = 0; i < SHOWN; i++) {
    const double value = zp_result_get(result, shown[i].scalar);
    if (shown[i].study == zp_result_study(result) && shown[i].headline && !isnan(value))
      print_short(shown[i].label, value * shown[i].factor, shown[i].unit);
  }
}

/* Print keys of row `index`: "drive.voltage=5 kV". False if it has no values. */
static bool print_keys(const ZpReport *report, size_t index, const int *key, size_t keys) {
  ZpActuatorDef *def = zp_def_create();
  const bool good = zp_scenario_def(report->scenario, index, def, NULL) == ZP_OK;
  for (size_t k = 0; k < keys && good; k++) {
    char text[64], name[ZP_SCENARIO_KEY_SIZE];
    zp_value_print(key[k], zp_def_get(def, key[k]), text, sizeof text);
    printf("  %s = %-10s", zp_scenario_key(report->scenario, key[k], name), text);
  }
  zp_def_destroy(def);
  return good;
}

/* With the swept keys. */
static void print_row(const ZpReport *report, size_t index) {
  size_t lists;
  const int *list = zp_scenario_lists(report->scenario, &lists);
  const ZpResult *result = report->rows->get(report->rows->user, index);
  if (!print_keys(report, index, list, lists)) return;
  printf("  %-12s", zp_outcome_name(zp_result_outcome(result)));
  print_headlines(result);
  printf("\n");
}

/* Print a best case; of a design with samples its statistics, also those of the constraints. */
static void print_best(const ZpReport *report, size_t place) {
  const ZpOptimum *optimum = report->optimum;
  const size_t row = optimum->row[place], goals = optimum->objectives + optimum->constraints;
  const bool sampled = optimum->samples > 1;
  if (!sampled)
    print_row(report, row);
  else if (print_keys(report, row, optimum->variable, optimum->variables))
    printf("  %zu samples\n", optimum->samples);
  for (size_t g = 0; g < (sampled ? goals : optimum->objectives); g++) {
    const bool is_bound = g >= optimum->objectives;
    printf("    %s%s%s = %.6g\n", is_bound ? optimum->constraint[g - optimum->objectives] : optimum->objective[g],
           sampled ? "." : "", sampled ? optimum->statistic[g] : "", optimum->value[place * goals + g]);
  }
}

/* Print the best cases of an optimisation. */
static void print_optimum(const ZpReport *report) {
  printf("%s\n", report->optimum->message);
  for (size_t i = 0; i < report->optimum->count; i++)
    print_best(report, i);
}

/* Print the numbers of a sweep as a whole. */
static void print_largest(const ZpReport *report) {
  static const struct {
    ZpStudy study;
    const char *scalar, *where, *words, *unit;
  } largest[] = {
#define ZP_LARGEST(enumerator, name, scalar, where, words, unit) {enumerator, scalar, where, words, unit},
#include <zipact/studies.def>
  };
  for (size_t i = 0; i < sizeof largest / sizeof largest[0] && report->count > 0; i++) {
    double value = zp_report_largest(report, largest[i].scalar, largest[i].where);
    if (zp_result_study(report->rows->get(report->rows->user, 0)) == largest[i].study && !isnan(value))
      printf("%s %.4g %s, of these\n", largest[i].words, value, largest[i].unit);
  }
}

static void print_rows(const ZpReport *report) {
  for (size_t i = 0; i < report->count && i < MOST_ROWS; i++)
    print_row(report, i);
  if (report->count > MOST_ROWS) printf("  ... and %zu more rows in table.csv\n", report->count - MOST_ROWS);
  print_largest(report);
}

void summary_print(const ZpReport *report, bool plots) {
#ifdef _WIN32
  static const char results[] = "";
#else
  static const char results[] = ", results.h5";
#endif
  if (report->optimum)
    print_optimum(report);
  else if (report->rows)
    print_rows(report);
  else if (report->count > 0)
    print_result(report->result[0]);
  printf("results: %s/ (all numbers: summary.json; table.csv%s%s)\n", report->directory, results,
         plots ? ", plots/" : "");
}
