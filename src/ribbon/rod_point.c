#include "ribbon/rod_point.h"

#include <stdbool.h>

/* Of two joints that bend together: shares of both, and the length that it stands for over l. */
typedef struct Place {
  double held, next, length;
} Place;

static const Place places[ZP_ROD_END_POINTS] = {
    {144.0 / 47, -12.0 / 47, 3.0 / 12}, {-12.0 / 47, 48.0 / 47, 11.0 / 12}, {66.0 / 47, 18.0 / 47, 4.0 / 12}};

static size_t joint_count(const ZpRodParams *p) {
  return p->ribbons * p->nodes;
}

size_t zp_rod_point_count(const ZpRodParams *p) {
  return joint_count(p) + ZP_ROD_END_POINTS * p->ends;
}

size_t zp_rod_point_at(const ZpRodParams *p, size_t j) {
  for (size_t i = 0; i < p->ends; i++) {
    size_t first = joint_count(p) + ZP_ROD_END_POINTS * i;
    if (p->end[i].held == j) return first;
    if (p->end[i].next == j) return first + 1;
  }
  return j;
}

static ZpRodPoint point_of_end(const ZpRodParams *p, size_t end, const Place *place) {
  return (ZpRodPoint){.length = place->length * p->cell,
                      .joints = 2,
                      .joint = {p->end[end].held, p->end[end].next},
                      .share = {place->held, place->next},
                      .end = end};
}

/* The joint at an end of a platform that turns bends over half an edge only. */
static bool is_beside_platform(const ZpRodParams *p, size_t j) {
  size_t station = j / p->ribbons;
  return p->lower_turns && j % p->ribbons == 1 && (station == p->rigid || station == p->rigid_end);
}

ZpRodPoint zp_rod_point(const ZpRodParams *p, size_t i) {
  size_t joints = joint_count(p);
  if (i >= joints) {
    size_t k = i - joints;
    return point_of_end(p, k / ZP_ROD_END_POINTS, &places[k % ZP_ROD_END_POINTS]);
  }
  bool bends = p->B[i] > 0 && zp_rod_point_at(p, i) == i;
  double edges = is_beside_platform(p, i) ? 0.5 : 1;
  return (ZpRodPoint){.length = bends ? edges * p->cell : 0, .joints = 1, .joint = {i, i}, .share = {1 / edges, 0}};
}

size_t zp_rod_point_ribbon(const ZpRodParams *p, const ZpRodPoint *point) {
  return point->joint[0] % p->ribbons;
}

double zp_rod_point_curvature(const ZpRodParams *p, const ZpRodPoint *point, const ZpRodEval *e) {
  double sum = 0;
  for (int c = 0; c < point->joints; c++)
    sum += point->share[c] * (e->k[point->joint[c]] - p->k0[point->joint[c]]);
  return sum / p->cell;
}

/* Joint j loses dU/dk, and of its stiffness what that does as the joint turns. */
static void take_moment(const ZpRodEval *e1, size_t j, double by_k, ZpRodStep *s) {
  double half = e1->half[j], q = 1 + half * half;
  s->M[j] -= by_k * s->slope[j];
  s->stiffness[j] -= by_k * half * (q - 1 / q) * (1.0 / 3);
}

void zp_rod_point_take(const ZpRodParams *p, const ZpRodPoint *point, double M, double K, const ZpRodEval *e1,
                       ZpRodStep *s) {
  double part = point->length / p->cell, by_k = part * K / p->cell;
  for (int c = 0; c < point->joints; c++) {
    size_t j = point->joint[c];
    take_moment(e1, j, part * point->share[c] * M, s);
    s->stiffness[j] -= point->share[c] * point->share[c] * by_k * s->slope[j] * s->slope[j];
  }
  if (point->joints == 2)
    s->across[point->end] -=
        point->share[0] * point->share[1] * by_k * s->slope[point->joint[0]] * s->slope[point->joint[1]];
}
