/* report.html. Sections are a table; numbers come from comparisons and runs, none is typed here. */
#include "reproduce/page.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/version.h>

#include "io/atomic.h"
#include "io/html.h"

static const char drag_note[] = "No drag of the liquid that is squeezed out is in any zip time here yet: they are no "
                                "prediction of how fast a real actuator zips.";

static const char style[] =
    "body{font:16px/1.5 system-ui,'Helvetica Neue',Helvetica,Arial,sans-serif;color:#222;background:#fff;"
    "max-width:75rem;margin:0 auto;padding:1rem;overflow-wrap:break-word}"
    "h1{font-size:1.6rem;line-height:1.25}h2{font-size:1.25rem;margin:2.5rem 0 .5rem;border-top:1px solid #ccc;"
    "padding-top:1rem}"
    "p,ul,ol{max-width:46rem}a{color:#0060a0}code{font-size:.9em}"
    ".tables,.pictures{display:flex;flex-wrap:wrap;gap:1.5rem 2rem;align-items:flex-start;margin:1rem 0}"
    "figure{margin:0;max-width:100%;overflow-x:auto}figcaption{font-weight:600;margin-bottom:.25rem}"
    ".pictures figure{flex:1 1 30rem;min-width:0;max-width:50rem}.pictures svg{width:100%;height:auto;border:1px solid "
    "#ddd}"
    "table{border-collapse:collapse;font-size:.85rem;font-variant-numeric:tabular-nums}"
    "th,td{padding:.1rem .45rem;text-align:right;border-bottom:1px solid #e4e4e4}"
    "thead th{border-bottom:1px solid #888;vertical-align:bottom}"
    "tr.new td{border-top:1px solid #aaa}td.ok{color:#00664a}td.off{color:#a34400}"
    ".note{border-left:4px solid #d55e00;padding:.3rem .8rem;background:#fff6ef}"
    ".verdict{font-size:1.1rem}.left{text-align:left}"
    ".formula{font:italic 1.1rem/3 Georgia,'Times New Roman',serif;margin-left:1rem}"
    ".formula sub,.formula sup{font-size:.7em;line-height:0}"
    ".over{display:inline-flex;flex-direction:column;text-align:center;vertical-align:middle;line-height:1.4;margin:0 "
    ".15rem}"
    ".over span:first-child{border-bottom:1px solid;padding:0 .2rem}"
    "@media(max-width:30rem){body{padding:.6rem}th,td{padding:.1rem .25rem}table{font-size:.78rem}}"
    "@media print{body{font-size:10pt;max-width:none;padding:0}h2{break-after:avoid}figure,li{break-inside:avoid}"
    "table{font-size:8pt}a{color:inherit;text-decoration:none}.pictures figure{flex-basis:45%}}";

/* -- tables of comparisons ------------------------------------------------------------------------- */

static size_t decimals_of(const char *text) {
  const char *point = strchr(text, '.');
  return point ? strspn(point + 1, "0123456789") : 0;
}

/* Ours with one digit more than is printed; where that shows next to nothing, two digits of what there is. */
static void put_ours(FILE *file, const ZpComparison *c) {
  char text[64];
  const char *printed = c->published->text;
  int decimals = (int)decimals_of(printed) + 1;
  if (strchr(printed, 'e'))
    snprintf(text, sizeof text, "%.*e", decimals, c->ours);
  else if (fabs(c->ours) < pow(10, 1 - decimals) && c->ours > 1e-9)
    snprintf(text, sizeof text, "%.2g", c->ours);
  else
    snprintf(text, sizeof text, "%.*f", decimals, c->ours);
  zp_html_number(file, text);
}

/* A percentage, or how many times less or more. */
static void put_difference(FILE *file, double difference) {
  char text[64];
  double ratio = 1 + difference;
  if (ratio > 10)
    snprintf(text, sizeof text, "× %.0f", ratio);
  else if (ratio < 0.1 && ratio > 1e-9)
    snprintf(text, sizeof text, "÷ %.0f", 1 / ratio);
  else
    snprintf(text, sizeof text, "%+.2f %%", 100 * difference);
  zp_html_number(file, text);
}

