/* Pictures that show several runs together. */
#ifndef ZP_REPRODUCE_FIGURES_H
#define ZP_REPRODUCE_FIGURES_H

#include "reproduce/runs.h"

/* Draw figs. 6 to 8 into `directory`/plots; others are pictures of a single run and lie with it.
 * `hooks` are asked while gnuplot runs. */
ZpStatus zp_figures_draw(const char *directory, const ZpRuns *runs, const ZpHooks *hooks,
                         void (*notice)(const char *message), ZpError *err);

#endif
