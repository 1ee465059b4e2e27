#include "electro/surplus.h"

#include <math.h>
#include <string.h>

static size_t carve(ZpSurplus *s, void *block) {
  ZpCarver carver = {block, 0};
  zp_plates_carve(&s->plates, &s->eval, &carver);
  s->q = zp_carve(&carver, 2 * s->plates.stride);
  s->F = zp_carve(&carver, 2 * s->plates.stride);
  return carver.used;
}

bool zp_surplus_create(const ZpFieldParams *field, const ZpPlatesParams *plates, double scale, ZpSurplus *s) {
  memset(s, 0, sizeof *s);
  s->plates = *plates;
  s->plates.edges = NULL; /* the field solved is that of the strips' middle: edges stay in the plates law beside it */
  s->scale = scale;
  s->memory = zp_calloc(1, carve(s, NULL));
  if (!s->memory || !zp_field_create(field, &s->field)) {
    zp_surplus_destroy(s);
    return false;
  }
  carve(s, s->memory);
  s->q[0] = NAN;
  return true;
}

void zp_surplus_destroy(ZpSurplus *s) {
  zp_field_destroy(&s->field);
  zp_free(s->memory);
  s->memory = NULL;
}

static void subtract_plates(ZpSurplus *s) {
  size_t stride = s->plates.stride;
  double per_U2 = 1 / (s->U * s->U);
  zp_plates_polyline(&s->plates, s->q, s->q + stride, s->U, &s->eval);
  for (size_t k = 0; k < 2 * s->plates.nodes; k++) {
    s->F[k] = s->scale * s->field.Fx[k] - per_U2 * s->eval.Fx[k];
    s->F[stride + k] = s->scale * s->field.Fy[k] - per_U2 * s->eval.Fy[k];
  }
  s->energy = s->scale * s->field.energy + per_U2 * zp_plates_totals(&s->plates, &s->eval, s->U).potential;
}

ZpFieldEnd zp_surplus_solve(ZpSurplus *s, const double *q, double voltage) {
  size_t stride = s->plates.stride, bytes = 2 * stride * sizeof *q;
  double U = voltage != 0 ? fabs(voltage) : 1;
  bool same_cap = U == s->U || s->plates.h_per_volt == 0;
  if (same_cap && memcmp(s->q, q, bytes) == 0) return ZP_FIELD_SOLVED;
  const double *y = q + stride;
  ZpFaces faces = {q, y, q + 1, y + 1, 2};
  ZpFieldEnd end = zp_field_solve(&s->field, &faces, U * s->plates.h_per_volt - s->plates.d);
  s->solutions++;
  s->U = U;
  s->q[0] = NAN;
  if (end != ZP_FIELD_SOLVED) return end;
  memcpy(s->q, q, bytes);
  subtract_plates(s);
  return end;
}
