#include "rest/statics.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "actuator/place.h"
#include "actuator/resolution.h"
#include "base/kernel.h"
#include "def/device.h"
#include "def/tolerance.h"
#include "math/elementary.h"
#include "math/vector.h"
#include "rest/crossing.h"
#include "ribbon/rod_maxwell.h"
#include "solve/descend.h"
#include "term/curvature.h"

static void reserve_member(ZpRestMember *m, const ZpModel *model, ZpArena *arena) {
  double **of_coordinates[] = {&m->q, &m->moved, &m->force, &m->good};
  double **of_edges[] = {&m->tension, &m->rotation, &m->stretch};
  for (size_t k = 0; k < sizeof of_coordinates / sizeof of_coordinates[0]; k++)
    *of_coordinates[k] = zp_arena_take(arena, zp_coordinates(model));
  for (size_t k = 0; k < sizeof of_edges / sizeof of_edges[0]; k++)
    *of_edges[k] = zp_arena_take(arena, zp_predicted(model));
}

static size_t reserve_solution(ZpStatics *s, void *block) {
  ZpArena arena = {block, 0};
  zp_newton_reserve(&s->newton, &s->form, &arena);
  s->row = zp_arena_take(&arena, s->n);
  s->at = zp_arena_take(&arena, s->n);
  s->spare = zp_arena_take_of(&arena, 3 * zp_lanes(s->model), sizeof *s->spare);
  return arena.used;
}

static size_t reserve(const ZpModel *model, ZpStatics *s, void *block) {
  ZpArena arena = {block, 0};
  s->member = zp_arena_take_of(&arena, s->members, sizeof *s->member);
  s->way = zp_arena_take(&arena, model->network->bodies);
  s->below = zp_arena_take(&arena, model->network->bodies);
  s->pose = zp_arena_take_of(&arena, model->network->bodies, sizeof *s->pose);
  s->good = zp_arena_take_of(&arena, model->network->bodies, sizeof *s->good);
  s->place = zp_arena_take_of(&arena, model->network->bodies, sizeof *s->place);
  for (size_t k = 0; k < s->members; k++) {
    ZpRestMember unused = {0}, *m = block ? &s->member[k] : &unused;
    reserve_member(m, model, &arena);
  }
  return arena.used;
}

static size_t edge_count(const ZpRestMember *m) {
  return m->model->count - m->model->s;
}

void zp_statics_lay_straight(ZpStatics *s) {
  for (ZpRestMember *m = s->member; m < s->member + s->members; m++) {
    if (m->idle) continue;
    zp_place_straight(m->model, m->q);
    memset(m->tension, 0, zp_predicted(m->model) * sizeof *m->tension);
  }
}

static bool in_plane(const ZpStatics *s) {
  return s->plane.bodies > 0;
}

/* Do rows of ties join the members? If not, each is at rest in the frame of the platform that it hangs on. */
static bool is_joined(const ZpStatics *s) {
  return s->shared || s->linked;
}

static bool are_apart(const ZpStatics *s) {
  return s->members > 1 && !is_joined(s);
}

static bool create_member(const ZpStatics *s, size_t which) {
  const ZpModel *model = s->model + which;
  const ZpTies ties = is_joined(s) ? zp_ties_of(s->model, s->members, which) : zp_ties_of(model, 1, 0);
  ZpRestMember *m = &s->member[which];
  m->model = model;
  m->modulus = zp_pouch_modulus;
  return zp_system_create(model, true, &m->eval) && zp_assembly_create(&ties, 0, model->is_rod, &m->assembly);
}

/* The equations of all members. False if there is no memory. */
static bool number(ZpStatics *s) {
  ZpAssembly **of = zp_calloc(s->members, sizeof(ZpAssembly *));
  if (!of) return false;
  s->held = zp_tie_of_held(s->model, is_joined(s) ? s->members : 1);
  for (size_t k = 0; k < s->members; k++) {
    of[k] = &s->member[k].assembly;
    of[k]->block.band.rank = zp_bead_rank(s->member[k].model) + zp_pouch_rank(s->member[k].model);
  }
  bool joined = zp_assembly_join(of, is_joined(s) ? s->model : NULL, s->members, 0, &s->form);
  s->n = s->form.n;
  joined = joined && zp_assembly_parts(of, s->members, s->n, &s->parts);
  if (in_plane(s))
    joined = joined && zp_links_create(&s->plane, s->form.inner, &s->links);
  else
    joined = joined && (!is_joined(s) || zp_springs_create(s->model, of, &s->springs));
  zp_free(of);
  return joined;
}

bool zp_statics_create(const ZpModel *model, bool held, ZpStatics *s) {
  *s = (ZpStatics){.model = model,
                   .members = model->members,
                   .shared = zp_shares_load(model),
                   .linked = held && model->members > 1 && !zp_shares_load(model),
                   .opposed = model->network->opposed,
                   .force = zp_lowest(model)->def.load.force,
                   .has_load = !zp_is_network(model)};
  s->memory = zp_calloc(1, reserve(model, s, NULL));
  bool made = s->memory != NULL;
  if (made) reserve(model, s, s->memory);
  for (size_t k = 0; k < s->members && made; k++) {
    made = create_member(s, k);
    s->scale = fmax(s->scale, zp_eval_weight_scale(model + k));
    s->biased |= model[k].bias != 0;
    if (model->network->ends[k].lower == model->network->load) s->own_load += model[k].def.load.mass;
  }
  made = made && zp_plane_create(model, &s->plane);
  made = made && (in_plane(s) || zp_heights_create(model->network, &s->heights));
  if (made && in_plane(s)) zp_plane_drawn(&s->plane, s->pose);
  for (size_t b = 0; made && b < s->plane.bodies; b++)
    if (!model->network->body[b].held) s->scale = fmax(s->scale, s->plane.body[b].mass * model->def.gravity);
  if (made && number(s)) s->solution = zp_calloc(1, reserve_solution(s, NULL));
  if (!s->solution) {
    zp_statics_destroy(s);
    return false;
  }
  reserve_solution(s, s->solution);
  s->load = s->own_load;
  s->bias = s->share = s->suction = s->nearer = s->taken = 1;
  s->opening = NAN;
  zp_statics_lay_straight(s);
  return true;
}

void zp_statics_destroy(ZpStatics *s) {
  for (size_t k = 0; k < s->members && s->memory; k++) {
    zp_system_destroy(&s->member[k].eval);
    zp_assembly_destroy(&s->member[k].assembly);
  }
  zp_arrow_form_destroy(&s->form);
  zp_heights_destroy(&s->heights);
  zp_springs_destroy(&s->springs);
  zp_links_destroy(&s->links);
  zp_plane_destroy(&s->plane);
  zp_free(s->parts.common);
  zp_free(s->memory);
  zp_free(s->solution);
  s->memory = s->solution = NULL;
  s->parts.common = NULL;
}

double zp_statics_tolerance(const ZpStatics *s) {
  double largest = zp_tolerance_at_rest(&s->member->model->def);
  for (size_t k = 0; k < s->members; k++) {
    const ZpModel *model = s->member[k].model;
    largest = fmax(largest, 4 * DBL_EPSILON * model->L * model->axial_stiffness / s->scale);
  }
  return largest;
}

enum { MOST_ITERATIONS = 50, STEP_ITERATIONS = 30, USUAL_ITERATIONS = 16 };

/* The present point => good, and back. */
static void keep(ZpStatics *s) {
  if (in_plane(s)) memcpy(s->good, s->pose, s->plane.bodies * sizeof *s->pose);
  for (ZpRestMember *m = s->member; m < s->member + s->members; m++) {
    if (m->idle) continue;
    memcpy(m->good, m->q, zp_coordinates(m->model) * sizeof *m->q);
    m->good_pressure = m->tension[zp_pressure_place(m->model)];
  }
}

static void go_to_kept(ZpStatics *s) {
  if (in_plane(s)) memcpy(s->pose, s->good, s->plane.bodies * sizeof *s->pose);
  for (ZpRestMember *m = s->member; m < s->member + s->members; m++) {
    if (m->idle) continue;
    memcpy(m->q, m->good, zp_coordinates(m->model) * sizeof *m->q);
    m->tension[zp_pressure_place(m->model)] = m->good_pressure;
  }
}

void zp_statics_take_tensions(ZpStatics *s) {
  for (ZpRestMember *m = s->member; m < s->member + s->members; m++) {
    memcpy(m->tension, m->eval.edges.T, edge_count(m) * sizeof *m->tension);
    m->tension[zp_pressure_place(m->model)] = m->eval.pressure;
    if (zp_is_in_space(m->model)) zp_space_take_sway(m->model, &m->eval, &m->tension[zp_lanes(m->model)]);
  }
  zp_links_take(&s->links);
}

static void set_idle(ZpStatics *s, bool idle) {
  for (ZpRestMember *m = s->member; m < s->member + s->members; m++)
    m->idle = idle;
}

/* Has Newton's method found an equilibrium without folded ribbons? Its last stiffness tells, or that of the equilibrium
 * itself. */
static bool is_found(ZpStatics *s, ZpNewtonInfo info) {
  if (!zp_newton_good(info.end)) return false;
  return info.iterations == 0 || zp_arrow_negative(&s->newton.K) == 0 || zp_statics_stable(s);
}

/* Start from the straight shape and let what acts by these shares grow, first by `step`, if the equilibrium is too far
 * away for one step. A load 1e5 times the one that bends a ribbon by its length needs so small a first share. */
