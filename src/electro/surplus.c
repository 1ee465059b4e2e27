#include "electro/surplus.h"

#include <math.h>
#include <string.h>

static size_t carve(ZpSurplus *s, void *block) {
  ZpCarver carver = {block, 0};
  zp_plates_carve(&s->plates, &s->eval, &carver);
  double **arrays[] = {&s->x, &s->y, &s->Fx, &s->Fy};
  for (size_t k = 0; k < sizeof arrays / sizeof arrays[0]; k++)
    *arrays[k] = zp_carve(&carver, s->plates.stride);
  return carver.used;
}

bool zp_surplus_create(const ZpFieldParams *field, const ZpPlatesParams *plates, double scale, ZpSurplus *s) {
  memset(s, 0, sizeof *s);
  s->plates = *plates;
  s->plates.h_per_volt = 0;
  s->scale = scale;
  s->memory = zp_calloc(1, carve(s, NULL));
  if (!s->memory || !zp_field_create(field, &s->field)) {
    zp_surplus_destroy(s);
    return false;
  }
  carve(s, s->memory);
  s->x[0] = NAN;
  return true;
}

void zp_surplus_destroy(ZpSurplus *s) {
  zp_field_destroy(&s->field);
  zp_free(s->memory);
  s->memory = NULL;
}

static void subtract_plates(ZpSurplus *s) {
  zp_plates_polyline(&s->plates, s->x, s->y, 1, &s->eval);
  for (size_t k = 0; k < 2 * s->plates.nodes; k++) {
    s->Fx[k] = s->scale * s->field.Fx[k] - s->eval.Fx[k];
    s->Fy[k] = s->scale * s->field.Fy[k] - s->eval.Fy[k];
  }
  s->energy = s->scale * s->field.energy + zp_plates_totals(&s->plates, &s->eval, 1).potential;
}

ZpFieldEnd zp_surplus_solve(ZpSurplus *s, const double *x, const double *y) {
  size_t count = 2 * s->plates.nodes, bytes = count * sizeof *x;
  if (memcmp(s->x, x, bytes) == 0 && memcmp(s->y, y, bytes) == 0) return ZP_FIELD_SOLVED;
  memcpy(s->x, x, bytes);
  memcpy(s->y, y, bytes);
  s->solutions++;
  ZpFieldEnd end = zp_field_solve(&s->field, &(ZpFaces){x, y, x + 1, y + 1, 2});
  if (end == ZP_FIELD_SOLVED) {
    subtract_plates(s);
    return end;
  }
  for (size_t k = 0; k < count; k++)
    s->Fx[k] = s->Fy[k] = NAN;
  s->energy = s->x[0] = NAN;
  return end;
}
