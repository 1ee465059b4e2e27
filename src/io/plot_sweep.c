/* Pictures of a sweep: contraction.svg, all runs over time, bode.svg against the frequency of a drive, and what a study
 * asks for against the list key that varies fastest: zip_time.svg, strokes.svg, voltages.svg, frequencies.svg,
 * factors.svg; forces.svg and torques.svg, a curve for each value of the others. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "io/report.h"
#include "io/sampled.h"
#include "io/sweep.h"
#include "io/units.h"

/* Curves that the legend names, and rows that all curves together may have: a picture of more is slow to
 * look at and shows no more. */
#define LEGEND 10
#define ROWS   200000

#define RIGHT 0.76

static bool is_sweep(const ZpPlot *plot) {
  return plot->shows == ZP_SHOWS_motion && !plot->single && plot->report->count > 0;
}

static bool is_ribbon(const ZpPlot *plot) {
  return plot->def.actuator.kind == ZP_KIND_RIBBON;
}

/* What is drawn over time. */
static const char *column(const ZpPlot *plot) {
  return is_ribbon(plot) ? "stroke_m" : "contraction";
}

static const ZpTable *series(const ZpPlot *plot, size_t run) {
  return zp_report_result(plot->report, run)->series;
}

static bool has_contraction(const ZpPlot *plot) {
  for (size_t i = 0; is_sweep(plot) && i < plot->report->count; i++)
    if (zp_plot_has(series(plot, i), column(plot))) return true;
  return false;
}

/* Colour of a run: one of a few that differ much, or a place on a scale from dark to light. */
static unsigned colour_of(const ZpPlot *plot, size_t run) {
  unsigned colour = 0;
  if (plot->report->count <= ZP_COLOURS) {
    sscanf(zp_plot_colour(run), "#%x", &colour);
    return colour;
  }
  return zp_plot_shade((double)run / (double)(plot->report->count - 1));
}

/* A block per run: time, value, colour; NaN between them (plot_shapes.c says why). */
static void data_contraction(const ZpPlot *plot, FILE *file) {
  fprintf(file, "# time_s %s colour; NaN between runs\n", column(plot));
  for (size_t run = 0; run < plot->report->count; run++) {
    const ZpTable *table = series(plot, run);
    size_t rows = table ? table->rows : 0, step = rows * plot->report->count / ROWS + 1;
    for (size_t row = 0; row < rows; row++) {
      double value = zp_table_get(table, row, column(plot));
      if (!isfinite(value) || (row % step && row + 1 < rows)) continue;
      zp_plot_put(file, zp_table_get(table, row, "time_s"), ' ');
      zp_plot_put(file, value, ' ');
      fprintf(file, "%u\n", colour_of(plot, run));
    }
    fprintf(file, "NaN NaN %u\n", colour_of(plot, run));
  }
}

/* Largest of a column over all runs, in its unit. */
static ZpPlotUnit common_unit(const ZpPlot *plot, const char *name, const char *unit) {
  ZpPlotUnit common = zp_plot_unit(0, unit);
  bool first = true;
  for (size_t run = 0; run < plot->report->count; run++) {
    if (!zp_plot_has(series(plot, run), name)) continue;
    ZpPlotUnit own = zp_plot_table_unit(series(plot, run), (const char *const[]){name, NULL}, unit);
    if (first || own.factor < common.factor) common = own;
    first = false;
  }
  return common;
}

/* "8 kV, 21": the values of the list keys of a run, but of the last `without` of them. */
static void run_name(const ZpPlot *plot, size_t run, size_t without, char *text, size_t size) {
  size_t keys, used = 0;
  const int *key = zp_scenario_axes(plot->report->scenario, &keys);
  ZpActuatorDef def;
  text[0] = 0;
  if (zp_scenario_def(plot->report->scenario, run, &def, NULL) != ZP_OK) return;
  for (size_t i = 0; i + without < keys && used < size; i++) {
    char value[64];
    zp_value_print(key[i], zp_def_get(&def, key[i]), value, sizeof value);
    used += (size_t)snprintf(text + used, size - used, "%s%s", i ? ", " : "", value);
  }
}

