/* The fields that the materials between two electrodes see: a plane capacitor of two insulators and a gap of liquid in
 * series, whatever the law of attraction makes of them. Theory, eq. (4.10). */
#ifndef ZP_ELECTRO_SERIES_H
#define ZP_ELECTRO_SERIES_H

#include <zipact/def.h>

typedef struct ZpSeries {
  double insulator, liquid; /* V/m; NAN: there is none between the metals */
} ZpSeries;

/* At `voltage` (V, any sign) with this distance of the faces (m; below 0: none). */
ZpSeries zp_series_at(const ZpActuatorDef *def, double voltage, double gap);

#endif
