/* The film of liquid between the faces, whose heads are unknowns of the step. Eqs. (22.1) to (22.11). */
#include "term/term.h"

const ZpRow zp_row_liquid_energy =
    ZP_STORED(liquid_energy, "kinetic energy of the liquid between and around the ribbons, and the energy of cavities");
const ZpRow zp_row_film_along_loss =
    ZP_LOST(film_along_loss, "energy lost so far to viscosity in the flow along the film between the faces");
const ZpRow zp_row_film_across_loss =
    ZP_LOST(film_across_loss, "energy lost so far to viscosity in the flow across the film, to its long edges");
const ZpRow zp_row_jet_loss =
    ZP_LOST(jet_loss, "energy lost so far in jets from the long edges of the film and in collapsing cavities");
const ZpRow zp_row_meniscus_loss =
    ZP_LOST(meniscus_loss, "net energy lost so far at moving menisci of a bead; may be negative");

enum { STORED, ALONG, ACROSS, JETS, MENISCI };

static bool acts(const ZpModel *model) {
  return model->has_film;
}

static size_t state(const ZpModel *model) {
  return ZP_FILM_STATE * model->nodes;
}

static const double *memory_of(const ZpModel *model, const double *memory) {
  return zp_law_memory(model, &zp_term_film, memory);
}

static bool create(const ZpModel *model, ZpEval *e) {
  e->film.end = e->memory_end + zp_law(model, &zp_term_film)->at;
  return true;
}

/* Which half a station is of. */
static size_t half_of(const ZpModel *model, size_t i) {
  return i > model->topology.platform.first;
}

/* The share of the long edges at a station through which liquid can pass: all, if the film pressed at the end of the
 * last step; if it sucked, in proportion to the liquid there. */
static double open_share(const ZpModel *model, const ZpSpan *span, size_t i) {
  const double *heads = span->own + ZP_FILM_MODES * i;
  const ZpBead *bead = &span->bead[half_of(model, i)];
  bool presses = model->film.share[0] * heads[0] + model->film.share[1] * heads[1] > 0;
  if (!model->has_bead || presses || bead->reach >= zp_bead_longest(&model->film)) return 1;
  return bead->supply;
}

/* Prediction: gaps change as over the last step. Cavities are those of its end, whatever was evaluated since. */
static void begin(const ZpModel *model, const ZpSpan *span, ZpEval *e) {
  for (size_t i = 0; i < model->nodes; i++)
    e->open[i] = open_share(model, span, i);
  zp_film_begin(&model->film, memory_of(model, span->memory), &e->film);
  for (size_t i = 0; i < model->nodes; i++) {
    const double *w = span->w ? zp_nodes(model, span->w).y : NULL;
    e->film.rate[i] = w ? zp_parting(&model->topology, w, i) : 0;
  }
}

static ZpFilmEnds ends_of(const ZpModel *model, const ZpEval *e) {
  const ZpCover *cover = model->has_bead ? &e->cover : NULL;
  return (ZpFilmEnds){cover, e->open, {e->meniscus[0], e->meniscus[1]}};
}

/* The charge of a patch between insulators and liquid at a bead's end, as a voltage: that at the start of the step. */
static double interface_at(const ZpModel *model, const ZpSpan *span, size_t patch, const ZpBeadPlace *at) {
  if (!model->leaks) return 0;
  const double *Z = zp_leak_of_patch(&model->plates, zp_law_memory(model, &zp_term_leak, span->memory), patch);
  if (at->near == at->far) return Z[zp_plates_flat_place(at->near)];
  bool left = at->near < at->far;
  return Z[zp_plates_place_at(left ? at->near : at->far, left ? at->part : 1 - at->part)];
}

