/* Letters as in film.h; 0 and 1 are the step's start and end, h its length. Kinetic energies are those of momenta,
 * rho H u^2 / 2 and rho E b^2 / (2 kappa^2), linear in H and E, so that their discrete gradients are
 *   flow  H_mean u,   force on H  -rho (u0^2 + u1^2) / 4,
 * exactly. In place of the mean of u0 and u1 stands u0 + theta (u1 - u0), theta from 1/2 without viscosity to 1 where
 * it rules: of second order, what is damped goes to 0 as 1 / (1 + 2 B + 2 B^2), and the energy that this takes is lost
 * to viscosity. */
#include "liquid/film.h"

#include <math.h>

static const double tension = 1e5;                  /* Pa: a liquid under an atmosphere cavitates */
static const double give = 1e-6;                    /* m/Pa: a cavity as thick as a millimetre takes 1 % more */
static const double isolated = 2.35619449019234493; /* 3 pi / 4: r / (H / w) of strips far from each other */

void zp_film_modes(ZpFilmParams *p, bool lateral_flow) {
  static const double lowest = 0.81056946913870217, pi2 = 9.8696044010893586,
                      others = 157.141777614258; /* 8 / pi^2; a_1 / (1/12 - a_0 / pi^2) */
  double w2 = p->w * p->w;
  p->share[0] = lateral_flow ? lowest : 1;
  p->share[1] = 1 - p->share[0];
  p->kappa2[0] = lateral_flow ? pi2 / w2 : 0;
  p->kappa2[1] = lateral_flow ? others / w2 : 0;
  p->outlet = !lateral_flow;
}

void zp_film_carve(const ZpFilmParams *p, ZpFilmEval *e, ZpCarver *carver) {
  double **stations[] = {&e->rate,   &e->middle, &e->H0,       &e->H1,   &e->secant, &e->depth0,
                         &e->depth1, &e->jet,    &e->coupling, &e->head, &e->force};
  double **modes[] = {&e->flow, &e->conductance, &e->leak, &e->leak_conductance, &e->r};
  for (size_t k = 0; k < sizeof stations / sizeof stations[0]; k++)
    *stations[k] = zp_carve(carver, p->nodes);
  for (size_t k = 0; k < sizeof modes / sizeof modes[0]; k++)
    *modes[k] = zp_carve(carver, ZP_FILM_MODES * p->nodes);
  e->end = zp_carve(carver, ZP_FILM_STATE * p->nodes);
}

/* -- geometry -------------------------------------------------------------------------------------- */

/* A smooth step from g, far above the roughness, to nothing, far below 0. */
static double root(const ZpFilmParams *p, double gap) {
  return sqrt(gap * gap + 4 * p->roughness * p->roughness);
}

double zp_film_thickness(const ZpFilmParams *p, double gap) {
  double S = root(p, gap);
  return gap > 0 ? 0.5 * (gap + S) : S > gap ? 2 * p->roughness * p->roughness / (S - gap) : 0;
}

double zp_film_depth(const ZpFilmParams *p, double H) {
  double q = H / p->w;
  return H / (isolated * q + 1 / (1 + 1.066 * q * sqrt(q)));
}

/* How the thickness in the middle is foreseen: it goes on as in the last step, but halves at most. */
static double middle(const ZpFilmParams *p, double gap, double rate, double h) {
  double H = zp_film_thickness(p, gap), foreseen = zp_film_thickness(p, gap + 0.5 * h * rate);
  return fmax(foreseen, 0.5 * H);
}

/* Length of the element from station i on, m: the platform's counts at its stations. */
static double element(const ZpFilmParams *p, size_t i) {
  return i >= p->platform && i < p->platform_end ? 0 : p->l;
}

static double flat(const ZpFilmParams *p, size_t i) {
  return i >= p->platform && i <= p->platform_end ? p->flat_length : 0;
}

/* Of the elements beside station i together, m. */
static double beside(const ZpFilmParams *p, size_t i) {
  return (i > 0 ? element(p, i - 1) : 0) + (i + 1 < p->nodes ? element(p, i) : 0);
}

double zp_film_length(const ZpFilmParams *p, size_t i) {
  return 0.5 * beside(p, i) + flat(p, i);
}

/* What the thickness at station j, i - 1 .. i + 1, counts in the cell of station i, m: half of each element beside it.
 */
static double cell_share(const ZpFilmParams *p, size_t i, size_t j) {
  if (i != j) return element(p, i < j ? i : j) / 8;
  return 3 * beside(p, i) / 8 + flat(p, i);
}

