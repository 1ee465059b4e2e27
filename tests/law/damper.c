/* A law in one file: a damper beside the load, whose coefficient grows while it works. It has a key, a force, a state,
 * a loss and a signal. test_law.c adds it to models of a program; law_is_one_file.py makes it a file of src/term/, with
 * a line of keys.def and one of terms.def. */
#include "term/term.h"

/* The coefficient at first, N s/m: a member's own, on the load of the whole actuator, and that of all members. A
 * program that brings the damper has no key. */
#ifdef DAMPER_OF_PROGRAM
#define DAMPER_COLD(model)  ((void)(model), DAMPER_OF_PROGRAM)
#define DAMPER_WHOLE(model) ((void)(model), DAMPER_OF_PROGRAM)
#else
#define DAMPER_COLD(model)  ((model)->def.load.damping)
#define DAMPER_WHOLE(model) ((model)->whole->load.damping)
#endif
static const double grows = 1e3; /* coefficient per (m/s)^2 s, over the cold one */

extern const ZpTerm zp_term_damper;
const ZpRow zp_row_damper_loss = ZP_LOST(damper_loss, "energy lost so far in the damper beside the load");
const ZpRow zp_row_damper_coefficient =
    ZP_SHOWN(damper_coefficient, "N s/m", "_N_s_per_m", "coefficient of the damper beside the load");
enum { LOST, COEFFICIENT };

/* Members on which no load hangs have none of the load's keys. */
static bool acts(const ZpModel *model) {
  return DAMPER_COLD(model) > 0;
}

/* The state has one number, the growth of the coefficient. */
static size_t state(const ZpModel *model) {
  (void)model;
  return 1;
}

static double gained(const ZpModel *model, const ZpSpan *span) {
  const double *memory = zp_law_memory(model, &zp_term_damper, span->memory);
  return memory ? *memory : 0;
}

/* Component of the load in coordinates, velocities or accelerations, upwards. */
static double load_of(const ZpModel *model, const double *q) {
  return zp_load_at(model, zp_nodes(model, q).y);
}

/* Mean velocity of the load over the span, or over an explicit step; that of an instant; at rest 0. */
static double velocity(const ZpModel *model, const ZpSpan *span) {
  if (span->a) return load_of(model, span->v) - 0.5 * span->h * load_of(model, span->a);
  if (span->v) return load_of(model, span->v);
  if (!(span->h > 0)) return 0;
  return (load_of(model, span->end) - load_of(model, span->start)) / span->h;
}

/* In the middle of the span, on one end that the load hangs on, N s/m. */
static double coefficient(const ZpModel *model, const ZpSpan *span) {
  double v = velocity(model, span);
  return zp_end_share(model) * DAMPER_COLD(model) * (1 + gained(model, span) + 0.5 * span->h * grows * v * v);
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *eval, double *F) {
  (void)eval;
  const ZpTopology *t = &model->topology;
  double push = -coefficient(model, span) * velocity(model, span);
  for (size_t i = t->platform.first; i <= t->platform.last; i++)
    zp_forces(model, F).y[zp_lower(t, i)] += push;
}

/* Both ends of a platform that does not turn have one height. */
static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *eval, ZpBand *K) {
  (void)eval;
  const ZpTopology *t = &model->topology;
  if (!(span->h > 0)) return;
  double v = velocity(model, span), warms = zp_end_share(model) * DAMPER_COLD(model) * span->h * grows * v * v;
  for (size_t i = t->platform.first; i <= t->platform.last; i++)
    zp_assemble_entry(assembly, zp_y_of(zp_lower(t, i)), zp_y_of(zp_lower(t, i)),
                      (coefficient(model, span) + warms) / span->h, K);
}

static void loss(const ZpModel *model, const ZpSpan *span, ZpEval *eval, double *row) {
  double v = velocity(model, span);
  row[LOST] += (double)zp_halves(&model->topology) * coefficient(model, span) * v * v * span->h;
  eval->memory_end[zp_law(model, &zp_term_damper)->at] = gained(model, span) + span->h * grows * v * v;
}

static void show(const ZpModel *model, const ZpSpan *now, ZpEval *eval, double *row) {
  (void)eval;
  row[COEFFICIENT] += DAMPER_WHOLE(model) * (1 + gained(model, now));
}

#ifdef DAMPER_OF_PROGRAM
static const ZpRule rule[1];
#else
static const ZpRule rule[] = {
    ZP_RULE(NOT_MODELLED, ZP_ABOVE(load.damping, 0), ZP_IS(platform.rotates, false),
            "the damper is modelled for level platforms only"),
};
#endif

const ZpTerm zp_term_damper = {.name = "damper",
                               .row = {[LOST] = &zp_row_damper_loss, [COEFFICIENT] = &zp_row_damper_coefficient},
                               .acts = acts,
                               .state = state,
                               .force = force,
                               .stiffness = stiffness,
                               .loss = loss,
                               .now = show,
                               .rules = ZP_RULES_OF(rule)};
