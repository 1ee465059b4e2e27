/* A bead at rest: all of its liquid lies between the faces, and how far it reaches follows from the gaps. The film term
 * has it in motion. What the reach does to the forces goes through two scalars of each bead: the part of the element,
 * or of the flat faces, that is wet where it ends, and with suction the head p of its liquid. In the stiffness each is
 * a term of rank one on top of the band. Eqs. (22.19) to (22.22). */
#include <math.h>

#include "term/term.h"

const ZpRow zp_row_bead_outside =
    ZP_SHOWN(bead_outside, "m3", "_m3", "volume of one bead that is outside the long edges and can still flow back");
const ZpRow zp_row_bead_lost =
    ZP_SHOWN(bead_lost, "m3", "_m3", "volume of one bead that has been lost at the long edges");

static bool acts(const ZpModel *model) {
  return model->has_bead;
}

/* The end of a bead: the wet part of the element, or of the flat faces, and its derivatives by the area up to the
 * station before it and by the gaps of both stations. */
typedef struct End {
  bool ends; /* false: all is wet */
  int half;
  ZpBeadPlace at;
  double g, H;            /* at the meniscus, m */
  double level;           /* dx/ds there */
  double suction;         /* that acts */
  double by_area;         /* of the part, 1/m^2, */
  double by_near, by_far; /* 1/m */
  double length;          /* of what the part is of, m */
  ZpRoom room;
} End;

static double rise(const ZpModel *model, const ZpEval *e, size_t i) {
  return zp_film_rise(&model->film, e->plates.gap[i]);
}

/* Below the platform? */
static bool is_below(const End *end) {
  return end->at.near == end->at.far;
}

static End end_of(const ZpModel *model, const ZpSpan *span, const ZpEval *e, int half) {
  const ZpFilmParams *film = &model->film;
  End end = {.half = half, .at = zp_bead_place(film, half, e->reach[half])};
  double part = end.at.part, far = is_below(&end) ? 0 : 0.5 * part * part;
  end.ends = e->reach[half] < zp_bead_longest(film);
  end.length = is_below(&end) ? film->flat_length : film->l;
  end.g = zp_bead_at(&end.at, e->plates.gap);
  end.H = zp_bead_thickness(film, &end.at, e->plates.gap);
  end.level = zp_term_level(model, &end.at, span->end);
  end.suction = span->suction * model->bead.suction;
  if (!end.ends) return end;
  end.room = zp_term_meniscus_room(model, e->reach[half]);
  end.by_area = -1 / (end.H * end.length);
  end.by_near = -(part - far) / end.H * rise(model, e, end.at.near);
  end.by_far = -far / end.H * rise(model, e, end.at.far);
  return end;
}

/* -- the head at the meniscus ---------------------------------------------------------------------- */

/* With room for the meniscus. */
static double free_head(const ZpModel *model, double U, const End *end) {
  return zp_term_meniscus_head(model, end->suction, U, end->g, end->H, end->level);
}

static double head_of(const ZpModel *model, double U, const End *end) {
  return end->ends ? end->room.share * free_head(model, U, end) : 0;
}

/* => the share of the head that follows the forces on the liquid: 0 for a meniscus that cavitates. */
static double share_that_follows(const ZpModel *model, double U, const End *end) {
  return end->ends && free_head(model, U, end) > -zp_film_tension ? end->room.share : 0;
}

/* => derivatives of that head by the part, and by the gaps of both stations. */
typedef struct HeadSlope {
  double by_part, by_near, by_far;
} HeadSlope;

static HeadSlope head_slope(const ZpModel *model, const ZpEval *e, double U, const End *end) {
  double W = zp_plates_law(&model->air, U, end->g).W - zp_plates_law(&model->plates, U, end->g).W;
  double follows = share_that_follows(model, U, end), head = free_head(model, U, end);
  double by_g = -follows * end->suction * W * end->level / (model->film.w * end->H);
  double by_H = -follows * head / end->H, by_part = head * end->room.by_reach * end->length;
  const double *gap = e->plates.gap;
  if (is_below(end)) return (HeadSlope){by_part, by_g + by_H * rise(model, e, end->at.near), 0};
  double dg = gap[end->at.far] - gap[end->at.near];
  double dH = zp_film_thickness(&model->film, gap[end->at.far]) - zp_film_thickness(&model->film, gap[end->at.near]);
  double l = 1 - end->at.part, r = end->at.part;
  return (HeadSlope){by_part + by_g * dg + by_H * dH, l * (by_g + by_H * rise(model, e, end->at.near)),
                     r * (by_g + by_H * rise(model, e, end->at.far))};
}

/* -- forces ---------------------------------------------------------------------------------------- */

