/* The grid of a cross-section and what is read off it. From below to above each column of nodes crosses eight
 * surfaces with seven layers between them:
 *
 *   0 far below | outside | 1 strip's outer face | metal | 2 inner face | insulator | 3 insulator's face | gap |
 *   4 insulator's face | insulator | 5 inner face | metal | 6 outer face | outside | 7 far above
 *
 * All follow the faces: insulator and metal are as thick along y as they are, and a column stands upright but for
 * what the faces of a station differ in x.
 */
#include "electro/field.h"

#include <math.h>
#include <string.h>

#include "electro/plates.h"

enum { SURFACES = 8, LAYERS = 7, LOWER_METAL = 1, LOWER_INSULATOR = 2, GAP = 3, UPPER_INSULATOR = 4, UPPER_METAL = 5 };

/* The grid ends this far away, m. There a dipole's field is 1e-8 of the one at 1e-4 of the distance. */
static double far_of(const ZpFieldMesh *mesh) {
  return 10 * mesh->size;
}

struct ZpFieldColumn {
  size_t station; /* the face lies at (1 - share) of this station and share of the next, */
  double share;
  double offset;   /* and this much to the right, m */
  bool electrodes; /* are there insulated electrodes? */
};

struct ZpFieldRow {
  size_t layer;
  double share; /* 0 on the lower surface of the layer, 1 on the upper */
};

const char *zp_field_words(ZpFieldEnd end) {
  static const char *const words[] = {
      "solved", "the faces pass through each other", "the faces touch without an insulator between the metals",
      "a ribbon folds back or bends too sharply for its thickness", "the solution is not finite"};
  return words[end];
}

/* -- rows and columns ----------------------------------------------------------------------------- */

/* n elements of sizes 1, growth, growth^2, ... scaled to fill [0, 1]: the place of their node k of 0 .. 2 n. */
static double graded(size_t k, size_t n, double growth) {
  double at = 0, sum = 0, size = 1;
  for (size_t e = 0; e < n; e++, size *= growth) {
    if (k == 2 * e + 1) at = sum + 0.5 * size;
    sum += size;
    if (k == 2 * e + 2) at = sum;
  }
  return at / sum;
}

/* The growth with which n elements, the first of this size, fill a length. */
static double growth_to_fill(double first, double length, size_t n) {
  double low = 1, high = 1e3;
  if (first * (double)n >= length) return 1;
  for (int k = 0; k < 100; k++) {
    double growth = 0.5 * (low + high), sum = 0;
    for (size_t e = 0; e < n; e++)
      sum = sum * growth + first;
    if (sum < length)
      low = growth;
    else
      high = growth;
  }
  return low;
}

static size_t rows_of(const ZpFieldParams *p) {
  const ZpFieldMesh *m = &p->mesh;
  return 2 * (m->outside + m->strip + (p->t > 0 ? m->insulator : 0)) + m->gap;
}

static size_t columns_of(const ZpFieldParams *p) {
  const ZpFieldMesh *m = &p->mesh;
  return m->outside + m->clip + (p->stations - 1) * p->columns / 2 + (p->platform > 0 ? m->platform : 0);
}

/* One layer of n elements: node rows after the first, which belongs to the layer below. */
static size_t lay_rows(ZpFieldRow *row, size_t j, size_t layer, size_t n, double growth, bool from_above) {
  for (size_t k = 1; k <= 2 * n; k++)
    row[j++] = (ZpFieldRow){layer, from_above ? 1 - graded(2 * n - k, n, growth) : graded(k, n, growth)};
  return j;
}

static void make_rows(ZpField *f) {
  const ZpFieldParams *p = &f->params;
  const ZpFieldMesh *m = &p->mesh;
  double outside = growth_to_fill(m->first, far_of(m), m->outside);
  size_t j = 1, insulator = p->t > 0 ? m->insulator : 0;
  f->row[0] = (ZpFieldRow){0, 0};
  j = lay_rows(f->row, j, 0, m->outside, outside, true);
  j = lay_rows(f->row, j, LOWER_METAL, m->strip, 1, false);
  j = lay_rows(f->row, j, LOWER_INSULATOR, insulator, 1, false);
  j = lay_rows(f->row, j, GAP, m->gap, 1, false);
  j = lay_rows(f->row, j, UPPER_INSULATOR, insulator, 1, false);
  j = lay_rows(f->row, j, UPPER_METAL, m->strip, 1, false);
  lay_rows(f->row, j, UPPER_METAL + 1, m->outside, outside, false);
}

