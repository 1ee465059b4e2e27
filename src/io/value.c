/* Values as people write them, "130 um", and back.
 *
 * A number is a decimal, [+-]digits[.digits][e[+-]digits], never hexadecimal, "nan" or "inf"; it is read with a decimal
 * point in any locale. A unit that is a power of ten of the SI unit is applied to the exponent of the decimal before
 * conversion to a double, so that there is only one rounding: "50 um" and "5e-5" are the same double. */
#include "io/value.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <zipact/io.h>

#include "base/fail.h"
#include "def/check.h"
#include "io/number.h"
#include "io/source.h"
#include "io/units.h"

/* A decimal in a text. */
typedef struct Decimal {
  int mantissa;    /* length of sign, digits and point at the start of the text */
  long exponent;   /* power of ten; values far beyond the range of doubles are limited to EXPONENT_LIMIT */
  const char *end; /* the text after the number */
} Decimal;

enum { EXPONENT_LIMIT = 100000 };

static const char *skip_digits(const char *c) {
  while (isdigit((unsigned char)*c))
    c++;
  return c;
}

/* Read a complete exponent at `c`: the e of "5 eV" or "5e" is not one. */
static const char *scan_exponent(const char *c, long *exponent) {
  if (*c != 'e' && *c != 'E') return c;
  const char *digits = c + 1 + (c[1] == '+' || c[1] == '-');
  const char *end = skip_digits(digits);
  if (end == digits) return c;
  long size = 0;
  for (; digits < end && size < EXPONENT_LIMIT; digits++)
    size = size * 10 + (*digits - '0');
  if (size > EXPONENT_LIMIT) size = EXPONENT_LIMIT;
  *exponent = c[1] == '-' ? -size : size;
  return end;
}

/* (text) => the decimal at its start; false if there is none. */
static bool scan_decimal(const char *text, Decimal *decimal) {
  const char *whole = text + (*text == '+' || *text == '-');
  const char *whole_end = skip_digits(whole);
  const char *fraction = whole_end + (*whole_end == '.');
  const char *end = skip_digits(fraction);
  if (whole_end == whole && end == fraction) return false;
  decimal->mantissa = (int)(end - text);
  decimal->exponent = 0;
  decimal->end = scan_exponent(end, &decimal->exponent);
  return true;
}

/* The value of a decimal times 10^shift: correctly rounded, with a decimal point in any locale. Infinite if it exceeds
 * the range of doubles, NAN if there is no memory for the locale. */
static double decimal_value(const char *text, const Decimal *decimal, int shift) {
  char plain[ZP_VALUE_SIZE + 32];
  double value;
  snprintf(plain, sizeof plain, "%.*se%ld", decimal->mantissa, text, decimal->exponent + shift);
  return zp_number_read(plain, &value) ? value + 0.0 : (double)NAN; /* -0 becomes 0, so that a value has one text */
}

static bool is_pure(const ZpKey *key) {
  return strcmp(key->unit, "1") == 0;
}

bool zp_value_is_real(const ZpKey *key) {
  return key->type == ZP_KEY_REAL || key->type == ZP_KEY_REAL_AUTO;
}

bool zp_value_is_number(const ZpKey *key) {
  return zp_value_is_real(key) || key->type == ZP_KEY_INT;
}

ZpPaths zp_key_paths(int index) {
  const char *name = zp_key(index)->name, *last = strrchr(name, '.');
  if (strcmp(name, "data.file") == 0 || strcmp(name, "plan.candidates") == 0) return ZP_PATHS_SEVERAL;
  return last && strcmp(last, ".file") == 0 ? ZP_PATHS_ONE : ZP_PATHS_NONE;
}

void zp_value_range(int index, char *text, size_t size) {
  const ZpKey *key = zp_key(index);
  char least[ZP_VALUE_SIZE], most[ZP_VALUE_SIZE];
  zp_value_print(index, key->min, least, sizeof least);
  zp_value_print(index, key->max, most, sizeof most);
  bool automatic = key->type == ZP_KEY_REAL_AUTO;
  snprintf(text, size, "%.64s to %.64s%s%s", least, most, automatic ? " or " : "", automatic ? key->text : "");
}