/* Weight of the thickness at station k of a half in the wet area, m. */
static double wet_share(const ZpModel *model, const End *end, size_t k) {
  double l = model->film.l, part = end->at.part, sum = 0;
  if (k > 0 && (k - 1 < end->at.k || !end->ends)) sum += 0.5 * l;
  if (k > 0 && k - 1 == end->at.k && end->ends && !is_below(end)) sum += 0.5 * part * part * l;
  if (k < zp_bead_elements(&model->film) && (k < end->at.k || !end->ends)) sum += 0.5 * l;
  if (k == end->at.k && end->ends && !is_below(end)) sum += (part - 0.5 * part * part) * l;
  if (k == zp_bead_elements(&model->film) && is_below(end)) sum += part * end->length;
  return sum;
}

static size_t last_of(const ZpModel *model, const End *end) {
  size_t far = is_below(end) ? end->at.k : end->at.k + 1;
  return far < zp_bead_elements(&model->film) ? far : zp_bead_elements(&model->film);
}

/* F += head x the derivative of the wet area by each gap. */
static void add_head(const ZpModel *model, const ZpEval *e, const End *end, double head, double *F) {
  double *Fy = zp_forces(model, F).y;
  for (size_t k = 0; k <= last_of(model, end); k++) {
    size_t i = zp_bead_station(&model->film, end->half, k);
    double push = model->film.w * head * wet_share(model, end, k) * rise(model, e, i);
    Fy[zp_upper(&model->topology, i)] += push;
    Fy[zp_lower(&model->topology, i)] -= push;
  }
}

static bool draws(const ZpModel *model, const ZpSpan *span) {
  return zp_span_is_still(span) && span->suction * model->bead.suction > 0;
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  if (!draws(model, span)) return;
  for (int half = 0; half < zp_beads(&model->film); half++) {
    End end = end_of(model, span, e, half);
    add_head(model, e, &end, head_of(model, span->U1, &end), F);
  }
}

/* -- stiffness ------------------------------------------------------------------------------------- */

size_t zp_bead_rank(const ZpModel *model) {
  size_t scalars = model->bead.suction > 0 ? 2 : 1; /* of each bead */
  return model->has_bead ? scalars * (size_t)zp_beads(&model->film) : 0;
}

/* A scalar z as a term of rank one: -dF/dz => u, and its derivatives by the coordinates => v. */
typedef struct Scalar {
  const ZpModel *model;
  const ZpAssembly *assembly;
  double *u, *v; /* by places of the block */
} Scalar;

/* The part where bead `half` ends. The head's term is there where the model has suction, and 0 while none acts. */
static Scalar part_of(const ZpModel *model, const ZpAssembly *a, int half, const ZpBand *K) {
  size_t term = (size_t)half * (K->rank / (size_t)zp_beads(&model->film));
  return (Scalar){model, a, zp_band_term(K, K->u, term), zp_band_term(K, K->v, term)};
}

static Scalar head_after(Scalar part, const ZpBand *K) {
  return (Scalar){part.model, part.assembly, zp_band_term(K, part.u, 1), zp_band_term(K, part.v, 1)};
}

/* The scalar acts on coordinate c with so much force. */
static void pushes(Scalar z, size_t c, double force) {
  zp_assembly_add_place(z.assembly, c, -force, z.u);
}

/* Its derivative by the gap of station i. */
static void follows_gap(Scalar z, size_t i, double by_gap) {
  zp_assembly_add_place(z.assembly, zp_y_of(zp_upper(&z.model->topology, i)), by_gap, z.v);
  zp_assembly_add_place(z.assembly, zp_y_of(zp_lower(&z.model->topology, i)), -by_gap, z.v);
}

/* Its derivative by dx/ds at the bead's end, through the x of the nodes there. */
static void follows_level(Scalar z, const End *end, double by_level) {
  const ZpTopology *t = &z.model->topology;
  double value = 0.5 * by_level / z.model->film.l * (end->at.near < end->at.far ? 1 : -1);
  for (size_t lower = 0; lower < 2 && !is_below(end); lower++) {
    zp_assembly_add_place(z.assembly, 2 * (zp_upper(t, end->at.far) + lower), value, z.v);
    zp_assembly_add_place(z.assembly, 2 * (zp_upper(t, end->at.near) + lower), -value, z.v);
  }
}

/* `by_part` times the derivative of the part by the gaps: of all of them up to there, through the area that they
 * hold. */
static void follows_part(Scalar z, const ZpEval *e, const End *end, double by_part) {
  const ZpFilmParams *film = &z.model->film;
  double by_thickness = by_part * end->by_area * film->l;
  for (size_t k = 0; k <= end->at.k; k++) {
    size_t i = zp_bead_station(film, end->half, k);
    double ends = (k > 0) + (k < end->at.k); /* of elements before the one where the bead ends */
    follows_gap(z, i, 0.5 * ends * by_thickness * rise(z.model, e, i));
  }
  follows_gap(z, end->at.near, by_part * end->by_near);
  if (!is_below(end)) follows_gap(z, end->at.far, by_part * end->by_far);
}

