/* Letters of docs/theory.md, section 25:
 *   Z  interface voltage, V             Y  U + Z, V
 *   q  charge per length on the liquid's faces, that of the plates law at Y, C/m
 *   C  capacitance of both insulators per length, F/m        G  their conductance per length, S/m, of a patch
 *   s  conductivity over permittivity of the liquid, 1/s, of a patch; 0 of air
 * The insulators conduct G (q / C - Z), the liquid s q; what the one has more than the other gathers: C dZ/dt. */
#include "electro/leak.h"

#include <math.h>

#include "base/kernel.h"
#include "math/elementary.h"

static size_t places(const ZpPlatesParams *plates) {
  return ZP_PLATES_PLACES * plates->nodes;
}

size_t zp_leak_state(const ZpLeakParams *p, const ZpPlatesParams *plates) {
  return p->patches * places(plates);
}

void zp_leak_reserve(const ZpLeakParams *p, const ZpPlatesParams *plates, ZpLeakEval *e, ZpArena *arena) {
  e->face = zp_arena_take_of(arena, zp_leak_state(p, plates), sizeof *e->face);
  e->piece = zp_arena_take_of(arena, places(plates), sizeof *e->piece);
  zp_plates_step_reserve(plates, &e->work, arena);
}

/* -- faces ----------------------------------------------------------------------------------------- */

/* Of both ends of a step, with the liquid where it is at its end => whether there are faces with the Z at `at`. */
ZP_INLINE bool find_face(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpPlatesEval *start,
                         const ZpPlatesEval *end, size_t at, ZpLeakFace *face) {
  const size_t k = at % places(plates);
  if (!zp_plates_has_faces(plates, k)) return false;
  ZpPlatesPlace place = zp_plates_place(plates, end->cover, k);
  face->place = k;
  face->at = at;
  face->patch = &p->patch[at / places(plates)];
  face->wet = place.wet;
  face->g1 = zp_plates_place_gap(&place, end), face->length1 = zp_plates_place_length(&place, end);
  face->g0 = start == end ? face->g1 : zp_plates_place_gap(&place, start);
  face->length0 = start == end ? face->length1 : zp_plates_place_length(&place, start);
  face->part = face->patch->share;
  if (place.wet < 1 && plates->air->relative == 0) { /* no electrodes, so no charges, beyond their end */
    face->part *= place.wet;
    if (place.wet == 0) return false;
    place.wet = 1;
  }
  face->length0 *= face->part, face->length1 *= face->part;
  const ZpLeakSide liquid = {plates, place.wet, face->patch->discharge}, air = {plates->air, 1 - place.wet, 0};
  face->sides = place.wet > 0 && place.wet < 1 ? 2 : 1;
  face->side[0] = place.wet > 0 ? liquid : air;
  face->side[1] = air;
  return true;
}

static ZpPlatesMean sum_of(double a, ZpPlatesMean A, double b, ZpPlatesMean B) {
  return (ZpPlatesMean){a * A.W + b * B.W, a * A.slope + b * B.slope, a * A.P + b * B.P, a * A.W1 + b * B.W1};
}

/* As zp_plates_between, of all sides. */
static ZpPlatesMean between(const ZpLeakFace *face, double Y0, double Y1, double g0, double g1) {
  const ZpLeakSide *side = face->side;
  ZpPlatesMean first = zp_plates_between(side->law, Y0, Y1, g0, g1);
  if (face->sides == 1) return first;
  return sum_of(side[0].share, first, side[1].share, zp_plates_between(side[1].law, Y0, Y1, g0, g1));
}

static ZpPlatesMean between_by_voltage(const ZpLeakFace *face, double Y1, double g0, double g1) {
  const ZpLeakSide *side = face->side;
  ZpPlatesMean first = zp_plates_between_by_voltage(side->law, Y1, g0, g1);
  if (face->sides == 1) return first;
  return sum_of(side[0].share, first, side[1].share, zp_plates_between_by_voltage(side[1].law, Y1, g0, g1));
}

