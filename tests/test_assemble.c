/* The matrix of an actuator: the symmetric one, whose rows are written directly, is the upper triangle of the other,
 * whose entries ask for their equations. Against differences of the forces: test_stiffness. */
#include "check_util.h"

#include "actuator/assemble.h"
#include "actuator/place.h"
#include "math/vector.h"

enum { NODES = 9, STATIONS = 2 * NODES };

static const Setting kinds[][3] = {
    {{"actuator.kind", ZP_KIND_ELECTRO_RIBBON}},
    {{"actuator.kind", ZP_KIND_FLANGE}, {"electro.gap_offset", 1e-4}, {"actuator.right_end", ZP_END_FREE}},
    {{"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", ZP_END_CLAMPED}},
    {{"actuator.kind", ZP_KIND_ELECTRO_RIBBON}, {"ribbon.model", ZP_RIBBON_MASS_SPRING}},
    {{"actuator.symmetry", ZP_SYMMETRY_NONE}},
};

static ZpModel *model_of_kind(size_t kind) {
  ZpActuatorDef def = DEF({"mesh.nodes", NODES}, kinds[kind][0], kinds[kind][1].key ? kinds[kind][1] : kinds[kind][0],
                          kinds[kind][2].key ? kinds[kind][2] : kinds[kind][0]);
  return model_of(&def);
}

/* A band of zeros. */
static void *zero_band(ZpBand *K, const ZpAssembly *a) {
  ZpArena arena = {NULL, 0};
  zp_band_reserve_form(K, a->n, a->block.band, &arena);
  void *memory = zp_calloc(1, arena.used);
  arena = (ZpArena){memory, 0};
  zp_band_reserve_form(K, a->n, a->block.band, &arena);
  return memory;
}

/* Random derivatives, those of edges symmetric. */
static void draw(const ZpModel *model, double (*D)[4], double gaps[4][STATIONS]) {
  uint64_t seed = 7;
  size_t s = model->s, edges = s * (model->nodes - 1);
  for (size_t j = 0; j < edges; j++) {
    for (size_t k = 0; k < 4; k++) {
      D[3 * j + 1][k] = noise(&seed);
      D[3 * j + 2][k] = noise(&seed);
    }
    D[3 * j + 1][2] = D[3 * j + 1][1];
    for (size_t k = 0; k < 4 && j >= s; k++) /* the transpose of what edge j - s has with j */
      D[3 * j][k] = D[3 * (j - s) + 2][2 * (k % 2) + k / 2];
  }
  for (size_t k = 0; k < 4 * model->nodes; k++)
    gaps[k / model->nodes][k % model->nodes] = noise(&seed);
}

TESTS(test_symmetric_matrix_is_half_of_the_other, 0, LENGTH_OF(kinds)) {
  ZpModel *model = model_of_kind((size_t)_i);
  ZpAssembly half, whole;
  const ZpTies ties = zp_ties_of(model, 1, 0);
  ck_assert(zp_assembly_create(&ties, 0, true, &half) && zp_assembly_create(&ties, 0, false, &whole));
  double D[3 * 2 * STATIONS][4] = {{0}}, gaps[4][STATIONS];
  draw(model, D, gaps);
  ZpGapDerivatives of = {gaps[0], gaps[1], gaps[2], gaps[3]};
  ZpBand A, B;
  void *memory[2] = {zero_band(&A, &half), zero_band(&B, &whole)};
  zp_assemble_edges(&half, (const double(*)[4])D, &A);
  zp_assemble_edges(&whole, (const double(*)[4])D, &B);
  zp_assemble_gaps(&half, &of, &A);
  zp_assemble_gaps(&whole, &of, &B);
  bool direct = false;
  for (size_t i = 0; i < half.nodes; i++)
    direct |= half.first[i] >= 0;
  ck_assert(direct);
  for (size_t i = 0; i < half.n; i++)
    for (size_t j = i; j < half.n && j <= i + half.block.band.bandwidth; j++) {
      double kept = j < zp_band_end(&A, i) ? *zp_band_at(&A, i, j) : 0;
      ck_assert_double_eq_tol(kept, *zp_band_at(&B, i, j), 1e-14);
      ck_assert_double_eq_tol(*zp_band_at(&B, j, i), *zp_band_at(&B, i, j), 1e-14);
    }
  for (int k = 0; k < 2; k++)
    zp_free(memory[k]);
  zp_assembly_destroy(&half);
  zp_assembly_destroy(&whole);
}