/* "REASON; give a value in um from 1 um to 5000 um" */
static ZpStatus fail_number(int index, const char *reason, ZpError *err) {
  const ZpKey *key = zp_key(index);
  char range[ZP_RANGE_SIZE];
  zp_value_range(index, range, sizeof range);
  if (key->type == ZP_KEY_INT) return zp_fail(err, ZP_BAD_INPUT, "%s; give a whole number from %s", reason, range);
  if (is_pure(key)) return zp_fail(err, ZP_BAD_INPUT, "%s; give a number from %s", reason, range);
  return zp_fail(err, ZP_BAD_INPUT, "%s; give a value in %s from %s", reason, key->shown, range);
}

/* Keys in the unit of control.signal: numbers without a unit, or with any of these units. */
static const struct {
  const char *key, *unit[4];
} of_signal[] = {{"control.proportional", {"V", "V/m", "V/F", "V/rad"}},
                 {"control.integral", {"V/s", "V/m/s", "V/F/s", "V/rad/s"}},
                 {"control.noise", {"m", "F", "rad"}},
                 {"setpoint.value", {"m", "F", "rad"}},
                 {"setpoint.offset", {"m", "F", "rad"}}};

static bool read_unit_of_signal(const ZpKey *key, const char *unit, ZpUnitScale *scale) {
  for (size_t i = 0; i < sizeof of_signal / sizeof of_signal[0]; i++)
    for (int k = 0; k < 4 && of_signal[i].unit[k] && strcmp(zp_key_of_one(key->name), of_signal[i].key) == 0; k++)
      if (zp_unit_scale(unit, of_signal[i].unit[k], scale, NULL) == ZP_OK) return true;
  return false;
}

/* The scale of the unit after a number. If the key has no unit, only per cent is accepted, because UDUNITS would also
 * convert radians and the like. */
static ZpStatus read_unit(int index, const char *unit, ZpUnitScale *scale, ZpError *err) {
  const ZpKey *key = zp_key(index);
  *scale = (ZpUnitScale){.decimal = true, .factor = 1};
  if (*unit == 0) return ZP_OK;
  if (is_pure(key) && read_unit_of_signal(key, unit, scale)) return ZP_OK;
  if (key->type != ZP_KEY_INT && is_pure(key) && (strcmp(unit, "%") == 0 || strcmp(unit, "percent") == 0)) {
    scale->exponent = -2;
    return ZP_OK;
  }
  if (is_pure(key)) return fail_number(index, "this key has no unit", err);
  ZpError reason;
  ZpStatus status = zp_unit_scale(unit, key->unit, scale, &reason);
  if (status == ZP_BAD_INPUT) return fail_number(index, reason.message, err);
  if (status != ZP_OK) return zp_fail(err, status, "%s", reason.message);
  return ZP_OK;
}

static ZpStatus check_number(int index, const char *text, double value, ZpError *err) {
  const ZpKey *key = zp_key(index);
  char range[ZP_RANGE_SIZE], taken[ZP_VALUE_SIZE] = "";
  if (isnan(value)) return zp_fail_memory(err);
  if (isinf(value)) return fail_number(index, "too large for a number", err);
  if (key->type == ZP_KEY_INT && value != floor(value)) return fail_number(index, "not a whole number", err);
  if (value >= key->min && value <= key->max) return ZP_OK;
  zp_value_range(index, range, sizeof range);
  if (zp_value_is_bare(index, text)) snprintf(taken, sizeof taken, "taken as %.6g %s, which is ", value, key->unit);
  return zp_fail(err, ZP_BAD_INPUT, "%sout of range; %s", taken, range);
}

/* Is some digit of the decimal not 0? Then a value of 0 is an underflow. */
static bool has_digits(const char *text, const Decimal *decimal) {
  return strcspn(text, "123456789") < (size_t)decimal->mantissa;
}

/* "8,5 g", as in some countries, or "8 g, 9 g" without the brackets of a list; `rest`: what follows the first number.
 */
static ZpStatus fail_comma(int index, const char *text, const char *rest, ZpError *err) {
  char reason[ZP_VALUE_SIZE];
  if (*rest == ',' && isdigit((unsigned char)rest[1]))
    return fail_number(index, "not a decimal number; decimals have a point, not a comma", err);
  snprintf(reason, sizeof reason, "not one value; a list needs brackets: [%.100s]", text);
  return fail_number(index, reason, err);
}

