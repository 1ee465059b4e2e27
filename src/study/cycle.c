/* Study `cycle`: the periodic motion under a periodic drive, and the results of one cycle. docs/theory.md, section 24.
 *
 * Small motion is linear (cycle_linear.c). Of any other, the motion from one start of a cycle to the next is a map of
 * the state, and a periodic motion is a fixed point of it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "def/check.h"
#include "math/elementary.h"
#include "run/margins.h"
#include "run/run.h"
#include "solve/fixed_point.h"
#include "study/cycle_linear.h"
#include "study/notes.h"
#include "study/sensitivity.h"
#include "study/studies.h"

enum { PHASES = 100, HISTORY = 5 }; /* rows of a cycle; number of starts that are stored */
enum { SLOW = ZP_BEADS + 1 };       /* what may take many cycles: liquid at the edges, and remaining charge */

/* Numbers that are compared between two starts of cycles. */
typedef struct Mark {
  double *q;    /* of all members, m */
  double *rate; /* [opening] of each opening, m/s */
  double (
      *slow)[SLOW]; /* [members] volume outside the faces over that of the bead; interface voltage over the drive's */
} Mark;

/* How large the motion of a cycle is. */
typedef struct Response {
  double size, rate; /* half of the range of the spread, m, and of its rate, m/s */
  double spent,
      kept; /* energy that the source and driven curvatures have given in the cycle: lost, and stored at its end, J */
  double drawn; /* all that it has given before it took some back, J */
} Response;

/* Liquid at the edges of a bead in a cycle, m^3: at its start, least and most. */
typedef struct Edge {
  double start, least, most;
} Edge;

typedef struct Range {
  double least, most;
} Range;

/* Ranges in a cycle of an opening, or of the gap that closes last, of the actuator or of each member of a network, m;
 * of its spread (zp_spread), m; of the rate of that, m/s. */
typedef struct Opens {
  Range opening, spread, rate;
} Opens;

typedef struct Cycles {
  ZpSim *sim;
  const ZpModel *model;
  const ZpHooks *hooks;
  ZpTable *rows;              /* of the last cycle */
  double load[PHASES + 1][2]; /* x and y of the point that the load hangs on, by row, m */
  double spread[PHASES + 1];  /* of the actuator or its first member, m */
  double lifted[PHASES + 1];  /* of a network: zp_sim_lifted, J */
  double period;              /* s */
  double highest;             /* size of the command, V */
  double far, fast;           /* units of positions and velocities in a search, m, m/s, the latter of the node with: */
  double heaviest;            /* the largest mass, kg */
  Response response;          /* of the last cycle */
  Edge (*edge)[ZP_BEADS];     /* [members] likewise */
  Opens *opens;               /* [opening] likewise */
  size_t opening;             /* how many there are */
  Mark mark[HISTORY];         /* the newest first */
  double moved[2];            /* distance between the last two starts, and the one before, relative to the response */
  double least[2];            /* least distance in this quarter of the cycles, and in the one before */
  ZpFixedPoint shooting;      /* to the fixed point, while the actuator stays open or closed */
  double *start, *end, *next; /* states at a cycle's start, at its end, and where the next one starts, as vectors */
  void *way_back;             /* a snapshot of a cycle's end, if the next one starts elsewhere: */
  bool foreseen;              /* at a fixed point that the search foresees */
  int64_t steps_of[PHASES];   /* in each row of a cycle */
  bool refills;               /* each cycle starts with the same liquid at the edges */
  double frozen_at;           /* size of the response for which cycles have those steps, m; 0: steps are free */
  int done;                   /* cycles so far */
  int repeats;                /* cycles in which the motion repeats itself; 0: it has not repeated itself */
  int alike;                  /* how often in a row that was so */
  bool linear;                /* the answer is the linear one */
  ZpLinearCycle small;        /* it, or the start of the search */
  ZpRunInfo info;             /* of the last piece */
  int64_t steps;
  void *memory;
} Cycles;

/* -- one cycle -------------------------------------------------------------------------------------- */

static Range with(Range range, double value, bool first) {
  return first ? (Range){value, value} : (Range){fmin(range.least, value), fmax(range.most, value)};
}

static double half_of(Range range) {
  return 0.5 * (range.most - range.least);
}

/* The opening where all hang, m. */
static double hanging(const Cycles *c, size_t which) {
  return zp_is_network(c->model) ? c->sim[which].state->opening0 : zp_sim_hanging(c->sim);
}

/* Has each opening a member of its own, or are several in series? */
static bool is_one_of_all(const Cycles *c) {
  return c->model->members > 1 && !zp_is_network(c->model);
}

static ZpMotion motion_of(const Cycles *c, size_t which) {
  return zp_state_motion(c->sim[which].model, c->sim[which].state);
}

static double rate_of(const Cycles *c, size_t which) {
  if (is_one_of_all(c)) return zp_sim_get(c->sim, "end_velocity");
  ZpMotion motion = motion_of(c, which);
  return zp_spread_change(c->sim[which].model, (ZpNodes){motion.vx, motion.vy});
}

static double spread_of(const Cycles *c, size_t which) {
  if (is_one_of_all(c)) return zp_sim_get(c->sim, "opening");
  ZpMotion motion = motion_of(c, which);
  return zp_spread(c->sim[which].model, (ZpNodes){motion.x, motion.y});
}

static double opening_of(const Cycles *c, size_t which) {
  if (is_one_of_all(c)) return zp_sim_get(c->sim, "opening");
  return zp_last_gap(c->sim[which].model, motion_of(c, which).y);
}

static void see_openings(Cycles *c, bool first) {
  for (size_t k = 0; k < c->opening; k++) {
    c->opens[k].opening = with(c->opens[k].opening, opening_of(c, k), first);
    c->opens[k].spread = with(c->opens[k].spread, spread_of(c, k), first);
    c->opens[k].rate = with(c->opens[k].rate, rate_of(c, k), first);
  }
}

