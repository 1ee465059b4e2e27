/* The two-dimensional field: the finite-element grid by itself, then the cross-section of the actuator.
 *
 * Against: plane and coaxial capacitors in closed form (order of convergence), energies' central differences,
 * thin strips with fringing from conformal mapping, the plates law on wedges, traction against virtual work, and the
 * same solution with other meshes. */
#include "state_util.h"

#include "base/kernel.h"
#include "electro/field.h"
#include "electro/field_correction.h"
#include "system/system.h"

/* -- the grid ------------------------------------------------------------------------------------- */

/* Quarter of a ring, radii 1 to `outer`, between thin conductors at 0 and 1 V; each node moved by `bump`. */
static void make_ring(ZpGrid *g, size_t n, double outer) {
  ck_assert(zp_grid_create(g, n, n + 2));
  for (size_t i = 0; i < g->nx; i++)
    for (size_t j = 0; j < g->ny; j++) {
      double angle = 1.5707963267948966 * (1 - (double)i / (double)(g->nx - 1));
      double inside = ((double)j - 2) / (double)(2 * n), radius = 1 + (outer - 1) * inside;
      g->x[i * g->ny + j] = radius * cos(angle);
      g->y[i * g->ny + j] = radius * sin(angle);
      g->phi[i * g->ny + j] = 2 * j > g->ny;
    }
  for (size_t c = 0; c < n; c++)
    for (size_t r = 1; r <= n; r++)
      g->eps[c * g->rows + r] = 2;
  ck_assert(zp_grid_number(g));
}

TEST(test_ring_converges_with_the_fourth_power) {
  const double exact = 0.5 * 2 * ZP_EPS0 * 1.5707963267948966 / log(3);
  double error[3];
  for (int k = 0; k < 3; k++) {
    ZpGrid g;
    make_ring(&g, (size_t)8 << k, 3);
    ck_assert_int_eq(zp_grid_solve(&g), ZP_GRID_SOLVED);
    error[k] = fabs(zp_grid_energy(&g) / exact - 1);
    zp_grid_destroy(&g);
  }
  printf("ring: energy off by %.2g %.2g %.2g\n", error[0], error[1], error[2]);
  ck_assert_double_gt(error[0] / error[1], 12);
  ck_assert_double_gt(error[1] / error[2], 12);
  ck_below(error[2], 5e-8); /* 6.9e-9 measured */
}

/* The force on every node is the derivative of the energy, free nodes included: there it says that the solution is
 * the stationary one. */
TEST(test_node_forces_are_the_gradient) {
  ZpGrid g;
  make_ring(&g, 4, 2.5);
  ck_assert_int_eq(zp_grid_solve(&g), ZP_GRID_SOLVED);
  zp_grid_forces(&g, 0, g.columns);
  size_t count = g.nx * g.ny;
  double *Fx = memory_of(2 * count * sizeof *Fx), *Fy = Fx + count, largest = 0;
  memcpy(Fx, g.Fx, count * sizeof *Fx);
  memcpy(Fy, g.Fy, count * sizeof *Fy);
  for (size_t k = 0; k < count; k++)
    largest = fmax(largest, hypot(Fx[k], Fy[k]));
  for (size_t k = 2; k < count; k += 7)
    for (int axis = 0; axis < 2; axis++) {
      double *at = axis ? g.y : g.x, here = at[k], h = 1e-5, energy[2];
      for (int side = 0; side < 2; side++) {
        at[k] = here + (side ? h : -h);
        ck_assert_int_eq(zp_grid_solve(&g), ZP_GRID_SOLVED);
        energy[side] = zp_grid_energy(&g);
      }
      at[k] = here;
      ck_assert_double_eq_tol((energy[1] - energy[0]) / (2 * h), axis ? Fy[k] : Fx[k], 1e-7 * largest);
    }
  zp_grid_destroy(&g);
}

TEST(test_folded_grid_is_refused) {
  ZpGrid g;
  make_ring(&g, 4, 2.5);
  g.x[4 * g.ny + 6] += 1;
  ck_assert_int_eq(zp_grid_solve(&g), ZP_GRID_FOLDED);
  zp_grid_destroy(&g);
}

/* -- the cross-section ---------------------------------------------------------------------------- */

static const double L = 45e-3;
enum { STATIONS = 121 };

static ZpFieldParams wedge_params(void) {
  return (ZpFieldParams){.stations = STATIONS,
                         .columns = 1,
                         .w = 12.7e-3,
                         .b = 100e-6,
                         .t = 130e-6,
                         .eps_m = 2.75,
                         .eps_out = 2.75,
                         .eps_i = 4.62,
                         .clip = 5e-3,
                         .platform = 5e-3,
                         .electrode = true,
                         .mesh = zp_field_mesh(1)};
}

