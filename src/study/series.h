/* Studies at rest of actuators in series, which look at each member alone: docs/theory.md, section 29. */
#ifndef ZP_STUDY_SERIES_H
#define ZP_STUDY_SERIES_H

#include "def/check.h"
#include "study/studies.h"

/* The results of all members, the uppermost first. */
typedef struct ZpMembers {
  size_t count;
  ZpResult *of[ZP_MOST_MEMBERS];
  double carried[ZP_MOST_MEMBERS]; /* mass that hangs on it beyond load.mass, kg */
  double link_mass;                /* of the link that each but the uppermost hangs on, kg */
} ZpMembers;

/* Run a study of each member alone, under all that hangs on it. `members` is to be forgotten whatever comes of it. */
ZpStatus zp_members_run(const ZpTask *task, ZpStudy study, ZpStudyRun run, ZpMembers *members, ZpError *err);
void zp_members_forget(ZpMembers *members);

/* Their numbers, notes and outcome => those of the series. */
void zp_members_join(const ZpMembers *members, ZpResult *result);

/* The same with a table of `columns` [count]: number and load of a member, then numbers of its result by their names.
 */
ZpStatus zp_members_report(const ZpMembers *members, const ZpColumn *columns, size_t count, ZpResult *result,
                           ZpError *err);

/* One frame: all members, each hung on the one above, as if their stations were those of one; none where a member has
 * no shape. False if there is no memory. */
bool zp_members_shape(const ZpMembers *members, ZpResult *result);

/* The table, shapes and message of all members at rest as the voltage rises slowly to drive.voltage and falls again,
 * from results that have their closing and release voltages. */
ZpStatus zp_members_follow(const ZpTask *task, const ZpMembers *members, ZpResult *result, ZpError *err);

/* Add to a text: "members pull in at 1 V to 2 V". */
void zp_members_say(const ZpMembers *members, const char *words, const char *name, char *text, size_t size);

/* The studies that know a series, each in its own file. */
ZpStatus zp_series_stationary(const ZpTask *task, ZpResult *result, ZpError *err);
ZpStatus zp_series_equilibrium(const ZpTask *task, ZpResult *result, ZpError *err);
ZpStatus zp_series_modes(const ZpTask *task, ZpResult *result, ZpError *err);
ZpStatus zp_series_limits(const ZpTask *task, ZpResult *result, ZpError *err);

#endif