/* The names of the list keys but the last `without` over the legend, each on a line so that it fits. */
static void legend_title(const ZpPlot *plot, FILE *file, size_t without) {
  size_t keys;
  const int *key = zp_scenario_axes(plot->report->scenario, &keys);
  keys -= without;
  fputs("set key title \"", file);
  for (size_t i = 0; i < keys; i++) {
    fputs(i ? ",\\n" : "", file);
    for (const char *c = zp_key(key[i])->name; *c; c++)
      fprintf(file, "%s%c", *c == '_' ? "\\\\" : "", *c);
  }
  fputs("\" left font ',12'\n", file);
}

/* A legend entry for a curve that is drawn with many others. */
static void legend_entry(const ZpPlot *plot, FILE *file, size_t run) {
  char name[256];
  run_name(plot, run, 0, name, sizeof name);
  fprintf(file, ", \\\n     NaN with lines lw 2 lc rgb '#%06x' title ", colour_of(plot, run));
  zp_plot_text(file, name);
}

static void script_contraction(const ZpPlot *plot, FILE *file) {
  const size_t count = plot->report->count, named = count < LEGEND ? count : LEGEND;
  ZpPlotUnit time = common_unit(plot, "time_s", "s");
  ZpPlotUnit shown = common_unit(plot, "stroke_m", "m");
  if (!is_ribbon(plot)) shown = (ZpPlotUnit){.factor = 100, .text = "%"};
  zp_plot_head(plot, file, "contraction", is_ribbon(plot) ? "Stroke over time" : "Contraction over time", RIGHT);
  zp_plot_foot(plot, file, NULL);
  legend_title(plot, file, 0);
  fprintf(file,
          "set xrange [0:*]\nset xlabel 'time / %s'\nset ylabel '%s / %s' offset 0.5\n"
          "plot 'contraction.dat' using ($1*%g):($2*%g):3 with lines lw 2 lc rgb variable notitle",
          time.text, is_ribbon(plot) ? "stroke" : "contraction", shown.text, time.factor, shown.factor);
  for (size_t i = 0; i < named; i++)
    legend_entry(plot, file, named > 1 ? i * (count - 1) / (named - 1) : 0);
  fputc('\n', file);
}

int zp_sweep_key(const ZpPlot *plot, size_t back) {
  size_t keys;
  const int *key = zp_scenario_axes(plot->report->scenario, &keys);
  return back < keys ? key[keys - 1 - back] : -1;
}

/* The list key against which numbers are drawn. */
static int x_key(const ZpPlot *plot) {
  return zp_sweep_key(plot, 0);
}

/* Does another curve begin at this run: has any other list key changed? */
static bool begins_curve(const ZpPlot *plot, size_t run) {
  size_t keys;
  const int *key = zp_scenario_axes(plot->report->scenario, &keys);
  ZpActuatorDef before, now;
  if (run == 0 || zp_scenario_def(plot->report->scenario, run - 1, &before, NULL) != ZP_OK) return false;
  if (zp_scenario_def(plot->report->scenario, run, &now, NULL) != ZP_OK) return false;
  for (size_t i = 0; i + 1 < keys; i++)
    if (zp_def_get(&before, key[i]) != zp_def_get(&now, key[i])) return true;
  return false;
}

double zp_sweep_value(const ZpPlot *plot, size_t run, int key) {
  ZpActuatorDef def;
  if (zp_scenario_def(plot->report->scenario, run, &def, NULL) != ZP_OK) return NAN;
  return zp_def_get(&def, key);
}

static double key_value(const ZpPlot *plot, size_t run) {
  return zp_sweep_value(plot, run, x_key(plot));
}

