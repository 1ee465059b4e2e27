/* What stands between a given voltage and the electrodes. Their voltage is then an unknown of each implicit step, in
 * the border of its matrix: the charge that flows is the one that the electrodes take, eq. (18.10). */
#ifndef ZP_TERM_SOURCE_H
#define ZP_TERM_SOURCE_H

#include <stdbool.h>

typedef struct ZpSource {
  void *self;
  /* Charge that flows to the whole actuator over a step from t to t + h while its voltage goes from U0 to U1, C; and
   * its derivative by U1, F, 0 or less. */
  double (*flow)(const void *self, double t, double h, double U0, double U1);
  double (*slope)(const void *self, double t, double h, double U0, double U1);
  /* True: the source holds the voltage at the end, whatever charge flows => U1, V; flow and slope are not asked. NULL:
   * never. */
  bool (*holds)(const void *self, double t, double h, double *U1);
  double scale; /* V: an error of so much counts as one of the whole flexible length */
} ZpSource;

#endif
