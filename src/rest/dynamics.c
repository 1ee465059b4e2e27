#include "rest/dynamics.h"

#include <math.h>
#include <string.h>

/* Arrays over the equations of all members. */
static void carve_equations(ZpDynamics *d, ZpCarver *carver) {
  double **of_equations[] = {&d->mass, &d->q, &d->v, &d->history.w, &d->history.a, &d->scale};
  for (size_t k = 0; k < sizeof of_equations / sizeof of_equations[0]; k++)
    *of_equations[k] = zp_carve(carver, d->system.n);
  d->kind = (ZpUnknown *)(void *)zp_carve(carver, d->system.n); /* room for doubles is more than enough */
}

/* The arrays belong to the uppermost member; a member below it uses its part of them. */
static void share_equations(const ZpDynamics *d, ZpDynamics *m) {
  m->mass = d->mass + m->at;
  m->q = d->q + m->at;
  m->v = d->v + m->at;
  m->history.w = d->history.w + m->at;
  m->history.a = d->history.a + m->at;
  m->scale = d->scale + m->at;
  m->kind = d->kind + m->at;
}

static size_t carve(ZpDynamics *d, void *block) {
  const ZpModel *model = d->model;
  size_t stride = model->stride;
  ZpCarver carver = {block, 0};
  if (!d->above) {
    zp_implicit_carve(&d->stepper, &d->system, &carver);
    carve_equations(d, &carver);
  }
  double **of_nodes[] = {&d->start, &d->end, &d->force};
  for (size_t k = 0; k < sizeof of_nodes / sizeof of_nodes[0]; k++)
    *of_nodes[k] = zp_carve(&carver, 2 * stride);
  d->by_voltage.force = zp_carve(&carver, 2 * stride);
  d->by_voltage.charge = zp_carve(&carver, 2 * stride);
  d->own = zp_carve(&carver, zp_own_unknowns(model));
  d->moved = zp_carve(&carver, 2 * stride);
  d->gap = zp_carve(&carver, model->nodes);
  d->foreseen = zp_carve(&carver, model->nodes);
  return carver.used;
}

/* -- the system ----------------------------------------------------------------------------------- */

static double end_time(const ZpDynamics *d) {
  double t = d->state->t;
  return d->h == d->latest - t ? d->latest : t + d->h;
}

/* The voltage at the step's end: the one that the user holds, or that of the waveform. */
static double end_voltage(const ZpDynamics *d) {
  const ZpState *state = d->state;
  if (state->by_hand) return zp_ramp_value(&state->voltage_input, end_time(d));
  return zp_waveform_voltage_before(&d->model->waveform, end_time(d));
}

/* Mean of the load input over the step, N. The input changes linearly, so this mean does its work, eq. (17.5). */
static double mean_load(const ZpDynamics *d) {
  const ZpState *state = d->state;
  return 0.5 * (zp_state_load(d->model, state, state->t) + zp_state_load(d->model, state, end_time(d)));
}

/* The step under way. */
static ZpSpan span_of(const ZpDynamics *d) {
  return (ZpSpan){.start = d->start,
                  .end = d->end,
                  .h = d->h,
                  .U0 = d->U0,
                  .U1 = d->U1,
                  .load = mean_load(d),
                  .hung = zp_state_hung(d->model, d->state),
                  .own = d->own,
                  .memory = zp_state_memory(d->model, d->state),
                  .bead = d->state->bead,
                  .v0 = zp_state_motion(d->model, d->state).vx,
                  .w = d->state->last_step > 0 ? d->mean_v : NULL,
                  .share = 1,
                  .beyond = zp_state_beyond(d->model, d->state)};
}

/* The charge that all electrodes have taken at the end of the step at a voltage, C. */
static double taken_at(const void *self, double U) {
  const ZpDynamics *d = self;
  ZpSpan span = span_of(d);
  ZpElectric end = zp_system_electric(d->model, &span, &d->eval, ZP_SPAN_END, U);
  return d->model->parts * (end.charge + end.passed - d->charge0);
}

/* Their capacitance there between the voltages of the step's start and end, or where these are one above it, F. Capped
 * charges have none. */
static double chord(const ZpDynamics *d, double taken) {
  static const double same = 1e-9, above = 1e-3; /* of the scale */
  double apart = d->U0 - d->U1, scale = d->source->scale;
  if (fabs(apart) < same * scale) apart = copysign(above * scale, d->U1);
  return fmax((taken_at(d, d->U1 + apart) - taken) / apart, 0);
}

static void ask_source(ZpDynamics *d) {
  double taken = taken_at(d, d->U1);
  d->chord = chord(d, taken);
  ZpSourceStep step = {d->state->t, d->h, d->U0, d->U1, taken, d->chord, d, taken_at};
  d->law = d->source->law(d->source->self, &step);
}

/* => energies of bending and field, with which an imbalance is compared. */
static double begin_one(ZpDynamics *d, const double *q0) {
  const ZpModel *model = d->model;
  const ZpEval *e = &d->eval;
  zp_assembly_scatter(&d->assembly, q0, d->start);
  memcpy(d->end, d->start, 2 * model->stride * sizeof *d->end);
  ZpSpan span = span_of(d);
  zp_system_begin(model, &span, &d->eval);
  if (d->source) d->charge0 = zp_system_electric(model, &span, &d->eval, ZP_SPAN_START, d->U0).charge;
  double bending = model->is_rod ? zp_rod_bending_energy(&model->rod, &e->rod_start)
                                 : zp_massspring_shear_energy(&model->shear, &e->spring_start);
  double field = model->field ? zp_plates_totals(&model->plates, &e->plates_start, d->U0).potential : 0;
  return bending + fabs(field);
}

