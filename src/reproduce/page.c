/* report.html. The sections are a table; all numbers come from comparisons and runs. */
#include "reproduce/page.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/version.h>

#include "io/atomic.h"
#include "io/html.h"

static const char drag_note[] = "No zip time here includes the drag of the liquid that is squeezed out. None of them "
                                "predicts how fast a real actuator zips.";

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
    "tr.new td{border-top:1px solid #aaa}td.ok{color:#00664a}td.off{color:#a34400}td.unjudged{color:#666}"
    ".note{border-left:4px solid #d55e00;padding:.3rem .8rem;background:#fff6ef}"
    ".verdict{font-size:1.05rem;margin:.5rem 0}.left{text-align:left}"
    ".formula{font:italic 1.1rem/3 Georgia,'Times New Roman',serif;margin-left:1rem}"
    ".formula sub,.formula sup{font-size:.7em;line-height:0}"
    ".over{display:inline-flex;flex-direction:column;text-align:center;vertical-align:middle;line-height:1.4;margin:0 "
    ".15rem}"
    ".over span:first-child{border-bottom:1px solid;padding:0 .2rem}"
    ":root{color-scheme:light "
    "dark}@media(prefers-color-scheme:dark){body{color:#dfe3e6;background:#121619}a{color:#7cc4ee}"
    "h2,th,td{border-color:#333c43}td.ok{color:#5ec9a0}td.off{color:#f0a060}td.unjudged{color:#9aa4ac}"
    ".note{background:#33231a}.pictures svg{filter:invert(.93) hue-rotate(180deg)}}"
    "@media(max-width:30rem){body{padding:.6rem}th,td{padding:.1rem .25rem}table{font-size:.78rem}}"
    "@media print{body{font-size:10pt;max-width:none;padding:0}h2{break-after:avoid}figure,li{break-inside:avoid}"
    "table{font-size:8pt}a{color:inherit;text-decoration:none}.pictures figure{flex-basis:45%}}";

/* -- tables of comparisons ------------------------------------------------------------------------- */

static size_t decimals_of(const char *text) {
  const char *point = strchr(text, '.');
  return point ? strspn(point + 1, "0123456789") : 0;
}

/* Our number with one digit more than is printed; if that shows almost nothing, with two significant digits. */
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

/* A percentage, or a factor. */
static void put_difference(FILE *file, double difference) {
  char text[64];
  double ratio = 1 + difference;
  if (ratio > 10)
    snprintf(text, sizeof text, "× %.0f", ratio);
  else if (ratio < 0.1 && ratio > 1e-3)
    snprintf(text, sizeof text, "÷ %.0f", 1 / ratio);
  else
    snprintf(text, sizeof text, "%+.2f %%", 100 * difference);
  zp_html_number(file, text);
}

static const char *class_of(ZpVerdict verdict) {
  if (verdict == ZP_VERDICT_AGREES) return "ok";
  return zp_verdict_info(verdict)->judged ? "off" : "unjudged";
}

/* The tolerance with its significant digits; an empty cell if nothing is judged. */
static void put_tolerance(FILE *file, double tolerance) {
  char text[64];
  if (isnan(tolerance)) return;
  fputs("<td>", file);
  snprintf(text, sizeof text, tolerance < 1e4 ? "%.2g" : "%.1e", tolerance);
  fputs("±&nbsp;", file);
  zp_html_number(file, text);
  fputs("</td>", file);
}

static void put_letter(FILE *file, ZpReasonId reason) {
  fprintf(file, "<a href=\"#why-%c\">%c</a>", 'a' + (int)reason, 'a' + (int)reason);
}

/* Our number, difference, tolerance, and a tick or the letter of the reason. */
static void put_verdict(FILE *file, const ZpComparison *c) {
  if (c->verdict == ZP_VERDICT_NOT_RUN) {
    fputs("<td>not run</td><td>–</td>", file);
    put_tolerance(file, c->tolerance);
    fputs("<td></td>", file);
    return;
  }
  fputs("<td>", file);
  put_ours(file, c);
  fprintf(file, "</td><td class=\"%s\">", class_of(c->verdict));
  put_difference(file, c->difference);
  fputs("</td>", file);
  put_tolerance(file, c->tolerance);
  fprintf(file, "<td class=\"%s\">", class_of(c->verdict));
  if (zp_comparison_has_reason(c))
    put_letter(file, c->subject->reason);
  else
    fputs("✓", file);
  fputs("</td>", file);
}

