/* The coordinates are the lowest vibrations without liquid, with the bead held, and the shape in which a slow voltage
 * bends the actuator. Each has a flow, the one where viscosity dominates. The difference to the flow where inertia
 * dominates is an unknown of its own (Galerkin's method, which keeps energies and losses positive).
 *
 * State: coordinates eta [m]; rates of them and of the flows of their own, w [m + z]; volume at the edges of each bead
 * that ends [beads]; behind a lag, the supply's inner voltage; behind a resistance, the voltage of the electrodes. */
#include "rest/plant.h"

#include <math.h>
#include <string.h>

#include "liquid/film_small.h"
#include "math/vector.h"
#include "rest/vibration.h"

enum { SLOW = 16, SHAPES = ZP_VIBRATIONS + 1 + SLOW, OWN_FLOWS = ZP_FILM_MODES * SHAPES, RATES = SHAPES + OWN_FLOWS };

/* A bead that ends before the middle of the actuator. */
typedef struct End {
  int half;
  double section;              /* w h at its end, m^2 */
  double volume_by[SHAPES];    /* derivative of the volume between the faces up to the reach by eta, m^2 */
  double force_by[SHAPES];     /* on eta, by its reach, N/m */
  double charge_by, by_signal; /* derivatives of charge and signal by its reach, C/m and 1/m */
  double out[RATES];           /* derivative of the flow past the edges by w, m^2 */
} End;

typedef struct Work {
  const ZpModel *model;
  ZpStatics *at;
  ZpEval *eval; /* of the state, as the equations are */
  const ZpAssembly *assembly;
  ZpVibration vibration;
  ZpBand K, *factors; /* the stiffness; its factors, later the damping */
  ZpBead bead[ZP_BEADS];
  ZpCover cover;
  ZpFilmWays ways;
  size_t m, z;   /* shapes, flows of their own */
  double *shape; /* [m][n] */
  double *rate;  /* [m][N] of the gaps */
  double *flow;  /* [m + z][4 N] */
  double *force, *moved, *zeros, *x, *y, *by_voltage;
  double (*spare)[4]; /* [3 edges] */
  double *nodes;      /* [m][2 stride] how shapes move all nodes, for motions of second order, */
  double second[RATES * RATES], charge[RATES], none[RATES]; /* with the stiffness and the charge of all rates */
  double stiffness[SHAPES * SHAPES];
  double mass[RATES * RATES], damping[RATES * RATES];
  double by_u[SHAPES], by_signal[SHAPES]; /* force by the voltage, N/V, which is charge by eta; signal by eta */
  size_t ends;
  End end[ZP_BEADS];
  void *memory;
} Work;

/* -- work space ------------------------------------------------------------------------------------ */

static size_t reserve(Work *w, void *block) {
  const ZpModel *model = w->model;
  ZpArena arena = {block, 0};
  size_t n = w->assembly->n, N = model->nodes;
  zp_vibration_reserve(&w->vibration, n, ZP_VIBRATIONS, &arena);
  zp_band_reserve_groups(&w->K, n, 0, w->assembly->bandwidth, w->assembly->groups, &arena);
  if (model->has_film) zp_film_ways_reserve(&model->film, &w->ways, &arena);
  w->shape = zp_arena_take(&arena, SHAPES * n);
  w->nodes = zp_arena_take(&arena, SHAPES * zp_coordinates(model));
  w->rate = zp_arena_take(&arena, SHAPES * N);
  w->flow = zp_arena_take(&arena, (size_t)RATES * ZP_FILM_FLOWS * N);
  w->zeros = zp_arena_take(&arena, ZP_FILM_STATE * N);
  w->x = zp_arena_take(&arena, n);
  w->y = zp_arena_take(&arena, n);
  double **of_nodes[] = {&w->force, &w->moved, &w->by_voltage};
  for (size_t k = 0; k < sizeof of_nodes / sizeof of_nodes[0]; k++)
    *of_nodes[k] = zp_arena_take(&arena, zp_coordinates(model));
  w->spare = (double(*)[4])(void *)zp_arena_take(&arena, 12 * zp_lanes(model));
  return arena.used;
}

