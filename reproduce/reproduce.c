/* Reproduce the paper: run, compare, write. summary.json is removed first and written last, as in any report. */
#include <math.h>
#include <stdlib.h>

#include <zipact/version.h>

#include "base/fail.h"
#include "io/file.h"
#include "io/json.h"
#include "io/number.h"
#include "io/report.h"
#include "reproduce/parts.h"

static void put_number(FILE *file, double value) {
  char text[ZP_NUMBER_SIZE];
  zp_number_print(value, text, sizeof text);
  if (isfinite(value)) fputs(text, file);
  fputc(',', file);
}

static ZpStatus put_csv(const ZpPage *page, FILE *file, ZpError *err) {
  (void)err;
  fputs("place,quantity,nodes,load_g,unit,paper,ours,relative_difference,tolerance,verdict,why\n", file);
  for (size_t i = 0; i < page->comparisons->count; i++) {
    const ZpComparison *c = &page->comparisons->item[i];
    fprintf(file, "%s,%s,%d,%g,%s,%s,", c->subject->place, c->subject->title, c->nodes, c->published->load,
            c->subject->unit, c->published->text);
    put_number(file, c->ours);
    put_number(file, c->difference);
    put_number(file, c->tolerance);
    fprintf(file, "%s,%s\n", zp_verdicts[c->verdict].word, c->reason ? c->reason->title : "");
  }
  return ZP_OK;
}

static ZpStatus put_page(const ZpPage *page, FILE *file, ZpError *err) {
  (void)err;
  zp_page_write(page, file);
  return ZP_OK;
}

static void put_row(ZpJson *json, const ZpComparison *c) {
  zp_json_open(json, NULL, '{');
  zp_json_text(json, "place", c->subject->place);
  zp_json_text(json, "quantity", c->subject->title);
  zp_json_number(json, "nodes", c->nodes, "count");
  zp_json_number(json, "load_g", c->published->load, "1");
  zp_json_text(json, "unit", c->subject->unit);
  zp_json_number(json, "paper", c->published->value, "1");
  zp_json_number(json, "ours", c->ours, "1");
  zp_json_number(json, "relative_difference", c->difference, "1");
  zp_json_number(json, "tolerance", c->tolerance, "1");
  zp_json_text(json, "verdict", zp_verdicts[c->verdict].word);
  zp_json_text(json, "why", c->reason ? c->reason->title : NULL);
  zp_json_close(json, '}');
}

static const char *message_of(ZpOutcome outcome) {
  if (outcome == ZP_INTERRUPTED) return "interrupted; the results so far are kept";
  return zp_outcome_good(outcome) ? "all runs done" : "a run failed: see its summary.json";
}

static ZpStatus put_summary(const ZpPage *page, FILE *file, ZpError *err) {
  ZpJson json = {.file = file};
  const ZpOutcome outcome = page->runs->outcome;
  zp_json_open(&json, NULL, '{');
  zp_json_text(&json, "version", ZP_VERSION);
  zp_json_text(&json, "study", "reproduce");
  zp_json_text(&json, "outcome", zp_outcome_name(outcome));
  zp_json_text(&json, "message", message_of(outcome));
  zp_json_number(&json, "wall_time_s", page->wall_time, "s");
  zp_json_open(&json, "verdicts", '{');
  for (int i = 0; i < ZP_VERDICT_COUNT; i++)
    zp_json_number(&json, zp_verdicts[i].word, (double)page->comparisons->of[i], "count");
  zp_json_close(&json, '}');
  zp_json_open(&json, "rows", '[');
  for (size_t i = 0; i < page->comparisons->count; i++)
    put_row(&json, &page->comparisons->item[i]);
  zp_json_close(&json, ']');
  zp_json_close(&json, '}');
  return zp_json_finish(&json, err);
}

static ZpStatus write_file(const ZpPage *page, const char *name,
                           ZpStatus (*put)(const ZpPage *page, FILE *file, ZpError *err), ZpError *err) {
  ZpAtomic out;
  ZpStatus status = zp_atomic_open(&out, page->directory, name, err);
  return status == ZP_OK ? zp_atomic_finish(&out, put(page, out.file, err), err) : status;
}

static ZpStatus run_and_write(const char *directory, const ZpHooks *hooks, void (*notice)(const char *message),
                              FILE *summary, ZpOutcome *outcome, ZpError *err) {
  ZpRuns runs;
  ZpComparisons comparisons = {NULL, 0, {0}};
  const bool timed = hooks && hooks->clock;
  const double start = timed ? hooks->clock(hooks->user) : (double)NAN;
  ZpStatus status = zp_runs_make(directory, hooks, notice, &runs, err);
  if (status == ZP_OK) status = zp_compare(&runs, &comparisons, err);
  const double wall_time = timed ? hooks->clock(hooks->user) - start : (double)NAN;
  const ZpPage page = {directory, &runs, &comparisons, wall_time};
  if (status == ZP_OK) status = write_file(&page, "comparison.csv", put_csv, err);
  if (status == ZP_OK) status = zp_figures_draw(directory, &runs, hooks, notice, err);
  if (status == ZP_OK) status = write_file(&page, "report.html", put_page, err);
  if (status == ZP_OK) status = write_file(&page, "summary.json", put_summary, err);
  if (status == ZP_OK && summary) status = put_summary(&page, summary, err);
  *outcome = runs.outcome;
  free(comparisons.item);
  zp_runs_free(&runs);
  return status;
}

ZpStatus zp_reproduce(const char *directory, const ZpHooks *hooks, void (*notice)(const char *message), FILE *summary,
                      ZpOutcome *outcome, ZpError *err) {
  ZpFolder *folder;
  ZpStatus status = zp_folder_open(directory, &folder, err);
  if (status != ZP_OK) return status;
  status = zp_remove_file(directory, "summary.json", err);
  if (status == ZP_OK) status = run_and_write(directory, hooks, notice, summary, outcome, err);
  zp_folder_close(folder);
  return status;
}
