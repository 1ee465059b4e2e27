/* Letters of docs/theory.md, section 25:
 *   Z  interface voltage, V             Y  U + Z, V
 *   q  charge per length on the liquid's faces, that of the plates law at Y, C/m
 *   C  capacitance of both insulators per length, F/m        G  their conductance per length, S/m
 *   s  conductivity over permittivity of the liquid, 1/s
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

void zp_leak_carve(const ZpPlatesParams *plates, ZpLeakEval *e, ZpCarver *carver) {
  size_t count = places(plates);
  e->by_gap = zp_carve(carver, count);
  e->by_voltage = zp_carve(carver, count);
  e->passed = (ZpLeakPassed *)(void *)zp_carve(carver, count * (sizeof *e->passed / sizeof(double)));
  e->piece = (ZpPlatesMean *)(void *)zp_carve(carver, count * (sizeof *e->piece / sizeof(double)));
  zp_plates_step_carve(plates, &e->work, carver);
}

/* -- a place over a step --------------------------------------------------------------------------- */

/* q: straight in Y until the cap holds it. */
typedef struct Charge {
  double slope; /* dq/dY, F/m */
  double bend;  /* of that by g, F/m^2 */
  double most;  /* C/m */
} Charge;

/* Of the plates law, whose gap may be negative where faces overlap. */
static Charge charge_in_field(const ZpPlatesParams *p, double g) {
  double h = g + p->d;
  return (Charge){2 * p->k / h, -2 * p->k / (h * h), p->h_per_volt > 0 ? 2 * p->k / p->h_per_volt : INFINITY};
}

/* Of conduction: faces that overlap touch. */
static Charge charge_of(const ZpPlatesParams *p, double g) {
  Charge charge = charge_in_field(p, fmax(g, 0));
  if (g <= 0) charge.bend = 0;
  return charge;
}

static double at(Charge charge, double Y) {
  return copysign(fmin(charge.slope * fabs(Y), charge.most), Y);
}

static bool is_held(Charge charge, double Y) {
  return charge.slope * fabs(Y) > charge.most;
}

/* Conduction there, C/(m s): through the insulators, and the excess over that through the liquid. */
typedef struct Conduction {
  double insulators, gathers;
} Conduction;

static Conduction conduction(const ZpLeakParams *p, double q, double Z) {
  double through = p->conductance * (q / p->insulators - Z);
  return (Conduction){through, through - p->discharge * q};
}

/* Weight of a step's end with which a place of constant gap and voltage relaxes exactly. */
static double weight_of_end(const ZpLeakParams *p, Charge charge, double Y, double h) {
  double slope = is_held(charge, Y) ? 0 : charge.slope;
  return zp_decay_weight(h * (p->conductance * (1 - slope / p->insulators) + p->discharge * slope) / p->insulators);
}

/* A place at the end of a step. */
typedef struct End {
  double Y, by_gap, by_voltage;
  ZpLeakPassed passed;
} End;

/* C (Z1 - Z0) = h times the weighted mean of the excess: linear in Y1, or with q fixed by the cap. */
static End end_of(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpLeakStep *step, double Z0, double g0,
                  double g1) {
  double C = p->insulators, G = p->conductance, Y0 = step->U0 + Z0, U1 = step->U1;
  Charge charge0 = charge_of(plates, g0), charge1 = charge_of(plates, g1);
  double weight = weight_of_end(p, charge0, Y0, step->h), h = step->h * weight;
  Conduction before = conduction(p, at(charge0, Y0), Z0);
  double per_charge = h * (G / C - p->discharge), own = C + h * G;
  double known = C * (U1 + Z0) + (step->h - h) * before.gathers + h * G * U1;
  double Y = known / (own - per_charge * charge1.slope);
  bool held = is_held(charge1, Y);
  if (held) Y = (known + per_charge * copysign(charge1.most, Y)) / own;
  double slope = held ? 0 : charge1.slope, bend = held ? 0 : charge1.bend * Y, over = 1 / (own - per_charge * slope);
  End end = {.Y = Y, .by_gap = per_charge * bend * over, .by_voltage = own * over};
  double through = conduction(p, at(charge1, Y), Y - U1).insulators, of_end = h * G;
  end.passed.charge = (step->h - h) * before.insulators + h * through;
  end.passed.by_gap = of_end * ((bend + slope * end.by_gap) / C - end.by_gap);
  end.passed.by_voltage = of_end * (slope * end.by_voltage / C - (end.by_voltage - 1));
  return end;
}

