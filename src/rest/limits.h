/* The limits of an actuator: pull-in, closing, release and the largest load. Each is solved as the limit point or event
 * that it is, without following the curve (rest/quasistatic.h). What was found for one actuator is where a neighbour of
 * it starts. Theory, section 10. */
#ifndef ZP_REST_LIMITS_H
#define ZP_REST_LIMITS_H

#include "rest/quasistatic.h"

typedef enum ZpLimitKind {
  ZP_LIMIT_PULL_IN,
  ZP_LIMIT_CLOSING,
  ZP_LIMIT_RELEASE,
  ZP_LIMIT_LOAD,
  ZP_LIMIT_KINDS
} ZpLimitKind;

typedef struct ZpLimits {
  size_t save, equations; /* doubles of a state; equations of a null vector */
  double L;               /* flexible length, m */
  double hanging;         /* gap that closes last, without voltage, m */
  ZpNewtonInfo info;      /* of the search of the state that hangs without voltage: */
  double *start;
  bool hangs;
  double *top; /* the state that hangs at drive.voltage */
  bool arrives;
  double *closed; /* closed state at drive.voltage */
  bool closes;
  bool opens_first; /* its release is at the first limit point that a falling voltage meets */
  double *hung;     /* state that hangs without voltage under the largest load */
  double *lifted;   /* closed state to which it falls there, if it does */
  bool first;       /* the limit of the largest load is the first that the voltage meets under it */
  ZpLimit limit[ZP_LIMIT_KINDS];
  ZpLimit at; /* work space: where a rising voltage closes it under some load */
  int warm;   /* how many limits were found from the neighbour's */
  void *memory;
} ZpLimits;

/* NULL if there is no memory. */
ZpLimits *zp_limits_create(const ZpRest *rest);

/* Find the limits up to drive.voltage, with `load` also the largest load, from those of a neighbour whose states have
 * the same form (NULL: none). The present point is then another. */
void zp_limits_find(ZpRest *rest, const ZpLimits *near, bool load, ZpLimits *limits);

/* Was one of them not found although it may exist? */
bool zp_limits_lost(const ZpLimits *limits);

#endif