static ZpFieldParams refined(ZpFieldParams p, size_t by) {
  ZpFieldMesh *m = &p.mesh;
  size_t *parts[] = {&m->gap, &m->insulator, &m->strip, &m->clip, &m->platform, &m->outside};
  for (size_t k = 0; k < sizeof parts / sizeof parts[0]; k++)
    *parts[k] *= by;
  m->first /= (double)by;
  p.stations = (p.stations - 1) * by + 1;
  return p;
}

typedef struct Wedge {
  double place[4 * 8 * STATIONS];
  ZpContact faces;
} Wedge;

static double cubic(double xi) {
  return xi * xi * (3 - 2 * xi);
}

/* gap = s (3 xi^2 - 2 xi^3), shared alike, or all of it below a straight upper ribbon. */
static void make_wedge(Wedge *wedge, size_t stations, double s, double upper_share) {
  double *x = wedge->place, *up = x + stations, *low = up + stations;
  for (size_t i = 0; i < stations; i++) {
    double xi = (double)i / (double)(stations - 1);
    x[i] = L * xi;
    up[i] = upper_share * s * cubic(xi);
    low[i] = (upper_share - 1) * s * cubic(xi);
  }
  wedge->faces = (ZpContact){x, up, x, low, 1};
}

/* Attraction of the wedge by the plates law at 1 V, weighted by 1 or by how the gap opens. */
static double plates_force(const ZpFieldParams *p, double s, bool by_opening) {
  enum { PIECES = 20000 };
  double d = 2 * p->t * p->eps_m / p->eps_i, k = 0.5 * ZP_EPS0 * p->eps_m * p->w, sum = 0;
  for (int i = 0; i < PIECES; i++) {
    double open = cubic((i + 0.5) / PIECES), h = s * open + d;
    sum += (by_opening ? open : 1) * k / (h * h) * L / PIECES;
  }
  return sum;
}

static const double openings[] = {1e-3, 2e-3, 4e-3, 17e-3};

/* The plates law against the field: total force on wedges that open to 1, 2, 4, 17 mm. An independent finite-element
 * study (126 000 unknowns) has 1.0000, 1.0000, 1.0001, 1.0008, and 1.0001 to 1.004 where one ribbon stays straight. */
TEST(test_wedges_against_the_plates_law) {
  static const double theirs[] = {1.0000, 1.0000, 1.0001, 1.0008}, apart[] = {1e-4, 1e-4, 1e-4, 4e-4};
  ZpFieldParams p = wedge_params();
  ZpField f;
  Wedge wedge;
  ck_assert(zp_field_create(&p, &f));
  for (int k = 0; k < 4; k++)
    for (int straight = 0; straight < 2; straight++) {
      make_wedge(&wedge, p.stations, openings[k], straight ? 0 : 0.5);
      ck_assert_int_eq(zp_field_solve(&f, &wedge.faces), ZP_FIELD_SOLVED);
      zp_field_profile(&f);
      ZpFieldTotals totals = zp_field_totals(&f);
      double plates = plates_force(&p, openings[k], false), ratio = totals.lower / plates;
      double work = totals.lower_work / (totals.lower + totals.lower_platform);
      printf("wedge of %g mm%s: field over plates %.5f, virtual work over traction - 1 = %.1e\n", 1e3 * openings[k],
             straight ? ", one ribbon straight" : "", ratio, work - 1);
      if (straight)
        ck_assert(ratio > 1 && ratio < 1.004);
      else
        ck_assert_double_eq_tol(ratio, theirs[k], apart[k]);        /* measured: 2e-5, 1e-5, 6e-5, 3e-4 */
      ck_near(work, 1, 2e-4);                                       /* 1e-5 to 1.7e-4; asked for: 1e-3 */
      ck_near(totals.upper, totals.lower, straight ? 1e-4 : 1e-12); /* 7.7e-5 and 2e-15 measured */
    }
  zp_field_destroy(&f);
}

/* Turned over, the straight ribbon of a wedge is the other one: fields along the faces stay, in liquid and insulators,
 * and tractions change their places. */
