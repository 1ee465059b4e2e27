/* A source between a commanded voltage and the electrodes. The voltage of the electrodes is then an unknown of each
 * implicit step, in the border of its matrix: the source's law holds for the charge that the electrodes take,
 * eq. (18.10). */
#ifndef ZP_TERM_SOURCE_H
#define ZP_TERM_SOURCE_H

#include <stdbool.h>

/* A step of the whole actuator from t to t + h: its voltage changes from U0 to U1, V, and its electrodes take a charge,
 * C; C is their capacitance between both voltages where the step ends, F. */
typedef struct ZpSourceStep {
  double t, h, U0, U1, taken, C;
  const void *electrodes;
  double (*taken_at)(const void *electrodes, double U); /* what they take if the voltage ends at U, C; grows with U */
} ZpSourceStep;

/* Residual of the source's law over a step, C: 0 where the law holds, and falling with U1. Its derivatives, F and 1. */
typedef struct ZpSourceLaw {
  double lacks, by_voltage, by_taken;
  double bound;    /* the voltage at the end is not beyond this one, V; NAN: none */
  double resolved; /* 0 to 1: the share of the voltage's change that goes as slowly as the step, and has its error */
} ZpSourceLaw;

typedef struct ZpSource {
  void *self;
  ZpSourceLaw (*law)(void *self, const ZpSourceStep *step);
  double scale; /* V: an error of this size counts as an error of the whole flexible length in position */
} ZpSource;

#endif
