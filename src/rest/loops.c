/* The coordinates are the lowest vibrations of the whole, and of each port the shapes in which its voltage bends it
 * slowly and faster (Krylov's space): eq. (28.12). */
#include "rest/loops.h"

#include <math.h>
#include <string.h>

#include "math/complex_solve.h"
#include "math/vector.h"
#include "rest/vibration.h"

enum { KRYLOV = 4 };

static const ZpModel *lead_of(const ZpStatics *s, const ZpLoop *loop) {
  return s->member[loop->lead].model;
}

static size_t lower_of(const ZpStatics *s, size_t which) {
  return s->model->network->ends[which].lower;
}

/* -- signals --------------------------------------------------------------------------------------- */

double zp_loop_signal(ZpRest *rest, const ZpLoop *loop) {
  ZpStatics *s = &rest->statics;
  double sum = 0;
  switch (lead_of(s, loop)->def.control.signal) {
  case ZP_CONTROL_STROKE:
    return zp_statics_member_stroke(s, loop->lead);
  case ZP_CONTROL_CONTRACTION:
    return zp_contraction(lead_of(s, loop), zp_statics_member_opening(s, loop->lead), loop->hanging);
  case ZP_CONTROL_ANGLE:
    return zp_statics_places(s)[lower_of(s, loop->lead)].turn;
  case ZP_CONTROL_CAPACITANCE:
    for (size_t k = loop->lead, next = 1; next > 0; k += next) {
      sum += zp_statics_member_capacitance(s, k);
      next = zp_next_on_port(s->member[k].model);
    }
    return sum;
  default:
    return zp_statics_member_opening(s, loop->lead);
  }
}

/* How all unknowns x [n] move the nodes of a member, as it sees them => moved. */
static ZpNodes moved_by(ZpStatics *s, size_t which, const double *x) {
  ZpRestMember *m = &s->member[which];
  memset(m->moved, 0, zp_coordinates(m->model) * sizeof *m->moved);
  zp_assembly_changes(&m->assembly, x, m->moved);
  return zp_nodes(m->model, m->moved);
}

/* Change of the capacitance of a member along x, F. */
static double capacitance_along(ZpStatics *s, size_t which, const double *x) {
  ZpRestMember *m = &s->member[which];
  ZpSpan span = zp_statics_span(s, which);
  ZpByVoltage by = {.force = m->force, .of_charge = true};
  span.U0 = span.U1 = 1; /* U dC / dq */
  zp_system_by_voltage(m->model, &span, &m->eval, &by);
  moved_by(s, which, x);
  return m->model->parts * zp_dot(zp_coordinates(m->model), m->force, m->moved);
}

/* Change of the angle of the lower body of a member along x, rad. */
static double angle_along(const ZpStatics *s, size_t which, const double *x) {
  const long unknown = zp_network_unknown(s->model->network, lower_of(s, which), ZP_WAY_TURNS);
  return unknown >= 0 ? x[s->form.inner + (size_t)unknown] / s->plane.length : 0;
}

/* Change of the signal along x. */
static double signal_along(ZpStatics *s, const ZpLoop *loop, const double *x) {
  const ZpModel *model = lead_of(s, loop);
  double sum = 0;
  switch (model->def.control.signal) {
  case ZP_CONTROL_STROKE:
    return zp_stroke_change(model, moved_by(s, loop->lead, x));
  case ZP_CONTROL_CONTRACTION:
    return zp_contraction_slope(model, loop->hanging) * zp_opening(&model->topology, moved_by(s, loop->lead, x).y);
  case ZP_CONTROL_ANGLE:
    return angle_along(s, loop->lead, x);
  case ZP_CONTROL_CAPACITANCE:
    for (size_t k = loop->lead, next = 1; next > 0; k += next) {
      sum += capacitance_along(s, k, x);
      next = zp_next_on_port(s->member[k].model);
    }
    return sum;
  default:
    return zp_opening(&model->topology, moved_by(s, loop->lead, x).y);
  }
}

/* -- the equilibrium at all setpoints -------------------------------------------------------------- */

typedef struct Search {
  ZpRest *rest;
  ZpLoop *loop;
  size_t loops;
  double *voltage;               /* [members] of ports */
  double *start, *square, *kept; /* [loops] signals where all hangs; squares of voltages, V^2 */
  double *step, *by;             /* [n], [loops][n] */
  double *state;                 /* a point to go back to */
  ZpComplex *J, *rhs;            /* [loops^2], [loops] */
  void *memory;
} Search;