TEST(test_a_wedge_turned_over) {
  enum { N = 21, MOST = 400 };
  ZpFieldParams p = wedge_params();
  p.stations = N;
  p.columns = 4;
  ZpField f;
  Wedge wedge;
  ZpFieldProfile first[MOST];
  double apart = 0, differ = 0;
  ck_assert(zp_field_create(&p, &f));
  ck_assert_uint_le(f.profiles, MOST);
  for (int turned = 0; turned < 2; turned++) {
    make_wedge(&wedge, N, 17e-3, turned);
    ck_assert_int_eq(zp_field_solve(&f, &wedge.faces), ZP_FIELD_SOLVED);
    zp_field_profile(&f);
    for (size_t k = 0; k < f.profiles && turned; k++) {
      const ZpFieldProfile *a = &first[k], *b = &f.profile[k];
      apart = fmax(apart, fabs(a->E / b->E - 1));
      apart = fmax(apart, fabs(a->E_insulator / b->E_insulator - 1));
      apart = fmax(apart, fabs(a->upper / b->lower - 1));
      differ = fmax(differ, fabs(a->upper / a->lower - 1));
    }
    memcpy(first, f.profile, f.profiles * sizeof *first);
  }
  ck_below(apart, 1e-11);
  ck_assert_double_gt(differ, 1e-2);
  zp_field_destroy(&f);
}

/* Default grid against one twice as fine, and the order of the difference: the generalised force of opening is the
 * variational quantity and converges with the fourth power, traction with the second. */
NIGHTLY_TESTS(test_wedge_converges_with_the_mesh, 0, FULL_OR(1, 0)) {
  double force[3], traction[3];
  for (size_t k = 0; k < 3; k++) {
    ZpFieldParams p = wedge_params();
    p.stations = 61;
    p = refined(p, (size_t)1 << k);
    ZpField f;
    Wedge wedge;
    ck_assert(zp_field_create(&p, &f));
    make_wedge(&wedge, p.stations, 2e-3, 0.5);
    ck_assert_int_eq(zp_field_solve(&f, &wedge.faces), ZP_FIELD_SOLVED);
    zp_field_profile(&f);
    traction[k] = zp_field_totals(&f).lower;
    ck_assert_int_eq(zp_field_solve(&f, &wedge.faces), ZP_FIELD_SOLVED);
    force[k] = 0;
    for (size_t i = 0; i < p.stations; i++)
      force[k] += 0.5 * cubic((double)i / (double)(p.stations - 1)) * (f.Fy[2 * i + 1] - f.Fy[2 * i]);
    zp_field_destroy(&f);
  }
  printf("2 mm wedge, mesh halved: force changes by %.1e, %.1e, traction by %.1e, %.1e\n", force[1] / force[0] - 1,
         force[2] / force[1] - 1, traction[1] / traction[0] - 1, traction[2] / traction[1] - 1);
  ck_near(force[1], force[2], 1e-7); /* 2.5e-8 measured */
  ck_assert_double_gt(fabs((force[1] - force[0]) / (force[2] - force[1])), 8);
  ck_assert_double_gt(fabs((traction[1] - traction[0]) / (traction[2] - traction[1])), 3);
}

/* Two thin strips of width w side by side at distance d in vacuum: capacitance per length over eps0 by conformal
 * mapping. Half of the pair, cut in the middle. */
TEST(test_thin_strips_with_fringing) {
  static const double w_over_d[] = {1, 10}, exact[] = {2.11578, 11.68131};
  for (int k = 0; k < 2; k++) {
    double w = 10e-3, d = w / w_over_d[k], t = d / 50;
    ZpFieldParams p = {
        .stations = 3, .columns = 2, .w = 1, .b = 1e-6, .t = t, .eps_m = 1, .eps_i = 1, .eps_out = 1, .clip = 4e-3};
    p.mesh = (ZpFieldMesh){.gap = 6, .insulator = 2, .strip = 1, .clip = 12, .platform = 1, .outside = 16, .size = 1};
    p.mesh.first = 1e-5;
    double x[] = {0, 0.5e-3, 1e-3}, up[] = {0.5 * d - t, 0.5 * d - t, 0.5 * d - t}, low[] = {-up[0], -up[0], -up[0]};
    ZpField f;
    ck_assert(zp_field_create(&p, &f));
    ck_assert_int_eq(zp_field_solve(&f, &(ZpContact){x, up, x, low, 1}), ZP_FIELD_SOLVED);
    double C = 4 * zp_grid_energy(&f.grid) / ZP_EPS0;
    printf("thin strips, w/d = %g: C/eps0 = %.5f (%.5f)\n", w_over_d[k], C, exact[k]);
    ck_near(C, exact[k], 2e-3); /* 1.6e-3, 6e-4; twice as fine 3e-4, 1e-4: the edges are singular */
    zp_field_destroy(&f);
  }
}

/* A shape that nothing makes easy: both ribbons bent, their stations apart in x, one pair overlaps by so much. */
static void make_uneven(double *q, size_t nodes, double overlap) {
  double *x = q, *y = q + 2 * nodes;
  for (size_t i = 0; i < nodes; i++) {
    double xi = (double)i / (double)(nodes - 1), gap = 3e-3 * cubic(xi) * (1 + 0.2 * sin(9 * xi));
    x[2 * i] = L * xi - 2e-4 * sin(5 * xi);
    x[2 * i + 1] = L * xi - 3e-4 * xi;
    y[2 * i + 1] = -1e-3 * xi * xi - 0.6 * gap;
    y[2 * i] = y[2 * i + 1] + (i == 1 ? -overlap : gap);
  }
}

