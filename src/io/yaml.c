/* The part of YAML in scenarios, read through the events of libfyaml.
 *
 * Events and not documents: so the depth is bounded here before anything is built, and each item has its line. Anchors,
 * aliases, tags, several documents and keys that are not words are refused, because they have no meaning in a scenario.
 * libfyaml collects its messages instead of printing them, and the first one becomes our message. Some input is refused
 * before libfyaml sees it: sizes over 1 MB, control characters, invalid UTF-8, tabs as indentation. */
#include "io/yaml.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include <libfyaml.h>

#include "base/fail.h"
#include "io/guard.h"
#include "io/value.h"

enum {
  DEEPEST = 8,        /* depth of nested mappings; keys have one point */
  LONGEST_PATH = 256, /* bytes */
  ROOM = 1 << 20      /* memory that libfyaml may need, bytes, and 4 for each byte of the text */
};

/* A reading in progress. */
typedef struct Walk {
  const ZpSource *source;
  struct fy_parser *parser;
  struct fy_event *event; /* the one that is read; NULL: none yet */
  struct fy_diag *diag;   /* collects messages of the parser */
  ZpYamlVisit visit;
  void *user;
  ZpError *err;
  char path[LONGEST_PATH]; /* path of the mapping or value that is being read */
  int line;                /* line of the last token that has one */
  char *words;             /* words of the value or list that is being read, each with its 0 */
  size_t used, capacity;   /* bytes */
} Walk;

/* Probable mistakes behind messages of libfyaml that name rules of YAML. */
static const struct {
  const char *message, *question;
} questions[] = {
    {"invalid multiline plain key", "is the next line indented more, or a value with a colon not in quotes?"},
    {"invalid value after mapping", "is the blank after a colon missing, or the colon?"},
    {"invalid indentation in mapping", "is the line indented less than the one before it?"},
    {"wrongly indented double-quoted scalar", "is a quote not closed?"},
    {"wrongly indented single-quoted scalar", "is a quote not closed?"},
    {"missing comma in flow mapping", "is a brace not closed?"},
};

/* The first error of libfyaml. */
static ZpStatus fail_syntax(Walk *walk) {
  void *position = NULL;
  const struct fy_diag_error *error = fy_diag_errors_iterate(walk->diag, &position);
  if (!error || !error->msg) return zp_source_fail(walk->source, walk->line, walk->err, "not YAML");
  const char *place = walk->source->argument ? " of the value" : "";
  const char *question = NULL;
  for (size_t i = 0; i < sizeof questions / sizeof questions[0] && !question; i++)
    if (strcmp(error->msg, questions[i].message) == 0) question = questions[i].question;
  return zp_source_fail(walk->source, error->line, walk->err, "column %d%s: %s%s%s", error->column, place, error->msg,
                        question ? "; " : "", question ? question : "");
}

__attribute__((format(printf, 2, 3))) static ZpStatus fail_here(Walk *walk, const char *format, ...) {
  char reason[256];
  va_list args;
  va_start(args, format);
  vsnprintf(reason, sizeof reason, format, args);
  va_end(args);
  const char *colon = *walk->path ? ": " : "";
  return zp_source_fail(walk->source, walk->line, walk->err, "%.80s%s%s", walk->path, colon, reason);
}

/* Go to the next event, walk->event. */
static ZpStatus advance(Walk *walk) {
  if (walk->event) fy_parser_event_free(walk->parser, walk->event);
  struct fy_event *event = walk->event = fy_parser_parse(walk->parser);
  if (!event) return fail_syntax(walk);
  const bool begins = event->type == FYET_SCALAR || event->type == FYET_SEQUENCE_START ||
                      event->type == FYET_MAPPING_START || event->type == FYET_ALIAS;
  struct fy_token *token = begins ? fy_event_get_token(event) : NULL;
  const struct fy_mark *mark = token ? fy_token_start_mark(token) : NULL;
  if (mark) walk->line = mark->line + 1;
  if (event->type == FYET_ALIAS || fy_event_get_anchor_token(event) || fy_event_get_tag_token(event))
    return fail_here(walk, "a scenario cannot have anchors (&), aliases (*) and tags (!)");
  return ZP_OK;
}