static size_t reserve(Search *f, void *block) {
  ZpArena arena = {block, 0};
  const size_t n = f->rest->statics.n;
  double **of_loops[] = {&f->start, &f->square, &f->kept};
  for (size_t k = 0; k < sizeof of_loops / sizeof of_loops[0]; k++)
    *of_loops[k] = zp_arena_take(&arena, f->loops);
  f->step = zp_arena_take(&arena, n);
  f->by = zp_arena_take(&arena, f->loops * n);
  f->state = zp_arena_take(&arena, zp_rest_save_size(f->rest));
  f->J = zp_arena_take_of(&arena, f->loops * f->loops, sizeof *f->J);
  f->rhs = zp_arena_take_of(&arena, f->loops, sizeof *f->rhs);
  return arena.used;
}

/* Voltages at a share of the way: of controllers as they are now, of all others that share. */
static void set_voltages(Search *f, double share) {
  const ZpStatics *s = &f->rest->statics;
  for (size_t k = 0; k < s->members; k++)
    f->voltage[k] = share * zp_port_voltage(s->member[k].model, s->model->whole->drive.voltage);
  for (size_t i = 0; i < f->loops; i++)
    f->voltage[f->loop[i].lead] = sqrt(f->square[i]);
}

static double left(const Search *f, size_t i, double share) {
  const double way = f->loop[i].setpoint - f->start[i];
  return f->start[i] + share * way - zp_loop_signal(f->rest, &f->loop[i]);
}

/* The largest distance from the setpoints at this share of the way, over the whole way. */
static double distance(const Search *f, double share) {
  double most = 0;
  for (size_t i = 0; i < f->loops; i++)
    if (f->loop[i].acts) most = fmax(most, fabs(left(f, i, share) / (f->loop[i].setpoint - f->start[i])));
  return most;
}

/* Shapes by the squares of voltages, whose forces are those at 1 V while there is none. */
static void find_shapes(Search *f) {
  ZpStatics *s = &f->rest->statics;
  for (size_t i = 0; i < f->loops; i++) {
    double *by = f->by + i * s->n, U = fmax(sqrt(f->square[i]), 1);
    zp_statics_by_port(s, f->loop[i].lead, U, by);
    for (size_t j = 0; j < s->n; j++)
      by[j] /= 2 * U;
    zp_arrow_solve(&s->newton.K, by);
  }
}

/* Changes of the squares that lead to the setpoints, beside the step without them => rhs. False if there are none. */
static bool find_squares(Search *f, double share) {
  ZpStatics *s = &f->rest->statics;
  for (size_t i = 0; i < f->loops; i++) {
    const ZpLoop *loop = &f->loop[i];
    f->rhs[i] = (ZpComplex){loop->acts ? left(f, i, share) - signal_along(s, loop, f->step) : 0, 0};
    for (size_t j = 0; j < f->loops; j++) {
      const bool both = loop->acts && f->loop[j].acts;
      f->J[i * f->loops + j] = (ZpComplex){both ? signal_along(s, loop, f->by + j * s->n) : i == j, 0};
    }
  }
  return zp_complex_solve(f->loops, f->J, f->rhs);
}

/* One step of Newton's method for positions and voltages together, eq. (28.11). False if there is none. */
static bool improve(Search *f, double share) {
  ZpStatics *s = &f->rest->statics;
  const ZpStaticSystem system = zp_statics_system(s);
  system.stiffness(s, &s->newton.K, f->step);
  if (!zp_arrow_factor(&s->newton.K)) return false;
  zp_arrow_solve(&s->newton.K, f->step);
  find_shapes(f);
  if (!find_squares(f, share)) return false;
  for (size_t i = 0; i < f->loops; i++)
    for (size_t j = 0; f->loop[i].acts && j < s->n; j++)
      f->step[j] += f->rhs[i].re * f->by[i * s->n + j];
  const double length = system.length(s, f->step), part = length > 1 ? 1 / length : 1;
  if (!isfinite(length)) return false;
  system.move(s, f->step, part);
  for (size_t i = 0; i < f->loops; i++)
    if (f->loop[i].acts) f->square[i] = fmax(f->square[i] + part * f->rhs[i].re, 0);
  return true;
}

