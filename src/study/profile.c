/* Study `profile`: the electric force along the ribbons of one shape, by the plates law and by the field in the plane
 * of the ribbons. Theory, section 15.
 *
 * Both are taken at the same columns of the field's grid and integrated by the same rule (Simpson's), so their ratio
 * compares the two laws and not two quadratures. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "def/check.h"
#include "electro/field.h"
#include "liquid/bead.h"
#include "rest/rest.h"
#include "study/faces.h"
#include "study/notes.h"
#include "study/sensitivity.h"
#include "study/studies.h"

/* A row per column of the grid, from the edge of the clip on. */
enum { X, GAP, PLATES, FIELD, UPPER, LOWER, RATIO, FORCE, LIQUID, INSULATOR, CAPPED, COLUMNS };
static const ZpColumn columns[COLUMNS] = {
    {"x_m", "m", "distance from the edge of the clip"},
    {"gap_m", "m", "distance between the faces"},
    {"plates_N_per_m", "N/m", "attraction per length by the plates law as set, without breakdown cap"},
    {"field_N_per_m", "N/m", "attraction per length by the field, mean of both ribbons"},
    {"field_upper_N_per_m", "N/m", "attraction per length of the upper ribbon by the field"},
    {"field_lower_N_per_m", "N/m", "attraction per length of the lower ribbon by the field"},
    {"ratio", "1", "field over plates"},
    {"force_N_per_m", "N/m",
     "attraction per length by electro.model, limited by breakdown if electro.breakdown_cap is true"},
    {"medium_field_V_per_m", "V/m", "field in liquid or air at the faces, before any cap"},
    {"insulator_field_V_per_m", "V/m", "field in the insulators"},
    {"capped", "1", "1: breakdown limits the force, 0: it does not"},
};

/* Stations along the flexible part. Forces then differ from those on twice as many by 1e-5 for openings up to 17 mm,
 * and by 2e-4 at 60 mm. */
enum { STATIONS = 121 };

/* Gaps below this are none, m. */
static const double rounding = 1e-15;

/* A larger difference between the two ways to compute the force from the field is reported. */
static const double agreement = 5e-3;

/* A larger difference of the field from the correct plates law is reported. */
static const double valid = 0.02;

typedef double Row[COLUMNS];

/* The plates law where liquid is, and where a bead leaves air. */
typedef struct Law {
  ZpPlatesParams liquid, air;
} Law;

typedef struct Profiler {
  const ZpModel *model;
  ZpResult *result;
  double U;
  bool by_field;        /* electro.model */
  Law set, free, right; /* the plates law as set; without cap; the right one, without cap */
  double *wet;       /* [rows / 2] how much of the two intervals from row 2 k on liquid wets: of the flexible part all
                        or nothing */
  ZpCover cover;     /* the same for the field */
  double wet_length; /* of the flexible part, m */
  ZpFieldParams params;
  ZpField field;
  ZpFieldTotals totals;
  ZpStations stations;
  ZpContact faces;
  ZpMargins margins; /* of the shape without voltage, then under it as the field is solved */
  Row *row;          /* [rows] */
  size_t last, rows; /* row of the platform's edge; rows up to the mirror plane, or to the edge of a bare platform */
  double *gap, *line, *insulator; /* [stations] for the shape */
  void *memory;
} Profiler;

/* -- setting up ------------------------------------------------------------------------------------ */

static void set_right(const ZpActuatorDef *def, double permittivity, ZpPlatesParams *law) {
  law->k = 0.5 * ZP_EPS0 * permittivity * def->ribbon.width;
  law->d = 2 * def->insulator.thickness * permittivity / def->insulator.permittivity;
}

static void find_laws(Profiler *p) {
  const ZpModel *model = p->model;
  p->set = (Law){model->plates, model->air};
  p->free = p->set;
  p->free.liquid.h_per_volt = p->free.air.h_per_volt = 0;
  p->right = p->free;
  set_right(&model->def, model->def.medium.permittivity, &p->right.liquid);
  set_right(&model->def, 1, &p->right.air);
}

