/* Nodes where the rows of the table of constraints and the vectors of edges want them: all rows hold, and edges differ
 * from the given ones as little as they can, eq. (10.8). docs/theory.md, section 10. */
#ifndef ZP_ACTUATOR_PLACE_H
#define ZP_ACTUATOR_PLACE_H

#include "actuator/assemble.h"

/* Place all nodes [2 stride] on straight ribbons. */
void zp_place_straight(const ZpModel *model, double *nodes);

/* A pouch as the closed law has it, with so much of its films zipped, m. */
void zp_place_pouch(const ZpModel *model, double zipped, double *nodes);

/* Place all nodes [2 stride] at the ends of edges, of which those of node j and of the next one of its ribbon is at j.
 * What misses a held end is spread along the ribbons that lead there. What the lower platforms of two halves miss each
 * other by, each half takes half of. */
void zp_place_edges(const ZpModel *model, const ZpAssembly *assembly, const double *edges, double *nodes);

/* Move the lower platform to a height; the edges that lead there take equal parts of its way. */
void zp_place_platform(const ZpModel *model, const ZpAssembly *assembly, double height, double *nodes);

/* Move all of a member up or down until its upper platform is at a height. */
void zp_place_top(const ZpModel *model, double height, double *nodes);

/* Lower a member of a series until its upper platform is where the lower one of the member above is, eq. (29.2). */
void zp_place_below(const ZpModel *above, const double *nodes_above, const ZpModel *model, double *nodes);

#endif
