/* The words of the command line, from words.def and studies.def. */
#ifndef ZP_CLI_WORDS_H
#define ZP_CLI_WORDS_H

#include <stdbool.h>
#include <stddef.h>

#include "cli.h"

/* Bits of options. */
enum {
#define ZP_OPTION(name, word, letter, argument, help) OPTION_PLACE_##name,
#include "words.def"
  OPTION_COUNT
};
enum {
#define ZP_OPTION(name, word, letter, argument, help) OPTION_##name = 1 << OPTION_PLACE_##name,
#include "words.def"
  STUDY_OPTIONS =
      OPTION_SET | OPTION_OUTPUT | OPTION_NO_PLOTS | OPTION_TEMPLATES | OPTION_JOBS | OPTION_RESUME | OPTION_JSON
};

typedef struct Option {
  const char *word;
  int letter;
  const char *argument; /* NULL: no argument */
  const char *help;
} Option;

/* The argument of a command, in addition to options. */
typedef enum Argument { NOTHING, MAY_SCENARIO, A_SCENARIO, A_SHELL } Argument;

typedef struct Command {
  const char *word;
  Argument argument;
  unsigned options; /* bits of the options that it takes */
  const char *help;
  int (*run)(const Options *options); /* NULL: a study */
} Command;

/* Option `place`, 0 <= place < OPTION_COUNT. */
const Option *word_option(int place);

/* Command `index`, studies first; false after the last one. */
bool word_command(int index, Command *command);

/* The command or study called `word`; false if there is none. */
bool word_find(const char *word, Command *command);

/* The command or study whose name differs least from `word`, NULL if none is like it. */
const char *word_nearest(const char *word);

/* The option whose name, without its dashes, differs least from `word`, NULL if none is like it. */
const char *word_nearest_option(const char *word);

/* The argument as help shows it, "[SCENARIO.yaml]"; "" for none. */
const char *word_argument(Argument argument);

/* What `zipact --help` and `zipact WORD --help` print. */
void help_print(void);
void help_print_command(const Command *command);

/* "-o, --output PATH" */
void help_option_name(const Option *option, char *text, size_t size);

/* Write "zipact WORD [SCENARIO.yaml] [--set KEY=VALUE]..." word by word by `write`. */
void help_synopsis(const Command *command, void (*write)(void *user, const char *word), void *user);

#endif
