/* The limits of an actuator under a slow change of the voltage or of the load, each solved as a limit point or an
 * event. Theory, section 10.
 *
 * zp_march goes to the next limit point, or to where the actuator counts as closed. From a limit point the state falls
 * to the stable state beyond it. This is repeated until the actuator has closed or opened. */
#ifndef ZP_REST_SLOW_H
#define ZP_REST_SLOW_H

#include "rest/closing.h"
#include "rest/rest.h"

/* One limit: an equilibrium. */
typedef struct ZpLimit {
  ZpMarchEnd end;     /* a limit point or an event; ZP_MARCH_ARRIVED: there is none, ZP_MARCH_LOST: it was not found */
  double value;       /* V or kg; NAN if it does not exist */
  const char *reason; /* why it does not exist */
  double *state;      /* as ZpBranchSystem saves it */
  double *null;       /* [equations] null vector of a limit point */
  double room;        /* all other crests of its ripple are lower by this share of the value; 0: not known */
} ZpLimit;

/* Take state (zp_rest_save_size) and null vector from the caller's block. */
void zp_limit_carve(ZpLimit *limit, size_t save_size, size_t equations, ZpCarver *carver);

/* Mark a limit as one that does not exist; as one that was not found. */
void zp_limit_none(ZpLimit *limit, const char *reason);
void zp_limit_lost(ZpLimit *limit, const char *reason);

typedef struct ZpSlow {
  ZpStatics *statics;
  ZpNewtonWork *newton;
  ZpBranchSystem square, load; /* along the voltage's square, along the load */
  ZpMarch march;
  double closed;   /* gap at which it counts as closed, m */
  void *held;      /* a state to return to */
  bool was_closed; /* when the slow change began */
} ZpSlow;

typedef enum ZpSlowEnd {
  ZP_SLOW_ARRIVED, /* the change has ended */
  ZP_SLOW_CHANGED, /* it has closed or opened */
  ZP_SLOW_BEYOND,  /* a limit point is further than was asked */
  ZP_SLOW_LOST,
  ZP_SLOW_IMPOSSIBLE, /* still closed, in a state that cannot be */
  ZP_SLOW_STOPPED
} ZpSlowEnd;

void zp_slow_carve(ZpSlow *slow, ZpRest *rest, ZpCarver *carver);

/* From the present point, at which the actuator hangs without a voltage: this determines when it counts as closed. */
void zp_slow_start(ZpSlow *slow);

bool zp_slow_is_closed(const ZpSlow *slow);

/* Derivative of the gap at which it counts as closed by the load, m/kg, at the present point, where it hangs without
 * voltage. */
double zp_slow_closed_by_load(ZpSlow *slow);

/* Go to a saved state. */
void zp_slow_go_to(ZpSlow *slow, const double *state);

/* Store the present point, at which a march has ended, as this limit. */
void zp_slow_note(ZpSlow *slow, ZpLimit *limit, ZpMarchEnd end);
void zp_slow_copy(const ZpSlow *slow, const ZpLimit *from, ZpLimit *to);

/* Examine the branch on both sides of the limit point at the present point, as far as a ripple may extend. Its highest
 * crest is where the parameter, growing (sign 1) or falling (-1), goes furthest. Also sets the room of the limit. */
typedef enum ZpAround { ZP_NOTHING_HIGHER, ZP_STABLE_HIGHER, ZP_CREST_HIGHER, ZP_OUT_OF_SIGHT } ZpAround;
ZpAround zp_slow_look_around(ZpSlow *slow, ZpLimit *limit, double sign);

/* The room that the limit at the present point keeps of that of `near`, a limit of a neighbour with this `gap`. */
double zp_slow_room_left(ZpSlow *slow, const ZpLimit *near, double gap);

/* From close by, at the present voltage, to the load of a limit point with about this null vector, and to the one under
 * which the closing gap has this value. False if there is none, or it is not stable apart from the null vector. */
bool zp_slow_fold_of_load(ZpSlow *slow, const double *null);
bool zp_slow_event_of_load(ZpSlow *slow, double gap);

/* From the present equilibrium, lower the load to 0, or raise the voltage to `top`, V, or to the first limit => at, if
 * there is one. */
ZpMarchEnd zp_slow_drop_load(ZpSlow *slow, ZpLimit *at);
ZpMarchEnd zp_slow_first(ZpSlow *slow, double top, ZpLimit *at);

/* From the present equilibrium, raise the voltage to `top`, V, until the actuator closes, or to the first limit point
 * not below `enough`, V, from which it does not fall: this limit is `at`. */
ZpSlowEnd zp_slow_close_at(ZpSlow *slow, double top, double enough, ZpLimit *at);

/* Does the actuator close when it falls from this limit point of the voltage, at which it is? */
bool zp_slow_falls_closed(ZpSlow *slow, const ZpLimit *limit);

/* From the hanging state without voltage, raise the voltage to `top`, V, or until the actuator closes => pull_in, the
 * first limit point that is no ripple of the mesh, and closing. */
ZpSlowEnd zp_slow_raise(ZpSlow *slow, double top, ZpLimit *pull_in, ZpLimit *closing);

/* The same, but only to the first limit point, ripple or not, or to where the actuator has closed. */
ZpMarchEnd zp_slow_pull_in(ZpSlow *slow, double top, ZpLimit *limit);

/* Go to the closed state at voltage `top`: from the present point if it is closed, else from the straight shape. False
 * if the actuator is not closed there. */
bool zp_slow_close(ZpSlow *slow, double top);

/* From that state, lower the voltage to 0 or until the actuator opens => release, which is not above closing. */
ZpSlowEnd zp_slow_lower(ZpSlow *slow, const ZpLimit *closing, ZpLimit *release);

#endif
