/* Letters of docs/theory.md, section 41, eq. (41.1):
 *   k, tau  curvature about the width, twist             h  1 - f of eq. (2.6), the share of curling that is held
 *   S       h / theta^4, with t = theta^4
 */
#include "ribbon/space_section.h"

#include <math.h>

#include "ribbon/curl.h"
#include "ribbon/section.h"

ZpSpaceSection zp_space_section(double E, double poisson, double t, double w, bool softens) {
  const ZpLayer layer = {t, E, poisson, 0};
  const ZpSection plain = zp_section(&layer, 1, w, true);
  return (ZpSpaceSection){.B = plain.EI,
                          .B2 = E * t * w * w * w / 12,
                          .C = E / (2 * (1 + poisson)) * w * t * t * t / 3 * (1 - 0.63 * t / w),
                          .D = E * t * t * t * w * w * w / 144,
                          .poisson = poisson,
                          .squared = w * w * w * w * plain.EA / (4 * plain.EI),
                          .softens = softens};
}

/* The energies of (41.1) that go with curling. `bend` is not 0. */
static void add_curling(const ZpSpaceSection *p, double bend, double twist, ZpSpaceLaw *law) {
  const double t = p->squared * bend * bend, tau2 = twist * twist, over = 1 / bend;
  const ZpCurlHeld S = zp_curl_held(t);
  const double h = t * S.value, h1 = t * (S.value + S.first), h2 = t * (2 * S.first + S.second);
  const double quartic = 0.5 * p->B * p->squared, mixed = p->poisson * p->B;
  const double tau4 = tau2 * tau2, S1 = 2 * S.first * over, S2 = (4 * S.second + 2 * S.first) * over * over;
  const double by1 = 2 * h1 * over, by2 = (4 * h2 + 2 * h1) * over * over;
  law->W += mixed * h * tau2 + quartic * S.value * tau4;
  law->moment[0] += mixed * by1 * tau2 + quartic * S1 * tau4;
  law->moment[2] += (2 * mixed * h + 4 * quartic * S.value * tau2) * twist;
  law->stiffness[0][0] += mixed * by2 * tau2 + quartic * S2 * tau4;
  law->stiffness[0][2] += (2 * mixed * by1 + 4 * quartic * S1 * tau2) * twist;
  law->stiffness[2][2] += 2 * mixed * h + 12 * quartic * S.value * tau2;
}

ZpSpaceLaw zp_space_law(const ZpSpaceSection *p, double bend, double sway, double twist) {
  static const double least = 1e-30; /* theta^4: below, curling is that of a straight strip */
  ZpSpaceLaw law = {.W = 0.5 * (p->B * bend * bend + p->B2 * sway * sway + p->C * twist * twist),
                    .moment = {p->B * bend, p->B2 * sway, p->C * twist},
                    .stiffness = {{p->B, 0, 0}, {0, p->B2, 0}, {0, 0, p->C}}};
  if (p->squared == 0) return law;
  add_curling(p, copysign(fmax(fabs(bend), sqrt(least / p->squared)), bend), twist, &law);
  law.stiffness[2][0] = law.stiffness[0][2];
  if (!p->softens) return law;
  const ZpCurl curl = {p->poisson * p->poisson * p->B, p->squared};
  const ZpCurlLaw saved = zp_curl_law(&curl, bend);
  law.W -= saved.W;
  law.moment[0] -= saved.M;
  law.stiffness[0][0] -= saved.K;
  return law;
}
