/* The start values of the FMU into which this file is compiled. Here they are empty: `zipact fmu` writes them into the
 * binary of each FMU, and replaces this file among its sources. volatile: the compiler must not evaluate them. */
#include "fmu/start.h"

const volatile ZpFmuStart zp_fmu_start = {.mark = ZP_FMU_MARK, .size = sizeof(ZpFmuStart)};
