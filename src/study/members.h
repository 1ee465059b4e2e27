/* Numbers that a system of several members has in addition to those of one: members that share a load. */
#ifndef ZP_STUDY_MEMBERS_H
#define ZP_STUDY_MEMBERS_H

#include <zipact/study.h>

#include "def/check.h"
#include "rest/rest.h"

enum { ZP_MEMBER_COLUMNS = 1 + 2 * ZP_MOST_MEMBERS };

/* A table of `count` columns and those of the members; NULL if there is no memory. */
ZpTable *zp_members_table(const ZpModel *model, const ZpColumn *columns, size_t count, size_t rows);

/* The values of the members' columns at the present point. The stiffness of `rest` is factored. */
void zp_members_values(ZpRest *rest, double *values);

/* The same as numbers of the result. */
void zp_members_add(ZpRest *rest, ZpResult *result);

#endif
