#include "run/dynamics.h"

#include <math.h>
#include <string.h>

#include "ribbon/rod_maxwell.h"

static void reserve_equations(ZpDynamics *d, ZpArena *arena) {
  double **of_equations[] = {&d->mass,  &d->q,       &d->v,    &d->history.w, &d->history.a,
                             &d->scale, &d->sharers, &d->from, &d->to};
  for (size_t k = 0; k < sizeof of_equations / sizeof of_equations[0]; k++)
    *of_equations[k] = zp_arena_take(arena, d->system.n);
  d->kind = zp_arena_take_of(arena, d->system.n, sizeof *d->kind);
}

static void reserve_member(ZpMovingMember *m, ZpArena *arena) {
  const ZpModel *model = m->model;
  double **of_nodes[] = {&m->start, &m->end, &m->force, &m->moved};
  for (size_t k = 0; k < sizeof of_nodes / sizeof of_nodes[0]; k++)
    *of_nodes[k] = zp_arena_take(arena, zp_coordinates(model));
  m->own = zp_arena_take(arena, zp_extra_unknowns(model));
  m->gap = zp_arena_take(arena, model->nodes);
  m->foreseen = zp_arena_take(arena, model->nodes);
}

/* Of the largest block. */
static size_t most_places(const ZpDynamics *d) {
  size_t most = 0;
  for (const ZpArrowBlock *block = d->form.block; block < d->form.block + d->form.blocks; block++)
    if (block->n + block->band.border > most) most = block->n + block->band.border;
  return most;
}

static size_t reserve(ZpDynamics *d, void *block) {
  ZpArena arena = {block, 0};
  zp_implicit_reserve(&d->stepper, &d->system, &arena);
  reserve_equations(d, &arena);
  for (size_t k = 0; k < d->members; k++)
    reserve_member(&d->member[k], &arena);
  d->joined = zp_arena_take(&arena, d->form.n - d->form.inner);
  d->lost = zp_arena_take(&arena, d->members);
  d->column = zp_arena_take(&arena, most_places(d));
  d->row = zp_arena_take(&arena, most_places(d));
  d->by_voltage.force = zp_arena_take(&arena, zp_coordinates(d->member->model));
  d->by_voltage.charge = zp_arena_take(&arena, zp_coordinates(d->member->model));
  d->push = zp_arena_take(&arena, d->member->model->network->bodies);
  d->pose0 = zp_arena_take_of(&arena, d->plane.bodies, sizeof *d->pose0);
  d->pose1 = zp_arena_take_of(&arena, d->plane.bodies, sizeof *d->pose1);
  return arena.used;
}

/* -- the system ----------------------------------------------------------------------------------- */

static double end_time(const ZpDynamics *d) {
  return d->h == d->latest - d->t ? d->latest : d->t + d->h;
}

/* The voltage at the step's end: the one that the user holds, or that of the waveform. */
static double end_voltage(const ZpDynamics *d, const ZpMovingMember *m) {
  if (m->state->by_hand) return zp_ramp_value(&m->state->voltage_input, end_time(d));
  return zp_waveform_voltage_before(&m->model->waveform, end_time(d));
}

/* Mean of the load input over the step, N. The input changes linearly, so this mean does its work, eq. (17.5). */
static double mean_load(const ZpDynamics *d, const ZpMovingMember *m) {
  return 0.5 * (zp_state_load(m->model, m->state, d->t) + zp_state_load(m->model, m->state, end_time(d)));
}

/* The step under way. */
static ZpSpan span_of(const ZpDynamics *d, const ZpMovingMember *m) {
  return (ZpSpan){.start = m->start,
                  .end = m->end,
                  .h = d->h,
                  .U0 = m->U0,
                  .U1 = m->U1,
                  .load = mean_load(d, m),
                  .hung = zp_state_hung(m->model, m->state),
                  .own = m->own,
                  .memory = zp_state_memory(m->model, m->state),
                  .bead = m->state->bead,
                  .v0 = zp_state_motion(m->model, m->state).vx,
                  .w = m->state->last_step > 0 ? m->mean_v : NULL,
                  .share = 1,
                  .beyond = zp_state_beyond(m->model, m->state),
                  .pressure = m->pressure,
                  .modulus = zp_pouch_modulus_of_step(&m->model->pouch, d->h)};
}

/* The first member of a port, which has its voltage. */
static ZpMovingMember *lead_of(const ZpMovingPort *port) {
  return &port->of->member[port->first];
}

/* The next member of the same port; NULL: none. */
static ZpMovingMember *next_on_port(ZpMovingMember *m) {
  const size_t further = zp_next_on_port(m->model);
  return further > 0 ? m + further : NULL;
}

/* The charge that all electrodes of a port have taken from its source at the end of the step at its voltage, C,
 * eq. (23.8). */
static double taken_at(const void *self, double U) {
  const ZpMovingPort *port = self;
  double taken = 0;
  for (ZpMovingMember *m = lead_of(port); m; m = next_on_port(m)) {
    ZpSpan span = span_of(port->of, m);
    ZpElectric end = zp_system_electric(m->model, &span, &m->eval, ZP_SPAN_END, zp_voltage_at_port(m->model, U));
    taken += zp_source_share(m->model) * (end.charge + end.passed - m->charge0);
  }
  return taken;
}

/* Their capacitance there between the voltages of the step's start and end, or where these are one above it, F. Capped
 * charges have none. */
static double chord(const ZpMovingPort *port, double taken) {
  static const double same = 1e-9, above = 1e-3; /* of the scale */
  const ZpMovingMember *lead = lead_of(port);
  double U1 = lead->U1, apart = lead->U0 - U1, scale = port->source->scale;
  if (fabs(apart) < same * scale) apart = copysign(above * scale, U1);
  return fmax((taken_at(port, U1 + apart) - taken) / apart, 0);
}

static void ask_source(const ZpDynamics *d, ZpMovingPort *port) {
  const ZpMovingMember *m = lead_of(port);
  double taken = taken_at(port, m->U1);
  port->chord = chord(port, taken);
  ZpSourceStep step = {d->t, d->h, m->U0, m->U1, taken, port->chord, port, taken_at};
  port->law = port->source->law(port->source->self, &step);
}

static bool in_plane(const ZpDynamics *d) {
  return d->plane.bodies > 0;
}

/* Unknowns => nodes, as the member sees them. */
static void place_nodes(const ZpDynamics *d, const ZpMovingMember *m, const ZpPose *pose, const double *q,
                        double *nodes) {
  zp_assembly_place(&m->assembly, q, nodes);
  if (in_plane(d)) zp_plane_from_drawing(&d->plane, (size_t)(m - d->member), pose, nodes);
}

/* Weight of ribbons that stand on bodies in the plane. */
static void add_ribbons(const ZpDynamics *d, const ZpMovingMember *m, double *f) {
  const ZpModel *model = m->model;
  const ZpVector down = zp_turned_back(d->plane.stand[m - d->member].axis, (ZpVector){0, -model->def.gravity});
  for (size_t j = 0; j < model->count; j++) {
    if (zp_is_of_platform(&model->topology, j)) continue;
    zp_assembly_add_one(&m->assembly, zp_x_of(j), model->mass[j] * down.x, f);
    zp_assembly_add_one(&m->assembly, zp_y_of(j), model->mass[j] * down.y, f);
  }
}

/* Forces of the laws of a member => its unknowns and those of its bodies. */
static void add_laws(const ZpDynamics *d, ZpMovingMember *m, double *f) {
  if (!in_plane(d)) {
    zp_assembly_add(&m->assembly, m->force, f);
    return;
  }
  zp_plane_add_force(&d->plane, (size_t)(m - d->member), d->pose0, d->pose1, d->form.inner, m->start, m->end,
                     &m->assembly, m->force, f);
  add_ribbons(d, m, f);
}