/* -- the ribbons ----------------------------------------------------------------------------------- */

/* The present point at voltage U, with liquid up to `bead`. */
static ZpSpan span_of(const Work *w, double U) {
  ZpSpan span = zp_span_at(w->at->member->q);
  span.U0 = span.U1 = U;
  span.bead = w->bead;
  return span;
}

/* Forces and derived quantities there => eval. */
static void look(Work *w, double U) {
  ZpSpan span = span_of(w, U);
  zp_system_force(w->model, &span, w->eval, w->force);
}

/* Forces by the voltage at U, N/V. */
static void find_by_voltage(Work *w, double U, double *force) {
  ZpSpan span = span_of(w, U);
  ZpByVoltage by = {.force = force};
  look(w, U);
  zp_system_by_voltage(w->model, &span, w->eval, &by);
}

/* Component of the forces on nodes along shape j. */
static double along_shape(Work *w, const double *nodes, size_t j) {
  zp_assembly_sum(w->assembly, nodes, w->x);
  return zp_dot(w->assembly->n, w->x, w->shape + j * w->assembly->n);
}

/* Add the part of x that is orthogonal to all shapes before, scaled to mass 1. */
static void add_shape(Work *w, const double *x) {
  const ZpVibration *v = &w->vibration;
  double *shape = w->shape + w->m * v->n, before = zp_vibration_inner(v, x, x);
  memcpy(shape, x, v->n * sizeof *shape);
  zp_vibration_take_out(v, w->shape, w->m, shape);
  double after = zp_vibration_inner(v, shape, shape);
  if (!(after > 1e-12 * before)) return;
  for (size_t i = 0; i < v->n; i++)
    shape[i] /= sqrt(after);
  w->m++;
}

/* All shapes, each of mass 1, and the exact stiffness at this state. */
static void find_shapes(Work *w) {
  ZpVibration *v = &w->vibration;
  size_t n = w->assembly->n;
  ZpSpan span = span_of(w, w->at->U);
  look(w, span.U1);
  span.tension = w->eval->edges.T;
  zp_band_clear(&w->K);
  zp_system_add_stiffness(w->model, &span, w->assembly, w->eval, &w->K);
  memcpy(w->factors->a, w->K.a, w->K.entries * sizeof *w->K.a);
  zp_band_factor(w->factors);
  v->K = w->factors;
  memset(v->mass, 0, n * sizeof *v->mass);
  zp_assembly_add_masses(w->assembly, w->model->mass, v->mass);
  zp_vibration_start(v);
  zp_vibration_solve(v, v->m - v->m / 3);
  for (size_t j = 0; j < v->m; j++)
    add_shape(w, v->u + j * n);
  find_by_voltage(w, span.U1, w->by_voltage);
  zp_assembly_sum(w->assembly, w->by_voltage, w->y);
  zp_band_solve(w->factors, w->y);
  if (w->m < n) add_shape(w, w->y);
}

static void project(Work *w, const ZpBand *K, double *reduced, size_t columns) {
  for (size_t j = 0; j < w->m; j++) {
    zp_band_multiply(K, w->shape + j * w->assembly->n, w->y);
    for (size_t k = 0; k < w->m; k++)
      reduced[k * columns + j] += zp_dot(w->assembly->n, w->shape + k * w->assembly->n, w->y);
  }
}

/* Of the rods => factors. */
static void find_internal_damping(Work *w) {
  const ZpModel *model = w->model;
  ZpEval *e = w->eval;
  const double *q = w->at->member->q;
  zp_rod_eval(&model->rod, q, zp_nodes(model, q).y, &e->rod_start);
  zp_rod_eval(&model->rod, q, zp_nodes(model, q).y, &e->rod);
  zp_rod_damping(&model->rod, &e->rod_start, &e->rod, &e->rod_step, w->spare, e->D);
  for (size_t k = 0; k < 3 * (model->count - model->s); k++)
    for (size_t c = 0; c < 4; c++)
      e->D[k][c] *= model->internal_damping;
  zp_band_clear(w->factors);
  zp_assemble_edges(w->assembly, (const double(*)[4])e->D, w->factors);
}

