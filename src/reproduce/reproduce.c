/* Reproduce the paper: run, compare, write. summary.json is removed first and written last, as in any report. */

#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/version.h>

#include "base/fail.h"
#include "io/atomic.h"
#include "io/json.h"
#include "io/number.h"
#include "io/report.h"
#include "reproduce/compare.h"
#include "reproduce/figures.h"
#include "reproduce/page.h"
#include "reproduce/reproduce.h"
#include "reproduce/runs.h"

/* -- comparison.csv -------------------------------------------------------------------------------- */

static void put_number(FILE *file, double value) {
  char text[ZP_NUMBER_SIZE];
  zp_number_print(value, text, sizeof text);
  if (isfinite(value)) fputs(text, file);
  fputc(',', file);
}

static ZpStatus write_csv(const char *directory, const ZpComparisons *comparisons, ZpError *err) {
  ZpAtomic out;
  ZpStatus status = zp_atomic_open(&out, directory, "comparison.csv", err);
  if (status != ZP_OK) return status;
  fputs("place,quantity,nodes,load_g,unit,paper,ours,relative_difference,tolerance,verdict,why\n", out.file);
  for (size_t i = 0; i < comparisons->count; i++) {
    const ZpComparison *c = &comparisons->item[i];
    fprintf(out.file, "%s,%s,%d,%g,%s,%s,", c->subject->place, c->subject->title, c->nodes, c->published->load,
            c->subject->unit, c->published->text);
    put_number(out.file, c->ours);
    put_number(out.file, c->difference);
    put_number(out.file, c->tolerance);
    fprintf(out.file, "%s,%s\n", zp_verdict_info(c->verdict)->word,
            zp_comparison_has_reason(c) ? zp_reason(c->subject->reason)->title : "");
  }
  return zp_atomic_commit(&out, err);
}

/* -- summary.json ---------------------------------------------------------------------------------- */

static json_t *row_of(const ZpComparison *c) {
  json_t *row = json_object();
  bool done = zp_json_set(row, "place", json_string(c->subject->place));
  done = zp_json_set(row, "quantity", json_string(c->subject->title)) && done;
  done = zp_json_set(row, "nodes", json_integer(c->nodes)) && done;
  done = zp_json_set(row, "load_g", json_real(c->published->load)) && done;
  done = zp_json_set(row, "unit", json_string(c->subject->unit)) && done;
  done = zp_json_set(row, "paper", json_real(c->published->value)) && done;
  done = zp_json_set(row, "ours", zp_json_number(c->ours, "1")) && done;
  done = zp_json_set(row, "relative_difference", zp_json_number(c->difference, "1")) && done;
  done = zp_json_set(row, "tolerance", zp_json_number(c->tolerance, "1")) && done;
  done = zp_json_set(row, "verdict", json_string(zp_verdict_info(c->verdict)->word)) && done;
  json_t *why = zp_comparison_has_reason(c) ? json_string(zp_reason(c->subject->reason)->title) : json_null();
  done = zp_json_set(row, "why", why) && done;
  if (done) return row;
  json_decref(row);
  return NULL;
}

static const char *message_of(ZpOutcome outcome) {
  if (outcome == ZP_INTERRUPTED) return "interrupted; the results so far are kept";
  return zp_outcome_good(outcome) ? "all runs done" : "a run failed: see its summary.json";
}

/* {"agrees": 81, ...}: number of comparisons with each verdict. NULL if there is no memory. */
static json_t *verdicts_of(const ZpComparisons *comparisons) {
  json_t *object = json_object();
  bool done = true;
  for (int i = 0; i < ZP_VERDICT_COUNT; i++) {
    const size_t count = zp_comparisons_count(comparisons, (ZpVerdict)i);
    done = zp_json_set(object, zp_verdict_info((ZpVerdict)i)->word, json_integer((json_int_t)count)) && done;
  }
  if (done) return object;
  json_decref(object);
  return NULL;
}