/* The integral of what is linear between stations over the cell of station i: half of each element beside it. */
static double over_cell(const ZpFilmParams *p, const double *x, size_t i) {
  double sum = cell_share(p, i, i) * x[i];
  if (i > 0) sum += cell_share(p, i, i - 1) * x[i - 1];
  if (i + 1 < p->nodes) sum += cell_share(p, i, i + 1) * x[i + 1];
  return sum;
}

/* Does mode k have an equation at station i? */
static bool is_free(const ZpFilmParams *p, size_t i, int k) {
  return p->share[k] > 0 && !(p->outlet && i >= p->platform && i <= p->platform_end);
}

/* -- momentum -------------------------------------------------------------------------------------- */

/* What the step does to one momentum in a film that is `thick` in its middle. */
typedef struct Momentum {
  double theta;
  double inertia; /* of the momentum's mean, and what resists to it, kg/m^3 */
} Momentum;

/* `depth` is H or E, mean over the step. */
static Momentum momentum_of(const ZpFilmParams *p, double thick, double depth, double h) {
  double B = 6 * p->mu * h, inertia = p->rho * thick * thick, theta = 0.5 * (1 + B / (B + inertia));
  return (Momentum){theta, p->rho + 2 * theta * B * depth / (thick * thick * thick)};
}

static double mean(const double *x0, const double *x1, size_t i) {
  return 0.5 * (x0[i] + x1[i]);
}

/* Of the element from station i on: thickness in the middle, foreseen, and mean thickness. */
static double element_middle(const ZpFilmEval *e, size_t i) {
  return 0.5 * (e->middle[i] + e->middle[i + 1]);
}

static double element_mean(const ZpFilmEval *e, size_t i) {
  return 0.5 * (mean(e->H0, e->H1, i) + mean(e->H0, e->H1, i + 1));
}

static size_t at_mode(size_t i, int k) {
  return ZP_FILM_MODES * i + (size_t)k;
}

/* Where the state has u_k, and b_k, of station i, and the cavity. */
static size_t along_at(size_t i, int k) {
  return ZP_FILM_STATE * i + (size_t)k;
}

static size_t across_at(size_t i, int k) {
  return ZP_FILM_STATE * i + ZP_FILM_MODES + (size_t)k;
}

static size_t cavity_at(size_t i) {
  return ZP_FILM_STATE * i + ZP_FILM_CAVITY;
}

static void flow_along(const ZpFilmParams *p, size_t i, int k, double h, const double *start, const double *heads,
                       const ZpFilmEval *e) {
  size_t at = at_mode(i, k), u = along_at(i, k);
  double H = element_mean(e, i);
  Momentum m = momentum_of(p, element_middle(e, i), H, h);
  double drop = (heads[at] - heads[at + ZP_FILM_MODES]) / p->l;
  double u_mean = (p->rho * start[u] + m.theta * h * drop) / m.inertia;
  e->flow[at] = H * u_mean;
  e->conductance[at] = H * m.theta * h / (p->l * m.inertia);
  e->end[u] = start[u] + (u_mean - start[u]) / m.theta;
}

/* The flow out at the long edges is linear in the heads but for that of the jets, D = rho v^2 / 2 at speed v outwards:
 * together v + C rho v^2 / 2 = A. */
static void flow_across(const ZpFilmParams *p, size_t i, double h, const double *start, const double *heads,
                        const ZpFilmEval *e) {
  double E = mean(e->depth0, e->depth1, i), per_speed = 0.5 * p->w / mean(e->H0, e->H1, i), A = 0, C = 0;
  Momentum m = momentum_of(p, e->middle[i], E, h);
  for (int k = 0; k < ZP_FILM_MODES; k++) {
    size_t at = at_mode(i, k);
    e->leak_conductance[at] = E * m.theta * h * p->kappa2[k] / m.inertia;
    e->leak[at] =
        p->kappa2[k] > 0 ? E * p->rho * start[across_at(i, k)] / m.inertia + e->leak_conductance[at] * heads[at] : 0;
    A += per_speed * p->share[k] * e->leak[at];
    C += per_speed * p->share[k] * e->leak_conductance[at];
  }
  double v = A > 0 ? 2 * A / (1 + sqrt(1 + 2 * p->rho * A * C)) : A, out = fmax(v, 0);
  e->jet[i] = v;
  e->coupling[i] = per_speed * p->rho * out / (1 + p->rho * C * out);
  for (int k = 0; k < ZP_FILM_MODES; k++) {
    size_t b = across_at(i, k);
    e->leak[at_mode(i, k)] -= e->leak_conductance[at_mode(i, k)] * 0.5 * p->rho * out * out;
    e->end[b] = start[b] + (e->leak[at_mode(i, k)] / E - start[b]) / m.theta;
  }
}

/* -- a step ---------------------------------------------------------------------------------------- */