static const Setting systems[][3] = {
    {{"actuator.symmetry", ZP_SYMMETRY_HALF}},
    {{"actuator.symmetry", ZP_SYMMETRY_NONE}},
    {{"actuator.symmetry", ZP_SYMMETRY_NONE}, {"platform.rotates", 1}, {"platform.electrode", 0}},
    {{"actuator.kind", ZP_KIND_HINGE}},
    {{"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", ZP_END_CLAMPED}},
    {{"stack.series", 3}},
    {{"stack.parallel", 3}, {"member_1.ribbon.thickness", 60e-6}},
    {{"stack.series", 2}, {"stack.distance", 0.05}},
};

/* (13.6): where the row of a held platform puts its ends, the opening is the given one: by zp_opening with a platform,
 * else the end of the lower ribbon is so far below its left end. */
TESTS(held_platform_is_at_its_opening, 0, LENGTH_OF(systems)) {
  const Setting *of = systems[_i];
  ZpActuatorDef def = DEF({"mesh.nodes", 6}, of[0], of[1].key ? of[1] : of[0], of[2].key ? of[2] : of[0]);
  ZpModel *model = model_of(&def);
  const ZpTie row = zp_tie_of_held(model, model->members);
  const ZpModel *held = model + row.member;
  const ZpTopology *t = &held->topology;
  double y[4 * 12] = {0}, s = 7e-3, upper = 0.2;
  const size_t left = zp_lower(t, 0), top = zp_upper(t, t->platform.first);
  y[zp_has_platform(t) ? top : left] = row.factor == 0 ? 0 : upper; /* of a series, the platform above it */
  for (size_t i = t->platform.first; i <= t->platform.last; i++)
    y[zp_lower(t, i)] = zp_tie_place(&row, upper, s);
  ck_assert_uint_eq(row.coordinate, zp_y_of(zp_lower(t, t->platform.first)));
  ck_assert_double_eq_tol(zp_reach(t, (ZpNodes){y, y}), s, 1e-16);
  ck_assert(row.factor == 0 || row.to_member != row.member); /* it hangs on what is held, or on another member */
}

/* (10.8): nodes that edges of any vectors place obey the rows, and no free coordinate could bring the edges nearer to
 * their vectors: the gradient of the sum of squares is 0. The ends of a platform that turns move as one. */
