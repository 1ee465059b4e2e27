/* zipact: the words of the command line. */
#include <errno.h>
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"

/* Largest value of --jobs. */
enum { JOBS_MOST = 1024 };

static const char usage[] =
    "zipact STUDY [SCENARIO.yaml] [--set KEY=VALUE]... [-o DIR] [--no-plots] [--jobs N] [--resume] [--json] [--quiet]\n"
    "zipact run SCENARIO.yaml            the study that the scenario names (key `study`)\n"
    "zipact optimize SCENARIO.yaml       best values of some keys (keys `optimize.*`), for any study; options as "
    "above\n"
    "zipact batch [SCENARIO.yaml] [--set KEY=VALUE]... [--jobs N]   cases as JSON on standard input, one per line;\n"
    "                                    results as JSON on standard output\n"
    "zipact fmu [SCENARIO.yaml] [--set KEY=VALUE]... [--fmi 2|3] -o FILE.fmu   the actuator as an FMU for "
    "co-simulation\n"
    "zipact keys [--json | --yaml]       every key: unit, default, range, help; --yaml is a starter scenario\n"
    "zipact reproduce [-o DIR]           the tables and figures of the paper beside our own\n"
    "zipact bench [--json]               speed on this machine\n"
    "zipact --version | --help | STUDY --help\n"
    "\n"
    "Studies\n";

static const char study_usage[] =
    "\n"
    "  SCENARIO.yaml     values of keys; keys not given keep their defaults. A list of values is a sweep\n"
    "  --set KEY=VALUE   the value of a key, as in \"load.mass=20 g\"; overrides the file; may be repeated.\n"
    "                    \"load.mass=1 g .. 100 g : 5 log\" is a sweep, too: 5 values, \"log\" by equal factors\n"
    "  -o, --output DIR  folder of the results (default: out/STUDY)\n"
    "  --no-plots        no pictures; the same as --set output.plots=false\n"
    "  --jobs N          number of processors to use (default: all); the results do not depend on it\n"
    "  --resume          continue the sweep in the folder of the results: cases that are done are not run again\n"
    "  --json            print only the summary, as JSON, to standard output\n"
    "  --quiet           no progress and no messages except errors\n"
    "\n"
    "Values take units (\"130 um\", \"10 kV\", \"8 g\"); a number without a unit is in SI. `zipact keys` lists the "
    "keys.\n"
    "Exit status: 0 done; 1 the solver failed; 2 wrong input; 3 the machine failed; 130 interrupted.\n";

void cli_notice(const char *message) {
  fprintf(stderr, "zipact: %s\n", message);
}

int cli_fail(const ZpError *err) {
  cli_notice(err->message);
  return err->status == ZP_MACHINE ? EXIT_MACHINE : EXIT_INPUT;
}

int cli_flush(int status) {
  if (fflush(stdout) == 0 && !ferror(stdout)) return status;
  return cli_fail(&(ZpError){ZP_MACHINE, "cannot write to standard output"});
}

static int fail_usage(const char *what, const char *word) {
  fprintf(stderr, "zipact: %s%s; see zipact --help\n", what, word);
  return EXIT_INPUT;
}

static const ZpKey *study_key(void) {
  return zp_key(zp_key_find("study"));
}

static void print_help(void) {
  fputs(usage, stdout);
  for (int i = 0; i <= (int)study_key()->max; i++)
    printf("  %-14s %s\n", study_key()->choices[i].word, study_key()->choices[i].help);
  fputs(study_usage, stdout);
}

static int print_study_help(const char *study) {
  int place = zp_key_choice(zp_key_find("study"), study);
  printf(
      "zipact %s [SCENARIO.yaml] [--set KEY=VALUE]... [-o DIR] [--no-plots] [--jobs N] [--resume] [--json] [--quiet]\n",
      study);
  printf("%s\n", place >= 0 ? study_key()->choices[place].help : "the study that the scenario names");
  fputs(study_usage, stdout);
  return EXIT_DONE;
}

/* => false unless `text` is a whole number of processors. */
static bool read_jobs(const char *text, int *jobs) {
  char *end;
  errno = 0;
  const long value = strtol(text, &end, 10);
  *jobs = (int)value;
  return end > text && *end == 0 && errno == 0 && value >= 1 && value <= JOBS_MOST;
}

