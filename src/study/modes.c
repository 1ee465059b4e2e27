/* Study `modes`: small free vibrations about the loaded equilibrium, K u = omega^2 m u with the
 * lumped masses of the dynamics, by subspace iteration on the banded stiffness. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "def/check.h"
#include "math/eigen_general.h"
#include "math/vector.h"
#include "rest/vibration.h"
#include "study/equilibria.h"
#include "study/sensitivity.h"

static const double two_pi = 6.283185307179586;

static const ZpColumn columns[] = {
    {"mode", "1", "number of the mode"},
    {"frequency_Hz", "Hz", "frequency"},
    {"residual", "1", "largest relative error of the squared frequency"},
};
enum { COLUMNS = sizeof columns / sizeof columns[0] };

static const char frequency[] = "frequency_#_Hz", creeping[] = "creeping_frequency_#_Hz",
                  damping[] = "creeping_damping_#";

/* "1" of the first mode. */
static const char *number_of(size_t mode, char text[ZP_NAME_SIZE]) {
  snprintf(text, ZP_NAME_SIZE, "%zu", mode + 1);
  return text;
}

typedef struct Problem {
  ZpEquilibria at;
  ZpVibration vibration;
  size_t most; /* modes that are asked for */
  double *equilibrium;
} Problem;

static void reserve(void *user, ZpArena *arena) {
  Problem *p = user;
  zp_vibration_reserve(&p->vibration, p->at.rest.statics.n, 2 * p->most, arena);
  p->equilibrium = zp_arena_take(arena, zp_rest_save_size(&p->at.rest));
}

/* How many modes are told of? */
static size_t count(const Problem *p) {
  return p->vibration.m < p->most ? p->vibration.m : p->most;
}

static void move_member(ZpRestMember *m, const double *u, double amplitude) {
  const ZpModel *model = m->model;
  memset(m->moved, 0, zp_coordinates(model) * sizeof *m->moved);
  zp_assembly_changes(&m->assembly, u, m->moved);
  for (size_t i = 0; i < zp_coordinates(model); i++)
    m->q[i] += amplitude * m->moved[i];
  if (model->field) zp_plates_gaps(&model->plates, m->q, zp_nodes(model, m->q).y, &m->eval.plates);
}

/* The equilibrium, moved by a mode u [n] so that the equation that moves most does so by a tenth of the length; NULL:
 * not moved. */
static void record_shape(Problem *p, size_t frame, const double *u) {
  ZpStatics *s = &p->at.rest.statics;
  double largest = 0;
  for (size_t i = 0; u && i < s->n; i++)
    largest = fmax(largest, fabs(u[i]));
  p->at.rest.system.restore(s, p->equilibrium);
  for (size_t k = 0; u && k < s->members; k++)
    move_member(&s->member[k], u, 0.1 * s->member->model->L / largest);
  ZpShape shape = zp_rest_shape(&p->at.rest, (double)frame, u ? NULL : &p->at.margins);
  zp_shapes_offer(p->at.result->shapes, &shape);
}

/* Eq. (39.13): a mode of unit mass and its branches, which move alike: rates of its displacement, its velocity and the
 * strains of springs. => the eigenvalue that vibrates; 0 if none does. */
static ZpEigenvalue creeping_rate(double omega2, const double stiffness[ZP_BRANCHES], const double time[ZP_BRANCHES]) {
  enum { X, V, SPRINGS, N = SPRINGS + ZP_BRANCHES };
  double a[N * N] = {0}, work[N], *const row[] = {a + X, a + N};
  ZpEigenvalue value[N], found = {0, 0};
  row[X][V] = 1;
  row[V][X] = -omega2;
  for (size_t b = 0; b < ZP_BRANCHES; b++) {
    const size_t spring = SPRINGS + b;
    row[V][spring] = -stiffness[b];
    a[spring * N + spring] = -1 / time[b];
    if (stiffness[b] > 0) a[spring * N + V] = 1;
  }
  if (!zp_eigenvalues(N, a, work, value)) return found;
  for (size_t k = 0; k < N; k++)
    if (value[k].im > found.im) found = value[k];
  return found;
}

