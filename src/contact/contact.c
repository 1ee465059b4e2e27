/* Letters of docs/theory.md, section 9: g gap, m; s = -g / delta where that is positive. The push per length is
 * p_c s^3, its stiffness 3 p_c s^2 / delta. */
#include "contact/contact.h"

#include <math.h>
#include <string.h>

#include "base/kernel.h"
#include "math/gauss.h"

double zp_contact_range(double insulation) {
  static const double usual = 5e-7, of = 260e-6, least = 1e-9; /* m */
  return fmax(usual * (insulation / of), least);
}

void zp_contact_reserve(const ZpContactParams *p, ZpContactEval *e, ZpArena *arena) {
  e->push = zp_arena_take(arena, p->nodes);
  e->own = zp_arena_take(arena, p->nodes);
  e->next = zp_arena_take(arena, p->nodes);
  e->stiffness = zp_arena_take(arena, p->nodes);
  e->damper = zp_arena_take(arena, p->nodes);
}

/* Push over p_c as faces go from x0 to x1, -g / delta, of which what is positive is the depth s: eq. (18.11), and its
 * derivative by x1. */
typedef struct Mean {
  double push, slope;
} Mean;

static inline Mean mean_of(double x0, double x1, double late) {
  double s0 = x0 > 0 ? x0 : 0, s1 = x1 > 0 ? x1 : 0, q1 = s1 * s1;
  double push = 0.25 * (s0 + s1) * (s0 * s0 + q1), slope = 0.25 * (s0 * s0 + 2 * s0 * s1 + 3 * q1);
  if (x0 * x1 < 0) {
    double way = x1 - x0, share = (s1 - s0) / way;
    slope = x1 > 0 ? 0.25 * q1 * share * (4 - share) : -push * share / way;
    push *= share;
  }
  return (Mean){push + late * (q1 * s1 - push), slope + late * (3 * q1 - slope)};
}

static void add_element(const ZpContactParams *p, const ZpContactSpan *span, size_t i, const ZpContactEval *e) {
  const double *share = zp_gauss_shares(&p->level, i), *start = span->start, *end = span->end;
  for (int q = 0; q < GAUSS; q++) {
    double r = share[q], l = 1 - r, weight = gauss_weight[q] * p->l * p->push;
    double x0 = -(l * start[i] + r * start[i + 1]) / p->depth, x1 = -(l * end[i] + r * end[i + 1]) / p->depth;
    Mean m = mean_of(x0, x1, span->late);
    double f = weight * m.push, c = weight * m.slope / p->depth;
    e->push[i] += l * f;
    e->push[i + 1] += r * f;
    e->stiffness[i] += 2 * l * c;
    e->stiffness[i + 1] += 2 * r * c;
    e->own[i] += l * l * c;
    e->own[i + 1] += r * r * c;
    e->next[i] += l * r * c;
  }
}

/* Is element i the platform? */
static bool is_rigid(const ZpContactParams *p, size_t i) {
  return i >= p->platform && i < p->platform_end;
}

static void add_platform(const ZpContactParams *p, const ZpContactSpan *span, size_t i, const ZpContactEval *e) {
  Mean m = mean_of((p->stop - span->start[i]) / p->depth, (p->stop - span->end[i]) / p->depth, span->late);
  double weight = p->flat_length * p->push, c = weight * m.slope / p->depth;
  e->push[i] += weight * m.push;
  e->own[i] += c;
  e->stiffness[i] += 2 * c;
}

static bool touches(const double *gap, size_t i) {
  return gap[i] < 0 || gap[i + 1] < 0;
}

/* -- several elements at once -------------------------------------------------------------------------- */

/* Contributions of some elements to their left and right stations. */
typedef struct Block {
  double push[2][ZP_LANES], own[2][ZP_LANES], next[ZP_LANES], stiffness[2][ZP_LANES];
} Block;