static void put_verdict(FILE *file, const ZpComparison *c) {
  const int reason = (int)c->subject->reason;
  if (isnan(c->ours))
    fputs("<td>not run</td><td>–</td><td></td>", file);
  else {
    fputs("<td>", file);
    put_ours(file, c);
    fprintf(file, "</td><td class=\"%s\">", c->agrees ? "ok" : "off");
    put_difference(file, c->difference);
    if (c->agrees)
      fputs("</td><td class=\"ok\">✓</td>", file);
    else
      fprintf(file, "</td><td class=\"off\"><a href=\"#why-%c\">%c</a></td>", 'a' + reason, 'a' + reason);
  }
}

/* Is this the first row of its load? */
static bool is_new_load(const ZpComparison *c, const ZpComparison *first) {
  return c > first && c->published->load != c[-1].published->load;
}

static void put_row(FILE *file, const ZpComparison *c, const ZpComparison *first, bool loads) {
  fprintf(file, "<tr%s>", is_new_load(c, first) ? " class=\"new\"" : "");
  if (loads) fprintf(file, "<td>%g&nbsp;g</td>", c->published->load);
  if (c->published->nodes > 0) fprintf(file, "<td>%d</td>", c->published->nodes);
  fputs("<td>", file);
  zp_html_number(file, c->published->text);
  fputs("</td>", file);
  put_verdict(file, c);
  fputs("</tr>\n", file);
}

/* The comparisons of one subject from `first` on. => the first of the next. */
static const ZpComparison *put_subject(FILE *file, const ZpComparison *first, const ZpComparison *end) {
  const ZpSubject *subject = first->subject;
  const bool nodes = first->published->nodes > 0, loads = strncmp(subject->place, "Table", 5) == 0;
  fputs("<figure><figcaption>", file);
  zp_html_text(file, subject->title);
  if (*subject->unit) fputs(" / ", file);
  zp_html_text(file, subject->unit);
  fprintf(file,
          "</figcaption><table><thead><tr>%s%s<th>%s</th><th>ours</th><th>difference</th><th>why</th></tr></thead>"
          "<tbody>\n",
          loads ? "<th>load</th>" : "", nodes ? "<th>N</th>" : "", subject->source);
  const ZpComparison *c = first;
  for (; c < end && c->subject == subject; c++)
    put_row(file, c, first, loads);
  fputs("</tbody></table></figure>\n", file);
  return c;
}

static void put_comparisons(FILE *file, const ZpPage *page, const char *place) {
  const ZpComparison *c = page->comparisons->item, *end = c + page->comparisons->count;
  fputs("<div class=\"tables\">\n", file);
  while (c < end)
    if (strcmp(c->subject->place, place) == 0)
      c = put_subject(file, c, end);
    else
      c++;
  fputs("</div>\n", file);
}

/* -- tables of our own numbers --------------------------------------------------------------------- */

/* A cell; empty where there is no number. */
static void put_cell(FILE *file, const char *format, double value) {
  char text[64];
  snprintf(text, sizeof text, format, value);
  fputs("<td>", file);
  zp_html_number(file, isnan(value) ? "–" : text);
  fputs("</td>", file);
}

static void put_forces(FILE *file, const ZpRuns *runs) {
  static const double separation[] = {1e-3, 2e-3, 4e-3}; /* of fig. 8 */
  fputs("<div class=\"tables\"><figure><figcaption>force at 6 kV / N</figcaption><table><thead><tr><th>separation</th>"
        "<th>with breakdown</th><th>without</th><th>the paper's text</th></tr></thead><tbody>\n",
        file);
  for (size_t i = 0; i < 3; i++) {
    const ZpWhich which = {.load = NAN, .separation = separation[i]};
    const ZpBatch *batch = &runs->run[ZP_RUN_FIG_8].batch;
    double without = NAN;
    for (size_t k = batch->count / 2; k < batch->done; k++)
      if (fabs(zp_runs_def(runs, ZP_RUN_FIG_8, k).isometric.separation - separation[i]) < 1e-9)
        without = zp_result_get(batch->result[k], "force_N");
    fprintf(file, "<tr><td>%g&nbsp;mm</td>", 1e3 * separation[i]);
    put_cell(file, "%.4f", zp_runs_get(runs, ZP_RUN_FIG_8, which, "force_N"));
    put_cell(file, "%.4f", without);
    put_cell(file, "%.4f", zp_runs_get(runs, ZP_RUN_FIG_8_PAPER, which, "force_N"));
    fputs("</tr>\n", file);
  }
  fputs("</tbody></table></figure></div>\n", file);
}

