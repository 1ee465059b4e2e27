#include "system/friction.h"

#include <math.h>

double zp_friction_bound(double friction, double gap) {
  return friction * fmax(-gap, 0);
}

/* Where the gap is 0, as a share of the span. */
static double crossing(const ZpRub *rub) {
  return rub->gap[0] / (rub->gap[0] - rub->gap[1]);
}

/* The part of the span in which the faces push each other, and the strains that friction bears at its ends. */
typedef struct Touch {
  double from, to, bound[2];
} Touch;

static Touch touch_of(const ZpRub *rub) {
  const double before = zp_friction_bound(rub->friction, rub->gap[0]),
               after = zp_friction_bound(rub->friction, rub->gap[1]);
  if (before == 0 && after == 0) return (Touch){0};
  return (Touch){rub->gap[0] > 0 ? crossing(rub) : 0, rub->gap[1] > 0 ? crossing(rub) : 1, {before, after}};
}

/* When the strain comes to its bound on the side to which it goes; at the end if it does not. `stuck`: where it would
 * end without a bound. */
static double slides_at(const Touch *touch, double side, double strain, double stuck) {
  const double over = side * stuck - touch->bound[1], under = fmin(side * strain - touch->bound[0], 0);
  return over > 0 ? touch->from + (touch->to - touch->from) * under / (under - over) : touch->to;
}

/* The strain grows with the way until it comes to the bound, and then is the bound. */
ZpFriction zp_friction(const ZpRub *rub) {
  const Touch touch = touch_of(rub);
  const double stuck = rub->strain + (touch.to - touch.from) * rub->moved, side = copysign(1, stuck);
  const double slides = slides_at(&touch, side, rub->strain, stuck);
  const double sticks = slides - touch.from, left = touch.to - slides;
  const double bound = rub->strain + sticks * rub->moved, end = left > 0 ? side * touch.bound[1] : stuck;
  const double sooner = touch.from > 0 ? touch.from / (rub->gap[0] - rub->gap[1]) : 0; /* contact begins later */
  const double deeper = left > 0 ? 0.5 * side * rub->friction * (touch.to * touch.to - slides * slides) : 0;
  return (ZpFriction){.mean = 0.5 * (sticks * (rub->strain + bound) + left * (bound + end)),
                      .end = end,
                      .by_moved = 0.5 * sticks * sticks,
                      .by_gap = -sticks * rub->moved * sooner - deeper,
                      .lost = 0.5 * (bound + end) * (left * rub->moved - (end - bound))};
}