static double begin(void *self, const double *q0, const double *v0) {
  ZpDynamics *d = self;
  (void)v0;
  double energy = begin_one(d, q0);
  for (ZpDynamics *m = d->below; m; m = m->below)
    energy += begin_one(m, q0 + m->at);
  return energy;
}

/* The laws' own unknowns, from all equations. */
static void gather_own(ZpDynamics *d, const double *q) {
  for (size_t c = 0; c < zp_own_unknowns(d->model); c++)
    d->own[c] = q[d->assembly.own_equation[c]];
}

static void force_of_one(ZpDynamics *d, const double *q1, double h, double *f) {
  const ZpModel *model = d->model;
  d->h = h;
  d->U1 = d->source ? q1[d->assembly.n] : end_voltage(d);
  zp_assembly_scatter(&d->assembly, q1, d->end);
  gather_own(d, q1);
  ZpSpan span = span_of(d);
  zp_system_force(model, &span, &d->eval, d->force);
  if (model->field) memcpy(d->gap, d->eval.plates.gap, model->nodes * sizeof *d->gap);
  zp_assembly_sum(&d->assembly, d->force, f);
  for (size_t c = 0; c < zp_own_unknowns(model); c++)
    f[d->assembly.own_equation[c]] = d->eval.own_residual[c];
  if (!d->source) return;
  ask_source(d);
  f[d->assembly.n] = d->law.lacks / model->parts;
}

/* Two platforms that a link joins. `above` is the equation of the height of the lower platform of the member above.
 * `below` is that of a platform of the member below: the upper one in a series, the lower one of an antagonist, which
 * is upside down, and of members side by side. The height of `above` plus `sign` times that of `below` is `height`. */
typedef struct Joined {
  size_t above, below;
  double sign, height;
} Joined;

/* Which platform of the member below does a link join? */
static size_t node_joined(const ZpModel *below) {
  const ZpTopology *t = &below->topology;
  return zp_shares_load(below) ? zp_lower(t, t->platform.first) : zp_upper(t, t->platform.first);
}

/* The platforms joined by the link on which member m hangs. */
static Joined joined_by(const ZpDynamics *m) {
  const ZpTopology *above = &m->above->model->topology;
  int lower = m->above->assembly.equation[2 * zp_lower(above, above->platform.first) + 1];
  int other = m->assembly.equation[2 * node_joined(m->model) + 1];
  return (Joined){m->above->at + (size_t)lower, m->at + (size_t)other, zp_is_opposed(m->model) ? 1 : -1,
                  -m->model->distance};
}

/* Number of the first unknown that is the force of a link. */
static size_t first_link(const ZpDynamics *d) {
  return d->system.n - d->links;
}

/* Eq. (29.2): each link pulls the platform below it up and the one above it down, and both have the same height.
 * Between antagonists, eq. (31.3), it opens both. */
static void add_links(const ZpDynamics *d, const double *q1, double *f) {
  size_t link = first_link(d);
  for (const ZpDynamics *m = d->below; m; m = m->below, link++) {
    Joined joined = joined_by(m);
    f[joined.below] -= joined.sign * q1[link];
    f[joined.above] -= q1[link];
    f[link] = joined.height - joined.sign * q1[joined.below] - q1[joined.above];
  }
}

static ZpEnd force(void *self, const double *q1, double h, double *f) {
  ZpDynamics *d = self;
  const bool joined = d->links > 0;
  for (ZpDynamics *m = d; m; m = m->below)
    force_of_one(m, q1 + m->at, h, f + m->at);
  if (joined) add_links(d, q1, f);
  return ZP_END_FOUND;
}

/* Of one part. Beyond a kink of the charge, where it is capped, the slope would lead anywhere: the chord leads back
 * towards the start of the step. */
static double capacitance(const ZpDynamics *d) {
  static const double none = 1e-3; /* of the chord */
  double slope = d->by_voltage.capacitance, chord = d->chord / d->model->parts;
  bool goes_back = d->law.lacks * (d->U1 - d->U0) < 0;
  return goes_back || slope < none * chord ? fmax(slope, chord) : slope;
}

/* Where a charge is capped, the slope would lead far beyond any voltage. */
static double least_slope(const ZpDynamics *d) {
  double left = d->law.bound - d->U1;
  return left * d->law.lacks > 0 ? d->law.lacks / left / d->model->parts : 0;
}

/* Row and column of the voltage behind a source, eq. (18.10). */
static void border(ZpDynamics *d, const ZpSpan *span, ZpBordered *J) {
  const ZpByVoltage *by = &d->by_voltage;
  size_t u = d->assembly.n;
  zp_system_by_voltage(d->model, span, &d->eval, &d->by_voltage);
  zp_assembly_sum(&d->assembly, by->force, J->B);
  zp_assembly_sum(&d->assembly, by->charge, J->C);
  for (size_t i = 0; i < u; i++) {
    J->B[i] = -J->B[i];
    J->C[i] *= -d->law.by_taken;
  }
  double slope = -d->law.by_taken * capacitance(d) - d->law.by_voltage / d->model->parts;
  *zp_bordered_at(J, u, u) = fmax(slope, least_slope(d));
}

