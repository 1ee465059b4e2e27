/* The factor that the paper found between its finite-element force and its plates law, found again the way the
 * paper's authors found it, and the four causes that it is the product of. docs/theory.md, section 15. */
#ifndef ZP_STUDY_BOOKKEEPING_H
#define ZP_STUDY_BOOKKEEPING_H

#include "electro/field.h"

typedef struct ZpPaperFactor {
  double voltage; /* their law takes half of the voltage */
  double half;    /* their expression for the finite-element force lacks the 1/2 */
  double tape;    /* it reads the field in the tape at the metal, not in the liquid */
  double gap;     /* their law's gap is too wide: a sign in it slipped */
} ZpPaperFactor;

/* Solve with the materials of their finite-element model, else as in params, and keep their books. All NAN where that
 * field has no solution. False if there is no memory. */
bool zp_paper_factor(const ZpFieldParams *params, const ZpContact *faces, ZpPaperFactor *factor);

/* Their factor: the product of all. */
double zp_paper_factor_product(const ZpPaperFactor *factor);

#endif
