/* Quantities at the stations of a shape beyond their places, and the worst that its materials see. */
#ifndef ZP_ACTUATOR_SHAPE_H
#define ZP_ACTUATOR_SHAPE_H

#include "base/table.h"

#include "actuator/plane.h"

/* Room for what follows from a shape. */
typedef struct ZpShapeRoom {
  const double *interface; /* interface voltages (electro/leak.h); NULL: there is no charge */
  const double *k0;        /* natural curvatures (ribbon/rod.h); NULL: those without voltage */
  const double *strain;    /* plastic strains (ribbon/rod_plastic.h); NULL: none */
  double reach[ZP_BEADS];  /* wet length of each half, m; INFINITY: no bead ends there */
  double *line_force;      /* [nodes] */
  double *insulator_field; /* [nodes] */
  double *stress;          /* [count] */
} ZpShapeRoom;

/* Without interface voltages, with liquid everywhere. */
void zp_shape_reserve(const ZpModel *model, ZpShapeRoom *room, ZpArena *arena);

/* Is there liquid at station i? */
bool zp_shape_is_wet(const ZpModel *model, const ZpShapeRoom *room, size_t i);

/* A shape whose time, voltage, positions and, with electrodes, gaps are known => the rest of it, in `room`. */
void zp_shape_fill(const ZpModel *model, const ZpShapeRoom *room, ZpShape *shape);

/* Shapes of several actuators as one, as if the stations of one followed on those of another. */
enum { ZP_NODE_ARRAYS = 3, ZP_SHAPE_ARRAYS = 6 };
typedef struct ZpManyShapes {
  size_t nodes, stations;         /* of each */
  double *array[ZP_SHAPE_ARRAYS]; /* first those over nodes: x, y, stress; gap, line force, insulators' field */
} ZpManyShapes;

void zp_many_reserve(ZpManyShapes *all, size_t members, size_t nodes, size_t stations, ZpArena *arena);

/* Copy a member's shape to its place, that of a lower antagonist, which its own frame has upside down, as it is. */
void zp_many_put(const ZpManyShapes *all, const ZpModel *first, size_t member, const ZpShape *one);

/* Hang a member that was put on the one above it. */
void zp_many_hang(const ZpManyShapes *all, const ZpModel *first, size_t member);

/* Put a member that was put where its bodies in the plane are. */
void zp_many_stand(const ZpManyShapes *all, const ZpPlanar *plane, const ZpPose *pose, size_t member);

/* All that were put => the shape's arrays. */
void zp_many_give(const ZpManyShapes *all, ZpShape *shape);

/* Room for `capacity` shapes of all members; NULL if there is no memory. */
ZpShapes *zp_model_shapes(const ZpModel *model, size_t capacity);

/* The worst that materials see; places are lengths along the ribbon from the clip or clamp. */
typedef struct ZpMargins {
  double insulator, insulator_place; /* of the one that is nearest to its breakdown, V/m, m; NAN: there is none */
  double withstands;                 /* its dielectric strength, V/m */
  double liquid;                     /* V/m; 0 without electrodes */
  double stress, stress_place;       /* of the metal that is nearest to its yield, Pa, m; NAN: nothing was looked at */
  double yields;                     /* its yield stress, Pa */
} ZpMargins;

/* Of nothing. */
ZpMargins zp_margins_none(void);

/* In a shape that zp_shape_fill has filled. */
ZpMargins zp_margins_of(const ZpModel *model, const ZpShape *shape);

/* At the clip of two ribbons, where faces touch whatever the shape is, at `voltage` (V, any sign). */
ZpMargins zp_margins_at_clip(const ZpModel *model, double voltage);

/* The worse of both, quantity by quantity => worst. */
void zp_margins_join(ZpMargins *worst, ZpMargins other);

#endif