static void put_zip_times(FILE *file, const ZpRuns *runs) {
  static const ZpRunId id[] = {ZP_RUN_FIG_9, ZP_RUN_FIG_9_CODE_21, ZP_RUN_FIG_9_CODE_61, ZP_RUN_FIG_9_TEXT};
  const ZpBatch *batch = &runs->run[ZP_RUN_FIG_9].batch;
  fputs("<div class=\"tables\"><figure><figcaption>zip time / ms</figcaption><table><thead><tr><th>voltage</th>"
        "<th>ours</th><th>their program, N = 21</th><th>N = 61</th><th>their text, N = 21</th></tr></thead><tbody>\n",
        file);
  for (size_t i = 0; i < batch->done; i++) {
    double voltage = zp_runs_def(runs, ZP_RUN_FIG_9, i).drive.voltage;
    fprintf(file, "<tr><td>%g&nbsp;kV</td>", 1e-3 * voltage);
    for (size_t k = 0; k < sizeof id / sizeof id[0]; k++)
      put_cell(file, "%.1f", 1e3 * zp_runs_get(runs, id[k], (ZpWhich){.load = NAN, .voltage = voltage}, "zip_time_s"));
    fputs("</tr>\n", file);
  }
  fputs("</tbody></table></figure></div>\n<p>–: not closed when the run ended.</p>\n", file);
}

static void put_openings(FILE *file, const ZpRuns *runs) {
  static const ZpRunId id[] = {ZP_RUN_FIG_10, ZP_RUN_FIG_10_CODE};
  fputs("<div class=\"tables\"><figure><figcaption>opening / mm</figcaption><table><thead><tr><th></th><th>at the "
        "start</th>"
        "<th>widest</th></tr></thead><tbody>\n",
        file);
  for (size_t i = 0; i < 2; i++) {
    fprintf(file, "<tr><td>%s</td>", i == 0 ? "ours" : "their program, N = 61");
    put_cell(file, "%.3f", 1e3 * zp_runs_get(runs, id[i], (ZpWhich){.load = NAN}, "start_opening_m"));
    put_cell(file, "%.3f", 1e3 * zp_runs_get(runs, id[i], (ZpWhich){.load = NAN}, "widest_opening_m"));
    fputs("</tr>\n", file);
  }
  fputs("</tbody></table></figure></div>\n", file);
}

static void put_causes(FILE *file, const ZpRuns *runs) {
  static const char *const scalar[] = {"scale_factor",      "paper_factor_voltage", "paper_factor_half",
                                       "paper_factor_tape", "paper_factor_gap",     "paper_factor"};
  const ZpBatch *batch = &runs->run[ZP_RUN_FACTOR].batch;
  fputs("<div class=\"tables\"><figure><figcaption>the factor and its causes</figcaption><table><thead><tr>"
        "<th>opening</th><th>field / plates</th><th>voltage</th><th>half</th><th>tape</th><th>gap</th><th>product</th>"
        "</tr></thead><tbody>\n",
        file);
  for (size_t i = 0; i < batch->done; i++) { /* the same at every voltage: those of the first */
    ZpActuatorDef def = zp_runs_def(runs, ZP_RUN_FACTOR, i);
    if (def.drive.voltage > zp_runs_def(runs, ZP_RUN_FACTOR, 0).drive.voltage) break;
    fprintf(file, "<tr><td>%g&nbsp;mm</td>", 1e3 * def.isometric.separation);
    for (size_t k = 0; k < sizeof scalar / sizeof scalar[0]; k++)
      put_cell(file, "%.3f", zp_result_get(batch->result[i], scalar[k]));
    fputs("</tr>\n", file);
  }
  fputs("</tbody></table></figure></div>\n", file);
}

/* -- sections -------------------------------------------------------------------------------------- */

typedef struct Picture {
  const char *path, *caption;
} Picture;

typedef struct Section {
  const char *id, *title;
  const char *text[3]; /* paragraphs, HTML */
  const char *formula; /* HTML */
  const char *place;   /* whose comparisons it shows */
  void (*more)(FILE *file, const ZpRuns *runs);
  Picture picture[4];
} Section;

/* Formulas are made of plain elements: MathML needs a font that not every machine has. */
#define OVER(above, below)  "<span class=\"over\"><span>" above "</span><span>" below "</span></span>"
#define SUM_OF_LOADS(share) "M g<sub>0</sub>" share " + q L/2"

static const char shear_formula[] = "K<sub>S</sub> = " OVER("E I", "l<sup>3</sup>")
    OVER("N (N + 1)", "(N − 1)<sup>2</sup>") OVER(SUM_OF_LOADS("/4"), SUM_OF_LOADS(""));

