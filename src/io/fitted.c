/* The file has the fitted values as keys of a scenario, and a section with how sure they are:
 *
 *   ribbon:
 *     young_modulus: 188.46 GPa
 *   fitted:
 *     outcome: converged
 *     ribbon.young_modulus:
 *       standard_error: 0.38 GPa
 *       interval_95: [187.7 GPa, null]
 *       correlation: {medium.permittivity: -0.43} */
#include "io/fitted.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "def/check.h"
#include "def/rule.h"
#include "io/file.h"
#include "io/number.h"
#include "io/report.h"
#include "io/value.h"
#include "study/result.h"

static const char section[] = "fitted", none[] = "null";

size_t zp_fitted_place(const ZpFitted *fitted, int key) {
  size_t place = 0;
  while (place < fitted->count && fitted->key[place].key != key)
    place++;
  return place;
}

double zp_fitted_correlation(const ZpFitted *fitted, size_t one, size_t two) {
  return one > two ? fitted->key[one].correlation[two] : one < two ? fitted->key[two].correlation[one] : 1;
}

bool zp_fitted_is_section(const ZpYamlItem *item) {
  const size_t length = sizeof section - 1;
  const bool begins = strncmp(item->path, section, length) == 0;
  return begins && (item->path[length] == '.' || (item->path[length] == 0 && item->kind == ZP_YAML_GROUP));
}

/* -- reading --------------------------------------------------------------------------------------- */

typedef struct Reader {
  const ZpSource *source;
  ZpFitted *fitted;
  bool has_section;
} Reader;

static ZpStatus fail_at(const Reader *reader, const ZpYamlItem *item, const char *reason, ZpError *err) {
  return zp_source_fail(reader->source, item->line, err, "%.80s: %.300s", item->path, reason);
}

/* The key of a path; it is added if it is new. NULL: an error. */
static ZpFittedKey *key_of(const Reader *reader, const ZpYamlItem *item, const char *name, ZpError *err) {
  const int key = zp_key_with_value(name);
  ZpFitted *fitted = reader->fitted;
  char reason[ZP_VALUE_SIZE] = "not a real number of an actuator, which alone can be fitted";
  if (key < 0) zp_key_unknown(name, reason, sizeof reason);
  const bool real = key >= 0 && key < ZP_KEYS && zp_value_is_real(zp_key(key));
  const size_t place = zp_fitted_place(fitted, key);
  if (real && place == ZP_FITTED_MOST) snprintf(reason, sizeof reason, "more than %d keys", ZP_FITTED_MOST);
  if (!real || place == ZP_FITTED_MOST) {
    fail_at(reader, item, reason, err);
    return NULL;
  }
  if (place == fitted->count)
    fitted->key[fitted->count++] = (ZpFittedKey){.key = key, .value = NAN, .error = NAN, .low = NAN, .high = NAN};
  return &fitted->key[place];
}

static ZpStatus take_value(const Reader *reader, const ZpYamlItem *item, ZpError *err) {
  ZpFittedKey *key = key_of(reader, item, item->path, err);
  ZpError reason;
  if (!key) return ZP_BAD_INPUT;
  if (item->kind != ZP_YAML_VALUE) return fail_at(reader, item, "a fitted key has one value", err);
  ZpStatus status = zp_value_read(key->key, item->word, &key->value, &reason);
  if (status == ZP_OK && isnan(key->value)) status = zp_fail(&reason, ZP_BAD_INPUT, "a fitted key has a number");
  if (status != ZP_OK)
    return zp_source_fail(reader->source, item->line, err, "%.80s = \"%.80s\": %.200s", item->path, item->word,
                          reason.message);
  key->line = item->line;
  return ZP_OK;
}

