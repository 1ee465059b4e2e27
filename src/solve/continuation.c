/* Letters: q coordinates, m parameter, both scaled; s arc length; K = -dr/dq; (t, t_m) direction.
 *   tangent      K t = r_m t_m
 *   corrector    K dq - r_m dm = r,   t . dq + t_m dm = s - t . (q - q0) - t_m (m - m0)
 */
#include "solve/continuation.h"

#include <math.h>
#include <string.h>

static const double shortest_step = 1e-8;
static const double sharpest_turn = 0.7; /* cosine: a step that turns by more would lose its way */
static const double corner_step = 1e-7;  /* what still turns more within it is a corner, where the stiffness jumps */
enum { MOST_CORRECTIONS = 25, EASY_CORRECTIONS = 4, MOST_REFRESHES = 20 };

void zp_branch_reserve(ZpBranch *b, const ZpBranchSystem *system, ZpNewtonWork *newton, ZpArena *arena) {
  size_t n = system->at_rest.n, saved = (system->save_size + sizeof(double) - 1) / sizeof(double);
  b->system = system;
  b->newton = newton;
  b->a = zp_arena_take(arena, n);
  b->b = zp_arena_take(arena, n);
  b->q = zp_arena_take(arena, n);
  b->q_start = zp_arena_take(arena, n);
  b->direction = zp_arena_take(arena, n);
  b->direction_saved = zp_arena_take(arena, n);
  b->direction_after = zp_arena_take(arena, n);
  b->saved = zp_arena_take(arena, saved);
  b->saved_before = zp_arena_take(arena, saved);
}

/* Is the determinant of the factored stiffness negative, for motions in which equal parts and systems move alike, as
 * they do along a branch? Where others change its sign another branch crosses this one, which goes on. The common
 * unknowns are coupled to each part in the same way. So each eigenvalue of a part alone occurs once for each part, and
 * at most one more belongs to them together. */
static bool is_negative(ZpBranch *b) {
  const ZpBranchSystem *sys = b->system;
  size_t negative = zp_arrow_negative(&b->newton->K) / (sys->alike > 0 ? sys->alike : 1),
         more = sys->at_rest.parts.more;
  return (negative + more) / (1 + more) % 2 == 1;
}

/* K^-1 x => x, of which only what moves equal systems alike. Where another branch crosses, rounding would lead to it.
 */
static void solve(ZpBranch *b, double *x) {
  const size_t systems = b->system->alike, each = systems > 0 ? b->system->at_rest.n / systems : 0;
  zp_arrow_solve(&b->newton->K, x);
  for (size_t i = 0; i < each; i++) {
    double mean = 0;
    for (size_t k = 0; k < systems; k++)
      mean += x[k * each + i] / (double)systems;
    for (size_t k = 0; k < systems; k++)
      x[k * each + i] = mean;
  }
}

/* Tangent of the branch at the present point, of length 1 and towards increasing m => direction. => is the determinant
 * of the stiffness negative? Neither 0 nor 1: there is no tangent. */
static int find_tangent(ZpBranch *b) {
  const ZpBranchSystem *sys = b->system;
  const ZpStaticSystem *rest = &sys->at_rest;
  size_t n = rest->n;
  if (rest->residual(rest->self, b->newton->r, NULL) != ZP_END_FOUND) return -1;
  rest->stiffness(rest->self, &b->newton->K, NULL);
  sys->sensitivity(rest->self, b->a);
  if (!zp_arrow_factor(&b->newton->K)) return -1;
  solve(b, b->a);
  double to_scaled = sys->m_scale / sys->q_scale;
  for (size_t i = 0; i < n; i++)
    b->a[i] *= to_scaled;
  double length = sqrt(zp_static_dot(rest, b->a, b->a) + 1);
  b->a_m = 1 / length;
  for (size_t i = 0; i < n; i++)
    b->a[i] *= b->a_m;
  return isfinite(length) ? is_negative(b) : -1;
}