static ZpNewtonInfo step_by_step(ZpStatics *s, double *one, double *other, double step) {
  enum { MOST_STEPS = 1000 }; /* the way of what can be nothing but closed would not end */
  static const double shortest = 1e-8;
  double reached = 0;
  ZpNewtonInfo info = {ZP_NEWTON_SLOW, 0, INFINITY};
  int iterations = 0;
  zp_statics_lay_straight(s);
  keep(s);
  for (int k = 0; k < MOST_STEPS && reached < 1 && step > shortest; k++) {
    double share = fmin(reached + step, 1);
    *one = *other = share;
    info = zp_statics_solve(s, STEP_ITERATIONS);
    iterations += info.iterations;
    if (is_found(s, info)) {
      reached = share;
      step *= 2;
      keep(s);
    } else {
      go_to_kept(s);
      for (const ZpRestMember *m = s->member; m < s->member + s->members; m++)
        memset(m->tension, 0, zp_predicted(m->model) * sizeof *m->tension);
      step *= 0.25;
    }
  }
  *one = *other = 1;
  info.iterations = iterations;
  if (reached < 1) info.end = ZP_NEWTON_SLOW;
  return info;
}

static double opening_of(const ZpRestMember *m) {
  return zp_opening(&m->model->topology, zp_nodes(m->model, m->q).y);
}

static double reach_of(const ZpRestMember *m) {
  return zp_reach(&m->model->topology, zp_nodes(m->model, m->q));
}

/* Has any gap, insulators included, changed since the last good state by so large a share that this is another
 * branch? */
static bool member_has_jumped(const ZpRestMember *m) {
  static const double jump = 0.25;
  const ZpModel *model = m->model;
  const double *y = zp_nodes(model, m->good).y;
  for (size_t i = 0; i < model->nodes; i++) {
    double before = zp_plates_gap(&model->plates, y, i);
    if (!(fabs(m->eval.plates.gap[i] - before) < jump * (fabs(before) + model->plates.d))) return true;
  }
  return false;
}

/* Has a member, or the load? */
static bool has_jumped(const ZpStatics *s) {
  static const double part = 0.02; /* of the length, or of what both openings of antagonists sum up to */
  bool jumped = false;
  for (size_t k = 0; k < s->members; k++) {
    const ZpRestMember *m = &s->member[k];
    if (m->idle) continue;
    double before = zp_opening(&m->model->topology, zp_nodes(m->model, m->good).y);
    jumped |= fabs(opening_of(m) - before) >
              part * (s->opposed && s->has_load ? zp_network_depth(s->model->network) : m->model->L);
    jumped |= m->model->field && member_has_jumped(m);
  }
  return jumped;
}

/* Back to the last good state. */
static void go_back(ZpStatics *s) {
  go_to_kept(s);
  zp_statics_system(s).residual(s, s->newton.r, NULL);
  zp_statics_take_tensions(s);
}

/* Follow the branch from a stable equilibrium while an input grows from its present value to `whole`, or its square
 * does, in shares of at most `longest`: forces are proportional to the square of a voltage. False if the branch ends
 * before; the present point is then its last equilibrium. */
static bool grow(ZpStatics *s, double *input, double whole, bool square, double longest) {
  static const double shortest = 1e-6;
  double from = whole != 0 ? *input / whole : 0, reached = square ? from * from : from, step = longest;
  keep(s);
  while (reached < 1 && step > shortest) {
    double share = fmin(reached + step, 1);
    *input = whole * (square ? sqrt(share) : share);
    ZpNewtonEnd end = zp_statics_solve(s, MOST_ITERATIONS).end;
    if (zp_newton_good(end) && zp_statics_stable(s) && !has_jumped(s)) {
      reached = share;
      step = fmin(2 * step, longest);
      keep(s);
    } else {
      *input = whole * (square ? sqrt(reached) : reached);
      go_back(s);
      step *= 0.5;
    }
  }
  return reached == 1;
}

/* Continue from the equilibrium without suction at the menisci to the one with it. Where that branch ends, suction
 * draws the faces together. */
static ZpNewtonInfo let_menisci_draw(ZpStatics *s, ZpNewtonInfo info) {
  bool draw = s->member->model->bead.suction > 0 && zp_newton_good(info.end),
       grown = draw && grow(s, &s->suction, 1, false, 1);
  s->suction = 1;
  return draw && !grown ? zp_statics_relax(s, 0) : info;
}

/* Continue from the equilibrium without contact to the one with contact, if there are faces. If the faces have passed
 * through each other on the way, weight presses them together: they then lie on each other from the straight shape on,
 * unless the platform is held open. */
static ZpNewtonInfo let_faces_push(ZpStatics *s, ZpNewtonInfo info) {
  s->contact_acts = true;
  if (!zp_newton_good(info.end) || !s->member->model->field) return info;
  keep(s);
  ZpNewtonInfo contact = zp_statics_solve(s, MOST_ITERATIONS);
  if (!is_found(s, contact) || zp_statics_fault(s)) {
    go_to_kept(s);
    if (zp_statics_holds(s))
      contact = zp_statics_relax(s, 0);
    else
      contact = zp_statics_close(s, 0);
  }
  contact.iterations += info.iterations;
  return contact;
}

/* Antagonists, from where both are held half way. */
static ZpNewtonInfo hang_between(ZpStatics *s) {
  double load = s->load;
  s->bias = 0;
  ZpNewtonInfo info = zp_statics_hold(s, 0.5 * zp_network_depth(s->model->network));
  s->opening = NAN;
  s->load = load;
  if (!zp_newton_good(info.end)) return info;
  info = zp_statics_solve(s, MOST_ITERATIONS);
  if (!is_found(s, info)) info = zp_statics_relax(s, 0);
  return info;
}

/* How far a body has moved and turned from its place in the drawing, m, rad. */
static ZpPose moved_from_drawing(ZpStatics *s, size_t body) {
  const ZpPose *drawn = &s->plane.body[body].drawn, to = zp_plane_place(&s->plane, body, s->pose);
  return (ZpPose){.x = to.x - drawn->x, .y = to.y - drawn->y, .turn = to.turn};
}

/* Nothing stops a body that is far away, or has turned more often than anything could bear. */
static bool is_away(const ZpStatics *s, const ZpPose *moved) {
  static const double far = 10, often = 100; /* lengths of a ribbon; rad */
  return fmax(fabs(moved->x), fabs(moved->y)) > far * s->plane.length || fabs(moved->turn) > often;
}

/* The first body that is away; 0: none is. */
static size_t runaway(ZpStatics *s, ZpPose *moved) {
  for (size_t b = 1; b < s->plane.bodies; b++) {
    *moved = moved_from_drawing(s, b);
    if (is_away(s, moved)) return b;
  }
  return 0;
}

static bool runs_away(void *statics) {
  ZpPose moved;
  return runaway(statics, &moved) > 0;
}

static ZpNewtonInfo relax_in_plane(ZpStatics *s) {
  s->U = 0;
  ZpNewtonInfo info = zp_statics_relax_until(s, runs_away, s);
  if (runs_away(s)) info.end = ZP_NEWTON_SLOW;
  return info;
}

/* Bodies in the plane: members first reach from body to body as in the drawing, then all find their rest. */
static ZpNewtonInfo hang_in_plane(ZpStatics *s) {
  s->posed = true;
  zp_plane_drawn(&s->plane, s->pose);
  ZpNewtonInfo info = step_by_step(s, &s->nearer, &s->nearer, 0.05);
  if (!zp_newton_good(info.end)) info = relax_in_plane(s);
  s->posed = false;
  if (!zp_newton_good(info.end)) return info;
  keep(s);
  info = zp_statics_solve(s, MOST_ITERATIONS);
  if (!is_found(s, info)) {
    go_back(s);
    info = relax_in_plane(s);
  }
  info = let_faces_push(s, info);
  if (zp_newton_good(info.end) && zp_statics_fault(s)) info.end = ZP_NEWTON_REFUSED;
  return info;
}

bool zp_statics_bias(ZpStatics *s) {
  bool biased = !s->biased || grow(s, &s->bias, 1, true, 0.05);
  if (biased) s->bias = 1;
  return biased;
}

bool zp_statics_bias_held(ZpStatics *s, bool *jumped) {
  enum { MOST_JUMPS = 100 };
  static const double above = 1e-3; /* of the share where the branch ends */
  for (int k = 0; k < MOST_JUMPS; k++) {
    if (zp_statics_bias(s)) return true;
    *jumped = true;
    s->bias = fmin((1 + above) * s->bias, 1);
    if (!zp_newton_good(zp_statics_relax(s, s->U).end)) return false;
  }
  return false;
}

const char *zp_statics_fallen(ZpStatics *s, char text[ZP_NO_REST_SIZE]) {
  static const double mm = 1e3, turn = 6.283185307179586;
  ZpPose moved;
  const size_t body = in_plane(s) ? runaway(s, &moved) : 0;
  if (body == 0) return NULL;
  const double down = -moved.y, aside = fabs(moved.x);
  const char *called = zp_body_called(s->model->whole, body, (char[ZP_NAME_SIZE]){0});
  if (fabs(moved.turn) > turn && fmax(down, aside) < s->plane.length)
    snprintf(text, ZP_NO_REST_SIZE,
             "no hanging equilibrium found: bodies.%s turns, %.0f times so far; nothing stops it: reduce its torque or "
             "forces, or add a spring",
             called, fabs(moved.turn) / turn);
  else
    snprintf(text, ZP_NO_REST_SIZE,
             "no hanging equilibrium found: bodies.%s moves away, %.0f mm %s so far; nothing holds it there: add a "
             "spring of kind both, or one of kind push or pull as a stop",
             called, mm * fmax(fabs(down), aside),
             aside > fabs(down) ? "sideways"
             : down > 0         ? "down"
                                : "up");
  return text;
}

