/* Studies of equilibria of actuators in series. Under a dead load the force on each member is known, eq. (29.1). So
 * each member is in equilibrium as it would be alone, and the results of the series follow from those of its
 * members. */
#include "study/series.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "actuator/shape.h"
#include "base/fail.h"

/* How a number of the series follows from those of its members, which are NAN where a member has none. */
typedef enum Rule {
  SUM,      /* NAN if any is */
  LARGEST,  /* likewise */
  HIGHEST,  /* of those that there are */
  LEAST,    /* likewise */
  LOAD,     /* the least of what members lift in addition to what they carry; NAN if any is */
  LEFT_OUT, /* there is none */
} Rule;

typedef struct Combined {
  const char *name;
  Rule rule;
} Combined;

static const Combined combined[] = {{"residual", LARGEST},
                                    {"pull_in_voltage_V", LEAST},
                                    {"closing_voltage_V", LARGEST},
                                    {"release_voltage_V", HIGHEST},
                                    {"max_load_kg", LOAD},
                                    {"insulator_field_V_per_m", HIGHEST},
                                    {"insulator_field_place_m", LEFT_OUT},
                                    {"breakdown_margin", LEAST},
                                    {"allowed_voltage_V", LEAST},
                                    {"max_stress_Pa", HIGHEST},
                                    {"max_stress_place_m", LEFT_OUT},
                                    {"yield_margin", LEAST}};

static Rule rule_of(const char *name) {
  for (size_t k = 0; k < sizeof combined / sizeof combined[0]; k++)
    if (strcmp(combined[k].name, name) == 0) return combined[k].rule;
  return SUM;
}

static double join(Rule rule, double sofar, double value) {
  switch (rule) {
  case SUM:
    return sofar + value;
  case HIGHEST:
    return fmax(sofar, value);
  case LEAST:
    return fmin(sofar, value);
  case LARGEST:
    return isnan(sofar) || isnan(value) ? NAN : fmax(sofar, value);
  case LOAD:
    return isnan(sofar) || isnan(value) ? NAN : fmin(sofar, value);
  case LEFT_OUT:
    break;
  }
  return NAN;
}

static double number_of(const ZpMembers *members, size_t k, const char *name) {
  double value = zp_result_get(members->of[k], name);
  if (k > 0 && strcmp(name, "mass_kg") == 0) return value + members->link_mass;
  if (rule_of(name) != LOAD || isnan(value)) return value;
  return value > members->carried[k] ? value - members->carried[k] : NAN;
}

static double number_of_all(const ZpMembers *members, const char *name) {
  double value = number_of(members, 0, name);
  for (size_t k = 1; k < members->count; k++)
    value = join(rule_of(name), value, number_of(members, k, name));
  return value;
}

static void add_numbers(const ZpMembers *members, ZpResult *result) {
  const ZpResult *first = members->of[0];
  for (size_t i = 0; i < first->scalars; i++) {
    const ZpScalar *scalar = &first->scalar[i];
    if (rule_of(scalar->name) != LEFT_OUT)
      zp_result_add(result, scalar->name, scalar->unit, number_of_all(members, scalar->name));
  }
}

static bool has_note(const ZpResult *result, const char *note) {
  for (size_t i = 0; i < result->notes; i++)
    if (strcmp(result->note[i], note) == 0) return true;
  return false;
}

/* Each once. */
static void add_notes(const ZpMembers *members, ZpResult *result) {
  for (size_t k = 0; k < members->count; k++)
    for (size_t i = 0; i < members->of[k]->notes; i++)
      if (!has_note(result, members->of[k]->note[i])) zp_result_note(result, "%s", members->of[k]->note[i]);
}

/* The outcome is that of the first member without a good one. */
static void add_outcome(const ZpMembers *members, ZpResult *result) {
  result->outcome = members->of[0]->outcome;
  result->resolution = members->of[0]->resolution;
  for (size_t k = members->count; k-- > 0;) {
    const ZpResult *one = members->of[k];
    result->resolution = fmin(result->resolution, one->resolution);
    if (zp_outcome_good(one->outcome)) continue;
    result->outcome = one->outcome;
    snprintf(result->message, sizeof result->message, "member %zu: %.200s", k + 1, one->message);
  }
}

