/* Derivatives of a whole run by keys, forward through its accepted steps. Beside the run go actuators near it, whose
 * key is a little larger or smaller, each at the run's state plus its share of the derivatives; after a step these
 * follow from where they end. docs/theory.md, section 20. */
#ifndef ZP_RUN_SENSITIVITY_H
#define ZP_RUN_SENSITIVITY_H

#include "run/run.h"
#include "system/by_key.h"

/* A current of the run, its time and its derivative. */
typedef struct ZpCurrentRate {
  double t, I, rate;
} ZpCurrentRate;

/* Of one key. */
typedef struct ZpKeyRates {
  ZpFiniteDifference by;
  ZpSim *near[ZP_DIFFERENCE_POINTS]; /* NULL where the point is not used */
  double from[ZP_DIFFERENCE_POINTS]; /* their last corner */
  double to[ZP_DIFFERENCE_POINTS];   /* and their next one, s */
  double late;                       /* derivative of the end of the step, beyond that by corners, s */
  bool splits;                       /* it moves one of several inputs that have the next corner together */
  ZpState **rate; /* [members] derivatives of the numbers of the run's states; of their time where a key moves it */
  double square, peak; /* of the integral of the current's square and of its largest size so far (supply_coupling.h) */
  ZpCurrentRate last[2]; /* the currents of the last two steps, the later one first; t is NAN before there is one */
  bool at_peak;          /* the later one is the largest so far */
  double lost;           /* when they ceased to exist, s; INFINITY: they have not */
  const char *cause;     /* and why */
} ZpKeyRates;

typedef struct ZpRunSensitivity {
  ZpSim *sim;      /* the run */
  ZpKeyRates *key; /* [keys] */
  size_t keys;
  int64_t taken;       /* its steps until the step under way begins */
  double from, to;     /* its last corner and its next one, s */
  ZpSupplyEvent event; /* where a slew rate begins or ceases to limit a supply in that step */
  bool *wet;           /* [members N] stations that the liquid of a bead covers */
  double *work;        /* [6 n] */
  double *motion;      /* [n] */
} ZpRunSensitivity;

/* Follow a run, which has not begun, by these keys; in any case to be closed, before the run. ZP_BAD_INPUT names a key
 * about which there are no actuators near, ZP_MACHINE: no memory. */
ZpStatus zp_run_sensitivity_open(ZpRunSensitivity *rates, ZpSim *sim, const int *key, size_t keys, ZpError *err);
void zp_run_sensitivity_close(ZpRunSensitivity *rates);

/* A step begins, before controllers act; then nothing but a motion is left until the next corner of a run until
 * end_time, s; the step has ended. */
void zp_run_sensitivity_begin(ZpRunSensitivity *rates);
void zp_run_sensitivity_look_ahead(ZpRunSensitivity *rates, double end_time);
void zp_run_sensitivity_follow(ZpRunSensitivity *rates);

/* The derivative by the k-th key of a number that a simulation has now. Once it has ceased to exist (key[k].lost),
 * only of numbers that have been kept from before, such as the zip time. */
double zp_run_rate_of(const ZpRunSensitivity *rates, size_t k, double (*number)(ZpSim *sim, const void *user),
                      const void *user);

/* The derivative by the k-th key of the peak and rms current of the run until now, behind a supply. */
ZpCurrents zp_run_rate_of_currents(const ZpRunSensitivity *rates, size_t k);

#endif