/* Of a mode u [n]. The strip creeps by the keys of all ribbons. */
static void report_creep(Problem *p, size_t mode, const double *u) {
  const ZpActuatorDef *def = &p->at.model->def;
  const double given[ZP_BRANCHES] = {def->ribbon.relaxation_time, def->insulator.relaxation_time};
  double stiffness[ZP_BRANCHES], time[ZP_BRANCHES];
  char room[ZP_NAME_SIZE];
  for (size_t b = 0; b < ZP_BRANCHES; b++) {
    time[b] = isnan(given[b]) ? 1 : given[b];
    stiffness[b] = zp_statics_relaxing_along(&p->at.rest.statics, u, b);
  }
  const ZpEigenvalue rate = creeping_rate(p->vibration.omega2[mode], stiffness, time);
  const bool vibrates = rate.im > 0;
  zp_result_add_of(p->at.result, creeping, number_of(mode, room), "Hz", vibrates ? rate.im / two_pi : NAN);
  zp_result_add_of(p->at.result, damping, number_of(mode, room), "1",
                   vibrates ? -rate.re / sqrt(rate.re * rate.re + rate.im * rate.im) : NAN);
}

/* Frame 0 is the equilibrium itself, frame j + 1 mode j. */
static void report(Problem *p) {
  ZpVibration *v = &p->vibration;
  zp_rest_save(&p->at.rest, p->equilibrium);
  for (size_t j = 0; zp_def_creeps(&p->at.model->def) && j < count(p); j++)
    report_creep(p, j, v->u + j * v->n);
  record_shape(p, 0, NULL);
  for (size_t j = 0; j < count(p); j++) {
    char room[ZP_NAME_SIZE];
    const double f = sqrt(v->omega2[j]) / two_pi;
    zp_result_add_of(p->at.result, frequency, number_of(j, room), "Hz", f);
    zp_table_offer(p->at.result->series, (double[COLUMNS]){(double)(j + 1), f, zp_vibration_residual(v, j)});
    record_shape(p, j + 1, v->u + j * v->n);
  }
}

/* -- derivatives ---------------------------------------------------------------------------------- */

typedef struct Mode {
  ZpArrow *K;
  double *work;    /* [n] */
  const double *u; /* [n] of length 1 with respect to the masses */
  double omega2;
} Mode;

/* u' (K - omega^2 m) u of a neighbouring actuator: its derivative is that of omega^2. */
static double stiffness_of_mode(ZpStatics *s, void *user) {
  const Mode *mode = user;
  double stiffness = zp_statics_stiffness_along(s, mode->u, mode->K, mode->work);
  zp_statics_weigh(s, mode->u, mode->work);
  return stiffness - mode->omega2 * zp_dot(s->n, mode->u, mode->work);
}

static void derive(void *user, ZpRestSensitivity *slope, ZpResult *result) {
  Problem *p = user;
  ZpStatics *s = &p->at.rest.statics;
  p->at.rest.system.restore(s, p->equilibrium);
  bool found = zp_rest_sensitivity_solve(slope, ZP_SETS_LOAD | ZP_SETS_MODES_VOLTAGE);
  for (size_t j = 0; j < count(p); j++) {
    Mode mode = {&p->at.rest.statics.newton.K, p->at.rest.statics.newton.r, p->vibration.u + j * p->vibration.n,
                 p->vibration.omega2[j]};
    double by_key = found ? zp_rest_sensitivity_of(slope, stiffness_of_mode, &mode) : NAN;
    char room[ZP_NAME_SIZE];
    zp_result_add_sensitivity_of(result, frequency, number_of(j, room), slope->key,
                                 by_key / (2 * two_pi * sqrt(p->vibration.omega2[j])));
  }
}

/* There is no hanging equilibrium at modes.voltage. */
static void note_pulled_in(Problem *p, double voltage) {
  ZpResult *result = p->at.result;
  const char *trouble = zp_statics_trouble(&p->at.rest.statics);
  if (!trouble) result->outcome = ZP_PULLED_IN;
  snprintf(result->message, sizeof result->message, "no hanging equilibrium at modes.voltage = %g V: %s", voltage,
           trouble ? trouble : "the actuator pulls in below it");
  for (size_t j = 0; j < count(p); j++)
    zp_result_add_of(result, frequency, number_of(j, (char[ZP_NAME_SIZE]){0}), "Hz", NAN);
}

/* Go to the hanging equilibrium at modes.voltage. */
static bool find_equilibrium(Problem *p) {
  ZpStatics *s = &p->at.rest.statics;
  ZpResult *result = p->at.result;
  const size_t size = sizeof result->message;
  ZpNewtonInfo info = zp_statics_find_rest(s);
  result->outcome = s->stopped ? ZP_INTERRUPTED : ZP_NOT_SETTLED;
  if (!zp_newton_good(info.end)) {
    snprintf(result->message, size, "%s",
             s->stopped ? "interrupted" : zp_statics_no_rest(s, (char[ZP_NO_REST_SIZE]){0}));
    return false;
  }
  double voltage = s->member->model->def.modes.voltage;
  if (!zp_statics_bias(s)) {
    snprintf(result->message, size, "%s", zp_statics_no_rest(s, (char[ZP_NO_REST_SIZE]){0}));
  } else if (voltage != 0 && zp_follows_voltage(s->member->model) && !zp_statics_ramp_voltage(s, voltage)) {
    note_pulled_in(p, voltage);
  } else if (zp_statics_shorted(s)) {
    result->outcome = ZP_SHORT_CIRCUIT;
    snprintf(result->message, size, "short circuit at modes.voltage = %g V: electrodes without an insulator touch",
             voltage);
  } else if (zp_statics_stable(s)) {
    return true;
  } else {
    snprintf(result->message, size, "the equilibrium is not stable");
  }
  return false;
}

