/* The terminal output of a run. */
#ifndef ZP_CLI_SUMMARY_H
#define ZP_CLI_SUMMARY_H

#include <stdbool.h>

#include "cli.h"

/* Print at most ten numbers of a single run, or a line per case, and the place of the files; `plots`: these include
 * pictures. */
void summary_print(const ZpReport *report, bool plots);

#endif