/* The row at a phase of the cycle under way; the first and the last are its ends. */
static void keep_row(Cycles *c) {
  const size_t row = c->rows->rows;
  const ZpSim *loaded = zp_sim_loaded(c->sim);
  ZpMotion motion = zp_state_motion(loaded->model, loaded->state);
  c->load[row][0] = zp_load_at(loaded->model, motion.x);
  c->load[row][1] = zp_load_at(loaded->model, motion.y);
  zp_sim_read_columns(c->sim, c->rows->columns, c->rows->value + row * c->rows->columns);
  c->rows->rows++;
  see_openings(c, row == 0);
  c->spread[row] = spread_of(c, 0);
  c->lifted[row] = zp_is_network(c->model) ? zp_sim_lifted(c->sim) : 0;
  zp_sim_see(c->sim);
}

static void see_edges(Cycles *c, bool starts) {
  for (size_t k = 0; k < c->sim->members; k++)
    for (int half = 0; half < ZP_BEADS; half++) {
      Edge *edge = &c->edge[k][half];
      double outside = c->sim[k].state->bead[half].outside;
      if (starts) *edge = (Edge){outside, outside, outside};
      edge->least = fmin(edge->least, outside);
      edge->most = fmax(edge->most, outside);
    }
}

/* => false if the run ended before: c->info says how. */
static bool run_cycle(Cycles *c) {
  c->rows->rows = 0;
  see_edges(c, true);
  zp_sim_watch(c->sim);
  keep_row(c);
  for (int k = 1; k <= PHASES; k++) {
    double end = k == PHASES ? (c->done + 1.0) * c->period : (c->done + (double)k / PHASES) * c->period;
    if (c->frozen_at > 0) c->sim->dynamics.stepper.fixed = c->period / PHASES / (double)c->steps_of[k - 1];
    zp_sim_run(c->sim, end, false, c->hooks, &c->info);
    if (!(c->frozen_at > 0)) c->steps_of[k - 1] = c->info.steps > 2 ? c->info.steps : 2;
    c->steps += c->info.steps;
    if (c->info.outcome != ZP_REACHED_END) return false;
    keep_row(c);
    see_edges(c, false);
  }
  c->done++;
  return true;
}

/* -- the linear answer ------------------------------------------------------------------------------ */

/* Move the ribbons to a phase of the cycle, at the voltage in the middle between both, so that the source does its work
 * along the way; then let the voltage glide and jump. */
static void put(Cycles *c, double turns) {
  double t = turns * c->period;
  for (ZpSim *m = c->sim; m < c->sim + c->sim->members; m++)
    zp_sim_glide(m, 0.5 * (m->state->U + zp_waveform_voltage_before(&m->model->waveform, t)));
  zp_linear_cycle_put(&c->small, turns, c->sim);
  for (ZpSim *m = c->sim; m < c->sim + c->sim->members; m++) {
    m->state->t = t;
    zp_sim_glide(m, zp_waveform_voltage_before(&m->model->waveform, t));
    zp_sim_jump(m, zp_waveform_voltage(&m->model->waveform, t));
    if (m->state->U != m->state->base_U) zp_sim_close_balance(m);
  }
}

/* The first cycle begins at the state of the linear answer. */
static void start_linear(Cycles *c) {
  zp_linear_cycle_put(&c->small, 0, c->sim);
  for (ZpSim *m = c->sim; m < c->sim + c->sim->members; m++)
    zp_sim_start_balance(m);
  zp_sim_start_row(c->sim);
}

static void ride(Cycles *c) {
  start_linear(c);
  zp_sim_watch(c->sim);
  keep_row(c);
  for (int k = 1; k <= PHASES; k++) {
    double t = c->sim->state->t, to = k * c->period / PHASES;
    while ((t = zp_waveform_next_corner(&c->model->waveform, t)) < to)
      put(c, t / c->period);
    put(c, (double)k / PHASES);
    keep_row(c);
  }
  c->repeats = 1;
  c->info.outcome = ZP_REACHED_END;
}

/* -- how large the motion is ------------------------------------------------------------------------ */

static double at(const Cycles *c, int row, const char *column) {
  return zp_table_get(c->rows, (size_t)row, column);
}

static Range range_of(const Cycles *c, const char *column) {
  Range range = {INFINITY, -INFINITY};
  for (int k = 0; k <= PHASES; k++)
    range = with(range, at(c, k, column), k == 0);
  return range;
}

static double half_range(const Cycles *c, const char *column) {
  return half_of(range_of(c, column));
}

/* Energy that the source delivers in a cycle, and that it takes back, J. */
static void energies_of(const Cycles *c, double *given, double *taken) {
  *given = *taken = 0;
  for (int k = 0; k < PHASES; k++) {
    double change = at(c, k + 1, "source_energy_J") - at(c, k, "source_energy_J");
    *given += fmax(change, 0);
    *taken += fmax(-change, 0);
  }
}

/* Energy stored at the end of a cycle less that at its start, J. */
static double kept(const Cycles *c) {
  const ZpLedger *ledger = &c->model->ledger;
  double sum = at(c, PHASES, "cable_energy_J") - at(c, 0, "cable_energy_J"); /* the supply's */
  for (size_t k = 0; k < ledger->rows; k++) {
    double change = at(c, PHASES, ledger->row[k]->column) - at(c, 0, ledger->row[k]->column);
    bool shown = !isnan(change); /* the row of a program's own law has no column */
    if (shown && ledger->row[k]->kind == ZP_ROW_STORED) sum += change;
  }
  return sum;
}

/* Of what drives natural curvatures, J; 0 where nothing does. */
static double curvature_work(const Cycles *c) {
  return at(c, PHASES, "curvature_work_J") - at(c, 0, "curvature_work_J");
}

static Response response_of(const Cycles *c) {
  double given, taken, stored = kept(c);
  energies_of(c, &given, &taken);
  Response response = {0, 0, given + curvature_work(c) - taken - stored, stored, given};
  for (const Opens *o = c->opens; o < c->opens + c->opening; o++) {
    response.size = fmax(response.size, half_of(o->spread));
    response.rate = fmax(response.rate, half_of(o->rate));
  }
  return response;
}

/* -- is it periodic? -------------------------------------------------------------------------------- */

/* Coordinates of all members. */
static size_t positions(const ZpSim *sim) {
  size_t sum = 0;
  for (const ZpSim *m = sim; m < sim + sim->members; m++)
    sum += zp_coordinates(m->model);
  return sum;
}

