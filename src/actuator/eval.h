/* Quantities that follow from a state and are thrown away: work space of the terms, energies, step bounds. */
#ifndef ZP_ACTUATOR_EVAL_H
#define ZP_ACTUATOR_EVAL_H

#include "actuator/assemble.h"
#include "actuator/model.h"
#include "base/end.h"
#include "electro/field_correction.h"

/* Edges of either mechanics; [-s .. edges + s) where the mechanics has it so. */
typedef struct ZpEdges {
  const double *dpx, *dpy, *ux, *uy, *T, *Rx, *Ry;
} ZpEdges;

/* Correction of a solved field to plates, found last at some coordinates; it goes with U^2. */
typedef struct ZpCachedField {
  const double *F;                    /* [2 stride] force, N/V^2; NULL: there is none */
  const double *at;                   /* [2 stride] the coordinates */
  double energy, charge, capacitance; /* co-energy, J/V^2, charge, C/V, and capacitance, F, of one modelled part */
} ZpCachedField;

/* As the state holds it. */
ZpCachedField zp_state_beyond(const ZpModel *model, const ZpState *state);

/* Natural curvature that voltage drives, at the last state, at the start of a span, where a jump of the voltage may
 * have changed it, and at its end. */
enum { ZP_NATURAL_BEFORE, ZP_NATURAL_START, ZP_NATURAL_END, ZP_NATURAL_PLACES };
typedef struct ZpNatural {
  double *kappa[ZP_NATURAL_PLACES]; /* [driven segments] their curvature, 1/m; at the end, part of memory_end */
  double *k0[ZP_NATURAL_PLACES];    /* [stride] that of joints */
  double *rate;                     /* [driven segments] derivative of kappa at the end by the voltage there */
  double *by;                       /* [stride] that of k0 */
  double *Rx, *Ry;                  /* [stride], after an edge more, that of forces of edges, N/V */
} ZpNatural;

/* Work space of the terms, of the start and the end of a span; at rest and at an instant only of its end. */
typedef struct ZpEval {
  const ZpModel *model;
  ZpMassSpringEval spring_start, spring; /* mass_spring */
  ZpRodEval rod_start, rod;
  ZpRodStep rod_step;
  ZpRodParams bent; /* the rod with the natural curvature that acts, */
  double *k0;       /* [stride] which may be this */
  ZpNatural natural;
  ZpSpaceRod space[2];      /* of each ribbon, in space, */
  double *space_gradient;   /* [4 nodes], N, N m, */
  double *space_K;          /* [4 nodes][band] its stiffness */
  size_t *space_coordinate; /* [4 nodes] of its unknowns */
  ZpEdges edges;            /* at the end, of the mechanics in use */
  ZpPlatesEval plates_start, plates;
  ZpPlatesStep attraction;
  ZpPlatesByVoltage by_voltage;
  ZpContactEval faces; /* of unilateral contact */
  ZpFilmEval film;
  ZpLeakEval leak;
  ZpCover cover;                /* where liquid is between the faces, with a bead */
  double reach[ZP_BEADS];       /* wet length over the span, m */
  double *open;                 /* [N] of a step: share of the long edges at a station where liquid can pass */
  double meniscus[ZP_BEADS];    /* head at the meniscus, Pa */
  ZpBead bead_end[ZP_BEADS];    /* where the step ends */
  double *extra_residual;       /* [own N] what is left of the equations of the laws' own unknowns */
  double *memory_end;           /* [kept] state of the laws where the span ends */
  bool solves;                  /* it can solve the field, not only hold what was found */
  ZpFieldCorrection correction; /* where it does */
  const char *fault;            /* why the last attempt to find a held force has failed; NULL: it has not */
  ZpBezierSurface surface;      /* for the free stations; remade when the front moves */
  ZpGapDerivatives gaps;        /* sum of the terms that depend on gaps */
  double (*D)[4];               /* [3 edges] stiffness of edges */
  double *mean_v;               /* [2 stride] of a span, m/s */
  double *by_volume;            /* [2 stride] volume of a pouch by the coordinates, the mean over the span, m^2 */
  double pressure;              /* in it, the mean over the span, Pa */
  double *unused;               /* [2 stride] of forces that are computed for the sake of other laws */
  const double *none;           /* [stride] zeros */
  double drag_power;            /* lost now, W */
  double drag_rate;             /* largest |v| / m, 1 / (kg s/m), from which the drag bound follows */
  void *memory;
} ZpEval;

/* Allocate the arrays of `eval`, without those of single terms; false if there is no memory. */
bool zp_eval_create(const ZpModel *model, ZpEval *eval);
void zp_eval_destroy(ZpEval *eval);

/* Lay the cover: liquid as far as `reach` from each clip, m. Nothing of models without a bead. */
void zp_eval_cover(const ZpModel *model, const double reach[ZP_BEADS], ZpEval *eval);

/* (gaps [N]; what of each bead is outside and lost, NULL: nothing) => wet lengths, m. */
void zp_eval_reach(const ZpModel *model, const double *gap, const ZpBead *bead, double reach[ZP_BEADS]);

/* Correction of a solved field to plates, as it was found last. */
ZpCachedField zp_eval_beyond(const ZpEval *eval);

/* Which stations are closed at these gaps, from the clip on, the clip not counted; the platform is if all are. */
ZpZipState zp_eval_touching(const ZpModel *model, const double *gap);

/* The three bounds of eq. (9) of the paper at the last accelerations, s; INFINITY where nothing moves. */
typedef struct ZpStepBounds {
  double drag, axial, shear;
} ZpStepBounds;
ZpStepBounds zp_eval_step_bounds(const ZpModel *model, const ZpState *state, const ZpEval *eval);

/* Force scale of residuals: the moving weight, at least 1 mN; N. */
double zp_eval_weight_scale(const ZpModel *model);

/* (accelerations under model->pseudo) => largest force left over zp_eval_weight_scale; NAN if any is. */
double zp_eval_imbalance(const ZpModel *model, const double *a);

/* Electric totals of one modelled part at some voltage U; all 0 without electrodes. */
typedef struct ZpElectric {
  double force;       /* N */
  double charge;      /* C */
  double potential;   /* at constant voltage, J: its gradient is the force; charge = -d/dU */
  double capacitance; /* F */
  double passed;      /* of the end of a step: charge that insulators have conducted over it, C */
} ZpElectric;

/* Energy of the field, with what the breakdown cap takes, J. */
static inline double zp_field_energy(ZpElectric electric, double U) {
  return electric.charge * U + electric.potential;
}

#endif
