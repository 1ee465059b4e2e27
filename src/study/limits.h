/* The limits of an actuator at rest, found as such. What was found for one Def is where a neighbour of it starts. */
#ifndef ZP_STUDY_LIMITS_H
#define ZP_STUDY_LIMITS_H

#include <zipact/study.h>

#include "rest/lift.h"

typedef enum ZpLimitKind {
  ZP_LIMIT_PULL_IN,
  ZP_LIMIT_CLOSING,
  ZP_LIMIT_RELEASE,
  ZP_LIMIT_LOAD,
  ZP_LIMIT_KINDS
} ZpLimitKind;

struct ZpLimits {
  size_t ribbons, nodes; /* of the model */
  double L;              /* flexible length, m */
  double hanging;        /* gap that closes last, without voltage, m */
  double *start;         /* state that hangs without voltage */
  bool hangs;
  double *closed; /* closed state at drive.voltage */
  bool closes;
  double *hung;   /* state that hangs without voltage under the largest load */
  double *lifted; /* closed state to which it falls there, if it does */
  bool first;     /* the limit of the largest load is the first that the voltage meets under it */
  ZpLimit limit[ZP_LIMIT_KINDS];
  int warm; /* how many limits were found from the neighbour's */
  void *memory;
};

/* Mass of an actuator's strips and insulators, the platform's included, kg. */
double zp_limits_mass(const ZpModel *model);

#endif
