/* Springs between the bodies of a network: force, energy and stiffness, in the unknowns of the border, where the
 * heights of their bodies are. docs/theory.md, section 32. */
#ifndef ZP_SYSTEM_SPRINGS_H
#define ZP_SYSTEM_SPRINGS_H

#include "actuator/assemble.h"

/* Where the height of a body is: an unknown of the system, or a constant. */
typedef struct ZpBodyHeight {
  bool held;
  size_t equation;
  double factor, offset; /* height = factor unknown + offset, m */
} ZpBodyHeight;

/* How much longer a spring is than at rest where it acts, m, negative where it is shorter; its energy, of the whole
 * actuators, J. `length`: the difference of the heights of its bodies, m. */
static inline double zp_link_deformed(const ZpLink *link, double length) {
  const double longer = length - link->rest;
  if (link->kind == ZP_SPRING_PULL) return longer > 0 ? longer : 0;
  return link->kind == ZP_SPRING_PUSH && longer > 0 ? 0 : longer;
}

/* Has it a stiffness at this length? */
static inline bool zp_link_acts(const ZpLink *link, double length) {
  return link->kind == ZP_SPRING_BOTH || zp_link_deformed(link, length) != 0;
}

/* Mean pull over a span between two lengths, N, whose work is the decrease of the energy, and its derivative by the
 * length at the end (of both lengths where `still`), N/m. */
typedef struct ZpPull {
  double mean, slope;
} ZpPull;
ZpPull zp_link_pull(const ZpLink *link, double before, double after, bool still);

static inline double zp_link_energy(const ZpLink *link, double length) {
  const double way = zp_link_deformed(link, length);
  return 0.5 * link->stiffness * way * way;
}

typedef struct ZpSprings {
  const ZpModel *first;
  size_t count;         /* 0: there are none, and nothing else is used */
  ZpBodyHeight *height; /* [bodies]; NULL: no body is named */
} ZpSprings;

/* Of a system whose equations have been numbered, by the assemblies of its members. False if there is no memory. */
bool zp_springs_create(const ZpModel *first, ZpAssembly *const assembly[], ZpSprings *springs);
void zp_springs_destroy(ZpSprings *springs);

/* The mean force over a span between these unknowns [n], of one part of the actuators: added to f [n], N. Its work is
 * the decrease of the energy. At rest both are the same. `share` of it acts: 1, or less while a rest is sought. */
void zp_springs_add_force(const ZpSprings *springs, double share, const double *start, const double *end, double *f);

/* Minus its derivative by the unknowns at the end (of both ends where `still`), added to D, which begins with unknown
 * `inner`. */
void zp_springs_add_stiffness(const ZpSprings *springs, double share, const double *start, const double *end,
                              bool still, size_t inner, ZpSparse *D);

/* Forces upwards on bodies [bodies], N, added to f [n]. */
void zp_springs_add_push(const ZpSprings *springs, const double *push, double *f);

/* Height of a body by the unknowns [n], m. */
double zp_springs_height(const ZpSprings *springs, size_t body, const double *at);

/* Their energy, of one part, J. */
double zp_springs_energy(const ZpSprings *springs, const double *at);

#endif
