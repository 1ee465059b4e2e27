/* Files that studies read. */
#ifndef ZP_FIT_DATA_H
#define ZP_FIT_DATA_H

#include "study/result.h"

/* Check the files of a Def that zp_study_check has passed. */
ZpStatus zp_data_check_files(ZpStudy study, const ZpActuatorDef *def, ZpError *err);

/* Add to the result of a run that ended with `status` what is doubtful about its base.file. Returns `status`, or that
 * of reading the file; then there is no result. */
ZpStatus zp_base_note(ZpStatus status, const ZpActuatorDef *def, ZpResult **result, ZpError *err);

#endif
