/* Angles of edges that are counted from a fixed tangent, and forces beside the middle. docs/theory.md, section 41. */
#include "space_util.h"

#include "ribbon/space_angle.h"

static Rod rod;
static const double from[3] = {1, 0, 0};

enum { NODES = 12 };
static double x[ROD_UNKNOWNS]; /* positions and angles, as the unknowns of the rod are numbered */

/* The edges at x. */
static void place(void) {
  const ZpSpaceEdge start = edge_along_x(rod.params.l, 1, 0);
  for (size_t i = 0; i < NODES; i++)
    memcpy(rod.at[i], x + ZP_SPACE_OF_NODE * i, sizeof rod.at[i]);
  for (size_t i = 0; i + 1 < NODES; i++) {
    const double vector[3] = {rod.at[i + 1][0] - rod.at[i][0], rod.at[i + 1][1] - rod.at[i][1],
                              rod.at[i + 1][2] - rod.at[i][2]};
    rod.edge[i + 1] = zp_space_move(&start, vector, x[ZP_SPACE_OF_NODE * i + 3]);
  }
}

/* A strip clamped at its left end, far from straight. */
static uint64_t bend_far(void) {
  const ZpSpaceSection section = zp_space_section(200e9, 0.285, 50e-6, 12.7e-3, true);
  uint64_t seed = 3;
  rod_straight(&rod, NODES, 0.05, &section, 1e3, (const bool[]){1, 0}, true, 1, 0);
  rod.params.from = from;
  for (size_t i = 0; i < NODES; i++) {
    const double s = (double)i / (NODES - 1);
    x[4 * i] = 0.05 * (s - 0.4 * s * s) + 2e-5 * noise(&seed);
    x[4 * i + 1] = -0.035 * s * s + 2e-5 * noise(&seed);
    x[4 * i + 2] = 0.02 * s * s * s + 2e-5 * noise(&seed);
    x[4 * i + 3] = s + 0.02 * noise(&seed);
  }
  place();
  return seed;
}

static const double h = 1e-7;

/* A random direction along what is free. */
static void choose(uint64_t *seed, double *way) {
  for (size_t i = 0; i < rod_unknowns(&rod); i++)
    way[i] = rod.fixed[i] ? 0 : h * noise(seed) * (i % ZP_SPACE_OF_NODE == 3 ? 400 : 1);
}

static void go(double share, const double *way) {
  for (size_t i = 0; i < rod_unknowns(&rod); i++)
    x[i] += share * way[i];
  place();
}

TEST(derivatives_of_a_rod) {
  double way[ROD_UNKNOWNS], gradient[2][ROD_UNKNOWNS], energy[2], slope = 0, curve = 0, product = 0;
  uint64_t seed = bend_far();
  choose(&seed, way);
  zp_space_energy(&rod.params, &rod.rod, rod.gradient);
  rod_stiffness(&rod);
  for (size_t i = 0; i < rod_unknowns(&rod); i++) {
    slope += rod.gradient[i] * way[i];
    for (size_t a = 0; a < ROD_WIDE && i + a < rod_unknowns(&rod); a++)
      product += (a == 0 ? 1 : 2) * rod.K[i * ROD_WIDE + a] * way[i] * way[i + a];
  }
  go(-1, way);
  energy[0] = zp_space_energy(&rod.params, &rod.rod, gradient[0]);
  go(2, way);
  energy[1] = zp_space_energy(&rod.params, &rod.rod, gradient[1]);
  for (size_t i = 0; i < rod_unknowns(&rod); i++)
    curve += 0.5 * (gradient[1][i] - gradient[0][i]) * way[i];
  ck_near(0.5 * (energy[1] - energy[0]), slope, 1e-6);
  ck_near(curve, product, 1e-6);
}

/* Height of a point beside the middle, of an edge whose angle is counted from `from`. */
TEST(derivatives_beside_the_middle) {
  const ZpSpaceEdge start = edge_along_x(1e-3, 1, 0);
  const double force[3] = {0.3, -1, 0.5}, across = 2e-3;
  double at[4] = {6e-4, -5e-4, 7e-4, 0.6}, first[4], second[4][4], other[2][4], value[2], unused[4][4];
  for (size_t k = 0; k < 4; k++) {
    const double small = k == 3 ? 1e-5 : 1e-8, here = at[k];
    for (int side = 0; side < 2; side++) {
      at[k] = here + (side ? small : -small);
      const ZpSpaceEdge edge = zp_space_move(&start, at, at[3]);
      const ZpSpaceAngle angle = zp_space_angle(from, &edge);
      value[side] = across * (force[0] * edge.width[0] + force[1] * edge.width[1] + force[2] * edge.width[2]);
      zp_space_beside(&edge, force, across, other[side], unused);
      zp_space_count_from(&angle, other[side], NULL);
    }
    at[k] = here;
    const ZpSpaceEdge edge = zp_space_move(&start, at, at[3]);
    const ZpSpaceAngle angle = zp_space_angle(from, &edge);
    zp_space_beside(&edge, force, across, first, second);
    zp_space_count_from(&angle, first, second);
    ck_near((value[1] - value[0]) / (2 * small), first[k], 1e-8);
    for (size_t j = 0; j < 4; j++)
      ck_near((other[1][j] - other[0][j]) / (2 * small), second[j][k], 1e-7);
  }
}
