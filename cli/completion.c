/* zipact completion: scripts with which a shell completes the command line, from its tables. */
#include <stdio.h>
#include <string.h>

#include "cli.h"

#define SHELLS "bash zsh fish"

static void write_commands(void) {
  for (const Command *c = word_commands; c->word; c++)
    printf("%s%s", c > word_commands ? " " : "", c->word);
}

/* Not one that stands for those of all members. */
static bool is_key(int index) {
  return zp_key_in_def(index) || index == zp_key_find("study");
}

static void write_keys(void) {
  for (int i = 0; i < zp_key_count(); i++)
    if (is_key(i)) printf("%s%s=", i ? " " : "", zp_key(i)->name);
}

/* "--set --output ..." of the options `taken`. */
static void write_options(unsigned taken) {
  for (int i = 0; i < OPTION_COUNT; i++)
    if (taken & 1u << i) printf("%s--%s", 1u << i == OPTION_SET ? "" : " ", word_options[i].word);
}

/* The options of each command as branches of a `case`. */
static void write_cases(const char *indent) {
  for (const Command *c = word_commands; c->word; c++) {
    printf("%s%s) options='", indent, c->word);
    write_options(c->options);
    printf("' ;;\n");
  }
}

/* The values of the keys that take words, as branches of a `case`. */
static void write_values(const char *indent) {
  for (int i = 0; i < zp_key_count(); i++) {
    const ZpKey *key = zp_key(i);
    if (!key->choices && key->type != ZP_KEY_BOOL) continue;
    printf("%s%s) values='", indent, key->name);
    for (int j = 0; key->choices && j <= (int)key->max; j++)
      printf("%s%s", j ? " " : "", key->choices[j].word);
    printf("%s' ;;\n", key->choices ? "" : "true false");
  }
}

/* Bash cuts words at "=", so KEY=VALUE comes as three words. */
static void write_bash(void) {
  printf("# bash completion of zipact: source <(zipact completion bash)\n"
         "_zipact() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} options='' values='' key=''\n"
         "  COMPREPLY=()\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
         "    COMPREPLY=($(compgen -W '");
  write_commands();
  printf(" --help --version' -- \"$word\"))\n"
         "    return\n"
         "  fi\n"
         "  case ${COMP_WORDS[1]} in\n");
  write_cases("    ");
  printf("  esac\n"
         "  if [ \"$word\" = = ]; then key=$before; word=''\n"
         "  elif [ \"$before\" = = ]; then key=${COMP_WORDS[COMP_CWORD-2]}\n"
         "  fi\n"
         "  case $key in\n");
  write_values("    ");
  printf("  esac\n"
         "  if [ -n \"$key\" ]; then COMPREPLY=($(compgen -W \"$values\" -- \"$word\")); return; fi\n"
         "  case $before in\n"
         "    --set)\n"
         "      COMPREPLY=($(compgen -W '");
  write_keys();
  printf("' -- \"$word\"))\n"
         "      compopt -o nospace 2>/dev/null\n"
         "      return ;;\n"
         "    -o | --output) COMPREPLY=($(compgen -f -- \"$word\")); return ;;\n"
         "    --fmi) COMPREPLY=($(compgen -W '2 3' -- \"$word\")); return ;;\n"
         "    --jobs) return ;;\n"
         "    completion) COMPREPLY=($(compgen -W '" SHELLS "' -- \"$word\")); return ;;\n"
         "  esac\n"
         "  case $word in\n"
         "    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
         "    *) COMPREPLY=($(compgen -f -X '!*.yaml' -- \"$word\") $(compgen -d -- \"$word\")) ;;\n"
         "  esac\n"
         "}\n"
         "complete -o filenames -F _zipact zipact\n");
}

static void write_zsh(void) {
  printf("#compdef zipact\n"
         "# zsh completion of zipact: source <(zipact completion zsh)\n"
         "_zipact() {\n"
         "  local options='' values='' key=${words[CURRENT]%%%%=*}\n"
         "  if (( CURRENT == 2 )); then compadd -- ");
  write_commands();
  printf(" --help --version; return; fi\n"
         "  case ${words[2]} in\n");
  write_cases("    ");
  printf("  esac\n"
         "  case ${words[CURRENT-1]} in\n"
         "    --set)\n"
         "      if [[ ${words[CURRENT]} == *=* ]]; then\n"
         "        case $key in\n");
  write_values("          ");
  printf("        esac\n"
         "        compset -P '*='\n"
         "        compadd -- ${=values}\n"
         "      else\n"
         "        compadd -S '' -- ");
  write_keys();
  printf("\n"
         "      fi\n"
         "      return ;;\n"
         "    -o | --output) _files; return ;;\n"
         "    --fmi) compadd -- 2 3; return ;;\n"
         "    --jobs) return ;;\n"
         "    completion) compadd -- " SHELLS "; return ;;\n"
         "  esac\n"
         "  if [[ ${words[CURRENT]} == -* ]]; then compadd -- ${=options}; else _files -g '*.(yaml|yml)'; fi\n"
         "}\n"
         "if [[ ${funcstack[1]} == _zipact ]]; then _zipact \"$@\"; else compdef _zipact zipact; fi\n");
}

/* A text between single quotes. */
static void write_quoted(const char *text) {
  putchar('\'');
  for (; *text; text++) {
    if (*text == '\'' || *text == '\\') putchar('\\');
    putchar(*text);
  }
  putchar('\'');
}

static void write_fish_options(void) {
  for (int i = 0; i < OPTION_COUNT; i++) {
    const Option *option = &word_options[i];
    if (1u << i == OPTION_SET) continue;
    printf("complete -c zipact -n '__fish_seen_subcommand_from");
    for (const Command *c = word_commands; c->word; c++)
      if (c->options & 1u << i) printf(" %s", c->word);
    printf("' -l %s %s-d ", option->word, option->argument ? "-r " : "");
    write_quoted(option->help);
    putchar('\n');
  }
}

static void write_fish(void) {
  printf("# fish completion of zipact: zipact completion fish | source\n");
  for (const Command *c = word_commands; c->word; c++) {
    printf("complete -c zipact -n __fish_use_subcommand -f -a %s -d ", c->word);
    write_quoted(c->help);
    putchar('\n');
  }
  write_fish_options();
  printf("complete -c zipact -n '__fish_seen_subcommand_from completion' -f -a '" SHELLS "'\n");
  for (int i = 0; i < zp_key_count(); i++) {
    if (!is_key(i)) continue;
    printf("complete -c zipact -l set -x -a '%s=' -d ", zp_key(i)->name);
    write_quoted(zp_key(i)->help);
    putchar('\n');
  }
}

int cli_completion(const Options *options) {
  static const struct {
    const char *shell;
    void (*write)(void);
  } known[] = {{"bash", write_bash}, {"zsh", write_zsh}, {"fish", write_fish}};
  for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
    if (strcmp(options->scenario, known[i].shell) != 0) continue;
    known[i].write();
    return EXIT_DONE;
  }
  fprintf(stderr, "zipact: completion: unknown shell %s; use one of " SHELLS "\n", options->scenario);
  return EXIT_INPUT;
}
