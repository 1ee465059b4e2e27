/* A law of one's own as a term: a steel strip on a soft floor, pressed down at its free end by its load.
 *
 * A term says what its force is over a span, and its derivative; it does not know what else acts. In the library it
 * would be a file of src/term/ and a line of terms.def; a program adds it to a model of its own. Built against the
 * rooms of src/, not against an installed zipact. Checked: a long beam on such a floor sinks at its end by
 * 2 P lambda / k + q / k, lambda^4 = k / (4 EI) (Winkler and Hetenyi), as long as its weight keeps it on the floor. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "rest/rest.h"

static const double k = 1.2e4; /* of the floor, per length and depth, N/m^2 */

/* Of the floor under node j, N/m. A pair has two nodes at each station, one of each ribbon. */
static double floor_stiffness(const ZpModel *model, size_t j) {
  size_t station = j / model->s;
  return k * model->l * (station == 0 || station + 1 == model->nodes ? 0.5 : 1);
}

/* The floor is at y = 0. It pushes where a node is below it at the end of the span, and does not hold what rises. */
static void force(const ZpModel *model, const ZpSpan *span, ZpEval *eval, double *F) {
  (void)eval;
  const double *y = zp_nodes(model, span->end).y;
  double *Fy = zp_forces(model, F).y;
  for (size_t j = 0; j < model->count; j++)
    if (y[j] < 0) Fy[j] -= floor_stiffness(model, j) * y[j];
}

static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *eval, ZpBand *K) {
  (void)eval;
  const double *y = zp_nodes(model, span->end).y;
  for (size_t j = 0; j < model->count; j++) {
    int row = assembly->equation[2 * j + 1];
    if (row >= 0 && y[j] < 0) *zp_band_at(K, (size_t)row, (size_t)row) += floor_stiffness(model, j);
  }
}

static const ZpTerm soft_floor = {.name = "soft_floor", .force = force, .stiffness = stiffness};

/* A pair is pressed 1 mm deep into the floor: does it push with k times this depth times the length of both ribbons? */
static bool check_pair(void) {
  const double depth = 1e-3;
  ZpActuatorDef def = zp_actuator_def_default();
  ZpModel *model;
  ZpError err;
  if (zp_model_create(&def, &model, &err) != ZP_OK) return false;
  double *q = calloc(2 * zp_coordinates(model), sizeof *q), *F = q + zp_coordinates(model), found = 0;
  for (size_t j = 0; q && j < model->count; j++)
    zp_forces(model, q).y[j] = -depth;
  if (q) force(model, &(ZpSpan){.start = q, .end = q}, NULL, F);
  for (size_t j = 0; q && j < model->count; j++)
    found += zp_nodes(model, F).y[j];
  double expected = k * depth * 2 * model->l * (double)(model->nodes - 1);
  printf("a pair is pushed with %.4f N, expected %.4f N\n", found, expected);
  free(q);
  zp_model_destroy(model);
  return fabs(found - expected) < 1e-9 * expected;
}

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
  if (!zp_model_add_term(model, &soft_floor) || !zp_rest_open(&rest, model, NULL, NULL)) return 1;
  ZpNewtonInfo info = zp_statics_find_rest(&rest.statics);
  double lambda = pow(k / (4 * zp_ribbon_section(model, 0).EI), 0.25), P = def.load.share * def.load.mass * def.gravity;
  double expected = 2 * P * lambda / k + zp_ribbon_section(model, 0).mu * def.gravity / k,
         found = zp_statics_stroke(&rest.statics);
  printf("the end sinks by %.3f um, expected %.3f um; %d iterations\n", 1e6 * found, 1e6 * expected, info.iterations);
  zp_rest_close(&rest);
  zp_model_destroy(model);
  return zp_newton_good(info.end) && fabs(found - expected) < 0.005 * expected && check_pair() ? 0 : 1;
}