void zp_leak_step(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpLeakStep *step, ZpLeakEval *e) {
  for (size_t k = 0; k < places(plates); k++) {
    ZpPlatesPlace place = zp_plates_place(plates, k);
    e->Z[k] = step->Z[k];
    e->passed[k] = (ZpLeakPassed){0, 0, 0};
    if (!is_face(&place)) continue;
    double g0 = zp_plates_place_gap(&place, step->start), g1 = zp_plates_place_gap(&place, step->end);
    End end = end_of(p, plates, step, step->Z[k], g0, g1);
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
    ZpPlatesPlace place = zp_plates_place(plates, k);
    if (!is_face(&place)) continue;
    double g0 = zp_plates_place_gap(&place, step->start), g1 = zp_plates_place_gap(&place, step->end);
    double Y1 = step->U1 + e->Z[k];
    ZpPlatesMean piece = zp_plates_between(plates, step->U0 + step->Z[k], Y1, g0, g1);
    piece.slope += zp_plates_between_by_voltage(plates, Y1, g0, g1).W * e->by_gap[k];
    piece.P += 0.5 * (of_interface(p, step->U0, step->Z[k]) + of_interface(p, step->U1, e->Z[k]));
    e->piece[k] = piece;
  }
  zp_plates_step_of(plates, e->piece, step->start, step->end, forces);
}

/* -- by the voltage -------------------------------------------------------------------------------- */

/* Derivative of the mean force: half of the law at the end. */
static ZpPlatesMean force_by_voltage(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpLeakStep *step,
                                     const ZpLeakEval *e, size_t k, double g0, double g1) {
  double Z = e->Z[k], U = step->U1, by_U = e->by_voltage[k];
  ZpPlatesMean piece = zp_plates_between_by_voltage(plates, U + Z, g0, g1);
  piece.W *= by_U;
  piece.P = piece.P * by_U + 0.5 * p->insulators * ((U + Z) * by_U - U);
  return piece;
}

/* Derivative of the charge q - C Z at the end and of the conducted charge, half of which depends on the x-length
 * there. */
static ZpPlatesMean charge_piece(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpLeakStep *step,
                                 const ZpLeakEval *e, size_t k, double g1) {
  double Z = e->Z[k], C = p->insulators, Y = step->U1 + Z;
  ZpPlatesMean at_rest = zp_plates_between_by_voltage(plates, Y, g1, g1); /* half of it */
  double by_gap = (zp_plates_capacitance(plates, Y, g1) - C) * e->by_gap[k] - 2 * at_rest.W + e->passed[k].by_gap;
  return (ZpPlatesMean){-by_gap, 0, 2 * at_rest.P + C * Z - 0.5 * e->passed[k].charge, 0};
}

void zp_leak_by_voltage(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpLeakStep *step, ZpLeakEval *e,
                        ZpPlatesByVoltage *by) {
  ZpPlatesStep forces = e->work, charges = e->work;
  forces.Fx = by->Fx, forces.Fy = by->Fy, charges.Fx = by->Qx, charges.Fy = by->Qy;
  by->capacitance = 0;
  for (size_t k = 0; k < places(plates); k++) {
    ZpPlatesPlace place = zp_plates_place(plates, k);
    if (!is_face(&place)) continue;
    double g0 = zp_plates_place_gap(&place, step->start), g1 = zp_plates_place_gap(&place, step->end);
    double C = p->insulators, by_U = e->by_voltage[k], length = zp_plates_place_length(&place, step->end);
    e->piece[k] = force_by_voltage(p, plates, step, e, k, g0, g1);
    by->capacitance += length * (zp_plates_capacitance(plates, step->U1 + e->Z[k], g1) * by_U - C * (by_U - 1) +
                                 e->passed[k].by_voltage);
  }
  zp_plates_step_of(plates, e->piece, step->start, step->end, &forces);
  for (size_t k = 0; k < places(plates); k++) {
    ZpPlatesPlace place = zp_plates_place(plates, k);
    if (is_face(&place)) e->piece[k] = charge_piece(p, plates, step, e, k, zp_plates_place_gap(&place, step->end));
  }
  zp_plates_step_of(plates, e->piece, step->end, step->end, &charges);
}

/* -- totals ---------------------------------------------------------------------------------------- */

