/* The film of liquid between two faces: lubrication with the inertia of the liquid. docs/theory.md, section 22.
 *
 * Letters: g gap of a station, m; H thickness of the film, g with a floor of the roughness, m; s length along the
 * ribbon, m; mu viscosity, Pa s; rho density, kg/m^3; w width, m. Across the width the flow has two modes k,
 *   dH/dt + d_s(H u_k) + E b_k = 0,   rho du_k/dt + 12 mu u_k / H^2 = -d_s p_k,
 *   (rho db_k/dt + 12 mu E b_k / H^3) / kappa_k^2 = p_k - D,
 * u mean velocity along, m/s; b gradient of the velocity across, 1/s; E depth that counts across, m; p total head, Pa,
 * whose mean is a_0 p_0 + a_1 p_1; D that of the jets at the long edges. The first mode is the exact lowest one, the
 * second all others. Heads are unknowns of a step; u, b and the thickness of cavities are a state. Over a step
 * viscosity resists with the thickness of its middle, foreseen, so that the film is linear in what it resists and can
 * only dissipate. */
#ifndef ZP_LIQUID_FILM_H
#define ZP_LIQUID_FILM_H

#include <stdbool.h>
#include <stddef.h>

#include "base/memory.h"
#include "math/cover.h"

enum { ZP_FILM_MODES = 2, ZP_FILM_CAVITY = 2 * ZP_FILM_MODES, ZP_FILM_STATE };

/* Where an array [2 N] has mode k of station i. */
static inline size_t zp_film_mode_at(size_t i, int k) {
  return ZP_FILM_MODES * i + (size_t)k;
}

static const double zp_film_tension = 1e5; /* Pa: a liquid under an atmosphere stands no more before it cavitates */

/* A floor below one long edge of electrodes that are so wide, along the floor, m; opening: 0 without one, m. */
typedef struct ZpFilmFloor {
  double opening, width;
} ZpFilmFloor;

typedef struct ZpFilmParams {
  size_t nodes;                  /* N stations */
  double l;                      /* element length, m */
  size_t platform, platform_end; /* its first and last station: nothing flows between them */
  double flat_length;            /* of its flat faces, at the gap of each of these, m */
  double w, mu, rho;             /* width, m; viscosity, Pa s; density, kg/m^3, 0: without inertia */
  double free_path;              /* of the molecules of a gas, m; 0: the film does not slip along the faces */
  ZpFilmFloor floor;             /* below one long edge */
  double breadth;                /* twice the area over the length of the edges where it is open, m: w of a strip */
  double roughness;              /* thickness where g is 0, m; 0: none */
  double share[ZP_FILM_MODES];   /* a_k */
  double kappa2[ZP_FILM_MODES];  /* kappa_k^2, 1/m^2; 0: nothing flows out at the long edges */
  bool outlet;                   /* the head is 0 */
  size_t vent[2];                /* from the first of these stations to the other */
} ZpFilmParams;

/* Both modes of a strip of that width; without lateral flow one mode, and a vent at the platform. */
void zp_film_modes(ZpFilmParams *params, bool lateral_flow);

/* Both modes of a level plate of that width and of this length, m, that is open all around, or without lateral flow at
 * its ends only, eq. (37.5). */
void zp_film_plate_modes(ZpFilmParams *params, double length, bool lateral_flow);

/* Viscosity that resists in a film so thick, Pa s: less by slip, eq. (37.7), more above a floor, eq. (37.8). */
double zp_film_viscosity(const ZpFilmParams *params, double thickness);

/* The wet part of an element, of its left [0] and its right station [1]. */
typedef struct ZpFilmPiece {
  double length;     /* m */
  double mean[2];    /* share of each station's thickness in its mean thickness */
  double cell[2][2]; /* [a][b]: what the thickness of station b counts in the cell of station a, m */
  double tip[2]; /* what each counts between the last cell and a meniscus, m: there the head is that of the meniscus */
} ZpFilmPiece;

