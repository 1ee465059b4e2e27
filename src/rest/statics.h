/* An actuator at rest as a static system: its equations, forces, exact stiffness, and moves of its coordinates.
 * Contact is unilateral; the clip is joined. The lower platform hangs free or is held at an opening. */
#ifndef ZP_REST_STATICS_H
#define ZP_REST_STATICS_H

#include "actuator/assemble.h"
#include "actuator/heights.h"
#include "actuator/shape.h"
#include "solve/continuation.h"
#include "system/links.h"
#include "system/springs.h"
#include "system/system.h"

/* One of the actuators of the system. */
typedef struct ZpRestMember {
  const ZpModel *model;
  ZpEval eval;
  double *q; /* [2 stride] the present point */
  ZpAssembly assembly;
  double *tension;            /* [edges] tension that the last step predicted, N */
  double *moved;              /* [2 stride] work space of a move */
  double *rotation, *stretch; /* [edges] by the last step that was examined, rad, m */
  double *force;              /* [2 stride] */
  double *good;               /* [2 stride] the last equilibrium while weight, curvature or opening are applied, */
  double good_pressure;       /* with the pressure of a pouch, Pa */
  double modulus;             /* with which its volume is held, eq. (40.6), Pa */
  double closed;              /* gap at which it counts as closed, m; zp_quasistatic_start */
  bool idle;                  /* of a series, whose members are at rest each by itself: it stays where it is, */
  bool falls;                 /* unless it is far from an equilibrium */
} ZpRestMember;

typedef struct ZpStatics {
  const ZpModel *model; /* the given one: the first of its members */
  size_t members;       /* actuators that are one system */
  ZpRestMember *member; /* [members]; from the uppermost down */
  bool shared;          /* they have one load: its height is an unknown of all */
  bool linked;          /* of a series: heights of its links are unknowns of all; else each has its own frame */
  bool has_load;        /* one body has the load, whose mass is a parameter; in a network each has its own */
  ZpHeights heights;    /* of the bodies that members join */
  ZpSprings springs;    /* between bodies */
  ZpPlanar plane;       /* of bodies that move in the plane, */
  ZpLinks links;        /* what joins them, */
  ZpPose *pose;         /* [bodies] where they are at the present point, */
  ZpPose *good;         /* and at the last equilibrium */
  ZpPose *place;        /* [bodies] work space */
  bool posed;           /* bodies stay where they are in the drawing, while a start is sought */
  double *way, *below;  /* [bodies] work space */
  double *at;           /* [n] the present unknowns, where springs act; work space */
  size_t n;             /* equations of all */
  ZpArrowForm form; /* of the stiffness; with a bead also terms of low rank, because all forces depend on its reach */
  ZpParts parts;
  double U;            /* of the first member, V */
  const double *ports; /* [members] voltages of ports, by their first members, V; NULL: all slow ones follow U */
  bool biased;         /* a member has a constant voltage of its own, */
  double bias;         /* and the share of it that acts */
  double own_load;     /* load.mass, kg */
  double load;         /* mass hung on all members, kg; starts as that */
  double force;        /* load.force, N */
  double share;        /* share of weight and natural curvature that acts: 1, or less while they are applied */
  double suction;      /* share of the suction at menisci that acts: 1, or less while it is applied */
  bool opposed;        /* they are antagonists */
  double nearer;       /* share of the opening, and of the distance of mounts: 1, or less while it is approached */
  double from, taken;  /* of a pouch: opening at which it hangs, m; share of the way from there: 1, or less */
  double tight;        /* force that pulls its held end down while it hangs, N, one part */
  ZpTie held;          /* the row of a held platform, */
  double opening;      /* and its input, m; NAN: it does not act */
  double reaction;     /* force that holds it there, N, one part, positive downwards; of the last residual */
  double careful;      /* factor by which steps of a fall are shorter */
  bool contact_acts;   /* faces push on each other; if false they may pass through each other (to find a start) */
  double scale;        /* force that a residual is relative to, N */
  ZpNewtonWork newton; /* work space of Newton's method: the last stiffness, mostly factored, and unbalanced forces */
  double (*spare)[4];  /* [3 edges] work space */
  double *row;         /* [n] of the last stiffness while the platform was held: its row as if it were free */
  bool (*stop)(const void *caller); /* called now and then; true stops. NULL: none */
  const void *caller;
  int unasked;  /* residuals since `stop` was called */
  bool stopped; /* `stop` returned true: from then on no residual is computed */
  void *memory, *solution;
} ZpStatics;

/* Allocate and start straight, without voltage. `held`: the end of a series may be held, so that the force in its links
 * is not known. False if there is no memory. */
bool zp_statics_create(const ZpModel *model, bool held, ZpStatics *statics);
void zp_statics_destroy(ZpStatics *statics);

/* The straight shape, in which all coordinates of nodes are known. */
void zp_statics_lay_straight(ZpStatics *statics);

/* Call `stop`. After it has returned true once, the answer stays true. */
bool zp_statics_asked_to_stop(ZpStatics *statics);

/* The vtable for solve/newton.h. */
ZpStaticSystem zp_statics_system(ZpStatics *statics);

