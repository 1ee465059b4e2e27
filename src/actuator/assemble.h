/* Equations of an actuator: which coordinate has which, and how the derivatives of its laws go into a banded matrix
 * over them. Coordinates are numbered as in topology.h; -1: held. */
#ifndef ZP_ACTUATOR_ASSEMBLE_H
#define ZP_ACTUATOR_ASSEMBLE_H

#include "actuator/model.h"
#include "actuator/ties.h"
#include "math/arrow.h"
#include "math/parts.h"

/* A coordinate of the lower platform of a member on bodies in the plane, which goes with several unknowns: its change
 * is the sum of their changes times these factors, which depend on where the bodies are (actuator/plane.h). */
enum { ZP_SWINGS = 4, ZP_SWING_WAYS = 6 };
typedef struct ZpSwing {
  size_t count;
  int equation[ZP_SWING_WAYS], place[ZP_SWING_WAYS];
  double factor[ZP_SWING_WAYS];
} ZpSwing;

typedef struct ZpAssembly {
  size_t s, nodes;    /* ribbons; stations, N */
  size_t count;       /* nodes */
  size_t stride;      /* arrays over nodes: all x, then, so much further, all y, and so on */
  size_t axes;        /* coordinates of a node */
  size_t n;           /* equations, of all members of a system */
  ZpArrowBlock block; /* of the matrix of the system: node i meets nodes i - 2 .. i + 2. A symmetric band keeps its
                         upper triangle only, in groups of a station, or of two of one ribbon, if they fit */
  int *equation; /* [axes count] numbered station by station; coordinates that are always the same share theirs; -1:
                    held; below: -2 - k of the coordinate that has swing k */
  int *place;    /* [axes count] row and column in the block; those from block.n on are in its border */
  ZpParts parts; /* halves, and the equations that both have */
  size_t own;    /* unknowns of the laws at each station, which come after its coordinates */
  long port;     /* the common unknown that it meets (zp_assembly_join); below 0: none */
  int *extra_equation, *extra_place; /* [own N] */
  double *factor, *offset;           /* [axes count] a coordinate is this times its unknown plus this, m, rad */
  ZpSwing swing[ZP_SWINGS];          /* in the plane: x and y of the left and of the right end of the lower platform */
  int *first; /* [N] where all coordinates of stations i .. i + 2 are free: place of the first of station i, the others
                 following it; else -1 */
} ZpAssembly;

/* Of the member that has these ties, alone, with `own` unknowns of the laws at each station. False if there is no
 * memory. */
bool zp_assembly_create(const ZpTies *ties, size_t own, bool symmetric, ZpAssembly *assembly);
void zp_assembly_destroy(ZpAssembly *assembly);

/* Number the equations of members as one system => its form. Each member is a block. In the border are the coordinates
 * that rows tie between members, then `common` unknowns, of which each member meets one at most. `first`: the models;
 * NULL: no row ties them. False if there is no memory. */
bool zp_assembly_join(ZpAssembly *const assembly[], const ZpModel *first, size_t members, size_t common,
                      ZpArrowForm *form);

/* The unknowns that the halves of any member have in common, of n of the system. False if there is no memory. */
bool zp_assembly_parts(ZpAssembly *const assembly[], size_t members, size_t n, ZpParts *parts);

/* Changes or rates of nodes [axes stride] => of equations [n]; positions of equations => of nodes, where what is held
 * stays as it is. */
void zp_assembly_gather(const ZpAssembly *assembly, const double *nodes, double *equations);
void zp_assembly_place(const ZpAssembly *assembly, const double *equations, double *nodes);

/* The change of a coordinate by a step [n]; 0 of what is held. */
double zp_assembly_swung(const ZpSwing *swing, const double *step);
static inline double zp_assembly_change(const ZpAssembly *a, const double *step, size_t coordinate) {
  int equation = a->equation[coordinate];
  if (equation < -1) return zp_assembly_swung(&a->swing[-2 - equation], step);
  return equation >= 0 ? a->factor[coordinate] * step[equation] : 0;
}