void zp_field_surfaces(const ZpField *f, size_t row[6]) {
  const ZpFieldMesh *m = &f->params.mesh;
  const size_t insulator = f->params.t > 0 ? m->insulator : 0;
  const size_t elements[6] = {m->outside, m->strip, insulator, m->gap, insulator, m->strip};
  size_t j = 0;
  for (size_t k = 0; k < 6; k++)
    row[k] = j += 2 * elements[k];
}

static void make_columns(ZpField *f) {
  const ZpFieldParams *p = &f->params;
  const ZpFieldMesh *m = &p->mesh;
  size_t i = 0, last = p->stations - 1;
  double outside = growth_to_fill(m->first, far_of(m), m->outside), clip = growth_to_fill(m->first, p->clip, m->clip);
  for (size_t k = 2 * m->outside; k > 0; k--)
    f->column[i++] = (ZpFieldColumn){0, 0, -p->clip - far_of(m) * graded(k, m->outside, outside), false};
  for (size_t k = 0; k < 2 * m->clip; k++)
    f->column[i++] = (ZpFieldColumn){0, 0, -p->clip * (1 - graded(k, m->clip, clip)), true};
  f->first = i;
  for (size_t k = 0; k <= last * p->columns; k++) {
    size_t station = k / p->columns == last ? last - 1 : k / p->columns;
    f->column[i++] = (ZpFieldColumn){station, (double)(k - station * p->columns) / (double)p->columns, 0, true};
  }
  f->last = i - 1;
  for (size_t k = 1; p->platform > 0 && k <= 2 * m->platform; k++)
    f->column[i++] = (ZpFieldColumn){last - 1, 1, p->platform * (double)k / (double)(2 * m->platform), p->electrode};
}

static bool between_electrodes(const ZpField *f, size_t c) {
  return f->column[2 * c].electrodes && f->column[2 * c + 2].electrodes;
}

/* Is row r of elements in the slab? It has the middle third of those of the gap. */
static bool in_slab(const ZpField *f, size_t r) {
  const ZpFieldRow *middle = &f->row[2 * r + 1];
  return f->params.slab > 0 && middle->layer == GAP && middle->share > 1.0 / 3 && middle->share < 2.0 / 3;
}

/* Where a row of the gap lies between faces that are so far apart, 0 to 1. */
static double share_of_gap(const ZpField *f, double share, double apart) {
  if (f->params.slab == 0) return share;
  const double liquid = 0.5 * (1 - f->params.slab / apart), of_third = 3 * share;
  if (of_third < 1) return of_third * liquid;
  return of_third > 2 ? 1 - (3 - of_third) * liquid : liquid + (of_third - 1) * (1 - 2 * liquid);
}

static double permittivity(const ZpField *f, size_t c, size_t r) {
  size_t layer = f->row[2 * r + 1].layer;
  if (in_slab(f, r)) return f->params.eps_slab;
  bool metal = layer == LOWER_METAL || layer == UPPER_METAL;
  bool insulator = layer == LOWER_INSULATOR || layer == UPPER_INSULATOR;
  if (!between_electrodes(f, c)) return f->params.eps_out;
  return metal ? 0 : insulator ? f->params.eps_i : layer == GAP ? f->params.eps_m : f->params.eps_out;
}

static void fill_materials(ZpField *f) {
  ZpGrid *g = &f->grid;
  for (size_t c = 0; c < g->columns; c++)
    for (size_t r = 0; r < g->rows; r++)
      g->eps[c * g->rows + r] = permittivity(f, c, r);
}