/* The tangent of one member, in its part of the band. */
static void tangent_of_one(ZpDynamics *d, ZpBordered *J) {
  ZpSpan span = span_of(d);
  ZpBand part = zp_band_part(&J->A, d->at, d->assembly.n);
  zp_band_clear(&part);
  zp_system_add_stiffness(d->model, &span, &d->assembly, &d->eval, &part);
  if (d->source) border(d, &span, J);
}

static void border_of_links(const ZpDynamics *d, ZpBordered *J) {
  size_t inner = J->n - J->border, link = first_link(d);
  memset(J->B, 0, J->border * inner * sizeof *J->B);
  memset(J->C, 0, J->border * inner * sizeof *J->C);
  memset(J->D, 0, J->border * J->border * sizeof *J->D);
  for (const ZpDynamics *m = d->below; m; m = m->below, link++) {
    Joined joined = joined_by(m);
    *zp_bordered_at(J, joined.below, link) = *zp_bordered_at(J, link, joined.below) = joined.sign;
    *zp_bordered_at(J, joined.above, link) = *zp_bordered_at(J, link, joined.above) = 1;
  }
}

static void tangent(void *self, ZpBordered *J) {
  ZpDynamics *d = self;
  const bool joined = d->links > 0;
  for (ZpDynamics *m = d; m; m = m->below)
    tangent_of_one(m, J);
  if (joined) border_of_links(d, J);
}

/* Entry of a vector of unknowns for the head of mode k at station i. */
static double *head_in(const ZpDynamics *m, size_t i, int k, double *x) {
  return &x[m->at + (size_t)m->assembly.own_equation[zp_film_mode_at(i, k)]];
}

/* The matrix has other unknowns than the heads at stations with a cavity (zp_film_mix). */
static void turn(void *self, double *r) {
  for (ZpDynamics *m = self; m; m = m->below)
    for (size_t i = 0; i < m->model->nodes; i++) {
      double *first = head_in(m, i, 0, r), *second = head_in(m, i, 1, r);
      *second = zp_film_turned(&m->model->film, m->h, &m->eval.film, i, (const double[]){*first, *second});
    }
}

static void turn_back(void *self, double *x) {
  for (ZpDynamics *m = self; m; m = m->below)
    for (size_t i = 0; i < m->model->nodes; i++)
      *head_in(m, i, 0, x) -= zp_film_mix(&m->model->film, &m->eval.film, i) * *head_in(m, i, 1, x);
}

/* -- faces that meet ------------------------------------------------------------------------------ */

static bool is_platform(const ZpDynamics *d, size_t i) {
  const ZpJoint *platform = &d->model->topology.platform;
  return i >= platform->first && i <= platform->last;
}

/* Mass of the platform above that a link joins to a platform of this member, kg; 0 if there is none. */
static double mass_joined_above(const ZpDynamics *d) {
  if (!d->above) return 0;
  const ZpTopology *t = &d->above->model->topology;
  return d->above->model->mass[zp_lower(t, t->platform.first)];
}

/* And below. */
static double mass_joined_below(const ZpDynamics *d) {
  return d->below ? d->below->model->mass[node_joined(d->below->model)] : 0;
}

/* Mass of the lower platforms of all other members that share the load of this member, kg. */
static double mass_of_others(const ZpDynamics *d) {
  const ZpDynamics *m = d;
  double sum = 0;
  while (m->above)
    m = m->above;
  for (; m; m = m->below)
    if (m != d) sum += m->model->mass[zp_lower(&m->model->topology, m->model->topology.platform.first)];
  return sum;
}

/* Mass that moves with the upper platform of a member, and with its lower one, kg. */
static double mass_with_upper(const ZpDynamics *d) {
  return zp_shares_load(d->model) ? 0 : mass_joined_above(d);
}

static double mass_with_lower(const ZpDynamics *d) {
  return d->added + (zp_shares_load(d->model) ? mass_of_others(d) : mass_joined_below(d));
}

/* The heights of station i: equations and masses of its nodes. A node that is held or missing has an infinite mass.
 * Both ends of a platform that does not turn have equal pairs. */
typedef struct Pair {
  int upper, lower;
  double upper_share; /* of the pair's mass */
  double reduced;     /* mass of their relative motion, kg */
} Pair;

static Pair pair_of(const ZpDynamics *d, size_t i) {
  const ZpTopology *t = &d->model->topology;
  const int *equation = d->assembly.equation;
  size_t upper = zp_upper(t, i), lower = zp_lower(t, i);
  Pair pair = {zp_is_pair(t) ? equation[2 * upper + 1] : -1, equation[2 * lower + 1], 1, 0};
  if (pair.lower < 0) return pair;
  double below = d->model->mass[lower] + (is_platform(d, i) ? mass_with_lower(d) : 0);
  pair.reduced = below;
  if (pair.upper < 0) return pair;
  double above = d->model->mass[upper] + (is_platform(d, i) ? mass_with_upper(d) : 0), both = above + below;
  pair.upper_share = above / both;
  pair.reduced = above * below / both;
  return pair;
}

/* A first guess. Faces that overlap keep their overlap, and faces that would pass through each other overlap a little.
 * The centre of mass of each pair stays where it was predicted. */