static bool reach(Search *f, double share) {
  enum { MOST = 40 };
  static const double near = 1e-9;
  ZpStatics *s = &f->rest->statics;
  const ZpStaticSystem system = zp_statics_system(s);
  for (int k = 0; k < MOST; k++) {
    double size;
    set_voltages(f, share);
    if (system.residual(s, f->step, &size) != ZP_END_FOUND) return false;
    if (k > 0 && size < zp_statics_tolerance(s) && distance(f, share) < near) return !zp_statics_fault(s);
    if (!improve(f, share)) return false;
  }
  return false;
}

static void keep(Search *f) {
  zp_rest_save(f->rest, f->state);
  memcpy(f->kept, f->square, f->loops * sizeof *f->kept);
}

static void go_back(Search *f) {
  f->rest->system.restore(&f->rest->statics, f->state);
  memcpy(f->square, f->kept, f->loops * sizeof *f->square);
}

static bool hang(Search *f) {
  ZpStatics *s = &f->rest->statics;
  set_voltages(f, 0);
  s->ports = f->voltage;
  if (!zp_newton_good(zp_statics_find_rest(s).end)) return false;
  for (size_t i = 0; i < f->loops; i++) {
    ZpLoop *loop = &f->loop[i];
    loop->hanging = zp_statics_member_opening(s, loop->lead);
    f->start[i] = zp_loop_signal(f->rest, loop);
    loop->acts = lead_of(s, loop)->control.sense * (f->start[i] - loop->setpoint) > 0;
  }
  return true;
}

/* Controllers that stay at 0 V may be at their setpoints, too: others lead them there. */
static void see_who_misses(const Search *f) {
  static const double near = 1e-6;
  for (size_t i = 0; i < f->loops; i++) {
    ZpLoop *loop = &f->loop[i];
    loop->misses = !loop->acts && fabs(left(f, i, 1)) > near * fabs(loop->setpoint - f->start[i]);
  }
}

static bool follow(Search *f) {
  static const double first = 0.05, longest = 0.25, shortest = 1e-6;
  double share = 0, step = first;
  if (!hang(f)) return false;
  keep(f);
  while (share < 1 && step > shortest) {
    const double to = fmin(share + step, 1);
    if (reach(f, to)) {
      share = to;
      step = fmin(2 * step, longest);
      keep(f);
    } else {
      go_back(f);
      step *= 0.25;
    }
  }
  set_voltages(f, share);
  see_who_misses(f);
  return share == 1;
}

bool zp_loops_find(ZpRest *rest, ZpLoop *loop, size_t loops, double *voltage, bool *found) {
  Search f = {.rest = rest, .loop = loop, .loops = loops, .voltage = voltage};
  f.memory = zp_calloc(1, reserve(&f, NULL));
  if (!f.memory) return false;
  reserve(&f, f.memory);
  *found = follow(&f);
  zp_free(f.memory);
  return true;
}

/* -- small motions --------------------------------------------------------------------------------- */

typedef struct Basis {
  ZpStatics *at;
  ZpVibration vibration;
  size_t m, most;
  double *shape; /* [most][n] of mass 1 each, orthogonal */
  double *x;     /* [n] */
  double *K, *D; /* [m][m] */
  double *push;  /* [m] forces by the voltage of a port, N/V */
  void *memory;
} Basis;

static size_t reserve_basis(Basis *w, void *block) {
  ZpArena arena = {block, 0};
  const size_t n = w->at->n;
  zp_vibration_reserve(&w->vibration, n, ZP_VIBRATIONS, &arena);
  w->shape = zp_arena_take(&arena, w->most * n);
  w->x = zp_arena_take(&arena, n);
  w->K = zp_arena_take(&arena, w->most * w->most);
  w->D = zp_arena_take(&arena, w->most * w->most);
  w->push = zp_arena_take(&arena, w->most);
  return arena.used;
}