static size_t reserve(Profiler *p, void *block) {
  ZpArena arena = {block, 0};
  size_t n = STATIONS;
  p->stations = (ZpStations){.count = n};
  p->stations.x = zp_arena_take(&arena, 2 * n);
  p->stations.y = zp_arena_take(&arena, 2 * n);
  p->gap = zp_arena_take(&arena, n);
  p->line = zp_arena_take(&arena, n);
  p->insulator = zp_arena_take(&arena, n);
  p->row = zp_arena_take_of(&arena, p->field.profiles, sizeof *p->row);
  p->wet = zp_arena_take(&arena, p->field.profiles);
  p->cover.part = zp_arena_take(&arena, n);
  return arena.used;
}

static bool allocate(Profiler *p) {
  p->params = p->model->cross_section;
  p->params.stations = STATIONS;
  p->params.columns = 1;
  if (!zp_field_create(&p->params, &p->field)) return false;
  p->memory = zp_calloc(1, reserve(p, NULL));
  if (!p->memory) return false;
  reserve(p, p->memory);
  const double *x = p->stations.x, *y = p->stations.y;
  p->faces = (ZpContact){x, y, x + 1, y + 1, 2};
  p->last = p->field.last - p->field.first;
  p->rows = p->params.electrode ? p->field.profiles : p->last + 1;
  return true;
}

/* -- the shape ------------------------------------------------------------------------------------- */

/* On the faces of two ribbons at nodes q, or with NULL on the wedge. */
static void lay_stations(Profiler *p, const double *q) {
  const ZpModel *model = p->model;
  if (q)
    zp_contact_smooth(model->nodes, model->is_rod, q, zp_nodes(model, q).y, &p->stations);
  else
    zp_contact_cubic(model->L, model->def.isometric.separation, &p->stations);
}

/* Length of a face from station k to the next, m. */
static double chord(const Profiler *p, size_t k, size_t face) {
  const size_t here = zp_up(k) + face, next = zp_up(k + 1) + face;
  double dx = p->stations.x[next] - p->stations.x[here], dy = p->stations.y[next] - p->stations.y[here];
  return sqrt(dx * dx + dy * dy);
}

static double thickness(const Profiler *p, size_t k) {
  return zp_film_thickness(&p->model->film, zp_apart(p->stations.y, k));
}

/* A bead at rest, eq. (22.16) => the last station that liquid wets, where its meniscus shall be; what of the volume is
 * beyond the flexible part, over the width, m^2. */
static size_t find_meniscus(Profiler *p, double *beyond) {
  double area = p->model->bead.volume / p->model->film.w;
  p->wet_length = *beyond = 0;
  for (size_t k = 0; k + 1 < STATIONS; k++) {
    double l = 0.5 * (chord(p, k, 0) + chord(p, k, 1)), near = thickness(p, k), far = thickness(p, k + 1),
           all = 0.5 * l * (near + far);
    if (area < all) {
      double wet = zp_bead_within(near, far, l, area);
      p->wet_length += wet;
      return zp_contact_move_front(&p->stations, k, wet / l);
    }
    area -= all;
    p->wet_length += l;
  }
  *beyond = area;
  return STATIONS - 1;
}

/* Stations on the faces, one of them at the meniscus of a bead. */
static void lay(Profiler *p, const double *q) {
  const ZpModel *model = p->model;
  size_t front = STATIONS - 1;
  p->cover.flat[0] = p->cover.flat[1] = 1;
  lay_stations(p, q);
  if (model->has_bead) {
    double beyond, flat = model->film.flat_length * thickness(p, STATIONS - 1);
    front = find_meniscus(p, &beyond);
    p->cover.flat[0] = beyond < flat ? beyond / flat : 1;
    lay_stations(p, q);
  }
  for (size_t k = 0; k + 1 < STATIONS; k++)
    p->cover.part[k] = k < front;
  for (size_t k = 0; k + 2 < p->rows; k += 2)
    p->wet[k / 2] = k < p->last ? k < front : p->cover.flat[0];
  if (model->has_bead) zp_field_cover(&p->field, &p->cover);
}

