#include "electro/surplus.h"

#include <math.h>
#include <string.h>

static size_t carve(ZpSurplus *s, void *block) {
  ZpCarver carver = {block, 0};
  zp_plates_carve(&s->plates, &s->eval, &carver);
  zp_plates_step_carve(&s->plates, &s->attraction, &carver);
  s->q = zp_carve(&carver, 2 * s->plates.stride);
  s->floored = zp_carve(&carver, 2 * s->plates.stride);
  s->F = zp_carve(&carver, 2 * s->plates.stride);
  return carver.used;
}

bool zp_surplus_create(const ZpFieldParams *field, const ZpPlatesParams *plates, double scale, ZpSurplus *s) {
  memset(s, 0, sizeof *s);
  s->plates = *plates;
  s->plates.h_per_volt = 0;
  s->h_per_volt = plates->h_per_volt;
  s->plates.level.count =
      0;                  /* the field's faces go straight between all stations, and so do those of what it replaces */
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

/* Pairs closer than that, m, are taken to be so far apart: the forces of a field in a narrower gap drown in rounding.
 */
static const double narrowest = 1e-7;

/* The gap below which the cap holds the force, m; negative where closed faces are not capped. */
static double capped_gap(const ZpSurplus *s) {
  return s->U * s->h_per_volt - s->plates.d;
}

/* Capped pairs, and those that are closed, are parted about their middle, so that both laws are taken at the same gap.
 * The clip is none: it stays closed. */
static void part_capped(ZpSurplus *s) {
  size_t stride = s->plates.stride;
  double *y = s->floored + stride, least = fmax(capped_gap(s), narrowest);
  memcpy(s->floored, s->q, 2 * stride * sizeof *s->q);
  for (size_t i = 1; i < s->plates.nodes; i++) {
    double apart = 0.5 * fmax(least - (y[2 * i] - y[2 * i + 1]), 0);
    y[2 * i] += apart;
    y[2 * i + 1] -= apart;
  }
}

/* ... so what would part capped pairs further does no work at them, but changes the charge with the voltage's cap.
 * Those that are only closed keep the force that they have there: contact has no jump. */
static void hold_capped(ZpSurplus *s) {
  double *Fy = s->F + s->plates.stride, *y = s->q + s->plates.stride, least = capped_gap(s), opening = 0;
  for (size_t i = 1; i < s->plates.nodes; i++) {
    if (y[2 * i] - y[2 * i + 1] >= least) continue;
    double mean = 0.5 * (Fy[2 * i] + Fy[2 * i + 1]);
    opening += Fy[2 * i] - mean;
    Fy[2 * i] = Fy[2 * i + 1] = mean;
  }
  s->charge = 2 * s->energy + s->U * s->h_per_volt * opening;
}

static void subtract_plates(ZpSurplus *s) {
  size_t stride = s->plates.stride;
  zp_plates_rest(&s->plates, s->floored, s->floored + stride, 1, &s->eval, &s->attraction);
  for (size_t k = 0; k < 2 * s->plates.nodes; k++) {
    s->F[k] = s->scale * s->field.Fx[k] - s->attraction.Fx[k];
    s->F[stride + k] = s->scale * s->field.Fy[k] - s->attraction.Fy[k];
  }
  ZpPlatesTotals plates = zp_plates_totals(&s->plates, &s->eval, 1);
  s->energy = s->scale * s->field.energy + plates.potential;
  s->capacitance = 2 * s->field.energy - ZP_EPS0 * s->field.params.eps_m * s->field.params.w * plates.inverse_gap;
}

ZpFieldEnd zp_surplus_solve(ZpSurplus *s, const double *q, double voltage) {
  size_t stride = s->plates.stride, bytes = 2 * stride * sizeof *q;
  double U = voltage != 0 ? fabs(voltage) : 1;
  bool same_cap = U == s->U || s->h_per_volt == 0;
  if (same_cap && memcmp(s->q, q, bytes) == 0) return ZP_FIELD_SOLVED;
  memcpy(s->q, q, bytes);
  s->U = U;
  part_capped(s);
  const double *x = s->floored, *y = x + stride;
  ZpFieldEnd end = s->end = zp_field_solve(&s->field, &(ZpFaces){x, y, x + 1, y + 1, 2});
  s->solutions++;
  if (end == ZP_FIELD_SOLVED) {
    subtract_plates(s);
    hold_capped(s);
  } else {
    s->q[0] = NAN;
  }
  return end;
}
