/* Rods in space: the curl of a cross-section that is bent and twisted, derivatives of strains, rods whose buckling and
 * large deflections are known, and the plane; section 41 of docs/theory.md. */
#include "space_util.h"

#include "ribbon/rod.h"

/* -- the cross-section ------------------------------------------------------------------------------- */

static const double E = 200e9, poisson = 0.285, thin = 50e-6, wide = 12.7e-3;

/* Least energy per length of a cross-section whose height eta(z) above the width is free, at curvature k and twist tau:
 * membrane strain tau^2 z^2 / 2 - k eta less its mean, which the strip is free to take, and plate bending. Cubic
 * elements; the linear system by elimination. */
static double curled_energy(double k, double tau) {
  enum { ELEMENTS = 40, N = 2 * (ELEMENTS + 1), GAUSS_POINTS = 4 };
  static const double at[] = {0.069431844202973712, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629},
                      weight[] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693};
  static double A[N + 1][N + 2];
  memset(A, 0, sizeof A);
  const double h = wide / ELEMENTS, D = E * thin * thin * thin / 12 / (1 - poisson * poisson);
  double constant = 0;
  for (size_t e = 0; e < ELEMENTS; e++)
    for (size_t g = 0; g < GAUSS_POINTS; g++) {
      const double s = at[g], z = -0.5 * wide + h * ((double)e + s), w = weight[g] * h, grown = 0.5 * tau * tau * z * z;
      const double value[] = {1 - 3 * s * s + 2 * s * s * s, h * s * (1 - s) * (1 - s), s * s * (3 - 2 * s),
                              h * s * s * (s - 1)},
                   second[] = {(12 * s - 6) / (h * h), (6 * s - 4) / h, (6 - 12 * s) / (h * h), (6 * s - 2) / h};
      /* strain: grown - k sum value q - e0, with e0 the last unknown */
      double strain[5] = {-k * value[0], -k * value[1], -k * value[2], -k * value[3], -1};
      const size_t place[] = {2 * e, 2 * e + 1, 2 * e + 2, 2 * e + 3, N};
      constant += w * (0.5 * E * thin * grown * grown + D * (0.5 * k * k + (1 - poisson) * tau * tau));
      for (size_t i = 0; i < 5; i++) {
        for (size_t j = 0; j < 5; j++)
          A[place[i]][place[j]] +=
              w * (E * thin * strain[i] * strain[j] + (i < 4 && j < 4 ? D * second[i] * second[j] : 0));
        A[place[i]][N + 1] -= w * (E * thin * grown * strain[i] + (i < 4 ? D * poisson * k * second[i] : 0));
      }
    }
  A[0][0] += 1e-3 * A[2][2]; /* a rigid shift of the height changes nothing: e0 takes it */
  double right[N + 1], sum = constant;
  for (size_t i = 0; i <= N; i++)
    right[i] = A[i][N + 1];
  for (size_t i = 0; i <= N; i++)
    for (size_t r = i + 1; r <= N; r++) {
      const double factor = A[r][i] / A[i][i];
      for (size_t c = i; factor != 0 && c <= N + 1; c++)
        A[r][c] -= factor * A[i][c];
    }
  for (size_t i = N + 1; i-- > 0;) {
    for (size_t c = i + 1; c <= N; c++)
      A[i][N + 1] -= A[i][c] * A[c][N + 1];
    A[i][N + 1] /= A[i][i];
    sum -= 0.5 * right[i] * A[i][N + 1];
  }
  return sum;
}

TESTS(law_is_the_least_energy_of_the_curl, 0, 6) {
  static const double of[][2] = {{2.5, 0.5}, {10, 0}, {10, 6}, {30, -20}, {100, 3}, {0.5, 12}};
  ZpSpaceSection section = zp_space_section(E, poisson, thin, wide, true);
  section.C = E / (2 * (1 + poisson)) * wide * thin * thin * thin / 3; /* without what the short edges lack */
  const double k = of[_i][0], tau = of[_i][1];
  ck_near(zp_space_law(&section, k, 0, tau).W, curled_energy(k, tau), 1e-6);
}

/* Figures of the default strip. */
TESTS(torsional_stiffness_of_a_bent_strip, 0, 4) {
  static const double k[] = {2.5, 10, 30, 100}, held[] = {0.4132, 0.7272, 0.8422, 0.9136},
                      stiffer[] = {1.165, 1.290, 1.336, 1.364};
  const ZpSpaceSection section = zp_space_section(E, poisson, thin, wide, false);
  ck_near(section.C, 4.108e-5, 1e-4);
  ck_near(section.B, 2.880e-5, 1e-4);
  ck_near(sqrt(section.D / section.C) / wide, 0.2317, 2e-4);
  ck_near((zp_space_law(&section, k[_i], 0, 0).stiffness[2][2] / section.C - 1) / (2 * poisson * section.B / section.C),
          held[_i], 2e-4);
  ck_near(zp_space_law(&section, k[_i], 0, 0).stiffness[2][2] / section.C, stiffer[_i], 1e-3);
}

