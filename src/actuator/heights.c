#include "actuator/heights.h"

#include <string.h>

#include "base/memory.h"

/* Bodies that move, numbered => how many. */
static size_t number(const ZpNetwork *n, size_t *unknown) {
  size_t count = 0;
  for (size_t b = 0; b < n->bodies; b++)
    if (!n->body[b].held) unknown[b] = count++;
  return count;
}

/* The ends of each member that move, as unknowns which meet => [members] cliques over `ends` [2 members]. */
static void pair(const ZpNetwork *n, const size_t *unknown, ZpClique *clique, size_t *ends) {
  for (size_t k = 0; k < n->members; k++) {
    const size_t body[] = {n->ends[k].upper, n->ends[k].lower};
    clique[k] = (ZpClique){0, ends + 2 * k};
    for (size_t e = 0; e < 2; e++)
      if (!n->body[body[e]].held) ends[2 * k + clique[k].count++] = unknown[body[e]];
  }
}

static bool find_sparsity(ZpHeights *h, size_t unknowns) {
  const ZpNetwork *n = h->network;
  ZpClique *clique = zp_calloc(n->members, sizeof *clique);
  size_t *ends = zp_calloc(2 * n->members, sizeof *ends);
  bool made = clique && ends;
  if (made) pair(n, h->unknown, clique, ends);
  made = made && zp_sparsity_create(unknowns, clique, n->members, &h->sparsity);
  zp_free(clique);
  zp_free(ends);
  return made;
}

static size_t reserve(ZpHeights *h, size_t unknowns, void *block) {
  ZpArena arena = {block, 0};
  zp_sparse_reserve(&h->matrix, &h->sparsity, &arena);
  h->right = zp_arena_take(&arena, unknowns);
  h->reach = zp_arena_take(&arena, h->network->members);
  h->weight = zp_arena_take(&arena, h->network->members);
  h->y = zp_arena_take(&arena, h->network->bodies);
  return arena.used;
}

bool zp_heights_create(const ZpNetwork *network, ZpHeights *h) {
  *h = (ZpHeights){.network = network, .unknown = zp_calloc(network->bodies, sizeof *h->unknown)};
  if (!h->unknown) return false;
  const size_t unknowns = number(network, h->unknown);
  if (!find_sparsity(h, unknowns)) return false;
  h->memory = zp_calloc(1, reserve(h, unknowns, NULL));
  if (!h->memory) return false;
  reserve(h, unknowns, h->memory);
  for (size_t k = 0; k < network->members; k++)
    h->weight[k] = 1;
  return true;
}

void zp_heights_destroy(ZpHeights *h) {
  zp_sparsity_destroy(&h->sparsity);
  zp_free(h->unknown);
  zp_free(h->memory);
  *h = (ZpHeights){0};
}

/* One end of a member: its part of the equations. */
static void add_end(ZpHeights *h, size_t member, size_t end, double nearer) {
  const ZpNetwork *n = h->network;
  const size_t body[] = {n->ends[member].upper, n->ends[member].lower};
  const ZpBody *other = &n->body[body[1 - end]];
  if (n->body[body[end]].held) return;
  const double w = h->weight[member], down = zp_network_sign(n, member) * h->reach[member];
  const size_t i = h->unknown[body[end]];
  *zp_sparse_at(&h->matrix, i, i) += w;
  h->right[i] += end == 0 ? w * down : -w * down;
  if (other->held)
    h->right[i] += w * nearer * other->y;
  else
    *zp_sparse_at(&h->matrix, i, h->unknown[body[1 - end]]) -= w;
}

/* The sum of weight (y_upper - y_lower - reach)^2 is least. A member that is upside down has its upper body below. */
void zp_heights_find(ZpHeights *h, double nearer) {
  const ZpNetwork *n = h->network;
  zp_sparse_clear(&h->matrix);
  memset(h->right, 0, h->sparsity.n * sizeof *h->right);
  for (size_t k = 0; k < n->members; k++)
    for (size_t end = 0; end < 2; end++)
      add_end(h, k, end, nearer);
  zp_sparse_factor(&h->matrix);
  zp_sparse_solve(&h->matrix, h->right);
  for (size_t b = 0; b < n->bodies; b++)
    h->y[b] = n->body[b].held ? nearer * n->body[b].y : h->right[h->unknown[b]];
}