const char *zp_statics_no_rest(ZpStatics *s, char text[ZP_NO_REST_SIZE]) {
  const char *fallen = zp_statics_fallen(s, text);
  if (fallen) return fallen;
  return s->bias < 1
             ? "a member pulls in below its own constant voltage (stack.lower_voltage; drive.voltage, not scaled)"
             : "no hanging equilibrium found";
}

/* The largest rotation of an edge of a member in the last step that was examined, rad, or `most` if that is more; NAN
 * if any is NAN. */
static double turned_by(const ZpRestMember *m, double most) {
  for (size_t j = 0; j < edge_count(m) && !isnan(most); j++)
    if (!(fabs(m->rotation[j]) <= most)) most = fabs(m->rotation[j]);
  return most;
}

/* Members apart that the last iterations have brought to rest wait while the others come to it step by step. */
static ZpNewtonInfo step_those_left(ZpStatics *s) {
  static const double near = 1e-3; /* rad */
  for (size_t k = 0; k < s->members && are_apart(s); k++)
    s->member[k].idle = turned_by(&s->member[k], 0) < near && zp_band_negative(&s->newton.K.part[k].LU) == 0;
  ZpNewtonInfo info = step_by_step(s, &s->nearer, &s->share, 0.01);
  set_idle(s, false);
  return zp_newton_good(info.end) ? zp_statics_solve(s, MOST_ITERATIONS) : info;
}

ZpNewtonInfo zp_statics_find_rest(ZpStatics *s) {
  if (s->opposed && s->has_load) return hang_between(s);
  s->U = s->suction = 0;
  if (s->biased) s->bias = 0;
  s->contact_acts = false;
  if (in_plane(s)) return hang_in_plane(s);
  /* members apart all iterate until the last one is at rest */
  ZpNewtonInfo info = zp_statics_solve(s, are_apart(s) ? USUAL_ITERATIONS : MOST_ITERATIONS);
  if (!is_found(s, info)) info = step_those_left(s);
  if (s->member->model->is_rod && !is_found(s, info)) info = zp_statics_relax(s, 0); /* limp springs relax */
  info = let_faces_push(s, info);
  info = let_menisci_draw(s, info);
  if (zp_newton_good(info.end) && zp_statics_fault(s)) info.end = ZP_NEWTON_REFUSED;
  return info;
}

/* The input at which the row of the held platform would have it where it is, m. */
static double held_at(const ZpStatics *s) {
  const ZpRestMember *m = s->member + s->held.member;
  return (*zp_coordinate(m->model, m->q, s->held.coordinate) - zp_tie_place(&s->held, 0, 0)) / s->held.by_input;
}

/* A slack pouch has no shape to start from. Until a voltage pulls, it is held where it hangs under a small load, which
 * bends its films over a twentieth of their length. */
static ZpNewtonInfo hold_along(ZpStatics *s) {
  static const double part = 20;
  const ZpModel *model = s->model;
  const double opening = s->opening;
  s->opening = NAN;
  s->tight = part * part * zp_ribbon_section(model, 0).EI / (model->L * model->L);
  ZpNewtonInfo info = zp_statics_find_rest(s);
  s->from = held_at(s);
  s->opening = opening;
  s->tight = s->taken = 0;
  return zp_newton_good(info.end) ? zp_statics_solve(s, MOST_ITERATIONS) : info;
}

bool zp_statics_take_up(ZpStatics *s, void (*passed)(void *user), void *user) {
  enum { STEPS = 40 };
  bool held = true;
  for (int k = (int)(s->taken * STEPS); k < STEPS && held; k++) {
    held = grow(s, &s->taken, (k + 1.0) / STEPS, false, 1);
    if (held) passed(user);
  }
  return held;
}

ZpNewtonInfo zp_statics_hold(ZpStatics *s, double opening) {
  s->opening = opening;
  s->contact_acts = false;
  s->U = s->load = s->suction = 0;
  zp_statics_lay_straight(s);
  if (s->model->topology.along) return hold_along(s);
  ZpNewtonInfo info = zp_statics_solve(s, MOST_ITERATIONS);
  if (!is_found(s, info)) info = step_by_step(s, &s->nearer, &s->nearer, 0.05);
  /* ribbons that sag by more than the opening have no straight shape to start from */
  if (!is_found(s, info)) info = step_by_step(s, &s->nearer, &s->share, 0.01);
  info = let_faces_push(s, info);
  return let_menisci_draw(s, info);
}

bool zp_statics_ramp_voltage(ZpStatics *s, double voltage) {
  return grow(s, &s->U, voltage, true, 0.05) && !zp_statics_fault(s);
}

ZpNewtonInfo zp_statics_close(ZpStatics *s, double voltage) {
  zp_statics_lay_straight(s);
  s->U = voltage;
  s->contact_acts = true;
  ZpNewtonInfo info = zp_statics_solve(s, MOST_ITERATIONS);
  if (zp_newton_good(info.end) && zp_statics_stable(s)) return info;
  zp_statics_lay_straight(s);
  return zp_statics_relax(s, voltage);
}

double zp_statics_member_stroke(const ZpStatics *s, size_t which) {
  const ZpRestMember *m = &s->member[which];
  return zp_stroke(m->model, zp_nodes(m->model, m->q));
}

double zp_statics_member_opening(const ZpStatics *s, size_t which) {
  return opening_of(&s->member[which]);
}

/* Along the path from the frame to the load; NAN if there is no load of all. */
static double of_all(const ZpStatics *s, double (*number)(const ZpStatics *s, size_t which)) {
  double sum = s->has_load ? 0 : (double)NAN;
  for (size_t k = 0; k < s->members; k++)
    if (s->model->network->ends[k].on_path) sum += number(s, k);
  return sum;
}

double zp_statics_stroke(const ZpStatics *s) {
  return of_all(s, zp_statics_member_stroke);
}

double zp_statics_opening(const ZpStatics *s) {
  return of_all(s, zp_statics_member_opening);
}

double zp_statics_lateral(const ZpStatics *s) {
  const ZpRestMember *m = s->member;
  return zp_read_axis(m->model, m->q, ZP_AXIS_Z)[zp_load_node(&m->model->topology)];
}

double zp_statics_skew(const ZpStatics *s) {
  const ZpRestMember *m = s->member;
  const ZpTopology *t = &m->model->topology;
  const ZpSpaceRod *rod = &m->eval.space[m->model->s - 1];
  const bool held = zp_topology_holds_slope(t, m->model->nodes - 1, m->model->s - 1);
  const ZpSpaceEdge *last = &rod->edge[m->model->nodes - 1];
  double width[3] = {0, 0, 1};
  for (int c = 0; c < 3 && !held; c++)
    width[c] = 1.5 * last->width[c] - 0.5 * (last - 1)->width[c]; /* from the middles of both edges */
  return zp_angle(0 - width[1], width[2]);
}

double zp_statics_angle(const ZpStatics *s) {
  return zp_topology_angle(&s->member->model->topology, s->member->q, zp_nodes(s->member->model, s->member->q).y);
}

static size_t front_of(const ZpRestMember *m) {
  return m->model->field ? zp_contact_front(&m->model->faces, m->eval.plates.gap) : 0;
}

size_t zp_statics_front(const ZpStatics *s) {
  size_t least = front_of(s->member);
  for (size_t k = 1; k < s->members; k++)
    if (!s->model->network->ends[k].turned && front_of(&s->member[k]) < least) least = front_of(&s->member[k]);
  return least;
}

double zp_statics_member_closed(const ZpStatics *s, size_t which) {
  return (double)front_of(&s->member[which]) * s->member[which].model->l;
}

/* The length that is closed in all members that lie side by side with one, m. */
static double closed_abreast(const ZpStatics *s, size_t which) {
  const ZpNetwork *network = s->model->network;
  double least = zp_statics_member_closed(s, which);
  for (size_t k = 0; k < s->members && network->ends[which].abreast > 1; k++)
    if (zp_network_abreast(network, which, k)) least = fmin(least, zp_statics_member_closed(s, k));
  return least;
}

double zp_statics_closed_length(const ZpStatics *s) {
  return of_all(s, closed_abreast);
}

double zp_statics_member_voltage(const ZpStatics *s, size_t which) {
  const ZpModel *model = s->member[which].model;
  if (s->ports) return zp_voltage_at_port(model, s->ports[model->network->ends[which].port]);
  return model->ratio * s->U + s->bias * model->bias;
}

bool zp_statics_shorted(const ZpStatics *s) {
  for (size_t k = 0; k < s->members; k++) {
    const ZpModel *model = s->member[k].model;
    if (zp_statics_member_voltage(s, k) == 0 || !model->field || zp_insulation(&model->def) > 0) continue;
    if (zp_plates_least_gap(&model->plates, zp_nodes(model, s->member[k].q).y) < model->faces.depth) return true;
  }
  return false;
}

const char *zp_statics_trouble(const ZpStatics *s) {
  const char *fault = NULL;
  for (size_t k = 0; k < s->members && !fault; k++)
    fault = s->member[k].eval.fault;
  return fault;
}

