/* Do the faces of two ribbons pass through each other? The gap of a station compares the heights of two nodes that face
 * each other. Where ribbons are steep, or one has slid along the other, this does not show whether a face lies inside
 * the other one; their polylines do. */
#ifndef ZP_REST_CROSSING_H
#define ZP_REST_CROSSING_H

#include "actuator/model.h"

/* (coordinates [2 stride]) => by how much the polylines of the faces lie inside each other at a crossing, m: the
 * largest distance from the other polyline of the first two nodes beyond it. 0: they do not cross, or there is one
 * ribbon. */
double zp_crossing_depth(const ZpModel *model, const double *q);

#endif
