/* How an actuator changes with a key. At fixed coordinates and inputs its forces change exactly as its laws say
 * (ZpTerm.by_key), or, of laws that do not, by a difference quotient over neighbours: models whose key is slightly
 * larger or smaller. Theory, section 20. */
#ifndef ZP_SYSTEM_BY_KEY_H
#define ZP_SYSTEM_BY_KEY_H

#include "system/system.h"

enum { ZP_DIFFERENCE_POINTS = 5 };

typedef struct ZpNeighbour {
  ZpModel *model;
  double offset; /* of its key, SI */
  double weight; /* of it in the quotient, 1 / SI */
} ZpNeighbour;

/* A difference quotient of fourth order. */
typedef struct ZpFiniteDifference {
  int key;     /* key of the derivative */
  double step; /* difference of the key between points, SI */
  int count;   /* neighbours */
  ZpNeighbour near[ZP_DIFFERENCE_POINTS];
} ZpFiniteDifference;

/* Build the neighbours of `model`. They are `part` of the key's value apart, around the value or, at an end of its
 * range, on one side of it. ZP_BAD_INPUT names the key if none can be built; ZP_MACHINE: no memory. Close it in any
 * case. */
ZpStatus zp_finite_difference_open(ZpFiniteDifference *by, const ZpModel *model, int key, double part, ZpError *err);
void zp_finite_difference_close(ZpFiniteDifference *by);

/* A neighbour of an actuator, at coordinates q [2 stride]; its eval, and room for its forces. */
typedef struct ZpNear {
  const ZpModel *model;
  ZpEval *eval;
  const double *q;
  double weight;
  double *force; /* [2 stride] */
} ZpNear;

/* The key of an actuator that its neighbour has larger by `offset`, as the only one; -1: there is none. In a system the
 * key of one member may be called otherwise than that of all. */
int zp_key_of_neighbour(const ZpModel *model, const ZpModel *neighbour, double offset);

/* dF/dkey of a still span, N over the unit of the key => F [2 stride], of laws that say so for `key` exactly, of the
 * others by the neighbours `near`, at their coordinates. -1: of all laws by these. => is all of it exact? The forces of
 * all evals are then those of this span; `work` [2 stride]. */
bool zp_system_by_key(const ZpModel *model, const ZpSpan *span, ZpEval *eval, int key, const ZpNear *near, int count,
                      double *work, double *F);

#endif
