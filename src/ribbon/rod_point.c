#include "ribbon/rod_point.h"

#include <stdbool.h>

/* Of two joints that bend together: shares of both, the length that it stands for over l, and the share of the edge at
 * the held slope in its strain. */
typedef struct Place {
  double held, next, length, near;
} Place;

static const Place places[ZP_ROD_END_POINTS] = {{144.0 / 47, -12.0 / 47, 3.0 / 12, 1},
                                                {-12.0 / 47, 48.0 / 47, 11.0 / 12, 5.0 / 11},
                                                {66.0 / 47, 18.0 / 47, 4.0 / 12, 1}};

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

static double side_of(const ZpRodParams *p, size_t joint) {
  return p->side[joint % p->ribbons];
}

static ZpRodPoint point_of_end(const ZpRodParams *p, size_t end, const Place *place) {
  const ZpRodEnd *of = &p->end[end];
  int near = of->near > of->far; /* its place among both edges */
  ZpRodPoint point = {.length = place->length * p->cell,
                      .joints = 2,
                      .joint = {of->held, of->next},
                      .share = {side_of(p, of->held) * place->held, side_of(p, of->held) * place->next},
                      .end = end,
                      .edges = 2};
  point.edge[near] = of->near, point.part[near] = place->near;
  point.edge[!near] = of->far, point.part[!near] = 1 - place->near;
  return point;
}

/* The joint at an end of a platform that turns bends over half an edge only. */
static bool is_beside_platform(const ZpRodParams *p, size_t j) {
  size_t station = j / p->ribbons;
  return p->lower_turns && j % p->ribbons == 1 && (station == p->rigid || station == p->rigid_end);
}

/* Is an edge of the ribbon alone, and not of a platform? */
static bool stretches(const ZpRodParams *p, size_t edge) {
  size_t station = edge / p->ribbons;
  return station < p->rigid || station >= p->rigid_end;
}

/* The edges beside joint j, with equal parts of its strain => how many halves of edges these are. */
static int find_edges(const ZpRodParams *p, size_t j, ZpRodPoint *point) {
  const size_t s = p->ribbons, last = p->nodes - 1;
  int count = 0;
  point->edges = 0;
  if (j >= s) point->edge[point->edges++] = j - s;
  if (j / s < last) point->edge[point->edges++] = j;
  for (int k = 0; k < point->edges; k++)
    count += stretches(p, point->edge[k]);
  for (int k = 0; k < point->edges && count > 0; k++)
    point->part[k] = stretches(p, point->edge[k]) ? 1.0 / count : 0;
  return count;
}

ZpRodPoint zp_rod_point(const ZpRodParams *p, size_t i) {
  size_t joints = joint_count(p);
  if (i >= joints) {
    size_t k = i - joints;
    return point_of_end(p, k / ZP_ROD_END_POINTS, &places[k % ZP_ROD_END_POINTS]);
  }
  if (zp_rod_point_at(p, i) != i) return (ZpRodPoint){.joints = 1, .joint = {i, i}};
  double edges = is_beside_platform(p, i) ? 0.5 : 1;
  ZpRodPoint point = {.joints = 1, .joint = {i, i}, .share = {p->B[i] > 0 ? side_of(p, i) / edges : 0, 0}};
  int halves = find_edges(p, i, &point);
  point.length = 0.5 * halves * p->cell;
  return point;
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

double zp_rod_point_strain(const ZpRodParams *p, const ZpRodPoint *point, const ZpRodEval *e) {
  double sum = 0;
  for (int c = 0; c < point->edges; c++)
    if (point->part[c] > 0) sum += point->part[c] * e->T[point->edge[c]] / p->S[point->edge[c]];
  return sum / p->cell;
}

/* Joint j loses dU/dk, and of its stiffness what that does as the joint turns. */
static void take_moment(const ZpRodEval *e1, size_t j, double by_k, ZpRodStep *s) {
  double half = e1->half[j], q = 1 + half * half;
  s->M[j] -= by_k * s->slope[j];
  s->stiffness[j] -= by_k * half * (q - 1 / q) * (1.0 / 3);
}

void zp_rod_point_take(const ZpRodParams *p, const ZpRodPoint *point, const ZpSectionForce *force, const ZpRodEval *e1,
                       ZpRodStep *s) {
  double part = point->length / p->cell, by_k = part * force->K / p->cell;
  for (int c = 0; c < point->joints; c++) {
    size_t j = point->joint[c];
    take_moment(e1, j, part * point->share[c] * force->M, s);
    s->stiffness[j] -= point->share[c] * point->share[c] * by_k * s->slope[j] * s->slope[j];
  }
  for (int c = 0; c < point->edges && force->N != 0; c++)
    s->T[point->edge[c]] -= part * point->part[c] * force->N;
  if (point->joints == 2)
    s->across[point->end] -=
        point->share[0] * point->share[1] * by_k * s->slope[point->joint[0]] * s->slope[point->joint[1]];
}

/* Derivatives of a point's strain and curvature, times l, by an edge. */
typedef struct ByEdge {
  double strain[2], curvature[2];
} ByEdge;

static ByEdge by_edge(const ZpRodParams *p, const ZpRodPoint *point, int which, const ZpRodStep *s) {
  const size_t edge = point->edge[which];
  double turns = 0; /* with the joint at its left end, against that at its right end */
  for (int c = 0; c < point->joints; c++) {
    const size_t j = point->joint[c];
    const int way = (edge == j) - (edge + p->ribbons == j);
    turns += way * point->share[c] * s->slope[j];
  }
  return (ByEdge){{point->part[which] * s->tx[edge], point->part[which] * s->ty[edge]},
                  {turns * s->gx[edge], turns * s->gy[edge]}};
}

ZpBent zp_rod_point_change(const ZpRodParams *p, const ZpRodPoint *point, const ZpRodStep *s, const double *x,
                           const double *y) {
  ZpBent sum = {0, 0};
  for (int k = 0; k < point->edges; k++) {
    const size_t left = point->edge[k], right = left + p->ribbons;
    const double along = x[right] - x[left], up = y[right] - y[left];
    const ByEdge by = by_edge(p, point, k, s);
    sum.curvature += (by.curvature[0] * along + by.curvature[1] * up) / p->cell;
    sum.strain += (by.strain[0] * along + by.strain[1] * up) / p->cell;
  }
  return sum;
}

void zp_rod_point_soften(const ZpRodParams *p, const ZpRodPoint *point, const ZpSectionForce *force, const ZpRodStep *s,
                         double (*D)[4]) {
  const double part = point->length / (p->cell * p->cell), both = part * force->both, axial = part * force->axial;
  ByEdge of[2];
  for (int k = 0; k < point->edges; k++)
    of[k] = by_edge(p, point, k, s);
  for (int row = 0; row < point->edges; row++)
    for (int column = 0; column < point->edges; column++)
      for (int c = 0; c < 4; c++) {
        const int x = c / 2, y = c % 2;
        D[3 * point->edge[row] + (size_t)(1 + column - row)][c] -=
            axial * of[row].strain[x] * of[column].strain[y] +
            both * (of[row].strain[x] * of[column].curvature[y] + of[row].curvature[x] * of[column].strain[y]);
      }
}
