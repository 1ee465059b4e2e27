/* Letters: x integrals of the rates w of small motions (rest/plant.h), u the squared voltage less its mean, n the
 * number of a harmonic, eqs. (24.4) to (24.8). */
#include "study/cycle_linear.h"

#include <math.h>
#include <string.h>

#include "math/elementary.h"
#include "math/gauss.h"
#include "run/hooks.h"

enum { SINE = 2, BENT = 8, PHASES = 32 }; /* harmonics of a sine, and of forces of second order; their samples */

/* -- the squared voltage ---------------------------------------------------------------------------- */

/* f <- f + a (cos - i sin)(turns) */
static void add_wave(ZpComplex *f, double a, double turns) {
  turns -= floor(turns);
  f->re += a * zp_cosine_of(turns);
  f->im -= a * zp_sine_of(turns);
}

/* Its part between two corners, times s. */
static void add_piece(ZpLinearCycle *l, double from, double to) {
  enum { PARTS = 128 };
  const double period = zp_waveform_period(&l->model->waveform);
  for (int k = 0; k < PARTS; k++)
    for (int g = 0; g < GAUSS; g++) {
      double t = from + (to - from) * (k + gauss_at[g]) / PARTS, U = zp_waveform_voltage(&l->model->waveform, t);
      double part = U * U * gauss_weight[g] * (to - from) / PARTS / period;
      l->mean += part;
      for (size_t n = 1; n <= l->harmonics; n++)
        add_wave(&l->square[n], 2 * part, (double)n * t / period);
    }
}

static void find_square(ZpLinearCycle *l) {
  const ZpWaveform *w = &l->model->waveform;
  const double period = zp_waveform_period(w);
  l->harmonics = w->kind == ZP_WAVEFORM_SINE ? SINE : ZP_CYCLE_HARMONICS;
  for (double t = 0; t < period;) {
    double next = fmin(zp_waveform_next_corner(w, t), period);
    add_piece(l, t, next);
    t = next;
  }
}

/* -- the motion ------------------------------------------------------------------------------------- */

static double angular(const ZpLinearCycle *l, size_t n) {
  return 2 * zp_pi * (double)n / zp_waveform_period(&l->model->waveform);
}

/* Harmonic n of the forces on the shapes => of x, eq. (24.5): [rates]. For n = 0 the liquid at the edges stays. */
static bool answer(ZpLinearCycle *l, size_t n, ZpComplex *x) {
  const ZpSmallMotion *s = &l->small;
  const double omega = angular(l, n);
  const size_t rates = n > 0 ? s->rates : s->shapes;
  for (size_t r = 0; r < rates; r++)
    for (size_t c = 0; c < rates; c++) {
      size_t at = r * s->rates + c;
      l->matrix[r * rates + c] = (ZpComplex){s->stiffness[at] - omega * omega * s->mass[at], omega * s->damping[at]};
    }
  return zp_complex_solve(rates, l->matrix, x);
}

static ZpComplex *moved(const ZpLinearCycle *l, size_t n) {
  return l->moved + n * l->small.rates;
}

/* Forces follow the squared voltage as dF/dU / 2 U; the charge, as it changes with x, does so like half of the
 * capacitance. */
static double per_square(const ZpLinearCycle *l, double by_voltage) {
  return l->mean > 0 ? by_voltage / (2 * sqrt(l->mean)) : 0;
}

/* => false if a matrix is singular. */
static bool find_motion(ZpLinearCycle *l) {
  for (size_t n = 1; n <= l->harmonics; n++) {
    ZpComplex *x = moved(l, n), u = l->square[n];
    for (size_t j = 0; j < l->small.shapes; j++) {
      double force = per_square(l, l->small.by_voltage[j]);
      x[j] = (ZpComplex){force * u.re, force * u.im};
    }
    if (!answer(l, n, x)) return false;
    for (size_t r = 0; r < l->small.rates; r++) /* half the square times the change of capacitance, eq. (24.6) */
      l->energy +=
          l->model->parts * zp_pi * (double)n * per_square(l, l->small.charge[r]) * (u.im * x[r].re - u.re * x[r].im);
  }
  return true;
}

static double part(ZpComplex a, double turns) {
  return a.re * zp_cosine_of(turns) - a.im * zp_sine_of(turns);
}

