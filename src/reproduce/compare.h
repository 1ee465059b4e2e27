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
  bool judged;       /* determined by the tolerance; false: independent of the numbers */
  const char *title; /* text on the page, after the count */
} ZpVerdictInfo;

const ZpVerdictInfo *zp_verdict_info(ZpVerdict verdict);

#define ZP_REASON(id, verdict, title, section, sentence) id,
typedef enum ZpReasonId {
#include "reproduce/reasons.def"
  ZP_REASON_COUNT
} ZpReasonId;
#undef ZP_REASON

typedef struct ZpReason {
  ZpVerdict verdict; /* verdict on numbers that differ for this reason */
  const char *title, *section, *sentence;
} ZpReason;

const ZpReason *zp_reason(ZpReasonId id);

/* A compared quantity: one table of the page. */
typedef struct ZpSubject {
  ZpQuantity quantity; /* published quantity */
  const char *place;   /* "Table I" */
  const char *title;   /* our quantity; no commas, because it is a cell of a CSV file */
  const char *unit;
  const char
      *source; /* origin of the published number: "paper", or "program" if the program of its authors was run again */
  double (*ours)(const ZpRuns *runs, const ZpPublished *published);
  ZpReasonId reason; /* possible reason of a difference */
  double (*slack)(
      const ZpPublished *published); /* uncertainty by the printed digits; NULL: one unit of the last digit */
  bool any_nodes;                    /* independent of N, compared once */
} ZpSubject;

/* All subjects; the last has no title. */
extern const ZpSubject zp_subjects[];

/* Our number agrees with the published one within this relative tolerance, or within the uncertainty of the printed
 * digits. */
#define ZP_AGREEMENT 0.005

/* One published number beside ours. */
typedef struct ZpComparison {
  const ZpSubject *subject;
  const ZpPublished *published;
  int nodes;         /* N; 0 if it does not matter */
  double ours;       /* in the unit of the published number; NAN: not run */
  double difference; /* ours / published - 1 */
  double tolerance; /* largest |ours - published| that counts as agreement, in the same unit; NAN if it is not judged */
  ZpVerdict verdict;
} ZpComparison;

/* Is the reason of its subject needed? Yes, if it was run and does not agree. */
bool zp_comparison_has_reason(const ZpComparison *comparison);

/* All comparisons, subject after subject. */
typedef struct ZpComparisons {
  ZpComparison *item; /* [count] */
  size_t count;
} ZpComparisons;

/* Number of comparisons with `verdict`. */
size_t zp_comparisons_count(const ZpComparisons *comparisons, ZpVerdict verdict);

/* To be freed (item) whatever the status is. */
ZpStatus zp_compare(const ZpRuns *runs, ZpComparisons *comparisons, ZpError *err);

#endif
