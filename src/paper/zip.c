#include "paper/zip.h"

#include <math.h>

#include "base/pair.h"

/* First s in [0, dt] at which g + w s + c s^2 <= 0 and decreases, or dt. */
static double first_meeting(double g, double w, double c, double dt) {
  bool touching = g <= 0;
  if (touching && (w < 0 || (w == 0 && c < 0))) return 0;
  if (g + dt * (fmin(w, 0) + dt * fmin(c, 0)) > 0) return dt; /* too far for this step: the usual case */
  double discriminant = w * w - 4 * c * g;
  if (discriminant < 0) return dt;
  double q = -0.5 * (w + copysign(sqrt(discriminant), w));
  double first = g / q, second = q / c; /* both may be infinite, negative or 0 / 0: no meeting */
  double s = dt;
  if (first >= 0 && first < s && !touching) s = first; /* a pair that opens from contact has this root */
  if (second > 0 && second < s) s = second;
  return s;
}

static double meeting(size_t i, const double *y, const double *vy, const double *ay, double dt) {
  return first_meeting(zp_apart(y, i), zp_apart(vy, i), zp_apart(ay, i), dt);
}

double zp_zip_next(const ZpZipState *state, size_t nodes, const double *y, const double *vy, const double *ay,
                   double dt, size_t *pair) {
  size_t end = nodes - 1, next = state->front + 1;
  if (next < end) {
    double s = meeting(next, y, vy, ay, dt);
    if (s < dt) {
      dt = s;
      *pair = next;
    }
  }
  if (next <= end && !state->platform) {
    double s = meeting(end, y, vy, ay, dt);
    if (s < dt) {
      dt = s;
      *pair = end;
    }
  }
  return dt;
}

ZpZipState zp_zip_after(ZpZipState state, size_t nodes, size_t i) {
  size_t end = nodes - 1;
  if (i == end) state.platform = true;
  if (i == state.front + 1 && i < end) state.front = i;
  if (state.platform && state.front == end - 1) state.front = end;
  return state;
}

static bool pulled_apart(size_t i, const double *ay) {
  return ay[zp_up(i)] > ay[zp_down(i)];
}

ZpZipState zp_zip_open(ZpZipState state, size_t nodes, const double *ay) {
  size_t end = nodes - 1;
  if (state.platform && pulled_apart(end, ay)) {
    state.platform = false;
    if (state.front == end) state.front = end - 1;
  }
  if (!state.platform && state.front > 0 && pulled_apart(state.front, ay)) state.front--;
  return state;
}
