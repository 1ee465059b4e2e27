/* The paper's surface: each ribbon from the zip front to the platform is one cubic Bezier, and the plates
 * law is integrated between those. The force of an interval acts on its right station.
 *
 * The authors' breakdown switch, if params->h_switch_per_volt > 0: where the field with a wrong insulator
 * thickness, share U / (g + switch_offset), exceeds breakdown, the force drops at once to that at
 * breakdown (theory, eq. (4.9)). */
#ifndef ZP_ELECTRO_SURFACE_H
#define ZP_ELECTRO_SURFACE_H

#include "electro/plates.h"
#include "math/bezier.h"

/* (plates law, basis for the free stations, x and y of interleaved nodes, first free station `front`,
 * direction of the closed part there, voltage) => eval->Fy of all stations, eval->Fx = 0. The curves
 * arrive horizontally at the platform. Not the gradient of an energy. */
void zp_surface_bezier(const ZpPlatesParams *params, const ZpBezierBasis *basis, const double *x, const double *y,
                       size_t front, const double direction[2], double voltage, ZpPlatesEval *eval);

#endif