/* Mean over the step of what a program sets on a body, which changes linearly, N or N m. */
static double mean_push(const ZpDynamics *d, size_t body, size_t way) {
  const ZpMovingMember *first = d->member;
  const ZpRamp push = zp_state_pushed(first->model, first->state, body, way);
  return 0.5 * (zp_ramp_value(&push, d->t) + zp_ramp_value(&push, end_time(d)));
}

/* Forces that a program sets on bodies. */
static void add_pushes(ZpDynamics *d, double *f) {
  const ZpModel *first = d->member->model;
  if (!zp_is_network(first)) return;
  for (size_t b = 0; b < first->network->bodies; b++) {
    d->push[b] = mean_push(d, b, ZP_WAY_UP);
    for (size_t way = 0; in_plane(d) && way < ZP_WAYS; way++)
      d->links.push[b][way] = mean_push(d, b, way);
  }
  if (!in_plane(d)) zp_springs_add_push(&d->springs, d->push, f);
}

/* Their work over the step, of one part, J. */
static double pushed_bodies(const ZpDynamics *d) {
  const ZpModel *first = d->member->model;
  double work = 0;
  if (!zp_is_network(first)) return 0;
  for (size_t b = 0; b < first->network->bodies; b++) {
    if (!in_plane(d)) {
      work += d->push[b] * (zp_springs_height(&d->springs, b, d->to) - zp_springs_height(&d->springs, b, d->from));
      continue;
    }
    const ZpPose before = zp_plane_place(&d->plane, b, d->pose0), after = zp_plane_place(&d->plane, b, d->pose1);
    const double *push = d->links.push[b];
    work += push[ZP_WAY_ALONG] * (after.x - before.x) + push[ZP_WAY_UP] * (after.y - before.y) +
            push[ZP_WAY_TURNS] * (after.turn - before.turn);
  }
  return work / first->parts;
}

/* => energies of bending and field, with which an imbalance is compared. */
static double begin_one(ZpDynamics *d, ZpMovingMember *m, const double *q0) {
  const ZpModel *model = m->model;
  const ZpEval *e = &m->eval;
  place_nodes(d, m, d->pose0, q0, m->start);
  memcpy(m->end, m->start, zp_coordinates(model) * sizeof *m->end);
  ZpSpan span = span_of(d, m);
  zp_system_begin(model, &span, &m->eval);
  if (m->port) m->charge0 = zp_system_electric(model, &span, &m->eval, ZP_SPAN_START, m->U0).charge;
  double bending = model->is_rod ? zp_rod_bending_energy(&model->rod, &e->rod_start)
                                 : zp_massspring_shear_energy(&model->shear, &e->spring_start);
  double field = model->field ? zp_plates_totals(&model->plates, &e->plates_start, m->U0).potential : 0;
  return bending + fabs(field);
}

static double begin(void *self, const double *q0, const double *v0) {
  ZpDynamics *d = self;
  double energy = zp_springs_energy(&d->springs, q0);
  if (in_plane(d)) zp_plane_poses(&d->plane, d->form.inner, q0, d->pose0);
  (void)v0;
  memcpy(d->from, q0, d->system.n * sizeof *q0);
  for (size_t k = 0; k < d->members; k++)
    energy += begin_one(d, &d->member[k], q0);
  return energy;
}

/* The laws' own unknowns, from all equations. */
static void gather_own(ZpMovingMember *m, const double *q) {
  for (size_t c = 0; c < zp_extra_unknowns(m->model); c++)
    m->own[c] = q[m->assembly.extra_equation[c]];
}

static void add_force(ZpDynamics *d, ZpMovingMember *m, const double *q1, double *f) {
  const ZpModel *model = m->model;
  m->U1 = m->port ? zp_voltage_at_port(model, q1[m->port->unknown]) : end_voltage(d, m);
  place_nodes(d, m, d->pose1, q1, m->end);
  gather_own(m, q1);
  ZpSpan span = span_of(d, m);
  zp_system_force(model, &span, &m->eval, m->force);
  if (model->field) memcpy(m->gap, m->eval.plates.gap, model->nodes * sizeof *m->gap);
  add_laws(d, m, f);
  for (size_t c = 0; c < zp_extra_unknowns(model); c++)
    f[m->assembly.extra_equation[c]] = m->eval.extra_residual[c];
}

static ZpEnd force(void *self, const double *q1, double h, double *f) {
  ZpDynamics *d = self;
  d->h = h;
  memset(f, 0, d->system.n * sizeof *f);
  if (in_plane(d)) zp_plane_poses(&d->plane, d->form.inner, q1, d->pose1);
  for (size_t k = 0; k < d->members; k++)
    add_force(d, &d->member[k], q1, f);
  memcpy(d->to, q1, d->system.n * sizeof *q1);
  add_pushes(d, f);
  if (in_plane(d))
    zp_links_add_force(&d->links, 1, d->pose0, d->pose1, f);
  else
    zp_springs_add_force(&d->springs, 1, d->from, d->to, f);
  for (ZpMovingPort *port = d->port; port < d->port + d->ports; port++) {
    ask_source(d, port);
    f[port->unknown] = port->law.lacks / lead_of(port)->model->parts;
  }
  return ZP_END_FOUND;
}

/* By the slope of the charge, as what it is, of one part of the first member. Beyond a kink of the charge, where it is
 * capped, the slope would lead anywhere: the chord leads back towards the start of the step. */
static double capacitance(const ZpMovingPort *port, double slope) {
  static const double none = 1e-3; /* of the chord */
  const ZpMovingMember *m = lead_of(port);
  double chord = port->chord / m->model->parts;
  bool goes_back = port->law.lacks * (m->U1 - m->U0) < 0;
  return goes_back || slope < none * chord ? fmax(slope, chord) : slope;
}

/* Where a charge is capped, the slope would lead far beyond any voltage. */
static double least_slope(const ZpMovingPort *port) {
  const ZpMovingMember *m = lead_of(port);
  double left = port->law.bound - m->U1;
  return left * port->law.lacks > 0 ? port->law.lacks / left / m->model->parts : 0;
}

/* Row and column of the voltage in the block of a member, by sums over its places [n + border]. */
static void put_voltage(const ZpArrowPart *part, const double *column, const double *row) {
  const size_t n = part->n, border = part->border, u = border - 1;
  for (size_t i = 0; i < n; i++) {
    part->A.beside[u * n + i] = -column[i];
    part->C[u * n + i] = -row[i];
  }
  for (size_t i = 0; i < u; i++) {
    part->A.corner[i * border + u] = -column[n + i];
    part->A.corner[u * border + i] = -row[n + i];
  }
}

/* Row and column of the voltage of a port in the block of one of its members => its part of their capacitance, of one
 * part of the first one, F. */
static double add_electrodes(ZpDynamics *d, const ZpMovingPort *port, ZpMovingMember *m, const ZpArrowPart *part) {
  ZpByVoltage *by = &d->by_voltage;
  const double ratio = zp_part_of_port(m->model), share = zp_source_share(m->model) / lead_of(port)->model->parts;
  ZpSpan span = span_of(d, m);
  zp_system_by_voltage(m->model, &span, &m->eval, by);
  for (size_t i = 0; i < zp_coordinates(m->model); i++) {
    by->force[i] *= ratio;
    by->charge[i] *= port->law.by_taken * share;
  }
  zp_assembly_sum_places(&m->assembly, by->force, d->column);
  zp_assembly_sum_places(&m->assembly, by->charge, d->row);
  put_voltage(part, d->column, d->row);
  return share * ratio * by->capacitance;
}

/* Row and column of the voltage behind a source, eq. (18.10). */
static void add_source(ZpDynamics *d, const ZpMovingPort *port, ZpArrow *J) {
  double C = 0;
  for (ZpMovingMember *m = lead_of(port); m; m = next_on_port(m))
    C += add_electrodes(d, port, m, &J->part[m - d->member]);
  double slope = -port->law.by_taken * capacitance(port, C) - port->law.by_voltage / lead_of(port)->model->parts;
  *J->diagonal[port->unknown] = fmax(slope, least_slope(port));
}