static double capacitance_of(const ZpLeakFace *face, double Y, double g) {
  double sum = 0;
  for (const ZpLeakSide *side = face->side; side < face->side + face->sides; side++)
    sum += side->share * zp_plates_capacitance(side->law, Y, g);
  return sum;
}

/* -- a place over a step --------------------------------------------------------------------------- */

/* q of one side: straight in Y until the cap holds it. */
typedef struct Charge {
  double slope;     /* dq/dY, F/m */
  double bend;      /* of that by g, F/m^2 */
  double most;      /* C/m */
  double discharge; /* s there */
} Charge;

/* Of the plates law, whose gap may be negative where faces overlap. */
ZP_INLINE Charge charge_in_field(const ZpPlatesParams *p, double g) {
  double h = g + p->d;
  return (Charge){2 * p->k / h, -2 * p->k / (h * h), p->h_per_volt > 0 ? 2 * p->k / p->h_per_volt : INFINITY, 0};
}

typedef struct Charges {
  int count;
  Charge of[2];
} Charges;

/* Of conduction: faces that overlap touch. */
ZP_INLINE Charges charges_of(const ZpLeakFace *face, int sides, double g) {
  Charges charges;
  charges.count = sides;
  for (int k = 0; k < sides; k++) {
    Charge *charge = &charges.of[k];
    double share = face->side[k].share;
    *charge = charge_in_field(face->side[k].law, g > 0 ? g : 0);
    charge->slope *= share;
    charge->bend *= g > 0 ? share : 0;
    charge->most *= share;
    charge->discharge = face->side[k].discharge;
  }
  return charges;
}

ZP_INLINE double at(const Charge *charge, double Y) {
  return copysign(fmin(charge->slope * fabs(Y), charge->most), Y);
}

ZP_INLINE bool is_held(const Charge *charge, double Y) {
  return charge->slope * fabs(Y) > charge->most;
}

/* Conduction there, C/(m s): through the insulators, and the excess over that through the liquid. */
typedef struct Conduction {
  double insulators, gathers;
} Conduction;

ZP_INLINE Conduction conduction(const ZpLeakParams *p, const ZpLeakPatch *patch, const Charges *charges, double Y,
                                double Z) {
  double q = 0, liquid = 0;
  for (int k = 0; k < charges->count; k++) {
    q += at(&charges->of[k], Y);
    liquid += charges->of[k].discharge * at(&charges->of[k], Y);
  }
  double through = patch->conductance * (q / p->insulators - Z);
  return (Conduction){through, through - liquid};
}

/* At an instant; `sides` is a constant where this is inlined. */
ZP_INLINE Conduction conduction_at(const ZpLeakParams *p, const ZpLeakFace *face, int sides, double Y, double Z) {
  Charges charges = charges_of(face, sides, face->g1);
  return conduction(p, face->patch, &charges, Y, Z);
}

/* Weight of a step's end with which a place of constant gap and voltage relaxes exactly. */
ZP_INLINE double weight_of_end(const ZpLeakParams *p, const ZpLeakPatch *patch, const Charges *charges, double Y,
                               double h) {
  double slope = 0, liquid = 0;
  for (int k = 0; k < charges->count; k++) {
    if (is_held(&charges->of[k], Y)) continue;
    slope += charges->of[k].slope;
    liquid += charges->of[k].discharge * charges->of[k].slope;
  }
  return zp_decay_weight(h * (patch->conductance * (1 - slope / p->insulators) + liquid) / p->insulators);
}

/* own Y = known + the sum of `passes` times the charge of each side. The difference of both sides rises with Y, so the
 * charges that the cap holds at the solution are found in the order in which it begins to hold them. */
typedef struct Balance {
  double own, known, passes[2];
  bool held[2];
} Balance;

/* Of those that the cap would hold at Y and that still count as free, the one that it holds first; -1: none. */
ZP_INLINE int next_held(const Balance *b, const Charges *charges, double Y) {
  int first = -1;
  double least = INFINITY;
  for (int k = 0; k < charges->count; k++) {
    if (b->held[k] || !is_held(&charges->of[k], Y)) continue;
    double from = charges->of[k].most / charges->of[k].slope;
    if (!(from < least)) continue;
    first = k;
    least = from;
  }
  return first;
}

