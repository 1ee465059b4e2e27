#include "contact/faces.h"

void zp_faces_push(const ZpFacesParams *p, const double *gap, double *push, double *stiffness) {
  for (size_t i = 0; i < p->nodes; i++) {
    double length = i + 1 == p->nodes ? 0.5 * p->l + p->flat_length : p->l;
    stiffness[i] = i > 0 && gap[i] < 0 ? p->stiffness * length : 0;
    push[i] = -stiffness[i] * gap[i];
  }
}

size_t zp_faces_front(const ZpFacesParams *p, const double *gap) {
  size_t front = 0;
  while (front + 1 < p->nodes && gap[front + 1] < ZP_CLOSED_GAP)
    front++;
  return front;
}
