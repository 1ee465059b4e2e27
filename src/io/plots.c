/* plots/: the pictures of a report. Templates say which pictures there are, in lines such as
 *
 *   #picture shapes.svg one branch|held_branch voltage_V :shapes.dat
 *
 * This picture is drawn of one run (or of many) of a study whose results are of one of these kinds (studies.def), or
 * that has one of these names, if all conditions hold. A condition has alternatives between |:
 *
 *   voltage_V     the column of table.csv has two numbers
 *   voltage_V*9   it has nine
 *   =zip_time_s   the summary of the run has this number
 *   ~voltage_V    the column varies
 *   >voltage_V    it has a number above 0
 *   @drive.rate   the key differs from its default
 *   +drive.rate   it is above 0
 *   :shapes.dat   there is such a file of data
 *   :regions      the run has such a further table
 *   :axis         one of the facts in `flag`
 *   !voltage_V    the rest does not hold
 *
 * The numbers matter more than a picture: they are on the disk before gnuplot runs. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "def/rule.h"
#include "io/drawing.h"
#include "io/file.h"
#include "io/plan.h"
#include "io/plot.h"
#include "io/report.h"
#include "study/result.h"

/* Cases above which pictures of a sweep are not drawn: more points than a picture can show. */
enum { DRAWN_MOST = 10000, PICTURES_MOST = 100, WORDS_SIZE = 512 };

/* -- conditions ------------------------------------------------------------------------------------ */

/* Do the values of a list key increase or decrease, three at least? A surface needs this. */
static bool is_surface(const ZpPlot *plot, size_t axis) {
  size_t count;
  const double *value = zp_scenario_axis(plot->report->scenario, plot->axis[axis], &count);
  for (size_t i = 0; i + 1 < count; i++)
    if (!((value[i + 1] - value[i]) * (value[1] - value[0]) > 0)) return false;
  return count > 2;
}

/* Pairs of a column that was set and a column of measurements. */
static size_t count_panels(const ZpPlot *plot) {
  size_t set = 0, measured = 0;
  for (size_t i = 0; i < plot->columns; i++) {
    const bool is_measured = strncmp(plot->column[i].name, "measured_", 9) == 0;
    measured += is_measured;
    set += !is_measured && measured == 0 && plot->column[i].count > 0;
  }
  return set * measured;
}

static bool is_on_several_ports(const ZpActuatorDef *def) {
  bool apart = false;
  for (size_t k = 0; def->given && k < def->given->count; k++) {
    const int row = zp_key_instance(def->given->value[k].key).row;
    apart |= row >= ZP_KEY(member_K.port) && row <= ZP_KEY(member_K.setpoint.duty);
  }
  return apart;
}

/* Does a data file have rows, or one of these facts hold? */
static bool has_flag(const ZpPlot *plot, const char *name) {
  const ZpOptimum *optimum = plot->report->optimum;
  const bool samples = zp_scenario_design(plot->report->scenario) != NULL;
  /* runs to draw against the list key that varies fastest, and all of them for a surface over two or three keys */
  const bool axis = plot->axes > 0 && !samples && !optimum;
  const bool grid = axis && plot->axes > 1 && plot->report->count == zp_scenario_count(plot->report->scenario) &&
                    is_surface(plot, plot->axes - 2) && is_surface(plot, plot->axes - 1);
  size_t varied = 0;
  for (size_t i = 0; i < plot->columns; i++)
    varied += plot->column[i].key >= 0 && plot->column[i].high > plot->column[i].low;
  const struct {
    const char *name;
    bool holds;
  } flag[] = {{"samples", samples},
              {"bodies", zp_def_network(&plot->def)},
              {"planar", zp_def_plane(&plot->def)},
              {"ports", zp_def_network(&plot->def) && is_on_several_ports(&plot->def)},
              {"axis", axis},
              {"plane", grid && plot->axes == 2},
              {"planes", grid && plot->axes == 3},
              {"lines", plot->report->count > 2 && varied >= (axis ? 3 : 2)}, /* two that are drawn or optimised */
              {"front", optimum && !samples && optimum->objectives > 1 && optimum->count > 1},
              {"panel", count_panels(plot) == 1},
              {"panels", count_panels(plot) > 1}};
  for (int k = 0; k < ZP_FURTHER; k++)
    if (strcmp(zp_further_name[k], name) == 0) return plot->single && plot->single->further[k];
  for (const ZpPlotData *data = zp_plot_data; data->name; data++)
    if (strcmp(data->name, name) == 0) return data->has(plot);
  for (size_t i = 0; i < sizeof flag / sizeof flag[0]; i++)
    if (strcmp(flag[i].name, name) == 0) return flag[i].holds;
  return false;
}

static bool has_numbers(const ZpPlot *plot, const char *name) {
  char column[WORDS_SIZE];
  size_t least = 2;
  sscanf(name, "%511[^*]*%zu", column, &least);
  const ZpPlotColumn *found = zp_plot_column(plot, column);
  return found && found->count >= least;
}

static bool holds(const ZpPlot *plot, const char *condition) {
  const char *name = condition + 1;
  const ZpPlotColumn *column = zp_plot_column(plot, name);
  const int key = strchr("@+", *condition) ? zp_key_find(name) : -1;
  const double value = key >= 0 ? zp_def_get(&plot->def, key) : NAN, usual = key >= 0 ? zp_key(key)->def : NAN;
  switch (*condition) {
  case '!':
    return !holds(plot, name);
  case '~':
    return column && column->high > column->low;
  case '>':
    return column && column->high > 0;
  case '=':
    return isfinite(zp_result_get(plot->single, name));
  case '@':
    return value != usual && !(isnan(value) && isnan(usual));
  case '+':
    return value > 0;
  case ':':
    return has_flag(plot, name);
  default:
    return has_numbers(plot, condition);
  }
}

