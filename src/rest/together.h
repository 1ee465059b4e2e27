/* Actuators at rest that share one load, each in its own frame, so that the height of the load is an unknown of all:
 * two antagonists, the lower one upside down, whose openings sum up to the distance of the mounts (docs/theory.md,
 * section 31), or several side by side, whose openings are one (section 29). */
#ifndef ZP_REST_TOGETHER_H
#define ZP_REST_TOGETHER_H

#include "def/check.h"
#include "rest/rest.h"
#include "solve/fold.h"

typedef struct ZpTogether {
  size_t count;
  ZpRest of[ZP_MOST_MEMBERS]; /* of antagonists: the upper one, the lower one */
  ZpStaticSystem alone[ZP_MOST_MEMBERS];
  double distance;               /* of antagonists, m; 0 for members side by side */
  double *step[ZP_MOST_MEMBERS]; /* a step of all, split into one of each */
  ZpBranchSystem system;         /* of all, along the voltage of the first one */
  ZpBranch branch;
  ZpFold fold;                    /* limit points and events of the branch */
  double closed[ZP_MOST_MEMBERS]; /* openings below which each counts as closed, m; zp_together_start */
  void *memory;
} ZpTogether;

/* Fill `all` from the model of the first one; `carve` as in zp_rest_open. False if there is no memory. `all` must not
 * be moved, and must be closed, also if this fails. */
bool zp_together_open(ZpTogether *all, const ZpModel *model, void (*carve)(void *user, ZpCarver *carver), void *user);
void zp_together_close(ZpTogether *all);

/* Call `stop` now and then; has it returned true? */
void zp_together_watch(ZpTogether *all, bool (*stop)(void *caller), void *caller);
bool zp_together_stopped(const ZpTogether *all);

/* From states in which each is held at a possible place of the load to the stable equilibrium of all under the load,
 * without voltage. */
ZpNewtonInfo zp_together_hang(ZpTogether *all);

/* Then apply the voltage that the lower one has while the upper one has none. False if the branch ends before. */
bool zp_together_bias(ZpTogether *all);

/* Then follow the branch to a voltage of the first one, V; the stiffness is factored there. False if the branch ends
 * before. */
bool zp_together_raise(ZpTogether *all, double voltage);

/* From the present point, which is close, to the equilibrium at a voltage of the upper one, V. */
ZpNewtonInfo zp_together_settle(ZpTogether *all, double voltage);

/* Set the openings that count as closed, from the present openings, which must be those without voltage. */
void zp_together_start(ZpTogether *all);

/* Distance from counting as closed, m: of the nearer one of two antagonists; of the farthest one of those side by side.
 */
double zp_together_left(const ZpTogether *all);

/* From the present point, which is close, to a limit point of the voltage, or to where zp_together_left is 0 at a
 * voltage from `least` to `most`. False if there is none: the present point is then unchanged. */
bool zp_together_limit(ZpTogether *all);
bool zp_together_closing(ZpTogether *all, double least, double most);

/* Number of doubles in a copy of the present point; make the copy; return to it, with the stiffness factored. */
size_t zp_together_save_size(const ZpTogether *all);
void zp_together_save(ZpTogether *all, double *state);
void zp_together_go_to(ZpTogether *all, const double *state);

/* Start to follow the branch towards a growing voltage; then zp_branch_advance. */
bool zp_together_follow(ZpTogether *all);

/* Is the present equilibrium stable? The stiffness is then factored. */
bool zp_together_stable(ZpTogether *all);

/* Restoring force per displacement of the load at the present point, of the whole actuators, N/m. NAN if the stiffness
 * is singular. */
double zp_together_stiffness(ZpTogether *all);

/* Moving masses, by equations of all => mass [n], kg. */
void zp_together_masses(const ZpTogether *all, double *mass);

/* Split a step of all into one of each => all->step. */
void zp_together_part(const ZpTogether *all, const double *step);

/* Force with which one of them pulls the load up at the present point, N; not for antagonists. */
double zp_together_force(ZpTogether *all, size_t which);

#endif