static void keep_apart(const ZpDynamics *d, double *q1) {
  const ZpModel *model = d->model;
  const double *y = d->start + model->stride, little = 0.5 * model->faces.depth;
  for (size_t i = 1; i < model->nodes; i++) {
    Pair pair = pair_of(d, i);
    if (pair.lower < 0) continue;
    double held = zp_is_pair(&model->topology) ? y[zp_upper(&model->topology, i)] : model->plates.flat_height;
    double upper = pair.upper >= 0 ? q1[pair.upper] : held, overlap = q1[pair.lower] - upper;
    bool overlapped = d->eval.plates_start.gap[i] < 0;
    if (!(overlap > 0) && !overlapped) continue;
    overlap += overlapped ? d->eval.plates_start.gap[i] : -fmin(little, overlap);
    q1[pair.lower] -= overlap * (pair.upper >= 0 ? pair.upper_share : 1);
    if (pair.upper >= 0) q1[pair.upper] += overlap * (1 - pair.upper_share);
  }
}

/* Heads decide on cavities again. */
static void release_cavities(ZpDynamics *d) {
  for (ZpDynamics *m = d; m; m = m->below)
    if (m->model->has_film) zp_film_release(&m->model->film, &m->eval.film);
}

static void attempt(void *self, double *q1) {
  ZpDynamics *d = self;
  d->fewest = SIZE_MAX;
  release_cavities(d);
  for (ZpDynamics *m = self; m; m = m->below) {
    zp_rod_step_begin(&m->model->rod, &m->eval.rod_start, &m->eval.rod_step);
    if (m->model->field) keep_apart(m, q1 + m->at);
  }
}

/* Work of the part of the last correction's change of contact forces and cavities that the tangent did not predict,
 * J. */
static double unforeseen_of_one(ZpDynamics *d, const double *q1) {
  const ZpModel *model = d->model;
  const ZpFacesEval *faces = &d->eval.faces;
  double work = 0, *foreseen = d->foreseen, *before = d->gap;
  const double *gap = d->eval.plates.gap;
  zp_assembly_scatter(&d->assembly, q1, d->end);
  if (!model->field) return 0;
  gather_own(d, q1);
  if (model->has_film) work += zp_film_unforeseen(&model->film, d->own, &d->eval.film);
  zp_plates_gaps(&model->plates, d->end, d->end + model->stride, &d->eval.plates);
  for (size_t i = 0; i < model->nodes; i++)
    foreseen[i] = faces->push[i] - faces->own[i] * (gap[i] - before[i]);
  for (size_t i = 0; i + 1 < model->nodes; i++) {
    foreseen[i] -= faces->next[i] * (gap[i + 1] - before[i + 1]);
    foreseen[i + 1] -= faces->next[i] * (gap[i] - before[i]);
  }
  ZpFacesSpan span = zp_faces_span(&model->faces, d->eval.plates_start.gap, gap, d->h);
  zp_faces_eval(&model->faces, &span, faces);
  for (size_t i = 1; i < model->nodes; i++)
    work += fabs((faces->push[i] - foreseen[i]) * (gap[i] - d->eval.plates_start.gap[i]));
  return work;
}

static double unforeseen(void *self, const double *q1) {
  double work = 0;
  for (ZpDynamics *m = self; m; m = m->below)
    work += unforeseen_of_one(m, q1 + m->at);
  return work;
}

/* Cavities open and close by the last heads, all at once. This may lead to and fro for ever. So they change one by one,
 * which ends, if those that their heads contradict do not become fewer within some iterations. */
static bool choose(void *self, const double *q1) {
  enum { TRIALS = 4 };
  ZpDynamics *d = self;
  size_t contradict = 0, fewest = d->fewest;
  for (ZpDynamics *m = d; m; m = m->below) {
    gather_own(m, q1 + m->at);
    contradict += zp_film_contradictions(&m->model->film, m->own, &m->eval.film);
  }
  bool fewer = contradict < fewest;
  d->trials = fewer ? TRIALS : d->trials - 1;
  d->fewest = contradict == 0 ? SIZE_MAX : fewer ? contradict : fewest;
  if (contradict == 0 || d->trials > 0) {
    release_cavities(d);
    return true;
  }
  for (ZpDynamics *m = d; m; m = m->below)
    zp_film_turn_one(&m->model->film, m->own, &m->eval.film);
  return false;
}

static double kinetic_energy(const ZpDynamics *d) {
  double sum = 0;
  for (size_t i = 0; i < d->system.n; i++)
    sum += d->mass[i] * d->v[i] * d->v[i];
  return sum / 2;
}

/* The damper reduces the relative velocity at station i. A platform that does not turn is damped once, at its first
 * end. */
static void damp(ZpDynamics *d, size_t i) {
  const ZpJoint *platform = &d->model->topology.platform;
  bool again = i > platform->first && i <= platform->last && !zp_platform_turns(&d->model->topology);
  if (again) return;
  Pair pair = pair_of(d, i);
  if (pair.lower < 0) return;
  double apart = (pair.upper >= 0 ? d->v[pair.upper] : 0) - d->v[pair.lower];
  double lost = (1 - zp_faces_kept(&d->eval.faces, i, pair.reduced, d->h)) * apart;
  d->v[pair.lower] += lost * (pair.upper >= 0 ? pair.upper_share : 1);
  if (pair.upper >= 0) d->v[pair.upper] -= lost * (1 - pair.upper_share);
}

/* Do faces overlap at the step's end without a film that has slowed them down? In a bath there is a film everywhere. */
static bool meets(const ZpDynamics *d, size_t i) {
  const ZpModel *model = d->model;
  bool filled = model->has_film && (!model->has_bead || zp_film_fills(&model->film, &d->eval.film, i));
  return d->eval.faces.stiffness[i] > 0 && !filled;
}

