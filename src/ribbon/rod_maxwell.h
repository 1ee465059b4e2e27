/* Layers that creep as a part of a rod, eq. (39.10): their branches add moment and tension to joints and edges.
 * Strains of springs are ZpBent [ZP_BRANCHES] for each of the rod's points (rod_point.h), one point after the other. */
#ifndef ZP_RIBBON_ROD_MAXWELL_H
#define ZP_RIBBON_ROD_MAXWELL_H

#include <stdbool.h>

#include "ribbon/rod_step.h"

/* How many numbers the strains of springs of a rod are; 0: nothing creeps. */
size_t zp_rod_maxwell_count(const ZpRodParams *params);

/* Energy of the springs with these strains, J; NULL: none. */
double zp_rod_maxwell_energy(const ZpRodParams *params, const double *spring);

/* Over a step of length step->h from step->spring_start: find step->spring_end, and add the mean moments and tensions
 * to the step's joints and edges. `still`: all has relaxed. */
void zp_rod_maxwell_step(const ZpRodParams *params, const ZpRodEval *start, const ZpRodEval *end, bool still,
                         ZpRodStep *step);

/* After zp_rod_stiffness without them: D with what they add at the last zp_rod_maxwell_step. */
void zp_rod_maxwell_stiffness(const ZpRodParams *params, const ZpRodStep *step, double (*D)[4]);

/* u' K u of branch `number`, of layers that have not relaxed, for displacements of nodes u [lanes], N m: at rest, at
 * the last zp_rod_step. */
double zp_rod_maxwell_along(const ZpRodParams *params, const ZpRodStep *step, size_t number, const double *x,
                            const double *y);

/* Error of the places of nodes at the end of the last step, as far as creep within it makes it, m: of `length` of a
 * ribbon that is bent and stretched alike. */
double zp_rod_maxwell_error(const ZpRodParams *params, const ZpRodStep *step, double length);

/* Find step->spring_end at the step's end => heat of the dashpots over the step, J. */
double zp_rod_maxwell_heat(const ZpRodParams *params, const ZpRodEval *start, const ZpRodEval *end, ZpRodStep *step);

#endif