/* The unpowered shape. *found tells whether there is one; false if there is no memory. */
static bool find_shape(Profiler *p, bool *found) {
  const ZpModel *model = p->model;
  *found = model->def.profile.shape != ZP_PROFILE_HELD;
  if (*found) lay(p, NULL);
  if (*found) return true;
  ZpRest rest;
  bool opened = zp_rest_open(&rest, model, NULL, NULL);
  if (opened) {
    ZpNewtonInfo info = zp_statics_hold(&rest.statics, model->def.isometric.separation);
    *found = zp_newton_good(info.end) && !zp_statics_fault(&rest.statics);
    ZpMargins margins;
    zp_rest_shape(&rest, 0, &margins);
    if (*found) p->margins = margins;
    lay(p, rest.statics.member->q);
  }
  zp_rest_close(&rest);
  return opened;
}

/* -- the profile ----------------------------------------------------------------------------------- */

/* The attraction per length at a gap in the two intervals from row k on, an even one, N/m. */
static double within(const Profiler *p, const Law *law, double U, size_t k, double gap) {
  double wet = p->wet[k / 2], W = wet > 0 ? wet * zp_plates_law(&law->liquid, U, gap).W : 0;
  return wet < 1 ? W + (1 - wet) * zp_plates_law(&law->air, U, gap).W : W;
}

/* The intervals that meet at row k begin at rows left and right; the latter has this share of their length. */
typedef struct Beside {
  size_t left, right;
  double share;
} Beside;

static Beside beside(const Profiler *p, size_t k) {
  if (k % 2) return (Beside){k - 1, k - 1, 1};
  if (k == 0 || k + 2 >= p->rows) return (Beside){k > 0 ? k - 2 : 0, k > 0 ? k - 2 : 0, 1};
  const ZpFieldProfile *at = p->field.profile + k;
  return (Beside){k - 2, k, (at[2].x - at[0].x) / (at[2].x - at[-2].x)};
}

/* Attraction per length at row k, the mean of both sides, as the field has it, N/m. */
static double at_row(const Profiler *p, const Law *law, double U, size_t k) {
  double gap = p->field.profile[k].gap;
  Beside of = beside(p, k);
  double left = within(p, law, U, of.left, gap);
  return left + of.share * (within(p, law, U, of.right, gap) - left);
}

/* The gap below which breakdown limits the force in the intervals from row k on, m. */
static double capped_gap(const Profiler *p, size_t k) {
  const ZpPlatesParams *law = p->wet[k / 2] > 0 ? &p->set.liquid : &p->set.air;
  return law->h_per_volt * p->U - law->d;
}

static bool is_wet(const Profiler *p, size_t k) {
  Beside of = beside(p, k);
  return p->wet[of.left / 2] > 0 && p->wet[of.right / 2] > 0;
}

static void fill_row(const Profiler *p, size_t k, double *row) {
  const ZpFieldProfile *at = &p->field.profile[k];
  double U = p->U, mean = 0.5 * (at->upper + at->lower), unit = at_row(p, &p->free, 1, k);
  Beside of = beside(p, k);
  row[X] = at->x;
  row[GAP] = fabs(at->gap) > rounding ? at->gap : 0;
  row[PLATES] = unit * U * U;
  row[FIELD] = mean * U * U;
  row[UPPER] = at->upper * U * U;
  row[LOWER] = at->lower * U * U;
  row[RATIO] = unit > 0 ? mean / unit : (double)NAN;
  row[LIQUID] = at->E * U;
  row[INSULATOR] = at->E_insulator * U;
  bool capped = at->gap < fmax(capped_gap(p, of.left), capped_gap(p, of.right));
  row[CAPPED] = capped;
  row[FORCE] = p->by_field && !capped ? p->model->field_scale * row[FIELD] : at_row(p, &p->set, U, k);
}

/* Simpson's rule over two intervals of this length together: values at their ends and between them. */
static double simpson(double length, double start, double middle, double end) {
  return length / 6 * (start + 4 * middle + end);
}

/* Over rows from .. to, an even number of intervals. */
static double integrate(const Profiler *p, int column, size_t from, size_t to) {
  double sum = 0;
  for (size_t k = from; k + 2 <= to; k += 2) {
    const Row *r = p->row + k;
    sum += simpson(r[2][X] - r[0][X], r[0][column], r[1][column], r[2][column]);
  }
  return sum;
}