/* x, or with `rate` w, at a phase => [rates]. */
static void at_phase(const ZpLinearCycle *l, double turns, bool rate, double *x) {
  memset(x, 0, l->small.rates * sizeof *x);
  for (size_t n = 1; n <= l->harmonics; n++) {
    double angle = (double)n * turns - floor((double)n * turns), omega = angular(l, n);
    const ZpComplex *a = moved(l, n);
    for (size_t r = 0; r < l->small.rates; r++)
      x[r] += rate ? part((ZpComplex){-omega * a[r].im, omega * a[r].re}, angle) : part(a[r], angle);
  }
}

/* How much must be there at the mean, so that the edges never run dry: twice the range in a cycle before the least. */
static double outside_reserve(ZpLinearCycle *l, size_t which, int half) {
  double least = 0, most = 0;
  for (int k = 0; k < PHASES; k++) {
    at_phase(l, (double)k / PHASES, false, l->x);
    double outside = zp_small_motion_out(&l->small, which, half, l->x);
    least = fmin(least, outside);
    most = fmax(most, outside);
  }
  return (most - least) - least;
}

/* -- the motion of second order --------------------------------------------------------------------- */

/* Amplitude of the spread in a harmonic of x, m. */
static double amplitude(const ZpLinearCycle *l, const ZpComplex *x) {
  ZpComplex sum = {0, 0};
  for (size_t j = 0; j < l->small.shapes; j++) {
    sum.re += l->small.by_spread[j] * x[j].re;
    sum.im += l->small.by_spread[j] * x[j].im;
  }
  return sqrt(sum.re * sum.re + sum.im * sum.im);
}

/* The forces of all laws of a member at rest, `share` of the motion at a phase away from the mean => force. */
static void find_force(ZpLinearCycle *l, size_t which, double share, double u) {
  ZpStatics *s = &l->rest.statics;
  ZpRestMember *m = &s->member[which];
  const ZpModel *model = m->model;
  zp_small_motion_nodes(&l->small, which, l->x, share, l->q);
  for (size_t i = 0; i < zp_coordinates(model); i++)
    l->q[i] += m->q[i];
  ZpBead bead[ZP_BEADS] = {{0}};
  ZpSpan span = zp_span_at(l->q);
  span.U0 = span.U1 = zp_member_voltage(model, sqrt(fmax(l->mean + share * u, 0)));
  span.pressure = zp_statics_span(s, which).pressure;
  if (model->has_bead) {
    double reach[ZP_BEADS];
    zp_plates_gaps(&model->plates, l->q, zp_nodes(model, l->q).y, &m->eval.plates);
    for (int half = 0; half < zp_beads(&model->film); half++)
      bead[half].outside = share * zp_small_motion_out(&l->small, which, half, l->x);
    zp_eval_reach(model, m->eval.plates.gap, bead, reach);
    for (int half = 0; half < ZP_BEADS; half++)
      bead[half].reach = reach[half];
    span.bead = bead;
  }
  zp_system_force(model, &span, &m->eval, l->force);
}

/* Form drag of the liquid outside a member at the rates in l->x => force. */
static void find_drag(ZpLinearCycle *l, size_t which) {
  const ZpModel *model = l->model + which;
  zp_small_motion_nodes(&l->small, which, l->x, 1, l->q);
  memset(l->force, 0, zp_coordinates(model) * sizeof *l->force);
  for (size_t j = 0; j < model->count; j++) {
    double v = zp_nodes(model, l->q).y[j], length = zp_film_length(&model->film, j / model->s);
    zp_forces(model, l->force).y[j] = -model->outer.drag * model->film.w * length * fabs(v) * v;
  }
}

/* Forces of second order at a phase, eq. (24.7) => sum [shapes]: the even part of the laws, at a share of the motion at
 * which the squared voltage is positive on both sides. */
static void find_bent(ZpLinearCycle *l, double turns, double *sum) {
  const double U = zp_waveform_voltage(&l->model->waveform, turns * zp_waveform_period(&l->model->waveform)),
               u = U * U - l->mean;
  const double share = fmin(0.5, 0.5 * l->mean / fmax(fabs(u), 1e-300)), per = 1 / (share * share);
  memset(sum, 0, l->small.shapes * sizeof *sum);
  at_phase(l, turns, false, l->x);
  for (size_t k = 0; k < l->model->members; k++) {
    find_force(l, k, share, u);
    zp_small_motion_add(&l->small, k, l->force, 0.5 * per, sum);
    find_force(l, k, -share, u);
    zp_small_motion_add(&l->small, k, l->force, 0.5 * per, sum);
    find_force(l, k, 0, 0);
    zp_small_motion_add(&l->small, k, l->force, -per, sum);
  }
  if (!l->model->has_film || l->model->has_bead) return;
  at_phase(l, turns, true, l->x);
  for (size_t k = 0; k < l->model->members; k++) {
    find_drag(l, k);
    zp_small_motion_add(&l->small, k, l->force, 1, sum);
  }
}