static const ZpAnswer answers[] = {
#define ZP_SWEEP(enumerator, picture, title, axis, unit, scalar, legend, scalar2, legend2, count)                      \
  {enumerator, #picture, title, axis, unit, {scalar, scalar2}, {legend, legend2}, count},
#include <zipact/studies.def>
};

const ZpAnswer *zp_sweep_answer(const ZpPlot *plot) {
  for (size_t i = 0; i < sizeof answers / sizeof answers[0]; i++)
    if (answers[i].study == plot->study) return &answers[i];
  return NULL;
}

static double answer(const ZpPlot *plot, size_t run, size_t curve) {
  const char *name = zp_sweep_answer(plot)->scalar[curve];
  return name ? zp_result_get(zp_report_result(plot->report, run), name) : (double)NAN;
}

/* How many runs have the scalar and a number of the list key; none where `name` is NULL. */
static size_t points_of(const ZpPlot *plot, const char *name) {
  size_t count = 0;
  for (size_t run = 0; name && run < plot->report->count; run++)
    count += isfinite(zp_result_get(zp_report_result(plot->report, run), name)) && isfinite(key_value(plot, run));
  return count;
}

/* How many runs have a point on the curve. */
static size_t points(const ZpPlot *plot, size_t curve) {
  return points_of(plot, zp_sweep_answer(plot)->scalar[curve]);
}

/* Are there runs to draw against a key? */
static bool has_axis(const ZpPlot *plot) {
  return !plot->single && plot->report->count > 0 && x_key(plot) >= 0 && !zp_scenario_design(plot->report->scenario) &&
         !plot->report->optimum;
}

static bool has_answer(const ZpPlot *plot, ZpStudy study) {
  if (plot->study != study || !has_axis(plot)) return false;
  return points(plot, 0) >= 2 || points(plot, 1) >= 2;
}

/* has_zip_time, has_strokes, ...: is there something to draw for the picture of a study? */
#define ZP_SWEEP(enumerator, picture, title, axis, unit, scalar, legend, scalar2, legend2, count)                      \
  static bool has_##picture(const ZpPlot *plot) {                                                                      \
    return has_answer(plot, enumerator);                                                                               \
  }
#include <zipact/studies.def>

/* Runs that begin a curve, at most LEGEND evenly chosen. => how many */
static size_t choose_curves(const ZpPlot *plot, size_t chosen[LEGEND]) {
  size_t curves = 0, kept = 0, at = 0;
  for (size_t run = 0; run < plot->report->count; run++)
    curves += run == 0 || begins_curve(plot, run);
  for (size_t run = 0; run < plot->report->count && kept < LEGEND; run++) {
    if (run > 0 && !begins_curve(plot, run)) continue;
    if (curves <= LEGEND || at * (LEGEND - 1) >= kept * (curves - 1)) chosen[kept++] = run;
    at++;
  }
  return kept;
}

/* Runs of the curve that begins at `run`: up to this one. */
static size_t end_of_curve(const ZpPlot *plot, size_t run) {
  do
    run++;
  while (run < plot->report->count && !begins_curve(plot, run));
  return run;
}

/* An index per curve. */
static void data_answer(const ZpPlot *plot, FILE *file) {
  const ZpAnswer *a = zp_sweep_answer(plot);
  size_t chosen[LEGEND] = {0}, curves = choose_curves(plot, chosen);
  fprintf(file, "# %s %s%s%s; an index per curve\n", zp_key(x_key(plot))->name, a->scalar[0], a->scalar[1] ? " " : "",
          a->scalar[1] ? a->scalar[1] : "");
  for (size_t k = 0; k < curves; k++) {
    for (size_t run = chosen[k]; run < end_of_curve(plot, chosen[k]); run++) {
      zp_plot_put(file, key_value(plot, run), ' ');
      zp_plot_put(file, answer(plot, run, 0), a->scalar[1] ? ' ' : '\n');
      if (a->scalar[1]) zp_plot_put(file, answer(plot, run, 1), '\n');
    }
    fputs("\n\n", file);
  }
}

double zp_sweep_factor(int index) {
  const ZpKey *key = zp_key(index);
  ZpUnitScale scale;
  if (!*key->shown || zp_unit_scale(key->shown, key->unit, &scale, NULL) != ZP_OK) return 1;
  return scale.decimal ? pow(10, -scale.exponent) : 1 / scale.factor;
}

void zp_sweep_label(FILE *file, int index) {
  const ZpKey *key = zp_key(index);
  char label[128];
  snprintf(label, sizeof label, *key->shown ? "%s / %s" : "%s", key->name, key->shown);
  zp_plot_text(file, label);
}