ZpStatus zp_value_quantity(int index, const char *text, double *value, ZpError *err) {
  Decimal decimal;
  ZpUnitScale scale;
  if (!scan_decimal(text, &decimal)) return fail_number(index, "not a number", err);
  const char *unit = decimal.end;
  if (strchr(unit, ',')) return fail_comma(index, text, unit, err);
  if (*unit && strchr("_,.xX+-0123456789", *unit) && !isspace((unsigned char)*unit))
    return fail_number(index, "not a decimal number", err);
  while (isspace((unsigned char)*unit))
    unit++;
  ZpStatus status = read_unit(index, unit, &scale, err);
  if (status != ZP_OK) return status;
  double number = decimal_value(text, &decimal, scale.decimal ? scale.exponent : 0);
  if (!scale.decimal) number *= scale.factor;
  if (number == 0 && has_digits(text, &decimal)) return fail_number(index, "too small for a number", err);
  *value = number;
  return ZP_OK;
}

bool zp_value_is_bare(int index, const char *text) {
  const ZpKeyType type = zp_key(index)->type;
  Decimal decimal;
  text += strspn(text, " \t");
  if ((type != ZP_KEY_REAL && type != ZP_KEY_REAL_AUTO) || is_pure(zp_key(index))) return false;
  if (!scan_decimal(text, &decimal) || !has_digits(text, &decimal)) return false;
  return *(decimal.end + strspn(decimal.end, " \t")) == 0;
}

static ZpStatus read_number(int index, const char *text, double *value, ZpError *err) {
  double number = NAN;
  ZpStatus status = zp_value_quantity(index, text, &number, err);
  if (status == ZP_OK) status = check_number(index, text, number, err);
  if (status == ZP_OK) *value = number;
  return status;
}

static ZpStatus read_bool(const char *text, double *value, ZpError *err) {
  static const char *const words[] = {"false", "true", "no", "yes", "off", "on"};
  for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
    if (strcasecmp(text, words[i]) == 0) {
      *value = i % 2 ? 1 : 0;
      return ZP_OK;
    }
  return zp_fail(err, ZP_BAD_INPUT, "%s; give true or false", *text ? "neither true nor false" : "empty");
}

/* Distance of a word from a choice; a beginning of the choice is near, whatever its length. */
static int distance_to_choice(const char *text, const char *word) {
  size_t length = strlen(text);
  return length && strncasecmp(text, word, length) == 0 ? 1 : zp_word_distance(text, word);
}

static ZpStatus fail_word(const ZpKey *key, const char *text, ZpError *err) {
  char words[256] = "";
  int nearest = 0;
  for (int i = 0; i <= (int)key->max; i++) {
    size_t used = strlen(words);
    snprintf(words + used, sizeof words - used, "%s%s", i ? ", " : "", key->choices[i].word);
    if (distance_to_choice(text, key->choices[i].word) < distance_to_choice(text, key->choices[nearest].word))
      nearest = i;
  }
  return zp_fail(err, ZP_BAD_INPUT, "%snot one of %s; did you mean %s?", *text ? "" : "empty, ", words,
                 key->choices[nearest].word);
}

static ZpStatus read_trimmed(int index, const char *text, double *value, ZpError *err) {
  const ZpKey *key = zp_key(index);
  if (key->type == ZP_KEY_TEXT) return zp_fail(err, ZP_BAD_INPUT, "this key takes a text, not a value");
  if (key->type == ZP_KEY_BOOL) return read_bool(text, value, err);
  if (key->type == ZP_KEY_ENUM) {
    const int place = zp_key_choice(index, text);
    if (place < 0) return fail_word(key, text, err);
    *value = place;
    return ZP_OK;
  }
  if (*text == 0) return fail_number(index, "empty", err);
  bool automatic = key->type == ZP_KEY_REAL_AUTO;
  if (automatic && strcmp(text, key->text) == 0) {
    *value = NAN;
    return ZP_OK;
  }
  if (strcmp(text, "auto") == 0)
    return fail_number(index, automatic ? "this key can be none, not auto" : "this key cannot be auto", err);
  return read_number(index, text, value, err);
}

/* Number of bytes of the blank at the start of `text`, 0 if there is none. Besides ASCII blanks: the no-break, figure,
 * thin and narrow no-break spaces that web pages and word processors put between number and unit. */
