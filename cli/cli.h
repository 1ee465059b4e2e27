/* The command: what its files share. */
#ifndef ZP_CLI_CLI_H
#define ZP_CLI_CLI_H

#include <stdbool.h>

#include <zipact/zipact.h>

#include <zipact/campaign.h>
#include <zipact/io.h>
#include <zipact/optimize.h>

/* Exit statuses; docs/interface.md. */
enum { EXIT_DONE = 0, EXIT_NUMERICS = 1, EXIT_INPUT = 2, EXIT_MACHINE = 3, EXIT_INTERRUPTED = 130 };

/* Processes that compute cases in place of threads: zipact-mpi has them. */
typedef struct Crew {
  int size;                                                    /* how many */
  ZpStatus (*begin)(const ZpScenario *scenario, ZpError *err); /* tell them which cases there are */
  ZpStatus (*compute)(void *user, size_t worker, size_t from, size_t to, unsigned char **byte, size_t *size,
                      ZpError *err); /* as ZpCampaignOptions.remote */
  void *user;                        /* of `compute` */
} Crew;

/* What the words of the command line say. */
typedef struct Options {
  const char *scenario; /* NULL: the defaults; of `completion` the shell */
  const char **set;     /* [sets] values of --set, in order */
  int sets;
  const char *directory; /* what -o names; NULL: not given */
  const char *templates; /* what --templates names; NULL: not given */
  int jobs;              /* processors to use; 0: all */
  int fmi;               /* version of FMI that was asked for; 0: none */
  bool resume, no_plots, json, yaml, quiet, help;
  const Crew *crew; /* NULL: threads of this process compute */
} Options;

/* Do what the words of the command line say => exit status. `crew` may be NULL. */
int cli_main(int argc, char **argv, const Crew *crew);

/* Say something on stderr. */
void cli_notice(const char *message);

/* Read the scenario and the values that the command line says. `study` NULL: the one that it names. */
ZpStatus cli_read_scenario(const char *study, const Options *options, ZpScenario *scenario, ZpError *err);

/* Say why and give the exit status. */
int cli_fail(const ZpError *err);

/* `status`, unless what was printed did not all get out: then EXIT_MACHINE. */
int cli_flush(int status);

/* `study` NULL: the one that the scenario names. */
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

/* Progress on stderr where it is a terminal, and Ctrl-C. */
typedef struct Progress {
  bool shown;
  double start, last; /* wall time of the beginning and of the last line, s */
} Progress;
ZpHooks cli_hooks(Progress *progress);

/* The same for a campaign: draws how far it is, at which rate, how long it takes and how many cases have failed. */
void cli_draw_campaign(Progress *progress, const ZpCampaignState *state);
void cli_progress_end(Progress *progress);

/* From now on, the first Ctrl-C asks to stop, the second ends the program at once. */
void cli_watch_interrupts(void);

/* Whether one has come since then. */
bool cli_interrupted(void);
double cli_wall_clock(void *unused);

#endif
