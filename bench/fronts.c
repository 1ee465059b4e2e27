/* How fast does a zipping front run? Speeds of steady fronts against the curvature ahead and the width, with the flow
 * along the film and across it, in time on a long ribbon: one row each, as CSV.
 *
 *   fronts      all rows
 *
 * Units: l = (EI' d^2 / (2 F))^(1/4), speed F d / (12 mu w l), gap d; K curvature far ahead over that of static
 * balance, 2 sqrt(F / EI'). docs/theory.md, section 22. */
#include <math.h>
#include <stdio.h>

#include "front.h"

/* A front that has run 20 l, followed over another 20 l => its speed, and the films 5 l and 10 l behind it. */
static bool run(double K, double width, double *speed, double film[2]) {
  enum { ONE_HALF = 200 };
  bool lateral = isfinite(width);
  double w = lateral ? width : 1, guess = 0.3 * (1 - K) * (1 + (lateral ? 6 / w : 0)), from = 0;
  Front *f = front_create(1, 1 / (12 * w), w, 0.19, lateral);
  bool found = f != NULL;
  f->F = f->d = 1;
  f->curvature = sqrt(2) * K;
  f->h = 0.1 / guess;
  front_open(f, false);
  front_lay(f, 0.4 * (1 - K), 25);
  for (int k = 0; found && k < 2 * ONE_HALF; k++) {
    if (k == ONE_HALF) from = front_place(f, 1);
    found = front_step(f);
  }
  double at = front_place(f, 1);
  *speed = (at - from) / (ONE_HALF * f->h);
  for (int k = 0; k < 2; k++)
    film[k] = f->g0[(size_t)((at - 5 * (k + 1)) / f->film.l)];
  front_destroy(f);
  return found;
}

int main(void) {
  static const double K[] = {0.3, 0.4, 0.5, 0.6, 0.7, 0.8}, width[] = {2, 3, 5, 10, 20, 50, INFINITY};
  puts("K,w_over_l,speed,film_5,film_10");
  for (size_t i = 0; i < sizeof K / sizeof K[0]; i++)
    for (size_t j = 0; j < sizeof width / sizeof width[0]; j++) {
      double speed, film[2];
      if (run(K[i], width[j], &speed, film)) printf("%g,%g,%.5g,%.5g,%.5g\n", K[i], width[j], speed, film[0], film[1]);
      fflush(stdout);
    }
  return 0;
}
