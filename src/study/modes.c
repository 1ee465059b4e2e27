/* Study `modes`: small free vibrations about the loaded equilibrium, K u = omega^2 m u with the
 * lumped masses of the dynamics, by subspace iteration on the banded stiffness. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/fail.h"
#include "def/check.h"
#include "rest/rest.h"
#include "rest/series_mass.h"
#include "rest/vibration.h"
#include "study/hold.h"
#include "study/modes.h"
#include "study/notes.h"
#include "study/sensitivity.h"
#include "study/studies.h"

static const double two_pi = 6.283185307179586;

static const ZpColumn columns[] = {
    {"mode", "1", "number of the mode"},
    {"frequency_Hz", "Hz", "frequency"},
    {"residual", "1", "largest relative error of the squared frequency"},
};
enum { COLUMNS = sizeof columns / sizeof columns[0] };

static const char *const names[ZP_MODES] = {"frequency_1_Hz", "frequency_2_Hz", "frequency_3_Hz", "frequency_4_Hz",
                                            "frequency_5_Hz", "frequency_6_Hz", "frequency_7_Hz", "frequency_8_Hz"};

/* -- any vibrating system -------------------------------------------------------------------------- */

const char *zp_modes_name(size_t j) {
  return names[j];
}

size_t zp_modes_count(const ZpVibration *v) {
  return v->m < ZP_MODES ? v->m : ZP_MODES;
}

ZpTable *zp_modes_table(void) {
  return zp_table_create(columns, COLUMNS, ZP_MODES);
}

bool zp_modes_solve(ZpVibration *v, ZpResult *result) {
  zp_vibration_start(v);
  bool found = zp_vibration_solve(v, zp_modes_count(v));
  result->outcome = found ? ZP_CONVERGED : ZP_STEP_LIMIT;
  if (found)
    snprintf(result->message, sizeof result->message, "lowest frequency %.5g Hz", sqrt(v->omega2[0]) / two_pi);
  else
    snprintf(result->message, sizeof result->message, "the eigenvalue iteration has not converged");
  return found;
}

void zp_modes_add(ZpVibration *v, size_t j, ZpResult *result) {
  double frequency = sqrt(v->omega2[j]) / two_pi;
  zp_result_add(result, names[j], "Hz", frequency);
  zp_table_offer(result->series, (double[COLUMNS]){(double)(j + 1), frequency, zp_vibration_residual(v, j)});
}

void zp_modes_pulled_in(const ZpVibration *v, double voltage, const char *trouble, ZpResult *result) {
  if (!trouble) result->outcome = ZP_PULLED_IN;
  snprintf(result->message, sizeof result->message, "no hanging equilibrium at modes.voltage = %g V: %s", voltage,
           trouble ? trouble : "the actuator pulls in below it");
  for (size_t j = 0; j < zp_modes_count(v); j++)
    zp_result_add(result, names[j], "Hz", NAN);
}

double zp_modes_amplitude(const ZpVibration *v, size_t j, double length) {
  double largest = 0;
  for (size_t i = 0; i < v->n; i++)
    largest = fmax(largest, fabs(v->u[j * v->n + i]));
  return 0.1 * length / largest;
}

static void move_member(ZpRestMember *m, const double *u, double amplitude) {
  const ZpModel *model = m->model;
  memset(m->moved, 0, 2 * model->stride * sizeof *m->moved);
  zp_assembly_scatter(&m->assembly, u, m->moved);
  for (size_t i = 0; i < 2 * model->stride; i++)
    m->q[i] += amplitude * m->moved[i];
  if (model->field) zp_plates_gaps(&model->plates, m->q, m->q + model->stride, &m->eval.plates);
}

void zp_modes_move(ZpRest *rest, const double *equilibrium, const double *u, double amplitude) {
  ZpStatics *s = &rest->statics;
  rest->system.restore(s, equilibrium);
  for (size_t k = 0; k < s->members; k++)
    move_member(&s->member[k], u, amplitude);
}

/* -- one actuator ------------------------------------------------------------------------------------ */

typedef struct Problem {
  ZpRest rest;
  ZpVibration vibration;
  ZpSeriesMass series; /* of members in series */
  double *equilibrium;
  ZpMargins margins; /* of the equilibrium */
} Problem;

static void carve(void *user, ZpCarver *carver) {
  Problem *p = user;
  zp_vibration_carve(&p->vibration, p->rest.statics.n, ZP_MODES_SUBSPACE, carver);
  zp_series_mass_carve(&p->series, &p->rest.statics, carver);
  p->equilibrium = zp_carve(carver, zp_rest_save_size(&p->rest));
}

/* The error of a vector is the square root of that of its frequency: results that depend on it to first order need more
 * rounds. */
