/* Studies of equilibria of several actuators that share one load and are one system: antagonists (docs/theory.md,
 * section 31), and unequal ones side by side (section 29). */
#ifndef ZP_STUDY_TOGETHER_H
#define ZP_STUDY_TOGETHER_H

#include "study/studies.h"

ZpStatus zp_together_stationary(const ZpTask *task, ZpResult *result, ZpError *err);
ZpStatus zp_together_equilibrium(const ZpTask *task, ZpResult *result, ZpError *err);
ZpStatus zp_together_limits(const ZpTask *task, ZpResult *result, ZpError *err);
ZpStatus zp_together_modes(const ZpTask *task, ZpResult *result, ZpError *err);

#endif
