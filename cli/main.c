/* zipact: reads the command line. */
#include <errno.h>
#include <fcntl.h>
#include <getopt.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli.h"

/* Largest value of --jobs. */
enum { JOBS_MOST = 1024 };

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

/* => false unless `text` is a valid number of processors. */
static bool read_jobs(const char *text, int *jobs) {
  char *end;
  errno = 0;
  const long value = strtol(text, &end, 10);
  *jobs = (int)value;
  return end > text && *end == 0 && errno == 0 && value >= 1 && value <= JOBS_MOST;
}

/* Take the argument of an option, by the answer of getopt. => EXIT_DONE or EXIT_INPUT. */
static int take_option(int letter, const char **set, Options *options) {
  switch (letter) {
  case 's':
    set[options->sets++] = optarg;
    break;
  case 'o':
    options->directory = optarg;
    break;
  case 't':
    options->templates = optarg;
    break;
  case 'b':
    options->budget = optarg;
    break;
  case 'n':
    if (!read_jobs(optarg, &options->jobs)) return fail_usage("--jobs takes a number from 1 to 1024, not ", optarg);
    break;
  case 'f':
    if (strcmp(optarg, "2") != 0 && strcmp(optarg, "3") != 0) return fail_usage("--fmi takes 2 or 3, not ", optarg);
    options->fmi = *optarg - '0';
    break;
  }
  return EXIT_DONE;
}

/* "load.mass=8g" or "load.mass" without --set: `before`, what stands before that. */
static int fail_assignment(const char *word, const char *before) {
  const char *value = strchr(word, '=') ? "" : "=VALUE";
  fprintf(stderr, "zipact: %s: to set a key write %s--set \"%s%s\"\n", word, before, word, value);
  return EXIT_INPUT;
}

/* Is this a key, "load.mass", or "load.mass=8g"? */
static bool names_key(const char *word) {
  char name[64];
  snprintf(name, sizeof name, "%.*s", (int)strcspn(word, "="), word);
  return zp_key_find(name) >= 0;
}

/* Report an option that getopt refuses: it answers ':' if the argument of the option is missing, otherwise '?'. */
static int fail_option(char **argv, int answer) {
  const char short_option[] = {'-', (char)optopt, 0}, *word = argv[optind - 1];
  if (answer == '?' && strncmp(word, "--", 2) == 0 && names_key(word + 2)) return fail_assignment(word + 2, "");
  if (answer == '?' && optopt && strncmp(word, "--", 2) != 0) word = short_option;
  const char *nearest = answer == '?' ? word_nearest(word + strspn(word, "-"), true) : NULL;
  fprintf(stderr, "zipact: %s %s%s%s%s; see zipact %s --help\n",
          answer == ':' ? "missing argument of" : "unknown option", word, nearest ? "; did you mean --" : "",
          nearest ? nearest : "", nearest ? "?" : "", argv[0]);
  return EXIT_INPUT;
}

/* Is this "load.mass=8g" without --set, and not the name of a file? */
static bool is_assignment(const char *word) {
  return strchr(word, '=') && access(word, F_OK) != 0;
}

/* Take the arguments that are not options: one scenario, or the word that the command takes. */
static int take_arguments(int argc, char **argv, Options *options) {
  for (int i = optind; i < argc; i++) {
    if (is_assignment(argv[i])) return fail_assignment(argv[i], "");
    if (options->scenario) return fail_usage("only one scenario at a time; unexpected argument ", argv[i]);
    options->scenario = argv[i];
  }
  return EXIT_DONE;
}

/* Read the words after the first one; `set` has room for argc pointers. => EXIT_DONE or EXIT_INPUT. */
static int read_options(int argc, char **argv, const char **set, Options *options) {
  struct option known[OPTION_COUNT + 1] = {0};
  for (int i = 0; i < OPTION_COUNT; i++)
    known[i] = (struct option){word_options[i].word, word_options[i].argument ? required_argument : no_argument, NULL,
                               word_options[i].letter};
  *options = (Options){.set = set};
  opterr = 0;
  for (int letter; (letter = getopt_long(argc, argv, ":o:h", known, NULL)) != -1;) {
    if (letter == '?' || letter == ':') return fail_option(argv, letter);
    const int status = take_option(letter, set, options);
    if (status != EXIT_DONE) return status;
    for (int i = 0; i < OPTION_COUNT; i++)
      if (word_options[i].letter == letter) options->given |= 1u << i;
  }
  return take_arguments(argc, argv, options);
}

