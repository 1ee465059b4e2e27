/* report.html: the template page.html, whose marks {{WORD ARGUMENT}} are replaced. All numbers come from comparisons
 * and runs. */
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/version.h>

#include "io/file.h"
#include "reproduce/html.h"
#include "reproduce/parts.h"

/* A number in the format of printf, with a minus sign and powers of ten. */
__attribute__((format(printf, 2, 3))) static void put_number(FILE *file, const char *format, ...) {
  char text[64];
  va_list values;
  va_start(values, format);
  vsnprintf(text, sizeof text, format, values);
  va_end(values);
  zp_html_number(file, text);
}

/* -- tables of comparisons ------------------------------------------------------------------------- */

/* Our number with one digit more than is printed; if that shows almost nothing, with two significant digits. */
static void put_ours(FILE *file, const ZpComparison *c) {
  const char *printed = c->published->text, *point = strchr(printed, '.');
  const int decimals = (point ? (int)strspn(point + 1, "0123456789") : 0) + 1;
  if (strchr(printed, 'e'))
    put_number(file, "%.*e", decimals, c->ours);
  else if (fabs(c->ours) < pow(10, 1 - decimals) && c->ours > 1e-9)
    put_number(file, "%.2g", c->ours);
  else
    put_number(file, "%.*f", decimals, c->ours);
}

/* A percentage, or a factor. */
static void put_difference(FILE *file, double difference) {
  double ratio = 1 + difference;
  if (ratio > 10)
    put_number(file, "× %.0f", ratio);
  else if (ratio < 0.1 && ratio > 1e-3)
    put_number(file, "÷ %.0f", 1 / ratio);
  else
    put_number(file, "%+.2f %%", 100 * difference);
}

static const char *class_of(ZpVerdict verdict) {
  if (verdict == ZP_VERDICT_AGREES) return "ok";
  return zp_verdicts[verdict].judged ? "off" : "unjudged";
}

/* The tolerance with its significant digits; no cell if nothing is judged. */
static void put_tolerance(FILE *file, double tolerance) {
  if (isnan(tolerance)) return;
  fputs("<td>±&nbsp;", file);
  put_number(file, tolerance < 1e4 ? "%.2g" : "%.1e", tolerance);
  fputs("</td>", file);
}

static void put_letter(FILE *file, const ZpReason *reason) {
  const int letter = 'a' + (int)(reason - zp_reasons);
  fprintf(file, "<a href=\"#why-%c\">%c</a>", letter, letter);
}

/* Our number, difference, tolerance, and a tick or the letter of the reason. */
static void put_verdict(FILE *file, const ZpComparison *c) {
  const bool run = c->verdict != ZP_VERDICT_NOT_RUN;
  fputs(run ? "<td>" : "<td>not run</td><td>–</td>", file);
  if (run) {
    put_ours(file, c);
    fprintf(file, "</td><td class=\"%s\">", class_of(c->verdict));
    put_difference(file, c->difference);
    fputs("</td>", file);
  }
  put_tolerance(file, c->tolerance);
  if (run)
    fprintf(file, "<td class=\"%s\">", class_of(c->verdict));
  else
    fputs("<td>", file);
  if (c->reason)
    put_letter(file, c->reason);
  else if (run)
    fputs("✓", file);
  fputs("</td>", file);
}

/* A line is drawn above the first row of the next load. */
static void put_row(FILE *file, const ZpComparison *c, bool next_load, bool loads) {
  fprintf(file, "<tr%s>", next_load ? " class=\"new\"" : "");
  if (loads) fprintf(file, "<td>%g&nbsp;g</td>", c->published->load);
  if (c->nodes > 0) fprintf(file, "<td>%d</td>", c->nodes);
  fputs("<td>", file);
  zp_html_number(file, c->published->text);
  fputs("</td>", file);
  put_verdict(file, c);
  fputs("</tr>\n", file);
}

/* => the first comparison of the next subject. */
static const ZpComparison *end_of(const ZpPage *page, const ZpComparison *first) {
  const ZpComparison *c = first, *end = page->comparisons->item + page->comparisons->count;
  while (c < end && c->subject == first->subject)
    c++;
  return c;
}

static bool is_judged(const ZpSubject *subject) {
  return zp_verdicts[zp_reasons[subject->reason].verdict].judged;
}

/* The comparisons of one subject from `first` on. */
static void put_subject(FILE *file, const ZpComparison *first, const ZpComparison *end) {
  const ZpSubject *subject = first->subject;
  const bool loads = strncmp(subject->place, "Table", 5) == 0, judged = is_judged(subject);
  fprintf(file,
          "<figure><figcaption>%s%s%s%s</figcaption><table><thead><tr>%s%s<th>%s</th><th>ours</th><th>difference</th>%s"
          "<th></th></tr></thead><tbody>\n",
          subject->title, *subject->unit ? " / " : "", subject->unit, judged ? "" : ", not judged",
          loads ? "<th>load</th>" : "", first->nodes > 0 ? "<th>N</th>" : "", subject->source,
          judged ? "<th>tolerance</th>" : "");
  for (const ZpComparison *c = first; c < end; c++)
    put_row(file, c, c > first && c->published->load != c[-1].published->load, loads);
  fputs("</tbody></table></figure>\n", file);
}