/* The head is that of the meniscus. */
static void head_follows(Scalar z, const ZpEval *e, double U, const End *end) {
  HeadSlope slope = head_slope(z.model, e, U, end);
  double draws_on =
      share_that_follows(z.model, U, end) * zp_term_electric_head(z.model, end->suction, U, end->g, end->H);
  follows_part(z, e, end, slope.by_part);
  follows_level(z, end, draws_on);
  follows_gap(z, end->at.near, slope.by_near);
  if (!is_below(end)) follows_gap(z, end->at.far, slope.by_far);
}

static void pushes_apart(Scalar z, size_t i, double force) {
  pushes(z, zp_y_of(zp_upper(&z.model->topology, i)), force);
  pushes(z, zp_y_of(zp_lower(&z.model->topology, i)), -force);
}

/* The attraction depends on the part, because one law ends there and the other begins. */
static void part_attracts(Scalar z, const ZpEval *e, double U, const End *end) {
  const ZpModel *model = z.model;
  const ZpTopology *t = &model->topology;
  size_t left = end->at.near < end->at.far ? end->at.near : end->at.far,
         right = end->at.near < end->at.far ? end->at.far : end->at.near;
  if (left == right) {
    double W = zp_plates_law(&model->plates, U, end->g).W - zp_plates_law(&model->air, U, end->g).W;
    pushes_apart(z, left, -model->plates.flat_length * W);
    return;
  }
  ZpPlatesByCover by = zp_plates_by_cover(&model->plates, &e->plates, U, left);
  const double closing[] = {by.A, by.B}, along[] = {0.5 * by.P, -0.5 * by.P};
  const size_t station[] = {left, right};
  for (int m = 0; m < 2; m++) {
    pushes(z, zp_x_of(zp_upper(t, station[m])), along[m]);
    pushes(z, zp_x_of(zp_lower(t, station[m])), along[m]);
    pushes_apart(z, station[m], -closing[m]);
  }
}

/* The suction on station k depends on its own gap, on the head, and, at the bead's end, on the part. */
static void suction_at(Scalar part, Scalar head_scalar, const ZpEval *e, const End *end, double head, size_t k,
                       ZpBand *K) {
  const ZpModel *model = part.model;
  const ZpTopology *t = &model->topology;
  size_t i = zp_bead_station(&model->film, end->half, k), y[] = {zp_y_of(zp_upper(t, i)), zp_y_of(zp_lower(t, i))};
  double w = model->film.w, share = wet_share(model, end, k), slope = rise(model, e, i);
  double bend = -w * head * share * zp_film_bend(&model->film, e->plates.gap[i]);
  for (int m = 0; m < 4; m++)
    zp_assemble_entry(part.assembly, y[m / 2], y[m % 2], m == 0 || m == 3 ? bend : -bend, K);
  pushes_apart(head_scalar, i, w * share * slope);
  if (i != end->at.near && i != end->at.far) return;
  double by_part = is_below(end)       ? end->length
                   : i == end->at.near ? end->length * (1 - end->at.part)
                                       : end->length * end->at.part;
  pushes_apart(part, i, w * head * slope * by_part);
}

static void suction(Scalar part, const ZpEval *e, double U, const End *end, ZpBand *K) {
  Scalar head = head_after(part, K);
  for (size_t k = 0; k <= last_of(part.model, end); k++)
    suction_at(part, head, e, end, head_of(part.model, U, end), k, K);
  head_follows(head, e, U, end);
}

static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *a, ZpEval *e, ZpBand *K) {
  if (!zp_span_is_still(span) || K->rank == 0) return;
  for (int half = 0; half < zp_beads(&model->film); half++) {
    End end = end_of(model, span, e, half);
    if (!end.ends) continue;
    Scalar part = part_of(model, a, half, K);
    part_attracts(part, e, span->U1, &end);
    follows_part(part, e, &end, 1);
    if (draws(model, span)) suction(part, e, span->U1, &end, K);
  }
}

/* Of the head's part. */
static void by_voltage(const ZpModel *model, const ZpSpan *span, ZpEval *e, ZpByVoltage *sum) {
  if (!draws(model, span)) return;
  for (int half = 0; half < zp_beads(&model->film); half++) {
    End end = end_of(model, span, e, half);
    double charge = zp_plates_law(&model->plates, span->U1, end.g).q - zp_plates_law(&model->air, span->U1, end.g).q;
    double follows = share_that_follows(model, span->U1, &end);
    add_head(model, e, &end, -follows * end.suction * charge * end.level / (model->film.w * end.H), sum->force);
  }
}

static void volumes(const ZpModel *model, const ZpSpan *now, ZpEval *e, double *row) {
  (void)model, (void)e;
  if (!now->bead) return;
  row[0] += now->bead[0].outside;
  row[1] += now->bead[0].lost;
}

const ZpTerm zp_term_bead = {.name = "bead",
                             .row = {&zp_row_bead_outside, &zp_row_bead_lost},
                             .acts = acts,
                             .force = force,
                             .stiffness = stiffness,
                             .now = volumes,
                             .by_voltage = by_voltage};