/* Add what x has beyond the other shapes, with mass 1 => is there anything? */
static bool add_shape(Basis *w, const double *x) {
  static const double least = 1e-12;
  ZpVibration *v = &w->vibration;
  double *shape = w->shape + w->m * v->n;
  if (w->m == w->most || w->m == v->n) return false;
  const double before = zp_vibration_inner(v, x, x);
  memcpy(shape, x, v->n * sizeof *shape);
  zp_vibration_take_out(v, w->shape, w->m, shape);
  const double after = zp_vibration_inner(v, shape, shape);
  if (!(after > least * before)) return false;
  for (size_t i = 0; i < v->n; i++)
    shape[i] /= sqrt(after);
  w->m++;
  return true;
}

/* The static response to a port's voltage, then to the inertia of the response before. */
static void add_responses(Basis *w, size_t lead) {
  ZpStatics *s = w->at;
  zp_statics_by_port(s, lead, s->ports[lead], w->x);
  for (int k = 0; k < KRYLOV; k++) {
    zp_arrow_solve(&s->newton.K, w->x);
    if (!add_shape(w, w->x)) return;
    zp_statics_weigh(s, w->shape + (w->m - 1) * s->n, w->x);
  }
}

/* The matrix of the last stiffness by the shapes => reduced [m][m]. */
static void project(Basis *w, double *reduced) {
  const size_t n = w->at->n;
  for (size_t j = 0; j < w->m; j++) {
    zp_arrow_multiply(&w->at->newton.K, w->shape + j * n, w->x);
    for (size_t k = 0; k < w->m; k++)
      reduced[k * w->m + j] = zp_dot(n, w->shape + k * n, w->x);
  }
}

/* False if the stiffness is singular. */
static bool find_basis(Basis *w) {
  ZpStatics *s = w->at;
  ZpVibration *v = &w->vibration;
  zp_statics_exact_stiffness(s);
  if (!zp_arrow_factor(&s->newton.K)) return false;
  v->K = &s->newton.K;
  v->weigh = zp_statics_weigh;
  v->self = s;
  zp_vibration_start(v);
  zp_vibration_solve(v, v->m - v->m / 3);
  for (size_t j = 0; j < v->m; j++)
    add_shape(w, v->u + j * v->n);
  for (size_t k = 0; k < s->members; k++)
    if (zp_leads_port(s->member[k].model)) add_responses(w, k);
  zp_statics_exact_stiffness(s);
  project(w, w->K);
  zp_statics_internal_damping(s);
  project(w, w->D);
  return true;
}

/* Derivative of the charge of a port by its voltage, F. */
static double capacitance_of_port(ZpStatics *s, size_t lead) {
  const double U = s->ports[lead], by = 1e-4 * fmax(U, 1);
  double sum = 0;
  for (size_t k = lead, next = 1; next > 0; k += next) {
    const ZpRestMember *m = &s->member[k];
    ZpSpan here = zp_statics_span(s, k);
    const double more =
        zp_system_electric(m->model, &here, &m->eval, ZP_SPAN_END, zp_voltage_at_port(m->model, U + by)).charge;
    const double less =
        zp_system_electric(m->model, &here, &m->eval, ZP_SPAN_END, zp_voltage_at_port(m->model, U - by)).charge;
    sum += zp_source_share(m->model) * (more - less) / (2 * by);
    next = zp_next_on_port(m->model);
  }
  return sum;
}

/* Where the state has the inner voltage and the voltage of the electrodes of a port; 0: nowhere. */
typedef struct Voltages {
  size_t inner, electrodes;
} Voltages;

/* => number of states behind. */
static size_t place(const ZpSupply *supply, size_t from, Voltages *at) {
  const bool lags = supply->acts && isfinite(zp_supply_lag_rate(supply, 0)),
             resists = supply->acts && supply->resistance > 0;
  *at = (Voltages){lags ? from : 0, resists ? from + lags : 0};
  return from + lags + resists;
}

static size_t states_of(const Basis *w) {
  size_t n = 2 * w->m;
  Voltages at;
  for (size_t k = 0; k < w->at->members; k++)
    if (zp_leads_port(w->at->member[k].model)) n = place(&w->at->member[k].model->supply, n, &at);
  return n;
}