static void refine(Problem *p) {
  enum { ROUNDS = 30 };
  for (int round = 0; round < ROUNDS; round++)
    zp_vibration_iterate(&p->vibration);
}

/* The equilibrium moved by `amplitude` times mode j; frame 0 is the equilibrium itself, frame j + 1 mode j. */
static void record_shape(Problem *p, double frame, size_t j, double amplitude, ZpShapes *shapes) {
  zp_modes_move(&p->rest, p->equilibrium, p->vibration.u + j * p->vibration.n, amplitude);
  ZpShape shape = zp_rest_shape(&p->rest, frame, frame == 0 ? &p->margins : NULL);
  zp_shapes_offer(shapes, &shape);
}

static void report(Problem *p, ZpResult *result) {
  const ZpModel *model = p->rest.statics.member->model;
  p->rest.system.save(&p->rest.statics, p->equilibrium);
  record_shape(p, 0, 0, 0, result->shapes);
  for (size_t j = 0; j < zp_modes_count(&p->vibration); j++) {
    zp_modes_add(&p->vibration, j, result);
    record_shape(p, (double)(j + 1), j, zp_modes_amplitude(&p->vibration, j, model->L), result->shapes);
  }
}

/* -- derivatives ---------------------------------------------------------------------------------- */

static void pose(const ZpActuatorDef *def, ZpStatics *s) {
  s->load = s->own_load;
  s->U = def->modes.voltage;
}

typedef struct Mode {
  ZpBand *K;
  double *work;    /* [n] */
  const double *u; /* [n] of length 1 with respect to the masses */
  double omega2;
} Mode;

/* u' (K - omega^2 m) u of a neighbouring actuator: its derivative is that of omega^2. */
static double stiffness_of_mode(ZpStatics *s, void *user) {
  const Mode *mode = user;
  double sum = zp_statics_stiffness_along(s, mode->u, mode->K, mode->work);
  zp_statics_masses(s, mode->work);
  for (size_t i = 0; i < s->n; i++)
    sum -= mode->omega2 * mode->work[i] * mode->u[i] * mode->u[i];
  return sum;
}

static void derive(void *user, ZpSlope *slope, ZpResult *result) {
  Problem *p = user;
  ZpStatics *s = &p->rest.statics;
  p->rest.system.restore(s, p->equilibrium);
  bool found = !p->vibration.inertia && zp_slope_solve(slope, pose); /* of lumped masses */
  if (p->vibration.inertia)
    zp_result_note(result, "frequencies of members in series have no derivatives: their mass matrix is not diagonal");
  for (size_t j = 0; j < zp_modes_count(&p->vibration); j++) {
    Mode mode = {&p->rest.statics.newton.K, p->rest.statics.newton.r, p->vibration.u + j * p->vibration.n,
                 p->vibration.omega2[j]};
    double by_key = found ? zp_slope_of(slope, pose, stiffness_of_mode, &mode) : NAN;
    zp_result_add_sensitivity(result, names[j], slope->key, by_key / (2 * two_pi * sqrt(p->vibration.omega2[j])));
  }
}

static void run(Problem *p, const ZpTask *task, ZpResult *result) {
  zp_task_watches(task, &p->rest.statics);
  ZpNewtonInfo info = zp_statics_hang(&p->rest.statics);
  result->outcome = p->rest.statics.stopped ? ZP_INTERRUPTED : ZP_NOT_SETTLED;
  snprintf(result->message, sizeof result->message, "%s",
           p->rest.statics.stopped ? "interrupted" : "no hanging equilibrium found");
  if (!zp_newton_good(info.end)) return;
  if (!zp_statics_bias(&p->rest.statics)) {
    snprintf(result->message, sizeof result->message, "%s", zp_statics_no_rest(&p->rest.statics));
    return;
  }
  double voltage = p->rest.statics.member->model->def.modes.voltage;
  if (voltage > 0 && p->rest.statics.member->model->field && !zp_statics_raise(&p->rest.statics, voltage)) {
    zp_modes_pulled_in(&p->vibration, voltage, zp_statics_trouble(&p->rest.statics), result);
    return;
  }
  if (zp_statics_shorted(&p->rest.statics)) {
    result->outcome = ZP_SHORT_CIRCUIT;
    snprintf(result->message, sizeof result->message,
             "short circuit at modes.voltage = %g V: electrodes without an insulator touch", voltage);
    return;
  }
  if (!zp_statics_stable(&p->rest.statics)) {
    snprintf(result->message, sizeof result->message, "the equilibrium is not stable");
    return;
  }
  ZpVibration *v = &p->vibration;
  v->K = &p->rest.statics.newton.K;
  if (p->rest.statics.members > 1 && !p->rest.statics.shared) {
    zp_series_mass_fill(&p->series);
    v->inertia = &p->series.inertia;
  }
  zp_statics_masses(&p->rest.statics, v->mass);
  if (!zp_modes_solve(v, result)) return;
  if (*p->rest.statics.member->model->def.sensitivity.by) refine(p);
  report(p, result);
}

