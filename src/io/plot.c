/* What the pictures share: what they ask of results, and how they define it for their templates. */
#include "io/plot.h"

#include <math.h>
#include <string.h>

#include "io/number.h"

/* Column number, or table->columns if there is none of this name. */
static size_t column_of(const ZpTable *table, const char *name) {
  size_t i = 0;
  while (i < table->columns && strcmp(table->column[i].name, name) != 0)
    i++;
  return i;
}

bool zp_plot_has(const ZpTable *table, const char *name) {
  size_t numbers = 0, column = table ? column_of(table, name) : 0;
  for (size_t row = 0; table && column < table->columns && row < table->rows; row++)
    numbers += isfinite(table->value[row * table->columns + column]) != 0;
  return numbers >= 2;
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
    fputc(*text, file);
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

void zp_plot_define_word(FILE *file, const char *name, const char *word) {
  fprintf(file, "%s = '%s'\n", name, word);
}

void zp_plot_define_key(const ZpPlot *plot, FILE *file, const char *key) {
  const int index = zp_key_find(key);
  const double value = zp_def_get(&plot->def, index);
  char name[64];
  snprintf(name, sizeof name, "%s", key);
  for (char *c = name; *c; c++)
    if (*c == '.') *c = '_';
  if (zp_key(index)->type == ZP_KEY_ENUM)
    zp_plot_define_word(file, name, zp_key(index)->choices[(size_t)value].word);
  else
    zp_plot_define(file, name, value);
}

void zp_plot_define_scalar(const ZpPlot *plot, FILE *file, const char *name) {
  zp_plot_define(file, name, zp_result_get(plot->single, name));
}

/* Variables of gnuplot have letters, digits and underscores. */
static bool is_name(const char *text) {
  return !text[strspn(text, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_")];
}

static void define_of_column(FILE *file, const char *what, const char *column, double value) {
  char name[96];
  snprintf(name, sizeof name, "%s_%.80s", what, column);
  zp_plot_define(file, name, value);
}

void zp_plot_define_table(FILE *file, const ZpTable *table) {
  fputs("columns = ' ", file);
  for (size_t i = 0; i < table->columns; i++)
    if (is_name(table->column[i].name) && zp_plot_has(table, table->column[i].name))
      fprintf(file, "%s ", table->column[i].name);
  fputs("'\n", file);
  for (size_t i = 0; i < table->columns; i++) {
    const char *column = table->column[i].name;
    double lowest = NAN, highest = NAN;
    if (!is_name(column)) continue;
    for (size_t row = 0; row < table->rows; row++) {
      const double value = table->value[row * table->columns + i];
      if (!isfinite(value)) continue;
      lowest = fmin(lowest, value);
      highest = fmax(highest, value);
    }
    if (isnan(lowest)) continue;
    define_of_column(file, "largest", column, fmax(fabs(lowest), fabs(highest)));
    define_of_column(file, "lowest", column, lowest);
    define_of_column(file, "highest", column, highest);
  }
}

/* Whether what is in the box can be seen where x and y have the same scale. */
static bool fits_same_scale(const ZpPlotBox *box) {
  const double width = box->right - box->left, height = box->top - box->bottom;
  return height > 0.15 * width && width > 0.15 * height;
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
  snprintf(entry.text, sizeof entry.text, "%s[%zu]", name, k);
  return entry;
}

void zp_plot_put_shape(FILE *file, const ZpShapes *shapes, const ZpShape *shape, double more) {
  for (size_t r = 0; r < shapes->ribbons; r++) {
    for (size_t i = 0; i < shapes->nodes; i++) {
      zp_plot_put(file, shape->x[i * shapes->ribbons + r], ' ');
      zp_plot_put(file, shape->y[i * shapes->ribbons + r], ' ');
      zp_plot_put(file, more, '\n');
      if (!zp_plot_ends_member(shapes, i)) continue;
      fputs("NaN NaN ", file);
      zp_plot_put(file, more, '\n');
    }
  }
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

const char *zp_plot_drag_note(const ZpPlot *plot) {
  if (zp_def_liquid(&plot->def) != ZP_LIQUID_NONE) return "times have not been compared with measured ones";
  return plot->def.damping.drag > 0
             ? "the only drag is c |v| v on each particle, not that of the liquid: times are not predictions"
             : "the drag of the liquid is not modelled: times are not predictions";
}