/* In equilibrium the mean at a point is s^3, and half of its slope 3 s^2 / 2. */
ZP_KERNEL static void block_at_rest(const ZpContactParams *p, const double *restrict gap, size_t count,
                                    Block *restrict of) {
  double per_depth = 1 / p->depth, l = p->l * p->push;
  ZP_SIMD
  for (size_t k = 0; k < count; k++) {
    double push0 = 0, push1 = 0, own0 = 0, own1 = 0, next = 0, all0 = 0, all1 = 0;
    for (int q = 0; q < GAUSS; q++) {
      double right = gauss_at[q], left = 1 - right, x = -(left * gap[k] + right * gap[k + 1]) * per_depth;
      double s = x > 0 ? x : 0, weight = gauss_weight[q] * l, f = weight * (s * s * s);
      double c = weight * (1.5 * (s * s)) * per_depth;
      push0 += left * f, push1 += right * f;
      own0 += left * left * c, own1 += right * right * c, next += left * right * c;
      all0 += 2 * left * c, all1 += 2 * right * c;
    }
    of->push[0][k] = push0, of->push[1][k] = push1, of->own[0][k] = own0, of->own[1][k] = own1;
    of->next[k] = next, of->stiffness[0][k] = all0, of->stiffness[1][k] = all1;
  }
}

/* As mean_of, without branches. */
ZP_KERNEL static void block_over_span(const ZpContactParams *p, const ZpContactSpan *span, size_t first, size_t count,
                                      Block *restrict of) {
  const double *start = span->start + first, *end = span->end + first;
  double per_depth = 1 / p->depth, l = p->l * p->push, late = span->late;
  ZP_SIMD
  for (size_t k = 0; k < count; k++) {
    double push0 = 0, push1 = 0, own0 = 0, own1 = 0, next = 0, all0 = 0, all1 = 0;
    for (int q = 0; q < GAUSS; q++) {
      double right = gauss_at[q], left = 1 - right;
      double x0 = -(left * start[k] + right * start[k + 1]) * per_depth,
             x1 = -(left * end[k] + right * end[k + 1]) * per_depth;
      double s0 = x0 > 0 ? x0 : 0, s1 = x1 > 0 ? x1 : 0, q1 = s1 * s1, way = x1 - x0;
      double mean = 0.25 * (s0 + s1) * (s0 * s0 + q1), rise = 0.25 * (s0 * s0 + 2 * s0 * s1 + 3 * q1);
      bool crosses = x0 * x1 < 0;
      double inverse = 1 / (crosses ? way : 1), share = (s1 - s0) * inverse;
      double steep = x1 > 0 ? 0.25 * q1 * share * (4 - share) : -mean * share * inverse;
      rise = crosses ? steep : rise;
      mean = crosses ? mean * share : mean;
      double weight = gauss_weight[q] * l, f = weight * (mean + late * (q1 * s1 - mean));
      double c = weight * (rise + late * (3 * q1 - rise)) * per_depth;
      push0 += left * f, push1 += right * f;
      own0 += left * left * c, own1 += right * right * c, next += left * right * c;
      all0 += 2 * left * c, all1 += 2 * right * c;
    }
    of->push[0][k] = push0, of->push[1][k] = push1, of->own[0][k] = own0, of->own[1][k] = own1;
    of->next[k] = next, of->stiffness[0][k] = all0, of->stiffness[1][k] = all1;
  }
}

static void add_of_block(const Block *of, size_t k, size_t i, const ZpContactEval *e) {
  for (size_t end = 0; end < 2; end++) {
    e->push[i + end] += of->push[end][k];
    e->own[i + end] += of->own[end][k];
    e->stiffness[i + end] += of->stiffness[end][k];
  }
  e->next[i] += of->next[k];
}

static bool is_level(const ZpContactParams *p, size_t i) {
  for (size_t k = 0; k < p->level.count; k++)
    if (p->level.of[k].element == i) return true;
  return false;
}

static bool is_at_rest(const ZpContactSpan *span) {
  return span->start == span->end;
}

static bool meet(const ZpContactSpan *span, size_t i) {
  return touches(span->end, i) || touches(span->start, i);
}