/* A coordinate that is not held, by the unknowns [n]. */
static inline double zp_assembly_position(const ZpAssembly *a, size_t coordinate, const double *equations) {
  return a->factor[coordinate] * equations[a->equation[coordinate]] + a->offset[coordinate];
}

/* Changes or rates of equations => of all coordinates of nodes [axes stride], 0 of what is held. */
void zp_assembly_changes(const ZpAssembly *assembly, const double *step, double *nodes);

/* equations [n] += forces on nodes [axes stride], summed over what has the same equation; += a force on one coordinate.
 */
void zp_assembly_add(const ZpAssembly *assembly, const double *nodes, double *equations);
void zp_assembly_add_free(const ZpAssembly *assembly, const double *nodes, double *equations); /* but on swings */
void zp_assembly_add_one(const ZpAssembly *assembly, size_t coordinate, double force, double *equations);

/* Forces on nodes [axes stride] => sums over what has the same equation [n]; equations [n] += masses [count]. */
void zp_assembly_sum(const ZpAssembly *assembly, const double *nodes, double *equations);
void zp_assembly_add_masses(const ZpAssembly *assembly, const double *mass, double *equations);

/* As zp_assembly_add_one and zp_assembly_sum, over the places of the block [block.n + border]. */
void zp_assembly_add_place(const ZpAssembly *assembly, size_t coordinate, double force, double *places);
void zp_assembly_sum_places(const ZpAssembly *assembly, const double *nodes, double *places);

/* Below, K is the band of the member's block, which takes what belongs in the columns of its border, too.
 *
 * Add the stiffness of the ribbons: D[3 j + m] [4] =
 * -dR_j / d(edge j + (m - 1) s), as of zp_rod_stiffness, row by row. */
void zp_assemble_edges(const ZpAssembly *assembly, const double (*D)[4], ZpBand *K);

/* K += value at the laws' own unknowns c and d, c <= d, which are [own i + ...] of station i; and, of a symmetric
 * matrix, at c and the gap of a station: at its upper height, and the opposite at its lower one. A matrix that keeps
 * both triangles takes c and d in any order. */
void zp_assemble_own(const ZpAssembly *assembly, size_t c, size_t d, double value, ZpBand *K);
void zp_assemble_own_by_gap(const ZpAssembly *assembly, size_t c, size_t station, double value, ZpBand *K);

/* K += value at one place: in the row of a coordinate and the column of another. */
void zp_assemble_entry(const ZpAssembly *assembly, size_t row, size_t column, double value, ZpBand *K);

/* K += second derivatives by n coordinates, of which each meets those up to `wide` - 1 behind it in the list: that by
 * the i-th and the (i + k)-th at value[wide i + k]. */
void zp_assemble_chain(const ZpAssembly *assembly, size_t n, const size_t *coordinate, size_t wide, const double *value,
                       ZpBand *K);

/* K += values at the heights of both nodes of a station, and between them. Of a symmetric matrix. */
void zp_assemble_heights(const ZpAssembly *assembly, size_t station, double upper, double lower, double both,
                         ZpBand *K);

/* u' K u of the same for a direction u [n], edge by edge. Along a motion that hardly stretches an edge the matrix would
 * lose it in rounding. */
double zp_edges_along(const ZpAssembly *assembly, const double (*D)[4], const double *u);

/* Second derivatives of what depends on gaps and on the mean x-length of an element's ribbons, N/m. */
typedef struct ZpGapDerivatives {
  double *own;             /* [N] by the gap of a station */
  double *next;            /* [N - 1] by that and the gap of the next station */
  double *along0, *along1; /* [N - 1] by an element's x-length and the gap of its left and right station */
} ZpGapDerivatives;

/* Add them to K. */
void zp_assemble_gaps(const ZpAssembly *assembly, const ZpGapDerivatives *derivatives, ZpBand *K);

#endif