static size_t blank_at(const char *text) {
  static const char *const wide[] = {"\u00A0", "\u2007", "\u2009", "\u202F"};
  for (size_t i = 0; i < sizeof wide / sizeof wide[0]; i++)
    if (strncmp(text, wide[i], strlen(wide[i])) == 0) return strlen(wide[i]);
  return isspace((unsigned char)*text) ? 1 : 0;
}

/* Copy without the blanks at both ends, with wide blanks as spaces. False if `copy` is too small. */
static bool copy_trimmed(const char *text, char *copy, size_t size) {
  size_t used = 0, end = 0;
  for (size_t length; *text; text += length) {
    size_t blank = blank_at(text);
    length = blank ? blank : 1;
    if (blank && used == 0) continue;
    if (used + 1 == size) return false;
    copy[used++] = blank > 1 ? ' ' : *text;
    if (!blank) end = used;
  }
  copy[end] = 0;
  return true;
}

ZpStatus zp_value_read(int index, const char *text, double *value, ZpError *err) {
  char copy[ZP_VALUE_SIZE];
  if (copy_trimmed(text, copy, sizeof copy)) return read_trimmed(index, copy, value, err);
  return zp_fail(err, ZP_BAD_INPUT, "longer than %d bytes", ZP_VALUE_SIZE - 1);
}

ZpStatus zp_value_read_part(int index, const char *name, const char *text, double *value, ZpError *err) {
  ZpError reason = {ZP_BAD_INPUT, "give a number"};
  ZpStatus status = zp_value_read(index, text, value, &reason);
  if (status == ZP_OK && isfinite(*value)) return ZP_OK;
  return zp_fail(err, reason.status, "%.120s = \"%.60s\": %.300s", name, text, reason.message);
}

ZpStatus zp_value_parse(int index, const char *text, double *value, ZpError *err) {
  ZpError reason;
  if (!zp_key(index)) return zp_fail(err, ZP_BAD_INPUT, "there is no key number %d", index);
  ZpStatus status = zp_value_read(index, text, value, &reason);
  if (status == ZP_OK) return ZP_OK;
  zp_fail(err, status, "%s = \"%.80s\": %s", ZP_KEY_NAME(index), text, reason.message);
  if (err) zp_text_clean(err->message);
  return status;
}

double zp_rounded(double value) {
  char text[32];
  snprintf(text, sizeof text, "%.11e", value);
  return strtod(text, NULL);
}

/* "90 degree": for units that are not a power of ten of the SI unit, if the text reads back to the same bits. */
static bool print_factor(const ZpKey *key, double factor, double value, char *text, size_t size) {
  char number[ZP_NUMBER_SIZE];
  double shown = zp_rounded(value / factor);
  if (shown * factor != value) return false;
  zp_number_print(shown, number, sizeof number);
  snprintf(text, size, "%s %s", number, key->shown);
  return true;
}

/* "100 mm" for 0.1 m, if the text reads back to the same bits. */
static bool print_shown(const ZpKey *key, const ZpUnitScale *scale, double value, char *text, size_t size) {
  char number[ZP_NUMBER_SIZE];
  Decimal decimal;
  if (!isfinite(value)) return false;
  if (!scale->decimal) return print_factor(key, scale->factor, value, text, size);
  zp_number_print(value, number, sizeof number);
  if (!scan_decimal(number, &decimal)) return false;
  zp_number_print(decimal_value(number, &decimal, -scale->exponent), number, sizeof number);
  if (!scan_decimal(number, &decimal) || decimal_value(number, &decimal, scale->exponent) != value) return false;
  snprintf(text, size, "%s %s", number, key->shown);
  return true;
}

/* "0.1 m": for values without a short form in the customary unit. */
static void print_si(const ZpKey *key, double value, char *text, size_t size) {
  char number[ZP_NUMBER_SIZE];
  const bool bare = is_pure(key) || !isfinite(value) || value == 0;
  zp_number_print(value, number, sizeof number);
  snprintf(text, size, "%s%s%s", number, bare ? "" : " ", bare ? "" : key->unit);
}

ZpShownUnit zp_value_unit(int index) {
  const ZpKey *key = zp_key(index);
  ZpShownUnit shown = {false, {0}};
  shown.known = key && *key->shown && zp_unit_scale(key->shown, key->unit, &shown.scale, NULL) == ZP_OK;
  return shown;
}

