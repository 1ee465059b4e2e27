/* The affine constraints on coordinates of nodes, of one actuator or of several as one system. Joints hold nodes or
 * make them one; links and a shared load tie heights of several members; a study may hold the platform at an opening.
 * docs/theory.md, sections 13, 19, 29 and 31. */
#ifndef ZP_ACTUATOR_TIES_H
#define ZP_ACTUATOR_TIES_H

#include "actuator/model.h"

/* A coordinate is `factor` times a free one plus `offset` plus `by_input` times an input, the opening at which the
 * platform is held. Coordinate 2 j is x of node j, 2 j + 1 its y. */
typedef struct ZpTie {
  size_t member, coordinate; /* the tied one */
  size_t to_member, to;      /* the free one */
  double factor, offset;     /* 1, -1, or 0 of one that is held; m */
  double by_input;           /* 0 of a row that always acts; another one acts while its input has a value */
} ZpTie;

enum { ZP_MOST_TIES = 16 };

/* The rows of one member that always act. */
typedef struct ZpTies {
  const ZpModel *first; /* the member is number `member` of these `members` */
  size_t members, member, count;
  ZpTie tie[ZP_MOST_TIES];
} ZpTies;

/* (consecutive members of a system, all of them or one alone) => the ties of one of them. All are in one frame but the
 * lower one of antagonists, which is upside down. Alone, a member of a series is in the frame of its upper platform. */
ZpTies zp_ties_of(const ZpModel *first, size_t members, size_t member);

/* How a member sees the height of a body at one of its ends: `origin` plus `sign` times its coordinate, m. */
typedef struct ZpSight {
  size_t member, coordinate;
  double origin, sign;
} ZpSight;

/* Of the body at its upper or at its lower end; of a body that moves, by its leader. */
ZpSight zp_sight_of_end(const ZpModel *first, size_t member, bool upper);
ZpSight zp_sight_of_body(const ZpModel *first, size_t body);

/* The coordinate of a body at a height. */
static inline double zp_seen(const ZpSight *sight, double height) {
  return sight->sign * (height - sight->origin);
}

/* Where a row puts its coordinate if the free one is at `to`, m. */
static inline double zp_tie_place(const ZpTie *tie, double to, double input) {
  return tie->factor * to + tie->offset + tie->by_input * input;
}

/* The row that holds the platform while a study gives an opening: that on which the load of all hangs. Its coordinate
 * has an equation. The lower platform is so far below the upper one, of a series the lowest below the uppermost, or the
 * free end of the lower of two ribbons below its left end, eq. (13.6). */
ZpTie zp_tie_of_held(const ZpModel *first, size_t members);

/* The row that makes both nodes of a station one along x (axis 0) or y (1), with the offset that they have where it
 * begins to act, eq. (5.1). That of a clip always acts. Those of sequential contact switch during a run: paper/zip.h
 * says which of them act. */
static inline ZpTie zp_tie_of_pair(const ZpModel *model, size_t station, size_t axis) {
  const ZpTopology *t = &model->topology;
  return (ZpTie){0, 2 * zp_upper(t, station) + axis, 0, 2 * zp_lower(t, station) + axis, 1, 0, 0};
}

/* (accelerations of free nodes [2 stride]) => pairs whose rows act share theirs, eq. (5.3): those of stations 0 to the
 * front, and the last one with the platform. */
void zp_ties_share(const ZpModel *model, const ZpMasses *masses, const ZpZipState *act, double *acceleration);

/* The row of a pair begins to act: both nodes have one velocity along its axis. => kinetic energy lost, J. */
double zp_tie_join(const ZpTie *tie, const ZpAxisMasses *masses, double *velocity);

/* The row that always acts on a coordinate; NULL: it is free. */
const ZpTie *zp_tie_of(const ZpTies *ties, size_t coordinate);

static inline bool zp_is_held(const ZpTies *ties, size_t coordinate) {
  const ZpTie *tie = zp_tie_of(ties, coordinate);
  return tie && tie->factor == 0;
}

#endif
