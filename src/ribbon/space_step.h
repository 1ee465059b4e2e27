/* Forces of a rod in space over a time step: they do exactly the work by which its energy changes from one end of the
 * step to the other, whatever the step, and keep the angular momentum; docs/theory.md, section 41. A law of the section
 * that is not quadratic is integrated by three Gauss points. */
#ifndef ZP_RIBBON_SPACE_STEP_H
#define ZP_RIBBON_SPACE_STEP_H

#include "ribbon/space_rod.h"

/* An edge over a step. */
typedef struct ZpSpaceTurn {
  double t[3], normal[3], width[3]; /* means of both ends' unit vectors */
  double vector[3];                 /* mean vector of the edge, m */
  double omega[3];                  /* the change of each unit vector is omega x its mean */
  double change[3];                 /* of t */
  double along;                     /* t . t */
  double over;                      /* 1 / (lengths at both ends times `along`), 1/m2 */
} ZpSpaceTurn;

typedef struct ZpSpaceStep {
  ZpSpaceTurn *turn;  /* [nodes + 1] as the edges of a rod */
  double (*force)[3]; /* [nodes] on the nodes, N */
  double *torque;     /* [nodes - 1] on the edges about their mean tangents, N m */
} ZpSpaceStep;

/* From the rod at the start and the positions of the nodes at the end, and the roll of each edge [nodes - 1]: omega . t
 * => frames and joints at the end, and all of `step`. Joints at the start are known. */
void zp_space_step(const ZpSpaceRodParams *params, const ZpSpaceRod *start, ZpSpaceRod *end, const double *roll,
                   ZpSpaceStep *step);

/* Add a moment that is orthogonal to the mean tangent of edge i to the forces on its nodes, N m. */
void zp_space_bend(size_t edge, const double moment[3], ZpSpaceStep *step);

#endif
