/* The contents of a report, in the form that pictures need. */
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "io/cases.h"
#include "io/plot.h"
#include "io/sampled.h"

/* Cases above which pictures of a sweep are not drawn: more points than a picture can show. */
enum { DRAWN_MOST = 10000 };

/* -- subtitle -------------------------------------------------------------------------------------- */

/* Add "name value" to the subtitle unless the key is swept: then the legend has it. */
static void add_key(ZpPlot *plot, const char *name, const char *before) {
  size_t keys, used = strlen(plot->subtitle);
  const int key = zp_key_find(name), *list = zp_scenario_lists(plot->report->scenario, &keys);
  char value[64];
  for (size_t i = 0; i < keys; i++)
    if (list[i] == key) return;
  zp_plot_print_value(key, zp_def_get(&plot->def, key), value, sizeof value);
  snprintf(plot->subtitle + used, sizeof plot->subtitle - used, "%s%s%s", used ? ", " : "", before, value);
}

/* "8 kV", "ramp to 8 kV"; of a table only that it is one. */
static void add_drive(ZpPlot *plot) {
  static const char *const before[ZpWaveformKind_COUNT] = {"", "ramp to ", "sine to ", "square wave to ", NULL};
  const char *words = before[plot->def.drive.waveform];
  size_t used = strlen(plot->subtitle);
  if (words)
    add_key(plot, "drive.voltage", words);
  else
    snprintf(plot->subtitle + used, sizeof plot->subtitle - used, "%stable of voltages", used ? ", " : "");
}

typedef struct Subtitle {
  ZpStudy study;
  const char *key, *alone, *swept;
} Subtitle;

static const Subtitle subtitles[] = {
#define ZP_SUBTITLE(enumerator, key, alone, swept) {enumerator, key, alone, swept},
#include <zipact/studies.def>
};

/* A single ribbon has no voltage. An optimisation may have other objectives than the answer of its study, and these
 * depend on all keys. */
static void add_subtitle(ZpPlot *plot, const Subtitle *s) {
  if (plot->def.actuator.kind == ZP_KIND_RIBBON && strncmp(s->key, "drive.", 6) == 0) return;
  const char *words = plot->single || (plot->report->optimum && !s->swept) ? s->alone : s->swept;
  if (!s->alone)
    add_drive(plot);
  else if (words)
    add_key(plot, s->key, words);
}

static void add_subtitles(ZpPlot *plot, ZpStudy study) {
  for (size_t k = 0; k < sizeof subtitles / sizeof subtitles[0]; k++)
    if (subtitles[k].study == study) add_subtitle(plot, &subtitles[k]);
  if (plot->shows != ZP_SHOWS_field || plot->def.profile.shape == ZP_PROFILE_HELD) add_key(plot, "mesh.nodes", "N = ");
  if (plot->def.preset != ZP_PRESET_NONE) add_key(plot, "preset", "preset ");
}

/* -- table ----------------------------------------------------------------------------------------- */

static const ZpAnswer answers[] = {
#define ZP_SWEEP(enumerator, picture, title, axis, unit, scalar, legend, scalar2, legend2, count)                      \
  {enumerator, #picture, title, axis, unit, {scalar, scalar2}, {legend, legend2}, count},
#include <zipact/studies.def>
};

static const ZpAnswer *answer_of(ZpStudy study) {
  for (size_t i = 0; i < sizeof answers / sizeof answers[0]; i++)
    if (answers[i].study == study) return &answers[i];
  return NULL;
}

/* List keys, then the numbers of the summary, as in table.csv => number of columns. */
static size_t name_columns(ZpPlot *plot, const ZpScalarNames *names, ZpColumn *column) {
  size_t keys, count = 0;
  const int *key = zp_scenario_lists(plot->report->scenario, &keys);
  for (; count < keys; count++) {
    zp_key_column(key[count], plot->key_column[count], ZP_KEY_COLUMN_SIZE);
    column[count] = (ZpColumn){plot->key_column[count], zp_key(key[count])->unit, ""};
  }
  for (size_t i = 0; i < names->count; i++)
    column[count++] = (ZpColumn){names->item[i].name, names->item[i].unit, ""};
  return count;
}

static void fill_row(const ZpPlot *plot, const ZpScalarNames *names, size_t run) {
  ZpTable *table = plot->sweep;
  const ZpResult *result = zp_report_result(plot->report, run);
  double *value = table->value + table->columns * table->rows++;
  zp_scenario_values(plot->report->scenario, run, value);
  for (size_t i = 0; i < names->count; i++)
    value[table->columns - names->count + i] = zp_scalar_at(result, names, i);
}

static bool fill_sweep(ZpPlot *plot, const ZpScalarNames *names) {
  size_t keys;
  zp_scenario_lists(plot->report->scenario, &keys);
  ZpColumn *column = calloc(keys + names->count + 1, sizeof *column);
  plot->key_column = calloc(keys + 1, sizeof *plot->key_column);
  if (column && plot->key_column)
    plot->sweep = zp_table_create(column, name_columns(plot, names, column), plot->report->count + 2);
  for (size_t run = 0; plot->sweep && run < plot->report->count; run++)
    fill_row(plot, names, run);
  free(column);
  return plot->sweep != NULL;
}

/* False if there is no memory. */
static bool open_sweep(ZpPlot *plot) {
  ZpScalarNames names;
  if (!zp_report_scalars(plot->report, false, &names)) return false;
  const bool filled = fill_sweep(plot, &names);
  free(names.item);
  plot->table = plot->sweep;
  return filled;
}

ZpStatus zp_plot_open(const ZpReport *report, ZpPlot *plot, ZpError *err) {
  *plot = (ZpPlot){.report = report, .single = zp_report_single(report)};
  if (report->count == 0) return ZP_OK;
  ZpStatus status = zp_scenario_def(report->scenario, 0, &plot->def, err);
  if (status != ZP_OK) return status;
  const ZpStudy study = zp_report_result(report, 0)->study;
  plot->drawn = plot->def.output.plots && report->count <= DRAWN_MOST;
  plot->shows = zp_study_shows(study);
  plot->answer = answer_of(study);
  add_subtitles(plot, study);
  if (plot->single)
    plot->table = plot->single->series;
  else if (plot->drawn && !open_sweep(plot))
    return zp_fail_memory(err);
  return ZP_OK;
}

void zp_plot_close(ZpPlot *plot) {
  zp_table_destroy(plot->sweep);
  free(plot->key_column);
}

/* -- which pictures -------------------------------------------------------------------------------- */

static bool has_columns(const ZpTable *table, const char *names) {
  char name[96];
  for (int used = 0; names && sscanf(names, " %95s%n", name, &used) == 1; names += used)
    if (!zp_plot_has(table, name)) return false;
  return true;
}

static bool has_keys(const ZpPlot *plot, const char *names) {
  char name[96];
  for (int used = 0; names && sscanf(names, " %95s%n", name, &used) == 1; names += used) {
    const int key = zp_key_find(name);
    const double value = zp_def_get(&plot->def, key), usual = zp_key(key)->def;
    if (value != usual && !(value != value && usual != usual)) return true;
  }
  return !names;
}

bool zp_picture_is_drawn(const ZpPicture *picture, const ZpPlot *plot) {
  const unsigned fits = plot->single ? picture->one : picture->many;
  if ((picture->one || picture->many) && !(fits & 1u << plot->shows)) return false;
  return has_columns(plot->table, picture->needs) && has_keys(plot, picture->keys) &&
         (!picture->has || picture->has(plot));
}