/* Add the word of a scalar event to walk->words. */
static ZpStatus add_word(Walk *walk) {
  size_t length = 0;
  struct fy_token *value = walk->event->scalar.value;
  const char *text = value ? fy_token_get_text(value, &length) : "";
  if (!text) return zp_fail_memory(walk->err);
  if (length >= ZP_VALUE_SIZE) return fail_here(walk, "value longer than %d bytes", ZP_VALUE_SIZE - 1);
  if (memchr(text, 0, length)) return fail_here(walk, "value with a zero byte");
  if (walk->used + length + 1 > walk->capacity) {
    size_t capacity = 2 * walk->capacity + ZP_VALUE_SIZE;
    char *words = realloc(walk->words, capacity);
    if (!words) return zp_fail_memory(walk->err);
    walk->words = words;
    walk->capacity = capacity;
  }
  memcpy(walk->words + walk->used, text, length);
  walk->words[walk->used + length] = 0;
  walk->used += length + 1;
  return ZP_OK;
}

static ZpStatus visit(Walk *walk, ZpYamlKind kind, int line, size_t count) {
  ZpYamlItem item = {kind, walk->path, line, walk->words, count};
  walk->used = 0;
  return walk->visit(walk->user, &item, walk->err);
}

/* The words of a list up to its end. */
static ZpStatus read_list(Walk *walk, int line) {
  size_t count = 0;
  ZpStatus status = advance(walk);
  for (; status == ZP_OK && walk->event->type == FYET_SCALAR; count++) {
    status = add_word(walk);
    if (status == ZP_OK) status = advance(walk);
  }
  if (status != ZP_OK) return status;
  if (walk->event->type == FYET_SEQUENCE_END) return visit(walk, ZP_YAML_LIST, line, count);
  return fail_here(walk, "a list holds values only, not lists or groups");
}

/* Append the key that is read to walk->path, of which `base` bytes stay. */
static ZpStatus enter_key(Walk *walk, size_t base) {
  if (walk->event->type != FYET_SCALAR) return fail_here(walk, "a key must be a word");
  ZpStatus status = add_word(walk);
  if (status != ZP_OK) return status;
  walk->used = 0;
  if (*walk->words == 0) return fail_here(walk, "empty key");
  size_t room = sizeof walk->path - base;
  int length = snprintf(walk->path + base, room, "%s%s", base ? "." : "", walk->words);
  if (length < 0 || (size_t)length >= room) return fail_here(walk, "key too long");
  return ZP_OK;
}

static ZpStatus read_node(Walk *walk, int depth, int line);

/* The pairs of a mapping up to its end; walk->path is its path. */
static ZpStatus read_mapping(Walk *walk, int depth, int line) {
  const size_t base = strlen(walk->path);
  ZpStatus status = advance(walk);
  while (status == ZP_OK && walk->event->type != FYET_MAPPING_END) {
    status = enter_key(walk, base);
    const int line_of_key = walk->line;
    if (status == ZP_OK) status = advance(walk);
    if (status == ZP_OK) status = read_node(walk, depth + 1, line_of_key);
    walk->path[base] = 0;
    if (status == ZP_OK) status = advance(walk);
  }
  return status == ZP_OK ? visit(walk, ZP_YAML_GROUP, line, 0) : status;
}

/* The value of a key, or the root. */
static ZpStatus read_node(Walk *walk, int depth, int line) {
  ZpStatus status;
  switch (walk->event->type) {
  case FYET_SCALAR:
    status = add_word(walk);
    return status == ZP_OK ? visit(walk, ZP_YAML_VALUE, line, 1) : status;
  case FYET_SEQUENCE_START:
    return read_list(walk, line);
  case FYET_MAPPING_START:
    if (depth > DEEPEST) return fail_here(walk, "nested deeper than %d levels", DEEPEST);
    return read_mapping(walk, depth, line);
  default:
    return fail_here(walk, "a value, a list or a group of keys is expected here");
  }
}

/* The root of a scenario is keys, or nothing; that of a value is anything but keys. */
static ZpStatus read_root(Walk *walk, bool is_value) {
  const struct fy_event *event = walk->event;
  const bool mapping = event->type == FYET_MAPPING_START;
  size_t length = 0;
  if (is_value && mapping) return fail_here(walk, "give one value or a list in [ ]");
  if (is_value || mapping) return read_node(walk, 0, walk->line);
  const bool empty = event->type == FYET_SCALAR &&
                     (!event->scalar.value || (fy_token_get_text(event->scalar.value, &length) && length == 0));
  return empty ? ZP_OK : fail_here(walk, "a scenario consists of lines \"key: value\"");
}

/* The next event must be of a type. */
static ZpStatus expect(Walk *walk, enum fy_event_type type, const char *otherwise) {
  ZpStatus status = advance(walk);
  return status == ZP_OK && walk->event->type != type ? fail_here(walk, "%s", otherwise) : status;
}