TESTS(placed_nodes_differ_least_from_their_edges, 0, 5) {
  const Setting *of = systems[_i];
  ZpActuatorDef def = DEF({"mesh.nodes", 6}, of[0], of[1].key ? of[1] : of[0], of[2].key ? of[2] : of[0]);
  ZpModel *model = model_of(&def);
  const ZpTopology *t = &model->topology;
  const ZpTies ties = zp_ties_of(model, 1, 0);
  ZpAssembly a;
  ck_assert(zp_assembly_create(&ties, 0, true, &a));
  double d[4 * 12 + 64] = {0}, q[4 * 12 + 64] = {0}, f[4 * 12 + 64] = {0}, gradient[4 * 12];
  uint64_t seed = 11;
  zp_place_straight(model, q);
  for (size_t k = 0; k < 2 * (model->count - model->s); k++)
    *zp_coordinate(model, d, k) = 1e-3 * noise(&seed);
  for (size_t k = 0; k < 4 && zp_halves(t) == 2; k++) /* the platform is rigid */
    *zp_coordinate(model, d, 4 * t->platform.first + k) = k % 2 == 0 ? def.platform.length : 0;
  zp_place_edges(model, &a, d, q);
  for (const ZpTie *tie = ties.tie; tie < ties.tie + ties.count; tie++)
    ck_assert_double_eq_tol(*zp_coordinate(model, q, tie->coordinate),
                            tie->factor * *zp_coordinate(model, q, tie->to) + tie->offset, 1e-16);
  for (size_t k = 0; k < 2 * (model->count - model->s); k++) {
    const size_t next = k + 2 * model->s;
    double differs = *zp_coordinate(model, q, next) - *zp_coordinate(model, q, k) - *zp_coordinate(model, d, k);
    *zp_coordinate(model, f, next) += differs;
    *zp_coordinate(model, f, k) -= differs;
  }
  for (size_t c = 0; c < 2 && zp_platform_turns(t); c++) {
    double *left = zp_coordinate(model, f, 2 * zp_lower(t, t->platform.first) + c);
    *left += *zp_coordinate(model, f, 2 * zp_lower(t, t->platform.last) + c);
    *zp_coordinate(model, f, 2 * zp_lower(t, t->platform.last) + c) = 0;
  }
  zp_assembly_sum(&a, f, gradient);
  for (size_t i = 0; i < a.n; i++)
    ck_assert_double_eq_tol(gradient[i], 0, 1e-16);
  zp_assembly_destroy(&a);
}

/* A matrix of random entries with a dominant diagonal, and a term on top. */
static void *random_band(ZpBand *K, size_t n, ZpBandForm form) {
  ZpArena arena = {NULL, 0};
  uint64_t seed = 5;
  zp_band_reserve_form(K, n, form, &arena);
  void *memory = zp_calloc(1, arena.used);
  arena = (ZpArena){memory, 0};
  zp_band_reserve_form(K, n, form, &arena);
  zp_band_clear(K);
  for (size_t i = 0; i < n; i++)
    for (size_t j = i; j < n && j <= i + form.bandwidth; j++) {
      *zp_band_at(K, i, j) = noise(&seed) + (i == j ? 9 : 0);
      if (!form.symmetric && j > i) *zp_band_at(K, j, i) = noise(&seed);
    }
  for (size_t i = 0; i < n * form.rank; i++) {
    K->u[i] = noise(&seed);
    K->v[i] = noise(&seed);
  }
  return memory;
}

/* The solution with a prescribed unknown obeys all other equations as they were, and the row that was replaced is that
 * of the matrix. */
TESTS(prescribed_unknown_is_eliminated, 0, 4) {
  enum { N = 11 };
  ZpBand K, given;
  ZpBandForm form = {.bandwidth = 3, .symmetric = _i % 2 == 0, .rank = (size_t)_i / 2};
  void *memory[2] = {random_band(&K, N, form), random_band(&given, N, form)};
  for (size_t unknown = 0; unknown < N; unknown++) {
    const double diagonal = 2, move = 0.7;
    double b[N], x[N], product[N], row[N];
    memcpy(K.a, given.a, K.entries * sizeof *K.a);
    for (size_t i = 0; i < N * form.rank; i++) {
      K.u[i] = given.u[i];
      K.v[i] = given.v[i];
    }
    for (size_t i = 0; i < N; i++)
      b[i] = x[i] = cos((double)i);
    x[unknown] = diagonal * move;
    zp_band_prescribe(&K, unknown, diagonal, move, x, row);
    ck_assert(zp_band_factor(&K));
    zp_band_solve(&K, x);
    zp_band_multiply(&given, x, product);
    ck_assert_double_eq_tol(x[unknown], move, 1e-15);
    for (size_t i = 0; i < N; i++)
      if (i != unknown) ck_assert_double_eq_tol(product[i], b[i], 5e-15);
    ck_assert_double_eq_tol(zp_dot(N, row, x), product[unknown], 5e-15);
  }
  for (int k = 0; k < 2; k++)
    zp_free(memory[k]);
}