/* The tangent => direction, on this side. */
static void face(ZpBranch *b, bool growing) {
  double sign = growing ? 1 : -1;
  for (size_t i = 0; i < b->system->at_rest.n; i++)
    b->direction[i] = sign * b->a[i];
  b->direction_m = sign * b->a_m;
}

/* Direction of the branch at the present point, of length 1, on the side of the last one. Across a sharp fold that side
 * is the way back; the determinant of the stiffness decides, eq. (10.2). => cosine of the angle by which it has turned;
 * 0 if there is no direction. */
static double find_direction(ZpBranch *b) {
  int negative = find_tangent(b);
  if (negative < 0) return 0;
  double cosine = zp_static_dot(&b->system->at_rest, b->a, b->direction) + b->a_m * b->direction_m;
  face(b, cosine >= 0);
  b->reversed = b->along != ((cosine >= 0) != (negative == 1));
  return fabs(cosine);
}

bool zp_branch_start(ZpBranch *b, bool growing, double first, double longest, double tolerance) {
  b->longest_m_step = 0.025;
  b->step = first;
  b->longest_step = longest;
  b->tolerance = tolerance;
  memset(b->direction, 0, b->system->at_rest.n * sizeof *b->direction);
  b->direction_m = growing ? 1 : -1;
  b->along = true; /* as good as false: the direction found says which */
  if (!(find_direction(b) > 0)) return false;
  b->along = b->along != b->reversed;
  return true;
}

static bool refresh(const ZpStaticSystem *rest) {
  return !rest->refresh || rest->refresh(rest->self) == ZP_END_FOUND;
}

/* Arc length of the point in b->q along the direction from q_start, m_start. */
static double arc_length(const ZpBranch *b, double m_start) {
  const ZpBranchSystem *sys = b->system;
  const ZpParts *parts = &sys->at_rest.parts;
  double gone = (zp_branch_parameter(sys) - m_start) / sys->m_scale * b->direction_m;
  for (size_t i = 0; i < sys->at_rest.n; i++)
    gone += b->direction[i] * (b->q[i] - b->q_start[i]) / sys->q_scale;
  double common = zp_parts_dot(parts, b->direction, b->q) - zp_parts_dot(parts, b->direction, b->q_start);
  return gone + common / sys->q_scale;
}

/* Corrections that alternate between the two sides of a corner at which the branch turns by more than a right angle.
 * There is then no solution at that arc length: det(K, -dr/dm; t) has opposite signs on the two sides. */
typedef struct Sides {
  bool first, last; /* is it negative? at the first correction, at the last */
  bool both;        /* it was either */
} Sides;

static void look_at_side(Sides *sides, bool negative, int corrections) {
  if (corrections == 0) *sides = (Sides){negative, negative, false};
  sides->both = sides->both || negative != sides->first;
  sides->last = negative;
}

/* Correct the present point onto the branch at arc length `s` from q_start, m_start. => corrections, the most between
 * two refreshes; -1: failed. If a corner is the reason, the present point is beyond it. */
