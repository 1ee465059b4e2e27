/* Units of measurement, by UDUNITS-2.
 *
 * UDUNITS parses with static variables, so it is used under a lock. The database is read at the first unit, so
 * scenarios in plain SI do not need it; it stays in memory until the process ends, because reading it takes some 5 ms
 * and a look-up some 10 us. The lock and the database are mutable globals (guard.c has the only other ones); no result
 * depends on the order of calls.
 *
 * UDUNITS accepts more than people mean by a unit: "5 10 mm" (50 mm), "s since 1970", "mm @ 3", "Hz" as the inverse of
 * s. Anything but a plain product of powers of named units is refused here. */
#include "io/units.h"

#include <ctype.h>
#include <errno.h>
#include <float.h>
#include <locale.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <udunits2.h>

#include "base/fail.h"
#include "io/guard.h"
#include "io/source.h"

/* Memory for reading a unit and the database, bytes. */
enum { ROOM = 1 << 18, DATABASE_ROOM = 1 << 23 };

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static ut_system *database; /* guarded by `lock`; NULL until the first unit is read */

/* A digit must belong to an exponent (m2, m^2, m-2, m^-2), or be the 1 of "1/m". Any other digit would be a hidden
 * factor in the unit. */
static bool digit_allowed(const char *text, size_t i) {
  if (i == 0) return text[0] == '1' && text[1] == '/';
  char before = text[i - 1];
  if (before == '-' && i > 1) before = text[i - 2];
  return isalnum((unsigned char)before) || before == '^';
}

static bool is_plain_unit(const char *text) {
  size_t size = strlen(text), length;
  for (size_t i = 0; i < size; i += length) {
    length = zp_text_character(text + i, size - i);
    if (length == 0) return false;
    unsigned char c = (unsigned char)text[i];
    bool letter = isalpha(c) || c == '_' || length > 1; /* longer: the micro sign */
    bool digit = isdigit(c) && digit_allowed(text, i);
    if (!letter && !digit && !strchr(" .*/^()-", c)) return false;
  }
  return true;
}

/* Read the database if it is not in memory, in the C locale, because it contains decimal points. */
static ZpStatus need_database(ZpError *err) {
  if (database) return ZP_OK;
  locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
  if (!plain) return zp_fail_memory(err);
  locale_t users = uselocale(plain);
  errno = 0;
  database = ut_read_xml(NULL);
  int reason = errno;
  uselocale(users);
  freelocale(plain);
  if (database) { /* which lacks a common notation */
    ut_unit *degree = ut_parse(database, "degree", UT_UTF8);
    if (degree) ut_map_name_to_unit("deg", UT_UTF8, degree);
    ut_free(degree);
    return ZP_OK;
  }
  ut_status ignored;
  return zp_fail(err, ZP_MACHINE, "cannot read the UDUNITS-2 database %.200s: %s", ut_get_path_xml(NULL, &ignored),
                 reason ? strerror(reason) : "not a unit database");
}

/* A factor that UDUNITS multiplies has rounding errors (g/cm3: 999.99999999999989); the factors of customary units are
 * short decimals, except for angles. */
static ZpUnitScale scale_of_factor(double factor) {
  static const double errors = 8 * DBL_EPSILON;
  char text[40], one[40];
  snprintf(text, sizeof text, "%.13e", factor);
  const char *exponent = strchr(text, 'e');
  size_t digits = (size_t)(exponent - text);
  snprintf(one, sizeof one, "%.13e", 1.0);
  ZpUnitScale scale = {.factor = strtod(text, NULL)};
  if (fabs(scale.factor - factor) > errors * factor) scale.factor = factor;
  scale.decimal = strncmp(text, one, digits) == 0;
  if (scale.decimal) scale.exponent = (int)strtol(exponent + 1, NULL, 10);
  return scale;
}

/* Only y = factor x with a positive finite factor is a scale; UDUNITS also has offsets, logarithms, inverses. */
static ZpStatus scale_between(ut_unit *from, ut_unit *to, const char *to_text, ZpUnitScale *scale, ZpError *err) {
  cv_converter *converter = ut_get_converter(from, to);
  if (!converter) return zp_unit_fail_dimension(to_text, err);
  const double factor = cv_convert_double(converter, 1), twice = cv_convert_double(converter, 2);
  cv_free(converter);
  const bool proportional = isnormal(factor) && factor > 0 && fabs(twice - 2 * factor) <= 1e-12 * twice;
  if (!proportional) return zp_unit_fail_dimension(to_text, err);
  *scale = scale_of_factor(factor);
  return ZP_OK;
}

static ZpStatus scale_locked(const char *from, const char *to, ZpUnitScale *scale, ZpError *err) {
  ZpStatus status = need_database(err);
  if (status != ZP_OK) return status;
  ut_unit *to_unit = ut_parse(database, to, UT_UTF8);
  ut_unit *from_unit = to_unit ? ut_parse(database, from, UT_UTF8) : NULL;
  if (!to_unit)
    status = zp_fail(err, ZP_MACHINE, "the UDUNITS-2 database does not know %s", to);
  else if (!from_unit)
    status = zp_fail(err, ZP_BAD_INPUT, "unknown unit \"%s\"", from);
  else
    status = scale_between(from_unit, to_unit, to, scale, err);
  ut_free(from_unit);
  ut_free(to_unit);
  return status;
}

static ZpStatus scale_guarded(const char *from, const char *to, ZpUnitScale *scale, ZpError *err) {
  ZpGuard guard;
  ZpStatus status = zp_guard_enter(&guard, "UDUNITS-2", database ? ROOM : ROOM + DATABASE_ROOM, err);
  if (status != ZP_OK) return status;
  /* Its error messages would go to stderr; ours give the same reason with key and file. */
  ut_error_message_handler before = ut_set_error_message_handler(ut_ignore);
  status = scale_locked(from, to, scale, err);
  ut_set_error_message_handler(before);
  zp_guard_leave(&guard);
  return status;
}

ZpStatus zp_unit_scale(const char *from, const char *to, ZpUnitScale *scale, ZpError *err) {
  if (strcmp(from, to) == 0) {
    *scale = (ZpUnitScale){.decimal = true, .factor = 1};
    return ZP_OK;
  }
  if (!is_plain_unit(from)) return zp_fail(err, ZP_BAD_INPUT, "unknown unit \"%s\"", from);
  if (pthread_mutex_lock(&lock)) return zp_fail(err, ZP_MACHINE, "cannot lock the UDUNITS-2 database");
  ZpStatus status = scale_guarded(from, to, scale, err);
  pthread_mutex_unlock(&lock);
  return status;
}
