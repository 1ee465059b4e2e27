/* Files that studies read. */
#ifndef ZP_FIT_DATA_H
#define ZP_FIT_DATA_H

#include "study/result.h"

/* Check the files of a Def that zp_study_check has passed. */
ZpStatus zp_data_check_files(ZpStudy study, const ZpActuatorDef *def, ZpError *err);

#endif
