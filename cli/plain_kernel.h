/* A plain implementation of the mechanics of the paper, for comparison. */
#ifndef ZP_CLI_PLAIN_KERNEL_H
#define ZP_CLI_PLAIN_KERNEL_H

typedef struct PlainKernel {
  double l, K_D, K_S, mass, gravity, drag, dt; /* SI */
} PlainKernel;

/* Let two straight ribbons of `nodes` particles, held at both ends, sag for `steps` steps. => height of a middle
 * particle, m, so that compilers cannot omit the work; NAN if there is no memory. */
double plain_kernel_run(const PlainKernel *kernel, int nodes, long steps);

#endif
