/* A film at rest, slightly moved: what flows where gaps change, and what it takes to make it flow. Each way that the
 * liquid can go, along an element or across a station, resists with its inertia L and its viscosity R: to a flow f it
 * takes the head L df/dt + R f. docs/theory.md, section 28.
 *
 * Letters as in film.h. Flows are H u along, E b across, per width: m^2/s and m/s. */
#ifndef ZP_LIQUID_FILM_SMALL_H
#define ZP_LIQUID_FILM_SMALL_H

#include "liquid/film.h"

/* Arrays [2 N]: mode k at station i at [2 i + k], along of the element from i to i + 1. */
typedef struct ZpFilmWays {
  const ZpFilmParams *params;
  const ZpFilmEval *eval;                     /* of a step at rest, which knows the cells */
  double *along_inertia, *along_resistance;   /* L, R of an element, Pa s^2/m^2 and Pa s/m^2; INFINITY: closed */
  double *across_inertia, *across_resistance; /* of a station, Pa s^2/m and Pa s/m; INFINITY: closed */
  double *diagonal, *head;                    /* [N] work space */
} ZpFilmWays;

void zp_film_ways_reserve(const ZpFilmParams *params, ZpFilmWays *ways, ZpArena *arena);

/* Where the film lies: (cover, gaps [N], state [5 N] of a film at rest and heads [2 N], all 0) => ways. `eval` is work
 * space, and must stay as it is. */
void zp_film_ways(const ZpFilmParams *params, const ZpCover *cover, const double *gap, const double *zeros,
                  const ZpFilmEval *eval, ZpFilmWays *ways);

/* Flows [4 N]: [4 i + k] along, [4 i + 2 + k] across. */
enum { ZP_FILM_FLOWS = 2 * ZP_FILM_MODES };

/* Flows of mode k while gaps change at `rate` [N]: those that viscosity alone lets pass, or inertia alone. Others of
 * the mode stay as they are. */
void zp_film_ways_flow(const ZpFilmWays *ways, const double *rate, int k, bool viscous, double *flow);

/* Of a flow of mode k without a change of any gap: take out the volumes that rounding has put into it. */
void zp_film_ways_close(const ZpFilmWays *ways, int k, double *flow);

/* Force on the gaps [N] against that rate where viscosity rules, N; both modes. */
void zp_film_ways_drag(const ZpFilmWays *ways, const double *rate, double *drag);

/* (two sets of flows) => twice the kinetic energy of both, f' L g, J; what f dissipates with the heads of g, f' R g, W.
 */
double zp_film_ways_inertia(const ZpFilmWays *ways, const double *f, const double *g);
double zp_film_ways_resistance(const ZpFilmWays *ways, const double *f, const double *g);

/* Flow past the long edges at stations `first` to `last`, m^3/s. */
double zp_film_ways_out(const ZpFilmWays *ways, const double *flow, size_t first, size_t last);

#endif