/* Part of the matrix of a member by its bodies in the plane. Unknowns of its nodes are changes as it sees them. */
static void add_stand(const ZpDynamics *d, size_t k, ZpBand *A) {
  const ZpMovingMember *m = &d->member[k];
  const ZpTopology *t = &m->model->topology;
  const size_t left = zp_lower(t, t->platform.first), right = zp_lower(t, t->platform.last);
  const ZpForces f = zp_forces(m->model, m->force);
  const ZpVector own[] = {{f.x[left], f.y[left]}, {f.x[right], f.y[right]}},
                 turn = zp_turned_back(zp_direction(d->pose1[d->plane.stand[k].upper].turn), (ZpVector){1, 0});
  ZpVector force[2]; /* they have been taken to the drawing */
  for (int e = 0; e < 2; e++)
    force[e] = d->plane.stand[k].still ? own[e] : zp_turned(turn, own[e]);
  zp_plane_add_turns(&d->plane, k, d->pose1, &m->assembly, force, 0.5, A);
  zp_plane_add_inertia(&d->plane, k, d->pose1, &m->assembly, 2 / (d->h * d->h), m->end, A);
}

static void tangent(void *self, ZpArrow *J) {
  ZpDynamics *d = self;
  zp_arrow_clear(J);
  for (size_t k = 0; k < d->members; k++) {
    ZpMovingMember *m = &d->member[k];
    ZpSpan span = span_of(d, m);
    if (in_plane(d)) zp_plane_swing(&d->plane, k, d->pose1, &m->assembly);
    zp_system_add_stiffness(m->model, &span, &m->assembly, &m->eval, &J->part[k].A);
    if (in_plane(d)) add_stand(d, k, &J->part[k].A);
  }
  zp_arrow_mirror(J);
  for (const ZpMovingPort *port = d->port; port < d->port + d->ports; port++)
    add_source(d, port, J);
  if (in_plane(d))
    zp_links_add_stiffness(&d->links, 1, d->pose0, d->pose1, false, &J->D);
  else
    zp_springs_add_stiffness(&d->springs, 1, d->from, d->to, false, d->form.inner, &J->D);
  zp_arrow_close(J);
}

/* Entry of a vector of unknowns for the head of mode k at station i. */
static double *head_in(const ZpMovingMember *m, size_t i, int k, double *x) {
  return &x[m->assembly.extra_equation[zp_film_mode_at(i, k)]];
}

/* Forces on the unknowns of a member's nodes => forces as it sees them, each at one node, in `moved`. */
static void see_forces(const ZpDynamics *d, ZpMovingMember *m, const double *r) {
  const int *equation = m->assembly.equation;
  const size_t s = m->model->s;
  const ZpForces to = zp_forces(m->model, m->moved);
  for (size_t j = 0; j < m->model->count; j++) {
    const int x = equation[zp_x_of(j)], y = equation[zp_y_of(j)];
    const bool again = j % s > 0 && x == equation[zp_x_of(j - 1)]; /* of a clip */
    to.x[j] = x >= 0 && !again ? r[x] : 0;
    to.y[j] = y >= 0 && !again ? r[y] : 0;
  }
  zp_plane_turn(&d->plane, (size_t)(m - d->member), d->pose1, false, m->moved);
}

/* The frames of members turn the unknowns of their nodes. */
static void turn_frames(ZpDynamics *d, double *r) {
  for (ZpMovingMember *m = d->member; m < d->member + d->members && in_plane(d); m++) {
    const size_t k = (size_t)(m - d->member);
    if (d->plane.stand[k].still) continue;
    see_forces(d, m, r);
    for (size_t j = 0; j < m->model->count; j++)
      for (size_t c = 0; c < 2; c++) {
        const int equation = m->assembly.equation[zp_x_of(j) + c];
        const bool again = j % m->model->s > 0 && equation == m->assembly.equation[zp_x_of(j - 1) + c];
        if (equation >= 0 && !again) r[equation] = *zp_coordinate(m->model, m->moved, zp_x_of(j) + c);
      }
    zp_plane_carry_back(&d->plane, k, d->pose1, d->form.inner, m->end, m->moved, r);
  }
}

static void turn_frames_back(ZpDynamics *d, double *x) {
  for (ZpMovingMember *m = d->member; m < d->member + d->members && in_plane(d); m++) {
    const size_t k = (size_t)(m - d->member);
    if (d->plane.stand[k].still) continue;
    zp_assembly_changes(&m->assembly, x, m->moved);
    zp_plane_carry(&d->plane, k, d->pose1, d->form.inner, m->end, x, m->moved);
    zp_plane_turn(&d->plane, k, d->pose1, true, m->moved);
    zp_assembly_gather(&m->assembly, m->moved, x);
  }
}

/* The matrix has other unknowns than the heads at stations with a cavity (zp_film_mix). */
static void turn(void *self, double *r) {
  ZpDynamics *d = self;
  turn_frames(d, r);
  if (!d->member->model->has_film) return;
  for (const ZpMovingMember *m = d->member; m < d->member + d->members; m++)
    for (size_t i = 0; i < m->model->nodes; i++) {
      double *first = head_in(m, i, 0, r), *second = head_in(m, i, 1, r);
      *second = zp_film_turned(&m->model->film, d->h, &m->eval.film, i, (const double[]){*first, *second});
    }
}

static void turn_back(void *self, double *x) {
  ZpDynamics *d = self;
  turn_frames_back(d, x);
  if (!d->member->model->has_film) return;
  for (const ZpMovingMember *m = d->member; m < d->member + d->members; m++)
    for (size_t i = 0; i < m->model->nodes; i++)
      *head_in(m, i, 0, x) -= zp_film_mix(&m->model->film, &m->eval.film, i) * *head_in(m, i, 1, x);
}

/* -- faces that meet ------------------------------------------------------------------------------ */

static bool is_platform(const ZpMovingMember *m, size_t i) {
  const ZpJoint *platform = &m->model->topology.platform;
  return i >= platform->first && i <= platform->last;
}

/* The heights of station i: equations and masses of its nodes. A node that is held or missing has an infinite mass.
 * Both ends of a platform that does not turn have equal pairs. */
typedef struct Pair {
  int upper, lower;
  double factor[2];   /* of the upper and of the lower one: 1, or -1 upside down */
  double upper_share; /* of the pair's mass */
  double reduced;     /* mass of their relative motion, kg */
  int sideways[2];    /* in the plane: equations along x of both, */
  ZpVector normal;    /* and the direction in which they part; along y it has the factors */
} Pair;

static Pair pair_of(const ZpMovingMember *m, size_t i) {
  const ZpTopology *t = &m->model->topology;
  const int *equation = m->assembly.equation;
  size_t upper = zp_upper(t, i), lower = zp_lower(t, i);
  const double *factor = m->assembly.factor;
  Pair pair = {zp_is_pair(t) ? equation[zp_y_of(upper)] : -1,
               equation[zp_y_of(lower)],
               {factor[zp_y_of(upper)], factor[zp_y_of(lower)]},
               1,
               0,
               {equation[zp_x_of(upper)], equation[zp_x_of(lower)]},
               m->normal};
  if (pair.lower < 0) return pair;
  double below = m->model->mass[lower] + (is_platform(m, i) ? m->added + m->with[1] : 0);
  pair.reduced = below;
  if (pair.upper < 0) return pair;
  double above = m->model->mass[upper] + (is_platform(m, i) ? m->with[0] : 0), both = above + below;
  pair.upper_share = above / both;
  pair.reduced = above * below / both;
  return pair;
}

/* How fast the faces of a pair part, by the rates of all unknowns. */
static double parting(Pair pair, const double *v) {
  double lower = pair.factor[1] * v[pair.lower];
  if (pair.normal.x != 0 && pair.upper >= 0) lower += pair.normal.x * (v[pair.sideways[1]] - v[pair.sideways[0]]);
  return pair.upper >= 0 ? pair.factor[0] * v[pair.upper] - lower : -lower;
}