static double integrate_law(const Profiler *p, const Law *law, double U, size_t from, size_t to) {
  double sum = 0;
  for (size_t k = from; k + 2 <= to; k += 2) {
    const ZpFieldProfile *at = p->field.profile + k;
    sum += simpson(at[2].x - at[0].x, at_row(p, law, U, k), at_row(p, law, U, k + 1), at_row(p, law, U, k + 2));
  }
  return sum;
}

/* The kink of the cap needs finer steps than the field: this many for two intervals. */
enum { FINER = 64 };

/* Gap at `part` (0 .. 1) of the parabola through three rows. */
static double gap_within(const Row *r, double part) {
  double u = 2 * part - 1;
  return 0.5 * u * (u - 1) * r[0][GAP] + (1 - u * u) * r[1][GAP] + 0.5 * u * (u + 1) * r[2][GAP];
}

/* Mean of the law as set along the parabola through the three rows from k on, N/m. */
static double fine_mean(const Profiler *p, size_t k) {
  double sum = 0;
  for (int i = 0; i < FINER; i += 2) {
    double W[3];
    for (int m = 0; m < 3; m++)
      W[m] = within(p, &p->set, p->U, k, gap_within(p->row + k, (i + m) / (double)FINER));
    sum += simpson(2.0 / FINER, W[0], W[1], W[2]);
  }
  return sum;
}

/* Does the law have a kink in the intervals from row k on, or a jump at an end of them? */
static bool is_rough(const Profiler *p, size_t k) {
  const Row *r = p->row + k;
  Beside from = beside(p, k), to = beside(p, k + 2);
  return r[0][CAPPED] + r[1][CAPPED] + r[2][CAPPED] > 0 || p->wet[from.left / 2] != p->wet[to.right / 2];
}

/* Integral of FORCE over rows from .. to. Where it is rough: the integral of the law in fine steps, plus that of the
 * difference of the model from the law, which is smooth. */
static double limited_force(const Profiler *p, size_t from, size_t to) {
  double sum = integrate(p, FORCE, from, to);
  for (size_t k = from; k + 2 <= to; k += 2) {
    const Row *r = p->row + k;
    if (is_rough(p, k)) sum += (r[2][X] - r[0][X]) * fine_mean(p, k) - integrate_law(p, &p->set, p->U, k, k + 2);
  }
  return sum;
}

/* Length of the flexible part where breakdown limits the force; gaps are straight within a fine step. */
static double capped_length(const Profiler *p) {
  double length = 0;
  for (size_t k = 0; k + 2 <= p->last; k += 2) {
    const Row *r = p->row + k;
    double step = (r[2][X] - r[0][X]) / FINER, limit = capped_gap(p, k);
    for (int i = 0; i < FINER; i++) {
      double a = gap_within(r, (double)i / FINER) - limit, b = gap_within(r, (i + 1.0) / FINER) - limit;
      double low = fmin(a, b), high = fmax(a, b);
      length += high < 0 ? step : low < 0 ? step * low / (low - high) : 0;
    }
  }
  return length;
}

/* -- results --------------------------------------------------------------------------------------- */

static void record(Profiler *p) {
  for (size_t k = 0; k < p->rows; k++)
    zp_table_offer(p->result->series, p->row[k]);
  for (size_t k = 0; k < STATIONS; k++) {
    p->gap[k] = p->row[k][GAP];
    p->line[k] = p->row[k][FORCE];
    p->insulator[k] = p->row[k][INSULATOR];
  }
  ZpShape shape = {.time = 0,
                   .voltage = p->U,
                   .x = p->stations.x,
                   .y = p->stations.y,
                   .gap = p->gap,
                   .line_force = p->line,
                   .insulator_field = p->insulator};
  zp_shapes_offer(p->result->shapes, &shape);
}

/* Total force on one ribbon by virtual work over that by traction, less 1; of 1 V. */
static double difference(const Profiler *p) {
  const ZpFieldTotals *t = &p->totals;
  double traction = t->upper + t->lower;
  if (p->params.electrode) traction += t->upper_platform + t->lower_platform;
  return (t->upper_work + t->lower_work) / traction - 1;
}

/* Total force on the flexible part, field over a plates law without cap; the voltage cancels. */
static double field_over(const Profiler *p, const Law *law) {
  double plates = integrate_law(p, law, 1, 0, p->last);
  return plates > 0 ? 0.5 * (p->totals.upper + p->totals.lower) / plates : (double)NAN;
}