/* "keys does not take --jobs" */
static int fail_taken(const Command *command, const char *what) {
  fprintf(stderr, "zipact: %s does not take %s; see zipact %s --help\n", command->word, what, command->word);
  return EXIT_INPUT;
}

static int check_words(const Command *command, const Options *o) {
  for (int i = 0; i < OPTION_COUNT; i++) {
    char word[32];
    const Option *option = &word_options[i];
    snprintf(word, sizeof word, option->letter == 'o' ? "-o" : "--%s", option->word);
    if (o->given & ~command->options & 1u << i) return fail_taken(command, word);
  }
  if (command->argument == NOTHING && o->scenario) return fail_taken(command, "a scenario");
  if (command->argument == A_SCENARIO && !o->scenario) return fail_usage(command->word, " needs a scenario file");
  if (command->argument == A_SHELL && !o->scenario)
    return fail_usage(command->word, " needs a shell: bash, zsh or fish");
  return EXIT_DONE;
}

static int fail_word(const char *word) {
  if (*word == '-') return fail_usage("a study or command comes before ", word);
  if (is_assignment(word) || names_key(word)) return fail_assignment(word, "zipact STUDY ");
  const char *ending = strrchr(word, '.');
  if (ending && (strcmp(ending, ".yaml") == 0 || strcmp(ending, ".yml") == 0)) {
    fprintf(stderr, "zipact: %s: to run a scenario write zipact run %s\n", word, word);
    return EXIT_INPUT;
  }
  const char *nearest = word_nearest(word, false);
  fprintf(stderr, "zipact: unknown study or command: %s%s%s%s\n", word,
          nearest ? "; did you mean " : "; see zipact --help", nearest ? nearest : "", nearest ? "?" : "");
  return EXIT_INPUT;
}

static int dispatch(const char *word, const Options *o) {
  const Command *command = word_find(word);
  if (!command) return fail_word(word);
  if (o->given & OPTION_HELP) {
    help_print_command(command);
    return EXIT_DONE;
  }
  const int status = check_words(command, o);
  if (status != EXIT_DONE) return status;
  return command->run ? command->run(o) : cli_study(word, o);
}

int cli_run(const Options *options) {
  return cli_study(NULL, options);
}

/* Each case of a campaign allocates memory and frees it. If it were returned to the system each time, it would come
 * back as fresh pages, and each return interrupts the other processors (bench/campaign.py). So up to 8 MB stay with a
 * thread. */
static void keep_freed_memory(void) {
#ifdef __GLIBC__
  mallopt(M_TRIM_THRESHOLD, 8 << 20);
  mallopt(M_MMAP_THRESHOLD, 4 << 20);
#endif
}

/* A standard stream that the caller closed would be the next file that is opened: results would go into a journal, and
 * messages into a picture. It becomes one that cannot be written, so that cli_flush reports what is lost. */
static void occupy_standard_streams(void) {
  int fd;
  do
    fd = open("/dev/null", O_RDONLY);
  while (fd >= 0 && fd <= STDERR_FILENO);
  if (fd >= 0) close(fd);
}

int cli_main(int argc, char **argv, const Crew *crew) {
  occupy_standard_streams();
  keep_freed_memory();
  ZpError err;
  if (zp_hdf5_skip_exit(&err) != ZP_OK) return cli_fail(&err);
  if (argc < 2) return fail_usage("a study or command is missing", "");
  if (strcmp(argv[1], "--version") == 0) {
    puts("zipact " ZP_VERSION);
    return cli_flush(EXIT_DONE);
  }
  if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 || strcmp(argv[1], "help") == 0) {
    const Command *command = argc > 2 ? word_find(argv[2]) : NULL;
    if (command)
      help_print_command(command);
    else
      help_print();
    return cli_flush(EXIT_DONE);
  }
  if (*argv[1] == '-') return fail_word(argv[1]);
  const char **set = calloc((size_t)argc, sizeof *set);
  if (!set) return cli_fail(&(ZpError){ZP_MACHINE, "no memory"});
  Options options;
  int status = read_options(argc - 1, argv + 1, set, &options);
  options.crew = crew;
  if (status == EXIT_DONE) status = dispatch(argv[1], &options);
  free(set);
  return cli_flush(status);
}
