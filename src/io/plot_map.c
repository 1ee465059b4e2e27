/* map.svg: what a study answers over two list keys, as colours with contours; maps.svg: over three, a map for each
 * value of the third. */
#include <math.h>
#include <string.h>

#include "io/report.h"
#include "io/sampled.h"
#include "io/sweep.h"

/* Values of each key: fewer are better drawn as curves. */
static const size_t fewest = 3;

/* Maps in one picture: of more values of the third key they are chosen evenly. */
enum { PANELS_MOST = 9 };

/* The runs as a grid: x is the key that varies fastest. */
typedef struct Grid {
  int x, y, z; /* keys; z is -1 where there are two */
  size_t columns, rows, panels;
  const char *scalar, *title, *axis, *which, *unit, *count;
} Grid;

static void choose_scalar(const ZpPlot *plot, Grid *grid) {
  const ZpAnswer *a = zp_sweep_answer(plot);
  grid->scalar = a ? a->scalar[0] : "force_N"; /* of the held platform, whose curves are another picture */
  bool fold = plot->def.actuator.kind == ZP_KIND_HINGE;
  grid->title = a ? a->title : fold ? "Force on the held end" : "Force on the held platform";
  grid->axis = a ? a->axis : "force";
  grid->which = a ? a->legend[0] : NULL;
  grid->unit = a ? a->unit : "N";
  grid->count = a ? a->count : "are drawn";
}

static double value_of(const ZpPlot *plot, const Grid *grid, size_t run) {
  return zp_result_get(zp_report_result(plot->report, run), grid->scalar);
}

/* Are the keys numbers that grow or fall along their lists? A surface needs no less. */
static bool is_monotonic(const ZpPlot *plot, int key, size_t count, size_t stride) {
  double first = zp_sweep_value(plot, 0, key), sign = zp_sweep_value(plot, stride, key) - first;
  for (size_t i = 0; i + 1 < count; i++) {
    double step = zp_sweep_value(plot, (i + 1) * stride, key) - zp_sweep_value(plot, i * stride, key);
    if (!(step * sign > 0)) return false;
  }
  return true;
}

/* Runs from the first on in which a key has one value. */
static size_t same_value(const ZpPlot *plot, int key, size_t count) {
  size_t length = 1;
  while (length < count && zp_sweep_value(plot, length, key) == zp_sweep_value(plot, 0, key))
    length++;
  return length;
}

/* False if the runs are no such grid. */
static bool find_grid(const ZpPlot *plot, Grid *grid) {
  size_t count = plot->report->count, found = 0;
  bool drawn = zp_sweep_answer(plot) || plot->shows == ZP_SHOWS_held_branch;
  if (plot->single || zp_scenario_design(plot->report->scenario) || plot->report->optimum || !drawn ||
      zp_sweep_key(plot, 1) < 0 || zp_sweep_key(plot, 3) >= 0)
    return false;
  *grid = (Grid){.x = zp_sweep_key(plot, 0), .y = zp_sweep_key(plot, 1), .z = zp_sweep_key(plot, 2)};
  const size_t panel = grid->z < 0 ? count : same_value(plot, grid->z, count);
  grid->columns = same_value(plot, grid->y, panel);
  grid->rows = panel / grid->columns;
  grid->panels = count / panel;
  if (grid->columns < fewest || grid->rows < fewest || grid->rows * grid->columns * grid->panels != count) return false;
  choose_scalar(plot, grid);
  for (size_t run = 0; run < count; run++)
    if (isfinite(value_of(plot, grid, run))) found++;
  return found >= fewest * fewest && is_monotonic(plot, grid->x, grid->columns, 1) &&
         is_monotonic(plot, grid->y, grid->rows, grid->columns);
}

static bool has_map(const ZpPlot *plot) {
  Grid grid;
  return find_grid(plot, &grid) && grid.z < 0;
}

/* The panel that is drawn as number `k` of all that are. */
static size_t chosen_panel(const Grid *grid, size_t k) {
  return grid->panels <= PANELS_MOST ? k : k * (grid->panels - 1) / (PANELS_MOST - 1);
}

static size_t drawn_panels(const Grid *grid) {
  return grid->panels < PANELS_MOST ? grid->panels : PANELS_MOST;
}

/* An index for each panel, a block in it for each row of the grid. A NaN marks a run without an answer and leaves a
 * hole. */