/* The piece of an element of length l of which `part` is wet, from its right end or its left one. */
ZpFilmPiece zp_film_piece(double l, double part, bool from_right);

/* Conditions at the free ends of the film over a step. */
typedef struct ZpFilmEnds {
  const ZpCover *cover; /* where liquid is; NULL: everywhere */
  const double *open;   /* [N] share of the long edges at a station where liquid can pass, 0 to 1; NULL: 1 */
  double head[2];       /* of the menisci: of the one from the left end on and of the other, Pa */
} ZpFilmEnds;

/* Of a step; [2 i + k] is mode k at station i, of what is along in the element from i to i + 1. A state [5 N] has for
 * each station u_0, u_1, m/s, b_0, b_1, 1/s, and the thickness of its cavity, m. */
typedef struct ZpFilmEval {
  double *rate;                    /* [N] at which the gaps changed over the last step, m/s */
  double *middle;                  /* [N] thickness in the middle of the step, foreseen, m */
  double *H0, *H1, *secant;        /* [N] thickness at its ends, m; (H1 - H0) / (g1 - g0) */
  double *depth0, *depth1;         /* [N] E there, m */
  double *flow, *conductance;      /* [2 N] H u, m^2/s; minus its derivative by the drop of the head, m^2/(s Pa) */
  double *leak, *leak_conductance; /* [2 N] E c, m/s; its derivative by the head less D, m/(s Pa) */
  double *jet;                     /* [N] speed of the jets, outwards, m/s */
  double *coupling;                /* [N] how D couples the modes, Pa s/m */
  double *head;                    /* [N] mean head across the width, Pa */
  double *grows;                   /* [N] 1: there is a cavity, which grows as the head falls; 0: there is none */
  double *held;                    /* [N] 1 or -1: there is one or none, whatever the head; 0: the head decides */
  double *force;                   /* [N] on each station, N, positive opens */
  ZpFilmPiece *piece;              /* [N] of the element from i to i + 1 */
  double *flat;                    /* [N] length of wet flat faces at a station, m */
  double *given;                   /* [N] head that is given there, Pa; NAN: none */
  double *out;                     /* [2] volume that has left through the meniscus of either half, or an outlet, m^3 */
  double *r;                       /* [2 N] what is left of the volume's balance, times its share of the width, m^3 */
  double *end;                     /* [5 N] state at the end */
} ZpFilmEval;

void zp_film_reserve(const ZpFilmParams *params, ZpFilmEval *eval, ZpArena *arena);

/* Thickness at a gap, which may be below 0 by rounding and contact, m. */
double zp_film_thickness(const ZpFilmParams *params, double gap);

/* Its first and second derivative by the gap, 1 and 1/m. */
double zp_film_rise(const ZpFilmParams *params, double gap);
double zp_film_bend(const ZpFilmParams *params, double gap);

/* Depth that counts across at a thickness, m: as much less as the liquid beyond the edges has to move, too. */
double zp_film_depth(const ZpFilmParams *params, double thickness);

/* (gaps at both ends of a step of h, state at its start, heads) => all of eval, with eval->rate as it is. */
void zp_film_step(const ZpFilmParams *params, const ZpFilmEnds *ends, const double *g0, const double *g1, double h,
                  const double *start, const double *heads, const ZpFilmEval *eval);

/* Length of the film in the cell of station i, where it is laid, m. */
double zp_film_wet(const ZpFilmEval *eval, size_t i);

/* A step begins: there are the cavities of the state at its start. */
void zp_film_begin(const ZpFilmParams *params, const double *start, const ZpFilmEval *eval);

/* The heads decide at all stations whether there is a cavity. */
void zp_film_release(const ZpFilmParams *params, const ZpFilmEval *eval);

/* At how many stations do heads contradict what that step had there, a cavity or none? */
size_t zp_film_contradictions(const ZpFilmParams *params, const double *heads, const ZpFilmEval *eval);

/* Hold what that step had wherever heads contradict it, but for the last of these stations, which changes. */
void zp_film_turn_one(const ZpFilmParams *params, const double *heads, const ZpFilmEval *eval);

