#include "rest/series_mass.h"

#include <string.h>

void zp_series_mass_carve(ZpSeriesMass *series, const ZpStatics *statics, ZpCarver *carver) {
  series->statics = statics;
  series->mass = zp_carve(carver, statics->n);
  series->vertical = zp_carve(carver, statics->n);
}

/* The height of a member's lower platform. */
static size_t load_of(const ZpRestMember *m) {
  return (size_t)m->assembly.equation[2 * zp_load_node(&m->model->topology) + 1];
}

/* A member moves relative to its upper platform, and with that platform, which moves by `way` => its momentum */
static double weigh_member(const ZpSeriesMass *series, size_t which, const double *u, double way, double *mu) {
  const ZpAssembly *a = &series->statics->member[which].assembly;
  double momentum = series->total[which] * way;
  for (size_t i = a->begin; i < a->end; i++) {
    momentum += series->vertical[i] * u[i];
    mu[i] = series->mass[i] * u[i] + series->vertical[i] * way;
  }
  return momentum;
}

static void weigh(const void *self, const double *u, double *mu) {
  const ZpSeriesMass *series = self;
  const ZpStatics *s = series->statics;
  double momentum[ZP_MOST_MEMBERS] = {0}, way = 0, below = 0;
  for (size_t k = 0; k < s->members; k++) {
    momentum[k] = weigh_member(series, k, u, way, mu);
    way += u[load_of(&s->member[k])];
  }
  for (size_t k = s->members; k-- > 0;) {
    mu[load_of(&s->member[k])] += below;
    below += momentum[k];
  }
}

void zp_series_mass_fill(ZpSeriesMass *series) {
  const ZpStatics *s = series->statics;
  zp_statics_masses(s, series->mass);
  for (size_t which = 0; which < s->members; which++) {
    const ZpRestMember *m = &s->member[which];
    series->total[which] = 0;
    for (size_t j = 0; j < m->model->count; j++) {
      int row = m->assembly.equation[2 * j + 1];
      if (row >= 0) series->vertical[row] = series->mass[row];
      series->total[which] += m->model->mass[j];
    }
  }
  series->inertia = (ZpInertia){weigh, series};
}
