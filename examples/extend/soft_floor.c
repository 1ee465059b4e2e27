/* A law of one's own as a term: a steel strip on a soft floor, pressed down at its free end by its load.
 *
 * A term says what its force is over a span, and its derivative; it does not know what else acts. In the library it
 * would be a file of src/term/ and a line of terms.def; a program appends it to the terms of a model. Built against the
 * rooms of src/, not against an installed zipact. Checked: a long beam on such a floor sinks at its end by
 * 2 P lambda / k + q / k, lambda^4 = k / (4 EI) (Winkler and Hetenyi), as long as its weight keeps it on the floor. */
#include <math.h>
#include <stdio.h>

#include "rest/rest.h"

static const double k = 1.2e4; /* of the floor, per length and depth, N/m^2 */

/* Of the floor under node i, N/m. */
static double floor_stiffness(const ZpModel *model, size_t i) {
  return k * model->l * (i == 0 || i + 1 == model->nodes ? 0.5 : 1);
}

/* The floor is at y = 0. It pushes where a node is below it at the end of the span, and does not hold what rises. */
static void force(const ZpModel *model, const ZpSpan *span, ZpEval *eval, double *F) {
  (void)eval;
  const double *y = span->end + model->stride;
  double *Fy = F + model->stride;
  for (size_t i = 0; i < model->nodes; i++)
    if (y[i] < 0) Fy[i] -= floor_stiffness(model, i) * y[i];
}

static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *eval, ZpBand *K) {
  (void)eval;
  const double *y = span->end + model->stride;
  for (size_t i = 0; i < model->nodes; i++) {
    int row = assembly->equation[2 * i + 1];
    if (row >= 0 && y[i] < 0) *zp_band_at(K, (size_t)row, (size_t)row) += floor_stiffness(model, i);
  }
}

static const ZpTerm soft_floor = {.name = "soft_floor", .force = force, .stiffness = stiffness};

int main(void) {
  ZpActuatorDef def = zp_actuator_def_default();
  def.actuator.kind = ZP_KIND_RIBBON;
  def.actuator.right_end = ZP_END_FREE;
  def.insulator.thickness = 0;
  def.mesh.nodes = 201;
  def.load.mass = 0.1e-3;
  ZpModel *model;
  ZpRest rest;
  ZpError err;
  if (zp_model_create(&def, &model, &err) != ZP_OK) return fprintf(stderr, "%s\n", err.message), 1;
  if (!zp_rest_open(&rest, model, NULL, NULL)) return 1;
  ZpEval *eval = &rest.statics.eval;
  eval->term[eval->terms++] = &soft_floor;
  ZpNewtonInfo info = zp_statics_hang(&rest.statics, &rest.branch.newton);
  double lambda = pow(k / (4 * zp_ribbon_section(model, 0).EI), 0.25), P = def.load.share * def.load.mass * def.gravity;
  double expected = 2 * P * lambda / k + zp_ribbon_section(model, 0).mu * def.gravity / k,
         found = zp_statics_stroke(&rest.statics);
  printf("the end sinks by %.3f um, expected %.3f um; %d iterations\n", 1e6 * found, 1e6 * expected, info.iterations);
  zp_rest_close(&rest);
  zp_model_destroy(model);
  return zp_newton_good(info.end) && fabs(found - expected) < 0.005 * expected ? 0 : 1;
}