static void take_mark(Cycles *c) {
  Mark oldest = c->mark[HISTORY - 1];
  double *q = oldest.q;
  memmove(c->mark + 1, c->mark, (HISTORY - 1) * sizeof *c->mark);
  for (size_t k = 0; k < c->sim->members; k++) {
    ZpSim *m = c->sim + k;
    memcpy(q, zp_state_q(m->model, m->state), zp_coordinates(m->model) * sizeof *q);
    q += zp_coordinates(m->model);
    for (int half = 0; half < ZP_BEADS; half++)
      oldest.slow[k][half] = m->model->has_bead ? m->state->bead[half].outside / m->model->bead.volume : 0;
    oldest.slow[k][ZP_BEADS] = zp_sim_leak(m).mean / c->highest;
  }
  for (size_t k = 0; k < c->opening; k++)
    oldest.rate[k] = rate_of(c, k);
  c->mark[0] = oldest;
}

/* Distances are relative to the response, or to what rounding makes of positions and energies if that is more. */
static double size_of_response(const Cycles *c) {
  static const double rounding = 1e-11;
  return fmax(c->response.size, rounding * c->far);
}

/* Distance of the newest start from the one `back` cycles before. */
static double distance(const Cycles *c, int back) {
  const double *a = c->mark[0].q, *b = c->mark[back].q;
  double most = 0;
  for (size_t k = 0; k < positions(c->sim); k++)
    most = fmax(most, fabs(a[k] - b[k]));
  most /= size_of_response(c);
  for (size_t k = 0; k < c->sim->members; k++)
    for (int i = 0; i < SLOW; i++)
      most = fmax(most, fabs(c->mark[0].slow[k][i] - c->mark[back].slow[k][i]));
  double fast = fmax(c->response.rate, size_of_response(c) / c->period);
  for (size_t k = 0; k < c->opening; k++)
    most = fmax(most, fabs(c->mark[0].rate[k] - c->mark[back].rate[k]) / fast);
  return most;
}

/* Does the cycle store next to nothing, eq. (24.2)? */
static bool keeps_nothing(const Cycles *c) {
  static const double rounding = 1e-9;
  double energy = fmax(fabs(c->response.spent), rounding * c->response.drawn);
  return fabs(c->response.kept) < 10 * c->model->def.cycle.tolerance * energy;
}

/* Number of cycles in which the motion repeats itself; 0: it does not yet. */
static int repeats_in(Cycles *c) {
  static const double slowest = 1 - 1e-4;
  double tolerance = c->model->def.cycle.tolerance;
  c->moved[1] = c->moved[0];
  c->moved[0] = distance(c, 1);
  if (c->done < 3) return 0;
  /* all further changes, eq. (24.1), if each is smaller than the previous one by the same factor */
  double share = c->moved[1] > 0 ? c->moved[0] / c->moved[1] : 0, ahead = c->moved[0] / (1 - fmin(share, slowest));
  if (ahead < tolerance && keeps_nothing(c)) return 1;
  for (int back = 2; back < HISTORY && back < c->done; back++)
    if (distance(c, back) < tolerance && c->moved[0] > 10 * tolerance) return back;
  return 0;
}

/* -- shooting --------------------------------------------------------------------------------------- */

/* A state as a vector: what decides, in units of its own (positions of all members, velocities, interface voltages,
 * driven curvatures), then what is carried along: rates of the last step, and what the laws know beyond positions. */
static size_t leaked(const ZpModel *model) {
  return model->leaks ? zp_law(model, &zp_term_leak)->state : 0;
}

static size_t deciding(const ZpSim *sim) {
  size_t sum = 2 * positions(sim);
  for (const ZpSim *m = sim; m < sim + sim->members; m++)
    sum += leaked(m->model) + m->model->driven.places;
  return sum;
}

static size_t carried_by(const ZpModel *model) {
  return 2 * zp_coordinates(model) + zp_extra_unknowns(model) + model->kept;
}

static size_t carried(const ZpSim *sim) {
  size_t sum = 0;
  for (const ZpSim *m = sim; m < sim + sim->members; m++)
    sum += carried_by(m->model);
  return sum;
}

/* Unit of a velocity, larger for a small mass, so that squares are like energies. */
static double speed_of(const Cycles *c, const ZpModel *model, size_t k) {
  double mass = model->mass[k % zp_lanes(model)];
  return mass > 0 ? c->fast * sqrt(c->heaviest / mass) : c->fast;
}

/* Where the numbers of one member stand in a vector; the next one's follow. */
typedef struct Place {
  size_t q, v, slow, carried;
} Place;

static Place first_place(const ZpSim *sim) {
  return (Place){0, positions(sim), 2 * positions(sim), deciding(sim)};
}

static Place next_place(Place at, const ZpModel *model) {
  size_t n = zp_coordinates(model);
  return (Place){at.q + n, at.v + n, at.slow + leaked(model) + model->driven.places, at.carried + carried_by(model)};
}

static void read_state(const Cycles *c, double *x) {
  Place at = first_place(c->sim);
  for (ZpSim *m = c->sim; m < c->sim + c->sim->members; at = next_place(at, m->model), m++) {
    const double *q = zp_state_q(m->model, m->state), *v = zp_state_v(m->model, m->state);
    const double *of_leak = zp_law_state(m->model, &zp_term_leak, m->state),
                 *kappa = zp_law_state(m->model, &zp_term_curvature, m->state);
    for (size_t k = 0; k < zp_coordinates(m->model); k++) {
      x[at.q + k] = q[k] / c->far;
      x[at.v + k] = v[k] / speed_of(c, m->model, k);
    }
    for (size_t k = 0; k < leaked(m->model); k++)
      x[at.slow + k] = of_leak[k] / c->highest;
    for (size_t p = 0; p < m->model->driven.places; p++)
      x[at.slow + leaked(m->model) + p] = kappa[p] * m->model->L;
    memcpy(x + at.carried, zp_state_mean_v(m->model, m->state), carried_by(m->model) * sizeof *x);
  }
}