ZP_INLINE double slope_of(const Balance *b, const Charges *charges) {
  double slope = b->own;
  for (int k = 0; k < charges->count; k++)
    if (!b->held[k]) slope -= b->passes[k] * charges->of[k].slope;
  return slope;
}

/* => Y, with `held`. */
ZP_INLINE double solve(Balance *b, const Charges *charges) {
  double Y = b->known / slope_of(b, charges);
  for (int k = next_held(b, charges, Y); k >= 0; k = next_held(b, charges, Y)) {
    double known = b->known;
    b->held[k] = true;
    for (int m = 0; m < charges->count; m++)
      if (b->held[m]) known += b->passes[m] * copysign(charges->of[m].most, Y);
    Y = known / slope_of(b, charges);
  }
  return Y;
}

/* C (Z1 - Z0) = h times the weighted mean of the excess: linear in Y1, or with charges fixed by the cap => Y1, and what
 * goes with it. `sides` is a constant where this is inlined. */
ZP_INLINE double end_of(const ZpLeakParams *p, const ZpLeakStep *step, double Z0, int sides, ZpLeakFace *face) {
  double C = p->insulators, G = face->patch->conductance, Y0 = step->U0 + Z0, U1 = step->U1;
  Charges charges0 = charges_of(face, sides, face->g0), charges = charges_of(face, sides, face->g1);
  double weight = weight_of_end(p, face->patch, &charges0, Y0, step->h), h = step->h * weight;
  Conduction before = conduction(p, face->patch, &charges0, Y0, Z0);
  Balance b = {.own = C + h * G, .known = C * (U1 + Z0) + (step->h - h) * before.gathers + h * G * U1};
  for (int k = 0; k < charges.count; k++)
    b.passes[k] = h * (G / C - charges.of[k].discharge);
  double Y = solve(&b, &charges), slope = 0, bend = 0, passes = 0, over = 1 / slope_of(&b, &charges);
  for (int k = 0; k < charges.count; k++) {
    if (b.held[k]) continue;
    slope += charges.of[k].slope;
    bend += charges.of[k].bend * Y;
    passes += b.passes[k] * (charges.of[k].bend * Y);
  }
  double through = conduction(p, face->patch, &charges, Y, Y - U1).insulators, of_end = h * G;
  face->by_gap = passes * over;
  face->by_voltage = b.own * over;
  face->passed.charge = (step->h - h) * before.insulators + h * through;
  face->passed.by_gap = of_end * ((bend + slope * face->by_gap) / C - face->by_gap);
  face->passed.by_voltage = of_end * (slope * face->by_voltage / C - (face->by_voltage - 1));
  return Y;
}

void zp_leak_step(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpLeakStep *step, ZpLeakEval *e) {
  e->faces = 0;
  for (size_t at = 0; at < zp_leak_state(p, plates); at++) {
    ZpLeakFace *face = &e->face[e->faces];
    double Z0 = e->Z[at] = step->Z[at];
    if (!find_face(p, plates, step->start, step->end, at, face)) continue;
    double Y = face->sides == 1 ? end_of(p, step, Z0, 1, face) : end_of(p, step, Z0, 2, face);
    if (step->h > 0) e->Z[at] = Y - step->U1;
    e->faces++;
  }
}

/* -- forces ---------------------------------------------------------------------------------------- */

static void clear_pieces(const ZpPlatesParams *plates, ZpLeakEval *e) {
  for (size_t k = 0; k < places(plates); k++)
    e->piece[k] = (ZpPlatesMean){0};
}

/* To its place, what these faces are of it. */
ZP_INLINE void add_part(const ZpLeakFace *face, ZpPlatesMean of, ZpLeakEval *e) {
  e->piece[face->place] = sum_of(1, e->piece[face->place], face->part, of);
}