/* One number along a curve. Of several curves colours tell the curve, marks and dashes the number. */
static void plot_curve(const ZpPlot *plot, FILE *file, ZpPlotUnit unit, size_t k, size_t number, unsigned colour) {
  fprintf(file,
          "'%s.dat' index %zu using ($1*%g):($%zu*%g) with linespoints lw 2 dt %zu pt %d ps 0.8 lc rgb '#%06x' title ",
          zp_sweep_answer(plot)->picture, k, zp_sweep_factor(x_key(plot)), number + 2, unit.factor, number + 1,
          number ? 5 : 7, colour);
}

/* A single curve for each number, which the legend names. */
static void plot_alone(const ZpPlot *plot, FILE *file, ZpPlotUnit unit) {
  const ZpAnswer *a = zp_sweep_answer(plot);
  bool first = true;
  for (size_t i = 0; i < 2; i++) {
    unsigned colour = 0;
    if (points(plot, i) == 0) continue;
    sscanf(zp_plot_colour(i), "#%x", &colour);
    fputs(first ? "plot " : ", \\\n     ", file);
    plot_curve(plot, file, unit, 0, i, colour);
    zp_plot_text(file, a->legend[i] ? a->legend[i] : "");
    first = false;
  }
  fputc('\n', file);
}

/* Curves for each value of the other keys: the legend names them, then the numbers. */
static void plot_many(const ZpPlot *plot, FILE *file, ZpPlotUnit unit) {
  const ZpAnswer *a = zp_sweep_answer(plot);
  size_t chosen[LEGEND] = {0}, curves = choose_curves(plot, chosen);
  const size_t named = points(plot, 0) ? 0 : 1;
  for (size_t k = 0; k < curves; k++)
    for (size_t i = named; i < 2; i++) {
      char name[256];
      if (points(plot, i) == 0) continue;
      run_name(plot, chosen[k], 1, name, sizeof name);
      fputs(k || i > named ? ", \\\n     " : "plot ", file);
      plot_curve(plot, file, unit, k, i, zp_plot_shade(curves > 1 ? (double)k / (double)(curves - 1) : 0.3));
      zp_plot_text(file, i == named ? name : "");
    }
  for (size_t i = named; i < 2; i++) {
    if (!a->legend[i] || points(plot, i) == 0) continue;
    fprintf(file, ", \\\n     NaN with linespoints lw 2 dt %zu pt %d ps 0.8 lc rgb '#555555' title ", i + 1, i ? 5 : 7);
    zp_plot_text(file, a->legend[i]);
  }
  fputc('\n', file);
}

static void script_answer(const ZpPlot *plot, FILE *file) {
  const ZpAnswer *a = zp_sweep_answer(plot);
  char more[64];
  double largest = 0;
  bool many = zp_sweep_key(plot, 1) >= 0;
  for (size_t i = 0; i < 2 * plot->report->count; i++)
    largest = fmax(largest, fabs(answer(plot, i / 2, i % 2)));
  ZpPlotUnit unit = a->unit ? zp_plot_unit(largest, a->unit) : (ZpPlotUnit){.factor = 1};
  snprintf(more, sizeof more, "%zu of %zu runs %s", points(plot, 0), plot->report->count, a->count);
  zp_plot_head(plot, file, a->picture, a->title, many ? RIGHT : a->scalar[1] ? 0.82 : 0.96);
  if (plot->shows == ZP_SHOWS_motion)
    zp_plot_foot(plot, file, more);
  else
    zp_plot_remark(file, more);
  if (many) legend_title(plot, file, 1);
  fputs("set xlabel ", file);
  zp_sweep_label(file, x_key(plot));
  fprintf(file,
          "\nset ylabel '%s%s%s' offset 0.5\nset autoscale x noextend\nset yrange [0:*]\n"
          "set offsets graph 0.03, graph 0.03, graph 0.05, 0\n",
          a->axis, a->unit ? " / " : "", unit.text);
  (many ? plot_many : plot_alone)(plot, file, unit);
}

/* -- what is held --------------------------------------------------------------------------------- */

/* A number of the summary, a curve for each value of the other list keys. */
typedef struct Held {
  const char *picture, *scalar, *unit, *axis;
  bool by_angle; /* against the angle of a fold, not the list key that varies fastest */
} Held;

static const Held forces = {"forces", "force_N", "N", "force", false};
static const Held torques = {"torques", "torque_N_m", "N m", "torque", true};