/* Is this the first row of its load? */
static bool is_new_load(const ZpComparison *c, const ZpComparison *first) {
  return c > first && c->published->load != c[-1].published->load;
}

static void put_row(FILE *file, const ZpComparison *c, const ZpComparison *first, bool loads) {
  fprintf(file, "<tr%s>", is_new_load(c, first) ? " class=\"new\"" : "");
  if (loads) fprintf(file, "<td>%g&nbsp;g</td>", c->published->load);
  if (c->nodes > 0) fprintf(file, "<td>%d</td>", c->nodes);
  fputs("<td>", file);
  zp_html_number(file, c->published->text);
  fputs("</td>", file);
  put_verdict(file, c);
  fputs("</tr>\n", file);
}

/* The comparisons of one subject from `first` on. => the first one of the next subject. */
static const ZpComparison *put_subject(FILE *file, const ZpComparison *first, const ZpComparison *end) {
  const ZpSubject *subject = first->subject;
  const bool nodes = first->nodes > 0, loads = strncmp(subject->place, "Table", 5) == 0;
  const bool judged = zp_verdict_info(zp_reason(subject->reason)->verdict)->judged;
  fputs("<figure><figcaption>", file);
  zp_html_text(file, subject->title);
  if (*subject->unit) fputs(" / ", file);
  zp_html_text(file, subject->unit);
  if (!judged) fputs(", not judged", file);
  fprintf(
      file,
      "</figcaption><table><thead><tr>%s%s<th>%s</th><th>ours</th><th>difference</th>%s<th></th></tr></thead><tbody>\n",
      loads ? "<th>load</th>" : "", nodes ? "<th>N</th>" : "", subject->source, judged ? "<th>tolerance</th>" : "");
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

/* A cell; empty if there is no number. */
static void put_cell(FILE *file, const char *format, double value) {
  char text[64];
  snprintf(text, sizeof text, format, value);
  fputs("<td>", file);
  zp_html_number(file, isnan(value) ? "–" : text);
  fputs("</td>", file);
}

static const double table_2_load[] = {40, 60, 80, 100, 150, 200}; /* g */
static const int table_2_nodes[] = {21, 61, 130};

/* One row per load, one column per N: `value` of both. */
static void put_by_load_and_nodes(FILE *file, const ZpRuns *runs, const char *caption, const char *format,
                                  double (*value)(const ZpRuns *runs, ZpWhich which)) {
  fprintf(file, "<figure><figcaption>%s</figcaption><table><thead><tr><th>load</th>", caption);
  for (size_t k = 0; k < sizeof table_2_nodes / sizeof table_2_nodes[0]; k++)
    fprintf(file, "<th>N&nbsp;=&nbsp;%d</th>", table_2_nodes[k]);
  fputs("</tr></thead><tbody>\n", file);
  for (size_t i = 0; i < sizeof table_2_load / sizeof table_2_load[0]; i++) {
    fprintf(file, "<tr><td>%g&nbsp;g</td>", table_2_load[i]);
    for (size_t k = 0; k < sizeof table_2_nodes / sizeof table_2_nodes[0]; k++)
      put_cell(file, format, value(runs, (ZpWhich){.load = table_2_load[i], .nodes = table_2_nodes[k]}));
    fputs("</tr>\n", file);
  }
  fputs("</tbody></table></figure>\n", file);
}

/* Relative to the stroke of the chain, in per cent, as in the paper. */
static double error_to_converged(const ZpRuns *runs, ZpWhich which) {
  const ZpRunId chain = which.nodes == 21   ? ZP_RUN_TABLE_2_21
                        : which.nodes == 61 ? ZP_RUN_TABLE_2_61
                                            : ZP_RUN_TABLE_2_130;
  const double elements = zp_runs_get(runs, ZP_RUN_FINITE_ELEMENTS, (ZpWhich){.load = which.load}, "stroke_m");
  return 100 * fabs(1 - elements / zp_runs_get(runs, chain, which, "stroke_m"));
}

/* mm */
static double text_stroke(const ZpRuns *runs, ZpWhich which) {
  return 1e3 * zp_runs_get(runs, ZP_RUN_TABLE_2_TEXT, which, "stroke_m");
}

static void put_table_2_alone(FILE *file, const ZpRuns *runs) {
  fputs(
      "<p>The next two tables have no counterpart in the paper. The first shows the error of our chain against the "
      "converged finite elements. The second shows the strokes of the actuator that the paper's text describes: steel "
      "of 50 µm, and half of the load on each half. The program behind Table II used 100 µm and a quarter of the load. "
      "So the actuator of the text opens much further under the same loads.</p>\n<div class=\"tables\">\n",
      file);
  put_by_load_and_nodes(file, runs, "error of our chain against the converged finite elements / %", "%.2f",
                        error_to_converged);
  put_by_load_and_nodes(file, runs, "stroke of the text's actuator, 50 µm / mm", "%.2f", text_stroke);
  fputs("</div>\n", file);
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
  for (size_t i = 0; i < batch->done; i++) { /* independent of the voltage: those of the first voltage */
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
  const char *place;   /* subject whose comparisons it shows */
  void (*more)(FILE *file, const ZpRuns *runs);
  Picture picture[4];
} Section;

/* Formulas are plain HTML elements: MathML needs a font that not every machine has. */
#define OVER(above, below)  "<span class=\"over\"><span>" above "</span><span>" below "</span></span>"
#define SUM_OF_LOADS(share) "M g<sub>0</sub>" share " + q L/2"

static const char shear_formula[] = "K<sub>S</sub> = " OVER("E I", "l<sup>3</sup>")
    OVER("N (N + 1)", "(N − 1)<sup>2</sup>") OVER(SUM_OF_LOADS("/4"), SUM_OF_LOADS(""));

static const char plates_formula[] = "W = " OVER("1", "2") "ε<sub>0</sub> ε<sub>m</sub> w " OVER(
    "U<sup>2</sup>", "(g + 2 t ε<sub>m</sub>/ε<sub>i</sub>)<sup>2</sup>");

static const Section sections[] = {
    {"table-1",
     "Table I: calibration of the chain",
     {"Study <code>calibrate</code> fits K<sub>S</sub> to the stroke that the paper prints for its finite elements. "
      "The "
      "chain is that of preset <code>paper-code</code>, with a quarter of the load on it, as in the authors' program.",
      "The last column is K<sub>S</sub> from theory, without any fit. The finite elements carried the whole load on "
      "the "
      "half-beam, the particles a quarter of it; the paper's calibration absorbed the difference:"},
     shear_formula,
     "Table I",
     NULL,
     {{0}}},
    {"table-2",
     "Table II: strokes at rest",
     {"The chain is preset <code>paper-code</code> with the K<sub>S</sub> of the authors' saved states at 61 g. The "
      "finite elements are preset <code>paper-fe</code>, converged. Errors are those of the chain against the "
      "published "
      "reference, relative to the chain's stroke, as in the paper."},
     NULL,
     "Table II",
     put_table_2_alone,
     {{0}}},
    {"fig-6",
     "Fig. 6: shapes at rest",
     {"The paper prints no numbers for its curves; their ends are the strokes of Table II. Both models are drawn from "
      "the clip on."},
     NULL,
     NULL,
     NULL,
     {{"plots/fig-6.svg", "The chain (points) against the converged finite elements (lines)"}}},
    {"fig-7",
     "Fig. 7: force along a ribbon",
     {"The plates law takes the liquid and both insulators in series, and the full voltage. The field solved in the "
      "plane of the ribbons matches it without a factor. The paper's plates lie far below. Scaled by the paper's "
      "factor, "
      "they give what its finite-element expression gives, which is above the true force.",
      "The paper prints no numbers for its curves except the factor between them, which is below."},
     plates_formula,
     NULL,
     NULL,
     {{"plots/fig-7.svg", "Electric force per length on one ribbon"}}},
    {"fig-8",
     "Fig. 8: contractile force against separation",
     {"The paper prints no numbers here, and its experiments are points in a picture, so no difference can be "
      "computed. "
      "The table compares models: ours with breakdown of the liquid, ours without (the authors' runs had none), and "
      "the "
      "paper's text, with half the voltage, its own insulator offset and the factor on the force.",
      "The paper finds its simulation consistently above the mean of the experiments. Breakdown lowers the force, and "
      "so "
      "does a bead of liquid instead of a bath."},
     NULL,
     NULL,
     put_forces,
     {{"plots/fig-8.svg", "What the voltage adds to the force on a held platform"}}},
    {"fig-9",
     "Fig. 9: contraction against time",
     {drag_note,
      "8 g at four voltages. Ours: rod, 50 µm steel, unilateral contact, implicit steps. Theirs: preset "
      "<code>paper-code</code> at two N, and preset <code>paper-text</code>. The drag on their particles is arbitrary, "
      "differs from N to N, and sets the time (docs/theory.md, section 3.5).",
      "The paper prints no numbers for its curves. The authors' program, run again from its saved states, gives two. "
      "Only "
      "the one at 6 kV tests our preset: a constant of the preset, which acts above 6 kV, was inferred from the "
      "other."},
     NULL,
     "Fig. 9",
     put_zip_times,
     {{"runs/fig-9/plots/contraction.svg", "Ours"},
      {"runs/fig-9-code-n21/plots/contraction.svg", "The authors' program, N = 21"},
      {"runs/fig-9-code-n61/plots/contraction.svg", "The authors' program, N = 61"},
      {"runs/fig-9-text/plots/contraction.svg", "The paper's text, N = 21"}}},
    {"fig-10",
     "Fig. 10: profiles in time",
     {drag_note,
      "8 g at 10 kV. Ours has steel of 50 µm, as in the text. The authors' program has 100 µm and a smaller "
      "share of the load (<a href=\"#table-2\">Table II</a>), so it opens less. The paper prints no numbers. "
      "It sees an expansion before the contraction; here:"},
     NULL,
     NULL,
     put_openings,
     {{"runs/fig-10/plots/profiles.svg", "Ours"},
      {"runs/fig-10-code/plots/profiles.svg", "The authors' program, N = 61"}}},
    {"factor",
     "Section III.B: the factor of 27 cases",
     {"Openings of 1, 2 and 4 mm at nine voltages. The paper's own method gives its factor for our field, too, as the "
      "product of four causes. The right law needs no factor."},
     NULL,
     "Factor",
     put_causes,
     {{"runs/factor/plots/factors.svg", "The factor against the opening"}}},
    {"cost",
     "Section III: constants and cost",
     {"The cost is the CPU time of a simulated second on one thread of this machine, with the authors' chain, the "
      "electric force computed in every step, and as many steps as the paper's mean step requires."},
     NULL,
     "Section III",
     NULL,
     {{0}}},
};

enum { SECTIONS = sizeof sections / sizeof sections[0] };

/* The page reports a picture that gnuplot could not draw, or whose run was not reached. */
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

/* Number of comparisons with this reason. */
static size_t count_reason(const ZpPage *page, int reason) {
  size_t count = 0;
  for (size_t i = 0; i < page->comparisons->count; i++) {
    const ZpComparison *c = &page->comparisons->item[i];
    count += zp_comparison_has_reason(c) && (int)c->subject->reason == reason;
  }
  return count;
}

/* "84 agree ...", with the letters of its reasons. */
static void put_verdict_row(FILE *file, const ZpPage *page, ZpVerdict verdict, size_t count) {
  fprintf(file, "<tr><td class=\"%s\"><b>%zu</b></td><td class=\"left\">%s", class_of(verdict), count,
          zp_verdict_info(verdict)->title);
  for (int k = 0; k < ZP_REASON_COUNT; k++)
    if (zp_reason((ZpReasonId)k)->verdict == verdict && count_reason(page, k) > 0) {
      fputs(" ", file);
      put_letter(file, (ZpReasonId)k);
    }
  fputs("</td></tr>\n", file);
}

/* One line per verdict that occurs. */
static void put_verdicts(FILE *file, const ZpPage *page) {
  fputs("<table class=\"verdict\"><tbody>\n", file);
  for (int i = 0; i < ZP_VERDICT_COUNT; i++) {
    const size_t count = zp_comparisons_count(page->comparisons, (ZpVerdict)i);
    if (count > 0) put_verdict_row(file, page, (ZpVerdict)i, count);
  }
  fputs("</tbody></table>\n", file);
}

static void put_head(FILE *file, const ZpPage *page) {
  fprintf(
      file,
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>The paper beside zipact</title>\n<style>%s</style></head><body>\n"
      "<h1>Modular simulation framework for Electro-ribbon Actuators: the paper beside zipact " ZP_VERSION "</h1>\n"
      "<p>Every number that the paper by B. Castro, R. S. Diteesawat, M. Taghavi and J. Rossiter prints of its model, "
      "beside the same number from this program, computed in %.1f s. Of %zu numbers:</p>\n",
      style, page->wall_time, page->comparisons->count);
  put_verdicts(file, page);
  fprintf(
      file,
      "<p>Two numbers agree (✓) within %g %% or one unit of the last digit printed, whichever is more. The error of a "
      "stroke is the difference of two printed numbers and may be off by two units; a K<sub>S</sub> that is fitted "
      "to a rounded stroke is as uncertain as that stroke. Every table shows its tolerance. Differences are ours / "
      "paper − 1. A letter leads to the <a href=\"#why\">reason</a>.</p>\n<p class=\"note\">%s</p>\n",
      100 * ZP_AGREEMENT, drag_note);
}

/* Number of comparisons of a subject, from `first` on, that agree. => the first one of the next subject. */
static const ZpComparison *put_overview_row(FILE *file, const ZpComparison *first, const ZpComparison *end) {
  const ZpComparison *c = first;
  const ZpReasonId reason = first->subject->reason;
  const bool judged = zp_verdict_info(zp_reason(reason)->verdict)->judged;
  size_t agree = 0, run = 0;
  for (; c < end && c->subject == first->subject; c++) {
    run += c->verdict != ZP_VERDICT_NOT_RUN;
    agree += c->verdict == ZP_VERDICT_AGREES;
  }
  fputs("<tr><td class=\"left\">", file);
  zp_html_text(file, first->subject->place);
  fputs("</td><td class=\"left\">", file);
  zp_html_text(file, first->subject->title);
  fprintf(file, "</td><td class=\"%s\">", !judged ? "unjudged" : agree < run ? "off" : "ok");
  fprintf(file, judged ? "%zu of %zu</td><td>" : "not judged</td><td>", agree, run);
  if (agree < run) put_letter(file, reason);
  fputs("</td></tr>\n", file);
  return c;
}

static void put_overview(FILE *file, const ZpPage *page) {
  const ZpComparison *c = page->comparisons->item, *end = c + page->comparisons->count;
  fputs("<div class=\"tables\"><figure><figcaption>What agrees</figcaption><table><thead><tr><th class=\"left\">of</th>"
        "<th class=\"left\">quantity</th><th>agree</th><th>why</th></tr></thead><tbody>\n",
        file);
  while (c < end)
    c = put_overview_row(file, c, end);
  fputs("</tbody></table></figure>\n", file);
}

/* The contents, beside the overview. */
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
    const size_t count = count_reason(page, i);
    if (count == 0) continue;
    fprintf(file, "<li id=\"why-%c\" value=\"%d\"><b>", 'a' + i, i + 1);
    zp_html_text(file, reason->title);
    fputs(".</b> ", file);
    zp_html_text(file, reason->sentence);
    fprintf(file, " <span>(docs/theory.md, section %s; %zu number%s)</span></li>\n", reason->section, count,
            count > 1 ? "s" : "");
  }
  fputs("</ol></section>\n", file);
}

static void put_files(FILE *file) {
  fputs("<section id=\"files\"><h2>Data, and how to run it again</h2>\n"
        "<p><code>comparison.csv</code> and <code>summary.json</code> beside this page hold every comparison; "
        "<code>plots</code> holds the pictures of several runs. Each folder of <code>runs</code> is a study of its own "
        "with "
        "<code>table.csv</code>, <code>results.h5</code>, <code>plots</code> and <code>scenario.yaml</code>, which "
        "repeats the run: <code>zipact run scenario.yaml</code>.</p>\n<p>Folders:",
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
