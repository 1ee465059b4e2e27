#include "study/equilibria.h"

#include <math.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "rest/quasistatic.h"

enum { MARGINS = 2 };

/* -- several members ------------------------------------------------------------------------------- */

static const ZpColumn stiffness = {"stiffness_N_per_m", "N/m", "restoring force per displacement of the load"};

/* Of the lower one of two antagonists. */
static const ZpColumn lower[] = {
    {"lower_voltage_V", "V", "voltage between the electrodes of the lower one"},
    {"lower_opening_m", "m", "distance between the platforms' faces of the lower one"},
    {"lower_zipped_length_m", "m", "closed length of one half of the lower one, from the clip"},
};
enum { LOWER = sizeof lower / sizeof lower[0] };

static const ZpColumn of_each[] = {
    {"member_#_force_N", "N", "force with which member # pulls the load up"},
    {"member_#_zipped_length_m", "m", "closed length of one half of member #"},
};
enum { OF_EACH = sizeof of_each / sizeof of_each[0] };

static const ZpColumn opening = {"member_#_opening_m", "m", "distance between the platforms' faces of member #"};
static const ZpColumn closed_members = {"closed_members", "1", "number of closed members"};

/* => how many parts there are. */
enum { PARTS = 2 };
static size_t parts_of(const ZpModel *model, ZpColumnPart part[PARTS]) {
  const bool shared = zp_shares_load(model);
  if (model->members == 1) return 0;
  part[0] = zp_is_antagonist(model) ? (ZpColumnPart){lower, LOWER, 0}
            : shared                ? (ZpColumnPart){of_each, OF_EACH, model->members}
                                    : (ZpColumnPart){&opening, 1, model->members};
  part[1] = (ZpColumnPart){shared ? &stiffness : &closed_members, 1, 0};
  return PARTS;
}

/* => how many values there are. */
static size_t values_of(const ZpModel *model) {
  ZpColumnPart part[PARTS];
  size_t count = 0;
  for (size_t k = parts_of(model, part); k-- > 0;)
    count += part[k].count * (part[k].members > 0 ? part[k].members : 1);
  return count;
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
  ZpColumnPart part[PARTS];
  const size_t parts = parts_of(at->model, part);
  const double *value = at->behind + MARGINS;
  member_values(&at->rest, at->behind + MARGINS);
  for (size_t k = 0; k < parts; k++)
    for (size_t member = part[k].members > 0 ? 1 : 0; member <= part[k].members; member++)
      for (size_t c = 0; c < part[k].count; c++, value++) {
        const ZpColumn *column = &part[k].column[c];
        if (member > 0)
          zp_result_add_member(at->result, column->name, member, column->unit, *value);
        else
          zp_result_add(at->result, column->name, column->unit, *value);
      }
}

/* -- points ---------------------------------------------------------------------------------------- */

static ZpTable *make_table(const ZpEquilibria *at) {
  static const ZpColumn margins[MARGINS] = {
      {"insulator_field_V_per_m", "V/m", "largest field in the insulators, by the series law"},
      {"max_stress_Pa", "Pa", "largest stress of the metal"}};
  ZpColumnPart part[2 + PARTS] = {{at->column, at->columns, 0}, {margins, MARGINS, 0}};
  return zp_table_of(part, 2 + parts_of(at->model, part + 2), at->rows);
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
  at->row = zp_calloc(at->columns + MARGINS + values_of(at->model), sizeof *at->row);
  bool made = at->row && at->result->shapes && (!at->column || at->result->series);
  if (made) at->behind = at->row + at->columns;
  made = made && (at->held ? zp_rest_open_held(&at->rest, at->model, reserve, user)
                           : zp_rest_open(&at->rest, at->model, reserve, user));
  if (!made) return zp_fail_memory(err);
  at->rest.statics.stop = asked_to_stop;
  at->rest.statics.caller = at;
  return ZP_OK;
}

void zp_equilibria_close(ZpEquilibria *at) {
  zp_free(at->row);
  zp_rest_close(&at->rest);
  zp_model_destroy(at->model);
}

void zp_equilibria_look(ZpEquilibria *at) {
  ZpMargins margins;
  zp_rest_shape(&at->rest, 0, &margins);
  zp_margins_join(&at->margins, margins);
}

void zp_equilibria_add(ZpEquilibria *at, const double *columns, double number, bool last) {
  ZpMargins margins;
  ZpShape shape = zp_rest_shape(&at->rest, number, &margins);
  zp_margins_join(&at->margins, margins);
  memcpy(at->row, columns, at->columns * sizeof *columns);
  at->behind[0] = margins.insulator;
  at->behind[1] = margins.stress;
  member_values(&at->rest, at->behind + MARGINS);
  zp_table_offer(at->result->series, at->row);
  zp_shapes_offer(at->result->shapes, &shape);
  if (!last) return;
  zp_table_keep_last(at->result->series, at->row);
  zp_shapes_keep_last(at->result->shapes, &shape);
}

void zp_equilibria_note(ZpEquilibria *at, double voltage) {
  zp_margins_join(&at->margins, zp_margins_at_clip(at->model, voltage));
  zp_add_margins(at->result, at->model, &at->margins);
  zp_note_mesh(at->result, at->model, voltage);
  zp_note_rest(at->result, at->model, at->column != NULL);
}