/* How coordinate j moves: the clip's nodes together, the platform's at their x. */
static double direction(size_t j, size_t nodes) {
  if (j % (2 * nodes) < 2) return 1;
  return j >= 2 * nodes || j < 2 * nodes - 2 ? cos(3.0 * (double)j) : 0;
}

TEST(test_station_forces_are_the_gradient) {
  enum { N = 21 };
  ZpFieldParams p = wedge_params();
  p.stations = N;
  p.columns = 4;
  ZpField f;
  ck_assert(zp_field_create(&p, &f));
  double q[4 * N], moved[4 * N], energy[2], h = 1e-9, work = 0, scale = 0;
  make_uneven(q, N, 0);
  q[2 * N + 2] += 2e-6; /* off the corner at no gap */
  for (int side = 0; side < 3; side++) {
    double step = side == 2 ? 0 : side ? h : -h;
    for (size_t j = 0; j < 4 * N; j++)
      moved[j] = q[j] + step * direction(j, N);
    ck_assert_int_eq(zp_field_solve(&f, &(ZpContact){moved, moved + 2 * N, moved + 1, moved + 2 * N + 1, 2}),
                     ZP_FIELD_SOLVED);
    if (side < 2) energy[side] = f.energy;
  }
  for (size_t j = 0; j < 4 * N; j++) {
    double part = (j < 2 * N ? f.Fx[j] : f.Fy[j - 2 * N]) * direction(j, N);
    work += part;
    scale += fabs(part);
  }
  ck_assert_double_eq_tol((energy[1] - energy[0]) / (2 * h), work, 1e-7 * scale);
  zp_field_destroy(&f);
}

/* Liquid in a part of the gap: between bare flat plates the field is uniform in liquid and air, and the energy is
 * linear in the wet length. */
TEST(test_energy_goes_with_the_wet_length) {
  enum { N = 61 };
  const double gap = 1e-3, eps_m = 2.75;
  ZpFieldParams p = wedge_params();
  p.stations = N;
  p.columns = 2;
  p.t = 0;
  p.eps_out = 1;
  ZpField f;
  ck_assert(zp_field_create(&p, &f));
  double x[N], up[N], low[N], part[N - 1], energy[2];
  for (size_t i = 0; i < N; i++) {
    x[i] = L * (double)i / (N - 1);
    up[i] = 0.5 * gap;
    low[i] = -up[i];
  }
  for (int k = 0; k < 2; k++) {
    ZpCover cover = {part, {0, 0}};
    for (int i = 0; i < N - 1; i++)
      part[i] = i < (k ? 40 : 20) || (i == (k ? 40 : 20) && k); /* by whole elements: 41 and 20 of 60 */
    zp_field_cover(&f, &cover);
    ck_assert_int_eq(zp_field_solve(&f, &(ZpContact){x, up, x, low, 1}), ZP_FIELD_SOLVED);
    energy[k] = f.energy;
  }
  /* 3e-11 measured */
  ck_near(energy[1] - energy[0], 0.5 * ZP_EPS0 * (eps_m - 1) * p.w * (21.0 / (N - 1)) * L / gap, 3e-10);
  zp_field_destroy(&f);
}

/* A bead that reaches as far as there are faces, in a liquid that lies around them as well, is no bead. */
TEST(test_a_bead_without_end_is_liquid_everywhere) {
  enum { N = 21 };
  ZpFieldParams p = wedge_params();
  p.stations = N;
  p.columns = 4;
  ZpField f;
  Wedge wedge;
  double part[N - 1], energy[2];
  ck_assert(zp_field_create(&p, &f));
  make_wedge(&wedge, N, 4e-3, 0.5);
  for (int k = 0; k < N - 1; k++)
    part[k] = 1;
  for (int k = 0; k < 2; k++) {
    if (k) zp_field_cover(&f, &(ZpCover){part, {1, 1}});
    ck_assert_int_eq(zp_field_solve(&f, &wedge.faces), ZP_FIELD_SOLVED);
    energy[k] = f.energy;
  }
  ck_assert_double_eq(energy[0], energy[1]);
  zp_field_destroy(&f);
}

/* Where no bead is left, air is everywhere: between the faces, behind the strips and around them. Only the clip stays
 * wet between its insulators. */