/* Largest relative change of the wet film of a member at a phase. */
static double strain_of(ZpLinearCycle *l, size_t which) {
  const ZpModel *model = l->model + which;
  ZpRestMember *m = &l->rest.statics.member[which];
  const double *y = zp_nodes(model, l->q).y;
  double most = 0;
  zp_small_motion_nodes(&l->small, which, l->x, 1, l->q);
  zp_plates_gaps(&model->plates, m->q, zp_nodes(model, m->q).y, &m->eval.plates);
  for (size_t i = 0; i < model->nodes; i++)
    most =
        fmax(most, fabs(zp_parting(&model->topology, y, i)) / zp_film_thickness(&model->film, m->eval.plates.gap[i]));
  return most;
}

static double largest_strain(ZpLinearCycle *l) {
  double most = 0;
  for (int phase = 0; phase < PHASES; phase++) {
    at_phase(l, (double)phase / PHASES, false, l->x);
    for (size_t k = 0; k < l->model->members; k++)
      most = fmax(most, strain_of(l, k));
  }
  return most;
}

/* The film's resistance goes with the cube of its thickness: harmonic n of that change of its force => x. */
static void change_film(ZpLinearCycle *l, size_t n, double strain, ZpComplex *x) {
  const ZpSmallMotion *s = &l->small;
  const ZpComplex *a = moved(l, n);
  const double per = 3 * strain * angular(l, n);
  for (size_t r = 0; r < s->rates; r++) {
    x[r] = (ZpComplex){0, 0};
    for (size_t c = 0; c < s->rates; c++) {
      x[r].re -= per * s->damping[r * s->rates + c] * a[c].im;
      x[r].im += per * s->damping[r * s->rates + c] * a[c].re;
    }
  }
}

/* Harmonic n of the forces of second order => x. */
static void harmonic_of(const ZpLinearCycle *l, size_t n, const double *sample, ZpComplex *x) {
  memset(x, 0, l->small.rates * sizeof *x);
  for (int k = 0; k < PHASES; k++)
    for (size_t j = 0; j < l->small.shapes; j++)
      add_wave(&x[j], (n > 0 ? 2.0 : 1.0) / PHASES * sample[(size_t)k * l->small.shapes + j], (double)n * k / PHASES);
}

static double answered(ZpLinearCycle *l, size_t n, ZpComplex *x) {
  return answer(l, n, x) ? amplitude(l, x) : INFINITY;
}

/* Amplitudes of the motion of second order, m: its mean, and the sum of its harmonics. */
typedef struct Bent {
  double mean, swings;
} Bent;

static Bent find_second(ZpLinearCycle *l, ZpComplex *x, double *sample) {
  Bent bent = {0, 0};
  for (int k = 0; k < PHASES; k++)
    find_bent(l, (double)k / PHASES, sample + (size_t)k * l->small.shapes);
  for (size_t n = 0; n <= BENT; n++) {
    harmonic_of(l, n, sample, x);
    *(n > 0 ? &bent.swings : &bent.mean) += answered(l, n, x);
  }
  if (!l->model->has_film) return bent;
  const double strain = largest_strain(l);
  for (size_t n = 1; n <= l->harmonics && n <= BENT; n++) {
    change_film(l, n, strain, x);
    bent.swings += answered(l, n, x);
  }
  return bent;
}

/* How much larger harmonic n is than at rest under the same forces. */
static double gain(ZpLinearCycle *l, size_t n, ZpComplex *x) {
  for (size_t j = 0; j < l->small.shapes; j++) {
    double force = per_square(l, l->small.by_voltage[j]);
    x[j] = (ZpComplex){force * l->square[n].re, force * l->square[n].im};
  }
  double still = answered(l, 0, x);
  return still > 0 ? amplitude(l, moved(l, n)) / still : 0;
}