static ZpElectric totals(const ZpRestMember *m, double U) {
  ZpSpan here = zp_span_at(m->q);
  here.beyond = zp_eval_beyond(&m->eval);
  return zp_system_electric(m->model, &here, &m->eval, ZP_SPAN_END, U);
}

double zp_statics_charge(const ZpStatics *s) {
  double sum = 0;
  for (size_t k = 0; k < s->members; k++)
    sum += s->member[k].model->parts * totals(&s->member[k], zp_statics_member_voltage(s, k)).charge;
  return sum;
}

double zp_statics_member_capacitance(const ZpStatics *s, size_t which) {
  const ZpRestMember *m = &s->member[which];
  return m->model->parts * totals(m, zp_statics_member_voltage(s, which)).capacitance;
}

double zp_statics_capacitance(const ZpStatics *s) {
  double sum = 0;
  for (size_t k = 0; k < s->members; k++)
    sum += zp_statics_member_capacitance(s, k);
  return sum;
}

/* Capacitance of closed faces, whole actuator, F: at most, of a plate between two electrodes. */
static double closed_capacitance(const ZpModel *model) {
  const ZpActuatorDef *def = &model->def;
  const bool backs = zp_def_has(def, ZP_DEVICE_RIGID) && !isnan(def->plate.back_gap);
  double inverse = zp_plates_inverse_gap(&model->plates, model->faces.stop);
  if (backs) inverse += zp_plates_inverse_gap(&model->plates, def->plate.back_stop_gap);
  return zp_part_capacitance(model, inverse) * zp_contact_length(model);
}

/* Force per length of faces, N/m, with which a load that falls upwards presses those of the platform together, or the
 * edge of a free end onto the other face. */
static double pressed_by_load(const ZpModel *model) {
  const ZpContactParams *faces = &model->faces;
  double beside = zp_ends_free(&model->topology) ? 0 : 0.5 * faces->l;
  return zp_load_pull(model) < 0 ? model->total_weight / (faces->flat_length + beside) : 0;
}

/* The largest overlap that a state may have, m. By (9.1) the attraction at the breakdown of the insulators causes the
 * contact depth, and a stronger attraction or a load causes more. At a front the bent ribbons press on closed faces
 * like a lever. */
static double deepest_overlap(const ZpModel *model, double U) {
  static const double ranges = 2, of_insulators = 0.02, lever = 3;
  const ZpContactParams *faces = &model->faces;
  double attraction = zp_plates_law(&model->plates, U, model->faces.stop).W;
  double pull = (attraction + pressed_by_load(model)) / faces->push;
  double balanced = faces->depth * zp_cube_root(fmax(pull, 1));
  return fmax(fmax(ranges * faces->range, of_insulators * zp_insulation(&model->def)), lever * balanced);
}

/* Ribbons that slide along each other by a little are not parted by it, because the gap is that of heights. */
static double deepest_crossing(const ZpModel *model, double U) {
  static const double of_insulators = 0.5;
  return fmax(deepest_overlap(model, U), of_insulators * zp_insulation(&model->def));
}

/* Films that pull are at most half circles, eq. (40.3): is a pouch so short that they push? */
static bool is_crushed(const ZpRestMember *m) {
  return m->model->pouch.w > 0 && reach_of(m) < 2 / zp_pi * m->model->pouch.length;
}

static const char *fault_of_stations(const ZpRestMember *m, double U, bool contact_acts) {
  static const double beyond_plates = 1.1; /* fields around the ends add less to plates */
  if (!m->model->field) return NULL;
  if (is_crushed(m)) return "a pouch is crushed: nothing holds it taut";
  double least = INFINITY, capacitance = m->model->parts * totals(m, U).capacitance;
  for (size_t i = 0; i < m->model->nodes; i++)
    least = fmin(least, m->eval.plates.gap[i]);
  if (contact_acts && least < m->model->faces.stop - deepest_overlap(m->model, U))
    return "the insulators' faces overlap";
  if (capacitance < 0) return "the capacitance is negative";
  if (capacitance > beyond_plates * closed_capacitance(m->model))
    return "the capacitance is above that of closed faces";
  return NULL;
}

const char *zp_statics_fault_of_stations(const ZpStatics *s) {
  const char *fault = NULL;
  for (size_t k = 0; k < s->members && !fault; k++)
    fault = fault_of_stations(&s->member[k], zp_statics_member_voltage(s, k), s->contact_acts);
  return fault;
}

bool zp_statics_faces_cross(const ZpStatics *s) {
  for (size_t k = 0; k < s->members; k++) {
    const ZpRestMember *m = &s->member[k];
    bool apart = m->model->field && s->contact_acts; /* as contact wants them */
    if (apart && zp_crosses(m->model, m->q, deepest_crossing(m->model, zp_statics_member_voltage(s, k)))) return true;
  }
  return false;
}

const char *zp_statics_fault(const ZpStatics *s) {
  return zp_statics_faces_cross(s) ? ZP_FACES_CROSS : zp_statics_fault_of_stations(s);
}

ZpShape zp_statics_shape(const ZpStatics *s, size_t which, double time, ZpShapeRoom room) {
  const ZpRestMember *m = &s->member[which];
  ZpShape shape = {.time = time,
                   .voltage = zp_statics_member_voltage(s, which),
                   .zipped = front_of(m),
                   .x = m->q,
                   .y = zp_nodes(m->model, m->q).y};
  for (int half = 0; m->model->has_bead && half < zp_beads(&m->model->film); half++)
    room.reach[half] = m->eval.reach[half];
  if (m->model->field) shape.gap = m->eval.plates.gap;
  const ZpSpan here = zp_statics_span(s, which);
  room.k0 = zp_term_natural_of_state(m->model, &here, &s->member[which].eval);
  zp_shape_fill(m->model, &room, &shape);
  return shape;
}

/* -- the held platform ---------------------------------------------------------------------------- */

/* While a study gives an opening, the row of a held platform takes the place of its balance of forces: the platform is
 * where the row puts it. A step moves it there while the edges rotate, so there is no closing error to spread along the
 * ribbons. */

static size_t load_coordinate(const ZpRestMember *m) {
  return zp_pulled(&m->model->topology, zp_load_node(&m->model->topology));
}

static size_t height_of(const ZpRestMember *m) {
  return (size_t)m->assembly.equation[load_coordinate(m)];
}

size_t zp_statics_platform(const ZpStatics *s) {
  return height_of(s->member + s->held.member);
}

/* The row has the form of a force, so that the tolerance of forces applies: a stiffness, of each half, times the
 * remaining distance. */
static double holding(const ZpStatics *s) {
  static const double soft = 1e-3; /* of the stiffest, so that the rounding of y does not count */
  const ZpModel *model = s->member->model;
  return soft * (double)zp_halves(&model->topology) * model->axial_stiffness;
}

double zp_statics_away(const ZpStatics *s) {
  const ZpRestMember *m = s->member + s->held.member;
  if (!zp_statics_holds(s)) return 0;
  return zp_tie_place(&s->held, 0, s->nearer * (s->from + s->taken * (s->opening - s->from))) -
         *zp_coordinate(m->model, m->q, s->held.coordinate);
}

double zp_statics_hold_rate(const ZpStatics *s, double away, double *r_m) {
  if (!zp_statics_holds(s)) return 0;
  size_t row = zp_statics_platform(s);
  double reaction = zp_statics_lifts(s) * r_m[row];
  r_m[row] = holding(s) * away;
  return reaction;
}

/* -- residual ------------------------------------------------------------------------------------- */

/* The part of the load that hangs on a member: of those side by side an equal share; of antagonists all of it on the
 * upper one; in series all of it on each, or on the last one if links carry the rest. */
static double load_part(const ZpStatics *s, size_t which) {
  const ZpEnds *ends = &s->model->network->ends[which];
  if (!is_joined(s)) return 1;
  return ends->lower == s->model->network->load && !ends->turned ? 1 / (double)ends->abreast : 0;
}

/* The part of the load's mass and force that the modelled part of a member carries: in series that of the lowest one,
 * on which it hangs. */
static double load_share(const ZpStatics *s, size_t which) {
  return zp_load_share(s->member[is_joined(s) ? which : s->members - 1].model);
}

/* Mass that hangs on a member in addition to its own load, kg: in series also what hangs below it. What is not carried
 * in the share that the member has of its own load counts as so much more or less. */
static double hung_on(const ZpStatics *s, size_t which) {
  const ZpModel *model = s->member[which].model, *last = s->member[s->members - 1].model;
  if (s->linked && model != last) return 0;
  if (!s->has_load) return is_joined(s) ? 0 : model->carried;
  if (is_joined(s)) return load_part(s, which) * s->load - model->def.load.mass;
  double share = model == last ? 1 : load_share(s, which) / zp_load_share(model);
  return model->carried + share * s->load - share * last->def.load.mass;
}

ZpSpan zp_statics_span(const ZpStatics *s, size_t which) {
  const ZpRestMember *m = &s->member[which];
  const ZpActuatorDef *def = &m->model->def;
  ZpSpan span = zp_span_at(m->q);
  span.U0 = span.U1 = zp_statics_member_voltage(s, which);
  span.hung = zp_load_share(m->model) * hung_on(s, which) * def->gravity;
  if (s->has_load && !is_joined(s)) span.load = load_share(s, which) * (s->force - def->load.force);
  span.share = s->share;
  span.suction = s->suction;
  span.faces_pass = !s->contact_acts;
  span.beyond = zp_eval_beyond(&m->eval);
  span.tension = m->tension;
  span.pressure = m->tension[zp_pressure_place(m->model)];
  span.modulus = m->modulus;
  return span;
}