/* Is the gap of element column c wet, with liquid over more than half of the length between its stations? */
static bool is_wet(const ZpField *f, const ZpCover *cover, size_t c) {
  const ZpFieldColumn *from = &f->column[2 * c], *to = &f->column[2 * c + 2];
  if (2 * c < f->first) return true;
  if (2 * c >= f->last) return cover->flat[0] > 0.5;
  double start = (double)from->station + from->share, end = (double)to->station + to->share, wet = 0;
  for (size_t k = from->station; (double)k < end; k++) {
    double reach = (double)k + zp_cover_part(cover, k);
    wet += fmax(fmin(reach, end) - fmax((double)k, start), 0);
  }
  return wet > 0.5 * (end - start);
}

void zp_field_cover(ZpField *f, const ZpCover *cover) {
  ZpGrid *g = &f->grid;
  for (size_t c = 0; c < g->columns; c++) {
    if (!between_electrodes(f, c)) continue;
    double eps = is_wet(f, cover, c) ? f->params.eps_m : f->params.eps_out;
    for (size_t r = 0; r < g->rows; r++)
      if (f->row[2 * r + 1].layer == GAP) g->eps[c * g->rows + r] = eps;
  }
}

/* Half a volt on each metal, surfaces included; the rest is overwritten by the solution. */
static void fill_potentials(ZpField *f) {
  ZpGrid *g = &f->grid;
  for (size_t i = 0; i < g->nx; i++)
    for (size_t j = 0; j < g->ny; j++)
      g->phi[i * g->ny + j] = 2 * j < g->ny ? -0.5 : 0.5;
}

static size_t reserve(ZpField *f, void *block) {
  ZpArena arena = {block, 0};
  size_t nx = 2 * columns_of(&f->params) + 1, ny = 2 * rows_of(&f->params) + 1, pairs = 2 * f->params.stations;
  f->column = zp_arena_take_of(&arena, nx, sizeof *f->column);
  f->row = zp_arena_take_of(&arena, ny, sizeof *f->row);
  f->profile = zp_arena_take_of(&arena, nx, sizeof *f->profile);
  double **arrays[] = {&f->Fx, &f->Fy};
  for (size_t k = 0; k < sizeof arrays / sizeof arrays[0]; k++)
    *arrays[k] = zp_arena_take(&arena, pairs);
  return arena.used;
}

bool zp_field_create(const ZpFieldParams *params, ZpField *f) {
  memset(f, 0, sizeof *f);
  f->params = *params;
  f->memory = zp_calloc(1, reserve(f, NULL));
  if (!f->memory || !zp_grid_create(&f->grid, columns_of(params), rows_of(params))) {
    zp_field_destroy(f);
    return false;
  }
  reserve(f, f->memory);
  make_rows(f);
  make_columns(f);
  f->profiles = f->grid.nx - f->first;
  fill_materials(f);
  fill_potentials(f);
  if (zp_grid_number(&f->grid)) return true;
  zp_field_destroy(f);
  return false;
}

void zp_field_destroy(ZpField *f) {
  zp_grid_destroy(&f->grid);
  zp_free(f->memory);
  f->memory = NULL;
}

/* -- shape ---------------------------------------------------------------------------------------- */

ZpFieldEnd zp_field_check(const ZpFieldParams *p, const ZpContact *faces) {
  const double overlap = 1e-6 * p->mesh.size; /* m: contact in equilibrium overlaps faces less than that */
  ZpFieldEnd end = ZP_FIELD_SOLVED;
  for (size_t i = 0; i < p->stations; i++) {
    size_t k = i * faces->step;
    double gap = faces->upper_y[k] - faces->lower_y[k];
    if (!(gap > -overlap)) return ZP_FIELD_CROSSING;
    if (gap <= zp_field_least_gap(&p->mesh) && p->t == 0) end = ZP_FIELD_BARE;
    if (i == 0) continue;
    double upper = faces->upper_x[k] - faces->upper_x[k - faces->step],
           lower = faces->lower_x[k] - faces->lower_x[k - faces->step];
    if (!(upper > 0 && lower > 0) && end == ZP_FIELD_SOLVED) end = ZP_FIELD_FOLDED;
  }
  return end;
}

