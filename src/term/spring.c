/* Springs between the platforms that act on one side of an opening, or on both. That of the load pushes them apart
 * while they are nearer than load.rest_opening, eq. (27.3). A stop pulls them together while they are further apart
 * than load.stop_opening, eq. (27.5). The spring of a plate does both, eq. (37.1), and the stop behind the plate is of
 * the second kind. */
#include <math.h>

#include "def/device.h"
#include "term/term.h"

const ZpRow zp_row_spring_energy =
    ZP_STORED(spring_energy,
              "energy of the spring in parallel with the load, of stops, of the spring of a plate and of that at a "
              "hinge");

enum { OF_LOAD, STOP, OF_PLATE, BACK_STOP, SPRINGS };

typedef struct Spring {
  double k;    /* of one end that the load hangs on, N/m; 0: there is none */
  double rest; /* opening at which it begins to act, m */
  double side; /* 1: acts below that and pushes apart; -1: acts above and pulls together */
  bool both;   /* acts on both sides */
} Spring;

static Spring spring_of(const ZpModel *model, int which) {
  const ZpActuatorDef *def = &model->def;
  const bool stops = !isnan(def->load.stop_opening), rigid = zp_def_has(def, ZP_DEVICE_RIGID),
             backs = rigid && !isnan(def->plate.back_gap);
  const double plate = rigid ? zp_plate_share(model) * def->plate.stiffness : 0;
  switch (which) {
  case OF_LOAD:
    return (Spring){zp_end_share(model) * def->load.stiffness, def->load.rest_opening, 1, false};
  case STOP:
    return (Spring){stops ? zp_end_share(model) * def->load.stop_stiffness : 0, def->load.stop_opening, -1, false};
  case OF_PLATE:
    return (Spring){plate, def->plate.gap, 1, true};
  default:
    return (Spring){backs ? zp_plate_share(model) * def->plate.stop_stiffness : 0,
                    def->plate.gap + def->plate.back_gap - def->plate.back_stop_gap, -1, false};
  }
}

static bool acts(const ZpModel *model) {
  bool any = false;
  for (int k = 0; k < SPRINGS; k++)
    any |= spring_of(model, k).k > 0;
  return zp_is_pair(&model->topology) && any;
}

/* Its deformation at these coordinates, m. */
static double deformed(const ZpModel *model, const Spring *spring, const double *q) {
  double s = spring->side * (spring->rest - zp_opening(&model->topology, zp_nodes(model, q).y));
  return spring->both ? s : fmax(s, 0);
}

static bool is_taut(const Spring *spring, double s) {
  return spring->both || s > 0;
}

/* Over a span: the deformation at start and end, and the increase of the opening, m. */
typedef struct Way {
  double s0, s1, opened;
} Way;

/* Does the contact neither end nor begin on the way? */
static bool is_even(const Spring *spring, Way way) {
  return is_taut(spring, way.s0) == is_taut(spring, way.s1);
}

static Way way_of(const ZpModel *model, const Spring *spring, const ZpSpan *span) {
  const ZpTopology *t = &model->topology;
  double from = zp_opening(t, zp_nodes(model, span->start).y), to = zp_opening(t, zp_nodes(model, span->end).y);
  return (Way){deformed(model, spring, span->start), deformed(model, spring, span->end), to - from};
}

/* The mean force over the span, N: its work is the decrease of the energy. */
static double push_of(const Spring *spring, Way way) {
  if (is_even(spring, way)) return 0.5 * spring->side * spring->k * (way.s0 + way.s1);
  return 0.5 * spring->k * (way.s0 * way.s0 - way.s1 * way.s1) / way.opened;
}

/* Minus its derivative by the opening at the end, N/m; at rest both ends move. */
static double slope_of(const Spring *spring, Way way, bool still) {
  if (still) return is_taut(spring, way.s1) ? spring->k : 0;
  if (is_even(spring, way)) return is_taut(spring, way.s1) ? 0.5 * spring->k : 0;
  return (push_of(spring, way) - spring->side * spring->k * way.s1) / way.opened;
}

static void add_push(const ZpModel *model, double push, double *F) {
  const ZpTopology *t = &model->topology;
  for (size_t i = t->platform.first; i <= t->platform.last; i++)
    zp_term_part(model, i, push, F);
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  (void)e;
  double push = 0;
  for (int k = 0; k < SPRINGS; k++) {
    Spring spring = spring_of(model, k);
    if (spring.k > 0) push += span->share * push_of(&spring, way_of(model, &spring, span));
  }
  add_push(model, push, F);
}