TEST(test_a_bead_of_no_length_is_air_everywhere) {
  enum { N = 21 };
  ZpFieldParams p = wedge_params();
  p.stations = N;
  p.columns = 4;
  p.eps_out = 1;
  Wedge wedge;
  double none[N - 1] = {0}, energy[2];
  make_wedge(&wedge, N, 4e-3, 0.5);
  for (int k = 0; k < 2; k++) {
    ZpField f;
    if (k) p.eps_m = 1;
    ck_assert(zp_field_create(&p, &f));
    if (!k) zp_field_cover(&f, &(ZpCover){none, {0, 0}});
    ck_assert_int_eq(zp_field_solve(&f, &wedge.faces), ZP_FIELD_SOLVED);
    energy[k] = f.energy;
    zp_field_destroy(&f);
  }
  ck_near(energy[0], energy[1], 6e-7); /* 2.1e-7 measured */
}

/* Its difference from the plates law, also with the cap, for a shape that is partly capped and in which one pair
 * overlaps; the charge is the derivative with respect to the voltage. The same with a bead that ends in an element,
 * where no air breaks down. */
TESTS(test_surplus_is_the_gradient, 0, 2) {
  enum { N = 21 };
  const ZpLiquidModel liquid = _i ? ZP_LIQUID_BEAD : ZP_LIQUID_NONE;
  ZpActuatorDef def = DEF({"electro.model", ZP_ELECTRO_FIELD}, {"mesh.nodes", N}, {"liquid.model", liquid});
  ZpModel *model = model_of(&def);
  double part[N - 1];
  for (int i = 0; i < N - 1; i++)
    part[i] = i < 8 ? 1 : i == 8 ? 0.7 : 0;
  const ZpCover half = {part, {0, 0}}, *cover = _i ? &half : NULL;
  ZpFieldCorrection s;
  ck_assert(zp_field_correction_create(&model->cross_section, &model->plates, model->field_scale, &s));
  double uneven[4 * N], energy[2], U = _i ? 10 : 6e3, h = 1e-9, work = 0, scale = 0;
  size_t stride = model->stride;
  double *moved = memory_of(2 * stride * sizeof *moved);
  make_uneven(uneven, N, _i ? -2e-4 : 1e-6); /* its stations lie apart in x: a closed pair needs the cap */
  for (int side = 0; side < 3; side++) {
    double step = side == 2 ? 0 : side ? h : -h;
    for (size_t j = 0; j < 4 * N; j++)
      moved[j < 2 * N ? j : j - 2 * N + stride] = uneven[j] + step * direction(j, N);
    ck_assert_int_eq(zp_field_correction_solve(&s, moved, U, cover), ZP_FIELD_SOLVED);
    if (side < 2) energy[side] = s.energy;
  }
  for (size_t j = 0; j < 4 * N; j++) {
    double part = s.F[j < 2 * N ? j : j - 2 * N + stride] * direction(j, N);
    work += part;
    scale += fabs(part);
  }
  ck_assert_double_eq_tol((energy[1] - energy[0]) / (2 * h), work, 1e-5 * scale);
  double charge = s.charge * U, dU = 1e-2, co_energy[2];
  for (int side = 0; side < 2; side++) {
    double at = U + (side ? dU : -dU);
    ck_assert_int_eq(zp_field_correction_solve(&s, moved, at, cover), ZP_FIELD_SOLVED);
    co_energy[side] = s.energy * at * at;
  }
  ck_near((co_energy[1] - co_energy[0]) / (2 * dU), charge, 5e-8); /* 1.3e-8 measured */
  zp_field_correction_destroy(&s);
}

/* The far boundary does not matter: number and grading of the outer elements have no effect. */
TEST(test_outside_does_not_matter) {
  double force[2];
  for (int k = 0; k < 2; k++) {
    ZpFieldParams p = wedge_params();
    if (k) {
      p.mesh.outside *= 2;
      p.mesh.first *= 0.5;
    }
    ZpField f;
    Wedge wedge;
    ck_assert(zp_field_create(&p, &f));
    make_wedge(&wedge, p.stations, 4e-3, 0.5);
    ck_assert_int_eq(zp_field_solve(&f, &wedge.faces), ZP_FIELD_SOLVED);
    zp_field_profile(&f);
    force[k] = zp_field_totals(&f).lower;
    zp_field_destroy(&f);
  }
  ck_near(force[1], force[0], 1e-6); /* 2.7e-7 measured */
}