/* Bring both nodes of a pair nearer to each other, in positions or rates x of all unknowns. Their centre of mass stays
 * where it is. */
static void bring_nearer(Pair pair, double by, double *x) {
  x[pair.lower] += pair.factor[1] * (by * (pair.upper >= 0 ? pair.upper_share : 1));
  if (pair.upper >= 0) x[pair.upper] -= pair.factor[0] * (by * (1 - pair.upper_share));
  if (pair.normal.x == 0 || pair.upper < 0) return;
  x[pair.sideways[1]] += pair.normal.x * (by * pair.upper_share);
  x[pair.sideways[0]] -= pair.normal.x * (by * (1 - pair.upper_share));
}

/* The height of a node that moves, as its member sees it. */
static double height_at(const ZpDynamics *d, const ZpMovingMember *m, size_t node, const double *q1) {
  if (in_plane(d)) return zp_nodes(m->model, m->end).y[node];
  return zp_assembly_position(&m->assembly, zp_y_of(node), q1);
}

/* A first guess. Faces that overlap keep their overlap, and faces that would pass through each other overlap a little.
 */
static void keep_apart(const ZpDynamics *d, ZpMovingMember *m, double *q1) {
  const ZpModel *model = m->model;
  const ZpTopology *t = &model->topology;
  const double *y = zp_nodes(model, m->start).y, little = 0.5 * model->faces.depth;
  if (in_plane(d)) place_nodes(d, m, d->pose1, q1, m->end);
  for (size_t i = zp_first_apart(t); i < model->nodes; i++) {
    Pair pair = pair_of(m, i);
    if (pair.lower < 0) continue;
    double upper = zp_is_pair(t) ? y[zp_upper(t, i)] : model->plates.face[i];
    if (pair.upper >= 0) upper = height_at(d, m, zp_upper(t, i), q1);
    double overlap = height_at(d, m, zp_lower(t, i), q1) - upper + model->faces.stop;
    double before = m->eval.plates_start.gap[i] - model->faces.stop;
    if (!(overlap > 0) && !(before < 0)) continue;
    overlap += before < 0 ? before : -fmin(little, overlap);
    bring_nearer(pair, -overlap, q1);
  }
}

/* Heads decide on cavities again. */
static void release_cavities(ZpDynamics *d) {
  for (ZpMovingMember *m = d->member; m < d->member + d->members; m++)
    if (m->model->has_film) zp_film_release(&m->model->film, &m->eval.film);
}

/* The search for the pressure of a pouch starts from that of the last step; a neighbouring simulation takes that of the
 * simulation beside it. */
static void start_pressure(const ZpDynamics *d, ZpMovingMember *m) {
  m->pressure = d->lead ? d->lead->member[m - d->member].pressure
                        : zp_memory_pressure(m->model, zp_state_memory(m->model, m->state));
}

static void corrected(void *self, const double *x) {
  ZpDynamics *d = self;
  for (ZpMovingMember *m = d->member; m < d->member + d->members; m++) {
    if (zp_pouch_rank(m->model) == 0) continue;
    const ZpSpan span = span_of(d, m);
    zp_assembly_changes(&m->assembly, x, m->moved);
    m->pressure = zp_pouch_predicted(m->model, &span, &m->eval, m->moved, 1);
    m->eval.memory_end[zp_law(m->model, &zp_term_pouch)->at] = m->pressure;
  }
}

static void attempt(void *self, double *q1) {
  ZpDynamics *d = self;
  d->fewest = SIZE_MAX;
  release_cavities(d);
  if (in_plane(d)) zp_plane_poses(&d->plane, d->form.inner, q1, d->pose1);
  for (ZpMovingMember *m = d->member; m < d->member + d->members; m++) {
    start_pressure(d, m);
    zp_rod_step_begin(&m->model->rod, &m->eval.rod_start, &m->eval.rod_step);
    if (in_plane(d)) m->normal = zp_across(zp_direction(d->pose1[d->plane.stand[m - d->member].upper].turn));
    if (m->model->field) keep_apart(d, m, q1);
  }
}

/* Work of the part of the last correction's change of contact forces and cavities that the tangent did not predict,
 * J. */
static double unforeseen_of_one(const ZpDynamics *d, ZpMovingMember *m, const double *q1) {
  const ZpModel *model = m->model;
  const ZpContactEval *faces = &m->eval.faces;
  double work = 0, *foreseen = m->foreseen, *before = m->gap;
  const double *gap = m->eval.plates.gap;
  place_nodes(d, m, d->pose1, q1, m->end);
  if (!model->field) return 0;
  gather_own(m, q1);
  if (model->has_film) work += zp_film_unforeseen(&model->film, m->own, &m->eval.film);
  zp_plates_gaps(&model->plates, m->end, zp_nodes(model, m->end).y, &m->eval.plates);
  for (size_t i = 0; i < model->nodes; i++)
    foreseen[i] = faces->push[i] - faces->own[i] * (gap[i] - before[i]);
  for (size_t i = 0; i + 1 < model->nodes; i++) {
    foreseen[i] -= faces->next[i] * (gap[i + 1] - before[i + 1]);
    foreseen[i + 1] -= faces->next[i] * (gap[i] - before[i]);
  }
  ZpContactSpan span = zp_contact_span(&model->faces, m->eval.plates_start.gap, gap, d->h);
  zp_contact_eval(&model->faces, &span, faces);
  for (size_t i = zp_first_apart(&model->topology); i < model->nodes; i++)
    work += fabs((faces->push[i] - foreseen[i]) * (gap[i] - m->eval.plates_start.gap[i]));
  return work;
}

static double unforeseen(void *self, const double *q1) {
  ZpDynamics *d = self;
  double work = 0;
  if (in_plane(d)) zp_plane_poses(&d->plane, d->form.inner, q1, d->pose1);
  for (ZpMovingMember *m = d->member; m < d->member + d->members; m++)
    work += unforeseen_of_one(d, m, q1);
  return work;
}

/* Cavities open and close by the last heads, all at once. This may lead to and fro for ever. So they change one by one,
 * which ends, if those that their heads contradict do not become fewer within some iterations. */