/* NULL if there is no memory. */
static json_t *summary_of(const ZpComparisons *comparisons, ZpOutcome outcome, double wall_time) {
  json_t *object = json_object(), *rows = json_array();
  bool done = true;
  for (size_t i = 0; i < comparisons->count; i++)
    done = json_array_append_new(rows, row_of(&comparisons->item[i])) == 0 && done;
  done = zp_json_set(object, "version", json_string(ZP_VERSION)) && done;
  done = zp_json_set(object, "study", json_string("reproduce")) && done;
  done = zp_json_set(object, "outcome", json_string(zp_outcome_name(outcome))) && done;
  done = zp_json_set(object, "message", json_string(message_of(outcome))) && done;
  done = zp_json_set(object, "wall_time_s", zp_json_number(wall_time, "s")) && done;
  done = zp_json_set(object, "verdicts", verdicts_of(comparisons)) && done;
  done = zp_json_set(object, "rows", rows) && done;
  if (done) return object;
  json_decref(object);
  return NULL;
}

static ZpStatus write_summary(const char *directory, const json_t *summary, ZpError *err) {
  ZpAtomic out;
  ZpStatus status = zp_atomic_open(&out, directory, "summary.json", err);
  return status == ZP_OK ? zp_atomic_finish(&out, zp_json_write(summary, out.file, err), err) : status;
}

/* -- all of it ------------------------------------------------------------------------------------- */

static ZpStatus write_page(const ZpPage *page, ZpError *err) {
  ZpAtomic out;
  ZpStatus status = zp_atomic_open(&out, page->directory, "report.html", err);
  if (status != ZP_OK) return status;
  zp_page_write(page, out.file);
  return zp_atomic_commit(&out, err);
}

static ZpStatus write_all(const ZpPage *page, const ZpHooks *hooks, void (*notice)(const char *message), FILE *summary,
                          ZpError *err) {
  ZpStatus status = write_csv(page->directory, page->comparisons, err);
  if (status == ZP_OK) status = zp_figures_draw(page->directory, page->runs, hooks, notice, err);
  if (status == ZP_OK) status = write_page(page, err);
  if (status != ZP_OK) return status;
  json_t *tree = summary_of(page->comparisons, page->runs->outcome, page->wall_time);
  if (!tree) return zp_fail_memory(err);
  status = write_summary(page->directory, tree, err);
  if (status == ZP_OK && summary) status = zp_json_write(tree, summary, err);
  json_decref(tree);
  return status;
}

static ZpStatus run_and_write(const char *directory, const ZpHooks *hooks, void (*notice)(const char *message),
                              FILE *summary, ZpOutcome *outcome, ZpError *err) {
  ZpRuns runs;
  ZpComparisons comparisons = {NULL, 0};
  const bool timed = hooks && hooks->clock;
  const double start = timed ? hooks->clock(hooks->user) : (double)NAN;
  ZpStatus status = zp_runs_make(directory, hooks, notice, &runs, err);
  if (status == ZP_OK) status = zp_compare(&runs, &comparisons, err);
  const double wall_time = timed ? hooks->clock(hooks->user) - start : (double)NAN;
  const ZpPage page = {directory, &runs, &comparisons, wall_time};
  if (status == ZP_OK) status = write_all(&page, hooks, notice, summary, err);
  *outcome = runs.outcome;
  free(comparisons.item);
  zp_runs_free(&runs);
  return status;
}

/* The locale of the caller may write 0.5 as 0,5: files must not. */
static ZpStatus reproduce_plainly(const char *directory, const ZpHooks *hooks, void (*notice)(const char *message),
                                  FILE *summary, ZpOutcome *outcome, ZpError *err) {
  locale_t plain = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
  if (!plain) return zp_fail_memory(err);
  locale_t before = uselocale(plain);
  ZpStatus status = run_and_write(directory, hooks, notice, summary, outcome, err);
  uselocale(before);
  freelocale(plain);
  return status;
}

ZpStatus zp_reproduce(const char *directory, const ZpHooks *hooks, void (*notice)(const char *message), FILE *summary,
                      ZpOutcome *outcome, ZpError *err) {
  ZpFolder *folder;
  ZpStatus status = zp_folder_open(directory, &folder, err);
  if (status != ZP_OK) return status;
  status = zp_remove_file(directory, "summary.json", err);
  if (status == ZP_OK) status = reproduce_plainly(directory, hooks, notice, summary, outcome, err);
  zp_folder_close(folder);
  return status;
}
