/* The affine constraints on coordinates of nodes, of one actuator or of several as one system. Joints hold nodes or
 * make them one; links and a shared load tie heights of several members. docs/theory.md, sections 19, 29 and 31. */
#ifndef ZP_ACTUATOR_TIES_H
#define ZP_ACTUATOR_TIES_H

#include "actuator/model.h"

/* A coordinate is `factor` times a free one plus `offset`. Coordinate 2 j is x of node j, 2 j + 1 its y. */
typedef struct ZpTie {
  size_t member, coordinate; /* the tied one */
  size_t to_member, to;      /* the free one */
  double factor, offset;     /* 1, -1, or 0 of one that is held; m */
} ZpTie;

enum { ZP_MOST_TIES = 16 * ZP_MOST_MEMBERS };

typedef struct ZpTies {
  const ZpModel *first;
  size_t members, count;
  ZpTie tie[ZP_MOST_TIES]; /* member by member */
} ZpTies;

/* (consecutive members of a system, all of them or one alone) => their ties. All are in one frame but the lower one of
 * antagonists, which is upside down. Alone, a member of a series is in the frame of its upper platform. */
ZpTies zp_ties_of(const ZpModel *first, size_t members);

/* The row of a coordinate; NULL: it is free. */
const ZpTie *zp_tie_of(const ZpTies *ties, size_t member, size_t coordinate);

static inline bool zp_is_held(const ZpTies *ties, size_t member, size_t coordinate) {
  const ZpTie *tie = zp_tie_of(ties, member, coordinate);
  return tie && tie->factor == 0;
}

#endif