static bool choose(void *self, const double *q1) {
  enum { TRIALS = 4 };
  ZpDynamics *d = self;
  size_t contradict = 0, fewest = d->fewest;
  for (ZpMovingMember *m = d->member; m < d->member + d->members; m++) {
    gather_own(m, q1);
    contradict += zp_film_contradictions(&m->model->film, m->own, &m->eval.film);
  }
  bool fewer = contradict < fewest;
  d->trials = fewer ? TRIALS : d->trials - 1;
  d->fewest = contradict == 0 ? SIZE_MAX : fewer ? contradict : fewest;
  if (contradict == 0 || d->trials > 0) {
    release_cavities(d);
    return true;
  }
  for (ZpMovingMember *m = d->member; m < d->member + d->members; m++)
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
static void damp(ZpDynamics *d, const ZpMovingMember *m, size_t i) {
  const ZpJoint *platform = &m->model->topology.platform;
  bool again = i > platform->first && i <= platform->last && !zp_platform_turns(&m->model->topology);
  if (again) return;
  Pair pair = pair_of(m, i);
  if (pair.lower < 0) return;
  double lost = (1 - zp_contact_kept(&m->eval.faces, i, pair.reduced, d->h)) * parting(pair, d->v);
  bring_nearer(pair, lost, d->v);
}

/* Do faces overlap at the step's end without a film that has slowed them down? In a bath there is a film everywhere. */
static bool meets(const ZpMovingMember *m, size_t i) {
  const ZpModel *model = m->model;
  bool filled = model->has_film && (!model->has_bead || zp_film_fills(&model->film, &m->eval.film, i));
  return m->eval.faces.stiffness[i] > 0 && !filled;
}

/* Work that the contact forces of one member have taken over the step, J. */
static double pushed(const ZpMovingMember *m) {
  const double *gap = m->eval.plates.gap, *before = m->eval.plates_start.gap;
  double loss = 0;
  for (size_t i = zp_first_apart(&m->model->topology); i < m->model->nodes; i++)
    loss -= m->eval.faces.push[i] * (gap[i] - before[i]);
  return loss;
}

/* Damp all faces that are in contact. Platforms side by side land together: each takes its part of the velocity that
 * they had before. */
static void damp_all(ZpDynamics *d) {
  for (size_t k = 0; k < d->members; k++) {
    const ZpMovingMember *m = &d->member[k];
    d->lost[k] = 0;
    for (size_t i = zp_first_apart(&m->model->topology); i < m->model->nodes; i++) {
      if (!meets(m, i)) continue;
      const Pair pair = pair_of(m, i);
      if (zp_abreast(m->model) > 1 && is_platform(m, i))
        d->lost[k] += (1 - zp_contact_kept(&m->eval.faces, i, pair.reduced, d->h)) / (double)zp_abreast(m->model) *
                      parting(pair, d->v);
      else
        damp(d, m, i);
    }
  }
  for (size_t k = 0; k < d->members; k++)
    if (d->lost[k] != 0)
      bring_nearer(pair_of(&d->member[k], d->member[k].model->topology.platform.first), d->lost[k], d->v);
}

static bool any_meet(const ZpDynamics *d) {
  for (const ZpMovingMember *m = d->member; m < d->member + d->members; m++)
    for (size_t i = zp_first_apart(&m->model->topology); i < m->model->nodes; i++)
      if (meets(m, i)) return true;
  return false;
}

/* Is there a vibration of masses on contact layers that the step does not resolve? Theory, section 18, Filter. */
static bool misses_layers(const ZpDynamics *d) {
  static const double followed = 4; /* angle by which such a vibration turns in a step, at most */
  double most = followed * followed / (d->h * d->h);
  for (const ZpMovingMember *m = d->member; m < d->member + d->members; m++)
    for (size_t i = zp_first_apart(&m->model->topology); i < m->model->nodes; i++)
      if (meets(m, i) && m->eval.faces.stiffness[i] > most * pair_of(m, i).reduced) return true;
  return false;
}

/* Loss by contact forces over the step, including their damper (9.6), and after it => J. Without a film, if the step
 * does not resolve the vibrations of the layers, motion too fast for the step is removed from velocities after an
 * impact. With a film the damper (9.3) acts instead. */
static double impact(ZpDynamics *d) {
  double loss = 0;
  const bool film = d->member->model->has_film;
  for (size_t k = 0; k < d->members; k++)
    loss += pushed(&d->member[k]);
  d->filters = d->lead ? d->lead->filters : !film && (d->settles || misses_layers(d));
  if (film ? !any_meet(d) : !d->filters) return loss;
  loss += kinetic_energy(d);
  if (film)
    damp_all(d);
  else
    zp_implicit_smooth(&d->stepper, d->h, d->v);
  return loss - kinetic_energy(d);
}

/* A film of thickness H takes momentum in the time H^2 / (12 nu). Where a step is longer, relative velocities of faces
 * would reverse in every step around their mean, so each station loses a share of that difference, eq. (18.14). */
static void settle_film(ZpDynamics *d, const ZpMovingMember *m) {
  static const double thin = 2; /* times the roughness: faces lie on each other */
  const ZpFilmParams *film = &m->model->film;
  for (size_t i = zp_first_apart(&m->model->topology); i < m->model->nodes; i++) {
    Pair pair = pair_of(m, i);
    double H = zp_film_thickness(film, m->eval.plates.gap[i]), drag = 6 * film->mu * d->h;
    if (pair.lower < 0 || H > thin * film->roughness) continue;
    double share = drag / (drag + film->rho * H * H);
    bring_nearer(pair, share * share * share * (parting(pair, d->v) - parting(pair, d->history.w)), d->v);
  }
}

/* -- creation -------------------------------------------------------------------------------------- */

/* Pressures are unknowns of one step, without memory. */
static void add_own(ZpDynamics *d, const ZpMovingMember *m) {
  static const double pressure = 1e9; /* Pa: what counts as much as 1 m of a position: 1 kPa as 1 um */
  for (size_t c = 0; c < zp_extra_unknowns(m->model); c++) {
    d->kind[m->assembly.extra_equation[c]] = ZP_ALGEBRAIC;
    d->scale[m->assembly.extra_equation[c]] = pressure;
  }
}

/* The law of a source is exact for changes of its voltage that are faster than the step, so they have no error. */
static double resolved(void *self, size_t i) {
  const ZpDynamics *d = self;
  const size_t inner = d->system.n - d->ports;
  return i >= inner ? d->port[i - inner].law.resolved : 1;
}

/* Eq. (39.12): layers creep within a step, which its accelerations hardly tell. */
static void add_creep(ZpMovingMember *m, double *e) {
  const double error = zp_rod_maxwell_error(&m->model->rod, &m->eval.rod_step, m->model->L);
  const int *equation = m->assembly.equation;
  const size_t n = 2 * m->model->count;
  for (size_t k = 0; k < n; k++)
    m->moved[k] = equation[k] >= 0 ? e[equation[k]] : 0;
  for (size_t k = 0; k < n && error > 0; k++) /* nodes of a platform have one height in common */
    if (equation[k] >= 0) e[equation[k]] = m->moved[k] + copysign(error, m->moved[k]);
}

/* Of friction of bodies in the plane, and of layers that creep. */
static void overlooks(void *self, const double *v0, double h, double *e) {
  const ZpDynamics *d = self;
  if (in_plane(d)) zp_links_add_overshoot(&d->links, d->pose0, d->pose1, v0, h, e);
  for (ZpMovingMember *m = d->member; m < d->member + d->members; m++)
    if (m->model->rod.branch) add_creep(m, e);
}

static bool creeps(const ZpDynamics *d) {
  bool any = false;
  for (size_t k = 0; k < d->members; k++)
    any |= d->member[k].model->rod.branch != NULL;
  return any;
}

static void inertia(void *self, const double *a, double *f) {
  ZpDynamics *d = self;
  for (ZpMovingMember *m = d->member; m < d->member + d->members; m++) {
    ZpSpan span = span_of(d, m);
    zp_assembly_changes(&m->assembly, a, m->moved);
    zp_system_inertia(m->model, &span, &m->eval, m->moved, m->force);
    zp_assembly_add(&m->assembly, m->force, f);
  }
}

/* Mass of the liquid that an outer face moves up and down at a station, kg. */
static double liquid_at(const ZpModel *model, size_t station) {
  return model->has_film ? zp_outer_side(&model->outer) * zp_film_length(&model->film, station) : 0;
}

/* Of an end of a platform on a body in the plane, against a force on its faces: in the drawing, kg. */
static double mass_of_swing(const ZpDynamics *d, const ZpMovingMember *m, size_t i) {
  const ZpAssembly *a = &m->assembly;
  const ZpSwing *swing = &a->swing[-2 - a->equation[zp_y_of(zp_lower(&m->model->topology, i))]];
  double inverse = 0;
  for (size_t k = 0; k < swing->count; k++)
    inverse += swing->factor[k] * swing->factor[k] / d->mass[swing->equation[k]];
  return 1 / inverse;
}

/* The damper of faces acts within the step. But a film slows faces itself: with a film, faces that meet without liquid
 * are damped after the step. */
static void set_dampers(const ZpDynamics *d, ZpMovingMember *m) {
  const ZpModel *model = m->model;
  for (size_t i = zp_first_apart(&model->topology); i < model->nodes && model->field && !model->has_film; i++) {
    Pair pair = pair_of(m, i);
    const double reduced = pair.lower < -1 ? mass_of_swing(d, m, i) : pair.reduced;
    if (pair.lower >= 0 || (pair.lower < -1 && isfinite(reduced)))
      zp_contact_damp(&model->faces, i, reduced, &m->eval.faces);
  }
}

/* Masses of one member, with `added` on each end that carries the load, kg. */
static void add_masses(ZpDynamics *d, ZpMovingMember *m, double added) {
  const ZpTopology *t = &m->model->topology;
  const int *equation = m->assembly.equation;
  zp_assembly_add_masses(&m->assembly, m->model->mass, d->mass);
  for (size_t j = 0; j < m->model->count && m->model->has_film; j++)
    if (equation[zp_y_of(j)] >= 0) d->mass[equation[zp_y_of(j)]] += liquid_at(m->model, j / m->model->s);
  m->added = added;
  for (size_t i = t->platform.first; added != 0 && i <= t->platform.last; i++)
    for (size_t c = 0; c < 2; c++) {
      int row = equation[zp_x_of(zp_lower(t, i)) + c];
      if (row >= 0) d->mass[row] += added;
    }
}

/* Mass of a node, with what it has caught, kg. */
static double mass_at(const ZpMovingMember *m, size_t node) {
  const ZpTopology *t = &m->model->topology;
  const bool carries = node == zp_lower(t, t->platform.first) || node == zp_lower(t, t->platform.last);
  return m->model->mass[node] + (carries ? m->added : 0);
}

/* Mass of nodes of a member whose height is an unknown of the border => added to `sums` [border], kg. */
static void add_at_border(const ZpDynamics *d, const ZpMovingMember *m, double *sums) {
  for (size_t j = 0; j < m->model->count; j++) {
    const int equation = m->assembly.equation[zp_pulled(&m->model->topology, j)];
    if (equation >= (int)d->form.inner) sums[(size_t)equation - d->form.inner] += mass_at(m, j);
  }
}

/* Mass of nodes of other members that moves with the height of a node, of each half, kg. */
static double mass_of_others(const ZpDynamics *d, const ZpMovingMember *m, size_t node) {
  const ZpTopology *t = &m->model->topology;
  const int equation = m->assembly.equation[zp_pulled(t, node)];
  if (equation < (int)d->form.inner) return 0;
  double own = 0;
  for (size_t j = 0; j < m->model->count; j++)
    if (m->assembly.equation[zp_pulled(t, j)] == equation) own += mass_at(m, j);
  return (d->joined[(size_t)equation - d->form.inner] - own) / (double)zp_halves(t);
}

/* Mass that moves with each platform of the members beyond its own. Platforms side by side land together, each with an
 * equal part of all that they move, so that equal members are as one. */
static void find_joined_masses(ZpDynamics *d) {
  memset(d->joined, 0, (d->form.n - d->form.inner) * sizeof *d->joined);
  for (const ZpMovingMember *m = d->member; m < d->member + d->members; m++)
    add_at_border(d, m, d->joined);
  for (ZpMovingMember *m = d->member; m < d->member + d->members; m++) {
    const ZpTopology *t = &m->model->topology;
    const size_t node[] = {zp_top_node(t), zp_load_node(t)};
    const double abreast = (double)zp_abreast(m->model);
    for (int k = 0; k < 2; k++) {
      const double own = mass_at(m, node[k]), others = mass_of_others(d, m, node[k]);
      m->with[k] = abreast > 1 ? (own + others) / abreast - own : others;
    }
  }
}

/* Masses of all equations in these states; NULL: without what has been caught. */
static void weigh(ZpDynamics *d, ZpState *const state[]) {
  memset(d->mass, 0, d->system.n * sizeof *d->mass);
  for (size_t k = 0; k < d->members; k++)
    add_masses(d, &d->member[k], state ? zp_state_added(d->member[k].model, state[k]) : 0);
  if (in_plane(d)) zp_plane_add_masses(&d->plane, d->form.inner, d->mass);
  if (in_plane(d)) zp_plane_drawn(&d->plane, d->pose1);
  for (size_t k = 0; in_plane(d) && k < d->members; k++)
    zp_plane_swing(&d->plane, k, d->pose1, &d->member[k].assembly);
  find_joined_masses(d);
  for (size_t k = 0; k < d->members; k++)
    set_dampers(d, &d->member[k]);
}

/* The voltage behind a source has a rate and no inertia. All halves have it in common. */
static void add_voltage(ZpDynamics *d, const ZpMovingPort *port) {
  if (d->parts.more > 0) d->parts.common[d->parts.count++] = port->unknown;
  d->kind[port->unknown] = ZP_FIRST_ORDER;
  d->scale[port->unknown] = port->source->scale / d->member->model->L;
  d->sharers[port->unknown] = 0;
  for (ZpMovingMember *m = lead_of(port); m; m = next_on_port(m))
    d->sharers[port->unknown]++;
}

static bool create_member(const ZpModel *first, size_t which, ZpMovingMember *m) {
  const ZpModel *model = m->model = first + which;
  const ZpTies ties = zp_ties_of(first, first->members, which);
  return zp_system_create(model, false, &m->eval) && zp_assembly_create(&ties, model->own, true, &m->assembly);
}

/* Ports with a source, in the order of their first members. False if there is no memory. */
static bool open_ports(ZpDynamics *d, const ZpSource *const source[]) {
  for (size_t k = 0; source && k < d->members; k++)
    d->ports += source[k] != NULL;
  d->port = zp_calloc(d->ports + 1, sizeof *d->port);
  ZpMovingPort *port = d->port;
  for (size_t k = 0; port && source && k < d->members; k++) {
    if (!source[k]) continue;
    *port = (ZpMovingPort){.source = source[k], .of = d, .first = k};
    for (ZpMovingMember *m = &d->member[k]; m; m = next_on_port(m))
      m->port = port;
    port++;
  }
  return d->port != NULL;
}

/* The equations of all members. False if there is no memory. */
static bool join(ZpDynamics *d) {
  ZpAssembly **of = zp_calloc(d->members, sizeof(ZpAssembly *));
  if (!of) return false;
  for (size_t k = 0; k < d->members; k++) {
    of[k] = &d->member[k].assembly;
    of[k]->block.band.rank = zp_pouch_rank(d->member[k].model);
    of[k]->port = d->member[k].port ? d->member[k].port - d->port : -1;
  }
  bool joined = zp_assembly_join(of, d->member->model, d->members, d->ports, &d->form) &&
                zp_assembly_parts(of, d->members, d->form.n, &d->parts);
  if (in_plane(d))
    joined = joined && zp_links_create(&d->plane, d->form.inner, &d->links);
  else
    joined = joined && zp_springs_create(d->member->model, of, &d->springs);
  zp_free(of);
  return joined;
}

/* The system of all members. */
static ZpImplicitSystem system_of(ZpDynamics *d) {
  const bool film = d->member->model->has_film;
  return (ZpImplicitSystem){.n = d->form.n,
                            .form = &d->form,
                            .self = d,
                            .begin = begin,
                            .residual = force,
                            .tangent = tangent,
                            .turn = film || in_plane(d) ? turn : NULL,
                            .turn_back = film || in_plane(d) ? turn_back : NULL,
                            .inertia = film ? inertia : NULL,
                            .attempt = attempt,
                            .resolved = resolved,
                            .overlooks = in_plane(d) || creeps(d) ? overlooks : NULL,
                            .corrected = corrected,
                            .choose = film ? choose : NULL,
                            .unforeseen = unforeseen};
}

/* Each member has the heights of its platforms, in each half. */
static void count_sharers(ZpDynamics *d, const ZpMovingMember *m) {
  const ZpTopology *t = &m->model->topology;
  for (size_t j = zp_upper(t, t->platform.first); j <= zp_lower(t, t->platform.last); j++) {
    int height = m->assembly.equation[zp_pulled(t, j)];
    if (height >= 0) d->sharers[height] += 1 / (double)zp_halves(t);
  }
}

static void fill_equations(ZpDynamics *d) {
  for (size_t i = 0; i < d->system.n; i++)
    d->scale[i] = 1;
  for (size_t k = 0; k < d->members; k++)
    add_own(d, &d->member[k]);
  for (const ZpMovingMember *m = d->member; m < d->member + d->members && d->members > 1; m++)
    count_sharers(d, m);
  weigh(d, NULL);
  d->system.mass = d->mass;
  d->system.sharers = d->members > 1 ? d->sharers : NULL;
  for (ZpMovingPort *port = d->port; port < d->port + d->ports; port++) {
    port->unknown = d->system.n - d->ports + (size_t)(port - d->port);
    add_voltage(d, port);
  }
  d->system.parts = d->parts;
  if (d->ports == 0 && d->member->model->own == 0) return;
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

/* The usual first step, s; of small devices a thousandth of the time in which a ribbon bends. */
static double first_step_of(const ZpModel *model, double usual) {
  static const double of_settling = 1.0 / 64, shortest = 1e-12; /* s */
  double first = usual;
  for (const ZpModel *m = model; m < model + model->members; m++)
    first = fmin(first, of_settling * m->faces.settling);
  return fmax(first, shortest);
}

bool zp_dynamics_create(const ZpModel *model, const ZpSource *const source[], ZpDynamics *d) {
  *d = (ZpDynamics){.members = model->members};
  d->member = zp_calloc(d->members, sizeof *d->member);
  if (!d->member) return false;
  for (size_t k = 0; k < d->members; k++)
    if (!create_member(model, k, &d->member[k])) return false;
  if (!zp_plane_create(model, &d->plane) || !open_ports(d, source) || !join(d)) return false;
  d->system = system_of(d);
  d->memory = zp_calloc(1, reserve(d, NULL));
  if (!d->memory) return false;
  reserve(d, d->memory);
  fill_equations(d);
  const ZpActuatorDef *def = &model->def;
  d->error = error_of_step(def);
  d->stepper.balance = 2e-6 * d->error;
  d->stepper.fixed = isnan(def->solver.time_step) ? 0 : def->solver.time_step;
  d->stepper.first = first_step_of(model, d->stepper.first);
  return true;
}

void zp_dynamics_destroy(ZpDynamics *d) {
  for (size_t k = 0; d->member && k < d->members; k++) {
    zp_assembly_destroy(&d->member[k].assembly);
    zp_system_destroy(&d->member[k].eval);
  }
  zp_springs_destroy(&d->springs);
  zp_links_destroy(&d->links);
  zp_plane_destroy(&d->plane);
  zp_arrow_form_destroy(&d->form);
  zp_free(d->parts.common);
  zp_free(d->port);
  zp_free(d->member);
  zp_free(d->memory);
  d->member = NULL;
  d->memory = NULL;
}

/* -- a step ---------------------------------------------------------------------------------------- */

/* The source's work over a step in which the voltage has changed, eq. (18.4): the mean of "first the voltage, then the
 * gaps" and "first the gaps, then the voltage". The account adds U (Q - base_charge) where it is read; the rest is
 * here. */
static void book_work(const ZpDynamics *d, ZpMovingMember *m, ZpState *state) {
  double U0 = m->U0, U1 = m->U1;
  if (U0 == U1) return;
  ZpSpan span = span_of(d, m);
  zp_eval_cover(m->model, m->eval.reach, &m->eval);
  double at_start = zp_system_electric(m->model, &span, &m->eval, ZP_SPAN_START, U1).potential -
                    zp_system_electric(m->model, &span, &m->eval, ZP_SPAN_START, U0).potential;
  double at_end = zp_system_electric(m->model, &span, &m->eval, ZP_SPAN_END, U1).potential -
                  zp_system_electric(m->model, &span, &m->eval, ZP_SPAN_END, U0).potential;
  state->work += (U1 - U0) * state->base_charge + 0.5 * (at_start + at_end);
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
  const ZpModel *model = d->member->model;
  double reference = far(model, state);
  d->stepper.accuracy = d->error * reference;
  for (const ZpMovingPort *port = d->port; port < d->port + d->ports; port++)
    d->scale[port->unknown] = port->source->scale * of_length / reference;
}

/* Places or rates of nodes, as the member sees them => of its unknowns. */
static void gather(const ZpDynamics *d, ZpMovingMember *m, bool rates, const double *nodes, double *unknowns) {
  const size_t k = (size_t)(m - d->member);
  if (in_plane(d)) {
    memcpy(m->moved, nodes, zp_coordinates(m->model) * sizeof *nodes);
    if (rates)
      zp_plane_turn(&d->plane, k, d->pose0, true, m->moved);
    else
      zp_plane_to_drawing(&d->plane, k, d->pose0, m->moved);
    nodes = m->moved;
  }
  zp_assembly_gather(&m->assembly, nodes, unknowns);
}

/* Rates of the unknowns at the end of the step => of nodes, as the member sees them. */
static void spread(const ZpDynamics *d, const ZpMovingMember *m, const double *unknowns, double *nodes) {
  const size_t k = (size_t)(m - d->member);
  zp_assembly_changes(&m->assembly, unknowns, nodes);
  if (!in_plane(d)) return;
  zp_plane_turn(&d->plane, k, d->pose1, false, nodes);
  zp_plane_put_rates(&d->plane, k, d->pose1, d->form.inner, unknowns, nodes);
}

/* Bodies in the plane, from the state of the first member and back. */
static void load_bodies(ZpDynamics *d, ZpState *state) {
  const size_t n = d->plane.first->network->unknowns, inner = d->form.inner;
  const double *from = zp_state_bodies(d->plane.first, state);
  double *const to[] = {d->q, d->v, d->history.w, d->history.a};
  for (size_t k = 0; k < 4; k++)
    memcpy(to[k] + inner, from + k * n, n * sizeof *from);
  memcpy(d->links.strain, zp_state_strains(d->plane.first, state), d->plane.first->network->springs * sizeof *from);
  zp_plane_poses(&d->plane, inner, d->q, d->pose0);
  memcpy(d->pose1, d->pose0, d->plane.bodies * sizeof *d->pose0);
}

static void store_bodies(const ZpDynamics *d, ZpState *state) {
  const size_t n = d->plane.first->network->unknowns;
  double *to = zp_state_bodies(d->plane.first, state);
  const double *const from[] = {d->q, d->v, d->history.w, d->history.a};
  for (size_t k = 0; k < 4; k++)
    memcpy(to + k * n, from[k] + d->form.inner, n * sizeof *to);
}

/* The state of one member at the start of the step => q, v and what else evolves. */
static void load_one(ZpDynamics *d, ZpMovingMember *m, ZpState *state) {
  const ZpModel *model = m->model;
  m->state = state;
  m->U0 = state->U;
  m->mean_v = zp_state_mean_v(model, state);
  memcpy(m->start, zp_state_q(model, state), zp_coordinates(model) * sizeof *m->start);
  const double *const from[] = {zp_state_q(model, state), zp_state_v(model, state), m->mean_v,
                                zp_state_mean_a(model, state)};
  double *const to[] = {d->q, d->v, d->history.w, d->history.a};
  for (int k = 0; k < 4; k++)
    gather(d, m, k > 0, from[k], to[k]);
  const double *own = zp_state_own(model, state);
  for (size_t c = 0; c < zp_extra_unknowns(model); c++) {
    size_t i = (size_t)m->assembly.extra_equation[c];
    m->own[c] = d->q[i] = own[c];
    d->v[i] = d->history.w[i] = d->history.a[i] = 0;
  }
}

/* Of all: a coordinate that members share is that of the first one. */
static void load(ZpDynamics *d, ZpState *const state[]) {
  if (in_plane(d)) load_bodies(d, state[0]);
  for (size_t k = d->members; k-- > 0;)
    load_one(d, &d->member[k], state[k]);
  for (const ZpMovingPort *port = d->port; port < d->port + d->ports; port++) {
    const ZpState *lead = state[port->first];
    d->q[port->unknown] = lead->U;
    d->v[port->unknown] = 0;
    d->history.w[port->unknown] = lead->U_rate;
    d->history.a[port->unknown] = lead->U_change;
  }
  d->history.last = state[0]->last_step;
  d->history.next = state[0]->next_step;
}

/* Motion and the laws' own numbers at the end of the step => state. */
static void store(const ZpDynamics *d, const ZpMovingMember *m, ZpState *state) {
  const ZpModel *model = m->model;
  place_nodes(d, m, d->pose1, d->q, zp_state_q(model, state));
  spread(d, m, d->v, zp_state_v(model, state));
  spread(d, m, d->history.w, zp_state_mean_v(model, state));
  spread(d, m, d->history.a, zp_state_mean_a(model, state));
  if (in_plane(d) && model->number == 0) store_bodies(d, state);
  memcpy(zp_state_own(model, state), m->own, zp_extra_unknowns(model) * sizeof *m->own);
  memcpy(zp_state_own(model, state) + zp_extra_unknowns(model), m->eval.memory_end, model->kept * sizeof *m->own);
  state->t = end_time(d);
  if (model->has_bead) memcpy(state->bead, m->eval.bead_end, sizeof state->bead);
  if (m->port) {
    state->U_rate = d->history.w[m->port->unknown];
    state->U_change = d->history.a[m->port->unknown];
  }
  state->last_step = d->history.last;
  state->next_step = d->history.next;
}

/* Catch a mass on one member. Each coordinate of the load's nodes keeps its momentum: the impact does not affect the
 * strips. */
static void catch_mass(ZpDynamics *d, const ZpMovingMember *m) {
  const ZpModel *model = m->model;
  const ZpTopology *t = &model->topology;
  double each = zp_end_share(model) * model->def.load.change_mass;
  double fast = sqrt(2 * model->def.gravity * model->def.load.drop_height);
  for (size_t c = 0; c < 2 && each > 0; c++) {
    size_t coordinate = zp_x_of(zp_load_node(t)) + c;
    int row = m->assembly.equation[coordinate];
    if (row < 0) continue;
    size_t ends = m->assembly.equation[zp_x_of(zp_lower(t, t->platform.last)) + c] == row ? zp_halves(t) : 1;
    double comes = (double)ends * each, falls = m->assembly.factor[coordinate] * fast * model->fall[c];
    d->v[row] = (d->mass[row] * d->v[row] + comes * falls) / (d->mass[row] + comes);
    d->mass[row] += comes;
  }
}

void zp_dynamics_change_load(ZpDynamics *d, ZpState *const state[]) {
  weigh(d, state);
  for (size_t k = 0; k < d->members; k++)
    zp_assembly_gather(&d->member[k].assembly, zp_state_v(d->member[k].model, state[k]), d->v);
  for (size_t k = 0; k < d->members; k++)
    catch_mass(d, &d->member[k]);
  for (size_t k = 0; k < d->members; k++) {
    const ZpModel *model = d->member[k].model;
    zp_assembly_changes(&d->member[k].assembly, d->v, zp_state_v(model, state[k]));
    memcpy(zp_state_mean_v(model, state[k]), zp_state_v(model, state[k]), zp_coordinates(model) * sizeof *d->v);
    memset(zp_state_mean_a(model, state[k]), 0, zp_coordinates(model) * sizeof *d->v);
    state[k]->last_step = state[k]->next_step = 0;
  }
}

/* Motion, work and losses of one member over a step. */
static void book(ZpDynamics *d, ZpMovingMember *m, ZpState *state) {
  const ZpModel *model = m->model;
  gather_own(m, d->q);
  ZpSpan span = span_of(d, m);
  zp_system_book(model, &span, &m->eval, state);
  if (m->port) m->charge1 = zp_system_electric(model, &span, &m->eval, ZP_SPAN_END, m->U1).charge;
  if (model->leaks) { /* the source works on what insulators conduct */
    double passed = zp_leak_passed(&m->eval.leak);
    state->leaked += passed;
    state->work += 0.5 * (m->U0 + m->U1) * passed;
  }
  if (model->field) book_work(d, m, state);
}

/* Impacts and menisci change the velocities of all members; their losses are booked with the first one. A meniscus that
 * passes a station gives it a film at once. Where the film's resistance far exceeds the inertia of the ribbons, the
 * difference of velocities from the mean of the step would reverse in every step, so the part of it that is too fast
 * for the step is removed. */
static void book_impacts(ZpDynamics *d, ZpState *state) {
  const ZpModel *model = d->member->model;
  if (!model->field) return;
  *zp_state_row(model, state, &zp_row_contact_loss) += impact(d);
  if (!model->has_film) return;
  double before = kinetic_energy(d);
  if (model->has_bead)
    zp_implicit_filter(&d->stepper, d->h, d->history.w, d->v);
  else
    for (size_t k = 0; k < d->members; k++)
      settle_film(d, &d->member[k]);
  *zp_state_row(model, state, &zp_row_film_across_loss) += before - kinetic_energy(d);
}

/* Store the state at the step's end, and book the work of the load input. */
static void arrive(const ZpDynamics *d, const ZpMovingMember *m, ZpState *state) {
  const ZpModel *model = m->model;
  const ZpNodes at = zp_nodes(model, zp_state_q(model, state));
  double before = zp_load_down(model, at), hung = mean_load(d, m);
  store(d, m, state);
  state->load_work += hung * (zp_load_down(model, at) - before);
  if (model->field) state->zip = zp_eval_touching(model, m->eval.plates.gap);
}

void zp_dynamics_begin(ZpDynamics *d, ZpState *const state[], double latest) {
  bool changed = false;
  d->t = state[0]->t;
  d->latest = latest;
  for (size_t k = 0; k < d->members; k++)
    changed |= d->member[k].added != zp_state_added(d->member[k].model, state[k]);
  if (changed) weigh(d, state);
  load(d, state);
}

/* Friction between bodies in the plane takes what slides; its loss is booked with the first member. */
static void book_friction(ZpDynamics *d, ZpState *state) {
  const ZpModel *first = d->plane.first;
  if (!in_plane(d)) return;
  *zp_state_row(first, state, &zp_row_contact_loss) +=
      zp_links_slide(&d->links, d->pose0, d->pose1, zp_state_strains(first, state));
}

void zp_dynamics_end(ZpDynamics *d, ZpState *const state[]) {
  release_cavities(d);
  memcpy(d->to, d->q, d->system.n * sizeof *d->q);
  state[0]->load_work += pushed_bodies(d);
  book_friction(d, state[0]);
  for (size_t k = 0; k < d->members; k++)
    book(d, &d->member[k], state[k]);
  book_impacts(d, state[0]);
  for (size_t k = 0; k < d->members; k++)
    arrive(d, &d->member[k], state[k]);
}

double zp_dynamics_step(ZpDynamics *d, ZpState *const state[], double latest) {
  zp_dynamics_begin(d, state, latest);
  set_accuracy(d, state[0]);
  double taken = zp_implicit_step(&d->stepper, latest - state[0]->t, d->q, d->v, &d->history);
  if (taken > 0) zp_dynamics_end(d, state);
  return taken;
}

/* Set the force of the link to a member: its own mass times its acceleration, minus its own forces, eq. (29.5). */
void zp_dynamics_book_link(ZpDynamics *d, size_t which, ZpState *before, ZpState *state) {
  ZpMovingMember *m = &d->member[which];
  const ZpModel *model = m->model;
  const ZpTopology *t = &model->topology;
  m->state = before;
  m->mean_v = zp_state_mean_v(model, before);
  ZpSpan span = span_of(d, m);
  span.beyond = zp_state_beyond(model, state);
  zp_system_force(model, &span, &m->eval, m->force);
  state->link_force = 0;
  for (size_t i = t->platform.first; i <= t->platform.last; i++) {
    const size_t j = zp_lower(t, i);
    double mass = model->mass[j] + m->added + liquid_at(model, i);
    state->link_force += mass * d->history.a[m->assembly.equation[zp_y_of(j)]] - zp_nodes(model, m->force).y[j];
  }
}