static void geometry(const ZpFilmParams *p, const double *g0, const double *g1, double h, const ZpFilmEval *e) {
  for (size_t i = 0; i < p->nodes; i++) {
    double both = root(p, g0[i]) + root(p, g1[i]);
    e->middle[i] = middle(p, g0[i], e->rate[i], h);
    e->H0[i] = zp_film_thickness(p, g0[i]);
    e->H1[i] = zp_film_thickness(p, g1[i]);
    e->depth0[i] = zp_film_depth(p, e->H0[i]);
    e->depth1[i] = zp_film_depth(p, e->H1[i]);
    e->secant[i] = both > 0 ? 0.5 * (1 + (g0[i] + g1[i]) / both) : 0.5;
  }
}

/* Below minus the tension a cavity grows, so that its head hardly falls any more. */
static void cavities(const ZpFilmParams *p, const double *heads, const ZpFilmEval *e) {
  for (size_t i = 0; i < p->nodes; i++) {
    e->head[i] = p->share[0] * heads[at_mode(i, 0)] + p->share[1] * heads[at_mode(i, 1)];
    e->end[cavity_at(i)] = give * fmax(0, -tension - e->head[i]);
  }
}

/* (E1 - E0) / (H1 - H0). */
static double depth_slope(const ZpFilmParams *p, const ZpFilmEval *e, size_t i) {
  static const double near = 1e-5; /* closer, the difference is rounding, the slope in the middle exact to its square */
  double H = mean(e->H0, e->H1, i), change = e->H1[i] - e->H0[i];
  if (fabs(change) > near * H) return (e->depth1[i] - e->depth0[i]) / change;
  return (zp_film_depth(p, H * (1 + near)) - zp_film_depth(p, H * (1 - near))) / (2 * near * H);
}

static double squares(const double *start, const double *end, size_t i) {
  return start[i] * start[i] + end[i] * end[i];
}

/* What the kinetic energies take of the force on the thickness at station i, over w, N/m. */
static double suction(const ZpFilmParams *p, const double *start, const ZpFilmEval *e, size_t i) {
  double slope = p->rho > 0 ? depth_slope(p, e, i) : 0, sum = 0;
  for (int k = 0; k < ZP_FILM_MODES; k++) {
    double along = 0, across = p->kappa2[k] > 0 ? squares(start, e->end, across_at(i, k)) / p->kappa2[k] : 0;
    if (i > 0) along += element(p, i - 1) * squares(start, e->end, along_at(i - 1, k));
    if (i + 1 < p->nodes) along += element(p, i) * squares(start, e->end, along_at(i, k));
    sum += p->share[k] * (along / 8 + zp_film_length(p, i) * slope * across / 4);
  }
  return p->rho * sum;
}

/* The growth of what the cell of station i holds, m^2. */
static double grown(const ZpFilmParams *p, const double *rise, const double *start, const ZpFilmEval *e, size_t i) {
  return over_cell(p, rise, i) - zp_film_length(p, i) * (e->end[cavity_at(i)] - start[cavity_at(i)]);
}

/* What flows out of it in mode k, m^2/s. */
static double outflow(const ZpFilmParams *p, const ZpFilmEval *e, size_t i, int k) {
  double sum = zp_film_length(p, i) * e->leak[at_mode(i, k)] + e->flow[at_mode(i, k)];
  return i > 0 ? sum - e->flow[at_mode(i - 1, k)] : sum;
}

void zp_film_step(const ZpFilmParams *p, const double *g0, const double *g1, double h, const double *start,
                  const double *heads, const ZpFilmEval *e) {
  geometry(p, g0, g1, h, e);
  cavities(p, heads, e);
  for (size_t i = 0; i < p->nodes; i++) {
    flow_across(p, i, h, start, heads, e);
    for (int k = 0; i + 1 < p->nodes && element(p, i) > 0 && k < ZP_FILM_MODES; k++)
      flow_along(p, i, k, h, start, heads, e);
  }
  double *rise = e->force; /* in its place until it is known */
  for (size_t i = 0; i < p->nodes; i++)
    rise[i] = e->secant[i] * (g1[i] - g0[i]);
  for (size_t i = 0; i < p->nodes; i++)
    for (int k = 0; k < ZP_FILM_MODES; k++) {
      size_t at = at_mode(i, k);
      double volume = grown(p, rise, start, e, i) + h * outflow(p, e, i, k);
      e->r[at] = is_free(p, i, k) ? p->share[k] * p->w * volume : -heads[at];
    }
  for (size_t i = 0; i < p->nodes; i++)
    e->force[i] = p->w * e->secant[i] * (over_cell(p, e->head, i) - suction(p, start, e, i));
}

/* -- energy ---------------------------------------------------------------------------------------- */

static double energy_of_cavity(double thickness) {
  return thickness * (tension + 0.5 * thickness / give);
}