/* At the predicted middle of the step; a mean over both voltages. */
static double meniscus_head(const ZpModel *model, const ZpSpan *span, const ZpEval *e, int half) {
  const ZpFilmParams *film = &model->film;
  ZpBeadPlace at = zp_bead_place(film, half, e->reach[half]);
  double gap = zp_bead_at(&at, e->plates_start.gap), H = zp_bead_thickness(film, &at, e->plates_start.gap);
  double moved = fmax(0.5 * span->h * zp_bead_at(&at, e->film.rate), -0.5 * H);
  double level = zp_term_level(model, &at, span->start);
  if (span->w && at.near != at.far) level += 0.5 * span->h * zp_term_level(model, &at, span->w);
  double room = zp_term_meniscus_room(model, e->reach[half]).share, suction = model->bead.suction, sum = 0;
  for (size_t k = 0; k < model->leak.patches; k++) {
    double Z = interface_at(model, span, k, &at);
    sum += model->leak.patch[k].share *
           (zp_term_meniscus_head(model, suction, span->U0 + Z, gap + moved, H + moved, level) +
            zp_term_meniscus_head(model, suction, span->U1 + Z, gap + moved, H + moved, level));
  }
  return 0.5 * room * sum;
}

static void find_menisci(const ZpModel *model, const ZpSpan *span, ZpEval *e) {
  for (int half = 0; half < zp_beads(&model->film); half++) {
    bool ends = model->has_bead && model->bead.suction > 0 && e->reach[half] < zp_bead_longest(&model->film);
    e->meniscus[half] = ends ? meniscus_head(model, span, e, half) : 0;
  }
}

static void solve_step(const ZpModel *model, const ZpSpan *span, ZpEval *e) {
  ZpFilmEnds ends = ends_of(model, e);
  find_menisci(model, span, e);
  ends.head[0] = e->meniscus[0];
  ends.head[1] = e->meniscus[1];
  zp_film_step(&model->film, &ends, e->plates_start.gap, e->plates.gap, span->h, memory_of(model, span->memory),
               span->own, &e->film);
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  if (zp_span_is_still(span)) return;
  solve_step(model, span, e);
  for (size_t i = 0; i < model->nodes; i++)
    zp_term_part(model, i, e->film.force[i], F);
}

static void by_heads(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, const ZpFilmEval *e,
                     size_t i, ZpBand *K) {
  const ZpFilmParams *film = &model->film;
  for (int k = 0; k < ZP_FILM_MODES; k++) {
    size_t p = zp_film_mode_at(i, k);
    for (int m = k; m < ZP_FILM_MODES; m++)
      zp_assemble_own(assembly, p, zp_film_mode_at(i, m), zp_film_own(film, span->h, e, i, k, m), K);
    for (int m = 0; m < ZP_FILM_MODES && i + 1 < model->nodes; m++)
      zp_assemble_own(assembly, p, zp_film_mode_at(i + 1, m), zp_film_next(film, span->h, e, i, k, m), K);
  }
}

/* The derivative of the force by the head is that of the volume by the gap with the opposite sign. The terms of
 * convection, which would have one sign there and the other here, are omitted. */
static void by_gaps(const ZpModel *model, const ZpAssembly *assembly, const ZpFilmEval *e, size_t i, ZpBand *K) {
  for (int k = 0; k < ZP_FILM_MODES; k++)
    for (size_t j = i > 0 ? i - 1 : 0; j <= i + 1 && j < model->nodes; j++)
      zp_assemble_own_by_gap(assembly, zp_film_mode_at(i, k), j, -zp_film_by_gap(&model->film, e, i, j, k), K);
}

static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e, ZpBand *K) {
  if (zp_span_is_still(span)) return;
  for (size_t i = 0; i < model->nodes; i++) {
    by_heads(model, span, assembly, &e->film, i, K);
    by_gaps(model, assembly, &e->film, i, K);
  }
}

/* Energy of the surfaces that the liquid wets, J, in proportion to the suction. */
static double surface_energy(const ZpModel *model, const double reach[ZP_BEADS]) {
  if (!model->has_bead) return 0;
  double length = zp_beads(&model->film) > 1 ? reach[0] + reach[1] : reach[0];
  return -2 * model->bead.suction * model->bead.tension * model->film.w * length;
}