/* Liquid at the edges goes its own way from cycle to cycle. Where it runs dry in every cycle, it does so by jumps from
 * step to step. The motion hardly depends on it then; so, if half of the cycles have led nowhere, each of the others
 * starts with the same amount, enough for a cycle: after one in which it has nearly run dry, with more by its range. */
static void refill(Cycles *c) {
  for (size_t k = 0; k < c->sim->members; k++)
    for (int half = 0; c->sim[k].model->has_bead && half < ZP_BEADS; half++) {
      const Edge *edge = &c->edge[k][half];
      double range = edge->most - edge->least;
      c->sim[k].state->bead[half].outside = edge->start + (edge->least < 0.25 * range ? range : 0);
    }
}

/* The next cycle starts there, with a new account of energy. */
static void write_state(Cycles *c, const double *x) {
  Place at = first_place(c->sim);
  if (c->refills) refill(c);
  for (ZpSim *m = c->sim; m < c->sim + c->sim->members; at = next_place(at, m->model), m++) {
    double *q = zp_state_q(m->model, m->state), *v = zp_state_v(m->model, m->state);
    memcpy(zp_state_mean_v(m->model, m->state), x + at.carried, carried_by(m->model) * sizeof *x);
    for (size_t k = 0; k < zp_coordinates(m->model); k++) {
      q[k] = c->far * x[at.q + k];
      v[k] = speed_of(c, m->model, k) * x[at.v + k];
    }
    zp_pouch_refill(m->model, q);
    zp_sim_lay_beads(m);
    if (m->state->U != m->state->base_U) zp_sim_close_balance(m);
    zp_sim_start_balance(m);
  }
  zp_sim_start_row(c->sim);
}

/* An actuator that stays open, or closed, moves smoothly from start to start, with little damping of its swing. So a
 * few cycles predict what thousands would lead to. */
static bool stays(const Cycles *c) {
  bool all = true;
  for (size_t k = 0; k < c->opening && all; k++) {
    const Range opening = c->opens[k].opening;
    all = !(opening.least <= 0.1 * hanging(c, k)) || opening.most < zp_closed_opening(c->sim[k].model, hanging(c, k));
  }
  return all;
}

/* Is the motion periodic, judged by the distance from the cycle's start to the predicted fixed point? Otherwise the
 * next cycle starts at that point. */
static int shoot(Cycles *c) {
  static const double farthest = 0.5; /* of the units of what decides; a farther point is not used */
  double ahead = 0, other = 0;
  zp_fixed_point_next(&c->shooting, c->start, c->end, c->next);
  for (size_t k = 0; k < deciding(c->sim); k++) {
    double *most = k < positions(c->sim) ? &ahead : &other;
    *most = fmax(*most, fabs(c->next[k] - c->start[k]));
  }
  double away = ahead * c->far / size_of_response(c);
  if (c->shooting.pairs >= 2 && fmax(away, c->moved[0]) < c->model->def.cycle.tolerance && keeps_nothing(c)) return 1;
  c->foreseen = fmax(ahead, other) < farthest;
  if (!c->foreseen) return 0;
  zp_sim_save(c->sim, c->way_back);
  write_state(c, c->next);
  return 0;
}

/* From a state that is none of an actuator, where the search has led, back to where the cycle before has ended. */
static bool go_back(Cycles *c) {
  if (!c->foreseen || (c->info.outcome != ZP_DIVERGED && c->info.outcome != ZP_BEYOND_MODEL)) return false;
  zp_sim_restore(c->sim, c->way_back, zp_sim_state_size(c->sim), NULL);
  zp_fixed_point_forget(&c->shooting);
  c->foreseen = false;
  if (c->frozen_at > 0) c->frozen_at = c->sim->dynamics.stepper.fixed = 0;
  read_state(c, c->start);
  return true;
}

/* Steps that the local error chooses differ a little from cycle to cycle, and the search sees that as noise. From the
 * second cycle on, each row has as many steps as in the cycle before, at least two, until the motion has become much
 * larger. */
static void freeze(Cycles *c, bool smooth) {
  static const double larger = 1.5;
  if (isfinite(c->model->def.solver.time_step)) return;
  bool keep = smooth && c->done > 1 && c->response.size < larger * c->frozen_at;
  if (keep) return;
  bool again = smooth && c->done > 1 && !(c->frozen_at > 0);
  c->frozen_at = again ? size_of_response(c) : 0;
  if (!again) c->sim->dynamics.stepper.fixed = 0;
}

/* Number of cycles in which the motion repeats itself, by waiting or by shooting, which does not know what a ribbon
 * that yields has been through. */
static int look(Cycles *c) {
  read_state(c, c->end);
  bool yields = at(c, PHASES, "plastic_loss_J") > at(c, 0, "plastic_loss_J"), smooth = stays(c) && !yields;
  c->sim->dynamics.settles = smooth;
  freeze(c, smooth);
  bool refills = smooth && c->model->has_bead && 2 * c->done > c->model->def.cycle.most_cycles;
  if (!smooth || refills != c->refills) zp_fixed_point_forget(&c->shooting);
  c->refills = refills;
  c->foreseen = false;
  int waiting = repeats_in(c), repeats = smooth ? shoot(c) : waiting;
  read_state(c, c->start);
  return repeats;
}

/* If, in a quarter of the cycles, the least distance of starts is more than half of that in the quarter before, the
 * remaining cycles lead nowhere. */
static bool leads_nowhere(Cycles *c) {
  enum { FEWEST = 6 };
  int quarter = (c->model->def.cycle.most_cycles + 3) / 4;
  if (quarter < FEWEST) quarter = FEWEST;
  c->least[0] = fmin(c->least[0], c->moved[0]);
  if (c->done % quarter != 0) return false;
  bool nowhere = c->alike == 0 && !stays(c) && c->least[0] > 0.5 * c->least[1];
  c->least[1] = c->least[0];
  c->least[0] = INFINITY;
  return nowhere;
}

