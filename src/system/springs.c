#include "system/springs.h"

#include "base/memory.h"

/* The height of a body that moves is that of its leader, which a row may tie to no other one. */
static ZpBodyHeight height_of(const ZpNetwork *network, ZpAssembly *const assembly[], const ZpModel *first,
                              size_t body) {
  if (network->body[body].held) return (ZpBodyHeight){.held = true, .offset = network->body[body].y};
  const ZpSight at = zp_sight_of_body(first, body);
  const ZpAssembly *a = assembly[at.member];
  return (ZpBodyHeight){false, (size_t)a->equation[at.coordinate], at.sign * a->factor[at.coordinate],
                        at.origin + at.sign * a->offset[at.coordinate]};
}

bool zp_springs_create(const ZpModel *first, ZpAssembly *const assembly[], ZpSprings *springs) {
  const ZpNetwork *network = first->network;
  *springs = (ZpSprings){.first = first, .count = network->springs};
  if (!zp_is_network(first)) return true;
  springs->height = zp_calloc(network->bodies, sizeof *springs->height);
  for (size_t b = 0; springs->height && b < network->bodies; b++)
    springs->height[b] = height_of(network, assembly, first, b);
  return springs->height != NULL;
}

void zp_springs_destroy(ZpSprings *springs) {
  zp_free(springs->height);
  springs->height = NULL;
}

static double height_at(const ZpBodyHeight *h, const double *x) {
  return h->offset + (h->held ? 0 : h->factor * x[h->equation]);
}

static double length_at(const ZpSprings *s, const ZpLink *link, const double *x) {
  return height_at(&s->height[link->body[0]], x) - height_at(&s->height[link->body[1]], x);
}

/* Where it acts at one end of the span alone, the mean is over the part in which it acts. */
ZpPull zp_link_pull(const ZpLink *link, double before, double after, bool still) {
  const double s0 = zp_link_deformed(link, before), s1 = zp_link_deformed(link, after), longer = after - before;
  const bool even = (s0 != 0) == (s1 != 0) || longer == 0, acts = zp_link_acts(link, after);
  const double mean = even ? 0.5 * (s0 + s1) : 0.5 * (s1 * s1 - s0 * s0) / longer;
  const double slope = still ? acts : even ? 0.5 * acts : (s1 - mean) / longer;
  return (ZpPull){link->stiffness * mean, link->stiffness * slope};
}

static ZpPull pull_of(const ZpSprings *s, const ZpLink *link, const double *start, const double *end, bool still) {
  return zp_link_pull(link, length_at(s, link, start), length_at(s, link, end), still);
}

void zp_springs_add_force(const ZpSprings *s, double share, const double *start, const double *end, double *f) {
  for (size_t k = 0; k < s->count; k++) {
    const ZpLink *link = &s->first->network->spring[k];
    const double pull = share * pull_of(s, link, start, end, true).mean / s->first->parts;
    for (size_t e = 0; e < 2; e++) {
      const ZpBodyHeight *h = &s->height[link->body[e]];
      if (!h->held) f[h->equation] += (e == 0 ? -pull : pull) * h->factor;
    }
  }
}

void zp_springs_add_stiffness(const ZpSprings *s, double share, const double *start, const double *end, bool still,
                              size_t inner, ZpSparse *D) {
  for (size_t k = 0; k < s->count; k++) {
    const ZpLink *link = &s->first->network->spring[k];
    const double slope = share * pull_of(s, link, start, end, still).slope / s->first->parts;
    for (size_t e = 0; e < 4; e++) {
      const ZpBodyHeight *row = &s->height[link->body[e / 2]], *column = &s->height[link->body[e % 2]];
      if (row->held || column->held) continue;
      const double sign = e / 2 == e % 2 ? 1 : -1;
      *zp_sparse_at(D, row->equation - inner, column->equation - inner) += sign * slope * row->factor * column->factor;
    }
  }
}

void zp_springs_add_push(const ZpSprings *s, const double *push, double *f) {
  for (size_t b = 0; b < s->first->network->bodies; b++) {
    const ZpBodyHeight *h = &s->height[b];
    if (!h->held) f[h->equation] += h->factor * push[b] / s->first->parts;
  }
}

double zp_springs_height(const ZpSprings *s, size_t body, const double *at) {
  return height_at(&s->height[body], at);
}

double zp_springs_energy(const ZpSprings *s, const double *at) {
  double sum = 0;
  for (size_t k = 0; k < s->count; k++) {
    const ZpLink *link = &s->first->network->spring[k];
    sum += zp_link_energy(link, length_at(s, link, at)) / s->first->parts;
  }
  return sum;
}
