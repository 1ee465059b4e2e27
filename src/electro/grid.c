/* Letters of docs/theory.md, section 14, eq. (14.2):
 *   N     shape functions of an element, products of the quadratic Lagrange polynomials in xi and eta
 *   J     Jacobian of its map from [-1, 1]^2, m
 *   w     weight of an integration point times det J, m^2
 *   E     here grad phi, V/m: signs do not matter to energy and force
 */
#include "electro/grid.h"

#include <math.h>
#include <string.h>

#include "base/kernel.h"
#include "electro/plates.h"

enum { NODES = 9, POINTS = 9 };
static const double gauss_at[3] = {-0.77459666924148337704, 0, 0.77459666924148337704};
static const double gauss_weight[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
static const double lobatto_at[3] = {-1, 0, 1};
static const double lobatto_weight[3] = {1.0 / 3, 4.0 / 3, 1.0 / 3};

static size_t reserve(ZpGrid *g, void *block) {
  ZpArena arena = {block, 0};
  size_t count = g->nx * g->ny;
  double **arrays[] = {&g->x, &g->y, &g->phi, &g->Fx, &g->Fy, &g->rhs};
  for (size_t k = 0; k < sizeof arrays / sizeof arrays[0]; k++)
    *arrays[k] = zp_arena_take(&arena, count);
  g->eps = zp_arena_take(&arena, g->columns * g->rows);
  g->equation = zp_arena_take_of(&arena, count, sizeof *g->equation);
  return arena.used;
}

bool zp_grid_create(ZpGrid *g, size_t columns, size_t rows) {
  memset(g, 0, sizeof *g);
  g->columns = columns;
  g->rows = rows;
  g->nx = 2 * columns + 1;
  g->ny = 2 * rows + 1;
  g->memory = zp_calloc(1, reserve(g, NULL));
  if (!g->memory) return false;
  reserve(g, g->memory);
  return true;
}

void zp_grid_destroy(ZpGrid *g) {
  zp_skyline_destroy(&g->K);
  zp_free(g->memory);
  g->memory = NULL;
}

/* Places of the nodes of element (c, r), xi slower than eta. */
static void nodes_of(const ZpGrid *g, size_t c, size_t r, size_t node[NODES]) {
  for (size_t p = 0; p < 3; p++)
    for (size_t q = 0; q < 3; q++)
      node[3 * p + q] = (2 * c + p) * g->ny + 2 * r + q;
}

/* Number the nodes that no conductor holds, column by column => their number. */
static size_t number(ZpGrid *g) {
  int next = 0;
  size_t node[NODES];
  memset(g->equation, 0, g->nx * g->ny * sizeof *g->equation);
  for (size_t c = 0; c < g->columns; c++)
    for (size_t r = 0; r < g->rows; r++) {
      if (g->eps[c * g->rows + r] > 0) continue;
      nodes_of(g, c, r, node);
      for (size_t a = 0; a < NODES; a++)
        g->equation[node[a]] = -1;
    }
  for (size_t k = 0; k < g->nx * g->ny; k++)
    if (g->equation[k] == 0) g->equation[k] = next++;
  return (size_t)next;
}

/* The first unknown that shares an element with each unknown. */
static void profile(const ZpGrid *g, size_t n, size_t *first) {
  size_t node[NODES];
  for (size_t i = 0; i < n; i++)
    first[i] = i;
  for (size_t c = 0; c < g->columns; c++)
    for (size_t r = 0; r < g->rows; r++) {
      if (!(g->eps[c * g->rows + r] > 0)) continue;
      nodes_of(g, c, r, node);
      size_t least = n;
      for (size_t a = 0; a < NODES; a++)
        if (g->equation[node[a]] >= 0 && (size_t)g->equation[node[a]] < least) least = (size_t)g->equation[node[a]];
      for (size_t a = 0; a < NODES; a++)
        if (g->equation[node[a]] >= 0 && least < first[g->equation[node[a]]]) first[g->equation[node[a]]] = least;
    }
}

bool zp_grid_number(ZpGrid *g) {
  size_t n = number(g);
  size_t *first = zp_calloc(n, sizeof *first);
  if (!first) return false;
  profile(g, n, first);
  bool created = zp_skyline_create(&g->K, n, first);
  zp_free(first);
  return created;
}

/* -- one element ---------------------------------------------------------------------------------- */

static void lagrange(double at, double value[3], double slope[3]) {
  value[0] = 0.5 * at * (at - 1);
  value[1] = 1 - at * at;
  value[2] = 0.5 * at * (at + 1);
  slope[0] = at - 0.5;
  slope[1] = -2 * at;
  slope[2] = at + 0.5;
}

/* Slopes of the nine shape functions by xi and eta. */
static void slopes(double xi, double eta, double by_xi[NODES], double by_eta[NODES]) {
  double X[3], dX[3], Y[3], dY[3];
  lagrange(xi, X, dX);
  lagrange(eta, Y, dY);
  for (size_t p = 0; p < 3; p++)
    for (size_t q = 0; q < 3; q++) {
      by_xi[3 * p + q] = dX[p] * Y[q];
      by_eta[3 * p + q] = X[p] * dY[q];
    }
}

/* The reference element: slopes at its integration points. */
typedef struct Reference {
  double by_xi[POINTS][NODES], by_eta[POINTS][NODES], weight[POINTS];
} Reference;

static Reference reference(void) {
  Reference e = {0};
  for (size_t p = 0; p < 3; p++)
    for (size_t q = 0; q < 3; q++) {
      slopes(lobatto_at[p], gauss_at[q], e.by_xi[3 * p + q], e.by_eta[3 * p + q]);
      e.weight[3 * p + q] = lobatto_weight[p] * gauss_weight[q];
    }
  return e;
}

/* Quantities of an element at its integration points. */
typedef struct Element {
  size_t node[NODES];
  double x[NODES], y[NODES], phi[NODES];
} Element;

static void gather(const ZpGrid *g, size_t c, size_t r, Element *e) {
  nodes_of(g, c, r, e->node);
  for (size_t a = 0; a < NODES; a++) {
    e->x[a] = g->x[e->node[a]];
    e->y[a] = g->y[e->node[a]];
    e->phi[a] = g->phi[e->node[a]];
  }
}

/* Slopes of the shape functions by x and y => det J. */
static double map(const Element *e, const double *by_xi, const double *by_eta, double *Nx, double *Ny) {
  double x_xi = 0, x_eta = 0, y_xi = 0, y_eta = 0;
  for (size_t a = 0; a < NODES; a++) {
    x_xi += by_xi[a] * e->x[a];
    x_eta += by_eta[a] * e->x[a];
    y_xi += by_xi[a] * e->y[a];
    y_eta += by_eta[a] * e->y[a];
  }
  double J = x_xi * y_eta - x_eta * y_xi, inverse = 1 / J;
  for (size_t a = 0; a < NODES; a++) {
    Nx[a] = (y_eta * by_xi[a] - y_xi * by_eta[a]) * inverse;
    Ny[a] = (x_xi * by_eta[a] - x_eta * by_xi[a]) * inverse;
  }
  return J;
}

static void gradient(const Element *e, const double *Nx, const double *Ny, double E[2]) {
  E[0] = E[1] = 0;
  for (size_t a = 0; a < NODES; a++) {
    E[0] += Nx[a] * e->phi[a];
    E[1] += Ny[a] * e->phi[a];
  }
}

/* Lower triangle of the element's matrix for permittivity 1 => false if it is folded. */
static bool element_matrix(const Reference *ref, const Element *e, double k[NODES][NODES]) {
  double Nx[NODES], Ny[NODES];
  memset(k, 0, NODES * sizeof k[0]);
  for (size_t p = 0; p < POINTS; p++) {
    double J = map(e, ref->by_xi[p], ref->by_eta[p], Nx, Ny), w = ref->weight[p] * J;
    if (!(J > 0)) return false;
    for (size_t a = 0; a < NODES; a++)
      for (size_t b = 0; b <= a; b++)
        k[a][b] += w * (Nx[a] * Nx[b] + Ny[a] * Ny[b]);
  }
  return true;
}

/* -- the whole ------------------------------------------------------------------------------------ */

/* Entry k between nodes a and b: into the matrix, or to the right-hand side where one is held. */
static void add(ZpGrid *g, size_t a, size_t b, double k) {
  int i = g->equation[a], j = g->equation[b];
  if (i >= 0 && j >= 0)
    *zp_skyline_at(&g->K, (size_t)(i > j ? i : j), (size_t)(i > j ? j : i)) += k;
  else if (i >= 0)
    g->rhs[i] -= k * g->phi[b];
  else if (j >= 0)
    g->rhs[j] -= k * g->phi[a];
}

static bool assemble(ZpGrid *g) {
  Reference ref = reference();
  Element e;
  double k[NODES][NODES];
  zp_skyline_clear(&g->K);
  memset(g->rhs, 0, g->K.n * sizeof *g->rhs);
  for (size_t c = 0; c < g->columns; c++)
    for (size_t r = 0; r < g->rows; r++) {
      double eps = g->eps[c * g->rows + r];
      if (!(eps > 0)) continue;
      gather(g, c, r, &e);
      if (!element_matrix(&ref, &e, k)) return false;
      for (size_t a = 0; a < NODES; a++)
        for (size_t b = 0; b <= a; b++)
          add(g, e.node[a], e.node[b], eps * k[a][b]);
    }
  return true;
}

ZpGridEnd zp_grid_solve(ZpGrid *g) {
  if (!assemble(g)) return ZP_GRID_FOLDED;
  if (!zp_skyline_factor(&g->K)) return ZP_GRID_SINGULAR;
  zp_skyline_solve(&g->K, g->rhs);
  for (size_t k = 0; k < g->nx * g->ny; k++)
    if (g->equation[k] >= 0) g->phi[k] = g->rhs[g->equation[k]];
  return ZP_GRID_SOLVED;
}

/* Integral of |grad phi|^2 / 2 over an element. */
static double element_energy(const Reference *ref, const Element *e) {
  double Nx[NODES], Ny[NODES], E[2], energy = 0;
  for (size_t p = 0; p < POINTS; p++) {
    double w = ref->weight[p] * map(e, ref->by_xi[p], ref->by_eta[p], Nx, Ny);
    gradient(e, Nx, Ny, E);
    energy += 0.5 * w * (E[0] * E[0] + E[1] * E[1]);
  }
  return energy;
}

double zp_grid_energy(const ZpGrid *g) {
  Reference ref = reference();
  Element e;
  double energy = 0;
  for (size_t c = 0; c < g->columns; c++)
    for (size_t r = 0; r < g->rows; r++) {
      double eps = g->eps[c * g->rows + r];
      if (!(eps > 0)) continue;
      gather(g, c, r, &e);
      energy += ZP_EPS0 * eps * element_energy(&ref, &e);
    }
  return energy;
}

static void element_forces(ZpGrid *g, const Reference *ref, const Element *e, double eps) {
  double Nx[NODES], Ny[NODES], E[2];
  for (size_t p = 0; p < POINTS; p++) {
    double w = ZP_EPS0 * eps * ref->weight[p] * map(e, ref->by_xi[p], ref->by_eta[p], Nx, Ny);
    gradient(e, Nx, Ny, E);
    double half = 0.5 * (E[0] * E[0] + E[1] * E[1]);
    for (size_t a = 0; a < NODES; a++) {
      double along = E[0] * Nx[a] + E[1] * Ny[a];
      g->Fx[e->node[a]] += w * (half * Nx[a] - along * E[0]);
      g->Fy[e->node[a]] += w * (half * Ny[a] - along * E[1]);
    }
  }
}

void zp_grid_forces(ZpGrid *g, size_t first, size_t end) {
  Reference ref = reference();
  Element e;
  memset(g->Fx, 0, g->nx * g->ny * sizeof *g->Fx);
  memset(g->Fy, 0, g->nx * g->ny * sizeof *g->Fy);
  for (size_t c = first; c < end; c++)
    for (size_t r = 0; r < g->rows; r++) {
      double eps = g->eps[c * g->rows + r];
      if (!(eps > 0)) continue;
      gather(g, c, r, &e);
      element_forces(g, &ref, &e, eps);
    }
}

void zp_grid_gradient(const ZpGrid *g, size_t c, size_t r, double xi, double eta, double E[2]) {
  Element e;
  double by_xi[NODES], by_eta[NODES], Nx[NODES], Ny[NODES];
  gather(g, c, r, &e);
  slopes(xi, eta, by_xi, by_eta);
  map(&e, by_xi, by_eta, Nx, Ny);
  gradient(&e, Nx, Ny, E);
}