static void run(Problem *p) {
  enum { ROUNDS = 30 }; /* more for derivatives: the error of a vector is the square root of that of its frequency */
  ZpVibration *v = &p->vibration;
  ZpStatics *s = &p->at.rest.statics;
  ZpResult *result = p->at.result;
  if (!find_equilibrium(p)) return;
  v->K = &s->newton.K;
  if ((s->members > 1 && !s->shared) || s->model->network->plane) {
    v->weigh = zp_statics_weigh;
    v->self = s;
  }
  zp_statics_masses(s, v->mass);
  zp_vibration_start(v);
  bool found = zp_vibration_solve(v, count(p));
  result->outcome = found ? ZP_CONVERGED : ZP_STEP_LIMIT;
  if (found)
    snprintf(result->message, sizeof result->message, "lowest frequency %.5g Hz", sqrt(v->omega2[0]) / two_pi);
  else
    snprintf(result->message, sizeof result->message, "the eigenvalue iteration has not converged");
  for (int round = 0; found && *s->member->model->def.sensitivity.by && round < ROUNDS; round++)
    zp_vibration_iterate(v);
  if (found) report(p);
}

/* Of the control loop at a setpoint: of that of all, and of each member's. */
#define ZP_RULES_OF_A_LOOP                                                                                             \
  ZP_RULE(NOT_MODELLED, ZP_NOT(control.kind, ZP_CONTROL_NONE), ZP_IS(ribbon.relaxation_modulus, 0),                    \
          "the small motion of layers that creep is not modelled"),                                                    \
      ZP_RULE(NOT_MODELLED, ZP_NOT(control.kind, ZP_CONTROL_NONE), ZP_IS(insulator.relaxation_modulus, 0),             \
              "the small motion of layers that creep is not modelled"),                                                \
      ZP_RULE(NOT_MODELLED, ZP_NOT(control.kind, ZP_CONTROL_NONE), ZP_IS(electro.model, ZP_ELECTRO_PLATES),            \
              "the eigenvalues of the control loop are computed for plates only"),                                     \
      ZP_RULE(NOT_MODELLED, ZP_NOT(control.kind, ZP_CONTROL_NONE), ZP_IS(bead.suction, 0),                             \
              "the eigenvalues of the control loop are computed without suction only"),                                \
      ZP_RULE(PHYSICS, ZP_NOT(control.kind, ZP_CONTROL_NONE), ZP_SET(setpoint.value), "a controller has a setpoint"),  \
      ZP_RULE_IF(PHYSICS, ZP_IS(setpoint.value, 0), ZP_ABOVE(control.boost_voltage, 0),                                \
                 ZP_NOT(control.kind, ZP_CONTROL_BOOST_PI),                                                            \
                 "there the boost acts in full on any error, so the loop has no eigenvalues; or use another setpoint")

static const char dry_loops[] = "the eigenvalues of loops of members are computed without liquid only";

static const char no_curves[] = "the eigenvalues of loops of members are those of electrodes alone";

static const ZpRule rule_of_a_loop[] = {
    ZP_RULES_OF_A_LOOP, ZP_RULE(NOT_MODELLED, ZP_CURVES_BY_VOLTAGE, ZP_IS(control.kind, ZP_CONTROL_NONE), no_curves)};
static const ZpRules rules_of_a_loop = ZP_RULES_OF(rule_of_a_loop);

