/* The coordinates are, of each member by itself, the lowest vibrations without liquid, with the bead at rest, the
 * shape in which a slow voltage bends it and, of antagonists, that in which a force on the platform does. Each has a
 * flow, the one where viscosity dominates. The difference to the flow where inertia dominates is an unknown of its own
 * (Galerkin's method, which keeps energies and losses positive).
 *
 * Members that share a load share one coordinate, the height of their platforms. In series the shapes of a member are
 * those relative to the platform that it hangs on, which joins the members by their masses.
 *
 * State: coordinates eta [m]; rates of them and of the flows of their own, w [m + z]; volume at the edges of each bead
 * that ends [beads]; of each driven segment with a lag its curvature; behind a lag, the supply's inner voltage; behind
 * a resistance, the voltage of the electrodes. */
#include "rest/plant.h"

#include <math.h>
#include <string.h>

#include "liquid/film_small.h"
#include "math/vector.h"
#include "rest/vibration.h"
#include "term/curvature.h"

enum { SLOW = 16, SHAPES = ZP_VIBRATIONS + 2 + SLOW, OWN_FLOWS = ZP_FILM_MODES * SHAPES, RATES = SHAPES + OWN_FLOWS };

/* A bead that ends before the middle of the actuator. */
typedef struct End {
  int half;
  double section;              /* w h at its end, m^2 */
  double volume_by[SHAPES];    /* derivative of the volume between the faces up to the reach by eta, m^2 */
  double force_by[SHAPES];     /* on eta, by its reach, N/m */
  double charge_by, by_signal; /* derivatives of charge and signal by its reach, C/m and 1/m */
  double out[RATES];           /* derivative of the flow past the edges by w, m^2 */
} End;

/* A member by itself: its shapes, and what its laws do in them. */
typedef struct Member {
  const ZpModel *model;
  ZpEval *eval;     /* of the state */
  const double *q;  /* its position, of all nodes */
  double U, factor; /* its voltage, V; its height over that of the first one, where both share a load */
  double pressure;  /* of a pouch, Pa */
  ZpAssembly assembly;
  ZpVibration vibration;
  ZpArrowForm form;
  ZpBand K;        /* the stiffness with the bead held */
  ZpArrow factors; /* of that with a bead at rest; later the damping */
  ZpBead bead[ZP_BEADS];
  ZpCover cover;
  ZpFilmWays ways;
  size_t m, z;         /* shapes, flows of their own */
  size_t shape_at;     /* coordinate of its first shape that it does not share; the others follow, */
  size_t flow_at;      /* rate of its first flow, likewise */
  bool shares;         /* its first shape is that of all */
  double *shape;       /* [m][n] */
  double *rate;        /* [m][N] of the gaps */
  double *flow;        /* [m + z][4 N] */
  double *nodes;       /* [m] times all nodes: how shapes move them */
  double mass[SHAPES]; /* of shapes, without liquid; they are orthogonal */
  double lift[SHAPES]; /* rise of the platform by shapes */
  double below;        /* mass that hangs on the platform in series, without liquid, kg, */
  double *force, *moved, *zeros, *x, *y, *by_voltage;
  double (*spare)[4]; /* [3 edges] */
  size_t ends;
  End end[ZP_BEADS];
  double *lagged; /* [driven segments][SHAPES] force along shapes by the curvature of one with a lag, N m */
  void *memory;
} Member;

typedef struct Work {
  ZpStatics *at;
  size_t members;
  Member *member;
  size_t m, rates, ends; /* of all: shapes, rates, beads that end, */
  size_t lags;           /* driven segments with a lag */
  double *stiffness;     /* [rates * rates] of them all, row by row, at last with the ends of beads */
  double *mass, *damping;
  double *by_u, *by_signal; /* [m] force by the voltage of the source, N/V; signal by eta */
  double *charge;           /* [rates] that on electrodes, which is charge by eta, also through where beads end */
  double *x, *push;         /* [rates] work space */
  void *memory;
} Work;

/* Coordinate of a shape of a member; number of a rate, of a shape or of a flow of its own, among those of all. */
static size_t coordinate_of(const Member *w, size_t j) {
  return w->shares && j == 0 ? 0 : w->shape_at + j - w->shares;
}

static size_t rate_of(const Member *w, size_t r) {
  return r < w->m ? coordinate_of(w, r) : w->flow_at + r - w->m;
}

/* -- work space ------------------------------------------------------------------------------------ */

