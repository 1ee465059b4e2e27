/* zipact reproduce: the paper beside our results. */
#include <stdio.h>
#include <unistd.h>

#include "cli.h"
#include "reproduce/reproduce.h"

int cli_reproduce(const Options *o) {
  const char *directory = o->directory ? o->directory : "out/reproduce";
  Progress progress = {.shown = !(o->given & OPTION_QUIET) && isatty(STDERR_FILENO)};
  ZpHooks hooks = cli_hooks(&progress);
  ZpOutcome outcome;
  ZpError err;
  cli_watch_interrupts();
  ZpStatus status = zp_reproduce(directory, &hooks, (o->given & OPTION_QUIET) ? NULL : cli_notice,
                                 (o->given & OPTION_JSON) ? stdout : NULL, &outcome, &err);
  cli_progress_end(&progress);
  if (status != ZP_OK) return cli_fail(&err);
  if (!(o->given & OPTION_JSON) && !(o->given & OPTION_QUIET))
    printf("report: %s/report.html (data beside it)\n", directory);
  if (outcome == ZP_INTERRUPTED) return EXIT_INTERRUPTED;
  return zp_outcome_good(outcome) ? EXIT_DONE : EXIT_NUMERICS;
}
