/* Letters of docs/theory.md, section 25:
 *   Z  interface voltage, V             Y  U + Z, V
 *   q  charge per length on the liquid's faces, that of the plates law at Y, C/m
 *   C  capacitance of both insulators per length, F/m        G  their conductance per length, S/m
 *   s  conductivity over permittivity of the liquid, 1/s; 0 of air
 * The insulators conduct G (q / C - Z), the liquid s q; what the one has more than the other gathers: C dZ/dt. */
#include "electro/leak.h"

#include <math.h>

#include "math/elementary.h"

static size_t places(const ZpPlatesParams *plates) {
  return ZP_PLATES_PLACES * plates->nodes;
}

static bool is_face(const ZpPlatesPlace *place) {
  return place->weight > 0 || place->length > 0;
}

void zp_leak_reserve(const ZpPlatesParams *plates, ZpLeakEval *e, ZpArena *arena) {
  size_t count = places(plates);
  e->by_gap = zp_arena_take(arena, count);
  e->by_voltage = zp_arena_take(arena, count);
  e->passed = (ZpLeakPassed *)(void *)zp_arena_take(arena, count * (sizeof *e->passed / sizeof(double)));
  e->piece = (ZpPlatesMean *)(void *)zp_arena_take(arena, count * (sizeof *e->piece / sizeof(double)));
  zp_plates_step_reserve(plates, &e->work, arena);
}

/* -- what covers a place --------------------------------------------------------------------------- */

/* Liquid, or the air beyond a bead: the plates law there, and the share of the place under it. */
typedef struct Side {
  const ZpPlatesParams *law;
  double share;
  double discharge; /* s there */
} Side;

/* Where a bead ends both lie side by side, at one gap and one Z. */
typedef struct Sides {
  int count;
  Side of[2];
} Sides;

static Sides sides_of(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpPlatesPlace *place) {
  Sides sides;
  sides.count = 0;
  if (place->wet > 0) sides.of[sides.count++] = (Side){plates, place->wet, p->discharge};
  if (place->wet < 1) sides.of[sides.count++] = (Side){plates->air, 1 - place->wet, 0};
  return sides;
}

static ZpPlatesMean sum_of(ZpPlatesMean a, double share, ZpPlatesMean b) {
  return (ZpPlatesMean){a.W + share * b.W, a.slope + share * b.slope, a.P + share * b.P, a.W1 + share * b.W1};
}

/* As zp_plates_between, of all sides. */
static ZpPlatesMean between(const Sides *sides, double Y0, double Y1, double g0, double g1) {
  ZpPlatesMean sum = {0, 0, 0, 0};
  for (const Side *side = sides->of; side < sides->of + sides->count; side++)
    sum = sum_of(sum, side->share, zp_plates_between(side->law, Y0, Y1, g0, g1));
  return sum;
}

static ZpPlatesMean between_by_voltage(const Sides *sides, double Y1, double g0, double g1) {
  ZpPlatesMean sum = {0, 0, 0, 0};
  for (const Side *side = sides->of; side < sides->of + sides->count; side++)
    sum = sum_of(sum, side->share, zp_plates_between_by_voltage(side->law, Y1, g0, g1));
  return sum;
}

