/* The words of the command line: its tables. */
#include "cli.h"

#include <string.h>

enum {
  ALL = OPTION_QUIET | OPTION_HELP, /* commands take these */
  STUDY_OPTIONS =
      OPTION_SET | OPTION_OUTPUT | OPTION_NO_PLOTS | OPTION_TEMPLATES | OPTION_JOBS | OPTION_RESUME | OPTION_JSON
};

const Option word_options[OPTION_COUNT] = {
#define ZP_OPTION(name, word, letter, argument, help) {word, letter, argument, help},
#include "words.def"
};

/* Options of studies beside these, by their files. */
enum { OF_none = 0, OF_course = 0, OF_reference = 0, OF_measurements = 0, OF_candidates = OPTION_BUDGET };

const Command word_commands[] = {
#define ZP_STUDY(enumerator, word, shows, files, help)                                                                 \
  {#word, MAY_SCENARIO, STUDY_OPTIONS | OF_##files | ALL, help, NULL},
#include <zipact/studies.def>
#define ZP_COMMAND(word, argument, options, help) {#word, argument, (options) | ALL, help, cli_##word},
#include "words.def"
    {0},
};

const Command *word_find(const char *word) {
  const Command *command = word_commands;
  while (command->word && strcmp(command->word, word) != 0)
    command++;
  return command->word ? command : NULL;
}

const char *word_nearest(const char *word, bool option) {
  const char *nearest = NULL, *other;
  int least = (int)strlen(word) / 2 + 1; /* if half of the letters differ it is not a misspelling */
  for (int i = 0; !option || i < OPTION_COUNT; i++) {
    if (!(other = option ? word_options[i].word : word_commands[i].word)) break;
    const int distance = zp_word_distance(word, other);
    if (distance >= least) continue;
    least = distance;
    nearest = other;
  }
  return nearest;
}

const char *word_argument(Argument argument) {
  static const char *const shown[] = {"", "[SCENARIO.yaml]", "SCENARIO.yaml", "bash|zsh|fish"};
  return shown[argument];
}