/* Until the motion is periodic, a few times in a row where that takes several cycles, or until the run ends. */
static void settle(Cycles *c) {
  read_state(c, c->start);
  c->least[0] = c->least[1] = INFINITY;
  while (c->done < c->model->def.cycle.most_cycles) {
    if (!run_cycle(c)) {
      if (go_back(c)) continue;
      return;
    }
    take_mark(c);
    c->response = response_of(c);
    int repeats = look(c);
    c->alike = repeats > 0 && repeats == c->repeats ? c->alike + 1 : repeats > 0;
    c->repeats = repeats;
    if (repeats == 1 || c->alike > 2 * HISTORY) return;
    if (leads_nowhere(c)) break;
  }
  c->repeats = 0;
}

/* -- the results of a cycle ------------------------------------------------------------------------ */

/* A part of a periodic signal. */
typedef struct Harmonic {
  double cosine, sine;
} Harmonic;

/* Faces attract with the square of a voltage; without them it drives a curvature. */
static double drive_of(const Cycles *c, double U) {
  return c->model->field ? U * U : zp_driven_aim(c->model->driven.place, U);
}

/* Of the drive, or of minus the spread. */
static Harmonic harmonic(const Cycles *c, bool of_drive, int n) {
  Harmonic sum = {0, 0};
  for (int k = 0; k < PHASES; k++) {
    double value = of_drive ? drive_of(c, at(c, k, "command_V")) : -c->spread[k], turns = (double)(n * k) / PHASES;
    sum.cosine += 2.0 / PHASES * value * zp_cosine_of(turns);
    sum.sine += 2.0 / PHASES * value * zp_sine_of(turns);
  }
  return sum;
}

static double size_of(Harmonic h) {
  return sqrt(h.cosine * h.cosine + h.sine * h.sine);
}

/* Lag of closing behind the squared command, or behind the driven curvature, rad, -pi / 2 to 3 pi / 2: of the harmonic
 * that is larger there. */
static double phase_of(const Cycles *c) {
  Harmonic first = harmonic(c, true, 1), second = harmonic(c, true, 2);
  int n = size_of(second) > size_of(first) ? 2 : 1;
  Harmonic drive = n == 1 ? first : second, moves = harmonic(c, false, n);
  double product = size_of(drive) * size_of(moves);
  if (!(product > 0)) return NAN;
  double cosine = drive.cosine * moves.cosine + drive.sine * moves.sine,
         sine = drive.cosine * moves.sine - drive.sine * moves.cosine;
  double phase = zp_angle(sine, cosine);
  return phase < -0.5 * zp_pi ? phase + 2 * zp_pi : phase; /* a lag above its resonance is near pi */
}

/* Work against pull and springs of the load in row k, J. A spring of a hinge is not part of the load. */
static double work_in_row(const Cycles *c, int k) {
  const double *from = c->load[k], *to = c->load[k + 1];
  if (!zp_has_platform(&c->model->topology)) return zp_load_work(c->model, to[0] - from[0], to[1] - from[1]);
  double risen = at(c, k, "opening_m") - at(c, k + 1, "opening_m"), lifted = c->lifted[k + 1] - c->lifted[k];
  double compressed = at(c, k + 1, "spring_energy_J") - at(c, k, "spring_energy_J");
  return (zp_is_network(c->model) ? lifted : zp_total_pull(c->model) * risen) + compressed;
}

/* A number of a cycle that is not of a periodic motion says nothing: NAN. */
static void add_periodic(const Cycles *c, ZpResult *result, const char *name, const char *unit, double value) {
  zp_result_add(result, name, unit, c->repeats == 1 ? value : NAN);
}

static void add_of(const Cycles *c, ZpResult *result, const char *pattern, const char *called, const char *unit,
                   double value) {
  zp_result_add_of(result, pattern, called, unit, c->repeats == 1 ? value : NAN);
}

/* The range of a number of a body: "#.y_m" => bodies.#.y_min_m, bodies.#.y_max_m. */
static void add_body(const Cycles *c, ZpResult *result, const char *called, const ZpColumn *of) {
  char column[2 * ZP_NAME_SIZE], least[2 * ZP_NAME_SIZE], most[2 * ZP_NAME_SIZE];
  const int name = (int)(strrchr(of->name, '_') - of->name);
  snprintf(column, sizeof column, "%s%s", called, of->name + 1);
  snprintf(least, sizeof least, "bodies.%.*s_min%s", name, of->name, of->name + name);
  snprintf(most, sizeof most, "bodies.%.*s_max%s", name, of->name, of->name + name);
  const Range range = range_of(c, column);
  add_of(c, result, least, called, of->unit, range.least);
  add_of(c, result, most, called, of->unit, range.most);
}

/* Has an opening been closed in the cycle? */
static bool closes(const Cycles *c, size_t which) {
  return c->opens[which].opening.least < zp_closed_opening(c->sim[which].model, hanging(c, which));
}

/* Each member of a network has an opening, each body a place. It closes if all members do. */
static void summarize_network(const Cycles *c, ZpResult *result) {
  char room[ZP_NAME_SIZE];
  bool all = true;
  for (size_t k = 1; k <= c->model->members; k++) {
    const char *called = zp_member_called(c->model->whole, k, room);
    add_of(c, result, "members.#.opening_min_m", called, "m", c->opens[k - 1].opening.least);
    add_of(c, result, "members.#.opening_max_m", called, "m", c->opens[k - 1].opening.most);
    zp_result_add_of(result, "members.#.closes", called, "count", closes(c, k - 1));
    all &= closes(c, k - 1);
  }
  zp_result_add(result, "closes", "count", all);
  for (size_t body = 1; body < c->model->network->bodies; body++) {
    size_t columns;
    const ZpColumn *column = zp_body_columns(c->model->network->plane, &columns);
    for (size_t k = 0; k < columns; k++)
      add_body(c, result, zp_body_called(c->model->whole, body, room), &column[k]);
  }
}

/* A name for its least value, and for its largest one. */
static void add_range(const Cycles *c, ZpResult *result, const char *least, const char *most, const char *unit,
                      Range range) {
  add_periodic(c, result, least, unit, range.least);
  add_periodic(c, result, most, unit, range.most);
}