/* Read what follows the first word; `set` has room for argc pointers. => EXIT_DONE or EXIT_INPUT. */
static int read_options(int argc, char **argv, const char **set, Options *options) {
  static const struct option known[] = {{"set", required_argument, NULL, 's'},
                                        {"output", required_argument, NULL, 'o'},
                                        {"no-plots", no_argument, NULL, 'p'},
                                        {"jobs", required_argument, NULL, 'n'},
                                        {"resume", no_argument, NULL, 'r'},
                                        {"json", no_argument, NULL, 'j'},
                                        {"fmi", required_argument, NULL, 'f'},
                                        {"yaml", no_argument, NULL, 'y'},
                                        {"quiet", no_argument, NULL, 'q'},
                                        {"help", no_argument, NULL, 'h'},
                                        {NULL, 0, NULL, 0}};
  *options = (Options){.set = set};
  for (int c; (c = getopt_long(argc, argv, "o:h", known, NULL)) != -1;) {
    if (c == 's')
      set[options->sets++] = optarg;
    else if (c == 'o')
      options->directory = optarg;
    else if (c == 'p')
      options->no_plots = true;
    else if (c == 'r')
      options->resume = true;
    else if (c == 'n') {
      if (!read_jobs(optarg, &options->jobs)) return fail_usage("--jobs takes a number from 1 to 1024, not ", optarg);
    } else if (c == 'f') {
      if (strcmp(optarg, "2") != 0 && strcmp(optarg, "3") != 0) return fail_usage("--fmi takes 2 or 3, not ", optarg);
      options->fmi = *optarg - '0';
    } else if (c == 'j')
      options->json = true;
    else if (c == 'y')
      options->yaml = true;
    else if (c == 'q')
      options->quiet = true;
    else if (c == 'h')
      options->help = true;
    else
      return EXIT_INPUT; /* getopt has said why */
  }
  if (optind < argc) options->scenario = argv[optind++];
  return optind < argc ? fail_usage("only one scenario at a time; unexpected argument ", argv[optind]) : EXIT_DONE;
}

static int no_scenario_options(const char *word, const Options *o) {
  if (o->scenario) return fail_usage("does not take a scenario: ", word);
  if (o->sets) return fail_usage("does not take --set: ", word);
  if (o->no_plots) return fail_usage("does not take --no-plots: ", word);
  if (o->resume) return fail_usage("does not take --resume: ", word);
  if (o->jobs) return fail_usage("does not take --jobs: ", word);
  return EXIT_DONE;
}

static int dispatch_batch(const Options *o) {
  if (o->help) {
    print_help();
    return EXIT_DONE;
  }
  if (o->directory) return fail_usage("does not take -o: ", "batch");
  if (o->resume) return fail_usage("does not take --resume: ", "batch");
  if (o->yaml) return fail_usage("--yaml is an option of keys, not of ", "batch");
  return cli_batch(o);
}

static int dispatch_optimize(const Options *o) {
  if (o->help) {
    print_help();
    return EXIT_DONE;
  }
  if (o->yaml) return fail_usage("--yaml is an option of keys, not of ", "optimize");
  return cli_optimize(o);
}

static int dispatch_fmu(const Options *o) {
  if (o->help) {
    print_help();
    return EXIT_DONE;
  }
  if (!o->directory) return fail_usage("fmu needs a file to write: -o FILE.fmu", "");
  if (o->no_plots) return fail_usage("does not take --no-plots: ", "fmu");
  if (o->resume) return fail_usage("does not take --resume: ", "fmu");
  if (o->jobs) return fail_usage("does not take --jobs: ", "fmu");
  if (o->json) return fail_usage("does not take --json: ", "fmu");
  if (o->yaml) return fail_usage("--yaml is an option of keys, not of ", "fmu");
  Options filled = *o;
  if (!filled.fmi) filled.fmi = 3;
  return cli_fmu(&filled);
}

static int dispatch(const char *word, const Options *o) {
  if (strcmp(word, "fmu") == 0) return dispatch_fmu(o);
  if (o->fmi) return fail_usage("--fmi is an option of fmu, not of ", word);
  bool is_study = zp_key_choice(zp_key_find("study"), word) >= 0, is_run = strcmp(word, "run") == 0;
  if (is_study || is_run) {
    if (o->help) return print_study_help(word);
    if (o->yaml) return fail_usage("--yaml is an option of keys, not of ", word);
    if (is_run && !o->scenario) return fail_usage("run needs a scenario file", "");
    return cli_study(is_run ? NULL : word, o);
  }
  if (strcmp(word, "batch") == 0) return dispatch_batch(o);
  if (strcmp(word, "optimize") == 0) return dispatch_optimize(o);
  bool is_keys = strcmp(word, "keys") == 0, is_reproduce = strcmp(word, "reproduce") == 0;
  if (!is_keys && !is_reproduce && strcmp(word, "bench") != 0) return fail_usage("unknown study or command: ", word);
  if (o->help) {
    print_help();
    return EXIT_DONE;
  }
  int status = no_scenario_options(word, o);
  if (status != EXIT_DONE) return status;
  if (o->yaml && !is_keys) return fail_usage("--yaml is an option of keys, not of ", word);
  if (o->directory && !is_reproduce) return fail_usage("does not take -o: ", word);
  return is_keys ? cli_keys(o) : is_reproduce ? cli_reproduce(o) : cli_bench(o);
}

int cli_main(int argc, char **argv, const Crew *crew) {
  ZpError err;
  if (zp_hdf5_skip_exit(&err) != ZP_OK) return cli_fail(&err);
  if (argc < 2) return fail_usage("a study or command is missing", "");
  if (strcmp(argv[1], "--version") == 0) {
    puts("zipact " ZP_VERSION);
    return cli_flush(EXIT_DONE);
  }
  if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 || strcmp(argv[1], "help") == 0) {
    print_help();
    return cli_flush(EXIT_DONE);
  }
  const char **set = calloc((size_t)argc, sizeof *set);
  if (!set) return cli_fail(&(ZpError){ZP_MACHINE, "no memory"});
  Options options;
  int status = read_options(argc - 1, argv + 1, set, &options);
  options.crew = crew;
  if (status == EXIT_DONE) status = dispatch(argv[1], &options);
  free(set);
  return cli_flush(status);
}