/* Work that the contact forces of one member have taken over the step, J. */
static double pushed(const ZpDynamics *d) {
  const double *gap = d->eval.plates.gap, *before = d->eval.plates_start.gap;
  double loss = 0;
  for (size_t i = 1; i < d->model->nodes; i++)
    loss -= d->eval.faces.push[i] * (gap[i] - before[i]);
  return loss;
}

/* Damp all faces of one member that are in contact. Before and after, its platforms get the velocities of those to
 * which links join them. */
static void damp_one(ZpDynamics *top, ZpDynamics *m) {
  if (m->above) top->v[joined_by(m).below] = -joined_by(m).sign * top->v[joined_by(m).above];
  for (size_t i = 1; i < m->model->nodes; i++)
    if (meets(m, i)) damp(m, i);
  for (; m->above; m = m->above)
    top->v[joined_by(m).above] = -joined_by(m).sign * top->v[joined_by(m).below];
}

static void damp_all(ZpDynamics *d) {
  for (ZpDynamics *m = d; m; m = m->below)
    damp_one(d, m);
}

static bool any_meet(const ZpDynamics *d) {
  for (const ZpDynamics *m = d; m; m = m->below)
    for (size_t i = 1; i < m->model->nodes; i++)
      if (meets(m, i)) return true;
  return false;
}

/* Is there a vibration of masses on contact layers that the step does not resolve? Theory, section 18, Filter. */
static bool misses_layers(const ZpDynamics *d) {
  static const double followed = 4; /* angle by which such a vibration turns in a step, at most */
  double most = followed * followed / (d->h * d->h);
  for (const ZpDynamics *m = d; m; m = m->below)
    for (size_t i = 1; i < m->model->nodes; i++)
      if (meets(m, i) && m->eval.faces.stiffness[i] > most * pair_of(m, i).reduced) return true;
  return false;
}

/* Loss by contact forces over the step, including their damper (9.6), and after it => J. Without a film, if the step
 * does not resolve the vibrations of the layers, motion too fast for the step is removed from velocities after an
 * impact. With a film the damper (9.3) acts instead. */
static double impact(ZpDynamics *d) {
  double loss = 0;
  const bool film = d->model->has_film;
  for (const ZpDynamics *m = d; m; m = m->below)
    loss += pushed(m);
  d->filters = d->lead ? d->lead->filters : !film && (d->settles || misses_layers(d));
  if (film ? !any_meet(d) : !d->filters) return loss;
  loss += kinetic_energy(d);
  if (film)
    damp_all(d);
  else
    zp_implicit_smooth(&d->stepper, d->h, d->v);
  return loss - kinetic_energy(d);
}

/* A meniscus that passes a station gives it a film at once. Where the film's resistance far exceeds the inertia of the
 * ribbons, the difference of velocities from the mean of the step would reverse in every step. The part of it that is
 * too fast for the step is removed => the loss, J. */
static double calm(ZpDynamics *d) {
  double before = kinetic_energy(d);
  zp_implicit_calm(&d->stepper, d->h, d->history.w, d->v);
  return before - kinetic_energy(d);
}

/* A film of thickness H takes momentum in the time H^2 / (12 nu). Where a step is longer, relative velocities of faces
 * would reverse in every step around their mean, so each station loses a share of that difference, eq. (18.14) => the
 * loss, J. */
static double settle_films(ZpDynamics *d) {
  static const double thin = 2; /* times the roughness: faces lie on each other */
  double before = kinetic_energy(d);
  for (ZpDynamics *m = d; m; m = m->below) {
    const ZpFilmParams *film = &m->model->film;
    for (size_t i = 1; i < m->model->nodes; i++) {
      Pair pair = pair_of(m, i);
      double H = zp_film_thickness(film, m->eval.plates.gap[i]), drag = 6 * film->mu * d->h;
      if (pair.lower < 0 || H > thin * film->roughness) continue;
      double share = drag / (drag + film->rho * H * H), w = -m->history.w[pair.lower], v = -m->v[pair.lower];
      if (pair.upper >= 0) w += m->history.w[pair.upper], v += m->v[pair.upper];
      double lost = share * share * share * (v - w);
      m->v[pair.lower] += lost * (pair.upper >= 0 ? pair.upper_share : 1);
      if (pair.upper >= 0) m->v[pair.upper] -= lost * (1 - pair.upper_share);
    }
  }
  return before - kinetic_energy(d);
}

/* -- creation and step ---------------------------------------------------------------------------- */

/* Pressures are unknowns of one step, without memory. */
static void add_own(ZpDynamics *d) {
  static const double pressure = 1e9; /* Pa: what counts as much as 1 m of a position: 1 kPa as 1 um */
  for (size_t c = 0; c < zp_own_unknowns(d->model); c++) {
    d->kind[d->assembly.own_equation[c]] = ZP_ALGEBRAIC;
    d->scale[d->assembly.own_equation[c]] = pressure;
  }
}

/* The law of a source is exact for changes of its voltage that are faster than the step, so they have no error. */
static double resolved(void *self, size_t i) {
  const ZpDynamics *d = self;
  return d->source && i == d->assembly.n ? d->law.resolved : 1;
}

