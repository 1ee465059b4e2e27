/* What pictures of sweeps share: the number of the summary that a study draws, and the list keys that it is drawn
 * against. */
#ifndef ZP_IO_SWEEP_H
#define ZP_IO_SWEEP_H

#include "io/plot.h"

/* What is drawn against keys: one or two numbers of the summary. */
typedef struct ZpAnswer {
  ZpStudy study;
  const char *picture, *title, *axis, *unit; /* no unit: a pure number */
  const char *scalar[2], *legend[2];         /* the second may be NULL */
  const char *count;                         /* how many points there are, after "3 of 5 runs " */
} ZpAnswer;

/* The answer of the study of this sweep; NULL if it has none. */
const ZpAnswer *zp_sweep_answer(const ZpPlot *plot);

/* The list key that varies fastest (back = 0), next to fastest (1), ...; -1 if there is none. */
int zp_sweep_key(const ZpPlot *plot, size_t back);

/* Value of a key in a run, SI; NAN for auto. */
double zp_sweep_value(const ZpPlot *plot, size_t run, int key);

/* What a number of the key in SI is to be multiplied with for its usual unit, and "drive.voltage / kV". */
double zp_sweep_factor(int key);
void zp_sweep_label(int key, char *label, size_t size);

#endif