static void summarize_motion(const Cycles *c, ZpResult *result) {
  zp_result_add(result, "frequency_Hz", "Hz", 1 / c->period);
  zp_result_add(result, "periodic", "count", c->repeats == 1);
  zp_result_add(result, "linear", "count", c->linear);
  zp_result_add(result, "second_order", "1", isfinite(c->small.curvature) ? c->small.curvature : NAN);
  zp_result_add(result, "cycles", "count", c->linear ? NAN : (double)c->done);
  zp_result_add(result, "repeats_in_cycles", "count", c->repeats > 0 ? (double)c->repeats : NAN);
  if (zp_is_network(c->model)) {
    summarize_network(c, result);
    return;
  }
  if (zp_is_pair(&c->model->topology))
    add_range(c, result, "opening_min_m", "opening_max_m", "m", c->opens->opening);
  else
    add_range(c, result, "stroke_min_m", "stroke_max_m", "m", range_of(c, "stroke_m"));
  if (c->model->flat) add_range(c, result, "contraction_min", "contraction_max", "1", range_of(c, "contraction"));
  add_periodic(c, result, "stroke_amplitude_m", "m", half_range(c, "stroke_m"));
  add_periodic(c, result, "phase_rad", "rad", phase_of(c));
  zp_result_add(result, "closes", "count", c->model->field ? closes(c, 0) : NAN);
}

/* Work on the load over what the source gives in a cycle. */
static void add_efficiency(const Cycles *c, ZpResult *result, const char *name, double work, double energy) {
  add_periodic(c, result, name, "1", energy > 0 && work <= energy ? work / energy : NAN);
  if (c->repeats == 1 && energy > 0 && work > energy)
    zp_result_note(result,
                   "%s is null: the load swings; %.3g J of work lift it in a cycle, more than the %.3g J that the "
                   "source gives, because what it gives back on its way down lifts it again",
                   name, work, energy);
}

static void summarize_energy(const Cycles *c, ZpResult *result) {
  double work = 0, square = 0, jumps = at(c, PHASES, "charging_loss_J") - at(c, 0, "charging_loss_J"),
         energy = c->linear ? c->small.energy + jumps : c->response.spent;
  Range current = range_of(c, "current_A");
  for (int k = 1; k <= PHASES; k++) {
    work += fmax(work_in_row(c, k - 1), 0); /* on the way up; on the way down it is returned */
    square += at(c, k, "current_A") * at(c, k, "current_A") / PHASES;
  }
  add_periodic(c, result, "energy_per_cycle_J", "J", energy);
  add_periodic(c, result, "energy_drawn_per_cycle_J", "J", c->response.drawn);
  if (c->model->driven.places > 0) add_periodic(c, result, "curvature_work_per_cycle_J", "J", curvature_work(c));
  add_periodic(c, result, "work_per_cycle_J", "J", work);
  add_periodic(c, result, "power_W", "W", energy / c->period);
  add_efficiency(c, result, "efficiency", work, energy);
  add_efficiency(c, result, "efficiency_without_recovery", work, c->response.drawn);
  if (c->repeats != 1) zp_result_note(result, "the motion is not periodic: numbers of a cycle are null");
  add_periodic(c, result, "peak_current_A", "A", jumps > 0 ? NAN : fmax(current.most, -current.least));
  add_periodic(c, result, "rms_current_A", "A", jumps > 0 ? NAN : sqrt(square));
}

static void describe(const Cycles *c, ZpResult *result) {
  char *text = result->message;
  size_t size = sizeof result->message;
  result->outcome = c->info.outcome;
  if (c->info.outcome != ZP_REACHED_END)
    snprintf(text, size, "%s", c->info.message);
  else if (c->linear)
    snprintf(text, size, "linear: motion of second order is %.1g of the amplitude", c->small.curvature);
  else if (c->repeats == 1)
    snprintf(text, size, "periodic after %d cycles", c->done);
  else if (c->repeats > 1)
    snprintf(text, size, "after %d cycles the motion repeats itself every %d cycles (subharmonic)", c->done,
             c->repeats);
  else
    snprintf(text, size,
             "not periodic within %d cycles: between the starts of the last two cycles the state still changes by %.2g "
             "of the amplitude (slow decay, beating or chaotic impacts)",
             c->done, c->moved[0]);
}

static void summarize(const Cycles *c, ZpResult *result) {
  describe(c, result);
  if (c->info.outcome != ZP_REACHED_END) return;
  summarize_motion(c, result);
  summarize_energy(c, result);
  double start = at(c, 0, "time_s"); /* rows count from the start of their cycle */
  for (size_t k = 0; k < c->rows->rows; k++)
    c->rows->value[k * c->rows->columns] -= start;
  zp_result_add(result, "steps", "count", (double)c->steps);
  ZpMargins seen = zp_sim_margins(c->sim);
  if (c->model->field)
    zp_add_margins(result, c->model, &seen);
  else
    zp_add_stress(result, c->model, &seen);
  zp_note_mesh(result, c->model, zp_waveform_largest(&c->model->waveform));
  if (c->model->field && !zp_is_network(c->model)) zp_note_start(result, c->model, c->sim->state->opening0);
  zp_note_liquid(result, c->model);
  if (c->repeats == 1 && c->refills)
    zp_result_note(result,
                   "bead: the motion is that with enough liquid at the edges of the ribbons; over a cycle that "
                   "liquid changes by %.2g uL at a front",
                   1e9 * (c->sim->state->bead[0].outside - c->edge[0][0].start));
}

/* -- the study -------------------------------------------------------------------------------------- */

static size_t reserve(Cycles *c, void *block) {
  size_t n = deciding(c->sim) + carried(c->sim);
  ZpArena arena = {block, 0};
  for (Mark *mark = c->mark; mark < c->mark + HISTORY; mark++) {
    mark->q = zp_arena_take(&arena, positions(c->sim));
    mark->rate = zp_arena_take(&arena, c->opening);
    mark->slow = zp_arena_take_of(&arena, c->sim->members, sizeof *mark->slow);
  }
  c->opens = zp_arena_take_of(&arena, c->opening, sizeof *c->opens);
  c->edge = zp_arena_take_of(&arena, c->sim->members, sizeof *c->edge);
  double **of_states[] = {&c->start, &c->end, &c->next};
  for (size_t k = 0; k < sizeof of_states / sizeof of_states[0]; k++)
    *of_states[k] = zp_arena_take(&arena, n);
  zp_fixed_point_reserve(&c->shooting, n, deciding(c->sim), &arena);
  return arena.used;
}

