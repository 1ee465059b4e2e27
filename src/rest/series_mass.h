/* The mass matrix of members in series, each in the frame of the platform that it hangs on, eq. (29.3). */
#ifndef ZP_REST_SERIES_MASS_H
#define ZP_REST_SERIES_MASS_H

#include "def/check.h"
#include "rest/statics.h"
#include "rest/vibration.h"

typedef struct ZpSeriesMass {
  const ZpStatics *statics;
  double *mass;                  /* [n] by equations, kg */
  double *vertical;              /* [n] the same for equations that are heights; else 0 */
  double total[ZP_MOST_MEMBERS]; /* of each member with what hangs on its platform itself, kg */
  ZpInertia inertia;
} ZpSeriesMass;

/* Take the arrays from `carver`. */
void zp_series_mass_carve(ZpSeriesMass *series, const ZpStatics *statics, ZpCarver *carver);

void zp_series_mass_fill(ZpSeriesMass *series);

#endif
