/* A measured motion in time: its cost, and its distance from a reference. */
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
  double seconds; /* CPU time of one thread per simulated second, of the steps alone */
  double steps;   /* per simulated second */
  double rms;     /* rms distance from the reference, m; NAN without one */
  double cpu;     /* total CPU time, s */
} Motion;

/* CPU time of this process, s. */
double motion_clock(void);

/* Run to def->solver.end_time, once for comparison with `reference` (NULL: none), short runs several times: the fastest
 * counts. `table` as in zp_model_create_driven. */
ZpStatus motion_measure(const ZpActuatorDef *def, const ZpDriveTable *table, const Trajectory *reference,
                        Motion *motion, ZpError *err);

/* Height and velocity at the times of a trajectory of `rows` rows => row. */
ZpStatus motion_record(const ZpActuatorDef *def, size_t rows, double interval, double (*row)[2], ZpError *err);

/* A cantilever of 45 mm x 12.7 mm x 100 um steel, 2 g at its tip, released straight, for 0.1 s: one swing of 6.05 mm.
 */
ZpStatus motion_swing(int nodes, bool implicit, ZpActuatorDef *def, ZpError *err);

/* Its converged trajectory (bench/run.sh makes swing.def), and the height to which its errors refer, m. */
Trajectory motion_swing_reference(void);
extern const double motion_swing_height;

/* The default actuator zips for 70 ms under 10 kV. */
ZpStatus motion_zip(int nodes, bool implicit, ZpActuatorDef *def, ZpError *err);

#endif