static bool is_of_kind(const ZpPlot *plot, const char *kind) {
  return strcmp(kind, zp_study_kind(plot->study)) == 0 || strcmp(kind, zp_study_name(plot->study)) == 0;
}

/* Does one of the alternatives hold? */
static bool any_holds(const ZpPlot *plot, char *words, bool (*test)(const ZpPlot *plot, const char *word)) {
  for (char *word = strsep(&words, "|"); word; word = strsep(&words, "|"))
    if (test(plot, word)) return true;
  return false;
}

/* "one branch|held_branch voltage_V :frames" */
static bool is_drawn(const ZpPlot *plot, char *conditions) {
  char *word = strsep(&conditions, " ");
  if (!word || strcmp(word, plot->single ? "one" : "many") != 0) return false;
  word = strsep(&conditions, " ");
  bool drawn = word && any_holds(plot, word, is_of_kind);
  while (drawn && (word = strsep(&conditions, " ")) != NULL)
    drawn = any_holds(plot, word, holds);
  return drawn;
}

/* -- pictures -------------------------------------------------------------------------------------- */

/* All pictures of a report, or of any report if `plot` is NULL => their number. */
static size_t list_pictures(const ZpPlot *plot, ZpPicture list[PICTURES_MOST]) {
  size_t count = 0;
  for (const ZpTemplate *one = zp_templates; one->name; one++)
    for (const char *at = one->text; strncmp(at, "#picture ", 9) == 0; at = strchr(at, '\n') + 1) {
      ZpPicture picture = {.template = one->name};
      char words[WORDS_SIZE];
      const int read = sscanf(at, "#picture %47[^.].%7s %511[^\n]", picture.name, picture.extension, words);
      if (read == 3 && count < PICTURES_MOST && (!plot || is_drawn(plot, words))) list[count++] = picture;
    }
  return count;
}

/* Pictures and data of an earlier report. */
static ZpStatus remove_all(const ZpDrawing *drawing, ZpError *err) {
  ZpPicture list[PICTURES_MOST];
  const size_t count = list_pictures(NULL, list);
  ZpStatus status = zp_remove_file(drawing->folder, "result.gp", err);
  for (size_t i = 0; i < count && status == ZP_OK; i++)
    status = zp_drawing_remove(drawing, &list[i], err);
  for (const ZpPlotData *data = zp_plot_data; data->name && status == ZP_OK; data++)
    status = zp_remove_file(drawing->folder, data->name, err);
  return status;
}

static ZpStatus write_all(const ZpDrawing *drawing, const ZpPlot *plot, ZpError *err) {
  ZpPicture list[PICTURES_MOST];
  const size_t count = list_pictures(plot, list);
  ZpStatus status = zp_make_folder(drawing->folder, err);
  if (count > 0 && status == ZP_OK) status = zp_drawing_file(drawing, "result.gp", zp_plot_define, plot, err);
  for (const ZpPlotData *data = zp_plot_data; data->name && count > 0 && status == ZP_OK; data++)
    if (data->has(plot)) status = zp_drawing_file(drawing, data->name, data->put, plot, err);
  for (size_t i = 0; i < count && status == ZP_OK; i++)
    status = zp_drawing_script(drawing, &list[i], err);
  return status;
}

/* The drawing of a report, and, if there is something to draw, `plot`. Both are to be closed, on failure too. */
static ZpStatus open_drawing(const ZpReport *report, ZpDrawing *drawing, ZpPlot *plot, ZpError *err) {
  *plot = (ZpPlot){0};
  *drawing = (ZpDrawing){.folder = zp_path_join(report->directory, "plots"),
                         .templates = report->templates,
                         .patience = ZP_DRAWING_PATIENCE,
                         .hooks = report->hooks,
                         .jobs = report->jobs};
  if (!drawing->folder) return zp_fail_memory(err);
  if (report->count == 0 || report->count > DRAWN_MOST) return ZP_OK;
  ZpStatus status = zp_scenario_def(report->scenario, 0, &plot->def, err);
  return status == ZP_OK && plot->def.output.plots ? zp_plot_open(report, plot, err) : status;
}

static void close_drawing(ZpDrawing *drawing, ZpPlot *plot) {
  zp_def_clear(&plot->def);
  free(plot->column);
  free(drawing->folder);
}

ZpStatus zp_plots_prepare(const ZpReport *report, ZpError *err) {
  ZpPlot plot;
  ZpDrawing drawing;
  ZpStatus status = open_drawing(report, &drawing, &plot, err);
  if (status == ZP_OK) status = remove_all(&drawing, err);
  if (status == ZP_OK && plot.report) status = write_all(&drawing, &plot, err);
  close_drawing(&drawing, &plot);
  return status;
}

void zp_plots_write(const ZpReport *report, void (*notice)(const char *message)) {
  ZpPlot plot;
  ZpDrawing drawing;
  ZpPicture list[PICTURES_MOST];
  ZpError err;
  ZpStatus status = open_drawing(report, &drawing, &plot, &err);
  drawing.notice = notice;
  if (status == ZP_OK && plot.report) zp_drawing_draw(&drawing, list, list_pictures(&plot, list));
  if (status != ZP_OK && notice) notice(err.message);
  close_drawing(&drawing, &plot);
}
