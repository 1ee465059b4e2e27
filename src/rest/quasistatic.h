/* A slow change of the voltage or of the load: from limit to limit, each solved as a limit point or an event. Theory,
 * section 10.
 *
 * zp_track goes to the next limit point, or to where the actuator counts as closed. From a limit point the state falls
 * to the stable state beyond it. This is repeated until the actuator has closed or opened. */
#ifndef ZP_REST_QUASISTATIC_H
#define ZP_REST_QUASISTATIC_H

#include "rest/rest.h"

/* -- closed ---------------------------------------------------------------------------------------- */

/* Distance between the faces that close last, m: at the platform or the right end; between two clamps in the middle. Of
 * the last residual. `statics` is a ZpStatics; row [n] gets the derivative by the coordinates (NULL: not needed). */
double zp_closing_gap(void *statics, double *row);

/* How many members count as closed? */
size_t zp_closed_members(const ZpStatics *statics);

/* From the present point, at which the actuator hangs without a voltage: this determines when it counts as closed. */
void zp_quasistatic_start(ZpRest *rest);

bool zp_quasistatic_is_closed(ZpRest *rest);

/* The member that decides whether the system counts as closed: the last one to close of those side by side, the first
 * one of antagonists. */
size_t zp_quasistatic_deciding(const ZpStatics *statics);

/* Gap of a member that closes last in it, m. => row [n]: its derivatives; may be NULL. */
double zp_member_gap(const ZpStatics *statics, size_t which, double *row);

/* Derivative of the gap at which a member counts as closed by the load, m/kg, at the present point, where it hangs
 * without voltage. */
double zp_quasistatic_closed_by_load(ZpRest *rest, size_t which);

/* -- limits ---------------------------------------------------------------------------------------- */

/* One limit: an equilibrium. */
typedef struct ZpLimit {
  ZpTrackEnd end;     /* a limit point or an event; ZP_TRACK_ARRIVED: there is none, ZP_TRACK_LOST: it was not found */
  double value;       /* V or kg; NAN if it does not exist */
  const char *reason; /* why it does not exist */
  double *state;      /* zp_rest_save */
  double *null;       /* [equations] null vector of a limit point */
  double room;        /* all other crests of its ripple are lower by this share of the value; 0: not known */
} ZpLimit;

/* Take state and null vector from the caller's block. */
void zp_limit_reserve(ZpLimit *limit, size_t save_size, size_t equations, ZpArena *arena);

/* Mark a limit as one that does not exist. */
void zp_limit_none(ZpLimit *limit, const char *reason);

/* Store the present point, at which a track has ended, as this limit. */
void zp_quasistatic_note(ZpRest *rest, ZpLimit *limit, ZpTrackEnd end);
void zp_quasistatic_copy(const ZpRest *rest, const ZpLimit *from, ZpLimit *to);

/* Examine the branch on both sides of the limit point at the present point, as far as a ripple may extend. Its highest
 * crest is where the parameter, growing (sign 1) or falling (-1), goes furthest. Also sets the room of the limit. */
typedef enum ZpAround { ZP_NOTHING_HIGHER, ZP_STABLE_HIGHER, ZP_CREST_HIGHER, ZP_OUT_OF_SIGHT } ZpAround;
ZpAround zp_quasistatic_look_around(ZpRest *rest, ZpLimit *limit, double sign);

/* From the limit point at the present point to the highest crest of its ripple, also over stable states between crests,
 * while the voltage changes to `target`, V => limit. False if another limit is there, or part of the ripple is out of
 * sight. */
bool zp_quasistatic_climb(ZpRest *rest, double target, ZpLimit *limit);

/* The room that the limit at the present point keeps of that of `near`, a limit of a neighbour with this `gap`. */
double zp_quasistatic_room_left(ZpRest *rest, const ZpLimit *near, double gap);

/* From close by, at the present voltage, to the load of a limit point with about this null vector, and to the one under
 * which the closing gap has this value. False if there is none, or it is not stable apart from the null vector. */
bool zp_quasistatic_fold_of_load(ZpRest *rest, const double *null);
bool zp_quasistatic_event_of_load(ZpRest *rest, double gap);

/* From the present equilibrium, lower the load to 0, or raise the voltage to `top`, V, or to the first limit => at, if
 * there is one. */
ZpTrackEnd zp_quasistatic_drop_load(ZpRest *rest, ZpLimit *at);
ZpTrackEnd zp_quasistatic_first(ZpRest *rest, double top, ZpLimit *at);

/* -- a slow change of the voltage ------------------------------------------------------------------- */

typedef enum ZpQuasistaticEnd {
  ZP_QUASISTATIC_ARRIVED, /* the change has ended */
  ZP_QUASISTATIC_CHANGED, /* it has closed or opened */
  ZP_QUASISTATIC_BEYOND,  /* a limit point is further than was asked */
  ZP_QUASISTATIC_LOST,
  ZP_QUASISTATIC_IMPOSSIBLE, /* still closed, in a state that cannot be */
  ZP_QUASISTATIC_STOPPED
} ZpQuasistaticEnd;

/* From the present equilibrium, raise the voltage to `top`, V, until the actuator closes, or to the first limit point
 * not below `enough`, V, from which it does not fall: this limit is `at`. */
ZpQuasistaticEnd zp_quasistatic_close_at(ZpRest *rest, double top, double enough, ZpLimit *at);

/* Does the actuator close when it falls from this limit point of the voltage, at which it is? */
bool zp_quasistatic_falls_closed(ZpRest *rest, const ZpLimit *limit);

/* From the hanging state without voltage, raise the voltage to `top`, V, or until the actuator closes => pull_in, the
 * first limit point that is no ripple of the mesh, and closing. */
ZpQuasistaticEnd zp_quasistatic_ramp_voltage(ZpRest *rest, double top, ZpLimit *pull_in, ZpLimit *closing);

/* Go to the closed state at voltage `top`: from the present point if it is closed, else from the straight shape. False
 * if the actuator is not closed there. */
bool zp_quasistatic_close(ZpRest *rest, double top);

/* From that state, lower the voltage to 0 or until the actuator opens => release, which is not above closing. */
ZpQuasistaticEnd zp_quasistatic_lower(ZpRest *rest, const ZpLimit *closing, ZpLimit *release);

#endif