/* -- the liquid ------------------------------------------------------------------------------------ */

/* How shape j moves all nodes, until the next one. */
static ZpNodes moved_by(Work *w, size_t j) {
  zp_assembly_changes(w->assembly, w->shape + j * w->assembly->n, w->moved);
  return zp_nodes(w->model, w->moved);
}

/* Of shape j. */
static double *find_rate(Work *w, size_t j) {
  const ZpTopology *t = &w->model->topology;
  double *rate = w->rate + j * w->model->nodes;
  const double *y = moved_by(w, j).y;
  for (size_t i = 0; i < w->model->nodes; i++)
    rate[i] = zp_gap_of(t, y, i);
  return rate;
}

/* A viscous film lets the actuator creep in shapes that are not vibrations. Each of them is the static response to the
 * film's drag in the previous one (Krylov's space). */
static void find_slow_shapes(Work *w) {
  const ZpTopology *t = &w->model->topology;
  const size_t N = w->model->nodes;
  const ZpForces moved = zp_forces(w->model, w->moved);
  for (int k = 0; k < SLOW && w->m < w->assembly->n; k++) {
    double *drag = w->force;
    zp_film_ways_drag(&w->ways, find_rate(w, w->m - 1), drag);
    memset(w->moved, 0, zp_coordinates(w->model) * sizeof *w->moved);
    for (size_t i = 0; i < N; i++) {
      moved.y[zp_upper(t, i)] += drag[i];
      moved.y[zp_lower(t, i)] -= drag[i];
    }
    zp_assembly_sum(w->assembly, w->moved, w->y);
    zp_band_solve(w->factors, w->y);
    add_shape(w, w->y);
  }
}

static double *flow_of(const Work *w, size_t r) {
  return w->flow + r * ZP_FILM_FLOWS * w->model->nodes;
}

/* A flow without a change of any gap: the flow where inertia dominates less that where viscosity does, orthogonal to
 * those before. */
static void add_own_flow(Work *w, size_t j, int k) {
  static const double least = 1e-6;
  size_t all = ZP_FILM_FLOWS * w->model->nodes;
  const double *viscous = flow_of(w, j);
  double *flow = flow_of(w, w->m + w->z);
  memset(flow, 0, all * sizeof *flow);
  zp_film_ways_flow(&w->ways, w->rate + j * w->model->nodes, k, false, flow);
  double whole = zp_film_ways_inertia(&w->ways, flow, flow);
  for (size_t i = 0; i < all; i++)
    if (flow[i] != 0) flow[i] -= viscous[i];
  for (int twice = 0; twice < 2; twice++)
    for (size_t r = w->m; r < w->m + w->z; r++) {
      const double *other = flow_of(w, r);
      double part = zp_film_ways_inertia(&w->ways, flow, other);
      for (size_t i = 0; i < all; i++)
        flow[i] -= part * other[i];
    }
  double left = zp_film_ways_inertia(&w->ways, flow, flow);
  if (!(left > least * least * whole)) return;
  for (size_t i = 0; i < all; i++)
    flow[i] /= sqrt(left);
  w->z++;
}

static void find_flows(Work *w) {
  const ZpModel *model = w->model;
  for (size_t j = 0; j < w->m; j++)
    for (int k = 0; k < ZP_FILM_MODES; k++)
      if (model->film.share[k] > 0) zp_film_ways_flow(&w->ways, w->rate + j * model->nodes, k, true, flow_of(w, j));
  for (size_t j = 0; model->film.rho > 0 && j < w->m; j++)
    for (int k = 0; k < ZP_FILM_MODES; k++)
      if (model->film.share[k] > 0) add_own_flow(w, j, k);
}

/* -- where a bead ends ----------------------------------------------------------------------------- */

