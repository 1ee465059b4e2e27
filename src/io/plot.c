/* What the pictures share: what they ask of results, and how they define it for their templates. */
#include "io/plot.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "io/number.h"
#include "io/units.h"

size_t zp_plot_column(const ZpTable *table, const char *name) {
  size_t i = 0;
  while (i < table->columns && strcmp(table->column[i].name, name) != 0)
    i++;
  return i;
}

size_t zp_plot_count(const ZpTable *table, const char *name) {
  size_t numbers = 0, column = table ? zp_plot_column(table, name) : 0;
  for (size_t row = 0; table && column < table->columns && row < table->rows; row++)
    numbers += isfinite(table->value[row * table->columns + column]) != 0;
  return numbers;
}

bool zp_plot_has(const ZpTable *table, const char *name) {
  return zp_plot_count(table, name) >= 2;
}

ZpPlotBox zp_plot_box(const ZpShapes *shapes) {
  ZpPlotBox box = {INFINITY, -INFINITY, INFINITY, -INFINITY};
  for (size_t f = 0; f < shapes->frames; f++) {
    const ZpShape shape = zp_shapes_get(shapes, f);
    for (size_t i = 0; i < shapes->nodes * shapes->ribbons; i++) {
      if (!isfinite(shape.x[i]) || !isfinite(shape.y[i])) continue;
      box.left = fmin(box.left, shape.x[i]);
      box.right = fmax(box.right, shape.x[i]);
      box.bottom = fmin(box.bottom, shape.y[i]);
      box.top = fmax(box.top, shape.y[i]);
    }
  }
  return box;
}

void zp_plot_put(FILE *file, double value, char after) {
  char text[ZP_NUMBER_SIZE];
  zp_number_print(value, text, sizeof text);
  fprintf(file, "%s%c", text, after);
}

/* Write `text` as a gnuplot string that shows it as it is, in enhanced mode, too. */
static void put_text(FILE *file, const char *text) {
  fputc('\'', file);
  for (; *text; text++) {
    if (strchr("_^@&~{}\\", *text)) fputc('\\', file);
    if (*text == '\'') fputc('\'', file);
    fputc(iscntrl((unsigned char)*text) ? ' ' : *text, file); /* a new line would begin a command */
  }
  fputc('\'', file);
}

void zp_plot_define(FILE *file, const char *name, double value) {
  char text[ZP_NUMBER_SIZE];
  zp_number_print(value, text, sizeof text);
  const bool whole = text[strspn(text, "-0123456789")] == 0; /* gnuplot would divide it as a whole number */
  fprintf(file, "%s = %s%s\n", name, isfinite(value) ? text : "NaN", isfinite(value) && whole ? ".0" : "");
}

void zp_plot_define_count(FILE *file, const char *name, size_t value) {
  fprintf(file, "%s = %zu\n", name, value);
}

void zp_plot_define_text(FILE *file, const char *name, const char *text) {
  fprintf(file, "%s = ", name);
  put_text(file, text);
  fputc('\n', file);
}

/* A unit as pictures show it: "um" of the tables is "µm", "m2/s" is "m²/s". */
static void print_unit(const char *unit, char *text, size_t size) {
  size_t used = 0;
  text[0] = 0;
  for (const char *c = unit; *c && used < size; c++) {
    const char plain[2] = {*c, 0};
    const bool micro = *c == 'u' && c == unit && c[1];
    used += (size_t)snprintf(text + used, size - used, "%s", micro ? "µ" : *c == '2' ? "²" : *c == '3' ? "³" : plain);
  }
}

void zp_plot_print_value(int key, double value, char *text, size_t size) {
  enum { EXACT_MOST = 6 }; /* letters: what has more is rounded */
  char exact[64], unit[40], *end;
  zp_value_print(key, value, exact, sizeof exact);
  const double number = strtod(exact, &end);
  const int length = (int)(end - exact), digits = length > EXACT_MOST ? 4 : EXACT_MOST;
  print_unit(*end == ' ' ? end + 1 : "", unit, sizeof unit);
  if (length == 0) /* a word */
    snprintf(text, size, "%s", exact);
  else
    snprintf(text, size, "%.*g%s%s", digits, number, *unit ? " " : "", unit);
}

void zp_plot_define_word(FILE *file, const char *name, const char *word) {
  fprintf(file, "%s = '%s'\n", name, word);
}