static void summarize(const Profiler *p) {
  ZpResult *r = p->result;
  const ZpFieldTotals *t = &p->totals;
  size_t end = p->rows - 1;
  double most = 0; /* in liquid */
  for (size_t k = 0; k < p->rows; k++)
    if (is_wet(p, k)) most = fmax(most, p->row[k][LIQUID]);
  double U2 = p->U * p->U, plates = integrate(p, PLATES, 0, p->last), field = integrate(p, FIELD, 0, p->last);
  zp_result_add(r, "force_N", "N", limited_force(p, 0, p->last));
  zp_result_add(r, "platform_force_N", "N", limited_force(p, p->last, end));
  zp_result_add(r, "force_uncapped_N", "N", p->by_field ? p->model->field_scale * field : plates);
  zp_result_add(r, "plates_force_N", "N", plates);
  zp_result_add(r, "field_force_N", "N", field);
  zp_result_add(r, "virtual_work_force_N", "N", 0.5 * (t->upper_work + t->lower_work) * U2);
  zp_result_add(r, "virtual_work_difference", "1", difference(p));
  zp_result_add(r, "scale_factor", "1", field_over(p, &p->free));
  zp_result_add(r, "max_field_V_per_m", "V/m", most);
  zp_result_add(r, "capped_length_m", "m", capped_length(p));
  if (p->model->has_bead) zp_result_add(r, "wet_length_m", "m", p->wet_length);
  zp_result_add(r, "capacitance_F", "F", 2 * p->model->parts * p->field.energy);
  zp_result_add(r, "equations", "count", (double)p->field.grid.K.n);
}

/* -- the factor of the paper ------------------------------------------------------------------------ */

/* Letters of docs/theory.md, section 15:
 *   E_t   field in the tape at the metal, V/m       g   gap of the faces, m
 *   d     liquid thickness that stands for both tapes, m
 * Everything at 1 V, over the flexible part of one ribbon. */

/* Permittivities in the authors' programs, of liquid and tape: in the finite-element model, in the plates law, and of
 * the tape in the expression for the finite-element force. */
static const double fe_liquid = 2.7, fe_tape = 4.6, law_liquid = 2.75, law_tape = 4.62, expression_tape = 4.65;

/* Share of the voltage in their law. */
static const double share = 0.5;

/* E_t^2 at xi of element column c, mean of both ribbons. */
static double tape_field(const ZpField *f, size_t c, double xi) {
  const ZpFieldMesh *m = &f->params.mesh;
  size_t lower = m->outside + m->strip, upper = f->grid.rows - lower - 1;
  double E[2], sum = 0;
  zp_grid_gradient(&f->grid, c, lower, xi, -1, E);
  sum += E[0] * E[0] + E[1] * E[1];
  zp_grid_gradient(&f->grid, c, upper, xi, 1, E);
  sum += E[0] * E[0] + E[1] * E[1];
  return 0.5 * sum;
}

/* Their finite-element force: eps0 eps w E_t^2 without 1/2, by Simpson's rule. */
static double reading(const ZpField *f) {
  double sum = 0;
  for (size_t i = f->first; i + 2 <= f->last; i += 2) {
    const ZpFieldProfile *p = f->profile + (i - f->first);
    sum += (p[2].x - p[0].x) / 6 * (tape_field(f, i / 2, -1) + 4 * tape_field(f, i / 2, 0) + tape_field(f, i / 2, 1));
  }
  return ZP_EPS0 * expression_tape * f->params.w * sum;
}

static double paper_law_at(const ZpField *f, double d, double g) {
  return 0.5 * ZP_EPS0 * law_liquid * f->params.w / ((g + d) * (g + d));
}

/* Force by their plates law with this d, without their share. */
static double paper_law(const ZpField *f, double d) {
  double sum = 0;
  for (size_t i = f->first; i + 2 <= f->last; i += 2) {
    const ZpFieldProfile *p = f->profile + (i - f->first);
    sum += (p[2].x - p[0].x) / 6 *
           (paper_law_at(f, d, p[0].gap) + 4 * paper_law_at(f, d, p[1].gap) + paper_law_at(f, d, p[2].gap));
  }
  return sum;
}

