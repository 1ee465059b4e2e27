#include "rest/rest.h"

#include <math.h>

#include "base/fail.h"
#include "rest/sensitivity.h"

/* Steps along the branch: 0.01 L of mean movement or drive.voltage count 1. */
static const double first_step = 0.01, longest_step = 0.1;

static void reserve_shapes(ZpRest *rest, ZpArena *arena) {
  const size_t members = rest->statics.members;
  rest->shape_room = zp_arena_take_of(arena, members, sizeof *rest->shape_room);
  for (size_t k = 0; k < members; k++) {
    ZpShapeRoom counted = {0}, *room = rest->shape_room ? &rest->shape_room[k] : &counted;
    zp_shape_reserve(rest->statics.model, room, arena);
  }
}

static bool create(ZpRest *rest, const ZpModel *model, bool held, void (*reserve)(void *user, ZpArena *arena),
                   void *user) {
  ZpArena arena = {NULL, 0};
  *rest = (ZpRest){0};
  if (!zp_statics_create(model, held, &rest->statics)) return false;
  rest->system = zp_statics_branch(&rest->statics, ZP_ALONG_VOLTAGE);
  rest->square = zp_statics_branch(&rest->statics, ZP_ALONG_SQUARE);
  rest->load = zp_statics_branch(&rest->statics, ZP_ALONG_LOAD);
  for (int pass = 0; pass < 2; pass++) {
    if (pass) {
      rest->memory = zp_calloc(1, arena.used);
      arena = (ZpArena){rest->memory, 0};
      if (!rest->memory) return false;
    }
    zp_branch_reserve(&rest->branch, &rest->system, &rest->statics.newton, &arena);
    zp_track_reserve(&rest->track, &rest->square, &rest->statics.form, &rest->statics.newton, &arena);
    rest->held = zp_arena_take(&arena, zp_rest_save_size(rest));
    reserve_shapes(rest, &arena);
    if (rest->statics.members > 1 || model->network->plane)
      zp_many_reserve(&rest->shapes, rest->statics.members, model->count, model->nodes, &arena);
    if (reserve) reserve(user, &arena);
  }
  return true;
}

bool zp_rest_open(ZpRest *rest, const ZpModel *model, void (*reserve)(void *user, ZpArena *arena), void *user) {
  return create(rest, model, false, reserve, user);
}

bool zp_rest_open_held(ZpRest *rest, const ZpModel *model, void (*reserve)(void *user, ZpArena *arena), void *user) {
  return create(rest, model, true, reserve, user);
}

void zp_rest_close(ZpRest *rest) {
  zp_free(rest->memory);
  zp_statics_destroy(&rest->statics);
}

ZpShape zp_rest_shape(ZpRest *rest, double time, ZpMargins *margins) {
  const ZpStatics *s = &rest->statics;
  ZpShape shape = {0};
  if (margins) *margins = zp_margins_none();
  for (size_t k = s->members; k-- > 0;) {
    const ZpModel *model = s->member[k].model;
    shape = zp_statics_shape(s, k, time, rest->shape_room[k]);
    if (margins) zp_margins_join(margins, zp_margins_of(model, &shape));
    if (s->members == 1 && !s->model->network->plane) return shape;
    zp_many_put(&rest->shapes, s->model, k, &shape);
    if (s->model->network->plane) zp_many_stand(&rest->shapes, &s->plane, s->pose, k);
  }
  for (size_t k = 0; k < s->members && !s->shared; k++)
    zp_many_hang(&rest->shapes, s->model, s->model->network->order[k]);
  shape.zipped = zp_statics_front(s);
  zp_many_give(&rest->shapes, &shape);
  return shape;
}

size_t zp_rest_save_size(const ZpRest *rest) {
  return rest->system.save_size / sizeof(double);
}

void zp_rest_save(ZpRest *rest, double *state) {
  rest->system.save(&rest->statics, state);
}

void zp_rest_go_to(ZpRest *rest, const double *state) {
  rest->system.restore(&rest->statics, state);
  zp_statics_evaluate(&rest->statics);
}

bool zp_rest_follow_by(ZpRest *rest, bool growing, double first, double longest) {
  return zp_branch_start(&rest->branch, growing, first, longest, 2 * zp_statics_tolerance(&rest->statics));
}

bool zp_rest_follow(ZpRest *rest, bool growing) {
  return zp_rest_follow_by(rest, growing, first_step, longest_step);
}

/* A voltage that the branch is to reach, V. */
typedef struct Goal {
  const ZpStatics *statics;
  double voltage;
} Goal;

static bool is_beyond(void *user) {
  const Goal *goal = user;
  return goal->statics->U > goal->voltage;
}

ZpNewtonInfo zp_rest_reach(ZpRest *rest, double voltage) {
  Goal goal = {&rest->statics, voltage};
  zp_branch_approach(&rest->branch, is_beyond, &goal);
  return zp_rest_settle(rest, voltage);
}

ZpNewtonInfo zp_rest_settle(ZpRest *rest, double voltage) {
  enum { MOST = 30 };
  rest->statics.U = voltage;
  return zp_statics_solve(&rest->statics, MOST);
}

/* -- for programs ---------------------------------------------------------------------------------- */

ZpStatus zp_rest_create(const ZpModel *model, ZpRest **out, ZpError *err) {
  *out = zp_calloc(1, sizeof **out);
  if (*out && zp_rest_open(*out, model, NULL, NULL)) return ZP_OK;
  zp_rest_destroy(*out);
  *out = NULL;
  return zp_fail_memory(err);
}

void zp_rest_destroy(ZpRest *rest) {
  if (rest) zp_rest_close(rest);
  zp_free(rest);
}

bool zp_rest_hang(ZpRest *rest, double voltage) {
  ZpStatics *s = &rest->statics;
  bool found = zp_newton_good(zp_statics_find_rest(s).end) && zp_statics_bias(s);
  if (found && voltage != 0 && zp_follows_voltage(s->member->model)) found = zp_statics_ramp_voltage(s, voltage);
  return found && !zp_statics_shorted(s);
}

double zp_rest_stroke(const ZpRest *rest) {
  return zp_statics_stroke(&rest->statics);
}

double zp_rest_opening(const ZpRest *rest) {
  return zp_statics_opening(&rest->statics);
}

double zp_rest_capacitance(const ZpRest *rest) {
  return zp_statics_capacitance(&rest->statics);
}

ZpStatus zp_rest_sensitivity(ZpRest *rest, int key, double *stroke, double *opening, ZpError *err) {
  ZpRestSensitivity slope;
  *stroke = *opening = NAN;
  ZpStatus status = zp_rest_sensitivity_check(rest->statics.model->whole, key, err);
  if (status != ZP_OK) return status;
  status = zp_rest_sensitivity_open(&slope, &rest->statics, key, err);
  if (status == ZP_OK && zp_rest_sensitivity_solve(&slope, ZP_SETS_LOAD)) {
    *stroke = zp_rest_sensitivity_of(&slope, zp_output_stroke, NULL);
    *opening = zp_rest_sensitivity_of(&slope, zp_output_opening, NULL);
  }
  zp_rest_sensitivity_close(&slope);
  return status;
}
