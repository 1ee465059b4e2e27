/* Where what is sampled in elements along a line is level. */
#ifndef ZP_MATH_LEVEL_H
#define ZP_MATH_LEVEL_H

#include <stdbool.h>
#include <stddef.h>

/* Elements with a level end: at their left or their right station what is sampled in them has no slope. Elsewhere it
 * goes straight from station to station; here it starts as a parabola, docs/theory.md, eq. (8.10). */
typedef struct ZpLevelEnd {
  size_t element;
  bool right; /* its right station is the level one */
} ZpLevelEnd;
enum { ZP_MOST_LEVEL_ENDS = 4 };
typedef struct ZpLevelEnds {
  size_t count;
  ZpLevelEnd of[ZP_MOST_LEVEL_ENDS];
} ZpLevelEnds;

#endif
