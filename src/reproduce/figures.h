/* Pictures of several runs together. */
#ifndef ZP_REPRODUCE_FIGURES_H
#define ZP_REPRODUCE_FIGURES_H

#include "reproduce/runs.h"

/* Draw figs. 6 to 8 in `directory`/plots; the other pictures belong to a single run and are in its folder. `hooks` are
 * called while gnuplot runs. */
ZpStatus zp_figures_draw(const char *directory, const ZpRuns *runs, const ZpHooks *hooks,
                         void (*notice)(const char *message), ZpError *err);

#endif
