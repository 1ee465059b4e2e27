/* Do the faces of two ribbons pass through each other? The gap of a station compares the heights of two nodes that face
 * each other. Where ribbons are steep, or one has slid along the other, this does not show whether a face lies inside
 * the other one; their polylines do. */
#ifndef ZP_REST_CROSSING_H
#define ZP_REST_CROSSING_H

#include "actuator/model.h"

/* A state in which they do, in words, and what helps. */
#define ZP_FACES_CROSS                                                                                                 \
  "steep faces have slid until they lie inside each other, because gaps are those of facing stations, measured "       \
  "vertically"
#define ZP_LESS_STEEP "shorter or thicker ribbons are less steep"

/* (two ribbons, coordinates [2 stride]) => by how much the polylines of the faces lie inside each other at a crossing,
 * m: the largest distance from the other polyline of the first two nodes beyond it. 0: they do not cross. */
double zp_crossing_depth(const ZpModel *model, const double *q);

/* Is that depth larger than `deeper`? Never with one ribbon. */
bool zp_crosses(const ZpModel *model, const double *q, double deeper);

#endif
