/* Sanitizers look for faults of memory and arithmetic, not for wrong numbers, and make code some ten times slower.
 * Under them a test runs every path of the code, but on coarser meshes, for fewer values and shorter times; checks of
 * accuracy that the coarser case would fail are left to the usual build. */
#ifndef ZP_TESTS_SANITIZED_H
#define ZP_TESTS_SANITIZED_H

#ifdef __has_feature
#define ZP_HAS_FEATURE(feature) __has_feature(feature)
#else
#define ZP_HAS_FEATURE(feature) 0
#endif

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || ZP_HAS_FEATURE(address_sanitizer) ||              \
    ZP_HAS_FEATURE(thread_sanitizer)
#define SANITIZED 1
#else
#define SANITIZED 0
#endif

/* A mesh, a time, a count, a step of a loop: that of the usual build, and that under sanitizers. */
#define FULL_OR(full, sanitized) (SANITIZED ? (sanitized) : (full))

#endif