void zp_value_print(int index, double value, char *text, size_t size) {
  const ZpShownUnit shown = isfinite(value) ? zp_value_unit(index) : (ZpShownUnit){false, {0}};
  zp_value_print_in(index, &shown, value, text, size);
}

void zp_value_print_in(int index, const ZpShownUnit *shown, double value, char *text, size_t size) {
  const ZpKey *key = zp_key(index);
  if (!key)
    zp_number_print(value, text, size);
  else if (key->type == ZP_KEY_TEXT)
    snprintf(text, size, "\"%s\"", key->text);
  else if (key->type == ZP_KEY_BOOL)
    snprintf(text, size, "%s", value != 0 ? "true" : "false");
  else if (key->type == ZP_KEY_ENUM)
    snprintf(text, size, "%s", value >= 0 && value <= key->max ? key->choices[(int)value].word : "?");
  else if (key->type == ZP_KEY_REAL_AUTO && isnan(value))
    snprintf(text, size, "%s", key->text);
  else if (!shown->known || !print_shown(key, &shown->scale, value, text, size))
    print_si(key, value, text, size);
}

ZpStatus zp_def_set_value(ZpActuatorDef *def, const char *key, const char *text, ZpError *err) {
  int index = zp_key_find(key);
  double value = NAN;
  if (index < 0 || zp_key(index)->type == ZP_KEY_TEXT) return zp_def_set_word(def, key, text, err);
  ZpStatus status = zp_value_parse(index, text, &value, err);
  return status == ZP_OK ? zp_def_set(def, index, value, err) : status;
}

/* -- units and quantities that are no values of keys ------------------------------------------------- */

/* The name of a quantity in a unit, to say that a value is not such a quantity. */
static const struct {
  const char *unit, *noun;
} nouns[] = {
    {"m", "a length"},
    {"Pa", "a pressure"},
    {"kg/m3", "a density"},
    {"V/m", "an electric field"},
    {"kg", "a mass"},
    {"m/s2", "an acceleration"},
    {"N/m", "a force per length"},
    {"V", "a voltage"},
    {"s", "a time"},
    {"Hz", "a frequency"},
    {"N", "a force"},
    {"N s2/m2", "a drag coefficient"},
    {"V/s", "a slew rate"},
    {"A", "a current"},
    {"F", "a capacitance"},
    {"ohm", "a resistance"},
    {"rad", "an angle"},
    {"N m/rad", "a torsional stiffness"},
    {"N m", "a torque"},
    {"kg m2", "a moment of inertia"},
};

ZpStatus zp_unit_fail_dimension(const char *to, ZpError *err) {
  for (size_t i = 0; i < sizeof nouns / sizeof nouns[0]; i++)
    if (strcmp(nouns[i].unit, to) == 0) return zp_fail(err, ZP_BAD_INPUT, "not %s", nouns[i].noun);
  return zp_fail(err, ZP_BAD_INPUT, "not in a unit like %s", to);
}

double zp_unit_apply(const ZpUnitScale *scale, double number, double per) {
  if (scale->decimal && scale->exponent < 0) return number / (pow(10, -scale->exponent) * per);
  return number * (scale->decimal ? pow(10, scale->exponent) : scale->factor) / per;
}

ZpStatus zp_quantity_read(const char *text, const char *unit, double *value, ZpError *err) {
  ZpUnitScale scale = {.decimal = true, .factor = 1};
  Decimal decimal;
  *value = NAN;
  if (!scan_decimal(text, &decimal)) return ZP_OK;
  const char *given = decimal.end + strspn(decimal.end, " \t");
  const bool pure = strcmp(unit, "1") == 0 || strcmp(unit, "count") == 0;
  if (pure && strcmp(given, "%") == 0)
    scale.exponent = -2;
  else if (pure && *given)
    return zp_fail(err, ZP_BAD_INPUT, "this output has no unit");
  ZpStatus status = *given && !pure ? zp_unit_scale(given, unit, &scale, err) : ZP_OK;
  *value = zp_rounded(decimal_value(text, &decimal, scale.decimal ? scale.exponent : 0) *
                      (scale.decimal ? 1 : scale.factor));
  return status;
}
