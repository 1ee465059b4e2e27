/* What searches share: cases that are computed once, by several threads, and kept in the journal.
 *
 * A case has a number that follows from the search alone: which start, which step; which generation, which member. A
 * row of the journal counts for it if its hash says that it is of the same case. So a search that is resumed walks the
 * same way again, without computing what was done. */
#ifndef ZP_OPTIMIZE_SEARCH_H
#define ZP_OPTIMIZE_SEARCH_H

#include <pthread.h>
#include <stdatomic.h>

#include <zipact/campaign.h>

#include "campaign/journal.h"
#include "optimize/problem.h"

/* A case that is done. */
typedef struct ZpPoint {
  bool done;
  double z[ZP_VARIABLES_MOST];
  double value[ZP_GOALS_MOST + ZP_BOUNDS_MOST]; /* zp_goal_value of each goal */
  /* [goals][variables] its derivative by z; NAN where the study gives none. Only where derivatives are asked for */
  double slope[ZP_GOALS_MOST + ZP_BOUNDS_MOST][ZP_VARIABLES_MOST];
} ZpPoint;

typedef struct ZpSearch {
  const ZpScenario *scenario;
  const ZpCampaignOptions *options;
  ZpProblem problem;
  ZpActuatorDef def;
  ZpStudy study;
  ZpJournal *journal;
  uint64_t start;       /* zp_campaign_hash */
  size_t room;          /* cases: problem.evaluations, and with constraints as many for zp_search_exclude */
  uint64_t *old;        /* [room] hashes of the rows of an earlier process; 0: none */
  ZpPoint *point;       /* [room] */
  double excluded;      /* of zp_search_exclude; NAN before */
  bool derivatives;     /* cases have those of the study */
  atomic_bool stop;     /* asked to, or the machine failed */
  pthread_mutex_t lock; /* guards what follows, and the journal */
  ZpCampaignState state;
  double committed; /* when rows were brought to the disk, ms */
  ZpError err;      /* of the first thread that failed */
} ZpSearch;

/* Compute case `number`, below room, at place z, or take its row from the journal => the point. False if
 * the search is to stop. Several threads may call this, with different numbers. */
bool zp_search_evaluate(ZpSearch *search, size_t number, const double *z);

/* Call `work` with 0 .. count - 1, by as many threads as there are jobs, and ask options->progress meanwhile. */
ZpStatus zp_search_parallel(ZpSearch *search, size_t count, void (*work)(void *user, size_t index), void *user,
                            ZpError *err);

/* Points that fill the box, evenly: cases 0 .. count - 1. */
ZpStatus zp_search_sample(ZpSearch *search, size_t count, ZpError *err);

/* NLopt's searches from the best of `sampled` points, with cases up to problem.evaluations. */
ZpStatus zp_search_local(ZpSearch *search, size_t sampled, ZpError *err);

/* The same from case `start` alone, with cases `first` .. room - 1. */
ZpStatus zp_search_local_from(ZpSearch *search, size_t start, size_t first, ZpError *err);

/* Is there a design that satisfies all constraints, where no case does? With cases problem.evaluations .. room - 1: a
 * case that does, and better ones beyond it if there is one objective, or the share of the box of which is known that
 * it holds none => search->excluded. */
ZpStatus zp_search_exclude(ZpSearch *search, ZpError *err);

/* NSGA-II. */
ZpStatus zp_search_evolve(ZpSearch *search, ZpError *err);

#endif
