/* Forces between bodies in the plane, and on them: weights, constant forces, springs between points, joints. Mean
 * forces over a span, whose work is exactly the change of their energy; at rest both ends of the span are the same.
 * docs/theory.md, section 34. */
#ifndef ZP_SYSTEM_LINKS_H
#define ZP_SYSTEM_LINKS_H

#include "actuator/plane.h"
#include "system/springs.h"

enum { ZP_PULLS = 3 };

/* Points of two bodies, from their centres in the drawing, m. */
typedef struct ZpArms {
  ZpVector arm[2];
} ZpArms;

typedef struct ZpLinks {
  const ZpPlanar *plane;
  size_t inner;              /* the first unknown of the border */
  ZpArms *spring, *joint;    /* [springs], [joints] */
  double stiffness;          /* of joints, N/m: that of an edge of the stiffest strip */
  double (*pull)[ZP_PULLS];  /* [joints] forces and torque that the last step predicted, N and N m, with which the next
                                stiffness begins: those of joints that it has bent would turn bodies back */
  double (*push)[ZP_WAYS];   /* [bodies] forces at their places and torques that a program sets, N, N m */
  double (*found)[ZP_PULLS]; /* [joints] those of the last forces */
  double *strain;            /* [springs] elastic shift of those that rub at the start of a span, m */
} ZpLinks;

/* False if there is no memory. */
bool zp_links_create(const ZpPlanar *plane, size_t inner, ZpLinks *links);
void zp_links_destroy(ZpLinks *links);

/* f [n] += mean forces over a span of the poses [bodies], of which `share` acts, of joints all. One array: rest. */
void zp_links_add_force(ZpLinks *links, double share, const ZpPose *from, const ZpPose *to, double *f);

/* D += minus their derivative by the unknowns at the end, of both ends where `still`. */
void zp_links_add_stiffness(const ZpLinks *links, double share, const ZpPose *from, const ZpPose *to, bool still,
                            ZpSparse *D);

/* Predict the pull of joints after a fraction of a step [n]; take those of the last forces. */
void zp_links_predict(ZpLinks *links, const ZpPose *pose, const double *step, double fraction);
void zp_links_take(ZpLinks *links);

/* Friction: its strains [springs] where a rest begins to move, those that it can bear there; over a span the strains at
 * its end => what has slid takes, J, eq. (34.9). */
void zp_links_hold(const ZpLinks *links, const ZpPose *pose, double *strain);
double zp_links_slide(const ZpLinks *links, const ZpPose *from, const ZpPose *to, double *strain);

/* e [n] += errors of unknowns where a body slides over a span of length h that begins at rates [n] and comes back
 * within it: the way back, over which friction acts the other way, eq. (34.11). */
void zp_links_add_overshoot(const ZpLinks *links, const ZpPose *from, const ZpPose *to, const double *rate, double h,
                            double *e);

/* Energy of springs, with the strains [springs] of those that rub, and joints; of weights and constant forces of
 * bodies, 0 in the drawing; of the weight of a member's ribbons, whose nodes it sees, 0 where they are straight there,
 * J. */
double zp_links_energy(const ZpLinks *links, const ZpPose *pose, const double *strain);
double zp_links_weight_energy(const ZpLinks *links, const ZpPose *pose);
double zp_links_ribbons_energy(const ZpLinks *links, size_t member, const ZpPose *pose, const double *nodes);

/* Weight of the ribbons of a member, which its frame turns, at rest: r [n] += forces on its nodes and on its upper
 * body; K += minus their derivative. `nodes`: where it sees its nodes. */
void zp_links_add_weight(const ZpLinks *links, size_t member, double share, const ZpPose *pose,
                         const ZpAssembly *assembly, const double *nodes, double *r);
void zp_links_add_weight_stiffness(const ZpLinks *links, size_t member, double share, const ZpPose *pose,
                                   const ZpAssembly *assembly, const double *nodes, ZpBand *K);

#endif