/* Buckley: a straight strip that is free to shorten. */
TEST(torque_of_a_straight_strip) {
  const ZpSpaceSection section = zp_space_section(E, poisson, thin, wide, false);
  for (double tau = 0.1; tau < 100; tau *= 3)
    ck_near(zp_space_law(&section, 0, 0, tau).moment[2] - section.C * tau,
            E * thin * pow(wide, 5) * tau * tau * tau / 360, 1e-13);
  const double degree = acos(-1.0) / 180, length = 45e-3;
  for (int degrees = 1; degrees < 6; degrees += 4) {
    const double tau = degrees * degree / length;
    ck_near(zp_space_law(&section, 0, 0, tau).moment[2] / (section.C * tau) - 1, degrees == 1 ? 0.034 : 0.84, 2e-2);
  }
}

TEST(moments_are_derivatives_of_the_energy) {
  for (double k = -120; k < 130; k += 7.3)
    for (double tau = -40; tau < 50; tau += 11.7)
      for (int softens = 0; softens < 2; softens++) {
        const ZpSpaceSection p = zp_space_section(E, poisson, thin, wide, softens);
        const double h = 2e-5 * hypot(k, tau);
        const ZpSpaceLaw law = zp_space_law(&p, k, 3, tau),
                         bent[] = {zp_space_law(&p, k - h, 3, tau), zp_space_law(&p, k + h, 3, tau)},
                         twisted[] = {zp_space_law(&p, k, 3, tau - h), zp_space_law(&p, k, 3, tau + h)};
        const double scale = fabs(law.moment[0]) + fabs(law.moment[2]), stiff = scale / hypot(k, tau);
        ck_below(fabs((bent[1].W - bent[0].W) / (2 * h) - law.moment[0]) / scale, 1e-7);
        ck_below(fabs((twisted[1].W - twisted[0].W) / (2 * h) - law.moment[2]) / scale, 2e-8);
        for (int i = 0; i < 3; i += 2) {
          ck_below(fabs((bent[1].moment[i] - bent[0].moment[i]) / (2 * h) - law.stiffness[i][0]) / stiff, 1e-6);
          ck_below(fabs((twisted[1].moment[i] - twisted[0].moment[i]) / (2 * h) - law.stiffness[i][2]) / stiff, 4e-9);
        }
      }
}

/* -- a joint --------------------------------------------------------------------------------------- */

static void vary(const ZpSpaceEdge edge[2], const double vector[2][3], const double by[ZP_SPACE_WAYS],
                 double strain[3]) {
  ZpSpaceEdge varied[2];
  ZpSpaceJoint joint;
  for (int e = 0; e < 2; e++) {
    double moved[3];
    for (int i = 0; i < 3; i++)
      moved[i] = vector[e][i] + by[3 * e + i];
    varied[e] = zp_space_move(&edge[e], moved, by[ZP_SPACE_ANGLE_BEFORE + e]);
  }
  zp_space_joint(&varied[0], &varied[1], &joint);
  memcpy(strain, joint.strain, 3 * sizeof *strain);
}

TEST(derivatives_of_strains) {
  uint64_t seed = 1;
  for (int trial = 0; trial < 40; trial++) {
    const ZpSpaceEdge start = edge_along_x(1, 1, 0);
    double vector[2][3];
    ZpSpaceEdge edge[2];
    ZpSpaceJoint joint;
    for (int e = 0; e < 2; e++) {
      for (int i = 0; i < 3; i++)
        vector[e][i] = (i == 0) + 0.6 * noise(&seed);
      edge[e] = zp_space_move(&start, vector[e], noise(&seed));
    }
    zp_space_joint(&edge[0], &edge[1], &joint);
    zp_space_joint_second(&edge[0], &edge[1], &joint);
    for (int a = 0; a < ZP_SPACE_WAYS; a++) {
      const double h = 1e-5, far = 1e-4;
      double less[3], more[3], by[ZP_SPACE_WAYS] = {0};
      by[a] = -h;
      vary(edge, vector, by, less);
      by[a] = h;
      vary(edge, vector, by, more);
      for (int s = 0; s < ZP_SPACE_STRAINS; s++)
        ck_below(fabs((more[s] - less[s]) / (2 * h) - joint.gradient[s][a]), 5e-10);
      for (int b = 0; b < ZP_SPACE_WAYS; b++) {
        double f[4][3];
        for (int k = 0; k < 4; k++) {
          double both[ZP_SPACE_WAYS] = {0};
          both[a] += k < 2 ? far : -far;
          both[b] += k % 2 ? far : -far;
          vary(edge, vector, both, f[k]);
        }
        for (int s = 0; s < ZP_SPACE_STRAINS; s++)
          ck_below(fabs((f[1][s] - f[0][s] - f[3][s] + f[2][s]) / (4 * far * far) - joint.second[s][a][b]), 6e-7);
      }
    }
  }
}

