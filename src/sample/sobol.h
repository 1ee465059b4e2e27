/* Sobol's sequence in base 2: points that fill a cube evenly, however many of them are taken. */
#ifndef ZP_SAMPLE_SOBOL_H
#define ZP_SAMPLE_SOBOL_H

#include <stdint.h>

/* Dimensions that the table has. */
enum { ZP_SOBOL_DIMENSIONS = 40 };

/* Coordinate `dimension`, below ZP_SOBOL_DIMENSIONS, of point `index`, times 2^32. */
uint32_t zp_sobol(uint32_t index, int dimension);

/* Owen's nested uniform scrambling by a hash: of each bit, whether it flips depends on the bits before it and on
 * `seed`. Any 2^k points that have one in each interval of length 2^-k still have. */
uint32_t zp_scramble(uint32_t x, uint32_t seed);

#endif
