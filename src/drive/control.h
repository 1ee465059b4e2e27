/* A sampled controller: proportional and integral, with a boost where it is asked for. It measures with noise, its
 * output is held between samples, limited, and comes after a delay. Knows nothing of what it controls. docs/theory.md,
 * section 28. */
#ifndef ZP_DRIVE_CONTROL_H
#define ZP_DRIVE_CONTROL_H

#include "def/def.h"

/* Longest delay, in periods. */
enum { ZP_CONTROL_DELAY = 8 };

typedef struct ZpControl {
  ZpControlKind kind;
  double sense;                  /* 1: closing makes the signal smaller; -1: larger */
  double proportional, integral; /* V per unit of the signal; the same per second */
  double period, delay;          /* s */
  double boost, band;            /* V; fraction of the setpoint */
  double highest;                /* output is 0 to this, V */
  double noise;                  /* standard deviation of a sample, in the unit of the signal */
  int seed;
} ZpControl;

/* Evolving part of a controller. Sample k is due at k period, its output a delay later. */
typedef struct ZpControlState {
  double taken;                         /* samples so far, a whole number, */
  double given;                         /* and outputs */
  double integral;                      /* of the error times its gain, V */
  double measured;                      /* signal of the last sample with its noise; NAN: there is none */
  double pending[ZP_CONTROL_DELAY + 1]; /* output of sample k at k modulo the length, V */
} ZpControlState;

ZpControl zp_control_of(const ZpActuatorDef *def);

/* Before the first sample; and the same from time t on, whatever was before: what is pending is dropped, the integral
 * stays. Without a controller nothing of an earlier one is left. */
ZpControlState zp_control_start(void);
void zp_control_restart(const ZpControl *c, double t, ZpControlState *state);

/* Can a controller be in this state at time t? Samples are taken when they are due, outputs follow them. */
bool zp_control_fits(const ZpControl *c, double t, const ZpControlState *state);

/* When the next sample is due, and the next output; INFINITY where none is pending. s */
double zp_control_sample_time(const ZpControl *c, const ZpControlState *state);
double zp_control_output_time(const ZpControl *c, const ZpControlState *state);

/* The next sample: a signal and its setpoint => an output that is pending. Eqs. (28.1) to (28.4). */
void zp_control_sample(const ZpControl *c, double setpoint, double signal, ZpControlState *state);

/* The output that is due, V. */
double zp_control_output(ZpControlState *state);

#endif