static double capacitance_of(const Sides *sides, double Y, double g) {
  double sum = 0;
  for (const Side *side = sides->of; side < sides->of + sides->count; side++)
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
static Charge charge_in_field(const ZpPlatesParams *p, double g) {
  double h = g + p->d;
  return (Charge){2 * p->k / h, -2 * p->k / (h * h), p->h_per_volt > 0 ? 2 * p->k / p->h_per_volt : INFINITY, 0};
}

typedef struct Charges {
  int count;
  Charge of[2];
} Charges;

/* Of conduction: faces that overlap touch. */
static Charges charges_of(const Sides *sides, double g) {
  Charges charges;
  charges.count = sides->count;
  for (int k = 0; k < sides->count; k++) {
    Charge *charge = &charges.of[k];
    double share = sides->of[k].share;
    *charge = charge_in_field(sides->of[k].law, g > 0 ? g : 0);
    charge->slope *= share;
    charge->bend *= g > 0 ? share : 0;
    charge->most *= share;
    charge->discharge = sides->of[k].discharge;
  }
  return charges;
}

static double at(const Charge *charge, double Y) {
  return copysign(fmin(charge->slope * fabs(Y), charge->most), Y);
}

static bool is_held(const Charge *charge, double Y) {
  return charge->slope * fabs(Y) > charge->most;
}

/* Conduction there, C/(m s): through the insulators, and the excess over that through the liquid. */
typedef struct Conduction {
  double insulators, gathers;
} Conduction;

static Conduction conduction(const ZpLeakParams *p, const Charges *charges, double Y, double Z) {
  double q = 0, liquid = 0;
  for (const Charge *charge = charges->of; charge < charges->of + charges->count; charge++) {
    q += at(charge, Y);
    liquid += charge->discharge * at(charge, Y);
  }
  double through = p->conductance * (q / p->insulators - Z);
  return (Conduction){through, through - liquid};
}

/* Weight of a step's end with which a place of constant gap and voltage relaxes exactly. */
static double weight_of_end(const ZpLeakParams *p, const Charges *charges, double Y, double h) {
  double slope = 0, liquid = 0;
  for (const Charge *charge = charges->of; charge < charges->of + charges->count; charge++) {
    if (is_held(charge, Y)) continue;
    slope += charge->slope;
    liquid += charge->discharge * charge->slope;
  }
  return zp_decay_weight(h * (p->conductance * (1 - slope / p->insulators) + liquid) / p->insulators);
}

/* own Y = known + the sum of `passes` times the charge of each side. The difference of both sides rises with Y, so the
 * charges that the cap holds at the solution are found in the order in which it begins to hold them. */
typedef struct Balance {
  double own, known, passes[2];
  bool held[2];
} Balance;

/* Of those that the cap would hold at Y and that still count as free, the one that it holds first; -1: none. */
static int next_held(const Balance *b, const Charges *charges, double Y) {
  int first = -1;
  double least = INFINITY;
  for (int k = 0; k < charges->count; k++) {
    double from = charges->of[k].most / charges->of[k].slope;
    if (b->held[k] || !is_held(&charges->of[k], Y) || !(from < least)) continue;
    first = k;
    least = from;
  }
  return first;
}

static double slope_of(const Balance *b, const Charges *charges) {
  double slope = b->own;
  for (int k = 0; k < charges->count; k++)
    if (!b->held[k]) slope -= b->passes[k] * charges->of[k].slope;
  return slope;
}

/* => Y, with `held`. */
static double solve(Balance *b, const Charges *charges) {
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

/* A place at the end of a step. */
typedef struct End {
  double Y, by_gap, by_voltage;
  ZpLeakPassed passed;
} End;

/* C (Z1 - Z0) = h times the weighted mean of the excess: linear in Y1, or with charges fixed by the cap. */
static End end_of(const ZpLeakParams *p, const Sides *sides, const ZpLeakStep *step, double Z0, double g0, double g1) {
  double C = p->insulators, G = p->conductance, Y0 = step->U0 + Z0, U1 = step->U1;
  Charges charges0 = charges_of(sides, g0), charges = charges_of(sides, g1);
  double weight = weight_of_end(p, &charges0, Y0, step->h), h = step->h * weight;
  Conduction before = conduction(p, &charges0, Y0, Z0);
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
  End end = {.Y = Y, .by_gap = passes * over, .by_voltage = b.own * over};
  double through = conduction(p, &charges, Y, Y - U1).insulators, of_end = h * G;
  end.passed.charge = (step->h - h) * before.insulators + h * through;
  end.passed.by_gap = of_end * ((bend + slope * end.by_gap) / C - end.by_gap);
  end.passed.by_voltage = of_end * (slope * end.by_voltage / C - (end.by_voltage - 1));
  return end;
}

void zp_leak_step(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpLeakStep *step, ZpLeakEval *e) {
  for (size_t k = 0; k < places(plates); k++) {
    ZpPlatesPlace place = zp_plates_place(plates, step->end->cover, k);
    e->Z[k] = step->Z[k];
    e->passed[k] = (ZpLeakPassed){0, 0, 0};
    if (!is_face(&place)) continue;
    double g0 = zp_plates_place_gap(&place, step->start), g1 = zp_plates_place_gap(&place, step->end);
    Sides sides = sides_of(p, plates, &place);
    End end = end_of(p, &sides, step, step->Z[k], g0, g1);
    if (step->h > 0) e->Z[k] = end.Y - step->U1;
    e->by_gap[k] = end.by_gap;
    e->by_voltage[k] = end.by_voltage;
    e->passed[k] = end.passed;
  }
}

/* -- forces ---------------------------------------------------------------------------------------- */

/* Contribution of the interface charge to the potential, J/m: eq. (25.4). */
static double of_interface(const ZpLeakParams *p, double U, double Z) {
  return p->insulators * Z * (U + 0.5 * Z);
}

void zp_leak_forces(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpLeakStep *step, ZpLeakEval *e,
                    ZpPlatesStep *forces) {
  for (size_t k = 0; k < places(plates); k++) {
    ZpPlatesPlace place = zp_plates_place(plates, step->end->cover, k);
    if (!is_face(&place)) continue;
    double g0 = zp_plates_place_gap(&place, step->start), g1 = zp_plates_place_gap(&place, step->end);
    double Y1 = step->U1 + e->Z[k];
    Sides sides = sides_of(p, plates, &place);
    ZpPlatesMean piece = between(&sides, step->U0 + step->Z[k], Y1, g0, g1);
    piece.slope += between_by_voltage(&sides, Y1, g0, g1).W * e->by_gap[k];
    piece.P += 0.5 * (of_interface(p, step->U0, step->Z[k]) + of_interface(p, step->U1, e->Z[k]));
    e->piece[k] = piece;
  }
  zp_plates_step_of(plates, e->piece, step->start, step->end, forces);
}

/* -- by the voltage -------------------------------------------------------------------------------- */

/* Derivative of the mean force: half of the law at the end. */
static ZpPlatesMean force_by_voltage(const ZpLeakParams *p, const Sides *sides, const ZpLeakStep *step,
                                     const ZpLeakEval *e, size_t k, double g0, double g1) {
  double Z = e->Z[k], U = step->U1, by_U = e->by_voltage[k];
  ZpPlatesMean piece = between_by_voltage(sides, U + Z, g0, g1);
  piece.W *= by_U;
  piece.P = piece.P * by_U + 0.5 * p->insulators * ((U + Z) * by_U - U);
  return piece;
}

/* Derivative of the charge q - C Z at the end and of the conducted charge, half of which depends on the x-length
 * there. */
static ZpPlatesMean charge_piece(const ZpLeakParams *p, const Sides *sides, const ZpLeakStep *step, const ZpLeakEval *e,
                                 size_t k, double g1) {
  double Z = e->Z[k], C = p->insulators, Y = step->U1 + Z;
  ZpPlatesMean at_rest = between_by_voltage(sides, Y, g1, g1); /* half of it */
  double by_gap = (capacitance_of(sides, Y, g1) - C) * e->by_gap[k] - 2 * at_rest.W + e->passed[k].by_gap;
  return (ZpPlatesMean){-by_gap, 0, 2 * at_rest.P + C * Z - 0.5 * e->passed[k].charge, 0};
}

void zp_leak_by_voltage(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpLeakStep *step, ZpLeakEval *e,
                        ZpPlatesByVoltage *by) {
  ZpPlatesStep forces = e->work, charges = e->work;
  forces.Fx = by->Fx, forces.Fy = by->Fy, charges.Fx = by->Qx, charges.Fy = by->Qy;
  by->capacitance = 0;
  for (size_t k = 0; k < places(plates); k++) {
    ZpPlatesPlace place = zp_plates_place(plates, step->end->cover, k);
    if (!is_face(&place)) continue;
    double g0 = zp_plates_place_gap(&place, step->start), g1 = zp_plates_place_gap(&place, step->end);
    double C = p->insulators, by_U = e->by_voltage[k], length = zp_plates_place_length(&place, step->end);
    Sides sides = sides_of(p, plates, &place);
    e->piece[k] = force_by_voltage(p, &sides, step, e, k, g0, g1);
    by->capacitance +=
        length * (capacitance_of(&sides, step->U1 + e->Z[k], g1) * by_U - C * (by_U - 1) + e->passed[k].by_voltage);
  }
  zp_plates_step_of(plates, e->piece, step->start, step->end, &forces);
  for (size_t k = 0; k < places(plates); k++) {
    ZpPlatesPlace place = zp_plates_place(plates, step->end->cover, k);
    if (!is_face(&place)) continue;
    Sides sides = sides_of(p, plates, &place);
    e->piece[k] = charge_piece(p, &sides, step, e, k, zp_plates_place_gap(&place, step->end));
  }
  zp_plates_step_of(plates, e->piece, step->end, step->end, &charges);
}

/* -- totals ---------------------------------------------------------------------------------------- */

double zp_leak_passed(const ZpPlatesParams *plates, const ZpLeakStep *step, const ZpLeakEval *e) {
  double sum = 0;
  for (size_t k = 0; k < places(plates); k++) {
    ZpPlatesPlace place = zp_plates_place(plates, step->end->cover, k);
    if (!is_face(&place)) continue;
    double before = zp_plates_place_length(&place, step->start), after = zp_plates_place_length(&place, step->end);
    sum += 0.5 * (before + after) * e->passed[k].charge;
  }
  return sum;
}

/* Integral of C Y - q, which is C times the voltage across the liquid, over Y from 0, at a gap g: eq. (25.4), J/m. */
static double across_side(const ZpLeakParams *p, const ZpPlatesParams *law, double g, double Y) {
  Charge charge = charge_in_field(law, g);
  double free = fmin(fabs(Y), charge.most / charge.slope), held = fabs(Y) - free;
  double sum = 0.5 * p->insulators * g / (g + law->d) * free * free;
  return held > 0 ? sum + held * (p->insulators * (free + 0.5 * held) - charge.most) : sum;
}

/* By how much the potential of a place rises as Z goes from Z0 to Z1 at constant gap and voltage, J/m. */
static double rise(const ZpLeakParams *p, const Sides *sides, double U, double g, double Z0, double Z1) {
  double sum = 0;
  for (const Side *side = sides->of; side < sides->of + sides->count; side++)
    sum += side->share * (across_side(p, side->law, g, U + Z1) - across_side(p, side->law, g, U + Z0));
  return sum;
}

ZpLeakHeat zp_leak_heat(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpLeakStep *step,
                        const ZpLeakEval *e) {
  double touching = 0, stored = 0;
  for (size_t k = 0; k < places(plates); k++) {
    ZpPlatesPlace place = zp_plates_place(plates, step->end->cover, k);
    if (!is_face(&place)) continue;
    double g0 = zp_plates_place_gap(&place, step->start), g1 = zp_plates_place_gap(&place, step->end);
    double dx0 = 0.5 * zp_plates_place_length(&place, step->start),
           dx1 = 0.5 * zp_plates_place_length(&place, step->end);
    double Z0 = step->Z[k], Z1 = e->Z[k];
    Sides sides = sides_of(p, plates, &place);
    touching +=
        dx0 * rise(p, &sides, step->U1, fmax(g0, 0), Z0, Z1) + dx1 * rise(p, &sides, step->U0, fmax(g1, 0), Z0, Z1);
    stored += dx0 * rise(p, &sides, step->U1, g0, Z0, Z1) + dx1 * rise(p, &sides, step->U0, g1, Z0, Z1);
  }
  double given = 0.5 * (step->U0 + step->U1) * zp_leak_passed(plates, step, e);
  return (ZpLeakHeat){given - touching, touching - stored};
}

ZpPlatesTotals zp_leak_totals(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpPlatesEval *gaps, double U,
                              const double *Z) {
  ZpPlatesTotals totals = {0, 0, 0, 0};
  for (size_t k = 0; k < places(plates); k++) {
    ZpPlatesPlace place = zp_plates_place(plates, gaps->cover, k);
    if (!is_face(&place)) continue;
    double gap = zp_plates_place_gap(&place, gaps), length = zp_plates_place_length(&place, gaps);
    Sides sides = sides_of(p, plates, &place);
    ZpPlatesTotals here = {0, 0, 0, 0};
    for (const Side *side = sides.of; side < sides.of + sides.count; side++) {
      ZpPlatesLaw law = zp_plates_law(side->law, U + Z[k], gap);
      here.force += side->share * law.W;
      here.potential += side->share * law.P;
      here.charge += side->share * law.q;
      here.inverse_gap += side->share * side->law->relative * zp_plates_inverse_gap(side->law, gap);
    }
    totals.force += length * here.force;
    totals.potential += length * (here.potential + of_interface(p, U, Z[k]));
    totals.charge += length * (here.charge - p->insulators * Z[k]);
    totals.inverse_gap += length * here.inverse_gap;
  }
  return totals;
}

ZpLeakNow zp_leak_now(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpPlatesEval *gaps, double U,
                      const double *Z) {
  ZpLeakNow now = {0, 0, 0, 0};
  double all = 0;
  for (size_t k = 0; k < places(plates); k++) {
    ZpPlatesPlace place = zp_plates_place(plates, gaps->cover, k);
    if (!is_face(&place)) continue;
    double length = zp_plates_place_length(&place, gaps);
    double gap = zp_plates_place_gap(&place, gaps);
    Sides sides = sides_of(p, plates, &place);
    Charges charges = charges_of(&sides, gap);
    Conduction here = conduction(p, &charges, U + Z[k], Z[k]);
    all += length;
    now.mean += length * Z[k];
    now.current += length * here.insulators;
    if (place.wet > 0) now.liquid = fmax(now.liquid, fabs(U + Z[k]) / (fmax(gap, 0) + plates->d));
    now.fastest = fmax(now.fastest, fabs(here.gathers) / p->insulators);
  }
  now.mean = all > 0 ? now.mean / all : 0;
  return now;
}