static void add_elements(const ZpContactParams *p, const ZpContactSpan *span, const ZpContactEval *e) {
  size_t elements = p->nodes - 1;
  for (size_t first = 0; first < elements; first += ZP_LANES) {
    size_t count = elements - first < ZP_LANES ? elements - first : ZP_LANES;
    Block block;
    bool any = false;
    for (size_t k = 0; k < count; k++)
      any = any || meet(span, first + k);
    if (any && is_at_rest(span)) block_at_rest(p, span->end + first, count, &block);
    if (any && !is_at_rest(span)) block_over_span(p, span, first, count, &block);
    for (size_t k = 0; any && k < count; k++) {
      size_t i = first + k;
      if (!meet(span, i) || is_rigid(p, i)) continue;
      if (is_level(p, i))
        add_element(p, span, i, e);
      else
        add_of_block(&block, k, i, e);
    }
  }
}

/* -- all -------------------------------------------------------------------------------------------- */

/* Eq. (9.6), and its derivative. */
static void add_damper(const ZpContactParams *p, const ZpContactSpan *span, size_t i, const ZpContactEval *e) {
  double s0 = fmax((p->stop - span->start[i]) / p->depth, 0), s1 = fmax((p->stop - span->end[i]) / p->depth, 0),
         c = e->damper[i] * span->rate;
  e->push[i] += 0.5 * c * p->depth * (s1 * s1 - s0 * s0);
  e->own[i] += c * s1;
}

ZpContactSpan zp_contact_span(const ZpContactParams *p, const double *start, const double *end, double h) {
  if (!(h > 0)) return (ZpContactSpan){start, end, 0, 0};
  return (ZpContactSpan){start, end, h / (h + p->settling), 1 / h};
}

/* Length of the faces that belong to station i, m. */
static double length_of(const ZpContactParams *p, size_t i) {
  bool left = i > 0 && !is_rigid(p, i - 1), right = i + 1 < p->nodes && !is_rigid(p, i);
  bool flat = i >= p->platform && i <= p->platform_end;
  return 0.5 * p->l * (left + right) + (flat ? p->flat_length : 0);
}

/* k_c of station i at s = 1, N/m. */
static double layers_at(const ZpContactParams *p, size_t i) {
  return 3 * p->push * length_of(p, i) / p->depth;
}

void zp_contact_damp(const ZpContactParams *p, size_t i, double reduced_mass, const ZpContactEval *e) {
  e->damper[i] = ZP_FACES_LOSS_FACTOR * sqrt(layers_at(p, i) * reduced_mass);
}

void zp_contact_eval(const ZpContactParams *p, const ZpContactSpan *span, const ZpContactEval *e) {
  memset(e->push, 0, p->nodes * sizeof *e->push);
  memset(e->own, 0, p->nodes * sizeof *e->own);
  memset(e->next, 0, p->nodes * sizeof *e->next);
  memset(e->stiffness, 0, p->nodes * sizeof *e->stiffness);
  add_elements(p, span, e);
  for (size_t i = p->platform; i <= p->platform_end; i++)
    add_platform(p, span, i, e);
  for (size_t i = 0; i < p->nodes && span->rate > 0; i++)
    add_damper(p, span, i, e);
}

double zp_contact_kept(const ZpContactEval *e, size_t i, double reduced_mass, double dt) {
  return 1 / (1 + ZP_FACES_LOSS_FACTOR * dt * sqrt(e->stiffness[i] / reduced_mass));
}

double zp_contact_kept_at(const ZpContactParams *p, double gap, size_t i, double reduced_mass, double dt) {
  double s = fmax((p->stop - gap) / p->depth, 0);
  return 1 / (1 + ZP_FACES_LOSS_FACTOR * dt * s * sqrt(layers_at(p, i) / reduced_mass));
}

size_t zp_contact_front(const ZpContactParams *p, const double *gap) {
  size_t front = 0;
  while (front < p->platform && gap[front + 1] < p->range)
    front++;
  return front;
}

bool zp_contact_closed(const ZpContactParams *p, const double *gap) {
  return zp_contact_front(p, gap) == p->platform && gap[p->platform] - p->stop < p->range;
}
