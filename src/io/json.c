/* JSON of summaries. jansson builds the tree and escapes the strings; everything else is printed here. */
#include "io/json.h"

#include <errno.h>
#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "io/number.h"

/* Largest integer that a double represents exactly. */
#define LARGEST_COUNT 9007199254740992.0

void zp_json_drop(json_t **tree) {
  json_decref(*tree);
  *tree = NULL;
}

void zp_json_set(json_t **object, const char *name, json_t *value) {
  if (json_object_set_new(*object, name, value)) zp_json_drop(object);
}

void zp_json_add(json_t **list, json_t *value) {
  if (json_array_append_new(*list, value)) zp_json_drop(list);
}

json_t *zp_json_number(double value, const char *unit) {
  if (!isfinite(value)) return json_null();
  if (strcmp(unit, "count") == 0 && fabs(value) <= LARGEST_COUNT) return json_integer((json_int_t)value);
  return json_real(value);
}

/* A real number keeps a point or an exponent, so that readers do not take 75.0 for an integer. */
static void print_real(FILE *file, double value) {
  char text[ZP_NUMBER_SIZE];
  zp_number_print(value, text, sizeof text);
  fputs(text, file);
  if (!strpbrk(text, ".e")) fputs(".0", file);
}

/* The depth from which on everything is on one line. */
enum { FLAT = -1 };

static int inside(int depth) {
  return depth == FLAT ? FLAT : depth + 1;
}

/* Two blanks per level, up to the deepest level. */
static void begin_line(FILE *file, int depth) {
  static const char line[] = "\n                                ";
  size_t length = 1 + 2 * (size_t)depth, most = sizeof line - 1;
  if (depth != FLAT) fwrite(line, 1, length < most ? length : most, file);
}

static bool print_tree(FILE *file, json_t *tree, int depth);

/* Everything except the closing brace. */
static bool print_members(FILE *file, json_t *object, int depth) {
  const char *name, *mark = "{";
  json_t *value;
  bool done = true;
  json_object_foreach(object, name, value) {
    fputs(mark, file);
    begin_line(file, inside(depth));
    fputc('"', file);
    fputs(name, file);
    fputs("\": ", file);
    done = print_tree(file, value, inside(depth)) && done;
    mark = depth == FLAT ? ", " : ",";
  }
  return done;
}

static bool print_object(FILE *file, json_t *object, int depth) {
  bool done = print_members(file, object, depth);
  begin_line(file, depth);
  fputc('}', file);
  return done;
}

static bool print_array(FILE *file, json_t *array, int depth) {
  bool done = true;
  for (size_t i = 0; i < json_array_size(array); i++) {
    fputs(i == 0 ? "[" : depth == FLAT ? ", " : ",", file);
    begin_line(file, inside(depth));
    done = print_tree(file, json_array_get(array, i), inside(depth)) && done;
  }
  begin_line(file, depth);
  fputc(']', file);
  return done;
}

/* Names of members need no escapes; jansson writes strings. */
static bool print_tree(FILE *file, json_t *tree, int depth) {
  switch (json_typeof(tree)) {
  case JSON_OBJECT:
    return json_object_size(tree) > 0 ? print_object(file, tree, depth) : fputs("{}", file) >= 0;
  case JSON_ARRAY:
    return json_array_size(tree) > 0 ? print_array(file, tree, depth) : fputs("[]", file) >= 0;
  case JSON_REAL:
    print_real(file, json_real_value(tree));
    return true;
  case JSON_NULL:
    return fputs("null", file) >= 0;
  default:
    return json_dumpf(tree, file, JSON_ENCODE_ANY) == 0;
  }
}

/* `done`: no error so far. */
static ZpStatus finish(FILE *file, bool done, ZpError *err) {
  done = fputc('\n', file) != EOF && done;
  if (done && fflush(file) == 0 && !ferror(file)) return ZP_OK;
  return zp_fail(err, ZP_MACHINE, "cannot write summary.json: %s", strerror(errno ? errno : EIO));
}

/* Print the list in the format of print_array. */
static bool print_list(FILE *file, size_t count, ZpJsonItem item, const void *user) {
  bool done = true;
  for (size_t i = 0; i < count && done; i++) {
    json_t *tree = item(user, i);
    fprintf(file, "%s\n    ", i ? "," : "[");
    done = tree && print_tree(file, tree, 2);
    json_decref(tree);
  }
  fputs(count > 0 ? "\n  ]" : "[]", file);
  return done;
}

ZpStatus zp_json_write_list(json_t *head, const char *name, size_t count, ZpJsonItem item, const void *user, FILE *file,
                            ZpError *err) {
  errno = 0;
  bool done = print_members(file, head, 0);
  fprintf(file, ",\n  \"%s\": ", name);
  done = print_list(file, count, item, user) && done;
  fputs("\n}", file);
  return finish(file, done, err);
}

ZpStatus zp_json_write(json_t *tree, bool flat, FILE *file, ZpError *err) {
  errno = 0;
  return finish(file, print_tree(file, tree, flat ? FLAT : 0), err);
}