/* Without electrodes the platform is not attracted, and the ribbons feel the edge that they then have. */
TEST(test_platform_without_electrode) {
  ZpFieldParams p = wedge_params();
  p.electrode = false;
  ZpField f;
  Wedge wedge;
  ck_assert(zp_field_create(&p, &f));
  make_wedge(&wedge, p.stations, 2e-3, 0.5);
  ck_assert_int_eq(zp_field_solve(&f, &wedge.faces), ZP_FIELD_SOLVED);
  double bare = 2 * f.energy;
  zp_field_destroy(&f);
  p.electrode = true;
  ck_assert(zp_field_create(&p, &f));
  ck_assert_int_eq(zp_field_solve(&f, &wedge.faces), ZP_FIELD_SOLVED);
  double plates = ZP_EPS0 * p.eps_m * p.w * p.platform / (2e-3 + 2 * p.t * p.eps_m / p.eps_i);
  ck_assert_double_gt(2 * f.energy - bare, 0.4 * plates); /* less than all: the edge has a field of its own */
  ck_assert_double_lt(2 * f.energy - bare, plates);
  zp_field_destroy(&f);
}

TEST(test_bad_geometry_has_a_reason) {
  ZpFieldParams p = wedge_params();
  Wedge wedge;
  make_wedge(&wedge, p.stations, 2e-3, 0.5);
  ck_assert_int_eq(zp_field_check(&p, &wedge.faces), ZP_FIELD_SOLVED);
  p.t = 0;
  ck_assert_int_eq(zp_field_check(&p, &wedge.faces), ZP_FIELD_BARE);
  p.t = 130e-6;
  wedge.place[STATIONS + 50] -= 2e-3;
  ck_assert_int_eq(zp_field_check(&p, &wedge.faces), ZP_FIELD_CROSSING);
  wedge.place[STATIONS + 50] = NAN;
  ck_assert_int_eq(zp_field_check(&p, &wedge.faces), ZP_FIELD_CROSSING);
  make_wedge(&wedge, p.stations, 2e-3, 0.5);
  wedge.place[50] = wedge.place[49];
  ck_assert_int_eq(zp_field_check(&p, &wedge.faces), ZP_FIELD_FOLDED);
  ck_assert_str_eq(zp_field_words(ZP_FIELD_CROSSING), "the faces pass through each other");
  ZpField f;
  ck_assert(zp_field_create(&p, &f));
  ck_assert_int_eq(zp_field_solve(&f, &wedge.faces), ZP_FIELD_FOLDED);
  zp_field_destroy(&f);
}

/* -- as a model of the actuator ------------------------------------------------------------------- */

/* Plates with what the field has beyond them is the field: total force of a wedge; and at a capped gap it is what
 * the plates law says, since there the field is that of closed plates. */
TEST(test_surplus_makes_plates_the_field) {
  ZpActuatorDef def = DEF({"electro.model", ZP_ELECTRO_FIELD}, {"ribbon.thickness", 100e-6}, {"mesh.nodes", 121},
                          {"electro.breakdown_cap", 0});
  ZpModel *model = model_of(&def);
  ZpEval eval;
  ck_assert(zp_system_create(model, true, &eval));
  double *q = memory_of(2 * model->stride * sizeof *q);
  for (size_t i = 0; i < model->nodes; i++) {
    double xi = (double)i / (double)(model->nodes - 1);
    q[2 * i] = q[2 * i + 1] = L * xi;
    q[model->stride + 2 * i] = 1e-3 * cubic(xi);
    q[model->stride + 2 * i + 1] = -1e-3 * cubic(xi);
  }
  ck_assert(zp_system_solve(model, q, 6e3, &eval));
  ck_assert(zp_system_solve(model, q, 5e3, &eval));
  ck_assert_int_eq(eval.correction.solutions, 1); /* without cap it does not depend on the voltage */
  double beyond = 0;
  for (size_t i = 0; i < model->nodes; i++)
    beyond += eval.correction.F[model->stride + 2 * i + 1];
  printf("beyond plates: %.1e of the force on the 2 mm wedge\n",
         beyond / plates_force(&model->cross_section, 2e-3, false));
  ck_below(fabs(beyond), 1e-4 * plates_force(&model->cross_section, 2e-3, false));
  zp_system_destroy(&eval);
}

static double value(ZpStudy which, ZpActuatorDef def, const char *name) {
  return answered_value(which, &def, name);
}

/* Plates law and field give the same pull-in, release, holding force and zip. */
NIGHTLY_TEST(test_studies_by_field_and_by_plates) {
  ZpActuatorDef field = DEF({"electro.model", ZP_ELECTRO_FIELD}, {"mesh.nodes", 31}), plates = DEF({"mesh.nodes", 31});
  ZpResult *by_field = answer_of(ZP_STUDY_EQUILIBRIUM, &field), *by_plates = answer_of(ZP_STUDY_EQUILIBRIUM, &plates);
  static const char *const names[] = {"pull_in_voltage_V", "release_voltage_V"};
  for (int k = 0; k < 2; k++) {
    double a = zp_result_get(by_field, names[k]), b = zp_result_get(by_plates, names[k]);
    printf("%s: field %.1f, plates %.1f\n", names[k], a, b);
    ck_near(a, b, 2e-3); /* 0.14 % and less than 0.001 % */
    ck_assert_double_ne(a, b);
  }
  field.drive.voltage = plates.drive.voltage = 6e3;
  double held = value(ZP_STUDY_ISOMETRIC, field, "force_N");
  ck_near(held, value(ZP_STUDY_ISOMETRIC, plates, "force_N"), 1e-3); /* 2.4e-4 measured */
  ck_assert_double_ne(held, value(ZP_STUDY_ISOMETRIC, plates, "force_N"));
}