static void inertia(void *self, const double *a, double *f) {
  for (ZpDynamics *m = self; m; m = m->below) {
    ZpSpan span = span_of(m);
    zp_assembly_scatter(&m->assembly, a + m->at, m->moved);
    zp_system_inertia(m->model, &span, &m->eval, m->moved, m->force);
    zp_assembly_add(&m->assembly, m->force, f + m->at);
  }
}

/* Each outer face moves its own mass of liquid up and down. */
static void weigh_liquid(ZpDynamics *d) {
  const ZpModel *model = d->model;
  double side = zp_outer_side(&model->outer);
  for (size_t j = 0; j < model->count; j++) {
    int row = d->assembly.equation[2 * j + 1];
    if (row >= 0) d->mass[row] += side * zp_film_length(&model->film, j / model->s);
  }
}

/* The damper of faces acts within the step. But a film slows faces itself: with a film, faces that meet without liquid
 * are damped after the step. */
static void set_dampers(ZpDynamics *d) {
  const ZpModel *model = d->model;
  for (size_t i = 1; i < model->nodes && model->field && !model->has_film; i++) {
    Pair pair = pair_of(d, i);
    if (pair.lower >= 0) zp_faces_damp(&model->faces, i, pair.reduced, &d->eval.faces);
  }
}

/* Masses of the equations, with `added` on each end that carries the load, kg. */
static void weigh(ZpDynamics *d, double added) {
  const ZpTopology *t = &d->model->topology;
  memset(d->mass, 0, d->assembly.n * sizeof *d->mass);
  zp_assembly_add_masses(&d->assembly, d->model->mass, d->mass);
  if (d->model->has_film) weigh_liquid(d);
  d->added = added;
  for (size_t i = t->platform.first; added != 0 && i <= t->platform.last; i++)
    for (size_t c = 0; c < 2; c++) {
      int row = d->assembly.equation[2 * zp_lower(t, i) + c];
      if (row >= 0) d->mass[row] += added;
    }
  set_dampers(d);
}

/* The voltage behind a source has a rate and no inertia. */
static void add_voltage(ZpDynamics *d) {
  size_t u = d->assembly.n;
  d->kind[u] = ZP_FIRST_ORDER;
  d->scale[u] = d->source->scale / d->model->L;
}

/* Forces of links are unknowns of one step, too. */
static void add_link_forces(ZpDynamics *d) {
  static const double force = 1e6; /* N: what counts as much as 1 m of a position: 1 N as 1 um */
  for (size_t link = first_link(d); link < d->system.n; link++) {
    d->kind[link] = ZP_ALGEBRAIC;
    d->scale[link] = force;
  }
}

/* The dynamics of this model and of all below it, without the parts that they share. */
static bool create_members(const ZpModel *model, size_t below, ZpDynamics *d) {
  d->model = model;
  if (!zp_system_create(model, false, &d->eval)) return false;
  if (!zp_assembly_create(model, model->own, true, &d->assembly)) return false;
  if (below == 0) return true;
  d->below = zp_calloc(1, sizeof *d->below);
  if (!d->below) return false;
  d->below->above = d;
  d->below->at = d->at + d->assembly.n;
  return create_members(model + 1, below - 1, d->below);
}

/* The system of all members. */
static ZpImplicitSystem system_of(ZpDynamics *d) {
  const ZpDynamics *last = d;
  while (last->below)
    last = last->below;
  size_t border = d->links + (d->source ? 1 : 0);
  return (ZpImplicitSystem){.n = last->at + last->assembly.n + border,
                            .border = border,
                            .bandwidth = d->assembly.bandwidth,
                            .groups = d->below ? (ZpBandGroups){0, 0} : d->assembly.groups,
                            .parts = d->assembly.parts,
                            .self = d,
                            .begin = begin,
                            .residual = force,
                            .tangent = tangent,
                            .turn = d->model->has_film ? turn : NULL,
                            .turn_back = d->model->has_film ? turn_back : NULL,
                            .inertia = d->model->has_film ? inertia : NULL,
                            .attempt = attempt,
                            .resolved = resolved,
                            .choose = d->model->has_film ? choose : NULL,
                            .unforeseen = unforeseen};
}

static bool allocate(ZpDynamics *d) {
  for (ZpDynamics *m = d; m; m = m->below) {
    m->memory = zp_calloc(1, carve(m, NULL));
    if (!m->memory) return false;
  }
  carve(d, d->memory);
  for (ZpDynamics *m = d->below; m; m = m->below) {
    carve(m, m->memory);
    share_equations(d, m);
  }
  return true;
}

static void fill_equations(ZpDynamics *d) {
  for (size_t i = 0; i < d->system.n; i++)
    d->scale[i] = 1;
  for (ZpDynamics *m = d; m; m = m->below) {
    weigh(m, 0);
    add_own(m);
  }
  add_link_forces(d);
  d->system.mass = d->mass;
  if (d->source) add_voltage(d);
  if (d->system.border == 0 && d->model->own == 0) return;
  d->system.kind = d->kind;
  d->system.scale = d->scale;
}

/* Error of a step as a share of the reference length, eq. (18.12): errors of steps add up, and shorter steps are more.
 * With a tolerance below `finest`, the balance of energy would have to be below the rounding of positions, and no step
 * would converge. */
static double error_of_step(const ZpActuatorDef *def) {
  static const double finest = 1e-7;
  double tolerance = fmax(zp_def_tolerance(def), finest);
  return 1.5 * tolerance * sqrt(tolerance);
}