double zp_leak_passed(const ZpPlatesParams *plates, const ZpLeakStep *step, const ZpLeakEval *e) {
  double sum = 0;
  for (size_t k = 0; k < places(plates); k++) {
    ZpPlatesPlace place = zp_plates_place(plates, k);
    if (!is_face(&place)) continue;
    double before = zp_plates_place_length(&place, step->start), after = zp_plates_place_length(&place, step->end);
    sum += 0.5 * (before + after) * e->passed[k].charge;
  }
  return sum;
}

/* Integral of C Y - q, which is C times the voltage across the liquid, over Y from 0, at a gap g: eq. (25.4), J/m. */
static double across_liquid(const ZpLeakParams *p, const ZpPlatesParams *plates, double g, double Y) {
  Charge charge = charge_in_field(plates, g);
  double free = fmin(fabs(Y), charge.most / charge.slope), held = fabs(Y) - free;
  double sum = 0.5 * p->insulators * g / (g + plates->d) * free * free;
  return held > 0 ? sum + held * (p->insulators * (free + 0.5 * held) - charge.most) : sum;
}

/* By how much the potential of a place rises as Z goes from Z0 to Z1 at constant gap and voltage, J/m. */
static double rise(const ZpLeakParams *p, const ZpPlatesParams *plates, double U, double g, double Z0, double Z1) {
  return across_liquid(p, plates, g, U + Z1) - across_liquid(p, plates, g, U + Z0);
}

ZpLeakHeat zp_leak_heat(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpLeakStep *step,
                        const ZpLeakEval *e) {
  double touching = 0, stored = 0;
  for (size_t k = 0; k < places(plates); k++) {
    ZpPlatesPlace place = zp_plates_place(plates, k);
    if (!is_face(&place)) continue;
    double g0 = zp_plates_place_gap(&place, step->start), g1 = zp_plates_place_gap(&place, step->end);
    double dx0 = 0.5 * zp_plates_place_length(&place, step->start),
           dx1 = 0.5 * zp_plates_place_length(&place, step->end);
    double Z0 = step->Z[k], Z1 = e->Z[k];
    touching +=
        dx0 * rise(p, plates, step->U1, fmax(g0, 0), Z0, Z1) + dx1 * rise(p, plates, step->U0, fmax(g1, 0), Z0, Z1);
    stored += dx0 * rise(p, plates, step->U1, g0, Z0, Z1) + dx1 * rise(p, plates, step->U0, g1, Z0, Z1);
  }
  double given = 0.5 * (step->U0 + step->U1) * zp_leak_passed(plates, step, e);
  return (ZpLeakHeat){given - touching, touching - stored};
}

ZpPlatesTotals zp_leak_totals(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpPlatesEval *gaps, double U,
                              const double *Z) {
  ZpPlatesTotals totals = {0, 0, 0, 0};
  for (size_t k = 0; k < places(plates); k++) {
    ZpPlatesPlace place = zp_plates_place(plates, k);
    if (!is_face(&place)) continue;
    double gap = zp_plates_place_gap(&place, gaps), length = zp_plates_place_length(&place, gaps);
    ZpPlatesLaw law = zp_plates_law(plates, U + Z[k], gap);
    totals.force += length * law.W;
    totals.potential += length * (law.P + of_interface(p, U, Z[k]));
    totals.charge += length * (law.q - p->insulators * Z[k]);
    totals.inverse_gap += length * zp_plates_inverse_gap(plates, gap);
  }
  return totals;
}

ZpLeakNow zp_leak_now(const ZpLeakParams *p, const ZpPlatesParams *plates, const ZpPlatesEval *gaps, double U,
                      const double *Z) {
  ZpLeakNow now = {0, 0, 0, 0};
  double all = 0;
  for (size_t k = 0; k < places(plates); k++) {
    ZpPlatesPlace place = zp_plates_place(plates, k);
    if (!is_face(&place)) continue;
    double length = zp_plates_place_length(&place, gaps);
    double gap = zp_plates_place_gap(&place, gaps);
    Charge charge = charge_of(plates, gap);
    Conduction here = conduction(p, at(charge, U + Z[k]), Z[k]);
    all += length;
    now.mean += length * Z[k];
    now.current += length * here.insulators;
    now.liquid = fmax(now.liquid, fabs(U + Z[k]) / (fmax(gap, 0) + plates->d));
    now.fastest = fmax(now.fastest, fabs(here.gathers) / p->insulators);
  }
  now.mean = all > 0 ? now.mean / all : 0;
  return now;
}
