/* An actuator at rest as a static system: equations numbered, forces, exact stiffness, and how to move.
 * Contact is unilateral; the clip is joined. The lower platform hangs free or is held at an opening. */
#ifndef ZP_REST_STATICS_H
#define ZP_REST_STATICS_H

#include "actuator/assemble.h"
#include "actuator/shape.h"
#include "solve/continuation.h"
#include "system/system.h"

typedef struct ZpStatics {
  const ZpModel *model; /* the one given, with natural turns as far as they are put on, and overlapping faces closed */
  ZpEval eval;
  double *q;         /* [2 stride] the present point */
  double U;          /* V */
  double load;       /* mass hung on the actuator, kg; starts as load.mass */
  double share;      /* of all weight and natural curvature that acts: 1, less on the way there */
  const double *k0;  /* [stride] natural 2 tan(phi / 2) of joints, of all natural curvature */
  double *k0_now;    /* and of what acts */
  double opening;    /* at which the lower platform, or the end of a fold below its hinge, is held, m; NAN: free */
  double held_at;    /* that opening in the end, on the way there, m */
  double reaction;   /* what holds it there, N, one part, positive downwards; of the last residual */
  bool contact_acts; /* faces push on each other; without, they may pass (to find a start) */
  ZpAssembly assembly;
  ZpBandForm form;            /* of the stiffness; with a bead, whose reach all forces go with, low ranks on top */
  double scale;               /* force that a residual is relative to, N */
  double *tension;            /* [edges] what the last step foresaw, N */
  double *moved;              /* [2 stride] work space of a move */
  double *rotation, *stretch; /* [edges] under the last step that was looked at, rad, m */
  double *force;              /* [2 stride] */
  double *good;               /* [2 stride] the last equilibrium on that way */
  bool (*stop)(void *caller); /* asked now and then: stop there? NULL: nobody is asked */
  void *caller;
  int unasked;  /* residuals since it was asked */
  bool stopped; /* it said so: from then on no residual is found */
  void *memory;
} ZpStatics;

/* Allocate and start straight, without voltage. False if there is no memory. */
bool zp_statics_create(const ZpModel *model, ZpStatics *statics);
void zp_statics_destroy(ZpStatics *statics);

/* Ask whether to stop. Once it is said, it holds. */
bool zp_statics_asked_to_stop(ZpStatics *statics);

/* The vtable for solve/newton.h. */
ZpStaticSystem zp_statics_system(ZpStatics *statics);

/* The same with the voltage or the load as parameter. */
typedef enum ZpAlong { ZP_ALONG_VOLTAGE, ZP_ALONG_LOAD } ZpAlong;
ZpBranchSystem zp_statics_branch(ZpStatics *statics, ZpAlong along);

/* At the last residual: how the forces go with the voltage at voltage U => r_m [n], N/V. */
void zp_statics_by_voltage(ZpStatics *statics, double U, double *r_m);

/* Does it stay there when pushed? Of a rod: no negative eigenvalue of the stiffness; of mass_spring, whose shear law
 * makes it unsymmetric: no negative determinant, which changes its sign at a limit point. Leaves the stiffness
 * factored. */
bool zp_statics_stable(ZpStatics *statics, ZpNewtonWork *work);

/* u' K u at the present point, of a direction u [n], edge by edge (zp_edges_along); the tensions are those foreseen. K
 * and r [n] are work space. */
double zp_statics_stiffness_along(ZpStatics *statics, const double *u, ZpBand *K, double *r);

/* Residual that is asked for: 1e-3 of solver.tolerance, or what rounding of positions in stiff edges leaves. */
double zp_statics_tolerance(const ZpStatics *statics);

/* From the present point to the equilibrium without voltage, the actuator hanging. Faces may pass through
 * each other on the way, but not in the end. */
ZpNewtonInfo zp_statics_hang(ZpStatics *statics, ZpNewtonWork *work);

/* From the hanging equilibrium up to `voltage` on the branch that hangs, to within a millionth of its end. False if
 * that ends before, at the pull-in, or the field cannot be solved (zp_statics_trouble). */
bool zp_statics_raise(ZpStatics *statics, double voltage, ZpNewtonWork *work);

/* Hold the lower platform of two ribbons at `opening` (below 2 L), or the right end of a fold's lower ribbon as far
 * below its hinge (below L), without load and voltage, ever after; from the straight shape to the equilibrium there. */
ZpNewtonInfo zp_statics_hold(ZpStatics *statics, double opening, ZpNewtonWork *work);

/* Put the lower platform of a half at a height; what it moves is spread along the ribbons. */
void zp_statics_put_platform(ZpStatics *statics, double height);

/* The equation of the lower platform's height. */
size_t zp_statics_platform(const ZpStatics *statics);

/* What holds the platform at the present point, an equilibrium, N, one part, positive downwards: `reaction` and what a
 * last step of Newton's method would add. Positions are rounded, stiff edges make forces of that, and no step of
 * rounded ones takes them away. K and r are left with no meaning. */
double zp_statics_holding(ZpStatics *statics, ZpNewtonWork *work);

/* From the straight shape, which of two ribbons has all faces closed, to a stable equilibrium at `voltage`. */
ZpNewtonInfo zp_statics_close(ZpStatics *statics, double voltage, ZpNewtonWork *work);

/* From the present point, where there may be no equilibrium near, to the one in which slow motion against a resistance
 * ends at `voltage`. A good end is stable. */
ZpNewtonInfo zp_statics_fall(ZpStatics *statics, double voltage, ZpNewtonWork *work);

/* The same at the present voltage, at most until `enough` (of `user`) is true of the present point. */
ZpNewtonInfo zp_statics_fall_until(ZpStatics *statics, bool (*enough)(void *user), void *user, ZpNewtonWork *work);

/* The present point: how far the right end of the lower or only ribbon is below the clip or clamp, signed, m; distance
 * of the platforms' faces (NAN for one ribbon); angle of a fold, rad (NAN without a hinge); how many stations from the
 * clip on are closed, the clip not counted. */
double zp_statics_stroke(const ZpStatics *statics);
double zp_statics_opening(const ZpStatics *statics);
double zp_statics_angle(const ZpStatics *statics);
size_t zp_statics_front(const ZpStatics *statics);

/* Do electrodes without an insulator touch under the present voltage? */
bool zp_statics_shorted(const ZpStatics *statics);

/* Why the field could not be solved where it was tried last; NULL if it was, or is not asked for. */
const char *zp_statics_trouble(const ZpStatics *statics);

/* Why the present point cannot be: faces overlap by more than 1 um, 1 % of their insulators and three times what their
 * attraction alone makes of it, or the capacitance exceeds that of closed faces. NULL if nothing speaks against it. Of
 * the last residual. */
const char *zp_statics_fault(const ZpStatics *statics);

/* The present point: charge and capacitance of the whole actuator's electrodes, C, F. */
double zp_statics_charge(const ZpStatics *statics);
double zp_statics_capacitance(const ZpStatics *statics);

/* The present shape, `time` being any mark; valid until the point moves; `room` is filled. */
ZpShape zp_statics_shape(const ZpStatics *statics, double time, const ZpShapeRoom *room);

#endif
