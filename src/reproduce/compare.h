/* Published numbers beside ours. */
#ifndef ZP_REPRODUCE_COMPARE_H
#define ZP_REPRODUCE_COMPARE_H

#include "reproduce/reproduce.h"
#include "reproduce/runs.h"

#define ZP_VERDICT(id, word, judged, title) id,
typedef enum ZpVerdict {
#include "reproduce/verdicts.def"
  ZP_VERDICT_COUNT
} ZpVerdict;
#undef ZP_VERDICT

typedef struct ZpVerdictInfo {
  const char *word;  /* in files */
  bool judged;       /* by the tolerance; false: given whatever the numbers are */
  const char *title; /* on the page, after their count */
} ZpVerdictInfo;

const ZpVerdictInfo *zp_verdict_info(ZpVerdict verdict);

#define ZP_REASON(id, verdict, title, section, sentence) id,
typedef enum ZpReasonId {
#include "reproduce/reasons.def"
  ZP_REASON_COUNT
} ZpReasonId;
#undef ZP_REASON

typedef struct ZpReason {
  ZpVerdict verdict; /* on numbers that differ for this reason */
  const char *title, *section, *sentence;
} ZpReason;

const ZpReason *zp_reason(ZpReasonId id);

/* A quantity that is compared: one table of the page. */
typedef struct ZpSubject {
  ZpQuantity quantity; /* what is published */
  const char *place;   /* "Table I" */
  const char *title;   /* what ours is; no commas, since it stands in a CSV */
  const char *unit;
  const char *source; /* of what is published: "paper", or "program" where its authors' program was run again */
  double (*ours)(const ZpRuns *runs, const ZpPublished *published);
  ZpReasonId reason;                             /* why it may differ */
  double (*slack)(const ZpPublished *published); /* that the printed digits leave; NULL: one of the last digit */
  bool any_nodes;                                /* the same for all N, and compared once */
} ZpSubject;

/* All subjects; the last has no title. */
extern const ZpSubject zp_subjects[];

/* Ours agrees with what is published within this, relative, or within what the printed digits leave. */
#define ZP_AGREEMENT 0.005

/* One published number beside ours. */
typedef struct ZpComparison {
  const ZpSubject *subject;
  const ZpPublished *published;
  int nodes;         /* N; 0 where it does not matter */
  double ours;       /* in the unit of the published number; NAN: not run */
  double difference; /* ours / published - 1 */
  double tolerance;  /* |ours - published| that still agrees, in the same unit; NAN where nothing is judged */
  ZpVerdict verdict;
} ZpComparison;

/* Is the reason of its subject needed? Yes, if it was run and does not agree. */
bool zp_comparison_has_reason(const ZpComparison *comparison);

/* All comparisons, subject after subject. */
typedef struct ZpComparisons {
  ZpComparison *item; /* [count] */
  size_t count;
} ZpComparisons;

/* How many of them came to `verdict`. */
size_t zp_comparisons_count(const ZpComparisons *comparisons, ZpVerdict verdict);

/* To be freed (item) whatever the status. */
ZpStatus zp_compare(const ZpRuns *runs, ZpComparisons *comparisons, ZpError *err);

#endif
