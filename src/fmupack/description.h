/* The XML files of an FMU. */
#ifndef ZP_FMUPACK_DESCRIPTION_H
#define ZP_FMUPACK_DESCRIPTION_H

#include <stdio.h>

#include <zipact/sim.h>

#include "fmu/start.h"
#include "fmupack/kit.h"

/* The content of the description of an FMU. */
typedef struct ZpFmuPlan {
  int version;              /* of FMI: 2 or 3 */
  const char *name;         /* of the model */
  const ZpFmuStart *start;  /* parameters, */
  const ZpActuatorDef *def; /* as a Def */
  double end, step;         /* default experiment, s */
  double tolerance;         /* and its relative error */
  const ZpKit *sources;     /* files of the kit, including those in sources/ */
} ZpFmuPlan;

/* Name of all binaries, and of the model in them. */
#define ZP_FMU_IDENTIFIER "zipact"

/* Write a file of the ZpFmuPlan `plan`: each is a ZpPut. modelDescription.xml, where ZP_MACHINE is that units cannot be
 * converted; for FMI 3 sources/buildDescription.xml and terminalsAndIcons/terminalsAndIcons.xml. */
ZpStatus zp_fmu_describe(const void *plan, FILE *file, ZpError *err);
ZpStatus zp_fmu_describe_build(const void *plan, FILE *file, ZpError *err);
ZpStatus zp_fmu_describe_terminals(const void *plan, FILE *file, ZpError *err);

#endif
