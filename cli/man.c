/* zipact man: a manual page for each command and one for all, from the tables of --help. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "cli.h"

/* A text in which the special characters of troff are escaped. */
static void write_text(FILE *file, const char *text) {
  bool bold = false;
  if (*text == '.' || *text == '\'') fputs("\\&", file);
  for (; *text; text++) {
    if (*text == '\\')
      fputs("\\e", file);
    else if (*text == '-')
      fputs("\\-", file);
    else if (*text == '`') /* a word of the program begins or ends */
      fputs((bold = !bold) ? "\\fB" : "\\fR", file);
    else
      fputc(*text, file);
  }
}

static void write_section(FILE *file, const char *name) {
  fprintf(file, ".SH %s\n", name);
}

/* A term and its meaning. */
static void write_entry(FILE *file, const char *term, const char *help) {
  fprintf(file, ".TP\n\\fB");
  write_text(file, term);
  fprintf(file, "\\fR\n");
  write_text(file, help);
  fputc('\n', file);
}

static void write_head(FILE *file, const char *page, const char *help) {
  fprintf(file, ".TH \"%s\" 1 \"\" \"zipact %s\" \"User Commands\"\n.SH NAME\n%s \\- ", page, ZP_VERSION, page);
  write_text(file, help);
  fputc('\n', file);
}

static void write_word(void *user, const char *word) {
  FILE *file = user;
  write_text(file, word);
  fputc('\n', file);
}

static void write_options(FILE *file, unsigned taken) {
  write_section(file, "OPTIONS");
  for (int i = 0; i < OPTION_COUNT; i++) {
    const Option *option = &word_options[i];
    char term[64];
    help_option_name(option, term, sizeof term);
    if (taken & 1u << i) write_entry(file, term, option->help);
  }
}

/* A list of names and meanings; ends with NULL. */
typedef struct Entry {
  const char *term, *help;
} Entry;

static void write_entries(FILE *file, const char *section, const Entry *entry) {
  write_section(file, section);
  for (; entry->term; entry++)
    write_entry(file, entry->term, entry->help);
}

static const Entry files[] = {
    {"summary.json", "outcome, message and the study's numbers; written after all other numbers"},
    {"scenario.yaml", "all keys and their values; running it again gives the same result"},
    {"table.csv", "the time series or branch, or one row per case of a sweep"},
    {"likelihood.csv, regions.csv", "calibrate: profiles of the fitted keys, joint regions of pairs"},
    {"results.h5", "the same and the shapes, with units"},
    {"fitted.yaml", "of `calibrate`: the fitted values with their errors, for other scenarios (`base.file`)"},
    {"journal.sqlite", "of a sweep: a row per finished case, for `--resume`"},
    {"shapes.pvd, shapes/, field.vts", "for ParaView"},
    {"checkpoint.zps", "the last state of a run in time, from which another run can resume (`initial.file`)"},
    {"plots/", "SVG pictures and the gnuplot scripts that drew them; `zipact plots` writes the templates of these "
               "scripts, and `--templates` draws with those of a folder"},
    {NULL, NULL}};

static const Entry statuses[] = {
    {"0", "done; also if the actuator never zips, which is a result"},
    {"1", "the solver failed; results up to there are kept"},
    {"2", "wrong input; nothing was written"},
    {"3", "the machine failed (disk full, no permission, no memory), or another run holds the output folder"},
    {"130", "interrupted; the results so far are kept"},
    {NULL, NULL}};

static const char scenarios[] =
    ".SH SCENARIOS\n"
    "YAML, nested or dotted.\n"
    "Values take units (130 um, 10 kV, 8 g); a number without a unit is in SI.\n"
    "A numeric key with a list of values is swept; several lists give all combinations of their values.\n"
    "A range, \\fB\"10 um .. 200 um : 20\"\\fR or with \\fBlog\\fR at its end, stands for a list; in a file also\n"
    "{from: 10 um, to: 200 um, count: 20, spacing: log}.\n"
    "Later values override earlier ones, in this order: defaults, those of the kind, preset, materials, file,\n"
    "\\fB\\-\\-set\\fR.\n"
    ".BR \"zipact keys\" \" lists all keys.\"\n";

