/* How far an opening has moved lately, while the actuator is closed: over a window of time that slides with it. So the
 * instant at which a run ends is a continuous function of keys. */
#ifndef ZP_SIM_STILL_H
#define ZP_SIM_STILL_H

#include "actuator/model.h"

/* Length of the window, s. */
#define ZP_STILL_TIME 0.1

typedef struct ZpOpeningAt {
  double t, opening; /* s, m */
} ZpOpeningAt;

/* Begin with this instant, at which the actuator closes. */
void zp_still_begin(ZpStill *still, double opening);

/* Go on along a straight line from one instant to a later one. */
void zp_still_follow(ZpStill *still, double closed_from, ZpOpeningAt start, ZpOpeningAt end);

/* => by how much the opening has changed within the window before t, m. The extremes of the cell that the window is
 * leaving fade in proportion to the part of it that has left. */
double zp_still_range(const ZpStill *still, double closed_from, double t);

#endif
