/* Models whose key `key` is slightly larger or smaller than that of a definition, and the weights of a difference
 * quotient of fourth order of their results. Theory, section 20. */
#ifndef ZP_REST_FINITE_DIFFERENCE_H
#define ZP_REST_FINITE_DIFFERENCE_H

#include "actuator/model.h"

enum { ZP_DIFFERENCE_POINTS = 5 };

typedef struct ZpFiniteDifference {
  int key;                              /* key of the derivative */
  double step;                          /* difference of the key between points, SI */
  double weight[ZP_DIFFERENCE_POINTS];  /* of the quotient, 1 / SI; 0: the point is not used */
  double offset[ZP_DIFFERENCE_POINTS];  /* of the key, SI */
  ZpModel *model[ZP_DIFFERENCE_POINTS]; /* model with the key at this point; NULL: not used */
} ZpFiniteDifference;

/* Build the models about `model`. The points are `part` of the key's value apart, around the value or, at an end of its
 * range, on one side of it. ZP_BAD_INPUT names the key if none can be built; ZP_MACHINE: no memory. Close it in any
 * case. */
ZpStatus zp_finite_difference_open(ZpFiniteDifference *near, const ZpModel *model, int key, double part, ZpError *err);
void zp_finite_difference_close(ZpFiniteDifference *near);

#endif
