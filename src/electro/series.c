#include "electro/series.h"

#include <math.h>

ZpSeries zp_series_at(const ZpActuatorDef *def, double voltage, double gap) {
  double U = fabs(voltage), g = fmax(gap, 0), both = 2 * def->insulator.thickness;
  double ratio = def->insulator.permittivity / def->medium.permittivity;
  if (both == 0) return (ZpSeries){NAN, g > 0 ? U / g : NAN};
  double insulator = U / (both + g * ratio);
  return (ZpSeries){insulator, insulator * ratio};
}
