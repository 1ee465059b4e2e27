/* A layer along a line of elements that reaches only as far as some place from each of its ends. */
#ifndef ZP_MATH_COVER_H
#define ZP_MATH_COVER_H

#include <stdbool.h>
#include <stddef.h>

typedef struct ZpCover {
  double *part;   /* [N - 1] of each element, 0 to 1, from its left end on; behind the platform from its right end on */
  double flat[2]; /* of the flat length at the platform's first and last station, 0 to 1 */
} ZpCover;

/* How much of element i is covered; NULL: all. */
static inline double zp_cover_part(const ZpCover *cover, size_t i) {
  return cover ? cover->part[i] : 1;
}

#endif