static void put_comparisons(const ZpPage *page, FILE *file, const char *place) {
  const ZpComparison *c = page->comparisons->item, *end = c + page->comparisons->count;
  for (const ZpComparison *next; c < end; c = next) {
    next = end_of(page, c);
    if (strcmp(c->subject->place, place) == 0) put_subject(file, c, next);
  }
}

/* Of each subject, how many agree. */
static void put_overview(const ZpPage *page, FILE *file, const char *argument) {
  const ZpComparison *first = page->comparisons->item, *end = first + page->comparisons->count;
  (void)argument;
  for (const ZpComparison *next; first < end; first = next) {
    const ZpSubject *subject = first->subject;
    const bool judged = is_judged(subject);
    size_t agree = 0, run = 0;
    next = end_of(page, first);
    for (const ZpComparison *c = first; c < next; c++) {
      run += c->verdict != ZP_VERDICT_NOT_RUN;
      agree += c->verdict == ZP_VERDICT_AGREES;
    }
    fprintf(file, "<tr><td class=\"left\">%s</td><td class=\"left\">%s</td><td class=\"%s\">", subject->place,
            subject->title,
            !judged       ? "unjudged"
            : agree < run ? "off"
                          : "ok");
    fprintf(file, judged ? "%zu of %zu</td><td>" : "not judged</td><td>", agree, run);
    if (agree < run) put_letter(file, &zp_reasons[subject->reason]);
    fputs("</td></tr>\n", file);
  }
}

/* -- tables of our own numbers --------------------------------------------------------------------- */

typedef struct TableRow {
  const char *label; /* NULL: the end */
  ZpWhich which;
  ZpRunId run; /* if the columns have none */
} TableRow;

typedef struct TableColumn {
  const char *title; /* NULL: the end */
  const char *scalar;
  ZpRunId run;
  int nodes;        /* 0: ignored */
  double breakdown; /* V/m; 0: ignored */
} TableColumn;

typedef struct Table {
  const char *name, *caption, *corner, *format; /* see tables.def */
  double factor;
  bool by_row, error;
  const TableRow *row;
  TableColumn column[7];
} Table;

static const TableRow loads[] = {{"40&nbsp;g", {.load = 40}, 0},
                                 {"60&nbsp;g", {.load = 60}, 0},
                                 {"80&nbsp;g", {.load = 80}, 0},
                                 {"100&nbsp;g", {.load = 100}, 0},
                                 {"150&nbsp;g", {.load = 150}, 0},
                                 {"200&nbsp;g", {.load = 200}, 0},
                                 {0}};
static const TableRow separations[] = {{"1&nbsp;mm", {.load = NAN, .separation = 1e-3}, 0},
                                       {"2&nbsp;mm", {.load = NAN, .separation = 2e-3}, 0},
                                       {"4&nbsp;mm", {.load = NAN, .separation = 4e-3}, 0},
                                       {0}};
static const TableRow voltages[] = {{"5&nbsp;kV", {.load = NAN, .voltage = 5e3}, 0},
                                    {"6&nbsp;kV", {.load = NAN, .voltage = 6e3}, 0},
                                    {"8&nbsp;kV", {.load = NAN, .voltage = 8e3}, 0},
                                    {"10&nbsp;kV", {.load = NAN, .voltage = 10e3}, 0},
                                    {0}};
static const TableRow openings[] = {
    {"ours", {.load = NAN}, ZP_RUN_FIG_10}, {"their program, N = 61", {.load = NAN}, ZP_RUN_FIG_10_CODE}, {0}};

#define ZP_OWN_TABLE(name, caption, corner, format, factor, by_row, error, rows, ...)                                  \
  {name, caption, corner, format, factor, by_row, error, rows, {__VA_ARGS__}},
static const Table tables[] = {
#include "reproduce/tables.def"
};

static double cell_of(const ZpRuns *runs, const Table *table, const TableRow *row, const TableColumn *column) {
  ZpWhich which = row->which;
  which.nodes = column->nodes;
  which.breakdown = column->breakdown;
  const double value = zp_runs_get(runs, table->by_row ? row->run : column->run, which, column->scalar);
  if (!table->error) return table->factor * value;
  const double elements = zp_runs_get(runs, ZP_RUN_FINITE_ELEMENTS, (ZpWhich){.load = which.load}, "stroke_m");
  return 100 * fabs(1 - elements / value);
}

static void put_table(const ZpPage *page, FILE *file, const char *name) {
  const Table *table = tables;
  while (strcmp(table->name, name) != 0)
    table++;
  fprintf(file, "<figure><figcaption>%s</figcaption><table><thead><tr><th>%s</th>", table->caption, table->corner);
  for (const TableColumn *column = table->column; column->title; column++)
    fprintf(file, "<th>%s</th>", column->title);
  fputs("</tr></thead><tbody>\n", file);
  for (const TableRow *row = table->row; row->label; row++) {
    fprintf(file, "<tr><td>%s</td>", row->label);
    for (const TableColumn *column = table->column; column->title; column++) {
      const double value = cell_of(page->runs, table, row, column);
      fputs("<td>", file);
      if (isnan(value))
        fputs("–", file);
      else
        put_number(file, table->format, value); // NOLINT(clang-diagnostic-format-nonliteral)
      fputs("</td>", file);
    }
    fputs("</tr>\n", file);
  }
  fputs("</tbody></table></figure>\n", file);
}

