/* Letters of docs/theory.md, section 8. Curvatures are taken at joints, kappa = k / l, over the length l each; of two
 * that bend together, eq. (8.9), at three points, each a sum of both joints' k, which leave what is quadratic in it
 * exact. */
#include "ribbon/rod_curl.h"

#include <stdbool.h>

enum { POINTS = 3 };

/* Of two joints that bend together: the curvature at a point times l, and the length that it stands for over l. */
typedef struct Point {
  double held, next, length;
} Point;

static const Point points[POINTS] = {
    {144.0 / 47, -12.0 / 47, 3.0 / 12}, {-12.0 / 47, 48.0 / 47, 11.0 / 12}, {66.0 / 47, 18.0 / 47, 4.0 / 12}};

static bool curls(const ZpRodParams *p) {
  return p->curl[0].EI > 0 || p->curl[1].EI > 0;
}

/* Does joint j bend by itself? */
static bool is_alone(const ZpRodParams *p, size_t j) {
  for (size_t i = 0; i < p->ends; i++)
    if (p->end[i].held == j || p->end[i].next == j) return false;
  return p->B[j] > 0;
}

static size_t joint_count(const ZpRodParams *p) {
  return p->ribbons * p->nodes;
}

static const ZpCurl *curl_of(const ZpRodParams *p, size_t j) {
  return &p->curl[j % p->ribbons];
}

static double curvature_at(const Point *point, const ZpRodEnd *end, const ZpRodEval *e, double l) {
  return (point->held * e->k[end->held] + point->next * e->k[end->next]) / l;
}

double zp_rod_curl_energy(const ZpRodParams *p, const ZpRodEval *e) {
  double sum = 0, l = p->l[0];
  if (!curls(p)) return 0;
  for (size_t j = 0; j < joint_count(p); j++)
    if (is_alone(p, j)) sum += l * zp_curl_law(curl_of(p, j), e->k[j] / l).W;
  for (size_t i = 0; i < p->ends; i++)
    for (const Point *point = points; point < points + POINTS; point++)
      sum += point->length * l * zp_curl_law(curl_of(p, p->end[i].held), curvature_at(point, &p->end[i], e, l)).W;
  return sum;
}

/* Joint j loses dU/dk, and of its stiffness what that does as the joint turns. */
static void take_moment(const ZpRodEval *e1, size_t j, double by_k, ZpRodStep *s) {
  double half = e1->half[j], q = 1 + half * half;
  s->M[j] -= by_k * s->slope[j];
  s->stiffness[j] -= by_k * half * (q - 1 / q) * (1.0 / 3);
}

static void take_end(const ZpRodParams *p, const ZpRodEval *e0, const ZpRodEval *e1, size_t i, ZpRodStep *s) {
  const ZpRodEnd *end = &p->end[i];
  double l = p->l[0], held = s->slope[end->held], next = s->slope[end->next];
  for (const Point *point = points; point < points + POINTS; point++) {
    ZpCurlMean mean =
        zp_curl_mean(curl_of(p, end->held), curvature_at(point, end, e0, l), curvature_at(point, end, e1, l));
    double M = point->length * mean.M, K = point->length * mean.K / l;
    take_moment(e1, end->held, point->held * M, s);
    take_moment(e1, end->next, point->next * M, s);
    s->stiffness[end->held] -= point->held * point->held * K * held * held;
    s->stiffness[end->next] -= point->next * point->next * K * next * next;
    s->across[i] -= point->held * point->next * K * held * next;
  }
}

void zp_rod_curl_step(const ZpRodParams *p, const ZpRodEval *e0, const ZpRodEval *e1, ZpRodStep *s) {
  double l = p->l[0];
  if (!curls(p)) return;
  for (size_t j = 0; j < joint_count(p); j++) {
    if (!is_alone(p, j)) continue;
    ZpCurlMean mean = zp_curl_mean(curl_of(p, j), e0->k[j] / l, e1->k[j] / l);
    take_moment(e1, j, mean.M, s);
    s->stiffness[j] -= mean.K / l * s->slope[j] * s->slope[j];
  }
  for (size_t i = 0; i < p->ends; i++)
    take_end(p, e0, e1, i, s);
}
