/* The liquid that the films of a pouch enclose: a uniform pressure, the multiplier that keeps its volume. Eqs. (40.4)
 * to (40.6). */
#include <string.h>

#include "term/term.h"

const ZpRow zp_row_pressure = ZP_SHOWN(pressure, "Pa", "_Pa", "pressure of the liquid in a pouch; 0 without one");
const ZpRow zp_row_strain =
    ZP_SHOWN(strain, "1", "", "contraction of a pouch over the length of its films; 0 without one");
enum { PRESSURE, STRAIN };

static bool acts(const ZpModel *model) {
  return model->pouch.w > 0;
}

/* The pressure over the last step, with which the next search starts. */
static size_t state(const ZpModel *model) {
  (void)model;
  return 1;
}

size_t zp_pouch_rank(const ZpModel *model) {
  return acts(model);
}

double zp_memory_pressure(const ZpModel *model, const double *memory) {
  return acts(model) ? *zp_law_memory(model, &zp_term_pouch, memory) : 0;
}

/* Add the volume by the coordinates at one end, times a share => rate [2 stride]. */
static void add_rates(const ZpModel *model, const double *q, const double *gap, double share, double *rate) {
  const ZpForces by = zp_forces(model, rate);
  for (size_t i = 0; i < model->nodes; i++) {
    by.x[i] += share * zp_pouch_by_x(&model->pouch, model->nodes, gap, i);
    by.y[i] -= share * zp_pouch_by_h(&model->pouch, model->nodes, zp_nodes(model, q).x, i);
  }
}

/* The mean over the span: times the change of the coordinates it is that of the volume. */
static void find_rates(const ZpModel *model, const ZpSpan *span, ZpEval *e) {
  const double *before = zp_span_is_still(span) ? e->plates.gap : e->plates_start.gap;
  memset(e->by_volume, 0, zp_coordinates(model) * sizeof *e->by_volume);
  add_rates(model, span->start, before, 0.5, e->by_volume);
  add_rates(model, span->end, e->plates.gap, 0.5, e->by_volume);
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  const ZpPouchParams *pouch = &model->pouch;
  double V = zp_pouch_volume(pouch, model->nodes, zp_nodes(model, span->end).x, e->plates.gap);
  find_rates(model, span, e);
  e->pressure = span->pressure - span->modulus * (V / pouch->volume - 1);
  for (size_t k = 0; k < zp_coordinates(model); k++)
    F[k] += e->pressure * e->by_volume[k];
  e->memory_end[zp_law(model, &zp_term_pouch)->at] = e->pressure;
}

double zp_pouch_predicted(const ZpModel *model, const ZpSpan *span, const ZpEval *e, const double *moved,
                          double fraction) {
  const ZpNodes to = zp_nodes(model, moved);
  const double *x = zp_nodes(model, span->end).x, *h = e->plates.gap;
  double change = 0; /* both terms of a node cancel but for a small part */
  for (size_t i = 0; i < model->nodes; i++)
    change += zp_pouch_by_x(&model->pouch, model->nodes, h, i) * to.x[i] -
              zp_pouch_by_h(&model->pouch, model->nodes, x, i) * to.y[i];
  return e->pressure - fraction * span->modulus * change / model->pouch.volume;
}

void zp_pouch_refill(const ZpModel *model, double *q) {
  if (!acts(model)) return;
  const double *x = zp_nodes(model, q).x;
  double *y = zp_forces(model, q).y, V = -zp_pouch_volume(&model->pouch, model->nodes, x, y);
  for (size_t i = 0; i < model->nodes; i++)
    y[i] *= model->pouch.volume / V;
}

/* Add minus a pressure times the second derivatives of the volume. */
static void bend(const ZpModel *model, double pressure, const ZpAssembly *a, ZpBand *K) {
  const double value = 0.5 * pressure * model->pouch.w;
  for (size_t i = 0; i + 1 < model->nodes; i++) {
    const size_t x[] = {zp_x_of(i), zp_x_of(i + 1)}, y[] = {zp_y_of(i), zp_y_of(i + 1)};
    for (int m = 0; m < 4; m++) { /* V has (h_i + h_j) (x_j - x_i) / 2, and dh = -dy */
      zp_assemble_entry(a, x[m / 2], y[m % 2], m / 2 ? value : -value, K);
      zp_assemble_entry(a, y[m % 2], x[m / 2], m / 2 ? value : -value, K);
    }
  }
}

/* The pressure follows the volume at the end: a term of rank one. */
static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *a, ZpEval *e, ZpBand *K) {
  const double k = span->modulus / model->pouch.volume, both = zp_span_is_still(span) ? 1 : 0.5;
  double *u = zp_band_term(K, K->u, K->rank - 1), *v = zp_band_term(K, K->v, K->rank - 1);
  bend(model, both * span->pressure, a, K);
  for (size_t i = 0; i < model->nodes; i++) {
    const size_t x = zp_x_of(i), y = zp_y_of(i);
    const ZpForces by = zp_forces(model, e->by_volume);
    zp_assembly_add_place(a, x, k * by.x[i], u);
    zp_assembly_add_place(a, y, k * by.y[i], u);
    zp_assembly_add_place(a, x, zp_pouch_by_x(&model->pouch, model->nodes, e->plates.gap, i), v);
    zp_assembly_add_place(a, y, -zp_pouch_by_h(&model->pouch, model->nodes, zp_nodes(model, span->end).x, i), v);
  }
}

static void show(const ZpModel *model, const ZpSpan *now, ZpEval *e, double *row) {
  (void)e;
  row[PRESSURE] += now->memory ? zp_memory_pressure(model, now->memory) : now->pressure;
  row[STRAIN] += zp_pouch_strain(model, zp_stroke(model, zp_nodes(model, now->end)));
}

/* Its volume is fixed: it does no work, and stores nothing. */
const ZpTerm zp_term_pouch = {.name = "pouch",
                              .row = {&zp_row_pressure, &zp_row_strain},
                              .acts = acts,
                              .state = state,
                              .state_at_rest = true,
                              .force = force,
                              .stiffness = stiffness,
                              .now = show};
