/* A model at rest with everything that is needed to find and follow its equilibria: the system, the work space of the
 * branch, and the arrays of the caller, in one block. Only this file combines these. */
#ifndef ZP_REST_REST_H
#define ZP_REST_REST_H

#include <zipact/rest.h>

#include "def/check.h"
#include "rest/statics.h"
#include "solve/track.h"

struct ZpRest {
  ZpStatics statics;
  ZpBranchSystem system, square, load; /* along the voltage, its square, the load */
  ZpBranch branch;                     /* point by point along the voltage */
  ZpTrack track;                       /* to the next limit along the square or the load */
  void *held;                          /* a state to return to during a slow change (rest/quasistatic.h) */
  bool was_closed;                     /* when that began */
  int falls;                           /* since it last hung without voltage */
  ZpShapeRoom *shape_room;             /* [members] for their shapes */
  ZpManyShapes shapes;                 /* of several */
  void *memory;
};

/* Fill `rest`: straight, without voltage. `reserve` (may be NULL) takes the caller's own arrays from the same block; it
 * is called twice with `user`. False if there is no memory. `rest` must not be moved, and must be closed, also if this
 * fails. */
bool zp_rest_open(ZpRest *rest, const ZpModel *model, void (*reserve)(void *user, ZpArena *arena), void *user);

/* zp_rest_open for a platform that is held, zp_statics_hold: it may be the end of a series. */
bool zp_rest_open_held(ZpRest *rest, const ZpModel *model, void (*reserve)(void *user, ZpArena *arena), void *user);
void zp_rest_close(ZpRest *rest);

/* The present shape with any `time`, of several members as if they were one; valid until the point moves. *margins
 * (may be NULL): what their materials see. */
ZpShape zp_rest_shape(ZpRest *rest, double time, ZpMargins *margins);

/* Number of doubles in a copy of the present point: its coordinates, voltage and load. Take one; go to one, whose
 * forces are then known. */
size_t zp_rest_save_size(const ZpRest *rest);
void zp_rest_save(ZpRest *rest, double *state);
void zp_rest_go_to(ZpRest *rest, const double *state);

/* Start to follow the branch from the present equilibrium, towards a growing or falling voltage; then
 * zp_branch_advance. False if the stiffness is singular there. */
bool zp_rest_follow(ZpRest *rest, bool growing);

/* zp_rest_follow with steps of arc length from `first` to `longest`. */
bool zp_rest_follow_by(ZpRest *rest, bool growing, double first, double longest);

/* After a step of the branch that has passed `voltage`, V, to the equilibrium there. It may be another one if a limit
 * point was before. */
ZpNewtonInfo zp_rest_reach(ZpRest *rest, double voltage);

/* From the present point, which is close, to the equilibrium at `voltage`, V. */
ZpNewtonInfo zp_rest_settle(ZpRest *rest, double voltage);

#endif
