/* The output of --help, from the tables of words. */
#include <stdio.h>
#include <string.h>

#include "cli.h"

enum { LINE = 110, HELP_COLUMN = 28 }; /* characters per line; column of the help */

static const char values_and_statuses[] =
    "\n"
    "Values take units (\"130 um\", \"10 kV\", \"8 g\"); a number without a unit is in SI. `zipact keys` lists the "
    "keys.\n"
    "Exit status: 0 done; 1 the solver failed; 2 wrong input; 3 the machine failed; 130 interrupted.\n";

/* A text with line breaks between words. */
typedef struct Paragraph {
  int indent, column;
  bool begun; /* the line has at least one word */
} Paragraph;

static void write_word(void *user, const char *word) {
  Paragraph *p = user;
  if (p->begun && p->column + 1 + (int)strlen(word) > LINE) {
    printf("\n%*s", p->indent, "");
    p->column = p->indent;
    p->begun = false;
  }
  p->column += printf("%s%s", p->begun ? " " : "", word);
  p->begun = true;
}

static void write_text(Paragraph *p, const char *text) {
  char word[LINE];
  for (size_t length; *text; text += length + (text[length] == ' ')) {
    length = strcspn(text, " ");
    snprintf(word, sizeof word, "%.*s", (int)length, text);
    write_word(p, word);
  }
  putchar('\n');
}

/* "  name   help", the help indented. */
static void write_entry(const char *name, const char *help) {
  const int length = printf("  %s", name);
  Paragraph p = {HELP_COLUMN, HELP_COLUMN, false};
  if (length + 2 > HELP_COLUMN)
    printf("\n%*s", HELP_COLUMN, "");
  else
    printf("%*s", HELP_COLUMN - length, "");
  write_text(&p, help);
}

void help_option_name(const Option *option, char *text, size_t size) {
  const char letter[] = {(char)option->letter, 0};
  const bool is_short = strchr("oh", option->letter) != NULL;
  snprintf(text, size, "%s%s%s--%s%s%s", is_short ? "-" : "", is_short ? letter : "", is_short ? ", " : "",
           option->word, option->argument ? " " : "", option->argument ? option->argument : "");
}

static void write_options(unsigned taken) {
  printf("\nOptions\n");
  for (int i = 0; i < OPTION_COUNT; i++) {
    char name[64];
    help_option_name(&word_options[i], name, sizeof name);
    if (taken & 1u << i) write_entry(name, word_options[i].help);
  }
}

void help_synopsis(const Command *command, void (*write)(void *user, const char *word), void *user) {
  write(user, "zipact");
  write(user, command->word);
  if (command->argument != NOTHING) write(user, word_argument(command->argument));
  for (int i = 0; i < OPTION_COUNT; i++) {
    const Option *option = &word_options[i];
    char name[64];
    if (!(command->options & 1u << i) || 1u << i == OPTION_HELP) continue;
    const char *dashes = option->letter == 'o' ? "-o" : "--", *word = option->letter == 'o' ? "" : option->word;
    snprintf(name, sizeof name, "[%s%s%s%s]%s", dashes, word, option->argument ? " " : "",
             option->argument ? option->argument : "", 1u << i == OPTION_SET ? "..." : "");
    write(user, name);
  }
}

static void write_commands(bool studies) {
  for (const Command *c = word_commands; c->word; c++) {
    char name[64];
    const char *argument = studies ? "" : word_argument(c->argument);
    snprintf(name, sizeof name, "%s%s%s", c->word, *argument ? " " : "", argument);
    if ((c->run == NULL) == studies) write_entry(name, c->help);
  }
}

void help_print(void) {
  printf("zipact STUDY [SCENARIO.yaml] [OPTIONS]     answer a question about a zipping actuator\n"
         "zipact COMMAND [OPTIONS]\n"
         "zipact --version | --help | STUDY --help | COMMAND --help\n"
         "\n"
         "SCENARIO.yaml has values of keys; keys not given keep their defaults. A list of values is a sweep.\n"
         "Results go to out/STUDY, or where -o says.\n"
         "\nStudies\n");
  write_commands(true);
  printf("\nCommands\n");
  write_commands(false);
  write_options(~0u);
  fputs(values_and_statuses, stdout);
}

void help_print_command(const Command *command) {
  Paragraph synopsis = {8, 0, false}, p = {0, 0, false};
  help_synopsis(command, write_word, &synopsis);
  fputs("\n\n", stdout);
  write_text(&p, command->help);
  write_options(command->options);
  if (command->options & OPTION_SET) fputs(values_and_statuses, stdout);
}
