/* The reference of `zipact bench`: the mechanics of the two ribbons of the paper in a straightforward form, particle by
 * particle, with a square root and a division for each link. No field, no contact, no step control. */
#include "plain_kernel.h"

#include <math.h>
#include <stdlib.h>

typedef struct Vector {
  double x, y;
} Vector;

typedef struct Particle {
  Vector p, v, f, u; /* u: direction of the link to the next particle */
} Particle;

static void spring_forces(Particle *ribbon, int nodes, const PlainKernel *k) {
  for (int i = 0; i < nodes; i++)
    ribbon[i].f = (Vector){0, -k->mass * k->gravity};
  for (int i = 0; i + 1 < nodes; i++) {
    Vector d = {ribbon[i + 1].p.x - ribbon[i].p.x, ribbon[i + 1].p.y - ribbon[i].p.y};
    double length = sqrt(d.x * d.x + d.y * d.y);
    ribbon[i].u = (Vector){d.x / length, d.y / length};
    double T = k->K_D * (length - k->l);
    Vector f = {T * ribbon[i].u.x, T * ribbon[i].u.y};
    ribbon[i].f.x += f.x, ribbon[i].f.y += f.y;
    ribbon[i + 1].f.x -= f.x, ribbon[i + 1].f.y -= f.y;
  }
}

static void shear_forces(Particle *ribbon, int nodes, const PlainKernel *k) {
  static const Vector horizontal = {1, 0};
  for (int i = 0; i + 1 < nodes; i++) {
    Vector d = {ribbon[i + 1].p.x - ribbon[i].p.x, ribbon[i + 1].p.y - ribbon[i].p.y};
    Vector frames[2] = {i > 0 ? ribbon[i - 1].u : horizontal, i + 2 < nodes ? ribbon[i + 1].u : horizontal};
    for (int side = 0; side < 2; side++) {
      double shear = k->K_S * (frames[side].x * d.y - frames[side].y * d.x);
      Vector f = {shear * frames[side].y, -shear * frames[side].x};
      ribbon[i + 1].f.x += f.x, ribbon[i + 1].f.y += f.y;
      ribbon[i].f.x -= f.x, ribbon[i].f.y -= f.y;
    }
  }
}

static void advance(Particle *ribbon, int nodes, const PlainKernel *k) {
  for (int i = 1; i + 1 < nodes; i++) {
    double speed = sqrt(ribbon[i].v.x * ribbon[i].v.x + ribbon[i].v.y * ribbon[i].v.y);
    ribbon[i].v.x += (ribbon[i].f.x - k->drag * speed * ribbon[i].v.x) / k->mass * k->dt;
    ribbon[i].v.y += (ribbon[i].f.y - k->drag * speed * ribbon[i].v.y) / k->mass * k->dt;
    ribbon[i].p.x += ribbon[i].v.x * k->dt;
    ribbon[i].p.y += ribbon[i].v.y * k->dt;
  }
}

double plain_kernel_run(const PlainKernel *k, int nodes, long steps) {
  Particle *ribbons = calloc(2 * (size_t)nodes, sizeof *ribbons);
  if (!ribbons) return NAN;
  for (int i = 0; i < 2 * nodes; i++)
    ribbons[i].p = (Vector){k->l * (i % nodes), 0};
  for (long step = 0; step < steps; step++)
    for (Particle *ribbon = ribbons; ribbon < ribbons + 2 * (size_t)nodes; ribbon += nodes) {
      spring_forces(ribbon, nodes, k);
      shear_forces(ribbon, nodes, k);
      advance(ribbon, nodes, k);
    }
  double height = ribbons[nodes / 2].p.y;
  free(ribbons);
  return height;
}