/* Multiply the forces r on coordinates that both halves share by a factor. */
static void scale_common(const ZpParts *parts, double factor, double *r) {
  for (size_t k = 0; k < parts->count; k++)
    r[parts->common[k]] *= factor;
}

/* The largest residual force on one half, N; NAN if any is NAN. */
static double largest_of(const ZpStatics *s, double *r) {
  double largest = 0, halves = (double)(1 + s->parts.more);
  scale_common(&s->parts, 1 / halves, r);
  for (size_t i = 0; i < s->n && !isnan(largest); i++)
    if (!(fabs(r[i]) <= largest)) largest = fabs(r[i]);
  scale_common(&s->parts, halves, r);
  return largest;
}

bool zp_statics_asked_to_stop(ZpStatics *s) {
  s->unasked = 0;
  s->stopped = s->stopped || (s->stop && s->stop(s->caller));
  return s->stopped;
}

/* The height of a load that several members have is that of the first one. */
static void position(void *self, double *q) {
  const ZpStatics *s = self;
  for (size_t k = s->members; k-- > 0;)
    zp_assembly_gather(&s->member[k].assembly, s->member[k].q, q);
  if (in_plane(s)) zp_plane_gather(&s->plane, s->form.inner, s->pose, q);
}

/* Springs grow with the weight. */
static void add_springs(ZpStatics *s, double *r) {
  if (s->springs.count == 0) return;
  position(s, s->at);
  zp_springs_add_force(&s->springs, s->share, s->at, s->at, r);
}

/* Unknowns of bodies => 0, while they stay where they are. */
static void hold_bodies(const ZpStatics *s, double *r) {
  memset(r + s->form.inner, 0, (s->n - s->form.inner) * sizeof *r);
}

/* Of bodies in the plane, and between them. */
static void add_links(ZpStatics *s, double *r) {
  zp_links_add_force(&s->links, s->share, s->pose, s->pose, r);
  if (s->posed) hold_bodies(s, r);
}

static ZpEnd residual(void *self, double *r, double *size) {
  enum { BETWEEN = 64 }; /* residuals between two calls of `stop`: about a millisecond */
  ZpStatics *s = self;
  if (s->stopped || (++s->unasked >= BETWEEN && zp_statics_asked_to_stop(s))) return ZP_END_STOP;
  memset(r, 0, s->n * sizeof *r);
  for (size_t k = 0; k < s->members; k++) {
    ZpRestMember *m = &s->member[k];
    if (m->idle) continue;
    ZpSpan here = zp_statics_span(s, k);
    zp_system_force(m->model, &here, &m->eval, m->force);
    if (in_plane(s)) zp_plane_swing(&s->plane, k, s->pose, &m->assembly);
    zp_assembly_add(&m->assembly, m->force, r);
    if (in_plane(s)) zp_links_add_weight(&s->links, k, s->share, s->pose, &m->assembly, m->q, r);
  }
  if (in_plane(s))
    add_links(s, r);
  else
    add_springs(s, r);
  if (s->tight > 0) r[zp_statics_platform(s)] -= zp_statics_lifts(s) * s->tight;
  s->reaction = zp_statics_hold_rate(s, zp_statics_away(s), r);
  double largest = largest_of(s, r);
  if (size) *size = largest / s->scale;
  return isfinite(largest) ? ZP_END_FOUND : ZP_END_SHORTER;
}

/* -- stiffness ------------------------------------------------------------------------------------ */

/* The force on an end of the lower platform, with the tension that the last step predicted in the strip beside it. */
static ZpVector force_on_platform(const ZpRestMember *m, int end) {
  const ZpTopology *t = &m->model->topology;
  const size_t j = zp_lower(t, end == 0 ? t->platform.first : t->platform.last), edge = end == 0 ? j - m->model->s : j;
  const ZpForces f = zp_forces(m->model, m->force);
  const double lacks = (end == 0 ? -1 : 1) * (m->tension[edge] - m->eval.edges.T[edge]);
  return (ZpVector){f.x[j] + lacks * m->eval.edges.ux[edge], f.y[j] + lacks * m->eval.edges.uy[edge]};
}

/* Part of the stiffness of a member by the turns of its bodies. */
static void add_stand(const ZpStatics *s, size_t which, ZpBand *K) {
  const ZpRestMember *m = &s->member[which];
  const ZpVector force[] = {force_on_platform(m, 0), force_on_platform(m, 1)};
  zp_plane_add_turns(&s->plane, which, s->pose, &m->assembly, force, 1, K);
  zp_links_add_weight_stiffness(&s->links, which, s->share, s->pose, &m->assembly, m->q, K);
}

/* Add the stiffness of each member, or its part beside edges. */
static void add_members(ZpStatics *s, bool beside_edges, ZpArrow *K) {
  for (size_t k = 0; k < s->members; k++)
    K->part[k].idle = s->member[k].idle;
  zp_arrow_clear(K);
  for (size_t k = 0; k < s->members; k++) {
    ZpRestMember *m = &s->member[k];
    if (m->idle) continue;
    ZpSpan here = zp_statics_span(s, k);
    if (beside_edges)
      zp_system_add_stiffness_beside_edges(m->model, &here, &m->assembly, &m->eval, &K->part[k].A);
    else
      zp_system_add_stiffness(m->model, &here, &m->assembly, &m->eval, &K->part[k].A);
    if (in_plane(s)) add_stand(s, k, &K->part[k].A);
  }
  zp_arrow_mirror(K);
  if (in_plane(s)) zp_links_add_stiffness(&s->links, s->share, s->pose, s->pose, true, &K->D);
  if (s->springs.count > 0) {
    position(s, s->at);
    zp_springs_add_stiffness(&s->springs, s->share, s->at, s->at, true, s->form.inner, &K->D);
  }
  zp_arrow_close(K);
}

static void stiffness(void *self, ZpArrow *K, double *r) {
  ZpStatics *s = self;
  add_members(s, false, K);
  for (size_t i = s->form.inner; s->posed && i < s->n; i++)
    zp_arrow_prescribe(K, i, holding(s), 0, NULL, s->row);
  if (!zp_statics_holds(s)) return;
  size_t platform = zp_statics_platform(s);
  zp_arrow_prescribe(K, platform, holding(s), r ? r[platform] / holding(s) : 0, r, s->row);
}

/* The exact stiffness is that with the tensions of the present point. */
void zp_statics_evaluate(ZpStatics *s) {
  residual(s, s->newton.r, NULL);
  zp_statics_take_tensions(s);
}

double zp_statics_holding(ZpStatics *s) {
  zp_statics_evaluate(s);
  stiffness(s, &s->newton.K, s->newton.r);
  if (!zp_arrow_factor(&s->newton.K)) return s->reaction;
  zp_arrow_solve(&s->newton.K, s->newton.r);
  return s->reaction - zp_statics_lifts(s) * zp_dot(s->n, s->row, s->newton.r);
}

double zp_statics_stiffness_along(ZpStatics *s, const double *u, ZpArrow *K, double *r) {
  double sum = 0;
  residual(s, r, NULL);
  stiffness(s, K, NULL);
  for (size_t k = 0; k < s->members; k++)
    sum += zp_edges_along(&s->member[k].assembly, (const double(*)[4])s->member[k].eval.D, u);
  add_members(s, true, K);
  zp_arrow_multiply(K, u, r);
  for (size_t i = 0; i < s->n; i++)
    sum += u[i] * r[i];
  return sum;
}

/* -- moving --------------------------------------------------------------------------------------- */

ZP_KERNEL static void edges_under_step(size_t edges, size_t ribbons, const double *restrict dx,
                                       const double *restrict dy, const ZpEdges *e, double *restrict rotation,
                                       double *restrict stretch) {
  const double *restrict x = e->dpx, *restrict y = e->dpy, *restrict ux = e->ux, *restrict uy = e->uy;
  const double *restrict to_dx = dx + ribbons, *restrict to_dy = dy + ribbons;
  ZP_SIMD
  for (size_t j = 0; j < edges; j++) {
    double by_x = to_dx[j] - dx[j], by_y = to_dy[j] - dy[j], length = x[j] * ux[j] + y[j] * uy[j];
    rotation[j] = (ux[j] * by_y - uy[j] * by_x) / length;
    stretch[j] = ux[j] * by_x + uy[j] * by_y;
  }
}

/* In space: an edge, and how m->moved changes its vector. */
static const ZpSpaceEdge *edge_in_space(const ZpRestMember *m, size_t j, double change[3]) {
  for (size_t c = 0; c < 3; c++) {
    const double *moved = zp_read_axis(m->model, m->moved, c);
    change[c] = moved[j + m->model->s] - moved[j];
  }
  return &m->eval.space[j % m->model->s].edge[j / m->model->s + 1];
}

/* Rotation, without a sign and at least that of the angle of the edge, and stretch of all edges in space. */
static void edges_in_space_under_step(ZpRestMember *m) {
  const double *roll = zp_read_axis(m->model, m->moved, ZP_AXIS_ROLL);
  for (size_t j = 0; j < edge_count(m); j++) {
    double change[3];
    const ZpSpaceEdge *edge = edge_in_space(m, j, change);
    m->stretch[j] = zp_space_dot(edge->t, change);
    zp_space_add(-m->stretch[j], edge->t, change);
    m->rotation[j] = fmax(sqrt(zp_space_dot(change, change)) / edge->length, fabs(roll[j]));
  }
}