/* The last correction has led from the heads of that step to these: |work|, J, of cavities that it has opened or closed
 * beyond what its matrix foresaw. */
double zp_film_unforeseen(const ZpFilmParams *params, const double *heads, const ZpFilmEval *eval);

/* Losses of the film over a step, J: each is 0 or more. */
typedef struct ZpFilmLoss {
  double along, across; /* to viscosity */
  double jets;          /* to jets at the long edges, and to cavities that collapse */
  double carried;       /* kinetic energy that has gone out with what passed the menisci's places, J, of any sign */
  double given;         /* work that the menisci's heads have taken, J, of any sign */
} ZpFilmLoss;
ZpFilmLoss zp_film_loss(const ZpFilmParams *params, const ZpFilmEnds *ends, double h, const double *start,
                        const ZpFilmEval *eval);

/* Is the head of mode k at station i an unknown, or is the mode none or its head given? */
bool zp_film_is_free(const ZpFilmParams *params, const ZpFilmEval *eval, size_t i, int k);

/* Does liquid cover all of station i's length? That of a bead may end within it. */
bool zp_film_covers(const ZpFilmParams *params, const ZpFilmEval *eval, size_t i);

/* Does the film fill all between the faces at station i at the step's end: is it covered, without a cavity? */
bool zp_film_fills(const ZpFilmParams *params, const ZpFilmEval *eval, size_t i);

/* Mass by which the film at station i resists to a change of its gap over a step of h, inertia and viscosity together,
 * if all flows across, kg. */
double zp_film_inertia(const ZpFilmParams *params, double h, const ZpFilmEval *eval, size_t i);

/* Kinetic energy of the film at gaps [N] and a state, as far as it is covered, and what its cavities hold, J. */
double zp_film_energy(const ZpFilmParams *params, const ZpCover *cover, const double *gap, const double *state);

/* The part of this energy that belongs to the stations from `first` on before `end`. */
double zp_film_energy_among(const ZpFilmParams *params, const ZpCover *cover, const double *gap, const double *state,
                            size_t first, size_t end);

/* Length of the faces at station i, m. */
double zp_film_length(const ZpFilmParams *params, size_t i);

/* Outflow at the long edges in the cell of station i, mean over the step, m^3/s. */
double zp_film_edge_flow(const ZpFilmParams *params, const ZpFilmEval *eval, size_t i);

/* Flow out over the long edges at the heads of the step if these were open and inertia did not count, m^3/s. */
double zp_film_open_flow(const ZpFilmParams *params, const ZpFilmEval *eval, const double *heads, size_t i);

/* A cavity gives way to the mean of the heads so much that, in short steps, what else the heads do would be rounding in
 * its rows of a matrix. So the matrix has other unknowns x at a station with a cavity, and rows that go with them:
 * p_0 = x_0 - mix x_1 and p_1 = x_1, such that x_1 does not change the mean. Elsewhere mix is 0. */
double zp_film_mix(const ZpFilmParams *params, const ZpFilmEval *eval, size_t i);

/* Row 1 of that step for these unknowns, r_1 - mix r_0, without the rounding of the cavity, which is in r [2] of both
 * modes alike; r may differ from the step's own. */
double zp_film_turned(const ZpFilmParams *params, double h, const ZpFilmEval *eval, size_t i, const double *r);

/* Derivative of r of unknown k at station i by the gap of station j, i - 1 .. i + 1, at the end, as far as it goes with
 * the head's force; m^2. */
double zp_film_by_gap(const ZpFilmParams *params, const ZpFilmEval *eval, size_t i, size_t j, int k);

/* Derivatives of -r of unknown k at station i: by unknown m there, and by m at the next one, m^3/Pa. */
double zp_film_own(const ZpFilmParams *params, double h, const ZpFilmEval *eval, size_t i, int k, int m);
double zp_film_next(const ZpFilmParams *params, double h, const ZpFilmEval *eval, size_t i, int k, int m);

#endif
