/* Laws as terms. A term computes a force and its derivative over a span of time from coordinates and voltages. At rest
 * the span has no length, and the same formula is the law at rest. Each term contains its own law only: its force,
 * its state, and the rows of what it stores and loses. system/system.c adds the terms. */
#ifndef ZP_TERM_TERM_H
#define ZP_TERM_TERM_H

#include "actuator/assemble.h"
#include "actuator/eval.h"
#include "def/rule.h"

/* The span of time over which a term is evaluated. Coordinates, velocities and forces of
 * all nodes are arrays that zp_nodes and zp_forces read. */
typedef struct ZpSpan {
  const double *start, *end; /* coordinates at its start and its end; the same array: rest, or an instant */
  double h;                  /* its length, s; 0: rest, or an instant */
  double U0, U1;             /* voltages at its start and its end, V */
  double load;               /* N, mean of the load input, down on the lower platform (one ribbon: the right end) */
  double hung;               /* N, weight that hangs there, along gravity, in addition to that of load.mass */
  double hung_at[2];         /* of an instant: coordinates of its node at which its potential energy is 0, m */
  double share;              /* of all weight and natural curvature that acts: 1, or less while an equilibrium is
                                approached */
  double suction;            /* at rest: share of the suction at menisci that acts, likewise */
  bool faces_pass;           /* no contact force: faces may pass through each other, or contact is sequential */
  const double *own;         /* of a step: [own N] the laws' own unknowns; else NULL */
  const double *memory;      /* of a step, at its start, or of an instant: [kept] the state of all laws; a term finds
                                its own part by zp_law_memory */
  const ZpBead *bead;        /* of a step: [ZP_BEADS] at its start; of an instant: there; NULL: all liquid lies between
                                the faces */
  const double *v0;          /* of a step: velocities at its start */
  const double *w;           /* of a step: mean velocities over the last one; NULL: there was none */
  const double *v;           /* of an instant: velocities against which the drag acts; of an explicit step,
                                whose losses are counted: those at its end; else NULL */
  const double *a;           /* of such a step: accelerations, so v - h/2 a are mean velocities */
  ZpCachedField beyond;      /* difference of a computed field from the plates law; all 0: none */
  const ZpState *paper;      /* of an instant: front and held forces of the paper's Bezier surface; NULL: polyline */
  const double *tension; /* [edges] tension that a solver predicts, for the stiffness, N; in space moments behind them
                            (zp_predicted); NULL: of the last force */
  double pressure, modulus; /* of a pouch: pressure from which that at the end is counted, Pa, which an instant in
                               motion does not have; modulus of eq. (40.6), Pa */
} ZpSpan;

typedef enum ZpSpanEnd { ZP_SPAN_START, ZP_SPAN_END } ZpSpanEnd;

static inline bool zp_span_is_still(const ZpSpan *span) {
  return span->start == span->end;
}

/* Internal damping time over the span's length; 0 for an instant. */
static inline double zp_span_damping(const ZpModel *model, const ZpSpan *span) {
  return span->h > 0 ? model->internal_damping / span->h : 0;
}

/* Derivatives of a step by the voltage at its end; at rest, where both ends have one voltage, only that of the force.
 */
typedef struct ZpByVoltage {
  double *force;      /* derivative of the mean force by this voltage, N/V */
  double *charge;     /* derivative of the charge at the end by the coordinates there, C/m */
  double capacitance; /* derivative of this charge by this voltage, F */
  bool of_charge; /* force is that on electrodes alone, which is U dC/dq at rest: no curvature that voltage drives */
} ZpByVoltage;

typedef struct ZpTerm {
  const char *name;
  bool of_edges;                     /* its stiffness is one of edges, in eval->D */
  const ZpRow *row[ZP_ROWS_OF_TERM]; /* its rows of the ledger, NULL beyond them; several terms may have the same */
  /* How many numbers of state does the term have? They begin at 0. Its force over a step, or its loss, writes those at
   * the end into its part of eval->memory_end. NULL: none. */
  size_t (*state)(const ZpModel *model);
  bool state_at_rest; /* its force at rest, too, writes the state there into eval->memory_end */
  /* Does the model have this term? NULL: every model has it. */
  bool (*acts)(const ZpModel *model);
  /* Allocate the term's own work space, beyond the arrays of an eval, and place what it finds at the end of a span;
   * false if there is no memory. destroy frees it, also if nothing was allocated. Either may be NULL. */
  bool (*create)(const ZpModel *model, ZpEval *eval);
  void (*destroy)(ZpEval *eval);
  /* Compute in eval what the term needs of the start of a span that is not still. May be NULL. */
  void (*begin)(const ZpModel *model, const ZpSpan *span, ZpEval *eval);
  /* F += force on the nodes, N: over a span the mean force, whose work is the change of the term's energy.
   */
  void (*force)(const ZpModel *model, const ZpSpan *span, ZpEval *eval, double *F);
  /* Add minus the derivative of the last force by the coordinates at the end to K, or to eval->gaps if it is by gaps.
   * NULL: it is 0, or omitted. */
  void (*stiffness)(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *eval, ZpBand *K);
  /* F += inertia at the end of the span, beyond the masses of nodes, times accelerations a.
   * NULL: none. */
  void (*inertia)(const ZpModel *model, const ZpSpan *span, const ZpEval *eval, const double *a, double *F);
  /* row[k] += what the term has at an instant in its row k: energy stored, J, or the value of a signal. NULL: none. */
  void (*now)(const ZpModel *model, const ZpSpan *now, ZpEval *eval, double *row);
  /* row[k] += energy lost in its row k over a span, at the last force, J: over a step, or over an explicit step of
   * length span->h, which ends at velocities span->v. NULL: none. */
  void (*loss)(const ZpModel *model, const ZpSpan *span, ZpEval *eval, double *row);
  /* sum += electric totals at the start or the end of the span, with the gaps found last, at voltage U. NULL: none. */
  void (*electric)(const ZpModel *model, const ZpSpan *span, const ZpEval *eval, ZpSpanEnd at, double U,
                   ZpElectric *sum);
  /* sum += derivatives of mean force and charge by the voltage, at the last force: of a step whose voltage at the end
   * is unknown, or at rest. NULL: they are 0. */
  void (*by_voltage)(const ZpModel *model, const ZpSpan *span, ZpEval *eval, ZpByVoltage *sum);
  /* F += derivative of the last force of a still span by a key at fixed coordinates and inputs, N over its unit, in
   * closed form; false: there is none for this key, and F is as it was. The last force is then gone. NULL: there is
   * none for any key. Differences of forces replace it (system/by_key.h). */
  bool (*by_key)(const ZpModel *model, const ZpSpan *span, ZpEval *eval, int key, double *F);
  /* Compute a held force, which is too expensive to compute for every span, at coordinates q and voltage U. If this
   * fails, eval->fault gives the reason. NULL: the term has no held force. */
  bool (*solve)(const ZpModel *model, const double *q, double U, ZpEval *eval);
  /* Combinations of keys that the law refuses. May be empty. */
  ZpRules rules;
} ZpTerm;

