/* What the pictures share. */
#include "io/plot.h"

#include <math.h>
#include <string.h>

#include <zipact/version.h>

#include "io/number.h"

ZpPlotUnit zp_plot_unit(double largest, const char *unit) {
  static const char *const prefix[] = {"f", "p", "n", "µ", "m", "", "k", "M", "G", "T"};
  static const double gram = 1e-3;
  int step = 0;
  if (strcmp(unit, "kg") == 0) { /* has a prefix already */
    ZpPlotUnit shown = zp_plot_unit(largest / gram, "g");
    shown.factor /= gram;
    return shown;
  }
  if (isfinite(largest) && largest > 0) step = (int)floor((log10(largest) + 1e-9) / 3);
  step = step < -5 ? -5 : step > 4 ? 4 : step;
  ZpPlotUnit shown = {.factor = pow(10, -3.0 * step)};
  snprintf(shown.text, sizeof shown.text, "%s%s", prefix[step + 5], unit);
  return shown;
}

/* Column number, or table->columns if there is none of this name. */
static size_t column_of(const ZpTable *table, const char *name) {
  size_t i = 0;
  while (i < table->columns && strcmp(table->column[i].name, name) != 0)
    i++;
  return i;
}

/* (table, column) => largest absolute value, and how many values are numbers. */
static double largest_of(const ZpTable *table, const char *name, size_t *numbers) {
  size_t column = column_of(table, name);
  double largest = 0;
  *numbers = 0;
  for (size_t row = 0; column < table->columns && row < table->rows; row++) {
    double value = fabs(table->value[row * table->columns + column]);
    if (!isfinite(value)) continue;
    ++*numbers;
    if (value > largest) largest = value;
  }
  return largest;
}

ZpPlotUnit zp_plot_table_unit(const ZpTable *table, const char *const *column, const char *unit) {
  double largest = 0;
  for (; *column; column++) {
    size_t numbers;
    double value = largest_of(table, *column, &numbers);
    if (value > largest) largest = value;
  }
  return zp_plot_unit(largest, unit);
}