static int correct(ZpBranch *b, double s, double m_start) {
  const ZpBranchSystem *sys = b->system;
  const ZpStaticSystem *rest = &sys->at_rest;
  size_t n = rest->n;
  bool fresh = refresh(rest);
  int refreshes = 1, effort = 0;
  Sides sides = {false, false, false};
  ZpClosing closing;
  zp_closing_start(&closing);
  if (!fresh) return -1;
  for (int k = 0; k <= MOST_CORRECTIONS;) {
    double left;
    if (rest->residual(rest->self, b->newton->r, &left) != ZP_END_FOUND) return -1;
    sys->position(rest->self, b->q);
    double gone = arc_length(b, m_start);
    bool close = zp_closing_done(&closing, left, b->tolerance), to_and_fro = sides.both && closing.stalled >= 3;
    if (to_and_fro && sides.last == sides.first) return -1;
    close = close || (!to_and_fro && zp_closing_stalled(&closing, left, b->tolerance));
    if (close && fabs(s - gone) < 1e-3 * s) {
      effort = k > effort ? k : effort;
      if (fresh) return effort;
      fresh = refreshes++ < MOST_REFRESHES && refresh(rest);
      if (!fresh) return -1;
      zp_closing_renew(&closing);
      k = 0;
      continue;
    }
    rest->stiffness(rest->self, &b->newton->K, b->newton->r);
    sys->sensitivity(rest->self, b->b);
    if (!zp_arrow_factor(&b->newton->K)) return -1;
    memcpy(b->a, b->newton->r, n * sizeof *b->a);
    solve(b, b->a);
    solve(b, b->b);
    double ta = zp_static_dot(rest, b->direction, b->a) / sys->q_scale,
           tb = zp_static_dot(rest, b->direction, b->b) / sys->q_scale;
    double across = tb + b->direction_m / sys->m_scale, dm = (s - gone - ta) / across;
    look_at_side(&sides, (across < 0) != is_negative(b), k);
    for (size_t i = 0; i < n; i++)
      b->a[i] += b->b[i] * dm;
    zp_closing_correct(&closing, rest, b->a);
    double length = rest->length(rest->self, b->a);
    if (!(length < 1) || !(fabs(dm) < 0.2 * sys->m_scale)) return -1;
    rest->move(rest->self, b->a, 1);
    zp_branch_set(sys, zp_branch_parameter(sys) + dm);
    fresh = !rest->refresh;
    k++;
  }
  return -1;
}

/* Move by arc length `s` along the direction. False if that is too far. */
static bool predict(ZpBranch *b, double s) {
  const ZpBranchSystem *sys = b->system;
  const ZpStaticSystem *rest = &sys->at_rest;
  rest->residual(rest->self, b->newton->r, NULL); /* the edges that a move turns are those of the last residual */
  sys->position(rest->self, b->q_start);
  for (size_t i = 0; i < rest->n; i++)
    b->a[i] = b->direction[i] * s * sys->q_scale;
  if (!(rest->length(rest->self, b->a) < 1)) return false;
  rest->move(rest->self, b->a, 1);
  zp_branch_set(sys, zp_branch_parameter(sys) + b->direction_m * s * sys->m_scale);
  return true;
}

/* Predict along the direction, then correct. */
static int try_step(ZpBranch *b, double s) {
  double m_start = zp_branch_parameter(b->system);
  return predict(b, s) ? correct(b, s, m_start) : -1;
}

/* Has m turned twice on a step by s from m_start, where `before` was its direction? Then m has the same direction at
 * both ends, and a cubic through them the opposite one in the middle. */
static bool turned_twice(const ZpBranch *b, double s, double m_start, double before) {
  double after = b->direction_m, gone = (zp_branch_parameter(b->system) - m_start) / b->system->m_scale;
  double middle = 1.5 * gone / s - 0.25 * (before + after);
  return before * after > 0 && before * middle < 0;
}

/* Back to the last good point. */
static void go_back(ZpBranch *b, double direction_m) {
  const ZpBranchSystem *sys = b->system;
  sys->restore(sys->at_rest.self, b->saved_before);
  memcpy(b->direction, b->direction_saved, sys->at_rest.n * sizeof *b->direction);
  b->direction_m = direction_m;
}

/* The tangent at the present point => direction, on the side that eq. (10.2) gives. => cosine of the angle by which it
 * has turned; 2: there is no tangent. */
static double face_on(ZpBranch *b) {
  int negative = find_tangent(b);
  if (negative < 0) return 2;
  double before = b->direction_m;
  face(b, b->along != (negative == 1));
  return zp_static_dot(&b->system->at_rest, b->direction, b->direction_saved) + b->direction_m * before;
}