/* Rotation and stretch of all edges of a member under a step => m. */
static void turn(ZpRestMember *m, const double *step) {
  zp_assembly_changes(&m->assembly, step, m->moved);
  if (zp_is_in_space(m->model)) {
    edges_in_space_under_step(m);
    return;
  }
  edges_under_step(edge_count(m), m->model->s, m->moved, zp_nodes(m->model, m->moved).y, &m->eval.edges, m->rotation,
                   m->stretch);
}

/* The rise of a plate under a step, m. */
static double rise_of(const ZpRestMember *m, const double *step) {
  return zp_assembly_change(&m->assembly, step, load_coordinate(m));
}

/* Of a plate, which has no edges to turn, in place of a rotation the part of its gap by which it moves. */
static double rotation_of(ZpRestMember *m, const double *step, double most) {
  if (zp_half_elements(&m->model->topology) == 0) {
    const double part = fabs(rise_of(m, step)) / m->model->L;
    return part <= most ? most : part;
  }
  turn(m, step);
  return turned_by(m, most);
}

/* Of all. */
static double largest_rotation(ZpStatics *s, const double *step) {
  double most = 0;
  for (size_t k = 0; k < s->members; k++)
    if (!s->member[k].idle) most = rotation_of(&s->member[k], step, most);
  for (size_t i = s->form.inner; in_plane(s) && i < s->n && !isnan(most); i++) /* bodies, by the same length */
    if (!(fabs(step[i]) / s->plane.length <= most)) most = fabs(step[i]) / s->plane.length;
  return most;
}

static const double longest_turn = 0.5; /* rad, up to which linearised rotations are valid */

static double length(void *self, const double *step) {
  return largest_rotation(self, step) / longest_turn;
}

/* The largest relative change of a gap of a member, insulators included, in the step that has turned its edges. */
static double gap_share_of(const ZpRestMember *m, double U) {
  const ZpModel *model = m->model;
  const ZpPlatesParams *p = &model->plates;
  const ZpTopology *t = &model->topology;
  const double *y = zp_nodes(model, m->moved).y;
  double most = 0, least_h = zp_plates_least_h(p, U);
  for (size_t i = 0; i < model->nodes; i++) {
    double change = y[zp_lower(t, i)] - (zp_is_pair(t) ? y[zp_upper(t, i)] : 0);
    most = fmax(most, fabs(change) / fmax(m->eval.plates.gap[i] + p->d, least_h));
  }
  return most;
}

static double gap_share(const ZpStatics *s) {
  double most = 0;
  for (size_t k = 0; k < s->members; k++)
    if (!s->member[k].idle) most = fmax(most, gap_share_of(&s->member[k], zp_statics_member_voltage(s, k)));
  return most;
}

/* Does the attraction of faces act? */
static bool attracts(const ZpStatics *s) {
  return s->member->model->field && (s->U != 0 || (s->members > 1 && zp_statics_member_voltage(s, 1) != 0));
}

/* The largest rotation of an edge, rad, and, under a voltage, the largest relative change of a gap, insulators
 * included. */
static double change(void *self, const double *step) {
  ZpStatics *s = self;
  double most = largest_rotation(s, step);
  if (attracts(s)) most = fmax(most, gap_share(s));
  return most / zp_tolerance_at_rest(&s->member->model->def);
}

/* The axial stiffness of edge j is S[j], or `all` if S is NULL. => edge vectors in place of the displacements of their
 * nodes, and tensions */
ZP_KERNEL static void edges_turned(size_t edges, double fraction, const double *restrict S, double all,
                                   const ZpEdges *e, const double *restrict rotation, const double *restrict stretch,
                                   double *restrict tension, double *restrict to_x, double *restrict to_y) {
  const double *restrict x = e->dpx, *restrict y = e->dpy, *restrict ux = e->ux, *restrict uy = e->uy,
                         *restrict T = e->T;
  ZP_SIMD
  for (size_t j = 0; j < edges; j++) {
    double axial = S ? S[j] : all, turned = fraction * rotation[j];
    tension[j] = T[j] + fraction * axial * stretch[j];
    double tx = ux[j] - turned * uy[j], ty = uy[j] + turned * ux[j];
    double l = (x[j] * ux[j] + y[j] * uy[j] + fraction * stretch[j]) / sqrt(tx * tx + ty * ty);
    to_x[j] = l * tx;
    to_y[j] = l * ty;
  }
}

/* In space m->moved has the changes of nodes, and becomes edge vectors; angles of edges move, too. */
static void edges_in_space_turned(ZpRestMember *m, double fraction) {
  const ZpModel *model = m->model;
  double *roll = zp_axis(model, m->q, ZP_AXIS_ROLL);
  zp_space_predict(model, &m->eval, m->moved, fraction, &m->tension[zp_lanes(model)]);
  for (size_t j = 0; j < edge_count(m); j++) {
    double change[3];
    const ZpSpaceEdge *edge = edge_in_space(m, j, change);
    double t[3] = {edge->t[0], edge->t[1], edge->t[2]};
    zp_space_add(-m->stretch[j], edge->t, change);
    zp_space_add(fraction / edge->length, change, t);
    const double l = (edge->length + fraction * m->stretch[j]) / sqrt(zp_space_dot(t, t));
    m->tension[j] = m->eval.edges.T[j] + fraction * model->rod.S[j] * m->stretch[j];
    for (size_t c = 0; c < 3; c++)
      zp_axis(model, m->moved, c)[j] = l * t[c];
    roll[j] += fraction * zp_read_axis(model, m->moved, ZP_AXIS_ROLL)[j];
  }
}

/* Rotate and stretch each edge instead of moving its ends along straight lines. So a rotation does not stretch the
 * ribbon, whose axial stiffness is a million times its bending stiffness. The next stiffness uses the tensions that the
 * step predicts. Those of the rebuilt edges have an error of the square of the rotation times that million. => edge
 * vectors in m->moved. */
static void turn_edges(ZpRestMember *m, const double *step, double fraction) {
  const ZpModel *model = m->model;
  const ZpForces moved = zp_forces(model, m->moved);
  ZpSpan span = zp_span_at(m->q);
  span.modulus = m->modulus;
  turn(m, step);
  if (zp_pouch_rank(model) > 0)
    m->tension[zp_pressure_place(model)] = zp_pouch_predicted(model, &span, &m->eval, m->moved, fraction);
  if (zp_is_in_space(model)) {
    edges_in_space_turned(m, fraction);
    return;
  }
  edges_turned(edge_count(m), fraction, model->is_rod ? model->rod.S : NULL, model->spring.K_D, &m->eval.edges,
               m->rotation, m->stretch, m->tension, moved.x, moved.y);
}

double zp_statics_factor(const ZpStatics *s, size_t which) {
  const ZpRestMember *m = &s->member[which];
  return m->assembly.factor[load_coordinate(m)];
}

/* Where a member has a body at one of its ends that is at the height y: in its own frame, m. */
static double seen_by(const ZpStatics *s, size_t which, bool upper) {
  const ZpEnds *ends = &s->model->network->ends[which];
  ZpSight sight = zp_sight_of_end(s->model, which, upper);
  sight.origin *= s->nearer;
  return zp_seen(&sight, s->heights.y[upper ? ends->upper : ends->lower]);
}

static void find_heights(ZpStatics *s) {
  for (size_t k = 0; k < s->members; k++)
    s->heights.reach[k] = reach_of(&s->member[k]);
  zp_heights_find(&s->heights, s->nearer);
}

const ZpPose *zp_statics_places(ZpStatics *s) {
  const ZpNetwork *network = s->model->network;
  if (!in_plane(s)) find_heights(s);
  for (size_t b = 0; b < network->bodies; b++)
    s->place[b] = in_plane(s) ? zp_plane_place(&s->plane, b, s->pose)
                              : (ZpPose){network->body[b].x, s->heights.y[b], network->body[b].angle};
  return s->place;
}

/* Bodies to the heights that the openings of all members say; then each member to the bodies at its ends. */
static void place_between(ZpStatics *s) {
  find_heights(s);
  for (size_t k = 0; k < s->members; k++) {
    ZpRestMember *m = &s->member[k];
    zp_place_top(m->model, seen_by(s, k, true), m->q);
    zp_place_platform(m->model, &m->assembly, seen_by(s, k, false), m->q);
  }
}

/* Each member places its bodies slightly differently, by a term of second order. */
static void meet(ZpStatics *s) {
  if (!in_plane(s) && is_joined(s) && s->members > 1) place_between(s);
}

/* Closed faces would be parted: members that are open follow those that are less so. */
void zp_statics_rejoin(ZpStatics *s) {
  if (in_plane(s) || !is_joined(s) || s->members == 1) return;
  for (size_t k = 0; k < s->members; k++)
    s->heights.weight[k] = 1 / (reach_of(&s->member[k]) * reach_of(&s->member[k]) + DBL_MIN);
  place_between(s);
  for (size_t k = 0; k < s->members; k++)
    s->heights.weight[k] = 1;
}

/* Bodies, by a fraction of a step. */
static void move_bodies(ZpStatics *s, const double *step, double fraction) {
  zp_links_predict(&s->links, s->pose, step, fraction);
  zp_plane_gather(&s->plane, s->form.inner, s->pose, s->at);
  for (size_t i = s->form.inner; i < s->n; i++)
    s->at[i] += fraction * step[i];
  zp_plane_poses(&s->plane, s->form.inner, s->at, s->pose);
}

