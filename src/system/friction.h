/* Dry friction between two faces that push each other: each point of contact shifts elastically until its force is
 * friction times the push, and slides beyond that. docs/theory.md, eqs. (34.8) to (34.10). */
#ifndef ZP_SYSTEM_FRICTION_H
#define ZP_SYSTEM_FRICTION_H

/* A contact over a span, in which the gap and the place change in proportion. */
typedef struct ZpRub {
  double friction; /* coefficient */
  double strain;   /* elastic shift at the start, m */
  double moved;    /* way of the second face across the push, m */
  double gap[2];   /* at start and end, m; below 0 the faces push each other */
} ZpRub;

/* Forces and energies are these times the stiffness, which is that of the push. */
typedef struct ZpFriction {
  double mean;             /* mean strain over the span, m: its work is stored or lost */
  double end;              /* strain at the end, m */
  double by_moved, by_gap; /* derivatives of the mean by `moved` and by the gap at the end */
  double lost;             /* m2: what slides takes, 0 or more */
} ZpFriction;

ZpFriction zp_friction(const ZpRub *rub);

/* The strain that friction can bear at a gap, m. */
double zp_friction_bound(double friction, double gap);

#endif