/* Near a resonance also what is of third order counts: it tunes the actuator. Eq. (24.8). */
static double find_curvature(ZpLinearCycle *l, ZpComplex *x, double *sample) {
  size_t largest = 1;
  for (size_t n = 2; n <= l->harmonics; n++)
    if (amplitude(l, moved(l, n)) > amplitude(l, moved(l, largest))) largest = n;
  double first = amplitude(l, moved(l, largest));
  if (!(first > 0)) return 0;
  Bent bent = find_second(l, x, sample);
  double whole = (bent.mean + bent.swings) / first;
  return bent.swings / first + whole * whole * gain(l, largest, x);
}

/* -- all together ----------------------------------------------------------------------------------- */

static bool stop(const void *hooks) {
  return zp_hooks_stop(hooks, "finding the mean", 0);
}

typedef struct Room {
  ZpComplex *x;
  double *sample;
} Room;

static size_t reserve(ZpLinearCycle *l, void *block, Room *room) {
  ZpArena arena = {block, 0};
  const size_t rates = l->small.rates;
  l->moved = zp_arena_take_of(&arena, (l->harmonics + 1) * rates, sizeof *l->moved);
  l->matrix = zp_arena_take_of(&arena, rates * rates, sizeof *l->matrix);
  room->x = zp_arena_take_of(&arena, rates, sizeof *room->x);
  room->sample = zp_arena_take(&arena, PHASES * l->small.shapes);
  l->x = zp_arena_take(&arena, rates);
  l->q = zp_arena_take(&arena, zp_coordinates(l->model));
  l->force = zp_arena_take(&arena, zp_coordinates(l->model));
  return arena.used;
}

bool zp_linear_cycle_open(const ZpModel *model, const ZpHooks *hooks, ZpLinearCycle *l, bool *failed) {
  *l = (ZpLinearCycle){.model = model, .curvature = INFINITY};
  find_square(l);
  *failed = !zp_rest_open(&l->rest, model, NULL, NULL);
  if (*failed) return false;
  l->rest.statics.stop = stop;
  l->rest.statics.caller = hooks;
  if (!zp_rest_hang(&l->rest, sqrt(l->mean))) return false;
  if (!zp_statics_stable(&l->rest.statics)) return false;
  Room room;
  *failed = !zp_small_motion_create(&l->rest, &l->small) || !(l->memory = zp_calloc(1, reserve(l, NULL, &room)));
  if (*failed) return false;
  reserve(l, l->memory, &room);
  if (!find_motion(l)) return false;
  l->curvature = find_curvature(l, room.x, room.sample);
  return true;
}

void zp_linear_cycle_close(ZpLinearCycle *l) {
  zp_free(l->memory);
  zp_small_motion_destroy(&l->small);
  zp_rest_close(&l->rest);
}

/* Of one member, in series relative to the platform that it hangs on at rest. */
static void put_member(ZpLinearCycle *l, size_t which, double turns, ZpSim *sim) {
  const ZpModel *model = sim->model;
  ZpRestMember *m = &l->rest.statics.member[which];
  const ZpSpan mean = zp_span_at(m->q);
  double *q = zp_state_q(model, sim->state);
  for (int half = 0; model->has_bead && half < zp_beads(&model->film); half++) {
    double mean = outside_reserve(l, which, half);
    at_phase(l, turns, false, l->x);
    sim->state->bead[half].outside = mean + zp_small_motion_out(&l->small, which, half, l->x);
    sim->state->bead[half].supply = 1;
  }
  at_phase(l, turns, true, l->x);
  zp_small_motion_nodes(&l->small, which, l->x, 1, zp_state_v(model, sim->state));
  at_phase(l, turns, false, l->x);
  zp_small_motion_nodes(&l->small, which, l->x, 1, q);
  if (zp_pouch_rank(model) > 0)
    *zp_law_state(model, &zp_term_pouch, sim->state) = zp_pouch_predicted(model, &mean, &m->eval, q, 1);
  for (size_t i = 0; i < zp_coordinates(model); i++)
    q[i] += m->q[i];
  zp_pouch_refill(model, q);
}

void zp_linear_cycle_put(ZpLinearCycle *l, double turns, ZpSim *sim) {
  for (size_t k = 0; k < sim->members; k++)
    put_member(l, k, turns, sim + k);
  zp_sim_hang(sim);
  for (size_t k = 0; k < sim->members; k++)
    zp_sim_lay_beads(sim + k);
}
