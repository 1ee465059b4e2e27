/* Studies at rest of two antagonists, which are one system: docs/theory.md, section 31. */
#ifndef ZP_STUDY_ANTAGONISTS_H
#define ZP_STUDY_ANTAGONISTS_H

#include "study/studies.h"

ZpStatus zp_opposed_stationary(const ZpTask *task, ZpResult *result, ZpError *err);
ZpStatus zp_opposed_equilibrium(const ZpTask *task, ZpResult *result, ZpError *err);

#endif
