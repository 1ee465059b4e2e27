/* A front that runs through a film between two ribbons, peeling or zipping, in time: the library's film between beams
 * of small slope without mass and inertia. docs/theory.md, section 22. */
#ifndef ZIPACT_BENCH_FRONT_H
#define ZIPACT_BENCH_FRONT_H

#include <stdbool.h>

#include "liquid/film.h"
#include "math/band.h"

enum { STATIONS = 2001, UNKNOWNS = 3 };

/* Of the gap h of two equal ribbons: EI' / 2 h'''' = w p - F d / (h + d)^2, EI' / 2 being `stiffness`. */
typedef struct Front {
  ZpFilmParams film;
  ZpFilmEval eval;
  double stiffness; /* N m^2 */
  double F, d;      /* attraction of closed faces, N; thickness that stands for the insulators, m */
  double curvature; /* of the gap, at the end that is open */
  bool opens_left;  /* that end; the other one is closed by symmetry */
  double h;         /* step, s */
  double g0[STATIONS], g1[STATIONS], heads[ZP_FILM_MODES * STATIONS], start[ZP_FILM_STATE * STATIONS];
  double force[STATIONS], r[UNKNOWNS * STATIONS];
  ZpBand J;
  void *memory;
} Front;

/* (stiffness, N m^2; viscosity, Pa s; width, m; element length, m) => one that has STATIONS stations; with flow across,
 * too. */
Front *front_create(double stiffness, double viscosity, double w, double l, bool lateral_flow);
void front_destroy(Front *front);

/* Which end is open; there the film has an outlet. */
void front_open(Front *front, bool left);

/* Closed by an even film up to x, open beyond with the curvature of the open end. */
void front_lay(Front *front, double film, double x);

/* One step => false if it was not found. */
bool front_step(Front *front);

/* Where the gap is `at`, coming from the closed end, m. */
double front_place(const Front *front, double at);

#endif
