/* Equations of an actuator: which coordinate has which, and how the stiffnesses of edges and stations go into a banded
 * matrix over them; where each goes is found once. Coordinate x of node j is at [2 j], y at [2 j + 1]; -1: held. */
#ifndef ZP_REST_ASSEMBLE_H
#define ZP_REST_ASSEMBLE_H

#include "actuator/model.h"
#include "math/band.h"

/* Kinds of second derivatives. */
typedef enum ZpTermList {
  ZP_EDGES,       /* D[3 j + m] [4] = -dR_j / d(edge j + (m - 1) s), as of zp_rod_stiffness, row by row */
  ZP_OWN,         /* [N] by the gap of a station */
  ZP_NEXT,        /* [N - 1] by that and the gap of the next station */
  ZP_ALONG_LEFT,  /* [N - 1] by an element's mean x-length and the gap of its left station */
  ZP_ALONG_RIGHT, /* [N - 1] and of its right one */
  ZP_TERM_LISTS
} ZpTermList;

/* The derivative `from` goes to `place` of the matrix, times `weight`. */
typedef struct ZpTerm {
  int place, from;
  double weight;
} ZpTerm;

typedef struct ZpTerms {
  size_t count;
  ZpTerm *term;
} ZpTerms;

typedef struct ZpAssembly {
  size_t n;         /* equations */
  size_t bandwidth; /* diagonals above the main one, and below: node i meets nodes i - 2 .. i + 2 */
  bool symmetric;   /* only the upper triangle is kept */
  int *equation;    /* [2 count] numbered station by station; the clip's two nodes share theirs */
  ZpTerms list[ZP_TERM_LISTS];
  ZpTerm *terms; /* of all lists */
} ZpAssembly;

/* False if there is no memory. */
bool zp_assembly_create(const ZpModel *model, bool symmetric, ZpAssembly *assembly);
void zp_assembly_destroy(ZpAssembly *assembly);

/* Add the derivatives of one kind to K, which is n x n with `bandwidth` diagonals on each kept side. */
void zp_assemble(const ZpAssembly *assembly, ZpTermList list, const double *derivatives, ZpBand *K);

#endif
