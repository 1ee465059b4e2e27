/* A source between a commanded voltage and the electrodes. The voltage of the electrodes is then an unknown of each
 * implicit step, in the border of its matrix: the charge that flows equals the charge that the electrodes take,
 * eq. (18.10). */
#ifndef ZP_TERM_SOURCE_H
#define ZP_TERM_SOURCE_H

#include <stdbool.h>

typedef struct ZpSource {
  void *self;
  /* Charge that flows to the whole actuator over a step from t to t + h while its voltage changes from U0 to U1, C; and
   * the derivative of this charge by U1, F, 0 or less. */
  double (*flow)(const void *self, double t, double h, double U0, double U1);
  double (*slope)(const void *self, double t, double h, double U0, double U1);
  /* True if the source sets the voltage at the end to *U1, V, whatever charge flows; then flow and slope are not
   * called. NULL: never. */
  bool (*holds)(const void *self, double t, double h, double *U1);
  double scale; /* V: an error of this size counts as an error of the whole flexible length in position */
} ZpSource;

#endif
