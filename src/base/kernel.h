/* How hot loops are compiled: for the plainest processor and again for wider vectors; the loader picks.
 * All versions give the same bits, since the build forbids contraction and loops sum in a fixed order. */
#ifndef ZP_BASE_KERNEL_H
#define ZP_BASE_KERNEL_H

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__OPTIMIZE__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define ZP_KERNEL __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define ZP_KERNEL
#endif

/* Iterations of the loop that follows are independent. */
#define ZP_SIMD _Pragma("omp simd")
#define ZP_SIMD_MAX(variable) _Pragma(ZP_QUOTE(omp simd reduction(max : variable)))
#define ZP_QUOTE(text) #text

/* Partial sums of a reduction: kept apart and added in a fixed order, so that no compiler and no vector
 * width changes the result. */
enum { ZP_LANES = 8 };

static inline double zp_sum_lanes(const double *lane) {
  return ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7]));
}

#endif