/* In space: the moments of joints about the normal, N m => sway [count], after a force; and those that a fraction of a
 * change of all coordinates foresees, to first order. */
void zp_space_take_sway(const ZpModel *model, const ZpEval *eval, double *sway);
void zp_space_predict(const ZpModel *model, const ZpEval *eval, const double *moved, double fraction, double *sway);

/* F += change of the forces by as much of ZpSpan.hung and ZpSpan.load. */
void zp_weight_by_load(const ZpModel *model, double hung, double load, double *F);

#define ZP_TERM(name) extern const ZpTerm zp_term_##name;
#include "term/terms.def"
#undef ZP_TERM

/* Compute in eval the gaps and, with a bead, where the liquid is: at the end of a span, for a step in its middle. */
void zp_term_gaps(const ZpModel *model, const ZpSpan *span, ZpEval *eval);

/* dx/ds of the element in which a bead ends, with nodes at x: the potential of the field is counted per x, the liquid
 * per length of the ribbons. */
double zp_term_level(const ZpModel *model, const ZpBeadPlace *end, const double *x);

/* Head of the liquid at a meniscus where the gap is g and the thickness of the film H, Pa, eq. (22.17): the pull of
 * field and surface, times `suction`. Below 0: suction. The second function is that of the field alone on level
 * ribbons. */
double zp_term_meniscus_head(const ZpModel *model, double suction, double U, double g, double H, double level);
double zp_term_electric_head(const ZpModel *model, double suction, double U, double g, double H);

/* Of a pouch: where a solver keeps its pressure, behind the tensions that it predicts; the pressure that the last force
 * over a span foresees after a fraction of a change of the coordinates [2 stride] at its end, Pa; number of terms of
 * rank one that it adds to the band. */
static inline size_t zp_pressure_place(const ZpModel *model) {
  return model->count - model->s;
}
double zp_pouch_predicted(const ZpModel *model, const ZpSpan *span, const ZpEval *eval, const double *moved,
                          double fraction);
size_t zp_pouch_rank(const ZpModel *model);

/* Scale the heights of a pouch so that its films enclose its liquid again; for a start near a motion. */
void zp_pouch_refill(const ZpModel *model, double *q);

/* The pressure of a pouch in the memory of all laws, Pa; 0 without one. */
double zp_memory_pressure(const ZpModel *model, const double *memory);

/* Number of terms of rank one that a bead at rest adds to the band of the stiffness. */
size_t zp_bead_rank(const ZpModel *model);

/* The share of this head that acts, and its derivative by the wet length, 1/m, eq. (22.17). */
typedef struct ZpRoom {
  double share, by_reach;
} ZpRoom;

/* A meniscus that reaches the middle of the actuator meets that of the other bead, and both vanish: over the last 0.1
 * mm before all is wet its head decreases to 0. */
ZpRoom zp_term_meniscus_room(const ZpModel *model, double reach);

/* F += all inertia of the liquid outside, on pairs and on each outer face, at accelerations a and
 * the gaps found last. */
void zp_term_add_outside(const ZpModel *model, const ZpEval *eval, const double *a, double *F);

/* F += a push, N, that parts the faces of a station: down on the lower or only ribbon, up on the upper one. */
static inline void zp_term_part(const ZpModel *model, size_t station, double push, double *F) {
  const ZpTopology *t = &model->topology;
  double *Fy = zp_forces(model, F).y;
  Fy[zp_lower(t, station)] -= push;
  if (zp_is_pair(t)) Fy[zp_upper(t, station)] += push;
}

/* F += G. */
void zp_term_add(const ZpModel *model, const double *Gx, const double *Gy, double *F);

/* Energy lost to the internal damping of edges over a step, eq. (18.2), J. The edges are those at its end, which is a
 * last correction beyond the last force. */
double zp_term_edges_loss(const ZpModel *model, const ZpSpan *span, ZpEval *eval);

/* F += forces of edges on their nodes: R from -s on on the right ones, the opposite on the left. */
void zp_term_add_edges(const ZpModel *model, const double *Rx, const double *Ry, double *F);

/* Compute in attraction.Fy the attraction on the Bezier surface at coordinates q, with the front of the state. */
void zp_bezier_attract(const ZpModel *model, const ZpState *state, const double *q, ZpEval *eval);

#endif
