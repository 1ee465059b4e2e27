#include "sim/still.h"

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
  for (double cell = fmax(floor(from), last - ZP_STILL_CELLS) + 1; cell <= last; cell++) {
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
  for (double cell = floor(now) - 1; cell > oldest; cell--) {
    least = fmin(least, still->least[place_of(cell)]);
    most = fmax(most, still->most[place_of(cell)]);
  }
  const double stays = 1 - (back - oldest);
  const double below = least - still->least[place_of(oldest)], above = still->most[place_of(oldest)] - most;
  return most - least + stays * (fmax(below, 0) + fmax(above, 0));
}