static double mix(double share, double a, double b) {
  return (1 - share) * a + share * b;
}

typedef struct Point {
  double x, y;
} Point;

/* The face of ribbon r (0: upper) on a column. */
static Point face_at(const ZpContact *faces, const ZpFieldColumn *c, size_t r) {
  const double *x = r ? faces->lower_x : faces->upper_x, *y = r ? faces->lower_y : faces->upper_y;
  size_t at = c->station * faces->step, to = at + faces->step;
  return (Point){mix(c->share, x[at], x[to]) + c->offset, mix(c->share, y[at], y[to])};
}

/* The eight points at which a column crosses the surfaces. Faces that overlap are put on each other. */
static void cross(const ZpField *f, Point upper, Point lower, Point at[SURFACES]) {
  double t = f->params.t, outer = t + f->params.b, far = far_of(&f->params.mesh);
  double apart = fmax(upper.y - lower.y, zp_field_least_gap(&f->params.mesh)), middle = 0.5 * (upper.y + lower.y);
  double low = middle - 0.5 * apart, high = middle + 0.5 * apart;
  const double height[SURFACES] = {-far, low - outer, low - t, low, high, high + t, high + outer, far};
  for (size_t s = 0; s < SURFACES; s++)
    at[s] = (Point){s < SURFACES / 2 ? lower.x : upper.x, height[s]};
}

static void place_nodes(ZpField *f, const ZpContact *faces) {
  ZpGrid *g = &f->grid;
  Point at[SURFACES];
  for (size_t i = 0; i < g->nx; i++) {
    cross(f, face_at(faces, &f->column[i], 0), face_at(faces, &f->column[i], 1), at);
    for (size_t j = 0; j < g->ny; j++) {
      Point below = at[f->row[j].layer], above = at[f->row[j].layer + 1];
      double share = f->row[j].layer == GAP ? share_of_gap(f, f->row[j].share, above.y - below.y) : f->row[j].share;
      g->x[i * g->ny + j] = mix(share, below.x, above.x);
      g->y[i * g->ny + j] = mix(share, below.y, above.y);
    }
  }
}

/* -- forces on the stations: the chain of place_nodes backwards ----------------------------------- */

/* Share of the motion of ribbon r's faces with which row j moves along x and y: partial in the gap, far away along x
 * only. */
static Point follows(const ZpFieldRow *row, size_t r) {
  double above = row->share, below = 1 - row->share;
  if (row->layer == GAP) return r ? (Point){below, below} : (Point){above, above};
  if ((row->layer < GAP) != (r == 1)) return (Point){0, 0};
  return (Point){1, row->layer == 0 ? above : row->layer == LAYERS - 1 ? below : 1};
}

/* Force on ribbon r from the nodes of column i, N. */
static Point column_force(const ZpField *f, size_t i, size_t r) {
  const ZpGrid *g = &f->grid;
  Point F = {0, 0};
  for (size_t j = 0; j < g->ny; j++) {
    Point part = follows(&f->row[j], r);
    F.x += part.x * g->Fx[i * g->ny + j];
    F.y += part.y * g->Fy[i * g->ny + j];
  }
  return (Point){F.x * f->params.w, F.y * f->params.w};
}

/* The clip holds both ribbons: a force on either acts equally on both. */
static void hand_on_clip(ZpField *f, Point upper, Point lower) {
  for (size_t r = 0; r < 2; r++) {
    f->Fx[r] += 0.5 * (upper.x + lower.x);
    f->Fy[r] += 0.5 * (upper.y + lower.y);
  }
}

static void hand_on(ZpField *f, const ZpFieldColumn *c, size_t r, Point F) {
  size_t k = 2 * c->station + r;
  f->Fx[k] += (1 - c->share) * F.x;
  f->Fy[k] += (1 - c->share) * F.y;
  f->Fx[k + 2] += c->share * F.x;
  f->Fy[k + 2] += c->share * F.y;
}

