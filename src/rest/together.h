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
  double distance;               /* of antagonists, m; 0 of those that hang side by side */
  double *step[ZP_MOST_MEMBERS]; /* a step of all as one of each */
  ZpBranchSystem system;         /* of all, along the voltage of the first one */
  ZpBranch branch;
  ZpFold fold;                    /* limit points and events of the branch */
  double closed[ZP_MOST_MEMBERS]; /* openings below which each counts as closed, m; zp_together_start */
  void *memory;
} ZpTogether;

/* Fill `all` from the model of the first one; `carve` as of zp_rest_open. False if there is no memory. It must not be
 * moved, and is to be closed, also if this fails. */
bool zp_together_open(ZpTogether *all, const ZpModel *model, void (*carve)(void *user, ZpCarver *carver), void *user);
void zp_together_close(ZpTogether *all);

/* Ask now and then whether to stop; has it been said? */
void zp_together_watch(ZpTogether *all, bool (*stop)(void *caller), void *caller);
bool zp_together_stopped(const ZpTogether *all);

/* From each held where the load may be to the stable equilibrium of all under the load, without any voltage. */
ZpNewtonInfo zp_together_hang(ZpTogether *all);

/* From there on with the voltage that the lower one has while the upper one has none. False if the branch ends on the
 * way there. */
bool zp_together_bias(ZpTogether *all);

/* From there on, along the branch, to a voltage of the first one, V, where its stiffness is then factored. False if the
 * branch ends on the way there. */
bool zp_together_raise(ZpTogether *all, double voltage);

/* From the present point, which is near, to the equilibrium at a voltage of the upper one, V. */
ZpNewtonInfo zp_together_settle(ZpTogether *all, double voltage);

/* What counts as closed, from the present openings, which are without voltage. */
void zp_together_start(ZpTogether *all);

/* How far the nearer one of two antagonists, of those side by side the farthest one, is from counting as closed, m. */
double zp_together_left(const ZpTogether *all);

/* From the present point, which is near, to a limit point of the voltage, or to where zp_together_left is 0 at a
 * voltage from `least` to `most`. False if there is none: the present point is then where it was. */
bool zp_together_limit(ZpTogether *all);
bool zp_together_closing(ZpTogether *all, double least, double most);

/* A copy of the present point takes so many doubles; the copy; back to it, stiffness factored. */
size_t zp_together_save_size(const ZpTogether *all);
void zp_together_save(ZpTogether *all, double *state);
void zp_together_go_to(ZpTogether *all, const double *state);

/* Start to follow the branch towards a growing voltage; then zp_branch_advance. */
bool zp_together_follow(ZpTogether *all);

/* Does the present point stay there when pushed? Leaves the stiffness factored. */
bool zp_together_stable(ZpTogether *all);

/* Force per way by which the load comes back, of the whole actuators, all else being at rest, N/m; at the present
 * point. NAN where the stiffness is singular. */
double zp_together_stiffness(ZpTogether *all);

/* Masses that move, by equation of all => mass [n], kg. */
void zp_together_masses(const ZpTogether *all, double *mass);

/* A step of all as one of each => step. */
void zp_together_part(const ZpTogether *all, const double *step);

/* What one of them pulls the load up with at the present point, N; not of antagonists. */
double zp_together_force(ZpTogether *all, size_t which);

#endif