static size_t reserve(Member *w, void *block) {
  const ZpModel *model = w->model;
  ZpArena arena = {block, 0};
  size_t n = w->assembly.n, N = model->nodes;
  zp_vibration_reserve(&w->vibration, n, ZP_VIBRATIONS, &arena);
  ZpBandForm band = w->form.block->band;
  band.rank = zp_pouch_rank(model);
  zp_band_reserve_form(&w->K, n, band, &arena);
  zp_arrow_reserve(&w->factors, &w->form, &arena);
  if (model->has_film) zp_film_ways_reserve(&model->film, &w->ways, &arena);
  w->shape = zp_arena_take(&arena, SHAPES * n);
  w->nodes = zp_arena_take(&arena, SHAPES * zp_coordinates(model));
  w->rate = zp_arena_take(&arena, SHAPES * N);
  w->flow = zp_arena_take(&arena, (size_t)RATES * ZP_FILM_FLOWS * N);
  w->zeros = zp_arena_take(&arena, ZP_FILM_STATE * N);
  w->x = zp_arena_take(&arena, n);
  w->y = zp_arena_take(&arena, n);
  w->lagged = zp_arena_take(&arena, model->driven.places * SHAPES);
  double **of_nodes[] = {&w->force, &w->moved, &w->by_voltage};
  for (size_t k = 0; k < sizeof of_nodes / sizeof of_nodes[0]; k++)
    *of_nodes[k] = zp_arena_take(&arena, zp_coordinates(model));
  w->spare = zp_arena_take_of(&arena, 3 * zp_lanes(model), sizeof *w->spare);
  return arena.used;
}

/* -- the ribbons ----------------------------------------------------------------------------------- */

/* The present point at voltage U, with liquid up to `bead`. */
static ZpSpan span_of(const Member *w, double U) {
  ZpSpan span = zp_span_at(w->q);
  span.U0 = span.U1 = U;
  span.bead = w->bead;
  span.pressure = w->pressure;
  return span;
}

/* Forces and derived quantities there => eval. */
static void look(Member *w, double U) {
  ZpSpan span = span_of(w, U);
  zp_system_force(w->model, &span, w->eval, w->force);
}

/* Forces by the voltage at U, N/V, of all laws or on electrodes alone. */
static void find_by_voltage(Member *w, double U, bool of_charge, double *force) {
  ZpSpan span = span_of(w, U);
  ZpByVoltage by = {.force = force, .of_charge = of_charge};
  look(w, U);
  zp_system_by_voltage(w->model, &span, w->eval, &by);
}

/* Component of the forces on nodes along shape j. */
static double along_shape(Member *w, const double *nodes, size_t j) {
  zp_assembly_sum(&w->assembly, nodes, w->x);
  return zp_dot(w->assembly.n, w->x, w->shape + j * w->assembly.n);
}

/* Add the part of x that is orthogonal to all shapes before, scaled to mass 1. */
static void add_shape(Member *w, const double *x) {
  const ZpVibration *v = &w->vibration;
  double *shape = w->shape + w->m * v->n, before = zp_vibration_inner(v, x, x);
  memcpy(shape, x, v->n * sizeof *shape);
  zp_vibration_take_out(v, w->shape, w->m, shape);
  double after = zp_vibration_inner(v, shape, shape);
  if (!(after > 1e-12 * before)) return;
  for (size_t i = 0; i < v->n; i++)
    shape[i] /= sqrt(after);
  w->mass[w->m] = 1;
  zp_assembly_changes(&w->assembly, shape, w->nodes + w->m++ * zp_coordinates(w->model));
}

/* That of `factors` with the bead held, which is the only term on top of a band but for that of a pouch. */
static void take_stiffness(Member *w) {
  const ZpBand *A = &w->factors.part->A;
  memcpy(w->K.a, A->a, w->K.entries * sizeof *w->K.a);
  memcpy(w->K.u, A->u, w->K.rank * w->K.n * sizeof *w->K.u);
  memcpy(w->K.v, A->v, w->K.rank * w->K.n * sizeof *w->K.v);
}

/* All shapes, each of mass 1, and the exact stiffness at this state. */
static void find_shapes(Member *w) {
  ZpVibration *v = &w->vibration;
  size_t n = w->assembly.n;
  ZpSpan span = span_of(w, w->U);
  look(w, span.U1);
  span.tension = w->eval->edges.T;
  zp_arrow_clear(&w->factors);
  zp_system_add_stiffness(w->model, &span, &w->assembly, w->eval, &w->factors.part->A);
  take_stiffness(w);
  zp_arrow_factor(&w->factors);
  v->K = &w->factors;
  memset(v->mass, 0, n * sizeof *v->mass);
  zp_assembly_add_masses(&w->assembly, w->model->mass, v->mass);
  if (w->below > 0)
    v->mass[w->assembly.equation[zp_pulled(&w->model->topology, zp_load_node(&w->model->topology))]] += w->below;
  zp_vibration_start(v);
  zp_vibration_solve(v, v->m - v->m / 3);
  for (size_t j = 0; j < v->m; j++)
    add_shape(w, v->u + j * n);
  find_by_voltage(w, span.U1, false, w->by_voltage);
  zp_assembly_sum(&w->assembly, w->by_voltage, w->y);
  zp_arrow_solve(&w->factors, w->y);
  if (w->m < n) add_shape(w, w->y);
}

