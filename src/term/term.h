/* Laws as terms: each is a force by coordinates and voltages, asked over a span of time, with its derivative. Rest is a
 * span of no length: then the same formula is the law at rest. What is asked of a term it answers for its own law only;
 * system/system.c adds them up. */
#ifndef ZP_TERM_TERM_H
#define ZP_TERM_TERM_H

#include "actuator/assemble.h"
#include "actuator/eval.h"

/* What a term is asked about. Coordinates are [2 stride]: all x, then all y. */
typedef struct ZpSpan {
  const double *start, *end; /* coordinates at its start and its end; one array: rest, or an instant */
  double h;                  /* its length, s; 0: rest, or an instant */
  double U0, U1;             /* voltages at its start and its end, V */
  double load;               /* N, mean of the load input, down on the lower platform (one ribbon: the right end) */
  double hung;               /* N, weight that hangs there, along gravity, beyond that of load.mass */
  double hung_at[2];         /* of an instant: coordinates of its node at which its potential energy is 0, m */
  double share;              /* of all weight that acts: 1, less on the way to an equilibrium */
  bool faces_pass;           /* faces do not push: they may pass through each other, or contact is sequential */
  const double *own;         /* of a step: [own N] the laws' own unknowns; else NULL */
  const double *memory;      /* of a step, at its start, or of an instant: [kept] the laws' own state */
  const ZpBead *bead;        /* of a step: [ZP_BEADS] at its start; of an instant: there; NULL: all liquid lies between
                                the faces */
  const double *v0;          /* of a step: velocities at its start [2 stride] */
  const double *w;           /* of a step: mean velocities over the last one [2 stride]; NULL: there was none */
  const double *v;           /* of an instant: velocities [2 stride] against which the drag acts; else NULL */
  ZpHeld beyond;             /* what a solved field has beyond plates; all 0: nothing */
  const ZpState *paper;      /* of an instant: front and held forces of the paper's Bezier surface; NULL: polyline */
  const double *tension;     /* [edges] tension that a solver foresees, for the stiffness, N; NULL: of the last force */
} ZpSpan;

typedef enum ZpSpanEnd { ZP_SPAN_START, ZP_SPAN_END } ZpSpanEnd;

static inline bool zp_span_is_still(const ZpSpan *span) {
  return span->start == span->end;
}

/* Internal damping time over the span's length; 0 of an instant. */
static inline double zp_span_damping(const ZpModel *model, const ZpSpan *span) {
  return span->h > 0 ? model->internal_damping / span->h : 0;
}

/* How a step goes with the voltage at its end; at rest, where both ends have one voltage, only the force is told. */
typedef struct ZpByVoltage {
  double *force;      /* [2 stride] derivative of the mean force by it, N/V */
  double *charge;     /* [2 stride] of the charge at the end by its coordinates, C/m */
  double capacitance; /* of that charge by it, F */
} ZpByVoltage;

