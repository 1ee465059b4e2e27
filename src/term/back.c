/* The electrode behind a plate, of the voltage of the one in front: it attracts the plate by the plates law, eq.
 * (37.3), and the film between both hinders the plate by its viscosity, eq. (37.6). Lengths of faces are those of the
 * front. */
#include <math.h>

#include "def/device.h"
#include "term/term.h"

enum { STORED, CHARGING, ACROSS };

static bool acts(const ZpModel *model) {
  return model->field && zp_def_has(&model->def, ZP_DEVICE_RIGID) && !isnan(model->def.plate.back_gap);
}

/* The gap behind the plate where that in front of it is `gap`, m. */
static double behind(const ZpModel *model, double gap) {
  const ZpActuatorDef *def = &model->def;
  return def->plate.gap + def->plate.back_gap - gap;
}

/* Gaps behind a station at the start and at the end of a span, m. */
typedef struct Way {
  double b0, b1;
} Way;

static Way way_of(const ZpModel *model, const ZpSpan *span, const ZpEval *e, size_t i) {
  const double *start = zp_span_is_still(span) ? e->plates.gap : e->plates_start.gap;
  return (Way){behind(model, start[i]), behind(model, e->plates.gap[i])};
}

/* Of the film, against a change of the gap behind a station, N s/m: its thickness in the middle of the step is
 * foreseen, as in front. */
static double resistance(const ZpModel *model, const ZpSpan *span, const ZpEval *e, size_t i) {
  const ZpFilmParams *film = &model->film;
  double across = 0;
  if (!model->has_film || !(span->h > 0)) return 0;
  const double b0 = way_of(model, span, e, i).b0, foreseen = b0 - 0.5 * span->h * e->film.rate[i];
  const double H = zp_film_thickness(film, fmax(foreseen, 0.5 * b0));
  for (int k = 0; k < ZP_FILM_MODES; k++)
    across += film->kappa2[k] > 0 ? film->share[k] / film->kappa2[k] : 0;
  return 12 * zp_film_viscosity(film, H) * film->w * zp_film_length(film, i) * across / (H * H * H);
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  const ZpTopology *t = &model->topology;
  for (size_t i = t->platform.first; i <= t->platform.last; i++) {
    const Way way = way_of(model, span, e, i);
    double push = model->plates.flat_length * zp_plates_between(&model->plates, span->U0, span->U1, way.b0, way.b1).W;
    if (span->h > 0) push += resistance(model, span, e, i) * (way.b1 - way.b0) / span->h;
    zp_term_part(model, i, push, F);
  }
}

static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e, ZpBand *K) {
  const ZpTopology *t = &model->topology;
  for (size_t i = t->platform.first; i <= t->platform.last; i++) {
    const Way way = way_of(model, span, e, i);
    double slope =
        model->plates.flat_length * (zp_span_is_still(span)
                                         ? zp_plates_slope(&model->plates, span->U1, way.b1)
                                         : zp_plates_between(&model->plates, span->U0, span->U1, way.b0, way.b1).slope);
    if (span->h > 0) slope += resistance(model, span, e, i) / span->h;
    zp_assemble_heights(assembly, i, slope, slope, -slope, K);
  }
}

static void electric(const ZpModel *model, const ZpSpan *span, const ZpEval *e, ZpSpanEnd at, double U,
                     ZpElectric *sum) {
  const ZpActuatorDef *def = &model->def;
  const ZpPlatesParams *p = &model->plates;
  const ZpTopology *t = &model->topology;
  for (size_t i = t->platform.first; i <= t->platform.last; i++) {
    const Way way = way_of(model, span, e, i);
    const double b = at == ZP_SPAN_START ? way.b0 : way.b1;
    const ZpPlatesLaw law = zp_plates_law(p, U, b);
    sum->force -= p->flat_length * law.W;
    sum->charge += p->flat_length * law.q;
    sum->potential += p->flat_length * law.P;
    sum->capacitance +=
        ZP_EPS0 * def->medium.permittivity * def->ribbon.width * p->flat_length * zp_plates_inverse_gap(p, b);
  }
}

/* The law at the end is half of the mean over a step. */
static void by_voltage(const ZpModel *model, const ZpSpan *span, ZpEval *e, ZpByVoltage *sum) {
  const ZpPlatesParams *p = &model->plates;
  const ZpTopology *t = &model->topology;
  for (size_t i = t->platform.first; i <= t->platform.last; i++) {
    const Way way = way_of(model, span, e, i);
    const double at_end = 2 * p->flat_length * zp_plates_between_by_voltage(p, span->U1, way.b1, way.b1).W;
    if (zp_span_is_still(span)) {
      zp_term_part(model, i, at_end, sum->force);
      continue;
    }
    zp_term_part(model, i, p->flat_length * zp_plates_between_by_voltage(p, span->U1, way.b0, way.b1).W, sum->force);
    zp_term_part(model, i, at_end, sum->charge);
    sum->capacitance += p->flat_length * zp_plates_capacitance(p, span->U1, way.b1);
  }
}

static void loss(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *row) {
  const ZpTopology *t = &model->topology;
  for (size_t i = t->platform.first; i <= t->platform.last; i++) {
    const Way way = way_of(model, span, e, i);
    const double moved = way.b1 - way.b0;
    row[ACROSS] += resistance(model, span, e, i) * moved * moved / span->h;
  }
}

/* Rows of the field are filled for all electric terms together. */
const ZpTerm zp_term_back = {
    .name = "back",
    .row = {[STORED] = &zp_row_field_energy, [CHARGING] = &zp_row_charging_loss, [ACROSS] = &zp_row_film_across_loss},
    .acts = acts,
    .force = force,
    .stiffness = stiffness,
    .electric = electric,
    .by_voltage = by_voltage,
    .loss = loss};
