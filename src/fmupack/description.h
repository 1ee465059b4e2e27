/* The XML files of an FMU. */
#ifndef ZP_FMUPACK_DESCRIPTION_H
#define ZP_FMUPACK_DESCRIPTION_H

#include <stdio.h>

#include <zipact/sim.h>

#include "fmu/start.h"
#include "fmupack/kit.h"

/* The content of the description of an FMU. */
typedef struct ZpFmuPlan {
  int version;                  /* of FMI: 2 or 3 */
  const char *name;             /* of the model */
  const ZpFmuStart *start;      /* parameters */
  bool controlled;              /* the setpoint replaces the voltage as input */
  double first[ZP_INPUT_COUNT]; /* start value of the input */
  double end, step;             /* default experiment, s */
  double tolerance;             /* and its relative error */
  const ZpKit *sources;         /* files of the kit, including those in sources/ */
} ZpFmuPlan;

/* Name of all binaries, and of the model in them. */
#define ZP_FMU_IDENTIFIER "zipact"

/* modelDescription.xml. ZP_MACHINE if units cannot be converted. */
ZpStatus zp_fmu_describe(FILE *file, const ZpFmuPlan *plan, ZpError *err);

/* FMI 3: sources/buildDescription.xml, terminalsAndIcons/terminalsAndIcons.xml. */
void zp_fmu_describe_build(FILE *file, const ZpFmuPlan *plan);
void zp_fmu_describe_terminals(FILE *file, const ZpFmuPlan *plan);

/* Is this file of the kit a source to compile? => its name below sources/, otherwise NULL. */
const char *zp_fmu_source_name(const char *file);

#endif