/* Volume between the faces as far as `reach` with gaps changed by `amount` times those of shape j. */
static double volume(Work *w, int half, size_t j, double amount) {
  const double *gap = w->eval->plates.gap;
  for (size_t i = 0; i < w->model->nodes; i++)
    w->moved[i] = gap[i] + amount * w->rate[j * w->model->nodes + i];
  return zp_bead_volume(&w->model->film, w->moved, half, w->bead[half].reach);
}

/* Largest change of a gap in shape j. */
static double largest_rate(const Work *w, size_t j) {
  double largest = 0;
  for (size_t i = 0; i < w->model->nodes; i++)
    largest = fmax(largest, fabs(w->rate[j * w->model->nodes + i]));
  return largest;
}

static ZpElectric electric(Work *w, double U) {
  ZpSpan span = span_of(w, U);
  zp_term_gaps(w->model, &span, w->eval);
  return zp_system_electric(w->model, &span, w->eval, ZP_SPAN_END, U);
}

/* By differences over a reach of a hundredth of an element. */
static void move_end(Work *w, End *end, const ZpSetpointSignal *signal) {
  const double U = w->at->U, reach = w->bead[end->half].reach, by = 0.01 * w->model->l;
  for (int sign = -1; sign <= 1; sign += 2) {
    w->bead[end->half].reach = reach + sign * by;
    look(w, U);
    for (size_t j = 0; j < w->m; j++)
      end->force_by[j] += sign * along_shape(w, w->force, j) / (2 * by);
    ZpElectric here = electric(w, U);
    end->charge_by += sign * here.charge / (2 * by);
    if (signal->kind == ZP_CONTROL_CAPACITANCE) end->by_signal += sign * w->model->parts * here.capacitance / (2 * by);
  }
  w->bead[end->half].reach = reach;
  look(w, U);
}

static void find_end(Work *w, int half, const ZpSetpointSignal *signal) {
  static const double little = 1e-7; /* m */
  const ZpFilmParams *film = &w->model->film;
  End *end = &w->end[w->ends++];
  *end = (End){.half = half};
  move_end(w, end, signal);
  ZpBeadPlace place = zp_bead_place(film, half, w->bead[half].reach);
  end->section = film->w * zp_bead_thickness(film, &place, w->eval->plates.gap);
  for (size_t j = 0; j < w->m; j++) {
    double amount = little / fmax(largest_rate(w, j), 1e-12);
    end->volume_by[j] = (volume(w, half, j, amount) - volume(w, half, j, -amount)) / (2 * amount);
  }
  size_t middle = w->model->topology.platform.first, N = w->model->nodes;
  for (size_t r = 0; r < w->m + w->z; r++)
    end->out[r] = half ? zp_film_ways_out(&w->ways, flow_of(w, r), middle + 1, N - 1)
                       : zp_film_ways_out(&w->ways, flow_of(w, r), 0, zp_beads(film) > 1 ? middle : N - 1);
}

/* -- the signal ------------------------------------------------------------------------------------ */

static void find_signal(Work *w, const ZpSetpointSignal *signal) {
  const ZpTopology *t = &w->model->topology;
  if (signal->kind == ZP_CONTROL_CAPACITANCE) find_by_voltage(w, 1, w->by_voltage); /* U dC / dq, at 1 V */
  for (size_t j = 0; j < w->m; j++) {
    if (signal->kind == ZP_CONTROL_CAPACITANCE) {
      w->by_signal[j] = w->model->parts * along_shape(w, w->by_voltage, j);
      continue;
    }
    const double *y = moved_by(w, j).y;
    w->by_signal[j] = signal->kind == ZP_CONTROL_STROKE    ? zp_stroke(t, y)
                      : signal->kind == ZP_CONTROL_OPENING ? zp_opening(t, y)
                                                           : -zp_opening(t, y) / signal->hanging;
  }
}

/* -- together -------------------------------------------------------------------------------------- */

/* Add the inertia of the liquid outside, which shape j moves, to column j. */
static void add_outside(Work *w, size_t j) {
  moved_by(w, j);
  memset(w->force, 0, zp_coordinates(w->model) * sizeof *w->force);
  zp_term_add_outside(w->model, w->eval, w->moved, w->force);
  for (size_t k = 0; k < w->m; k++)
    w->mass[k * (w->m + w->z) + j] += along_shape(w, w->force, k);
}

