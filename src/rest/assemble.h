/* Equations of an actuator: which coordinate has which, and how the stiffnesses of edges and stations go into a banded
 * matrix over them. Coordinate x of node j is at [2 j], y at [2 j + 1]; -1: held. */
#ifndef ZP_REST_ASSEMBLE_H
#define ZP_REST_ASSEMBLE_H

#include "actuator/model.h"
#include "math/band.h"

/* Number the free coordinates station by station, so that what couples lies in a narrow band; the clip's two nodes
 * share their equations. => how many; equation [2 count]. */
size_t zp_assemble_number(const ZpModel *model, int *equation);

/* Diagonals below the main one, and above: node i meets nodes i - 2 .. i + 2. */
size_t zp_assemble_bandwidth(const ZpModel *model);

/* Add D[3 j + m] = -dR_j / d(edge j + (m - 1) s), as of zp_rod_stiffness: edge j feels edges j - s, j, j + s. */
void zp_assemble_edges(const ZpModel *model, const int *equation, const double (*D)[4], ZpBand *K);

/* Add second derivatives by the stations' gaps: own [N] and with the next station [N - 1]. */
void zp_assemble_stations(const ZpModel *model, const int *equation, const double *own, const double *next, ZpBand *K);

/* Add those by an element's mean x-length and the gap of its left (along0) and right (along1) station [N - 1]. */
void zp_assemble_along(const ZpModel *model, const int *equation, const double *along0, const double *along1,
                       ZpBand *K);

#endif
