/* A motion in time, measured: what it costs, and how far it is from a reference. */
#ifndef ZP_CLI_MOTION_H
#define ZP_CLI_MOTION_H

#include <zipact/zipact.h>

/* Height and velocity of the load (the last node of the lower ribbon) at 0, interval, 2 interval ... */
typedef struct Trajectory {
  size_t rows;
  double interval;        /* s */
  const double (*row)[2]; /* m, m/s */
} Trajectory;

typedef struct Motion {
  double seconds; /* of one thread per simulated second, the stepping alone */
  double steps;   /* per simulated second */
  double rms;     /* distance from the reference over its time, m; NAN without one */
  double cpu;     /* spent on it all, s */
} Motion;

/* CPU time of this process, s. */
double motion_clock(void);

/* Run to def->solver.end_time, once to be compared with `reference` (NULL: none), short runs several times: the
 * quickest counts. `table` as zp_model_create_driven. */
ZpStatus motion_measure(const ZpActuatorDef *def, const ZpDriveTable *table, const Trajectory *reference,
                        Motion *motion, ZpError *err);

/* Height and velocity at the times of a trajectory of `rows` rows => row. */
ZpStatus motion_record(const ZpActuatorDef *def, size_t rows, double interval, double (*row)[2], ZpError *err);

/* A cantilever of 45 mm x 12.7 mm x 100 um steel, 2 g at its tip, released straight, for 0.1 s: one swing of 6.05 mm.
 */
ZpStatus motion_swing(int nodes, bool implicit, ZpActuatorDef *def, ZpError *err);

/* Its converged trajectory (bench/run.sh makes swing.def), and what errors of it are relative to, m. */
Trajectory motion_swing_reference(void);
extern const double motion_swing_height;

/* The default actuator, its zip for 70 ms under 10 kV. */
ZpStatus motion_zip(int nodes, bool implicit, ZpActuatorDef *def, ZpError *err);

#endif