/* Inertia and losses of rates r and s. */
static void find_rate_laws(Work *w) {
  const size_t rates = w->m + w->z;
  memset(w->mass, 0, sizeof w->mass);
  memset(w->damping, 0, sizeof w->damping);
  find_internal_damping(w);
  project(w, w->factors, w->damping, rates);
  for (size_t j = 0; j < w->m; j++)
    w->mass[j * rates + j] = 1;
  if (!w->model->has_film) return;
  for (size_t r = 0; r < rates; r++)
    for (size_t s = 0; s < rates; s++) {
      w->mass[r * rates + s] += zp_film_ways_inertia(&w->ways, flow_of(w, r), flow_of(w, s));
      w->damping[r * rates + s] += zp_film_ways_resistance(&w->ways, flow_of(w, r), flow_of(w, s));
    }
  for (size_t j = 0; zp_term_outer.acts(w->model) && j < w->m; j++)
    add_outside(w, j);
}

/* M = L L' in place. */
static void factor(size_t n, double *M) {
  for (size_t j = 0; j < n; j++)
    for (size_t i = j; i < n; i++) {
      double sum = M[i * n + j];
      for (size_t k = 0; k < j; k++)
        sum -= M[i * n + k] * M[j * n + k];
      M[i * n + j] = i == j ? sqrt(sum) : sum / M[j * n + j];
    }
}

static void solve(size_t n, const double *L, double *x) {
  for (size_t i = 0; i < n; i++)
    x[i] = (x[i] - zp_dot(i, L + i * n, x)) / L[i * n + i];
  for (size_t i = n; i-- > 0;) {
    for (size_t k = i + 1; k < n; k++)
      x[i] -= L[k * n + i] * x[k];
    x[i] /= L[i * n + i];
  }
}

/* Where the state has what. */
typedef struct Layout {
  size_t rates, edges, inner, electrodes, n;
} Layout;

static Layout lay_out(const Work *w, const ZpSupply *supply) {
  Layout at = {.rates = w->m};
  at.edges = at.rates + w->m + w->z;
  at.inner = at.edges + w->ends;
  at.electrodes = at.inner + (supply->acts && isfinite(supply->rate));
  at.n = at.electrodes + (supply->acts && supply->resistance > 0);
  return at;
}

/* Forces on eta [m] over the inertia => the rates' rows of a column, whose rows are `step` apart. */
static void add_column(const Work *w, const Layout *at, const double *force, double *to, size_t step) {
  double x[RATES] = {0};
  memcpy(x, force, w->m * sizeof *x);
  solve(w->m + w->z, w->mass, x);
  for (size_t r = 0; r < w->m + w->z; r++)
    to[(at->rates + r) * step] += x[r];
}

static void fill_motion(const Work *w, const Layout *at, ZpPlant *plant) {
  const size_t rates = w->m + w->z, n = at->n;
  for (size_t j = 0; j < w->m; j++) {
    double push[SHAPES];
    plant->A[j * n + at->rates + j] = 1;
    for (size_t k = 0; k < w->m; k++) {
      push[k] = -w->stiffness[k * w->m + j];
      for (size_t e = 0; e < w->ends; e++)
        push[k] -= w->end[e].force_by[k] * w->end[e].volume_by[j] / w->end[e].section;
    }
    add_column(w, at, push, plant->A + j, n);
  }
  for (size_t s = 0; s < rates; s++) {
    double x[RATES];
    for (size_t r = 0; r < rates; r++)
      x[r] = -w->damping[r * rates + s];
    solve(rates, w->mass, x);
    for (size_t r = 0; r < rates; r++)
      plant->A[(at->rates + r) * n + at->rates + s] = x[r];
  }
  for (size_t e = 0; e < w->ends; e++) {
    double push[SHAPES];
    for (size_t k = 0; k < w->m; k++)
      push[k] = -w->end[e].force_by[k] / w->end[e].section;
    add_column(w, at, push, plant->A + at->edges + e, n);
    for (size_t r = 0; r < rates; r++)
      plant->A[(at->edges + e) * n + at->rates + r] = w->end[e].out[r];
  }
}