static const char examples[] = ".SH EXAMPLES\n"
                               ".EX\n"
                               "zipact equilibrium \\-\\-set \"load.mass=8 g\"\n"
                               "zipact actuate \\-\\-set \"drive.voltage=[6 kV, 8 kV, 10 kV]\" \\-o out/sweep\n"
                               "zipact keys \\-\\-yaml > mine.yaml\n"
                               "zipact run mine.yaml\n"
                               ".EE\n";

/* "zipact-keys (1), ..." */
static void write_see_also(FILE *file, const char *own) {
  write_section(file, "SEE ALSO");
  if (*own) fputs(".BR zipact (1),\n", file);
  for (const Command *c = word_commands; c->word; c++)
    if (strcmp(c->word, own) != 0) fprintf(file, ".BR zipact\\-%s (1),\n", c->word);
  fputs(".BR gnuplot (1)\n", file);
}

/* The page of one command. */
static void write_page(FILE *file, const Command *command) {
  char page[64];
  snprintf(page, sizeof page, "zipact-%s", command->word);
  write_head(file, page, command->help);
  write_section(file, "SYNOPSIS");
  help_synopsis(command, write_word, file);
  write_section(file, "DESCRIPTION");
  write_text(file, command->help);
  fputc('\n', file);
  write_options(file, command->options);
  if (command->options & OPTION_SET) fputs(scenarios, file);
  if (command->options & OPTION_RESUME) write_entries(file, "FILES", files);
  write_entries(file, "EXIT STATUS", statuses);
  write_see_also(file, command->word);
}

/* The studies or the commands, in their own section. */
static void write_commands(FILE *file, const char *section, bool studies) {
  write_section(file, section);
  for (const Command *c = word_commands; c->word; c++)
    if ((c->run == NULL) == studies) write_entry(file, c->word, c->help);
}

static void write_main_page(FILE *file) {
  write_head(file, "zipact", "simulate electrostatic zipping actuators");
  fputs(".SH SYNOPSIS\n.B zipact\n.I STUDY\n.RI [ SCENARIO.yaml ]\n.RI [ options ]\n.br\n.B zipact\n.I COMMAND\n.RI [ "
        "options ]\n"
        ".br\n.B zipact\n.BR \\-\\-version \" | \" \\-\\-help\n",
        file);
  write_section(file, "DESCRIPTION");
  fputs(".B zipact\ncomputes the equilibria and the motion of ribbons or flanges that high voltage pulls together:\n"
        "above all the electro\\-ribbon actuator, two insulated steel ribbons clipped together at their ends with a "
        "load\n"
        "hanging in the middle.\nWithout a scenario a study takes the defaults, the actuator of the paper by Castro et "
        "al.\n",
        file);
  write_commands(file, "STUDIES", true);
  write_commands(file, "COMMANDS", false);
  write_options(file, ~0u);
  fputs(scenarios, file);
  write_entries(file, "FILES", files);
  write_entries(file, "EXIT STATUS", statuses);
  fputs(examples, file);
  write_see_also(file, "");
}

/* Write a page: of `command`, or of all commands if it is NULL. */
static int write_file(const char *folder, const Command *command) {
  char path[4096];
  snprintf(path, sizeof path, "%s/zipact%s%s.1", folder, command ? "-" : "", command ? command->word : "");
  FILE *file = fopen(path, "w");
  if (file && command) write_page(file, command);
  if (file && !command) write_main_page(file);
  const bool failed = !file || ferror(file);
  if (file && fclose(file) == 0 && !failed) return EXIT_DONE;
  ZpError err = {ZP_MACHINE, ""};
  snprintf(err.message, sizeof err.message, "%.300s: cannot be written: %s", path, strerror(errno));
  return cli_fail(&err);
}

int cli_man(const Options *options) {
  if (!options->directory) return cli_fail(&(ZpError){ZP_BAD_INPUT, "man needs a folder to write to: -o DIR"});
  mkdir(options->directory, 0777); /* its failure is detected below */
  int status = write_file(options->directory, NULL);
  for (const Command *c = word_commands; status == EXIT_DONE && c->word; c++)
    status = write_file(options->directory, c);
  return status;
}
