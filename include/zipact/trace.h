/* Signals of a run with their derivatives by keys, at any time of it: kept at each step of the solver and interpolated
 * in between. So it does not matter where the times are at which a program asks. */
#ifndef ZIPACT_TRACE_H
#define ZIPACT_TRACE_H

#include <stddef.h>

#include <zipact/api.h>
#include <zipact/model.h>
#include <zipact/sim.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { ZP_TRACE_SIGNALS = 8, ZP_TRACE_KEYS = 8 }; /* at most */

typedef struct ZpTrace ZpTrace;

/* Run a model from its start until `end`, s, above 0, and keep these signals (names of signals, at most
 * ZP_TRACE_SIGNALS) with their derivatives by these keys (numbers of keys, at most ZP_TRACE_KEYS; 0: none). A run that
 * fails keeps what it has until then; keys without derivatives have NAN. To be destroyed. ZP_BAD_INPUT: an argument is
 * wrong; ZP_MACHINE: no memory. Source: docs/theory.md, section 20. */
ZP_API ZpStatus zp_trace_create(const ZpModel *model, const char *const *signal, size_t signals, const int *key,
                                size_t keys, double end, const ZpHooks *hooks, ZpTrace **trace, ZpError *err);
ZP_API void zp_trace_destroy(ZpTrace *trace);

/* A signal at a time, in SI: its value, its rate per second, and its derivatives by the keys, per their SI units. */
typedef struct ZpTraceValue {
  double value, rate, by_key[ZP_TRACE_KEYS];
} ZpTraceValue;

/* The `signal`-th signal at a time of the run, s: before its start as there, after its end NAN. */
ZP_API ZpTraceValue zp_trace_at(const ZpTrace *trace, size_t signal, double time);

#ifdef __cplusplus
}
#endif

#endif