/* Derivatives of the signal by eta and by the liquid at the edges, which lets the bead end nearer to the clip. */
static void fill_signal(const Work *w, const Layout *at, ZpPlant *plant) {
  memcpy(plant->c, w->by_signal, w->m * sizeof *plant->c);
  for (size_t e = 0; e < w->ends; e++) {
    const End *end = &w->end[e];
    for (size_t j = 0; j < w->m; j++)
      plant->c[j] -= end->by_signal * end->volume_by[j] / end->section;
    plant->c[at->edges + e] = -end->by_signal / end->section;
  }
}

/* Row of the voltage of the electrodes behind a resistance: (C_p + dQ/dU) U' = (V - U) / R - G U - dQ/dt at that U. */
static void fill_electrodes(Work *w, const ZpSupply *supply, const Layout *at, ZpPlant *plant) {
  const double U = w->at->U, by = 1e-4 * fmax(U, 1), parts = w->model->parts;
  const size_t n = at->n, row = at->electrodes;
  double more = electric(w, U + by).charge, charge = more - electric(w, U - by).charge;
  double capacitance = supply->capacitance + parts * charge / (2 * by);
  double *A = plant->A + row * n;
  for (size_t j = 0; j < w->m; j++)
    A[at->rates + j] -= parts * w->by_u[j] / capacitance;
  for (size_t e = 0; e < w->ends; e++)
    for (size_t r = 0; r < w->m + w->z; r++) {
      const End *end = &w->end[e];
      double grown = end->out[r] + (r < w->m ? end->volume_by[r] : 0);
      A[at->rates + r] += parts * end->charge_by * grown / end->section / capacitance;
    }
  A[row] = -(1 / supply->resistance + supply->conductance) / capacitance;
  if (at->inner < at->electrodes)
    A[at->inner] = 1 / supply->resistance / capacitance;
  else
    plant->b[row] = 1 / supply->resistance / capacitance;
}

/* Effect of the voltage, through the supply. */
static void fill_voltage(Work *w, const ZpSupply *supply, const Layout *at, ZpPlant *plant) {
  const size_t n = at->n;
  bool lags = at->inner < at->electrodes, resists = at->electrodes < n;
  if (lags) {
    plant->A[at->inner * n + at->inner] = -supply->rate;
    plant->b[at->inner] = supply->rate;
  }
  if (resists) fill_electrodes(w, supply, at, plant);
  if (lags || resists)
    add_column(w, at, w->by_u, plant->A + (resists ? at->electrodes : at->inner), n);
  else
    add_column(w, at, w->by_u, plant->b, 1);
}

static bool fill(Work *w, const ZpSupply *supply, ZpPlant *plant) {
  Layout at = lay_out(w, supply);
  ZpArena arena = {NULL, 0};
  for (int pass = 0; pass < 2; pass++) {
    if (pass && !(plant->memory = zp_calloc(1, arena.used))) return false;
    arena = (ZpArena){plant->memory, 0};
    plant->A = zp_arena_take(&arena, at.n * at.n);
    plant->b = zp_arena_take(&arena, at.n);
    plant->c = zp_arena_take(&arena, at.n);
  }
  plant->n = at.n;
  plant->neutral = w->ends;
  factor(w->m + w->z, w->mass);
  fill_motion(w, &at, plant);
  fill_signal(w, &at, plant);
  fill_voltage(w, supply, &at, plant);
  return true;
}

