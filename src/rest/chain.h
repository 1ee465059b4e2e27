/* The members of a series at rest: each alone, under all that hangs on it, eq. (29.1); and their mass matrix when they
 * move together, eq. (29.3). */
#ifndef ZP_REST_CHAIN_H
#define ZP_REST_CHAIN_H

#include "def/check.h"
#include "rest/rest.h"
#include "rest/vibration.h"

typedef struct ZpChain {
  size_t count;
  ZpModel *alone[ZP_MOST_MEMBERS];
  ZpRest of[ZP_MOST_MEMBERS];     /* from the uppermost down */
  size_t at[ZP_MOST_MEMBERS + 1]; /* index of the first equation of each, and the number of all equations */
  double total[ZP_MOST_MEMBERS];  /* mass of each with its link or load, kg */
  double *mass;                   /* [n] by equations, for coordinates relative to the upper platform of each, kg */
  double *vertical;               /* [n] the same for equations that are heights; else 0 */
  ZpVibrating vibrating;          /* for small motions about the present states, stiffnesses factored */
  void *memory;
} ZpChain;

/* Fill `chain` from the uppermost model of a series. It must not be moved, and must be closed, also if this fails. */
ZpStatus zp_chain_open(ZpChain *chain, const ZpModel *uppermost, ZpError *err);
void zp_chain_close(ZpChain *chain);

/* Call `stop` now and then; has it returned true? */
void zp_chain_watch(ZpChain *chain, bool (*stop)(void *caller), void *caller);
bool zp_chain_stopped(const ZpChain *chain);

/* Go to the hanging states without voltage, stiffnesses factored. False if one has no stable equilibrium. */
bool zp_chain_hang(ZpChain *chain);

/* Then raise the voltage, V, without a jump, stiffnesses factored. False if one jumps before. */
bool zp_chain_raise(ZpChain *chain, double voltage);

/* Change the voltage slowly from the present states, which are close: along the branch, or if the branch ends by a fall
 * to another one. False if a state was lost. */
bool zp_chain_change(ZpChain *chain, double voltage);

#endif
