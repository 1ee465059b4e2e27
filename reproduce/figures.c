/* Pictures of several runs together, drawn like those of any report: NAME.gp and NAME.dat stay beside NAME.svg. */
#include <math.h>
#include <stdlib.h>

#include "base/fail.h"
#include "io/atomic.h"
#include "io/plot.h"
#include "reproduce/parts.h"

static bool has_run(const ZpPlot *plot, ZpRunId id) {
  return plot->runs->run[id].batch.done > 0;
}

/* An index of the .dat file: one row per row of a table, columns in SI; two empty lines end it. */
static void put_table(FILE *file, const ZpTable *table, const char *x, const char *y) {
  for (size_t row = 0; table && row < table->rows; row++) {
    zp_plot_put(file, zp_table_get(table, row, x), ' ');
    zp_plot_put(file, zp_table_get(table, row, y), '\n');
  }
  fputs("\n\n", file);
}

/* -- fig. 6: shapes at rest ------------------------------------------------------------------------- */

static const double loads[] = {40, 60, 80, 100, 150, 200}; /* g, as in Table II */
enum { LOADS = sizeof loads / sizeof loads[0] };

static bool has_shapes(const ZpPlot *plot) {
  return has_run(plot, ZP_RUN_FINITE_ELEMENTS) && has_run(plot, ZP_RUN_TABLE_2_61);
}

/* From the clip on, so that both models start at the same point. */
static void put_shape(FILE *file, const ZpResult *result) {
  const ZpTable *table = result ? result->series : NULL;
  for (size_t row = 0; table && row < table->rows; row++) {
    zp_plot_put(file, zp_table_get(table, row, "x_m") - zp_table_get(table, 0, "x_m"), ' ');
    zp_plot_put(file, zp_table_get(table, row, "y_m") - zp_table_get(table, 0, "y_m"), '\n');
  }
  fputs("\n\n", file);
}

static void data_shapes(const ZpPlot *plot, FILE *file) {
  fputs("# x_m y_m from the clip; for each load an index of the finite elements, then one of the chain\n", file);
  for (int i = 0; i < LOADS; i++) {
    const ZpWhich which = {.load = loads[i]};
    put_shape(file, zp_runs_find(plot->runs, ZP_RUN_FINITE_ELEMENTS, which));
    put_shape(file, zp_runs_find(plot->runs, ZP_RUN_TABLE_2_61, which));
  }
}

static void define_shapes(const ZpPlot *plot, FILE *file) {
  (void)plot;
  zp_plot_define_array(file, "load", LOADS);
  for (size_t i = 0; i < LOADS; i++)
    zp_plot_define(file, zp_plot_entry("load", i + 1).text, loads[i]);
}

/* -- fig. 7: force along a ribbon -------------------------------------------------------------------- */

static bool has_profile(const ZpPlot *plot) {
  return has_run(plot, ZP_RUN_FIG_7) && has_run(plot, ZP_RUN_FIG_7_PAPER);
}

static void data_profile(const ZpPlot *plot, FILE *file) {
  const ZpTable *ours = plot->runs->run[ZP_RUN_FIG_7].batch.result[0]->series;
  fputs("# x_m N_per_m: the field; the plates law; the plates law as the paper's program has it\n", file);
  put_table(file, ours, "x_m", "field_N_per_m");
  put_table(file, ours, "x_m", "plates_N_per_m");
  put_table(file, plot->runs->run[ZP_RUN_FIG_7_PAPER].batch.result[0]->series, "x_m", "plates_N_per_m");
}

static void define_profile(const ZpPlot *plot, FILE *file) {
  zp_plot_define(file, "factor", zp_result_get(plot->runs->run[ZP_RUN_FIG_7].batch.result[0], "paper_factor"));
}

/* -- fig. 8: force against separation ---------------------------------------------------------------- */

static bool has_forces(const ZpPlot *plot) {
  return has_run(plot, ZP_RUN_FIG_8) && has_run(plot, ZP_RUN_FIG_8_PAPER);
}

/* The runs `from` .. `to` of a sweep of the separation, as one index. */
static void put_forces(FILE *file, const ZpRuns *runs, ZpRunId id, size_t from, size_t to) {
  const ZpBatch *batch = &runs->run[id].batch;
  for (size_t i = from; i < to && i < batch->done; i++) {
    zp_plot_put(file, zp_runs_def(runs, id, i).isometric.separation, ' ');
    zp_plot_put(file, zp_result_get(batch->result[i], "force_N"), '\n');
  }
  fputs("\n\n", file);
}

static void data_forces(const ZpPlot *plot, FILE *file) {
  const size_t all = plot->runs->run[ZP_RUN_FIG_8].batch.count;
  fputs("# separation_m force_N: with breakdown of the liquid; without; as the paper's text has it\n", file);
  put_forces(file, plot->runs, ZP_RUN_FIG_8, 0, all / 2);
  put_forces(file, plot->runs, ZP_RUN_FIG_8, all / 2, all);
  put_forces(file, plot->runs, ZP_RUN_FIG_8_PAPER, 0, all / 2);
}

static const ZpPicture pictures[] = {
    {"fig-6", "svg", "fig-6.gp", .has = has_shapes, .define = define_shapes, .data = data_shapes},
    {"fig-7", "svg", "fig-7.gp", .has = has_profile, .define = define_profile, .data = data_profile},
    {"fig-8", "svg", "fig-8.gp", .has = has_forces, .data = data_forces},
    {0},
};

ZpStatus zp_figures_draw(const char *directory, const ZpRuns *runs, const ZpHooks *hooks,
                         void (*notice)(const char *message), ZpError *err) {
  const ZpPicture *const table[] = {pictures};
  char *folder = zp_path_join(directory, "plots");
  if (!folder) return zp_fail_memory(err);
  const ZpPlot plot = {.runs = runs};
  ZpDrawing drawing = {&plot, folder, notice, ZP_PLOT_PATIENCE, hooks, 0, false};
  ZpStatus status = zp_drawing_prepare(&drawing, table, 1, err);
  if (status == ZP_OK) zp_drawing_draw(&drawing, table, 1);
  free(folder);
  return status;
}
