/* Lateral edges. Letters of docs/theory.md, section 16:
 *   g   gap between the insulator faces, m          d   liquid thickness of both insulators, m
 *   e   C' / (eps0 eps_m) - w / (g + d), 1; fitted is e / w
 *   z   variable of the polynomial, in [-1, 1]
 *   s   sqrt(g + d), m^0.5
 */
#include "electro/edges.h"

#include <math.h>

ZpEdgeValue zp_edges_value(const ZpEdgeLaw *law, double gap) {
  double s = sqrt(gap + law->d), sum = s + law->s0, z = law->stretch * (s - law->s0) / sum;
  double z1 = law->stretch * law->s0 / (s * sum * sum), z2 = -0.5 * z1 * (1 / s + 2 / sum) / s;
  double p = 0, p1 = 0, p2 = 0; /* p2: half of the second derivative by z */
  for (size_t k = ZP_EDGE_TERMS; k-- > 0;) {
    p2 = p2 * z + p1;
    p1 = p1 * z + p;
    p = p * z + law->p[k];
  }
  return (ZpEdgeValue){p, p1 * z1, 2 * p2 * z1 * z1 + p1 * z2};
}