/* (23.4) for small changes: (C_p + dQ/dU) U' = (V - U) / R - G U - dQ/dt at that U. */
static void fill_electrodes(Basis *w, size_t lead, Voltages at, double *b, ZpPlant *plant) {
  const ZpModel *model = w->at->member[lead].model;
  const ZpSupply *supply = &model->supply;
  const double all = supply->capacitance + capacitance_of_port(w->at, lead), by_source = 1 / supply->resistance / all;
  double *A = plant->A + at.electrodes * plant->n;
  for (size_t j = 0; j < w->m; j++)
    A[w->m + j] -= model->parts * w->push[j] / all;
  A[at.electrodes] = -by_source - zp_supply_bled_slope(supply, w->at->ports[lead]) / all;
  if (at.inner > 0)
    A[at.inner] = by_source;
  else if (b)
    b[at.electrodes] = by_source;
}

/* A port; b: of its controller, NULL: it has none. */
static void fill_port(Basis *w, size_t lead, Voltages at, double *b, ZpPlant *plant) {
  ZpStatics *s = w->at;
  const ZpSupply *supply = &s->member[lead].model->supply;
  const size_t n = plant->n, m = w->m, from = at.electrodes > 0 ? at.electrodes : at.inner;
  zp_statics_by_port(s, lead, s->ports[lead], w->x);
  for (size_t j = 0; j < m; j++)
    w->push[j] = zp_dot(s->n, w->shape + j * s->n, w->x);
  for (size_t j = 0; j < m && (from > 0 || b); j++)
    *(from > 0 ? &plant->A[(m + j) * n + from] : &b[m + j]) += w->push[j];
  if (at.electrodes > 0) fill_electrodes(w, lead, at, b, plant);
  if (at.inner == 0) return;
  const double rate = zp_supply_lag_rate(supply, s->ports[lead]);
  plant->A[at.inner * n + at.inner] = -rate;
  if (b) b[at.inner] = rate;
}

static void fill_motion(const Basis *w, ZpPlant *plant) {
  const size_t n = plant->n, m = w->m;
  for (size_t j = 0; j < m; j++) {
    plant->A[j * n + m + j] = 1;
    for (size_t k = 0; k < m; k++) {
      plant->A[(m + k) * n + j] = -w->K[k * m + j];
      plant->A[(m + k) * n + m + j] = -w->D[k * m + j];
    }
  }
}

/* The number of a port's controller among those that act; `inputs`: it has none. */
static size_t input_of(const ZpLoop *loop, size_t loops, size_t lead, size_t inputs) {
  size_t input = 0;
  for (size_t i = 0; i < loops; i++) {
    if (loop[i].acts && loop[i].lead == lead) return input;
    input += loop[i].acts;
  }
  return inputs;
}

static bool fill(Basis *w, const ZpLoop *loop, size_t loops, ZpPlant *plant) {
  ZpStatics *s = w->at;
  size_t behind = 2 * w->m, input = 0;
  const size_t n = plant->n = states_of(w);
  for (size_t i = 0; i < loops; i++)
    plant->inputs += loop[i].acts;
  plant->memory = zp_calloc(n * n + 2 * plant->inputs * n, sizeof(double));
  if (!plant->memory) return false;
  plant->A = plant->memory;
  plant->b = plant->A + n * n;
  plant->c = plant->b + plant->inputs * n;
  fill_motion(w, plant);
  for (size_t k = 0; k < s->members; k++) {
    Voltages at;
    if (!zp_leads_port(s->member[k].model)) continue;
    behind = place(&s->member[k].model->supply, behind, &at);
    const size_t of = input_of(loop, loops, k, plant->inputs);
    fill_port(w, k, at, of < plant->inputs ? plant->b + of * n : NULL, plant);
  }
  for (size_t i = 0; i < loops; i++) {
    if (!loop[i].acts) continue;
    for (size_t j = 0; j < w->m; j++)
      plant->c[input * n + j] = signal_along(s, &loop[i], w->shape + j * s->n);
    input++;
  }
  return true;
}

bool zp_loops_plant(ZpRest *rest, const ZpLoop *loop, size_t loops, ZpPlant *plant) {
  ZpStatics *s = &rest->statics;
  Basis w = {.at = s, .most = ZP_VIBRATIONS};
  for (size_t k = 0; k < s->members; k++)
    w.most += zp_leads_port(s->member[k].model) ? KRYLOV : 0;
  *plant = (ZpPlant){.neutral = 0};
  w.memory = zp_calloc(1, reserve_basis(&w, NULL));
  if (!w.memory) return false;
  reserve_basis(&w, w.memory);
  bool done = !find_basis(&w) || fill(&w, loop, loops, plant);
  zp_free(w.memory);
  return done;
}