static bool create(Cycles *c, const ZpModel *model, ZpResult *result) {
  static const double least_gravity = 1e-3; /* m/s2 */
  c->model = model;
  c->period = zp_waveform_period(&model->waveform);
  c->highest = fmax(zp_waveform_largest(&model->waveform), 1);
  c->far = model->faces.depth;
  c->opening = zp_is_network(model) ? model->members : 1;
  for (size_t k = 0; k < c->opening; k++)
    c->far = fmax(c->far, c->sim[k].state->opening0);
  for (const ZpModel *m = model; m < model + model->members; m++)
    for (size_t j = 0; j < zp_lanes(m); j++)
      c->heaviest = fmax(c->heaviest, m->mass[j]);
  c->fast = sqrt(fmax(model->def.gravity, least_gravity) * c->far);
  result->series = c->rows = zp_signal_table(model->whole, PHASES + 1);
  c->way_back = zp_calloc(1, zp_sim_state_size(c->sim));
  c->memory = zp_calloc(1, reserve(c, NULL));
  if (c->memory) reserve(c, c->memory);
  return c->rows && c->way_back && c->memory;
}

/* Find the linear answer where it is wanted and there is one, and choose => false if there is no memory. */
static bool choose(Cycles *c) {
  const ZpActuatorDef *def = c->model->whole;
  bool failed = false;
  ZpActuatorDef linear = *def;
  linear.cycle.method = ZP_CYCLE_LINEAR;
  c->small.curvature = NAN;
  if (def->cycle.method == ZP_CYCLE_MOTION || zp_rules_find(&zp_rules_cycle, false, &linear)) return true;
  bool found = zp_linear_cycle_open(c->model, c->hooks, &c->small, &failed);
  c->linear = found && (def->cycle.method == ZP_CYCLE_LINEAR || c->small.curvature < def->cycle.tolerance);
  if (def->cycle.method != ZP_CYCLE_LINEAR || found || failed) return !failed;
  c->info.outcome = ZP_PULLED_IN;
  snprintf(c->info.message, sizeof c->info.message,
           "no stable hanging equilibrium at the root mean square of the voltage, %g V, about which motion could be "
           "linear",
           sqrt(c->small.mean));
  return true;
}

static void answer(Cycles *c) {
  static const double near = 0.3; /* motion of second order, relative to the first: the search begins at the latter */
  if (c->info.outcome == ZP_PULLED_IN) return;
  if (c->linear) {
    ride(c);
    c->response = response_of(c);
    return;
  }
  if (c->small.curvature < near) start_linear(c);
  take_mark(c);
  settle(c);
}

static ZpStatus run(const ZpModel *model, const ZpHooks *hooks, ZpResult *result, ZpError *err) {
  Cycles *c = zp_calloc(1, sizeof *c);
  ZpStatus status = c ? zp_sim_create(model, hooks, &c->sim, err) : zp_fail_memory(err);
  if (status == ZP_OK) {
    c->hooks = hooks;
    if (create(c, model, result) && choose(c)) {
      answer(c);
      summarize(c, result);
    } else
      status = zp_fail_memory(err);
    zp_linear_cycle_close(&c->small);
    zp_free(c->memory);
    zp_free(c->way_back);
    zp_sim_destroy(c->sim);
  }
  zp_free(c);
  return status;
}

/* -- the largest frequency at which it closes ------------------------------------------------------- */

/* How does a cycle at a frequency end: does the actuator close fully? `outcome` is that of the run. */
typedef struct Tried {
  ZpOutcome outcome;
  bool closes;
} Tried;

static ZpStatus try_frequency(const ZpTask *task, double frequency, Tried *tried, ZpError *err) {
  ZpActuatorDef def = *task->def;
  def.drive.frequency = frequency;
  ZpModel *model = NULL;
  ZpResult *result = zp_result_create(ZP_STUDY_CYCLE);
  ZpStatus status = result ? zp_model_create(&def, &model, err) : zp_fail_memory(err);
  if (status == ZP_OK) status = run(model, task->hooks, result, err);
  if (status == ZP_OK) *tried = (Tried){result->outcome, zp_result_get(result, "closes") == 1};
  zp_model_destroy(model);
  zp_result_destroy(result);
  return status;
}

/* Frequencies, Hz: at `low` it closes, at `high` it does not. NAN: none is known yet. */
typedef struct Between {
  double low, high;
} Between;

static bool is_near(Between between) {
  static const double near = 1.02;
  return between.high < near * between.low;
}

/* Search upwards by octaves from the frequency of the Def, or downwards if it does not close there; then bisect =>
 * closing_frequency_Hz. */
static ZpStatus find_closing_frequency(const ZpTask *task, ZpResult *result, ZpError *err) {
  enum { MOST = 24 };
  Between between = {NAN, NAN};
  double f = task->def->drive.frequency;
  bool closes = zp_result_get(result, "closes") == 1;
  for (int k = 0; k < MOST; k++) {
    *(closes ? &between.low : &between.high) = f;
    if (is_near(between)) break;
    bool enclosed = !isnan(between.low) && !isnan(between.high);
    f = enclosed ? sqrt(between.low * between.high) : closes ? 2 * f : f / 2;
    Tried tried;
    ZpStatus status = try_frequency(task, f, &tried, err);
    if (status != ZP_OK) return status;
    if (tried.outcome == ZP_INTERRUPTED) result->outcome = ZP_INTERRUPTED;
    if (tried.outcome != ZP_REACHED_END) break;
    closes = tried.closes;
  }
  zp_result_add(result, "closing_frequency_Hz", "Hz", is_near(between) ? between.low : NAN);
  return ZP_OK;
}

static const char no_begin[] = "what is periodic has no begin",
                  no_control[] = "it finds the periodic motion under a periodic voltage; for a controller use study "
                                 "actuate with a periodic setpoint";