static void energy(const ZpModel *model, const ZpSpan *now, ZpEval *e, double *row) {
  zp_term_gaps(model, now, e);
  ZpFilmEnds ends = ends_of(model, e);
  row[STORED] += zp_film_energy(&model->film, ends.cover, e->plates.gap, memory_of(model, now->memory)) +
                 surface_energy(model, e->reach);
}

static void past_edges(const ZpModel *model, const ZpSpan *span, const ZpEval *e, ZpBeadEdges edges[ZP_BEADS]) {
  for (size_t i = 0; i < model->nodes; i++) {
    ZpBeadEdges *of = &edges[half_of(model, i)];
    double volume = span->h * zp_film_edge_flow(&model->film, &e->film, i);
    double free = e->open[i] < 1 ? span->h * zp_film_open_flow(&model->film, &e->film, span->own, i) : volume;
    of->pressed_out += fmax(volume, 0);
    of->drawn_in += fmax(-volume, 0);
    of->wanted += fmax(-free, 0);
  }
}

static void find_end(const ZpModel *model, const ZpSpan *span, ZpEval *e) {
  ZpBeadEdges edges[ZP_BEADS] = {0};
  past_edges(model, span, e, edges);
  for (int half = 0; half < zp_beads(&model->film); half++)
    e->bead_end[half] =
        zp_bead_after(&model->bead, &model->film, e->plates.gap, half, span->bead[half], edges[half], span->h);
}

/* Stations from `first` on before `end`: those around which the liquid of a step moves. */
typedef struct Shore {
  size_t first, end;
} Shore;

static void reaches(const ZpFilmParams *film, const double reach[ZP_BEADS], Shore *shore) {
  for (int half = 0; half < ZP_BEADS && half < zp_beads(film); half++) {
    ZpBeadPlace at = zp_bead_place(film, half, reach[half]);
    size_t left = at.near < at.far ? at.near : at.far, right = at.near < at.far ? at.far : at.near;
    if (left < shore->first) shore->first = left;
    if (right + 1 > shore->end) shore->end = right + 1;
  }
}

/* Potential of the field, J; with charge between insulators and liquid that of all faces. */
static double potential(const ZpModel *model, const ZpPlatesEval *gaps, double U, const double *memory, Shore shore) {
  if (!model->leaks) return zp_plates_totals_among(&model->plates, gaps, U, shore.first, shore.end - 1).potential;
  return zp_leak_totals(&model->leak, &model->plates, gaps, U, zp_law_memory(model, &zp_term_leak, memory)).potential;
}

/* Energy of the gap around the shore at one end of the step, with liquid up to `reach`: the field's potential and the
 * film's energy, J. `memory`: the state of all laws there. */
static double stored(const ZpModel *model, const ZpPlatesEval *gaps, double U, const double *memory,
                     const double reach[ZP_BEADS], Shore shore, ZpEval *e) {
  zp_eval_cover(model, reach, e);
  return potential(model, gaps, U, memory, shore) +
         zp_film_energy_among(&model->film, &e->cover, gaps->gap, memory_of(model, memory), shore.first, shore.end) +
         surface_energy(model, reach);
}

/* The liquid moves to its place in the middle with all else fixed, and from there to that of the end. The energy
 * released, less the part that the film has received, eq. (22.18). */
static double lost_at_menisci(const ZpModel *model, const ZpSpan *span, ZpEval *e, const ZpFilmLoss *film) {
  const ZpPlatesEval *start = &e->plates_start, *end = &e->plates;
  const double before[ZP_BEADS] = {span->bead[0].reach, span->bead[1].reach},
               after[ZP_BEADS] = {e->bead_end[0].reach, e->bead_end[1].reach};
  Shore shore = {model->nodes, 0};
  reaches(&model->film, before, &shore);
  reaches(&model->film, e->reach, &shore);
  reaches(&model->film, after, &shore);
  double released = stored(model, start, span->U0, span->memory, before, shore, e) -
                    stored(model, start, span->U0, span->memory, e->reach, shore, e);
  released += stored(model, end, span->U1, e->memory_end, e->reach, shore, e) -
              stored(model, end, span->U1, e->memory_end, after, shore, e);
  return released + film->given + film->carried;
}

