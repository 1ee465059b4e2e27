/* Pictures of several runs together, drawn like those of any report: NAME.gp and NAME.dat stay beside NAME.svg. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/table.h"
#include "def/def.h"
#include "io/drawing.h"
#include "io/file.h"
#include "reproduce/parts.h"
#include "study/result.h"

static bool has_run(const ZpRuns *runs, ZpRunId id) {
  return runs->run[id].batch.done > 0;
}

/* An index of the .dat file: one row per row of a table, columns in SI; two empty lines end it. */
static void put_table(FILE *file, const ZpTable *table, const char *x, const char *y) {
  for (size_t row = 0; table && row < table->rows; row++)
    fprintf(file, "%.17g %.17g\n", zp_table_get(table, row, x), zp_table_get(table, row, y));
  fputs("\n\n", file);
}

/* -- fig. 6: shapes at rest ------------------------------------------------------------------------- */

static const double loads[] = {40, 60, 80, 100, 150, 200}; /* g, as in Table II */
enum { LOADS = sizeof loads / sizeof loads[0] };

/* From the clip on, so that both models start at the same point. */
static void put_shape(FILE *file, const ZpResult *result) {
  const ZpTable *table = result ? result->series : NULL;
  for (size_t row = 0; table && row < table->rows; row++)
    fprintf(file, "%.17g %.17g\n", zp_table_get(table, row, "x_m") - zp_table_get(table, 0, "x_m"),
            zp_table_get(table, row, "y_m") - zp_table_get(table, 0, "y_m"));
  fputs("\n\n", file);
}

static void put_shapes(const void *of, FILE *file) {
  const ZpRuns *runs = of;
  fputs("# x_m y_m from the clip; for each load an index of the finite elements, then one of the chain\n", file);
  for (int i = 0; i < LOADS; i++) {
    const ZpWhich which = {.load = loads[i]};
    put_shape(file, zp_runs_find(runs, ZP_RUN_FINITE_ELEMENTS, which));
    put_shape(file, zp_runs_find(runs, ZP_RUN_TABLE_2_61, which));
  }
}

/* -- fig. 7: force along a ribbon -------------------------------------------------------------------- */

static void put_profile(const void *of, FILE *file) {
  const ZpRuns *runs = of;
  const ZpTable *ours = runs->run[ZP_RUN_FIG_7].batch.result[0]->series;
  fputs("# x_m N_per_m: the field; the plates law; the plates law as the paper's program has it\n", file);
  put_table(file, ours, "x_m", "field_N_per_m");
  put_table(file, ours, "x_m", "plates_N_per_m");
  put_table(file, runs->run[ZP_RUN_FIG_7_PAPER].batch.result[0]->series, "x_m", "plates_N_per_m");
}

/* -- fig. 8: force against separation ---------------------------------------------------------------- */

/* The runs `from` .. `to` of a sweep of the separation, as one index. */
static void put_sweep(FILE *file, const ZpRuns *runs, ZpRunId id, size_t from, size_t to) {
  const ZpBatch *batch = &runs->run[id].batch;
  for (size_t i = from; i < to && i < batch->done; i++)
    fprintf(file, "%.17g %.17g\n", zp_runs_def(runs, id, i).isometric.separation,
            zp_result_get(batch->result[i], "force_N"));
  fputs("\n\n", file);
}

static void put_forces(const void *of, FILE *file) {
  const ZpRuns *runs = of;
  const size_t all = runs->run[ZP_RUN_FIG_8].batch.count;
  fputs("# separation_m force_N: with breakdown of the liquid; without; as the paper's text has it\n", file);
  put_sweep(file, runs, ZP_RUN_FIG_8, 0, all / 2);
  put_sweep(file, runs, ZP_RUN_FIG_8, all / 2, all);
  put_sweep(file, runs, ZP_RUN_FIG_8_PAPER, 0, all / 2);
}

/* -- all -------------------------------------------------------------------------------------------- */

static void put_definitions(const void *of, FILE *file) {
  const ZpRuns *runs = of;
  const ZpResult *factor = has_run(runs, ZP_RUN_FIG_7) ? runs->run[ZP_RUN_FIG_7].batch.result[0] : NULL;
  fprintf(file, "array load[%d]\n", LOADS);
  for (int i = 0; i < LOADS; i++)
    fprintf(file, "load[%d] = %.1f\n", i + 1, loads[i]);
  if (factor) fprintf(file, "factor = %.9g\n", zp_result_get(factor, "paper_factor"));
}

static const struct {
  ZpPicture picture;
  const char *data;
  ZpRunId ours, theirs; /* both are needed */
  void (*put)(const void *runs, FILE *file);
} figure[] = {
    {{"fig-6", "svg", "fig-6.gp"}, "fig-6.dat", ZP_RUN_FINITE_ELEMENTS, ZP_RUN_TABLE_2_61, put_shapes},
    {{"fig-7", "svg", "fig-7.gp"}, "fig-7.dat", ZP_RUN_FIG_7, ZP_RUN_FIG_7_PAPER, put_profile},
    {{"fig-8", "svg", "fig-8.gp"}, "fig-8.dat", ZP_RUN_FIG_8, ZP_RUN_FIG_8_PAPER, put_forces},
};
enum { FIGURES = sizeof figure / sizeof figure[0] };

static ZpStatus prepare(const ZpDrawing *drawing, const ZpRuns *runs, ZpPicture drawn[FIGURES], size_t *count,
                        ZpError *err) {
  ZpStatus status = zp_make_folder(drawing->folder, err);
  if (status == ZP_OK) status = zp_drawing_file(drawing, "result.gp", put_definitions, runs, err);
  for (size_t i = 0; i < FIGURES && status == ZP_OK; i++) {
    status = zp_drawing_remove(drawing, &figure[i].picture, err);
    if (status != ZP_OK || !has_run(runs, figure[i].ours) || !has_run(runs, figure[i].theirs)) continue;
    status = zp_drawing_script(drawing, &figure[i].picture, err);
    if (status == ZP_OK) status = zp_drawing_file(drawing, figure[i].data, figure[i].put, runs, err);
    drawn[(*count)++] = figure[i].picture;
  }
  return status;
}

ZpStatus zp_figures_draw(const char *directory, const ZpRuns *runs, const ZpHooks *hooks,
                         void (*notice)(const char *message), ZpError *err) {
  ZpPicture drawn[FIGURES];
  size_t count = 0;
  char *folder = zp_path_join(directory, "plots");
  if (!folder) return zp_fail_memory(err);
  ZpDrawing drawing = {.folder = folder, .notice = notice, .patience = ZP_DRAWING_PATIENCE, .hooks = hooks};
  ZpStatus status = prepare(&drawing, runs, drawn, &count, err);
  if (status == ZP_OK) zp_drawing_draw(&drawing, drawn, count);
  free(folder);
  return status;
}