/* reduced [rates * rates] += K of a member by its shapes. */
static void project(const Work *all, const Member *w, const ZpBand *K, double *reduced) {
  for (size_t j = 0; j < w->m; j++) {
    zp_band_multiply(K, w->shape + j * w->assembly.n, w->y);
    for (size_t k = 0; k < w->m; k++)
      reduced[coordinate_of(w, k) * all->rates + coordinate_of(w, j)] +=
          zp_dot(w->assembly.n, w->shape + k * w->assembly.n, w->y);
  }
}

/* Of the rods => factors. */
static void find_internal_damping(Member *w) {
  zp_system_internal_damping(w->model, w->q, w->eval, w->spare);
  zp_arrow_clear(&w->factors);
  zp_assemble_edges(&w->assembly, (const double(*)[4])w->eval->D, &w->factors.part->A);
}

/* -- the liquid ------------------------------------------------------------------------------------ */

/* How shape j moves all nodes. */
static ZpNodes moved_by(const Member *w, size_t j) {
  return zp_nodes(w->model, w->nodes + j * zp_coordinates(w->model));
}

/* Of shape j. */
static double *find_rate(Member *w, size_t j) {
  const ZpTopology *t = &w->model->topology;
  double *rate = w->rate + j * w->model->nodes;
  const double *y = moved_by(w, j).y;
  for (size_t i = 0; i < w->model->nodes; i++)
    rate[i] = zp_parting(t, y, i);
  return rate;
}

/* A viscous film lets the actuator creep in shapes that are not vibrations. Each of them is the static response to the
 * film's drag in the previous one (Krylov's space). */
static void find_slow_shapes(Member *w) {
  const size_t N = w->model->nodes;
  for (int k = 0; k < SLOW && w->m < w->assembly.n; k++) {
    double *drag = w->force;
    zp_film_ways_drag(&w->ways, find_rate(w, w->m - 1), drag);
    memset(w->moved, 0, zp_coordinates(w->model) * sizeof *w->moved);
    for (size_t i = 0; i < N; i++)
      zp_term_part(w->model, i, drag[i], w->moved);
    zp_assembly_sum(&w->assembly, w->moved, w->y);
    zp_arrow_solve(&w->factors, w->y);
    add_shape(w, w->y);
  }
}

static double *flow_of(const Member *w, size_t r) {
  return w->flow + r * ZP_FILM_FLOWS * w->model->nodes;
}

/* A flow without a change of any gap: the flow where inertia dominates less that where viscosity does, orthogonal to
 * those before. */
static void add_own_flow(Member *w, size_t j, int k) {
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
  zp_film_ways_close(&w->ways, k, flow);
  w->z++;
}