typedef struct ZpTerm {
  const char *name;
  /* Does the model have it? NULL: every model has. */
  bool (*acts)(const ZpModel *model);
  /* Work space of its own, beyond the arrays of an eval; false if there is no memory. destroy takes it back, also where
   * nothing was made. Both or neither may be NULL. */
  bool (*create)(const ZpModel *model, ZpEval *eval);
  void (*destroy)(ZpEval *eval);
  /* What it needs of the start of a span that is not still => eval. May be NULL. */
  void (*begin)(const ZpModel *model, const ZpSpan *span, ZpEval *eval);
  /* F [2 stride] += its force on the nodes, N: over a span the mean that does the work by which its energy changes. */
  void (*force)(const ZpModel *model, const ZpSpan *span, ZpEval *eval, double *F);
  /* At the last force: minus its derivative by the end's coordinates, added to K, or to eval->gaps where it depends on
   * gaps. NULL: there is none, or it is left out. */
  void (*stiffness)(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *eval, ZpBand *K);
  /* F [2 stride] += its inertia, beyond the masses of nodes, where the span ends, times accelerations a [2 stride].
   * NULL: none. */
  void (*inertia)(const ZpModel *model, const ZpSpan *span, const ZpEval *eval, const double *a, double *F);
  /* At an instant: sum += the energy that it stores, J. NULL: none. */
  void (*energy)(const ZpModel *model, const ZpSpan *now, ZpEval *eval, ZpEnergies *sum);
  /* Of a span that is not still, at the last force: sum += what it has lost over it, J. NULL: nothing. */
  void (*loss)(const ZpModel *model, const ZpSpan *span, ZpEval *eval, ZpLosses *sum);
  /* At the start or the end of the span, where gaps were found last, and at voltage U: sum += its electric totals.
   * NULL: none. */
  void (*electric)(const ZpModel *model, const ZpSpan *span, const ZpEval *eval, ZpSpanEnd at, double U,
                   ZpElectric *sum);
  /* At the last force, of a step whose voltage at the end is unknown, or at rest: sum += how mean force and charge go
   * with it. NULL: they do not. */
  void (*by_voltage)(const ZpModel *model, const ZpSpan *span, ZpEval *eval, ZpByVoltage *sum);
  /* A force that is held, being too dear to find at every span: find it at coordinates q and voltage U. Where it cannot
   * be, eval->fault says why. NULL: none is held. */
  bool (*solve)(const ZpModel *model, const double *q, double U, ZpEval *eval);
} ZpTerm;

/* F [2 stride] += how the forces go with the weight that hangs there, N/N. */
void zp_weight_by_hung(const ZpModel *model, double *F);

#define ZP_TERM(name) extern const ZpTerm zp_term_##name;
#include "term/terms.def"
#undef ZP_TERM

/* Gaps and, with a bead, where liquid is: at the end of a span, over a step in its middle => eval. */
void zp_term_gaps(const ZpModel *model, const ZpSpan *span, ZpEval *eval);

/* How much of an element's length lies along x where a bead ends, dx/ds, of nodes at x: the field's potential is
 * counted per x, the liquid per length of the ribbons. */
double zp_term_level(const ZpModel *model, const ZpBeadPlace *end, const double *x);

/* Head of the liquid at a meniscus where the gap is g and the film's thickness H, Pa, eq. (22.17): what field and
 * surface draw it on with, as far as bead.suction lets it act. Below 0: suction. And that of the field alone on level
 * ribbons.
 */
double zp_term_meniscus_head(const ZpModel *model, double U, double g, double H, double level);
double zp_term_electric_head(const ZpModel *model, double U, double g, double H);

/* How many terms of rank one a bead at rest has on top of the stiffness's band. */
size_t zp_bead_rank(const ZpModel *model);

/* Share of that head which acts, and its derivative by the wet length, 1/m, eq. (22.17). */
typedef struct ZpRoom {
  double share, by_reach;
} ZpRoom;

/* A meniscus that comes to the middle of the actuator meets that of the other bead, and both vanish: over the last 0.1
 * mm before all is wet its head goes to 0. */
ZpRoom zp_term_meniscus_room(const ZpModel *model, double reach);

/* F [2 stride] += G. */
void zp_term_add(size_t stride, const double *Gx, const double *Gy, double *F);

/* The `loss` of terms of edges: their internal damping over a span, eq. (18.2). The edges are those where the span has
 * ended, a last correction beyond the last force. */
void zp_term_edges_loss(const ZpModel *model, const ZpSpan *span, ZpEval *eval, ZpLosses *sum);

/* F [2 stride] += forces of edges on their nodes: R [-s .. stride) on the right ones, the opposite on the left. */
void zp_term_add_edges(const ZpModel *model, const double *Rx, const double *Ry, double *F);

/* Attraction on the Bezier surface at coordinates q, as the front of the state has it => attraction.Fy. */
void zp_bezier_attract(const ZpModel *model, const ZpState *state, const double *q, ZpEval *eval);

#endif