static bool has_forces(const ZpPlot *plot) {
  if (plot->shows == ZP_SHOWS_held_branch) return has_axis(plot) && points_of(plot, "force_N") >= 2;
  return plot->shows == ZP_SHOWS_field && has_answer(plot, plot->study);
}

static bool has_torques(const ZpPlot *plot) {
  return plot->shows == ZP_SHOWS_held_branch && has_axis(plot) && points_of(plot, torques.scalar) >= 2;
}

static double number_of(const ZpPlot *plot, size_t run, const char *name) {
  return zp_result_get(zp_report_result(plot->report, run), name);
}

/* An index per curve. */
static void data_held(const ZpPlot *plot, FILE *file, const Held *held) {
  size_t chosen[LEGEND] = {0}, curves = choose_curves(plot, chosen);
  fprintf(file, "# %s %s; an index per curve\n", held->by_angle ? "angle_rad" : zp_key(x_key(plot))->name,
          held->scalar);
  for (size_t k = 0; k < curves; k++) {
    for (size_t run = chosen[k]; run < end_of_curve(plot, chosen[k]); run++) {
      zp_plot_put(file, held->by_angle ? number_of(plot, run, "angle_rad") : key_value(plot, run), ' ');
      zp_plot_put(file, number_of(plot, run, held->scalar), '\n');
    }
    fputs("\n\n", file);
  }
}

static void data_forces(const ZpPlot *plot, FILE *file) {
  data_held(plot, file, &forces);
}

static void data_torques(const ZpPlot *plot, FILE *file) {
  data_held(plot, file, &torques);
}

/* Of many curves the first list key has a line style, the others together a colour. */
static size_t curves_of_a_style(const ZpPlot *plot, const size_t *chosen, size_t curves) {
  size_t keys, alike = 1;
  const int *key = zp_scenario_axes(plot->report->scenario, &keys);
  ZpActuatorDef first, other;
  if (keys < 3 || zp_scenario_def(plot->report->scenario, chosen[0], &first, NULL) != ZP_OK) return curves;
  while (alike < curves && zp_scenario_def(plot->report->scenario, chosen[alike], &other, NULL) == ZP_OK &&
         zp_def_get(&other, key[0]) == zp_def_get(&first, key[0]))
    alike++;
  return alike;
}

static void plot_held(const ZpPlot *plot, FILE *file, const Held *held, ZpPlotUnit unit) {
  static const double degrees = 57.295779513082323; /* in a radian */
  size_t chosen[LEGEND] = {0}, curves = choose_curves(plot, chosen), alike = curves_of_a_style(plot, chosen, curves);
  for (size_t k = 0; k < curves; k++) {
    char name[256];
    double shade = alike > 1 ? (double)(k % alike) / (double)(alike - 1) : 0.3;
    run_name(plot, chosen[k], 1, name, sizeof name);
    fprintf(file,
            "%s'%s.dat' index %zu using ($1*%g):($2*%g) with linespoints lw 2 dt %zu pt %d ps 0.6 lc rgb '#%06x' "
            "title ",
            k ? ", \\\n     " : "plot ", held->picture, k, held->by_angle ? degrees : zp_sweep_factor(x_key(plot)),
            unit.factor, k / alike % 5 + 1, k / alike % 2 ? 6 : 7, zp_plot_shade(shade));
    zp_plot_text(file, name);
  }
  fputc('\n', file);
}

static void script_held(const ZpPlot *plot, FILE *file, const Held *held, const char *title) {
  size_t keys;
  double largest = 0;
  zp_scenario_axes(plot->report->scenario, &keys);
  for (size_t i = 0; i < plot->report->count; i++) {
    double number = number_of(plot, i, held->scalar);
    if (isfinite(number)) largest = fmax(largest, fabs(number));
  }
  ZpPlotUnit unit = zp_plot_unit(largest, held->unit);
  zp_plot_head(plot, file, held->picture, title, keys > 1 ? RIGHT : 0.96);
  if (keys > 1) legend_title(plot, file, 1);
  fputs("set xlabel ", file);
  if (held->by_angle)
    fputs("'angle / degree'", file);
  else
    zp_sweep_label(file, x_key(plot));
  fprintf(file,
          "\nset ylabel '%s / %s' offset 0.5\nset xrange [0:*]\nset yrange [*<0:*]\n"
          "set offsets 0, graph 0.03, graph 0.05, 0\n",
          held->axis, unit.text);
  plot_held(plot, file, held, unit);
}