double zp_film_energy(const ZpFilmParams *p, const double *gap, const double *state) {
  double sum = 0;
  for (size_t i = 0; i < p->nodes; i++) {
    double H = zp_film_thickness(p, gap[i]), E = zp_film_depth(p, H), length = zp_film_length(p, i);
    for (int k = 0; k < ZP_FILM_MODES; k++) {
      double u = state[along_at(i, k)], b = state[across_at(i, k)], half = 0.5 * p->rho * p->share[k];
      if (i + 1 < p->nodes) sum += half * element(p, i) * 0.5 * (H + zp_film_thickness(p, gap[i + 1])) * u * u;
      if (p->kappa2[k] > 0) sum += half * length * E * b * b / p->kappa2[k];
    }
    sum += length * energy_of_cavity(state[cavity_at(i)]);
  }
  return sum * p->w;
}

/* Of one momentum over the step, per length and width, J/m^2: drag, and what theta takes beyond the mean. */
static double lost(const ZpFilmParams *p, double thick, double depth, double flow, double change, double h) {
  Momentum m = momentum_of(p, thick, depth, h);
  return 12 * p->mu * h * flow * flow / (thick * thick * thick) + p->rho * depth * (m.theta - 0.5) * change * change;
}

static double change(const double *start, const ZpFilmEval *e, size_t i) {
  return e->end[i] - start[i];
}

static double lost_by_cavity(const double *start, const ZpFilmEval *e, size_t i) {
  double before = start[cavity_at(i)], after = e->end[cavity_at(i)];
  return energy_of_cavity(before) - energy_of_cavity(after) - e->head[i] * (after - before);
}

ZpFilmLoss zp_film_loss(const ZpFilmParams *p, double h, const double *start, const ZpFilmEval *e) {
  ZpFilmLoss sum = {0, 0, 0};
  for (size_t i = 0; i < p->nodes; i++) {
    double length = p->w * zp_film_length(p, i), E = mean(e->depth0, e->depth1, i), H = mean(e->H0, e->H1, i);
    double out = fmax(e->jet[i], 0);
    for (int k = 0; k < ZP_FILM_MODES; k++) {
      double leak = e->leak[at_mode(i, k)], across = change(start, e, across_at(i, k));
      if (p->kappa2[k] > 0)
        sum.across += length * p->share[k] * lost(p, e->middle[i], E, leak, across, h) / p->kappa2[k];
      if (i + 1 < p->nodes && element(p, i) > 0)
        sum.along += p->w * p->l * p->share[k] *
                     lost(p, element_middle(e, i), element_mean(e, i), e->flow[at_mode(i, k)],
                          change(start, e, along_at(i, k)), h);
    }
    sum.jets += length * (h * p->rho * out * out * out * H / p->w + lost_by_cavity(start, e, i));
  }
  return sum;
}

/* -- derivatives ----------------------------------------------------------------------------------- */

double zp_film_own(const ZpFilmParams *p, double h, const ZpFilmEval *e, size_t i, int k, int m) {
  if (!is_free(p, i, k) || !is_free(p, i, m)) return k == m ? 1 : 0;
  double length = zp_film_length(p, i), leak = p->share[k] * e->leak_conductance[at_mode(i, k)], sum = 0;
  if (k == m) {
    sum = length * leak + p->share[k] * e->conductance[at_mode(i, k)];
    if (i > 0) sum += p->share[k] * e->conductance[at_mode(i - 1, k)];
  }
  sum -= length * e->coupling[i] * leak * p->share[m] * e->leak_conductance[at_mode(i, m)];
  double grows = e->end[cavity_at(i)] > 0 ? length * give * p->share[k] * p->share[m] : 0;
  return -p->w * (h * sum + grows);
}

double zp_film_next(const ZpFilmParams *p, double h, const ZpFilmEval *e, size_t i, int k) {
  if (!is_free(p, i, k) || !is_free(p, i + 1, k)) return 0;
  return p->share[k] * h * p->w * e->conductance[at_mode(i, k)];
}

double zp_film_by_gap(const ZpFilmParams *p, const ZpFilmEval *e, size_t i, size_t j, int k) {
  return is_free(p, i, k) ? p->share[k] * p->w * cell_share(p, i, j) * e->secant[j] : 0;
}

double zp_film_inertia(const ZpFilmParams *p, double h, const ZpFilmEval *e, size_t i) {
  double E = mean(e->depth0, e->depth1, i), flow = 0;
  Momentum m = momentum_of(p, e->middle[i], E, h);
  for (int k = 0; k < ZP_FILM_MODES; k++)
    flow += p->kappa2[k] > 0 ? p->share[k] / p->kappa2[k] : 0;
  return p->w * zp_film_length(p, i) * flow * m.inertia / (2 * m.theta * E);
}