/* Every row holds a coordinate or ties it to a free one, all other coordinates have equations of their own, and
 * coordinates that are placed by any unknowns obey the rows that tie. */
TESTS(test_coordinates_obey_their_ties, 0, LENGTH_OF(systems)) {
  const Setting *of = systems[_i];
  ZpActuatorDef def = DEF({"mesh.nodes", 6}, of[0], of[1].key ? of[1] : of[0], of[2].key ? of[2] : of[0]);
  ZpModel *model = model_of(&def);
  ZpAssembly a[3], *all[3] = {&a[0], &a[1], &a[2]};
  double unknowns[3 * 4 * 12], q[3][4 * 12 + 64] = {{0}};
  size_t free = 0;
  uint64_t seed = 3;
  ZpTies ties[3];
  for (size_t k = 0; k < model->members; k++) {
    ties[k] = zp_ties_of(model, model->members, k);
    ck_assert(zp_assembly_create(&ties[k], 0, true, &a[k]));
    free += 2 * model[k].count - ties[k].count;
  }
  ZpArrowForm form;
  ck_assert(zp_assembly_join(all, model, model->members, 0, &form));
  ck_assert_uint_eq(a->n, free);
  for (size_t i = 0; i < a->n; i++)
    unknowns[i] = noise(&seed);
  for (size_t k = 0; k < model->members; k++)
    zp_assembly_place(&a[k], unknowns, q[k]);
  for (size_t k = 0; k < model->members; k++)
    for (const ZpTie *tie = ties[k].tie; tie < ties[k].tie + ties[k].count; tie++) {
      if (tie->factor == 0) {
        ck_assert_int_eq(a[k].equation[tie->coordinate], -1); /* held */
        continue;
      }
      ck_assert_uint_eq(tie->member, k);
      if (tie->to_member != k) ck_assert_uint_eq(tie->to_member, zp_shares_load(model) ? 0 : k - 1);
      double to = *zp_coordinate(model, q[tie->to_member], tie->to);
      ck_assert(!zp_tie_of(&ties[tie->to_member], tie->to));
      ck_assert_double_eq(*zp_coordinate(model, q[k], tie->coordinate), tie->factor * to + tie->offset);
    }
  for (size_t k = 0; k < model->members; k++)
    zp_assembly_destroy(&a[k]);
  zp_arrow_form_destroy(&form);
}

/* Layouts that no model can have, as a device might lay them out, and why. */
TEST(layouts_are_refused) {
  const ZpJoint left = {ZP_JOINT_CLAMP, 0, 0}, middle = {ZP_JOINT_FREE, 4, 4}, right = {ZP_JOINT_CLAMP, 8, 8};
  const struct {
    ZpTopology t;
    const char *words;
  } layout[] = {
      {{.joints = 2, .joint = {left, right}, .platform = right}, NULL},
      {{.joints = 0, .platform = right}, "a joint at the first station"},
      {{.joints = 2, .joint = {middle, right}, .platform = right}, "a joint at the first station"},
      {{.joints = 2, .joint = {left, middle}, .platform = middle}, "a joint at the first station"},
      {{.joints = 2, .joint = {left, right}, .platform = middle}, "on one of its joints"},
      {{.joints = 3, .joint = {left, middle, right}, .platform = middle}, "lay out the left half"},
  };
  for (size_t k = 0; k < LENGTH_OF(layout); k++) {
    ZpTopology t = layout[k].t;
    t.ribbons = 1, t.stations = t.nodes = 9;
    const char *fault = zp_topology_fault(&t);
    ck_assert_msg(layout[k].words ? fault && strstr(fault, layout[k].words) : !fault, "%zu: %s", k,
                  fault ? fault : "none");
  }
}
