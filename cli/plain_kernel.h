/* A plain implementation of the paper's mechanics, to measure ours against. */
#ifndef ZP_CLI_PLAIN_KERNEL_H
#define ZP_CLI_PLAIN_KERNEL_H

typedef struct PlainKernel {
  double l, K_D, K_S, mass, gravity, drag, dt; /* SI */
} PlainKernel;

/* Let two straight ribbons of `nodes` particles, held at both ends, sag for `steps` steps. => height of a
 * middle particle, m, so that no compiler can leave the work out; NAN if there is no memory. */
double plain_kernel_run(const PlainKernel *kernel, int nodes, long steps);

#endif
