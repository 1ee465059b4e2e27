#include "study/equilibria.h"

#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "rest/quasistatic.h"

/* -- several members ------------------------------------------------------------------------------- */

static const ZpColumn stiffness = {"stiffness_N_per_m", "N/m", "restoring force per displacement of the load"};

/* Of the lower one of two antagonists. */
static const ZpColumn lower[] = {
    {"lower_voltage_V", "V", "voltage between the electrodes of the lower one"},
    {"lower_opening_m", "m", "distance between the platforms' faces of the lower one"},
    {"lower_zipped_length_m", "m", "closed length of one half of the lower one, from the clip"},
};
enum { LOWER = sizeof lower / sizeof lower[0] };

#define OF_MEMBER(k)                                                                                                   \
  {"member_" #k "_force_N", "N", "force with which member " #k " pulls the load up"}, {                                \
    "member_" #k "_zipped_length_m", "m", "closed length of one half of member " #k                                    \
  }
static const ZpColumn of_each[] = {OF_MEMBER(1), OF_MEMBER(2), OF_MEMBER(3), OF_MEMBER(4),
                                   OF_MEMBER(5), OF_MEMBER(6), OF_MEMBER(7), OF_MEMBER(8)};
enum { OF_EACH = 2 };

#define OPENING(k)                                                                                                     \
  { "member_" #k "_opening_m", "m", "distance between the platforms' faces of member " #k }
static const ZpColumn openings[] = {OPENING(1), OPENING(2), OPENING(3), OPENING(4),
                                    OPENING(5), OPENING(6), OPENING(7), OPENING(8)};
static const ZpColumn closed_members = {"closed_members", "1", "number of closed members"};

/* => how many there are. */
static size_t columns_of(const ZpModel *model, ZpColumn *columns) {
  size_t members = model->members;
  bool opposed = zp_is_antagonist(model), shared = zp_shares_load(model);
  size_t count = opposed ? LOWER : shared ? OF_EACH * members : members;
  if (members == 1) return 0;
  memcpy(columns, opposed ? lower : shared ? of_each : openings, count * sizeof *columns);
  columns[count] = shared ? stiffness : closed_members;
  return count + 1;
}

/* Their values at the present point. The stiffness is then factored. */
static void member_values(ZpRest *rest, double *values) {
  ZpStatics *s = &rest->statics;
  if (s->members == 1) return;
  if (!s->shared) {
    for (size_t k = 0; k < s->members; k++)
      *values++ = zp_statics_member_opening(s, k);
    *values = (double)zp_closed_members(s);
    return;
  }
  if (s->opposed) {
    *values++ = zp_statics_member_voltage(s, 1);
    *values++ = zp_statics_member_opening(s, 1);
    *values++ = zp_statics_member_closed(s, 1);
  }
  for (size_t k = 0; k < s->members && !s->opposed; k++) {
    *values++ = zp_statics_member_force(s, k);
    *values++ = zp_statics_member_closed(s, k);
  }
  *values = zp_statics_load_stiffness(s);
}

void zp_equilibria_add_members(ZpEquilibria *at) {
  ZpColumn columns[ZP_BEHIND];
  double values[ZP_BEHIND];
  size_t count = columns_of(at->rest.statics.member->model, columns);
  member_values(&at->rest, values);
  for (size_t k = 0; k < count; k++)
    zp_result_add(at->result, columns[k].name, columns[k].unit, values[k]);
}

/* -- points ---------------------------------------------------------------------------------------- */

static ZpTable *make_table(const ZpEquilibria *at) {
  enum { MOST = 32 };
  ZpColumn all[MOST];
  memcpy(all, at->column, at->columns * sizeof *all);
  size_t count = at->columns;
  all[count++] = (ZpColumn){"insulator_field_V_per_m", "V/m", "largest field in the insulators, by the series law"};
  all[count++] = (ZpColumn){"max_stress_Pa", "Pa", "largest stress of the metal"};
  return zp_table_create(all, count + columns_of(at->model, all + count), at->rows);
}

static bool asked_to_stop(const void *self) {
  const ZpEquilibria *at = self;
  return zp_task_stops(at->task, at->stage, at->top > 0 ? fabs(at->rest.statics.U) / at->top : 0);
}

ZpStatus zp_equilibria_open(ZpEquilibria *at, const ZpActuatorDef *def, void (*reserve)(void *user, ZpArena *arena),
                            void *user, ZpError *err) {
  at->margins = zp_margins_none();
  ZpStatus status = zp_model_create(def, &at->model, err);
  if (status != ZP_OK) return status;
  if (at->column) at->result->series = make_table(at);
  at->result->shapes = zp_model_shapes(at->model, at->shapes);
  bool made = at->result->shapes && (!at->column || at->result->series);
  made = made && (at->held ? zp_rest_open_held(&at->rest, at->model, reserve, user)
                           : zp_rest_open(&at->rest, at->model, reserve, user));
  if (!made) return zp_fail_memory(err);
  at->rest.statics.stop = asked_to_stop;
  at->rest.statics.caller = at;
  return ZP_OK;
}

void zp_equilibria_close(ZpEquilibria *at) {
  zp_rest_close(&at->rest);
  zp_model_destroy(at->model);
}

void zp_equilibria_look(ZpEquilibria *at) {
  ZpMargins margins;
  zp_rest_shape(&at->rest, 0, &margins);
  zp_margins_join(&at->margins, margins);
}

void zp_equilibria_add(ZpEquilibria *at, double *row, double number, bool last) {
  ZpMargins margins;
  ZpShape shape = zp_rest_shape(&at->rest, number, &margins);
  zp_margins_join(&at->margins, margins);
  double *behind = row + at->columns;
  *behind++ = margins.insulator;
  *behind++ = margins.stress;
  member_values(&at->rest, behind);
  zp_table_offer(at->result->series, row);
  zp_shapes_offer(at->result->shapes, &shape);
  if (!last) return;
  zp_table_keep_last(at->result->series, row);
  zp_shapes_keep_last(at->result->shapes, &shape);
}

void zp_equilibria_note(ZpEquilibria *at, double voltage) {
  zp_margins_join(&at->margins, zp_margins_at_clip(at->model, voltage));
  zp_add_margins(at->result, at->model, &at->margins);
  zp_note_mesh(at->result, at->model, voltage);
  zp_note_rest(at->result, at->model, at->column != NULL);
}
