/* Electrostatics on a logically rectangular grid in the plane: div(eps grad phi) = 0 by finite elements of nine
 * nodes (biquadratic), whose nodes may lie anywhere. Knows nothing of actuators.
 *
 * Node (i, j), 0 <= i < nx, 0 <= j < ny, is at [i * ny + j]; element (c, r) has the nodes 2 c .. 2 c + 2 by
 * 2 r .. 2 r + 2 and is at [c * rows + r]. An element of permittivity 0 lies inside a conductor: it is left out, and
 * all its nodes keep the potential that the owner gave them. Edges of the grid are mirrors (no flux). */
#ifndef ZP_ELECTRO_GRID_H
#define ZP_ELECTRO_GRID_H

#include <stdbool.h>

#include "math/skyline.h"

typedef struct ZpGrid {
  size_t columns, rows; /* of elements */
  size_t nx, ny;        /* of nodes: 2 columns + 1, 2 rows + 1 */
  double *x, *y;        /* [nx ny] positions, m */
  double *eps;          /* [columns rows] relative permittivity, 0 in a conductor */
  double *phi;          /* [nx ny] potential, V; in conductors the owner's */
  double *Fx, *Fy;      /* [nx ny] force on nodes, zp_grid_forces, N/m */
  double *rhs;          /* [n] */
  int *equation;        /* [nx ny] number of the unknown, -1 in conductors */
  ZpSkyline K;
  void *memory;
} ZpGrid;

/* Allocate a grid of columns by rows elements, all of whose arrays are 0. False if there is no memory. */
bool zp_grid_create(ZpGrid *grid, size_t columns, size_t rows);
void zp_grid_destroy(ZpGrid *grid);

/* Number the unknowns once eps is set. False if there is no memory. */
bool zp_grid_number(ZpGrid *grid);

typedef enum ZpGridEnd {
  ZP_GRID_SOLVED,
  ZP_GRID_FOLDED,  /* an element is turned inside out */
  ZP_GRID_SINGULAR /* the matrix is not positive: numbers left all bounds */
} ZpGridEnd;

/* (x, y, eps, phi of the conductors) => phi of all nodes. */
ZpGridEnd zp_grid_solve(ZpGrid *grid);

/* Energy of all elements at the last solution, J/m, eq. (14.2). */
double zp_grid_energy(const ZpGrid *grid);

/* Derivative of the energy of element columns first .. end - 1 at held potentials by the position of each node
 * => Fx, Fy, eq. (14.2). */
void zp_grid_forces(ZpGrid *grid, size_t first, size_t end);

/* grad phi at (xi, eta) in [-1, 1]^2 of element (c, r), V/m. */
void zp_grid_gradient(const ZpGrid *grid, size_t c, size_t r, double xi, double eta, double gradient[2]);

#endif
