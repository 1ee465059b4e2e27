#include "study/members.h"

#include <string.h>

#include "rest/slow.h"

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
  bool opposed = zp_is_opposed(model), shared = zp_shares_load(model);
  size_t count = opposed ? LOWER : shared ? OF_EACH * members : members;
  if (members == 1) return 0;
  memcpy(columns, opposed ? lower : shared ? of_each : openings, count * sizeof *columns);
  columns[count] = shared ? stiffness : closed_members;
  return count + 1;
}

ZpTable *zp_members_table(const ZpModel *model, const ZpColumn *columns, size_t count, size_t rows) {
  enum { MOST = 32 };
  ZpColumn all[MOST];
  memcpy(all, columns, count * sizeof *columns);
  count += columns_of(model, all + count);
  return zp_table_create(all, count, rows);
}

void zp_members_values(ZpRest *rest, double *values) {
  ZpStatics *s = &rest->statics;
  if (s->members == 1) return;
  if (!s->shared) {
    for (size_t k = 0; k < s->members; k++)
      *values++ = zp_statics_member_opening(s, k);
    *values = (double)zp_closed_members(s);
    return;
  }
  if (s->distance > 0) {
    *values++ = zp_statics_member_voltage(s, 1);
    *values++ = zp_statics_member_opening(s, 1);
    *values++ = zp_statics_member_closed(s, 1);
  }
  for (size_t k = 0; k < s->members && !(s->distance > 0); k++) {
    *values++ = zp_statics_member_force(s, k);
    *values++ = zp_statics_member_closed(s, k);
  }
  *values = zp_statics_load_stiffness(s);
}

void zp_members_add(ZpRest *rest, ZpResult *result) {
  ZpColumn columns[ZP_MEMBER_COLUMNS];
  double values[ZP_MEMBER_COLUMNS];
  size_t count = columns_of(rest->statics.member->model, columns);
  zp_members_values(rest, values);
  for (size_t k = 0; k < count; k++)
    zp_result_add(result, columns[k].name, columns[k].unit, values[k]);
}
