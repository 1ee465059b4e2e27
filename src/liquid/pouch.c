#include "liquid/pouch.h"

#include <math.h>
#include <stdbool.h>

#include "math/elementary.h"

static const double turn = 2 * zp_pi;

/* Area between an arc of length 1 and its mirror image; of flat arcs as a series, where the difference is rounding. */
static double area_of(double a) {
  static const double flat = 0.05;
  double a2 = a * a;
  if (a < flat) return a / 3 * (1 - a2 / 5 * (1 - 2 * a2 / 21));
  return (a - zp_sine_of(a / turn) * zp_cosine_of(a / turn)) / (2 * a2);
}

double zp_pouch_modulus_of_step(const ZpPouchParams *p, double h) {
  static const double above = 1e3;
  double area = p->w * p->length, inertia = area > 0 ? p->mass * p->volume / (area * area) : 0;
  return fmax(zp_pouch_modulus, above * inertia / (h * h));
}

double zp_pouch_angle(double length, double area) {
  enum { HALVINGS = 60 };
  double low = 0, high = zp_pi / 2, wanted = area / (length * length);
  for (int k = 0; k < HALVINGS; k++) {
    double middle = 0.5 * (low + high);
    if (area_of(middle) < wanted)
      low = middle;
    else
      high = middle;
  }
  return 0.5 * (low + high);
}

double zp_pouch_chord(double length, double a) {
  return a > 0 ? length * zp_sine_of(a / turn) / a : length;
}

void zp_pouch_place(const ZpPouchParams *p, double zipped, double s, double *x, double *h) {
  double length = p->length - zipped, a = zp_pouch_angle(length, 2 * p->volume / p->w);
  double R = length / (2 * a), at = 2 * a * (s - zipped) / length - a;
  bool flat = s <= zipped;
  *x = flat ? s : zipped + R * (zp_sine_of(a / turn) + zp_sine_of(at / turn));
  *h = flat ? 0 : R * (zp_cosine_of(at / turn) - zp_cosine_of(a / turn));
}

double zp_pouch_volume(const ZpPouchParams *p, size_t n, const double *x, const double *h) {
  double area = 0;
  for (size_t i = 0; i + 1 < n; i++)
    area += 0.5 * (h[i] + h[i + 1]) * (x[i + 1] - x[i]);
  return p->w * area;
}

double zp_pouch_volume_of_chords(const ZpPouchParams *p, size_t n) {
  double area = 0, x[2] = {0, 0}, h[2] = {0, 0};
  for (size_t i = 1; i < n; i++) {
    x[0] = x[1], h[0] = h[1];
    zp_pouch_place(p, 0, p->length * (double)i / (double)(n - 1), &x[1], &h[1]);
    area += 0.5 * (h[0] + h[1]) * (x[1] - x[0]);
  }
  return p->w * area;
}

double zp_pouch_by_x(const ZpPouchParams *p, size_t n, const double *h, size_t i) {
  double left = i > 0 ? h[i - 1] + h[i] : 0, right = i + 1 < n ? h[i] + h[i + 1] : 0;
  return 0.5 * p->w * (left - right);
}

double zp_pouch_by_h(const ZpPouchParams *p, size_t n, const double *x, size_t i) {
  return 0.5 * p->w * (x[i + 1 < n ? i + 1 : i] - x[i > 0 ? i - 1 : i]);
}