/* Derivatives of a spring by a key: of its stiffness, over the unit of the key; of the opening at which it acts. */
typedef struct Rate {
  double k, rest;
} Rate;

static Rate rate_of(const ZpModel *model, int which, int key) {
  const double load = zp_end_share(model), plate = zp_plate_share(model);
  const bool backs = which == BACK_STOP;
  if (which == OF_LOAD) return (Rate){key == ZP_KEY(load.stiffness) ? load : 0, key == ZP_KEY(load.rest_opening)};
  if (which == STOP) return (Rate){key == ZP_KEY(load.stop_stiffness) ? load : 0, key == ZP_KEY(load.stop_opening)};
  const double k = key == (backs ? ZP_KEY(plate.stop_stiffness) : ZP_KEY(plate.stiffness)) ? plate : 0;
  return (Rate){k, (key == ZP_KEY(plate.gap)) + (backs && key == ZP_KEY(plate.back_gap)) -
                       (double)(backs && key == ZP_KEY(plate.back_stop_gap))};
}

static bool by_key(const ZpModel *model, const ZpSpan *span, ZpEval *e, int key, double *F) {
  bool any = false;
  (void)e;
  for (int which = 0; which < SPRINGS; which++) {
    const Spring spring = spring_of(model, which);
    const Rate rate = rate_of(model, which, key);
    any |= rate.k != 0 || rate.rest != 0;
    if (rate.k == 0 && (rate.rest == 0 || spring.k == 0)) continue;
    const Spring unit = {rate.k, spring.rest, spring.side, spring.both};
    const Way way = way_of(model, &spring, span);
    add_push(model, span->share * (push_of(&unit, way) + rate.rest * slope_of(&spring, way, true)), F);
  }
  return any;
}

/* Minus the derivative of the force at one end of a platform that turns, whose middle is the mean of both ends. */
static void follow_middle(const ZpTopology *t, const ZpAssembly *assembly, size_t end, double slope, ZpBand *K) {
  for (size_t i = t->platform.first; i <= t->platform.last; i++)
    zp_assemble_entry(assembly, zp_y_of(zp_lower(t, end)), zp_y_of(zp_lower(t, i)), 0.5 * slope, K);
}

static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e, ZpBand *K) {
  (void)e;
  const ZpTopology *t = &model->topology;
  double slope = 0;
  for (int k = 0; k < SPRINGS; k++) {
    Spring spring = spring_of(model, k);
    if (spring.k > 0) slope += span->share * slope_of(&spring, way_of(model, &spring, span), zp_span_is_still(span));
  }
  for (size_t i = t->platform.first; i <= t->platform.last; i++)
    if (zp_platform_turns(t))
      follow_middle(t, assembly, i, slope, K);
    else
      zp_assemble_heights(assembly, i, slope, slope, -slope, K);
}

static void energy(const ZpModel *model, const ZpSpan *now, ZpEval *e, double *row) {
  (void)e;
  for (int k = 0; k < SPRINGS; k++) {
    Spring spring = spring_of(model, k);
    double s = spring.k > 0 ? deformed(model, &spring, now->end) : 0;
    row[0] += 0.5 * (double)zp_halves(&model->topology) * spring.k * s * s;
  }
}

static const ZpRule rule[] = {
    ZP_RULE(PHYSICS, ZP_ABOVE(load.stiffness, 0), ZP_SET(load.rest_opening), "a spring has a length at rest"),
    ZP_RULE(PHYSICS, ZP_ABOVE(load.stiffness, 0), ZP_HAS(PLATFORM), "the spring acts on its platforms"),
    ZP_RULE(EQUATION, ZP_ABOVE(load.stiffness, 0), ZP_IS(contact.model, ZP_CONTACT_UNILATERAL),
            "the paper's zipping has no spring"),
    ZP_RULE_IF(PHYSICS, ZP_SET(load.stop_stiffness), ZP_ABOVE(load.stop_stiffness, 0), ZP_SET(load.stop_opening),
               "without it there is no stop"),
    ZP_RULE(PHYSICS, ZP_SET(load.stop_opening), ZP_HAS(PLATFORM), "the stop acts on its platforms"),
    ZP_RULE(EQUATION, ZP_SET(load.stop_opening), ZP_IS(contact.model, ZP_CONTACT_UNILATERAL),
            "the paper's zipping has no stop"),
};

const ZpTerm zp_term_spring = {.name = "spring",
                               .row = {&zp_row_spring_energy},
                               .acts = acts,
                               .force = force,
                               .stiffness = stiffness,
                               .now = energy,
                               .by_key = by_key,
                               .rules = ZP_RULES_OF(rule)};
