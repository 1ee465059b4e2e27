/* The surface of the paper: each ribbon from the zip front to the platform is one cubic Bezier curve, and the plates
 * law is integrated between these curves. The force of an interval acts on its right station.
 *
 * The breakdown switch of the authors, if params->h_switch_per_volt > 0: where the field with a wrong insulator
 * thickness, share U / (g + switch_offset), exceeds breakdown, the force drops abruptly to that at breakdown (theory,
 * eq. (4.9)). */
#ifndef ZP_PAPER_SURFACE_H
#define ZP_PAPER_SURFACE_H

#include "electro/plates.h"
#include "paper/bezier.h"

typedef struct ZpBezierSurface {
  size_t stations; /* free stations for which the members below are prepared; 0: none yet */
  ZpBezierBasis fit;
  double *t0, *t1; /* [N] curve parameters of the two Gauss points of each interval */
  double *closing; /* [N] attraction of each interval, N */
} ZpBezierSurface;

void zp_surface_reserve(size_t nodes, ZpBezierSurface *surface, ZpArena *arena);

/* Prepare for this many free stations, 2 or more; does nothing if it is done already. */
void zp_surface_prepare(ZpBezierSurface *surface, size_t stations);

/* (plates law, surface prepared for the free stations, x and y of interleaved nodes, first free station `front`,
 * direction of the closed part there, voltage) => Fy on the nodes of all stations, N; along x nothing acts. The curves
 * arrive horizontally at the platform. The force is not the gradient of an energy. */
void zp_surface_bezier(const ZpPlatesParams *params, const ZpBezierSurface *surface, const double *x, const double *y,
                       size_t front, const double direction[2], double voltage, double *Fy);

#endif