bool zp_dynamics_create(const ZpModel *model, const ZpSource *source, ZpDynamics *d) {
  memset(d, 0, sizeof *d);
  d->source = source;
  if (!create_members(model, model->members - 1, d)) return false;
  d->links = model->members - 1;
  d->system = system_of(d);
  if (!allocate(d)) return false;
  fill_equations(d);
  const ZpActuatorDef *def = &model->def;
  d->stepper.balance = 2e-6 * error_of_step(def);
  d->stepper.fixed = isnan(def->solver.time_step) ? 0 : def->solver.time_step;
  return true;
}

void zp_dynamics_destroy(ZpDynamics *d) {
  if (d->below) zp_dynamics_destroy(d->below);
  zp_free(d->below);
  d->below = NULL;
  zp_assembly_destroy(&d->assembly);
  zp_system_destroy(&d->eval);
  zp_free(d->memory);
  d->memory = NULL;
}

/* With the liquid where it is then. */
static double charge_at_end(ZpDynamics *d) {
  ZpSpan span = span_of(d);
  const ZpBead *bead = d->eval.bead_end;
  zp_eval_cover(d->model, (const double[ZP_BEADS]){bead[0].reach, bead[1].reach}, &d->eval);
  return zp_system_electric(d->model, &span, &d->eval, ZP_SPAN_END, d->U1).charge;
}

/* The source's work over a step in which the voltage has changed, eq. (18.4): the mean of "first the voltage, then the
 * gaps" and "first the gaps, then the voltage". */
static void book_work(ZpDynamics *d, ZpState *state) {
  double U0 = d->U0, U1 = d->U1;
  if (U0 == U1) return;
  ZpSpan span = span_of(d);
  zp_eval_cover(d->model, d->eval.reach, &d->eval);
  double at_start = zp_system_electric(d->model, &span, &d->eval, ZP_SPAN_START, U1).potential -
                    zp_system_electric(d->model, &span, &d->eval, ZP_SPAN_START, U0).potential;
  double at_end = zp_system_electric(d->model, &span, &d->eval, ZP_SPAN_END, U1).potential -
                  zp_system_electric(d->model, &span, &d->eval, ZP_SPAN_END, U0).potential;
  double charge = charge_at_end(d);
  state->work += U1 * charge - U0 * state->base_charge + 0.5 * (at_start + at_end);
  state->base_charge = charge;
  state->base_U = state->U = U1;
}

static const double of_length = 0.08; /* the reference length of errors as a part of the flexible length */

/* Reference length of errors, m: a part of the flexible length, or of the hanging opening if that is small, because
 * closing is then a small motion. It is at least the depth of contact. */
static double far(const ZpModel *model, const ZpState *state) {
  static const double of_opening = 0.2;
  double length = of_length * model->L;
  return zp_is_pair(&model->topology) ? fmin(length, of_opening * fmax(state->opening0, model->faces.depth)) : length;
}

/* An error of the voltage counts relative to its scale as one of a position does relative to the reference length. For
 * the usual reference length, a part of the flexible length, it has the source's scale. */
static void set_accuracy(ZpDynamics *d, const ZpState *state) {
  double reference = far(d->model, state);
  d->stepper.accuracy = error_of_step(&d->model->def) * reference;
  if (d->source) d->scale[d->assembly.n] = d->source->scale * of_length / reference;
}

/* The state at the start of the step => q, v and what else evolves. */
static void load(ZpDynamics *d, ZpState *state) {
  const ZpModel *model = d->model;
  d->mean_v = zp_state_mean_v(model, state);
  memcpy(d->start, zp_state_q(model, state), 2 * model->stride * sizeof *d->start);
  zp_assembly_gather(&d->assembly, zp_state_q(model, state), d->q);
  zp_assembly_gather(&d->assembly, zp_state_v(model, state), d->v);
  zp_assembly_gather(&d->assembly, d->mean_v, d->history.w);
  zp_assembly_gather(&d->assembly, zp_state_mean_a(model, state), d->history.a);
  const double *own = zp_state_own(model, state);
  for (size_t c = 0; c < zp_own_unknowns(model); c++) {
    size_t i = (size_t)d->assembly.own_equation[c];
    d->own[c] = d->q[i] = own[c];
    d->v[i] = d->history.w[i] = d->history.a[i] = 0;
  }
  if (d->source) {
    size_t u = d->assembly.n;
    d->q[u] = state->U;
    d->v[u] = 0;
    d->history.w[u] = state->U_rate;
    d->history.a[u] = state->U_change;
  }
  d->history.last = state->last_step;
  d->history.next = state->next_step;
}

static ZpElectric electric_at_end(ZpDynamics *d) {
  ZpSpan span = span_of(d);
  return zp_system_electric(d->model, &span, &d->eval, ZP_SPAN_END, d->U1);
}

/* Work of the source on the charge that insulators conduct over the step. */
static void book_conduction(ZpDynamics *d, ZpState *state) {
  double passed = electric_at_end(d).passed;
  state->leaked += passed;
  state->work += 0.5 * (d->U0 + d->U1) * passed;
}

static void book_losses(ZpDynamics *d, ZpState *state) {
  gather_own(d, d->q);
  ZpSpan span = span_of(d);
  zp_system_book(d->model, &span, &d->eval, state);
}