/* A number in the unit of the key, or null. */
static ZpStatus read_number(const Reader *reader, const ZpYamlItem *item, int key, const char *word, double *number,
                            ZpError *err) {
  ZpError reason = {ZP_BAD_INPUT, "not finite"};
  *number = NAN;
  if (strcmp(word, none) == 0) return ZP_OK;
  ZpStatus status = zp_value_quantity(key, word, number, &reason);
  return status == ZP_OK && isfinite(*number) ? ZP_OK : fail_at(reader, item, reason.message, err);
}

static ZpStatus take_error(const Reader *reader, const ZpYamlItem *item, ZpFittedKey *key, ZpError *err) {
  if (item->kind != ZP_YAML_VALUE) return fail_at(reader, item, "takes one number, or null", err);
  ZpStatus status = read_number(reader, item, key->key, item->word, &key->error, err);
  return status == ZP_OK && key->error <= 0 ? fail_at(reader, item, "give a number above 0", err) : status;
}

static ZpStatus take_interval(const Reader *reader, const ZpYamlItem *item, ZpFittedKey *key, ZpError *err) {
  if (item->kind != ZP_YAML_LIST || item->count != 2)
    return fail_at(reader, item, "takes two numbers, such as [187 GPa, null]", err);
  ZpStatus status = read_number(reader, item, key->key, item->word, &key->low, err);
  if (status != ZP_OK) return status;
  return read_number(reader, item, key->key, item->word + strlen(item->word) + 1, &key->high, err);
}

static ZpStatus take_correlation(const Reader *reader, const ZpYamlItem *item, const char *name, const char *other,
                                 ZpError *err) {
  ZpFittedKey *one = key_of(reader, item, name, err), *two = one ? key_of(reader, item, other, err) : NULL;
  double number = NAN;
  if (!two) return ZP_BAD_INPUT;
  if (one == two) return fail_at(reader, item, "a correlation is with another key", err);
  const bool known = item->kind != ZP_YAML_VALUE || strcmp(item->word, none) != 0;
  if (known && (item->kind != ZP_YAML_VALUE || !zp_number_read(item->word, &number) || !(fabs(number) <= 1)))
    return fail_at(reader, item, "give a number from -1 to 1, or null", err);
  ZpFittedKey *later = one > two ? one : two, *earlier = one > two ? two : one;
  later->correlation[earlier - reader->fitted->key] = number;
  return ZP_OK;
}

static ZpStatus take_outcome(const Reader *reader, const ZpYamlItem *item, ZpError *err) {
  int i = 0;
  while (strcmp(zp_outcome_name((ZpOutcome)i), "unknown") != 0 &&
         (item->kind != ZP_YAML_VALUE || strcmp(zp_outcome_name((ZpOutcome)i), item->word) != 0))
    i++;
  if (strcmp(zp_outcome_name((ZpOutcome)i), "unknown") == 0) return fail_at(reader, item, "not an outcome", err);
  reader->fitted->outcome = (ZpOutcome)i;
  return ZP_OK;
}

/* "KEY.standard_error" and so on, without the name of the section. */
static ZpStatus take_of_key(const Reader *reader, const ZpYamlItem *item, const char *path, ZpError *err) {
  static const char correlation[] = ".correlation.";
  char name[ZP_VALUE_SIZE];
  const char *last = strrchr(path, '.'), *other = strstr(path, correlation);
  const char *end = other ? other : last;
  snprintf(name, sizeof name, "%.*s", end ? (int)(end - path) : 0, path);
  if (other) return take_correlation(reader, item, name, other + sizeof correlation - 1, err);
  const bool is_error = last && strcmp(last, ".standard_error") == 0;
  if (!is_error && (!last || strcmp(last, ".interval_95") != 0))
    return fail_at(reader, item, "unknown; a fitted file has a standard_error, an interval_95 and correlations", err);
  ZpFittedKey *key = key_of(reader, item, name, err);
  if (!key) return ZP_BAD_INPUT;
  return is_error ? take_error(reader, item, key, err) : take_interval(reader, item, key, err);
}

