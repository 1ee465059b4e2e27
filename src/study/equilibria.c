#include "study/equilibria.h"

#include <math.h>
#include <stdio.h>
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

/* Of each member and each body of a network. */
static const ZpColumn of_member[] = {
    {"#.stroke_m", "m", "height of the clip of # over its lower platform, signed"},
    {"#.opening_m", "m", "distance between the platforms' faces of #"},
    {"#.capacitance_F", "F", "capacitance of the electrodes of #"},
    {"#.zipped_length_m", "m", "closed length of one half of #"},
    {"#.force_N", "N", "force with which # pulls its bodies together"},
    {"#.voltage_V", "V", "voltage between the electrodes of #"},
};
enum { OF_MEMBER = sizeof of_member / sizeof of_member[0] };

/* Of each member of a stack that has ports. */
static const ZpColumn at_ports[] = {
    {"member_#_stroke_m", "m", "height of the clip of member # over its lower platform, signed"},
    {"member_#_capacitance_F", "F", "capacitance of the electrodes of member #"},
};
enum { AT_PORTS = sizeof at_ports / sizeof at_ports[0] };

/* Of a pouch. */
static const ZpColumn of_pouch[] = {
    {"strain", "1", "contraction over the length of the films, from the length with nothing zipped"},
    {"contraction", "1", "zipped length over the length of the electrodes"},
    {"pressure_Pa", "Pa", "pressure of the liquid"},
};
enum { OF_POUCH = sizeof of_pouch / sizeof of_pouch[0] };

/* Parts of the table, and what stands before their names among the numbers of the result. */
typedef struct Part {
  ZpColumnPart columns;
  const char *before;
} Part;

/* => how many parts there are. */
enum { PARTS = 3 };
static size_t parts_of(const ZpModel *model, Part part[PARTS]) {
  const ZpNetwork *network = model->network;
  const bool shared = zp_shares_load(model);
  if (zp_is_network(model)) {
    part[0] = (Part){{of_member, OF_MEMBER, network->members, zp_member_called, model->whole}, "members."};
    size_t count;
    const ZpColumn *of_body = zp_body_columns(network->plane, &count);
    part[1] = (Part){{of_body, count, network->bodies - 1, zp_body_called, model->whole}, "bodies."};
    part[2] = (Part){{.column = &closed_members, .count = 1}, ""};
    return 3;
  }
  if (model->members == 1 && model->pouch.w > 0) {
    part[0] = (Part){{.column = of_pouch, .count = OF_POUCH}, ""};
    return 1;
  }
  if (model->members == 1) return 0;
  part[0] = (Part){network->opposed ? (ZpColumnPart){.column = lower, .count = LOWER}
                   : shared         ? (ZpColumnPart){.column = of_each, .count = OF_EACH, .members = model->members}
                                    : (ZpColumnPart){.column = &opening, .count = 1, .members = model->members},
                   ""};
  part[1] = (Part){{.column = shared ? &stiffness : &closed_members, .count = 1}, ""};
  part[2] = (Part){{.column = at_ports, .count = AT_PORTS, .members = model->members}, ""};
  return zp_has_ports(model) ? 3 : 2;
}

/* => how many values there are. */
static size_t values_of(const ZpModel *model) {
  Part part[PARTS];
  size_t count = 0;
  for (size_t k = parts_of(model, part); k-- > 0;)
    count += part[k].columns.count * (part[k].columns.members > 0 ? part[k].columns.members : 1);
  return count;
}

static void network_values(ZpStatics *s, double *values) {
  for (size_t k = 0; k < s->members; k++) {
    *values++ = zp_statics_member_stroke(s, k);
    *values++ = zp_statics_member_opening(s, k);
    *values++ = zp_statics_member_capacitance(s, k);
    *values++ = zp_statics_member_closed(s, k);
    *values++ = zp_statics_member_force(s, k);
    *values++ = zp_statics_member_voltage(s, k);
  }
  const ZpPose *place = zp_statics_places(s);
  const bool plane = s->model->network->plane;
  for (size_t body = 1; body < s->model->network->bodies; body++) {
    if (plane) *values++ = place[body].x;
    *values++ = place[body].y;
    if (plane) *values++ = place[body].turn;
  }
  *values = (double)zp_closed_members(s);
}

/* Of members in series, antagonists, or members side by side. The stiffness is then factored. */
static double *stack_values(ZpStatics *s, double *values) {
  if (!s->shared) {
    for (size_t k = 0; k < s->members; k++)
      *values++ = zp_statics_member_opening(s, k);
    *values++ = (double)zp_closed_members(s);
    return values;
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
  *values++ = zp_statics_load_stiffness(s);
  return values;
}

static void pouch_values(const ZpStatics *s, double *values) {
  const ZpModel *model = s->model;
  if (model->pouch.w == 0) return;
  values[0] = zp_pouch_strain(model, zp_statics_stroke(s));
  values[1] = zp_statics_closed_length(s) / model->pouch.electrode;
  values[2] = s->member->eval.pressure;
}

/* Their values at the present point. */
static void member_values(ZpRest *rest, double *values) {
  ZpStatics *s = &rest->statics;
  if (zp_is_network(s->model)) {
    network_values(s, values);
    return;
  }
  if (s->members == 1) {
    pouch_values(s, values);
    return;
  }
  values = stack_values(s, values);
  const size_t told = zp_has_ports(s->model) ? s->members : 0;
  for (size_t k = 0; k < told; k++) {
    *values++ = zp_statics_member_stroke(s, k);
    *values++ = zp_statics_member_capacitance(s, k);
  }
}

void zp_equilibria_add_members(ZpEquilibria *at) {
  Part part[PARTS];
  const size_t parts = parts_of(at->model, part);
  const double *value = at->behind + MARGINS;
  member_values(&at->rest, at->behind + MARGINS);
  for (const Part *p = part; p < part + parts; p++)
    for (size_t member = p->columns.members > 0 ? 1 : 0; member <= p->columns.members; member++) {
      char room[ZP_NAME_SIZE], name[ZP_NAME_SIZE];
      const char *called = p->columns.name ? p->columns.name(at->model->whole, member, room)
                                           : zp_member_called(at->model->whole, member, room);
      for (size_t c = 0; c < p->columns.count; c++, value++) {
        const ZpColumn *column = &p->columns.column[c];
        snprintf(name, sizeof name, "%s%s", p->before, column->name);
        zp_result_add_of(at->result, name, member > 0 ? called : NULL, column->unit, *value);
      }
    }
}

/* -- points ---------------------------------------------------------------------------------------- */

static ZpTable *make_table(const ZpEquilibria *at) {
  static const ZpColumn margins[MARGINS] = {
      {"insulator_field_V_per_m", "V/m", "largest field in the insulators, by the series law"},
      {"max_stress_Pa", "Pa", "largest stress of the metal"}};
  Part more[PARTS];
  const size_t parts = parts_of(at->model, more);
  ZpColumnPart part[2 + PARTS] = {{.column = at->column, .count = at->columns}, {.column = margins, .count = MARGINS}};
  for (size_t k = 0; k < parts; k++)
    part[2 + k] = more[k].columns;
  return zp_table_of(part, 2 + parts, at->rows);
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