/* From the present point to an equilibrium nearby, by at most `most` steps of Newton's method. */
ZpNewtonInfo zp_statics_solve(ZpStatics *statics, int most);

/* The static system with a parameter: the voltage; its square, to which forces are proportional, while along the
 * voltage itself nothing moves at first (the voltage, where it drives curvature by its sign); or the load. */
typedef enum ZpAlong { ZP_ALONG_VOLTAGE, ZP_ALONG_SQUARE, ZP_ALONG_LOAD } ZpAlong;
ZpBranchSystem zp_statics_branch(ZpStatics *statics, ZpAlong along);

/* The present point of a member as a span, with the inputs there. */
ZpSpan zp_statics_span(const ZpStatics *statics, size_t which);

/* Does a study hold the platform? */
static inline bool zp_statics_holds(const ZpStatics *statics) {
  return !isnan(statics->opening);
}

/* 1 where a force on the coordinate of a held platform lifts it, -1 where it is along the film of a pouch. */
static inline double zp_statics_lifts(const ZpStatics *statics) {
  return statics->held.by_input < 0 ? 1 : -1;
}

/* How far a held platform is from where it is held, m; 0: it is free. */
double zp_statics_away(const ZpStatics *statics);

/* The equation of a held platform takes the place of its balance in a derivative r_m [n] of the residual, with the
 * derivative of that distance. => derivative of the force that holds it; 0: it is free. */
double zp_statics_hold_rate(const ZpStatics *statics, double away, double *r_m);

/* Derivative of the forces by the voltage, at voltage U and the last residual => r_m [n], N/V. */
void zp_statics_by_voltage(ZpStatics *statics, double U, double *r_m);

/* That by the voltage of a port alone, by its first member, if it were U. */
void zp_statics_by_port(ZpStatics *statics, size_t lead, double U, double *r_m);

/* The forces of the present point, and the tensions of the exact stiffness there. */
void zp_statics_evaluate(ZpStatics *statics);

/* The exact stiffness of the present point, not factored; the damping of the strips there, N s/m => newton.K. */
void zp_statics_exact_stiffness(ZpStatics *statics);
void zp_statics_internal_damping(ZpStatics *statics);

/* The tensions of the last residual become those with which the next stiffness begins. */
void zp_statics_take_tensions(ZpStatics *statics);

/* Where members that share a load have it at different heights, put it at that of the first one; of antagonists the one
 * that is more open follows, since closed faces would be parted. Linked ones hang on each other again. */
void zp_statics_rejoin(ZpStatics *statics);

/* Is the present equilibrium stable? For a rod: the stiffness has no negative eigenvalue. For mass_spring, whose shear
 * law makes it unsymmetric: its determinant, which changes its sign at a limit point, is not negative. The stiffness is
 * then factored. */
bool zp_statics_stable(ZpStatics *statics);

/* u' K u at the present point for a direction u [n], of edges one by one (zp_edges_along), with the predicted tensions.
 * K and r [n] are work space. */
double zp_statics_stiffness_along(ZpStatics *statics, const double *u, ZpArrow *K, double *r);

/* Tolerance of the residual: 1e-3 of solver.tolerance, or what rounding of positions in stiff edges leaves. */
double zp_statics_tolerance(const ZpStatics *statics);

/* From the present point to the equilibrium in which the actuator hangs without voltage. Faces may pass through each
 * other during the search, but not in the result. */
ZpNewtonInfo zp_statics_find_rest(ZpStatics *statics);

/* Then apply the constant voltages that members have of their own. False if the branch ends before. */
bool zp_statics_bias(ZpStatics *statics);

/* As zp_statics_bias, while the platform is held. Where the branch ends, the members jump to the next one, as
 * isometric's voltage does: then *jumped becomes true. False if one of these falls does not converge. */
bool zp_statics_bias_held(ZpStatics *statics, bool *jumped);

/* Why there is no equilibrium at which a voltage could begin to rise, where the search for it has ended. */
enum { ZP_NO_REST_SIZE = 256 };
const char *zp_statics_no_rest(ZpStatics *statics, char text[ZP_NO_REST_SIZE]);

/* Which body in the plane has left its place by far in that search, as nothing stops it, in a sentence; NULL: none. */
const char *zp_statics_fallen(ZpStatics *statics, char text[ZP_NO_REST_SIZE]);

/* From the hanging equilibrium up to `voltage` on the hanging branch, to within a millionth of its end. False if the
 * branch ends before, at the pull-in, or if the field cannot be solved (zp_statics_trouble). */
bool zp_statics_ramp_voltage(ZpStatics *statics, double voltage);

/* From now on hold the lower platform of two ribbons at `opening` (below 2 L), or the right end of a fold's lower
 * ribbon as far below its hinge (below L), without load and voltage. Go from the straight shape to the equilibrium
 * there. */
ZpNewtonInfo zp_statics_hold(ZpStatics *statics, double opening);

/* A pouch is held where nothing is zipped. Follow the equilibria from there to where it is to be held, and call
 * `passed` at each. False if the branch ends before. */
