/* The members of a series at rest: each alone, under all that hangs on it, eq. (29.1); and how they weigh when they
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
  size_t at[ZP_MOST_MEMBERS + 1]; /* where the equations of each begin, and how many all are */
  double total[ZP_MOST_MEMBERS];  /* mass of each with its link or load, kg */
  double *mass;                   /* [n] of equations, by coordinates from the upper platform of each on, kg, */
  double *vertical;               /* [n] and of those that are heights; else 0 */
  ZpVibrating vibrating;          /* for small motions about where they are, stiffnesses factored */
  void *memory;
} ZpChain;

/* Fill `chain` from the uppermost model of a series. It must not be moved, and is to be closed, also if this fails. */
ZpStatus zp_chain_open(ZpChain *chain, const ZpModel *uppermost, ZpError *err);
void zp_chain_close(ZpChain *chain);

/* Ask now and then whether to stop; has it been said? */
void zp_chain_watch(ZpChain *chain, bool (*stop)(void *caller), void *caller);
bool zp_chain_stopped(const ZpChain *chain);

/* Hang all without a voltage, stiffnesses factored. False if one has no stable equilibrium. */
bool zp_chain_hang(ZpChain *chain);

/* From there up to a voltage, V, without a jump, stiffnesses factored. False if one jumps before. */
bool zp_chain_raise(ZpChain *chain, double voltage);

/* What a slow change to a voltage leads to from the present states, which are near: along the branch, or where that has
 * ended by a fall to another one. False if a state was lost. */
bool zp_chain_change(ZpChain *chain, double voltage);

#endif