/* -- rods -------------------------------------------------------------------------------------------- */

static Rod rod;

/* The least load at which the rod buckles. */
static double buckling_load(void (*load)(double P, size_t nodes, double warps), size_t nodes, double warps,
                            double most) {
  double low = 0, high = most;
  while (high - low > 1e-9 * most) {
    const double P = 0.5 * (low + high);
    load(P, nodes, warps);
    rod_settle(&rod);
    *(rod.negative > 0 ? &high : &low) = P;
  }
  return low;
}

/* Errors of second order: from two meshes. */
static double extrapolated(void (*load)(double P, size_t nodes, double warps), size_t nodes, double warps,
                           double most) {
  const double coarse = buckling_load(load, nodes, warps, most), fine = buckling_load(load, 2 * nodes - 1, warps, most);
  return fine + (fine - coarse) / 3;
}

/* A strip on edge, clamped at one end: its height bends with 1e7 of the stiffness of its normal. */
static void cantilever(size_t nodes, double warps) {
  const ZpSpaceSection section = {.B = 1, .B2 = 1e7, .C = 1, .D = warps * warps};
  rod_straight(&rod, nodes, 1, &section, 1e7, (const bool[]){1, 0}, warps > 0, 0, 1);
}

static void load_the_tip(double P, size_t nodes, double warps) {
  cantilever(nodes, warps);
  rod.load[ZP_SPACE_OF_NODE * (nodes - 1) + 1] = -P;
}

static void load_by_own_weight(double p, size_t nodes, double warps) {
  cantilever(nodes, warps);
  for (size_t i = 0; i < nodes; i++)
    rod.load[ZP_SPACE_OF_NODE * i + 1] = -p / (double)(nodes - 1) * (i == 0 || i + 1 == nodes ? 0.5 : 1);
}

TEST(lateral_buckling) {
  ck_near(extrapolated(load_the_tip, 41, 0, 10), 4.01260, 1e-5);
  ck_near(extrapolated(load_by_own_weight, 41, 0, 30), 12.85376, 5e-5);
}

/* The flange of a strip resists warping where the clamp holds it flat. */
TESTS(lateral_buckling_with_warping, 0, 3) {
  static const double warps[] = {0.01, 0.03, 0.0654}, load[] = {4.0952, 4.2737, 4.6260};
  ck_near(buckling_load(load_the_tip, 161, warps[_i], 10), load[_i], 1e-3);
}

/* Both ends are built in; one was turned and may approach the other. */
static void turn_an_end(double moment, size_t nodes, double warps) {
  (void)warps;
  const ZpSpaceSection section = {.B = 1, .B2 = 1, .C = 1};
  rod_straight(&rod, nodes, 1, &section, 1e5, (const bool[]){1, 1}, false, 1, 0);
  rod.fixed[ZP_SPACE_OF_NODE * (nodes - 1)] = false;
  for (size_t i = 1; i <= nodes; i++) {
    const double whole = (double)(nodes - 1), angle = moment * fmin(((double)i - 0.5) / whole, 1);
    rod.edge[i] = edge_along_x(rod.params.l, cos(angle), sin(angle));
  }
}

TEST(greenhill) {
  ck_near(extrapolated(turn_an_end, 41, 0, 15), 8.9868, 1e-4);
}

/* Michell: a straight rod bent to a ring and twisted leaves its plane. The ring is cut at a section that is held. It
 * could turn about the tangent there without any force, so the opposite node is held in the plane. */
