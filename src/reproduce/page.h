/* report.html: tables and figures of the paper beside ours on one page without other files. */
#ifndef ZP_REPRODUCE_PAGE_H
#define ZP_REPRODUCE_PAGE_H

#include "reproduce/compare.h"

/* The content of the page. */
typedef struct ZpPage {
  const char *directory; /* folder of the pictures */
  const ZpRuns *runs;
  const ZpComparisons *comparisons;
  double wall_time; /* s */
} ZpPage;

void zp_page_write(const ZpPage *page, FILE *file);

#endif
