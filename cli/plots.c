/* zipact plots: the templates of all pictures as files. */
#include <stdio.h>

#include "cli.h"

int cli_plots(const Options *options) {
  ZpError err;
  if (!options->directory) return cli_fail(&(ZpError){ZP_BAD_INPUT, "plots needs a folder to write to: -o FOLDER"});
  if (zp_templates_write(options->directory, &err) != ZP_OK) return cli_fail(&err);
  if (!(options->given & OPTION_QUIET))
    printf("zipact STUDY --templates %s draws with these templates\n", options->directory);
  return cli_flush(EXIT_DONE);
}
