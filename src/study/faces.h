/* The two insulator faces of a shape at stations close enough for a field solution. */
#ifndef ZP_STUDY_FACES_H
#define ZP_STUDY_FACES_H

#include <stdbool.h>
#include <stddef.h>

/* Pairs of points (base/pair.h) of the upper and the lower face; the clip's edge is at x = 0. */
typedef struct ZpStations {
  size_t count;  /* odd */
  double *x, *y; /* [2 count] m */
  size_t front;  /* a station that is moved; 0: none */
  double moved;  /* from front / (count - 1) to here, and all others in proportion */
} ZpStations;

/* A wedge over `length`: gap = separation (3 xi^2 - 2 xi^3), symmetric about y = 0. */
void zp_contact_cubic(double length, double separation, ZpStations *stations);

/* Let a station of even number be `share` of the way from station k to the next when the stations are laid again => its
 * number; 0 or count - 1 if this is as good as at the first or the last one. */
size_t zp_contact_move_front(ZpStations *stations, size_t k, double share);

/* Of two ribbons (nodes of upper and lower interleaved), which are horizontal at both ends: a curve whose direction has
 * no jumps, so that the chords of a coarse mesh are not taken for corners of the faces. The nodes of rods lie beside it
 * by a twelfth of their second difference, eq. (8.8); those of others on it. */
void zp_contact_smooth(size_t nodes, bool rods, const double *x, const double *y, ZpStations *stations);

#endif
