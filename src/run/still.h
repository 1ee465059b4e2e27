/* How far an opening has moved lately, while the actuator is closed: over a window of time that slides with it. So the
 * instant at which a run ends is a continuous function of keys. */
#ifndef ZP_RUN_STILL_H
#define ZP_RUN_STILL_H

#include "actuator/model.h"

/* Length of the window, s. */
#define ZP_STILL_TIME 0.1

typedef struct ZpOpeningAt {
  double t, opening; /* s, m */
} ZpOpeningAt;

/* The actuator closes, with this opening. */
void zp_still_begin(ZpStill *still, double opening);

/* The opening has gone along a straight line from one instant to a later one. Of a line that begins before the closing,
 * that part counts as the instant of the closing. */
void zp_still_follow(ZpStill *still, double closed_from, ZpOpeningAt start, ZpOpeningAt end);

/* => by how much the opening has changed within the window before t, m. While the window leaves a cell, that cell's
 * extremes fade: they count by the part of it that is still in the window. */
double zp_still_range(const ZpStill *still, double closed_from, double t);

#endif
