/* The words of the command line: its tables. */
#include "words.h"

#include <string.h>

static const Option options[] = {
#define ZP_OPTION(name, word, letter, argument, help) {word, letter, argument, help},
#include "words.def"
};

static const Command commands[] = {
#define ZP_COMMAND(word, argument, options, help)                                                                      \
  {#word, argument, (options) | OPTION_QUIET | OPTION_HELP, help, cli_##word},
#include "words.def"
};
enum { COMMANDS = sizeof commands / sizeof commands[0] };

const Option *word_option(int place) {
  return &options[place];
}

bool word_command(int index, Command *command) {
  const ZpKey *study = zp_key(zp_key_find("study"));
  const int studies = (int)study->max + 1;
  if (index >= studies + COMMANDS) return false;
  if (index < studies)
    *command = (Command){study->choices[index].word, MAY_SCENARIO, STUDY_OPTIONS | OPTION_QUIET | OPTION_HELP,
                         study->choices[index].help, NULL};
  else
    *command = commands[index - studies];
  return true;
}

bool word_find(const char *word, Command *command) {
  for (int i = 0; word_command(i, command); i++)
    if (strcmp(command->word, word) == 0) return true;
  return false;
}

const char *word_nearest(const char *word) {
  Command command;
  const char *nearest = NULL;
  int least = (int)strlen(word) / 2 + 1; /* if half of the letters differ it is not a misspelling */
  for (int i = 0; word_command(i, &command); i++) {
    const int distance = zp_word_distance(word, command.word);
    if (distance >= least) continue;
    least = distance;
    nearest = command.word;
  }
  return nearest;
}

const char *word_nearest_option(const char *word) {
  const char *nearest = NULL;
  int least = (int)strlen(word) / 2 + 1;
  for (int i = 0; i < OPTION_COUNT; i++) {
    const int distance = zp_word_distance(word, options[i].word);
    if (distance >= least) continue;
    least = distance;
    nearest = options[i].word;
  }
  return nearest;
}

const char *word_argument(Argument argument) {
  static const char *const shown[] = {"", "[SCENARIO.yaml]", "SCENARIO.yaml", "bash|zsh|fish"};
  return shown[argument];
}
