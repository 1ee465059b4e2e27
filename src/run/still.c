#include "run/still.h"

#include <math.h>

/* The window is half a cell longer than a whole number of cells: when one begins, none ends at its other end. */
#define WINDOW (ZP_STILL_CELLS - 1.5)

/* Instants before the closing count as it. */
static double cells_since(double closed_from, double t) {
  return fmax(t - closed_from, 0) * (WINDOW / ZP_STILL_TIME);
}

static size_t place_of(double cell) {
  return (size_t)fmod(cell, ZP_STILL_CELLS);
}

static void set(ZpStill *still, double cell, double opening) {
  still->least[place_of(cell)] = still->most[place_of(cell)] = opening;
}

static void widen(ZpStill *still, double cell, double opening) {
  double *least = &still->least[place_of(cell)], *most = &still->most[place_of(cell)];
  *least = fmin(*least, opening);
  *most = fmax(*most, opening);
}

void zp_still_begin(ZpStill *still, double opening) {
  set(still, 0, opening);
}

void zp_still_follow(ZpStill *still, double closed_from, ZpOpeningAt start, ZpOpeningAt end) {
  const double from = cells_since(closed_from, start.t), to = cells_since(closed_from, end.t), last = floor(to);
  const int begun = (int)fmin(last - floor(from), ZP_STILL_CELLS);
  for (int k = begun - 1; k >= 0; k--) {
    const double cell = last - k;
    double between = start.opening + (end.opening - start.opening) * ((cell - from) / (to - from));
    widen(still, cell - 1, between);
    set(still, cell, between);
  }
  widen(still, last, end.opening);
}

double zp_still_range(const ZpStill *still, double closed_from, double t) {
  const double now = cells_since(closed_from, t), back = fmax(now - WINDOW, 0), oldest = floor(back);
  const size_t newest = place_of(now);
  double least = still->least[newest], most = still->most[newest];
  const int cells = (int)(floor(now) - oldest);
  for (int k = 1; k < cells; k++) {
    least = fmin(least, still->least[place_of(floor(now) - k)]);
    most = fmax(most, still->most[place_of(floor(now) - k)]);
  }
  const double stays = 1 - (back - oldest);
  const double below = least - still->least[place_of(oldest)], above = still->most[place_of(oldest)] - most;
  return most - least + stays * (fmax(below, 0) + fmax(above, 0));
}