static void linearize(Work *w, const ZpSetpointSignal *signal) {
  const ZpModel *model = w->model;
  for (int half = 0; half < ZP_BEADS; half++)
    w->bead[half].reach = w->at->member->eval.reach[half];
  find_shapes(w);
  look(w, w->at->U);
  w->cover = w->eval->cover;
  if (model->has_film) {
    zp_film_ways(&model->film, model->has_bead ? &w->cover : NULL, w->eval->plates.gap, w->zeros, &w->eval->film,
                 &w->ways);
    find_slow_shapes(w);
    for (size_t j = 0; j < w->m; j++)
      find_rate(w, j);
    find_flows(w);
  }
  project(w, &w->K, w->stiffness, w->m);
  for (size_t j = 0; j < w->m; j++)
    w->by_u[j] = along_shape(w, w->by_voltage, j);
  find_signal(w, signal);
  look(w, w->at->U);
  for (int half = 0; model->has_bead && half < zp_beads(&model->film); half++)
    if (w->bead[half].reach < zp_bead_longest(&model->film)) find_end(w, half, signal);
  find_rate_laws(w);
}

/* Work space with everything about the present point of `rest`; false if there is no memory. To be closed in any case.
 */
static bool open_linear(ZpRest *rest, const ZpSetpointSignal *signal, Work **out) {
  ZpRestMember *m = rest->statics.member;
  Work *w = *out = zp_calloc(1, sizeof *w);
  if (!w) return false;
  *w = (Work){.model = m->model,
              .at = &rest->statics,
              .eval = &m->eval,
              .assembly = &m->assembly,
              .factors = &rest->statics.newton.K};
  w->memory = zp_calloc(1, reserve(w, NULL));
  if (!w->memory) return false;
  reserve(w, w->memory);
  linearize(w, signal);
  return true;
}

static void close_linear(Work *w) {
  if (w) zp_free(w->memory);
  zp_free(w);
}

bool zp_plant_create(ZpRest *rest, const ZpSetpointSignal *signal, ZpPlant *plant) {
  const ZpSupply supply = zp_supply_of(&rest->statics.member->model->def);
  Work *w;
  *plant = (ZpPlant){0};
  bool done = open_linear(rest, signal, &w) && fill(w, &supply, plant);
  close_linear(w);
  return done;
}

void zp_plant_destroy(ZpPlant *plant) {
  zp_free(plant->memory);
  plant->memory = NULL;
}

/* -- as equations of second order -------------------------------------------------------------------- */

/* A bead's end acts on the shapes with the volume that shapes displace, and with what has flowed past the edges. */
static void find_second_order(Work *w, ZpSmallMotion *small) {
  const size_t rates = small->rates = w->m + w->z, nodes = zp_coordinates(w->model);
  small->shapes = w->m;
  small->mass = w->mass;
  small->damping = w->damping;
  small->stiffness = w->second;
  small->by_voltage = w->by_u;
  small->charge = w->charge;
  small->shape = w->nodes;
  memcpy(w->charge, w->by_u, w->m * sizeof *w->by_u);
  for (size_t k = 0; k < w->m; k++) {
    zp_assembly_changes(w->assembly, w->shape + k * w->assembly->n, w->nodes + k * nodes);
    for (size_t j = 0; j < w->m; j++)
      w->second[k * rates + j] = w->stiffness[k * w->m + j];
  }
  for (End *end = w->end; end < w->end + w->ends; end++) {
    small->out[end->half] = end->out;
    for (size_t r = 0; r < rates; r++) {
      double back = ((r < w->m ? end->volume_by[r] : 0) + end->out[r]) / end->section;
      w->charge[r] -= end->charge_by * back;
      for (size_t k = 0; k < w->m; k++)
        w->second[k * rates + r] += end->force_by[k] * back;
    }
  }
}

bool zp_small_motion_create(ZpRest *rest, ZpSmallMotion *small) {
  const ZpSetpointSignal signal = {.kind = ZP_CONTROL_OPENING};
  Work *w;
  bool done = open_linear(rest, &signal, &w);
  *small = (ZpSmallMotion){.memory = w};
  if (!done) return false;
  for (int half = 0; half < ZP_BEADS; half++)
    small->out[half] = w->none;
  find_second_order(w, small);
  return true;
}

void zp_small_motion_destroy(ZpSmallMotion *small) {
  close_linear(small->memory);
  small->memory = NULL;
}
