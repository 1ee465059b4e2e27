/* zipact keys, zipact schema. */
#include <stdio.h>

#include "cli.h"

static int print_keys(ZpKeysFormat format) {
  ZpError err;
  return zp_keys_write(format, stdout, &err) == ZP_OK ? EXIT_DONE : cli_fail(&err);
}

int cli_keys(const Options *options) {
  const bool json = options->given & OPTION_JSON, yaml = options->given & OPTION_YAML;
  if (json && yaml) return cli_fail(&(ZpError){ZP_BAD_INPUT, "keys: give --json or --yaml, not both"});
  return print_keys(json ? ZP_KEYS_JSON : yaml ? ZP_KEYS_YAML : ZP_KEYS_TEXT);
}

int cli_schema(const Options *options) {
  (void)options;
  return print_keys(ZP_KEYS_SCHEMA);
}