/* One document, or none, and nothing after it. */
static ZpStatus read_stream(Walk *walk, bool is_value) {
  ZpStatus status = expect(walk, FYET_STREAM_START, "not YAML");
  if (status == ZP_OK) status = advance(walk);
  if (status != ZP_OK || walk->event->type == FYET_STREAM_END) return status;
  status = advance(walk);
  if (status == ZP_OK) status = read_root(walk, is_value);
  if (status == ZP_OK) status = expect(walk, FYET_DOCUMENT_END, "not YAML");
  return status == ZP_OK ? expect(walk, FYET_STREAM_END, "more than one document") : status;
}

/* Does the indentation of a line contain a tab, and does text follow it? */
static bool has_tab_indent(const char *text, size_t size) {
  bool tab = false;
  size_t i = 0;
  for (; i < size && (text[i] == ' ' || text[i] == '\t'); i++)
    tab |= text[i] == '\t';
  return tab && i < size && !strchr("#\r\n", text[i]);
}

/* Refuse input that libfyaml need not see. */
static ZpStatus check_text(const ZpSource *source, const char *text, size_t size, ZpError *err) {
  if (size > ZP_YAML_LARGEST) return zp_source_fail(source, 0, err, "larger than 1 MB, too large for a scenario");
  int line = 1;
  for (size_t i = 0; i < size;) {
    size_t length = zp_text_character(text + i, size - i);
    if (length == 0) return zp_source_fail(source, line, err, "not UTF-8 text, or a control character");
    bool line_start = i == 0 || text[i - 1] == '\n';
    if (line_start && has_tab_indent(text + i, size - i))
      return zp_source_fail(source, line, err, "a tab as indentation; use spaces");
    if (text[i] == '\n') line++;
    i += length;
  }
  return ZP_OK;
}

static ZpStatus open_parser(Walk *walk, const char *text, size_t size) {
  struct fy_diag_cfg diag_config;
  fy_diag_cfg_default(&diag_config);
  diag_config.fp = NULL; /* not to stderr */
  diag_config.level = FYET_ERROR;
  walk->diag = fy_diag_create(&diag_config);
  if (!walk->diag) return zp_fail_memory(walk->err);
  fy_diag_set_collect_errors(walk->diag, true);
  struct fy_parse_cfg config = {.search_path = "", .flags = FYPCF_QUIET | FYPCF_JSON_NONE, .diag = walk->diag};
  walk->parser = fy_parser_create(&config);
  if (!walk->parser || fy_parser_set_string(walk->parser, text, size))
    return zp_fail(walk->err, ZP_MACHINE, "libfyaml cannot start");
  return ZP_OK;
}

static ZpStatus parse(Walk *walk, const char *text, size_t size, bool is_value) {
  ZpStatus status = open_parser(walk, text, size);
  if (status == ZP_OK) status = read_stream(walk, is_value);
  if (walk->event) fy_parser_event_free(walk->parser, walk->event);
  if (walk->parser) fy_parser_destroy(walk->parser);
  fy_diag_destroy(walk->diag);
  free(walk->words);
  return status;
}

ZpStatus zp_yaml_read(const ZpSource *source, const char *text, size_t size, bool is_value, ZpYamlVisit visitor,
                      void *user, ZpError *err) {
  ZpGuard guard;
  ZpStatus status = check_text(source, text, size, err);
  if (status == ZP_OK) status = zp_guard_enter(&guard, "libfyaml", ROOM + 4 * size, err);
  if (status != ZP_OK) return status;
  Walk walk = {.source = source, .visit = visitor, .user = user, .err = err, .line = 1};
  status = parse(&walk, text, size, is_value);
  zp_guard_leave(&guard);
  return status;
}

/* Length of the group in the name of a key: 6 in "ribbon.length", 0 in "gravity". */
static size_t group_of(const char *name) {
  const char *point = strrchr(name, '.');
  return point ? (size_t)(point - name) : 0;
}

int zp_yaml_write_key(FILE *file, const char *name, const char *before) {
  size_t group = group_of(name);
  if (group == 0) return fprintf(file, "%s: ", name);
  bool same = before && group_of(before) == group && strncmp(name, before, group) == 0;
  if (!same) fprintf(file, "%.*s:\n", (int)group, name);
  return fprintf(file, "  %s: ", name + group + 1);
}

void zp_yaml_write_text(FILE *file, const char *text) {
  fputc('"', file);
  for (; *text; text++)
    fprintf(file, "%s%c", *text == '"' || *text == '\\' ? "\\" : "", *text);
  fputc('"', file);
}
