/* The paper's sequential zipping: pairs of facing nodes join one after the other, from the clip on. It says which rows
 * of pairs act (actuator/ties.h), which make them move as one.
 *
 * State: `front` z, the last joined pair, and `platform`, whether the platforms' faces have met.
 *
 *                 pair z+1 meets: z -> z+1                    z = N-1
 *      +-----+  ------------------------->  +-----------+  ----------->  closed
 *      | z=0 |                              | 0<z<N-1   |
 *      +-----+  <-------------------------  +-----------+  (the same from closed)
 *                 no voltage, and pair z is pulled apart: z -> z-1
 *
 *      platform: false -> true when pair N-1 meets before the front is there; back with no voltage, likewise.
 *
 * Invariants
 *   1. Pairs 0 .. z, and pair N-1 if `platform`, are joined: both nodes have the same velocity and
 *      acceleration, so their gap and their offset along x never change. The gap is 0 but for rounding; only
 *      after opening, where pairs behind the front are not watched, may one join with an overlap.
 *   2. Joining keeps the momentum of the pair and every position; it happens at the instant of the meeting,
 *      found inside the step. Kinetic energy is lost; how much is returned.
 *   3. While there is a voltage z never falls. Pair 0, the clip, is always joined.
 *   4. Only pair z+1 and the platform are looked at: ribbons may pass through each other elsewhere, a
 *      limit of the paper's model.
 *
 * Arrays hold both nodes of a pair as base/pair.h says.
 */
#ifndef ZP_PAPER_ZIP_H
#define ZP_PAPER_ZIP_H

#include <stdbool.h>
#include <stddef.h>

typedef struct ZpZipState {
  size_t front;  /* z */
  bool platform; /* the platforms' faces have met */
} ZpZipState;

/* Time until the next meeting if velocity changes by acceleration * step and position by the new velocity * step (eq.
 * (1) of the paper), at most `dt`; *pair becomes the pair that meets, otherwise it is unchanged. */
double zp_zip_next(const ZpZipState *state, size_t nodes, const double *y, const double *vy, const double *ay,
                   double dt, size_t *pair);

/* The state after pair i has met. */
ZpZipState zp_zip_after(ZpZipState state, size_t nodes, size_t i);

/* The state without voltage: the front (and the platform) opens where forces pull it apart; `ay` are the accelerations
 * of free nodes. */
ZpZipState zp_zip_open(ZpZipState state, size_t nodes, const double *ay);

#endif
