/* zipact keys. */
#include <stdio.h>

#include "cli.h"

int cli_keys(const Options *options) {
  if (options->json && options->yaml)
    return cli_fail(&(ZpError){ZP_BAD_INPUT, "keys: give --json or --yaml, not both"});
  ZpKeysFormat format = options->json ? ZP_KEYS_JSON : options->yaml ? ZP_KEYS_YAML : ZP_KEYS_TEXT;
  ZpError err;
  if (zp_keys_write(format, stdout, &err) != ZP_OK) return cli_fail(&err);
  return EXIT_DONE;
}