static void twist_a_ring(double twist, size_t nodes, double stiffness) {
  const ZpSpaceSection section = {.B = 1, .B2 = 1, .C = stiffness};
  const double turn = 2 * acos(-1.0) / (double)(nodes - 1);
  rod_straight(&rod, nodes, 2 * acos(-1.0), &section, 1e5, (const bool[]){1, 1}, false, 1, 0);
  rod.fixed[ZP_SPACE_OF_NODE * (nodes / 2) + 2] = true;
  for (size_t i = 1; i <= nodes; i++) {
    const double share = fmin(((double)i - 0.5) / (double)(nodes - 1), 1), angle = twist * share;
    const ZpSpaceEdge flat = edge_along_x(rod.params.l, cos(angle), sin(angle));
    const double way = 2 * acos(-1.0) * share, vector[3] = {rod.params.l * cos(way), rod.params.l * sin(way), 0};
    rod.edge[i] = flat;
    for (double part = turn; part < way; part += turn) { /* a frame is carried less than half a turn at once */
      const double on[3] = {rod.params.l * cos(part), rod.params.l * sin(part), 0};
      rod.edge[i] = zp_space_move(&rod.edge[i], on, 0);
    }
    rod.edge[i] = zp_space_move(&rod.edge[i], vector, 0);
    for (int c = 0; c < 3 && i < nodes; c++)
      rod.at[i][c] = rod.at[i - 1][c] + vector[c];
  }
}

TEST(michell) {
  const double C = 0.8;
  ck_near(extrapolated(twist_a_ring, 81, C, 20), 2 * acos(-1.0) * sqrt(3) / C, 8e-5);
}

/* Bathe and Bolourchi: an eighth of a circle of radius 100, clamped, under a force of 600 across its plane. */
TESTS(curved_cantilever, 0, 2) {
  static const double torsion[] = {0.1406, 1.0 / 6}, tip[][3] = {{15.558, 46.892, 53.608}, {15.685, 47.150, 53.475}};
  enum { NODES = 129, STEPS = 10 };
  const double R = 100, eighth = acos(-1.0) / 4, force = 600;
  const ZpSpaceSection section = {.B = 1e7 / 12, .B2 = 1e7 / 12, .C = 0.5e7 * torsion[_i]};
  rod_straight(&rod, NODES, R * eighth, &section, 1e7, (const bool[]){1, 0}, false, 0, 1);
  rod.params.natural[ZP_SPACE_SWAY] = 1 / R;
  rod_rest(&rod);
  for (int k = 1; k <= STEPS; k++) {
    rod.load[ZP_SPACE_OF_NODE * (NODES - 1) + 2] = force * k / STEPS;
    rod_rest(&rod);
  }
  ck_near(rod.at[NODES - 1][1], tip[_i][0], 3e-5);
  ck_near(rod.at[NODES - 1][0], tip[_i][1], 1.2e-4);
  ck_near(rod.at[NODES - 1][2], tip[_i][2], 2e-4);
}

/* -- the plane and its turns --------------------------------------------------------------------------- */

/* Energy and forces in the plane are those of the rod of rod.h, with a held slope and a free end. */
TEST(plane_is_the_planar_rod) {
  ZpActuatorDef def = DEF({"actuator.kind", ZP_KIND_RIBBON}, {"actuator.right_end", ZP_END_FREE}, {"mesh.nodes", 21});
  const ZpModel *model = model_of(&def);
  const ZpRodParams *p = &model->rod;
  const ZpSpaceSection section = {.B = p->B[5] * p->l[5], .B2 = 1, .C = 1};
  const size_t nodes = p->nodes;
  rod_straight(&rod, nodes, p->l[0] * (double)(nodes - 1), &section, p->S[0] * p->l[0], (const bool[]){1, 0}, false, 1,
               0);
  uint64_t seed = 3;
  for (size_t i = 0; i < rod_unknowns(&rod); i++)
    rod.fixed[i] |= i % ZP_SPACE_OF_NODE > 1; /* in the plane */
  rod_shake(&rod, 0.1 * p->l[0], &seed);
  double *x = calloc(p->lanes, sizeof *x), *y = calloc(p->lanes, sizeof *y);
  ZpRodEval eval;
  ZpArena size = {NULL, 0};
  zp_rod_reserve(p, &eval, &size);
  ZpArena arena = {zp_calloc(1, size.used), 0};
  zp_rod_reserve(p, &eval, &arena);
  for (size_t i = 0; i < nodes; i++) {
    x[i] = rod.at[i][0];
    y[i] = rod.at[i][1];
  }
  zp_rod_eval(p, x, y, &eval);
  const double planar = zp_rod_stretching_energy(p, &eval) + zp_rod_bending_energy(p, &eval);
  ck_near(zp_space_energy(&rod.params, &rod.rod, rod.gradient), planar, 1e-14);
  for (size_t i = 0; i < nodes; i++)
    ck_below(fabs(rod.gradient[ZP_SPACE_OF_NODE * i + 2]) + fabs(rod.gradient[ZP_SPACE_OF_NODE * i + 3]), 1e-15);
  free(x);
  free(y);
  zp_free(arena.base);
}