/* Add the factor that the paper found between its finite-element force and its plates law, found again the way its
 * authors found it, and the four causes that it is the product of. All are NAN where the field with the materials of
 * their model has no solution. */
static ZpStatus keep_the_papers_books(const Profiler *p, ZpError *err) {
  ZpField field;
  ZpFieldParams theirs = p->params;
  ZpResult *r = p->result;
  theirs.eps_m = theirs.eps_out = fe_liquid;
  theirs.eps_i = fe_tape;
  if (!zp_field_create(&theirs, &field)) return zp_fail_memory(err);
  double none = zp_field_solve(&field, &p->faces) == ZP_FIELD_SOLVED ? 1 : NAN, tape = NAN, gap = NAN;
  if (!isnan(none)) {
    double t = theirs.t, right = 2 * t * fe_liquid / fe_tape, slipped = 2 * t - t * law_liquid / law_tape;
    zp_field_profile(&field);
    tape = 0.5 * reading(&field) / paper_law(&field, right);
    gap = paper_law(&field, right) / paper_law(&field, slipped);
  }
  zp_field_destroy(&field);
  double voltage = none / (share * share), half = none * 2;
  zp_result_add(r, "paper_factor", "1", voltage * half * tape * gap);
  zp_result_add(r, "paper_factor_voltage", "1", voltage); /* their law takes half of the voltage */
  zp_result_add(r, "paper_factor_half", "1", half);       /* their finite-element force lacks the 1/2 */
  zp_result_add(r, "paper_factor_tape", "1", tape);       /* it reads the field in the tape, not in the liquid */
  zp_result_add(r, "paper_factor_gap", "1", gap);         /* their law's gap is too wide: a sign in it slipped */
  return ZP_OK;
}

static void note(const Profiler *p) {
  double off = difference(p), local = field_over(p, &p->right) - 1;
  zp_add_margins(p->result, p->model, &p->margins);
  if (p->model->def.profile.shape == ZP_PROFILE_HELD) zp_note_mesh(p->result, p->model, 0);
  if (fabs(local) > valid)
    zp_result_note(
        p->result,
        "the force of the field is %.3g times that of the plates law: the faces are too steep or too far apart for "
        "that law",
        1 + local);
  if (fabs(off) > agreement)
    zp_result_note(
        p->result,
        "forces by traction and by virtual work differ by %.2g %%: the wedge is too steep, or its bead too short, for "
        "the field's grid",
        100 * fabs(off));
}

/* -- the map --------------------------------------------------------------------------------------- */

/* Nodes of the grid that the map shows: not what is far away. */
typedef struct Window {
  size_t left, right, bottom, top; /* ends included */
} Window;

static Window window_of(const Profiler *p) {
  const ZpGrid *g = &p->field.grid;
  const double *y = g->y + p->field.first * g->ny, opening = p->model->def.isometric.separation;
  double margin = fmax(0.25 * p->model->L, 0.65 * opening) + p->params.t + p->params.b;
  double middle = y[g->ny / 2], edge = -p->params.clip - margin;
  Window w = {0, g->nx - 1, 0, g->ny - 1};
  while (w.left + 1 < p->field.first && g->x[(w.left + 1) * g->ny + g->ny / 2] < edge)
    w.left++;
  while (y[w.bottom + 1] < middle - margin)
    w.bottom++;
  while (y[w.top - 1] > middle + margin)
    w.top--;
  return w;
}

static void fill_cell(const Profiler *p, size_t i, size_t j, double *strength, double *permittivity) {
  const ZpGrid *g = &p->field.grid;
  double E[2] = {0, 0};
  *permittivity = g->eps[i / 2 * g->rows + j / 2];
  if (*permittivity > 0) zp_grid_gradient(g, i / 2, j / 2, i % 2 ? 0.5 : -0.5, j % 2 ? 0.5 : -0.5, E);
  *strength = p->U * sqrt(E[0] * E[0] + E[1] * E[1]);
}

