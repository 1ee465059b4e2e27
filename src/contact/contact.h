/* Contact, at rest and in motion: insulator faces that overlap push each other apart, eq. (9.1), and nothing holds them
 * together. The push begins smoothly, so that a branch of equilibria has no corner where contact begins, and it is
 * integrated inside each element at the same points as the field, so that the two balance point by point. In motion a
 * damper acts between faces that overlap, eq. (9.3): within a step, eq. (9.6), or after it.
 *
 * Stations are pairs of facing nodes, or nodes below a flat face. */
#ifndef ZP_CONTACT_CONTACT_H
#define ZP_CONTACT_CONTACT_H

#include <stdbool.h>
#include <stddef.h>

#include "base/memory.h"
#include "math/level.h"

typedef struct ZpContactParams {
  size_t nodes;                  /* N stations; the first is the clip, which is closed by itself */
  double l;                      /* element length, m */
  double stop;                   /* gap below which the platform is stopped, m; 0: where its faces touch */
  double range;                  /* faces closer than that count as closed, m; zp_contact_range */
  double depth;                  /* delta: overlap at which the push is p_c, m */
  double push;                   /* p_c, N/m */
  double settling;               /* tau_c: what vibrates in contact settles in about that time, s; eq. (18.11) */
  size_t platform, platform_end; /* first and last station of the platform, or the right end: elements between them do
                                    not push */
  ZpLevelEnds level;             /* elements with a level end */
  double flat_length;            /* of its faces, at the gap of each of these, m; of a free end eq. (9.8) */
} ZpContactParams;

/* Range of contact of insulators that are so thick together, m: 0.5 um for 260 um, at least a nanometre. */
double zp_contact_range(double insulation);

/* Loss factor of the layers, as of a soft tape: their damper takes it at the frequency of the layers' own stiffness. */
#define ZP_FACES_LOSS_FACTOR 0.5

/* Forces of faces at some gaps. */
typedef struct ZpContactEval {
  double *push;       /* [N] on each station, N, positive opens */
  double *own, *next; /* [N], [N-1] its derivatives, sign turned: by the station's gap, by the next one's, N/m */
  double *stiffness;  /* [N] by all gaps at once, N/m: 0 where faces do not overlap */
  double *damper;     /* [N] given: of the damper (9.6) within a step, at s = 1, N s/m; 0: it does not act */
} ZpContactEval;

void zp_contact_reserve(const ZpContactParams *params, ZpContactEval *eval, ZpArena *arena);

/* From where to where faces go. */
typedef struct ZpContactSpan {
  const double *start, *end; /* [N] gaps, m; one array: rest */
  double late;               /* share of the push at the end in the mean, 0 to 1; eq. (18.11) */
  double rate;               /* one over the time that they take, 1/s; 0: rest */
} ZpContactSpan;

/* The way between two arrays of gaps in a time h, s; 0: rest. */
ZpContactSpan zp_contact_span(const ZpContactParams *params, const double *start, const double *end, double h);

/* => all of eval: the mean push of the span, its derivatives by the gaps at the end. At rest both ends move: the
 * derivatives are then half of the stiffness. */
void zp_contact_eval(const ZpContactParams *params, const ZpContactSpan *span, const ZpContactEval *eval);

/* Let the damper (9.6) act at station i on relative motions of a mass, kg. */
void zp_contact_damp(const ZpContactParams *params, size_t i, double reduced_mass, const ZpContactEval *eval);

/* (eval, mass of the relative motion of station i, kg) => the share of its velocity that the damper leaves after a time
 * dt. */
double zp_contact_kept(const ZpContactEval *eval, size_t i, double reduced_mass, double dt);

/* zp_contact_kept with the k_c of eq. (9.6), by the gap of the station alone, m. */
double zp_contact_kept_at(const ZpContactParams *params, double gap, size_t i, double reduced_mass, double dt);

/* How many stations from the first clip to the platform are closed, the clip not counted; and is the platform? */
size_t zp_contact_front(const ZpContactParams *params, const double *gap);
bool zp_contact_closed(const ZpContactParams *params, const double *gap);

#endif