/* A ZpYamlVisit. */
static ZpStatus take_item(void *user, const ZpYamlItem *item, ZpError *err) {
  Reader *reader = user;
  const bool of_section = zp_fitted_is_section(item);
  reader->has_section |= of_section;
  if (item->kind == ZP_YAML_GROUP) return ZP_OK;
  if (!of_section) return take_value(reader, item, err);
  const char *path = item->path + sizeof section;
  if (strcmp(path, "outcome") == 0) return take_outcome(reader, item, err);
  return take_of_key(reader, item, path, err);
}

static ZpStatus check(const Reader *reader, ZpError *err) {
  const ZpFitted *fitted = reader->fitted;
  if (!reader->has_section || fitted->count == 0)
    return zp_source_fail(reader->source, 0, err,
                          "not a fitted file: it has no section \"%s\"; study calibrate writes fitted.yaml", section);
  for (size_t i = 0; i < fitted->count; i++)
    if (fitted->key[i].line == 0)
      return zp_source_fail(reader->source, 0, err, "%s: no value", ZP_KEY_NAME(fitted->key[i].key));
  return ZP_OK;
}

ZpStatus zp_fitted_read(const char *path, ZpFitted *fitted, ZpError *err) {
  const ZpSource source = {.name = path};
  Reader reader = {.source = &source, .fitted = fitted};
  char *text;
  size_t size;
  *fitted = (ZpFitted){.outcome = ZP_CONVERGED};
  ZpStatus status = zp_file_read(path, ZP_YAML_LARGEST + 1, &text, &size, err);
  if (status != ZP_OK) return status;
  status = zp_yaml_read(&source, text, size, false, take_item, &reader, err);
  free(text);
  if (status == ZP_OK) return check(&reader, err);
  const size_t used = strlen(err->message);
  if (status == ZP_BAD_INPUT && !reader.has_section)
    snprintf(err->message + used, sizeof err->message - used, " (is this a fitted.yaml of study calibrate?)");
  return status;
}

/* -- writing --------------------------------------------------------------------------------------- */

static void write_number(FILE *file, int key, double number) {
  char text[ZP_VALUE_SIZE];
  if (isnan(number))
    snprintf(text, sizeof text, "%s", none);
  else
    zp_value_print(key, number, text, sizeof text);
  fputs(text, file);
}

static void write_values(const ZpFitted *fitted, FILE *file) {
  const char *before = NULL;
  for (int i = 0; i < ZP_KEYS; i++) { /* in the order of keys, which keeps groups together */
    const size_t place = zp_fitted_place(fitted, i);
    if (place == fitted->count) continue;
    zp_yaml_write_key(file, zp_key(i)->name, before);
    write_number(file, i, fitted->key[place].value);
    fputc('\n', file);
    before = zp_key(i)->name;
  }
}

static void write_key(const ZpFitted *fitted, size_t place, FILE *file) {
  const ZpFittedKey *key = &fitted->key[place];
  char number[ZP_NUMBER_SIZE];
  fprintf(file, "  %s:\n    standard_error: ", zp_key(key->key)->name);
  write_number(file, key->key, key->error);
  fputs("\n    interval_95: [", file);
  write_number(file, key->key, key->low);
  fputs(", ", file);
  write_number(file, key->key, key->high);
  fputs("]\n", file);
  for (size_t i = 0; i < place; i++) {
    zp_number_print(key->correlation[i], number, sizeof number);
    fprintf(file, "%s%s: %s", i ? ", " : "    correlation: {", zp_key(fitted->key[i].key)->name,
            isnan(key->correlation[i]) ? none : number);
  }
  if (place > 0) fputs("}\n", file);
}

/* A line of comment: "# note: TEXT". */
static ZpStatus write_comment(FILE *file, const char *what, const char *text, ZpError *err) {
  char *copy = strdup(text); /* names of columns may have line ends */
  if (!copy) return zp_fail_memory(err);
  zp_text_clean(copy);
  fprintf(file, "# %s: %s\n", what, copy);
  free(copy);
  return ZP_OK;
}

