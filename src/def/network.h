/* The bodies of a system, and the members between them. docs/theory.md, sections 29 and 31. */
#ifndef ZP_DEF_NETWORK_H
#define ZP_DEF_NETWORK_H

#include "def/def.h"

/* Rigid, and free to move up and down unless it is held. Its height is 0 where all members above it are closed. */
typedef struct ZpBody {
  bool held;
  double y;      /* of one that is held, m */
  size_t leader; /* of one that moves: the first member with its lower end there, or else with its upper one */
} ZpBody;

/* The bodies at the ends of a member. */
typedef struct ZpEnds {
  size_t upper, lower;
  bool turned;    /* it is upside down: it opens upwards */
  bool on_path;   /* it is one of those that lead from the frame to the load */
  size_t depth;   /* where all hang: members between it and what is held */
  size_t abreast; /* members between these two bodies that open the same way, this one included */
  size_t port;    /* the first member of those on its port, which have one voltage and one source */
  size_t next;    /* the next one on it; 0: none */
} ZpEnds;

/* A spring between two bodies; the first one is the upper. */
typedef struct ZpLink {
  size_t body[2];
  double stiffness; /* N/m */
  double rest;      /* difference of their heights without a force, m */
  ZpSpringKind kind;
} ZpLink;

typedef struct ZpNetwork {
  size_t bodies, members, springs;
  size_t load;    /* the body that the load hangs on; `bodies`: none, as each has its own */
  size_t watched; /* the body that study isometric holds; 0: none */
  bool pulled;    /* a force acts on a body */
  bool opposed;   /* a member is upside down: it pulls the load the other way */
  bool hangs;     /* each body that moves hangs on one member alone, so that weights give the force in all members */
  ZpBody *body;   /* [bodies]; the first one is the frame, to which the uppermost members are fixed */
  ZpEnds *ends;   /* [members] */
  ZpLink *spring; /* [springs] */
  size_t *order;  /* [members] from the frame on: where all hang, a member comes after the one that it hangs on */
} ZpNetwork;

/* That of an actuator, a stack or a network; NULL if there is no memory. Freed as one block, by zp_free. */
ZpNetwork *zp_network_create(const ZpActuatorDef *def);

/* Are two members side by side: between the same bodies, and opening the same way? */
bool zp_network_abreast(const ZpNetwork *network, size_t one, size_t other);

/* Do the same bodies hold the same members? Mounts may be at other heights. */
bool zp_network_alike(const ZpNetwork *one, const ZpNetwork *other);

/* How far below the frame the lowest mount is, m; 0: there is none. */
double zp_network_depth(const ZpNetwork *network);

/* A member's own frame is upright or upside down, and begins at its upper body if that is held, else at the frame. */
static inline double zp_network_sign(const ZpNetwork *network, size_t member) {
  return network->ends[member].turned ? -1 : 1;
}

static inline double zp_network_origin(const ZpNetwork *network, size_t member) {
  const ZpBody *upper = &network->body[network->ends[member].upper];
  return upper->held ? upper->y : 0;
}

#endif