static const ZpRule rule[] = {
    ZP_RULE(NOT_MODELLED, ZP_NETWORK, ZP_NOT(cycle.method, ZP_CYCLE_LINEAR), "the linear answer is that of a stack"),
    ZP_RULE(PHYSICS, ZP_ANY, ZP_IS(control.kind, ZP_CONTROL_NONE), no_control),
    ZP_RULE(PHYSICS, ZP_SET(member_K.control.kind), ZP_NEVER, no_control),
    ZP_RULE(PHYSICS, ZP_ANY,
            ZP_ONE_OF(drive.waveform, ZP_BIT(ZP_WAVEFORM_STEP) | ZP_BIT(ZP_WAVEFORM_SINE) | ZP_BIT(ZP_WAVEFORM_SQUARE)),
            "the drive is periodic (step: sine)"),
    ZP_RULE(PHYSICS, ZP_ANY, ZP_UNSET(drive.delay), no_begin),
    ZP_RULE(PHYSICS, ZP_SET(member_K.drive.delay), ZP_NEVER, no_begin),
    ZP_RULE(PHYSICS, ZP_SET(member_K.drive.frequency), ZP_NEVER, "one drive gives the period of all"),
    ZP_RULE(PHYSICS, ZP_ANY, ZP_UNSET(load.change_mass), "the load is periodic, too; use study actuate"),
    ZP_RULE(PHYSICS, ZP_ANY, ZP_USES_VOLTAGE, "a voltage moves nothing else"),
    ZP_RULE(NOT_MODELLED, ZP_ANY, ZP_IS(solver.integrator, ZP_INTEGRATOR_IMPLICIT), "its cycles have implicit steps"),
    ZP_RULE_STARTS,
    /* the linear answer */
    ZP_RULE(EQUATION, ZP_CURVES_BY_VOLTAGE, ZP_NOT(cycle.method, ZP_CYCLE_LINEAR),
            "the linear answer follows the square of the voltage, and curvature the voltage itself"),
    ZP_RULE_IF(NOT_MODELLED, ZP_SET_WITHIN(member_K.drive.waveform, member_K.setpoint.duty),
               ZP_IS(cycle.method, ZP_CYCLE_LINEAR), ZP_NEVER, "the linear answer is that of one drive"),
    ZP_RULE(EQUATION, ZP_IS(cycle.method, ZP_CYCLE_LINEAR), ZP_IS(ribbon.model, ZP_RIBBON_ROD),
            "the shear law of mass_spring has no energy"),
    ZP_RULE(NOT_MODELLED, ZP_IS(cycle.method, ZP_CYCLE_LINEAR), ZP_IS(electro.model, ZP_ELECTRO_PLATES),
            "the stiffness of a computed field is not available"),
    ZP_RULE(PHYSICS, ZP_IS(cycle.method, ZP_CYCLE_LINEAR), ZP_IS(source.model, ZP_SOURCE_IDEAL),
            "the limits of a supply are not linear"),
    ZP_RULE_IF(NOT_MODELLED, ZP_IS(cycle.method, ZP_CYCLE_LINEAR), ZP_IS(liquid.model, ZP_LIQUID_BEAD),
               ZP_IS(bead.suction, 0), "the small motion of a meniscus that attracts is not modelled"),
    ZP_RULE(PHYSICS, ZP_IS(cycle.method, ZP_CYCLE_LINEAR), ZP_IS(ribbon.plasticity, false), "yielding is not linear"),
    ZP_RULE(NOT_MODELLED, ZP_IS(cycle.method, ZP_CYCLE_LINEAR), ZP_IS(ribbon.relaxation_modulus, 0),
            "the small motion of layers that creep is not modelled"),
    ZP_RULE(NOT_MODELLED, ZP_IS(cycle.method, ZP_CYCLE_LINEAR), ZP_IS(insulator.relaxation_modulus, 0),
            "the small motion of layers that creep is not modelled"),
    ZP_RULE(NOT_MODELLED, ZP_IS(cycle.method, ZP_CYCLE_LINEAR), ZP_UNSET(insulator.resistivity),
            "the small motion of the charge of the faces is not modelled"),
    ZP_RULE(NOT_MODELLED, ZP_IS(cycle.method, ZP_CYCLE_LINEAR), ZP_UNSET(medium.resistivity),
            "the small motion of the charge of the faces is not modelled"),
};
const ZpRules zp_rules_cycle = ZP_RULES_OF(rule);

/* A step of a member alone is a constant voltage, which has any period. */
static ZpStatus check_waveforms(const ZpActuatorDef *def, ZpError *err) {
  for (int k = 1; k <= zp_def_members(def) && zp_def_members(def) > 1; k++) {
    const ZpActuatorDef one = zp_def_member(def, k);
    const ZpWaveformKind kind = one.drive.waveform;
    ZpError reason;
    if (kind != ZP_WAVEFORM_RAMP && kind != ZP_WAVEFORM_TABLE) continue;
    zp_fail(&reason, ZP_BAD_INPUT, "drive.waveform = %s: the drive is periodic; use step, sine or square",
            zp_key(ZP_KEY(drive.waveform))->choices[kind].word);
    return zp_fail_member(def, k, ZP_BAD_INPUT, &reason, err);
  }
  return ZP_OK;
}

ZpStatus zp_check_cycle(const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = check_waveforms(def, err);
  if (status != ZP_OK) return status;
  return zp_def_check_voltage(def, fmax(fabs(def->drive.voltage), fabs(def->drive.offset)), err);
}

ZpStatus zp_study_cycle(const ZpTask *task, ZpResult *result, ZpError *err) {
  ZpActuatorDef def = *task->def;
  if (def.drive.waveform == ZP_WAVEFORM_STEP) def.drive.waveform = ZP_WAVEFORM_SINE; /* a step is repeated as a sine */
  const ZpTask driven = {.def = &def, .hooks = task->hooks};
  ZpModel *model;
  ZpStatus status = zp_model_create(&def, &model, err);
  if (status != ZP_OK) return status;
  status = run(model, task->hooks, result, err);
  bool ended = status == ZP_OK && result->outcome == ZP_REACHED_END;
  if (ended && def.cycle.closing_frequency) status = find_closing_frequency(&driven, result, err);
  zp_note_no_sensitivity(result, task->def);
  zp_model_destroy(model);
  return status;
}
