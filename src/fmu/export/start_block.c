/* The start values of the FMU that this is compiled into. Here they are empty: `zipact fmu` writes them into the binary
 * of each FMU, and a file in place of this one among its sources. volatile: no compiler may count on them. */
#include "fmu/start.h"

const volatile ZpFmuStart zp_fmu_start = {.mark = ZP_FMU_MARK, .size = sizeof(ZpFmuStart)};