bool zp_plot_has(const ZpTable *table, const char *column) {
  size_t numbers = 0;
  if (table) largest_of(table, column, &numbers);
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

bool zp_plot_fits_same_scale(const ZpPlotBox *box) {
  const double width = box->right - box->left, height = box->top - box->bottom;
  return height > 0.15 * width && width > 0.15 * height;
}

ZpPlotUnit zp_plot_box_unit(const ZpPlotBox *box) {
  return zp_plot_unit(fmax(fmax(fabs(box->left), fabs(box->right)), box->top - box->bottom), "m");
}

double zp_plot_step(double range, int tics) {
  double least = range / tics;
  if (!(least > 0)) return 0;
  double power = pow(10, floor(log10(least))), step = least / power;
  return power * (step <= 1 ? 1 : step <= 2 ? 2 : step <= 5 ? 5 : 10);
}

void zp_plot_same_scale(FILE *file, const ZpPlotBox *box, ZpPlotUnit unit, int tics) {
  double step = zp_plot_step(fmax(box->right - box->left, box->top - box->bottom) * unit.factor, tics);
  if (step > 0) fprintf(file, "set size ratio -1\nset xtics %.6g\nset ytics %.6g\n", step, step);
}

void zp_plot_put(FILE *file, double value, char after) {
  char text[ZP_NUMBER_SIZE];
  zp_number_print(value, text, sizeof text);
  fprintf(file, "%s%c", text, after);
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

void zp_plot_text(FILE *file, const char *text) {
  fputc('\'', file);
  for (; *text; text++) {
    if (strchr("_^@&~{}\\", *text)) fputc('\\', file);
    if (*text == '\'') fputc('\'', file);
    fputc(*text, file);
  }
  fputc('\'', file);
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

void zp_plot_head_of_shapes(const ZpPlot *plot, FILE *file, const char *name, const char *title, double right) {
  char text[96];
  snprintf(text, sizeof text, "%s%s", title, zp_plot_is_half(plot) ? ", left half" : "");
  zp_plot_head(plot, file, name, text, right);
}

void zp_plot_head(const ZpPlot *plot, FILE *file, const char *name, const char *title, double right) {
  fprintf(file,
          "# Made by zipact " ZP_VERSION "; draw again with: gnuplot %s.gp\n"
          "if (!exists('out')) out = '%s.svg'\n"
          "set encoding utf8\n"
          "set terminal svg size 800,500 dynamic enhanced font 'Helvetica,14' background '#ffffff'\n"
          "set output out\n"
          "set grid lc rgb '#dddddd' lw 1 lt 1\n"
          "set border lc rgb '#333333'\n"
          "set tics nomirror\n"
          "set lmargin at screen 0.11\n"
          "set rmargin at screen %g\n"
          "set bmargin at screen 0.17\n"
          "set tmargin at screen 0.86\n"
          "set key at screen %g,0.86 left top Left reverse samplen 2 spacing 1.2 font ',12'\n",
          name, name, right, right + 0.015);
  fputs("set label 1 ", file);
  zp_plot_text(file, title);
  fputs(" at screen 0.11,0.955 left font ',17'\nset label 2 ", file);
  zp_plot_text(file, plot->subtitle);
  fputs(" at screen 0.11,0.905 left font ',12' tc rgb '#555555'\n", file);
}

const char *zp_plot_drag_note(const ZpPlot *plot) {
  if (zp_def_liquid(&plot->def) != ZP_LIQUID_NONE) return "times have not been compared with measured ones";
  return plot->def.damping.drag > 0
             ? "the only drag is c |v| v on each particle, not that of the liquid: times are not predictions"
             : "the drag of the liquid is not modelled: times are not predictions";
}

void zp_plot_foot(const ZpPlot *plot, FILE *file, const char *more) {
  fputs("set label 3 ", file);
  zp_plot_text(file, zp_plot_drag_note(plot));
  fputs(" at screen 0.985,0.025 right font ',10' tc rgb '#555555'\n", file);
  if (more) zp_plot_remark(file, more);
}

void zp_plot_remark(FILE *file, const char *text) {
  fputs("set label 4 ", file);
  zp_plot_text(file, text);
  fputs(" at screen 0.015,0.025 left font ',10' tc rgb '#555555'\n", file);
}

void zp_plot_upper_panel(FILE *file) {
  fputs("set multiplot\nset bmargin at screen 0.555\nset format x ''\nunset xlabel\n", file);
}

void zp_plot_lower_panel(FILE *file, double right, const char *xlabel) {
  fprintf(file,
          "unset label\nset tmargin at screen 0.505\nset bmargin at screen 0.17\n"
          "set key at screen %g,0.505\nset format x '%%g'\nset xlabel '%s'\n",
          right + 0.015, xlabel);
}

const char *zp_plot_colour(size_t index) {
  static const char *const colour[ZP_COLOURS] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                 "#56b4e9", "#e69f00", "#000000", "#b8a800"};
  return colour[index % ZP_COLOURS];
}

unsigned zp_plot_shade(double place) {
  static const double scale[][3] = {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {200, 208, 32}};
  int from = place < 1 ? (int)(4 * place) : 3;
  unsigned colour = 0;
  for (int i = 0; i < 3; i++) {
    double part = scale[from][i] + (4 * place - from) * (scale[from + 1][i] - scale[from][i]);
    colour = colour << 8 | (unsigned)lround(part);
  }
  return colour;
}

void zp_plot_curve(FILE *file, bool first, ZpPlotUnit time, const char *expression, const char *title, size_t colour) {
  fprintf(file, "%s'../table.csv' using (column('time_s')*%g):(%s) with lines lw 2 lc rgb '%s' title '%s'",
          first ? "plot " : ", \\\n     ", time.factor, expression, zp_plot_colour(colour), title);
}