/* Contribution of the interface charge to the potential, J/m: eq. (25.4). */
ZP_INLINE double of_interface(const ZpLeakParams *p, double U, double Z) {
  return p->insulators * Z * (U + 0.5 * Z);
}

void zp_leak_forces(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpLeakStep *step, ZpLeakEval *e,
                    ZpPlatesStep *forces) {
  clear_pieces(plates, e);
  for (const ZpLeakFace *face = e->face; face < e->face + e->faces; face++) {
    double Z0 = step->Z[face->at], Z1 = e->Z[face->at], Y1 = step->U1 + Z1;
    ZpPlatesMean piece = between(face, step->U0 + Z0, Y1, face->g0, face->g1);
    piece.slope += between_by_voltage(face, Y1, face->g0, face->g1).W * face->by_gap;
    piece.P += 0.5 * (of_interface(p, step->U0, Z0) + of_interface(p, step->U1, Z1));
    add_part(face, piece, e);
  }
  zp_plates_step_of(plates, e->piece, step->start, step->end, forces);
}

/* -- by the voltage -------------------------------------------------------------------------------- */

/* Derivative of the mean force: half of the law at the end. */
static ZpPlatesMean force_by_voltage(const ZpLeakParams *p, const ZpLeakFace *face, double U, double Z) {
  double by_U = face->by_voltage;
  ZpPlatesMean piece = between_by_voltage(face, U + Z, face->g0, face->g1);
  piece.W *= by_U;
  piece.P = piece.P * by_U + 0.5 * p->insulators * ((U + Z) * by_U - U);
  return piece;
}

/* Derivative of the charge q - C Z at the end and of the conducted charge, half of which depends on the x-length
 * there. */
static ZpPlatesMean charge_piece(const ZpLeakParams *p, const ZpLeakFace *face, double U, double Z) {
  double C = p->insulators, Y = U + Z;
  ZpPlatesMean at_rest = between_by_voltage(face, Y, face->g1, face->g1); /* half of it */
  double by_gap = (capacitance_of(face, Y, face->g1) - C) * face->by_gap - 2 * at_rest.W + face->passed.by_gap;
  return (ZpPlatesMean){-by_gap, 0, 2 * at_rest.P + C * Z - 0.5 * face->passed.charge, 0};
}

void zp_leak_by_voltage(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpLeakStep *step, ZpLeakEval *e,
                        ZpPlatesByVoltage *by) {
  ZpPlatesStep forces = e->work, charges = e->work;
  const ZpLeakFace *end = e->face + e->faces;
  double C = p->insulators, U = step->U1;
  forces.Fx = by->Fx, forces.Fy = by->Fy, charges.Fx = by->Qx, charges.Fy = by->Qy;
  by->capacitance = 0;
  clear_pieces(plates, e);
  for (const ZpLeakFace *face = e->face; face < end; face++) {
    double Z = e->Z[face->at], by_U = face->by_voltage;
    add_part(face, force_by_voltage(p, face, U, Z), e);
    by->capacitance +=
        face->length1 * (capacitance_of(face, U + Z, face->g1) * by_U - C * (by_U - 1) + face->passed.by_voltage);
  }
  zp_plates_step_of(plates, e->piece, step->start, step->end, &forces);
  clear_pieces(plates, e);
  for (const ZpLeakFace *face = e->face; face < end; face++)
    add_part(face, charge_piece(p, face, U, e->Z[face->at]), e);
  zp_plates_step_of(plates, e->piece, step->end, step->end, &charges);
}

/* -- totals ---------------------------------------------------------------------------------------- */

double zp_leak_passed(const ZpLeakEval *e) {
  double sum = 0;
  for (const ZpLeakFace *face = e->face; face < e->face + e->faces; face++)
    sum += 0.5 * (face->length0 + face->length1) * face->passed.charge;
  return sum;
}