/* Energy, forces and stiffness turn with the rod. */
TEST(turned_in_space) {
  const ZpSpaceSection section = zp_space_section(E, poisson, thin, wide, false);
  static Rod turned;
  const double axis[3] = {0.48, 0.6, 0.64}, angle = 2.2;
  rod_straight(&rod, 21, 0.05, &section, 1e3, (const bool[]){1, 0}, true, 1, 0);
  uint64_t seed = 4;
  rod_shake(&rod, 2e-4, &seed);
  turned = rod;
  turned.rod = (ZpSpaceRod){.at = turned.at, .edge = turned.edge, .joint = turned.joint};
  turned.params.point = turned.point;
  turned.params.warp = turned.warp;
  double Q[3][3];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      static const int sign[3][3] = {{0, -1, 1}, {1, 0, -1}, {-1, 1, 0}};
      Q[i][j] = (i == j ? cos(angle) : 0) + (1 - cos(angle)) * axis[i] * axis[j] +
                (i == j ? 0 : sin(angle) * sign[i][j] * axis[3 - i - j]);
    }
#define TURN(v)                                                                                                        \
  do {                                                                                                                 \
    const double before[3] = {(v)[0], (v)[1], (v)[2]};                                                                 \
    for (int i = 0; i < 3; i++)                                                                                        \
      (v)[i] = Q[i][0] * before[0] + Q[i][1] * before[1] + Q[i][2] * before[2];                                        \
  } while (0)
  for (size_t k = 0; k < 21; k++)
    TURN(turned.at[k]);
  for (size_t k = 0; k < 22; k++) {
    TURN(turned.edge[k].t);
    TURN(turned.edge[k].normal);
    TURN(turned.edge[k].width);
  }
  const double energy = zp_space_energy(&rod.params, &rod.rod, rod.gradient);
  ck_near(zp_space_energy(&turned.params, &turned.rod, turned.gradient), energy, 1e-14);
  double largest = 0;
  for (size_t i = 0; i < rod_unknowns(&rod); i++)
    largest = fmax(largest, fabs(rod.gradient[i]));
  for (size_t k = 0; k < 21; k++) {
    double *force = rod.gradient + ZP_SPACE_OF_NODE * k;
    TURN(force);
    for (int c = 0; c < 3; c++)
      ck_below(fabs(force[c] - turned.gradient[ZP_SPACE_OF_NODE * k + (size_t)c]) / largest, 3e-15);
  }
#undef TURN
}

/* The gradient is the derivative of the energy, and the stiffness that of the gradient, both by random changes. */
TEST(stiffness_of_a_rod) {
  const ZpSpaceSection section = zp_space_section(E, poisson, thin, wide, true);
  double step[ROD_UNKNOWNS], back[ROD_UNKNOWNS], gradient[2][ROD_UNKNOWNS], energy[2], product = 0;
  rod_straight(&rod, 21, 0.05, &section, 1e3, (const bool[]){1, 0}, true, 1, 0);
  uint64_t seed = 5;
  rod_shake(&rod, 1e-4, &seed);
  const Rod at = rod;
  zp_space_energy(&rod.params, &rod.rod, rod.gradient);
  rod_stiffness(&rod);
  const double h = 1e-7;
  for (size_t i = 0; i < rod_unknowns(&rod); i++)
    step[i] = rod.fixed[i] ? 0 : h * noise(&seed) * (i % ZP_SPACE_OF_NODE == 3 ? 400 : 1);
  for (int side = 0; side < 2; side++) {
    memcpy(rod.at, at.at, sizeof rod.at);
    memcpy(rod.edge, at.edge, sizeof rod.edge);
    for (size_t i = 0; i < rod_unknowns(&rod); i++)
      back[i] = side ? step[i] : -step[i];
    rod_move(&rod, back);
    energy[side] = zp_space_energy(&rod.params, &rod.rod, gradient[side]);
  }
  double slope = 0, curve = 0;
  for (size_t i = 0; i < rod_unknowns(&rod); i++) {
    slope += rod.gradient[i] * step[i];
    curve += 0.5 * (gradient[1][i] - gradient[0][i]) * step[i];
    for (size_t a = 0; a < ROD_WIDE && i + a < rod_unknowns(&rod); a++)
      product += (a == 0 ? 1 : 2) * rod.K[i * ROD_WIDE + a] * step[i] * step[i + a];
  }
  ck_near(0.5 * (energy[1] - energy[0]), slope, 1.4e-7);
  ck_near(curve, product, 1.2e-6);
}