/* A step of length `s` over a corner, then one four times as long; direction_m was `m` before it. */
static bool step_over(ZpBranch *b, double m, double s) {
  go_back(b, m);
  if (!predict(b, s)) return false;
  double cosine = face_on(b);
  if (cosine > sharpest_turn) {
    go_back(b, m);
    try_step(b, s);
    cosine = face_on(b);
  }
  if (cosine > 1 || try_step(b, 4 * s) < 0 || find_direction(b) < sharpest_turn || b->reversed) return false;
  b->step = b->taken = 4 * s;
  return true;
}

/* Pass a corner, where the stiffness jumps and the branch turns by any angle. It is at most `ahead` away, because
 * otherwise no step would have failed. Eq. (10.2) holds across it, so the tangent beyond it shows where the branch
 * continues. If the branch meets the corner at a grazing angle, corrections find the other side. */
static bool turn_corner(ZpBranch *b, double ahead) {
  static const double farthest = 1e-4;
  double m = b->direction_m, s = ahead;
  while (s < farthest) {
    if (step_over(b, m, s)) return true;
    s *= 4;
  }
  return false;
}

bool zp_branch_advance(ZpBranch *b) {
  const ZpBranchSystem *sys = b->system;
  void *self = sys->at_rest.self;
  size_t bytes = sys->at_rest.n * sizeof *b->direction;
  double m = b->direction_m, m_start = zp_branch_parameter(sys);
  sys->save(self, b->saved_before);
  memcpy(b->direction_saved, b->direction, bytes);
  while (b->step > shortest_step) {
    double s = fmin(b->step, b->longest_m_step / fabs(b->direction_m));
    int corrections = try_step(b, s);
    bool stayed = corrections >= 0 && find_direction(b) > (s < corner_step ? 0 : sharpest_turn) && !b->reversed;
    if (stayed && (s < corner_step || !turned_twice(b, s, m_start, m))) {
      b->step = b->taken = s;
      if (corrections <= EASY_CORRECTIONS) b->step = fmin(1.5 * s, b->longest_step);
      if (corrections > 2 * EASY_CORRECTIONS) b->step = 0.5 * s;
      return true;
    }
    go_back(b, m);
    b->step = 0.5 * s;
  }
  if (turn_corner(b, shortest_step)) return true;
  go_back(b, m);
  return false;
}

void zp_branch_approach(ZpBranch *b, bool (*passed)(void *user), void *user) {
  const ZpBranchSystem *sys = b->system;
  void *self = sys->at_rest.self;
  double step = b->step, s = step, gone = 0;
  sys->restore(self, b->saved_before);
  find_direction(b);
  /* walk there in steps that halve whenever one would pass it, no further than the last step went: there may be more
   * limit points beyond; at one m is flat, so its error falls with the square of the last step */
  while (s > 1e-4 * step) {
    double sign = b->direction_m;
    sys->save(self, b->saved_before);
    bool within = gone + s < b->taken;
    if (within && try_step(b, s) >= 0 && find_direction(b) > 0 && b->direction_m * sign > 0 && !passed(user)) {
      gone += s;
      continue;
    }
    sys->restore(self, b->saved_before);
    find_direction(b);
    s *= 0.5;
  }
}

static bool never(void *user) {
  (void)user;
  return false;
}

double zp_branch_limit(ZpBranch *b) {
  const ZpBranchSystem *sys = b->system;
  void *self = sys->at_rest.self;
  size_t bytes = sys->at_rest.n * sizeof *b->direction;
  double after_m = b->direction_m;
  sys->save(self, b->saved);
  memcpy(b->direction_after, b->direction, bytes);
  zp_branch_approach(b, never, NULL);
  double where = zp_branch_parameter(sys);
  sys->restore(self, b->saved);
  sys->at_rest.residual(self, b->newton->r, NULL);
  memcpy(b->direction, b->direction_after, bytes);
  b->direction_m = after_m;
  return where;
}