ZpStatus zp_fitted_write(const ZpFitted *fitted, const ZpResult *result, FILE *file, ZpError *err) {
  fputs(
      "# Values fitted by zipact calibrate. Another scenario takes them by base.file, and their joint distribution by\n"
      "# sampling.tolerances: base.\n",
      file);
  ZpStatus status = write_comment(file, zp_outcome_name(result->outcome), result->message, err);
  for (size_t i = 0; i < result->notes && status == ZP_OK; i++)
    status = write_comment(file, "note", result->note[i], err);
  if (status != ZP_OK) return status;
  write_values(fitted, file);
  fprintf(file, "%s:\n  outcome: %s\n", section, zp_outcome_name(fitted->outcome));
  for (size_t i = 0; i < fitted->count; i++)
    write_key(fitted, i, file);
  if (fflush(file) || ferror(file))
    return zp_fail(err, ZP_MACHINE, "the fitted values cannot be written: %s", strerror(errno));
  return ZP_OK;
}

/* -- of a report ----------------------------------------------------------------------------------- */

static double number_of(const ZpResult *result, int key, const char *which) {
  char name[ZP_VALUE_SIZE];
  snprintf(name, sizeof name, "%s%s", zp_key(key)->name, which);
  return zp_result_get(result, name);
}

/* The numbers of a fit of these keys. */
static ZpFitted fitted_of(const ZpResult *result, const int *key, size_t count) {
  ZpFitted fitted = {.count = count, .outcome = result->outcome};
  char which[ZP_VALUE_SIZE];
  for (size_t i = 0; i < count; i++) {
    ZpFittedKey *one = &fitted.key[i];
    *one = (ZpFittedKey){.key = key[i],
                         .value = number_of(result, key[i], ""),
                         .error = number_of(result, key[i], "_standard_error"),
                         .low = number_of(result, key[i], "_interval_95_low"),
                         .high = number_of(result, key[i], "_interval_95_high")};
    for (size_t k = 0; k < i; k++) {
      snprintf(which, sizeof which, "_correlation_%zu", k + 1);
      one->correlation[k] = number_of(result, key[i], which);
    }
  }
  return fitted;
}

static const char name[] = "fitted.yaml";

ZpStatus zp_fitted_report(const ZpReport *report, ZpError *err) {
  const ZpResult *result = zp_report_single(report);
  ZpActuatorDef def = {0};
  int key[ZP_FITTED_MOST], count = 0;
  const bool fits = result && zp_study_shows(result->study) == ZP_SHOWS_fit;
  if (fits && zp_scenario_def(report->scenario, 0, &def, NULL) == ZP_OK)
    zp_keys_named("calibrate.fit", def.calibrate.fit, ZP_FITTED_MOST, key, &count, NULL);
  zp_def_clear(&def);
  if (count == 0) return zp_remove_file(report->directory, name, err);
  const ZpFitted fitted = fitted_of(result, key, (size_t)count);
  ZpAtomic out;
  ZpStatus status = zp_atomic_open(&out, report->directory, name, err);
  return status == ZP_OK ? zp_atomic_finish(&out, zp_fitted_write(&fitted, result, out.file, err), err) : status;
}

/* -- what is doubtful ------------------------------------------------------------------------------ */

void zp_fitted_note(const ZpFitted *fitted, const char *path, bool drawn, ZpResult *result) {
  if (fitted->outcome != ZP_CONVERGED)
    zp_result_note(result, "base.file: outcome %s of the fit in %s, which has the reason: do not rely on its values",
                   zp_outcome_name(fitted->outcome), path);
  for (size_t i = 0; i < fitted->count && drawn; i++)
    if (isnan(fitted->key[i].low) || isnan(fitted->key[i].high))
      zp_result_note(result, "base.file: the data of the fit do not limit %s, so its normal distribution is a guess",
                     ZP_KEY_NAME(fitted->key[i].key));
}
