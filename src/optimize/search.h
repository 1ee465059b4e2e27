/* Shared by all searches: designs that are computed once, by several threads, and kept in the journal.
 *
 * A design is one case, or where keys have distributions one for each sample: the same samples for all designs. The
 * number of a design follows from the search alone: which start and step; which generation and member. A row of the
 * journal counts for a case if its hash agrees. So a resumed search repeats the same path without computing finished
 * cases again. */
#ifndef ZP_OPTIMIZE_SEARCH_H
#define ZP_OPTIMIZE_SEARCH_H

#include <pthread.h>
#include <stdatomic.h>

#include <zipact/campaign.h>

#include "campaign/journal.h"
#include "def/def.h"
#include "optimize/problem.h"

/* A finished design. */
typedef struct ZpPoint {
  bool done;
  double z[ZP_VARIABLES_MOST];
  double value[ZP_GOALS_MOST + ZP_BOUNDS_MOST]; /* zp_goal_value of each goal */
  /* [goals][variables] its derivative with respect to z; NAN if the study has none. Only if derivatives are requested
   */
  double slope[ZP_GOALS_MOST + ZP_BOUNDS_MOST][ZP_VARIABLES_MOST];
} ZpPoint;

typedef struct ZpSearch {
  const ZpScenario *scenario;
  const ZpCampaignOptions *options;
  ZpProblem problem;
  ZpScenario *samples; /* the scenario with the variables at one value: its cases are the samples of a design */
  ZpActuatorDef def;   /* of the first sample */
  ZpStudy study;
  ZpJournal *journal;
  uint64_t start;       /* zp_campaign_hash */
  size_t room;          /* number of designs: problem.evaluations, and with constraints as many for zp_search_exclude */
  uint64_t *old;        /* [room * samples] hashes of the rows of an earlier process; 0: none */
  ZpPoint *point;       /* [room] */
  double excluded;      /* result of zp_search_exclude; NAN before */
  bool derivatives;     /* the cases have the derivatives of the study */
  atomic_bool stop;     /* on request, or because the machine failed */
  pthread_mutex_t lock; /* guards the members below, and the journal */
  ZpCampaignState state;
  double committed; /* time of the last commit, ms */
  ZpError err;      /* error of the first thread that failed */
} ZpSearch;

/* Give the search its problem and its samples. ZP_BAD_INPUT as zp_optimize. */
ZpStatus zp_search_begin(ZpSearch *search, ZpError *err);

/* Free what zp_search_begin has made. */
void zp_search_end(ZpSearch *search);

/* Samples of a design. */
size_t zp_search_samples(const ZpSearch *search);

/* Compute design `number`, below room, at position z, or take its rows from the journal => the point. False if the
 * search must stop. Several threads may call this, with different numbers. */
bool zp_search_evaluate(ZpSearch *search, size_t number, const double *z);

/* Call `work` with 0 .. count - 1 in as many threads as there are jobs, and call options->progress meanwhile. */
ZpStatus zp_search_parallel(ZpSearch *search, size_t count, void (*work)(void *user, size_t index), void *user,
                            ZpError *err);

/* Compute points that fill the box evenly: cases 0 .. count - 1. */
ZpStatus zp_search_sample(ZpSearch *search, size_t count, ZpError *err);

/* Run NLopt's searches from the best of `sampled` points, with cases up to problem.evaluations. */
ZpStatus zp_search_local(ZpSearch *search, size_t sampled, ZpError *err);

/* Run one of NLopt's searches from case `start`, with cases `first` .. room - 1. */
ZpStatus zp_search_local_from(ZpSearch *search, size_t start, size_t first, ZpError *err);

/* Is there a design that satisfies all constraints, if no case does? Takes cases problem.evaluations .. room - 1: finds
 * such a case, and better ones beyond it if there is one objective, or the share of the box that contains none =>
 * search->excluded. */
ZpStatus zp_search_exclude(ZpSearch *search, ZpError *err);

/* NSGA-II. */
ZpStatus zp_search_evolve(ZpSearch *search, ZpError *err);

#endif