/* Elements left of the first station belong to the clip, all others to the ribbons. */
static void find_forces(ZpField *f) {
  size_t pairs = 2 * f->params.stations, clip = f->first / 2;
  memset(f->Fx, 0, pairs * sizeof *f->Fx);
  memset(f->Fy, 0, pairs * sizeof *f->Fy);
  zp_grid_forces(&f->grid, 0, clip);
  for (size_t i = 0; i <= f->first; i++)
    hand_on_clip(f, column_force(f, i, 0), column_force(f, i, 1));
  zp_grid_forces(&f->grid, clip, f->grid.columns);
  for (size_t i = f->first; i < f->grid.nx; i++)
    for (size_t r = 0; r < 2; r++)
      hand_on(f, &f->column[i], r, column_force(f, i, r));
}

/* Less the energy of the clip's closed part by the plates law. */
static void find_energy(ZpField *f) {
  const ZpFieldParams *p = &f->params;
  double h = 2 * p->t * p->eps_m / p->eps_i + zp_field_least_gap(&p->mesh);
  f->energy = p->w * (zp_grid_energy(&f->grid) - 0.5 * ZP_EPS0 * p->eps_m * p->clip / h);
}

ZpFieldEnd zp_field_solve(ZpField *f, const ZpContact *faces) {
  place_nodes(f, faces);
  ZpGridEnd end = zp_grid_solve(&f->grid);
  if (end == ZP_GRID_FOLDED) return ZP_FIELD_FOLDED;
  if (end == ZP_GRID_SINGULAR) return ZP_FIELD_SINGULAR;
  find_forces(f);
  find_energy(f);
  return ZP_FIELD_SOLVED;
}

/* -- traction ------------------------------------------------------------------------------------- */

/* One surface of a ribbon: the row of elements from which its field is read, their side (eta), the row of elements of
 * liquid or air beside it, and where the ribbon's outward normal points. */
typedef struct Side {
  size_t row;
  double eta;
  size_t beside;
  double out;
} Side;

/* Vertical traction per x-length beside a side of element column c at xi, and the field there.
 * The normal part of the field is read on the inner side of an insulator, where it hardly varies. */
static void traction(const ZpField *f, const Side *side, size_t c, double xi, double *W, double *E_out, double *E_in) {
  const ZpGrid *g = &f->grid;
  double E[2], inside = g->eps[c * g->rows + side->row], eps_m = g->eps[c * g->rows + side->beside];
  zp_grid_gradient(g, c, side->row, xi, side->eta, E);
  size_t j = 2 * side->row + (side->eta > 0 ? 2 : 0), at = 2 * c * g->ny + j;
  double h[3] = {xi - 0.5, -2 * xi, xi + 0.5}, tx = 0, ty = 0;
  for (size_t p = 0; p < 3; p++) {
    tx += h[p] * g->x[at + p * g->ny];
    ty += h[p] * g->y[at + p * g->ny];
  }
  double s = sqrt(tx * tx + ty * ty), nx = -ty / s, ny = tx / s;
  double En = (E[0] * nx + E[1] * ny), Et = (E[0] * ny - E[1] * nx), outside = En * inside / eps_m;
  /* T n = eps (En E - E^2 n / 2), of the liquid or air; over x: times ds/dx = 1 / ny */
  double Ey = outside * ny - Et * nx;
  *W = side->out * ZP_EPS0 * eps_m * (outside * Ey - 0.5 * (outside * outside + Et * Et) * ny) / ny;
  *E_out = sqrt(outside * outside + Et * Et);
  *E_in = sqrt(En * En + Et * Et);
}

/* Length of the elements of column c beside a row of nodes, m. */
static double element_length(const ZpField *f, size_t c, size_t row) {
  return f->grid.x[(2 * c + 2) * f->grid.ny + row] - f->grid.x[2 * c * f->grid.ny + row];
}

/* Traction and fields at node column i, the mean of the elements that meet there by their lengths: Simpson's rule is
 * then exact on both sides of a jump. */