/* Variables of gnuplot have letters, digits and underscores. */
static bool is_name(const char *text) {
  return !text[strspn(text, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_")];
}

ZpPlotRange zp_plot_range(const ZpTable *table, const char *name) {
  ZpPlotRange range = {NAN, NAN};
  const size_t column = table ? zp_plot_column(table, name) : 0;
  for (size_t row = 0; table && column < table->columns && row < table->rows; row++) {
    const double value = table->value[row * table->columns + column];
    if (!isfinite(value)) continue;
    range.low = fmin(range.low, value);
    range.high = fmax(range.high, value);
  }
  return range;
}

/* The names of columns with numbers, `columns`, and the range of each. */
static void define_table(const ZpTable *table, FILE *file) {
  fputs("columns = ' ", file);
  for (size_t i = 0; table && i < table->columns; i++)
    if (is_name(table->column[i].name) && zp_plot_has(table, table->column[i].name))
      fprintf(file, "%s ", table->column[i].name);
  fputs("'\n", file);
  for (size_t i = 0; table && i < table->columns; i++) {
    static const char *const what[] = {"largest", "lowest", "highest"};
    const char *name = table->column[i].name;
    const ZpPlotRange range = zp_plot_range(table, name);
    const double value[] = {fmax(fabs(range.low), fabs(range.high)), range.low, range.high};
    char variable[128];
    for (size_t k = 0; is_name(name) && !isnan(range.low) && k < 3; k++) {
      snprintf(variable, sizeof variable, "%s_%.80s", what[k], name);
      zp_plot_define(file, variable, value[k]);
    }
  }
}

/* Whether what is in the box can be seen where x and y have the same scale. */
static bool fits_same_scale(const ZpPlotBox *box) {
  const double width = box->right - box->left, height = box->top - box->bottom;
  return height > 0.25 * width && width > 0.15 * height;
}

void zp_plot_define_box(FILE *file, const ZpPlotBox *box) {
  zp_plot_define(file, "box_left", box->left);
  zp_plot_define(file, "box_right", box->right);
  zp_plot_define(file, "box_bottom", box->bottom);
  zp_plot_define(file, "box_top", box->top);
  zp_plot_define_count(file, "same_scale", fits_same_scale(box));
}

void zp_plot_define_array(FILE *file, const char *name, size_t count) {
  fprintf(file, "array %s[%zu]\n", name, count);
}

ZpPlotEntry zp_plot_entry(const char *name, size_t k) {
  ZpPlotEntry entry;
  if (k > 0)
    snprintf(entry.text, sizeof entry.text, "%s[%zu]", name, k);
  else
    snprintf(entry.text, sizeof entry.text, "%s", name);
  return entry;
}

double zp_plot_at_time(const ZpTable *table, const char *column, double time) {
  size_t nearest = 0;
  double least = INFINITY;
  for (size_t row = 0; table && row < table->rows; row++) {
    double distance = fabs(zp_table_get(table, row, "time_s") - time);
    if (distance < least) {
      least = distance;
      nearest = row;
    }
  }
  return table && table->rows > 0 ? zp_table_get(table, nearest, column) : (double)NAN;
}

size_t zp_plot_frame_at(const ZpShapes *shapes, double part) {
  double start = zp_shapes_get(shapes, 0).time,
         wanted = start + part * (zp_shapes_get(shapes, shapes->frames - 1).time - start);
  size_t nearest = 0;
  for (size_t i = 1; i < shapes->frames; i++)
    if (fabs(zp_shapes_get(shapes, i).time - wanted) < fabs(zp_shapes_get(shapes, nearest).time - wanted)) nearest = i;
  return nearest;
}

bool zp_plot_is_half(const ZpPlot *plot) {
  const ZpActuatorDef *def = &plot->def;
  return plot->single->shapes->ribbons > 1 && def->actuator.kind == ZP_KIND_ELECTRO_RIBBON &&
         def->actuator.symmetry == ZP_SYMMETRY_HALF;
}

size_t zp_plot_snapshots(const ZpShapes *shapes, size_t frame[ZP_PLOT_SNAPSHOTS]) {
  size_t count = 0;
  for (size_t k = 0; k < ZP_PLOT_SNAPSHOTS; k++) {
    const size_t next = zp_plot_frame_at(shapes, (double)k / (ZP_PLOT_SNAPSHOTS - 1));
    if (count == 0 || next != frame[count - 1]) frame[count++] = next;
  }
  return count;
}

bool zp_plot_has_frames(const ZpPlot *plot, size_t frames) {
  const ZpShapes *shapes = plot->single ? plot->single->shapes : NULL;
  return shapes && shapes->frames >= frames && isfinite(zp_plot_box(shapes).left);
}

/* -- what is defined for all ------------------------------------------------------------------------ */

/* The sentence of the small print. */
static const char *drag_note(const ZpPlot *plot) {
  if (zp_def_liquid(&plot->def) != ZP_LIQUID_NONE) return "times have not been compared with measured ones";
  return plot->def.damping.drag > 0
             ? "the only drag is c |v| v on each particle, not that of the liquid: times are not predictions"
             : "the drag of the liquid is not modelled: times are not predictions";
}

/* The shapes of the only run. */
static void define_shapes(const ZpPlot *plot, FILE *file) {
  const ZpShapes *shapes = plot->single->shapes;
  const ZpPlotBox box = zp_plot_box(shapes);
  zp_plot_define_count(file, "half", zp_plot_is_half(plot));
  zp_plot_define_count(file, "ribbons", shapes->ribbons);
  zp_plot_define_count(file, "members", shapes->members);
  zp_plot_define(file, "begin", zp_shapes_get(shapes, 0).time);
  zp_plot_define(file, "end", zp_shapes_get(shapes, shapes->frames - 1).time);
  zp_plot_define_box(file, &box);
}

/* Has the text this word? */
static bool mentions(const char *text, const char *word) {
  const size_t length = strlen(word);
  for (const char *at = text; (at = strstr(at, word)) != NULL; at += length) {
    const bool begins = at == text || !(isalnum((unsigned char)at[-1]) || at[-1] == '_');
    if (begins && !isalnum((unsigned char)at[length]) && at[length] != '_') return true;
  }
  return false;
}

/* "drive.voltage" as drive_voltage. */
static void define_key(const ZpPlot *plot, int index, const char *text, FILE *file) {
  const ZpKey *key = zp_key(index);
  char name[64];
  snprintf(name, sizeof name, "%s", key->name);
  for (char *c = name; *c; c++)
    if (*c == '.') *c = '_';
  if (key->type == ZP_KEY_TEXT || key->offset == ZP_NO_FIELD || !mentions(text, name)) return;
  const char *word = zp_key_word(index, zp_def_get(&plot->def, index));
  if (word && key->type == ZP_KEY_ENUM)
    zp_plot_define_word(file, name, word);
  else
    zp_plot_define(file, name, zp_def_get(&plot->def, index));
}

static void define_mentioned(const ZpPlot *plot, const char *text, FILE *file) {
  for (int key = 0; key < zp_key_count(); key++)
    define_key(plot, key, text, file);
  for (size_t i = 0; plot->single && i < plot->single->scalars; i++)
    if (is_name(plot->single->scalar[i].name) && mentions(text, plot->single->scalar[i].name))
      zp_plot_define(file, plot->single->scalar[i].name, plot->single->scalar[i].value);
}

void zp_plot_define_common(const ZpPlot *plot, const char *text, FILE *file) {
  zp_plot_define_text(file, "subtitle", plot->subtitle);
  if (!plot->report) return;
  zp_plot_define_text(file, "note", drag_note(plot));
  zp_plot_define_count(file, "motion", plot->shows == ZP_SHOWS_motion);
  zp_plot_define_count(file, "held", plot->shows == ZP_SHOWS_held_branch);
  define_mentioned(plot, text, file);
  define_table(plot->table, file);
  if (zp_plot_has_frames(plot, 1)) define_shapes(plot, file);
  if (!plot->single) zp_sweep_define(plot, file);
}

void zp_plot_define_key_axis(FILE *file, const char *name, size_t k, int index) {
  const ZpKey *key = zp_key(index);
  ZpUnitScale scale;
  char part[3][40], unit[40];
  const bool shown = *key->shown && zp_unit_scale(key->shown, key->unit, &scale, NULL) == ZP_OK;
  snprintf(part[0], sizeof part[0], "%s_name", name);
  snprintf(part[1], sizeof part[1], "%s_unit", name);
  snprintf(part[2], sizeof part[2], "%s_factor", name);
  zp_plot_define_text(file, zp_plot_entry(part[0], k).text, key->name);
  print_unit(shown ? key->shown : "", unit, sizeof unit);
  zp_plot_define_text(file, zp_plot_entry(part[1], k).text, unit);
  zp_plot_define(file, zp_plot_entry(part[2], k).text,
                 !shown          ? 1
                 : scale.decimal ? pow(10, -scale.exponent)
                                 : 1 / scale.factor);
}
