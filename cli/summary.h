/* What a run prints on the terminal. */
#ifndef ZP_CLI_SUMMARY_H
#define ZP_CLI_SUMMARY_H

#include <stdbool.h>

#include "cli.h"

/* Print at most ten numbers of one run, a line per case of several, and where the files are; `plots`: pictures are
 * among them. */
void summary_print(const ZpReport *report, bool plots);

#endif