static const ZpRule rule[] = {
    ZP_RULE(EQUATION, ZP_ANY, ZP_IS(ribbon.model, ZP_RIBBON_ROD),
            "the shear law of mass_spring has no energy, and inertia in space is not modelled"),
    ZP_RULE_IF(NOT_MODELLED, ZP_LACKS(RIGID), ZP_IS(liquid.model, ZP_LIQUID_SUBMERGED),
               ZP_NOT(control.kind, ZP_CONTROL_NONE),
               "frequencies neglect the mass of the liquid, which is far larger than that of the ribbons; use "
               "liquid.model none"),
    ZP_RULE(NOT_MODELLED, ZP_IS(electro.model, ZP_ELECTRO_FIELD), ZP_IS(modes.voltage, 0),
            "the stiffness of a computed field is not available; use plates"),
    ZP_RULES_OF_A_LOOP,
    ZP_RULE_IF(NOT_MODELLED, ZP_IS(control.signal, ZP_CONTROL_ANGLE), ZP_NOT(control.kind, ZP_CONTROL_NONE), ZP_PLANE,
               "the eigenvalues of the control loop are computed for the angle of a body only"),
    ZP_RULE_IF(NOT_MODELLED, ZP_NETWORK, ZP_NOT(control.kind, ZP_CONTROL_NONE), ZP_IS(liquid.model, ZP_LIQUID_NONE),
               dry_loops),
    ZP_RULE_IF(NOT_MODELLED, ZP_SET_WITHIN(member_K.port, member_K.setpoint.duty),
               ZP_NOT(control.kind, ZP_CONTROL_NONE), ZP_IS(liquid.model, ZP_LIQUID_NONE), dry_loops),
    ZP_RULE(NOT_MODELLED, ZP_SET(member_K.control.kind), ZP_IS(liquid.model, ZP_LIQUID_NONE), dry_loops),
    ZP_RULE_IF(NOT_MODELLED, ZP_CURVES_BY_VOLTAGE, ZP_NETWORK, ZP_IS(control.kind, ZP_CONTROL_NONE), no_curves),
    ZP_RULE_STARTS,
    ZP_RULE_ELASTIC,
    ZP_RULE_DERIVATIVES,
};
#undef ZP_RULES_OF_A_LOOP
const ZpRules zp_rules_modes = ZP_RULES_OF(rule);

/* Several loops sample at the same times. */
static ZpStatus check_loops(const ZpActuatorDef *def, ZpError *err) {
  double period = NAN;
  ZpStatus status = ZP_OK;
  for (int k = 1; k <= zp_def_members(def) && zp_def_members(def) > 1 && status == ZP_OK; k++) {
    const ZpActuatorDef one = zp_def_member(def, k);
    ZpError reason;
    if (one.control.kind == ZP_CONTROL_NONE) continue;
    if (isnan(period)) period = one.control.period;
    status = zp_rule_fail(zp_rules_find(&rules_of_a_loop, false, &one), "study modes ", &one, &reason);
    if (status == ZP_OK && one.control.period != period)
      status = zp_fail(&reason, ZP_BAD_INPUT,
                       "control.period = %g s: the eigenvalues of several loops are those from sample to sample; give "
                       "all the period of the first one, %g s",
                       one.control.period, period);
    if (status != ZP_OK) zp_fail_member(def, k, status, &reason, err);
  }
  return status;
}

ZpStatus zp_check_modes(const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = zp_check_mass(def, err);
  if (status == ZP_OK) status = check_loops(def, err);
  if (status == ZP_OK) status = zp_check_sensitivity(def, err);
  return status == ZP_OK ? zp_def_check_voltage(def, def->modes.voltage, err) : status;
}

/* Frequencies are those without the mass of a liquid: of a bead, which lies near the clip, where little moves. */
ZpStatus zp_study_modes(const ZpTask *task, ZpResult *result, ZpError *err) {
  ZpActuatorDef dry = *task->def;
  dry.liquid.model = ZP_LIQUID_NONE;
  Problem *p = zp_calloc(1, sizeof *p);
  if (!p) return zp_fail_memory(err);
  p->most = (size_t)dry.modes.count;
  p->at = (ZpEquilibria){.task = task, .result = result, .stage = "hanging", .shapes = p->most + 1};
  ZpStatus status = zp_equilibria_open(&p->at, &dry, reserve, p, err);
  if (status == ZP_OK) result->series = zp_table_create(columns, COLUMNS, p->most);
  if (status == ZP_OK && !result->series) status = zp_fail_memory(err);
  if (status == ZP_OK) {
    run(p);
    zp_equilibria_note(&p->at, dry.modes.voltage);
    if (zp_def_liquid(task->def) == ZP_LIQUID_SUBMERGED)
      zp_result_note(result, "the film is ignored: frequencies are those without its mass and drag");
    if (zp_def_liquid(task->def) == ZP_LIQUID_BEAD)
      zp_result_note(result, "the bead is ignored: frequencies are those of the ribbons without its mass and drag%s",
                     dry.modes.voltage > 0 ? ", with the liquid's permittivity everywhere" : "");
  }
  if (status == ZP_OK && result->outcome == ZP_CONVERGED)
    status = zp_sensitivity_of(&p->at.rest, derive, p, result, err);
  if (status == ZP_OK) status = zp_add_hold(task->def, result, err);
  zp_equilibria_close(&p->at);
  zp_free(p);
  return status;
}
