#include "electro/series.h"

#include <math.h>

ZpSeries zp_series_at(const ZpSeriesParams *p, double voltage, double gap) {
  double U = fabs(voltage), g = fmax(gap, 0);
  if (p->thickness == 0) return (ZpSeries){NAN, g > 0 ? U / g : NAN};
  double D = U / (p->thickness + g / p->eps_m); /* over eps_0 */
  return (ZpSeries){D / p->eps_i, D / p->eps_m};
}

double zp_series_allowed(const ZpSeriesParams *p) {
  return p->withstands * p->eps_i * p->thickness;
}
