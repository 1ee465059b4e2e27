/* Models whose key `key` is slightly larger or smaller than that of a definition, and the weights of a difference
 * quotient of fourth order of their results. Theory, section 20. */
#ifndef ZP_REST_NEAR_H
#define ZP_REST_NEAR_H

#include "actuator/model.h"

enum { ZP_NEAR_POINTS = 5 };

typedef struct ZpNear {
  int key;                        /* key of the derivative */
  double step;                    /* difference of the key between points, SI */
  double weight[ZP_NEAR_POINTS];  /* of the quotient, 1 / SI; 0: the point is not used */
  double offset[ZP_NEAR_POINTS];  /* of the key, SI */
  ZpModel *model[ZP_NEAR_POINTS]; /* model with the key at this point; NULL: not used */
} ZpNear;

/* Build the models about `model`. The points are `part` of the key's value apart, around the value or, at an end of its
 * range, on one side of it. ZP_BAD_INPUT names the key if none can be built; ZP_MACHINE: no memory. Close it in any
 * case. */
ZpStatus zp_near_open(ZpNear *near, const ZpModel *model, int key, double part, ZpError *err);
void zp_near_close(ZpNear *near);

#endif
