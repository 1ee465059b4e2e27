/* Ribbons in space: stretching, bending about both axes of the section, twist and warping; docs/theory.md, section 41.
 * Of equilibria. */
#include <string.h>

#include "math/vector.h"
#include "term/term.h"

enum { AXIAL, BENDING };

static bool acts(const ZpModel *model) {
  return zp_is_in_space(model);
}

/* An edge of the straight ribbon, its normal upwards and its width towards the viewer. */
static ZpSpaceEdge straight(double length) {
  return (ZpSpaceEdge){.length = length, .t = {1, 0, 0}, .normal = {0, 1, 0}, .width = {0, 0, 1}};
}

/* Positions and angles of ribbon r => its edges. */
static void place(const ZpModel *model, const double *q, size_t r, ZpSpaceRod *rod) {
  const ZpNodes n = zp_nodes(model, q);
  const double *z = zp_read_axis(model, q, ZP_AXIS_Z), *roll = zp_read_axis(model, q, ZP_AXIS_ROLL);
  const ZpSpaceEdge start = straight(model->l);
  rod->edge[0] = rod->edge[model->nodes] = start;
  for (size_t i = 0; i < model->nodes; i++) {
    const size_t j = i * model->s + r;
    const double at[3] = {n.x[j], n.y[j], z[j]};
    memcpy(rod->at[i], at, sizeof at);
  }
  for (size_t i = 0; i + 1 < model->nodes; i++) {
    double vector[3] = {rod->at[i + 1][0], rod->at[i + 1][1], rod->at[i + 1][2]};
    zp_space_add(-1, rod->at[i], vector);
    rod->edge[i + 1] = zp_space_move(&start, vector, roll[i * model->s + r]);
  }
}

static void tell_tensions(const ZpModel *model, size_t r, const ZpSpaceRod *rod, ZpEval *e) {
  const ZpSpaceRodParams *p = &model->space[r];
  for (size_t i = 0; i + 1 < model->nodes; i++)
    e->rod.T[i * model->s + r] = p->S * (rod->edge[i + 1].length - p->l);
}

void zp_space_take_sway(const ZpModel *model, const ZpEval *e, double *sway) {
  for (size_t j = 0; j < model->count; j++)
    sway[j] = e->space[j % model->s].joint[j / model->s].moment[ZP_SPACE_SWAY];
}

void zp_space_predict(const ZpModel *model, const ZpEval *e, const double *moved, double fraction, double *sway) {
  double *step = e->space_gradient, *change = e->space_K;
  zp_space_take_sway(model, e, sway);
  for (size_t r = 0; r < model->s; r++) {
    for (size_t i = 0; i < model->nodes; i++)
      for (size_t c = 0; c < ZP_SPACE_OF_NODE; c++)
        step[ZP_SPACE_OF_NODE * i + c] = zp_read_axis(model, moved, c)[i * model->s + r];
    zp_space_sway_changes(&model->space[r], &e->space[r], step, change);
    for (size_t i = 0; i < model->nodes; i++)
      sway[i * model->s + r] += fraction * change[i];
  }
}

static void force(const ZpModel *model, const ZpSpan *span, ZpEval *e, double *F) {
  for (size_t r = 0; r < model->s; r++) {
    ZpSpaceRod *rod = &e->space[r];
    place(model, span->end, r, rod);
    zp_space_energy(&model->space[r], rod, e->space_gradient);
    tell_tensions(model, r, rod, e);
    for (size_t i = 0; i < model->nodes; i++)
      for (size_t c = 0; c < ZP_SPACE_OF_NODE; c++)
        zp_axis(model, F, c)[i * model->s + r] -= e->space_gradient[ZP_SPACE_OF_NODE * i + c];
  }
}

static void stiffness(const ZpModel *model, const ZpSpan *span, const ZpAssembly *assembly, ZpEval *e, ZpBand *K) {
  enum { WIDE = ZP_SPACE_BAND + 1 };
  const size_t unknowns = ZP_SPACE_OF_NODE * model->nodes;
  for (size_t r = 0; r < model->s; r++) {
    ZpSpaceRod *rod = &e->space[r];
    for (size_t i = 0; i + 1 < model->nodes; i++)
      rod->tension[i] = span->tension ? span->tension[i * model->s + r] : e->rod.T[i * model->s + r];
    for (size_t i = 0; i < model->nodes; i++)
      rod->sway[i] =
          span->tension ? span->tension[zp_lanes(model) + i * model->s + r] : rod->joint[i].moment[ZP_SPACE_SWAY];
    memset(e->space_K, 0, WIDE * unknowns * sizeof *e->space_K);
    zp_space_stiffness(&model->space[r], rod, e->space_K);
    for (size_t i = 0; i < unknowns; i++)
      e->space_coordinate[i] =
          zp_coordinate_of(model->count, i / ZP_SPACE_OF_NODE * model->s + r, i % ZP_SPACE_OF_NODE);
    zp_assemble_chain(assembly, unknowns, e->space_coordinate, WIDE, e->space_K, K);
  }
}

static void hold(const ZpModel *model, const ZpSpan *now, ZpEval *e, double *row) {
  for (size_t r = 0; r < model->s; r++) {
    ZpSpaceRod *rod = &e->space[r];
    double axial = 0;
    place(model, now->end, r, rod);
    tell_tensions(model, r, rod, e);
    for (size_t i = 0; i + 1 < model->nodes; i++) {
      const double T = e->rod.T[i * model->s + r];
      axial += 0.5 * T * T / model->space[r].S;
    }
    row[AXIAL] += axial;
    row[BENDING] += zp_space_energy(&model->space[r], rod, NULL) - axial;
  }
}

static const ZpRule rule[] = {
    ZP_RULE(NOT_MODELLED, ZP_IS(ribbon.model, ZP_RIBBON_SPATIAL), ZP_LACKS(ELECTRODES),
            "attraction, contact and clips are those of ribbons in a plane; use actuator.kind ribbon"),
    ZP_RULE(NOT_MODELLED, ZP_IS(ribbon.model, ZP_RIBBON_SPATIAL), ZP_AT_MOST(insulator.young_modulus, 0),
            "a strip in space is of one layer"),
    ZP_RULE(NOT_MODELLED, ZP_IS(ribbon.model, ZP_RIBBON_SPATIAL), ZP_UNSET(sensitivity.by),
            "derivatives of equilibria in space are not available"),
    ZP_MOTION_RULE(NOT_MODELLED, ZP_ANY, ZP_NOT(ribbon.model, ZP_RIBBON_SPATIAL),
                   "ribbons in space are at rest; use study stationary"),
    ZP_RULE(PHYSICS, ZP_SET(load.across), ZP_IS(ribbon.model, ZP_RIBBON_SPATIAL),
            "a load beside the middle twists the strip"),
    ZP_RULE(PHYSICS, ZP_SET(mount.roll), ZP_IS(ribbon.model, ZP_RIBBON_SPATIAL),
            "gravity draws the strip out of its plane"),
};

const ZpTerm zp_term_space = {.name = "space",
                              .row = {[AXIAL] = &zp_row_axial_energy, [BENDING] = &zp_row_bending_energy},
                              .acts = acts,
                              .force = force,
                              .stiffness = stiffness,
                              .now = hold,
                              .rules = ZP_RULES_OF(rule)};
