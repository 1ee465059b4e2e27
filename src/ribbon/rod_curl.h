/* Strips that curl across, as parts of a rod: eq. (8.11). Their energy is taken from that of the joints. */
#ifndef ZP_RIBBON_ROD_CURL_H
#define ZP_RIBBON_ROD_CURL_H

#include "ribbon/rod_step.h"

/* Bending energy that curling saves at the last eval, J; 0 where nothing curls. */
double zp_rod_curl_energy(const ZpRodParams *params, const ZpRodEval *eval);

/* Take from moments and stiffnesses of the step's joints what curling saves between both ends. */
void zp_rod_curl_step(const ZpRodParams *params, const ZpRodEval *start, const ZpRodEval *end, ZpRodStep *step);

#endif