static void traction_at(const ZpField *f, const Side *side, size_t i, double *W, double *E_out, double *E_in) {
  double W2, E2, I2;
  if (i % 2) {
    traction(f, side, i / 2, 0, W, E_out, E_in);
    return;
  }
  bool right = i / 2 < f->grid.columns && (f->params.electrode || i != f->last);
  traction(f, side, i / 2 - 1, 1, W, E_out, E_in);
  if (!right || i == f->first) return;
  traction(f, side, i / 2, -1, &W2, &E2, &I2);
  double before = element_length(f, i / 2 - 1, 2 * side->row), after = element_length(f, i / 2, 2 * side->row);
  double share = after / (before + after);
  *W += share * (W2 - *W);
  *E_out += share * (E2 - *E_out);
  *E_in += share * (I2 - *E_in);
}

void zp_field_profile(ZpField *f) {
  const ZpFieldParams *p = &f->params;
  const ZpFieldMesh *m = &p->mesh;
  size_t strip = m->outside + m->strip, insulator = p->t > 0 ? m->insulator : 0, gap = strip + insulator;
  size_t below = m->outside - 1, above = f->grid.rows - m->outside, top = gap + m->gap;
  Side lower = {insulator ? gap - 1 : gap, insulator ? 1 : -1, gap, 1};
  Side upper = {insulator ? top : top - 1, insulator ? -1 : 1, top - 1, -1};
  Side lower_back = {below, 1, below, -1}, upper_back = {above, -1, above, 1};
  for (size_t k = 0; k < f->profiles; k++) {
    size_t i = f->first + k, low = i * f->grid.ny + 2 * gap, high = low + 2 * m->gap;
    double Wl, Wu, back_l, back_u, El, Eu, Il, Iu, unused;
    traction_at(f, &lower, i, &Wl, &El, &Il);
    traction_at(f, &upper, i, &Wu, &Eu, &Iu);
    traction_at(f, &lower_back, i, &back_l, &unused, &unused);
    traction_at(f, &upper_back, i, &back_u, &unused, &unused);
    f->profile[k] = (ZpFieldProfile){.x = 0.5 * (f->grid.x[low] + f->grid.x[high]),
                                     .gap = f->grid.y[high] - f->grid.y[low],
                                     .upper = -p->w * (Wu + back_u),
                                     .lower = p->w * (Wl + back_l),
                                     .E = fmax(El, Eu),
                                     .E_insulator = fmax(Il, Iu)};
  }
}

/* Vertical force on ribbon r from the nodes of column i when it moves as a rigid body and all else is fixed, N/m.
 * Nothing outside moves: where the body is cut at the clip, the stress on the cut contributes only where the field is
 * normal to the faces, and has no component along them. */
static double body_force(const ZpField *f, size_t i, size_t r) {
  const ZpGrid *g = &f->grid;
  double F = 0;
  for (size_t j = 0; j < g->ny; j++) {
    const ZpFieldRow *row = &f->row[j];
    if (row->layer == 0 ? row->share == 1 : row->layer < LAYERS - 1) F += follows(row, r).y * g->Fy[i * g->ny + j];
  }
  return F;
}

/* Simpson's rule over node columns from .. to, both even. */
static void integrate(const ZpField *f, size_t from, size_t to, double *upper, double *lower) {
  *upper = *lower = 0;
  for (size_t i = from; i + 2 <= to; i += 2) {
    const ZpFieldProfile *p = f->profile + (i - f->first);
    double sixth = (p[2].x - p[0].x) / 6;
    *upper += sixth * (p[0].upper + 4 * p[1].upper + p[2].upper);
    *lower += sixth * (p[0].lower + 4 * p[1].lower + p[2].lower);
  }
}

ZpFieldTotals zp_field_totals(ZpField *f) {
  ZpFieldTotals totals = {0, 0, 0, 0, 0, 0};
  integrate(f, f->first, f->last, &totals.upper, &totals.lower);
  integrate(f, f->last, f->grid.nx - 1, &totals.upper_platform, &totals.lower_platform);
  zp_grid_forces(&f->grid, f->first / 2, f->grid.columns);
  for (size_t i = f->first; i < f->grid.nx; i++) {
    totals.upper_work -= f->params.w * body_force(f, i, 0);
    totals.lower_work += f->params.w * body_force(f, i, 1);
  }
  return totals;
}