/* -- the other marks ------------------------------------------------------------------------------- */

/* "plots/fig-6.svg CAPTION". The page reports a picture that gnuplot could not draw, or whose run was not reached. */
static void put_picture(const ZpPage *page, FILE *file, const char *argument) {
  char prefix[96];
  const char *caption = strchr(argument, ' ') + 1;
  snprintf(prefix, sizeof prefix, "%.*s", (int)(caption - 1 - argument), argument);
  char *path = zp_path_join(page->directory, prefix);
  for (char *c = prefix; *c; c++)
    if (*c == '/' || *c == '.') *c = '-';
  fprintf(file, "<figure><figcaption>%s</figcaption>\n", caption);
  if (!path || !zp_html_svg(file, path, prefix, caption)) fputs("<p>This picture was not drawn.</p>", file);
  fputs("</figure>\n", file);
  free(path);
}

/* Number of comparisons with this reason. */
static size_t count_reason(const ZpPage *page, const ZpReason *reason) {
  size_t count = 0;
  for (size_t i = 0; i < page->comparisons->count; i++)
    count += page->comparisons->item[i].reason == reason;
  return count;
}

/* "84 agree ...", with the letters of its reasons; of each verdict that occurs. */
static void put_verdicts(const ZpPage *page, FILE *file, const char *argument) {
  (void)argument;
  for (int i = 0; i < ZP_VERDICT_COUNT; i++) {
    if (page->comparisons->of[i] == 0) continue;
    fprintf(file, "<tr><td class=\"%s\"><b>%zu</b></td><td class=\"left\">%s", class_of((ZpVerdict)i),
            page->comparisons->of[i], zp_verdicts[i].title);
    for (const ZpReason *reason = zp_reasons; reason < zp_reasons + ZP_REASON_COUNT; reason++)
      if ((int)reason->verdict == i && count_reason(page, reason) > 0) {
        fputs(" ", file);
        put_letter(file, reason);
      }
    fputs("</td></tr>\n", file);
  }
}

static void put_reasons(const ZpPage *page, FILE *file, const char *argument) {
  (void)argument;
  for (int i = 0; i < ZP_REASON_COUNT; i++) {
    const ZpReason *reason = &zp_reasons[i];
    const size_t count = count_reason(page, reason);
    if (count == 0) continue;
    fprintf(
        file,
        "<li id=\"why-%c\" value=\"%d\"><b>%s.</b> %s <span>(docs/theory.md, section %s; %zu number%s)</span></li>\n",
        'a' + i, i + 1, reason->title, reason->sentence, reason->section, count, count > 1 ? "s" : "");
  }
}

static void put_folders(const ZpPage *page, FILE *file, const char *argument) {
  (void)page, (void)argument;
  for (int id = 0; id < ZP_RUN_COUNT; id++)
    fprintf(file, " <code>%s</code>", zp_run_name((ZpRunId)id));
}

static void put_version(const ZpPage *page, FILE *file, const char *argument) {
  (void)page, (void)argument;
  fputs(ZP_VERSION, file);
}

static void put_seconds(const ZpPage *page, FILE *file, const char *argument) {
  (void)argument;
  fprintf(file, "%.1f", page->wall_time);
}

static void put_count(const ZpPage *page, FILE *file, const char *argument) {
  (void)argument;
  fprintf(file, "%zu", page->comparisons->count);
}

static void put_agreement(const ZpPage *page, FILE *file, const char *argument) {
  (void)page, (void)argument;
  fprintf(file, "%g", 100 * ZP_AGREEMENT);
}

static const struct {
  const char *word;
  void (*put)(const ZpPage *page, FILE *file, const char *argument);
} marks[] = {{"version", put_version},         {"seconds", put_seconds},   {"count", put_count},
             {"agreement", put_agreement},     {"verdicts", put_verdicts}, {"overview", put_overview},
             {"comparisons", put_comparisons}, {"table", put_table},       {"picture", put_picture},
             {"reasons", put_reasons},         {"folders", put_folders}};

void zp_page_write(const ZpPage *page, FILE *file) {
  const char *text = zp_pages[0].text;
  for (const char *mark; (mark = strstr(text, "{{")); text = strstr(mark, "}}") + 2) {
    char word[16], argument[128] = "";
    fwrite(text, 1, (size_t)(mark - text), file);
    sscanf(mark, "{{%15[^ }] %127[^}]", word, argument);
    for (size_t i = 0; i < sizeof marks / sizeof marks[0]; i++)
      if (strcmp(marks[i].word, word) == 0) marks[i].put(page, file, argument);
  }
  fputs(text, file);
}