static const ZpRule rule[] = {
    ZP_RULE(EQUATION, ZP_ANY, ZP_IS(ribbon.model, ZP_RIBBON_ROD), "the shear law of mass_spring has no energy"),
    ZP_RULE(EQUATION, ZP_ANY, ZP_NOT(liquid.model, ZP_LIQUID_SUBMERGED),
            "it neglects the mass of the liquid, which is far larger than that of the ribbons; use none"),
    ZP_RULE(NOT_MODELLED, ZP_IS(electro.model, ZP_ELECTRO_FIELD), ZP_IS(modes.voltage, 0),
            "the stiffness of a computed field is not available; use plates"),
    /* the control loop at a setpoint */
    ZP_RULE(NOT_MODELLED, ZP_NOT(control.kind, ZP_CONTROL_NONE), ZP_IS(electro.model, ZP_ELECTRO_PLATES),
            "the eigenvalues of the control loop are computed for plates only"),
    ZP_RULE(NOT_MODELLED, ZP_NOT(control.kind, ZP_CONTROL_NONE), ZP_IS(bead.suction, 0),
            "the eigenvalues of the control loop are computed without suction only"),
    ZP_RULE(NOT_MODELLED, ZP_SEVERAL, ZP_IS(control.kind, ZP_CONTROL_NONE), "a controller measures a single actuator"),
    ZP_RULE(PHYSICS, ZP_NOT(control.kind, ZP_CONTROL_NONE), ZP_SET(setpoint.value), "a controller has a setpoint"),
    ZP_RULE_IF(PHYSICS, ZP_IS(setpoint.value, 0), ZP_ABOVE(control.boost_voltage, 0),
               ZP_NOT(control.kind, ZP_CONTROL_BOOST_PI),
               "there the boost acts in full on any error, so the loop has no eigenvalues; or use another setpoint"),
    ZP_RULE_STARTS,
    ZP_RULE_ELASTIC,
    ZP_RULE_DERIVATIVES,
};
const ZpRules zp_rules_modes = ZP_RULES_OF(rule);

ZpStatus zp_check_modes(const ZpActuatorDef *def, ZpError *err) {
  ZpStatus status = zp_check_mass(def, err);
  if (status == ZP_OK) status = zp_check_sensitivity(def, err);
  return status == ZP_OK ? zp_def_check_voltage(def, def->modes.voltage, err) : status;
}

void zp_modes_note_bead(ZpResult *result, const ZpActuatorDef *def) {
  if (zp_def_liquid(def) != ZP_LIQUID_BEAD) return;
  zp_result_note(result, "the bead is ignored: frequencies are those of the ribbons without its mass and drag%s",
                 def->modes.voltage > 0 ? ", with the liquid's permittivity everywhere" : "");
}

ZpActuatorDef zp_modes_def(const ZpActuatorDef *def) {
  ZpActuatorDef dry = *def;
  dry.liquid.model = ZP_LIQUID_NONE;
  return dry;
}

ZpStatus zp_study_modes(const ZpTask *task, ZpResult *result, ZpError *err) {
  ZpModel *model;
  ZpActuatorDef def = zp_modes_def(task->def);
  ZpStatus status = zp_model_create(&def, &model, err);
  if (status != ZP_OK) return status;
  Problem *p = zp_calloc(1, sizeof *p);
  result->series = zp_modes_table();
  result->shapes = p ? zp_model_shapes(model, ZP_MODES + 1) : NULL;
  if (result->series && result->shapes && zp_rest_open(&p->rest, model, carve, p)) {
    p->margins = zp_margins_none();
    run(p, task, result);
    zp_margins_join(&p->margins, zp_margins_at_clip(model, task->def->modes.voltage));
    zp_add_margins(result, model, &p->margins);
    zp_note_mesh(result, model, task->def->modes.voltage);
    zp_note_rest(result, model);
    zp_modes_note_bead(result, task->def);
    if (result->outcome == ZP_CONVERGED) status = zp_sensitivity_of(&p->rest, derive, p, result, err);
    if (status == ZP_OK) status = zp_add_hold(task->def, result, err);
  } else {
    status = zp_fail_memory(err);
  }
  if (p) zp_rest_close(&p->rest);
  zp_free(p);
  zp_model_destroy(model);
  return status;
}
