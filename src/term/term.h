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
  double share;              /* of all weight that acts: 1, less on the way to an equilibrium */
  bool faces_pass;           /* faces do not push: they may pass through each other, or contact is sequential */
  const double *v;           /* of an instant: velocities [2 stride] against which the drag acts; else NULL */
  const double *beyond;      /* [2 stride] force of a solved field beyond plates, N/V^2; NULL: there is none */
  const ZpState *paper;      /* of an instant: front and held forces of the paper's Bezier surface; NULL: polyline */
  const double *tension;     /* [edges] tension that a solver foresees, for the stiffness, N; NULL: of the last force */
} ZpSpan;

static inline bool zp_span_is_still(const ZpSpan *span) {
  return span->start == span->end;
}

/* Internal damping time over the span's length; 0 of an instant. */
static inline double zp_span_damping(const ZpModel *model, const ZpSpan *span) {
  return span->h > 0 ? model->internal_damping / span->h : 0;
}

typedef struct ZpTerm {
  const char *name;
  /* Does the model have it? NULL: every model has. */
  bool (*acts)(const ZpModel *model);
  /* What it needs of the start of a span that is not still => eval. May be NULL. */
  void (*begin)(const ZpModel *model, const ZpSpan *span, ZpEval *eval);
  /* F [2 stride] += its force on the nodes, N: over a span the mean that does the work by which its energy changes. */
  void (*force)(const ZpModel *model, const ZpSpan *span, ZpEval *eval, double *F);
  /* At the last force: minus its derivative by the end's coordinates, added to K, or to eval->gaps where it depends on
   * gaps. NULL: there is none, or it is left out. */
  void (*stiffness)(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *eval, ZpBand *K);
} ZpTerm;

#define ZP_TERM(name) extern const ZpTerm zp_term_##name;
#include "term/terms.def"
#undef ZP_TERM

/* F [2 stride] += G. */
void zp_term_add(size_t stride, const double *Gx, const double *Gy, double *F);

/* F [2 stride] += forces of edges on their nodes: R [-s .. stride) on the right ones, the opposite on the left. */
void zp_term_add_edges(const ZpModel *model, const double *Rx, const double *Ry, double *F);

/* Attraction on the Bezier surface at coordinates q, as the front of the state has it => attraction.Fy. */
void zp_bezier_attract(const ZpModel *model, const ZpState *state, const double *q, ZpEval *eval);

#endif
