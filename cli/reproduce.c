/* zipact reproduce: the paper beside our results. */
#include <stdio.h>
#include <unistd.h>

#include "cli.h"
#include "reproduce/reproduce.h"

int cli_reproduce(const Options *o) {
  const char *directory = o->directory ? o->directory : "out/reproduce";
  Progress progress = {.shown = !o->quiet && isatty(STDERR_FILENO)};
  ZpHooks hooks = cli_hooks(&progress);
  ZpOutcome outcome;
  ZpError err;
  cli_watch_interrupts();
  ZpStatus status =
      zp_reproduce(directory, &hooks, o->quiet ? NULL : cli_notice, o->json ? stdout : NULL, &outcome, &err);
  cli_progress_end(&progress);
  if (status != ZP_OK) return cli_fail(&err);
  if (!o->json && !o->quiet) printf("report: %s/report.html (data beside it)\n", directory);
  if (outcome == ZP_INTERRUPTED) return EXIT_INTERRUPTED;
  return zp_outcome_good(outcome) ? EXIT_DONE : EXIT_NUMERICS;
}
