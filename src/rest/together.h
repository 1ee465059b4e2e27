/* Two actuators at rest against each other: each in its own frame, the lower one upside down, with one load between
 * them. Their openings sum up to the distance of the mounts, so the height of the load is an unknown of both.
 * docs/theory.md, section 31. */
#ifndef ZP_REST_ANTAGONISTS_H
#define ZP_REST_ANTAGONISTS_H

#include "rest/rest.h"

typedef struct ZpAntagonists {
  ZpRest of[2]; /* the upper one, the lower one */
  ZpStaticSystem alone[2];
  double distance;       /* m */
  double *step[2];       /* a step of both as one of each */
  ZpBranchSystem system; /* of both, along the voltage of the upper one */
  ZpBranch branch;
  void *memory;
} ZpAntagonists;

/* Fill `both` from a model whose member below is the antagonist; `carve` as of zp_rest_open. False if there is no
 * memory. It must not be moved, and is to be closed, also if this fails. */
bool zp_antagonists_open(ZpAntagonists *both, const ZpModel *model, void (*carve)(void *user, ZpCarver *carver),
                         void *user);
void zp_antagonists_close(ZpAntagonists *both);

/* Ask now and then whether to stop; has it been said? */
void zp_antagonists_watch(ZpAntagonists *both, bool (*stop)(void *caller), void *caller);
bool zp_antagonists_stopped(const ZpAntagonists *both);

/* From each held half way to the stable equilibrium of both under the load, without any voltage. */
ZpNewtonInfo zp_antagonists_hang(ZpAntagonists *both);

/* From there on with the voltage that the lower one has while the upper one has none. False if the branch ends on the
 * way there. */
bool zp_antagonists_bias(ZpAntagonists *both);

/* From the present point, which is near, to the equilibrium at a voltage of the upper one, V. */
ZpNewtonInfo zp_antagonists_settle(ZpAntagonists *both, double voltage);

/* Start to follow the branch towards a growing voltage; then zp_branch_advance. */
bool zp_antagonists_follow(ZpAntagonists *both);

/* Does the present point stay there when pushed? Leaves the stiffness factored. */
bool zp_antagonists_stable(ZpAntagonists *both);

/* Force per way by which the load comes back, of the whole actuators, all else being at rest, N/m; at the present
 * point. NAN where the stiffness is singular. */
double zp_antagonists_stiffness(ZpAntagonists *both);

#endif