bool zp_statics_take_up(ZpStatics *statics, void (*passed)(void *user), void *user);

/* Places of all bodies at the present point [bodies], and their angles, as they are given in the drawing; valid until
 * the next call. */
const ZpPose *zp_statics_places(ZpStatics *statics);

/* 1, or -1 of a lower antagonist: upside down, its platform falls as the load rises. */
double zp_statics_factor(const ZpStatics *statics, size_t which);

/* The equation of the lower platform's height. */
size_t zp_statics_platform(const ZpStatics *statics);

/* Force that holds the platform at the present point, an equilibrium, N, one part, positive downwards: `reaction`, plus
 * what a last step of Newton's method would add. Rounding of positions causes forces in stiff edges that no step
 * between rounded positions can remove; the last step accounts for them. */
double zp_statics_holding(ZpStatics *statics);

/* From the straight shape, in which all faces of two ribbons are closed, to a stable equilibrium at `voltage`. */
ZpNewtonInfo zp_statics_close(ZpStatics *statics, double voltage);

/* From the present point, which may be far from an equilibrium, to the equilibrium at `voltage` in which slow motion
 * against a resistance ends. If it succeeds, the equilibrium is stable. */
ZpNewtonInfo zp_statics_relax(ZpStatics *statics, double voltage);

/* Relax at the present voltage, at most until `enough(user)` is true at the present point. */
ZpNewtonInfo zp_statics_relax_until(ZpStatics *statics, bool (*enough)(void *user), void *user);

/* The present point: height of the clip or clamp over the right end of the lower or only ribbon, signed, m; distance
 * between the platforms' faces, m (NAN for one ribbon), both in series of all members together; angle of a fold, rad
 * (NAN without a hinge); number of closed stations from the clip, without the clip. */
double zp_statics_stroke(const ZpStatics *statics);
double zp_statics_opening(const ZpStatics *statics);
double zp_statics_angle(const ZpStatics *statics);

/* In space: how far the middle of the lower or right end has moved along z, m; by how much its width is turned about x
 * out of the direction of z, rad, positive where the side at positive z is lower. */
double zp_statics_lateral(const ZpStatics *statics);
double zp_statics_skew(const ZpStatics *statics);
size_t zp_statics_front(const ZpStatics *statics);

/* Do electrodes without an insulator touch at the present voltage? */
bool zp_statics_shorted(const ZpStatics *statics);

/* u' K u of a branch of layers that creep, of a motion u [n] about the last state, while nothing has relaxed, N m: of
 * the metal (0) or the tapes (1) of all members. */
double zp_statics_relaxing_along(ZpStatics *statics, const double *u, size_t branch);

/* Moving masses by equations => mass [n], kg. */
void zp_statics_masses(const ZpStatics *statics, double *mass);

/* The mass matrix times u => mu, both [n]; members in series are each in the frame of the platform that they hang on.
 * `statics` is a ZpStatics. */
void zp_statics_weigh(void *statics, const double *u, double *mu);

/* Closed length of one half, from the clip, m: of members that share a load what is closed in all of them, of
 * antagonists that of the upper one; in series their sum. */
double zp_statics_closed_length(const ZpStatics *statics);

/* Of a member: voltage, V; capacitance, F; stroke, opening, closed length, m; force with which it pulls the load up at
 * the present point, N. */
double zp_statics_member_voltage(const ZpStatics *statics, size_t which);
double zp_statics_member_capacitance(const ZpStatics *statics, size_t which);
double zp_statics_member_stroke(const ZpStatics *statics, size_t which);
double zp_statics_member_opening(const ZpStatics *statics, size_t which);
double zp_statics_member_closed(const ZpStatics *statics, size_t which);
double zp_statics_member_force(ZpStatics *statics, size_t which);

/* Restoring force per displacement of the load at the present point, of the whole actuators, N/m; NAN if the stiffness
 * is singular. */
double zp_statics_load_stiffness(ZpStatics *statics);

/* The reason why the last solution of the field failed; NULL if it succeeded or no field was solved. */
const char *zp_statics_trouble(const ZpStatics *statics);

/* The reason why the present point is impossible: the faces overlap by more than two ranges of contact, 2 % of their
 * insulators and three times the overlap that their attraction alone causes, or the capacitance exceeds that of closed
 * faces. NULL if there is none. Of the last residual. */
const char *zp_statics_fault(const ZpStatics *statics);

/* Do the faces of a member cross each other, by more than they may? */
bool zp_statics_faces_cross(const ZpStatics *statics);

/* As zp_statics_fault, without faces that cross each other where ribbons are steep. Points on the way of a branch may:
 * coarse meshes have such points beside right answers. */
const char *zp_statics_fault_of_stations(const ZpStatics *statics);

/* The present point: charge and capacitance of the whole actuator's electrodes, C, F. */
double zp_statics_charge(const ZpStatics *statics);
double zp_statics_capacitance(const ZpStatics *statics);

/* The present shape of a member, stored in `room` with any `time`; valid until the point moves. */
ZpShape zp_statics_shape(const ZpStatics *statics, size_t which, double time, ZpShapeRoom room);

#endif
