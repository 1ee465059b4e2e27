/* How hot loops are compiled: for the plainest processor and again for wider vectors; the loader picks. Kernels are
 * static: gcc exports the choice among the versions of any other, though it is hidden.
 * All versions give the same bits, since loops sum in a fixed order and the build forbids contraction (ZP_UNCONTRACTED;
 * so does a strict standard, -std=c99). Sources of an FMU that are built without such a flag have the plainest version
 * alone, since the others would contract products and sums. */
#ifndef ZP_BASE_KERNEL_H
#define ZP_BASE_KERNEL_H

#include <stddef.h>

#ifdef ZP_KERNEL /* tests/bits.sh compiles for one processor at a time */
#elif defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__ELF__) && defined(__OPTIMIZE__) &&  \
    (defined(ZP_UNCONTRACTED) || defined(__STRICT_ANSI__)) && !defined(__SANITIZE_ADDRESS__) &&                        \
    !defined(__SANITIZE_THREAD__)
#define ZP_KERNEL __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define ZP_KERNEL
#endif

/* AddressSanitizer makes a loop that looks at each number ten times as slow. A ZP_CHECKED_WHOLE function is left alone
 * by sanitizers; it calls zp_check_numbers for each array before it goes through it, which finds the same faults at
 * once. */
#if defined(__SANITIZE_ADDRESS__)
void *__asan_region_is_poisoned(void *from, size_t size); /* the first byte that is; NULL if none is */
#define ZP_CHECKED_WHOLE __attribute__((no_sanitize("address", "undefined")))
static inline void zp_check_numbers(const double *number, size_t count) {
  const volatile double *forbidden = __asan_region_is_poisoned((void *)(size_t)number, count * sizeof *number);
  if (forbidden) (void)*forbidden; /* ends with a report */
}
#else
#define ZP_CHECKED_WHOLE
static inline void zp_check_numbers(const double *number, size_t count) {
  (void)number, (void)count;
}
#endif

/* Part of a kernel: compiled with it, for each processor. */
#define ZP_INLINE static inline __attribute__((always_inline))

/* Iterations of the loop that follows are independent. */
#define ZP_SIMD _Pragma("omp simd")

/* Partial sums of a reduction: kept apart and added in a fixed order, so that no compiler and no vector
 * width changes the result. */
enum { ZP_LANES = 8 };

/* Places of an array that kernels work through lane by lane without a remainder. */
static inline size_t zp_round_up(size_t count) {
  return (count + ZP_LANES - 1) / ZP_LANES * ZP_LANES;
}

static inline double zp_sum_lanes(const double *lane) {
  return ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7]));
}

static inline double zp_max_lanes(const double *lane) {
  double largest = lane[0];
  for (int k = 1; k < ZP_LANES; k++)
    largest = lane[k] > largest ? lane[k] : largest;
  return largest;
}

#endif
