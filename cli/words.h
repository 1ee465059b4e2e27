/* The words of the command line, from words.def and studies.def. */
#ifndef ZP_CLI_WORDS_H
#define ZP_CLI_WORDS_H

#include <stdbool.h>

#include "cli.h"

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

extern const Option word_options[OPTION_COUNT];

/* Studies first; the last has no word. */
extern const Command word_commands[];

/* The command or study called `word`; NULL if there is none. */
const Command *word_find(const char *word);

/* The command or study, or the option without its dashes, that differs least from `word`; NULL if none is like it. */
const char *word_nearest(const char *word, bool option);

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