/* Motion and the laws' own numbers at the end of the step => state. */
static void store(ZpDynamics *d, ZpState *state) {
  const ZpModel *model = d->model;
  zp_assembly_scatter(&d->assembly, d->q, zp_state_q(model, state));
  zp_assembly_scatter(&d->assembly, d->v, zp_state_v(model, state));
  zp_assembly_scatter(&d->assembly, d->history.w, zp_state_mean_v(model, state));
  zp_assembly_scatter(&d->assembly, d->history.a, zp_state_mean_a(model, state));
  memcpy(zp_state_own(model, state), d->own, zp_own_unknowns(model) * sizeof *d->own);
  memcpy(zp_state_own(model, state) + zp_own_unknowns(model), d->eval.memory_end, model->kept * sizeof *d->own);
  state->t = end_time(d);
  if (model->has_bead) memcpy(state->bead, d->eval.bead_end, sizeof state->bead);
  if (d->source) {
    state->U_rate = d->history.w[d->assembly.n];
    state->U_change = d->history.a[d->assembly.n];
  }
  state->last_step = d->history.last;
  state->next_step = d->history.next;
}

/* Each coordinate of the load's nodes keeps its momentum: the impact does not affect the strips. */
void zp_dynamics_change_load(ZpDynamics *d, ZpState *state) {
  const ZpModel *model = d->model;
  const ZpTopology *t = &model->topology;
  double each = zp_end_share(model) * model->def.load.change_mass;
  double fast = sqrt(2 * model->def.gravity * model->def.load.drop_height);
  weigh(d, zp_state_added(model, state));
  zp_assembly_gather(&d->assembly, zp_state_v(model, state), d->v);
  for (size_t c = 0; c < 2; c++) {
    int row = d->assembly.equation[2 * zp_load_node(t) + c];
    if (row < 0 || each < 0) continue;
    size_t ends = d->assembly.equation[2 * zp_lower(t, t->platform.last) + c] == row ? zp_load_ends(t) : 1;
    double comes = (double)ends * each;
    d->v[row] = (d->mass[row] * d->v[row] + comes * fast * model->fall[c]) / (d->mass[row] + comes);
  }
  zp_assembly_scatter(&d->assembly, d->v, zp_state_v(model, state));
  memcpy(zp_state_mean_v(model, state), zp_state_v(model, state), 2 * model->stride * sizeof *d->v);
  memset(zp_state_mean_a(model, state), 0, 2 * model->stride * sizeof *d->v);
  state->last_step = state->next_step = 0;
}

/* Motion, work and losses of one member over a step. */
static void book(ZpDynamics *d, ZpState *state) {
  book_losses(d, state);
  if (d->source) d->charge1 = electric_at_end(d).charge;
  if (d->model->leaks) book_conduction(d, state);
  if (d->model->field) book_work(d, state);
}

/* Impacts and menisci change the velocities of all members; their losses are booked with the uppermost one. */
static void book_impacts(ZpDynamics *d, ZpState *state) {
  if (!d->model->field) return;
  *zp_state_row(d->model, state, &zp_row_contact_loss) += impact(d);
  if (d->model->has_film)
    *zp_state_row(d->model, state, &zp_row_film_across_loss) += d->model->has_bead ? calm(d) : settle_films(d);
}

/* Store the state at the step's end, and book the work of the load input. */
static void arrive(ZpDynamics *d, ZpState *state) {
  const ZpModel *model = d->model;
  const double *y = zp_state_q(model, state) + model->stride;
  double before = zp_load_at(model, y), hung = mean_load(d);
  store(d, state);
  state->load_work += hung * (before - zp_load_at(model, y));
  if (zp_is_pair(&model->topology)) state->zip = zp_eval_touching(model, d->eval.plates.gap);
}

void zp_dynamics_begin(ZpDynamics *d, ZpState *const state[], double latest) {
  const size_t first = first_link(d);
  size_t k = 0;
  for (ZpDynamics *m = d; m; m = m->below, k++) {
    m->state = state[k];
    m->latest = latest;
    m->U0 = state[k]->U;
    if (m->added != zp_state_added(m->model, state[k])) weigh(m, zp_state_added(m->model, state[k]));
    load(m, state[k]);
  }
  for (size_t link = first; link < d->system.n && d->links > 0; link++)
    d->q[link] = d->v[link] = d->history.w[link] = d->history.a[link] = 0;
}

/* Force with which the links of members side by side push each platform up, eq. (29.5). */
static void book_links(const ZpDynamics *d, ZpState *const state[]) {
  const double *link = d->q + first_link(d);
  for (size_t k = 0; k <= d->links; k++)
    state[k]->link_force = (k > 0 ? link[k - 1] : 0) - (k < d->links ? link[k] : 0);
}

void zp_dynamics_end(ZpDynamics *d, ZpState *const state[]) {
  size_t k = 0;
  release_cavities(d);
  for (ZpDynamics *m = d; m; m = m->below, k++) {
    m->history.last = d->history.last;
    m->history.next = d->history.next;
    book(m, state[k]);
  }
  book_impacts(d, state[0]);
  k = 0;
  for (ZpDynamics *m = d; m; m = m->below, k++)
    arrive(m, state[k]);
  if (d->model->abreast) book_links(d, state);
}

double zp_dynamics_step(ZpDynamics *d, ZpState *const state[], double latest) {
  zp_dynamics_begin(d, state, latest);
  set_accuracy(d, state[0]);
  double taken = zp_implicit_step(&d->stepper, latest - state[0]->t, d->q, d->v, &d->history);
  if (taken > 0) zp_dynamics_end(d, state);
  return taken;
}
