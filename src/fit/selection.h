/* Which of several measurements limit keys most: their information, the criterion, the choice (docs/theory.md, (12.7)
 * to (12.10)). Parameters are first the keys, then shifts, which nobody wants to know. */
#ifndef ZP_FIT_SELECTION_H
#define ZP_FIT_SELECTION_H

#include "fit/fit.h"

/* Information about parameters, or their covariance. */
typedef struct ZpInformation {
  double of[ZP_FIT_MOST][ZP_FIT_MOST];
} ZpInformation;

/* Numbers that are read together: rows first, first + step, ... of J. */
typedef struct ZpMeasurement {
  size_t first, step;
  int count;
} ZpMeasurement;

typedef struct ZpSelection {
  int keys, n;                /* numbers of keys, and of all parameters */
  ZpPlanCriterion criterion;  /* of the keys alone */
  double size[ZP_FIT_KEYS];   /* of each key, to which its standard error is related; above 0 */
  ZpInformation start;        /* before the measurements; it determines all parameters, if only weakly */
  const double *J;            /* [.][n] derivatives of measured values, over their standard deviations */
  const ZpMeasurement *among; /* [count] each may be chosen once */
  size_t count;
} ZpSelection;

/* Add a number with these derivatives [n], over its standard deviation, `times` times (-1: take it away). */
void zp_information_add(int n, const double *row, double times, ZpInformation *information);

/* Add a measurement `times` times (-1: take it away), (12.7). */
void zp_selection_add(const ZpSelection *selection, size_t which, double times, ZpInformation *information);

/* Take the parameters from `keys` on out: the information about the keys where all others are unknown, (12.8). */
void zp_information_eliminate(int keys, int n, ZpInformation *information);

/* Covariance of the keys. False if they are not determined. */
bool zp_selection_covariance(const ZpSelection *selection, const ZpInformation *information, ZpInformation *covariance);

/* The criterion (12.9), which increases with what is known: minus ln of the determinant of the relative covariance of
 * the keys (D), minus its trace (A). */
double zp_selection_value(const ZpSelection *selection, const ZpInformation *information);

/* The relative standard error that all keys would have if theirs were equal and independent, for a value of the
 * criterion. */
double zp_selection_error(const ZpSelection *selection, double value);

/* The best `number` of the measurements => chosen [number], the one that tells most first, then the one that adds most
 * to it, ... False if there is no memory. */
bool zp_selection_best(const ZpSelection *selection, size_t number, size_t *chosen);

/* As many, evenly spaced in the list, its ends included => chosen [number]. */
void zp_selection_even(const ZpSelection *selection, size_t number, size_t *chosen);

/* Value of the criterion after these measurements. */
double zp_selection_value_of(const ZpSelection *selection, const size_t *chosen, size_t number);

#endif