/* The heads have been corrected since the last force. */
static void loss(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *row) {
  solve_step(model, span, e);
  ZpFilmEnds ends = ends_of(model, e);
  ZpFilmLoss lost = zp_film_loss(&model->film, &ends, span->h, memory_of(model, span->memory), &e->film);
  row[ALONG] += lost.along;
  row[ACROSS] += lost.across;
  row[JETS] += lost.jets;
  if (!model->has_bead) return;
  find_end(model, span, e);
  row[MENISCI] += lost_at_menisci(model, span, e, &lost);
}

/* Resistance to a change of the gap, at most as if all liquid flowed across. */
static void inertia(const ZpModel *model, const ZpSpan *span, const ZpEval *e, const double *a, double *F) {
  const double *up = zp_nodes(model, a).y;
  for (size_t i = 0; i < model->nodes; i++)
    zp_term_part(model, i, zp_film_inertia(&model->film, span->h, &e->film, i) * zp_parting(&model->topology, up, i),
                 F);
}

#define WET ZP_ONE_OF(liquid.model, ZP_BIT(ZP_LIQUID_SUBMERGED) | ZP_BIT(ZP_LIQUID_BEAD))
static const ZpRule rule[] = {
    ZP_RULE(PHYSICS, WET, ZP_HAS(ELECTRODES), "a single ribbon has no gap for a film; use liquid.model none"),
    ZP_RULE(NOT_MODELLED, WET,
            ZP_CONDITION(actuator.kind, HAS, ZP_DEVICE_PLATFORM | ZP_DEVICE_COUNTER | ZP_DEVICE_POUCH),
            "the film is modelled between two ribbons with a platform, over a counter electrode, or in a pouch; use "
            "liquid.model none"),
    ZP_RULE(NOT_MODELLED, ZP_IS(liquid.model, ZP_LIQUID_BEAD), ZP_HAS(PLATFORM),
            "the bead is modelled between two ribbons with a platform; use liquid.model submerged or none"),
    ZP_RULE(PHYSICS, WET, ZP_ABOVE(medium.density, 0), "nothing flows in a vacuum; use liquid.model none"),
    ZP_RULE(EQUATION, WET, ZP_IS(ribbon.model, ZP_RIBBON_ROD), "the film acts on rods; use liquid.model none"),
    ZP_RULE(EQUATION, WET, ZP_IS(electro.surface, ZP_SURFACE_POLYLINE),
            "the paper's surface has no gap for a film; use liquid.model none"),
    ZP_RULE(EQUATION, WET, ZP_IS(contact.model, ZP_CONTACT_UNILATERAL),
            "the paper's zipping leaves no film between the faces; use liquid.model none"),
    ZP_MOTION_RULE(NOT_MODELLED, WET, ZP_IS(solver.integrator, ZP_INTEGRATOR_IMPLICIT),
                   "the pressures of the film are unknowns of implicit steps; use liquid.model none"),
};
#undef WET

const ZpTerm zp_term_film = {.name = "film",
                             .row = {[STORED] = &zp_row_liquid_energy,
                                     [ALONG] = &zp_row_film_along_loss,
                                     [ACROSS] = &zp_row_film_across_loss,
                                     [JETS] = &zp_row_jet_loss,
                                     [MENISCI] = &zp_row_meniscus_loss},
                             .state = state,
                             .acts = acts,
                             .create = create,
                             .begin = begin,
                             .force = force,
                             .stiffness = stiffness,
                             .inertia = inertia,
                             .now = energy,
                             .loss = loss,
                             .rules = ZP_RULES_OF(rule)};
