/* The ties between members of a system: coordinates that follow one that several members share, because a link joins
 * their platforms or one load hangs on all. docs/theory.md, sections 29 and 31. */
#ifndef ZP_ACTUATOR_TIES_H
#define ZP_ACTUATOR_TIES_H

#include "actuator/model.h"

/* A coordinate is `offset` plus `factor` times the shared one. */
typedef struct ZpTie {
  size_t member, coordinate; /* which member's; 2 node + axis */
  size_t shared;             /* number of the shared coordinate */
  double factor, offset;     /* 1 or -1; m */
} ZpTie;

enum { ZP_MOST_TIES = 2 * ZP_MOST_MEMBERS };

typedef struct ZpTies {
  size_t count, shared; /* ties; coordinates that they share */
  ZpTie tie[ZP_MOST_TIES];
} ZpTies;

/* (the first member) => the ties between all, in one frame for all but an antagonist, which is upside down. */
ZpTies zp_ties_of(const ZpModel *first);

#endif
