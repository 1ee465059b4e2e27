#include "contact/stop.h"

void zp_stop_push(const ZpStopParams *p, const double *gap, double *push, double *stiffness) {
  for (size_t i = 0; i < p->nodes; i++) {
    double length = i + 1 == p->nodes ? 0.5 * p->l + p->flat_length : p->l;
    stiffness[i] = i > 0 && gap[i] < 0 ? p->stiffness * length : 0;
    push[i] = -stiffness[i] * gap[i];
  }
}