static void data_map(const ZpPlot *plot, FILE *file) {
  Grid grid;
  if (!find_grid(plot, &grid)) return;
  const size_t panel = grid.columns * grid.rows;
  fprintf(file, "# %s %s %s\n", zp_key(grid.x)->name, zp_key(grid.y)->name, grid.scalar);
  for (size_t k = 0; k < drawn_panels(&grid); k++) {
    for (size_t i = 0; i < panel; i++) {
      const size_t run = chosen_panel(&grid, k) * panel + i;
      zp_plot_put(file, zp_sweep_value(plot, run, grid.x), ' ');
      zp_plot_put(file, zp_sweep_value(plot, run, grid.y), ' ');
      zp_plot_put(file, value_of(plot, &grid, run), '\n');
      if ((i + 1) % grid.columns == 0) fputc('\n', file);
    }
    if (grid.z >= 0) fputc('\n', file);
  }
}

/* An axis: NAME_label and NAME_factor of its key; NAME_log says whether its values grow by factors, over more than a
 * decade; then NAME_tics are the values, of which there are not many. */
static void define_axis(const ZpPlot *plot, FILE *file, const char *name, int key, size_t count, size_t stride) {
  enum { MOST_TICS = 12 };
  double first = zp_sweep_value(plot, 0, key), last = zp_sweep_value(plot, (count - 1) * stride, key);
  double middle = zp_sweep_value(plot, (count - 1) / 2 * stride, key), low = fmin(first, last),
         high = fmax(first, last);
  const bool log = low > 0 && high >= 10 * low && middle <= 0.35 * high;
  char variable[32], label[128];
  snprintf(variable, sizeof variable, "%s_label", name);
  zp_sweep_label(key, label, sizeof label);
  zp_plot_define_text(file, variable, label);
  snprintf(variable, sizeof variable, "%s_factor", name);
  zp_plot_define(file, variable, zp_sweep_factor(key));
  snprintf(variable, sizeof variable, "%s_log", name);
  zp_plot_define_count(file, variable, log);
  fprintf(file, "%s_tics = '", name);
  for (size_t i = 0; log && count <= MOST_TICS && i < count; i++)
    fprintf(file, "%s%g", i ? ", " : "", zp_sweep_value(plot, i * stride, key) * zp_sweep_factor(key));
  fputs("'\n", file);
}

/* The answer, how often there is one, and its range over all runs. */
static void define_answer(const ZpPlot *plot, FILE *file, const Grid *grid) {
  size_t found = 0;
  double low = NAN, high = NAN;
  char text[128];
  for (size_t run = 0; run < plot->report->count; run++) {
    const double value = value_of(plot, grid, run);
    found += isfinite(value) != 0;
    low = fmin(low, value);
    high = fmax(high, value);
  }
  snprintf(text, sizeof text, "%zu of %zu runs %s; straight between them", found, plot->report->count, grid->count);
  zp_plot_define_text(file, "remark", text);
  zp_plot_define_text(file, "note", zp_plot_drag_note(plot));
  zp_plot_define_count(file, "motion", plot->shows == ZP_SHOWS_motion);
  zp_plot_define_text(file, "title", grid->title);
  snprintf(text, sizeof text, grid->which ? "%s (%s)" : "%s", grid->axis, grid->which);
  zp_plot_define_text(file, "quantity", text);
  zp_plot_define_word(file, "si", grid->unit ? grid->unit : "");
  zp_plot_define(file, "lowest_value", low);
  zp_plot_define(file, "highest_value", high);
}

static void define_map(const ZpPlot *plot, FILE *file) {
  Grid grid;
  if (!find_grid(plot, &grid)) return;
  define_answer(plot, file, &grid);
  zp_plot_define_count(file, "rows", grid.rows);
  zp_plot_define_count(file, "columns_across", grid.columns);
  define_axis(plot, file, "x", grid.x, grid.columns, 1);
  define_axis(plot, file, "y", grid.y, grid.rows, grid.columns);
}

/* -- small multiples -------------------------------------------------------------------------------- */

static bool has_maps(const ZpPlot *plot) {
  Grid grid;
  return find_grid(plot, &grid) && grid.z >= 0;
}

/* A panel: panel_at[k], the value of the third key, `z_name`. */
static void define_maps(const ZpPlot *plot, FILE *file) {
  Grid grid;
  if (!find_grid(plot, &grid)) return;
  define_map(plot, file);
  zp_plot_define_text(file, "z_name", zp_key(grid.z)->name);
  zp_plot_define_text(file, "z_unit", zp_key(grid.z)->shown);
  zp_plot_define_array(file, "panel_at", drawn_panels(&grid));
  for (size_t k = 0; k < drawn_panels(&grid); k++) {
    const double value = zp_sweep_value(plot, chosen_panel(&grid, k) * grid.rows * grid.columns, grid.z);
    zp_plot_define(file, zp_plot_entry("panel_at", k + 1).text, value * zp_sweep_factor(grid.z));
  }
}

const ZpPicture zp_map_pictures[] = {{"map", "svg", has_map, define_map, data_map, "map.gp"},
                                     {"maps", "svg", has_maps, define_maps, data_map, "maps.gp"},
                                     {0}};
