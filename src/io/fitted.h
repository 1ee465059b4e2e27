/* fitted.yaml: what study calibrate has fitted, for other scenarios (base.file). */
#ifndef ZP_IO_FITTED_H
#define ZP_IO_FITTED_H

#include <zipact/io.h>

#include "io/yaml.h"

enum { ZP_FITTED_MOST = 16 }; /* keys of a file */

/* A fitted key, SI. NAN where the fit does not tell a number. */
typedef struct ZpFittedKey {
  int key, line;                      /* line of its value; 0: it has none yet */
  double value;                       /* in the range of the key */
  double error;                       /* standard error */
  double low, high;                   /* interval that covers the true value in 95 of 100 fits; NAN: unbounded */
  double correlation[ZP_FITTED_MOST]; /* with keys 0, 1, ... before it, -1 to 1; NAN: not known */
} ZpFittedKey;

typedef struct ZpFitted {
  size_t count;
  ZpFittedKey key[ZP_FITTED_MOST];
  ZpOutcome outcome; /* of the fit */
} ZpFitted;

/* Place of a key; `count`: it is not there. */
size_t zp_fitted_place(const ZpFitted *fitted, int key);

/* The correlation of the errors of two keys, by their places; NAN: not known. */
double zp_fitted_correlation(const ZpFitted *fitted, size_t one, size_t two);

/* Read such a file. ZP_BAD_INPUT gives file, line and reason: there is no such file, calibrate did not write it. */
ZpStatus zp_fitted_read(const char *path, ZpFitted *fitted, ZpError *err);

/* Write the values as a scenario, and the section `fitted` with all else: it reads back to the same bits. `result`: of
 * the fit, whose message and notes are written, too. */
ZpStatus zp_fitted_write(const ZpFitted *fitted, const ZpResult *result, FILE *file, ZpError *err);

/* Does an item of a scenario belong to the section `fitted`? */
bool zp_fitted_is_section(const ZpYamlItem *item);

/* Note in a result what is doubtful about the fit in `path` whose values it has. `drawn`: it draws from their
 * distribution. */
void zp_fitted_note(const ZpFitted *fitted, const char *path, bool drawn, ZpResult *result);

#endif
