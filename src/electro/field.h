/* The electric field of two insulated electrodes that face each other, solved in the plane of the ribbons: metal
 * strips of finite thickness with a layer of insulator on their facing sides, at any shape from contact over thin
 * wedges to millimetres, liquid all around, or in a part of the gap only, closed clip at the left, half a platform and
 * the mirror plane of the actuator at the right, docs/theory.md section 14.
 *
 * Everything goes with the voltage or its square, so it is solved for 1 V. Forces and energies are of one modelled
 * half. Stations are pairs of points that face each other on the two insulator faces. Between two stations the
 * faces are straight; with one column of nodes per piece each three stations lie on a parabola.
 */
#ifndef ZP_ELECTRO_FIELD_H
#define ZP_ELECTRO_FIELD_H

#include "electro/grid.h"
#include "math/cover.h"

/* How fine the grid is: numbers of elements across or along each part, and the size of the smallest. */
typedef struct ZpFieldMesh {
  size_t gap, insulator, strip, clip, platform, outside;
  double size;  /* of the cross-section over that of an actuator of 100 mm: lengths of the grid go with it */
  double first; /* smallest elements, at the electrodes' ends and outer faces, m; they grow away from there */
} ZpFieldMesh;

/* A mesh that gives 0.1 % in force and profile. */
static inline ZpFieldMesh zp_field_mesh(double size) {
  return (ZpFieldMesh){.gap = 3,
                       .insulator = 1,
                       .strip = 1,
                       .clip = 8,
                       .platform = 3,
                       .outside = 12,
                       .size = size,
                       .first = 5e-5 * size};
}

/* Closed faces stay this far apart, m: far below what changes a force, far above rounding. */
static inline double zp_field_least_gap(const ZpFieldMesh *mesh) {
  return 1e-9 * mesh->size;
}

typedef struct ZpFieldParams {
  size_t stations;     /* from the clip's edge to the platform's, 3 or more */
  size_t columns;      /* columns of nodes per piece between two stations: even, or 1 with an odd number of stations */
  double w;            /* width, m */
  double b, t;         /* thickness of strip and of insulator, m */
  double eps_m, eps_i; /* relative permittivity of liquid and insulator, */
  double eps_out;      /* and of what surrounds the strips and fills the gap where there is no liquid */
  double clip;         /* length that is closed left of the first station, m */
  double slab, eps_slab; /* thickness of a layer of another permittivity in the middle of the gap, beyond the strips,
                            too, m; 0 without. With it mesh.gap is a multiple of 3, and forces are not found */
  double platform;       /* straight length right of the last station up to the mirror plane, m; 0 without */
  bool electrode;        /* whether the platform's faces are electrodes, too */
  ZpFieldMesh mesh;
} ZpFieldParams;

/* The two insulator faces: places of their stations, `step` doubles apart. */
typedef struct ZpContact {
  const double *upper_x, *upper_y, *lower_x, *lower_y;
  size_t step;
} ZpContact;

typedef enum ZpFieldEnd {
  ZP_FIELD_SOLVED,
  ZP_FIELD_CROSSING, /* faces pass through each other by more than a micrometre */
  ZP_FIELD_BARE,     /* faces touch without an insulator between the metals */
  ZP_FIELD_FOLDED,   /* a ribbon runs back, or bends more sharply than its thickness allows */
  ZP_FIELD_SINGULAR  /* no solution: numbers left all bounds */
} ZpFieldEnd;

/* Words for a message: "the faces pass through each other". */
const char *zp_field_words(ZpFieldEnd end);

/* The field on the facing surfaces at one column of nodes, at 1 V. */
typedef struct ZpFieldProfile {
  double x;     /* mean of both faces, m */
  double gap;   /* m */
  double upper; /* vertical traction on strip and insulator of the upper ribbon per x-length, closing positive, N/m */
  double lower; /* the same of the lower ribbon */
  double E;     /* in the liquid at the faces, the larger of both, V/m */
  double E_insulator; /* in the insulators, the larger of both, V/m */
} ZpFieldProfile;

typedef struct ZpFieldColumn ZpFieldColumn;
typedef struct ZpFieldRow ZpFieldRow;

typedef struct ZpField {
  ZpFieldParams params;
  ZpGrid grid;
  ZpFieldColumn *column; /* [grid.nx] how a column of nodes follows from the stations */
  ZpFieldRow *row;       /* [grid.ny] where a row lies between the surfaces */
  size_t first, last;    /* columns of the first and the last station; the platform's follow */
  /* results, at 1 V */
  double *Fx, *Fy;         /* [2 stations], upper and lower of each: derivative of the energy, N, eq. (14.3) */
  double energy;           /* of the field right of the clip, J, eq. (14.4); 2 energy is the capacitance, F */
  ZpFieldProfile *profile; /* [profiles] from the first station to the mirror plane */
  size_t profiles;
  void *memory;
} ZpField;

/* Allocate and number. False if there is no memory. */
bool zp_field_create(const ZpFieldParams *params, ZpField *field);
void zp_field_destroy(ZpField *field);

/* Liquid fills the gap as far as `cover` says, by whole columns of elements; before the first call, all of it. */
void zp_field_cover(ZpField *field, const ZpCover *cover);

/* Is this a geometry that can be solved as it stands? zp_field_solve itself lays faces that overlap on each other. */
ZpFieldEnd zp_field_check(const ZpFieldParams *params, const ZpContact *faces);

/* Solve at this shape => energy, forces on the stations. */
ZpFieldEnd zp_field_solve(ZpField *field, const ZpContact *faces);

/* Traction and field strength on the facing surfaces at the last solution => profile. */
void zp_field_profile(ZpField *field);

/* => rows of grid nodes on the surfaces, upwards: lower metal's underside and top, lower and upper insulator face,
 * upper metal's underside and top. */
void zp_field_surfaces(const ZpField *field, size_t row[6]);

/* Forces on one ribbon as wholes, at 1 V, closing positive. */
typedef struct ZpFieldTotals {
  double upper, lower;                   /* by traction, clip's edge to last station, N */
  double upper_platform, lower_platform; /* by traction, last station to mirror plane, N */
  double upper_work, lower_work;         /* clip's edge to mirror plane by virtual work, eq. (14.6), N */
} ZpFieldTotals;

/* (last solution and profile) => totals. Overwrites grid.Fx and grid.Fy. */
ZpFieldTotals zp_field_totals(ZpField *field);

#endif