static const char plates_formula[] = "W = " OVER("1", "2") "ε<sub>0</sub> ε<sub>m</sub> w " OVER(
    "U<sup>2</sup>", "(g + 2 t ε<sub>m</sub>/ε<sub>i</sub>)<sup>2</sup>");

static const Section sections[] = {
    {"table-1",
     "Table I: calibration of the chain",
     {"K<sub>S</sub> is fitted to the stroke that the paper prints for its finite elements, by study "
      "<code>calibrate</code> on the chain of "
      "preset "
      "<code>paper-code</code>, a quarter of the load on it as the authors' program had it. Beside that K<sub>S</sub> "
      "from theory, without "
      "any "
      "fit:"},
     shear_formula,
     "Table I",
     NULL,
     {{0}}},
    {"table-2",
     "Table II: strokes at rest",
     {"Preset <code>paper-code</code> with the K<sub>S</sub> of the authors' saved states at 61 g; the finite elements "
      "converged by preset "
      "<code>paper-fe</code>. "
      "The same loads on the actuator as the text describes it come from preset <code>paper-text</code>. Errors of the "
      "stroke stand "
      "beside those to the published reference, then to the converged one."},
     NULL,
     "Table II",
     NULL,
     {{0}}},
    {"fig-6",
     "Fig. 6: shapes at rest",
     {"The paper prints no numbers for its curves; the ends are the strokes of Table II. Both models are drawn from "
      "the clip "
      "on."},
     NULL,
     NULL,
     NULL,
     {{"plots/fig-6.svg", "The chain (points) against the converged finite elements (lines)"}}},
    {"fig-7",
     "Fig. 7: force along a ribbon",
     {"The plates law takes the liquid and both insulators in series and the full voltage. The field solved in the "
      "plane of "
      "the ribbons meets it without a factor. The paper's plates lie far below; scaled by the factor, they come to "
      "what its "
      "finite-element expression gives, above the true force.",
      "The paper prints no numbers for its curves but the factor between them, which is below."},
     plates_formula,
     NULL,
     NULL,
     {{"plots/fig-7.svg", "Electric force per length on one ribbon"}}},
    {"fig-8",
     "Fig. 8: contractile force against separation",
     {"The paper prints no numbers here and its experiments are points in a picture, so there is nothing to take a "
      "difference "
      "from. What can be compared are models: ours with breakdown of the liquid, ours without (the authors' runs had "
      "none), "
      "and the paper's text, with half the voltage, its own insulator offset and the factor on the force.",
      "The paper finds its simulation consistently above the mean of the experiments. Breakdown takes a part of the "
      "force, "
      "and a bead instead of a bath another."},
     NULL,
     NULL,
     put_forces,
     {{"plots/fig-8.svg", "Force of a held platform, what the voltage adds"}}},
    {"fig-9",
     "Fig. 9: contraction against time",
     {drag_note,
      "8 g at four voltages. Ours: rod, 50 µm steel, faces that push and let go, implicit steps. Theirs: preset "
      "<code>paper-code</code> at two "
      "N, and "
      "preset <code>paper-text</code>. The paper prints no numbers for its curves; its authors' program, run again "
      "from its saved "
      "states, "
      "gives two, which stand here. The drag of their particles is arbitrary, differs from N to N, and sets the time "
      "(docs/theory.md, section 3.5)."},
     NULL,
     "Fig. 9",
     put_zip_times,
     {{"runs/fig-9/plots/contraction.svg", "Ours"},
      {"runs/fig-9-code-n21/plots/contraction.svg", "The authors' program, N = 21"},
      {"runs/fig-9-code-n61/plots/contraction.svg", "The authors' program, N = 61"},
      {"runs/fig-9-text/plots/contraction.svg", "The paper's text, N = 21"}}},
    {"fig-10",
     "Fig. 10: profiles in time",
     {drag_note, "8 g at 10 kV; ours with 50 µm steel as the text has it, their program with 100 µm and a smaller "
                 "share of the load "
                 "(<a href=\"#why-a\">a</a>), so it opens less. The paper prints no numbers. Of the expansion that it "
                 "sees before the "
                 "contraction:"},
     NULL,
     NULL,
     put_openings,
     {{"runs/fig-10/plots/profiles.svg", "Ours"},
      {"runs/fig-10-code/plots/profiles.svg", "The authors' program, N = 61"}}},
    {"factor",
     "Section III.B: the factor of 27 cases",
     {"Openings of 1, 2 and 4 mm at nine voltages. The same field by the paper's own bookkeeping gives its factor, as "
      "the "
      "product of four causes; the right law needs none."},
     NULL,
     "Factor",
     put_causes,
     {{"runs/factor/plots/factors.svg", "The factor against the opening"}}},
    {"cost",
     "Section III: constants and cost",
     {"Cost of a simulated second with the authors' chain, the electric force found anew in every step, and as many "
      "steps as "
      "the paper's mean step makes; time of the processor, one thread of this machine."},
     NULL,
     "Section III",
     NULL,
     {{0}}},
};

