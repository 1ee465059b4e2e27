/* Networks whose bodies move in the plane: derivatives of their forces, statics of levers and linkages, balance of
 * forces and torques, motion. docs/theory.md, section 34. */
#include "network_util.h"

#include "actuator/model.h"
#include "rest/statics.h"

static const char all_kinds[] =
    "study: stationary\nmesh.nodes: 13\n"
    "bodies:\n"
    "  base: {mass: 5 g, at: [0, -5 mm]}\n"
    "  arm: {moves: plane, mass: 9 g, inertia: 1e-6 kg m2, at: [10 mm, -30 mm], angle: 20 degree, force: [20 mN, 3 mN], "
    "torque: 0.3 mN m}\n"
    "  hand: {moves: plane, mass: 3 g, inertia: 1e-6 kg m2, at: [20 mm, -60 mm]}\n"
    "  crank: {moves: plane, mass: 1 g, inertia: 1e-6 kg m2, at: [90 mm, -20 mm]}\n"
    "  bob: {moves: plane, mass: 1 g, inertia: 1e-7 kg m2, at: [100 mm, -60 mm]}\n"
    "joints:\n"
    "  elbow: {type: pin, between: [base, arm], at: [60 mm, -30 mm]}\n"
    "  rail: {type: slide, between: [arm, crank], at: [80 mm, -15 mm]}\n"
    "  bond: {type: weld, between: [hand, bob], at: [60 mm, -60 mm]}\n"
    "springs:\n"
    "  soft: {between: [arm, crank], from_at: [1 mm, 2 mm], to_at: [-3 mm, 4 mm], stiffness: 5 N/m, rest: 60 mm}\n"
    "  rope: {between: [frame, bob], from_at: [100 mm, 0], to_at: [0 mm, 1 mm], stiffness: 5 N/m, rest: 40 mm, kind: pull}\n"
    "members:\n"
    "  lifts: {upper: frame, lower: base}\n"
    "  leans: {upper: base, lower: arm, upper_at: [5 mm, -2 mm], lower_at: [3 mm, 1 mm], angle: 10 degree}\n"
    "  hangs: {upper: arm, lower: hand, upper_at: [1 mm, -3 mm], lower_at: [2 mm, 2 mm], angle: 5 degree}\n";

/* Forces on bodies of about their weight, N. */
static double some(size_t i) {
  return 0.05 * sin(1.0 + 1.7 * (double)i);
}

/* The residual at a fraction of a step from a point that is kept. */
static void residual_at(ZpStatics *s, const void *kept, const double *step, double fraction, double *r) {
  ZpStaticSystem system = zp_statics_system(s);
  zp_statics_branch(s, ZP_ALONG_LOAD).restore(s, kept);
  system.residual(s, r, NULL);
  system.move(s, step, fraction);
  system.residual(s, r, NULL);
}

/* Forces on bodies move all by K^-1 times them; residuals change by as much. So also what is soft counts: along a
 * direction of one's own choice the stiffness of edges and joints would hide it. */
TEST(stiffness_is_the_derivative_of_forces) {
  static const double fraction = 1e-4;
  ZpActuatorDef def = def_of(all_kinds);
  ZpModel *model;
  ZpStatics s;
  ck_ok(zp_model_create(&def, &model, &err));
  ck_assert(zp_statics_create(model, false, &s));
  ck_assert(zp_newton_good(zp_statics_find_rest(&s).end));
  const size_t n = s.n, size = s.n * sizeof(double);
  double *u = calloc(n, sizeof *u), *one = malloc(size), *other = malloc(size);
  char *kept = malloc(zp_statics_branch(&s, ZP_ALONG_LOAD).save_size);
  ck_assert(zp_statics_stable(&s));
  for (size_t i = s.form.inner; i < n; i++)
    u[i] = some(i - s.form.inner);
  zp_arrow_solve(&s.newton.K, u);
  zp_statics_branch(&s, ZP_ALONG_LOAD).save(&s, kept);
  residual_at(&s, kept, u, -fraction, one);
  residual_at(&s, kept, u, fraction, other);
  double off = 0;
  for (size_t i = 0; i < n; i++) {
    const double by = (one[i] - other[i]) / (2 * fraction), is = i < s.form.inner ? 0 : some(i - s.form.inner);
    off = fmax(off, fabs(by - is));
    if (i >= s.form.inner) printf("%zu: %.9g %.9g\n", i - s.form.inner, by, is);
  }
  printf("off by %.2g of %.2g N\n", off, some(0));
  zp_statics_destroy(&s);
  zp_model_destroy(model);
}