static void find_flows(Member *w) {
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
static double volume(Member *w, int half, size_t j, double amount) {
  const double *gap = w->eval->plates.gap;
  for (size_t i = 0; i < w->model->nodes; i++)
    w->moved[i] = gap[i] + amount * w->rate[j * w->model->nodes + i];
  return zp_bead_volume(&w->model->film, w->moved, half, w->bead[half].reach);
}

/* Largest change of a gap in shape j. */
static double largest_rate(const Member *w, size_t j) {
  double largest = 0;
  for (size_t i = 0; i < w->model->nodes; i++)
    largest = fmax(largest, fabs(w->rate[j * w->model->nodes + i]));
  return largest;
}

static ZpElectric electric(Member *w, double U) {
  ZpSpan span = span_of(w, U);
  zp_term_gaps(w->model, &span, w->eval);
  return zp_system_electric(w->model, &span, w->eval, ZP_SPAN_END, U);
}

/* By differences over a reach of a hundredth of an element. */
static void move_end(Member *w, End *end, const ZpSetpointSignal *signal) {
  const double U = w->U, reach = w->bead[end->half].reach, by = 0.01 * w->model->l;
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

static void find_end(Member *w, int half, const ZpSetpointSignal *signal) {
  static const double usual = 1e-7, of_length = 1e-5; /* m */
  const double little = fmin(usual, of_length * w->model->L);
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

/* -- one member ------------------------------------------------------------------------------------ */

/* Turn the shapes, so that the first one raises the platform by `factor` and no other moves it (Householder). */
static void turn_to_platform(Member *w) {
  const size_t n = w->assembly.n, node = zp_load_node(&w->model->topology);
  double v[SHAPES] = {0};
  for (size_t j = 0; j < w->m; j++)
    v[j] = zp_lifted(&w->model->topology, moved_by(w, j), node);
  const double raised = copysign(sqrt(zp_dot(w->m, v, v)), v[0]);
  v[0] += raised;
  const double square = zp_dot(w->m, v, v);
  for (size_t i = 0; i < n; i++) {
    double along = 0;
    for (size_t j = 0; j < w->m; j++)
      along += v[j] * w->shape[j * n + i];
    for (size_t j = 0; j < w->m; j++)
      w->shape[j * n + i] -= 2 * along / square * v[j];
    w->shape[i] *= -w->factor / raised;
  }
  w->mass[0] = 1 / (raised * raised);
  for (size_t j = 0; j < w->m; j++)
    zp_assembly_changes(&w->assembly, w->shape + j * n, w->nodes + j * zp_coordinates(w->model));
}

/* A force on the platform, as of another member at the same load. */
static void add_deflection(Member *w) {
  memset(w->y, 0, w->assembly.n * sizeof *w->y);
  w->y[w->assembly.equation[zp_pulled(&w->model->topology, zp_load_node(&w->model->topology))]] = 1;
  zp_arrow_solve(&w->factors, w->y);
  if (w->m < w->assembly.n) add_shape(w, w->y);
}

/* Shapes and flows. */
static void find_motions(Member *w) {
  const ZpModel *model = w->model;
  for (int half = 0; half < ZP_BEADS; half++)
    w->bead[half].reach = w->eval->reach[half];
  find_shapes(w);
  if (w->model->network->opposed) add_deflection(w);
  look(w, w->U);
  w->cover = w->eval->cover;
  if (model->has_film) {
    zp_film_ways(&model->film, model->has_bead ? &w->cover : NULL, w->eval->plates.gap, w->zeros, &w->eval->film,
                 &w->ways);
    find_slow_shapes(w);
  }
  if (w->shares) turn_to_platform(w);
  for (size_t j = 0; j < w->m; j++) {
    w->lift[j] = zp_lifted(&model->topology, moved_by(w, j), zp_load_node(&model->topology));
    find_rate(w, j);
  }
  if (model->has_film) find_flows(w);
}

/* -- the signal ------------------------------------------------------------------------------------ */

/* Of members that share a load the first one has the stroke and the opening of all. */
static void find_signal(const Work *all, Member *w, const ZpSetpointSignal *signal) {
  const bool electric = signal->kind == ZP_CONTROL_CAPACITANCE;
  if (electric) find_by_voltage(w, 1, true, w->by_voltage); /* U dC / dq, at 1 V */
  for (size_t j = 0; j < w->m && (electric || !w->shares || w == all->member); j++) {
    double *by = &all->by_signal[coordinate_of(w, j)];
    if (electric) {
      *by += w->model->parts * along_shape(w, w->by_voltage, j);
      continue;
    }
    const ZpNodes moved = moved_by(w, j);
    *by += signal->kind == ZP_CONTROL_STROKE    ? zp_stroke_change(w->model, moved)
           : signal->kind == ZP_CONTROL_OPENING ? zp_spread_change(w->model, moved)
                                                : -zp_spread_change(w->model, moved) / signal->hanging;
  }
}

/* -- together -------------------------------------------------------------------------------------- */

/* Inertia of a member without that of the film at an acceleration of its nodes => force. */
static void find_inertia(Member *w, const double *a) {
  const ZpNodes of = zp_nodes(w->model, a);
  const ZpForces force = zp_forces(w->model, w->force);
  memset(w->force, 0, zp_coordinates(w->model) * sizeof *w->force);
  for (size_t j = 0; j < w->model->count; j++) {
    force.x[j] = w->model->mass[j] * of.x[j];
    force.y[j] = w->model->mass[j] * of.y[j];
  }
  if (zp_term_outer.acts(w->model)) zp_term_add_outside(w->model, w->eval, a, w->force);
}

/* Upward momentum of all nodes for that. */
static double momentum(Member *w, const double *a) {
  double sum = 0;
  find_inertia(w, a);
  for (size_t j = 0; j < w->model->count; j++)
    sum += zp_nodes(w->model, w->force).y[j];
  return sum;
}

/* Mass of a member that rises as a whole, kg. */
static double whole_mass(Member *w) {
  memset(w->moved, 0, zp_coordinates(w->model) * sizeof *w->moved);
  for (size_t j = 0; j < w->model->count; j++)
    zp_forces(w->model, w->moved).y[j] = 1;
  return momentum(w, w->moved);
}

/* In series each platform lifts all members below, eq. (29.3). */
static void join_masses(Work *all) {
  double under = 0;
  for (Member *w = all->member + all->members; w-- > all->member;) {
    for (size_t s = 0; s < w->m; s++) {
      double rises = momentum(w, moved_by(w, s).x) + w->lift[s] * under;
      size_t column = coordinate_of(w, s);
      for (size_t r = 0; r < w->m; r++)
        all->mass[coordinate_of(w, r) * all->rates + column] += w->lift[r] * w->lift[s] * (under - w->below);
      for (const Member *above = all->member; above < w; above++)
        for (size_t r = 0; r < above->m; r++) {
          size_t row = coordinate_of(above, r);
          all->mass[row * all->rates + column] += above->lift[r] * rises;
          all->mass[column * all->rates + row] += above->lift[r] * rises;
        }
    }
    under += whole_mass(w);
  }
}

/* Add the inertia of the liquid outside, which shape j moves, to its column. */
static void add_outside(const Work *all, Member *w, size_t j) {
  memset(w->force, 0, zp_coordinates(w->model) * sizeof *w->force);
  zp_term_add_outside(w->model, w->eval, moved_by(w, j).x, w->force);
  for (size_t k = 0; k < w->m; k++)
    all->mass[coordinate_of(w, k) * all->rates + coordinate_of(w, j)] += along_shape(w, w->force, k);
}

/* Inertia and losses of the rates of a member. */
static void find_rate_laws(const Work *all, Member *w) {
  find_internal_damping(w);
  project(all, w, &w->factors.part->A, all->damping);
  for (size_t j = 0; j < w->m; j++)
    all->mass[coordinate_of(w, j) * (all->rates + 1)] += w->mass[j];
  if (!w->model->has_film) return;
  for (size_t r = 0; r < w->m + w->z; r++)
    for (size_t s = 0; s < w->m + w->z; s++) {
      size_t at = rate_of(w, r) * all->rates + rate_of(w, s);
      all->mass[at] += zp_film_ways_inertia(&w->ways, flow_of(w, r), flow_of(w, s));
      all->damping[at] += zp_film_ways_resistance(&w->ways, flow_of(w, r), flow_of(w, s));
    }
  for (size_t j = 0; zp_term_outer.acts(w->model) && j < w->m; j++)
    add_outside(all, w, j);
}

/* The end of a bead follows the volume that shapes displace and, where `flows`, what has flowed past the edges => by
 * one of its rates, 1. */
static double end_moves(const Member *w, const End *end, size_t r, bool flows) {
  return ((r < w->m ? end->volume_by[r] : 0) + (flows ? end->out[r] : 0)) / end->section;
}

static void add_ends(const Work *all, bool flows) {
  for (const Member *w = all->member; w < all->member + all->members; w++)
    for (const End *end = w->end; end < w->end + w->ends; end++)
      for (size_t r = 0; r < w->m + w->z; r++)
        for (size_t k = 0; k < w->m; k++)
          all->stiffness[coordinate_of(w, k) * all->rates + rate_of(w, r)] +=
              end->force_by[k] * end_moves(w, end, r, flows);
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
  size_t rates, edges, lags, inner, electrodes, n;
} Layout;

static Layout lay_out(const Work *w, const ZpSupply *supply) {
  Layout at = {.rates = w->m};
  at.edges = at.rates + w->rates;
  at.lags = at.edges + w->ends;
  at.inner = at.lags + w->lags;
  at.electrodes = at.inner + (supply->acts && isfinite(supply->rate));
  at.n = at.electrodes + (supply->acts && supply->resistance > 0);
  return at;
}

/* Forces on eta [m] over the inertia => the rates' rows of a column, whose rows are `step` apart. */
static void add_column(const Work *w, const Layout *at, const double *force, double *to, size_t step) {
  memset(w->x, 0, w->rates * sizeof *w->x);
  memcpy(w->x, force, w->m * sizeof *w->x);
  solve(w->rates, w->mass, w->x);
  for (size_t r = 0; r < w->rates; r++)
    to[(at->rates + r) * step] += w->x[r];
}

/* Column of the liquid at the edges of a bead, row of what flows there. */
static void fill_edge(const Work *w, const Member *of, const End *end, size_t row, const Layout *at, ZpPlant *plant) {
  memset(w->push, 0, w->m * sizeof *w->push);
  for (size_t k = 0; k < of->m; k++)
    w->push[coordinate_of(of, k)] = -end->force_by[k] / end->section;
  add_column(w, at, w->push, plant->A + row, at->n);
  for (size_t r = 0; r < of->m + of->z; r++)
    plant->A[row * at->n + at->rates + rate_of(of, r)] = end->out[r];
}

static void fill_motion(const Work *w, const Layout *at, ZpPlant *plant) {
  const size_t rates = w->rates, n = at->n;
  for (size_t j = 0; j < w->m; j++) {
    plant->A[j * n + at->rates + j] = 1;
    for (size_t k = 0; k < w->m; k++)
      w->push[k] = -w->stiffness[k * rates + j];
    add_column(w, at, w->push, plant->A + j, n);
  }
  for (size_t s = 0; s < rates; s++) {
    for (size_t r = 0; r < rates; r++)
      w->x[r] = -w->damping[r * rates + s];
    solve(rates, w->mass, w->x);
    for (size_t r = 0; r < rates; r++)
      plant->A[(at->rates + r) * n + at->rates + s] = w->x[r];
  }
}

/* Derivatives of the signal by eta and by the liquid at the edges, which lets the bead end nearer to the clip. */
static void fill_beads(const Work *w, const Layout *at, ZpPlant *plant) {
  size_t row = at->edges;
  memcpy(plant->c, w->by_signal, w->m * sizeof *plant->c);
  for (const Member *of = w->member; of < w->member + w->members; of++)
    for (const End *end = of->end; end < of->end + of->ends; end++, row++) {
      fill_edge(w, of, end, row, at, plant);
      for (size_t j = 0; j < of->m; j++)
        plant->c[coordinate_of(of, j)] -= end->by_signal * end_moves(of, end, j, false);
      plant->c[row] = -end->by_signal / end->section;
    }
}

/* Derivative of the charge of all electrodes by the voltage of the source, F. */
static double capacitance(const Work *w) {
  const double by = 1e-4 * fmax(w->at->U, 1);
  double sum = 0;
  for (Member *of = w->member; of < w->member + w->members; of++) {
    double apart = of->model->ratio * by, more = electric(of, of->U + apart).charge;
    sum += zp_source_share(of->model) * (more - electric(of, of->U - apart).charge) / (2 * by);
  }
  return sum;
}

/* Row of the voltage of the electrodes behind a resistance: (C_p + dQ/dU) U' = (V - U) / R - G U - dQ/dt at that U. */
static void fill_electrodes(const Work *w, const ZpSupply *supply, const Layout *at, ZpPlant *plant) {
  const double all = supply->capacitance + capacitance(w);
  const size_t row = at->electrodes;
  double *A = plant->A + row * at->n;
  for (size_t r = 0; r < w->rates; r++)
    A[at->rates + r] -= w->member->model->parts * w->charge[r] / all;
  A[row] = -(1 / supply->resistance + zp_supply_bled_slope(supply, w->at->U)) / all;
  if (at->inner < at->electrodes)
    A[at->inner] = 1 / supply->resistance / all;
  else
    plant->b[row] = 1 / supply->resistance / all;
}

/* Curvatures that lag behind the voltage, whose column is `by_voltage`: eq. (38.2). */
static void fill_lags(const Work *w, const Layout *at, double *by_voltage, size_t step, ZpPlant *plant) {
  size_t row = at->lags;
  for (const Member *of = w->member; of < w->member + w->members; of++)
    for (size_t p = 0; p < of->model->driven.places; p++) {
      const ZpDrivenPlace *place = &of->model->driven.place[p];
      if (place->lag == 0) continue;
      memset(w->push, 0, w->m * sizeof *w->push);
      for (size_t j = 0; j < of->m; j++)
        w->push[coordinate_of(of, j)] = of->lagged[p * SHAPES + j];
      add_column(w, at, w->push, plant->A + row, at->n);
      plant->A[row * at->n + row] = -1 / place->lag;
      by_voltage[row * step] = of->model->ratio * zp_driven_aim_rate(place, of->U) / place->lag;
      row++;
    }
}

/* Effect of the voltage, through the supply. */
static void fill_voltage(const Work *w, const ZpSupply *supply, const Layout *at, ZpPlant *plant) {
  const size_t n = at->n;
  bool lags = at->inner < at->electrodes, resists = at->electrodes < n;
  if (lags) {
    plant->A[at->inner * n + at->inner] = -supply->rate;
    plant->b[at->inner] = supply->rate;
  }
  if (resists) fill_electrodes(w, supply, at, plant);
  const size_t step = lags || resists ? n : 1;
  double *by_voltage = lags || resists ? plant->A + (resists ? at->electrodes : at->inner) : plant->b;
  add_column(w, at, w->by_u, by_voltage, step);
  fill_lags(w, at, by_voltage, step, plant);
}

static bool fill(const Work *w, const ZpSupply *supply, ZpPlant *plant) {
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
  factor(w->rates, w->mass);
  add_ends(w, false);
  fill_motion(w, &at, plant);
  fill_beads(w, &at, plant);
  fill_voltage(w, supply, &at, plant);
  return true;
}

/* -- work space of all ----------------------------------------------------------------------------- */

/* Of one member, and its motions. False if there is no memory. */
static bool open_member(Work *all, size_t which) {
  const ZpStatics *at = all->at;
  ZpRestMember *m = &at->member[which];
  const ZpTies ties = zp_ties_of(m->model, 1, 0);
  Member *w = &all->member[which];
  *w = (Member){.model = m->model,
                .eval = &m->eval,
                .q = m->q,
                .U = zp_statics_member_voltage(at, which),
                .factor = zp_statics_factor(at, which),
                .pressure = zp_statics_span(at, which).pressure,
                .shares = at->shared,
                .below = at->shared ? 0 : m->model->carried / m->model->parts};
  ZpAssembly *assembly = &w->assembly;
  if (!zp_assembly_create(&ties, 0, true, assembly)) return false;
  assembly->block.band.rank = zp_bead_rank(w->model) + zp_pouch_rank(w->model);
  if (!zp_assembly_join(&assembly, NULL, 1, 0, &w->form)) return false;
  w->memory = zp_calloc(1, reserve(w, NULL));
  if (!w->memory) return false;
  reserve(w, w->memory);
  find_motions(w);
  return true;
}

/* Number the coordinates of all, then the flows. */
static void number(Work *all) {
  all->m = all->at->shared;
  for (Member *w = all->member; w < all->member + all->members; w++) {
    w->shape_at = all->m;
    all->m += w->m - w->shares;
  }
  all->rates = all->m;
  for (Member *w = all->member; w < all->member + all->members; w++) {
    w->flow_at = all->rates;
    all->rates += w->z;
  }
}

static size_t reserve_all(Work *all, void *block) {
  ZpArena arena = {block, 0};
  double **of_pairs[] = {&all->stiffness, &all->mass, &all->damping},
         **of_rates[] = {&all->by_u, &all->by_signal, &all->charge, &all->x, &all->push};
  for (size_t k = 0; k < sizeof of_pairs / sizeof of_pairs[0]; k++)
    *of_pairs[k] = zp_arena_take(&arena, all->rates * all->rates);
  for (size_t k = 0; k < sizeof of_rates / sizeof of_rates[0]; k++)
    *of_rates[k] = zp_arena_take(&arena, all->rates);
  return arena.used;
}

/* Curvatures with a lag are states; only the others follow the voltage at once. */
static void find_lags(Work *all, Member *w) {
  const ZpDriven *driven = &w->model->driven;
  const ZpSpan span = span_of(w, w->U);
  look(w, w->U);
  for (size_t p = 0; p < driven->places; p++) {
    if (driven->place[p].lag == 0) continue;
    memset(w->force, 0, zp_coordinates(w->model) * sizeof *w->force);
    zp_term_curvature_by_place(w->model, &span, p, w->eval, w->force);
    for (size_t j = 0; j < w->m; j++) {
      w->lagged[p * SHAPES + j] = along_shape(w, w->force, j);
      all->by_u[coordinate_of(w, j)] -=
          w->model->ratio * zp_driven_aim_rate(&driven->place[p], w->U) * w->lagged[p * SHAPES + j];
    }
    all->lags++;
  }
}

/* Add what a member does in its coordinates. */
static void add_member(Work *all, Member *w, const ZpSetpointSignal *signal) {
  const ZpModel *model = w->model;
  project(all, w, &w->K, all->stiffness);
  for (size_t j = 0; j < w->m; j++)
    all->by_u[coordinate_of(w, j)] += model->ratio * along_shape(w, w->by_voltage, j);
  find_lags(all, w);
  find_by_voltage(w, w->U, true, w->by_voltage);
  for (size_t j = 0; j < w->m; j++)
    all->charge[coordinate_of(w, j)] += model->ratio * along_shape(w, w->by_voltage, j);
  find_signal(all, w, signal);
  look(w, w->U);
  for (int half = 0; model->has_bead && half < zp_beads(&model->film); half++)
    if (w->bead[half].reach < zp_bead_longest(&model->film)) find_end(w, half, signal);
  for (const End *end = w->end; end < w->end + w->ends; end++)
    for (size_t r = 0; r < w->m + w->z; r++)
      all->charge[rate_of(w, r)] -= model->ratio * end->charge_by * end_moves(w, end, r, true);
  all->ends += w->ends;
  find_rate_laws(all, w);
}

/* Work space with everything about the present point of `rest`; false if there is no memory. To be closed in any case.
 */
static bool open_linear(ZpRest *rest, const ZpSetpointSignal *signal, Work **out) {
  Work *all = *out = zp_calloc(1, sizeof *all);
  if (!all) return false;
  *all = (Work){.at = &rest->statics, .members = rest->statics.members};
  all->member = zp_calloc(all->members, sizeof *all->member);
  bool done = all->member != NULL;
  for (size_t k = 0; k < all->members && done; k++)
    done = open_member(all, k);
  if (!done) return false;
  number(all);
  all->memory = zp_calloc(1, reserve_all(all, NULL));
  if (!all->memory) return false;
  reserve_all(all, all->memory);
  for (Member *w = all->member; w < all->member + all->members; w++)
    add_member(all, w, signal);
  if (all->members > 1 && !all->at->shared) join_masses(all);
  return true;
}

static void close_linear(Work *all) {
  for (size_t k = 0; all && all->member && k < all->members; k++) {
    zp_free(all->member[k].memory);
    zp_assembly_destroy(&all->member[k].assembly);
    zp_arrow_form_destroy(&all->member[k].form);
  }
  if (all) zp_free(all->member);
  if (all) zp_free(all->memory);
  zp_free(all);
}

bool zp_plant_create(ZpRest *rest, const ZpSetpointSignal *signal, ZpPlant *plant) {
  ZpSupply supply = zp_supply_of(&rest->statics.member->model->def);
  supply.rate = zp_supply_lag_rate(&supply, rest->statics.U);
  Work *w;
  *plant = (ZpPlant){.inputs = 1};
  bool done = open_linear(rest, signal, &w) && fill(w, &supply, plant);
  close_linear(w);
  return done;
}

void zp_plant_destroy(ZpPlant *plant) {
  zp_free(plant->memory);
  plant->memory = NULL;
}

/* -- as equations of second order -------------------------------------------------------------------- */

bool zp_small_motion_create(ZpRest *rest, ZpSmallMotion *small) {
  const ZpSetpointSignal signal = {.kind = ZP_CONTROL_OPENING};
  Work *w;
  bool done = open_linear(rest, &signal, &w);
  *small = (ZpSmallMotion){.memory = w};
  if (!done) return false;
  add_ends(w, true);
  *small = (ZpSmallMotion){w->m, w->rates, w->mass, w->damping, w->stiffness, w->by_u, w->by_signal, w->charge, w};
  return true;
}

void zp_small_motion_destroy(ZpSmallMotion *small) {
  close_linear(small->memory);
  small->memory = NULL;
}

/* How far the platform of a member rises beyond its upper one. */
static double raised_by(const Member *of, const double *x) {
  double sum = 0;
  for (size_t j = 0; j < of->m; j++)
    sum += of->lift[j] * x[coordinate_of(of, j)];
  return sum;
}

void zp_small_motion_nodes(const ZpSmallMotion *small, size_t which, const double *x, double share, double *nodes) {
  const Work *w = small->memory;
  const Member *of = &w->member[which];
  const size_t coordinates = zp_coordinates(of->model);
  double lifted = 0;
  memset(nodes, 0, coordinates * sizeof *nodes);
  for (size_t j = 0; j < of->m; j++) {
    const double moved = share * x[coordinate_of(of, j)];
    for (size_t i = 0; i < coordinates; i++)
      nodes[i] += moved * of->nodes[j * coordinates + i];
  }
  for (const Member *above = w->member; above < of && !above->shares; above++)
    lifted += share * raised_by(above, x);
  for (size_t i = 0; i < of->model->count; i++)
    zp_forces(of->model, nodes).y[i] += lifted;
}

void zp_small_motion_add(const ZpSmallMotion *small, size_t which, const double *nodes, double weight,
                         double *by_shape) {
  const Work *w = small->memory;
  const Member *of = &w->member[which];
  const size_t coordinates = zp_coordinates(of->model);
  double whole = 0;
  for (size_t j = 0; j < of->m; j++)
    for (size_t i = 0; i < coordinates; i++)
      by_shape[coordinate_of(of, j)] += weight * nodes[i] * of->nodes[j * coordinates + i];
  for (size_t i = 0; i < of->model->count; i++)
    whole += zp_nodes(of->model, nodes).y[i];
  for (const Member *above = w->member; above < of && !above->shares; above++)
    for (size_t j = 0; j < above->m; j++)
      by_shape[coordinate_of(above, j)] += weight * whole * above->lift[j];
}

double zp_small_motion_out(const ZpSmallMotion *small, size_t which, int half, const double *x) {
  const Work *w = small->memory;
  const Member *of = &w->member[which];
  double sum = 0;
  for (const End *end = of->end; end < of->end + of->ends; end++)
    for (size_t r = 0; r < of->m + of->z && end->half == half; r++)
      sum += end->out[r] * x[rate_of(of, r)];
  return sum;
}