enum { SECTIONS = sizeof sections / sizeof sections[0] };

/* Pictures that gnuplot could not draw, or whose run was not reached, are said to be missing. */
static void put_picture(FILE *file, const ZpPage *page, const Picture *picture) {
  char prefix[96], *path = zp_path_join(page->directory, picture->path);
  snprintf(prefix, sizeof prefix, "%s", picture->path);
  for (char *c = prefix; *c; c++)
    if (*c == '/' || *c == '.') *c = '-';
  fputs("<figure><figcaption>", file);
  zp_html_text(file, picture->caption);
  fputs("</figcaption>\n", file);
  if (!path || !zp_html_svg(file, path, prefix, picture->caption)) fputs("<p>This picture was not drawn.</p>", file);
  fputs("</figure>\n", file);
  free(path);
}

static void put_pictures(FILE *file, const ZpPage *page, const Section *section) {
  fputs("<div class=\"pictures\">\n", file);
  for (size_t i = 0; i < 4 && section->picture[i].path; i++)
    put_picture(file, page, &section->picture[i]);
  fputs("</div>\n", file);
}

static void put_section(FILE *file, const ZpPage *page, const Section *section) {
  fprintf(file, "<section id=\"%s\"><h2>", section->id);
  zp_html_text(file, section->title);
  fputs("</h2>\n", file);
  for (size_t i = 0; i < 3 && section->text[i]; i++) {
    fprintf(file, "<p%s>%s</p>\n", section->text[i] == drag_note ? " class=\"note\"" : "", section->text[i]);
  }
  if (section->formula) fprintf(file, "<div class=\"formula\" role=\"math\">%s</div>\n", section->formula);
  if (section->place) put_comparisons(file, page, section->place);
  if (section->more) section->more(file, page->runs);
  if (section->picture[0].path) put_pictures(file, page, section);
  fputs("</section>\n", file);
}

/* -- the page -------------------------------------------------------------------------------------- */

/* How many comparisons are not explained by agreeing but by this reason; ZP_REASON_COUNT: by any. */
static size_t count_explained(const ZpPage *page, int reason) {
  size_t count = 0;
  for (size_t i = 0; i < page->comparisons->count; i++) {
    const ZpComparison *c = &page->comparisons->item[i];
    bool counts = reason == ZP_REASON_COUNT || (int)c->subject->reason == reason;
    if (!isnan(c->ours) && !c->agrees && counts) count++;
  }
  return count;
}

static size_t count_run(const ZpPage *page) {
  size_t count = 0;
  for (size_t i = 0; i < page->comparisons->count; i++)
    if (!isnan(page->comparisons->item[i].ours)) count++;
  return count;
}

static void put_head(FILE *file, const ZpPage *page) {
  const size_t run = count_run(page), off = count_explained(page, ZP_REASON_COUNT);
  fprintf(
      file,
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>The paper beside zipact</title>\n<style>%s</style></head><body>\n"
      "<h1>Modular simulation framework for Electro-ribbon Actuators: the paper beside zipact " ZP_VERSION "</h1>\n"
      "<p>Every number that the paper by B. Castro, R. S. Diteesawat, M. Taghavi and J. Rossiter prints of its model, "
      "beside the same from this program, computed in %.1f s.</p>\n"
      "<p class=\"verdict\"><b>%zu</b> comparisons: <b class=\"agree\">%zu</b> agree, <b class=\"differ\">%zu</b> "
      "differ, each for one of the <a href=\"#why\">reasons below</a>.</p>\n"
      "<p>Two numbers agree (✓) within %g %%, or within one unit of the last digit printed (two for the error of a "
      "stroke, "
      "which is a difference). Differences are "
      "ours / paper − 1. A letter in the column <i>why</i> is a reason.</p>\n",
      style, page->wall_time, run, run - off, off, 100 * ZP_AGREEMENT);
  if (run < page->comparisons->count)
    fprintf(file, "<p class=\"note\">Interrupted, or a run failed: %zu comparisons are missing.</p>\n",
            page->comparisons->count - run);
  fprintf(file, "<p class=\"note\">%s</p>\n", drag_note);
}