static void move_plate(ZpRestMember *m, const double *step, double fraction) {
  const double height = zp_nodes(m->model, m->q).y[zp_load_node(&m->model->topology)];
  zp_place_platform(m->model, &m->assembly, height + fraction * rise_of(m, step), m->q);
}

static void move_member(ZpStatics *s, size_t k, const double *step, double fraction) {
  ZpRestMember *m = &s->member[k];
  if (zp_half_elements(&m->model->topology) == 0) {
    move_plate(m, step, fraction);
    return;
  }
  turn_edges(m, step, fraction);
  if (in_plane(s)) zp_plane_put_platform(&s->plane, k, s->pose, s->nearer, m->q);
  zp_place_edges(m->model, &m->assembly, m->moved, m->q);
}

static void move(void *self, const double *step, double fraction) {
  ZpStatics *s = self;
  if (in_plane(s) && !s->posed) move_bodies(s, step, fraction);
  for (size_t k = 0; k < s->members; k++)
    if (!s->member[k].idle) move_member(s, k, step, fraction);
  meet(s);
}

/* Members that rows of ties do not join share no unknown: each moves on its own. */
static void move_each(void *self, const double *step, double unused) {
  ZpStatics *s = self;
  (void)unused;
  for (size_t k = 0; k < s->members; k++) {
    if (s->member[k].idle) continue;
    const double turns = rotation_of(&s->member[k], step, 0) / longest_turn;
    move_member(s, k, step, turns > 1 ? 1 / turns : 1);
  }
  meet(s);
}

/* Each member has its own length. */
static double no_length(void *self, const double *step) {
  (void)self;
  (void)step;
  return 0;
}

ZpNewtonInfo zp_statics_solve(ZpStatics *s, int most) {
  ZpStaticSystem system = zp_statics_system(s);
  if (!is_joined(s)) {
    system.move = move_each;
    system.length = no_length;
  }
  return zp_newton(&system, zp_statics_tolerance(s), most, &s->newton);
}

/* With the liquid where it is at these positions. */
static bool solve_field(ZpRestMember *m, double U) {
  const ZpModel *model = m->model;
  if (U == 0) return true;
  if (model->has_bead) {
    zp_plates_gaps(&model->plates, m->q, zp_nodes(model, m->q).y, &m->eval.plates);
    zp_eval_reach(model, m->eval.plates.gap, NULL, m->eval.reach);
    zp_eval_cover(model, m->eval.reach, &m->eval);
  }
  return zp_system_solve(model, m->q, U, &m->eval);
}

static ZpEnd refresh(void *self) {
  ZpStatics *s = self;
  bool solved = true;
  for (size_t k = 0; k < s->members && solved; k++)
    solved = s->member[k].idle || solve_field(&s->member[k], zp_statics_member_voltage(s, k));
  return solved ? ZP_END_FOUND : ZP_END_SHORTER;
}

ZpStaticSystem zp_statics_system(ZpStatics *s) {
  return (ZpStaticSystem){.n = s->n,
                          .parts = s->parts,
                          .self = s,
                          .residual = residual,
                          .stiffness = stiffness,
                          .length = length,
                          .change = change,
                          .move = move,
                          .refresh = s->member->model->field_solved ? refresh : NULL};
}

/* -- falling -------------------------------------------------------------------------------------- */

/* Limits of a step of motion with resistance: it must not pass over a nearby state, nor move faces through each
 * other. */
static double fall_length(void *self, const double *step) {
  static const double longest = 0.04, share = 0.25; /* 20 mrad; of a gap with its insulators */
  const ZpStatics *s = self;
  bool meets = s->member->model->field && (attracts(s) || s->contact_acts);
  return s->careful * fmax(length(self, step) / longest, meets ? gap_share(s) / share : 0);
}

/* A mesh with few elements on the zip front may hold it between any two nodes, which a long step passes over. */
static double care(const ZpStatics *s) {
  static const double few = 3, shorter = 4;
  bool is_few = false;
  for (size_t k = 0; k < s->members; k++)
    is_few |= zp_front_length(s->member[k].model, zp_statics_member_voltage(s, k)) < few * s->member[k].model->l;
  return is_few ? shorter : 1;
}

/* A front that passes node by node takes up to 400 steps for each node. */
static ZpNewtonInfo descend(ZpStatics *s, bool (*enough)(void *user), void *user) {
  enum { MOST_FOR_AN_UNKNOWN = 1000 };
  ZpStaticSystem system = zp_statics_system(s);
  s->careful = care(s);
  system.length = fall_length;
  return zp_descend_until(&system, 1, zp_statics_tolerance(s), MOST_FOR_AN_UNKNOWN * (int)s->n, enough, user,
                          &s->newton);
}

/* Is a member, the only one that is not idle, near an equilibrium? Then to it; else it stays. */
static bool finds_rest_nearby(ZpStatics *s) {
  enum { FEW = 8 };
  keep(s);
  bool found = zp_newton_good(zp_statics_solve(s, FEW).end) && zp_statics_stable(s) && !has_jumped(s);
  if (!found) go_back(s);
  return found;
}

/* Members of a series are at rest each by itself. Those that find an equilibrium nearby have no part in the fall of the
 * others. => does any fall? */
static bool set_aside(ZpStatics *s) {
  bool any = false;
  set_idle(s, true);
  for (ZpRestMember *m = s->member; m < s->member + s->members; m++) {
    m->idle = false;
    m->falls = !finds_rest_nearby(s);
    m->idle = true;
    any |= m->falls;
  }
  for (ZpRestMember *m = s->member; m < s->member + s->members; m++)
    m->idle = any && !m->falls;
  return any;
}

ZpNewtonInfo zp_statics_relax_until(ZpStatics *s, bool (*enough)(void *user), void *user) {
  int before = 0;
  if (are_apart(s) && set_aside(s)) before = descend(s, enough, user).iterations;
  set_idle(s, false);
  ZpNewtonInfo info = descend(s, enough, user);
  info.iterations += before;
  return info;
}

ZpNewtonInfo zp_statics_relax(ZpStatics *s, double voltage) {
  s->U = voltage;
  return zp_statics_relax_until(s, NULL, NULL);
}

/* -- along a parameter ---------------------------------------------------------------------------- */

void zp_statics_by_voltage(ZpStatics *s, double U, double *r_m) {
  const double here = s->U;
  s->U = U;
  memset(r_m, 0, s->n * sizeof *r_m);
  for (size_t k = 0; k < s->members; k++) {
    ZpRestMember *m = &s->member[k];
    ZpSpan span = zp_statics_span(s, k);
    ZpByVoltage by = {.force = m->force};
    zp_system_by_voltage(m->model, &span, &m->eval, &by);
    for (size_t j = 0; j < zp_coordinates(m->model); j++)
      m->force[j] *= m->model->ratio;
    zp_assembly_add(&m->assembly, m->force, r_m);
  }
  s->U = here;
  zp_statics_hold_rate(s, 0, r_m);
}

void zp_statics_by_port(ZpStatics *s, size_t lead, double U, double *r_m) {
  memset(r_m, 0, s->n * sizeof *r_m);
  for (size_t k = lead, next = 1; next > 0; k += next) {
    ZpRestMember *m = &s->member[k];
    ZpSpan span = zp_statics_span(s, k);
    ZpByVoltage by = {.force = m->force};
    span.U0 = span.U1 = zp_voltage_at_port(m->model, U);
    zp_system_by_voltage(m->model, &span, &m->eval, &by);
    for (size_t j = 0; j < zp_coordinates(m->model); j++)
      m->force[j] *= zp_part_of_port(m->model);
    zp_assembly_add(&m->assembly, m->force, r_m);
    next = zp_next_on_port(m->model);
  }
}

static void by_voltage(void *self, double *r_m) {
  ZpStatics *s = self;
  zp_statics_by_voltage(s, s->U, r_m);
}

/* dr/dU over 2 U; at U = 0 its value at 1 V, where no cap acts. */
static void by_square(void *self, double *r_m) {
  ZpStatics *s = self;
  double U = fmax(fabs(s->U), 1);
  zp_statics_by_voltage(s, U, r_m);
  for (size_t i = 0; i < s->n; i++)
    r_m[i] /= 2 * U;
}

static void by_load(void *self, double *r_m) {
  ZpStatics *s = self;
  memset(r_m, 0, s->n * sizeof *r_m);
  for (size_t k = 0; k < s->members; k++) {
    ZpRestMember *m = &s->member[k];
    const ZpModel *model = m->model;
    double per_mass = load_part(s, k) * load_share(s, k) * model->def.gravity;
    memset(m->force, 0, zp_coordinates(model) * sizeof *m->force);
    zp_weight_by_load(model, per_mass, 0, m->force);
    zp_assembly_add(&m->assembly, m->force, r_m);
  }
  zp_statics_hold_rate(s, 0, r_m);
}

/* Of each member q and tensions; voltage, load, bias. */
static void save(void *self, void *to) {
  const ZpStatics *s = self;
  double *place = to;
  for (const ZpRestMember *m = s->member; m < s->member + s->members; m++) {
    size_t coordinates = zp_coordinates(m->model), lanes = zp_predicted(m->model);
    memcpy(place, m->q, coordinates * sizeof *place);
    memcpy(place + coordinates, m->tension, lanes * sizeof *place);
    place += coordinates + lanes;
  }
  place[0] = s->U;
  place[1] = s->load;
  place[2] = s->bias;
  if (in_plane(s)) memcpy(place + 3, s->pose, s->plane.bodies * sizeof *s->pose);
  if (in_plane(s))
    memcpy(place + 3 + 3 * s->plane.bodies, s->links.pull, s->model->network->joints * sizeof *s->links.pull);
}

