/* report.html: the paper's tables and figures beside ours on one page that needs nothing else. */
#ifndef ZP_REPRODUCE_PAGE_H
#define ZP_REPRODUCE_PAGE_H

#include "reproduce/compare.h"

/* What the page is made of. */
typedef struct ZpPage {
  const char *directory; /* of the pictures */
  const ZpRuns *runs;
  const ZpComparisons *comparisons;
  double wall_time; /* s */
} ZpPage;

void zp_page_write(const ZpPage *page, FILE *file);

#endif
