/* The command: common functions of its files. */
#ifndef ZP_CLI_CLI_H
#define ZP_CLI_CLI_H

#include <stdbool.h>

#include <zipact/zipact.h>

#include <zipact/campaign.h>
#include <zipact/io.h>
#include <zipact/optimize.h>

/* Exit statuses; docs/interface.md. */
enum { EXIT_DONE = 0, EXIT_NUMERICS = 1, EXIT_INPUT = 2, EXIT_MACHINE = 3, EXIT_INTERRUPTED = 130 };

/* Processes that compute cases instead of threads, as in zipact-mpi. */
typedef struct Crew {
  int size;                                                    /* number of processes */
  ZpStatus (*begin)(const ZpScenario *scenario, ZpError *err); /* send them the scenario */
  ZpStatus (*compute)(void *user, size_t worker, size_t from, size_t to, unsigned char **byte, size_t *size,
                      ZpError *err); /* as ZpCampaignOptions.remote */
  void *user;                        /* of `compute` */
} Crew;

/* Bits of options, from words.def. */
enum {
#define ZP_OPTION(name, word, letter, argument, help) OPTION_PLACE_##name,
#include "words.def"
  OPTION_COUNT
};
enum {
#define ZP_OPTION(name, word, letter, argument, help) OPTION_##name = 1 << OPTION_PLACE_##name,
#include "words.def"
};

/* The options and arguments of the command line. */
typedef struct Options {
  unsigned given;       /* bits of the given options */
  const char *scenario; /* NULL: the defaults; for `completion` the shell */
  const char **set;     /* [sets] values of --set, in order */
  int sets;
  const char *directory; /* folder or file of -o; NULL: not given */
  const char *templates; /* folder of --templates; NULL: not given */
  const char *budget;    /* of --budget; NULL: not given */
  int jobs;              /* processors to use; 0: all */
  int fmi;               /* requested version of FMI; 0: none */
  const Crew *crew;      /* NULL: threads of this process compute */
} Options;

/* Run the command line => exit status. `crew` may be NULL. */
int cli_main(int argc, char **argv, const Crew *crew);

/* Print a message to stderr. */
void cli_notice(const char *message);

/* The scenario with the values of the command line. `study` NULL: the study that the scenario names. To be destroyed
 * whatever the status is. */
ZpStatus cli_read_scenario(const char *study, const Options *options, ZpScenario **scenario, ZpError *err);

/* Print the error and return the exit status. */
int cli_fail(const ZpError *err);

/* `status`, or EXIT_MACHINE if the output could not be written completely. */
int cli_flush(int status);

/* `study` NULL: the study that the scenario names. */
int cli_study(const char *study, const Options *options);

/* The commands of words.def. */
int cli_run(const Options *options);
int cli_optimize(const Options *options);
int cli_batch(const Options *options);
int cli_fmu(const Options *options);
int cli_keys(const Options *options);
int cli_schema(const Options *options);
int cli_completion(const Options *options);
int cli_plots(const Options *options);
int cli_man(const Options *options);
int cli_bench(const Options *options);
int cli_reproduce(const Options *options);

/* Progress on stderr if it is a terminal, and Ctrl-C. */
typedef struct Progress {
  bool shown;
  double start, last; /* wall time of the start and of the last line, s */
} Progress;
ZpHooks cli_hooks(Progress *progress);

/* Draw the state of a campaign: progress, rate, remaining time and number of failed cases. */
void cli_draw_campaign(Progress *progress, const ZpCampaignState *state);
void cli_progress_end(Progress *progress);

/* From now on, the first Ctrl-C requests a stop, the second ends the program at once. */
void cli_watch_interrupts(void);

/* Was Ctrl-C pressed since then? */
bool cli_interrupted(void);
double cli_wall_clock(void *unused);

/* Print at most ten numbers of a single run, or a line per case, and the place of the files; `plots`: these include
 * pictures. */
void summary_print(const ZpReport *report, bool plots);

/* -- the words of the command line, from words.def and studies.def -------------------------------- */

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

/* Text of `zipact --help` and `zipact WORD --help`. */
void help_print(void);
void help_print_command(const Command *command);

/* "-o, --output PATH" */
void help_option_name(const Option *option, char *text, size_t size);

/* Write "zipact WORD [SCENARIO.yaml] [--set KEY=VALUE]..." word by word by `write`. */
void help_synopsis(const Command *command, void (*write)(void *user, const char *word), void *user);

#endif