static void restore(void *self, const void *from) {
  ZpStatics *s = self;
  const double *place = from;
  for (ZpRestMember *m = s->member; m < s->member + s->members; m++) {
    size_t coordinates = zp_coordinates(m->model), lanes = zp_predicted(m->model);
    memcpy(m->q, place, coordinates * sizeof *place);
    memcpy(m->tension, place + coordinates, lanes * sizeof *place);
    place += coordinates + lanes;
  }
  s->U = place[0];
  s->load = place[1];
  s->bias = place[2];
  if (in_plane(s)) memcpy(s->pose, place + 3, s->plane.bodies * sizeof *s->pose);
  if (in_plane(s))
    memcpy(s->links.pull, place + 3 + 3 * s->plane.bodies, s->model->network->joints * sizeof *s->links.pull);
}

/* -- members that move alike ----------------------------------------------------------------------- */

/* Weight of what a member's platform carries, N. */
static double carried_weight(const ZpStatics *s, size_t which) {
  const ZpActuatorDef *def = &s->member[which].model->def;
  return (def->load.mass + hung_on(s, which)) * def->gravity;
}

/* Members in series that are the same and carry the same weight reach their limit points all at once. */
static bool are_alike(const ZpStatics *s) {
  if (is_joined(s)) return false;
  for (size_t k = 1; k < s->members; k++)
    if (carried_weight(s, k) != carried_weight(s, 0) || !zp_def_alike(&s->member[k].model->def, &s->member->model->def))
      return false;
  return s->members > 1;
}

/* Do forces at 0 V go with the voltage itself, because it drives curvature by its sign? */
static bool is_signed(const ZpStatics *s) {
  bool by_sign = false;
  for (const ZpRestMember *m = s->member; m < s->member + s->members; m++)
    for (size_t p = 0; p < m->model->driven.places; p++)
      by_sign |= m->model->driven.place[p].a != 0;
  return by_sign;
}

ZpBranchSystem zp_statics_branch(ZpStatics *s, ZpAlong along) {
  const ZpModel *model = s->member->model;
  const double voltage = fmax(fabs(zp_drive_voltage(model)), 1);
  if (along == ZP_ALONG_SQUARE && is_signed(s)) along = ZP_ALONG_VOLTAGE;
  const struct {
    double *input;
    void (*sensitivity)(void *self, double *r_m);
    double scale;
  } of[] = {[ZP_ALONG_VOLTAGE] = {&s->U, by_voltage, voltage},
            [ZP_ALONG_SQUARE] = {&s->U, by_square, voltage * voltage},
            [ZP_ALONG_LOAD] = {&s->load, by_load, fmax(s->own_load, 1e-3)}};
  return (ZpBranchSystem){.at_rest = zp_statics_system(s),
                          .input = of[along].input,
                          .square = along == ZP_ALONG_SQUARE,
                          .sensitivity = of[along].sensitivity,
                          .position = position,
                          .alike = are_alike(s) ? s->members : 0,
                          .save = save,
                          .restore = restore,
                          .save_size = (s->members * (zp_predicted(model) + zp_coordinates(model)) + 3 +
                                        3 * (s->plane.bodies + model->network->joints)) *
                                       sizeof(double),
                          .q_scale = 0.01 * model->L * sqrt(zp_parts_unknowns(&s->parts, s->n)),
                          .m_scale = of[along].scale};
}

void zp_statics_exact_stiffness(ZpStatics *s) {
  zp_statics_evaluate(s);
  stiffness(s, &s->newton.K, NULL);
}

/* Factored. False if it is singular. */
static bool tangent(ZpStatics *s) {
  zp_statics_exact_stiffness(s);
  return zp_arrow_factor(&s->newton.K);
}

void zp_statics_internal_damping(ZpStatics *s) {
  ZpArrow *K = &s->newton.K;
  zp_arrow_clear(K);
  for (size_t k = 0; k < s->members; k++) {
    ZpRestMember *m = &s->member[k];
    zp_system_internal_damping(m->model, m->q, &m->eval, s->spare);
    zp_assemble_edges(&m->assembly, (const double(*)[4])m->eval.D, &K->part[k].A);
  }
  zp_arrow_mirror(K);
  zp_arrow_close(K);
}

bool zp_statics_stable(ZpStatics *s) {
  return tangent(s) && zp_arrow_negative(&s->newton.K) == 0;
}

void zp_statics_masses(const ZpStatics *s, double *mass) {
  memset(mass, 0, s->n * sizeof *mass);
  if (in_plane(s)) zp_plane_add_masses(&s->plane, s->form.inner, mass);
  for (size_t k = 0; k < s->members; k++)
    zp_assembly_add_masses(&s->member[k].assembly, s->member[k].model->mass, mass);
}

double zp_statics_relaxing_along(ZpStatics *s, const double *u, size_t branch) {
  double sum = 0;
  for (ZpRestMember *m = s->member; m < s->member + s->members; m++) {
    zp_assembly_changes(&m->assembly, u, m->moved);
    const ZpNodes moved = zp_nodes(m->model, m->moved);
    sum += zp_rod_maxwell_along(&m->model->rod, &m->eval.rod_step, branch, moved.x, moved.y);
  }
  return sum;
}

/* Upward momentum of all nodes, in m->moved. */
static double momentum_of(const ZpRestMember *m) {
  const double *moved = zp_pulled_of(m->model, m->moved);
  double sum = 0;
  for (size_t j = 0; j < m->model->count; j++)
    sum += moved[j];
  return zp_rises(&m->model->topology) * sum;
}

/* Eq. (34.7): nodes move with the frame of their member, too. */
static void weigh_in_plane(ZpStatics *s, const double *u, double *mu) {
  for (size_t k = 0; k < s->members; k++) {
    ZpRestMember *m = &s->member[k];
    ZpForces moved = zp_forces(m->model, m->moved);
    zp_assembly_changes(&m->assembly, u, m->moved);
    zp_plane_carry(&s->plane, k, s->pose, s->form.inner, m->q, u, m->moved);
    for (size_t j = 0; j < m->model->count; j++) {
      const double mass = zp_is_of_platform(&m->model->topology, j) ? 0 : m->model->mass[j];
      moved.x[j] *= mass;
      moved.y[j] *= mass;
    }
    zp_assembly_add(&m->assembly, m->moved, mu);
    zp_plane_carry_back(&s->plane, k, s->pose, s->form.inner, m->q, m->moved, mu);
  }
  zp_plane_weigh(&s->plane, s->form.inner, u, mu);
}

/* Eq. (29.3): where all hang, a member moves relative to its upper platform, and with that platform, which moves by the
 * way of its body. */
void zp_statics_weigh(void *self, const double *u, double *mu) {
  ZpStatics *s = self;
  const ZpNetwork *network = s->model->network;
  const bool hang = s->members > 1 && !s->shared;
  memset(mu, 0, s->n * sizeof *mu);
  if (in_plane(s)) {
    weigh_in_plane(s, u, mu);
    return;
  }
  memset(s->way, 0, network->bodies * sizeof *s->way);
  memset(s->below, 0, network->bodies * sizeof *s->below);
  for (size_t i = 0; i < s->members; i++) {
    const size_t k = network->order[i];
    const double way = s->way[network->ends[k].upper];
    ZpRestMember *m = &s->member[k];
    const ZpForces moved = zp_forces(m->model, m->moved);
    const double rises = zp_rises(&m->model->topology);
    double *pulled = zp_pulled_of(m->model, m->moved);
    zp_assembly_changes(&m->assembly, u, m->moved);
    for (size_t j = 0; j < m->model->count; j++) {
      pulled[j] += rises * way;
      moved.x[j] *= m->model->mass[j];
      moved.y[j] *= m->model->mass[j];
    }
    zp_assembly_add(&m->assembly, m->moved, mu);
    if (hang) s->way[network->ends[k].lower] = way + rises * u[height_of(m)];
  }
  for (size_t i = s->members; hang && i-- > 0;) {
    const size_t k = network->order[i];
    const double below = s->below[network->ends[k].lower];
    mu[height_of(&s->member[k])] += zp_rises(&s->member[k].model->topology) * below;
    s->below[network->ends[k].upper] += below + momentum_of(&s->member[k]);
  }
}

double zp_statics_member_force(ZpStatics *s, size_t which) {
  ZpRestMember *m = &s->member[which];
  const ZpTopology *t = &m->model->topology;
  ZpSpan here = zp_statics_span(s, which);
  double sum = 0;
  zp_system_force(m->model, &here, &m->eval, m->force);
  for (size_t i = t->platform.first; i <= t->platform.last; i++)
    sum += zp_lifted(t, zp_nodes(m->model, m->force), zp_lower(t, i));
  if (!s->has_load) sum += here.hung; /* and what hangs below */
  return m->model->parts * sum + zp_load_pull(m->model);
}

double zp_statics_load_stiffness(ZpStatics *s) {
  size_t load = zp_statics_platform(s);
  double opening = s->opening;
  s->opening = NAN; /* as if it were free */
  bool regular = tangent(s);
  s->opening = opening;
  if (!regular) return NAN;
  memset(s->newton.r, 0, s->n * sizeof *s->newton.r);
  s->newton.r[load] = 1;
  zp_arrow_solve(&s->newton.K, s->newton.r);
  return s->member->model->parts / s->newton.r[load];
}