/* The same with a bead: equal liquid and air in both models. */
NIGHTLY_TESTS(test_bead_by_field_and_by_plates, 0, FULL_OR(1, 0)) {
  ZpActuatorDef plates = DEF({"liquid.model", ZP_LIQUID_BEAD}, {"bead.volume", 50e-9}, {"mesh.nodes", 31},
                             {"solver.stop_when_zipped", ZP_WHEN_TRUE}),
                field = plates;
  field.electro.model = ZP_ELECTRO_FIELD;
  double closing[2] = {value(ZP_STUDY_ACTUATE, plates, "zip_time_s"), value(ZP_STUDY_ACTUATE, field, "zip_time_s")};
  plates.drive.voltage = field.drive.voltage = 6e3;
  double held[2] = {value(ZP_STUDY_ISOMETRIC, plates, "force_N"), value(ZP_STUDY_ISOMETRIC, field, "force_N")};
  printf("bead: zip %.2f, by the field %.2f ms; held with %.6f, %.6f N\n", closing[0] * 1e3, closing[1] * 1e3, held[0],
         held[1]);
  ck_near(closing[1], closing[0], 0.01); /* 0.3 % */
  ck_near(held[1], held[0], 3e-4);       /* 8.6e-5 measured */
  ck_assert_double_ne(held[1], held[0]);
}

/* Without the cap closed faces lie where both laws have constant gaps; Newton once went to and fro there. Nor may
 * force_scale change a capacitance. */
NIGHTLY_TEST(test_held_without_cap) {
  ZpActuatorDef field = DEF({"electro.model", ZP_ELECTRO_FIELD}, {"electro.breakdown_cap", 0}, {"drive.voltage", 5e3});
  ZpActuatorDef plates = field;
  plates.electro.model = ZP_ELECTRO_PLATES;
  double held = value(ZP_STUDY_ISOMETRIC, field, "force_N");
  printf("held at 2 mm, 5 kV, no cap: field %.6f N, plates %.6f N\n", held,
         value(ZP_STUDY_ISOMETRIC, plates, "force_N"));
  ck_near(held, value(ZP_STUDY_ISOMETRIC, plates, "force_N"), 1e-3); /* 4.3e-4 measured */
  field.drive.voltage = 1;
  field.isometric.separation = 4e-3;
  double C = value(ZP_STUDY_ISOMETRIC, field, "capacitance_F");
  field.electro.force_scale = 4;
  ck_near(value(ZP_STUDY_ISOMETRIC, field, "capacitance_F"), C, 1e-6); /* 1.8e-7 measured */
}

/* The number of field solutions in motion has little effect: the held difference is small. */
NIGHTLY_TEST(test_refresh_in_motion) {
  ZpActuatorDef def =
      DEF({"electro.model", ZP_ELECTRO_FIELD}, {"mesh.nodes", 21}, {"solver.stop_when_zipped", ZP_WHEN_TRUE});
  double coarse, fine;
  ZpResult *result = answer_of(ZP_STUDY_ACTUATE, &def);
  coarse = zp_result_get(result, "zip_time_s");
  ck_below(zp_result_get(result, "energy_error"), 1e-3); /* 4.3e-4 measured */
  def.electro.refresh_change = 0.02;
  fine = value(ZP_STUDY_ACTUATE, def, "zip_time_s");
  printf("zip time: refreshed at changes of 0.1 and 0.02: %.6g, %.6g ms\n", 1e3 * coarse, 1e3 * fine);
  ck_near(coarse, fine, 6e-5); /* 2e-5 measured */
}

