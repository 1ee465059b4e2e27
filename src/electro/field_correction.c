#include "electro/field_correction.h"

#include <math.h>
#include <string.h>

static size_t reserve(ZpFieldCorrection *s, void *block) {
  ZpArena arena = {block, 0};
  zp_plates_reserve(&s->plates, &s->eval, &arena);
  zp_plates_step_reserve(&s->plates, &s->attraction, &arena);
  s->q = zp_arena_take(&arena, 2 * s->plates.lanes);
  s->floored = zp_arena_take(&arena, 2 * s->plates.lanes);
  s->F = zp_arena_take(&arena, 2 * s->plates.lanes);
  s->cover.part = zp_arena_take(&arena, s->plates.nodes);
  return arena.used;
}

bool zp_field_correction_create(const ZpFieldParams *field, const ZpPlatesParams *plates, double scale,
                                ZpFieldCorrection *s) {
  memset(s, 0, sizeof *s);
  s->plates = *plates;
  s->plates.h_per_volt = 0;
  s->h_per_volt = plates->h_per_volt;
  s->plates.level.count =
      0; /* the field's faces go straight between all stations, and so do those of what it replaces */
  if (plates->air) {
    s->air = *plates->air;
    s->air.h_per_volt = 0;
    s->air_h_per_volt = plates->air->h_per_volt;
    s->plates.air = &s->air;
    s->eval.cover = &s->cover;
  }
  s->plates.edges = NULL; /* the field solved is that of the strips' middle: edges stay in the plates law beside it */
  s->scale = scale;
  s->memory = zp_calloc(1, reserve(s, NULL));
  if (!s->memory || !zp_field_create(field, &s->field)) {
    zp_field_correction_destroy(s);
    return false;
  }
  reserve(s, s->memory);
  s->q[0] = NAN;
  return true;
}

void zp_field_correction_destroy(ZpFieldCorrection *s) {
  zp_field_destroy(&s->field);
  zp_free(s->memory);
  s->memory = NULL;
}

/* Pairs closer than this, m, count as this far apart: in a narrower gap rounding exceeds the forces of the field. */
static double narrowest_of(const ZpFieldCorrection *s) {
  return 1e-7 * s->field.params.mesh.size;
}

/* A bead's end within an element: the element counts as wet if liquid covers more than half of it. => whether this
 * changed. */
static bool round_cover(ZpFieldCorrection *s, const ZpCover *cover) {
  bool moved = false;
  for (size_t i = 0; i + 1 < s->plates.nodes; i++) {
    double part = zp_cover_part(cover, i) > 0.5;
    moved |= part != s->cover.part[i];
    s->cover.part[i] = part;
  }
  for (size_t k = 0; k < 2; k++) {
    double part = !cover || cover->flat[k] > 0.5;
    moved |= part != s->cover.flat[k];
    s->cover.flat[k] = part;
  }
  return moved;
}

/* Is there liquid before pair i? Only halves have a computed field, and liquid lies from their clip on: if the element
 * before a pair is dry, all beyond it is. */
static bool is_wet(const ZpFieldCorrection *s, size_t i) {
  return s->cover.part[i - 1] > 0;
}

/* The gap below which the cap holds the force in the liquid, m; negative where closed faces are not capped. */
static double capped_gap(const ZpFieldCorrection *s) {
  return s->U * s->h_per_volt - s->plates.d;
}

/* Capped and closed pairs are moved apart about their middle, so that both laws apply at the same gap. The clip stays
 * closed. Air breaks down in gaps of millimetres, next to wet ones that are closed. Moving such pairs apart would
 * distort the ribbons, so all stay where they are. */
static void part_capped(ZpFieldCorrection *s) {
  double *y = s->floored + s->plates.lanes, narrowest = narrowest_of(s), capped = fmax(capped_gap(s), narrowest);
  memcpy(s->floored, s->q, 2 * s->plates.lanes * sizeof *s->q);
  for (size_t i = 1; i < s->plates.nodes; i++) {
    double least = is_wet(s, i) ? capped : narrowest;
    zp_part_pair(y, i, 0.5 * fmax(least - zp_apart(y, i), 0));
  }
}

/* Remove the part of the forces on a pair that would move it apart, beyond their mean => that part, N/V^2. */
static double hold_apart(double *Fy, size_t i) {
  double mean = 0.5 * (Fy[zp_up(i)] + Fy[zp_down(i)]), opening = Fy[zp_up(i)] - mean;
  zp_set_pair(Fy, i, mean, mean);
  return opening;
}

/* Forces that would move capped pairs further apart do no work on them, but change the charge with the voltage's cap.
 * Pairs that are only closed keep their forces, so that contact causes no jump. */
static void hold_capped(ZpFieldCorrection *s) {
  double *Fy = s->F + s->plates.lanes, *y = s->q + s->plates.lanes, opening = 0;
  double capped = capped_gap(s), capped_in_air = s->U * s->air_h_per_volt - s->air.d;
  for (size_t i = 1; i < s->plates.nodes; i++) {
    double gap = zp_apart(y, i);
    if (is_wet(s, i) && gap < capped) opening += hold_apart(Fy, i);
    if (!is_wet(s, i) && gap < capped_in_air) hold_apart(Fy, i);
  }
  s->charge = 2 * s->energy + s->U * s->h_per_volt * opening;
}

static void subtract_plates(ZpFieldCorrection *s) {
  size_t lanes = s->plates.lanes;
  zp_plates_rest(&s->plates, s->floored, s->floored + lanes, 1, &s->eval, &s->attraction);
  for (size_t k = 0; k < 2 * s->plates.nodes; k++) {
    s->F[k] = s->scale * s->field.Fx[k] - s->attraction.Fx[k];
    s->F[lanes + k] = s->scale * s->field.Fy[k] - s->attraction.Fy[k];
  }
  ZpPlatesTotals plates = zp_plates_totals(&s->plates, &s->eval, 1);
  s->energy = s->scale * s->field.energy + plates.potential;
  s->capacitance = 2 * s->field.energy - ZP_EPS0 * s->field.params.eps_m * s->field.params.w * plates.inverse_gap;
}

ZpFieldEnd zp_field_correction_solve(ZpFieldCorrection *s, const double *q, double voltage, const ZpCover *cover) {
  size_t lanes = s->plates.lanes, bytes = 2 * lanes * sizeof *q;
  double U = voltage != 0 ? fabs(voltage) : 1;
  bool same_cap = U == s->U || (s->h_per_volt == 0 && s->air_h_per_volt == 0), same_cover = !round_cover(s, cover);
  if (same_cap && same_cover && memcmp(s->q, q, bytes) == 0) return ZP_FIELD_SOLVED;
  memcpy(s->q, q, bytes);
  s->U = U;
  if (s->plates.air) zp_field_cover(&s->field, &s->cover);
  part_capped(s);
  const double *x = s->floored, *y = x + lanes;
  ZpFieldEnd end = s->end = zp_field_solve(&s->field, &(ZpContact){x, y, x + 1, y + 1, 2});
  s->solutions++;
  if (end == ZP_FIELD_SOLVED) {
    subtract_plates(s);
    hold_capped(s);
  } else {
    s->q[0] = NAN;
  }
  return end;
}