/* How many of the comparisons of a subject, which begin at `first`, agree. => the first of the next subject. */
static const ZpComparison *put_overview_row(FILE *file, const ZpComparison *first, const ZpComparison *end) {
  const ZpComparison *c = first;
  size_t run = 0, agree = 0;
  for (; c < end && c->subject == first->subject; c++) {
    run += isnan(c->ours) ? 0 : 1;
    agree += c->agrees ? 1 : 0;
  }
  const int reason = 'a' + (int)first->subject->reason;
  fputs("<tr><td class=\"left\">", file);
  zp_html_text(file, first->subject->place);
  fputs("</td><td class=\"left\">", file);
  zp_html_text(file, first->subject->title);
  fprintf(file, "</td><td class=\"%s\">%zu of %zu</td>", agree < run ? "off" : "ok", agree, run);
  if (agree < run)
    fprintf(file, "<td><a href=\"#why-%c\">%c</a></td></tr>\n", reason, reason);
  else
    fputs("<td></td></tr>\n", file);
  return c;
}

static void put_overview(FILE *file, const ZpPage *page) {
  const ZpComparison *c = page->comparisons->item, *end = c + page->comparisons->count;
  fputs("<div class=\"tables\"><figure><figcaption>What agrees</figcaption><table><thead><tr><th class=\"left\">of</th>"
        "<th class=\"left\">quantity</th><th>agree</th><th>why not</th></tr></thead><tbody>\n",
        file);
  while (c < end)
    c = put_overview_row(file, c, end);
  fputs("</tbody></table></figure>\n", file);
}

/* Beside the overview. */
static void put_contents(FILE *file) {
  fputs("<nav><b>Contents</b><ul>\n", file);
  for (size_t i = 0; i < SECTIONS; i++) {
    fprintf(file, "<li><a href=\"#%s\">", sections[i].id);
    zp_html_text(file, sections[i].title);
    fputs("</a></li>\n", file);
  }
  fputs("<li><a href=\"#why\">Why numbers differ</a></li>\n<li><a href=\"#files\">Data, and how to run it "
        "again</a></li>\n"
        "</ul></nav></div>\n",
        file);
}

static void put_reasons(FILE *file, const ZpPage *page) {
  fputs("<section id=\"why\"><h2>Why numbers differ</h2>\n<ol type=\"a\">\n", file);
  for (int i = 0; i < ZP_REASON_COUNT; i++) {
    const ZpReason *reason = zp_reason((ZpReasonId)i);
    fprintf(file, "<li id=\"why-%c\"><b>", 'a' + i);
    zp_html_text(file, reason->title);
    fputs(".</b> ", file);
    zp_html_text(file, reason->sentence);
    fprintf(file, " <span>(docs/theory.md, section %s; %zu numbers)</span></li>\n", reason->section,
            count_explained(page, i));
  }
  fputs("</ol></section>\n", file);
}

static void put_files(FILE *file) {
  fputs(
      "<section id=\"files\"><h2>Data, and how to run it again</h2>\n"
      "<p>Beside this page: <code>comparison.csv</code> and <code>summary.json</code> hold every comparison, "
      "<code>plots</code> the pictures of several runs. Each folder of <code>runs</code> is a study of its own with "
      "<code>table.csv</code>, <code>results.h5</code>, <code>plots</code> and <code>scenario.yaml</code>, which runs "
      "again: <code>zipact run scenario.yaml</code>.</p>\n<p>Folders:",
      file);
  for (int id = 0; id < ZP_RUN_COUNT; id++)
    fprintf(file, " <code>%s</code>", zp_run_name((ZpRunId)id));
  fputs("</p></section>\n", file);
}

void zp_page_write(const ZpPage *page, FILE *file) {
  put_head(file, page);
  put_overview(file, page);
  put_contents(file);
  for (size_t i = 0; i < SECTIONS; i++)
    put_section(file, page, &sections[i]);
  put_reasons(file, page);
  put_files(file);
  fputs("</body></html>\n", file);
}