/* -- tables and shapes ----------------------------------------------------------------------------- */

/* A row of a member: its number, the mass that it carries, then these numbers of its own result. */
static bool add_table(const ZpMembers *members, const ZpColumn *columns, size_t count, ZpResult *result) {
  enum { MOST_COLUMNS = 16 };
  double row[MOST_COLUMNS];
  result->series = zp_table_create(columns, count, members->count);
  for (size_t k = 0; result->series && k < members->count; k++) {
    row[0] = (double)(k + 1);
    row[1] = members->carried[k];
    for (size_t c = 2; c < count; c++)
      row[c] = zp_result_get(members->of[k], columns[c].name);
    zp_table_offer(result->series, row);
  }
  return result->series != NULL;
}

bool zp_members_shape(const ZpMembers *members, ZpResult *result) {
  size_t ribbons = members->of[0]->shapes->ribbons, nodes = members->of[0]->shapes->nodes;
  ZpManyShapes all;
  ZpCarver size = {NULL, 0};
  zp_many_carve(&all, members->count, ribbons * nodes, nodes, &size);
  ZpCarver carver = {zp_calloc(1, size.used), 0};
  result->shapes = carver.base ? zp_shapes_create(ribbons, members->count * nodes, 2) : NULL;
  bool whole = result->shapes != NULL;
  if (whole) result->shapes->members = members->count;
  zp_many_carve(&all, members->count, ribbons * nodes, nodes, &carver);
  for (size_t k = 0; whole && k < members->count; k++) {
    whole = members->of[k]->shapes->frames > 0;
    if (!whole) break;
    ZpShape one = zp_shapes_get(members->of[k]->shapes, 0);
    zp_many_put(&all, k, &one);
    zp_many_hang(&all, k, ribbons);
  }
  ZpShape shape = {0};
  zp_many_give(&all, &shape);
  if (whole) zp_shapes_offer(result->shapes, &shape);
  zp_free(carver.base);
  return result->shapes != NULL;
}

/* -- studies --------------------------------------------------------------------------------------- */

void zp_members_forget(ZpMembers *members) {
  for (size_t k = 0; k < members->count; k++)
    zp_result_destroy(members->of[k]);
}

ZpStatus zp_members_run(const ZpTask *task, ZpStudy study, ZpStudyRun run, ZpMembers *members, ZpError *err) {
  ZpModel *model;
  ZpStatus status = zp_model_create(task->def, &model, err);
  *members = (ZpMembers){.link_mass = task->def->stack.link_mass};
  if (status != ZP_OK) return status;
  for (const ZpModel *m = model; m && status == ZP_OK; m = m->below) {
    ZpActuatorDef def = zp_member_at_rest(m);
    ZpTask one = {&def, {0}, task->hooks};
    ZpResult *result = zp_result_create(study);
    if (!result) {
      status = zp_fail_memory(err);
      break;
    }
    members->carried[members->count] = def.load.mass - zp_lowest(m)->def.load.mass;
    members->of[members->count++] = result;
    status = run(&one, result, err);
  }
  zp_model_destroy(model);
  return status;
}

void zp_members_join(const ZpMembers *members, ZpResult *result) {
  add_numbers(members, result);
  add_notes(members, result);
  add_outcome(members, result);
}

ZpStatus zp_members_report(const ZpMembers *members, const ZpColumn *columns, size_t count, ZpResult *result,
                           ZpError *err) {
  zp_members_join(members, result);
  return add_table(members, columns, count, result) ? ZP_OK : zp_fail_memory(err);
}

void zp_members_say(const ZpMembers *members, const char *words, const char *name, char *text, size_t size) {
  double least = NAN, most = NAN;
  for (size_t k = 0; k < members->count; k++) {
    least = fmin(least, zp_result_get(members->of[k], name));
    most = fmax(most, zp_result_get(members->of[k], name));
  }
  size_t used = strlen(text);
  const char *between = used > 0 ? ", " : "";
  if (isnan(least))
    snprintf(text + used, size - used, "%sno members %s", between, words);
  else
    snprintf(text + used, size - used, "%smembers %s at %.4g V to %.4g V", between, words, least, most);
}
