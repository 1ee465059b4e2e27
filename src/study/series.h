/* Studies that look at each member of a series alone: docs/theory.md, section 29. */
#ifndef ZP_STUDY_SERIES_H
#define ZP_STUDY_SERIES_H

#include "study/studies.h"

ZpStatus zp_series_stationary(const ZpTask *task, ZpResult *result, ZpError *err);
ZpStatus zp_series_limits(const ZpTask *task, ZpResult *result, ZpError *err);

#endif
