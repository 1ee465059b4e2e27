#include "actuator/ties.h"

/* Tie the height of a node. */
static void add(ZpTies *ties, size_t member, size_t node, ZpTie tie) {
  tie.member = member;
  tie.coordinate = 2 * node + 1;
  ties->tie[ties->count++] = tie;
}

/* In series, the lower platform of each and the upper one of the next have one height, eq. (29.2). A load that all
 * share has one height, which the lower of two antagonists sees upside down, eq. (31.3). */
ZpTies zp_ties_of(const ZpModel *first) {
  const size_t members = first->members;
  const bool shared = zp_shares_load(first), opposed = zp_is_antagonist(first);
  ZpTies ties = {.shared = shared ? 1 : members - 1};
  for (size_t k = 0; k < members; k++) {
    const ZpTopology *t = &first[k].topology;
    const bool turned = opposed && k > 0;
    if (!shared && k > 0) add(&ties, k, zp_upper(t, t->platform.first), (ZpTie){.shared = k - 1, .factor = 1});
    if (shared || k + 1 < members)
      add(&ties, k, zp_load_node(t),
          (ZpTie){.shared = shared ? 0 : k, .factor = turned ? -1 : 1, .offset = turned ? -first->distance : 0});
  }
  return ties;
}