static bool make_map(const Profiler *p) {
  const ZpGrid *g = &p->field.grid;
  Window w = window_of(p);
  size_t nx = w.right - w.left + 1, ny = w.top - w.bottom + 1;
  ZpFieldMap *map = p->result->map = zp_field_map_create(nx, ny);
  if (!map) return false;
  zp_field_surfaces(&p->field, map->surface);
  for (size_t k = 0; k < 6; k++)
    map->surface[k] -= w.bottom;
  for (size_t i = 0; i < nx; i++)
    for (size_t j = 0; j < ny; j++) {
      size_t from = (w.left + i) * g->ny + w.bottom + j, cell = i * (ny - 1) + j;
      map->x[i * ny + j] = g->x[from];
      map->y[i * ny + j] = g->y[from];
      map->potential[i * ny + j] = p->U * g->phi[from];
      if (i + 1 < nx && j + 1 < ny)
        fill_cell(p, w.left + i, w.bottom + j, &map->strength[cell], &map->permittivity[cell]);
    }
  return true;
}

/* -- the study ------------------------------------------------------------------------------------- */

/* => how the field ended; once solved, profile and totals. */
static ZpFieldEnd solve(Profiler *p) {
  ZpFieldEnd end = zp_field_check(&p->params, &p->faces);
  if (end == ZP_FIELD_SOLVED) end = zp_field_solve(&p->field, &p->faces);
  if (end != ZP_FIELD_SOLVED) return end;
  zp_field_profile(&p->field);
  p->totals = zp_field_totals(&p->field);
  for (size_t k = 0; k < p->rows; k++)
    fill_row(p, k, p->row[k]);
  return end;
}

static ZpStatus report(Profiler *p, ZpError *err) {
  ZpResult *r = p->result;
  record(p);
  summarize(p);
  for (size_t k = 0; k < p->rows; k++) {
    double liquid = is_wet(p, k) ? p->row[k][LIQUID] : NAN;
    zp_margins_join(&p->margins, (ZpMargins){p->row[k][INSULATOR], p->row[k][X], p->model->series.withstands, liquid,
                                             NAN, NAN, NAN});
  }
  note(p);
  r->outcome = ZP_CONVERGED;
  snprintf(r->message, sizeof r->message,
           "%g V attract a ribbon of one half with %.4g N; by the field without cap %.4g N", p->U,
           zp_result_get(r, "force_N"), zp_result_get(r, "field_force_N"));
  if (!make_map(p)) return zp_fail_memory(err);
  return p->model->def.profile.paper_factor ? keep_the_papers_books(p, err) : ZP_OK;
}

/* A shape that the mechanics found but that the grid cannot follow is not wrong input. */
static ZpStatus end_badly(const Profiler *p, ZpOutcome outcome, const char *why) {
  p->result->outcome = outcome;
  snprintf(p->result->message, sizeof p->result->message, "%s at isometric.separation = %g m", why,
           p->model->def.isometric.separation);
  return ZP_OK;
}

static ZpStatus run(Profiler *p, ZpError *err) {
  ZpResult *r = p->result;
  bool found = false;
  if (!allocate(p)) return zp_fail_memory(err);
  r->series = zp_table_create(columns, COLUMNS, p->rows + 1);
  r->shapes = zp_shapes_create(2, STATIONS, 2);
  if (!r->series || !r->shapes || !find_shape(p, &found)) return zp_fail_memory(err);
  find_laws(p);
  if (!found) return end_badly(p, ZP_NOT_SETTLED, "no equilibrium without voltage found");
  ZpFieldEnd end = solve(p);
  return end == ZP_FIELD_SOLVED
             ? report(p, err)
             : end_badly(p, end == ZP_FIELD_FOLDED ? ZP_BEYOND_MODEL : ZP_DIVERGED, zp_field_words(end));
}