/* Integral of C Y - q, which is C times the voltage across the liquid, over Y from 0, at a gap g: eq. (25.4), J/m. */
ZP_INLINE double across_side(const ZpLeakParams *p, const ZpPlatesParams *law, double g, double Y) {
  Charge charge = charge_in_field(law, g);
  double free = fmin(fabs(Y), charge.most / charge.slope), held = fabs(Y) - free;
  double sum = 0.5 * p->insulators * g / (g + law->d) * free * free;
  return held > 0 ? sum + held * (p->insulators * (free + 0.5 * held) - charge.most) : sum;
}

/* By how much the potential of a place rises as Z goes from Z0 to Z1 at constant gap and voltage, J/m. */
ZP_INLINE double rise(const ZpLeakParams *p, const ZpLeakFace *face, double U, double g, double Z0, double Z1) {
  double sum = 0;
  for (int k = 0; k < face->sides; k++) {
    const ZpLeakSide *side = &face->side[k];
    sum += side->share * (across_side(p, side->law, g, U + Z1) - across_side(p, side->law, g, U + Z0));
  }
  return sum;
}

ZpLeakHeat zp_leak_heat(const ZpLeakParams *p, const ZpLeakStep *step, const ZpLeakEval *e) {
  double touching = 0, stored = 0;
  for (const ZpLeakFace *face = e->face; face < e->face + e->faces; face++) {
    double g0 = face->g0, g1 = face->g1, dx0 = 0.5 * face->length0, dx1 = 0.5 * face->length1;
    double Z0 = step->Z[face->at], Z1 = e->Z[face->at];
    double late = dx0 * rise(p, face, step->U1, g0, Z0, Z1), early = dx1 * rise(p, face, step->U0, g1, Z0, Z1);
    stored += late + early;
    if (g0 < 0) late = dx0 * rise(p, face, step->U1, 0, Z0, Z1);
    if (g1 < 0) early = dx1 * rise(p, face, step->U0, 0, Z0, Z1);
    touching += late + early;
  }
  double given = 0.5 * (step->U0 + step->U1) * zp_leak_passed(e);
  return (ZpLeakHeat){given - touching, touching - stored};
}

ZpPlatesTotals zp_leak_totals(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpPlatesEval *gaps, double U,
                              const double *Z) {
  ZpPlatesTotals totals = {0, 0, 0, 0};
  for (size_t at = 0; at < zp_leak_state(p, plates); at++) {
    ZpLeakFace face;
    if (!find_face(p, plates, gaps, gaps, at, &face)) continue;
    double gap = face.g1, length = face.length1;
    ZpPlatesTotals here = {0, 0, 0, 0};
    for (const ZpLeakSide *side = face.side; side < face.side + face.sides; side++) {
      ZpPlatesLaw law = zp_plates_law(side->law, U + Z[at], gap);
      here.force += side->share * law.W;
      here.potential += side->share * law.P;
      here.charge += side->share * law.q;
      here.inverse_gap += side->share * side->law->relative * zp_plates_inverse_gap(side->law, gap);
    }
    totals.force += length * here.force;
    totals.potential += length * (here.potential + of_interface(p, U, Z[at]));
    totals.charge += length * (here.charge - p->insulators * Z[at]);
    totals.inverse_gap += length * here.inverse_gap;
  }
  return totals;
}

ZpLeakNow zp_leak_now(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpPlatesEval *gaps, double U,
                      const double *Z) {
  ZpLeakNow now = {0, 0, 0, 0};
  double all = 0;
  for (size_t at = 0; at < zp_leak_state(p, plates); at++) {
    ZpLeakFace face;
    if (!find_face(p, plates, gaps, gaps, at, &face)) continue;
    double length = face.length1, gap = face.g1;
    Conduction here =
        face.sides == 1 ? conduction_at(p, &face, 1, U + Z[at], Z[at]) : conduction_at(p, &face, 2, U + Z[at], Z[at]);
    all += length;
    now.mean += length * Z[at];
    now.current += length * here.insulators;
    if (face.wet > 0) now.liquid = fmax(now.liquid, fabs(U + Z[at]) / (fmax(gap, 0) + plates->d));
    now.fastest = fmax(now.fastest, fabs(here.gathers) / p->insulators);
  }
  now.mean = all > 0 ? now.mean / all : 0;
  return now;
}