/* What a simulation holds is the solution at the place and voltage where the field was solved last. */
static void check_held(ZpSim *sim) {
  const ZpModel *model = sim->model;
  const ZpState *state = sim->state;
  ZpEval e;
  ck_assert(zp_system_create(model, true, &e));
  zp_eval_cover(model, (const double[ZP_BEADS]){state->bead[0].reach, state->bead[1].reach}, &e);
  ck_assert(zp_system_solve(model, zp_state_held_at(model, sim->state), state->held_U, &e));
  ck_assert(memcmp(zp_state_held(model, sim->state), e.correction.F, 2 * model->stride * sizeof(double)) == 0);
  ck_assert_double_eq(state->held_charge, e.correction.charge);
  ck_assert_double_eq(state->held_energy, e.correction.energy);
  ck_assert_double_eq(state->held_capacitance, e.correction.capacitance);
  for (size_t i = 0; i + 1 < model->nodes && model->has_bead; i++) /* liquid by whole elements, then air */
    ck_assert_double_eq(e.correction.cover.part[i], (double)i + 0.5 < state->bead[0].reach / model->l);
  zp_system_destroy(&e);
}

/* A field that is held while the gaps change by a tenth, and one that is solved afresh at every step: the same motion,
 * dry and with a bead, where it adds more than 2 % to the charge. */
TESTS(test_held_field_is_that_of_every_step, 0, 2) {
  static const struct {
    const char *name;
    double within;
  } signal[] = {{"opening", 2e-6}, {"charge", 7e-4}, {"capacitance", 3e-4}, {"field_energy", 1.5e-3}};
  double held[LENGTH_OF(signal)];
  for (int afresh = 0; afresh < 2; afresh++) {
    ZpActuatorDef def =
        DEF({"electro.model", ZP_ELECTRO_FIELD}, {"mesh.nodes", 9}, {"ribbon.length", 40e-3}, {"platform.length", 4e-3},
            {"ribbon.thickness", 40e-6}, {"drive.waveform", ZP_WAVEFORM_RAMP}, {"drive.rise_time", 4e-3},
            {"drive.voltage", 8e3}, {"liquid.model", _i ? ZP_LIQUID_BEAD : ZP_LIQUID_NONE}, {"bead.volume", 20e-9},
            {"electro.refresh_change", afresh ? 1e-6 : 0.1}, {"solver.time_step", 2e-4});
    ZpModel *model = model_of(&def);
    ZpSim *sim = sim_of(model);
    ck_assert(zp_outcome_good(zp_sim_run(sim, 4e-3, false, NULL, NULL)));
    check_held(sim);
    ZpEval unaware; /* of where the liquid is */
    ck_assert(zp_system_create(model, true, &unaware));
    ck_assert_int_eq(zp_cached_field_refresh(model, sim->state, &unaware), ZP_END_FOUND);
    zp_system_destroy(&unaware);
    check_held(sim);
    for (size_t k = 0; k < LENGTH_OF(signal) && afresh; k++)
      ck_near(held[k], zp_sim_get(sim, signal[k].name), signal[k].within); /* 1e-4 measured where 3e-4 is allowed */
    for (size_t k = 0; k < LENGTH_OF(signal); k++)
      held[k] = zp_sim_get(sim, signal[k].name);
    ck_assert_double_gt(sim->state->U * sim->state->held_charge * model->parts, 0.02 * zp_sim_get(sim, "charge"));
  }
}

/* At rest without the cap the charge is linear in the voltage: the held surplus of charge is that of the capacitance.
 */
TEST(test_charge_at_rest_is_capacitance_times_voltage) {
  ZpActuatorDef def =
      DEF({"electro.model", ZP_ELECTRO_FIELD}, {"electro.breakdown_cap", 0}, {"mesh.nodes", 9},
          {"ribbon.length", 40e-3}, {"platform.length", 4e-3}, {"isometric.separation", 4e-3}, {"drive.voltage", 100});
  ZpResult *result = answer_of(ZP_STUDY_ISOMETRIC, &def);
  ck_near(zp_result_get(result, "charge_C"), def.drive.voltage * zp_result_get(result, "capacitance_F"),
          1e-12); /* 4.4e-16 measured */
}

TEST(test_what_does_not_go_with_field) {
  static const struct {
    Setting bad;
    ZpStudy study;
  } of[] = {{{"actuator.kind", ZP_KIND_FLANGE}, ZP_STUDY_STATIONARY},
            {{"electro.surface", ZP_SURFACE_BEZIER}, ZP_STUDY_STATIONARY},
            {{"insulator.thickness", 0}, ZP_STUDY_STATIONARY},
            {{"modes.voltage", 1e3}, ZP_STUDY_MODES}};
  for (size_t k = 0; k < LENGTH_OF(of); k++) {
    ZpActuatorDef def = DEF({"electro.model", ZP_ELECTRO_FIELD}, of[k].bad);
    ZpError err = {ZP_OK, ""};
    ck_assert_int_eq(zp_study_check(of[k].study, &def, &err), ZP_BAD_INPUT);
    ck_assert_msg(strstr(err.message, "field") && strstr(err.message, of[k].bad.key), "%s", err.message);
  }
}
