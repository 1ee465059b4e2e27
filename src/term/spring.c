/* Springs between the platforms that act on one side of an opening. That of the load pushes them apart while they are
 * nearer than load.rest_opening, eq. (27.3). A stop pulls them together while they are further apart than
 * load.stop_opening, eq. (27.5). */
#include <math.h>

#include "term/term.h"

const ZpRow zp_row_spring_energy = ZP_STORED(
    spring_energy, "energy of the spring in parallel with the load, of the stop and of the spring at a hinge");

enum { SPRINGS = 2 };

typedef struct Spring {
  double k;    /* of one end that the load hangs on, N/m; 0: there is none */
  double rest; /* opening at which it begins to act, m */
  double side; /* 1: acts below that and pushes apart; -1: acts above and pulls together */
} Spring;

static Spring spring_of(const ZpModel *model, int which) {
  const ZpActuatorDef *def = &model->def;
  bool stops = !isnan(def->load.stop_opening);
  if (which == 0) return (Spring){zp_end_share(model) * def->load.stiffness, def->load.rest_opening, 1};
  return (Spring){stops ? zp_end_share(model) * def->load.stop_stiffness : 0, def->load.stop_opening, -1};
}

static bool acts(const ZpModel *model) {
  bool any = false;
  for (int k = 0; k < SPRINGS; k++)
    any |= spring_of(model, k).k > 0;
  return zp_is_pair(&model->topology) && any;
}

/* Its deformation at these coordinates, m. */
static double deformed(const ZpModel *model, const Spring *spring, const double *q) {
  return fmax(spring->side * (spring->rest - zp_opening(&model->topology, zp_nodes(model, q).y)), 0);
}

/* Over a span: the deformation at start and end, and the increase of the opening, m. */
typedef struct Way {
  double s0, s1, opened;
} Way;

/* Does the contact neither end nor begin on the way? */
static bool is_even(Way way) {
  return (way.s0 > 0) == (way.s1 > 0);
}

static Way way_of(const ZpModel *model, const Spring *spring, const ZpSpan *span) {
  const ZpTopology *t = &model->topology;
  double from = zp_opening(t, zp_nodes(model, span->start).y), to = zp_opening(t, zp_nodes(model, span->end).y);
  return (Way){deformed(model, spring, span->start), deformed(model, spring, span->end), to - from};
}

/* The mean force over the span, N: its work is the decrease of the energy. */
static double push_of(const Spring *spring, Way way) {
  if (is_even(way)) return 0.5 * spring->side * spring->k * (way.s0 + way.s1);
  return 0.5 * spring->k * (way.s0 * way.s0 - way.s1 * way.s1) / way.opened;
}

/* Minus its derivative by the opening at the end, N/m; at rest both ends move. */
static double slope_of(const Spring *spring, Way way, bool still) {
  if (still) return way.s1 > 0 ? spring->k : 0;
  if (is_even(way)) return way.s1 > 0 ? 0.5 * spring->k : 0;
  return (push_of(spring, way) - spring->side * spring->k * way.s1) / way.opened;
}

static void add_push(const ZpModel *model, double push, double *F) {
  const ZpTopology *t = &model->topology;
  double *Fy = zp_forces(model, F).y;
  for (size_t i = t->platform.first; i <= t->platform.last; i++) {
    Fy[zp_upper(t, i)] += push;
    Fy[zp_lower(t, i)] -= push;
  }
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

static bool by_key(const ZpModel *model, const ZpSpan *span, ZpEval *e, int key, double *F) {
  static const struct {
    int stiffness, rest;
  } of[SPRINGS] = {{ZP_KEY(load.stiffness), ZP_KEY(load.rest_opening)},
                   {ZP_KEY(load.stop_stiffness), ZP_KEY(load.stop_opening)}};
  (void)e;
  for (int k = 0; k < SPRINGS; k++) {
    const Spring spring = spring_of(model, k), unit = {zp_end_share(model), spring.rest, spring.side};
    if (key != of[k].stiffness && key != of[k].rest) continue;
    const Way way = way_of(model, &spring, span);
    add_push(model, span->share * (key == of[k].rest ? slope_of(&spring, way, true) : push_of(&unit, way)), F);
    return true;
  }
  return false;
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