static const ZpRule rule[] = {

    ZP_RULE(NOT_MODELLED, ZP_ANY, ZP_IS(electro.edges, false),
            "it compares forces in the plane of the ribbons, without lateral edges; the other studies "
            "can include them"),
    ZP_RULE(PHYSICS, ZP_ANY, ZP_HAS(PLATFORM), "its profile runs from a clip to a platform"),
    ZP_RULE(PHYSICS, ZP_ANY, ZP_LACKS(RIGID), "its profile begins at a clip"),
    ZP_RULE(NOT_MODELLED, ZP_ANY, ZP_IS(actuator.symmetry, ZP_SYMMETRY_HALF), "its grid covers one half"),
    ZP_RULES_EQUAL_RIBBONS(NOT_MODELLED, ZP_ANY, "its grid covers one half of the gap, whose middle plane is a mirror"),
    ZP_RULE(
        EQUATION, ZP_ANY, ZP_AT_LEAST(insulator.thickness, 1e-6),
        "the field at the clip is infinite without an insulator, and its grid keeps closed faces a nanometre apart"),
    ZP_RULE(PHYSICS, ZP_ANY, ZP_NOT(electro.insulator_offset, 0),
            "the plates law, which it compares with the field, is infinite at the clip"),
    ZP_RULE_STARTS,
};
const ZpRules zp_rules_profile = ZP_RULES_OF(rule);

/* May the first member stand for all? */
static bool members_are_alike(const ZpActuatorDef *def) {
  const ZpActuatorDef first = zp_def_member(def, 1);
  bool alike = true;
  for (int k = 2; k <= zp_def_members(def) && alike; k++) {
    const ZpActuatorDef other = zp_def_member(def, k);
    alike = zp_def_alike(&first, &other);
  }
  return alike;
}

/* The actuator alone whose force is computed. As in study isometric, the load does not count. The lower platform is
 * held level, so one half is modelled even if a body would turn it. */
static ZpActuatorDef profiled(const ZpActuatorDef *def) {
  const bool several = zp_def_network(def) || zp_def_members(def) > 1;
  const int member = def->profile.member > 0 ? def->profile.member : 1;
  const ZpActuatorDef one = several ? zp_def_member(def, member) : *def;
  ZpActuatorDef bare = zp_def_unloaded(&one);
  bare.profile.member = 0;
  if (zp_def_plane(def)) bare.actuator.symmetry = ZP_SYMMETRY_HALF;
  if (zp_def_plane(def)) bare.platform.rotates = false;
  return bare;
}

static ZpStatus check_profiled(const ZpActuatorDef *one, ZpError *err) {
  ZpStatus status = zp_rule_fail(zp_rules_find(&zp_rules_profile, false, one), "study profile ", one, err);
  if (status != ZP_OK || one->profile.shape != ZP_PROFILE_HELD) return status;
  return zp_check_held(one, err);
}

ZpStatus zp_check_profile(const ZpActuatorDef *def, ZpError *err) {
  const int member = def->profile.member, members = zp_def_members(def);
  char name[ZP_NAME_SIZE];
  if (member > members)
    return zp_fail(err, ZP_BAD_INPUT, "profile.member = %s: there is no such member",
                   zp_def_name(def, ZP_OF_MEMBER, member, name));
  if (member == 0 && members > 1 && !members_are_alike(def))
    return zp_fail(err, ZP_BAD_INPUT,
                   "profile.member: missing; members differ, so name the one whose force is computed, such as %s",
                   zp_def_name(def, ZP_OF_MEMBER, 1, name));
  const ZpActuatorDef one = profiled(def);
  ZpError reason;
  ZpStatus status = check_profiled(&one, &reason);
  if (status == ZP_OK) return ZP_OK;
  if (!zp_def_network(def) && members == 1) return zp_fail(err, status, "%s", reason.message);
  return zp_fail_member(def, member > 0 ? member : 1, status, &reason, err);
}

/* The model is that of plates: the shape has no voltage, and the field is solved here. */
ZpStatus zp_study_profile(const ZpTask *task, ZpResult *result, ZpError *err) {
  ZpActuatorDef bare = profiled(task->def);
  bare.electro.model = ZP_ELECTRO_PLATES;
  ZpModel *model;
  ZpStatus status = zp_model_create(&bare, &model, err);
  if (status != ZP_OK) return status;
  Profiler p = {.model = model,
                .result = result,
                .U = bare.drive.voltage,
                .by_field = task->def->electro.model == ZP_ELECTRO_FIELD,
                .margins = zp_margins_none()};
  status = run(&p, err);
  zp_note_no_sensitivity(result, task->def);
  zp_free(p.memory);
  zp_field_destroy(&p.field);
  zp_model_destroy(model);
  return status;
}
