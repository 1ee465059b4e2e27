/* Sections that yield as a part of a rod, eqs. (8.12) and (39.7): what yields takes moment, tension and energy from
 * joints and edges. Plastic strains are [ZP_FIBRES] for each of the rod's points (rod_point.h), one point after the
 * other. */
#ifndef ZP_RIBBON_ROD_PLASTIC_H
#define ZP_RIBBON_ROD_PLASTIC_H

#include <stdbool.h>

#include "ribbon/rod_step.h"

/* How many plastic strains a rod has; 0: it stays elastic. */
size_t zp_rod_plastic_count(const ZpRodParams *params);

/* How much less than the elastic energy is stored at the last eval, J. `strain`: NULL: none. */
double zp_rod_plastic_relief(const ZpRodParams *params, const ZpRodEval *eval, const double *strain);

/* From step->strain_start find step->strain_end, and take their moments and tensions from the step's joints and edges:
 * their mean, or, `still`, that at the end. */
void zp_rod_plastic_step(const ZpRodParams *params, const ZpRodEval *end, bool still, ZpRodStep *step);

/* After zp_rod_stiffness without them: D less what they take at the last zp_rod_plastic_step. */
void zp_rod_plastic_stiffness(const ZpRodParams *params, const ZpRodStep *step, double (*D)[4]);

/* Find step->strain_end at the step's end => heat over the step, J. */
double zp_rod_plastic_heat(const ZpRodParams *params, const ZpRodEval *start, const ZpRodEval *end, ZpRodStep *step);

/* The largest curvature that would be left where no moment acts, 1/m. */
double zp_rod_plastic_set(const ZpRodParams *params, const double *strain);

/* The largest strain that would be left along where no force acts. */
double zp_rod_plastic_elongation(const ZpRodParams *params, const double *strain);

#endif