static void script_forces(const ZpPlot *plot, FILE *file) {
  bool field = plot->shows == ZP_SHOWS_field;
  const char *held = plot->def.actuator.kind == ZP_KIND_HINGE ? "Force on the held end" : "Force on the held platform";
  script_held(plot, file, &forces, field ? "Electric force on a ribbon of one half" : held);
}

static void script_torques(const ZpPlot *plot, FILE *file) {
  script_held(plot, file, &torques, "Torque of the held fold");
}

/* -- bode ------------------------------------------------------------------------------------------ */

/* Amplitude and phase against the frequency of a drive. */
static bool has_bode(const ZpPlot *plot) {
  return has_axis(plot) && strcmp(zp_key(x_key(plot))->name, "drive.frequency") == 0 &&
         points_of(plot, "phase_rad") >= 2;
}

/* An index per curve: frequency, amplitude, phase. */
static void data_bode(const ZpPlot *plot, FILE *file) {
  size_t chosen[LEGEND] = {0}, curves = choose_curves(plot, chosen);
  fputs("# drive.frequency stroke_amplitude_m phase_rad; an index per curve\n", file);
  for (size_t k = 0; k < curves; k++) {
    for (size_t run = chosen[k]; run < end_of_curve(plot, chosen[k]); run++) {
      zp_plot_put(file, key_value(plot, run), ' ');
      zp_plot_put(file, zp_result_get(zp_report_result(plot->report, run), "stroke_amplitude_m"), ' ');
      zp_plot_put(file, zp_result_get(zp_report_result(plot->report, run), "phase_rad"), '\n');
    }
    fputs("\n\n", file);
  }
}

/* One panel: a column of all curves. */
static void plot_bode(const ZpPlot *plot, FILE *file, const char *column, bool names) {
  size_t chosen[LEGEND] = {0}, curves = choose_curves(plot, chosen);
  for (size_t k = 0; k < curves; k++) {
    char name[256];
    run_name(plot, chosen[k], 1, name, sizeof name);
    fprintf(file, "%s'bode.dat' index %zu using 1:(%s) with linespoints lw 2 pt 7 ps 0.8 lc rgb '%s' title ",
            k ? ", \\\n     " : "plot ", k, column, zp_plot_colour(k));
    zp_plot_text(file, names ? name : "");
  }
  fputc('\n', file);
}

static void script_bode(const ZpPlot *plot, FILE *file) {
  char amplitude[64];
  double largest = 0;
  for (size_t run = 0; run < plot->report->count; run++)
    largest = fmax(largest, zp_result_get(zp_report_result(plot->report, run), "stroke_amplitude_m"));
  ZpPlotUnit length = zp_plot_unit(largest, "m");
  snprintf(amplitude, sizeof amplitude, "$2*%g", length.factor);
  zp_plot_head(plot, file, "bode", "Amplitude and phase of the stroke", RIGHT);
  zp_plot_foot(plot, file, NULL);
  fputs("set logscale x\nset autoscale x noextend\n", file);
  zp_plot_upper_panel(file);
  fprintf(file, "set logscale y\nset ylabel 'amplitude / %s' offset 0.5\n", length.text);
  plot_bode(plot, file, amplitude, true);
  zp_plot_lower_panel(file, RIGHT, "frequency / Hz");
  fputs("unset logscale y\nset ytics 45\nset ylabel 'phase / deg' offset 0.5\n", file);
  plot_bode(plot, file, "$3*180/pi", false);
  fputs("unset multiplot\n", file);
}

const ZpPicture zp_sweep_pictures[] = {
    {"bode", "svg", has_bode, script_bode, data_bode},
    {"contraction", "svg", has_contraction, script_contraction, data_contraction},
    {"forces", "svg", has_forces, script_forces, data_forces},
    {"torques", "svg", has_torques, script_torques, data_torques},
#define ZP_SWEEP(enumerator, picture, title, axis, unit, scalar, legend, scalar2, legend2, count)                      \
  {#picture, "svg", has_##picture, script_answer, data_answer},
#include <zipact/studies.def>
    {0},
};
